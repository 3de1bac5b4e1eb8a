#include "petrous/Interaction/ForceDisplay.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <vtkActor.h>
#include <vtkRenderer.h>

#include "ForceArrow.h"
#include "ForceBar.h"
#include "petrous/Core/Error.h"

namespace petrous::interaction
{

namespace
{

using Eigen::Vector3d;

void check(bool holds, const char* what)
{
  if (!holds)
    throw core::InvalidParameter(std::string("force display: ") + what);
}

bool within(double value, double least, double most)
{
  return value >= least && value <= most; // false for NaN
}

const ForceLook& checked(const ForceLook& look)
{
  check(look.millimetresPerNewton > 0.0 && look.millimetresPerNewton <= 1000.0,
        "the arrow's length must lie within 0 to 1000 mm/N");
  check(within(look.fullScale, 0.1, 1000.0), "the full scale must lie within 0.1 to 1000 N");
  check(within(look.least, 0.0, 1000.0), "the least force shown must not be below 0 N");
  check(look.thickness > 0.0 && look.thickness <= 20.0,
        "the arrow's thickness must lie within 0 to 20 mm");
  check(within(look.pixels, 0.25, 8.0), "the bar's pixels must lie within 0.25 to 8");
  return look;
}

// Light work, a surgeon's usual upper bound (2 N), too much (5 N). The three also differ in
// lightness, for red-green colour-blind users.
Vector3d colorOf(double force)
{
  const Vector3d light(0.45, 0.88, 0.92);
  const Vector3d usual(0.98, 0.74, 0.20);
  const Vector3d strong(0.86, 0.16, 0.12);
  if (force <= 2.0)
    return light + 0.5 * force * (usual - light);
  return usual + std::min((force - 2.0) / 3.0, 1.0) * (strong - usual);
}

Vector3d forceIn(const session::TickRecord& record)
{
  using Parameters = session::ServoParameters;
  const auto& set = record.input.parameters;
  // Forces on a hovering pointer's tool are not forces on the hand.
  const bool hovers = (set.constantThrust & Parameters::kPointer) != 0 &&
                      (set.constantThrust & Parameters::kPressed) == 0;
  const bool given = record.fault == 0 && !set.pause && !hovers;
  const Vector3d force = record.wrench.wrench().linear;
  return given && force.allFinite() ? force : Vector3d(Vector3d::Zero());
}

} // namespace

class ForceDisplay::Implementation
{
public:
  void show()
  {
    const double size = force.norm();
    const Vector3d color = colorOf(size);
    bar.show(size, look.fullScale, look.pixels, color);
    if (!arrowShown || size < look.least || size == 0.0)
      return arrow.hide();
    const double length = look.millimetresPerNewton * std::min(size, look.fullScale);
    arrow.show(place, length / size * force, look.thickness, color);
  }

  ForceLook look;
  ForceArrow arrow;
  ForceBar bar;
  Vector3d force{0.0, 0.0, 0.0}; // N
  Vector3d place{0.0, 0.0, 0.0};
  bool arrowShown = true;
};

ForceDisplay::ForceDisplay(const ForceLook& look)
  : m_implementation(std::make_unique<Implementation>())
{
  setLook(look);
}

ForceDisplay::~ForceDisplay() = default;

void ForceDisplay::addTo(vtkRenderer* renderer) const
{
  renderer->AddViewProp(m_implementation->arrow.actor());
  m_implementation->bar.addTo(renderer);
}

void ForceDisplay::removeFrom(vtkRenderer* renderer) const
{
  renderer->RemoveViewProp(m_implementation->arrow.actor());
  m_implementation->bar.removeFrom(renderer);
}

void ForceDisplay::setLook(const ForceLook& look)
{
  m_implementation->look = checked(look);
  m_implementation->show();
}

void ForceDisplay::setArrowShown(bool shown)
{
  m_implementation->arrowShown = shown;
  m_implementation->show();
}

void ForceDisplay::setBarShown(bool shown)
{
  m_implementation->bar.setShown(shown);
}

void ForceDisplay::update(const session::TickRecord& record)
{
  m_implementation->force = forceIn(record);
  m_implementation->place = record.proxy.pose().position;
  m_implementation->show();
}

double ForceDisplay::force() const noexcept
{
  return m_implementation->force.norm();
}

} // namespace petrous::interaction
