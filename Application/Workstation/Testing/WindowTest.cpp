#include "GuiTest.h"
#include "PanelLayout.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <new>
#include <thread>
#include <vector>

#include <QAbstractItemModelTester>
#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QProgressDialog>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollBar>
#include <QSlider>
#include <QSpinBox>
#include <QStatusBar>
#include <QTabBar>
#include <QTemporaryDir>
#include <QToolBar>
#include <QToolButton>
#include <QTreeView>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Application.h"
#include "BackgroundWork.h"
#include "Banner.h"
#include "Bind.h"
#include "CaseJobs.h"
#include "SliceView.h"
#include "StartPage.h"
#include "StructuresModel.h"
#include "WindowTexts.h"

using namespace petrous;
using namespace petrous::workstation;

using Window = GuiTest;

// A task that cannot end at once: the window says what it waits for, and handles events.
TEST_F(Window, ClosingCancelsWhatRunsAndSaysWhatItWaitsFor)
{
  openWindow();
  std::atomic<bool> isBegun{false}, isReleased{false}, isCancelled{false};
  QString said;
  QTimer poll;
  QObject::connect(&poll, &QTimer::timeout, &poll,
                   [&]
                   {
                     const auto* note = window().findChild<QProgressDialog*>("finishing");
                     if (!note || !note->isVisible())
                       return;
                     said = note->labelText();
                     isReleased = true;
                   });
  BackgroundWork slow;
  bool isIgnored = true;
  slow.start(
      [&](const core::Progress& progress) -> BackgroundWork::Reply
      {
        progress.report(0.5, "saving");
        isBegun = true;
        for (int n = 0; !isReleased && n < 60000; ++n)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        try
        {
          progress.check("saving");
        }
        catch (const core::CancelledError&)
        {
          isCancelled = true;
          throw;
        }
        return [&isIgnored] { isIgnored = false; };
      });
  ASSERT_TRUE(waitFor([&] { return isBegun.load(); })); // else it is not even begun
  poll.start(10);
  EXPECT_TRUE(window().close());
  EXPECT_FALSE(slow.busy());
  EXPECT_TRUE(isCancelled);
  EXPECT_TRUE(isIgnored);
  EXPECT_EQ(said, "Finishing: saving");
  EXPECT_EQ(window().findChild<QProgressDialog*>("finishing"), nullptr);
}

// With a clock of its own: a fifth of the task took ten seconds, and then nothing comes for a
// while.
TEST_F(Window, ATaskSaysHowMuchTimeIsLeft)
{
  std::atomic<double> now{0.0}, allowed{0.0};
  std::atomic<bool> isReleased{false};
  struct Said
  {
    double fraction;
    QString step, left;
  };
  std::vector<Said> said;
  BackgroundWork task;
  task.setClock([&now] { return now.load(); });
  QObject::connect(&task, &BackgroundWork::progressed, &task,
                   [&said](double fraction, const QString& step, const QString& left) {
                     said.push_back({fraction, step, left});
                   });
  const auto isSaid = [&said](double fraction)
  { return !said.empty() && said.back().fraction == fraction; };
  task.start(
      [&](const core::Progress& progress) -> BackgroundWork::Reply
      {
        for (const double fraction : {0.0, 0.2})
        {
          while (allowed < fraction)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          progress.report(fraction, "saving");
        }
        while (!isReleased)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return [] {};
      });
  EXPECT_TRUE(waitFor([&] { return isSaid(0.0); }));
  EXPECT_TRUE(!said.empty() && said.back().left.isEmpty());
  now = 10.0;
  allowed = 0.2;
  EXPECT_TRUE(waitFor([&] { return isSaid(0.2); }));
  EXPECT_TRUE(!said.empty() && said.back().left == "about 40 s left");
  now = 20.0; // as long as the pause before; the end that was foreseen stays
  EXPECT_TRUE(waitFor([&] { return !said.empty() && said.back().left == "about 30 s left"; }));
  EXPECT_EQ(said.back().step, "saving");
  EXPECT_EQ(said.back().fraction, 0.2);
  isReleased = true;
  EXPECT_TRUE(waitFor([&] { return !task.busy(); }));
  EXPECT_EQ(withTimeLeft("Saving…", {}), "Saving…");
  EXPECT_EQ(withTimeLeft("Saving…", "about 30 s left"), "Saving… · about 30 s left");
}

TEST_F(Window, AJobThatChangesTheCaseIsWaitedForStoppedOrLeftRunning)
{
  openWindow();
  CaseJobs jobs(window());
  bool runs = false;
  int stopped = 0, left = 0;
  jobs.add({[&] { return runs ? QString("counting") : QString(); },
            [&]
            {
              ++stopped;
              runs = false;
            }});
  jobs.add({[] { return QString(); }, [&] { ++stopped; }}); // never runs
  const auto again = [&] { left += jobs.mayLeave({}) ? 1 : 0; };
  const auto answer = [&](QMessageBox::ButtonRole role)
  {
    onMessage(
        [role](QMessageBox& box)
        {
          EXPECT_TRUE(box.text().contains("counting")) << box.text().toStdString();
          clickOn(box, role);
        });
  };
  EXPECT_TRUE(jobs.mayLeave(again)) << "nothing runs";

  runs = true;
  answer(QMessageBox::RejectRole);
  EXPECT_FALSE(jobs.mayLeave(again));
  EXPECT_EQ(stopped, 0);

  answer(QMessageBox::AcceptRole); // waits
  EXPECT_FALSE(jobs.mayLeave(again));
  EXPECT_EQ(left, 0);
  runs = false;
  EXPECT_TRUE(waitFor([&] { return left == 1; }));
  EXPECT_EQ(stopped, 0);

  runs = true;
  answer(QMessageBox::DestructiveRole);
  EXPECT_TRUE(jobs.mayLeave(again));
  EXPECT_EQ(stopped, 1) << "the one that ran";
  EXPECT_EQ(left, 1);
}

