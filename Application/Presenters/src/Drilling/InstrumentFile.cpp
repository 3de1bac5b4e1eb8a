#include "petrous/Presenters/InstrumentFile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Scene/PlainText.h"
#include "petrous/Volume/MeshMeasure.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::presenters
{

namespace
{

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr double kAtTip = 1.0;   // mm from an origin that is the tip to surface and lowest point
constexpr double kHollow = 1e-9; // of the bounding box's volume: encloses nothing
constexpr double kEnd = 0.1;     // of the length: what is compared to find the narrower end

[[noreturn]] void refuse(const fs::path& path, const std::string& why)
{
  throw core::InvalidParameter(path.string() + ": " + why);
}

void checkAxis(const std::string& axis)
{
  const auto known = std::find(kInstrumentAxes.begin(), kInstrumentAxes.end(), axis);
  if (known == kInstrumentAxes.end())
    throw core::InvalidParameter("an instrument lies along x+, x-, y+, y-, z+ or z- of its file, "
                                 "not along '" +
                                 axis + "'");
}

// From the file's frame to frame T, without the shift.
Eigen::Matrix3d turnOf(const std::string& axis)
{
  checkAxis(axis);
  if (axis == "z-")
    return Eigen::AngleAxisd(std::acos(-1.0), Vector3d::UnitX()).toRotationMatrix();
  const Vector3d toHand = (axis[1] == '-' ? -1.0 : 1.0) * Vector3d::Unit(axis[0] - 'x');
  return Eigen::Quaterniond::FromTwoVectors(toHand, Vector3d::UnitZ()).toRotationMatrix();
}

Vector3d sizeOf(const core::TriangleMesh& mesh)
{
  const auto bounds = mesh.bounds();
  return (bounds[1] - bounds[0]).cast<double>();
}

void checkSize(const fs::path& path, double length, bool isUnitStated)
{
  if (length >= kMinInstrument && length <= kMaxInstrument)
    return;
  std::string others;
  for (const double unit : {0.001, 10.0, 25.4, 1000.0})
    if (length * unit >= 10.0 * kMinInstrument && length * unit <= kMaxInstrument)
      others += (others.empty() ? "; it would be " : ", ") + lengthText(length * unit) +
                " mm if its numbers were in " + unitName(unit);
  refuse(path, "is " + lengthText(length) + " mm long" +
                   (isUnitStated ? " by the unit that it states" : "") +
                   ", and an instrument is 1 to 300 mm" + others + "; export it in mm");
}

void checkSurface(const fs::path& path, const core::TriangleMesh& mesh)
{
  if (mesh.triangles.size() > kMaxInstrumentTriangles)
    refuse(path, "has " + std::to_string(mesh.triangles.size()) +
                     " triangles, and an instrument at most " +
                     std::to_string(kMaxInstrumentTriangles) + "; export it coarser");
  const volume::MeshMeasure measure = volume::measure(mesh);
  if (measure.openEdges > 0)
    refuse(path, "is not closed: its surface ends at " + std::to_string(measure.openEdges) +
                     " edges; an instrument is a solid body, so close its holes and export it "
                     "again");
  if (!(*measure.volume > kHollow * std::pow(sizeOf(mesh).maxCoeff(), 3)))
    refuse(path, "encloses nothing; an instrument is a solid body with a closed surface");
}

std::string reversed(std::string axis)
{
  axis.back() = axis.back() == '+' ? '-' : '+';
  return axis;
}

// In frame T but for the shift. A mid-shaft origin is close to a thin shaft's surface, too, but is
// not its tip.
Vector3d tipOf(const core::TriangleMesh& mesh, const std::string& axis,
               std::vector<std::string>& notes)
{
  const auto [lowest, highest] = std::minmax_element(
      mesh.vertices.begin(), mesh.vertices.end(),
      [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a.z() < b.z(); });
  const double away = volume::MeshTree(mesh).distance(Vector3d::Zero(), 2.0 * kMaxInstrument);
  const double beyond = -static_cast<double>(lowest->z());
  if (away > kAtTip)
    notes.push_back("Its tip is taken to be the point farthest from the hand, as the file's origin "
                    "is not within 1 mm of its surface");
  else if (beyond <= kAtTip)
    return Vector3d::Zero();
  else if (static_cast<double>(highest->z()) <= kAtTip)
    notes.push_back("Its tip is taken to be the point farthest from the hand, as the file's origin "
                    "lies at the other end; if the tip is at the origin, its axis is " +
                    reversed(axis) + " instead of " + axis);
  else
    notes.push_back("Its tip is taken to be the point farthest from the hand, as it reaches " +
                    lengthText(beyond) + " mm beyond the file's origin");
  return lowest->cast<double>();
}

// mm, of what lies between two places along an axis: its extent across.
double widthBetween(const core::TriangleMesh& mesh, int axis, double from, double to)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    if (const Vector3d p = vertex.cast<double>(); p[axis] >= from && p[axis] <= to)
      box.extend(p);
  if (box.isEmpty())
    return 0.0;
  Vector3d size = box.sizes();
  size[axis] = 0.0;
  return size.norm();
}

} // namespace

