#include "petrous/Rendering/SurfaceExtraction.h"

#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/MeshTree.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// Isosurface 0 of a field by flying edges, patient LPS mm, counter-clockwise seen from the
/// negative side, on left-handed grids too.
core::TriangleMesh isoTriangles(const volume::Volume<float>& field);

core::TriangleMesh isoTriangles(const volume::Volume<float>& field)
{
  const core::GridGeometry& grid = field.geometry();
  vtkNew<vtkFloatArray> values;
  values->SetArray(const_cast<float*>(field.data()), static_cast<vtkIdType>(field.size()), 1);
  // In voxel coordinates, so that the filter's float points stay precise far from the origin.
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.dims().data());
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();

  core::TriangleMesh mesh;
  mesh.vertices.resize(static_cast<std::size_t>(surface->GetNumberOfPoints()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
  {
    Eigen::Vector3d voxel;
    surface->GetPoint(static_cast<vtkIdType>(i), voxel.data());
    mesh.vertices[i] = grid.patientFromVoxel(voxel).cast<float>();
  }
  mesh.triangles.reserve(static_cast<std::size_t>(surface->GetNumberOfPolys()));
  // Flying edges winds counter-clockwise seen from the lower values; a left-handed grid flips it.
  const bool mirrored = grid.direction().determinant() < 0.0;
  vtkCellArray* cells = surface->GetPolys();
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  for (cells->InitTraversal(); cells->GetNextCell(count, corners);)
  {
    std::array<std::uint32_t, 3> triangle{static_cast<std::uint32_t>(corners[0]),
                                          static_cast<std::uint32_t>(corners[1]),
                                          static_cast<std::uint32_t>(corners[2])};
    if (mirrored)
      std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

core::TriangleMesh extractSurface(const volume::TissueField& field, const core::IndexBox& box,
                                  const core::Progress& progress)
{
  const core::GridGeometry& grid = field.geometry();
  const core::IndexBox inside = box.intersected(grid.fullBox());
  if (inside.empty())
    return {};
  // A surrounding layer of air closes the surface at the box. Its value is so far below 0 that the
  // surface stays within a thousandth of a voxel of the border.
  constexpr float air = -1000.0F;
  const core::Index3 size = inside.size();
  const core::GridGeometry padded(
      {size[0] + 2, size[1] + 2, size[2] + 2}, grid.spacing(),
      grid.patientFromVoxel(
          Eigen::Vector3d(inside.lower[0] - 1, inside.lower[1] - 1, inside.lower[2] - 1)),
      grid.direction());
  volume::Volume<float> samples(padded, air);

  // The outermost voxel centres lie on the hull's border, where rounding decides between f and air;
  // they are sampled a millionth of a voxel further inside.
  const auto sampleAt = [&](const core::Index3& index)
  {
    Eigen::Vector3d voxel;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double last = grid.dims()[a] - 1.0;
      const double in = std::min(1e-6, 0.5 * last);
      voxel[static_cast<Eigen::Index>(a)] =
          std::clamp(static_cast<double>(index[a]), in, last - in);
    }
    return static_cast<float>(field.value(grid.patientFromVoxel(voxel)));
  };

  std::atomic<int> done{0};
  tbb::parallel_for(tbb::blocked_range<int>(0, size[2], 1),
                    [&](const tbb::blocked_range<int>& range)
                    {
                      for (int k = range.begin(); k < range.end(); ++k)
                      {
                        progress.check("surface");
                        for (int j = 0; j < size[1]; ++j)
                          for (int i = 0; i < size[0]; ++i)
                            samples.at(i + 1, j + 1, k + 1) = sampleAt(
                                {inside.lower[0] + i, inside.lower[1] + j, inside.lower[2] + k});
                        progress.report(0.8 * ++done / size[2], "surface");
                      }
                    });
  core::TriangleMesh mesh = isoTriangles(samples);
  progress.report(1.0, "surface");
  return mesh;
}

core::TriangleMesh extractLabel(const volume::Volume<std::uint16_t>& labels, std::uint16_t label,
                                const core::Progress& progress)
{
  const core::GridGeometry& grid = labels.geometry();
  const core::Index3& dims = grid.dims();
  core::IndexBox box{dims, {0, 0, 0}};
  std::size_t count = 0;
  for (int k = 0; k < dims[2]; ++k)
  {
    progress.report(0.2 * k / dims[2], "surface");
    for (int j = 0; j < dims[1]; ++j)
      volume::forEachLabel(&labels.at(0, j, k), dims[0],
                           [&, j, k](int i, std::uint16_t found)
                           {
                             if (found != label)
                               return;
                             ++count;
                             const core::Index3 at{i, j, k};
                             for (std::size_t a = 0; a < 3; ++a)
                             {
                               box.lower[a] = std::min(box.lower[a], at[a]);
                               box.upper[a] = std::max(box.upper[a], at[a] + 1);
                             }
                           });
  }
  if (count == 0)
    return {};
  const core::Index3 size = box.size();
  volume::Volume<float> samples(
      core::GridGeometry({size[0] + 2, size[1] + 2, size[2] + 2}, grid.spacing(),
                         grid.patientFromVoxel(
                             Eigen::Vector3d(box.lower[0] - 1, box.lower[1] - 1, box.lower[2] - 1)),
                         grid.direction()),
      0.0F);
  // The surface lies a share `depth` of the way from the outer voxel's centre to the inner one's.
  const auto surfaceAt = [&](double depth)
  {
    const auto inside = static_cast<float>(1.0 - depth);
    const auto outside = static_cast<float>(-depth);
    std::fill(samples.data(), samples.data() + samples.size(), outside);
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i)
          if (labels.at(box.lower[0] + i, box.lower[1] + j, box.lower[2] + k) == label)
            samples.at(i + 1, j + 1, k + 1) = inside;
    return isoTriangles(samples);
  };
  const double wanted = static_cast<double>(count) * grid.spacing().prod();
  // The volume falls as the depth grows, always through the wanted one: bisection.
  double low = 0.01;
  double high = 0.99;
  core::TriangleMesh mesh;
  constexpr int kMostSteps = 16;
  for (int step = 0; step < kMostSteps; ++step)
  {
    progress.report(0.2 + 0.8 * step / kMostSteps, "surface");
    const double depth = 0.5 * (low + high);
    mesh = surfaceAt(depth);
    const double excess = mesh.signedVolume() / wanted - 1.0;
    if (std::abs(excess) < 1e-4)
      break;
    (excess > 0.0 ? low : high) = depth;
  }
  progress.report(1.0, "surface");
  return mesh;
}

namespace
{

vtkSmartPointer<vtkPolyData> polyDataOf(const core::TriangleMesh& mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble(); // so that quadrics far from the origin stay precise
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.vertices.size()));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    points->SetPoint(static_cast<vtkIdType>(v), mesh.vertices[v].cast<double>().eval().data());
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : mesh.triangles)
    cells->InsertNextCell({vtkIdType{triangle[0]}, vtkIdType{triangle[1]}, vtkIdType{triangle[2]}});
  auto poly = vtkSmartPointer<vtkPolyData>::New();
  poly->SetPoints(points);
  poly->SetPolys(cells);
  return poly;
}

