// Per-frame uniforms (rays, grids, light) and the pixels for which rays are cast.

#include "RayCaster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "OpticalModel.h"
#include "petrous/Rendering/ToolShape.h"

namespace petrous::rendering
{

namespace
{

constexpr double kFieldScale = 1000.0; // unit of c_CT, as the tissue field's default

enum Unit : int
{
  CtUnit,
  BrickUnit,
  LookUnit,
  MaterialUnit,
  OpaqueUnit,
  MaskUnit,
  OccupancyUnit,
  IndexUnit,
  SecondUnit,
  ThirdUnit,
  ThicknessUnit,
  DepthUnit,
  OpacityUnit,
  InstrumentUnit
};

} // namespace

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
    bind(m_labels.occupancy, OccupancyUnit, "occupancyTexture");
    bind(m_labels.index, IndexUnit, "indexTexture");
  }
  if (m_others[0].data.texture)
    bind(m_others[0].data.texture, SecondUnit, "secondTexture");
  if (m_others[1].data.texture)
    bind(m_others[1].data.texture, ThirdUnit, "thirdTexture");
  if (m_thickness.texture)
    bind(m_thickness.texture, ThicknessUnit, "thicknessTexture");
  if (m_opacityTexture)
    bind(m_opacityTexture, OpacityUnit, "opacityTexture");
  if (m_instrument.texture)
    bind(m_instrument.texture, InstrumentUnit, "instrumentTexture");
  glActiveTexture(GL_TEXTURE0 + OpaqueUnit);
  glBindTexture(GL_TEXTURE_2D, frame.opaque);
  program.set("opaqueTexture", int{OpaqueUnit});
  program.set("hasOpaque", frame.opaque ? 1 : 0);
}

// `height`: of the target, pixels.
void RayCaster::setRays(GlProgram& program, const Frame& frame, int height) const
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
  const double pixel = 2.0 * (view.parallel ? view.originY : view.directionY).norm() / height;
  program.set("pixel", view.parallel ? Eigen::Vector2d(pixel, 0.0) : Eigen::Vector2d(0.0, pixel));
}

// The part of the volume that is drawn.
void RayCaster::setDrawn(GlUniforms& program) const
{
  const core::GridGeometry& grid = m_contents.ct->geometry();
  const Eigen::Matrix3d& voxelFromMm = grid.voxelFromPatientLinear();
  program.set("voxelFromMm", voxelFromMm);
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
  Eigen::Vector3d upper(grid.dims()[0] - 1.0, grid.dims()[1] - 1.0, grid.dims()[2] - 1.0);
  if (m_contents.crop)
    for (int a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<std::size_t>(a);
      lower[a] = std::max<double>(lower[a], m_contents.crop->lower[axis]);
      upper[a] = std::min<double>(upper[a], m_contents.crop->upper[axis] - 1.0);
    }
  program.set("boxLower", lower);
  program.set("boxUpper", upper);
  std::array<float, 4 * kMaxPlanes> planes{};
  const std::size_t count = std::min(m_contents.clipping.size(), kMaxPlanes);
  for (std::size_t i = 0; i < count; ++i)
  {
    const ClippingPlane& plane = m_contents.clipping[i];
    const Eigen::Vector3d normal = plane.normal.normalized();
    const Eigen::Vector3d slope = voxelFromMm.inverse().transpose() * normal;
    const double offset = normal.dot(grid.patientFromVoxel(Eigen::Vector3d::Zero()) - plane.point);
    for (int a = 0; a < 3; ++a)
      planes[4 * i + static_cast<std::size_t>(a)] = static_cast<float>(slope[a]);
    planes[4 * i + 3] = static_cast<float>(offset);
  }
  program.set("planeCount", static_cast<int>(count));
  program.setArray("planes", planes.data(), static_cast<int>(kMaxPlanes));
}

