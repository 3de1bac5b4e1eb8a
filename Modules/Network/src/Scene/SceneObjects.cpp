#include "petrous/Network/SceneObjects.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <locale>
#include <memory>
#include <sstream>

#include <openssl/evp.h>
#include <unistd.h>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcostrmf.h>
#include <dcmtk/dcmdata/dctk.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Imaging/DicomWriter.h"

namespace petrous::network
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kCreator = "PETROUS SCENE";
constexpr int kFormat = 1;
const DcmTagKey kCreatorTag(0x7571, 0x0010);
const DcmTagKey kPartTag(0x7571, 0x1010);

std::string sceneFault(const std::string& what)
{
  return "the scene's DICOM objects: " + what + "; have it sent again";
}

class Digest
{
public:
  Digest()
    : m_context(EVP_MD_CTX_new(), &EVP_MD_CTX_free)
  {
    EVP_DigestInit_ex(m_context.get(), EVP_sha256(), nullptr);
  }
  void add(const void* bytes, std::size_t count)
  {
    EVP_DigestUpdate(m_context.get(), bytes, count);
  }
  std::string hexadecimal()
  {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned count = 0;
    EVP_DigestFinal_ex(m_context.get(), bytes.data(), &count);
    std::string text;
    for (unsigned n = 0; n < count; ++n)
      for (const int half : {bytes[n] >> 4, bytes[n] & 0xF})
        text += "0123456789abcdef"[half];
    return text;
  }

private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> m_context;
};

void readAt(const core::InputFile& file, std::uintmax_t offset, std::vector<char>& bytes)
{
  for (std::size_t done = 0; done < bytes.size();)
  {
    const ssize_t got = ::pread(file.descriptor(), bytes.data() + done, bytes.size() - done,
                                static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      throw core::InputFileError(core::InputFileError::Reason::Unreadable, file.path(),
                                 "cannot be read");
    done += static_cast<std::size_t>(got);
  }
}

std::string sha256(const core::InputFile& file, const core::Progress& progress)
{
  Digest digest;
  std::vector<char> bytes;
  for (std::uintmax_t at = 0; at < file.size(); at += bytes.size())
  {
    progress.report(static_cast<double>(at) / static_cast<double>(file.size()),
                    "reading the scene");
    bytes.resize(std::min<std::uintmax_t>(file.size() - at, std::uintmax_t{1} << 20));
    readAt(file, at, bytes);
    digest.add(bytes.data(), bytes.size());
  }
  return digest.hexadecimal();
}

void put(DcmItem& item, const DcmTagKey& key, const std::string& value)
{
  item.putAndInsertString(key, value.c_str());
}

// Throws core::OutputFileError.
void save(DcmFileFormat& content, const fs::path& path)
{
  errno = 0;
  OFCondition saved;
  offile_off_t size = 0;
  {
    DcmOutputFileStream stream(path.c_str());
    saved = stream.status();
    if (saved.good())
    {
      content.transferInit();
      saved = content.write(stream, EXS_LittleEndianExplicit, EET_UndefinedLength, nullptr);
      content.transferEnd();
      size = stream.tell();
    }
  } // which does not tell what the disk says then
  const int error = errno;
  std::error_code fault;
  if (saved.bad() || fs::file_size(path, fault) != static_cast<std::uintmax_t>(size) || fault)
    core::throwOutputError(saved.bad() && error != 0 ? error : ENOSPC, path);
}

struct Part
{
  fs::path file;
  std::uintmax_t number = 0, parts = 0, offset = 0, size = 0, total = 0;
  std::string sha;
  std::size_t header = 0; ///< bytes of its line of text
};

const Uint8* bytesOf(DcmDataset& data, std::size_t& count)
{
  DcmElement* element = nullptr;
  Uint8* bytes = nullptr;
  if (data.findAndGetElement(kPartTag, element).bad() || !element ||
      element->getUint8Array(bytes).bad() || !bytes)
    return nullptr;
  count = element->getLength();
  return bytes;
}

Part partOf(const fs::path& file, DcmFileFormat& content)
{
  Part part;
  part.file = file;
  if (content.loadFile(file.c_str()).bad())
    throw core::InvalidParameter(sceneFault("one is not a DICOM file"));
  std::size_t count = 0;
  const Uint8* bytes = bytesOf(*content.getDataset(), count);
  const std::size_t window = std::min<std::size_t>(count, 256);
  const auto* end = bytes ? static_cast<const Uint8*>(std::memchr(bytes, '\n', window)) : nullptr;
  if (!end)
    throw core::InvalidParameter(
        sceneFault("one is not a part of a Petrous scene, or the server did not keep its data"));
  std::istringstream line(
      std::string(reinterpret_cast<const char*>(bytes), reinterpret_cast<const char*>(end)));
  line.imbue(std::locale::classic());
  std::string magic;
  int format = 0;
  line >> magic >> format;
  if (magic == "petrous-scene" && format > kFormat)
    throw core::InvalidParameter("the scene's DICOM objects are of format " +
                                 std::to_string(format) + "; this program reads up to " +
                                 std::to_string(kFormat));
  line >> part.number >> part.parts >> part.offset >> part.size >> part.total >> part.sha;
  part.header = static_cast<std::size_t>(end - bytes) + 1;
  if (!line || magic != "petrous-scene" || part.number < 1 || part.number > part.parts ||
      part.size > count - part.header || part.offset > part.total ||
      part.size > part.total - part.offset || part.sha.size() != 64)
    throw core::InvalidParameter(sceneFault("one has a damaged head"));
  return part;
}

} // namespace

