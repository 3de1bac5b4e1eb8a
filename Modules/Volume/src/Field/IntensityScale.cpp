#include "petrous/Volume/IntensityScale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace petrous::volume
{

namespace
{

constexpr double kAir = -1000.0; // HU
constexpr double kSoft = 40.0;
constexpr double kFoot = -700.0; // where the default look of soft tissue begins
constexpr double kBone = IntensityScale{}.iso;
constexpr double kDense = IntensityScale{}.dense;
constexpr double kAirSlack = 100.0;
constexpr double kSoftSlack = 120.0;

constexpr std::size_t kLevels = 512;
constexpr double kSmoothing = 3.0; // levels
constexpr double kTrimmed = 5e-4;  // of the voxels at either end: metal, dead pixels

// The histogram at few levels, smoothed, so that its extrema are modes rather than noise.
class Density
{
public:
  Density(const IntensityHistogram& histogram, bool withoutFirst)
  {
    const auto& bins = histogram.bins();
    const double low = histogram.percentile(kTrimmed);
    const double high = histogram.percentile(1.0 - kTrimmed);
    // An integer number of bins per level avoids a comb of full and empty levels.
    const double wanted = std::max(high - low, histogram.binWidth());
    const double perLevel =
        std::max(1.0, std::ceil(wanted / histogram.binWidth() / static_cast<double>(kLevels)));
    m_width = perLevel * histogram.binWidth();
    const double offset = std::floor((low - histogram.lower()) / histogram.binWidth());
    m_lower = histogram.lower() + offset * histogram.binWidth();
    const auto levels = static_cast<std::size_t>(std::ceil((high - m_lower) / m_width)) + 1;
    counts.assign(std::max<std::size_t>(levels, 2), 0.0);
    for (std::size_t bin = withoutFirst ? 1 : 0; bin < bins.size(); ++bin)
    {
      const double level = std::floor((static_cast<double>(bin) - offset) / perLevel);
      const double last = static_cast<double>(counts.size()) - 1.0;
      counts[static_cast<std::size_t>(std::clamp(level, 0.0, last))] +=
          static_cast<double>(bins[bin]);
    }
    smooth();
  }

  double value(double level) const { return m_lower + (level + 0.5) * m_width; }
  // The last whose value is not above, within the levels that there are.
  std::size_t levelUpTo(double wanted) const
  {
    const double level = (wanted - value(0.0)) / m_width;
    return static_cast<std::size_t>(
        std::clamp(level, 0.0, static_cast<double>(counts.size()) - 1.0));
  }

  std::vector<double> counts;
  std::vector<double> smoothed;

private:
  void smooth()
  {
    const int reach = static_cast<int>(3.0 * kSmoothing);
    const int size = static_cast<int>(counts.size());
    smoothed.assign(counts.size(), 0.0);
    for (int i = 0; i < size; ++i)
      for (int d = -reach; d <= reach; ++d)
      {
        // Mirrored at the ends, so that a peak truncated by the range remains a peak.
        int from = i + d;
        from = from < 0 ? -1 - from : from >= size ? 2 * size - 1 - from : from;
        if (from >= 0 && from < size)
          smoothed[static_cast<std::size_t>(i)] += counts[static_cast<std::size_t>(from)] *
                                                   std::exp(-0.5 * d * d / kSmoothing / kSmoothing);
      }
  }

  double m_lower = 0.0;
  double m_width = 1.0;
};

// Sums over levels [first, last) in constant time.
class Moments
{
public:
  explicit Moments(const std::vector<double>& counts)
    : m_weight(counts.size() + 1, 0.0)
    , m_sum(counts.size() + 1, 0.0)
    , m_squares(counts.size() + 1, 0.0)
  {
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      m_weight[i + 1] = m_weight[i] + counts[i];
      const auto level = static_cast<double>(i);
      m_sum[i + 1] = m_sum[i] + counts[i] * level;
      m_squares[i + 1] = m_squares[i] + counts[i] * level * level;
    }
  }
  double mean(std::size_t first, std::size_t last) const
  {
    const double own = weight(first, last);
    return own > 0.0 ? (m_sum[last] - m_sum[first]) / own : 0.0;
  }
  double deviation(std::size_t first, std::size_t last) const // standard
  {
    const double own = weight(first, last);
    const double squares = m_squares[last] - m_squares[first];
    const double center = mean(first, last);
    return own > 0.0 ? std::sqrt(std::max(squares / own - center * center, 0.0)) : 0.0;
  }
  double weight(std::size_t first, std::size_t last) const
  {
    return m_weight[last] - m_weight[first];
  }
  // The class's contribution to the between-class variance, up to a constant.
  double between(std::size_t first, std::size_t last) const
  {
    const double own = weight(first, last);
    const double sum = m_sum[last] - m_sum[first];
    return own > 0.0 ? sum * sum / own : 0.0;
  }

private:
  std::vector<double> m_weight;
  std::vector<double> m_sum;
  std::vector<double> m_squares;
};

// Otsu's thresholds for two and for three classes, as first levels of the upper classes.
std::size_t twoClasses(const Moments& moments, std::size_t levels)
{
  std::size_t best = 1;
  double most = -1.0;
  for (std::size_t t = 1; t < levels; ++t)
  {
    const double between = moments.between(0, t) + moments.between(t, levels);
    if (between > most)
    {
      most = between;
      best = t;
    }
  }
  return best;
}

std::array<std::size_t, 2> threeClasses(const Moments& moments, std::size_t levels)
{
  std::array<std::size_t, 2> best{1, 2};
  double most = -1.0;
  for (std::size_t t = 1; t < levels; ++t)
    for (std::size_t u = t + 1; u < levels; ++u)
    {
      const double between =
          moments.between(0, t) + moments.between(t, u) + moments.between(u, levels);
      if (between > most)
      {
        most = between;
        best = {t, u};
      }
    }
  return best;
}

std::size_t modeIn(const std::vector<double>& smoothed, std::size_t first, std::size_t last)
{
  const auto begin = smoothed.begin();
  return static_cast<std::size_t>(std::max_element(begin + static_cast<std::ptrdiff_t>(first),
                                                   begin + static_cast<std::ptrdiff_t>(last)) -
                                  begin);
}

// Distance from the mode to half its height on one side, in levels.
double halfWidth(const std::vector<double>& smoothed, std::size_t mode, int side)
{
  const double half = 0.5 * smoothed[mode];
  double before = smoothed[mode];
  for (std::size_t i = mode, n = 1;; ++n)
  {
    if ((side < 0 && i == 0) || (side > 0 && i + 1 == smoothed.size()))
      return static_cast<double>(n);
    i = side < 0 ? i - 1 : i + 1;
    if (smoothed[i] <= half)
      return static_cast<double>(n) - (half - smoothed[i]) / (before - smoothed[i]);
    before = smoothed[i];
  }
}

struct Tissues
{
  double air = 0.0;
  double soft = 0.0;
  double softNoise = 0.0;       // standard deviation
  double upper = 0.0;           // Otsu's threshold between soft tissue and bone
  bool cutOff = false;          // air is below the file's value range
  std::optional<double> airEnd; // of its noise; nullopt: the lower peak may be another tissue's
};

// Level at which the noise of the lower of the three classes' peaks ends; nullopt if that need not
// be air.
std::optional<double> airEnd(const Density& density, const Moments& moments,
                             const std::array<std::size_t, 2>& classes, std::size_t air,
                             std::size_t soft)
{
  constexpr double kEnd = 0.02;     // of the lower peak's height above the valley
  constexpr double kNoise = 3.5;    // standard deviations
  constexpr double kBelow = 0.01;   // of the class, at most, below its noise
  constexpr double kNarrow = 0.5;   // of the deviation of bone, at most
  constexpr double kWide = 0.22;    // deviation of bone, of the distance from air to soft tissue
  constexpr double kBoneAway = 2.0; // of that distance, at most
  const std::vector<double>& s = density.smoothed;
  const auto [first, second] = classes;
  const double noise = std::min(halfWidth(s, air, -1), halfWidth(s, air, 1)) / 1.1774;
  const double apart = static_cast<double>(soft) - static_cast<double>(air);
  const double wide = moments.deviation(second, s.size());
  const auto noiseBegins =
      static_cast<std::size_t>(std::max(static_cast<double>(air) - std::ceil(kNoise * noise), 0.0));
  if (moments.weight(0, noiseBegins) > kBelow * moments.weight(0, first) ||
      moments.deviation(0, first) > kNarrow * wide || wide < kWide * apart ||
      moments.mean(second, s.size()) - static_cast<double>(soft) > kBoneAway * apart)
    return std::nullopt;
  const double valley = *std::min_element(s.begin() + static_cast<std::ptrdiff_t>(air),
                                          s.begin() + static_cast<std::ptrdiff_t>(soft));
  const double floor = valley + kEnd * (std::min(s[air], s[soft]) - valley);
  std::size_t end = air;
  while (s[end] > floor) // at the valley at the latest
    ++end;
  return density.value(static_cast<double>(end));
}

// Peaks of air and of soft tissue, and a tail of bone above; nullopt if one is missing.
std::optional<Tissues> findTissues(const Density& density)
{
  constexpr double kValley = 0.5;   // of the lower peak, at most
  constexpr double kFall = 0.5;     // of the soft peak, at most, where bone begins
  constexpr double kPresent = 0.01; // of the voxels, at least, in each of both
  constexpr double kBoneAway = 0.3; // of the distance from air to soft tissue, above the latter
  const std::vector<double>& s = density.smoothed;
  if (s.size() < 8)
    return std::nullopt;
  const Moments moments(density.counts);
  const auto [first, second] = threeClasses(moments, s.size());
  const std::size_t air = modeIn(s, 0, first);
  const std::size_t soft = modeIn(s, first, second);
  const double lower = std::min(s[air], s[soft]);
  const double valley = *std::min_element(s.begin() + static_cast<std::ptrdiff_t>(air),
                                          s.begin() + static_cast<std::ptrdiff_t>(soft));
  const double apart = static_cast<double>(soft) - static_cast<double>(air);
  const double bone = moments.mean(second, s.size());
  const double present = kPresent * moments.weight(0, s.size());
  if (moments.weight(0, first) < present || moments.weight(first, second) < present ||
      valley > kValley * lower || s[second] > kFall * s[soft] ||
      bone - static_cast<double>(soft) < kBoneAway * apart)
    return std::nullopt;
  Tissues tissues;
  tissues.air = density.value(static_cast<double>(air));
  tissues.soft = density.value(static_cast<double>(soft));
  // Fat widens one side, bone the other; the smoothing widens both.
  const double half = std::min(halfWidth(s, soft, -1), halfWidth(s, soft, 1)) / 1.1774;
  tissues.softNoise = (density.value(1.0) - density.value(0.0)) *
                      std::sqrt(std::max(half * half - kSmoothing * kSmoothing, 0.0));
  tissues.upper = density.value(static_cast<double>(second) - 0.5);
  tissues.airEnd = airEnd(density, moments, {first, second}, air, soft);
  return tissues;
}

bool near(double value, double wanted, double slack)
{
  return std::abs(value - wanted) <= slack;
}

// Hounsfield units, judged by the main peak: air outside, or soft tissue in a region inside the
// head.
bool looksCalibrated(const IntensityHistogram& histogram, const Density& density)
{
  if (histogram.range().min > -100.0)
    return false;
  const double mode =
      density.value(static_cast<double>(modeIn(density.smoothed, 0, density.smoothed.size())));
  return near(mode, kAir, kAirSlack) || near(mode, kSoft, kSoftSlack);
}

// Hounsfield units of a part of a head, where peaks need not be those of air and soft tissue: bone
// is one, air has none, or that of air cells is of their walls, too. Judged by values that hardly
// any other unit has together: soft tissue stands out at 40 HU; something is below zero, which is
// not in images that begin at air; nothing is below air; and the densest is bone.
bool looksLikePartInHounsfield(const IntensityHistogram& histogram, const Density& density,
                               const std::optional<Tissues>& tissues)
{
  constexpr ValueRange kSoftMode{10.0, 90.0};   // HU: brain, muscle; air of other units is at 0
  constexpr ValueRange kDensest{700.0, 2600.0}; // HU: bone and enamel
  constexpr double kBelowZero = -30.0;          // HU: fat, or noise of soft tissue
  constexpr double kLowest = -1150.0;           // HU: noise of air
  constexpr double kCells = -800.0;             // HU: air cells, blurred
  constexpr double kFat = -200.0;               // HU
  constexpr double kDensestShare = 0.999;
  const auto isIn = [](double value, const ValueRange& range)
  { return value >= range.min && value <= range.max; };
  const std::vector<double>& s = density.smoothed;
  const double least = histogram.range().min;
  const double lowest = histogram.percentile(kTrimmed);
  // The highest above air.
  const double mode =
      density.value(static_cast<double>(modeIn(s, density.levelUpTo(kCells), s.size())));
  const bool isAirElsewhere = tissues && tissues->air > kCells && tissues->air < kFat;
  return least <= kBelowZero && lowest >= kLowest && isIn(mode, kSoftMode) &&
         isIn(histogram.percentile(kDensestShare), kDensest) && !isAirElsewhere;
}

// Outside the scanner's field of view, images often have one constant value, which is not tissue.
bool hasFrame(const IntensityHistogram& histogram)
{
  const auto& bins = histogram.bins();
  if (bins.size() < 16)
    return false;
  const double beside =
      static_cast<double>(std::accumulate(bins.begin() + 1, bins.begin() + 9, std::uint64_t{0})) /
      8.0;
  const auto own = static_cast<double>(bins.front());
  return own > 0.02 * static_cast<double>(histogram.count()) && own > 20.0 * beside;
}

// True if the values up to `air` have no peak of their own apart from the first bin.
bool isFlank(const IntensityHistogram& histogram, double air)
{
  const auto& bins = histogram.bins();
  const double bin = std::clamp((air - histogram.lower()) / histogram.binWidth(), 1.0,
                                static_cast<double>(bins.size() - 2));
  const auto last = bins.begin() + static_cast<std::ptrdiff_t>(bin) + 2;
  return 2 * bins[1] > *std::max_element(bins.begin() + 1, last);
}

// Puts iso within the range, and dense bone at `dense` or, if more, at the 99th percentile above
// it.
void placeDense(const IntensityHistogram& histogram, double dense, IntensityScale& scale)
{
  scale.iso = std::clamp(scale.iso, histogram.range().min, histogram.range().max);
  const double least = std::max(histogram.binWidth(), 1e-6 * std::abs(scale.iso));
  scale.dense = std::max({dense, histogram.percentile(0.99, scale.iso), scale.iso + least});
}

std::optional<Tissues> findTissues(const IntensityHistogram& histogram)
{
  const bool framed = hasFrame(histogram);
  std::optional<Tissues> tissues;
  if (framed)
    tissues = findTissues(Density(histogram, true));
  if (tissues && isFlank(histogram, tissues->air))
    tissues.reset();
  if (!tissues)
  {
    tissues = findTissues(Density(histogram, false));
    if (tissues)
      tissues->cutOff = framed;
  }
  return tissues;
}

// Upper end of the noise of air in an MR, in levels: its magnitude has a Rayleigh distribution
// there, with the mode s and half the height at 2.13 s, and 0.07 % of it are above s + 2.5 (2.13 s
// - s). The lowest peak is that of noise if it is as wide as it is far from zero; tissue's is
// narrower. nullopt: there is none.
std::optional<double> noiseCeiling(const IntensityHistogram& histogram, const Density& density,
                                   std::size_t levels)
{
  constexpr double kPeak = 0.1;   // of the highest, at least
  constexpr double kWidths = 2.5; // half widths at half the height
  constexpr double kWide = 0.5;   // half widths from zero to the mode, at least
  const std::vector<double>& s = density.smoothed;
  const double highest = s[modeIn(s, 0, levels)];
  std::size_t mode = 0;
  while (mode + 1 < levels && (s[mode] < kPeak * highest || s[mode + 1] > s[mode]))
    ++mode;
  const double width = halfWidth(s, mode, 1);
  const double step = density.value(1.0) - density.value(0.0);
  const double above = (density.value(static_cast<double>(mode)) - histogram.range().min) / step;
  if (width < kWide * above && above > 2.0 * kSmoothing)
    return std::nullopt;
  return static_cast<double>(mode) + kWidths * width;
}

} // namespace

