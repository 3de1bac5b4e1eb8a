#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Appearance/StructureLook.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::rendering
{

/// One structure of a label map, and how it is drawn.
struct StructureContents
{
  std::string name;
  std::shared_ptr<const volume::LabelMap> labels;
  std::uint16_t index = 0;
  appearance::StructureLook look;
};

struct MeshContents
{
  std::string name;
  std::shared_ptr<const core::TriangleMesh> mesh;
  appearance::StructureLook look;
};

/// The tool in the scene, patient LPS mm.
struct ToolPose
{
  Eigen::Vector3d center{0.0, 0.0, 0.0};     ///< of the burr
  Eigen::Vector3d axisToHand{0.0, 0.0, 1.0}; ///< from the burr along the shaft
  double radius = 2.0;                       ///< of the burr
  bool drilling = false;                     ///< drawn brighter
};

/// The lamp sits at the camera.
struct LightSettings
{
  double intensity = 1.0;
  double ambient = 0.16;  ///< share of the surface's colour that needs no light
  double specular = 0.18; ///< strength of the highlight, 0 to 1
  double shininess = 18.0;
};

/// Everything that a picture shows, as a value; voxels and triangles are shared.
struct SceneContents
{
  std::shared_ptr<const volume::IntensityVolume> ct; ///< null: no bone
  double iso = 300.0;                                ///< HU
  std::shared_ptr<const volume::CutMask> mask;       ///< null: nothing cut
  std::vector<StructureContents> structures;
  std::vector<MeshContents> meshes; ///< one that a structure of the same name replaces is skipped
  std::optional<ToolPose> tool;
  LightSettings light;
};

} // namespace petrous::rendering
