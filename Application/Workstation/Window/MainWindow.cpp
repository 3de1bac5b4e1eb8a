#include "MainWindow.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <QAction>
#include <QActionGroup>
#include <QCloseEvent>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMap>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPointer>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QSlider>
#include <QSpinBox>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabBar>
#include <QToolBar>
#include <QToolButton>
#include <QUrl>
#include <QVBoxLayout>

#include "ActiveDeviceController.h"
#include "AppearancePanel.h"
#include "Application.h"
#include "AskName.h"
#include "AttachmentsController.h"
#include "BackgroundWork.h"
#include "Banner.h"
#include "BranchController.h"
#include "CaseDocumentController.h"
#include "CaseJobs.h"
#include "CaseSaver.h"
#include "CaseStamps.h"
#include "CatalogueDialog.h"
#include "ClippingController.h"
#include "CommandPalette.h"
#include "Commands.h"
#include "ComparisonController.h"
#include "DeviceToolBar.h"
#include "DeviceWatcher.h"
#include "DrillBar.h"
#include "DrillController.h"
#include "ExchangeController.h"
#include "KeyList.h"
#include "LibraryController.h"
#include "LibraryPanel.h"
#include "Manual.h"
#include "MeasureController.h"
#include "MeasurePanel.h"
#include "MessageRoom.h"
#include "PanelLayout.h"
#include "PictureController.h"
#include "ProbeLabel.h"
#include "RegistrationController.h"
#include "ReplayController.h"
#include "SegmentController.h"
#include "SettingsDialog.h"
#include "ShareController.h"
#include "SliceColumn.h"
#include "SliceController.h"
#include "StartPage.h"
#include "StrokeThumbnails.h"
#include "StructureEditor.h"
#include "StructuresPanel.h"
#include "Theme.h"
#include "ThicknessController.h"
#include "ThreeDView.h"
#include "ThumbnailDrawer.h"
#include "ToolDistances.h"
#include "ToolWarnings.h"
#include "VideoController.h"
#include "ViewArea.h"
#include "ViewStateController.h"
#include "WindowActions.h"
#include "WindowSettings.h"
#include "WindowTexts.h"
#include "petrous/Dissection/Catalogues.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Interaction/OrbitCamera.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/CaseStamp.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/Recordings.h"
#include "petrous/Presenters/SlicePlanes.h"

namespace petrous::workstation
{

namespace
{
constexpr int kMessage = 8000;     // ms
constexpr int kFileName = 300;     // px
constexpr int kPanelWidth = 500;   // px, at first: the list of structures with its usual columns
constexpr int kKeepAfter = 500;    // ms, since panels changed
constexpr double kRoll = 5.0;      // degrees
constexpr char kSteps[] = "steps"; // property of a choice box: its last key stepped

// Whether the key goes to another choice of a box whose list is closed.
bool isStep(const QKeyEvent& key)
{
  switch (key.key())
  {
  case Qt::Key_Up:
  case Qt::Key_Down:
    return !(key.modifiers() & Qt::AltModifier); // opens the list
  case Qt::Key_PageUp:
  case Qt::Key_PageDown:
  case Qt::Key_Home:
  case Qt::Key_End:
    return true;
  default:
    return false;
  }
}

QStringList dropped(const QMimeData& data)
{
  QStringList what;
  if (data.hasUrls())
    for (const QUrl& url : data.urls())
      what += url.toLocalFile();
  else if (data.hasText())
    what += data.text().trimmed();
  what.removeAll(QString());
  return what;
}

// What was assumed or left out when the parts of a case were read, by part.
QStringList notesOf(const scene::Case& value)
{
  QStringList notes;
  const auto add = [&notes](const std::string& part, const std::vector<std::string>& more)
  {
    for (const std::string& note : more)
      notes += shownName(part) + ": " + phrase(note);
  };
  add(presenters::primaryName(value), value.ct.notes);
  for (const auto& mr : value.mr)
    add(mr.name, mr.notes);
  for (const auto& part : value.labels)
    add(part.structures.size() == 1 ? part.structures.front().name : "structures", part.notes);
  for (const auto& mesh : value.meshes)
    add(mesh.name, mesh.notes);
  return notes;
}

// Notes "PART: TEXT" of one text in one line, which names the first of the parts.
QStringList joinedNotes(const QStringList& notes)
{
  constexpr int kNamed = 2;
  QStringList texts;
  QMap<QString, QStringList> parts; // of a text
  for (const QString& note : notes)
  {
    const int at = note.indexOf(": ");
    const QString text = at < 0 ? note : note.mid(at + 2);
    if (!texts.contains(text))
      texts += text;
    parts[text] += at < 0 ? QString() : note.left(at);
  }
  QStringList lines;
  for (const QString& text : texts)
  {
    const QStringList of = parts[text];
    if (of.size() <= kNamed)
      for (const QString& part : of)
        lines += part.isEmpty() ? text : part + ": " + text;
    else
      lines += MainWindow::tr("%1 and %2 more: %3")
                   .arg(QStringList(of.mid(0, kNamed)).join(", "),
                        QString::number(of.size() - kNamed), text);
  }
  return lines;
}

WindowOptions safeOptions(WindowOptions options)
{
  options.quadBuffer = false;
  options.settings = WindowSettings::kNone;
  options.devices = {};
  options.drawThumbnailsAfter = -1;
  return options;
}
// The names of panels that share a place are whole, as what is left of a cut one tells nobody which
// panel it is; where there is no room for all, arrows scroll them.
class FittingTabs : public QObject
{
public:
  using QObject::QObject;
  bool eventFilter(QObject*, QEvent* event) override
  {
    if (event->type() == QEvent::ChildPolished)
      if (auto* tabs = qobject_cast<QTabBar*>(static_cast<QChildEvent*>(event)->child()))
      {
        tabs->setElideMode(Qt::ElideNone);
        tabs->setUsesScrollButtons(true);
      }
    return false;
  }
};

// Of a panel that is in front while the keyboard is elsewhere, the key brings it there; else it
// does what the menu's entry does.
class PanelKey : public QObject
{
public:
  PanelKey(QDockWidget& dock, Panel& panel)
    : QObject(&dock)
    , m_dock(dock)
    , m_panel(panel)
  {
    dock.toggleViewAction()->installEventFilter(this);
  }
  bool eventFilter(QObject*, QEvent* event) override
  {
    if (event->type() != QEvent::Shortcut || !isInFront(m_dock) || hasFocus(m_dock))
      return false;
    QWidget* control = m_panel.mainControl();
    if (control)
      control->setFocus(Qt::ShortcutFocusReason);
    return control != nullptr;
  }

