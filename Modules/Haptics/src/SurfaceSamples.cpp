#include "SurfaceSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
constexpr float kWithin = 1e-5F;      // of f: another tissue goes on there
constexpr int kHalvings = 10;         // of a line in a union's cell, to a cut
} // namespace

SurfaceSamples::SurfaceSamples(const HapticField& field, const ToolSolid& solid)
  : m_field(field)
  , m_parts(solid)
  , m_extra(kExtra * field.voxel())
{
  if (!any())
    return;
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
    if (m_parts.has(part))
      m_lists[part].places.resize(kMostSamples);
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
  const Search search{part, pose, pose.rotation.toRotationMatrix().transpose(), margin, inside};
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
    if (!reaches(search, grid.patientFromVoxel(middle), radius))
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
      addBrick(search, box.lower);
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

bool SurfaceSamples::reaches(const Search& search, const Eigen::Vector3d& middle,
                             double radius) const noexcept
{
  const double distance =
      m_parts.distance(search.part, search.toTool * (middle - search.pose.position));
  return distance <= radius + search.margin && (search.inside || distance >= -radius);
}

void SurfaceSamples::add(const Search& search, const Eigen::Vector3d& place) noexcept
{
  List& list = m_lists[search.part];
  if (list.count < kMostSamples &&
      m_parts.distance(search.part, search.toTool * (place - search.pose.position)) <=
          search.margin)
    list.places[list.count++] = place;
}

// Two samples of a flat surface are at most a line's distance apart, so the tool sinks in between
// by the sagitta of half of it.
int SurfaceSamples::linesFor(std::size_t part, const core::GridGeometry& grid,
                             bool flat) const noexcept
{
  const double most = 2.0 * std::sqrt(2.0 * kSagitta * m_parts.radius(part));
  const double needed = std::ceil(grid.spacing().maxCoeff() / most);
  const int lines = static_cast<int>(std::clamp(needed, 1.0, double{kMostLines}));
  return flat ? lines : std::min(kBulging * lines, kMostLines);
}

namespace
{

using Corners = std::array<float, 8>; // of a trilinear cell, first axis fastest

float least(const Corners& f) noexcept
{
  return *std::min_element(f.begin(), f.end());
}

float most(const Corners& f) noexcept
{
  return *std::max_element(f.begin(), f.end());
}

// Whether its edges along each axis are about alike.
bool isFlat(const Corners& f) noexcept
{
  std::array<float, 3> mean{};
  float spread = 0.0F;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::size_t step = std::size_t{1} << a;
    float shortest = std::numeric_limits<float>::infinity();
    float longest = -shortest;
    for (std::size_t n = 0; n < 8; ++n)
    {
      if (n & step)
        continue;
      const float rise = f[n | step] - f[n];
      mean[a] += 0.25F * rise;
      shortest = std::min(shortest, rise);
      longest = std::max(longest, rise);
    }
    spread = std::max(spread, longest - shortest);
  }
  return spread * spread <=
         kFlat * kFlat * (mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
}

// A line through a cell along an axis.
struct Line
{
  std::size_t along;
  float u, v; // where it is on the two axes that follow

  // f where it enters and leaves.
  std::array<float, 2> ends(const Corners& f) const noexcept
  {
    const std::size_t a = std::size_t{1} << along;
    const std::size_t b = std::size_t{1} << ((along + 1) % 3);
    const std::size_t c = std::size_t{1} << ((along + 2) % 3);
    const auto at = [&](std::size_t side)
    {
      const float low = f[side] + u * (f[side | b] - f[side]);
      const float high = f[side | c] + u * (f[side | b | c] - f[side | c]);
      return low + v * (high - low);
    };
    return {at(0), at(a)};
  }

  Eigen::Vector3d at(const core::Index3& cell, float t) const noexcept // voxel
  {
    Eigen::Vector3d voxel(cell[0], cell[1], cell[2]);
    voxel[static_cast<Eigen::Index>(along)] += t;
    voxel[static_cast<Eigen::Index>((along + 1) % 3)] += u;
    voxel[static_cast<Eigen::Index>((along + 2) % 3)] += v;
    return voxel;
  }
};

template <class Take>
void forEachLine(int lines, const Take& take)
{
  const float step = 1.0F / static_cast<float>(lines);
  for (std::size_t along = 0; along < 3; ++along)
    for (int i = 0; i < lines; ++i)
      for (int j = 0; j < lines; ++j)
        take(Line{along, step * static_cast<float>(i), step * static_cast<float>(j)});
}

// Where on a line an operand is above 0.
struct Span
{
  float from = 0.0F;
  float to = 1.0F;

  bool any() const noexcept { return from < to; }
};

Span positive(const std::array<float, 2>& f) noexcept
{
  const auto [a, b] = f;
  if (a > 0.0F)
    return {0.0F, b > 0.0F ? 1.0F : a / (a - b)};
  if (b > 0.0F)
    return {a / (a - b), 1.0F};
  return {1.0F, 0.0F};
}

Span both(const Span& a, const Span& b) noexcept
{
  return {std::max(a.from, b.from), std::min(a.to, b.to)};
}

Corners cornersOf(const std::array<float, 27>& values, std::size_t base) noexcept
{
  Corners corners;
  for (std::size_t n = 0; n < 8; ++n)
    corners[n] = values[base + (n & 1) + 3 * ((n >> 1) & 1) + 9 * (n >> 2)];
  return corners;
}

} // namespace

struct SurfaceSamples::Cell
{
  std::array<Corners, HapticField::BrickValues::kMostTissues> tissue;
  std::size_t tissues = 0; // those that are above 0 somewhere in it
  Corners mask;
  Corners hull;
  bool others = false; // there may be unions with cells of their own
};

void SurfaceSamples::addBrick(const Search& search, const core::Index3& brick) noexcept
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
  const double halfCell = 0.5 * grid.spacing().norm();
  const core::Index3& dims = grid.dims();
  bool empty = !values.others;
  for (int c = 0; c < 8; ++c)
  {
    const core::Index3 in{c & 1, (c >> 1) & 1, c >> 2};
    const core::Index3 cell{kTissueBrick * brick[0] + in[0], kTissueBrick * brick[1] + in[1],
                            kTissueBrick * brick[2] + in[2]};
    if (cell[0] + 1 >= dims[0] || cell[1] + 1 >= dims[1] || cell[2] + 1 >= dims[2])
      continue;
    const auto base = static_cast<std::size_t>(in[0] + 3 * (in[1] + 3 * in[2]));
    Cell corners;
    corners.mask = cornersOf(values.mask, base);
    if (!(most(corners.mask) > 0.0F))
      continue;
    corners.hull = cornersOf(values.hull, base);
    const bool whole = least(corners.mask) > 0.0F && least(corners.hull) > 0.0F;
    bool full = false;
    for (std::size_t n = 0; n < values.tissues; ++n)
    {
      Corners& f = corners.tissue[corners.tissues];
      f = cornersOf(values.tissue[n], base);
      full = full || least(f) > 0.0F;
      if (most(f) > 0.0F)
        ++corners.tissues;
    }
    corners.others = values.others;
    if (corners.tissues == 0 && (whole || !corners.others))
      continue;
    empty = false;
    if (whole && full)
      continue;
    const Eigen::Vector3d middle =
        grid.patientFromVoxel(Eigen::Vector3d(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5));
    if (reaches(search, middle, halfCell))
      addCell(search, cell, corners);
  }
  if (empty)
    m_empty[index / 64] |= bit;
  if (!values.others)
    return;
  const bool whole = *std::min_element(values.mask.begin(), values.mask.end()) > 0.0F &&
                     *std::min_element(values.hull.begin(), values.hull.end()) > 0.0F;
  for (std::size_t n = 0; n < m_field.unions(); ++n)
    if (!m_field.onGrid(n))
      addUnion(search, brick, n, whole);
}

