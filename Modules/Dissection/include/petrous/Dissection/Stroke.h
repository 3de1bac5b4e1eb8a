#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Lazy.h"
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
  std::string name;      ///< in the catalogue; empty: the usual one of its kind. See nameOf
};

/// How fast a burr turned, where that is not its set speed: a pedal's pressure gave it.
struct SpindleSpeed
{
  double mean = 0.0; ///< revolutions per minute, over the time drilling
  double max = 0.0;  ///< revolutions per minute
};

struct TouchedStructure
{
  std::string name;
  double volume = 0.0; ///< mm^3 removed from it
};

/// Metadata of a stroke (drill on to drill off), without its voxels.
struct StrokeInfo
{
  std::string startedAt; ///< UTC, ISO 8601; empty: not known
  double duration = 0.0; ///< s, of simulated time
  Burr burr;
  /// nullopt: no pedal set it, so that the burr turned at its set speed, or it is not known.
  std::optional<SpindleSpeed> speed;
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

/// A stroke of a history. Its metadata are always there, its voxels are read when they are needed.
struct Stroke
{
  using Voxels = std::vector<std::uint8_t>; ///< encoded, see StrokeCodec.h

  Stroke() = default;
  Stroke(StrokeInfo i, Voxels encoded)
    : info(std::move(i))
    , bytes(encoded.size())
    , packed(std::make_shared<const Voxels>(std::move(encoded)))
  {
  }

  StrokeInfo info;
  std::string object;        ///< name of the stored voxels; empty: not stored
  std::size_t bytes = 0;     ///< size of the encoded voxels
  core::Lazy<Voxels> packed; ///< throws what reading them throws
};

} // namespace petrous::dissection
