#pragma once

#include <filesystem>
#include <string>

#include "petrous/Simulation/RecordingWriter.h"

namespace petrous::simulation
{

/// Records a live session and never stands in its way: when the disk is full, or ticks were lost,
/// the recording ends and holds the session up to there. For the thread that cuts.
class SessionRecorder
{
public:
  /// Makes or replaces the file. Throws RecordingError, InvalidParameter.
  SessionRecorder(const std::filesystem::path& file, const RecordingSetup& setup);

  void add(const TickRecord* records, std::size_t count); ///< in the order in which they were made
  void add(const MaskEdit& edit);                         ///< as RecordingWriter::add

  /// The session is over. Again is as once.
  void close();

  bool recording() const noexcept { return m_on; }
  std::uint64_t ticks() const noexcept { return m_writer.ticks(); }
  std::uint64_t bytes() const noexcept { return m_writer.bytes(); } ///< on disk so far

  /// Why the recording ended before the session did, one sentence, once. Empty otherwise.
  std::string takeFailure();

private:
  template <typename Work>
  void attempt(Work work);

  RecordingWriter m_writer;
  bool m_on = true;
  std::uint64_t m_next = 0; // number of the tick to come
  std::string m_failure;
};

} // namespace petrous::simulation
