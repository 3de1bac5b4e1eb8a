#include "StructureSurface.h"

#include <algorithm>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vtkPolyData.h>

#include "IsoTriangles.h"
#include "ShadedMesh.h"
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

// -0.5 to 0.5 at the mask's voxels in a box.
volume::Volume<float> maskBlock(const volume::CutMask& mask, const core::IndexBox& box)
{
  const core::Index3 size = box.size();
  volume::Volume<float> block(mask.geometry().cropped(box));
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        block.at(i, j, k) =
            static_cast<float>(mask.at(box.lower[0] + i, box.lower[1] + j, box.lower[2] + k)) /
                static_cast<float>(volume::CutMask::kUntouched) -
            0.5F;
  return block;
}

volume::Volume<float> occupancyBlock(const volume::Volume<float>& occupancy)
{
  volume::Volume<float> block(occupancy.geometry());
  std::transform(occupancy.data(), occupancy.data() + occupancy.size(), block.data(),
                 [](float value) { return value - 0.5F; });
  return block;
}

// The operands of a structure's field and their normals (out of the tissue), patient LPS.
struct Operands
{
  const volume::Volume<float>& occupancy;
  const volume::CutMask* mask;
  static constexpr double kReach = 1.0; // voxels, as in the tissue field

  double inside(const Eigen::Vector3d& patient) const
  {
    const Eigen::Vector3d voxel = occupancy.geometry().voxelFromPatient(patient);
    return occupancy.geometry().hullContains(voxel)
               ? volume::sampleTrilinear(occupancy, voxel) - 0.5
               : -0.5;
  }
  Eigen::Vector3d insideNormal(const Eigen::Vector3d& patient) const
  {
    return -volume::sampleGradient(occupancy, occupancy.geometry().voxelFromPatient(patient),
                                   kReach);
  }
  double left(const Eigen::Vector3d& patient) const { return maskOperand(*mask, patient); }
  Eigen::Vector3d leftNormal(const Eigen::Vector3d& patient) const
  {
    return -volume::gradientInPatient(
        mask->geometry(), mask->geometry().voxelFromPatient(patient), kReach,
        [this](const Eigen::Vector3d& at) { return mask->sample(at); });
  }
};

template <class Value>
auto atVertices(const core::TriangleMesh& mesh, const Value& value)
{
  using Result = decltype(value(Eigen::Vector3d()));
  std::vector<Result> results(mesh.vertices.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, results.size()),
                    [&](const auto& range)
                    {
                      for (std::size_t v = range.begin(); v < range.end(); ++v)
                        results[v] = value(mesh.vertices[v].template cast<double>());
                    });
  return results;
}

std::vector<Eigen::Vector3f> unitNormals(const core::TriangleMesh& mesh,
                                         const std::vector<Eigen::Vector3d>& slopes)
{
  std::vector<Eigen::Vector3f> normals(mesh.vertices.size());
  std::transform(slopes.begin(), slopes.end(), normals.begin(),
                 [](const Eigen::Vector3d& slope)
                 { return slope.stableNormalized().cast<float>().eval(); });
  return normals;
}

// {min(a, b) = 0} is {a = 0, b >= 0} and {b = 0, a >= 0}: each operand's own surface cut by the
// other. A minimum taken at the voxels would blunt the edge of a cut and lose thin remnants.
ShadedMesh structureMesh(const volume::Volume<float>& occupancy, const volume::CutMask* mask,
                         const core::IndexBox& maskBox)
{
  const Operands operands{occupancy, mask};
  ShadedMesh outside;
  outside.mesh = isoTriangles(occupancyBlock(occupancy));
  outside.normals = unitNormals(outside.mesh, atVertices(outside.mesh, [&](const Eigen::Vector3d& p)
                                                         { return operands.insideNormal(p); }));
  if (!mask)
    return outside;
  outside = clip(outside, atVertices(outside.mesh,
                                     [&](const Eigen::Vector3d& p) { return operands.left(p); }));
  ShadedMesh wall;
  wall.mesh = isoTriangles(maskBlock(*mask, maskBox));
  wall.normals = unitNormals(wall.mesh, atVertices(wall.mesh, [&](const Eigen::Vector3d& p)
                                                   { return operands.leftNormal(p); }));
  append(outside, clip(wall, atVertices(wall.mesh, [&](const Eigen::Vector3d& p)
                                        { return operands.inside(p); })));
  return outside;
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
  core::IndexBox box;
  if (mask)
    box = meeting(m_occupancy->geometry(), *mask);
  if (box.empty() || !cutIn(*mask, box))
    mask = nullptr;
  const ShadedMesh mesh = structureMesh(*m_occupancy, mask, box);
  const auto surface = toPolyData(mesh.mesh, mesh.normals);
  m_surfaceBytes = static_cast<std::size_t>(surface->GetActualMemorySize()) * 1024;
  m_actor.setSurface(surface);
}

std::size_t StructureSurface::bytes() const
{
  return (m_occupancy ? m_occupancy->bytes() : 0) + m_surfaceBytes;
}

} // namespace petrous::rendering
