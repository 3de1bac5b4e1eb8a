#pragma once

#include <functional>
#include <string>

#include <QString>

class QWidget;

namespace petrous::workstation
{

/// Asks for a name. `check` throws a core::Error if a name is not valid or taken: what it says is
/// shown below the field, and the name cannot be accepted before it was changed. Returns the name
/// without spaces around it; empty: the user did not want to.
QString askName(QWidget& parent, const QString& title, const QString& text, const QString& name,
                const std::function<void(const std::string&)>& check);

} // namespace petrous::workstation
