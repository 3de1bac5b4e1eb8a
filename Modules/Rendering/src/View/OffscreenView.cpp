#include "petrous/Rendering/OffscreenView.h"

#include <chrono>

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtk_glew.h>

#include "WindowPicture.h"
#include "petrous/Rendering/EglRenderWindow.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{
constexpr int kLargestEdge = 16384;

double since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}
} // namespace

class OffscreenView::Implementation
{
public:
  Implementation(int width, int height)
  {
    if (width < 1 || height < 1 || width > kLargestEdge || height > kLargestEdge)
      throw RenderingError(RenderingError::Reason::BadSize,
                           "a picture of " + std::to_string(width) + " x " +
                               std::to_string(height) + " pixels; 1 to " +
                               std::to_string(kLargestEdge) + " are possible");
    window->SetSize(width, height);
    window->Initialize();
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    rendererName = name ? name : "unknown";
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width > largest || height > largest)
      throw RenderingError(RenderingError::Reason::BadSize,
                           "a picture of " + std::to_string(width) + " x " +
                               std::to_string(height) + " pixels; " + rendererName +
                               " draws up to " + std::to_string(largest));
    window->ReleaseCurrent();
  }

  ~Implementation() { window->MakeCurrent(); }

  // A new renderer per scene drops the previous scene's props, light and textures.
  void takeNewRenderer()
  {
    window->MakeCurrent();
    if (renderer)
      window->RemoveRenderer(renderer);
    renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetUseFXAA(false);
    window->AddRenderer(renderer);
  }

  vtkNew<vtkPetrousEGLRenderWindow> window;
  vtkSmartPointer<vtkRenderer> renderer;
  std::string rendererName;
  double milliseconds = 0.0;
  double firstFrame = 0.0;
};

OffscreenView::OffscreenView(int width, int height)
  : m_implementation(std::make_unique<Implementation>(width, height))
{
}

OffscreenView::~OffscreenView() = default;

Picture OffscreenView::render(ScenePicture& scene)
{
  Implementation& my = *m_implementation;
  const bool first = !my.renderer || scene.renderer() != my.renderer;
  const auto start = std::chrono::steady_clock::now();
  if (first)
  {
    my.takeNewRenderer();
    scene.attach(my.renderer);
  }
  my.window->Render();
  scene.throwLastError();

  Picture picture = readWindow(my.window);
  if (picture.rgb.empty())
    throw RenderingError(RenderingError::Reason::NoOpenGL,
                         my.rendererName + " gave no picture back");
  // GLX fails on a thread with a current EGL context.
  my.window->ReleaseCurrent();
  my.milliseconds = since(start);
  if (first)
    my.firstFrame = my.milliseconds;
  return picture;
}

double OffscreenView::milliseconds() const
{
  return m_implementation->milliseconds;
}

double OffscreenView::firstFrameMilliseconds() const
{
  return m_implementation->firstFrame;
}

std::string OffscreenView::glRenderer() const
{
  return m_implementation->rendererName;
}

} // namespace petrous::rendering