  // Not hidden, nor behind another one in the same place.
  static bool isInFront(const QDockWidget& dock)
  {
    return !dock.isHidden() && !dock.visibleRegion().isEmpty();
  }
  static bool hasFocus(const QDockWidget& dock)
  {
    const QWidget* focus = dock.window()->focusWidget();
    return focus && dock.isAncestorOf(focus);
  }

private:
  QDockWidget& m_dock;
  Panel& m_panel;
};

// Restarts a timer whenever the size of what it watches is another.
class SizeWatch : public QObject
{
public:
  SizeWatch(QWidget& watched, QTimer& timer)
    : QObject(&watched)
    , m_timer(&timer)
  {
    watched.installEventFilter(this);
  }
  bool eventFilter(QObject*, QEvent* event) override
  {
    if (event->type() == QEvent::Resize && m_timer)
      m_timer->start();
    return false;
  }

private:
  QPointer<QTimer> m_timer; // its window's, which may end before
};

// As QMessageBox::about, in rich text.
void showAbout(QWidget& window)
{
  constexpr int kIcon = 64; // pixels
  QMessageBox box(QMessageBox::NoIcon, MainWindow::tr("About Petrous"), aboutText(),
                  QMessageBox::Ok, &window);
  box.setTextFormat(Qt::RichText);
  box.setIconPixmap(window.windowIcon().pixmap(kIcon));
  box.exec();
}

} // namespace

MainWindow::MainWindow(library::Library library, const WindowOptions& wanted)
  : m_options(wanted.isSafe ? safeOptions(wanted) : wanted)
  , m_model(std::move(library))
  , m_settings(std::make_unique<WindowSettings>(m_options.settings))
  , m_bar(new DrillBar)
  , m_deviceBar(new DeviceToolBar)
  , m_view(new ThreeDView)
  , m_slices(new SliceColumn(m_model))
  , m_area(new ViewArea(*m_view, *m_slices))
  , m_start(new StartPage(m_model))
  , m_pages(new QStackedWidget)
  , m_unsavedBanner(new Banner("unsavedBanner", Banner::Kind::Warning))
  , m_loadingBanner(new Banner("loadingBanner", Banner::Kind::Notice))
  , m_faultBanner(new Banner("faultBanner", Banner::Kind::Warning))
  , m_notesBanner(new Banner("notesBanner", Banner::Kind::Notice))
  , m_damageBanner(new Banner("damageBanner", Banner::Kind::Warning))
  , m_recordingBanner(new Banner("recordingBanner", Banner::Kind::Warning))
  , m_removedBanner(new Banner("removedBanner", Banner::Kind::Notice))
  , m_mrBanner(new Banner("mrBanner", Banner::Kind::Notice))
  , m_sideBanner(new Banner("sideBanner", Banner::Kind::Notice))
  , m_place(new ProbeLabel(m_model))
  , m_sum(new QLabel)
  , m_touch(new QLabel)
  , m_recording(new QLabel)
  , m_actions(new WindowActions(*this, *m_bar, *m_deviceBar, m_options.quadBuffer))
  , m_stamps(new CaseStamps(m_model, *m_view, *m_slices, *m_sideBanner, *m_actions->sides, this))
  , m_saver(new CaseSaver(m_model))
  , m_jobs(new CaseJobs(*this))
  , m_keeper(new CaseDocumentController(m_model, *m_saver, *this, *m_unsavedBanner,
                                        *m_loadingBanner, *m_damageBanner, *m_removedBanner))
  , m_watcher(new DeviceWatcher(m_options.devices, m_options.lookForDevicesEvery, this))
  , m_devices(new ActiveDeviceController(*m_watcher, *m_deviceBar, *m_settings, this))
  , m_drill(new DrillController(m_model, *m_view, *m_bar, *m_devices, this))
  , m_picture(new PictureController(m_model, *m_view, *m_actions, *m_settings, *this,
                                    m_options.quadBuffer))
  , m_branches(new BranchController(m_model, *m_actions->approaches, *this))
  , m_strokes(new StrokeThumbnails(m_model, m_options.drawThumbnailsAfter, this))
  , m_comparison(new ComparisonController(m_model, *m_view, *m_slices, *this))
  , m_registration(new RegistrationController(m_model, *m_slices, *this))
  , m_segment(new SegmentController(m_model, *m_slices, *this))
  , m_measure(new MeasureController(m_model, *m_slices, *m_view, *this))
  , m_clipping(new ClippingController(m_model, *m_slices, *m_view, *m_actions, *this))
  , m_sliceControl(new SliceController(m_model, *m_view, *m_slices, *m_settings, *this))
  , m_library(new LibraryController(m_model, *m_keeper, *this, m_options.drawThumbnailsAfter))
  , m_exchange(new ExchangeController(m_model, *m_keeper, *m_library->menu(), *this))
  , m_attachments(new AttachmentsController(m_model, *m_view, *this))
  , m_viewState(new ViewStateController(m_model, *m_view, *m_slices, *m_picture, *m_registration,
                                        *m_bar, *this))
  , m_share(new ShareController(m_model, *m_keeper, *m_exchange, *m_view, *this))
  , m_video(new VideoController(m_model, *m_view, *m_attachments, *this))
  , m_replay(new ReplayController(m_model, *m_view, *m_actions->playRecording, *this))
{
  applyTheme(*qApp, m_settings->theme());
  addPanels();
  m_thickness = new ThicknessController(m_model, *m_view, *findChild<StructuresPanel*>(),
                                        *m_actions->boneThickness);
  if (const auto thrust = m_settings->thrust())
    m_bar->setThrust(*thrust);
  if (const auto burr = m_settings->burr())
    m_bar->setBurr(*burr);
  m_picture->flush = [this] { return flush(); };
  m_comparison->keys = {m_actions->undo, m_actions->redo,
                        findChild<QDockWidget*>("approachDock")->toggleViewAction()};
  m_comparison->keys += m_actions->approaches->actions();
  m_branches->settle = [this] { return m_drill->releaseTool(); };
  m_viewState->handpiece = [this] { return m_drill->handpiece(); };
  m_viewState->showHandpiece = [this](const auto& hand) { m_drill->setHandpiece(hand); };
  m_viewState->instrument = [this] { return m_drill->caseInstrument(); };
  m_viewState->showInstrument = [this](const auto& kept) { m_drill->setCaseInstrument(kept); };
  m_share->releaseTool = [this] { m_drill->releaseTool(); };
  m_share->collectView = [this] { m_viewState->collect(); };
  m_video->goToState = [this](const std::string& branch, std::size_t stroke)
  { m_branches->goToState(branch, stroke); };
  m_keeper->setParent(this);
  m_saver->setParent(this);
  m_saver->aboutToSave = [this] { m_viewState->collect(); };
  setAcceptDrops(true);
  resizeOnScreen(*this, {1440, 900});
  layOut();
  connectModel();
  connectActions();
  connectViews();
  connectSegment();
  connectMeasure();
  connectThumbnails();
  connectJobs();
  guardBoxes();
  m_saveLater.setSingleShot(true);
  m_saveLater.setInterval(std::max(m_options.saveAfter, 0));
  connect(&m_saveLater, &QTimer::timeout, this, &MainWindow::saveLater);
  stateChanged();
}

MainWindow::~MainWindow()
{
  m_model.events = {};
  m_drill->releaseTool(); // before the devices that control it
  delete m_comparison;    // ends its threads
  delete m_registration;  // likewise
  delete m_segment;       // likewise
  delete m_measure;       // likewise
  delete m_clipping;      // filters the view's events
  delete m_video;         // likewise
  delete m_replay;        // likewise
  delete m_drill;
  delete m_devices;
  for (const auto& [entry, panel] : m_panels)
    delete panel;   // one may query the model when hidden
  delete m_strokes; // its thread must not outlive the model
  delete m_watcher; // stops a server
  delete m_stamps;  // looks at the model when a slice is resized
  delete m_viewState;
  delete m_attachments; // its thread must not outlive the model
  delete m_picture;     // the surgeon's window follows the view
  delete m_keeper;      // its threads must not outlive the model
  delete m_saver;
}

void MainWindow::layOut()
{
  connect(m_keeper, &CaseDocumentController::working, m_start,
          [this](const QString& title)
          { m_start->setBusy(title.isEmpty() ? title : title + QString::fromUtf8("…")); });
  connect(m_start, &StartPage::sampleAsked, m_keeper, &CaseDocumentController::makeSample);
  connect(m_start, &StartPage::openFolderAsked, m_keeper, &CaseDocumentController::openFolder);
  connect(m_start, &StartPage::openCaseAsked, this, &MainWindow::showLibrary);
  connect(m_start, &StartPage::restoreAsked, m_keeper,
          qOverload<>(&CaseDocumentController::restore));
  connect(m_start, &StartPage::caseAsked, m_keeper,
          [this](const QString& name) { m_keeper->openCase(bytes(name)); });

  m_pages->addWidget(m_start);
  m_pages->addWidget(m_area);
  m_notesBanner->addButton("dismissNotes", tr("Close"), [this] { showNotes({}); });
  m_mrBanner->addButton("registerMr", tr("Registration (F5)"),
                        [this]
                        {
                          m_mrBanner->hide();
                          m_registration->preferUnregistered();
                          raisePanel("registrationDock");
                        });
  m_mrBanner->addButton("dismissMr", tr("Close"), [this] { m_mrBanner->hide(); });
  m_faultBanner->addButton("dismissFault", tr("Close"), [this] { m_faultBanner->hide(); });
  m_recordingBanner->addButton("dismissRecording", tr("Close"),
                               [this] { m_recordingBanner->hide(); });
  auto* leaving = new Banner("leaveBanner", Banner::Kind::Notice, this);
  leaving->addButton("stayInCase", tr("Keep the case open"), [this] { m_jobs->stay(); });
  connect(m_jobs, &CaseJobs::waits, leaving,
          [leaving](const QStringList& jobs, const QString& what)
          {
            leaving->setText(tr("%1 as soon as this is done: %2").arg(what, jobs.join(", ")));
            leaving->setVisible(!jobs.isEmpty());
          });
  auto* whole = new QWidget;
  auto* banners = new BannerStack(*whole);
  for (Banner* banner : {m_damageBanner, m_faultBanner, m_unsavedBanner, leaving, m_recordingBanner,
                         m_loadingBanner, m_removedBanner, m_mrBanner, m_sideBanner, m_notesBanner})
  {
    banners->add(banner);
    connect(banner, &Banner::dismissed, m_area, &ViewArea::focusView); // else in some panel
  }
  connect(m_view, &ThreeDView::toolModeSet, banners,
          [this, banners]
          { banners->setHeld(m_view->tool().GetDrillMode() || m_view->tool().GetProbeMode()); });
  connect(banners, &BannerStack::covers, m_area, &ViewArea::setCovered);
  auto* stack = new QVBoxLayout(whole);
  stack->setContentsMargins(0, 0, 0, 0);
  stack->setSpacing(0);
  stack->addWidget(banners->room());
  stack->addWidget(m_pages, 1);
  setCentralWidget(whole);

  m_actions->addSliceMenu(m_sliceControl->menu());
  m_actions->addSavedViews(m_viewState->savedMenu());
  menuBar()->insertMenu(menuBar()->actions().last(), m_registration->menu());
  menuBar()->insertMenu(menuBar()->actions().last(), m_segment->menu());
  menuBar()->insertMenu(menuBar()->actions().last(), m_measure->menu());
  menuBar()->insertMenu(menuBar()->actions().last(), m_video->menu());
  menuBar()->insertMenu(menuBar()->actions().last(), m_library->menu());
  m_library->panel()->addToMore({m_actions->restore,
                                 m_library->menu()->findChild<QAction*>("receiveCase"),
                                 m_library->menu()->findChild<QAction*>("verifyLibrary")});

  m_sum->setObjectName("dim");
  m_sum->setToolTip(tr("What was drilled so far"));
  m_sum->setContentsMargins(8, 0, 8, 0);
  m_touch->setObjectName("touchFault");
  m_touch->setToolTip(tr("Why the tool gives no force, or less than it would"));
  m_touch->setContentsMargins(8, 0, 8, 0);
  m_recording->setObjectName("recording");
  m_recording->setContentsMargins(8, 0, 8, 0);
  m_recording->hide();
  statusBar()->addPermanentWidget(m_recording);
  statusBar()->addPermanentWidget(m_touch);
  statusBar()->addPermanentWidget(m_picture->speed());
  statusBar()->addPermanentWidget(m_place);
  statusBar()->addPermanentWidget(m_sum);
  // m_touch stays: why there is no force.
  new MessageRoom(*statusBar(), {m_picture->speed(), m_place, m_sum, m_recording});
}

// Keys belong to the picture unless a number is being typed, and the wheel changes no value that
// was not clicked.
void MainWindow::guardBoxes()
{
  // Of its actions a tool bar makes buttons that Tab passes over.
  for (auto* bar : findChildren<QToolBar*>())
    for (QAction* action : bar->actions())
      if (auto* button = qobject_cast<QToolButton*>(bar->widgetForAction(action)))
        button->setFocusPolicy(Qt::TabFocus);
  for (auto* dock : findChildren<QDockWidget*>()) // those of the slices are turned by the wheel
    for (auto* slider : dock->findChildren<QSlider*>())
    {
      slider->setFocusPolicy(Qt::StrongFocus);
      slider->installEventFilter(this);
    }
  for (auto* box : findChildren<QAbstractSpinBox*>())
  {
    connect(box->findChild<QLineEdit*>(), &QLineEdit::returnPressed, m_area, &ViewArea::focusView);
    box->setKeyboardTracking(false); // no values from partial input, so that Escape can drop it
    box->setFocusPolicy(Qt::StrongFocus);
    box->installEventFilter(this);
  }
  for (auto* box : findChildren<QComboBox*>())
  {
    // Who steps through the choices by keys is not done with the first one.
    connect(box, qOverload<int>(&QComboBox::activated), m_area,
            [this, box]
            {
              if (!box->property(kSteps).toBool())
                m_area->focusView();
            });
    box->setFocusPolicy(Qt::StrongFocus);
    box->installEventFilter(this);
  }
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event)
{
  auto* widget = static_cast<QWidget*>(watched);
  if (event->type() == QEvent::ShortcutOverride) // a number is entered or dropped first
    switch (static_cast<QKeyEvent*>(event)->key())
    {
    case Qt::Key_Escape:
    case Qt::Key_Return:
    case Qt::Key_Enter:
      event->accept();
      return true;
    default:
      break;
    }
  if (qobject_cast<QComboBox*>(widget) &&
      (event->type() == QEvent::KeyPress || event->type() == QEvent::MouseButtonPress))
    widget->setProperty(kSteps, event->type() == QEvent::KeyPress &&
                                    isStep(*static_cast<QKeyEvent*>(event)));
  if (event->type() == QEvent::Wheel && !widget->hasFocus())
  {
    event->ignore(); // a panel may scroll
    return true;
  }
  if (event->type() != QEvent::KeyPress || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape)
    return QMainWindow::eventFilter(watched, event);
  // What was typed is dropped.
  if (auto* number = qobject_cast<QDoubleSpinBox*>(widget))
    number->setValue(number->value());
  else if (auto* whole = qobject_cast<QSpinBox*>(widget))
    whole->setValue(whole->value());
  m_area->focusView();
  return true;
}

void MainWindow::addPanels()
{
  installEventFilter(new FittingTabs(this));
  m_keepLater.setSingleShot(true);
  m_keepLater.setInterval(kKeepAfter);
  connect(&m_keepLater, &QTimer::timeout, this, &MainWindow::keepPanels);
  const PanelContext context{m_model,        *m_picture, *m_registration, *m_segment,  *m_library,
                             *m_attachments, *m_measure, *m_sliceControl, *m_branches, *m_strokes,
                             *m_share,       *m_video,   *m_replay};
  std::map<Qt::DockWidgetArea, QDockWidget*> tabs;
  for (const PanelEntry& entry : panelEntries())
  {
    Panel* panel = entry.make(context);
    QDockWidget* dock = addDock(entry, panel);
    m_panels.emplace_back(entry, panel);
    if (!entry.tabbed)
      continue;
    if (QDockWidget* before = std::exchange(tabs[entry.area], dock))
      tabifyDockWidget(before, dock);
  }
  connect(findChild<QDockWidget*>("registrationDock"), &QDockWidget::visibilityChanged, m_mrBanner,
          [this](bool shown)
          {
            if (shown) // it says so itself
              m_mrBanner->hide();
          });
}

QDockWidget* MainWindow::addDock(const PanelEntry& entry, Panel* panel)
{
  auto* dock = new QDockWidget(entry.title, this);
  dock->setObjectName(entry.name);
  dock->setFeatures(QDockWidget::DockWidgetClosable | QDockWidget::DockWidgetMovable);
  dock->setWidget(scrolledPanel(panel));
  addDockWidget(entry.area, dock);
  dock->toggleViewAction()->setShortcut(entry.key);
  m_actions->addPanelToggle(dock->toggleViewAction(), entry.needsCase);
  // Unlike Qt's default, a dock hidden behind others in the same tab group is raised.
  QAction* toggle = dock->toggleViewAction();
  disconnect(toggle, SIGNAL(triggered(bool)), dock, nullptr);
  connect(toggle, &QAction::triggered, dock,
          [this, dock, panel, toggle](bool on)
          {
            const bool show = on || !PanelKey::isInFront(*dock);
            const bool hadFocus = PanelKey::hasFocus(*dock);
            dock->setVisible(show);
            toggle->setChecked(show);
            if (show)
            {
              dock->raise();
              if (QWidget* control = panel->mainControl())
                control->setFocus(Qt::ShortcutFocusReason);
            }
            else if (hadFocus && m_model.hasCase())
              m_area->focusView();
          });
  new PanelKey(*dock, *panel);
  new SizeWatch(*dock, m_keepLater);
  connect(dock, &QDockWidget::visibilityChanged, &m_keepLater, qOverload<>(&QTimer::start));
  dock->hide();
  return dock;
}

// As the user left them; at first the first one in front.
void MainWindow::showPanels()
{
  QDockWidget* front = nullptr;
  for (const auto& [entry, panel] : m_panels)
  {
    auto* dock = findChild<QDockWidget*>(entry.name);
    const bool shown = m_settings->panelShown(entry.name, entry.atFirst) ||
                       (!entry.needsCase && !dock->isHidden()); // shown before there was a case
    dock->setVisible(shown);
    if (shown && !front)
      front = dock;
  }
  if (!front)
    return;
  front->raise();
  QList<QDockWidget*> docks;
  QList<int> widths, heights;
  for (const auto& [name, size] : m_settings->panelsInFront())
    if (auto* dock = findChild<QDockWidget*>(name); dock && !dock->isHidden() && !size.isEmpty())
    {
      dock->raise();
      docks << dock;
      widths << std::min(size.width(), width() / 2);
      heights << size.height();
    }
  if (docks.isEmpty())
    return resizeDocks({front}, {std::min(kPanelWidth, 5 * width() / 12)}, Qt::Horizontal);
  resizeDocks(docks, widths, Qt::Horizontal);
  resizeDocks(docks, heights, Qt::Vertical);
}

// Without a case most of them cannot be chosen.
void MainWindow::keepPanels()
{
  if (!m_model.hasCase() || !m_hasShownPanels)
    return;
  std::vector<std::pair<QString, QSize>> front;
  for (const auto& [entry, panel] : m_panels)
  {
    const auto* dock = findChild<QDockWidget*>(entry.name);
    m_settings->keepPanelShown(entry.name, !dock->isHidden());
    if (PanelKey::isInFront(*dock))
      front.emplace_back(entry.name, dock->size());
  }
  if (isVisible() && !isMinimized()) // else none is in front
    m_settings->keepPanelsInFront(front);
}

// Another case is open, or none is any more.
void MainWindow::tellPanels()
{
  m_registration->caseChanged();
  m_thickness->caseChanged();
  m_comparison->caseChanged();
  for (const auto& [entry, panel] : m_panels)
    panel->caseChanged();
}

void MainWindow::connectModel()
{
  m_model.events.caseChanged = [this] { caseChanged(); };
  m_model.events.caseClosed = [this] { caseClosed(); };
  m_model.events.preparationWanted = [this] { m_keeper->prepare(); };
  m_model.events.partsChanged = [this] { partsChanged(); };
  m_model.events.partRenamed = [this](const std::string& from, const std::string& to)
  {
    m_thickness->partRenamed(from, to);
    for (const auto& [entry, panel] : m_panels)
      panel->partRenamed(from, to);
  };
  m_model.events.appearanceChanged = [this]
  {
    m_picture->appearanceChanged();
    m_slices->appearanceChanged();
    m_clipping->refresh();
    for (const auto& [entry, panel] : m_panels)
      panel->appearanceChanged();
  };
  if (auto* application = qobject_cast<Application*>(QCoreApplication::instance()))
    connect(application, &Application::faulted, this, &MainWindow::showFault);
  m_model.events.maskChanged = [this](const core::IndexBox& box) { maskChanged(box); };
  m_model.events.crosshairMoved = [this] { m_slices->crosshairMoved(); };
  m_model.events.attachmentsChanged = [this]
  {
    for (const auto& [entry, panel] : m_panels)
      panel->attachmentsChanged();
  };
  m_model.events.mrMoved = [this]
  {
    showUnregistered(false);
    m_registration->mrMoved();
    m_segment->mrMoved();
    m_measure->partsChanged();
    for (const auto& [entry, panel] : m_panels) // of what was made from it the error is not known
      panel->appearanceChanged();
  };
  m_model.events.savedViewsChanged = [this] { m_viewState->savedViewsChanged(); };
  m_model.events.viewWanted = [this] { m_viewState->collectPlace(); };
  m_model.events.viewChanged = [this] { m_viewState->showPlace(); };
  m_model.events.measurementsChanged = [this] { m_measure->measurementsChanged(); };
  m_model.events.toolPutAway = [this]
  { statusBar()->showMessage(tr("Tool put away: what was drawn on the MR moved"), kMessage); };
  m_model.events.stateChanged = [this] { stateChanged(); };
  m_model.events.stepped = [this](bool back)
  {
    showUndo();
    stepped(back);
  };
  m_model.events.recordingChanged = [this](const std::string& fault)
  { showRecording(phrase(fault)); };
  m_model.events.noticed = [this](const std::string& text)
  { notice(capitalized(sentence(phrase(text)))); };
  connect(m_registration, &RegistrationController::sceneStale, this,
          [this] { m_model.events.appearanceChanged(); });
  connect(m_slices, &SliceColumn::pointed, m_place,
          [this](const Eigen::Vector3d& patient)
          { m_place->showValues(patient, m_slices->valuesAt(patient)); });
  connect(m_drill, &DrillController::pointed, m_place, &ProbeLabel::showPlace);
  connect(m_drill, &DrillController::pointedNowhere, m_place, &QLabel::clear);
  auto* distances = new ToolDistances(m_model, this);
  distances->isWideWanted = [this]
  {
    return std::any_of(m_panels.begin(), m_panels.end(),
                       [](const auto& one) { return one.second->showsNear(); });
  };
  for (const auto& [entry, panel] : m_panels)
  {
    connect(m_drill, &DrillController::toolMoved, panel, &Panel::toolMoved);
    connect(m_drill, &DrillController::toolGone, panel, &Panel::toolGone);
    connect(distances, &ToolDistances::measured, panel, &Panel::toolMeasured);
  }
  connect(m_drill, &DrillController::toolMoved, distances, &ToolDistances::toolMoved);
  connect(m_drill, &DrillController::toolGone, distances, &ToolDistances::toolGone);
  connect(m_drill, &DrillController::toolMoved, m_sliceControl, &SliceController::toolMoved);
  auto* warnings = new ToolWarnings(this);
  connect(distances, &ToolDistances::measured, warnings, &ToolWarnings::show);
  connect(m_drill, &DrillController::toolGone, warnings, &ToolWarnings::toolGone);
  connect(warnings, &ToolWarnings::warned, &m_view->display(), &SceneDisplay::setWarning);
  connect(warnings, &ToolWarnings::alarmed, &m_drill->sound(), &DrillSound::setWarning);
  connect(m_drill, &DrillController::strokeEnded, this, &MainWindow::strokeEnded);
  connect(m_drill, &DrillController::faulted, m_touch, &QLabel::setText);
  const auto say = [this](const QString& line)
  {
    statusBar()->showMessage(line);
    statusBar()->repaint(); // shown before a slow operation begins
  };
  connect(m_drill, &DrillController::statusMessage, this, say);
  connect(m_devices, &ActiveDeviceController::statusMessage, this, say);
  connect(m_devices, &ActiveDeviceController::lost, this, [this] { m_model.record({}); });
  connect(m_devices, &ActiveDeviceController::came, m_area, &ViewArea::focusView);
  connect(m_deviceBar->hereAction(), &QAction::triggered, m_drill, &DrillController::bringHere);
  connect(m_bar, &DrillBar::pressChanged, this,
          [this]
          {
            if (!m_viewState->isShowing()) // a case's is not the user's own
              m_settings->keepThrust(m_bar->thrust());
          });
  connect(m_bar, &DrillBar::burrChosen, this, [this] { m_settings->keepBurr(m_bar->wanted()); });
  const auto showMessage = [this](const QString& line)
  { statusBar()->showMessage(line, kMessage); };
  connect(m_keeper, &CaseDocumentController::statusMessage, this, showMessage);
  connect(m_thickness, &ThicknessController::statusMessage, this, showMessage);
  connect(m_registration, &RegistrationController::statusMessage, this, showMessage);
  connect(m_registration, &RegistrationController::runningChanged, this, &MainWindow::showUndo);
  connect(m_registration, &RegistrationController::panelWanted, this,
          [this] { raisePanel("registrationDock"); });
  connect(m_keeper, &CaseDocumentController::ready, m_drill, &DrillController::tissueCame);
  connect(m_keeper, &CaseDocumentController::ready, m_replay, &ReplayController::caseReady);
  connect(m_drill, &DrillController::tissueWanted, m_keeper,
          &CaseDocumentController::prepareUnlessUnderWay);
  connect(m_viewState, &ViewStateController::statusMessage, this, showMessage);
  connect(m_stamps, &CaseStamps::answered, this, &MainWindow::sideAnswered);
  connect(m_stamps, &CaseStamps::answered, m_saver, &CaseSaver::save);
  connect(m_branches, &BranchController::changed, m_saver, &CaseSaver::save);
  connect(m_branches, &BranchController::comparisonAsked, m_comparison,
          &ComparisonController::compare);
  connect(m_branches, &BranchController::statusMessage, this, showMessage);
  connect(m_library, &LibraryController::statusMessage, this, showMessage);
  connect(m_exchange, &ExchangeController::statusMessage, this, showMessage);
  connect(m_share, &ShareController::statusMessage, this, showMessage);
  connect(m_library->panel(), &LibraryPanel::sendAsked, m_exchange,
          [this](const QString& name) {
            guarded([&] { m_exchange->send(bytes(name)); },
                    [this](const QString& why) { notice(why); });
          });
  connect(m_saver, &CaseSaver::saved, m_library, &LibraryController::refresh);
  connect(m_attachments, &AttachmentsController::statusMessage, this, showMessage);
  connect(m_attachments, &AttachmentsController::changed, m_saver, &CaseSaver::save);
  connect(m_video, &VideoController::statusMessage, this, showMessage);
  connect(m_replay, &ReplayController::statusMessage, this, showMessage);
  connect(m_replay, &ReplayController::panelWanted, this, [this] { raisePanel("replayDock"); });
  connect(m_video, &VideoController::changed, m_saver, &CaseSaver::save);
  connect(m_video, &VideoController::panelWanted, this, [this] { raisePanel("videoDock"); });
  connect(m_attachments, &AttachmentsController::panelWanted, this,
          [this] { raisePanel("attachmentsDock"); });
  connect(m_picture, &PictureController::statusMessage, this,
          [this](const QString& line) { statusBar()->showMessage(line); });
}

void MainWindow::connectActions()
{
  const auto on = [this](QAction* action, auto what)
  { connect(action, &QAction::triggered, this, what); };
  on(m_actions->openDicom, [this] { m_keeper->openFolder(); });
  on(m_actions->openRegion, [this] { m_keeper->openRegion(); });
  on(m_actions->openFileRegion, [this] { m_keeper->openFileRegion(); });
  using presenters::Content;
  on(m_actions->addMrFolder, [this] { m_keeper->add(Content::Mr, true); });
  on(m_actions->addMrFile, [this] { m_keeper->add(Content::Mr); });
  on(m_actions->addLabels, [this] { m_keeper->add(Content::Labels); });
  on(m_actions->addMasks, [this] { m_keeper->add(Content::Labels, true); });
  on(m_actions->addMesh, [this] { m_keeper->add(Content::Mesh); });
  on(m_actions->restorePart, [this] { m_keeper->restorePart(); });
  connect(m_actions->casePart, &QMenu::aboutToShow, this, &MainWindow::fillCaseMenu);
  auto* structures = findChild<StructuresPanel*>();
  connect(structures, &StructuresPanel::selected, this,
          [structures, appearance = findChild<AppearancePanel*>()]
          { appearance->follow(structures->selectedParts()); });
  connect(structures, &StructuresPanel::removalAsked, this,
          [this](const QString& name) { m_keeper->removePart(bytes(name)); });
  connect(structures, &StructuresPanel::renamingAsked, this,
          [this](const QString& name) { m_keeper->renamePart(bytes(name)); });
  connect(structures, &StructuresPanel::axesAsked, this,
          [this](const QString& name) { correctAxes(bytes(name)); });
  connect(m_keeper, &CaseDocumentController::added, this,
          [this](bool onlyImages)
          {
            if (onlyImages)
              m_registration->preferUnregistered();
            raisePanel(onlyImages ? "registrationDock" : "structuresDock");
          });
  on(m_actions->openImage, [this] { m_keeper->openFiles(); });
  on(m_actions->openCase, [this] { showLibrary(); });
  connect(m_library, &LibraryController::panelWanted, this, &MainWindow::showLibrary);
  on(m_actions->closeCase, [this] { m_keeper->closeCase(); });
  on(m_actions->sample, [this] { m_keeper->makeSample(); });
  on(m_actions->save, [this] { m_keeper->save(); });
  on(m_actions->saveAs, [this] { m_keeper->saveAs(); });
  on(m_actions->exportPart,
     [this]
     {
       m_drill->releaseTool(); // ends an open stroke
       m_keeper->exportPart();
     });
  on(m_actions->archive,
     [this]
     {
       m_drill->releaseTool(); // ends an open stroke
       m_keeper->archive();
     });
  on(m_actions->correctAxes,
     [this]
     {
       m_drill->releaseTool(); // ends an open stroke
       m_keeper->correctAxes();
     });
  on(m_actions->restore, [this] { m_keeper->restore(); });
  on(m_actions->catalogues, [this] { editCatalogues(); });
  on(m_actions->openRecording, [this] { m_replay->openFile(); });
  on(m_actions->report, [this] { m_share->report(); });
  on(m_actions->printPicture, [this] { m_share->printPicture(); });
  on(m_actions->film, [this] { m_share->film(); });
  on(m_actions->quit, [this] { close(); });
  on(m_actions->undo,
     [this] {
       undoesMeasure() ? m_measure->undo() : undoesSegment() ? m_segment->undo() : step(true);
     });
  on(m_actions->redo,
     [this] {
       undoesMeasure() ? m_measure->redo() : redoesSegment() ? m_segment->redo() : step(false);
     });
  on(m_actions->centerView,
     [this]
     {
       core::CameraPose camera = m_view->picture().camera();
       camera.position += m_model.crosshair() - camera.focalPoint;
       camera.focalPoint = m_model.crosshair();
       m_view->setCamera(camera);
     });
  const auto roll = [this](double degrees)
  { m_view->setCamera(interaction::rolled(m_view->picture().camera(), degrees)); };
  on(m_actions->rollLeft, [roll] { roll(-kRoll); });
  on(m_actions->rollRight, [roll] { roll(kRoll); });
  on(m_actions->attach, [this] { m_attachments->attach(); });
  on(m_actions->boneWindow, [this] { m_slices->boneWindow(); });
  on(m_actions->softWindow, [this] { m_slices->softWindow(); });
  on(m_actions->temporalWindow, [this] { m_slices->temporalWindow(); });
  on(m_actions->fitSlices, [this] { m_slices->fit(); });
  on(m_actions->otherKind, [this] { m_bar->nextBurr(); });
  constexpr double kTurn = 5.0; // degrees
  on(m_actions->turnLeft, [this] { m_drill->turnHandpiece(kTurn, 0.0); });
  on(m_actions->turnRight, [this] { m_drill->turnHandpiece(-kTurn, 0.0); });
  on(m_actions->tiltMore, [this] { m_drill->turnHandpiece(0.0, kTurn); });
  on(m_actions->tiltLess, [this] { m_drill->turnHandpiece(0.0, -kTurn); });
  on(m_actions->holdAsAtFirst, [this] { m_drill->holdAsAtFirst(); });
  connect(m_actions, &WindowActions::handpieceChosen, m_drill, &DrillController::holdFor);
  connect(m_actions->leftHand, &QAction::toggled, this,
          [this](bool isLeft)
          {
            m_drill->setLeftHand(isLeft);
            m_settings->keepLeftHand(isLeft);
          });
  connect(m_actions->burrAlone, &QAction::toggled, this,
          [this](bool alone)
          {
            m_drill->setBurrAlone(alone);
            m_settings->keepBurrAlone(alone);
          });
  on(m_actions->instrumentFile, [this] { m_drill->chooseInstrument(); });
  on(m_actions->instrumentOut, [this] { m_drill->takeOutInstrument(); });
  connect(m_drill, &DrillController::caseInstrumentChanged, this, &MainWindow::showInstrumentOut);
  connect(m_drill, &DrillController::instrumentRead, this,
          [this](const QString& file, const QString& axis)
          { m_settings->keepInstrument(file, axis); });
  connect(m_drill, &DrillController::instrumentRefused, this,
          [this](const QString& why)
          {
            QMessageBox box(QMessageBox::Warning, tr("Instrument from a file"), why,
                            QMessageBox::Close, this);
            const auto* choose = box.addButton(tr("Choose a &file…"), QMessageBox::AcceptRole);
            box.exec();
            if (box.clickedButton() == choose)
              m_drill->chooseInstrument();
          });
  connect(
      m_drill, &DrillController::toolChanged, this,
      [this](const QString& instrument)
      {
        for (QAction* burr : {m_actions->smallerBurr, m_actions->largerBurr, m_actions->otherKind})
          enable(*burr, instrument.isEmpty(), tr("An instrument is in the hand, not the burr"));
      });
  const auto [instrument, axis] = m_settings->instrument();
  m_drill->setInstrument(instrument, axis);
  m_actions->leftHand->setChecked(m_settings->leftHand());
  m_actions->burrAlone->setChecked(m_settings->burrAlone());
  on(m_actions->smallerBurr,
     [this] { m_segment->hasBrush() ? m_segment->stepBrush(-1) : m_bar->stepDiameter(-1); });
  on(m_actions->largerBurr,
     [this] { m_segment->hasBrush() ? m_segment->stepBrush(1) : m_bar->stepDiameter(1); });
  on(m_actions->settings, [this] { showSettings(); });
  on(m_actions->keyList, [this] { showKeys(); });
  on(m_actions->manual,
     [this]
     {
       const QString why = openManual(QCoreApplication::applicationDirPath());
       statusBar()->showMessage(why.isEmpty() ? tr("The manual is in the browser") : why, kMessage);
     });
  on(m_actions->findCommand, [this] { findCommand(); });
  on(m_actions->about, [this] { showAbout(*this); });
  m_bound.add(
      m_actions->record, [this] { return !m_model.recording().empty(); },
      [this](bool chosen) { record(chosen); });
  connect(m_actions->slicesFollow, &QAction::toggled, m_drill, &DrillController::setSlicesFollow);
  connectSound();
  connect(m_actions, &WindowActions::viewChosen, this, &MainWindow::showView);
}

void MainWindow::connectSound()
{
  QAction* action = m_actions->drillSound;
  connect(action, &QAction::toggled, &m_drill->sound(), &DrillSound::setOn);
  // Not when it fails: the user's wish stays.
  connect(action, &QAction::triggered, this, [this](bool on) { m_settings->keepDrillSound(on); });
  connect(&m_drill->sound(), &DrillSound::failed, this,
          [this, action](const QString& why)
          {
            action->setChecked(false);
            statusBar()->showMessage(why, kMessage);
          });
  action->setChecked(m_settings->drillSound());
}

void MainWindow::connectViews()
{
  const auto showLayout = [this]
  {
    const presenters::ViewArrangement& arrangement = m_area->arrangement();
    for (QAction* action : m_actions->layouts->actions())
      action->setChecked(action->data().toInt() == static_cast<int>(arrangement.layout()));
    m_actions->enlargeView->setChecked(arrangement.enlarged().has_value());
  };
  m_area->setArrangement(m_settings->arrangement());
  showLayout();
  connect(m_area, &ViewArea::arrangementChanged, this,
          [this, showLayout]
          {
            showLayout();
            m_settings->keepArrangement(m_area->arrangement());
          });
  connect(m_actions->layouts, &QActionGroup::triggered, m_area,
          [this](QAction* action)
          { m_area->setLayout(static_cast<presenters::ViewLayout>(action->data().toInt())); });
  m_area->addActions({m_actions->clipDeeper, m_actions->clipLess, m_actions->clipTurnLeft,
                      m_actions->clipTurnRight});
  connect(m_actions->enlargeView, &QAction::triggered, m_area,
          [this] { m_area->toggleEnlarged(m_area->focusedPane()); });
  connect(m_view, &ThreeDView::enlargeAsked, m_area,
          [this] { m_area->toggleEnlarged(presenters::ViewPane::ThreeD); });
  connect(m_slices, &SliceColumn::enlargeAsked, m_area,
          [this](presenters::SliceOrientation slice)
          { m_area->toggleEnlarged(presenters::paneOf(slice)); });
}

// One tool at a time: the drill's or a segment tool.
void MainWindow::connectSegment()
{
  connect(m_segment, &SegmentController::toolTaken, this,
          [this]
          {
            const bool drilled = m_view->tool().GetDrillMode() || m_view->tool().GetProbeMode();
            m_drill->releaseTool();
            if (drilled)
              statusBar()->showMessage(
                  tr("The drill is off while a segment tool is in use; Esc puts that away"),
                  kMessage);
            raisePanel("segmentDock");
          });
  connect(m_view, &ThreeDView::toolModeSet, m_segment,
          [this]
          {
            if (m_segment->active() &&
                (m_view->tool().GetDrillMode() || m_view->tool().GetProbeMode()))
              m_segment->leaveTool();
          });
  // The user segments on what the slices show.
  connect(m_registration, &RegistrationController::shownChanged, this,
          [this] { m_segment->setShown(m_registration->shown()); });
  connect(m_segment, &SegmentController::imageWanted, this,
          [this](const QString& image) { m_registration->show(bytes(image)); });
  connect(m_segment, &SegmentController::stateChanged, this, &MainWindow::showUndo);
  connect(m_segment, &SegmentController::structureCreated, m_saver, &CaseSaver::save);
  connect(m_segment, &SegmentController::structureCreated, this, &MainWindow::showUndo);
  connect(m_segment, &SegmentController::statusMessage, this,
          [this](const QString& line) { statusBar()->showMessage(line, kMessage); });
  connect(m_segment, &SegmentController::viewFocusAsked, m_area, &ViewArea::focusView);
  connect(m_segment, &SegmentController::surfaceChanged, m_picture, &PictureController::setDraft);
  m_keeper->mayDropDraft = [this] { return m_segment->mayLeave(); };
  m_segment->addKeysTo(*m_view);
  m_segment->addKeysTo(*m_slices);
}

// One tool at a time, here too.
void MainWindow::connectMeasure()
{
  connect(m_measure, &MeasureController::toolTaken, this,
          [this]
          {
            m_drill->releaseTool();
            m_segment->leaveTool();
            raisePanel("measureDock");
          });
  connect(m_segment, &SegmentController::toolTaken, m_measure, &MeasureController::leaveTool);
  connect(m_view, &ThreeDView::toolModeSet, m_measure,
          [this]
          {
            if (m_view->tool().GetDrillMode() || m_view->tool().GetProbeMode())
              m_measure->leaveTool();
          });
  m_measure->viewTaken = [this]
  { return m_view->tool().GetDrillMode() || m_view->tool().GetProbeMode(); };
  m_clipping->viewTaken = [this] { return m_measure->active() || m_segment->active(); };
  m_clipping->focusedSlice = [this]() -> std::optional<presenters::SliceOrientation>
  {
    const auto pane = static_cast<int>(m_area->focusedPane());
    return pane > 0 ? std::optional(static_cast<presenters::SliceOrientation>(pane - 1))
                    : std::nullopt;
  };
  connect(m_measure, &MeasureController::stateChanged, m_clipping, &ClippingController::refresh);
  connect(m_segment, &SegmentController::stateChanged, m_clipping, &ClippingController::refresh);
  connect(m_measure, &MeasureController::stateChanged, this, &MainWindow::showUndo);
  connect(m_measure, &MeasureController::changed, m_saver, &CaseSaver::save);
  connect(m_clipping, &ClippingController::statusMessage, this,
          [this](const QString& line) { statusBar()->showMessage(line, kMessage); });
  connect(m_measure, &MeasureController::statusMessage, this,
          [this](const QString& line) { statusBar()->showMessage(line, kMessage); });
}

// All of them: what is not here is dropped without a question when the case is left.
void MainWindow::connectJobs()
{
  m_jobs->add(
      {[this] { return m_registration->runningText(); }, [this] { m_registration->stop(); }});
  m_jobs->add({[this] { return m_keeper->changing(); }, [this] { m_keeper->stopWork(); }});
  m_jobs->add({[this]
               {
                 const QString file = m_attachments->taking();
                 return file.isEmpty() ? file : tr("reading the attachment “%1”").arg(file);
               },
               [this] { m_attachments->stop(); }});
  m_keeper->mayDropJobs = [this](const auto& again, const QString& what)
  { return m_jobs->mayLeave(again, what); };
}

// In the background, while nobody drills or waits for anything.
void MainWindow::connectThumbnails()
{
  ThumbnailDrawer* drawer = m_library->thumbnails();
  drawer->isIdle = [this] { return !busy() && !m_model.touching() && !m_model.unsaved(); };
  m_strokes->isIdle = [this] { return !busy() && !m_model.touching(); };
  m_strokes->camera = [this] { return m_view->picture().camera(); };
  connect(m_saver, &CaseSaver::saved, drawer,
          [drawer](const QString& name) { drawer->caseSaved(bytes(name)); });
  connect(m_library->panel(), &LibraryPanel::refreshed, m_start, &StartPage::refresh);
  m_start->onSeen([drawer](const library::CaseSummary& one) { drawer->caseSeen(one); });
  connect(drawer, &ThumbnailDrawer::drawn, m_start,
          [this](const QString& id) { m_start->pictureDrawn(bytes(id)); });
  m_library->drawThumbnails()->setChecked(m_settings->thumbnails());
  drawer->setEnabled(m_settings->thumbnails());
  connect(m_library->drawThumbnails(), &QAction::toggled, this,
          [this](bool drawn) { m_settings->keepThumbnails(drawn); });
}

void MainWindow::showInstrumentOut()
{
  const bool open = m_model.hasCase();
  enable(*m_actions->instrumentOut,
         open && (m_drill->caseInstrument() || m_model.value().view.instrument),
         open ? tr("The case keeps no instrument") : tr("Open a case first"));
}

void MainWindow::showUndo()
{
  const auto show = [this](QAction& action, const QString& text, bool can, const QString& what)
  {
    enable(action, can,
           !m_model.hasCase()                                 ? tr("Open a case first")
           : disturbsRegistration(&action == m_actions->undo) ? disturbsText()
           : &action == m_actions->undo                       ? tr("Nothing was changed")
                                                              : tr("Nothing was undone"));
    action.setText(what.isEmpty() ? text : text + ' ' + QString(what).replace('&', "&&"));
  };
  const QString undo = tr("&Undo"), redo = tr("&Redo");
  if (undoesMeasure())
    show(*m_actions->undo, undo, m_measure->canUndo(), m_measure->undoText());
  else if (undoesSegment())
    show(*m_actions->undo, undo, m_segment->canUndoStep(), m_segment->undoText());
  else
    show(*m_actions->undo, undo, m_model.canUndo() && !disturbsRegistration(true),
         phrase(m_model.undoText()));
  if (undoesMeasure())
    show(*m_actions->redo, redo, m_measure->canRedo(), m_measure->redoText());
  else if (redoesSegment())
    show(*m_actions->redo, redo, m_segment->canRedoStep(), m_segment->redoText());
  else
    show(*m_actions->redo, redo, m_model.canRedo() && !disturbsRegistration(false),
         phrase(m_model.redoText()));
}

// A run's result holds for the places that the MRs had when it began.
bool MainWindow::disturbsRegistration(bool back) const
{
  return m_registration->running() && (back ? m_model.undoMovesMr() : m_model.redoMovesMr());
}

QString MainWindow::disturbsText() const
{
  return tr("It would move an MR while a registration is under way: wait for that, or cancel it");
}

// A tool's steps first; and no stroke as long as the drill is put away for it.
bool MainWindow::undoesSegment() const
{
  return m_segment->active() && (m_segment->canUndoStep() || m_model.undoesStroke());
}

// Points that are set; what was measured is undone in the order of all changes.
bool MainWindow::undoesMeasure() const
{
  return m_measure->active() && m_measure->hasPoints();
}

bool MainWindow::redoesSegment() const
{
  return m_segment->active() && (m_segment->canRedoStep() || m_model.redoesStroke());
}

void MainWindow::step(bool back)
{
  if (disturbsRegistration(back))
    return statusBar()->showMessage(disturbsText(), kMessage);
  const bool isStroke = back ? m_model.undoesStroke() : m_model.redoesStroke();
  const QString what = phrase(back ? m_model.undoText() : m_model.redoText());
  const auto act = [this, back] { back ? m_model.undo() : m_model.redo(); };
  const auto done = [&]
  {
    if (!isStroke && !what.isEmpty()) // the others are told when they are done
      statusBar()->showMessage(back ? tr("Undone: %1").arg(what) : tr("Done again: %1").arg(what),
                               kMessage);
  };
  if (back ? m_model.undoChangesParts() : m_model.redoChangesParts())
  {
    m_drill->releaseTool();
    if (m_keeper->changeParts(act))
      done();
    return;
  }
  guarded(
      [&]
      {
        if (isStroke) // the drill stays off until button, key or pedal is pressed anew
          m_view->tool().ReleaseDrill();
        act();
        done();
      },
      // A damaged stroke is refused.
      [this](const QString& why) { statusBar()->showMessage(why); });
}

void MainWindow::begin(const QString& what)
{
  if (!what.isEmpty())
    return m_keeper->open({what});
  if (m_options.isSafe)
    return;
  std::optional<std::string> latest;
  guarded([&] { latest = m_model.latestCase(m_settings->lastCase()); },
          [](const QString&) {}); // the first page says why
  if (latest)
    m_keeper->open({words(*latest)});
}

bool MainWindow::busy() const
{
  return m_keeper->busy() || m_saver->busy();
}

void MainWindow::showFault(const QString& why)
{
  m_faultBanner->setText(tr("Something failed: %1 Save the case; if this comes again, start "
                            "Petrous anew.")
                             .arg(sentence(why)));
  m_faultBanner->show();
}

void MainWindow::caseClosed()
{
  m_drill->releaseTool();
  m_view->display().setContents({});
  m_slices->clear();
  m_segment->caseChanged();
  m_measure->caseChanged();
  m_clipping->caseChanged();
  m_branches->caseChanged();
  tellPanels();
  m_removedBanner->hide();
  m_place->clear();
  m_sum->clear();
  m_picture->speed()->clear();
  m_mrBanner->hide();
  m_stamps->caseClosed();
  showNotes({});
  m_pages->setCurrentIndex(0);
  m_start->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);
}

