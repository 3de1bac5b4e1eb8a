#include <filesystem>
#include <fstream>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStatusBar>
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
  static bool isShown(QWidget& within, const char* label)
  {
    return within.findChild<QLabel*>(label)->isVisible();
  }
  dissection::Catalogues read() const { return dissection::Catalogues::in(folder() / "library"); }
  std::filesystem::path materialsFile() const { return folder() / "library" / "materials.json"; }

  /// Cortical bone under that name in the library.
  void saveOwn(const std::string& name)
  {
    presenters::CatalogueEditor editor(folder() / "library");
    const std::size_t row = editor.addMaterial(0);
    auto own = editor.materials()[row];
    own.name = name;
    editor.setMaterial(row, own);
    editor.save();
  }

  /// Opens the editor of a cell of materials; what it shows is `text` then.
  static QLineEdit& typed(QTableWidget& materials, int row, int column, const QString& text)
  {
    materials.setCurrentCell(row, column);
    materials.editItem(materials.item(row, column));
    auto& line = *materials.findChildren<QLineEdit*>().last(); // closed ones are deleted later
    line.setText(text);
    return line;
  }
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
  for (const int column : {5, 6}) // certainty and source
    EXPECT_EQ(materials.item(row, column)->text(), "not stated") << column;
  materials.item(row, 0)->setText("sclerotic-bone");
  materials.item(row, 1)->setText("Sclerotic bone");
  materials.item(row, 4)->setText("60");
  EXPECT_FALSE(edit.findChild<QLabel*>("catalogueFault")->isVisible());
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_NEAR(read().materials.material("sclerotic-bone").hardness, 60.0 * 9.807e6, 1.0);
  EXPECT_EQ(read().materials.material("sclerotic-bone").status, "") << "which nobody entered";
  EXPECT_EQ(choice.count(), before + 1);
  EXPECT_GE(choice.findText("Sclerotic bone"), 0);
}

TEST_F(CatalogueDialogs, ANumberThatIsTypedOverHasNoSourceBeforeOneIsEntered)
{
  saveBall("ball");
  openWindow("ball");
  auto& edit = dialog();
  auto& materials = table(edit, "materials");
  const QString stated = materials.item(0, 6)->text();
  ASSERT_NE(stated, "not stated");
  materials.item(0, 4)->setText("-3"); // refused: what was stated stays
  EXPECT_EQ(materials.item(0, 6)->text(), stated);
  materials.item(0, 4)->setText("45");
  for (const int column : {5, 6}) // certainty and source
    EXPECT_EQ(materials.item(0, column)->text(), "not stated") << column;
  materials.item(0, 6)->setText("our own indenter");
  EXPECT_EQ(materials.item(0, 6)->text(), "our own indenter");
  EXPECT_EQ(materials.item(0, 4)->text(), "45");
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_EQ(read().materials.material("cortical-bone").status, "our own indenter");
  EXPECT_EQ(read().materials.material("cortical-bone").certainty, "");
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
  materials.item(0, 2)->setText("-3");
  EXPECT_EQ(edit.findChild<QLabel*>("catalogueFault")->text(),
            QString::fromUtf8("“Cortical bone”, Cutting energy, GPa: must lie above 0 GPa, it is "
                              "-3."));
  EXPECT_FALSE(materials.item(0, 0)->flags() & Qt::ItemIsEditable) << "presets give it";
  EXPECT_FALSE(edit.findChild<QPushButton*>("removeMaterial")->isEnabled());
  auto& burrs = table(edit, "burrs");
  burrs.item(0, 2)->setText("70");
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
  burrs.item(0, 5)->setText("0.6, 2.3");
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_EQ(read().burrs.model(dissection::Burr::Kind::Cutting).diameters,
            (std::vector<double>{0.6, 2.3}));
  EXPECT_DOUBLE_EQ(window().findChild<QDoubleSpinBox*>("burrDiameter")->value(), 2.3);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  auto& again = dialog();
  again.findChild<QPushButton*>("catalogueBuiltIn")->click();
  again.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_FALSE(std::filesystem::exists(folder() / "library" / "burrs.json"));
  EXPECT_DOUBLE_EQ(window().findChild<QDoubleSpinBox*>("burrDiameter")->value(), 4.0)
      << "nobody chose another one";
}

