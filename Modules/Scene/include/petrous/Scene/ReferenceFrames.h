#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// How one MR lies on the CT: what of an ImagePart layMr changes.
struct MrPlace
{
  std::string name;
  core::RigidTransform mrFromCt; ///< X_MC, LPS mm
  bool registered = false;
  std::optional<Registration> registration;
};

std::vector<MrPlace> mrPlaces(const Case& value);

/// Lays the MRs as they lay then, by layMr and unlayMr. One that lies so now stays as it is, with
/// its sign-off; to one that is laid anew no sign-off comes back. Names that the case has not are
/// passed over.
void layAs(Case& value, const std::vector<MrPlace>& places);

} // namespace petrous::scene
