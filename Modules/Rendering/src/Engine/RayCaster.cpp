#include "RayCaster.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "CardFilter.h"
#include "PresentShader.h"
#include "RayCastVertexShader.h"
#include "SceneCheck.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/ToolShape.h"

namespace petrous::rendering
{

void RayTarget::prepare(int width, int height, bool count)
{
  const std::array<GLenum, 3> buffers{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                      GL_COLOR_ATTACHMENT2};
  if (m_framebuffer && m_color.dims()[0] == width && m_color.dims()[1] == height &&
      m_counting == count)
  {
    glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
    glDrawBuffers(count ? 3 : 2, buffers.data());
    return;
  }
  m_color.create(texel::kColor, width, height, nullptr, GL_LINEAR);
  m_depth.create(texel::kFloat, width, height, nullptr, GL_NEAREST);
  if (count)
    m_count.create(texel::kFloat2, width, height, nullptr, GL_NEAREST);
  else
    m_count.release();
  m_counting = count;
  if (!m_framebuffer)
    glGenFramebuffers(1, &m_framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, m_color.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, m_depth.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT2, GL_TEXTURE_2D,
                         count ? m_count.name() : 0, 0);
  glDrawBuffers(count ? 3 : 2, buffers.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw RenderingError(RenderingError::Reason::NoOpenGL,
                         "the graphics driver draws no picture of " + std::to_string(width) +
                             " x " + std::to_string(height) + " in 16-bit colour");
}

std::array<double, 2> RayTarget::meanCounts() const
{
  const core::Index3& size = m_count.dims();
  const std::size_t pixels = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  std::vector<float> counts(2 * pixels);
  glReadBuffer(GL_COLOR_ATTACHMENT2);
  glReadPixels(0, 0, size[0], size[1], GL_RG, GL_FLOAT, counts.data());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  double fetches = 0.0;
  double samples = 0.0;
  for (std::size_t i = 0; i < pixels; ++i)
  {
    fetches += static_cast<double>(counts[2 * i]);
    samples += static_cast<double>(counts[2 * i + 1]);
  }
  return {fetches / static_cast<double>(pixels), samples / static_cast<double>(pixels)};
}

DepthImage RayTarget::readDepth() const
{
  DepthImage image;
  image.width = m_depth.dims()[0];
  image.height = m_depth.dims()[1];
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  std::vector<float> rows(width * height);
  if (!rows.empty())
  {
    glActiveTexture(GL_TEXTURE0);
    m_depth.bind(0);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, rows.data());
    glBindTexture(GL_TEXTURE_2D, 0);
  }
  image.millimetres.resize(rows.size());
  for (std::size_t y = 0; y < height; ++y) // OpenGL stores rows bottom up
    std::transform(rows.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * width),
                   rows.begin() + static_cast<std::ptrdiff_t>((height - y) * width),
                   image.millimetres.begin() + static_cast<std::ptrdiff_t>(y * width),
                   [](float d) { return d < 0.0F ? std::numeric_limits<float>::quiet_NaN() : d; });
  return image;
}

float RayTarget::readDepth(double column, double row, int width, int height) const
{
  const core::Index3& size = m_depth.dims();
  if (!m_framebuffer || size[0] < 1 || column < 0.0 || row < 0.0 || column >= width ||
      row >= height)
    return std::numeric_limits<float>::quiet_NaN();
  const int x = std::min(static_cast<int>((column + 0.5) * size[0] / width), size[0] - 1);
  const int y =
      size[1] - 1 - std::min(static_cast<int>((row + 0.5) * size[1] / height), size[1] - 1);
  GLint bound = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, m_framebuffer);
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  float depth = -1.0F;
  glReadPixels(x, y, 1, 1, GL_RED, GL_FLOAT, &depth);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
  return depth < 0.0F ? std::numeric_limits<float>::quiet_NaN() : depth;
}

