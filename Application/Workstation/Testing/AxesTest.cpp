#include "GuiTest.h"

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QTreeView>

#include "AxesDialog.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Placement.h"

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

// An MR from the menu and a structure from the list, undone one after the other.
TEST_F(Axes, OfPartsOfTheOpenCaseAreCorrectedInItAndUndone)
{
  scene::Case ball = ballCase("ear");
  scene::ImagePart mr = ball.ct;
  mr.name = "T2";
  ball.mr = {mr};
  scene::applyRegistration(ball, "T2", {}, {});
  library().save(ball);
  openWindow("ear");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const presenters::WorkstationModel& model = window().model();
  const auto answer = [this](const char* button, const char* told, const char* kind)
  {
    onDialog(
        [button, told, kind](QDialog& dialog)
        {
          if (dialog.objectName() != "correctAxes")
            return false;
          EXPECT_EQ(dialog.findChild<QLabel*>("axesLeftBehind")->text(), told);
          dialog.findChild<QPushButton*>(button)->click();
          EXPECT_EQ(dialog.findChild<QLabel*>("axesKind")->text(), kind);
          auto* apply = dialog.findChild<QPushButton*>("primary");
          EXPECT_TRUE(apply->isEnabled());
          EXPECT_EQ(sharedMnemonics(dialog), QStringList());
          apply->click();
          return true;
        });
  };
  answer("axesHeadFeet", "Is to be registered again: T2",
         "The anatomy is mirrored: a left ear becomes a right one.");
  // The menu is filled when it is shown.
  auto* menu = qobject_cast<QMenu*>(action("Correct the axes…")->associatedWidgets().value(0));
  ASSERT_TRUE(menu);
  emit menu->aboutToShow();
  action("Correct the axes of the MR “T2”…")->trigger();
  ASSERT_TRUE(waitFor([&] { return !model.value().mr[0].provenance.axes.isIdentity(); }));
  EXPECT_EQ(model.value().mr[0].provenance.axes.letters(), "LPI");
  EXPECT_FALSE(model.value().mr[0].registered);
  EXPECT_TRUE(model.value().ct.provenance.axes.isIdentity());

  answer("axesMirror", "", "It is mirrored. The image on which it lies stays as it is.");
  structureList().setCurrentIndex(structureCell("nerve"));
  structureList().findChild<QAction*>("axesOfPart")->trigger();
  ASSERT_TRUE(waitFor([&] { return !model.value().labels[0].provenance.axes.isIdentity(); }));
  EXPECT_EQ(model.value().labels[0].provenance.axes.letters(), "RPS");
  ASSERT_TRUE(waitFor([this] { return !window().busy() && !window().model().unsaved(); }));
  const scene::Case saved = library().open("ear");
  EXPECT_EQ(saved.labels[0].provenance.axes.letters(), "RPS");
  EXPECT_EQ(saved.mr[0].provenance.axes.letters(), "LPI");

  EXPECT_EQ(model.undoText(), "axes of nerve");
  action("Undo")->trigger();
  EXPECT_TRUE(model.value().labels[0].provenance.axes.isIdentity());
  action("Undo")->trigger();
  EXPECT_TRUE(model.value().mr[0].provenance.axes.isIdentity());
  EXPECT_TRUE(model.value().mr[0].registered);
  EXPECT_TRUE(core::sameGrid(model.value().mr[0].geometry, mr.geometry));
}
