#pragma once

#include <functional>
#include <memory>
#include <thread>

#include <QObject>
#include <QStringList>

#include "petrous/Library/Library.h"
#include "petrous/Presenters/CaseBuilder.h"

namespace petrous::workstation
{

/// Makes a case from files and saves it, on a thread of its own. The case is handed out as soon as
/// it can be looked at; saving goes on behind it.
///
/// Signals arrive on the thread of the receiver. Exactly one of failed, cancelled, severalSeries
/// and saved ends the job.
class ImportJob : public QObject
{
  Q_OBJECT
public:
  /// Tells what to read; runs on the job's thread and may take long (the sample patient).
  using Prepare = std::function<presenters::CaseSources(const core::Progress&)>;

  ImportJob(library::Library library, std::string caseName, Prepare prepare);
  ~ImportJob() override; ///< cancels, and waits for the thread

  void start();
  void cancel(); ///< until the case was handed out
  void wait();   ///< for the thread's end; the signals it sent may still be on their way

signals:
  void progressed(double fraction, const QString& text);
  void built(const std::shared_ptr<petrous::scene::Case>& value);
  void saved(const std::shared_ptr<petrous::scene::Case>& value);
  void failed(const QString& why, bool wasBuilt);
  void cancelled();
  /// The folder holds more than one good series: their UIDs, and what tells them apart.
  void severalSeries(const QStringList& uids, const QStringList& descriptions);

private:
  void run();
  void offerSeries(const std::filesystem::path& folder, const core::Progress& progress);

  library::Library m_library;
  std::string m_name;
  Prepare m_prepare;
  std::shared_ptr<core::CancelToken> m_token;
  std::thread m_thread;
};

/// An exception in words. Texts of other libraries may carry patient data; they are left out.
QString inWords(const std::exception& error);

} // namespace petrous::workstation

Q_DECLARE_METATYPE(std::shared_ptr<petrous::scene::Case>)
