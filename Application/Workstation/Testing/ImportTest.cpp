#include "GuiTest.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <locale>
#include <set>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QProgressDialog>
#include <QPushButton>
#include <QStatusBar>
#include <QTreeView>
#include <QTreeWidget>
#include <QWheelEvent>

#include "Banner.h"
#include "CaseDocumentController.h"
#include "RegionDialog.h"
#include "RepairDialog.h"
#include "SeriesDialog.h"
#include "SharedSample.h"
#include "StartPage.h"
#include "WindowTexts.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Library/Archive.h"
#include "petrous/Presenters/CaseBuilder.h"

using namespace petrous;
using namespace petrous::workstation;

namespace fs = std::filesystem;
class Import : public GuiTest
{
protected:
  /// Drops what is to be added to the open case, and answers the question `box` by the button
  /// `answer`. What was asked; empty: it was not.
  QString askedOnDrop(const fs::path& path, const QString& box, const QString& answer);
  /// The sample patient's CT and MR, in the folder "visit".
  void writeImagesOfAVisit()
  {
    phantom::SampleOptions options;
    options.spacing = 1.5;
    petrous::testing::writeSharedSample(folder() / "visit", options);
    for (const char* part : {"labels", "labels.seg.nrrd", "meshes"})
      fs::remove_all(folder() / "visit" / part);
  }
};
using presenters::Content;

TEST_F(Import, ADroppedFileIsOnTheScreenAndInTheLibrary)
{
  const fs::path file = folder() / "Left ear: 2.nrrd";
  imaging::writeVolume(file, *ballCase("x").ct.volume.get());
  openWindow();
  dropPath(file);
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  EXPECT_EQ(window().model().value().name, "Left ear  2");
  EXPECT_TRUE(library().contains("Left ear  2"));
  EXPECT_FALSE(window().model().unsaved());
  const QImage image = picture();
  EXPECT_GT(pixelsUnlikeTheCorner(image), image.width() * image.height() / 20);

  dropPath(file); // again: a case of its own
  ASSERT_TRUE(waitFor([this] { return library().contains("Left ear  2 2"); }));
}

TEST_F(Import, ADroppedDicomFolderCanBeDrilledAtOnce)
{
  phantom::SampleOptions options;
  options.spacing = 1.0;
  petrous::testing::writeSharedSample(folder() / "sample", options);
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase(); }));
  QTest::qWait(100);
  drill(600);
  ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
  QTest::qWait(50);
  EXPECT_EQ(library().open("ct").dissection.strokes().size(), 1u);
}

TEST_F(Import, AFolderOfSeveralSeriesAsksWhich)
{
  writeImagesOfAVisit();
  openWindow();
  QStringList offered;
  onDialog(
      [&offered](QDialog& dialog)
      {
        auto* list = dialog.findChild<QTreeWidget*>("series");
        if (!list)
          return false;
        for (int n = 0; n < list->topLevelItemCount(); ++n)
        {
          QStringList line;
          for (int column = 0; column < list->columnCount(); ++column)
            line += list->topLevelItem(n)->text(column);
          offered += line.join(" | ");
        }
        EXPECT_EQ(list->topLevelItem(0)->checkState(0), Qt::Checked) << "the only CT";
        EXPECT_EQ(list->topLevelItem(1)->checkState(0), Qt::Unchecked);
        list->topLevelItem(0)->setCheckState(0, Qt::Unchecked);
        list->topLevelItem(1)->setCheckState(0, Qt::Checked);
        auto* open = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open);
        EXPECT_FALSE(open->isEnabled()) << "an MR without a CT";
        list->topLevelItem(0)->setCheckState(0, Qt::Checked);
        EXPECT_TRUE(open->isEnabled());
        open->click();
        return true;
      });
  dropPath(folder() / "visit");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  ASSERT_EQ(offered.size(), 2);
  for (const char* told :
       {"CT", "1.5 × 1.5 × 1.5 mm", "2020-01-01 12:00", "HFS", "in “ct”", "sound"})
    EXPECT_TRUE(offered[0].contains(QString::fromUtf8(told))) << offered[0].toStdString();
  const scene::Case& value = window().model().value();
  EXPECT_EQ(value.name, "visit");
  EXPECT_GT(value.ct.range.max, 1000.0); // HU: the CT, not the MR
  ASSERT_EQ(value.mr.size(), 1u) << "both were ticked";
  EXPECT_EQ(value.mr[0].name, "T2 3D") << "of “T2 3D inner ear right” what names a sequence";
}

// Beside the verdict: what `petrous new` has as --ct-axes and --mr-axes.
TEST_F(Import, AxesThatAFileStatesWronglyAreSaidWhereItsSeriesIsChosen)
{
  writeImagesOfAVisit();
  openWindow();
  onDialog(
      [](QDialog& dialog)
      {
        auto* list = dialog.findChild<QTreeWidget*>("series");
        if (!list)
          return false;
        const std::array<const char*, 2> wanted{"RPS", "LPI"}; // of the CT and the MR
        for (int n = 0; n < 2; ++n)
        {
          QTreeWidgetItem* line = list->topLevelItem(n);
          line->setCheckState(0, Qt::Checked);
          auto* axes = dynamic_cast<QComboBox*>(list->itemWidget(line, list->columnCount() - 1));
          EXPECT_EQ(axes->currentText(), "as the file states");
          QWheelEvent wheel(QPointF(4, 4), QPointF(4, 4), {}, {0, -120}, Qt::NoButton, {},
                            Qt::NoScrollPhase, false);
          QApplication::sendEvent(axes, &wheel);
          EXPECT_EQ(axes->currentText(), "as the file states") << "the list is scrolled";
          axes->setCurrentIndex(axes->findData(QString(wanted[static_cast<std::size_t>(n)])));
        }
        dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->click();
        return true;
      });
  dropPath(folder() / "visit");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const scene::Case& value = window().model().value();
  ASSERT_EQ(value.mr.size(), 1U);
  EXPECT_EQ(value.ct.provenance.axes.letters(), "RPS");
  EXPECT_LT(value.ct.geometry.direction().determinant(), 0.0) << "it was not mirrored in its file";
  EXPECT_EQ(value.mr[0].provenance.axes.letters(), "LPI");
  EXPECT_LT(value.mr[0].geometry.direction().determinant(), 0.0);
}

// Of one series alone its folder names the case, as if that had been opened.
TEST_F(Import, ASeriesOfATreeNamesTheCaseByItsFolder)
{
  writeImagesOfAVisit();
  openWindow();
  onDialog(
      [](QDialog& dialog)
      {
        if (!dialog.findChild<QTreeWidget*>("series"))
          return false;
        dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->click();
        return true;
      });
  dropPath(folder() / "visit");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  EXPECT_EQ(window().model().value().name, "ct");
  EXPECT_TRUE(window().model().value().mr.empty());
}

// A sound CT, its structures, and structures of something else, in one tree.
TEST_F(Import, StructuresOfADroppedTreeAreOfferedWithItsSeries)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(folder() / "visit", options);
  for (const char* part : {"labels", "mr"})
    fs::remove_all(folder() / "visit" / part);
  openWindow();
  QStringList ticked;
  QStringList offered;
  onDialog(
      [&](QDialog& dialog)
      {
        auto* list = dialog.findChild<QTreeWidget*>("series");
        if (!list)
          return false;
        for (int n = 0; n < list->topLevelItemCount(); ++n)
        {
          QTreeWidgetItem* item = list->topLevelItem(n);
          QStringList line;
          for (int column = 0; column < list->columnCount(); ++column)
            line += item->text(column);
          offered += line.join(" | ");
          if (item->checkState(0) == Qt::Checked)
            ticked += item->text(0);
        }
        const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
        if (!pictures.isEmpty())
          dialog.grab().save(pictures + "/series.png");
        dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->click();
        return true;
      });
  dropPath(folder() / "visit");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  EXPECT_EQ(ticked.size(), 2) << ticked.join("; ").toStdString();
  EXPECT_TRUE(ticked.filter("labels.seg.nrrd").size() == 1) << "the only ones on the CT's grid";
  const QString all = offered.join('\n');
  EXPECT_TRUE(all.contains("structures on the grid of the CT")) << all.toStdString();
  EXPECT_TRUE(all.contains("mesh")) << all.toStdString();
  const scene::Case& value = window().model().value();
  EXPECT_FALSE(value.labels.empty());
  EXPECT_TRUE(value.meshes.empty()) << "not ticked";
  EXPECT_TRUE(value.mr.empty());
}

// Every column of the list is readable, and what is ticked comes: meshes and one of several sources
// of structures.
TEST_F(Import, MeshesThatAreTickedComeWithTheCt)
{
  phantom::SampleOptions options;
  options.spacing = 2.0;
  petrous::testing::writeSharedSample(folder() / "visit", options);
  for (const char* part : {"mr", "labels", "labels.seg.nrrd"}) // of the same names
    fs::remove_all(folder() / "visit" / part);
  openWindow();
  QStringList ticked;
  onDialog(
      [&](QDialog& dialog)
      {
        auto* list = dialog.findChild<QTreeWidget*>("series");
        if (!list)
          return false;
        int right = 0;
        for (int column = 0; column < list->columnCount(); ++column)
        {
          EXPECT_GE(list->columnWidth(column),
                    list->fontMetrics().horizontalAdvance(list->headerItem()->text(column)))
              << "the header of column " << column;
          for (int n = 0; n < list->topLevelItemCount(); ++n)
            EXPECT_GE(list->columnWidth(column),
                      list->fontMetrics().horizontalAdvance(list->topLevelItem(n)->text(column)))
                << list->topLevelItem(n)->text(column).toStdString();
          right += list->columnWidth(column);
        }
        EXPECT_LE(right, list->viewport()->width()) << "all of them are in sight";
        for (int n = 0; n < list->topLevelItemCount(); ++n)
        {
          QTreeWidgetItem* item = list->topLevelItem(n);
          if (item->text(0).contains("mesh") || item->text(0).contains(".obj"))
          {
            item->setCheckState(0, Qt::Checked);
            ticked += item->text(0);
          }
        }
        const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
        if (!pictures.isEmpty())
          dialog.grab().save(pictures + "/series-parts.png");
        dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->click();
        return true;
      });
  dropPath(folder() / "visit");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const scene::Case& value = window().model().value();
  const auto meshes = std::distance(fs::directory_iterator(folder() / "visit" / "meshes"), {});
  EXPECT_EQ(static_cast<long>(value.meshes.size()), meshes) << ticked.join("; ").toStdString();
  EXPECT_EQ(value.ct.geometry.dims()[0], value.ct.volume.get()->geometry().dims()[0]);
}

// A file of several volumes offers them as a series does.
TEST_F(Import, AVolumeOfAFourDimensionalFileIsChosen)
{
  const auto ball = ballCase("x");
  const volume::IntensityVolume& first = *ball.ct.volume.get();
  const core::Index3 dims = first.geometry().dims();
  const auto size =
      std::to_string(dims[0]) + " " + std::to_string(dims[1]) + " " + std::to_string(dims[2]);
  std::string voxels;
  for (const int more : {0, 7, 20})
    for (int k = 0; k < dims[2]; ++k)
      for (int j = 0; j < dims[1]; ++j)
        for (int i = 0; i < dims[0]; ++i)
        {
          const auto value = static_cast<std::int16_t>(first.at(i, j, k) + more);
          voxels.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
  std::ofstream(folder() / "phases.nrrd", std::ios::binary)
      << "NRRD0004\ntype: short\ndimension: 4\nspace: left-posterior-superior\nsizes: " << size
      << " 3\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\nkinds: domain domain domain time\n"
         "endian: little\nencoding: raw\nspace origin: (0,0,0)\n\n"
      << voxels;
  openWindow();
  QStringList offered;
  onDialog(
      [&](QDialog& dialog)
      {
        auto* list = dialog.findChild<QTreeWidget*>("series");
        if (!list)
          return false;
        for (int n = 0; n < list->topLevelItemCount(); ++n)
        {
          offered += list->topLevelItem(n)->text(0);
          list->topLevelItem(n)->setCheckState(0, n == 1 ? Qt::Checked : Qt::Unchecked);
        }
        dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->click();
        return true;
      });
  dropPath(folder() / "phases.nrrd");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  ASSERT_EQ(offered.size(), 3);
  EXPECT_TRUE(offered[2].contains("volume 3")) << offered[2].toStdString();
  const volume::IntensityVolume& chosen = *window().model().value().ct.volume.get();
  ASSERT_EQ(chosen.geometry().dims(), dims);
  EXPECT_EQ(chosen.at(dims[0] / 2, dims[1] / 2, dims[2] / 2),
            first.at(dims[0] / 2, dims[1] / 2, dims[2] / 2) + 7);
}

TEST_F(Import, ADroppedWordOpensTheCaseOfThatName)
{
  saveBall("ball");
  QTest::qWait(1100);
  saveBall("second");
  openWindow();
  ASSERT_EQ(window().model().value().name, "second");
  QMimeData data;
  data.setText("ball");
  drop(data);
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "ball"; }));
}