TEST_F(CatalogueDialogs, ABurrThatIsAddedIsOfferedAndDrillsUnderItsName)
{
  saveBall("ball");
  openWindow("ball");
  auto& choice = *window().findChild<QComboBox*>("burrKind");
  const int builtIn = choice.count();
  ASSERT_GT(builtIn, 2);
  {
    auto& edit = dialog();
    auto& burrs = table(edit, "burrs");
    auto& remove = *edit.findChild<QPushButton*>("removeBurr");
    burrs.selectRow(1);
    EXPECT_FALSE(remove.isEnabled());
    EXPECT_FALSE(burrs.item(1, 0)->flags() & Qt::ItemIsEditable);
    edit.findChild<QPushButton*>("addBurr")->click();
    ASSERT_EQ(burrs.rowCount(), builtIn + 1);
    EXPECT_EQ(burrs.item(builtIn, 0)->text(), "diamond-2");
    EXPECT_TRUE(remove.isEnabled());
    burrs.item(builtIn, 0)->setText("Coarse");
    EXPECT_TRUE(isShown(edit, "catalogueFault"));
    EXPECT_EQ(burrs.item(builtIn, 0)->text(), "diamond-2");
    burrs.item(builtIn, 0)->setText("coarse-diamond");
    EXPECT_EQ(burrs.item(builtIn, 3)->text(), QString::fromUtf8("–")) << "of no stated grit";
    burrs.item(builtIn, 3)->setText("181");
    burrs.item(builtIn, 4)->setText("0.2");
    burrs.item(builtIn, 5)->setText("3, 5");
    burrs.item(builtIn, 6)->setText("measured");
    EXPECT_FALSE(isShown(edit, "catalogueFault"));
    edit.findChild<QPushButton*>("catalogueSave")->click();
  }
  EXPECT_DOUBLE_EQ(read().burrs.model("coarse-diamond").wearCoefficient, 0.2);
  EXPECT_DOUBLE_EQ(read().burrs.model("coarse-diamond").grit, 181.0);
  EXPECT_EQ(read().burrs.model("coarse-diamond").certainty, "measured");
  EXPECT_EQ(choice.currentText(), "Cutting") << "stays";
  choice.setCurrentIndex(choice.findText("coarse-diamond"));
  EXPECT_EQ(window().findChild<QDoubleSpinBox*>("burrDiameter")->value(), 3.0) << "of 4 mm before";
  drill(600, 20);
  const auto& strokes = window().model().value().dissection.strokes();
  ASSERT_EQ(strokes.size(), 1u);
  EXPECT_EQ(strokes[0]->info.burr.name, "coarse-diamond");
  EXPECT_EQ(strokes[0]->info.burr.kind, dissection::Burr::Kind::Diamond);

  // Taken out while it is selected: the usual one of its kind, and the stroke keeps its name.
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  auto& edit = dialog();
  table(edit, "burrs").selectRow(builtIn);
  EXPECT_FALSE(isShown(edit, "catalogueLost"));
  edit.findChild<QPushButton*>("removeBurr")->click();
  EXPECT_TRUE(isShown(edit, "catalogueLost"));
  EXPECT_TRUE(edit.findChild<QLabel*>("catalogueLost")->text().contains("coarse-diamond"));
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_EQ(choice.count(), builtIn);
  EXPECT_EQ(choice.currentText(), "Diamond");
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("coarse-diamond"))
      << window().statusBar()->currentMessage().toStdString();
  EXPECT_EQ(window().model().value().dissection.strokes()[0]->info.burr.name, "coarse-diamond");
}