void RayCaster::setVolume(GlProgram& program) const
{
  const core::GridGeometry& grid = m_contents.ct->geometry();
  const Eigen::Matrix3d& voxelFromMm = grid.voxelFromPatientLinear();
  const auto upperOf = [](const core::Index3& dims)
  { return Eigen::Vector3d(dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0); };
  program.set("hullUpper", upperOf(grid.dims()));
  setDrawn(program);
  program.set("ctScale", m_ct.map.scale);
  program.set("ctOffset", m_ct.map.offset);
  program.set("ctUnit", m_ct.unit);
  program.set("iso", m_contents.iso);
  program.set("perUnit", 1.0 / kFieldScale);
  program.set("brickEdge", double(m_quality.brick));
  program.set("stepLength", m_quality.step * grid.minSpacing());
  program.set("bisections", m_quality.bisections);
  program.set("exactSamples", m_quality.exactSamples ? 1 : 0);
  program.set("weights", std::ldexp(1.0, m_statistics.filterBits));
  program.set("termination", m_quality.termination);
  program.set("normalFromVoxel", Eigen::Matrix3d(voxelFromMm.transpose()));
  program.set("colorDepth", optics::kColorDepth * grid.minSpacing());
  program.set("maskScale", m_mask.map().scale);
  program.set("maskOffset", m_mask.map().offset);
  if (m_contents.labels)
  {
    const core::GridGeometry& labels = m_contents.labels->occupancy->geometry();
    program.set("labelFromVoxel",
                Eigen::Matrix3d(labels.voxelFromPatientLinear() * voxelFromMm.inverse()));
    program.set("labelOrigin",
                labels.voxelFromPatient(grid.patientFromVoxel(Eigen::Vector3d::Zero())));
    program.set("labelUpper", upperOf(labels.dims()));
    program.set("labelScale", m_labels.map.scale);
    program.set("labelOffset", m_labels.map.offset);
    program.set("labelBlock", Eigen::Vector3d(m_labels.reduction[0], m_labels.reduction[1],
                                              m_labels.reduction[2]));
    program.set("normalFromLabel", Eigen::Matrix3d(labels.voxelFromPatientLinear().transpose()));
  }
  if (m_thickness.texture)
  {
    const core::GridGeometry& own = m_contents.thickness.distance->geometry();
    program.set("thicknessFromVoxel",
                Eigen::Matrix3d(own.voxelFromPatientLinear() * voxelFromMm.inverse()));
    program.set("thicknessOrigin",
                own.voxelFromPatient(grid.patientFromVoxel(Eigen::Vector3d::Zero())));
    program.set("thicknessUpper", upperOf(own.dims()));
    program.set("thicknessScale", m_thickness.map.scale);
    program.set("thicknessOffset", m_thickness.map.offset);
    program.set("thicknessUnit", m_thickness.unit);
    program.set("thicknessFarthest", m_contents.thickness.farthest);
  }
  for (const OtherImage& other : m_others)
  {
    const SecondImage& image = otherImage(m_contents, other.source);
    if (!other.data.texture || !image.volume)
      continue;
    const core::GridGeometry& own = image.volume->geometry();
    const core::RigidTransform& motion = image.secondFromCt;
    const Eigen::Matrix3d linear =
        own.voxelFromPatientLinear() * motion.rotation().toRotationMatrix() * voxelFromMm.inverse();
    const std::string name =
        other.source == appearance::IntensitySource::Third ? "third" : "second";
    const auto set = [&](const char* what, const auto& value)
    { program.set((name + what).c_str(), value); };
    set("FromVoxel", linear);
    set("Origin", own.voxelFromPatient(motion * grid.patientFromVoxel(Eigen::Vector3d::Zero())));
    set("Unit", other.data.unit);
    set("Upper", upperOf(own.dims()));
    set("Scale", other.data.map.scale);
    set("Offset", other.data.map.offset);
  }
}

void RayCaster::setLight(GlProgram& program, const Frame& frame) const
{
  const LightSettings& light = m_contents.light;
  program.set("light", Eigen::Vector4d(optics::lightAt(light, 0.0, frame.lamp.focus), light.ambient,
                                       light.specular, light.wetness));
  program.set("plainLight", light.intensity);
  program.set("edges", light.edges);
  program.set("grain", light.grain);
  program.set("coarseCells", optics::grainFromVoxel(m_contents.ct->geometry(), 0));
  program.set("fineCells", optics::grainFromVoxel(m_contents.ct->geometry(), 1));
  program.set("falloff", light.falloff);
  program.set("aside", optics::asideOf(m_contents.ct->geometry(), frame.sample));
  const SectionWindow window = m_contents.section.value_or(SectionWindow());
  program.set("section", m_contents.section ? Eigen::Vector2d(window.level - 0.5 * window.width,
                                                              1.0 / window.width)
                                            : Eigen::Vector2d::Zero().eval());
}

