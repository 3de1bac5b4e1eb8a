#include "petrous/Presenters/StructureShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "petrous/Volume/Sampling.h"

namespace petrous::presenters
{

namespace
{

using core::Index3;
using Eigen::Vector3d;
using Occupancy = volume::Volume<float>;
using Line = std::vector<Vector3d>;

constexpr float kSurface = 0.5F;
constexpr std::size_t kMostNodes = 300'000; // of the graph in which the ends are found
constexpr double kTube = 1.5;               // length per median diameter, at least
constexpr int kRounds = 4;                  // of centring
constexpr double kSection = 1.0 / 3.0;      // pitch of a cross-section's samples, voxels
constexpr int kWidestSection = 150;         // samples from its middle

Vector3d asVector(const Index3& index)
{
  return {1.0 * index[0], 1.0 * index[1], 1.0 * index[2]};
}

double occupancyAt(const Occupancy& occupancy, const Vector3d& patient)
{
  const Vector3d voxel = occupancy.geometry().voxelFromPatient(patient);
  return occupancy.geometry().hullContains(voxel) ? volume::sampleTrilinear(occupancy, voxel) : 0.0;
}

bool isInside(const Occupancy& occupancy, const Vector3d& patient)
{
  return occupancyAt(occupancy, patient) >= double(kSurface);
}

template <class Visit>
void forEachInside(const Occupancy& occupancy, int stride, const Visit& visit)
{
  const Index3& dims = occupancy.geometry().dims();
  for (int k = 0; k < dims[2]; k += stride)
    for (int j = 0; j < dims[1]; j += stride)
      for (int i = 0; i < dims[0]; i += stride)
        if (occupancy.at(i, j, k) >= kSurface)
          visit(Index3{i, j, k});
}

std::size_t countInside(const Occupancy& occupancy)
{
  std::size_t count = 0;
  forEachInside(occupancy, 1, [&count](const Index3&) { ++count; });
  return count;
}

/// The voxels inside, each joined to its 26 neighbours.
class VoxelGraph
{
public:
  VoxelGraph(const Occupancy& occupancy, int stride)
    : m_stride(stride)
  {
    const Index3& dims = occupancy.geometry().dims();
    for (std::size_t a = 0; a < 3; ++a)
      m_dims[a] = (dims[a] + stride - 1) / stride;
    m_node.assign(std::size_t(m_dims[0]) * std::size_t(m_dims[1]) * std::size_t(m_dims[2]), kNone);
    forEachInside(occupancy, stride,
                  [&](const Index3& index)
                  {
                    m_node[place(index[0] / stride, index[1] / stride, index[2] / stride)] =
                        static_cast<std::uint32_t>(m_places.size());
                    m_places.push_back({index[0] / stride, index[1] / stride, index[2] / stride});
                    m_patient.push_back(occupancy.geometry().patientFromVoxel(asVector(index)));
                  });
  }

  std::size_t size() const { return m_places.size(); }
  const Vector3d& patient(std::size_t node) const { return m_patient[node]; }

