#pragma once

#include "Bind.h"
#include "Panels.h"
#include "petrous/Presenters/ViewSettings.h"
#include "petrous/Presenters/WorkstationModel.h"

class QCheckBox;
class QFormLayout;
class QLabel;
class QSlider;

namespace petrous::workstation
{

/// Rendering settings: bone, lamp, background, stereo. Every number has its unit.
class PicturePanel : public Panel
{
  Q_OBJECT
public:
  /// `quadBuffer`: the driver supports quad-buffered stereo.
  PicturePanel(presenters::WorkstationModel& model, presenters::ViewSettings& settings,
               bool quadBuffer, QWidget* parent = nullptr);

  void caseChanged() override;
  void appearanceChanged() override;
  void settingsChanged(); ///< light or stereo

private:
  void addCheck(QFormLayout* form, const QString& name, const char* objectName, const QString& tip,
                const Bindings::Get<bool>& get, const Bindings::Set<bool>& set);
  void addPercent(QFormLayout* form, const QString& name, QSlider* slider);
  void addBackground(QFormLayout* form);
  void askBackground();
  void addStereo(QFormLayout* form, bool quadBuffer);
  void setBoneOpacity(double opacity);

  presenters::WorkstationModel& m_model;
  presenters::ViewSettings& m_settings;
  void showNames();
  void showSoftTissue();

  QSlider* m_bone;
  QLabel* m_boneName;
  QCheckBox* m_softTissue;
  Bindings m_bound;
};

} // namespace petrous::workstation
