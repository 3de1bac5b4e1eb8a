#include "DrillController.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <QAction>
#include <QApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>

#include "ActiveDeviceController.h"
#include "Application.h"
#include "AskName.h"
#include "DrillBar.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowTexts.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Scene/Case.h"

namespace petrous::workstation
{

namespace
{
constexpr int kFrame = 16;              // ms
constexpr int kFaultShown = 1500;       // ms after the last tick with a fault
constexpr int kStart = 500;             // ms for a device to settle after it was taken up
constexpr int kGone = 1000;             // ms; a crashed server restarts sooner
constexpr int kAnew = 300;              // ms after the last change of the tool
constexpr double kLeastStandoff = 0.01; // mm, of an instrument's origin from the surface
constexpr double kTipBeyond = 1.0;      // mm: how far a pressed tip may go in
constexpr double kThrustPerNotch = 0.5; // N
constexpr double kStill = 0.02;         // mm
constexpr double kBeyond = 0.2;         // mm below the tissue's surface
constexpr int kReadAgain = 500;         // ms, while the tip rests: tissue may have been restored

using haptics::DeviceVerdict;
using session::ServoFault;
using session::TickRecord;

QString textOf(const presenters::PlaceReading& reading, const presenters::IntensityDisplay& display)
{
  QStringList lines;
  if (reading.hounsfield)
    lines += numberText(display.text(*reading.hounsfield));
  if (!reading.structure.empty())
    lines += shownName(reading.structure);
  lines += reading.surface
               ? DrillController::tr("%1 mm to the surface").arg(numberText(*reading.surface, 1))
               : DrillController::tr("no surface within %1 mm")
                     .arg(numberText(presenters::PointProbe::kReach, 0));
  if (reading.near)
    lines += DrillController::tr("%1 mm to %2")
                 .arg(numberText(reading.near->distance, 1), shownName(reading.near->name));
  else if (!reading.isNearKnown)
    lines += DrillController::tr("distances to structures: being measured…");
  return lines.join('\n');
}
// Of a handpiece: the mirror image on the screen. Degrees.
double inOtherHand(double turn)
{
  return std::remainder(180.0 - turn, 360.0);
}

} // namespace

DrillController::DrillController(presenters::WorkstationModel& model, ThreeDView& view,
                                 DrillBar& bar, ActiveDeviceController& devices, QObject* parent)
  : QObject(parent)
  , m_model(model)
  , m_view(view)
  , m_bar(bar)
  , m_devices(devices)
  , m_driver(model, view, devices)
  , m_sound(model)
{
  connect(&m_preparation, &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            releaseTool();
            emit statusMessage(why);
          });
  connect(&m_reading, &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            const QString file = m_fileRead;
            if (file.isEmpty()) // of the case, which keeps it as it is
            {
              keep(std::nullopt);
              emit statusMessage({});
              emit instrumentRefused(why);
              return;
            }
            if (file == m_instrumentFile)
              m_instrumentFile.clear(); // the user is asked next time
            emit statusMessage({});
            emit instrumentRefused(
                QFileInfo::exists(file)
                    ? why
                    : tr("The instrument's file is not there any more, under this name at least:\n"
                         "%1")
                          .arg(file));
          });
  connect(&m_reading, &BackgroundWork::progressed, this,
          [this](double fraction, const QString&, const QString& left)
          {
            emit statusMessage(withTimeLeft(
                tr("Reading the instrument… %1 %").arg(numberText(100.0 * fraction, 0)), left));
          });
  m_frames.setInterval(kFrame);
  connect(&m_frames, &QTimer::timeout, this, &DrillController::frame);
  m_anew.setSingleShot(true);
  m_anew.setInterval(kAnew);
  connect(&m_anew, &QTimer::timeout, this,
          [this]
          {
            // A moving slider would remake it at each step.
            if (QApplication::mouseButtons() != Qt::NoButton)
              return m_anew.start();
            renewCoupling();
            takeTool();
          });
  connectBar();
  connectView();
  connectDevices();
  connect(this, &DrillController::strokeEnded, this, // for another thrust than it began with
          [this] { QTimer::singleShot(0, this, &DrillController::renewCoupling); });
  applyBar();
}

