#include "RayCaster.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "OpticalModel.h"
#include "PresentShader.h"
#include "RayCastShader.h"
#include "RayCastVertexShader.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{

constexpr double kFieldScale = 1000.0; // unit of c_CT, as the tissue field's default
constexpr std::size_t kMostPlanes = 6;

enum Unit : int
{
  CtUnit,
  BrickUnit,
  LookUnit,
  MaterialUnit,
  OpaqueUnit,
  MaskUnit,
  ShareUnit,
  IndexUnit,
  SecondUnit,
  DepthUnit
};

bool drawable(const SceneContents& contents)
{
  // A grid one sample thin has a hull without a volume: the field is air everywhere.
  if (!contents.ct)
    return false;
  const core::Index3& dims = contents.ct->geometry().dims();
  return *std::min_element(dims.begin(), dims.end()) > 1;
}

bool translucent(const std::vector<appearance::Material>& materials)
{
  return std::any_of(materials.begin(), materials.end(),
                     [](const appearance::Material& m) { return m.surfaceOpacity < 1.0F; });
}

bool readsSecond(const SceneContents& contents)
{
  return contents.second.volume &&
         std::any_of(contents.materials.begin(), contents.materials.end(),
                     [](const appearance::Material& m)
                     { return m.source == appearance::IntensitySource::Second; });
}

// Intensities at which a transfer function has opacity.
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

// ---- what is drawn

void RayCaster::setContents(const SceneContents& contents)
{
  const bool sameCt = contents.ct == m_contents.ct;
  m_newCt |= !sameCt;
  m_newLabels |= contents.labels != m_contents.labels;
  m_newSecond |= contents.second.volume != m_contents.second.volume;
  m_newMaterials = true;
  m_newRules = true;
  if (contents.mask != m_contents.mask || !sameCt)
    m_mask.reset(contents.mask, m_quality.maskBits);
  else
    m_mask.compare();
  m_contents = contents;
  if (m_contents.materials.empty())
    m_contents.materials.emplace_back();
  if (!sameCt)
    m_occupancy.reset();
}

void RayCaster::setQuality(const RenderQuality& quality)
{
  if (quality.maskBits != m_quality.maskBits)
    m_mask.reset(m_contents.mask, quality.maskBits);
  if (quality.brick != m_quality.brick)
  {
    m_occupancy.reset();
    m_newRules = true;
  }
  m_newMaterials |= quality.tableSize != m_quality.tableSize;
  m_quality = quality;
}

void RayCaster::maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box)
{
  const bool wasCut = m_mask.inUse();
  m_contents.mask = mask;
  if (static_cast<bool>(mask) != wasCut)
    m_mask.reset(mask, m_quality.maskBits);
  else
    m_mask.changed(mask, box);
  if (m_occupancy && !m_newRules)
    m_dirtyBricks = m_dirtyBricks.united(m_occupancy->maskChanged(mask.get(), box));
}

unsigned RayCaster::features() const
{
  unsigned result = m_contents.boneShown ? unsigned{Bone} : 0U;
  if (m_contents.labels)
    result |= Labels;
  if (m_mask.inUse())
    result |= Mask;
  if (readsSecond(m_contents))
    result |= Second;
  if (translucent(m_contents.materials))
    result |= Interior;
  if (!m_contents.clipping.empty())
    result |= Clip;
  return result;
}

OccupancyGrid::Rules RayCaster::rules() const
{
  OccupancyGrid::Rules rules;
  rules.iso = m_contents.iso;
  rules.bone = m_contents.boneShown;
  rules.interior = translucent(m_contents.materials);
  rules.opaque = opaqueRanges(m_contents.materials.front().transfer);
  rules.interiorEverywhere =
      m_contents.materials.front().source == appearance::IntensitySource::Second &&
      !m_contents.materials.front().transfer.transparent();
  return rules;
}

// ---- textures

