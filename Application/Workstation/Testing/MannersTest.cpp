#include "GuiTest.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <malloc.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileDialog>
#include <QGroupBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QProgressDialog>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QStandardPaths>
#include <QStatusBar>
#include <QStyleOption>
#include <QTabBar>
#include <QTextEdit>
#include <QToolTip>
#include <QTranslator>
#include <QTreeView>

#include "AddPartsDialog.h"
#include "Banner.h"
#include "DeviceTestDialog.h"
#include "EventLoopWatchdog.h"
#include "Language.h"
#include "MessageRoom.h"
#include "Panels.h"
#include "RegionDialog.h"
#include "RepairDialog.h"
#include "SeriesDialog.h"
#include "SharedSample.h"
#include "StructuresModel.h"
#include "Theme.h"
#include "WindowSettings.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Network/NodeList.h"

using namespace petrous;
using namespace petrous::workstation;
namespace fs = std::filesystem;

namespace
{

// What holds for the whole window, whatever is done in it.
class Manners : public GuiTest
{
protected:
  /// The ball in `size`^3 voxels with `count` structures, small balls on a lattice in it, and the
  /// CT itself, moved by a known motion, as an MR.
  void saveMany(const std::string& name, int size, int count, bool withMr)
  {
    scene::Case value = ballCase(name);
    const double spacing = 0.5 * 63 / (size - 1);
    value.ct.geometry =
        core::GridGeometry({size, size, size}, Eigen::Vector3d::Constant(spacing),
                           kBallCenter - Eigen::Vector3d::Constant(0.5 * (size - 1) * spacing));
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
    auto labels = volume::makeZeroVolume<std::uint16_t>(value.ct.geometry);
    for (int k = 0; k < size; ++k)
      for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
        {
          const Eigen::Vector3d at =
              value.ct.geometry.patientFromVoxel(Eigen::Vector3d(i, j, k)) - kBallCenter;
          const double depth = kBallRadius - at.norm();
          ct->at(i, j, k) =
              static_cast<std::int16_t>(std::clamp(300.0 + 1000.0 * depth, -1000.0, 1600.0));
          // 4 x 4 x 4 cells of 4 mm, a ball of 1.5 mm in each
          const Eigen::Vector3d cell = at / 4.0 + Eigen::Vector3d::Constant(2.0);
          const Eigen::Vector3d whole = cell.array().floor();
          const Eigen::Vector3d middle = cell - whole - Eigen::Vector3d::Constant(0.5);
          const int n = static_cast<int>(whole[0] + 4.0 * whole[1] + 16.0 * whole[2]);
          if (whole.minCoeff() >= 0.0 && whole.maxCoeff() < 4.0 && n < count &&
              middle.norm() < 1.5 / 4.0)
            labels->at(i, j, k) = static_cast<std::uint16_t>(n + 1);
        }
    value.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
    std::vector<volume::Segment> segments;
    const scene::StructurePart one = value.labels[0].structures[0];
    value.labels[0].structures.clear();
    for (int n = 0; n < count; ++n)
    {
      scene::StructurePart structure = one;
      structure.name = "s" + std::to_string(n + 1);
      structure.index = static_cast<std::uint16_t>(n + 1);
      value.labels[0].structures.push_back(structure);
      volume::Segment segment;
      segment.name = structure.name;
      segment.index = structure.index;
      segments.push_back(segment);
    }
    value.labels[0].labels =
        std::make_shared<const volume::LabelMap>(volume::makeLabelMap(labels, segments));
    if (withMr)
    {
      scene::ImagePart mr = value.ct;
      mr.name = "T2";
      value.mr.push_back(mr);
    }
    library().save(value);
  }

  bool opened(const std::string& name)
  {
    return waitFor(
        [&]
        {
          return window().model().hasCase() && !window().busy() &&
                 window().model().value().name == name && window().model().ready() &&
                 window().model().drawable();
        });
  }

