#include "TissueOptics.h"

#include <algorithm>
#include <cmath>

#include "SceneCheck.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/SceneField.h"
#include "petrous/Rendering/ThicknessColor.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::rendering
{

namespace
{

constexpr double kScale = 1000.0; // HU; only the unit of f

const SceneContents& checked(const SceneContents& contents)
{
  if (!contents.ct)
    throw RenderingError(RenderingError::Reason::BadContents, "picture: there is no CT");
  checkContents(contents);
  checkMaterials(contents);
  return contents;
}

} // namespace

TissueOptics::TissueOptics(const SceneContents& contents, int sample)
  : m_ct(checked(contents).ct)
  , m_occupancy(contents.labels ? contents.labels->occupancy : nullptr)
  , m_index(contents.labels ? contents.labels->index : nullptr)
  , m_borders(contents.labels ? contents.labels->borders : nullptr)
  , m_second(contents.second)
  , m_third(contents.third)
  , m_materials(contents.materials)
  , m_softTissue(contents.softTissue && !contents.softTissue->transfer.transparent()
                     ? contents.softTissue
                     : std::nullopt)
  , m_mask(contents.mask)
  , m_iso(contents.iso)
  , m_boneShown(contents.boneShown)
  , m_light(contents.light)
  , m_thickness(contents.thickness)
  , m_section(contents.section)
  , m_field(sceneField(contents))
  , m_aside(optics::asideOf(m_ct->geometry(), sample))
{
  if (m_materials.empty())
    m_materials.emplace_back();
}

double TissueOptics::occupancyAt(const Eigen::Vector3d& patient) const
{
  if (!m_occupancy)
    return 0.0;
  const Eigen::Vector3d voxel = m_occupancy->geometry().voxelFromPatient(patient);
  return m_occupancy->geometry().hullContains(voxel) ? volume::sampleTrilinear(*m_occupancy, voxel)
                                                     : 0.0;
}

std::size_t TissueOptics::indexAt(const Eigen::Vector3d& patient) const
{
  return m_index ? indexOfVoxel(m_index->geometry().voxelFromPatient(patient)) : 0;
}

// Of the voxel nearest to a position; 0 outside the grid.
std::size_t TissueOptics::indexOfVoxel(const Eigen::Vector3d& voxel) const
{
  core::Index3 nearest{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double rounded = std::floor(voxel[static_cast<Eigen::Index>(a)] + 0.5);
    if (!(rounded >= 0.0 && rounded < m_index->geometry().dims()[a]))
      return 0;
    nearest[a] = static_cast<int>(rounded);
  }
  return m_index->at(nearest[0], nearest[1], nearest[2]);
}

// Depth of a voxel in a structure, negative in another one; without borders 1 or 0.
double TissueOptics::depthIn(std::size_t index, const Eigen::Vector3d& voxel) const
{
  const bool inside = indexOfVoxel(voxel) == index;
  if (!m_borders)
    return inside ? 1.0 : 0.0;
  const core::Index3 at{static_cast<int>(voxel[0]), static_cast<int>(voxel[1]),
                        static_cast<int>(voxel[2])};
  if (!m_borders->geometry().fullBox().contains(at))
    return 0.0;
  const double depth = m_borders->at(at[0], at[1], at[2]) & volume::kDeepest;
  return inside ? depth : -depth;
}

// Only inside structures.
volume::StructureChoice TissueOptics::structureAt(const Eigen::Vector3d& patient) const
{
  return m_index ? volume::structureAt(*m_index, m_borders.get(),
                                       m_index->geometry().voxelFromPatient(patient))
                 : volume::StructureChoice();
}

TissueOptics::Place TissueOptics::at(const Eigen::Vector3d& patient) const
{
  const double f = m_field.value(patient);
  if (!(f > 0.0))
  {
    if (!m_softTissue)
      return {kAir, -f};
    const double left =
        m_mask ? m_mask->sample(m_mask->geometry().voxelFromPatient(patient)) - 0.5 : 0.5;
    // Also where the CT is no part of f.
    const double bone = (m_ct->sample(m_ct->geometry().voxelFromPatient(patient)) - m_iso) / kScale;
    const bool isSoft = left > 0.0 && !(m_field.uncut(patient) > 0.0) && !(bone > 0.0);
    return isSoft ? Place{kSoft, std::min({-f, left, std::isnan(bone) ? -f : -bone})}
                  : Place{kAir, std::max({-left, bone, 0.0})};
  }
  const double inside = occupancyAt(patient) - 0.5;
  if (inside > 0.0)
  {
    const volume::StructureChoice structure = structureAt(patient);
    return {kBone + 1 + static_cast<State>(structure.index),
            std::min({f, inside, structure.margin})};
  }
  return {kBone, std::min(f, -inside)};
}

bool TissueOptics::isSurface(State from, State to) const
{
  if (!isSolid(to))
    return m_light.exitSurfaces && isSolid(from);
  return from != to && (!isSolid(from) || to > kBone);
}

const appearance::Material& TissueOptics::materialOf(State state) const
{
  if (state == kSoft)
    return *m_softTissue;
  return m_materials[state == kBone ? 0 : static_cast<std::size_t>(state - kBone - 1)];
}

double TissueOptics::facingIn(State state, const Eigen::Vector3d& patient,
                              const Eigen::Vector3d& ray) const
{
  if (state != kSoft)
    return optics::kInteriorFacing;
  const core::GridGeometry& grid = m_ct->geometry();
  const Eigen::Vector3d gradient =
      volume::gradientInPatient(grid, grid.voxelFromPatient(patient), 1.0,
                                [&](const Eigen::Vector3d& voxel)
                                { return intensity(*m_softTissue, grid.patientFromVoxel(voxel)); });
  return optics::softFacing(gradient, ray, optics::softEdge(m_softTissue->transfer));
}

const appearance::Material& TissueOptics::surfaceMaterial(const Eigen::Vector3d& patient) const
{
  if (occupancyAt(patient) > optics::kOccupancyThreshold)
    return m_materials[structureAt(patient).index];
  const appearance::Material& material = m_materials[indexAt(patient)];
  return material.lumen ? material : m_materials.front();
}

double TissueOptics::intensity(const appearance::Material& material,
                               const Eigen::Vector3d& patient) const
{
  if (material.source != appearance::IntensitySource::Ct)
  {
    const SecondImage& image =
        material.source == appearance::IntensitySource::Third ? m_third : m_second;
    return image.volume->sample(
        image.volume->geometry().voxelFromPatient(image.secondFromCt * patient));
  }
  return m_ct->sample(m_ct->geometry().voxelFromPatient(patient));
}

Eigen::Vector3d TissueOptics::occupancyNormal(const Eigen::Vector3d& patient) const
{
  const Eigen::Vector3d voxel = m_occupancy->geometry().voxelFromPatient(patient);
  const Eigen::Vector3d slope = volume::sampleGradient(*m_occupancy, voxel, 1.0);
  return slope.norm() > 1e-12 ? (-slope.normalized()).eval() : Eigen::Vector3d::Zero().eval();
}

// Out of a structure: along the negative gradient of the depth in it (without borders, of its
// fraction of the neighbourhood), with quadratic B-spline weights.
Eigen::Vector3d TissueOptics::borderNormal(const Eigen::Vector3d& patient, std::size_t index) const
{
  const core::GridGeometry& grid = m_index->geometry();
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  const Eigen::Vector3d nearest = (voxel.array() + 0.5).floor();
  const Eigen::Vector3d d = voxel - nearest;
  const auto weight = [&d](int axis, int step)
  { return step == 0 ? 0.75 - d[axis] * d[axis] : 0.5 * std::pow(0.5 + step * d[axis], 2.0); };
  const auto change = [&d](int axis, int step)
  { return step == 0 ? -2.0 * d[axis] : step * (0.5 + step * d[axis]); };
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(); // per voxel
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        slope += depthIn(index, nearest + Eigen::Vector3d(i, j, k)) *
                 Eigen::Vector3d(change(0, i) * weight(1, j) * weight(2, k),
                                 weight(0, i) * change(1, j) * weight(2, k),
                                 weight(0, i) * weight(1, j) * change(2, k));
  slope = grid.voxelFromPatientLinear().transpose() * slope;
  return slope.norm() > 1e-12 ? (-slope.normalized()).eval() : Eigen::Vector3d::Zero().eval();
}

// The colour that replaces bone's own.
std::optional<std::array<double, 3>> TissueOptics::overlayAt(const Eigen::Vector3d& patient) const
{
  if (!m_thickness.distance)
    return std::nullopt;
  const core::GridGeometry& grid = m_thickness.distance->geometry();
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  if (!grid.hullContains(voxel))
    return std::nullopt;
  const double fraction =
      volume::sampleTrilinear(*m_thickness.distance, voxel) / m_thickness.farthest;
  return fraction < 1.0 ? std::optional(thicknessColor(fraction)) : std::nullopt;
}

const appearance::Material& TissueOptics::surfaceMaterial(const Eigen::Vector3d& patient,
                                                          State from, State to) const
{
  return from > kBone && to > kBone ? materialOf(to) : surfaceMaterial(patient);
}

Eigen::Vector3d TissueOptics::normalAt(const Eigen::Vector3d& patient, State from, State to) const
{
  if (from > kBone && to > kBone)
    return borderNormal(patient, static_cast<std::size_t>(to - kBone - 1));
  if (from == kBone && to > kBone)
    return occupancyNormal(patient);
  return isSmooth(patient) ? m_field.smoothNormal(patient) : m_field.normal(patient);
}

// Whether the CT's surface is shaded without the steps of its slices.
bool TissueOptics::isSmooth(const Eigen::Vector3d& patient) const
{
  return double{surfaceMaterial(patient).surfaceOpacity} >= optics::kSmoothOpacity;
}

// Whether the mask decides at a surface towards air.
bool TissueOptics::isCut(const Eigen::Vector3d& patient) const
{
  return m_mask && m_mask->sample(m_mask->geometry().voxelFromPatient(patient)) - 0.5 <
                       m_field.uncut(patient);
}

// The CT's gradient that gave the normal, intensity per mm; only where the CT decides.
std::optional<Eigen::Vector3d> TissueOptics::ctGradientAt(const Eigen::Vector3d& patient,
                                                          State from, State to) const
{
  const core::GridGeometry& grid = m_ct->geometry();
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  const auto ctAt = [this](const Eigen::Vector3d& v) { return m_ct->sample(v); };
  const double bone = (ctAt(voxel) - m_iso) / kScale;
  const bool isCut = m_mask && m_mask->sample(voxel) - 0.5 < bone;
  if ((isSolid(from) && isSolid(to)) || isCut || !m_boneShown || occupancyAt(patient) - 0.5 > bone)
    return std::nullopt;
  return isSmooth(patient) ? volume::edgeGradientInPatient(grid, voxel, ctAt)
                           : volume::gradientInPatient(grid, voxel, 1.0, ctAt);
}

// Beside a surface at a point, clamped to the hull.
Eigen::Vector3d TissueOptics::gradientAside(const Eigen::Vector3d& patient) const
{
  const core::GridGeometry& grid = m_ct->geometry();
  const core::Index3& dims = grid.dims();
  const Eigen::Vector3d last(dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0);
  const Eigen::Vector3d voxel =
      (grid.voxelFromPatient(patient) + m_aside).cwiseMax(0.0).cwiseMin(last);
  return volume::edgeGradientInPatient(
      grid, voxel, [this](const Eigen::Vector3d& v) { return m_ct->sample(v); });
}

// Only with a section.
TissueOptics::Surface TissueOptics::sectionAt(const Eigen::Vector3d& patient, double opacity) const
{
  const double value = m_ct->sample(m_ct->geometry().voxelFromPatient(patient));
  return {Eigen::Vector3d::Constant(optics::sectionGrey(*m_section, value)), opacity, false};
}

std::optional<TissueOptics::Surface> TissueOptics::softSection(const Eigen::Vector3d& patient) const
{
  if (!m_section || !m_softTissue)
    return std::nullopt;
  const auto look = m_softTissue->transfer.at(intensity(*m_softTissue, patient));
  if (!(look.extinction > optics::kSoftInSection))
    return std::nullopt;
  if (m_softTissue->source == appearance::IntensitySource::Ct)
    return sectionAt(patient, 1.0);
  return Surface{{look.color[0], look.color[1], look.color[2]}, 1.0, false};
}

TissueOptics::Surface TissueOptics::surfaceAt(const PixelRay& ray, double t, State from, State to,
                                              const std::optional<Eigen::Vector3d>& face,
                                              const optics::Seen& seen, double focus) const
{
  const Eigen::Vector3d point = ray.origin + t * ray.direction;
  const appearance::Material& material = surfaceMaterial(point, from, to);
  if (face && m_section && &material == &m_materials.front())
    return sectionAt(point, material.surfaceOpacity);
  const Eigen::Vector3d normal = face ? *face : normalAt(point, from, to);
  Eigen::Vector3d below = point;
  if (!face)
    below -= optics::kColorDepth * m_ct->geometry().minSpacing() * normal;
  const double cosine = normal.norm() > 0.0 ? normal.dot(ray.direction) : 1.0;
  auto look = material.transfer.at(intensity(material, below));
  std::optional<std::array<double, 3>> overlay;
  const bool isBony = !face && (&material == &m_materials.front() || material.lumen);
  if (isBony)
    overlay = overlayAt(point);
  if (isBony && m_light.grain > 0.0 && !(isSolid(from) && isSolid(to)) && isCut(point))
  {
    const core::GridGeometry& grid = m_ct->geometry();
    const double factor = optics::grainFactor(grid, grid.voxelFromPatient(point), cosine,
                                              ray.pixelAt(t), m_light.grain);
    for (double& channel : look.color)
      channel = std::min(channel * factor, 1.0);
  }
  look.color = overlay.value_or(look.color);
  if (face && m_section)
    return {{look.color[0], look.color[1], look.color[2]}, material.surfaceOpacity, false};
  double opacity = material.surfaceOpacity;
  double lit = cosine;
  const bool hasEdge = !face && m_light.edges > 0.0 && opacity < 1.0;
  const bool isAside = !face && !m_aside.isZero() && opacity >= optics::kSmoothOpacity;
  const std::optional<Eigen::Vector3d> gradient =
      hasEdge || isAside ? ctGradientAt(point, from, to) : std::nullopt;
  if (hasEdge)
    opacity = optics::edgeOpacity(
        opacity, gradient ? optics::edgeFacing(cosine, gradient->norm()) : cosine, m_light.edges);
  if (isAside && gradient)
    lit = optics::asideFacing(*gradient, gradientAside(point), ray.direction);
  return {optics::surfaceColor(look, material.shininess, lit, m_light, t, seen, focus,
                               overlay.has_value()),
          opacity, !overlay};
}

} // namespace petrous::rendering
