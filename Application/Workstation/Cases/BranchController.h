#pragma once

#include <functional>

#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

class QAction;
class QMenu;
class QWidget;

namespace petrous::workstation
{

/// The case's approaches in a menu: which there are, go to one, begin one where the case stands.
class BranchController : public QObject
{
  Q_OBJECT
public:
  /// `menu` is filled each time it is opened. `window` is the parent of dialogs.
  BranchController(presenters::WorkstationModel& model, QMenu& menu, QWidget& window);

  /// Asked before the approach is left: ends an open stroke and lays down the tool.
  std::function<void()> settle;

  void stateChanged(); ///< strokes or approaches, or another case

signals:
  void changed(); ///< the case is on another approach and is not saved
  void statusMessage(const QString& line);

private:
  void fill();
  void goTo(const std::string& name);
  void goOn(int steps);
  void start();
  bool change(const std::function<void()>& what);

  presenters::WorkstationModel& m_model;
  QMenu& m_menu;
  QWidget& m_window;
  QAction* m_start;
  QAction* m_next;
  QAction* m_previous;
};

} // namespace petrous::workstation
