#include "petrous/Rendering/RenderingError.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include "petrous/Core/Log.h"

namespace petrous::rendering
{

namespace
{

class LogWindow : public vtkOutputWindow
{
public:
  static LogWindow* New();
  vtkTypeMacro(LogWindow, vtkOutputWindow);

  void DisplayText(const char* text) override { log(core::log::Level::Info, text); }
  void DisplayErrorText(const char* text) override { log(core::log::Level::Error, text); }
  void DisplayWarningText(const char* text) override { log(core::log::Level::Warning, text); }
  void DisplayGenericWarningText(const char* text) override { DisplayWarningText(text); }
  void DisplayDebugText(const char* text) override { log(core::log::Level::Debug, text); }

private:
  static void log(core::log::Level level, const char* text)
  {
    core::log::foreign(level, "VTK", text ? text : "");
  }
};
vtkStandardNewMacro(LogWindow);

core::Fault faultOf(RenderingError::Reason reason)
{
  switch (reason)
  {
  case RenderingError::Reason::BadSize:
  case RenderingError::Reason::BadContents:
    return core::Fault::BadInput;
  case RenderingError::Reason::CannotWrite:
    return core::Fault::Refused;
  case RenderingError::Reason::NoOpenGL:
    break;
  }
  return core::Fault::Internal;
}
} // namespace

RenderingError::RenderingError(Reason why, const std::string& message)
  : core::Error(faultOf(why), message)
  , reason(why)
{
}

void logToolkitMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // it has the text
  const vtkNew<LogWindow> window;
  vtkOutputWindow::SetInstance(window);
}

} // namespace petrous::rendering
