#include <set>

#include <QDoubleSpinBox>
#include <QMenuBar>
#include <QTranslator>

#include "GuiTest.h"
#include "Language.h"
#include "WindowSettings.h"

using namespace petrous;
using namespace petrous::workstation;

class LanguageTest : public GuiTest
{
};

TEST_F(LanguageTest, TheMenusAreGermanAndNumbersKeepTheirPoint)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  QTranslator german;
  ASSERT_TRUE(german.load(":/translations/petrous_de.qm"));
  QApplication::installTranslator(&german);
  openWindow();
  QApplication::removeTranslator(&german);
  std::set<QString> titles, keys;
  for (const QAction* action : window().menuBar()->actions())
  {
    const QString text = action->text();
    titles.insert(QString(text).remove('&'));
    const QString key = text.mid(text.indexOf('&') + 1, 1).toLower();
    EXPECT_TRUE(keys.insert(key).second) << "Alt+" << key.toStdString() << " twice";
  }
  for (const char* title : {"Datei", "Bearbeiten", "Fall", "Zugang", "Ansicht", "Registrierung",
                            "Segmentierung", "Messen", "Bohren", "Bibliothek", "Hilfe"})
    EXPECT_TRUE(titles.count(title)) << title;
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  ASSERT_TRUE(thrust);
  thrust->setValue(1.5);
  EXPECT_TRUE(thrust->text().startsWith("1.5")) << thrust->text().toStdString();
}

TEST_F(LanguageTest, TheChoiceGoesFirstThenTheUsersLanguageThenEnglish)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  EXPECT_EQ(languageOf("", {"de-DE", "en-US"}), "de");
  EXPECT_EQ(languageOf("", {"de_AT"}), "de");
  EXPECT_EQ(languageOf("", {"en-US", "de-DE"}), "en");
  EXPECT_EQ(languageOf("", {"fr-FR", "de-DE"}), "en");
  EXPECT_EQ(languageOf("", {}), "en");
  EXPECT_EQ(languageOf("en", {"de-DE"}), "en");
  EXPECT_EQ(languageOf("de", {"en-US"}), "de");
  EXPECT_EQ(languageOf("../x", {"en-US"}), "en");
}

TEST_F(LanguageTest, TheChoiceIsKept)
{
  const QString file = QString::fromStdString((folder() / "language.ini").string());
  EXPECT_EQ(WindowSettings(file).language(), "");
  WindowSettings(file).keepLanguage("de");
  EXPECT_EQ(WindowSettings(file).language(), "de");
  WindowSettings(file).keepLanguage("");
  EXPECT_EQ(WindowSettings(file).language(), "");
}
