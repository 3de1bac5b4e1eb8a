#include "GuiTest.h"

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QPushButton>

#include "AxesDialog.h"

using namespace petrous;
using namespace petrous::workstation;
using Axes = GuiTest;

namespace
{

QString lettersOf(const QDialog& dialog)
{
  QString letters;
  for (const char* name : {"axesLeft", "axesBack", "axesHead"})
    letters += dialog.findChild<QComboBox*>(name)->currentData().toChar();
  return letters;
}

} // namespace

TEST_F(Axes, OfTheOpenCaseAreCorrectedInAnotherOne)
{
  scene::Case ball = ballCase("ear");
  ball.description.side = scene::Side::Left;
  library().save(ball);
  openWindow("ear");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const core::GridGeometry stated = window().model().value().ct.geometry;
  bool isAsked = false;
  onDialog(
      [&isAsked](QDialog& dialog)
      {
        if (dialog.objectName() != "correctAxes")
          return false;
        isAsked = true;
        const auto& axes = dynamic_cast<AxesDialog&>(dialog);
        auto* apply = dialog.findChild<QPushButton*>("primary");
        EXPECT_EQ(lettersOf(dialog), "LPS");
        EXPECT_FALSE(apply->isEnabled()) << "nothing is corrected yet";
        // What is left is head: the one that was head takes what was left.
        auto* left = dialog.findChild<QComboBox*>("axesLeft");
        left->setCurrentIndex(left->findData(QChar('I')));
        EXPECT_EQ(lettersOf(dialog), "IPL") << "a permutation in any case";
        left->setCurrentIndex(left->findData(QChar('L')));
        EXPECT_EQ(lettersOf(dialog), "LPI");
        dialog.findChild<QPushButton*>("axesHeadFeet")->click();
        EXPECT_EQ(lettersOf(dialog), "LPS");
        dialog.findChild<QPushButton*>("axesTurn")->click();
        EXPECT_EQ(lettersOf(dialog), "RAS");
        dialog.findChild<QPushButton*>("axesTurn")->click();
        dialog.findChild<QPushButton*>("axesMirror")->click();
        EXPECT_EQ(lettersOf(dialog), "RPS");
        EXPECT_EQ(axes.axes().letters(), "RPS");
        EXPECT_TRUE(apply->isEnabled());
        EXPECT_TRUE(dialog.findChild<QLabel*>("axesLeftBehind"));
        apply->click();
        return true;
      });
  action("Correct the axes…")->trigger();
  const std::string name = "ear (axes corrected)";
  ASSERT_TRUE(waitFor(
      [&]
      {
        return window().model().hasCase() && window().model().value().name == name &&
               !window().busy() && !window().model().unsaved();
      }));
  EXPECT_TRUE(isAsked);
  const scene::Case& value = window().model().value();
  EXPECT_EQ(value.ct.provenance.axes.letters(), "RPS");
  const Eigen::Vector3d byFile = stated.patientFromVoxel({1, 2, 3}) - stated.center();
  EXPECT_LT((value.ct.geometry.patientFromVoxel({1, 2, 3}) - stated.center() -
             Eigen::Vector3d(-byFile[0], byFile[1], byFile[2]))
                .norm(),
            1e-6);
  EXPECT_EQ(value.description.side, scene::Side::Unknown);
  ASSERT_EQ(value.labels.size(), ball.labels.size());
  ASSERT_TRUE(waitFor([&] { return library().contains(name); }));
  const scene::Case before = library().open("ear");
  EXPECT_TRUE(before.ct.provenance.axes.isIdentity());
  EXPECT_EQ(before.description.side, scene::Side::Left);
}