TEST_F(Window, WithoutACaseTellsHowToBegin)
{
  openWindow();
  const auto* page = window().findChild<StartPage*>();
  ASSERT_TRUE(page && page->isVisible());
  const auto* sample = page->findChild<QPushButton*>("primary");
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->text(), "Make the sample patient");
  EXPECT_FALSE(action("Save")->isEnabled());
}

TEST_F(Window, ThePanelsKeyRaisesAPanelThatLiesBehindAnother)
{
  saveBall("ball");
  openWindow();
  auto* structures = window().findChild<QDockWidget*>("structuresDock");
  auto* picture = window().findChild<QDockWidget*>("pictureDock");
  const auto inFront = [](const QDockWidget* dock) { return !dock->visibleRegion().isEmpty(); };
  EXPECT_TRUE(waitFor([&] { return inFront(structures) && !inFront(picture); }));
  QTest::keyClick(&window(), Qt::Key_F8);
  EXPECT_TRUE(waitFor([&] { return inFront(picture) && !inFront(structures); }));
  QTest::keyClick(&window(), Qt::Key_F8);
  EXPECT_TRUE(waitFor([&] { return picture->isHidden() && inFront(structures); }));
  QTest::keyClick(&window(), Qt::Key_F8);
  EXPECT_TRUE(waitFor([&] { return inFront(picture); }));
}

TEST_F(Window, ThePanelsKeyGivesItTheKeyboard)
{
  saveBall("ball");
  openWindow();
  auto* structures = window().findChild<QDockWidget*>("structuresDock");
  const auto inFront = [](const QDockWidget* dock) { return !dock->visibleRegion().isEmpty(); };
  ASSERT_TRUE(waitFor([&] { return inFront(structures); }));
  view().setFocus();
  QTest::keyClick(&window(), Qt::Key_F9);
  EXPECT_EQ(window().focusWidget(), &structureList());
  EXPECT_FALSE(structures->isHidden()) << "it was in front, without the keyboard";
  QTest::keyClick(&window(), Qt::Key_F9);
  EXPECT_TRUE(structures->isHidden());
  EXPECT_EQ(window().focusWidget(), &view());
  for (const PanelEntry& entry : panelEntries())
  {
    const QString name = entry.name;
    if (name == "registrationDock" || name == "videoDock" || name == "replayDock")
      continue; // of a case with an MR, a video or a recording
    auto* dock = window().findChild<QDockWidget*>(name);
    dock->hide();
    view().setFocus();
    QTest::keyClick(&window(), Qt::Key(entry.key & ~Qt::KeyboardModifierMask),
                    Qt::KeyboardModifiers(entry.key & int(Qt::KeyboardModifierMask)));
    EXPECT_TRUE(waitFor([&] { return inFront(dock); })) << entry.name;
    // The keys of a tool in use stay with it where there is nothing to choose.
    EXPECT_EQ(dock->isAncestorOf(window().focusWidget()), name != "nearbyDock") << entry.name;
  }
}

TEST_F(Window, ASlashSearchesTheStructuresFromTheWholeWindow)
{
  saveBall("ball");
  openWindow();
  auto* structures = window().findChild<QDockWidget*>("structuresDock");
  auto* search = window().findChild<QLineEdit*>("structuresSearch");
  QTest::keyClick(&window(), Qt::Key_F8); // before it
  ASSERT_TRUE(waitFor([&] { return structures->visibleRegion().isEmpty(); }));
  view().setFocus();
  QApplication::setActiveWindow(&window());
  QTest::keyClick(&view(), Qt::Key_Slash);
  EXPECT_EQ(window().focusWidget(), search);
  EXPECT_TRUE(waitFor([&] { return !structures->visibleRegion().isEmpty(); }));
  view().setFocus();
  structures->hide();
  QTest::keyClick(&view(), Qt::Key_Slash);
  EXPECT_EQ(window().focusWidget(), &view());
}

TEST_F(Window, TheNamesOfPanelsThatShareAPlaceAreWhole)
{
  saveBall("ball");
  openWindow();
  window().resize(1280, 720);
  const auto bars = [this]
  { return window().findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly); };
  for (const PanelEntry& entry : panelEntries())
    window().findChild<QDockWidget*>(entry.name)->show();
  QTest::qWait(50);
  int tabs = 0;
  for (const QTabBar* bar : bars())
    for (int n = 0; n < bar->count(); ++n)
    {
      ++tabs;
      EXPECT_LE(bar->fontMetrics().horizontalAdvance(bar->tabText(n)), bar->tabRect(n).width())
          << bar->tabText(n).toStdString();
    }
  EXPECT_GE(tabs, 6);
}

