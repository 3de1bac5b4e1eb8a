#include "SurfaceSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "TissueBricks.h"
#include "petrous/Haptics/ShellSweep.h"

namespace petrous::haptics
{

namespace
{
constexpr double kSagitta = 0.02; // mm, of a thin tool between two samples of a flat surface
constexpr float kFlat = 0.2F;     // of the slope: how much parallel edges of a cell may differ
constexpr int kBulging = 2;       // lines per side of a cell that is not flat
constexpr double kBulge = 0.15;   // mm: line spacing that is fine enough for curved cells
constexpr int kMaxLines = 4;      // per side
constexpr int kRenewal = 16;      // ticks, of the handpiece after a cut
// Voxels: lower limits of the margin, however expensive. The ball is searched again after each cut,
// regardless of its motion.
constexpr double kMin = 3.0;
constexpr double kMinAfterCut = 1.0;
constexpr double kMax = 32.0;   // voxels
constexpr double kFirst = 4.0;  // voxels, initial
constexpr double kShrink = 0.7; // of the margin, if there are too many samples
constexpr int kMaxShrinks = 20; // then none are kept
constexpr double kUsed = 0.75;  // of the margin: the next search begins
// Units, see SurfaceSamples::kUnit.
constexpr std::size_t kBoxCost = 4;
constexpr std::size_t kBrickCost = 24;
constexpr std::size_t kMaskCost = 8; // of one that is known, after a cut
constexpr std::size_t kCellCost = 8;
constexpr std::size_t kUnionCellCost = 4;
constexpr std::size_t kCheap = 800; // per search: the next may have a larger margin
constexpr std::size_t kDear = 3000; // per search: the next has a smaller margin
constexpr float kWithin = 1e-5F;    // of f: another tissue continues there
constexpr int kHalvings = 10;       // of a line in a union's cell, to locate a cut
constexpr int kBlock = 4;           // bricks per side of a block
} // namespace

SurfaceSamples::SurfaceSamples(const HapticField& field, const ToolSolid& solid)
  : m_field(field)
  , m_parts(solid)
{
  if (!any())
    return;
  // Written, so that no page faults occur in a tick.
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
    if (m_parts.has(part))
      m_lists[part].places.assign(kMaxSamples, Eigen::Vector3d::Zero());
  m_search.places.assign(kMaxSamples, Eigen::Vector3d::Zero());
  m_search.distances.assign(kMaxSamples, 0.0F);
  std::size_t blocks = 1;
  for (std::size_t a = 0; a < 3; ++a)
  {
    m_blocks[a] = (field.brickDims()[a] + kBlock - 1) / kBlock;
    blocks *= static_cast<std::size_t>(m_blocks[a]);
  }
  m_empty.assign(blocks, 0);
  m_full.assign(blocks, 0);
  m_places.assign(kPlaces, Eigen::Vector3d::Zero());
  m_known.assign(kBricks, Brick{});
  for (List& list : m_lists)
    list.wish = kFirst * field.voxel();
}

void SurfaceSamples::look(const volume::MaskState& state) noexcept
{
  m_work = 0;
  m_cut = false;
  if (!any())
    return;
  const bool raised = m_state && m_raises != state.raises();
  if (raised)
    std::fill(m_empty.begin(), m_empty.end(), 0);
  if (!m_state || raised)
    forget();
  // Cutting only removes tissue.
  const bool cut = m_number != state.number();
  m_search.cut = m_search.cut || cut;
  for (List& list : m_lists)
  {
    list.cut = list.cut || cut;
    list.age += list.cut ? 1 : 0;
  }
  m_state = &state;
  m_number = state.number();
  m_raises = state.raises();
}

void SurfaceSamples::forget() noexcept
{
  for (List& list : m_lists)
    list.known = false;
  m_search.active = false;
}

void SurfaceSamples::moved(const Pose& pose) noexcept
{
  const auto way = [&](const Pose& from, std::size_t part, double margin)
  { return maxDisplacement(motionBetween(from, pose), m_parts.reach(part) + margin); };
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
    if (m_lists[part].known)
      m_lists[part].made = way(m_lists[part].pose, part, m_lists[part].margin);
  if (!m_search.active)
    return;
  m_search.made = way(m_search.pose, m_search.part, m_search.margin);
  m_search.active = m_search.made < m_search.margin;
}

double SurfaceSamples::find(const Pose& pose, double linear, double angular, double beyond) noexcept
{
  double share = 1.0;
  const bool burrCuts = m_lists[SolidParts::kBall].cut;
  m_cut = m_cut || burrCuts;
  // The others get what the ball leaves: the shaft's root is next to what was cut.
  const std::size_t most = kMaxWork + (m_cut ? kMaxAfterCut : 0);
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
  {
    if (!m_parts.has(part))
      continue;
    const List& list = m_lists[part];
    const auto wayOf = [&] { return linear + angular * arm(part); };
    const double used = kUsed * list.margin;
    const bool now =
        list.left() <= std::min(wayOf() + beyond, used) || (list.cut && part == SolidParts::kBall);
    const bool renewed = list.cut && (part == 1 || list.age >= kRenewal);
    if (now || renewed || list.left() <= used)
      renew(part, pose, kUnit * (!burrCuts || part != SolidParts::kBall ? most : kMaxAfterCut));
    const double known = std::max(list.left() - beyond, 0.0);
    if (known < wayOf())
      share = std::min(share, known / wayOf());
  }
  return share;
}

// One search at a time: a search begun for another part is finished first.
void SurfaceSamples::renew(std::size_t part, const Pose& pose, std::size_t until) noexcept
{
  while (m_work < until)
  {
    if (!m_search.active)
    {
      const List& list = m_lists[part];
      const bool cut = list.cut && part == SolidParts::kBall;
      m_search.least = (cut ? kMinAfterCut : kMin) * m_field.voxel();
      begin(m_search, part, pose, cut ? m_search.least : list.wish, false);
    }
    const bool own = m_search.part == part;
    run(m_search, until);
    if (m_search.depth > 0)
      return;
    finish();
    if (own)
      return;
  }
}

// Sorts the samples by their distance when found.
void SurfaceSamples::finish() noexcept
{
  Search& search = m_search;
  search.active = false;
  List& list = m_lists[search.part];
  list.wish = search.work < kCheap
                  ? std::min(2.0 * search.margin, kMax * m_field.voxel())
                  : std::max(search.work > kDear ? 0.5 * search.margin : search.margin,
                             kMin * m_field.voxel());
  if (!list.cut && list.left() > search.margin - search.made)
    return; // the known ones reach farther
  const double perBin = kBins / std::max(search.margin, 1e-12);
  const auto binOf = [&](std::size_t n)
  {
    const double bin = std::clamp(perBin * search.distances[n], 0.0, kBins - 1.0);
    return static_cast<std::size_t>(bin);
  };
  list.first.fill(0);
  for (std::size_t n = 0; n < search.count; ++n)
    ++list.first[binOf(n) + 1];
  for (std::size_t bin = 0; bin < kBins; ++bin)
    list.first[bin + 1] += list.first[bin];
  std::array<std::uint32_t, kBins + 1> next = list.first;
  for (std::size_t n = 0; n < search.count; ++n)
    list.places[next[binOf(n)]++] = search.places[n];
  spend(search, search.count);
  list.pose = search.pose;
  list.margin = search.margin;
  list.made = search.made;
  list.known = true;
  list.cut = search.cut;
  list.age = 0;
}

std::size_t SurfaceSamples::within(std::size_t part, double distance) const noexcept
{
  const List& list = m_lists[part];
  if (!list.known)
    return 0;
  const double bin = kBins * (list.made + distance) / std::max(list.margin, 1e-12);
  // One bin more for rounding of distances.
  return list.first[static_cast<std::size_t>(std::clamp(bin + 2.0, 1.0, double{kBins}))];
}

double SurfaceSamples::depth(const Pose& pose) const noexcept
{
  double least = -kTolerance;
  const Eigen::Matrix3d toTool = pose.rotation.toRotationMatrix().transpose();
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
  {
    const std::size_t count = within(part, 0.0);
    for (std::size_t n = 0; n < count; ++n)
      least = std::min(least,
                       m_parts.distance(part, toTool * (m_lists[part].places[n] - pose.position)));
  }
  return least < -kTolerance ? -least : 0.0;
}

std::optional<double> SurfaceSamples::insideAt(const Pose& pose, std::size_t most) noexcept
{
  const std::size_t until = most < SIZE_MAX / kUnit ? m_work + kUnit * most : SIZE_MAX;
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
  {
    if (!m_parts.has(part))
      continue;
    begin(m_query, part, pose, 0.0, true);
    run(m_query, until);
    if (m_query.deepest > 0.0)
      return m_query.deepest;
    if (m_query.depth > 0)
      return std::nullopt;
  }
  return 0.0;
}

// Keeps only nearer samples if there are too many or they cost too much.
void SurfaceSamples::shrink(Search& search, double margin) noexcept
{
  search.margin = margin;
  std::size_t kept = 0;
  for (std::size_t n = 0; n < search.count; ++n)
    if (search.distances[n] <= margin)
    {
      search.places[kept] = search.places[n];
      search.distances[kept++] = search.distances[n];
    }
  spend(search, search.count);
  search.count = kept;
}

void SurfaceSamples::begin(Search& search, std::size_t part, const Pose& pose, double margin,
                           bool inside) noexcept
{
  search.part = part;
  search.pose = pose;
  search.toTool = pose.rotation.toRotationMatrix().transpose();
  search.margin = margin;
  search.made = 0.0;
  search.deepest = 0.0;
  search.inside = inside;
  search.active = true;
  search.cut = false;
  search.depth = 0;
  search.work = 0;
  search.dearAt = kDear;
  search.count = 0;
  const core::GridGeometry& grid = m_field.geometry();
  // The part's bounding box, in bricks.
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
  Box all;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double low = std::min(ends[0][axis], ends[1][axis]) - half[axis];
    const double high = std::max(ends[0][axis], ends[1][axis]) + half[axis];
    // Compared as doubles: the tool may be anywhere.
    if (!(high > 0.0) || !(low < kTissueBrick * dims[a]))
      return;
    all.lower[a] = static_cast<int>(std::max(0.0, low)) / kTissueBrick;
    all.upper[a] =
        static_cast<int>(std::min(double{kTissueBrick} * dims[a] - 1.0, high)) / kTissueBrick + 1;
  }
  search.stack[search.depth++] = all;
}

