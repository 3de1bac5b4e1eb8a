#pragma once

#include <optional>
#include <string>

#include <QObject>

#include "petrous/Presenters/RegistrationSession.h"

namespace petrous::workstation
{

class SliceColumn;

/// The MR over the CT in the slices: how, how much of it, and where it lies while it is being
/// registered. Nothing of the MR is loaded until it is seen.
class MrOverlay : public QObject
{
  Q_OBJECT
public:
  using Mode = std::optional<presenters::OverlayMode>; ///< none: CT alone

  /// Both must outlive this.
  MrOverlay(presenters::RegistrationSession& session, SliceColumn& slices, QObject* parent);

  const Mode& mode() const noexcept { return m_mode; }
  double opacity() const noexcept { return m_opacity; }
  bool seen() const noexcept { return m_mode || m_alone; }

  void reset(); ///< another case
  void refresh();
  void set(const Mode& mode, double opacity);
  void next();                                                       ///< way to show it
  void flick();                                                      ///< MR and CT alone, by turns
  void showAlone(bool mr);                                           ///< the MR, or the CT
  void setUnderWay(const std::optional<core::RigidTransform>& best); ///< X_MC, of a run; or none

signals:
  void changed(); ///< mode or opacity
  void statusMessage(const QString& line);

private:
  bool load(const scene::ImagePart& part);

  presenters::RegistrationSession& m_session;
  SliceColumn& m_slices;
  Mode m_mode;
  double m_opacity = 0.5;
  std::optional<double> m_alone;                     // 0 the CT, 1 the MR
  std::optional<presenters::SliceOverlay> m_overlay; // of m_overlayOf, when first shown
  std::string m_overlayOf;
  std::optional<core::RigidTransform> m_best;
};

} // namespace petrous::workstation
