#include "PicturePanel.h"

#include <cmath>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QScopedValueRollback>
#include <QSlider>

#include "petrous/Presenters/BoneOpacity.h"

namespace petrous::workstation
{

namespace
{

using rendering::StereoMode;
using rendering::StereoRig;

constexpr int kApplyAfter = 60; // ms

// At its minimum a box shows the default that applies instead.
std::optional<double> lengthOf(const QDoubleSpinBox& box)
{
  return box.value() > 0.0 ? std::optional<double>(box.value()) : std::nullopt;
}

} // namespace

PicturePanel::PicturePanel(presenters::WorkstationModel& model, presenters::ViewSettings& settings,
                           bool quadBuffer, QWidget* parent)
  : QWidget(parent)
  , m_model(model)
  , m_settings(settings)
{
  auto* form = new QFormLayout(this);
  form->setContentsMargins(10, 10, 10, 10);
  m_bone = addFractionSlider(
      form, tr("&Bone opacity"),
      tr("Below 100 % the inside of the bone and the structures in it shine through"),
      "boneOpacity");
  connect(m_bone, &QSlider::valueChanged, this,
          [this]
          {
            if (!m_showing)
              m_apply.start();
          });
  m_apply.setSingleShot(true);
  m_apply.setInterval(kApplyAfter);
  connect(&m_apply, &QTimer::timeout, this, &PicturePanel::setBoneOpacity);
  m_falloff = addLength(form, tr("&Light falloff"),
                        tr("Distance from the lamp, which sits at the microscope, at which its "
                           "light is halved, mm"),
                        "lightFalloff", tr("none"), presenters::ViewSettings::kFarthestFalloff);
  connect(m_falloff, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this](double mm)
          {
            if (!m_showing)
              m_settings.setFalloff(mm);
          });
  m_wetness = addFractionSlider(form, tr("&Wetness"), tr("Gloss of a wet surface"), "wetness");
  connect(m_wetness, &QSlider::valueChanged, this,
          [this](int percent)
          {
            if (!m_showing)
              m_settings.setWetness(0.01 * percent);
          });
  addStereo(form, quadBuffer);
  settingsChanged();
}

void PicturePanel::addStereo(QFormLayout* form, bool quadBuffer)
{
  m_stereo = new QComboBox;
  m_stereo->setObjectName("stereoMode");
  const auto offer = [this](const QString& name, StereoMode mode)
  { m_stereo->addItem(name, static_cast<int>(mode)); };
  offer(tr("Off"), StereoMode::None);
  offer(tr("Side by side"), StereoMode::SideBySide);
  offer(tr("Line-interleaved"), StereoMode::Interleaved);
  offer(tr("Anaglyph (red-cyan)"), StereoMode::Anaglyph);
  if (quadBuffer)
    offer(tr("Quad buffer (surgeon's window)"), StereoMode::QuadBuffer);
  m_stereo->setToolTip(tr("How both eyes' pictures come to one screen"));
  form->addRow(tr("&Stereo"), m_stereo);
  connect(m_stereo, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this]
          {
            if (!m_showing)
              m_settings.setStereo(static_cast<StereoMode>(m_stereo->currentData().toInt()));
          });
  m_separation = addLength(form, tr("&Eye separation"),
                           tr("Between the two eyes of the microscope, mm. Automatic: %1° between "
                              "their lines of sight, as 24 mm at 250 mm")
                               .arg(StereoRig::kUsualAngle),
                           "eyeSeparation", tr("automatic (%1°)").arg(StereoRig::kUsualAngle),
                           StereoRig::kLargestSeparation);
  connect(m_separation, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this]
          {
            if (!m_showing)
              m_settings.setEyeSeparation(lengthOf(*m_separation));
          });
  m_convergence =
      addLength(form, tr("&Convergence"),
                tr("From the microscope to where both eyes see the same place on the screen, mm"),
                "convergence", tr("centre of rotation"), StereoRig::kFarthestConvergence);
  connect(m_convergence, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this]
          {
            if (!m_showing)
              m_settings.setConvergence(lengthOf(*m_convergence));
          });
}

QSlider* PicturePanel::addFractionSlider(QFormLayout* form, const QString& name, const QString& tip,
                                         const QString& objectName)
{
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setRange(0, 100);
  slider->setPageStep(10);
  slider->setObjectName(objectName);
  slider->setToolTip(tip);
  auto* label = new QLabel;
  label->setMinimumWidth(fontMetrics().horizontalAdvance("100 %"));
  label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  const auto notify = [label](int percent) { label->setText(tr("%1 %").arg(percent)); };
  notify(0);
  connect(slider, &QSlider::valueChanged, label, notify);
  auto* row = new QHBoxLayout;
  row->addWidget(slider, 1);
  row->addWidget(label);
  auto* caption = new QLabel(name);
  caption->setBuddy(slider);
  form->addRow(caption, row);
  return slider;
}

QDoubleSpinBox* PicturePanel::addLength(QFormLayout* form, const QString& name, const QString& tip,
                                        const QString& objectName, const QString& atZero,
                                        double largest)
{
  auto* box = new QDoubleSpinBox;
  box->setRange(0.0, largest);
  box->setDecimals(1);
  box->setSuffix(tr(" mm"));
  box->setSpecialValueText(atZero);
  box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  box->setKeyboardTracking(false);
  box->setObjectName(objectName);
  box->setToolTip(tip);
  form->addRow(name, box);
  return box;
}

void PicturePanel::setBoneOpacity()
{
  if (!m_model.hasCase())
    return;
  m_model.setBoneLook(presenters::withOpacity(m_model.value().boneLook, 0.01 * m_bone->value()));
}

void PicturePanel::caseChanged()
{
  m_bone->setEnabled(m_model.hasCase());
  if (!m_model.hasCase() || m_apply.isActive())
    return;
  const QScopedValueRollback<bool> showing(m_showing, true);
  const auto opacity = static_cast<double>(m_model.value().boneLook.opacity);
  m_bone->setValue(static_cast<int>(std::lround(100.0 * opacity)));
}

void PicturePanel::settingsChanged()
{
  const QScopedValueRollback<bool> showing(m_showing, true);
  m_falloff->setValue(m_settings.light().falloff);
  m_wetness->setValue(static_cast<int>(std::lround(100.0 * m_settings.light().wetness)));
  m_stereo->setCurrentIndex(m_stereo->findData(static_cast<int>(m_settings.stereo())));
  m_separation->setValue(m_settings.rig().eyeSeparation.value_or(0.0));
  m_convergence->setValue(m_settings.rig().convergence.value_or(0.0));
}

} // namespace petrous::workstation