void DrillController::connectBar()
{
  const auto onTool = [this](QAction* action, Tool tool)
  {
    connect(action, &QAction::toggled, this,
            [this, tool](bool on)
            {
              if (on || m_tool == tool)
                setTool(on ? tool : Tool::None);
            });
  };
  onTool(m_bar.drillAction(), Tool::Burr);
  onTool(m_bar.pointerAction(), Tool::Pointer);
  onTool(m_bar.instrumentAction(), Tool::Instrument);
  connect(&m_bar, &DrillBar::burrChanged, this, &DrillController::restartTool);
  connect(&m_bar, &DrillBar::pressChanged, this, &DrillController::applyBar);
}

void DrillController::connectView()
{
  connect(&m_view, &ThreeDView::pointed, this, &DrillController::hover);
  connect(&m_view, &ThreeDView::pointerLeft, this, &DrillController::pointedNowhere);
  connect(&m_view, &ThreeDView::picked, this,
          [this](const interaction::PickRay& line)
          {
            if (const auto hit = surfaceAt(line))
              m_model.setCrosshair(*hit);
            else if (m_tool == Tool::None && m_model.isCutAway(line))
              emit statusMessage(cutAwayText());
          });
  connect(&m_view, &ThreeDView::thrustTurned, this,
          [this](double notches)
          {
            m_bar.setThrust(m_bar.thrust() + kThrustPerNotch * notches);
            emit statusMessage(tr("Thrust %1 N").arg(numberText(m_bar.thrust(), 1)));
          });
  connect(&m_view, &ThreeDView::handpieceTurned, this, &DrillController::turnHandpiece);
  connect(&m_view, &ThreeDView::drillPressed, this, &DrillController::press);
}

void DrillController::connectDevices()
{
  connect(&m_devices, &ActiveDeviceController::leaving, this, &DrillController::putAway);
  connect(&m_devices, &ActiveDeviceController::came, this, &DrillController::deviceCame);
  connect(&m_devices, &ActiveDeviceController::mappingChanged, this, &DrillController::restartTool);
  connect(&m_devices, &ActiveDeviceController::pedalCame, this,
          [this]
          {
            if (!m_model.drilling())
              renewTool(); // with the pedal
          });
}

void DrillController::setSlicesFollow(bool follow)
{
  m_slicesFollow = follow;
}

double DrillController::toolRadius() const
{
  const bool isBall = m_tool != Tool::Pointer && m_tool != Tool::Instrument;
  return isBall ? 0.5 * m_bar.burr().diameter : kPointerRadius;
}

rendering::ToolPose DrillController::toolForm() const
{
  using rendering::BurrFinish;
  rendering::ToolPose form;
  form.radius = toolRadius();
  form.handpiece = m_tool != Tool::Pointer && m_tool != Tool::Instrument;
  if (m_tool == Tool::Instrument)
    form.instrument = m_instrument->surface;
  if (form.handpiece)
    form.finish = m_bar.burr().kind == dissection::Burr::Kind::Diamond ? BurrFinish::Gritted
                                                                       : BurrFinish::Fluted;
  return form;
}

void DrillController::applyBar()
{
  using Mode = interaction::AimSettings::Mode;
  const bool wheel = m_bar.wheelAction()->isChecked() && !m_devices.device();
  interaction::AimSettings settings;
  m_sound.setBurr(m_bar.burr());
  settings.burrRadius = toolRadius();
  settings.thrust = m_bar.thrust();
  settings.turn = m_turn;
  settings.tilt = m_tilt;
  settings.mode = wheel && m_tool != Tool::Pointer ? Mode::Depth : Mode::Surface;
  if (m_tool == Tool::Pointer)
    settings.lift = 0.0;
  if (m_tool == Tool::Instrument)
  {
    settings.burrRadius = std::max(presenters::reachBeyondTip(*m_instrument), kLeastStandoff);
    settings.beyond = kTipBeyond;
  }
  m_view.setWheelPresses(settings.mode == Mode::Surface);
  const bool pressesOtherwise = m_driver.settings().mode != settings.mode;
  m_driver.set(settings);
  if (pressesOtherwise)
    renewCoupling();
  else if (m_model.touching() && m_driver.outgrown())
    m_anew.start(); // after the last step of the thrust
}

