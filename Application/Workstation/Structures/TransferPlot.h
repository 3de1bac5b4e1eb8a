#pragma once

#include <optional>
#include <utility>

#include <QPainterPath>
#include <QWidget>

#include "petrous/Presenters/AppearanceEditor.h"

namespace petrous::workstation
{

/// The transfer functions of an AppearanceEditor over the histograms of the image that they read:
/// intensity to the right, opacity of 1 mm upwards (presenters::OpacityAxis). The selected part's
/// points can be moved by mouse and keys.
class TransferPlot : public QWidget
{
  Q_OBJECT
public:
  explicit TransferPlot(presenters::AppearanceEditor& editor, QWidget* parent = nullptr);

  void refresh(); ///< call after the editor changed
  void showAll(); ///< the whole axis

  /// Where a point of these values lies, in pixels of the widget.
  QPointF positionOf(double value, double opacity) const;
  double valueAt(double x) const;
  double opacityAt(double y) const;

  QSize sizeHint() const override { return {440, 300}; }
  QSize minimumSizeHint() const override { return {240, 170}; }

signals:
  void changed();    ///< the selection, or the selected part
  void colorAsked(); ///< of the selected point
  void copyAsked();
  void pasteAsked();

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  bool event(QEvent* event) override;

private:
  using Part = presenters::AppearanceEditor::Part;
  struct Drag
  {
    appearance::ControlPoint before;
    QPointF pressed;
    QPointF offset; ///< from the pointer to the point
    bool moved = false;
  };

  QRectF area() const;
  QRectF strip() const; ///< of the colours, below the area
  void setView(double least, double most);
  void zoom(double factor, double x);
  void pan(double pixels);
  std::optional<std::size_t> pointAt(const QPointF& position) const;
  const Part* curveAt(const QPointF& position) const;
  void moveTo(const QPointF& position, bool alongOneAxis);
  void nudge(double steps, double heights);
  void stepPoint(int step);
  QString pointText(std::size_t point) const;
  QPainterPath curve(const Part& part) const;
  QPainterPath histogram(const volume::IntensityHistogram& counts) const;
  QLinearGradient colors(const Part& part, double opacity) const;
  void paintAxes(QPainter& painter) const;
  void paintSelected(QPainter& painter, const Part& part) const;
  void announce();

  presenters::AppearanceEditor& m_editor;
  presenters::AppearanceEditor::Axis m_axis;
  double m_least = 0.0; // of what is seen
  double m_most = 1.0;
  bool m_isWhole = true; // the whole axis is seen
  std::optional<Drag> m_drag;
  std::optional<QPointF> m_panned; // where the pointer was
  std::string m_hovered;           // part under the pointer
};

} // namespace petrous::workstation
