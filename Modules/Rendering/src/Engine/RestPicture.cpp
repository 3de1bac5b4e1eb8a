#include "RestPicture.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <tuple>

#include "petrous/Rendering/PixelSamples.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{

constexpr int kCell = 64; // px; a software renderer gives each its own thread

bool sameView(const RayView& a, const RayView& b)
{
  const auto parts = [](const RayView& v)
  {
    return std::tie(v.origin, v.originX, v.originY, v.direction, v.directionX, v.directionY,
                    v.depth, v.parallel);
  };
  return parts(a) == parts(b);
}

bool sameQuality(const RenderQuality& a, const RenderQuality& b)
{
  const auto parts = [](const RenderQuality& q)
  {
    return std::tie(q.step, q.bisections, q.brick, q.termination, q.tableSize, q.maskBits,
                    q.imageScale, q.largestTexture, q.filterBits, q.exactSamples);
  };
  return parts(a) == parts(b);
}

bool samePicture(const RestPicture::Key& a, const RestPicture::Key& b)
{
  return a.width == b.width && a.height == b.height && a.contents == b.contents &&
         a.opaque == b.opaque && a.lamp == b.lamp && a.focus == b.focus &&
         sameQuality(a.quality, b.quality) && sameView(a.view, b.view);
}

/// The rays through another place of each pixel, which is `right` and `down` of its centre.
RayCaster::Frame throughPlace(RayCaster::Frame frame, double right, double down)
{
  const double x = 2.0 * right / frame.width;
  const double y = -2.0 * down / frame.height;
  frame.view.origin += x * frame.view.originX + y * frame.view.originY;
  frame.view.direction += x * frame.view.directionX + y * frame.view.directionY;
  return frame;
}

double elapsedSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

} // namespace

bool RestPicture::shows(const Key& key) const
{
  return m_shown > 0 && m_key && samePicture(*m_key, key);
}

void RestPicture::begin(const Key& key, const RayCaster::Frame& frame)
{
  const bool isSame = m_key && samePicture(*m_key, key);
  m_frame = frame; // its depth texture may be another
  m_frame.fovea.reset();
  if (isSame)
    return;
  m_key = key;
  m_drawn = m_shown = 0;
  m_next = -1;
  m_milliseconds = 0.0;
  m_dearest *= 0.5; // the machine may have been busy
}

bool RestPicture::remains(std::uint64_t contents, int samples) const
{
  return m_key && m_key->contents == contents && m_drawn <= (samples > 1 ? samples : 0);
}

Refinement RestPicture::advance(RayCaster& caster, double milliseconds, int samples)
{
  if (!remains(caster.changes(), samples))
    return Refinement::Done;
  const auto start = std::chrono::steady_clock::now();
  (m_drawn == 0 ? m_picture : m_scratch).prepare(m_key->width, m_key->height, false);
  glViewport(0, 0, m_key->width, m_key->height);
  const bool isWhole = drawCells(caster, milliseconds);
  if (m_drawn == 0)
    m_milliseconds += elapsedSince(start);
  if (!isWhole)
    return Refinement::More;
  m_next = -1;
  ++m_drawn;
  if (m_drawn == 1)
  {
    m_shown = 1;
    return Refinement::Better;
  }
  add(caster);
  const int taken = m_drawn - 1;
  if (taken != 4 && taken != 8 && taken != kPixelSamples)
    return Refinement::More;
  show(caster);
  return Refinement::Better;
}

// True: all cells of the sample are drawn.
bool RestPicture::drawCells(RayCaster& caster, double milliseconds)
{
  RayCaster::Frame frame = m_frame;
  if (m_drawn > 0)
  {
    const auto [right, down] = pixelSample(m_drawn - 1);
    frame = throughPlace(m_frame, right, down);
    frame.sample = m_drawn - 1;
  }
  const core::IndexBox whole{{0, 0, 0}, {m_key->width, m_key->height, 1}};
  if (m_next < 0)
  {
    (m_drawn == 0 ? m_picture : m_scratch).clear(whole);
    const core::IndexBox part = caster.tissueOnScreen(frame, m_key->width, m_key->height);
    m_cells = {};
    if (!part.empty())
      m_cells = {{part.lower[0] / kCell, part.lower[1] / kCell, 0},
                 {(part.upper[0] - 1) / kCell + 1, (part.upper[1] - 1) / kCell + 1, 1}};
    m_next = 0;
  }
  const auto count = static_cast<int>(m_cells.count());
  const int columns = m_cells.size()[0];
  const auto start = std::chrono::steady_clock::now();
  double taken = 0.0;
  // The first parts of a picture tell the time of a cell.
  while (m_next < count && (taken == 0.0 || taken + m_perCell < milliseconds))
  {
    const int column = m_next % columns;
    const int row = m_next / columns;
    // As many as fit, if they cost as the last did; not twice the time, if as the dearest.
    const double fit = m_dearest > 0.0 ? std::min((milliseconds - taken) / m_perCell,
                                                  2.0 * milliseconds / m_dearest)
                                       : 2.0;
    const int run = std::clamp(static_cast<int>(std::min(fit, 1e6)), 1, columns - column);
    const int x = (m_cells.lower[0] + column) * kCell;
    const int y = (m_cells.lower[1] + row) * kCell;
    const core::IndexBox cells{{x, y, 0}, {x + run * kCell, y + kCell, 1}};
    caster.drawPart(frame, m_key->quality, cells.intersected(whole));
    glFinish();
    const double now = elapsedSince(start);
    const double perCell = (now - taken) / run;
    m_perCell = std::max(perCell, 0.5 * (m_perCell + perCell)); // soon longer, slowly shorter
    m_dearest = std::max(m_dearest, perCell);
    taken = now;
    m_next += run;
  }
  return m_next >= count;
}

void RestPicture::add(RayCaster& caster)
{
  const int width = m_key->width;
  const int height = m_key->height;
  if (!m_sumFramebuffer)
    glGenFramebuffers(1, &m_sumFramebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, m_sumFramebuffer);
  if (m_sum.dims()[0] != width || m_sum.dims()[1] != height)
  {
    m_sum.create(texel::kFloat4, width, height, nullptr, GL_NEAREST);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, m_sum.name(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw RenderingError(RenderingError::Reason::NoOpenGL,
                           "the graphics driver adds no pictures in 32-bit colour");
  }
  const bool isFirst = m_drawn == 2;
  if (!isFirst)
  {
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
  }
  caster.copy(m_scratch.color(), 1.0);
  if (!isFirst)
    glDisable(GL_BLEND);
}

void RestPicture::show(RayCaster& caster)
{
  const int taken = m_drawn - 1;
  m_picture.bindColor();
  caster.copy(m_sum, 1.0 / taken);
  m_shown = taken;
}

void RestPicture::release()
{
  m_key.reset();
  m_drawn = m_shown = 0;
  m_picture.release();
  m_scratch.release();
  m_sum.release();
  if (m_sumFramebuffer)
    glDeleteFramebuffers(1, &m_sumFramebuffer);
  m_sumFramebuffer = 0;
}

} // namespace petrous::rendering
