#include "petrous/Presenters/RecordingPlayer.h"

#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::presenters
{

namespace
{

std::string number(double value)
{
  return core::generalText(value, 10);
}

std::string strokes(std::uint64_t count)
{
  return std::to_string(count) + (count == 1 ? " stroke" : " strokes");
}

// How to restore the dissection's recorded state; empty if there is no way.
std::string wayTo(std::uint64_t then, const scene::Case& value)
{
  if (value.applied() > then)
    return "; take back what came after: petrous undo '" + value.name + "' " +
           std::to_string(value.applied() - then);
  if (value.applied() < then && value.applied() + value.dissection.history().ahead() >= then)
    return "; bring back what was there: petrous redo '" + value.name + "' " +
           std::to_string(then - value.applied());
  return {};
}

void checkFit(const scene::Case& value, const session::TouchScene& scene,
              const session::RecordingSetup& setup, const std::string& name)
{
  const auto refuse = [&name](const std::string& why)
  { throw core::InvalidParameter(name + ": " + why); };
  if (const std::string why = misfitOf(value, scene.fingerprint(), setup.scene); !why.empty())
    refuse(why);
  const session::TouchTool tool = toolOf(setup);
  if (scene.servoOf(tool).burrPoints != setup.servo.burrPoints)
    refuse("was recorded by another version of this program, whose tool had other points");
}

const session::RecordingSetup& fitting(const scene::Case& value, const session::TouchScene& scene,
                                       const session::RecordingSetup& setup,
                                       const std::string& name)
{
  checkFit(value, scene, setup, name);
  return setup;
}

} // namespace

std::string misfitOf(const scene::Case& value, const session::RecordedScene& now,
                     const session::RecordedScene& then)
{
  if (now.ct != then.ct)
    return std::string("was recorded on another ") + primaryName(value) + " than that of '" +
           value.name + "'";
  if (now.iso != then.iso)
  {
    const std::string unit = displayOf(value).suffix();
    const bool isMr = value.ct.modality == scene::Modality::Mr;
    return std::string("was recorded with ") + (isMr ? "tissue" : "bone") + " from " +
           number(then.iso) + unit + " on, '" + value.name + "' has it from " + number(now.iso) +
           unit + " on: petrous appearance '" + value.name + "' --iso " + number(then.iso);
  }
  if (now.tissue != then.tissue)
    return "was recorded with other structures under hand and drill than '" + value.name +
           "' has; see what is touchable and drillable: petrous appearance '" + value.name +
           "' --list";
  if (now.mask != then.mask)
    return "began on another dissection (" + strokes(then.applied) + ") than '" + value.name +
           "' has (" + strokes(value.applied()) + ")" + wayTo(then.applied, value);
  return {};
}

session::TouchTool toolOf(const session::RecordingSetup& setup)
{
  if (setup.degrees != 3 && setup.degrees != 6)
    throw core::InvalidParameter("recording: a tool of " + std::to_string(setup.degrees) +
                                 " degrees of freedom; this program has tools of 3 and of 6");
  session::TouchTool tool;
  tool.burr = setup.burr;
  tool.mode =
      setup.degrees == 3 ? session::TouchTool::Mode::ThreeDof : session::TouchTool::Mode::SixDof;
  tool.coupling = setup.proxy;
  return tool;
}

RecordingPlayer::RecordingPlayer(scene::Case& value, session::TouchScene& scene,
                                 session::RecordingReader& reader, const std::string& name,
                                 std::optional<core::CameraPose> camera)
  : m_proxy(scene.proxyOf(toolOf(fitting(value, scene, reader.setup(), name))))
  , m_servo(*m_proxy, reader.setup().servo)
  , m_loop(value.dissection, *scene.mask(), m_removalModel, scene.drill().protectedTissue(),
           scene.hooksOf(reader.setup().burr, [camera] { return camera; }))
  , m_replay(reader, m_servo, m_loop)
{
}

} // namespace petrous::presenters