TEST_F(Import, AFolderWithoutImagesIsRefusedInOneLine)
{
  fs::create_directory(folder() / "holiday");
  std::ofstream(folder() / "holiday" / "beach.jpg") << "no image";
  openWindow();
  QString text;
  onMessage(
      [&text](QMessageBox& box)
      {
        text = box.text();
        box.accept();
      });
  dropPath(folder() / "holiday");
  ASSERT_TRUE(waitFor([&text] { return !text.isEmpty(); }));
  EXPECT_TRUE(text.contains("holiday")) << text.toStdString();
  EXPECT_FALSE(text.contains('\n'));
  ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
}

TEST_F(Import, CancelLeavesNoCase)
{
  openWindow();
  // Making the sample patient takes seconds.
  window().findChild<StartPage*>()->findChild<QPushButton*>("primary")->click();
  QProgressDialog* progress = nullptr;
  ASSERT_TRUE(waitFor(
      [&]
      {
        progress = window().findChild<QProgressDialog*>("importProgress");
        return progress && progress->isVisible() && progress->value() > 0;
      }));
  progress->findChild<QPushButton*>()->click();
  ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
}

TEST_F(Import, QuittingWhileTheCaseIsBeingSavedKeepsIt)
{
  const fs::path file = folder() / "ear.nrrd";
  imaging::writeVolume(file, *ballCase("x").ct.volume.get());
  openWindow();
  dropPath(file);
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase(); }));
  closeWindow();
  EXPECT_TRUE(library().contains("ear"));
}

namespace
{

// The patient at 1.5 mm, in `folder`.
void writePatient(const fs::path& folder)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(folder, options);
}

using OnDialog = std::function<void(const std::function<bool(QDialog&)>&)>;

QString textOf(const QDialog& dialog)
{
  QStringList text;
  for (const auto* label : dialog.findChildren<QLabel*>())
    text += label->text();
  return text.join('\n');
}

QAbstractButton* buttonOf(const QDialog& dialog, const QString& text)
{
  for (auto* candidate : dialog.findChildren<QAbstractButton*>())
    if (candidate->text().remove('&').contains(text))
      return candidate;
  return nullptr;
}

bool clicked(const QDialog& dialog, const QString& text)
{
  auto* button = buttonOf(dialog, text);
  if (button)
    button->click();
  return button;
}

std::set<std::string> structureNames(const scene::Case& value)
{
  std::set<std::string> all;
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
      all.insert(structure.name);
  return all;
}

// Clicks the button of the next dialog whose text contains `button`; returns the dialog's text.
QString answered(const OnDialog& onDialog, const QString& button, const std::function<void()>& act)
{
  QString text;
  onDialog(
      [&text, button](QDialog& dialog)
      {
        text = textOf(dialog);
        if (auto* found = buttonOf(dialog, button))
          found->click();
        else
          dialog.reject();
        return true;
      });
  act();
  EXPECT_TRUE(QTest::qWaitFor([&text] { return !text.isEmpty(); }, 60000));
  return text;
}

} // namespace

QString Import::askedOnDrop(const fs::path& path, const QString& box, const QString& answer)
{
  QString asked;
  onDialog(
      [&](QDialog& dialog)
      {
        if (clicked(dialog, "Add to"))
          return false;
        if (dialog.objectName() != box)
          return false;
        asked = textOf(dialog);
        buttonOf(dialog, answer)->click();
        return true;
      });
  dropPath(path);
  EXPECT_TRUE(waitFor([&] { return !asked.isEmpty(); }));
  return asked;
}

TEST_F(Import, AnMrComesToTheOpenCase)
{
  writePatient(folder() / "sample");
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const QString asked = answered([this](const auto& react) { onDialog(react); }, "Add to",
                                 [this] { dropPath(folder() / "sample" / "mr"); });
  EXPECT_TRUE(asked.contains("MR") && asked.contains("ct")) << asked.toStdString();
  ASSERT_TRUE(waitFor([this] { return window().model().value().mr.size() == 1; }));
  EXPECT_TRUE(settled());
  EXPECT_EQ(window().model().value().name, "ct");
  EXPECT_EQ(library().list().size(), 1u);
  EXPECT_EQ(library().open("ct").mr.size(), 1u);
  EXPECT_EQ(window().model().value().iso, 300.0);
}

TEST_F(Import, LabelsAndMeshesComeToTheOpenCaseAndCanBeDropped)
{
  writePatient(folder() / "sample");
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto camera = view().picture().camera();
  answered([this](const auto& react) { onDialog(react); }, "Add to",
           [this] { dropPath(folder() / "sample" / "labels.seg.nrrd"); });
  ASSERT_TRUE(waitFor([this] { return !window().model().value().labels.empty(); }));
  EXPECT_TRUE(settled());
  EXPECT_TRUE(window().model().ready());
  EXPECT_EQ(view().picture().camera().position, camera.position);
  EXPECT_FALSE(library().open("ct").labels.empty());
  // Cancelling has no effect.
  const auto parts = window().model().value().meshes.size();
  answered([this](const auto& react) { onDialog(react); }, "Cancel",
           [this] { dropPath(folder() / "sample" / "meshes" / "facial_nerve.obj"); });
  EXPECT_TRUE(settled());
  EXPECT_EQ(window().model().value().meshes.size(), parts);
}

TEST_F(Import, LabelsThatLieOutsideTheCtAreToldInALine)
{
  saveBall("ball");
  const core::GridGeometry away({8, 8, 8}, Eigen::Vector3d::Ones(), {500.0, 500.0, 500.0});
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(away, std::uint16_t{1});
  volume::Segment vein;
  vein.name = "vein";
  vein.index = 1;
  imaging::writeLabelFile(folder() / "other.seg.nrrd", volume::makeLabelMap(voxels, {vein}));
  openWindow();
  const auto drop = [this](bool wanted)
  {
    bool isAsked = false;
    answered([this](const auto& react) { onDialog(react); }, "Add to",
             [this] { dropPath(folder() / "other.seg.nrrd"); });
    onMessage(
        [&](QMessageBox& box)
        {
          isAsked = box.objectName() == "askOutside" &&
                    box.text().contains(QString::fromUtf8("structure of “other.seg.nrrd” lies"));
          if (!wanted)
            return box.reject();
          clickOn(box, QMessageBox::AcceptRole);
        });
    EXPECT_TRUE(waitFor([&] { return isAsked; }));
    EXPECT_TRUE(settled());
  };
  drop(false);
  EXPECT_EQ(window().model().value().labels.size(), 1U);
  drop(true);
  ASSERT_TRUE(waitFor([this] { return window().model().value().labels.size() == 2; }));
  EXPECT_TRUE(settled());
  auto* banner = window().findChild<Banner*>("notesBanner");
  EXPECT_TRUE(waitFor([banner] { return banner->isVisible(); }));
  EXPECT_TRUE(banner->text().contains("'vein' lies wholly outside the CT"))
      << banner->text().toStdString();
}

// As TotalSegmentator writes them, here with a patient's name in each; dropped and by the menu.
TEST_F(Import, AFolderOfMasksBecomesStructures)
{
  saveBall("ball");
  const core::GridGeometry grid = ballCase("x").ct.geometry;
  fs::create_directories(folder() / "masks");
  for (const char* name : {"doe_incus", "doe_malleus", "doe_stapes"})
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
    voxels->at(4, 4, 4) = 1;
    imaging::writeLabelFile(folder() / "masks" / (name + std::string(".nii.gz")),
                            volume::makeLabelMap(voxels, {}));
  }
  openWindow();
  for (const bool byMenu : {false, true})
  {
    QString asked;
    onDialog(
        [&](QDialog& dialog)
        {
          if (auto* files = qobject_cast<QFileDialog*>(&dialog))
          {
            files->findChild<QLineEdit*>("fileNameEdit")
                ->setText(QString::fromStdString((folder() / "masks").string()));
            static_cast<QDialog&>(*files).accept();
            return false;
          }
          auto* add = buttonOf(dialog, "Add to");
          if (!add)
            return false;
          asked = textOf(dialog);
          byMenu ? dialog.reject() : add->click();
          return true;
        });
    if (!byMenu)
      dropPath(folder() / "masks");
    else
      for (QAction* action : window().findChildren<QAction*>())
        if (action->text().remove('&') == QString::fromUtf8("Add folder of masks…"))
          action->trigger();
    ASSERT_TRUE(waitFor([&] { return !asked.isEmpty(); }));
    EXPECT_TRUE(asked.contains("incus") && asked.contains("stapes")) << asked.toStdString();
    EXPECT_FALSE(asked.contains("doe")) << asked.toStdString();
    EXPECT_TRUE(settled());
  }
  std::vector<std::string> names;
  for (const scene::LabelPart& part : window().model().value().labels)
    for (const scene::StructurePart& structure : part.structures)
      names.push_back(structure.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"incus", "malleus", "nerve", "stapes"}));
}

// Of a folder some of whose names the case has; and of a label file, whose names are not known
// before it is read.
TEST_F(Import, NamesThatAreTakenAreAskedAboutAtOnce)
{
  saveBall("ball"); // with a "nerve"
  const core::GridGeometry grid = ballCase("x").ct.geometry;
  fs::create_directories(folder() / "masks");
  auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
  voxels->at(4, 4, 4) = 1;
  for (const char* name : {"nerve", "malleus", "stapes"})
    imaging::writeLabelFile(folder() / "masks" / (name + std::string(".nii.gz")),
                            volume::makeLabelMap(voxels, {}));
  auto several = volume::makeZeroVolume<std::uint16_t>(grid);
  several->at(4, 4, 4) = 1;
  several->at(5, 4, 4) = 2;
  several->at(6, 4, 4) = 3;
  imaging::writeLabelFile(
      folder() / "some.seg.nrrd",
      volume::makeLabelMap(several,
                           {{"nerve", 1, {}, 0}, {"stapes", 2, {}, 0}, {"vein", 3, {}, 0}}));
  openWindow();
  const auto names = [this]
  {
    QStringList all;
    for (const scene::LabelPart& part : window().model().value().labels)
      for (const scene::StructurePart& structure : part.structures)
        all += QString::fromStdString(structure.name);
    all.sort();
    return all;
  };
  const auto add = [&](const char* file, bool skips, const QString& newName = {})
  {
    QString asked;
    onDialog(
        [&asked, skips, &newName](QDialog& dialog)
        {
          if (clicked(dialog, "Add to"))
            return false;
          if (dialog.objectName() != "askNewNames")
            return false;
          asked = textOf(dialog);
          for (const auto* name : dialog.findChildren<QLineEdit*>("partName"))
            asked += " " + name->text();
          if (!newName.isEmpty())
          {
            auto* name = dialog.findChild<QLineEdit*>("partName");
            name->setText("Nerve"); // reads as one that is there
            EXPECT_FALSE(buttonOf(dialog, "Add under")->isEnabled());
            name->setText(newName);
            buttonOf(dialog, "Add under")->click();
            return true;
          }
          skips ? buttonOf(dialog, "Add the others")->click() : dialog.reject();
          return true;
        });
    dropPath(folder() / file);
    EXPECT_TRUE(waitFor([&asked] { return !asked.isEmpty(); })) << file;
    EXPECT_TRUE(settled());
    return asked;
  };
  EXPECT_TRUE(add("masks", false).contains(QString::fromUtf8("“nerve”")));
  EXPECT_EQ(names(), QStringList({"nerve"}));
  add("masks", true);
  ASSERT_TRUE(waitFor([&] { return names().size() == 3; })) << names().join(", ").toStdString();
  EXPECT_EQ(names(), QStringList({"malleus", "nerve", "stapes"}));
  const QString both = add("some.seg.nrrd", true);
  EXPECT_TRUE(both.contains("nerve 2") && both.contains("stapes 2")) << both.toStdString();
  ASSERT_TRUE(waitFor([&] { return names().size() == 4; })) << names().join(", ").toStdString();
  EXPECT_TRUE(names().contains("vein"));
  EXPECT_EQ(window().model().value().labels.front().structures.front().voxels,
            ballCase("x").labels.front().structures.front().voxels)
      << "the case's own stays";

  // One structure, of a name that its file gives it: there are no others.
  auto alone = volume::makeZeroVolume<std::uint16_t>(grid);
  alone->at(4, 4, 4) = 1;
  imaging::writeLabelFile(folder() / "one.seg.nrrd",
                          volume::makeLabelMap(alone, {{"nerve", 1, {}, 0}}));
  add("one.seg.nrrd", false, "nerve, second reader");
  ASSERT_TRUE(waitFor([&] { return names().size() == 5; })) << names().join(", ").toStdString();
  EXPECT_TRUE(names().contains("nerve, second reader"));
}

