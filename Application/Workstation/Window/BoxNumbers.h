#pragma once

#include <array>

#include <QWidget>

#include "petrous/Core/PatientBox.h"

class QDoubleSpinBox;

namespace petrous::workstation
{

/// The faces of a box in numbers: from and to, in mm, along axes to the left, the back and the
/// head. Disabled until it has a range.
class BoxNumbers : public QWidget
{
  Q_OBJECT
public:
  explicit BoxNumbers(QWidget* parent = nullptr);

  void setBounds(const core::PatientBox& bounds);
  /// Of a key or the wheel along each axis: 1 mm, or `least` mm where that is more.
  void setSteps(const Eigen::Vector3d& least);
  void setBox(const core::PatientBox& box); ///< emits nothing
  const core::PatientBox& box() const noexcept { return m_box; }

signals:
  void edited(const petrous::core::PatientBox& box); ///< one number of it, as it was entered

private:
  core::PatientBox m_box;
  std::array<QDoubleSpinBox*, 6> m_numbers; ///< from and to, of x, y and z
};

} // namespace petrous::workstation
