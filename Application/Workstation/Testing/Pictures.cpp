// Not tests: they drive the window and keep pictures of it. Documentation/pictures/window makes
// their library and runs them.
#include "GuiTest.h"

#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QScreen>
#include <QStatusBar>
#include <QTableView>
#include <QTreeView>
#include <QTreeWidget>

#include "SceneDisplay.h"
#include "SliceView.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "petrous/Library/PseudonymMap.h"
#include "petrous/Network/NodeList.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class DISABLED_Pictures : public GuiTest
{
protected:
  void SetUp() override
  {
    ASSERT_FALSE(qEnvironmentVariable("PETROUS_GUI_FOLDER").isEmpty()) << "run the script";
  }
  static QSize sizeOr(const QSize& usual)
  {
    const QStringList set = qEnvironmentVariable("PETROUS_PICTURE_SIZE").split('x');
    return set.size() == 2 ? QSize(set[0].toInt(), set[1].toInt()) : usual;
  }
  static QString fileOf(const char* name)
  {
    return QString("%1/%2.png").arg(qEnvironmentVariable("PETROUS_PICTURES", "."), name);
  }
  void open(const char* name, const QSize& size)
  {
    openWindow(name);
    window().resize(sizeOr(size));
    ASSERT_TRUE(waitFor([&] { return window().model().ready() && window().model().drawable(); }));
  }
  void raise(const char* dock)
  {
    auto* widget = window().findChild<QDockWidget*>(dock);
    widget->show();
    widget->raise();
  }
  presenters::WorkstationModel& model()
  {
    return const_cast<presenters::WorkstationModel&>(window().model());
  }
  /// Clicks in the axial slice, once the crosshair is there; patient LPS, mm.
  void click(const Eigen::Vector3d& point)
  {
    model().setCrosshair(point);
    auto* slice = window().findChild<SliceView*>("axialView");
    const Eigen::Vector2d at = slice->slice().pixelFromPatient(point) + Eigen::Vector2d(0.5, 0.5);
    QTest::mouseClick(slice, Qt::LeftButton, Qt::NoModifier,
                      {static_cast<int>(at[0]), static_cast<int>(at[1])});
  }
  void keep(const char* name)
  {
    leave();
    window().statusBar()->clearMessage();
    QTest::qWait(1500); // fine rendering starts 300 ms after the last motion
    EXPECT_TRUE(waitFor([this] { return !window().model().hasCase() || view().display().isFine(); },
                        60000));
    QTest::qWait(500); // the speed is told of what rests
    EXPECT_TRUE(window().screen()->grabWindow(window().winId()).save(fileOf(name)));
  }
  /// Of a dialog that the menu's entry opens, once `prepare` has filled it.
  void keepDialog(const char* entry, const char* object, const char* name,
                  const std::function<void(QDialog&)>& prepare = {})
  {
    bool kept = false;
    onDialog(
        [&](QDialog& dialog)
        {
          if (dialog.objectName() != object)
            return false;
          if (prepare)
            prepare(dialog);
          QTest::qWait(200);
          kept = dialog.grab().save(fileOf(name));
          dialog.reject();
          return true;
        });
    window().findChild<QAction*>(entry)->trigger();
    EXPECT_TRUE(kept) << name;
  }
};

} // namespace

TEST_F(DISABLED_Pictures, Workstation)
{
  open("sample patient", {1600, 1000});
  raise("structuresDock");
  keep("workstation");
}

TEST_F(DISABLED_Pictures, Structures)
{
  open("cochlear implant", {1600, 1000});
  raise("structuresDock");
  structureList().setCurrentIndex(structureCell("sigmoid_sinus"));
  keep("structures");
}

TEST_F(DISABLED_Pictures, Views)
{
  open("sample patient", {1600, 1000});
  for (const char* dock : {"structuresDock", "pictureDock"})
    window().findChild<QDockWidget*>(dock)->hide();
  model().setCrosshair({-41.8, -2.1, 4.1});
  action("Four up")->trigger();
  action(QString::fromUtf8("Pöschl and Stenvers planes"))->trigger();
  keep("views");
}

