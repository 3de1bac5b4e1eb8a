#include "petrous/Session/RecordingWriter.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include "EditCodec.h"
#include "RecordCodec.h"
#include "RecordingFormat.h"
#include "petrous/Core/OutputFile.h"

namespace petrous::session
{

namespace
{

std::vector<std::uint8_t> headOf(const RecordingSetup& setup)
{
  const std::string json = toJson(setup);
  if (json.size() > kMaxSetup)
    throw core::InvalidParameter("recording: the set-up's texts are longer than 1 MB");
  const std::vector<std::uint8_t> packed = pack({json.begin(), json.end()});
  std::vector<std::uint8_t> head(kMagic, kMagic + kMagicBytes);
  putU32(head, kFormatVersion);
  putU32(head, sizeof(TickRecord));
  putU32(head, static_cast<std::uint32_t>(packed.size()));
  head.insert(head.end(), packed.begin(), packed.end());
  return head;
}

} // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& file, const RecordingSetup& setup)
  : m_name(file.filename().string())
{
  const std::vector<std::uint8_t> head = headOf(setup);
  std::filesystem::path target;
  try
  {
    target = core::outputTarget(file);
  }
  catch (const core::OutputFileError& error)
  {
    throw RecordingError(RecordingError::Reason::NotWritten, m_name + ": " + error.problem);
  }
  m_folder = target.parent_path();
  m_block.ticks.reserve(kBlock);
  // A file that is there is replaced when this one has begun.
  const std::filesystem::path begun = core::temporaryBeside(target);
  m_file.reset(std::fopen(begun.c_str(), "wbx"));
  if (!m_file)
    fail();
  try
  {
    write(head);
    if (std::rename(begun.c_str(), target.c_str()) != 0)
      fail();
  }
  catch (const RecordingError&)
  {
    ::unlink(begun.c_str());
    throw;
  }
}

RecordingWriter::~RecordingWriter()
{
  try
  {
    close();
  }
  catch (const std::exception&)
  {
    // Callers who need the error call close().
  }
}

void RecordingWriter::fail()
{
  const std::string why = std::strerror(errno);
  m_file.reset();
  m_block = {};
  throw RecordingError(RecordingError::Reason::NotWritten,
                       m_name + ": could not be written (" + why + ")");
}

void RecordingWriter::write(const std::vector<std::uint8_t>& bytes)
{
  // Flushed, so that a killed program loses at most one block.
  if (std::fwrite(bytes.data(), 1, bytes.size(), m_file.get()) != bytes.size() ||
      std::fflush(m_file.get()) != 0)
    fail();
  m_bytes += bytes.size();
}

void RecordingWriter::writeBlock()
{
  if (m_block.ticks.empty() && m_block.edits.empty())
    return;
  const std::vector<std::uint8_t> ticks = pack(encodeTicks(m_block.ticks));
  const std::vector<std::uint8_t> edits = pack(encodeEdits(m_block.edits));
  std::vector<std::uint8_t> bytes;
  putU32(bytes, kBlockMark);
  for (const std::size_t size :
       {m_block.ticks.size(), m_block.edits.size(), ticks.size(), edits.size()})
    putU32(bytes, static_cast<std::uint32_t>(size));
  bytes.insert(bytes.end(), ticks.begin(), ticks.end());
  bytes.insert(bytes.end(), edits.begin(), edits.end());
  m_block.ticks.clear();
  m_block.edits.clear();
  write(bytes);
}

void RecordingWriter::add(const TickRecord& record)
{
  if (!m_file)
    return;
  m_block.ticks.push_back(record);
  ++m_ticks;
  if (m_block.ticks.size() == kBlock)
    writeBlock();
}

void RecordingWriter::add(const MaskEdit& edit)
{
  if (!m_file)
    return;
  m_block.edits.push_back(edit);
  ++m_edits;
  if (m_block.edits.size() == kEdits)
    writeBlock();
}

void RecordingWriter::close()
{
  if (!m_file)
    return;
  writeBlock();
  std::vector<std::uint8_t> end;
  putU32(end, kEndMark);
  putU64(end, m_ticks);
  putU64(end, m_edits);
  write(end);
  if (::fsync(::fileno(m_file.get())) != 0 && errno != EINVAL) // EINVAL: cannot be synced there
    fail();
  if (std::fclose(m_file.release()) != 0)
    fail();
  core::syncFolder(m_folder);
}

} // namespace petrous::session