core::TriangleMesh meshOf(vtkPolyData& poly)
{
  core::TriangleMesh mesh;
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(static_cast<std::size_t>(poly.GetNumberOfPoints()), kUnused);
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  vtkCellArray* cells = poly.GetPolys();
  for (cells->InitTraversal(); cells->GetNextCell(count, corners);)
  {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c)
    {
      std::uint32_t& vertex = place[static_cast<std::size_t>(corners[c])];
      if (vertex == kUnused)
      {
        vertex = static_cast<std::uint32_t>(mesh.vertices.size());
        Eigen::Vector3d at;
        poly.GetPoint(corners[c], at.data());
        mesh.vertices.push_back(at.cast<float>());
      }
      triangle[c] = vertex;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

// The largest distance of the points from the mesh.
double farthest(const std::vector<Eigen::Vector3d>& points, const volume::MeshTree& tree,
                const core::Progress& progress)
{
  constexpr double kFar = std::numeric_limits<double>::infinity();
  constexpr std::size_t kPiece = 4096;
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, points.size(), kPiece), 0.0,
      [&](const tbb::blocked_range<std::size_t>& range, double worst)
      {
        progress.check("decimation");
        for (std::size_t n = range.begin(); n < range.end(); ++n)
          worst = std::max(worst, tree.distance(points[n], kFar));
        return worst;
      },
      [](double a, double b) { return std::max(a, b); });
}

// Pieces that share no vertex.
std::size_t piecesOf(const core::TriangleMesh& mesh)
{
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&parent](std::uint32_t v)
  {
    while (parent[v] != v)
      v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<char> isUsed(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
    {
      isUsed[corner] = 1;
      parent[root(corner)] = root(triangle[0]);
    }
  std::size_t pieces = 0;
  for (std::uint32_t v = 0; v < parent.size(); ++v)
    pieces += isUsed[v] != 0 && parent[v] == v ? 1 : 0;
  return pieces;
}

std::vector<Eigen::Vector3d> verticesOf(const core::TriangleMesh& mesh)
{
  std::vector<Eigen::Vector3d> points;
  for (const auto& vertex : mesh.vertices)
    points.push_back(vertex.cast<double>());
  return points;
}

core::TriangleMesh collapsed(vtkPolyData& poly, double reduction)
{
  vtkNew<vtkQuadricDecimation> quadric;
  quadric->SetInputData(&poly);
  quadric->SetTargetReduction(reduction);
  quadric->VolumePreservationOn();
  quadric->Update();
  return meshOf(*quadric->GetOutput());
}

} // namespace

