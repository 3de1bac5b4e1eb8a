#include "petrous/Volume/MeshCut.h"

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

namespace petrous::volume
{

namespace
{

bool comesBefore(const Eigen::Vector3f& a, const Eigen::Vector3f& b)
{
  return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
}

} // namespace

std::vector<CutSegment> cutByPlane(const core::TriangleMesh& mesh, const Eigen::Vector3d& normal,
                                   double offset)
{
  std::vector<double> heights(mesh.vertices.size()); // mm beyond the plane
  std::vector<std::uint8_t> beyond(mesh.vertices.size());
  for (std::size_t n = 0; n < heights.size(); ++n)
  {
    heights[n] = normal.dot(mesh.vertices[n].cast<double>()) - offset;
    beyond[n] = heights[n] >= 0.0 ? 1 : 0;
  }
  const auto crossing = [&](std::uint32_t a, std::uint32_t b) -> Eigen::Vector3d
  {
    if (comesBefore(mesh.vertices[b], mesh.vertices[a]))
      std::swap(a, b);
    const Eigen::Vector3d from = mesh.vertices[a].cast<double>();
    const Eigen::Vector3d way = mesh.vertices[b].cast<double>() - from;
    return from + heights[a] / (heights[a] - heights[b]) * way;
  };
  std::vector<CutSegment> segments;
  for (const auto& triangle : mesh.triangles)
  {
    const int count = beyond[triangle[0]] + beyond[triangle[1]] + beyond[triangle[2]];
    if (count == 0 || count == 3)
      continue;
    CutSegment segment;
    for (std::size_t n = 0; n < 3; ++n)
    {
      const std::uint32_t a = triangle[n];
      const std::uint32_t b = triangle[(n + 1) % 3];
      if (beyond[a] != beyond[b])
        (beyond[a] != 0 ? segment.from : segment.to) = crossing(a, b);
    }
    segments.push_back(segment);
  }
  return segments;
}

} // namespace petrous::volume
