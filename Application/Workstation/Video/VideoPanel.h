#pragma once

#include <array>
#include <functional>
#include <optional>

#include <QStringList>

#include "Bind.h"
#include "Panels.h"

class QAction;
class QCheckBox;
class QComboBox;
class QLabel;
class QSlider;
class QTableWidget;
class QToolButton;
class QTreeWidget;
class QVBoxLayout;

namespace petrous::presenters
{
class VideoEditor;
}

namespace petrous::workstation
{

class VideoPicture;

/// The video beside the scene: the frame that is seen, its place, bookmarks, and the landmarks of a
/// still with what is known of its camera.
class VideoPanel : public Panel
{
  Q_OBJECT
public:
  struct Actions
  {
    QAction *play, *back, *forth, *loop, *bookmark, *pair, *view;
  };
  VideoPanel(const presenters::WorkstationModel& model, presenters::VideoEditor& editor,
             const Actions& actions, QWidget* parent = nullptr);

  VideoPicture& picture() noexcept { return *m_picture; }
  void setDuration(qint64 milliseconds); ///< 0: it is not known
  void setPlace(std::int64_t nanoseconds);
  void setOpening(bool isOpening);
  void say(const QString& text); ///< what went wrong; empty: nothing
  void setOver(bool isOver);     ///< the 3D view is the still's
  void refresh();
  void refreshAnew(); ///< also what was typed and refused
  std::vector<std::size_t> chosenBookmarks() const;

  // What the panel hears it hears through its controller, which knows the case, too.
  std::function<void()> onCaseChanged, onStateChanged, onAttachmentsChanged;
  void caseChanged() override;
  void stateChanged() override;
  void attachmentsChanged() override;
  void partsChanged() override {}

signals:
  void videoChosen(const QString& name); ///< empty: none
  void attachAsked();
  void seekAsked(qint64 milliseconds);
  void bookmarkActivated(int bookmark);
  void bookmarkRenamed(int bookmark, const QString& name);
  void moveAsked(int bookmark);
  void tieAsked(int bookmark);
  void bookmarkRemovalAsked(int bookmark);
  void pairRemovalAsked(int pair);
  void stillRemovalAsked();
  void angleSet(double degrees); ///< 0: it is found
  void opacitySet(double opacity);
  void overlayAsked(bool on);

private:
  void addBookmarks(QVBoxLayout& layout, const Actions& actions);
  void addStill(QVBoxLayout& layout, const Actions& actions);
  void refreshVideos();
  void refreshBookmarks();
  void enableBookmarks();
  void refreshStill();
  QString stillText() const;

  const presenters::WorkstationModel& m_model;
  presenters::VideoEditor& m_editor;
  QComboBox* m_videos;
  VideoPicture* m_picture;
  QSlider* m_place;
  QLabel* m_time;
  QLabel* m_fault;
  QTreeWidget* m_bookmarks;
  std::vector<QToolButton*> m_ofBookmark;
  QTableWidget* m_pairs;
  QToolButton* m_removePair;
  QToolButton* m_removeStill;
  QLabel* m_camera;
  QCheckBox* m_overlay;
  QSlider* m_opacity;
  Bindings m_bound;
  QStringList m_namesShown, m_bookmarksShown; // lists are made anew where they differ
  std::string m_bookmarksOf;                  // video
  qint64 m_duration = 0;                      // ms
  bool m_isOpening = false;
  bool m_refreshing = false;
};

} // namespace petrous::workstation
