#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "OpticalModel.h"
#include "petrous/Rendering/ClippedRegion.h"
#include "petrous/Rendering/PixelRays.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/MeshInside.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::rendering
{

/// Distance along a ray, mm, to the drill (ball, shaft and handpiece); nullopt: it misses. From
/// inside, to where it leaves.
std::optional<double> toolAlong(const ToolPose& tool, const PixelRay& ray);

/// Ray intersection with the meshes and the tool of a scene, shaded as tissue surfaces; the tool
/// has its own highlight. Crop box and clipping planes cut meshes, not the tool; a closed mesh has
/// a face there.
class SurfaceGeometry
{
public:
  struct Hit
  {
    double distance = 0.0; ///< mm along the ray
    Eigen::Vector3d color; ///< lit, RGB
    double opacity = 1.0;  ///< fraction of pixels that a translucent mesh covers (screen door)
  };

  /// Throws RenderingError BadContents for a mesh without triangles, InvalidParameter for an
  /// inconsistent one.
  explicit SurfaceGeometry(const SceneContents& contents);

  /// What a point of a mesh or of the tool sees; normal towards the camera.
  using Seeing = std::function<optics::Seen(const Eigen::Vector3d& point,
                                            const Eigen::Vector3d& normal, bool isTool)>;

  /// Nearest first, at most one hit per mesh, up to and including the first opaque one. `focus`:
  /// mm to where the light's falloff changes nothing. `seeing`: null: everything is seen.
  std::vector<Hit> along(const PixelRay& ray, double focus = 0.0,
                         const Seeing& seeing = nullptr) const;

private:
  struct Mesh
  {
    volume::MeshTree tree;
    std::shared_ptr<const core::TriangleMesh> mesh;
    std::vector<Eigen::Vector3f> normals; ///< per vertex
    appearance::StructureAppearance look;
    std::optional<volume::MeshInside> inside; ///< of a closed one that box or planes may cut
    bool isDrilled = false;
  };
  std::optional<Hit> meet(const Mesh& mesh, const PixelRay& ray, double focus,
                          const Seeing& seeing) const;

  std::vector<Mesh> m_meshes;
  std::optional<ClippedRegion> m_kept; // of meshes; none: all
  bool m_hasSection;
  std::shared_ptr<const volume::CutMask> m_mask;
  std::optional<ToolPose> m_tool;
  std::optional<volume::MeshTree> m_instrument; // of the tool, in its frame
  LightSettings m_light;
};

} // namespace petrous::rendering
