#include "GuiTest.h"

#include <algorithm>

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QPlainTextEdit>
#include <QRegularExpression>
#include <QSlider>
#include <QSpinBox>
#include <QStatusBar>
#include <QToolBar>
#include <QTreeWidget>

#include "CommandPalette.h"
#include "Commands.h"
#include "DrillBar.h"
#include "KeyList.h"
#include "Manual.h"
#include "ViewArea.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class CommandsWindow : public GuiTest
{
protected:
  /// Opens the palette by its key, and does something with it.
  void inPalette(const std::function<void(CommandPalette&)>& act)
  {
    QApplication::setActiveWindow(&window());
    QTest::keyClick(&window(), Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
    auto* palette = window().findChild<CommandPalette*>();
    ASSERT_TRUE(palette && palette->isVisible());
    act(*palette);
    if (auto* still = window().findChild<CommandPalette*>())
      still->close();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QTest::qWait(10);
  }
  static QTreeWidget& listOf(QDialog& dialog) { return *dialog.findChild<QTreeWidget*>(); }
  static QLineEdit& searchOf(QDialog& dialog) { return *dialog.findChild<QLineEdit*>(); }
  static QString tipOf(QDialog& dialog) { return dialog.findChild<QLabel*>("dim")->text(); }
};

// Of all menus, without those that open others.
void collect(const QMenu& menu, QStringList& names)
{
  for (const QAction* action : menu.actions())
    if (action->menu())
      collect(*action->menu(), names);
    else if (!action->isSeparator() && action->isVisible())
      names += action->text().remove('&');
}

} // namespace

TEST_F(CommandsWindow, ThePaletteHasAllThatTheMenusHave)
{
  saveBall("ball");
  openWindow();
  QStringList inMenus;
  for (const QAction* top : window().menuBar()->actions())
    collect(*top->menu(), inMenus);
  EXPECT_GT(inMenus.size(), 80);
  inPalette(
      [&](CommandPalette& palette)
      {
        QStringList listed;
        for (int n = 0; n < listOf(palette).topLevelItemCount(); ++n)
          listed += listOf(palette).topLevelItem(n)->text(0);
        for (const QString& name : inMenus)
          EXPECT_TRUE(listed.contains(name)) << name.toStdString();
      });
}

TEST_F(CommandsWindow, ACommandIsFoundByNameShowsItsKeyAndIsRun)
{
  saveBall("ball");
  openWindow();
  const auto* area = window().findChild<ViewArea*>();
  ASSERT_FALSE(area->arrangement().enlarged());
  inPalette(
      [&](CommandPalette& palette)
      {
        QTest::keyClicks(&searchOf(palette), "view ENLARGE");
        ASSERT_GE(listOf(palette).topLevelItemCount(), 1);
        const QTreeWidgetItem* first = listOf(palette).topLevelItem(0);
        EXPECT_EQ(first->text(0), "Enlarge the view");
        EXPECT_EQ(first->text(1), QString::fromUtf8("View › Layout"));
        EXPECT_EQ(first->text(2), "E");
        EXPECT_TRUE(tipOf(palette).contains("fills the window"));
        QTest::keyClick(&searchOf(palette), Qt::Key_Return);
        EXPECT_FALSE(palette.isVisible());
      });
  EXPECT_TRUE(waitFor([&] { return area->arrangement().enlarged().has_value(); }));
}

TEST_F(CommandsWindow, ArrowKeysChooseWhileTheSearchHasTheFocus)
{
  saveBall("ball");
  openWindow();
  inPalette(
      [&](CommandPalette& palette)
      {
        const QTreeWidget& list = listOf(palette);
        EXPECT_EQ(list.currentItem(), list.topLevelItem(0));
        QTest::keyClick(&searchOf(palette), Qt::Key_Down);
        EXPECT_EQ(list.currentItem(), list.topLevelItem(1));
        QTest::keyClicks(&searchOf(palette), "no such thing");
        EXPECT_EQ(list.topLevelItemCount(), 0);
        EXPECT_TRUE(tipOf(palette).contains("No command"));
        QTest::keyClick(&searchOf(palette), Qt::Key_Return);
        EXPECT_TRUE(palette.isVisible());
      });
}

