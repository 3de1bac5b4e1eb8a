#include "GuiTest.h"

#include <csignal>
#include <fstream>
#include <stdexcept>

#include <execinfo.h>
#include <unistd.h>

#include <QAbstractButton>
#include <QApplication>
#include <QCursor>
#include <QFile>
#include <QFileDialog>
#include <QGroupBox>
#include <QJsonDocument>
#include <QLabel>
#include <QMap>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QPointer>
#include <QProcess>
#include <QProgressDialog>
#include <QScreen>
#include <QTabBar>
#include <QTreeView>

#include "Application.h"
#include "SliceColumn.h"
#include "StructuresModel.h"
#include "Theme.h"
#include "petrous/Imaging/DicomWriter.h"

namespace petrous::workstation
{

const Eigen::Vector3d GuiTest::kBallCenter{-30.0, 12.0, 45.0};

GuiTest::GuiTest() = default;
GuiTest::~GuiTest() = default;

std::filesystem::path GuiTest::folder() const
{
  // In a process started by a test: the test's folder.
  return qEnvironmentVariable("PETROUS_GUI_FOLDER", m_folder.path()).toStdString();
}

library::Library GuiTest::library() const
{
  return library::Library(folder() / "library");
}

scene::Case GuiTest::ballCase(const std::string& name)
{
  scene::Case value;
  value.name = name;
  value.description.side = scene::Side::Right;
  const Eigen::Vector3d origin = kBallCenter - Eigen::Vector3d::Constant(0.5 * 63 * 0.5);
  value.ct.geometry = core::GridGeometry({64, 64, 64}, Eigen::Vector3d::Constant(0.5), origin);
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
  auto labels =
      std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
  for (int k = 0; k < 64; ++k)
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i)
      {
        const Eigen::Vector3d at = value.ct.geometry.patientFromVoxel(Eigen::Vector3d(i, j, k));
        const double depth = kBallRadius - (at - kBallCenter).norm(); // mm
        ct->at(i, j, k) =
            static_cast<std::int16_t>(std::clamp(300.0 + 1000.0 * depth, -1000.0, 1600.0));
        if ((at - kBallCenter).norm() < 4.0)
          labels->at(i, j, k) = 1;
      }
  value.ct.name = "ct";
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  value.ct.range = {-1000.0, 1600.0};
  scene::LabelPart part;
  auto map = std::make_shared<const volume::LabelMap>(
      volume::makeLabelMap(labels, {{"nerve", 1, {1.0F, 0.8F, 0.1F}, 0}}));
  scene::StructurePart nerve;
  nerve.name = "nerve";
  nerve.index = 1;
  nerve.voxels = map->segments.front().voxels;
  nerve.volume = map->volume(map->segments.front());
  part.structures.push_back(nerve);
  part.labels = map;
  value.labels.push_back(part);
  return value;
}

void GuiTest::saveBall(const std::string& name)
{
  scene::Case value = ballCase(name);
  library().save(value);
}

std::vector<std::filesystem::path> GuiTest::writeUndeclaredBits(const std::filesystem::path& folder,
                                                                bool hasAir)
{
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(
      core::GridGeometry({16, 16, 6}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero()),
      std::int16_t{40});
  voxels->at(5, 5, 3) = 5000;
  if (hasAir)
    voxels->at(8, 8, 3) = -1000 & 0xFFF;
  imaging::SeriesDescription series;
  series.studyUid = "1.2.3";
  series.seriesUid = "1.2.3.4";
  series.frameOfReferenceUid = "1.2.3.9";
  const std::shared_ptr<const volume::Volume<std::int16_t>> image = voxels;
  imaging::writeDicomSeries(folder, volume::IntensityVolume(image), series);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    std::ifstream in(entry.path(), std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    for (const auto& [element, value] :
         {std::pair('\x01', 12), {'\x02', 11}}) // Bits Stored, High Bit
    {
      const std::size_t at =
          bytes.find(std::string("\x28\x00", 2) + element + "\x01US" + std::string("\x02\x00", 2));
      if (at == std::string::npos)
        throw std::runtime_error("no bits stated in " + entry.path().string());
      bytes[at + 8] = static_cast<char>(value);
    }
    std::ofstream(entry.path(), std::ios::binary) << bytes;
    files.push_back(entry.path());
  }
  return files;
}

