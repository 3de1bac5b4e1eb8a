#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/TickRecord.h"

namespace petrous::cli
{

/// What the removal laws made of a tick.
struct TickRemoval
{
  double arm = 0.0;       ///< mm, of the contact from the spindle's axis, as the law took it
  double removed = 0.0;   ///< mm^3 until then, with what was swept
  double predicted = 0.0; ///< mm^3 until then
};

/// `drill --log`: one row a tick. Where no law is at work (a replay), the volume that is gone is
/// measured tick by tick, which takes its time.
class DrillLog
{
public:
  /// Throws FileError-like InvalidParameter naming the file when it cannot be written.
  DrillLog(const std::filesystem::path& file, const scene::Case& value,
           presenters::TouchScene& scene);

  void add(const simulation::TickRecord& record, const std::optional<TickRemoval>& removal);

  /// Throws when not everything could be written.
  void close();

private:
  void measure();

  std::string m_name;
  std::ofstream m_file;
  const scene::Case& m_case;
  presenters::TouchScene& m_scene;
  volume::CutMask m_before;
  double m_removed = 0.0; // mm^3
};

} // namespace petrous::cli
