#include "petrous/Presenters/ViewSettings.h"

#include <algorithm>
#include <cmath>

namespace petrous::presenters
{

namespace
{

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

} // namespace petrous::presenters
