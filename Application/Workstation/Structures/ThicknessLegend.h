#pragma once

#include <QWidget>

namespace petrous::workstation
{

/// The scale of bone's thickness over a structure, in the upper left corner of a view. Lets every
/// click through.
class ThicknessLegend : public QWidget
{
  Q_OBJECT
public:
  /// `view` is what it lies over.
  explicit ThicknessLegend(QWidget& view);

  void setStructure(const QString& name); ///< empty: hidden
  const QString& structure() const noexcept { return m_structure; }

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  QString m_structure;
};

} // namespace petrous::workstation
