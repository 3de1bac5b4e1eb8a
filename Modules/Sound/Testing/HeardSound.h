#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "petrous/Sound/DrillVoice.h"

namespace petrous::sound
{

constexpr double kHeardRate = 48000.0; ///< samples a second
constexpr double kHeardBin = 50.0;     ///< Hz, of heardSpectrum

inline std::vector<float> heard(DrillVoice& voice, const DrillState& state, double seconds)
{
  std::vector<float> samples(static_cast<std::size_t>(kHeardRate * seconds));
  voice.render(state, samples.data(), samples.size());
  return samples;
}

/// Root mean square.
inline double loudness(const std::vector<float>& samples)
{
  double sum = 0.0;
  for (const float sample : samples)
    sum += static_cast<double>(sample) * static_cast<double>(sample);
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

/// Power at multiples of kHeardBin, by Hann windows of 20 ms.
inline std::vector<double> heardSpectrum(const std::vector<float>& samples)
{
  constexpr std::size_t kWindow = 960;
  constexpr double kTurn = 2.0 * 3.14159265358979323846;
  std::vector<double> cosine(kWindow);
  std::vector<double> sine(kWindow);
  for (std::size_t n = 0; n < kWindow; ++n)
  {
    cosine[n] = std::cos(kTurn * static_cast<double>(n) / kWindow);
    sine[n] = std::sin(kTurn * static_cast<double>(n) / kWindow);
  }
  std::vector<double> power(kWindow / 2, 0.0);
  for (std::size_t start = 0; start + kWindow <= samples.size(); start += kWindow)
    for (std::size_t bin = 1; bin < power.size(); ++bin)
    {
      double real = 0.0;
      double imaginary = 0.0;
      for (std::size_t n = 0; n < kWindow; ++n)
      {
        const double value = static_cast<double>(samples[start + n]) * (0.5 - 0.5 * cosine[n]);
        real += value * cosine[bin * n % kWindow];
        imaginary += value * sine[bin * n % kWindow];
      }
      power[bin] += real * real + imaginary * imaginary;
    }
  return power;
}

/// Spectral centroid, Hz.
inline double centroid(const std::vector<double>& power)
{
  double sum = 0.0;
  double weighted = 0.0;
  for (std::size_t bin = 1; bin < power.size(); ++bin)
  {
    sum += power[bin];
    weighted += kHeardBin * static_cast<double>(bin) * power[bin];
  }
  return weighted / sum;
}

/// Of a drill that runs.
inline DrillState drilling(double load, double wall = DrillVoice::kThick, int flutes = 8)
{
  DrillState state;
  state.running = true;
  state.load = load;
  state.wall = wall;
  state.flutes = flutes;
  return state;
}

/// The spectral centroid after the drill has been heard so for 0.4 s, over the next 0.2 s.
inline double settledCentroid(const DrillState& state)
{
  DrillVoice voice(kHeardRate);
  heard(voice, state, 0.4);
  return centroid(heardSpectrum(heard(voice, state, 0.2)));
}

} // namespace petrous::sound
