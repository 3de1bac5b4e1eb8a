#pragma once

#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

class QAction;

namespace petrous::workstation
{

class StructuresPanel;
class ThicknessLegend;
class ThreeDView;

/// Has bone coloured by its thickness over the structure that is chosen in the panel, and no longer
/// when asked again.
class ThicknessController : public QObject
{
  Q_OBJECT
public:
  /// `action`: checkable; checked while the colours show.
  ThicknessController(presenters::WorkstationModel& model, ThreeDView& view, StructuresPanel& panel,
                      QAction& action);

  void caseChanged(); ///< another one has no colours yet

signals:
  void statusMessage(const QString& line);

private:
  void showOver(const QString& structure); // empty: none
  void bringUpToDate();

  presenters::WorkstationModel& m_model;
  StructuresPanel& m_panel;
  QAction& m_action;
  ThicknessLegend* m_legend;
};

} // namespace petrous::workstation
