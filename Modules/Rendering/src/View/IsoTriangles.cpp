#include "IsoTriangles.h"

#include <array>
#include <utility>

#include <Eigen/LU>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

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

} // namespace petrous::rendering
