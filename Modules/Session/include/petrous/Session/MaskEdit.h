#pragma once

#include <cstdint>
#include <cstring>
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
  double radius = 0.0; ///< mm
  /// Of an end: duration of the stroke, s. Of a redo the bits of the mask's fingerprint.
  double duration = 0.0;

  /// Of a redo: fingerprintOf the mask after it, which tells the stroke that was redone; 0: not
  /// known, as in recordings of older programs.
  std::uint64_t redone() const noexcept
  {
    std::uint64_t print = 0;
    std::memcpy(&print, &duration, sizeof print);
    return print;
  }
  void setRedone(std::uint64_t print) noexcept { std::memcpy(&duration, &print, sizeof print); }

  dissection::SweptSphere burr() const noexcept
  {
    return {{from[0], from[1], from[2]}, {to[0], to[1], to[2]}, radius};
  }
};

static_assert(std::is_trivially_copyable_v<MaskEdit> && sizeof(MaskEdit) == 80);

} // namespace petrous::session
