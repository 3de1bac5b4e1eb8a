#include "BranchController.h"

#include <QAction>
#include <QMenu>
#include <QMessageBox>

#include "Application.h"
#include "AskName.h"
#include "Commands.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Scene/Branches.h"

namespace petrous::workstation
{

namespace
{

using Branch = dissection::History::Branch;

constexpr int kSaveAfter = 1000; // ms

// "main: 3 strokes, 1738.7 mm³"; prefixed by `number` and its shortcut, up to 9.
QString lineOf(const scene::Case& value, const Branch& branch, int number)
{
  const auto summary = scene::summaryOf(value, branch.position);
  QString text = BranchController::tr("%1: %2 %3, %4 mm³")
                     .arg(approachName(branch.name))
                     .arg(summary.strokes)
                     .arg(summary.strokes == 1 ? BranchController::tr("stroke")
                                               : BranchController::tr("strokes"))
                     .arg(numberText(summary.removed, 1));
  if (branch.setAside)
    text += BranchController::tr(" (set aside)");
  text.replace('&', "&&");
  return number <= 9 ? QString("&%1  %2").arg(number).arg(text) : text;
}

} // namespace

BranchController::BranchController(presenters::WorkstationModel& model, QMenu& menu,
                                   QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_menu(menu)
  , m_window(window)
  , m_start(menu.addAction(tr("&New approach from here…")))
  , m_next(menu.addAction(tr("Ne&xt approach")))
  , m_previous(menu.addAction(tr("&Previous approach")))
  , m_compare(menu.addAction(tr("&Compare")))
  , m_others(menu.addMenu(tr("C&ompare with")))
  , m_rename(menu.addAction(tr("&Rename the approach…")))
  , m_remove(menu.addAction(tr("&Delete the approach")))
{
  m_start->setShortcut(Qt::CTRL + Qt::Key_B);
  m_start->setStatusTip(tr("Drill another way from the present state; the present one stays"));
  m_next->setShortcut(Qt::CTRL + Qt::Key_PageDown);
  m_previous->setShortcut(Qt::CTRL + Qt::Key_PageUp);
  m_compare->setShortcut(Qt::CTRL + Qt::Key_D);
  m_compare->setStatusTip(tr("The present approach and the one that was left last, side by side "
                             "and as difference"));
  m_remove->setStatusTip(tr("Takes the present approach out of the case; Undo brings it back"));
  menu.addSeparator();
  m_changed.setSingleShot(true);
  m_changed.setInterval(kSaveAfter);
  connect(&m_changed, &QTimer::timeout, this, &BranchController::changed);
  const auto present = [this] {
    return m_model.hasCase() ? m_model.value().dissection.history().branch().name : std::string();
  };
  connect(m_compare, &QAction::triggered, this, [this, present] { compare(present()); });
  connect(m_others, &QMenu::aboutToShow, this, &BranchController::fillComparisons);
  connect(m_rename, &QAction::triggered, this, [this, present] { rename(present()); });
  connect(m_remove, &QAction::triggered, this, [this, present] { remove(present()); });
  connect(m_start, &QAction::triggered, this, &BranchController::start);
  connect(m_next, &QAction::triggered, this, [this] { goOn(1); });
  connect(m_previous, &QAction::triggered, this, [this] { goOn(-1); });
  connect(&menu, &QMenu::aboutToShow, this, &BranchController::fill);
  stateChanged();
}

void BranchController::caseChanged()
{
  m_present.clear();
  m_left.clear();
  follow();
}

// Also by undo and redo. An approach that is not there any more was renamed or deleted.
void BranchController::follow()
{
  const std::string present =
      m_model.hasCase() ? m_model.value().dissection.history().branch().name : std::string();
  if (present == m_present)
    return;
  if (m_model.hasCase() && m_model.value().dissection.history().find(m_present))
    m_left = m_present;
  m_present = present;
}

void BranchController::stateChanged()
{
  follow();
  const bool open = m_model.hasCase();
  enable(*m_start, open, tr("Open a case first"));
  const bool several = open && m_model.value().dissection.history().branches().size() > 1;
  const QString why = open ? tr("The case has one approach only") : tr("Open a case first");
  enable(*m_next, several, why);
  enable(*m_previous, several, why);
  enable(*m_compare, several, why);
  enable(*m_others->menuAction(), several, why);
  enable(*m_remove, several, why);
  enable(*m_rename, open, tr("Open a case first"));
}

void BranchController::fill()
{
  const QList<QAction*> actions = m_menu.actions();
  for (int n = actions.indexOf(m_remove) + 2; n < actions.size(); ++n)
    delete actions[n];
  if (!m_model.hasCase())
    return;
  const scene::Case& value = m_model.value();
  int number = 0;
  for (const Branch& branch : value.dissection.history().branches())
  {
    QAction* action = m_menu.addAction(lineOf(value, branch, ++number));
    action->setCheckable(true);
    action->setChecked(&branch == &value.dissection.history().branch());
    connect(action, &QAction::triggered, this, [this, name = branch.name] { goTo(name); });
  }
}

void BranchController::fillComparisons()
{
  m_others->clear();
  if (!m_model.hasCase())
    return;
  const scene::Case& value = m_model.value();
  for (const Branch& branch : value.dissection.history().branches())
    if (&branch != &value.dissection.history().branch())
      connect(m_others->addAction(lineOf(value, branch, 10)), &QAction::triggered, this,
              [this, name = branch.name] { compare(name); });
}

// A copy of the name: the history moves when the tool is put away.
void BranchController::goTo(std::string name)
{
  if (!m_model.hasCase() || name == m_model.value().dissection.history().branch().name)
    return;
  if (change([this, &name] { m_model.goToBranch(name); }))
    say(tr("Approach %1")
            .arg(lineOf(m_model.value(), m_model.value().dissection.history().branch(), 10)));
}

void BranchController::goToState(std::string name, std::size_t state)
{
  if (!m_model.hasCase())
    return;
  const dissection::History& history = m_model.value().dissection.history();
  const bool isPresent = name == history.branch().name;
  if (isPresent && state == history.position())
    return;
  const auto go = [this, &name, state] { m_model.goToState(name, state); };
  if (!isPresent)
  {
    if (!change(go))
      return;
  }
  else
    try
    {
      m_isPutAway = settle && settle();
      go();
      m_changed.start();
    }
    catch (const std::exception& fault) // a damaged stroke
    {
      return emit statusMessage(toString(fault));
    }
  say(tr("Approach %1, strokes drilled: %2 of %3")
          .arg(approachName(name))
          .arg(history.applied())
          .arg(history.applied() + history.ahead()));
}

void BranchController::goOn(int steps)
{
  if (!m_model.hasCase())
    return;
  const auto& history = m_model.value().dissection.history();
  const auto& branches = history.branches();
  const int count = static_cast<int>(branches.size());
  const int present = static_cast<int>(&history.branch() - branches.data());
  goTo(branches[static_cast<std::size_t>((present + steps + count) % count)].name);
}

void BranchController::start()
{
  if (!m_model.hasCase())
    return;
  const std::string chosen =
      bytes(askName(m_window, tr("New approach"),
                    m_model.value().applied() == 1
                        ? tr("Name of the approach that begins here, after one stroke:")
                        : tr("Name of the approach that begins here, after %1 strokes:")
                              .arg(m_model.value().applied()),
                    {},
                    [this](const std::string& name)
                    {
                      scene::checkBranchName(name);
                      if (m_model.hasCase() && m_model.value().dissection.history().find(name))
                        throw core::InvalidParameter("there is an approach '" + name +
                                                     "' already; take another name");
                    }));
  if (!chosen.empty() && m_model.hasCase() &&
      change([this, &chosen] { m_model.startBranch(chosen); }))
    say(tr("On the new approach %1").arg(approachName(chosen)));
}

void BranchController::rename(const std::string& name)
{
  if (!m_model.hasCase() || !m_model.value().dissection.history().find(name))
    return;
  const std::string to =
      bytes(askName(m_window, tr("Rename the approach"),
                    tr("New name of “%1”:").arg(approachName(name)), words(name),
                    [this, &name](const std::string& wanted)
                    {
                      scene::checkBranchName(wanted);
                      if (wanted != name && m_model.hasCase() &&
                          m_model.value().dissection.history().find(wanted))
                        throw core::InvalidParameter("there is an approach '" + wanted +
                                                     "' already; take another name");
                    }));
  if (!to.empty() && to != name && m_model.hasCase() &&
      change([this, &name, &to] { m_model.renameBranch(name, to); }))
    emit statusMessage(tr("“%1” is now “%2”").arg(approachName(name), approachName(to)));
}

void BranchController::remove(const std::string& name)
{
  if (!m_model.hasCase())
    return;
  const dissection::History& history = m_model.value().dissection.history();
  if (history.branches().size() < 2 || !history.find(name))
    return;
  const std::string next = name != history.branch().name            ? std::string()
                           : m_left != name && history.find(m_left) ? m_left
                           : history.branches().front().name != name
                               ? history.branches().front().name
                               : history.branches()[1].name;
  const std::string gone = name;
  if (change(
          [&]
          {
            if (!next.empty())
              m_model.goToBranch(next);
            m_model.removeBranch(gone);
          }))
    emit statusMessage(
        tr("The approach “%1” is deleted; Undo brings it back").arg(approachName(gone)));
}

void BranchController::compare(const std::string& with)
{
  if (!m_model.hasCase())
    return;
  if (m_model.drilling() && settle)
    settle(); // an open stroke is in no state yet
  const dissection::History& history = m_model.value().dissection.history();
  const auto& branches = history.branches();
  if (branches.size() < 2)
    return;
  const std::string present = history.branch().name;
  std::string other = with;
  if (other == present || !history.find(other))
    other = m_left;
  if (other == present || !history.find(other))
    other = branches.front().name != present ? branches.front().name : branches[1].name;
  emit comparisonAsked(present, other);
}

// With what became of the tool, which a press would otherwise not find in the hand.
void BranchController::say(const QString& text)
{
  emit statusMessage(m_isPutAway ? tr("%1; the tool was put away").arg(text) : text);
  m_isPutAway = false;
}

bool BranchController::change(const std::function<void()>& what)
{
  m_isPutAway = settle && settle();
  try
  {
    what();
  }
  catch (const std::exception& fault)
  {
    QMessageBox::warning(&m_window, tr("Approach"), toString(fault));
    return false;
  }
  emit changed();
  return true;
}

} // namespace petrous::workstation
