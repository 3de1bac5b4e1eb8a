#pragma once

#include <QColor>
#include <QString>

#include "petrous/Presenters/SliceGeometry.h"

class QApplication;

namespace petrous::workstation
{

/// Dark and quiet, so that the bone is the brightest thing on the screen; numbers with a decimal
/// point (DecimalPoint.h). Before the first widget.
void applyTheme(QApplication& application);

/// The colour that a slice plane has in every view.
QColor planeColor(presenters::SliceOrientation orientation);

/// UTF-8 to Qt and back.
QString words(const std::string& text);
std::string bytes(const QString& text);

} // namespace petrous::workstation
