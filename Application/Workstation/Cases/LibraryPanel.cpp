#include "LibraryPanel.h"

#include <algorithm>
#include <set>
#include <utility>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDateEdit>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QTimer>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>

#include "Application.h"
#include "CasesModel.h"
#include "DescriptionDialog.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Library/CaseSearch.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

namespace
{
constexpr int kNameWidth = 205; // px
constexpr int kButtonsInRow = 3;
constexpr int kSampledLines = 50; // for the widths of columns

// A picture keeps its colours where its row is selected.
class PictureDelegate : public QStyledItemDelegate
{
public:
  using QStyledItemDelegate::QStyledItemDelegate;

protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override
  {
    QStyledItemDelegate::initStyleOption(option, index);
    if (!option->icon.isNull())
      option->icon.addPixmap(option->icon.pixmap(option->decorationSize), QIcon::Selected);
  }
};
} // namespace

LibraryPanel::LibraryPanel(const presenters::WorkstationModel& model, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_cases(new CasesModel(this))
  , m_search(new QLineEdit)
  , m_side(new QComboBox)
  , m_tag(new QComboBox)
  , m_inNotes(new QCheckBox(tr("in &notes too")))
  , m_dated(new QCheckBox(tr("&planned from")))
  , m_from(new QDateEdit(QDate::currentDate()))
  , m_to(new QDateEdit(QDate::currentDate().addMonths(1)))
  , m_list(new QTreeView)
  , m_count(new QLabel)
  , m_more(new QMenu(this))
  , m_deleted(new QMenu(this))
  , m_undelete(new QToolButton)
{
  m_search->setObjectName("searchCases");
  m_search->setPlaceholderText(tr("Search names, structures, tags, diagnoses"));
  m_search->setToolTip(
      tr("Cases that have each of these words in their name or in that of a structure, MR or "
         "mesh, in a tag, the diagnosis or the procedure (%1)")
          .arg(QKeySequence(QKeySequence::Find).toString(QKeySequence::NativeText)));
  m_search->setAccessibleName(tr("Search cases"));
  m_search->setClearButtonEnabled(true);
  m_search->setAcceptDrops(false); // an archive that is dropped is for the window
  connect(m_search, &QLineEdit::textChanged, this, &LibraryPanel::refresh);
  connect(m_search, &QLineEdit::returnPressed, this, &LibraryPanel::focusList);
  m_cases->library = [this] { return m_model.library(); };
  connect(&m_work, &BackgroundWork::failed, this, &LibraryPanel::showFault);
  m_list->setObjectName("cases");
  m_list->setModel(m_cases);
  m_list->setAccessibleName(tr("Cases of the library"));
  m_list->setRootIsDecorated(false);
  m_list->setIconSize(kCasePicture);
  m_list->setItemDelegate(new PictureDelegate(m_list));
  m_list->setUniformRowHeights(true);
  m_list->setAlternatingRowColors(true);
  m_list->setAllColumnsShowFocus(true);
  m_list->setTextElideMode(Qt::ElideMiddle);
  m_list->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  m_list->setSortingEnabled(true);
  m_list->sortByColumn(CasesModel::Changed, Qt::DescendingOrder);
  m_list->header()->setStretchLastSection(false);
  m_list->header()->setResizeContentsPrecision(kSampledLines);
  m_list->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  m_list->header()->setSectionResizeMode(CasesModel::Name, QHeaderView::Interactive);
  m_list->header()->resizeSection(CasesModel::Name, kNameWidth);
  m_list->setContextMenuPolicy(Qt::ActionsContextMenu);
  connect(m_list->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          &LibraryPanel::update);
  connect(m_cases, &QAbstractItemModel::modelAboutToBeReset, this,
          [this] { m_before = current(); });
  connect(m_cases, &QAbstractItemModel::modelReset, this,
          [this]
          {
            if (const int row = m_cases->rowOf(m_before); row >= 0)
              m_list->setCurrentIndex(m_cases->index(row, 0));
            update();
          });

  m_count->setObjectName("dim");
  m_count->setTextFormat(Qt::PlainText);
  wrapWords(*m_count);
  m_deleted->setObjectName("deletedCases");
  m_undelete->setObjectName("undeleteCase");
  m_undelete->setText(tr("Bring back"));
  m_undelete->setMenu(m_deleted);
  m_undelete->setPopupMode(QToolButton::InstantPopup);
  m_undelete->setToolTip(tr("Deleted cases, the last one first"));

  auto* buttons = new QGridLayout;
  addButtons(*buttons);
  auto* foot = new QHBoxLayout;
  foot->addWidget(m_count, 1);
  foot->addWidget(m_undelete);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addWidget(m_search);
  addFilters(*layout);
  layout->addLayout(buttons);
  layout->addWidget(m_list, 1);
  layout->addLayout(foot);
  setMinimumWidth(340);
}

// Beside the text: side, tag, notes, planned date.
void LibraryPanel::addFilters(QBoxLayout& layout)
{
  m_side->setObjectName("searchSide");
  m_side->setAccessibleName(tr("Side"));
  m_side->setToolTip(tr("Cases whose operation is on this side"));
  m_side->addItem(tr("any side"), -1);
  for (const auto side : {scene::Side::Left, scene::Side::Right, scene::Side::Both})
    m_side->addItem(sideText(side), static_cast<int>(side));
  connect(m_side, qOverload<int>(&QComboBox::currentIndexChanged), this, &LibraryPanel::refresh);
  m_tag->setObjectName("searchTag");
  m_tag->setAccessibleName(tr("Tag"));
  m_tag->setToolTip(tr("Cases that bear this tag"));
  m_tag->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  m_tag->setMinimumContentsLength(8);
  m_tag->addItem(tr("any tag"), QString());
  connect(m_tag, qOverload<int>(&QComboBox::currentIndexChanged), this, &LibraryPanel::refresh);
  m_inNotes->setObjectName("searchNotes");
  m_inNotes->setToolTip(tr("The search reads the notes of the cases, too"));
  connect(m_inNotes, &QCheckBox::toggled, this, &LibraryPanel::refresh);
  m_dated->setObjectName("searchDated");
  m_dated->setToolTip(tr("Cases whose planned date lies between these days, both included"));
  m_from->setObjectName("searchFrom");
  m_to->setObjectName("searchTo");
  for (QDateEdit* date : {m_from, m_to})
  {
    date->setDisplayFormat(dateFormat());
    date->setCalendarPopup(true);
    date->setEnabled(false);
    date->setAccessibleName(date == m_from ? tr("Planned from") : tr("Planned to"));
    date->setToolTip(m_dated->toolTip());
    connect(m_dated, &QCheckBox::toggled, date, &QWidget::setEnabled);
    connect(date, &QDateEdit::dateChanged, this, &LibraryPanel::refresh);
  }
  connect(m_dated, &QCheckBox::toggled, this, &LibraryPanel::refresh);
  auto* where = new QHBoxLayout;
  where->addWidget(m_side);
  where->addWidget(m_tag, 1);
  where->addWidget(m_inNotes);
  auto* when = new QHBoxLayout;
  when->addWidget(m_dated);
  when->addWidget(m_from);
  when->addWidget(new QLabel(tr("to")));
  when->addWidget(m_to);
  when->addStretch();
  layout.addLayout(where);
  layout.addLayout(when);
}

library::CaseFilter LibraryPanel::filter() const
{
  library::CaseFilter filter;
  filter.text = bytes(m_search->text());
  filter.inNotes = m_inNotes->isChecked();
  if (const int side = m_side->currentData().toInt(); side >= 0)
    filter.side = static_cast<scene::Side>(side);
  if (m_tag->currentIndex() > 0)
    filter.tags = {bytes(m_tag->currentData().toString())};
  if (m_dated->isChecked())
  {
    filter.from = bytes(m_from->date().toString(Qt::ISODate));
    filter.to = bytes(m_to->date().toString(Qt::ISODate));
  }
  return filter;
}

// The tags of all cases; the chosen one stays while a case has it.
void LibraryPanel::listTags(const std::set<std::string>& tags)
{
  const QSignalBlocker quiet(m_tag);
  const QString chosen = m_tag->currentData().toString();
  while (m_tag->count() > 1)
    m_tag->removeItem(1);
  for (const std::string& tag : tags)
    m_tag->addItem(words(tag), words(tag));
  m_tag->setCurrentIndex(chosen.isEmpty() ? 0 : std::max(m_tag->findData(chosen), 0));
}

// Each is a button or an entry of the menu below the last button, an entry of the list's context
// menu, and some a key of the list.
void LibraryPanel::addButtons(QGridLayout& layout)
{
  const auto place = [&layout](QToolButton& button, const char* name)
  {
    button.setObjectName(name);
    button.setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    const int at = layout.count();
    layout.addWidget(&button, at / kButtonsInRow, at % kButtonsInRow);
  };
  const auto add = [&](const char* name, const QString& text, const QKeySequence& key,
                       const QString& tip, Asked asked, bool ofDamaged)
  {
    auto* action = new QAction(text, m_list);
    action->setShortcut(key);
    action->setShortcutContext(Qt::WidgetShortcut);
    const QString keys = key.toString(QKeySequence::NativeText);
    action->setToolTip(keys.isEmpty() ? tip : tip + " (" + keys + ")");
    connect(action, &QAction::triggered, this,
            [this, asked, ofDamaged]
            {
              const std::string which = ofDamaged ? current() : chosen();
              if (!which.empty())
                emit(this->*asked)(words(which));
            });
    m_list->addAction(action);
    (ofDamaged ? m_needEntry : m_needCase) += action;
    if (!name)
    {
      m_more->addAction(action);
      return action;
    }
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setText(QString(text).remove('&').remove(QString::fromUtf8("…")));
    place(*button, name);
    return action;
  };
  auto* open = add("openThisCase", tr("&Open"), Qt::Key_Return, tr("Opens the case"),
                   &LibraryPanel::openAsked, false);
  open->setShortcuts({Qt::Key_Return, Qt::Key_Enter});
  connect(m_list, &QTreeView::doubleClicked, open, &QAction::trigger);
  add("renameCase", tr("&Rename…"), Qt::Key_F2, tr("Gives the case another name"),
      &LibraryPanel::renameAsked, true);
  add("copyCase", tr("&Copy…"), QKeySequence::Copy, tr("A second case that begins as this one"),
      &LibraryPanel::copyAsked, true);
  add("deleteCase", tr("&Delete…"), QKeySequence(Qt::Key_Delete),
      tr("Takes the case out of the library; it can be brought back"), &LibraryPanel::removeAsked,
      true);
  add("describeCase", tr("D&escribe…"), Qt::ALT + Qt::Key_Return,
      tr("Note, tags, diagnosis, procedure, side, planned date"), &LibraryPanel::describeAsked,
      false);
  add(nullptr, tr("Make the &picture"), {},
      tr("The small picture in this list, from the last view"), &LibraryPanel::pictureAsked, false);
  add(nullptr, tr("&Archive the case…"), {}, tr("The case in one file"),
      &LibraryPanel::archiveAsked, false);
  add(nullptr, tr("&Send the case…"), {}, tr("The case to a DICOM node"), &LibraryPanel::sendAsked,
      false);
  m_more->setObjectName("moreOfLibraryMenu");
  m_more->setToolTipsVisible(true);
  auto* more = new QToolButton;
  more->setText(tr("More"));
  more->setToolTip(tr("Archives, DICOM nodes, and the check of the library's files"));
  more->setMenu(m_more);
  more->setPopupMode(QToolButton::InstantPopup);
  place(*more, "moreOfLibrary");
}

void LibraryPanel::addToMore(const QList<QAction*>& actions)
{
  m_more->addSeparator();
  m_more->addActions(actions);
}

void LibraryPanel::showEvent(QShowEvent* event)
{
  Panel::showEvent(event);
  if (m_stale)
    refresh();
}

bool LibraryPanel::event(QEvent* event)
{
  if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress)
    return Panel::event(event);
  if (!static_cast<QKeyEvent*>(event)->matches(QKeySequence::Find))
    return Panel::event(event);
  if (event->type() == QEvent::KeyPress)
    m_search->setFocus(Qt::ShortcutFocusReason);
  event->accept();
  return true;
}

