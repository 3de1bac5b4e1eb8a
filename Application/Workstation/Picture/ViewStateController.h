#pragma once

#include <functional>
#include <optional>

#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

class QMenu;
class QWidget;

namespace petrous::workstation
{

class DrillBar;
class PictureController;
class RegistrationController;
class SliceColumn;
class ThreeDView;

/// Shows the view that a case was saved with (scene::ViewState and camera), and hands the present
/// one to the case before a save. What the user did not change keeps the bits that it was saved
/// with, although boxes round and cameras are normalized.
class ViewStateController : public QObject
{
  Q_OBJECT
public:
  /// All must outlive this.
  ViewStateController(presenters::WorkstationModel& model, ThreeDView& view, SliceColumn& slices,
                      PictureController& picture, RegistrationController& registration,
                      DrillBar& bar, QWidget& window);

  void show();    ///< of the case that was just opened
  void collect(); ///< before a save
  bool isShowing() const noexcept { return m_isShowing; }

  void savedViewsChanged(); ///< of the model
  /// Camera and slices, under a name of the user's; they are saved with the case.
  QMenu* savedMenu() const noexcept { return m_savedMenu; }

  /// The instrument that the case is to keep, and the one that it has.
  std::function<std::optional<scene::ViewState::Instrument>()> instrument;
  std::function<void(const std::optional<scene::ViewState::Instrument>&)> showInstrument;

  /// Likewise how the handpiece is held.
  std::function<std::optional<scene::ViewState::Handpiece>()> handpiece;
  std::function<void(const std::optional<scene::ViewState::Handpiece>&)> showHandpiece;

  // Camera and slices alone, which an approach has of its own.
  void collectPlace(); ///< before the approach is left
  void showPlace();    ///< of the approach that the case is on now

signals:
  void statusMessage(const QString& line);

private:
  struct State
  {
    core::CameraPose camera;
    scene::ViewState view;
  };
  State present() const;
  scene::ViewState takePlace(const State& now, bool all);
  void placeShown(const State& now);
  void fillSaved();
  void saveAs();
  void showSaved(const std::string& name);

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  SliceColumn& m_slices;
  PictureController& m_picture;
  RegistrationController& m_registration;
  DrillBar& m_bar;
  State m_shown; ///< as the window had it when it showed what the case has now
  bool m_isShowing = false;
  QWidget& m_window;
  QMenu* m_savedMenu;
};

} // namespace petrous::workstation
