#include "petrous/Haptics/HapticField.h"

#include <algorithm>
#include <cmath>

#include "TissueBricks.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::haptics
{

namespace
{
using volume::CutMask;
using volume::TissueField;

constexpr std::size_t kMaxSolids = 255;
constexpr double kHullSlope = 0.25; // of f per voxel, at the border of the grid
// Of a mask, per voxel along an axis: a cut's ramp rises by 1/2 over a voxel diagonal (adr 6),
// protected structures by a smoothed union's 1/2 per voxel.
constexpr double kMaskSlope = 0.5;
constexpr double kSameGrid = 1e-6; // voxels: tolerance for a union's voxels to coincide with the
                                   // CT's

// Of a non-negative position.
double inBrick(double voxel) noexcept
{
  return voxel - kTissueBrick * (static_cast<int>(voxel) / kTissueBrick);
}

std::size_t offsetInBrick(int i, int j, int k) noexcept
{
  constexpr int edge = CutMask::kBrickEdge;
  return static_cast<std::size_t>((i % edge) + edge * ((j % edge) + edge * (k % edge)));
}

// Whether the union is air at the hull of its voxels.
bool endsInAir(const volume::Volume<float>& occupancy) noexcept
{
  const core::Index3& n = occupancy.geometry().dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
    {
      const bool face = k == 0 || k == n[2] - 1 || j == 0 || j == n[1] - 1;
      for (int i = 0; i < n[0]; i += face || i == n[0] - 1 ? 1 : n[0] - 1)
        if (occupancy.at(i, j, k) > 0.5F)
          return false;
    }
  return true;
}
} // namespace

HapticField::HapticField(const TissueField& tissue,
                         std::shared_ptr<const volume::PublishedMask> mask,
                         std::vector<SoftStructure> soft, const KeptField& kept)
  : m_ct(tissue.ct())
  , m_mask(std::move(mask))
  , m_soft(std::move(soft))
  , m_geometry(tissue.geometry())
  , m_parameters(tissue.parameters())
  , m_voxel(m_geometry.minSpacing())
  , m_leftSteepness(kMaskSlope * m_geometry.spacing().cwiseInverse().norm())
{
  if (!m_mask || !sameGrid(m_mask->geometry(), m_geometry))
    throw core::InvalidParameter("haptic field: the mask does not lie on the CT's grid");
  if (tissue.solids().size() > kMaxSolids)
    throw core::InvalidParameter("haptic field: more than 255 unions of structures");
  for (std::size_t a = 0; a < 3; ++a)
    m_last[static_cast<Eigen::Index>(a)] = m_geometry.dims()[a] - 1.0;
  for (const SoftStructure& structure : m_soft)
    if (!structure.depth || !(structure.stiffness >= 1e-3 && structure.stiffness <= 100.0))
      throw core::InvalidParameter("haptic field: a soft structure needs its distance map and a "
                                   "stiffness within 0.001 to 100 N/mm");
  for (const auto& occupancy : tissue.solids())
  {
    const core::GridGeometry& grid = occupancy->geometry();
    const core::Index3& dims = grid.dims();
    Solid solid{occupancy, grid.voxelFromPatientLinear() * m_geometry.patientFromVoxelLinear(),
                grid.voxelFromPatient(m_geometry.origin()),
                Eigen::Vector3d(dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0)};
    const Eigen::Vector3d whole = solid.offset.array().round();
    solid.onGrid = (solid.fromCt - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kSameGrid &&
                   (solid.offset - whole).cwiseAbs().maxCoeff() < kSameGrid &&
                   endsInAir(*occupancy);
    m_solids.push_back(std::move(solid));
  }
  TissueBricks bricks = keptBricks(tissue, kept);
  m_bricks = bricks.dims;
  m_distance = std::move(bricks.distance);
  m_steepness = std::move(bricks.steepness);
}

// Cell and weights of a voxel position in the hull of the CT's grid; shared by CT and mask. Not a
// volume::TrilinearCell: the servo samples thousands of times in a tick, at positions known to be
// in the hull, and reads the corners of CT and mask at offsets from one base.
struct HapticField::Cell
{
  int i, j, k;
  std::size_t base, dx, dy, dz; // voxels
  double x, y, z;               // weights of the upper corners

  template <class Corner>
  double interpolate(const Corner& at) const noexcept
  {
    return volume::interpolateCell<double>(at(0), at(dx), at(dy), at(dy + dx), at(dz), at(dz + dx),
                                           at(dz + dy), at(dz + dy + dx), x, y, z);
  }
};

[[gnu::always_inline]] inline HapticField::Cell
HapticField::cellAt(const Eigen::Vector3d& voxel, const core::Index3& dims) noexcept
{
  Cell cell{};
  // Positions are not negative: truncation rounds down.
  cell.i = std::min(static_cast<int>(voxel.x()), std::max(dims[0] - 2, 0));
  cell.j = std::min(static_cast<int>(voxel.y()), std::max(dims[1] - 2, 0));
  cell.k = std::min(static_cast<int>(voxel.z()), std::max(dims[2] - 2, 0));
  cell.x = voxel.x() - cell.i;
  cell.y = voxel.y() - cell.j;
  cell.z = voxel.z() - cell.k;
  const auto row = static_cast<std::size_t>(dims[0]);
  const std::size_t slice = row * static_cast<std::size_t>(dims[1]);
  cell.base = static_cast<std::size_t>(cell.i) + row * static_cast<std::size_t>(cell.j) +
              slice * static_cast<std::size_t>(cell.k);
  cell.dx = dims[0] > 1 ? 1 : 0;
  cell.dy = dims[1] > 1 ? row : 0;
  cell.dz = dims[2] > 1 ? slice : 0;
  return cell;
}

[[gnu::always_inline]] inline double HapticField::hull(const Eigen::Vector3d& voxel) const noexcept
{
  return kHullSlope * std::min(voxel.minCoeff(), (m_last - voxel).minCoeff());
}

[[gnu::always_inline]] inline std::size_t
HapticField::brickAt(const Eigen::Vector3d& voxel) const noexcept
{
  return static_cast<std::size_t>(static_cast<int>(voxel.x()) / kTissueBrick) +
         static_cast<std::size_t>(m_bricks[0]) *
             (static_cast<std::size_t>(static_cast<int>(voxel.y()) / kTissueBrick) +
              static_cast<std::size_t>(m_bricks[1]) *
                  static_cast<std::size_t>(static_cast<int>(voxel.z()) / kTissueBrick));
}

[[gnu::always_inline]] inline double HapticField::ct(const Cell& cell) const noexcept
{
  const double hounsfield = m_ct->visit(
      [&cell](const auto& volume)
      {
        const auto* corner = volume.data() + cell.base;
        return cell.interpolate([corner](std::size_t offset)
                                { return static_cast<double>(corner[offset]); });
      });
  const double value = (hounsfield - m_parameters.iso) / m_parameters.scale;
  return std::isnan(value) ? TissueField::kAir : value; // a voxel without a value is not tissue
}

double HapticField::solid(std::size_t n, const Eigen::Vector3d& voxel) const noexcept
{
  const Solid& solid = m_solids[n];
  const Eigen::Vector3d own = solid.fromCt * voxel + solid.offset;
  if ((own.array() < 0.0).any() || (own.array() > solid.last.array()).any())
    return -0.5;
  const Cell cell = cellAt(own, solid.occupancy->geometry().dims());
  const float* corner = solid.occupancy->data() + cell.base;
  return cell.interpolate([corner](std::size_t offset) { return double{corner[offset]}; }) - 0.5;
}

double HapticField::left(const Cell& cell, const volume::MaskState& mask) const noexcept
{
  constexpr int edge = CutMask::kBrickEdge;
  constexpr double full = CutMask::kUntouched;
  const core::Index3& bricks = m_mask->brickDims();
  const auto brickOf = [&](int i, int j, int k)
  {
    return mask.brick(
        static_cast<std::size_t>(i / edge) +
        static_cast<std::size_t>(bricks[0]) *
            (static_cast<std::size_t>(j / edge) +
             static_cast<std::size_t>(bricks[1]) * static_cast<std::size_t>(k / edge)));
  };
  const int i = cell.i % edge, j = cell.j % edge, k = cell.k % edge;
  if (i < edge - 1 && j < edge - 1 && k < edge - 1)
  {
    const CutMask::Brick* brick = brickOf(cell.i, cell.j, cell.k);
    if (!brick)
      return 0.5;
    Cell own = cell;
    own.dx = cell.dx ? 1 : 0;
    own.dy = cell.dy ? edge : 0;
    own.dz = cell.dz ? edge * edge : 0;
    const std::uint16_t* corner = brick->data() + offsetInBrick(i, j, k);
    return own.interpolate([corner](std::size_t offset)
                           { return static_cast<double>(corner[offset]); }) /
               full -
           0.5;
  }
  // Corners numbered 0 to 7, x first.
  Cell numbered = cell;
  numbered.dx = 1;
  numbered.dy = 2;
  numbered.dz = 4;
  return numbered.interpolate(
             [&](std::size_t corner)
             {
               const int ci = cell.i + (corner & 1 && cell.dx ? 1 : 0);
               const int cj = cell.j + (corner & 2 && cell.dy ? 1 : 0);
               const int ck = cell.k + (corner & 4 && cell.dz ? 1 : 0);
               const CutMask::Brick* brick = brickOf(ci, cj, ck);
               return brick ? static_cast<double>((*brick)[offsetInBrick(ci, cj, ck)]) : full;
             }) /
             full -
         0.5;
}

double HapticField::left(const Eigen::Vector3d& voxel, const volume::MaskState& mask) const noexcept
{
  return hull(voxel) >= 0.0 ? left(cellAt(voxel, m_geometry.dims()), mask) : 0.5;
}

FieldSample HapticField::sample(const Eigen::Vector3d& voxel,
                                const volume::MaskState& mask) const noexcept
{
  const double border = hull(voxel);
  FieldSample result;
  if (!(border >= 0.0))
    return result;
  const Cell cell = cellAt(voxel, m_geometry.dims());
  const double bone = ct(cell);
  result.value = bone;
  result.decider = Decider::Ct;
  const bool near = m_distance[brickAt(voxel)] & TissueBricks::kUnionHere;
  for (std::size_t n = 0; n < m_solids.size(); ++n)
  {
    const double inside = near ? solid(n, voxel) : -0.5;
    if (inside > result.value)
    {
      result.value = inside;
      result.decider = Decider::Solid;
      result.solid = static_cast<std::uint8_t>(n);
    }
  }
  const double rest = std::min(left(cell, mask), border);
  result.uncut = result.value;
  result.left = rest;
  if (rest < result.value)
  {
    result.value = rest;
    result.decider = rest == border ? Decider::Hull : Decider::Mask;
  }
  return result;
}

double HapticField::operand(const FieldSample& sample, const Eigen::Vector3d& voxel,
                            const volume::MaskState& mask) const noexcept
{
  switch (sample.decider)
  {
  case Decider::Ct:
    return ct(cellAt(voxel, m_geometry.dims()));
  case Decider::Solid:
    return solid(sample.solid, voxel);
  case Decider::Mask:
    return left(cellAt(voxel, m_geometry.dims()), mask);
  case Decider::Hull:
    return hull(voxel);
  case Decider::Outside:
    break;
  }
  return TissueField::kAir;
}

Eigen::Vector3d HapticField::gradient(const Eigen::Vector3d& voxel, const FieldSample& sample,
                                      const volume::MaskState& mask, double step) const noexcept
{
  if (sample.decider == Decider::Outside)
    return Eigen::Vector3d::Zero();
  if (sample.decider == Decider::Solid)
  {
    const Solid& solid = m_solids[sample.solid];
    return volume::sampleGradient(*solid.occupancy, solid.fromCt * voxel + solid.offset, step);
  }
  return volume::gradientInPatient(
      m_geometry, voxel, step, [&](const Eigen::Vector3d& v) { return operand(sample, v, mask); });
}

double HapticField::slope(const Eigen::Vector3d& voxel, const Eigen::Vector3d& direction,
                          double reach, const volume::MaskState& mask) const noexcept
{
  const Eigen::Vector3d step = m_geometry.voxelFromPatientLinear() * (reach * direction);
  return (sample(voxel + step, mask).value - sample(voxel - step, mask).value) / (2.0 * reach);
}

double HapticField::clearance(const Eigen::Vector3d& voxel) const noexcept
{
  const double border = hull(voxel);
  if (!(border >= 0.0))
  {
    const Eigen::Array3d beyond = (-voxel.array()).max(voxel.array() - m_last.array()).max(0.0) *
                                  m_geometry.spacing().array();
    return beyond.matrix().norm();
  }
  const int bricks = m_distance[brickAt(voxel)] & ~TissueBricks::kUnionHere;
  if (bricks == 0)
    return 0.0;
  double toFace = kTissueBrick;
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    const double within = inBrick(voxel[a]);
    toFace = std::min({toFace, within, kTissueBrick - within});
  }
  return ((bricks - 1) * kTissueBrick + toFace) * m_voxel;
}

double HapticField::freeRadius(const Eigen::Vector3d& voxel,
                               const FieldSample& sample) const noexcept
{
  if (sample.decider == Decider::Outside || !(sample.value < 0.0))
    return 0.0;
  // The steepness of a brick holds up to one voxel beyond it.
  double within = kTissueBrick;
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    const double at = inBrick(voxel[a]);
    within = std::min({within, at + 1.0, kTissueBrick + 1.0 - at});
  }
  const double byTissue = std::min(within * m_voxel, -sample.uncut / steepness(voxel));
  return std::max({0.0, byTissue, -sample.left / m_leftSteepness});
}

