#include "ShadedMesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

namespace petrous::rendering
{

namespace
{
class Clipper
{
public:
  Clipper(const ShadedMesh& whole, const std::vector<double>& values)
    : m_values(values)
    , m_result{{whole.mesh.vertices, {}}, whole.normals}
  {
  }

  void add(const std::array<std::uint32_t, 3>& triangle)
  {
    // The clipped polygon has up to four corners, in the triangle's winding order.
    std::array<std::uint32_t, 4> corners{};
    std::size_t count = 0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      const std::uint32_t a = triangle[c];
      const std::uint32_t b = triangle[(c + 1) % 3];
      if (keeps(a))
        corners[count++] = a;
      if (keeps(a) != keeps(b))
        corners[count++] = between(a, b);
    }
    for (std::size_t c = 2; c < count; ++c)
      m_result.mesh.triangles.push_back({corners[0], corners[c - 1], corners[c]});
  }

  ShadedMesh take() { return std::move(m_result); }

private:
  bool keeps(std::uint32_t vertex) const { return m_values[vertex] >= 0.0; }

  // Both triangles at an edge share the new vertex.
  std::uint32_t between(std::uint32_t a, std::uint32_t b)
  {
    const auto edge = std::minmax(a, b);
    const auto [entry, isNew] = m_between.try_emplace({edge.first, edge.second}, 0U);
    if (isNew)
    {
      const double from = m_values[edge.first];
      const auto t = static_cast<float>(from / (from - m_values[edge.second]));
      const auto mix = [&](std::vector<Eigen::Vector3f>& list)
      { list.push_back((1.0F - t) * list[edge.first] + t * list[edge.second]); };
      entry->second = static_cast<std::uint32_t>(m_result.mesh.vertices.size());
      mix(m_result.mesh.vertices);
      mix(m_result.normals);
    }
    return entry->second;
  }

  const std::vector<double>& m_values;
  ShadedMesh m_result;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> m_between;
};
} // namespace

ShadedMesh clip(const ShadedMesh& whole, const std::vector<double>& values)
{
  Clipper clipper(whole, values);
  for (const auto& triangle : whole.mesh.triangles)
    clipper.add(triangle);
  return clipper.take();
}

void append(ShadedMesh& first, const ShadedMesh& second)
{
  const auto offset = static_cast<std::uint32_t>(first.mesh.vertices.size());
  first.mesh.vertices.insert(first.mesh.vertices.end(), second.mesh.vertices.begin(),
                             second.mesh.vertices.end());
  first.normals.insert(first.normals.end(), second.normals.begin(), second.normals.end());
  for (const auto& triangle : second.mesh.triangles)
    first.mesh.triangles.push_back(
        {triangle[0] + offset, triangle[1] + offset, triangle[2] + offset});
}

} // namespace petrous::rendering
