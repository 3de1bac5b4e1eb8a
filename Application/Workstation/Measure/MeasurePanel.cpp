#include "MeasurePanel.h"

#include <QAction>
#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Bind.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Scene/Placement.h"

namespace petrous::workstation
{

namespace
{

using scene::Measurement;
constexpr int kDot = 11; // px

enum Column
{
  Name,
  Value,
  Columns
};

QPixmap dot(const QColor& color)
{
  QPixmap picture(kDot, kDot);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(color);
  painter.setPen(Qt::NoPen);
  painter.drawEllipse(QRectF(0.5, 0.5, kDot - 1.0, kDot - 1.0));
  return picture;
}

QString kindText(Measurement::Kind kind)
{
  switch (kind)
  {
  case Measurement::Kind::Mark:
    return MeasurePanel::tr("Mark");
  case Measurement::Kind::Distance:
    return MeasurePanel::tr("Distance");
  case Measurement::Kind::Length:
    return MeasurePanel::tr("Length along a line");
  case Measurement::Kind::Angle:
    return MeasurePanel::tr("Angle");
  case Measurement::Kind::Area:
    return MeasurePanel::tr("Area");
  case Measurement::Kind::Thickness:
    break;
  }
  return MeasurePanel::tr("Wall thickness");
}

QString tipOf(const scene::Case& value, const Measurement& measurement)
{
  QString tip = kindText(measurement.kind);
  QString remark;
  for (const presenters::Quantity& quantity : presenters::quantitiesOf(value, measurement))
  {
    tip += "\n" + phrase(quantity.name) + ": " + phrase(presenters::toString(quantity));
    remark = phrase(quantity.remark);
  }
  return remark.isEmpty() ? tip : tip + "\n" + remark;
}

} // namespace

QColor measureColor(Measurement::Kind kind)
{
  switch (kind)
  {
  case Measurement::Kind::Mark:
    return "#ffd54a";
  case Measurement::Kind::Distance:
    return "#56c8ff";
  case Measurement::Kind::Length:
    return "#ffb07a";
  case Measurement::Kind::Angle:
    return "#f7a8d8";
  case Measurement::Kind::Area:
    return "#7fd6a4";
  case Measurement::Kind::Thickness:
    break;
  }
  return "#d0d7ff";
}

MeasurePanel::MeasurePanel(presenters::WorkstationModel& model,
                           presenters::MeasurementEditor& editor,
                           const std::vector<QAction*>& tools, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_editor(editor)
  , m_list(new QTreeWidget)
  , m_hint(new QLabel)
  , m_empty(new QLabel(tr("Nothing is measured yet.")))
  , m_structure(choiceBox("measureStructure", tr("The structure that is measured")))
  , m_other(choiceBox("measureOther", tr("Its dimensions, or the shortest distance from its "
                                         "surface to that of another one")))
  , m_quantities(new QTreeWidget)
{
  m_hint->setObjectName("measureHint");
  wrapWords(*m_hint, 2);
  m_hint->setTextFormat(Qt::PlainText);
  m_hint->setAlignment(Qt::AlignLeft | Qt::AlignTop);

  m_list->setObjectName("measurements");
  m_list->setAccessibleName(tr("Measurements"));
  m_list->setColumnCount(Columns);
  m_list->setHeaderLabels({tr("Name"), tr("Value")});
  m_list->setRootIsDecorated(false);
  m_list->setUniformRowHeights(true);
  m_list->setEditTriggers(QAbstractItemView::EditKeyPressed);
  m_list->setMinimumHeight(8 * fontMetrics().lineSpacing());
  m_list->header()->setStretchLastSection(true);
  m_list->header()->setSectionResizeMode(Name, QHeaderView::ResizeToContents);
  m_list->setTextElideMode(Qt::ElideMiddle);
  m_list->installEventFilter(this);
  keepKeysInEditors(*m_list);
  connect(m_list, &QTreeWidget::itemChanged, this, &MeasurePanel::takeItem);
  connect(m_list, &QTreeWidget::itemSelectionChanged, this,
          [this]
          {
            if (!m_showing)
              emit chosenChanged(chosen());
          });
  connect(m_list, &QTreeWidget::itemDoubleClicked, this,
          [this](QTreeWidgetItem* item, int column)
          {
            if (column == Name)
              m_list->editItem(item, Name);
            else
              emit goToAsked(m_list->indexOfTopLevelItem(item));
          });

  auto* go = button(tr("&Go to"), "goToMeasurement", tr("The slices show it (Enter)"));
  auto* rename = button(tr("&Rename"), "renameMeasurement", tr("Type another name (F2)"));
  auto* remove = button(tr("&Delete"), "removeMeasurement", tr("Ctrl+Z brings it back (Del)"));
  auto* copy = button(tr("Cop&y"), "copyMeasurements",
                      tr("Names and values, to be pasted elsewhere: of the chosen one, or of all"));
  m_export = button(tr("E&xport…"), "exportMeasurements",
                    tr("A table (CSV) of all measurements and of the volumes of structures"));
  m_ofOne = {go, rename, remove};
  m_ofAny = {copy};
  connect(go, &QPushButton::clicked, this, [this] { emit goToAsked(chosen()); });
  connect(rename, &QPushButton::clicked, this,
          [this] { edit(static_cast<std::size_t>(chosen())); });
  connect(remove, &QPushButton::clicked, this, [this] { emit removalAsked(chosen()); });
  connect(copy, &QPushButton::clicked, this, [this] { emit copyAsked(chosen()); });
  connect(m_export, &QPushButton::clicked, this, &MeasurePanel::exportAsked);
  auto* buttons = new QGridLayout;
  buttons->setSpacing(4);
  int place = 0;
  for (QPushButton* one : {go, rename, remove, copy, m_export})
  {
    buttons->addWidget(one, place / 3, place % 3);
    ++place;
  }

  m_measure = button(tr("&Measure"), "measureStructureNow",
                     tr("Volume, extents along the principal axes, and of a canal or nerve length "
                        "and diameters; or the distance"));
  connect(m_measure, &QPushButton::clicked, this,
          [this] {
            emit structureAsked(m_structure->currentData().toString(),
                                m_other->currentData().toString());
          });
  m_quantities->setObjectName("measureQuantities");
  m_quantities->setAccessibleName(tr("Dimensions"));
  m_quantities->setColumnCount(2);
  m_quantities->setHeaderHidden(true);
  m_quantities->setRootIsDecorated(false);
  m_quantities->setSelectionMode(QAbstractItemView::NoSelection);
  m_quantities->setFocusPolicy(Qt::TabFocus);
  m_quantities->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  m_quantities->setMinimumHeight(9 * fontMetrics().lineSpacing());
  m_quantities->hide();
  auto* form = new QFormLayout;
  form->addRow(tr("&Structure"), m_structure);
  form->addRow(tr("&What"), m_other);
  form->addRow({}, m_measure);

  auto* inside = new QWidget;
  auto* layout = new QVBoxLayout(inside);
  layout->setContentsMargins(10, 8, 10, 8);
  layout->setSpacing(6);
  layout->addLayout(toolGrid(tools, "measureTool"));
  layout->addWidget(m_hint);
  layout->addWidget(m_list, 1);
  m_empty->setObjectName("dim");
  layout->addWidget(m_empty);
  layout->addLayout(buttons);
  layout->addSpacing(6);
  layout->addLayout(form);
  layout->addWidget(m_quantities, 1);
  layOutPanel(*this, inside, new QWidget);
  refresh();
}

QWidget* MeasurePanel::mainControl()
{
  return m_list;
}

void MeasurePanel::caseChanged()
{
  m_quantities->hide();
  fillStructures();
  refresh();
}

void MeasurePanel::partsChanged()
{
  fillStructures();
  refresh();
}

void MeasurePanel::partRenamed(const std::string& from, const std::string& to)
{
  for (QComboBox* box : {m_structure, m_other}) // the list is made anew by what it had chosen
    if (const int row = box->findData(words(from)); row >= 0)
      box->setItemData(row, words(to));
}

void MeasurePanel::fillStructures()
{
  const QString structure = m_structure->currentData().toString();
  const QString other = m_other->currentData().toString();
  m_structure->clear();
  m_other->clear();
  m_other->addItem(tr("dimensions and volume"), QString());
  if (m_model.hasCase())
  {
    const scene::Case& value = m_model.value();
    for (const std::string& name : scene::partNames(value))
    {
      const std::string kind = scene::kindOfPart(value, name);
      if ((kind != "structure" && kind != "mesh") || !scene::missingPlace(value, name).empty())
        continue;
      const QString shown = shownName(name);
      if (m_structure->findData(words(name)) >= 0)
        continue; // both as label and as mesh
      m_structure->addItem(shown, words(name));
      m_other->addItem(tr("distance to %1").arg(shown), words(name));
    }
  }
  m_structure->setCurrentIndex(std::max(0, m_structure->findData(structure)));
  m_other->setCurrentIndex(std::max(0, m_other->findData(other)));
  m_measure->setEnabled(m_structure->count() > 0);
}

void MeasurePanel::stateChanged()
{
  enableExport(); // what was drilled has a row
}

void MeasurePanel::enableExport()
{
  const bool isOffered = m_model.hasCase() && presenters::hasMeasurementRows(m_model.value());
  m_export->setEnabled(isOffered);
  emit exportOffered(isOffered);
}

int MeasurePanel::chosen() const
{
  const auto items = m_list->selectedItems();
  return items.isEmpty() ? -1 : m_list->indexOfTopLevelItem(items.first());
}

void MeasurePanel::refresh()
{
  const QScopedValueRollback<bool> showing(m_showing, true);
  const auto& all = m_editor.all();
  while (m_list->topLevelItemCount() > static_cast<int>(all.size()))
    delete m_list->takeTopLevelItem(m_list->topLevelItemCount() - 1);
  while (m_list->topLevelItemCount() < static_cast<int>(all.size()))
  {
    auto* item = new QTreeWidgetItem(m_list);
    item->setFlags(item->flags() | Qt::ItemIsEditable | Qt::ItemIsUserCheckable);
  }
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    QTreeWidgetItem* item = m_list->topLevelItem(static_cast<int>(n));
    const Measurement& one = all[n];
    const QString name = words(one.name);
    if (item->text(Name) != name)
      item->setText(Name, name);
    item->setIcon(Name, dot(measureColor(one.kind)));
    item->setCheckState(Name, one.shown ? Qt::Checked : Qt::Unchecked);
    const QString value = phrase(presenters::summaryOf(m_model.value(), one));
    if (item->text(Value) != value)
      item->setText(Value, value);
    const QString tip = tipOf(m_model.value(), one);
    item->setToolTip(Name, tip);
    item->setToolTip(Value, tip);
    item->setSelected(m_editor.chosen() == n);
  }
  if (m_editor.chosen())
    m_list->setCurrentItem(m_list->topLevelItem(static_cast<int>(*m_editor.chosen())));
  m_empty->setVisible(all.empty());
  for (QPushButton* one : m_ofOne)
    one->setEnabled(m_editor.chosen().has_value());
  for (QPushButton* one : m_ofAny)
    one->setEnabled(!all.empty());
  enableExport();
  const std::string hint = m_editor.hint();
  m_hint->setText(!m_refusal.isEmpty() ? m_refusal
                  : hint.empty() ? tr("Choose a tool, then click in the slices or on the surface "
                                      "in the 3D view. Points can be dragged.")
                                 : phrase(hint) + " " + tr("Esc puts the tool away."));
  m_hint->setStyleSheet(m_refusal.isEmpty() ? QString() : QString(kWarningStyle));
}

void MeasurePanel::say(const QString& line)
{
  m_refusal = line;
  refresh();
}

void MeasurePanel::edit(std::size_t measurement)
{
  if (QTreeWidgetItem* item = m_list->topLevelItem(static_cast<int>(measurement)))
    m_list->editItem(item, Name);
}

void MeasurePanel::takeItem(QTreeWidgetItem* item, int column)
{
  if (m_showing || column != Name)
    return;
  const int row = m_list->indexOfTopLevelItem(item);
  const auto& all = m_editor.all();
  if (row < 0 || row >= static_cast<int>(all.size()))
    return;
  const Measurement& one = all[static_cast<std::size_t>(row)];
  const bool isShown = item->checkState(Name) == Qt::Checked;
  const QString name = item->text(Name).trimmed();
  if (isShown != one.shown)
    emit shownAsked(row, isShown);
  else if (bytes(name) != one.name)
    emit renamed(row, name);
}

bool MeasurePanel::eventFilter(QObject* watched, QEvent* event)
{
  if (watched == m_list && chosen() >= 0 &&
      (event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride))
  {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool isOurs = key == Qt::Key_Delete || key == Qt::Key_Return || key == Qt::Key_Enter;
    if (isOurs && event->type() == QEvent::ShortcutOverride)
    {
      event->accept();
      return true;
    }
    if (isOurs)
    {
      if (key == Qt::Key_Delete)
        emit removalAsked(chosen());
      else
        emit goToAsked(chosen());
      return true;
    }
  }
  return Panel::eventFilter(watched, event);
}

void MeasurePanel::showBusy()
{
  m_quantities->clear();
  new QTreeWidgetItem(m_quantities, {tr("Measuring…")});
  m_quantities->show();
}

void MeasurePanel::showQuantities(const std::vector<presenters::Quantity>& quantities)
{
  m_quantities->clear();
  for (const presenters::Quantity& quantity : quantities)
  {
    auto* item = new QTreeWidgetItem(
        m_quantities, {phrase(quantity.name), phrase(presenters::toString(quantity))});
    for (int column = 0; column < 2; ++column)
      item->setToolTip(column, phrase(quantity.remark));
  }
  m_quantities->show();
}

} // namespace petrous::workstation
