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

/// How the picture looks: bone, lamp, stereo. Every number has its unit.
class PicturePanel : public QWidget
{
  Q_OBJECT
public:
  /// `quadBuffer`: the driver offers two buffers.
  PicturePanel(presenters::WorkstationModel& model, presenters::ViewSettings& settings,
               bool quadBuffer, QWidget* parent = nullptr);

  void caseChanged();     ///< or how its parts look
  void settingsChanged(); ///< light or stereo

private:
  QSlider* addOccupancy(QFormLayout* form, const QString& name, const QString& tip,
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
  QTimer m_apply;         // a slider on the move makes one change, not fifty
  bool m_showing = false; // values that come from model or settings
};

} // namespace petrous::workstation
