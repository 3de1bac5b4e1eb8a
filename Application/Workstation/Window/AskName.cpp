#include "AskName.h"

#include <QDialogButtonBox>
#include <QInputDialog>
#include <QLabel>
#include <QPushButton>

#include "Application.h"
#include "Theme.h"
#include "petrous/Core/Error.h"

namespace petrous::workstation
{

QString askName(QWidget& parent, const QString& title, const QString& text, const QString& name,
                const std::function<void(const std::string&)>& check)
{
  QInputDialog dialog(&parent);
  dialog.setWindowTitle(title);
  dialog.setLabelText(text);
  dialog.setTextValue(name);
  dialog.sizeHint(); // makes its widgets
  auto* label = dialog.findChild<QLabel*>();
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setMinimumWidth(340);
  QPushButton* ok = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
  const auto judge = [&](const QString& typed)
  {
    const std::string wanted = bytes(typed.trimmed());
    QString why;
    try
    {
      if (!wanted.empty())
        check(wanted);
    }
    catch (const core::Error& error)
    {
      why = toString(error);
    }
    label->setText(why.isEmpty() ? text : text + "\n\n" + why);
    ok->setEnabled(!wanted.empty() && why.isEmpty());
  };
  QObject::connect(&dialog, &QInputDialog::textValueChanged, judge);
  judge(name);
  return dialog.exec() == QDialog::Accepted ? dialog.textValue().trimmed() : QString();
}

} // namespace petrous::workstation
