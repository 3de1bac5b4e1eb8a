#include "petrous/Volume/FaceMask.h"

#include "HeadCells.h"
#include "HeadPose.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
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
constexpr double kMinWidth = 60.0;   // of a face, mm
constexpr double kMinHeight = 30.0;  // mm
constexpr double kMinArea = 3000.0;  // mm^2
constexpr double kMinPart = 600.0;   // mm^2, of a part of one
constexpr double kMinPartSize = 8.0; // mm
constexpr double kMaxSkew = 8.0;     // mm, of a nose's sides
constexpr double kMaxTilt = 0.7;     // 35 degrees
constexpr double kFlatShare = 0.4;   // of the front on one plane: no face's

struct Column
{
  double x, z, y; ///< along the head's axes; x and z relative to F
};

double quantile(std::vector<double> values, double share)
{
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The largest share of columns that lie on one plane, if they do from side to side: of coarse
// voxels a part of a rounded front does, too.
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
  Eigen::Vector3d plane(0.0, 0.0, 0.0);
  const auto isOn = [tolerance](const Eigen::Vector3d& q, const Column& one)
  { return std::abs(q[0] + q[1] * one.x + q[2] * one.z - one.y) <= tolerance; };
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
    const auto count = static_cast<std::size_t>(std::count_if(
        columns.begin(), columns.end(), [&](const Column& one) { return isOn(q, one); }));
    if (count <= most)
      continue;
    most = count;
    plane = q;
  }
  std::vector<double> all, on;
  for (const Column& one : columns)
  {
    all.push_back(one.x);
    if (isOn(plane, one))
      on.push_back(one.x);
  }
  const auto breadth = [](const std::vector<double>& xs)
  { return xs.empty() ? 0.0 : quantile(xs, 0.95) - quantile(xs, 0.05); };
  constexpr double kAcross = 0.7;
  if (breadth(on) < kAcross * breadth(all))
    return 0.0;
  return static_cast<double>(most) / static_cast<double>(columns.size());
}

