#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <QSettings>
#include <QSize>

#include "Theme.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/ViewArrangement.h"
#include "petrous/Presenters/ViewSettings.h"

namespace petrous::workstation
{

/// Settings kept between runs: devices, rendering and panels, no patient data. A missing or invalid
/// value is replaced by the default.
class WindowSettings
{
public:
  /// A file that cannot be: nothing was set before, and what is set ends with the window.
  static constexpr const char* kNone = "/dev/null/none.ini";

  /// `file`: an INI file; empty: the user's default (~/.config/petrous/workstation.ini).
  explicit WindowSettings(const QString& file = {});

  /// Lamp and stereo. `quadBuffer`: supported by the driver; otherwise that mode becomes none.
  void restore(presenters::ViewSettings& view, bool quadBuffer) const;
  void keep(const presenters::ViewSettings& view);

  std::optional<double> thrust() const; ///< N
  void keepThrust(double newtons);
  bool leftHand() const;
  void keepLeftHand(bool isLeft);
  bool burrAlone() const;
  void keepBurrAlone(bool alone);

  std::optional<dissection::Burr> burr() const; ///< none unless all of it is valid
  void keepBurr(const dissection::Burr& burr);

  /// Per device (presenters::InputDevice::id).
  std::optional<double> scale(const std::string& hand) const;      ///< mm/mm
  std::optional<double> forceLimit(const std::string& hand) const; ///< N
  void keepScale(const std::string& hand, double scale);
  void keepForceLimit(const std::string& hand, double newtons);

  /// Whether a panel is shown while a case is open; `usual` before the user has chosen.
  bool panelShown(const QString& panel, bool usual) const;
  void keepPanelShown(const QString& panel, bool shown);
  /// The panels that are not behind another one of their place, with their sizes, px; none before
  /// they were kept.
  std::vector<std::pair<QString, QSize>> panelsInFront() const;
  /// At once, with what else was kept: a program that is killed shows them again.
  void keepPanelsInFront(const std::vector<std::pair<QString, QSize>>& panels);

  /// How 3D view and slices are arranged; nothing is enlarged.
  presenters::ViewArrangement arrangement() const;
  void keepArrangement(const presenters::ViewArrangement& arrangement);

  /// Whether a slice that is zoomed takes the others along, and the slices have the 3D view's
  /// scale.
  bool zoomTogether() const;
  void keepZoomTogether(bool together);
  bool zoomWithScene() const;
  void keepZoomWithScene(bool with);

  /// The user's own grey windows, of images of one kind ("hounsfield", "mr", "other"), by name.
  std::vector<presenters::NamedWindow> greyWindows(const QString& kind) const;
  void keepGreyWindow(const QString& kind, const presenters::NamedWindow& window);
  void forgetGreyWindow(const QString& kind, const std::string& name);

  /// Code of the window's language; empty: the system's.
  QString language() const;
  void keepLanguage(const QString& code);

  Theme theme() const;
  void keepTheme(const Theme& theme);

  /// Identifier of the case that was open last (scene::Case::id), which is no patient data; empty:
  /// none.
  std::string lastCase() const;
  void keepLastCase(const std::string& id);

  /// Whether thumbnails of cases are drawn in the background.
  bool thumbnails() const;
  void keepThumbnails(bool drawn);

  /// File of the instrument, and the axis of the file along which it lies (presenters::
  /// kInstrumentAxes); both empty without one.
  std::pair<QString, QString> instrument() const;
  void keepInstrument(const QString& file, const QString& axis);

  bool drillSound() const; ///< whether the drill is heard
  void keepDrillSound(bool heard);

private:
  std::optional<double> number(const QString& key) const;
  mutable QSettings m_file;
};

} // namespace petrous::workstation
