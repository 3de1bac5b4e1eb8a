#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "Session.h"
#include "petrous/Dissection/Catalogues.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Haptics/HapticField.h"
#include "petrous/Simulation/DissectionLoop.h"
#include "petrous/Simulation/RemovalFeed.h"

namespace petrous::simulation::testing
{

/// A flat block of bone, its surface at z = 0, and a burr that drills it by the laws with a set
/// thrust: everything but the thread. Cortical bone; with a `border`, cellular bone beyond it.
class LawScene
{
public:
  struct Setting
  {
    dissection::Burr burr;
    double thrust = 1.0;          // N
    double elevation = 0.0;       // rad, of the spindle above the surface
    double voxel = 0.3;           // mm
    double tick = 0.001;          // s
    std::optional<double> border; // x, mm
    double speed = 0.0;           // mm/s, to and fro along y
    double travel = 1.5;          // mm, to either side
    Eigen::Vector3d place{0.013, -0.027, 0.0};
  };

  explicit LawScene(const Setting& setting)
    : m_setting(setting)
    , work(gridOf(setting))
    , mask(std::make_shared<volume::PublishedMask>(work.mask()))
    , tissue(tissueOf(setting, work.mask().geometry()))
    , sides(sidesOf(setting, work.mask().geometry()))
    , meets(meetsOf(setting, tissue, sides))
    , search(tissue, meets, {}, 0.5 * setting.burr.diameter)
    , feed(search, setting.burr, setting.voxel)
    , loop(work, *mask, feed, {}, hooks())
    , m_shell(shellOf(setting))
    , m_tool(std::make_shared<haptics::HapticField>(tissue, mask), m_shell)
    , session(setupOf(m_shell), m_tool)
  {
    session.parameters.constantThrust = 1;
    session.parameters.thrust = setting.thrust;
    session.parameters.approach[2] = -1.0;
  }

  /// What follows a tick; the loop, unless another rule is measured.
  std::function<void(const TickRecord&)> follow = [this](const TickRecord& record)
  { loop.step(record); };

  std::vector<dissection::SweptSphere> bites; // in the order in which they were cut

  /// Pressed, with the drill on, for so many seconds of contact; each such tick is told.
  void drill(double seconds, const std::function<void(const TickRecord&)>& told = {})
  {
    const double angle = 0.5 * 3.14159265358979323846 - m_setting.elevation;
    const Eigen::Vector3d at = m_setting.place + Eigen::Vector3d(0.0, 0.0, -3.0);
    const haptics::Pose place{
        at, Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()))};
    if (session.records.empty())
    {
      haptics::Pose above = place;
      above.position.z() = 0.5 * m_setting.burr.diameter + 0.3;
      for (int n = 0; n < 40; ++n)
        tick(above);
      session.pedal = 1.0;
    }
    const auto wanted = static_cast<int>(std::lround(seconds / m_setting.tick));
    const int most = 5 * wanted + 2000; // it may come out below
    for (int n = 0, done = 0; done < wanted && n < most; ++n)
    {
      haptics::Pose there = place;
      there.position.y() += aside();
      if (const TickRecord& record = tick(there); record.drill && record.thrust > 0.0)
      {
        ++done;
        if (told)
          told(record);
      }
    }
  }

  const TickRecord& tick(const haptics::Pose& place)
  {
    const TickRecord& record = session.tick(place, m_setting.tick);
    follow(record);
    return record;
  }

  /// N/mm^2.
  static double resistance(const dissection::Burr& burr, const std::string& material)
  {
    const auto catalogues = dissection::Catalogues::builtIn();
    return resistanceOf(catalogues.materials.material(material), catalogues.burrs.model(burr.kind));
  }

  /// rad/s.
  static double speedOf(const dissection::Burr& burr)
  {
    return burr.rpm * 3.14159265358979323846 / 30.0;
  }

