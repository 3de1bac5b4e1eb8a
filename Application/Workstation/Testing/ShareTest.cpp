#include "GuiTest.h"

#include <fstream>
#include <iterator>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QSpinBox>
#include <QStandardPaths>
#include <QStatusBar>
#include <QTreeWidget>

#include "PdfReport.h"
#include "ShareController.h"
#include "petrous/Scene/Placement.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class ShareWindow : public GuiTest
{
protected:
  void openBall()
  {
    saveBall("ball");
    openWindow("ball");
    ASSERT_TRUE(waitFor([this] { return window().model().ready(); }));
    ASSERT_TRUE(settled());
    window().findChild<ShareController*>()->openFile = [this](const QString& path)
    {
      shown.push_back(path);
      return true;
    };
  }
  QStringList shown; ///< in place of a program that shows files
  QString file(const char* name) const
  {
    return QString::fromStdString((folder() / name).string());
  }
  static std::string textOf(const QString& name)
  {
    std::ifstream stream(name.toStdString(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// Names the file of the dialog that opens, and accepts it by Return.
  void answer(const char* dialogName, const QString& path,
              const std::function<void(QDialog&)>& more = {})
  {
    onDialog(
        [=](QDialog& dialog)
        {
          if (dialog.objectName() != dialogName)
            return false;
          auto* line = dialog.findChild<QLineEdit*>(QString(dialogName) + "File");
          EXPECT_TRUE(line);
          line->setText(path);
          if (more)
            more(dialog);
          QTest::keyClick(&dialog, Qt::Key_Return);
          return true;
        });
  }
};

} // namespace

// Two actions of the user's: the key, and Return.
TEST_F(ShareWindow, WritesAReportInTwoActionsAndOpensIt)
{
  openBall();
  answer("planReport", file("plan.pdf"));
  QTest::keyClick(&window(), Qt::Key_P, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([&] { return !shown.isEmpty(); }));
  EXPECT_EQ(shown.first(), file("plan.pdf"));
  EXPECT_EQ(textOf(file("plan.pdf")).substr(0, 5), "%PDF-");

  // The panel's button asks the same, and takes no name of another kind.
  bool asked = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "planReport")
          return false;
        asked = true;
        dialog.findChild<QLineEdit*>("planReportFile")->setText(file("plan.doc"));
        EXPECT_FALSE(dialog.findChild<QPushButton*>("primary")->isEnabled());
        dialog.findChild<QLineEdit*>("planReportFile")->setText(file("plan.html"));
        EXPECT_TRUE(dialog.findChild<QPushButton*>("primary")->isEnabled());
        dialog.reject();
        return true;
      });
  QTest::mouseClick(window().findChild<QPushButton*>("shareReport"), Qt::LeftButton);
  EXPECT_TRUE(asked);
  EXPECT_FALSE(QFile::exists(file("plan.html")));
}

TEST_F(ShareWindow, TheReportIsSaidToLieWhereItIsAlsoWhereNothingShowsIt)
{
  openBall();
  bool asked = false;
  window().findChild<ShareController*>()->openFile = [&asked](const QString&)
  {
    asked = true;
    return false;
  };
  answer("planReport", file("plan.pdf"));
  QTest::keyClick(&window(), Qt::Key_P, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([&] { return asked; }));
  const QString told = window().statusBar()->currentMessage();
  EXPECT_TRUE(told.contains(file("plan.pdf"))) << told.toStdString();
  EXPECT_TRUE(told.contains("no program is set up to open it")) << told.toStdString();
}

