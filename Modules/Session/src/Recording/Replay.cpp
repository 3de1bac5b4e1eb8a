#include "petrous/Session/Replay.h"

#include <cstddef>
#include <cstring>

namespace petrous::session
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

std::string differenceOf(const TickRecord& a, const TickRecord& b)
{
  // In the record's order; each part ends where the next begins.
  struct Part
  {
    std::size_t begin;
    const char* name;
  };
  constexpr Part parts[] = {{0, "the tick's number"},
                            {offsetof(TickRecord, input), "what the hand gave"},
                            {offsetof(TickRecord, mapped), "the hand's place in the patient"},
                            {offsetof(TickRecord, proxy), "the tool's pose"},
                            {offsetof(TickRecord, wrench), "the force"},
                            {offsetof(TickRecord, output), "what the device was sent"},
                            {offsetof(TickRecord, thrust), "the contact"},
                            {offsetof(TickRecord, maskState), "the state of the mask"},
                            {offsetof(TickRecord, contacts), "contacts, faults or drill"}};
  const auto* bytesOfA = reinterpret_cast<const unsigned char*>(&a);
  const auto* bytesOfB = reinterpret_cast<const unsigned char*>(&b);
  const char* name = "";
  for (std::size_t n = 0; n < sizeof(TickRecord); ++n)
  {
    if (bytesOfA[n] == bytesOfB[n])
      continue;
    for (const Part& part : parts)
      if (part.begin <= n)
        name = part.name;
    break;
  }
  return name;
}

} // namespace petrous::session