double HapticField::steepness(const Eigen::Vector3d& voxel) const noexcept
{
  const Eigen::Vector3d inside = voxel.cwiseMax(0.0).cwiseMin(m_last);
  return double{TissueBricks::steepnessOf()[m_steepness[brickAt(inside)]]} + 1e-6;
}

namespace
{

// The voxels of a brick that are in the grid: take(n, i, j, k), n counting all.
template <class Take>
void forEachVoxel(const core::Index3& brick, const core::Index3& dims, const Take& take) noexcept
{
  const core::Index3 first{kTissueBrick * brick[0], kTissueBrick * brick[1],
                           kTissueBrick * brick[2]};
  std::size_t n = 0;
  for (int k = first[2]; k <= first[2] + kTissueBrick; ++k)
    for (int j = first[1]; j <= first[1] + kTissueBrick; ++j)
      for (int i = first[0]; i <= first[0] + kTissueBrick; ++i, ++n)
        if (i < dims[0] && j < dims[1] && k < dims[2])
          take(n, i, j, k);
}

} // namespace

void HapticField::brickValues(const core::Index3& brick, const volume::MaskState& mask,
                              BrickValues& values) const noexcept
{
  const core::Index3& dims = m_geometry.dims();
  const auto forEach = [&](const auto& take) { forEachVoxel(brick, dims, take); };
  const auto air = static_cast<float>(TissueField::kAir);
  values.tissues = 1;
  values.others = false;
  values.tissue[0].fill(air);
  values.hull.fill(air);
  const auto row = static_cast<std::size_t>(dims[0]);
  const std::size_t slice = row * static_cast<std::size_t>(dims[1]);
  m_ct->visit(
      [&](const auto& volume)
      {
        const auto* voxels = volume.data();
        const auto iso = static_cast<float>(m_parameters.iso);
        const auto perUnit = static_cast<float>(1.0 / m_parameters.scale);
        forEach(
            [&](std::size_t n, int i, int j, int k)
            {
              const float value =
                  (static_cast<float>(
                       voxels[static_cast<std::size_t>(i) + row * static_cast<std::size_t>(j) +
                              slice * static_cast<std::size_t>(k)]) -
                   iso) *
                  perUnit;
              values.tissue[0][n] = std::isnan(value) ? air : value;
            });
      });
  const Eigen::Vector3d corner(kTissueBrick * brick[0], kTissueBrick * brick[1],
                               kTissueBrick * brick[2]);
  if (m_distance[brickAt(corner)] & TissueBricks::kUnionHere)
    for (std::size_t s = 0; s < m_solids.size(); ++s)
    {
      if (!m_solids[s].onGrid)
      {
        values.others = true;
        continue;
      }
      std::array<float, 27> occupancy;
      occupancy.fill(air);
      forEach([&](std::size_t n, int i, int j, int k)
              { occupancy[n] = static_cast<float>(solid(s, Eigen::Vector3d(i, j, k))); });
      if (!(*std::max_element(occupancy.begin(), occupancy.end()) > 0.0F))
        continue;
      if (values.tissues < values.tissue.size())
      {
        values.tissue[values.tissues++] = occupancy;
        continue;
      }
      std::array<float, 27>& last = values.tissue.back();
      std::transform(last.begin(), last.end(), occupancy.begin(), last.begin(),
                     [](float a, float b) { return std::max(a, b); });
    }
  // A voxel or more away only the hull's sign matters.
  if (!maskValues(brick, mask, values.mask))
    values.hull.fill(static_cast<float>(kHullSlope));
  else
    forEach([&](std::size_t n, int i, int j, int k)
            { values.hull[n] = static_cast<float>(hull(Eigen::Vector3d(i, j, k))); });
}

