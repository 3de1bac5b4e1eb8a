#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "petrous/Scene/Case.h"
#include "petrous/Scene/Placement.h"

namespace petrous::scene
{

/// All that derived data depend on, as the key that a core::DerivedStore knows them by. There is
/// none where the case has no such store, or a part has no object, which names its content, yet.
class DerivedKey
{
public:
  /// `version` of the method, as its module counts it.
  DerivedKey(const Case& value, const std::string& what, int version);

  void add(const LabelPart& part); ///< its voxels, and where they lie on the CT
  void add(const MeshPart& part);  ///< its surface, and where it lies on the CT
  /// Its voxels as they are in memory, and its grid. Reads them all (0.1 s for 512^3): an image is
  /// mapped, and nobody has held it against its object's hash when it is first used.
  void add(const volume::IntensityVolume& image);
  void add(int number);
  void add(double number); ///< exactly

  const std::optional<std::string>& text() const noexcept { return m_text; }

private:
  void add(const Placement& placement);
  void addObject(const std::string& object);
  void append(const std::string& word);

  const Case& m_case;
  std::optional<std::string> m_text;
};

} // namespace petrous::scene
