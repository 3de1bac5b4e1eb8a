#include "petrous/Presenters/CameraPaths.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"
#include "petrous/Presenters/Measuring.h"

namespace petrous::presenters
{

namespace
{

using Eigen::Vector3d;

void checkFrames(int frames)
{
  if (frames < 2 || frames > kMaxFrames)
    throw core::InvalidParameter("a film has 2 to " + std::to_string(kMaxFrames) + " frames, not " +
                                 std::to_string(frames));
}

/// A line by its length.
class Polyline
{
public:
  explicit Polyline(const std::vector<Vector3d>& points)
  {
    for (const Vector3d& point : points)
    {
      const double step = m_points.empty() ? 0.0 : (point - m_points.back()).norm();
      if (!m_points.empty() && step < 1e-9)
        continue;
      m_way.push_back(m_points.empty() ? 0.0 : m_way.back() + step);
      m_points.push_back(point);
    }
    if (m_points.size() < 2)
      throw core::InvalidParameter("a flight needs a line of two different points");
  }

  double length() const { return m_way.back(); }

  /// Beyond its ends it goes on straight.
  Vector3d at(double way) const
  {
    std::size_t n =
        static_cast<std::size_t>(std::upper_bound(m_way.begin(), m_way.end(), way) - m_way.begin());
    n = std::clamp<std::size_t>(n, 1, m_points.size() - 1);
    const double share = (way - m_way[n - 1]) / (m_way[n] - m_way[n - 1]);
    return m_points[n - 1] + share * (m_points[n] - m_points[n - 1]);
  }

private:
  std::vector<Vector3d> m_points;
  std::vector<double> m_way; // mm from the first point
};

} // namespace

std::vector<core::CameraPose> turntable(const core::CameraPose& camera, int frames)
{
  checkFrames(frames);
  if (!(camera.viewUp.norm() > 0.0))
    throw core::InvalidParameter("the view has no up, about which it could turn");
  const Vector3d axis = camera.viewUp.normalized();
  std::vector<core::CameraPose> poses;
  for (int n = 0; n < frames; ++n)
  {
    constexpr double kTurn = 2.0 * 3.14159265358979323846;
    const Eigen::AngleAxisd turn(-kTurn * n / frames, axis);
    core::CameraPose pose = camera;
    pose.position = camera.focalPoint + turn * (camera.position - camera.focalPoint);
    poses.push_back(pose);
  }
  return poses;
}

std::vector<core::CameraPose> flight(const std::vector<Vector3d>& points, int frames)
{
  constexpr double kAhead = 3.0;      // mm: a corner of the line is seen to come
  constexpr double kViewAngle = 80.0; // degrees, as of an endoscope
  checkFrames(frames);
  const Polyline line(points);
  std::vector<core::CameraPose> poses;
  Vector3d up(0.0, 0.0, 1.0); // superior
  Vector3d before = Vector3d::Zero();
  for (int n = 0; n < frames; ++n)
  {
    const double way = line.length() * n / (frames - 1);
    core::CameraPose pose;
    pose.position = line.at(way);
    pose.focalPoint = line.at(way + kAhead);
    pose.viewAngle = kViewAngle;
    const Vector3d ahead = (pose.focalPoint - pose.position).normalized();
    if (n == 0 && up.cross(ahead).norm() < 0.2) // a line that goes up
      up = Vector3d(0.0, -1.0, 0.0);            // anterior
    if (n > 0)
      up = Eigen::Quaterniond::FromTwoVectors(before, ahead) * up;
    up = (up - up.dot(ahead) * ahead).normalized();
    pose.viewUp = up;
    before = ahead;
    poses.push_back(pose);
  }
  return poses;
}

std::vector<core::CameraPose> flightAlong(scene::Case& value, const std::string& structure,
                                          int frames, const core::Progress& progress)
{
  const auto poses = flight(alongStructure(value, structure, {}, progress).points, frames);
  if (scene::StructurePart* part = scene::findStructure(value, structure))
    part->look.shown = false;
  else if (scene::MeshPart* mesh = scene::findMesh(value, structure))
    mesh->look.shown = false;
  return poses;
}

} // namespace petrous::presenters
