#include "CatalogueDialog.h"

#include <algorithm>
#include <utility>

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QScrollBar>
#include <QTableWidget>
#include <QVBoxLayout>

#include "Application.h"
#include "Bind.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::workstation
{

namespace
{

enum MaterialColumn
{
  MaterialName,
  Title,
  Energy,
  Friction,
  Hardness,
  MaterialCertainty,
  MaterialSource,
  MaterialColumns
};

enum BurrColumn
{
  BurrName,
  Kind,
  Rake,
  Grit,
  Wear,
  Diameters,
  BurrCertainty,
  BurrSource,
  BurrColumns
};

QTableWidget* table(const char* name, const QString& accessible, const QStringList& columns)
{
  auto* result = new QTableWidget(0, columns.size());
  result->setObjectName(name);
  result->setAccessibleName(accessible);
  result->setHorizontalHeaderLabels(columns);
  result->verticalHeader()->hide();
  result->setSelectionBehavior(QAbstractItemView::SelectRows);
  result->setSelectionMode(QAbstractItemView::SingleSelection);
  result->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  result->horizontalHeader()->setStretchLastSection(true);
  keepKeysInEditors(*result);
  return result;
}

// With which the title of the last column, which stretches, is seen as well.
int wholeWidth(const QTableWidget& table)
{
  const QAbstractItemView& cells = table; // where it is public
  const QHeaderView& header = *table.horizontalHeader();
  const int last = header.count() - 1;
  int width = table.verticalScrollBar()->sizeHint().width() + 2 * table.frameWidth() +
              header.sectionSizeHint(last);
  for (int column = 0; column < last; ++column)
    width += std::max(header.sectionSizeHint(column), cells.sizeHintForColumn(column));
  return width;
}

void put(QTableWidget& table, int row, int column, const QString& text, bool isEditable = true)
{
  if (!table.item(row, column)) // one that is being entered must stay
    table.setItem(row, column, new QTableWidgetItem);
  QTableWidgetItem* item = table.item(row, column);
  item->setText(text);
  item->setToolTip(text);
  const Qt::ItemFlags usual = Qt::ItemIsSelectable | Qt::ItemIsEnabled;
  item->setFlags(isEditable ? usual | Qt::ItemIsEditable : usual);
}

// "“Cortical bone”, Hardness, HV", as the table shows them.
QString cellOf(const QTableWidget& table, const QString& row, int column)
{
  return CatalogueDialog::tr("“%1”, %2").arg(row, table.horizontalHeaderItem(column)->text());
}

QString number(double value)
{
  return numberText(core::plainText(value));
}

// One that was not typed over keeps the digits that are not shown.
double numberIn(const QTableWidget& table, int row, int column, double present)
{
  const QString text = table.item(row, column)->text().trimmed();
  if (text == number(present))
    return present;
  const QString plain = QString(text).remove(QChar(0x202F)).replace(',', '.'); // groups of digits
  if (const auto value = core::parseDouble(bytes(plain)))
    return *value;
  throw core::InvalidParameter("'" + bytes(text) + "' is not a number");
}

const QString kNone = QString::fromUtf8("–");

// Nothing and a dash are "not stated".
double gritIn(const QTableWidget& table, int row, double present)
{
  const QString text = table.item(row, Grit)->text().trimmed();
  return text.isEmpty() || text == kNone ? 0.0 : numberIn(table, row, Grit, present);
}

// Of the numbers. None is no certainty.
QString sourceText(const std::string& source)
{
  return source.empty() ? CatalogueDialog::tr("not stated") : phrase(source);
}

// What was shown in the window's language stays what it was, unless it was typed over.
std::string textIn(const QTableWidget& table, int row, int column, const std::string& present,
                   const QString& shown)
{
  const QString text = table.item(row, column)->text().trimmed();
  return text == shown ? present : bytes(text);
}

} // namespace

CatalogueDialog::CatalogueDialog(presenters::CatalogueEditor editor,
                                 std::function<bool(const std::string&)> isUsed, QWidget* parent)
  : QDialog(parent)
  , m_editor(std::move(editor))
  , m_isUsed(std::move(isUsed))
  , m_materials(table("materials", tr("Materials"),
                      {tr("Name"), tr("Shown as"), tr("Cutting energy, GPa"), tr("Friction"),
                       tr("Hardness, HV"), tr("How certain"), tr("Source")}))
  , m_burrs(table("burrs", tr("Burrs"),
                  {tr("Name"), tr("Kind"), tr("Rake, °"), tr("Grit, µm"), tr("Wear coefficient"),
                   tr("Diameters, mm"), tr("How certain"), tr("Source")}))
  , m_bone(new QLabel)
  , m_lost(new QLabel)
  , m_fault(new QLabel)
{
  setObjectName("catalogueDialog");
  setWindowTitle(tr("Materials and burrs"));
  auto* intro = new QLabel(tr("They hold for all cases of this library, also for the command. The "
                              "removal laws take the cutting energy and friction for a cutting "
                              "burr, the hardness for a diamond one."));
  wrapWords(*intro);
  m_bone->setObjectName("boneRamp");
  wrapWords(*m_bone);
  m_lost->setObjectName("catalogueLost");
  m_fault->setObjectName("catalogueFault");
  for (QLabel* one : {m_lost, m_fault})
  {
    wrapWords(*one);
    one->setTextFormat(Qt::PlainText);
    one->setStyleSheet(kWarningStyle);
    one->hide();
  }
  auto* addOne = button(
      tr("&Add"), "addMaterial",
      tr("Another material, with the numbers of the one that is selected. Their source is not "
         "stated until you enter it"));
  m_removeMaterial = button(tr("&Remove"), "removeMaterial", tr("Takes the selected material out"));
  auto* addOther = button(tr("A&dd"), "addBurr",
                          tr("Another burr, of the kind and with the numbers of the one that is "
                             "selected. Their source is not stated until you enter it"));
  m_removeBurr = button(tr("R&emove"), "removeBurr",
                        tr("Takes the selected burr out. Strokes and recordings keep its name"));
  const auto rowOf = [](QPushButton* first, QPushButton* second)
  {
    auto* row = new QHBoxLayout;
    row->addWidget(first);
    row->addWidget(second);
    row->addStretch(1);
    return row;
  };
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel);
  auto* builtIn = buttons->addButton(tr("As &built in"), QDialogButtonBox::ResetRole);
  builtIn->setObjectName("catalogueBuiltIn");
  builtIn->setToolTip(tr("All numbers as they come with the program"));
  m_save = buttons->button(QDialogButtonBox::Save);
  m_save->setText(tr("&Save"));
  m_save->setObjectName("catalogueSave");
  buttons->button(QDialogButtonBox::Cancel)->setText(tr("Cancel"));
  for (auto* one : buttons->buttons()) // Return enters a cell
    static_cast<QPushButton*>(one)->setAutoDefault(false);
  for (QPushButton* one : {addOne, m_removeMaterial, addOther, m_removeBurr})
    one->setAutoDefault(false);

  auto* layout = new QVBoxLayout(this);
  layout->addWidget(intro);
  layout->addWidget(m_materials, 3);
  layout->addLayout(rowOf(addOne, m_removeMaterial));
  layout->addWidget(m_bone);
  layout->addWidget(m_burrs, 2);
  layout->addLayout(rowOf(addOther, m_removeBurr));
  layout->addWidget(m_lost);
  layout->addWidget(m_fault);
  layout->addWidget(buttons);

  connect(m_materials, &QTableWidget::cellChanged, this, &CatalogueDialog::materialEntered);
  connect(m_burrs, &QTableWidget::cellChanged, this, &CatalogueDialog::burrEntered);
  for (QTableWidget* one : {m_materials, m_burrs})
    connect(one, &QTableWidget::itemSelectionChanged, this, &CatalogueDialog::enableRemove);
  connect(addOne, &QPushButton::clicked, this, &CatalogueDialog::addMaterial);
  connect(m_removeMaterial, &QPushButton::clicked, this, &CatalogueDialog::removeMaterial);
  connect(addOther, &QPushButton::clicked, this, &CatalogueDialog::addBurr);
  connect(m_removeBurr, &QPushButton::clicked, this, &CatalogueDialog::removeBurr);
  connect(builtIn, &QPushButton::clicked, this, &CatalogueDialog::setBuiltIn);
  connect(buttons, &QDialogButtonBox::accepted, this, &CatalogueDialog::save);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  fill();
  const QMargins beside = layout->contentsMargins();
  const int whole = std::max(wholeWidth(*m_materials), wholeWidth(*m_burrs));
  resizeOnScreen(*this, {std::max(1000, whole + beside.left() + beside.right()), 560});
}

