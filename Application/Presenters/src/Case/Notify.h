#pragma once

namespace petrous::presenters
{

/// Calls an event handler, if set.
template <class Event, class... Arguments>
void notify(const Event& event, const Arguments&... arguments)
{
  if (event)
    event(arguments...);
}

} // namespace petrous::presenters
