#pragma once

#include <memory>

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include "petrous/Volume/IntensityVolume.h"

namespace petrous::rendering
{

/// The same memory as a VTK image with origin, spacing and direction; nothing is copied, and the
/// image keeps the volume alive. VTK must not write to it. Instantiated for int16, uint16, float.
template <class T>
vtkSmartPointer<vtkImageData> wrap(const std::shared_ptr<const volume::Volume<T>>& voxels);

/// The same for a CT or MR image of any of its types.
vtkSmartPointer<vtkImageData> wrap(const volume::IntensityVolume& volume);

/// The other way: an image of VTK as a volume of the same memory, kept alive. One component of
/// int16, uint16 or float, else InvalidParameter saying what is needed.
std::shared_ptr<const volume::IntensityVolume> unwrap(vtkImageData* image);

} // namespace petrous::rendering
