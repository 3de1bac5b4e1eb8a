#include "WindowPicture.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

namespace petrous::rendering
{

Picture readWindow(vtkRenderWindow* window)
{
  const int* size = window->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels, 0);
  return fromBottomRow(size[0], size[1], pixels);
}

Picture fromBottomRow(int width, int height, vtkUnsignedCharArray* rgb)
{
  Picture picture{width, height, {}};
  const vtkIdType row = vtkIdType{3} * width;
  if (rgb->GetNumberOfValues() != row * height)
    return picture;
  picture.rgb.reserve(static_cast<std::size_t>(row * height));
  for (int y = height - 1; y >= 0; --y)
    picture.rgb.insert(picture.rgb.end(), rgb->GetPointer(row * y), rgb->GetPointer(row * y) + row);
  return picture;
}

} // namespace petrous::rendering