namespace
{

/// An RT structure set in explicit VR little endian (PS3.5 7.1.2, PS3.3 C.8.8.5, C.8.8.6): names
/// and a contour each.
std::string structureSet(const std::vector<std::pair<std::string, std::string>>& rois)
{
  const auto number = [](std::size_t value, int bytes)
  {
    std::string out;
    for (int b = 0; b < bytes; ++b)
      out += static_cast<char>(value >> 8 * b & 0xff);
    return out;
  };
  const auto element = [&](std::uint32_t tag, const std::string& vr, std::string value)
  {
    if (value.size() % 2 != 0)
      value += vr == "UI" ? '\0' : ' ';
    const std::string head = number(tag >> 16, 2) + number(tag & 0xffff, 2) + vr;
    return head + (vr == "SQ" ? number(0, 2) + number(value.size(), 4) : number(value.size(), 2)) +
           value;
  };
  const auto item = [&](const std::string& content)
  { return number(0xfffe, 2) + number(0xe000, 2) + number(content.size(), 4) + content; };
  std::string described;
  std::string drawn;
  for (std::size_t n = 0; n < rois.size(); ++n)
  {
    const std::string id = std::to_string(n + 1);
    described += item(element(0x30060022, "IS", id) + element(0x30060024, "UI", "1.2.3.9") +
                      element(0x30060026, "LO", rois[n].first));
    drawn += item(element(0x30060040, "SQ",
                          item(element(0x30060042, "CS", "CLOSED_PLANAR") +
                               element(0x30060050, "DS", rois[n].second))) +
                  element(0x30060084, "IS", id));
  }
  return std::string(128, '\0') + "DICM" + element(0x00020010, "UI", "1.2.840.10008.1.2.1") +
         element(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.481.3") +
         element(0x00080060, "CS", "RTSTRUCT") + element(0x30060020, "SQ", described) +
         element(0x30060039, "SQ", drawn);
}

} // namespace

// The same of a structure set, two of whose structures have one name, and of one alone.
TEST_F(Import, NamesOfAStructureSetThatAreTakenAreAskedAbout)
{
  saveBall("ball"); // with a "nerve"
  const core::GridGeometry grid = ballCase("x").ct.geometry;
  const auto squareAt = [&](double i)
  {
    QStringList all;
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {3.0, 0.0}, {3.0, 3.0}, {0.0, 3.0}})
    {
      const Eigen::Vector3d p = grid.patientFromVoxel(Eigen::Vector3d(i + x, 2.0 + y, 3.0));
      for (const double one : {p[0], p[1], p[2]})
        all += QString::number(one);
    }
    return all.join('\\').toStdString();
  };
  std::ofstream(folder() / "set.dcm", std::ios::binary)
      << structureSet({{"nerve", squareAt(2)}, {"nerve", squareAt(6)}, {"vein", squareAt(10)}});
  std::ofstream(folder() / "one.dcm", std::ios::binary) << structureSet({{"nerve", squareAt(2)}});
  openWindow();
  const auto names = [this] { return structureNames(window().model().value()); };
  const auto add = [&](const char* file, const QString& newName)
  {
    bool isAsked = false;
    onDialog(
        [&](QDialog& dialog)
        {
          if (clicked(dialog, "Add to"))
            return false;
          if (dialog.objectName() != "askNewNames")
            return false;
          isAsked = true;
          if (newName.isEmpty())
            buttonOf(dialog, "Add the others")->click();
          else
          {
            dialog.findChild<QLineEdit*>("partName")->setText(newName);
            buttonOf(dialog, "Add under")->click();
          }
          return true;
        });
    dropPath(folder() / file);
    EXPECT_TRUE(waitFor([&] { return isAsked; })) << file;
    EXPECT_TRUE(settled());
  };
  add("set.dcm", {});
  ASSERT_TRUE(waitFor([&] { return names().size() == 3; }));
  EXPECT_EQ(names(), (std::set<std::string>{"nerve", "nerve 2", "vein"}));
  add("one.dcm", "cochlear nerve");
  ASSERT_TRUE(waitFor([&] { return names().size() == 4; }));
  EXPECT_EQ(names().count("cochlear nerve"), 1U);
}

TEST_F(Import, ATickAtACtTakesItFromAnother)
{
  presenters::SourceContent source;
  source.path = folder();
  for (const Content content : {Content::Ct, Content::Ct, Content::Mr})
  {
    presenters::SeriesContent one;
    one.selector = "1.2." + std::to_string(source.series.size());
    one.content = content;
    one.modality = content == Content::Mr ? "MR" : "CT";
    one.slices = 40;
    source.series.push_back(one);
  }
  SeriesDialog dialog(source, false);
  auto* list = dialog.findChild<QTreeWidget*>("series");
  auto* open = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open);
  const auto ticks = [&]
  {
    std::string all;
    for (int n = 0; n < list->topLevelItemCount(); ++n)
      all += list->topLevelItem(n)->checkState(0) == Qt::Checked ? '1' : '0';
    return all;
  };
  EXPECT_EQ(ticks(), "000") << "of two CTs none is meant";
  EXPECT_FALSE(open->isEnabled());
  const auto* advice = dialog.findChild<QLabel*>("dim");
  EXPECT_TRUE(advice->text().startsWith("Nothing is ticked")) << advice->text().toStdString();
  list->topLevelItem(0)->setCheckState(0, Qt::Checked);
  list->topLevelItem(2)->setCheckState(0, Qt::Checked);
  EXPECT_EQ(ticks(), "101");
  EXPECT_TRUE(open->isEnabled());
  list->topLevelItem(1)->setCheckState(0, Qt::Checked);
  EXPECT_EQ(ticks(), "011");
  EXPECT_EQ(dialog.chosen().size(), 2U);
  EXPECT_EQ(dialog.axes(), (std::vector<std::optional<core::AxesCorrection>>(2)))
      << "as the files state them";
  const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
  if (!pictures.isEmpty())
    dialog.grab().save(pictures + "/series-ticks.png");
}

// One of two structures lies in the image.
TEST_F(Import, StructuresOutsideOfTheCtAreAskedAboutBeforeTheyAreAdded)
{
  saveBall("ball");
  const core::GridGeometry ct = ballCase("x").ct.geometry;
  const core::GridGeometry grid({60, 2, 2}, Eigen::Vector3d(10.0, 1.0, 1.0), ct.center());
  auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
  voxels->at(0, 0, 0) = 1;
  voxels->at(50, 0, 0) = 2;
  imaging::writeLabelFile(folder() / "two.seg.nrrd",
                          volume::makeLabelMap(voxels, {{"vein", 1, {}, 0}, {"artery", 2, {}, 0}}));
  openWindow();
  const auto drop = [this](const char* answer)
  {
    QString asked;
    answered([this](const auto& react) { onDialog(react); }, "Add to",
             [this] { dropPath(folder() / "two.seg.nrrd"); });
    onMessage(
        [&](QMessageBox& box)
        {
          EXPECT_EQ(window().model().value().labels.size(), 1U) << "before they are added";
          asked = box.text() + box.informativeText();
          for (QAbstractButton* one : box.buttons())
            if (one->text().remove('&').contains(answer))
              return one->click();
        });
    EXPECT_TRUE(waitFor([&] { return !asked.isEmpty(); }));
    EXPECT_TRUE(settled());
    return asked;
  };
  const auto names = [this] { return structureNames(window().model().value()); };
  const QString asked = drop("others only");
  EXPECT_TRUE(asked.contains("1 of the 2 structures") && asked.contains("artery"))
      << asked.toStdString();
  ASSERT_TRUE(waitFor([&] { return names().size() == 2; }));
  EXPECT_EQ(names(), (std::set<std::string>{"nerve", "vein"}));
  for (const scene::LabelPart& part : window().model().value().labels)
    for (const std::string& note : part.notes)
      EXPECT_EQ(note.find("outside"), std::string::npos) << note;
}

// A scan whose header states 12 bits of 16, with a pixel of 5000; one of which these bits cannot be
// kept; and an image whose file calls its millimetres micrometres.
TEST_F(Import, BitsAndUnitsThatMakeNoSenseAreAskedAbout)
{
  writeUndeclaredBits(folder() / "odd");
  writeUndeclaredBits(folder() / "bare", true);
  openWindow();
  const auto answer = [this](const char* box, const char* button, const char* what)
  {
    bool isAsked = false;
    onMessage(
        [&](QMessageBox& asked)
        {
          isAsked = asked.objectName() == box;
          for (QAbstractButton* one : asked.buttons())
            if (one->text().remove('&').contains(QString::fromUtf8(button)))
              return one->click();
          asked.reject();
        });
    dropPath(folder() / what);
    EXPECT_TRUE(waitFor([&] { return isAsked; })) << what;
    EXPECT_TRUE(settled());
  };
  answer("askBits", "Cancel", "odd");
  EXPECT_FALSE(window().model().hasCase());
  answer("askBits", "Keep the bits", "odd");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  EXPECT_EQ(window().model().value().ct.range.max, 5000.0);

  bool canKeep = true;
  QString why;
  onMessage(
      [&](QMessageBox& asked)
      {
        why = asked.informativeText();
        for (QAbstractButton* one : asked.buttons())
          if (one->text().remove('&').contains("Keep the bits"))
            canKeep = one->isEnabled();
        for (QAbstractButton* one : asked.buttons())
          if (one->text().remove('&').contains("Leave the bits out"))
            return one->click();
        asked.reject();
      });
  dropPath(folder() / "bare");
  ASSERT_TRUE(waitFor([&] { return window().model().value().name == "bare" && !window().busy(); }));
  EXPECT_FALSE(canKeep);
  EXPECT_TRUE(why.contains("but not kept")) << why.toStdString();
  EXPECT_EQ(window().model().value().ct.range.max, 904.0);
  EXPECT_EQ(window().model().value().ct.range.min, -1000.0);

  imaging::writeVolume(folder() / "ct.nrrd", *ballCase("x").ct.volume.get());
  std::ifstream in(folder() / "ct.nrrd", std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::string said = "\"mm\" \"mm\" \"mm\"";
  ASSERT_NE(bytes.find(said), std::string::npos);
  bytes.replace(bytes.find(said), said.size(), "\"um\" \"um\" \"um\"");
  std::ofstream(folder() / "small.nrrd", std::ios::binary) << bytes;
  QString stated;
  onMessage(
      [&stated](QMessageBox& asked)
      {
        for (const QAbstractButton* one : asked.buttons())
          if (one->text().contains("as the file says"))
            stated += one->text();
        asked.reject();
      });
  dropPath(folder() / "small.nrrd");
  ASSERT_TRUE(waitFor([&stated] { return !stated.isEmpty(); }));
  EXPECT_TRUE(settled());
  EXPECT_TRUE(stated.startsWith(QString::fromUtf8("In \xc2\xb5m,"))) << stated.toStdString();
  answer("askUnit", "In mm:", "small.nrrd");
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "small"; }));
  EXPECT_TRUE(
      core::sameGrid(window().model().value().ct.geometry, ballCase("x").ct.geometry, 1e-6));
}

TEST_F(Import, WithoutACaseAnMrAndLabelsSayWhatIsNeeded)
{
  writePatient(folder() / "sample");
  openWindow();
  const auto told = [this](const char* what, const char* answer)
  {
    const QString text = answered([this](const auto& react) { onDialog(react); }, answer,
                                  [&] { dropPath(folder() / "sample" / what); });
    EXPECT_TRUE(text.contains("CT") && text.contains(what)) << text.toStdString();
    EXPECT_TRUE(settled());
  };
  told("labels.seg.nrrd", "OK");
  told("mr", "Cancel");
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
  told("mr", "Begin with the MR");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const scene::Case& value = window().model().value();
  EXPECT_EQ(value.ct.modality, scene::Modality::Mr);
  EXPECT_TRUE(value.mr.empty());
  EXPECT_TRUE(settled());
  EXPECT_EQ(library().list().size(), 1u);
}

TEST_F(Import, AMeshThatCountsOtherwiseIsAskedAbout)
{
  writePatient(folder() / "sample");
  auto mesh = imaging::readMesh(folder() / "sample" / "meshes" / "facial_nerve.obj");
  std::ofstream file(folder() / "facial_nerve.obj"); // right, front, up; states nothing
  file.imbue(std::locale::classic());
  for (const auto& v : mesh.vertices)
    file << "v " << -v[0] << " " << -v[1] << " " << v[2] << "\n";
  for (const auto& t : mesh.triangles)
    file << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  file.close();
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  for (const char* answer : {"Cancel", "Add as RAS (Slicer, NIfTI), mm"})
  {
    EXPECT_TRUE(window().model().value().meshes.empty());
    bool isAsked = false;
    answered([this](const auto& react) { onDialog(react); }, "Add to",
             [this] { dropPath(folder() / "facial_nerve.obj"); });
    onMessage(
        [&](QMessageBox& box)
        {
          isAsked = true;
          EXPECT_TRUE(box.informativeText().contains("RAS mm")) << box.text().toStdString();
          EXPECT_FALSE(box.informativeText().contains("--")) << "an option of the command";
          for (QAbstractButton* button : box.buttons())
            if (button->text().remove('&') == answer)
              return button->click();
          ADD_FAILURE() << "no button " << answer;
          box.reject();
        });
    ASSERT_TRUE(waitFor([&] { return isAsked; }));
    EXPECT_TRUE(settled());
  }
  ASSERT_TRUE(waitFor([this] { return window().model().value().meshes.size() == 1; }));
  const auto added = window().model().value().meshes[0].mesh.get();
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(added->vertices[0][axis], mesh.vertices[0][axis], 1e-3);
  EXPECT_TRUE(settled());
}

