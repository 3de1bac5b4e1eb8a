#include "SurgeonWindow.h"

#include <QCloseEvent>
#include <QGuiApplication>
#include <QKeyEvent>
#include <QScreen>
#include <QVBoxLayout>

#include <QVTKOpenGLStereoWidget.h>
#include <QVTKOpenGLWindow.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include "ThreeDView.h"

namespace petrous::workstation
{

SurgeonWindow::SurgeonWindow(ThreeDView& main, bool quadBuffer)
  : m_main(main)
{
  setObjectName("surgeonWindow");
  setWindowTitle(tr("Surgeon's window — Petrous"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  quadBuffer ? addStereoView() : addView();
  layout->addWidget(quadBuffer ? static_cast<QWidget*>(m_stereoView) : m_view);
  main.display().setFollower(&display());
}

SurgeonWindow::~SurgeonWindow()
{
  if (!m_stereoDisplay)
    return;
  m_stereoView->embeddedOpenGLWindow()->makeCurrent();
  m_stereoDisplay->release();
  m_stereoView->embeddedOpenGLWindow()->doneCurrent();
}

// Input here is forwarded to the main view.
void SurgeonWindow::addView()
{
  m_view = new ThreeDView(this);
  m_view->setObjectName("surgeonView");
  connect(m_view, &ThreeDView::pointed, &m_main, &ThreeDView::pointed);
  connect(m_view, &ThreeDView::pointerLeft, &m_main, &ThreeDView::pointerLeft);
  connect(m_view, &ThreeDView::picked, &m_main, &ThreeDView::picked);
  connect(m_view, &ThreeDView::drillPressed, &m_main, &ThreeDView::drillPressed);
  connect(m_view, &ThreeDView::drillHeld, &m_main, &ThreeDView::drillHeld);
  connect(m_view, &ThreeDView::drillReleased, &m_main, &ThreeDView::drillReleased);
  connect(m_view, &ThreeDView::clutchHeld, &m_main, &ThreeDView::clutchHeld);
  connect(m_view, &ThreeDView::wheelLed, &m_main, &ThreeDView::wheelLed);
  connect(&m_main, &ThreeDView::wheelLeadsSet, m_view, &ThreeDView::setWheelLeads);
  m_view->setWheelLeads(m_main.wheelLeads());
  connect(m_view, &ThreeDView::cameraMoved, &m_main, &ThreeDView::setCamera);
  connect(&m_main, &ThreeDView::drillModeSet, m_view, &ThreeDView::setDrillMode);
  m_view->setDrillMode(m_main.drillMode());
  connect(&m_main, &ThreeDView::buttonDrillsSet, m_view, &ThreeDView::setButtonDrills);
  m_view->setButtonDrills(m_main.buttonDrills());
  connect(&m_main, &ThreeDView::pointingSet, m_view, &ThreeDView::setPointing);
  m_view->setPointing(m_main.pointing());
}

void SurgeonWindow::addStereoView()
{
  m_window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
  m_window->StereoCapableWindowOn();
  m_stereoView = new QVTKOpenGLStereoWidget(this);
  m_stereoView->setFormat(surfaceFormat(true));
  m_stereoView->setRenderWindow(m_window.Get());
  m_window->GetInteractor()->SetInteractorStyle(nullptr);
  m_stereoDisplay = std::make_unique<SceneDisplay>(*m_window, [this] { return isVisible(); });
}

SceneDisplay& SurgeonWindow::display() noexcept
{
  return m_view ? m_view->display() : *m_stereoDisplay;
}

void SurgeonWindow::showBeside(const QWidget& other)
{
  QScreen* screen = other.screen();
  for (QScreen* candidate : QGuiApplication::screens())
    if (candidate != other.screen())
    {
      screen = candidate;
      break;
    }
  setGeometry(screen->geometry());
  showFullScreen();
  if (m_view)
    m_view->setFocus();
}

void SurgeonWindow::keyPressEvent(QKeyEvent* event)
{
  if (event->key() == Qt::Key_Escape)
    close();
  else
    QWidget::keyPressEvent(event);
}

void SurgeonWindow::closeEvent(QCloseEvent* event)
{
  if (m_view)
    m_view->setDrillMode(false); // ends an open stroke
  m_main.display().setFollower(nullptr);
  event->accept();
  emit closed();
}

} // namespace petrous::workstation
