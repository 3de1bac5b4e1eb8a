#include "OpenCaseDialog.h"

#include <set>
#include <utility>

#include <QAction>
#include <QDateTime>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QInputDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QShortcut>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Application.h"
#include "PanelLayout.h"
#include "Theme.h"

namespace petrous::workstation
{

namespace
{

constexpr int kDamaged = Qt::UserRole; // of column 0
constexpr int kStrokes = Qt::UserRole + 1;

QString localTime(const std::string& utc)
{
  return QDateTime::fromString(words(utc), Qt::ISODate).toLocalTime().toString("yyyy-MM-dd HH:mm");
}

void fillLine(QTreeWidgetItem& item, const library::CaseSummary& summary)
{
  item.setText(0, words(summary.name));
  item.setData(0, kDamaged, summary.damaged);
  item.setData(0, kStrokes, static_cast<qulonglong>(summary.strokes));
  item.setText(1, localTime(summary.modified));
  if (summary.damaged) // it can still be renamed and deleted
  {
    item.setText(2, OpenCaseDialog::tr("damaged"));
    for (int column = 0; column < 6; ++column)
      item.setForeground(
          column, item.treeWidget()->palette().brush(QPalette::Disabled, QPalette::WindowText));
    return;
  }
  item.setText(
      2, QString("%1 × %2 × %3").arg(summary.dims[0]).arg(summary.dims[1]).arg(summary.dims[2]));
  item.setText(3, QString::number(summary.structures));
  item.setText(4, QString::number(summary.strokes));
  item.setText(5, QString::number(summary.removed, 'f', 1));
  for (int column = 2; column < 6; ++column)
    item.setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
}

} // namespace

OpenCaseDialog::OpenCaseDialog(const library::Library& library, Changes changes, QWidget* parent)
  : QDialog(parent)
  , m_library(library)
  , m_changes(std::move(changes))
  , m_search(new QLineEdit)
  , m_list(new QTreeWidget)
  , m_deleted(new QMenu(this))
{
  setWindowTitle(tr("Open case"));
  resizeOnScreen(*this, {760, 420});
  m_search->setObjectName("searchCases");
  m_search->setPlaceholderText(tr("Search names of cases and structures"));
  m_search->setToolTip(
      tr("Cases that have each of these words in their name or in that of a "
         "structure, MR or mesh (%1)")
          .arg(QKeySequence(QKeySequence::Find).toString(QKeySequence::NativeText)));
  m_search->setClearButtonEnabled(true);
  connect(m_search, &QLineEdit::textChanged, this,
          [this] { attempt([this] { fill(current()); }); });
  connect(new QShortcut(QKeySequence::Find, this), &QShortcut::activated, m_search,
          [this] { m_search->setFocus(Qt::ShortcutFocusReason); });
  m_list->setObjectName("cases");
  m_list->setRootIsDecorated(false);
  m_list->setHeaderLabels({tr("Case"), tr("Changed"), tr("Voxels"), tr("Structures"), tr("Strokes"),
                           tr("Removed mm³")});
  m_list->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  m_list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  m_list->header()->setStretchLastSection(false);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel);
  auto* open = buttons->button(QDialogButtonBox::Open);
  QList<QPushButton*> changers;
  const auto add = [&](const char* name, const QString& text, const QKeySequence& key,
                       void (OpenCaseDialog::*what)())
  {
    auto* button = buttons->addButton(text, QDialogButtonBox::ActionRole);
    button->setObjectName(name);
    button->setAutoDefault(false);
    connect(button, &QPushButton::clicked, this, what);
    auto* action = new QAction(text, m_list);
    action->setShortcut(key);
    action->setShortcutContext(Qt::WidgetShortcut);
    connect(action, &QAction::triggered, this, what);
    m_list->addAction(action);
    button->setToolTip(key.toString(QKeySequence::NativeText));
    changers += button;
  };
  if (m_changes.rename)
    add("renameCase", tr("&Rename…"), Qt::Key_F2, &OpenCaseDialog::rename);
  if (m_changes.copy)
    add("copyCase", tr("&Copy…"), QKeySequence(QKeySequence::Copy), &OpenCaseDialog::copy);
  if (m_changes.remove)
    add("deleteCase", tr("&Delete…"), Qt::Key_Delete, &OpenCaseDialog::remove);
  if (m_changes.undelete)
  {
    m_deleted->setObjectName("deletedCases");
    m_undelete = buttons->addButton(tr("&Bring back"), QDialogButtonBox::ActionRole);
    m_undelete->setObjectName("undeleteCase");
    m_undelete->setAutoDefault(false);
    m_undelete->setMenu(m_deleted);
    m_undelete->setToolTip(tr("Deleted cases, the last one first"));
  }
  m_list->setContextMenuPolicy(Qt::ActionsContextMenu);

  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_list, &QTreeWidget::itemActivated, this,
          [this]
          {
            if (!chosen().empty())
              accept();
          });
  const auto update = [this, open, changers]
  {
    open->setEnabled(!chosen().empty());
    for (QPushButton* button : changers)
      button->setEnabled(!current().empty());
  };
  connect(m_list, &QTreeWidget::currentItemChanged, this, update);
  fill({});
  update();
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(m_search);
  layout->addWidget(m_list);
  layout->addWidget(buttons);
  m_list->setFocus();
}