TEST_F(DISABLED_Pictures, Measure)
{
  open("cochlear implant", {1600, 1000});
  raise("measureDock");
  action("One slice large")->trigger();
  QTest::keyClick(&window(), Qt::Key_D, Qt::ShiftModifier);
  click({-47.5, 4.0, 2.0});
  click({-41.5, 1.0, 2.0});
  QTest::keyClick(&window(), Qt::Key_A, Qt::ShiftModifier);
  click({-50.0, 14.0, 2.0});
  click({-44.0, 8.5, 2.0});
  click({-36.0, 12.0, 2.0});
  QTest::keyClick(&window(), Qt::Key_Escape);
  auto* structure = window().findChild<QComboBox*>("measureStructure");
  structure->setCurrentIndex(std::max(structure->findText("internal auditory canal"), 0));
  window().findChild<QPushButton*>("measureStructureNow")->click();
  EXPECT_TRUE(waitFor(
      [&]
      { return window().findChild<QTreeWidget*>("measureQuantities")->topLevelItemCount() > 0; }));
  keep("measure");
}

TEST_F(DISABLED_Pictures, Segment)
{
  open("new scan", {1600, 1000});
  raise("segmentDock");
  QTest::keyClick(&window(), Qt::Key_N, Qt::ShiftModifier);
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(-41.8, -2.1, 4.1), Eigen::Vector3d(-44.8, 3.2, 2.1),
        Eigen::Vector3d(-45.5, 4.7, 0.2), Eigen::Vector3d(-46.0, 5.4, -4.0),
        Eigen::Vector3d(-46.6, 6.0, -10.0)})
    click(point);
  auto* points = window().findChild<QTreeWidget*>("nervePoints");
  ASSERT_TRUE(waitFor([&] { return points->topLevelItem(0)->text(1).contains("mm"); }));
  QTest::keyClicks(window().findChild<QLineEdit*>("segmentName"), "facial nerve");
  points->setCurrentItem(points->topLevelItem(3));
  action("Zoom slices together")->trigger();
  for (int n = 0; n < 6; ++n)
    QTest::keyClick(window().findChild<SliceView*>("axialView"), Qt::Key_Plus);
  keep("segment-nerve");
}

TEST_F(DISABLED_Pictures, Drilling)
{
  open("petrous apex", {1600, 1000});
  raise("nearbyDock");
  model().setCrosshair({-62.0, 14.0, 2.0}); // on the mastoid
  action("Surgical position, right ear")->trigger();
  action("Centre on the crosshair")->trigger();
  drill(2500, 40);
  const auto* near = window().findChild<QDockWidget*>("nearbyDock")->findChild<QTreeView*>();
  EXPECT_TRUE(waitFor([near] { return near->model()->rowCount() > 0; }));
  QTest::qWait(500); // the picture is fine, and the burr still over it
  EXPECT_TRUE(window().screen()->grabWindow(window().winId()).save(fileOf("drilling")));
}

TEST_F(DISABLED_Pictures, Series)
{
  openWindow();
  window().resize(sizeOr({1600, 1000}));
  bool kept = false;
  onDialog(
      [&](QDialog& dialog)
      {
        auto* list = dialog.findChild<QTreeWidget*>("series");
        if (!list)
          return false;
        QTest::qWait(200);
        kept = dialog.grab().save(fileOf("series"));
        dialog.reject();
        return true;
      });
  dropPath(folder() / "visit");
  EXPECT_TRUE(waitFor([&] { return kept; }));
}

TEST_F(DISABLED_Pictures, Appearance)
{
  open("sample patient", {1600, 1000});
  raise("appearanceDock");
  auto* part = window().findChild<QComboBox*>("appearancePart");
  const int row = std::max(part->findText("sigmoid sinus"), 0);
  part->setCurrentIndex(row);
  emit part->activated(row);
  QTest::qWait(1000); // the histograms are counted
  keep("appearance");
}

