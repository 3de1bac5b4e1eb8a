#pragma once

#include <optional>

#include <QImage>
#include <QWidget>

#include "petrous/Core/CameraPose.h"

namespace petrous::workstation
{

class ThreeDView;

/// A still over the 3D view, as high as the view, while the view is the still's own: turned away,
/// it is hidden. Takes no events.
class StillOverlay : public QWidget
{
  Q_OBJECT
public:
  explicit StillOverlay(ThreeDView& view);

  /// nullopt: none.
  void setStill(const QImage& still, const std::optional<core::CameraPose>& camera, double opacity);
  bool isOver() const noexcept { return m_isOver; } ///< the view is the still's

signals:
  void overChanged();

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

private:
  void follow();

  ThreeDView& m_view;
  QImage m_still;
  std::optional<core::CameraPose> m_camera;
  double m_opacity = 0.5;
  bool m_isOver = false;
};

} // namespace petrous::workstation
