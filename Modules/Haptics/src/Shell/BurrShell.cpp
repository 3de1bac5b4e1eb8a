#include "petrous/Haptics/PointShell.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

#include "Covering.h"
#include "PointGrid.h"
#include "SphereCover.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::haptics
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kFelt = 0.02;            // voxels by which the ball may be felt too small
constexpr std::size_t kFewest = 100;      // on a burr, for any voxel size
const double kRowShare = std::sqrt(0.75); // ratio of row distance to point distance

void check(const char* what, double value, double least, double most)
{
  if (value >= least && value <= most)
    return;
  throw core::InvalidParameter(std::string("burr: ") + what + " is " + core::plainText(value) +
                               " mm; it must lie between " + core::plainText(least) + " and " +
                               core::plainText(most) + " mm");
}

BurrShape checked(BurrShape shape)
{
  check("the radius", shape.radius, 0.25, 5.0);
  if (shape.shaftRadius == 0.0)
    shape.shaftRadius = shape.resolvedShaftRadius();
  check("the shaft's radius", shape.shaftRadius, 0.01, shape.radius);
  check("the shaft's length", shape.shaftLength, 1.01 * shape.radius, 300.0);
  if (shape.handpieceRadius != 0.0)
  {
    check("the handpiece's radius", shape.handpieceRadius, shape.shaftRadius, 50.0);
    check("the handpiece's length", shape.handpieceLength, 0.1, 300.0);
  }
  return shape;
}

SphereCover coverBurr(double radius, double rim, double voxel, std::size_t most)
{
  const double spacing = std::sqrt(2.0 * kFelt * voxel / radius);
  std::size_t count = std::max(pointsToCover(rim, spacing), kFewest);
  for (int attempt = 0;; ++attempt)
  {
    count = std::min(count, most);
    SphereCover cover = coverSphere(rim, count);
    const double excess = std::pow(cover.spacing / spacing, 2);
    if (excess <= 1.0 || count == most || attempt == 7)
      return cover;
    count = static_cast<std::size_t>(static_cast<double>(count) * excess * 1.005) + 2;
  }
}

// Rows of points around the axis, each rotated by half a step against the previous one.
struct Rows
{
  double radius = 0.0; // of the cylinder, mm
  double start = 0.0;  // z of the first row
  double pitch = 0.0;  // between rows
  std::size_t rows = 0;
  std::size_t inRow = 0;
};

// Radius of the empty circle between the points of two rows, on the unrolled cylinder.
double hole(double step, double pitch)
{
  const double slant = 0.25 * step * step + pitch * pitch;
  return pitch >= 0.5 * step ? 0.5 * slant / pitch : slant / step;
}

// The rows with the smallest holes for at most `count` points, from `lead` of a pitch after `from`
// up to `to`.
Rows bestRows(double radius, double from, double to, double lead, std::size_t count)
{
  Rows best;
  double least = 0.0;
  for (std::size_t inRow = 3; 2 * inRow <= count; ++inRow)
  {
    const std::size_t rows = count / inRow;
    const double pitch = (to - from) / (static_cast<double>(rows - 1) + lead);
    const double step = 2.0 * kPi * radius / static_cast<double>(inRow);
    const double worst = std::max(hole(step, pitch), 0.5 * step);
    if (best.rows == 0 || worst < least)
    {
      least = worst;
      best = {radius, from + lead * pitch, pitch, rows, inRow};
    }
  }
  return best;
}

