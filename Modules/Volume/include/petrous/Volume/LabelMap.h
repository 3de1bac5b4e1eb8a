#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// One structure of a label map.
struct Segment
{
  std::string name;
  std::uint16_t index = 0;      ///< its voxel value, >= 1
  std::array<float, 3> color{}; ///< 0 to 1; black if the file has none
  std::uint64_t voxels = 0;     ///< number of voxels with this index
};

/// Segmentation on its own grid (which need not be the CT's): voxel value 0 is background, each
/// other value is one segment. Segments of one map do not overlap.
struct LabelMap
{
  std::shared_ptr<const Volume<std::uint16_t>> voxels;
  std::vector<Segment> segments; ///< sorted by index

  /// All voxels outside this box are 0; nullopt: not known.
  std::optional<core::IndexBox> extent = std::nullopt;

  double volume(const Segment& segment) const ///< mm^3, voxel count times voxel volume
  {
    return static_cast<double>(segment.voxels) * voxels->geometry().voxelVolume();
  }
};

/// Calls visit(i, label) for the nonzero labels of a row.
template <class Visit>
void forEachLabel(const std::uint16_t* row, int count, const Visit& visit)
{
  constexpr int kWord = 4; // labels compared with zero at once
  for (int i = 0; i < count;)
  {
    std::uint64_t word = 1;
    if (i + kWord <= count)
      std::memcpy(&word, row + i, sizeof(word));
    if (word == 0)
    {
      i += kWord;
      continue;
    }
    for (const int end = std::min(i + kWord, count); i < end; ++i)
      if (row[i] != 0)
        visit(i, row[i]);
  }
}

/// The box outside which all voxels are certainly 0.
core::IndexBox extentOf(const LabelMap& labels);

/// Counts voxels, and finds their extent; segments without an entry in `names` are called "label
/// N". Entries of `names` without voxels are kept. Throws InvalidParameter if an index in `names`
/// is 0 or occurs twice.
LabelMap makeLabelMap(std::shared_ptr<const Volume<std::uint16_t>> voxels,
                      std::vector<Segment> names);

/// Bounding box of each segment's voxels, in the order of `segments`; empty for segments without
/// voxels. One pass over all voxels (about 0.1 s for 512^3).
std::vector<core::IndexBox> boxesOf(const LabelMap& labels);

} // namespace petrous::volume
