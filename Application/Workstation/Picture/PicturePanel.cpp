#include "PicturePanel.h"

#include <algorithm>

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QStandardItemModel>

#include "WindowTexts.h"
#include "petrous/Presenters/Background.h"
#include "petrous/Presenters/BoneOpacity.h"
#include "petrous/Presenters/SceneAssembly.h"

namespace petrous::workstation
{

namespace
{

using rendering::StereoMode;
using rendering::StereoRig;

// At its minimum a box shows the default that applies instead.
std::optional<double> lengthOf(double entered)
{
  return entered > 0.0 ? std::optional<double>(entered) : std::nullopt;
}

NumberRange lengthRange(double largest, const QString& atZero)
{
  return {0.0, largest, PicturePanel::tr(" mm"), 1, 0.0, atZero};
}

} // namespace

PicturePanel::PicturePanel(presenters::WorkstationModel& model, presenters::ViewSettings& settings,
                           bool quadBuffer, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_settings(settings)
{
  auto* form = new QFormLayout(this);
  form->setContentsMargins(10, 10, 10, 10);
  m_bone = m_bound.add(
      percentSlider("boneOpacity", tr("Below 100 % the inside of the bone and the structures in it "
                                      "shine through")),
      [this] {
        return m_model.hasCase() ? percent(double(m_model.value().boneLook.opacity))
                                 : m_bone->value();
      },
      [this](int percent) { setBoneOpacity(0.01 * percent); }, Bindings::kSettle);
  addPercent(form, {}, m_bone);
  m_boneName = qobject_cast<QLabel*>(form->itemAt(0, QFormLayout::LabelRole)->widget());
  showNames();
  form->addRow(tr("&Light falloff"),
               m_bound.add(
                   numberBox("lightFalloff",
                             tr("Distance from the lamp, which sits at the microscope, at which "
                                "its light is halved, mm"),
                             lengthRange(presenters::ViewSettings::kFarthestFalloff, tr("none"))),
                   [this] { return m_settings.light().falloff; },
                   [this](double mm) { m_settings.setFalloff(mm); }));
  addPercent(
      form, tr("&Wetness"),
      m_bound.add(
          percentSlider("wetness",
                        tr("A film of water on tissue: thin highlights in place of its own gloss")),
          [this] { return percent(m_settings.light().wetness); },
          [this](int percent) { m_settings.setWetness(0.01 * percent); }));
  addPercent(
      form, tr("Ed&ges"),
      m_bound.add(
          percentSlider("edges", tr("Translucent surfaces are more opaque where they are seen from "
                                    "the side, as a shell is, so that they keep their shape")),
          [this] { return percent(m_settings.light().edges); },
          [this](int percent) { m_settings.setEdges(0.01 * percent); }));
  addPercent(
      form, tr("Grai&n"),
      m_bound.add(
          percentSlider("grain",
                        tr("A fine grain where the drill has cut, for the eye alone: the image "
                           "has none. It fades from afar")),
          [this] { return percent(m_settings.light().grain); },
          [this](int percent) { m_settings.setGrain(0.01 * percent); }));
  addCheck(
      form, tr("&Shadows"), "shadows",
      tr("Cavities are darker than what is open, and a lamp somewhat above the line "
         "of sight throws a soft shadow"),
      [this] { return m_settings.light().shadows; },
      [this](bool on) { m_settings.setShadows(on); });
  constexpr double kMaxExposure = scene::ViewState::Light::kMaxExposure;
  form->addRow(tr("E&xposure"),
               m_bound.add(
                   numberBox("exposure",
                             tr("Brightness of all that is lit, EV: one more doubles the "
                                "luminance, one less halves it. 0 shows structures in "
                                "the colours of their list"),
                             {-kMaxExposure, kMaxExposure, tr(" EV"), 1, 0.5}),
                   [this] { return m_settings.light().exposure; },
                   [this](double exposure) { m_settings.setExposure(exposure); }));
  addCheck(
      form, tr("Soft &highlights"), "toneCurve",
      tr("What is brighter than 80 % rolls off towards white instead of burning out; "
         "bright colours of structures become a little darker than in their list"),
      [this] { return m_settings.light().toneCurve; },
      [this](bool on) { m_settings.setToneCurve(on); });
  addCheck(
      form, tr("Exit s&urfaces"), "exitSurfaces",
      tr("Translucent tissue is shaded also where a line of sight leaves it, so that its far walls "
         "are seen; it lets less through, and needs lower opacities"),
      [this] { return m_settings.light().exitSurfaces; },
      [this](bool on) { m_settings.setExitSurfaces(on); });
  m_softTissue = new QCheckBox(tr("So&ft tissue"));
  m_softTissue->setObjectName("softTissue");
  m_bound.add(
      m_softTissue, [this] { return m_model.hasCase() && m_model.value().softTissue.shown; },
      [this](bool on)
      {
        if (!m_model.hasCase())
          return;
        appearance::StructureAppearance look = m_model.value().softTissue;
        look.shown = on;
        m_model.setLook(scene::kSoftTissue, look);
        m_bound.refresh(); // not while drilling
      });
  form->addRow(QString(), m_softTissue);
  addBackground(form);
  addStereo(form, quadBuffer);
  showSoftTissue();
  settingsChanged();
}

void PicturePanel::addCheck(QFormLayout* form, const QString& name, const char* objectName,
                            const QString& tip, const Bindings::Get<bool>& get,
                            const Bindings::Set<bool>& set)
{
  auto* box = new QCheckBox(name);
  box->setObjectName(objectName);
  box->setToolTip(tip);
  m_bound.add(box, get, set);
  form->addRow(QString(), box);
}

void PicturePanel::addBackground(QFormLayout* form)
{
  auto* box = choiceBox("background", tr("Of the 3D view: what is beside the patient. The slices "
                                         "stay black, and the patient as bright as before"));
  for (const QString& name : {tr("Black"), tr("Dark grey"), tr("Light grey"), tr("White")})
    box->addItem(name);
  box->addItem(tr("Other colour"));
  // Shown where it is one, and chosen by the button: a step by key must open no dialog.
  qobject_cast<QStandardItemModel*>(box->model())->item(box->count() - 1)->setEnabled(false);
  const auto row = [this]
  {
    const auto found =
        std::find_if(presenters::kBackgrounds.begin(), presenters::kBackgrounds.end(),
                     [this](const presenters::NamedBackground& one)
                     { return one.color == m_settings.background(); });
    return static_cast<int>(found - presenters::kBackgrounds.begin());
  };
  const auto set = [this](int chosen)
  {
    if (const auto index = static_cast<std::size_t>(chosen);
        index < presenters::kBackgrounds.size())
      m_settings.setBackground(presenters::kBackgrounds[index].color);
  };
  form->addRow(tr("Bac&kground"), m_bound.add(box, row, set));
  auto* other = button(tr("Other colour…"), "otherBackground", tr("Any colour, of a dialog"));
  connect(other, &QPushButton::clicked, this, &PicturePanel::askBackground);
  form->addRow(QString(), other);
}

void PicturePanel::askBackground()
{
  const rendering::BackgroundColor& now = m_settings.background();
  const QColor color =
      QColorDialog::getColor(QColor::fromRgbF(now[0], now[1], now[2]), this,
                             tr("Background of the 3D view"), QColorDialog::DontUseNativeDialog);
  if (color.isValid())
    m_settings.setBackground({color.redF(), color.greenF(), color.blueF()});
}

void PicturePanel::addStereo(QFormLayout* form, bool quadBuffer)
{
  auto* stereo = choiceBox("stereoMode", tr("How both eyes' pictures come to one screen"));
  const auto offer = [stereo](const QString& name, StereoMode mode)
  { stereo->addItem(name, static_cast<int>(mode)); };
  offer(tr("Off"), StereoMode::None);
  offer(tr("Side by side"), StereoMode::SideBySide);
  offer(tr("Line-interleaved"), StereoMode::Interleaved);
  offer(tr("Anaglyph (red-cyan)"), StereoMode::Anaglyph);
  if (quadBuffer)
    offer(tr("Quad buffer (surgeon's window)"), StereoMode::QuadBuffer);
  form->addRow(tr("&Stereo"), m_bound.add(
                                  stereo,
                                  [this, stereo] {
                                    return stereo->findData(static_cast<int>(m_settings.stereo()));
                                  },
                                  [this, stereo](int row)
                                  {
                                    const int mode = stereo->itemData(row).toInt();
                                    m_settings.setStereo(static_cast<StereoMode>(mode));
                                  }));
  form->addRow(
      tr("&Eye separation"),
      m_bound.add(
          numberBox("eyeSeparation",
                    tr("Between the two eyes of the microscope, mm. Automatic: %1° between "
                       "their lines of sight, as 24 mm at 250 mm")
                        .arg(numberText(StereoRig::kUsualAngle, 1)),
                    lengthRange(StereoRig::kLargestSeparation,
                                tr("automatic (%1°)").arg(numberText(StereoRig::kUsualAngle, 1)))),
          [this] { return m_settings.rig().eyeSeparation.value_or(0.0); },
          [this](double mm) { m_settings.setEyeSeparation(lengthOf(mm)); }));
  form->addRow(
      tr("&Convergence"),
      m_bound.add(
          numberBox("convergence",
                    tr("From the microscope to where both eyes see the same place on the "
                       "screen, mm"),
                    lengthRange(StereoRig::kFarthestConvergence, tr("centre of rotation"))),
          [this] { return m_settings.rig().convergence.value_or(0.0); },
          [this](double mm) { m_settings.setConvergence(lengthOf(mm)); }));
}

void PicturePanel::addPercent(QFormLayout* form, const QString& name, QSlider* slider)
{
  auto* label = new QLabel;
  label->setMinimumWidth(fontMetrics().horizontalAdvance("100 %"));
  label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  const auto notify = [label](int percent) { label->setText(tr("%1 %").arg(percent)); };
  notify(slider->value());
  connect(slider, &QSlider::valueChanged, label, notify);
  auto* row = new QHBoxLayout;
  row->addWidget(slider, 1);
  row->addWidget(label);
  auto* caption = new QLabel(name);
  caption->setBuddy(slider);
  form->addRow(caption, row);
}

void PicturePanel::setBoneOpacity(double opacity)
{
  if (m_model.hasCase())
    m_model.setBoneLook(presenters::withOpacity(m_model.value().boneLook, opacity));
}

void PicturePanel::caseChanged()
{
  m_bound.drop();
  appearanceChanged();
}

// An MR as primary image shows tissue, not bone.
void PicturePanel::showNames()
{
  const bool isOnMr = m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr;
  m_boneName->setText(isOnMr ? tr("&Tissue opacity") : tr("&Bone opacity"));
  m_bone->setToolTip(isOnMr ? tr("Below 100 % the inside of the tissue and the structures in it "
                                 "shine through")
                            : tr("Below 100 % the inside of the bone and the structures in it "
                                 "shine through"));
}

void PicturePanel::showSoftTissue()
{
  m_softTissue->setEnabled(m_model.hasCase());
  const std::string missing = m_model.hasCase() && m_model.value().softTissue.shown
                                  ? presenters::softTissueMissing(m_model.value())
                                  : std::string();
  const bool isOnMr = m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr;
  m_softTissue->setToolTip(
      (isOnMr ? tr("What lies below the surface threshold and is no structure is drawn, "
                   "translucent. The Appearance panel has its colours and opacities")
              : tr("Skin, fat and muscle are drawn, translucent: what is neither bone nor "
                   "a structure. The Appearance panel has their colours and opacities")) +
      (missing.empty() ? QString() : '\n' + tr("Not drawn: %1").arg(phrase(missing))));
}

void PicturePanel::appearanceChanged()
{
  showNames();
  m_bone->setEnabled(m_model.hasCase());
  showSoftTissue();
  m_bound.refresh();
}

void PicturePanel::settingsChanged()
{
  m_bound.refresh();
}

} // namespace petrous::workstation
