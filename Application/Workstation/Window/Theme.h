#pragma once

#include <QColor>
#include <QString>

#include "petrous/Presenters/SliceGeometry.h"

class QApplication;

namespace petrous::workstation
{

/// A dark theme, so that bone is the brightest thing on the screen; numbers with a decimal point
/// (DecimalPoint.h). Call before the first widget.
void applyTheme(QApplication& application);

/// The colour of a slice plane in every view.
QColor planeColor(presenters::SliceOrientation orientation);

/// Conversion between UTF-8 and QString.
QString words(const std::string& text);
std::string bytes(const QString& text);

} // namespace petrous::workstation
