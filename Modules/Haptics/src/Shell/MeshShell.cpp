#include "petrous/Haptics/PointShell.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include <Eigen/Geometry>

#include "Covering.h"
#include "PointGrid.h"
#include "ShellBudget.h"
#include "petrous/Core/Error.h"

namespace petrous::haptics
{

namespace
{

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kSharpCorner = 0.5; // rad by which the angles around a vertex differ from 2 pi
constexpr double kSharpEdge = 0.6;   // rad between the normals of adjacent triangles
constexpr std::size_t kChoices = 40; // candidates for each point
constexpr std::size_t kMaxChoices = 200000;
constexpr int kRelaxations = 16;

struct Places
{
  std::vector<Vector3d> at;
  std::vector<Vector3d> normal;

  void add(const Vector3d& place, const Vector3d& outward)
  {
    at.push_back(place);
    normal.push_back(outward);
  }
};

class Surface
{
public:
  Surface(const core::TriangleMesh& mesh, const std::string& name)
  {
    if (mesh.triangles.empty())
      throw core::InvalidParameter(name + ": the mesh has no triangle");
    try
    {
      mesh.validate();
    }
    catch (const core::InvalidParameter& error)
    {
      throw core::InvalidParameter(name + ": " + error.what());
    }
    if (!mesh.isClosed())
      throw core::InvalidParameter(name + ": the mesh is not closed; a tool needs an inside");
    const double outward = mesh.signedVolume() < 0.0 ? -1.0 : 1.0;
    for (const auto& vertex : mesh.vertices)
      m_vertices.push_back(vertex.cast<double>());
    for (const auto& t : mesh.triangles)
    {
      const Vector3d cross =
          (m_vertices[t[1]] - m_vertices[t[0]]).cross(m_vertices[t[2]] - m_vertices[t[0]]);
      // A degenerate triangle has no normal, and its neighbours cover its points.
      if (!(cross.norm() > 0.0))
        continue;
      m_triangles.push_back(t);
      m_normals.push_back(outward * cross.normalized());
      m_area += 0.5 * cross.norm();
      m_areaUpTo.push_back(m_area);
    }
    if (m_triangles.empty())
      throw core::InvalidParameter(name + ": no triangle of the mesh has an area");
  }

  double area() const { return m_area; }

  // Vertices with the largest angle defect, sharpest first.
  Places corners(std::size_t most) const
  {
    std::vector<double> angles(m_vertices.size(), 0.0);
    std::vector<Vector3d> normals(m_vertices.size(), Vector3d::Zero());
    for (std::size_t n = 0; n < m_triangles.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k)
      {
        const auto& t = m_triangles[n];
        const Vector3d a = m_vertices[t[(k + 1) % 3]] - m_vertices[t[k]];
        const Vector3d b = m_vertices[t[(k + 2) % 3]] - m_vertices[t[k]];
        const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
        angles[t[k]] += angle;
        normals[t[k]] += angle * m_normals[n];
      }
    std::vector<std::pair<double, std::size_t>> sharp;
    for (std::size_t v = 0; v < m_vertices.size(); ++v)
    {
      const double lack = std::abs(2.0 * kPi - angles[v]);
      if (angles[v] > 0.0 && lack > kSharpCorner && normals[v].norm() > 1e-6)
        sharp.emplace_back(-lack, v);
    }
    std::sort(sharp.begin(), sharp.end());
    sharp.resize(std::min(sharp.size(), most));
    Places places;
    for (const auto& [lack, v] : sharp)
      places.add(m_vertices[v], normals[v].normalized());
    return places;
  }

  // Points at most `step` apart on sharp edges, including their ends.
  Places edges(double step) const
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> firstSide;
    Places places;
    for (std::size_t n = 0; n < m_triangles.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::uint32_t a = m_triangles[n][k];
        const std::uint32_t b = m_triangles[n][(k + 1) % 3];
        const auto [other, isNew] = firstSide.try_emplace(std::minmax(a, b), n);
        if (isNew)
          continue;
        const Vector3d& left = m_normals[other->second];
        const Vector3d& right = m_normals[n];
        const Vector3d mean = left + right;
        if (left.dot(right) > std::cos(kSharpEdge) || mean.norm() < 1e-6)
          continue;
        const Vector3d run = m_vertices[b] - m_vertices[a];
        const double parts = std::max(1.0, std::ceil(run.norm() / step));
        for (double part = 0.0; part <= parts; part += 1.0)
          places.add(m_vertices[a] + part / parts * run, mean.normalized());
      }
    return places;
  }

  // Points distributed by area, each triangle's on a low-discrepancy sequence (Roberts' R2).
  Places spread(std::size_t count) const
  {
    Places places;
    std::size_t triangle = 0;
    double u = 0.5;
    double v = 0.5;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double at = m_area * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      while (triangle + 1 < m_triangles.size() && m_areaUpTo[triangle] < at)
        ++triangle;
      u = std::fmod(u + 0.7548776662466927, 1.0);
      v = std::fmod(v + 0.5698402909980532, 1.0);
      const bool beyond = u + v > 1.0;
      const double s = beyond ? 1.0 - u : u;
      const double t = beyond ? 1.0 - v : v;
      const auto& corner = m_triangles[triangle];
      const Vector3d& origin = m_vertices[corner[0]];
      places.add(origin + s * (m_vertices[corner[1]] - origin) +
                     t * (m_vertices[corner[2]] - origin),
                 m_normals[triangle]);
    }
    return places;
  }