void CatalogueDialog::fill()
{
  const QScopedValueRollback<bool> filling(m_filling, true);
  const auto fillTable = [](QTableWidget& one, std::size_t rows, const auto& fillRow)
  {
    const int count = static_cast<int>(rows);
    const int current = one.currentRow();
    const bool isOther = count != one.rowCount();
    one.setRowCount(count);
    for (int row = 0; row < count; ++row)
      fillRow(row);
    if (isOther || current < 0) // goes to the first column, from which Tab would go on
      one.selectRow(std::clamp(current, 0, count - 1));
  };
  fillTable(*m_materials, m_editor.materials().size(), [this](int row) { fillMaterial(row); });
  fillTable(*m_burrs, m_editor.burrs().size(), [this](int row) { fillBurr(row); });
  enableRemove();
  const auto& bone = m_editor.bone();
  m_bone->setText(
      tr("Bone that nobody labelled goes from “%1” at %2 HU to “%3” at %4 HU.")
          .arg(words(bone.cellular), number(bone.low), words(bone.cortical), number(bone.high)));
  QStringList lost;
  for (const std::string& name : m_editor.lostMaterials())
    lost +=
        tr("Other cases that use “%1” cannot be drilled until it exists again.").arg(words(name));
  for (const std::string& name : m_editor.lostBurrs())
    lost += tr("Cases with the burr “%1” get the usual one of its kind until it exists again.")
                .arg(words(name));
  m_lost->setText(lost.join(' '));
  m_lost->setVisible(!lost.isEmpty());
  m_fault->hide();
}