void RayTarget::clear(const core::IndexBox& pixels) const
{
  if (pixels.empty())
    return;
  const std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 0.0F};
  const std::array<float, 4> noDepth{-1.0F, 0.0F, 0.0F, 0.0F};
  std::array<GLint, 4> before{};
  glGetIntegerv(GL_SCISSOR_BOX, before.data()); // VTK caches its state
  glEnable(GL_SCISSOR_TEST);
  glScissor(pixels.lower[0], pixels.lower[1], pixels.size()[0], pixels.size()[1]);
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  glClearBufferfv(GL_COLOR, 1, noDepth.data());
  glDisable(GL_SCISSOR_TEST);
  glScissor(before[0], before[1], before[2], before[3]);
}

void RayTarget::bindColor() const
{
  glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
  glDrawBuffer(GL_COLOR_ATTACHMENT0);
}

void RayTarget::release()
{
  m_color.release();
  m_depth.release();
  m_count.release();
  if (m_framebuffer)
    glDeleteFramebuffers(1, &m_framebuffer);
  m_framebuffer = 0;
}

namespace
{

bool drawable(const SceneContents& contents)
{
  // A box that is one sample thin has no volume: the field is air everywhere.
  if (!contents.ct)
    return false;
  const core::IndexBox whole = contents.ct->geometry().fullBox();
  const core::IndexBox box = contents.crop ? contents.crop->intersected(whole) : whole;
  for (std::size_t a = 0; a < 3; ++a)
    if (box.upper[a] - box.lower[a] < 2)
      return false;
  return true;
}

bool translucent(const std::vector<appearance::Material>& materials)
{
  return std::any_of(materials.begin(), materials.end(),
                     [](const appearance::Material& m) { return m.surfaceOpacity < 1.0F; });
}

// Whether rays continue inside structures, so that each sample needs its structure.
bool structuresTranslucent(const SceneContents& contents)
{
  return contents.labels && contents.materials.size() > 1 &&
         std::any_of(contents.materials.begin() + 1, contents.materials.end(),
                     [](const appearance::Material& m)
                     { return !m.lumen && m.surfaceOpacity < 1.0F; });
}

bool reads(const SceneContents& contents, appearance::IntensitySource source)
{
  const auto asks = [source](const appearance::Material& m) { return m.source == source; };
  return otherImage(contents, source).volume &&
         (std::any_of(contents.materials.begin(), contents.materials.end(), asks) ||
          (contents.softTissue && asks(*contents.softTissue)));
}

bool sameMaterial(const appearance::Material& a, const appearance::Material& b)
{
  return a.transfer == b.transfer && a.source == b.source && a.surfaceOpacity == b.surfaceOpacity &&
         a.shininess == b.shininess && a.lumen == b.lumen;
}

bool sameMaterials(const SceneContents& a, const SceneContents& b)
{
  return std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(),
                    sameMaterial) &&
         a.softTissue.has_value() == b.softTissue.has_value() &&
         (!a.softTissue || sameMaterial(*a.softTissue, *b.softTissue));
}

// The texels of a box, first axis fastest.
template <class T>
std::vector<T> boxOf(const std::vector<T>& texels, const core::Index3& dims,
                     const core::IndexBox& box)
{
  std::vector<T> part;
  part.reserve(box.count());
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
    {
      const auto row =
          texels.begin() + box.lower[0] +
          static_cast<std::ptrdiff_t>(dims[0]) * (j + static_cast<std::ptrdiff_t>(dims[1]) * k);
      part.insert(part.end(), row, row + box.size()[0]);
    }
  return part;
}

// Of surfaces, which decide what light they stop.
bool sameOpacities(const std::vector<appearance::Material>& a,
                   const std::vector<appearance::Material>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const appearance::Material& x, const appearance::Material& y)
                    { return x.surfaceOpacity == y.surfaceOpacity && x.lumen == y.lumen; });
}

bool sameRules(const OccupancyGrid::Rules& a, const OccupancyGrid::Rules& b)
{
  const auto same = [](const volume::ValueRange& x, const volume::ValueRange& y)
  { return x.min == y.min && x.max == y.max; };
  return a.iso == b.iso && a.bone == b.bone && a.interior == b.interior &&
         a.interiorEverywhere == b.interiorEverywhere &&
         std::equal(a.opaque.begin(), a.opaque.end(), b.opaque.begin(), b.opaque.end(), same) &&
         a.soft == b.soft && a.softEverywhere == b.softEverywhere &&
         std::equal(a.softOpaque.begin(), a.softOpaque.end(), b.softOpaque.begin(),
                    b.softOpaque.end(), same);
}