  double farthestFrom(const PointGrid& grid) const
  {
    Covering covering(grid);
    for (const auto& t : m_triangles)
      covering.add({m_vertices[t[0]], m_vertices[t[1]], m_vertices[t[2]]},
                   [](const Vector3d& p) { return p; });
    return covering.bound();
  }

private:
  std::vector<Vector3d> m_vertices;
  std::vector<std::array<std::uint32_t, 3>> m_triangles;
  std::vector<Vector3d> m_normals;
  std::vector<double> m_areaUpTo;
  double m_area = 0.0;
};

// The two sides of a thin blade are close but distinct.
bool sameSide(const Vector3d& normal, const Vector3d& other)
{
  return normal.dot(other) > 0.0;
}

// Farthest-point sampling (Gonzalez 1985): adds to `chosen` the choice farthest from all before,
// until it has `most` points or each choice is within `enough` of one. `cell` is of the order of
// the resulting spacing.
void addFarthest(Places& chosen, const Places& choices, std::size_t most, double enough,
                 double cell)
{
  if (choices.at.empty())
    return;
  std::vector<double> distance(choices.at.size());
  using Entry = std::pair<double, std::size_t>; // distance, minus index: ties go to the first
  std::priority_queue<Entry> farthest;
  double largest = 0.0;
  const PointGrid before(chosen.at, cell);
  for (std::size_t i = 0; i < distance.size(); ++i)
  {
    distance[i] = before
                      .nearest(choices.at[i], [&](std::size_t n)
                               { return sameSide(chosen.normal[n], choices.normal[i]); })
                      .distance;
    farthest.emplace(distance[i], choices.at.size() - i);
    largest = std::max(largest, 2.0 * (choices.at[i] - choices.at.front()).norm());
  }
  const PointGrid grid(choices.at, cell);
  const auto mark = [&](const Vector3d& at, const Vector3d& normal, double reach)
  {
    grid.near(at, reach,
              [&](std::size_t i)
              {
                const double d = (choices.at[i] - at).norm();
                if (d < distance[i] && sameSide(normal, choices.normal[i]))
                {
                  distance[i] = d;
                  farthest.emplace(d, choices.at.size() - i);
                }
              });
  };
  while (chosen.at.size() < most && !farthest.empty())
  {
    const auto [d, key] = farthest.top();
    farthest.pop();
    const std::size_t i = choices.at.size() - key;
    if (d != distance[i])
      continue; // outdated: its distance has decreased
    if (d <= enough)
      break;
    chosen.add(choices.at[i], choices.normal[i]);
    mark(choices.at[i], choices.normal[i], std::min(d, largest));
  }
}

// Lloyd relaxation: moves each point but the first `fixed` to the centre of the choices nearest to
// it, on the surface.
void relax(Places& chosen, std::size_t fixed, const Places& choices, double spacing)
{
  for (int round = 0; round < kRelaxations; ++round)
  {
    const PointGrid grid(chosen.at, spacing);
    std::vector<Vector3d> sum(chosen.at.size(), Vector3d::Zero());
    std::vector<double> count(chosen.at.size(), 0.0);
    std::vector<std::size_t> owner(choices.at.size());
    for (std::size_t i = 0; i < choices.at.size(); ++i)
    {
      owner[i] = grid.nearest(choices.at[i], [&](std::size_t n)
                              { return sameSide(chosen.normal[n], choices.normal[i]); })
                     .index;
      if (owner[i] == PointGrid::kNone)
        continue;
      sum[owner[i]] += choices.at[i];
      count[owner[i]] += 1.0;
    }
    std::vector<double> nearest(chosen.at.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < choices.at.size(); ++i)
    {
      const std::size_t n = owner[i];
      if (n == PointGrid::kNone || n < fixed)
        continue;
      const double d = (choices.at[i] - sum[n] / count[n]).squaredNorm();
      if (d < nearest[n])
      {
        nearest[n] = d;
        chosen.at[n] = choices.at[i];
        chosen.normal[n] = choices.normal[i];
      }
    }
  }
}

} // namespace

PointShell makeMeshShell(const core::TriangleMesh& mesh, const std::string& name,
                         std::size_t budget)
{
  checkShellBudget(budget, name);
  const Surface surface(mesh, name);
  // Spacing of a regular triangular lattice with that many points.
  const double step = std::sqrt(surface.area() / (std::sqrt(0.75) * static_cast<double>(budget)));

  Places chosen = surface.corners(budget / 4);
  const Places choices = surface.spread(std::min(kChoices * budget, kMaxChoices));
  if (chosen.at.empty())
    chosen.add(choices.at.front(), choices.normal.front());
  addFarthest(chosen, surface.edges(0.25 * step), budget / 2, 0.6 * step, step);
  const std::size_t fixed = chosen.at.size();
  addFarthest(chosen, choices, budget, 0.0, step);
  relax(chosen, fixed, choices, step);

  PointShell shell;
  shell.points = std::move(chosen.at);
  shell.normals = std::move(chosen.normal);
  for (const Vector3d& point : shell.points)
    shell.reach = std::max(shell.reach, point.norm());
  shell.spacing = surface.farthestFrom(PointGrid(shell.points, step));
  return shell;
}

} // namespace petrous::haptics
