#include "petrous/Haptics/PointShell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "Covering.h"
#include "PointGrid.h"
#include "petrous/Core/Error.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::haptics
{

namespace
{

using Eigen::Vector3d;

constexpr std::size_t kPlaces = 50000; // on the triangles, from which points are chosen
constexpr double kFinest = 0.1;        // mm, at the tip: denser points add nothing that voxels show
constexpr double kDoubled = 5.0;       // mm from the tip, where points are twice as far apart
constexpr double kCoarsest = 10.0;     // times as far apart as at the tip, on the handle
constexpr double kPiece = 0.2;         // of the distance over which spacing doubles: a piece's size
constexpr double kBorder = 0.1;        // mm: pieces on both sides of the working end's border
constexpr double kAside = 1e-5;        // of the size: from the surface, to look at its other side

struct Place
{
  Vector3d point;
  Vector3d normal; // unit, of the triangles' own orientation
};

// Of the vertices, coincident ones as one: files that store facets repeat them.
std::vector<Place> verticesOf(const std::vector<volume::Triangle>& triangles)
{
  std::map<std::array<double, 3>, Vector3d> normals;
  for (const auto& [a, b, c] : triangles)
  {
    const Vector3d normal = (b - a).cross(c - a);
    for (const Vector3d& p : {a, b, c})
      normals.try_emplace({p[0], p[1], p[2]}, Vector3d::Zero()).first->second += normal;
  }
  std::vector<Place> places;
  for (const auto& [at, normal] : normals)
    if (normal.norm() > 0.0)
      places.push_back({Vector3d(at[0], at[1], at[2]), normal.normalized()});
  return places;
}

// Intended spacing at that distance from the tip, in units of that at the tip.
double coarsenessAt(double fromTip)
{
  return std::min(1.0 + fromTip / kDoubled, kCoarsest);
}

// Pieces of the triangle over which the spacing is nearly constant, each with twice its area in
// units of that spacing squared.
template <typename Visit>
void forPieces(const volume::Triangle& triangle, std::vector<volume::Triangle>& open, Visit visit)
{
  open.assign(1, triangle);
  while (!open.empty())
  {
    const volume::Triangle t = open.back();
    open.pop_back();
    const auto [centre, radius] = TriangleBall(t);
    const bool isOnHandle = centre.norm() - radius >= kDoubled * (kCoarsest - 1.0);
    if (!isOnHandle && radius > kPiece * (kDoubled + centre.norm()))
    {
      bisect(t, open);
      continue;
    }
    const double coarseness = coarsenessAt(centre.norm());
    visit(t, (t[1] - t[0]).cross(t[2] - t[0]).norm() / (coarseness * coarseness));
  }
}

// As dense as the points are to be: stratified over the pieces, and on each by Roberts' R2
// sequence.
void addPlaces(const std::vector<volume::Triangle>& triangles, std::vector<Place>& places)
{
  constexpr double kFirst = 0.7548776662466927; // reciprocals of the plastic number and its square
  constexpr double kSecond = 0.5698402909980532;
  constexpr double kGolden = 0.6180339887498949;
  std::vector<volume::Triangle> open;
  double weight = 0.0;
  for (const volume::Triangle& triangle : triangles)
    forPieces(triangle, open, [&weight](const volume::Triangle&, double w) { weight += w; });
  const double step = weight / static_cast<double>(kPlaces);
  // Anywhere in its stratum, as many triangles may be alike.
  const auto placeOf = [step](std::size_t n)
  { return step * (static_cast<double>(n) + std::fmod(kGolden * static_cast<double>(n), 1.0)); };
  double passed = 0.0;
  std::size_t count = 0;
  for (const volume::Triangle& triangle : triangles)
    forPieces(
        triangle, open,
        [&](const volume::Triangle& piece, double w)
        {
          const auto& [a, b, c] = piece;
          passed += w;
          for (; count < kPlaces && placeOf(count) < passed; ++count)
          {
            double u = std::fmod(kFirst * static_cast<double>(count), 1.0);
            double v = std::fmod(kSecond * static_cast<double>(count), 1.0);
            if (u + v > 1.0)
            {
              u = 1.0 - u;
              v = 1.0 - v;
            }
            places.push_back({a + u * (b - a) + v * (c - a), (b - a).cross(c - a).normalized()});
          }
        });
}

// Farthest-point sampling, with distances in units of the intended spacing until that is reached,
// then as they are: indices of `places`, the nearest to the origin first.
std::vector<std::size_t> spread(const std::vector<Place>& places, std::size_t most)
{
  std::vector<double> perSpacing; // squared
  std::size_t chosen = 0;
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    perSpacing.push_back(std::pow(coarsenessAt(places[n].point.norm()), -2.0));
    if (places[n].point.squaredNorm() < places[chosen].point.squaredNorm())
      chosen = n;
  }
  std::vector<double> squared(places.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> result;
  bool isGraded = true;
  for (;;)
  {
    result.push_back(chosen);
    const Vector3d at = places[chosen].point;
    squared[chosen] = 0.0;
    for (std::size_t n = 0; n < places.size(); ++n)
    {
      squared[n] = std::min(squared[n], perSpacing[n] * (places[n].point - at).squaredNorm());
      if (squared[n] > squared[chosen])
        chosen = n;
    }
    if (isGraded && squared[chosen] <= kFinest * kFinest)
    {
      isGraded = false;
      for (std::size_t n = 0; n < places.size(); ++n)
      {
        squared[n] /= std::exchange(perSpacing[n], 1.0);
        if (squared[n] > squared[chosen])
          chosen = n;
      }
    }
    if (result.size() == most || squared[chosen] <= kFinest * kFinest)
      return result;
  }
}

// Calls visit(piece, isNear) for pieces of the triangle within kInstrumentTip of the tip and beyond
// it; small ones on the border count as both.
template <typename Visit>
void partAtWorkingEnd(const volume::Triangle& triangle, std::vector<volume::Triangle>& open,
                      Visit visit)
{
  open.assign(1, triangle);
  while (!open.empty())
  {
    const volume::Triangle t = open.back();
    open.pop_back();
    const auto [centre, radius] = TriangleBall(t);
    const bool reachesIn = centre.norm() - radius <= kInstrumentTip;
    const bool reachesOut = centre.norm() + radius >= kInstrumentTip;
    if (reachesIn && reachesOut && radius > kBorder)
    {
      bisect(t, open);
      continue;
    }
    if (reachesIn)
      visit(t, true);
    if (reachesOut)
      visit(t, false);
  }
}

// Whether the normal leads into the instrument: an odd number of its triangles is met that way.
bool leadsInside(const volume::MeshTree& tree, const Place& place, double aside)
{
  // Not quite along the normal, which runs along edges of regular meshes.
  const Vector3d direction = (place.normal + Vector3d(0.0031, 0.0047, 0.0023)).normalized();
  const Vector3d from = place.point + aside * place.normal;
  bool isInside = false;
  double start = 0.0;
  while (const auto hit = tree.firstAlong(from, direction, start, 1e-9))
  {
    isInside = !isInside;
    start = hit->distance + 1e-3 * aside;
  }
  return isInside;
}

} // namespace

PointShell makeInstrumentShell(const core::TriangleMesh& surface, std::size_t budget)
{
  if (budget < 200 || budget > 20000)
    throw core::InvalidParameter("instrument: a shell has 200 to 20000 points, not " +
                                 std::to_string(budget));
  surface.validate();
  const volume::MeshTree tree(surface);
  std::vector<Place> places = verticesOf(tree.triangles());
  addPlaces(tree.triangles(), places);
  if (places.empty())
    throw core::InvalidParameter("instrument: its surface has no area");

  const auto bounds = surface.bounds();
  const double aside = kAside * (bounds[1] - bounds[0]).cast<double>().norm();
  PointShell shell;
  for (const std::size_t n : spread(places, budget))
  {
    const Place& place = places[n];
    shell.points.push_back(place.point);
    shell.normals.push_back(leadsInside(tree, place, aside) ? Vector3d(-place.normal)
                                                            : place.normal);
    shell.reach = std::max(shell.reach, place.point.norm());
  }
  shell.burrCount = shell.points.size();

  const PointGrid grid(shell.points, kFinest);
  Covering tip(grid);
  Covering rest(grid);
  for (const Place& place : places)
    (place.point.norm() <= kInstrumentTip ? tip : rest).see(place.point);
  std::vector<volume::Triangle> open;
  for (const volume::Triangle& triangle : tree.triangles())
    partAtWorkingEnd(triangle, open,
                     [&](const volume::Triangle& piece, bool isNear)
                     { (isNear ? tip : rest).add(piece, [](const Vector3d& p) { return p; }); });
  shell.burrSpacing = tip.bound();
  shell.spacing = std::max(tip.bound(), rest.bound());
  return shell;
}

} // namespace petrous::haptics
