#pragma once

#include <filesystem>
#include <vector>

#include <QDialog>

#include "Bind.h"

class QFormLayout;
class QLabel;

namespace petrous::workstation
{

class WindowSettings;

/// What is kept between runs and has no place in a panel: theme, size of the letters, and how the
/// window behaves, which change at once; and the library's folder from the next start on.
class SettingsDialog : public QDialog
{
  Q_OBJECT
public:
  /// `library`: the folder in use. `switches`: checkable actions of the menus that are offered here
  /// too.
  SettingsDialog(WindowSettings& settings, const std::filesystem::path& library,
                 const std::vector<QAction*>& switches, QWidget* parent);

private:
  void addLibrary(QFormLayout& form);
  void showLibrary();
  void changeLibrary();
  void apply();

  WindowSettings& m_settings;
  std::filesystem::path m_library;
  QLabel* m_place;
  Bindings m_bound;
};

} // namespace petrous::workstation