void SurfaceSamples::addCell(const Search& search, const core::Index3& cell,
                             const Cell& values) noexcept
{
  const core::GridGeometry& grid = m_field.geometry();
  // One operand that crosses 0 and is about flat.
  const Corners* crossing = nullptr;
  int crossings = values.others ? 1 : 0;
  const auto look = [&](const Corners& f)
  {
    if (least(f) > 0.0F)
      return;
    crossing = &f;
    ++crossings;
  };
  for (std::size_t n = 0; n < values.tissues; ++n)
    look(values.tissue[n]);
  look(values.mask);
  look(values.hull);
  const bool flat = crossings == 1 && crossing && isFlat(*crossing);
  const auto place = [&](const Line& line, float t)
  { return Eigen::Vector3d(grid.patientFromVoxel(line.at(cell, t))); };
  forEachLine(linesFor(search.part, grid, flat),
              [&](const Line& line)
              {
                const std::array<float, 2> mask = line.ends(values.mask);
                const std::array<float, 2> hull = line.ends(values.hull);
                const Span rest = both(positive(mask), positive(hull));
                if (!rest.any())
                  return;
                // An end may be a crossing itself: on the grid's border f is 0.
                const bool restFrom = std::min(mask[0], hull[0]) <= 0.0F;
                const bool restTo = std::min(mask[1], hull[1]) <= 0.0F;
                std::array<std::array<float, 2>, HapticField::BrickValues::kMostTissues> f;
                for (std::size_t n = 0; n < values.tissues; ++n)
                  f[n] = line.ends(values.tissue[n]);
                const auto within = [&](std::size_t first, std::size_t last, float t)
                {
                  return std::any_of(f.begin() + static_cast<std::ptrdiff_t>(first),
                                     f.begin() + static_cast<std::ptrdiff_t>(last),
                                     [t](const std::array<float, 2>& ends)
                                     { return ends[0] + t * (ends[1] - ends[0]) > kWithin; });
                };
                const auto add = [&](std::size_t n, float t)
                {
                  // Not where another tissue goes on; where a cut ends several, once.
                  if (!within(0, n, t) && !within(n + 1, values.tissues, t) &&
                      !(values.others && inOthers(line.at(cell, t), HapticField::kCt)))
                    this->add(search, place(line, t));
                };
                for (std::size_t n = 0; n < values.tissues; ++n)
                {
                  const Span own = positive(f[n]);
                  const Span span = both(own, rest);
                  if (!span.any())
                    continue;
                  if (f[n][0] <= 0.0F && own.from >= rest.from)
                    add(n, span.from);
                  else if (restFrom && !within(0, n, span.from))
                    this->add(search, place(line, span.from));
                  if (f[n][1] <= 0.0F && own.to <= rest.to)
                    add(n, span.to);
                  else if (restTo && !within(0, n, span.to))
                    this->add(search, place(line, span.to));
                }
                if (!values.others)
                  return;
                // What was cut out of a union between the corners of the CT.
                if (restFrom && !within(0, values.tissues, rest.from) &&
                    inOthers(line.at(cell, rest.from), HapticField::kCt))
                  this->add(search, place(line, rest.from));
                if (restTo && !within(0, values.tissues, rest.to) &&
                    inOthers(line.at(cell, rest.to), HapticField::kCt))
                  this->add(search, place(line, rest.to));
              });
}

