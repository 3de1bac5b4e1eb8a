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

/// The tool tip.
struct Burr
{
  enum class Kind
  {
    Cutting,
    Diamond
  };
  Kind kind = Kind::Cutting;
  double diameter = 4.0; ///< mm
  double rpm = 60000.0;  ///< spindle speed, revolutions per minute
};

struct TouchedStructure
{
  std::string name;
  double volume = 0.0; ///< mm^3 removed from it
};

/// Metadata of a stroke (drill on to drill off), without its voxels.
struct StrokeInfo
{
  std::string startedAt; ///< UTC, ISO 8601
  double duration = 0.0; ///< s, of simulated time
  Burr burr;
  double removed = 0.0; ///< mm^3 removed from {f > 0}
  std::vector<TouchedStructure> structures;
  std::optional<core::CameraPose> camera; ///< view during drilling
  /// Recovered from the journal: the program ended while the stroke was open.
  bool recovered = false;
};

/// A brick before and after; nullptr stands for all untouched.
struct BrickDelta
{
  std::size_t brick = 0;
  volume::CutMask::BrickVersion before;
  volume::CutMask::BrickVersion after;
};

struct Stroke
{
  StrokeInfo info;
  std::vector<std::uint8_t> packed; ///< encoded voxels, see StrokeCodec.h
};

} // namespace petrous::dissection
