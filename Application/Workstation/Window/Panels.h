#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <QWidget>

namespace petrous::haptics
{
struct Pose;
}

namespace petrous::presenters
{
class MeasuredTool;
struct ToolSurroundings;
class WorkstationModel;
} // namespace petrous::presenters

namespace petrous::workstation
{

class AttachmentsController;
class BranchController;
class LibraryController;
class MeasureController;
class PictureController;
class RegistrationController;
class ReplayController;
class SegmentController;
class ShareController;
class SliceController;
class StrokeThumbnails;
class VideoController;

/// The widget of a dock. A panel overrides what it wants to hear.
class Panel : public QWidget
{
public:
  using QWidget::QWidget;

  virtual void caseChanged() {}                  ///< another case, or none any more
  virtual void partsChanged() { caseChanged(); } ///< images, structures or meshes of the same case
  /// WorkstationEvents::partRenamed
  virtual void partRenamed(const std::string& /*from*/, const std::string& /*to*/) {}
  virtual void appearanceChanged() {}  ///< threshold, or a structure's appearance
  virtual void stateChanged() {}       ///< strokes
  virtual void attachmentsChanged() {} ///< or a recording ended
  /// A burr or an instrument in use, at X_PT; each frame.
  virtual void toolMoved(const presenters::MeasuredTool& /*tool*/, const haptics::Pose& /*pose*/) {}
  virtual void toolGone() {} ///< it was put away
  /// That has the keyboard when the panel's key is pressed: the first one that takes no text, as
  /// single keys are the window's; null: the keys stay where they are.
  virtual QWidget* mainControl();
  /// Whether it shows distances of the tool, and toolMeasured is wanted with all that is near.
  virtual bool showsNear() const { return false; }
  virtual void toolMeasured(const presenters::ToolSurroundings& /*near*/) {}
};

/// What panels are made from.
struct PanelContext
{
  presenters::WorkstationModel& model;
  PictureController& picture;
  RegistrationController& registration;
  SegmentController& segment;
  LibraryController& library;
  AttachmentsController& attachments;
  MeasureController& measure;
  SliceController& slices;
  BranchController& branches;
  StrokeThumbnails& strokes;
  ShareController& share;
  VideoController& video;
  ReplayController& replay;
};

struct PanelEntry
{
  const char* name; ///< object name of the dock: for settings and tests, so it stays
  QString title;    ///< of the dock and in the View menu
  int key;          ///< shows and raises it, gives it the keyboard, and hides it
  Qt::DockWidgetArea area;
  bool tabbed;    ///< with the other tabbed panels of that area; otherwise below them
  bool atFirst;   ///< shown with the first case, unless the user has chosen otherwise
  bool needsCase; ///< cannot be shown or hidden without a case
  Panel* (*make)(const PanelContext& context);
};

/// The window's panels, in the order of the View menu. A new panel is an entry here and its own
/// code: the window makes its dock, menu entry, shortcut and settings from this, and tells it what
/// happens.
std::vector<PanelEntry> panelEntries();

} // namespace petrous::workstation
