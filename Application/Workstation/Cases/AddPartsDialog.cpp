#include "AddPartsDialog.h"

#include <algorithm>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Scene/Case.h"
#include "petrous/Scene/FreeName.h"

namespace petrous::workstation
{

AddPartsDialog::AddPartsDialog(const QString& title, const QString& more, const QString& accept,
                               const std::vector<Part>& parts, std::vector<std::string> taken,
                               const std::vector<std::string>& mr, const QString& primary,
                               QWidget* parent, const QString& skip)
  : QDialog(parent)
  , m_taken(std::move(taken))
  , m_advice(new QLabel)
{
  setObjectName("addParts");
  setWindowTitle(title);
  const auto plain = [](const QString& text)
  {
    auto* label = new QLabel(text);
    label->setTextFormat(Qt::PlainText);
    wrapWords(*label);
    return label;
  };
  auto* rows = new QWidget;
  auto* grid = new QGridLayout(rows);
  grid->setColumnMinimumWidth(0, 220);
  grid->setColumnStretch(0, 1);
  grid->setColumnStretch(1, 1);
  int row = 0;
  for (const Part& part : parts)
  {
    Row widgets;
    grid->addWidget(plain(part.what), row, 0);
    if (part.isNamed)
    {
      widgets.name = new QLineEdit(words(part.name));
      widgets.name->setObjectName("partName");
      widgets.name->setPlaceholderText(tr("name"));
      widgets.name->setMinimumWidth(160);
      widgets.name->setToolTip(tr("The name in the case. The file's own is not kept: it may be a "
                                  "patient's."));
      connect(widgets.name, &QLineEdit::textChanged, this, &AddPartsDialog::check);
      grid->addWidget(widgets.name, row, 1);
    }
    else if (part.unnamed > 0)
      grid->addWidget(tableChoice(m_rows.size(), part), row, 1);
    else
      grid->addWidget(plain(part.count == 0 ? tr("named by the file")
                            : part.count == 1
                                ? tr("1 structure, named by the file")
                                : tr("%1 structures, named by the file").arg(part.count)),
                      row, 1);
    if (part.isPlaced)
    {
      widgets.place = new QComboBox;
      widgets.place->setObjectName("partPlace");
      widgets.place->addItem(tr("where the file says"), QString());
      widgets.place->addItem(tr("on the %1").arg(primary), QString("ct"));
      for (const std::string& name : mr)
        widgets.place->addItem(tr("on the MR %1").arg(words(name)), words(name));
      widgets.place->setToolTip(tr("The image on which it was drawn"));
      grid->addWidget(widgets.place, row, 2);
    }
    if (widgets.name && part.objects > 1)
    {
      widgets.perObject = objectsChoice(widgets.name, part);
      grid->addWidget(widgets.perObject, ++row, 1, 1, 2);
    }
    m_rows.push_back(widgets);
    ++row;
  }
  grid->setRowStretch(row, 1);
  auto* scroll = new QScrollArea;
  scroll->setWidget(rows);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  m_advice->setTextFormat(Qt::PlainText);
  m_advice->setObjectName("dim");
  wrapWords(*m_advice);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_accept = buttons->addButton(accept, QDialogButtonBox::AcceptRole);
  if (!skip.isEmpty())
    connect(buttons->addButton(skip, QDialogButtonBox::ActionRole), &QPushButton::clicked, this,
            [this] { done(kSkipped); });
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(plain(title));
  layout->addWidget(scroll, 1);
  layout->addWidget(plain(more));
  layout->addWidget(m_advice);
  layout->addWidget(buttons);
  const QSize needed = rows->sizeHint();
  resizeOnScreen(*this, {std::max(620, needed.width() + 60), std::min(520, 170 + needed.height())});
  check();
}

namespace
{

QString unnamedText(const AddPartsDialog::Part& part)
{
  if (part.count <= part.unnamed)
    return part.unnamed == 1
               ? AddPartsDialog::tr("1 structure, without a name")
               : AddPartsDialog::tr("%1 structures, none with a name").arg(part.unnamed);
  return part.unnamed == 1 ? AddPartsDialog::tr("%1 structures, 1 without a name").arg(part.count)
                           : AddPartsDialog::tr("%1 structures, %2 without a name")
                                 .arg(part.count)
                                 .arg(part.unnamed);
}

} // namespace

// How many structures there are and have no name, and the table that has them.
QWidget* AddPartsDialog::tableChoice(std::size_t row, const Part& part)
{
  auto* state = new QLabel(unnamedText(part));
  state->setObjectName("namesState");
  state->setTextFormat(Qt::PlainText);
  wrapWords(*state);
  auto* choose = new QPushButton(tr("&Names from a table…"));
  choose->setObjectName("namesTable");
  choose->setAutoDefault(false);
  choose->setToolTip(tr("A table of indices, names and colours: 3D Slicer (.ctbl), FreeSurfer or "
                        "ITK-SNAP (.txt, .label), CSV, TSV, JSON"));
  connect(choose, &QPushButton::clicked, this,
          [this, row, state, folder = part.folder]
          {
            const QString file = QFileDialog::getOpenFileName(
                this, tr("Table of names"), folder,
                tr("Tables of names (*.ctbl *.txt *.label *.csv *.tsv *.json);;All files (*)"));
            if (file.isEmpty())
              return;
            m_rows[row].table = pathOf(file);
            state->setText(tr("named by “%1”").arg(QFileInfo(file).fileName()));
          });
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(state);
  layout->addWidget(choose);
  return box;
}

// Whether the objects of a mesh file become a structure each; the name is then before theirs.
QCheckBox* AddPartsDialog::objectsChoice(QLineEdit* name, const Part& part)
{
  auto* choice = new QCheckBox(tr("One structure per &object (%1)").arg(part.objects));
  choice->setObjectName("perObject");
  choice->setToolTip(
      tr("Each object of the file becomes a structure of its own, under the object's "
         "name, without words that may be a patient's name. A name given here is "
         "put before it. Otherwise all are one structure."));
  connect(choice, &QCheckBox::toggled, this,
          [this, name, proposed = name->text()](bool isOn)
          {
            name->setPlaceholderText(isOn ? tr("named by the file") : tr("name"));
            if (isOn && name->text() == proposed)
              name->clear();
            else if (!isOn && name->text().isEmpty())
              name->setText(proposed);
            check();
          });
  return choice;
}

std::vector<AddPartsDialog::Answer> AddPartsDialog::answers() const
{
  std::vector<Answer> answers;
  for (const Row& row : m_rows)
    answers.push_back({row.name ? bytes(row.name->text().trimmed()) : std::string(),
                       row.place ? bytes(row.place->currentData().toString()) : std::string(),
                       row.table, row.perObject && row.perObject->isChecked()});
  return answers;
}

void AddPartsDialog::check()
{
  QStringList advice; // of all rows
  std::vector<std::string> taken = m_taken;
  for (const Row& row : m_rows)
  {
    if (!row.name)
      continue;
    const std::string name = bytes(row.name->text().trimmed());
    const bool isPerObject = row.perObject && row.perObject->isChecked();
    if (isPerObject && name.empty())
      continue;
    if (name.empty())
      advice += tr("Each part needs a name.");
    else if (!isPerObject && std::any_of(taken.begin(), taken.end(),
                                         [read = scene::asRead(name)](const auto& one)
                                         { return scene::asRead(one) == read; }))
      advice += tr("“%1” is taken; give another name.").arg(words(name));
    else
      try
      {
        scene::checkPartName(name);
      }
      catch (const core::InvalidParameter& fault)
      {
        advice += phrase(fault.what());
      }
    if (!isPerObject)
      taken.push_back(name);
  }
  advice.removeDuplicates();
  m_advice->setText(advice.join('\n'));
  m_accept->setEnabled(advice.isEmpty());
}

} // namespace petrous::workstation
