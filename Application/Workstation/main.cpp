#include <algorithm>
#include <clocale>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string_view>
#include <thread>

#include <QApplication>
#include <QCommandLineParser>
#include <QFile>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>

#include "Application.h"
#include "Language.h"
#include "MainWindow.h"
#include "SceneDisplay.h"
#include "Theme.h"
#include "WindowSettings.h"
#include "petrous/Core/FileSizeLimit.h"
#include "petrous/Core/Log.h"
#include "petrous/Core/StandardStreams.h"
#include "petrous/Devices/ServerCatalogue.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Library/DefaultFolder.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/DeviceLimits.h"
#include "petrous/Rendering/RenderingError.h"

namespace
{

// Empty: the user gives up, or the folder that is named cannot be one.
std::filesystem::path libraryFolder(const QCommandLineParser& parser)
{
  QString folder = parser.value("library");
  if (folder.isEmpty())
    folder = qEnvironmentVariable("PETROUS_LIBRARY");
  if (!folder.isEmpty())
  {
    const std::filesystem::path named = QFile::encodeName(folder).toStdString();
    try
    {
      petrous::library::checkLibraryFolder(named);
      return named;
    }
    catch (const petrous::library::LibraryError& error)
    {
      using petrous::workstation::MainWindow;
      std::cerr << "petrous-workstation: " << error.what() << '\n';
      QMessageBox box(QMessageBox::Warning, MainWindow::tr("Library"),
                      petrous::workstation::toString(error));
      box.exec();
      return {};
    }
  }
  for (;;) // the same default as the petrous command
    try
    {
      return petrous::library::defaultFolder();
    }
    catch (const petrous::library::LibraryError& error)
    {
      using petrous::workstation::MainWindow;
      QMessageBox box(QMessageBox::Warning, MainWindow::tr("Library"),
                      petrous::workstation::toString(error));
      box.setInformativeText(
          MainWindow::tr("Another library has other cases. The usual folder is %1.")
              .arg(QFile::decodeName(petrous::library::usualFolder().c_str())));
      const auto* again = box.addButton(MainWindow::tr("&Try again"), QMessageBox::AcceptRole);
      const auto* usual =
          box.addButton(MainWindow::tr("&Usual folder, this time"), QMessageBox::ActionRole);
      box.addButton(MainWindow::tr("&Quit"), QMessageBox::RejectRole);
      box.exec();
      if (box.clickedButton() == usual)
        return petrous::library::usualFolder();
      if (box.clickedButton() != again)
        return {};
    }
}

petrous::presenters::DeviceSources deviceSources()
{
  petrous::presenters::DeviceSources sources;
  sources.hid = std::make_shared<const petrous::devices::HidLibrary>();
  sources.serverFolders = petrous::devices::serverFolders();
  sources.limits = petrous::presenters::deviceLimitsFile();
  return sources;
}

// Qt's messages may quote a file: the log has their kind only.
void logQtMessage(QtMsgType type, const QMessageLogContext& context, const QString&)
{
  using petrous::core::log::Level;
  const Level level = type == QtDebugMsg     ? Level::Debug
                      : type == QtInfoMsg    ? Level::Info
                      : type == QtWarningMsg ? Level::Warning
                                             : Level::Error;
  petrous::core::log::write(level, std::string("Qt message, ") +
                                       (context.category ? context.category : "default"));
}

void describe(QCommandLineParser& parser)
{
  parser.setApplicationDescription(
      "Rehearse an operation on the temporal bone on the patient's own CT.");
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addOption({"library", "Folder of the library.", "DIR"});
  parser.addOption({"safe", "Without settings, devices, graphics card and previous case: for a "
                            "window that does not start, or not rightly, otherwise."});
  parser.addOption({"language",
                    "Language of the window: de or en. Otherwise as in the settings, "
                    "else the system's where the window has it.",
                    "LANGUAGE"});
  parser.addOption({"log-level",
                    "What the log holds: trace, debug, info, warning, error or off (info).",
                    "LEVEL"});
  parser.addPositionalArgument("what", "A case of the library, a DICOM folder or an image file.",
                               "[CASE | PATH]");
}

// Help and version need no screen. Does not return where one is asked for.
void answerWithoutScreen(int& argc, char** argv)
{
  static constexpr std::string_view kAsked[] = {"-h", "--help", "--help-all", "-v", "--version"};
  const bool isAsked =
      std::any_of(argv + 1, argv + argc,
                  [](const char* one) {
                    return std::find(std::begin(kAsked), std::end(kAsked), one) != std::end(kAsked);
                  });
  if (!isAsked)
    return;
  const QCoreApplication application(argc, argv);
  QCommandLineParser parser;
  describe(parser);
  parser.process(application);
}

// Throws InvalidParameter for an unknown level.
void startLog(const QCommandLineParser& parser)
{
  using namespace petrous;
  core::log::Setup setup;
  setup.level = core::log::levelFrom(parser.value("log-level").toStdString());
  setup.warn = [](const std::string& text)
  { std::cerr << "petrous-workstation: " << text << '\n'; };
  core::log::start(setup);
  core::log::info(std::string("window: start, petrous-workstation " PETROUS_VERSION ", locale ") +
                  QLocale::system().name().toStdString() + ", " +
                  std::to_string(std::thread::hardware_concurrency()) + " processors");
  qInstallMessageHandler(logQtMessage);
  imaging::logToolkitMessages();
  rendering::logToolkitMessages();
}

} // namespace