// Bisects a box of bricks until it is far from the part's surface, far from tissue, or a single
// brick.
void SurfaceSamples::run(Search& search, std::size_t until) noexcept
{
  const core::GridGeometry& grid = m_field.geometry();
  const Eigen::Vector3d last =
      Eigen::Vector3d(grid.dims()[0], grid.dims()[1], grid.dims()[2]) - Eigen::Vector3d::Ones();
  while (search.depth > 0 && m_work < until)
  {
    if (search.work > search.dearAt && search.margin > search.least)
    {
      shrink(search, std::max(0.5 * search.margin, search.least));
      search.dearAt = search.work + kDear;
    }
    spend(search, kBoxCost);
    const Box box = search.stack[--search.depth];
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
    if (isEmpty(box))
      continue;
    if (m_field.clearance(middle) > radius)
    {
      markEmpty(box);
      continue;
    }
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
      if (search.deepest > 0.0)
        return;
      continue;
    }
    const auto axis = static_cast<std::size_t>(longest);
    // Between blocks, while there are several.
    const int cut = box.lower[axis] / kBlock == (box.upper[axis] - 1) / kBlock
                        ? (box.lower[axis] + box.upper[axis]) / 2
                        : std::max((box.lower[axis] + box.upper[axis]) / 2 / kBlock,
                                   box.lower[axis] / kBlock + 1) *
                              kBlock;
    Box first = box;
    Box second = box;
    first.upper[axis] = cut;
    second.lower[axis] = cut;
    search.stack[search.depth++] = second;
    search.stack[search.depth++] = first;
  }
}

