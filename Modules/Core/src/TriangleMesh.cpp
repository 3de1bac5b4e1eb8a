#include "petrous/Core/TriangleMesh.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"

namespace petrous::core
{

double TriangleMesh::signedVolume() const
{
  if (vertices.empty())
    return 0.0;
  // Relative to one vertex, to avoid cancellation far from the origin.
  const Eigen::Vector3d base = vertices.front().cast<double>();
  double sixfold = 0.0;
  for (const auto& t : triangles)
  {
    const Eigen::Vector3d a = vertices[t[0]].cast<double>() - base;
    const Eigen::Vector3d b = vertices[t[1]].cast<double>() - base;
    const Eigen::Vector3d c = vertices[t[2]].cast<double>() - base;
    sixfold += a.dot(b.cross(c));
  }
  return sixfold / 6.0;
}

bool TriangleMesh::isClosed() const
{
  if (triangles.empty())
    return false;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(triangles.size() * 3);
  for (const auto& t : triangles)
    for (std::size_t e = 0; e < 3; ++e)
      edges.emplace_back(t[e], t[(e + 1) % 3]);
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end())
    return false;
  return std::all_of(edges.begin(), edges.end(),
                     [&edges](const auto& edge)
                     {
                       return std::binary_search(edges.begin(), edges.end(),
                                                 std::make_pair(edge.second, edge.first));
                     });
}

std::array<Eigen::Vector3f, 2> TriangleMesh::bounds() const
{
  if (vertices.empty())
    return {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  std::array<Eigen::Vector3f, 2> box{vertices.front(), vertices.front()};
  for (const auto& v : vertices)
  {
    box[0] = box[0].cwiseMin(v);
    box[1] = box[1].cwiseMax(v);
  }
  return box;
}

void TriangleMesh::validate() const
{
  for (const auto& v : vertices)
    if (!v.allFinite())
      throw InvalidParameter("mesh: a vertex is not finite");
  for (const auto& t : triangles)
    for (const std::uint32_t index : t)
      if (index >= vertices.size())
        throw InvalidParameter("mesh: a triangle names vertex " + std::to_string(index) + " of " +
                               std::to_string(vertices.size()));
}

} // namespace petrous::core
