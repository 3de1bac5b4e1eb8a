#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Volume/CutMask.h"

namespace petrous::dissection
{

/// The tool at the end of the spindle.
struct Burr
{
  enum class Kind
  {
    Cutting,
    Diamond
  };
  Kind kind = Kind::Cutting;
  double diameter = 4.0; ///< mm
  double rpm = 60000.0;  ///< spindle speed, turns a minute
};

struct TouchedStructure
{
  std::string name;
  double volume = 0.0; ///< mm^3 removed of it
};

/// What a stroke (drill on to drill off) was, apart from its voxels.
struct StrokeInfo
{
  std::string startedAt; ///< UTC, ISO 8601
  double duration = 0.0; ///< s, of simulated time
  Burr burr;
  double removed = 0.0; ///< mm^3 lost from {f > 0}
  std::vector<TouchedStructure> structures;
  std::optional<core::CameraPose> camera; ///< from where it was drilled
  /// It was open when the program ended without closing it: what is there came from the journal.
  bool recovered = false;
};

/// A brick before and after; null stands for all untouched.
struct BrickDelta
{
  std::size_t brick = 0;
  volume::CutMask::BrickVersion before;
  volume::CutMask::BrickVersion after;
};

struct Stroke
{
  StrokeInfo info;
  std::vector<std::uint8_t> packed; ///< its voxels, see StrokeCodec.h
};

} // namespace petrous::dissection
