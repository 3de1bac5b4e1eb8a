#include "SliceStack.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numeric>

#include <Eigen/Geometry>

namespace petrous::imaging
{

namespace
{

constexpr double kSamePlace = 1e-3;    // mm
constexpr double kSameFraction = 0.01; // of the usual gap: closer slices share one position
constexpr double kWholeGap = 0.05;     // a gap this close to a multiple lacks whole slices
constexpr std::size_t kPlacesNamed = 3;
constexpr std::size_t kPitchChange = 3; // wide gaps in a row that are a pitch change, not a loss
constexpr std::size_t kPitches = 2;     // runs of them: coarse, fine, coarse
constexpr double kWidestGap = 2.05;     // of the usual gap: what one missing slice leaves
constexpr double kLostGap = 1.5;        // of the usual gap: a slice may have stood in it
constexpr std::size_t kFewGuessed = 10; // one slice in so many may be guessed
constexpr double kMostly = 0.75;        // of the slices; what they do tells of the stack
constexpr double kSteepest = 1.0;       // tangent; no gantry or oblique stack leans by 45 degrees
constexpr std::size_t kStretches = 4;   // of one tilt each, of a series
constexpr std::size_t kStretch = 5;     // slices; fewer may lean by chance
constexpr double kBeside = 10.0;        // mm, between columns whose slices are at other heights
constexpr std::size_t kColumns = 64;    // of a series; more are no columns

double median(std::vector<double> values) ///< the lower of two middle values; not empty
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Right-handed orthonormal axes closest to the direction cosines of a slice.
Eigen::Matrix3d axesOf(const SliceHeader& slice)
{
  const Eigen::Vector3d row = slice.rowDirection->normalized();
  const Eigen::Vector3d column = slice.columnDirection->normalized();
  const Eigen::Vector3d normal = row.cross(column).normalized();
  Eigen::Matrix3d axes;
  axes.col(0) = (row + column.cross(normal)).normalized(); // splits the misfit between the two axes
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal;
  return axes;
}

/// A line e(t) = offset + slope t fitted to sideways shifts, and the maximum deviation from it.
struct ShiftLine
{
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  double worst = 0.0;

  void measure(const std::vector<double>& t, const std::vector<Eigen::Vector3d>& e)
  {
    worst = 0.0;
    for (std::size_t k = 0; k < t.size(); ++k)
      worst = std::max(worst, (e[k] - offset - slope * t[k]).norm());
  }
};

ShiftLine leastSquares(const std::vector<double>& t, const std::vector<Eigen::Vector3d>& e)
{
  const auto n = static_cast<double>(t.size());
  const double meanT = std::accumulate(t.begin(), t.end(), 0.0) / n;
  Eigen::Vector3d meanE = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& shift : e)
    meanE += shift / n;
  Eigen::Vector3d covariance = Eigen::Vector3d::Zero();
  double variance = 0.0;
  for (std::size_t k = 0; k < t.size(); ++k)
  {
    covariance += (t[k] - meanT) * (e[k] - meanE);
    variance += (t[k] - meanT) * (t[k] - meanT);
  }
  ShiftLine line;
  if (variance > 0.0)
    line.slope = covariance / variance;
  line.offset = meanE - line.slope * meanT;
  line.measure(t, e);
  return line;
}

/// Robust fit by medians of the steps, so that a few misplaced slices do not look like a tilt.
ShiftLine robustLine(const std::vector<double>& t, const std::vector<Eigen::Vector3d>& e)
{
  ShiftLine line;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    std::vector<double> slopes;
    for (std::size_t k = 0; k + 1 < t.size(); ++k)
      if (t[k + 1] - t[k] > kSamePlace)
        slopes.push_back((e[k + 1][axis] - e[k][axis]) / (t[k + 1] - t[k]));
    if (!slopes.empty())
      line.slope[axis] = median(slopes);
    std::vector<double> offsets;
    for (std::size_t k = 0; k < t.size(); ++k)
      offsets.push_back(e[k][axis] - line.slope[axis] * t[k]);
    line.offset[axis] = median(offsets);
  }
  line.measure(t, e);
  return line;
}

} // namespace