// By the Case menu, in metres and as Slicer has its axes; the other way round by a drop.
TEST_F(Import, AMeshInMetresIsAskedAboutHoweverItIsAdded)
{
  writePatient(folder() / "sample");
  const auto mesh = imaging::readMesh(folder() / "sample" / "meshes" / "facial_nerve.obj");
  const fs::path path = folder() / "facial_nerve.obj"; // states nothing
  {
    std::ofstream file(path);
    file.imbue(std::locale::classic());
    file.precision(9);
    for (const auto& v : mesh.vertices)
      file << "v " << -0.001F * v[0] << " " << -0.001F * v[1] << " " << 0.001F * v[2] << "\n";
    for (const auto& t : mesh.triangles)
      file << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  }
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto add = [&](bool byMenu, const QString& answer)
  {
    QStringList offered;
    onDialog(
        [&](QDialog& dialog)
        {
          if (auto* files = qobject_cast<QFileDialog*>(&dialog))
          {
            files->findChild<QLineEdit*>("fileNameEdit")
                ->setText(QString::fromStdString(path.string()));
            static_cast<QDialog&>(*files).accept();
            return false;
          }
          if (dialog.objectName() != "askMeshSpace")
          {
            if (auto* button = buttonOf(dialog, "Add to"))
              button->click();
            return false;
          }
          const auto& box = static_cast<QMessageBox&>(dialog);
          EXPECT_TRUE(box.text().contains("facial_nerve.obj")) << box.text().toStdString();
          EXPECT_TRUE(box.informativeText().contains("RAS m")) << box.text().toStdString();
          EXPECT_FALSE(box.informativeText().contains("--")) << "an option of the command";
          for (const auto* button : box.buttons())
            offered += button->text().remove('&');
          buttonOf(dialog, answer)->click();
          return true;
        });
    if (byMenu)
      for (QAction* action : window().findChildren<QAction*>())
        if (action->text().remove('&') == QString::fromUtf8("Add mesh…"))
          action->trigger();
    if (!byMenu)
      dropPath(path);
    EXPECT_TRUE(waitFor([&] { return !offered.isEmpty(); }));
    EXPECT_TRUE(settled());
    return offered;
  };
  const QStringList offered = add(true, "Cancel");
  EXPECT_TRUE(offered.contains("Add as RAS (Slicer, NIfTI), m")) << offered.join('|').toStdString();
  EXPECT_TRUE(offered.contains("Cancel"));
  EXPECT_TRUE(window().model().value().meshes.empty());
  for (const bool byMenu : {true, false})
  {
    add(byMenu, "RAS (Slicer, NIfTI), m");
    ASSERT_TRUE(waitFor([this] { return window().model().value().meshes.size() == 1; }));
    const auto added = window().model().value().meshes[0].mesh.get();
    ASSERT_EQ(added->vertices.size(), mesh.vertices.size());
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(added->vertices[0][axis], mesh.vertices[0][axis], 1e-3) << byMenu;
    EXPECT_TRUE(settled());
    const_cast<presenters::WorkstationModel&>(window().model()).removePart("facial_nerve");
    EXPECT_TRUE(window().model().value().meshes.empty());
  }
}

// An MR or a cone beam as a plain file: undetermined.
TEST_F(Import, InDoubtTheUserIsAsked)
{
  saveBall("ball");
  const auto plain = [this](const std::string& name)
  {
    const auto ball = ballCase("x");
    auto image = std::make_shared<volume::Volume<std::int16_t>>(ball.ct.geometry);
    std::uint32_t state = 1;
    for (std::size_t n = 0; n < image->size(); ++n)
    {
      state = state * 1664525U + 1013904223U;
      image->data()[n] = static_cast<std::int16_t>(200 + (state >> 24));
    }
    imaging::writeVolume(folder() / name, *image);
    return folder() / name;
  };
  const fs::path file = plain("t2.nrrd");
  openWindow();
  QString text;
  onMessage( // what it is, and then whether to add it
      [this, &text](QMessageBox& box)
      {
        text = box.text();
        onDialog(
            [](QDialog& add)
            {
              auto* button = buttonOf(add, "Add to");
              if (!button)
                return false;
              button->click();
              return true;
            });
        buttonOf(box, "MR of")->click();
      });
  dropPath(file);
  ASSERT_TRUE(waitFor([this] { return !window().model().value().mr.empty(); }));
  EXPECT_TRUE(text.contains("t2.nrrd")) << text.toStdString();
  EXPECT_EQ(window().model().value().name, "ball");
  EXPECT_TRUE(settled());
  // As a CT it is a case of its own.
  answered([this](const auto& react) { onDialog(react); }, "CT",
           [&] { dropPath(plain("beam.nrrd")); });
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "beam"; }));
}

TEST_F(Import, ACtBeginsACaseAndTheOpenOneIsSafe)
{
  saveBall("ball");
  const fs::path file = folder() / "ear.nrrd";
  imaging::writeVolume(file, *ballCase("x").ct.volume.get());
  openWindow();
  drill(400);
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier); // unsaved
  EXPECT_TRUE(waitFor([this] { return window().model().value().applied() == 0; }));
  EXPECT_TRUE(window().model().unsaved());
  dropPath(file);
  dropPath(file); // while it is being examined
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "ear"; }));
  EXPECT_TRUE(settled());
  const auto ball = library().open("ball");
  EXPECT_EQ(ball.dissection.strokes().size(), 1u);
  EXPECT_EQ(ball.applied(), 0u);
  EXPECT_EQ(library().list().size(), 2u) << "the second drop came while the first was read";
}

TEST_F(Import, FilesThatAreDroppedTogetherMakeOneCase)
{
  writePatient(folder() / "sample");
  openWindow();
  QMimeData data;
  const auto url = [this](const char* name)
  { return QUrl::fromLocalFile(QString::fromStdString((folder() / "sample" / name).string())); };
  data.setUrls({url("labels.seg.nrrd"), url("ct"), url("mr"), url("meshes/incus.obj")});
  drop(data);
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto saved = library().open("ct");
  EXPECT_FALSE(saved.labels.empty());
  EXPECT_EQ(saved.mr.size(), 1u);
  EXPECT_EQ(saved.meshes.size(), 1u);
}

namespace
{

core::TriangleMesh tetrahedron(const Eigen::Vector3d& center)
{
  core::TriangleMesh mesh;
  const Eigen::Vector3f at = center.cast<float>();
  for (const Eigen::Vector3f& corner : {Eigen::Vector3f(4, 4, 4), Eigen::Vector3f(-4, -4, 4),
                                        Eigen::Vector3f(-4, 4, -4), Eigen::Vector3f(4, -4, -4)})
    mesh.vertices.push_back({at[0] + corner[0], at[1] + corner[1], at[2] + corner[2]});
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

} // namespace

// As of a disk that was taken away while files were looked at.
TEST_F(Import, ALibraryThatCannotBeReadAnyMoreIsToldInWords)
{
  const fs::path ear = folder() / "ear.nrrd";
  imaging::writeVolume(ear, *ballCase("x").ct.volume.get());
  const fs::path incus = folder() / "incus.stl";
  imaging::writeMesh(incus, tetrahedron(kBallCenter));
  openWindow();
  fs::remove_all(folder() / "library/cases");
  fs::create_directories(folder() / "library");
  std::ofstream(folder() / "library/cases") << "no folder";
  QString told;
  onMessage(
      [&told](QMessageBox& box)
      {
        told = box.text();
        box.accept();
      });
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QString::fromStdString(ear.string())),
                QUrl::fromLocalFile(QString::fromStdString(incus.string()))});
  drop(data);
  EXPECT_TRUE(waitFor([&told] { return !told.isEmpty(); }));
  EXPECT_TRUE(told.contains("cannot be read")) << told.toStdString();
  EXPECT_TRUE(settled());
  EXPECT_FALSE(window().findChild<Banner*>("faultBanner")->isVisible());
  EXPECT_FALSE(window().model().hasCase());
}

// Labels and meshes as a tool exports them, under the same names.
TEST_F(Import, MeshesOfTheLabelsNamesComeToTheNewCaseToo)
{
  saveBall("ball");
  const auto ball = ballCase("x");
  imaging::writeVolume(folder() / "ear.nrrd", *ball.ct.volume.get());
  imaging::writeLabelFile(folder() / "nerve.seg.nrrd", *ball.labels[0].labels.get());
  imaging::writeMesh(folder() / "nerve.stl", tetrahedron(kBallCenter));
  imaging::writeMesh(folder() / "incus.stl", tetrahedron(kBallCenter));
  // Two that cannot be read are told in one box.
  for (const char* name : {"malleus.stl", "stapes.stl"})
    std::ofstream(folder() / name) << "nothing";
  openWindow();
  const QString text =
      answered([this](const auto& react) { onDialog(react); }, "OK",
               [this]
               {
                 QMimeData data;
                 QList<QUrl> urls;
                 for (const char* name : {"ear.nrrd", "nerve.seg.nrrd", "nerve.stl", "incus.stl",
                                          "malleus.stl", "stapes.stl"})
                   urls += QUrl::fromLocalFile(QString::fromStdString((folder() / name).string()));
                 data.setUrls(urls);
                 drop(data);
               });
  EXPECT_TRUE(text.contains("2 files") && text.contains("malleus.stl") &&
              text.contains("stapes.stl"))
      << text.toStdString();
  EXPECT_TRUE(settled());
  const scene::Case& value = window().model().value();
  EXPECT_EQ(value.name, "ear");
  ASSERT_EQ(value.meshes.size(), 2u);
  EXPECT_EQ(value.meshes[0].name, "nerve 2");
  EXPECT_EQ(value.meshes[1].name, "incus");
}

// What is asked about a mesh is asked for its case alone: here that case cannot be shown, and
// another patient's stays open.
TEST_F(Import, AMeshThatIsAskedAboutComesToNoOtherCase)
{
  saveBall("ball");
  writePatient(folder() / "sample");
  const auto mesh = imaging::readMesh(folder() / "sample" / "meshes" / "facial_nerve.obj");
  {
    std::ofstream file(folder() / "facial_nerve.obj"); // right, front, up
    file.imbue(std::locale::classic());
    for (const auto& v : mesh.vertices)
      file << "v " << -v[0] << " " << -v[1] << " " << v[2] << "\n";
    for (const auto& t : mesh.triangles)
      file << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  }
  openWindow();
  auto* documents = window().findChild<CaseDocumentController*>();
  ASSERT_NE(documents, nullptr);
  int asked = 0;
  documents->mayDropDraft = [&asked] { return ++asked == 1; }; // a draft was begun meanwhile
  bool isDone = false;
  onDialog(
      [&isDone](QDialog& dialog)
      {
        if (auto* add = buttonOf(dialog, "RAS"))
        {
          add->click();
          return false;
        }
        isDone = textOf(dialog).contains("facial_nerve.obj");
        dialog.reject();
        return isDone;
      });
  QMimeData data;
  const auto url = [](const fs::path& path)
  { return QUrl::fromLocalFile(QString::fromStdString(path.string())); };
  data.setUrls({url(folder() / "sample" / "ct"), url(folder() / "facial_nerve.obj")});
  drop(data);
  ASSERT_TRUE(waitFor([&] { return isDone; }));
  EXPECT_TRUE(settled());
  documents->mayDropDraft = nullptr;
  EXPECT_EQ(window().model().value().name, "ball");
  EXPECT_TRUE(window().model().value().meshes.empty());
  EXPECT_TRUE(library().open("ball").meshes.empty());
  ASSERT_TRUE(library().contains("ct"));
  EXPECT_TRUE(library().open("ct").meshes.empty());
}