// Several causes at once, and none while nobody looks.
void LibraryPanel::refreshSoon()
{
  m_stale = true;
  QTimer::singleShot(0, this,
                     [this]
                     {
                       if (m_stale && isVisible())
                         refresh();
                     });
}

void LibraryPanel::refresh()
{
  m_stale = false;
  m_work.replace(
      [this, library = m_model.library(), filter = filter(),
       isFiltered = isFiltered()](const core::Progress& progress) mutable -> BackgroundWork::Reply
      {
        Found found;
        found.isFiltered = isFiltered;
        found.cases = library::searchCases(library, filter, found.tags, progress);
        if (!filter.tags.empty() && found.tags.count(filter.tags[0]) == 0)
        {
          filter.tags.clear(); // no case has it any more
          found.cases = library::searchCases(library, filter, found.tags, progress);
        }
        found.deleted = library.deleted();
        return [this, found = std::move(found)]() mutable { showFound(std::move(found)); };
      });
}

void LibraryPanel::showFound(Found found)
{
  const std::string before = std::exchange(m_wanted, {});
  const std::string open = m_model.hasCase() ? m_model.value().name : std::string();
  // Else what was selected stays, also while a case is closed for a moment.
  const bool isOpened = !open.empty() && open != std::exchange(m_open, open);
  const std::string selected = !before.empty() ? before : isOpened ? open : current();
  listTags(found.tags);
  m_cases->setCases(std::move(found.cases), open);
  int row = m_cases->rowOf(selected);
  if (row < 0)
    row = m_cases->rowOf(open);
  m_list->setCurrentIndex(m_cases->index(std::max(row, 0), 0));
  const int count = m_cases->rowCount();
  if (count > 0)
    m_count->setText(count == 1 ? tr("1 case") : tr("%1 cases").arg(count));
  else
    m_count->setText(!found.isFiltered
                         ? tr("No case yet. Drop a DICOM folder, or an archive (.petrous), on "
                              "the window.")
                         : tr("No case has all of that."));
  m_count->setToolTip(words(m_model.library().folder().string()));
  listDeleted(found.deleted);
  emit refreshed();
}

