#include "SettingsDialog.h"

#include <algorithm>
#include <array>

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFile>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "Application.h"
#include "Language.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowSettings.h"
#include "WindowTexts.h"
#include "petrous/Library/DefaultFolder.h"
#include "petrous/Library/Library.h"

namespace petrous::workstation
{

SettingsDialog::SettingsDialog(WindowSettings& settings, const std::filesystem::path& library,
                               const std::vector<QAction*>& switches, QWidget* parent)
  : QDialog(parent)
  , m_settings(settings)
  , m_library(library)
  , m_place(new QLabel)
{
  setObjectName("settings");
  setWindowTitle(tr("Settings"));
  auto* form = new QFormLayout;
  QComboBox* scheme =
      choiceBox("colorScheme", tr("3D view and slices stay dark: bone is the brightest there"));
  scheme->addItems({tr("Dark"), tr("Light")});
  form->addRow(tr("&Theme:"),
               m_bound.add(
                   scheme, [this] { return static_cast<int>(m_settings.theme().scheme); },
                   [this](int row)
                   {
                     Theme theme = m_settings.theme();
                     theme.scheme = static_cast<ColorScheme>(row);
                     m_settings.keepTheme(theme);
                     apply();
                   }));
  auto* size = new QSpinBox;
  size->setObjectName("fontScale");
  size->setRange(percent(Theme::kMinScale), percent(Theme::kMaxScale));
  size->setSingleStep(10);
  size->setSuffix(tr(" %"));
  size->setKeyboardTracking(false);
  size->setToolTip(tr("Of the letters of menus, panels and dialogs"));
  form->addRow(tr("&Letters:"), m_bound.add(
                                    size, [this] { return percent(m_settings.theme().fontScale); },
                                    [this](int value)
                                    {
                                      Theme theme = m_settings.theme();
                                      theme.fontScale = 0.01 * value;
                                      m_settings.keepTheme(theme);
                                      apply();
                                    }));
  if (hasLanguage("de"))
  {
    QComboBox* language = choiceBox("language", tr("System: German where the computer's language "
                                                   "is German, otherwise English"));
    const std::array<QString, 3> codes{"", "en", "de"};
    language->addItems({tr("System"), "English", "Deutsch"});
    form->addRow(tr("La&nguage from the next start on:"),
                 m_bound.add(
                     language,
                     [this, codes]
                     {
                       const auto at = std::find(codes.begin(), codes.end(), m_settings.language());
                       return at == codes.end() ? 0 : static_cast<int>(at - codes.begin());
                     },
                     [this, codes](int row)
                     { m_settings.keepLanguage(codes.at(static_cast<std::size_t>(row))); }));
  }
  for (QAction* action : switches)
  {
    auto* box = new QCheckBox(action->text());
    box->setToolTip(action->statusTip());
    m_bound.add(
        box, [action] { return action->isChecked(); },
        [action](bool on)
        {
          if (action->isChecked() != on)
            action->trigger();
        });
    form->addRow(box);
  }
  addLibrary(*form);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  QPushButton* usual = buttons->addButton(tr("&Restore defaults"), QDialogButtonBox::ResetRole);
  usual->setAutoDefault(false);
  buttons->button(QDialogButtonBox::Close)->setDefault(true);
  usual->setObjectName("usualTheme");
  usual->setToolTip(tr("Theme, letters and language as they were before any choice"));
  connect(usual, &QPushButton::clicked, this,
          [this]
          {
            m_settings.keepTheme({});
            m_settings.keepLanguage({});
            apply();
            m_bound.refresh();
          });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(buttons);
  m_bound.refresh();
}

// The folder in use, and the one of the next start if that is another.
void SettingsDialog::addLibrary(QFormLayout& form)
{
  m_place->setObjectName("libraryFolder");
  m_place->setTextFormat(Qt::PlainText);
  wrapWords(*m_place);
  m_place->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  auto* change = new QPushButton(tr("Another fold&er…"));
  change->setObjectName("changeLibrary");
  change->setToolTip(tr("From the next start on, for the command too; --library and "
                        "PETROUS_LIBRARY go first. Nothing is moved."));
  connect(change, &QPushButton::clicked, this, &SettingsDialog::changeLibrary);
  auto* row = new QVBoxLayout; // a path has no blanks at which it could be wrapped
  row->addWidget(m_place);
  row->addWidget(change, 0, Qt::AlignLeft);
  form.addRow(tr("Library:"), row);
  showLibrary();
}

void SettingsDialog::showLibrary()
{
  const auto name = [](const std::filesystem::path& folder)
  { return QFile::decodeName(folder.c_str()); };
  QString text = name(m_library);
  try
  {
    const std::filesystem::path next = library::defaultFolder();
    const bool isGiven = !qEnvironmentVariableIsEmpty("PETROUS_LIBRARY");
    std::error_code error;
    if (isGiven)
      text += '\n' + tr("named by PETROUS_LIBRARY, which goes first");
    else if (std::filesystem::exists(library::defaultFolderFile(), error) &&
             !std::filesystem::equivalent(next, m_library, error))
      text += '\n' + tr("from the next start on: %1").arg(name(next));
  }
  catch (const std::exception& fault)
  {
    text += '\n' + toString(fault);
  }
  m_place->setText(text);
}

void SettingsDialog::changeLibrary()
{
  const QString chosen = QFileDialog::getExistingDirectory(
      this, tr("Folder of the library"), QFile::decodeName(m_library.parent_path().c_str()));
  if (chosen.isEmpty())
    return;
  const std::filesystem::path folder = pathOf(chosen);
  try
  {
    std::error_code error;
    const bool isLibrary = std::filesystem::is_directory(folder / "cases", error);
    const bool isEmpty = std::filesystem::is_empty(folder, error);
    const std::size_t count = isLibrary ? library::Library(folder).list().size() : 0;
    QMessageBox box(QMessageBox::Question, tr("Library"),
                    tr("Use the library in %1 from the next start on?").arg(chosen),
                    QMessageBox::NoButton, this);
    box.setObjectName("askLibrary");
    box.setInformativeText(
        (isLibrary ? (count == 1 ? tr("It has 1 case.") : tr("It has %1 cases.").arg(count))
         : isEmpty ? tr("It is empty: a new library begins there.")
                   : tr("It has other files and no cases: a new library begins among them.")) +
        ' ' +
        tr("Nothing is moved or copied: the cases in %1 stay there. Archive and Restore take a "
           "case "
           "along.")
            .arg(QFile::decodeName(m_library.c_str())));
    const QAbstractButton* yes = box.addButton(tr("&Use it"), QMessageBox::AcceptRole);
    box.setDefaultButton(box.addButton(QMessageBox::Cancel));
    box.exec();
    if (box.clickedButton() != yes)
      return;
    library::chooseDefaultFolder(folder);
  }
  catch (const std::exception& fault)
  {
    QMessageBox::warning(this, tr("Library"), toString(fault));
  }
  showLibrary();
  adjustSize();
}

void SettingsDialog::apply()
{
  applyTheme(*qApp, m_settings.theme());
  adjustSize();
}

} // namespace petrous::workstation
