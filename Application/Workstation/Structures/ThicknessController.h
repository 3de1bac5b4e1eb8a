#pragma once

#include <QObject>
#include <QTimer>

#include "BackgroundWork.h"
#include "Bind.h"
#include "petrous/Presenters/WorkstationModel.h"

class QAction;

namespace petrous::workstation
{

class StructuresPanel;
class ThicknessLegend;
class ThreeDView;

/// Toggles colouring bone by its thickness over the structure selected in the panel; while it is on
/// it follows the selection. It is measured in the background.
class ThicknessController : public QObject
{
  Q_OBJECT
public:
  /// `action`: checkable; checked while the colours are shown.
  ThicknessController(presenters::WorkstationModel& model, ThreeDView& view, StructuresPanel& panel,
                      QAction& action);

  void caseChanged(); ///< another case has no colours yet

signals:
  void statusMessage(const QString& line);

private:
  void showOver(const QString& structure); // empty: none
  void follow();
  void bringUpToDate();
  const std::string& over() const; // shown, or being measured

  presenters::WorkstationModel& m_model;
  StructuresPanel& m_panel;
  ThicknessLegend* m_legend;
  QTimer m_followLater; // measuring takes about a second: not for each row that is passed
  BackgroundWork m_work;
  std::string m_measured; // by m_work; empty: nothing
  Bindings m_bound;
};

} // namespace petrous::workstation
