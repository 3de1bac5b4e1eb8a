#include "petrous/Volume/MeshSolid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "petrous/Core/NumberText.h"
#include "petrous/Volume/MeshInside.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::volume
{

namespace
{

constexpr double kBand = 3.0;    // voxels on either side of the surface: the occupancy's ramp
constexpr int kMargin = 4;       // voxels around the mesh: the band and one more
constexpr int kRun = 8;          // voxels of a row that are tested together
constexpr double kFine = 0.002;  // fraction of the surface that may be thinner than is resolved
constexpr double kWhole = 0.02;  // the same if memory is limited
constexpr double kSharp = 0.08;  // of thickness times spacing: see MeshSolid.h
constexpr double kFacing = 0.94; // cosine of 20 degrees: thin, rather than the edge of something
constexpr std::size_t kMaxSamples = 20000; // triangles at which thickness is measured
constexpr double kGuarded = 0.501;         // stays above 0.5 when rounded to 16 bits

constexpr double kSlack = 1e-9; // an edge belongs to both triangles: no chord slips out

const char* const kTask = "making a mesh touchable";

struct Chord
{
  double length; // mm
  double area;   // mm^2
  bool facing;
};

// Distance from the centre of each triangle inwards to the opposite wall; `beyond` mm if that was
// cut off, or omitted if `beyond` is 0.
std::vector<Chord> chordsOf(const MeshTree& surface, double start, double beyond,
                            const core::Progress& progress)
{
  const auto& triangles = surface.triangles();
  const std::size_t stride = 1 + triangles.size() / kMaxSamples;
  std::vector<Chord> chords((triangles.size() + stride - 1) / stride, Chord{0.0, 0.0, false});
  tbb::parallel_for(std::size_t{0}, chords.size(),
                    [&](std::size_t n)
                    {
                      if (n % 1024 == 0)
                        progress.check(kTask);
                      const auto& [a, b, c] = triangles[n * stride];
                      const Eigen::Vector3d normal = (b - a).cross(c - a);
                      const double area = 0.5 * normal.norm();
                      if (!(area > 0.0))
                        return;
                      const Eigen::Vector3d inwards = -normal.normalized();
                      const auto hit =
                          surface.firstAlong((a + b + c) / 3.0, inwards, start, kSlack);
                      if (!hit && beyond > 0.0)
                        chords[n] = {beyond, area, true};
                      if (!hit)
                        return;
                      const auto& [d, e, f] = triangles[hit->triangle];
                      const Eigen::Vector3d wall = (e - d).cross(f - d).normalized();
                      chords[n] = {hit->distance, area, wall.dot(inwards) >= kFacing};
                    });
  const auto missing = [](const Chord& chord) { return chord.area == 0.0; };
  chords.erase(std::remove_if(chords.begin(), chords.end(), missing), chords.end());
  // A body without parallel walls, such as a tetrahedron, uses all chords.
  const auto aslant = [](const Chord& chord) { return !chord.facing; };
  const auto last = std::remove_if(chords.begin(), chords.end(), aslant);
  if (last != chords.begin())
    chords.erase(last, chords.end());
  std::sort(chords.begin(), chords.end(),
            [](const Chord& a, const Chord& b) { return a.length < b.length; });
  return chords;
}

// Area-weighted quantile of the chord lengths at the fraction `fraction`. `chords` sorted, not
// empty.
double quantile(const std::vector<Chord>& chords, double fraction)
{
  double area = 0.0;
  for (const Chord& chord : chords)
    area += chord.area;
  double sum = 0.0;
  for (const Chord& chord : chords)
    if ((sum += chord.area) > fraction * area)
      return chord.length;
  return chords.back().length;
}

// Number of samples along one axis.
double countAlong(double length, double edge)
{
  return std::ceil(length / edge) + 2.0 + 2.0 * kMargin;
}

double bytesAt(const Eigen::Vector3d& size, double edge)
{
  return countAlong(size[0], edge) * countAlong(size[1], edge) * countAlong(size[2], edge) *
         sizeof(float);
}

// Offset by half a voxel, so that a flat end of the mesh lies between two samples.
core::GridGeometry gridAt(const Eigen::Vector3d& lower, const Eigen::Vector3d& size, double edge)
{
  const auto count = [&](Eigen::Index axis)
  { return static_cast<int>(countAlong(size[axis], edge)); };
  return {{count(0), count(1), count(2)},
          Eigen::Vector3d::Constant(edge),
          lower - Eigen::Vector3d::Constant((kMargin + 0.5) * edge)};
}

// The smallest edge in [wanted, coarsest] that memory permits; bytes decrease with the edge.
double permitted(const Eigen::Vector3d& size, double wanted, double coarsest, double maxBytes)
{
  if (bytesAt(size, wanted) <= maxBytes)
    return wanted;
  double tooFine = wanted;
  double fits = coarsest;
  for (int round = 0; round < 40; ++round)
  {
    const double middle = 0.5 * (tooFine + fits);
    (bytesAt(size, middle) <= maxBytes ? fits : tooFine) = middle;
  }
  return fits;
}

void checkLimits(const MeshSolidLimits& limits)
{
  if (!(limits.spacing > 0.0) || !std::isfinite(limits.spacing))
    throw core::InvalidParameter("mesh: the spacing of its voxels must be above 0 mm");
}

std::string tooLargeText(double thickness, double bytes, double maxBytes)
{
  return "it is " + core::plainText(thickness, 3) + " mm thick in places and would take " +
         core::fixedText(std::ceil(bytes / (1 << 20)), 0) +
         " MB as voxels to stay whole; a mesh may take " +
         core::fixedText(std::floor(maxBytes / (1 << 20)), 0) + " MB";
}

std::string farText(double reach)
{
  return "it reaches " + core::fixedText(reach, 0) +
         " mm beyond the CT, so a coordinate lost its point or is not in mm";
}

// Box of the mesh on which the voxels in a box may depend, with room for the wall opposite to one
// in it.
Eigen::AlignedBox3d roundAbout(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper)
{
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant((upper - lower).norm());
  return {lower - margin, upper + margin};
}

// Raises voxels until none is more than `most` below a neighbour along an axis.
void limitSteps(Volume<float>& volume, float most)
{
  const core::Index3& dims = volume.geometry().dims();
  core::Index3 at{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t other = (axis + 1) % 3;
    const std::size_t third = (axis + 2) % 3;
    for (at[other] = 0; at[other] < dims[other]; ++at[other])
      for (at[third] = 0; at[third] < dims[third]; ++at[third])
      {
        float before = 0.0F;
        const auto raise = [&](int n)
        {
          at[axis] = n;
          float& value = volume.at(at[0], at[1], at[2]);
          before = value = std::max(value, before - most);
        };
        for (int n = 0; n < dims[axis]; ++n)
          raise(n);
        for (int n = dims[axis] - 1; n >= 0; --n)
          raise(n);
      }
  }
}

} // namespace

double maxReach(const core::PatientBox& region)
{
  constexpr double kMin = 500.0; // mm
  return std::max(kMin, (region.max() - region.min()).norm());
}

double reachBeyond(const core::TriangleMesh& mesh, const core::PatientBox& region)
{
  const auto bounds = mesh.bounds();
  const Eigen::Vector3d below = region.min() - bounds[0].cast<double>();
  const Eigen::Vector3d above = bounds[1].cast<double>() - region.max();
  return std::max({0.0, below.maxCoeff(), above.maxCoeff()});
}

MeshSolidPlan planMeshSolid(const core::TriangleMesh& mesh, const MeshSolidLimits& limits,
                            const core::Progress& progress)
{
  checkLimits(limits);
  progress.check(kTask);
  MeshSolidPlan plan;
  const auto bounds = mesh.bounds();
  Eigen::Vector3d lower = bounds[0].cast<double>();
  Eigen::Vector3d upper = bounds[1].cast<double>();
  if (limits.region)
  {
    lower = lower.cwiseMax(limits.region->min());
    upper = upper.cwiseMin(limits.region->max());
  }
  if ((lower.array() > upper.array()).any())
  {
    plan.refusal = "it lies outside the CT";
    return plan;
  }
  if (limits.region && reachBeyond(mesh, *limits.region) > maxReach(*limits.region))
  {
    plan.refusal = farText(reachBeyond(mesh, *limits.region));
    return plan;
  }
  const MeshInside inside(mesh);
  if (inside.openEdges() > 0)
  {
    plan.refusal =
        "it is not closed: its surface ends at " + std::to_string(inside.openEdges()) + " edges";
    return plan;
  }
  const Eigen::AlignedBox3d kept = roundAbout(lower, upper);
  const bool isCut = !kept.contains(bounds[0].cast<double>().eval()) ||
                     !kept.contains(bounds[1].cast<double>().eval());
  const MeshTree surface(inside.surface(0.5 * limits.spacing, kept));
  progress.check(kTask);
  const auto chords =
      chordsOf(surface, 4.0 * inside.unit(), isCut ? (upper - lower).norm() : 0.0, progress);
  if (chords.empty())
  {
    plan.refusal = "it encloses nothing";
    return plan;
  }
  const double h = limits.spacing;
  const double t = quantile(chords, kFine);
  plan.thickness = t;
  const double wanted = std::min({h, t / 3.0, std::sqrt(kSharp * t * h)});
  const double coarsest = std::max(wanted, 0.5 * quantile(chords, kWhole));
  const Eigen::Vector3d size = upper - lower;
  const auto maxBytes = static_cast<double>(limits.maxBytes);
  if (bytesAt(size, coarsest) > maxBytes)
    plan.refusal = tooLargeText(t, bytesAt(size, coarsest), maxBytes);
  else
    plan.grid = gridAt(lower, size, permitted(size, wanted, coarsest, maxBytes));
  return plan;
}

std::shared_ptr<const Volume<float>>
solidOf(const core::TriangleMesh& mesh, const MeshSolidPlan& plan, const core::Progress& progress)
{
  if (!plan)
    throw core::InvalidParameter("mesh: cannot become voxels: " + plan.refusal);
  const double edge = plan.grid.minSpacing();
  const MeshInside inside(mesh);
  const auto bounds = plan.grid.patientBounds();
  const MeshTree surface(inside.surface(0.5 * edge, roundAbout(bounds.min(), bounds.max())));
  auto occupancy = std::make_shared<Volume<float>>(plan.grid);
  const core::Index3& dims = plan.grid.dims();
  const double band = kBand * edge;

  // Voxels [first, last) of the row; `within` states which are inside.
  const auto fill = [&](int first, int last, int j, int k, const std::vector<char>& within)
  {
    const double reach = band + 0.5 * kRun * edge;
    const bool far =
        surface.distance(plan.grid.patientFromVoxel({0.5 * (first + last - 1), 1.0 * j, 1.0 * k}),
                         reach) >= reach;
    double limit = band;
    for (int i = first; i < last; ++i)
    {
      const double d =
          far ? band
              : surface.distance(plan.grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}), limit);
      limit = std::min(band, d + edge);
      const double side = within[static_cast<std::size_t>(i)] ? 0.5 : -0.5;
      occupancy->at(i, j, k) = static_cast<float>(0.5 + side * std::min(1.0, d / band));
    }
  };

  std::atomic<int> done{0};
  tbb::parallel_for(
      0, dims[2],
      [&](int k)
      {
        std::vector<double> crossings;
        std::vector<char> within(static_cast<std::size_t>(dims[0]));
        for (int j = 0; j < dims[1]; ++j)
        {
          progress.check(kTask);
          const Eigen::Vector3d start = plan.grid.patientFromVoxel({0.0, 1.0 * j, 1.0 * k});
          inside.crossings(start[1], start[2], crossings);
          for (std::size_t i = 0; i < within.size(); ++i)
          {
            const double x = start[0] + edge * static_cast<double>(i);
            const auto passed = std::upper_bound(crossings.begin(), crossings.end(), x);
            within[i] = (passed - crossings.begin()) % 2 != 0;
          }
          for (int i = 0; i < dims[0]; i += kRun)
            fill(i, std::min(i + kRun, dims[0]), j, k, within);
        }
        progress.report(static_cast<double>(++done) / dims[2], kTask);
      });
  return occupancy;
}

