#include "SurfaceNet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "LabelShare.h"

namespace petrous::volume
{

namespace
{

constexpr int kCurvatureRounds = 8; // of averaging: how wide a neighbourhood is
constexpr int kRelaxations = 8;     // each with a curvature to go to
constexpr int kStepsEach = 6;
constexpr float kStep = 0.7F;
constexpr float kClearance = 0.05F; // from the faces of its cell, so that no voxel changes sides
constexpr int kNormalRounds = 1;
constexpr float kCrease = 0.9F;  // cosine between the normals of two points with a crease between
constexpr float kSmooth = 0.98F; // of two with none

constexpr int kEdges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                               {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

Eigen::Vector3f toFloat(const core::Index3& index)
{
  return toVector(index).cast<float>();
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

float SurfaceNet::shareOf(double depth) noexcept
{
  return quantisedShare(std::clamp(0.5 + depth / double{kShareReach}, 0.0, 1.0));
}

double SurfaceNet::depthOf(float share) noexcept
{
  return (double{share} - 0.5) * double{kShareReach};
}

SurfaceNet::SurfaceNet(const Volume<std::uint8_t>& inside, const core::Progress& progress,
                       const Wanted& wanted)
  : m_inside(inside)
  , m_pointOf(makeZeroVolume<std::int32_t>(inside.geometry()))
{
  findPoints(progress, wanted);
  join();
  findNormals();
}

void SurfaceNet::findPoints(const core::Progress& progress, const Wanted& wanted)
{
  const core::Index3& dims = m_inside.geometry().dims();
  std::vector<std::vector<Point>> slices(static_cast<std::size_t>(dims[2]));
  tbb::parallel_for(
      0, dims[2] - 1,
      [&](int k)
      {
        progress.check("smoothing structures");
        std::vector<Point>& points = slices[static_cast<std::size_t>(k)];
        for (int j = 0; j + 1 < dims[1]; ++j)
        {
          const std::uint8_t* rows[4] = {&m_inside.at(0, j, k), &m_inside.at(0, j + 1, k),
                                         &m_inside.at(0, j, k + 1), &m_inside.at(0, j + 1, k + 1)};
          const auto end = [&rows](int i)
          { return rows[0][i] | rows[1][i] << 2 | rows[2][i] << 4 | rows[3][i] << 6; };
          int before = end(0);
          for (int i = 0; i + 1 < dims[0]; ++i)
          {
            const int after = end(i + 1);
            const int corners = before | after << 1;
            if (corners != 0 && corners != 255 && (!wanted || wanted({i, j, k})))
              points.push_back({{i, j, k}, static_cast<std::uint8_t>(corners)});
            before = after;
          }
        }
      });
  std::vector<std::size_t> first(slices.size() + 1, 0);
  for (std::size_t k = 0; k < slices.size(); ++k)
    first[k + 1] = first[k] + slices[k].size();
  m_points.resize(first.back());
  m_positions.resize(first.back());
  tbb::parallel_for(std::size_t{0}, slices.size(),
                    [&](std::size_t k)
                    {
                      std::copy(slices[k].begin(), slices[k].end(),
                                m_points.begin() + static_cast<std::ptrdiff_t>(first[k]));
                      for (std::size_t n = first[k]; n < first[k + 1]; ++n)
                      {
                        const core::Index3& cell = m_points[n].cell;
                        m_pointOf->at(cell[0], cell[1], cell[2]) = static_cast<std::int32_t>(n + 1);
                      }
                    });
  // In the middle of where the border passes the cell's edges.
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
  forEachPoint(m_points.size(),
               [this](std::size_t n)
               {
                 const Point& point = m_points[n];
                 for (int face = 0; face < 6; ++face)
                 {
                   const int axis = face / 2;
                   const bool high = (face & 1) != 0;
                   int inside = 0;
                   for (int corner = 0; corner < 8; ++corner)
                     if ((corner >> axis & 1) == (high ? 1 : 0))
                       inside += point.corners >> corner & 1;
                   core::Index3 next = point.cell;
                   next[static_cast<std::size_t>(axis)] += high ? 1 : -1;
                   const bool passed = inside != 0 && inside != 4;
                   m_joined[n][static_cast<std::size_t>(face)] =
                       passed ? pointAt(next[0], next[1], next[2]) : -1;
                 }
               });
}

// The mean of the quadrangles round a point. Each spans the four cells round an edge whose ends lie
// on two sides.
void SurfaceNet::findNormals()
{
  m_normals.resize(m_points.size());
  forEachPoint(m_points.size(),
               [this](std::size_t n)
               {
                 const Point& point = m_points[n];
                 Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                 for (int e = 0; e < 12; ++e)
                 {
                   const int low = kEdges[e][0];
                   const bool lowInside = (point.corners >> low & 1) != 0;
                   if (lowInside == ((point.corners >> kEdges[e][1] & 1) != 0))
                     continue;
                   const auto axis = static_cast<std::size_t>(e / 4);
                   const std::size_t u = (axis + 1) % 3;
                   const std::size_t v = (axis + 2) % 3;
                   core::Index3 base =
                       point.cell; // of the four cells the one with the lowest indices
                   const core::Index3 corner = cornerOf(low);
                   base[u] += corner[u] - 1;
                   base[v] += corner[v] - 1;
                   std::array<int, 4> points{};
                   for (std::size_t p = 0; p < points.size(); ++p)
                   {
                     core::Index3 cell = base;
                     cell[u] += static_cast<int>(p & 1U);
                     cell[v] += static_cast<int>(p >> 1U);
                     points[p] = pointAt(cell[0], cell[1], cell[2]);
                   }
                   if (*std::min_element(points.begin(), points.end()) < 0)
                     continue; // at an edge of the net
                   const auto at = [&](std::size_t p) -> const Eigen::Vector3f&
                   { return m_positions[static_cast<std::size_t>(points[p])]; };
                   const Eigen::Vector3f quadrangle =
                       (at(3) - at(0)).cross(at(2) - at(1)); // its diagonals
                   sum += lowInside ? quadrangle : Eigen::Vector3f(-quadrangle);
                 }
                 m_normals[n] = sum;
               });
  std::vector<Eigen::Vector3f> scratch;
  average(m_normals, scratch, kNormalRounds, [](std::size_t, std::size_t) { return 1.0F; });
  forEachPoint(m_points.size(),
               [this](std::size_t n)
               {
                 Eigen::Vector3f& normal = m_normals[n];
                 const float length = normal.norm();
                 normal *= length > 1e-6F ? 1.0F / length : 0.0F;
               });
}

// Each round half of the way to the mean of those joined; `weightOf(point, other)`.
template <class T, class WeightOf>
void SurfaceNet::average(std::vector<T>& values, std::vector<T>& scratch, int rounds,
                         const WeightOf& weightOf) const
{
  scratch.resize(values.size());
  for (int round = 0; round < rounds; ++round)
  {
    forEachPoint(values.size(),
                 [&](std::size_t n)
                 {
                   T sum = 0.0F * values[n];
                   float weights = 0.0F;
                   for (const std::int32_t other : m_joined[n])
                     if (other >= 0)
                     {
                       const float weight = weightOf(n, static_cast<std::size_t>(other));
                       sum += weight * values[static_cast<std::size_t>(other)];
                       weights += weight;
                     }
                   scratch[n] = values[n];
                   if (weights >= 1e-3F)
                     scratch[n] = 0.5F * values[n] + 0.5F / weights * sum;
                 });
    values.swap(scratch);
  }
}

void SurfaceNet::relax(const core::Progress& progress)
{
  std::vector<float> curvature(m_points.size());
  std::vector<float> scratch;
  std::vector<Eigen::Vector3f> next(m_points.size());
  // From a point to the middle of those joined with it.
  const auto towardsMean = [this](std::size_t n) -> Eigen::Vector3f
  {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int count = 0;
    for (const std::int32_t other : m_joined[n])
      if (other >= 0)
      {
        sum += m_positions[static_cast<std::size_t>(other)];
        ++count;
      }
    if (count == 0)
      return sum;
    return sum / static_cast<float>(count) - m_positions[n];
  };
  const auto along = [this](std::size_t n, const Eigen::Vector3f& v)
  { return v.dot(m_normals[n]); };
  // A crease has its own curvature, which is none of the faces' beside it.
  const auto alike = [&](std::size_t n, std::size_t other)
  { return std::clamp((along(n, m_normals[other]) - kCrease) / (kSmooth - kCrease), 0.0F, 1.0F); };
  for (int relaxation = 0; relaxation < kRelaxations; ++relaxation)
  {
    forEachPoint(m_points.size(), [&](std::size_t n) { curvature[n] = along(n, towardsMean(n)); });
    average(curvature, scratch, kCurvatureRounds, alike);
    for (int step = 0; step < kStepsEach; ++step)
    {
      progress.check("smoothing structures");
      forEachPoint(m_points.size(),
                   [&](std::size_t n)
                   {
                     const Eigen::Vector3f low = toFloat(m_points[n].cell).array() + kClearance;
                     const Eigen::Vector3f high = low.array() + (1.0F - 2.0F * kClearance);
                     const Eigen::Vector3f move = towardsMean(n) - curvature[n] * m_normals[n];
                     next[n] = (m_positions[n] + kStep * move).cwiseMax(low).cwiseMin(high);
                   });
      m_positions.swap(next);
    }
    findNormals();
  }
}

std::shared_ptr<Volume<float>> smoothedShare(const Volume<std::uint8_t>& inside,
                                             const core::Progress& progress,
                                             const SurfaceNet::Wanted& wanted)
{
  auto share = makeZeroVolume<float>(inside.geometry());
  SurfaceNet net(inside, progress, wanted);
  net.relax(progress.part(0.0, 2.0 / 3.0));
  net.writeShare(*share, progress.part(2.0 / 3.0, 1.0));
  return share;
}

} // namespace petrous::volume