// The camera stays, and the tool is put away.
void MainWindow::partsChanged()
{
  m_drill->releaseTool();
  m_picture->appearanceChanged();
  m_slices->appearanceChanged();
  m_segment->partsChanged();
  m_measure->partsChanged();
  m_registration->partsChanged();
  m_thickness->partsChanged();
  m_comparison->caseChanged();
  for (const auto& [entry, panel] : m_panels)
    panel->partsChanged();
  showUnregistered(false);
  notifyNotes();
}

void MainWindow::caseChanged()
{
  const scene::Case& value = m_model.value();
  const bool first = m_pages->currentIndex() == 0;
  if (first)
  {
    m_start->setBusy(tr("Preparing the picture…"));
    m_start->layout()->activate();
    m_start->repaint(); // it is seen until the picture is drawn, and nothing can be chosen there
    m_picture->announce();
  }
  // The first page asks for no room behind the case: told before it is hidden, or it is not heard.
  m_start->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
  m_pages->setCurrentIndex(1);
  m_start->setBusy({});
  if (!std::exchange(m_hasShownPanels, true)) // later they stay as they are
    showPanels();
  m_drill->releaseTool();
  offerBurrs();
  m_picture->caseChanged();
  m_slices->caseChanged();
  m_segment->caseChanged();
  m_measure->caseChanged();
  m_clipping->caseChanged();
  m_branches->caseChanged();
  tellPanels();
  if (!value.view.tool) // the thrust may be that of the case before
    m_bar->setThrust(m_settings->thrust().value_or(DrillBar::kUsualThrust));
  m_viewState->show();
  m_place->clear(); // of the previous case
  m_area->focusView();
  showNotes({});
  m_notesTold.clear(); // told whenever the case is opened
  if (value.revision > 0)
    warnOfSides(); // of a new one the notes tell it
  notifyNotes();
  showUnregistered(true);
  m_stamps->caseOpened();
  tellOtherBurr();
}

