#include "Commands.h"

#include <set>

#include <QAction>
#include <QDockWidget>
#include <QKeySequence>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QObject>
#include <QRegularExpression>
#include <QStringList>
#include <QVariant>

#include "Theme.h"

namespace petrous::workstation
{

namespace
{

constexpr char kWhyNot[] = "whyNot";

// Without the marks of mnemonics.
QString withoutMnemonics(const QString& text)
{
  static const QRegularExpression mark("&(.)");
  return QString(text).replace(mark, "\\1");
}

QString keysOf(const QAction& action)
{
  QStringList keys;
  for (const QKeySequence& one : action.shortcuts())
    keys += one.toString(QKeySequence::NativeText);
  keys.removeAll(QString());
  return keys.join(QObject::tr(" or "));
}

// The panel, dialog or view whose action it is.
QString placeOf(const QAction& action)
{
  for (const QObject* above = action.parent(); above; above = above->parent())
    if (const auto* dock = qobject_cast<const QDockWidget*>(above))
      return dock->windowTitle();
  return QObject::tr("Views");
}

class Collector
{
public:
  explicit Collector(bool hasCase)
    : m_hasCase(hasCase)
  {
  }

  void addMenu(QMenu& menu, const QString& path, const QString& whyNot)
  {
    emit menu.aboutToShow();
    for (QAction* action : menu.actions())
    {
      if (!action->isVisible() || action->isSeparator())
        continue;
      if (QMenu* inside = action->menu())
      {
        m_taken.insert(action);
        addMenu(*inside, path + QString::fromUtf8(" › ") + withoutMnemonics(action->text()),
                action->isEnabled() ? whyNot : reasonOfMenu(*action));
      }
      else
        add(*action, path, whyNot);
    }
  }

  void addRest(const QMainWindow& window)
  {
    for (QAction* action : window.findChildren<QAction*>())
      if (!action->shortcut().isEmpty() && !action->text().isEmpty() && !action->menu() &&
          action->isVisible())
        add(*action, placeOf(*action), {});
  }

  // Of a menu: never empty, as nothing in it can be done.
  QString reasonOfMenu(const QAction& action) const
  {
    const QString why = reasonOf(action);
    return why.isEmpty() ? QObject::tr("The menu is not available") : why;
  }

  std::vector<Command> commands;

private:
  QString reasonOf(const QAction& action) const
  {
    const QString why = action.property(kWhyNot).toString();
    return !why.isEmpty() || m_hasCase ? why : QObject::tr("Open a case first");
  }

  /// `whyNot`: of a menu that is disabled.
  void add(QAction& action, const QString& menu, const QString& whyNot)
  {
    if (!m_taken.insert(&action).second)
      return;
    Command command;
    command.action = &action;
    command.name = withoutMnemonics(action.text());
    command.menu = menu;
    command.keys = keysOf(action);
    command.tip = action.statusTip();
    if (command.tip.isEmpty() && action.toolTip() != command.name)
      command.tip = action.toolTip();
    command.isEnabled = action.isEnabled() && whyNot.isEmpty();
    if (!command.isEnabled)
      command.whyNot = whyNot.isEmpty() ? reasonOf(action) : whyNot;
    commands.push_back(command);
  }

  bool m_hasCase;
  std::set<const QAction*> m_taken;
};

} // namespace

void enable(QAction& action, bool on, const QString& whyNot)
{
  action.setEnabled(on);
  action.setProperty(kWhyNot, on ? QVariant() : QVariant(whyNot));
}

std::vector<Command> commandsOf(const QMainWindow& window, bool hasCase)
{
  Collector collector(hasCase);
  if (const auto* bar = qobject_cast<QMenuBar*>(window.menuWidget()))
    for (QAction* top : bar->actions())
      if (QMenu* menu = top->menu(); menu && top->isVisible())
        collector.addMenu(*menu, withoutMnemonics(top->text()),
                          top->isEnabled() ? QString() : collector.reasonOfMenu(*top));
  collector.addRest(window);
  return collector.commands;
}

std::vector<presenters::CommandEntry> entriesOf(const std::vector<Command>& commands)
{
  std::vector<presenters::CommandEntry> entries;
  for (const Command& command : commands)
    entries.push_back({bytes(command.name), bytes(command.menu), bytes(command.tip)});
  return entries;
}

} // namespace petrous::workstation
