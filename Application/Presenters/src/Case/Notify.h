#pragma once

namespace petrous::presenters
{

/// Calls what somebody may have asked to hear of.
template <class Event, class... Arguments>
void notify(const Event& event, const Arguments&... arguments)
{
  if (event)
    event(arguments...);
}

} // namespace petrous::presenters
