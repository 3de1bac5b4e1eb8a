#include "StructuresPanel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <QAction>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMouseEvent>
#include <QScopedValueRollback>
#include <QSet>
#include <QSlider>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>

#include "Commands.h"
#include "NearbyModel.h"
#include "StructureEditor.h"
#include "StructuresModel.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

namespace
{
constexpr int kPadding = 4;    // px, beside a column's text
constexpr int kIndent = 8;     // px, of a structure below its kind
constexpr int kSwatch = 30;    // px, colour and margins of a name
constexpr int kSwatchHit = 20; // px, of the colour, to be clicked
constexpr int kFitAfter = 30;  // ms
constexpr int kLeastName = 12; // characters; where the panel is narrower it scrolls sideways
constexpr int kTitleIcon = 16; // px, of a column without a written title
} // namespace

StructuresPanel::StructuresPanel(presenters::WorkstationModel& model, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_structures(new StructuresModel(model, this))
  , m_list(new QTreeView)
  , m_slider(new QSlider(Qt::Horizontal))
  , m_box(numberBox("isoBox", {}, {0.0, 0.0, {}, 0, 1.0}))
  , m_search(new QLineEdit)
  , m_only(new QToolButton)
  , m_editor(new StructureEditor(model))
  , m_alone(model)
{
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  addThreshold(*layout);
  addSearch(*layout);
  addList(*layout);
  layout->addWidget(m_editor);
  addActions();
  setMinimumWidth(280);
  showRange();
}

void StructuresPanel::addThreshold(QVBoxLayout& layout)
{
  m_slider->setPageStep(50);
  m_slider->setObjectName("isoSlider");
  m_bound.add(
      m_box, [this] { return m_model.hasCase() ? m_model.value().iso : m_box->value(); },
      [this](double value) { m_model.setIso(value); }, Bindings::kSettle);
  m_bound.add(
      m_slider, [this] { return static_cast<int>(std::lround(m_box->value() / m_step)); },
      [this](int steps) { m_box->setValue(m_step * steps); });
  m_threshold = new QLabel;
  m_threshold->setObjectName("thresholdName");
  m_threshold->setBuddy(m_box);
  auto* top = new QHBoxLayout;
  top->addWidget(m_threshold);
  top->addStretch();
  top->addWidget(m_box);
  auto* head = new QVBoxLayout;
  head->setContentsMargins(10, 8, 10, 6);
  head->addLayout(top);
  head->addWidget(m_slider);
  layout.addLayout(head);
}

void StructuresPanel::addSearch(QVBoxLayout& layout)
{
  m_search->setObjectName("structuresSearch");
  m_search->setPlaceholderText(tr("Search names, presets and kinds (/)"));
  m_search->setToolTip(m_search->placeholderText()); // which is elided where it has no room
  m_search->setAccessibleName(tr("Search structures"));
  m_search->setClearButtonEnabled(true);
  m_search->installEventFilter(this);
  connect(m_search, &QLineEdit::textChanged, this, &StructuresPanel::filter);
  auto* find = new QAction(tr("&Find a structure"), this);
  find->setObjectName("findStructure");
  find->setShortcut(Qt::Key_Slash); // of the whole window, as long as the panel is not closed
  connect(find, &QAction::triggered, m_search,
          [this]
          {
            showSetting(*m_search);
            m_search->selectAll();
          });
  addAction(find);
  const auto tool = [](QToolButton* made, const char* name, const QString& text, const QString& tip)
  {
    made->setObjectName(name);
    made->setText(text);
    made->setToolTip(tip);
    made->setFocusPolicy(Qt::TabFocus); // a click leaves the keys to the list
    made->setStyleSheet("QToolButton { padding: 3px 7px; }"
                        "QToolButton:checked { background: #2f79b5; color: #ffffff; }");
    return made;
  };
  m_only->setCheckable(true);
  tool(m_only, "onlyThese", tr("Only this"),
       tr("Shows the selected ones alone (Shift+Space, or Alt and a click on a check box); again: "
          "what was shown before"));
  connect(m_only, &QToolButton::clicked, this, [this] { onlyThese(selectedParts()); });
  auto* show = tool(new QToolButton, "showThese", tr("Show"), tr("Shows the selected ones"));
  auto* hide = tool(new QToolButton, "hideThese", tr("Hide"), tr("Hides the selected ones"));
  connect(show, &QToolButton::clicked, this, [this] { setShown(selectedParts(), true); });
  connect(hide, &QToolButton::clicked, this, [this] { setShown(selectedParts(), false); });
  auto* row = new QHBoxLayout;
  row->setContentsMargins(10, 0, 10, 4);
  row->setSpacing(4);
  row->addWidget(m_search, 1);
  for (QToolButton* one : {m_only, show, hide})
    row->addWidget(one);
  layout.addLayout(row);
}

void StructuresPanel::addList(QVBoxLayout& layout)
{
  m_list->setModel(m_structures);
  m_list->setObjectName("structures");
  m_list->setAccessibleName(tr("Structures"));
  m_list->setIndentation(kIndent);
  m_list->setSelectionMode(QAbstractItemView::ExtendedSelection);
  m_list->setExpandsOnDoubleClick(false); // a double click edits, or would fold by chance
  m_list->setUniformRowHeights(true);
  m_list->setAlternatingRowColors(true);
  m_list->setAllColumnsShowFocus(true);
  m_list->setTextElideMode(Qt::ElideMiddle); // names often differ at their end: left, right
  m_list->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  QHeaderView* header = m_list->header();
  header->setStretchLastSection(false);
  header->setSectionsMovable(false);
  header->setMinimumSectionSize(20);
  header->setSectionResizeMode(QHeaderView::Fixed);
  header->setStyleSheet(QString("QHeaderView::section { padding: 4px %1px; }").arg(kPadding));
  header->setSectionResizeMode(StructuresModel::Name, QHeaderView::Interactive);
  connect(header, &QHeaderView::sectionResized, this,
          [this](int column, int, int width)
          {
            if (column == StructuresModel::Name && !m_fitting)
              m_nameWidth = width;
          });
  m_list->viewport()->installEventFilter(this);
  m_list->installEventFilter(this);
  keepKeysInEditors(*m_list);
  header->setSectionHidden(StructuresModel::Burr, true);
  // What is set comes before what is read: it is the volume that scrolls out of sight first.
  header->moveSection(header->visualIndex(StructuresModel::VolumeColumn), header->count() - 1);
  connect(m_structures, &QAbstractItemModel::modelReset, this, &StructuresPanel::fitColumns);
  m_fitLater.setSingleShot(true);
  m_fitLater.setInterval(kFitAfter);
  connect(&m_fitLater, &QTimer::timeout, this, &StructuresPanel::fitColumns);
  connect(m_structures, &QAbstractItemModel::dataChanged, &m_fitLater, qOverload<>(&QTimer::start));
  fitColumns();
  connect(m_list->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &StructuresPanel::selectionChanged);

  m_list->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(m_list, &QTreeView::customContextMenuRequested, this, &StructuresPanel::offer);
  layout.addWidget(m_list, 1);
  m_count = new QLabel;
  m_count->setObjectName("structuresCount");
  m_count->setContentsMargins(10, 3, 10, 3);
  layout.addWidget(m_count);
  const auto count = [this] { m_count->setText(m_structures->countText()); };
  connect(m_structures, &QAbstractItemModel::modelReset, m_count, count);
  connect(m_structures, &QAbstractItemModel::dataChanged, m_count, count);
}

void StructuresPanel::addActions()
{
  const auto add = [this](const QString& text, const QKeySequence& keys, const char* name,
                          const std::function<void()>& act)
  {
    auto* action = new QAction(text, m_list);
    action->setObjectName(name);
    action->setShortcut(keys);
    action->setShortcutContext(Qt::WidgetShortcut);
    connect(action, &QAction::triggered, this, act);
    m_list->addAction(action);
    m_actions.push_back(action);
  };
  add(tr("&Colour…"), Qt::SHIFT + Qt::Key_Return, "colorPart", [this] { chooseColor(); });
  add(tr("&Properties"), Qt::Key_Return, "editPart", [this] { m_editor->takeFocus(); });
  add(tr("&Only this, or as before"), Qt::SHIFT + Qt::Key_Space, "onlyPart",
      [this] { onlyThese(selectedParts()); });
  add(tr("&Show or hide"), Qt::Key_Space, "showPart", [this] { toggleShown(); });
  add(tr("&Rename…"), Qt::Key_F2, "renamePart",
      [this]
      {
        if (const QString part = chosen(); !part.isEmpty())
          emit renamingAsked(part);
      });
  add(tr("Correct the &axes of its file…"), {}, "axesOfPart",
      [this]
      {
        if (const QString part = chosen(); !part.isEmpty())
          emit axesAsked(part);
      });
  add(tr("Re&move from the case"), Qt::Key_Delete, "removePart",
      [this]
      {
        for (const std::string& part : selectedParts())
          if (m_structures->rowOf(part).isValid() &&
              !m_structures->nameAt(m_structures->rowOf(part)).empty())
            emit removalAsked(words(part));
      });
  connect(m_editor, &StructureEditor::left, m_list, qOverload<>(&QWidget::setFocus));
}

bool StructuresPanel::eventFilter(QObject* watched, QEvent* event)
{
  if (watched == m_list->viewport() && event->type() == QEvent::Resize)
    fitNames();
  if (watched == m_list->viewport() && event->type() == QEvent::MouseButtonPress)
  {
    const auto* mouse = static_cast<QMouseEvent*>(event);
    if (mouse->button() == Qt::LeftButton && clicked(mouse->pos(), mouse->modifiers()))
      return true;
  }
  if (watched == m_search && event->type() == QEvent::KeyPress)
    switch (static_cast<QKeyEvent*>(event)->key())
    {
    case Qt::Key_Escape:
      m_search->clear();
      m_list->setFocus();
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_Down:
      m_list->setFocus();
      if (!m_list->currentIndex().isValid() ||
          m_list->isRowHidden(m_list->currentIndex().row(), m_list->currentIndex().parent()))
        for (QModelIndex row = m_structures->index(0, 0); row.isValid();
             row = m_list->indexBelow(row))
          if (!m_structures->partAt(row).empty() && !m_list->isRowHidden(row.row(), row.parent()))
          {
            m_list->setCurrentIndex(row);
            break;
          }
      return true;
    default:
      break;
    }
  return Panel::eventFilter(watched, event);
}

// The colour opens the colours, and Alt on a check box of "shown" leaves the row alone.
bool StructuresPanel::clicked(const QPoint& position, Qt::KeyboardModifiers modifiers)
{
  const QModelIndex cell = m_list->indexAt(position);
  if (!cell.isValid())
    return false;
  static const int shown = StructuresModel::columnOf("shown");
  if (cell.column() == shown && modifiers == Qt::AltModifier)
  {
    onlyThese(partsOf(cell));
    return true;
  }
  const std::string part = m_structures->partAt(cell);
  const QRect rect = m_list->visualRect(cell);
  if (cell.column() != StructuresModel::Name || part.empty() || modifiers != Qt::NoModifier ||
      position.x() < rect.left() || position.x() > rect.left() + kSwatchHit)
    return false;
  // Of all that are selected, if it is one of them.
  auto parts = selectedParts();
  if (std::find(parts.begin(), parts.end(), part) == parts.end())
  {
    m_list->setCurrentIndex(cell.siblingAtColumn(StructuresModel::Name));
    parts = {part};
  }
  m_editor->chooseColor(parts, m_list->viewport()->mapToGlobal(rect.bottomLeft()));
  return true;
}

void StructuresPanel::chooseColor()
{
  const auto parts = selectedParts();
  if (!parts.empty())
    m_editor->chooseColor(parts,
                          m_list->viewport()->mapToGlobal(
                              m_list->visualRect(m_structures->rowOf(parts.front())).bottomLeft()));
}

std::vector<std::string> StructuresPanel::partsOf(const QModelIndex& row) const
{
  const std::string part = m_structures->partAt(row);
  if (!part.empty())
    return {part};
  std::vector<std::string> parts;
  const QModelIndex kind = row.siblingAtColumn(StructuresModel::Name);
  for (int n = 0; n < m_structures->rowCount(kind); ++n)
    if (!m_list->isRowHidden(n, kind))
      parts.push_back(m_structures->partAt(m_structures->index(n, 0, kind)));
  return parts;
}

std::vector<std::string> StructuresPanel::selectedParts() const
{
  std::vector<std::string> parts;
  for (const QModelIndex& row : m_list->selectionModel()->selectedRows(StructuresModel::Name))
    if (!m_list->isRowHidden(row.row(), row.parent()))
      for (const std::string& part : partsOf(row))
        if (std::find(parts.begin(), parts.end(), part) == parts.end())
          parts.push_back(part);
  return parts;
}

QString StructuresPanel::titleOf(const std::vector<std::string>& parts) const
{
  return parts.empty()       ? tr("Nothing is selected")
         : parts.size() == 1 ? m_structures->titleOf(parts.front())
                             : tr("%1 selected").arg(parts.size());
}

void StructuresPanel::selectionChanged()
{
  const auto parts = selectedParts();
  m_editor->setParts(parts, titleOf(parts));
  m_only->setEnabled(!parts.empty());
  m_only->setChecked(m_alone.isOn(parts));
  emit selected();
}

namespace
{

// Soft tissue would veil the others with which it is shown.
std::vector<std::string> shownTogether(std::vector<std::string> parts)
{
  if (parts.size() > 1)
    parts.erase(std::remove(parts.begin(), parts.end(), scene::kSoftTissue), parts.end());
  return parts;
}

} // namespace

void StructuresPanel::setShown(const std::vector<std::string>& parts, bool shown)
{
  presenters::changeLooks(m_model, shown ? shownTogether(parts) : parts,
                          [shown](const std::string&, appearance::StructureAppearance& look)
                          { look.shown = shown; });
}

// Of several that differ all are shown.
void StructuresPanel::toggleShown()
{
  const auto parts = selectedParts();
  const auto together = shownTogether(parts);
  const bool allShown = std::all_of(together.begin(), together.end(),
                                    [this](const std::string& part)
                                    {
                                      const auto* look = m_model.lookOf(part);
                                      return look && look->shown;
                                    });
  setShown(parts, !allShown);
}

void StructuresPanel::onlyThese(const std::vector<std::string>& parts)
{
  if (!m_model.drilling())
    m_alone.toggle(parts);
  selectionChanged();
}

// What is not found is not shown, and of a kind that has none, neither is the kind.
void StructuresPanel::filter()
{
  const QStringList wanted =
      StructuresModel::folded(m_search->text()).split(' ', Qt::SkipEmptyParts);
  const auto isFound = [&](const QModelIndex& row)
  {
    const QString text = m_structures->searchText(row);
    return std::all_of(wanted.begin(), wanted.end(),
                       [&text](const QString& word) { return text.contains(word); });
  };
  for (int top = 0; top < m_structures->rowCount(); ++top)
  {
    const QModelIndex row = m_structures->index(top, StructuresModel::Name);
    if (!m_structures->partAt(row).empty())
    {
      m_list->setRowHidden(top, {}, !isFound(row));
      continue;
    }
    std::size_t count = 0;
    for (int n = 0; n < m_structures->rowCount(row); ++n)
    {
      const bool found = isFound(m_structures->index(n, StructuresModel::Name, row));
      m_list->setRowHidden(n, row, !found);
      count += found ? 1 : 0;
    }
    m_list->setRowHidden(top, {}, count == 0);
    m_structures->setFound(row, wanted.isEmpty() ? std::nullopt : std::optional(count));
    if (!wanted.isEmpty() && count > 0)
      m_list->expand(row);
  }
  selectionChanged();
}

// Selection, folded kinds and place stay, unless it is another case.
void StructuresPanel::rebuild(bool another)
{
  const auto renamed = std::exchange(m_renamed, {});
  const auto present = [&](const QModelIndex& row)
  {
    std::string part = m_structures->partAt(row);
    for (const auto& [from, to] : renamed)
      if (part == from)
        part = to;
    return part;
  };
  std::vector<std::string> selected;
  for (const QModelIndex& row : m_list->selectionModel()->selectedRows(StructuresModel::Name))
    if (const std::string part = present(row); !part.empty())
      selected.push_back(part);
  const std::string current = present(m_list->currentIndex());
  QStringList folded;
  const auto nameOf = [](const QModelIndex& kind)
  { return kind.data().toString().section(" (", 0, 0); };
  for (int top = 0; top < m_structures->rowCount(); ++top)
    if (const QModelIndex kind = m_structures->index(top, 0);
        m_structures->rowCount(kind) > 0 && !m_list->isExpanded(kind))
      folded += nameOf(kind);
  m_structures->caseChanged();
  for (int top = 0; top < m_structures->rowCount(); ++top)
    if (const QModelIndex kind = m_structures->index(top, 0); m_structures->rowCount(kind) > 0)
      m_list->setExpanded(kind, another || !folded.contains(nameOf(kind)));
  if (!another)
  {
    if (const QModelIndex row = m_structures->rowOf(current); row.isValid())
      m_list->selectionModel()->setCurrentIndex(row, QItemSelectionModel::NoUpdate);
    QItemSelection again;
    for (const std::string& part : selected)
      if (const QModelIndex row = m_structures->rowOf(part); row.isValid())
        again.select(row, row);
    m_list->selectionModel()->select(again, QItemSelectionModel::ClearAndSelect |
                                                QItemSelectionModel::Rows);
  }
  filter();
}

// Numbers, check boxes and titles get what they need, and names all that is left.
void StructuresPanel::fitColumns()
{
  QHeaderView* header = m_list->header();
  for (int column = StructuresModel::VolumeColumn; column < m_structures->columnCount(); ++column)
  {
    constexpr int kBorder = 2; // px, of a section
    const QString title =
        m_structures->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
    int width = title.isEmpty() ? kTitleIcon : header->fontMetrics().horizontalAdvance(title);
    if (column == StructuresModel::Burr) // its texts come and go, and none is cut off
    {
      presenters::NearbyStructure far;
      far.distance = 20.0; // mm, farther ones are not listed
      width = std::max(width, header->fontMetrics().horizontalAdvance(distanceOf(far)));
    }
    width += 2 * kPadding + kBorder;
    QSet<QString> texts; // what reads the same is as wide, and check boxes read nothing
    for (int top = 0; top < m_structures->rowCount(); ++top)
      for (int row = 0; row < m_structures->rowCount(m_structures->index(top, 0)); ++row)
      {
        const QModelIndex cell = m_structures->index(row, column, m_structures->index(top, 0));
        const QString text = cell.data().toString();
        if (texts.contains(text))
          continue;
        texts.insert(text);
        width = std::max(width, m_list->sizeHintForIndex(cell).width());
      }
    header->resizeSection(column, width);
  }
  fitNames();
}

// The names take what the other columns leave, or as much more as the user gave them: they are
// elided before a column scrolls out of sight, though never so much that none can be read.
void StructuresPanel::fitNames()
{
  const QScopedValueRollback<bool> fitting(m_fitting, true);
  QHeaderView* header = m_list->header();
  const int others = header->length() - header->sectionSize(StructuresModel::Name);
  const int least = kSwatch + kLeastName * m_list->fontMetrics().averageCharWidth();
  header->resizeSection(StructuresModel::Name,
                        std::max({m_list->viewport()->width() - others, m_nameWidth, least}));
}

QString StructuresPanel::chosen() const
{
  return words(m_structures->nameAt(m_list->currentIndex()));
}

void StructuresPanel::offer(const QPoint& position)
{
  const QModelIndex cell = m_list->indexAt(position).siblingAtColumn(StructuresModel::Name);
  if (!cell.isValid())
    return;
  if (!m_list->selectionModel()->isSelected(cell))
    m_list->setCurrentIndex(cell);
  const QString name = words(m_structures->nameAt(cell));
  QMenu menu;
  for (QAction* action : m_actions)
    menu.addAction(action);
  QAction* thickness = nullptr;
  if (!name.isEmpty())
  {
    menu.addSeparator();
    thickness = menu.addAction((isOnMr() ? tr("Colour tissue by its thickness over %1")
                                         : tr("Colour bone by its thickness over %1"))
                                   .arg(shownName(bytes(name))));
    thickness->setCheckable(true);
    thickness->setChecked(m_model.thicknessOver() == bytes(name));
  }
  QAction* done = menu.exec(m_list->viewport()->mapToGlobal(position));
  if (done && done == thickness)
    emit thicknessAsked(name);
}

// The threshold, within the image's range and in its unit.
void StructuresPanel::showRange()
{
  const auto display =
      m_model.hasCase() ? presenters::displayOf(m_model.value()) : presenters::IntensityDisplay();
  m_bound.quietly(
      [&]
      {
        m_step = display.step;
        m_slider->setRange(static_cast<int>(std::floor(display.least / m_step)),
                           static_cast<int>(std::ceil(display.most / m_step)));
        m_box->setDecimals(display.decimals);
        m_box->setRange(display.least, display.most);
        m_box->setSingleStep(10.0 * m_step);
        m_box->setSuffix(words(display.suffix()));
      });
  m_threshold->setText(isOnMr() ? tr("S&urface threshold") : tr("&Bone threshold"));
  const QString tip =
      isOnMr() ? tr("The surface is where the MR gets brighter than this, in its own unit")
      : display.hounsfield ? tr("Bone is what is denser than this, in Hounsfield units (HU)")
                           : tr("Bone is what is denser than this, in the image's own unit: it is "
                                "not in Hounsfield units");
  m_slider->setToolTip(tip);
  m_slider->setAccessibleName(QString(m_threshold->text()).remove('&'));
  m_box->setToolTip(tip);
  m_bound.refresh();
}

bool StructuresPanel::isOnMr() const
{
  return m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr;
}

QWidget* StructuresPanel::mainControl()
{
  return m_list;
}

void StructuresPanel::caseChanged()
{
  m_bound.drop();
  m_search->clear();
  rebuild(true);
  showRange();
}

void StructuresPanel::partsChanged()
{
  rebuild(false);
  showRange();
}

void StructuresPanel::partRenamed(const std::string& from, const std::string& to)
{
  m_renamed.emplace_back(from, to);
  m_alone.renamed(from, to);
}

void StructuresPanel::appearanceChanged()
{
  if (m_structures->needsRebuild())
    rebuild(false);
  else
    m_structures->appearanceChanged();
  const auto parts = selectedParts();
  m_editor->refresh();
  m_only->setChecked(m_alone.isOn(parts));
  showRange();
}

void StructuresPanel::toolMeasured(const presenters::ToolSurroundings& near)
{
  if (!isVisible() || (near.isMeasured && !near.isWide))
    return;
  // Distances from where the tool was are none. A fault is said in the panel "Near the tool".
  m_structures->setNear(near.structures);
  if (m_list->isColumnHidden(StructuresModel::Burr))
  {
    m_list->setColumnHidden(StructuresModel::Burr, false);
    fitColumns();
  }
}

void StructuresPanel::toolGone()
{
  m_structures->setNear({});
  m_list->setColumnHidden(StructuresModel::Burr, true);
  fitColumns();
}

} // namespace petrous::workstation
