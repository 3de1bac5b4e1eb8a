#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "OpticalModel.h"
#include "TissueOptics.h"
#include "petrous/Rendering/ClippedRegion.h"
#include "petrous/Volume/MeshInside.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::rendering
{

/// What a surface sees of the sky and of the lamp, by many rays through the tissue field and closed
/// meshes and past the tool. Pure and thread-safe; refers to `optics` and `drawn`.
class SurfaceShadows
{
public:
  static constexpr int kSkyRays = 256; ///< distributed by the cosine
  static constexpr int kLampRays = 64;

  /// `contents`: those of the optics; of them the meshes, the mask and the tool.
  SurfaceShadows(const TissueOptics& optics, const ClippedRegion& drawn,
                 const SceneContents& contents);

  /// Whose surface it is. A mesh or a tool that lies in tissue or in a mesh sees through it, and
  /// the tool sees past itself.
  enum class Of
  {
    Tissue,
    Mesh,
    Tool
  };

  /// `normal`: unit, towards the camera; zero: everything is seen.
  optics::Seen at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                  const optics::Lamp& lamp, Of surface = Of::Tissue) const;

private:
  struct Mesh
  {
    volume::MeshTree tree;
    volume::MeshInside inside;
    double opacity;
    bool drilled;
  };
  struct Entry
  {
    double t; // mm along the ray
    double opacity;
  };

  void addEntries(const Mesh& mesh, const PixelRay& ray, double last,
                  std::vector<Entry>& entries) const;
  std::optional<double> toolAlong(const PixelRay& ray) const;
  template <class Weight>
  double stopped(const PixelRay& ray, double reach, Of surface, const Weight& weight) const;

  const TissueOptics& m_optics;
  const ClippedRegion& m_drawn;
  std::shared_ptr<const volume::CutMask> m_mask;
  std::vector<Mesh> m_meshes;                   // closed, and shown
  std::optional<ToolPose> m_tool;               // that is shown
  std::optional<volume::MeshTree> m_instrument; // of the tool, in its frame
  double m_step;                                // mm
};

} // namespace petrous::rendering
