#include "petrous/Phantom/Phantom.h"

#include <cmath>

#include "PhantomScene.h"

namespace petrous::phantom
{
namespace
{

bool mayMeet(const shapes::Box& a, const shapes::Box& b)
{
  return a.intersects(b);
}

} // namespace

ScanGrid::ScanGrid(const core::GridGeometry& geometry)
  : dims(geometry.dims())
  , origin(geometry.origin())
  , step(geometry.patientFromVoxelLinear())
{
}

Phantom::Phantom(const PhantomRecipe& recipe)
  : m_recipe(recipe)
{
  auto scene = std::make_unique<Scene>();
  scene->layers = anatomy::paint(recipe.seed, recipe.cholesteatoma);
  scene->cranial = anatomy::makeSkull().cranial;
  for (std::size_t l = 0; l < scene->layers.size(); ++l)
  {
    const anatomy::Layer& layer = scene->layers[l];
    if (layer.name.empty())
      continue;
    std::vector<std::size_t> over;
    for (std::size_t later = l + 1; later < scene->layers.size(); ++later)
      if (mayMeet(layer.shape.box, scene->layers[later].shape.box))
        over.push_back(later);
    scene->layerOf.push_back(l);
    scene->coverers.push_back(std::move(over));
    m_structures.push_back({layer.name, layer.color, layer.solid, layer.mesh > 0.0, layer.ct,
                            layer.shape.box.min(), layer.shape.box.max()});
  }
  m_scene = std::move(scene);
}

Phantom::~Phantom() = default;
Phantom::Phantom(Phantom&&) noexcept = default;
Phantom& Phantom::operator=(Phantom&&) noexcept = default;

Eigen::Vector3d Phantom::center() noexcept
{
  return {-36.0, 3.0, 0.0};
}

Eigen::Vector3d Phantom::extent() noexcept
{
  return {66.0, 66.0, 60.0};
}

std::vector<AxisPoint> Phantom::facialCanalAxis()
{
  std::vector<AxisPoint> axis;
  for (const shapes::Knot& knot : anatomy::facialCanalAxis())
    axis.push_back({knot.center, knot.radius});
  return axis;
}

double Phantom::hounsfield(const Eigen::Vector3d& patient) const
{
  return m_scene->look(patient, 0.0, Modality::Ct, m_scene->stackAround(patient, 0.0));
}

double Phantom::mrIntensity(const Eigen::Vector3d& patient) const
{
  return m_scene->look(patient, 0.0, Modality::Mr, m_scene->stackAround(patient, 0.0));
}

std::size_t Phantom::indexOf(const std::string& name) const
{
  for (std::size_t s = 0; s < m_structures.size(); ++s)
    if (m_structures[s].name == name)
      return s;
  throw core::InvalidParameter("phantom: there is no structure '" + name + "'");
}

double Phantom::signedDistance(std::size_t structure, const Eigen::Vector3d& patient) const
{
  return m_scene->distance(structure, patient);
}

double Phantom::signedDistance(const std::string& name, const Eigen::Vector3d& patient) const
{
  return m_scene->distance(indexOf(name), patient);
}

double Phantom::distanceToCranialCavity(const Eigen::Vector3d& patient) const
{
  return m_scene->cranial(patient);
}

core::RigidTransform Phantom::mrFromCt() const
{
  // 4 to 6 degrees about an oblique axis through the ear, then about 8 mm.
  const auto wobble = [this](std::uint64_t counter)
  { return 2.0 * shapes::uniform(m_recipe.seed ^ 0x4D52ULL, counter) - 1.0; };
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  const Eigen::Vector3d axis =
      Eigen::Vector3d(0.40 + 0.1 * wobble(0), -0.55 + 0.1 * wobble(1), 0.73).normalized();
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd((5.0 + wobble(2)) * kDegree, axis));
  const Eigen::Vector3d shift(6.0 + wobble(3), -4.0 + wobble(4), 3.0 + wobble(5));
  return {rotation, center() + shift - rotation * center()};
}

Phantom::Scene::Stack Phantom::Scene::stackAround(const shapes::Point& center, double reach,
                                                  const Stack* among, std::size_t lowest) const
{
  // Signed distances may exceed the true distance to a border, at most by these factors.
  constexpr double kOutside = 1.3;
  constexpr double kInside = 2.1;
  Stack stack;
  const auto covers = [&](std::size_t l)
  {
    if (layers[l].shape.box.squaredExteriorDistance(center) > reach * reach)
      return false;
    const double d = layers[l].shape(center);
    if (d < -kInside * reach)
      return true;
    if (d <= kOutside * reach)
      stack.layers.push_back(l);
    return false;
  };
  if (among)
  {
    stack.base = among->base;
    for (const std::size_t l : among->layers)
      if (covers(l))
      {
        stack.base = static_cast<int>(l);
        break;
      }
    return stack;
  }
  for (std::size_t l = layers.size(); l-- > lowest;)
    if (covers(l))
    {
      stack.base = static_cast<int>(l);
      break;
    }
  return stack;
}

double Phantom::Scene::distance(std::size_t structure, const shapes::Point& p) const
{
  double d = layers[layerOf[structure]].shape(p);
  for (const std::size_t over : coverers[structure])
  {
    // A cover whose box is farther than our depth cannot decide.
    const double slack = std::max(-d, 0.0);
    if (layers[over].shape.box.squaredExteriorDistance(p) <= slack * slack)
      d = std::max(d, -layers[over].shape(p));
  }
  return d;
}

} // namespace petrous::phantom
