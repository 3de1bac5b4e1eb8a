#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace petrous::rendering
{

/// What a picture costs and how near it comes to the reference. The defaults are those that
/// Documentation/benchmarks argues for.
struct RenderQuality
{
  double step = 0.5;         ///< between samples, in smallest spacings of the CT, 0.05 to 100
  int bisections = 8;        ///< of a step, where false position fails; 0 to 24
  int brick = 4;             ///< edge of a brick that can be skipped, voxels: 4, 8 or 16
  double termination = 0.01; ///< a ray ends when less of what is behind comes through, and takes
                             ///< that for what it saw before, in the mean; 0 to 1
  int tableSize = 1024;      ///< intensities of a pre-integrated table; 16 to 4096
  int maskBits = 16;         ///< of the cut on the graphics card: 8 or 16
  double imageScale = 1.0;   ///< samples per pixel along each axis, 0.1 to 1
  int largestTexture = 0;    ///< texels along an edge of a volume; 0: what the driver takes

  /// Throws InvalidParameter naming the first value that is out of its range.
  void validate() const;
};

/// What the last frame did.
struct RenderStatistics
{
  std::vector<std::string> variant;             ///< features that the shader was compiled with
  std::map<std::string, std::size_t> resources; ///< bytes on the graphics card by name
  std::vector<std::string> notes; ///< what was reduced because the driver has no room, in words
  double fetchesPerPixel = 0.0;   ///< of the last counted frame, over all of its pixels
  double samplesPerPixel = 0.0;
  double editMilliseconds = 0.0; ///< bringing the last edits of the mask to the card
  std::size_t pendingEdits = 0;  ///< voxels of edits left for the next frames by the cap
};

} // namespace petrous::rendering
