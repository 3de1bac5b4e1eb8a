#include "WindowActions.h"

#include <iterator>

#include <QAction>
#include <QActionGroup>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QToolBar>
#include <QToolButton>

#include "Commands.h"
#include "DeviceToolBar.h"
#include "DrillBar.h"
#include "MenuAction.h"
#include "petrous/Presenters/ViewArrangement.h"
#include "petrous/Rendering/Stereo.h"
#include "petrous/Scene/Description.h"

namespace petrous::workstation
{

namespace
{
struct ViewEntry
{
  rendering::StandardView view;
  const char* name;
  const char* tip;
};
using rendering::StandardView;
constexpr ViewEntry kViews[] = {
    {StandardView::Lateral, QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "&Lateral"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "From the side of the ear")},
    {StandardView::Anterior, QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "&Anterior"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "From the face")},
    {StandardView::Posterior,
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "&Posterior"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "From the back of the head")},
    {StandardView::Superior, QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "&Superior"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "From above, the face up")},
    {StandardView::Inferior, QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "&Inferior"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "From below, the face up")},
    {StandardView::Left, QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "L&eft"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "From the patient's left")},
    {StandardView::Right, QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "&Right"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "From the patient's right")},
    {StandardView::SurgicalLeft,
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "Surgical position, le&ft ear"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions",
                       "The patient on the back, the head turned to the right, seen from the left "
                       "ear: the face up, "
                       "the vertex on the right")},
    {StandardView::SurgicalRight,
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "Surgical position, rig&ht ear"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions",
                       "The patient on the back, the head turned to the left, seen from the right "
                       "ear: the face up, "
                       "the vertex on the left")},
};

struct HandpieceEntry
{
  presenters::SurgicalApproach approach;
  const char* name;
  const char* tip;
};
using presenters::SurgicalApproach;
constexpr HandpieceEntry kHandpieces[] = {
    {SurgicalApproach::Transmastoid,
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "Handpiece: &transmastoid"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions",
                       "As held for a mastoidectomy: onto the mastoid from the side, the surgeon "
                       "behind the ear. It follows the view from there")},
    {SurgicalApproach::PosteriorTympanotomy,
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "Handpiece: &posterior tympanotomy"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions",
                       "As held for the facial recess: 30° from behind, past the posterior wall "
                       "of the canal. It follows the view from there")},
    {SurgicalApproach::Translabyrinthine,
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "Handpiece: trans&labyrinthine"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions",
                       "As held for the labyrinth: 15° from behind, along the internal auditory "
                       "canal. It follows the view from there")},
    {SurgicalApproach::Retrosigmoid,
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "Handpiece: &retrosigmoid"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions",
                       "As held behind the sinus: 45° from behind, along the posterior face of "
                       "the petrous pyramid. It follows the view from there")},
    {SurgicalApproach::MiddleFossa,
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions", "Handpiece: &middle fossa"),
     QT_TRANSLATE_NOOP("petrous::workstation::WindowActions",
                       "As held above the ear: 45° from above, the surgeon at the vertex. It "
                       "follows the view from there")},
};
} // namespace

