#pragma once

#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Sets the registration of an MR to the CT, and how it was obtained. A sign-off of the previous
/// transform becomes void. MRs registered through this one move along, so that they stay aligned
/// with it; their stated error is no longer valid, which their record notes. Throws
/// InvalidParameter if the case has no MR of that name, or if the transform puts the CT's centre
/// outside the MR by more than the sum of both image diagonals and more than 500 mm: then its unit
/// or a decimal point is wrong.
///
/// mrFromCt  X_MC: CT patient points to this MR's patient points, LPS mm
void applyRegistration(Case& value, const std::string& name, const core::RigidTransform& mrFromCt,
                       Registration how);

/// Whether the MR is `through` itself, or is registered through it, directly or indirectly.
bool liesThrough(const Case& value, const std::string& name, const std::string& through);

/// Throws InvalidParameter if `through` is itself registered through the MR of that name;
/// applyRegistration rejects such a cycle, in which the two would move each other forever.
void checkThrough(const Case& value, const std::string& name, const std::string& through);

/// Removes the registration of an MR; MRs registered through it lose theirs.
void removeRegistration(Case& value, const std::string& name);

/// Records who accepts the current registration of the MR. Throws InvalidParameter if it is not
/// registered, or if the name is invalid (1 to 100 bytes of UTF-8 without control characters).
void signOff(Case& value, const std::string& name, const std::string& who, const std::string& when);

/// The sign-off of the MR's current transform; nullptr if there is none.
const SignOff* validSignOff(const ImagePart& mr) noexcept;

/// "registered by mutual information, good, error 0.24 mm (p95) at 'incus', signed off by A.
/// Surgeon on 2026-01-31T10:00:00Z", "not registered".
std::string registrationToString(const ImagePart& mr);

} // namespace petrous::scene
