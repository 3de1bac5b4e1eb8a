#include "petrous/Volume/MeshDecimation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "petrous/Core/Error.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::volume
{

namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kFewest = 4; // triangles of a closed surface
constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

/// The half-edges of a closed surface. Half-edge 3 f + c runs from corner c of face f to the next.
/// Each vertex has one ring of faces.
class HalfEdges
{
public:
  /// Throws InvalidParameter if an edge is not shared by exactly two faces of opposite direction.
  /// `split` becomes, for each vertex that stands for one of another's rings, that other.
  HalfEdges(const core::TriangleMesh& mesh, std::vector<std::uint32_t>& split)
    : m_isRemoved(mesh.triangles.size(), 0)
    , m_faces(mesh.triangles.size())
  {
    if (mesh.triangles.size() >= kNone / 3)
      throw core::InvalidParameter("decimation: the surface has too many triangles");
    const auto count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    m_origin.reserve(count);
    for (const auto& triangle : mesh.triangles)
      m_origin.insert(m_origin.end(), triangle.begin(), triangle.end());
    pair();
    m_start.assign(mesh.vertices.size(), kNone);
    std::vector<char> isSeen(count, 0);
    for (std::uint32_t h = 0; h < count; ++h)
    {
      if (isSeen[h] != 0)
        continue;
      std::uint32_t vertex = m_origin[h];
      if (m_start[vertex] != kNone) // another ring of faces at the same vertex
      {
        split.push_back(vertex);
        vertex = static_cast<std::uint32_t>(m_start.size());
        m_start.push_back(kNone);
      }
      m_start[vertex] = h;
      forEachOutgoing(vertex,
                      [&](std::uint32_t g)
                      {
                        isSeen[g] = 1;
                        m_origin[g] = vertex;
                      });
    }
  }

  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(m_origin.size()); }
  std::uint32_t twin(std::uint32_t h) const { return m_twin[h]; }
  std::uint32_t origin(std::uint32_t h) const { return m_origin[h]; }
  std::uint32_t target(std::uint32_t h) const { return m_origin[next(h)]; }
  std::uint32_t opposite(std::uint32_t h) const { return m_origin[previous(h)]; }
  bool isRemoved(std::uint32_t h) const { return m_isRemoved[h / 3] != 0; }
  std::size_t faces() const { return m_faces; }
  std::size_t vertices() const { return m_start.size(); }

  template <class Visit>
  void forEachOutgoing(std::uint32_t vertex, const Visit& visit) const
  {
    std::uint32_t h = m_start[vertex];
    do
    {
      visit(h);
      h = m_twin[previous(h)];
    } while (h != m_start[vertex]);
  }

  /// Parts that are connected by edges.
  std::size_t pieces() const
  {
    std::size_t found = 0;
    std::vector<char> isSeen(m_isRemoved.size(), 0);
    std::vector<std::uint32_t> pending;
    for (std::uint32_t face = 0; face < isSeen.size(); ++face)
    {
      if (isSeen[face] != 0)
        continue;
      ++found;
      isSeen[face] = 1;
      pending.push_back(face);
      while (!pending.empty())
      {
        const std::uint32_t h = 3 * pending.back();
        pending.pop_back();
        for (const std::uint32_t edge : {h, h + 1, h + 2})
        {
          const std::uint32_t beside = m_twin[edge] / 3;
          if (isSeen[beside] == 0)
          {
            isSeen[beside] = 1;
            pending.push_back(beside);
          }
        }
      }
    }
    return found;
  }

  /// Whether the surface stays closed, of the same genus and without a pair of faces back to back.
  bool isCollapsible(std::uint32_t h) const
  {
    const std::uint32_t left = opposite(h);
    const std::uint32_t right = opposite(m_twin[h]);
    if (left == right || valence(left) <= 3 || valence(right) <= 3)
      return false;
    int common = 0;
    forEachOutgoing(m_origin[h],
                    [&](std::uint32_t a)
                    {
                      forEachOutgoing(target(h), [&](std::uint32_t b)
                                      { common += target(a) == target(b) ? 1 : 0; });
                    });
    return common == 2;
  }

  /// Removes the two faces of the half-edge; its target takes its origin's place.
  void collapse(std::uint32_t h)
  {
    const std::uint32_t back = m_twin[h];
    const std::uint32_t kept = target(h);
    const std::uint32_t left = opposite(h);
    const std::uint32_t right = opposite(back);
    const std::uint32_t gone = m_origin[h];
    // From left and right to the kept vertex, and the other way.
    const std::uint32_t fromLeft = m_twin[next(h)];
    const std::uint32_t toLeft = m_twin[previous(h)];
    const std::uint32_t fromRight = m_twin[next(back)];
    const std::uint32_t toRight = m_twin[previous(back)];
    m_start[gone] = h;
    forEachOutgoing(gone, [&](std::uint32_t g) { m_origin[g] = kept; });
    m_start[gone] = kNone;
    m_twin[fromLeft] = toLeft;
    m_twin[toLeft] = fromLeft;
    m_twin[fromRight] = toRight;
    m_twin[toRight] = fromRight;
    m_start[kept] = toLeft;
    m_start[left] = fromLeft;
    m_start[right] = fromRight;
    m_isRemoved[h / 3] = m_isRemoved[back / 3] = 1;
    m_faces -= 2;
  }

private:
  void pair()
  {
    struct Edge
    {
      std::uint32_t low, high, half;
      bool operator<(const Edge& other) const
      {
        return std::tie(low, high, half) < std::tie(other.low, other.high, other.half);
      }
    };
    std::vector<Edge> edges(count());
    for (std::uint32_t h = 0; h < count(); ++h)
    {
      const std::uint32_t a = m_origin[h];
      const std::uint32_t b = target(h);
      edges[h] = {std::min(a, b), std::max(a, b), h};
    }
    std::sort(edges.begin(), edges.end());
    const auto isSame = [&](std::size_t a, std::size_t b)
    { return b < edges.size() && edges[a].low == edges[b].low && edges[a].high == edges[b].high; };
    m_twin.assign(edges.size(), kNone);
    for (std::size_t n = 0; n < edges.size(); n += 2)
    {
      if (!isSame(n, n + 1) || isSame(n, n + 2) ||
          m_origin[edges[n].half] == m_origin[edges[n + 1].half])
        throw core::InvalidParameter("decimation: the surface is not closed, or an edge of it has "
                                     "more than two triangles");
      m_twin[edges[n].half] = edges[n + 1].half;
      m_twin[edges[n + 1].half] = edges[n].half;
    }
  }

  int valence(std::uint32_t vertex) const
  {
    int found = 0;
    forEachOutgoing(vertex, [&found](std::uint32_t) { ++found; });
    return found;
  }

  std::vector<std::uint32_t> m_origin; // by half-edge
  std::vector<std::uint32_t> m_twin;
  std::vector<std::uint32_t> m_start; // a half-edge that leaves the vertex
  std::vector<char> m_isRemoved;      // by face
  std::size_t m_faces;
};

