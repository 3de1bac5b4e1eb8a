#include "FaceCheck.h"

#include <memory>

#include <QApplication>
#include <QEventLoop>
#include <QProgressDialog>
#include <QTimer>

#include "BackgroundWork.h"
#include "Theme.h"
#include "WindowTexts.h"
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
  constexpr int kShownAfter = 500; // ms
  FaceCheck result;
  result.isKnown = false;
  QEventLoop loop;
  BackgroundWork work; // ends before what it refers to
  bool isDone = false;
  const auto done = [&loop, &isDone]
  {
    isDone = true;
    loop.quit();
  };
  QObject::connect(&work, &BackgroundWork::failed, &loop, done);
  QObject::connect(&work, &BackgroundWork::cancelled, &loop, done);
  const auto copy = std::make_shared<const scene::Case>(value); // shares voxels
  work.start(
      [&result, done, copy](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto found = std::make_shared<scene::FaceFindings>();
        return
            [&result, done, found, images = presenters::facesToMask(*copy, progress, found.get())]
        {
          result.images = images;
          result.found = found;
          result.isKnown = true;
          done();
        };
      });
  {
    const WaitCursor cursor;
    QTimer::singleShot(kShownAfter, &loop, &QEventLoop::quit);
    loop.exec(QEventLoop::ExcludeUserInputEvents);
  }
  if (isDone)
    return result;
  QProgressDialog progress(QObject::tr("Looking for a face in the images…"), QObject::tr("Cancel"),
                           0, 0, &parent); // it cannot be told how far it is
  progress.setObjectName("faceProgress");
  progress.setWindowModality(Qt::WindowModal);
  progress.setAutoReset(false);
  progress.setAutoClose(false);
  progress.setMinimumDuration(0);
  QObject::connect(&progress, &QProgressDialog::canceled, &work,
                   [&work, &result, done]
                   {
                     result.isCancelled = true;
                     work.cancel();
                     done(); // the work is joined where it goes out of scope
                   });
  progress.show();
  if (!isDone)
    loop.exec();
  if (!isDone) // the program is being quit, and no event loop runs any more
  {
    result.isCancelled = true;
    work.cancel();
  }
  return result;
}

QString textOf(const scene::ImageWithFace& image)
{
  return image.mr.empty() ? phrase(image.text) : QObject::tr("MR “%1”").arg(words(image.mr));
}

QStringList warningsOf(const std::vector<scene::ImageWithFace>& left)
{
  QStringList warnings;
  for (const std::string& warning : presenters::faceWarnings(left))
    warnings += sentence(capitalized(phrase(warning)));
  return warnings;
}

QString textOf(const FaceCheck& faces)
{
  if (!faces.isKnown)
    return QObject::tr("Whether a face can be recognised is not known, as an image of the case "
                       "could not be read.");
  QStringList images;
  for (const scene::ImageWithFace& image : faces.images)
    images += textOf(image);
  return images.isEmpty() ? QString()
                          : QObject::tr("A face can be recognised in %1.").arg(images.join(", "));
}

} // namespace petrous::workstation
