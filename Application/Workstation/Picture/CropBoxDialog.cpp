#include "CropBoxDialog.h"

#include <QAbstractSpinBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QShowEvent>
#include <QVBoxLayout>

#include "Bind.h"
#include "BoxNumbers.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

CropBoxDialog::CropBoxDialog(QWidget* parent)
  : QDialog(parent)
  , m_numbers(new BoxNumbers)
  , m_size(new QLabel)
{
  setObjectName("cropBoxDialog");
  setWindowTitle(tr("Crop box"));
  m_size->setObjectName("cropSize");
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  QPushButton* whole = button(tr("&Whole image"), "wholeImage",
                              tr("All of the image is shown again; clipping planes stay"));
  whole->setAutoDefault(false);
  buttons->button(QDialogButtonBox::Close)->setAutoDefault(false);
  buttons->addButton(whole, QDialogButtonBox::ActionRole);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(m_numbers);
  layout->addWidget(m_size);
  layout->addWidget(buttons);
  connect(m_numbers, &BoxNumbers::edited, this, &CropBoxDialog::edited);
  connect(whole, &QPushButton::clicked, this, &CropBoxDialog::wholeAsked);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
}

// With the first number to be typed over.
void CropBoxDialog::showEvent(QShowEvent* event)
{
  QDialog::showEvent(event);
  if (event->spontaneous())
    return;
  m_numbers->setFocus();
  if (auto* number = qobject_cast<QAbstractSpinBox*>(m_numbers->focusProxy()))
    number->selectAll();
}

void CropBoxDialog::show(const presenters::CropFrame& frame, const Eigen::AlignedBox3d& box)
{
  m_numbers->setBounds(frame.bounds());
  // Faces lie at voxel centres: less than a voxel may be no step.
  m_numbers->setSteps(frame.box(core::IndexBox{{0, 0, 0}, {2, 2, 2}}).box.sizes());
  m_numbers->setBox(box);
  m_size->setText(boxSizeText(box.sizes()));
  QDialog::show();
}

} // namespace petrous::workstation