/// Sum of squared distances from planes, mm^4 by the weight of areas: x^T A x + 2 b^T x + c.
struct Quadric
{
  Matrix3d a = Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  double c = 0.0;

  Quadric& operator+=(const Quadric& other)
  {
    a += other.a;
    b += other.b;
    c += other.c;
    return *this;
  }
};

class EdgeCollapses
{
public:
  /// Positions are kept from the middle of the mesh, so that quadrics stay precise far from the
  /// origin.
  explicit EdgeCollapses(const core::TriangleMesh& mesh)
    : m_halfEdges(mesh, m_split)
  {
    const auto [lower, upper] = mesh.bounds();
    m_middle = 0.5 * (lower.cast<double>() + upper.cast<double>());
    m_points.reserve(m_halfEdges.vertices());
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      m_points.push_back(vertex.cast<double>() - m_middle);
    for (const std::uint32_t vertex : m_split)
      m_points.push_back(m_points[vertex]);
    m_quadrics.resize(m_points.size());
    for (std::uint32_t h = 0; h < m_halfEdges.count(); h += 3)
    {
      const Vector3d& corner = m_points[m_halfEdges.origin(h)];
      Vector3d normal = areaVector(h, corner);
      const double length = normal.norm();
      if (!(length > 0.0))
        continue;
      normal /= length;
      const double distance = -normal.dot(corner);
      const double weight = 0.5 * length;
      const Quadric plane{weight * normal * normal.transpose(), weight * distance * normal,
                          weight * distance * distance};
      for (const std::uint32_t edge : {h, h + 1, h + 2})
        m_quadrics[m_halfEdges.origin(edge)] += plane;
    }
  }