  /// Widgets that the keyboard or the mouse works, but for parts that Qt makes.
  static std::vector<QWidget*> worked(QWidget& within)
  {
    std::vector<QWidget*> found;
    for (QWidget* widget : within.findChildren<QWidget*>())
    {
      const bool isPart = widget->objectName().startsWith("qt_") ||
                          qobject_cast<QHeaderView*>(widget) || qobject_cast<QScrollBar*>(widget) ||
                          qobject_cast<QAbstractSpinBox*>(widget->parentWidget()) ||
                          qobject_cast<QComboBox*>(widget->parentWidget()) ||
                          widget->inherits("QComboBoxPrivateContainer") ||
                          widget->inherits("QTableCornerButton") ||
                          qobject_cast<QTabBar*>(widget->parentWidget()) ||
                          (widget->parentWidget() &&
                           widget->parentWidget()->inherits("QComboBoxPrivateContainer")) ||
                          (qobject_cast<QLineEdit*>(widget->parentWidget()));
      const bool isWorked =
          qobject_cast<QAbstractButton*>(widget) || qobject_cast<QComboBox*>(widget) ||
          qobject_cast<QAbstractSpinBox*>(widget) || qobject_cast<QAbstractSlider*>(widget) ||
          qobject_cast<QLineEdit*>(widget) || qobject_cast<QTextEdit*>(widget) ||
          qobject_cast<QAbstractItemView*>(widget) ||
          ((widget->focusPolicy() & Qt::TabFocus) == Qt::TabFocus &&
           !widget->inherits("QScrollArea") && !widget->inherits("QStackedWidget"));
      if (isWorked && !isPart)
        found.push_back(widget);
    }
    return found;
  }
  static QString described(const QWidget& widget)
  {
    QString text = QString("%1 “%2”").arg(widget.metaObject()->className(), widget.objectName());
    for (const QWidget* above = widget.parentWidget(); above; above = above->parentWidget())
      if (!above->objectName().isEmpty() && !above->objectName().startsWith("qt_"))
        text += " in " + above->objectName();
    return text;
  }
  static void expectNamed(QWidget& within)
  {
    for (QWidget* widget : worked(within))
    {
      QAccessibleInterface* reader = QAccessible::queryAccessibleInterface(widget);
      ASSERT_TRUE(reader) << described(*widget).toStdString();
      EXPECT_FALSE(reader->text(QAccessible::Name).isEmpty())
          << described(*widget).toStdString() << " has no name for a screen reader";
    }
  }
  static bool isInBanner(const QWidget& widget)
  {
    for (const QWidget* above = &widget; above; above = above->parentWidget())
      if (qobject_cast<const Banner*>(above))
        return true;
    return false;
  }
  static void expectTips(QWidget& within)
  {
    for (QWidget* widget : worked(within))
    {
      if (isInBanner(*widget)) // whose text it answers
        continue;
      const auto* line = qobject_cast<QLineEdit*>(widget);
      const bool isControl =
          line || qobject_cast<QAbstractButton*>(widget) || qobject_cast<QComboBox*>(widget) ||
          qobject_cast<QAbstractSpinBox*>(widget) || qobject_cast<QAbstractSlider*>(widget);
      const bool hasTip =
          !widget->toolTip().isEmpty() || (line && !line->placeholderText().isEmpty());
      EXPECT_TRUE(hasTip || !isControl) << described(*widget).toStdString() << " has no tip";
    }
  }
  /// Of the space about a text, that the text may take: a size hint has some pixels more than what
  /// is painted.
  static int marginOf(const QWidget& widget)
  {
    constexpr int kLeast = 3; // px
    return std::max(kLeast,
                    widget.style()->pixelMetric(QStyle::PM_ButtonMargin, nullptr, &widget) / 2);
  }
  /// With some space beside it, but without the arrow of a list that is sorted.
  static int wholeTitle(const QHeaderView& header, const QString& text)
  {
    constexpr int kBeside = 8; // px
    return header.fontMetrics().horizontalAdvance(text) +
           (header.isSortIndicatorShown() ? 0 : kBeside);
  }
  /// One that is narrower than its entries on purpose, such as the names of files.
  static bool isElided(const QComboBox& choice)
  {
    return choice.sizeAdjustPolicy() == QComboBox::AdjustToMinimumContentsLengthWithIcon;
  }
  /// Texts that do not fit into their widgets, and widgets that are cut off at a side.
  static QStringList cutTexts(QWidget& within)
  {
    QStringList cut;
    const auto add = [&cut](const QWidget& widget, const QString& text, int wanted, int has)
    {
      cut += QString("“%1” needs %2 px and has %3: %4")
                 .arg(text)
                 .arg(wanted)
                 .arg(has)
                 .arg(described(widget));
    };
    for (QWidget* widget : within.findChildren<QWidget*>())
    {
      if (!widget->isVisible() || widget->objectName().startsWith("qt_"))
        continue;
      const auto* label = qobject_cast<QLabel*>(widget);
      const auto* button = qobject_cast<QAbstractButton*>(widget);
      if (const auto* header = qobject_cast<QHeaderView*>(widget))
      {
        for (int n = 0; n < header->count(); ++n)
          if (const QString text = header->model()->headerData(n, header->orientation()).toString();
              !header->isSectionHidden(n) && header->orientation() == Qt::Horizontal &&
              wholeTitle(*header, text) > header->sectionSize(n))
            add(*header, text, wholeTitle(*header, text), header->sectionSize(n));
        continue;
      }
      if (const auto* choice = qobject_cast<QComboBox*>(widget))
      {
        const QString chosen = choice->currentText();
        QStyleOptionComboBox option;
        option.initFrom(choice);
        option.editable = choice->isEditable();
        const int has =
            choice->style()
                ->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, choice)
                .width();
        const int wanted = choice->fontMetrics().horizontalAdvance(chosen);
        if (!isElided(*choice) && wanted > has)
          add(*choice, chosen, wanted, has);
        continue;
      }
      if (const auto* line = qobject_cast<QLineEdit*>(widget))
      {
        const QString hint = line->text().isEmpty() ? line->placeholderText() : QString();
        QStyleOptionFrame option;
        option.initFrom(line);
        const int has =
            line->style()->subElementRect(QStyle::SE_LineEditContents, &option, line).width();
        const int wanted = line->fontMetrics().horizontalAdvance(hint);
        if (wanted > has && !line->toolTip().contains(hint)) // it is elided
          add(*line, hint, wanted, has);
        continue;
      }
      if (const auto* box = qobject_cast<QGroupBox*>(widget))
      {
        const int wanted = box->fontMetrics().size(Qt::TextShowMnemonic, box->title()).width();
        if (wanted > box->width())
          add(*box, box->title(), wanted, box->width());
        continue;
      }
      const QString text = label ? label->text() : button ? button->text() : QString();
      if (text.isEmpty())
        continue;
      if (label && label->wordWrap())
      {
        if (label->heightForWidth(label->width()) > label->height())
          add(*label, text, label->heightForWidth(label->width()), label->height());
      }
      else if (widget->sizeHint().width() > widget->width() + marginOf(*widget))
        add(*widget, text, widget->sizeHint().width(), widget->width());
      // What scrolls may be cut off above and below.
      const QRegion seen = widget->visibleRegion();
      if (!seen.isEmpty() && seen.boundingRect().width() < widget->width() - marginOf(*widget))
        add(*widget, text, widget->width(), seen.boundingRect().width());
    }
    return cut;
  }
  /// Once the layout has settled, which a loaded machine puts off.
  static void expectWhole(QWidget& within, const QString& where)
  {
    QStringList cut = cutTexts(within);
    for (int tries = 0; !cut.isEmpty() && tries < 20; ++tries)
    {
      QTest::qWait(50);
      cut = cutTexts(within);
    }
    EXPECT_TRUE(cut.isEmpty()) << where.toStdString() << ":\n" << cut.join('\n').toStdString();
  }
  /// Guarded: to look at one takes time, in which others may go.
  static std::vector<QPointer<QDialog>> shownDialogs()
  {
    std::vector<QPointer<QDialog>> shown;
    for (QWidget* top : QApplication::topLevelWidgets())
      if (auto* dialog = qobject_cast<QDialog*>(top); dialog && dialog->isVisible())
        shown.emplace_back(dialog);
    return shown;
  }
  static bool opensDialog(const QAction& action)
  {
    return !action.menu() && (action.text().endsWith(QString::fromUtf8("…")) ||
                              action.shortcut() == QKeySequence(Qt::Key_F1));
  }
  /// Looks at each dialog that the menus open, and gives it up. Returns their names.
  std::set<QString> lookAtDialogs(const QString& language)
  {
    std::set<QString> seen;
    QPointer<QDialog> last;
    bool found = false;
    QString entry;
    const auto look = [&](QDialog& dialog)
    {
      if (&dialog == last)
        return dialog.reject();
      last = &dialog;
      found = true;
      if (!qobject_cast<QFileDialog*>(&dialog)) // Qt's own
      {
        seen.insert(dialog.objectName());
        QTest::qWait(50);
        expectWhole(dialog, language + ", " + entry + ", dialog “" + dialog.objectName() + "”");
        const QStringList shared = sharedMnemonics(dialog);
        EXPECT_TRUE(shared.isEmpty())
            << language.toStdString() << ", dialog " << dialog.objectName().toStdString() << ":\n"
            << shared.join('\n').toStdString();
        const QSize room = dialog.screen()->availableSize();
        EXPECT_LE(dialog.width(), room.width()) << dialog.objectName().toStdString();
        EXPECT_LE(dialog.height(), room.height()) << dialog.objectName().toStdString();
        const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
        if (!pictures.isEmpty())
          dialog.grab().save(QString("%1/%2-%3.png").arg(pictures, dialog.objectName(), language));
      }
      dialog.reject();
    };
    QTimer poll;
    bool looks = false; // it waits, and so comes here again
    QObject::connect(&poll, &QTimer::timeout, &poll,
                     [&]
                     {
                       auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
                       if (looks || !dialog || qobject_cast<QProgressDialog*>(dialog))
                         return;
                       looks = true;
                       look(*dialog);
                       looks = false;
                     });
    poll.start(10);
    QList<QPointer<QAction>> entries;
    for (QAction* action : window().findChildren<QAction*>())
      if (opensDialog(*action))
        entries += action;
    for (const QPointer<QAction>& action : entries)
    {
      if (!action || !action->isEnabled())
        continue;
      entry = QString(action->text()).remove('&');
      last.clear();
      found = false;
      action->trigger();
      // One that returns at once, or comes after some work.
      for (int tries = 0; !found && tries < 10; ++tries)
      {
        QTest::qWait(30);
        for (const QPointer<QDialog>& dialog : shownDialogs())
          if (dialog && dialog->isVisible() && !qobject_cast<QProgressDialog*>(dialog))
            look(*dialog);
      }
      EXPECT_TRUE(
          waitFor([this] { return !window().busy() && !QApplication::activeModalWidget(); }))
          << entry.toStdString();
      QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    return seen;
  }
  std::vector<QDockWidget*> docks()
  {
    std::vector<QDockWidget*> all;
    for (const PanelEntry& entry : panelEntries())
      all.push_back(window().findChild<QDockWidget*>(entry.name));
    return all;
  }
};

} // namespace

