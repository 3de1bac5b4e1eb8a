#include "AttachmentsController.h"

#include <QBuffer>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QInputDialog>
#include <QMessageBox>

#include "Application.h"
#include "AskName.h"
#include "AttachmentsPanel.h"
#include "CaseStamps.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowTexts.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Presenters/Background.h"
#include "petrous/Presenters/IdentityText.h"

namespace petrous::workstation
{

namespace
{

// The object of the stroke to which the case's present state belongs; empty: none, or not saved.
std::string presentStroke(const scene::Case& value)
{
  const std::size_t position = value.dissection.history().position();
  const auto& strokes = value.dissection.strokes();
  return position < strokes.size() ? strokes[position]->object : std::string();
}

} // namespace

AttachmentsController::AttachmentsController(presenters::WorkstationModel& model, ThreeDView& view,
                                             QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_view(view)
  , m_window(window)
  , m_panel(new AttachmentsPanel(model))
{
  connect(m_panel, &AttachmentsPanel::attachAsked, this, &AttachmentsController::attach);
  connect(m_panel, &AttachmentsPanel::screenshotAsked, this,
          &AttachmentsController::attachScreenshot);
  connect(m_panel, &AttachmentsPanel::recordingAsked, this,
          &AttachmentsController::attachRecording);
  connect(m_panel, &AttachmentsPanel::extractAsked, this,
          [this](const QString& name) { extract(bytes(name)); });
  connect(m_panel, &AttachmentsPanel::noteAsked, this,
          [this](const QString& name) { changeNote(bytes(name)); });
  connect(m_panel, &AttachmentsPanel::removalAsked, this,
          [this](const QString& name) { remove(bytes(name)); });
  connect(&m_work, &BackgroundWork::failed, this, &AttachmentsController::statusMessage);
}

bool AttachmentsController::attach()
{
  if (!m_model.hasCase())
    return false;
  const QString files = "(*.ticks *.png *.pdf *.mp4 *.m4v *.mov *.mkv *.webm *.avi *.mpg *.mpeg "
                        "*.ts *.mts *.wmv *.flv *.ogv *.ogg *.mp3 *.wav *.flac)";
  const QString embedded = tr("Recordings, PNG, PDF, video %1").arg(files);
  const QString linked = tr("The same, as a link: the file stays where it is %1").arg(files);
  QFileDialog dialog(&m_window, tr("Attach to “%1”").arg(words(m_model.value().name)));
  dialog.setObjectName("attachFile");
  dialog.setFileMode(QFileDialog::ExistingFile);
  dialog.setNameFilters({embedded, linked, tr("All files (*)")});
  dialog.setDirectory(QDir::homePath());
  const QString file = chosenFile(dialog);
  return !file.isEmpty() && take(pathOf(file), dialog.selectedNameFilter() == linked);
}

// A link is read as a whole, for its hash: in the background.
bool AttachmentsController::take(const std::filesystem::path& file, bool isLink)
{
  if (m_work.busy())
  {
    emit statusMessage(tr("One at a time: a file is being read already"));
    return false;
  }
  library::AttachOptions options;
  options.link = isLink;
  m_taking = QFile::decodeName(file.filename().c_str());
  m_work.start(
      [this, file, options,
       shownAs = m_model.shownAs()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const scene::Attachment attachment = library::attachmentOf(file, options, progress);
        return [this, attachment, shownAs]
        {
          if (m_model.shownAs() == shownAs)
            add(attachment);
        };
      });
  return true;
}

QString AttachmentsController::taking() const
{
  return m_work.busy() ? m_taking : QString();
}

void AttachmentsController::stop()
{
  m_work.dropInLoop();
}

void AttachmentsController::add(scene::Attachment attachment)
{
  if (!m_model.hasCase())
    return;
  attachment.stroke = presentStroke(m_model.value());
  const bool isVideo = attachment.kind == scene::Attachment::Kind::Video;
  const bool isDocument = attachment.kind == scene::Attachment::Kind::Document;
  bool isNamed = false;
  guarded(
      [&]
      {
        isNamed = presenters::IdentityText(m_model.value(), m_model.library())
                      .mayIdentifyPath(attachment.link);
      },
      [this](const QString& why) { emit statusMessage(why); });
  std::string name;
  change([&] { name = m_model.attach(std::move(attachment)); });
  if (name.empty())
    return;
  emit panelWanted();
  if (isNamed)
    return emit statusMessage(
        tr("“%1” is attached; the path of its file, which the case keeps, may "
           "name the patient. It stays in this library")
            .arg(words(name)));
  emit statusMessage(
      isVideo ? tr("“%1” is attached; a video may show or name the patient, and stays here when "
                   "the case is archived or sent, unless asked")
                    .arg(words(name))
      : isDocument
          ? tr("“%1” is attached; a PDF may name the patient, also in its metadata, and stays here "
               "when the case is archived or sent, unless asked")
                .arg(words(name))
          : tr("“%1” is attached").arg(words(name)));
}

void AttachmentsController::attachScreenshot()
{
  if (!m_model.hasCase())
    return;
  QByteArray png;
  QBuffer buffer(&png);
  buffer.open(QIODevice::WriteOnly);
  guarded(
      [&]
      {
        QImage picture;
        m_view.display().withoutHandles([&] { picture = m_view.grabFramebuffer(); });
        picture = picture.convertToFormat(QImage::Format_RGB32);
        drawStamp(picture, stampText(presenters::leavingStampOf(m_model.value())),
                  m_view.display().stereo() == rendering::StereoMode::SideBySide,
                  presenters::backdropOf(m_view.display().background()));
        picture.convertToFormat(QImage::Format_RGB888).save(&buffer, "PNG");
        add(library::screenshotOf({png.begin(), png.end()}, {}));
      },
      [this](const QString& why) { emit statusMessage(why); });
}

void AttachmentsController::attachRecording()
{
  if (!m_model.lastRecording().empty())
    take(m_model.lastRecording(), false);
}

void AttachmentsController::extract(const std::string& name)
{
  if (m_work.busy())
    return emit statusMessage(tr("One at a time: a file is being read already"));
  const scene::Attachment one = scene::findAttachment(m_model.value(), name);
  if (one.object.empty() && one.link.empty())
    return emit statusMessage(tr("“%1” is being saved").arg(words(name)));
  QFileDialog dialog(&m_window, tr("Save “%1”").arg(words(name)), QDir::homePath());
  dialog.selectFile(words(name));
  const std::filesystem::path file = askFile(dialog);
  if (file.empty() || !m_model.hasCase())
    return;
  m_taking.clear();
  scene::Case of; // its name is said in messages
  of.name = m_model.value().name;
  m_work.start(
      [this, library = m_model.library(), of, one,
       file](const core::Progress& progress) -> BackgroundWork::Reply
      {
        library::extractAttachment(library, of, one, file, progress);
        return [this, file, name = words(one.name)]
        { emit statusMessage(tr("“%1” is in %2").arg(name, QFile::decodeName(file.c_str()))); };
      });
}

void AttachmentsController::changeNote(const std::string& name)
{
  bool isEntered = false;
  const QString note = QInputDialog::getMultiLineText(
      &m_window, tr("Note"), tr("What there is to say of “%1”:").arg(words(name)),
      words(scene::findAttachment(m_model.value(), name).note), &isEntered);
  if (isEntered)
    change([&] { m_model.setAttachmentNote(name, bytes(note)); });
}

void AttachmentsController::remove(const std::string& name)
{
  if (QMessageBox::question(&m_window, tr("Attachments"),
                            tr("Take “%1” out of the case?").arg(words(name))) == QMessageBox::Yes)
    change([&] { m_model.removeAttachment(name); });
}

void AttachmentsController::change(const std::function<void()>& what)
{
  if (!m_model.hasCase())
    return;
  try
  {
    what();
    emit changed();
  }
  catch (const core::Error& error)
  {
    emit statusMessage(toString(error));
  }
}

} // namespace petrous::workstation
