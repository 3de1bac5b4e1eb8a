#include "Theme.h"

#include <QApplication>
#include <QPalette>
#include <QStyleFactory>

#include "DecimalPoint.h"

namespace petrous::workstation
{

namespace
{
// What a palette cannot express. Colours: background 16191d, panel 1c2026, line 2e343c, text
// d7dce2, accent 3d8fd1, drill e07b39.
constexpr const char* kStyleSheet = R"(
QMainWindow::separator { background: #101317; width: 5px; height: 5px; }
QSplitter::handle { background: #101317; }
QToolBar { background: #1c2026; border: 0; border-bottom: 1px solid #2e343c; padding: 4px 6px;
           spacing: 5px; }
QToolBar::separator { background: #343b44; width: 1px; margin: 4px 6px; }
QToolButton { padding: 5px 10px; border-radius: 4px; border: 1px solid transparent; }
QToolButton:hover { background: #2b3139; }
QToolButton:pressed { background: #353d47; }
QToolButton:focus { border-color: #3d8fd1; }
QToolButton:disabled { color: #5c646e; }
QToolButton#drillButton { border: 1px solid #4a525c; font-weight: 600; padding: 5px 16px; }
QToolButton#pointerButton { border: 1px solid #4a525c; padding: 5px 12px; }
QToolButton#pointerButton:checked { background: #2f79b5; border-color: #62b0ec; color: #ffffff; }
QToolButton#wheelButton { border: 1px solid #4a525c; }
QToolButton#wheelButton:checked { background: #2f79b5; border-color: #62b0ec; color: #ffffff; }
QToolButton#drillButton:checked { background: #d96b27; border-color: #f08a48; color: #ffffff; }
QToolButton#segmentTool { border: 1px solid #3a424c; background: #232930; padding: 6px 4px; }
QToolButton#segmentTool:hover { background: #2b3139; }
QToolButton#segmentTool:focus { border-color: #3d8fd1; }
QToolButton#segmentTool:checked { background: #2f79b5; border-color: #62b0ec; color: #ffffff; }
QMenuBar { background: #1c2026; }
QMenuBar::item:selected, QMenu::item:selected { background: #2f6ea3; }
QMenu { background: #20252b; border: 1px solid #343b44; }
QStatusBar { background: #1c2026; border-top: 1px solid #2e343c; }
QStatusBar::item { border: 0; }
QDockWidget { font-weight: 600; }
QDockWidget::title { background: #1c2026; padding: 7px 10px; border-bottom: 1px solid #2e343c; }
QHeaderView::section { background: #1c2026; color: #9aa4af; border: 0;
                       border-bottom: 1px solid #2e343c; padding: 4px 6px; }
QTreeView { border: 0; background: #171a1f; alternate-background-color: #1a1e23; }
QTreeView::item { padding: 3px 2px; }
QTreeView::item:selected { background: #2f6ea3; color: #ffffff; }
QTreeView::item:selected:!active { background: #2a4d6b; color: #ffffff; }
QTreeView:focus { border: 1px solid #3d8fd1; }
QTreeView::indicator, QCheckBox::indicator { width: 12px; height: 12px; background: #14171b;
                       border: 1px solid #66707c; border-radius: 3px; }
QTreeView::indicator:checked, QCheckBox::indicator:checked { background: #3d8fd1;
                       border-color: #7fbdf0; }
QTreeView::indicator:indeterminate, QCheckBox::indicator:indeterminate { background: #5c646e;
                       border-color: #9aa4af; }
QTreeView::indicator:selected { border-color: #e4e8ed; }
QTreeView::indicator:disabled, QCheckBox::indicator:disabled { border-color: #343b44; }
QCheckBox::indicator:checked:disabled { background: #2b4558; }
QCheckBox:focus { color: #b9dcf8; }
QToolTip { background: #2b3139; color: #e4e8ed; border: 1px solid #4a525c; padding: 4px; }
QPushButton { padding: 6px 18px; }
QPushButton#primary, QPushButton#segmentCreate { background: #2f79b5; border: 1px solid #4a98d6;
                      border-radius: 5px; color: #ffffff; padding: 9px 22px; font-weight: 600; }
QPushButton#primary:hover, QPushButton#segmentCreate:hover { background: #3a8acb; }
QPushButton#primary:focus, QPushButton#segmentCreate:focus { border-color: #b9dcf8; }
QPushButton#segmentCreate:disabled { background: #262c33; border-color: #343b44; color: #5c646e; }
QLabel#guessed { color: #ff8c2b; background: rgba(16, 19, 23, 150); border-radius: 4px;
                 padding: 1px 6px; }
QLabel#direction { color: #c9d2dc; font-size: 15px; font-weight: 700;
                   background: rgba(16, 19, 23, 150); border-radius: 4px; padding: 1px 6px; }
QFrame[banner="notice"] { background: #24384a; border-bottom: 1px solid #3d6b92; }
QFrame[banner="warning"] { background: #5a3217; border-bottom: 1px solid #d96b27; }
QFrame[banner] QLabel { color: #f2f5f8; }
QFrame[banner] QPushButton { padding: 4px 12px; }
QLabel#dim { color: #9aa4af; }
QLabel#recording { color: #ff6b6b; font-weight: 600; }
QLabel#big { font-size: 20px; color: #e4e8ed; }
)";
} // namespace

void applyTheme(QApplication& application)
{
  new DecimalPoint(application);
  application.setStyle(QStyleFactory::create("Fusion"));
  QPalette palette;
  palette.setColor(QPalette::Window, QColor("#1c2026"));
  palette.setColor(QPalette::WindowText, QColor("#d7dce2"));
  palette.setColor(QPalette::Base, QColor("#14171b"));
  palette.setColor(QPalette::AlternateBase, QColor("#1a1e23"));
  palette.setColor(QPalette::Text, QColor("#d7dce2"));
  palette.setColor(QPalette::Button, QColor("#2a3037"));
  palette.setColor(QPalette::ButtonText, QColor("#d7dce2"));
  palette.setColor(QPalette::BrightText, Qt::white);
  palette.setColor(QPalette::Highlight, QColor("#2f79b5"));
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::ToolTipBase, QColor("#2b3139"));
  palette.setColor(QPalette::ToolTipText, QColor("#e4e8ed"));
  palette.setColor(QPalette::Link, QColor("#62b0ec"));
  palette.setColor(QPalette::PlaceholderText, QColor("#7c8691"));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, QColor("#5c646e"));
  application.setPalette(palette);
  application.setStyleSheet(kStyleSheet);
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

QString words(const std::string& text)
{
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}

std::string bytes(const QString& text)
{
  return text.toUtf8().toStdString();
}

} // namespace petrous::workstation