bool SurfaceSamples::reaches(const Search& search, const Eigen::Vector3d& middle,
                             double radius) const noexcept
{
  const double distance =
      m_parts.distance(search.part, search.toTool * (middle - search.pose.position));
  return distance <= radius + search.margin && (search.inside || distance >= -radius);
}

bool SurfaceSamples::reachesCell(const Search& search, const core::GridGeometry& grid,
                                 const core::Index3& cell) const noexcept
{
  const Eigen::Vector3d middle(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5);
  return reaches(search, grid.patientFromVoxel(middle), 0.5 * grid.spacing().norm());
}

void SurfaceSamples::add(Search& search, const Eigen::Vector3d& place) noexcept
{
  spend(search, 1);
  if (m_making)
  {
    if (m_making->count < kMaxInBrick)
    {
      m_places[m_nextPlace++ % kPlaces] = place;
      ++m_making->count;
    }
    else
      m_making->key = UINT64_MAX;
  }
  const double distance =
      m_parts.distance(search.part, search.toTool * (place - search.pose.position));
  if (search.inside)
  {
    if (distance < -kTolerance)
      search.deepest = std::max(search.deepest, -distance);
    return;
  }
  for (int tries = 0; search.count == kMaxSamples; ++tries)
    shrink(search, tries < kMaxShrinks ? kShrink * search.margin : 0.0);
  if (!(distance <= search.margin))
    return;
  search.places[search.count] = place;
  search.distances[search.count++] = static_cast<float>(distance);
}