double sharedPlace(double spacing)
{
  constexpr double kShare = 0.01;
  return std::max(1e-3, kShare * spacing);
}

std::string decimals(double value, int digits)
{
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits);
  return end.ec == std::errc() ? std::string(text, end.ptr) : "?";
}

std::optional<double> finestPitch(const std::vector<double>& gaps, double least)
{
  constexpr double kEqual = 0.1; // share by which they may differ
  std::optional<double> pitch;
  for (std::size_t k = 0; k + kPitchChange <= gaps.size(); ++k)
  {
    const auto [low, high] = std::minmax({gaps[k], gaps[k + 1], gaps[k + 2]});
    const double gap = (gaps[k] + gaps[k + 1] + gaps[k + 2]) / kPitchChange;
    if (high <= (1.0 + kEqual) * low && gap >= least && (!pitch || gap < *pitch))
      pitch = gap;
  }
  return pitch;
}

std::vector<double> numbersAlong(const std::vector<SliceHeader>& slices)
{
  std::vector<double> numbers;
  for (const SliceHeader& slice : slices)
  {
    if (slice.pixels.frameCount > 1 && !slice.stackPosition)
      return {};
    numbers.push_back(slice.pixels.frameCount > 1 ? *slice.stackPosition : slice.instanceNumber);
  }
  return numbers;
}

SliceStack::SliceStack(std::vector<SliceHeader>& slices)
  : m_slices(slices)
{
  m_direction = axesOf(slices.front());
  const Eigen::Vector3d normal = m_direction.col(2);
  // Sorted by index, as headers are large.
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(slices.size());
  for (const SliceHeader& slice : slices)
    order.emplace_back(normal.dot(*slice.position), order.size());
  if (!std::is_sorted(order.begin(), order.end()))
  {
    std::sort(order.begin(), order.end());
    std::vector<SliceHeader> sorted;
    sorted.reserve(slices.size());
    for (const auto& [place, n] : order)
      sorted.push_back(std::move(slices[n]));
    slices = std::move(sorted);
  }
  for (const SliceHeader& slice : slices)
  {
    m_place.push_back(normal.dot(*slice.position));
    // The finest that occurs: some writers trim zeros.
    if (slice.positionStep > 0.0 && (m_step == 0.0 || slice.positionStep < m_step))
      m_step = slice.positionStep;
  }
}

/// The usual gap between slices, ignoring missing and duplicate ones, mm; 0 if all coincide.
double SliceStack::usualGap() const
{
  std::vector<double> gaps;
  for (std::size_t k = 0; k + 1 < m_place.size(); ++k)
    gaps.push_back(m_place[k + 1] - m_place[k]);
  std::sort(gaps.begin(), gaps.end());
  // The upper quartile is a valid gap even if every slice is present twice.
  double scale = gaps[(gaps.size() * 3) / 4 < gaps.size() ? (gaps.size() * 3) / 4 : 0];
  if (scale <= kSamePlace)
    scale = gaps.back();
  if (scale <= kSamePlace)
    return 0.0;
  gaps.erase(gaps.begin(), std::upper_bound(gaps.begin(), gaps.end(), 0.05 * scale));
  return median(gaps);
}