void RayCaster::shadePolygons(GlUniforms& uniforms, const Frame& frame,
                              const Eigen::Matrix4d& patientFromView, bool isTool) const
{
  const bool isShadowed = m_isPrepared && m_opacities && m_opacityTexture;
  uniforms.set("isShadowed", isShadowed ? 1 : 0);
  // Also without: samplers of two kinds must not share a unit.
  uniforms.set("opacityTexture", int{OpacityUnit});
  uniforms.set("instrumentTexture", int{InstrumentUnit});
  if (!isShadowed)
    return;
  m_opacityTexture.bind(OpacityUnit);
  if (m_instrument.texture)
    m_instrument.texture.bind(InstrumentUnit);
  const Eigen::Matrix3d turn = patientFromView.topLeftCorner<3, 3>();
  const Eigen::Vector3d eye = patientFromView.topRightCorner<3, 1>();
  const core::GridGeometry& grid = m_contents.ct->geometry();
  uniforms.set("patientFromView", turn);
  uniforms.set("voxelFromView", Eigen::Matrix3d(grid.voxelFromPatientLinear() * turn));
  uniforms.set("eyeVoxel", grid.voxelFromPatient(eye));
  setDrawn(uniforms);
  setShadows(uniforms, frame);
  if (isTool)
    uniforms.set("toolBall", Eigen::Vector4d::Zero().eval());
}

void RayCaster::setShadows(GlUniforms& program, const Frame& frame) const
{
  if (!m_opacities)
    return;
  const core::GridGeometry& grid = m_contents.ct->geometry();
  const core::Index3& factor = m_opacities->factor();
  core::Index3 voxels = m_opacities->levels().front().dims;
  for (std::size_t a = 0; a < 3; ++a)
    voxels[a] *= factor[a];
  const TextureMap map = textureMap(voxels, factor);
  program.set("opacityScale", map.scale);
  program.set("opacityOffset", map.offset);
  const Eigen::Vector3d blocks(factor[0], factor[1], factor[2]);
  const Eigen::Matrix3d edges = grid.patientFromVoxelLinear() * blocks.asDiagonal();
  const double edge = edges.colwise().norm().mean();
  program.set("opacityEdges", edges);
  program.set("mmPerVoxel",
              Eigen::Vector3d(grid.voxelFromPatientLinear().rowwise().norm().cwiseInverse()));
  program.set("opacityEdge", edge);
  program.set("opacityLevels", static_cast<int>(m_opacities->levels().size()));

  // Each look-up stands for the distances up to half a step, on a logarithmic scale, before and
  // behind it; the last of them is the reach.
  constexpr double kNearest = 1.2; // texels
  const double last = optics::kOcclusionReach / std::sqrt(kSliceGrowth);
  const int before = std::max(
      0, static_cast<int>(std::floor(std::log(last / (kNearest * edge)) / std::log(kSliceGrowth))));
  program.set("nearestSlice", last / std::pow(kSliceGrowth, before));
  program.set("slices", before + 1);

  // A look-up reads at most one and a half of its texels away; of the lamp's, the last are widest.
  const double widest = std::max(optics::kShadowReach * optics::kLampTangent, edge);
  const double level = std::min(std::floor(std::log2(widest / edge) + 0.5),
                                static_cast<double>(m_opacities->levels().size()) - 1.0);
  const Eigen::Array3d margin = 1.5 * std::exp2(level) * blocks.array() + 0.01;
  const core::IndexBox& stopping = m_opacities->stopping();
  const auto corner = [&blocks](const core::Index3& texel) -> Eigen::Array3d
  { return blocks.array() * Eigen::Array3d(texel[0], texel[1], texel[2]) - 0.5; };
  const bool isNone = stopping.empty();
  program.set("stoppingLower", isNone ? Eigen::Vector3d::Constant(1e9).eval()
                                      : Eigen::Vector3d(corner(stopping.lower) - margin));
  program.set("stoppingUpper", isNone ? Eigen::Vector3d::Constant(-1e9).eval()
                                      : Eigen::Vector3d(corner(stopping.upper) + margin));

  const optics::Lamp& lamp = frame.lamp;
  Eigen::Vector4d at;
  at << lamp.at - (lamp.isFar ? Eigen::Vector3d::Zero().eval() : frame.view.origin),
      lamp.isFar ? 0.0 : 1.0;
  program.set("lamp", at);
  program.set("pictureUp", lamp.up);
  program.set("pictureRight", lamp.right);

  Eigen::Vector4d ball = Eigen::Vector4d::Zero();
  const bool isInstrument = hasInstrument(frame);
  program.set("hasInstrument", isInstrument ? 1 : 0);
  if (isInstrument)
  {
    const ToolPose& pose = *frame.tool;
    const InstrumentDistance& place = m_instrument.place;
    const TextureMap texels = textureMap(place.dims, {1, 1, 1}); // of samples
    ball << grid.voxelFromPatient(pose.center), 1.0;
    program.set("toolFromVoxel", Eigen::Matrix3d(pose.rotation.conjugate().toRotationMatrix() *
                                                 grid.patientFromVoxelLinear()));
    program.set("instrumentLower", place.lower);
    program.set("instrumentUpper", place.upper());
    program.set("instrumentScale", Eigen::Vector3d(texels.scale / place.edge));
    program.set(
        "instrumentOffset",
        Eigen::Vector3d(texels.offset - texels.scale.cwiseProduct(place.lower) / place.edge));
  }
  else if (hasPlainTool(frame))
  {
    const ToolPose& pose = *frame.tool;
    ball << grid.voxelFromPatient(pose.center), pose.radius;
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(pose.axisToHand, Eigen::Vector3d::UnitZ());
    program.set("toolFromVoxel",
                Eigen::Matrix3d(turn.toRotationMatrix() * grid.patientFromVoxelLinear()));
    program.set("toolParts", Eigen::Vector4d(tool::shaftRadius(pose), tool::kShaftLength,
                                             pose.handpiece ? tool::kHandpieceRadius : 0.0,
                                             tool::kShaftLength + tool::kHandpieceLength));
  }
  program.set("toolBall", ball);
}

