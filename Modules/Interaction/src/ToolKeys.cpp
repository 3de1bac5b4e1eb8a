#include "ToolKeys.h"

#include <functional>
#include <map>

#include "petrous/Interaction/PointerToolController.h"

namespace petrous::interaction
{

namespace
{

constexpr double kTiltStep = 5.0;  // degrees
constexpr double kTurnStep = 15.0; // degrees

using Action = std::function<void(PointerToolController&, bool fine)>;

Action nudge(double rightward, double upward)
{
  return [=](PointerToolController& aim, bool fine) { aim.nudge(rightward, upward, fine); };
}

Action deepen(double steps)
{
  return [=](PointerToolController& aim, bool fine) { aim.wheel(steps, fine); };
}

Action turn(double degrees)
{
  return [=](PointerToolController& aim, bool fine)
  { aim.turnBy(degrees * (fine ? aim.settings().fineFraction : 1.0)); };
}

Action tilt(double degrees)
{
  return [=](PointerToolController& aim, bool fine)
  { aim.tiltBy(degrees * (fine ? aim.settings().fineFraction : 1.0)); };
}

void changeMode(PointerToolController& aim, bool)
{
  using Mode = AimSettings::Mode;
  AimSettings settings = aim.settings();
  settings.mode = settings.mode == Mode::Surface ? Mode::Depth : Mode::Surface;
  aim.setSettings(settings);
}

const std::map<std::string, Action>& actions()
{
  static const std::map<std::string, Action> actions{
      {"left", nudge(-1.0, 0.0)}, {"a", nudge(-1.0, 0.0)},
      {"right", nudge(1.0, 0.0)}, {"d", nudge(1.0, 0.0)},
      {"up", nudge(0.0, 1.0)},    {"w", nudge(0.0, 1.0)},
      {"down", nudge(0.0, -1.0)}, {"s", nudge(0.0, -1.0)},
      {"prior", deepen(-1.0)},    {"next", deepen(1.0)},
      {"q", turn(kTurnStep)},     {"e", turn(-kTurnStep)},
      {"r", tilt(-kTiltStep)},    {"f", tilt(kTiltStep)},
      {"m", changeMode},          {"home", [](PointerToolController& aim, bool) { aim.home(); }},
  };
  return actions;
}

} // namespace

ToolKey heldKey(const std::string& sym)
{
  if (sym == "space")
    return ToolKey::Drill;
  return sym == "c" ? ToolKey::Freeze : ToolKey::None;
}

bool pressKey(PointerToolController& aim, const std::string& sym, bool fine)
{
  const auto found = actions().find(sym);
  if (found == actions().end())
    return false;
  found->second(aim, fine);
  return true;
}

bool isToolKey(const std::string& sym)
{
  return heldKey(sym) != ToolKey::None || actions().count(sym) > 0;
}

} // namespace petrous::interaction