// Figures are printed, not asserted. PETROUS_WATCHDOG_SIZE=320: with voxels as a patient has.
TEST_F(Manners, TheWindowGoesOnDuringLongWork)
{
  const int size = qEnvironmentVariable("PETROUS_WATCHDOG_SIZE", "64").toInt();
  saveAfter = 50;
  openWindow(); // without a case
  saveMany("sixty", size, 60, true);
  const fs::path file = folder() / "ear.nrrd";
  imaging::writeVolume(file, *library().open("sixty").ct.volume.get());
  EventLoopWatchdog watchdog;
  watchdog.begin("import of a CT");
  dropPath(file);
  ASSERT_TRUE(opened("ear"));
  watchdog.begin("opening of 60 structures");
  window().begin("sixty");
  ASSERT_TRUE(opened("sixty"));
  EXPECT_GT(watchdog.steps().back().beats, 0) << "it is read in another thread";
  watchdog.begin("picture at rest");
  QTest::qWait(700);
  watchdog.begin("one of 60 alone, and undone");
  structureList().setCurrentIndex(structureCell("s33"));
  window().findChild<QAbstractButton*>("onlyThese")->click();
  ASSERT_TRUE(waitFor([this] { return window().model().drawable(); }));
  action("Undo")->trigger();
  ASSERT_TRUE(waitFor([this] { return window().model().drawable(); }));
  watchdog.begin("thickness");
  structureList().setCurrentIndex(structureCell("s33"));
  action("Bone thickness over the structure")->trigger();
  EXPECT_TRUE(window().model().thicknessOver().empty()) << "it is measured in another thread";
  ASSERT_TRUE(waitFor([this] { return window().model().thicknessOver() == "s33"; }));
  watchdog.begin("burr taken up and a stroke");
  drill(400);
  watchdog.begin("stroke undone, and saved");
  action("Undo")->trigger();
  EXPECT_TRUE(strokeEnds());
  EXPECT_TRUE(waitFor([this] { return !window().model().unsaved() && !window().busy(); }));
  watchdog.begin("archive");
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "archiveCase")
          return false;
        dialog.findChild<QLineEdit*>("archiveFile")
            ->setText(QString::fromStdString((folder() / "sixty").string()));
        dialog.findChild<QPushButton*>("primary")->click();
        return true;
      });
  bool told = false;
  onMessage(
      [&](QMessageBox& box)
      {
        told = true;
        box.accept();
      });
  action(QString::fromUtf8("Archive…"))->trigger();
  EXPECT_TRUE(waitFor([&] { return told && !window().busy(); }));
  EXPECT_TRUE(fs::exists(folder() / "sixty.petrous"));
  watchdog.begin("registration, begun and stopped");
  action("Register the MR")->trigger();
  QTest::qWait(300);
  EXPECT_GT(watchdog.steps().back().beats, 0) << "it runs in another thread";
  auto* cancel = window().findChild<QAbstractButton*>("cancelRegistration");
  if (cancel->isEnabled()) // else it has ended
  {
    onMessage([](QMessageBox& box) { box.reject(); }); // of the best place by then, if any
    cancel->click();
    EXPECT_TRUE(waitFor([&] { return !cancel->isEnabled(); }));
  }
  watchdog.begin("case closed");
  action("Close the case")->trigger();
  EXPECT_TRUE(waitFor([this] { return !window().model().hasCase(); }));
}