DecimatedMesh decimated(const core::TriangleMesh& mesh, std::size_t triangles,
                        const core::Progress& progress)
{
  constexpr std::size_t kFewest = 4; // of a closed surface
  if (triangles < kFewest)
    throw core::InvalidParameter("decimation: a closed surface has at least 4 triangles");
  if (!mesh.isClosed())
    throw core::InvalidParameter("decimation: the surface is not closed");
  const std::size_t pieces = piecesOf(mesh);
  if (mesh.triangles.size() <= triangles)
    return {mesh, 0.0, pieces, {}};
  if (triangles < kFewest * pieces)
    throw core::InvalidParameter("decimation: the surface has " + std::to_string(pieces) +
                                 " pieces that are not connected, and each needs at least 4 "
                                 "triangles; ask for " +
                                 std::to_string(kFewest * pieces) +
                                 " or more, or choose a threshold with less noise");
  progress.report(0.0, "decimation");
  const auto poly = polyDataOf(mesh);
  const double reduction =
      1.0 - static_cast<double>(triangles) / static_cast<double>(mesh.triangles.size());
  const double volume = mesh.signedVolume();
  constexpr double kVolumeKept = 0.01; // of it, where edges are collapsed to another number
  // Empty if it is closed and of the volume.
  const auto faultOf = [volume](const core::TriangleMesh& one) -> std::string
  {
    if (one.triangles.empty() || !one.isClosed())
      return "is not closed";
    const double change = std::abs(one.signedVolume() - volume) / std::abs(volume);
    return change <= kVolumeKept
               ? ""
               : "has another volume by " + core::fixedText(100.0 * change, 1) + " %";
  };
  DecimatedMesh result{collapsed(*poly, reduction), 0.0, pieces, {}};
  progress.report(0.3, "decimation");
  if (!result.mesh.isClosed() || result.mesh.triangles.empty())
  {
    vtkNew<vtkDecimatePro> topological;
    topological->SetInputData(poly);
    topological->SetTargetReduction(reduction);
    topological->PreserveTopologyOn();
    topological->SplittingOff();
    topological->Update();
    core::TriangleMesh fewest = mesh;
    const auto take = [&](core::TriangleMesh one)
    {
      const std::string fault = faultOf(one);
      if (!fault.empty())
        result.limit = "with " + std::to_string(one.triangles.size()) + " it " + fault;
      const bool isTaken = fault.empty() && one.triangles.size() < fewest.triangles.size();
      if (isTaken)
        fewest = std::move(one);
      return isTaken;
    };
    take(meshOf(*topological->GetOutput()));
    progress.report(0.4, "decimation");
    // Edges collapse without a hole to some numbers of triangles, and from some surfaces: halved
    // between what was asked for and the fewest that stayed closed.
    constexpr int kAttempts = 6;
    std::size_t least = triangles;
    for (int n = 0; n < kAttempts && fewest.triangles.size() > least + least / 50; ++n)
    {
      progress.report(0.4 + 0.3 * n / kAttempts, "decimation");
      const std::size_t wanted = n == 0 ? least : (least + fewest.triangles.size()) / 2;
      const auto from = polyDataOf(fewest);
      if (!take(collapsed(*from, 1.0 - static_cast<double>(wanted) /
                                           static_cast<double>(fewest.triangles.size()))) &&
          n > 0)
        least = wanted;
    }
    result.mesh = std::move(fewest);
  }
  if (result.mesh.triangles.size() <= triangles)
    result.limit.clear();
  else if (result.limit.empty())
    result.limit = "no more can be removed";
  progress.report(0.7, "decimation");
  std::vector<Eigen::Vector3d> points = verticesOf(result.mesh);
  for (const auto& t : result.mesh.triangles)
    points.emplace_back((points[t[0]] + points[t[1]] + points[t[2]]) / 3.0);
  const double there = farthest(verticesOf(mesh), volume::MeshTree(result.mesh), progress);
  result.error = std::max(there, farthest(points, volume::MeshTree(mesh), progress));
  progress.report(1.0, "decimation");
  return result;
}

} // namespace petrous::rendering