Eigen::Vector3d around(double radius, double angle, double z)
{
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

void add(PointShell& shell, const Rows& rows, bool firstIsEdge)
{
  for (std::size_t row = 0; row < rows.rows; ++row)
    for (std::size_t k = 0; k < rows.inRow; ++k)
    {
      const double angle = 2.0 * kPi * (static_cast<double>(k) + (row % 2 == 0 ? 0.0 : 0.5)) /
                           static_cast<double>(rows.inRow);
      const double z = rows.start + static_cast<double>(row) * rows.pitch;
      shell.points.push_back(around(rows.radius, angle, z));
      const bool edge = firstIsEdge && row == 0;
      shell.normals.push_back(around(1.0, angle, edge ? -1.0 : 0.0).normalized());
    }
}

// The disc between shaft and handpiece: rings about `step` apart, excluding its inner and outer
// rims.
void addDisc(PointShell& shell, double inner, double outer, double z, double step)
{
  const double width = outer - inner;
  const auto rings =
      static_cast<std::size_t>(std::max(0.0, std::round(width / (kRowShare * step) - 0.5)));
  const double pitch = width / (static_cast<double>(rings) + 0.5);
  for (std::size_t ring = 0; ring < rings; ++ring)
  {
    const double radius = inner + (static_cast<double>(ring) + 0.5) * pitch;
    const double count = std::max(3.0, std::round(2.0 * kPi * radius / step));
    for (double k = ring % 2 == 0 ? 0.0 : 0.5; k < count; k += 1.0)
    {
      shell.points.push_back(around(radius, 2.0 * kPi * k / count, z));
      shell.normals.emplace_back(0.0, 0.0, -1.0);
    }
  }
}

void addHandpiece(PointShell& shell, const BurrShape& shape, std::size_t count)
{
  const double radius = shape.handpieceRadius;
  const double disc = kPi * (radius * radius - shape.shaftRadius * shape.shaftRadius);
  const double side = 2.0 * kPi * radius * shape.handpieceLength;
  const std::size_t before = shell.points.size();
  std::size_t onDisc = count;
  // At least two rows of three are left for the side.
  for (double step = std::sqrt((disc + side) / (kRowShare * static_cast<double>(count)));
       onDisc + 6 > count; step *= 1.1)
  {
    shell.points.resize(before);
    shell.normals.resize(before);
    if (disc > 0.0)
      addDisc(shell, shape.shaftRadius, radius, shape.shaftLength, step);
    onDisc = shell.points.size() - before;
  }
  add(shell,
      bestRows(radius, shape.shaftLength, shape.shaftLength + shape.handpieceLength, 0.0,
               count - onDisc),
      disc > 0.0);
}

// Largest distance of shaft and handpiece to their nearest point; parameterised by arc length.
double measureSpacing(const PointShell& shell, const BurrShape& shape, double neck)
{
  const double inner = shape.shaftRadius;
  const double outer = shape.handpieceRadius;
  const double end = shape.shaftLength;
  const double area = 2.0 * kPi * (inner * end + outer * shape.handpieceLength);
  const auto count = static_cast<double>(shell.points.size() - shell.burrCount);
  const PointGrid grid(shell.points, std::sqrt(area / count));
  Covering covering(grid);
  const auto cylinder = [&](double radius, double from, double to)
  {
    covering.addRectangle(2.0 * kPi * radius, to - from,
                          [radius, from](const Eigen::Vector3d& p)
                          { return around(radius, p.x() / radius, from + p.y()); });
  };
  cylinder(inner, neck, end);
  if (outer > 0.0)
  {
    cylinder(outer, end, end + shape.handpieceLength);
    covering.addRectangle(2.0 * kPi * outer, outer - inner,
                          [&](const Eigen::Vector3d& p)
                          { return around(inner + p.y(), p.x() / outer, end); });
  }
  return covering.bound();
}

} // namespace

PointShell makeBurrShell(const BurrShape& wanted, double voxel, std::size_t budget)
{
  if (budget < 200 || budget > 20000)
    throw core::InvalidParameter("burr: a shell has 200 to 20000 points, not " +
                                 std::to_string(budget));
  check("the voxel", voxel, 0.01, 10.0);
  const BurrShape shape = checked(wanted);

  const SphereCover burr =
      coverBurr(shape.radius, shape.shaftRadius / shape.radius, voxel, budget / 5 * 4);
  PointShell shell;
  shell.normals = burr.points;
  for (const Eigen::Vector3d& point : burr.points)
    shell.points.push_back(shape.radius * point);
  shell.burrCount = shell.points.size();
  shell.burrSpacing = shape.radius * burr.spacing;

  // Shaft and handpiece get half of the rest each, but no denser than the burr.
  const double neck = shell.points.front().z();
  shell.burrRadius = shape.radius;
  shell.burrTop = neck;
  const double finest = std::sqrt(3.0) * shell.burrSpacing;
  const auto most = [finest](double radius, double length)
  {
    const double points = 2.0 * kPi * radius * length / (kRowShare * finest * finest);
    return std::max<std::size_t>(20, static_cast<std::size_t>(points));
  };
  const std::size_t left = budget - shell.burrCount;
  const bool hasHandpiece = shape.handpieceRadius > 0.0;
  const std::size_t onShaft =
      std::min(most(shape.shaftRadius, shape.shaftLength - neck), hasHandpiece ? left / 2 : left);
  add(shell, bestRows(shape.shaftRadius, neck, shape.shaftLength, 0.5, onShaft), false);
  if (hasHandpiece)
    addHandpiece(shell, shape,
                 std::min(most(shape.handpieceRadius, shape.handpieceLength), left - onShaft));

  for (const Eigen::Vector3d& point : shell.points)
    shell.reach = std::max(shell.reach, point.norm());
  shell.spacing = std::max(shell.burrSpacing, measureSpacing(shell, shape, neck));
  shell.solid = {shape.radius, shape.shaftRadius, shape.shaftLength, shape.handpieceRadius,
                 hasHandpiece ? shape.shaftLength + shape.handpieceLength : 0.0};
  return shell;
}

} // namespace petrous::haptics
