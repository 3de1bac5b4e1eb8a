#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include <QObject>

#include "ImportJob.h"
#include "petrous/Presenters/WorkstationModel.h"

class QProgressDialog;
class QWidget;

namespace petrous::workstation
{

/// Opens, imports, saves and closes cases, and says in words what went wrong. Nothing that was
/// drilled is given up without asking.
class CaseKeeper : public QObject
{
  Q_OBJECT
public:
  /// `window` is the parent of dialogs.
  CaseKeeper(presenters::WorkstationModel& model, QWidget& window);
  ~CaseKeeper() override;

  /// Asked before each save for the camera that is kept with the case.
  std::function<core::CameraPose()> camera;

  void open(const QString& what); ///< a case's name, a DICOM folder or an image file
  void openFolder();              ///< asks for one
  void openImage();               ///< asks for one
  void chooseCase();
  void makeSample();

  bool save(); ///< false: still unsaved, and the user knows
  void saveAs();

  /// Ends imports, saves what is unsaved. False when the user wants to stay.
  bool mayLeave();

  bool importing() const noexcept { return m_job != nullptr; }

signals:
  void said(const QString& line); ///< for the status bar
  void importEnded();

private:
  void openCase(const std::string& name);
  void openPath(const std::filesystem::path& path, const std::string& seriesUid = {});
  void chooseSeries(const QStringList& uids, const QStringList& descriptions);
  void startImport(const std::string& name, ImportJob::Prepare prepare);
  void showProgress(const std::string& name);
  void built(const std::shared_ptr<scene::Case>& value);
  void endJob();
  bool settle(); ///< waits for a case that is being stored
  enum class Choice
  {
    Retry,
    OtherName,
    OtherFolder,
    GiveUp,
    Stay
  };
  Choice askAfterFailure(const QString& why, bool leaving);
  bool keepTrying(bool leaving);
  void refuse(const QString& why);

  presenters::WorkstationModel& m_model;
  QWidget& m_window;
  std::unique_ptr<ImportJob> m_job;
  std::unique_ptr<QProgressDialog> m_progress;
  std::filesystem::path m_source; // of the import
  bool m_saveWanted = false;      // a stroke ended while the case was being stored
};

} // namespace petrous::workstation
