#pragma once

#include <string>
#include <utility>

#include "Context.h"
#include "petrous/Presenters/InstrumentFile.h"

namespace petrous::cli
{

/// An instrument from a file and the axis along which it lies there.
struct ToolOptions
{
  std::string file, axis; ///< empty: not given

  /// With the axis that is assumed without one. Throws as readInstrumentSurface does;
  /// InvalidParameter, naming the likely axis, if the assumed one made it wider than long.
  std::pair<presenters::InstrumentSurface, std::string> read(const core::Progress& progress) const;
};

/// Adds `name`, of the file, which is returned, and --tool-axis, which needs it.
CLI::Option* addToolOptions(CLI::App& command, const std::string& name, const std::string& what,
                            ToolOptions& options);

} // namespace petrous::cli
