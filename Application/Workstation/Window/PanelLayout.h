#pragma once

#include <initializer_list>
#include <vector>

class QAction;
class QGridLayout;
class QHBoxLayout;
class QSize;
class QLabel;
class QTreeView;
class QWidget;

namespace petrous::workstation
{

/// Lays out a panel of a dock: `inside` scrolls up and down if the dock is too low for it, `foot`
/// below it is always visible. The dock is never narrower than `inside` needs.
void layOutPanel(QWidget& panel, QWidget* inside, QWidget* foot);

/// With which a tree whose last column stretches shows that column's title as well; by itself it
/// becomes narrower.
int wholeWidthOf(const QTreeView& tree);

/// What a dock holds: the panel, which scrolls as a whole on a screen that is low for the letters.
QWidget* scrolledPanel(QWidget* panel);

/// This size, or less on a small screen.
QSize leastOfScreen(const QWidget& widget, const QSize& wanted);

/// Gives a window or dialog this size, or what fits on the screen: with large type or at 200 % a
/// screen may have no more than 960 × 540 px.
void resizeOnScreen(QWidget& window, const QSize& wanted);

/// Breaks the label's lines between words, and keeps it as high as its lines need at its width: the
/// layouts of docks and dialogs know no height for a width, and would cut the last line. It is
/// never lower than `least` lines, so that what is below it stays where it is.
void wrapWords(QLabel& label, int least = 0);

QHBoxLayout* rowOf(std::initializer_list<QWidget*> widgets); ///< close to each other

/// Buttons for the tools of a panel, a few in a row. `name`: object name of each.
QGridLayout* toolGrid(const std::vector<QAction*>& tools, const char* name);

} // namespace petrous::workstation