WindowActions::WindowActions(QMainWindow& window, DrillBar& drillBar, DeviceToolBar& deviceBar,
                             bool quadBuffer)
  : QObject(&window)
{
  QMenu* file = window.menuBar()->addMenu(tr("&File"));
  openDicom = make(file, tr("Open &DICOM…"), QKeySequence::Open,
                   tr("A folder of CT slices: a new case; of MR slices: for the open case"));
  openImage =
      make(file, tr("Open &files…"), {},
           tr("A CT as NRRD, NIfTI or MetaImage: a new case; MR, label maps and meshes: for "
              "the open case"));
  openRegion =
      make(file, tr("Open a &region…"), {},
           tr("A DICOM folder, of whose CT or MR only a box is read that you draw: the ear "
              "of a whole head"));
  openFileRegion = make(file, tr("Open a region of a f&ile…"), {},
                        tr("A CT, cone beam or MR as NRRD, NIfTI or MetaImage, of which only a box "
                           "is read that you draw"));
  openCase =
      make(file, tr("Open &case…"), Qt::CTRL + Qt::SHIFT + Qt::Key_O, tr("A case of the library"));
  sample = make(file, tr("&Make the sample patient"), {}, tr("An artificial temporal bone"));
  file->addSeparator();
  save = make(file, tr("&Save"), QKeySequence::Save, tr("Save the case in the library"));
  saveAs = make(file, tr("Save &as…"), Qt::CTRL + Qt::ALT + Qt::Key_S,
                tr("Save as a new case; the one it came from stays as it was saved"));
  closeCase = make(file, tr("Cl&ose the case"), QKeySequence(Qt::CTRL + Qt::Key_W),
                   tr("Saves the case, and goes back to the first page"));
  file->addSeparator();
  report = make(file, tr("Plan repor&t…"), QKeySequence::Print,
                tr("The plan as PDF or HTML: pictures, distances with uncertainty, strokes, "
                   "measurements"));
  printPicture = make(file, tr("&Picture for print…"), Qt::CTRL + Qt::SHIFT + Qt::Key_S,
                      tr("The 3D view as a PNG of any size, with scale bar and side"));
  film = make(file, tr("Fi&lm…"), {},
              tr("Once around the patient, or a flight along a canal or nerve"));
  file->addSeparator();
  quit = make(file, tr("&Quit"), QKeySequence::Quit, tr("Save and quit"));

  QMenu* edit = window.menuBar()->addMenu(tr("&Edit"));
  undo = make(edit, tr("&Undo"), Qt::CTRL + Qt::Key_Z,
              tr("Take back the last change: a stroke, an appearance, a part"));
  redo = make(edit, tr("&Redo"), Qt::CTRL + Qt::SHIFT + Qt::Key_Z,
              tr("Make the change again that was taken back"));
  addKey(*redo, Qt::CTRL + Qt::Key_Y);
  edit->addSeparator();
  strokeCamera = make(edit, tr("Undo goes back to the stroke's &view"), {},
                      tr("Turn the patient as they lay when the stroke was drilled"));
  strokeCamera->setCheckable(true);
  edit->addSeparator();
  settings = make(edit, tr("Se&ttings…"), Qt::CTRL + Qt::Key_Comma,
                  tr("Theme, size of the letters, library, and how the window behaves"));

  casePart = window.menuBar()->addMenu(tr("&Case"));
  addMrFolder = make(casePart, tr("Add &MR…"), {}, tr("A DICOM folder with an MR of this patient"));
  addMrFile = make(casePart, tr("Add MR &file…"), {},
                   tr("An MR of this patient as NIfTI, NRRD, MetaImage or multi-frame DICOM"));
  addLabels = make(casePart, tr("Add &labels…"), {},
                   tr("Structures of this patient: label maps and segmentations"));
  addMasks = make(casePart, tr("Add f&older of masks…"), {},
                  tr("Structures of this patient, one a file, as TotalSegmentator writes them"));
  addMesh = make(casePart, tr("Add m&esh…"), {}, tr("Surfaces of this patient, in mm"));
  casePart->addSeparator();
  addSides();
  correctAxes = make(casePart, tr("&Correct the axes…"), {},
                     tr("Of an image that is mirrored or lies otherwise than its letters say: a "
                        "new case of it with the right ones"));
  attach = make(casePart, tr("A&ttach…"), {},
                tr("A file goes with the case: recording of the tool, PNG, PDF or video"));
  exportPart = make(casePart, tr("E&xport…"), Qt::CTRL + Qt::Key_E,
                    tr("Images, structures or surfaces as files for other programs"));
  archive = make(casePart, tr("Archi&ve…"), Qt::CTRL + Qt::SHIFT + Qt::Key_A,
                 tr("The case in one file, to hand it on: whole, or only the plan"));
  restore = make(casePart, tr("&Restore…"), Qt::CTRL + Qt::SHIFT + Qt::Key_E,
                 tr("The case of an archive comes to the library and is opened"));
  casePart->addSeparator();
  restorePart = make(casePart, tr("Put &back"), {}, tr("What was taken out of the case last"));
  restorePart->setEnabled(false);

  approaches = window.menuBar()->addMenu(tr("&Approach"));

  m_view = window.menuBar()->addMenu(tr("&View"));
  int number = 1;
  auto* viewMenu = new QMenu(&window);
  QMenu* standardViews = m_view->addMenu(tr("Sta&ndard views"));
  for (const ViewEntry& entry : kViews)
  {
    QAction* action =
        make(standardViews, tr(entry.name), QKeySequence(QString::number(number++)), tr(entry.tip));
    connect(action, &QAction::triggered, this,
            [this, view = entry.view] { emit viewChosen(view); });
    m_needCase.push_back(action);
    viewMenu->addAction(action);
  }
  standardViews->addSeparator();
  rollLeft = make(standardViews, tr("Roll counterclock&wise"), Qt::Key_Comma,
                  tr("Turns the 3D picture about its middle, by 5 degrees"));
  rollRight = make(standardViews, tr("Roll cloc&kwise"), Qt::Key_Period,
                   tr("Turns the 3D picture about its middle, by 5 degrees"));
  QMenu* layoutMenu = addLayouts();
  m_layout = layoutMenu->menuAction();
  centerView = make(m_view, tr("&Centre on the crosshair"), Qt::Key_C,
                    tr("The 3D view turns and zooms about the crosshair from now on"));
  boneThickness = make(m_view, {}, Qt::Key_F6, {});
  boneThickness->setCheckable(true);
  clipHere = make(m_view, tr("C&ut away to the crosshair"), Qt::SHIFT + Qt::Key_C,
                  tr("What lies before the crosshair is not shown, until a tool is taken up"));
  clipOff = make(m_view, tr("Show what was cut &away"), Qt::CTRL + Qt::SHIFT + Qt::Key_C,
                 tr("Also where the case was saved with a part of the picture only"));
  QMenu* plane = m_view->addMenu(tr("Clipping plan&e"));
  clipDeeper = make(plane, tr("Cut &deeper"), Qt::SHIFT + Qt::Key_PageDown,
                    tr("Moves the plane that cuts the picture by 0.5 mm"));
  clipLess = make(plane, tr("Cut l&ess deep"), Qt::SHIFT + Qt::Key_PageUp,
                  tr("Moves the plane that cuts the picture back by 0.5 mm"));
  const QString turned = tr("By a degree, within the slice that has the keyboard; in the 3D view "
                            "about the vertical of the picture, as seen from above");
  clipTurnLeft =
      make(plane, tr("Turn the cut &counterclockwise"), Qt::SHIFT + Qt::Key_Left, turned);
  clipTurnRight = make(plane, tr("&Turn the cut clockwise"), Qt::SHIFT + Qt::Key_Right, turned);
  // Of the views: lists and numbers have these keys.
  for (QAction* action : {clipDeeper, clipLess, clipTurnLeft, clipTurnRight})
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  cropBox = make(m_view, tr("Crop bo&x"), Qt::SHIFT + Qt::Key_V,
                 tr("A box whose edges are dragged in the slices, and its faces in the 3D view: "
                    "only what is in it is shown, until a tool is taken up. Its middle in the 3D "
                    "view, or a drag with Shift, moves all of it. A double click on an edge shows "
                    "all of the image"));
  cropBox->setCheckable(true);
  cropNumbers = make(m_view, tr("Crop &box in numbers…"), {},
                     tr("Where the crop box begins and ends, in mm"));
  m_view->addSeparator();
  m_greyWindows = m_view->addMenu(tr("Grey &window of the slices"));
  boneWindow = make(m_greyWindows, {}, Qt::Key_B, {});
  softWindow = make(m_greyWindows, {}, Qt::Key_T, {});
  temporalWindow = make(m_greyWindows, tr("Temporal bo&ne window"), Qt::SHIFT + Qt::Key_B,
                        tr("Grey from -800 to 2000 HU"));
  setOnMr(false);
  fitSlices = make(m_view, tr("&Fit slices"), Qt::Key_F, tr("Whole slices again"));
  m_view->addSeparator();
  m_viewButton = viewMenu;
  viewMenu->addAction(rollLeft);
  viewMenu->addAction(rollRight);
  viewMenu->addSeparator();
  viewMenu->addMenu(layoutMenu);
  viewMenu->addMenu(addStereo(quadBuffer));
  viewMenu->addAction(surgeonWindow);
  m_view->addSeparator();
  m_panels = m_view->addMenu(tr("&Panels"));

  QMenu* drill = window.menuBar()->addMenu(tr("&Drill"));
  drill->addAction(drillBar.drillAction());
  drill->addAction(drillBar.pointerAction());
  drill->addAction(drillBar.instrumentAction());
  instrumentFile = make(drill, tr("Instr&ument from a file…"), {},
                        tr("A closed surface (OBJ, STL, PLY, VTP) of 1 to 300 mm, its tip at the "
                           "origin: it is felt and drawn, and removes nothing"));
  instrumentOut = make(drill, tr("T&ake the instrument out of the case"), {},
                       tr("The next save keeps none with the case; its file stays as it is"));
  drill->addAction(drillBar.wheelAction());
  drill->addAction(deviceBar.hereAction());
  drill->addActions({deviceBar.connectAction(), deviceBar.testAction()});
  smallerBurr = make(drill, tr("&Smaller burr"), Qt::Key_BracketLeft,
                     tr("The next smaller one that is sold"));
  largerBurr =
      make(drill, tr("&Larger burr"), Qt::Key_BracketRight, tr("The next larger one that is sold"));
  addKey(*smallerBurr, Qt::Key_A);
  addKey(*largerBurr, Qt::Key_S);
  otherKind = make(drill, tr("Next &kind of burr"), Qt::Key_L,
                   tr("Cutting, diamond, or the next one of your own"));
  QMenu* handpiece = drill->addMenu(tr("Handp&iece"));
  turnLeft = make(handpiece, tr("Turn counterclock&wise"), Qt::ALT + Qt::Key_Left,
                  tr("About the line of sight, by 5 degrees; Alt with the wheel does so, too"));
  turnRight = make(handpiece, tr("Turn clockwi&se"), Qt::ALT + Qt::Key_Right,
                   tr("About the line of sight, by 5 degrees; Alt with the wheel does so, too"));
  tiltMore = make(handpiece, tr("Tilt &away from the line of sight"), Qt::ALT + Qt::Key_PageUp,
                  tr("By 5 degrees; Alt and Shift with the wheel do so, too"));
  tiltLess = make(handpiece, tr("Tilt to the &line of sight"), Qt::ALT + Qt::Key_PageDown,
                  tr("By 5 degrees; Alt and Shift with the wheel do so, too"));
  holdAsAtFirst = make(handpiece, tr("As at &first"), Qt::ALT + Qt::Key_Home,
                       tr("The usual turn and tilt of the hand"));
  QMenu* approachMenu = handpiece->addMenu(tr("F&or an approach"));
  for (const HandpieceEntry& entry : kHandpieces)
  {
    QAction* action = make(approachMenu, tr(entry.name), {}, tr(entry.tip));
    connect(action, &QAction::triggered, this,
            [this, approach = entry.approach] { emit handpieceChosen(approach); });
    m_needCase.push_back(action);
  }
  handpiece->addSeparator();
  leftHand = make(handpiece, tr("In the left &hand"), Qt::SHIFT + Qt::Key_H,
                  tr("The handpiece comes from the left of the screen"));
  leftHand->setCheckable(true);
  burrAlone = make(handpiece, tr("Only the &burr is felt"), Qt::SHIFT + Qt::Key_Q,
                   tr("Three degrees of freedom: shaft and handpiece pass through tissue, and "
                      "there is no torque"));
  burrAlone->setCheckable(true);
  drill->addSeparator();
  drillBar.wheelAction()->setText(tr("Depth &by wheel"));
  drillBar.wheelAction()->setIconText(tr("By wheel"));
  slicesFollow = make(drill, tr("Slices &follow the burr"), {},
                      tr("The crosshair goes along while the drill is on, and with the tip of the "
                         "pointer or the instrument"));
  slicesFollow->setCheckable(true);
  slicesFollow->setChecked(true);
  drillSound = make(drill, tr("S&ound of the drill"), {},
                    tr("Spindle and teeth, louder in bone and brighter where the wall is thin; a "
                       "tone while a warning is shown"));
  drillSound->setCheckable(true);
  catalogues = make(drill, tr("&Materials and burrs…"), {},
                    tr("The numbers of the removal laws, with their units and sources, and the "
                       "diameters that the bar offers"));
  drill->addSeparator();
  record =
      make(drill, tr("&Record session…"), Qt::CTRL + Qt::SHIFT + Qt::Key_R,
           tr("Writes all that tool and drill do to a file, until it is chosen again; the panel "
              "Replay and the command line can repeat it"));
  record->setCheckable(true);
  openRecording = make(drill, tr("Op&en a recording…"), Qt::CTRL + Qt::SHIFT + Qt::Key_Y,
                       tr("A recorded session is played beside the tool in use, with what it "
                          "took: time, path, force, distances, volumes"));
  playRecording = make(drill, tr("Pla&y the recording"), Qt::SHIFT + Qt::Key_Y,
                       tr("Plays the recorded tool as a ghost, or pauses it"));

  QMenu* help = window.menuBar()->addMenu(tr("&Help"));
  keyList = make(help, tr("&Keys"), Qt::Key_F1, tr("All keys of the window, with a search"));
  manual = make(help, tr("&Manual"), Qt::SHIFT + Qt::Key_F1,
                tr("Opens the manual in the browser: a tutorial, and a chapter for each panel"));
  findCommand = make(help, tr("&Find a command…"), Qt::CTRL + Qt::SHIFT + Qt::Key_P,
                     tr("Anything that the menus have, by its name"));
  help->addSeparator();
  about = make(help, tr("&About Petrous"), {}, tr("What this program is"));

  auto* bar = new QToolBar(tr("Case"), &window);
  bar->setObjectName("caseBar");
  bar->setMovable(false);
  const auto addShort = [bar](QAction* action, const QString& text)
  {
    action->setIconText(text);
    bar->addAction(action);
  };
  addShort(openDicom, tr("Open…"));
  addShort(openCase, tr("Cases…"));
  addShort(save, tr("Save"));
  bar->addSeparator();
  addShort(undo, tr("Undo"));
  addShort(redo, tr("Redo"));
  bar->addSeparator();
  auto* views = new QToolButton;
  views->setText(tr("View"));
  views->setToolTip(tr("Standard sides (1 to 7), surgical position (8 left, 9 right), saved views, "
                       "layout, stereo, the surgeon's window (F11)"));
  views->setMenu(viewMenu);
  views->setPopupMode(QToolButton::InstantPopup);
  bar->addWidget(views);
  window.addToolBar(bar);
  window.addToolBarBreak(); // in one row with the next two, a narrow window would hide some
  window.addToolBar(&drillBar);
  window.addToolBar(&deviceBar);

  m_needCase.insert(m_needCase.end(), {save,
                                       saveAs,
                                       report,
                                       printPicture,
                                       film,
                                       closeCase,
                                       attach,
                                       clipHere,
                                       clipOff,
                                       cropBox,
                                       cropNumbers,
                                       correctAxes,
                                       exportPart,
                                       archive,
                                       addMrFolder,
                                       addMrFile,
                                       addLabels,
                                       addMasks,
                                       addMesh,
                                       centerView,
                                       rollLeft,
                                       rollRight,
                                       boneThickness,
                                       boneWindow,
                                       softWindow,
                                       temporalWindow,
                                       fitSlices,
                                       drillBar.drillAction(),
                                       drillBar.pointerAction(),
                                       drillBar.instrumentAction(),
                                       instrumentFile,
                                       record,
                                       openRecording,
                                       playRecording});
}

