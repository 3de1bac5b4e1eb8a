#pragma once

#include <filesystem>
#include <string>

#include "petrous/Session/RecordingWriter.h"

namespace petrous::session
{

/// Records a live session without ever disturbing it: if the disk is full or ticks were lost, the
/// recording ends and contains the session up to that point. For the cutting thread.
class SessionRecorder
{
public:
  /// Creates or overwrites the file. Throws RecordingError, InvalidParameter.
  SessionRecorder(const std::filesystem::path& file, const RecordingSetup& setup);

  void add(const TickRecord* records, std::size_t count); ///< in chronological order
  void add(const MaskEdit& edit);                         ///< see RecordingWriter::add

  /// Ends the recording. Idempotent.
  void close();

  bool recording() const noexcept { return m_on; }
  std::uint64_t ticks() const noexcept { return m_writer.ticks(); }
  std::uint64_t bytes() const noexcept { return m_writer.bytes(); } ///< on disk so far

  /// Why the recording ended before the session, one sentence, once. Empty otherwise.
  std::string takeFailure();

private:
  template <typename Work>
  void attempt(Work work);

  RecordingWriter m_writer;
  bool m_on = true;
  std::uint64_t m_next = 0; // number of the next tick
  std::string m_failure;
};

} // namespace petrous::session
