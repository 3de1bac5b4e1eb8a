#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace petrous::cli
{

/// A device server (Documentation/device-servers.md) in a process of its own, that measures when
/// wrenches come to its motors. Its poses carry the time at which they were measured, in
/// microseconds of CLOCK_MONOTONIC modulo 2^32, as buttons.
struct Arrival
{
  std::uint64_t tick = 0; ///< of the wrench
  std::int64_t time = 0;  ///< ns of CLOCK_MONOTONIC, when the motors had it
};

/// The word that makes this program such a server: "WORD poll|tick FILE BLOCK".
constexpr char kAnsweringServer[] = "answering-server";

/// Program and arguments of one, without the block's name. `polls`: it exchanges without a pause,
/// as the fastest SDK would, else once a millisecond. Its arrivals are in `file` when it has ended.
std::vector<std::string> answeringServer(bool polls, const std::filesystem::path& file);

/// Serves; returns the exit status.
int serveAnswers(const std::vector<std::string>& words);

/// Of a server that has ended. Throws core::Error if there are none.
std::vector<Arrival> arrivalsIn(const std::filesystem::path& file);

} // namespace petrous::cli
