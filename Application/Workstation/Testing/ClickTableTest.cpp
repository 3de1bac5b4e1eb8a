#include "GuiTest.h"

#include <fstream>

#include <QDockWidget>
#include <QFile>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QStyle>
#include <QStyleOptionViewItem>
#include <QTableWidget>
#include <QTextStream>
#include <QToolButton>
#include <QTreeView>

#include "ColorChooser.h"
#include "ComparisonWindow.h"
#include "ShareController.h"
#include "SliceView.h"
#include "StructuresModel.h"
#include "petrous/Phantom/Phantom.h"
#include "petrous/Phantom/SamplePatient.h"
#include "petrous/Scene/Branches.h"

using namespace petrous;
using namespace petrous::workstation;
namespace fs = std::filesystem;

namespace
{

// The rows of Documentation/clicks.md. A press and its release, a drag, a double click, a key with
// its modifiers and a drop are one event each.
class ClickTable : public GuiTest
{
protected:
  struct Row
  {
    int events = -1; // as documented
    int most = -1;   // that is wanted
  };

  /// `name`: the first cell.
  static Row documented(const QString& name)
  {
    QFile file(PETROUS_CLICK_TABLE);
    EXPECT_TRUE(file.open(QIODevice::ReadOnly | QIODevice::Text));
    QTextStream lines(&file);
    for (QString line = lines.readLine(); !line.isNull(); line = lines.readLine())
    {
      const QStringList cells = line.split('|');
      if (cells.size() > 3 && cells[1].trimmed() == name)
        return {cells[2].trimmed().toInt(), cells[3].trimmed().toInt()};
    }
    ADD_FAILURE() << "no row " << name.toStdString();
    return {};
  }
  void expectAsDocumented(const char* name) const
  {
    const Row row = documented(name);
    std::printf("%-40s %d\n", name, m_events);
    EXPECT_EQ(m_events, row.events) << name;
    EXPECT_LE(row.events, row.most) << name;
  }

  void click(QWidget& widget, const QPoint& at, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    ++m_events;
    QTest::mouseClick(&widget, Qt::LeftButton, modifiers, at);
  }
  void click(QWidget& widget) { click(widget, widget.rect().center()); }
  void key(int code, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    ++m_events;
    QApplication::setActiveWindow(&window());
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus ? focus : &window(), static_cast<Qt::Key>(code), modifiers);
  }
  void dropOne(const fs::path& path)
  {
    ++m_events;
    dropPath(path);
  }
  /// Agrees in the dialog that comes.
  void acceptWithOneClick()
  {
    onDialog(
        [this](QDialog& dialog)
        {
          for (auto* button : dialog.findChildren<QPushButton*>())
            if (button->text().remove('&').startsWith("Add to") && button->isEnabled())
            {
              click(*button);
              return true;
            }
          return false;
        });
  }
  void clickCell(const std::string& part, int column, int fromLeft = -1,
                 Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    const QModelIndex cell = structureCell(part, column);
    structureList().scrollTo(cell);
    const QRect rect = structureList().visualRect(cell);
    click(*structureList().viewport(),
          fromLeft < 0 ? rect.center() : QPoint(rect.left() + fromLeft, rect.center().y()),
          modifiers);
  }
  SliceView& axial() { return *window().findChild<SliceView*>("axialView"); }
  void openBall()
  {
    saveBall("ball");
    openWindow("ball");
    ASSERT_TRUE(waitFor([this] { return window().model().ready(); }));
  }

  int m_events = 0;
};

} // namespace