// The mouse's tool is taken up again where it is, if it needs another coupling; not in a stroke,
// which keeps the one that it began with.
void DrillController::renewCoupling()
{
  if (!m_model.touching() || m_model.drilling() || !m_driver.outgrown())
    return;
  putAway();
  takeTool();
}

void DrillController::turnHandpiece(double turn, double tilt)
{
  if (m_devices.device())
    return emit statusMessage(tr("The device turns the handpiece by itself"));
  m_turn = std::remainder(m_turn + turn, 360.0);
  m_tilt = std::clamp(m_tilt + tilt, 0.0, interaction::AimSettings::kMaxTilt);
  applyBar();
  emit statusMessage(tr("Handpiece: %1° from the line of sight, at %2° on the screen")
                         .arg(numberText(m_tilt, 0), numberText(m_turn, 0)));
}

void DrillController::holdAsAtFirst()
{
  setHandpiece(std::nullopt);
  turnHandpiece(0.0, 0.0);
}

void DrillController::holdFor(presenters::SurgicalApproach approach)
{
  if (m_devices.device())
    return emit statusMessage(tr("The device turns the handpiece by itself"));
  if (!m_model.hasCase())
    return;
  const auto ear = presenters::earOf(m_model.value());
  if (!ear)
    return emit statusMessage(
        tr("Which ear it is, is not known: state the side first (Case > Side)"));
  const auto hand = presenters::handpieceAlong(presenters::shaftOf(approach, *ear, m_isLeft),
                                               m_view.picture().camera(), m_isLeft);
  if (!hand)
    return emit statusMessage(
        ear == scene::Side::Left
            ? tr("From here the hand would come from behind the picture: look at the left ear "
                 "first, as in Surgical position (8)")
            : tr("From here the hand would come from behind the picture: look at the right ear "
                 "first, as in Surgical position (9)"));
  setHandpiece(hand);
  if (!m_model.drilling())
    m_view.tool().PointAgain(); // the view may have turned since the pointer moved
  emit statusMessage((ear == scene::Side::Left
                          ? tr("Handpiece for the left ear: %1° from the line of sight, at %2° on "
                               "the screen")
                          : tr("Handpiece for the right ear: %1° from the line of sight, at %2° on "
                               "the screen"))
                         .arg(numberText(m_tilt, 0), numberText(m_turn, 0)));
}

std::optional<scene::ViewState::Handpiece> DrillController::handpiece() const
{
  const scene::ViewState::Handpiece now{m_turn, m_tilt, m_isLeft};
  if (now == presenters::usualHandpiece(m_isLeft))
    return std::nullopt;
  return now;
}

void DrillController::setHandpiece(const std::optional<scene::ViewState::Handpiece>& hand)
{
  const scene::ViewState::Handpiece held = hand.value_or(presenters::usualHandpiece(m_isLeft));
  m_turn = held.isLeft == m_isLeft ? held.turn : inOtherHand(held.turn);
  m_tilt = std::clamp(held.tilt, 0.0, interaction::AimSettings::kMaxTilt);
  applyBar();
}

// From the other side of the screen.
void DrillController::setLeftHand(bool isLeft)
{
  if (isLeft == m_isLeft)
    return;
  m_isLeft = isLeft;
  m_turn = inOtherHand(m_turn);
  applyBar();
}

void DrillController::setBurrAlone(bool alone)
{
  if (alone == m_isBurrAlone)
    return;
  m_isBurrAlone = alone;
  if (m_tool == Tool::Burr)
    renewTool();
}

void DrillController::setInstrument(const QString& file, const QString& axis)
{
  m_instrumentFile = file;
  m_instrumentAxis = axis;
}

void DrillController::chooseInstrument()
{
  QFileDialog dialog(m_view.window(), tr("Instrument from a file"));
  dialog.setObjectName("openInstrument");
  dialog.setFileMode(QFileDialog::ExistingFile);
  dialog.setNameFilters({tr("Surfaces (%1)").arg(patternsOf(imaging::kMesh)), tr("All files (*)")});
  const QString last = m_instrumentFile.isEmpty() ? m_fileRead : m_instrumentFile;
  if (!last.isEmpty())
    dialog.setDirectory(QFileInfo(last).absolutePath());
  if (const QString file = chosenFile(dialog); !file.isEmpty())
    readSurface(file);
}

