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

std::string sideDoubt(const scene::Case& value)
{
  const scene::Side side = value.description.side;
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
  const std::string is = isLeft ? "left" : "right";
  return "The side is stated as " + std::string(isLeft ? "right" : "left") +
         ", but all of the image lies on the patient's " + is + ", " + core::fixedText(from, 1) +
         " to " + core::fixedText(to, 1) +
         " mm from the scanner's middle. Is the side right? (A patient need not lie in the "
         "middle.)";
}

CaseStamp leavingStampOf(const scene::Case& value)
{
  return {{}, value.description.side, {}};
}

} // namespace petrous::presenters
