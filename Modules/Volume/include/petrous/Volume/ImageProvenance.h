#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/AxesCorrection.h"

namespace petrous::volume
{

/// Text in the pixels, which may name the patient: Burned In Annotation (0028,0301).
enum class BurnedInText
{
  None,      ///< stated, or not stated of an image that gives no reason to suspect it
  Suspected, ///< not stated, of a screenshot, a secondary capture and the like
  Stated
};

/// What is known of the pixels of an image and goes with them.
struct PixelFaults
{
  BurnedInText burnedIn = BurnedInText::None;
  bool isLossy = false;
  std::optional<double> lossyRatio; ///< if stated; > 0
};

/// Slices along the third axis of a grid, from 0, the last included.
struct SliceRange
{
  int first = 0;
  int last = 0;
};
inline bool operator==(const SliceRange& a, const SliceRange& b)
{
  return a.first == b.first && a.last == b.last;
}

/// How an image's voxels are other than what was measured, as its reader and those that changed it
/// later state it. Notes tell the user the same in words, which nothing reads.
struct ImageProvenance
{
  /// Guessed between their neighbours by repair; in order, none next to another.
  std::vector<SliceRange> interpolated;
  int interpolatedBeyond =
      0;              ///< slices that were, of a repaired stack, outside of the region of it
                      ///< that is the image: a stack that lacks them lies apart within it
  double tilt = 0.0;  ///< degrees, of the gantry, undone by repair; 0: none
  double shift = 0.0; ///< mm, the farthest that repair moved a slice sideways, interpolated in its
                      ///< plane; 0: none
  /// Whether the file leaves open which side of the patient is left, and RAS (true) or LPS (false)
  /// axes were taken; nullopt: it states it.
  std::optional<bool> assumedRas;
  /// Of the axes that the file states, as asked; the grid has it. Its inverse gives the file's.
  core::AxesCorrection axes;
  PixelFaults pixels;
  bool isFaceMasked = false;
  bool areEarsMasked = false; ///< with the face, the auricles
  bool isCropped = false;     ///< all outside of a region became air
};

bool contains(const std::vector<SliceRange>& ranges, int slice) noexcept;
int sliceCount(const std::vector<SliceRange>& ranges) noexcept;

/// "3, 7-9", numbered from 1; of more than `most` ranges the first, "and 12 others" (slices) after
/// them. 0: all.
std::string toString(const std::vector<SliceRange>& ranges, std::size_t most = 0);

} // namespace petrous::volume
