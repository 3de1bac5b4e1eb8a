#include "HostileReaders.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <zstd.h>

#include "DicomHeader.h"
#include "EditCodec.h"
#include "JournalFile.h"
#include "LabelNames.h"
#include "PixelCodec.h"
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
  return {"nifti",        "nifti-pair", "nifti-gz", "nrrd",    "segments", "metaimage", "obj",
          "stl",          "ply",        "vtp",      "table",   "csv",      "manifest",  "dicom",
          "segmentation", "rtstruct",   "archive",  "journal", "stroke",   "recording", "ticks"};
}

fs::path HostileReaders::put(const char* name, std::string_view bytes) const
{
  const fs::path path = m_folder / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

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