// dy/dz of the profile from chin to brow, by least squares; 0 where the image does not hold both:
// of a low stack the slope of its few centimetres says nothing of the head's pitch.
double tiltOf(const std::vector<Column>& columns, double size)
{
  const double below = 80.0 * size, above = 65.0 * size;
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
        if (marks[cells.index(i, j, k)] != 0 && (cells.cells()[cells.index(i, j, k)] & kHead) != 0)
        {
          left = std::max(left, cells.center(i, j, k).x());
          right = std::min(right, cells.center(i, j, k).x());
        }
  const double middle = 0.5 * (left + right), side = 0.3 * (left - right);
  const Eigen::Vector3d front = region.axes * region.front;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const Eigen::Vector3d at = cells.center(i, j, k);
        const double behind = at.y() - front.y() - region.tilt * (at.z() - front.z());
        const double above = at.z() - front.z();
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

FaceFinding maskedAlready()
{
  FaceFinding finding = none("the front of the head is flat; its face is masked already");
  finding.kind = FaceFinding::Kind::Masked;
  return finding;
}

FaceFinding doubtful(FaceFinding finding, const std::string& why)
{
  finding.kind = FaceFinding::Kind::Doubtful;
  finding.text =
      "the skin of a head lies in this volume, but where its face is cannot be told: " + why;
  return finding;
}

// Along y a masked voxel's border is as coarse as the voxels are.
double toleranceOf(const IntensityVolume& image, const Eigen::Matrix3d& axes)
{
  const Eigen::Vector3d along =
      (image.geometry().voxelFromPatientLinear() * axes.transpose()).col(1);
  return 0.3 + 0.5 / along.cwiseAbs().maxCoeff();
}

// A head as it is looked at.
struct View
{
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  std::optional<double> middle;        // x of the plane between its halves
  std::optional<Eigen::Vector3d> nose; // LPS mm
  double symmetry = 0.0;
  bool isLevel = true;
  std::string doubt; // why the head may look elsewhere
};

// The tip on which most of the pitches agree, and the pitch from which it is seen best: the middle
// one of those that see it, or 0.
void findPitch(const HeadCells& upright, double threshold, const SymmetryPlane& plane, View& view)
{
  constexpr double kStep = 15.0 * 3.14159265358979 / 180.0, kSame = 12.0;
  constexpr int kSteps = 4;
  struct Seen
  {
    int step;
    Eigen::Vector3d tip;
    double out;
  };
  std::vector<Seen> seen;
  for (int step = -kSteps; step <= kSteps; ++step)
  {
    const Eigen::Matrix3d axes = headAxes(plane.normal, step * kStep);
    const Front front = frontOf(upright, nullptr, threshold, axes);
    if (const auto nose = noseOf(front.skin, plane.offset))
      seen.push_back({step, axes.transpose() * nose->tip, nose->out});
  }
  struct Tip
  {
    Eigen::Vector3d at;
    double votes = 0.0;
    int pitch = 0;
  };
  std::vector<Tip> tips;
  for (const Seen& one : seen)
  {
    Tip tip{one.tip, 0.0, 0};
    std::vector<int> steps;
    for (const Seen& other : seen)
      if ((other.tip - one.tip).norm() <= kSame)
      {
        tip.votes += 1.0 + 0.01 * other.out;
        steps.push_back(other.step);
      }
    const bool isLevel = std::find(steps.begin(), steps.end(), 0) != steps.end();
    tip.pitch = isLevel ? 0 : steps[steps.size() / 2];
    tips.push_back(tip);
  }
  // Few that agree are chance, as where the nose is not in the image.
  constexpr double kEnough = 3.0;
  tips.erase(std::remove_if(tips.begin(), tips.end(),
                            [](const Tip& tip) { return tip.pitch != 0 && tip.votes < kEnough; }),
             tips.end());
  const auto most = std::max_element(tips.begin(), tips.end(),
                                     [](const Tip& a, const Tip& b) { return a.votes < b.votes; });
  if (most == tips.end())
  {
    view.axes = headAxes(plane.normal, 0.0);
    return;
  }
  // From below, a chin stands out as the nose does, which is above it.
  constexpr double kRival = 0.6;
  const Eigen::Vector3d up = headAxes(plane.normal, most->pitch * kStep).row(2);
  const Tip* best = &*most;
  for (const Tip& tip : tips)
    if (tip.votes >= kRival * most->votes && up.dot(tip.at - best->at) > kSame)
      best = &tip;
  view.nose = best->at;
  const int pitch = best->pitch;
  view.isLevel = pitch == 0;
  view.axes = headAxes(plane.normal, pitch * kStep);
}

// From what sides the head may be seen, the likeliest first.
std::vector<View> viewsOf(const HeadCells& upright, double threshold,
                          const core::Progress& progress)
{
  constexpr double kLeastSymmetry = 0.5, kTurned = 0.2588; // cos of 75 degrees
  constexpr double kLevel = 0.9986;                        // cos of 3 degrees
  constexpr double kWithoutNose = 0.85, kClearly = 0.05;
  constexpr double kFar = 0.2; // from the best
  double best = 0.0;
  std::vector<View> views;
  const auto rating = [](const View& view)
  { return view.symmetry * (view.nose ? 1.0 : kWithoutNose); };
  for (const SymmetryPlane& plane : symmetryPlanes(upright))
  {
    progress.check("looking for a face");
    if (plane.score < std::max(kLeastSymmetry, best - kFar) ||
        headAxes(plane.normal, 0.0)(1, 1) < kTurned)
      continue;
    best = std::max(best, plane.score);
    View view;
    view.symmetry = plane.score;
    view.middle = plane.offset;
    findPitch(upright, threshold, plane, view);
    if (view.axes.trace() > 1.0 + 2.0 * kLevel) // the image's own cells serve
    {
      view.axes.setIdentity();
      const Eigen::Vector3d center = 0.5 * (upright.hull.front() + upright.hull.back());
      view.middle = view.nose
                        ? view.nose->x()
                        : center.x() + (plane.offset - plane.normal.dot(center)) / plane.normal.x();
    }
    views.push_back(std::move(view));
  }
  std::stable_sort(views.begin(), views.end(),
                   [&rating](const View& a, const View& b) { return rating(a) > rating(b); });
  if (views.size() > 1 && rating(views[0]) - rating(views[1]) < kClearly)
    views.front().doubt = "its halves can be told apart in two ways";
  return views;
}

// Whether the front of the head is a plane, however it is pitched.
bool isFlat(const IntensityVolume& image, const HeadCells& upright, double threshold,
            const Eigen::Vector3d& left)
{
  constexpr double kStep = 25.0 * 3.14159265358979 / 180.0, kDeep = 60.0; // rad, mm
  constexpr int kSteps = 2;
  for (int step = -kSteps; step <= kSteps; ++step)
  {
    const Eigen::Matrix3d axes = headAxes(left, step * kStep);
    const Front front = frontOf(upright, &image, threshold, axes);
    double foremost = std::numeric_limits<double>::infinity();
    front.skin.forEach([&](int, int, double y) { foremost = std::min(foremost, y); });
    std::vector<Column> columns;
    front.skin.forEach(
        [&](int i, int k, double y)
        {
          if (y <= foremost + kDeep)
            columns.push_back({front.skin.x(i), front.skin.z(k), y});
        });
    const double edge = front.skin.edge;
    if (static_cast<double>(columns.size()) * edge * edge >= kMinArea &&
        flatShare(columns, toleranceOf(image, axes)) >= kFlatShare)
      return true;
  }
  return false;
}

// What is seen of a face from there.
FaceFinding faceIn(const IntensityVolume& image, const SkinScale& scale, const HeadCells& head,
                   const View& view, bool ears)
{
  const double edge = head.cells.edge();
  const Front front = frontOf(head, &image, scale.threshold, head.axes);
  const FrontMap& skin = front.skin;
  std::optional<double> near;
  if (view.nose)
    near = (head.axes * *view.nose).z();
  const auto nose = noseOf(skin, view.middle, near);
  Eigen::Vector3d tip(0.0, 0.0, 0.0); // along the head's axes, as all here
  bool isSkinForemost = true;
  if (nose)
    tip = nose->tip;
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
            tip = {map->x(i), y, map->z(k)};
            isSkinForemost = map == &front.skin;
          });
    if (!std::isfinite(foremost))
      return none("the field of view ends before it");
  }
  FaceRegion region;
  region.axes = head.axes;
  region.air = scale.air;
  const double size = sizeOf(head.cells, tip);
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
          const double z = skin.z(k) - tip.z();
          if (z >= region.lower && z <= region.upper &&
              y <= tip.y() + region.reach + region.tilt * z - kFaceDepth)
            columns.push_back({skin.x(i) - tip.x(), z, y});
        });
  };
  // The image must hold chin and brow.
  const auto isWithin = [&](double z)
  {
    return image.geometry().hullContains(image.geometry().voxelFromPatient(
        head.axes.transpose() * (tip + Eigen::Vector3d(0.0, 0.4 * region.reach, z * size))));
  };
  constexpr int kRounds = 6; // tilt and columns, each by the other
  const bool hasProfile = isWithin(-80.0) && isWithin(65.0);
  for (int round = 0; hasProfile && round < kRounds; ++round)
  {
    gather();
    region.tilt = tiltOf(columns, size);
  }
  // Where the bridge of a flattened nose was found, lips or chin may lie further in front.
  gather();
  constexpr double kMiddle = 30.0, kFarthest = 15.0; // mm
  double ahead = 0.0;
  for (const Column& column : columns)
    if (std::abs(column.x) <= kMiddle && std::abs(column.z) <= 80.0 * size)
      ahead = std::max(ahead, tip.y() + region.tilt * column.z - column.y);
  if (ahead <= kFarthest)
    tip.y() -= ahead;
  gather();
  region.front = head.axes.transpose() * tip;
  std::vector<double> xs, zs, depths;
  for (const Column& column : columns)
  {
    xs.push_back(column.x);
    zs.push_back(column.z);
    depths.push_back(tip.y() + region.reach + region.tilt * column.z - column.y);
  }
  const double area = static_cast<double>(columns.size()) * edge * edge;
  const auto extent = [](const std::vector<double>& all)
  { return all.empty() ? 0.0 : quantile(all, 0.98) - quantile(all, 0.02); };
  const bool isFace = area >= kMinArea && extent(xs) >= kMinWidth && extent(zs) >= kMinHeight;
  if (!isFace)
  {
    // The edge of a cheek beside what the field of view cuts off is no profile.
    std::size_t cutOff = 0;
    front.cutOff.forEach(
        [&](int, int k, double y)
        {
          const double z = front.cutOff.z(k) - tip.z();
          cutOff += z >= region.lower && z <= region.upper &&
                            y <= tip.y() + region.reach + region.tilt * z - kFaceDepth
                        ? 1
                        : 0;
        });
    if (!isSkinForemost || area < kMinPart || extent(xs) < kMinPartSize ||
        extent(zs) < kMinPartSize || 3 * cutOff > columns.size())
      return none("the field of view ends before it");
  }
  region.depth = quantile(std::move(depths), 0.5);

  if (flatShare(columns, toleranceOf(image, head.axes)) >= kFlatShare)
    return maskedAlready();

  FaceFinding finding;
  finding.kind = isFace ? FaceFinding::Kind::Face : FaceFinding::Kind::Part;
  for (const Column& column : columns)
    finding.skin.emplace_back(head.axes.transpose() *
                              Eigen::Vector3d(column.x + tip.x(), column.y, column.z + tip.z()));
  if (!scale.isAirKnown)
  {
    std::vector<double> background;
    const CellSet& cells = head.cells;
    const core::Index3 n = cells.dims();
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          if (cells.cells()[cells.index(i, j, k)] == kAirCell)
            if (const Eigen::Vector3d at = head.axes.transpose() * cells.center(i, j, k);
                region.covers(at))
              background.push_back(image.sample(image.geometry().voxelFromPatient(at)));
    if (!background.empty())
      region.air = quantile(std::move(background), 0.5);
  }
  if (ears)
    region.ears = auricles(head.cells, region, size);
  finding.region = std::move(region);

  if (!isFace)
    finding.text = "only a part of a face lies in this volume";
  std::string doubt = view.doubt;
  if (isFace && view.symmetry == 0.0 && (!nose || nose->skew > kMaxSkew))
    doubt = "its halves are not both in the image";
  if (isFace && !view.isLevel && !hasProfile)
    doubt = "it is pitched, and its chin or brow is not in the image";
  return doubt.empty() ? finding : doubtful(std::move(finding), doubt);
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

