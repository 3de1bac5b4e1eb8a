#include "MeshSpace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Volume/MeshSolid.h"

namespace petrous::presenters
{

namespace
{

using Eigen::Vector3d;
using imaging::MeshSpace;

constexpr std::array<double, 5> kUnits{1.0, 10.0, 25.4, 1000.0, 0.001}; // mm
constexpr double kSmallest = 1.0;      // mm, the diagonal of a structure
constexpr double kMostlyInside = 0.5;  // of the vertices
constexpr double kFollows = 0.75;      // of the edges; 0.5 is chance
constexpr double kClearlyBetter = 0.2; // of the edges
constexpr std::size_t kSamples = 4000;

struct Candidate
{
  MeshSpace space;
  double inside = 0.0; ///< share of the vertices in the image
  double size = 0.0;   ///< diagonal, mm
  double edges = 0.0;  ///< share of the image's gradient at the surface that is across it
};

// `space` of the file against the one in which it was read.
Vector3d placed(const core::TriangleMesh& mesh, std::size_t vertex, const MeshSpace& space)
{
  Vector3d p = mesh.vertices[vertex].cast<double>() * space.mm;
  if (space.isRas)
    p = Vector3d(-p[0], -p[1], p[2]);
  return p;
}

double insideOf(const core::TriangleMesh& mesh, const MeshSpace& space,
                const core::GridGeometry& grid)
{
  const std::size_t step = std::max<std::size_t>(mesh.vertices.size() / kSamples, 1);
  std::size_t inside = 0;
  std::size_t all = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += step, ++all)
  {
    const Vector3d voxel = grid.voxelFromPatient(placed(mesh, v, space));
    bool isIn = true;
    for (int a = 0; a < 3; ++a)
      isIn = isIn && voxel[a] >= -0.5 && voxel[a] <= grid.dims()[static_cast<std::size_t>(a)] - 0.5;
    inside += isIn ? 1 : 0;
  }
  return static_cast<double>(inside) / static_cast<double>(all);
}

// mm by which a point is beyond the image.
double beyond(const core::GridGeometry& grid, const Vector3d& patient)
{
  Vector3d last;
  for (int a = 0; a < 3; ++a)
    last[a] = grid.dims()[static_cast<std::size_t>(a)] - 0.5;
  const Vector3d voxel = grid.voxelFromPatient(patient);
  const Vector3d nearest = voxel.cwiseMax(Vector3d::Constant(-0.5)).cwiseMin(last);
  return (voxel - nearest).cwiseProduct(grid.spacing()).norm();
}

// mm by which the surface would reach beyond the image; less than half a voxel does not count.
double beyond(const core::TriangleMesh& mesh, const MeshSpace& space,
              const core::GridGeometry& grid)
{
  double farthest = 0.0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    farthest = std::max(farthest, beyond(grid, placed(mesh, v, space)));
  return farthest > grid.spacing().minCoeff() / 2.0 ? farthest : 0.0;
}

// The gradient's component along the surface's normal over its magnitude, both summed.
double edgesOf(const core::TriangleMesh& mesh, const MeshSpace& space,
               const volume::IntensityVolume& image)
{
  const core::GridGeometry& grid = image.geometry();
  const double reach = grid.spacing().minCoeff();
  const std::size_t step = std::max<std::size_t>(mesh.triangles.size() / kSamples, 1);
  double across = 0.0;
  double all = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += step)
  {
    const auto& triangle = mesh.triangles[t];
    const Vector3d a = placed(mesh, triangle[0], space);
    const Vector3d b = placed(mesh, triangle[1], space);
    const Vector3d c = placed(mesh, triangle[2], space);
    const Vector3d normal = (b - a).cross(c - a);
    if (!(normal.norm() > 0.0))
      continue;
    const Vector3d center = (a + b + c) / 3.0;
    Vector3d gradient;
    bool isIn = true;
    for (int axis = 0; axis < 3 && isIn; ++axis)
    {
      const Vector3d aside = reach * Vector3d::Unit(axis);
      const Vector3d before = grid.voxelFromPatient(center - aside);
      const Vector3d after = grid.voxelFromPatient(center + aside);
      for (int n = 0; n < 3; ++n)
        isIn = isIn && std::min(before[n], after[n]) >= 0.0 &&
               std::max(before[n], after[n]) <= grid.dims()[static_cast<std::size_t>(n)] - 1;
      if (isIn)
        gradient[axis] = (image.sample(after) - image.sample(before)) / (2.0 * reach);
    }
    if (!isIn || !gradient.allFinite())
      continue;
    across += std::abs(gradient.dot(normal.normalized()));
    all += gradient.norm();
  }
  return all > 0.0 ? across / all : 0.0;
}

