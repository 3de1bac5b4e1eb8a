#pragma once

#include <memory>

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include "petrous/Volume/IntensityVolume.h"

namespace petrous::rendering
{

/// Wraps the volume as a VTK image with origin, spacing and direction, without copying; the image
/// keeps the volume alive. VTK must not write to it. Instantiated for int16, uint16, float.
template <class T>
vtkSmartPointer<vtkImageData> wrap(const std::shared_ptr<const volume::Volume<T>>& voxels);

/// As above, for a CT or MR image of any supported type.
vtkSmartPointer<vtkImageData> wrap(const volume::IntensityVolume& volume);

/// Wraps a VTK image as a volume of the same memory, which is kept alive. Throws InvalidParameter,
/// saying what is needed, unless it has one component of int16, uint16 or float.
std::shared_ptr<const volume::IntensityVolume> unwrap(vtkImageData* image);

} // namespace petrous::rendering
