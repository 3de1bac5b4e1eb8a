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

/// Assembles the scene contents of a case repeatedly, keeping the label field while the same voxels
/// are shown: a change of colour, opacity or transfer function is free, showing or hiding a
/// structure rebuilds the field.
class SceneAssembly
{
public:
  /// Loads the CT; label maps, meshes and an MR only if needed. The mask is shared with the case's
  /// dissection if that is loaded.
  ///
  /// What cannot be placed on the CT (scene::Placement) is left out.
  ///
  /// Material 0 is bone, the others are the visible structures in the order of scene::labelSources.
  /// Of the MRs that appearances of what is shown refer to, the first registered ones are drawn, up
  /// to kMrsOfPicture; structures that refer to another are drawn in a single colour, and soft
  /// tissue that does is not drawn; its MR is drawn if bone and structures leave room. Throws
  /// InvalidParameter if more than 255 structures are shown, CancelledError, and what loading the
  /// parts throws.
  rendering::SceneContents contents(const scene::Case& value, const core::Progress& progress = {});

  /// Colours bone by its thickness over this structure (BoneThickness.h) from the next `contents`
  /// on, which throws if there is none of this name; empty: off.
  void showThickness(const std::string& structure);
  const std::string& thicknessOver() const noexcept { return m_thicknessOver; }
  /// The thickness over a structure that is renamed stays, without being measured again.
  void renamed(const std::string& from, const std::string& to);
  /// Takes over the thickness display of `other`, or none.
  void takeThickness(const SceneAssembly& other);

private:
  std::string m_thicknessOver;
  std::shared_ptr<const volume::Volume<float>> m_thickness; ///< of m_thicknessOver, made on demand
  std::vector<volume::LabelSource> m_sources;
  std::shared_ptr<const volume::LabelField> m_labels; ///< of `m_sources`
};

/// The MRs that a picture shows at most.
constexpr std::size_t kMrsOfPicture = 2;

/// The names of the MRs that a picture of the case shows, those of bone and structures first. Reads
/// no image.
std::vector<std::string> drawnMrs(const scene::Case& value);

/// Why an MR that bone or a structure draws values of is not drawn: others are. Empty: it is, or
/// nothing asks for it. Reads no image.
std::string mrMissing(const scene::Case& value, const std::string& mr);

/// Why soft tissue is not drawn where it is shown: "'T2' is not registered with the CT". Empty: it
/// is. Reads no image.
std::string softTissueMissing(const scene::Case& value);

/// Whether a face that a crop box or a clipping plane cuts through soft tissue is drawn at a place,
/// patient LPS mm (OpticalModel.h): soft tissue is, has an extinction there, and was not removed.
/// The place is one without bone or structure. False as long as the image that soft tissue is drawn
/// of is not read: it reads none.
bool drawsSoftFace(const scene::Case& value, const Eigen::Vector3d& patient);

} // namespace petrous::presenters