void RayCaster::uploadMaterials()
{
  // Rows for every index that a texel can hold: a structure without a material is drawn as bone.
  m_materials.upload(m_contents.materials, m_quality.tableSize, m_ctRange, m_secondRange);
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
  {
    m_ct.upload(*m_contents.ct);
  }
  if (!m_occupancy)
  {
    m_occupancy = std::make_unique<OccupancyGrid>(*m_contents.ct, m_quality.brick);
    m_ctRange = m_occupancy->range();
    m_newRules = m_newMaterials = true;
  }
  if (readsSecond(m_contents) && (m_newSecond || !m_second.texture))
  {
    m_second.upload(*m_contents.second.volume);
    m_secondRange = m_contents.second.volume->range();
    m_newMaterials = true;
  }
  if (m_contents.labels && (m_newLabels || !m_labels.share))
    m_labels.upload(*m_contents.labels);
  if (!m_contents.labels)
    m_labels.release();
  if (m_newMaterials || !m_materials.look)
    uploadMaterials();

  const auto start = std::chrono::steady_clock::now();
  const bool edited = m_mask.pendingVoxels() > 0;
  m_mask.upload();
  if (m_newRules || m_newLabels || m_newCt)
    m_occupancy->rebuild(rules(), m_contents.labels.get(), m_contents.mask.get());
  if (m_newRules || m_newLabels || m_newCt || !m_bricks)
    m_bricks.create(texel::kBrick, m_occupancy->dims(), m_occupancy->texels().data(), GL_NEAREST);
  else if (!m_dirtyBricks.empty())
  {
    const core::Index3 size = m_dirtyBricks.size();
    const core::Index3& dims = m_occupancy->dims();
    std::vector<OccupancyGrid::Texel> texels;
    texels.reserve(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                   static_cast<std::size_t>(size[2]));
    for (int k = m_dirtyBricks.lower[2]; k < m_dirtyBricks.upper[2]; ++k)
      for (int j = m_dirtyBricks.lower[1]; j < m_dirtyBricks.upper[1]; ++j)
      {
        const auto row =
            m_occupancy->texels().begin() + m_dirtyBricks.lower[0] +
            static_cast<std::ptrdiff_t>(dims[0]) * (j + static_cast<std::ptrdiff_t>(dims[1]) * k);
        texels.insert(texels.end(), row, row + size[0]);
      }
    m_bricks.update(m_dirtyBricks, texels.data());
  }
  m_dirtyBricks = {};
  if (edited)
    m_statistics.editMilliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

  m_newCt = m_newLabels = m_newMaterials = m_newSecond = m_newRules = false;
  m_statistics.notes.clear();
  if (m_ct.reduction != core::Index3{1, 1, 1})
    note("the CT", m_ct.reduction);
  if (m_second.texture && m_second.reduction != core::Index3{1, 1, 1})
    note("the second image", m_second.reduction);
  m_statistics.pendingEdits = m_mask.pendingVoxels();
  m_statistics.resources = {{"ct.texture", m_ct.texture.bytes()},
                            {"ct.bricks", m_bricks.bytes() + m_occupancy->bytes()}};
  const auto add = [this](const char* name, std::size_t bytes)
  {
    if (bytes > 0)
      m_statistics.resources[name] = bytes;
  };
  add("mask.texture", m_mask.texture().bytes());
  add("labels.texture", m_labels.share.bytes() + m_labels.index.bytes());
  add("mr.texture", m_second.texture.bytes());
}

