#pragma once

#include <functional>

#include <QColor>
#include <QIcon>
#include <QPixmap>
#include <QString>

#include "petrous/Presenters/SliceGeometry.h"

class QApplication;
class QPainter;

namespace petrous::workstation
{

/// Of panels, menus and dialogs. 3D view and slices stay dark, so that bone is the brightest there.
enum class ColorScheme
{
  Dark,
  Light
};

struct Theme
{
  static constexpr double kMinScale = 0.8, kMaxScale = 2.0;

  ColorScheme scheme = ColorScheme::Dark;
  double fontScale = 1.0; ///< of the system's font
};

inline bool operator==(const Theme& a, const Theme& b)
{
  return a.scheme == b.scheme && a.fontScale == b.fontScale;
}

/// Colours and letters of all windows, also of those that are open; numbers with a decimal point
/// (DecimalPoint.h), characters that stay in their field (TextKeys.h). Call before the first
/// widget.
void applyTheme(QApplication& application, const Theme& theme = {});
double fontScale(); ///< of the theme that was applied last

/// Of text in the present theme that tells of something doubtful, or of harm.
QColor warningColor();
/// The same as a style sheet of a widget, which follows the theme.
constexpr const char* kWarningStyle = "color: palette(link-visited);";
QColor harmColor();

/// A square of `size` px on a transparent ground, in the screen's scale. Views ask for icons
/// whenever they draw a row: it is drawn once for each key, which names all that it depends on.
QPixmap pixmapOf(const QString& key, int size, const std::function<void(QPainter&)>& draw);

/// The colour of what stands beside it, in a selected row, too.
QIcon swatch(const QColor& color, int size);

/// The colour of a slice plane in every view.
QColor planeColor(presenters::SliceOrientation orientation);
QColor boxColor(); ///< of a box that is dragged
QColor cutColor(); ///< of a clipping plane

/// Conversion between UTF-8 and QString.
QString words(const std::string& text);
std::string bytes(const QString& text);

} // namespace petrous::workstation
