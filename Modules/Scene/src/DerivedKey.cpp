#include "DerivedKey.h"

#include <cstdio>
#include <cstring>
#include <type_traits>

#include "petrous/Core/Fingerprint.h"

namespace petrous::scene
{

DerivedKey::DerivedKey(const Case& value, const std::string& what, int version)
  : m_case(value)
{
  if (value.derived)
    m_text = what + " " + std::to_string(version);
}

void DerivedKey::append(const std::string& word)
{
  if (m_text)
    *m_text += " " + word;
}

void DerivedKey::addObject(const std::string& object)
{
  if (object.empty())
    m_text.reset();
  append(object);
}

void DerivedKey::add(const Placement& placement)
{
  if (placement.drawnOn.empty())
    return;
  append("moved");
  for (Eigen::Index n = 0; n < 4; ++n)
    add(placement.mrFromCt.rotation().coeffs()[n]);
  for (Eigen::Index n = 0; n < 3; ++n)
    add(placement.mrFromCt.translation()[n]);
}

void DerivedKey::add(const LabelPart& part)
{
  addObject(part.object);
  add(placementOf(m_case, part));
}

void DerivedKey::add(const MeshPart& part)
{
  addObject(part.object);
  add(placementOf(m_case, part));
}

void DerivedKey::add(const volume::IntensityVolume& image)
{
  if (!m_text)
    return;
  core::Fingerprint print;
  const core::GridGeometry& grid = image.geometry();
  for (int axis = 0; axis < 3; ++axis)
  {
    print.add(grid.dims()[static_cast<std::size_t>(axis)]);
    print.add(grid.spacing()[axis]);
    print.add(grid.origin()[axis]);
    for (int row = 0; row < 3; ++row)
      print.add(grid.direction()(row, axis));
  }
  image.visit(
      [&print](const auto& volume)
      {
        using Voxel = std::decay_t<decltype(*volume.data())>;
        print.add(sizeof(Voxel));
        print.add(std::is_signed_v<Voxel>);
        print.add(std::is_floating_point_v<Voxel>);
        print.add(volume.data(), volume.bytes());
      });
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(print.value()));
  append(text);
}

void DerivedKey::add(int number)
{
  append(std::to_string(number));
}

void DerivedKey::add(double number)
{
  std::uint64_t bits;
  static_assert(sizeof bits == sizeof number);
  std::memcpy(&bits, &number, sizeof bits);
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(bits));
  append(text);
}

} // namespace petrous::scene