bool isScene(const Series& series)
{
  if (series.modality != kSceneModality)
    return false;
  return series.description.empty() ? series.number >= kFirstSceneNumber
                                    : series.description == kSceneDescription;
}

namespace
{

// Where scenes are described, what is not is none: only a node that describes nothing leaves
// it to be guessed.
bool isDescribed(const Series& series)
{
  return isScene(series) && !series.description.empty();
}

bool isSceneAmong(const std::vector<Series>& series, const Series& one)
{
  return isDescribed(one) ||
         (isScene(one) && std::none_of(series.begin(), series.end(), isDescribed));
}

} // namespace

std::vector<Series>::const_iterator latestScene(const std::vector<Series>& series)
{
  auto latest = series.end();
  for (auto one = series.begin(); one != series.end(); ++one)
    if (isSceneAmong(series, *one) && (latest == series.end() || one->number > latest->number))
      latest = one;
  return latest;
}

std::vector<Series> scenesAmong(const std::vector<Series>& series)
{
  std::vector<Series> scenes;
  std::copy_if(series.begin(), series.end(), std::back_inserter(scenes),
               [&series](const Series& one) { return isSceneAmong(series, one); });
  std::stable_sort(scenes.begin(), scenes.end(),
                   [](const Series& a, const Series& b) { return a.number > b.number; });
  return scenes;
}