// A CT and an MR that lost their headers: each is asked about, and the labels follow the CT.
TEST_F(Import, AFileThatDoesNotSayWhichSideIsLeftIsAskedAbout)
{
  const auto ball = ballCase("x");
  const auto dropPlace = [this](const char* name)
  {
    std::fstream file(folder() / name, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(252); // qform_code, sform_code
    file.write("\0\0\0\0", 4);
  };
  imaging::writeVolume(folder() / "ear.nii", *ball.ct.volume.get());
  imaging::writeLabelFile(folder() / "nerve.nii", *ball.labels[0].labels.get());
  dropPlace("ear.nii");
  dropPlace("nerve.nii");
  fs::copy_file(folder() / "ear.nii", folder() / "t2.nii");
  openWindow();
  QString asked;
  const auto answer = [&](const QString& button)
  {
    return [&asked, button](QDialog& dialog)
    {
      if (auto* add = buttonOf(dialog, "Add to"))
      {
        add->click();
        return false;
      }
      if (dialog.objectName() != "askSide")
        return false;
      asked = textOf(dialog);
      EXPECT_EQ(static_cast<QMessageBox&>(dialog).defaultButton()->text().remove('&'), "Cancel");
      buttonOf(dialog, button)->click();
      return true;
    };
  };
  onDialog(answer("Cancel"));
  dropPath(folder() / "ear.nii");
  ASSERT_TRUE(waitFor([&] { return !asked.isEmpty(); }));
  EXPECT_TRUE(settled());
  EXPECT_FALSE(window().model().hasCase());
  asked.clear();
  onDialog(answer("LPS"));
  dropPath(folder() / "ear.nii");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase(); }));
  EXPECT_TRUE(settled());
  const auto& grid = window().model().value().ct.geometry;
  EXPECT_GT(grid.patientFromVoxel({1, 0, 0})[0], grid.patientFromVoxel({0, 0, 0})[0]) << "left";
  asked.clear();
  onDialog(
      [](QDialog& dialog)
      {
        auto* add = buttonOf(dialog, "Add to");
        if (add)
          add->click();
        return add != nullptr;
      });
  dropPath(folder() / "nerve.nii");
  ASSERT_TRUE(waitFor([this] { return window().model().value().labels.size() == 1; }));
  EXPECT_TRUE(
      core::sameGrid(window().model().value().labels[0].labels.get()->voxels->geometry(), grid));
  EXPECT_TRUE(settled());
  onDialog(answer("RAS"));
  for (QAction* action : window().findChildren<QAction*>())
    if (action->text().remove('&') == QString::fromUtf8("Add MR file…"))
    {
      onDialog(
          [this](QDialog& dialog)
          {
            auto* files = qobject_cast<QFileDialog*>(&dialog);
            if (!files)
              return false;
            files->findChild<QLineEdit*>("fileNameEdit")
                ->setText(QString::fromStdString((folder() / "t2.nii").string()));
            static_cast<QDialog&>(*files).accept();
            return true;
          });
      action->trigger();
    }
  ASSERT_TRUE(waitFor([this] { return window().model().value().mr.size() == 1; }));
  EXPECT_TRUE(asked.contains("t2.nii")) << asked.toStdString();
  const auto& mr = window().model().value().mr[0].geometry;
  EXPECT_LT(mr.patientFromVoxel({1, 0, 0})[0], mr.patientFromVoxel({0, 0, 0})[0]) << "right";
  EXPECT_TRUE(settled());
}

TEST_F(Import, AnMrOfAnotherPatientIsAskedAbout)
{
  const auto ball = ballCase("x");
  const auto write =
      [&](const char* name, const char* id, imaging::SeriesDescription::Modality modality)
  {
    imaging::SeriesDescription series;
    series.modality = modality;
    series.patientId = id;
    series.studyUid = std::string("1.2.3.") + id;
    series.seriesUid = series.studyUid + ".4";
    series.frameOfReferenceUid = series.studyUid + ".9";
    imaging::writeDicomSeries(folder() / name, *ball.ct.volume.get(), series);
  };
  write("ct", "4711", imaging::SeriesDescription::Modality::Ct);
  write("mr", "4712", imaging::SeriesDescription::Modality::Mr);
  openWindow();
  dropPath(folder() / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  for (const char* answer : {"Cancel", "It is this"})
  {
    EXPECT_TRUE(window().model().value().mr.empty());
    const QString asked = askedOnDrop(folder() / "mr", "askOtherPatient", answer);
    ASSERT_FALSE(asked.isEmpty());
    EXPECT_FALSE(asked.contains("471")) << "a patient's ID";
    EXPECT_TRUE(asked.contains("What differs: patient ID.")) << asked.toStdString();
    EXPECT_TRUE(settled());
  }
  ASSERT_TRUE(waitFor([this] { return window().model().value().mr.size() == 1; }));
  EXPECT_TRUE(settled());
  // The note of it goes with the MR.
  auto* banner = window().findChild<Banner*>("notesBanner");
  ASSERT_TRUE(waitFor([banner] { return banner->isVisible(); }));
  EXPECT_TRUE(banner->text().contains("added as asked")) << banner->text().toStdString();
  const std::string mr = window().model().value().mr[0].name;
  const_cast<presenters::WorkstationModel&>(window().model()).removePart(mr);
  EXPECT_FALSE(banner->isVisible()) << banner->text().toStdString();
}

// The name of a case is its file's, and goes along wherever it is sent.
TEST_F(Import, ACaseIsNotNamedAfterThePatient)
{
  const auto ball = ballCase("x");
  imaging::SeriesDescription series;
  series.modality = imaging::SeriesDescription::Modality::Ct;
  series.patientName = "Mustermann^Erika";
  series.studyUid = "1.2.3.1";
  series.seriesUid = "1.2.3.1.4";
  series.frameOfReferenceUid = "1.2.3.1.9";
  openWindow();
  const std::pair<const char*, const char*> cases[] = {
      {"erika mustermann", "case"}, {"DOE_JOHN_19500101", "case 2"}, {"left ear", "left ear"}};
  for (const auto& [name, called] : cases)
  {
    imaging::writeDicomSeries(folder() / name, *ball.ct.volume.get(), series);
    dropPath(folder() / name);
    ASSERT_TRUE(waitFor(
        [&, name = called]
        {
          return window().model().hasCase() && window().model().value().name == name &&
                 !window().busy();
        }))
        << called;
    const auto says = [this]
    { return window().statusBar()->currentMessage().contains("may be the patient's"); };
    EXPECT_TRUE(settled());
    EXPECT_EQ(waitFor(says, 1000), QString(called).startsWith("case")) << "also when it is saved";
  }
}

TEST_F(Import, LabelsOnAnotherGridThanARepairedCtAreAskedAbout)
{
  scene::Case ball = ballCase("ball");
  ball.labels.clear();
  ball.ct.provenance.shift = 20.0;
  library().save(ball);
  const core::GridGeometry& ct = ball.ct.geometry;
  const auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(
      core::GridGeometry({12, 12, 12}, Eigen::Vector3d::Constant(0.8), ct.origin()),
      std::uint16_t{1});
  volume::Segment vein;
  vein.name = "vein";
  vein.index = 1;
  imaging::writeLabelFile(folder() / "vein.seg.nrrd", volume::makeLabelMap(voxels, {vein}));
  openWindow("ball");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  for (const char* answer : {"Cancel", "Add it as it lies"})
  {
    EXPECT_TRUE(window().model().value().labels.empty());
    const QString asked = askedOnDrop(folder() / "vein.seg.nrrd", "askAsTheyLie", answer);
    ASSERT_FALSE(asked.isEmpty());
    EXPECT_TRUE(settled());
    EXPECT_TRUE(asked.contains("20.0 mm")) << asked.toStdString();
  }
  ASSERT_TRUE(waitFor([this] { return window().model().value().labels.size() == 1; }));
}

// From the same CT in another library: new identifiers, the same place.
TEST_F(Import, ASegmentationOfAnotherFrameIsAskedAbout)
{
  const auto ball = ballCase("x");
  imaging::SeriesDescription series;
  series.modality = imaging::SeriesDescription::Modality::Ct;
  series.studyUid = "1.2.3.1";
  series.seriesUid = "1.2.3.1.4";
  series.frameOfReferenceUid = "1.2.3.1.9";
  imaging::writeDicomSeries(folder() / "ct", *ball.ct.volume.get(), series);
  imaging::SegmentationDescription segmentation;
  segmentation.studyUid = "1.2.3.2";
  segmentation.seriesUid = "1.2.3.2.4";
  segmentation.frameOfReferenceUid = "1.2.3.2.9";
  imaging::SegmentationDescription::Segment segment;
  segment.index = ball.labels[0].structures[0].index;
  segment.label = "vein";
  segmentation.segments = {segment};
  imaging::writeDicomSegmentation(folder() / "seg.dcm", {*ball.labels[0].labels.get()},
                                  segmentation);
  openWindow();
  dropPath(folder() / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  for (const char* answer : {"Cancel", "On the CT"})
  {
    EXPECT_TRUE(window().model().value().labels.empty());
    const QString asked = askedOnDrop(folder() / "seg.dcm", "askDrawnOn", answer);
    ASSERT_FALSE(asked.isEmpty());
    EXPECT_TRUE(settled());
  }
  ASSERT_TRUE(waitFor([this] { return window().model().value().labels.size() == 1; }));
  EXPECT_EQ(window().model().value().labels[0].structures[0].voxels,
            ball.labels[0].structures[0].voxels);
  EXPECT_TRUE(settled());
}

// A file name may be a patient's; only the user knows what the structure is.
TEST_F(Import, AStructureWithoutANameIsAskedForOne)
{
  saveBall("ball");
  writePatient(folder() / "sample");
  fs::copy(folder() / "sample/meshes/incus.obj", folder() / "Doe John.obj");
  openWindow();
  QString asked;
  onDialog(
      [&asked](QDialog& dialog)
      {
        auto* name = dialog.findChild<QLineEdit*>("partName");
        if (!name)
          return false;
        asked = textOf(dialog);
        auto* add = buttonOf(dialog, "Add to");
        EXPECT_TRUE(name->text().isEmpty()) << name->text().toStdString();
        EXPECT_FALSE(add->isEnabled()) << "nothing of the file's name is kept";
        name->setText("nerve");
        EXPECT_FALSE(add->isEnabled()) << "taken";
        name->setText("tumour");
        EXPECT_TRUE(add->isEnabled());
        add->click();
        return true;
      });
  dropPath(folder() / "Doe John.obj");
  ASSERT_TRUE(waitFor([this] { return !window().model().value().meshes.empty(); }));
  EXPECT_TRUE(asked.contains("Doe John.obj")) << asked.toStdString();
  EXPECT_EQ(window().model().value().meshes[0].name, "tumour");
  EXPECT_TRUE(settled());
}

// What was assumed about a file stays visible until acknowledged.
TEST_F(Import, WhatWasAssumedIsToldUntilSomebodyHasReadIt)
{
  const fs::path file = folder() / "beam.nrrd";
  auto image = std::make_shared<volume::Volume<std::int16_t>>(ballCase("x").ct.geometry);
  for (std::size_t n = 0; n < image->size(); ++n) // starts at 0: no Hounsfield units
    image->data()[n] = static_cast<std::int16_t>(n % 64 < 32 ? n % 97 : 2000 + n * 7919 % 3001);
  imaging::writeVolume(file, *image);
  openWindow();
  answered([this](const auto& react) { onDialog(react); }, "CT", [&] { dropPath(file); });
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  auto* banner = window().findChild<Banner*>("notesBanner");
  ASSERT_TRUE(banner);
  EXPECT_TRUE(banner->isVisible());
  EXPECT_TRUE(banner->text().contains("not Hounsfield units")) << banner->text().toStdString();
  banner->findChild<QPushButton*>("dismissNotes")->click();
  EXPECT_FALSE(banner->isVisible());
}

// Not once only: nobody sees from the picture that it is mirrored.
TEST_F(Import, ASideThatWasAssumedIsToldWheneverTheCaseIsOpened)
{
  scene::Case value = ballCase("ball");
  value.ct.provenance.assumedRas = true;
  library().save(value);
  for (int n = 0; n < 2; ++n)
  {
    openWindow();
    auto* banner = window().findChild<Banner*>("notesBanner");
    ASSERT_TRUE(waitFor([banner] { return banner->isVisible(); }));
    EXPECT_TRUE(banner->text().contains("CT: left and right taken as RAS axes"))
        << banner->text().toStdString();
    banner->findChild<QPushButton*>("dismissNotes")->click();
    closeWindow();
  }
}

TEST_F(Import, NotesOfOneTextAreOneLine)
{
  scene::Case value = ballCase("ball");
  value.ct.notes = {"partly read", "dark"};
  ASSERT_EQ(value.meshes.size(), 0U);
  core::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (int n = 1; n <= 5; ++n)
  {
    scene::MeshPart part;
    part.name = "part_" + std::to_string(n);
    part.triangles = mesh.triangles.size();
    part.mesh = std::make_shared<const core::TriangleMesh>(mesh);
    part.notes = {"dark"};
    if (n > 3)
      part.notes.emplace_back("open");
    value.meshes.push_back(part);
  }
  library().save(value);
  openWindow();
  auto* banner = window().findChild<Banner*>("notesBanner");
  ASSERT_TRUE(waitFor([banner] { return banner->isVisible(); }));
  EXPECT_EQ(banner->shownText().split('\n'),
            (QStringList{"CT: partly read", "CT, part 1 and 4 more: dark", "part 4: open",
                         "part 5: open"}));
  EXPECT_EQ(banner->text().split('\n').size(), 2 + 5 + 2);
  EXPECT_EQ(banner->findChild<QLabel*>()->toolTip(), banner->text());
}

TEST_F(Import, WhatWasNotedIsToldWheneverTheCaseIsOpenedUntilItsPartIsTakenOut)
{
  scene::Case value = ballCase("ball");
  value.ct.notes = {"Slice 7 is interpolated between its neighbours."};
  ASSERT_EQ(value.labels.size(), 1U);
  value.labels[0].notes = {"partly outside the CT"};
  library().save(value);
  for (int n = 0; n < 2; ++n)
  {
    openWindow();
    auto* banner = window().findChild<Banner*>("notesBanner");
    ASSERT_TRUE(waitFor([banner] { return banner->isVisible(); }));
    const QStringList lines = banner->text().split('\n');
    EXPECT_EQ(lines.size(), 2) << banner->text().toStdString();
    EXPECT_TRUE(lines.contains("CT: Slice 7 is interpolated between its neighbours."))
        << banner->text().toStdString();
    EXPECT_TRUE(lines.contains("nerve: partly outside the CT")) << banner->text().toStdString();
    if (n == 0)
    {
      banner->findChild<QPushButton*>("dismissNotes")->click();
      EXPECT_FALSE(banner->isVisible());
      closeWindow();
      continue;
    }
    const_cast<presenters::WorkstationModel&>(window().model()).removePart("nerve");
    EXPECT_EQ(banner->text(), "CT: Slice 7 is interpolated between its neighbours.");
  }
}

TEST_F(Import, ATiltedScanIsStraightenedOnlyWithConsent)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  options.tilt = 12.0;
  petrous::testing::writeSharedSample(folder() / "tilted", options);
  openWindow();
  const auto drop = [this](const QString& button)
  {
    const QString asked = answered([this](const auto& react) { onDialog(react); }, button,
                                   [this] { dropPath(folder() / "tilted" / "ct"); });
    EXPECT_TRUE(asked.contains("12.0 degrees")) << asked.toStdString();
    EXPECT_FALSE(asked.contains("--repair")) << asked.toStdString();
    ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
  };
  drop("Cancel");
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
  drop("Repair and open");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto& notes = window().model().value().ct.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                          [](const std::string& note)
                          { return note.find("tilt of 12.0 degrees") != std::string::npos; }));
}

