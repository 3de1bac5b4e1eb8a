#pragma once

#include <QObject>

#include "Bind.h"
#include "petrous/Presenters/WorkstationModel.h"

class QAction;

namespace petrous::workstation
{

class StructuresPanel;
class ThicknessLegend;
class ThreeDView;

/// Toggles colouring bone by its thickness over the structure selected in the panel.
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
  void bringUpToDate();

  presenters::WorkstationModel& m_model;
  StructuresPanel& m_panel;
  ThicknessLegend* m_legend;
  Bindings m_bound;
};

} // namespace petrous::workstation
