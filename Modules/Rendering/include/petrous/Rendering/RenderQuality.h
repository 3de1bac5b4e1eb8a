#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace petrous::rendering
{

/// Trade-off between cost and agreement with the reference. For the choice of defaults see
/// Documentation/benchmarks.
struct RenderQuality
{
  double step = 0.5;  ///< sampling distance in units of the smallest CT spacing, 0.05 to 100
  int bisections = 8; ///< per step, where false position fails; 0 to 24
  int brick = 4;      ///< edge length of a skippable brick, voxels: 4, 8 or 16
  /// Transmittance at which a ray terminates (0 to 1); the rest takes the mean colour so far
  double termination = 0.01;
  int tableSize = 1024;    ///< entries of a pre-integrated table; 16 to 4096
  int maskBits = 16;       ///< of the cut mask on the GPU: 8 or 16
  double imageScale = 1.0; ///< samples per pixel along each axis, 0.1 to 1
  int largestTexture = 0;  ///< max. texels along an edge of a volume; 0: driver's limit
  /// Bits of the weights with which the card filters volumes: 0, as measured; 4 to 15, rounded so
  /// (to try on one card what another does); kExactFilterBits, taken for exact.
  int filterBits = 0;
  static constexpr int kExactFilterBits = 16;
  /// Where the card's filter rounds, samples along rays come from an exact one, too, not only
  /// surfaces and their slopes.
  bool exactSamples = true;

  /// Throws InvalidParameter naming the first value out of range.
  void validate() const;
};

/// How the picture at rest goes on (ScenePicture::refine).
enum class Refinement
{
  Done,  ///< nothing remains to be drawn
  More,  ///< to be called again
  Better ///< to be called again, and another frame shows a better picture
};

/// Statistics of the last frame.
struct RenderStatistics
{
  std::vector<std::string> variant; ///< features the shader was compiled with
  int filterBits = 0; ///< of the card's filter weights; below kExactFilterBits, an exact filter
                      ///< of our own takes its place. 0: nothing was drawn
  std::map<std::string, std::size_t> resources; ///< GPU memory in bytes, by name
  std::vector<std::string> notes; ///< descriptions of what was reduced to fit the driver's limits
  double fetchesPerPixel = 0.0;   ///< of the last counted frame, averaged over all its pixels
  double samplesPerPixel = 0.0;
  double editMilliseconds = 0.0; ///< upload of the last mask edits to the GPU
  std::size_t pendingEdits = 0;  ///< voxels of edits that the upload cap deferred to later frames
  /// The instrument's shadow is being measured (ScenePicture::setProgressive) and missing, or has
  /// come during the frame; a later one shows it.
  bool pendingShadow = false;
  /// Times so far that all of what stops the light was measured anew; of shadows alone.
  std::size_t opacityRebuilds = 0;
};

/// Adapts picture quality during interaction to reach a target frame rate: fewer samples per pixel
/// and, below half of them, longer steps as well. Opacity is per millimetre, so brightness does not
/// change.
///
/// Learns from measured frame times: for a given step, the time of a volume grows with its number
/// of pixels. Pure computation.
class InteractionQuality
{
public:
  static constexpr double kSmallestScale = 0.15; ///< relative to the picture's edge
  static constexpr double kMaxStep = 1.0;        ///< voxels

  /// Throws InvalidParameter unless 1 <= hz <= 240.
  explicit InteractionQuality(double hz = 30.0);

  double wantedRate() const noexcept { return m_hz; }

  /// Quality of the next frame during interaction.
  RenderQuality coarser(const RenderQuality& full) const noexcept;

  /// A frame with a part, such as that around a burr, drawn finer than the rest.
  struct Foveated
  {
    RenderQuality rest;
    RenderQuality fovea;
    double area = 0.0; ///< of the finer part, fraction of the picture; at most what was wanted
  };
  static constexpr double kFoveaScale = 0.6; ///< at least, relative to the picture's edge

  /// Quality of the next frame during interaction with a finer part of `area`, a fraction of the
  /// picture. That part has up to kFoveaShare of the time; where even kFoveaScale is too dear, it
  /// becomes smaller, but not below a quarter. nullopt: the whole is as fine.
  std::optional<Foveated> foveated(const RenderQuality& full, double area) const noexcept;
  static constexpr double kFoveaShare = 0.6; ///< of the frame time

  /// Cost of a picture relative to one of scale 1 with kMaxStep.
  static double workOf(const RenderQuality& quality) noexcept;
  static double workOf(const Foveated& frame) noexcept;

  /// Reports the time in ms of a frame drawn with `quality`. Times <= 0 are ignored.
  void frameTook(double milliseconds, const RenderQuality& quality) noexcept;
  void frameTook(double milliseconds, double work) noexcept; ///< see workOf

  bool knows() const noexcept { return m_cost > 0.0; } ///< the time of a frame

private:
  RenderQuality fitted(const RenderQuality& full, double budget) const noexcept;

  double m_hz;
  double m_cost = 0.0; // ms for a picture of scale 1 with kMaxStep, smoothed; 0: unknown
};

} // namespace petrous::rendering
