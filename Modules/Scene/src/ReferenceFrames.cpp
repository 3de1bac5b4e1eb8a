#include "petrous/Scene/ReferenceFrames.h"

#include "petrous/Scene/ApplyRegistration.h"

namespace petrous::scene
{

namespace
{

bool same(const std::optional<RegistrationError>& a, const std::optional<RegistrationError>& b)
{
  if (!a || !b)
    return !a && !b;
  return a->point == b->point && a->place == b->place && a->median == b->median &&
         a->p95 == b->p95 && a->max == b->max && a->spread == b->spread;
}

// Ignores the sign-off.
bool same(const std::optional<Registration>& a, const std::optional<Registration>& b)
{
  if (!a || !b)
    return !a && !b;
  return a->method == b->method && a->refined == b->refined && a->verdict == b->verdict &&
         a->text == b->text && a->metric == b->metric && same(a->error, b->error) &&
         a->through == b->through;
}

bool lies(const ImagePart& mr, const MrPlace& place)
{
  return mr.registered == place.registered &&
         mr.mrFromCt.rotation().coeffs() == place.mrFromCt.rotation().coeffs() &&
         mr.mrFromCt.translation() == place.mrFromCt.translation() &&
         same(mr.registration, place.registration);
}

void lay(Case& value, const MrPlace& place)
{
  if (place.registered)
    applyRegistration(value, place.name, place.mrFromCt,
                      place.registration.value_or(Registration{}));
  else
    removeRegistration(value, place.name);
  for (ImagePart& mr : value.mr)
    if (mr.name == place.name && !place.registration)
      mr.registration.reset(); // from an older case: method unknown
}

} // namespace

std::vector<MrPlace> mrPlaces(const Case& value)
{
  std::vector<MrPlace> all;
  for (const ImagePart& mr : value.mr)
    all.push_back({mr.name, mr.mrFromCt, mr.registered, mr.registration});
  return all;
}

void layAs(Case& value, const std::vector<MrPlace>& places)
{
  // An MR moves those registered through it, which then have to be set again: at most once per link
  // of the longest chain.
  for (std::size_t pass = 0; pass <= places.size(); ++pass)
  {
    bool changed = false;
    for (const MrPlace& place : places)
      if (const ImagePart* mr = findMr(value, place.name); mr && !lies(*mr, place))
      {
        lay(value, place);
        changed = true;
      }
    if (!changed)
      return;
  }
}

} // namespace petrous::scene
