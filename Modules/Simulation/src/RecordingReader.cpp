#include "petrous/Simulation/RecordingReader.h"

#include <algorithm>
#include <cstring>

#include "RecordCodec.h"
#include "RecordingFormat.h"

namespace petrous::simulation
{

using Reason = RecordingError::Reason;

RecordingReader::RecordingReader(const std::filesystem::path& file)
  : m_name(file.filename().string())
  , m_file(file, std::ios::binary)
{
  if (!m_file)
    throw RecordingError(Reason::NotFound, m_name + ": no such file, or it cannot be read");
  std::vector<std::uint8_t> head;
  if (!read(head, kMagicBytes) || std::memcmp(head.data(), kMagic, kMagicBytes) != 0)
    throw RecordingError(Reason::NotRecording, m_name + ": is not a recording of the hand");
  if (!read(head, 12))
    corrupt("its head is cut short");
  const std::uint32_t version = getU32(head.data());
  if (version > kFormatVersion)
    throw RecordingError(Reason::NewerVersion,
                         m_name + ": written by format " + std::to_string(version) +
                             "; this program reads up to " + std::to_string(kFormatVersion));
  const std::uint32_t size = getU32(&head[8]);
  if (version != kFormatVersion || getU32(&head[4]) != sizeof(TickRecord) || size > 2 * kMostSetup)
    corrupt("its head is damaged");
  std::vector<std::uint8_t> json;
  if (!read(head, size) || !unpack(head, kMostSetup, json))
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
  // In pieces: a damaged length must not ask for more memory than the file can fill.
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

bool RecordingReader::next(std::vector<TickRecord>& ticks)
{
  ticks.clear();
  if (m_ended)
    return false;
  std::vector<std::uint8_t> head, bytes;
  const std::string block = "block " + std::to_string(m_blocks + 1);
  m_ended = true; // unless a whole block follows
  if (!read(head, 12))
    return false;
  if (getU32(head.data()) == kEndMark)
  {
    const std::uint64_t all = getU32(&head[4]) | static_cast<std::uint64_t>(getU32(&head[8])) << 32;
    if (all != m_ticks)
      corrupt("it should hold " + std::to_string(all) + " ticks and holds " +
              std::to_string(m_ticks));
    if (m_file.peek() != std::ifstream::traits_type::eof())
      corrupt("something follows its end");
    m_complete = true;
    return false;
  }
  const std::uint32_t count = getU32(&head[4]);
  const std::uint32_t size = getU32(&head[8]);
  if (getU32(head.data()) != kBlockMark || count == 0 || count > kMostTicks ||
      size > 2 * mostBytes(count))
    corrupt(block + " does not begin as one does");
  if (!read(head, size))
    return false;
  if (!unpack(head, mostBytes(count), bytes) || !decodeTicks(bytes, count, ticks))
  {
    ticks.clear();
    corrupt(block + " is damaged (from tick " + std::to_string(m_ticks) + " on)");
  }
  m_ended = false;
  m_ticks += count;
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

} // namespace petrous::simulation