double SliceStack::pitch() const
{
  constexpr double kFinest = 0.05; // of the usual gap; closer slices are so by chance
  constexpr double kNearly = 0.9;  // of the gaps; the others may be off, or be guessed
  constexpr double kOften = 0.1;   // of the gaps, where no three of them follow each other
  constexpr double kDecimals = 4.0;
  const double usual = usualGap();
  const double apart = std::max(kSamePlace, kSameFraction * usual);
  const std::vector<double> allSteps = numberSteps();
  std::vector<double> gaps;
  std::vector<double> steps; // of the numbers, across the gaps
  for (std::size_t k = 0; k + 1 < m_place.size(); ++k)
    if (const double gap = m_place[k + 1] - m_place[k]; gap > apart)
    {
      gaps.push_back(gap);
      if (!allSteps.empty())
        steps.push_back(allSteps[k]);
    }
  const auto share = [](std::size_t part, std::size_t whole)
  { return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole); };

  const auto isSpacing = [&](double h)
  {
    const auto isNear = [off = kPlaceShare * h](double gap, double place)
    { return std::abs(gap - place) <= off; };
    std::size_t whole = 0;
    std::vector<double> acrossFine;
    std::vector<double> acrossUsual;
    for (std::size_t n = 0; n < gaps.size(); ++n)
    {
      whole += isNear(gaps[n], std::max(1.0, std::round(gaps[n] / h)) * h) ? 1 : 0;
      if (!steps.empty() && isNear(gaps[n], h))
        acrossFine.push_back(steps[n]);
      else if (!steps.empty() && isNear(gaps[n], usual))
        acrossUsual.push_back(steps[n]);
    }
    const bool isWhole = share(whole, gaps.size()) >= kNearly;
    if (acrossFine.empty() || acrossUsual.empty())
      return isWhole;
    const double step = median(acrossFine);
    const auto same =
        static_cast<std::size_t>(std::count(acrossFine.begin(), acrossFine.end(), step));
    if (step < 1.0 || share(same, acrossFine.size()) < kMostly)
      return isWhole; // the numbers tell nothing
    const auto on = static_cast<std::size_t>(std::count_if(
        acrossUsual.begin(), acrossUsual.end(), [step](double one) { return one <= step; }));
    if (share(on, acrossUsual.size()) >= kNearly)
      return false; // the scanner took them so
    return isWhole || share(acrossUsual.size() - on, acrossUsual.size()) >= kMostly;
  };

  std::vector<double> finer;
  if (const auto run = finestPitch(gaps, kFinest * usual))
    finer.push_back(*run);
  for (const double parts : {3.0, 2.0})
  {
    std::vector<double> near;
    std::copy_if(gaps.begin(), gaps.end(), std::back_inserter(near),
                 [h = usual / parts](double gap) { return std::abs(gap - h) <= kPlaceShare * h; });
    if (near.size() >= kPitchChange && share(near.size(), gaps.size()) >= kOften)
      finer.push_back(median(near));
  }
  std::sort(finer.begin(), finer.end());
  for (const double h : finer)
    // What is written with few decimals has gaps of several lengths by rounding alone.
    if (kLostGap * h < usual && h > kDecimals * m_step && isSpacing(h))
      return h;
  return usual;
}

std::vector<double> SliceStack::numberSteps() const
{
  const std::vector<double> numbers = numbersAlong(m_slices);
  std::vector<double> steps;
  for (std::size_t k = 0; k + 1 < numbers.size(); ++k)
    steps.push_back(std::abs(numbers[k + 1] - numbers[k]));
  return steps;
}

double SliceStack::tolerance(double spacing) const
{
  return std::max({kPlaceTolerance, kPlaceShare * spacing, m_step});
}

double SliceStack::sidewaysTolerance() const
{
  return tolerance(m_slices.front().pixelSpacing->minCoeff());
}

Eigen::Vector3d SliceStack::sideways(std::size_t k) const
{
  return *m_slices[k].position - *m_slices.front().position -
         m_direction.col(2) * (m_place[k] - m_place.front());
}

std::vector<SliceStack::Twin> SliceStack::twins() const
{
  const double apart = std::max(kSamePlace, kSameFraction * usualGap());
  const double beside = sidewaysTolerance();
  std::vector<Twin> twins(m_place.size(), Twin::None);
  std::vector<Eigen::Vector3d> taken; // places of this height
  for (std::size_t k = 0; k < m_place.size(); ++k)
  {
    if (k == 0 || m_place[k] - m_place[k - 1] > apart)
      taken.clear();
    const Eigen::Vector3d here = sideways(k);
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const Eigen::Vector3d& place) { return (here - place).norm() <= beside; }))
      twins[k] = Twin::SamePlace;
    else if (!taken.empty())
      twins[k] = Twin::Beside;
    if (twins[k] != Twin::SamePlace && taken.size() < kColumns)
      taken.push_back(here);
  }
  return twins;
}

