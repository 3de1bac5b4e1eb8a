#pragma once

#include <vector>

#include <QObject>

#include "petrous/Presenters/HandpiecePresets.h"
#include "petrous/Rendering/StandardViews.h"

class QAction;
class QActionGroup;
class QMainWindow;
class QMenu;

namespace petrous::workstation
{

class DrillBar;
class DeviceToolBar;

/// The window's actions with their shortcuts, in the menus and the tool bar. The window connects
/// them.
class WindowActions : public QObject
{
  Q_OBJECT
public:
  /// Fills the window's menu bar and adds a tool bar and the two given bars at the top.
  /// `quadBuffer`: the driver supports quad-buffered stereo.
  WindowActions(QMainWindow& window, DrillBar& drillBar, DeviceToolBar& deviceBar, bool quadBuffer);

  void addPanelToggle(QAction* action, bool needsCase); ///< to the View menu
  void addSavedViews(QMenu* menu);                      ///< to the View menu
  void addSliceMenu(QMenu* menu);                       ///< to the View menu
  void setCaseOpen(bool open);                          ///< disables what needs a case
  void setOnMr(bool isMr); ///< names what is seen and drilled: bone, or an MR's tissue

  QAction* openDicom;
  QAction* openRegion;
  QAction* openFileRegion;
  QAction* openImage;
  QAction* openCase;
  QAction* sample;
  QAction* save;
  QAction* saveAs;
  QAction* report;
  QAction* printPicture;
  QAction* film;
  QAction* closeCase;
  QAction* quit;
  QMenu* casePart; ///< the Case menu; the window completes it
  QAction* addMrFolder;
  QAction* addMrFile;
  QAction* addLabels;
  QAction* addMasks;
  QAction* addMesh;
  QAction* correctAxes;
  QActionGroup* sides; ///< checkable; each one's data is its scene::Side
  QAction* restorePart;
  QAction* exportPart;
  QAction* attach;
  QAction* archive;
  QAction* restore;
  QAction* undo;
  QAction* redo;
  QAction* rollLeft;
  QAction* rollRight;
  QAction* centerView;
  QAction* boneThickness; ///< checkable
  QAction* clipHere;
  QAction* clipOff;
  QAction* clipDeeper;
  QAction* clipLess;
  QAction* clipTurnLeft;
  QAction* clipTurnRight;
  QAction* cropBox; ///< checkable
  QAction* cropNumbers;
  QActionGroup* layouts; ///< checkable; each one's data is its ViewLayout
  QAction* enlargeView;  ///< checkable
  QAction* boneWindow;
  QAction* softWindow;
  QAction* temporalWindow;
  QAction* fitSlices;
  QMenu* approaches;
  QActionGroup* stereo;   ///< checkable; each one's data is its StereoMode
  QAction* surgeonWindow; ///< checkable
  QAction* slicesFollow;  ///< checkable
  QAction* drillSound;    ///< checkable
  QAction* strokeCamera;  ///< checkable
  QAction* instrumentFile;
  QAction* instrumentOut;
  QAction* smallerBurr;
  QAction* largerBurr;
  QAction* otherKind;
  QAction* turnLeft;
  QAction* turnRight;
  QAction* tiltMore;
  QAction* tiltLess;
  QAction* holdAsAtFirst;
  QAction* leftHand;  ///< checkable
  QAction* burrAlone; ///< checkable
  QAction* record;    ///< checkable
  QAction* catalogues;
  QAction* openRecording;
  QAction* playRecording;
  QAction* settings;
  QAction* keyList;
  QAction* manual;
  QAction* findCommand;
  QAction* about;

signals:
  void viewChosen(petrous::rendering::StandardView view);
  void handpieceChosen(petrous::presenters::SurgicalApproach approach);

private:
  QMenu* addStereo(bool quadBuffer);
  QMenu* addLayouts();
  void addSides();

  QMenu* m_view = nullptr;
  QMenu* m_panels = nullptr;      ///< in it
  QMenu* m_greyWindows = nullptr; ///< in it
  QAction* m_layout = nullptr;    ///< of its menu in it
  QMenu* m_viewButton = nullptr;  ///< in the tool bar
  std::vector<QAction*> m_needCase;
};

} // namespace petrous::workstation
