#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "MacroCells.h"
#include "petrous/Rendering/SceneContents.h"

class vtkGPUVolumeRayCastMapper;
class vtkVolume;

namespace petrous::rendering
{

/// Bone: the surface min(c_CT, mask - 0.5) = 0, cast through VTK's GPU volume mapper whose
/// compositing is replaced by BoneSurface.glsl.
///
/// Uncut, the CT's own memory is the texture's source. Once cut, CT and mask lie side by side in
/// one image of two components: each is interpolated by itself, then combined, as the tissue field
/// does it (one pre-combined scalar would shift the surface where both matter).
class BoneVolume
{
public:
  BoneVolume();
  ~BoneVolume();

  vtkVolume* prop() const;

  /// Null CT: nothing is drawn.
  void setContents(std::shared_ptr<const volume::IntensityVolume> ct, double iso,
                   std::shared_ptr<const volume::CutMask> mask, const LightSettings& light);

  /// Only the voxels of `box` are combined again.
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  void setInteractive(bool interactive);
  void addResources(std::map<std::string, std::size_t>& resources) const;

private:
  bool isCut() const;
  void updateInput();
  void updateShader();
  void updateUniforms();

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  double m_iso = 0.0;
  std::shared_ptr<const volume::CutMask> m_mask;
  LightSettings m_light;

  vtkSmartPointer<vtkImageData> m_plain;    // wraps the CT
  vtkSmartPointer<vtkImageData> m_combined; // CT and mask; null while nothing is cut
  std::unique_ptr<MacroCells> m_cells;
  int m_shaderVariant = -1;

  vtkNew<vtkGPUVolumeRayCastMapper> m_mapper;
  vtkNew<vtkVolume> m_prop;
};

} // namespace petrous::rendering
