#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <QImage>
#include <QWidget>

namespace petrous::workstation
{

/// A landmark in a still.
struct StillMark
{
  Eigen::Vector2d at{0.0, 0.0};          ///< pixels from the upper left corner
  std::optional<Eigen::Vector2d> seenAt; ///< where the camera that was found sees its point
  bool isBad = false;
};

/// The frame that is seen, with its landmarks. The wheel magnifies it where the pointer is; a click
/// with the left button points to a place, the right one moves the magnified picture. By keys:
/// arrows move a cross (with Shift by ten pixels), Return points there, + and - magnify.
class VideoPicture : public QWidget
{
  Q_OBJECT
public:
  explicit VideoPicture(QWidget* parent = nullptr);

  void setFrame(const QImage& frame); ///< null: none, then `text` is shown
  void setText(const QString& text);
  void setMarks(const std::vector<StillMark>& marks, std::optional<Eigen::Vector2d> next);
  const QImage& frame() const noexcept { return m_frame; }

  QSize sizeHint() const override;

signals:
  void pointed(const Eigen::Vector2d& pixel);

protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  double scale() const; // of the widget's pixels a pixel of the frame
  QPointF place(const Eigen::Vector2d& pixel) const;
  Eigen::Vector2d pixelAt(const QPointF& position) const;
  void magnify(double factor, const QPointF& around);
  void keepInside();

  QImage m_frame;
  QString m_text;
  std::vector<StillMark> m_marks;
  std::optional<Eigen::Vector2d> m_next;
  std::optional<Eigen::Vector2d> m_cross; // of the keys
  Eigen::Vector2d m_middle{0.0, 0.0};     // pixel in the middle of the widget
  double m_zoom = 1.0;
  QPointF m_pressed;
  bool m_isClick = false;
};

} // namespace petrous::workstation
