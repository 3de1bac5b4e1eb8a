#pragma once

#include <string>
#include <vector>

namespace petrous::rendering
{

/// OpenGL capabilities relevant to rendering, determined by drawing small test pictures.
struct GraphicsReport
{
  struct Variant
  {
    std::vector<std::string> features; ///< named as in RenderStatistics::variant
    bool compiles = false;
    std::string error; ///< the driver's message if it does not compile
  };

  std::string renderer;     ///< GL_RENDERER
  std::string version;      ///< OpenGL version
  int largestTexture3d = 0; ///< max. voxels along an axis; larger volumes are downsampled
  int filterBits = 0; ///< of the weights with which the card filters volumes; 0: nothing is drawn
  std::vector<Variant> variants; ///< of the ray caster: CT only, with each feature, with all
};

/// Throws RenderingError NoOpenGL, saying what to install, if no context can be created.
GraphicsReport reportGraphics();

} // namespace petrous::rendering
