#include "RegistrationController.h"

#include <utility>

#include <QAction>
#include <QApplication>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>

#include "Application.h"
#include "BackgroundWork.h"
#include "Commands.h"
#include "MetricCurve.h"
#include "MrOverlay.h"
#include "RegistrationPanel.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
using Way = presenters::RegistrationSession::Way;

constexpr int kSceneAfter = 200; // ms
constexpr int kTryAgain = 200;   // ms
const QColor kCtPoint("#ffd040");
const QColor kMrPoint("#ff7ac0");
} // namespace

RegistrationController::RegistrationController(presenters::WorkstationModel& model,
                                               SliceColumn& slices, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_slices(slices)
  , m_window(window)
  , m_session(model)
  , m_panel(new RegistrationPanel(m_session))
  , m_overlay(new MrOverlay(m_session, slices, this))
  , m_menu(new QMenu(tr("&Registration"), &window))
  , m_run(std::make_unique<BackgroundWork>())
  , m_metricWork(std::make_unique<BackgroundWork>())
{
  const auto on = [this](QAction* action, auto what)
  { connect(action, &QAction::triggered, this, what); };
  on(m_register = addAction(tr("&Register the MR"), Qt::CTRL + Qt::Key_R, {}),
     [this] { begin(Way::Register); });
  on(addAction(tr("Re&fine"), {}, tr("The same from where the MR lies now")),
     [this] { begin(Way::Refine); });
  on(addAction(tr("&Cancel"), {}, tr("Stops the registration; what it reached can be kept")),
     [this] { cancel(); });
  m_menu->addSeparator();
  on(m_flick = addAction({}, Qt::Key_V, tr("To see whether they agree")),
     [this] { m_overlay->flick(); });
  on(m_next = addAction(tr("Ne&xt way to show the MR"), Qt::Key_O, {}),
     [this] { m_overlay->next(); });
  m_menu->addSeparator();
  on(m_point = addAction(tr("&Point here"), Qt::Key_K, {}), [this] { addPoint(); });
  m_menu->addSeparator();
  on(addAction(tr("&Undo the MR's move"), Qt::CTRL + Qt::ALT + Qt::Key_Z,
               tr("Back to how the MR lay before")),
     [this] { moveManually([this] { m_session.undo(); }); });
  on(addAction(tr("Red&o the MR's move"), Qt::CTRL + Qt::ALT + Qt::Key_Y, tr("Forth again")),
     [this] { moveManually([this] { m_session.redo(); }); });
  nameImages();
  enableMenu();
  connectPanel();
  m_sceneLater.setSingleShot(true);
  m_sceneLater.setInterval(kSceneAfter);
  connect(&m_sceneLater, &QTimer::timeout, this, &RegistrationController::sceneStale);
}

RegistrationController::~RegistrationController() = default;

QAction* RegistrationController::addAction(const QString& text, const QKeySequence& keys,
                                           const QString& tip)
{
  QAction* action = m_menu->addAction(text);
  action->setShortcut(keys);
  action->setStatusTip(tip);
  return action;
}

// The primary image may be an MR itself.
void RegistrationController::nameImages()
{
  const QString primary = words(m_session.primary());
  m_register->setStatusTip(
      tr("Lays the MR on the %1 by mutual information, as the panel says").arg(primary));
  m_flick->setText(tr("%1 or MR alone, by &turns").arg(primary));
  m_next->setStatusTip(
      tr("%1 alone, blend, the edges of the %1 over the MR, checkerboard").arg(primary));
  m_point->setStatusTip(
      tr("The crosshair marks a point of the %1, then the same point of the MR").arg(primary));
}

// Without an MR there is nothing to register or to show; the panel (F5) says so.
void RegistrationController::enableMenu()
{
  for (QAction* action : m_menu->actions())
    enable(*action, m_session.part() != nullptr, tr("The case has no MR (Case > Add MR…)"));
}

void RegistrationController::connectPanel()
{
  connect(m_panel, &RegistrationPanel::overlayChosen, this,
          [this](const auto& mode) { m_overlay->set(mode, m_overlay->opacity()); });
  connect(m_panel, &RegistrationPanel::opacityChosen, this,
          [this](double opacity) { m_overlay->set(m_overlay->mode(), opacity); });
  connect(m_overlay, &MrOverlay::changed, this,
          [this] { m_panel->setOverlay(m_overlay->mode(), m_overlay->opacity()); });
  connect(m_overlay, &MrOverlay::statusMessage, m_panel, &RegistrationPanel::say);
  connect(m_overlay, &MrOverlay::drawn, this, &RegistrationController::shownChanged);
  connect(m_panel, &RegistrationPanel::mrChosen, this, &RegistrationController::chosen);
  connect(m_panel, &RegistrationPanel::registerAsked, this, [this] { begin(Way::Register); });
  connect(m_panel, &RegistrationPanel::refineAsked, this, [this] { begin(Way::Refine); });
  connect(m_panel, &RegistrationPanel::cancelAsked, this, &RegistrationController::cancel);
  connect(m_panel, &RegistrationPanel::pointAsked, this, &RegistrationController::addPoint);
  connect(m_panel, &RegistrationPanel::landmarksAsked, this, [this] { begin(Way::Landmarks); });
  connect(m_panel, &RegistrationPanel::landmarksChanged, this, &RegistrationController::showMarks);
  connect(m_panel, &RegistrationPanel::hidden, this,
          [this]
          {
            m_metricWork->drop();
            m_metric.reset();
            m_panel->setMetric({});
            showRegion();
          });
  connect(m_panel, &RegistrationPanel::shown, this, &RegistrationController::showRegion);
  connect(m_panel, &RegistrationPanel::aimChosen, this, &RegistrationController::showRegion);
  connect(&m_slices, &SliceColumn::moveAsked, this,
          [=](const Eigen::Vector3d& mm) { moveManually([&] { m_session.shift(mm); }); });
  connect(&m_slices, &SliceColumn::turnAsked, this,
          [=](const Eigen::Vector3d& axis, double degrees)
          { moveManually([&] { m_session.turn(axis, degrees); }); });
  connect(m_run.get(), &BackgroundWork::progressed, m_panel, &RegistrationPanel::setProgress);
  connect(m_run.get(), &BackgroundWork::failed, this, &RegistrationController::endRun);
  connect(m_run.get(), &BackgroundWork::cancelled, this, &RegistrationController::stopped);
  connect(m_metricWork.get(), &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            m_panel->setMetric({});
            m_panel->say(why);
          });
}

