#include "petrous/Core/Progress.h"

#include <algorithm>
#include <utility>

#include "petrous/Core/Error.h"

namespace petrous::core
{

Progress::Progress(Listener listener, std::shared_ptr<const CancelToken> token)
  : m_listener(std::move(listener))
  , m_token(std::move(token))
{
}

void Progress::report(double fraction, const std::string& text) const
{
  check(text);
  if (m_listener)
    m_listener(m_first + std::clamp(fraction, 0.0, 1.0) * (m_last - m_first), text);
}

void Progress::check(const std::string& task) const
{
  if (m_token && m_token->isCancelled())
    throw CancelledError(task);
}

Progress Progress::part(double first, double last) const
{
  Progress result = *this;
  result.m_first = m_first + first * (m_last - m_first);
  result.m_last = m_first + last * (m_last - m_first);
  return result;
}

} // namespace petrous::core
