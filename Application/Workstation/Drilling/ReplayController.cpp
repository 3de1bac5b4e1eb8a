#include "ReplayController.h"

#include <algorithm>

#include <QAction>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>

#include "Application.h"
#include "AskName.h"
#include "ReplayPanel.h"
#include "SceneDisplay.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowTexts.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/Recordings.h"

namespace petrous::workstation
{

namespace
{

constexpr int kFrame = 16; // ms

using Files = std::vector<std::filesystem::path>;

QString nameOf(const Files& files)
{
  const QString name = QFile::decodeName(files.front().filename().c_str());
  if (files.size() == 1)
    return name;
  return ReplayController::tr("%1 and %2 more").arg(name).arg(files.size() - 1);
}

} // namespace

ReplayController::ReplayController(presenters::WorkstationModel& model, ThreeDView& view,
                                   QAction& play, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_view(view)
  , m_play(play)
  , m_window(window)
  , m_panel(new ReplayPanel(play))
{
  m_play.setIconText(tr("Play recording"));
  m_frames.setInterval(kFrame);
  m_frames.setTimerType(Qt::PreciseTimer);
  connect(&m_frames, &QTimer::timeout, this, &ReplayController::frame);
  connect(&m_play, &QAction::triggered, this, &ReplayController::togglePlay);
  connect(m_panel, &ReplayPanel::recordingChosen, this, &ReplayController::choose);
  connect(m_panel, &ReplayPanel::openAsked, this, &ReplayController::openFile);
  connect(m_panel, &ReplayPanel::exportAsked, this, &ReplayController::exportTable);
  connect(m_panel, &ReplayPanel::ghostAsked, this, &ReplayController::showGhost);
  connect(m_panel, &ReplayPanel::seekAsked, this,
          [this](int milliseconds) { goTo(0.001 * milliseconds); });
  m_panel->onCaseChanged = [this]
  {
    close();
    listRecordings();
  };
  m_panel->onPartsChanged = [this]
  {
    if (!m_files.empty()) // other structures
      read(m_files);
  };
  m_panel->onRecordingsChanged = [this] { listRecordings(); };
  m_panel->onToolMoved = [this] { toolMoved(); };
  connect(&m_work, &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            close();
            listRecordings();
            m_panel->say(sentence(capitalized(why)));
          });
}

ReplayController::~ReplayController()
{
  m_panel->onCaseChanged = m_panel->onPartsChanged = m_panel->onRecordingsChanged =
      m_panel->onToolMoved = {};
  m_panel->setReview(nullptr); // the panel lives on
}

// The library's, the last one where it is elsewhere, those attached, and the one that is open; what
// belongs to one operation in one row.
void ReplayController::listRecordings()
{
  m_sources.clear();
  QStringList names;
  int current = -1;
  if (m_model.hasCase())
  {
    Files files;
    const auto add = [this, &files](const std::filesystem::path& file)
    {
      const bool isWritten = m_model.touching() && file == m_model.recording();
      const bool isListed = std::find(files.begin(), files.end(), file) != files.end();
      if (!file.empty() && !isWritten && !isListed)
        files.push_back(file);
    };
    for (const auto& file : presenters::recordingsOf(m_model.library(), m_model.value().name))
      add(file);
    add(m_model.lastRecording());
    for (Files& operation : presenters::inOperations(files))
      m_sources.push_back({nameOf(operation), std::move(operation), {}});
    for (const scene::Attachment& one : m_model.value().attachments)
      if (one.kind == scene::Attachment::Kind::Recording)
        m_sources.push_back({tr("%1, attached").arg(words(one.name)), {}, one.name});
    for (std::size_t n = 0; n < m_sources.size(); ++n)
      if (!m_files.empty())
      {
        Files there = m_sources[n].files;
        if (there.empty())
          guarded(
              [&]
              {
                there = {library::attachmentFile(
                    m_model.library(),
                    scene::findAttachment(m_model.value(), m_sources[n].attachment))};
              },
              [](const QString&) {}); // not stored yet
        if (there == m_files)
          current = static_cast<int>(n);
      }
    if (!m_files.empty() && current < 0)
    {
      current = static_cast<int>(m_sources.size());
      m_sources.push_back({nameOf(m_files), m_files, {}});
    }
  }
  for (const Source& one : m_sources)
    names += one.name;
  m_panel->setRecordings(names, current);
}

void ReplayController::choose(int row)
{
  if (!m_model.hasCase() || row < 0 || row >= static_cast<int>(m_sources.size()))
    return;
  const Source source = m_sources[static_cast<std::size_t>(row)];
  guarded(
      [&]
      {
        open(source.attachment.empty()
                 ? source.files
                 : Files{library::attachmentFile(
                       m_model.library(),
                       scene::findAttachment(m_model.value(), source.attachment))});
      },
      [this](const QString& why)
      {
        listRecordings();
        m_panel->say(sentence(capitalized(why)));
      });
}

void ReplayController::openFile()
{
  if (!m_model.hasCase())
    return;
  QFileDialog dialog(&m_window, tr("Open a recording"));
  dialog.setObjectName("openRecording");
  dialog.setFileMode(QFileDialog::ExistingFiles);
  dialog.setNameFilters({tr("Recordings (*.ticks)"), tr("All files (*)")});
  const auto usual = m_model.library().folder() / "recordings";
  std::error_code error;
  dialog.setDirectory(std::filesystem::is_directory(usual, error) ? QFile::decodeName(usual.c_str())
                                                                  : QDir::homePath());
  if (chosenFile(dialog).isEmpty() || !m_model.hasCase())
    return;
  Files files;
  for (const QString& file : dialog.selectedFiles())
    files.push_back(pathOf(file));
  std::sort(files.begin(), files.end()); // by name, hence by case and time
  Files inOrder;
  for (const Files& operation : presenters::inOperations(files))
    inOrder.insert(inOrder.end(), operation.begin(), operation.end());
  open(inOrder);
}

void ReplayController::open(const Files& files)
{
  emit panelWanted();
  read(files);
}

void ReplayController::read(Files files)
{
  close();
  m_files = files;
  listRecordings();
  m_waits = !m_model.ready() || m_model.drilling();
  if (m_waits)
    return m_panel->say(m_model.drilling()
                            ? tr("The recording is read when the drill is let go.")
                            : tr("The case is still being prepared; then the recording is read."));
  m_panel->say(tr("Reading the recording, and measuring what was drilled in it…"));
  m_work.replace(
      [this, files, value = m_model.value(),
       shownAs = m_model.shownAs()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto review = std::make_shared<presenters::OperationReview>(
            presenters::reviewOperation(files, value, progress));
        return [this, review, shownAs]
        {
          if (m_model.shownAs() != shownAs)
            return;
          m_review = std::move(*review);
          m_panel->say(m_review->course.empty()
                           ? tr("The recording is empty: the tool was never placed.")
                           : QString());
          m_panel->setReview(&*m_review);
          goTo(0.0);
        };
      });
}

void ReplayController::caseReady()
{
  const bool mayBeKnownNow = m_review && !m_review->whyUnmeasured.empty(); // prepared anew
  if ((m_waits || mayBeKnownNow) && m_model.hasCase() && m_model.ready() && !m_model.drilling())
    read(m_files);
}

void ReplayController::close()
{
  m_waits = false;
  m_work.abandon();
  play(false);
  m_panel->setReview(nullptr);
  m_panel->say({});
  m_review.reset();
  m_files.clear();
  m_time = 0.0;
  showGhost();
}

void ReplayController::togglePlay()
{
  if (!m_review || m_review->course.empty())
  {
    emit panelWanted();
    if (!m_work.busy() && !m_waits)
      emit statusMessage(tr("Choose a recording first, or open one (Drill > Open a recording…)"));
    return;
  }
  play(!playing());
}

void ReplayController::play(bool on)
{
  on = on && m_review && !m_review->course.empty();
  m_play.setIconText(on ? tr("Pause recording") : tr("Play recording"));
  if (!on)
    return m_frames.stop();
  constexpr double kSlider = 1e-3; // s; to which its end is rounded
  if (m_time >= m_review->metrics.duration - kSlider)
    goTo(0.0);
  m_sinceFrame.start();
  m_frames.start();
}

void ReplayController::frame()
{
  goTo(m_time + 0.001 * m_panel->speed() * static_cast<double>(m_sinceFrame.restart()));
  if (m_time >= m_review->metrics.duration)
    play(false);
}

void ReplayController::goTo(double seconds)
{
  if (!m_review)
    return;
  m_time = std::clamp(seconds, 0.0, m_review->metrics.duration);
  m_panel->setTime(m_time);
  showGhost();
}

void ReplayController::showGhost()
{
  std::optional<rendering::ToolPose> ghost;
  if (m_review && m_panel->showsGhost())
    if (const auto tool = presenters::toolAt(m_review->course, m_time))
    {
      ghost.emplace();
      ghost->center = tool->center;
      ghost->axisToHand = tool->axisToHand;
      ghost->radius = 0.5 * presenters::partAt(*m_review, m_time).review.burr.diameter;
      ghost->drilling = tool->drilling;
    }
  m_view.display().setGhost(ghost);
}

// Each frame of the tool in use, and when it was put away.
void ReplayController::toolMoved()
{
  const bool drills = m_model.drilling();
  if (!drills && m_waits)
    caseReady();
  if (drills && !m_wasDrilling && m_panel->startsWithDrill() && m_review && !playing())
  {
    goTo(0.0);
    play(true);
  }
  m_wasDrilling = drills;
}

void ReplayController::exportTable()
{
  if (!m_review)
    return;
  const presenters::OperationReview review = *m_review; // another one may be opened meanwhile
  const QString metrics = tr("Metrics (*.csv)");
  QFileDialog dialog(&m_window, tr("Export the recording"));
  dialog.setObjectName("exportRecording");
  dialog.setNameFilters({metrics, tr("Place and force over time (*.csv)")});
  dialog.setDefaultSuffix("csv");
  dialog.setDirectory(QDir::homePath());
  dialog.selectFile(QFileInfo(QFile::decodeName(m_files.front().c_str())).completeBaseName() +
                    ".csv");
  const std::filesystem::path file = askFile(dialog);
  if (file.empty())
    return;
  guarded(
      [&]
      {
        library::refuseOverwriting(file, m_model.library().folder());
        const bool isOne = review.parts.size() == 1;
        if (dialog.selectedNameFilter() == metrics)
          core::writeFile(file, isOne ? presenters::metricsCsv(review)
                                      : presenters::operationCsv(review));
        else
          core::writeFile(file, isOne ? presenters::courseCsv(review)
                                      : presenters::operationCourseCsv(review));
        emit statusMessage(tr("The table is in %1").arg(QFile::decodeName(file.c_str())));
      },
      [this](const QString& why) { m_panel->say(sentence(capitalized(why))); });
}

} // namespace petrous::workstation
