#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "petrous/Simulation/Servo.h"

namespace petrous::simulation
{

/// Gives a servo the inputs that were recorded (a whole recording: RecordingReplay). With the
/// set-up, field and mask of the recording the result is the recording, bit for bit.
///
/// recorded  ticks from the first one on
/// servo     fresh, as the recording's was when it began
/// after     called after each tick with the new record, where the mask is to follow
///           (DissectionLoop::step); may be empty
std::vector<TickRecord> replay(const std::vector<TickRecord>& recorded, Servo& servo,
                               const std::function<void(const TickRecord&)>& after = {});

/// Whether two records are the same to the last bit.
bool identical(const TickRecord& a, const TickRecord& b) noexcept;

/// What of two records differs first, for people ("the tool's pose"); empty where nothing does.
std::string differenceOf(const TickRecord& a, const TickRecord& b);

} // namespace petrous::simulation