// Whether a place lies in another union: beside the CT's cells those with cells of their own.
bool SurfaceSamples::inOthers(const Eigen::Vector3d& voxel, std::size_t but) const noexcept
{
  for (std::size_t n = 0; n < m_field.unions(); ++n)
    if (n != but && !(but == HapticField::kCt && m_field.onGrid(n)) &&
        m_field.tissueOf(n, voxel) > kWithin)
      return true;
  return false;
}

// The cells of a union with voxels of its own that reach into the brick.
void SurfaceSamples::addUnion(const Search& search, const core::Index3& brick, std::size_t n,
                              bool whole) noexcept
{
  const core::Index3& dims = m_field.geometry().dims();
  const core::GridGeometry& own = m_field.unionGrid(n);
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = -lower;
  for (int c = 0; c < 8; ++c)
  {
    Eigen::Vector3d corner;
    for (std::size_t a = 0; a < 3; ++a)
      corner[static_cast<Eigen::Index>(a)] =
          std::min(kTissueBrick * (brick[a] + ((c >> a) & 1)), dims[a] - 1);
    const Eigen::Vector3d at = m_field.unionFromCt(n, corner);
    lower = lower.cwiseMin(at);
    upper = upper.cwiseMax(at);
  }
  core::Index3 first;
  core::Index3 last;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double cells = own.dims()[a] - 1.0;
    if (!(upper[axis] >= 0.0) || !(lower[axis] <= cells) || !(cells >= 1.0))
      return;
    first[a] = static_cast<int>(std::clamp(std::floor(lower[axis]), 0.0, cells - 1.0));
    last[a] = static_cast<int>(std::clamp(std::floor(upper[axis]), 0.0, cells - 1.0));
  }
  const double halfCell = 0.5 * own.spacing().norm();
  core::Index3 cell;
  for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2])
    for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1])
      for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0])
      {
        ++m_samples;
        const Corners share = m_field.unionCell(n, cell);
        if (!(most(share) > 0.0F))
          continue;
        bool border = false;
        for (std::size_t a = 0; a < 3; ++a)
          border = border || cell[a] == 0 || cell[a] == own.dims()[a] - 2;
        if (least(share) > 0.0F && whole && !border)
          continue;
        const Eigen::Vector3d middle =
            own.patientFromVoxel(Eigen::Vector3d(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5));
        if (reaches(search, middle, halfCell))
          addUnionCell(search, brick, n, whole, cell, share);
      }
}

