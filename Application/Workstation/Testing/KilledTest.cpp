#include <iostream>

#include <QProcess>

#include "GuiTest.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

constexpr const char* kClosed = "a stroke is closed";

// A window in a separate process, so that it can be killed while drilling.
class Killed : public GuiTest
{
protected:
  void startVictim()
  {
    auto environment = QProcessEnvironment::systemEnvironment();
    environment.insert("PETROUS_GUI_FOLDER", QString::fromStdString(folder().string()));
    m_victim.setProcessEnvironment(environment);
    m_victim.start(
        QCoreApplication::applicationFilePath(),
        {"--gtest_also_run_disabled_tests", "--gtest_filter=Killed.DISABLED_WindowThatDrills"});
    ASSERT_TRUE(m_victim.waitForStarted());
  }

  std::uintmax_t journalled() const // bytes
  {
    std::error_code none;
    const auto size = std::filesystem::file_size(folder() / "library/cases/ball.journal", none);
    return none ? 0 : size;
  }

  bool waitForVictim(const std::function<bool()>& done)
  {
    return waitFor([&] { return done() || m_victim.state() == QProcess::NotRunning; }) &&
           m_victim.state() == QProcess::Running;
  }

  // Opens a window as without a case on the command line, and returns the message shown; empty if
  // there is none.
  QString reopened()
  {
    QString told;
    openWindow();
    onMessage(
        [&told](QMessageBox& box)
        {
          told = box.text();
          box.accept();
        });
    window().begin({});
    EXPECT_TRUE(settled());
    QTest::qWait(100);
    return told;
  }

  QProcess m_victim;
};

} // namespace

// Not a test: the process killed by the next one. Ends by itself otherwise.
TEST_F(Killed, DISABLED_WindowThatDrills)
{
  openWindow("ball");
  QTest::keyClick(&view(), Qt::Key_D);
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle);
  for (int stroke = 0; stroke < 2; ++stroke)
  {
    QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
    EXPECT_TRUE(cuts());
    for (int n = 0; n < (stroke == 0 ? 10 : 600); ++n)
    {
      const QPointF at = middle + QPoint(n % 40, n % 23);
      QMouseEvent move(QEvent::MouseMove, at, Qt::LeftButton, Qt::LeftButton, Qt::NoModifier);
      QApplication::sendEvent(&view(), &move);
      QTest::qWait(100);
    }
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
    EXPECT_TRUE(strokeEnds());
    std::cout << kClosed << std::endl;
  }
}

TEST_F(Killed, AWindowLosesOnlyWhatItsJournalDoesNotHoldYet)
{
  saveBall("ball");
  startVictim();
  QByteArray output;
  ASSERT_TRUE(waitForVictim([&] { return (output += m_victim.readAll()).contains(kClosed); }))
      << output.toStdString();
  // The open stroke is written to the journal every 4.5 seconds; the header is there before.
  const std::uintmax_t head = 1024;
  const std::uintmax_t before = journalled();
  ASSERT_TRUE(waitForVictim([&] { return journalled() > before + head; })) << output.toStdString();
  m_victim.kill(); // SIGKILL
  m_victim.waitForFinished();
  saveBall("saved later");
  const QString told = reopened();
  EXPECT_TRUE(told.startsWith("The last session with case 'ball' ended without saving"))
      << told.toStdString();
  EXPECT_TRUE(told.endsWith(" came back.")) << told.toStdString();
  ASSERT_TRUE(window().model().hasCase());
  EXPECT_EQ(window().model().value().name, "ball") << "not the one that was saved last";
  const auto strokes = library().open("ball").dissection.strokes();
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_FALSE(strokes[0]->info.recovered);
  EXPECT_TRUE(strokes[1]->info.recovered);
  EXPECT_GT(strokes[1]->info.removed, 0.0);
  // It is shown, can be undone, and is reported once.
  EXPECT_EQ(window().model().value().applied(), 2u);
  const QImage drilled = picture();
  action("Undo")->trigger();
  EXPECT_EQ(window().model().value().applied(), 1u);
  EXPECT_GT(differentPixels(drilled, picture(), 12), 50);
  closeWindow();
  saveBall("saved last");
  EXPECT_EQ(reopened(), "");
  EXPECT_EQ(window().model().value().name, "ball") << "it was open last";
}