// Without a registration an MR is not seen: that it came along is said until it is registered or
// the user knows.
void MainWindow::showUnregistered(bool opened)
{
  QStringList names;
  for (const scene::ImagePart& mr : m_model.value().mr)
    if (!mr.registered)
      names += tr("“%1”").arg(shownName(mr.name));
  if (names.isEmpty())
    return m_mrBanner->hide();
  m_mrBanner->setText(
      (names.size() == 1
           ? tr("The case has the MR %1, which is not registered with the %2 and not shown yet. "
                "Registration > Register the MR (Ctrl+R) registers it.")
           : tr("The case has the MRs %1, which are not registered with the %2 and not shown yet. "
                "Registration > Register the MR (Ctrl+R) registers them."))
          .arg(names.join(", "), presenters::primaryName(m_model.value())));
  if (opened)
    m_mrBanner->show();
}

// Left and right that were assumed.
void MainWindow::warnOfSides()
{
  QStringList lines;
  for (const std::string& line : presenters::assumedSideTexts(m_model.value()))
    lines += phrase(line);
  if (lines.isEmpty())
    return;
  showNotes(lines);
}

// What was assumed or left out when files were read, until it is acknowledged or its part is taken
// out.
void MainWindow::notifyNotes()
{
  const QStringList notes = notesOf(m_model.value());
  QStringList fresh;
  for (const QString& note : notes)
    if (!m_notesTold.contains(note))
      fresh += note;
  QStringList still;
  for (const QString& note : m_notesShown)
    if (notes.contains(note) || !m_notesTold.contains(note)) // one of another kind stays
      still += note;
  m_notesTold = notes;
  QStringList shown = still + fresh;
  shown.removeDuplicates(); // a side that was assumed may be noted, too
  if (shown != m_notesShown)
    showNotes(shown);
}

