#include "petrous/Presenters/ViewArrangement.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace petrous::presenters
{

namespace
{

constexpr const char* kNames[] = {"beside", "four-up", "3d", "one-slice", "slices"};
constexpr double kLeast = 0.1; // of the area, for a view

// A part of the area between two fractions of it, without half a gap at each inner edge.
struct Span
{
  int first, length;
};

Span spanOf(int size, double from, double to)
{
  const auto at = [size](double fraction)
  { return static_cast<int>(std::lround(fraction * size)); };
  const int first = from <= 0.0 ? 0 : at(from) + (ViewArrangement::kGap + 1) / 2;
  const int end = to >= 1.0 ? size : at(to) - ViewArrangement::kGap / 2;
  return {first, std::max(end - first, 1)};
}

ViewRect rectOf(const Span& across, const Span& down)
{
  return {across.first, down.first, across.length, down.length};
}

// The gap at a fraction.
Span gapOf(int size, double fraction)
{
  return {static_cast<int>(std::lround(fraction * size)) - ViewArrangement::kGap / 2,
          ViewArrangement::kGap};
}

constexpr std::array<ViewPane, 3> kSlices{ViewPane::Axial, ViewPane::Coronal, ViewPane::Sagittal};

} // namespace

const char* nameOf(ViewLayout layout)
{
  return kNames[static_cast<std::size_t>(layout)];
}

std::optional<ViewLayout> parseViewLayout(const std::string& name)
{
  const auto* const found = std::find(std::begin(kNames), std::end(kNames), name);
  return found == std::end(kNames)
             ? std::nullopt
             : std::optional(static_cast<ViewLayout>(found - std::begin(kNames)));
}

// Beside and OneSlice: the column, then its rows. FourUp: the column, then the row. Slices:
// columns.
std::array<std::vector<double>, 5> ViewArrangement::usualSplits()
{
  constexpr double kThird = 1.0 / 3.0;
  return {{{0.65, kThird, 2.0 * kThird},
           {0.5, 0.5},
           {},
           {0.7, kThird, 2.0 * kThird},
           {kThird, 2.0 * kThird}}};
}

void ViewArrangement::setLayout(ViewLayout layout)
{
  m_layout = layout;
  m_enlarged.reset();
}

void ViewArrangement::setLarge(ViewPane slice)
{
  if (slice != ViewPane::ThreeD)
    m_large = slice;
}

void ViewArrangement::toggleEnlarged(ViewPane pane)
{
  if (m_enlarged)
    m_enlarged.reset();
  else
    m_enlarged = pane;
}

ViewArrangement::Panes ViewArrangement::panes(int width, int height) const
{
  Panes all;
  const auto put = [&all](ViewPane pane, const ViewRect& rect)
  { all[static_cast<std::size_t>(pane)] = rect; };
  if (m_enlarged)
  {
    put(*m_enlarged, {0, 0, width, height});
    return all;
  }
  const std::vector<double>& at = splits();
  const auto putColumn = [&](const std::array<ViewPane, 3>& panes)
  {
    const Span column = spanOf(width, at[0], 1.0);
    const double rows[] = {0.0, at[1], at[2], 1.0};
    for (std::size_t n = 0; n < panes.size(); ++n)
      put(panes[n], rectOf(column, spanOf(height, rows[n], rows[n + 1])));
  };
  const Span whole{0, height};
  switch (m_layout)
  {
  case ViewLayout::Beside:
    put(ViewPane::ThreeD, rectOf(spanOf(width, 0.0, at[0]), whole));
    putColumn(kSlices);
    break;
  case ViewLayout::FourUp:
  {
    const Span left = spanOf(width, 0.0, at[0]);
    const Span right = spanOf(width, at[0], 1.0);
    const Span upper = spanOf(height, 0.0, at[1]);
    const Span lower = spanOf(height, at[1], 1.0);
    put(ViewPane::Axial, rectOf(left, upper));
    put(ViewPane::ThreeD, rectOf(right, upper));
    put(ViewPane::Coronal, rectOf(left, lower));
    put(ViewPane::Sagittal, rectOf(right, lower));
    break;
  }
  case ViewLayout::ThreeD:
    put(ViewPane::ThreeD, {0, 0, width, height});
    break;
  case ViewLayout::OneSlice:
  {
    put(m_large, rectOf(spanOf(width, 0.0, at[0]), whole));
    std::array<ViewPane, 3> others{ViewPane::ThreeD};
    std::copy_if(kSlices.begin(), kSlices.end(), others.begin() + 1,
                 [this](ViewPane pane) { return pane != m_large; });
    putColumn(others);
    break;
  }
  case ViewLayout::Slices:
    put(ViewPane::Axial, rectOf(spanOf(width, 0.0, at[0]), whole));
    put(ViewPane::Coronal, rectOf(spanOf(width, at[0], at[1]), whole));
    put(ViewPane::Sagittal, rectOf(spanOf(width, at[1], 1.0), whole));
    break;
  }
  return all;
}

std::vector<ViewArrangement::Divider> ViewArrangement::dividers(int width, int height) const
{
  if (m_enlarged)
    return {};
  const std::vector<double>& at = splits();
  std::vector<Divider> all;
  const auto addColumn = [&](std::size_t split) {
    all.push_back({rectOf(gapOf(width, at[split]), {0, height}), split, true});
  };
  const auto addRow = [&](std::size_t split, const Span& across) {
    all.push_back({rectOf(across, gapOf(height, at[split])), split, false});
  };
  switch (m_layout)
  {
  case ViewLayout::Beside:
  case ViewLayout::OneSlice:
    addColumn(0);
    addRow(1, spanOf(width, at[0], 1.0));
    addRow(2, spanOf(width, at[0], 1.0));
    break;
  case ViewLayout::FourUp:
    addColumn(0);
    addRow(1, {0, width});
    break;
  case ViewLayout::ThreeD:
    break;
  case ViewLayout::Slices:
    addColumn(0);
    addColumn(1);
    break;
  }
  return all;
}

void ViewArrangement::moveSplit(std::size_t split, double fraction)
{
  std::vector<double>& at = present();
  if (split >= at.size() || !std::isfinite(fraction))
    return;
  // Those that divide the same direction follow each other.
  const bool isColumnAndRows = m_layout != ViewLayout::Slices;
  const std::size_t first = isColumnAndRows ? 1 : 0;
  const bool hasBefore = split > first;
  const bool hasAfter = split >= first && split + 1 < at.size();
  const double lower = hasBefore ? at[split - 1] + kLeast : kLeast;
  const double upper = hasAfter ? at[split + 1] - kLeast : 1.0 - kLeast;
  at[split] = std::clamp(fraction, std::min(lower, upper), std::max(lower, upper));
}

void ViewArrangement::resetSplits()
{
  present() = usualSplits()[static_cast<std::size_t>(m_layout)];
}

} // namespace petrous::presenters
