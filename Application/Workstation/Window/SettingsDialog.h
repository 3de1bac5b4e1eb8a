#pragma once

#include <filesystem>
#include <vector>

#include <QDialog>

#include "Bind.h"

namespace petrous::workstation
{

class WindowSettings;

/// What is kept between runs and has no place in a panel: theme, size of the letters, and how the
/// window behaves. Every change is seen at once.
class SettingsDialog : public QDialog
{
  Q_OBJECT
public:
  /// `switches`: checkable actions of the menus that are offered here too.
  SettingsDialog(WindowSettings& settings, const std::filesystem::path& library,
                 const std::vector<QAction*>& switches, QWidget* parent);

private:
  void apply();

  WindowSettings& m_settings;
  Bindings m_bound;
};

} // namespace petrous::workstation
