#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include <QObject>

#include "BackgroundWork.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

/// Saves the open case in a separate thread, so that neither drilling nor rendering waits for the
/// disk or for another program's lock. One save at a time, in the order requested; requests during
/// a save are merged into one more save of the case's state at that time.
///
/// Each save ends with exactly one signal.
class CaseSaver : public QObject
{
  Q_OBJECT
public:
  explicit CaseSaver(presenters::WorkstationModel& model);
  ~CaseSaver() override; ///< waits for a running save, without a signal

  /// Hands what is to be stored of the view to the case; called before each save.
  std::function<void()> aboutToSave;

  void save();
  void saveAs(const std::string& name);
  /// Into the library in another folder, under the same name or a free one.
  void saveElsewhere(const std::filesystem::path& folder);

  /// Saves what is unsaved and waits, with the window painted but not accepting input. Returns
  /// false if saving failed, as reported by `failed`.
  bool flush();

  /// Cancels a running save; the case on disk stays as it was.
  void stop();

  bool busy() const noexcept { return m_work.busy(); }

signals:
  void saved(const QString& name);
  void failed(const QString& why);

private:
  using Begin = std::function<presenters::StoreTask()>; // in the window's thread, before reading
  void ask(Begin begin);
  void start(const Begin& begin);
  void ended();

  presenters::WorkstationModel& m_model;
  BackgroundWork m_work;
  std::optional<Begin> m_next;
  bool m_well = true; // the last save succeeded
};

} // namespace petrous::workstation
