#include "TimedView.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtk_glew.h>

#include "WindowPicture.h"
#include "petrous/Rendering/EglRenderWindow.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{
constexpr double kFill = 0.5; // s
constexpr std::size_t kMaxFrames = 200;

std::string glText(GLenum name)
{
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text ? text : "unknown";
}
} // namespace

class TimedView::Implementation
{
public:
  vtkNew<vtkPetrousEGLRenderWindow> window;
  vtkSmartPointer<vtkRenderer> renderer;
  vtkNew<vtkUnsignedCharArray> pixels;
  std::string glRenderer;
  std::string glVersion;

  ~Implementation() { window->MakeCurrent(); }
};

TimedView::TimedView(int width, int height)
  : m_implementation(std::make_unique<Implementation>())
{
  if (width < 1 || height < 1)
    throw RenderingError(RenderingError::Reason::BadSize, "a picture without pixels");
  auto& my = *m_implementation;
  my.window->SetSize(width, height);
  my.window->Initialize();
  my.glRenderer = glText(GL_RENDERER);
  my.glVersion = glText(GL_VERSION);
}

TimedView::~TimedView() = default;

vtkRenderer* TimedView::takeRenderer()
{
  auto& my = *m_implementation;
  my.window->MakeCurrent();
  if (my.renderer)
    my.window->RemoveRenderer(my.renderer);
  my.renderer = vtkSmartPointer<vtkRenderer>::New();
  my.renderer->SetUseFXAA(false);
  my.window->AddRenderer(my.renderer);
  return my.renderer;
}

double TimedView::frame(bool readBack)
{
  auto& my = *m_implementation;
  my.window->MakeCurrent();
  const auto start = std::chrono::steady_clock::now();
  my.window->Render();
  const int* size = my.window->GetSize();
  if (readBack)
    my.window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, my.pixels, 0);
  else
    glFinish();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TimedView::Timing TimedView::time(int frames, double enough)
{
  Timing timing;
  timing.first = frame();
  std::vector<double> seconds;
  double sum = 0.0;
  while ((static_cast<int>(seconds.size()) < frames && sum < enough) ||
         (frames > 0 && sum < kFill && seconds.size() < kMaxFrames))
  {
    seconds.push_back(frame());
    sum += seconds.back();
  }
  timing.frames = static_cast<int>(seconds.size());
  if (seconds.empty())
    seconds.push_back(timing.first);
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  timing.median = *middle;
  return timing;
}

Picture TimedView::picture() const
{
  const auto& my = *m_implementation;
  const int* size = my.window->GetSize();
  return fromBottomRow(size[0], size[1], my.pixels);
}

std::string TimedView::glRenderer() const
{
  return m_implementation->glRenderer;
}

std::string TimedView::glVersion() const
{
  return m_implementation->glVersion;
}

} // namespace petrous::rendering
