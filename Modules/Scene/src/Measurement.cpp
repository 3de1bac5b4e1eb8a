#include "petrous/Scene/Measurement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

#include <Eigen/Geometry>

#include "petrous/Core/NumberText.h"
#include "petrous/Scene/Case.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::scene
{

namespace
{

using Kind = Measurement::Kind;
using Points = std::vector<Eigen::Vector3d>;

constexpr std::array<const char*, 6> kKinds{"mark",  "distance", "length",
                                            "angle", "area",     "thickness"};
constexpr double kDegree = 57.29577951308232; // per rad

void require(bool holds, const std::string& what)
{
  if (!holds)
    throw core::InvalidParameter("measurement: " + what);
}

// Of the polygon's corners, half their sum of cross products: its length is the area, its direction
// the normal [Newell].
Eigen::Vector3d vectorArea(const Points& polygon)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < polygon.size(); ++n)
    sum += (polygon[n] - polygon[0]).cross(polygon[(n + 1) % polygon.size()] - polygon[0]);
  return 0.5 * sum;
}

Eigen::Vector3d meanOf(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points)
    sum += point;
  return sum / static_cast<double>(points.size());
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Whether two edges that share no corner cross, as seen along the normal.
bool crosses(const Points& polygon, const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3d& point : polygon)
    flat.emplace_back(u.dot(point - polygon[0]), v.dot(point - polygon[0]));
  const std::size_t count = flat.size();
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t m = n + 2; m < count; ++m)
    {
      if ((m + 1) % count == n)
        continue;
      const auto &a = flat[n], &b = flat[n + 1], &c = flat[m], &d = flat[(m + 1) % count];
      if (turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0)
        return true;
    }
  return false;
}

std::optional<double> areaOf(const Points& polygon)
{
  const Eigen::Vector3d sum = vectorArea(polygon);
  const double area = sum.norm();
  Eigen::Vector3d normal = area > 0.0 ? Eigen::Vector3d(sum / area) : Eigen::Vector3d::UnitZ();
  if (area == 0.0) // a figure of eight has a plane all the same
    for (std::size_t n = 1; n + 1 < polygon.size(); ++n)
      if (const Eigen::Vector3d across =
              (polygon[n] - polygon[0]).cross(polygon[n + 1] - polygon[0]);
          across.norm() > 0.0)
        normal = across.normalized();
  return crosses(polygon, normal) ? std::nullopt : std::optional<double>(area);
}

std::optional<double> angleOf(const Points& points)
{
  const Eigen::Vector3d a = points[0] - points[1];
  const Eigen::Vector3d b = points[2] - points[1];
  if (a.norm() == 0.0 || b.norm() == 0.0)
    return std::nullopt;
  return kDegree * std::atan2(a.cross(b).norm(), a.dot(b));
}

bool isName(const std::string& name)
{
  return !name.empty() && core::isUtf8(name) && name == withoutInvisible(name);
}

} // namespace

bool operator==(const Measurement& a, const Measurement& b)
{
  return std::tie(a.kind, a.name, a.points, a.shown, a.structure, a.structureGone, a.image,
                  a.images, a.readings) == std::tie(b.kind, b.name, b.points, b.shown, b.structure,
                                                    b.structureGone, b.image, b.images, b.readings);
}

const std::string& imageOf(const Measurement& measurement, std::size_t point)
{
  return point < measurement.images.size() ? measurement.images[point] : measurement.image;
}

void setImages(Measurement& measurement, std::vector<std::string> images)
{
  const bool isOne = std::all_of(images.begin(), images.end(),
                                 [&](const std::string& one) { return one == images.front(); });
  measurement.image = isOne && !images.empty() ? images.front() : std::string();
  measurement.images = isOne ? std::vector<std::string>() : std::move(images);
}

void setReadings(const Case& value, Measurement& measurement, std::optional<std::size_t> point)
{
  const std::size_t count = measurement.points.size();
  const auto isSetNow = [&point](std::size_t n) { return !point || n == *point; };
  std::vector<std::string> before, now; // images of the points that were set before, and now
  for (std::size_t n = 0; n < count; ++n)
    (isSetNow(n) ? now : before).push_back(imageOf(measurement, n));
  MrReadings& readings = measurement.readings;
  readings.erase(
      std::remove_if(readings.begin(), readings.end(),
                     [&before](const MrReading& one)
                     { return std::find(before.begin(), before.end(), one.mr) == before.end(); }),
      readings.end());
  for (const std::string& image : now)
    if (const ImagePart* mr = findMr(value, image))
      addReadings(readings, {readingOf(*mr)});
}

std::string outdatedPoints(const Case& value, const Measurement& measurement, const std::string& mr)
{
  MrReadings ofIt;
  std::copy_if(measurement.readings.begin(), measurement.readings.end(), std::back_inserter(ofIt),
               [&mr](const MrReading& one) { return one.mr == mr; });
  return outdatedReading(value, ofIt, MadeFromMr::Points);
}

std::vector<std::string> forgetStructure(std::vector<Measurement>& measurements,
                                         const std::string& structure)
{
  std::vector<std::string> names;
  for (Measurement& one : measurements)
    if (!structure.empty() && one.structure == structure && !one.structureGone)
    {
      one.structureGone = true;
      names.push_back(one.name);
    }
  return names;
}