// Two samples of a flat surface are at most a line spacing apart, so the tool sinks in between by
// the sagitta of half of it.
int SurfaceSamples::linesFor(std::size_t part, const core::GridGeometry& grid,
                             bool flat) const noexcept
{
  const double most = 2.0 * std::sqrt(2.0 * kSagitta * m_parts.radius(part));
  const double needed = std::ceil(grid.spacing().maxCoeff() / most);
  const int lines = static_cast<int>(std::clamp(needed, 1.0, double{kMaxLines}));
  const bool fine = grid.spacing().maxCoeff() <= kBulge * lines;
  return flat || fine ? lines : std::min(kBulging * lines, kMaxLines);
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

// Whether parallel edges along each axis are about equal.
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
  float u, v; // position on the next two axes

  // f at both ends. Bilinear on the two faces, with the axes turned: between them f is linear, so
  // the crossing follows without volume::interpolateCell.
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

// Segment of a line where an operand is above 0.
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

// The bits of a box of bricks within one block; 0 if it is in several.
std::uint64_t bitsOf(const core::Index3& lower, const core::Index3& upper) noexcept
{
  std::uint64_t bits = 0;
  for (std::size_t a = 0; a < 3; ++a)
    if (lower[a] / kBlock != (upper[a] - 1) / kBlock)
      return 0;
  for (int k = lower[2] % kBlock; k <= (upper[2] - 1) % kBlock; ++k)
    for (int j = lower[1] % kBlock; j <= (upper[1] - 1) % kBlock; ++j)
      for (int i = lower[0] % kBlock; i <= (upper[0] - 1) % kBlock; ++i)
        bits |= std::uint64_t{1} << (i + kBlock * (j + kBlock * k));
  return bits;
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
  std::array<Corners, HapticField::BrickValues::kMaxTissues> tissue;
  std::size_t tissues = 0; // those above 0 somewhere in it
  Corners mask;
  Corners hull;
  bool whole = false;  // mask and hull are above 0
  bool others = false; // there may be unions on grids of their own
};

// Bricks of a block are consecutive.
std::size_t SurfaceSamples::indexOf(const core::Index3& brick) const noexcept
{
  const auto at = [&](std::size_t a) { return static_cast<std::size_t>(brick[a] / kBlock); };
  const auto in = [&](std::size_t a) { return static_cast<std::size_t>(brick[a] % kBlock); };
  const std::size_t block = at(0) + static_cast<std::size_t>(m_blocks[0]) *
                                        (at(1) + static_cast<std::size_t>(m_blocks[1]) * at(2));
  return kBlock * kBlock * kBlock * block + in(0) + kBlock * (in(1) + kBlock * in(2));
}

void SurfaceSamples::markEmpty(const Box& box) noexcept
{
  if (const std::uint64_t bits = bitsOf(box.lower, box.upper))
    m_empty[indexOf(box.lower) / 64] |= bits;
}

bool SurfaceSamples::isEmpty(const Box& box) const noexcept
{
  const std::uint64_t bits = bitsOf(box.lower, box.upper);
  return bits != 0 && (m_empty[indexOf(box.lower) / 64] & bits) == bits;
}

// Whether the brick's samples are known for the present mask.
bool SurfaceSamples::valid(Search& search, Brick& known, std::uint64_t key,
                           const core::Index3& brick) noexcept
{
  if (known.key != key || m_nextPlace - known.first > kPlaces)
    return false;
  if (known.state == m_number)
    return true;
  spend(search, kMaskCost);
  std::array<float, 27> mask;
  m_field.maskValues(brick, *m_state, mask);
  if (mask != known.mask)
    return false;
  known.state = m_number;
  return true;
}

void SurfaceSamples::addBrick(Search& search, const core::Index3& brick) noexcept
{
  const std::size_t index = indexOf(brick);
  const std::uint64_t bit = std::uint64_t{1} << (index % 64);
  if ((m_full[index / 64] & bit) && m_field.untouched(brick, *m_state))
    return;
  const std::uint64_t key = SolidParts::kParts * index + search.part;
  Brick& known = m_known[(key * 0x9E3779B97F4A7C15ULL) >> 51];
  static_assert(kBricks == std::size_t{1} << (64 - 51));
  if (valid(search, known, key, brick))
  {
    spend(search, 1);
    for (std::uint64_t n = known.first; n < known.first + known.count; ++n)
      add(search, m_places[n % kPlaces]);
    return;
  }
  spend(search, kBrickCost);
  HapticField::BrickValues values;
  m_field.brickValues(brick, *m_state, values);
  // A query is bounded more tightly, and rarely asks twice: it examines only the cells it needs.
  if (!search.inside)
  {
    known = {key, m_number, m_nextPlace, 0, values.mask};
    m_making = &known;
  }
  const core::GridGeometry& grid = m_field.geometry();
  const core::Index3& dims = grid.dims();
  bool empty = !values.others;
  bool full = empty;
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
    const auto isFull = [&](std::size_t n)
    { return least(cornersOf(values.tissue[n], base)) > 0.0F; };
    bool all = false;
    for (std::size_t n = 0; n < values.tissues && !all; ++n)
      all = isFull(n);
    full = full && all;
    if (!(most(corners.mask) > 0.0F))
      continue;
    corners.hull = cornersOf(values.hull, base);
    corners.whole = least(corners.mask) > 0.0F && least(corners.hull) > 0.0F;
    for (std::size_t n = 0; n < values.tissues; ++n)
    {
      Corners& f = corners.tissue[corners.tissues];
      f = cornersOf(values.tissue[n], base);
      if (most(f) > 0.0F)
        ++corners.tissues;
    }
    corners.others = values.others;
    if (corners.tissues == 0 && (corners.whole || !corners.others))
      continue;
    empty = false;
    if (!(corners.whole && all) && (m_making || reachesCell(search, grid, cell)))
      addCell(search, cell, corners);
  }
  if (empty)
    m_empty[index / 64] |= bit;
  else if (full)
    m_full[index / 64] |= bit;
  if (values.others)
  {
    const bool whole = *std::min_element(values.mask.begin(), values.mask.end()) > 0.0F &&
                       *std::min_element(values.hull.begin(), values.hull.end()) > 0.0F;
    for (std::size_t n = 0; n < m_field.unions(); ++n)
      if (!m_field.onGrid(n))
        addUnion(search, brick, n, whole);
    // Where a union on another grid is cut, the end of a line may be in another brick.
    if (!whole && m_making)
      m_making->key = UINT64_MAX;
  }
  m_making = nullptr;
}

