#include "petrous/Presenters/ViewSettings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petrous::presenters
{

namespace
{

constexpr std::array<const char*, 5> kModes{"none", "side-by-side", "interleaved", "anaglyph",
                                            "quad-buffer"}; // as scene::ViewState::Stereo

template <class T>
void change(T& value, const T& next, const std::function<void()>& notify)
{
  if (value == next)
    return;
  value = next;
  if (notify)
    notify();
}

double held(double value, double lower, double upper)
{
  return std::isnan(value) ? lower : std::clamp(value, lower, upper);
}

std::optional<double> held(std::optional<double> value, double lower, double upper)
{
  if (value)
    value = held(*value, lower, upper);
  return value;
}

} // namespace

void ViewSettings::setFalloff(double millimetres)
{
  change(m_light.falloff, held(millimetres, 0.0, kFarthestFalloff), events.lightChanged);
}

void ViewSettings::setWetness(double wetness)
{
  change(m_light.wetness, held(wetness, 0.0, 1.0), events.lightChanged);
}

void ViewSettings::setShadows(bool on)
{
  if (m_light.shadows == on)
    return;
  m_light.setShadows(on);
  if (events.lightChanged)
    events.lightChanged();
}

void ViewSettings::setExposure(double exposure)
{
  constexpr double kMax = scene::ViewState::Light::kMaxExposure;
  change(m_light.exposure, std::isnan(exposure) ? 0.0 : held(exposure, -kMax, kMax),
         events.lightChanged);
}

void ViewSettings::setToneCurve(bool on)
{
  change(m_light.toneCurve, on, events.lightChanged);
}

void ViewSettings::setEdges(double edges)
{
  change(m_light.edges, held(edges, 0.0, 1.0), events.lightChanged);
}

void ViewSettings::setGrain(double grain)
{
  change(m_light.grain, held(grain, 0.0, 1.0), events.lightChanged);
}

void ViewSettings::setExitSurfaces(bool on)
{
  change(m_light.exitSurfaces, on, events.lightChanged);
}

void ViewSettings::setStereo(rendering::StereoMode mode)
{
  change(m_stereo, mode, events.stereoChanged);
}

void ViewSettings::setEyeSeparation(std::optional<double> millimetres)
{
  change(m_rig.eyeSeparation, held(millimetres, 0.0, rendering::StereoRig::kLargestSeparation),
         events.stereoChanged);
}

void ViewSettings::setConvergence(std::optional<double> millimetres)
{
  change(m_rig.convergence,
         held(millimetres, rendering::StereoRig::kNearestConvergence,
              rendering::StereoRig::kFarthestConvergence),
         events.stereoChanged);
}

void ViewSettings::setBackground(const rendering::BackgroundColor& color)
{
  rendering::BackgroundColor next;
  std::transform(color.begin(), color.end(), next.begin(),
                 [](double value) { return held(value, 0.0, 1.0); });
  change(m_background, next, events.backgroundChanged);
}

void ViewSettings::take(const scene::ViewState& view, bool quadBuffer)
{
  if (view.light)
    setLight(*view.light);
  if (!view.stereo)
    return;
  setEyeSeparation(view.stereo->eyeSeparation);
  setConvergence(view.stereo->convergence);
  for (std::size_t n = 0; n < kModes.size(); ++n)
    if (const auto mode = static_cast<rendering::StereoMode>(n);
        view.stereo->mode == kModes[n] && (quadBuffer || mode != rendering::StereoMode::QuadBuffer))
      setStereo(mode);
}

void ViewSettings::take(const ViewSettings& other)
{
  setLight(other.lightState());
  setEyeSeparation(other.m_rig.eyeSeparation);
  setConvergence(other.m_rig.convergence);
  setStereo(other.m_stereo);
  setBackground(other.m_background);
}

void ViewSettings::setLight(const scene::ViewState::Light& light)
{
  setFalloff(light.falloff);
  setWetness(light.wetness);
  setShadows(light.shadows);
  setExposure(light.exposure);
  setToneCurve(light.toneCurve);
  setEdges(light.edges);
  setGrain(light.grain);
  setExitSurfaces(light.exitSurfaces);
}

scene::ViewState::Light ViewSettings::lightState() const
{
  return {m_light.falloff,   m_light.wetness, m_light.shadows, m_light.exposure,
          m_light.toneCurve, m_light.edges,   m_light.grain,   m_light.exitSurfaces};
}

scene::ViewState::Stereo ViewSettings::stereoState() const
{
  return {kModes[static_cast<std::size_t>(m_stereo)], m_rig.eyeSeparation, m_rig.convergence};
}

std::string backgroundEdit()
{
  return "background";
}

LightEdit lightEdit(const scene::ViewState::Light& before, const scene::ViewState::Light& after)
{
  std::string what;
  std::size_t changed = 0;
  const auto note = [&](bool isSame, const char* noun)
  {
    if (isSame)
      return;
    what = noun;
    ++changed;
  };
  note(before.falloff == after.falloff, "light falloff");
  note(before.wetness == after.wetness, "wetness");
  note(before.exposure == after.exposure, "exposure");
  note(before.edges == after.edges, "edges");
  note(before.grain == after.grain, "grain");
  const bool isNumber = changed == 1;
  note(before.shadows == after.shadows, "shadows");
  note(before.toneCurve == after.toneCurve, "soft highlights");
  note(before.exitSurfaces == after.exitSurfaces, "exit surfaces");
  if (changed != 1)
    what = "light";
  return {what, isNumber && changed == 1};
}

} // namespace petrous::presenters
