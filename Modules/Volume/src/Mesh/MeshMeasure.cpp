#include "petrous/Volume/MeshMeasure.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "DisjointSets.h"
#include "MeshTopology.h"
#include "petrous/Volume/MeshInside.h"

namespace petrous::volume
{

namespace
{

constexpr int kVolumeLines = 1024;      // along y and z
constexpr double kResolved = 0.01;      // of the smaller part: less in common is a touch
constexpr double kFlat = 1e-6;          // of the size: parts that only touch
constexpr std::size_t kFewestLines = 8; // lines along y and z by which two parts are compared
constexpr std::size_t kMostLines = 64;  // the same

struct Part
{
  std::vector<std::uint32_t> triangles; // of the mesh
  Eigen::AlignedBox3d box;
  double volume = 0.0; // mm^3, negative if it faces inwards
};

enum class Relation
{
  Apart,
  FirstInSecond,
  SecondInFirst,
  Overlapping
};

struct Pair
{
  std::uint32_t first;
  std::uint32_t second;
  Relation relation = Relation::Apart;
};

struct Arrangement
{
  std::vector<Part> parts;
  std::vector<Pair> pairs;            // that are not apart
  std::vector<std::uint32_t> cluster; // of each part: one of the parts that belong together
  std::vector<char> isReversed;       // of each cluster: its largest part faces inwards
  std::vector<char> isTangled;        // of each cluster: parts overlap or meet at edges
};

std::vector<Part> partsOf(const core::TriangleMesh& mesh, const MeshTopology& topology)
{
  std::vector<Part> parts(topology.parts);
  for (std::size_t n = 0; n < topology.triangles.size(); ++n)
  {
    Part& part = parts[topology.part[n]];
    part.triangles.push_back(topology.triangles[n]);
    for (const std::uint32_t vertex : mesh.triangles[topology.triangles[n]])
      part.box.extend(mesh.vertices[vertex].cast<double>().eval());
  }
  core::TriangleMesh alone{mesh.vertices, {}};
  for (Part& part : parts)
  {
    alone.triangles.clear();
    for (const std::uint32_t t : part.triangles)
      alone.triangles.push_back(mesh.triangles[t]);
    part.volume = alone.signedVolume();
  }
  return parts;
}

core::TriangleMesh extracted(const core::TriangleMesh& mesh,
                             const std::vector<std::uint32_t>& triangles)
{
  core::TriangleMesh result;
  std::vector<std::uint32_t> used;
  used.reserve(3 * triangles.size());
  for (const std::uint32_t t : triangles)
    used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t vertex : used)
    result.vertices.push_back(mesh.vertices[vertex]);
  for (const std::uint32_t t : triangles)
  {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = static_cast<std::uint32_t>(
          std::lower_bound(used.begin(), used.end(), mesh.triangles[t][c]) - used.begin());
    result.triangles.push_back(corners);
  }
  return result;
}

double lengthOf(const std::vector<double>& crossings)
{
  double length = 0.0;
  for (std::size_t n = 1; n < crossings.size(); n += 2)
    length += crossings[n] - crossings[n - 1];
  return length;
}

double sharedLength(const std::vector<double>& a, const std::vector<double>& b)
{
  double length = 0.0;
  for (std::size_t i = 1, j = 1; i < a.size() && j < b.size(); a[i] < b[j] ? i += 2 : j += 2)
    length += std::max(0.0, std::min(a[i], b[j]) - std::max(a[i - 1], b[j - 1]));
  return length;
}

// n-th of `count` lines through [low, high].
double lineAt(double low, double high, std::size_t n, std::size_t count)
{
  return low + (high - low) * (static_cast<double>(n) + 0.5) / static_cast<double>(count);
}

Relation compare(const Part& a, const MeshInside& insideA, const Part& b, const MeshInside& insideB)
{
  const Eigen::AlignedBox3d common = a.box.intersection(b.box);
  const double size = std::min(a.box.diagonal().norm(), b.box.diagonal().norm());
  if (common.isEmpty() || common.sizes().minCoeff() <= kFlat * size)
    return Relation::Apart;
  const auto fewer = static_cast<double>(std::min(a.triangles.size(), b.triangles.size()));
  const std::size_t lines =
      std::clamp(static_cast<std::size_t>(std::sqrt(fewer)), kFewestLines, kMostLines);
  double ofA = 0.0;
  double ofB = 0.0;
  double ofBoth = 0.0;
  std::vector<double> inA;
  std::vector<double> inB;
  for (std::size_t k = 0; k < lines; ++k)
    for (std::size_t j = 0; j < lines; ++j)
    {
      const double y = lineAt(common.min()[1], common.max()[1], j, lines);
      const double z = lineAt(common.min()[2], common.max()[2], k, lines);
      insideA.crossings(y, z, inA);
      insideB.crossings(y, z, inB);
      ofA += lengthOf(inA);
      ofB += lengthOf(inB);
      ofBoth += sharedLength(inA, inB);
    }
  if (ofBoth <= kResolved * std::min(ofA, ofB))
    return Relation::Apart;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kResolved * size);
  const auto isIn = [&](const Part& inner, double ofInner, const Part& outer)
  {
    return ofBoth >= (1.0 - kResolved) * ofInner &&
           Eigen::AlignedBox3d(outer.box.min() - margin, outer.box.max() + margin)
               .contains(inner.box);
  };
  if (isIn(a, ofA, b) && std::abs(a.volume) <= std::abs(b.volume))
    return Relation::FirstInSecond;
  if (isIn(b, ofB, a))
    return Relation::SecondInFirst;
  return Relation::Overlapping;
}

