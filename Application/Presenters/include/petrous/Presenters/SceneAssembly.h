#pragma once

#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/LabelField.h"

namespace petrous::presenters
{

/// Puts together what a picture of a case shows, again and again, and keeps the label field for as
/// long as the same voxels are shown: another colour, opacity or transfer function costs nothing,
/// showing or hiding a structure makes the field anew.
class SceneAssembly
{
public:
  /// Loads the CT, and label maps, meshes and an MR only where something of them is shown. The mask
  /// is shared with the case's dissection where that is loaded and something was cut.
  ///
  /// What has no place on the CT (scene::Placement) is left out.
  ///
  /// Material 0 is bone, the others are the shown structures as scene::labelSources orders them. Of
  /// the MR that looks ask for, the first that is registered is drawn; looks that ask for another
  /// are drawn in one colour. Throws InvalidParameter where more than 255 structures are shown,
  /// CancelledError, and what loading the parts throws.
  rendering::SceneContents contents(const scene::Case& value, const core::Progress& progress = {});

  /// Bone is coloured by its thickness over this structure (BoneThickness.h) from the next
  /// `contents` on, which throws where there is none of this name; empty: no longer.
  void showThickness(const std::string& structure);
  const std::string& thicknessOver() const noexcept { return m_thicknessOver; }
  /// The thickness that `other` shows, or none.
  void takeThickness(const SceneAssembly& other);

private:
  std::string m_thicknessOver;
  std::shared_ptr<const volume::Volume<float>> m_thickness; ///< of m_thicknessOver, once asked for
  std::vector<volume::LabelSource> m_sources;
  std::shared_ptr<const volume::LabelField> m_labels; ///< of `m_sources`
};

} // namespace petrous::presenters
