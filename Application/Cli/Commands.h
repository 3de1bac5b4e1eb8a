#pragma once

#include "Context.h"

namespace petrous::cli
{

// Each adds its subcommands to the program; the context must outlive the parse.
void addSampleCommand(CLI::App& app, Context& context);
void addScanCommand(CLI::App& app, Context& context);
void addCaseCommands(CLI::App& app, Context& context);    ///< new, add, correct-axes, remove, info
void addArchiveCommands(CLI::App& app, Context& context); ///< archive, restore
void addAttachCommands(CLI::App& app, Context& context);  ///< attach, attachments
void addBatchCommand(CLI::App& app, Context& context);
void addDescribeCommand(CLI::App& app, Context& context);
void addDeidentifyCommands(CLI::App& app, Context& context); ///< deidentify, pseudonyms
void addLibraryCommand(CLI::App& app, Context& context);
void addNodeCommands(CLI::App& app, Context& context); ///< nodes, send, receive
void addAppearanceCommand(CLI::App& app, Context& context);
void addRenderCommand(CLI::App& app, Context& context);
void addSliceCommand(CLI::App& app, Context& context);
void addVideoCommand(CLI::App& app, Context& context);
void addViewCommand(CLI::App& app, Context& context);
void addMaterialsCommand(CLI::App& app, Context& context);
void addMeasureCommand(CLI::App& app, Context& context);
void addProbeCommand(CLI::App& app, Context& context);
void addDrillCommand(CLI::App& app, Context& context);
void addHistoryCommands(CLI::App& app, Context& context); ///< undo, redo, history, branch
void addExportCommand(CLI::App& app, Context& context);
void addRegisterCommand(CLI::App& app, Context& context);
void addReportCommand(CLI::App& app, Context& context);
void addReviewCommand(CLI::App& app, Context& context);
void addSegmentCommand(CLI::App& app, Context& context);
void addDeviceTestCommand(CLI::App& app, Context& context);
void addDoctorCommand(CLI::App& app, Context& context);
void addReferenceCommand(CLI::App& app, Context& context); ///< of all that `app` has

} // namespace petrous::cli
