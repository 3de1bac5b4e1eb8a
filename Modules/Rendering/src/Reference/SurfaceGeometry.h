#pragma once

#include <vector>

#include "TriangleTree.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// The meshes and the tool of a scene, as a ray meets them: lit as the surfaces of tissue are, the
/// tool with a highlight of its own.
class SurfaceGeometry
{
public:
  struct Hit
  {
    double distance = 0.0; ///< mm along the ray
    Eigen::Vector3d color; ///< lit, RGB
    double opacity = 1.0;  ///< share of pixels that a translucent mesh covers (screen door)
  };

  /// Throws RenderingError BadContents for a mesh without triangles, InvalidParameter for one that
  /// contradicts itself.
  explicit SurfaceGeometry(const SceneContents& contents);

  /// Nearest first, one of each mesh at most, up to the first that nothing is seen through.
  std::vector<Hit> along(const PixelRay& ray) const;

private:
  struct Mesh
  {
    TriangleTree tree;
    appearance::StructureAppearance look;
  };

  std::vector<Mesh> m_meshes;
  std::optional<ToolPose> m_tool;
  LightSettings m_light;
};

} // namespace petrous::rendering
