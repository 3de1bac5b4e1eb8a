#pragma once

#include <QString>

#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

/// What was drilled so far. `drilling`: a stroke is open, whose volume is known when it is closed.
QString removedText(const scene::Case& value, bool drilling);

/// What a stroke took; "Nothing was cut" for none.
QString strokeText(const dissection::Stroke* stroke);

/// With a full stop, where it has none.
QString sentence(const QString& text);

/// What this program is, as rich text.
QString aboutText();

} // namespace petrous::workstation