bool isInside(const Volume<float>& solid, const Eigen::Vector3d& patient) noexcept
{
  const Eigen::Vector3d voxel = solid.geometry().voxelFromPatient(patient);
  return solid.geometry().hullContains(voxel) && sampleTrilinear(solid, voxel) > 0.5;
}

std::shared_ptr<const Volume<float>> protectionMaskOf(const Volume<float>& solid,
                                                      const core::GridGeometry& grid)
{
  const core::GridGeometry& from = solid.geometry();
  const auto bounds = from.patientBounds();
  core::IndexBox box = grid.boxCovering(bounds.min(), bounds.max());
  if (box.empty())
    return nullptr;
  for (std::size_t a = 0; a < 3; ++a) // room for raised values to decrease again
  {
    box.lower[a] -= 2;
    box.upper[a] += 2;
  }
  box = box.intersected(grid.fullBox());
  auto guard = std::make_shared<Volume<float>>(grid.cropped(box));
  const core::GridGeometry& to = guard->geometry();
  const auto visit = [](const core::GridGeometry& all, const auto& one)
  {
    for (int k = 0; k < all.dims()[2]; ++k)
      for (int j = 0; j < all.dims()[1]; ++j)
        for (int i = 0; i < all.dims()[0]; ++i)
          one(i, j, k, all.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}));
  };
  visit(to,
        [&](int i, int j, int k, const Eigen::Vector3d& patient)
        {
          const Eigen::Vector3d voxel = from.voxelFromPatient(patient);
          guard->at(i, j, k) =
              from.hullContains(voxel) ? static_cast<float>(sampleTrilinear(solid, voxel)) : 0.0F;
        });
  // Where a part is thinner than a voxel, all centres may be outside it: the cell's corners are
  // raised by the least-squares change that corrects the point. A raise never undoes an earlier
  // one, so one pass over the points suffices.
  visit(from,
        [&](int i, int j, int k, const Eigen::Vector3d& patient)
        {
          const Eigen::Vector3d voxel = to.voxelFromPatient(patient);
          if (solid.at(i, j, k) < 0.5F || !to.hullContains(voxel))
            return;
          const double lack = kGuarded - sampleTrilinear(*guard, voxel);
          if (lack <= 0.0)
            return;
          const TrilinearCell cell(voxel, to.dims());
          std::array<double, 8> weights{};
          double squares = 0.0;
          const auto corner = [&](std::size_t n, std::size_t axis)
          { return (n >> axis & 1U) != 0 ? cell.upper[axis] : cell.lower[axis]; };
          for (std::size_t n = 0; n < 8; ++n)
          {
            weights[n] = 1.0;
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
              const double w = cell.weight[static_cast<Eigen::Index>(axis)];
              weights[n] *= (n >> axis & 1U) != 0 ? w : 1.0 - w;
            }
            squares += weights[n] * weights[n];
          }
          for (std::size_t n = 0; n < 8; ++n)
            guard->at(corner(n, 0), corner(n, 1), corner(n, 2)) +=
                static_cast<float>(lack * weights[n] / squares);
        });
  std::transform(guard->data(), guard->data() + guard->size(), guard->data(),
                 [](float value) { return std::min(value, 1.0F); });
  limitSteps(*guard, 0.5F);
  return guard;
}

} // namespace petrous::volume
