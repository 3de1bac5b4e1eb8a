#include "petrous/Library/Deidentification.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include <sodium.h>

#include "DicomCleaner.h"
#include "FaceSlices.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/OwnerLock.h"

namespace petrous::library
{

namespace
{

namespace fs = std::filesystem;

void startSodium()
{
  if (::sodium_init() < 0)
    throw core::Error(core::Fault::Internal, "libsodium cannot be initialised");
}

template <std::size_t N>
std::array<unsigned char, N> keyedHash(const PseudonymKey::Bytes& key, const std::string& role,
                                       const std::string& text)
{
  const std::string whole = role + ":" + text;
  std::array<unsigned char, N> hash{};
  ::crypto_generichash(hash.data(), N, reinterpret_cast<const unsigned char*>(whole.data()),
                       whole.size(), key.data(), key.size());
  return hash;
}

std::string numbered(std::size_t number, int digits)
{
  std::string text = std::to_string(number);
  const auto width = static_cast<std::size_t>(digits);
  return std::string(text.size() < width ? width - text.size() : 0, '0') + text;
}

// Regular files below a folder, sorted; or the file itself. Of folders behind links, too; none
// twice.
std::vector<fs::path> filesOf(const fs::path& input)
{
  std::error_code error;
  if (!fs::is_directory(input, error))
    return {core::InputFile(input).path()}; // throws what is wrong with it
  std::vector<fs::path> files;
  std::set<fs::path> seen{fs::canonical(input, error)};
  fs::recursive_directory_iterator entry(input, fs::directory_options::follow_directory_symlink,
                                         error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error))
    if (std::error_code ignored; entry->is_regular_file(ignored))
      files.push_back(entry->path());
    else if (entry->is_directory(ignored) &&
             !seen.insert(fs::canonical(entry->path(), ignored)).second)
      entry.disable_recursion_pending();
  if (error)
    throw core::InputFileError(core::InputFileError::Reason::Unreadable, input,
                               "a folder in it cannot be read");
  std::sort(files.begin(), files.end());
  return files;
}

bool isWithin(const fs::path& inner, const fs::path& outer)
{
  const fs::path a = fs::weakly_canonical(inner), b = fs::weakly_canonical(outer);
  return std::mismatch(b.begin(), b.end(), a.begin(), a.end()).first == b.end();
}

std::vector<std::string> namesOf(const DeidentificationOptions& options)
{
  using Dates = DeidentificationOptions::Dates;
  std::vector<std::string> names{"Basic Application Confidentiality Profile"};
  if (options.cleanDescriptors)
    names.emplace_back("Clean Descriptors");
  if (options.dates == Dates::Keep)
    names.emplace_back("Retain Longitudinal Temporal Information, Full Dates");
  if (options.dates == Dates::Shift)
    names.emplace_back("Retain Longitudinal Temporal Information, Modified Dates");
  if (options.retainPatientCharacteristics)
    names.emplace_back("Retain Patient Characteristics");
  if (options.retainDevice)
    names.emplace_back("Retain Device Identity");
  if (options.retainSafePrivate)
    names.emplace_back("Retain Safe Private");
  if (options.maskFace)
    names.emplace_back("Clean Recognizable Visual Features");
  return names;
}

void fill(DeidentificationResult& result, const DicomCleaner& cleaner,
          const DeidentificationOptions& options)
{
  DeidentificationReport& report = result.report;
  report.edition = cleaner.profile.edition();
  report.options = namesOf(options);
  for (const auto& [key, done] : cleaner.done)
    report.lines.push_back({key.first, done.name, done.action, done.files, done.stays});
  report.warnings = cleaner.warnings;
  std::set<std::string> patients;
  for (const auto& [key, pseudonym] : cleaner.pseudonyms)
  {
    if (pseudonym.kind == "patient")
      patients.insert(pseudonym.pseudonym);
    result.pseudonyms.push_back(pseudonym);
  }
  report.patients = patients.size();
}

} // namespace

