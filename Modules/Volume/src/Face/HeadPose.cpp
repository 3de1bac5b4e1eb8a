#include "HeadPose.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "petrous/Volume/ChebyshevDistance.h"

namespace petrous::volume
{

namespace
{

constexpr double kFit = 8.0; // mm; a surface that lies further off does not fit at all
constexpr double kDegree = 3.14159265358979 / 180.0;

class Mirror
{
public:
  explicit Mirror(const HeadCells& head)
    : m_head(head)
    , m_cap(std::clamp(static_cast<int>(std::lround(kFit / head.cells.edge())), 2, 16))
  {
    const CellSet& cells = head.cells;
    const core::Index3 n = cells.dims();
    const std::vector<std::uint8_t>& all = cells.cells();
    std::vector<std::uint8_t> marks(all.size(), 0);
    for (int k = 1; k + 1 < n[2]; ++k)
      for (int j = 1; j + 1 < n[1]; ++j)
        for (int i = 1; i + 1 < n[0]; ++i)
        {
          if ((all[cells.index(i, j, k)] & kHead) == 0)
            continue;
          const auto isAir = [&](int a, int b, int c)
          { return all[cells.index(i + a, j + b, k + c)] == kAirCell; };
          if (!(isAir(-1, 0, 0) || isAir(1, 0, 0) || isAir(0, -1, 0) || isAir(0, 1, 0) ||
                isAir(0, 0, -1) || isAir(0, 0, 1)))
            continue;
          marks[cells.index(i, j, k)] = 1;
          m_points.push_back(cells.center(i, j, k));
        }
    for (const Eigen::Vector3d& point : m_points)
      m_middle += point / static_cast<double>(m_points.size());
    m_distances = chebyshevDistances(marks.data(), 1, 1, n, {{0, 0, 0}, n}, m_cap);
  }

  const std::vector<Eigen::Vector3d>& points() const noexcept { return m_points; }
  const Eigen::Vector3d& middle() const noexcept { return m_middle; }

