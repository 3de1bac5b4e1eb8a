#include "FittedBox.h"

#include <algorithm>

#include <QAbstractItemView>
#include <QFontMetrics>
#include <QStyle>
#include <QStyleOptionComboBox>

namespace petrous::workstation
{

FittedBox::FittedBox(QWidget* parent)
  : QComboBox(parent)
{
  connect(this, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this] { updateGeometry(); });
}

void FittedBox::fit(int rows)
{
  m_rows = rows;
  updateGeometry();
}

QSize FittedBox::sizeHint() const
{
  QStyleOptionComboBox option;
  initStyleOption(&option);
  const QFontMetrics metrics(font());
  int width = m_rows == 0 ? metrics.horizontalAdvance(currentText()) : 0;
  for (int row = 0; row < std::min(m_rows, count()); ++row)
    width = std::max(width, metrics.horizontalAdvance(itemText(row)));
  const QSize text(width + metrics.horizontalAdvance('x'), metrics.height());
  return {style()->sizeFromContents(QStyle::CT_ComboBox, &option, text, this).width(),
          QComboBox::sizeHint().height()};
}

void FittedBox::showPopup()
{
  view()->setMinimumWidth(view()->sizeHintForColumn(0) +
                          style()->pixelMetric(QStyle::PM_ScrollBarExtent, nullptr, view()));
  QComboBox::showPopup();
}

} // namespace petrous::workstation