std::string percent(double share)
{
  return core::fixedText(100.0 * share, 0) + " %";
}

} // namespace

std::string textOf(const imaging::MeshSpace& space)
{
  return std::string(space.isRas ? "RAS " : "LPS ") + unitName(space.mm);
}

std::string coordinatesOf(const imaging::MeshSpace& space)
{
  return std::string(space.isRas ? "RAS (Slicer, NIfTI), " : "LPS (DICOM, ITK), ") +
         unitName(space.mm);
}

MeshSpaceUnclear::MeshSpaceUnclear(std::filesystem::path file, const std::string& problem,
                                   std::vector<imaging::MeshSpace> spaces)
  : InvalidParameter(core::printable(file) + ": " + problem)
  , path(std::move(file))
  , likely(std::move(spaces))
{
}

std::string judgeMeshSpace(const std::filesystem::path& path, const imaging::LoadedMesh& loaded,
                           const scene::ImagePart& image, const std::string& imageName)
{
  const core::TriangleMesh& mesh = loaded.mesh;
  const core::GridGeometry& grid = image.geometry;
  const core::PatientBox box = grid.patientBounds();
  core::PatientBox bounds;
  for (const auto& vertex : mesh.vertices)
    bounds.extend(vertex.cast<double>().eval());
  const double size = bounds.diagonal().norm();
  const double largest = 1.5 * box.diagonal().norm();

  std::vector<Candidate> candidates;
  for (const double mm : kUnits)
    for (const bool isRas : {false, true})
      if ((!isRas || !loaded.isFrameGiven) && (mm == 1.0 || !loaded.isUnitGiven))
      {
        Candidate one{{isRas, mm}, insideOf(mesh, {isRas, mm}, grid), mm * size, 0.0};
        const bool fits =
            one.inside >= kMostlyInside && one.size >= kSmallest && one.size <= largest;
        if (candidates.empty() || fits)
          candidates.push_back(one);
      }
  if (candidates.size() == 1)
    return {};
  Candidate& given = candidates.front();
  const auto inFile = [&loaded](const MeshSpace& space) -> MeshSpace // as the file counts
  {
    return {space.isRas != loaded.space.isRas, space.mm * loaded.space.mm};
  };
  const auto spacesOf = [&candidates, &inFile]
  {
    std::vector<MeshSpace> spaces;
    for (const Candidate& one : candidates)
      spaces.push_back(inFile(one.space));
    return spaces;
  };
  const auto asRead = [&inFile](const MeshSpace& space) { return textOf(inFile(space)); };
  const bool isFrameStated = loaded.isFrameStated && !loaded.isFrameGiven;
  const bool isUnitStated = loaded.isUnitStated && !loaded.isUnitGiven;
  const std::string asGiven = "as " + asRead(given.space) +
                              (isFrameStated && isUnitStated ? ", as it states,"
                               : isFrameStated               ? " (it states the frame)"
                               : isUnitStated                ? " (it states the unit)"
                                                             : "");
  const std::string say = "; state its coordinate system and unit (--mesh-frame, --mesh-unit)";

  if (given.inside < kMostlyInside || given.size < kSmallest || given.size > largest)
  {
    std::string others;
    std::string partly;
    for (auto one = candidates.begin() + 1; one != candidates.end(); ++one)
      if (const double farthest = beyond(mesh, one->space, grid); farthest > 0.0)
        partly += ", as " + asRead(one->space) + " it would reach " + core::fixedText(farthest, 1) +
                  " mm beyond it";
      else
        others += (others.empty() ? "" : " or ") + asRead(one->space);
    const double reach = volume::reachBeyond(mesh, box);
    const std::string problem =
        reach > 0.0 ? "reaches " + core::fixedText(reach, 0) + " mm beyond " + imageName
                    : "is " + core::fixedText(given.size, 2) + " mm large";
    if (others.empty())
      throw MeshSpaceUnclear(path,
                             asGiven + " it " + problem +
                                 ", and in no other space would it lie inside as a whole" + partly +
                                 say,
                             spacesOf());
    throw MeshSpaceUnclear(
        path, asGiven + " it " + problem + ", as " + others + " it would lie inside" + partly + say,
        spacesOf());
  }
  const auto voxels = image.volume.get();
  for (Candidate& one : candidates)
    one.edges = edgesOf(mesh, one.space, *voxels);
  const auto best =
      std::max_element(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.edges < b.edges; });
  if (best->edges >= kFollows && best->edges > given.edges + kClearlyBetter)
    throw MeshSpaceUnclear(path,
                           asGiven + " it follows " + percent(given.edges) + " of the edges of " +
                               imageName + ", as " + asRead(best->space) + " " +
                               percent(best->edges) + " (by chance 50 %)" + say,
                           spacesOf());
  const auto other = std::find_if(candidates.begin() + 1, candidates.end(),
                                  [&](const Candidate& one) {
                                    return !(one.space.isRas && isFrameStated) &&
                                           (one.space.mm == 1.0 || !isUnitStated);
                                  });
  constexpr double kSampling = 0.05; // of the share, by which points are sampled
  if (best->edges >= kFollows && best->edges > given.edges + kSampling)
    return "follows " + percent(best->edges) + " of the edges of " + imageName + " as " +
           asRead(best->space) + ", and " + percent(given.edges) + " as " + asRead(given.space) +
           ", as it was taken; look whether it lies where it belongs";
  if (given.edges >= kFollows || other == candidates.end())
    return {};
  if (const double farthest = beyond(mesh, other->space, grid); farthest > 0.0)
    return "does not state its coordinate system and unit, and as " + asRead(other->space) +
           " would reach only " + core::fixedText(farthest, 1) + " mm beyond " + imageName +
           "; it was taken as " + asRead(given.space) +
           ", so look whether it lies where it belongs";
  return "does not state its coordinate system and unit, and would lie inside " + imageName +
         " also as " + asRead(other->space) + "; it was taken as " + asRead(given.space) +
         ", so look whether it lies where it belongs";
}

std::string outsideImage(const core::TriangleMesh& mesh, const core::GridGeometry& grid,
                         const std::string& imageName)
{
  double farthest = 0.0;
  double outside = 0.0;
  double area = 0.0;
  for (const auto& triangle : mesh.triangles)
  {
    const Vector3d a = mesh.vertices[triangle[0]].cast<double>();
    const double one = (mesh.vertices[triangle[1]].cast<double>() - a)
                           .cross(mesh.vertices[triangle[2]].cast<double>() - a)
                           .norm();
    area += one;
    for (const std::uint32_t corner : triangle)
      if (const double reach = beyond(grid, mesh.vertices[corner].cast<double>()); reach > 0.0)
      {
        farthest = std::max(farthest, reach);
        outside += one / 3.0;
      }
  }
  if (farthest <= grid.spacing().minCoeff() / 2.0)
    return {};
  const std::string by = core::fixedText(farthest, 1) + " mm";
  if (outside >= area)
    return "lies outside " + imageName + " altogether, by up to " + by;
  return "reaches " + by + " beyond " + imageName + "; " +
         core::fixedText(100.0 * outside / area, 1) + " % of its surface lies outside";
}

} // namespace petrous::presenters