  // Of every `step`th point.
  double score(const Eigen::Vector3d& normal, double offset, std::size_t step) const
  {
    constexpr double kLeastKnown = 0.5;
    const CellSet& cells = m_head.cells;
    const core::Index3 n = cells.dims();
    std::size_t known = 0, asked = 0;
    double fit = 0.0;
    for (std::size_t p = 0; p < m_points.size(); p += step)
    {
      ++asked;
      const Eigen::Vector3d at = m_points[p] - 2.0 * (normal.dot(m_points[p]) - offset) * normal;
      std::size_t index = 0;
      if (!cells.find(at, index) || cells.cells()[index] == kOutside)
        continue;
      ++known;
      const auto row = static_cast<std::size_t>(n[0]);
      const std::size_t plane = row * static_cast<std::size_t>(n[1]);
      fit +=
          1.0 - static_cast<double>(m_distances.row(static_cast<int>(index % plane / row),
                                                    static_cast<int>(index / plane))[index % row]) /
                    m_cap;
    }
    return asked > 0 && static_cast<double>(known) >= kLeastKnown * static_cast<double>(asked)
               ? fit / static_cast<double>(known)
               : 0.0;
  }

private:
  const HeadCells& m_head;
  int m_cap;
  std::vector<Eigen::Vector3d> m_points;
  Eigen::Vector3d m_middle{0.0, 0.0, 0.0};
  DistanceBlock m_distances;
};

Eigen::Vector3d leftOf(double yaw, double roll)
{
  return {std::cos(yaw) * std::cos(roll), std::sin(yaw) * std::cos(roll), std::sin(roll)};
}

struct Turn
{
  double yaw = 0.0, roll = 0.0; // rad
  double offset = 0.0;          // of the plane from the middle of the surface, mm
  double score = 0.0;
};

// The best of the turns around one, `steps` of each size on both sides.
Turn refined(const Mirror& mirror, Turn best, double angle, double shift, int steps,
             std::size_t step)
{
  const Turn from = best;
  best.score = -1.0;
  for (int a = -steps; a <= steps; ++a)
    for (int b = -steps; b <= steps; ++b)
      for (int c = -steps; c <= steps; ++c)
      {
        Turn turn{from.yaw + a * angle, from.roll + b * angle, from.offset + c * shift, 0.0};
        const Eigen::Vector3d normal = leftOf(turn.yaw, turn.roll);
        turn.score = mirror.score(normal, normal.dot(mirror.middle()) + turn.offset, step);
        if (turn.score > best.score)
          best = turn;
      }
  return best;
}

} // namespace

std::vector<SymmetryPlane> symmetryPlanes(const HeadCells& head)
{
  const Mirror mirror(head);
  const auto& points = mirror.points();
  constexpr std::size_t kLeastPoints = 500, kCoarse = 600, kFine = 3000;
  if (points.size() < kLeastPoints)
    return {};
  constexpr int kYaws = 18, kRolls = 4, kShifts = 8;
  constexpr double kYaw = 5.0 * kDegree, kRoll = 10.0 * kDegree, kShift = 6.0;
  const std::size_t coarse = 1 + points.size() / kCoarse, fine = 1 + points.size() / kFine;
  std::vector<Turn> turns(static_cast<std::size_t>((2 * kYaws + 1) * (2 * kRolls + 1)));
  tbb::parallel_for(std::size_t{0}, turns.size(),
                    [&](std::size_t n)
                    {
                      Turn& best = turns[n];
                      best.yaw = (static_cast<int>(n) / (2 * kRolls + 1) - kYaws) * kYaw;
                      best.roll = (static_cast<int>(n) % (2 * kRolls + 1) - kRolls) * kRoll;
                      const Eigen::Vector3d normal = leftOf(best.yaw, best.roll);
                      for (int s = -kShifts; s <= kShifts; ++s)
                      {
                        const double offset = s * kShift;
                        const double score =
                            mirror.score(normal, normal.dot(mirror.middle()) + offset, coarse);
                        if (score > best.score)
                        {
                          best.score = score;
                          best.offset = offset;
                        }
                      }
                    });
  std::sort(turns.begin(), turns.end(),
            [](const Turn& a, const Turn& b) { return a.score > b.score; });
  std::vector<SymmetryPlane> planes;
  constexpr std::size_t kMost = 3;
  const double apart = std::cos(20.0 * kDegree);
  for (const Turn& turn : turns)
  {
    if (turn.score <= 0.0 || planes.size() == kMost)
      break;
    const auto isNear = [&](const Eigen::Vector3d& normal)
    {
      return std::any_of(planes.begin(), planes.end(),
                         [&](const SymmetryPlane& plane)
                         { return std::abs(plane.normal.dot(normal)) > apart; });
    };
    if (isNear(leftOf(turn.yaw, turn.roll)))
      continue;
    Turn best = refined(mirror, turn, 3.0 * kDegree, 3.0, 2, coarse);
    best = refined(mirror, best, 1.0 * kDegree, 1.0, 2, fine);
    const Eigen::Vector3d normal = leftOf(best.yaw, best.roll);
    if (isNear(normal))
      continue;
    planes.push_back({normal, normal.dot(mirror.middle()) + best.offset, best.score});
  }
  std::sort(planes.begin(), planes.end(),
            [](const SymmetryPlane& a, const SymmetryPlane& b) { return a.score > b.score; });
  return planes;
}

Eigen::Matrix3d headAxes(const Eigen::Vector3d& left, double pitch)
{
  const Eigen::Vector3d x = left.normalized();
  const Eigen::Vector3d back = (Eigen::Vector3d::UnitY() - x.y() * x).normalized();
  const Eigen::Vector3d y = Eigen::AngleAxisd(pitch, x) * back;
  Eigen::Matrix3d axes;
  axes << x.transpose(), y.transpose(), x.cross(y).transpose();
  return axes;
}

} // namespace petrous::volume
