#pragma once

#include <QString>

class QPushButton;

namespace petrous::workstation
{

/// A button of a panel. `name`: of the object, for tests and style.
QPushButton* button(const QString& text, const char* name, const QString& tip);

} // namespace petrous::workstation
