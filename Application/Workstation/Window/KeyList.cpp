#include "KeyList.h"

#include <algorithm>

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLineEdit>
#include <QScrollBar>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Theme.h"

namespace petrous::workstation
{

namespace
{
enum KeyColumn
{
  kKeyItself,
  kKeyName,
  kKeyTip
};
} // namespace

KeyList::KeyList(const std::vector<Command>& commands, QWidget* parent)
  : QDialog(parent)
  , m_search(new QLineEdit)
  , m_list(new QTreeWidget)
{
  setObjectName("keyList");
  setWindowTitle(tr("Keys"));
  m_search->setObjectName("keySearch");
  m_search->setPlaceholderText(tr("Search keys and what they do"));
  m_search->setAccessibleName(tr("Search keys"));
  m_search->setClearButtonEnabled(true);
  m_list->setObjectName("keys");
  m_list->setAccessibleName(tr("Keys"));
  m_list->setColumnCount(3);
  m_list->setHeaderLabels({tr("Key"), tr("Command"), tr("What it does")});
  m_list->setAllColumnsShowFocus(true);
  m_list->setSelectionMode(QAbstractItemView::SingleSelection);
  for (const Command& command : commands)
    if (!command.keys.isEmpty())
      add(command.menu, command.name, command.keys, command.tip);

  // Taken by the views themselves.
  const QString view = tr("3D view");
  add(view, tr("Turn the patient"), tr("drag"), {});
  add(view, tr("Zoom"), tr("wheel"), tr("With Depth by wheel on: Ctrl with the wheel"));
  add(view, tr("Crosshair on the surface"), tr("click"), {});
  add(view, tr("Enlarge, and back"), tr("double click"), {});
  add(view, tr("Back from the enlarged view"), tr("Esc"), tr("Of a slice, too"));
  add(view, tr("Drill, while the drill is on"), tr("Space, or the left button"),
      tr("With Ctrl the button presses the burr without drilling"));
  add(view, tr("Clutch"), tr("X"), tr("Held: the tool stays while hand or mouse goes on"));
  const QString slices = tr("Slices");
  add(slices, tr("Move the crosshair"), tr("click or drag, arrow keys"), {});
  add(slices, tr("Through the slices"), tr("wheel, Page up, Page down"), {});
  add(slices, tr("Zoom"), tr("Ctrl with the wheel, + and -"), {});
  add(slices, tr("Move the picture"), tr("drag with the middle button"), {});
  add(slices, tr("Window and level"), tr("drag with the right button"), {});
  add(slices, tr("Turn the other two planes"), tr("Ctrl and drag, Ctrl+left, Ctrl+right"), {});
  add(slices, tr("Crop box"), tr("drag an edge or a corner"),
      tr("While it is shown; in the 3D view drag the middle of a face. A double click on an edge "
         "shows all of the image"));
  add(slices, tr("Clipping plane"), tr("drag its line"),
      tr("By a disc near an end it turns within the slice"));
  add(slices, tr("Tilt the slice"), tr("Ctrl+up, Ctrl+down"),
      tr("With Shift and left or right about its other axis"));
  add(slices, tr("Move the MR"), tr("Alt with the arrow keys, Page up, Page down"),
      tr("Where an MR lies over the slice; with Shift by the larger step"));

  m_list->expandAll();
  const int wanted = fitColumns();
  connect(m_search, &QLineEdit::textChanged, this, &KeyList::search);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(m_search);
  layout->addWidget(m_list, 1);
  layout->addWidget(buttons);
  const QSize room = parent ? parent->size() : QSize(900, 700);
  const QMargins margins = layout->contentsMargins();
  resize(std::min(wanted + margins.left() + margins.right(), room.width() - 40),
         std::min(680, room.height() - 40));
}

// To what the rows hold; the names of menus and panels span all columns. Returns the list's width
// in which nothing is cut off.
int KeyList::fitColumns()
{
  constexpr int kPadding = 14; // px
  int widths[] = {0, 0, 0};
  for (int n = 0; n < m_list->topLevelItemCount(); ++n)
    for (int row = 0; row < m_list->topLevelItem(n)->childCount(); ++row)
      for (const int column : {kKeyItself, kKeyName, kKeyTip})
        widths[column] =
            std::max(widths[column], m_list->fontMetrics().horizontalAdvance(
                                         m_list->topLevelItem(n)->child(row)->text(column)));
  widths[kKeyItself] += 2 * m_list->indentation();
  m_list->header()->setStretchLastSection(true);
  int width = 2 * m_list->frameWidth() + m_list->verticalScrollBar()->sizeHint().width();
  for (const int column : {kKeyItself, kKeyName, kKeyTip})
  {
    m_list->header()->resizeSection(column, widths[column] + kPadding);
    width += widths[column] + kPadding;
  }
  return width;
}

void KeyList::add(const QString& group, const QString& name, const QString& keys,
                  const QString& tip)
{
  QTreeWidgetItem* top = nullptr;
  for (int n = 0; n < m_list->topLevelItemCount(); ++n)
    if (m_list->topLevelItem(n)->text(kKeyItself) == group)
      top = m_list->topLevelItem(n);
  if (!top)
  {
    top = new QTreeWidgetItem(m_list, {group});
    top->setFirstColumnSpanned(true);
    QFont bold = font();
    bold.setBold(true);
    top->setFont(kKeyItself, bold);
  }
  auto* item = new QTreeWidgetItem(top, {keys, name, tip});
  item->setToolTip(kKeyTip, tip);
}

void KeyList::search()
{
  const QString wanted = m_search->text().trimmed();
  for (int n = 0; n < m_list->topLevelItemCount(); ++n)
  {
    QTreeWidgetItem* group = m_list->topLevelItem(n);
    bool isAnyShown = false;
    for (int row = 0; row < group->childCount(); ++row)
    {
      QTreeWidgetItem* item = group->child(row);
      bool isFound = group->text(kKeyItself).contains(wanted, Qt::CaseInsensitive);
      for (const int column : {kKeyItself, kKeyName, kKeyTip})
        isFound |= item->text(column).contains(wanted, Qt::CaseInsensitive);
      item->setHidden(!isFound);
      isAnyShown |= isFound;
    }
    group->setHidden(!isAnyShown);
  }
}

} // namespace petrous::workstation