std::vector<fs::path> writeSceneObjects(const fs::path& archive, const fs::path& folder,
                                        const SceneDescription& description,
                                        const core::Progress& progress, std::uintmax_t partBytes)
{
  if (description.studyUid.empty() || partBytes < 1 || partBytes > (std::uintmax_t{1} << 30))
    throw core::InvalidParameter("the scene's DICOM objects: need a study, and parts of 1 byte to "
                                 "1 GB");
  const core::InputFile file(archive);
  const std::string sha = sha256(file, progress.part(0.0, 0.3));
  const std::uintmax_t parts =
      std::max<std::uintmax_t>((file.size() + partBytes - 1) / partBytes, 1);
  const std::string series = imaging::deterministicUid(0, description.studyUid + "/scene/" + sha);
  std::vector<fs::path> files;
  std::vector<char> bytes;
  for (std::uintmax_t n = 0; n < parts; ++n)
  {
    progress.report(0.3 + 0.7 * static_cast<double>(n) / static_cast<double>(parts),
                    "writing the scene");
    const std::uintmax_t offset = n * partBytes;
    bytes.resize(std::min(partBytes, file.size() - offset));
    readAt(file, offset, bytes);
    std::string payload = "petrous-scene " + std::to_string(kFormat) + " " + std::to_string(n + 1) +
                          " " + std::to_string(parts) + " " + std::to_string(offset) + " " +
                          std::to_string(bytes.size()) + " " + std::to_string(file.size()) + " " +
                          sha + "\n";
    payload.append(bytes.data(), bytes.size());
    if (payload.size() % 2 != 0)
      payload += '\0';

    DcmFileFormat content;
    DcmDataset& data = *content.getDataset();
    put(data, DCM_SpecificCharacterSet, "ISO_IR 192");
    put(data, DCM_SOPClassUID, UID_RawDataStorage);
    put(data, DCM_SOPInstanceUID, imaging::instanceUid(series, static_cast<int>(n)));
    put(data, DCM_StudyDate, "");
    put(data, DCM_StudyTime, "");
    // Required with a value, and when the scene was made is not told: a dummy (PS3.15 E.3), which
    // Documentation/user-guide.md states.
    put(data, DCM_ContentDate, "19000101");
    put(data, DCM_ContentTime, "000000");
    put(data, DCM_AccessionNumber, "");
    put(data, DCM_Modality, kSceneModality);
    put(data, DCM_Manufacturer, "Petrous");
    put(data, DCM_ReferringPhysicianName, "");
    put(data, DCM_SeriesDescription, kSceneDescription);
    put(data, DCM_BodyPartExamined, "SKULL"); // as the images: not a paired part, no laterality
    put(data, DCM_CreatorVersionUID, imaging::deterministicUid(0, "petrous-scene creator"));
    put(data, DCM_PatientName, description.patientName);
    put(data, DCM_PatientID, description.patientId);
    put(data, DCM_PatientBirthDate, "");
    put(data, DCM_PatientSex, ""); // not known; "O" would say that it is neither male nor female
    put(data, DCM_PatientIdentityRemoved, "YES");
    put(data, DCM_DeidentificationMethod, "written from voxels and geometry alone");
    DcmItem* code = nullptr; // PS3.16 CID 7050
    if (data.findOrCreateSequenceItem(DCM_DeidentificationMethodCodeSequence, code, 0).good())
    {
      put(*code, DCM_CodeValue, "113100");
      put(*code, DCM_CodingSchemeDesignator, "DCM");
      put(*code, DCM_CodeMeaning, "Basic Application Confidentiality Profile");
    }
    put(data, DCM_StudyInstanceUID, description.studyUid);
    put(data, DCM_SeriesInstanceUID, series);
    put(data, DCM_StudyID, description.studyId);
    put(data, DCM_SeriesNumber, std::to_string(description.seriesNumber));
    put(data, DCM_InstanceNumber, std::to_string(n + 1));
    data.insertEmptyElement(DCM_AcquisitionContextSequence);
    put(data, DCM_ContentLabel, "PETROUS");
    put(data, DCM_ContentDescription, "");
    data.putAndInsertString(DcmTag(kCreatorTag, EVR_LO), kCreator);
    if (data.putAndInsertUint8Array(DcmTag(kPartTag, DcmVR(EVR_OB)),
                                    reinterpret_cast<const Uint8*>(payload.data()),
                                    static_cast<unsigned long>(payload.size()))
            .bad())
      throw core::Error(core::Fault::Internal, "the scene's DICOM objects cannot be built");
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "scene-%04u.dcm", static_cast<unsigned>(n + 1));
    files.push_back(folder / name.data());
    save(content, files.back());
  }
  return files;
}

void readSceneObjects(const std::vector<fs::path>& files, const fs::path& archive,
                      const core::Progress& progress)
{
  std::vector<Part> parts;
  for (const fs::path& file : files)
  {
    DcmFileFormat content;
    parts.push_back(partOf(file, content));
  }
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.number < b.number; });
  std::uintmax_t next = 0;
  for (std::size_t n = 0; n < parts.size(); ++n)
  {
    const Part& part = parts[n];
    if (part.number != n + 1 || part.parts != parts.size() || part.offset != next ||
        part.total != parts.front().total || part.sha != parts.front().sha)
      throw core::InvalidParameter(sceneFault(std::to_string(parts.size()) + " of " +
                                              std::to_string(part.parts) +
                                              " parts are there, or they are not of one scene"));
    next += part.size;
  }
  if (parts.empty() || next != parts.front().total)
    throw core::InvalidParameter(sceneFault("parts are missing"));
  Digest digest;
  core::OutputFile out(archive);
  for (const Part& part : parts)
  {
    progress.report(static_cast<double>(part.offset) /
                        static_cast<double>(std::max<std::uintmax_t>(part.total, 1)),
                    "reading the scene");
    DcmFileFormat content;
    const Part again = partOf(part.file, content);
    std::size_t count = 0;
    const Uint8* bytes = bytesOf(*content.getDataset(), count);
    if (again.size != part.size || again.header != part.header)
      throw core::InvalidParameter(sceneFault("one changed while it was read"));
    digest.add(bytes + part.header, part.size);
    out.write(bytes + part.header, part.size);
  }
  if (digest.hexadecimal() != parts.front().sha)
    throw core::InvalidParameter(sceneFault("their content is damaged (SHA-256)"));
  out.commit();
}

} // namespace petrous::network
