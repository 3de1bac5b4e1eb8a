#pragma once

#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Lays an MR on the CT, and says how that was done. A sign-off of the transform before is void. An
/// MR that came through this one moves along, so that it lies on this one as before; what was
/// stated of its error holds no longer, and its record says so. Throws InvalidParameter where the
/// case has no MR of that name, and where the transform puts the CT's middle farther outside the MR
/// than both are large, and than 500 mm: then its unit or a decimal point is wrong.
///
/// mrFromCt  X_MC: CT patient points to this MR's patient points, LPS mm
void layMr(Case& value, const std::string& name, const core::RigidTransform& mrFromCt,
           Registration how);

/// Whether the MR of that name is `through`, or came to the CT through it, be it by way of others.
bool liesThrough(const Case& value, const std::string& name, const std::string& through);

/// Throws InvalidParameter where `through` itself came to the CT through the MR of that name, which
/// layMr refuses: the two would move each other for ever.
void checkThrough(const Case& value, const std::string& name, const std::string& through);

/// Takes its place from an MR again; those that came through it lose theirs.
void unlayMr(Case& value, const std::string& name);

/// Writes down who accepts the MR as it lies now. Throws InvalidParameter where it is not
/// registered, or the name is no name (1 to 100 bytes of UTF-8 without control characters).
void signOff(Case& value, const std::string& name, const std::string& who, const std::string& when);

/// The sign-off of the transform that the MR has now; null where nobody signed that.
const SignOff* validSignOff(const ImagePart& mr) noexcept;

/// "registered by mutual information, good, error 0.24 mm (p95) at 'incus', signed off by A.
/// Surgeon on 2026-01-31T10:00:00Z", "not registered".
std::string registrationInWords(const ImagePart& mr);

} // namespace petrous::scene
