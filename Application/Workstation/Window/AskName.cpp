#include "AskName.h"

#include <QDialogButtonBox>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>

#include "Application.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
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
  wrapWords(*label);
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
      why = sentence(capitalized(toString(error)));
    }
    label->setText(why.isEmpty() ? text : text + "\n\n" + why);
    ok->setEnabled(!wanted.empty() && why.isEmpty());
  };
  QObject::connect(&dialog, &QInputDialog::textValueChanged, judge);
  judge(name);
  return dialog.exec() == QDialog::Accepted ? dialog.textValue().trimmed() : QString();
}

bool mayReplace(QWidget& parent, const std::vector<std::filesystem::path>& files)
{
  QStringList there;
  for (const std::filesystem::path& file : files)
    if (const QFileInfo info(QFile::decodeName(file.c_str())); info.exists())
      there += info.fileName();
  if (there.isEmpty())
    return true;
  QMessageBox box(QMessageBox::Question, parent.windowTitle(),
                  there.size() == 1
                      ? QObject::tr("“%1” is there already. Replace it?").arg(there.front())
                      : QObject::tr("%1 are there already. Replace them?").arg(there.join(", ")),
                  QMessageBox::Cancel, &parent);
  box.setObjectName("askReplace");
  const auto* replace = box.addButton(QObject::tr("&Replace"), QMessageBox::AcceptRole);
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == replace;
}

QString chosenFile(QFileDialog& dialog)
{
  return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().value(0) : QString();
}

std::filesystem::path askFile(QFileDialog& dialog)
{
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setOption(QFileDialog::DontConfirmOverwrite);
  std::filesystem::path file;
  QWidget* parent = dialog.parentWidget();
  do
    file = pathOf(chosenFile(dialog));
  while (!file.empty() && !mayReplace(parent ? *parent : dialog, {file}));
  return file;
}

} // namespace petrous::workstation