void GuiTest::openWindow(const QString& what)
{
  WindowOptions options;
  options.settings = m_folder.filePath("settings.conf");
  options.devices = devices;
  options.lookForDevicesEvery = lookForDevicesEvery;
  options.drawThumbnailsAfter = drawThumbnailsAfter;
  options.saveAfter = saveAfter;
  options.isSafe = isSafe;
  // Where the last test left the pointer, a view might come to lie below it.
  QCursor::setPos(QGuiApplication::primaryScreen()->geometry().bottomRight());
  m_window = std::make_unique<MainWindow>(library(), options);
  m_window->resize(1200, 760);
  view().display().setSamples(1); // a picture must not depend on how long it rests
  m_window->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(m_window.get()));
  QApplication::setActiveWindow(m_window.get()); // needed for key events without a window manager
  m_window->begin(what);
  QTest::qWait(50);
  EXPECT_TRUE(settled());
}

void GuiTest::closeWindow()
{
  QTimer stop; // jobs that a test has left running
  QObject::connect(&stop, &QTimer::timeout, &stop,
                   [this]
                   {
                     if (auto* ask = m_window->findChild<QMessageBox*>("askJobs"))
                       clickOn(*ask, QMessageBox::DestructiveRole);
                   });
  stop.start(20);
  if (m_window)
    m_window->close();
  stop.stop();
  m_window.reset();
}

ThreeDView& GuiTest::view()
{
  return *m_window->findChild<ThreeDView*>("threeDView");
}

QAction* GuiTest::action(const QString& text)
{
  QAction* without = nullptr;
  for (QAction* candidate : m_window->findChildren<QAction*>())
    // Those of undo and redo go on with what they would take on.
    if (candidate->text().remove('&') == text || candidate->iconText() == text)
    {
      // Menus and tool bars have actions of their own, without a shortcut.
      if (!candidate->shortcut().isEmpty())
        return candidate;
      without = candidate;
    }
  if (without)
    return without;
  ADD_FAILURE() << "no action " << text.toStdString();
  return nullptr;
}

QTreeView& GuiTest::structureList()
{
  return *m_window->findChild<QTreeView*>("structures");
}

QModelIndex GuiTest::structureCell(const std::string& part, int column)
{
  return static_cast<StructuresModel*>(structureList().model())
      ->rowOf(part)
      .siblingAtColumn(column);
}

QImage GuiTest::picture()
{
  QTest::qWait(400); // fine rendering starts 150 ms after the last motion
  waitFor([this] { return !m_window->model().hasCase() || view().display().isFine(); }, 20000);
  const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
  if (!pictures.isEmpty()) // for visual inspection
  {
    static int number = 0;
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    m_window->screen()
        ->grabWindow(m_window->winId())
        .save(QString("%1/%2-%3.png").arg(pictures, test->name()).arg(++number));
  }
  return view().grabFramebuffer().convertToFormat(QImage::Format_RGB32);
}

