#pragma once

#include <string>
#include <vector>

#include "petrous/Core/RigidTransform.h"

namespace petrous::scene
{

struct Case;
struct ImagePart;

/// An MR whose intensities something was made from, and where it lay on the CT at that time. What
/// was made stays where it is when the MR is moved; then the error of the MR's registration is no
/// longer that of what was made.
struct MrReading
{
  std::string mr;                ///< its name
  core::RigidTransform mrFromCt; ///< X_MC, by which it was read
  bool isGone = false;           ///< the MR was removed since; another one may have its name by now
};

bool operator==(const MrReading& a, const MrReading& b);

using MrReadings = std::vector<MrReading>;

/// Of the MR as it lies now.
MrReading readingOf(const ImagePart& mr);

/// Adds what is not among them yet.
void addReadings(MrReadings& readings, const MrReadings& more);

/// Whether the MR is there, and registered as it was.
bool isCurrent(const Case& value, const MrReading& reading);

/// What was made from an MR.
enum class MadeFromMr
{
  Structure,
  Points ///< that were set on it
};

/// Why the registration error of what was made is not known, since an MR does not lie any more as
/// it was read: "the MR 'T2', from which it was made, lies elsewhere since: ..."; empty if all lie
/// as they did.
std::string outdatedReading(const Case& value, const MrReadings& readings,
                            MadeFromMr made = MadeFromMr::Structure);

/// "'T2', 'T1'", each name once; empty: read from no MR.
std::string namesOf(const MrReadings& readings);

} // namespace petrous::scene
