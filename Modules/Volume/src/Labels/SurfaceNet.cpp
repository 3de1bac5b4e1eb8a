#include "SurfaceNet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "LabelOccupancy.h"

namespace petrous::volume
{

namespace
{

constexpr int kCurvatureRounds = 8; // of averaging: width of the neighbourhood
constexpr int kRelaxations = 8;     // each with a target curvature
constexpr int kStepsEach = 6;
constexpr float kStep = 0.7F;
constexpr float kClearance = 0.05F; // from the faces of its cell, so that no voxel changes sides
constexpr int kNormalRounds = 1;
constexpr int kNormalReach = 2 + kNormalRounds; // joins to the points that affect a normal
// And those that affect a position, over a whole relaxation.
constexpr int kRelaxationReach = kCurvatureRounds + kStepsEach - 1 + kNormalReach;
constexpr int kSeedMargin = 3;   // voxels beyond a target whose cells affect its occupancies
constexpr int kWord = 8;         // voxels compared at once
constexpr float kCrease = 0.9F;  // cosine between the normals of two points across a crease
constexpr float kSmooth = 0.98F; // of two points without one

constexpr int kEdges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                               {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

Eigen::Vector3f toFloat(const core::Index3& index)
{
  return toVector(index).cast<float>();
}

// Whether kWord voxels from `i` on are all inside, or all outside, in four rows.
bool sameWord(const std::uint8_t* const (&rows)[4], int i, bool inside)
{
  const std::uint64_t same = inside ? 0x0101010101010101U : 0U;
  for (const std::uint8_t* row : rows)
  {
    std::uint64_t word;
    std::memcpy(&word, row + i, sizeof word);
    if (word != same)
      return false;
  }
  return true;
}

// Calls visit(cell, corners) for the border cells of a box, the first axis fastest.
template <class Visit>
void forEachBorderCell(const Volume<std::uint8_t>& inside, const core::IndexBox& cells,
                       const Visit& visit)
{
  const int width = inside.geometry().dims()[0];
  for (int k = cells.lower[2]; k < cells.upper[2]; ++k)
    for (int j = cells.lower[1]; j < cells.upper[1]; ++j)
    {
      const std::uint8_t* rows[4] = {&inside.at(0, j, k), &inside.at(0, j + 1, k),
                                     &inside.at(0, j, k + 1), &inside.at(0, j + 1, k + 1)};
      const auto end = [&rows](int i)
      { return rows[0][i] | rows[1][i] << 2 | rows[2][i] << 4 | rows[3][i] << 6; };
      int before = end(cells.lower[0]);
      for (int i = cells.lower[0]; i < cells.upper[0];)
      {
        // Most of a grid is far from any border.
        if ((before == 0 || before == 85) && i + kWord < width &&
            sameWord(rows, i + 1, before != 0))
        {
          i += kWord;
          continue;
        }
        const int after = end(i + 1);
        const int corners = before | after << 1;
        if (corners != 0 && corners != 255)
          visit(core::Index3{i, j, k}, corners);
        before = after;
        ++i;
      }
    }
}

template <class Body>
void forEachPoint(std::size_t count, const Body& body)
{
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096),
                    [&](const tbb::blocked_range<std::size_t>& range)
                    {
                      for (std::size_t n = range.begin(); n < range.end(); ++n)
                        body(n);
                    });
}

} // namespace

float SurfaceNet::occupancyOf(double depth) noexcept
{
  return quantizedOccupancy(std::clamp(0.5 + depth / double{kShareReach}, 0.0, 1.0));
}

double SurfaceNet::depthOf(float occupancy) noexcept
{
  return (double{occupancy} - 0.5) * double{kShareReach};
}

SurfaceNet::PointTable::PointTable(const core::Index3& dims)
{
  for (std::size_t a = 0; a < 3; ++a)
    m_dims[a] = static_cast<std::size_t>((dims[a] + kEdge - 1) / kEdge);
  m_bricks.resize(m_dims[0] * m_dims[1] * m_dims[2]);
}

std::int32_t& SurfaceNet::PointTable::slot(const core::Index3& cell)
{
  auto& brick = m_bricks[brickOf(cell[0], cell[1], cell[2])];
  if (!brick)
    brick = std::make_unique<std::int32_t[]>(kEdge * kEdge * kEdge); // all 0
  return brick[offsetOf(cell[0], cell[1], cell[2])];
}

SurfaceNet::SurfaceNet(const Volume<std::uint8_t>& inside, const core::Progress& progress,
                       const Wanted& wanted)
  : m_inside(inside)
  , m_pointOf(inside.geometry().dims())
{
  findPoints(progress, wanted);
  placePoints();
  join();
  findNormals(kJoinReach - kNormalReach);
}