std::size_t SliceStack::duplicates() const
{
  const std::vector<Twin> all = twins();
  return static_cast<std::size_t>(std::count(all.begin(), all.end(), Twin::SamePlace));
}

std::size_t SliceStack::besides() const
{
  const std::vector<Twin> all = twins();
  return static_cast<std::size_t>(std::count(all.begin(), all.end(), Twin::Beside));
}

std::vector<std::vector<std::size_t>> SliceStack::columns() const
{
  const double sameHeight = std::max(kSamePlace, kSameFraction * usualGap());
  const double tolerated = sidewaysTolerance();
  std::vector<std::vector<std::size_t>> columns;
  for (std::size_t k = 0; k < m_place.size() && columns.size() <= kColumns; ++k)
  {
    std::vector<std::size_t>* nearest = nullptr;
    double least = 0.0;
    for (auto& column : columns)
    {
      const double apart = (sideways(k) - sideways(column.back())).norm();
      const double up = m_place[k] - m_place[column.back()];
      const double allowed =
          up <= sameHeight ? tolerated : std::max(kBeside, tolerated + kSteepest * up);
      if (apart <= allowed && (!nearest || apart < least))
      {
        nearest = &column;
        least = apart;
      }
    }
    if (nearest)
      nearest->push_back(k);
    else
      columns.push_back({k});
  }
  if (columns.size() > kColumns)
    columns.clear();
  columns.erase(std::remove_if(columns.begin(), columns.end(),
                               [](const auto& column) { return column.size() < kFewest; }),
                columns.end());
  bool areBeside = false;
  double top = 0.0;                  // of those before
  for (const auto& column : columns) // in the order of their lowest slices
  {
    areBeside = areBeside || (&column != columns.data() && m_place[column.front()] <= top);
    top =
        std::max(&column == columns.data() ? m_place[column.back()] : top, m_place[column.back()]);
  }
  if (areBeside)
    return columns;
  columns.assign(1, std::vector<std::size_t>(m_place.size()));
  std::iota(columns.front().begin(), columns.front().end(), std::size_t{0});
  return columns;
}

Eigen::Vector2d SliceStack::lean(std::size_t first, std::size_t end) const
{
  std::vector<double> t;
  std::vector<Eigen::Vector3d> shift;
  for (std::size_t k = first; k < end; ++k)
  {
    t.push_back(m_place[k]);
    shift.push_back(sideways(k));
  }
  return (m_direction.transpose() * leastSquares(t, shift).slope).head<2>();
}

std::vector<std::size_t> SliceStack::tiltChanges() const
{
  const double allowed = sidewaysTolerance();
  const auto isStraight = [&](std::size_t first, std::size_t end)
  {
    std::vector<double> t;
    std::vector<Eigen::Vector3d> shift;
    for (std::size_t k = first; k < end; ++k)
    {
      t.push_back(m_place[k]);
      shift.push_back(sideways(k));
    }
    return leastSquares(t, shift).worst <= allowed;
  };
  const std::size_t count = m_place.size();
  std::vector<std::size_t> changes = {0};
  for (std::size_t first = 0;;)
  {
    std::size_t end = std::min(first + kStretch, count);
    if (end - first < kStretch || !isStraight(first, end))
      return {0};
    // The farthest end: a stretch is straight up to it and not beyond.
    std::size_t beyond = count + 1;
    for (std::size_t step = 1; end + step < beyond; step *= 2)
      (isStraight(first, end + step) ? end : beyond) = end + step;
    while (end + 1 < beyond)
    {
      const std::size_t middle = end + (beyond - end) / 2;
      (isStraight(first, middle) ? end : beyond) = middle;
    }
    if (end == count)
      break;
    changes.push_back(end);
    first = end;
    if (changes.size() > kStretches)
      return {0};
  }
  // A jump sideways is no change of tilt.
  for (std::size_t n = 1; n < changes.size(); ++n)
  {
    const std::size_t end = n + 1 < changes.size() ? changes[n + 1] : count;
    const double shorter = std::min(m_place[changes[n] - 1] - m_place[changes[n - 1]],
                                    m_place[end - 1] - m_place[changes[n]]);
    if ((lean(changes[n - 1], changes[n]) - lean(changes[n], end)).norm() * shorter <=
        2.0 * allowed)
      return {0};
  }
  return changes;
}

