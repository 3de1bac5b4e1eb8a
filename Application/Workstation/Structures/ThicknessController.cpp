#include "ThicknessController.h"

#include <QAction>

#include "Application.h"
#include "StructuresPanel.h"
#include "Theme.h"
#include "ThicknessLegend.h"
#include "ThreeDView.h"

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
  connect(&m_work, &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            m_measured.clear();
            emit statusMessage(why);
            bringUpToDate();
          });
  connect(&m_work, &BackgroundWork::progressed, this,
          [this](double fraction, const QString&)
          {
            emit statusMessage(tr("The bone over %1 is being measured: %2 % (F6 stops it)")
                                   .arg(words(m_measured).replace('_', ' '))
                                   .arg(100.0 * fraction, 0, 'f', 0));
          });
  m_followLater.setSingleShot(true);
  m_followLater.setInterval(kFollowAfter);
  connect(&m_followLater, &QTimer::timeout, this, &ThicknessController::follow);
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

void ThicknessController::showOver(const QString& structure)
{
  const std::string wanted = bytes(structure);
  const bool isOff = wanted == over();
  m_work.abandon();
  m_measured.clear();
  try
  {
    if (wanted.empty() || isOff || wanted == m_model.thicknessOver())
      m_model.showThickness(isOff ? std::string() : wanted);
    else
    {
      m_work.replace(
          [this, measure = m_model.thicknessMeasurement(wanted)](
              const core::Progress& progress) mutable -> BackgroundWork::Reply
          {
            return [this, measured = measure(progress)]
            {
              m_measured.clear();
              emit statusMessage({});
              m_model.showThickness(measured);
              bringUpToDate();
            };
          });
      m_measured = wanted;
    }
  }
  catch (const std::exception& error)
  {
    emit statusMessage(toString(error));
  }
  bringUpToDate();
}

void ThicknessController::bringUpToDate()
{
  const QString shown = words(m_model.thicknessOver()).replace('_', ' ');
  m_legend->setStructure(shown,
                         m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr);
  m_bound.refresh();
}

void ThicknessController::caseChanged()
{
  m_work.abandon();
  m_measured.clear();
  bringUpToDate();
}

} // namespace petrous::workstation