void MainWindow::showNotes(const QStringList& notes)
{
  m_notesShown = notes;
  m_notesBanner->setText(notes.join('\n'), joinedNotes(notes).join('\n'));
  m_notesBanner->setVisible(!notes.isEmpty());
}

// The library's burrs.
void MainWindow::offerBurrs()
{
  try
  {
    m_bar->setBurrs(dissection::Catalogues::in(m_model.library().folder()).burrs);
    if (auto* editor = findChild<StructureEditor*>())
      editor->materialsChanged();
  }
  catch (const core::Error& fault)
  {
    statusBar()->showMessage(toString(fault)); // and again, in full, when the burr is taken up
  }
}

void MainWindow::tellOtherBurr()
{
  if (const QString text = m_bar->insteadText(); !text.isEmpty())
    statusBar()->showMessage(text);
}

// A tool in use is taken up again with them.
void MainWindow::editCatalogues()
{
  const auto isUsed = [this](const std::string& material)
  {
    if (!m_model.hasCase())
      return false;
    const scene::Case& value = m_model.value();
    const auto has = [&material](const auto& part) { return part.look.tissue == material; };
    return std::any_of(value.meshes.begin(), value.meshes.end(), has) ||
           std::any_of(value.labels.begin(), value.labels.end(),
                       [&has](const scene::LabelPart& part) {
                         return std::any_of(part.structures.begin(), part.structures.end(), has);
                       });
  };
  const auto edit = [this, isUsed](presenters::CatalogueEditor editor)
  {
    auto* dialog = new CatalogueDialog(std::move(editor), isUsed, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &CatalogueDialog::saved, this,
            [this]
            {
              offerBurrs();
              if (m_model.touching())
                m_drill->renewTool();
              tellOtherBurr();
            });
    dialog->open();
  };
  const auto offerRepair = [this, edit](const QString& why)
  {
    auto* box = new QMessageBox(QMessageBox::Question, tr("Materials and burrs"),
                                capitalized(sentence(why)), QMessageBox::Cancel, this);
    box->setObjectName("catalogueRepair");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setInformativeText(tr("Begin with the built-in tables in place of what cannot be read? "
                               "The file stays as it is until you save, which replaces or removes "
                               "it."));
    box->setDefaultButton(
        box->addButton(tr("Begin with the &built-in tables"), QMessageBox::AcceptRole));
    connect(box, &QMessageBox::finished, this,
            [this, box, edit]
            {
              if (box->buttonRole(box->clickedButton()) == QMessageBox::AcceptRole)
                edit(presenters::CatalogueEditor::repairing(m_model.library().folder()));
            });
    box->open();
  };
  guarded(
      [&]
      {
        std::optional<presenters::CatalogueEditor> editor;
        try
        {
          editor.emplace(m_model.library().folder());
        }
        catch (const core::Error& fault)
        {
          return offerRepair(toString(fault));
        }
        edit(std::move(*editor));
      },
      [this](const QString& why) { notice(capitalized(sentence(why))); });
}

