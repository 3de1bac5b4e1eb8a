#include "GuiTest.h"

#include <fstream>

#include <QPushButton>

#include "Banner.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

namespace fs = std::filesystem;

class Damage : public GuiTest
{
protected:
  // Flips one bit of a library object.
  void flipBit(const std::string& object) const
  {
    const fs::path file = folder() / "library/objects" / object;
    const auto at = static_cast<std::streamoff>(fs::file_size(file) * 2 / 3);
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(at);
    const char byte = static_cast<char>(stream.get() ^ 4);
    stream.seekp(at);
    stream.put(byte);
  }

  Banner& banner() { return *window().findChild<Banner*>("damageBanner"); }
};

} // namespace

TEST_F(Damage, OfTheCtIsToldAndNothingIsDrilled)
{
  saveBall("ball");
  flipBit(library().open("ball").ct.object);
  openWindow();
  ASSERT_TRUE(waitFor([this] { return banner().isVisible(); }));
  EXPECT_TRUE(banner().text().contains("the CT of case 'ball'")) << banner().text().toStdString();
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::mouseMove(&view(), view().rect().center());
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  QTest::qWait(300);
  EXPECT_FALSE(window().model().touching());
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  EXPECT_TRUE(settled());
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
}

TEST_F(Damage, OfAStructureIsToldAndTheOthersAreDrilled)
{
  saveBall("ball");
  flipBit(library().open("ball").labels[0].object);
  openWindow();
  ASSERT_TRUE(waitFor([this] { return banner().isVisible(); }));
  EXPECT_TRUE(banner().text().contains("'nerve' of case 'ball'")) << banner().text().toStdString();
  EXPECT_TRUE(window().model().ready());
  drill(600);
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), 1u);
  // Nothing is reported for another case.
  auto* close = banner().findChild<QPushButton*>("dismissDamage");
  ASSERT_TRUE(close);
  close->click();
  EXPECT_FALSE(banner().isVisible());
}

// Taking up a tool after stopping the preparation resumes it.
TEST_F(Damage, APreparationThatWasStoppedIsDoneForATool)
{
  saveBall("ball");
  openWindow();
  auto* loading = window().findChild<Banner*>("loadingBanner");
  auto* cancel = loading->findChild<QPushButton*>("cancelLoading");
  ASSERT_TRUE(cancel);
  QTimer stop;
  QObject::connect(&stop, &QTimer::timeout, cancel,
                   [&]
                   {
                     if (!window().model().ready())
                       cancel->click();
                   });
  stop.start(0);
  for (int n = 0; n < 10 && window().model().ready(); ++n) // it may finish before it is stopped
  {
    window().begin("ball");
    EXPECT_TRUE(settled());
  }
  stop.stop();
  QApplication::setActiveWindow(&window()); // after the progress dialogs
  drill(600);
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), 1u);
}