// Intensity ranges in which a transfer function has opacity.
std::vector<volume::ValueRange> opaqueRanges(const appearance::TransferFunction& transfer)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<volume::ValueRange> ranges;
  const auto add = [&ranges](double lower, double upper)
  {
    if (!ranges.empty() && ranges.back().max >= lower)
      ranges.back().max = upper;
    else
      ranges.push_back({lower, upper});
  };
  const auto& points = transfer.points();
  if (points.front().opacity > 0.0F)
    add(-infinity, points.front().value);
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i - 1].opacity > 0.0F || points[i].opacity > 0.0F)
      add(points[i - 1].value, points[i].value);
  if (points.back().opacity > 0.0F)
    add(points.back().value, infinity);
  return ranges;
}

} // namespace

// ---- contents

void RayCaster::setContents(const SceneContents& contents)
{
  checkContents(contents);
  checkPlaneCount(contents);
  ++m_changes;
  m_isPrepared = false;
  const bool sameCt = contents.ct == m_contents.ct;
  m_givenMask = contents.mask;
  std::shared_ptr<const volume::CutMask> mask = maskInUse();
  m_newCt |= !sameCt;
  m_newLabels |= contents.labels != m_contents.labels;
  for (OtherImage& other : m_others)
    other.isNew |=
        otherImage(contents, other.source).volume != otherImage(m_contents, other.source).volume;
  m_newThickness |= contents.thickness.distance != m_contents.thickness.distance ||
                    contents.thickness.farthest != m_contents.thickness.farthest;
  const OccupancyGrid::Rules before =
      m_contents.materials.empty() ? OccupancyGrid::Rules{} : rules();
  m_newMaterials |= !sameMaterials(contents, m_contents);
  m_newMeshes = true; // compared when they are needed
  bool newTissue = mask != m_contents.mask || !sameCt || m_newLabels;
  if (mask != m_contents.mask || !sameCt)
    m_mask.reset(mask, m_quality.maskBits, m_quality.largestTexture);
  else
    newTissue |= m_mask.compare();
  m_newRules |= newTissue;
  // What stops the light depends on the bricks' tissue, not on what a ray sees in it.
  m_newOpacities |= newTissue || contents.iso != m_contents.iso ||
                    contents.boneShown != m_contents.boneShown ||
                    !sameOpacities(contents.materials, m_contents.materials);
  m_contents = contents;
  m_contents.mask = std::move(mask);
  if (m_contents.materials.empty())
    m_contents.materials.emplace_back();
  m_newRules |= !sameRules(before, rules());
  if (!sameCt)
  {
    m_occupancy.reset();
    m_opacities.reset();
  }
}

void RayCaster::setQuality(const RenderQuality& quality)
{
  quality.validate();
  m_isPrepared = false;
  const bool sameLimit = quality.largestTexture == m_quality.largestTexture;
  if (quality.maskBits != m_quality.maskBits || !sameLimit)
    m_mask.reset(m_contents.mask, quality.maskBits, quality.largestTexture);
  m_newCt |= !sameLimit;
  m_newLabels |= !sameLimit;
  for (OtherImage& other : m_others)
    other.isNew |= !sameLimit;
  if (quality.brick != m_quality.brick)
  {
    m_occupancy.reset();
    m_newRules = m_newOpacities = true;
  }
  m_newMaterials |= quality.tableSize != m_quality.tableSize;
  m_quality = quality;
}

void RayCaster::maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box)
{
  ++m_changes;
  m_isPrepared = false;
  const bool wasCut = m_mask.inUse();
  m_givenMask = std::move(mask);
  mask = maskInUse();
  m_contents.mask = mask;
  if (static_cast<bool>(mask) != wasCut)
    m_mask.reset(mask, m_quality.maskBits, m_quality.largestTexture);
  else
    m_mask.changed(mask, box);
  if (m_occupancy && !m_newRules)
  {
    m_dirtyBricks = m_dirtyBricks.united(m_occupancy->maskChanged(mask.get(), box));
    if (m_opacities && !m_newOpacities)
      m_dirtyOpacities =
          m_dirtyOpacities.united(m_opacities->maskChanged(lightStoppers(), *m_occupancy, box));
  }
  else
    m_newOpacities = true; // they are measured where the bricks say, which are not known yet
}

