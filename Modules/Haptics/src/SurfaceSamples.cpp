#include "SurfaceSamples.h"

#include <algorithm>
#include <cmath>

#include "TissueBricks.h"

namespace petrous::haptics
{

namespace
{
constexpr std::size_t kMostSamples = 32768; // of a part
constexpr double kExtra = 1.0;              // voxels that samples are found beyond what is asked
constexpr double kSagitta = 0.02;     // mm, of a thin tool between two samples of a flat surface
constexpr float kFlat = 0.2F;         // of the slope: how much a cell's edges may differ
constexpr int kBulging = 2;           // lines a side of a cell that is not flat
constexpr int kMostLines = 4;         // a side
constexpr std::size_t kBrickCost = 3; // in samples of the field
constexpr int kRenewal = 16;          // ticks, after a cut
} // namespace

SurfaceSamples::SurfaceSamples(const HapticField& field, const ToolSolid& solid)
  : m_field(field)
  , m_parts(solid)
  , m_extra(kExtra * field.voxel())
  , m_halfCell(0.5 * field.geometry().spacing().norm())
{
  if (!any())
    return;
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
    if (m_parts.has(part))
    {
      // Two samples are at most a line's distance apart, so the tool sinks in between by the
      // sagitta of half of it.
      const double most = 2.0 * std::sqrt(2.0 * kSagitta * m_parts.radius(part));
      const double needed = std::ceil(field.geometry().spacing().maxCoeff() / most);
      m_lines[part] = static_cast<int>(std::clamp(needed, 1.0, double{kMostLines}));
      m_lists[part].places.resize(kMostSamples);
    }
  const core::Index3& dims = field.brickDims();
  const std::size_t bricks = static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]) *
                             static_cast<std::size_t>(dims[2]);
  m_empty.assign((bricks + 63) / 64, 0);
}

void SurfaceSamples::look(const volume::MaskState& state) noexcept
{
  m_samples = 0;
  if (!any())
    return;
  const bool raised = m_state && m_raises != state.raises();
  if (raised)
    std::fill(m_empty.begin(), m_empty.end(), 0);
  if (!m_state || raised)
    forget();
  // A cut only takes tissue away, where the burr is: what the others meet is renewed later.
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
  {
    List& list = m_lists[part];
    list.cut = list.cut || m_number != state.number();
    if (list.cut && (part == SolidParts::kBall || ++list.age >= kRenewal))
      list.forget();
  }
  m_state = &state;
  m_number = state.number();
  m_raises = state.raises();
}

void SurfaceSamples::forget() noexcept
{
  for (List& list : m_lists)
    list.forget();
}

void SurfaceSamples::moved(double linear, double angular) noexcept
{
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
    m_lists[part].left -=
        linear + angular * (m_parts.reach(part) + std::max(m_lists[part].left, 0.0));
}

void SurfaceSamples::find(const Pose& pose, double linear, double angular, double beyond) noexcept
{
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
  {
    // A sample turns about the tool on an arm that is longer than the part by its distance.
    const double near = linear + angular * m_parts.reach(part) + beyond;
    const double way = near + angular * (near + m_extra);
    if (m_parts.has(part) && m_lists[part].left < way)
      gather(part, pose, way + m_extra, false);
  }
}

void SurfaceSamples::findInside(const Pose& pose) noexcept
{
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
    if (m_parts.has(part))
      gather(part, pose, m_extra, true);
}

double SurfaceSamples::depth(const Pose& pose) const noexcept
{
  double least = -kTolerance;
  const Eigen::Matrix3d toTool = pose.rotation.toRotationMatrix().transpose();
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
    for (std::size_t n = 0; n < m_lists[part].count; ++n)
      least = std::min(least,
                       m_parts.distance(part, toTool * (m_lists[part].places[n] - pose.position)));
  return least < -kTolerance ? -least : 0.0;
}

bool SurfaceSamples::freeAt(const Pose& pose) noexcept
{
  forget();
  findInside(pose);
  return !(depth(pose) > 0.0);
}

