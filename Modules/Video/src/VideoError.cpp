#include "petrous/Video/VideoFile.h"

namespace petrous::video
{

VideoError::VideoError(Reason r, const std::string& message)
  : Error(core::Fault::BadInput, message)
  , reason(r)
{
}

} // namespace petrous::video