void RayCaster::expectCut(bool expected)
{
  m_cutExpected = expected;
  std::shared_ptr<const volume::CutMask> mask = maskInUse();
  if (static_cast<bool>(mask) == m_mask.inUse())
    return;
  ++m_changes;
  m_isPrepared = false;
  // The bricks stay valid: a mask in which nothing is cut yields the same flags as no mask.
  m_contents.mask = mask;
  m_mask.reset(std::move(mask), m_quality.maskBits, m_quality.largestTexture);
}

// A mask in which nothing is cut is drawn as no mask.
std::shared_ptr<const volume::CutMask> RayCaster::maskInUse() const
{
  return m_givenMask && (m_cutExpected || !m_givenMask->untouched()) ? m_givenMask : nullptr;
}

bool RayCaster::softTissueSeen() const
{
  return m_contents.softTissue && !m_contents.softTissue->transfer.transparent();
}

// Whether rays go on in tissue.
bool RayCaster::interiorSeen() const
{
  return softTissueSeen() || translucent(m_contents.materials);
}

RayFeatures RayCaster::features(const Frame& frame) const
{
  RayFeatures features;
  features.bone = m_contents.boneShown;
  features.labels = static_cast<bool>(m_contents.labels);
  features.borders = features.labels && m_labels.borders;
  features.nested = structuresTranslucent(m_contents);
  features.mask = m_mask.inUse();
  features.third = reads(m_contents, appearance::IntensitySource::Third);
  features.second = features.third || reads(m_contents, appearance::IntensitySource::Second);
  features.soft = softTissueSeen();
  features.interior = interiorSeen();
  features.edges = m_contents.light.edges > 0.0 && translucent(m_contents.materials);
  features.exits = m_contents.light.exitSurfaces && translucent(m_contents.materials);
  features.grain = m_contents.light.grain > 0.0 && features.mask;
  features.thickness = static_cast<bool>(m_contents.thickness.distance);
  features.clip = !m_contents.clipping.empty();
  features.shadows = m_contents.light.shadows;
  features.instrument = hasInstrument(frame);
  features.tool = features.instrument || hasPlainTool(frame);
  features.tone = m_contents.light.toneCurve;
  features.exact = m_statistics.filterBits < RenderQuality::kExactFilterBits;
  features.rounded = features.exact && m_quality.filterBits > 0;
  return features;
}

OccupancyGrid::Rules RayCaster::rules() const
{
  OccupancyGrid::Rules rules;
  rules.iso = m_contents.iso;
  rules.bone = m_contents.boneShown;
  rules.soft = softTissueSeen();
  rules.interior = interiorSeen();
  rules.opaque = opaqueRanges(m_contents.materials.front().transfer);
  rules.interiorEverywhere =
      m_contents.materials.front().source != appearance::IntensitySource::Ct &&
      !m_contents.materials.front().transfer.transparent();
  if (rules.soft)
  {
    rules.softEverywhere = m_contents.softTissue->source != appearance::IntensitySource::Ct;
    rules.softOpaque = opaqueRanges(m_contents.softTissue->transfer);
  }
  return rules;
}

OpacityPyramid::Scene RayCaster::lightStoppers() const
{
  return {*m_contents.ct,
          m_contents.labels.get(),
          m_contents.mask.get(),
          m_contents.materials,
          m_contents.iso,
          m_contents.boneShown,
          &m_meshes};
}

// ---- textures

