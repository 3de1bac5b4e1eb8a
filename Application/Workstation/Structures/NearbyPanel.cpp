#include "NearbyPanel.h"

#include <QHeaderView>
#include <QLabel>
#include <QTreeView>
#include <QVBoxLayout>

#include "NearbyModel.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

NearbyPanel::NearbyPanel(presenters::WorkstationModel& model, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_structures(new NearbyModel(this))
  , m_removed(new QLabel)
  , m_line(new QLabel)
{
  auto* list = new QTreeView;
  list->setObjectName("nearby");
  list->setAccessibleName(tr("Structures near the tool"));
  list->setModel(m_structures);
  list->setRootIsDecorated(false);
  list->setUniformRowHeights(true);
  list->setSelectionMode(QAbstractItemView::NoSelection);
  list->setFocusPolicy(Qt::TabFocus); // a click leaves the keys to the view
  list->header()->setSectionsMovable(false);
  list->header()->setSectionResizeMode(NearbyModel::Name, QHeaderView::ResizeToContents);
  list->header()->setSectionResizeMode(NearbyModel::Distance, QHeaderView::ResizeToContents);
  list->header()->setSectionResizeMode(NearbyModel::Note, QHeaderView::Stretch);
  list->header()->setStretchLastSection(false);
  m_removed->setObjectName("removed");
  m_line->setObjectName("dim");
  m_line->setWordWrap(true); // where it has room: the panel fits the smallest screen
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  for (QLabel* label : {m_removed, m_line})
    label->setContentsMargins(10, 6, 10, 6);
  layout->addWidget(m_removed);
  layout->addWidget(list, 1);
  layout->addWidget(m_line);
  setMinimumWidth(280);
  toolGone();
}

void NearbyPanel::say(const QString& line)
{
  m_line->setText(line);
  m_line->setVisible(!line.isEmpty());
}

void NearbyPanel::caseChanged()
{
  toolGone();
  stateChanged();
}

void NearbyPanel::stateChanged()
{
  if (!m_model.hasCase())
    m_removed->clear();
  else if (isVisible())
    showRemoved();
}

// Includes the open stroke.
void NearbyPanel::showRemoved()
{
  const scene::Case& value = m_model.value();
  const auto& open = m_model.strokeSoFar();
  const std::size_t strokes = value.applied() + (open.total > 0.0 ? 1 : 0);
  QString text = tr("Removed: %1 mm³ in %2 %3")
                     .arg(numberText(value.removedVolume() + open.total, 1))
                     .arg(strokes)
                     .arg(strokes == 1 ? tr("stroke") : tr("strokes"));
  for (const auto& [name, volume] : presenters::injuredVolumes(value, open))
    text += tr("\nInjured: %1, %2")
                .arg(shownName(name))
                .arg(numberText(presenters::cubicMillimetres(volume)));
  m_removed->setText(text);
}

void NearbyPanel::toolMoved(const presenters::MeasuredTool& /*tool*/, const haptics::Pose& /*pose*/)
{
  m_hasBurr = true;
}

void NearbyPanel::toolMeasured(const presenters::ToolSurroundings& near)
{
  if (!isVisible())
    return;
  showRemoved();
  if (!near.fault.empty())
  {
    m_structures->show({});
    return say(tr("The structures cannot be measured: %1").arg(phrase(near.fault)));
  }
  if (!near.isMeasured)
  {
    m_structures->show({});
    return say(tr("Measuring the structures…"));
  }
  if (!near.isWide) // of what is warned of alone
    return;
  const QString unmeasured = phrase(near.unmeasured);
  const QString none = near.isInstrument
                           ? tr("No structure that is shown lies within %1 mm of the instrument")
                           : tr("No structure that is shown lies within %1 mm of the burr");
  say(near.structures.empty() && unmeasured.isEmpty()
          ? none.arg(numberText(presenters::WorkstationModel::kNear, 0))
          : unmeasured);
  m_structures->show(near.structures);
}

void NearbyPanel::toolGone()
{
  m_hasBurr = false;
  m_structures->show({});
  say(tr("Take up the burr (D) or an instrument to see how far the structures are from it"));
}

void NearbyPanel::showEvent(QShowEvent* event)
{
  QWidget::showEvent(event);
  stateChanged();
}

void NearbyPanel::hideEvent(QHideEvent* event)
{
  QWidget::hideEvent(event);
  const bool needed = m_hasBurr; // for warnings
  toolGone();
  if (!needed)
    m_model.forgetNearby();
}

} // namespace petrous::workstation
