#pragma once

#include <vector>

#include <QWidget>

#include "petrous/Presenters/ViewArrangement.h"

namespace petrous::workstation
{

class SliceColumn;
class ThreeDView;

/// The 3D view and the slices in one of the layouts, divided by gaps that can be dragged; a double
/// click on a gap puts it back. No view changes its parent, so that the 3D view keeps its OpenGL
/// context.
class ViewArea : public QWidget
{
  Q_OBJECT
public:
  /// Takes ownership of both.
  ViewArea(ThreeDView& view, SliceColumn& slices, QWidget* parent = nullptr);

  const presenters::ViewArrangement& arrangement() const noexcept { return m_arrangement; }
  void setArrangement(const presenters::ViewArrangement& arrangement);
  /// OneSlice shows the slice with the keyboard focus large, if one has it.
  void setLayout(presenters::ViewLayout layout);
  void toggleEnlarged(presenters::ViewPane pane);
  /// Gives the keyboard to the 3D view, or where that is not shown to the first slice that is.
  void focusView();
  presenters::ViewPane focusedPane() const; ///< the 3D view if no slice has the focus
  QWidget& widget(presenters::ViewPane pane) const;

  /// Pixels from the upper edge of the area that are covered: what stands there in a view is placed
  /// below.
  void setCovered(int pixels);

signals:
  void arrangementChanged();

protected:
  void resizeEvent(QResizeEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override; ///< of the views, what they leave over
  bool eventFilter(QObject* watched, QEvent* event) override; ///< of the dividers

private:
  void place();
  void placeDividers();
  void keepUncovered();

  ThreeDView& m_view;
  SliceColumn& m_slices;
  presenters::ViewArrangement m_arrangement;
  int m_covered = 0; // px
  std::vector<QWidget*> m_dividers;
};

} // namespace petrous::workstation
