#include <set>

#include <QAbstractButton>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLibraryInfo>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTranslator>

#include "Application.h"
#include "Commands.h"
#include "GuiTest.h"
#include "Language.h"
#include "Theme.h"
#include "WindowSettings.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"
#include "petrous/Presenters/Phrasebook.h"

using namespace petrous;
using namespace petrous::workstation;

class LanguageTest : public GuiTest
{
protected:
  /// Alt and the letter open one menu of the bar, and the letter takes one entry of each menu.
  void expectOwnKeys()
  {
    for (const QAction* action : window().menuBar()->actions())
      EXPECT_TRUE(action->text().contains('&')) << action->text().toStdString();
    QWidgetList scopes{window().menuBar()};
    for (QMenu* menu : window().findChildren<QMenu*>())
      scopes += menu;
    EXPECT_GT(scopes.size(), 20);
    for (const QWidget* scope : scopes)
    {
      const QStringList shared = sharedMnemonics(*scope);
      EXPECT_TRUE(shared.isEmpty())
          << scope->windowTitle().toStdString() << ' ' << scope->objectName().toStdString() << '\n'
          << shared.join('\n').toStdString();
    }
  }
};

namespace
{

// What stands in widgets and actions.
QStringList shownTexts()
{
  QStringList texts;
  for (const QWidget* widget : QApplication::allWidgets())
  {
    texts << widget->toolTip() << widget->windowTitle();
    if (const auto* label = qobject_cast<const QLabel*>(widget))
      texts << label->text();
    if (const auto* button = qobject_cast<const QAbstractButton*>(widget))
      texts << button->text();
    if (const auto* box = qobject_cast<const QComboBox*>(widget))
      for (int n = 0; n < box->count(); ++n)
        texts << box->itemText(n) << box->itemData(n, Qt::ToolTipRole).toString();
    for (const QAction* one : widget->actions())
      texts << one->text() << one->toolTip() << one->statusTip();
  }
  return texts;
}

} // namespace

TEST_F(LanguageTest, TheMenusAreGermanAndNumbersHaveACommaThere)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  const GermanTexts german;
  ASSERT_TRUE(german.isThere());
  openWindow();
  expectOwnKeys();
  std::set<QString> titles;
  for (const QAction* action : window().menuBar()->actions())
    titles.insert(action->text().remove('&'));
  for (const char* title : {"Datei", "Bearbeiten", "Fall", "Zugang", "Ansicht", "Registrierung",
                            "Segmentierung", "Messen", "Bohren", "Bibliothek", "Hilfe"})
    EXPECT_TRUE(titles.count(title)) << title;
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  ASSERT_TRUE(thrust);
  thrust->setValue(1.5);
  EXPECT_TRUE(thrust->text().startsWith("1,5")) << thrust->text().toStdString();
}

TEST_F(LanguageTest, NoTwoEntriesOfAMenuHaveOneKeyInEnglish)
{
  openWindow();
  expectOwnKeys();
  QMenu menu;
  menu.addAction("&Open");
  menu.addAction("Save && &close");
  EXPECT_EQ(sharedMnemonics(menu), QStringList());
  menu.addAction("Pr&ocess");
  EXPECT_EQ(sharedMnemonics(menu), QStringList{"Alt+O: &Open | Pr&ocess"});
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

TEST_F(LanguageTest, WhatPresentersSayIsShownInGerman)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  saveBall("ball");
  const GermanTexts german;
  ASSERT_TRUE(german.isThere());
  EXPECT_EQ(shownLanguage(), "de");
  openWindow("ball");
  ASSERT_TRUE(waitFor([this] { return settled(); }));
  const std::set<QString> names{"nerve", "ball", "main", "other"}; // of the case, and a preset
  const presenters::Phrasebook& phrases = presenters::germanPhrases();
  const QRegularExpression withVolume(QString::fromUtf8(" \\([0-9.,]+ mm³\\)$"));
  int count = 0;
  for (const QString& text : shownTexts())
  {
    const std::string plain = bytes(QString(text).remove('&'));
    const QString name = words(plain).remove(withVolume);
    if (plain.empty() || names.count(name))
      continue;
    ++count;
    const auto other = phrases.find(plain);
    EXPECT_TRUE(!other || *other == plain) << plain;
  }
  EXPECT_GT(count, 300);
  EXPECT_EQ(toString(core::InvalidParameter("case 'ear' has no MR 'T2'; it has none")),
            "der Fall „ear“ hat kein MR „T2“; er hat keines");
  EXPECT_EQ(phrase("ear.nii: is damaged: a face has fewer than three corners; export it again from "
                   "where it came"),
            "ear.nii: ist beschädigt: eine Fläche hat weniger als drei Ecken; exportieren Sie sie "
            "noch einmal vom Ursprung");
}

