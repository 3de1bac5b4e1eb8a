#pragma once

#include <filesystem>
#include <fstream>
#include <memory>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/TickRecord.h"

namespace petrous::cli
{

/// `drill --log`: one row a tick. The volume that is gone is measured tick by tick, so a log takes
/// its time.
class DrillLog
{
public:
  /// Throws FileError-like InvalidParameter naming the file when it cannot be written.
  DrillLog(const std::filesystem::path& file, const scene::Case& value,
           presenters::TouchScene& scene);

  void add(const simulation::TickRecord& record);

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
