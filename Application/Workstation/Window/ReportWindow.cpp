#include "ReportWindow.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFontDatabase>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "Application.h"
#include "AskName.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/FolderIdentity.h"

namespace petrous::workstation
{

void showReport(QWidget* parent, const QString& title, const QString& head, const QString& text,
                const QString& file, const std::filesystem::path& library, const QString& input)
{
  auto* dialog = new QDialog(parent);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName("report");
  dialog->setWindowTitle(title);
  dialog->resize(760, 480);
  auto* first = new QLabel(head);
  first->setObjectName("reportHead");
  first->setTextFormat(Qt::PlainText);
  wrapWords(*first);
  first->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* whole = new QPlainTextEdit(text);
  whole->setObjectName("reportText");
  whole->setAccessibleName(title);
  whole->setReadOnly(true);
  whole->setWordWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
  whole->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  auto* outcome = new QLabel;
  outcome->setObjectName("dim");
  outcome->setTextFormat(Qt::PlainText);
  wrapWords(*outcome);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  auto* save = buttons->addButton(QObject::tr("&Save…"), QDialogButtonBox::ActionRole);
  save->setObjectName("saveReport");
  save->setAutoDefault(false);
  QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  QObject::connect(save, &QPushButton::clicked, dialog,
                   [dialog, whole, outcome, title, file, library, input]
                   {
                     QFileDialog ask(dialog, title, QDir::homePath(), QObject::tr("Text (*.txt)"));
                     ask.setDefaultSuffix("txt");
                     ask.selectFile(file);
                     const std::filesystem::path path = askFile(ask);
                     if (path.empty())
                       return;
                     try
                     {
                       const std::filesystem::path from = pathOf(input);
                       if (!input.isEmpty())
                         presenters::refuseWithin(path, from, "report");
                       library::refuseOverwriting(path, library);
                       core::writeFile(path, bytes(whole->toPlainText()));
                       outcome->setText(
                           QObject::tr("Saved as %1").arg(QFile::decodeName(path.c_str())));
                     }
                     catch (const std::exception& error)
                     {
                       outcome->setText(toString(error));
                     }
                   });
  if (text.isEmpty())
  {
    whole->hide();
    save->hide();
  }
  auto* layout = new QVBoxLayout(dialog);
  layout->addWidget(first);
  layout->addWidget(whole, 1);
  layout->addWidget(outcome);
  layout->addWidget(buttons);
  constexpr int kWidthOfHead = 460; // px
  if (text.isEmpty())
    dialog->resize(kWidthOfHead, layout->totalHeightForWidth(kWidthOfHead));
  dialog->show();
}

} // namespace petrous::workstation
