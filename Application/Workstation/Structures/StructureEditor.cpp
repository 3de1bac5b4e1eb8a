#include "StructureEditor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QStandardItemModel>

#include "AppearancePanel.h"
#include "ColorChooser.h"
#include "StructuresModel.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Appearance/SoftTissues.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/Catalogues.h"
#include "petrous/Presenters/AppearanceEditor.h"
#include "petrous/Presenters/BoneOpacity.h"
#include "petrous/Presenters/StructureList.h"

namespace petrous::workstation
{

namespace
{

using appearance::StructureAppearance;
using appearance::StructureProperty;
using presenters::EditHistory;

constexpr char kBone[] = "ct";
constexpr int kIsSolid = Qt::UserRole + 1; // of a preset: whether bone can have it

const StructureProperty& propertyOf(const char* key)
{
  return *std::find_if(
      std::begin(appearance::kStructureProperties), std::end(appearance::kStructureProperties),
      [key](const StructureProperty& property) { return std::strcmp(property.key, key) == 0; });
}

// Bone and soft tissue have colour, opacity and preset, and can be hidden.
bool has(const std::string& part, const StructureProperty& property)
{
  static const char* const kKeys[] = {"shown", "color", "opacity", "preset"};
  if (part != kBone && part != scene::kSoftTissue)
    return true;
  return std::any_of(std::begin(kKeys), std::end(kKeys),
                     [&property](const char* key) { return std::strcmp(property.key, key) == 0; });
}

QColor colorOf(const StructureAppearance& look)
{
  return QColor::fromRgbF(double(look.color[0]), double(look.color[1]), double(look.color[2]));
}

} // namespace

StructureEditor::StructureEditor(presenters::WorkstationModel& model, QWidget* parent)
  : QWidget(parent)
  , m_model(model)
  , m_title(new QLabel)
  , m_color(button({}, "structureColor", tr("Colour; a window of colours opens")))
{
  setObjectName("structureEditor");
  m_title->setObjectName("structureTitle");
  QFont bold = m_title->font();
  bold.setBold(true);
  m_title->setFont(bold);
  m_title->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  m_color->setAccessibleName(tr("Colour"));
  m_color->setFixedWidth(34);
  m_color->setStyleSheet("padding: 3px;");
  connect(m_color, &QPushButton::clicked, this,
          [this] { chooseColor(m_parts, m_color->mapToGlobal(QPoint(0, m_color->height()))); });

  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(10, 6, 10, 6);
  grid->setHorizontalSpacing(6);
  grid->setVerticalSpacing(4);
  grid->addWidget(m_title, 0, 0, 1, 4);
  const auto addLabel = [&](const QString& text, QWidget* buddy, int row, int column)
  {
    auto* label = new QLabel(text);
    label->setBuddy(buddy);
    grid->addWidget(label, row, column);
    if (buddy->accessibleName().isEmpty())
      buddy->setAccessibleName(QString(text).remove('&'));
  };
  QComboBox* presets = addPresets();
  addLabel(tr("&Preset"), presets, 1, 0);
  grid->addWidget(presets, 1, 1, 1, 2);
  grid->addWidget(m_color, 1, 3, Qt::AlignRight);
  addOpacity(*grid, 2);
  int column = 1;
  for (const char* key : {"shown", "touchable", "drillable"})
    grid->addWidget(addFlag(key), 3, column++);
  m_materials = addMaterials();
  offerMaterials();
  addLabel(tr("Dr&illed as"), m_materials, 4, 0);
  grid->addWidget(m_materials, 4, 1, 1, 3);
  QDoubleSpinBox* warning = addNumber("warn_mm", 0.1);
  QDoubleSpinBox* stiffness = addNumber("stiffness_n_per_mm", 0.0);
  stiffness->setToolTip(stiffness->toolTip() + '\n' +
                        tr("The presets are rigid: no stiffness of these structures was measured "
                           "under a burr. Below are values derived from published moduli"));
  addLabel(tr("&Warn"), warning, 5, 0);
  grid->addWidget(warning, 5, 1);
  addLabel(tr("Sti&ffness"), stiffness, 5, 2);
  grid->addWidget(stiffness, 5, 3);
  QDoubleSpinBox* priority = addNumber("priority", 1.0);
  priority->setToolTip(tr("Where structures overlap, the one with the lowest number has the voxel; "
                          "lumens come last"));
  addLabel(tr("Priorit&y"), priority, 6, 0);
  grid->addWidget(priority, 6, 1);
  m_softTissues = addSoftTissues();
  grid->addWidget(m_softTissues, 6, 2, 1, 2);
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(3, 1);
  for (Number& one : m_numbers)
    one.tip = one.box->toolTip();
  for (Flag& one : m_flags)
    one.tip = one.box->toolTip();
  refresh();
}

void StructureEditor::addOpacity(QGridLayout& grid, int row)
{
  const StructureProperty& property = propertyOf("opacity");
  m_opacity =
      percentSlider("structureOpacity",
                    tr("Opacity; of a lumen, how much it tints what is around it; of soft tissue, "
                       "a factor of that of its function"));
  auto* box = new QSpinBox;
  box->setObjectName("structureOpacityBox");
  box->setToolTip(m_opacity->toolTip());
  box->setRange(0, 100);
  box->setSuffix(tr(" %"));
  box->setKeyboardTracking(false);
  const auto get = [this, &property]
  {
    const auto all = looks(property);
    return all.empty() ? 100 : percent(double(all.front()->opacity));
  };
  const auto set = [this, &property](int value)
  {
    change(
        [value](const std::string& part, StructureAppearance& look)
        {
          if (part == kBone)
            look = presenters::withOpacity(look, 0.01 * value);
          else
            look.opacity = static_cast<float>(0.01 * value);
        },
        property);
  };
  m_bound.add(m_opacity, get, set);
  m_bound.add(box, get, set);
  for (QWidget* widget : {static_cast<QWidget*>(m_opacity), static_cast<QWidget*>(box)})
    widget->setAccessibleName(tr("Opacity"));
  // A drag is one step, however long it takes.
  connect(m_opacity, &QSlider::sliderPressed, this,
          [this] { m_opacityHold = std::make_unique<EditHistory::Hold>(m_model.edits()); });
  connect(m_opacity, &QSlider::sliderReleased, this, [this] { m_opacityHold.reset(); });
  auto* label = new QLabel(tr("&Opacity"));
  label->setBuddy(m_opacity);
  grid.addWidget(label, row, 0);
  grid.addWidget(m_opacity, row, 1, 1, 2);
  grid.addWidget(box, row, 3);
}

QDoubleSpinBox* StructureEditor::addNumber(const char* key, double step)
{
  const StructureProperty& property = propertyOf(key);
  const bool isWhole = std::holds_alternative<int StructureAppearance::*>(property.member);
  NumberRange range{0.0, property.range.upper, {}, isWhole ? 0 : property.decimals, step};
  if (range.decimals < 0)
    range.decimals = 3;
  if (*property.range.unit)
    range.unit = QString(" ") + property.range.unit;
  if (property.off)
    range.atLeast = phrase(property.off);
  QDoubleSpinBox* box =
      numberBox((std::string("structure_") + key).c_str(), phrase(property.option.text), range);
  m_bound.add(
      box,
      [this, &property]
      {
        const auto all = looks(property);
        return all.empty() ? 0.0 : numberOf(*all.front(), property);
      },
      [this, &property](double value)
      {
        if (property.accepts(value))
          change([&property, value](const std::string&, StructureAppearance& look)
                 { setNumber(look, property, value); },
                 property);
      });
  m_numbers.push_back({&property, box});
  return box;
}

QCheckBox* StructureEditor::addFlag(const char* key)
{
  const StructureProperty& property = propertyOf(key);
  const auto flag = std::get<StructureProperty::Flag>(property.member);
  auto* box = new QCheckBox(StructuresModel::tr(property.column.title));
  box->setObjectName(QString("structure_") + key);
  box->setToolTip(StructuresModel::tr(property.column.tip));
  connect(box, &QCheckBox::clicked, this,
          [this, box, flag, &property]
          {
            const bool on = box->checkState() != Qt::Unchecked; // also from "some"
            change([flag, on](const std::string&, StructureAppearance& look) { look.*flag = on; },
                   property);
            refresh();
          });
  m_flags.push_back({&property, box});
  return box;
}

QComboBox* StructureEditor::addPresets()
{
  const StructureProperty& property = propertyOf("preset");
  QComboBox* box =
      choiceBox("structurePreset", tr("Colour, material, warning distance and order of a kind of "
                                      "structure; marks stay as they are"));
  const auto presets = appearance::StructurePresets::builtIn();
  for (const auto& look : presets.all())
  {
    box->addItem(AppearancePanel::tr(look.preset.c_str()), words(look.preset));
    box->setItemData(box->count() - 1, look.solid, kIsSolid);
  }
  connect(box, qOverload<int>(&QComboBox::activated), this,
          [this, box, &property](int row)
          {
            const auto preset = appearance::StructurePresets::builtIn().preset(
                bytes(box->itemData(row).toString()));
            change(
                [this, preset](const std::string& part, StructureAppearance& look)
                {
                  if (presenters::canBeLookOf(m_model.value(), part, preset))
                    look = presenters::withPreset(m_model.value(), part, preset);
                },
                property);
            refresh();
          });
  m_texts.push_back({&property, box});
  return box;
}

QComboBox* StructureEditor::addMaterials()
{
  const StructureProperty& property = propertyOf("tissue");
  QComboBox* box = choiceBox("structureMaterial", phrase(property.option.text));
  box->addItem(tr("Bone, by its density"), QString());
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  connect(box, qOverload<int>(&QComboBox::activated), this,
          [this, box, &property](int row)
          {
            const std::string material = bytes(box->itemData(row).toString());
            change([material](const std::string&, StructureAppearance& look)
                   { look.tissue = material; },
                   property);
            refresh();
          });
  m_texts.push_back({&property, box});
  return box;
}

QPushButton* StructureEditor::addSoftTissues()
{
  const StructureProperty& property = propertyOf("stiffness_n_per_mm");
  QPushButton* result =
      button(tr("As soft tissue"), "structureSoftTissue",
             tr("Stiffness of a kind of soft tissue, derived from published moduli: each with its "
                "range and how certain it is"));
  auto* menu = new QMenu(result);
  menu->setToolTipsVisible(true);
  for (const appearance::SoftTissue& one : appearance::softTissues())
  {
    const auto text = [](double value) { return numberText(core::plainText(value)); };
    QAction* action =
        menu->addAction(tr("%1: %2 N/mm (%3 to %4), %5")
                            .arg(phrase(one.title), text(one.stiffness), text(one.lowest),
                                 text(one.highest), phrase(one.certainty)));
    action->setData(words(one.name));
    action->setToolTip(phrase(one.status));
    connect(action, &QAction::triggered, this,
            [this, &property, value = one.stiffness]
            {
              change([&property, value](const std::string&, StructureAppearance& look)
                     { setNumber(look, property, value); },
                     property);
              refresh();
            });
  }
  result->setMenu(menu);
  return result;
}

// The library's own and the program's.
void StructureEditor::offerMaterials()
{
  while (m_materials->count() > 1)
    m_materials->removeItem(1);
  dissection::MaterialCatalogue catalogue = dissection::MaterialCatalogue::builtIn();
  try
  {
    catalogue = dissection::Catalogues::in(m_model.library().folder()).materials;
  }
  catch (const core::Error&) // told when the burr is taken up
  {
  }
  for (const auto& material : catalogue.all())
    m_materials->addItem(phrase(material.title), words(material.name));
}

void StructureEditor::materialsChanged()
{
  offerMaterials();
  refresh();
}

std::vector<std::string> StructureEditor::partsWith(const StructureProperty& property) const
{
  std::vector<std::string> parts;
  for (const std::string& part : m_parts)
    if (const auto* look = m_model.lookOf(part);
        look && has(part, property) && StructuresModel::idleText(*look, property).isEmpty())
      parts.push_back(part);
  return parts;
}

void StructureEditor::change(
    const std::function<void(const std::string&, StructureAppearance&)>& to,
    const StructureProperty& property)
{
  presenters::changeLooks(m_model, partsWith(property), to);
}

std::vector<const StructureAppearance*>
StructureEditor::looks(const StructureProperty& property) const
{
  std::vector<const StructureAppearance*> all;
  for (const std::string& part : partsWith(property))
    all.push_back(m_model.lookOf(part));
  return all;
}

QString StructureEditor::withIdle(const QString& tip, const StructureProperty& property) const
{
  if (!partsWith(property).empty())
    return tip;
  for (const std::string& part : m_parts)
    if (const auto* look = m_model.lookOf(part))
      if (const QString idle = StructuresModel::idleText(*look, property); !idle.isEmpty())
        return tip + '\n' + idle;
  return tip;
}

bool StructureEditor::differ(const StructureProperty& property) const
{
  const auto all = looks(property);
  return std::any_of(all.begin(), all.end(),
                     [&](const auto* look)
                     { return !appearance::isEqual(*look, *all.front(), property); });
}

void StructureEditor::setParts(std::vector<std::string> parts, const QString& title)
{
  m_parts = std::move(parts);
  m_title->setText(title);
  m_title->setToolTip(title);
  refresh();
}

void StructureEditor::refresh()
{
  const QString differs = tr("differ: ");
  m_bound.refresh();
  m_bound.quietly(
      [&]
      {
        for (const Number& one : m_numbers)
        {
          one.box->setEnabled(!looks(*one.property).empty());
          one.box->setPrefix(differ(*one.property) ? differs : QString());
          one.box->setToolTip(withIdle(one.tip, *one.property));
        }
        m_softTissues->setEnabled(!looks(propertyOf("stiffness_n_per_mm")).empty());
        for (const Flag& one : m_flags)
        {
          const auto flag = std::get<StructureProperty::Flag>(one.property->member);
          const auto all = looks(*one.property);
          one.box->setEnabled(!all.empty());
          one.box->setToolTip(withIdle(one.tip, *one.property));
          const bool isMixed = differ(*one.property);
          one.box->setTristate(isMixed);
          one.box->setCheckState(isMixed                              ? Qt::PartiallyChecked
                                 : !all.empty() && all.front()->*flag ? Qt::Checked
                                                                      : Qt::Unchecked);
        }
        if (m_model.hasCase())
          m_materials->setItemText(0, m_model.value().ct.modality == scene::Modality::Mr
                                          ? tr("Soft tissue, as where nothing is drawn")
                                          : tr("Bone, by its density"));
        for (const Text& one : m_texts)
        {
          const auto text = std::get<StructureProperty::Text>(one.property->member);
          const auto all = looks(*one.property);
          one.box->setEnabled(!all.empty());
          // Those that none of them can have stay in the list, greyed.
          const bool isAnyStructure = std::any_of(
              m_parts.begin(), m_parts.end(),
              [](const std::string& part) { return part != kBone && part != scene::kSoftTissue; });
          auto* rows = qobject_cast<QStandardItemModel*>(one.box->model());
          for (int row = 0; rows && row < rows->rowCount(); ++row)
            if (const QVariant isSolid = rows->item(row)->data(kIsSolid); isSolid.isValid())
              rows->item(row)->setEnabled(isAnyStructure || isSolid.toBool());
          one.box->setCurrentIndex(all.empty() || differ(*one.property)
                                       ? -1
                                       : one.box->findData(words(all.front()->*text)));
        }
      });
  const StructureProperty& color = propertyOf("color");
  const auto all = looks(color);
  m_color->setEnabled(!all.empty());
  m_opacity->setEnabled(!all.empty());
  QPixmap pixmap(22, 14);
  pixmap.fill(all.empty() ? QColor(Qt::transparent) : colorOf(*all.front()));
  if (differ(color)) // half and half
  {
    QPainter painter(&pixmap);
    painter.fillRect(
        11, 0, 11, 14,
        colorOf(**std::find_if(all.begin(), all.end(),
                               [&](auto* look) { return look->color != all.front()->color; })));
  }
  m_color->setIcon(pixmap);
  m_color->setIconSize(pixmap.size());
}

void StructureEditor::takeFocus()
{
  m_color->setFocus(Qt::TabFocusReason);
}

void StructureEditor::keyPressEvent(QKeyEvent* event)
{
  if (event->key() == Qt::Key_Escape)
    emit left();
  else
    QWidget::keyPressEvent(event);
}

void StructureEditor::hideEvent(QHideEvent* event)
{
  m_opacity->setSliderDown(false); // no release of the button will tell
  QWidget::hideEvent(event);
}

void StructureEditor::chooseColor(const std::vector<std::string>& parts, const QPoint& global)
{
  const auto* present = parts.empty() ? nullptr : m_model.lookOf(parts.front());
  if (!present || m_model.drilling())
    return;
  auto* chooser = new ColorChooser(colorOf(*present), this);
  // What is tried is one step, and none if nothing is chosen.
  const auto hold = std::make_shared<EditHistory::Hold>(m_model.edits()); // dies with the chooser
  const auto before = m_model.edits().last();
  const auto of = m_model.shownAs();
  // Each colour is tried on these: a dark one in between would flatten their transfer functions.
  std::map<std::string, StructureAppearance> looks;
  for (const std::string& part : parts)
    if (const auto* look = m_model.lookOf(part))
      looks.emplace(part, *look);
  const auto takeBack = [this, before, of] { m_model.takeBackTried(before, of); };
  const auto paint = [this, parts, of, takeBack, looks = std::move(looks)](const QColor& color)
  {
    if (m_model.shownAs() != of)
      return;
    if (!color.isValid())
      return takeBack();
    const std::array<float, 3> rgb{static_cast<float>(color.redF()),
                                   static_cast<float>(color.greenF()),
                                   static_cast<float>(color.blueF())};
    presenters::changeLooks(m_model, parts,
                            [&](const std::string& part, StructureAppearance& look)
                            {
                              if (const auto found = looks.find(part); found != looks.end())
                                look = found->second;
                              setColor(look, rgb);
                            });
  };
  connect(chooser, &ColorChooser::previewed, this, paint);
  connect(chooser, &ColorChooser::chosen, this,
          [paint, hold](const QColor& color)
          {
            paint(color);
            hold->release();
          });
  connect(chooser, &ColorChooser::cancelled, this,
          [takeBack, hold]
          {
            takeBack();
            hold->release();
          });
  chooser->open(global);
}

} // namespace petrous::workstation
