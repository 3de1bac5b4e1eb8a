#include "HeadCells.h"

#include <algorithm>
#include <array>
#include <limits>

#include <tbb/parallel_for.h>

namespace petrous::volume
{

namespace
{

constexpr double kMaxSlice = 38000.0; // mm^2; a slice with more is one of the shoulders
constexpr double kCell = 2.0;         // mm
constexpr double kMaxCells = 8e6;
constexpr double kAirBefore = 6.0; // mm
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

CellSet classified(const IntensityVolume& image, const SkinScale& scale,
                   const Eigen::Matrix3d& axes, const core::Progress& progress)
{
  const core::GridGeometry& grid = image.geometry();
  const core::PatientBox bounds = grid.patientBounds();
  core::PatientBox box; // along the axes
  for (int corner = 0; corner < 8; ++corner)
    box.extend(axes * bounds.corner(static_cast<core::PatientBox::CornerType>(corner)));
  const Eigen::Matrix3d back = axes.transpose();
  CellSet cells(box, std::max(kCell, std::cbrt(box.volume() / kMaxCells)));
  const core::Index3 n = cells.dims();
  const core::Index3 m = grid.dims();
  const double quarter = 0.25 * cells.edge();
  std::array<Eigen::Vector3d, 8> offsets;
  for (std::size_t c = 0; c < 8; ++c)
    offsets[c] = grid.voxelFromPatientLinear() * back *
                 (quarter * Eigen::Vector3d((c & 1U) != 0 ? 1 : -1, (c & 2U) != 0 ? 1 : -1,
                                            (c & 4U) != 0 ? 1 : -1));
  // What a scanner writes outside of its field is darker than any air.
  const double outside = scale.isAirKnown ? scale.air - 0.7 * (scale.threshold - scale.air)
                                          : -std::numeric_limits<double>::infinity();
  image.visit(
      [&](const auto& voxels)
      {
        tbb::parallel_for(
            0, n[2],
            [&](int k)
            {
              progress.check("looking for a face");
              for (int j = 0; j < n[1]; ++j)
                for (int i = 0; i < n[0]; ++i)
                {
                  const Eigen::Vector3d at = grid.voxelFromPatient(back * cells.center(i, j, k));
                  int inside = 0, tissue = 0;
                  for (const Eigen::Vector3d& offset : offsets)
                  {
                    const Eigen::Vector3d v = at + offset + Eigen::Vector3d::Constant(0.5);
                    if (!(v.minCoeff() >= 0.0 && v[0] < m[0] && v[1] < m[1] && v[2] < m[2]))
                      continue;
                    const auto value = static_cast<double>(voxels.at(
                        static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])));
                    if (value < outside || (image.padding() && value == *image.padding()))
                      continue;
                    ++inside;
                    tissue += value >= scale.threshold ? 1 : 0;
                  }
                  cells.cells()[cells.index(i, j, k)] = inside < 4             ? kOutside
                                                        : 2 * tissue >= inside ? kTissue
                                                                               : kAirCell;
                }
            });
      });
  return cells;
}

// Marks the largest component of tissue (of 6 neighbours). Returns its number of cells.
std::size_t markHead(CellSet& cells)
{
  const core::Index3 n = cells.dims();
  std::vector<std::uint8_t>& all = cells.cells();
  const auto row = static_cast<std::size_t>(n[0]);
  const std::size_t plane = row * static_cast<std::size_t>(n[1]);
  constexpr std::uint8_t kSeen = 8;
  std::vector<std::size_t> component, largest;
  for (std::size_t start = 0; start < all.size(); ++start)
  {
    if (all[start] != kTissue)
      continue;
    component.assign(1, start);
    all[start] |= kSeen;
    for (std::size_t next = 0; next < component.size(); ++next)
    {
      const std::size_t at = component[next];
      const auto visit = [&](bool isThere, std::size_t neighbour)
      {
        if (!isThere || all[neighbour] != kTissue)
          return;
        all[neighbour] |= kSeen;
        component.push_back(neighbour);
      };
      const std::size_t i = at % row, j = at % plane / row, k = at / plane;
      visit(i > 0, at - 1);
      visit(i + 1 < row, at + 1);
      visit(j > 0, at - row);
      visit(j + 1 < static_cast<std::size_t>(n[1]), at + row);
      visit(k > 0, at - plane);
      visit(k + 1 < static_cast<std::size_t>(n[2]), at + plane);
    }
    if (component.size() > largest.size())
      largest.swap(component);
  }
  for (std::uint8_t& cell : all)
    cell &= static_cast<std::uint8_t>(~kSeen);
  for (const std::size_t at : largest)
    all[at] |= kHead;
  return largest.size();
}

} // namespace

HeadCells headCells(const IntensityVolume& image, const SkinScale& scale,
                    const Eigen::Matrix3d& axes, const core::Progress& progress)
{
  HeadCells head{axes, classified(image, scale, axes, progress), 0, {}};
  head.count = markHead(head.cells);
  progress.check("looking for a face");
  CellSet& set = head.cells;
  const core::Index3 n = set.dims();
  core::PatientBox box;
  bool isAbove = true; // the shoulders
  for (int k = n[2] - 1; k >= 0; --k)
  {
    std::size_t count = 0;
    core::PatientBox slice;
    for (int j = 0; isAbove && j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        if ((set.cells()[set.index(i, j, k)] & kHead) != 0)
        {
          ++count;
          slice.extend(set.center(i, j, k));
        }
    isAbove = isAbove && static_cast<double>(count) * set.edge() * set.edge() <= kMaxSlice;
    if (isAbove)
      box.extend(slice);
    else
      std::fill_n(&set.cells()[set.index(0, 0, k)],
                  static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]),
                  static_cast<std::uint8_t>(kOutside));
  }
  if (!box.isEmpty())
    for (std::size_t c = 0; c < 8; ++c)
      head.hull.push_back(box.corner(static_cast<core::PatientBox::CornerType>(c)));
  return head;
}

