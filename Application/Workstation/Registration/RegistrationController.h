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

/// Shows MRs of the open case in the slices and registers them to the CT: runs the registration in
/// the background, shows its progress, and the metric during manual motion.
class RegistrationController : public QObject
{
  Q_OBJECT
public:
  /// `window`: parent of dialogs. All must outlive this.
  RegistrationController(presenters::WorkstationModel& model, SliceColumn& slices, QWidget& window);
  ~RegistrationController() override;

  RegistrationPanel* panel() { return m_panel; }
  QMenu* menu() { return m_menu; }

  void caseChanged();
  void partsChanged(); ///< the view, points and a run stay as long as the MRs do
  void mrMoved();      ///< or was signed off
  bool running() const;
  QString runningText() const; ///< as it is told to the user; empty: none is running
  void stop();                 ///< without asking whether what it reached is kept
  /// RegistrationSession::preferUnregistered, unless the present one is being registered.
  void preferUnregistered();

  presenters::ShownImages shown() const; ///< in the slices
  /// Has the slices show the CT ("ct") or an MR of the case, if they do not yet.
  void show(const std::string& image);
  /// The MR over the CT as a case was saved with; nullopt: none. One that the case lacks is not
  /// shown.
  void show(const std::optional<scene::ViewState::Slices::Overlay>& overlay);
  std::optional<scene::ViewState::Slices::Overlay> overlay() const;

signals:
  void shownChanged();
  void runningChanged();
  void sceneStale(); ///< views of the MR or of what was drawn on it are outdated; throttled
  void statusMessage(const QString& line);
  void panelWanted(); ///< it says something that must be seen

private:
  using Best = std::optional<core::RigidTransform>;

  QAction* addAction(const QString& text, const QKeySequence& keys, const QString& tip);
  void connectPanel();
  void chosen();
  void beginAnew(); ///< of another case, or without the MR that was chosen
  void nameImages();
  void enableMenu();
  void moveManually(const std::function<void()>& move);
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
  QAction* m_register;
  QAction* m_flick;
  QAction* m_next;
  QAction* m_point;
  std::unique_ptr<BackgroundWork> m_run;
  std::unique_ptr<BackgroundWork> m_metricWork;
  std::shared_ptr<const registration::LiveMetric> m_metric; // of m_metricOf, loaded on demand
  std::shared_ptr<const volume::IntensityVolume> m_metricOf;
  std::optional<double> m_firstMetric;
  Best m_best;                       // of the run
  QPointer<QMessageBox> m_question;  // whether m_best is kept
  std::unique_ptr<QTimer> m_waiting; // holds a result until the drill stops
  QTimer m_sceneLater;
};

} // namespace petrous::workstation