TEST_F(Manners, NoVolumeOutlivesItsCaseAndMemoryComesBack)
{
  openWindow(); // without a case
  saveMany("sixty", 40, 12, false);
  const auto used = []
  {
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    malloc_trim(0);
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
  };
  const auto openAndClose = [&]
  {
    window().begin("sixty");
    ASSERT_TRUE(opened("sixty"));
    const std::weak_ptr<const volume::IntensityVolume> ct =
        window().model().value().ct.volume.peek();
    const std::weak_ptr<const volume::LabelMap> labels =
        window().model().value().labels[0].labels.peek();
    EXPECT_FALSE(ct.expired() || labels.expired());
    QTest::qWait(20); // it is drawn
    action("Close the case")->trigger();
    ASSERT_TRUE(waitFor([this] { return !window().model().hasCase() && !window().busy(); }));
    EXPECT_TRUE(waitFor([&] { return ct.expired(); })) << ct.use_count();
    EXPECT_TRUE(waitFor([&] { return labels.expired(); })) << labels.use_count();
  };
  constexpr int kTimes = 20, kWarm = 3, kRounds = 2;
  for (int n = 0; n < kWarm && !HasFailure(); ++n)
    openAndClose();
  // What is made once and kept may come late on a busy machine, but not in each round.
  bool isSteady = false;
  for (int round = 0; round < kRounds && !isSteady && !HasFailure(); ++round)
  {
    const double before = used();
    for (int n = 0; n < kTimes && !HasFailure(); ++n)
      openAndClose();
    double after = used();
    isSteady = waitFor([&] { return (after = used()) < 1.05 * before; },
                       10000); // work in the background ends
    std::printf("memory in use: %.1f MB before, %.1f MB after %d cases\n", 1e-6 * before,
                1e-6 * after, kTimes);
  }
  EXPECT_TRUE(isSteady);
}

TEST_F(Manners, SafeModeHasNoSettingsNoDevicesAndNoPreviousCase)
{
  saveBall("ball");
  openWindow();
  window().findChild<QDoubleSpinBox*>("thrust")->setValue(2.5);
  ASSERT_TRUE(window().model().hasCase());
  closeWindow();

  isSafe = true;
  openWindow();
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_EQ(window().windowTitle(), "Petrous (safe mode)");
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  EXPECT_EQ(thrust->value(), 1.0);
  thrust->setValue(4.0);
  EXPECT_EQ(window().findChild<QComboBox*>("deviceChoice")->count(), 1) << "the mouse";
  window().begin("ball");
  ASSERT_TRUE(opened("ball"));
  EXPECT_EQ(window().windowTitle(), QString::fromUtf8("ball — Petrous (safe mode)"));
  drill(300);
  closeWindow();
  EXPECT_FALSE(fs::exists(WindowSettings::kNone));

  const auto file = QString::fromStdString((folder() / "settings.conf").string());
  EXPECT_EQ(WindowSettings(file).thrust(), 2.5) << "as it was before";
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), 1u) << "cases are saved";
}

TEST_F(Manners, FileDialogsKeepNoFolderInTheUsersSettings)
{
  const fs::path visited = folder() / "Gorblimey^Ethelwulf";
  fs::create_directories(visited);
  const auto path = QString::fromStdString(visited.string());
  {
    QFileDialog dialog(nullptr, {}, path);
    dialog.setOption(QFileDialog::DontUseNativeDialog);
    dialog.setHistory({path});
  } // where Qt keeps both
  for (const QString& name :
       {QSettings(QSettings::UserScope, "QtProject").fileName(),
        QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation) +
            "/QtProject.conf"})
  {
    QFile kept(name);
    const QByteArray bytes = kept.open(QIODevice::ReadOnly) ? kept.readAll() : QByteArray();
    EXPECT_FALSE(bytes.contains("Gorblimey")) << name.toStdString();
  }
  EXPECT_EQ(QFileDialog().directory().dirName(), "Gorblimey^Ethelwulf")
      << "as long as the program runs";
}