SurfaceNet::SurfaceNet(const Volume<std::uint8_t>& inside,
                       const std::vector<core::IndexBox>& targets, const core::Progress& progress)
  : m_inside(inside)
  , m_pointOf(inside.geometry().dims())
{
  static_assert(kJoinReach == kRelaxations * kRelaxationReach + kNormalReach);
  std::vector<core::IndexBox> seeds;
  for (const core::IndexBox& target : targets)
    seeds.push_back(grown(target, kSeedMargin));
  findPoints(seeds, progress);
  placePoints();
  join();
  findNormals(kJoinReach - kNormalReach);
}

// Number of points of a region at most `joins` joins from its seeds. They come first.
std::size_t SurfaceNet::within(int joins) const noexcept
{
  if (m_within.empty())
    return m_points.size();
  return m_within[std::min(static_cast<std::size_t>(std::max(joins, 0)), m_within.size() - 1)];
}

int SurfaceNet::cornersOf(const core::Index3& cell) const noexcept
{
  int corners = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const core::Index3 v = voxelOf(cell, corner);
    corners |= m_inside.at(v[0], v[1], v[2]) << corner;
  }
  return corners;
}

// Whether the border crosses a face of a cell: 2 * axis, + 1 for the upper one.
bool SurfaceNet::passes(int corners, int face) noexcept
{
  int inside = 0;
  for (int corner = 0; corner < 8; ++corner)
    if ((corner >> face / 2 & 1) == (face & 1))
      inside += corners >> corner & 1;
  return inside != 0 && inside != 4;
}

// Whether the border crosses the edge of a cell that begins at a corner.
bool SurfaceNet::crosses(int corners, int corner, int axis) noexcept
{
  return (corners >> corner & 1) != (corners >> (corner | 1 << axis) & 1);
}

core::Index3 SurfaceNet::across(const core::Index3& cell, int face) noexcept
{
  core::Index3 next = cell;
  next[static_cast<std::size_t>(face / 2)] += (face & 1) != 0 ? 1 : -1;
  return next;
}

void SurfaceNet::findPoints(const core::Progress& progress, const Wanted& wanted)
{
  const core::Index3& dims = m_inside.geometry().dims();
  std::vector<std::vector<Point>> slices(static_cast<std::size_t>(dims[2]));
  tbb::parallel_for(0, dims[2] - 1,
                    [&](int k)
                    {
                      progress.check("smoothing structures");
                      std::vector<Point>& points = slices[static_cast<std::size_t>(k)];
                      forEachBorderCell(
                          m_inside, {{0, 0, k}, {dims[0] - 1, dims[1] - 1, k + 1}},
                          [&](const core::Index3& cell, int corners)
                          {
                            if (!wanted || wanted(cell))
                              points.push_back({cell, static_cast<std::uint8_t>(corners)});
                          });
                    });
  std::size_t count = 0;
  for (const std::vector<Point>& slice : slices)
    count += slice.size();
  m_points.reserve(count);
  for (std::vector<Point>& slice : slices)
  {
    for (const Point& point : slice)
    {
      m_points.push_back(point);
      m_pointOf.slot(point.cell) = static_cast<std::int32_t>(m_points.size());
    }
    std::vector<Point>().swap(slice);
  }
}

// Points in the seeds, then all those joined with them, nearest first.
void SurfaceNet::findPoints(const std::vector<core::IndexBox>& seeds,
                            const core::Progress& progress)
{
  const core::Index3& dims = m_inside.geometry().dims();
  const core::IndexBox cells{{0, 0, 0}, {dims[0] - 1, dims[1] - 1, dims[2] - 1}};
  const auto add = [this](const core::Index3& cell, int corners)
  {
    m_points.push_back({cell, static_cast<std::uint8_t>(corners)});
    m_pointOf.slot(cell) = static_cast<std::int32_t>(m_points.size());
  };
  for (const core::IndexBox& seed : seeds)
    forEachBorderCell(m_inside, seed.intersected(cells),
                      [&](const core::Index3& cell, int corners)
                      {
                        if (m_pointOf.at(cell[0], cell[1], cell[2]) == 0)
                          add(cell, corners);
                      });
  m_within.push_back(m_points.size());
  std::size_t first = 0;
  for (int joins = 1; joins <= kJoinReach; ++joins)
  {
    progress.check("smoothing structures");
    const std::size_t last = m_points.size();
    for (; first < last; ++first)
      for (int face = 0; face < 6; ++face)
      {
        const Point point = m_points[first];
        if (!passes(point.corners, face))
          continue;
        const core::Index3 next = across(point.cell, face);
        if (m_pointOf.at(next[0], next[1], next[2]) == 0)
          add(next, cornersOf(next));
      }
    m_within.push_back(m_points.size());
  }
}