IntensityScale suggestScale(const IntensityHistogram& histogram)
{
  if (histogram.count() == 0)
    return {};
  const Density density(histogram, false);
  const std::optional<Tissues> tissues = findTissues(histogram);
  if (tissues ? near(tissues->air, kAir, kAirSlack) && near(tissues->soft, kSoft, kSoftSlack)
              : looksCalibrated(histogram, density))
    return {};
  if (looksLikePartInHounsfield(histogram, density, tissues))
  {
    IntensityScale part;
    part.isOfPart = true;
    return part;
  }

  IntensityScale scale;
  scale.calibrated = false;
  double dense = -std::numeric_limits<double>::infinity();
  if (tissues)
  {
    const double gain = (tissues->soft - tissues->air) / (kSoft - kAir);
    const auto from = [&](double hounsfield)
    { return tissues->soft + gain * (hounsfield - kSoft); };
    const double clear = tissues->soft + 2.5 * tissues->softNoise;
    scale.iso = std::max(from(kBone), std::min(clear, tissues->upper));
    if (tissues->airEnd)
      scale.soft = {std::max(from(kFoot), *tissues->airEnd), tissues->soft};
    if (tissues->cutOff) // the gain may be larger, so iso lies between the two
      scale.iso = std::max(scale.iso, 0.5 * (scale.iso + tissues->upper));
    else
      dense = from(kDense);
  }
  else
  {
    const Moments moments(density.counts);
    const std::size_t levels = density.counts.size();
    const std::size_t t = twoClasses(moments, levels);
    scale.iso = density.value(0.5 * (moments.mean(0, t) + moments.mean(t, levels)));
  }
  placeDense(histogram, dense, scale);
  return scale;
}