void SliceStack::judge(SeriesGeometry& result)
{
  m_spacing = pitch();
  followNumbers();
  judgeGaps(result);
  if (m_spacing <= 0.0)
    return;
  judgeLosses(result);
  judgeEvenness(result);
  judgeSideways(result);
  noteDeclarations(result);
}

void SliceStack::followNumbers()
{
  const std::vector<double> steps = numberSteps();
  std::vector<double> usual; // of those across a usual gap
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    const double gap = m_place[k + 1] - m_place[k];
    if (gap > std::max(kSamePlace, kSameFraction * m_spacing) && gap <= kLostGap * m_spacing)
      usual.push_back(steps[k]);
  }
  if (usual.empty())
    return;
  const double step = median(usual);
  if (step < 1.0 || static_cast<double>(std::count(usual.begin(), usual.end(), step)) <
                        kMostly * static_cast<double>(usual.size()))
    return;
  for (const double one : steps)
    m_goesOn.push_back(one <= step);
}

void SliceStack::judgeGaps(SeriesGeometry& result)
{
  const double usual = m_spacing;
  const std::vector<Twin> all = twins();
  const auto doubled =
      static_cast<std::size_t>(std::count(all.begin(), all.end(), Twin::SamePlace));
  const auto beside = static_cast<std::size_t>(std::count(all.begin(), all.end(), Twin::Beside));
  std::size_t run = 0;
  std::size_t longestRun = 0;
  std::vector<double> steps; // 1 where no slice is missing
  for (std::size_t k = 0; k + 1 < m_place.size(); ++k)
  {
    const double gap = m_place[k + 1] - m_place[k];
    double step = 1.0;
    if (all[k + 1] != Twin::None)
      step = 0.0;
    else if (std::round(gap / usual) >= 2.0 &&
             std::abs(gap / usual - std::round(gap / usual)) <= kWholeGap)
      step = std::round(gap / usual);
    run = step > 1.0 && (m_goesOn.empty() || m_goesOn[k]) ? run + 1 : 0;
    longestRun = std::max(longestRun, run);
    steps.push_back(step);
  }
  std::size_t missing = 0;
  std::size_t wide = 0;
  std::string where;
  m_number = {0.0};
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    const bool isPitch = longestRun >= kPitchChange && (m_goesOn.empty() || m_goesOn[k]);
    m_number.push_back(m_number.back() + (isPitch ? std::min(steps[k], 1.0) : steps[k]));
    if (steps[k] <= 1.0 || isPitch)
      continue;
    if (wide < kPlacesNamed)
      where += (wide == 0 ? "between " : ", between ") + decimals(m_place[k], 2) + " and " +
               decimals(m_place[k + 1], 2) + " mm";
    else if (wide == kPlacesNamed)
      where += " and elsewhere";
    ++wide;
    missing += static_cast<std::size_t>(std::min(steps[k], 1e6)) - 1;
  }

  if (beside > 0)
  {
    double farthest = 0.0;
    for (std::size_t k = 1; k < m_place.size(); ++k)
      if (all[k] == Twin::Beside)
        farthest = std::max(farthest, (sideways(k) - sideways(k - 1)).norm());
    result.findings.push_back(
        {FindingKind::SideBySide,
         std::to_string(beside) + " of " + std::to_string(m_slices.size()) +
             (beside == 1 ? " slices lies" : " slices lie") +
             " beside another at the same height, up to " + decimals(farthest, 1) +
             " mm away, as of reconstructions of either ear: they are not of one stack; keep the "
             "files of one in the folder.",
         farthest});
  }
  if (doubled > 0)
  {
    const auto first =
        static_cast<std::size_t>(std::find(all.begin(), all.end(), Twin::SamePlace) - all.begin());
    const double step = usual > 0.0 ? usual : m_slices.front().thickness.value_or(0.0);
    const double excess = static_cast<double>(doubled) * step;
    result.findings.push_back({FindingKind::DuplicateSlice,
                               std::to_string(doubled) + " of " + std::to_string(m_slices.size()) +
                                   " slices share their place with another (the first at " +
                                   decimals(m_place[first], 2) +
                                   " mm along the normal); stacked, the volume would be " +
                                   decimals(excess, 1) + " mm too long.",
                               excess});
  }
  if (missing > 0)
  {
    const double lost = static_cast<double>(missing) * usual;
    result.findings.push_back(
        {FindingKind::MissingSlice,
         std::to_string(missing) + (missing == 1 ? " slice is" : " slices are") +
             " missing along the normal " + where + ", where slices stand " + decimals(usual, 2) +
             " mm apart; closed up, what lies beyond would be " + decimals(lost, 1) + " mm off.",
         lost});
  }
}