// Returns the texels of the pyramid in which they are not as before.
core::IndexBox RayCaster::followMeshes()
{
  if (!std::exchange(m_newMeshes, false))
    return {};
  const std::map<MeshPointer, std::shared_ptr<const MeshShares>> known = std::move(m_shares);
  const std::vector<OpacityPyramid::Mesh> before = std::move(m_meshes);
  m_shares.clear();
  m_meshes.clear();
  for (const MeshContents& mesh : m_contents.meshes)
  {
    const auto found = known.find(mesh.mesh);
    if (found != known.end())
      m_shares.insert(*found);
    if (!mesh.mesh || !mesh.look.shown || !(mesh.look.opacity > 0.0F))
      continue;
    std::shared_ptr<const MeshShares>& shares = m_shares[mesh.mesh];
    if (!shares)
      shares = std::make_shared<const MeshShares>(m_opacities->sharesOf(*mesh.mesh));
    if (!shares->box.empty())
      m_meshes.push_back(
          {shares, std::min(static_cast<double>(mesh.look.opacity), 1.0), mesh.drilled});
  }
  core::IndexBox changed;
  const auto compare = [&changed](const auto& some, const auto& others)
  {
    for (const OpacityPyramid::Mesh& mesh : some)
      if (std::find(others.begin(), others.end(), mesh) == others.end())
        changed = changed.united(mesh.shares->box);
  };
  compare(before, m_meshes);
  compare(m_meshes, before);
  return changed;
}

// After the bricks.
void RayCaster::uploadOpacities()
{
  if (!m_contents.light.shadows)
  {
    m_opacities.reset();
    m_opacityTexture.release();
    return;
  }
  core::IndexBox dirty = m_dirtyOpacities;
  const bool isNew = !m_opacities;
  if (isNew)
  {
    m_opacities = std::make_unique<OpacityPyramid>(m_contents.ct->geometry());
    m_shares.clear();
    m_meshes.clear();
    m_newMeshes = true;
  }
  const core::IndexBox changed = followMeshes();
  if (isNew || m_newOpacities)
  {
    m_opacities->rebuild(lightStoppers(), *m_occupancy);
    ++m_statistics.opacityRebuilds;
    dirty = {{0, 0, 0}, m_opacities->levels().front().dims};
  }
  else if (!changed.empty())
  {
    m_opacities->meshesChanged(lightStoppers(), changed);
    dirty = dirty.united(changed);
  }
  const std::vector<OpacityPyramid::Level>& levels = m_opacities->levels();
  if (!m_opacityTexture || m_opacityTexture.dims() != levels.front().dims)
  {
    m_opacityTexture.createPyramid(texel::kBytePair, levels.front().dims,
                                   static_cast<int>(levels.size()));
    dirty = {{0, 0, 0}, levels.front().dims};
  }
  if (dirty.empty())
    return;
  for (std::size_t n = 0; n < levels.size(); ++n)
  {
    const core::IndexBox box = OpacityPyramid::boxAt(n, dirty);
    m_opacityTexture.update(box, boxOf(levels[n].texels, levels[n].dims, box).data(),
                            static_cast<int>(n));
  }
}

bool RayCaster::hasInstrument(const Frame& frame) const
{
  return m_contents.light.shadows && m_instrument.texture && frame.tool &&
         tool::isShown(*frame.tool) && frame.tool->instrument == m_instrument.mesh;
}

bool RayCaster::hasPlainTool(const Frame& frame) const
{
  return m_contents.light.shadows && frame.tool && tool::isShown(*frame.tool) &&
         !frame.tool->instrument;
}

