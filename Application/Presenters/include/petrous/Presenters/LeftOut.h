#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// Structures of a case that are missing or damaged on the disk: empty in the case, so that the
/// others can be used.
struct LeftOut
{
  template <class T>
  struct Part
  {
    std::size_t index = 0; ///< into the case's labels or meshes
    std::string why;       ///< one sentence
    core::Lazy<T> whole;   ///< as the library has it
  };
  std::vector<Part<volume::LabelMap>> labels;
  std::vector<Part<core::TriangleMesh>> meshes;

  bool empty() const noexcept { return labels.empty() && meshes.empty(); }
  std::vector<std::string> sentences() const;

  /// For another copy of the case.
  void takeOut(scene::Case& value) const;
  /// Before a save: an empty part must not replace what is on the disk.
  void putBack(scene::Case& value) const;
};

/// Reads the structures of a case, and leaves out those that cannot be read. Throws CancelledError.
LeftOut leaveOutDamaged(scene::Case& value, const core::Progress& progress = {});

} // namespace petrous::presenters