void SurfaceNet::placePoints()
{
  m_positions.resize(m_points.size());
  // Initial position: the mean of the crossings of the cell's edges.
  forEachPoint(m_points.size(),
               [this](std::size_t n)
               {
                 const Point& point = m_points[n];
                 Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                 int passed = 0;
                 for (const auto& edge : kEdges)
                   if ((point.corners >> edge[0] & 1) != (point.corners >> edge[1] & 1))
                   {
                     sum += 0.5F * (toFloat(cornerOf(edge[0])) + toFloat(cornerOf(edge[1])));
                     ++passed;
                   }
                 m_positions[n] = toFloat(point.cell) + sum / static_cast<float>(passed);
               });
}

void SurfaceNet::join()
{
  m_joined.resize(m_points.size());
  m_neighbours.resize(m_points.size());
  m_diagonal.resize(m_points.size());
  const auto pointIn = [this](const core::Index3& cell)
  { return pointAt(cell[0], cell[1], cell[2]); };
  forEachPoint(
      m_points.size(),
      [&](std::size_t n)
      {
        const Point& point = m_points[n];
        Neighbours& near = m_neighbours[n];
        near.count = 0;
        for (int face = 0; face < 6; ++face)
        {
          std::int32_t& other = m_joined[n][static_cast<std::size_t>(face)];
          other = passes(point.corners, face) ? pointIn(across(point.cell, face)) : -1;
          if (other >= 0)
            near.points[static_cast<std::size_t>(near.count++)] = other;
        }
        for (int axis = 0; axis < 3; ++axis)
          for (int side = 0; side < 2; ++side)
          {
            const int corner = side != 0 ? 7 - (1 << axis) : 0;
            core::Index3 cell = point.cell;
            for (const int face : {2 * ((axis + 1) % 3) + side, 2 * ((axis + 2) % 3) + side})
              cell = across(cell, face);
            m_diagonal[n][static_cast<std::size_t>(2 * axis + side)] =
                crosses(point.corners, corner, axis) ? pointIn(cell) : -1;
          }
      });
}

// The quad around the edge of a point's cell at its lowest voxel, along `axis`: this is the one
// with the highest indices of the four cells around it. Returns the cross product of its diagonals;
// zero if the border does not cross the edge, or at the edge of the net.
Eigen::Vector3f SurfaceNet::quadrangle(std::size_t n, int axis) const
{
  const auto u = static_cast<std::size_t>((axis + 1) % 3);
  const auto v = static_cast<std::size_t>((axis + 2) % 3);
  const std::int32_t low = m_diagonal[n][static_cast<std::size_t>(2 * axis)];
  const std::int32_t lowU = m_joined[n][2 * u];
  const std::int32_t lowV = m_joined[n][2 * v];
  if (!crosses(m_points[n].corners, 0, axis) || std::min({low, lowU, lowV}) < 0)
    return Eigen::Vector3f::Zero();
  const auto at = [this](std::int32_t point) -> const Eigen::Vector3f&
  { return m_positions[static_cast<std::size_t>(point)]; };
  return (m_positions[n] - at(low)).cross(at(lowU) - at(lowV));
}

// Normal as the mean of the quads around a point, for the points `reach` joins from the seeds of a
// region; positions must be valid kNormalReach farther.
void SurfaceNet::findNormals(int reach)
{
  m_normals.resize(m_points.size());
  std::vector<std::array<Eigen::Vector3f, 3>> quadrangles(m_points.size());
  forEachPoint(within(reach + kNormalReach),
               [&](std::size_t n)
               {
                 for (int axis = 0; axis < 3; ++axis)
                   quadrangles[n][static_cast<std::size_t>(axis)] = quadrangle(n, axis);
               });
  std::vector<Eigen::Vector3f> raw(m_points.size());
  forEachPoint(within(reach + kNormalRounds),
               [&](std::size_t n)
               {
                 const Point& point = m_points[n];
                 Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                 for (int e = 0; e < 12; ++e)
                 {
                   const int axis = e / 4;
                   const int low = kEdges[e][0];
                   if (!crosses(point.corners, low, axis))
                     continue;
                   const int u = (axis + 1) % 3;
                   const int v = (axis + 2) % 3;
                   const int up = (low >> u & 1) | (low >> v & 1) << 1;
                   const auto face = [](int along)
                   { return static_cast<std::size_t>(2 * along + 1); };
                   const std::int32_t owner = up == 0   ? static_cast<std::int32_t>(n)
                                              : up == 1 ? m_joined[n][face(u)]
                                              : up == 2 ? m_joined[n][face(v)]
                                                        : m_diagonal[n][face(axis)];
                   if (owner < 0)
                     continue; // at an edge of the net
                   const Eigen::Vector3f& product =
                       quadrangles[static_cast<std::size_t>(owner)][static_cast<std::size_t>(axis)];
                   sum += (point.corners >> low & 1) != 0 ? product : Eigen::Vector3f(-product);
                 }
                 raw[n] = sum;
               });
  static_assert(kNormalRounds == 1); // each round averages half with the neighbours
  forEachPoint(within(reach),
               [&](std::size_t n)
               {
                 Eigen::Vector3f sum = 0.0F * raw[n];
                 for (const std::int32_t other : m_neighbours[n])
                   sum += raw[static_cast<std::size_t>(other)];
                 const auto count = static_cast<float>(m_neighbours[n].count);
                 Eigen::Vector3f normal = raw[n];
                 if (count > 0.0F)
                   normal = 0.5F * raw[n] + 0.5F / count * sum;
                 const float length = normal.norm();
                 m_normals[n] = normal * (length > 1e-6F ? 1.0F / length : 0.0F);
               });
}

