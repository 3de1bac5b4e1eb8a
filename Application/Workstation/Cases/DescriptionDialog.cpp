#include "DescriptionDialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "Application.h"
#include "Theme.h"

namespace petrous::workstation
{

QString sideText(scene::Side side)
{
  switch (side)
  {
  case scene::Side::Left:
    return DescriptionDialog::tr("left");
  case scene::Side::Right:
    return DescriptionDialog::tr("right");
  case scene::Side::Both:
    return DescriptionDialog::tr("both");
  case scene::Side::Unknown:
    break;
  }
  return {};
}

DescriptionDialog::DescriptionDialog(const QString& name, const scene::Description& description,
                                     QWidget* parent)
  : QDialog(parent)
  , m_diagnosis(new QLineEdit(words(description.diagnosis)))
  , m_procedure(new QLineEdit(words(description.procedure)))
  , m_side(new QComboBox)
  , m_date(new QLineEdit(words(description.date)))
  , m_tags(new QLineEdit)
  , m_note(new QPlainTextEdit(words(description.note)))
  , m_advice(new QLabel)
{
  setObjectName("describeCase");
  setWindowTitle(tr("Describe “%1”").arg(name));
  m_diagnosis->setObjectName("diagnosis");
  m_procedure->setObjectName("procedure");
  m_side->setObjectName("side");
  using scene::Side;
  for (const Side side : {Side::Unknown, Side::Left, Side::Right, Side::Both})
    m_side->addItem(side == Side::Unknown ? tr("not stated") : sideText(side),
                    static_cast<int>(side));
  m_side->setCurrentIndex(m_side->findData(static_cast<int>(description.side)));
  m_date->setObjectName("plannedDate");
  m_date->setPlaceholderText(tr("2026-03-31"));
  m_date->setToolTip(tr("Of the planned operation, year-month-day. It stays here when the case is "
                        "archived or sent"));
  QStringList tags;
  for (const std::string& tag : description.tags)
    tags += words(tag);
  m_tags->setObjectName("tags");
  m_tags->setText(tags.join(", "));
  m_tags->setPlaceholderText(tr("separated by commas"));
  m_note->setObjectName("note");
  m_note->setTabChangesFocus(true);
  m_advice->setTextFormat(Qt::PlainText);
  m_advice->setWordWrap(true);

  auto* form = new QFormLayout;
  form->addRow(tr("&Diagnosis:"), m_diagnosis);
  form->addRow(tr("&Procedure:"), m_procedure);
  form->addRow(tr("&Side:"), m_side);
  form->addRow(tr("Planned &on:"), m_date);
  form->addRow(tr("&Tags:"), m_tags);
  form->addRow(tr("&Note:"), m_note);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_accept = buttons->addButton(tr("&Keep"), QDialogButtonBox::AcceptRole);
  m_accept->setObjectName("primary");
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  for (QLineEdit* line : {m_diagnosis, m_procedure, m_date, m_tags})
    connect(line, &QLineEdit::textChanged, this, &DescriptionDialog::check);
  connect(m_note, &QPlainTextEdit::textChanged, this, &DescriptionDialog::check);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form, 1);
  layout->addWidget(m_advice);
  layout->addWidget(buttons);
  resize(520, 440);
  check();
}

scene::Description DescriptionDialog::description() const
{
  scene::Description result;
  result.diagnosis = bytes(m_diagnosis->text().trimmed());
  result.procedure = bytes(m_procedure->text().trimmed());
  result.side = static_cast<scene::Side>(m_side->currentData().toInt());
  result.date = bytes(m_date->text().trimmed());
  for (const QString& tag : m_tags->text().split(',', Qt::SkipEmptyParts))
    if (!tag.trimmed().isEmpty())
      result.tags.push_back(bytes(tag.trimmed()));
  result.note = bytes(m_note->toPlainText());
  return result;
}

void DescriptionDialog::check()
{
  QString why;
  try
  {
    scene::checkDescription(description());
  }
  catch (const std::exception& error)
  {
    why = toString(error);
  }
  m_advice->setText(why.isEmpty() ? tr("Do not name the patient here: tags, diagnosis, procedure "
                                       "and note go along when the case is handed on.")
                                  : why);
  m_accept->setEnabled(why.isEmpty());
}

} // namespace petrous::workstation
