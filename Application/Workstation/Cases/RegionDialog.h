#pragma once

#include <array>
#include <memory>
#include <optional>

#include <QDialog>

#include "SliceView.h"
#include "petrous/Core/PatientBox.h"
#include "petrous/Presenters/SeriesPreview.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace petrous::workstation
{

class PreviewBar;

/// A slice with a box whose edges can be dragged; dragged inside, it moves.
class RegionView : public SliceView
{
  Q_OBJECT
public:
  explicit RegionView(presenters::SliceOrientation orientation, QWidget* parent = nullptr);

  /// Patient LPS mm; `bounds`: where it may lie.
  void setBox(const core::PatientBox& box, const core::PatientBox& bounds);

signals:
  void boxDragged(const petrous::core::PatientBox& box);

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

private:
  /// The sides of the box at a place of the view; all if it is inside.
  void pick(const QPointF& position);
  Eigen::Vector3d at(const QPointF& position) const;

  core::PatientBox m_box;
  core::PatientBox m_bounds;
  std::array<bool, 3> m_lower{}; // sides that are dragged, by patient axis
  std::array<bool, 3> m_upper{};
  Eigen::Vector3d m_from = Eigen::Vector3d::Zero();
};

/// Three slices of a scan before it is read, and the region of it to be read: `petrous new --roi`.
class RegionDialog : public QDialog
{
  Q_OBJECT
public:
  /// `selector`: imaging::chooseSeries; `assumeRas`, `unit`: presenters::CaseSources.
  RegionDialog(const std::filesystem::path& path, const std::string& selector, bool repair,
               const std::optional<bool>& assumeRas = {}, const std::optional<double>& unit = {},
               QWidget* parent = nullptr);

  /// Patient LPS mm; nullopt: all of it.
  std::optional<core::PatientBox> region() const;
  bool isPictured() const noexcept { return m_preview != nullptr; }

private:
  void show(std::shared_ptr<const presenters::ScanPreview> preview);
  void setBox(core::PatientBox box);

  std::shared_ptr<const presenters::ScanPreview> m_preview;
  core::PatientBox m_box;
  std::array<RegionView*, 3> m_views;
  std::array<QDoubleSpinBox*, 6> m_numbers; ///< from and to, of x, y and z
  QLabel* m_size;
  PreviewBar* m_progress;
  QPushButton* m_reset;
  QPushButton* m_open; ///< once there is a picture in which to choose
};

} // namespace petrous::workstation