TEST_F(DISABLED_Pictures, Registration)
{
  open("with an MR", {1600, 1000});
  raise("registrationDock");
  action("Register the MR")->trigger();
  ASSERT_TRUE(waitFor([&] { return window().model().value().mr.at(0).registered; }, 280000));
  for (auto* box : window().findChildren<QComboBox*>())
    if (const int row = box->findText("CT's edges over the MR"); row >= 0)
    {
      box->setCurrentIndex(row);
      emit box->activated(row);
    }
  // The estimate of the error follows the fit.
  EXPECT_TRUE(waitFor(
      [&]
      {
        const auto& how = window().model().value().mr.at(0).registration;
        return how && how->error && !window().busy();
      },
      200000));
  keep("registration");
}

TEST_F(DISABLED_Pictures, Library)
{
  open("sample patient", {1280, 720});
  raise("libraryDock");
  window().findChild<QTreeView*>("cases")->setFocus();
  keep("library");
}

TEST_F(DISABLED_Pictures, FirstPage)
{
  open("sample patient", {1280, 720});
  for (const char* dock : {"structuresDock", "pictureDock", "libraryDock"})
    window().findChild<QDockWidget*>(dock)->hide();
  action("Close the case")->trigger();
  keep("first-page");
}

TEST_F(DISABLED_Pictures, Dialogs)
{
  network::Node node;
  node.name = "radiology";
  node.host = "pacs.hospital.example";
  node.port = 2762;
  node.aeTitle = "ARCHIVE";
  node.callingAeTitle = "EAR_OR_2";
  node.tls = network::TlsFiles{"/etc/petrous/hospital-ca.pem", "/etc/petrous/ear-or-2.pem",
                               "/etc/petrous/ear-or-2.key"};
  network::NodeList nodes(folder() / "library");
  const auto before = nodes.nodes();
  for (const network::Node& old : before)
    nodes.remove(old.name);
  nodes.add(node);
  const auto map = folder() / "map";
  std::filesystem::remove(map);
  {
    library::PseudonymMap made(map, "one long passphrase", {1, 1 << 16});
    made.add({{"patient", "P-7d1f0c94a2b3", "4711 Doe^Jane"},
              {"patient", "P-01be5577d0e8", "4712 Roe^Richard"},
              {"study", "2.25.171663044211409934129038211875601735", "1.2.840.99999.1.4711.1"},
              {"study", "2.25.309176432118823764510986712093445201", "1.2.840.99999.1.4712.1"},
              {"series", "2.25.88123765120937465510982736455102938", "1.2.840.99999.1.4711.1.3"}});
    made.save();
  }
  open("sample patient", {1280, 720});
  keepDialog("editNodes", "nodes", "nodes",
             [](QDialog& dialog) { dialog.findChild<QListWidget*>()->setCurrentRow(0); });
  keepDialog("sendOpenCase", "sendCase", "send");
  keepDialog("receiveCase", "receive", "receive");
  keepDialog("pseudonyms", "pseudonyms", "pseudonyms",
             [&](QDialog& dialog)
             {
               EXPECT_TRUE(dialog.grab().save(fileOf("pseudonyms-locked")));
               dialog.findChild<QLineEdit*>("pseudonymsFile")
                   ->setText(QString::fromStdString(map.string()));
               dialog.findChild<QLineEdit*>("pseudonymsPassphrase")->setText("one long passphrase");
               dialog.findChild<QPushButton*>("primary")->click();
               auto* table = dialog.findChild<QTableView*>("pseudonymsTable");
               EXPECT_TRUE(waitFor([&] { return table->model()->rowCount() == 5; }));
             });
  action("Archive…")->setObjectName("archive");
  keepDialog("archive", "archiveCase", "archive",
             [](QDialog& dialog)
             { dialog.findChild<QLineEdit*>("archiveFile")->setText("/home/ear/ear.petrous"); });
}
