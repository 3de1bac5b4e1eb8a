#pragma once

#include <QComboBox>

namespace petrous::workstation
{

/// A choice whose width follows its entries and its letters whenever either changes. Qt's own keeps
/// the width that it had when it was first shown, or is as wide as its longest entry. The list that
/// it opens is as wide as all entries.
class FittedBox : public QComboBox
{
public:
  explicit FittedBox(QWidget* parent = nullptr);

  /// As wide as the longest of the first `rows` entries; 0, as at first: as the one that is shown.
  /// To be called again when the entries change.
  void fit(int rows);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }
  void showPopup() override;

private:
  int m_rows = 0;
};

} // namespace petrous::workstation