void DrillController::readSurface(const QString& file)
{
  emit statusMessage(tr("Reading the instrument…"));
  m_fileRead = file;
  m_reading.replace(
      [this, file](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto read = std::make_shared<presenters::InstrumentSurface>(
            presenters::readInstrumentSurface(pathOf(file), progress));
        return [this, file, read] { askAxis(file, std::move(*read)); };
      });
}

// The axis that it had, if it is the same file, else the likely one.
void DrillController::askAxis(const QString& file, presenters::InstrumentSurface surface)
{
  emit statusMessage({});
  const QString proposed = file == m_instrumentFile && !m_instrumentAxis.isEmpty()
                               ? m_instrumentAxis
                               : words(presenters::likelyAxis(surface.mesh));
  QStringList ways;
  int row = 0;
  for (const char* axis : presenters::kInstrumentAxes)
  {
    const auto lies = presenters::placementOf(surface.mesh, axis);
    if (proposed == axis)
      row = ways.size();
    ways +=
        tr("%1: %2 × %3 mm, the tip at %4 = %5 mm")
            .arg(QString(QLatin1String(axis)), numberText(lies.length, 1),
                 numberText(lies.width, 1), QString(QLatin1Char(axis[0])), numberText(lies.tip, 1));
  }
  bool isChosen = false;
  const QString way = QInputDialog::getItem(
      m_view.window(), tr("Instrument from a file"),
      tr("From its tip to the hand the instrument lies along this axis of its file\n(length × "
         "width, and where its tip is then):"),
      ways, row, false, &isChosen);
  const int chosen = ways.indexOf(way);
  if (isChosen && chosen >= 0)
    makeInstrument(file, presenters::kInstrumentAxes[static_cast<std::size_t>(chosen)],
                   std::move(surface));
}

void DrillController::makeInstrument(const QString& file, const QString& axis,
                                     presenters::InstrumentSurface surface)
{
  emit statusMessage(tr("Reading the instrument…"));
  m_fileRead = file;
  const auto taken = std::make_shared<presenters::InstrumentSurface>(std::move(surface));
  m_reading.replace(
      [this, file, axis, taken](const core::Progress& progress)
      {
        const auto kept =
            presenters::keptInstrument(*taken, bytes(axis)); // before it is moved from
        return made(file, kept, std::move(*taken), progress);
      });
}

void DrillController::readInstrument(const QString& file, const QString& axis)
{
  emit statusMessage(tr("Reading the instrument…"));
  m_fileRead = file;
  m_reading.replace(
      [this, file, axis](const core::Progress& progress)
      {
        presenters::InstrumentSurface surface =
            presenters::readInstrumentSurface(pathOf(file), progress.part(0.0, 0.5));
        const auto kept = presenters::keptInstrument(surface, bytes(axis));
        return made(file, kept, std::move(surface), progress.part(0.5, 1.0));
      });
}

void DrillController::setCaseInstrument(
    const std::optional<scene::ViewState::Instrument>& instrument)
{
  const bool isLoaded = m_loaded && instrument && *m_loaded == *instrument;
  keep(instrument);
  if (isLoaded || (!instrument && !m_isLoadedFromCase))
    return;
  m_instrument.reset(); // it is read when it is taken up
  m_measured.reset();
  m_loaded.reset();
}

void DrillController::keep(const std::optional<scene::ViewState::Instrument>& instrument)
{
  m_ofCase = instrument;
  emit caseInstrumentChanged();
}

void DrillController::takeOutInstrument()
{
  if (!m_model.hasCase())
    return;
  if (m_tool == Tool::Instrument)
    releaseTool();
  abandonReading();
  scene::ViewState view = m_model.value().view;
  const auto& kept = m_ofCase ? m_ofCase : view.instrument;
  const QString name = kept ? words(kept->name) : QString();
  view.instrument.reset();
  m_model.setView(view);
  setCaseInstrument(std::nullopt);
  emit statusMessage((name.isEmpty()
                          ? tr("The case keeps no instrument from the next save on")
                          : tr("The case does not keep %1 from the next save on").arg(name)) +
                     ". " + tr("Drill > Instrument takes it up again while its file is there"));
}

