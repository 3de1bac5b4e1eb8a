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
/// it follows the selection. The thickness is measured in a separate thread, the latest selection's
/// alone; meanwhile the colours are those of before, and asking again stops it.
class ThicknessController : public QObject
{
  Q_OBJECT
public:
  /// `action`: checkable; checked while the colours are shown.
  ThicknessController(presenters::WorkstationModel& model, ThreeDView& view, StructuresPanel& panel,
                      QAction& action);

  void caseChanged(); ///< another case has no colours yet
  /// WorkstationEvents::partRenamed; what is being measured is, under its new name, once
  /// `partsChanged` comes.
  void partRenamed(const std::string& from, const std::string& to);
  void partsChanged(); ///< measures anew what was being measured and is still there

signals:
  void statusMessage(const QString& line);

private:
  void showOver(const QString& structure); // empty: none
  void follow();
  void measure(const std::string& structure);
  void endMeasuring(const QString& why = {});
  void bringUpToDate();
  const std::string& over() const; // shown, or being measured

  presenters::WorkstationModel& m_model;
  StructuresPanel& m_panel;
  ThicknessLegend* m_legend;
  QTimer m_followLater;   // not for each row that is passed
  std::string m_measured; // the structure over which it is being measured; empty: none
  Bindings m_bound;
  BackgroundWork m_work;
};

} // namespace petrous::workstation
