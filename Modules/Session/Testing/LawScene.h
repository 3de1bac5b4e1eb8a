#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "LawBlock.h"
#include "Session.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Haptics/HapticField.h"
#include "petrous/Session/BurrRemovalModel.h"
#include "petrous/Session/ConstantThrust.h"
#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/SurfaceApproach.h"

namespace petrous::session::testing
{

/// A flat block of bone with its surface at z = 0, and a burr that drills it by the laws with a set
/// thrust: everything but the thread. Cortical bone; with a `border`, cellular bone beyond it.
class LawScene
{
public:
  using Setting = LawSetting;

  explicit LawScene(const Setting& setting)
    : m_setting(setting)
    , work(gridOf(setting))
    , mask(std::make_shared<volume::PublishedMask>(work.mask()))
    , tissue(tissueOf(setting, work.mask().geometry()))
    , sides(sidesOf(setting, work.mask().geometry()))
    , approach(tissue)
    , meets(meetsOf(setting, tissue, sides))
    , search(tissue, meets, {}, 0.5 * setting.burr.diameter)
    , removalModel(search, setting.burr, setting.voxel)
    , loop(work, *mask, removalModel, {}, hooks())
    , m_shell(shellOf(setting))
    , m_tool(std::make_shared<haptics::HapticField>(tissue, mask), *m_shell,
             ConstantThrust::coupling(setting.thrust))
    , session(setupOf(*m_shell, setting.thrust), m_tool)
  {
    session.parameters.constantThrust = 1;
    session.parameters.thrust = setting.thrust;
  }

  /// Called after each tick; the loop, unless another rule is tested.
  std::function<void(const TickRecord&)> follow = [this](const TickRecord& record)
  { loop.step(record); };

  std::vector<dissection::SweptSphere> bites; // in chronological order

  /// Presses, with the drill on, for a number of seconds of contact; `notify` is called for each
  /// such tick.
  void drill(double seconds, const std::function<void(const TickRecord&)>& notify = {})
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
    const int most = 5 * wanted + 2000; // it may break through at the bottom
    for (int n = 0, done = 0; done < wanted && n < most; ++n)
    {
      haptics::Pose there = place;
      there.position.y() += aside();
      if (const TickRecord& record = tick(there); record.drill && record.thrust > 0.0)
      {
        ++done;
        if (notify)
          notify(record);
      }
    }
  }

  const TickRecord& tick(const haptics::Pose& place)
  {
    if (session.records.empty() || !(session.records.back().thrust > 0.0))
      approach.apply(place.position, session.parameters);
    const TickRecord& record = session.tick(place, m_setting.tick);
    follow(record);
    return record;
  }

private:
  // mm along y: a triangle wave over the session's time.
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

  static ServoSetup setupOf(const haptics::PointShell& shell, double thrust)
  {
    ServoSetup setup = Session::plainSetup();
    setup.guard.goodTicks = 1;
    setup.guard.speed = setup.guard.angularSpeed = setup.guard.reach = 1e9;
    setup.stallAfter = 1e9;
    setup.stiffness = ConstantThrust::coupling(thrust).stiffness;
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
  SurfaceApproach approach; // to the original bone
  dissection::TissueResistance meets;
  dissection::RemovalDepthSolver search;
  BurrRemovalModel removalModel;
  DissectionLoop loop;

private:
  std::shared_ptr<const haptics::PointShell> m_shell;
  haptics::ConstrainedProxy m_tool;

public:
  Session session;
};

} // namespace petrous::session::testing
