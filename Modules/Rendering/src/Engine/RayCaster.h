#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <vtk_glew.h>

#include "GlProgram.h"
#include "GlTexture.h"
#include "InstrumentDistance.h"
#include "OpacityPyramid.h"
#include "OpticalModel.h"
#include "RayShader.h"
#include "RayView.h"
#include "SceneTextures.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// Render target of the ray caster: premultiplied colour, distance to the first surface, and counts
/// if requested. Belongs to the context in which it was prepared; must be released explicitly.
class RayTarget
{
public:
  /// Binds it for drawing at the given size. Throws RenderingError NoOpenGL.
  void prepare(int width, int height, bool count);
  void release();

  const GlTexture& color() const noexcept { return m_color; }

  /// Distance to the first surface, mm along each pixel's ray, top row first; NaN: none.
  DepthImage readDepth() const;
  /// Depth at one pixel when shown as a picture of width x height, rows from the top.
  float readDepth(double column, double row, int width, int height) const;

  /// Nothing is seen in a rectangle of the bound target.
  void clear(const core::IndexBox& pixels) const;
  /// Binds it so that only its colour is drawn; `prepare` ends that.
  void bindColor() const;

  /// Fetches and samples, averaged over the pixels. The target must be bound.
  std::array<double, 2> meanCounts() const;

private:
  GlTexture m_color;
  GlTexture m_depth;
  GlTexture m_count;
  GLuint m_framebuffer = 0;
  bool m_counting = false;
};

/// Casts the rays of RayCast.frag.glsl into its own render target: the OpenGL side of
/// vtkPetrousVolumeMapper, independent of VTK.
///
/// `draw`, `present`, `release` and the read-backs require the context of the first frame to be
/// current; the setters make no OpenGL calls.
class RayCaster
{
public:
  /// A circle that is drawn finer than the rest; pixels of the viewport from its lower left.
  struct Fovea
  {
    double x = 0.0, y = 0.0, radius = 0.0;
    double scale = 1.0; ///< of the picture's edge, as RenderQuality::imageScale
    double step = 0.5;  ///< as RenderQuality::step
  };

  /// Input of a frame. `opaque`: depth texture of the window's opaque polygons, or 0.
  struct Frame
  {
    RayView view;
    int width = 0; ///< of the viewport, pixels
    int height = 0;
    GLuint opaque = 0;
    optics::Lamp lamp = {};                      ///< in patient mm
    std::optional<ToolPose> tool = std::nullopt; ///< that casts shadows, in patient mm
    int sample = -1;         ///< of kPixelSamples, see optics::asideOf; -1: the only one
    bool everywhere = false; ///< also cast rays that cannot meet tissue
    std::optional<Fovea> fovea = std::nullopt;
    /// An instrument that is new throws its shadow once that is measured in the background
    /// (RenderStatistics::pendingShadow), not at once.
    bool shadowsLater = false;
  };

  /// Unchanged data stay on the GPU. Throws RenderingError BadContents.
  void setContents(const SceneContents& contents);
  void setQuality(const RenderQuality& quality); ///< throws InvalidParameter

  /// The mask decreased or increased in a box of CT voxels; null: nothing is cut.
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  /// A tool is in use: the mask takes part although nothing is cut yet, so that the first cut does
  /// not wait for shader compilation and texture upload.
  void expectCut(bool expected);

  /// Renders into the own target; counting is slower. Throws RenderingError NoOpenGL.
  void draw(const Frame& frame, bool count);

  /// Before the polygons of a frame, which are drawn before its rays: makes what shadePolygons
  /// needs, if there are shadows. Throws RenderingError NoOpenGL.
  void prepareShadows(const Frame& frame);
  /// Sets the uniforms of polygonShadowsShader in a program that is in use. `isTool`: it draws the
  /// tool, which throws no shadow on itself.
  void shadePolygons(GlUniforms& uniforms, const Frame& frame,
                     const Eigen::Matrix4d& patientFromView, bool isTool) const;

  /// Draws the own target over the bound frame buffer; the caller sets up blending.
  void present(int width, int height);
  /// The same of another target of that size.
  void present(const RayTarget& target) { copy(target.color(), 1.0); }
  /// Draws a picture texel by texel over the bound frame buffer, multiplied by `share`.
  void copy(const GlTexture& picture, double share);

  /// Casts the rays of a rectangle of a target that is bound, of the frame's size, with `quality`;
  /// after a `draw` since which nothing has changed.
  void drawPart(const Frame& frame, const RenderQuality& quality, const core::IndexBox& pixels);