// Column by column, in the window as in the files.
TEST_F(CatalogueDialogs, EveryBuiltInRowShowsHowCertainItIsAndItsSource)
{
  saveBall("ball");
  openWindow("ball");
  auto& edit = dialog();
  for (const char* name : {"materials", "burrs"})
  {
    auto& rows = table(edit, name);
    const int certainty = rows.columnCount() - 2;
    EXPECT_EQ(rows.horizontalHeaderItem(certainty)->text(), "How certain");
    for (int row = 0; row < rows.rowCount(); ++row)
      for (const int column : {certainty, certainty + 1})
      {
        const QString text = rows.item(row, column)->text();
        EXPECT_FALSE(text.isEmpty() || text == "not stated") << name << row << column;
      }
  }
  const auto& burrs = table(edit, "burrs");
  EXPECT_EQ(burrs.item(0, 3)->text(), QString::fromUtf8("–"));
  EXPECT_FALSE(burrs.item(0, 3)->flags() & Qt::ItemIsEditable) << "a cutting burr has no grit";
  const auto fine = burrs.findItems("diamond-fine", Qt::MatchExactly);
  ASSERT_EQ(fine.size(), 1);
  EXPECT_EQ(burrs.item(fine[0]->row(), 3)->text(), "58");
  burrs.item(fine[0]->row(), 3)->setText("2000");
  EXPECT_TRUE(isShown(edit, "catalogueFault"));
  EXPECT_EQ(burrs.item(fine[0]->row(), 3)->text(), "58");
  edit.reject();
}

TEST_F(CatalogueDialogs, AMaterialOfTheOpenCaseStaysWithTheBuiltInTables)
{
  scene::Case value = ballCase("ball");
  value.labels.front().structures.front().look.tissue = "sclerotic-bone";
  library().save(value);
  saveOwn("sclerotic-bone");
  openWindow("ball");
  auto& edit = dialog();
  const int rows = table(edit, "materials").rowCount();
  edit.findChild<QPushButton*>("catalogueBuiltIn")->click();
  EXPECT_EQ(table(edit, "materials").rowCount(), rows);
  EXPECT_TRUE(isShown(edit, "catalogueFault"));
  EXPECT_FALSE(isShown(edit, "catalogueLost"));
  edit.reject();
}

TEST_F(CatalogueDialogs, SaysThatOtherCasesMissAMaterial)
{
  saveBall("ball");
  saveOwn("sclerotic-bone");
  openWindow("ball");
  auto& edit = dialog();
  auto& materials = table(edit, "materials");
  const int row = materials.rowCount() - 1;
  EXPECT_FALSE(isShown(edit, "catalogueLost"));
  materials.item(row, 0)->setText("other");
  EXPECT_TRUE(isShown(edit, "catalogueLost"));
  EXPECT_TRUE(edit.findChild<QLabel*>("catalogueLost")->text().contains("sclerotic-bone"));
  materials.item(row, 0)->setText("sclerotic-bone");
  EXPECT_FALSE(isShown(edit, "catalogueLost"));
  materials.selectRow(row);
  edit.findChild<QPushButton*>("removeMaterial")->click();
  EXPECT_TRUE(isShown(edit, "catalogueLost"));
  edit.reject();
}

TEST_F(CatalogueDialogs, TabGoesToTheNextColumn)
{
  saveBall("ball");
  openWindow("ball");
  auto& edit = dialog();
  auto& materials = table(edit, "materials");
  QTest::keyClick(&typed(materials, 2, 3, "0.6"), Qt::Key_Tab);
  EXPECT_EQ(materials.item(2, 3)->text(), "0.6");
  EXPECT_EQ(materials.currentRow(), 2);
  EXPECT_EQ(materials.currentColumn(), 4);
  edit.reject();
}

TEST_F(CatalogueDialogs, SavesWhatIsBeingTyped)
{
  saveBall("ball");
  openWindow("ball");
  auto& edit = dialog();
  ASSERT_TRUE(waitFor([&] { return edit.isActiveWindow(); }));
  auto& materials = table(edit, "materials");
  typed(materials, 0, 4, "-3");
  edit.findChild<QPushButton*>("catalogueSave")->click(); // as its key: the focus stays
  EXPECT_TRUE(edit.isVisible()) << "refused";
  EXPECT_TRUE(isShown(edit, "catalogueFault"));
  typed(materials, 0, 4, "50");
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_NEAR(read().materials.material("cortical-bone").hardness, 50.0 * 9.807e6, 1.0);
}

