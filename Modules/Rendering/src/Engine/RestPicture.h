#pragma once

#include <cstdint>
#include <optional>

#include "RayCaster.h"

namespace petrous::rendering
{

/// The volume's picture at full quality, drawn in parts so short that a window stays responsive:
/// first through the centres of the pixels, equal to the bit to what RayCaster::draw draws; then
/// through their kPixelSamples other places, whose mean replaces it after 4, 8 and all of them.
/// Depth stays that of the centres.
///
/// All calls but `shows` need the ray caster's context.
class RestPicture
{
public:
  /// What the picture depends on.
  struct Key
  {
    RayView view;
    int width = 0;
    int height = 0;
    std::uint64_t contents = 0; ///< RayCaster::changes
    std::uint64_t opaque = 0;   ///< of the polygons at which rays end
    RenderQuality quality;
    std::optional<Eigen::Vector3d> lamp = std::nullopt; ///< of shadows
    double focus = 0.0; ///< mm to the focal point, if the light has a falloff
  };

  /// Samples a pixel of the picture that can be shown: 0 (none yet), 1, 4, 8 or 16.
  int samples() const noexcept { return m_shown; }
  /// Whether it is the picture of `key`, and can be shown.
  bool shows(const Key& key) const;

  /// Begins with another picture, unless it is that of `key` already. The frame's depth texture
  /// must stay as it is.
  void begin(const Key& key, const RayCaster::Frame& frame);
  void drop() { m_key.reset(); }

  /// Whether something is to be drawn: less than `samples` are, and the scene is as it was.
  bool remains(std::uint64_t contents, int samples) const;
  /// Draws for about `milliseconds`, at least one part. Better: `samples()` is another.
  Refinement advance(RayCaster& caster, double milliseconds, int samples);
  int drawn() const noexcept { return m_drawn; } ///< whole samples, also of such not yet shown

  const RayTarget& target() const noexcept { return m_picture; }
  double milliseconds() const noexcept { return m_milliseconds; } ///< of the centres
  void release();

private:
  bool drawCells(RayCaster& caster, double milliseconds);
  void add(RayCaster& caster);
  void show(RayCaster& caster);

  std::optional<Key> m_key;
  RayCaster::Frame m_frame;
  RayTarget m_picture, m_scratch;
  GlTexture m_sum;
  GLuint m_sumFramebuffer = 0;
  int m_drawn = 0; // whole samples; the first through the centres
  int m_shown = 0;
  core::IndexBox m_cells; // that may meet tissue, of the sample that is drawn
  int m_next = -1;        // cell of m_cells; -1: the sample has not begun
  double m_perCell = 0.0; // ms, of the last parts
  double m_dearest = 0.0; // the most of them
  double m_milliseconds = 0.0;
};

} // namespace petrous::rendering