void OpenCaseDialog::fill(const std::string& current)
{
  m_list->clear();
  QTreeWidgetItem* item = nullptr;
  for (const auto& summary : m_library.search(bytes(m_search->text())))
  {
    auto* line = new QTreeWidgetItem(m_list);
    fillLine(*line, summary);
    if (summary.name == current)
      item = line;
  }
  m_list->sortItems(1, Qt::DescendingOrder);
  m_list->setCurrentItem(item ? item : m_list->topLevelItem(0));
  listDeleted();
}

void OpenCaseDialog::listDeleted()
{
  if (!m_undelete)
    return;
  m_deleted->clear();
  std::set<std::string> listed; // of several of one name the last is brought back
  for (const auto& one : m_library.deleted())
    if (listed.insert(one.name).second)
      connect(
          m_deleted->addAction(
              tr("%1, deleted %2").arg(words(one.name).replace('&', "&&"), localTime(one.deleted))),
          &QAction::triggered, this,
          [this, name = one.name]
          {
            attempt(
                [&]
                {
                  m_changes.undelete(name);
                  m_search->clear();
                  fill(name);
                });
          });
  m_undelete->setEnabled(!m_deleted->isEmpty());
}

std::string OpenCaseDialog::current() const
{
  const QTreeWidgetItem* item = m_list->currentItem();
  return item ? bytes(item->text(0)) : std::string();
}

std::string OpenCaseDialog::chosen() const
{
  const QTreeWidgetItem* item = m_list->currentItem();
  return item && !item->data(0, kDamaged).toBool() ? current() : std::string();
}

void OpenCaseDialog::attempt(const std::function<void()>& change)
{
  try
  {
    change();
  }
  catch (const std::exception& error)
  {
    QMessageBox box(QMessageBox::Warning, tr("Petrous"), toString(error), QMessageBox::Ok, this);
    box.setTextFormat(Qt::PlainText);
    box.exec();
  }
}

void OpenCaseDialog::rename()
{
  const std::string name = current();
  if (name.empty())
    return;
  const std::string to = bytes(QInputDialog::getText(this, tr("Rename the case"),
                                                     tr("New name of “%1”:").arg(words(name)),
                                                     QLineEdit::Normal, words(name))
                                   .trimmed());
  if (to.empty() || to == name)
    return;
  attempt(
      [&]
      {
        m_changes.rename(name, to);
        fill(to);
      });
}

void OpenCaseDialog::copy()
{
  const std::string name = current();
  if (name.empty())
    return;
  const std::string to =
      bytes(QInputDialog::getText(this, tr("Copy the case"),
                                  tr("Name of the copy of “%1”:").arg(words(name)),
                                  QLineEdit::Normal, words(name))
                .trimmed());
  if (to.empty() || to == name)
    return;
  attempt(
      [&]
      {
        m_changes.copy(name, to);
        m_search->clear();
        fill(to);
      });
}

void OpenCaseDialog::remove()
{
  const std::string name = current();
  if (name.empty())
    return;
  const auto strokes = m_list->currentItem()->data(0, kStrokes).toULongLong();
  QMessageBox box(QMessageBox::Warning, tr("Delete the case"),
                  tr("Delete the case “%1”?").arg(words(name)), QMessageBox::NoButton, this);
  box.setTextFormat(Qt::PlainText);
  box.setObjectName("askDelete");
  box.setInformativeText(
      (strokes > 0 ? tr("%1 strokes were drilled in it. ").arg(strokes) : QString()) +
      tr("It can be brought back here until the library is cleaned up."));
  const auto* yes = box.addButton(tr("&Delete"), QMessageBox::DestructiveRole);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  if (box.clickedButton() != yes)
    return;
  attempt(
      [&]
      {
        m_changes.remove(name);
        fill({});
      });
}

} // namespace petrous::workstation