TEST_F(Manners, SettingsThatAreGarbageAreTheUsualAndAreWrittenAnew)
{
  saveBall("ball");
  const fs::path file = folder() / "settings.conf"; // the window's
  const std::string zeros(16, '\0');
  for (const std::string& garbage :
       {zeros + "\xff\xfe[[[[=\n\n]]%%%\\x\n=\n[hand]\nthrust_n=@Variant(" + zeros,
        std::string(4096, '\xa5'), std::string("[hand\nthrust_n"),
        std::string("[panels]\nstructuresDock=@ByteArray(\\x0)\n[views]\nlayout=-7\n")})
  {
    std::ofstream(file, std::ios::binary) << garbage;
    const QString name = QString::fromStdString(file.string());
    EXPECT_FALSE(WindowSettings(name).thrust());
    WindowSettings(name).keepThrust(3.5);
    EXPECT_EQ(WindowSettings(name).thrust(), 3.5);
    std::ofstream(file, std::ios::binary) << garbage;
  }
  openWindow();
  EXPECT_TRUE(window().model().hasCase());
  EXPECT_TRUE(window().findChild<QDockWidget*>("structuresDock")->isVisible());
}

// What is no stroke is not in the journal: it is saved by itself.
TEST_F(Manners, AChangeIsSavedAfterAWhile)
{
  saveBall("ball");
  saveAfter = 50;
  openWindow();
  ASSERT_TRUE(opened("ball"));
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  model.setIso(700.0);
  ASSERT_TRUE(waitFor([this] { return !window().model().unsaved() && !window().busy(); }));
  EXPECT_EQ(library().open("ball").iso, 700.0) << "as a window has it that starts after a crash";
  EXPECT_TRUE(action("Undo")->isEnabled());
}

// Root may write anywhere but there.
TEST_F(Manners, ALibraryThatCannotBeWrittenIsSaidAndTheCaseStaysOpen)
{
  const fs::path file = folder() / "ear.nrrd";
  imaging::writeVolume(file, *ballCase("x").ct.volume.get());
  std::ofstream(folder() / "library") << "a file in place of the folder";
  openWindow();
  EXPECT_FALSE(window().model().hasCase());
  QStringList told;
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, &answer,
                   [&]
                   {
                     if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
                     {
                       told += box->text();
                       box->accept();
                     }
                   });
  answer.start(10);
  dropPath(file);
  auto* banner = window().findChild<Banner*>("unsavedBanner");
  EXPECT_TRUE(
      waitFor([&] { return !window().busy() && (banner->isVisible() || !told.isEmpty()); }, 20000));
  const QString why = banner->isVisible() ? banner->text() : told.join('\n');
  EXPECT_TRUE(why.contains("library")) << why.toStdString();
  EXPECT_FALSE(window().findChild<Banner*>("faultBanner")->isVisible());
  if (!banner->isVisible())
    return;
  EXPECT_TRUE(window().model().hasCase());
  fs::remove(folder() / "library"); // the medium is back
  banner->findChild<QPushButton*>("retrySave")->click();
  EXPECT_TRUE(waitFor([&] { return !banner->isVisible() && !window().busy(); }));
  EXPECT_EQ(library().list().size(), 1u);
}

TEST_F(Manners, AllThatIsWorkedHasANameForScreenReadersAndATip)
{
  saveMany("sixty", 24, 3, true);
  openWindow("sixty");
  for (QDockWidget* dock : docks())
  {
    dock->show();
    dock->raise();
    QTest::qWait(1);
  }
  expectNamed(window());
  expectTips(window());
}

TEST_F(Manners, DialogsHaveNamesForScreenReadersAndAWayOutByKey)
{
  saveMany("sixty", 24, 3, true);
  openWindow("sixty");
  for (const char* entry :
       {"Export…", "Archive…", "Settings…", "Keys", "Find a command…", "Save as…", "About Petrous"})
  {
    SCOPED_TRACE(entry);
    QPointer<QDialog> seen;
    const auto look = [&](QDialog& dialog)
    {
      seen = &dialog;
      expectNamed(dialog);
      QTest::keyClick(&dialog, Qt::Key_Escape);
      EXPECT_FALSE(dialog.isVisible());
      dialog.close();
    };
    QTimer poll;
    QObject::connect(&poll, &QTimer::timeout, &poll,
                     [&]
                     {
                       if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget()))
                       {
                         poll.stop();
                         look(*dialog);
                       }
                     });
    poll.start(10);
    action(QString::fromUtf8(entry))->trigger();
    if (poll.isActive()) // not modal
      for (const QPointer<QDialog>& dialog : shownDialogs())
        if (dialog && poll.isActive())
        {
          poll.stop();
          look(*dialog);
        }
    EXPECT_FALSE(poll.isActive()) << "no dialog";
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
}

// The smallest screen; 4K at scale 2 counts 1920 x 1080 of the same pixels. With texts that are
// longer than English ones.
TEST_F(Manners, NoPanelIsLargerThanTheSmallestScreen)
{
  constexpr int kWidth = 1280, kHeight = 680; // 40 are the title's
  LongTexts longer;
  QApplication::installTranslator(&longer);
  saveMany("sixty", 24, 3, true);
  openWindow("sixty");
  QApplication::removeTranslator(&longer);
  for (QDockWidget* dock : docks())
  {
    dock->show();
    dock->raise();
    window().resize(kWidth, kHeight);
    QTest::qWait(20);
    EXPECT_LE(dock->minimumSizeHint().width(), kWidth / 2) << dock->objectName().toStdString();
    QString widest;
    for (const QWidget* one : window().centralWidget()->findChildren<QWidget*>())
      if (one->minimumSizeHint().width() > kWidth / 2)
        widest += "\n  " + described(*one);
    EXPECT_LE(window().minimumSizeHint().width(), kWidth)
        << dock->objectName().toStdString() << widest.toStdString();
    EXPECT_LE(window().minimumSizeHint().height(), kHeight) << dock->objectName().toStdString();
    EXPECT_LE(window().width(), kWidth) << dock->objectName().toStdString();
    EXPECT_LE(window().height(), kHeight) << dock->objectName().toStdString();
    const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
    if (!pictures.isEmpty())
      window().grab().save(pictures + "/" + dock->objectName() + ".png");
    if (dock->objectName() != "nearbyDock") // stands beside the others
      dock->hide();
  }
}

