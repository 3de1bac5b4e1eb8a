#include "petrous/Dissection/SweptSphereCut.h"

#include <algorithm>
#include <cmath>

namespace petrous::dissection
{

namespace
{

using volume::CutMask;

// Everything about the cut that does not change from voxel to voxel.
class Coverage
{
public:
  Coverage(const SweptSphere& burr, const core::GridGeometry& grid)
    : m_burr(burr)
    , m_axis(burr.to - burr.from)
    , m_axisSquared(m_axis.squaredNorm())
    , m_direction(grid.direction())
    , m_halfWidth(grid.spacing().norm())
    , m_bias(grid.spacing().cwiseAbs2() / 12.0)
    , m_biasLimit(0.25 * grid.minSpacing())
  {
  }

  double reach() const { return m_burr.radius + m_halfWidth + m_biasLimit; }

  double at(const Eigen::Vector3d& p) const
  {
    const double along = m_axisSquared > 0.0
                             ? std::clamp((p - m_burr.from).dot(m_axis) / m_axisSquared, 0.0, 1.0)
                             : 0.0;
    const Eigen::Vector3d offset = p - (m_burr.from + along * m_axis);
    const double rho = offset.norm();
    const double d = rho - m_burr.radius;
    if (d > m_halfWidth + m_biasLimit)
      return 0.0;
    return 0.5 - (d - curvatureBias(offset, rho, along)) / (2.0 * m_halfWidth);
  }

private:
  // sum_a h_a^2/12 e_a' H e_a, with the Hessian H of the distance: (I - nn')/rho beyond the ends
  // of the segment, (I - nn' - tt')/rho beside it.
  double curvatureBias(const Eigen::Vector3d& offset, double rho, double along) const
  {
    if (rho < 1e-9)
      return 0.0;
    const Eigen::Vector3d n = m_direction.transpose() * offset / rho;
    Eigen::Vector3d curvature = Eigen::Vector3d::Ones() - n.cwiseAbs2();
    if (along > 0.0 && along < 1.0)
    {
      const Eigen::Vector3d t = m_direction.transpose() * m_axis;
      curvature -= t.cwiseAbs2() / m_axisSquared;
    }
    return std::min(m_bias.dot(curvature) / rho, m_biasLimit);
  }

  SweptSphere m_burr;
  Eigen::Vector3d m_axis;
  double m_axisSquared;
  Eigen::Matrix3d m_direction;
  double m_halfWidth;
  Eigen::Vector3d m_bias;
  double m_biasLimit;
};

double protection(const ProtectedTissue& keep, const Eigen::Vector3d& patient)
{
  double most = 0.0;
  for (const auto& field : keep)
  {
    const Eigen::Vector3d voxel = field->geometry().voxelFromPatient(patient);
    if (field->geometry().hullContains(voxel))
      most = std::max(most, volume::sampleTrilinear(*field, voxel));
  }
  return most;
}

std::uint16_t quantised(double share)
{
  return static_cast<std::uint16_t>(
      std::lround(std::clamp(share, 0.0, 1.0) * double{CutMask::kUntouched}));
}

// Null when no voxel of the brick is lowered.
CutMask::BrickVersion cutBrick(const CutMask& mask, std::size_t index, const core::IndexBox& box,
                               const Coverage& burr, const ProtectedTissue& keep)
{
  constexpr int edge = CutMask::kBrickEdge;
  const CutMask::BrickVersion old = mask.brick(index);
  std::shared_ptr<CutMask::Brick> changed;
  const core::IndexBox part = mask.brickBox(index).intersected(box);
  const core::GridGeometry& grid = mask.geometry();
  for (int k = part.lower[2]; k < part.upper[2]; ++k)
    for (int j = part.lower[1]; j < part.upper[1]; ++j)
      for (int i = part.lower[0]; i < part.upper[0]; ++i)
      {
        const Eigen::Vector3d p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        const double taken = burr.at(p);
        if (taken <= 0.0)
          continue;
        double left = 1.0 - taken;
        if (!keep.empty())
          left = std::max(left, protection(keep, p));
        const std::size_t n =
            static_cast<std::size_t>(i % edge + edge * (j % edge + edge * (k % edge)));
        const std::uint16_t value = quantised(left);
        const std::uint16_t present = changed ? (*changed)[n]
                                      : old   ? (*old)[n]
                                              : CutMask::kUntouched;
        if (value >= present)
          continue;
        if (!changed)
        {
          changed = std::make_shared<CutMask::Brick>();
          if (old)
            *changed = *old;
          else
            changed->fill(CutMask::kUntouched);
        }
        (*changed)[n] = value;
      }
  return changed;
}

} // namespace

double coverage(const SweptSphere& burr, const core::GridGeometry& grid,
                const Eigen::Vector3d& patient) noexcept
{
  return std::clamp(Coverage(burr, grid).at(patient), 0.0, 1.0);
}

std::vector<std::size_t> cut(CutMask& mask, const SweptSphere& burr, const ProtectedTissue& keep)
{
  if (!(burr.radius > 0.0) || !std::isfinite(burr.radius))
    throw core::InvalidParameter("cut: the burr's radius must be above 0 mm");
  if (!burr.from.allFinite() || !burr.to.allFinite())
    throw core::InvalidParameter("cut: the burr's position is not finite");

  const Coverage shape(burr, mask.geometry());
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(shape.reach());
  const core::IndexBox box = mask.geometry().boxCovering(burr.from.cwiseMin(burr.to) - margin,
                                                         burr.from.cwiseMax(burr.to) + margin);
  std::vector<std::size_t> changed;
  const core::IndexBox bricks = mask.bricksCovering(box);
  for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
    for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
      for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
      {
        const std::size_t index = mask.brickIndex({i, j, k});
        if (auto version = cutBrick(mask, index, box, shape, keep))
        {
          mask.setBrick(index, std::move(version));
          changed.push_back(index);
        }
      }
  return changed;
}

} // namespace petrous::dissection
