#pragma once

#include <memory>
#include <string>

#include <vtk_glew.h>

#include "GlProgram.h"
#include "RayShader.h"
#include "RayTarget.h"
#include "RayView.h"
#include "SceneTextures.h"
#include "ScreenTriangle.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// Casts the rays of RayCast.frag.glsl into a picture of its own: the graphics side of
/// vtkPetrousVolumeMapper, without VTK.
///
/// `draw`, `present`, `release` and the read-backs need the context current in which the first
/// frame was drawn; the setters do not touch OpenGL.
class RayCaster
{
public:
  /// What else a frame needs. `opaque`: depth of opaque polygons in the window, or 0.
  struct Frame
  {
    RayView view;
    int width = 0; ///< of the window's part, pixels
    int height = 0;
    GLuint opaque = 0;
    bool everywhere = false; ///< cast the rays that pass all tissue by, too
  };

  /// Keeps on the card what did not change. Throws RenderingError BadContents.
  void setContents(const SceneContents& contents);
  void setQuality(const RenderQuality& quality); ///< throws InvalidParameter

  /// Marks a box of CT voxels of the mask as changed, to less or to more; null: nothing is cut.
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  /// A tool is in the hand: the mask takes part though nothing is cut yet, so that the first cut
  /// need not wait for a shader and a texture.
  void expectCut(bool expected);

  /// Into the own picture; counting is slower. Throws RenderingError NoOpenGL.
  void draw(const Frame& frame, bool count);

  /// The own picture over the bound frame buffer; blending is set up by the caller.
  void present(int width, int height);

  /// What the last frame was cast into.
  const RayTarget& target() const noexcept { return m_target; }

  void release();
  const RenderStatistics& statistics() const noexcept { return m_statistics; }

private:
  std::shared_ptr<const volume::CutMask> maskInUse() const;
  RayFeatures features() const;
  OccupancyGrid::Rules rules() const;
  void upload();
  void findTissue(const core::IndexBox& bricks);
  core::IndexBox tissueOnScreen(const Frame& frame, int width, int height) const;
  GlProgram& program(bool count);
  void bindTextures(GlProgram& program, const Frame& frame) const;
  void setRays(GlProgram& program, const Frame& frame) const;
  void setVolume(GlProgram& program) const;
  void castRays(const Frame& frame, int width, int height);
  void releaseData();

  SceneContents m_contents; // its mask only where that is in use
  std::shared_ptr<const volume::CutMask> m_givenMask;
  bool m_cutExpected = false;
  RenderQuality m_quality;
  RenderStatistics m_statistics;
  std::unique_ptr<OccupancyGrid> m_occupancy;

  bool m_newCt = false, m_newLabels = false, m_newMaterials = false, m_newSecond = false;
  bool m_newThickness = false;
  bool m_newRules = false;
  core::IndexBox m_dirtyBricks;
  core::IndexBox m_tissueBricks; // all that can be seen lies in them
  volume::ValueRange m_ctRange, m_secondRange;

  IntensityTexture m_ct, m_second;
  MaskTexture m_mask;
  LabelTextures m_labels;
  ThicknessTexture m_thickness;
  MaterialTables m_materials;
  GlTexture m_bricks;
  RayTarget m_target;
  ScreenTriangle m_triangle;
  std::unordered_map<unsigned, GlProgram> m_programs;
  GlProgram m_present;
};

} // namespace petrous::rendering
