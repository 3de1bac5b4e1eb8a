#include "Place.h"

#include <algorithm>

#include "Context.h"
#include "Numbers.h"
#include "petrous/Scene/Placement.h"

namespace petrous::cli
{

namespace
{

std::optional<Eigen::Vector3d> centreOf(const volume::LabelMap& labels, std::uint16_t index)
{
  const auto& voxels = *labels.voxels;
  const core::Index3& dims = voxels.geometry().dims();
  const std::uint16_t* value = voxels.data();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i, ++value)
        if (*value == index)
        {
          sum += Eigen::Vector3d(i, j, k);
          ++count;
        }
  if (count == 0)
    return std::nullopt;
  return voxels.geometry().patientFromVoxel(sum / static_cast<double>(count));
}

// Of the surface, by area: independent of how finely it is cut into triangles.
std::optional<Eigen::Vector3d> centreOf(const core::TriangleMesh& mesh)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3d a = mesh.vertices[triangle[0]].template cast<double>();
    const Eigen::Vector3d b = mesh.vertices[triangle[1]].template cast<double>();
    const Eigen::Vector3d c = mesh.vertices[triangle[2]].template cast<double>();
    const double here = (b - a).cross(c - a).norm();
    sum += here / 3.0 * (a + b + c);
    area += here;
  }
  return area > 0.0 ? std::optional<Eigen::Vector3d>(sum / area) : std::nullopt;
}

// Where it lies on the CT, also when it was drawn on an MR.
std::optional<Eigen::Vector3d> structureCentre(const std::string& name, const scene::Case& value)
{
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      if (structure.name == name)
        if (const auto labels = scene::labelsOnCt(value, part))
          return centreOf(*labels, structure.index);
  for (const auto& part : value.meshes)
    if (part.name == name)
      if (const auto mesh = scene::meshOnCt(value, part))
        return centreOf(*mesh);
  return std::nullopt;
}

} // namespace

Place parsePlace(const std::string& text, const scene::Case& value, const std::string& option)
{
  if (const auto centre = structureCentre(text, value))
    return {*centre, text};
  if (const std::string missing = scene::missingPlace(value, text); !missing.empty())
    throw UsageError(option + ": '" + text + "' " + missing);
  if (std::count(text.begin(), text.end(), ',') != 2)
    throw UsageError(option + ": x,y,z in mm or the name of a structure of the case, not '" + text +
                     "'");
  const auto n = parseNumbers(text, 3, option + " x,y,z");
  return {{n[0], n[1], n[2]}, {}};
}

} // namespace petrous::cli
