#include "petrous/Sound/DrillVoice.h"

#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"

namespace petrous::sound
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kDull = 2000.0;    // Hz, of kThick
constexpr double kBright = 12000.0; // Hz, of no wall at all
constexpr double kHighest = 0.45;   // of the rate

// Time constants, s.
constexpr double kSpinUp = 0.06;
constexpr double kContact = 0.003;
constexpr double kWallChange = 0.02;

constexpr std::size_t kFilterEvery = 32; // samples
constexpr int kMostHarmonics = 40;

constexpr double kBeepPitch = 880.0; // Hz
constexpr double kBeepLength = 0.12; // s
constexpr double kBeepEvery = 0.6;   // s
constexpr double kBeepLevel = 0.25;

double within(double value, double lower, double upper, double otherwise)
{
  return std::isfinite(value) ? std::clamp(value, lower, upper) : otherwise;
}

} // namespace

DrillState DrillSignal::now() const noexcept
{
  DrillState state;
  state.running = running.load(std::memory_order_relaxed);
  state.rpm = rpm.load(std::memory_order_relaxed) * spindle.load(std::memory_order_relaxed);
  state.flutes = flutes.load(std::memory_order_relaxed);
  state.load = load.load(std::memory_order_relaxed);
  state.wall = wall.load(std::memory_order_relaxed);
  state.warning = warning.load(std::memory_order_relaxed);
  return state;
}

DrillVoice::DrillVoice(double rate)
  : m_rate(rate)
{
  if (!(rate >= 8000.0 && rate <= 192000.0))
    throw core::InvalidParameter("sound: the rate must lie within 8000 to 192000 samples a second");
  setFilter(cutoff(m_wall));
}

double DrillVoice::cutoff(double wall) const noexcept
{
  const double part = within(wall, 0.0, kThick, kThick) / kThick;
  return std::min(kDull * std::pow(kBright / kDull, 1.0 - part), kHighest * m_rate);
}

// A Butterworth filter of second order by the bilinear transform.
void DrillVoice::setFilter(double hertz) noexcept
{
  const double k = std::tan(kPi * hertz / m_rate);
  const double scale = 1.0 / (1.0 + std::sqrt(2.0) * k + k * k);
  m_forward = {k * k * scale, 2.0 * k * k * scale, k * k * scale};
  m_back = {2.0 * (k * k - 1.0) * scale, (1.0 - std::sqrt(2.0) * k + k * k) * scale};
}

// Of the harmonics that the rate can carry, by the recurrence of sin(k x).
double DrillVoice::tone(const DrillState& state) noexcept
{
  const double free = within(state.rpm, 0.0, 200000.0, 0.0) / 60.0;
  const double hertz = free * m_speed * (1.0 - kSag * m_load);
  m_phase += hertz / m_rate;
  m_phase -= std::floor(m_phase);
  if (!(hertz > 0.0))
    return 0.0;
  // The last one fades in, so that none comes or goes with a click as the speed changes.
  const double most = std::min<double>(kMostHarmonics, kHighest * m_rate / hertz);
  const int count = static_cast<int>(std::ceil(most));
  const int flutes = std::clamp(state.flutes, 0, 64);
  const double angle = 2.0 * kPi * m_phase;
  const double twice = 2.0 * std::cos(angle);
  double last = 0.0;
  double sine = std::sin(angle);
  double sum = 0.0;
  for (int k = 1; k <= count; ++k)
  {
    double level = (0.05 + 0.15 * m_load) / k;
    if (flutes > 0 && k % flutes == 0)
      level += 0.4 * m_load * flutes / k;
    sum += std::min(1.0, most - (k - 1)) * level * sine;
    const double next = twice * sine - last;
    last = sine;
    sine = next;
  }
  return sum;
}

double DrillVoice::noise() noexcept
{
  m_random = m_random * 1664525U + 1013904223U;
  return static_cast<double>(m_random >> 8U) / 8388608.0 - 1.0;
}

double DrillVoice::beep(bool warning) noexcept
{
  if (m_beepTime < 0.0)
  {
    if (!warning)
      return 0.0;
    m_beepTime = 0.0;
  }
  const double time = m_beepTime;
  m_beepTime += 1.0 / m_rate;
  if (m_beepTime >= kBeepEvery)
    m_beepTime = warning ? 0.0 : -1.0;
  if (time >= kBeepLength)
    return 0.0;
  const double fade = std::sin(kPi * time / kBeepLength); // without a click
  return kBeepLevel * fade * std::sin(2.0 * kPi * kBeepPitch * time);
}

void DrillVoice::render(const DrillState& state, float* samples, std::size_t count) noexcept
{
  const auto share = [this](double seconds) { return 1.0 - std::exp(-1.0 / (seconds * m_rate)); };
  const double spinUp = share(kSpinUp);
  const double contact = share(kContact);
  const double wallChange = share(kWallChange);
  const double load = state.running ? within(state.load, 0.0, kFullLoad, 0.0) / kFullLoad : 0.0;
  const double wall = within(state.wall, 0.0, kThick, kThick);
  const double noiseLevel = state.flutes > 0 ? 0.35 : 0.5; // grit has no teeth to be heard
  for (std::size_t n = 0; n < count; ++n)
  {
    m_speed += spinUp * ((state.running ? 1.0 : 0.0) - m_speed);
    m_load += contact * (load - m_load);
    m_wall += wallChange * (wall - m_wall);
    if (m_sinceFilter++ % kFilterEvery == 0)
      setFilter(cutoff(m_wall));
    const double chips = noiseLevel * m_load * noise();
    const double raw = m_speed < 1e-4 ? 0.0 : m_speed * (tone(state) + chips);
    // Transposed direct form II.
    const double out = m_forward[0] * raw + m_delay[0];
    m_delay[0] = m_forward[1] * raw - m_back[0] * out + m_delay[1];
    m_delay[1] = m_forward[2] * raw - m_back[1] * out;
    samples[n] = static_cast<float>(std::tanh(out + beep(state.warning)));
  }
}

} // namespace petrous::sound
