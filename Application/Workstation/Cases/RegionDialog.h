#pragma once

#include <array>
#include <memory>
#include <optional>

#include <QDialog>

#include "SliceView.h"
#include "petrous/Core/AxesCorrection.h"
#include "petrous/Core/PatientBox.h"
#include "petrous/Presenters/BoxHandles.h"
#include "petrous/Presenters/SeriesPreview.h"

class QLabel;
class QPushButton;

namespace petrous::workstation
{

class BoxNumbers;
class PreviewBar;

/// Three slices of a scan before it is read, and the region of it to be read: `petrous new --roi`.
class RegionDialog : public QDialog
{
  Q_OBJECT
public:
  /// `selector`: imaging::chooseSeries; `assumeRas`, `unit`, `axes`: presenters::CaseSources. The
  /// slices lie as the file states them, as the region does; their letters are corrected.
  RegionDialog(const std::filesystem::path& path, const std::string& selector, bool repair,
               const std::optional<bool>& assumeRas = {}, const std::optional<double>& unit = {},
               QWidget* parent = nullptr, const core::AxesCorrection& axes = {});

  /// Patient LPS mm; nullopt: all of it.
  std::optional<core::PatientBox> region() const;
  bool isPictured() const noexcept { return m_preview != nullptr; }

private:
  void show(std::shared_ptr<const presenters::ScanPreview> preview);
  void setBox(core::PatientBox box);

  std::shared_ptr<const presenters::ScanPreview> m_preview;
  core::PatientBox m_box;
  core::PatientBox m_takenBox;  ///< before it is dragged
  presenters::BoxFaces m_faces; ///< that are dragged
  Eigen::Vector3d m_from = Eigen::Vector3d::Zero();
  std::array<SliceView*, 3> m_views;
  BoxNumbers* m_numbers;
  QLabel* m_size;
  PreviewBar* m_progress;
  QPushButton* m_reset;
  QPushButton* m_open; ///< once there is a picture in which to choose
};

} // namespace petrous::workstation
