#pragma once

#include <functional>

#include <QObject>
#include <QTimer>

#include "petrous/Presenters/WorkstationModel.h"

class QAction;
class QMenu;
class QWidget;

namespace petrous::workstation
{

/// The case's approaches: list, switch, go to any of their states, begin one at the present state,
/// rename, delete, compare. Fills their menu.
class BranchController : public QObject
{
  Q_OBJECT
public:
  /// `menu` is filled each time it is opened. `window` is the parent of dialogs.
  BranchController(presenters::WorkstationModel& model, QMenu& menu, QWidget& window);

  /// Called before the approach is left: ends an open stroke and puts the tool away; whether one
  /// was in the hand.
  std::function<bool()> settle;

  void caseChanged();  ///< or closed
  void stateChanged(); ///< strokes or approaches changed

  void goTo(std::string name); ///< in the state in which it was left
  void goToState(std::string name, std::size_t state);
  void start();                         ///< asks for a name
  void rename(const std::string& name); ///< likewise
  void remove(const std::string& name); ///< of the present one the case goes to another first
  /// Of the present one with this one; if they are the same, with the one that was left last.
  void compare(const std::string& with);

signals:
  void changed(); ///< the case is on another approach or state and unsaved
  void comparisonAsked(const std::string& first, const std::string& second);
  void statusMessage(const QString& line);

private:
  void follow();
  void fill();
  void fillComparisons();
  void goOn(int steps);
  bool change(const std::function<void()>& what);
  void say(const QString& text);

  presenters::WorkstationModel& m_model;
  QMenu& m_menu;
  QWidget& m_window;
  QAction* m_start;
  QAction* m_next;
  QAction* m_previous;
  QAction* m_compare;
  QMenu* m_others; // to compare with
  QAction* m_rename;
  QAction* m_remove;
  std::string m_present;    // approach
  std::string m_left;       // the one that was left last
  QTimer m_changed;         // states that are passed are not saved
  bool m_isPutAway = false; // the tool, by the last change
};

} // namespace petrous::workstation