InstrumentPlacement placementOf(const core::TriangleMesh& mesh, const std::string& axis)
{
  checkAxis(axis);
  const int along = axis[0] - 'x';
  const auto bounds = mesh.bounds();
  Vector3d size = sizeOf(mesh);
  InstrumentPlacement result;
  result.length = std::exchange(size[along], 0.0);
  result.width = size.maxCoeff();
  result.tip = static_cast<double>(bounds[axis[1] == '-' ? 1 : 0][along]);
  return result;
}

std::string likelyAxis(const core::TriangleMesh& mesh)
{
  std::string axis;
  double length = -1.0;
  for (const char* one : kInstrumentAxes)
    if (const double along = placementOf(mesh, one).length; along > length)
    {
      axis = one;
      length = along;
    }
  const double low = placementOf(mesh, axis).tip, high = low + length;
  const bool isAtLow = std::abs(low) <= kAtTip, isAtHigh = std::abs(high) <= kAtTip;
  if (isAtLow != isAtHigh)
    return isAtLow ? axis : reversed(axis);
  const int along = axis[0] - 'x';
  const double lower = widthBetween(mesh, along, low, low + kEnd * length);
  const double upper = widthBetween(mesh, along, high - kEnd * length, high);
  return upper < lower ? reversed(axis) : axis;
}

InstrumentSurface readInstrumentSurface(const fs::path& path, const core::Progress& progress)
{
  // Its coordinates are its own, not a patient's: neither LPS nor RAS.
  imaging::LoadedMesh loaded = imaging::loadMesh(path, false, std::nullopt, progress);
  checkSize(path, sizeOf(loaded.mesh).maxCoeff(), loaded.isUnitStated);
  checkSurface(path, loaded.mesh);
  return {core::printable(path.filename()), std::move(loaded.mesh)};
}

InstrumentSurface instrumentSurface(std::string name, core::TriangleMesh mesh)
{
  checkSize(name, sizeOf(mesh).maxCoeff(), false);
  checkSurface(name, mesh);
  return {std::move(name), std::move(mesh)};
}

scene::ViewState::Instrument keptInstrument(const InstrumentSurface& surface,
                                            const std::string& axis)
{
  scene::ViewState::Instrument kept;
  kept.name = core::utf8Prefix(scene::withoutInvisible(surface.name),
                               scene::ViewState::Instrument::kLongestName);
  kept.axis = axis;
  kept.mesh = std::make_shared<const core::TriangleMesh>(surface.mesh);
  return kept;
}

InstrumentSurface surfaceOf(const scene::ViewState::Instrument& kept, const std::string& unnamed)
{
  return instrumentSurface(kept.name.empty() ? unnamed : kept.name, *kept.mesh.get());
}

LoadedInstrument makeInstrument(InstrumentSurface surface, const std::string& axis,
                                const core::Progress& progress)
{
  const Eigen::Matrix3d turn = turnOf(axis);
  core::TriangleMesh& mesh = surface.mesh;
  LoadedInstrument result;
  if (placementOf(mesh, axis).isAcross())
    result.notes.push_back("It is longer across the shaft than along it; if it lies along another "
                           "axis of its file than " +
                           axis + ", say which");
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = (turn * vertex.cast<double>()).cast<float>();
  const Vector3d tip = tipOf(mesh, axis, result.notes);
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = (vertex.cast<double>() - tip).cast<float>();
  progress.check("sampling the instrument");

  auto instrument = std::make_shared<session::Instrument>();
  instrument->name = std::move(surface.name);
  instrument->shell =
      std::make_shared<const haptics::PointShell>(haptics::makeInstrumentShell(mesh));
  instrument->surface = std::make_shared<const core::TriangleMesh>(std::move(mesh));
  result.instrument = std::move(instrument);
  return result;
}

LoadedInstrument readInstrument(const fs::path& path, const std::string& axis,
                                const core::Progress& progress)
{
  checkAxis(axis);
  return makeInstrument(readInstrumentSurface(path, progress.part(0.0, 0.5)), axis, progress);
}

double reachBeyondTip(const session::Instrument& instrument) noexcept
{
  return std::max(0.0, -static_cast<double>(instrument.surface->bounds()[0].z()));
}

std::string toString(const session::Instrument& instrument)
{
  return instrument.name + ": " + std::to_string(instrument.shell->points.size()) +
         " points, no place within 10 mm of its tip farther than " +
         core::fixedText(instrument.shell->burrSpacing, 2) +
         " mm from one, and none at all farther than " +
         core::fixedText(instrument.shell->spacing, 2) +
         " mm; bone thinner than twice that may pass between them unfelt";
}

} // namespace petrous::presenters
