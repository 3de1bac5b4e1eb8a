#pragma once

#include <memory>
#include <string>

#include <QList>
#include <QObject>
#include <QPointer>
#include <QTimer>

#include "BackgroundWork.h"
#include "petrous/Presenters/ApproachComparison.h"
#include "petrous/Presenters/WorkstationModel.h"

class QAction;

namespace petrous::workstation
{

class ComparisonWindow;
class SliceColumn;
class ThreeDView;

/// Compares two approaches in a separate thread, again whenever they change, and shows that in a
/// window of its own and, as colours, in the slices.
class ComparisonController : public QObject
{
  Q_OBJECT
public:
  ComparisonController(presenters::WorkstationModel& model, ThreeDView& view, SliceColumn& slices,
                       QWidget& window);
  ~ComparisonController() override;

  /// Of the main window, whose keys act in the window of the comparison, too.
  QList<QAction*> keys;

  void compare(const std::string& first, const std::string& second);
  void caseChanged();  ///< another case, other parts, or none: ends the comparison
  void stateChanged(); ///< strokes or approaches
  void close();

private:
  void start();
  void showInSlices();

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  SliceColumn& m_slices;
  QWidget& m_parent;
  QPointer<ComparisonWindow> m_window; // while it is open
  std::string m_first, m_second;
  std::uint64_t m_changes = 0; // of the dissection that is compared
  std::shared_ptr<const presenters::ApproachComparison> m_comparison;
  QTimer m_again;
  BackgroundWork m_work;
};

} // namespace petrous::workstation