private:
  // mm along y: a triangle wave of the session's time.
  double aside() const
  {
    const double way = m_setting.speed * (session.now - kStart) / m_setting.travel;
    return m_setting.travel * (1.0 - std::abs(std::fmod(way + 1.0, 4.0) - 2.0));
  }

  DissectionLoop::Hooks hooks()
  {
    DissectionLoop::Hooks hooks;
    hooks.edited = [this](const MaskEdit& edit)
    {
      if (edit.kind == MaskEdit::Kind::Cut)
        bites.push_back(edit.burr());
    };
    return hooks;
  }

  static core::GridGeometry gridOf(const Setting& s)
  {
    const double half = 0.5 * s.burr.diameter + 2.5;
    const int n = static_cast<int>(std::ceil(2.0 * half / s.voxel));
    const int depth = static_cast<int>(std::ceil(4.5 / s.voxel));
    return {{n, n, depth}, Eigen::Vector3d::Constant(s.voxel), {-half, -half, -3.5}};
  }

  static volume::TissueField tissueOf(const Setting& s, const core::GridGeometry& grid)
  {
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
    for (int k = 0; k < grid.dims()[2]; ++k)
      for (int j = 0; j < grid.dims()[1]; ++j)
        for (int i = 0; i < grid.dims()[0]; ++i)
        {
          const Eigen::Vector3d p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
          voxels->at(i, j, k) = static_cast<std::int16_t>(
              std::clamp(300.0 - p.z() / s.voxel * 1500.0, -1000.0, 1800.0));
        }
    return {std::make_shared<volume::IntensityVolume>(
                std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
            {},
            nullptr,
            {}};
  }

  // 1 before the border, 2 beyond it.
  static std::shared_ptr<const volume::LabelMap> sidesOf(const Setting& s,
                                                         const core::GridGeometry& grid)
  {
    auto sides = std::make_shared<volume::Volume<std::uint16_t>>(grid);
    for (int k = 0; k < grid.dims()[2]; ++k)
      for (int j = 0; j < grid.dims()[1]; ++j)
        for (int i = 0; i < grid.dims()[0]; ++i)
          sides->at(i, j, k) =
              grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}).x() < s.border.value_or(1e9) ? 1
                                                                                              : 2;
    return std::make_shared<volume::LabelMap>(
        volume::makeLabelMap(std::shared_ptr<const volume::Volume<std::uint16_t>>(sides), {}));
  }

  static dissection::TissueResistance meetsOf(const Setting& s, const volume::TissueField& tissue,
                                              const std::shared_ptr<const volume::LabelMap>& sides)
  {
    const double cortical = resistance(s.burr, "cortical-bone");
    return {tissue.ct(),
            {300.0, 1800.0, 1.0, 1.0},
            {{sides, 1, cortical}, {sides, 2, resistance(s.burr, "cellular-bone")}}};
  }

  static haptics::PointShell shellOf(const Setting& s)
  {
    haptics::BurrShape shape;
    shape.radius = 0.5 * s.burr.diameter;
    return haptics::makeBurrShell(shape, s.voxel);
  }

  static ServoSetup setupOf(const haptics::PointShell& shell)
  {
    ServoSetup setup = Session::plainSetup();
    setup.guard.goodTicks = 1;
    setup.guard.speed = setup.guard.angularSpeed = setup.guard.reach = 1e9;
    setup.stallAfter = 1e9;
    setup.burrPoints = shell.burrCount;
    return setup;
  }

  static constexpr double kStart = 100.0; // s, of the session's clock

  Setting m_setting;

public:
  dissection::Dissection work;
  std::shared_ptr<volume::PublishedMask> mask;
  volume::TissueField tissue;
  std::shared_ptr<const volume::LabelMap> sides;
  dissection::TissueResistance meets;
  dissection::BiteSearch search;
  RemovalFeed feed;
  DissectionLoop loop;

private:
  haptics::PointShell m_shell;
  haptics::ConstrainedProxy m_tool;

public:
  Session session;
};

} // namespace petrous::simulation::testing
