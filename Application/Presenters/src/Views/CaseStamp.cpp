#include "petrous/Presenters/CaseStamp.h"

namespace petrous::presenters
{

CaseStamp stampOf(const scene::Case& value)
{
  return {value.name, value.description.side, value.description.date};
}

CaseStamp leavingStampOf(const scene::Case& value)
{
  return {{}, value.description.side, {}};
}

} // namespace petrous::presenters
