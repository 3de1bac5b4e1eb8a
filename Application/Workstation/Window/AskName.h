#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <QString>

class QFileDialog;
class QWidget;

namespace petrous::workstation
{

/// Asks for a name. `check` throws a core::Error if a name is not valid or taken: what it says is
/// shown below the field, and the name cannot be accepted before it was changed. Returns the name
/// without spaces around it; empty: the user did not want to.
QString askName(QWidget& parent, const QString& title, const QString& text, const QString& name,
                const std::function<void(const std::string&)>& check);

/// Asks whether the files may be replaced that are there already; true if none is.
bool mayReplace(QWidget& parent, const std::vector<std::filesystem::path>& files);

/// The file or folder that the user names in a dialog; empty: none. A dialog can be accepted with
/// no file in it.
QString chosenFile(QFileDialog& dialog);

/// The file to be written that the user names in a dialog, with the dialog's default suffix. Asks
/// as mayReplace: the dialogs of some desktops ask for the name before the suffix is added. Empty:
/// none.
std::filesystem::path askFile(QFileDialog& dialog);

} // namespace petrous::workstation
