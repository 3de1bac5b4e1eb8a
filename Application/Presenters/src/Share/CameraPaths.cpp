#include "petrous/Presenters/CameraPaths.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/Measuring.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Rendering/SceneField.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Volume/LabelBorders.h"
#include "petrous/Volume/MeshInside.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::presenters
{

namespace
{

using Eigen::Vector3d;

constexpr double kAhead = 3.0;    // mm: a corner of the line is seen to come
constexpr double kShortest = 1.0; // mm that the cameras of a flight are apart at least
constexpr double kSampling = 0.1; // mm along the line
constexpr char kStep[] = "looking for a free way";

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

  double length() const { return m_way.back(); } // mm

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

std::vector<core::CameraPose> flightBetween(const Polyline& line, double from, double to,
                                            int frames)
{
  constexpr double kViewAngle = 80.0; // degrees, as of an endoscope
  checkFrames(frames);
  std::vector<core::CameraPose> poses;
  Vector3d up(0.0, 0.0, 1.0); // superior
  Vector3d before = Vector3d::Zero();
  for (int n = 0; n < frames; ++n)
  {
    const double way = from + (to - from) * n / (frames - 1);
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

// What is drawn within kFlightClearance of a point.
struct Here
{
  bool isClosed = false; // by bone or the edge of the image
  std::set<std::string> parts;
};

// What is drawn of a case, for points and lines in the CT.
class Surroundings
{
public:
  Surroundings(const scene::Case& value, const rendering::SceneContents& contents,
               const core::Progress& progress)
    : m_bone(rendering::boneField(contents))
    , m_structures(rendering::structureField(contents))
  {
    takeNames(value, contents);
    for (const rendering::MeshContents& mesh : contents.meshes)
    {
      const double done = static_cast<double>(m_meshes.size());
      progress.report(done / static_cast<double>(contents.meshes.size()), kStep);
      volume::MeshTree tree(*mesh.mesh);
      progress.check(kStep);
      m_meshes.push_back({mesh.name, std::move(tree), volume::MeshInside(*mesh.mesh)});
    }
  }

  /// Structures and meshes were hidden since; the meshes that stay are as they were.
  void hide(const scene::Case& value, const rendering::SceneContents& contents)
  {
    m_structures = rendering::structureField(contents);
    takeNames(value, contents);
    const auto isHidden = [&](const Mesh& mesh)
    {
      return std::none_of(contents.meshes.begin(), contents.meshes.end(),
                          [&](const rendering::MeshContents& one)
                          { return one.name == mesh.name; });
    };
    m_meshes.erase(std::remove_if(m_meshes.begin(), m_meshes.end(), isHidden), m_meshes.end());
  }

  Here around(const Vector3d& point) const
  {
    Here here;
    for (int n = 0; n < 27; ++n) // the point itself, and the ball around it
    {
      const Vector3d way(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const Vector3d at = point + kFlightClearance * way / std::max(way.norm(), 1.0);
      const core::GridGeometry& grid = m_bone.geometry();
      if (!grid.hullContains(grid.voxelFromPatient(at)) || m_bone.value(at) > 0.0)
        here.isClosed = true;
      else if (m_structures.value(at) > 0.0)
        here.parts.insert(structureAt(at));
    }
    for (const Mesh& mesh : m_meshes)
      if (mesh.tree.distance(point, kFlightClearance) < kFlightClearance ||
          (mesh.inside.openEdges() == 0 && mesh.inside.contains(point)))
        here.parts.insert(mesh.name);
    return here;
  }

  // Whether most of what a camera looks at is near.
  bool fillsView(const Vector3d& from, const Vector3d& ahead) const
  {
    constexpr double kSight = 40.0; // mm
    constexpr int kAround = 8;
    const Vector3d u = ahead.unitOrthogonal();
    const Vector3d v = ahead.cross(u);
    int met = 0;
    for (int n = 0; n <= kAround; ++n)
    {
      constexpr double kTurn = 2.0 * 3.14159265358979323846 / kAround;
      constexpr double kTangent = 0.6; // three quarters of the way to the picture's edge
      const double turn = kTurn * n;
      const Vector3d aside =
          n < kAround ? (std::cos(turn) * u + std::sin(turn) * v).eval() : Vector3d::Zero().eval();
      met += meets(from, (ahead + kTangent * aside).normalized(), kSight) ? 1 : 0;
    }
    return 2 * met > kAround + 1;
  }

private:
  struct Mesh
  {
    std::string name;
    volume::MeshTree tree;
    volume::MeshInside inside;
  };

  void takeNames(const scene::Case& value, const rendering::SceneContents& contents)
  {
    m_labels = contents.labels;
    m_names.clear();
    for (const scene::StructurePart* part :
         scene::labelSources(value, [](const auto& look) { return look.shown; }).structures)
      m_names.push_back(part->name);
  }

  std::string structureAt(const Vector3d& point) const
  {
    const volume::Volume<std::uint8_t>& index = *m_labels->index;
    const std::size_t found = volume::structureAt(index, m_labels->borders.get(),
                                                  index.geometry().voxelFromPatient(point))
                                  .index;
    return found > 0 && found <= m_names.size() ? m_names[found - 1] : std::string();
  }

  bool meets(const Vector3d& from, const Vector3d& way, double sight) const
  {
    const Vector3d to = from + sight * way;
    if (m_bone.firstHit(from, to) || m_structures.firstHit(from, to))
      return true;
    return std::any_of(m_meshes.begin(), m_meshes.end(),
                       [&](const Mesh& mesh)
                       {
                         const auto hit = mesh.tree.firstAlong(from, way, 0.0);
                         return hit && hit->distance < sight;
                       });
  }

  std::shared_ptr<const volume::LabelField> m_labels;
  volume::TissueField m_bone, m_structures; // neither holds the other
  std::vector<std::string> m_names;         // of index i at i - 1
  std::vector<Mesh> m_meshes;
};

// Samples, both included; last < first: none.
struct Stretch
{
  int first = 0;
  int last = -1;
};

Stretch longestFree(const std::vector<Here>& here)
{
  Stretch longest;
  Stretch current;
  for (int n = 0; n < static_cast<int>(here.size()); ++n)
  {
    if (here[static_cast<std::size_t>(n)].isClosed)
      current.first = n + 1;
    current.last = n;
    if (current.last - current.first > longest.last - longest.first)
      longest = current;
  }
  return longest;
}

// Where structures and meshes lie in a stretch, each from its first to its last sample.
std::map<std::string, Stretch> crossings(const std::vector<Here>& here, const Stretch& free)
{
  std::map<std::string, Stretch> found;
  for (int n = free.first; n <= free.last; ++n)
    for (const std::string& name : here[static_cast<std::size_t>(n)].parts)
      found.emplace(name, Stretch{n, n}).first->second.last = n;
  return found;
}

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
  const Polyline line(points);
  return flightBetween(line, 0.0, line.length(), frames);
}

Flight flightAlong(scene::Case& value, const std::string& structure, int frames,
                   const core::Progress& progress)
{
  checkFrames(frames);
  const Polyline line(alongStructure(value, structure, {}, progress.part(0.0, 0.3)).points);
  if (scene::StructurePart* part = scene::findStructure(value, structure))
    part->look.shown = false;
  else if (scene::MeshPart* mesh = scene::findMesh(value, structure))
    mesh->look.shown = false;

  Flight flight;
  flight.length = line.length();
  SceneAssembly assembly;
  Surroundings drawn(value, assembly.contents(value, progress.part(0.3, 0.5)),
                     progress.part(0.5, 0.6));
  std::vector<Here> here; // every kSampling; also straight ahead of the line's end
  const int samples = static_cast<int>((line.length() + kAhead) / kSampling);
  const core::Progress sampling = progress.part(0.6, 0.8);
  for (int n = 0; n <= samples; ++n)
  {
    sampling.report(static_cast<double>(n) / (samples + 1), kStep);
    here.push_back(drawn.around(line.at(n * kSampling)));
  }
  Stretch free = longestFree(here);
  const auto refuseUnlessLong = [&](const char* closed)
  {
    if (free.last - free.first < static_cast<int>(std::lround((kAhead + kShortest) / kSampling)))
      throw core::InvalidParameter("flight: along the centre line of '" + structure +
                                   "' no stretch of " + core::generalText(kAhead + kShortest) +
                                   " mm is free: " + closed);
  };
  refuseUnlessLong("bone, or the edge of the image, is nearer than 0.3 mm");

  // What of the line's ends a structure may close without being hidden.
  const int end = static_cast<int>(kAhead / kSampling);
  const int early = free.first + end;
  const int late = std::min(free.last, static_cast<int>(line.length() / kSampling)) - end;
  for (const auto& [name, at] : crossings(here, free))
    if (at.first > late)
      free.last = std::min(free.last, at.first - 1);
    else if (at.last < early)
      free.first = std::max(free.first, at.last + 1);
    else
      flight.hidden.push_back(name);
  refuseUnlessLong("structures that are shown close it at its ends; hide them");
  for (const std::string& name : flight.hidden)
  {
    if (scene::StructurePart* part = scene::findStructure(value, name))
      part->look.shown = false;
    if (scene::MeshPart* mesh = scene::findMesh(value, name))
      mesh->look.shown = false;
  }
  for (int n = free.first; n <= free.last && value.softTissue.shown; n += 5)
  {
    progress.check(kStep);
    if (drawsSoftFace(value, line.at(n * kSampling)))
    {
      flight.softTissueHidden = true;
      value.softTissue.shown = false;
    }
  }
  if (!flight.hidden.empty())
    drawn.hide(value, assembly.contents(value, progress.part(0.8, 0.95)));

  const auto showsSomething = [&](int n)
  {
    progress.check(kStep);
    const Vector3d from = line.at(n * kSampling);
    return drawn.fillsView(from, (line.at(n * kSampling + kAhead) - from).normalized());
  };
  int first = free.first;
  int last = free.last - end;
  while (first < last && !showsSomething(first))
    ++first;
  while (first < last && !showsSomething(last))
    --last;
  if ((last - first) * kSampling < kShortest)
    throw core::InvalidParameter("flight: along the centre line of '" + structure +
                                 "' nothing is drawn");
  flight.flown = (last - first) * kSampling;
  flight.cameras = flightBetween(line, first * kSampling, last * kSampling, frames);
  return flight;
}

} // namespace petrous::presenters