// As HTML they would be an x and a sign for a missing image. Lines are broken at blanks at most.
TEST_F(Manners, NamesThatLookLikeHtmlAreShownAsTheyAre)
{
  const QString name = "<b>x</b><img src='y.png'>";
  const auto isWhole = [&name](const QLabel& label)
  {
    return label.text().contains(name) && label.textFormat() == Qt::PlainText &&
           label.sizeHint().width() >= label.fontMetrics().horizontalAdvance("<b>x</b><img");
  };
  scene::Case value = ballCase("ball");
  value.labels.front().structures.front().name = name.toStdString();
  library().save(value);
  openWindow("ball");

  QMessageBox box(QMessageBox::Question, "Names", name, QMessageBox::Ok, &window());
  box.setInformativeText(name);
  box.open();
  int whole = 0;
  for (const QLabel* label : box.findChildren<QLabel*>())
    whole += isWhole(*label);
  EXPECT_EQ(whole, 2) << "the text and the informative one";
  box.close();

  QLabel label(name, &window());
  label.show();
  EXPECT_TRUE(isWhole(label));
  label.hide();

  const QModelIndex cell = structureCell(name.toStdString());
  ASSERT_TRUE(cell.isValid());
  EXPECT_EQ(cell.data().toString(), name);
  for (const QString& tip : {name, cell.data(Qt::ToolTipRole).toString()})
  {
    ASSERT_TRUE(tip.contains(name)) << tip.toStdString();
    QToolTip::showText(window().mapToGlobal(QPoint(9, 9)), tip, &window());
    const QLabel* shown = nullptr;
    for (const QWidget* one : QApplication::topLevelWidgets())
      if (one->inherits("QTipLabel") && one->isVisible())
        shown = qobject_cast<const QLabel*>(one);
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->text(), tip);
    EXPECT_EQ(shown->textFormat(), Qt::PlainText);
    QToolTip::hideText();
  }

  bool isAbout = false;
  onMessage(
      [&](QMessageBox& about)
      {
        isAbout = about.textFormat() == Qt::RichText;
        about.close();
      });
  action("About Petrous")->trigger();
  EXPECT_TRUE(waitFor([&isAbout] { return isAbout; })) << "the program's own texts have formats";
}

// What is said while drilling, and the report's advice, beside the name of a recording.
TEST_F(Manners, AMessageGetsTheRoomOfThePermanentTexts)
{
  openWindow();
  window().resize(1280, 680);
  QStatusBar* bar = window().statusBar();
  auto* recording = window().findChild<QLabel*>("recording");
  ASSERT_TRUE(recording);
  recording->setText("Recording left-ear-2026-11-27-rehearsal-of-the-second-approach.prec");
  recording->show();
  ASSERT_TRUE(waitFor([&] { return recording->width() > 100; }));
  const QString message = "The burr has lifted: what lies under the pointer is another surface, "
                          "far deeper or higher. Let go and press again to drill there.";
  const QString longer = message + QString(message.size() * 2 / 5, 'n');
  bar->showMessage(longer);
  const int needed = bar->fontMetrics().horizontalAdvance(longer);
  EXPECT_TRUE(waitFor([&] { return recording->width() == 0 || needed < bar->width() / 2; }));
  EXPECT_EQ(bar->toolTip(), longer);
  EXPECT_EQ(bar->accessibleDescription(), longer);
  bar->showMessage("Saved");
  EXPECT_TRUE(waitFor([&] { return recording->width() > 100; }));
  bar->clearMessage();
  EXPECT_TRUE(bar->toolTip().isEmpty());
}

// What the bar shows changes under a message: the speed, the place, a fault of the force.
TEST_F(Manners, WidgetsGoForTheMessageThatIsShownWhateverChangesAfterIt)
{
  QStatusBar bar;
  auto* yields = new QLabel("60 frames a second");
  auto* stays = new QLabel("-");
  bar.addPermanentWidget(yields);
  bar.addPermanentWidget(stays);
  new MessageRoom(bar, {yields});
  bar.resize(1200, bar.sizeHint().height());
  bar.show();
  const auto textOf = [&bar](int pixels)
  {
    const int letter = bar.fontMetrics().horizontalAdvance('n');
    return QString(pixels / letter, 'n');
  };
  bar.showMessage(textOf(600));
  ASSERT_TRUE(waitFor([&] { return yields->width() >= yields->sizeHint().width(); }))
      << "there is room for both";
  stays->setText(textOf(500));
  EXPECT_TRUE(waitFor([&] { return yields->width() == 0; }));
  stays->setText("-");
  ASSERT_TRUE(waitFor([&] { return stays->width() < 100; }));
  EXPECT_EQ(yields->width(), 0) << "comes and goes under one message";
  bar.showMessage("Saved");
  EXPECT_TRUE(waitFor([&] { return yields->width() >= yields->sizeHint().width(); }));
  stays->setText(textOf(500));
  ASSERT_TRUE(waitFor([&] { return stays->width() >= stays->sizeHint().width(); }));
  EXPECT_GE(yields->width(), yields->sizeHint().width()) << "a short one needs no room";
  bar.clearMessage();
  EXPECT_GE(yields->width(), yields->sizeHint().width());
}

