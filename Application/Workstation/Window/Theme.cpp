#include "Theme.h"

#include <cmath>
#include <cstring>
#include <optional>

#include <QApplication>
#include <QFont>
#include <QPainter>
#include <QPalette>
#include <QPixmapCache>
#include <QRegularExpression>
#include <QStyleFactory>
#include <QVariant>

#include "DecimalPoint.h"
#include "TextKeys.h"

namespace petrous::workstation
{

namespace
{
struct ThemeColor
{
  const char* name;
  const char* dark;
  const char* light;
};

// Of the style sheet.
constexpr ThemeColor kColors[] = {
    {"gap", "#101317", "#c3c8ce"},          {"panel", "#1c2026", "#f2f4f6"},
    {"line", "#2e343c", "#cfd5db"},         {"rule", "#343b44", "#c2c9d1"},
    {"hover", "#2b3139", "#e1e6eb"},        {"pressed", "#353d47", "#d3dae1"},
    {"accent", "#3d8fd1", "#1f6fb2"},       {"off", "#5c646e", "#9aa3ad"},
    {"frame", "#4a525c", "#aab3bd"},        {"checked", "#2f79b5", "#2f79b5"},
    {"checkedEdge", "#62b0ec", "#1d5c92"},  {"drill", "#d96b27", "#c85a16"},
    {"edgeOfDrill", "#f08a48", "#a84a10"},  {"tool", "#232930", "#e9edf1"},
    {"toolEdge", "#3a424c", "#bcc4cc"},     {"select", "#2f6ea3", "#2f79b5"},
    {"bySelect", "#d7dce2", "#ffffff"},     {"menu", "#20252b", "#ffffff"},
    {"dim", "#9aa4af", "#59636e"},          {"tree", "#171a1f", "#ffffff"},
    {"otherRow", "#1a1e23", "#f5f7f9"},     {"idle", "#2a4d6b", "#b5cfe6"},
    {"byIdle", "#ffffff", "#10202e"},       {"box", "#14171b", "#ffffff"},
    {"edgeOfBox", "#66707c", "#7c8792"},    {"edgeOfOn", "#7fbdf0", "#164f80"},
    {"onOff", "#2b4558", "#b7cbdc"},        {"focus", "#b9dcf8", "#124a78"},
    {"strong", "#e4e8ed", "#1b2026"},       {"primaryEdge", "#4a98d6", "#1d5c92"},
    {"primaryHover", "#3a8acb", "#3a8acb"}, {"primaryOff", "#262c33", "#e4e8ec"},
    {"notice", "#24384a", "#dcecf9"},       {"edgeOfNotice", "#3d6b92", "#8fb8da"},
    {"warning", "#5a3217", "#fde3cf"},      {"bannerText", "#f2f5f8", "#1b2026"},
    {"recording", "#ff6b6b", "#c4161c"},
};

struct RoleColor
{
  QPalette::ColorRole role;
  const char* dark;
  const char* light;
};

constexpr RoleColor kRoles[] = {
    {QPalette::Window, "#1c2026", "#f2f4f6"},
    {QPalette::WindowText, "#d7dce2", "#1b2026"},
    {QPalette::Base, "#14171b", "#ffffff"},
    {QPalette::AlternateBase, "#1a1e23", "#f5f7f9"},
    {QPalette::Text, "#d7dce2", "#1b2026"},
    {QPalette::Button, "#2a3037", "#e4e8ec"},
    {QPalette::ButtonText, "#d7dce2", "#1b2026"},
    {QPalette::BrightText, "#ffffff", "#ffffff"},
    {QPalette::Highlight, "#2f79b5", "#2f79b5"},
    {QPalette::HighlightedText, "#ffffff", "#ffffff"},
    {QPalette::ToolTipBase, "#2b3139", "#fffdf2"},
    {QPalette::ToolTipText, "#e4e8ed", "#1b2026"},
    {QPalette::Link, "#62b0ec", "#1d5c92"},
    {QPalette::LinkVisited, "#ffb454", "#9a5200"}, // warningColor
    {QPalette::PlaceholderText, "#7c8691", "#6b757f"},
};

// What a palette cannot express. What lies over pictures has the same colours in both schemes.
constexpr const char* kStyleSheet = R"(
QMainWindow::separator { background: @gap; width: 5px; height: 5px; }
QSplitter::handle { background: @gap; }
QToolBar { background: @panel; border: 0; border-bottom: 1px solid @line; padding: 4px 6px;
           spacing: 5px; }
QToolBar::separator { background: @rule; width: 1px; margin: 4px 6px; }
QToolButton { padding: 5px 10px; border-radius: 4px; border: 1px solid transparent; }
QToolButton:hover { background: @hover; }
QToolButton:pressed { background: @pressed; }
QToolButton:focus { border-color: @focus; }
QToolButton:disabled { color: @off; }
QFileDialog QToolButton { padding: 3px; }
QTabBar QToolButton { padding: 0; background: @panel; }
QToolButton#drillButton { border: 1px solid @frame; font-weight: 600; padding: 5px 16px; }
QToolButton#pointerButton { border: 1px solid @frame; padding: 5px 12px; }
QToolButton#pointerButton:checked { background: @checked; border-color: @checkedEdge; color: #ffffff; }
QToolButton#wheelButton { border: 1px solid @frame; }
QToolButton#wheelButton:checked { background: @checked; border-color: @checkedEdge; color: #ffffff; }
QToolButton#drillButton:checked { background: @drill; border-color: @edgeOfDrill; color: #ffffff; }
QToolButton#drillButton:focus, QToolButton#pointerButton:focus, QToolButton#wheelButton:focus {
  border-color: @focus; }
QToolButton#segmentTool, QToolButton#measureTool {
  border: 1px solid @toolEdge; background: @tool; padding: 6px 4px; }