void WindowActions::addSides()
{
  sides = new QActionGroup(this);
  QMenu* menu = casePart->addMenu(tr("&Side"));
  const auto add = [this, menu](const QString& text, scene::Side side, const QString& tip)
  {
    QAction* action = make(menu, text, {}, tip);
    action->setCheckable(true);
    action->setData(static_cast<int>(side));
    sides->addAction(action);
    m_needCase.push_back(action);
  };
  const QString tip = tr("The side of the patient that is operated on; it stands over every view");
  add(tr("Side: &left"), scene::Side::Left, tip);
  add(tr("Side: &right"), scene::Side::Right, tip);
  add(tr("Side: &both"), scene::Side::Both, tip);
  add(tr("Side: &not stated"), scene::Side::Unknown, tr("It is asked for when the case is opened"));
}

QMenu* WindowActions::addLayouts()
{
  using presenters::ViewLayout;
  layouts = new QActionGroup(this);
  QMenu* menu = m_view->addMenu(tr("La&yout"));
  const auto add = [this, menu](const QString& text, ViewLayout layout, const QString& tip)
  {
    const int key = Qt::Key_1 + static_cast<int>(layout);
    QAction* action = make(menu, text, QKeySequence(Qt::CTRL + key), tip);
    action->setCheckable(true);
    action->setData(static_cast<int>(layout));
    layouts->addAction(action);
    m_needCase.push_back(action);
  };
  add(tr("3D view, slices &beside"), ViewLayout::Beside, tr("The three slices in a column"));
  add(tr("&Four up"), ViewLayout::FourUp, tr("3D view and slices in two rows"));
  add(tr("&3D view alone"), ViewLayout::ThreeD, tr("Without slices"));
  add(tr("&One slice large"), ViewLayout::OneSlice,
      tr("The slice that was clicked last; the other views in a column beside it"));
  add(tr("&Slices alone"), ViewLayout::Slices, tr("Side by side, without the 3D view"));
  menu->addSeparator();
  enlargeView = make(menu, tr("&Enlarge the view"), Qt::Key_E,
                     tr("The view that was clicked last fills the window, and goes back; as a "
                        "double click on it. Esc goes back, too"));
  enlargeView->setCheckable(true);
  m_needCase.push_back(enlargeView);
  return menu;
}