TEST_F(LanguageTest, SettingsAreFoundByTheirGermanNames)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  const GermanTexts german;
  ASSERT_TRUE(german.isThere());
  openWindow();
  const auto settings = settingsOf(window(), false);
  const auto found = presenters::findCommands(entriesOf(settings), bytes(QString("belichtung")));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(settings[found.front()].name, "Belichtung");
  EXPECT_EQ(settings[found.front()].control, window().findChild<QDoubleSpinBox*>("exposure"));
}

TEST_F(LanguageTest, WithoutGermanPhrasesStayEnglish)
{
  EXPECT_EQ(shownLanguage(), "en");
  EXPECT_EQ(phrase("case 'ear' has no structures"), "case 'ear' has no structures");
}

TEST_F(LanguageTest, NumbersHaveTheLanguagesDecimalSign)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  const std::string sentence = "the error is 0.32 mm, of file scan 1.5.nii and UID 1.2.840";
  EXPECT_EQ(numberText(-0.25, 2), "-0.25");
  EXPECT_EQ(numberText(12345.6, 1), QString::fromUtf8("12\u202f345.6")) << "no comma";
  EXPECT_EQ(numberText("0.5, 12.0"), "0.5, 12.0");
  EXPECT_TRUE(phrase(sentence).contains("0.32 mm"));
  const GermanTexts german;
  ASSERT_TRUE(german.isThere());
  EXPECT_EQ(numberText(-0.25, 2), "-0,25");
  EXPECT_EQ(numberText(-0.001, 2), "0,00");
  EXPECT_EQ(numberText(12345.6, 1), QString::fromUtf8("12\u202f345,6"));
  EXPECT_EQ(numberText("60000 /min"), QString::fromUtf8("60\u202f000 /min"));
  EXPECT_EQ(numberText("0.5, 12.0"), "0,5; 12,0");
  const QString shown = phrase(sentence);
  EXPECT_TRUE(shown.contains("0,32 mm")) << shown.toStdString();
  EXPECT_TRUE(shown.contains("1.5.nii")) << shown.toStdString();
  EXPECT_TRUE(shown.contains("1.2.840")) << shown.toStdString();
  EXPECT_EQ(QString::number(0.5), "0.5") << "files have a point";
}

TEST_F(LanguageTest, AGermanFieldTakesCommaAndPoint)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  const GermanTexts german;
  ASSERT_TRUE(german.isThere());
  openWindow();
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  ASSERT_TRUE(thrust);
  for (const char* typed : {"2,5", "2.5"})
  {
    thrust->setValue(1.0);
    enterNumber(*thrust, typed);
    EXPECT_EQ(thrust->value(), 2.5) << typed;
    EXPECT_TRUE(thrust->text().startsWith("2,5")) << thrust->text().toStdString();
  }
  QSpinBox whole;
  whole.setRange(0, 5000);
  whole.setValue(300);
  for (const char* typed : {"1.200", "1,200"}) // marks between thousands are nobody's
  {
    enterNumber(whole, typed);
    EXPECT_EQ(whole.value(), 300) << typed;
  }
}

TEST_F(LanguageTest, ButtonsOfQtsDialogsAreGerman)
{
  QTranslator qt;
  if (!qt.load("qtbase_de", QLibraryInfo::location(QLibraryInfo::TranslationsPath)))
    GTEST_SKIP() << "Qt's German texts (qttranslations5-l10n) are not installed";
  QApplication::installTranslator(&qt);
  const QDialogButtonBox box(QDialogButtonBox::Cancel | QDialogButtonBox::Save);
  EXPECT_EQ(box.button(QDialogButtonBox::Cancel)->text().remove('&'), "Abbrechen");
  EXPECT_EQ(box.button(QDialogButtonBox::Save)->text().remove('&'), "Speichern");
  QApplication::removeTranslator(&qt);
}