void LibraryPanel::showFault(const QString& why)
{
  m_cases->setCases({}, {});
  m_count->setText(why);
  emit refreshed();
}

bool LibraryPanel::isFiltered() const
{
  return !m_search->text().trimmed().isEmpty() || m_side->currentIndex() > 0 ||
         m_tag->currentIndex() > 0 || m_dated->isChecked();
}

void LibraryPanel::forgetPictures()
{
  m_cases->forgetPictures();
}

void LibraryPanel::pictureDrawn(const std::string& id)
{
  m_cases->pictureDrawn(id);
}

void LibraryPanel::onSeen(std::function<void(const library::CaseSummary&)> seen)
{
  m_cases->seen = std::move(seen);
}

void LibraryPanel::select(const std::string& name)
{
  if (m_cases->rowOf(name) < 0)
  {
    m_search->clear();
    m_side->setCurrentIndex(0);
    m_tag->setCurrentIndex(0);
    m_dated->setChecked(false);
  }
  m_wanted = name;
  refresh();
}

QWidget* LibraryPanel::mainControl()
{
  return m_list;
}

void LibraryPanel::focusList()
{
  m_list->setFocus();
}

void LibraryPanel::listDeleted(const std::vector<library::DeletedCase>& cases)
{
  m_deleted->clear();
  std::set<std::string> listed; // of several of one name the last is brought back
  for (const auto& one : cases)
    if (listed.insert(one.name).second)
      connect(
          m_deleted->addAction(
              tr("%1, deleted %2").arg(words(one.name).replace('&', "&&"), localTime(one.deleted))),
          &QAction::triggered, this, [this, name = one.name] { emit undeleteAsked(words(name)); });
  m_undelete->setEnabled(!m_deleted->isEmpty());
}

std::string LibraryPanel::current() const
{
  const QModelIndex index = m_list->currentIndex();
  return index.isValid() ? m_cases->at(index.row()).name : std::string();
}

std::string LibraryPanel::chosen() const
{
  const QModelIndex index = m_list->currentIndex();
  return index.isValid() && !m_cases->at(index.row()).damaged ? current() : std::string();
}

std::size_t LibraryPanel::strokes() const
{
  const QModelIndex index = m_list->currentIndex();
  return index.isValid() ? m_cases->at(index.row()).strokes : 0;
}

void LibraryPanel::update()
{
  for (QAction* action : m_needEntry)
    action->setEnabled(!current().empty());
  for (QAction* action : m_needCase)
    action->setEnabled(!chosen().empty());
}

} // namespace petrous::workstation