void CatalogueDialog::enableRemove()
{
  const int material = m_materials->currentRow();
  m_removeMaterial->setEnabled(material >= 0 &&
                               material < static_cast<int>(m_editor.materials().size()) &&
                               !m_editor.isBuiltIn(static_cast<std::size_t>(material)));
  const int burr = m_burrs->currentRow();
  m_removeBurr->setEnabled(burr >= 0 && burr < static_cast<int>(m_editor.burrs().size()) &&
                           !m_editor.isUsualBurr(static_cast<std::size_t>(burr)));
}

void CatalogueDialog::fillMaterial(int row)
{
  const auto at = static_cast<std::size_t>(row);
  const auto& one = m_editor.materials()[at];
  put(*m_materials, row, MaterialName, words(one.name), !m_editor.isBuiltIn(at));
  put(*m_materials, row, Title, phrase(one.title));
  put(*m_materials, row, Energy, number(one.specificEnergy));
  put(*m_materials, row, Friction, number(one.friction));
  put(*m_materials, row, Hardness, number(one.hardness));
  put(*m_materials, row, MaterialCertainty, sourceText(one.certainty));
  put(*m_materials, row, MaterialSource, sourceText(one.source));
}

void CatalogueDialog::fillBurr(int row)
{
  const auto at = static_cast<std::size_t>(row);
  const auto& one = m_editor.burrs()[at];
  const bool isCutting = one.kind == dissection::Burr::Kind::Cutting;
  put(*m_burrs, row, BurrName, words(one.name), !m_editor.isUsualBurr(at));
  put(*m_burrs, row, Kind, isCutting ? tr("Cutting") : tr("Diamond"), false);
  put(*m_burrs, row, Rake, isCutting ? number(one.constant) : kNone, isCutting);
  put(*m_burrs, row, Grit, isCutting || one.grit <= 0.0 ? kNone : number(one.grit), !isCutting);
  put(*m_burrs, row, Wear, isCutting ? kNone : number(one.constant), !isCutting);
  put(*m_burrs, row, Diameters, numberText(presenters::diametersText(one.diameters)));
  put(*m_burrs, row, BurrCertainty, sourceText(one.certainty));
  put(*m_burrs, row, BurrSource, sourceText(one.source));
}

// What is refused is said, and the table shows what holds.
void CatalogueDialog::enter(const std::function<void()>& change, const QString& where)
{
  QString why;
  try
  {
    change();
  }
  catch (const core::Error& error)
  {
    const QString what = sentence(toString(error));
    why = where.isEmpty() ? capitalized(what) : tr("%1: %2").arg(where, what);
  }
  fill();
  m_fault->setText(why);
  m_fault->setVisible(!why.isEmpty());
}

void CatalogueDialog::checkUnused(const std::string& material) const
{
  if (m_isUsed(material))
    throw core::InvalidParameter("material '" + material +
                                 "' is that of a structure of the open case");
}

