#include "petrous/Session/RecordingReader.h"

#include <algorithm>
#include <cstring>

#include "EditCodec.h"
#include "RecordCodec.h"
#include "RecordingFormat.h"
#include "petrous/Core/InputFile.h"

namespace petrous::session
{

using Reason = RecordingError::Reason;

RecordingReader::RecordingReader(const std::filesystem::path& file)
  : m_name(file.filename().string())
{
  try
  {
    m_file = core::openInput(file);
  }
  catch (const core::InputFileError& error)
  {
    throw RecordingError(Reason::NotFound, m_name + ": " + error.problem);
  }
  std::vector<std::uint8_t> head;
  if (!read(head, kMagicBytes) || std::memcmp(head.data(), kMagic, kMagicBytes) != 0)
    throw RecordingError(Reason::NotRecording, m_name + ": is not a recording of a session");
  if (!read(head, 12))
    corrupt("its head is cut short");
  const std::uint32_t version = getU32(head.data());
  if (version > kFormatVersion)
    throw RecordingError(Reason::NewerVersion,
                         m_name + ": written by format " + std::to_string(version) +
                             "; this program reads up to " + std::to_string(kFormatVersion));
  if (version != 0 && version < kOldestVersion)
    throw RecordingError(Reason::OlderVersion,
                         m_name +
                             ": written by format 1, which does not say what was cut; this "
                             "program plays format " +
                             std::to_string(kOldestVersion) + " to " +
                             std::to_string(kFormatVersion) + ": record it again");
  const std::uint32_t size = getU32(&head[8]);
  if (version == 0 || getU32(&head[4]) != sizeof(TickRecord) || size > 2 * kMaxSetup)
    corrupt("its head is damaged");
  std::vector<std::uint8_t> json;
  if (!read(head, size) || !unpack(head, kMaxSetup, json))
    corrupt("its set-up is damaged");
  try
  {
    m_setup = setupFromJson({json.begin(), json.end()});
  }
  catch (const core::InvalidParameter& error)
  {
    corrupt(error.what());
  }
}

void RecordingReader::corrupt(const std::string& what) const
{
  throw RecordingError(Reason::Corrupt, m_name + ": " + what);
}

bool RecordingReader::read(std::vector<std::uint8_t>& bytes, std::size_t count)
{
  // Piecewise: a damaged length must not allocate more memory than the file can fill.
  constexpr std::size_t kPiece = 1 << 20;
  bytes.clear();
  while (bytes.size() < count)
  {
    const std::size_t at = bytes.size();
    const std::size_t piece = std::min(kPiece, count - at);
    bytes.resize(at + piece);
    m_file.read(reinterpret_cast<char*>(&bytes[at]), static_cast<std::streamsize>(piece));
    if (static_cast<std::size_t>(m_file.gcount()) != piece)
      return false;
  }
  return true;
}

bool RecordingReader::next(RecordingBlock& block)
{
  block.ticks.clear();
  block.edits.clear();
  if (m_ended)
    return false;
  std::vector<std::uint8_t> head, ticks, edits;
  const std::string name = "block " + std::to_string(m_blocks + 1);
  m_ended = true; // unless a complete block follows
  if (!read(head, kMarkBytes))
    return false;
  if (getU32(head.data()) == kEndMark)
  {
    if (getU64(&head[4]) != m_ticks || getU64(&head[12]) != m_edits)
      corrupt("it should hold " + std::to_string(getU64(&head[4])) + " ticks and holds " +
              std::to_string(m_ticks));
    if (m_file.peek() != std::ifstream::traits_type::eof())
      corrupt("something follows its end");
    m_complete = true;
    return false;
  }
  const std::uint32_t tickCount = getU32(&head[4]);
  const std::uint32_t editCount = getU32(&head[8]);
  const std::uint32_t tickBytes = getU32(&head[12]);
  const std::uint32_t editBytes = getU32(&head[16]);
  // Incompressible data becomes slightly longer.
  const auto longest = [](std::size_t raw) { return 2 * raw + 1000; };
  if (getU32(head.data()) != kBlockMark || (tickCount == 0 && editCount == 0) ||
      tickCount > kMaxTicks || editCount > kMaxEdits || tickBytes > longest(maxBytes(tickCount)) ||
      editBytes > longest(maxEditBytes(editCount)))
    corrupt(name + " does not begin as one does");
  if (!read(ticks, tickBytes) || !read(edits, editBytes))
    return false;
  std::vector<std::uint8_t> bytes;
  const bool whole =
      unpack(ticks, maxBytes(tickCount), bytes) && decodeTicks(bytes, tickCount, block.ticks) &&
      unpack(edits, maxEditBytes(editCount), bytes) && decodeEdits(bytes, editCount, block.edits);
  if (!whole)
  {
    block = {};
    corrupt(name + " is damaged (from tick " + std::to_string(m_ticks) + " on)");
  }
  m_ended = false;
  m_ticks += tickCount;
  m_edits += editCount;
  ++m_blocks;
  return true;
}

std::string RecordingReader::warning() const
{
  if (!m_ended || m_complete)
    return {};
  return m_name + ": was not closed; read up to its last whole block, " + std::to_string(m_ticks) +
         " ticks";
}

} // namespace petrous::session
