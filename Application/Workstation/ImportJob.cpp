#include "ImportJob.h"

#include <atomic>
#include <new>

#include "Theme.h"
#include "petrous/Imaging/DicomScan.h"

namespace petrous::workstation
{

ImportJob::ImportJob(library::Library library, std::string caseName, Prepare prepare)
  : m_library(std::move(library))
  , m_name(std::move(caseName))
  , m_prepare(std::move(prepare))
  , m_token(std::make_shared<core::CancelToken>())
{
  m_library.onNotice({}); // the window hears of it in its own thread only
  qRegisterMetaType<std::shared_ptr<scene::Case>>();
  qRegisterMetaType<std::shared_ptr<scene::Case>>("std::shared_ptr<petrous::scene::Case>");
}

ImportJob::~ImportJob()
{
  cancel();
  wait();
}

void ImportJob::start()
{
  m_thread = std::thread([this] { run(); });
}

void ImportJob::cancel()
{
  m_token->cancel();
}

void ImportJob::wait()
{
  if (m_thread.joinable())
    m_thread.join();
}

void ImportJob::run()
{
  bool wasBuilt = false;
  std::filesystem::path folder;
  const core::Progress quiet(nullptr, m_token);
  try
  {
    const auto percent = std::make_shared<std::atomic<int>>(-1);
    const core::Progress progress(
        [this, percent](double fraction, const std::string& text)
        {
          const int now = static_cast<int>(100.0 * fraction);
          if (percent->exchange(now) != now)
            emit progressed(fraction, words(text));
        },
        m_token);
    const auto sources = m_prepare(progress.part(0.0, 0.5));
    folder = sources.ct;
    // What was prepared quickly does not count as half of the work.
    const bool prepared = percent->load() >= 0;
    auto value = std::make_shared<scene::Case>(
        presenters::buildCase(m_name, sources, prepared ? progress.part(0.5, 1.0) : progress));
    progress.check("import");
    auto stored = std::make_shared<scene::Case>(*value);
    wasBuilt = true;
    emit built(value);
    m_library.save(*stored);
    emit saved(stored);
  }
  catch (const imaging::DicomError& error)
  {
    if (error.reason() == imaging::DicomError::Reason::Ambiguous)
      offerSeries(folder, quiet);
    else
      emit failed(inWords(error), wasBuilt);
  }
  catch (const core::Error& error)
  {
    if (error.fault() == core::Fault::Cancelled)
      emit cancelled();
    else
      emit failed(inWords(error), wasBuilt);
  }
  catch (const std::exception& error)
  {
    emit failed(inWords(error), wasBuilt);
  }
}

void ImportJob::offerSeries(const std::filesystem::path& folder, const core::Progress& progress)
{
  try
  {
    QStringList uids;
    QStringList descriptions;
    for (const auto& series : imaging::scanDicom(folder, progress).series)
    {
      if (series.geometry.verdict != imaging::Verdict::Ok || !series.geometry.grid)
        continue;
      const auto& spacing = series.geometry.grid->spacing();
      uids << words(series.uid);
      descriptions << tr("%1.  %2  %3  (%4 slices, %5 × %6 × %7 mm)")
                          .arg(uids.size())
                          .arg(words(series.modality), words(series.description))
                          .arg(series.geometry.slices.size())
                          .arg(spacing[0], 0, 'g', 3)
                          .arg(spacing[1], 0, 'g', 3)
                          .arg(spacing[2], 0, 'g', 3);
    }
    emit severalSeries(uids, descriptions);
  }
  catch (const core::Error& error)
  {
    if (error.fault() == core::Fault::Cancelled)
      emit cancelled();
    else
      emit failed(inWords(error), false);
  }
}

QString inWords(const std::exception& error)
{
  if (dynamic_cast<const core::Error*>(&error))
    return words(error.what());
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return QObject::tr("There is not enough memory; close other programs.");
  return QObject::tr("An unexpected fault; the library is as it was before.");
}

} // namespace petrous::workstation
