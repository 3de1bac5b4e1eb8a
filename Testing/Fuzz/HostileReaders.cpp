#include "HostileReaders.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <sodium.h>
#include <zstd.h>

#include "DicomCleaner.h"
#include "DicomHeader.h"
#include "EditCodec.h"
#include "JournalFile.h"
#include "LabelNames.h"
#include "PixelCodec.h"
#include "PixelMetadata.h"
#include "RecordCodec.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/Error.h"
#include "petrous/Dissection/StrokeCodec.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/StructureSet.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Library/PseudonymMap.h"
#include "petrous/Scene/HistoryText.h"
#include "petrous/Scene/Manifest.h"
#include "petrous/Session/RecordingReader.h"

namespace petrous::testing
{

namespace fs = std::filesystem;

namespace
{

// Frames of a journal are sealed by hashes, which no fuzzer finds: here each gets the hash that it
// needs, as far as its lengths permit.
std::string sealed(std::string_view bytes)
{
  constexpr std::size_t kLength = 8, kHash = 64;
  std::string journal(bytes);
  for (std::size_t at = 0; journal.size() - at >= kLength + kHash;)
  {
    std::uint64_t length = 0;
    for (std::size_t n = kLength; n-- > 0;)
      length = length << 8 | static_cast<unsigned char>(journal[at + n]);
    const std::size_t rest = at + kLength + kHash;
    if (length > journal.size() - rest)
      break;
    journal.replace(at + kLength, kHash,
                    library::sha256Of(reinterpret_cast<const std::uint8_t*>(&journal[rest]),
                                      static_cast<std::size_t>(length)));
    at = rest + static_cast<std::size_t>(length);
  }
  return journal;
}

// Everything that recovery reads of a journal.
void readJournal(std::string_view bytes)
{
  const library::JournalContent content = library::journalFrom(bytes);
  if (!content.headed)
    throw core::Error(core::Fault::BadInput, "not a journal");
  if (!content.head.history.empty())
    scene::historyFromText(content.head.history);
  for (const library::JournalFrame& frame : content.frames)
    if (frame.kind == library::JournalFrame::Kind::History)
      scene::historyFromText(frame.text);
    else
      scene::strokeFromText(frame.text);
}

// Removes and restores on a small grid whose last bricks lie beyond it in part.
void readStroke(const std::vector<std::uint8_t>& packed)
{
  const volume::CutMask mask(
      core::GridGeometry({40, 33, 17}, Eigen::Vector3d(0.5, 0.5, 1.0), Eigen::Vector3d::Zero()));
  dissection::BrickDraft draft(mask);
  dissection::applyDeltas(packed, dissection::Step::Redo, draft);
  dissection::applyDeltas(packed, dissection::Step::Undo, draft);
}

std::vector<std::uint8_t> compressed(std::string_view bytes)
{
  std::vector<std::uint8_t> packed(ZSTD_compressBound(bytes.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
  return packed;
}

} // namespace

HostileReaders::HostileReaders()
{
  // In memory where there is such a folder: a fuzzer writes thousands of files a second.
  std::error_code ignored;
  const fs::path parent =
      fs::is_directory("/dev/shm", ignored) ? "/dev/shm" : fs::temp_directory_path();
  std::string name = (parent / "petrous-hostile-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw std::runtime_error("no temporary folder");
  m_folder = name;
}

HostileReaders::~HostileReaders()
{
  std::error_code ignored;
  fs::remove_all(m_folder, ignored);
}

std::vector<std::string> HostileReaders::names()
{
  return {"nifti",    "nifti-pair", "nifti-gz",     "nrrd",     "segments",  "metaimage",
          "obj",      "stl",        "ply",          "vtp",      "table",     "csv",
          "manifest", "dicom",      "segmentation", "rtstruct", "archive",   "cleaner",
          "frame",    "pseudonyms", "journal",      "stroke",   "recording", "ticks"};
}

fs::path HostileReaders::put(const char* name, std::string_view bytes) const
{
  const fs::path path = m_folder / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

namespace
{

/// Bits allocated, bits stored, high bit, and signed (1), with native cells (0), a codestream (2)
/// or an RLE frame of 16 pixels (4): four bytes; then these. What is cleared once has nothing left
/// to be cleared.
bool clearsFrame(std::string_view bytes)
{
  if (bytes.size() < 4)
    return false;
  const library::StoredBits bits{
      static_cast<unsigned char>(bytes[0]), static_cast<unsigned char>(bytes[1]),
      static_cast<unsigned char>(bytes[2]), (static_cast<unsigned char>(bytes[3]) & 1U) != 0};
  const unsigned kind = static_cast<unsigned char>(bytes[3]) >> 1U & 3U;
  std::vector<std::uint8_t> frame(bytes.begin() + 4, bytes.end());
  const auto clear = [&](std::vector<std::uint8_t>& all)
  {
    bool hadBits = false;
    if (kind == 1)
    {
      library::codestreamPrecision(all.data(), all.size());
      return library::clearCodestreamMetadata(all.data(), all.size());
    }
    if (kind == 2)
      return library::clearRleMetadata(all.data(), all.size(), 16, bits, hadBits);
    if (!library::isClearable(bits))
      return false;
    library::clearUnusedBits(all.data(), all.size() * 8 / static_cast<std::size_t>(bits.allocated),
                             bits);
    return true;
  };
  if (!clear(frame))
    return false;
  const std::vector<std::uint8_t> once = frame;
  if (!clear(frame) || frame != once)
    throw std::logic_error("what was cleared is changed by clearing it again");
  return true;
}

/// The bytes of a pseudonym map, with a checksum that is right; nothing that takes long to open.
std::string cheapMap(std::string_view bytes)
{
  constexpr std::size_t kCost = 21, kMostPasses = 2, kMostMemory = 1 << 17, kChecksum = 32;
  const auto number = [bytes](std::size_t at)
  {
    std::uint64_t value = 0;
    for (std::size_t n = 8; n-- > 0;)
      value = value << 8 | static_cast<unsigned char>(bytes[at + n]);
    return value;
  };
  if (bytes.size() < kCost + 16 || number(kCost) > kMostPasses || number(kCost + 8) > kMostMemory)
    return {};
  std::string file(bytes);
  std::string sum(kChecksum, '\0');
  ::crypto_generichash(reinterpret_cast<unsigned char*>(sum.data()), sum.size(),
                       reinterpret_cast<const unsigned char*>(file.data()), file.size(), nullptr,
                       0);
  return file + sum;
}

} // namespace

bool HostileReaders::accepts(const std::string& reader, std::string_view bytes) const
try
{
  if (reader == "nifti")
    imaging::readImageFile(put("a.nii", bytes));
  else if (reader == "nifti-gz")
    imaging::readImageFile(put("a.nii.gz", bytes));
  else if (reader == "nifti-pair")
  {
    put("a.img", std::string(4096, 'x'));
    imaging::readImageFile(put("a.hdr", bytes));
  }
  else if (reader == "nrrd")
    imaging::readImageFile(put("a.nrrd", bytes));
  else if (reader == "segments")
    imaging::loadLabels(put("a.seg.nrrd", bytes));
  else if (reader == "metaimage")
    imaging::readImageFile(put("a.mha", bytes));
  else if (reader == "obj" || reader == "stl" || reader == "ply" || reader == "vtp")
    imaging::loadMesh(put(("a." + reader).c_str(), bytes));
  else if (reader == "table")
    return !imaging::parseLabelTable(std::string(bytes)).empty();
  else if (reader == "csv")
  {
    std::istringstream text{std::string(bytes)};
    core::readCsv(text, "points", {"x_mm", "y_mm", "z_mm"}, [](std::size_t, const auto&) {});
  }
  else if (reader == "manifest")
    scene::fromManifest(bytes, "case");
  else if (reader == "dicom")
  {
    const imaging::FileHeader header = imaging::readHeader(put("a.dcm", bytes));
    if (header.kind != imaging::FileKind::Dicom || !header.slice.damage.empty())
      return false;
    imaging::StoredPixels pixels;
    if (header.frames.empty())
      imaging::decodePixels(header.slice, pixels);
    for (const imaging::SliceHeader& frame : header.frames)
      imaging::decodePixels(frame, pixels);
  }
  else if (reader == "segmentation")
    imaging::loadLabels(put("a.dcm", bytes));
  else if (reader == "rtstruct")
  {
    const fs::path path = put("a.dcm", bytes);
    const core::GridGeometry grid({24, 24, 8}, Eigen::Vector3d(0.5, 0.5, 1.0),
                                  Eigen::Vector3d::Zero());
    if (!imaging::isStructureSet(path))
      return false;
    imaging::labelsOf(imaging::readStructureSet(path), grid, path);
  }
  else if (reader == "archive")
    library::inspectArchive(put("a.petrous", bytes));
  else if (reader == "journal")
    readJournal(sealed(bytes));
  else if (reader == "stroke")
    readStroke(compressed(bytes));
  else if (reader == "recording")
  {
    session::RecordingReader recording(put("a.rec", bytes));
    for (session::RecordingBlock block; recording.next(block);)
    {
    }
    return recording.complete();
  }
  else if (reader == "ticks") // the tables of a recording; the first byte counts their rows
  {
    if (bytes.empty())
      return false;
    const auto rows = static_cast<unsigned char>(bytes[0]);
    const std::vector<std::uint8_t> table(bytes.begin() + 1, bytes.end());
    std::vector<session::TickRecord> ticks;
    std::vector<session::MaskEdit> edits;
    const bool areTicks = session::decodeTicks(table, rows, ticks);
    return session::decodeEdits(table, rows, edits) || areTicks;
  }
  else if (reader == "cleaner")
  {
    static const library::PseudonymKey key;
    library::DicomCleaner cleaner({}, key);
    const auto out = [this](const std::string&, const std::string&) { return m_folder / "b.dcm"; };
    return cleaner.clean(put("a.dcm", bytes), out).leftOut.empty();
  }
  else if (reader == "frame")
    return clearsFrame(bytes);
  else if (reader == "pseudonyms")
  {
    const std::string file = cheapMap(bytes);
    if (file.empty())
      return false;
    library::PseudonymMap(put("a.map", file), "a passphrase", {1, 1 << 16});
  }
  else
    throw std::logic_error("no reader '" + reader + "'");
  return true;
}
catch (const core::Error& error)
{
  const std::string_view text = error.what();
  if (text.empty() || text.find('\n') != text.npos)
    throw std::logic_error("a refusal that is not one line");
  return false;
}

} // namespace petrous::testing