// Pairs of parts whose boxes intersect, by a sweep along x.
std::vector<Pair> pairsOf(const std::vector<Part>& parts)
{
  std::vector<std::uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&parts](std::uint32_t a, std::uint32_t b)
            { return parts[a].box.min()[0] < parts[b].box.min()[0]; });
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> open;
  for (const std::uint32_t part : order)
  {
    const Eigen::AlignedBox3d& box = parts[part].box;
    open.erase(std::remove_if(open.begin(), open.end(),
                              [&](std::uint32_t other)
                              { return parts[other].box.max()[0] < box.min()[0]; }),
               open.end());
    for (const std::uint32_t other : open)
      if (box.intersects(parts[other].box))
        pairs.push_back({std::min(part, other), std::max(part, other)});
    open.push_back(part);
  }
  return pairs;
}

Arrangement arrange(const core::TriangleMesh& mesh, const MeshTopology& topology)
{
  Arrangement all;
  all.parts = partsOf(mesh, topology);
  all.pairs = pairsOf(all.parts);
  std::vector<std::unique_ptr<MeshInside>> insides(all.parts.size());
  for (const Pair& pair : all.pairs)
    for (const std::uint32_t part : {pair.first, pair.second})
      if (!insides[part])
        insides[part] = std::make_unique<MeshInside>(extracted(mesh, all.parts[part].triangles));
  tbb::parallel_for(std::size_t{0}, all.pairs.size(),
                    [&](std::size_t n)
                    {
                      Pair& pair = all.pairs[n];
                      pair.relation = compare(all.parts[pair.first], *insides[pair.first],
                                              all.parts[pair.second], *insides[pair.second]);
                    });
  all.pairs.erase(std::remove_if(all.pairs.begin(), all.pairs.end(),
                                 [](const Pair& pair) { return pair.relation == Relation::Apart; }),
                  all.pairs.end());

  DisjointSets together(all.parts.size());
  for (const Pair& pair : all.pairs)
    together.unite(pair.first, pair.second);
  std::vector<double> largest(all.parts.size(), 0.0);
  all.isReversed.assign(all.parts.size(), 0);
  all.isTangled.assign(all.parts.size(), 0);
  for (std::uint32_t part = 0; part < all.parts.size(); ++part)
  {
    const std::uint32_t cluster = together.find(part);
    const double volume = all.parts[part].volume;
    all.cluster.push_back(cluster);
    if (std::abs(volume) > largest[cluster])
    {
      largest[cluster] = std::abs(volume);
      all.isReversed[cluster] = volume < 0.0;
    }
  }
  for (const Pair& pair : all.pairs)
    if (pair.relation == Relation::Overlapping)
      all.isTangled[all.cluster[pair.first]] = 1;
  for (std::uint32_t part = 0; part < all.parts.size(); ++part)
    if (topology.isTangled[part])
      all.isTangled[all.cluster[part]] = 1;
  return all;
}

// mm^3 inside, along lines.
double integrated(const MeshInside& inside, const Eigen::AlignedBox3d& box)
{
  std::vector<double> rows(kVolumeLines, 0.0);
  tbb::parallel_for(
      0, kVolumeLines,
      [&](int k)
      {
        std::vector<double> crossings;
        for (int j = 0; j < kVolumeLines; ++j)
        {
          inside.crossings(
              lineAt(box.min()[1], box.max()[1], static_cast<std::size_t>(j), kVolumeLines),
              lineAt(box.min()[2], box.max()[2], static_cast<std::size_t>(k), kVolumeLines),
              crossings);
          rows[static_cast<std::size_t>(k)] += lengthOf(crossings);
        }
      });
  const Eigen::Vector3d size = box.sizes();
  return std::accumulate(rows.begin(), rows.end(), 0.0) * size[1] * size[2] /
         (1.0 * kVolumeLines * kVolumeLines);
}

// Of a mesh whose parts do not face alike in themselves.
double mixedVolume(const core::TriangleMesh& mesh)
{
  const MeshInside inside(mesh);
  const auto bounds = mesh.bounds();
  const Eigen::AlignedBox3d box(bounds[0].cast<double>(), bounds[1].cast<double>());
  double sixfold = 0.0;
  for (const Triangle& t : inside.surface(box.diagonal().norm() / 256.0, box))
    sixfold += (t[0] - box.min()).dot((t[1] - box.min()).cross(t[2] - box.min()));
  return std::abs(sixfold) / 6.0;
}

} // namespace

