#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

/// The program's log, one line per event. Until `start`, nothing is written.
///
/// A line never contains patient data. Names of files, folders, cases and structures, arguments,
/// messages of errors and of other libraries may contain them, and are not logged: counts, sizes,
/// durations and our own names are.
///
/// Thread-safe. Allocates and writes to the disk, so nothing is logged in the servo thread.
namespace petrous::core::log
{

enum class Level
{
  Trace,
  Debug,
  Info,
  Warning,
  Error,
  Off
};

/// The level named by `option`, else by $PETROUS_LOG_LEVEL, else Info. Throws InvalidParameter with
/// the names (trace, debug, info, warning, error, off).
Level levelFrom(const std::string& option);

/// $XDG_STATE_HOME/petrous/petrous.log, by default in ~/.local/state; empty without a home folder.
std::filesystem::path defaultFile();

struct Setup
{
  std::filesystem::path file = defaultFile();
  Level level = Level::Info;
  std::uintmax_t maxBytes = std::uintmax_t{2} << 20; ///< of a file
  int files = 5;                                     ///< petrous.log, petrous.1.log ...
  std::function<void(const std::string&)> warn;      ///< called once, if the log cannot be written
};

/// Starts, or replaces, the log of this process. The file (mode 0600) is opened by the first line.
/// Several processes share it: each line is appended by one write, and the process that holds the
/// file's lock renames the full file. A signal that ends the process is logged as well.
void start(const Setup& setup);

void write(Level level, std::string_view text) noexcept;
inline void debug(std::string_view text) noexcept
{
  write(Level::Debug, text);
}
inline void info(std::string_view text) noexcept
{
  write(Level::Info, text);
}
inline void warning(std::string_view text) noexcept
{
  write(Level::Warning, text);
}
inline void error(std::string_view text) noexcept
{
  write(Level::Error, text);
}

/// "petrous::imaging::DicomError": all that is logged of an exception.
std::string typeOf(const std::exception& error);

/// Logs a message of VTK or ITK ("ERROR: In FILE, line 12 ...") without its text: its source only.
void foreign(Level level, const std::string& library, std::string_view text) noexcept;

} // namespace petrous::core::log