// Adds the bricks of a box that contain tissue. Bricks emptied by an edit remain until the next
// rebuild.
void RayCaster::findTissue(const core::IndexBox& bricks)
{
  const core::Index3& dims = m_occupancy->dims();
  for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
    for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
    {
      const auto row =
          m_occupancy->texels().begin() +
          static_cast<std::ptrdiff_t>(dims[0]) * (j + static_cast<std::ptrdiff_t>(dims[1]) * k);
      int first = bricks.upper[0];
      int last = bricks.lower[0] - 1;
      for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
        if (row[i].flags & (OccupancyGrid::Tissue | OccupancyGrid::Soft))
        {
          first = std::min(first, i);
          last = i;
        }
      m_tissueBricks = m_tissueBricks.united({{first, j, k}, {last + 1, j + 1, k + 1}});
    }
}

// Pixel rectangle whose rays may meet tissue.
core::IndexBox RayCaster::tissueOnScreen(const Frame& frame, int width, int height) const
{
  const core::IndexBox whole{{0, 0, 0}, {width, height, 1}};
  if (frame.everywhere)
    return whole;
  if (m_tissueBricks.empty())
    return {};
  constexpr double margin = 0.01; // voxels; exceeds the error of single precision
  const RayView& view = frame.view;
  const Eigen::Matrix3d inverse = view.axes().inverse();
  Eigen::Array2d least = Eigen::Array2d::Constant(1e30);
  Eigen::Array2d most = -least;
  for (int corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d voxel;
    for (int a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<std::size_t>(a);
      voxel[a] = (corner >> a & 1) != 0 ? m_tissueBricks.upper[axis] * m_occupancy->edge() + margin
                                        : m_tissueBricks.lower[axis] * m_occupancy->edge() - margin;
    }
    const Eigen::Vector3d at =
        inverse * (m_contents.ct->geometry().patientFromVoxel(voxel) - view.origin);
    if (!view.parallel && !(at.z() > 0.0))
      return whole; // beside or behind the camera
    const Eigen::Array2d ndc = at.head<2>().array() / (view.parallel ? 1.0 : at.z());
    if (!ndc.isFinite().all())
      return whole;
    least = least.min(ndc);
    most = most.max(ndc);
  }
  core::IndexBox pixels = whole;
  for (std::size_t a = 0; a < 2; ++a)
  {
    const double size = whole.upper[a];
    const auto pixel = [&](double ndc, double more) {
      return static_cast<int>(std::clamp(std::floor(0.5 * (ndc + 1.0) * size) + more, 0.0, size));
    };
    const auto axis = static_cast<Eigen::Index>(a);
    pixels.lower[a] = pixel(least[axis], -1.0);
    pixels.upper[a] = pixel(most[axis], 2.0);
  }
  return pixels;
}

// Rays that miss all tissue are not cast: on SIMT hardware their pixels would pay for the code
// after a hit even without one.
void RayCaster::castRays(const core::IndexBox& pixels)
{
  if (pixels.empty())
    return;
  std::array<GLint, 4> before{};
  glGetIntegerv(GL_SCISSOR_BOX, before.data()); // VTK caches its state
  glEnable(GL_SCISSOR_TEST);
  glScissor(pixels.lower[0], pixels.lower[1], pixels.size()[0], pixels.size()[1]);
  m_triangle.draw();
  glDisable(GL_SCISSOR_TEST);
  glScissor(before[0], before[1], before[2], before[3]);
}

} // namespace petrous::rendering
