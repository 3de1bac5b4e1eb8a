#include "SeriesRepair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "SliceStack.h"

namespace petrous::imaging
{

namespace
{

constexpr double kWhole = 1e-3;    // pixels; a smaller shift moves nothing
constexpr double kOnPlace = 1e-3;  // mm
constexpr double kOnLine = 0.5;    // pixels
constexpr double kMost = 0.75;     // of the slices
constexpr std::size_t kNamed = 24; // ranges of slices named in a note

bool hasFinding(const SeriesGeometry& geometry, FindingKind kind)
{
  return std::any_of(geometry.findings.begin(), geometry.findings.end(),
                     [kind](const Finding& f) { return f.kind == kind; });
}

void appendSlice(std::vector<volume::SliceRange>& ranges, int slice)
{
  if (!ranges.empty() && ranges.back().last + 1 == slice)
    ranges.back().last = slice;
  else
    ranges.push_back({slice, slice});
}

/// "3, 7 to 9"; of too many the first and the last: "3 to 99".
std::string namedRanges(std::vector<volume::SliceRange> ranges)
{
  if (ranges.size() > kNamed)
    ranges = {{ranges.front().first, ranges.back().last}};
  std::string text;
  for (const auto& [first, last] : ranges)
    text += (text.empty() ? "" : ", ") + std::to_string(first + 1) +
            (last > first ? " to " + std::to_string(last + 1) : "");
  return text;
}

/// The finest pitch: of the runs of equal gaps the smallest, however few slices it has, or where
/// there is none the lower quartile of the gaps.
double fineGap(const std::vector<double>& places, double mean)
{
  constexpr double kFinestPitch = 0.05;
  constexpr double kFinest = 0.25; // of the mean; by chance a few slices lie closer together
  std::vector<double> gaps;
  for (std::size_t k = 0; k + 1 < places.size(); ++k)
    gaps.push_back(places[k + 1] - places[k]);
  const auto pitch = finestPitch(gaps, kFinestPitch * mean);
  std::sort(gaps.begin(), gaps.end());
  const double usual = std::max(gaps[gaps.size() / 4], kFinest * mean);
  return pitch ? std::min(*pitch, usual) : usual;
}

/// One row of a slice shifted by (u, v) pixels, by linear interpolation; NaN beyond its edges and
/// where padding takes part.
template <class T>
class ShiftedSlice
{
public:
  ShiftedSlice(const volume::Volume<T>& stacked, int k, double u, double v,
               std::optional<double> padding)
    : m_stacked(stacked)
    , m_k(k)
    , m_padding(padding)
  {
    m_i = static_cast<int>(std::floor(-u));
    m_x = -u - m_i;
    m_j = static_cast<int>(std::floor(-v));
    m_y = -v - m_j;
  }

  double at(int i, int j) const
  {
    double sum = 0.0;
    for (int dj = 0; dj < 2; ++dj)
      for (int di = 0; di < 2; ++di)
      {
        const double weight = (dj ? m_y : 1.0 - m_y) * (di ? m_x : 1.0 - m_x);
        if (weight == 0.0)
          continue;
        const int column = i + m_i + di;
        const int row = j + m_j + dj;
        const auto& n = m_stacked.geometry().dims();
        if (column < 0 || row < 0 || column >= n[0] || row >= n[1])
          return kOutside;
        const auto value = static_cast<double>(m_stacked.at(column, row, m_k));
        if (m_padding && value == *m_padding)
          return kOutside;
        sum += weight * value;
      }
    return sum;
  }

private:
  static constexpr double kOutside = std::numeric_limits<double>::quiet_NaN();