IntensityScale scaleThrough(const SoftTissueValues& values) noexcept
{
  const double gain = (values.peak - values.foot) / (kSoft - kFoot);
  const auto at = [&](double hounsfield) { return values.peak + gain * (hounsfield - kSoft); };
  return {at(kBone), at(kDense), false, values};
}

namespace
{

// Of an MR.
struct MrLevels
{
  explicit MrLevels(const IntensityHistogram& histogram)
    : density(histogram, false)
    , moments(density.counts)
    , classes(threeClasses(moments, density.counts.size()))
  {
    // Without the constant value outside of the field of view, which is no noise.
    const bool isFramed = hasFrame(histogram);
    ceiling = noiseCeiling(histogram, isFramed ? Density(histogram, true) : density, classes[0]);
    if (isFramed && !ceiling) // air is constant
      ceiling = 3.0 * kSmoothing;
  }

  Density density;
  Moments moments;
  std::array<std::size_t, 2> classes; // first levels of tissue, and of what is bright
  std::optional<double> ceiling;      // of noise, level
};

} // namespace

IntensityScale suggestMrScale(const IntensityHistogram& histogram)
{
  constexpr double kMost = 0.5; // of what is above noise
  if (histogram.count() == 0)
    return {0.0, 1.0, false};
  const MrLevels levels(histogram);
  const Moments& moments = levels.moments;
  const auto [first, second] = levels.classes;
  const std::size_t count = levels.density.counts.size();
  IntensityScale scale;
  scale.calibrated = false;
  // A threshold anywhere between two classes parts them, but only half of the step leaves a blurred
  // edge in its place.
  double surface = 0.5 * (moments.mean(0, first) + moments.mean(first, second));
  // Few voxels of very bright fluid or fat take two of the three classes, and tissue is in that of
  // air.
  if (levels.ceiling)
  {
    const auto noise = std::min(static_cast<std::size_t>(*levels.ceiling) + 1, count);
    const auto below = std::clamp(static_cast<std::size_t>(surface), noise, count);
    if (moments.weight(noise, below) > kMost * moments.weight(noise, count))
      surface = 0.5 * (moments.mean(0, noise) + moments.mean(noise, below));
  }
  scale.iso = levels.density.value(surface);
  placeDense(histogram, -std::numeric_limits<double>::infinity(), scale);
  return scale;
}

double mrNoiseCeiling(const IntensityHistogram& histogram)
{
  if (histogram.count() == 0)
    return 0.0;
  const double iso = suggestMrScale(histogram).iso;
  const MrLevels levels(histogram);
  return levels.ceiling ? std::min(iso, levels.density.value(*levels.ceiling)) : iso;
}

} // namespace petrous::volume