// A thick sound CT beside the thin one that was meant.
TEST_F(Import, ASoundSeriesIsNotTakenUnaskedBesideOneThatNeedsRepair)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  options.tilt = 12.0;
  petrous::testing::writeSharedSample(folder() / "sample", options);
  fs::create_directories(folder() / "visit");
  fs::rename(folder() / "sample" / "ct", folder() / "visit" / "thin");
  const auto voxels = std::make_shared<volume::Volume<std::int16_t>>(
      core::GridGeometry({32, 32, 12}, Eigen::Vector3d(2, 2, 5), Eigen::Vector3d::Zero()),
      std::int16_t{40});
  voxels->at(1, 2, 3) = 400;
  const std::shared_ptr<const volume::Volume<std::int16_t>> thick = voxels;
  imaging::SeriesDescription series;
  series.studyUid = "1.2.3";
  series.seriesUid = "1.2.3.4";
  series.frameOfReferenceUid = "1.2.3.9";
  imaging::writeDicomSeries(folder() / "visit" / "thick", volume::IntensityVolume(thick), series);
  openWindow();
  QStringList verdicts;
  onDialog(
      [&verdicts](QDialog& dialog)
      {
        auto* list = dialog.findChild<QTreeWidget*>("series");
        if (!list)
          return false;
        for (int n = 0; n < list->topLevelItemCount(); ++n)
          verdicts += list->topLevelItem(n)->text(list->columnCount() - 2); // before the axes
        dialog.reject();
        return true;
      });
  dropPath(folder() / "visit");
  ASSERT_TRUE(waitFor([&] { return !verdicts.isEmpty(); }));
  verdicts.sort();
  EXPECT_EQ(verdicts, QStringList({"needs repair", "sound"}));
  EXPECT_TRUE(settled());
  EXPECT_FALSE(window().model().hasCase());

  presenters::CaseSources sources; // by the command
  sources.ct = folder() / "visit";
  try
  {
    presenters::buildCase("ear", sources, {});
    ADD_FAILURE() << "taken unasked";
  }
  catch (const imaging::DicomError& error)
  {
    EXPECT_EQ(error.reason(), imaging::DicomError::Reason::Ambiguous);
    EXPECT_NE(std::string(error.what()).find("needs --repair"), std::string::npos) << error.what();
  }
  // One that is no finer is named, and left.
  fs::remove_all(folder() / "visit" / "thin");
  const auto other = std::make_shared<const volume::Volume<std::int16_t>>(
      core::GridGeometry({32, 32, 9}, Eigen::Vector3d(2, 2, 5), Eigen::Vector3d::Zero()),
      std::int16_t{40});
  series.seriesUid = "1.2.3.5";
  imaging::writeDicomSeries(folder() / "visit" / "gap", volume::IntensityVolume(other), series);
  std::vector<fs::path> slices(fs::directory_iterator(folder() / "visit" / "gap"), {});
  std::sort(slices.begin(), slices.end());
  fs::remove(slices.at(4));
  const scene::Case value = presenters::buildCase("ear", sources, {});
  EXPECT_EQ(value.ct.geometry.dims()[2], 12);
  EXPECT_TRUE(std::any_of(value.ct.notes.begin(), value.ct.notes.end(),
                          [](const std::string& note)
                          { return note.find("8 slices") != std::string::npos; }));
}

namespace
{

void trigger(QWidget& window, const char* text)
{
  for (QAction* action : window.findChildren<QAction*>())
    if (action->text().remove('&') == QString::fromUtf8(text))
      return action->trigger();
  ADD_FAILURE() << text;
}

void choose(QFileDialog& dialog, const fs::path& path)
{
  dialog.findChild<QLineEdit*>("fileNameEdit")->setText(QString::fromStdString(path.string()));
  static_cast<QDialog&>(dialog).accept();
}

bool hasColor(const QImage& image, const QColor& color)
{
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (image.pixelColor(x, y) == color)
        return true;
  return false;
}

void keepPicture(QWidget& widget, const char* name)
{
  const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES"); // for visual inspection
  if (!pictures.isEmpty())
    widget.grab().save(QString("%1/%2.png").arg(pictures, name));
}

} // namespace

// One slice of the stack is gone: the page shows it, and so does the case.
// In words, by the name of the series; what identifies it to a machine is behind a button.
TEST_F(Import, AScanThatCannotBeUsedIsRefusedWithWhatCanBeDone)
{
  writePatient(folder() / "sample");
  std::vector<fs::path> slices;
  for (const auto& entry : fs::directory_iterator(folder() / "sample" / "ct"))
    slices.push_back(entry.path());
  std::sort(slices.begin(), slices.end());
  for (std::size_t n = 0; n < 4; ++n)
    fs::remove(slices[slices.size() / 2 + n]);
  openWindow();
  QString text, advice, details;
  onMessage(
      [&](QMessageBox& box)
      {
        EXPECT_EQ(box.objectName(), "seriesRefused") << box.text().toStdString();
        text = box.text();
        advice = box.informativeText();
        details = box.detailedText();
        keepPicture(box, "refused");
        box.reject();
      });
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([&] { return !text.isEmpty(); }));
  EXPECT_TRUE(settled());
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(text.contains("Temporal bone") && text.contains("ct")) << text.toStdString();
  EXPECT_TRUE(advice.contains("missing") && advice.contains("Library > Receive"))
      << advice.toStdString();
  for (const QString& told : {text, advice})
    EXPECT_FALSE(told.contains("missing-slice") || told.contains("2.25.")) << told.toStdString();
  EXPECT_TRUE(details.contains("missing-slice") && details.contains("sample/ct"))
      << details.toStdString();
}

TEST_F(Import, TheRepairPageShowsBeforeAndAfterAndTheCaseMarksWhatWasGuessed)
{
  writePatient(folder() / "sample");
  std::vector<fs::path> slices;
  for (const auto& entry : fs::directory_iterator(folder() / "sample" / "ct"))
    slices.push_back(entry.path());
  std::sort(slices.begin(), slices.end());
  fs::remove(slices[slices.size() / 2]);
  openWindow();
  QString remains;
  onDialog(
      [&](QDialog& dialog)
      {
        auto* page = qobject_cast<RepairDialog*>(&dialog);
        if (!page || !page->isPictured())
          return false;
        auto* before = dialog.findChild<SliceView*>("before");
        auto* after = dialog.findChild<SliceView*>("after");
        if (!before->isVisible() || !after->isVisible())
          return false;
        remains = dialog.findChild<QLabel*>("remains")->text();
        const QImage one = before->grab().toImage();
        const QImage other = after->grab().toImage();
        EXPECT_GT(pixelsUnlikeTheCorner(one), one.width() * one.height() / 20);
        EXPECT_GT(differentPixels(one, other), one.width() * one.height() / 100);
        keepPicture(dialog, "repair");
        buttonOf(dialog, "Repair and open")->click();
        return true;
      });
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  EXPECT_TRUE(remains.contains("missing from the files")) << remains.toStdString();
  EXPECT_TRUE(
      window().findChild<Banner*>("notesBanner")->text().contains("missing from the files"));
  const scene::Case& value = window().model().value();
  ASSERT_EQ(volume::sliceCount(value.ct.provenance.interpolated), 1);
  const int guessed = value.ct.provenance.interpolated[0].first;
  auto* axial = window().findChild<SliceView*>("axialView");
  auto* coronal = window().findChild<SliceView*>("coronalView");
  const QColor mark("#ff8c2b");
  const auto showSlice = [&](int slice)
  {
    Eigen::Vector3d voxel = value.ct.geometry.voxelFromPatient(value.ct.geometry.center());
    voxel[2] = slice;
    for (SliceView* view : {axial, coronal})
      view->setCrosshair(value.ct.geometry.patientFromVoxel(voxel));
  };
  showSlice(guessed);
  EXPECT_TRUE(hasColor(axial->grab().toImage(), mark));
  keepPicture(*axial, "interpolated-axial");
  keepPicture(*coronal, "interpolated-coronal");
  showSlice(guessed + 2);
  EXPECT_FALSE(hasColor(axial->grab().toImage(), mark));
  const QImage marked = coronal->grab().toImage();
  coronal->setInterpolated({});
  EXPECT_GT(differentPixels(marked, coronal->grab().toImage(), 8), coronal->width() / 4);
  // In the 3D view a line says it.
  const auto* note = view().findChild<QLabel*>("guessed");
  ASSERT_NE(note, nullptr);
  EXPECT_TRUE(note->isVisible());
  EXPECT_EQ(note->text(), QString("CT: slice %1 interpolated").arg(guessed + 1));
}

TEST_F(Import, OneSliceStandsForItsSeries)
{
  writePatient(folder() / "sample");
  openWindow();
  dropPath(fs::directory_iterator(folder() / "sample" / "ct")->path());
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto count =
      std::distance(fs::directory_iterator(folder() / "sample" / "ct"), fs::directory_iterator());
  EXPECT_EQ(window().model().value().ct.geometry.dims()[2], count);
}

TEST_F(Import, ARegionIsDrawnBeforeTheScanIsRead)
{
  writePatient(folder() / "sample");
  openWindow();
  core::PatientBox box;
  const auto openRegion = [&](const std::function<void(RegionDialog&)>& act)
  {
    onDialog(
        [&, act](QDialog& dialog)
        {
          if (auto* files = qobject_cast<QFileDialog*>(&dialog))
          {
            choose(*files, folder() / "sample" / "ct");
            return false;
          }
          auto* region = qobject_cast<RegionDialog*>(&dialog);
          if (region)
          {
            EXPECT_EQ(
                region->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->isEnabled(),
                region->isPictured());
          }
          if (!region || !region->isPictured() ||
              !region->findChild<SliceView*>("axialView")->isVisible())
            return false;
          EXPECT_FALSE(region->region()) << "all of it, unless the user says otherwise";
          act(*region);
          return true;
        });
    trigger(window(), "Open a region…");
    EXPECT_TRUE(waitFor([this] { return !window().busy(); }));
  };
  {
    // Its picture comes with an event at the earliest.
    const RegionDialog early(folder() / "sample" / "ct", {}, false);
    EXPECT_FALSE(early.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->isEnabled());
  }
  openRegion([](RegionDialog& dialog) { dialog.reject(); });
  EXPECT_FALSE(window().model().hasCase());
  openRegion(
      [&](RegionDialog& dialog)
      {
        const QString whole = dialog.findChild<QLabel*>("regionSize")->text();
        auto* left = dialog.findChild<QDoubleSpinBox*>("x0");
        left->setValue(left->minimum() + 12.0);
        // The axial view's lower edge is posterior: dragged up by 60 pixels.
        auto* view = dialog.findChild<SliceView*>("axialView");
        const auto slice = view->slice();
        const Eigen::Vector3d back = dialog.region()->max();
        const Eigen::Vector2d edge = slice.pixelFromPatient(back);
        const QPoint from(view->width() / 2, static_cast<int>(edge[1]));
        QTest::mousePress(view, Qt::LeftButton, Qt::NoModifier, from);
        QMouseEvent move(QEvent::MouseMove, from - QPoint(0, 60), Qt::LeftButton, Qt::LeftButton,
                         Qt::NoModifier);
        QApplication::sendEvent(view, &move);
        QTest::mouseRelease(view, Qt::LeftButton, Qt::NoModifier, from - QPoint(0, 60));
        ASSERT_TRUE(dialog.region());
        box = *dialog.region();
        EXPECT_NEAR(box.max()[1], back[1] - 60 * slice.mmPerPixel(), 1e-6);
        EXPECT_EQ(box.max()[0], back[0]);
        const QString part = dialog.findChild<QLabel*>("regionSize")->text();
        EXPECT_NE(part, whole);
        EXPECT_TRUE(part.contains("million voxels") && part.contains("MB")) << part.toStdString();
        keepPicture(dialog, "region");
        dialog.findChild<QPushButton*>("wholeScan")->click();
        EXPECT_FALSE(dialog.region());
        EXPECT_EQ(dialog.findChild<QLabel*>("regionSize")->text(), whole);
        for (int n = 0; n < 6; ++n)
          dialog.findChild<QDoubleSpinBox*>(QString("%1%2").arg("xyz"[n / 2]).arg(n % 2))
              ->setValue(n % 2 == 0 ? box.min()[n / 2] : box.max()[n / 2]);
        box = *dialog.region(); // in the boxes' tenths of a millimetre
        dialog.accept();
      });
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  presenters::CaseSources sources;
  sources.ct = folder() / "sample" / "ct";
  sources.roi = box; // as --roi
  const auto truth = presenters::buildCase("truth", sources, {});
  EXPECT_TRUE(core::sameGrid(window().model().value().ct.geometry, truth.ct.geometry));
  sources.roi.reset();
  EXPECT_LT(truth.ct.geometry.voxelCount(),
            presenters::buildCase("whole", sources, {}).ct.geometry.voxelCount());
}

