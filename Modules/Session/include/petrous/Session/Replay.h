#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "petrous/Session/Servo.h"

namespace petrous::session
{

/// Runs a servo on recorded inputs (for a whole recording see RecordingReplay). With the
/// recording's setup, field and mask the result is bit-identical to the recording.
///
/// recorded  ticks from the first one on
/// servo     new, as at the start of the recording
/// after     called after each tick with the new record, e.g. to update the mask
///           (DissectionLoop::step); may be empty
std::vector<TickRecord> replay(const std::vector<TickRecord>& recorded, Servo& servo,
                               const std::function<void(const TickRecord&)>& after = {});

/// Whether two records are bit-identical.
bool identical(const TickRecord& a, const TickRecord& b) noexcept;

/// The first difference of two records, for display ("the tool's pose"); empty if none.
std::string differenceOf(const TickRecord& a, const TickRecord& b);

} // namespace petrous::session