void MainWindow::maskChanged(const core::IndexBox& box)
{
  const auto& value = m_model.value();
  // Shared with the dissection: a single thread writes and renders.
  m_view->display().maskChanged(value.dissection.sharedMask(), box);
  m_slices->maskChanged(box);
}

void MainWindow::stateChanged()
{
  const bool open = m_model.hasCase();
  const QString program = m_options.isSafe ? tr("Petrous (safe mode)") : QString("Petrous");
  m_actions->setCaseOpen(open);
  m_sliceControl->setCaseOpen(open);
  m_actions->setOnMr(open && m_model.value().ct.modality == scene::Modality::Mr);
  m_branches->stateChanged();
  m_comparison->stateChanged();
  m_stamps->stateChanged();
  showInstrumentOut();
  showUndo();
  if (!open)
    return setWindowTitle(program);
  for (const auto& [entry, panel] : m_panels)
    panel->stateChanged();
  const scene::Case& value = m_model.value();
  if (value.id != m_settings->lastCase())
    m_settings->keepLastCase(value.id);
  setWindowTitle(
      (m_model.unsaved() || m_model.beingStored() ? QString::fromUtf8("• ") : QString()) +
      words(value.name) + QString::fromUtf8(" — ") + program);
  m_sum->setText(removedText(value, m_model.drilling()));
  if (m_model.unsaved() && m_options.saveAfter >= 0 && !m_saveLater.isActive())
    m_saveLater.start();
}