TEST_F(Manners, NoTextIsCutOffOnTheSmallestScreenInGerman)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  QTranslator german;
  ASSERT_TRUE(german.load(":/translations/petrous_de.qm"));
  QApplication::installTranslator(&german);
  saveMany("sixty", 24, 3, true);
  openWindow("sixty");
  for (QDockWidget* dock : docks())
  {
    dock->show();
    dock->raise();
    window().resize(1280, 680);
    QTest::qWait(50);
    expectWhole(*dock, dock->objectName());
    if (dock->objectName() != "nearbyDock") // stands beside the others
      dock->hide();
  }
  QApplication::removeTranslator(&german);
}

// All that the menus open, without a network.
TEST_F(Manners, NoTextOfADialogIsCutOffInEnglishAndGerman)
{
  saveMany("sixty", 24, 3, true);
  network::Node node; // without one, that is asked for instead of what is sent
  node.name = "radiology";
  node.host = "pacs.hospital.example";
  node.aeTitle = "ARCHIVE";
  network::NodeList(folder() / "library").add(node);
  for (const QString language : {"en", "de"})
  {
    if (!hasLanguage(language))
      continue;
    QTranslator texts;
    if (language != "en")
    {
      ASSERT_TRUE(texts.load(":/translations/petrous_" + language + ".qm"));
      QApplication::installTranslator(&texts);
    }
    openWindow("sixty");
    ASSERT_TRUE(opened("sixty"));
    const std::set<QString> seen = lookAtDialogs(language);
    for (const char* name :
         {"settings", "keyList", "commandPalette", "exportCase", "archiveCase", "nodes", "sendCase",
          "receive", "deidentify", "pseudonyms", "catalogueDialog", "cropBoxDialog", "describeCase",
          "film", "planReport", "printPicture", "askCollect", "askDelete"})
      EXPECT_TRUE(seen.count(name)) << name << ": " << language.toStdString();
    closeWindow();
    QApplication::removeTranslator(&texts);
  }
}

struct UsualTheme
{
  ~UsualTheme() { applyTheme(*qApp); }
};

// As above, with the letters' size of the settings.
TEST_F(Manners, NoTextOfADialogIsCutOffWithLargeLetters)
{
  const UsualTheme after;
  saveMany("sixty", 24, 3, true);
  std::ofstream(folder() / "settings.conf") << "[look]\nfont_scale=1.25\n";
  const int usual = QFontMetrics(QApplication::font()).height();
  openWindow("sixty");
  ASSERT_TRUE(opened("sixty"));
  ASSERT_GT(QFontMetrics(QApplication::font()).height(), usual);
  const std::set<QString> seen = lookAtDialogs("en-large");
  for (const char* name : {"nodes", "describeCase", "catalogueDialog"})
    EXPECT_TRUE(seen.count(name)) << name;
  closeWindow();
}

// Those that come with files or a device: of written files, or of stand-ins for what was found.
TEST_F(Manners, NoTextOfADialogOfFilesOrDevicesIsCutOffInEnglishAndGerman)
{
  const UsualTheme after;
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(folder() / "sample", options);
  const fs::path whole = folder() / "sample" / "ct";
  const fs::path broken = folder() / "broken"; // without a slice in the middle
  fs::copy(whole, broken);
  std::vector<fs::path> slices;
  for (const auto& entry : fs::directory_iterator(broken))
    slices.push_back(entry.path());
  std::sort(slices.begin(), slices.end());
  fs::remove(slices[slices.size() / 2]);
  const presenters::SourceContent repaired = presenters::lookAt(broken, {});

  presenters::SourceContent several;
  several.path = folder();
  for (const presenters::Content content :
       {presenters::Content::Ct, presenters::Content::Ct, presenters::Content::Mr})
  {
    presenters::SeriesContent one;
    one.selector = "1.2." + std::to_string(several.series.size());
    one.content = content;
    one.modality = content == presenters::Content::Mr ? "MR" : "CT";
    one.description = "Felsenbein hochauflösend 0,6 H70h links";
    one.kernel = "H70h";
    one.slices = 240;
    one.spacing = {0.25, 0.25, 0.6};
    several.series.push_back(one);
  }
  AddPartsDialog::Part mr;
  mr.what = QString::fromUtf8("MR “t2-space-felsenbein.nii.gz”");
  mr.name = "T2";
  AddPartsDialog::Part labels;
  labels.what = QString::fromUtf8("labels “segmentation.nrrd”");
  labels.isNamed = false;
  labels.isPlaced = true;
  labels.count = labels.unnamed = 12;
  labels.folder = QString::fromStdString(folder().string());
  AddPartsDialog::Part mesh;
  mesh.what = QString::fromUtf8("surface “ossicles.obj”");
  mesh.name = "ossicles";
  mesh.isPlaced = true;
  mesh.objects = 3;
  presenters::InputDevice device;
  device.kind = presenters::InputDevice::Kind::Server;
  device.name = "Touch X";
  device.program = folder() / "server"; // not started here

  for (const QString language : {"en", "de"})
    for (const auto& [scale, text] : {std::pair(1.0, "1"), std::pair(1.25, "1.25")})
    {
      if (!hasLanguage(language))
        continue;
      QTranslator texts;
      if (language != "en")
      {
        ASSERT_TRUE(texts.load(":/translations/petrous_" + language + ".qm"));
        QApplication::installTranslator(&texts);
      }
      std::ofstream(folder() / "settings.conf") << "[look]\nfont_scale=" << text << "\n";
      openWindow();
      ASSERT_EQ(fontScale(), scale);
      const QString large = text; // a binding is not captured
      const auto look = [&](QDialog& dialog, const std::function<bool()>& isComplete)
      {
        dialog.show();
        EXPECT_TRUE(waitFor(isComplete)) << dialog.objectName().toStdString();
        QTest::qWait(50);
        expectWhole(dialog, language + ", " + large + ", dialog “" + dialog.objectName() + "”");
        EXPECT_EQ(sharedMnemonics(dialog), QStringList());
        const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
        if (!pictures.isEmpty())
          dialog.grab().save(QString("%1/%2-%3-%4.png")
                                 .arg(pictures, dialog.metaObject()->className(), language, large));
      };
      const auto atOnce = [] { return true; };
      {
        RegionDialog dialog(whole, {}, false);
        look(dialog, [&] { return dialog.isPictured(); });
      }
      {
        RepairDialog dialog(repaired, "ct");
        look(dialog, [&] { return dialog.isPictured(); });
      }
      {
        SeriesDialog dialog(several, true);
        look(dialog, atOnce);
      }
      {
        AddPartsDialog dialog(AddPartsDialog::tr("Add to the case"), {}, AddPartsDialog::tr("Add"),
                              {mr, labels, mesh}, {"T1"}, {"T1"}, "CT", nullptr,
                              AddPartsDialog::tr("Open as a new case"));
        look(dialog, atOnce);
      }
      {
        presenters::DeviceSources sources;
        sources.limits = folder() / "device-limits.json";
        DeviceTestDialog dialog(sources, device);
        look(dialog, atOnce);
      }
      closeWindow();
      QApplication::removeTranslator(&texts);
    }
}

