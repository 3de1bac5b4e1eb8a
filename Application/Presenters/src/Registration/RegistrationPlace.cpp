#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/AsciiCase.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseRegistration.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Scene/Placement.h"

// Where the error of a registration is estimated.
namespace petrous::presenters
{

namespace
{

using core::PatientBox;

std::optional<Eigen::Vector3d> middleOf(const volume::LabelMap& labels, std::uint16_t index)
{
  const auto& voxels = *labels.voxels;
  const core::Index3 n = voxels.geometry().dims();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        if (voxels.at(i, j, k) == index)
        {
          sum += Eigen::Vector3d(i, j, k);
          ++count;
        }
  if (count == 0)
    return std::nullopt;
  return voxels.geometry().patientFromVoxel(sum / static_cast<double>(count));
}

std::optional<Eigen::Vector3d> middleOf(const core::TriangleMesh& mesh)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3d a = mesh.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[triangle[1]].cast<double>();
    const Eigen::Vector3d c = mesh.vertices[triangle[2]].cast<double>();
    const double here = (b - a).cross(c - a).norm();
    sum += here / 3.0 * (a + b + c);
    area += here;
  }
  return area > 0.0 ? std::optional<Eigen::Vector3d>(sum / area) : std::nullopt;
}

// The first part of that name that can be placed on the CT.
std::optional<Eigen::Vector3d> middleOf(const scene::Case& value, const std::string& name)
{
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
      if (structure.name == name)
        if (const auto labels = scene::labelsOnCt(value, part))
          return middleOf(*labels, structure.index);
  for (const scene::MeshPart& part : value.meshes)
    if (part.name == name)
      if (const auto mesh = scene::meshOnCt(value, part))
        return middleOf(*mesh);
  return std::nullopt;
}

bool contains(std::string name, const char* words)
{
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c == '_' || c == '-' ? ' ' : core::asciiLower(c); });
  return name.find(words) != std::string::npos;
}

// Proximity rank to the middle ear by a structure's name: 0 in it; none if the name does not tell.
std::optional<int> earRank(const appearance::StructurePresets& presets, const std::string& name)
{
  const std::string preset = presets.lookFor(name).preset;
  if (preset == "ossicle")
    return 0;
  if (contains(name, "tympanic cavity") || contains(name, "middle ear"))
    return 1;
  if (contains(name, "cochlea") && preset == "inner-ear")
    return 2;
  if (preset == "inner-ear")
    return 3;
  return std::nullopt;
}

PatientBox boxOf(const core::GridGeometry& grid, const core::RigidTransform& ctFromGrid)
{
  const core::Index3& n = grid.dims();
  PatientBox box;
  for (int corner = 0; corner < 8; ++corner)
    box.extend(ctFromGrid * grid.patientFromVoxel(Eigen::Vector3d((corner & 1) * (n[0] - 1),
                                                                  (corner >> 1 & 1) * (n[1] - 1),
                                                                  (corner >> 2) * (n[2] - 1))));
  return box;
}

std::string coordinates(const Eigen::Vector3d& point)
{
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double tenths = std::round(10.0 * point[axis]);
    text += axis == 0 ? "(" : ", ";
    text += core::fixedText(tenths == 0.0 ? 0.0 : 0.1 * tenths, 1); // no -0.0
  }
  return text + ")";
}

// The MR's registration before the fit, as far as known.
core::RigidTransform before(const scene::Case& value, const scene::ImagePart& mr,
                            const RegistrationRequest& request)
{
  using From = RegistrationRequest::From;
  switch (request.from)
  {
  case From::Given:
    return request.given;
  case From::Landmarks:
    return registration::fitLandmarks(request.landmarks).mrFromCt;
  case From::Centres:
    return {Eigen::Quaterniond::Identity(), mr.geometry.center() - value.ct.geometry.center()};
  case From::Header:
    break;
  }
  const scene::ImagePart* onto = scene::findMr(value, request.onto);
  return onto && onto->registered ? onto->mrFromCt : core::RigidTransform();
}

} // namespace

std::vector<std::string> placeNames(const scene::Case& value)
{
  std::vector<std::string> names;
  for (const std::string& name : scene::partNames(value))
    if (name != "ct" && !scene::findMr(value, name) && scene::missingPlace(value, name).empty() &&
        std::find(names.begin(), names.end(), name) == names.end()) // a structure's mesh is its own
      names.push_back(name);
  return names;
}

RegistrationPlace placeAt(const scene::Case& value, const Eigen::Vector3d& point)
{
  const core::GridGeometry& grid = value.ct.geometry;
  if (!grid.hullContains(grid.voxelFromPatient(point)))
    throw core::InvalidParameter(coordinates(point) + " is outside the " + primaryName(value) +
                                 ", whose middle is " + coordinates(grid.center()));
  return {point, coordinates(point)};
}

RegistrationPlace placeOf(const scene::Case& value, const std::string& structure)
{
  if (const auto middle = middleOf(value, structure))
    return {*middle, "the middle of '" + structure + "'"};
  if (const std::string missing = scene::missingPlace(value, structure); !missing.empty())
    throw core::InvalidParameter("'" + structure + "' is nowhere on the " + primaryName(value) +
                                 ": " + missing);
  std::string there;
  for (const std::string& name : scene::partNames(value))
    if (name != "ct" && !scene::findMr(value, name))
      there += (there.empty() ? "" : ", ") + name;
  throw core::InvalidParameter("case '" + value.name + "' has no structure '" + structure + "'; " +
                               (there.empty() ? "it has none" : "it has " + there));
}

std::vector<std::string> earNames(const scene::Case& value)
{
  const auto presets = appearance::StructurePresets::builtIn();
  std::vector<std::pair<int, std::string>> ears;
  for (const std::string& name : placeNames(value))
    if (const auto rank = earRank(presets, name))
      ears.emplace_back(*rank, name);
  std::stable_sort(ears.begin(), ears.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& [rank, name] : ears)
    names.push_back(std::move(name));
  return names;
}

RegistrationPlace defaultPlace(const scene::Case& value, const RegistrationRequest& request)
{
  const PatientBox ct = value.ct.geometry.patientBounds();
  for (const std::string& name : earNames(value))
    if (const auto middle = middleOf(value, name); middle && ct.contains(*middle))
      return {*middle, "the middle of '" + name + "'"};

  const scene::ImagePart* mr = scene::findMr(value, request.mr);
  PatientBox both = ct;
  if (request.region)
    both = both.intersection(*request.region);
  if (mr)
    both = both.intersection(boxOf(mr->geometry, before(value, *mr, request).inverse()));
  if (both.isEmpty())
    return {ct.center(), std::string("the centre of the ") + primaryName(value)};
  return {both.center(), "the centre of what both images show"};
}

} // namespace petrous::presenters
