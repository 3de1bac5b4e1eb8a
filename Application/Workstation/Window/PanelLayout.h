#pragma once

class QWidget;

namespace petrous::workstation
{

/// Lays out a panel of a dock: `inside` scrolls up and down if the dock is too low for it, `foot`
/// below it is always visible. The dock is never narrower than `inside` needs.
void layOutPanel(QWidget& panel, QWidget* inside, QWidget* foot);

} // namespace petrous::workstation