void CatalogueDialog::materialEntered(int row, int column)
{
  if (m_filling)
    return;
  enter(
      [&]
      {
        const auto at = static_cast<std::size_t>(row);
        auto one = m_editor.materials()[at];
        const std::string name = bytes(m_materials->item(row, MaterialName)->text().trimmed());
        if (name != one.name)
          checkUnused(one.name);
        one.name = name;
        one.title = textIn(*m_materials, row, Title, one.title, phrase(one.title));
        one.specificEnergy = numberIn(*m_materials, row, Energy, one.specificEnergy);
        one.friction = numberIn(*m_materials, row, Friction, one.friction);
        one.hardness = numberIn(*m_materials, row, Hardness, one.hardness);
        one.certainty =
            textIn(*m_materials, row, MaterialCertainty, one.certainty, sourceText(one.certainty));
        one.source = textIn(*m_materials, row, MaterialSource, one.source, sourceText(one.source));
        m_editor.setMaterial(at, one);
      },
      cellOf(*m_materials, phrase(m_editor.materials()[static_cast<std::size_t>(row)].title),
             column));
}

void CatalogueDialog::burrEntered(int row, int column)
{
  if (m_filling)
    return;
  enter(
      [&]
      {
        const auto at = static_cast<std::size_t>(row);
        auto one = m_editor.burrs()[at];
        one.name = bytes(m_burrs->item(row, BurrName)->text().trimmed());
        const bool isCutting = one.kind == dissection::Burr::Kind::Cutting;
        one.constant = numberIn(*m_burrs, row, isCutting ? Rake : Wear, one.constant);
        const std::string diameters = bytes(m_burrs->item(row, Diameters)->text().trimmed());
        if (diameters != bytes(numberText(presenters::diametersText(one.diameters))))
          one.diameters = presenters::diametersFrom(diameters);
        if (!isCutting)
          one.grit = gritIn(*m_burrs, row, one.grit);
        one.certainty =
            textIn(*m_burrs, row, BurrCertainty, one.certainty, sourceText(one.certainty));
        one.source = textIn(*m_burrs, row, BurrSource, one.source, sourceText(one.source));
        m_editor.setBurr(at, one);
      },
      cellOf(*m_burrs, words(m_editor.burrs()[static_cast<std::size_t>(row)].name), column));
}

// A copy of the current row, whose name is edited next.
void CatalogueDialog::addRow(QTableWidget& table, int nameColumn,
                             std::size_t (presenters::CatalogueEditor::*add)(std::size_t like))
{
  int added = -1;
  enter(
      [&]
      {
        const auto like = static_cast<std::size_t>(std::max(table.currentRow(), 0));
        added = static_cast<int>((m_editor.*add)(like));
      });
  if (added < 0)
    return;
  table.setCurrentCell(added, nameColumn);
  table.setFocus();
  table.editItem(table.item(added, nameColumn));
}

void CatalogueDialog::addMaterial()
{
  addRow(*m_materials, MaterialName, &presenters::CatalogueEditor::addMaterial);
}

void CatalogueDialog::removeMaterial()
{
  const int row = m_materials->currentRow();
  if (row < 0)
    return;
  enter(
      [&]
      {
        const auto at = static_cast<std::size_t>(row);
        checkUnused(m_editor.materials()[at].name);
        m_editor.removeMaterial(at);
      });
}

void CatalogueDialog::addBurr()
{
  addRow(*m_burrs, BurrName, &presenters::CatalogueEditor::addBurr);
}

void CatalogueDialog::removeBurr()
{
  const int row = m_burrs->currentRow();
  if (row >= 0)
    enter([&] { m_editor.removeBurr(static_cast<std::size_t>(row)); });
}

void CatalogueDialog::setBuiltIn()
{
  enter(
      [&]
      {
        for (std::size_t at = 0; at < m_editor.materials().size(); ++at)
          if (!m_editor.isBuiltIn(at))
            checkUnused(m_editor.materials()[at].name);
        m_editor.setBuiltIn();
      });
}

void CatalogueDialog::save()
{
  m_fault->hide();
  m_save->setFocus(); // enters what is being typed
  if (!m_fault->isHidden())
    return;
  if (!m_editor.changed())
    return reject();
  bool isSaved = false;
  enter(
      [&]
      {
        m_editor.save();
        isSaved = true;
      });
  if (!isSaved)
    return;
  emit saved();
  accept();
}

} // namespace petrous::workstation
