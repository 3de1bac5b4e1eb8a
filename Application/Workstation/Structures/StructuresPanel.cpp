#include "StructuresPanel.h"

#include <algorithm>
#include <cmath>

#include <QAction>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QScopedValueRollback>
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
constexpr int kPadding = 4;    // px, beside a column's text
constexpr int kSwatch = 30;    // px, colour and margins of a name
constexpr int kLeastName = 16; // characters; where the panel is narrower it scrolls sideways
} // namespace

StructuresPanel::StructuresPanel(presenters::WorkstationModel& model, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_structures(new StructuresModel(model, this))
  , m_list(new QTreeView)
  , m_slider(new QSlider(Qt::Horizontal))
  , m_box(numberBox("isoBox", {}, {0.0, 0.0, {}, 0, 1.0}))
{
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  addThreshold(*layout);
  addList(*layout);
  setMinimumWidth(280);
  showRange();
}

void StructuresPanel::addThreshold(QVBoxLayout& layout)
{
  m_slider->setPageStep(50);
  m_slider->setObjectName("isoSlider");
  m_bound.add(
      m_box, [this] { return m_model.hasCase() ? m_model.value().iso : m_box->value(); },
      [this](double value) { m_model.setIso(value); }, Bindings::kSettle);
  m_bound.add(
      m_slider, [this] { return static_cast<int>(std::lround(m_box->value() / m_step)); },
      [this](int steps) { m_box->setValue(m_step * steps); });
  m_threshold = new QLabel;
  m_threshold->setObjectName("thresholdName");
  m_threshold->setBuddy(m_box);
  auto* top = new QHBoxLayout;
  top->addWidget(m_threshold);
  top->addStretch();
  top->addWidget(m_box);
  auto* head = new QVBoxLayout;
  head->setContentsMargins(10, 8, 10, 6);
  head->addLayout(top);
  head->addWidget(m_slider);
  layout.addLayout(head);
}

void StructuresPanel::addList(QVBoxLayout& layout)
{
  m_list->setModel(m_structures);
  m_list->setObjectName("structures");
  m_list->setRootIsDecorated(false);
  m_list->setUniformRowHeights(true);
  m_list->setAlternatingRowColors(true);
  m_list->setAllColumnsShowFocus(true);
  m_list->setTextElideMode(Qt::ElideMiddle); // names often differ at their end: left, right
  m_list->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  QHeaderView* header = m_list->header();
  header->setStretchLastSection(false);
  header->setSectionsMovable(false);
  header->setMinimumSectionSize(20);
  header->setSectionResizeMode(QHeaderView::Fixed);
  header->setStyleSheet(QString("QHeaderView::section { padding: 4px %1px; }").arg(kPadding));
  header->setSectionResizeMode(StructuresModel::Name, QHeaderView::Interactive);
  connect(header, &QHeaderView::sectionResized, this,
          [this](int column, int, int width)
          {
            if (column == StructuresModel::Name && !m_fitting)
              m_nameWidth = width;
          });
  m_list->viewport()->installEventFilter(this);
  connect(m_structures, &QAbstractItemModel::modelReset, this, &StructuresPanel::fitColumns);
  connect(m_structures, &QAbstractItemModel::dataChanged, this, &StructuresPanel::fitColumns);
  fitColumns();

  const auto addAction = [this](const QString& text, int key, const char* name, auto signal)
  {
    auto* action = new QAction(text, m_list);
    action->setObjectName(name);
    action->setShortcut(key);
    action->setShortcutContext(Qt::WidgetShortcut);
    connect(action, &QAction::triggered, this,
            [this, signal]
            {
              if (const QString part = chosen(); !part.isEmpty())
                emit(this->*signal)(part);
            });
    m_list->addAction(action);
  };
  addAction(tr("&Rename…"), Qt::Key_F2, "renamePart", &StructuresPanel::renamingAsked);
  addAction(tr("Re&move from the case"), Qt::Key_Delete, "removePart",
            &StructuresPanel::removalAsked);
  m_list->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(m_list, &QTreeView::customContextMenuRequested, this, &StructuresPanel::offer);
  layout.addWidget(m_list, 1);
  m_count = new QLabel;
  m_count->setObjectName("structuresCount");
  m_count->setContentsMargins(10, 3, 10, 3);
  layout.addWidget(m_count);
  const auto count = [this] { m_count->setText(m_structures->countText()); };
  connect(m_structures, &QAbstractItemModel::modelReset, m_count, count);
  connect(m_structures, &QAbstractItemModel::dataChanged, m_count, count);
}

bool StructuresPanel::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Resize)
    fitNames();
  return Panel::eventFilter(watched, event);
}