  std::size_t pieces() const { return m_halfEdges.pieces(); }

  /// Until there are no more than `triangles`, or no edge can be collapsed.
  void run(std::size_t triangles, const core::Progress& progress)
  {
    const std::size_t before = m_halfEdges.faces();
    const auto toRemove = static_cast<double>(before - std::min(before, triangles));
    std::size_t start = 0;
    do // again: an edge that was refused may be collapsible by now
    {
      start = m_halfEdges.faces();
      std::priority_queue<Candidate> queue = candidates(progress);
      while (!queue.empty() && m_halfEdges.faces() > triangles)
      {
        const Candidate next = queue.top();
        queue.pop();
        const std::uint32_t h = next.half;
        if (m_halfEdges.isRemoved(h) || m_halfEdges.origin(h) != next.origin ||
            m_halfEdges.target(h) != next.target)
          continue;
        const Place place = placeFor(h);
        if (!place.isFound)
          continue;
        if (place.cost > (1.0 + kSameCost) * next.cost) // its neighborhood has changed
        {
          queue.push({place.cost, h, next.origin, next.target});
          continue;
        }
        if (!m_halfEdges.isCollapsible(h) || turnsFace(h, place.at))
          continue;
        m_points[next.target] = place.at;
        m_quadrics[next.target] += m_quadrics[next.origin];
        m_halfEdges.collapse(h);
        m_halfEdges.forEachOutgoing(
            next.target,
            [&](std::uint32_t g)
            {
              const Place beside = placeFor(g);
              if (beside.isFound)
                queue.push({beside.cost, g, next.target, m_halfEdges.target(g)});
            });
        if (m_halfEdges.faces() % kReportEvery < 2)
          progress.report(static_cast<double>(before - m_halfEdges.faces()) / toRemove,
                          "decimation");
      }
    } while (m_halfEdges.faces() > triangles &&
             kMinProgress * (start - m_halfEdges.faces()) > m_halfEdges.faces());
  }

  core::TriangleMesh mesh() const
  {
    core::TriangleMesh made;
    made.triangles.reserve(m_halfEdges.faces());
    std::vector<std::uint32_t> place(m_points.size(), kNone);
    for (std::uint32_t h = 0; h < m_halfEdges.count(); h += 3)
    {
      if (m_halfEdges.isRemoved(h))
        continue;
      std::array<std::uint32_t, 3> triangle{};
      for (std::uint32_t c = 0; c < 3; ++c)
      {
        const std::uint32_t vertex = m_halfEdges.origin(h + c);
        if (place[vertex] == kNone)
        {
          place[vertex] = static_cast<std::uint32_t>(made.vertices.size());
          made.vertices.push_back((m_points[vertex] + m_middle).cast<float>());
        }
        triangle[c] = place[vertex];
      }
      made.triangles.push_back(triangle);
    }
    return made;
  }

private:
  static constexpr double kSameCost = 0.01;          // of the cost
  static constexpr double kRegularization = 1e-7;    // of the quadric's mean eigenvalue
  static constexpr double kLengthCost = 1e-9;        // short edges first where all is flat
  static constexpr double kMinCosine = 0.2;          // 78 degrees
  static constexpr double kMinHeight = 0.05;         // of a triangle, of its longest edge
  static constexpr double kFlat = 1e-4;              // the same, below which it has no normal
  static constexpr std::size_t kReportEvery = 16384; // faces
  static constexpr std::size_t kMinProgress = 1000;  // a further pass removes a part in as many

  struct Candidate
  {
    double cost;
    std::uint32_t half, origin, target;
    bool operator<(const Candidate& other) const // the least on top, in a fixed order
    {
      return std::tie(cost, half) > std::tie(other.cost, other.half);
    }
  };

  struct Place
  {
    bool isFound = false;
    Vector3d at = Vector3d::Zero();
    double cost = 0.0;
  };

  /// Twice the area of the half-edge's face, along its normal, if its origin were at `at`.
  Vector3d areaVector(std::uint32_t h, const Vector3d& at) const
  {
    return (m_points[m_halfEdges.target(h)] - at).cross(m_points[m_halfEdges.opposite(h)] - at);
  }

