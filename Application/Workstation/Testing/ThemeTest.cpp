#include "GuiTest.h"

#include <cmath>
#include <fstream>

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTreeView>

#include "SettingsDialog.h"
#include "Theme.h"
#include "WindowSettings.h"
#include "petrous/Library/DefaultFolder.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class ThemeTest : public GuiTest
{
protected:
  ~ThemeTest() override { applyTheme(*qApp); }
  SettingsDialog& settings()
  {
    QApplication::setActiveWindow(&window());
    QTest::keyClick(&window(), Qt::Key_Comma, Qt::ControlModifier);
    return *window().findChild<SettingsDialog*>();
  }
};

// WCAG 2.1, 1.4.3.
double luminance(const QColor& color)
{
  const auto linear = [](double c)
  { return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

double contrast(const QColor& a, const QColor& b)
{
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

} // namespace

TEST_F(ThemeTest, TextCanBeReadInBoth)
{
  EXPECT_NEAR(contrast(Qt::white, Qt::black), 21.0, 1e-9);
  for (const ColorScheme scheme : {ColorScheme::Dark, ColorScheme::Light})
  {
    SCOPED_TRACE(static_cast<int>(scheme));
    applyTheme(*qApp, {scheme, 1.0});
    const QPalette palette = QApplication::palette();
    using P = QPalette;
    for (const auto& [text, back] :
         {std::pair(P::WindowText, P::Window), std::pair(P::Text, P::Base),
          std::pair(P::Text, P::AlternateBase), std::pair(P::ButtonText, P::Button),
          std::pair(P::HighlightedText, P::Highlight), std::pair(P::ToolTipText, P::ToolTipBase),
          std::pair(P::Link, P::Window)})
      EXPECT_GE(contrast(palette.color(text), palette.color(back)), 4.5) << text << " on " << back;
    for (const QColor& color : {warningColor(), harmColor()})
      EXPECT_GE(contrast(color, palette.color(P::Window)), 4.5) << color.name().toStdString();
    EXPECT_FALSE(qApp->styleSheet().contains('@')) << "a colour without a value";
    EXPECT_FALSE(qApp->styleSheet().contains("#ff00ff"));
  }
}

TEST_F(ThemeTest, ALightOneIsSeenAtOnceAndInTheNextWindowAndPicturesStayDark)
{
  saveBall("ball");
  openWindow();
  const QImage before = picture();
  const auto light = [this]
  {
    const QImage list = structureList().viewport()->grab().toImage();
    return list.pixelColor(list.width() / 2, list.height() - 3).lightness() > 200 &&
           window().menuBar()->grab().toImage().pixelColor(600, 3).lightness() > 200;
  };
  EXPECT_FALSE(light());
  SettingsDialog& dialog = settings();
  auto* scheme = dialog.findChild<QComboBox*>("colorScheme");
  scheme->setCurrentIndex(1);
  EXPECT_TRUE(light());
  dialog.close();
  EXPECT_EQ(differentPixels(before, picture()), 0);
  closeWindow();
  applyTheme(*qApp);
  openWindow();
  EXPECT_TRUE(light());
  SettingsDialog& again = settings();
  EXPECT_EQ(again.findChild<QComboBox*>("colorScheme")->currentText(), "Light");
  auto* language = again.findChild<QComboBox*>("language"); // none without lrelease
  if (language)
    language->setCurrentIndex(2);
  again.findChild<QPushButton*>("usualTheme")->click();
  EXPECT_EQ(again.findChild<QComboBox*>("colorScheme")->currentText(), "Dark");
  if (language)
  {
    EXPECT_EQ(language->currentIndex(), 0) << "the system's";
  }
  EXPECT_FALSE(light());
  again.close();
}

TEST_F(ThemeTest, LettersAreScaledAndScaledBack)
{
  openWindow();
  const double usual = QApplication::font().pointSizeF();
  const int line = window().menuBar()->fontMetrics().height();
  SettingsDialog& dialog = settings();
  auto* scale = dialog.findChild<QSpinBox*>("fontScale");
  EXPECT_EQ(scale->value(), 100);
  scale->setValue(150);
  EXPECT_NEAR(QApplication::font().pointSizeF(), 1.5 * usual, 0.01 * usual);
  EXPECT_NEAR(window().menuBar()->fontMetrics().height(), 1.5 * line, 0.2 * line); // whole pixels
  scale->setValue(100);
  EXPECT_NEAR(QApplication::font().pointSizeF(), usual, 0.01 * usual);
  EXPECT_EQ(window().menuBar()->fontMetrics().height(), line);
  dialog.close();
}

TEST_F(ThemeTest, SwitchesOfTheMenusAreInTheDialogToo)
{
  openWindow();
  QAction* follow = action("Slices follow the burr");
  ASSERT_TRUE(follow->isChecked());
  SettingsDialog& dialog = settings();
  QCheckBox* box = nullptr;
  for (auto* one : dialog.findChildren<QCheckBox*>())
    if (one->text().remove('&') == "Slices follow the burr")
      box = one;
  ASSERT_TRUE(box);
  EXPECT_TRUE(box->isChecked());
  box->click();
  EXPECT_FALSE(follow->isChecked());
  EXPECT_EQ(dialog.findChild<QLabel*>("libraryFolder")->text().toStdString(),
            (folder() / "library").string());
  dialog.close();
}

TEST_F(ThemeTest, SettingsThatNobodyUnderstandsAreTheUsual)
{
  const auto file = folder() / "odd.ini";
  std::ofstream(file) << "[look]\ntheme=plaid\nfont_scale=big\n";
  EXPECT_TRUE(WindowSettings(QString::fromStdString(file.string())).theme() == Theme());
  std::ofstream(file) << "[look]\ntheme=light\nfont_scale=40\n";
  const Theme theme = WindowSettings(QString::fromStdString(file.string())).theme();
  EXPECT_EQ(theme.scheme, ColorScheme::Light);
  EXPECT_EQ(theme.fontScale, Theme::kMaxScale);
}

// From the next start on; what happens is said before, and nothing is moved.
TEST_F(ThemeTest, TheLibrarysFolderIsChosen)
{
  ASSERT_TRUE(qputenv("XDG_CONFIG_HOME", QByteArray((folder() / "settings").c_str())));
  std::filesystem::create_directory(folder() / "other");
  scene::Case value = ballCase("ball");
  library::Library(folder() / "other").save(value);
  openWindow();
  auto& dialog = settings();
  const QString other = QString::fromStdString((folder() / "other").string());
  QString said;
  const auto change = [&](const QString& answer)
  {
    said.clear();
    onDialog(
        [&](QDialog& asking)
        {
          if (auto* files = qobject_cast<QFileDialog*>(&asking))
          {
            files->setDirectory(other);
            files->findChild<QLineEdit*>("fileNameEdit")->setText(other);
            static_cast<QDialog*>(files)->accept();
            return false;
          }
          auto* box = qobject_cast<QMessageBox*>(&asking);
          if (!box)
            return false;
          said = box->text() + ' ' + box->informativeText();
          for (auto* button : box->buttons())
            if (button->text().remove('&') == answer)
              button->click();
          return true;
        });
    dialog.findChild<QPushButton*>("changeLibrary")->click();
  };
  const auto shown = [&dialog] { return dialog.findChild<QLabel*>("libraryFolder")->text(); };
  change("Cancel");
  EXPECT_TRUE(said.contains(other) && said.contains("1 case.") && said.contains("stay there"))
      << said.toStdString();
  EXPECT_FALSE(shown().contains(other));
  change("Use it");
  EXPECT_TRUE(shown().contains("next start") && shown().contains(other)) << shown().toStdString();
  EXPECT_EQ(library::defaultFolder(), folder() / "other");
  EXPECT_EQ(window().model().library().folder(), library().folder());
  qunsetenv("XDG_CONFIG_HOME");
}