  /// Pixel rectangle of a picture whose rays may meet tissue.
  core::IndexBox tissueOnScreen(const Frame& frame, int width, int height) const;

  /// Number of changes so far of what is drawn.
  std::uint64_t changes() const noexcept { return m_changes; }

  /// Target of the last frame, without its fovea.
  const RayTarget& target() const noexcept { return m_target; }
  /// Depth at one pixel of the last frame, in the fovea that of it; see RayTarget.
  float readDepth(double column, double row, int width, int height) const;

  void release();
  void releaseData();    ///< what is of the contents; the programs stay
  void releasePicture(); ///< what was drawn, with its depth
  const RenderStatistics& statistics() const noexcept { return m_statistics; }

private:
  std::shared_ptr<const volume::CutMask> maskInUse() const;
  bool softTissueSeen() const;
  bool interiorSeen() const;
  RayFeatures features(const Frame& frame) const;
  OccupancyGrid::Rules rules() const;
  OpacityPyramid::Scene lightStoppers() const;
  void upload();
  void uploadOpacities();
  core::IndexBox followMeshes();
  void uploadInstrument(const Frame& frame);
  bool hasInstrument(const Frame& frame) const;
  bool hasPlainTool(const Frame& frame) const;
  void findTissue(const core::IndexBox& bricks);
  void drawFovea(const Frame& frame);
  GlProgram& program(const Frame& frame, bool count);
  void findFilterBits();
  void bindTextures(GlProgram& program, const Frame& frame) const;
  void setRays(GlProgram& program, const Frame& frame, int height) const;
  void setVolume(GlProgram& program) const;
  void setLight(GlProgram& program, const Frame& frame) const;
  void setShadows(GlUniforms& program, const Frame& frame) const;
  void setDrawn(GlUniforms& program) const;
  void castRays(const core::IndexBox& pixels);
  GlProgram& presenting();

  SceneContents m_contents; // its mask only if in use
  std::shared_ptr<const volume::CutMask> m_givenMask;
  bool m_cutExpected = false;
  RenderQuality m_quality;
  RenderStatistics m_statistics;
  std::unique_ptr<OccupancyGrid> m_occupancy;
  std::unique_ptr<OpacityPyramid> m_opacities; // only with shadows
  using MeshPointer = std::shared_ptr<const core::TriangleMesh>;
  std::map<MeshPointer, std::shared_ptr<const MeshShares>> m_shares; // once shown
  std::vector<OpacityPyramid::Mesh> m_meshes;                        // that are shown
  bool m_isPrepared = false; // for the polygons of this frame, and its rays

  /// An image beside the CT.
  struct OtherImage
  {
    appearance::IntensitySource source; // of the materials that read it
    IntensityTexture data = {};
    volume::ValueRange range = {};
    bool isNew = false;
  };

  bool m_newCt = false, m_newLabels = false, m_newMaterials = false;
  bool m_newThickness = false;
  bool m_newRules = false;
  bool m_newOpacities = false;
  bool m_newMeshes = false;
  core::IndexBox m_dirtyBricks;
  core::IndexBox m_dirtyOpacities;
  core::IndexBox m_tissueBricks; // bounding box of all visible tissue
  volume::ValueRange m_ctRange;

  IntensityTexture m_ct;
  std::array<OtherImage, 2> m_others{OtherImage{appearance::IntensitySource::Second},
                                     OtherImage{appearance::IntensitySource::Third}};
  MaskTexture m_mask;
  LabelTextures m_labels;
  ThicknessTexture m_thickness;
  MaterialTables m_materials;
  GlTexture m_bricks;
  GlTexture m_opacityTexture;
  struct InstrumentTexture
  {
    GlTexture texture;
    MeshPointer mesh;         // whose it is
    InstrumentDistance place; // without the distances
  } m_instrument;
  std::unique_ptr<InstrumentMeasurement> m_measurement; // of one that throws no shadow yet
  RayTarget m_target;
  RayTarget m_foveaTarget;
  std::optional<Fovea> m_fovea; // of the last frame
  std::uint64_t m_changes = 0;
  ScreenTriangle m_triangle;
  int m_filterBits = 0; // of the card; 0: not measured yet
  std::unordered_map<unsigned, GlProgram> m_programs;
  GlProgram m_present;
};

} // namespace petrous::rendering