TEST_F(CommandsWindow, WhatCannotBeDoneIsGreyAndSaysWhy)
{
  saveBall("ball");
  openWindow();
  const auto why = [this](const char* text)
  {
    QString told;
    inPalette(
        [&](CommandPalette& palette)
        {
          QTest::keyClicks(&searchOf(palette), text);
          ASSERT_GE(listOf(palette).topLevelItemCount(), 1);
          EXPECT_EQ(listOf(palette).topLevelItem(0)->foreground(0).color(),
                    palette.palette().color(QPalette::Disabled, QPalette::Text))
              << text;
          told = tipOf(palette);
          QTest::keyClick(&searchOf(palette), Qt::Key_Return);
          EXPECT_TRUE(palette.isVisible()) << "nothing was done";
        });
    return told;
  };
  EXPECT_TRUE(why("register the mr").contains("no MR"));
  EXPECT_TRUE(why("next approach").contains("one approach only"));
  EXPECT_TRUE(why("redo").contains("Nothing was undone"));
  action("Close the case")->trigger();
  ASSERT_TRUE(waitFor([this] { return !window().model().hasCase() && !window().busy(); }));
  EXPECT_TRUE(why("save as").contains("Open a case first"));
  EXPECT_TRUE(why("thicker slab").contains("Open a case first"));
}

TEST_F(CommandsWindow, ASettingIsFoundByItsNameAndGetsTheFocusInItsPanel)
{
  saveBall("ball");
  openWindow();
  auto* dock = window().findChild<QDockWidget*>("pictureDock");
  dock->hide();
  auto* exposure = dock->findChild<QDoubleSpinBox*>("exposure");
  ASSERT_TRUE(exposure);
  inPalette(
      [&](CommandPalette& palette)
      {
        QTest::keyClicks(&searchOf(palette), "exposure");
        ASSERT_GE(listOf(palette).topLevelItemCount(), 1);
        const QTreeWidgetItem* first = listOf(palette).topLevelItem(0);
        EXPECT_EQ(first->text(0), "Exposure");
        EXPECT_EQ(first->text(1), "Picture");
        EXPECT_EQ(tipOf(palette), exposure->toolTip());
        QTest::keyClick(&searchOf(palette), Qt::Key_Return);
        EXPECT_FALSE(palette.isVisible());
      });
  EXPECT_TRUE(waitFor([&] { return window().focusWidget() == exposure; }));
  EXPECT_TRUE(waitFor([&] { return !exposure->visibleRegion().isEmpty(); }));
  EXPECT_EQ(exposure->value(), 0.0) << "it is shown, not changed";
}

TEST_F(CommandsWindow, ASettingOfAHiddenToolBarShowsIt)
{
  saveBall("ball");
  openWindow();
  auto* bar = window().findChild<QToolBar*>("drillBar");
  auto* speed = bar->findChild<QSpinBox*>("spindleSpeed");
  bar->hide();
  showSetting(*speed);
  EXPECT_TRUE(bar->isVisible());
  EXPECT_TRUE(waitFor([&] { return window().focusWidget() == speed; }));
}

TEST_F(CommandsWindow, ASettingThatIsNotAvailableSaysWhy)
{
  openWindow();
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  const auto setting = [&]
  {
    for (const Command& one : settingsOf(window(), true))
      if (one.control == thrust)
        return one;
    return Command{};
  };
  EXPECT_TRUE(setting().isEnabled && setting().whyNot.isEmpty());
  window().findChild<DrillBar*>()->setPresses(false, false);
  EXPECT_FALSE(setting().isEnabled);
  EXPECT_TRUE(setting().whyNot.contains("presses")) << setting().whyNot.toStdString();
  window().findChild<DrillBar*>()->setPresses(true, true);
  EXPECT_TRUE(setting().isEnabled && setting().whyNot.isEmpty());
}

TEST_F(CommandsWindow, EachSettingThatAPanelShowsIsFoundUnderAName)
{
  saveBall("ball");
  openWindow();
  int count = 0;
  for (auto* dock : window().findChildren<QDockWidget*>())
  {
    dock->show();
    dock->raise();
    QCoreApplication::processEvents();
    const auto settings = settingsOf(window(), true);
    for (const auto* widget : dock->findChildren<QWidget*>())
    {
      bool isInList = false;
      for (const auto* above = widget->parentWidget(); above; above = above->parentWidget())
        isInList = isInList || qobject_cast<const QAbstractItemView*>(above);
      const bool isSetting =
          qobject_cast<const QCheckBox*>(widget) || qobject_cast<const QSlider*>(widget) ||
          qobject_cast<const QAbstractSpinBox*>(widget) || qobject_cast<const QComboBox*>(widget);
      if (!isSetting || isInList || !widget->isVisible() || widget->window() != &window())
        continue;
      ++count;
      const auto found =
          std::find_if(settings.begin(), settings.end(),
                       [widget](const Command& one) { return one.control == widget; });
      ASSERT_NE(found, settings.end())
          << widget->objectName().toStdString() << " in " << dock->objectName().toStdString();
      EXPECT_FALSE(found->name.isEmpty() || found->name.contains('&'));
      EXPECT_EQ(found->menu, dock->windowTitle());
      EXPECT_EQ(found->isEnabled, widget->isEnabled());
    }
  }
  EXPECT_GT(count, 25);
}

