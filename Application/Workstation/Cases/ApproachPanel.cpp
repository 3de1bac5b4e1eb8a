#include "ApproachPanel.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QScopedValueRollback>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "StrokeThumbnails.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/Branches.h"

namespace petrous::workstation
{

namespace
{

using dissection::History;
using presenters::ApproachNode;
using Kind = ApproachNode::Kind;

enum Column
{
  Stroke,
  Removed,
  Time,
  Burr,
  Columns
};

constexpr int kState = Qt::UserRole;
constexpr int kApproach = Qt::UserRole + 1;
constexpr int kKind = Qt::UserRole + 2;

QString burrText(const dissection::Burr& burr)
{
  const bool isDiamond = burr.kind == dissection::Burr::Kind::Diamond;
  const QString name = !burr.name.empty() ? words(burr.name)
                       : isDiamond        ? ApproachPanel::tr("diamond")
                                          : ApproachPanel::tr("cutting");
  return ApproachPanel::tr("%1 mm %2").arg(numberText(burr.diameter, 1), name);
}

// In place of a picture that is not drawn yet: nothing that could be taken for one.
QPixmap waitingPicture(const QSize& size, const QPalette& palette)
{
  QPixmap picture(size);
  picture.fill(palette.color(QPalette::AlternateBase));
  QPainter painter(&picture);
  painter.setPen(palette.color(QPalette::Disabled, QPalette::WindowText));
  painter.drawText(picture.rect(), Qt::AlignCenter, QString::fromUtf8("…"));
  return picture;
}

QString injuryText(const dissection::StrokeInfo& info)
{
  QStringList lines;
  for (const auto& touched : info.structures)
    lines += ApproachPanel::tr("of %1 %2").arg(shownName(touched.name), volumeText(touched.volume));
  if (!info.startedAt.empty())
    lines.prepend(words(info.startedAt));
  if (info.recovered)
    lines += ApproachPanel::tr("recovered after the program had ended");
  return lines.join('\n');
}

} // namespace

ApproachPanel::ApproachPanel(const presenters::WorkstationModel& model,
                             StrokeThumbnails& thumbnails, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_thumbnails(thumbnails)
  , m_tree(new QTreeWidget)
  , m_line(new QSlider(Qt::Horizontal))
  , m_place(new QLabel)
{
  m_tree->setObjectName("approaches");
  m_tree->setAccessibleName(tr("Strokes of all approaches"));
  m_tree->setColumnCount(Columns);
  m_tree->setHeaderLabels({tr("Stroke"), tr("Removed"), tr("Time"), tr("Burr")});
  m_tree->setIconSize({StrokeThumbnails::kWidth, StrokeThumbnails::kHeight});
  m_tree->setIndentation(14);
  m_tree->setContextMenuPolicy(Qt::ActionsContextMenu);
  m_tree->setAutoScroll(true);
  m_tree->setExpandsOnDoubleClick(false);
  m_tree->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  m_tree->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  m_tree->header()->setStretchLastSection(true);
  m_tree->viewport()->installEventFilter(this);
  connect(m_tree, &QTreeWidget::currentItemChanged, this,
          [this](QTreeWidgetItem* item)
          {
            enable();
            if (item && !m_isFilling)
              go(item);
          });
  for (auto signal : {&QTreeWidget::itemExpanded, &QTreeWidget::itemCollapsed})
    connect(m_tree, signal, this, &ApproachPanel::wantThumbnails);
  connect(m_tree->verticalScrollBar(), &QScrollBar::valueChanged, this,
          &ApproachPanel::wantThumbnails);
  connect(&m_thumbnails, &StrokeThumbnails::drawn, this,
          [this](quint64 state)
          {
            for (QTreeWidgetItemIterator at(m_tree); *at; ++at)
              if ((*at)->data(Stroke, kKind).toInt() != static_cast<int>(Kind::Approach) &&
                  (*at)->data(Stroke, kState).toULongLong() == state)
                (*at)->setIcon(Stroke, QPixmap::fromImage(m_thumbnails.of(state)));
          });

  m_line->setObjectName("strokeLine");
  m_line->setAccessibleName(tr("Strokes of the present approach that are done"));
  m_line->setToolTip(tr("The strokes of the present approach: drag, or the arrow keys, to go back "
                        "and forth through them"));
  m_line->setTickPosition(QSlider::TicksBelow);
  m_line->setPageStep(5);
  connect(m_line, &QSlider::valueChanged, this, &ApproachPanel::slide);
  m_place->setObjectName("strokePlace");
  addActions();

  auto* line = new QHBoxLayout;
  line->addWidget(m_line, 1);
  line->addWidget(m_place);
  auto* buttons = new QHBoxLayout;
  for (QAction* action : {m_start, m_compare, m_rename, m_remove})
  {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    buttons->addWidget(button);
  }
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(10, 10, 10, 10);
  layout->addWidget(m_tree, 1);
  layout->addLayout(line);
  layout->addLayout(buttons);
  caseChanged();
}

void ApproachPanel::addActions()
{
  const auto make = [this](const QString& text, const QKeySequence& key, const char* name,
                           const QString& tip, auto what)
  {
    auto* action = new QAction(text, this);
    action->setObjectName(name);
    action->setShortcut(key);
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    action->setToolTip(
        key.isEmpty() ? tip : QString("%1 (%2)").arg(tip, key.toString(QKeySequence::NativeText)));
    connect(action, &QAction::triggered, this, what);
    addAction(action);
    m_tree->addAction(action);
    return action;
  };
  m_start = make(tr("&Branch here…"), {}, "startApproach",
                 tr("A new approach from the present state; the present one stays (Ctrl+B)"),
                 [this] { emit startAsked(); });
  m_compare = make(tr("&Compare"), {}, "compareApproach",
                   tr("The present approach with the chosen one, or with the one beside it: side "
                      "by side and as difference (Ctrl+D)"),
                   [this] { emit comparisonAsked(chosen()); });
  m_rename = make(tr("&Rename…"), Qt::Key_F2, "renameApproach", tr("Another name for the approach"),
                  [this] { emit renamingAsked(chosen()); });
  m_remove = make(tr("&Delete"), Qt::Key_Delete, "removeApproach",
                  tr("Takes the approach out of the case; Undo brings it back"),
                  [this] { emit removalAsked(chosen()); });
}

QWidget* ApproachPanel::mainControl()
{
  return m_tree;
}

void ApproachPanel::caseChanged()
{
  m_thumbnails.clear();
  m_shown.reset();
  stateChanged();
}

void ApproachPanel::partsChanged()
{
  appearanceChanged();
}

void ApproachPanel::appearanceChanged()
{
  m_thumbnails.clear();
  wantThumbnails();
}

void ApproachPanel::stateChanged()
{
  const std::uint64_t shown = m_model.hasCase() ? m_model.shownAs() : 0;
  const std::uint64_t changes =
      m_model.hasCase() ? m_model.value().dissection.changes() : std::uint64_t{0};
  if (m_shown == shown && changes == m_changes)
    return;
  m_shown = shown;
  m_changes = changes;
  fill();
  wantThumbnails();
}

void ApproachPanel::add(QTreeWidgetItem* above, const ApproachNode& node)
{
  auto* item = new QTreeWidgetItem;
  above ? above->addChild(item) : m_tree->addTopLevelItem(item);
  item->setData(Stroke, kState, static_cast<qulonglong>(node.state));
  item->setData(Stroke, kApproach, words(node.approach));
  item->setData(Stroke, kKind, static_cast<int>(node.kind));
  const scene::Case& value = m_model.value();
  const History::Branch& present = value.dissection.history().branch();
  switch (node.kind)
  {
  case Kind::Approach:
  {
    const auto summary = scene::summaryOf(value, node.state);
    const bool isPresent = node.approach == present.name;
    item->setText(Stroke,
                  (isPresent ? QString::fromUtf8("▶ ") : QString()) + approachName(node.approach));
    item->setText(Removed, volumeText(summary.removed));
    item->setText(Time, durationText(summary.duration));
    item->setText(Burr,
                  summary.strokes == 1 ? tr("1 stroke") : tr("%1 strokes").arg(summary.strokes));
    if (const auto* branch = value.dissection.history().find(node.approach);
        branch && branch->setAside)
      item->setToolTip(Stroke, tr("Set aside by drilling after an undo"));
    QFont font = item->font(Stroke);
    font.setBold(isPresent);
    item->setFont(Stroke, font);
    break;
  }
  case Kind::Start:
    item->setText(Stroke, tr("Untouched"));
    break;
  case Kind::Stroke:
  {
    const dissection::StrokeInfo& info = value.dissection.strokes()[node.state]->info;
    item->setText(Stroke, QString::number(dissection::strokeNumber(node.state)));
    item->setText(Removed, volumeText(info.removed));
    item->setText(Time, durationText(info.duration));
    item->setText(Burr, burrText(info.burr));
    if (info.speed)
      item->setToolTip(Burr, tr("Set to %1 turns a minute; by the pedal %2 on average, at most %3")
                                 .arg(numberText(info.burr.rpm, 0), numberText(info.speed->mean, 0),
                                      numberText(info.speed->max, 0)));
    item->setToolTip(Stroke, injuryText(info));
    if (!info.structures.empty())
      item->setForeground(Removed, harmColor());
    break;
  }
  }
  if (node.kind != Kind::Approach)
  {
    const QImage drawn = m_thumbnails.of(node.state);
    item->setIcon(Stroke, drawn.isNull() ? waitingPicture(m_tree->iconSize(), palette())
                                         : QPixmap::fromImage(drawn));
    if (!node.applied)
      for (int column = 0; column < Columns; ++column)
        item->setForeground(column, palette().color(QPalette::Disabled, QPalette::WindowText));
  }
  for (int column : {Removed, Time})
    item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  for (const ApproachNode& below : node.children)
    add(item, below);
}

void ApproachPanel::fill()
{
  const QScopedValueRollback<bool> filling(m_isFilling, true);
  QStringList collapsed;
  for (QTreeWidgetItemIterator at(m_tree); *at; ++at)
    if (!(*at)->isExpanded() && (*at)->childCount() > 0)
      collapsed += (*at)->data(Stroke, kApproach).toString();
  const int scrolled = m_tree->verticalScrollBar()->value();
  m_tree->clear();
  if (m_model.hasCase())
    for (const ApproachNode& node : presenters::approachTree(m_model.value().dissection.history()))
      add(nullptr, node);
  m_tree->expandAll();
  for (QTreeWidgetItemIterator at(m_tree); *at; ++at)
    if ((*at)->data(Stroke, kKind).toInt() == static_cast<int>(Kind::Approach) &&
        collapsed.contains((*at)->data(Stroke, kApproach).toString()))
      (*at)->setExpanded(false);
  m_tree->verticalScrollBar()->setValue(scrolled);
  showPresent();
}

// The row of the present state, and its place on the line.
void ApproachPanel::showPresent()
{
  const QSignalBlocker blocker(m_line);
  if (!m_model.hasCase())
  {
    m_line->setRange(0, 0);
    m_place->clear();
    return enable();
  }
  const History& history = m_model.value().dissection.history();
  const int strokes = static_cast<int>(history.applied() + history.ahead());
  m_line->setRange(0, strokes);
  m_line->setTickInterval(1);
  m_line->setValue(static_cast<int>(history.applied()));
  m_place->setText(tr("%1 of %2").arg(history.applied()).arg(strokes));
  if (QTreeWidgetItem* item = itemOf(words(history.branch().name), history.position()))
  {
    m_tree->setCurrentItem(item);
    m_tree->scrollToItem(item);
  }
  enable();
}

// A stroke that an earlier approach has, too, is in that one's rows; then the approach's own row.
QTreeWidgetItem* ApproachPanel::itemOf(const QString& approach, std::size_t state) const
{
  QTreeWidgetItem* own = nullptr;
  QTreeWidgetItem* any = nullptr;
  for (QTreeWidgetItemIterator at(m_tree); *at; ++at)
  {
    const bool isApproach = (*at)->data(Stroke, kKind).toInt() == static_cast<int>(Kind::Approach);
    const bool isOwn = (*at)->data(Stroke, kApproach).toString() == approach;
    const bool isThere = (*at)->data(Stroke, kState).toULongLong() == state;
    if (!isApproach && isOwn && isThere)
      return *at;
    if (isApproach && isOwn)
      own = *at;
    if (!isApproach && isThere && !any)
      any = *at;
  }
  return own ? own : any;
}

void ApproachPanel::go(QTreeWidgetItem* item)
{
  const QString approach = item->data(Stroke, kApproach).toString();
  const auto state = item->data(Stroke, kState).toULongLong();
  // Not from the tree's own signal: the rows are made anew.
  const bool isApproach = item->data(Stroke, kKind).toInt() == static_cast<int>(Kind::Approach);
  QMetaObject::invokeMethod(
      this,
      [this, approach, state, isApproach]
      { isApproach ? emit approachAsked(approach) : emit stateAsked(approach, state); },
      Qt::QueuedConnection);
}

void ApproachPanel::slide(int strokes)
{
  if (!m_model.hasCase())
    return;
  const History& history = m_model.value().dissection.history();
  const auto line = history.lineTo(history.branch().tip);
  const auto done = static_cast<std::size_t>(strokes);
  if (done <= line.size())
    emit stateAsked(words(history.branch().name), done == 0 ? History::kStart : line[done - 1]);
}

QString ApproachPanel::chosen() const
{
  const QTreeWidgetItem* item = m_tree->currentItem();
  return item ? item->data(Stroke, kApproach).toString() : QString();
}

void ApproachPanel::enable()
{
  const bool open = m_model.hasCase();
  const bool several = open && m_model.value().dissection.history().branches().size() > 1;
  m_start->setEnabled(open);
  m_rename->setEnabled(open && !chosen().isEmpty());
  m_remove->setEnabled(several && !chosen().isEmpty());
  m_compare->setEnabled(several);
}

// Of the rows that are seen.
void ApproachPanel::wantThumbnails()
{
  std::vector<std::size_t> states;
  if (m_model.hasCase() && isVisible() && !visibleRegion().isEmpty())
    for (QTreeWidgetItem* item = m_tree->itemAt(1, 1); item; item = m_tree->itemBelow(item))
    {
      const QRect row = m_tree->visualItemRect(item);
      if (row.top() > m_tree->viewport()->height())
        break;
      if (item->data(Stroke, kKind).toInt() != static_cast<int>(Kind::Approach))
        states.push_back(item->data(Stroke, kState).toULongLong());
    }
  m_thumbnails.want(std::move(states));
}

void ApproachPanel::showEvent(QShowEvent* event)
{
  Panel::showEvent(event);
  QMetaObject::invokeMethod(this, &ApproachPanel::wantThumbnails, Qt::QueuedConnection);
}

bool ApproachPanel::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Resize)
    QMetaObject::invokeMethod(this, &ApproachPanel::wantThumbnails, Qt::QueuedConnection);
  return Panel::eventFilter(watched, event);
}

} // namespace petrous::workstation
