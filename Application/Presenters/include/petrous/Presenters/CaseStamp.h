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

/// Of a picture that may leave this computer, the side alone: the planned date tells who the
/// patient is to who has the list of that day's operations, and a name in pixels would outlive its
/// change.
CaseStamp leavingStampOf(const scene::Case& value);

} // namespace petrous::presenters
