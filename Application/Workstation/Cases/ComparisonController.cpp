#include "ComparisonController.h"

#include "Application.h"
#include "ComparisonWindow.h"
#include "SliceColumn.h"
#include "Theme.h"
#include "ThreeDView.h"

namespace petrous::workstation
{

namespace
{
constexpr int kAgainAfter = 500; // ms; not for each state that is passed
} // namespace

ComparisonController::ComparisonController(presenters::WorkstationModel& model, ThreeDView& view,
                                           SliceColumn& slices, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_view(view)
  , m_slices(slices)
  , m_parent(window)
{
  m_again.setSingleShot(true);
  m_again.setInterval(kAgainAfter);
  connect(&m_again, &QTimer::timeout, this, &ComparisonController::start);
  connect(&m_work, &BackgroundWork::progressed, this,
          [this](double fraction, const QString&, const QString& left)
          {
            if (m_window)
              m_window->setProgress(fraction, left);
          });
  connect(&m_work, &BackgroundWork::cancelled, this,
          [this]
          {
            if (m_window)
              m_window->stop();
          });
  connect(&m_work, &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            if (m_window)
              m_window->fail(why);
          });
}

ComparisonController::~ComparisonController()
{
  delete m_window;
}

void ComparisonController::compare(const std::string& first, const std::string& second)
{
  if (!m_model.hasCase())
    return;
  m_first = first;
  m_second = second;
  if (!m_window)
  {
    m_window = new ComparisonWindow(&m_parent);
    m_window->setAttribute(Qt::WA_DeleteOnClose);
    m_window->addActions(keys);
    m_window->setStamp(m_view.stamp());
    m_window->setCamera(m_view.picture().camera());
    connect(m_window, &ComparisonWindow::approachesChosen, this,
            [this](const QString& one, const QString& other)
            { compare(bytes(one), bytes(other)); });
    connect(m_window, &ComparisonWindow::cancelAsked, &m_work, &BackgroundWork::cancel);
    connect(m_window, &ComparisonWindow::againAsked, this, &ComparisonController::start);
    connect(m_window, &ComparisonWindow::differenceToggled, this,
            &ComparisonController::showInSlices);
    connect(m_window, &ComparisonWindow::closed, this,
            [this]
            {
              m_window = nullptr; // deleted by itself
              close();
            });
  }
  m_window->show();
  m_window->raise();
  m_window->activateWindow();
  start();
}

void ComparisonController::start()
{
  if (!m_window || !m_model.hasCase())
    return;
  const dissection::Dissection& work = m_model.value().dissection;
  m_changes = work.changes();
  const dissection::History& history = work.history();
  if (!history.find(m_first) || !history.find(m_second))
    return close();
  std::vector<std::string> names;
  for (const auto& branch : history.branches())
    names.push_back(branch.name);
  m_window->setApproaches(names, {m_first, m_second});
  m_window->setProgress(0.0, {});
  m_work.replace(
      [this, value = scene::Case(m_model.value()), first = m_first,
       second = m_second](const core::Progress& progress) -> BackgroundWork::Reply
      {
        auto comparison = std::make_shared<const presenters::ApproachComparison>(
            presenters::compareApproaches(value, first, second, progress));
        return [this, comparison]
        {
          m_comparison = comparison;
          guarded(
              [&]
              {
                if (m_window && m_model.hasCase())
                  m_window->setComparison(m_model.sceneContents(), comparison);
              },
              [this](const QString& why) { m_window->fail(why); });
          showInSlices();
        };
      });
}

void ComparisonController::showInSlices()
{
  const bool isShown = m_window && m_window->showsDifference();
  m_slices.setDifference(isShown ? presenters::differenceLayer(m_comparison) : nullptr);
}

void ComparisonController::caseChanged()
{
  close();
}

void ComparisonController::stateChanged()
{
  if (!m_window)
    return;
  if (!m_model.hasCase())
    return close();
  if (m_model.value().dissection.changes() != m_changes && !m_model.drilling())
    m_again.start();
}

void ComparisonController::close()
{
  m_again.stop();
  m_work.abandon();
  m_comparison = nullptr;
  if (ComparisonWindow* window = m_window)
  {
    m_window = nullptr;
    window->close();
  }
  m_slices.setDifference(nullptr);
}

} // namespace petrous::workstation
