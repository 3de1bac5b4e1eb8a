#include "petrous/Presenters/StructureSurfaces.h"

#include <algorithm>
#include <utility>

#include "petrous/Volume/SmoothedUnion.h"

namespace petrous::presenters
{

namespace
{

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

struct StructureSurfaces::Structure
{
  Structure(std::string label, const std::shared_ptr<const volume::Volume<float>>& share)
    : name(std::move(label))
    , field(alone(share))
    , search(field, kFar)
  {
    const auto bounds = share->geometry().patientBounds();
    box = Eigen::AlignedBox3d(bounds[0], bounds[1]);
  }

  std::string name;
  volume::TissueField field;
  volume::NearestSurfaceSearch search; // looks at the field
  Eigen::AlignedBox3d box;             // patient mm; nothing of the structure is outside
};

StructureSurfaces::StructureSurfaces(const scene::Case& value)
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
  for (const scene::MeshPart& mesh : value.meshes)
    if (const auto solid = mesh.touch.resident())
      m_structures.push_back(std::make_unique<Structure>(mesh.name, solid));
}

StructureSurfaces::~StructureSurfaces() = default;

const std::string& StructureSurfaces::name(std::size_t structure) const
{
  return m_structures[structure]->name;
}

double StructureSurfaces::spacing(std::size_t structure) const
{
  return m_structures[structure]->field.finestSpacing();
}

double StructureSurfaces::distance(std::size_t structure, const Eigen::Vector3d& patient,
                                   double most)
{
  Structure& asked = *m_structures[structure];
  if (asked.box.squaredExteriorDistance(patient) >= most * most)
    return most;
  const auto found = asked.search.find(patient, std::min(most, kFar));
  return found ? found->distance : most;
}

std::optional<NearStructure>
StructureSurfaces::nearest(const Eigen::Vector3d& patient, double reach,
                           const std::function<bool(const std::string& name)>& wanted)
{
  std::optional<NearStructure> nearest;
  double best = reach;
  for (std::size_t n = 0; n < m_structures.size(); ++n)
  {
    if (!wanted(m_structures[n]->name))
      continue;
    const double there = distance(n, patient, best);
    if (!(there < best))
      continue;
    best = std::abs(there);
    nearest = NearStructure{m_structures[n]->name, there};
  }
  return nearest;
}

} // namespace petrous::presenters