/// What interpolation would have to guess: it may close what one missing slice leaves, in few
/// places.
void SliceStack::judgeLosses(SeriesGeometry& result)
{
  const double usual = m_spacing;
  std::size_t guessed = 0;
  std::size_t run = 0;
  std::size_t pitches = 0;
  std::size_t ofPitches = 0;
  double widest = 0.0;
  std::size_t at = 0;
  for (std::size_t k = 0; k + 1 < m_place.size(); ++k)
  {
    const double gap = m_place[k + 1] - m_place[k];
    if (gap > widest)
    {
      widest = gap;
      at = k;
    }
    const bool isLost = gap - m_step > kLostGap * usual;
    guessed += isLost ? 1 : 0;
    // Without numbers a coarser pitch cannot be told from slices lost in turn.
    run = isLost && !m_goesOn.empty() && m_goesOn[k] ? run + 1 : 0;
    pitches += run == kPitchChange ? 1 : 0;
    ofPitches += run == kPitchChange ? kPitchChange : run > kPitchChange ? 1 : 0;
  }
  if (pitches <= kPitches)
    guessed -= ofPitches;
  const std::size_t places = m_slices.size() - duplicates(); // a slice that came twice is one
  const std::size_t most = std::max<std::size_t>(1, places / kFewGuessed);
  if (widest - m_step > kWidestGap * usual)
    m_loss = " Nothing was measured for " + decimals(widest, 2) + " mm between " +
             decimals(m_place[at], 2) + " and " + decimals(m_place[at + 1], 2) +
             " mm, more than one missing slice leaves where slices stand " + decimals(usual, 2) +
             " mm apart; that is not interpolated.";
  else if (guessed > most)
    m_loss = " In " + std::to_string(guessed) + " places, " +
             decimals(static_cast<double>(guessed) * usual, 1) + " mm of " +
             decimals(m_place.back() - m_place.front(), 1) +
             " mm, a slice would have to be guessed; at most " + std::to_string(most) +
             (most == 1 ? " slice is" : " slices are") + " interpolated." +
             (m_goesOn.empty() ? " Whether slices were lost there or taken farther apart cannot be "
                                 "told, as no numbers run along the stack."
                               : "");
  result.isBridgeable = m_loss.empty();
  for (Finding& finding : result.findings)
    if (finding.kind == FindingKind::MissingSlice)
    {
      finding.text += m_loss;
      m_loss.clear();
    }
}

