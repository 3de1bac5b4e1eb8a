#pragma once

#include <QLabel>

#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

/// Shows the values at a point in the status bar.
class ProbeLabel : public QLabel
{
  Q_OBJECT
public:
  explicit ProbeLabel(const presenters::WorkstationModel& model, QWidget* parent = nullptr);

  void showPlace(const Eigen::Vector3d& patient); ///< LPS mm; values of the primary image
  /// `values`: those of the images that are seen there.
  void showValues(const Eigen::Vector3d& patient, const QString& values);

private:
  const presenters::WorkstationModel& m_model;
};

} // namespace petrous::workstation