PseudonymKey::PseudonymKey()
{
  startSodium();
  ::randombytes_buf(m_bytes.data(), m_bytes.size());
}

PseudonymKey::~PseudonymKey()
{
  ::sodium_memzero(m_bytes.data(), m_bytes.size());
}

std::string PseudonymKey::uid(const std::string& uid) const
{
  auto uuid = keyedHash<16>(m_bytes, "uid", uid);
  uuid[6] = static_cast<unsigned char>((uuid[6] & 0x0fU) | 0x80U); // version 8, RFC 9562
  uuid[8] = static_cast<unsigned char>((uuid[8] & 0x3fU) | 0x80U);
  std::string decimal;
  while (std::any_of(uuid.begin(), uuid.end(), [](unsigned char byte) { return byte != 0; }))
  {
    unsigned rest = 0;
    for (unsigned char& byte : uuid)
    {
      const unsigned value = rest << 8 | byte;
      byte = static_cast<unsigned char>(value / 10);
      rest = value % 10;
    }
    decimal += static_cast<char>('0' + rest);
  }
  std::reverse(decimal.begin(), decimal.end());
  return "2.25." + decimal;
}

std::string PseudonymKey::patient(const std::string& patientId) const
{
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string text = "P-";
  for (const unsigned char byte : keyedHash<16>(m_bytes, "patient", patientId))
  {
    if (text.size() >= 14)
      break;
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

int PseudonymKey::daysEarlier(const std::string& patientId) const
{
  const auto hash = keyedHash<16>(m_bytes, "days", patientId);
  return 1 + (hash[0] | hash[1] << 8 | hash[2] << 16) % 3650;
}

std::string DeidentificationReport::text() const
{
  std::string text = "De-identified by " + edition + "\n";
  for (const std::string& option : options)
    text += "- " + option + "\n";
  text += std::to_string(filesWritten) + " files of " + std::to_string(patients) +
          (patients == 1 ? " patient" : " patients") + "\n";
  for (const auto& [why, files] : leftOut)
    text += "left out: " + std::to_string(files) + " files: " + why + "\n";
  for (const auto& [what, files] : warnings)
    text += "warning: " + std::to_string(files) + " files: " + what + "\n";
  for (const bool stays : {true, false})
  {
    text += stays ? "\nStays, and why\n" : "\nRemoved or replaced\n";
    for (const Line& line : lines)
      if (line.stays == stays)
        text += line.attribute + " " + line.name + ": " + line.action + " (" +
                std::to_string(line.files) + " files)\n";
  }
  return text;
}

namespace
{

// What a killed run left beside its output, or in an output folder that was there: a folder of
// series, or a DICOM file without a preamble.
bool isOwnLeftover(const fs::path& path, bool isInOutput)
{
  constexpr std::size_t kPreamble = 128;
  std::error_code error;
  if (!core::isLeftover(path))
    return false;
  if (fs::is_directory(fs::symlink_status(path, error)))
  {
    bool isOwn = true, isEmpty = true;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error))
    {
      isEmpty = false;
      isOwn = isOwn && entry->path().filename().string().rfind("series-", 0) == 0;
    }
    return !error && isOwn && (!isEmpty || isInOutput);
  }
  if (!fs::is_regular_file(fs::symlink_status(path, error)))
    return false;
  std::string start(kPreamble + 4, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  const auto count = static_cast<std::size_t>(file.gcount());
  return count > 0 &&
         start.substr(0, count) == (std::string(kPreamble, '\0') + "DICM").substr(0, count);
}

/// The folder in which a folder of output grows, and its lock.
struct Staging
{
  explicit Staging(const fs::path& output)
  {
    constexpr int kAttempts = 10;
    for (int n = 0; n < kAttempts && (!lock || !lock->isThere()); ++n)
    {
      lock.reset();
      folder = std::make_unique<core::OutputFolder>(output);
      lock = std::make_unique<OwnerLock>(folder->path());
    }
  }

  std::unique_ptr<core::OutputFolder> folder;
  std::unique_ptr<OwnerLock> lock;
};

void removeLeftovers(const fs::path& output)
{
  std::error_code error;
  const fs::path whole = fs::absolute(output, error).lexically_normal();
  const fs::path target = whole.has_filename() ? whole : whole.parent_path();
  if (fs::is_directory(target, error))
    removeAbandoned(target, [](const fs::path& path) { return isOwnLeftover(path, true); });
  removeAbandoned(target.parent_path(),
                  [](const fs::path& path) { return isOwnLeftover(path, false); });
}

} // namespace

DeidentificationResult deidentify(const fs::path& input, const fs::path& output,
                                  const DeidentificationOptions& options, const PseudonymKey& key,
                                  const core::Progress& whole,
                                  const std::function<void(const std::vector<Pseudonym>&)>& keep)
{
  startSodium();
  std::error_code error;
  const bool isFolder = fs::is_directory(input, error);
  if (isWithin(output, input) || (isFolder && isWithin(input, output)))
    throw core::Error(core::Fault::Refused,
                      core::printable(output) +
                          ": lies within the input; name a place outside of it");
  const std::vector<fs::path> files = filesOf(input);
  removeLeftovers(output);
  DicomCleaner cleaner(options, key);
  if (options.maskFace)
    cleaner.faces = std::make_shared<const FaceSlices>(input, whole.part(0.0, 0.5));
  const core::Progress progress = options.maskFace ? whole.part(0.5, 1.0) : whole;
  DeidentificationResult result;
  const auto noteLeftOut = [&result](const fs::path& file, const std::string& why)
  {
    ++result.report.leftOut[why];
    result.leftOut.push_back(core::printable(file) + ": " + why);
  };
  const auto nothing = [&]
  {
    return core::Error(core::Fault::BadInput,
                       core::printable(input) + ": holds no DICOM file that can be de-identified" +
                           (result.leftOut.empty()
                                ? std::string()
                                : "; the first " + result.report.leftOut.begin()->first));
  };

  if (!isFolder)
  {
    std::optional<core::OutputFile> out; // not before there is something to write
    const auto outcome = cleaner.clean(input,
                                       [&](const std::string&, const std::string&)
                                       {
                                         out.emplace(output);
                                         return out->temporary();
                                       });
    if (!outcome.leftOut.empty())
    {
      noteLeftOut(input, outcome.leftOut);
      throw core::Error(core::Fault::BadInput, result.leftOut.front());
    }
    progress.check("de-identification");
    fill(result, cleaner, options);
    if (keep)
      keep(result.pseudonyms);
    result.report.durable = out->commit();
    result.report.filesWritten = 1;
    return result;
  }

  const Staging staging(output);
  core::OutputFolder& out = *staging.folder;
  struct Series
  {
    std::size_t number = 0, files = 0;
    fs::path folder; ///< by the modality of its first file
  };
  std::map<std::string, Series> series;
  for (std::size_t n = 0; n < files.size(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(files.size()),
                    "de-identifying " + std::to_string(n + 1) + " of " +
                        std::to_string(files.size()) + " files");
    const auto placed = [&](const std::string& uid, const std::string& modality)
    {
      const auto [entry, isNew] = series.emplace(uid, Series{series.size() + 1, 0, {}});
      if (isNew)
      {
        entry->second.folder = out.path() / ("series-" + numbered(entry->second.number, 3));
        if (!modality.empty() && modality.size() <= 4)
          entry->second.folder += "-" + modality;
        fs::create_directory(entry->second.folder);
      }
      return entry->second.folder / (numbered(++entry->second.files, 5) + ".dcm");
    };
    const auto outcome = cleaner.clean(files[n], placed);
    if (outcome.leftOut.empty())
      ++result.report.filesWritten;
    else
      noteLeftOut(files[n], outcome.leftOut);
  }
  if (result.report.filesWritten == 0)
    throw nothing();
  fill(result, cleaner, options);
  if (keep)
    keep(result.pseudonyms);
  result.report.durable = out.commit();
  return result;
}

} // namespace petrous::library
