#include "HostileReaders.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "DicomHeader.h"
#include "LabelNames.h"
#include "PixelCodec.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/Error.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/StructureSet.h"
#include "petrous/Library/Archive.h"
#include "petrous/Scene/Manifest.h"

namespace petrous::testing
{

namespace fs = std::filesystem;

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
  return {"nifti",    "nifti-pair", "nifti-gz",     "nrrd",     "segments", "metaimage",
          "obj",      "stl",        "ply",          "vtp",      "table",    "csv",
          "manifest", "dicom",      "segmentation", "rtstruct", "archive"};
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