int main(int argc, char** argv)
{
  using namespace petrous;
  core::holdStandardStreams();
  core::failBeyondFileSizeLimit();
  QCoreApplication::setApplicationName("petrous-workstation");
  QCoreApplication::setApplicationVersion(PETROUS_VERSION);
  answerWithoutScreen(argc, argv);
  const bool isSafe = std::any_of(
      argv + 1, argv + argc, [](const char* one) { return std::string_view(one) == "--safe"; });
  if (isSafe) // before the first use of OpenGL: drawn by Mesa on the processor
  {
    qputenv("LIBGL_ALWAYS_SOFTWARE", "1");
    qputenv("__GLX_VENDOR_LIBRARY_NAME", "mesa");
  }
  QSurfaceFormat::setDefaultFormat(workstation::surfaceFormat());
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps); // icons of as many pixels as the screen has
  workstation::Application application(argc, argv);
  workstation::applyTheme(application);

  QCommandLineParser parser;
  describe(parser);
  parser.process(application);
  if (parser.positionalArguments().size() > 1)
  {
    std::cerr << "petrous-workstation: one case or path at a time; see --help\n";
    return 2;
  }

  const QString language = parser.value("language");
  if (parser.isSet("language") && !workstation::hasLanguage(language))
  {
    std::cerr << "petrous-workstation: --language: '" << language.toStdString() << "' is none of: "
              << (workstation::hasLanguage("de") ? "de, en" : "en (built without translations)")
              << '\n';
    return 2;
  }

  try
  {
    startLog(parser);
  }
  catch (const core::InvalidParameter& error)
  {
    std::cerr << "petrous-workstation: " << error.what() << '\n';
    return 2;
  }

  workstation::WindowOptions options;
  options.isSafe = parser.isSet("safe");
  if (!options.isSafe)
  {
    options.quadBuffer = workstation::quadBufferOffered();
    options.devices = deviceSources();
  }
  workstation::installLanguage(
      application,
      workstation::languageOf(!language.isEmpty() ? language
                              : options.isSafe    ? QString()
                                                  : workstation::WindowSettings().language(),
                              QLocale::system().uiLanguages()));
  const std::filesystem::path folder = libraryFolder(parser);
  if (folder.empty())
    return 3;
  workstation::MainWindow window(library::Library(folder), options);
  window.show();
  workstation::guarded([&] { window.begin(parser.positionalArguments().value(0)); });
  const int code = QApplication::exec();
  core::log::info("window: exit " + std::to_string(code));
  return code;
}
