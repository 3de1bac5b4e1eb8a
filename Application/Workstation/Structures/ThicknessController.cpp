#include "ThicknessController.h"

#include <QAction>
#include <QApplication>

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
      &action, [this] { return !m_model.thicknessOver().empty(); },
      [this](bool on)
      {
        const QString chosen = m_panel.chosen();
        if (on && chosen.isEmpty())
          emit statusMessage(tr("Choose a structure in the list (F9) first"));
        showOver(on ? chosen : QString());
      });
  connect(&panel, &StructuresPanel::thicknessAsked, this, &ThicknessController::showOver);
  m_followLater.setSingleShot(true);
  m_followLater.setInterval(kFollowAfter);
  connect(&m_followLater, &QTimer::timeout, this, &ThicknessController::follow);
  connect(&panel, &StructuresPanel::selected, &m_followLater, qOverload<>(&QTimer::start));
}

// Bone and kinds have no thickness over them: the colours stay.
void ThicknessController::follow()
{
  const QString chosen = m_panel.chosen();
  const std::string& over = m_model.thicknessOver();
  if (!over.empty() && !chosen.isEmpty() && bytes(chosen) != over)
    showOver(chosen);
}

void ThicknessController::showOver(const QString& structure)
{
  const std::string wanted = bytes(structure);
  QApplication::setOverrideCursor(Qt::WaitCursor);
  QString why;
  try
  {
    m_model.showThickness(wanted == m_model.thicknessOver() ? std::string() : wanted);
  }
  catch (const core::Error& error)
  {
    why = toString(error);
  }
  catch (const std::exception&)
  {
    why = tr("The thickness cannot be measured: the computer has no room for it");
  }
  QApplication::restoreOverrideCursor();
  if (!why.isEmpty())
    emit statusMessage(why);
  bringUpToDate();
}

void ThicknessController::bringUpToDate()
{
  const QString over = words(m_model.thicknessOver()).replace('_', ' ');
  m_legend->setStructure(over,
                         m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr);
  m_bound.refresh();
}

void ThicknessController::caseChanged()
{
  bringUpToDate();
}

} // namespace petrous::workstation