TEST_F(CatalogueDialogs, NumbersKeepTheDigitsThatAreNotShown)
{
  saveBall("ball");
  {
    presenters::CatalogueEditor editor(folder() / "library");
    auto bone = editor.materials()[0];
    bone.hardness = 42.123456789;
    editor.setMaterial(0, bone);
    auto cutting = editor.burrs()[0];
    cutting.diameters = {2.12345678};
    editor.setBurr(0, cutting);
    editor.save();
  }
  openWindow("ball");
  auto& edit = dialog();
  table(edit, "materials").item(0, 3)->setText("0.55");
  table(edit, "burrs").item(0, 2)->setText("-12");
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_DOUBLE_EQ(read().materials.material("cortical-bone").friction, 0.55);
  EXPECT_NEAR(read().materials.material("cortical-bone").hardness / 9.807e6, 42.123456789, 1e-9);
  EXPECT_EQ(read().burrs.model(dissection::Burr::Kind::Cutting).diameters,
            std::vector<double>{2.12345678});
}

TEST_F(CatalogueDialogs, DiametersKeepTheirDigitsWhereTheyHaveAComma)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  saveBall("ball");
  {
    presenters::CatalogueEditor editor(folder() / "library");
    auto cutting = editor.burrs()[0];
    cutting.diameters = {1.984375, 3.0};
    editor.setBurr(0, cutting);
    editor.save();
  }
  openWindow("ball");
  const GermanTexts german;
  ASSERT_TRUE(german.isThere());
  auto& edit = dialog();
  EXPECT_TRUE(table(edit, "burrs").item(0, 5)->text().startsWith("1,98"));
  table(edit, "burrs").item(0, 2)->setText("-12");
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_EQ(read().burrs.model(dissection::Burr::Kind::Cutting).diameters,
            (std::vector<double>{1.984375, 3.0}));
}

TEST_F(CatalogueDialogs, RemoveIsOfferedForTheRowThatIsThenSelected)
{
  saveBall("ball");
  saveOwn("sclerotic-bone");
  QFile file(QString::fromStdString(materialsFile().string()));
  ASSERT_TRUE(file.open(QIODevice::ReadWrite));
  QJsonObject root = QJsonDocument::fromJson(file.readAll()).object();
  QJsonArray ordered = root["materials"].toArray();
  ordered.prepend(ordered.takeAt(ordered.size() - 1));
  root["materials"] = ordered;
  file.resize(0);
  file.write(QJsonDocument(root).toJson());
  file.close();
  openWindow("ball");
  auto& edit = dialog();
  auto& materials = table(edit, "materials");
  ASSERT_EQ(materials.item(0, 0)->text(), "sclerotic-bone");
  auto& remove = *edit.findChild<QPushButton*>("removeMaterial");
  EXPECT_TRUE(remove.isEnabled());
  remove.click();
  EXPECT_EQ(materials.item(0, 0)->text(), "cortical-bone");
  EXPECT_FALSE(remove.isEnabled());
  edit.reject();
}

TEST_F(CatalogueDialogs, ABrokenFileCanBeReplacedByTheBuiltInTable)
{
  saveBall("ball");
  std::ofstream(materialsFile()) << "{";
  openWindow("ball");
  QString why;
  onMessage(
      [&why](QMessageBox& box)
      {
        why = box.text();
        box.defaultButton()->click();
      });
  action(QString::fromUtf8("Materials and burrs…"))->trigger();
  ASSERT_TRUE(waitFor([this] { return window().findChild<CatalogueDialog*>() != nullptr; }));
  EXPECT_TRUE(why.contains("materials.json")) << why.toStdString();
  EXPECT_TRUE(std::filesystem::exists(materialsFile()));
  auto& edit = *window().findChild<CatalogueDialog*>();
  EXPECT_EQ(table(edit, "materials").item(0, 0)->text(), "cortical-bone");
  edit.findChild<QPushButton*>("catalogueSave")->click();
  EXPECT_FALSE(std::filesystem::exists(materialsFile()));
}
