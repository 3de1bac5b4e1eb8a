#pragma once

#include <cstdint>
#include <type_traits>

#include "petrous/Dissection/SweptSphereCut.h"

namespace petrous::session
{

/// One repeatable edit of the mask or its history. Fixed layout without padding.
struct MaskEdit
{
  enum class Kind : std::uint64_t
  {
    Begin, ///< opens a stroke
    Cut,
    End, ///< closes the stroke
    Undo,
    Redo
  };

  Kind kind = Kind::Begin;
  std::uint64_t state = 0;          ///< number of the mask state published by this edit
  double from[3] = {0.0, 0.0, 0.0}; ///< of a cut: dissection::SweptSphere, patient mm
  double to[3] = {0.0, 0.0, 0.0};
  double radius = 0.0;   ///< mm
  double duration = 0.0; ///< of an end: duration of the stroke, s

  dissection::SweptSphere burr() const noexcept
  {
    return {{from[0], from[1], from[2]}, {to[0], to[1], to[2]}, radius};
  }
};

static_assert(std::is_trivially_copyable_v<MaskEdit> && sizeof(MaskEdit) == 80);

} // namespace petrous::session
