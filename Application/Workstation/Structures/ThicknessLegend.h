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
  const QString& structure() const noexcept { return m_structure; }

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  QString m_structure;
  bool m_isOnMr = false;
};

} // namespace petrous::workstation
