#pragma once

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <QMainWindow>
#include <QStringList>
#include <QTimer>

#include "Bind.h"
#include "Panels.h"
#include "petrous/Presenters/ActiveDevice.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Rendering/StandardViews.h"

class QDockWidget;
class QLabel;
class QMenu;
class QStackedWidget;

namespace petrous::workstation
{

class AttachmentsController;
class Banner;
class BranchController;
class CaseDocumentController;
class CaseJobs;
class CaseSaver;
class CaseStamps;
class ComparisonController;
class DrillBar;
class DrillController;
class DeviceToolBar;
class DeviceWatcher;
class ActiveDeviceController;
class ExchangeController;
class LibraryController;
class ClippingController;
class MeasureController;
class PictureController;
class ProbeLabel;
class RegistrationController;
class ReplayController;
class SegmentController;
class ShareController;
class SliceColumn;
class SliceController;
class StartPage;
class StrokeThumbnails;
class ThicknessController;
class ThreeDView;
class VideoController;
class ViewArea;
class ViewStateController;
class WindowActions;
class WindowSettings;

/// Options of the main window.
struct WindowOptions
{
  bool quadBuffer = false;           ///< quad-buffered stereo is available (quadBufferOffered)
  QString settings;                  ///< an INI file; empty: the user's default
  presenters::DeviceSources devices; ///< none: mouse only
  int lookForDevicesEvery = 0;       ///< ms; 0: when something is plugged in (DeviceWatcher)
  int drawThumbnailsAfter = 2000;    ///< ms without anything else to do; negative: never
  int saveAfter = 20000;             ///< ms since a change that nothing else saved; negative: never
  bool isSafe = false;               ///< no settings, devices, thumbnails or previous case
};

/// The workstation's main window: assembles model, views and panels and connects them.
class MainWindow : public QMainWindow
{
  Q_OBJECT
public:
  explicit MainWindow(library::Library library, const WindowOptions& options = {});
  ~MainWindow() override;

  /// Opens what was given on the command line: a case or a path; empty: the latest case, if any.
  void begin(const QString& what);

  const presenters::WorkstationModel& model() const noexcept { return m_model; }
  /// Whether files or cases are being read or written.
  bool busy() const;

protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override; ///< of number and choice boxes

private:
  void guardBoxes();
  void layOut();
  void connectModel();
  void connectActions();
  void connectSound();
  void connectViews();
  void connectSegment();
  void connectMeasure();
  void connectThumbnails();
  void connectJobs();
  void caseChanged();
  void caseClosed();
  void partsChanged();
  void notifyNotes();
  void showNotes(const QStringList& notes); // in place of those that are shown; none: hides them
  void warnOfSides();
  void showFault(const QString& why);
  void offerBurrs();
  void tellOtherBurr(); // taken in place of the wanted one
  void editCatalogues();
  void maskChanged(const core::IndexBox& box);
  void stateChanged();
  void saveLater();
  void showUndo();
  void showInstrumentOut();
  bool undoesSegment() const;
  bool redoesSegment() const;
  void step(bool back);                       // undo or redo
  bool disturbsRegistration(bool back) const; // that step of the case
  QString disturbsText() const;
  bool undoesMeasure() const;
  void notice(const QString& text);
  void showView(rendering::StandardView view);
  void sideAnswered();
  void stepped(bool back); // by an undo or a redo
  void addPanels();
  QDockWidget* addDock(const PanelEntry& entry, Panel* panel);
  void showPanels();
  void keepPanels();
  void tellPanels();
  void fillCaseMenu();
  void addSelectedTo(QMenu& menu);
  void correctAxes(const std::string& part);
  void showUnregistered(bool opened);
  void raisePanel(const char* dock);
  void showLibrary();
  void showKeys();
  void findCommand();
  void showSettings();
  void record(bool on);
  std::filesystem::path chooseRecording();
  void showRecording(const QString& fault);
  bool flush(); // saves what was drilled
  void strokeEnded(const std::shared_ptr<const dissection::Stroke>& stroke);

  const WindowOptions m_options;
  presenters::WorkstationModel m_model;
  std::unique_ptr<WindowSettings> m_settings;
  DrillBar* m_bar;
  DeviceToolBar* m_deviceBar;
  ThreeDView* m_view;
  SliceColumn* m_slices;
  ViewArea* m_area;
  StartPage* m_start;
  QStackedWidget* m_pages;
  Banner* m_unsavedBanner;
  Banner* m_loadingBanner;
  Banner* m_faultBanner;
  Banner* m_notesBanner;
  Banner* m_damageBanner;
  Banner* m_recordingBanner;
  Banner* m_removedBanner;
  Banner* m_mrBanner;
  Banner* m_sideBanner;
  QStringList m_notesTold;
  QString m_earDoubt;       // shown until another view is chosen
  QStringList m_notesShown; // above the pictures, not dismissed yet
  ProbeLabel* m_place;
  QLabel* m_sum;
  QLabel* m_touch;
  QLabel* m_recording;
  WindowActions* m_actions;
  CaseStamps* m_stamps;
  CaseSaver* m_saver;
  bool m_isClosing = false;
  CaseJobs* m_jobs;
  CaseDocumentController* m_keeper;
  DeviceWatcher* m_watcher;
  ActiveDeviceController* m_devices;
  DrillController* m_drill;
  PictureController* m_picture;
  BranchController* m_branches;
  StrokeThumbnails* m_strokes;
  ComparisonController* m_comparison;
  RegistrationController* m_registration;
  SegmentController* m_segment;
  MeasureController* m_measure;
  ClippingController* m_clipping; ///< after m_measure: its handles come first
  SliceController* m_sliceControl;
  LibraryController* m_library;
  ExchangeController* m_exchange;
  AttachmentsController* m_attachments;
  ViewStateController* m_viewState;
  ShareController* m_share;
  VideoController* m_video;
  ReplayController* m_replay;
  std::vector<std::pair<PanelEntry, Panel*>> m_panels;
  ThicknessController* m_thickness;
  QTimer m_saveLater;
  QTimer m_keepLater; // panels, once they rest
  bool m_hasShownPanels = false;
  Bindings m_bound;
};

} // namespace petrous::workstation