// What is lost in a crash is at most this old; a stroke is in the journal sooner.
void MainWindow::saveLater()
{
  if (!m_model.hasCase() || !m_model.unsaved())
    return;
  // A save that failed is said, and its banner offers to try again.
  if (busy() || m_model.drilling() || m_unsavedBanner->isVisible() ||
      QApplication::mouseButtons() != Qt::NoButton)
    return m_saveLater.start();
  m_saver->save();
}

// Returns at once: the case is shown behind it.
void MainWindow::notice(const QString& text)
{
  auto* box = new QMessageBox(QMessageBox::Information, tr("Note on the case"), text,
                              QMessageBox::Ok, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

void MainWindow::showView(rendering::StandardView view)
{
  if (!m_model.hasCase())
    return;
  if (const QString former = std::exchange(m_earDoubt, {});
      !former.isEmpty() && statusBar()->currentMessage() == former)
    statusBar()->clearMessage();
  m_view->setCamera(presenters::standardCamera(m_model.value(), view));
  if (view == rendering::StandardView::Lateral && !presenters::earOf(m_model.value()))
  {
    const core::CameraPose camera = m_view->picture().camera();
    m_earDoubt = camera.position.x() > camera.focalPoint.x()
                     ? tr("Which ear it is, is not known (Case > Side): this is the patient's left")
                     : tr("Which ear it is, is not known (Case > Side): this is the patient's "
                          "right");
    return statusBar()->showMessage(m_earDoubt);
  }
  if (view != rendering::StandardView::SurgicalLeft &&
      view != rendering::StandardView::SurgicalRight)
    return;
  const bool isLeft = view == rendering::StandardView::SurgicalLeft;
  const std::string doubt =
      presenters::earDoubt(m_model.value(), isLeft ? scene::Side::Left : scene::Side::Right);
  if (doubt.empty())
    return;
  m_earDoubt = phrase(doubt);
  statusBar()->showMessage(m_earDoubt);
}

// A view from the other side would stand under the name of this one.
void MainWindow::sideAnswered()
{
  using scene::Side;
  const Side side = m_model.value().description.side;
  if (side != Side::Left && side != Side::Right)
    return;
  const core::CameraPose camera = m_view->picture().camera();
  const Eigen::Vector3d from = (camera.position - camera.focalPoint).normalized(); // LPS
  constexpr double kFromTheSide = 0.5;
  if (side == Side::Left ? from.x() < -kFromTheSide : from.x() > kFromTheSide)
    showView(side == Side::Left ? rendering::StandardView::SurgicalLeft
                                : rendering::StandardView::SurgicalRight);
}

void MainWindow::stepped(bool back)
{
  m_video->stateChanged();
  const scene::Case& value = m_model.value();
  const auto& strokes = value.dissection.strokes();
  const dissection::History& history = value.dissection.history();
  const std::size_t stroke = back ? history.next() : history.position();
  if (m_actions->strokeCamera->isChecked() && stroke < strokes.size() &&
      strokes[stroke]->info.camera)
    m_view->setCamera(*strokes[stroke]->info.camera);
  statusBar()->showMessage((back ? tr("Stroke %1 undone") : tr("Stroke %1 drilled again"))
                               .arg(dissection::strokeNumber(stroke)),
                           kMessage);
}

void MainWindow::strokeEnded(const std::shared_ptr<const dissection::Stroke>& stroke)
{
  showUndo();
  const QString text = strokeText(stroke.get());
  if (!stroke)
    return statusBar()->showMessage(text, kMessage);
  m_segment->strokeEnded();
  if (m_model.hasCase() && m_model.value().dissection.history().ahead() == 0)
    statusBar()->showMessage(text); // else an undo has ended it, and says so
  m_saver->save();
}

// The MRs are in no list.
void MainWindow::fillCaseMenu()
{
  QMenu& menu = *m_actions->casePart;
  const QList<QAction*> actions = menu.actions();
  for (int n = actions.indexOf(m_actions->restorePart) + 1; n < actions.size(); ++n)
    delete actions[n];
  const std::string removed = m_model.removedPart();
  enable(*m_actions->restorePart, !removed.empty(), tr("Nothing was taken out of the case"));
  m_actions->restorePart->setText(
      removed.empty() ? tr("Put &back")
                      : tr("Put &back “%1”").arg(words(removed).replace('&', "&&")));
  if (!m_model.hasCase())
    return;
  addSelectedTo(menu);
  if (m_model.value().mr.empty())
    return;
  menu.addSeparator();
  const std::vector<std::string> names = scene::partNames(m_model.value());
  for (const scene::ImagePart& mr : m_model.value().mr)
  {
    const QString shown = shownName(mr.name).replace('&', "&&");
    connect(menu.addAction(tr("Rename the MR “%1”…").arg(shown)), &QAction::triggered, this,
            [this, name = mr.name] { m_keeper->renamePart(name); });
    QAction* remove = menu.addAction(tr("Remove the MR “%1”").arg(shown));
    connect(remove, &QAction::triggered, this,
            [this, name = mr.name] { m_keeper->removePart(name); });
    enable(*remove, std::count(names.begin(), names.end(), mr.name) == 1,
           tr("A structure or mesh of the case has this name, too, and would be taken out in its "
              "place; take that out first"));
    connect(menu.addAction(tr("Correct the axes of the MR “%1”…").arg(shown)), &QAction::triggered,
            this, [this, name = mr.name] { correctAxes(name); });
  }
}

// Of a part.
void MainWindow::correctAxes(const std::string& part)
{
  if (m_registration->running() && m_model.hasCase() && scene::findMr(m_model.value(), part))
    return statusBar()->showMessage(disturbsText(), kMessage);
  m_drill->releaseTool(); // ends an open stroke
  m_keeper->correctAxes(part);
}

// What is selected in the list of structures, as the list's own menu has it.
void MainWindow::addSelectedTo(QMenu& menu)
{
  std::vector<std::string> parts = findChild<StructuresPanel*>()->selectedParts();
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                             [](const std::string& part)
                             { return part == "ct" || part == scene::kSoftTissue; }),
              parts.end());
  if (parts.empty())
    return;
  menu.addSeparator();
  const QString shown = shownName(parts.front()).replace('&', "&&");
  const bool isOne = parts.size() == 1;
  if (isOne)
    connect(menu.addAction(tr("Rename “%1”…").arg(shown)), &QAction::triggered, this,
            [this, part = parts.front()] { m_keeper->renamePart(part); });
  if (isOne)
    connect(menu.addAction(tr("Correct the axes of “%1”…").arg(shown)), &QAction::triggered, this,
            [this, part = parts.front()] { correctAxes(part); });
  QAction* remove = menu.addAction(isOne ? tr("Remove “%1”").arg(shown)
                                         : tr("Remove the %1 selected").arg(parts.size()));
  remove->setStatusTip(tr(
      "Takes what is selected in the list of structures out of the case; Ctrl+Z brings it back"));
  connect(remove, &QAction::triggered, this,
          [this, parts]
          {
            for (const std::string& part : parts)
              m_keeper->removePart(part);
          });
}