void DrillController::readCaseInstrument()
{
  emit statusMessage(tr("Reading the instrument…"));
  m_fileRead.clear();
  m_reading.replace(
      [this, kept = *m_ofCase, unnamed = bytes(tr("instrument"))](const core::Progress& progress)
      { return made({}, kept, presenters::surfaceOf(kept, unnamed), progress); });
}

BackgroundWork::Reply DrillController::made(const QString& file,
                                            const scene::ViewState::Instrument& kept,
                                            presenters::InstrumentSurface surface,
                                            const core::Progress& progress)
{
  const auto instrument = std::make_shared<presenters::LoadedInstrument>(
      presenters::makeInstrument(std::move(surface), kept.axis, progress));
  const auto measured =
      std::make_shared<const presenters::MeasuredTool>(*instrument->instrument->shell);
  return [this, file, kept, instrument, measured]
  { instrumentCame(file, kept, std::move(*instrument), measured); };
}

void DrillController::instrumentCame(const QString& file, const scene::ViewState::Instrument& kept,
                                     presenters::LoadedInstrument instrument,
                                     std::shared_ptr<const presenters::MeasuredTool> measured)
{
  m_instrument = std::move(instrument.instrument);
  m_measured = std::move(measured);
  m_loaded = kept;
  keep(kept);
  m_isLoadedFromCase = file.isEmpty();
  if (!file.isEmpty())
  {
    setInstrument(file, words(kept.axis));
    emit instrumentRead(file, words(kept.axis));
  }
  const bool isTaken = !m_model.drilling(); // an open stroke goes on
  if (isTaken && m_tool == Tool::Instrument)
  {
    renewTool();
    showTool();
  }
  else if (isTaken)
    setTool(Tool::Instrument);
  QStringList lines{phrase(presenters::toString(*m_instrument))};
  for (const std::string& note : instrument.notes)
    lines += windowText(phrase(note));
  if (!isTaken)
    lines += tr("Drill > Instrument takes it up when the stroke is done");
  emit statusMessage(lines.join(". "));
}

// In the bar and the menu.
void DrillController::showTool()
{
  m_bar.drillAction()->setChecked(m_tool == Tool::Burr);
  m_bar.pointerAction()->setChecked(m_tool == Tool::Pointer);
  m_bar.instrumentAction()->setChecked(m_tool == Tool::Instrument);
  const QString instrument = m_tool == Tool::Instrument ? words(m_instrument->name) : QString();
  m_bar.setInstrument(instrument);
  emit toolChanged(instrument);
}

bool DrillController::releaseTool()
{
  const bool had = m_tool != Tool::None;
  setTool(Tool::None);
  return had;
}

// Another tool or case came meanwhile: an instrument that is still being read is not wanted there.
void DrillController::abandonReading()
{
  if (!m_reading.busy())
    return;
  m_reading.abandon();
  emit statusMessage({});
}

void DrillController::setTool(Tool tool)
{
  abandonReading();
  if (tool == m_tool)
    return;
  if (tool == Tool::Instrument && !m_instrument)
  {
    m_bar.instrumentAction()->setChecked(false); // until it is read
    if (m_ofCase)
      return readCaseInstrument();
    return m_instrumentFile.isEmpty() ? chooseInstrument()
                                      : readInstrument(m_instrumentFile, m_instrumentAxis);
  }
  if (tool == Tool::Instrument)
    keep(m_loaded);
  m_view.tool().DrillModeOff(); // stops the drill first
  m_view.tool().ProbeModeOff();
  putAway();
  if (m_tool == Tool::None)
    m_driver.beginThere();
  m_tool = tool;
  m_view.tool().SetDrillMode(tool == Tool::Burr || tool == Tool::Instrument); // it is pressed
  m_view.tool().SetProbeMode(tool == Tool::Pointer);
  showTool();
  applyBar();
  if (tool != Tool::None && m_model.hasCase() && !m_model.ready())
    emit tissueWanted();
  if (tool == Tool::None)
    dropHint();
  takeAtPointer();
}

