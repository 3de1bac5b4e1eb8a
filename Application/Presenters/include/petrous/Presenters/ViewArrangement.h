#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/SliceGeometry.h"

namespace petrous::presenters
{

/// The window's four views; slices as SliceOrientation.
enum class ViewPane
{
  ThreeD,
  Axial,
  Coronal,
  Sagittal
};

constexpr ViewPane paneOf(SliceOrientation slice)
{
  return static_cast<ViewPane>(static_cast<int>(slice) + 1);
}

enum class ViewLayout
{
  Beside,   ///< the 3D view, with the slices in a column beside it
  FourUp,   ///< two rows of two
  ThreeD,   ///< the 3D view alone
  OneSlice, ///< a slice, with the other views in a column beside it
  Slices    ///< the three slices side by side, without the 3D view
};
const char* nameOf(ViewLayout layout); ///< "beside", "four-up", "3d", "one-slice", "slices"
std::optional<ViewLayout> parseViewLayout(const std::string& name);

/// Of an area in pixels; rows from the top.
struct ViewRect
{
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// Where the four views stand in an area, how its parts are divided, and which one is enlarged; a
/// value type.
class ViewArrangement
{
public:
  static constexpr int kGap = 3; ///< pixels between views

  ViewLayout layout() const noexcept { return m_layout; }
  void setLayout(ViewLayout layout); ///< nothing is enlarged any more

  /// The slice that OneSlice shows large; initially axial.
  ViewPane large() const noexcept { return m_large; }
  void setLarge(ViewPane slice); ///< the 3D view: no effect

  /// A view that fills the area until it is toggled again.
  std::optional<ViewPane> enlarged() const noexcept { return m_enlarged; }
  void toggleEnlarged(ViewPane pane);

  /// By pane; nullopt: not shown.
  using Panes = std::array<std::optional<ViewRect>, 4>;
  Panes panes(int width, int height) const;

  /// A gap that can be dragged.
  struct Divider
  {
    ViewRect gap;
    std::size_t split = 0;  ///< of splits()
    bool isVertical = true; ///< a line from top to bottom
  };
  std::vector<Divider> dividers(int width, int height) const;

  /// Fractions of the area's width or height at which the present layout is divided.
  const std::vector<double>& splits() const { return m_splits[static_cast<std::size_t>(m_layout)]; }
  /// Clamped so that every view keeps a tenth of the area. Out of range: no effect.
  void moveSplit(std::size_t split, double fraction);
  void resetSplits(); ///< of the present layout

private:
  std::vector<double>& present() { return m_splits[static_cast<std::size_t>(m_layout)]; }

  ViewLayout m_layout = ViewLayout::Beside;
  ViewPane m_large = ViewPane::Axial;
  std::optional<ViewPane> m_enlarged;
  std::array<std::vector<double>, 5> m_splits = usualSplits();
  static std::array<std::vector<double>, 5> usualSplits();
};

} // namespace petrous::presenters