  /// The half-edges that leave either end, without those of the two faces that are to go.
  template <class Visit>
  void forEachKeptFace(std::uint32_t h, const Visit& visit) const
  {
    const std::uint32_t back = m_halfEdges.twin(h);
    for (const std::uint32_t end : {m_halfEdges.origin(h), m_halfEdges.target(h)})
      m_halfEdges.forEachOutgoing(end,
                                  [&](std::uint32_t g)
                                  {
                                    if (g / 3 != h / 3 && g / 3 != back / 3)
                                      visit(g);
                                  });
  }

  std::priority_queue<Candidate> candidates(const core::Progress& progress) const
  {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    std::vector<Candidate> found(m_halfEdges.count(), Candidate{kNever, 0, 0, 0});
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, m_halfEdges.count(), kReportEvery),
        [&](const tbb::blocked_range<std::uint32_t>& range)
        {
          progress.check("decimation");
          for (std::uint32_t h = range.begin(); h < range.end(); ++h)
          {
            if (m_halfEdges.isRemoved(h) || m_halfEdges.twin(h) < h)
              continue;
            const Place place = placeFor(h);
            if (place.isFound)
              found[h] = {place.cost, h, m_halfEdges.origin(h), m_halfEdges.target(h)};
          }
        });
    found.erase(std::remove_if(found.begin(), found.end(),
                               [](const Candidate& one) { return one.cost == kNever; }),
                found.end());
    return std::priority_queue<Candidate>(std::less<Candidate>(), std::move(found));
  }

  /// Where the edge's one vertex will be, which keeps the volume at the least quadric error; none
  /// where that is farther away than the neighbors are.
  Place placeFor(std::uint32_t h) const
  {
    const std::uint32_t first = m_halfEdges.origin(h);
    const std::uint32_t second = m_halfEdges.target(h);
    const Vector3d middle = 0.5 * (m_points[first] + m_points[second]);
    // With x from the middle, the faces' volume is gradient . x / 6, and to be volume / 6.
    Vector3d gradient = Vector3d::Zero();
    double volume = 0.0;
    double reach = 0.0;
    forEachKeptFace(h,
                    [&](std::uint32_t g)
                    {
                      const Vector3d base = areaVector(g, middle);
                      gradient += base;
                      volume += base.dot(m_points[m_halfEdges.origin(g)] - middle);
                      reach =
                          std::max(reach, (m_points[m_halfEdges.target(g)] - middle).squaredNorm());
                    });
    // The two faces at the edge hold none of it: the middle is in their planes.
    Quadric sum = m_quadrics[first];
    sum += m_quadrics[second];
    const Vector3d slope = sum.a * middle + sum.b;
    const double least = sum.c + middle.dot(sum.b + slope);
    const Matrix3d regular = sum.a + kRegularization / 3.0 * sum.a.trace() * Matrix3d::Identity();
    const Eigen::LLT<Matrix3d> solver(regular);
    if (solver.info() != Eigen::Success)
      return {};
    const Vector3d free = -solver.solve(slope);
    const Vector3d along = solver.solve(gradient);
    const double gain = gradient.dot(along);
    if (!(gain > 0.0))
      return {};
    const Vector3d x = free + along * ((volume - gradient.dot(free)) / gain);
    if (!x.allFinite() || x.squaredNorm() > reach)
      return {};
    const double error = std::max(0.0, x.dot(sum.a * x) + 2.0 * slope.dot(x) + least);
    return {true, middle + x,
            error +
                kLengthCost * sum.a.trace() * (m_points[first] - m_points[second]).squaredNorm()};
  }

  /// Whether a face would turn over or become a sliver.
  bool turnsFace(std::uint32_t h, const Vector3d& at) const
  {
    bool isBad = false;
    forEachKeptFace(
        h,
        [&](std::uint32_t g)
        {
          if (isBad)
            return;
          const Vector3d& corner = m_points[m_halfEdges.origin(g)];
          const Vector3d& b = m_points[m_halfEdges.target(g)];
          const Vector3d& c = m_points[m_halfEdges.opposite(g)];
          const auto longest = [&](const Vector3d& a) {
            return std::max({(a - b).squaredNorm(), (a - c).squaredNorm(), (b - c).squaredNorm()});
          };
          const Vector3d before = areaVector(g, corner);
          const Vector3d after = areaVector(g, at);
          const double areaBefore = before.norm();
          const double areaAfter = after.norm();
          const double heightBefore = areaBefore / longest(corner);
          const double heightAfter = areaAfter / longest(at);
          if (heightAfter < kMinHeight && !(heightAfter >= heightBefore))
            isBad = true;
          else if (heightBefore > kFlat)
            isBad = before.dot(after) < kMinCosine * areaBefore * areaAfter;
        });
    return isBad;
  }

  std::vector<std::uint32_t> m_split; // before the half-edges, which fill it
  HalfEdges m_halfEdges;
  Vector3d m_middle = Vector3d::Zero(); // patient LPS mm
  std::vector<Vector3d> m_points;       // from the middle, mm
  std::vector<Quadric> m_quadrics;
};

