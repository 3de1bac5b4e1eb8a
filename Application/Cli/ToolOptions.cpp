#include "ToolOptions.h"

#include "Numbers.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseBuilder.h"

namespace petrous::cli
{

// An axis that is assumed must not make a tool that is wider than long.
std::pair<presenters::InstrumentSurface, std::string>
ToolOptions::read(const core::Progress& progress) const
{
  presenters::InstrumentSurface surface = presenters::readInstrumentSurface(file, progress);
  const std::string along = axis.empty() ? presenters::kInstrumentAxes[0] : axis;
  const auto assumed = presenters::placementOf(surface.mesh, along);
  if (axis.empty() && assumed.isAcross())
  {
    const std::string likely = presenters::likelyAxis(surface.mesh);
    const auto better = presenters::placementOf(surface.mesh, likely);
    throw core::InvalidParameter(
        file + ": is " + presenters::lengthText(assumed.length) + " mm long along z and " +
        presenters::lengthText(assumed.width) +
        " mm across, so it seems to lie along another axis of its file; say --tool-axis " + likely +
        " (" + presenters::lengthText(better.length) + " mm long, the tip at " + likely[0] + " = " +
        core::fixedText(better.tip, 1) + " mm), or --tool-axis " + along + " if it is so");
  }
  return {std::move(surface), along};
}

CLI::Option* addToolOptions(CLI::App& command, const std::string& name, const std::string& what,
                            ToolOptions& options)
{
  CLI::Option* file = command.add_option(name, options.file, what)->type_name("FILE");
  command
      .add_option("--tool-axis", options.axis,
                  "Along which axis of its file the instrument lies, from the tip to the hand (z+, "
                  "if it is long that way)")
      ->check(oneOf({presenters::kInstrumentAxes.begin(), presenters::kInstrumentAxes.end()}))
      ->needs(file);
  return file;
}

} // namespace petrous::cli
