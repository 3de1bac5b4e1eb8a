#include "petrous/Presenters/CaseStamp.h"

namespace petrous::presenters
{

CaseStamp stampOf(const scene::Case& value)
{
  return {value.name, value.description.side, value.description.date};
}

CaseStamp leavingStampOf(const scene::Case& value, const IdentityText& identity)
{
  CaseStamp stamp = stampOf(value);
  stamp.planned.clear();
  if (identity.mayIdentify(stamp.name))
    stamp.name.clear();
  return stamp;
}

} // namespace petrous::presenters
