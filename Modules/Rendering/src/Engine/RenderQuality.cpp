#include "petrous/Rendering/RenderQuality.h"

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::rendering
{

namespace
{
void require(bool holds, const char* name, double value, const char* range)
{
  if (holds)
    return;
  throw core::InvalidParameter(std::string("picture quality: ") + name + " is " +
                               core::generalText(value) + "; it must be " + range);
}
} // namespace

void RenderQuality::validate() const
{
  // Drivers terminate a loop, and with it the ray, after about 65000 iterations.
  require(step >= 0.05 && step <= 100.0, "step", step, "0.05 to 100 voxels");
  require(bisections >= 0 && bisections <= 24, "bisections", bisections, "0 to 24");
  require(brick == 4 || brick == 8 || brick == 16, "brick", brick, "4, 8 or 16 voxels");
  require(termination >= 0.0 && termination <= 1.0, "termination", termination, "0 to 1");
  require(tableSize >= 16 && tableSize <= 4096, "tableSize", tableSize, "16 to 4096");
  require(maskBits == 8 || maskBits == 16, "maskBits", maskBits, "8 or 16");
  require(imageScale >= 0.1 && imageScale <= 1.0, "imageScale", imageScale, "0.1 to 1");
  require(largestTexture == 0 || largestTexture >= 16, "largestTexture", largestTexture,
          "0 (what the driver takes) or at least 16 texels");
}

} // namespace petrous::rendering