void recallStructure(std::vector<Measurement>& measurements, const std::string& structure,
                     const std::vector<std::string>& names)
{
  for (Measurement& one : measurements)
    if (one.structure == structure && std::count(names.begin(), names.end(), one.name) > 0)
      one.structureGone = false;
}

const char* nameOf(Kind kind) noexcept
{
  return kKinds[static_cast<std::size_t>(kind)];
}

Kind measurementKindFrom(const std::string& name)
{
  const auto* const at = std::find(kKinds.begin(), kKinds.end(), name);
  if (at == kKinds.end())
    throw core::InvalidParameter("a measurement must be a mark, distance, length, angle, area or "
                                 "thickness");
  return static_cast<Kind>(std::distance(kKinds.begin(), at));
}

PointCount pointsOf(Kind kind) noexcept
{
  switch (kind)
  {
  case Kind::Mark:
    return {1, 1};
  case Kind::Distance:
    return {2, 2};
  case Kind::Length:
    return {2, Measurement::kMostPoints};
  case Kind::Angle:
    return {3, 3};
  case Kind::Area:
    return {3, Measurement::kMostCorners};
  case Kind::Thickness:
    break;
  }
  return {2, 3};
}

void checkMeasurements(const std::vector<Measurement>& measurements)
{
  require(measurements.size() <= Measurement::kMax,
          "a case has at most " + std::to_string(Measurement::kMax));
  std::set<std::string> names;
  for (const Measurement& one : measurements)
  {
    require(isName(one.name) && one.name.size() <= Measurement::kLongestName,
            "a name must be 1 to " + std::to_string(Measurement::kLongestName) +
                " bytes of UTF-8 without control characters or characters that are not seen, and "
                "without blanks at its ends");
    require(names.insert(lowerCase(one.name)).second, "two have one name");
    const auto [least, most] = pointsOf(one.kind);
    require(one.points.size() >= least && one.points.size() <= most,
            std::string("of the kind ") + nameOf(one.kind) + " it has " + std::to_string(least) +
                (most > least ? " to " + std::to_string(most) : "") + " points, not " +
                std::to_string(one.points.size()));
    for (const Eigen::Vector3d& point : one.points)
      require(point.allFinite() && point.cwiseAbs().maxCoeff() <= Measurement::kFarthest,
              "a coordinate must lie within 100 m");
    for (const std::string* part : {&one.structure, &one.image})
      if (!part->empty())
        checkPartName(*part);
    require(one.images.empty() || one.images.size() == one.points.size(),
            "it has " + std::to_string(one.points.size()) + " points, but images of " +
                std::to_string(one.images.size()));
    for (const std::string& image : one.images)
      if (!image.empty())
        checkPartName(image);
  }
}

std::size_t findMeasurement(const Case& value, const std::string& name)
{
  const std::string wanted = lowerCase(name);
  std::string there;
  for (std::size_t n = 0; n < value.measurements.size(); ++n)
  {
    if (lowerCase(value.measurements[n].name) == wanted)
      return n;
    there += (there.empty() ? "; it has " : ", ") + value.measurements[n].name;
  }
  throw core::InvalidParameter("case '" + value.name + "' has no measurement '" + name + "'" +
                               (there.empty() ? "; it has none" : there));
}

std::string freeMeasurementName(const std::vector<Measurement>& there, const std::string& name)
{
  const auto isTaken = [&there](const std::string& text)
  {
    return std::any_of(there.begin(), there.end(),
                       [wanted = lowerCase(text)](const Measurement& one)
                       { return lowerCase(one.name) == wanted; });
  };
  std::string unused = name;
  for (int n = 2; isTaken(unused); ++n)
  {
    const std::string number = " " + std::to_string(n);
    unused = core::utf8Prefix(name, Measurement::kLongestName - number.size()) + number;
  }
  return unused;
}

std::optional<double> valueOf(Kind kind, const Points& points)
{
  if (points.size() < pointsOf(kind).least)
    return std::nullopt;
  switch (kind)
  {
  case Kind::Mark:
    return std::nullopt;
  case Kind::Distance:
  case Kind::Thickness:
    return (points[1] - points[0]).norm();
  case Kind::Length:
  {
    double length = 0.0;
    for (std::size_t n = 1; n < points.size(); ++n)
      length += (points[n] - points[n - 1]).norm();
    return length;
  }
  case Kind::Angle:
    return angleOf(points);
  case Kind::Area:
    break;
  }
  return areaOf(points);
}

const char* unitOf(Kind kind) noexcept
{
  return kind == Kind::Angle ? "°" : kind == Kind::Area ? "mm²" : "mm";
}

double offPlane(const Points& polygon)
{
  const Eigen::Vector3d sum = vectorArea(polygon);
  if (sum.norm() == 0.0)
    return 0.0;
  const Eigen::Vector3d middle = meanOf(polygon);
  double most = 0.0;
  for (const Eigen::Vector3d& point : polygon)
    most = std::max(most, std::abs(sum.normalized().dot(point - middle)));
  return most;
}

} // namespace petrous::scene
