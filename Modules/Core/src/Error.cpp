#include "petrous/Core/Error.h"

namespace petrous::core
{

Error::Error(Fault fault, const std::string& message)
  : std::runtime_error(message)
  , m_fault(fault)
{
}

InvalidParameter::InvalidParameter(const std::string& message)
  : Error(Fault::BadInput, message)
{
}

CancelledError::CancelledError(const std::string& task)
  : Error(Fault::Cancelled, task + ": cancelled; nothing was changed")
{
}

} // namespace petrous::core
