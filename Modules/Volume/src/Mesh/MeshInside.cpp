#include "petrous/Volume/MeshInside.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "MeshTopology.h"

namespace petrous::volume
{

namespace
{

// Twice the signed area of (a, b, p).
std::int64_t orientation(const std::array<std::int64_t, 2>& a, const std::array<std::int64_t, 2>& b,
                         const std::array<std::int64_t, 2>& p) noexcept
{
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// The part of a triangle inside the box, as triangles (Sutherland and Hodgman 1974, plane by
// plane).
std::vector<Triangle> clipped(const Triangle& triangle, const Eigen::AlignedBox3d& box)
{
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& corner : triangle)
    bounds.extend(corner);
  if (box.contains(bounds))
    return {triangle};
  if (!box.intersects(bounds))
    return {};
  std::vector<Eigen::Vector3d> polygon(triangle.begin(), triangle.end());
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const double sense : {1.0, -1.0})
    {
      const double wall = sense > 0.0 ? box.min()[axis] : -box.max()[axis];
      std::vector<Eigen::Vector3d> kept;
      for (std::size_t c = 0; c < polygon.size(); ++c)
      {
        const Eigen::Vector3d& from = polygon[c];
        const Eigen::Vector3d& to = polygon[(c + 1) % polygon.size()];
        const double a = sense * from[axis] - wall;
        const double b = sense * to[axis] - wall;
        if (a >= 0.0)
          kept.push_back(from);
        if ((a >= 0.0) != (b >= 0.0))
          kept.push_back(from + a / (a - b) * (to - from));
      }
      polygon = std::move(kept);
    }
  std::vector<Triangle> parts;
  for (std::size_t c = 2; c < polygon.size(); ++c)
    parts.push_back({polygon[0], polygon[c - 1], polygon[c]});
  return parts;
}

} // namespace

MeshInside::MeshInside(const core::TriangleMesh& mesh)
{
  const MeshLattice lattice(mesh);
  const MeshTopology topology(mesh, lattice);
  m_base = lattice.base;
  m_unit = lattice.unit;
  m_openEdges = topology.openEdges;
  m_facesAlike = topology.facesAlike;
  m_triangles.reserve(topology.triangles.size());
  m_lattice.reserve(topology.triangles.size());
  for (const std::uint32_t t : topology.triangles)
  {
    Triangle triangle;
    std::array<Lattice, 3> projected;
    for (std::size_t c = 0; c < 3; ++c)
    {
      const std::uint32_t vertex = mesh.triangles[t][c];
      triangle[c] = mesh.vertices[vertex].cast<double>();
      projected[c] = {lattice.corners[vertex][1], lattice.corners[vertex][2]};
    }
    m_triangles.push_back(triangle);
    m_lattice.push_back(projected);
  }
  fillCells();
}

// About as many cells as triangles; fewer if long triangles overlap many cells.
void MeshInside::fillCells()
{
  constexpr std::size_t kMaxPlaces = 8; // cells per triangle, on average
  Lattice last{0, 0};
  for (const auto& triangle : m_lattice)
    for (const Lattice& corner : triangle)
      for (std::size_t a = 0; a < 2; ++a)
        last[a] = std::max(last[a], corner[a]);
  // The cells of a triangle's bounding box: first and last along y and z.
  const auto cellsOf = [this](const std::array<Lattice, 3>& triangle)
  {
    std::array<Lattice, 2> cells;
    for (std::size_t a = 0; a < 2; ++a)
    {
      const auto [low, high] = std::minmax({triangle[0][a], triangle[1][a], triangle[2][a]});
      cells[0][a] = low >> m_shift;
      cells[1][a] = high >> m_shift;
    }
    return cells;
  };
  const auto places = [&]()
  {
    std::int64_t sum = 0;
    for (const auto& triangle : m_lattice)
    {
      const auto [first, end] = cellsOf(triangle);
      sum += (end[0] - first[0] + 1) * (end[1] - first[1] + 1);
    }
    return static_cast<std::size_t>(sum);
  };
  const auto forCells = [&](const std::array<Lattice, 3>& triangle, const auto& visit)
  {
    const auto cells = cellsOf(triangle);
    for (std::int64_t z = cells[0][1]; z <= cells[1][1]; ++z)
      for (std::int64_t y = cells[0][0]; y <= cells[1][0]; ++y)
        visit(static_cast<std::size_t>(y + m_cells[0] * z));
  };
  const double along = std::sqrt(static_cast<double>(m_lattice.size()) + 1.0);
  m_shift = std::max(0, static_cast<int>(std::log2(2.0 * kMeshLatticeSteps / along)));
  while (m_shift < 25 && places() > kMaxPlaces * m_lattice.size())
    ++m_shift;
  m_cells = {(last[0] >> m_shift) + 1, (last[1] >> m_shift) + 1};

  m_cellStart.assign(static_cast<std::size_t>(m_cells[0] * m_cells[1]) + 1, 0);
  for (const auto& triangle : m_lattice)
    forCells(triangle, [this](std::size_t cell) { ++m_cellStart[cell + 1]; });
  std::partial_sum(m_cellStart.begin(), m_cellStart.end(), m_cellStart.begin());
  m_ofCell.resize(m_cellStart.back());
  std::vector<std::uint32_t> next(m_cellStart.begin(), m_cellStart.end() - 1);
  for (std::size_t t = 0; t < m_lattice.size(); ++t)
    forCells(m_lattice[t],
             [&](std::size_t cell) { m_ofCell[next[cell]++] = static_cast<std::uint32_t>(t); });
}

