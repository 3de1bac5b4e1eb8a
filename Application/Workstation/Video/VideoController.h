#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include <QImage>
#include <QObject>

#include "petrous/Presenters/VideoEditor.h"
#include "petrous/Video/VideoPlayer.h"

class QAction;
class QMenu;
class QWidget;

namespace petrous::workstation
{

class AttachmentsController;
class BackgroundWork;
class StillOverlay;
class ThreeDView;
class VideoPanel;

/// The operative video beside the scene. No thread is started, and no decoder loaded, before a
/// video is chosen.
class VideoController : public QObject
{
  Q_OBJECT
public:
  /// All must outlive this; `window` is the parent of dialogs.
  VideoController(presenters::WorkstationModel& model, ThreeDView& view,
                  AttachmentsController& attachments, QWidget& window);
  ~VideoController() override;

  VideoPanel* panel() const noexcept { return m_panel; } ///< owned by the window that takes it
  QMenu* menu() const noexcept { return m_menu; }

  /// Shows the bone in the state after a stroke (BranchController::goToState).
  std::function<void(const std::string& branch, std::size_t stroke)> goToState;

  void stateChanged(); ///< the bone may be in another state

signals:
  void changed(); ///< bookmarks or stills: to be saved
  void panelWanted();
  void statusMessage(const QString& line);

private:
  /// From the player's thread.
  struct Mail
  {
    std::mutex mutex;
    std::optional<video::Frame> frame; // the latest
    video::VideoPlayer::Opening opening = 0;
    bool isPosted = false;
  };

  void addActions();
  void connectPanel();
  video::VideoPlayer& player();
  void caseChanged();
  void attachmentsChanged();
  void choose(const std::string& name);
  void closeVideo();
  void checkLinked(const petrous::scene::Attachment& one);
  void opened(const video::VideoInfo& info);
  void failed(const QString& why);
  void tellGap(const video::Gap& gap);
  void step(int by);
  void takeFrame();
  void goToBookmark(std::size_t bookmark);
  void stepBookmark(int by);
  void setLoop(bool on);
  void addPair();
  void showView(bool on);
  void refresh();
  bool attempt(const std::function<void()>& what);
  void follow(const std::function<void()>& what); // what is said stays, as nobody asked for it

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  AttachmentsController& m_attachments;
  presenters::VideoEditor m_editor;
  std::unique_ptr<BackgroundWork> m_work;  // seeks cameras
  std::unique_ptr<BackgroundWork> m_check; // that a linked file is what was attached
  QMenu* m_menu;
  QAction *m_play, *m_back, *m_forth, *m_nextBookmark, *m_previousBookmark, *m_loop, *m_bookmark,
      *m_pair, *m_showView;
  VideoPanel* m_panel;
  StillOverlay* m_overlay;
  std::shared_ptr<Mail> m_mail;
  QImage m_frame;
  std::size_t m_awaited = 0;                 // videos, once one that is being attached is there
  video::VideoPlayer::Opening m_opening = 0; // of the chosen video; 0: none
  int m_steps = 0;                           // that were asked for, and not shown yet
  bool m_isOpening = false;
  bool m_isPlaying = false;
  bool m_goesAlong = false; // to a bookmark's stroke: the video is there already
  bool m_showsStill = true;
  std::string m_stroke;                         // after which the bone was last
  std::unique_ptr<video::VideoPlayer> m_player; // last: its thread calls this
};

} // namespace petrous::workstation
