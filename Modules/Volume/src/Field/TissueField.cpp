#include "petrous/Volume/TissueField.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "petrous/Core/HullClip.h"

namespace petrous::volume
{

namespace
{
// Surfaces are bracketed in steps of half the finest voxel; thinner walls are not resolved.
constexpr double kMarchStep = 0.5;
constexpr double kHitTolerance = 1e-4; // of the finest spacing
} // namespace

TissueField::TissueField(std::shared_ptr<const IntensityVolume> ct, std::vector<SolidUnion> solids,
                         std::shared_ptr<const CutMask> mask, const Parameters& parameters)
  : m_ct(std::move(ct))
  , m_solids(std::move(solids))
  , m_mask(std::move(mask))
  , m_parameters(parameters)
{
  if (!m_ct)
    throw core::InvalidParameter("tissue field: no CT given");
  if (!(parameters.scale > 0.0) || !std::isfinite(parameters.scale) ||
      !std::isfinite(parameters.iso))
    throw core::InvalidParameter("tissue field: iso must be finite and scale above 0 HU");
  if (m_mask && !sameGrid(m_mask->geometry(), m_ct->geometry()))
    throw core::InvalidParameter("tissue field: the mask does not lie on the CT's grid");
  m_solids.erase(std::remove(m_solids.begin(), m_solids.end(), nullptr), m_solids.end());
  m_finest = geometry().minSpacing();
  for (const SolidUnion& occupancy : m_solids)
    m_finest = std::min(m_finest, occupancy->geometry().minSpacing());
}

double TissueField::ctOperand(const Eigen::Vector3d& voxel) const
{
  return (m_ct->sample(voxel) - m_parameters.iso) / m_parameters.scale;
}

double TissueField::solidOperand(std::size_t solid, const Eigen::Vector3d& patient) const
{
  const Volume<float>& field = *m_solids[solid];
  const Eigen::Vector3d voxel = field.geometry().voxelFromPatient(patient);
  if (!field.geometry().hullContains(voxel))
    return -0.5;
  return sampleTrilinear(field, voxel) - 0.5;
}

TissueField::Decision TissueField::decide(const Eigen::Vector3d& patient) const
{
  const Eigen::Vector3d voxel = geometry().voxelFromPatient(patient);
  if (!geometry().hullContains(voxel))
    return {};
  Decision decision{ctOperand(voxel), Operand::Ct, 0};
  if (std::isnan(decision.value))
    decision.value = kAir; // a voxel without a value is not tissue
  for (std::size_t s = 0; s < m_solids.size(); ++s)
  {
    const double inside = solidOperand(s, patient);
    if (inside > decision.value)
      decision = {inside, Operand::Labels, s};
  }
  if (m_mask)
  {
    const double left = m_mask->sample(voxel) - 0.5;
    if (left < decision.value)
      decision = {left, Operand::Mask, 0};
  }
  return decision;
}

double TissueField::value(const Eigen::Vector3d& patient) const
{
  return decide(patient).value;
}

double TissueField::uncut(const Eigen::Vector3d& patient) const
{
  const Eigen::Vector3d voxel = geometry().voxelFromPatient(patient);
  if (!geometry().hullContains(voxel))
    return kAir;
  double result = ctOperand(voxel);
  if (std::isnan(result))
    result = kAir;
  for (std::size_t s = 0; s < m_solids.size(); ++s)
    result = std::max(result, solidOperand(s, patient));
  return result;
}

Eigen::Vector3d TissueField::normal(const Eigen::Vector3d& patient, double step) const
{
  return normalOf(decide(patient), patient, step, false);
}

Eigen::Vector3d TissueField::smoothNormal(const Eigen::Vector3d& patient) const
{
  return normalOf(decide(patient), patient, 1.0, true);
}

Eigen::Vector3d TissueField::normalOf(const Decision& decision, const Eigen::Vector3d& patient,
                                      double step, bool smooth) const
{
  const auto ctAt = [this](const Eigen::Vector3d& v) { return ctOperand(v); };
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  const Eigen::Vector3d voxel = geometry().voxelFromPatient(patient);
  switch (decision.operand)
  {
  case Operand::None:
    return gradient;
  case Operand::Ct:
    gradient = smooth ? edgeGradientInPatient(geometry(), voxel, ctAt)
                      : gradientInPatient(geometry(), voxel, step, ctAt);
    break;
  case Operand::Mask:
    gradient = gradientInPatient(geometry(), voxel, step,
                                 [this](const Eigen::Vector3d& v) { return m_mask->sample(v); });
    break;
  case Operand::Labels:
  {
    const Volume<float>& field = *m_solids[decision.solid];
    gradient = sampleGradient(field, field.geometry().voxelFromPatient(patient), step);
    break;
  }
  }
  const double length = gradient.norm();
  if (!(length > 1e-12))
    return Eigen::Vector3d::Zero();
  return -gradient / length;
}

std::optional<double> TissueField::firstHit(const Eigen::Vector3d& start,
                                            const Eigen::Vector3d& end) const
{
  const double length = (end - start).norm();
  const Eigen::Vector3d voxel = geometry().voxelFromPatient(start);
  const auto [first, last] =
      core::clipToHull(geometry(), voxel, geometry().voxelFromPatient(end) - voxel, 0.0, 1.0);
  if (last < first)
    return std::nullopt;
  if (length == 0.0)
    return value(start) > 0.0 ? std::optional<double>(0.0) : std::nullopt;

  const double h = m_finest;
  const Eigen::Vector3d direction = (end - start) / length;
  const auto solidAt = [&](double t) { return value(start + t * direction) > 0.0; };
  const double from = first * length;
  const double to = last * length;
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / (kMarchStep * h))));
  double air = from;
  if (solidAt(from))
    return from;
  for (int i = 1; i <= steps; ++i)
  {
    const double t = from + (to - from) * i / steps;
    if (!solidAt(t))
    {
      air = t;
      continue;
    }
    double solid = t;
    while (solid - air > kHitTolerance * h)
    {
      const double middle = 0.5 * (air + solid);
      (solidAt(middle) ? solid : air) = middle;
    }
    return 0.5 * (air + solid);
  }
  return std::nullopt;
}

} // namespace petrous::volume
