#include "petrous/Scene/MrReading.h"

#include <algorithm>

#include "petrous/Scene/Case.h"
#include "petrous/Scene/Placement.h"

namespace petrous::scene
{

namespace
{

bool same(const core::RigidTransform& a, const core::RigidTransform& b)
{
  return a.rotation().coeffs() == b.rotation().coeffs() && a.translation() == b.translation();
}

} // namespace

bool operator==(const MrReading& a, const MrReading& b)
{
  return a.mr == b.mr && a.isGone == b.isGone && same(a.mrFromCt, b.mrFromCt);
}

MrReading readingOf(const ImagePart& mr)
{
  return {mr.name, mr.mrFromCt, false};
}

void addReadings(MrReadings& readings, const MrReadings& more)
{
  for (const MrReading& one : more)
    if (std::find(readings.begin(), readings.end(), one) == readings.end())
      readings.push_back(one);
}

bool isCurrent(const Case& value, const MrReading& reading)
{
  const ImagePart* mr = reading.isGone ? nullptr : findMr(value, reading.mr);
  return mr && mr->registered && same(mr->mrFromCt, reading.mrFromCt);
}

std::string outdatedReading(const Case& value, const MrReadings& readings, MadeFromMr made)
{
  const auto found =
      std::find_if(readings.begin(), readings.end(),
                   [&value](const MrReading& one) { return !isCurrent(value, one); });
  if (found == readings.end())
    return {};
  const ImagePart* mr = found->isGone ? nullptr : findMr(value, found->mr);
  const bool arePoints = made == MadeFromMr::Points;
  return "the MR '" + found->mr +
         (arePoints ? "', on which points were set, " : "', from which it was made, ") +
         (!mr               ? "is not in the case any more"
          : !mr->registered ? "is not registered any more"
                            : "lies elsewhere since") +
         (arePoints ? ": their error is not known"
                    : ": its error is not known until it is made anew");
}

std::string namesOf(const MrReadings& readings)
{
  std::vector<std::string> names;
  for (const MrReading& one : readings)
    if (std::find(names.begin(), names.end(), one.mr) == names.end())
      names.push_back(one.mr);
  return listed(names);
}

} // namespace petrous::scene