// At the mouse pointer's position, without waiting for its next move.
void DrillController::takeAtPointer()
{
  if (!takeTool())
    return;
  m_view.tool().PointAgain();
  if (m_driver.awaitsPointer() && !m_view.underMouse())
  {
    m_hints = true;
    emit statusMessage(tr("Point at the patient in the 3D view: there the tool comes"));
  }
}

// The tool has come, or is put away.
void DrillController::dropHint()
{
  if (std::exchange(m_hints, false))
    emit statusMessage({});
}

void DrillController::deviceCame()
{
  m_driver.beginThere();
  m_view.tool().SetPointerHand(!m_devices.device());
  m_bar.setPresses(!m_devices.device(),
                   !m_devices.device() || !m_devices.device()->description().givesForce);
  applyBar();
  if (m_devices.device())
    takeTool();
}

// Another burr, scale or limit. A tool in use is taken up again by the timer, where it was, or
// before by the mouse pointer's next move.
void DrillController::restartTool()
{
  const bool isInUse = m_devices.device() || m_model.touching() || m_anew.isActive();
  putAway();
  applyBar();
  if (isInUse)
    m_anew.start();
  prepareAhead();
}

void DrillController::renewTool()
{
  restartTool();
  if (!m_devices.device())
    takeAtPointer();
}

void DrillController::tissueCame()
{
  if (m_tool != Tool::None)
    m_devices.device() ? void(takeTool()) : takeAtPointer();
  prepareAhead();
}

// So that the tool is there at once when it is wanted.
void DrillController::prepareAhead()
{
  if (m_model.hasCase() && m_model.ready() && !m_model.toolReady(toolChosen()))
    prepareTool(toolChosen());
}

void DrillController::bringHere()
{
  if (!m_devices.device() || m_tool == Tool::None)
    return;
  putAway();
  m_driver.beginHere();
  takeTool();
}

session::TouchTool DrillController::toolChosen() const
{
  session::TouchTool tool;
  tool.burr = m_bar.burr();
  if (m_isBurrAlone)
    tool.mode = session::TouchTool::Mode::ThreeDof;
  if (m_tool == Tool::Instrument)
    tool.instrument = m_instrument;
  if (m_tool == Tool::Pointer)
  {
    tool.burr.diameter = 2.0 * kPointerRadius;
    tool.mode = session::TouchTool::Mode::ThreeDof; // its shaft must not collide
  }
  return tool;
}

void DrillController::prepareTool(const session::TouchTool& tool)
{
  if (m_tool != Tool::None)
    emit statusMessage(m_tool == Tool::Burr      ? tr("Taking up the burr…")
                       : m_tool == Tool::Pointer ? tr("Taking up the pointer…")
                                                 : tr("Taking up the instrument…"));
  if (m_preparation.busy()) // the tool chosen by then is looked at when it ends
    return;
  m_preparation.start(
      [this, make = m_model.toolPreparation(tool)](
          const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto done = std::make_shared<presenters::PreparedTool>(make(progress));
        return [this, done]
        {
          m_model.toolPrepared(std::move(*done));
          tissueCame();
        };
      });
}

bool DrillController::takeTool()
{
  if (m_model.touching())
    return true;
  if (m_tool == Tool::None || !m_model.hasCase() || m_devices.opening())
    return false;
  if (!m_model.ready())
  {
    emit statusMessage(tr("The case is still being prepared; then the tool can be taken up"));
    return false;
  }
  putAway(); // a session ended by a change of the tissue
  if (const session::TouchTool tool = toolChosen(); !m_model.toolReady(tool))
  {
    prepareTool(tool);
    return false;
  }
  QString why;
  try
  {
    session::TouchSession::Setup setup;
    setup.tool = toolChosen();
    setup.cuts = m_tool == Tool::Burr;
    if (setup.cuts)
      setup.heard = m_sound.listener();
    haptics::Device& device = m_driver.prepare(setup);
    m_model.startTouch(device, setup);
    m_model.touch()->setCamera(m_view.picture().camera()); // a held button drills at once
  }
  catch (const core::Error& error)
  {
    why = toString(error);
  }
  catch (const std::exception&) // out of memory, no thread
  {
    why = tr("The tool cannot be taken up: the computer has no room for it. Close other programs.");
  }
  if (!why.isEmpty())
  {
    releaseTool();
    emit statusMessage(why);
    return false;
  }
  emit statusMessage(
      m_driver.byMouse()
          ? QString()
          : tr("%1 leads the tool").arg(words(m_devices.device()->description().name)));
  m_driver.send();
  m_sinceTaken.start();
  m_frames.start();
  return true;
}