void RayCaster::prepareTarget(int width, int height, bool count)
{
  if (m_target.framebuffer && m_target.color.dims()[0] == width &&
      m_target.color.dims()[1] == height && m_target.counting == count)
  {
    glBindFramebuffer(GL_FRAMEBUFFER, m_target.framebuffer);
    return;
  }
  m_target.color.create(texel::kColor, width, height, nullptr, GL_LINEAR);
  m_target.depth.create(texel::kFloat, width, height, nullptr, GL_NEAREST);
  if (count)
    m_target.count.create(texel::kFloat2, width, height, nullptr, GL_NEAREST);
  else
    m_target.count.release();
  m_target.counting = count;
  if (!m_target.framebuffer)
    glGenFramebuffers(1, &m_target.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, m_target.framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, m_target.color.name(),
                         0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, m_target.depth.name(),
                         0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT2, GL_TEXTURE_2D,
                         count ? m_target.count.name() : 0, 0);
  const std::array<GLenum, 3> buffers{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                      GL_COLOR_ATTACHMENT2};
  glDrawBuffers(count ? 3 : 2, buffers.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw RenderingError(RenderingError::Reason::NoOpenGL,
                         "the graphics driver draws no picture of " + std::to_string(width) +
                             " x " + std::to_string(height) + " in 16-bit colour");
}

// ---- one frame

GlProgram& RayCaster::program(unsigned features, bool count)
{
  m_statistics.variant = {"ct"};
  std::string head = "#version 330 core\n";
  const auto add = [&](Feature feature, const char* define, const char* name)
  {
    if (!(features & feature))
      return;
    head += std::string("#define ") + define + "\n";
    m_statistics.variant.emplace_back(name);
  };
  add(Bone, "PETROUS_BONE", "bone");
  add(Labels, "PETROUS_LABELS", "labels");
  add(Mask, "PETROUS_MASK", "mask");
  add(Second, "PETROUS_SECOND", "second");
  add(Interior, "PETROUS_INTERIOR", "interior");
  add(Clip, "PETROUS_CLIP 6", "clipping");
  GlProgram& result = m_programs[features * 2U + (count ? 1U : 0U)];
  if (!result)
    result.build(std::string("#version 330 core\n").append(kRayCastVertexShader),
                 head + (count ? "#define PETROUS_COUNT\n" : "") + std::string(kRayCastShader));
  return result;
}

void RayCaster::bindTextures(GlProgram& program, const Frame& frame) const
{
  const auto bind = [&program](const GlTexture& texture, int unit, const char* name)
  {
    texture.bind(unit);
    program.set(name, unit);
  };
  bind(m_ct.texture, CtUnit, "ctTexture");
  bind(m_bricks, BrickUnit, "brickTexture");
  bind(m_materials.look, LookUnit, "lookTexture");
  bind(m_materials.material, MaterialUnit, "materialTexture");
  bind(m_materials.depth, DepthUnit, "depthTexture");
  if (m_mask.inUse())
    bind(m_mask.texture(), MaskUnit, "maskTexture");
  if (m_contents.labels)
  {
    bind(m_labels.share, ShareUnit, "shareTexture");
    bind(m_labels.index, IndexUnit, "indexTexture");
  }
  if (m_second.texture)
    bind(m_second.texture, SecondUnit, "secondTexture");
  glActiveTexture(GL_TEXTURE0 + OpaqueUnit);
  glBindTexture(GL_TEXTURE_2D, frame.opaque);
  program.set("opaqueTexture", int{OpaqueUnit});
  program.set("hasOpaque", frame.opaque ? 1 : 0);
}

void RayCaster::setRays(GlProgram& program, const Frame& frame) const
{
  const core::GridGeometry& grid = m_contents.ct->geometry();
  const Eigen::Matrix3d& voxelFromMm = grid.voxelFromPatientLinear();
  const RayView& view = frame.view;
  program.set("originCenter", grid.voxelFromPatient(view.origin));
  program.set("originX", Eigen::Vector3d(voxelFromMm * view.originX));
  program.set("originY", Eigen::Vector3d(voxelFromMm * view.originY));
  program.set("directionCenter", Eigen::Vector3d(voxelFromMm * view.direction));
  program.set("directionX", Eigen::Vector3d(voxelFromMm * view.directionX));
  program.set("directionY", Eigen::Vector3d(voxelFromMm * view.directionY));
  program.set("viewCenter", view.direction);
  program.set("viewX", view.directionX);
  program.set("viewY", view.directionY);
  program.set("parallel", view.parallel ? 1 : 0);
  program.set("opaqueDepth", view.depth);

  std::array<float, 4 * kMostPlanes> planes{};
  const std::size_t count = std::min(m_contents.clipping.size(), kMostPlanes);
  for (std::size_t i = 0; i < count; ++i)
  {
    const ClippingPlane& plane = m_contents.clipping[i];
    const Eigen::Vector3d slope = voxelFromMm.inverse().transpose() * plane.normal;
    const double offset =
        plane.normal.dot(grid.patientFromVoxel(Eigen::Vector3d::Zero()) - plane.point);
    for (int a = 0; a < 3; ++a)
      planes[4 * i + static_cast<std::size_t>(a)] = static_cast<float>(slope[a]);
    planes[4 * i + 3] = static_cast<float>(offset);
  }
  program.set("planeCount", static_cast<int>(count));
  program.setArray("planes", planes.data(), static_cast<int>(kMostPlanes));
}

void RayCaster::setVolume(GlProgram& program) const
{
  const core::GridGeometry& grid = m_contents.ct->geometry();
  const Eigen::Matrix3d& voxelFromMm = grid.voxelFromPatientLinear();
  const auto upperOf = [](const core::Index3& dims)
  { return Eigen::Vector3d(dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0); };
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
  Eigen::Vector3d upper = upperOf(grid.dims());
  program.set("hullUpper", upper);
  if (m_contents.crop)
    for (int a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<std::size_t>(a);
      lower[a] = std::max<double>(lower[a], m_contents.crop->lower[axis]);
      upper[a] = std::min<double>(upper[a], m_contents.crop->upper[axis] - 1.0);
    }
  program.set("boxLower", lower);
  program.set("boxUpper", upper);
  program.set("ctScale", m_ct.map.scale);
  program.set("ctOffset", m_ct.map.offset);
  program.set("ctUnit", m_ct.unit);
  program.set("iso", m_contents.iso);
  program.set("perUnit", 1.0 / kFieldScale);
  program.set("brickEdge", double(m_quality.brick));
  program.set("stepLength", m_quality.step * grid.minSpacing());
  program.set("bisections", m_quality.bisections);
  program.set("termination", m_quality.termination);
  program.set("normalFromVoxel", Eigen::Matrix3d(voxelFromMm.transpose()));
  program.set("voxelFromMm", voxelFromMm);
  program.set("colorDepth", optics::kColorDepth * grid.minSpacing());
  const LightSettings& light = m_contents.light;
  program.set("light",
              Eigen::Vector4d(light.intensity, light.ambient, light.specular, light.wetness));
  program.set("falloff", light.falloff);
  program.set("maskScale", m_mask.map().scale);
  program.set("maskOffset", m_mask.map().offset);
  if (m_contents.labels)
  {
    const core::GridGeometry& labels = m_contents.labels->share->geometry();
    program.set("labelFromVoxel",
                Eigen::Matrix3d(labels.voxelFromPatientLinear() * voxelFromMm.inverse()));
    program.set("labelOrigin",
                labels.voxelFromPatient(grid.patientFromVoxel(Eigen::Vector3d::Zero())));
    program.set("labelUpper", upperOf(labels.dims()));
    program.set("normalFromLabel", Eigen::Matrix3d(labels.voxelFromPatientLinear().transpose()));
  }
  if (m_second.texture && m_contents.second.volume)
  {
    const core::GridGeometry& second = m_contents.second.volume->geometry();
    const core::RigidTransform& motion = m_contents.second.secondFromCt;
    const Eigen::Matrix3d linear = second.voxelFromPatientLinear() *
                                   motion.rotation().toRotationMatrix() * voxelFromMm.inverse();
    program.set("secondFromVoxel", linear);
    program.set("secondOrigin",
                second.voxelFromPatient(motion * grid.patientFromVoxel(Eigen::Vector3d::Zero())));
    program.set("secondUnit", m_second.unit);
    program.set("secondUpper", upperOf(second.dims()));
    program.set("secondScale", m_second.map.scale);
    program.set("secondOffset", m_second.map.offset);
  }
}

void RayCaster::drawTriangle()
{
  if (!m_vertexArray)
    glGenVertexArrays(1, &m_vertexArray);
  glBindVertexArray(m_vertexArray);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

void RayCaster::draw(const Frame& frame, bool count)
{
  const int width = std::max(1, static_cast<int>(std::lround(frame.width * m_quality.imageScale)));
  const int height =
      std::max(1, static_cast<int>(std::lround(frame.height * m_quality.imageScale)));
  const bool anything = drawable(m_contents);
  if (anything)
    upload();
  prepareTarget(width, height, count);
  glViewport(0, 0, width, height);
  const std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 0.0F};
  const std::array<float, 4> noDepth{-1.0F, 0.0F, 0.0F, 0.0F};
  if (!anything)
  {
    glClearBufferfv(GL_COLOR, 0, nothing.data());
    glClearBufferfv(GL_COLOR, 1, noDepth.data());
    m_statistics.variant.clear();
    return;
  }
  GlProgram& shader = program(features(), count);
  shader.use();
  bindTextures(shader, frame);
  setRays(shader, frame);
  setVolume(shader);
  drawTriangle();
  if (count)
    readCounts();
}

void RayCaster::present(int width, int height)
{
  if (!m_present)
    m_present.build(std::string("#version 330 core\n").append(kRayCastVertexShader),
                    std::string("#version 330 core\n").append(kPresentShader));
  m_present.use();
  m_target.color.bind(0);
  m_present.set("picture", 0);
  m_present.set("sameSize",
                m_target.color.dims()[0] == width && m_target.color.dims()[1] == height ? 1 : 0);
  drawTriangle();
  glUseProgram(0);
}

void RayCaster::readCounts()
{
  const core::Index3& size = m_target.count.dims();
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
  m_statistics.fetchesPerPixel = fetches / static_cast<double>(pixels);
  m_statistics.samplesPerPixel = samples / static_cast<double>(pixels);
}

DepthImage RayCaster::readDepth() const
{
  DepthImage image;
  image.width = m_target.depth.dims()[0];
  image.height = m_target.depth.dims()[1];
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  std::vector<float> rows(width * height);
  if (!rows.empty())
  {
    glActiveTexture(GL_TEXTURE0);
    m_target.depth.bind(0);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, rows.data());
    glBindTexture(GL_TEXTURE_2D, 0);
  }
  image.millimetres.resize(rows.size());
  for (std::size_t y = 0; y < height; ++y) // OpenGL's rows run from the bottom
    std::transform(rows.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * width),
                   rows.begin() + static_cast<std::ptrdiff_t>((height - y) * width),
                   image.millimetres.begin() + static_cast<std::ptrdiff_t>(y * width),
                   [](float d) { return d < 0.0F ? std::numeric_limits<float>::quiet_NaN() : d; });
  return image;
}

