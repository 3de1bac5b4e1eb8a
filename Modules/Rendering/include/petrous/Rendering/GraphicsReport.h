#pragma once

#include <string>
#include <vector>

namespace petrous::rendering
{

/// What the machine's OpenGL can do for the pictures, found by drawing small ones.
struct GraphicsReport
{
  struct Variant
  {
    std::vector<std::string> features; ///< as RenderStatistics::variant names them
    bool compiles = false;
    std::string error; ///< the driver's words where it does not
  };

  std::string renderer;          ///< what the driver calls itself
  std::string version;           ///< of OpenGL
  int largestTexture3d = 0;      ///< voxels along an axis; a larger volume is drawn reduced
  std::vector<Variant> variants; ///< of the ray caster: CT alone, with each feature, with all
};

/// Throws RenderingError NoOpenGL where no context can be made, saying what to install.
GraphicsReport reportGraphics();

} // namespace petrous::rendering