Triangle cornersOf(const core::TriangleMesh& mesh, std::size_t triangle)
{
  const auto& corners = mesh.triangles[triangle];
  return {mesh.vertices[corners[0]].cast<double>(), mesh.vertices[corners[1]].cast<double>(),
          mesh.vertices[corners[2]].cast<double>()};
}

constexpr std::size_t kPiece = 1024; // points or triangles in a task

/// Of those that triangles use.
double farthestVertex(const core::TriangleMesh& mesh, const MeshTree& from,
                      const core::Progress& progress)
{
  std::vector<char> isUsed(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      isUsed[corner] = 1;
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, mesh.vertices.size(), kPiece), 0.0,
      [&](const tbb::blocked_range<std::size_t>& range, double worst)
      {
        progress.check("decimation");
        for (std::size_t n = range.begin(); n < range.end(); ++n)
          if (isUsed[n] != 0)
            worst = std::max(worst, from.distance(mesh.vertices[n].cast<double>(),
                                                  std::numeric_limits<double>::infinity()));
        return worst;
      },
      [](double a, double b) { return std::max(a, b); });
}

struct SampledDistance
{
  double largest = 0.0;
  double integral = 0.0; // over the area, mm^3
  double area = 0.0;     // mm^2
};

/// Of the triangles' points, `step` mm apart or nearer, corners and centers of small triangles
/// included.
SampledDistance sampledDistance(const core::TriangleMesh& mesh, const MeshTree& from, double step,
                                const core::Progress& progress)
{
  const auto combined = [](SampledDistance a, const SampledDistance& b)
  {
    a.largest = std::max(a.largest, b.largest);
    a.integral += b.integral;
    a.area += b.area;
    return a;
  };
  constexpr int kMaxParts = 256; // of an edge
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), kPiece), SampledDistance{},
      [&](const tbb::blocked_range<std::size_t>& range, SampledDistance sum)
      {
        progress.check("decimation");
        const auto distance = [&from](const Vector3d& point)
        { return from.distance(point, std::numeric_limits<double>::infinity()); };
        for (std::size_t n = range.begin(); n < range.end(); ++n)
        {
          const Triangle corners = cornersOf(mesh, n);
          const Vector3d u = corners[1] - corners[0];
          const Vector3d v = corners[2] - corners[0];
          const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
          const int parts = static_cast<int>(
              std::clamp(std::ceil(longest / step), 1.0, static_cast<double>(kMaxParts)));
          // The centers of the parts^2 equal triangles, of both directions.
          const double area = 0.5 * u.cross(v).norm();
          double total = 0.0;
          for (int i = 0; i < parts; ++i)
            for (int j = 0; i + j < parts; ++j)
              for (const double third : {1.0 / 3.0, 2.0 / 3.0})
              {
                if (third > 0.5 && i + j + 1 >= parts)
                  continue;
                const double off =
                    distance(corners[0] + ((i + third) * u + (j + third) * v) / parts);
                total += off;
                sum.largest = std::max(sum.largest, off);
              }
          for (const Vector3d& corner : corners)
            sum.largest = std::max(sum.largest, distance(corner));
          sum.integral += area * total / (static_cast<double>(parts) * parts);
          sum.area += area;
        }
        return sum;
      },
      combined);
}