void GuiTest::drop(const QMimeData& data)
{
  QDragEnterEvent enter({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(m_window.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent event(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(m_window.get(), &event);
  QTest::qWait(10);
}

void GuiTest::dropPath(const std::filesystem::path& path)
{
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QString::fromStdString(path.string()))});
  drop(data);
}

void GuiTest::drill(int milliseconds, int pixels)
{
  if (!action("Drill")->isChecked())
  {
    QApplication::setActiveWindow(m_window.get()); // without a window manager a dialog keeps it
    QTest::keyClick(&view(), Qt::Key_D);
  }
  ASSERT_TRUE(action("Drill")->isChecked());
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle);
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(cuts());
  QPoint at = middle;
  constexpr int parts = 10;
  for (int n = 1; n <= parts; ++n)
  {
    QTest::qWait(milliseconds / parts);
    at = middle + QPoint(pixels * n / parts, 0);
    QMouseEvent move(QEvent::MouseMove, at, Qt::LeftButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&view(), &move);
  }
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, at);
  EXPECT_TRUE(strokeEnds());
}

// What is removed while it waits: a brick that the mask has anew.
bool GuiTest::cuts()
{
  const auto mask = [this]() -> const volume::CutMask&
  { return m_window->model().value().dissection.mask(); };
  std::vector<volume::CutMask::BrickVersion> before;
  for (std::size_t n = 0; n < mask().brickCount(); ++n)
    before.push_back(mask().brick(n));
  return waitFor(
      [&]
      {
        bool changed = false;
        for (std::size_t n = 0; n < before.size() && !changed; ++n)
          changed = mask().brick(n) != before[n];
        return changed && m_window->model().drilling();
      });
}

void GuiTest::leave()
{
  QApplication::processEvents(); // an event of entering that is under way
  QEvent event(QEvent::Leave);
  QApplication::sendEvent(&view(), &event);
}

bool GuiTest::strokeEnds()
{
  return waitFor([this] { return !m_window->model().drilling(); }) && settled();
}

bool GuiTest::settled()
{
  const auto* slices = m_window->findChild<SliceColumn*>();
  return waitFor([&] { return !m_window->busy() && !slices->isFraming(); });
}

std::filesystem::path GuiTest::record()
{
  std::filesystem::path file;
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, &answer,
                   [&]
                   {
                     auto* ask = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
                     if (!ask)
                       return;
                     answer.stop();
                     file = QFile::encodeName(ask->selectedFiles().value(0)).toStdString();
                     static_cast<QDialog*>(ask)->accept();
                   });
  answer.start(20);
  action(QString::fromUtf8("Record session…"))->trigger();
  // In case no window manager returns the keyboard focus to the window.
  m_window->activateWindow();
  view().setFocus();
  return file;
}

QJsonObject GuiTest::replayed(const std::filesystem::path& file, const QString& name) const
{
  QProcess command;
  command.start(PETROUS_COMMAND,
                {"drill", name, "--replay", QString::fromStdString(file.string()), "--library",
                 QString::fromStdString((folder() / "library").string()), "--json"});
  EXPECT_TRUE(command.waitForFinished(60000));
  EXPECT_EQ(command.exitCode(), 0) << command.readAllStandardError().toStdString();
  return QJsonDocument::fromJson(command.readAllStandardOutput()).object()["replay"].toObject();
}

void GuiTest::onMessage(const std::function<void(QMessageBox&)>& react)
{
  auto* poll = new QTimer(m_window.get());
  QObject::connect(poll, &QTimer::timeout, poll,
                   [poll, react]
                   {
                     auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
                     if (!box)
                       return;
                     poll->stop();
                     poll->deleteLater();
                     react(*box);
                   });
  poll->start(20);
}

void GuiTest::clickOn(QMessageBox& box, QMessageBox::ButtonRole role)
{
  const QList<QAbstractButton*> buttons = box.buttons();
  for (QAbstractButton* button : buttons)
    if (box.buttonRole(button) == role)
      return button->click();
  ADD_FAILURE() << "no such button in " << box.text().toStdString();
  box.reject();
}

