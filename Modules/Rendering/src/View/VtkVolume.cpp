#include "petrous/Rendering/VtkVolume.h"

#include <utility>

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "petrous/Core/Error.h"

namespace petrous::rendering
{

namespace
{
// Keeps the voxels alive as long as it observes the VTK array, i.e. until the array is deleted.
class KeepAlive : public vtkCommand
{
public:
  static KeepAlive* New() { return new KeepAlive; }
  void Execute(vtkObject*, unsigned long, void*) override {}
  std::shared_ptr<const void> owner;
};
} // namespace

template <class T>
vtkSmartPointer<vtkImageData> wrap(const std::shared_ptr<const volume::Volume<T>>& voxels)
{
  const core::GridGeometry& grid = voxels->geometry();
  vtkNew<vtkAOSDataArrayTemplate<T>> array;
  array->SetName("voxels");
  // VTK has no read-only arrays; nothing here writes, and `save` leaves ownership with the caller.
  array->SetVoidArray(const_cast<T*>(voxels->data()), static_cast<vtkIdType>(voxels->size()), 1);
  vtkNew<KeepAlive> keep;
  keep->owner = voxels;
  array->AddObserver(vtkCommand::DeleteEvent, keep);

  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(grid.dims().data());
  image->SetSpacing(grid.spacing()[0], grid.spacing()[1], grid.spacing()[2]);
  image->SetOrigin(grid.origin()[0], grid.origin()[1], grid.origin()[2]);
  // VTK expects a row-major matrix; setting single elements would not update the transforms.
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> direction = grid.direction();
  image->SetDirectionMatrix(direction.data());
  image->GetPointData()->SetScalars(array);
  return image;
}

template vtkSmartPointer<vtkImageData>
wrap<std::int16_t>(const std::shared_ptr<const volume::Volume<std::int16_t>>&);
template vtkSmartPointer<vtkImageData>
wrap<std::uint16_t>(const std::shared_ptr<const volume::Volume<std::uint16_t>>&);
template vtkSmartPointer<vtkImageData>
wrap<float>(const std::shared_ptr<const volume::Volume<float>>&);

vtkSmartPointer<vtkImageData> wrap(const volume::IntensityVolume& volume)
{
  return std::visit([](const auto& voxels) { return wrap(voxels); }, volume.voxels());
}

namespace
{
template <class T>
std::shared_ptr<const volume::IntensityVolume> adopt(vtkDataArray* array,
                                                     const core::GridGeometry& grid)
{
  const vtkSmartPointer<vtkDataArray> owner = array;
  std::shared_ptr<T> memory(static_cast<T*>(array->GetVoidPointer(0)), [owner](T*) {});
  return std::make_shared<volume::IntensityVolume>(
      std::make_shared<const volume::Volume<T>>(grid, std::move(memory)));
}
} // namespace

std::shared_ptr<const volume::IntensityVolume> unwrap(vtkImageData* image)
{
  vtkDataArray* array = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!array || array->GetNumberOfComponents() != 1)
    throw core::InvalidParameter("volume mapper: an image with one component is needed");
  const int* extent = image->GetExtent();
  Eigen::Vector3d origin;
  image->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], origin.data());
  Eigen::Matrix3d direction;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      direction(i, j) = image->GetDirectionMatrix()->GetElement(i, j);
  core::Index3 dims;
  image->GetDimensions(dims.data());
  const double* spacing = image->GetSpacing();
  const core::GridGeometry grid(dims, {spacing[0], spacing[1], spacing[2]}, origin, direction);
  switch (array->GetDataType())
  {
  case VTK_SHORT:
    return adopt<std::int16_t>(array, grid);
  case VTK_UNSIGNED_SHORT:
    return adopt<std::uint16_t>(array, grid);
  case VTK_FLOAT:
    return adopt<float>(array, grid);
  default:
    throw core::InvalidParameter(
        std::string("volume mapper: scalars of type ") + array->GetDataTypeAsString() +
        " are not drawn; convert them to short, unsigned short or float (vtkImageCast)");
  }
}

} // namespace petrous::rendering
