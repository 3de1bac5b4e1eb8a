#pragma once

#include <algorithm>

#include <QLineEdit>

namespace petrous::workstation
{

/// A line that is never narrower than the hint in it, its placeholder, whatever the letters' size.
class HintedLine : public QLineEdit
{
public:
  using QLineEdit::QLineEdit;

  QSize sizeHint() const override { return widened(QLineEdit::sizeHint()); }
  QSize minimumSizeHint() const override { return widened(QLineEdit::minimumSizeHint()); }

private:
  QSize widened(const QSize& size) const
  {
    // QLineEdit's is that of the widest letter, with all that is about the text.
    const int beside = QLineEdit::minimumSizeHint().width() - fontMetrics().maxWidth();
    const int whole = fontMetrics().horizontalAdvance(placeholderText()) + beside;
    return {std::max(size.width(), whole), size.height()};
  }
};

} // namespace petrous::workstation
