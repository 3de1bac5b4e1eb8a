#include "BranchController.h"

#include <QAction>
#include <QMenu>
#include <QMessageBox>

#include "Application.h"
#include "AskName.h"
#include "Commands.h"
#include "Theme.h"
#include "petrous/Scene/Branches.h"

namespace petrous::workstation
{

namespace
{

using Branch = dissection::History::Branch;

// "main: 3 strokes, 1738.7 mm³"; prefixed by `number` and its shortcut, up to 9.
QString lineOf(const scene::Case& value, const Branch& branch, int number)
{
  const auto summary = scene::summaryOf(value, branch.position);
  QString text = BranchController::tr("%1: %2 %3, %4 mm³")
                     .arg(words(branch.name))
                     .arg(summary.strokes)
                     .arg(summary.strokes == 1 ? BranchController::tr("stroke")
                                               : BranchController::tr("strokes"))
                     .arg(summary.removed, 0, 'f', 1);
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
{
  m_start->setShortcut(Qt::CTRL + Qt::Key_B);
  m_start->setStatusTip(tr("Drill another way from the present state; the present one stays"));
  m_next->setShortcut(Qt::CTRL + Qt::Key_PageDown);
  m_previous->setShortcut(Qt::CTRL + Qt::Key_PageUp);
  menu.addSeparator();
  connect(m_start, &QAction::triggered, this, &BranchController::start);
  connect(m_next, &QAction::triggered, this, [this] { goOn(1); });
  connect(m_previous, &QAction::triggered, this, [this] { goOn(-1); });
  connect(&menu, &QMenu::aboutToShow, this, &BranchController::fill);
  stateChanged();
}

void BranchController::stateChanged()
{
  const bool open = m_model.hasCase();
  enable(*m_start, open, tr("Open a case first"));
  const bool several = open && m_model.value().dissection.history().branches().size() > 1;
  const QString why = open ? tr("The case has one approach only") : tr("Open a case first");
  enable(*m_next, several, why);
  enable(*m_previous, several, why);
}

void BranchController::fill()
{
  const QList<QAction*> actions = m_menu.actions();
  for (int n = actions.indexOf(m_previous) + 2; n < actions.size(); ++n)
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

void BranchController::goTo(std::string name)
{
  if (!m_model.hasCase() || name == m_model.value().dissection.history().branch().name)
    return;
  if (change([this, &name] { m_model.goToBranch(name); }))
    emit statusMessage(
        tr("Approach %1")
            .arg(lineOf(m_model.value(), m_model.value().dissection.history().branch(), 10)));
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
  const std::string chosen = bytes(askName(
      m_window, tr("New approach"),
      tr("Name of the approach that begins here, after %1 strokes:").arg(m_model.value().applied()),
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
    emit statusMessage(tr("On the new approach %1").arg(words(chosen)));
}

bool BranchController::change(const std::function<void()>& what)
{
  if (settle)
    settle();
  try
  {
    if (camera)
      m_model.setCamera(camera());
    what();
    if (showCamera && m_model.value().camera)
      showCamera(*m_model.value().camera);
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