bool HapticField::maskValues(const core::Index3& brick, const volume::MaskState& mask,
                             std::array<float, 27>& values) const noexcept
{
  if (untouched(brick, mask))
  {
    values.fill(0.5F);
    return false;
  }
  values.fill(static_cast<float>(TissueField::kAir));
  constexpr int edge = CutMask::kBrickEdge;
  const core::Index3& bricks = m_mask->brickDims();
  std::size_t known = static_cast<std::size_t>(-1);
  const CutMask::Brick* cut = nullptr;
  forEachVoxel(brick, m_geometry.dims(),
               [&](std::size_t n, int i, int j, int k)
               {
                 const std::size_t at =
                     static_cast<std::size_t>(i / edge) +
                     static_cast<std::size_t>(bricks[0]) *
                         (static_cast<std::size_t>(j / edge) +
                          static_cast<std::size_t>(bricks[1]) * static_cast<std::size_t>(k / edge));
                 if (at != known)
                 {
                   known = at;
                   cut = mask.brick(at);
                 }
                 values[n] = cut ? static_cast<float>((*cut)[offsetInBrick(i, j, k)]) /
                                           static_cast<float>(CutMask::kUntouched) -
                                       0.5F
                                 : 0.5F;
               });
  return true;
}

bool HapticField::untouched(const core::Index3& brick, const volume::MaskState& mask) const noexcept
{
  const core::Index3& bricks = m_mask->brickDims();
  std::array<std::array<int, 2>, 3> range;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const int first = kTissueBrick * brick[a];
    const int last = first + kTissueBrick;
    if (first == 0 || last >= m_geometry.dims()[a] - 1)
      return false;
    range[a] = {first / CutMask::kBrickEdge, last / CutMask::kBrickEdge};
  }
  for (int k = range[2][0]; k <= range[2][1]; ++k)
    for (int j = range[1][0]; j <= range[1][1]; ++j)
      for (int i = range[0][0]; i <= range[0][1]; ++i)
        if (mask.brick(static_cast<std::size_t>(i) +
                       static_cast<std::size_t>(bricks[0]) *
                           (static_cast<std::size_t>(j) +
                            static_cast<std::size_t>(bricks[1]) * static_cast<std::size_t>(k))))
          return false;
  return true;
}