TEST_F(CommandsWindow, SettingsOfACaseAreGreyWithoutOne)
{
  openWindow();
  int count = 0;
  for (const Command& one : settingsOf(window(), false))
    if (one.menu == "Slices")
    {
      ++count;
      EXPECT_FALSE(one.isEnabled) << one.name.toStdString();
      EXPECT_TRUE(one.whyNot.contains("Open a case first")) << one.whyNot.toStdString();
    }
  EXPECT_GT(count, 2);
}

TEST_F(CommandsWindow, TheManualIsOpenedWhereItIsInstalledOrBuilt)
{
  const QDir top(QString::fromStdString(folder().string()));
  for (const char* programs : {"usr/bin", "build/Application/Workstation"})
    top.mkpath(programs);
  QUrl opened;
  bool starts = true;
  const auto open = [&](const char* programs)
  {
    return openManual(top.filePath(programs),
                      [&](const QUrl& url)
                      {
                        opened = url;
                        return starts;
                      });
  };
  EXPECT_TRUE(open("usr/bin").contains("not installed"));
  EXPECT_TRUE(opened.isEmpty());
  const std::pair<const char*, const char*> places[] = {
      {"usr/bin", "usr/share/doc/petrous/manual"},
      {"build/Application/Workstation", "build/manual/html"}};
  for (const auto& [programs, place] : places)
  {
    ASSERT_TRUE(top.mkpath(place));
    QFile page(top.filePath(place) + "/index.html");
    ASSERT_TRUE(page.open(QIODevice::WriteOnly));
    EXPECT_EQ(open(programs), "");
    EXPECT_EQ(opened, QUrl::fromLocalFile(page.fileName()));
  }
  starts = false;
  EXPECT_TRUE(open("usr/bin").contains("usr/share/doc/petrous/manual/index.html")) << "no browser";
  QUrl page;
  openManual(
      top.filePath("usr/bin"),
      [&page](const QUrl& url)
      {
        page = url;
        return true;
      },
      "devices.html");
  EXPECT_TRUE(page.path().endsWith("usr/share/doc/petrous/manual/devices.html"));
}

TEST_F(CommandsWindow, ShiftF1SaysThatTheManualIsNotInstalled)
{
  openWindow();
  EXPECT_EQ(action("Manual")->shortcut(), QKeySequence(Qt::SHIFT + Qt::Key_F1));
  if (!manualFile(QCoreApplication::applicationDirPath()).isEmpty())
    GTEST_SKIP() << "the manual is built here: a browser would be started";
  QTest::keyClick(&window(), Qt::Key_F1, Qt::ShiftModifier);
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("not installed"));
}

TEST_F(CommandsWindow, TheListOfKeysHasTheKeysOfAllActions)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&window(), Qt::Key_F1);
  auto* keys = window().findChild<KeyList*>();
  ASSERT_TRUE(keys && keys->isVisible());
  EXPECT_FALSE(keys->isModal()) << "the window can be used beside it";
  QTreeWidget& list = listOf(*keys);
  const auto listed = [&](const QString& name)
  {
    QStringList found;
    for (QTreeWidgetItemIterator it(&list); *it; ++it)
      if ((*it)->parent() && (*it)->text(1) == name)
        found += (*it)->text(0).split(" or ");
    return found;
  };
  int count = 0;
  for (const auto* one : window().findChildren<QAction*>())
    if (!one->shortcut().isEmpty() && !one->text().isEmpty() && one->isVisible())
      for (const QKeySequence& key : one->shortcuts())
      {
        ++count;
        EXPECT_TRUE(
            listed(one->text().remove('&')).contains(key.toString(QKeySequence::NativeText)))
            << one->text().toStdString() << ", " << key.toString().toStdString();
      }
  EXPECT_GT(count, 70);
  EXPECT_EQ(listed("Keys"), QStringList{"F1"});
  for (const int column : {0, 1, 2}) // the names of menus span all of them
  {
    int widest = list.fontMetrics().horizontalAdvance(list.headerItem()->text(column));
    for (QTreeWidgetItemIterator it(&list); *it; ++it)
      if ((*it)->parent())
        widest = std::max(widest, list.fontMetrics().horizontalAdvance((*it)->text(column)));
    const int beside = 3 * list.indentation() + 30;
    EXPECT_LE(list.columnWidth(column), column == 2 ? 2000 : widest + beside) << column;
    if (column < 2)
    {
      EXPECT_GE(list.columnWidth(column), widest) << column;
    }
  }

  QTest::keyClicks(&searchOf(*keys), "burr");
  int shown = 0;
  for (QTreeWidgetItemIterator it(&list); *it; ++it)
    if ((*it)->parent() && !(*it)->isHidden() && !(*it)->parent()->isHidden())
    {
      ++shown;
      EXPECT_TRUE(((*it)->text(0) + (*it)->text(1) + (*it)->text(2) + (*it)->parent()->text(0))
                      .contains("burr", Qt::CaseInsensitive));
    }
  EXPECT_GE(shown, 3);
  keys->close();
}

