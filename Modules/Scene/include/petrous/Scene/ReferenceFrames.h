#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Registration state of one MR: the fields of ImagePart that applyRegistration changes.
struct MrPlace
{
  std::string name;
  core::RigidTransform mrFromCt; ///< X_MC, LPS mm
  bool registered = false;
  std::optional<Registration> registration;
};

std::vector<MrPlace> mrPlaces(const Case& value);

/// Restores the registrations of the MRs with applyRegistration and removeRegistration. Unchanged
/// MRs keep their sign-off; for an MR that is changed no sign-off is restored. Names not in the
/// case are ignored.
void layAs(Case& value, const std::vector<MrPlace>& places);

} // namespace petrous::scene
