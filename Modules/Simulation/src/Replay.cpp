#include "petrous/Simulation/Replay.h"

#include <cstring>

namespace petrous::simulation
{

std::vector<TickRecord> replay(const std::vector<TickRecord>& recorded, Servo& servo,
                               const std::function<void(const TickRecord&)>& after)
{
  std::vector<TickRecord> result;
  result.reserve(recorded.size());
  for (const TickRecord& record : recorded)
  {
    result.push_back(servo.tick(record.input));
    if (after)
      after(result.back());
  }
  return result;
}

bool identical(const TickRecord& a, const TickRecord& b) noexcept
{
  return std::memcmp(&a, &b, sizeof(TickRecord)) == 0;
}

} // namespace petrous::simulation