void MainWindow::raisePanel(const char* dock)
{
  if (auto* panel = findChild<QDockWidget*>(dock))
  {
    panel->show();
    panel->raise();
  }
}

void MainWindow::showLibrary()
{
  raisePanel("libraryDock");
  m_library->panel()->focusList();
}

void MainWindow::showKeys()
{
  auto* keys = new KeyList(commandsOf(*this, m_model.hasCase()), this);
  keys->setAttribute(Qt::WA_DeleteOnClose);
  keys->show();
}

void MainWindow::findCommand()
{
  std::vector<Command> commands = commandsOf(*this, m_model.hasCase());
  for (Command& setting : settingsOf(*this, m_model.hasCase()))
    commands.push_back(std::move(setting));
  auto* palette = new CommandPalette(std::move(commands), this);
  palette->setAttribute(Qt::WA_DeleteOnClose);
  palette->open();
}

void MainWindow::showSettings()
{
  auto* dialog = new SettingsDialog(*m_settings, m_model.library().folder(),
                                    {m_library->drawThumbnails(), m_actions->strokeCamera,
                                     m_actions->slicesFollow, m_actions->drillSound},
                                    this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
}

// Begins with the tool: in use, it is taken up again.
void MainWindow::record(bool on)
{
  m_recordingBanner->hide();
  const std::filesystem::path file = on ? chooseRecording() : std::filesystem::path();
  if (on && file.empty())
    return;
  m_model.record(file);
  if (m_model.touching())
    m_drill->renewTool();
}

// Where the user wants it; empty: nowhere.
std::filesystem::path MainWindow::chooseRecording()
{
  QFileDialog dialog(this, tr("Record the session"));
  dialog.setNameFilter(tr("Recordings (*.ticks)"));
  dialog.setDefaultSuffix("ticks");
  try
  {
    const auto usual = presenters::newRecording(m_model.library(), m_model.value());
    dialog.setDirectory(QFile::decodeName(usual.parent_path().c_str()));
    dialog.selectFile(QFile::decodeName(usual.filename().c_str()));
  }
  catch (const core::Error& error) // the library cannot be written
  {
    showRecording(toString(error));
    dialog.setDirectory(QDir::homePath());
  }
  const std::filesystem::path file = askFile(dialog);
  try
  {
    if (!file.empty())
      library::refuseOverwriting(file, m_model.library().folder());
  }
  catch (const core::Error& error)
  {
    showRecording(toString(error));
    return {};
  }
  return file;
}

void MainWindow::showRecording(const QString& fault)
{
  m_bound.refresh();
  for (const auto& [entry, panel] : m_panels)
    panel->attachmentsChanged();
  const QString file = QFile::decodeName(m_model.recording().c_str());
  m_recording->setText(
      QString::fromUtf8("● ") +
      tr("Recording %1")
          .arg(fontMetrics().elidedText(QFileInfo(file).fileName(), Qt::ElideMiddle, kFileName)));
  m_recording->setToolTip(
      tr("All that tool and drill do is written to %1, until Drill > Record session… is chosen "
         "again")
          .arg(file));
  m_recording->setVisible(!file.isEmpty());
  if (fault.isEmpty())
    return;
  m_recordingBanner->setText(tr("%1 Drilling goes on.").arg(sentence(fault)));
  m_recordingBanner->show();
}

bool MainWindow::flush()
{
  // Ends an open stroke, here and in the surgeon's window.
  m_drill->releaseTool();
  return m_saver->flush();
}

void MainWindow::closeEvent(QCloseEvent* event)
{
  if (m_isClosing) // called again while tasks end
    return event->ignore();
  const QScopedValueRollback<bool> closing(m_isClosing, true);
  m_drill->releaseTool(); // ends an open stroke
  event->setAccepted(m_keeper->mayLeave());
  if (!event->isAccepted())
    return;
  keepPanels();
  m_picture->closeSurgeonWindow();
  m_comparison->close();
  finishAll(*this);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
  if (!dropped(*event->mimeData()).isEmpty())
    event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event)
{
  const QStringList what = dropped(*event->mimeData());
  if (what.isEmpty())
    return;
  event->acceptProposedAction();
  // The source program must not block on us.
  QMetaObject::invokeMethod(
      this, [this, what] { m_keeper->open(what); }, Qt::QueuedConnection);
}

} // namespace petrous::workstation
