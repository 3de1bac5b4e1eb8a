#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
};

/// The tool in the scene, patient LPS mm.
struct ToolPose
{
  Eigen::Vector3d center{0.0, 0.0, 0.0};     ///< of the burr
  Eigen::Vector3d axisToHand{0.0, 0.0, 1.0}; ///< from the burr along the shaft
  double radius = 2.0;                       ///< of the burr
  bool drilling = false;                     ///< drawn brighter
  bool handpiece = true;                     ///< false: ball and shaft alone, as of a pointer
};

/// The lamp sits at the camera, as in a microscope.
struct LightSettings
{
  double intensity = 1.0;
  double ambient = 0.16;   ///< occupancy of the surface's colour that needs no light
  double specular = 0.18;  ///< strength of the highlight, 0 to 1
  double shininess = 18.0; ///< of meshes and tools; the volume's tissues have their own
  double falloff = 0.0; ///< mm from the lamp to where its light is halved; 0: everywhere the same
  double wetness = 0.0; ///< strength of the narrow highlight of a wet surface, 0 to 1; 0: dry
};

/// A second image in the same scene, sampled where a material asks for it.
struct SecondImage
{
  std::shared_ptr<const volume::IntensityVolume> volume; ///< null: none
  core::RigidTransform secondFromCt; ///< takes CT patient points to its patient points, LPS mm
};

/// Colours bone by how far its surface is from a structure, so that one sees how much is left to
/// drill. Only the structure's distance counts: what has been cut in between is not asked.
struct ThicknessOverlay
{
  /// mm from the structure's surface, negative within; volume::makeDistanceField with a reach of at
  /// least `farthest`. What its hull does not hold is farther. Null: no overlay.
  std::shared_ptr<const volume::Volume<float>> distance;
  double farthest = 5.0; ///< mm, > 0; thicker bone keeps its colour
};

/// What lies on the negative side is not drawn; patient LPS mm.
struct ClippingPlane
{
  Eigen::Vector3d point{0.0, 0.0, 0.0};
  Eigen::Vector3d normal{0.0, 0.0, 1.0}; ///< unit, towards what stays
};

/// Everything that a picture shows, as a value; voxels and triangles are shared.
struct SceneContents
{
  std::shared_ptr<const volume::IntensityVolume> ct; ///< null: no bone
  double iso = 300.0;                                ///< HU
  std::shared_ptr<const volume::CutMask> mask;       ///< null: nothing cut
  bool boneShown = true;                             ///< false: the CT's surface is not drawn
  std::shared_ptr<const volume::LabelField> labels;  ///< null: none
  std::vector<appearance::Material> materials;       ///< row 0: bone; row i: index i of `labels`
  SecondImage second;
  std::vector<ClippingPlane> clipping;
  std::optional<core::IndexBox> crop; ///< voxels of the CT that are drawn; none: all
  ThicknessOverlay thickness;
  std::vector<MeshContents> meshes;
  std::optional<ToolPose> tool;
  LightSettings light;
};

} // namespace petrous::rendering
