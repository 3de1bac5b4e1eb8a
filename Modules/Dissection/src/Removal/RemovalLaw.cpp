#include "petrous/Dissection/RemovalLaw.h"

#include <cmath>
#include <string>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::dissection
{

namespace
{

std::string text(double value)
{
  std::string result = core::fixedText(value, 6);
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.')
    result.pop_back();
  return result;
}

void require(bool holds, const std::string& what)
{
  if (!holds)
    throw core::InvalidParameter(what);
}

} // namespace

OrthogonalCutting::OrthogonalCutting(double specificEnergy, double friction, double rake)
{
  require(specificEnergy > 0.0 && std::isfinite(specificEnergy),
          "the specific cutting energy must be above 0, it is " + text(specificEnergy) + " Pa");
  require(friction >= 0.0 && friction <= kMaxFriction,
          "the friction must lie within 0 to " + text(kMaxFriction) + ", it is " + text(friction));
  require(std::abs(rake) <= kMaxRake, "the rake angle must lie within 60 degrees");
  const double slope = std::tan(rake);
  require(friction - slope >= kMinDifference,
          "friction less the rake's tangent must be at least " + text(kMinDifference) + ", it is " +
              text(friction - slope) + " (friction " + text(friction) + ", tangent " + text(slope) +
              ")");
  require(1.0 + friction * slope > 0.0,
          "1 + friction x the rake's tangent must be above 0, it is " +
              text(1.0 + friction * slope));
  const double ratio = (1.0 + friction * slope) / (friction - slope); // F_c / F_t
  m_resistance = specificEnergy / ratio;
}

AbrasiveWear::AbrasiveWear(double hardness, double wearCoefficient)
{
  require(hardness > 0.0 && std::isfinite(hardness),
          "the hardness must be above 0, it is " + text(hardness) + " Pa");
  require(wearCoefficient > 0.0 && wearCoefficient <= kMaxWearCoefficient,
          "the wear coefficient must lie above 0 and at most at " + text(kMaxWearCoefficient) +
              ", it is " + text(wearCoefficient));
  m_resistance = 3.0 * hardness / wearCoefficient;
}

} // namespace petrous::dissection
