#pragma once

#include <optional>
#include <string>

#include <QObject>

#include "BackgroundWork.h"
#include "petrous/Presenters/RegistrationSession.h"

namespace petrous::workstation
{

class SliceColumn;

/// The MR overlay in the slices: mode, opacity, and its pose during a registration. The MR is
/// loaded only when first shown, in a separate thread; the slices go on without it until then.
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
  bool reading() const noexcept { return !m_readingOf.empty(); } ///< what is to be seen

  void reset(); ///< another case
  void refresh();
  void set(const Mode& mode, double opacity);
  void next();                                                       ///< next mode
  void flick();                                                      ///< toggles MR or CT alone
  void showAlone(bool mr);                                           ///< the MR, or the CT
  presenters::ShownImages shown() const;                             ///< in the slices
  void setUnderWay(const std::optional<core::RigidTransform>& best); ///< X_MC of a run; or none

signals:
  void changed(); ///< mode or opacity
  void drawn();   ///< the slices may show other images: see `shown`
  void statusMessage(const QString& line);

private:
  bool load(const scene::ImagePart& part);
  void forget();
  void failed(const QString& why);
  void draw();
  void setWindow(const presenters::GreyWindow& window);

  presenters::RegistrationSession& m_session;
  SliceColumn& m_slices;
  Mode m_mode;
  double m_opacity = 0.5;
  std::optional<double> m_alone;                     // 0 the CT, 1 the MR
  std::optional<presenters::SliceOverlay> m_overlay; // of m_overlayOf, made on demand
  std::string m_overlayOf;
  std::optional<core::RigidTransform> m_best;
  std::string m_readingOf;
  BackgroundWork m_reading;
};

} // namespace petrous::workstation