// As `petrous report` warns.
TEST_F(ShareWindow, TheReportsDialogSaysWhichStructureIsLeftOutAndWhy)
{
  openBall();
  bool isWhole = false;
  const auto said = [this, &isWhole]
  {
    QString text;
    onDialog(
        [&](QDialog& dialog)
        {
          if (dialog.objectName() != "planReport")
            return false;
          if (auto* label = dialog.findChild<QLabel*>("reportWithout"))
          {
            label->repaint();
            text = label->text();
            isWhole = label->minimumHeight() >= label->heightForWidth(label->width());
          }
          dialog.reject();
          return true;
        });
    QTest::mouseClick(window().findChild<QPushButton*>("shareReport"), Qt::LeftButton);
    return text;
  };
  EXPECT_EQ(said(), QString());
  closeWindow();

  scene::Case value = ballCase("away");
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  value.mr = {mr}; // not registered
  ASSERT_EQ(value.labels.size(), 1U);
  value.labels[0].drawnOn = "T2";
  const std::string why = scene::placementOf(value, value.labels[0]).missing;
  ASSERT_NE(why, "");
  library().save(value);
  openWindow("away");
  ASSERT_TRUE(waitFor([this] { return window().model().ready(); }));
  ASSERT_TRUE(settled());
  const QString text = said();
  EXPECT_TRUE(text.contains("nerve")) << text.toStdString();
  EXPECT_TRUE(text.contains("nowhere on the CT")) << text.toStdString();
  EXPECT_TRUE(text.contains(QString::fromStdString(why))) << text.toStdString();
  EXPECT_TRUE(isWhole) << "no line is cut off";
}

TEST_F(ShareWindow, DrawsThePictureOfTheViewForPrint)
{
  openBall();
  answer("printPicture", file("view.png"),
         [](QDialog& dialog)
         {
           dialog.findChild<QDoubleSpinBox*>("printWidth")->setValue(100.0);
           dialog.findChild<QSpinBox*>("printDots")->setValue(50);
           EXPECT_EQ(dialog.findChild<QComboBox*>("printBackground")->currentIndex(), 0);
           dialog.findChild<QComboBox*>("printBackground")->setCurrentIndex(1);
         });
  action("Picture for print…")->trigger();
  ASSERT_TRUE(waitFor([&] { return QFile::exists(file("view.png")); }));
  ASSERT_TRUE(settled());
  const QImage picture(file("view.png"));
  EXPECT_EQ(picture.width(), 197); // 100 mm / 25.4 * 50
  EXPECT_EQ(picture.dotsPerMeterX(), 1969);
  EXPECT_NEAR(static_cast<double>(picture.height()) / picture.width(),
              static_cast<double>(view().height()) / view().width(), 0.01);
  EXPECT_GT(pixelsUnlikeTheCorner(picture), 1000);
  EXPECT_EQ(picture.pixelColor(2, picture.height() - 3), QColor(Qt::white));
  EXPECT_EQ(view().display().background(), rendering::kDefaultBackground) << "only on paper";
}

TEST_F(ShareWindow, NoChangeMakesItsDialogsGrow)
{
  openBall();
  for (const QString name : {"printPicture", "planReport"})
  {
    bool asked = false;
    onDialog(
        [&](QDialog& dialog)
        {
          if (dialog.objectName() != name)
            return false;
          asked = true;
          QApplication::processEvents();
          const QSize size = dialog.size();
          const auto expectSame = [&](const char* what)
          {
            QApplication::processEvents();
            EXPECT_EQ(dialog.size(), size) << what;
          };
          auto* line = dialog.findChild<QLineEdit*>(name + "File");
          line->setText(file("plan.doc"));
          EXPECT_FALSE(dialog.findChild<QLabel*>("shareAdvice")->text().isEmpty());
          expectSame("advice");
          line->setText(file("plan.png"));
          expectSame("none, or another one");
          if (auto* width = dialog.findChild<QDoubleSpinBox*>("printWidth"))
          {
            width->setValue(10.0);
            expectSame("few pixels");
            width->setValue(1000.0);
            expectSame("many pixels");
          }
          dialog.reject();
          return true;
        });
    action(name == "planReport" ? "Plan report…" : "Picture for print…")->trigger();
    EXPECT_TRUE(asked) << name.toStdString();
  }
}

