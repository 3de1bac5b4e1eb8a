#include "Panels.h"

#include <QAbstractSpinBox>
#include <QCoreApplication>
#include <QLineEdit>
#include <QScrollArea>

#include "AppearancePanel.h"
#include "ApproachPanel.h"
#include "AttachmentsController.h"
#include "AttachmentsPanel.h"
#include "BranchController.h"
#include "LibraryController.h"
#include "LibraryPanel.h"
#include "MeasureController.h"
#include "MeasurePanel.h"
#include "NearbyPanel.h"
#include "PictureController.h"
#include "PicturePanel.h"
#include "RegistrationController.h"
#include "RegistrationPanel.h"
#include "ReplayController.h"
#include "ReplayPanel.h"
#include "SegmentController.h"
#include "SegmentPanel.h"
#include "ShareController.h"
#include "SharePanel.h"
#include "SliceController.h"
#include "SlicesPanel.h"
#include "StructuresPanel.h"
#include "Theme.h"
#include "VideoController.h"
#include "VideoPanel.h"

namespace petrous::workstation
{

namespace
{

Panel* approachPanel(const PanelContext& context)
{
  auto* panel = new ApproachPanel(context.model, context.strokes);
  BranchController& branches = context.branches;
  QObject::connect(panel, &ApproachPanel::stateAsked, &branches,
                   [&branches](const QString& name, quint64 state)
                   { branches.goToState(bytes(name), static_cast<std::size_t>(state)); });
  const auto on =
      [panel, &branches](auto signal, void (BranchController::*what)(const std::string&))
  {
    QObject::connect(panel, signal, &branches,
                     [&branches, what](const QString& name) { (branches.*what)(bytes(name)); });
  };
  QObject::connect(panel, &ApproachPanel::approachAsked, &branches,
                   [&branches](const QString& name) { branches.goTo(bytes(name)); });
  QObject::connect(panel, &ApproachPanel::startAsked, &branches, &BranchController::start);
  on(&ApproachPanel::renamingAsked, &BranchController::rename);
  on(&ApproachPanel::removalAsked, &BranchController::remove);
  on(&ApproachPanel::comparisonAsked, &BranchController::compare);
  return panel;
}

} // namespace

QWidget* Panel::mainControl()
{
  const auto isMain = [this](QWidget* widget)
  {
    return isAncestorOf(widget) && widget->isVisibleTo(this) && widget->isEnabled() &&
           (widget->focusPolicy() & Qt::TabFocus) && !qobject_cast<QAbstractSpinBox*>(widget) &&
           !qobject_cast<QLineEdit*>(widget) && !qobject_cast<QScrollArea*>(widget);
  };
  for (QWidget* widget = nextInFocusChain(); widget != this; widget = widget->nextInFocusChain())
    if (isMain(widget))
      return widget;
  return nullptr;
}

std::vector<PanelEntry> panelEntries()
{
  const auto tr = [](const char* text)
  { return QCoreApplication::translate("petrous::workstation", text); };
  constexpr bool kTabbed = true, kAlone = false;
  constexpr bool kShown = true, kHidden = false;
  constexpr bool kNeedsCase = true, kAlways = false;
  using C = const PanelContext&;
  return {
      {"structuresDock", tr("Structures"), Qt::Key_F9, Qt::LeftDockWidgetArea, kTabbed, kShown,
       kNeedsCase, [](C c) -> Panel* { return new StructuresPanel(c.model); }},
      {"appearanceDock", tr("Appearance"), Qt::Key_F10, Qt::LeftDockWidgetArea, kTabbed, kHidden,
       kNeedsCase, [](C c) -> Panel* { return new AppearancePanel(c.model); }},
      {"pictureDock", tr("Picture"), Qt::Key_F8, Qt::LeftDockWidgetArea, kTabbed, kShown, kAlways,
       [](C c) -> Panel* { return c.picture.panel(); }},
      {"slicesDock", tr("Slices"), Qt::SHIFT + Qt::Key_F8, Qt::LeftDockWidgetArea, kTabbed, kHidden,
       kNeedsCase, [](C c) -> Panel* { return c.slices.panel(); }},
      {"nearbyDock", tr("Near the tool"), Qt::Key_F7, Qt::LeftDockWidgetArea, kAlone, kHidden,
       kNeedsCase, [](C c) -> Panel* { return new NearbyPanel(c.model); }},
      {"registrationDock", tr("Registration"), Qt::Key_F5, Qt::LeftDockWidgetArea, kTabbed, kHidden,
       kNeedsCase, [](C c) -> Panel* { return c.registration.panel(); }},
      {"segmentDock", tr("Segment"), Qt::Key_F4, Qt::LeftDockWidgetArea, kTabbed, kHidden,
       kNeedsCase, [](C c) -> Panel* { return c.segment.panel(); }},
      {"libraryDock", tr("Library"), Qt::Key_F3, Qt::LeftDockWidgetArea, kTabbed, kHidden, kAlways,
       [](C c) -> Panel* { return c.library.panel(); }},
      {"attachmentsDock", tr("Attachments"), Qt::Key_F12, Qt::LeftDockWidgetArea, kTabbed, kHidden,
       kNeedsCase, [](C c) -> Panel* { return c.attachments.panel(); }},
      {"measureDock", tr("Measurements"), Qt::CTRL + Qt::Key_M, Qt::LeftDockWidgetArea, kTabbed,
       kHidden, kNeedsCase, [](C c) -> Panel* { return c.measure.panel(); }},
      {"approachDock", tr("Approaches"), Qt::SHIFT + Qt::Key_F9, Qt::LeftDockWidgetArea, kTabbed,
       kHidden, kNeedsCase, approachPanel},
      {"shareDock", tr("Share"), Qt::SHIFT + Qt::Key_F12, Qt::LeftDockWidgetArea, kTabbed, kHidden,
       kNeedsCase, [](C c) -> Panel* { return c.share.panel(); }},
      {"videoDock", tr("Video"), Qt::SHIFT + Qt::Key_F7, Qt::LeftDockWidgetArea, kTabbed, kHidden,
       kNeedsCase, [](C c) -> Panel* { return c.video.panel(); }},
      {"replayDock", tr("Replay"), Qt::SHIFT + Qt::Key_F5, Qt::LeftDockWidgetArea, kTabbed, kHidden,
       kNeedsCase, [](C c) -> Panel* { return c.replay.panel(); }},
  };
}

} // namespace petrous::workstation