TEST_F(Window, ALabelOfSeveralLinesIsAsHighAsTheyNeed)
{
  QWidget panel;
  QVBoxLayout layout(&panel);
  auto* above = new QWidget;
  above->setMinimumHeight(100);
  auto* label = new QLabel("short");
  wrapWords(*label);
  layout.addWidget(above, 1);
  layout.addWidget(label);
  panel.resize(400, 160);
  panel.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
  const auto isWhole = [label] { return label->height() >= label->heightForWidth(label->width()); };
  const int line = label->height();
  label->setText(QString("a warning of many words ").repeated(20));
  EXPECT_TRUE(waitFor([&] { return isWhole() && label->height() > 3 * line; }));
  panel.resize(200, 160);
  EXPECT_TRUE(waitFor([&] { return isWhole() && label->width() < 200; }));
  panel.hide();
  panel.show();
  EXPECT_TRUE(waitFor(isWhole));
  label->setText("short");
  EXPECT_TRUE(waitFor([&] { return label->minimumHeight() <= line; })) << "it gives the room back";
}

TEST_F(Window, ALabelThatMayBeEmptyKeepsRoomForSoManyLines)
{
  QWidget panel;
  QVBoxLayout layout(&panel);
  auto* label = new QLabel;
  wrapWords(*label, 3);
  auto* below = new QWidget;
  layout.addWidget(label);
  layout.addWidget(below, 1);
  panel.resize(400, 300);
  panel.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
  const QFontMetrics metrics = label->fontMetrics();
  const int three =
      std::max(3 * metrics.lineSpacing(),
               metrics.boundingRect(QRect(0, 0, 400, 300), Qt::TextWordWrap, "x\nx\nx").height());
  label->setText("short");
  label->repaint();
  EXPECT_EQ(label->minimumHeight(), three);
  label->clear();
  label->repaint();
  EXPECT_EQ(label->minimumHeight(), three);
  const QPoint place = below->pos();
  label->setText("two\nlines");
  label->repaint();
  EXPECT_EQ(label->minimumHeight(), three);
  EXPECT_EQ(below->pos(), place);
  label->setText(QString("a warning of many words ").repeated(20));
  EXPECT_TRUE(waitFor([&] { return label->minimumHeight() > three; }));
  EXPECT_EQ(label->minimumHeight(), label->heightForWidth(label->width()));
  label->setText("short");
  EXPECT_TRUE(waitFor([&] { return label->minimumHeight() == three; }));
}

// What they say appears in room that is there, and moves nothing.
TEST_F(Window, TheHintOfMeasuringHasRoomForTwoLines)
{
  openWindow();
  auto* hint = window().findChild<QLabel*>("measureHint");
  ASSERT_TRUE(hint);
  auto* dock = window().findChild<QDockWidget*>("measureDock");
  ASSERT_TRUE(dock);
  dock->show();
  dock->raise();
  ASSERT_TRUE(waitFor([hint] { return hint->isVisible(); }));
  hint->setText("short");
  hint->repaint();
  EXPECT_TRUE(waitFor([hint] { return hint->height() >= 2 * hint->fontMetrics().lineSpacing(); }));
}

TEST_F(Window, ABannerThatAKeyDismissesLeavesTheKeysToAView)
{
  saveBall("ball");
  openWindow();
  auto* banner = window().findChild<Banner*>("faultBanner");
  banner->setText("a fault");
  banner->show();
  auto* close = banner->findChild<QPushButton*>("dismissFault");
  ASSERT_TRUE(waitFor([close] { return close->isVisible(); }));
  QApplication::setActiveWindow(&window());
  close->setFocus();
  ASSERT_TRUE(close->hasFocus());
  QTest::keyClick(close, Qt::Key_Space);
  EXPECT_TRUE(banner->isHidden());
  EXPECT_TRUE(view().hasFocus());
}

TEST_F(Window, TheFirstPageSaysWhatIsBeingOpenedAndWaits)
{
  openWindow();
  auto* page = window().findChild<StartPage*>();
  auto* busy = page->findChild<QLabel*>("startBusy");
  auto* sample = page->findChild<QPushButton*>("primary");
  EXPECT_TRUE(busy->isHidden());
  saveBall("ball");
  window().begin("ball");
  EXPECT_TRUE(busy->isVisible());
  EXPECT_TRUE(busy->text().contains("ball")) << busy->text().toStdString();
  EXPECT_FALSE(sample->isEnabled());
  EXPECT_TRUE(settled());
  EXPECT_TRUE(window().model().hasCase());
  EXPECT_TRUE(sample->isEnabled() && busy->isHidden()) << "when the page is seen again";
}

namespace
{
QStringList warned; // by Qt
}

TEST_F(Window, OpensWithoutAWarningOfQt)
{
  warned.clear();
  const auto before = qInstallMessageHandler(
      [](QtMsgType type, const QMessageLogContext&, const QString& text)
      {
        if (type == QtWarningMsg)
          warned += text;
      });
  openWindow();
  qInstallMessageHandler(before);
  EXPECT_TRUE(warned.filter("QWidget::").isEmpty()) << warned.join('\n').toStdString();
}