TEST_F(ShareWindow, FilmsOnceAroundAndNamesWhatAVideoNeeds)
{
  openBall();
  answer("film", file("turn.png"),
         [](QDialog& dialog) { dialog.findChild<QSpinBox*>("filmFrames")->setValue(2); });
  action("Film…")->trigger();
  ASSERT_TRUE(waitFor([&] { return QFile::exists(file("turn-0002.png")); }));
  ASSERT_TRUE(settled());
  EXPECT_EQ(QImage(file("turn-0001.png")).size(), QSize(1280, 720));
  EXPECT_FALSE(QFile::exists(file("turn-0003.png")));
  onDialog(
      [this](QDialog& dialog)
      {
        auto* line = dialog.findChild<QLineEdit*>("filmFile");
        line->setText(file("turn.avi"));
        EXPECT_FALSE(dialog.findChild<QPushButton*>("primary")->isEnabled());
        line->setText(file("nowhere/turn.png"));
        EXPECT_FALSE(dialog.findChild<QPushButton*>("primary")->isEnabled());
        dialog.reject();
        return true;
      });
  action("Film…")->trigger();
}

TEST_F(ShareWindow, ExportsTheObjectThatIsChosen)
{
  openBall();
  window().findChild<QWidget*>("shareDock")->show();
  auto* objects = window().findChild<QTreeWidget*>("shareObjects");
  ASSERT_TRUE(objects);
  const auto found = objects->findItems("nerve", Qt::MatchExactly);
  ASSERT_EQ(found.size(), 1);
  objects->setCurrentItem(found.first());
  bool asked = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "exportCase")
          return false;
        asked = true;
        EXPECT_EQ(dialog.findChild<QComboBox*>("exportWhat")->currentData(), "structure");
        EXPECT_EQ(dialog.findChild<QComboBox*>("exportPart")->currentData(), "nerve");
        EXPECT_TRUE(dialog.findChild<QLineEdit*>("exportPath")->text().contains("ball nerve"));
        dialog.reject();
        return true;
      });
  QTest::mouseClick(window().findChild<QPushButton*>("shareExport"), Qt::LeftButton);
  EXPECT_TRUE(asked);
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "archiveCase")
          return false;
        asked = false;
        dialog.reject();
        return true;
      });
  QTest::mouseClick(window().findChild<QPushButton*>("shareArchive"), Qt::LeftButton);
  EXPECT_FALSE(asked) << "the archive's dialog, with the identity report";
}

// Wherever the page ends, as poppler reads it.
TEST(PdfReport, HasEachLineOnOnePage)
{
  if (QStandardPaths::findExecutable("pdftotext").isEmpty())
    GTEST_SKIP() << "pdftotext is not installed";
  for (std::size_t rows = 14; rows < 90; ++rows)
  {
    presenters::PlanReport report;
    report.title = "Operation plan";
    report.pageOf = "Page %1 of %2";
    report.colophon = "colophon.";
    presenters::ReportSection section;
    section.title = "heading";
    section.table.columns = {"Stroke"};
    for (std::size_t n = 0; n < rows; ++n)
      section.table.rows.push_back({{"row" + std::to_string(n) + "."}});
    section.remarks = {"begins. Resolved: two voxels or more across at the narrowest of its "
                       "extents. Of what is thinner, volume and distances say little, and this "
                       "goes on into the second line, where it ends.",
                       "another."};
    report.sections = {section, section};
    QTemporaryDir folder;
    QFile file(folder.filePath("plan.pdf"));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(report::pdfOf(report)));
    file.close();
    QProcess reader;
    reader.start("pdftotext", {"-layout", file.fileName(), "-"});
    ASSERT_TRUE(reader.waitForFinished());
    const QString text = QString::fromUtf8(reader.readAllStandardOutput());
    for (const char* word : {"heading", "begins.", "ends.", "another."})
      EXPECT_EQ(text.count(word), 2) << word << ", " << rows << " rows";
    EXPECT_EQ(text.count("colophon."), 1) << rows << " rows";
    for (std::size_t n = 0; n < rows; ++n)
      EXPECT_EQ(text.count(QString("row%1.").arg(n)), 2) << n << " of " << rows << " rows";
  }
}