void DrillController::putAway()
{
  m_anew.stop();
  m_frames.stop();
  const auto news = m_model.stopTouch();
  m_view.display().endTouch();
  m_sound.toolGone();
  emit toolGone();
  if (!m_fault.isEmpty())
    emit faulted({});
  m_fault.clear();
  m_sinceGone.invalidate();
  m_sinceFault.invalidate();
  m_stall.forget();
  m_tip.reset();
  m_driver.letGo();
  for (const auto& stroke : news.strokes)
    emit strokeEnded(stroke);
}

// What is drawn there: with a tool in the hand all of the tissue.
std::optional<Eigen::Vector3d> DrillController::surfaceAt(const interaction::PickRay& line)
{
  if (m_tool == Tool::None)
    return m_model.surfaceAt(line);
  const auto hit = m_model.tissueAlong(line);
  return hit ? std::optional<Eigen::Vector3d>(line.at(*hit)) : std::nullopt;
}

void DrillController::hover(const interaction::PickRay& line)
{
  dropHint();
  const bool reads = m_tool == Tool::Pointer && m_devices.device();
  if (const auto hit = surfaceAt(line); hit && !reads)
    emit pointed(*hit);
  else if (!reads)
    emit pointedNowhere();
  if (m_tool != Tool::None)
    takeTool(); // it follows the pointer
}

void DrillController::press()
{
  if (takeTool())
    m_model.touch()->setCamera(m_view.picture().camera());
}

void DrillController::frame()
{
  if (!m_model.touching()) // session ended: the pointer's next move takes the tool up
    return restartTool();
  hear(m_model.advanceTouch());
}

void DrillController::hear(const session::TouchSession::News& news)
{
  if (news.record)
    show(news);
  for (const auto& stroke : news.strokes)
    emit strokeEnded(stroke); // may ask the user, and much may happen meanwhile
  if (!news.journalFault.empty())
    emit statusMessage(
        tr("What is drilled is not on the disk yet: %1").arg(phrase(news.journalFault)));
  if (!news.failure.empty())
  {
    releaseTool();
    emit statusMessage(phrase(news.failure));
  }
  if (news.record && m_model.touching() && isLost(*news.record))
    m_devices.giveUp(whyLost());
}

void DrillController::show(const session::TouchSession::News& news)
{
  const TickRecord& record = *news.record;
  if (!m_model.drilling()) // for a stroke that may begin
    m_model.touch()->setCamera(m_view.picture().camera());
  m_driver.see(record);
  m_view.display().setTouch(record, toolForm());
  if (m_tool == Tool::Burr)
    m_sound.show(record, toolRadius());
  if (m_tool == Tool::Pointer && isPlaced(record))
    read(record);
  showFault(news);
  const haptics::Pose pose = record.proxy.pose();
  if (m_tool == Tool::Burr && isPlaced(record))
    emit toolMoved(presenters::MeasuredTool(toolRadius()), pose);
  if (m_tool == Tool::Instrument && isPlaced(record))
  {
    emit toolMoved(*m_measured, pose);
    if (!m_tip || (*m_tip - pose.position).norm() >= kStill)
      follow(pose.position);
  }
  if (!m_model.drilling())
    return;
  follow(pose.position);
}

void DrillController::follow(const Eigen::Vector3d& tip)
{
  m_tip = tip;
  emit pointed(tip);
  if (m_slicesFollow)
    m_model.setCrosshair(tip);
}

void DrillController::read(const TickRecord& record)
{
  const haptics::Pose tool = record.proxy.pose();
  const Eigen::Vector3d tip =
      tool.position - kPointerRadius * (tool.rotation * Eigen::Vector3d::UnitZ());
  const bool still = m_tip && (*m_tip - tip).norm() < kStill;
  if (still && m_sinceRead.elapsed() < kReadAgain)
    return;
  m_sinceRead.start();
  m_view.display().setReading(
      textOf(m_model.readPlace(still ? *m_tip : tip), presenters::displayOf(m_model.value())));
  if (!still)
    follow(tip);
}

