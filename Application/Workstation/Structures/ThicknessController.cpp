#include "ThicknessController.h"

#include <utility>

#include <QAction>

#include "Application.h"
#include "StructuresPanel.h"
#include "Theme.h"
#include "ThicknessLegend.h"
#include "ThreeDView.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
constexpr int kFollowAfter = 250; // ms
} // namespace

ThicknessController::ThicknessController(presenters::WorkstationModel& model, ThreeDView& view,
                                         StructuresPanel& panel, QAction& action)
  : QObject(&view)
  , m_model(model)
  , m_panel(panel)
  , m_legend(new ThicknessLegend(view))
{
  m_bound.add(
      &action, [this] { return !over().empty(); },
      [this](bool on)
      {
        const QString chosen = m_panel.chosen();
        if (on && chosen.isEmpty())
          emit statusMessage(tr("Choose a structure in the list (F9) first"));
        showOver(on ? chosen : QString());
      });
  connect(&panel, &StructuresPanel::thicknessAsked, this, &ThicknessController::showOver);
  connect(&m_work, &BackgroundWork::progressed, this,
          [this](double fraction, const QString&, const QString& left)
          {
            emit statusMessage(
                withTimeLeft(tr("The bone over %1 is being measured: %2 % (F6 stops it)")
                                 .arg(shownName(m_measured))
                                 .arg(numberText(100.0 * fraction, 0)),
                             left));
          });
  m_followLater.setSingleShot(true);
  m_followLater.setInterval(kFollowAfter);
  connect(&m_followLater, &QTimer::timeout, this, &ThicknessController::follow);
  connect(&m_work, &BackgroundWork::progressed, m_legend, &ThicknessLegend::setProgress);
  connect(&m_work, &BackgroundWork::failed, this, &ThicknessController::endMeasuring);
  connect(&panel, &StructuresPanel::selected, &m_followLater, qOverload<>(&QTimer::start));
}

const std::string& ThicknessController::over() const
{
  return m_measured.empty() ? m_model.thicknessOver() : m_measured;
}

// Bone and kinds have no thickness over them: the colours stay.
void ThicknessController::follow()
{
  const QString chosen = m_panel.chosen();
  if (!over().empty() && !chosen.isEmpty() && bytes(chosen) != over())
    showOver(chosen);
}

// Asked again for the same one, it ends.
void ThicknessController::showOver(const QString& structure)
{
  const std::string wanted = bytes(structure);
  const bool isMeasuring = !m_measured.empty();
  m_work.abandon();
  if (isMeasuring && (wanted.empty() || wanted == m_measured))
  {
    emit statusMessage(tr("Measuring the thickness was stopped"));
    if (wanted.empty() && !m_model.thicknessOver().empty())
      m_model.showThickness(std::string());
    return endMeasuring();
  }
  if (!wanted.empty() && wanted != m_model.thicknessOver())
    return measure(wanted);
  if (!m_model.thicknessOver().empty())
    m_model.showThickness(std::string());
  endMeasuring();
}

void ThicknessController::measure(const std::string& structure)
{
  if (!m_model.hasCase()) // a menu may be open while a case is closed
    return endMeasuring();
  try
  {
    m_measured = structure;
    m_work.replace(
        [this, work = m_model.thicknessMeasurement(structure)](
            const core::Progress& progress) mutable -> BackgroundWork::Reply
        {
          return [this, measured = work(progress)]
          {
            emit statusMessage({});
            m_model.showThickness(measured);
            endMeasuring();
          };
        });
    m_legend->setProgress(0.0);
    bringUpToDate();
  }
  catch (const std::exception& error)
  {
    endMeasuring(toString(error));
  }
}

void ThicknessController::endMeasuring(const QString& why)
{
  m_measured.clear();
  if (!why.isEmpty())
    emit statusMessage(why);
  bringUpToDate();
}

void ThicknessController::bringUpToDate()
{
  if (m_measured.empty())
    m_legend->setProgress(1.0);
  m_legend->setStructure(shownName(over()),
                         m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr);
  m_bound.refresh();
}

void ThicknessController::caseChanged()
{
  m_work.abandon();
  m_measured.clear();
  bringUpToDate();
}

void ThicknessController::partRenamed(const std::string& from, const std::string& to)
{
  if (m_measured == from)
    m_measured = to;
}

void ThicknessController::partsChanged()
{
  const std::string measured = m_measured;
  caseChanged();
  if (m_model.lookOf(measured))
    measure(measured);
}

} // namespace petrous::workstation
