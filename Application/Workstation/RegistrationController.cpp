#include "RegistrationController.h"

#include <utility>

#include <QAction>
#include <QApplication>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>

#include "BackgroundWork.h"
#include "ImportJob.h"
#include "MetricCurve.h"
#include "RegistrationPanel.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "Theme.h"

namespace petrous::workstation
{

namespace
{
using presenters::OverlayMode;

constexpr int kSceneAfter = 200; // ms
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
  , m_menu(new QMenu(tr("&Registration"), &window))
  , m_run(std::make_unique<BackgroundWork>())
  , m_metricWork(std::make_unique<BackgroundWork>())
{
  const auto on = [this](QAction* action, auto what)
  { connect(action, &QAction::triggered, this, what); };
  on(addAction(tr("&Register the MR"), Qt::CTRL + Qt::Key_R,
               tr("Lays the MR on the CT by mutual information")),
     [this] { begin(true); });
  on(addAction(tr("Re&fine"), {}, tr("The same from where the MR lies now")),
     [this] { begin(false); });
  on(addAction(tr("&Cancel"), {}, tr("Stops the registration; what it reached can be kept")),
     [this] { m_run->cancel(); });
  m_menu->addSeparator();
  on(addAction(tr("CT or MR alone, by &turns"), Qt::Key_V, tr("To see whether they agree")),
     [this] { flick(); });
  on(addAction(tr("Ne&xt way to show the MR"), Qt::Key_O,
               tr("CT alone, blend, the CT's edges over the MR, checkerboard")),
     [this] { nextOverlay(); });
  m_menu->addSeparator();
  on(addAction(tr("&Point here"), Qt::Key_K,
               tr("The crosshair marks a point of the CT, then the same point of the MR")),
     [this] { addPoint(); });
  m_menu->addSeparator();
  on(addAction(tr("&Undo the MR's move"), Qt::CTRL + Qt::ALT + Qt::Key_Z,
               tr("Back to how the MR lay before")),
     [this] { m_session.undo(); });
  on(addAction(tr("Red&o the MR's move"), Qt::CTRL + Qt::ALT + Qt::Key_Y, tr("Forth again")),
     [this] { m_session.redo(); });
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

void RegistrationController::connectPanel()
{
  connect(m_panel, &RegistrationPanel::overlayChosen, this,
          [this](const auto& mode) { setOverlay(mode, m_opacity); });
  connect(m_panel, &RegistrationPanel::opacityChosen, this,
          [this](double opacity) { setOverlay(m_mode, opacity); });
  connect(m_panel, &RegistrationPanel::mrChosen, this,
          [this]
          {
            m_firstMetric.reset();
            m_panel->setMetric({});
            showOverlay();
            showMarks();
          });
  connect(m_panel, &RegistrationPanel::registerAsked, this, [this] { begin(true); });
  connect(m_panel, &RegistrationPanel::refineAsked, this, [this] { begin(false); });
  connect(m_panel, &RegistrationPanel::cancelAsked, this, [this] { m_run->cancel(); });
  connect(m_panel, &RegistrationPanel::pointAsked, this, &RegistrationController::addPoint);
  connect(m_panel, &RegistrationPanel::landmarksChanged, this, &RegistrationController::showMarks);
  connect(m_panel, &RegistrationPanel::hidden, this,
          [this]
          {
            m_metricWork->drop();
            m_metric.reset();
            m_panel->setMetric({});
          });
  const auto byHand = [this](const auto& move)
  {
    if (!running())
      move();
  };
  connect(&m_slices, &SliceColumn::moveAsked, this,
          [=](const Eigen::Vector3d& mm) { byHand([&] { m_session.shift(mm); }); });
  connect(&m_slices, &SliceColumn::turnAsked, this,
          [=](const Eigen::Vector3d& axis, double degrees)
          { byHand([&] { m_session.turn(axis, degrees); }); });
  connect(m_run.get(), &BackgroundWork::progressed, m_panel, &RegistrationPanel::setProgress);
  connect(m_run.get(), &BackgroundWork::failed, this, &RegistrationController::endRun);
  connect(m_run.get(), &BackgroundWork::cancelled, this, &RegistrationController::stopped);
}

bool RegistrationController::running() const
{
  return m_run->busy();
}

void RegistrationController::caseChanged()
{
  m_run->drop();
  m_metricWork->drop();
  m_metric.reset();
  m_firstMetric.reset();
  m_overlay.reset();
  m_best.reset();
  m_mode.reset();
  m_flick.reset();
  m_session.caseChanged();
  m_panel->setRunning(false);
  m_panel->caseChanged();
  m_panel->setOverlay(m_mode, m_opacity);
  showOverlay();
  showMarks();
}

void RegistrationController::mrMoved()
{
  m_panel->refresh();
  showOverlay();
  showMarks();
  askMetric();
  m_sceneLater.start();
}

QString RegistrationController::place() const
{
  const std::string structure = m_model.structureAt(m_model.crosshair());
  return structure.empty() ? tr("the crosshair") : words(structure);
}

void RegistrationController::begin(bool search)
{
  if (!m_session.part() || running() || m_model.drilling())
    return;
  m_panel->curve().clear();
  m_panel->say({});
  m_panel->setRunning(true);
  m_best.reset();
  const auto ct = m_model.value().ct.volume;
  const auto mr = m_session.part()->volume;
  const auto options = m_session.fitOptions(search);
  const Eigen::Vector3d at = m_model.crosshair();
  const auto listener =
      [this](const registration::MetricSample& sample, const core::RigidTransform& best)
  { m_run->post([=] { heard(sample, best); }); };
  m_run->start(
      [this, ct, mr, options, at, listener,
       place = place()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto result =
            registration::registerRigid(*ct.get(), *mr.get(), options, at, progress, listener);
        return [this, result, place] { finished(result, place); };
      });
}

void RegistrationController::heard(const registration::MetricSample& sample,
                                   const core::RigidTransform& best)
{
  m_panel->curve().add(sample.level, sample.metric);
  m_best = best;
  if (m_mode || m_flick)
    showOverlay();
}

void RegistrationController::endRun(const QString& line)
{
  m_best.reset();
  m_panel->setRunning(false);
  m_panel->say(line);
  m_panel->refresh();
  showOverlay();
}

void RegistrationController::finished(const registration::Registration& result,
                                      const QString& place)
{
  m_best.reset();
  m_panel->setRunning(false);
  const QString text = words(result.text);
  const bool taken = m_session.take(result, bytes(place));
  if (!m_mode && taken)
    setOverlay(OverlayMode::Edges, m_opacity); // what came of it is to be looked at
  endRun(taken ? QString() : tr("Failed, and nothing was changed: %1").arg(text));
  emit said(taken ? tr("MR %1: %2").arg(words(m_session.mr()), words(m_session.stateInWords()))
                  : tr("The registration failed"));
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
  box->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* keep = box->addButton(tr("Keep it"), QMessageBox::AcceptRole);
  box->setEscapeButton(box->addButton(tr("As before"), QMessageBox::RejectRole));
  const std::string mr = m_session.mr();
  const std::string open = m_model.value().name;
  connect(box, &QMessageBox::buttonClicked, this,
          [=](QAbstractButton* pressed)
          {
            const bool same = m_model.hasCase() && m_model.value().name == open;
            if (pressed != keep || !same || m_session.mr() != mr || running())
              return;
            m_session.keep(best);
            m_panel->say(tr("Kept as it was when it was stopped."));
          });
  box->open();
}

void RegistrationController::setOverlay(const std::optional<OverlayMode>& mode, double opacity)
{
  m_mode = mode;
  m_opacity = opacity;
  m_flick.reset();
  m_panel->setOverlay(m_mode, m_opacity);
  showOverlay();
}

void RegistrationController::flick()
{
  if (!m_session.part())
    return;
  m_flick = m_flick && *m_flick == 1.0 ? 0.0 : 1.0;
  showOverlay();
}

void RegistrationController::nextOverlay()
{
  if (!m_session.part())
    return;
  if (m_flick)
    setOverlay(m_mode, m_opacity); // back from one alone
  else if (!m_mode)
    setOverlay(OverlayMode::Blend, m_opacity);
  else if (*m_mode == OverlayMode::Checker)
    setOverlay(std::nullopt, m_opacity);
  else
    setOverlay(static_cast<OverlayMode>(static_cast<int>(*m_mode) + 1), m_opacity);
}

void RegistrationController::showOverlay()
{
  const scene::ImagePart* part = m_session.part();
  const double alone = m_flick.value_or(-1.0);
  if (!part || alone == 0.0 || (!m_mode && !m_flick))
  {
    if (!m_mode && !m_flick)
      m_overlay.reset(); // off: nothing of the MR is kept for it
    m_slices.setOverlay(nullptr);
    m_slices.setNotice(alone == 0.0 ? tr("CT alone (V)") : QString());
    return;
  }
  if (!m_overlay || m_overlayOf != part->name)
  {
    QApplication::setOverrideCursor(Qt::WaitCursor);
    try
    {
      m_overlay = presenters::overlayOf(*part);
      m_overlayOf = part->name;
    }
    catch (const std::exception& error)
    {
      m_overlay.reset();
      m_panel->say(inWords(error));
    }
    QApplication::restoreOverrideCursor();
    if (!m_overlay)
      return m_slices.setOverlay(nullptr);
  }
  presenters::SliceOverlay overlay = *m_overlay;
  overlay.mrFromCt = m_best.value_or(part->mrFromCt);
  overlay.registered = part->registered;
  overlay.mode = m_flick ? OverlayMode::Blend : *m_mode;
  overlay.opacity = m_flick.value_or(m_opacity);
  m_slices.setOverlay(std::make_shared<const presenters::SliceOverlay>(std::move(overlay)));
  QString notice = words(part->name);
  if (m_flick)
    notice = tr("%1 alone (V)").arg(notice);
  if (m_best)
    notice += tr(": being registered");
  else if (!part->registered)
    notice += tr(": not registered");
  m_slices.setNotice(notice);
}

void RegistrationController::showMarks()
{
  std::vector<SliceMark> marks;
  const auto& rows = m_session.landmarks().rows();
  for (std::size_t n = 0; n < rows.size(); ++n)
  {
    const QString number = QString::number(n + 1);
    marks.push_back({rows[n].ct, number, kCtPoint});
    if (rows[n].mr && m_session.part()) // where it is seen now
      marks.push_back({m_session.part()->mrFromCt.inverse() * *rows[n].mr, number, kMrPoint});
  }
  m_slices.setMarks(marks);
  m_panel->refresh();
}

void RegistrationController::addPoint()
{
  if (!m_session.part() || running())
    return;
  m_session.addLandmark();
  m_flick = m_session.landmarks().waitsForMr() ? 1.0 : 0.0; // where the next point is to be found
  showOverlay();
  showMarks();
  m_panel->say(m_session.landmarks().waitsForMr()
                   ? tr("Now the same point in the MR: crosshair there, then K.")
                   : tr("The next point in the CT; three pairs at least, far apart."));
}

void RegistrationController::askMetric()
{
  const scene::ImagePart* part = m_session.part();
  if (!part || !m_panel->isVisible())
    return;
  if (m_metric && m_metricOf == part->name)
    return showMetric();
  if (m_metricWork->busy() || running())
    return;
  m_panel->setMetric(tr("Metric: being prepared…"));
  m_metricWork->start(
      [this, ct = m_model.value().ct.volume, mr = part->volume,
       name = part->name](const core::Progress&) -> BackgroundWork::Reply
      {
        const auto metric = std::make_shared<const registration::LiveMetric>(*ct.get(), *mr.get());
        return [this, metric, name]
        {
          m_metric = metric;
          m_metricOf = name;
          m_firstMetric.reset();
          showMetric();
        };
      });
}

void RegistrationController::showMetric()
{
  const scene::ImagePart* part = m_session.part();
  if (!part || !m_metric || m_metricOf != part->name)
    return m_panel->setMetric({});
  const double now = m_metric->at(part->mrFromCt);
  const auto moved = m_session.movedByHand();
  if (!m_firstMetric || (moved.shift == 0.0 && moved.turn == 0.0))
    m_firstMetric = now;
  m_panel->setMetric(tr("Metric %1 (%2%3 by hand)")
                         .arg(now, 0, 'f', 4)
                         .arg(now < *m_firstMetric ? "" : "+")
                         .arg(now - *m_firstMetric, 0, 'f', 4));
}

} // namespace petrous::workstation