TEST_F(Import, ARegionOfAnMrIsDrawnBeforeItComesToTheOpenCase)
{
  writePatient(folder() / "sample");
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  core::PatientBox box;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* files = qobject_cast<QFileDialog*>(&dialog))
        {
          choose(*files, folder() / "sample" / "mr");
          return false;
        }
        if (auto* region = qobject_cast<RegionDialog*>(&dialog); region && region->isPictured())
        {
          EXPECT_TRUE(region->windowTitle().contains("MR")) << region->windowTitle().toStdString();
          auto* left = dialog.findChild<QDoubleSpinBox*>("x0");
          left->setValue(left->minimum() + 12.0);
          box = *region->region();
          region->accept();
          return false;
        }
        auto* add = buttonOf(dialog, "Add to");
        if (!add)
          return false;
        add->click();
        return true;
      });
  trigger(window(), "Open a region…");
  ASSERT_TRUE(waitFor([this] { return window().model().value().mr.size() == 1; }));
  EXPECT_TRUE(settled());
  presenters::CaseSources sources;
  sources.ct = folder() / "sample" / "mr";
  sources.modality = scene::Modality::Mr;
  const auto whole = presenters::buildCase("whole", sources, {}).ct.geometry;
  const core::GridGeometry& grid = window().model().value().mr[0].geometry;
  EXPECT_EQ(grid.voxelCount(), whole.boxCovering(box.min(), box.max()).count());
  EXPECT_LT(grid.voxelCount(), whole.voxelCount());
}

TEST_F(Import, ARegionOfAFileIsDrawnBeforeItIsRead)
{
  imaging::writeVolume(folder() / "ear.nii", *ballCase("x").ct.volume.get());
  openWindow();
  core::PatientBox box;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* files = qobject_cast<QFileDialog*>(&dialog))
        {
          choose(*files, folder() / "ear.nii");
          return false;
        }
        auto* region = qobject_cast<RegionDialog*>(&dialog);
        if (!region || !region->isPictured())
          return false;
        auto* left = dialog.findChild<QDoubleSpinBox*>("x0");
        left->setValue(left->minimum() + 12.0);
        box = *region->region();
        region->accept();
        return true;
      });
  trigger(window(), "Open a region of a file…");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto whole = ballCase("x").ct.geometry;
  const auto& grid = window().model().value().ct.geometry;
  EXPECT_LT(grid.dims()[0], whole.dims()[0]);
  EXPECT_EQ(grid.dims()[2], whole.dims()[2]);
  const core::IndexBox expected = whole.boxCovering(box.min(), box.max());
  EXPECT_EQ(grid.voxelCount(), expected.count());
}

// By the Case menu: the file dialog offers DICOM for labels, the names can be edited, and the panel
// with what came is in front.
TEST_F(Import, PartsComeByTheCaseMenu)
{
  writePatient(folder() / "sample");
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  QStringList filters;
  const auto add = [&](const char* entry, const QString& file, const QString& name)
  {
    onDialog(
        [&, file, name](QDialog& dialog)
        {
          if (auto* files = qobject_cast<QFileDialog*>(&dialog))
          {
            filters = files->nameFilters();
            choose(*files, folder() / "sample" / file.toStdString());
            return false;
          }
          auto* button = buttonOf(dialog, "Add to");
          if (!button)
            return false;
          if (!name.isEmpty())
            dialog.findChild<QLineEdit*>("partName")->setText(name);
          keepPicture(dialog, "add");
          button->click();
          return true;
        });
    trigger(window(), entry);
    EXPECT_TRUE(waitFor([this] { return !window().busy(); }));
  };
  const auto isInFront = [this](const char* dock)
  { return !window().findChild<QDockWidget*>(dock)->visibleRegion().isEmpty(); };
  add("Add MR…", "mr", "T2 of 2024");
  ASSERT_TRUE(waitFor([this] { return window().model().value().mr.size() == 1; }));
  EXPECT_EQ(window().model().value().mr[0].name, "T2 of 2024");
  EXPECT_TRUE(waitFor([&] { return isInFront("registrationDock"); }));
  add("Add labels…", "labels.seg.nrrd", {});
  ASSERT_TRUE(waitFor([this] { return !window().model().value().labels.empty(); }));
  EXPECT_TRUE(filters.join(' ').contains("*.dcm")) << filters.join(' ').toStdString();
  EXPECT_TRUE(waitFor([&] { return isInFront("structuresDock"); }));
  EXPECT_FALSE(isInFront("registrationDock"));
  EXPECT_TRUE(settled());
  // What is something else is said to be.
  QString told;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* files = qobject_cast<QFileDialog*>(&dialog))
        {
          choose(*files, folder() / "sample" / "ct");
          return false;
        }
        told = textOf(dialog);
        dialog.accept();
        return true;
      });
  trigger(window(), "Add MR…");
  ASSERT_TRUE(waitFor([&told] { return !told.isEmpty(); }));
  EXPECT_TRUE(told.contains("CT") && told.contains("MR")) << told.toStdString();
  EXPECT_EQ(window().model().value().mr.size(), 1u);
  EXPECT_TRUE(settled());
}

TEST_F(Import, StructuresAreTakenOutPutBackAndRenamed)
{
  saveBall("ball");
  openWindow();
  auto* list = window().findChild<QTreeView*>("structures");
  const auto structures = [this]
  {
    QStringList names;
    for (const auto& part : window().model().value().labels)
      for (const auto& structure : part.structures)
        names += QString::fromStdString(structure.name);
    return names;
  };
  const auto press = [&](int key)
  {
    QApplication::setActiveWindow(&window());
    list->setFocus();
    list->setCurrentIndex(structureCell(structures().value(0).toStdString()));
    QTest::keyClick(list, static_cast<Qt::Key>(key));
  };
  press(Qt::Key_Delete);
  EXPECT_TRUE(structures().isEmpty());
  EXPECT_TRUE(settled());
  EXPECT_TRUE(library().open("ball").labels.empty());
  auto* banner = window().findChild<Banner*>("removedBanner");
  EXPECT_TRUE(banner->isVisible());
  EXPECT_TRUE(banner->text().contains("nerve")) << banner->text().toStdString();
  banner->findChild<QPushButton*>("restorePart")->click();
  EXPECT_EQ(structures(), QStringList{"nerve"});
  EXPECT_FALSE(banner->isVisible());
  EXPECT_TRUE(settled());
  EXPECT_EQ(library().open("ball").labels.size(), 1u);
  EXPECT_EQ(library().open("ball").labels[0].labels.get()->segments.front().voxels,
            window().model().value().labels[0].structures[0].voxels);
  onDialog(
      [](QDialog& dialog)
      {
        auto* ask = qobject_cast<QInputDialog*>(&dialog);
        if (!ask)
          return false;
        ask->setTextValue("facial nerve");
        ask->accept();
        return true;
      });
  press(Qt::Key_F2);
  EXPECT_EQ(structures(), QStringList{"facial nerve"});
  EXPECT_TRUE(settled());
  EXPECT_EQ(library().open("ball").labels[0].structures[0].name, "facial nerve");
}

// A hint for the command line is no help to who has none.
TEST(WindowText, SaysWhatToDoInTheWindow)
{
  for (const char* text :
       {"structure: named so and not as its file, whose name may be a patient's; NAME=FILE gives "
        "another name",
        "x.nii: structure 'a' is in the case already; give it another name with NAME=FILE",
        "x.obj: 'a' is the name of what y.obj gives, too; leave one of them out, or give one "
        "another name with NAME=FILE, or a number with --rename-taken",
        "CT: the surface of bone is put at 5; 'petrous appearance --iso' moves the surface.",
        "MR: The surface is where tissue begins, put at 5 by the image's histogram; what is "
        "drilled is this tissue, not bone. 'petrous appearance --iso' moves the surface.",
        "CT: it is taken for a CT with units of its own, such as cone beam. Build the case with "
        "--modality MR if it is an MR, --modality CT if it is not.",
        "a.stroke: is damaged; restore this file from a copy of the library; 'petrous library "
        "verify' lists all that is damaged",
        "a.nrrd: is no image as this program stores it; 'petrous library verify' lists what is "
        "damaged",
        "a.stroke: is damaged; or go back to before it, which loses nothing: petrous undo 'ear' 12",
        "structure 'a': there is no material 'b'; give it another one (appearance --tissue)",
        "2 files hold many frames in one; a DICOM segmentation is read as structures (--labels).",
        "x: several MR images have its grid; say on which it was drawn with FILE@T2 or FILE@DWI",
        "x: was drawn in another frame of reference than the CT's; if it is this CT's all the "
        "same, "
        "say FILE@ct, or add the MR on which it was drawn",
        "CT: The folder has another CT of 8 slices of 5 mm (needs --repair), which was not taken; "
        "'petrous scan' lists them, --series takes one.",
        "x.nii.gz: could be mirrored; export it again with its geometry, or say --mr-frame ras "
        "(NIfTI's own) or lps (DICOM, ITK) if you know it",
        "x.dcm: states another; look whether it is this patient's, and say --other-patient if it "
        "is "
        "to be added all the same"})
  {
    const QString said = windowText(text);
    EXPECT_FALSE(said.contains("FILE") || said.contains("petrous") || said.contains("--"))
        << said.toStdString();
    EXPECT_TRUE(said.startsWith(QString(text).left(12)));
  }
}

// What was drilled is saved before it is archived; restored beside the first it takes another name,
// and the archive is restored by drop, by the menu and by the start page.
TEST_F(Import, ACaseIsArchivedAndRestored)
{
  saveBall("ball");
  openWindow("ball");
  drill(600);
  const double removed = window().model().value().removedVolume();
  ASSERT_GT(removed, 0.0);
  const fs::path whole = folder() / "whole.petrous";
  const fs::path plan = folder() / "plan.petrous";
  const auto archive = [&](const fs::path& file, int kind, const char* drilled)
  {
    onDialog(
        [&, file, kind](QDialog& dialog)
        {
          if (dialog.objectName() != "archiveCase")
            return false;
          dialog.findChild<QLineEdit*>("archiveFile")
              ->setText(QString::fromStdString(fs::path(file).replace_extension().string()));
          dialog.findChild<QCheckBox*>("archivePlan")->setChecked(kind == 1);
          dialog.findChild<QPushButton*>("primary")->click();
          return true;
        });
    QString told;
    onMessage(
        [&told](QMessageBox& box)
        {
          told = box.text();
          box.accept();
        });
    trigger(window(), "Archive…");
    EXPECT_TRUE(waitFor([&] { return fs::exists(file) && !told.isEmpty() && !window().busy(); }));
    for (const QString& part : QStringList{"ball", QString::fromStdString(file.string()), " MB",
                                           drilled, kind == 0 ? "CT, " : "no images"})
      EXPECT_TRUE(told.contains(part)) << told.toStdString();
  };
  archive(whole, 0, "1 stroke");
  archive(plan, 1, "1 stroke");
  action("Undo")->trigger();
  archive(folder() / "undone.petrous", 0, "0 strokes, and 1 undone");
  action("Redo")->trigger();
  EXPECT_TRUE(settled());
  EXPECT_FALSE(library::inspectArchive(whole).planOnly);
  EXPECT_TRUE(library::inspectArchive(plan).planOnly);
  EXPECT_EQ(library::inspectArchive(whole).name, "ball");

  // A name that the library has is asked for.
  const auto onName = [&](const QString& name)
  {
    onDialog(
        [name](QDialog& dialog)
        {
          auto* ask = qobject_cast<QInputDialog*>(&dialog);
          if (!ask)
            return false;
          EXPECT_EQ(ask->textValue(), "ball 2");
          ask->setTextValue(name);
          ask->accept();
          return true;
        });
  };
  const auto isOpen = [&](const char* name)
  {
    return waitFor(
        [&]
        {
          return window().model().hasCase() && window().model().value().name == name &&
                 !window().busy();
        });
  };
  onName("by drop");
  dropPath(whole);
  ASSERT_TRUE(isOpen("by drop"));
  EXPECT_NEAR(window().model().value().removedVolume(), removed, 1e-9);
  closeWindow();
  library().remove("ball");

  openWindow("by drop");
  onDialog(
      [&](QDialog& dialog)
      {
        auto* files = qobject_cast<QFileDialog*>(&dialog);
        if (files)
          choose(*files, whole);
        return files != nullptr;
      });
  trigger(window(), "Restore…");
  ASSERT_TRUE(isOpen("ball"));

  // A file that is no archive is refused, and what is open stays.
  const fs::path broken = folder() / "broken.petrous";
  std::ofstream(broken) << "no zip";
  QString why;
  onMessage(
      [&](QMessageBox& box)
      {
        why = box.text();
        box.accept();
      });
  dropPath(broken);
  ASSERT_TRUE(waitFor([&] { return !why.isEmpty() && !window().busy(); }));
  EXPECT_TRUE(why.contains("broken.petrous")) << why.toStdString();
  EXPECT_TRUE(isOpen("ball"));
  closeWindow();
}

