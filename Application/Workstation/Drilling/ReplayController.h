#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "BackgroundWork.h"
#include "petrous/Presenters/SessionReview.h"
#include "petrous/Presenters/WorkstationModel.h"

class QAction;
class QWidget;

namespace petrous::workstation
{

class ReplayPanel;
class ThreeDView;

/// Plays a recorded operation, of one or several recordings, on the open case: a ghost of its tool
/// in the 3D view, beside the tool in use. The case stays as it is; the recorded cuts are repeated
/// on a copy, to be measured.
class ReplayController : public QObject
{
  Q_OBJECT
public:
  /// `play` toggles playing. All must outlive this; `window` is the parent of dialogs.
  ReplayController(presenters::WorkstationModel& model, ThreeDView& view, QAction& play,
                   QWidget& window);
  ~ReplayController() override;

  ReplayPanel* panel() const noexcept { return m_panel; } ///< owned by the window that takes it

  void openFile(); ///< one that the user chooses
  void open(const std::filesystem::path& file) { open(std::vector{file}); }
  void open(const std::vector<std::filesystem::path>& files); ///< of one operation, in order
  void caseReady(); ///< it is prepared for tools: what was asked for before is read now

  const std::optional<presenters::OperationReview>& review() const noexcept { return m_review; }
  double time() const noexcept { return m_time; } ///< s
  bool playing() const { return m_frames.isActive(); }

signals:
  void panelWanted();
  void statusMessage(const QString& line);

private:
  struct Source
  {
    QString name;
    std::vector<std::filesystem::path> files; ///< empty: an attachment
    std::string attachment;
  };
  void listRecordings();
  void choose(int row);
  void read(std::vector<std::filesystem::path> files);
  void close();
  void togglePlay();
  void play(bool on);
  void frame();
  void goTo(double seconds);
  void showGhost();
  void toolMoved();
  void exportTable();

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  QAction& m_play;
  QWidget& m_window;
  ReplayPanel* m_panel;
  BackgroundWork m_work;
  std::vector<Source> m_sources;
  std::vector<std::filesystem::path> m_files; ///< that are open, or being read
  std::optional<presenters::OperationReview> m_review;
  QTimer m_frames;
  QElapsedTimer m_sinceFrame;
  double m_time = 0.0; // s
  bool m_wasDrilling = false;
  bool m_waits = false; // m_files are read when the case is ready and no stroke is open
};

} // namespace petrous::workstation
