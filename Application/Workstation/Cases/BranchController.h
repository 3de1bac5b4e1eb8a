#pragma once

#include <functional>

#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

class QAction;
class QMenu;
class QWidget;

namespace petrous::workstation
{

/// Menu of the case's approaches: list, switch, begin one at the case's current state.
class BranchController : public QObject
{
  Q_OBJECT
public:
  /// `menu` is filled each time it is opened. `window` is the parent of dialogs.
  BranchController(presenters::WorkstationModel& model, QMenu& menu, QWidget& window);

  /// Called before the approach is left: ends an open stroke and puts the tool away.
  std::function<void()> settle;
  /// The camera of the picture, which the approach is left with; and how to show that of another.
  std::function<core::CameraPose()> camera;
  std::function<void(const core::CameraPose&)> showCamera;

  void stateChanged(); ///< strokes, approaches or the case changed

signals:
  void changed(); ///< the case is on another approach and unsaved
  void statusMessage(const QString& line);

private:
  void fill();
  void goTo(std::string name); // a copy: the history moves when the tool is put away
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