// By the dialog of the Case menu; the voxels are those of the case, and what is there is replaced
// only with consent.
TEST_F(Import, APartIsExportedForOtherPrograms)
{
  saveBall("ball");
  openWindow("ball");
  const fs::path ct = folder() / "out.nrrd";
  const auto write = [&](const char* what, const char* ending, const fs::path& path)
  {
    onDialog(
        [&, what, ending, path](QDialog& dialog)
        {
          if (dialog.objectName() != "exportCase")
            return false;
          const auto pick = [&](const char* box, const char* data)
          {
            auto* choice = dialog.findChild<QComboBox*>(box);
            choice->setCurrentIndex(choice->findData(QString(data)));
            EXPECT_EQ(choice->currentData().toString(), data);
          };
          pick("exportWhat", what);
          pick("exportFormat", ending);
          auto* place = dialog.findChild<QLineEdit*>("exportPath");
          auto* button = dialog.findChild<QPushButton*>("primary");
          EXPECT_TRUE(button->isEnabled()) << "what is proposed can be written";
          place->setText(QString::fromStdString((folder() / "nowhere" / "x").string()));
          EXPECT_FALSE(button->isEnabled());
          place->setText(QString::fromStdString((folder() / "x.seg").string()) + ending);
          EXPECT_EQ(button->isEnabled(), ending != std::string(".nrrd")) << "is for structures";
          place->setText(QString::fromStdString(path.string()));
          keepPicture(dialog, "export");
          EXPECT_TRUE(button->isEnabled());
          button->click();
          return true;
        });
    QString told;
    onMessage(
        [&told](QMessageBox& box)
        {
          told = box.text();
          box.accept();
        });
    trigger(window(), "Export…");
    EXPECT_TRUE(waitFor([&] { return !told.isEmpty() && !window().busy(); }));
    return told;
  };
  QString told = write("ct", ".nrrd", ct);
  EXPECT_TRUE(told.contains("out.nrrd")) << told.toStdString();
  presenters::CaseSources sources;
  sources.ct = ct;
  const auto read = presenters::buildCase("read", sources, {});
  const auto image = read.ct.volume.get();
  const auto truth = window().model().value().ct.volume.get();
  ASSERT_TRUE(core::sameGrid(image->geometry(), truth->geometry()));
  for (int n = 0; n < 64; ++n)
    EXPECT_EQ(image->sample(Eigen::Vector3d(n, 31, 63 - n)),
              truth->sample(Eigen::Vector3d(n, 31, 63 - n)));
  told = write("structure", ".stl", folder() / "nerve.stl");
  EXPECT_TRUE(told.contains("closed") && told.contains("mm³") &&
              told.contains("Coordinates: LPS (DICOM, ITK), mm"))
      << told.toStdString();
  EXPECT_TRUE(fs::exists(folder() / "nerve.stl"));
  told = write("dissected", "/", folder() / "series");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "series"), fs::directory_iterator()),
            64);
}

// After a failure and when it is opened again, the dialog proposes what was chosen; structures on
// two lattices are offered on the CT's grid.
TEST_F(Import, AnExportThatFailsKeepsItsChoicesAndOffersTheGridOfTheCt)
{
  scene::Case value = ballCase("ball");
  const core::GridGeometry& ct = value.ct.geometry;
  auto voxels = volume::makeZeroVolume<std::uint16_t>(
      core::GridGeometry({9, 8, 7}, 0.7 * ct.spacing(), ct.center()));
  voxels->at(4, 4, 4) = 1;
  scene::LabelPart part;
  scene::StructurePart structure;
  structure.name = "vein";
  structure.index = 1;
  structure.voxels = 1;
  part.structures.push_back(structure);
  volume::Segment segment;
  segment.name = "vein";
  segment.index = 1;
  part.labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(voxels), {segment}));
  part.drawnOn = "";
  value.labels.push_back(std::move(part));
  library().save(value);
  openWindow("ball");
  const QString out = QString::fromStdString((folder() / "all.seg.nrrd").string());
  const auto pick = [](QDialog& dialog, const char* box, const char* data)
  {
    auto* choice = dialog.findChild<QComboBox*>(box);
    choice->setCurrentIndex(choice->findData(QString(data)));
  };
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "exportCase")
          return false;
        QStringList order; // of the tabulator
        QWidget* first = dialog.findChild<QComboBox*>("exportWhat");
        for (QWidget* at = first; order.isEmpty() || at != first; at = at->nextInFocusChain())
          if (at->objectName().startsWith("export") && at->focusPolicy() != Qt::NoFocus)
            order += at->objectName().mid(6);
        EXPECT_EQ(order.join(' ').toStdString(), "What Part Format OnCt MaskFace Triangles Path");
        pick(dialog, "exportWhat", "labels");
        pick(dialog, "exportFormat", ".nii.gz");
        EXPECT_TRUE(dialog.findChild<QLabel*>("exportCoordinates")->text().startsWith("RAS"));
        pick(dialog, "exportFormat", ".seg.nrrd");
        EXPECT_TRUE(dialog.findChild<QLabel*>("exportCoordinates")->text().startsWith("LPS"));
        dialog.findChild<QLineEdit*>("exportPath")->setText(out);
        dialog.findChild<QPushButton*>("primary")->click();
        return true;
      });
  QString asked;
  bool isKept = false;
  onMessage(
      [&](QMessageBox& box)
      {
        asked = box.text();
        EXPECT_EQ(box.objectName(), "exportGrids");
        box.reject();
      });
  trigger(window(), "Export…");
  ASSERT_TRUE(waitFor([&] { return !asked.isEmpty() && !window().busy(); }));
  EXPECT_TRUE(asked.contains("'vein'") && !asked.contains("--")) << asked.toStdString();
  EXPECT_FALSE(fs::exists(folder() / "all.seg.nrrd"));

  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "exportCase")
          return false;
        isKept = dialog.findChild<QComboBox*>("exportWhat")->currentData() == "labels" &&
                 dialog.findChild<QComboBox*>("exportFormat")->currentData() == ".seg.nrrd" &&
                 dialog.findChild<QLineEdit*>("exportPath")->text() == out;
        dialog.findChild<QPushButton*>("primary")->click();
        return true;
      });
  bool isOffered = false;
  onMessage(
      [&](QMessageBox& box)
      {
        for (QAbstractButton* button : box.buttons())
          if (button->text().contains("CT"))
          {
            isOffered = true;
            return button->click();
          }
        box.reject();
      });
  trigger(window(), "Export…");
  ASSERT_TRUE(waitFor([&] { return isOffered; }));
  EXPECT_TRUE(isKept);
  QString told;
  onMessage(
      [&told](QMessageBox& box)
      {
        told = box.text();
        box.accept();
      });
  ASSERT_TRUE(waitFor([&] { return !told.isEmpty() && !window().busy(); }));
  EXPECT_TRUE(told.contains("all.seg.nrrd")) << told.toStdString();
  EXPECT_TRUE(fs::exists(folder() / "all.seg.nrrd"));
}

// A mesh file of several objects: one structure, or one of each.
TEST_F(Import, ObjectsOfAMeshFileBecomeAStructureEachIfTicked)
{
  saveBall("ball");
  openWindow("ball");
  std::ofstream file(folder() / "ossicles.obj");
  file.imbue(std::locale::classic());
  file << "# SPACE=LPS, unit mm\n";
  for (const double edge : {1.0, 2.0}) // mm
    for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                          Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
    {
      const Eigen::Vector3d p = kBallCenter + Eigen::Vector3d(2.0 * edge, 0, 0) + edge * corner;
      file << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
  file << "o malleus\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
          "o incus\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
  file.close();
  const auto names = [this]
  {
    QStringList all;
    for (const scene::MeshPart& mesh : window().model().value().meshes)
      all += QString::fromStdString(mesh.name);
    return all;
  };
  const auto add = [this](bool isPerObject, const QString& name)
  {
    bool isAdded = false;
    onDialog(
        [&](QDialog& dialog)
        {
          auto* perObject = dialog.findChild<QCheckBox*>("perObject");
          if (dialog.objectName() != "addParts" || !perObject)
            return false;
          EXPECT_TRUE(perObject->text().contains("(2)")) << perObject->text().toStdString();
          EXPECT_FALSE(perObject->isChecked());
          auto* edit = dialog.findChild<QLineEdit*>("partName");
          edit->clear();
          EXPECT_FALSE(buttonOf(dialog, "Add to")->isEnabled()) << "needs a name";
          perObject->setChecked(isPerObject);
          edit->setText(name);
          EXPECT_TRUE(buttonOf(dialog, "Add to")->isEnabled());
          isAdded = true;
          dialog.accept();
          return true;
        });
    dropPath(folder() / "ossicles.obj");
    EXPECT_TRUE(waitFor([&] { return isAdded && !window().busy(); }));
    EXPECT_TRUE(settled());
  };
  add(false, "whole");
  ASSERT_TRUE(waitFor([&] { return names().size() == 1; })) << names().join(", ").toStdString();
  add(true, "");
  ASSERT_TRUE(waitFor([&] { return names().size() == 3; })) << names().join(", ").toStdString();
  add(true, "left");
  ASSERT_TRUE(waitFor([&] { return names().size() == 5; })) << names().join(", ").toStdString();
  EXPECT_EQ(names(), QStringList({"whole", "malleus", "incus", "left malleus", "left incus"}));
}

// A label map without names asks for a table of them.
TEST_F(Import, NamesOfALabelMapComeFromATableThatIsChosen)
{
  saveBall("ball");
  openWindow("ball");
  auto voxels = volume::makeZeroVolume<std::uint16_t>(window().model().value().ct.geometry);
  for (int i = 20; i < 40; ++i)
    voxels->at(i, 30, 30) = voxels->at(i, 31, 30) = i < 30 ? 4 : 9;
  imaging::writeLabelFile(folder() / "patient.nii.gz", volume::makeLabelMap(voxels, {}));
  fs::create_directory(folder() / "tables");
  std::ofstream(folder() / "tables" / "names.ctbl")
      << "4 cochlea 255 0 0 255\n9 vein 0 0 255 255\n";
  bool isAdded = false;
  onDialog(
      [&](QDialog& dialog)
      {
        auto* table = dialog.findChild<QPushButton*>("namesTable");
        if (dialog.objectName() != "addParts" || !table)
          return false;
        auto* state = dialog.findChild<QLabel*>("namesState");
        EXPECT_TRUE(state->text().startsWith("2 ")) << state->text().toStdString();
        onDialog(
            [&](QDialog& inner)
            {
              auto* files = qobject_cast<QFileDialog*>(&inner);
              if (files)
                choose(*files, folder() / "tables" / "names.ctbl");
              return files != nullptr;
            });
        table->click();
        EXPECT_TRUE(state->text().contains("names.ctbl")) << state->text().toStdString();
        isAdded = true;
        dialog.accept();
        return true;
      });
  dropPath(folder() / "patient.nii.gz");
  ASSERT_TRUE(waitFor([&] { return isAdded && !window().busy(); }));
  ASSERT_TRUE(waitFor([this] { return window().model().value().labels.size() == 2; }));
  EXPECT_TRUE(settled());
  const auto& structures = window().model().value().labels[1].structures;
  ASSERT_EQ(structures.size(), 2U);
  EXPECT_EQ(structures[0].name, "cochlea");
  EXPECT_EQ(structures[1].name, "vein");
}