TEST_F(Window, ADurationIsInSecondsOrMinutesAndSeconds)
{
  EXPECT_EQ(durationText(0.0), "0.0 s");
  EXPECT_EQ(durationText(59.94), "59.9 s");
  EXPECT_EQ(durationText(59.96), "1 min 0 s") << "not 60.0 s";
  EXPECT_EQ(durationText(75.0), "1 min 15 s");
  EXPECT_EQ(durationText(3599.0), "59 min 59 s");
}

TEST_F(Window, EachPanelOfTheTableHasADockAKeyAndAnEntryInTheMenu)
{
  openWindow();
  QMenu* menu = nullptr;
  for (QAction* top : window().menuBar()->actions())
    if (top->text() == "&View")
      menu = top->menu();
  ASSERT_TRUE(menu);
  constexpr int kOfALowScreen = 20; // entries
  EXPECT_LE(menu->actions().size(), kOfALowScreen);
  QMenu* panels = nullptr;
  for (QAction* one : menu->actions())
    if (one->text() == "&Panels")
      panels = one->menu();
  ASSERT_TRUE(panels);
  const auto toggles = [this]
  {
    std::vector<QAction*> all;
    for (const PanelEntry& entry : panelEntries())
    {
      auto* dock = window().findChild<QDockWidget*>(entry.name);
      all.push_back(dock ? dock->toggleViewAction() : nullptr);
    }
    return all;
  };
  const auto entries = panelEntries();
  EXPECT_GE(entries.size(), 4u);
  for (std::size_t n = 0; n < entries.size(); ++n)
  {
    SCOPED_TRACE(entries[n].name);
    const QAction* toggle = toggles()[n];
    ASSERT_TRUE(toggle);
    EXPECT_EQ(toggle->text(), entries[n].title);
    EXPECT_EQ(toggle->shortcut(), QKeySequence(entries[n].key));
    EXPECT_TRUE(panels->actions().contains(toggles()[n]));
    EXPECT_EQ(window().dockWidgetArea(window().findChild<QDockWidget*>(entries[n].name)),
              entries[n].area);
    EXPECT_EQ(toggle->isEnabled(), !entries[n].needsCase);
  }
  saveBall("ball");
  window().begin("ball");
  EXPECT_TRUE(settled());
  for (std::size_t n = 0; n < entries.size(); ++n)
  {
    EXPECT_TRUE(toggles()[n]->isEnabled()) << entries[n].name;
    EXPECT_EQ(toggles()[n]->isChecked(), entries[n].atFirst) << entries[n].name;
  }
}

TEST_F(Window, ALongNameIsElidedInItsMiddleAndItsColumnCanBeWidened)
{
  const std::string name = "superior_semicircular_canal_of_the_left_ear_and_its_ampulla";
  scene::Case value = ballCase("ball");
  value.labels[0].structures[0].name = name;
  library().save(value);
  openWindow();
  auto& list = *window().findChild<QTreeView*>("structures");
  ASSERT_TRUE(waitFor([&] { return structureCell(name).isValid(); }));
  const QModelIndex cell = structureCell(name);
  EXPECT_TRUE(cell.data(Qt::ToolTipRole).toString().contains(QString::fromStdString(name)));
  EXPECT_EQ(list.textElideMode(), Qt::ElideMiddle);
  const auto width = [&] { return list.header()->sectionSize(StructuresModel::Name); };
  EXPECT_LT(width(), list.fontMetrics().horizontalAdvance(cell.data().toString()));
  EXPECT_EQ(list.header()->length(), list.viewport()->width()) << "the names fill the list";
  list.header()->resizeSection(StructuresModel::Name, 480); // as by its handle
  window().resize(1260, 700);
  QTest::qWait(50);
  EXPECT_EQ(width(), 480);
  EXPECT_TRUE(list.horizontalScrollBar()->isVisible());
}

TEST_F(Window, ASentenceEndsWithAFullStop)
{
  EXPECT_EQ(sentence("the disk is full"), "the disk is full.");
  EXPECT_EQ(sentence("Is the disk full?"), "Is the disk full?");
  EXPECT_EQ(sentence(QString()), QString());
}

TEST_F(Window, OpensTheLatestCaseAndShowsItsBone)
{
  saveBall("older");
  QTest::qWait(1100); // the library's timestamps have a resolution of 1 s
  saveBall("ball");
  openWindow();
  ASSERT_TRUE(window().model().hasCase());
  EXPECT_EQ(window().windowTitle(), QString::fromUtf8("ball — Petrous"));
  const QImage image = picture();
  EXPECT_GT(pixelsUnlikeTheCorner(image), image.width() * image.height() / 20);
  // A ball in the centre: bone there, none in the corners.
  EXPECT_NE(image.pixel(image.rect().center()), image.pixel(0, 0));
}

namespace
{
/// What the labels that it watches have shown.
class PaintedTexts : public QObject
{
public:
  QStringList texts;

protected:
  bool eventFilter(QObject* watched, QEvent* event) override
  {
    const auto* label = qobject_cast<const QLabel*>(watched);
    if (label && event->type() == QEvent::Paint)
      texts += label->text();
    return false;
  }
};
} // namespace

