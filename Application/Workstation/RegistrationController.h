#pragma once

#include <memory>
#include <optional>

#include <QObject>
#include <QTimer>

#include "petrous/Presenters/RegistrationSession.h"
#include "petrous/Registration/LiveMetric.h"

class QAction;
class QMenu;

namespace petrous::workstation
{

class BackgroundWork;
class RegistrationPanel;
class SliceColumn;

/// Has MRs of the open case seen in the slices, and laid on the CT: runs the registration beside
/// the window, shows how far it is, and what the hand does to the metric.
class RegistrationController : public QObject
{
  Q_OBJECT
public:
  /// `window`: asks beside it. All must outlive this.
  RegistrationController(presenters::WorkstationModel& model, SliceColumn& slices, QWidget& window);
  ~RegistrationController() override;

  RegistrationPanel* panel() { return m_panel; }
  QMenu* menu() { return m_menu; }

  void caseChanged();
  void mrMoved(); ///< or was signed
  bool running() const;

signals:
  void sceneStale(); ///< pictures with the MR or what was drawn on it; not at every step of many
  void said(const QString& line);

private:
  using Best = std::optional<core::RigidTransform>;

  QAction* addAction(const QString& text, const QKeySequence& keys, const QString& tip);
  void connectPanel();
  void begin(bool search);
  void heard(const registration::MetricSample& sample, const core::RigidTransform& best);
  void finished(const registration::Registration& result, const QString& place);
  void stopped(); // on request
  void offerBest(const core::RigidTransform& best);
  void endRun(const QString& line);
  void setOverlay(const std::optional<presenters::OverlayMode>& mode, double opacity);
  void flick();
  void nextOverlay();
  void showOverlay();
  void showMarks();
  void addPoint();
  void askMetric();
  void showMetric();
  QString place() const; // what is at the crosshair

  presenters::WorkstationModel& m_model;
  SliceColumn& m_slices;
  QWidget& m_window;
  presenters::RegistrationSession m_session;
  RegistrationPanel* m_panel;
  QMenu* m_menu;
  std::unique_ptr<BackgroundWork> m_run;
  std::unique_ptr<BackgroundWork> m_metricWork;
  std::shared_ptr<const registration::LiveMetric> m_metric; // of m_metricOf, when first asked for
  std::string m_metricOf;
  std::optional<double> m_firstMetric;
  std::optional<presenters::OverlayMode> m_mode; // none: CT alone
  double m_opacity = 0.5;
  std::optional<double> m_flick;                     // 0 the CT, 1 the MR, alone
  std::optional<presenters::SliceOverlay> m_overlay; // of m_overlayOf, when first shown
  std::string m_overlayOf;
  Best m_best; // of the run
  QTimer m_sceneLater;
};

} // namespace petrous::workstation
