#include "DeviceTest.h"

#include <cmath>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>

#include "DrillController.h"

using namespace petrous;
using namespace petrous::workstation;
using Eigen::Vector3d;

namespace
{

class Pointer : public DeviceTest
{
protected:
  void pointAt(const QPoint& pixel)
  {
    QTest::mouseMove(&view(), pixel + QPoint(3, 0));
    QTest::mouseMove(&view(), pixel);
  }

  // The slices follow it.
  Vector3d tip() { return window().model().crosshair(); }

  // Output of the command for the same point.
  QJsonObject probed(const Vector3d& place)
  {
    const auto file = folder() / "points.csv";
    std::ofstream points(file);
    points.precision(17);
    points << "x_mm,y_mm,z_mm\n" << place.x() << "," << place.y() << "," << place.z() << "\n";
    points.close();
    QProcess command;
    command.start(PETROUS_COMMAND,
                  {"probe", "ball", "--points", QString::fromStdString(file.string()), "--library",
                   QString::fromStdString((folder() / "library").string()), "--json"});
    EXPECT_TRUE(command.waitForFinished(60000));
    const QByteArray out = command.readAllStandardOutput();
    return QJsonDocument::fromJson(out).object()["points"].toArray()[0].toObject();
  }
};

} // namespace

TEST_F(Pointer, ReadsAtItsTipWhatTheCommandReadsThere)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_P);
  EXPECT_TRUE(action("Pointer")->isChecked());
  for (const QPoint aside : {QPoint(0, 0), QPoint(60, -40), QPoint(-90, 30)})
  {
    pointAt(view().rect().center() + aside);
    ASSERT_TRUE(hasTool());
    ASSERT_TRUE(waitFor([this] { return !view().display().reading().isEmpty(); }));
    QTest::qWait(1500); // until it is at rest, and half a second more
    const QStringList read = view().display().reading().split('\n');
    const QJsonObject truth = probed(tip());
    ASSERT_TRUE(truth.contains("hu"));
    EXPECT_EQ(read.front(), QString("%1 HU").arg(std::lround(truth["hu"].toDouble())));
    ASSERT_EQ(read.size(), 3);
    EXPECT_TRUE(read[2].endsWith(" mm to nerve")) << read[2].toStdString();
    EXPECT_NEAR(read[2].split(' ').front().toDouble(), (tip() - kBallCenter).norm() - 4.0, 0.3);
    EXPECT_EQ(read[1],
              QString("%1 mm to the surface").arg(truth["distance_mm"].toDouble(), 0, 'f', 1));
    EXPECT_LT(std::abs(truth["distance_mm"].toDouble()), 0.5) << "it touches";
  }
  picture();
}

TEST_F(Pointer, ModelAndCommandAgreeAtAnyPlace)
{
  saveBall("ball");
  openWindow();
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  for (const Vector3d& offset :
       {Vector3d(0.0, 0.0, 0.0), Vector3d(3.0, 1.0, -2.0), Vector3d(6.0, -7.0, 2.0),
        Vector3d(10.0, 9.0, -3.0), Vector3d(200.0, 0.0, 0.0)})
  {
    const Vector3d place = kBallCenter + offset;
    const presenters::PlaceReading reading = model.readPlace(place);
    const QJsonObject truth = probed(place);
    EXPECT_EQ(reading.structure, truth["structure"].toString().toStdString());
    ASSERT_EQ(reading.hounsfield.has_value(), truth["hu"].isDouble()) << offset.transpose();
    if (reading.hounsfield)
    {
      EXPECT_NEAR(*reading.hounsfield, truth["hu"].toDouble(), 1e-6);
    }
    ASSERT_EQ(reading.surface.has_value(), truth["distance_mm"].isDouble()) << offset.transpose();
    if (reading.surface)
    {
      EXPECT_NEAR(*reading.surface, truth["distance_mm"].toDouble(), 1e-9);
      EXPECT_NEAR(*reading.surface, offset.norm() - kBallRadius, 0.1); // the sphere itself
    }
  }
  EXPECT_EQ(model.readPlace(kBallCenter).structure, "nerve");
}

TEST_F(Pointer, CutsNothingWhateverAsksForTheDrill)
{
  saveBall("ball");
  bench.play(std::string(kPlugFoot) + kPlugCap);
  openWindow();
  choose("SpaceMouse Compact");
  QTest::keyClick(&view(), Qt::Key_P);
  ASSERT_TRUE(hasTool());
  bench.play("await foot\nreport foot 02 00\n");
  QTest::keyPress(&view(), Qt::Key_Space);
  const Vector3d begin = tool();
  ASSERT_TRUE(holdCapUntil(capHeld(0, -350, 0, 1),
                           [&] { return (tool() - kBallCenter).norm() < kBallRadius + 0.7; }));
  for (int n = 0; n < 8; ++n)
  {
    bench.play(capHeld(0, -350, 0, 1));
    QTest::qWait(110);
  }
  EXPECT_NE(begin, tool());
  QTest::keyRelease(&view(), Qt::Key_Space);
  QTest::keyClick(&view(), Qt::Key_P);
  EXPECT_TRUE(window().model().value().dissection.mask().untouched());
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
  EXPECT_TRUE(view().display().reading().isEmpty());
}

TEST_F(Pointer, OneToolIsInTheHand)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_P);
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_TRUE(action("Drill")->isChecked());
  EXPECT_FALSE(action("Pointer")->isChecked());
  QTest::keyClick(&view(), Qt::Key_P);
  EXPECT_FALSE(action("Drill")->isChecked());
  EXPECT_TRUE(action("Pointer")->isChecked());
  // The left button rotates the patient, as without a tool.
  const auto before = view().picture().camera().position;
  const QPoint middle = view().rect().center();
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  QMouseEvent move(QEvent::MouseMove, middle + QPoint(40, 0), Qt::LeftButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&view(), &move);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle + QPoint(40, 0));
  EXPECT_NE(view().picture().camera().position, before);
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
}