double FaceRegion::inFront(const Eigen::Vector3d& p) const noexcept
{
  const Eigen::Vector3d q = axes * (p - front);
  return reach + tilt * q.z() - q.y();
}

bool FaceRegion::covers(const Eigen::Vector3d& p) const noexcept
{
  const Eigen::Vector3d q = axes * (p - front);
  return (q.z() >= lower && q.z() <= upper && q.y() < reach + tilt * q.z()) ||
         (ears && ears->contains(axes * p));
}

double FaceRegion::turn() const noexcept
{
  const double slope = std::atan(tilt); // of the profile in the head's axes
  const Eigen::Vector3d forward =
      axes.transpose() * Eigen::Vector3d(0.0, -std::cos(slope), std::sin(slope));
  return std::acos(std::clamp(-forward.y(), -1.0, 1.0)) * 180.0 / 3.14159265358979;
}

FaceFinding findFace(const IntensityVolume& image, const SkinScale& scale, bool ears,
                     const core::Progress& progress)
{
  const HeadCells upright = headCells(image, scale, Eigen::Matrix3d::Identity(), progress);
  const double edge = upright.cells.edge();
  constexpr double kLeastHead = 1e4; // mm^3
  if (static_cast<double>(upright.count) * edge * edge * edge < kLeastHead)
    return none("there is no head in it");
  // Of a slab any plane along it mirrors one half on the other.
  constexpr double kLeastBreadth = 100.0; // mm
  std::vector<View> views;
  if (upright.hull.empty())
    return none("there is no head in it");
  if (upright.hull.back().x() - upright.hull.front().x() >= kLeastBreadth)
    views = viewsOf(upright, scale.threshold, progress);
  if (views.empty())
    views.emplace_back(); // an ear, or half a head
  if (views.front().symmetry > 0.0 &&
      isFlat(image, upright, scale.threshold, views.front().axes.row(0)))
    return maskedAlready();
  std::optional<FaceFinding> best;
  for (View& view : views)
  {
    const auto look = [&]
    {
      return view.axes.isIdentity()
                 ? faceIn(image, scale, upright, view, ears)
                 : faceIn(image, scale, headCells(image, scale, view.axes, progress), view, ears);
    };
    FaceFinding finding = look();
    if (finding.kind == FaceFinding::Kind::Doubtful && !view.isLevel && view.doubt.empty())
    {
      // Of a stack without chin or brow the pitch is taken as 0, unless the nose tells otherwise.
      View level = view;
      level.axes = headAxes(view.axes.row(0), 0.0);
      level.isLevel = true;
      std::swap(view, level);
      FaceFinding next = look();
      constexpr double kSame = 20.0;
      if (next.kind == FaceFinding::Kind::None ||
          (next.canBeMasked() && (next.region.front - finding.region.front).norm() <= kSame))
        finding = std::move(next);
      else
        std::swap(view, level);
    }
    constexpr double kSteep = 0.45; // a profile that is seen from far above or below
    constexpr int kMostLooks = 3;
    for (int n = 1;
         n < kMostLooks && finding.canBeMasked() && std::abs(finding.region.tilt) > kSteep; ++n)
    {
      const Eigen::Matrix3d before = view.axes;
      view.axes = Eigen::AngleAxisd(std::atan(finding.region.tilt), Eigen::Vector3d::UnitX())
                      .toRotationMatrix() *
                  view.axes;
      FaceFinding next = look();
      if (!next.canBeMasked() || std::abs(next.region.tilt) >= std::abs(finding.region.tilt))
      {
        view.axes = before;
        break;
      }
      finding = std::move(next);
    }
    if (finding.kind == FaceFinding::Kind::Masked)
      return finding;
    if (!best)
      best = std::move(finding);
    if (best->kind != FaceFinding::Kind::Doubtful)
      break;
  }
  return *best;
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