  /// Length of the shortest way from a node to each, mm; infinite for those of other pieces.
  std::vector<double> distancesFrom(std::size_t start, const core::Progress& progress) const
  {
    std::size_t visited = 0;
    std::vector<double> distance(size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    distance[start] = 0.0;
    open.emplace(0.0, static_cast<std::uint32_t>(start));
    while (!open.empty())
    {
      const auto [way, node] = open.top();
      open.pop();
      if (way > distance[node])
        continue;
      if (++visited % kBetweenChecks == 0)
        progress.check("centre line");
      forEachNeighbour(node,
                       [&, w = way, from = node](std::uint32_t next)
                       {
                         const double there = w + (m_patient[next] - m_patient[from]).norm();
                         if (there >= distance[next])
                           return;
                         distance[next] = there;
                         open.emplace(there, next);
                       });
    }
    return distance;
  }

  /// A node of the largest piece.
  std::size_t largestPiece(const core::Progress& progress) const
  {
    progress.check("centre line");
    std::vector<bool> seen(size(), false);
    std::size_t best = 0, most = 0;
    for (std::size_t start = 0; start < size(); ++start)
    {
      if (seen[start])
        continue;
      std::vector<std::uint32_t> open{static_cast<std::uint32_t>(start)};
      seen[start] = true;
      std::size_t count = 0;
      while (!open.empty())
      {
        const std::uint32_t node = open.back();
        open.pop_back();
        ++count;
        forEachNeighbour(node,
                         [&](std::uint32_t next)
                         {
                           if (!seen[next])
                             open.push_back(next);
                           seen[next] = true;
                         });
      }
      if (count > most)
        std::tie(most, best) = std::make_pair(count, start);
    }
    return best;
  }

  template <class Visit>
  void forEachNeighbour(std::uint32_t node, const Visit& visit) const
  {
    const Index3& at = m_places[node];
    for (int n = 0; n < 27; ++n)
    {
      const int i = at[0] + n % 3 - 1, j = at[1] + n / 3 % 3 - 1, k = at[2] + n / 9 - 1;
      if (n == 13 || i < 0 || j < 0 || k < 0 || i >= m_dims[0] || j >= m_dims[1] || k >= m_dims[2])
        continue;
      if (const std::uint32_t next = m_node[place(i, j, k)]; next != kNone)
        visit(next);
    }
  }

private:
  static constexpr std::uint32_t kNone = ~0U;
  static constexpr std::size_t kBetweenChecks = 8192; // nodes: some milliseconds

  std::size_t place(int i, int j, int k) const
  {
    return static_cast<std::size_t>(i) +
           std::size_t(m_dims[0]) *
               (static_cast<std::size_t>(j) + std::size_t(m_dims[1]) * static_cast<std::size_t>(k));
  }

  int m_stride;
  Index3 m_dims{};
  std::vector<std::uint32_t> m_node; // by place
  std::vector<Index3> m_places;
  std::vector<Vector3d> m_patient;
};

std::size_t farthest(const std::vector<double>& distances)
{
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t n = 0; n < distances.size(); ++n)
    if (std::isfinite(distances[n]) && distances[n] > most)
    {
      most = distances[n];
      best = n;
    }
  return best;
}

double lengthOf(const Line& line)
{
  double length = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n)
    length += (line[n] - line[n - 1]).norm();
  return length;
}

/// With `count` points, equally far apart along the line.
Line resampled(const Line& line, std::size_t count)
{
  const double step = lengthOf(line) / static_cast<double>(count - 1);
  Line even{line.front()};
  double before = 0.0;
  std::size_t n = 1;
  while (even.size() + 1 < count)
  {
    const double wanted = step * static_cast<double>(even.size());
    double edge = (line[n] - line[n - 1]).norm();
    while (n + 1 < line.size() && before + edge < wanted)
    {
      before += edge;
      ++n;
      edge = (line[n] - line[n - 1]).norm();
    }
    const double share = edge > 0.0 ? std::clamp((wanted - before) / edge, 0.0, 1.0) : 0.0;
    even.push_back(line[n - 1] + share * (line[n] - line[n - 1]));
  }
  even.push_back(line.back());
  return even;
}

void smooth(Line& line, int passes)
{
  for (int pass = 0; pass < passes; ++pass)
  {
    Line next = line;
    for (std::size_t n = 1; n + 1 < line.size(); ++n)
      next[n] = 0.25 * line[n - 1] + 0.5 * line[n] + 0.25 * line[n + 1];
    line = std::move(next);
  }
}

struct Section
{
  double area = 0.0; // mm^2
  Vector3d centroid = Vector3d::Zero();
};

/// What of the plane lies inside, and together with the place of the plane nearest to `at` that
/// does.
Section sectionAt(const Occupancy& occupancy, const Vector3d& at, const Vector3d& normal)
{
  const double pitch = kSection * occupancy.geometry().minSpacing();
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  constexpr int kSide = 2 * kWidestSection + 1;
  std::vector<bool> seen(std::size_t(kSide) * std::size_t(kSide), false);
  const auto point = [&](int a, int b) -> Vector3d { return at + pitch * (a * u + b * v); };
  std::vector<std::array<int, 2>> open;
  const auto visit = [&](int a, int b)
  {
    if (std::abs(a) > kWidestSection || std::abs(b) > kWidestSection)
      return;
    const auto place = static_cast<std::size_t>((a + kWidestSection) * kSide + b + kWidestSection);
    if (seen[place])
      return;
    seen[place] = true;
    if (isInside(occupancy, point(a, b)))
      open.push_back({a, b});
  };
  for (int ring = 0; ring <= 12 && open.empty(); ++ring)
    for (int a = -ring; a <= ring; ++a)
      for (int b = -ring; b <= ring; ++b)
        if (open.empty() && std::max(std::abs(a), std::abs(b)) == ring)
          visit(a, b);
  std::size_t count = 0;
  double sumA = 0.0, sumB = 0.0;
  while (!open.empty())
  {
    const auto [a, b] = open.back();
    open.pop_back();
    ++count;
    sumA += a;
    sumB += b;
    visit(a + 1, b);
    visit(a - 1, b);
    visit(a, b + 1);
    visit(a, b - 1);
  }
  if (count == 0)
    return {0.0, at};
  const auto n = static_cast<double>(count);
  return {n * pitch * pitch, at + pitch / n * (sumA * u + sumB * v)};
}

double diameterOf(double area)
{
  constexpr double kPi = 3.141592653589793;
  return 2.0 * std::sqrt(area / kPi);
}

double medianOf(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of the line at a point, over `reach` points to both sides.
Vector3d tangentAt(const Line& line, std::size_t n, std::size_t reach)
{
  const std::size_t low = n > reach ? n - reach : 0;
  const std::size_t high = std::min(n + reach, line.size() - 1);
  const Vector3d along = line[high] - line[low];
  return along.norm() > 0.0 ? Vector3d(along.normalized()) : Vector3d(Vector3d::UnitZ());
}

/// From `at` in a direction up to the surface.
Vector3d exitFrom(const Occupancy& occupancy, const Vector3d& at, const Vector3d& direction)
{
  const double step = 0.25 * occupancy.geometry().minSpacing();
  double inside = 0.0, outside = step;
  while (isInside(occupancy, at + outside * direction))
  {
    inside = outside;
    outside += step;
  }
  for (int n = 0; n < 12; ++n)
  {
    const double middle = 0.5 * (inside + outside);
    (isInside(occupancy, at + middle * direction) ? inside : outside) = middle;
  }
  return at + inside * direction;
}

/// The structure by distance from one end: in each layer its connected pieces, and which pieces of
/// neighbouring layers touch [Reeb graph].
class Layers
{
public:
  Layers(const VoxelGraph& graph, const std::vector<double>& distances, double width)
    : m_pieceOf(graph.size(), kNone)
  {
    const auto layerOf = [&](std::size_t node)
    { return static_cast<std::size_t>(distances[node] / width); };
    std::vector<std::uint32_t> open;
    for (std::size_t start = 0; start < graph.size(); ++start)
    {
      if (m_pieceOf[start] != kNone || !std::isfinite(distances[start]))
        continue;
      const std::size_t layer = layerOf(start);
      const auto piece = static_cast<std::uint32_t>(m_pieces.size());
      m_pieces.push_back({layer, 0, Vector3d::Zero()});
      m_pieceOf[start] = piece;
      open.assign(1, static_cast<std::uint32_t>(start));
      while (!open.empty())
      {
        const std::uint32_t node = open.back();
        open.pop_back();
        ++m_pieces[piece].count;
        m_pieces[piece].sum += graph.patient(node);
        graph.forEachNeighbour(node,
                               [&](std::uint32_t next)
                               {
                                 if (m_pieceOf[next] == kNone && layerOf(next) == layer)
                                 {
                                   m_pieceOf[next] = piece;
                                   open.push_back(next);
                                 }
                               });
      }
    }
    for (std::uint32_t node = 0; node < graph.size(); ++node)
      if (m_pieceOf[node] != kNone)
        graph.forEachNeighbour(node,
                               [&](std::uint32_t next)
                               {
                                 if (m_pieceOf[next] < m_pieceOf[node])
                                   m_joins.emplace(m_pieceOf[next], m_pieceOf[node]);
                               });
    closeNotches();
  }

  /// Whether two ways part and meet again: a ring, or a hole from side to side. Pieces that are
  /// small in their layer, as of a rough surface, do not count.
  bool hasLoop() const
  {
    constexpr double kSmall = 0.1; // of the layer
    std::map<std::size_t, std::size_t> sizes;
    for (const Piece& piece : m_pieces)
      sizes[piece.layer] += piece.count;
    const auto counts = [&](std::uint32_t n)
    { return double(m_pieces[n].count) >= kSmall * double(sizes[m_pieces[n].layer]); };
    // A graph without loops falls into one more part for each join that is taken out.
    std::vector<std::uint32_t> root(m_pieces.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto rootOf = [&root](std::uint32_t n)
    {
      while (root[n] != n)
        n = root[n] = root[root[n]];
      return n;
    };
    for (const auto& [a, b] : m_joins)
    {
      if (!counts(a) || !counts(b))
        continue;
      const std::uint32_t one = rootOf(a), other = rootOf(b);
      if (one == other)
        return true;
      root[one] = other;
    }
    return false;
  }

  /// Centroids of the pieces through which the shortest way to a node leads, from the first on.
  Line wayTo(const VoxelGraph& graph, const std::vector<double>& distances, std::size_t node) const
  {
    std::vector<std::uint32_t> pieces;
    for (auto at = static_cast<std::uint32_t>(node);;)
    {
      if (pieces.empty() || pieces.back() != m_pieceOf[at])
        pieces.push_back(m_pieceOf[at]);
      std::uint32_t before = at;
      double least = distances[at];
      graph.forEachNeighbour(at,
                             [&](std::uint32_t next)
                             {
                               const double way = distances[next] +
                                                  (graph.patient(next) - graph.patient(at)).norm();
                               if (distances[next] < distances[at] && way <= least + 1e-9)
                               {
                                 least = way;
                                 before = next;
                               }
                             });
      if (before == at)
        break;
      at = before;
    }
    Line line;
    for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece)
      line.push_back(m_pieces[*piece].sum / double(m_pieces[*piece].count));
    return line;
  }

private:
  static constexpr std::uint32_t kNone = ~0U;

  // Pieces of one layer that join the same one before and the same one behind are parted by a hole
  // of a few voxels, which is no way of its own.
  void closeNotches()
  {
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<std::vector<std::uint32_t>> before(m_pieces.size()), behind(m_pieces.size());
    for (auto [a, b] : m_joins)
    {
      if (m_pieces[a].layer > m_pieces[b].layer)
        std::swap(a, b);
      behind[a].push_back(b);
      before[b].push_back(a);
    }
    std::map<Pair, std::uint32_t> first; // between two pieces
    std::vector<std::uint32_t> is(m_pieces.size());
    std::iota(is.begin(), is.end(), 0U);
    for (std::uint32_t n = 0; n < m_pieces.size(); ++n)
      for (const std::uint32_t a : before[n])
        for (const std::uint32_t b : behind[n])
          is[n] = std::min(is[n], is[first.emplace(Pair(a, b), n).first->second]);
    for (std::uint32_t n = 0; n < m_pieces.size(); ++n)
      if (is[n] != n)
      {
        m_pieces[is[n]].count += m_pieces[n].count;
        m_pieces[is[n]].sum += m_pieces[n].sum;
        m_pieces[n].count = 0;
      }
    for (std::uint32_t& piece : m_pieceOf)
      if (piece != kNone)
        piece = is[piece];
    std::set<Pair> joins;
    for (const auto& [a, b] : m_joins)
      joins.insert(std::minmax(is[a], is[b]));
    m_joins = std::move(joins);
  }

  struct Piece
  {
    std::size_t layer, count;
    Vector3d sum;
  };
  std::vector<std::uint32_t> m_pieceOf; // by node
  std::vector<Piece> m_pieces;
  std::set<std::pair<std::uint32_t, std::uint32_t>> m_joins; // the lower number first
};

constexpr char kNoTube[] = "it is no tube: too short for its width";

/// Centroids of the voxels equally far from one end, along the way to the other one.
Line roughLine(const Occupancy& occupancy, const core::Progress& progress, std::string& why)
{
  const std::size_t inside = countInside(occupancy);
  if (inside == 0)
    return {};
  const int stride = std::max(
      1, static_cast<int>(std::ceil(std::cbrt(double(inside) / double(kMostNodes)) - 1e-9)));
  const VoxelGraph graph(occupancy, stride);
  if (graph.size() == 0)
    return {};
  progress.check("centre line");
  const std::size_t end = farthest(graph.distancesFrom(graph.largestPiece(progress), progress));
  const std::vector<double> distances = graph.distancesFrom(end, progress);
  const std::size_t other = farthest(distances);
  const double whole = distances[other];
  const double width =
      std::max(2.0 * stride * occupancy.geometry().spacing().maxCoeff(), whole / 200.0);
  if (whole < 2.0 * width)
    return {};
  progress.check("centre line");
  const Layers layers(graph, distances, width);
  if (layers.hasLoop())
  {
    why = "it closes to a ring, or has a hole from side to side, so that no single line leads "
          "through it";
    return {};
  }
  return layers.wayTo(graph, distances, other);
}

/// Length of the longest stretch that lies outside, mm.
double longestOutside(const Occupancy& occupancy, const Line& line)
{
  const double step = 0.25 * occupancy.geometry().minSpacing();
  double longest = 0.0, outside = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n)
  {
    const double edge = (line[n] - line[n - 1]).norm();
    const int parts = std::max(1, static_cast<int>(std::ceil(edge / step)));
    for (int part = 0; part < parts; ++part)
    {
      const Vector3d at = line[n - 1] + (part + 0.5) / parts * (line[n] - line[n - 1]);
      outside = isInside(occupancy, at) ? 0.0 : outside + edge / parts;
      longest = std::max(longest, outside);
    }
  }
  return longest;
}

double nearestParameter(const Line& line, const Vector3d& patient) // in points
{
  double best = std::numeric_limits<double>::infinity();
  double parameter = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n)
  {
    const Vector3d edge = line[n] - line[n - 1];
    const double square = edge.squaredNorm();
    const double share =
        square > 0.0 ? std::clamp((patient - line[n - 1]).dot(edge) / square, 0.0, 1.0) : 0.0;
    const double distance = (line[n - 1] + share * edge - patient).squaredNorm();
    if (distance < best)
    {
      best = distance;
      parameter = static_cast<double>(n - 1) + share;
    }
  }
  return parameter;
}

