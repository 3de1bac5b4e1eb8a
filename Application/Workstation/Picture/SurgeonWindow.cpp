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

// Input here acts on the main view's tool and camera.
void SurgeonWindow::addView()
{
  m_view = new ThreeDView(this);
  m_view->setObjectName("surgeonView");
  m_view->tool().SetLeader(&m_main.tool());
  connect(m_view, &ThreeDView::cameraMoved, &m_main, &ThreeDView::setCamera);
  m_view->setStamp(m_main.stamp());
  connect(&m_main, &ThreeDView::stampChanged, m_view, &ThreeDView::setStamp);
  m_view->setNotes(m_main.notes());
  connect(&m_main, &ThreeDView::notesChanged, m_view, &ThreeDView::setNotes);
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

void SurgeonWindow::setBlocked(bool blocked)
{
  if (m_view && blocked)
    m_view->tool().Release();
  setEnabled(!blocked); // its keys, too
  if (m_view && !blocked)
    m_view->setFocus();
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
    m_view->tool().Release(); // ends an open stroke
  m_main.display().setFollower(nullptr);
  event->accept();
  emit closed();
}

} // namespace petrous::workstation