// Another MR.
void RegistrationController::chosen()
{
  m_firstMetric.reset();
  m_panel->setMetric({});
  m_overlay->refresh();
  showMarks();
}

presenters::ShownImages RegistrationController::shown() const
{
  return m_overlay->shown();
}

void RegistrationController::show(const std::string& image)
{
  const presenters::ShownImages now = shown();
  if (image == "ct")
  {
    if (!now.ct)
      m_overlay->set(std::nullopt, m_overlay->opacity());
    return;
  }
  if (now.mr == image)
    return;
  if (image != m_session.mr())
  {
    if (running() || !m_session.landmarks().rows().empty()) // which are of the other MR
    {
      emit statusMessage(tr("The slices go on showing %1, which is being registered; choose the MR "
                            "under Registration (F5)")
                             .arg(words(m_session.mr())));
      return;
    }
    m_session.choose(image);
    m_panel->refresh();
    chosen();
  }
  m_overlay->showAlone(true);
}

void RegistrationController::show(const std::optional<scene::ViewState::Slices::Overlay>& overlay)
{
  using presenters::OverlayMode;
  if (!overlay || !m_model.hasCase() || !scene::findMr(m_model.value(), overlay->mr) || running())
    return;
  if (overlay->mr != m_session.mr())
  {
    m_session.choose(overlay->mr);
    m_panel->refresh();
    chosen();
  }
  for (const OverlayMode mode : {OverlayMode::Blend, OverlayMode::Edges, OverlayMode::Checker})
    if (overlay->mode == nameOf(mode))
      m_overlay->set(mode, overlay->opacity);
}

std::optional<scene::ViewState::Slices::Overlay> RegistrationController::overlay() const
{
  if (!m_session.part() || !m_overlay->mode())
    return std::nullopt;
  return scene::ViewState::Slices::Overlay{m_session.mr(), nameOf(*m_overlay->mode()),
                                           m_overlay->opacity()};
}

void RegistrationController::moveManually(const std::function<void()>& move)
{
  if (running())
    return;
  m_panel->openHand();
  QString why;
  guarded(move, [&why](const QString& fault) { why = fault; });
  m_panel->say(why);
}

bool RegistrationController::running() const
{
  return m_run->busy() || m_waiting;
}

QString RegistrationController::runningText() const
{
  return running() ? tr("the registration of the MR “%1”").arg(words(m_session.mr())) : QString();
}

