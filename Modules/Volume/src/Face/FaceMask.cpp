#include "petrous/Volume/FaceMask.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/LU>
#include <tbb/parallel_for.h>

#include "petrous/Volume/ChebyshevDistance.h"
#include "petrous/Volume/IntensityHistogram.h"
#include "petrous/Volume/IntensityScale.h"
#include "petrous/Volume/Rounded.h"

namespace petrous::volume
{

namespace
{

// Of an adult's head, mm. The porion lies some 105 mm behind the tip of the nose; the temporal bone
// reaches 35 to 40 mm in front of it, and 15 mm more stay untouched.
constexpr double kReach = 50.0;
constexpr double kBelow = 125.0; // of the tip of the nose: the chin is some 80 mm below
constexpr double kAbove = 100.0; // the brow is some 60 mm above
constexpr double kBreadth = 150.0;
constexpr double kMinWidth = 60.0;    // of a face, mm
constexpr double kMinHeight = 30.0;   // mm
constexpr double kMinArea = 3000.0;   // mm^2
constexpr double kMaxSlice = 38000.0; // mm^2; a slice with more is one of the shoulders
constexpr double kMaxTilt = 0.7;      // 35 degrees
constexpr double kCell = 2.0;         // mm
constexpr double kMaxCells = 8e6;
constexpr double kAirBefore = 6.0; // mm
constexpr double kFlatShare = 0.4; // of the front on one plane: no face's
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

enum Cell : std::uint8_t
{
  kAirCell = 0,
  kTissue = 1,
  kOutside = 2,
  kHead = 4
};

CellSet classified(const IntensityVolume& image, const SkinScale& scale,
                   const core::Progress& progress)
{
  const core::GridGeometry& grid = image.geometry();
  const core::PatientBox box = grid.patientBounds();
  CellSet cells(box, std::max(kCell, std::cbrt(box.volume() / kMaxCells)));
  const core::Index3 n = cells.dims();
  const core::Index3 m = grid.dims();
  const double quarter = 0.25 * cells.edge();
  std::array<Eigen::Vector3d, 8> offsets;
  for (std::size_t c = 0; c < 8; ++c)
    offsets[c] = grid.voxelFromPatientLinear() *
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
                  const Eigen::Vector3d at = grid.voxelFromPatient(cells.center(i, j, k));
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

/// Seen from the front: y of the first tissue in each column of cells, LPS mm; NaN where there is
/// none, or no air before it within the image.
struct FrontMap
{
  int width = 0, height = 0;
  double edge = 0.0;
  Eigen::Vector3d lower{0.0, 0.0, 0.0}; ///< centre of the first column; y of no meaning
  std::vector<double> y;

  double& at(int i, int k) { return y[static_cast<std::size_t>(i + width * k)]; }
  double at(int i, int k) const { return y[static_cast<std::size_t>(i + width * k)]; }
  double x(int i) const { return lower[0] + edge * i; }
  double z(int k) const { return lower[2] + edge * k; }

  template <class Visit>
  void forEach(const Visit& visit) const
  {
    for (int k = 0; k < height; ++k)
      for (int i = 0; i < width; ++i)
        if (std::isfinite(at(i, k)))
          visit(i, k, at(i, k));
  }
};

struct Front
{
  FrontMap skin;
  FrontMap cutOff; ///< where tissue begins with the image; lower bounds of the skin's place
};

Front frontOf(const IntensityVolume& image, const CellSet& cells, double threshold)
{
  const core::Index3 n = cells.dims();
  FrontMap map{n[0], n[2], cells.edge(), cells.center(0, 0, 0), {}};
  map.y.assign(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[2]), kNaN);
  Front front{map, map};
  int lowest = 0; // above the shoulders
  for (int k = n[2] - 1; k >= 0; --k)
  {
    std::size_t count = 0;
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        count += (cells.cells()[cells.index(i, j, k)] & kHead) != 0 ? 1 : 0;
    if (static_cast<double>(count) * map.edge * map.edge > kMaxSlice)
    {
      lowest = k + 1;
      break;
    }
  }
  const int before = static_cast<int>(std::ceil(kAirBefore / map.edge));
  const core::GridGeometry& grid = image.geometry();
  tbb::parallel_for(lowest, std::max(lowest, n[2]),
                    [&](int k)
                    {
                      for (int i = 0; i < n[0]; ++i)
                      {
                        int air = 0;
                        for (int j = 0; j < n[1]; ++j)
                        {
                          const std::uint8_t cell = cells.cells()[cells.index(i, j, k)];
                          if ((cell & kHead) == 0)
                          {
                            air = cell == kOutside ? 0 : air + 1;
                            continue;
                          }
                          if (air < before)
                          {
                            front.cutOff.at(i, k) = cells.center(i, j, k).y();
                            break;
                          }
                          // The place to a fraction of a voxel.
                          const double step = 0.125 * map.edge;
                          Eigen::Vector3d at = cells.center(i, j, k);
                          at.y() -= 1.5 * map.edge;
                          double previous = image.sample(grid.voxelFromPatient(at));
                          front.skin.at(i, k) = cells.center(i, j, k).y();
                          for (int s = 0; s < 24; ++s)
                          {
                            at.y() += step;
                            const double value = image.sample(grid.voxelFromPatient(at));
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

struct Column
{
  double x, z, y; ///< x and z relative to F
};

// The largest share of columns that lie on one plane.
double flatShare(const std::vector<Column>& columns, double tolerance)
{
  constexpr int kTrials = 300;
  std::uint64_t state = 1; // of a linear congruential generator (Knuth, MMIX)
  const auto any = [&]() -> const Column&
  {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return columns[static_cast<std::size_t>(state >> 33U) % columns.size()];
  };
  std::size_t most = 0;
  for (int trial = 0; trial < kTrials; ++trial)
  {
    Eigen::Matrix3d a;
    Eigen::Vector3d b;
    for (int n = 0; n < 3; ++n)
    {
      const Column& one = any();
      a.row(n) << 1.0, one.x, one.z;
      b[n] = one.y;
    }
    if (std::abs(a.determinant()) < 100.0) // nearly on a line
      continue;
    const Eigen::Vector3d q = a.inverse() * b;
    const auto count =
        std::count_if(columns.begin(), columns.end(),
                      [&](const Column& one) {
                        return std::abs(q[0] + q[1] * one.x + q[2] * one.z - one.y) <= tolerance;
                      });
    most = std::max(most, static_cast<std::size_t>(count));
  }
  return static_cast<double>(most) / static_cast<double>(columns.size());
}

// The nose stands out from the cheeks on both sides more than anything else does, however the head
// is held; its tip is the foremost of that. nullopt where nothing does.
std::optional<Eigen::Vector3d> noseTip(const FrontMap& skin)
{
  constexpr double kBeside = 24.0, kBeyond = 12.0, kLength = 35.0; // mm
  constexpr double kLeast = 10.0, kMost = 40.0, kStep = 25.0, kAhead = 8.0;
  constexpr double kBehind = 60.0; // what lies so far behind the front is no nose
  const int beside = static_cast<int>(std::lround(kBeside / skin.edge));
  const int beyond = static_cast<int>(std::lround(kBeyond / skin.edge));
  double foremost = std::numeric_limits<double>::infinity();
  skin.forEach([&](int, int, double y) { foremost = std::min(foremost, y); });
  struct Ridge
  {
    Eigen::Vector3d at;
    double out;
  };
  std::vector<Ridge> ridge;
  skin.forEach(
      [&](int i, int k, double y)
      {
        if (i < beside || i + beside >= skin.width || k < beyond || k + beyond >= skin.height ||
            y > foremost + kBehind)
          return;
        const double left = skin.at(i - beside, k) - y, right = skin.at(i + beside, k) - y;
        const double below = skin.at(i, k - beyond) - y, above = skin.at(i, k + beyond) - y;
        // Not the edge of the jaw over the neck, and not the top of the head.
        if (std::min(left, right) >= kLeast && std::max(left, right) <= kMost &&
            std::min(below, above) >= -kAhead && std::max(below, above) <= kStep)
          ridge.push_back({{skin.x(i), y, skin.z(k)}, std::min(left, right)});
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
  return tip;
}

double quantile(std::vector<double> values, double share)
{
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// dy/dz of the profile from chin to brow, by least squares; 0 where the image does not hold both:
// of a low stack the slope of its few centimetres says nothing of the head's pitch.
double tiltOf(const std::vector<Column>& columns, const Eigen::Vector3d& front,
              const core::PatientBox& image, double size)
{
  const double below = 80.0 * size, above = 65.0 * size;
  if (image.min().z() > front.z() - below || image.max().z() < front.z() + above)
    return 0.0;
  double n = 0.0, z = 0.0, y = 0.0, zz = 0.0, zy = 0.0;
  for (const Column& column : columns)
    if (std::abs(column.x) <= 30.0 && column.z >= -below && column.z <= above)
    {
      n += 1.0;
      z += column.z;
      y += column.y;
      zz += column.z * column.z;
      zy += column.z * column.y;
    }
  const double spread = zz - z * z / std::max(n, 1.0);
  constexpr double kLeastDeviation = 15.0; // mm
  if (n < 50.0 || spread < n * kLeastDeviation * kLeastDeviation)
    return 0.0;
  return std::clamp((zy - z * y / n) / spread, -kMaxTilt, kMaxTilt);
}

// Size of the head, as a share of an adult's: by its breadth, where the image holds it.
double sizeOf(const CellSet& cells, const Eigen::Vector3d& front)
{
  const core::Index3 n = cells.dims();
  const double edge = cells.edge();
  const int first = static_cast<int>((front.y() + 60.0 - cells.center(0, 0, 0).y()) / edge);
  const int last = static_cast<int>((front.y() + 110.0 - cells.center(0, 0, 0).y()) / edge);
  std::vector<double> breadths;
  bool isWhole = true;
  for (int k = 0; k < n[2]; ++k)
  {
    if (cells.center(0, 0, k).z() < front.z() - 20.0 ||
        cells.center(0, 0, k).z() > front.z() + 90.0)
      continue;
    int low = n[0], high = -1;
    for (int j = std::max(first, 0); j < std::min(last, n[1]); ++j)
      for (int i = 0; i < n[0]; ++i)
        if ((cells.cells()[cells.index(i, j, k)] & kHead) != 0)
        {
          low = std::min(low, i);
          high = std::max(high, i);
        }
    if (high < low)
      continue;
    isWhole = isWhole && low > 1 && high < n[0] - 2;
    breadths.push_back(edge * (high - low + 1));
  }
  if (!isWhole || breadths.empty())
    return 1.0;
  return std::clamp(quantile(std::move(breadths), 0.6) / kBreadth, 0.7, 1.0);
}

// Thin parts at the sides of the head: what a cube of 16 mm does not fit in.
std::shared_ptr<const CellSet> auricles(const CellSet& cells, const FaceRegion& region, double size)
{
  const core::Index3 n = cells.dims();
  const int radius = static_cast<int>(std::lround(8.0 / cells.edge()));
  const core::IndexBox all{{0, 0, 0}, n};
  constexpr std::uint8_t kMarked = 1;
  std::vector<std::uint8_t> marks(cells.cells().size());
  std::transform(cells.cells().begin(), cells.cells().end(), marks.begin(),
                 [](std::uint8_t cell) { return cell == kAirCell || cell == kTissue ? 1 : 0; });
  const auto far = chebyshevDistances(marks.data(), 1, kMarked, n, all, radius + 1);
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        marks[cells.index(i, j, k)] = far.row(j, k)[i] > radius ? 1 : 0;
  const auto near = chebyshevDistances(marks.data(), 1, kMarked, n, all, radius + 1);
  core::PatientBox box(cells.center(0, 0, 0), cells.center(n[0] - 1, n[1] - 1, n[2] - 1));
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * cells.edge());
  CellSet ears(core::PatientBox(box.min() - half, box.max() + half), cells.edge());
  double left = -std::numeric_limits<double>::infinity(), right = -left;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        if (marks[cells.index(i, j, k)] != 0)
        {
          left = std::max(left, cells.center(i, j, k).x());
          right = std::min(right, cells.center(i, j, k).x());
        }
  const double middle = 0.5 * (left + right), side = 0.3 * (left - right);
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const Eigen::Vector3d at = cells.center(i, j, k);
        const double behind = at.y() - region.front.y() - region.tilt * (at.z() - region.front.z());
        const double above = at.z() - region.front.z();
        if ((cells.cells()[cells.index(i, j, k)] & kHead) != 0 && near.row(j, k)[i] > radius &&
            std::abs(at.x() - middle) > side && behind > 70.0 * size && behind < 170.0 * size &&
            above > -50.0 * size && above < 90.0 * size)
          ears.cells()[ears.index(i, j, k)] = 1;
      }
  ears.grow(2.0 * cells.edge());
  return std::make_shared<const CellSet>(std::move(ears));
}

FaceFinding none(const std::string& why)
{
  FaceFinding finding;
  finding.text = "no face in this volume: " + why;
  return finding;
}

// Voxels for which `isMasked(patient)` become air.
template <class IsMasked>
MaskedImage masked(const IntensityVolume& image, double air, const CellSet* keep,
                   const IsMasked& isMasked, const core::Progress& progress)
{
  const core::GridGeometry& grid = image.geometry();
  const core::Index3 n = grid.dims();
  const Eigen::Vector3d along = grid.patientFromVoxelLinear().col(0);
  std::atomic<std::size_t> changed{0}, kept{0};
  std::atomic<int> done{0};
  std::optional<IntensityVolume::Voxels> result;
  image.visit(
      [&](const auto& source)
      {
        using Value = typename std::decay_t<decltype(source)>::Value;
        const auto fill = rounded<Value>(air);
        auto target = std::make_shared<Volume<Value>>(grid);
        tbb::parallel_for(
            0, n[2],
            [&](int k)
            {
              progress.report(static_cast<double>(done.fetch_add(1)) / n[2], "masking");
              std::size_t other = 0, held = 0;
              for (int j = 0; j < n[1]; ++j)
              {
                const Value* from = &source.at(0, j, k);
                Value* to = &target->at(0, j, k);
                std::copy_n(from, n[0], to);
                const Eigen::Vector3d start = grid.patientFromVoxel(Eigen::Vector3d(0, j, k));
                for (int i = 0; i < n[0]; ++i)
                {
                  const Eigen::Vector3d at = start + along * i;
                  if (!isMasked(at))
                    continue;
                  if (keep && keep->contains(at))
                    ++held;
                  else if (to[i] != fill)
                  {
                    to[i] = fill;
                    ++other;
                  }
                }
              }
              changed += other;
              kept += held;
            });
        result = std::shared_ptr<const Volume<Value>>(std::move(target));
      });
  return {std::make_shared<const IntensityVolume>(*result, image.padding()), changed, kept};
}

} // namespace

CellSet::CellSet(const core::PatientBox& box, double edge)
  : m_lower(box.min())
  , m_edge(edge)
{
  for (std::size_t a = 0; a < 3; ++a)
    m_dims[a] =
        std::max(static_cast<int>(std::ceil(box.sizes()[static_cast<Eigen::Index>(a)] / edge)), 1);
  m_cells.assign(static_cast<std::size_t>(m_dims[0]) * static_cast<std::size_t>(m_dims[1]) *
                     static_cast<std::size_t>(m_dims[2]),
                 0);
}

bool CellSet::find(const Eigen::Vector3d& patient, std::size_t& cell) const noexcept
{
  const Eigen::Vector3d at = (patient - m_lower) / m_edge;
  if (!(at.minCoeff() >= 0.0 && at[0] < m_dims[0] && at[1] < m_dims[1] && at[2] < m_dims[2]))
    return false;
  cell = index(static_cast<int>(at[0]), static_cast<int>(at[1]), static_cast<int>(at[2]));
  return true;
}

void CellSet::add(const Eigen::Vector3d& patient) noexcept
{
  if (std::size_t cell = 0; find(patient, cell))
    m_cells[cell] = 1;
}

bool CellSet::contains(const Eigen::Vector3d& patient) const noexcept
{
  std::size_t cell = 0;
  return find(patient, cell) && m_cells[cell] != 0;
}

void CellSet::grow(double distance)
{
  const int radius = static_cast<int>(std::ceil(distance / m_edge));
  constexpr std::uint8_t kMarked = 1;
  const auto near =
      chebyshevDistances(m_cells.data(), 1, kMarked, m_dims, {{0, 0, 0}, m_dims}, radius + 1);
  for (int k = 0; k < m_dims[2]; ++k)
    for (int j = 0; j < m_dims[1]; ++j)
      for (int i = 0; i < m_dims[0]; ++i)
        m_cells[index(i, j, k)] = near.row(j, k)[i] <= radius ? 1 : 0;
}

bool CellSet::empty() const noexcept
{
  return std::none_of(m_cells.begin(), m_cells.end(), [](std::uint8_t cell) { return cell != 0; });
}

SkinScale skinScale(const IntensityVolume& image, bool isMr)
{
  const IntensityHistogram histogram(image);
  SkinScale scale;
  if (isMr)
    return {suggestMrScale(histogram).iso, 0.0, false};
  const IntensityScale bone = suggestScale(histogram);
  if (bone.calibrated)
    return scale;
  // 300 and 1800 HU are known.
  const double unit = (bone.dense - bone.iso) / 1500.0;
  return {bone.iso - 600.0 * unit, bone.iso - 1300.0 * unit, true};
}

double FaceRegion::planeAt(double z) const noexcept
{
  return front.y() + reach + tilt * (z - front.z());
}

bool FaceRegion::covers(const Eigen::Vector3d& p) const noexcept
{
  const double z = p.z() - front.z();
  return (z >= lower && z <= upper && p.y() < planeAt(p.z())) || (ears && ears->contains(p));
}

FaceFinding findFace(const IntensityVolume& image, const SkinScale& scale, bool ears,
                     const core::Progress& progress)
{
  CellSet cells = classified(image, scale, progress);
  const double edge = cells.edge();
  constexpr double kLeastHead = 1e4; // mm^3
  if (static_cast<double>(markHead(cells)) * edge * edge * edge < kLeastHead)
    return none("there is no head in it");
  progress.check("looking for a face");
  const Front front = frontOf(image, cells, scale.threshold);
  const FrontMap& skin = front.skin;

  FaceRegion region;
  region.air = scale.air;
  if (const auto nose = noseTip(skin))
    region.front = *nose;
  else // the image ends in it, or its front is not a face's
  {
    double foremost = std::numeric_limits<double>::infinity();
    for (const FrontMap* map : {&front.skin, &front.cutOff})
      map->forEach(
          [&](int i, int k, double y)
          {
            if (y >= foremost)
              return;
            foremost = y;
            region.front = {map->x(i), y, map->z(k)};
          });
    if (!std::isfinite(foremost))
      return none("the field of view ends before it");
  }
  const double size = sizeOf(cells, region.front);
  region.reach = kReach * size;
  region.lower = -kBelow * size;
  region.upper = kAbove * size;
  std::vector<Column> columns;
  const auto gather = [&]
  {
    columns.clear();
    skin.forEach(
        [&](int i, int k, double y)
        {
          const double z = skin.z(k) - region.front.z();
          if (z >= region.lower && z <= region.upper && y <= region.planeAt(skin.z(k)) - kFaceDepth)
            columns.push_back({skin.x(i) - region.front.x(), z, y});
        });
  };
  constexpr int kRounds = 6; // tilt and columns, each by the other
  for (int round = 0; round < kRounds; ++round)
  {
    gather();
    region.tilt = tiltOf(columns, region.front, image.geometry().patientBounds(), size);
  }
  // Where the bridge of a flattened nose was found, lips or chin may lie further in front.
  constexpr double kMiddle = 30.0, kFarthest = 15.0; // mm
  double ahead = 0.0;
  for (const Column& column : columns)
    if (std::abs(column.x) <= kMiddle && std::abs(column.z) <= 80.0 * size)
      ahead = std::max(ahead, region.front.y() + region.tilt * column.z - column.y);
  if (ahead <= kFarthest)
    region.front.y() -= ahead;
  gather();
  if (static_cast<double>(columns.size()) * edge * edge < kMinArea)
    return none("the field of view ends before it");
  std::vector<double> xs, zs, depths;
  for (const Column& column : columns)
  {
    xs.push_back(column.x);
    zs.push_back(column.z);
    depths.push_back(region.planeAt(column.z + region.front.z()) - column.y);
  }
  const auto extent = [](const std::vector<double>& all)
  { return quantile(all, 0.98) - quantile(all, 0.02); };
  if (extent(xs) < kMinWidth || extent(zs) < kMinHeight)
    return none("the field of view ends before it");
  region.depth = quantile(std::move(depths), 0.5);

  // Along y a masked voxel's border is as coarse as the voxels are.
  const double voxel = 1.0 / image.geometry().voxelFromPatientLinear().col(1).cwiseAbs().maxCoeff();
  if (flatShare(columns, 0.3 + 0.5 * voxel) >= kFlatShare)
  {
    FaceFinding finding = none("the front of the head is flat; its face is masked already");
    finding.kind = FaceFinding::Kind::Masked;
    return finding;
  }

  FaceFinding finding;
  finding.kind = FaceFinding::Kind::Face;
  for (const Column& column : columns)
    finding.skin.emplace_back(column.x + region.front.x(), column.y, column.z + region.front.z());
  if (!scale.isAirKnown)
  {
    std::vector<double> background;
    const core::Index3 n = cells.dims();
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          if (cells.cells()[cells.index(i, j, k)] == kAirCell)
            if (const Eigen::Vector3d at = cells.center(i, j, k); region.covers(at))
              background.push_back(image.sample(image.geometry().voxelFromPatient(at)));
    if (!background.empty())
      region.air = quantile(std::move(background), 0.5);
  }
  if (ears)
    region.ears = auricles(cells, region, size);
  finding.region = std::move(region);
  return finding;
}

MaskedImage maskFace(const IntensityVolume& image, const FaceRegion& region, const CellSet* keep,
                     const core::Progress& progress)
{
  return masked(
      image, region.air, keep, [&region](const Eigen::Vector3d& at) { return region.covers(at); },
      progress);
}

MaskedImage maskOutside(const IntensityVolume& image, const core::PatientBox& box,
                        const core::RigidTransform& boxFromImage, double air, const CellSet* keep,
                        const core::Progress& progress)
{
  const Eigen::Matrix3d rotation = boxFromImage.rotation().toRotationMatrix();
  const Eigen::Vector3d translation = boxFromImage.translation();
  return masked(
      image, air, keep,
      [&](const Eigen::Vector3d& at) { return !box.contains(rotation * at + translation); },
      progress);
}

} // namespace petrous::volume
