#include "Commands.h"

#include <set>

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QHash>
#include <QKeySequence>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QObject>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSlider>
#include <QStringList>
#include <QTimer>
#include <QToolBar>
#include <QVariant>

#include "FoldBox.h"
#include "MenuAction.h"
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

QString reasonOf(const QAction& action, bool hasCase)
{
  const QString why = action.property(kWhyNot).toString();
  return !why.isEmpty() || hasCase ? why : QObject::tr("Open a case first");
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
    const QString why = reasonOf(action, m_hasCase);
    return why.isEmpty() ? QObject::tr("The menu is not available") : why;
  }

  std::vector<Command> commands;

private:
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
      command.whyNot = whyNot.isEmpty() ? reasonOf(action, m_hasCase) : whyNot;
    commands.push_back(command);
  }

  bool m_hasCase;
  std::set<const QAction*> m_taken;
};

bool isSetting(const QWidget& widget)
{
  return qobject_cast<const QCheckBox*>(&widget) || qobject_cast<const QSlider*>(&widget) ||
         qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QComboBox*>(&widget);
}

/// The settings of one panel or tool bar.
class SettingCollector
{
public:
  SettingCollector(const QWidget& place, const QString& title, const QString& whyNot)
    : m_place(place)
    , m_title(title)
    , m_whyNot(whyNot)
  {
    for (const QLabel* label : place.findChildren<QLabel*>())
      if (const QWidget* buddy = label->buddy())
        m_labels[buddy] = label->text();
  }

  void addTo(std::vector<Command>& commands) const
  {
    for (QWidget* control : m_place.findChildren<QWidget*>())
      if (isSetting(*control) && control->window() == m_place.window())
        add(*control, commands);
  }

private:
  void add(QWidget& control, std::vector<Command>& commands) const
  {
    Command command;
    command.name = nameOf(control);
    command.menu = m_title;
    if (command.name.isEmpty() || !find(control, command.menu))
      return;
    command.control = &control;
    command.tip = control.toolTip();
    command.isEnabled = m_whyNot.isEmpty() && control.isEnabled();
    command.whyNot = m_whyNot;
    for (const QWidget* widget = &control;
         !command.isEnabled && command.whyNot.isEmpty() && widget != &m_place;
         widget = widget->parentWidget()) // or a group that is disabled
      command.whyNot = widget->property(kWhyNot).toString();
    commands.push_back(command);
  }

  QString nameOf(const QWidget& control) const
  {
    QString name;
    if (const auto* box = qobject_cast<const QCheckBox*>(&control))
      name = box->text();
    if (name.isEmpty())
      name = m_labels.value(&control);
    name = withoutMnemonics(name);
    if (name.isEmpty())
      name = control.accessibleName();
    static const QRegularExpression beyond("[:;,.(\n].*$",
                                           QRegularExpression::DotMatchesEverythingOption);
    if (name.isEmpty())
      name = control.toolTip().remove(beyond);
    return name.endsWith(':') ? name.chopped(1) : name;
  }

  /// Whether its panel would show it, perhaps once a section is unfolded, which then is in `path`.
  bool find(const QWidget& control, QString& path) const
  {
    QStringList sections;
    for (const QWidget* widget = &control; widget != &m_place; widget = widget->parentWidget())
    {
      const QWidget* above = widget->parentWidget();
      const auto* section = qobject_cast<const FoldBox*>(above);
      if ((widget->isHidden() && !section) || qobject_cast<const QAbstractItemView*>(above))
        return false;
      if (section)
        sections.prepend(withoutMnemonics(section->title()));
    }
    sections.prepend(path);
    path = sections.join(QString::fromUtf8(" › "));
    return true;
  }

  const QWidget& m_place;
  QString m_title;
  QString m_whyNot; ///< of all; empty: they are available
  QHash<const QWidget*, QString> m_labels;
};

template <class Above>
Above* findAbove(QWidget& widget)
{
  for (QWidget* above = widget.parentWidget(); above; above = above->parentWidget())
    if (auto* found = qobject_cast<Above*>(above))
      return found;
  return nullptr;
}

} // namespace

void enable(QAction& action, bool on, const QString& whyNot)
{
  action.setEnabled(on);
  action.setProperty(kWhyNot, on ? QVariant() : QVariant(whyNot));
}

void enable(QWidget& control, bool on, const QString& whyNot)
{
  control.setEnabled(on);
  control.setProperty(kWhyNot, on ? QVariant() : QVariant(whyNot));
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

std::vector<Command> settingsOf(const QMainWindow& window, bool hasCase)
{
  std::vector<Command> settings;
  for (const QToolBar* bar : window.findChildren<QToolBar*>(QString(), Qt::FindDirectChildrenOnly))
    SettingCollector(*bar, bar->windowTitle(), {}).addTo(settings);
  for (const QDockWidget* dock : window.findChildren<QDockWidget*>())
  {
    const QAction& toggle = *dock->toggleViewAction();
    SettingCollector(*dock, dock->windowTitle(),
                     toggle.isEnabled() ? QString() : reasonOf(toggle, hasCase))
        .addTo(settings);
  }
  return settings;
}

void showSetting(QWidget& control)
{
  if (auto* dock = findAbove<QDockWidget>(control))
  {
    dock->show();
    dock->raise();
  }
  if (auto* bar = findAbove<QToolBar>(control))
    bar->show();
  for (auto* section = findAbove<FoldBox>(control); section; section = findAbove<FoldBox>(*section))
    section->setOpen(true);
  control.setFocus(Qt::ShortcutFocusReason);
  // Once the panel is laid out.
  QTimer::singleShot(0, &control,
                     [&control]
                     {
                       if (auto* area = findAbove<QScrollArea>(control))
                         area->ensureWidgetVisible(&control);
                     });
}

std::vector<presenters::CommandEntry> entriesOf(const std::vector<Command>& commands)
{
  std::vector<presenters::CommandEntry> entries;
  for (const Command& command : commands)
    entries.push_back({bytes(command.name), bytes(command.menu), bytes(command.tip)});
  return entries;
}

} // namespace petrous::workstation