MeshMeasure measure(const core::TriangleMesh& mesh)
{
  const MeshTopology topology(mesh, MeshLattice(mesh));
  MeshMeasure result;
  result.openEdges = topology.openEdges;
  result.doubled = topology.doubled;
  if (result.openEdges > 0)
    return result;
  result.parts = topology.parts;
  result.isMixed = !topology.facesAlike;
  if (result.isMixed)
  {
    result.volume = mixedVolume(mesh);
    return result;
  }
  const Arrangement all = arrange(mesh, topology);
  const auto signOf = [&all](std::uint32_t part) { return all.parts[part].volume < 0.0 ? -1 : 1; };
  std::vector<int> around(all.parts.size(), 0); // winding number just outside the part
  for (const Pair& pair : all.pairs)
    if (pair.relation == Relation::FirstInSecond)
      around[pair.first] += signOf(pair.second);
    else if (pair.relation == Relation::SecondInFirst)
      around[pair.second] += signOf(pair.first);

  double volume = 0.0;
  std::array<double, 2> facing{0.0, 0.0}; // mm^3 of the parts that face outwards, and inwards
  std::array<std::size_t, 2> outer{0, 0};
  std::vector<std::vector<std::uint32_t>> tangled(all.parts.size()); // triangles, by cluster
  for (std::uint32_t part = 0; part < all.parts.size(); ++part)
  {
    const std::uint32_t cluster = all.cluster[part];
    const double size = std::abs(all.parts[part].volume);
    const bool isOuter = around[part] == 0;
    const std::size_t side = signOf(part) < 0 ? 1 : 0;
    if (isOuter)
    {
      facing[side] += size;
      ++outer[side];
    }
    if (all.isTangled[cluster])
    {
      const auto& triangles = all.parts[part].triangles;
      tangled[cluster].insert(tangled[cluster].end(), triangles.begin(), triangles.end());
    }
    else if (isOuter)
      volume += size;
    else if (around[part] + signOf(part) == 0)
    {
      volume -= size;
      ++result.cavities;
    }
    else
      ++result.innerParts;
  }
  for (const auto& triangles : tangled)
    if (!triangles.empty())
    {
      const core::TriangleMesh cluster = extracted(mesh, triangles);
      const auto bounds = cluster.bounds();
      const double enclosed =
          integrated(MeshInside(cluster),
                     Eigen::AlignedBox3d(bounds[0].cast<double>(), bounds[1].cast<double>()));
      // By the divergence theorem each place counts as often as its winding number says.
      const double counted = std::abs(cluster.signedVolume());
      result.isOverlapping =
          result.isOverlapping || std::abs(counted - enclosed) > kResolved * enclosed;
      result.isOverlapHollow = result.isOverlapHollow || counted < (1.0 - kResolved) * enclosed;
      volume += enclosed;
    }
  result.volume = volume;
  result.reversedParts = facing[0] >= facing[1] ? outer[1] : outer[0];
  return result;
}

core::TriangleMesh oriented(const core::TriangleMesh& mesh)
{
  const MeshLattice lattice(mesh);
  const MeshTopology topology(mesh, lattice);
  constexpr std::uint32_t kNone = ~0U;
  std::vector<std::uint32_t> partOf(mesh.triangles.size(), kNone);
  std::vector<std::uint32_t> partAt(mesh.vertices.size(), kNone); // of coincident vertices
  for (std::size_t n = 0; n < topology.triangles.size(); ++n)
  {
    partOf[topology.triangles[n]] = topology.part[n];
    for (const std::uint32_t vertex : mesh.triangles[topology.triangles[n]])
      partAt[lattice.ids[vertex]] = topology.part[n];
  }
  std::optional<Arrangement> all;
  if (topology.openEdges == 0 && topology.facesAlike)
    all = arrange(mesh, topology);
  std::vector<std::uint32_t> kept;
  std::vector<char> isTurned;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& [a, b, c] = mesh.triangles[t];
    std::uint32_t part = partOf[t];
    if (part == kNone)
    {
      // A degenerate triangle stays, as others may be connected by its vertices.
      if (lattice.ids[a] != lattice.ids[b] && lattice.ids[b] != lattice.ids[c] &&
          lattice.ids[c] != lattice.ids[a])
        continue;
      part = partAt[lattice.ids[a]];
    }
    kept.push_back(t);
    isTurned.push_back(all && part != kNone && all->isReversed[all->cluster[part]]);
  }
  core::TriangleMesh result = extracted(mesh, kept);
  for (std::size_t n = 0; n < kept.size(); ++n)
    if (isTurned[n])
      std::swap(result.triangles[n][1], result.triangles[n][2]);
  return result;
}

} // namespace petrous::volume
