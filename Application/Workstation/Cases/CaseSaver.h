#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include <QObject>

#include "BackgroundWork.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

/// Saves the open case in a thread of its own, so that no stroke and no picture waits for the disk
/// or for another program's lock. One save at a time, in the order in which they were asked for;
/// what is asked for while one is under way is one more save of what the case is then.
///
/// Exactly one signal tells how a save ended.
class CaseSaver : public QObject
{
  Q_OBJECT
public:
  explicit CaseSaver(presenters::WorkstationModel& model);
  ~CaseSaver() override; ///< what is under way ends first, and is told to nobody

  /// Asked before each save for the camera that is kept with the case.
  std::function<core::CameraPose()> camera;

  void save();
  void saveAs(const std::string& name);
  /// Into the library in another folder, by the same name or one that is free there.
  void saveElsewhere(const std::filesystem::path& folder);

  /// Saves what is unsaved and waits for it, with the window drawn but deaf. False: it could not be
  /// saved, and `failed` has said why.
  bool flush();

  bool busy() const noexcept { return m_work.busy(); }

signals:
  void saved(const QString& name);
  void failed(const QString& why);

private:
  using Begin = std::function<presenters::StoreTask()>; // in the window's thread, before it is read
  void ask(Begin begin);
  void start(const Begin& begin);
  void ended();

  presenters::WorkstationModel& m_model;
  BackgroundWork m_work;
  std::optional<Begin> m_next;
  bool m_well = true; // the last one
};

} // namespace petrous::workstation
