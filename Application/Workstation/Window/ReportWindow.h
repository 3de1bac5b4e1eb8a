#pragma once

#include <filesystem>

#include <QString>

class QWidget;

namespace petrous::workstation
{

/// Opens a non-modal window (object name "report") with a text to read, copy and save. `head` says
/// in a sentence what it is, and is all if there is no text; `file` is proposed for saving,
/// which is refused in the folder `input` (empty: anywhere goes), and as
/// library::refuseOverwriting says of the library in that folder.
void showReport(QWidget* parent, const QString& title, const QString& head, const QString& text,
                const QString& file, const std::filesystem::path& library,
                const QString& input = {});

} // namespace petrous::workstation
