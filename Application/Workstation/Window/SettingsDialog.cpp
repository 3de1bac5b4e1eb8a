#include "SettingsDialog.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFile>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "Theme.h"
#include "WindowSettings.h"

namespace petrous::workstation
{

SettingsDialog::SettingsDialog(WindowSettings& settings, const std::filesystem::path& library,
                               const std::vector<QAction*>& switches, QWidget* parent)
  : QDialog(parent)
  , m_settings(settings)
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
  auto* place = new QLabel(QFile::decodeName(library.c_str()));
  place->setObjectName("libraryFolder");
  place->setTextFormat(Qt::PlainText);
  place->setWordWrap(true);
  place->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  place->setToolTip(tr("Another one is chosen when Petrous is started: --library, or "
                       "PETROUS_LIBRARY, as for the command"));
  form->addRow(tr("Library:"), place);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  QPushButton* usual = buttons->addButton(tr("&Restore defaults"), QDialogButtonBox::ResetRole);
  usual->setAutoDefault(false);
  buttons->button(QDialogButtonBox::Close)->setDefault(true);
  usual->setObjectName("usualTheme");
  usual->setToolTip(tr("Theme and letters as they were before any choice"));
  connect(usual, &QPushButton::clicked, this,
          [this]
          {
            m_settings.keepTheme({});
            apply();
            m_bound.refresh();
          });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(buttons);
  m_bound.refresh();
}

void SettingsDialog::apply()
{
  applyTheme(*qApp, m_settings.theme());
  adjustSize();
}

} // namespace petrous::workstation
