#include "MeshShares.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "petrous/Volume/MeshInside.h"

namespace petrous::rendering
{

namespace
{

constexpr std::size_t kManyRows = 1U << 12U; // of texels: then fewer lines each

// Texel i of an axis is from i to i + 1.
core::TriangleMesh inTexels(const core::TriangleMesh& mesh, const core::GridGeometry& ct,
                            const core::Index3& factor)
{
  const Eigen::Array3d voxels(factor[0], factor[1], factor[2]);
  core::TriangleMesh result{{}, mesh.triangles};
  result.vertices.reserve(mesh.vertices.size());
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    result.vertices.push_back(((ct.voxelFromPatient(vertex.cast<double>()).array() + 0.5) / voxels)
                                  .matrix()
                                  .cast<float>());
  return result;
}

// Adds the part of each texel of a row, which begins at texel `first`, that lies between two
// positions.
void addSpan(double from, double to, int first, std::vector<double>& row)
{
  const double size = static_cast<double>(row.size());
  const double begin = std::clamp(from - first, 0.0, size);
  const double end = std::clamp(to - first, 0.0, size);
  for (auto i = static_cast<std::size_t>(begin); i < row.size() && static_cast<double>(i) < end;
       ++i)
    row[i] += std::min(end, static_cast<double>(i) + 1.0) - std::max(begin, static_cast<double>(i));
}

} // namespace

MeshShares meshShares(const core::TriangleMesh& mesh, const core::GridGeometry& ct,
                      const core::Index3& factor)
{
  MeshShares result;
  if (mesh.triangles.empty())
    return result;
  const core::TriangleMesh moved = inTexels(mesh, ct, factor);
  const volume::MeshInside inside(moved);
  if (inside.openEdges() > 0)
    return result;
  const auto [lower, upper] = moved.bounds();
  core::IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double texels = (ct.dims()[a] + factor[a] - 1) / factor[a];
    const auto texel = [&](float at)
    { return static_cast<int>(std::clamp(static_cast<double>(at), 0.0, texels)); };
    box.lower[a] = texel(std::floor(lower[axis]));
    box.upper[a] = texel(std::ceil(upper[axis]));
  }
  if (box.empty())
    return result;
  result.box = box;
  result.shares.resize(box.count());
  const core::Index3 size = box.size();
  const auto width = static_cast<std::size_t>(size[0]);
  const std::size_t rows = result.shares.size() / width;
  const int lines = rows > kManyRows ? 2 : 4; // along two axes
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, rows),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        std::vector<double> row;
        std::vector<double> crossings;
        for (std::size_t r = range.begin(); r < range.end(); ++r)
        {
          const int j = box.lower[1] + static_cast<int>(r % static_cast<std::size_t>(size[1]));
          const int k = box.lower[2] + static_cast<int>(r / static_cast<std::size_t>(size[1]));
          row.assign(width, 0.0);
          for (int line = 0; line < lines * lines; ++line)
          {
            inside.crossings(j + (line % lines + 0.5) / lines, k + (line / lines + 0.5) / lines,
                             crossings);
            for (std::size_t c = 0; c + 1 < crossings.size(); c += 2)
              addSpan(crossings[c], crossings[c + 1], box.lower[0], row);
          }
          std::transform(row.begin(), row.end(),
                         result.shares.begin() + static_cast<std::ptrdiff_t>(r * width),
                         [lines](double length)
                         {
                           return static_cast<std::uint8_t>(
                               std::lround(255.0 * std::min(length / (lines * lines), 1.0)));
                         });
        }
      });
  return result;
}

} // namespace petrous::rendering
