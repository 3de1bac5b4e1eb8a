#pragma once

#include <QDialog>

#include "petrous/Presenters/BoxHandles.h"

class QLabel;

namespace petrous::workstation
{

class BoxNumbers;

/// The crop box of the open case in numbers.
class CropBoxDialog : public QDialog
{
  Q_OBJECT
public:
  explicit CropBoxDialog(QWidget* parent);

  void show(const presenters::CropFrame& frame, const Eigen::AlignedBox3d& box);

protected:
  void showEvent(QShowEvent* event) override;

signals:
  void edited(const Eigen::AlignedBox3d& box); ///< mm, in the frame that was shown
  void wholeAsked();

private:
  BoxNumbers* m_numbers;
  QLabel* m_size;
};

} // namespace petrous::workstation