TEST_F(Window, TheFirstPictureIsAnnouncedUntilItIsDrawn)
{
  openWindow();
  saveBall("ball");
  PaintedTexts painted;
  for (QLabel* label : window().statusBar()->findChildren<QLabel*>())
    label->installEventFilter(&painted);
  PaintedTexts onPage;
  auto* busy = window().findChild<QLabel*>("startBusy");
  busy->installEventFilter(&onPage);
  const_cast<presenters::WorkstationModel&>(window().model()).open("ball");
  const auto isAnnounced = [](const QString& text)
  { return text.startsWith("Preparing the picture"); };
  EXPECT_TRUE(std::any_of(onPage.texts.begin(), onPage.texts.end(), isAnnounced))
      << "in place of a page whose buttons look as if they could be pressed";
  EXPECT_TRUE(busy->isHidden()) << "the page is as ever when the case is closed";
  EXPECT_TRUE(std::any_of(painted.texts.begin(), painted.texts.end(), isAnnounced))
      << "seen before the picture is drawn";
  EXPECT_TRUE(waitFor(
      [&]
      {
        const auto labels = window().statusBar()->findChildren<QLabel*>();
        return std::none_of(labels.begin(), labels.end(),
                            [&](const QLabel* label) { return isAnnounced(label->text()); });
      }));
}

TEST_F(Window, BannersScrollWhereTheyWouldTakeTheViewsRoom)
{
  QWidget whole;
  auto* layout = new QVBoxLayout(&whole);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  BannerStack stack(whole);
  auto* views = new QWidget;
  views->setMinimumHeight(360);
  layout->addWidget(stack.room());
  layout->addWidget(views, 1);
  auto* banner = new Banner("many", Banner::Kind::Notice);
  stack.add(banner);
  whole.resize(800, 700);
  whole.show();
  const auto shows = [&](int lines)
  {
    QStringList all;
    for (int n = 0; n < lines; ++n)
      all += QString("line %1").arg(n);
    banner->setText(all.join('\n'));
    banner->show();
    return waitFor([&] { return stack.height() > 0 && stack.room()->height() == stack.height(); });
  };
  ASSERT_TRUE(shows(2));
  QTest::qWait(50);
  EXPECT_EQ(stack.height(), banner->height()) << "all of it";
  ASSERT_TRUE(shows(60));
  QTest::qWait(50);
  EXPECT_EQ(whole.height(), 700);
  EXPECT_EQ(stack.height(), 280) << "two fifths";
  EXPECT_GT(banner->height(), 60 * 10);
  EXPECT_GE(views->height(), 360);
}

TEST_F(Window, ACaseThatIsNotThereIsToldInOneLine)
{
  openWindow();
  QString text;
  onMessage(
      [&text](QMessageBox& box)
      {
        text = box.text();
        box.accept();
      });
  window().begin("nobody");
  EXPECT_TRUE(waitFor([&text] { return !text.isEmpty(); }));
  EXPECT_TRUE(text.contains("no case 'nobody'")) << text.toStdString();
  EXPECT_FALSE(text.contains('\n'));
}

TEST_F(Window, ACaseIsOpenedThoughAFolderHereHasItsName)
{
  saveBall("ball");
  const std::filesystem::path before = std::filesystem::current_path();
  const QTemporaryDir here;
  std::filesystem::current_path(here.path().toStdString());
  std::filesystem::create_directory("ball");
  openWindow("ball");
  std::filesystem::current_path(before);
  EXPECT_TRUE(window().model().hasCase());
  EXPECT_FALSE(window().busy());
}

TEST_F(Window, AnMrAsPrimaryImageIsCalledSo)
{
  scene::Case value = ballCase("mr");
  value.ct.modality = scene::Modality::Mr;
  value.mr.push_back(value.ct);
  value.mr.back().name = "DWI";
  library().save(value);
  saveBall("ct");
  const auto texts = [this]
  {
    QStringList all;
    for (const auto* label : window().findChildren<QLabel*>())
      if (!label->window()->findChild<StartPage*>()->isAncestorOf(label))
        all += label->text();
    for (const auto* button : window().findChildren<QAbstractButton*>())
      all += button->text();
    for (const auto* action : window().findChildren<QAction*>())
      if (action->isVisible())
        all += action->text();
    // The catalogues of presets and materials name tissues, whatever the image is.
    const QStringList catalogues{"structurePreset", "structureMaterial"};
    for (const auto* box : window().findChildren<QComboBox*>())
      for (int n = 0; n < box->count() && !catalogues.contains(box->objectName()); ++n)
        all += box->itemText(n);
    for (const auto* box : window().findChildren<QAbstractSpinBox*>())
      all += box->specialValueText();
    for (const auto* widget : window().findChildren<QWidget*>())
      if (!catalogues.contains(widget->objectName()) &&
          !qobject_cast<const QToolButton*>(widget) && // of actions that open other cases, too
          !window().findChild<StartPage*>()->isAncestorOf(widget))
        all += widget->toolTip();
    for (const QAction* action : window().findChild<QToolBar*>("drillBar")->actions())
      all += action->toolTip();
    return all.replaceInStrings("&", "");
  };
  const QRegularExpression names("\\bCT\\b|\\b[Bb]one\\b|\\bHU\\b|[Dd]ensity");
  openWindow("mr");
  for (const QString& text : texts())
    EXPECT_FALSE(text.contains(names)) << text.toStdString();
  EXPECT_TRUE(texts().contains("Surface threshold"));
  EXPECT_TRUE(texts().contains("MR"));
  onDialog(
      [&](QDialog& dialog)
      {
        auto* what = dialog.findChild<QComboBox*>("exportWhat");
        if (!what)
          return false;
        for (int n = 0; n < what->count(); ++n)
          EXPECT_FALSE(what->itemText(n).contains(names)) << what->itemText(n).toStdString();
        dialog.reject();
        return true;
      });
  action("Export…")->trigger();
  window().begin("ct"); // a CT has its own words again
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "ct"; }));
  EXPECT_TRUE(settled());
  EXPECT_TRUE(texts().contains("Bone threshold"));
  EXPECT_TRUE(texts().contains("CT alone"));
  EXPECT_TRUE(action("Bone window") && action("Bone thickness over the structure"));
}