TEST_F(Manners, NoTextOfAPanelIsCutOffWithLargeLettersInGerman)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  const UsualTheme after;
  QTranslator german;
  ASSERT_TRUE(german.load(":/translations/petrous_de.qm"));
  QApplication::installTranslator(&german);
  saveMany("sixty", 24, 3, true);
  std::ofstream(folder() / "settings.conf") << "[look]\nfont_scale=1.25\n";
  openWindow("sixty");
  ASSERT_EQ(fontScale(), 1.25);
  ASSERT_TRUE(opened("sixty"));
  for (QDockWidget* dock : docks())
  {
    dock->show();
    dock->raise();
    window().resize(1280, 680);
    QTest::qWait(50);
    expectWhole(*dock, dock->objectName());
    dock->hide();
  }
  QApplication::removeTranslator(&german);
}

// On a screen of 1280 x 720 already at 125 %.
TEST_F(Manners, PanelsScrollWhereTheScreenIsLowForTheLetters)
{
  const UsualTheme after;
  saveBall("ball");
  std::ofstream(folder() / "settings.conf") << "[look]\nfont_scale=2\n";
  openWindow("ball");
  ASSERT_EQ(fontScale(), 2.0);
  const int height = window().screen()->availableSize().height();
  if (height >= 1400)
    GTEST_SKIP() << "a high screen";
  for (QDockWidget* dock : docks())
  {
    EXPECT_TRUE(qobject_cast<QScrollArea*>(dock->widget())) << dock->objectName().toStdString();
    EXPECT_LE(dock->widget()->minimumSizeHint().height(), height / 3)
        << dock->objectName().toStdString();
  }
}

TEST_F(Manners, TabGoesThroughAllOfAPanel)
{
  saveMany("sixty", 24, 3, true);
  openWindow("sixty");
  for (QDockWidget* dock : docks())
  {
    SCOPED_TRACE(dock->objectName().toStdString());
    dock->show();
    dock->raise();
    QTest::qWait(10);
    QApplication::setActiveWindow(&window());
    std::set<QWidget*> missed;
    for (QWidget* widget : worked(*dock))
      if (widget->isVisible() && widget->isEnabled() &&
          (widget->focusPolicy() & Qt::TabFocus) == Qt::TabFocus &&
          !qobject_cast<QAbstractButton*>(widget)) // one of a group has the focus
        missed.insert(widget);
    if (missed.empty())
      continue;
    (*missed.begin())->setFocus();
    for (int n = 0; n < 120 && !missed.empty() && QApplication::focusWidget(); ++n)
    {
      QWidget* at = QApplication::focusWidget();
      for (QWidget* above = at; above; above = above->parentWidget())
        missed.erase(above);
      QTest::keyClick(at, Qt::Key_Tab);
    }
    for (QWidget* one : missed)
      ADD_FAILURE() << described(*one).toStdString() << " is not reached";
    dock->hide();
  }
}

// Around the whole window by Tab: each stop looks different with the focus and without it.
TEST_F(Manners, EachStopOfTabShowsThatItHasTheFocus)
{
  saveBall("ball");
  openWindow("ball");
  EXPECT_TRUE(waitFor([this] { return window().model().ready(); }));
  picture(); // the view at rest
  QApplication::setActiveWindow(&window());
  view().setFocus(Qt::OtherFocusReason);
  std::set<QWidget*> seen;
  std::set<QString> names;
  for (int n = 0; n < 200 && QApplication::focusWidget(); ++n)
  {
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
    QWidget* at = QApplication::focusWidget();
    if (!at || !seen.insert(at).second)
      break;
    names.insert(at->objectName());
    const QImage with = at->grab().toImage();
    at->clearFocus();
    EXPECT_TRUE(
        waitFor([&] { return differentPixels(with, at->grab().toImage(), kSmoothing) > 40; }))
        << described(*at).toStdString();
    at->setFocus(Qt::TabFocusReason);
  }
  for (const char* name : {"drillButton", "pointerButton", "wheelButton", "deviceMore",
                           "threeDView", "axialView", "coronalView", "sagittalView"})
    EXPECT_TRUE(names.count(name)) << name << " is not reached";
}
