#include "FaceCheck.h"

#include <memory>

#include <QApplication>
#include <QEventLoop>
#include <QProgressDialog>

#include "BackgroundWork.h"
#include "Theme.h"
#include "petrous/Presenters/CaseTransfer.h"

namespace petrous::workstation
{

namespace
{

struct WaitCursor
{
  WaitCursor() { QApplication::setOverrideCursor(Qt::WaitCursor); }
  ~WaitCursor() { QApplication::restoreOverrideCursor(); }
  WaitCursor(const WaitCursor&) = delete;
  WaitCursor& operator=(const WaitCursor&) = delete;
};

} // namespace

FaceCheck lookForFaces(const scene::Case& value, QWidget& parent)
{
  const WaitCursor cursor;
  QProgressDialog progress(QObject::tr("Looking for a face in the images…"), {}, 0, 0, &parent);
  progress.setObjectName("faceProgress");
  progress.setWindowModality(Qt::WindowModal);
  progress.setMinimumDuration(500);
  progress.setValue(0);
  FaceCheck result{{}, false};
  QEventLoop loop;
  BackgroundWork work; // ends before what it refers to
  QObject::connect(&work, &BackgroundWork::failed, &loop, &QEventLoop::quit);
  QObject::connect(&work, &BackgroundWork::cancelled, &loop, &QEventLoop::quit);
  const auto copy = std::make_shared<const scene::Case>(value); // shares voxels
  work.start(
      [&result, &loop, copy](const core::Progress&) -> BackgroundWork::Reply
      {
        return [&result, &loop, images = presenters::facesToMask(*copy)]
        {
          result = {images, true};
          loop.quit();
        };
      });
  loop.exec(QEventLoop::ExcludeUserInputEvents);
  return result;
}

QString textOf(const FaceCheck& faces)
{
  if (!faces.isKnown)
    return QObject::tr("Whether a face can be recognised is not known, as an image of the case "
                       "could not be read.");
  QStringList images;
  for (const std::string& image : faces.images)
    images += words(image);
  return images.isEmpty() ? QString()
                          : QObject::tr("A face can be recognised in %1.").arg(images.join(", "));
}

} // namespace petrous::workstation
