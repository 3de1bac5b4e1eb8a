#include "petrous/Presenters/StructureDistances.h"

#include <algorithm>
#include <cmath>

#include "petrous/Volume/NearestSurface.h"
#include "petrous/Volume/SmoothedUnion.h"

namespace petrous::presenters
{

namespace
{

constexpr double kFar = 1000.0; // mm: nothing of a patient's head is farther
constexpr double kStep = 0.01;  // mm between positions that are kept

// A field in which there is the structure and nothing else.
volume::TissueField alone(const std::shared_ptr<const volume::Volume<float>>& share)
{
  auto air = std::make_shared<volume::Volume<std::int16_t>>(share->geometry());
  std::fill(air->data(), air->data() + air->size(), std::int16_t{-1000});
  return {std::make_shared<volume::IntensityVolume>(
              std::shared_ptr<const volume::Volume<std::int16_t>>(air)),
          {share},
          nullptr,
          {}};
}

} // namespace

struct StructureDistances::Structure
{
  Structure(std::string label, const std::shared_ptr<const volume::Volume<float>>& share)
    : name(std::move(label))
    , field(alone(share))
    , search(field, kFar)
  {
  }

  std::string name;
  volume::TissueField field;
  volume::NearestSurfaceSearch search; // looks at the field
};

StructureDistances::StructureDistances(const scene::Case& value, double radius)
  : m_radius(radius)
{
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
    {
      const auto share =
          volume::makeSmoothedUnion(*part.labels.get(), [&structure](std::uint16_t index)
                                    { return index == structure.index; });
      if (share)
        m_structures.push_back(std::make_unique<Structure>(structure.name, share));
    }
}

StructureDistances::~StructureDistances() = default;

void StructureDistances::add(const Eigen::Vector3d& centre)
{
  const double step = m_positions.empty() ? kStep : (centre - m_positions.back()).norm();
  if (m_structures.empty() || step < kStep)
    return;
  m_way.push_back(m_way.empty() ? 0.0 : m_way.back() + step);
  m_positions.push_back(centre);
}

// From the centre to the surface; negative in the structure. A distance changes by no more than
// the way, so between two positions it is at least half of what both have less the way.
double StructureDistances::nearest(Structure& structure) const
{
  struct Stretch
  {
    std::size_t begin, end;
    double atBegin, atEnd;
  };
  const double slack = structure.field.geometry().minSpacing();
  const auto distance = [&](std::size_t n, double most)
  {
    const auto found = structure.search.find(m_positions[n], most);
    return found ? found->distance : most;
  };
  const std::size_t last = m_positions.size() - 1;
  std::vector<Stretch> stretches{{0, last, distance(0, kFar), distance(last, kFar)}};
  double best = std::min(stretches.back().atBegin, stretches.back().atEnd);
  while (!stretches.empty() && best > m_radius)
  {
    const Stretch s = stretches.back();
    stretches.pop_back();
    const double least = 0.5 * (s.atBegin + s.atEnd - (m_way[s.end] - m_way[s.begin]));
    if (s.end - s.begin < 2 || least >= best - (kTolerance - kStep))
      continue;
    const std::size_t middle = (s.begin + s.end) / 2;
    const double there = distance(middle, std::abs(s.atBegin) + slack +
                                              (m_positions[middle] - m_positions[s.begin]).norm());
    best = std::min(best, there);
    stretches.push_back({s.begin, middle, s.atBegin, there});
    stretches.push_back({middle, s.end, there, s.atEnd});
  }
  return best;
}

std::map<std::string, double> StructureDistances::smallest()
{
  std::map<std::string, double> result;
  if (m_positions.empty())
    return result;
  for (const auto& structure : m_structures)
  {
    const double distance = nearest(*structure);
    if (distance < kFar)
      result[structure->name] = std::max(0.0, distance - m_radius);
  }
  return result;
}

} // namespace petrous::presenters
