#include "CommandPalette.h"

#include <algorithm>
#include <utility>

#include <QAction>
#include <QApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
enum PaletteColumn
{
  kCommandName,
  kCommandMenu,
  kCommandKeys
};
} // namespace

CommandPalette::CommandPalette(std::vector<Command> commands, QWidget* parent)
  : QDialog(parent)
  , m_commands(std::move(commands))
  , m_entries(entriesOf(m_commands))
  , m_search(new QLineEdit)
  , m_list(new QTreeWidget)
  , m_tip(new QLabel)
{
  setObjectName("commandPalette");
  setWindowTitle(tr("Find a command"));
  m_search->setObjectName("commandSearch");
  m_search->setPlaceholderText(tr("Type what it is called, or what it does"));
  m_search->setAccessibleName(tr("Search commands"));
  m_search->setClearButtonEnabled(true);
  m_search->installEventFilter(this);
  m_list->setObjectName("commandsFound");
  m_list->setAccessibleName(tr("Commands"));
  m_list->setColumnCount(3);
  m_list->setHeaderLabels({tr("Command"), tr("Menu or panel"), tr("Key")});
  m_list->setRootIsDecorated(false);
  m_list->setUniformRowHeights(true);
  m_list->setAllColumnsShowFocus(true);
  m_tip->setObjectName("dim");
  m_tip->setTextFormat(Qt::PlainText);
  wrapWords(*m_tip, 2);
  connect(m_search, &QLineEdit::textChanged, this, &CommandPalette::search);
  connect(m_list, &QTreeWidget::currentItemChanged, this, &CommandPalette::tell);
  connect(m_list, &QTreeWidget::itemActivated, this, &CommandPalette::run);

  auto* layout = new QVBoxLayout(this);
  layout->addWidget(m_search);
  layout->addWidget(m_list, 1);
  layout->addWidget(m_tip);
  const QSize room = parent ? parent->size() : QSize(900, 640);
  resize(std::min(760, room.width() - 40), std::min(520, room.height() - 40));
  search();
  m_list->header()->setStretchLastSection(false);
  m_list->header()->setSectionResizeMode(kCommandName, QHeaderView::Stretch);
  m_list->header()->setSectionResizeMode(kCommandMenu, QHeaderView::ResizeToContents);
  m_list->header()->setSectionResizeMode(kCommandKeys, QHeaderView::ResizeToContents);
}

void CommandPalette::search()
{
  m_list->clear();
  const QBrush grey = palette().brush(QPalette::Disabled, QPalette::Text);
  QFont slanted = m_list->font(); // seen on a selected row too
  slanted.setItalic(true);
  for (const std::size_t n : presenters::findCommands(m_entries, bytes(m_search->text())))
  {
    const Command& command = m_commands[n];
    auto* item = new QTreeWidgetItem(m_list, {command.name, command.menu, command.keys});
    item->setData(kCommandName, Qt::UserRole, static_cast<qulonglong>(n));
    if (command.isEnabled)
      continue;
    for (const int column : {kCommandName, kCommandMenu, kCommandKeys})
    {
      item->setForeground(column, grey);
      item->setFont(column, slanted);
    }
    item->setToolTip(kCommandName, command.whyNot);
    item->setData(kCommandName, Qt::AccessibleDescriptionRole,
                  tr("not available now. %1").arg(command.whyNot));
  }
  m_list->setCurrentItem(m_list->topLevelItem(0));
  tell();
}

const Command* CommandPalette::chosen() const
{
  const QTreeWidgetItem* item = m_list->currentItem();
  return item ? &m_commands[item->data(kCommandName, Qt::UserRole).toULongLong()] : nullptr;
}

void CommandPalette::tell()
{
  const Command* command = chosen();
  if (!command)
    return m_tip->setText(tr("No command is called so."));
  if (command->isEnabled)
    return m_tip->setText(command->tip);
  m_tip->setText(command->whyNot.isEmpty()
                     ? tr("Not available now.")
                     : tr("Not available now: %1").arg(sentence(command->whyNot)));
}

// After the palette is gone: a command may open a dialog of its own.
void CommandPalette::run()
{
  const Command* command = chosen();
  if (!command || !command->isEnabled)
    return;
  const QPointer<QAction> action = command->action;
  const QPointer<QWidget> control = command->control;
  accept();
  QMetaObject::invokeMethod(
      qApp,
      [action, control]
      {
        if (action)
          action->trigger();
        else if (control)
          showSetting(*control);
      },
      Qt::QueuedConnection);
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event)
{
  if (watched != m_search || event->type() != QEvent::KeyPress)
    return QDialog::eventFilter(watched, event);
  switch (static_cast<QKeyEvent*>(event)->key())
  {
  case Qt::Key_Up:
  case Qt::Key_Down:
  case Qt::Key_PageUp:
  case Qt::Key_PageDown:
    QCoreApplication::sendEvent(m_list, event);
    return true;
  case Qt::Key_Return:
  case Qt::Key_Enter:
    run();
    return true;
  default:
    return QDialog::eventFilter(watched, event);
  }
}

} // namespace petrous::workstation
