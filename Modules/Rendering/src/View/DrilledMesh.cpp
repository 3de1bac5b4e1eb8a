#include "DrilledMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "SurfaceActor.h"
#include "petrous/Rendering/SurfaceExtraction.h"

namespace petrous::rendering
{

namespace
{

constexpr double kLevel = 0.5; // of the mask
constexpr double kReach = 3.0; // lengths of an edge

/// Splits edges that the cut may meet until they are short. Each edge is judged by itself, so that
/// both triangles at it agree.
///
/// It ends: an edge counts as met if the cut is within kReach of its lengths, hence the longest
/// edge L of a triangle does, too, if one of at most kReach / (kReach + 1) L does. While the
/// longest does not, the half at L of a split triangle has sides of at most 0.87 L and 0.5 L, its
/// half of at most 0.7 L: two splits later L is split, and no triangle is longer than that of which
/// it is half.
class Refinement
{
public:
  Refinement(const core::TriangleMesh& mesh, const volume::CutMask& mask)
    : m_mask(mask)
    , m_longest(0.5 * mask.geometry().minSpacing())
    , m_result{{mesh.vertices, {}}, vertexNormals(mesh)}
  {
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      m_values.push_back(valueAt(vertex));
    m_waiting = mesh.triangles;
    while (!m_waiting.empty())
    {
      const std::array<std::uint32_t, 3> triangle = m_waiting.back();
      m_waiting.pop_back();
      split(triangle);
    }
  }

  const ShadedMesh& mesh() const noexcept { return m_result; }
  const std::vector<double>& values() const noexcept { return m_values; }

private:
  double valueAt(const Eigen::Vector3f& vertex) const
  {
    const Eigen::Vector3d patient = vertex.cast<double>();
    return m_mask.sample(m_mask.geometry().voxelFromPatient(patient)) - kLevel;
  }

  bool mayBeCut(std::uint32_t a, std::uint32_t b) const
  {
    const Eigen::Vector3d from = m_result.mesh.vertices[a].cast<double>();
    const Eigen::Vector3d to = m_result.mesh.vertices[b].cast<double>();
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kReach * (to - from).norm());
    return !m_mask.untouched(
        m_mask.geometry().boxCovering(from.cwiseMin(to) - reach, from.cwiseMax(to) + reach));
  }

  double lengthOf(std::uint32_t a, std::uint32_t b) const
  {
    return static_cast<double>((m_result.mesh.vertices[b] - m_result.mesh.vertices[a]).norm());
  }

  // At its longest edge of those that are to be split.
  void split(const std::array<std::uint32_t, 3>& triangle)
  {
    std::size_t longest = 3;
    double most = m_longest;
    for (std::size_t c = 0; c < 3; ++c)
    {
      const double length = lengthOf(triangle[c], triangle[(c + 1) % 3]);
      if (length > most && mayBeCut(triangle[c], triangle[(c + 1) % 3]))
      {
        most = length;
        longest = c;
      }
    }
    if (longest == 3)
    {
      m_result.mesh.triangles.push_back(triangle);
      return;
    }
    const std::uint32_t a = triangle[longest];
    const std::uint32_t b = triangle[(longest + 1) % 3];
    const std::uint32_t c = triangle[(longest + 2) % 3];
    const std::uint32_t middle = middleOf(a, b);
    m_waiting.push_back({a, middle, c});
    m_waiting.push_back({middle, b, c});
  }

  std::uint32_t middleOf(std::uint32_t a, std::uint32_t b)
  {
    const auto edge = std::minmax(a, b);
    const auto [entry, isNew] = m_middles.try_emplace({edge.first, edge.second}, 0U);
    if (isNew)
    {
      std::vector<Eigen::Vector3f>& vertices = m_result.mesh.vertices;
      std::vector<Eigen::Vector3f>& normals = m_result.normals;
      entry->second = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(0.5F * (vertices[edge.first] + vertices[edge.second]));
      normals.push_back((normals[edge.first] + normals[edge.second]).normalized());
      m_values.push_back(valueAt(vertices.back()));
    }
    return entry->second;
  }

  const volume::CutMask& m_mask;
  double m_longest; // mm
  ShadedMesh m_result;
  std::vector<double> m_values;
  std::vector<std::array<std::uint32_t, 3>> m_waiting;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> m_middles;
};

// The mask's level within a box of voxels, not closed at the box.
core::TriangleMesh levelIn(const volume::CutMask& mask, const core::IndexBox& box)
{
  volume::Volume<float> left(mask.geometry().cropped(box), 0.0F);
  const core::Index3 size = box.size();
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        left.at(i, j, k) =
            static_cast<float>(mask.at(i + box.lower[0], j + box.lower[1], k + box.lower[2])) /
                static_cast<float>(volume::CutMask::kUntouched) -
            static_cast<float>(kLevel);
  return isoTriangles(left);
}

} // namespace

ShadedMesh leftOf(const core::TriangleMesh& triangles, const volume::CutMask& mask)
{
  const Refinement refined(triangles, mask);
  return clip(refined.mesh(), refined.values());
}

DrilledMesh::DrilledMesh(std::shared_ptr<const core::TriangleMesh> mesh)
  : m_mesh(std::move(mesh))
  , m_tree(*m_mesh)
  , m_inside(*m_mesh)
{
}

std::optional<ShadedMesh> DrilledMesh::surface(const volume::CutMask& mask) const
{
  const auto [lower, upper] = m_mesh->bounds();
  const core::IndexBox box =
      mask.boxOf(mask.cutBricks())
          .intersected(mask.geometry().boxCovering(lower.cast<double>(), upper.cast<double>()));
  if (!closed() || box.empty())
    return std::nullopt;
  const Refinement refined(*m_mesh, mask);
  const core::TriangleMesh level = levelIn(mask, box);
  // Inside the mesh by so many mm; beyond a voxel's diagonal it does not matter by how many.
  const double limit = 2.0 * mask.geometry().spacing().norm();
  std::vector<double> depths;
  depths.reserve(level.vertices.size());
  for (const Eigen::Vector3f& vertex : level.vertices)
  {
    const Eigen::Vector3d at = vertex.cast<double>();
    const double distance = m_tree.distance(at, limit);
    depths.push_back(m_inside.contains(at) ? distance : -distance);
  }
  const auto isCut = [](double value) { return value < 0.0; };
  const auto isInside = [](double depth) { return depth > 0.0; };
  if (std::none_of(refined.values().begin(), refined.values().end(), isCut) &&
      std::none_of(depths.begin(), depths.end(), isInside))
    return std::nullopt;
  ShadedMesh surface = clip(refined.mesh(), refined.values());
  append(surface, clip({level, vertexNormals(level)}, depths));
  return surface;
}

} // namespace petrous::rendering
