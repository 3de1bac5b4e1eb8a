#include "StructuresPanel.h"

#include <cmath>

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QSlider>
#include <QTreeView>
#include <QVBoxLayout>

#include "StructuresModel.h"
#include "Theme.h"
#include "petrous/Dissection/MaterialCatalogue.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

namespace
{
constexpr int kApplyAfter = 60; // ms
} // namespace

StructuresPanel::StructuresPanel(presenters::WorkstationModel& model, QWidget* parent)
  : QWidget(parent)
  , m_model(model)
  , m_structures(new StructuresModel(model, this))
  , m_list(new QTreeView)
  , m_slider(new QSlider(Qt::Horizontal))
  , m_box(new QDoubleSpinBox)
{
  m_slider->setPageStep(50);
  m_slider->setObjectName("isoSlider");
  m_box->setObjectName("isoBox");
  showRange();
  connect(m_slider, &QSlider::valueChanged, this,
          [this](int steps) { m_box->setValue(m_step * steps); });
  connect(m_box, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this](double value)
          {
            const QSignalBlocker quiet(m_slider);
            m_slider->setValue(static_cast<int>(std::lround(value / m_step)));
            m_apply.start();
          });
  m_apply.setSingleShot(true);
  m_apply.setInterval(kApplyAfter);
  connect(&m_apply, &QTimer::timeout, this, [this] { m_model.setIso(m_box->value()); });

  m_list->setModel(m_structures);
  m_list->setObjectName("structures");
  m_list->setRootIsDecorated(false);
  m_list->setUniformRowHeights(true);
  m_list->setAlternatingRowColors(true);
  m_list->setAllColumnsShowFocus(true);
  m_list->header()->setStretchLastSection(false);
  m_list->header()->setSectionsMovable(false);
  m_list->header()->setMinimumSectionSize(20);
  m_list->header()->setSectionResizeMode(QHeaderView::Fixed);
  for (int column = StructuresModel::VolumeColumn; column < m_structures->columnCount(); ++column)
    m_list->header()->resizeSection(column, column == StructuresModel::VolumeColumn ? 46 : 48);
  m_list->header()->setSectionResizeMode(StructuresModel::Name, QHeaderView::Stretch);

  m_list->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(m_list, &QTreeView::customContextMenuRequested, this, &StructuresPanel::offer);

  auto* threshold = new QLabel(tr("&Bone threshold"));
  threshold->setBuddy(m_box);
  auto* top = new QHBoxLayout;
  top->addWidget(threshold);
  top->addStretch();
  top->addWidget(m_box);
  auto* head = new QVBoxLayout;
  head->setContentsMargins(10, 8, 10, 6);
  head->addLayout(top);
  head->addWidget(m_slider);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addLayout(head);
  layout->addWidget(m_list, 1);
  setMinimumWidth(280);
}

QString StructuresPanel::chosen() const
{
  return words(m_structures->nameAt(m_list->currentIndex()));
}

// Menu of the structure's tissue, which determines the drill's resistance.
void StructuresPanel::addTissues(QMenu& menu, const QString& name)
{
  const auto look = m_structures->lookAt(m_structures->rowOf(bytes(name)));
  QMenu* tissues = menu.addMenu(tr("The drill meets"));
  const auto add = [&](const QString& title, const std::string& tissue)
  {
    QAction* action = tissues->addAction(title);
    action->setCheckable(true);
    action->setChecked(look.tissue == tissue);
    connect(action, &QAction::triggered, this,
            [this, name, tissue]
            {
              auto next = m_structures->lookAt(m_structures->rowOf(bytes(name)));
              next.tissue = tissue;
              m_model.setLook(bytes(name), next);
            });
  };
  add(tr("Bone, by its density"), {});
  const auto catalogue = dissection::MaterialCatalogue::builtIn();
  for (const auto& material : catalogue.all())
    add(words(material.title), material.name);
}

void StructuresPanel::offer(const QPoint& position)
{
  const QString name = words(m_structures->nameAt(m_list->indexAt(position)));
  if (name.isEmpty())
    return;
  QMenu menu;
  addTissues(menu, name);
  QAction* thickness = menu.addAction(
      tr("Colour bone by its thickness over %1").arg(QString(name).replace('_', ' ')));
  thickness->setCheckable(true);
  thickness->setChecked(m_model.thicknessOver() == bytes(name));
  if (menu.exec(m_list->viewport()->mapToGlobal(position)) == thickness)
    emit thicknessAsked(name);
}

// The image's range, in its unit.
void StructuresPanel::showRange()
{
  const auto display =
      m_model.hasCase() ? presenters::displayOf(m_model.value()) : presenters::IntensityDisplay();
  m_step = display.step;
  m_slider->setRange(static_cast<int>(std::floor(display.least / m_step)),
                     static_cast<int>(std::ceil(display.most / m_step)));
  m_box->setDecimals(display.decimals);
  m_box->setRange(display.least, display.most);
  m_box->setSingleStep(10.0 * m_step);
  m_box->setSuffix(words(display.suffix()));
  const QString tip = display.hounsfield
                          ? tr("Bone is what is denser than this, in Hounsfield units (HU)")
                          : tr("Bone is what is denser than this, in the image's own unit: it is "
                               "not in Hounsfield units");
  m_slider->setToolTip(tip);
  m_box->setToolTip(tip);
}

void StructuresPanel::showIso()
{
  if (!m_model.hasCase() || m_apply.isActive())
    return;
  const QSignalBlocker quietBox(m_box);
  const QSignalBlocker quietSlider(m_slider);
  showRange();
  m_box->setValue(m_model.value().iso);
  m_slider->setValue(static_cast<int>(std::lround(m_model.value().iso / m_step)));
}

void StructuresPanel::caseChanged()
{
  m_apply.stop();
  m_structures->caseChanged();
  showIso();
}

void StructuresPanel::appearanceChanged()
{
  m_structures->appearanceChanged();
  showIso();
}

} // namespace petrous::workstation