// One that is put away or out of the picture stays, as does its measurement: it is often taken up
// again.
void RayCaster::uploadInstrument(const Frame& frame)
{
  m_statistics.pendingShadow = false;
  const bool isHeld = frame.tool && frame.tool->instrument;
  if (!m_contents.light.shadows)
  {
    m_instrument.texture.release();
    m_instrument.mesh.reset();
  }
  if (!m_contents.light.shadows || (isHeld && frame.tool->instrument == m_instrument.mesh))
    m_measurement.reset();
  if (!m_contents.light.shadows || !isHeld || !tool::isShown(*frame.tool) ||
      frame.tool->instrument == m_instrument.mesh)
    return;
  m_instrument.texture.release();
  m_instrument.mesh.reset(); // until all is there: what fails is tried and told again
  const bool wasPending = m_measurement && m_measurement->instrument() == frame.tool->instrument;
  if (!wasPending)
  {
    m_measurement.reset(); // before the next one takes the processors
    m_measurement = std::make_unique<InstrumentMeasurement>(frame.tool->instrument);
  }
  if (frame.shadowsLater && !(wasPending && m_measurement->isDone()))
  {
    m_statistics.pendingShadow = true;
    return;
  }
  const InstrumentDistance& measured = m_measurement->result();
  if (!measured.distances.empty())
    m_instrument.texture.create(texel::kFloat, measured.dims, measured.distances.data(), GL_LINEAR);
  m_instrument.place = {measured.lower, measured.edge, measured.dims, {}};
  m_instrument.mesh = frame.tool->instrument;
  m_measurement.reset();
  if (wasPending)
  {
    ++m_changes;
    m_statistics.pendingShadow = frame.shadowsLater; // the other eye may have been drawn already
  }
}

void RayCaster::prepareShadows(const Frame& frame)
{
  m_isPrepared = false;
  if (!m_contents.light.shadows || !drawable(m_contents))
    return;
  upload();
  uploadInstrument(frame);
  m_isPrepared = true;
}

void RayCaster::upload()
{
  const auto note = [this](const char* what, const core::Index3& by)
  {
    m_statistics.notes.push_back(std::string(what) + " is drawn reduced by " +
                                 std::to_string(by[0]) + " x " + std::to_string(by[1]) + " x " +
                                 std::to_string(by[2]) +
                                 ": the graphics driver has no room for all of it");
  };
  if (m_newCt || !m_ct.texture)
    m_ct.upload(*m_contents.ct, m_quality.largestTexture);
  if (!m_occupancy)
  {
    m_occupancy = std::make_unique<OccupancyGrid>(*m_contents.ct, m_quality.brick);
    m_ctRange = m_occupancy->range();
    m_newRules = m_newMaterials = true;
  }
  for (OtherImage& other : m_others)
    if (!reads(m_contents, other.source))
      other.data.texture.release();
    else if (other.isNew || !other.data.texture)
    {
      const volume::IntensityVolume& image = *otherImage(m_contents, other.source).volume;
      other.data.upload(image, m_quality.largestTexture);
      other.range = image.range();
      m_newMaterials = true;
    }
  if (m_contents.labels && (m_newLabels || !m_labels.occupancy))
    m_labels.upload(*m_contents.labels, m_quality.largestTexture);
  if (!m_contents.labels)
    m_labels.release();
  if (!m_contents.thickness.distance)
    m_thickness.texture.release();
  else if (m_newThickness || !m_thickness.texture)
    m_thickness.upload(m_contents.thickness);
  if (m_newMaterials || !m_materials.look)
  {
    std::vector<appearance::Material> rows = m_contents.materials;
    if (softTissueSeen())
      rows.push_back(*m_contents.softTissue);
    m_materials.upload(rows, m_quality.tableSize,
                       {m_ctRange, m_others[0].range, m_others[1].range});
  }

  const auto start = std::chrono::steady_clock::now();
  const bool edited = m_mask.pendingVoxels() > 0;
  m_mask.upload();
  if (m_newRules || m_newLabels || m_newCt)
  {
    m_occupancy->rebuild(rules(), m_contents.labels.get(), m_contents.mask.get());
    m_tissueBricks = {};
    findTissue({{0, 0, 0}, m_occupancy->dims()});
  }
  findTissue(m_dirtyBricks);
  if (m_newRules || m_newLabels || m_newCt || !m_bricks)
    m_bricks.create(texel::kBrick, m_occupancy->dims(), m_occupancy->texels().data(), GL_NEAREST);
  else if (!m_dirtyBricks.empty())
  {
    const auto texels = boxOf(m_occupancy->texels(), m_occupancy->dims(), m_dirtyBricks);
    m_bricks.update(m_dirtyBricks, texels.data());
  }
  m_dirtyBricks = {};
  uploadOpacities();
  m_dirtyOpacities = {};
  if (edited)
    m_statistics.editMilliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

  m_newCt = m_newLabels = m_newMaterials = m_newRules = m_newThickness = m_newOpacities = false;
  for (OtherImage& other : m_others)
    other.isNew = false;
  m_statistics.notes.clear();
  if (m_ct.reduction != core::Index3{1, 1, 1})
    note("the CT", m_ct.reduction);
  if (m_labels.occupancy && m_labels.reduction != core::Index3{1, 1, 1})
    note("the structures' label field", m_labels.reduction);
  for (const OtherImage& other : m_others)
    if (other.data.texture && other.data.reduction != core::Index3{1, 1, 1})
      note(&other == m_others.data() ? "the second image" : "the third image",
           other.data.reduction);
  m_statistics.pendingEdits = m_mask.pendingVoxels();
  m_statistics.resources = {{"ct.texture", m_ct.texture.bytes()},
                            {"ct.bricks", m_bricks.bytes() + m_occupancy->bytes()}};
  const auto add = [this](const char* name, std::size_t bytes)
  {
    if (bytes > 0)
      m_statistics.resources[name] = bytes;
  };
  add("mask.texture", m_mask.texture().bytes());
  add("labels.texture", m_labels.occupancy.bytes() + m_labels.index.bytes());
  add("labels.thickness", m_thickness.texture.bytes());
  add("mr.texture", m_others[0].data.texture.bytes() + m_others[1].data.texture.bytes());
  add("light.instrument", m_instrument.texture.bytes());
  add("light.opacities", m_opacities ? m_opacityTexture.bytes() + m_opacities->bytes() : 0);
}

