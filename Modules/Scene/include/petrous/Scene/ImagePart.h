#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Lazy.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Scene/Registration.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::scene
{

/// A CT or MR image of the case. The voxels come when asked for; the rest is known without them.
struct ImagePart
{
  std::string name;
  std::string object; ///< name in the store; empty until saved
  core::GridGeometry geometry;
  volume::ValueRange range;
  std::vector<std::string> notes; ///< what was accepted when the image was read, in words
  core::Lazy<volume::IntensityVolume> volume;
  /// X_MC: takes CT patient points to this image's patient points, LPS mm; identity until
  /// registered.
  core::RigidTransform mrFromCt;
  bool registered = false;
  /// How it came there; set by layMr (ApplyRegistration.h). Nothing until registered.
  std::optional<Registration> registration;
  /// SHA-256 of the file's frame of reference UID (DICOM C.7.4.1): images that have the same were
  /// taken in one position of the patient, as the scanner holds it. Empty: not known.
  std::string frameOfReference;
  /// Whether that was hashed once more with the library's own secret, which Library::save does;
  /// comparable only where both are or neither is.
  bool isFrameSalted = false;
};

} // namespace petrous::scene
