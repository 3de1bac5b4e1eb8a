#include "ShareController.h"

#include <algorithm>

#include <QDesktopServices>
#include <QFile>
#include <QUrl>

#include "Application.h"
#include "CaseDocumentController.h"
#include "ExchangeController.h"
#include "PdfReport.h"
#include "ShareDialogs.h"
#include "SharePanel.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowTexts.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/Background.h"
#include "petrous/Presenters/CameraPaths.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/FilmFile.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Presenters/PlanReport.h"

namespace petrous::workstation
{

namespace
{

// As the window draws it, but for tool and thickness.
rendering::SceneContents contentsOf(const scene::Case& value,
                                    const rendering::BackgroundColor& background,
                                    const core::Progress& progress)
{
  rendering::SceneContents contents = presenters::sceneContents(value, progress);
  presenters::illuminate(contents, value.view.light);
  presenters::clip(contents, value.view.clipping, value.ct.geometry);
  contents.background = background;
  return contents;
}

std::vector<std::string> linesOf(const scene::Case& value)
{
  std::vector<std::string> lines = presenters::pictureLines(value);
  for (std::string& line : lines)
    line = bytes(phrase(line));
  return lines;
}

} // namespace

ShareController::ShareController(presenters::WorkstationModel& model,
                                 CaseDocumentController& keeper, ExchangeController& exchange,
                                 ThreeDView& view, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_keeper(keeper)
  , m_view(view)
  , m_window(window)
  , m_panel(new SharePanel(model))
{
  openFile = [](const QString& file)
  { return QDesktopServices::openUrl(QUrl::fromLocalFile(file)); };
  connect(m_panel, &SharePanel::reportAsked, this, &ShareController::report);
  connect(m_panel, &SharePanel::pictureAsked, this, &ShareController::printPicture);
  connect(m_panel, &SharePanel::filmAsked, this, &ShareController::film);
  connect(m_panel, &SharePanel::exportAsked, this,
          [this](const QString& what, const QString& part)
          {
            if (releaseTool)
              releaseTool();
            m_keeper.exportPart(what, part);
          });
  connect(m_panel, &SharePanel::archiveAsked, this,
          [this]
          {
            if (releaseTool)
              releaseTool();
            m_keeper.archive();
          });
  connect(m_panel, &SharePanel::sendAsked, this,
          [this, &exchange]
          {
            if (releaseTool)
              releaseTool();
            if (m_model.hasCase())
              guarded([&] { exchange.send(m_model.value().name); },
                      [this](const QString& why) { emit statusMessage(why); });
          });
}

bool ShareController::mayBegin()
{
  if (!m_model.hasCase())
    return false;
  if (m_keeper.writing())
  {
    emit statusMessage(tr("One at a time: something is being read or written already"));
    return false;
  }
  if (releaseTool)
    releaseTool();
  if (collectView)
    collectView();
  return m_model.hasCase();
}

scene::Case ShareController::shown()
{
  scene::Case value = m_model.value();
  value.camera = m_view.picture().camera();
  return value;
}

void ShareController::done(const std::filesystem::path& file, const QString& what, bool opens,
                           const QString& more)
{
  const QString path = QFile::decodeName(file.c_str());
  QString text = opens && !openFile(path)
                     ? tr("%1: %2; no program is set up to open it").arg(what, path)
                     : tr("%1: %2").arg(what, path);
  if (!more.isEmpty())
    text += ". " + more;
  emit statusMessage(text);
}

void ShareController::report()
{
  if (!mayBegin())
    return;
  ReportDialog dialog(m_model.value(), m_view.display().background(), m_model.leftOut(), &m_window);
  if (dialog.exec() != QDialog::Accepted || !m_model.hasCase())
    return;
  m_keeper.run(
      tr("Writing the report"),
      [this, value = shown(), library = m_model.library(), options = dialog.options(),
       file = dialog.file(),
       isPdf = dialog.isPdf()](const core::Progress& progress) mutable -> BackgroundWork::Reply
      {
        library::refuseOverwriting(file, library.folder());
        const presenters::IdentityText identity(value, library);
        options.mayIdentify = [&identity](const std::string& text)
        { return identity.mayIdentify(text); };
        options.mayIdentifySentence = [&identity](const std::string& text)
        { return identity.mayIdentifySentence(text); };
        options.isOfField = [&identity](const std::string& text)
        { return identity.isOfField(text); };
        if (!value.dissection.loaded())
          library.loadDissection(value);
        const presenters::PlanReport report =
            presenters::planReport(value, options, progress.part(0.0, 0.9));
        library.checkVoxels(value, progress);
        core::writeFile(file, isPdf ? report::pdfOf(report, progress.part(0.9, 1.0))
                                    : presenters::htmlOf(report));
        return [this, file, kept = report.keptTexts]
        {
          done(file, tr("The report is written"), true,
               kept.empty()
                   ? QString()
                   : tr("Read what stands in it as it was typed, for names: %1").arg(words(kept)));
        };
      });
}

void ShareController::printPicture()
{
  if (!mayBegin())
    return;
  PrintDialog dialog(m_model.value(),
                     static_cast<double>(m_view.height()) / std::max(m_view.width(), 1),
                     m_view.display().background(), &m_window);
  if (dialog.exec() != QDialog::Accepted || !m_model.hasCase())
    return;
  m_keeper.run(
      tr("Drawing the picture"),
      [this, value = shown(), size = dialog.size(), samples = dialog.samples(),
       background = dialog.background(), file = dialog.file(),
       library = m_model.library()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        constexpr int kTile = 1024; // pixels
        library::refuseOverwriting(file, library.folder());
        rendering::ScenePicture scene;
        scene.setContents(contentsOf(value, background, progress.part(0.0, 0.1)));
        rendering::Picture picture =
            rendering::renderTiled(scene, *value.camera, size.width(), size.height(),
                                   progress.part(0.1, 0.95), kTile, samples);
        const double magnified = std::max(size.height() / 600.0, 1.0);
        const presenters::Backdrop backdrop = presenters::backdropOf(background);
        presenters::addLines(picture, linesOf(value), magnified, backdrop);
        presenters::addEdgeLetters(picture, *value.camera, magnified, backdrop);
        presenters::addScaleBar(
            picture, rendering::millimetresPerPixel(*value.camera, size.height()),
            value.camera->parallelScale ? "" : "in the focal plane", magnified, backdrop);
        library.checkVoxels(value, progress);
        const auto png = rendering::pngOf(picture, size.dotsPerInch);
        core::writeFile(file, {reinterpret_cast<const char*>(png.data()), png.size()});
        return [this, file] { done(file, tr("The picture is written"), false); };
      });
}

void ShareController::film()
{
  if (!mayBegin())
    return;
  FilmDialog dialog(m_model.value(), &m_window);
  if (dialog.exec() != QDialog::Accepted || !m_model.hasCase())
    return;
  m_keeper.run(
      tr("Drawing the film"),
      [this, value = shown(), along = dialog.along(), frames = dialog.frames(),
       background = m_view.display().background(), file = dialog.file(),
       library = m_model.library()](const core::Progress& progress) mutable -> BackgroundWork::Reply
      {
        library::refuseOverwriting(file, library.folder());
        presenters::Flight flight;
        if (along.empty())
          flight.cameras = presenters::turntable(*value.camera, frames);
        else
          flight = presenters::flightAlong(value, along, frames, progress.part(0.0, 0.05));
        presenters::FilmOptions film;
        film.removesAnyBeyond = true; // FilmDialog::files, which the user was asked about
        film.lines = linesOf(value);
        const rendering::SceneContents contents =
            contentsOf(value, background, progress.part(0.05, 0.1));
        library.checkVoxels(value, progress); // before the first frame is there
        presenters::writeFilm(file, contents, flight.cameras, film, progress.part(0.1, 1.0));
        return [this, file, hidden = std::move(flight.hidden), soft = flight.softTissueHidden]
        {
          QStringList names;
          for (const std::string& name : hidden)
            names += words(name);
          if (soft)
            names += tr("soft tissue");
          done(file, tr("The film is written"), false,
               names.isEmpty()
                   ? QString()
                   : tr("Not drawn, as the flight goes through it: %1").arg(names.join(", ")));
        };
      });
}

} // namespace petrous::workstation