void GuiTest::onDialog(const std::function<bool(QDialog&)>& react)
{
  auto* poll = new QTimer(m_window.get());
  const auto busy = std::make_shared<bool>(false); // `react` may process events
  QObject::connect(poll, &QTimer::timeout, poll,
                   [poll, react, busy]
                   {
                     auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
                     if (*busy || !dialog || qobject_cast<QProgressDialog*>(dialog))
                       return;
                     *busy = true;
                     const QPointer<QTimer> alive(poll);
                     if (react(*dialog) && alive)
                     {
                       poll->stop();
                       poll->deleteLater();
                     }
                     *busy = false;
                   });
  poll->start(20);
}

QStringList GuiTest::sharedMnemonics(const QWidget& scope)
{
  QStringList texts;
  if (qobject_cast<const QMenu*>(&scope) || qobject_cast<const QMenuBar*>(&scope))
    for (const QAction* action : scope.actions())
      texts += action->text();
  else
    for (const QWidget* widget : scope.findChildren<QWidget*>())
    {
      if (!widget->isVisibleTo(&scope))
        continue;
      if (const auto* label = qobject_cast<const QLabel*>(widget))
        texts += label->buddy() ? label->text() : QString();
      else if (const auto* button = qobject_cast<const QAbstractButton*>(widget))
        texts += button->text();
      else if (const auto* box = qobject_cast<const QGroupBox*>(widget))
        texts += box->title();
      else if (const auto* tabs = qobject_cast<const QTabBar*>(widget))
        for (int n = 0; n < tabs->count(); ++n)
          texts += tabs->tabText(n);
    }
  QMap<QString, QStringList> byKey;
  for (const QString& text : texts)
    if (const QKeySequence key = QKeySequence::mnemonic(text); !key.isEmpty())
      byKey[key.toString()] += text;
  QStringList shared;
  for (auto key = byKey.cbegin(); key != byKey.cend(); ++key)
    if (key->size() > 1)
      shared += key.key() + ": " + key->join(" | ");
  return shared;
}

QImage GuiTest::steady(const std::function<QImage()>& picture)
{
  QImage last = picture();
  for (int unchanged = 0; unchanged < 4;)
  {
    QTest::qWait(100);
    QImage next = picture();
    unchanged = next == last ? unchanged + 1 : 0;
    last = std::move(next);
  }
  return last;
}

bool GuiTest::waitFor(const std::function<bool()>& done, int milliseconds)
{
  return QTest::qWaitFor(done, milliseconds);
}

void enterNumber(QAbstractSpinBox& box, const char* typed, Qt::Key end)
{
  box.selectAll();
  QTest::keyClicks(&box, typed);
  QTest::keyClick(&box, end);
}

int differentPixels(const QImage& a, const QImage& b, int tolerance)
{
  if (a.size() != b.size())
    return a.width() * a.height();
  int count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
    {
      const QRgb p = a.pixel(x, y);
      const QRgb q = b.pixel(x, y);
      count += std::abs(qRed(p) - qRed(q)) > tolerance ||
               std::abs(qGreen(p) - qGreen(q)) > tolerance ||
               std::abs(qBlue(p) - qBlue(q)) > tolerance;
    }
  return count;
}

int pixelsUnlikeTheCorner(const QImage& image)
{
  QImage empty(image.size(), image.format());
  empty.fill(image.pixel(0, 0));
  return differentPixels(image, empty, 6);
}

} // namespace petrous::workstation

namespace
{

// Where a crash happened, in the test's output: a core dump is mostly not kept.
void printBacktrace(int signal)
{
  void* frames[64];
  backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

} // namespace

int main(int argc, char** argv)
{
  void* frame = nullptr;
  backtrace(&frame, 1); // loads libgcc outside of the handler
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT})
    std::signal(signal, printBacktrace);
  ::testing::InitGoogleTest(&argc, argv);
  if (::testing::GTEST_FLAG(list_tests)) // needs no display
    return RUN_ALL_TESTS();
  QSurfaceFormat::setDefaultFormat(petrous::workstation::surfaceFormat());
  petrous::workstation::Application application(argc, argv);
  petrous::workstation::applyTheme(application);
  return RUN_ALL_TESTS();
}
