#pragma once

#include <optional>

#include <QSettings>

#include "petrous/Presenters/ViewSettings.h"

namespace petrous::workstation
{

/// What the window keeps from run to run: how hand and picture are set, nothing of any patient. A
/// value that is missing, or that a hand wrote and nobody understands, is the usual one.
class WindowSettings
{
public:
  /// `file`: an INI file; empty: the user's own (~/.config/petrous/workstation.conf).
  explicit WindowSettings(const QString& file = {});

  /// Lamp and stereo. `quadBuffer`: the driver offers it; otherwise that mode is none.
  void restore(presenters::ViewSettings& view, bool quadBuffer) const;
  void keep(const presenters::ViewSettings& view);

  std::optional<double> thrust() const; ///< N
  void keepThrust(double newtons);

  /// Of one hand (presenters::Hand::id).
  std::optional<double> scale(const std::string& hand) const;      ///< mm/mm
  std::optional<double> forceLimit(const std::string& hand) const; ///< N
  void keepScale(const std::string& hand, double scale);
  void keepForceLimit(const std::string& hand, double newtons);

private:
  std::optional<double> number(const QString& key) const;
  mutable QSettings m_file;
};

} // namespace petrous::workstation
