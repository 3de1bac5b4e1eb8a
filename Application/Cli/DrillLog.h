#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "petrous/Core/OutputFile.h"
#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Session/TickRecord.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::cli
{

/// Output of the removal laws for a tick.
struct TickRemoval
{
  double arm = 0.0;       ///< mm, distance of the contact from the spindle axis, as used by the law
  double removed = 0.0;   ///< mm^3 so far, including what was swept
  double predicted = 0.0; ///< mm^3 so far
};

/// `drill --log`: one row per tick. Without a removal law (a replay), the removed volume is
/// measured tick by tick, which is slow. The file appears with `close`, whole.
class DrillLog
{
public:
  /// Throws InvalidParameter naming the file if it cannot be written.
  DrillLog(const std::filesystem::path& file, const scene::Case& value, session::TouchScene& scene);

  void add(const session::TickRecord& record, const std::optional<TickRemoval>& removal);

  /// Throws InvalidParameter if not everything could be written.
  void close();

private:
  void measure();
  void flush();

  core::OutputFile m_file;
  std::string m_rows; // not yet in the file
  const scene::Case& m_case;
  session::TouchScene& m_scene;
  volume::CutMask m_before;
  double m_removed = 0.0; // mm^3
};

} // namespace petrous::cli
