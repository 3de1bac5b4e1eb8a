#pragma once

#include <string>
#include <utility>
#include <vector>

#include "CounterNoise.h"
#include "StressTrials.h"

namespace petrous::registration::stress
{

/// The n-th draw of a kind: a body, one of its ears, and a seed.
struct Draw
{
  const std::vector<SimulationBody>* bodies;
  std::size_t n = 0;

  const SimulationBody& body() const { return (*bodies)[n % bodies->size()]; }
  std::size_t ear() const { return n / bodies->size() % body().ears.size(); }
  Vector3d earAt() const { return body().ears[ear()]; }
  std::uint64_t seed() const { return 1000 + 37 * n; }
  CounterNoise noise() const { return CounterNoise(seed()); }
  PairRecipe recipe() const { return usualRecipe(body(), ear(), seed()); }
  RegistrationPair usual() const { return simulatePair(body(), ear(), recipe()); }
  Vector3d size() const
  {
    const auto bounds = body().ct->geometry().patientBounds();
    return bounds.sizes();
  }
};

/// Collects trials by kind.
class List
{
public:
  List(const std::vector<SimulationBody>& bodies, bool quick)
    : m_bodies(&bodies)
    , m_quick(quick)
  {
  }

  using Make = RegistrationPair (*)(const Draw&);

  void add(const std::string& kind, std::size_t count, const Make& make, bool mustBeGood = false)
  {
    for (std::size_t n = 0; n < (m_quick ? 1 : count); ++n)
    {
      const Draw draw{m_bodies, n};
      trials.push_back({kind, draw.body().name + ", " + std::to_string(n + 1),
                        [draw, make] { return make(draw); }, mustBeGood});
    }
  }

  std::vector<StressTrial> trials;

private:
  const std::vector<SimulationBody>* m_bodies;
  bool m_quick;
};

inline RegistrationPair withMr(RegistrationPair pair,
                               std::shared_ptr<const volume::IntensityVolume> mr)
{
  pair.mr = std::move(mr);
  return pair;
}

inline RegistrationPair withoutTruth(RegistrationPair pair)
{
  pair.truth = nullptr;
  return pair;
}

/// Trials with images that show little or nothing (StressImages.cpp).
void addImages(List& list);

} // namespace petrous::registration::stress