// Numbers, check boxes and titles get what they need, and names all that is left.
void StructuresPanel::fitColumns()
{
  constexpr int kCheckBox = 14; // px
  const auto textWidth = [](const QWidget& widget, const QVariant& text)
  { return widget.fontMetrics().horizontalAdvance(text.toString()); };
  QHeaderView* header = m_list->header();
  for (int column = StructuresModel::VolumeColumn; column < m_structures->columnCount(); ++column)
  {
    int width = std::max(
        kCheckBox,
        textWidth(*header, m_structures->headerData(column, Qt::Horizontal, Qt::DisplayRole)));
    for (int row = 0; row < m_structures->rowCount(); ++row)
      width = std::max(width, textWidth(*m_list, m_structures->index(row, column).data()));
    header->resizeSection(column, width + 2 * kPadding + 4);
  }
  fitNames();
}

// The names take what the other columns leave, or as much more as the user gave them, and never so
// little that none can be read.
void StructuresPanel::fitNames()
{
  const QScopedValueRollback<bool> fitting(m_fitting, true);
  QHeaderView* header = m_list->header();
  const int others = header->length() - header->sectionSize(StructuresModel::Name);
  const int least = kSwatch + kLeastName * m_list->fontMetrics().averageCharWidth();
  header->resizeSection(StructuresModel::Name,
                        std::max({m_list->viewport()->width() - others, m_nameWidth, least}));
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
  add(isOnMr() ? tr("Soft tissue, as where nothing is drawn") : tr("Bone, by its density"), {});
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
  QAction* thickness = menu.addAction((isOnMr() ? tr("Colour tissue by its thickness over %1")
                                                : tr("Colour bone by its thickness over %1"))
                                          .arg(QString(name).replace('_', ' ')));
  thickness->setCheckable(true);
  thickness->setChecked(m_model.thicknessOver() == bytes(name));
  menu.addSeparator();
  m_list->setCurrentIndex(m_list->indexAt(position));
  menu.addActions(m_list->actions());
  if (menu.exec(m_list->viewport()->mapToGlobal(position)) == thickness)
    emit thicknessAsked(name);
}

// The threshold, within the image's range and in its unit.
void StructuresPanel::showRange()
{
  const auto display =
      m_model.hasCase() ? presenters::displayOf(m_model.value()) : presenters::IntensityDisplay();
  m_bound.quietly(
      [&]
      {
        m_step = display.step;
        m_slider->setRange(static_cast<int>(std::floor(display.least / m_step)),
                           static_cast<int>(std::ceil(display.most / m_step)));
        m_box->setDecimals(display.decimals);
        m_box->setRange(display.least, display.most);
        m_box->setSingleStep(10.0 * m_step);
        m_box->setSuffix(words(display.suffix()));
      });
  m_threshold->setText(isOnMr() ? tr("S&urface threshold") : tr("&Bone threshold"));
  const QString tip =
      isOnMr() ? tr("The surface is where the MR gets brighter than this, in its own unit")
      : display.hounsfield ? tr("Bone is what is denser than this, in Hounsfield units (HU)")
                           : tr("Bone is what is denser than this, in the image's own unit: it is "
                                "not in Hounsfield units");
  m_slider->setToolTip(tip);
  m_box->setToolTip(tip);
  m_bound.refresh();
}

bool StructuresPanel::isOnMr() const
{
  return m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr;
}

void StructuresPanel::caseChanged()
{
  m_bound.drop();
  m_structures->caseChanged();
  showRange();
}

void StructuresPanel::appearanceChanged()
{
  m_structures->appearanceChanged();
  showRange();
}

} // namespace petrous::workstation
