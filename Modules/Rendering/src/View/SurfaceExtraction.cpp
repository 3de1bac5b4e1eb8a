#include "petrous/Rendering/SurfaceExtraction.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

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

} // namespace petrous::rendering
