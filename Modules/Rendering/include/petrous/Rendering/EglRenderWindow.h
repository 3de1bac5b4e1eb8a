#pragma once

#include <memory>

#include <vtkGenericOpenGLRenderWindow.h>

namespace petrous::rendering
{
class EglContext;
}

/// A VTK window without a display: an OpenGL context on Mesa's surfaceless EGL platform, or on an
/// EGL device (a GPU whose driver has no surfaceless platform).
///
/// Draws into VTK's own frame buffers, without a surface. Initialize (called by the first Render)
/// throws petrous::rendering::RenderingError NoOpenGL if no context can be created.
class vtkPetrousEGLRenderWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static vtkPetrousEGLRenderWindow* New();
  vtkTypeMacro(vtkPetrousEGLRenderWindow, vtkGenericOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkPetrousEGLRenderWindow(const vtkPetrousEGLRenderWindow&) = delete;
  void operator=(const vtkPetrousEGLRenderWindow&) = delete;

  void Initialize() override;
  void Finalize() override;
  void MakeCurrent() override;
  void ReleaseCurrent() override;
  bool IsCurrent() override;
  void OpenGLInitContext() override;
  void Render() override;
  void* GetGenericContext() override;
  int SupportsOpenGL() override;
  vtkTypeBool IsDirect() override;

protected:
  vtkPetrousEGLRenderWindow();
  ~vtkPetrousEGLRenderWindow() override;

private:
  std::unique_ptr<petrous::rendering::EglContext> Context;
};