TEST_F(Window, ADragTurnsThePatientAndAWheelZooms)
{
  saveBall("ball");
  openWindow();
  const QPoint middle = view().rect().center();
  const auto before = view().picture().camera();
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  QMouseEvent move(QEvent::MouseMove, middle + QPoint(60, 20), Qt::LeftButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&view(), &move);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle + QPoint(60, 20));
  const auto after = view().picture().camera();
  EXPECT_GT((after.position - before.position).norm(), 5.0);
  EXPECT_LT((after.focalPoint - before.focalPoint).norm(), 1e-9);
  EXPECT_NEAR((after.position - after.focalPoint).norm(),
              (before.position - before.focalPoint).norm(), 1e-6);

  QWheelEvent wheel(middle, view().mapToGlobal(middle), {}, {0, 120}, Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view(), &wheel);
  EXPECT_LT((view().picture().camera().position - after.focalPoint).norm(),
            0.95 * (after.position - after.focalPoint).norm());
}

TEST_F(Window, ANumberKeyShowsAStandardView)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&window(), Qt::Key_2);
  const auto camera = view().picture().camera();
  const Eigen::Vector3d eye = (camera.position - camera.focalPoint).normalized();
  EXPECT_LT((eye - Eigen::Vector3d(0, -1, 0)).norm(), 1e-6);
}

TEST_F(Window, AClickPutsTheCrosshairOnTheSurface)
{
  saveBall("ball");
  openWindow();
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  const Eigen::Vector3d offset = window().model().crosshair() - kBallCenter;
  EXPECT_NEAR(offset.norm(), kBallRadius, 0.1);
  EXPECT_LT(offset.x(), -11.0); // lateral view of a right ear
  QTest::keyClick(&window(), Qt::Key_C);
  EXPECT_LT((view().picture().camera().focalPoint - window().model().crosshair()).norm(), 1e-9);
}