Front frontOf(const HeadCells& head, const IntensityVolume* image, double threshold,
              const Eigen::Matrix3d& axes)
{
  const CellSet& cells = head.cells;
  const Eigen::Matrix3d back = axes.transpose(); // to the patient
  const Eigen::Matrix3d turn = axes * head.axes.transpose();
  const Eigen::Matrix3d toCells = turn.transpose();
  core::PatientBox box;
  for (const Eigen::Vector3d& corner : head.hull)
    box.extend(turn * corner);
  if (box.isEmpty())
    return {};
  const double edge = cells.edge();
  const int before = static_cast<int>(std::ceil(kAirBefore / edge));
  const Eigen::Vector3d size = box.sizes();
  FrontMap map{1 + static_cast<int>(size.x() / edge),
               1 + static_cast<int>(size.z() / edge),
               edge,
               {box.min().x(), 0.0, box.min().z()},
               {}};
  map.y.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), kNaN);
  Front front{map, map};
  const int depth = 2 * before + 2 + static_cast<int>(size.y() / edge);
  const double start = box.min().y() - (before + 1) * edge;
  tbb::parallel_for(0, map.height,
                    [&](int k)
                    {
                      for (int i = 0; i < map.width; ++i)
                      {
                        int air = 0;
                        for (int j = 0; j < depth; ++j)
                        {
                          Eigen::Vector3d at(map.x(i), start + edge * j, map.z(k));
                          std::size_t index = 0;
                          const bool isInside = cells.find(toCells * at, index);
                          const std::uint8_t cell =
                              isInside ? cells.cells()[index] : std::uint8_t{kOutside};
                          if ((cell & kHead) == 0)
                          {
                            air = cell == kOutside ? 0 : air + 1;
                            continue;
                          }
                          if (air < before)
                          {
                            front.cutOff.at(i, k) = at.y();
                            break;
                          }
                          front.skin.at(i, k) = at.y();
                          if (!image)
                            break;
                          // The place to a fraction of a voxel.
                          const core::GridGeometry& grid = image->geometry();
                          const double step = 0.125 * edge;
                          at.y() -= 1.5 * edge;
                          double previous = image->sample(grid.voxelFromPatient(back * at));
                          for (int s = 0; s < 24; ++s)
                          {
                            at.y() += step;
                            const double value = image->sample(grid.voxelFromPatient(back * at));
                            if (value >= threshold && previous < threshold)
                            {
                              front.skin.at(i, k) = at.y() - step * (value - threshold) /
                                                                 std::max(value - previous, 1e-12);
                              break;
                            }
                            previous = value;
                          }
                          break;
                        }
                      }
                    });
  return front;
}

std::optional<Nose> noseOf(const FrontMap& skin, std::optional<double> middle,
                           std::optional<double> near)
{
  constexpr double kBeside = 24.0, kBeyond = 12.0, kLength = 35.0; // mm
  constexpr double kLeast = 10.0, kMost = 40.0, kStep = 25.0, kAhead = 8.0;
  constexpr double kBehind = 60.0; // what lies so far behind the front is no nose
  const int beside = static_cast<int>(std::lround(kBeside / skin.edge));
  const int beyond = static_cast<int>(std::lround(kBeyond / skin.edge));
  constexpr double kAside = 12.0, kAbout = 25.0; // mm
  double foremost = std::numeric_limits<double>::infinity();
  skin.forEach([&](int, int, double y) { foremost = std::min(foremost, y); });
  struct Ridge
  {
    Eigen::Vector3d at;
    double out, skew;
  };
  std::vector<Ridge> ridge;
  skin.forEach(
      [&](int i, int k, double y)
      {
        if (i < beside || i + beside >= skin.width || k < beyond || k + beyond >= skin.height ||
            y > foremost + kBehind || (middle && std::abs(skin.x(i) - *middle) > kAside) ||
            (near && std::abs(skin.z(k) - *near) > kAbout))
          return;
        const double left = skin.at(i - beside, k) - y, right = skin.at(i + beside, k) - y;
        const double below = skin.at(i, k - beyond) - y, above = skin.at(i, k + beyond) - y;
        // Not the edge of the jaw over the neck, and not the top of the head.
        if (std::min(left, right) >= kLeast && std::max(left, right) <= kMost &&
            std::min(below, above) >= -kAhead && std::max(below, above) <= kStep)
          ridge.push_back(
              {{skin.x(i), y, skin.z(k)}, std::min(left, right), std::abs(left - right)});
      });
  if (ridge.empty())
    return std::nullopt;
  const Ridge most = *std::max_element(
      ridge.begin(), ridge.end(), [](const Ridge& a, const Ridge& b) { return a.out < b.out; });
  Eigen::Vector3d tip = most.at;
  for (const Ridge& one : ridge)
    if (std::abs(one.at.z() - most.at.z()) <= kLength &&
        std::abs(one.at.x() - most.at.x()) <= kBeside && one.at.y() < tip.y())
      tip = one.at;
  return Nose{tip, most.out, most.skew};
}

} // namespace petrous::volume