// A point depends on points a few joins farther with each of the loops below, so the outer points
// of a region are skipped progressively: kRelaxationReach per relaxation.
void SurfaceNet::relax(const core::Progress& progress)
{
  std::vector<float> curvature(m_points.size());
  std::vector<float> scratch(m_points.size());
  std::vector<Eigen::Vector3f> next(m_points.size());
  // Weight of each joined point's curvature, and 1/2 over their sum; 0: too small.
  std::vector<std::array<float, 7>> weights(m_points.size());
  // From a point to the mean of those joined with it.
  const auto towardsMean = [this](std::size_t n) -> Eigen::Vector3f
  {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    const Neighbours& near = m_neighbours[n];
    for (const std::int32_t other : near)
      sum += m_positions[static_cast<std::size_t>(other)];
    if (near.count == 0)
      return sum;
    return sum / static_cast<float>(near.count) - m_positions[n];
  };
  const auto along = [this](std::size_t n, const Eigen::Vector3f& v)
  { return v.dot(m_normals[n]); };
  // A crease has its own curvature, different from that of the adjacent faces.
  const auto alike = [&](std::size_t n, std::size_t other)
  { return std::clamp((along(n, m_normals[other]) - kCrease) / (kSmooth - kCrease), 0.0F, 1.0F); };
  int reach = kJoinReach - kNormalReach; // of valid normals
  for (int relaxation = 0; relaxation < kRelaxations; ++relaxation)
  {
    forEachPoint(within(reach), [&](std::size_t n) { curvature[n] = along(n, towardsMean(n)); });
    --reach;
    forEachPoint(within(reach),
                 [&](std::size_t n)
                 {
                   float sum = 0.0F;
                   float* weight = weights[n].data();
                   for (const std::int32_t other : m_neighbours[n])
                     sum += * weight++ = alike(n, static_cast<std::size_t>(other));
                   weights[n][6] = sum >= 1e-3F ? 0.5F / sum : 0.0F;
                 });
    for (int round = 0; round < kCurvatureRounds; ++round, --reach)
    {
      // Each round averages half with the joined points.
      forEachPoint(within(reach),
                   [&](std::size_t n)
                   {
                     float sum = 0.0F * curvature[n];
                     const float* weight = weights[n].data();
                     for (const std::int32_t other : m_neighbours[n])
                       sum += *weight++ * curvature[static_cast<std::size_t>(other)];
                     scratch[n] = weights[n][6] > 0.0F ? 0.5F * curvature[n] + weights[n][6] * sum
                                                       : curvature[n];
                   });
      curvature.swap(scratch);
    }
    ++reach;
    for (int step = 0; step < kStepsEach; ++step, --reach)
    {
      progress.check("smoothing structures");
      forEachPoint(within(reach),
                   [&](std::size_t n)
                   {
                     const Eigen::Vector3f low = toFloat(m_points[n].cell).array() + kClearance;
                     const Eigen::Vector3f high = low.array() + (1.0F - 2.0F * kClearance);
                     const Eigen::Vector3f move = towardsMean(n) - curvature[n] * m_normals[n];
                     next[n] = (m_positions[n] + kStep * move).cwiseMax(low).cwiseMin(high);
                   });
      m_positions.swap(next);
    }
    ++reach;
    reach -= kNormalReach;
    findNormals(reach);
  }
}

std::shared_ptr<Volume<float>> smoothedOccupancy(const Volume<std::uint8_t>& inside,
                                                 const core::Progress& progress,
                                                 const SurfaceNet::Wanted& wanted)
{
  auto occupancy = makeZeroVolume<float>(inside.geometry());
  SurfaceNet net(inside, progress, wanted);
  net.relax(progress.part(0.0, 2.0 / 3.0));
  net.writeOccupancy(*occupancy, progress.part(2.0 / 3.0, 1.0));
  return occupancy;
}

} // namespace petrous::volume
