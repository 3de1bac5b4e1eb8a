#pragma once

#include <functional>
#include <memory>

#include <QObject>
#include <QPointer>
#include <QStringList>

#include "petrous/Presenters/ViewSettings.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Rendering/SceneContents.h"

class QLabel;
class QWidget;

namespace petrous::workstation
{

class PicturePanel;
class SurgeonWindow;
class ThreeDView;
class WindowActions;
class WindowSettings;

/// Lamp, background, stereo and the surgeon's window; frame rate, and handling of rendering
/// failures.
class PictureController : public QObject
{
  Q_OBJECT
public:
  /// Connects the stereo and surgeon's window actions of `actions`. Lamp, background and stereo are
  /// restored from and stored in `kept`.
  PictureController(presenters::WorkstationModel& model, ThreeDView& view, WindowActions& actions,
                    WindowSettings& kept, QWidget& window, bool quadBuffer);
  ~PictureController() override;

  /// Saves the case if rendering fails; returns false if it could not be saved.
  std::function<bool()> flush;

  PicturePanel* panel() const noexcept { return m_panel; } ///< owned by the window that takes it
  QLabel* speed() const noexcept { return m_speed; }       ///< for the status bar

  /// Before caseChanged: that the first picture is on its way. Its shaders are compiled in this
  /// thread, which may take seconds.
  void announce();
  void caseChanged();
  void appearanceChanged();
  void closeSurgeonWindow();

  /// Lamp and stereo as the case was saved with, else as the user has them. The user's own settings
  /// stay as they are.
  void showView(const scene::ViewState& view);
  const presenters::ViewSettings& settings() const noexcept { return m_settings; }
  /// A surface that is not of the case, shown with it; without triangles: none.
  void setDraft(const rendering::MeshContents& surface);

signals:
  void statusMessage(const QString& line); ///< for the status bar

protected:
  bool eventFilter(QObject* watched, QEvent* event) override; ///< of the window

private:
  void showScene();
  bool isBuried() const; ///< the camera, in opaque tissue
  void showNotes();
  void lightChanged();
  void backgroundChanged();
  void noteStep(const std::string& what, const std::string& merged,
                const std::function<void()>& undo, const std::function<void()>& redo);
  void openSurgeonWindow();
  void applyStereo();
  void showSpeed(double milliseconds, double scale, bool moving);
  void fail(const QString& why);

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  WindowActions& m_actions;
  QWidget& m_window;
  WindowSettings& m_kept;
  const bool m_quadBuffer;
  QStringList m_notes;        ///< of the scene, wherever the camera is
  bool m_isBuried = false;    ///< as the notes say
  bool m_isShowing = false;   ///< a case's settings, which are not the user's
  bool m_isAnnounced = false; ///< a picture whose scene is not there yet
  bool m_isFirst = false;     ///< the picture that is drawn next, after it was announced
  bool m_isStepping = false;  ///< undo or redo of a change of light or background
  presenters::ViewSettings m_settings;
  scene::ViewState::Light m_lightBefore; ///< as it was shown last
  rendering::BackgroundColor m_backgroundBefore;
  PicturePanel* m_panel;
  QLabel* m_speed;
  QPointer<SurgeonWindow> m_surgeon;
  rendering::MeshContents m_draft;
};

} // namespace petrous::workstation
