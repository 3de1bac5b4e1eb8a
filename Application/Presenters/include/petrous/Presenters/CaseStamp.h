#pragma once

#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// What stands over every view of a case, so that no picture is taken for that of another patient
/// or of the other side. Of what was typed alone: nothing of it comes from an image's header.
struct CaseStamp
{
  std::string name; ///< of the case; empty where it may not leave
  scene::Side side = scene::Side::Unknown;
  std::string planned; ///< date of the operation, ISO 8601; empty: unknown, or it may not leave
};

CaseStamp stampOf(const scene::Case& value);

/// Why the stated side is doubtful, in words: all of the CT (or primary MR) lies on the other side
/// of the scanner's middle (LPS x = 0), where the image states its place. A hint only, as a patient
/// need not lie in the middle. Empty: nothing speaks against it.
std::string sideDoubt(const scene::Case& value);

/// Likewise of an ear that is looked at: the case states the other side, or all of its image lies
/// there.
std::string earDoubt(const scene::Case& value, scene::Side ear);

/// Of a picture that may leave this computer, the side alone: the planned date tells who the
/// patient is to who has the list of that day's operations, and a name in pixels would outlive its
/// change.
CaseStamp leavingStampOf(const scene::Case& value);

} // namespace petrous::presenters
