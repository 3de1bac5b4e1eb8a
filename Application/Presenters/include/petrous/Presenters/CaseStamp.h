#pragma once

#include <string>

#include "petrous/Presenters/IdentityText.h"
#include "petrous/Scene/Description.h"

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

/// Of a picture that may leave this computer: without the planned date, which with the list of a
/// day's operations tells who the patient is, and without a name that may do so.
CaseStamp leavingStampOf(const scene::Case& value, const IdentityText& identity);

} // namespace petrous::presenters
