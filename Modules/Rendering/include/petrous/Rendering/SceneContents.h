#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Appearance/Material.h"
#include "petrous/Appearance/StructureAppearance.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelField.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

struct MeshContents
{
  std::string name;
  std::shared_ptr<const core::TriangleMesh> mesh;
  appearance::StructureAppearance look;
  bool drilled = false; ///< a closed one is drawn as the mask left it: it is felt (record 39)
};

/// How a burr's ball is shaded; its shape is the ball in any case, as it is felt.
enum class BurrFinish
{
  Smooth,
  Fluted, ///< a cutting burr
  Gritted ///< a diamond burr
};

/// The tool in the scene, patient LPS mm.
struct ToolPose
{
  Eigen::Vector3d center{0.0, 0.0, 0.0};     ///< of the burr; an instrument's tip
  Eigen::Vector3d axisToHand{0.0, 0.0, 1.0}; ///< from the burr along the shaft
  double radius = 2.0;                       ///< of the burr
  bool drilling = false;                     ///< drawn brighter
  bool handpiece = true;                     ///< false: ball and shaft only, as for a pointer
  BurrFinish finish = BurrFinish::Smooth;
  double turn = 0.0; ///< rad about the axis, of the finish
  /// Drawn in place of ball, shaft and handpiece: a closed surface, its tip at the origin, +z to
  /// the hand, mm.
  std::shared_ptr<const core::TriangleMesh> instrument = nullptr;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity(); ///< of the instrument
};

/// The light source is at the camera, as in a microscope.
struct LightSettings
{
  static constexpr double kAmbient = 0.16;
  static constexpr double kAmbientWithShadows = 0.4; ///< which only then differs between places

  double intensity = 1.0;
  double ambient = kAmbient; ///< ambient fraction of the surface colour
  double specular = 0.18;    ///< strength of the highlight, 0 to 1
  double shininess = 18.0;   ///< of meshes and tools; tissues of the volume have their own
  /// mm from the light to where it has half of its intensity at the light; 0: no attenuation. The
  /// camera's focal point is as bright as without.
  double falloff = 0.0;
  /// Intensity of the thin highlight of a film of water, which takes the place of tissue's own
  /// gloss, 0 to 1; 0: dry.
  double wetness = 0.0;
  /// Tissue, closed meshes and the tool keep ambient light out of cavities, and throw a soft shadow
  /// of a lamp somewhat above the view axis (records 33 and 42).
  bool shadows = false;
  double exposure = 0.0;  ///< EV: each doubles the luminance on the screen (record 35)
  bool toneCurve = false; ///< highlights roll off instead of being clipped
  /// How much of the path through a shell its opacity follows, 0 to 1: translucent surfaces are
  /// the more opaque the more they are seen from the side, and keep their shape (record 42).
  double edges = 0.0;
  /// Contrast of the fine grain of bone where it was cut, 0 to 1; 0: none, as the CT has none
  /// (record 80).
  double grain = 0.0;
  /// Translucent tissue has a surface also where a ray leaves it towards air or soft tissue, as it
  /// has where it is entered (record 85).
  bool exitSurfaces = false;

  /// With the ambient light that goes with it.
  void setShadows(bool on)
  {
    shadows = on;
    ambient = on ? kAmbientWithShadows : kAmbient;
  }
};

/// An image beside the CT in the same scene, sampled by the materials that ask for it.
struct SecondImage
{
  std::shared_ptr<const volume::IntensityVolume> volume; ///< null: none
  core::RigidTransform secondFromCt; ///< maps CT patient points to its patient points, LPS mm
};

/// Colours bone by the distance of its surface to a structure, to show how much is left to drill.
/// Only the distance to the structure counts; bone already removed in between is ignored.
struct ThicknessOverlay
{
  /// Signed distance to the structure's surface, mm, negative inside: volume::makeDistanceField
  /// with a reach of at least `farthest`. Points outside its hull count as farther. Null: no
  /// overlay.
  std::shared_ptr<const volume::Volume<float>> distance;
  double farthest = 5.0; ///< mm, > 0; thicker bone keeps its colour
};

/// Grey of the CT's sections: black at `level` - `width` / 2, white at `level` + `width` / 2.
struct SectionWindow
{
  double width = 4000.0; ///< > 0, in the CT's unit
  double level = 700.0;
};

namespace optics
{
/// Extinction of soft tissue, 1/mm, above which a section shows it.
constexpr double kSoftInSection = 0.002;
} // namespace optics

/// The negative side is not drawn; patient LPS mm.
struct ClippingPlane
{
  Eigen::Vector3d point{0.0, 0.0, 0.0};
  Eigen::Vector3d normal{0.0, 0.0, 1.0}; ///< unit, towards the side that is kept
};

/// RGB as it is displayed, 0 to 1.
using BackgroundColor = std::array<double, 3>;
inline constexpr BackgroundColor kDefaultBackground{0.105, 0.115, 0.130};

/// Everything a picture shows, as a value type; voxels and triangles are shared.
struct SceneContents
{
  std::shared_ptr<const volume::IntensityVolume> ct; ///< null: no bone
  double iso = 300.0;                                ///< HU
  std::shared_ptr<const volume::CutMask> mask;       ///< null: nothing cut
  bool boneShown = true;                             ///< false: the CT's surface is not drawn
  std::shared_ptr<const volume::LabelField> labels;  ///< null: none
  std::vector<appearance::Material> materials;       ///< row 0: bone; row i: label index i
  /// What is neither bone nor a structure nor cut away, drawn by a transfer function of its own;
  /// its surface opacity and whether it is a lumen do not count. nullopt: it is air to a ray.
  std::optional<appearance::Material> softTissue;
  SecondImage second;
  SecondImage third;
  std::vector<ClippingPlane> clipping;
  std::optional<core::IndexBox> crop; ///< drawn CT voxels; nullopt: all
  /// Where hull, crop box and clipping planes cut tissue off, the face is unlit, and bone's shows
  /// the CT in grey; nullopt: such faces are lit as surfaces are.
  std::optional<SectionWindow> section;
  ThicknessOverlay thickness;
  std::vector<MeshContents> meshes;
  std::optional<ToolPose> tool;
  LightSettings light;
  BackgroundColor background = kDefaultBackground; ///< neither lit nor exposed
};

/// The image that a material of another source than the CT reads.
inline const SecondImage& otherImage(const SceneContents& contents,
                                     appearance::IntensitySource source)
{
  return source == appearance::IntensitySource::Third ? contents.third : contents.second;
}

} // namespace petrous::rendering