// Halves a box of bricks until it is far from the part's surface, or from all tissue, or one brick.
void SurfaceSamples::gather(std::size_t part, const Pose& pose, double margin, bool inside) noexcept
{
  List& list = m_lists[part];
  list.forget();
  list.left = margin;
  const core::GridGeometry& grid = m_field.geometry();
  const Eigen::Matrix3d toTool = pose.rotation.toRotationMatrix().transpose();
  // The part's box, in bricks.
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  if (part != SolidParts::kBall)
  {
    from.z() = m_parts.cylinder(part).from;
    to.z() = m_parts.cylinder(part).to;
  }
  const Eigen::Vector3d ends[] = {grid.voxelFromPatient(pose * from),
                                  grid.voxelFromPatient(pose * to)};
  const Eigen::Vector3d half =
      (m_parts.radius(part) + margin) * grid.spacing().cwiseInverse() + Eigen::Vector3d::Ones();
  const core::Index3& dims = m_field.brickDims();
  struct Box
  {
    core::Index3 lower, upper; // half open
  };
  Box all;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double low = std::min(ends[0][axis], ends[1][axis]) - half[axis];
    const double high = std::max(ends[0][axis], ends[1][axis]) + half[axis];
    // Compared as numbers: a tool may be anywhere.
    if (!(high > 0.0) || !(low < kTissueBrick * dims[a]))
      return;
    all.lower[a] = static_cast<int>(std::max(0.0, low)) / kTissueBrick;
    all.upper[a] =
        static_cast<int>(std::min(double{kTissueBrick} * dims[a] - 1.0, high)) / kTissueBrick + 1;
  }
  std::array<Box, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = all;
  const Eigen::Vector3d last =
      Eigen::Vector3d(grid.dims()[0], grid.dims()[1], grid.dims()[2]) - Eigen::Vector3d::Ones();
  while (depth > 0)
  {
    const Box box = stack[--depth];
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
    for (std::size_t a = 0; a < 3; ++a)
    {
      lower[static_cast<Eigen::Index>(a)] = kTissueBrick * box.lower[a];
      upper[static_cast<Eigen::Index>(a)] = kTissueBrick * box.upper[a];
    }
    upper = upper.cwiseMin(last);
    const Eigen::Vector3d extent = (upper - lower).cwiseProduct(grid.spacing());
    const Eigen::Vector3d middle = 0.5 * (lower + upper);
    const double radius = 0.5 * extent.norm();
    const double distance =
        m_parts.distance(part, toTool * (grid.patientFromVoxel(middle) - pose.position));
    if (distance > radius + margin || (!inside && distance < -radius))
      continue;
    if (m_field.clearance(middle) > radius)
      continue;
    Eigen::Index longest = 0;
    int most = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const int count = box.upper[a] - box.lower[a];
      if (count > 1 && (most == 0 || extent[static_cast<Eigen::Index>(a)] > extent[longest]))
      {
        longest = static_cast<Eigen::Index>(a);
        most = count;
      }
    }
    if (most == 0)
    {
      addBrick(part, box.lower, pose, toTool, margin, inside);
      continue;
    }
    const auto axis = static_cast<std::size_t>(longest);
    const int cut = (box.lower[axis] + box.upper[axis]) / 2;
    Box first = box;
    Box second = box;
    first.upper[axis] = cut;
    second.lower[axis] = cut;
    stack[depth++] = second;
    stack[depth++] = first;
  }
}

void SurfaceSamples::addBrick(std::size_t part, const core::Index3& brick, const Pose& pose,
                              const Eigen::Matrix3d& toTool, double margin, bool inside) noexcept
{
  const core::Index3& bricks = m_field.brickDims();
  const std::size_t index =
      static_cast<std::size_t>(brick[0]) +
      static_cast<std::size_t>(bricks[0]) *
          (static_cast<std::size_t>(brick[1]) +
           static_cast<std::size_t>(bricks[1]) * static_cast<std::size_t>(brick[2]));
  const std::uint64_t bit = std::uint64_t{1} << (index % 64);
  if (m_empty[index / 64] & bit)
    return;
  m_samples += kBrickCost;
  HapticField::BrickValues values;
  m_field.brickValues(brick, *m_state, values);
  const core::GridGeometry& grid = m_field.geometry();
  const core::Index3& dims = grid.dims();
  bool empty = true;
  for (int c = 0; c < 8; ++c)
  {
    const core::Index3 in{c & 1, (c >> 1) & 1, c >> 2};
    const core::Index3 cell{kTissueBrick * brick[0] + in[0], kTissueBrick * brick[1] + in[1],
                            kTissueBrick * brick[2] + in[2]};
    if (cell[0] + 1 >= dims[0] || cell[1] + 1 >= dims[1] || cell[2] + 1 >= dims[2])
      continue;
    std::array<float, 8> uncut;
    std::array<float, 8> left;
    const auto base = static_cast<std::size_t>(in[0] + 3 * (in[1] + 3 * in[2]));
    for (std::size_t n = 0; n < 8; ++n)
    {
      const std::size_t at = base + (n & 1) + 3 * ((n >> 1) & 1) + 9 * (n >> 2);
      uncut[n] = values.uncut[at];
      left[n] = values.left[at];
    }
    const auto [uncutLeast, uncutMost] = std::minmax_element(uncut.begin(), uncut.end());
    const auto [leftLeast, leftMost] = std::minmax_element(left.begin(), left.end());
    if (!(*uncutMost > 0.0F) || !(*leftMost > 0.0F))
      continue;
    empty = false;
    if (*uncutLeast > 0.0F && *leftLeast > 0.0F)
      continue;
    const Eigen::Vector3d middle =
        grid.patientFromVoxel(Eigen::Vector3d(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5));
    const double distance = m_parts.distance(part, toTool * (middle - pose.position));
    if (distance > m_halfCell + margin || (!inside && distance < -m_halfCell))
      continue;
    addCell(part, cell, uncut, left, pose, toTool, margin);
  }
  if (empty)
    m_empty[index / 64] |= bit;
}