double meanEdge(const core::TriangleMesh& mesh)
{
  double sum = 0.0;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
  {
    const Triangle corners = cornersOf(mesh, n);
    for (std::size_t c = 0; c < 3; ++c)
      sum += (corners[c] - corners[(c + 1) % 3]).norm();
  }
  return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

/// Whether the inner of a segment passes through the inner of a triangle.
bool passesThrough(const Vector3d& from, const Vector3d& to, const Triangle& triangle)
{
  const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double before = normal.dot(from - triangle[0]);
  const double after = normal.dot(to - triangle[0]);
  if (!(before * after < 0.0))
    return false;
  const auto side = [&](const Vector3d& a, const Vector3d& b)
  { return (to - from).dot((a - from).cross(b - from)); };
  const double ab = side(triangle[0], triangle[1]);
  const double bc = side(triangle[1], triangle[2]);
  const double ca = side(triangle[2], triangle[0]);
  return (ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0);
}

/// Pairs of triangles, without an edge in common, of which an edge of one passes through the other.
std::size_t selfIntersections(const core::TriangleMesh& mesh, const MeshTree& tree,
                              const core::Progress& progress)
{
  const auto edgePasses = [&](std::size_t a, std::size_t b)
  {
    const auto& edges = mesh.triangles[a];
    const auto& face = mesh.triangles[b];
    const auto isCorner = [&face](std::uint32_t vertex)
    { return std::find(face.begin(), face.end(), vertex) != face.end(); };
    const Triangle points = cornersOf(mesh, a);
    for (std::size_t c = 0; c < 3; ++c)
      if (!isCorner(edges[c]) && !isCorner(edges[(c + 1) % 3]) &&
          passesThrough(points[c], points[(c + 1) % 3], cornersOf(mesh, b)))
        return true;
    return false;
  };
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), kPiece), std::size_t{0},
      [&](const tbb::blocked_range<std::size_t>& range, std::size_t found)
      {
        progress.check("decimation");
        for (std::size_t n = range.begin(); n < range.end(); ++n)
        {
          Eigen::AlignedBox3d box;
          for (const Vector3d& corner : cornersOf(mesh, n))
            box.extend(corner);
          for (const std::uint32_t other : tree.overlapping(box))
            found += other < n && (edgePasses(n, other) || edgePasses(other, n)) ? 1 : 0;
        }
        return found;
      },
      std::plus<>());
}

} // namespace

DecimatedMesh decimated(const core::TriangleMesh& mesh, std::size_t triangles,
                        const core::Progress& progress)
{
  if (triangles < kFewest)
    throw core::InvalidParameter("decimation: a closed surface has at least 4 triangles");
  mesh.validate();
  if (mesh.triangles.empty())
    throw core::InvalidParameter("decimation: the surface has no triangles");
  progress.report(0.0, "decimation");
  EdgeCollapses collapses(mesh);
  DecimatedMesh result;
  result.pieces = collapses.pieces();
  if (mesh.triangles.size() <= triangles)
  {
    result.mesh = mesh;
    return result;
  }
  if (triangles < kFewest * result.pieces)
    throw core::InvalidParameter("decimation: the surface has " + std::to_string(result.pieces) +
                                 " pieces that are not connected, and each needs at least 4 "
                                 "triangles; ask for " +
                                 std::to_string(kFewest * result.pieces) +
                                 " or more, or choose a threshold with less noise");
  collapses.run(triangles, progress.part(0.1, 0.5));
  result.mesh = collapses.mesh();
  if (result.mesh.triangles.size() > triangles)
    result.limit = "collapsing further edges would fold the surface or change its topology";
  const MeshTree fewer(result.mesh);
  progress.report(0.5, "decimation");
  result.fromGiven = farthestVertex(mesh, fewer, progress);
  progress.report(0.7, "decimation");
  result.selfIntersections = selfIntersections(result.mesh, fewer, progress);
  progress.report(0.8, "decimation");
  const SampledDistance back =
      sampledDistance(result.mesh, MeshTree(mesh), meanEdge(mesh), progress);
  result.toGiven = back.largest;
  result.mean = back.area > 0.0 ? back.integral / back.area : 0.0;
  progress.report(1.0, "decimation");
  return result;
}

} // namespace petrous::volume
