#pragma once

#include <QWidget>

namespace petrous::workstation
{

/// Colour scale of bone thickness over a structure, in the upper left corner of a view. Transparent
/// to mouse events.
class ThicknessLegend : public QWidget
{
  Q_OBJECT
public:
  /// `view`: the widget that it overlays.
  explicit ThicknessLegend(QWidget& view);

  /// Empty: hidden. `onMr`: it is tissue that is coloured.
  void setStructure(const QString& name, bool onMr);
  /// Of measuring; 1: it is done. Takes a share of the scale's place.
  void setProgress(double fraction);
  const QString& structure() const noexcept { return m_structure; }

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  QString m_structure;
  bool m_isOnMr = false;
  double m_progress = 1.0;
};

} // namespace petrous::workstation
