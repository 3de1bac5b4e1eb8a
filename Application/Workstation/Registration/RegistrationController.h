#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <QObject>
#include <QPointer>
#include <QTimer>

#include "petrous/Presenters/RegistrationSession.h"
#include "petrous/Registration/LiveMetric.h"

class QAction;
class QMenu;
class QMessageBox;

namespace petrous::workstation
{

class BackgroundWork;
class MrOverlay;
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
  void statusMessage(const QString& line);

private:
  using Best = std::optional<core::RigidTransform>;

  QAction* addAction(const QString& text, const QKeySequence& keys, const QString& tip);
  void connectPanel();
  void byHand(const std::function<void()>& move);
  void begin(presenters::RegistrationSession::Way way);
  void heard(const registration::MetricSample& sample, const core::RigidTransform& best);
  void finished(const presenters::RegistrationOutcome& outcome);
  void waitForTheDrill(const presenters::RegistrationOutcome& outcome);
  void cancel();
  void stopped(); // on request
  void offerBest(const core::RigidTransform& best);
  void endRun(const QString& line);
  void showMarks();
  void showRegion();
  void addPoint();
  void askMetric();
  void showMetric();

  presenters::WorkstationModel& m_model;
  SliceColumn& m_slices;
  QWidget& m_window;
  presenters::RegistrationSession m_session;
  RegistrationPanel* m_panel;
  MrOverlay* m_overlay;
  QMenu* m_menu;
  std::unique_ptr<BackgroundWork> m_run;
  std::unique_ptr<BackgroundWork> m_metricWork;
  std::shared_ptr<const registration::LiveMetric> m_metric; // of m_metricOf, when first asked for
  std::string m_metricOf;
  std::optional<double> m_firstMetric;
  Best m_best;                       // of the run
  QPointer<QMessageBox> m_question;  // whether that is kept
  std::unique_ptr<QTimer> m_waiting; // with a result, for the drill
  QTimer m_sceneLater;
};

} // namespace petrous::workstation
