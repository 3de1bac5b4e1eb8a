#include "DescriptionDialog.h"

#include <set>

#include <QComboBox>
#include <QDate>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "Application.h"
#include "HintedLine.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"

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
  , m_date(new HintedLine(words(description.date)))
  , m_tags(new QLineEdit)
  , m_note(new QPlainTextEdit(words(description.note)))
  , m_problem(new QLabel)
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
  m_date->setPlaceholderText(tr("a day, such as 2026-12-31 or 31.12.2026"));
  m_date->setToolTip(tr("Of the planned operation, year-month-day or day.month.year. It stays here "
                        "when the case is archived or sent"));
  m_tags->setObjectName("tags");
  m_tags->setText(listed(description.tags));
  m_tags->setPlaceholderText(tr("separated by commas"));
  m_note->setObjectName("note");
  m_note->setTabChangesFocus(true);
  auto* advice = new QLabel(tr("Do not name the patient here: tags, diagnosis, procedure and note "
                               "go along when the case is handed on."));
  m_problem->setObjectName("problem");
  for (QLabel* label : {advice, m_problem})
  {
    label->setTextFormat(Qt::PlainText);
    wrapWords(*label);
  }

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
  layout->addWidget(advice);
  layout->addWidget(m_problem);
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
  const QDate day = QDate::fromString(m_date->text().trimmed(), "d.M.yyyy");
  result.date = bytes(day.isValid() ? day.toString("yyyy-MM-dd") : m_date->text().trimmed());
  std::set<std::string> there; // twice is once
  for (const QString& tag : m_tags->text().split(',', Qt::SkipEmptyParts))
    if (const std::string one = bytes(tag.trimmed());
        !one.empty() && there.insert(scene::lowerCase(one)).second)
      result.tags.push_back(one);
  result.note = bytes(m_note->toPlainText());
  return result;
}

// All that is wrong at once.
void DescriptionDialog::check()
{
  const scene::Description whole = description();
  QStringList problems;
  const auto judge = [&](auto scene::Description::*field)
  {
    scene::Description alone;
    alone.*field = whole.*field;
    try
    {
      scene::checkDescription(alone);
    }
    catch (const std::exception& error)
    {
      problems += toString(error);
    }
  };
  judge(&scene::Description::diagnosis);
  judge(&scene::Description::procedure);
  judge(&scene::Description::tags);
  judge(&scene::Description::note);
  if (!whole.date.empty() && !scene::isDate(whole.date))
    problems +=
        tr("“%1” is not a day; give it as 2026-12-31 or 31.12.2026").arg(m_date->text().trimmed());
  m_problem->setText(problems.join('\n'));
  m_problem->setVisible(!problems.isEmpty());
  m_accept->setEnabled(problems.isEmpty());
}

} // namespace petrous::workstation
