#include "petrous/Presenters/StructureBorders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

namespace petrous::presenters
{

namespace
{

// Calls meet(a, b, middle) for neighbours along an axis whose voxels differ by `differ`.
template <class T, class Differ, class Meet>
void eachBorder(const volume::Volume<T>& voxels, Differ differ, Meet meet)
{
  const core::GridGeometry& grid = voxels.geometry();
  const core::Index3 dims = grid.dims();
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
      {
        const T here = voxels.at(i, j, k);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          core::Index3 next{i, j, k};
          if (++next[axis] == dims[axis])
            continue;
          const T there = voxels.at(next[0], next[1], next[2]);
          if (differ(here, there))
            meet(here, there,
                 grid.patientFromVoxel(0.5 *
                                       Eigen::Vector3d(i + next[0], j + next[1], k + next[2])));
        }
      }
}

} // namespace

StructureBorders::StructureBorders(const scene::Case& value)
{
  const auto add = [](Border& border, const Eigen::Vector3d& point)
  {
    border.points.push_back(point.cast<float>());
    border.box.extend(point);
  };
  for (const scene::LabelPart& part : value.labels)
  {
    std::unordered_map<std::uint16_t, Border> borders;
    for (const scene::StructurePart& structure : part.structures)
      borders[structure.index].name = structure.name;
    const auto take = [&](std::uint16_t index, const Eigen::Vector3d& point)
    {
      if (const auto found = borders.find(index); found != borders.end())
        add(found->second, point);
    };
    eachBorder(
        *part.labels.get()->voxels, [](auto a, auto b) { return a != b; },
        [&](std::uint16_t a, std::uint16_t b, const Eigen::Vector3d& point)
        {
          take(a, point);
          take(b, point);
        });
    for (auto& [index, border] : borders)
      if (!border.points.empty())
        m_borders.push_back(std::move(border));
  }
  for (const scene::MeshPart& mesh : value.meshes)
  {
    const auto solid = mesh.touch.resident();
    if (!solid)
      continue;
    Border border;
    border.name = mesh.name;
    eachBorder(
        *solid, [](float a, float b) { return (a > 0.5F) != (b > 0.5F); },
        [&](float, float, const Eigen::Vector3d& point) { add(border, point); });
    if (!border.points.empty())
      m_borders.push_back(std::move(border));
  }
}

std::optional<NearStructure>
StructureBorders::nearest(const Eigen::Vector3d& patient, double reach,
                          const std::function<bool(const std::string& name)>& wanted) const
{
  const Border* nearest = nullptr;
  double best = reach * reach;
  for (const Border& border : m_borders)
  {
    if (border.box.squaredExteriorDistance(patient) >= best || !wanted(border.name))
      continue;
    const Eigen::Vector3f from = patient.cast<float>();
    float least = std::numeric_limits<float>::max();
    for (const Eigen::Vector3f& point : border.points)
      least = std::min(least, (point - from).squaredNorm());
    if (static_cast<double>(least) >= best)
      continue;
    best = static_cast<double>(least);
    nearest = &border;
  }
  return nearest ? std::optional<NearStructure>({nearest->name, std::sqrt(best)}) : std::nullopt;
}

} // namespace petrous::presenters