void RegistrationController::stop()
{
  m_run->dropInLoop();
  m_waiting.reset();
  endRun(tr("Stopped; the MR lies as before."));
}

void RegistrationController::caseChanged()
{
  const bool stopped = running();
  beginAnew();
  if (stopped)
    emit statusMessage(tr("The registration ended with its case; the MR lies as before"));
}

void RegistrationController::beginAnew()
{
  m_run->drop();
  m_waiting.reset();
  delete m_question; // of the previous case
  m_metricWork->drop();
  m_metric.reset();
  m_firstMetric.reset();
  m_session.caseChanged();
  nameImages();
  enableMenu();
  m_panel->setRunning(false);
  m_overlay->reset();
  showMarks();
  emit runningChanged();
}

void RegistrationController::partsChanged()
{
  const std::string onto = m_session.aim().onto;
  if (!m_session.partsChanged())
    return beginAnew();
  enableMenu();
  if (running() && m_session.aim().onto != onto)
  {
    m_run->drop();
    m_waiting.reset();
    endRun(tr("Stopped: the MR to which it was being registered is gone; it lies as before."));
  }
  m_overlay->refresh();
  showMarks(); // and the panel
}

void RegistrationController::preferUnregistered()
{
  if (running() || !m_session.preferUnregistered())
    return;
  m_panel->refresh();
  chosen();
}

void RegistrationController::mrMoved()
{
  m_panel->refresh();
  m_overlay->refresh();
  showMarks();
  askMetric();
  m_sceneLater.start();
}

void RegistrationController::begin(Way way)
{
  if (way == Way::Register && !m_panel->isVisible()) // nobody sees which one is chosen there
    preferUnregistered();
  if (m_model.hasCase() && !m_model.drilling())
    emit panelWanted(); // its verdict, or why nothing can be registered
  if (!m_session.part() || running() || m_model.drilling())
    return;
  if (way == Way::Refine && !m_session.part()->registered)
    return;
  m_panel->say({});
  presenters::RegistrationRequest request;
  try
  {
    request = m_session.request(way);
  }
  catch (const std::exception& error)
  {
    return m_panel->say(toString(error));
  }
  if (!request.asIs)
    m_panel->curve().clear();
  m_panel->setRunning(true);
  scene::Case value = m_model.value(); // shares voxels
  const auto listener =
      [this](const registration::MetricSample& sample, const core::RigidTransform& best)
  { m_run->post([=] { heard(sample, best); }); };
  m_run->start(
      [this, value = std::move(value), request, listener,
       library = m_model.library()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto outcome = presenters::registerMr(value, request, progress, listener);
        library.checkVoxels(value, progress); // the result for damaged images is worthless
        return [this, outcome] { finished(outcome); };
      });
  emit runningChanged();
}

void RegistrationController::heard(const registration::MetricSample& sample,
                                   const core::RigidTransform& best)
{
  m_panel->curve().add(sample.level, sample.metric);
  m_best = best;
  m_overlay->setUnderWay(m_best);
}

void RegistrationController::endRun(const QString& line)
{
  m_best.reset();
  m_panel->setRunning(false);
  m_panel->say(line);
  m_panel->refresh();
  m_overlay->setUnderWay({});
  emit runningChanged();
}

void RegistrationController::finished(const presenters::RegistrationOutcome& outcome)
{
  if (m_model.drilling())
    return waitForTheDrill(outcome);
  endRun({});
  if (outcome.failed)
  {
    m_panel->say(tr("Failed, and nothing was changed: %1").arg(phrase(outcome.how.text)));
    emit statusMessage(tr("The registration failed"));
    return;
  }
  bool isTaken = false;
  guarded([&] { isTaken = m_session.take(outcome); },
          [this](const QString& why) { m_panel->say(why); });
  if (!isTaken)
    return;
  if (!m_overlay->mode())
    m_overlay->set(presenters::OverlayMode::Edges, m_overlay->opacity()); // for inspection
  emit statusMessage(tr("MR %1: %2").arg(words(m_session.mr()), phrase(m_session.stateText())));
}

void RegistrationController::waitForTheDrill(const presenters::RegistrationOutcome& outcome)
{
  m_panel->say(tr("Done; the MR is laid as soon as the drill stands still."));
  m_waiting = std::make_unique<QTimer>();
  connect(m_waiting.get(), &QTimer::timeout, this,
          [this, outcome]
          {
            if (m_model.drilling())
              return;
            m_waiting.release()->deleteLater(); // it is the sender
            finished(presenters::RegistrationOutcome(outcome));
          });
  m_waiting->start(kTryAgain);
}