// ---- one frame

GlProgram& RayCaster::program(const Frame& frame, bool count)
{
  RayFeatures wanted = features(frame);
  wanted.count = count;
  m_statistics.variant = wanted.names();
  GlProgram& result = m_programs[wanted.key()];
  if (!result)
    result.build(kRayCastVertexShader, rayFragmentShader(wanted));
  return result;
}

void RayCaster::findFilterBits()
{
  if (m_quality.filterBits == 0 && m_filterBits == 0)
    m_filterBits = measureFilterBits(m_triangle);
  m_statistics.filterBits = m_quality.filterBits > 0 ? m_quality.filterBits : m_filterBits;
}

void RayCaster::draw(const Frame& frame, bool count)
{
  const int width = std::max(1, static_cast<int>(std::lround(frame.width * m_quality.imageScale)));
  const int height =
      std::max(1, static_cast<int>(std::lround(frame.height * m_quality.imageScale)));
  const bool anything = drawable(m_contents);
  m_fovea.reset();
  if (anything)
  {
    if (!std::exchange(m_isPrepared, false))
    {
      upload();
      uploadInstrument(frame);
    }
    findFilterBits();
  }
  m_target.prepare(width, height, count);
  glViewport(0, 0, width, height);
  const std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 0.0F};
  const std::array<float, 4> noDepth{-1.0F, 0.0F, 0.0F, 0.0F};
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  glClearBufferfv(GL_COLOR, 1, noDepth.data());
  if (count)
    glClearBufferfv(GL_COLOR, 2, nothing.data());
  if (!anything)
  {
    m_statistics = {};
    if (!m_contents.ct)
      releaseData();
    return;
  }
  GlProgram& shader = program(frame, count);
  shader.use();
  bindTextures(shader, frame);
  setRays(shader, frame, height);
  setVolume(shader);
  setLight(shader, frame);
  setShadows(shader, frame);
  castRays(tissueOnScreen(frame, width, height));
  if (frame.fovea && !count)
    drawFovea(frame);
  if (count)
  {
    const auto [fetches, samples] = m_target.meanCounts();
    m_statistics.fetchesPerPixel = fetches;
    m_statistics.samplesPerPixel = samples;
  }
}