TEST_F(Window, SlicesMoveTheCrosshair)
{
  saveBall("ball");
  openWindow();
  auto* axial = window().findChild<SliceView*>("axialView");
  ASSERT_TRUE(axial);
  const auto slice = axial->slice();
  QTest::mouseClick(axial, Qt::LeftButton, Qt::NoModifier, {40, 50});
  const Eigen::Vector3d wanted = slice.patientFromPixel(39.5, 49.5);
  EXPECT_LT((window().model().crosshair() - wanted).cwiseAbs().maxCoeff(), 0.6);

  const double height = window().model().crosshair().z();
  QWheelEvent wheel(QPointF(40, 50), axial->mapToGlobal(QPoint(40, 50)), {}, {0, 120}, Qt::NoButton,
                    Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(axial, &wheel);
  EXPECT_NEAR(window().model().crosshair().z(), height + 0.5, 1e-9);
}

TEST_F(Window, SlicesShowBoneAndStructure)
{
  saveBall("ball");
  openWindow();
  auto* coronal = window().findChild<SliceView*>("coronalView");
  const QImage image = coronal->grab().toImage();
  const auto slice = coronal->slice();
  const auto colorAt = [&](const Eigen::Vector3d& patient)
  {
    const Eigen::Vector2d pixel = slice.pixelFromPatient(patient);
    return QColor(image.pixel(static_cast<int>(pixel[0] + 0.5), static_cast<int>(pixel[1] + 0.5)));
  };
  const QColor bone = colorAt(kBallCenter + Eigen::Vector3d(6.3, 0, 6.3));
  EXPECT_NEAR(bone.red(), 255.0 * (1600.0 + 1300.0) / 4000.0, 2.0);
  EXPECT_EQ(bone.red(), bone.blue());
  const QColor nerve = colorAt(kBallCenter + Eigen::Vector3d(2, 0, 2));
  EXPECT_GT(nerve.green(), nerve.blue());
}

// Its structures are read after it is shown.
TEST_F(Window, TheReadoutOfACaseOpenedAgainNamesTheStructure)
{
  saveBall("ball"); // the crosshair begins in its middle, in the nerve
  for (int n = 0; n < 2; ++n)
  {
    openWindow();
    auto* axial = window().findChild<SliceView*>("axialView");
    ASSERT_TRUE(waitFor([&] { return window().model().ready(); }));
    EXPECT_LT((window().model().crosshair() - kBallCenter).norm(), 1.0);
    EXPECT_TRUE(axial->readout().contains("nerve")) << axial->readout().toStdString();
    closeWindow();
  }
}

TEST_F(Window, TheThresholdTakesTheBoneAway)
{
  saveBall("ball");
  openWindow();
  const int before = pixelsUnlikeTheCorner(picture());
  window().findChild<QDoubleSpinBox*>("isoBox")->setValue(2400);
  ASSERT_TRUE(waitFor([this] { return window().model().value().iso == 2400.0; }));
  EXPECT_LT(pixelsUnlikeTheCorner(picture()), before / 2); // the structure stays
  EXPECT_TRUE(window().windowTitle().startsWith(QString::fromUtf8("•")));
  closeWindow();
  EXPECT_EQ(library().open("ball").iso, 2400.0);
}

// Cone beam: 14 units per HU, water at 14,000.
TEST_F(Window, AnImageThatIsNotInHounsfieldUnitsHasGreyAndAThresholdThatReachesIt)
{
  scene::Case value = ballCase("cone beam");
  const auto hounsfield = std::get<0>(value.ct.volume.get()->voxels()); // the ball's, -1000 to 1600
  auto own = std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry);
  for (std::size_t n = 0; n < hounsfield->size(); ++n)
    own->data()[n] = static_cast<std::uint16_t>(14000 + 14 * hounsfield->data()[n]);
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::uint16_t>>(own));
  own->data()[0] = 60000; // metal; the image's maximum is white
  value.ct.range = {0.0, 60000.0};
  value.iso = 18200.0;
  value.denseBone = 35000.0;
  library().save(value);
  openWindow("cone beam");

  auto* axial = window().findChild<SliceView*>("axialView");
  const QImage image = axial->grab().toImage();
  int white = 0;
  int grey = 0;
  for (int y = 60; y < image.height() - 60; ++y)
    for (int x = 20; x < image.width() - 20; ++x)
    {
      const QColor color(image.pixel(x, y));
      const bool plain = color.red() == color.green() && color.green() == color.blue();
      white += plain && color.red() >= 250;
      grey += plain && color.red() > 120 && color.red() < 245;
    }
  EXPECT_GT(grey, 1000) << "bone of 1600 HU";
  EXPECT_LT(white, grey / 4);

  auto* box = window().findChild<QDoubleSpinBox*>("isoBox");
  auto* slider = window().findChild<QSlider*>("isoSlider");
  EXPECT_EQ(box->value(), 18200.0);
  EXPECT_EQ(box->suffix(), "");
  const int before = pixelsUnlikeTheCorner(picture());
  slider->setValue(slider->maximum());
  EXPECT_EQ(box->value(), 60000.0);
  ASSERT_TRUE(waitFor([this] { return window().model().value().iso == 60000.0; }));
  EXPECT_LT(pixelsUnlikeTheCorner(picture()), before / 2);
  box->setValue(18200.0);
  ASSERT_TRUE(waitFor([this] { return window().model().value().iso == 18200.0; }));
  EXPECT_NEAR(pixelsUnlikeTheCorner(picture()), before, before / 50);
}

TEST_F(Window, TheListOfStructuresChangesTheCase)
{
  saveBall("ball");
  openWindow();
  auto* list = window().findChild<QTreeView*>("structures");
  QAbstractItemModelTester tester(list->model(),
                                  QAbstractItemModelTester::FailureReportingMode::Warning);
  ASSERT_EQ(list->model()->rowCount(), 3) << "bone, soft tissue, and one kind";
  EXPECT_EQ(structureCell("nerve").data().toString(), "nerve");
  const auto cell = [this](const char* key)
  { return structureCell("nerve", StructuresModel::columnOf(key)); };
  EXPECT_TRUE(list->model()->setData(cell("drillable"), Qt::Unchecked, Qt::CheckStateRole));
  const auto* nerve = scene::findStructure(window().model().value(), "nerve");
  EXPECT_FALSE(nerve->look.drillable);
  EXPECT_TRUE(nerve->look.shown);
  const auto warning = [this]
  { return scene::findStructure(window().model().value(), "nerve")->look.warning; };
  EXPECT_TRUE(list->model()->setData(cell("warn_mm"), 1.25, Qt::EditRole));
  for (const double wrong : {-0.1, 50.1, std::nan("")})
    EXPECT_FALSE(list->model()->setData(cell("warn_mm"), wrong, Qt::EditRole)) << wrong;
  EXPECT_EQ(warning(), 1.25);
  EXPECT_EQ(cell("warn_mm").data().toString(), "1.2 mm");
  EXPECT_TRUE(
      structureCell("nerve", StructuresModel::VolumeColumn).data().toString().endsWith(" mm³"));
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(settled());
  const auto saved = library().open("ball");
  EXPECT_FALSE(scene::findStructure(saved, "nerve")->look.drillable);
}

