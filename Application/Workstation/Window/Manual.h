#pragma once

#include <functional>

#include <QDesktopServices>
#include <QString>
#include <QUrl>

namespace petrous::workstation
{

/// First page of the manual: installed with programs in this folder, or built beside them; empty if
/// it is neither.
QString manualFile(const QString& programs);

/// Opens it, or another of its pages, in the desktop's browser. Returns what is to be said if that
/// cannot be done; empty if it was.
QString openManual(const QString& programs,
                   const std::function<bool(const QUrl&)>& open = QDesktopServices::openUrl,
                   const QString& page = "index.html");

} // namespace petrous::workstation