// A key of two actions does nothing but warn.
TEST_F(CommandsWindow, NoKeyIsOfTwoActionsOfTheWholeWindow)
{
  saveBall("ball");
  openWindow();
  QMap<QString, QStringList> owners;
  for (const auto* one : window().findChildren<QAction*>())
    if (one->shortcutContext() == Qt::WindowShortcut)
      for (const QKeySequence& key : one->shortcuts())
        if (!key.isEmpty())
          owners[key.toString()] += one->text();
  for (auto it = owners.begin(); it != owners.end(); ++it)
    EXPECT_EQ(it->size(), 1) << it.key().toStdString() << ": " << it->join(", ").toStdString();
}

// A field claims a key by accepting Qt's question (ShortcutOverride); else it is the window's.
TEST_F(CommandsWindow, CharactersThatNeedAltGrStayInTheirField)
{
  openWindow();
  QLineEdit line;
  QDoubleSpinBox number;
  QComboBox editable, choice;
  editable.setEditable(true);
  QPlainTextEdit lines;
  QLineEdit readOnly;
  readOnly.setReadOnly(true);
  const auto claims = [](QWidget& field, int key, Qt::KeyboardModifiers with, const QString& text)
  {
    QKeyEvent event(QEvent::ShortcutOverride, key, with, text);
    event.ignore();
    QApplication::sendEvent(&field, &event);
    return event.isAccepted();
  };
  const Qt::KeyboardModifiers ctrlAlt = Qt::ControlModifier | Qt::AltModifier;
  for (QWidget* field : std::initializer_list<QWidget*>{&line, &number, &editable, &lines})
  {
    SCOPED_TRACE(field->metaObject()->className());
    EXPECT_TRUE(claims(*field, Qt::Key_BracketLeft, Qt::GroupSwitchModifier, "[")) << "X11";
    EXPECT_TRUE(claims(*field, Qt::Key_BracketLeft, ctrlAlt, "[")) << "Windows";
    EXPECT_TRUE(claims(*field, Qt::Key_Slash, Qt::ShiftModifier, "/"));
    EXPECT_TRUE(claims(*field, Qt::Key_D, Qt::NoModifier, "d"));
    EXPECT_FALSE(claims(*field, Qt::Key_BracketLeft, Qt::ControlModifier, "["));
    EXPECT_FALSE(claims(*field, Qt::Key_B, Qt::AltModifier, "b"));
    EXPECT_FALSE(claims(*field, Qt::Key_F9, Qt::NoModifier, {}));
  }
  for (QWidget* other : std::initializer_list<QWidget*>{&readOnly, &choice})
    EXPECT_FALSE(claims(*other, Qt::Key_BracketLeft, Qt::GroupSwitchModifier, "["));
}

TEST_F(CommandsWindow, KeysThatNeedAltGrHaveAnotherOneThatDoesNot)
{
  saveBall("ball");
  openWindow();
  // On a German, Swiss or French keyboard.
  const QRegularExpression hidden("[\\[\\]{}@\\\\|~#]");
  int count = 0;
  for (const Command& command : commandsOf(window(), true))
  {
    const QList<QKeySequence> keys = command.action->shortcuts();
    const auto isHidden = [&hidden](const QKeySequence& one)
    { return one.toString(QKeySequence::PortableText).contains(hidden); };
    if (!std::any_of(keys.begin(), keys.end(), isHidden))
      continue;
    ++count;
    EXPECT_FALSE(std::all_of(keys.begin(), keys.end(), isHidden)) << command.name.toStdString();
    for (const QKeySequence& one : keys)
      EXPECT_TRUE(command.keys.contains(one.toString(QKeySequence::NativeText)));
  }
  EXPECT_EQ(count, 4) << "burrs and slabs";
}

TEST_F(CommandsWindow, BurrsChangeByLettersToo)
{
  saveBall("ball");
  openWindow();
  const auto* diameter = window().findChild<QDoubleSpinBox*>("burrDiameter");
  const double before = diameter->value();
  QTest::keyClick(&window(), Qt::Key_S);
  const double larger = diameter->value();
  EXPECT_GT(larger, before);
  QTest::keyClick(&window(), Qt::Key_A);
  EXPECT_EQ(diameter->value(), before);
  QTest::keyClick(&window(), Qt::Key_BracketRight);
  EXPECT_EQ(diameter->value(), larger);
}