QMenu* WindowActions::addStereo(bool quadBuffer)
{
  using rendering::StereoMode;
  stereo = new QActionGroup(this);
  QMenu* menu = m_view->addMenu(tr("Stere&o"));
  const auto add = [this, menu](const QString& text, StereoMode mode, const QString& tip)
  {
    QAction* action = make(menu, text, {}, tip);
    action->setCheckable(true);
    action->setData(static_cast<int>(mode));
    stereo->addAction(action);
    return action;
  };
  add(tr("&Off"), StereoMode::None, tr("One picture"))->setChecked(true);
  add(tr("&Side by side"), StereoMode::SideBySide,
      tr("The left eye's picture on the left half, for head-mounted displays and 3D screens"));
  add(tr("&Line-interleaved"), StereoMode::Interleaved,
      tr("Rows by turns, for screens with polarised glasses"));
  add(tr("&Anaglyph"), StereoMode::Anaglyph, tr("For red-cyan glasses"));
  if (quadBuffer)
    add(tr("&Quad buffer"), StereoMode::QuadBuffer,
        tr("For shutter glasses, in the surgeon's window"));
  surgeonWindow = make(m_view, tr("Sur&geon's window"), Qt::Key_F11,
                       tr("The scene on a whole screen, the second one where there is one; Esc "
                          "closes it"));
  surgeonWindow->setShortcuts({Qt::Key_F11, Qt::CTRL + Qt::Key_F});
  surgeonWindow->setCheckable(true);
  m_needCase.push_back(surgeonWindow);
  return menu;
}