// Of each sample the brick in which it lies is asked, so that none is found twice.
void SurfaceSamples::addUnionCell(const Search& search, const core::Index3& brick, std::size_t n,
                                  bool whole, const core::Index3& cell,
                                  const Corners& share) noexcept
{
  const core::GridGeometry& own = m_field.unionGrid(n);
  const core::GridGeometry& grid = m_field.geometry();
  const auto ctVoxel = [&](const Line& line, float t) -> Eigen::Vector3d
  { return grid.voxelFromPatient(own.patientFromVoxel(line.at(cell, t))); };
  const auto add = [&](const Line& line, float t)
  {
    const Eigen::Vector3d voxel = ctVoxel(line, t);
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double at = voxel[static_cast<Eigen::Index>(a)];
      // The last brick has the voxels at the grid's border.
      const bool tail = brick[a] + 1 == m_field.brickDims()[a];
      if (!(at >= kTissueBrick * brick[a]) || !(tail || at < kTissueBrick * (brick[a] + 1)))
        return;
    }
    if (!(m_field.tissueOf(HapticField::kCt, voxel) > kWithin) && !inOthers(voxel, n))
      this->add(search, grid.patientFromVoxel(voxel));
  };
  const auto rest = [&](const Line& line, float t)
  { return m_field.rest(ctVoxel(line, t), *m_state); };
  forEachLine(linesFor(search.part, own, least(share) <= 0.0F && whole && isFlat(share)),
              [&](const Line& line)
              {
                const std::array<float, 2> f = line.ends(share);
                const Span span = positive(f);
                if (!span.any())
                  return;
                const std::size_t a = line.along;
                const bool from = f[0] <= 0.0F || cell[a] == 0;
                const bool to = f[1] <= 0.0F || cell[a] == own.dims()[a] - 2;
                const bool leftFrom = whole || rest(line, span.from) > 0.0;
                const bool leftTo = whole || rest(line, span.to) > 0.0;
                if (from && leftFrom)
                  add(line, span.from);
                if (to && leftTo)
                  add(line, span.to);
                if (leftFrom == leftTo)
                  return;
                // The cut lies between: on the side of what is left.
                float left = leftFrom ? span.from : span.to;
                float gone = leftFrom ? span.to : span.from;
                for (int halving = 0; halving < kHalvings; ++halving)
                {
                  const float middle = 0.5F * (left + gone);
                  (rest(line, middle) > 0.0 ? left : gone) = middle;
                }
                add(line, left);
              });
}

} // namespace petrous::haptics