QToolButton#segmentTool:hover, QToolButton#measureTool:hover { background: @hover; }
QToolButton#segmentTool:focus, QToolButton#measureTool:focus { border-color: @focus; }
QToolButton#segmentTool:checked, QToolButton#measureTool:checked {
  background: @checked; border-color: @checkedEdge; color: #ffffff; }
QAbstractSpinBox[refused="true"] { color: @drill; }
QMenuBar { background: @panel; }
QMenuBar::item:selected, QMenu::item:selected { background: @select; color: @bySelect; }
QMenu { background: @menu; border: 1px solid @rule; }
QStatusBar { background: @panel; border-top: 1px solid @line; }
QStatusBar::item { border: 0; }
QDockWidget { font-weight: 600; }
QDockWidget::title { background: @panel; padding: 7px 10px; border-bottom: 1px solid @line; }
QHeaderView::section { background: @panel; color: @dim; border: 0;
                       border-bottom: 1px solid @line; padding: 4px 6px; }
QTreeView { border: 1px solid @tree; background: @tree; alternate-background-color: @otherRow; }
QTreeView::item { padding: 3px 2px; }
QTreeView::item:selected { background: @select; color: #ffffff; }
QTreeView::item:selected:!active { background: @idle; color: @byIdle; }
QTreeView:focus { border-color: @accent; }
QTreeView::indicator, QCheckBox::indicator { width: 12px; height: 12px; background: @box;
                       border: 1px solid @edgeOfBox; border-radius: 3px; }
QTreeView::indicator:checked, QCheckBox::indicator:checked { background: @accent;
                       border-color: @edgeOfOn; image: url(:/icons/tick.png); }
QTreeView::indicator:indeterminate, QCheckBox::indicator:indeterminate { background: @off;
                       border-color: @dim; }
QTreeView::indicator:selected { border-color: @strong; }
QTreeView::indicator:disabled, QCheckBox::indicator:disabled { border-color: @rule; }
QCheckBox::indicator:checked:disabled { background: @onOff; }
QCheckBox:focus { color: @focus; }
QToolTip { background: @hover; color: @strong; border: 1px solid @frame; padding: 4px; }
QPushButton { padding: 6px 18px; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QPushButton#primary, QPushButton#segmentCreate { background: @checked; border: 1px solid @primaryEdge;
                      border-radius: 5px; color: #ffffff; padding: 9px 22px; font-weight: 600; }
QPushButton#primary:hover, QPushButton#segmentCreate:hover { background: @primaryHover; }
QPushButton#primary:focus, QPushButton#segmentCreate:focus { border-color: @focus; }
QPushButton#primary:disabled, QPushButton#segmentCreate:disabled { background: @primaryOff; border-color: @rule; color: @off; }
QLabel#guessed { color: #ff8c2b; background: rgba(16, 19, 23, 210); border-radius: 4px;
                 padding: 1px 6px; }
QLabel#direction { color: #c9d2dc; font-size: %1px; font-weight: 700;
                   background: rgba(16, 19, 23, 210); border-radius: 4px; padding: 1px 6px; }
QWidget#focusFrame { background: #62b0ec; }
QLabel#caseStamp { color: #c9d2dc; background: rgba(16, 19, 23, 210); border-radius: 4px;
                   padding: 1px 6px; }
QLabel#direction[onLight="true"], QLabel#caseStamp[onLight="true"] {
  color: #10161e; background: rgba(255, 255, 255, 220); }
QLabel#guessed[onLight="true"] { color: #9a3f00; background: rgba(255, 255, 255, 220); }
QFrame[banner="notice"] { background: @notice; border-bottom: 1px solid @edgeOfNotice; }
QFrame[banner="warning"] { background: @warning; border-bottom: 1px solid @drill; }
QFrame[banner] QLabel { color: @bannerText; }
QFrame[banner] QPushButton { padding: 4px 12px; }
QLabel#dim { color: @dim; }
QLabel#problem { color: @drill; }
QLabel#recording { color: @recording; font-weight: 600; }
QLabel#big { font-size: %2px; color: @strong; }
)";

