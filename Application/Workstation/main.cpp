#include <filesystem>
#include <iostream>

#include <QApplication>
#include <QCommandLineParser>
#include <QFile>
#include <QStandardPaths>

#include "Application.h"
#include "MainWindow.h"
#include "SceneDisplay.h"
#include "Theme.h"
#include "petrous/Devices/ServerCatalogue.h"

namespace
{

std::filesystem::path libraryFolder(const QCommandLineParser& parser)
{
  QString folder = parser.value("library");
  if (folder.isEmpty())
    folder = qEnvironmentVariable("PETROUS_LIBRARY");
  if (folder.isEmpty()) // the same default as the petrous command
    folder = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) + "/petrous";
  return QFile::encodeName(folder).toStdString();
}

petrous::presenters::DeviceSources deviceSources()
{
  petrous::presenters::DeviceSources sources;
  try
  {
    sources.hid = std::make_shared<const petrous::devices::HidLibrary>();
  }
  catch (const petrous::devices::HidError&) // the mouse remains; 'petrous doctor' reports why
  {
  }
  sources.serverFolders = petrous::devices::serverFolders();
  return sources;
}

} // namespace

int main(int argc, char** argv)
{
  using namespace petrous;
  QSurfaceFormat::setDefaultFormat(workstation::surfaceFormat());
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  workstation::Application application(argc, argv);
  QApplication::setApplicationName("petrous-workstation");
  QApplication::setApplicationVersion(PETROUS_VERSION);
  workstation::applyTheme(application);

  QCommandLineParser parser;
  parser.setApplicationDescription(
      "Rehearse an operation on the temporal bone on the patient's own CT.");
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addOption({"library", "Folder of the library.", "DIR"});
  parser.addPositionalArgument("what", "A case of the library, a DICOM folder or an image file.",
                               "[CASE | PATH]");
  parser.process(application);
  if (parser.positionalArguments().size() > 1)
  {
    std::cerr << "petrous-workstation: one case or path at a time; see --help\n";
    return 2;
  }

  workstation::WindowOptions options;
  options.quadBuffer = workstation::quadBufferOffered();
  options.devices = deviceSources();
  workstation::MainWindow window(library::Library(libraryFolder(parser)), options);
  window.show();
  workstation::guarded([&] { window.begin(parser.positionalArguments().value(0)); });
  return QApplication::exec();
}
