#include "GuiTest.h"

#include <fstream>

#include <QFileDialog>
#include <QPushButton>
#include <QTreeWidget>

#include "CaseStamps.h"
#include "petrous/Library/Attachments.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class AttachmentsPanels : public GuiTest
{
protected:
  QPushButton& buttonOf(const char* name) { return *window().findChild<QPushButton*>(name); }
  QTreeWidget& list() { return *window().findChild<QTreeWidget*>("attachments"); }
  const scene::Case& value() { return window().model().value(); }
  bool has(std::size_t count)
  {
    return waitFor([&] { return value().attachments.size() == count && !window().busy(); }) &&
           settled();
  }
  std::string extracted(const std::string& name)
  {
    const scene::Case saved = library().open("ball");
    const auto out = folder() / "out";
    library::extractAttachment(library(), saved, scene::findAttachment(saved, name), out);
    std::ifstream file(out, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

} // namespace

TEST_F(AttachmentsPanels, TakeAFileFromTheMenu)
{
  saveBall("ball");
  const auto film = folder() / "Doe_John.mp4"; // no name for what travels
  const std::string bytes = std::string("\0\0\0\x18", 4) + "ftypmp42";
  std::ofstream(film, std::ios::binary) << bytes;
  openWindow("ball");
  const auto choose = [&](int filter)
  {
    onDialog(
        [&, filter](QDialog& dialog)
        {
          auto* files = qobject_cast<QFileDialog*>(&dialog);
          if (!files)
            return false;
          files->selectNameFilter(files->nameFilters().value(filter));
          files->selectFile(QString::fromStdString(film.string()));
          dialog.done(QDialog::Accepted);
          return true;
        });
    action("Attach…")->trigger();
  };
  choose(0);
  ASSERT_TRUE(has(1));
  choose(1); // as a link
  ASSERT_TRUE(has(2));
  const scene::Case saved = library().open("ball");
  ASSERT_EQ(saved.attachments.size(), 2U);
  EXPECT_TRUE(saved.attachments[0].link.empty());
  EXPECT_EQ(saved.attachments[1].link, std::filesystem::canonical(film));
  EXPECT_EQ(extracted("video.mp4"), bytes);
  EXPECT_EQ(list().topLevelItemCount(), 2);
  EXPECT_EQ(list().topLevelItem(1)->text(0), "video (2).mp4");

  list().setCurrentItem(list().topLevelItem(0));
  onMessage([](QMessageBox& box) { box.button(QMessageBox::Yes)->click(); });
  buttonOf("removeAttachment").click();
  ASSERT_TRUE(has(1));
  EXPECT_EQ(library().open("ball").attachments.size(), 1U);
  EXPECT_EQ(list().topLevelItemCount(), 1);
}

TEST_F(AttachmentsPanels, TakeTheWindowsPictureAndTheLastRecordingWithOneClick)
{
  saveBall("ball");
  openWindow("ball");
  EXPECT_FALSE(buttonOf("attachRecording").isEnabled());
  const auto file = record();
  drill(800, 20);
  ASSERT_TRUE(strokeEnds());
  ASSERT_TRUE(settled());
  action("Drill")->trigger(); // put away, which ends the recording of this burr
  ASSERT_TRUE(waitFor([this] { return buttonOf("attachRecording").isEnabled(); }));
  buttonOf("attachRecording").click();
  ASSERT_TRUE(has(1));
  std::ifstream recorded(file, std::ios::binary);
  EXPECT_EQ(extracted(value().attachments[0].name),
            std::string(std::istreambuf_iterator<char>(recorded), {}));
  EXPECT_EQ(value().attachments[0].kind, scene::Attachment::Kind::Recording);
  EXPECT_EQ(scene::strokeOf(value(), value().attachments[0]), 1U);

  const QImage shown = picture();
  buttonOf("attachScreenshot").click();
  ASSERT_TRUE(has(2));
  QImage kept;
  const std::string png = extracted(value().attachments[1].name);
  ASSERT_TRUE(kept.loadFromData(reinterpret_cast<const uchar*>(png.data()),
                                static_cast<int>(png.size()), "PNG"));
  EXPECT_EQ(kept.size(), shown.size());
  QImage stamped = shown;
  drawStamp(stamped, "right");
  EXPECT_EQ(differentPixels(kept.convertToFormat(QImage::Format_RGB32), stamped, 0), 0);
  EXPECT_GT(differentPixels(stamped, shown, 60), 50) << "the stamp can be read";
  EXPECT_EQ(png.find("tEXt"), std::string::npos);
}

TEST_F(AttachmentsPanels, AScreenshotShowsNoHandlesOfTheCropBox)
{
  scene::Case ball = ballCase("ball");
  ball.view.clipping.crop = core::IndexBox{{16, 16, 16}, {48, 48, 48}};
  library().save(ball);
  openWindow("ball");
  const auto screenshot = [this](std::size_t count)
  {
    buttonOf("attachScreenshot").click();
    QImage kept;
    if (!has(count))
      return kept;
    const std::string png = extracted(value().attachments[count - 1].name);
    kept.loadFromData(reinterpret_cast<const uchar*>(png.data()), static_cast<int>(png.size()),
                      "PNG");
    return kept.convertToFormat(QImage::Format_RGB32);
  };
  const QImage plain = picture();
  const QImage before = screenshot(1);
  ASSERT_EQ(before.size(), plain.size());
  action("Crop box")->trigger();
  const QImage handled = picture();
  ASSERT_GT(differentPixels(handled, plain, 30), 100) << "they are in the view";
  const QImage kept = screenshot(2);
  ASSERT_EQ(kept.size(), before.size());
  EXPECT_LT(differentPixels(kept, before, 30), 20);
  EXPECT_GT(differentPixels(picture(), plain, 30), 100) << "where they stay";
}