void RegistrationController::cancel()
{
  m_run->cancel();
  if (!m_waiting)
    return;
  m_waiting.reset();
  endRun(tr("Stopped; the MR lies as before."));
}

void RegistrationController::stopped()
{
  const Best best = m_best;
  endRun(tr("Stopped; the MR lies as before."));
  if (best)
    offerBest(*best);
}

void RegistrationController::offerBest(const core::RigidTransform& best)
{
  auto* box = new QMessageBox(QMessageBox::Question, tr("Petrous"),
                              tr("The registration was stopped. Keep the best place that it had "
                                 "found by then? Nobody has judged it; it can be undone."),
                              QMessageBox::NoButton, &m_window);
  m_question = box;
  box->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* keep = box->addButton(tr("Keep it"), QMessageBox::AcceptRole);
  box->setEscapeButton(box->addButton(tr("As before"), QMessageBox::RejectRole));
  connect(box, &QMessageBox::buttonClicked, this,
          [this, best, keep, mr = m_session.mr()](QAbstractButton* pressed)
          {
            if (pressed != keep || m_session.mr() != mr || running())
              return;
            m_session.keep(best);
            m_panel->say(m_session.lies(best) ? tr("Kept as it was when it was stopped.")
                                              : tr("The drill runs; the MR lies as before."));
          });
  box->open();
}

void RegistrationController::showMarks()
{
  std::vector<SliceMark> marks;
  const auto& rows = m_session.landmarks().rows();
  for (std::size_t n = 0; n < rows.size(); ++n)
  {
    const QString number = QString::number(n + 1);
    marks.push_back({rows[n].ct, number, kCtPoint});
    if (rows[n].mr && m_session.part()) // where it appears now
      marks.push_back({m_session.part()->mrFromCt.inverse() * *rows[n].mr, number, kMrPoint});
  }
  m_slices.setMarks(marks);
  showRegion();
  m_panel->refresh();
}

void RegistrationController::showRegion()
{
  m_slices.setRegion(m_session.part() && m_panel->isVisible() ? m_session.aim().box : 0.0);
}

void RegistrationController::addPoint()
{
  if (!m_session.part() || running())
    return;
  m_session.addLandmark();
  m_panel->openPoints();
  m_overlay->showAlone(m_session.landmarks().waitsForMr()); // where the next point is to be picked
  showMarks();
  m_panel->say(m_session.landmarks().waitsForMr()
                   ? tr("Now the same point in the MR: crosshair there, then K.")
                   : tr("The next point in the %1; three pairs at least, far apart.")
                         .arg(words(m_session.primary())));
}

void RegistrationController::askMetric()
{
  const scene::ImagePart* part = m_session.part();
  if (!part || !m_panel->isVisible())
    return;
  if (m_metric && m_metricOf == part->volume.peek())
    return showMetric();
  if (m_metricWork->busy() || running())
    return;
  m_panel->setMetric(tr("Metric: being prepared…"));
  m_metricWork->start(
      [this, ct = m_model.value().ct.volume,
       mr = part->volume](const core::Progress&) -> BackgroundWork::Reply
      {
        const auto image = mr.get();
        const auto metric = std::make_shared<const registration::LiveMetric>(*ct.get(), *image);
        return [this, metric, image]
        {
          m_metric = metric;
          m_metricOf = image;
          m_firstMetric.reset();
          showMetric();
        };
      });
}

void RegistrationController::showMetric()
{
  const scene::ImagePart* part = m_session.part();
  if (!part || !m_metric || m_metricOf != part->volume.peek())
    return m_panel->setMetric({});
  const double now = m_metric->at(part->mrFromCt);
  const auto moved = m_session.movedByHand();
  if (!m_firstMetric || (moved.shift == 0.0 && moved.turn == 0.0))
    m_firstMetric = now;
  QString text = tr("Metric with the %1 %2").arg(words(m_session.primary()), numberText(now, 4));
  if (moved.shift > 0.0 || moved.turn > 0.0)
  {
    const QString change = numberText(now - *m_firstMetric, 4);
    text += tr(" (%1%2 by hand)").arg(change.startsWith('-') ? "" : "+", change);
  }
  m_panel->setMetric(text);
}

} // namespace petrous::workstation
