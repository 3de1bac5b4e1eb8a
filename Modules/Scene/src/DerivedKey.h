#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "petrous/Scene/Case.h"
#include "petrous/Scene/Placement.h"

namespace petrous::scene
{

/// Key of derived data in a core::DerivedStore, made of everything they depend on. There is no key
/// if the case has no such store, or if a part has no object name, which identifies its content,
/// yet.
class DerivedKey
{
public:
  /// `version` of the algorithm, as counted by its module.
  DerivedKey(const Case& value, const std::string& what, int version);

  void add(const LabelPart& part); ///< its voxels and their position in CT space
  void add(const MeshPart& part);  ///< its surface and its position in CT space
  /// Its grid and its voxels in memory. Reads all voxels (0.1 s for 512^3): an image is
  /// memory-mapped, and not yet verified against its object's hash when first used.
  void add(const volume::IntensityVolume& image);
  void add(int number);
  void add(double number); ///< bit-exact

  const std::optional<std::string>& text() const noexcept { return m_text; }

private:
  void add(const Placement& placement);
  void addObject(const std::string& object);
  void append(const std::string& word);

  const Case& m_case;
  std::optional<std::string> m_text;
};

} // namespace petrous::scene
