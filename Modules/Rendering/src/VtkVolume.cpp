#include "petrous/Rendering/VtkVolume.h"

#include <utility>

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPointData.h>

namespace petrous::rendering
{

namespace
{
// Holds the voxels for as long as the VTK array observes with it, which is until it dies.
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
  // VTK has no read-only arrays; nothing here writes, and `save` leaves the memory to its owner.
  array->SetVoidArray(const_cast<T*>(voxels->data()), static_cast<vtkIdType>(voxels->size()), 1);
  vtkNew<KeepAlive> keep;
  keep->owner = voxels;
  array->AddObserver(vtkCommand::DeleteEvent, keep);

  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(grid.dims().data());
  image->SetSpacing(grid.spacing()[0], grid.spacing()[1], grid.spacing()[2]);
  image->SetOrigin(grid.origin()[0], grid.origin()[1], grid.origin()[2]);
  // VTK reads a row-major matrix; setting its elements one by one would not reach the transforms.
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

} // namespace petrous::rendering