TEST_F(ClickTable, DicomToBoneLabelsAndMr)
{
  phantom::SampleOptions options;
  options.spacing = 2.5;
  phantom::writeSamplePatient(folder() / "sample", options);
  openWindow();
  dropOne(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const QImage image = picture();
  EXPECT_GT(pixelsUnlikeTheCorner(image), 1000) << "bone is seen";
  expectAsDocumented("DICOM folder to bone in 3D");
  m_events = 0;
  acceptWithOneClick();
  dropOne(folder() / "sample" / "labels.seg.nrrd");
  ASSERT_TRUE(waitFor([this] { return !window().model().value().labels.empty(); }));
  EXPECT_TRUE(settled());
  expectAsDocumented("Labels into the open case");
  m_events = 0;
  acceptWithOneClick();
  dropOne(folder() / "sample" / "mr");
  ASSERT_TRUE(waitFor([this] { return !window().model().value().mr.empty(); }));
  EXPECT_TRUE(settled());
  expectAsDocumented("An MR into the open case");
}

TEST_F(ClickTable, AStructureRecoloured)
{
  openBall();
  clickCell("nerve", 0, 7); // its swatch
  auto* chooser = window().findChild<ColorChooser*>("colorChooser");
  ASSERT_TRUE(chooser);
  const QColor wanted = QColor::fromHsv(180, 200, 240);
  for (auto* cell : chooser->findChildren<QToolButton*>())
    if (cell->property("color").value<QColor>() == wanted)
    {
      click(*cell);
      break;
    }
  const auto color = window().model().value().labels[0].structures[0].look.color;
  EXPECT_NEAR(color[0], wanted.redF(), 0.002);
  EXPECT_NEAR(color[2], wanted.blueF(), 0.002);
  expectAsDocumented("A structure recoloured");
}

TEST_F(ClickTable, OneOfSixtyStructuresAlone)
{
  scene::Case value = ballCase("ball");
  for (std::uint16_t n = 2; n <= 60; ++n)
  {
    scene::StructurePart structure = value.labels[0].structures[0];
    structure.name = "s" + std::to_string(n);
    structure.index = n;
    value.labels[0].structures.push_back(structure);
  }
  library().save(value);
  openWindow("ball");
  clickCell("s33", StructuresModel::columnOf("shown"), -1, Qt::AltModifier);
  int shown = 0;
  for (const auto& structure : window().model().value().labels[0].structures)
    shown += structure.look.shown;
  EXPECT_EQ(shown, 1);
  EXPECT_TRUE(scene::findStructure(window().model().value(), "s33")->look.shown);
  expectAsDocumented("One of 60 structures alone");
}

TEST_F(ClickTable, ADistance)
{
  openBall();
  key(Qt::Key_D, Qt::ShiftModifier);
  click(axial(), axial().rect().center() + QPoint(-30, -10));
  click(axial(), axial().rect().center() + QPoint(20, 15));
  ASSERT_EQ(window().model().value().measurements.size(), 1u);
  expectAsDocumented("A distance measured");
}

TEST_F(ClickTable, AScreenshot)
{
  openBall();
  key(Qt::Key_F12);
  auto* button = window().findChild<QPushButton*>("attachScreenshot");
  ASSERT_TRUE(waitFor([&] { return button->isVisible(); }));
  click(*button);
  ASSERT_TRUE(waitFor([this] { return window().model().value().attachments.size() == 1; }));
  expectAsDocumented("A screenshot kept with the case");
}

TEST_F(ClickTable, ASliceEnlarged)
{
  openBall();
  const QSize before = axial().size();
  ++m_events;
  QTest::mouseDClick(&axial(), Qt::LeftButton, Qt::NoModifier, axial().rect().center());
  EXPECT_GT(axial().width(), 2 * before.width());
  expectAsDocumented("A slice enlarged");
}

TEST_F(ClickTable, AHoleDrilledAndUndone)
{
  openBall();
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle);
  key(Qt::Key_D);
  ++m_events;
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(cuts());
  QTest::qWait(400);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  ASSERT_TRUE(strokeEnds());
  EXPECT_GT(window().model().value().removedVolume(), 0.0);
  key(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([this] { return window().model().value().applied() == 0; }));
  expectAsDocumented("A hole drilled and undone");
}

TEST_F(ClickTable, AnMrRegistered)
{
  const phantom::Phantom ear;
  const auto scan = [&](phantom::Phantom::Modality modality, const core::RigidTransform& motion)
  {
    const Eigen::Vector3d center = motion * phantom::Phantom::center();
    const core::GridGeometry grid({56, 56, 48}, Eigen::Vector3d::Constant(1.1),
                                  center - 0.55 * Eigen::Vector3d(55, 55, 47));
    phantom::ScanSettings settings;
    settings.modality = modality;
    settings.patientFromScan = motion.inverse();
    scene::ImagePart part;
    part.geometry = grid;
    part.volume = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(
            phantom::samplePhantom(ear, grid, settings)));
    part.range = part.volume.get()->range();
    return part;
  };
  scene::Case value;
  value.name = "ear";
  value.ct = scan(phantom::Phantom::Modality::Ct, {});
  value.ct.name = "ct";
  value.mr = {scan(phantom::Phantom::Modality::Mr, ear.mrFromCt())};
  value.mr.front().name = "T2";
  library().save(value);
  openWindow("ear");
  key(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([this] { return window().model().value().mr.front().registered; }, 240000));
  expectAsDocumented("An MR registered");
}

TEST_F(ClickTable, AReportOfThePlan)
{
  openBall();
  ASSERT_TRUE(settled());
  const QString file = QString::fromStdString((folder() / "plan.pdf").string());
  QStringList shown;
  window().findChild<ShareController*>()->openFile = [&shown](const QString& path)
  {
    shown.push_back(path);
    return true;
  };
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "planReport")
          return false;
        EXPECT_TRUE(dialog.findChild<QPushButton*>("primary")->isEnabled()) << "as it comes";
        dialog.findChild<QLineEdit*>("planReportFile")->setText(file); // for the test's own folder
        ++m_events;
        QTest::keyClick(&dialog, Qt::Key_Return);
        return true;
      });
  key(Qt::Key_P, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([&] { return !shown.isEmpty(); }));
  EXPECT_EQ(shown.first(), file);
  EXPECT_TRUE(QFile::exists(file));
  expectAsDocumented("The plan's report written");
}

TEST_F(ClickTable, TwoApproachesCompared)
{
  scene::Case value = ballCase("ball");
  value.dissection = dissection::Dissection(value.ct.geometry);
  const auto drill = [&value](const Eigen::Vector3d& from)
  {
    value.dissection.beginStroke({});
    const Eigen::Vector3d at = kBallCenter + kBallRadius * from.normalized();
    value.dissection.cut({at, at, 3.0});
    value.dissection.endStroke();
  };
  drill({0, -1, 0});
  drill({1, -1, 0});
  scene::startBranch(value, "above", 1);
  drill({0, -1, 1});
  library().save(value);
  openWindow("ball");
  ASSERT_TRUE(waitFor([this] { return window().model().ready(); }));
  const auto comparison = [this] { return window().findChild<ComparisonWindow*>("comparison"); };
  key(Qt::Key_D, Qt::ControlModifier);
  ASSERT_TRUE(comparison());
  ASSERT_TRUE(waitFor([&] { return comparison()->table().rowCount() > 0; }));
  expectAsDocumented("Two approaches compared");
  QTest::keyClick(comparison(), Qt::Key_Escape);
  EXPECT_TRUE(waitFor([&] { return !comparison(); }));
}