void SliceStack::judgeEvenness(SeriesGeometry& result)
{
  if (m_number.back() < 1.0)
    return;
  const double even = (m_place.back() - m_place.front()) / m_number.back();
  double worst = 0.0;
  std::size_t at = 0;
  for (std::size_t k = 0; k < m_place.size(); ++k)
  {
    const double off = std::abs(m_place[k] - m_place.front() - m_number[k] * even);
    if (off > worst)
    {
      worst = off;
      at = k;
    }
  }
  m_spacing = even;
  if (worst > tolerance(even))
    result.findings.push_back({FindingKind::UnevenSpacing,
                               "The slices do not stand evenly: near " + decimals(m_place[at], 2) +
                                   " mm along the normal one lies " + decimals(worst, 2) +
                                   " mm from where an even spacing of " + decimals(even, 3) +
                                   " mm would put it." + m_loss,
                               worst});
  else if (worst > kSamePlace)
    result.notes.push_back("Slices lie up to " + decimals(worst, 3) +
                           " mm off an even spacing; accepted.");
}

void SliceStack::judgeSideways(SeriesGeometry& result) const
{
  if (std::any_of(result.findings.begin(), result.findings.end(),
                  [](const Finding& f) { return f.kind == FindingKind::SideBySide; }))
    return; // several stacks lean in no way
  std::vector<double> t;
  std::vector<Eigen::Vector3d> shift;
  for (std::size_t k = 0; k < m_slices.size(); ++k)
  {
    t.push_back(m_place[k] - m_place.front());
    shift.push_back(sideways(k));
  }
  const double allowed = sidewaysTolerance();
  ShiftLine line = leastSquares(t, shift);
  if (line.worst > allowed)
    line = robustLine(t, shift);
  if (line.slope.norm() > kSteepest)
  {
    line = {shift.front(), Eigen::Vector3d::Zero(), 0.0};
    line.measure(t, shift);
  }

  const double tangent = line.slope.norm();
  const double slide = tangent * t.back();
  const double straight = std::max(kJitterTolerance, m_step);
  if (slide > straight || (tangent > kJitterShare && slide > m_step))
  {
    // Half, since a straight stack can at best have the middle slice in place.
    result.findings.push_back({FindingKind::GantryTilt,
                               "The gantry was tilted: the stack leans by " +
                                   decimals(std::atan(tangent) * 180.0 / M_PI, 1) +
                                   " degrees and slides " + decimals(slide, 1) +
                                   " mm sideways; read as a straight stack, its ends would lie " +
                                   decimals(0.5 * slide, 1) + " mm off.",
                               0.5 * slide});
  }
  if (line.worst > allowed)
    result.findings.push_back({FindingKind::UnevenSpacing,
                               "Slices lie up to " + decimals(line.worst, 2) +
                                   " mm sideways of one straight line through the stack.",
                               line.worst});
  else if (line.worst > kSamePlace || (slide > kSamePlace && slide <= straight))
    result.notes.push_back("Slices lie up to " + decimals(std::max(line.worst, slide), 3) +
                           " mm sideways of a straight stack; accepted.");
}

/// Headers often contradict the positions; the positions are what the scanner measured.
void SliceStack::noteDeclarations(SeriesGeometry& result) const
{
  const SliceHeader& first = m_slices.front();
  if (first.declaredSpacing &&
      std::abs(std::abs(*first.declaredSpacing) - m_spacing) > kJitterShare * m_spacing)
    result.notes.push_back("The header states slices " + decimals(*first.declaredSpacing, 3) +
                           " mm apart, their positions " + decimals(m_spacing, 3) +
                           " mm; the positions are used.");
  const bool tilted =
      std::any_of(result.findings.begin(), result.findings.end(),
                  [](const Finding& f) { return f.kind == FindingKind::GantryTilt; });
  if (first.declaredTilt && std::abs(*first.declaredTilt) > 0.1 && !tilted)
    result.notes.push_back("The header states a gantry tilt of " +
                           decimals(*first.declaredTilt, 1) +
                           " degrees, but the slices make a straight stack.");
}

std::optional<core::GridGeometry> SliceStack::grid() const
{
  if (m_spacing <= 0.0)
    return std::nullopt;
  const SliceHeader& first = m_slices.front();
  const Eigen::Vector2d& pixel = *first.pixelSpacing;
  return core::GridGeometry({first.columns, first.rows, static_cast<int>(m_slices.size())},
                            {pixel[1], pixel[0], m_spacing}, *first.position, m_direction);
}

} // namespace petrous::imaging
