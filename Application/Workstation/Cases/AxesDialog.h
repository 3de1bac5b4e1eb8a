#pragma once

#include <array>

#include <QDialog>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Scene/Case.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace petrous::workstation
{

class SliceView;

/// Where left, back and head of the open case's primary image really are, with its slices as they
/// will be: `petrous correct-axes`.
class AxesDialog : public QDialog
{
  Q_OBJECT
public:
  /// Reads the image's voxels.
  explicit AxesDialog(const scene::Case& value, QWidget* parent = nullptr);

  const core::AxesCorrection& axes() const noexcept { return m_axes; }

private:
  void choose(std::size_t axis, char letter);
  void exchange(char one, char other);
  void setAxes(const core::AxesCorrection& axes);

  scene::Case m_image; ///< the case without anything but its primary image
  core::AxesCorrection m_axes;
  std::array<QComboBox*, 3> m_choices{};
  std::array<SliceView*, 3> m_views{};
  QLabel* m_kind;
  QPushButton* m_apply;
};

} // namespace petrous::workstation