// The program of the whole picture is in use.
void RayCaster::drawFovea(const Frame& frame)
{
  const Fovea& fovea = *frame.fovea;
  const int width = std::max(1, static_cast<int>(std::lround(frame.width * fovea.scale)));
  const int height = std::max(1, static_cast<int>(std::lround(frame.height * fovea.scale)));
  constexpr int kMargin = 2; // texels, for interpolation
  core::IndexBox pixels{{0, 0, 0}, {width, height, 1}};
  const double reach = fovea.radius * fovea.scale + kMargin;
  for (const auto& [axis, center] : {std::pair<std::size_t, double>{0, fovea.x}, {1, fovea.y}})
  {
    const double size = pixels.upper[axis];
    const auto edge = [&](double at) { return static_cast<int>(std::clamp(at, 0.0, size)); };
    pixels.lower[axis] = edge(std::floor(center * fovea.scale - reach));
    pixels.upper[axis] = edge(std::ceil(center * fovea.scale + reach));
  }
  if (pixels.empty())
    return;
  m_foveaTarget.prepare(width, height, false);
  glViewport(0, 0, width, height);
  m_foveaTarget.clear(pixels);
  RenderQuality quality = m_quality;
  quality.step = fovea.step;
  drawPart(frame, quality, pixels);
  m_fovea = fovea;
}

void RayCaster::drawPart(const Frame& frame, const RenderQuality& quality,
                         const core::IndexBox& pixels)
{
  if (!drawable(m_contents) || !m_occupancy)
    return;
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  const core::IndexBox part = tissueOnScreen(frame, viewport[2], viewport[3]).intersected(pixels);
  if (part.empty())
    return;
  struct Restored
  {
    RenderQuality& quality;
    RenderQuality before;
    ~Restored() { quality = before; }
  } restored{m_quality, m_quality};
  m_quality = quality;
  GlProgram& shader = program(frame, false);
  shader.use();
  bindTextures(shader, frame);
  setRays(shader, frame, viewport[3]);
  setVolume(shader);
  setLight(shader, frame);
  setShadows(shader, frame);
  castRays(part);
}

GlProgram& RayCaster::presenting()
{
  if (!m_present)
    m_present.build(kRayCastVertexShader, kPresentShader);
  m_present.use();
  m_present.set("picture", 0);
  m_present.set("fovea", 1);
  m_present.set("share", 1.0);
  m_present.set("hasFovea", 0);
  return m_present;
}

void RayCaster::present(int width, int height)
{
  GlProgram& shader = presenting();
  if (m_fovea)
  {
    m_foveaTarget.color().bind(1);
    shader.set("hasFovea", 1);
    shader.set("windowSize", Eigen::Vector2d(width, height));
    shader.set("foveaCircle", Eigen::Vector3d(m_fovea->x, m_fovea->y, m_fovea->radius));
  }
  m_target.color().bind(0);
  shader.set("sameSize",
             m_target.color().dims()[0] == width && m_target.color().dims()[1] == height ? 1 : 0);
  m_triangle.draw();
}

void RayCaster::copy(const GlTexture& picture, double share)
{
  GlProgram& shader = presenting();
  picture.bind(0);
  shader.set("sameSize", 1);
  shader.set("share", share);
  m_triangle.draw();
}

float RayCaster::readDepth(double column, double row, int width, int height) const
{
  const bool isIn = m_fovea && std::hypot(column + 0.5 - m_fovea->x,
                                          height - 0.5 - row - m_fovea->y) < m_fovea->radius;
  return (isIn ? m_foveaTarget : m_target).readDepth(column, row, width, height);
}

void RayCaster::releaseData()
{
  m_ct.texture.release();
  for (OtherImage& other : m_others)
    other.data.texture.release();
  m_mask.release();
  m_labels.release();
  m_thickness.texture.release();
  m_materials.release();
  m_bricks.release();
  m_opacityTexture.release();
  m_instrument.texture.release();
  m_instrument.mesh.reset();
  m_measurement.reset();
  m_isPrepared = false;
}

void RayCaster::releasePicture()
{
  m_target.release();
  m_foveaTarget.release();
  m_fovea.reset();
  m_statistics = {};
}

void RayCaster::release()
{
  releaseData();
  for (auto& [features, shader] : m_programs)
    shader.release();
  m_programs.clear();
  m_present.release();
  m_target.release();
  m_foveaTarget.release();
  m_fovea.reset();
  m_triangle.release();
  m_filterBits = 0; // the next context may be of another card
}

} // namespace petrous::rendering