// Lines are at odd coordinates, vertices at even ones: a line never meets a vertex.
MeshInside::Lattice MeshInside::latticeOf(double y, double z) const
{
  const auto odd = [this](double value, double base)
  { return 2 * static_cast<std::int64_t>(std::floor((value - base) / m_unit)) + 1; };
  return {odd(y, m_base[1]), odd(z, m_base[2])};
}

// Contribution of the triangle to the winding number towards +x; 0 if the line misses it.
int MeshInside::turnAt(const std::array<Lattice, 3>& triangle, const Lattice& line,
                       std::array<double, 3>& weights) const
{
  const std::int64_t area = orientation(triangle[0], triangle[1], triangle[2]);
  if (area == 0)
    return 0;
  for (std::size_t e = 0; e < 3; ++e)
  {
    const Lattice& a = triangle[(e + 1) % 3];
    const Lattice& b = triangle[(e + 2) % 3];
    const std::int64_t side = orientation(a, b, line);
    // On an edge, the line is treated as shifted infinitesimally along y. This never applies to an
    // edge along y, which is at an even z.
    const bool positive = side != 0 ? side > 0 : b[1] < a[1];
    if (positive != (area > 0))
      return 0;
    weights[e] = static_cast<double>(side) / static_cast<double>(area);
  }
  return area > 0 ? -1 : 1;
}

void MeshInside::crossings(double y, double z, std::vector<double>& crossings) const
{
  crossings.clear();
  const Lattice line = latticeOf(y, z);
  if (line[0] < 0 || line[1] < 0 || (line[0] >> m_shift) >= m_cells[0] ||
      (line[1] >> m_shift) >= m_cells[1])
    return;
  std::vector<Crossing> all;
  const auto cell =
      static_cast<std::size_t>((line[0] >> m_shift) + m_cells[0] * (line[1] >> m_shift));
  for (std::uint32_t n = m_cellStart[cell]; n < m_cellStart[cell + 1]; ++n)
  {
    const std::uint32_t t = m_ofCell[n];
    std::array<double, 3> weights{};
    const int turn = turnAt(m_lattice[t], line, weights);
    if (turn == 0)
      continue;
    const Triangle& triangle = m_triangles[t];
    all.push_back(
        {weights[0] * triangle[0][0] + weights[1] * triangle[1][0] + weights[2] * triangle[2][0],
         turn});
  }
  std::sort(all.begin(), all.end(), [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
  int winding = 0;
  bool inside = false;
  for (const Crossing& crossing : all)
  {
    winding += crossing.turn;
    const bool next = m_facesAlike ? winding != 0 : !inside;
    if (next != inside)
      crossings.push_back(crossing.x);
    inside = next;
  }
}

bool MeshInside::contains(const Eigen::Vector3d& point) const
{
  std::vector<double> places;
  crossings(point[1], point[2], places);
  return (std::upper_bound(places.begin(), places.end(), point[0]) - places.begin()) % 2 == 1;
}

// +1 if the triangle's front is outside and its back inside, -1 if reversed, 0 if not on the
// surface.
int MeshInside::facing(const Triangle& triangle, const Eigen::Vector3d& point) const
{
  // Far enough from the triangle for the lattice to distinguish its sides.
  const double step = 8.0 * m_unit;
  const Eigen::Vector3d normal =
      (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  return int{contains(point - step * normal)} - int{contains(point + step * normal)};
}

void MeshInside::addSurface(const Triangle& triangle, double resolution,
                            std::vector<Triangle>& result) const
{
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d middle = (a + b + c) / 3.0;
  const int sense = facing(triangle, middle);
  const double edge =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  if (edge > resolution)
  {
    bool agree = true;
    for (const Eigen::Vector3d& corner : triangle)
      agree = agree && facing(triangle, corner + 0.1 * (middle - corner)) == sense;
    if (!agree)
    {
      const Eigen::Vector3d ab = 0.5 * (a + b);
      const Eigen::Vector3d bc = 0.5 * (b + c);
      const Eigen::Vector3d ca = 0.5 * (c + a);
      for (const Triangle& part :
           {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
        addSurface(part, resolution, result);
      return;
    }
  }
  if (sense > 0)
    result.push_back(triangle);
  else if (sense < 0)
    result.push_back({a, c, b});
}

std::vector<Triangle> MeshInside::surface(double resolution, const Eigen::AlignedBox3d& box) const
{
  constexpr std::size_t kChunk = 1024;
  std::vector<std::vector<Triangle>> chunks((m_triangles.size() + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, chunks.size(),
                    [&](std::size_t chunk)
                    {
                      const std::size_t last = std::min((chunk + 1) * kChunk, m_triangles.size());
                      for (std::size_t t = chunk * kChunk; t < last; ++t)
                        for (const Triangle& part : clipped(m_triangles[t], box))
                          addSurface(part, resolution, chunks[chunk]);
                    });
  std::vector<Triangle> result;
  for (const auto& chunk : chunks)
    result.insert(result.end(), chunk.begin(), chunk.end());
  return result;
}

} // namespace petrous::volume
