#include "MeshTopology.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "DisjointSets.h"

namespace petrous::volume
{

namespace
{

using Corners = std::array<std::uint32_t, 3>;

struct Edge
{
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle; // of those that are not degenerate
  int sense;
};

std::vector<Edge> sortedEdges(const std::vector<Corners>& triangles)
{
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
    {
      const std::uint32_t from = triangles[t][e];
      const std::uint32_t to = triangles[t][(e + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(t),
                       from < to ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b)
            { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  return edges;
}

// Calls visit(first, last) for the triangles at each edge.
template <class Visit>
void forEachEdge(const std::vector<Edge>& edges, const Visit& visit)
{
  for (auto first = edges.begin(); first != edges.end();)
  {
    const auto last = std::find_if(first, edges.end(),
                                   [&first](const Edge& edge)
                                   { return edge.low != first->low || edge.high != first->high; });
    visit(first, last);
    first = last;
  }
}

struct Copies
{
  std::vector<char> isCopy; // of an earlier triangle
  std::vector<char> isAlone;
  bool any = false;
};

Copies copiesAmong(const std::vector<Corners>& triangles)
{
  std::vector<std::pair<Corners, std::uint32_t>> keys;
  keys.reserve(triangles.size());
  for (Corners corners : triangles)
  {
    std::sort(corners.begin(), corners.end());
    keys.emplace_back(corners, static_cast<std::uint32_t>(keys.size()));
  }
  std::sort(keys.begin(), keys.end());
  Copies copies{std::vector<char>(triangles.size(), 0), std::vector<char>(triangles.size(), 1),
                false};
  for (std::size_t n = 1; n < keys.size(); ++n)
    if (keys[n].first == keys[n - 1].first)
    {
      copies.isCopy[keys[n].second] = 1;
      copies.isAlone[keys[n].second] = copies.isAlone[keys[n - 1].second] = 0;
      copies.any = true;
    }
  return copies;
}

} // namespace

MeshLattice::MeshLattice(const core::TriangleMesh& mesh)
{
  mesh.validate();
  const auto bounds = mesh.bounds();
  base = bounds[0].cast<double>();
  const double size = (bounds[1] - bounds[0]).cast<double>().maxCoeff();
  unit = size > 0.0 ? size / kMeshLatticeSteps : 1.0;
  corners.resize(mesh.vertices.size());
  for (std::size_t v = 0; v < corners.size(); ++v)
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      corners[v][a] =
          2 * std::llround((static_cast<double>(mesh.vertices[v][axis]) - base[axis]) / unit);
    }
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [this](std::uint32_t a, std::uint32_t b) { return corners[a] < corners[b]; });
  ids.resize(corners.size());
  for (std::size_t n = 0; n < order.size(); ++n)
    ids[order[n]] =
        n > 0 && corners[order[n]] == corners[order[n - 1]] ? ids[order[n - 1]] : order[n];
}

MeshTopology::MeshTopology(const core::TriangleMesh& mesh, const MeshLattice& lattice)
{
  std::vector<Corners> all;
  std::vector<std::uint32_t> indices;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    Corners one{};
    for (std::size_t c = 0; c < 3; ++c)
      one[c] = lattice.ids[mesh.triangles[t][c]];
    if (one[0] == one[1] || one[1] == one[2] || one[2] == one[0])
      continue;
    all.push_back(one);
    indices.push_back(static_cast<std::uint32_t>(t));
  }
  const std::vector<Edge> edges = sortedEdges(all);
  DisjointSets connected(all.size());
  forEachEdge(edges,
              [&](auto first, auto last)
              {
                for (auto edge = first + 1; edge != last; ++edge)
                  connected.unite(first->triangle, edge->triangle);
              });
  const Copies copies = copiesAmong(all);
  std::vector<char> isDropped(all.size(), 0);
  if (copies.any)
  {
    struct Count
    {
      std::size_t alone = 0;
      std::size_t open = 0;
      std::size_t openWithout = 0; // the copies
    };
    std::vector<Count> counts(all.size()); // of the part that a triangle stands for
    for (std::size_t t = 0; t < all.size(); ++t)
      counts[connected.find(static_cast<std::uint32_t>(t))].alone += copies.isAlone[t] != 0;
    forEachEdge(edges,
                [&](auto first, auto last)
                {
                  const auto kept = std::count_if(
                      first, last, [&](const Edge& edge) { return !copies.isCopy[edge.triangle]; });
                  Count& count = counts[connected.find(first->triangle)];
                  count.open += (last - first) % 2 != 0;
                  count.openWithout += kept % 2 != 0;
                });
    for (std::size_t t = 0; t < all.size(); ++t)
    {
      const Count& count = counts[connected.find(static_cast<std::uint32_t>(t))];
      const bool drops =
          count.openWithout < count.open || (count.alone == 0 && count.openWithout == count.open);
      isDropped[t] = drops && copies.isCopy[t];
      doubled += isDropped[t] != 0;
    }
  }
  forEachEdge(edges,
              [&](auto first, auto last)
              {
                int sum = 0;
                std::size_t count = 0;
                for (auto edge = first; edge != last; ++edge)
                  if (!isDropped[edge->triangle])
                  {
                    sum += edge->sense;
                    ++count;
                  }
                openEdges += count % 2;
                facesAlike = facesAlike && sum == 0;
              });
  // A part continues across an edge of two triangles. What is not closed then continues across
  // those of more: shells that only share an edge stay apart, and those with a wall in common do
  // not.
  DisjointSets joined(all.size());
  const auto forKept = [&](const auto& visit)
  {
    std::vector<std::uint32_t> kept;
    forEachEdge(edges,
                [&](auto first, auto last)
                {
                  kept.clear();
                  for (auto edge = first; edge != last; ++edge)
                    if (!isDropped[edge->triangle])
                      kept.push_back(edge->triangle);
                  visit(kept);
                });
  };
  forKept(
      [&joined](const auto& kept)
      {
        if (kept.size() == 2)
          joined.unite(kept[0], kept[1]);
      });
  std::vector<std::uint32_t> sheet(all.size()); // so far
  for (std::size_t t = 0; t < all.size(); ++t)
    sheet[t] = joined.find(static_cast<std::uint32_t>(t));
  forKept(
      [&](auto& kept)
      {
        if (kept.size() <= 2)
          return;
        std::sort(kept.begin(), kept.end(),
                  [&sheet](std::uint32_t a, std::uint32_t b) { return sheet[a] < sheet[b]; });
        std::optional<std::uint32_t> loose;
        for (std::size_t first = 0, last = 0; first < kept.size(); first = last)
        {
          while (last < kept.size() && sheet[kept[last]] == sheet[kept[first]])
            ++last;
          if ((last - first) % 2 == 0)
            continue;
          if (loose)
            joined.unite(*loose, kept[first]);
          loose = kept[first];
        }
      });

  constexpr std::uint32_t kNone = ~0U;
  std::vector<std::uint32_t> numbers(all.size(), kNone);
  for (std::size_t t = 0; t < all.size(); ++t)
  {
    if (isDropped[t])
      continue;
    std::uint32_t& number = numbers[joined.find(static_cast<std::uint32_t>(t))];
    if (number == kNone)
      number = static_cast<std::uint32_t>(parts++);
    triangles.push_back(indices[t]);
    part.push_back(number);
  }
  isTangled.assign(parts, 0);
  forKept(
      [&](auto& kept)
      {
        if (kept.size() <= 2)
          return;
        for (std::uint32_t& triangle : kept)
          triangle = numbers[joined.find(triangle)];
        std::sort(kept.begin(), kept.end());
        for (std::size_t n = 2; n < kept.size(); ++n)
          if (kept[n] == kept[n - 2])
            isTangled[kept[n]] = 1;
      });
}

} // namespace petrous::volume