namespace
{

// Of a trilinear cell: whether its edges along each axis are about alike.
bool isFlat(const std::array<float, 8>& f) noexcept
{
  std::array<float, 3> mean{};
  float spread = 0.0F;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::size_t step = std::size_t{1} << a;
    float least = 0.0F;
    float most = 0.0F;
    bool first = true;
    for (std::size_t n = 0; n < 8; ++n)
    {
      if (n & step)
        continue;
      const float rise = f[n | step] - f[n];
      mean[a] += 0.25F * rise;
      least = first ? rise : std::min(least, rise);
      most = first ? rise : std::max(most, rise);
      first = false;
    }
    spread = std::max(spread, most - least);
  }
  return spread * spread <=
         kFlat * kFlat * (mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
}

// Where a + (b - a) t > 0, within 0 to 1.
struct Span
{
  float from = 0.0F;
  float to = 1.0F;
};

Span positive(float a, float b) noexcept
{
  if (a > 0.0F)
    return {0.0F, b > 0.0F ? 1.0F : a / (a - b)};
  if (b > 0.0F)
    return {a / (a - b), 1.0F};
  return {1.0F, 0.0F};
}

} // namespace

template <class Corner>
void SurfaceSamples::addCell(std::size_t part, const core::Index3& cell, const Corner& uncut,
                             const Corner& left, const Pose& pose, const Eigen::Matrix3d& toTool,
                             double margin) noexcept
{
  List& list = m_lists[part];
  const core::GridGeometry& grid = m_field.geometry();
  const bool cut = *std::min_element(left.begin(), left.end()) <= 0.0F;
  const bool grown = *std::min_element(uncut.begin(), uncut.end()) <= 0.0F;
  const bool flat = cut != grown && isFlat(cut ? left : uncut);
  const int lines = flat ? m_lines[part] : std::min(kBulging * m_lines[part], kMostLines);
  const float step = 1.0F / static_cast<float>(lines);
  const auto add = [&](std::size_t along, float at, float u, float v)
  {
    if (list.count == kMostSamples)
      return;
    Eigen::Vector3d voxel(cell[0], cell[1], cell[2]);
    voxel[static_cast<Eigen::Index>(along)] += at;
    voxel[static_cast<Eigen::Index>((along + 1) % 3)] += u;
    voxel[static_cast<Eigen::Index>((along + 2) % 3)] += v;
    const Eigen::Vector3d place = grid.patientFromVoxel(voxel);
    if (m_parts.distance(part, toTool * (place - pose.position)) <= margin)
      list.places[list.count++] = place;
  };
  for (std::size_t along = 0; along < 3; ++along)
  {
    const std::size_t a = std::size_t{1} << along;
    const std::size_t b = std::size_t{1} << ((along + 1) % 3);
    const std::size_t c = std::size_t{1} << ((along + 2) % 3);
    for (int i = 0; i < lines; ++i)
      for (int j = 0; j < lines; ++j)
      {
        const float u = step * static_cast<float>(i);
        const float v = step * static_cast<float>(j);
        const auto at = [&](const Corner& f, std::size_t side)
        {
          const float low = f[side] + u * (f[side | b] - f[side]);
          const float high = f[side | c] + u * (f[side | b | c] - f[side | c]);
          return low + v * (high - low);
        };
        const float bone[] = {at(uncut, 0), at(uncut, a)};
        const float rest[] = {at(left, 0), at(left, a)};
        const Span inBone = positive(bone[0], bone[1]);
        const Span inRest = positive(rest[0], rest[1]);
        const float from = std::max(inBone.from, inRest.from);
        const float to = std::min(inBone.to, inRest.to);
        if (!(from < to))
          continue;
        // An end may be a crossing itself: on the grid's border f is 0.
        if (std::min(bone[0], rest[0]) <= 0.0F)
          add(along, from, u, v);
        if (std::min(bone[1], rest[1]) <= 0.0F)
          add(along, to, u, v);
      }
  }
}

} // namespace petrous::haptics
