#include "petrous/Presenters/CaseStamp.h"

#include <algorithm>
#include <cmath>

#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/SlicePlanes.h"

namespace petrous::presenters
{

CaseStamp stampOf(const scene::Case& value)
{
  return {value.name, value.description.side, value.description.date};
}

namespace
{

// A phrase of its own (Phrasebook), as the texts that it stands in are no names.
std::string sideText(scene::Side side)
{
  return side == scene::Side::Left    ? "left"
         : side == scene::Side::Right ? "right"
         : side == scene::Side::Both  ? "both"
                                      : "not stated";
}

// "on the patient's left, 12.0 to 40.0 mm from the scanner's middle", if all of the image lies on
// the other side than this one; else empty.
std::string oppositePlace(const scene::Case& value, scene::Side side)
{
  if ((side != scene::Side::Left && side != scene::Side::Right) || !statesPlace(value.ct))
    return {};
  const core::PatientBox box = value.ct.geometry.patientBounds();
  const double least = box.min().x();
  const double most = box.max().x();
  const bool isLeft = least > 0.0;
  if ((!isLeft && most >= 0.0) || isLeft == (side == scene::Side::Left))
    return {};
  const double from = std::min(std::abs(least), std::abs(most));
  const double to = std::max(std::abs(least), std::abs(most));
  return std::string("on the patient's ") + (isLeft ? "left" : "right") + ", " +
         core::fixedText(from, 1) + " to " + core::fixedText(to, 1) +
         " mm from the scanner's middle";
}

} // namespace

std::string sideDoubt(const scene::Case& value)
{
  const scene::Side side = value.description.side;
  const std::string place = oppositePlace(value, side);
  return place.empty() ? place
                       : std::string("The side is stated as ") + sideText(side) +
                             ", but all of the image lies " + place +
                             ". Is the side right? (A patient need not lie in the middle.)";
}

std::string earDoubt(const scene::Case& value, scene::Side ear)
{
  const scene::Side side = value.description.side;
  if (ear != scene::Side::Left && ear != scene::Side::Right)
    return {};
  const std::string seen = std::string("This is the ") + sideText(ear) + " ear";
  if ((side == scene::Side::Left || side == scene::Side::Right) && side != ear)
    return seen + ", but the side of the case is stated as " + sideText(side) + ".";
  const std::string place = oppositePlace(value, ear);
  return place.empty() ? place : seen + ", but all of the image lies " + place + ".";
}

CaseStamp leavingStampOf(const scene::Case& value)
{
  return {{}, value.description.side, {}};
}

} // namespace petrous::presenters