bool DrillController::isLost(const TickRecord& record)
{
  const auto verdict = static_cast<DeviceVerdict>(record.verdict);
  const bool gone = !m_driver.byMouse() &&
                    static_cast<ServoFault>(record.fault) == ServoFault::Device &&
                    (verdict == DeviceVerdict::Disconnected || verdict == DeviceVerdict::Faulty ||
                     verdict == DeviceVerdict::NotReady);
  if (!gone)
    m_sinceGone.invalidate();
  else if (!m_sinceGone.isValid())
    m_sinceGone.start();
  return gone && m_sinceGone.elapsed() > kGone;
}

QString DrillController::whyLost() const
{
  const presenters::ActiveDevice& device = *m_devices.device();
  const QString name = words(device.input().name);
  if (device.input().kind == presenters::InputDevice::Kind::SpaceMouse)
    return tr("%1 was unplugged").arg(name);
  const QString why = phrase(device.problem());
  return why.isEmpty() ? tr("%1 gives no place any more").arg(name) : why;
}

void DrillController::showFault(const session::TouchSession::News& news)
{
  const TickRecord& record = *news.record;
  m_stall.see(record);
  QString fault = whyStalled(record);
  // A device just taken up has no reading for some ticks, and the mouse none before it moves and
  // while a picture takes long (PointerDevice); not a fault.
  const auto verdict = static_cast<DeviceVerdict>(record.verdict);
  const bool waits = m_driver.byMouse() &&
                     static_cast<ServoFault>(record.fault) == ServoFault::Device &&
                     (verdict == DeviceVerdict::NotReady || verdict == DeviceVerdict::Stale ||
                      verdict == DeviceVerdict::Settling);
  if (!news.fault.empty() && !waits && m_sinceTaken.elapsed() > kStart)
  {
    fault = phrase(news.fault);
    m_sinceFault.start();
  }
  else if (fault.isEmpty() && m_sinceFault.isValid() && m_sinceFault.elapsed() <= kFaultShown)
    fault = m_fault;
  if (fault != m_fault)
    emit faulted(m_fault = fault);
}

// Why a burr that should drill removes nothing, as long as that lasts; empty if it does.
QString DrillController::whyStalled(const TickRecord& record) const
{
  if (m_tool != Tool::Burr)
    return {};
  if (m_driver.lifted())
    return tr("The burr has lifted: what lies under the pointer is another surface, far deeper or "
              "higher. Let go and press again to drill there.");
  if (const std::uint8_t held = m_stall.heldBy())
    return held == TickRecord::kShaft ? tr("The shaft lies on tissue and holds the burr off")
           : held == TickRecord::kHandpiece
               ? tr("The handpiece lies on tissue and holds the burr off")
               : tr("Shaft and handpiece lie on tissue and hold the burr off");
  if (m_stall.cannotArrive())
    return record.held != 0
               ? tr("Shaft or handpiece keep the burr from where you press: turn the handpiece, or "
                    "press where the burr rests")
               : tr("Tissue keeps the burr from where you press: press where the burr rests");
  if (!m_stall.stalls())
    return {};
  const Eigen::Vector3d force(record.burrForce[0], record.burrForce[1], record.burrForce[2]);
  if (force.norm() > 0.0)
  {
    const std::string name = m_model.structureAt(record.proxy.pose().position -
                                                 (toolRadius() + kBeyond) * force.normalized());
    const scene::Case& value = m_model.value();
    const auto* structure = scene::findStructure(value, name);
    const bool spared = structure
                            ? !structure->look.drillable
                            : std::any_of(value.meshes.begin(), value.meshes.end(),
                                          [&name](const scene::MeshPart& mesh)
                                          { return mesh.name == name && !mesh.look.drillable; });
    if (spared)
      return tr("The burr lies on %1, which is set not to be drilled").arg(shownName(name));
  }
  return tr("The burr is pressed and makes no way: what holds it is not taken at this thrust and "
            "speed");
}

} // namespace petrous::workstation