  const volume::Volume<T>& m_stacked;
  int m_k;
  std::optional<double> m_padding;
  int m_i = 0;
  int m_j = 0;
  double m_x = 0.0;
  double m_y = 0.0;
};

} // namespace

SeriesRepair::SeriesRepair(const SeriesGeometry& geometry)
{
  const core::GridGeometry& nominal = *geometry.grid;
  const Eigen::Matrix3d& axes = nominal.direction();
  const Eigen::Vector3d origin = *geometry.slices.front().position;
  const double same = sharedPlace(nominal.spacing()[2]);
  const bool isTilted = hasFinding(geometry, FindingKind::GantryTilt);
  m_isUneven = hasFinding(geometry, FindingKind::UnevenSpacing);
  m_isMissing = hasFinding(geometry, FindingKind::MissingSlice) && !m_isUneven;

  std::vector<double> places;
  for (std::size_t k = 0; k < geometry.slices.size(); ++k)
  {
    const Eigen::Vector3d way = axes.transpose() * (*geometry.slices[k].position - origin);
    if (!places.empty() && way[2] - places.back() <= same)
      continue;
    Slice slice;
    slice.index = static_cast<int>(k);
    slice.place = way[2];
    slice.isGuess = isInterpolated(geometry.slices[k]);
    if (isTilted || m_isUneven) // else within the tolerance
    {
      slice.u = way[0] / nominal.spacing()[0];
      slice.v = way[1] / nominal.spacing()[1];
    }
    places.push_back(slice.place);
    m_slices.push_back(slice);
  }

  double lower[2] = {0.0, 0.0};
  double upper[2] = {0.0, 0.0};
  for (Slice& slice : m_slices)
    for (const int axis : {0, 1})
    {
      double& shift = axis == 0 ? slice.u : slice.v;
      if (std::abs(shift - std::round(shift)) < kWhole)
        shift = std::round(shift);
      lower[axis] = std::min(lower[axis], std::floor(shift));
      upper[axis] = std::max(upper[axis], std::ceil(shift));
    }
  for (Slice& slice : m_slices)
  {
    slice.u -= lower[0];
    slice.v -= lower[1];
  }
  const double mean = nominal.spacing()[2];
  const double usual = m_isUneven ? fineGap(places, mean) : mean;
  const int steps = std::max(1, static_cast<int>(std::lround(places.back() / usual)));
  const Eigen::Vector3d& h = nominal.spacing();
  m_grid = core::GridGeometry(
      {nominal.dims()[0] + static_cast<int>(upper[0] - lower[0]),
       nominal.dims()[1] + static_cast<int>(upper[1] - lower[1]), steps + 1},
      {h[0], h[1], places.back() / steps},
      origin + axes.col(0) * (lower[0] * h[0]) + axes.col(1) * (lower[1] * h[1]), axes);

  if (const std::size_t dropped = geometry.slices.size() - m_slices.size(); dropped > 0)
    m_notes.push_back(
        "Repaired: of slices at one place, whose pixels are equal, the first was kept, and " +
        std::to_string(dropped) + " left out.");
  const auto slideOf = [&](const Slice& slice)
  {
    return std::hypot((slice.u - m_slices.front().u) * h[0], (slice.v - m_slices.front().v) * h[1]);
  };
  double farthest = 0.0;
  for (const Slice& slice : m_slices)
    farthest = std::max(farthest, slideOf(slice));
  const Slice& last = m_slices.back();
  // A gantry leans one way, so that most slices lie on the line from the first to the last.
  const Slice& base = m_slices.front();
  const auto isOnLine = [&](const Slice& slice)
  {
    const double share = slice.place / last.place;
    return std::hypot(slice.u - base.u - share * (last.u - base.u),
                      slice.v - base.v - share * (last.v - base.v)) <= kOnLine;
  };
  const auto count = std::count_if(m_slices.begin(), m_slices.end(), isOnLine);
  if (isTilted && slideOf(last) >= farthest - kOnPlace &&
      static_cast<double>(count) >= kMost * static_cast<double>(m_slices.size()))
  {
    m_tilt = std::atan2(slideOf(last), last.place) * 180.0 / M_PI;
    m_shift = slideOf(last);
    m_notes.push_back("Repaired: the gantry's tilt of " + decimals(m_tilt, 1) +
                      " degrees was undone by shifting each slice to where its position puts it, "
                      "the last by " +
                      decimals(m_shift, 1) + " mm against the first.");
  }
  else if ((isTilted || m_isUneven) && farthest > kOnPlace)
  {
    m_shift = farthest;
    m_notes.push_back("Repaired: slices were shifted sideways to where their positions put them, "
                      "by up to " +
                      decimals(farthest, 2) + " mm against the first.");
  }
  if (hasFinding(geometry, FindingKind::MixedRescale))
    m_notes.push_back("Repaired: each slice's own rescale slope and intercept were applied.");
}

std::vector<volume::SliceRange> interpolatedBefore(const SeriesGeometry& geometry, int first,
                                                   int end)
{
  std::vector<volume::SliceRange> ranges;
  for (int k = first; k < end; ++k)
    if (isInterpolated(geometry.slices[static_cast<std::size_t>(k)]))
      appendSlice(ranges, k - first);
  return ranges;
}

std::string interpolatedBeforeNote(const std::vector<volume::SliceRange>& slices, int count)
{
  if (slices.empty())
    return {};
  const bool isOne = volume::sliceCount(slices) == 1;
  return std::string("Repaired: ") + (isOne ? "slice " : "slices ") + namedRanges(slices) + " of " +
         std::to_string(count) + (isOne ? " was" : " were") +
         " interpolated between neighbours before the series was written; small structures may be "
         "absent there.";
}

std::vector<std::string> SeriesRepair::notes(const core::IndexBox& box) const
{
  std::vector<std::string> notes = m_notes;
  if (std::string blends = blendNote(box); !blends.empty())
    notes.push_back(std::move(blends));
  std::vector<volume::SliceRange> before;
  for (int m = box.lower[2]; m < box.upper[2]; ++m)
    if (const Blend blend = blendAt(m); blend.a == blend.b && blend.a->isGuess)
      appendSlice(before, m - box.lower[2]);
  if (std::string note = interpolatedBeforeNote(before, box.size()[2]); !note.empty())
    notes.push_back(std::move(note));
  if (std::string lost = lossNote(box); !lost.empty())
    notes.push_back(std::move(lost));
  return notes;
}

volume::ImageProvenance SeriesRepair::provenance(const core::IndexBox& box) const
{
  volume::ImageProvenance provenance;
  provenance.tilt = m_tilt;
  provenance.shift = m_shift;
  for (int m = 0; m < m_grid.dims()[2]; ++m)
  {
    const Blend blend = blendAt(m);
    if (m < box.lower[2] || m >= box.upper[2])
      provenance.interpolatedBeyond += blend.a != blend.b;
    else if (blend.a != blend.b || blend.a->isGuess)
      appendSlice(provenance.interpolated, m - box.lower[2]);
  }
  return provenance;
}

SeriesRepair::Blend SeriesRepair::blendAt(int m) const
{
  const double place = m * m_grid.spacing()[2];
  const auto above = std::lower_bound(m_slices.begin(), m_slices.end(), place,
                                      [](const Slice& s, double t) { return s.place < t; });
  if (above == m_slices.begin())
    return {&m_slices.front(), &m_slices.front(), 0.0};
  if (above == m_slices.end())
    return {&m_slices.back(), &m_slices.back(), 0.0};
  const Slice& a = *(above - 1);
  const Slice& b = *above;
  // A slice within the tolerance of an even spacing stays as it is.
  const double near = m_isUneven ? kOnPlace : 0.3 * m_grid.spacing()[2];
  if (b.place - place <= near && b.place - place <= place - a.place)
    return {&b, &b, 0.0};
  if (place - a.place <= near)
    return {&a, &a, 0.0};
  return {&a, &b, (place - a.place) / (b.place - a.place)};
}

std::string SeriesRepair::blendNote(const core::IndexBox& box) const
{
  std::vector<volume::SliceRange> ranges;
  double farthest = 0.0;
  for (int m = box.lower[2]; m < box.upper[2]; ++m)
  {
    const Blend blend = blendAt(m);
    const double place = m * m_grid.spacing()[2];
    if (blend.a == blend.b)
      continue;
    appendSlice(ranges, m - box.lower[2]);
    farthest = std::max(farthest, std::min(place - blend.a->place, blend.b->place - place));
  }
  const int guessed = volume::sliceCount(ranges);
  if (guessed == 0)
    return {};
  const bool isMany = ranges.size() > kNamed;
  return std::string("Repaired: ") + (guessed == 1 ? "slice " : "slices ") + namedRanges(ranges) +
         " of " + std::to_string(box.upper[2] - box.lower[2]) +
         (m_isMissing
              ? (guessed == 1 ? " is missing from the files and was" : " are missing and were")
          : isMany       ? " were in part"
          : guessed == 1 ? " was"
                         : " were") +
         " interpolated between neighbours, up to " + decimals(farthest, 2) +
         " mm from what was measured; small structures may be absent there.";
}

std::string SeriesRepair::lossNote(const core::IndexBox& box) const
{
  constexpr double kHalf = 0.499; // of the weight in a slice of the volume
  std::vector<double> weights(m_slices.size(), 0.0);
  const auto count = [&](const Slice* slice, double weight)
  {
    double& most = weights[static_cast<std::size_t>(slice - m_slices.data())];
    most = std::max(most, weight);
  };
  for (int m = 0; m < m_grid.dims()[2]; ++m)
  {
    const Blend blend = blendAt(m);
    count(blend.a, 1.0 - blend.weight);
    count(blend.b, blend.a == blend.b ? 1.0 : blend.weight);
  }
  const double first = (box.lower[2] - 0.5) * m_grid.spacing()[2];
  const double last = (box.upper[2] - 0.5) * m_grid.spacing()[2];
  std::size_t all = 0;
  std::size_t lost = 0;
  for (std::size_t k = 0; k < m_slices.size(); ++k)
    if (m_slices[k].place >= first && m_slices[k].place < last)
    {
      ++all;
      lost += weights[k] < kHalf ? 1 : 0;
    }
  if (lost == 0)
    return {};
  return "Repaired: " + std::to_string(lost) + " of " + std::to_string(all) + " measured slices " +
         (lost == 1 ? "lies" : "lie") + " between those of the volume, " +
         decimals(m_grid.spacing()[2], 2) + " mm apart, and " + (lost == 1 ? "makes" : "make") +
         " up less than half of any; small structures may be absent there.";
}

volume::IntensityVolume SeriesRepair::resample(const volume::IntensityVolume& stacked,
                                               const core::IndexBox& box,
                                               const core::Progress& progress) const
{
  return stacked.visit(
      [&](const auto& from)
      {
        using T = std::decay_t<decltype(from.at(0, 0, 0))>;
        const double outside = stacked.padding().value_or(stacked.range().min);
        auto to = std::make_shared<volume::Volume<T>>(m_grid.cropped(box));
        const auto& n = to->geometry().dims();
        tbb::parallel_for(tbb::blocked_range<int>(0, n[2], 1),
                          [&](const tbb::blocked_range<int>& range)
                          {
                            for (int k = range.begin(); k != range.end(); ++k)
                            {
                              progress.check("straightening the slices");
                              const Blend blend = blendAt(box.lower[2] + k);
                              const ShiftedSlice<T> a(from, blend.a->index, blend.a->u, blend.a->v,
                                                      stacked.padding());
                              const ShiftedSlice<T> b(from, blend.b->index, blend.b->u, blend.b->v,
                                                      stacked.padding());
                              for (int j = 0; j < n[1]; ++j)
                                for (int i = 0; i < n[0]; ++i)
                                {
                                  const int column = box.lower[0] + i;
                                  const int row = box.lower[1] + j;
                                  double value = a.at(column, row);
                                  if (blend.weight > 0.0)
                                    value += blend.weight * (b.at(column, row) - value);
                                  if (std::isnan(value))
                                    value = outside;
                                  if constexpr (std::is_integral_v<T>)
                                    value = std::nearbyint(value);
                                  to->at(i, j, k) = static_cast<T>(value);
                                }
                            }
                          });
        return volume::IntensityVolume(std::shared_ptr<const volume::Volume<T>>(to),
                                       stacked.padding());
      });
}

} // namespace petrous::imaging
