#include "ThreeDView.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <QApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QRegion>
#include <QStyle>

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include "Application.h"
#include "petrous/Interaction/CameraStyle.h"
#include "petrous/Interaction/OrbitCamera.h"
#include "petrous/Interaction/RendererPickRay.h"
#include "petrous/Presenters/Background.h"

namespace petrous::workstation
{

namespace
{
constexpr int kLetterMargin = 10; // px
constexpr int kFrame = 2;         // px, of what has the keyboard focus

// To another window or a menu, and back: what had the focus has it again.
bool isPassing(Qt::FocusReason reason)
{
  return reason == Qt::ActiveWindowFocusReason || reason == Qt::PopupFocusReason ||
         reason == Qt::MenuBarFocusReason;
}

constexpr double kFine = 0.2; // of a notch of the wheel, with Shift
constexpr double kDegreesPerNotch = 5.0;
} // namespace

ThreeDView::ThreeDView(QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , m_display(std::make_unique<SceneDisplay>(*m_window, [this] { return isVisible(); }))
{
  setObjectName("threeDView");
  setAccessibleName(tr("3D view"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(240, 240);
  setRenderWindow(m_window);
  connect(m_display.get(), &SceneDisplay::aboutToDraw, this, &ThreeDView::placeLetters);

  for (QLabel*& letter : m_letters)
  {
    letter = new QLabel(this);
    letter->setObjectName("direction");
    letter->setAttribute(Qt::WA_TransparentForMouseEvents);
  }
  m_stamp = new QLabel(this);
  m_stamp->setObjectName("caseStamp");
  m_stamp->setTextFormat(Qt::PlainText);
  m_stamp->setAttribute(Qt::WA_TransparentForMouseEvents);
  m_notes = new QLabel(this);
  m_notes->setObjectName("guessed");
  m_notes->setTextFormat(Qt::PlainText);
  m_notes->setAttribute(Qt::WA_TransparentForMouseEvents);
  m_notes->hide();
  m_focusFrame = new QWidget(this);
  m_focusFrame->setObjectName("focusFrame");
  m_focusFrame->setAttribute(Qt::WA_StyledBackground);
  m_focusFrame->setAttribute(Qt::WA_TransparentForMouseEvents);
  m_focusFrame->hide();
  observe();
}

void ThreeDView::observe()
{
  vtkRenderer* renderer = picture().renderer();
  m_style->SetDefaultRenderer(renderer); // in stereo the window has another one
  m_style->AddObserver(vtkCommand::InteractionEvent, this, &ThreeDView::handleCamera);
  m_window->GetInteractor()->SetInteractorStyle(m_style);

  m_tool->SetDefaultRenderer(renderer);
  m_tool->SetInteractor(m_window->GetInteractor());
  m_tool->SetStereo(m_display->stereoPicture());
  m_tool->ShortcutsOff(); // the window's own actions and boxes
  m_tool->SetFreezeKey("x");
  m_tool->EnabledOn();
  for (const unsigned long event :
       {vtkCommand::HoverEvent, vtkCommand::LeaveEvent, vtkCommand::PickEvent,
        vtkCommand::StartInteractionEvent, vtkCommand::ModifiedEvent})
    m_tool->AddObserver(event, this, &ThreeDView::handleTool);
}

ThreeDView::~ThreeDView()
{
  m_tool->RemoveAllObservers(); // the window around is going down
  m_tool->SetInteractor(nullptr);
  m_window->GetInteractor()->SetInteractorStyle(nullptr);
  makeCurrent();
  m_display->release();
  doneCurrent();
}

// The display renders, soon. VTK renders if nobody aborts the event.
bool ThreeDView::handleCamera(vtkObject*, unsigned long, void*)
{
  setCamera(picture().camera());
  return true;
}

void ThreeDView::handleTool(vtkObject*, unsigned long event, void*)
{
  // VTK's frames are no place for exceptions.
  guarded(
      [this, event]
      {
        switch (event)
        {
        case vtkCommand::HoverEvent:
          return emit pointed(m_tool->GetPickRay());
        case vtkCommand::LeaveEvent:
          return emit pointerLeft();
        case vtkCommand::PickEvent:
          return emit enlargeAsked();
        case vtkCommand::StartInteractionEvent:
          return emit drillPressed();
        default:
          return emit toolModeSet();
        }
      });
}

void ThreeDView::setStamp(const QString& text)
{
  if (text == m_stampText)
    return;
  m_stampText = text;
  placeLetters();
  emit stampChanged(text);
}

void ThreeDView::setNotes(const QStringList& lines)
{
  m_notes->setText(lines.join('\n'));
  m_notes->adjustSize();
  m_notes->setVisible(!lines.isEmpty());
  placeNotes();
  if (lines == m_noteLines)
    return;
  m_noteLines = lines;
  emit notesChanged(lines);
}

void ThreeDView::setCovered(int pixels)
{
  m_display->setCovered(double(pixels) / std::max(height(), 1));
  if (pixels == std::exchange(m_covered, pixels))
    return;
  placeLetters();
}

// Below the letter at the top where there is no room beside it. What it ends with counts most.
void ThreeDView::placeStamp()
{
  m_stamp->setText(m_stamp->fontMetrics().elidedText(m_stampText, Qt::ElideLeft,
                                                     std::max(width() - 4 * kLetterMargin, 0)));
  m_stamp->adjustSize();
  const QLabel& top = *m_letters[2];
  const int left = width() - kLetterMargin - m_stamp->width();
  const bool isBeside = left > top.geometry().right();
  m_stamp->move(left,
                isBeside ? m_covered + kLetterMargin : top.geometry().bottom() + kLetterMargin / 2);
}

// Below letter and stamp where there is no room beside them.
void ThreeDView::placeNotes()
{
  int top = m_covered + kLetterMargin;
  const QLabel* const others[] = {m_letters[2], m_stamp};
  for (const QLabel* other : others)
    if (!other->isHidden() && QRect({kLetterMargin, top}, m_notes->size())
                                  .adjusted(0, 0, kLetterMargin / 2, 0)
                                  .intersects(other->geometry()))
      top = other->geometry().bottom() + kLetterMargin / 2;
  m_notes->move(kLetterMargin, top);
}

void ThreeDView::placeFocusFrame()
{
  m_focusFrame->setGeometry(rect());
  m_focusFrame->setMask(QRegion(rect()) - rect().adjusted(kFrame, kFrame, -kFrame, -kFrame));
}

void ThreeDView::showFocusFrame()
{
  m_focusFrame->setVisible(m_isFocused && m_cameByTab &&
                           m_display->stereo() == rendering::StereoMode::None);
}

// Letters and their plates are those of the theme on a dark one.
void ThreeDView::followBackground()
{
  const bool isOnLight =
      presenters::backdropOf(m_display->background()) == presenters::Backdrop::Light;
  if (isOnLight == std::exchange(m_isOnLight, isOnLight))
    return;
  std::vector<QLabel*> labels(m_letters.begin(), m_letters.end());
  labels.insert(labels.end(), {m_stamp, m_notes});
  for (QLabel* label : labels)
  {
    label->setProperty("onLight", isOnLight);
    label->style()->unpolish(label);
    label->style()->polish(label);
  }
}

void ThreeDView::placeLetters()
{
  followBackground();
  showFocusFrame();
  // In stereo they would float in front of or behind the patient.
  const bool mono = m_display->stereo() == rendering::StereoMode::None;
  for (QLabel* letter : m_letters)
    letter->setVisible(mono);
  m_stamp->setVisible(mono && !m_stampText.isEmpty());
  m_display->setFirstRow(mapToGlobal(QPoint(0, 0)).y());
  if (!mono)
    return placeNotes();
  const auto edges = interaction::edgeDirections(picture().camera());
  const std::string* const texts[] = {&edges.left, &edges.right, &edges.top, &edges.bottom};
  for (std::size_t n = 0; n < m_letters.size(); ++n)
  {
    m_letters[n]->setText(QString::fromStdString(*texts[n]));
    m_letters[n]->adjustSize();
  }
  const auto middle = [](int whole, int part) { return (whole - part) / 2; };
  const auto put = [this](std::size_t n, int x, int y) { m_letters[n]->move(x, y); };
  const int across = width();
  const int down = height();
  put(0, kLetterMargin, middle(down, m_letters[0]->height()));
  put(1, across - kLetterMargin - m_letters[1]->width(), middle(down, m_letters[1]->height()));
  put(2, middle(across, m_letters[2]->width()), m_covered + kLetterMargin);
  put(3, middle(across, m_letters[3]->width()), down - kLetterMargin - m_letters[3]->height());
  placeStamp();
  placeNotes();
}

void ThreeDView::resizeEvent(QResizeEvent* event)
{
  QVTKOpenGLNativeWidget::resizeEvent(event);
  placeLetters();
  placeFocusFrame();
}

void ThreeDView::setCamera(const core::CameraPose& pose)
{
  m_display->setCamera(pose);
  emit cameraMoved(pose);
}

// As VTK counts, from the lower left; of the device's pixels.
std::array<int, 2> ThreeDView::pixelAt(const QPointF& position) const
{
  const QPointF at = position * effectiveDevicePixelRatio();
  return {static_cast<int>(std::floor(at.x())),
          m_window->GetSize()[1] - 1 - static_cast<int>(std::floor(at.y()))};
}

interaction::PickRay ThreeDView::sightLine(const std::optional<QPointF>& position) const
{
  vtkRenderer& renderer = *m_display->picture().renderer();
  if (!position)
    return interaction::centralRay(renderer);
  const auto [x, y] = pixelAt(*position);
  return interaction::pickRayThrough(renderer, x, y, m_display->stereoPicture());
}

// QVTKInteractorAdapter rounds towards zero, so that the row beyond the edge is in the view; makes
// one notch of a wheel event of many, and none of a fraction; and takes a key's repeats for
// releases.
bool ThreeDView::event(QEvent* event)
{
  if (!isEnabled()) // Qt leaves it to the widget
    switch (event->type())
    {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseMove:
    case QEvent::Wheel:
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::Enter:
      return QOpenGLWidget::event(event);
    default:
      break;
    }
  switch (event->type())
  {
  case QEvent::MouseButtonPress:
  case QEvent::MouseButtonDblClick:
  case QEvent::MouseButtonRelease:
  case QEvent::MouseMove:
    sendMouse(*static_cast<QMouseEvent*>(event));
    followClick(*static_cast<QMouseEvent*>(event));
    event->accept();
    return true;
  case QEvent::Wheel:
    sendWheel(*static_cast<QWheelEvent*>(event));
    event->accept();
    return true;
  case QEvent::TouchBegin: // follow as the mouse's
  case QEvent::TouchUpdate:
  case QEvent::TouchEnd:
    return QOpenGLWidget::event(event);
  case QEvent::KeyPress:
  case QEvent::KeyRelease:
    if (const auto* key = static_cast<QKeyEvent*>(event); key->isAutoRepeat())
    {
      if (event->type() == QEvent::KeyRelease)
        return true;
      QKeyEvent repeated(key->type(), key->key(), key->modifiers(), key->text(), true, 2);
      return QVTKOpenGLNativeWidget::event(&repeated);
    }
    break;
  case QEvent::Enter: // a dialog closed over the pointer, say: its place counts before it moves
  {
    const bool taken = QVTKOpenGLNativeWidget::event(event);
    const QPointF at = static_cast<QEnterEvent*>(event)->localPos();
    sendMouse(QMouseEvent(QEvent::MouseMove, at, Qt::NoButton, QApplication::mouseButtons(),
                          QApplication::keyboardModifiers()));
    return taken;
  }
  case QEvent::FocusIn:
  {
    const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
    if (!isPassing(reason))
      m_cameByTab = reason == Qt::TabFocusReason || reason == Qt::BacktabFocusReason;
    m_isFocused = true;
    showFocusFrame();
    break;
  }
  case QEvent::FocusOut: // a release event sent to another window would leave the drill on
    m_isFocused = false;
    if (!isPassing(static_cast<QFocusEvent*>(event)->reason()))
      m_cameByTab = false;
    showFocusFrame();
    m_tool->Release();
    m_style->OnLeftButtonUp();
    m_style->OnMiddleButtonUp();
    m_style->OnRightButtonUp();
    break;
  default:
    break;
  }
  return QVTKOpenGLNativeWidget::event(event);
}

void ThreeDView::sendMouse(const QMouseEvent& event)
{
  const auto [x, y] = pixelAt(event.localPos());
  const bool twice = event.type() == QEvent::MouseButtonDblClick;
  vtkRenderWindowInteractor* interactor = m_window->GetInteractor();
  interactor->SetEventInformation(x, y, event.modifiers() & Qt::ControlModifier ? 1 : 0,
                                  event.modifiers() & Qt::ShiftModifier ? 1 : 0, 0, twice ? 1 : 0);
  interactor->SetAltKey(event.modifiers() & Qt::AltModifier ? 1 : 0);
  if (event.type() == QEvent::MouseMove)
  {
    interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
    return;
  }
  const bool up = event.type() == QEvent::MouseButtonRelease;
  if (event.button() == Qt::LeftButton)
    interactor->InvokeEvent(up      ? vtkCommand::LeftButtonReleaseEvent
                            : twice ? vtkCommand::LeftButtonDoubleClickEvent
                                    : vtkCommand::LeftButtonPressEvent);
  else if (event.button() == Qt::MiddleButton)
    interactor->InvokeEvent(up ? vtkCommand::MiddleButtonReleaseEvent
                               : vtkCommand::MiddleButtonPressEvent);
  else if (event.button() == Qt::RightButton)
    interactor->InvokeEvent(up ? vtkCommand::RightButtonReleaseEvent
                               : vtkCommand::RightButtonPressEvent);
}

// A click is a press of the left button alone that turns nothing and drills nothing.
void ThreeDView::followClick(const QMouseEvent& event)
{
  if (event.type() == QEvent::MouseButtonPress)
  {
    const bool isPlain = event.buttons() == Qt::LeftButton && event.modifiers() == Qt::NoModifier;
    m_clicked = isPlain && !m_tool->GetDrillMode() ? std::optional(event.localPos()) : std::nullopt;
  }
  else if (event.type() == QEvent::MouseButtonDblClick)
    m_clicked.reset();
  else if (m_clicked && (event.localPos() - *m_clicked).manhattanLength() >
                            QApplication::startDragDistance() / 2)
    m_clicked.reset();
  else if (m_clicked && event.type() == QEvent::MouseButtonRelease)
  {
    m_clicked.reset();
    const interaction::PickRay ray = sightLine(event.localPos());
    guarded([this, ray] { emit picked(ray); });
  }
}

namespace
{

// Alt alone opens the menu bar when it is released. QMenuBar forgets that after a click or a motion
// of the mouse, but not after a turn of its wheel.
void altWasUsed()
{
  QObject nobody;
  QMouseEvent moved(QEvent::MouseMove, QPointF(), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&nobody, &moved);
}

} // namespace

void ThreeDView::sendWheel(const QWheelEvent& event)
{
  // With Shift, some systems report horizontal scrolling.
  const QPoint delta = event.angleDelta();
  const double notches = (delta.y() != 0 ? delta.y() : delta.x()) / 120.0;
  if (notches == 0.0)
    return;
  if (event.modifiers() & Qt::AltModifier && m_tool->GetPointerHand() &&
      (m_tool->GetDrillMode() || m_tool->GetProbeMode()))
  {
    const double degrees = kDegreesPerNotch * notches;
    altWasUsed();
    return event.modifiers() & Qt::ShiftModifier ? emit handpieceTurned(0.0, degrees)
                                                 : emit handpieceTurned(degrees, 0.0);
  }
  if (m_tool->GetDrilling() && m_wheelPresses && !(event.modifiers() & Qt::ControlModifier))
    return emit thrustTurned(event.modifiers() & Qt::ShiftModifier ? kFine * notches : notches);
  const auto [x, y] = pixelAt(event.position());
  vtkRenderWindowInteractor* interactor = m_window->GetInteractor();
  interactor->SetEventInformation(x, y, event.modifiers() & Qt::ControlModifier ? 1 : 0,
                                  event.modifiers() & Qt::ShiftModifier ? 1 : 0);
  m_style->SetMouseWheelMotionFactor(std::abs(notches));
  interactor->InvokeEvent(notches > 0.0 ? vtkCommand::MouseWheelForwardEvent
                                        : vtkCommand::MouseWheelBackwardEvent);
}

} // namespace petrous::workstation