void WindowActions::addSavedViews(QMenu* menu)
{
  m_view->insertMenu(m_layout, menu);
  m_viewButton->insertMenu(m_viewButton->actions().at(static_cast<int>(std::size(kViews))), menu);
  m_needCase.push_back(menu->menuAction());
}

void WindowActions::addSliceMenu(QMenu* menu)
{
  m_view->insertMenu(m_greyWindows->menuAction(), menu);
}

void WindowActions::addPanelToggle(QAction* action, bool needsCase)
{
  m_panels->addAction(action);
  if (needsCase)
    m_needCase.push_back(action);
}

void WindowActions::setOnMr(bool isMr)
{
  const auto set = [](QAction* action, const QString& text, const QString& tip)
  {
    action->setText(text);
    setTip(*action, tip);
  };
  set(boneThickness,
      isMr ? tr("Tissue &thickness over the structure") : tr("Bone &thickness over the structure"),
      isMr ? tr("Colours tissue by how much of it is left over the structure that is chosen in the "
                "list")
           : tr("Colours bone by how much of it is left over the structure that is chosen in the "
                "list"));
  set(boneWindow, isMr ? tr("&Full window") : tr("&Bone window"),
      isMr ? tr("Grey over all tissue of the MR") : tr("Grey from -1300 to 2700 HU"));
  temporalWindow->setVisible(!isMr);
  set(softWindow, isMr ? tr("&Dark half window") : tr("Soft &tissue window"),
      isMr ? tr("Grey over the darker half of the MR's tissue") : tr("Grey from -160 to 240 HU"));
}

void WindowActions::setCaseOpen(bool open)
{
  for (QAction* action : m_needCase)
    enable(*action, open, tr("Open a case first"));
}

} // namespace petrous::workstation