Vector3d pointAt(const Line& line, double parameter)
{
  const auto n = std::min(static_cast<std::size_t>(parameter), line.size() - 2);
  return line[n] + (parameter - static_cast<double>(n)) * (line[n + 1] - line[n]);
}

} // namespace

std::vector<Vector3d> surfacePoints(const Occupancy& occupancy)
{
  std::vector<Vector3d> points;
  const core::GridGeometry& grid = occupancy.geometry();
  const Index3& dims = grid.dims();
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          Index3 next{i, j, k};
          if (++next[axis] == dims[axis])
            continue;
          const float a = occupancy.at(i, j, k) - kSurface;
          const float b = occupancy.at(next[0], next[1], next[2]) - kSurface;
          if ((a >= 0.0F) == (b >= 0.0F))
            continue;
          Vector3d voxel = asVector({i, j, k});
          voxel[static_cast<Eigen::Index>(axis)] += double(a / (a - b));
          points.push_back(grid.patientFromVoxel(voxel));
        }
  return points;
}

std::optional<PrincipalBox> principalBox(const Occupancy& occupancy)
{
  const core::GridGeometry& grid = occupancy.geometry();
  PrincipalBox box;
  Vector3d sum = Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  std::size_t count = 0;
  const Vector3d about = grid.center();
  forEachInside(occupancy, 1,
                [&](const Index3& index)
                {
                  const Vector3d at = grid.patientFromVoxel(asVector(index)) - about;
                  sum += at;
                  products += at * at.transpose();
                  ++count;
                });
  const std::vector<Vector3d> surface = surfacePoints(occupancy);
  if (count == 0 || surface.empty())
    return std::nullopt;
  const Vector3d mean = sum / static_cast<double>(count);
  box.center = about + mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      products / static_cast<double>(count) - mean * mean.transpose());
  std::array<std::pair<double, Vector3d>, 3> axes;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const Vector3d axis = solver.eigenvectors().col(static_cast<Eigen::Index>(a));
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Vector3d& point : surface)
    {
      least = std::min(least, axis.dot(point));
      most = std::max(most, axis.dot(point));
    }
    axes[a] = {most - least, axis};
  }
  std::sort(axes.begin(), axes.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    box.extents[a] = axes[static_cast<std::size_t>(a)].first;
    box.axes.col(a) = axes[static_cast<std::size_t>(a)].second;
  }
  return box;
}

