#include "petrous/Rendering/EglRenderWindow.h"

#include <vtkObjectFactory.h>
#include <vtk_glew.h>

#include "EglContext.h"
#include "petrous/Rendering/RenderingError.h"

vtkStandardNewMacro(vtkPetrousEGLRenderWindow);

vtkPetrousEGLRenderWindow::vtkPetrousEGLRenderWindow()
{
  this->SetMultiSamples(0);
  // There is no default frame buffer to blit to.
  this->SetFrameBlitModeToNoBlit();
  this->SetUseOffScreenBuffers(true);
  this->SetShowWindow(false);
  this->SetScreenSize(16384, 16384);
}

vtkPetrousEGLRenderWindow::~vtkPetrousEGLRenderWindow()
{
  this->Finalize();
}

void vtkPetrousEGLRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EGL context: " << (this->Context ? this->Context->handle() : nullptr) << "\n";
}

void vtkPetrousEGLRenderWindow::Initialize()
{
  if (this->Context)
    return;
  this->Context = std::make_unique<petrous::rendering::EglContext>();
  this->MakeCurrent();
  this->OpenGLInit();
  this->SetMapped(1);
}

void vtkPetrousEGLRenderWindow::Finalize()
{
  if (!this->Context)
    return;
  this->MakeCurrent();
  this->Superclass::Finalize();
  this->Context.reset();
  this->Initialized = false;
}

void vtkPetrousEGLRenderWindow::MakeCurrent()
{
  if (this->Context)
    this->Context->makeCurrent();
}

void vtkPetrousEGLRenderWindow::ReleaseCurrent()
{
  if (this->Context)
    this->Context->releaseCurrent();
}

bool vtkPetrousEGLRenderWindow::IsCurrent()
{
  return this->Context && this->Context->isCurrent();
}

void vtkPetrousEGLRenderWindow::OpenGLInitContext()
{
  if (this->Initialized)
    return;
  glewExperimental = GL_TRUE;
  const GLenum result = glewInit();
  // A GLEW built for GLX loads all OpenGL functions before it fails for lack of a display.
  constexpr GLenum noGlxDisplay = 4;
  if ((result != GLEW_OK && result != noGlxDisplay) || !GLEW_VERSION_3_2)
    throw petrous::rendering::RenderingError(
        petrous::rendering::RenderingError::Reason::NoOpenGL,
        "cannot draw without a display: the driver offers less than OpenGL 3.2 "
        "(Debian: apt install libegl1 libgl1-mesa-dri)");
  this->GlewInitValid = true;
  this->Initialized = true;
}

void vtkPetrousEGLRenderWindow::Render()
{
  this->Initialize();
  this->Superclass::Render();
}

void* vtkPetrousEGLRenderWindow::GetGenericContext()
{
  return this->Context ? this->Context->handle() : nullptr;
}

int vtkPetrousEGLRenderWindow::SupportsOpenGL()
{
  return 1;
}

vtkTypeBool vtkPetrousEGLRenderWindow::IsDirect()
{
  return 1;
}
