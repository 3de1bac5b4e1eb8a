#include "StructureSurface.h"

#include <algorithm>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vtkPolyData.h>

#include "IsoTriangles.h"
#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/SmoothedUnion.h"

namespace petrous::rendering
{

namespace
{

// The box of mask voxels that decide inside the hull of `grid`.
core::IndexBox meeting(const core::GridGeometry& grid, const volume::CutMask& mask)
{
  const auto [lower, upper] = grid.patientBounds();
  return mask.geometry().boxCovering(lower, upper);
}

bool cutIn(const volume::CutMask& mask, const core::IndexBox& box)
{
  const core::IndexBox bricks = mask.bricksCovering(box);
  for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
    for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
      for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
        if (mask.brick(mask.brickIndex({i, j, k})))
          return true;
  return false;
}

double maskOperand(const volume::CutMask& mask, const Eigen::Vector3d& patient)
{
  const Eigen::Vector3d voxel = mask.geometry().voxelFromPatient(patient);
  // Outside the CT the field is air; a structure that reaches there is still drawn.
  return mask.geometry().hullContains(voxel) ? mask.sample(voxel) - 0.5 : 0.5;
}

volume::Volume<float> cutField(const volume::Volume<float>& occupancy, const volume::CutMask* mask)
{
  const core::GridGeometry& grid = occupancy.geometry();
  volume::Volume<float> field(grid);
  tbb::parallel_for(
      tbb::blocked_range<int>(0, grid.dims()[2]),
      [&](const auto& slices)
      {
        for (int k = slices.begin(); k < slices.end(); ++k)
          for (int j = 0; j < grid.dims()[1]; ++j)
            for (int i = 0; i < grid.dims()[0]; ++i)
            {
              double value = static_cast<double>(occupancy.at(i, j, k)) - 0.5;
              if (mask && value > -0.5)
                value = std::min(
                    value, maskOperand(*mask, grid.patientFromVoxel(Eigen::Vector3d(i, j, k))));
              field.at(i, j, k) = static_cast<float>(value);
            }
      });
  return field;
}

// The gradient of the operand that decides at each vertex, so that the edge of a cut stays sharp.
std::vector<Eigen::Vector3f> fieldNormals(const core::TriangleMesh& mesh,
                                          const volume::Volume<float>& occupancy,
                                          const volume::CutMask* mask)
{
  constexpr double reach = 0.75; // voxels, as in the tissue field
  std::vector<Eigen::Vector3f> normals(mesh.vertices.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size()),
                    [&](const auto& range)
                    {
                      for (std::size_t v = range.begin(); v < range.end(); ++v)
                      {
                        const Eigen::Vector3d patient = mesh.vertices[v].cast<double>();
                        const Eigen::Vector3d voxel =
                            occupancy.geometry().voxelFromPatient(patient);
                        const double inside = volume::sampleTrilinear(occupancy, voxel) - 0.5;
                        Eigen::Vector3d gradient;
                        if (mask && maskOperand(*mask, patient) < inside)
                          gradient = volume::gradientInPatient(
                              mask->geometry(), mask->geometry().voxelFromPatient(patient), reach,
                              [mask](const Eigen::Vector3d& at) { return mask->sample(at); });
                        else
                          gradient = volume::sampleGradient(occupancy, voxel, reach);
                        normals[v] = -gradient.stableNormalized().cast<float>();
                      }
                    });
  return normals;
}

} // namespace

StructureSurface::StructureSurface(const StructureContents& structure, int pattern)
  : m_labels(structure.labels)
  , m_index(structure.index)
  , m_actor(pattern)
{
}

bool StructureSurface::shows(const StructureContents& structure) const
{
  return structure.labels == m_labels && structure.index == m_index;
}

void StructureSurface::setLook(const appearance::StructureLook& look, const LightSettings& light)
{
  m_actor.setLook(look, light);
  m_shown = look.shown && look.opacity > 0.0F;
  update();
}

void StructureSurface::maskChanged(const std::shared_ptr<const volume::CutMask>& mask,
                                   const core::IndexBox& box)
{
  const volume::CutMask* either = mask ? mask.get() : m_mask.get();
  if (m_occupancy && either)
    m_stale = m_stale || !meeting(m_occupancy->geometry(), *either).intersected(box).empty();
  m_mask = mask;
  update();
}

void StructureSurface::update()
{
  if (!m_shown || !m_stale)
    return;
  m_stale = false;
  if (!m_occupancy)
    m_occupancy = volume::makeSmoothedUnion(*m_labels, [this](std::uint16_t index)
                                            { return index == m_index; });
  if (!m_occupancy)
  {
    m_actor.setSurface(nullptr);
    m_surfaceBytes = 0;
    return;
  }
  const volume::CutMask* mask = m_mask.get();
  if (mask && !cutIn(*mask, meeting(m_occupancy->geometry(), *mask)))
    mask = nullptr;
  const core::TriangleMesh mesh = isoTriangles(cutField(*m_occupancy, mask));
  const auto surface = toPolyData(mesh, fieldNormals(mesh, *m_occupancy, mask));
  m_surfaceBytes = static_cast<std::size_t>(surface->GetActualMemorySize()) * 1024;
  m_actor.setSurface(surface);
}

std::size_t StructureSurface::bytes() const
{
  return (m_occupancy ? m_occupancy->bytes() : 0) + m_surfaceBytes;
}

} // namespace petrous::rendering