double HapticField::rest(const Eigen::Vector3d& voxel, const volume::MaskState& mask) const noexcept
{
  const double border = hull(voxel);
  return border >= 0.0 ? std::min(left(cellAt(voxel, m_geometry.dims()), mask), border) : border;
}

double HapticField::tissueOf(std::size_t of, const Eigen::Vector3d& voxel) const noexcept
{
  if (!(hull(voxel) >= 0.0))
    return TissueField::kAir;
  return of == kCt ? ct(cellAt(voxel, m_geometry.dims())) : solid(of, voxel);
}

std::array<float, 8> HapticField::unionCell(std::size_t n, const core::Index3& cell) const noexcept
{
  const volume::Volume<float>& occupancy = *m_solids[n].occupancy;
  const core::Index3& dims = occupancy.geometry().dims();
  const auto row = static_cast<std::size_t>(dims[0]);
  const std::size_t slice = row * static_cast<std::size_t>(dims[1]);
  const float* first = occupancy.data() + static_cast<std::size_t>(cell[0]) +
                       row * static_cast<std::size_t>(cell[1]) +
                       slice * static_cast<std::size_t>(cell[2]);
  std::array<float, 8> corners;
  for (std::size_t c = 0; c < 8; ++c)
    corners[c] = first[(c & 1) + row * ((c >> 1) & 1) + slice * (c >> 2)] - 0.5F;
  return corners;
}

std::vector<core::LockedMemory::Range> HapticField::memory() const
{
  std::vector<core::LockedMemory::Range> ranges;
  m_ct->visit([&](const auto& volume) { ranges.push_back({volume.data(), volume.bytes()}); });
  for (const Solid& solid : m_solids)
    ranges.push_back({solid.occupancy->data(), solid.occupancy->bytes()});
  ranges.push_back({m_distance.data(), m_distance.size() * sizeof(m_distance.front())});
  ranges.push_back({m_steepness.data(), m_steepness.size() * sizeof(m_steepness.front())});
  return ranges;
}

} // namespace petrous::haptics
