#include "petrous/Rendering/EglRenderWindow.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <memory>
#include <string>
#include <vector>

#include <vtkObjectFactory.h>
#include <vtk_glew.h>

#include "petrous/Rendering/RenderingError.h"

#define EGL_NO_X11

namespace petrous::rendering
{

/// An OpenGL core context without a display or a surface.
///
/// Tries in order: hardware EGL devices, Mesa's surfaceless platform, software EGL devices; the
/// first that provides OpenGL 3.2 or later is used. libEGL is loaded on first use.
class EglContext
{
public:
  /// Throws RenderingError NoOpenGL; the message says what to install.
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void makeCurrent();
  void releaseCurrent();
  bool isCurrent() const;
  void* handle() const;

private:
  struct State;
  std::unique_ptr<State> m_state;
};

namespace
{

[[noreturn]] void fail(const std::string& what)
{
  throw RenderingError(RenderingError::Reason::NoOpenGL,
                       "cannot draw without a display: " + what +
                           "; OpenGL 3.2 through EGL is needed "
                           "(Debian: apt install libegl1 libgl1-mesa-dri)");
}

// EGL entry points, loaded from libEGL.so.1 at run time.
struct Egl
{
  decltype(&eglGetProcAddress) getProcAddress = nullptr;
  decltype(&eglQueryString) queryString = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bindApi = nullptr;
  decltype(&eglChooseConfig) chooseConfig = nullptr;
  decltype(&eglCreateContext) createContext = nullptr;
  decltype(&eglDestroyContext) destroyContext = nullptr;
  decltype(&eglMakeCurrent) makeCurrent = nullptr;
  decltype(&eglGetCurrentContext) getCurrentContext = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay = nullptr;
  PFNEGLQUERYDEVICESEXTPROC queryDevices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = nullptr;
  std::string clientExtensions;

  Egl()
  {
    // Never closed: drivers own threads and exit handlers.
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_GLOBAL);
    if (!library)
      fail("libEGL.so.1 is not installed");
    const auto load = [library](auto& function, const char* name)
    {
      function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name));
      if (!function)
        fail(std::string("libEGL.so.1 has no ") + name);
    };
    load(getProcAddress, "eglGetProcAddress");
    load(queryString, "eglQueryString");
    load(initialize, "eglInitialize");
    load(bindApi, "eglBindAPI");
    load(chooseConfig, "eglChooseConfig");
    load(createContext, "eglCreateContext");
    load(destroyContext, "eglDestroyContext");
    load(makeCurrent, "eglMakeCurrent");
    load(getCurrentContext, "eglGetCurrentContext");
    const auto extension = [this](auto& function, const char* name)
    { function = reinterpret_cast<std::decay_t<decltype(function)>>(getProcAddress(name)); };
    extension(getPlatformDisplay, "eglGetPlatformDisplayEXT");
    extension(queryDevices, "eglQueryDevicesEXT");
    extension(queryDeviceString, "eglQueryDeviceStringEXT");
    if (const char* text = queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS))
      clientExtensions = text;
  }

  static const Egl& instance()
  {
    static const Egl egl; // retried after a failure
    return egl;
  }
};

bool has(const char* extensions, const char* name)
{
  return extensions && std::string(extensions).find(name) != std::string::npos;
}

std::vector<EGLDisplay> candidates(const Egl& egl)
{
  std::vector<EGLDisplay> displays;
  if (!egl.getPlatformDisplay)
    return displays;
  std::vector<EGLDisplay> software;
  const char* extensions = egl.clientExtensions.c_str();
  if (egl.queryDevices && has(extensions, "EGL_EXT_platform_device"))
  {
    EGLint count = 0;
    egl.queryDevices(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    egl.queryDevices(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices)
    {
      const char* text =
          egl.queryDeviceString ? egl.queryDeviceString(device, EGL_EXTENSIONS) : nullptr;
      EGLDisplay display = egl.getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
      (has(text, "EGL_MESA_device_software") ? software : displays).push_back(display);
    }
  }
  if (has(extensions, "EGL_MESA_platform_surfaceless"))
    displays.push_back(
        egl.getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  displays.insert(displays.end(), software.begin(), software.end());
  return displays;
}

EGLContext createContext(const Egl& egl, EGLDisplay display)
{
  if (display == EGL_NO_DISPLAY || !egl.initialize(display, nullptr, nullptr))
    return EGL_NO_CONTEXT;
  if (!has(egl.queryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
    return EGL_NO_CONTEXT;
  if (!egl.bindApi(EGL_OPENGL_API))
    return EGL_NO_CONTEXT;
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!egl.chooseConfig(display, wanted, &config, 1, &count) || count < 1)
    return EGL_NO_CONTEXT;
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            2,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
  return egl.createContext(display, config, EGL_NO_CONTEXT, version);
}

} // namespace

struct EglContext::State
{
  const Egl& egl;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

EglContext::EglContext()
  : m_state(new State{Egl::instance()})
{
  for (EGLDisplay display : candidates(m_state->egl))
  {
    const EGLContext context = createContext(m_state->egl, display);
    if (context == EGL_NO_CONTEXT)
      continue;
    if (m_state->egl.makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    {
      m_state->display = display;
      m_state->context = context;
      return;
    }
    m_state->egl.destroyContext(display, context);
  }
  fail("no EGL device or surfaceless platform gives a context");
}

EglContext::~EglContext()
{
  if (isCurrent())
    releaseCurrent();
  // The display is shared by all contexts of the process and lives as long as the process.
  m_state->egl.destroyContext(m_state->display, m_state->context);
}

void EglContext::makeCurrent()
{
  if (isCurrent())
    return;
  m_state->egl.bindApi(EGL_OPENGL_API);
  if (!m_state->egl.makeCurrent(m_state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_state->context))
    fail("the OpenGL context was lost");
}

void EglContext::releaseCurrent()
{
  m_state->egl.makeCurrent(m_state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

bool EglContext::isCurrent() const
{
  return m_state->egl.getCurrentContext() == m_state->context;
}

void* EglContext::handle() const
{
  return m_state->context;
}
} // namespace petrous::rendering

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