double CentreLine::length() const
{
  return lengthOf(points);
}

std::optional<CentreLine> centreLine(const Occupancy& occupancy, const core::Progress& progress,
                                     std::string* why)
{
  constexpr double kLeaves = 4.0; // voxels outside: a notch, no way of its own
  std::string reason;
  std::string& noTube = why ? *why : reason;
  noTube = kNoTube;
  progress.check("centre line");
  Line line = roughLine(occupancy, progress, noTube);
  const double voxel = occupancy.geometry().spacing().maxCoeff();
  if (line.size() < 3 || lengthOf(line) < 2.0 * voxel)
    return std::nullopt;
  const double step = std::max(voxel, lengthOf(line) / 400.0);
  const auto evenly = [step](const Line& one)
  {
    return resampled(one, std::max<std::size_t>(
                              5, 1 + static_cast<std::size_t>(std::lround(lengthOf(one) / step))));
  };
  line = evenly(line);
  std::vector<double> diameters;
  for (int round = 0; round < kRounds; ++round)
  {
    progress.check("centre line");
    progress.report(double(round) / kRounds, "centre line");
    const double radius = diameters.empty() ? 2.0 * voxel : 0.5 * medianOf(diameters);
    const auto reach = std::max<std::size_t>(1, static_cast<std::size_t>(radius / step));
    smooth(line, static_cast<int>(std::ceil(0.25 * radius * radius / (step * step))) + 1);
    diameters.clear();
    Line centred;
    for (std::size_t n = 0; n < line.size(); ++n)
    {
      progress.check("centre line");
      const Section section = sectionAt(occupancy, line[n], tangentAt(line, n, reach));
      centred.push_back(section.centroid);
      diameters.push_back(diameterOf(section.area));
    }
    // The ends, cut obliquely, are not centred: they are drawn anew, straight on.
    const double bent = std::min(0.5 * medianOf(diameters), 0.25 * lengthOf(centred));
    const auto away = [&](std::size_t n, bool front)
    {
      double way = 0.0;
      for (std::size_t m = front ? 0 : n; m < (front ? n : centred.size() - 1); ++m)
        way += (centred[m + 1] - centred[m]).norm();
      return way;
    };
    std::size_t first = 0, last = centred.size() - 1;
    while (first + 2 < last && away(first, true) < bent)
      ++first;
    while (last > first + 2 && away(last, false) < bent)
      --last;
    Line kept(centred.begin() + static_cast<std::ptrdiff_t>(first),
              centred.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    smooth(kept, 2);
    const auto ahead = std::min<std::size_t>(std::max<std::size_t>(2, reach), kept.size() - 1);
    const Vector3d back = (kept.front() - kept[ahead]).normalized();
    const Vector3d on = (kept.back() - kept[kept.size() - 1 - ahead]).normalized();
    kept.insert(kept.begin(), exitFrom(occupancy, kept.front(), back));
    kept.push_back(exitFrom(occupancy, kept.back(), on));
    line = evenly(kept);
  }
  CentreLine result;
  result.points = line;
  const auto reach =
      std::max<std::size_t>(1, static_cast<std::size_t>(0.5 * medianOf(diameters) / step));
  // At the ends themselves a section is that of the cap: the one beside it counts.
  for (std::size_t n = 0; n < line.size(); ++n)
  {
    progress.check("centre line");
    const std::size_t m = std::clamp<std::size_t>(n, 1, line.size() - 2);
    result.diameters.push_back(
        diameterOf(sectionAt(occupancy, line[m], tangentAt(line, m, reach)).area));
  }
  const double median = medianOf(result.diameters);
  if (result.length() < kTube * median || result.length() < 4.0 * voxel)
    return std::nullopt;
  if (longestOutside(occupancy, line) > kLeaves * voxel)
  {
    noTube = "its middle lies outside of it, as it is hollow or folded";
    return std::nullopt;
  }
  noTube.clear();
  return result;
}

std::vector<Vector3d> partOf(const CentreLine& line, const Vector3d& from, const Vector3d& to)
{
  const double a = nearestParameter(line.points, from);
  const double b = nearestParameter(line.points, to);
  Line part{pointAt(line.points, std::min(a, b))};
  for (auto n = static_cast<std::size_t>(std::floor(std::min(a, b))) + 1;
       static_cast<double>(n) < std::max(a, b); ++n)
    part.push_back(line.points[n]);
  part.push_back(pointAt(line.points, std::max(a, b)));
  if (a > b)
    std::reverse(part.begin(), part.end());
  return part;
}

double distanceTo(const CentreLine& line, const Vector3d& patient)
{
  return (pointAt(line.points, nearestParameter(line.points, patient)) - patient).norm();
}

ShortestWay shortestWay(const Vector3d& from, const volume::SurfaceDistance& to)
{
  constexpr double kFar = 1e4; // mm
  const double distance = to.at(from, kFar);
  // Towards the surface: against the gradient of the distance to it.
  constexpr double kStep = 0.01; // mm
  Vector3d slope;
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    const Vector3d step = kStep * Vector3d::Unit(a);
    slope[a] = to.at(from + step, kFar) - to.at(from - step, kFar);
  }
  const Vector3d way =
      slope.norm() > 0.0 ? Vector3d(distance * slope.normalized()) : Vector3d(Vector3d::Zero());
  return {std::max(distance, 0.0), from, from - way};
}

std::optional<ShortestWay> shortestWay(const Occupancy& from, const volume::SurfaceDistance& to,
                                       const core::Progress& progress)
{
  const std::vector<Vector3d> surface = surfacePoints(from);
  if (surface.empty())
    return std::nullopt;
  double best = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  // A coarse look first: what is then farther is left soon.
  for (const std::size_t stride : {std::size_t(64), std::size_t(1)})
    for (std::size_t n = 0; n < surface.size(); n += stride)
    {
      if (n % 4096 == 0)
        progress.check("distance of structures");
      const double bound = std::isfinite(best) ? std::max(best, 1e-3) : 1e4;
      const double there = to.at(surface[n], bound);
      if (there < best)
      {
        best = there;
        nearest = n;
      }
      if (best <= 0.0) // they touch
        return ShortestWay{0.0, surface[nearest], surface[nearest]};
    }
  return shortestWay(surface[nearest], to);
}

} // namespace petrous::presenters
