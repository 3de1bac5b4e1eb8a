#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{
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

} // namespace petrous::rendering
