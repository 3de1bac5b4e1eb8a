#include "ViewArea.h"

#include <algorithm>

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>

#include "PanelLayout.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "ThreeDView.h"

namespace petrous::workstation
{

namespace
{

using presenters::ViewLayout;
using presenters::ViewPane;

constexpr int kLeastWidth = 420; // px, of all views
constexpr int kLeastHeight = 360;
constexpr int kGrip = 4; // px on either side of a gap where it can be taken

QRect rectOf(const presenters::ViewRect& rect)
{
  return {rect.left, rect.top, rect.width, rect.height};
}

} // namespace

ViewArea::ViewArea(ThreeDView& view, SliceColumn& slices, QWidget* parent)
  : QWidget(parent)
  , m_view(view)
  , m_slices(slices)
{
  setObjectName("viewArea");
  setMinimumSize(leastOfScreen(*this, {kLeastWidth, kLeastHeight}));
  m_slices.setParent(this);
  m_slices.show();
  m_view.setParent(this); // above the slices' widget, which covers the whole area
  for (const ViewPane pane :
       {ViewPane::ThreeD, ViewPane::Axial, ViewPane::Coronal, ViewPane::Sagittal})
    widget(pane).setMinimumSize(1, 1); // the arrangement decides
}

QWidget& ViewArea::widget(ViewPane pane) const
{
  return pane == ViewPane::ThreeD
             ? static_cast<QWidget&>(m_view)
             : static_cast<QWidget&>(*m_slices.views()[static_cast<std::size_t>(pane) - 1]);
}

void ViewArea::setArrangement(const presenters::ViewArrangement& arrangement)
{
  m_arrangement = arrangement;
  place();
}

void ViewArea::setLayout(ViewLayout layout)
{
  if (layout == ViewLayout::OneSlice)
    m_arrangement.setLarge(focusedPane());
  m_arrangement.setLayout(layout);
  place();
  emit arrangementChanged();
}

void ViewArea::toggleEnlarged(ViewPane pane)
{
  m_arrangement.toggleEnlarged(pane);
  place();
  widget(pane).setFocus();
  emit arrangementChanged();
}

void ViewArea::focusView()
{
  for (const ViewPane pane :
       {ViewPane::ThreeD, ViewPane::Axial, ViewPane::Coronal, ViewPane::Sagittal})
    if (!widget(pane).isHidden())
      return widget(pane).setFocus();
}

// Esc comes here where no tool takes it. What is drilled or dragged goes on in the place where it
// began.
void ViewArea::keyPressEvent(QKeyEvent* event)
{
  const bool isLeft = event->key() == Qt::Key_Escape && event->modifiers() == Qt::NoModifier &&
                      m_arrangement.enlarged() && !m_view.tool().GetDrilling() &&
                      QApplication::mouseButtons() == Qt::NoButton;
  if (!isLeft)
    return QWidget::keyPressEvent(event);
  toggleEnlarged(*m_arrangement.enlarged());
}

ViewPane ViewArea::focusedPane() const
{
  const auto& views = m_slices.views();
  for (std::size_t n = 0; n < views.size(); ++n)
    if (views[n]->hasFocus())
      return static_cast<ViewPane>(n + 1);
  return ViewPane::ThreeD;
}

void ViewArea::setCovered(int pixels)
{
  m_covered = pixels;
  keepUncovered();
}

void ViewArea::keepUncovered()
{
  const auto share = [this](const QWidget& view)
  { return std::clamp(m_covered - view.mapTo(this, QPoint(0, 0)).y(), 0, view.height() / 2); };
  m_view.setCovered(share(m_view));
  for (SliceView* slice : m_slices.views())
    slice->setCovered(share(*slice));
}

void ViewArea::place()
{
  const auto panes = m_arrangement.panes(width(), height());
  m_slices.setGeometry(rect());
  QWidget* focused = QApplication::focusWidget();
  QWidget* first = nullptr;
  for (std::size_t n = 0; n < panes.size(); ++n)
  {
    QWidget& pane = widget(static_cast<ViewPane>(n));
    if (panes[n])
      pane.setGeometry(rectOf(*panes[n]));
    if (panes[n] && !first)
      first = &pane;
  }
  // Shown before others are hidden, so that the focus stays among the views.
  for (std::size_t n = 0; n < panes.size(); ++n)
    if (panes[n])
      widget(static_cast<ViewPane>(n)).show();
  for (std::size_t n = 0; n < panes.size(); ++n)
  {
    QWidget& pane = widget(static_cast<ViewPane>(n));
    if (panes[n])
      continue;
    if (focused == &pane && first)
      first->setFocus();
    pane.hide();
  }
  m_view.raise();
  placeDividers();
  keepUncovered();
}

void ViewArea::placeDividers()
{
  const auto dividers = m_arrangement.dividers(width(), height());
  while (m_dividers.size() < dividers.size())
  {
    auto* divider = new QWidget(this);
    divider->setObjectName(QString("viewDivider%1").arg(m_dividers.size()));
    divider->installEventFilter(this);
    m_dividers.push_back(divider);
  }
  for (std::size_t n = 0; n < m_dividers.size(); ++n)
  {
    QWidget* divider = m_dividers[n];
    divider->setVisible(n < dividers.size());
    if (n >= dividers.size())
      continue;
    const bool isVertical = dividers[n].isVertical;
    divider->setGeometry(rectOf(dividers[n].gap)
                             .adjusted(isVertical ? -kGrip : 0, isVertical ? 0 : -kGrip,
                                       isVertical ? kGrip : 0, isVertical ? 0 : kGrip));
    divider->setCursor(isVertical ? Qt::SplitHCursor : Qt::SplitVCursor);
    divider->raise();
  }
}

void ViewArea::resizeEvent(QResizeEvent*)
{
  place();
}

bool ViewArea::eventFilter(QObject* watched, QEvent* event)
{
  const auto found = std::find(m_dividers.begin(), m_dividers.end(), watched);
  const auto dividers = m_arrangement.dividers(width(), height());
  const auto n = static_cast<std::size_t>(found - m_dividers.begin());
  if (found == m_dividers.end() || n >= dividers.size())
    return QWidget::eventFilter(watched, event);
  if (event->type() == QEvent::MouseButtonDblClick)
  {
    m_arrangement.resetSplits();
    place();
    emit arrangementChanged();
    return true;
  }
  const auto* mouse = static_cast<QMouseEvent*>(event);
  if (event->type() != QEvent::MouseMove || !(mouse->buttons() & Qt::LeftButton))
    return QWidget::eventFilter(watched, event);
  const QPoint at = (*found)->mapTo(this, mouse->pos());
  m_arrangement.moveSplit(dividers[n].split, dividers[n].isVertical
                                                 ? double(at.x()) / std::max(width(), 1)
                                                 : double(at.y()) / std::max(height(), 1));
  place();
  emit arrangementChanged();
  return true;
}

} // namespace petrous::workstation