constexpr char kScheme[] = "colorScheme";
constexpr char kScale[] = "fontScale";
constexpr char kSystemFont[] = "systemFont";

// The theme that was applied last; none before the first one.
std::optional<Theme> appliedTheme(const QApplication& application)
{
  const QVariant scheme = application.property(kScheme);
  if (!scheme.isValid())
    return std::nullopt;
  return Theme{static_cast<ColorScheme>(scheme.toInt()), application.property(kScale).toDouble()};
}

const char* colorOf(const char* name, bool isDark)
{
  for (const ThemeColor& one : kColors)
    if (std::strcmp(one.name, name) == 0)
      return isDark ? one.dark : one.light;
  return "#ff00ff";
}

QString styleSheet(const Theme& theme)
{
  QString sheet = kStyleSheet;
  static const QRegularExpression name("@(\\w+)");
  for (QRegularExpressionMatch found = name.match(sheet); found.hasMatch();
       found = name.match(sheet))
    sheet.replace(
        found.capturedStart(), found.capturedLength(),
        colorOf(found.captured(1).toLatin1().constData(), theme.scheme == ColorScheme::Dark));
  return sheet.arg(std::lround(15.0 * theme.fontScale)).arg(std::lround(20.0 * theme.fontScale));
}
} // namespace

void applyTheme(QApplication& application, const Theme& theme)
{
  const auto before = appliedTheme(application);
  if (before && *before == theme)
    return;
  if (!before)
  {
    application.setProperty(kSystemFont, QApplication::font());
    new DecimalPoint(application);
    new TextKeys(application);
    QApplication::setStyle(QStyleFactory::create("Fusion"));
  }
  application.setProperty(kScheme, static_cast<int>(theme.scheme));
  application.setProperty(kScale, theme.fontScale);
  const bool isDark = theme.scheme == ColorScheme::Dark;
  QPalette palette;
  for (const RoleColor& one : kRoles)
    palette.setColor(one.role, QColor(isDark ? one.dark : one.light));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, QColor(colorOf("off", isDark)));
  QApplication::setPalette(palette);
  const auto system = application.property(kSystemFont).value<QFont>();
  QFont font = system;
  if (system.pointSizeF() > 0.0)
    font.setPointSizeF(theme.fontScale * system.pointSizeF());
  else
    font.setPixelSize(static_cast<int>(std::lround(theme.fontScale * system.pixelSize())));
  QApplication::setFont(font);
  application.setStyleSheet(styleSheet(theme));
}

double fontScale()
{
  const QApplication* application = qApp;
  return appliedTheme(*application).value_or(Theme()).fontScale;
}

QColor warningColor()
{
  return QApplication::palette().color(QPalette::LinkVisited);
}

QPixmap pixmapOf(const QString& key, int size, const std::function<void(QPainter&)>& draw)
{
  const qreal scale = qApp->devicePixelRatio();
  const QString kept =
      QString("petrous-%1-%2-%3").arg(key).arg(size).arg(std::lround(100.0 * scale));
  QPixmap pixmap;
  if (QPixmapCache::find(kept, &pixmap))
    return pixmap;
  pixmap = QPixmap(QSize(size, size) * scale);
  pixmap.setDevicePixelRatio(scale);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  draw(painter);
  painter.end();
  QPixmapCache::insert(kept, pixmap);
  return pixmap;
}

QIcon swatch(const QColor& color, int size)
{
  const QPixmap pixmap =
      pixmapOf("swatch-" + color.name(), size,
               [&color, size](QPainter& painter)
               {
                 painter.setPen(QColor(0, 0, 0, 160));
                 painter.setBrush(color);
                 painter.drawRoundedRect(QRectF(0.5, 0.5, size - 1.0, size - 1.0), 3.0, 3.0);
               });
  QIcon icon(pixmap);
  icon.addPixmap(pixmap, QIcon::Selected); // not tinted
  return icon;
}

QColor harmColor()
{
  // Of the same lightness as the other text of the scheme.
  const bool isDark = QApplication::palette().color(QPalette::Base).lightness() < 128;
  return {isDark ? "#ff8f8f" : "#b3131a"};
}

QColor planeColor(presenters::SliceOrientation orientation)
{
  switch (orientation)
  {
  case presenters::SliceOrientation::Axial:
    return {"#f0604d"};
  case presenters::SliceOrientation::Coronal:
    return {"#6fc46a"};
  case presenters::SliceOrientation::Sagittal:
    break;
  }
  return {"#f0cf4f"};
}

QColor boxColor()
{
  return {"#5ec8ff"};
}

QColor cutColor()
{
  return {"#c08cff"};
}

QString words(const std::string& text)
{
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}

std::string bytes(const QString& text)
{
  return text.toUtf8().toStdString();
}

} // namespace petrous::workstation
