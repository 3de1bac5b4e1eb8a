#pragma once

#include <QTimer>
#include <QWidget>

#include "petrous/Presenters/ViewSettings.h"
#include "petrous/Presenters/WorkstationModel.h"

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QSlider;

namespace petrous::workstation
{

/// Rendering settings: bone, lamp, stereo. Every number has its unit.
class PicturePanel : public QWidget
{
  Q_OBJECT
public:
  /// `quadBuffer`: the driver supports quad-buffered stereo.
  PicturePanel(presenters::WorkstationModel& model, presenters::ViewSettings& settings,
               bool quadBuffer, QWidget* parent = nullptr);

  void caseChanged();     ///< or its parts' appearance
  void settingsChanged(); ///< light or stereo

private:
  QSlider* addFractionSlider(QFormLayout* form, const QString& name, const QString& tip,
                             const QString& objectName);
  QDoubleSpinBox* addLength(QFormLayout* form, const QString& name, const QString& tip,
                            const QString& objectName, const QString& atZero, double largest);
  void addStereo(QFormLayout* form, bool quadBuffer);
  void setBoneOpacity();

  presenters::WorkstationModel& m_model;
  presenters::ViewSettings& m_settings;
  QSlider* m_bone;
  QDoubleSpinBox* m_falloff;
  QSlider* m_wetness;
  QComboBox* m_stereo;
  QDoubleSpinBox* m_separation;
  QDoubleSpinBox* m_convergence;
  QTimer m_apply;         // coalesces the changes of a moving slider
  bool m_showing = false; // values are being set from model or settings
};

} // namespace petrous::workstation