void SurfaceSamples::addCell(Search& search, const core::Index3& cell, const Cell& values) noexcept
{
  const core::GridGeometry& grid = m_field.geometry();
  // A single operand that crosses 0 and is nearly flat.
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
  const int lines = linesFor(search.part, grid, flat);
  spend(search, kCellCost + static_cast<std::size_t>(3 * lines * lines));
  const auto place = [&](const Line& line, float t)
  { return Eigen::Vector3d(grid.patientFromVoxel(line.at(cell, t))); };
  forEachLine(lines,
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
                std::array<std::array<float, 2>, HapticField::BrickValues::kMaxTissues> f;
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
                  // Not where another tissue continues; once where a cut ends several.
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

// Whether a place is in another union; for the CT's cells, in those on grids of their own.
bool SurfaceSamples::inOthers(const Eigen::Vector3d& voxel, std::size_t but) const noexcept
{
  for (std::size_t n = 0; n < m_field.unions(); ++n)
    if (n != but && !(but == HapticField::kCt && m_field.onGrid(n)) &&
        m_field.tissueOf(n, voxel) > kWithin)
      return true;
  return false;
}

// The cells of a union on its own grid that reach into the brick.
void SurfaceSamples::addUnion(Search& search, const core::Index3& brick, std::size_t n,
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
  core::Index3 cell;
  for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2])
    for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1])
      for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0])
      {
        spend(search, kUnionCellCost);
        const Corners share = m_field.unionCell(n, cell);
        if (!(most(share) > 0.0F))
          continue;
        bool border = false;
        for (std::size_t a = 0; a < 3; ++a)
          border = border || cell[a] == 0 || cell[a] == own.dims()[a] - 2;
        if (least(share) > 0.0F && whole && !border)
          continue;
        if (m_making || reachesCell(search, own, cell))
          addUnionCell(search, brick, n, whole, cell, share);
      }
}

// Each sample is added only for the brick that contains it, so that none is found twice.
void SurfaceSamples::addUnionCell(Search& search, const core::Index3& brick, std::size_t n,
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
      // The last brick includes the voxels at the grid's border.
      const bool tail = brick[a] + 1 == m_field.brickDims()[a];
      if (!(at >= kTissueBrick * brick[a]) || !(tail || at < kTissueBrick * (brick[a] + 1)))
        return;
    }
    if (!(m_field.tissueOf(HapticField::kCt, voxel) > kWithin) && !inOthers(voxel, n))
      this->add(search, grid.patientFromVoxel(voxel));
  };
  const auto rest = [&](const Line& line, float t)
  { return m_field.rest(ctVoxel(line, t), *m_state); };
  const int lines = linesFor(search.part, own, least(share) <= 0.0F && whole && isFlat(share));
  spend(search, kCellCost + static_cast<std::size_t>(3 * lines * lines));
  forEachLine(lines,
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
                // The cut is in between: on the side that remains.
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
