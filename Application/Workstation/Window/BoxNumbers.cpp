#include "BoxNumbers.h"

#include <algorithm>

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>

#include "Bind.h"

namespace petrous::workstation
{

namespace
{
constexpr double kUsualStep = 1.0; // mm
}

BoxNumbers::BoxNumbers(QWidget* parent)
  : QWidget(parent)
{
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  const QString axes[] = {tr("&x, to the left"), tr("&y, to the back"), tr("&z, to the head")};
  const QString tips[] = {tr("Where the box begins"), tr("Where the box ends")};
  for (int axis = 0; axis < 3; ++axis)
  {
    auto* label = new QLabel(axes[axis]);
    grid->addWidget(label, axis, 0);
    for (int end = 0; end < 2; ++end)
    {
      const QByteArray name = QString("%1%2").arg("xyz"[axis]).arg(end).toLatin1();
      QDoubleSpinBox* number =
          numberBox(name.constData(), tips[end], {0.0, 99.9, tr(" mm"), 1, kUsualStep, {}, true});
      number->setEnabled(false);
      m_numbers[static_cast<std::size_t>(2 * axis + end)] = number;
      grid->addWidget(number, axis, 1 + end);
      if (end == 0)
        label->setBuddy(number);
      connect(number, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
              [this, axis, end](double value)
              {
                core::PatientBox changed = m_box;
                (end == 0 ? changed.min() : changed.max())[axis] = value;
                emit edited(changed);
              });
    }
  }
  grid->setColumnStretch(3, 1);
  setFocusProxy(m_numbers.front());
}

void BoxNumbers::setBounds(const core::PatientBox& bounds)
{
  for (std::size_t n = 0; n < m_numbers.size(); ++n)
  {
    const auto axis = static_cast<Eigen::Index>(n / 2);
    const QSignalBlocker blocker(m_numbers[n]);
    m_numbers[n]->setRange(bounds.min()[axis] - 0.05, bounds.max()[axis] + 0.05);
    m_numbers[n]->setEnabled(true);
  }
}

void BoxNumbers::setSteps(const Eigen::Vector3d& least)
{
  for (std::size_t n = 0; n < m_numbers.size(); ++n)
    m_numbers[n]->setSingleStep(std::max(kUsualStep, least[static_cast<Eigen::Index>(n / 2)]));
}

void BoxNumbers::setBox(const core::PatientBox& box)
{
  m_box = box;
  for (std::size_t n = 0; n < m_numbers.size(); ++n)
  {
    const QSignalBlocker blocker(m_numbers[n]);
    const auto axis = static_cast<Eigen::Index>(n / 2);
    m_numbers[n]->setValue(n % 2 == 0 ? box.min()[axis] : box.max()[axis]);
  }
}

} // namespace petrous::workstation
