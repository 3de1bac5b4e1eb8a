#include <filesystem>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>

#include "CatalogueDialog.h"
#include "GuiTest.h"
#include "petrous/Dissection/Catalogues.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class CatalogueDialogs : public GuiTest
{
protected:
  CatalogueDialog& dialog()
  {
    action(QString::fromUtf8("Materials and burrs…"))->trigger();
    return *window().findChild<CatalogueDialog*>();
  }
  static QTableWidget& table(QWidget& within, const char* name)
  {
    return *within.findChild<QTableWidget*>(name);
  }
  dissection::Catalogues read() const { return dissection::Catalogues::in(folder() / "library"); }
};

} // namespace

TEST_F(CatalogueDialogs, AMaterialThatIsAddedIsSavedAndOfferedToStructures)
{
  saveBall("ball");
  openWindow("ball");
  auto& choice = *window().findChild<QComboBox*>("structureMaterial");
  const int before = choice.count();
  auto& edit = dialog();
  auto& materials = table(edit, "materials");
  const int row = materials.rowCount();
  materials.selectRow(0);
  edit.findChild<QPushButton*>("addMaterial")->click();
  ASSERT_EQ(materials.rowCount(), row + 1);
  materials.item(row, 0)->setText("sclerotic-bone");
  materials.item(row, 1)->setText("Sclerotic bone");
  materials.item(row, 4)->setText("60");
  EXPECT_FALSE(edit.findChild<QLabel*>("catalogueFault")->isVisible());
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_NEAR(read().materials.material("sclerotic-bone").hardness, 60.0 * 9.807e6, 1.0);
  EXPECT_EQ(choice.count(), before + 1);
  EXPECT_GE(choice.findText("Sclerotic bone"), 0);
}

TEST_F(CatalogueDialogs, WhatTheLawsDoNotAllowIsToldAndNotTaken)
{
  saveBall("ball");
  openWindow("ball");
  auto& edit = dialog();
  auto& materials = table(edit, "materials");
  const QString hardness = materials.item(0, 4)->text();
  for (const char* wrong : {"-3", "hard", ""})
  {
    materials.item(0, 4)->setText(wrong);
    EXPECT_EQ(materials.item(0, 4)->text(), hardness) << wrong;
    EXPECT_TRUE(edit.findChild<QLabel*>("catalogueFault")->isVisible()) << wrong;
  }
  EXPECT_FALSE(materials.item(0, 0)->flags() & Qt::ItemIsEditable) << "presets give it";
  EXPECT_FALSE(edit.findChild<QPushButton*>("removeMaterial")->isEnabled());
  auto& burrs = table(edit, "burrs");
  burrs.item(0, 1)->setText("70");
  EXPECT_TRUE(edit.findChild<QLabel*>("catalogueFault")->isVisible());
  edit.reject();
  EXPECT_FALSE(std::filesystem::exists(folder() / "library" / "materials.json"));
}

TEST_F(CatalogueDialogs, DiametersComeToTheDrillBarAndGoBackWithTheProgramsOwn)
{
  saveBall("ball");
  openWindow("ball");
  auto& edit = dialog();
  auto& burrs = table(edit, "burrs");
  burrs.item(0, 3)->setText("0.6, 2.3");
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_EQ(read().burrs.model(dissection::Burr::Kind::Cutting).diameters,
            (std::vector<double>{0.6, 2.3}));
  EXPECT_DOUBLE_EQ(window().findChild<QDoubleSpinBox*>("burrDiameter")->value(), 2.3);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  auto& again = dialog();
  again.findChild<QPushButton*>("catalogueBuiltIn")->click();
  again.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_FALSE(std::filesystem::exists(folder() / "library" / "burrs.json"));
}