float RayCaster::readDepth(double column, double row, int width, int height) const
{
  const core::Index3& size = m_target.depth.dims();
  if (!m_target.framebuffer || size[0] < 1 || column < 0.0 || row < 0.0 || column >= width ||
      row >= height)
    return std::numeric_limits<float>::quiet_NaN();
  const int x = std::min(static_cast<int>((column + 0.5) * size[0] / width), size[0] - 1);
  const int y =
      size[1] - 1 - std::min(static_cast<int>((row + 0.5) * size[1] / height), size[1] - 1);
  GLint bound = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, m_target.framebuffer);
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  float depth = -1.0F;
  glReadPixels(x, y, 1, 1, GL_RED, GL_FLOAT, &depth);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
  return depth < 0.0F ? std::numeric_limits<float>::quiet_NaN() : depth;
}

void RayCaster::release()
{
  for (auto& [features, shader] : m_programs)
    shader.release();
  m_programs.clear();
  m_present.release();
  m_ct.texture.release();
  m_second.texture.release();
  m_mask.release();
  m_labels.release();
  m_materials.release();
  m_bricks.release();
  m_target.color.release();
  m_target.depth.release();
  m_target.count.release();
  if (m_target.framebuffer)
    glDeleteFramebuffers(1, &m_target.framebuffer);
  m_target.framebuffer = 0;
  if (m_vertexArray)
    glDeleteVertexArrays(1, &m_vertexArray);
  m_vertexArray = 0;
}

} // namespace petrous::rendering
