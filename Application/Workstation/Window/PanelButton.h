#pragma once

#include <QString>

class QPushButton;

namespace petrous::workstation
{

/// A panel button. `name`: object name, for tests and style.
QPushButton* button(const QString& text, const char* name, const QString& tip);

} // namespace petrous::workstation
