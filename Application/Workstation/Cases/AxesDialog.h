#pragma once

#include <array>
#include <optional>
#include <string>

#include <QDialog>
#include <QString>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Presenters/CorrectedCase.h"
#include "petrous/Scene/Case.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace petrous::workstation
{

class SliceView;

/// A mistake of a file that is frequent.
struct CommonCorrection
{
  QString text, tip; ///< of a button; translated
  const char* name;  ///< of the button
  core::AxesCorrection axes;
};
std::array<CommonCorrection, 3> commonCorrections();

/// Where left, back and head of the open case's primary image really are, with its slices as they
/// will be: `petrous correct-axes`. Or of an MR, a structure's label map or a mesh of the case,
/// with the image on which it was drawn: with `--part`.
class AxesDialog : public QDialog
{
  Q_OBJECT
public:
  /// Reads the image's voxels, and those of `part`; empty: the primary image.
  explicit AxesDialog(const scene::Case& value, QWidget* parent = nullptr, std::string part = {});

  const core::AxesCorrection& axes() const noexcept { return m_axes; }

private:
  void choose(std::size_t axis, char letter);
  void showOnly(const scene::Case& value, const presenters::AxesPart& part);
  void showImage(const scene::Case& value, const std::string& image);
  void setAxes(const core::AxesCorrection& axes);

  scene::Case m_image; ///< the case without anything but the image, and what is corrected on it
  std::optional<presenters::AxesPart> m_part; ///< a structure or a mesh of m_image; or the image
  core::AxesCorrection m_axes;
  std::array<QComboBox*, 3> m_choices{};
  std::array<SliceView*, 3> m_views{};
  QLabel* m_kind;
  QPushButton* m_apply;
};

} // namespace petrous::workstation