// At the width that the list has at first nothing is cut off, in English and German; a tip has the
// whole of a longer name.
TEST_F(Window, NamesOfStructuresAreNotCutOff)
{
  for (const std::string name : {"Sigmoid sinus right", "Sinus sigmoideus links"})
  {
    scene::Case value = ballCase(name);
    value.labels[0].structures[0].name = name;
    value.labels[0].structures[0].volume = 2664.8;
    value.labels[0].structures[0].look.warning = 12.5;
    library().save(value);
    openWindow(QString::fromStdString(name));
    auto* list = window().findChild<QTreeView*>("structures");
    const QAbstractItemView* view = list; // public there
    for (int column = 0; column < list->model()->columnCount(); ++column)
      if (!list->isColumnHidden(column)) // that of distances, without a burr
      {
        EXPECT_GE(list->columnWidth(column), view->sizeHintForColumn(column)) << name << column;
        EXPECT_GT(list->columnWidth(column),
                  list->header()->fontMetrics().horizontalAdvance(
                      list->model()->headerData(column, Qt::Horizontal).toString()))
            << column;
      }
    EXPECT_LE(list->header()->length(), list->viewport()->width()) << name;
    EXPECT_EQ(structureCell(name).data(Qt::ToolTipRole).toString(), QString::fromStdString(name));
    closeWindow();
  }
}

// They are measured in the background; an open one has no volume, and that fits at 1280 x 720.
TEST_F(Window, MeshesAreCountedMeasuredAndOpenOnesSaidToBe)
{
  core::TriangleMesh closed; // a tetrahedron of 1/6 * 6^3 mm^3
  for (const auto& corner : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(6, 0, 0),
                             Eigen::Vector3f(0, 6, 0), Eigen::Vector3f(0, 0, 6)})
    closed.vertices.push_back(corner + kBallCenter.cast<float>());
  closed.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  core::TriangleMesh open = closed;
  open.triangles.pop_back();
  scene::Case value = ballCase("ball");
  for (const auto& [name, mesh] : {std::pair("implant", closed), std::pair("dura_patch", open)})
  {
    scene::MeshPart part;
    part.name = name;
    part.mesh = std::make_shared<const core::TriangleMesh>(mesh);
    part.triangles = mesh.triangles.size();
    value.meshes.push_back(part);
  }
  value.meshes[1].look.shown = false;
  library().save(value);
  openWindow();
  window().resize(1280, 720);
  auto* list = window().findChild<QTreeView*>("structures");
  const auto volume = [&](const char* part, int role = Qt::DisplayRole)
  { return structureCell(part, StructuresModel::VolumeColumn).data(role).toString(); };
  ASSERT_TRUE(waitFor([&] { return volume("dura_patch") != QString::fromUtf8("…"); }));
  EXPECT_EQ(volume("implant"), QString::fromUtf8("36.0 mm³"));
  EXPECT_EQ(volume("dura_patch"), "open");
  EXPECT_TRUE(volume("dura_patch", Qt::ToolTipRole).contains("3 edges"))
      << volume("dura_patch", Qt::ToolTipRole).toStdString();
  const QAbstractItemView* view = list; // public there
  EXPECT_GE(list->columnWidth(StructuresModel::VolumeColumn),
            view->sizeHintForColumn(StructuresModel::VolumeColumn));
  auto* count = window().findChild<QLabel*>("structuresCount");
  EXPECT_EQ(count->text(), "1 structure, 2 meshes; 2 shown");
  EXPECT_FALSE(count->visibleRegion().isEmpty());
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  model.renamePart("implant", "screw"); // measured anew, as its name is another
  ASSERT_TRUE(waitFor([&] { return volume("screw") == QString::fromUtf8("36.0 mm³"); }));
  model.removePart("dura_patch");
  EXPECT_EQ(count->text(), "1 structure, 1 mesh; 2 shown");
}

TEST_F(Window, ANumberIsNeverMinusZero)
{
  EXPECT_EQ(numberText(-0.04, 1), "0.0");
  EXPECT_EQ(numberText(-0.0, 2), "0.00");
  EXPECT_EQ(numberText(-0.06, 1), "-0.1");
  EXPECT_EQ(numberText(1.25, 2), "1.25");
  const std::unique_ptr<QDoubleSpinBox> box(numberBox("box", {}, {-1.0, 1.0, " mm", 1, 0.1}));
  box->setValue(-0.04);
  EXPECT_EQ(box->text(), "0.0 mm");
  box->setValue(-0.2);
  EXPECT_EQ(box->text(), "-0.2 mm");
}

// Qt would end the program.
TEST_F(Window, WhatASlotThrowsIsToldAndTheWindowGoesOn)
{
  saveBall("ball");
  openWindow();
  auto* banner = window().findChild<Banner*>("faultBanner");
  ASSERT_TRUE(banner);
  EXPECT_FALSE(banner->isVisible());
  QTimer::singleShot(0, &window(), [] { throw core::InvalidParameter("a burr of 400 mm"); });
  EXPECT_TRUE(waitFor([banner] { return banner->isVisible(); }));
  EXPECT_TRUE(banner->text().contains("a burr of 400 mm")) << banner->text().toStdString();
  QTimer::singleShot(0, &window(), [] { throw 7; });
  EXPECT_TRUE(waitFor([banner] { return banner->text().contains("unexpected"); }));
  drill(300);
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
  banner->findChild<QPushButton*>("dismissFault")->click();
  EXPECT_FALSE(banner->isVisible());
}

TEST_F(Window, WhatAThreadThrowsIsToldToo)
{
  openWindow();
  auto* banner = window().findChild<Banner*>("faultBanner");
  std::thread([] { guarded([] { throw std::bad_alloc(); }); }).join();
  EXPECT_TRUE(waitFor([banner] { return banner->text().contains("memory"); }));
}
