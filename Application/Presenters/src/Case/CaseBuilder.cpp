#include "petrous/Presenters/CaseBuilder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include <Eigen/Geometry>

#include "BoxOnGrid.h"
#include "CorrectAxes.h"
#include "MeshForm.h"
#include "MeshSpace.h"
#include "PatientHashes.h"
#include "ThinSeries.h"
#include "petrous/Appearance/DistinctColors.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/Fingerprint.h"
#include "petrous/Core/Log.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/ImagePreview.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/StructureSet.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Scene/Description.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/PlainText.h"
#include "petrous/Volume/IntensityScale.h"
#include "petrous/Volume/MeshSolid.h"
#include "petrous/Volume/OnGrid.h"

namespace petrous::presenters
{

namespace fs = std::filesystem;

namespace
{

constexpr std::array<float, 3> kMrColor{0.80F, 0.80F, 0.80F}; // of its surface, which is not bone

// The catalogue, which is long: names are looked up in it one by one.
const appearance::StructurePresets& builtInPresets()
{
  static const auto kPresets = appearance::StructurePresets::builtIn();
  return kPresets;
}

// Tells of a name whether a part of the case reads as it does.
auto isInCase(const scene::Case& value)
{
  return [&value](const std::string& name) { return !scene::partReadAs(value, name).empty(); };
}

// Names, by what is read of them (scene::asRead).
class ReadNames
{
public:
  void add(const std::string& name) { m_read.insert(scene::asRead(name)); }
  bool has(const std::string& name) const { return m_read.count(scene::asRead(name)) > 0; }

  // scene::freeName, for many of one name: none is let go of, so the numbers before the last are
  // taken.
  std::string freeName(const std::string& wanted)
  {
    std::string name = wanted;
    for (int& last = m_last[wanted]; has(name);)
      name = wanted + " " + std::to_string(last = std::max(last + 1, 2));
    return name;
  }

private:
  std::set<std::string> m_read;
  std::map<std::string, int> m_last; // the last number given to a name
};

// A part's name derived from its file name if none was given; what is left out of it is noted.
template <class IsTaken>
std::string nameFromFile(const fs::path& path, const std::string& otherwise, const IsTaken& isTaken,
                         std::vector<std::string>& notes)
{
  const FileName file = fileName(path);
  if (file.isWhole)
    return file.name;
  notes.push_back("named so and not as its file, whose name may be a patient's; NAME=FILE gives "
                  "another name");
  return scene::freeName(file.name.empty() ? otherwise : file.name, isTaken);
}

// The reader knows the series; the user knows the path.
volume::IntensityVolume readNamed(const fs::path& path, const imaging::DicomSeries& series,
                                  const imaging::ReadOptions& options,
                                  const core::Progress& progress, std::vector<std::string>& notes,
                                  volume::ImageProvenance& provenance)
{
  const auto named = [&path](const std::string& what)
  { return what.rfind(path.string(), 0) == 0 ? what : path.string() + ": " + what; };
  try
  {
    return imaging::readSeries(series, options, progress, &notes, &provenance);
  }
  catch (const imaging::BitsUnclearError& error)
  {
    throw imaging::BitsUnclearError(named(error.what()), error.canKeep);
  }
  catch (const imaging::DicomError& error)
  {
    std::string what = error.what();
    if (error.reason() == imaging::DicomError::Reason::Misleading)
      what += series.geometry.verdict == imaging::Verdict::Repairable
                  ? " With --repair it is resampled to a straight volume."
                  : " Give a series that 'petrous scan' finds ok.";
    throw imaging::DicomError(error.reason(), named(what));
  }
}

// A UID identifies the patient to anyone with access to the hospital's archive; a hash still allows
// comparison.
std::string withoutIdentity(const std::string& uid)
{
  if (uid.empty())
    return {};
  return library::sha256Of(reinterpret_cast<const std::uint8_t*>(uid.data()), uid.size());
}

std::string withoutIdentity(std::size_t key, std::size_t with = 0)
{
  return key == 0
             ? std::string()
             : withoutIdentity(std::to_string(key) + (with == 0 ? "" : " " + std::to_string(with)));
}

std::vector<std::size_t> foldedPartsOf(const imaging::PatientKey& key)
{
  std::vector<std::size_t> parts;
  std::copy_if(key.foldedParts.begin(), key.foldedParts.end(), std::back_inserter(parts),
               [](std::size_t part) { return part != 0; });
  return parts;
}

std::vector<std::string> foldedHashes(const imaging::PatientKey& key)
{
  std::vector<std::string> hashes;
  for (const std::size_t part : foldedPartsOf(key))
    hashes.push_back(withoutIdentity(part));
  return hashes;
}

// Of all of these parts, in any order. Empty: there are none.
std::string spellingHash(std::vector<std::size_t> parts)
{
  std::sort(parts.begin(), parts.end());
  std::string text = "name";
  for (const std::size_t part : parts)
    text += " " + std::to_string(part);
  return parts.empty() ? std::string() : withoutIdentity(text);
}

// With the ID, which is equal where the name is spelled otherwise.
std::string birthHash(const imaging::PatientKey& key)
{
  return key.id == 0 || key.joinedName == 0 || key.birthDate == 0
             ? std::string()
             : withoutIdentity(key.birthDate, key.id);
}

} // namespace

scene::PatientHash patientHash(const imaging::PatientKey& key)
{
  // Of a date alone there are too few to hide it in a hash.
  scene::PatientHash hash{withoutIdentity(key.id), withoutIdentity(key.issuer),
                          withoutIdentity(key.name),
                          key.name == 0 ? std::string() : withoutIdentity(key.birthDate, key.name)};
  for (const std::size_t part : key.nameParts)
    if (part != 0)
      hash.nameParts.push_back(withoutIdentity(part));
  const auto add = [&hash](const std::string& one)
  {
    if (!one.empty() &&
        std::find(hash.nameParts.begin(), hash.nameParts.end(), one) == hash.nameParts.end())
      hash.nameParts.push_back(one);
  };
  for (const std::string& part : foldedHashes(key))
    add(part);
  add(spellingHash(foldedPartsOf(key)));
  add(withoutIdentity(key.joinedName));
  add(birthHash(key));
  return hash;
}

namespace
{

// What its slices state of the patient, all the same where they do (imaging::assess).
imaging::PatientKey patientOf(const imaging::DicomSeries& series)
{
  imaging::PatientKey all;
  const auto take = [](std::size_t& key, std::size_t stated) { key = key == 0 ? stated : key; };
  for (const imaging::SliceHeader& slice : series.geometry.slices)
  {
    if (all.id == 0) // with the issuer that it has there: another one's makes it another ID
      all.issuer = slice.patient.issuer;
    take(all.id, slice.patient.id);
    if (all.name == 0)
    {
      all.nameParts = slice.patient.nameParts;
      all.foldedParts = slice.patient.foldedParts;
      all.joinedName = slice.patient.joinedName;
    }
    take(all.name, slice.patient.name);
    take(all.birthDate, slice.patient.birthDate);
  }
  return all;
}

// Of an image that states but the pseudonym of a case (imaging/CasePatient.h).
bool isOfCase(const scene::PatientHash& patient)
{
  return patient.id.empty() && patient.name.empty() && patient.nameParts.size() == 1;
}

// Whether two names of one ID and date of birth are spellings of one: equal without accents, or one
// has words that the other has not. Not known of a case that an earlier version imported.
bool isRespelled(const scene::ImagePart& image, const imaging::PatientKey& added,
                 const scene::IdentitySalt& salted)
{
  const std::vector<std::string>& all = image.patient.nameParts;
  const auto isKept = [&](const std::string& hash)
  {
    return !hash.empty() && std::find(all.begin(), all.end(),
                                      image.isFrameSalted ? salted(hash) : hash) != all.end();
  };
  if (!isKept(birthHash(added)))
    return false;
  if (isKept(withoutIdentity(added.joinedName)))
    return true;
  const std::vector<std::string> hashes = foldedHashes(added);
  if (!hashes.empty() && std::all_of(hashes.begin(), hashes.end(), isKept))
    return true;
  const std::vector<std::size_t> parts = foldedPartsOf(added);
  for (std::size_t chosen = 1; chosen < std::size_t{1} << parts.size(); ++chosen)
  {
    std::vector<std::size_t> some;
    for (std::size_t n = 0; n < parts.size(); ++n)
      if ((chosen >> n & 1) != 0)
        some.push_back(parts[n]);
    if (isKept(spellingHash(std::move(some))))
      return true;
  }
  return false;
}

// In what the patients that the images state differ; in nothing if that cannot be told.
imaging::PatientDifferences differencesOf(const scene::ImagePart& image,
                                          const imaging::PatientKey& key,
                                          const scene::IdentitySalt& salted)
{
  imaging::PatientDifferences differing;
  if (!scene::isComparable(image, salted))
    return differing;
  scene::ImagePart added;
  added.patient = patientHash(key);
  if (image.isFrameSalted)
    scene::saltIdentity(added, salted);
  if (isOfCase(image.patient) && isOfCase(added.patient))
    differing.name = image.patient.nameParts != added.patient.nameParts;
  else
    differing = imaging::differencesOf(image.patient, added.patient);
  const auto& [one, other] = std::tie(image.patient, added.patient);
  const bool isOneIssuer = one.issuer.empty() || other.issuer.empty() || one.issuer == other.issuer;
  if (differing.name && one.id == other.id && isOneIssuer && isRespelled(image, key, salted))
    differing = {};
  return differing;
}

// Without values, which are the patient's. The hash of a date of birth has the name in it, and
// tells nothing where the names differ.
std::string differenceText(const imaging::PatientDifferences& differing)
{
  const auto& [id, name, birthDate] = differing;
  if (id && name)
    return "patient ID and patient name";
  if (id)
    return birthDate ? "patient ID and date of birth" : "patient ID";
  return name ? "patient name" : "date of birth";
}

// Whether what is added states another patient than an image of the case; refused unless its source
// allows it.
bool isOfOtherPatient(const scene::Case& value, const PartSource& source,
                      const imaging::PatientKey& patient, const scene::IdentitySalt& salted)
{
  imaging::PatientDifferences differing = differencesOf(value.ct, patient, salted);
  for (const scene::ImagePart& mr : value.mr)
    differing.join(differencesOf(mr, patient, salted));
  if (differing.any() && !source.isOtherPatient)
    throw OtherPatient(source.path, differing);
  return differing.any();
}

void noteLostSalt(const scene::Case& value, const scene::PatientHash& patient,
                  const scene::IdentitySalt& salted, std::vector<std::string>& notes)
{
  if (!patient.empty() && salted && library::hasLostSalt(value, salted))
    notes.push_back("Whether it is of the patient of the case's images is not known: the library's "
                    "salt, with which their patients' hashes were made, was lost; look whether it "
                    "is");
}

// An MR is not taken silently in the place of a CT that cannot be used.
void refuseMrBesideCt(const imaging::ScanResult& scan, const fs::path& path)
{
  constexpr std::size_t kScouts = 2; // slices
  for (const imaging::DicomSeries& series : scan.series)
    if (series.modality == "CT" && imaging::imageCount(series) > kScouts)
      throw imaging::DicomError(
          imaging::DicomError::Reason::Ambiguous,
          path.string() + ": its CT cannot be used" +
              (series.geometry.findings.empty() ? std::string()
                                                : ": " + series.geometry.findings.front().text) +
              " Only an MR can; name its series (--series, 'petrous scan' lists them) for a case "
              "of the MR alone");
}

// What else of the same modality a folder has; empty: nothing. Without UIDs and descriptions, which
// identify the patient.
std::string notTaken(const imaging::ScanResult& scan, const imaging::DicomSeries& series)
{
  std::vector<std::string> others;
  for (const imaging::DicomSeries* other : imaging::otherImages(scan, series))
  {
    if (other->modality != series.modality)
      continue;
    const imaging::SeriesGeometry& geometry = other->geometry;
    std::string one = std::to_string(imaging::imageCount(*other)) + " slices";
    if (geometry.grid)
      one += " of " + core::plainText(geometry.grid->spacing()[2]) + " mm";
    others.push_back(one + (geometry.verdict == imaging::Verdict::Ok           ? ""
                            : geometry.verdict == imaging::Verdict::Repairable ? " (needs --repair)"
                                                                               : " (refused)"));
  }
  if (others.empty())
    return {};
  std::string text = others.size() == 1 ? "The folder has another " : "The folder has other ";
  text += series.modality + (others.size() == 1 ? " of " : "s, of ");
  for (std::size_t n = 0; n < others.size(); ++n)
    text += (n == 0 ? "" : ", ") + others[n];
  return text + ", which was not taken; 'petrous scan' lists them, --series takes one.";
}

// A code string of a file (PS3.5 6.2), which may stand in a note; any other text may be a name.
std::string codeText(const std::string& text)
{
  const auto isCode = [](unsigned char c)
  { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
  constexpr std::size_t kLongest = 16;
  return text.size() <= kLongest && std::all_of(text.begin(), text.end(), isCode) ? text
                                                                                  : "unknown";
}

// A unit of a file, which may stand in a note if it is one.
std::string unitText(const std::string& unit)
{
  static const char* const kUcum[] = {"1",           "%",         "ms",
                                      "s",           "/s",        "1/s",
                                      "/min",        "mm2/s",     "um2/s",
                                      "ml/g",        "g/ml",      "mg/ml",
                                      "Bq/ml",       "kPa",       "10-6.mm2/s",
                                      "10*-6.mm2/s", "ml/min/ml", "ml/100ml/min",
                                      "ug/ml",       "ml/ml",     "ml/(100.ml.min)"};
  return std::find(std::begin(kUcum), std::end(kUcum), unit) != std::end(kUcum) ? unit
                                                                                : codeText(unit);
}

// Why the values of a series are not the intensities of a CT or MR.
struct OtherQuantity
{
  std::string why;            // empty: they may be
  bool isUnspecified = false; // they may be Hounsfield units all the same
};

// X-ray volumes (cone beam) are CTs under other names, of old converters too.
OtherQuantity otherQuantity(const imaging::DicomSeries& series)
{
  static const char* const kImages[] = {"", "CT", "MR", "DX", "XA", "RF", "PX", "IO", "RG", "OT"};
  if (std::find(std::begin(kImages), std::end(kImages), series.modality) == std::end(kImages))
    return {"The file says that it is neither a CT nor an MR, but of modality " +
            codeText(series.modality) + "."};
  if (series.modality == "MR")
    return {};
  const auto& slices = series.geometry.slices; // of one type, some without
  const auto stated = std::find_if(slices.begin(), slices.end(),
                                   [](const auto& slice) { return !slice.rescaleType.empty(); });
  if (stated == slices.end() || stated->rescaleType == "HU")
    return {};
  if (stated->rescaleType == "US") // PS3.3 C.11.1.1.2
    return {"The file says that its values are of an unspecified type (US), and not that they are "
            "Hounsfield units.",
            true};
  return {"The file says that its values are no Hounsfield units, but of the type " +
          unitText(stated->rescaleType) + "."};
}

struct ReadImage
{
  scene::ImagePart part;
  imaging::PatientKey patient; // whose it is, before it is hashed
  OtherQuantity otherQuantity;
  /// Of the whole image where the part is a box of it.
  std::optional<volume::IntensityHistogram> whole = std::nullopt;
  bool isHounsfield = false; // as its file states, which this program wrote
  bool isCalibrated = false; // likewise, or the slices of a helical CT
};

// Of every few of all slices, as a box may have neither air nor soft tissue, by which values are
// judged. Empty if they cannot be read: the box is then judged alone.
std::optional<volume::IntensityHistogram>
histogramOf(const std::function<volume::IntensityVolume(std::size_t)>& readFew)
{
  constexpr std::size_t kFew = 32; // slices
  try
  {
    return volume::IntensityHistogram(readFew(kFew));
  }
  catch (const core::Error& error)
  {
    if (error.fault() == core::Fault::Cancelled)
      throw;
    return std::nullopt;
  }
}

std::optional<volume::IntensityHistogram> histogramOf(const imaging::DicomSeries& series,
                                                      const core::Progress& progress)
{
  return histogramOf(
      [&](std::size_t count)
      {
        imaging::ReadOptions options;
        options.acceptDefects = true; // where a slice lies does not matter here
        options.undeclaredBits = imaging::UndeclaredBits::LeaveOut;
        return imaging::readSeries(thinSeries(series, count), options, progress);
      });
}

// Before minutes of reading. `option`: as ImageSideUnclear.
void requireSide(const fs::path& path, const std::optional<bool>& assumeRas,
                 const std::string& option)
{
  if (!assumeRas && !fs::is_directory(path) &&
      imaging::isReadAs(path, imaging::kImage | imaging::kLabels) && imaging::assumedRasOf(path))
    throw ImageSideUnclear(path, option);
}

// Likewise.
void requireUnit(const fs::path& path, const std::optional<double>& unit, const std::string& option)
{
  if (unit || fs::is_directory(path) ||
      !imaging::isReadAs(path, imaging::kImage | imaging::kLabels))
    return;
  if (const imaging::UnitDoubt doubt = imaging::unitDoubtOf(path); !doubt.likely.empty())
    throw ImageUnitUnclear(path, doubt, option);
}

imaging::ReadOptions optionsOf(bool repair, const std::optional<core::PatientBox>& roi,
                               imaging::UndeclaredBits undeclared)
{
  imaging::ReadOptions options;
  options.repair = repair;
  options.roi = roi;
  options.undeclaredBits = undeclared;
  return options;
}

// Where its file has it.
core::GridGeometry statedGrid(const scene::ImagePart& image)
{
  return image.provenance.axes.inverse().applied(image.geometry);
}

// Whether two grids have the same voxels, with their axes in any order and direction.
bool haveSameVoxels(const core::GridGeometry& a, const core::GridGeometry& b)
{
  constexpr double kNear = 1e-3; // mm, as core::sameGrid
  const auto along = [](const core::GridGeometry& grid, int axis)
  {
    return Eigen::Vector3d(grid.patientFromVoxelLinear().col(axis) *
                           grid.dims()[static_cast<std::size_t>(axis)]);
  };
  const auto isAxisOfB = [&](int axis)
  {
    const Eigen::Vector3d of = along(a, axis);
    for (int other = 0; other < 3; ++other)
      if (const Eigen::Vector3d one = along(b, other);
          a.dims()[static_cast<std::size_t>(axis)] == b.dims()[static_cast<std::size_t>(other)] &&
          std::min((of - one).norm(), (of + one).norm()) <= kNear)
        return true;
    return false;
  };
  return (a.center() - b.center()).norm() <= kNear && isAxisOfB(0) && isAxisOfB(1) && isAxisOfB(2);
}

// Of the image, as it is or as its file states it: where these are two, the order and direction of
// the axes tell them apart.
bool hasGridOf(const scene::ImagePart& image, const core::GridGeometry& grid)
{
  return core::sameGrid(grid, image.geometry) ||
         (image.provenance.axes.isIdentity() ? haveSameVoxels(grid, image.geometry)
                                             : core::sameGrid(grid, statedGrid(image)));
}

std::vector<std::string> mrOfGrid(const scene::Case& value, const core::GridGeometry& grid)
{
  std::vector<std::string> names;
  for (const scene::ImagePart& mr : value.mr)
    if (hasGridOf(mr, grid))
      names.push_back(mr.name);
  return names;
}

// `isPrimary`: of a case. `assumeRas`, `axes`: as CaseSources.
ReadImage readImage(const fs::path& path, const std::string& selector,
                    const imaging::ReadOptions& options, bool isPrimary,
                    const std::optional<bool>& assumeRas, const std::optional<double>& unit,
                    const core::AxesCorrection& axes, const core::Progress& progress)
{
  ReadImage read;
  scene::ImagePart& part = read.part;
  if (!fs::is_directory(path) && imaging::isReadAs(path, imaging::kImage | imaging::kLabels))
  {
    auto image = imaging::readImageFile(path, options.roi, progress, assumeRas,
                                        imaging::volumeNumber(path, selector), unit);
    part.volume = image.volume;
    part.notes = std::move(image.notes);
    part.provenance.assumedRas = image.assumedRas;
    read.isHounsfield = image.isHounsfield;
    if (isPrimary && options.roi && !read.isHounsfield)
      read.whole = histogramOf(
          [&](std::size_t count)
          {
            return *imaging::previewImageFile(path, count, progress, assumeRas, 0,
                                              imaging::volumeNumber(path, selector), unit)
                        .volume;
          });
  }
  else
  {
    const auto scan = imaging::scanDicom(path, progress.part(0.0, 0.2), library::scanCache().get());
    const auto& series = imaging::chooseSeries(scan, path, selector);
    if (isPrimary && selector.empty() && series.modality == "MR")
      refuseMrBesideCt(scan, path);
    std::vector<std::string> notes = series.geometry.notes;
    for (const imaging::Finding& finding : series.geometry.findings) // accepted
      if (finding.kind != imaging::FindingKind::Unreadable &&
          finding.kind != imaging::FindingKind::NoGeometry) // these name files
        notes.push_back(finding.text);
    // What this series lost is one of its findings.
    if (scan.lostFiles > 0 && series.lostFiles == 0)
      notes.push_back("The index of the disc (DICOMDIR) lists " + std::to_string(scan.lostFiles) +
                      (scan.lostFiles == 1 ? " file of another series that is"
                                           : " files of other series that are") +
                      " not there: what they showed is missing from this copy of the disc.");
    if (!scan.notes.empty()) // which name files and folders, possibly after patients
      notes.push_back("Of what lies beside its slices, something was left out in " +
                      std::to_string(scan.notes.size()) +
                      (scan.notes.size() == 1 ? " place" : " places") +
                      "; 'petrous scan' says what.");
    if (const std::string left = selector.empty() ? notTaken(scan, series) : std::string();
        !left.empty())
      notes.push_back(left);
    part.volume = std::make_shared<const volume::IntensityVolume>(
        readNamed(path, series, options, progress.part(0.2, 0.9), notes, part.provenance));
    part.notes = std::move(notes);
    part.frameOfReference = withoutIdentity(series.frameOfReferenceUid);
    read.patient = patientOf(series);
    part.patient = patientHash(read.patient);
    read.otherQuantity = otherQuantity(series);
    read.isCalibrated = std::all_of(series.geometry.slices.begin(), series.geometry.slices.end(),
                                    [](const auto& slice) { return slice.isCalibrated; });
    if (isPrimary && options.roi)
      read.whole = histogramOf(series, progress.part(0.9, 1.0));
    part.modality = series.modality == "MR"   ? scene::Modality::Mr
                    : series.modality == "CT" ? scene::Modality::Ct
                                              : scene::Modality::Unknown;
  }
  const auto image = part.volume.get();
  part.geometry = image->geometry();
  part.range = image->range();
  correctAxes(part, axes);
  const auto& n = part.geometry.dims();
  const auto& h = part.geometry.spacing();
  core::log::info("import: image of " + std::to_string(n[0]) + " x " + std::to_string(n[1]) +
                  " x " + std::to_string(n[2]) + " voxels of " + core::plainText(h[0]) + " x " +
                  core::plainText(h[1]) + " x " + core::plainText(h[2]) + " mm, " +
                  std::to_string(part.notes.size()) + " notes");
  return read;
}

// An image that shows nothing is refused, and one that shows little is noted. `roi`: it is cut, as
// asked, and neither.
void judgeContents(const fs::path& path, scene::ImagePart& image, bool roi)
{
  if (!(image.range.min < image.range.max) && !roi)
    throw core::InvalidParameter(path.string() + ": every voxel that is no padding has the value " +
                                 core::plainText(image.range.min, 6) +
                                 "; an image of one single value shows nothing");
  constexpr int kFew = 10;
  const int slices = image.geometry.dims()[2];
  const double covered = slices * image.geometry.spacing()[2];
  if (slices < kFew && !roi)
    image.notes.push_back("The image has only " + std::to_string(slices) + " slices, which cover " +
                          core::fixedText(covered, 1) +
                          " mm; look whether all that is needed is in it.");
}

// Also of units of its own: no detector tells so many apart.
void noteBeyondCt(scene::ImagePart& image)
{
  constexpr double kLowest = -10000.0;
  constexpr double kHighest = 100000.0;
  if (image.range.min < kLowest || image.range.max > kHighest)
    image.notes.push_back("Its values go from " + core::plainText(image.range.min, 6) + " to " +
                          core::plainText(image.range.max, 6) +
                          ", beyond those of any CT (-10000 to 100000): voxels are damaged, or the "
                          "slope that the file states is wrong.");
}

// Whether its values may be Hounsfield units that its histogram does not show.
bool mayBePart(const volume::IntensityHistogram& histogram)
{
  constexpr volume::ValueRange kHounsfield{-1150.0, 4100.0}; // with metal in 12 bits
  constexpr double kBone = volume::IntensityScale{}.iso;
  const volume::ValueRange& range = histogram.range();
  return range.min >= kHounsfield.min && range.max <= kHounsfield.max && range.max > kBone;
}

// Cone-beam and micro-CT have units of their own, in which 300 may be air or nothing at all; an MR
// always has, and shows no surface of bone.
void placeSurface(scene::Case& value, scene::Modality wanted, const ReadImage& read)
{
  const OtherQuantity& other = read.otherQuantity;
  using scene::Modality;
  scene::ImagePart& image = value.ct;
  const bool isStated = image.modality != Modality::Unknown;
  if (wanted != Modality::Unknown && isStated && wanted != image.modality)
    image.notes.push_back(std::string("The file says that it is ") +
                          (image.modality == Modality::Mr ? "an MR" : "a CT") +
                          "; it is taken for " + (wanted == Modality::Mr ? "an MR" : "a CT") +
                          ", as asked.");
  if (wanted != Modality::Unknown)
    image.modality = wanted;
  const volume::IntensityHistogram histogram =
      read.whole ? *read.whole : volume::IntensityHistogram(*image.volume.get());
  if (image.modality == Modality::Mr)
  {
    const auto scale = volume::suggestMrScale(histogram);
    value.iso = scale.iso;
    value.denseBone = scale.dense;
    value.boneLook.color = kMrColor;
    image.notes.push_back(
        "An MR shows no bone: its intensities are not Hounsfield units, and bone is as dark as air "
        "in it. The "
        "surface is where tissue begins, put at " +
        core::plainText(scale.iso, 4) +
        " by the image's histogram; what is drilled is this tissue, not bone. 'petrous appearance "
        "--iso' moves the surface.");
    return;
  }
  const bool isOther = !other.why.empty() && wanted == Modality::Unknown;
  if (isOther && !other.isUnspecified)
  {
    const auto scale = volume::suggestMrScale(histogram);
    value.iso = scale.iso;
    value.denseBone = scale.dense;
    image.notes.push_back(other.why +
                          " It is shown as it is: nothing in it is known to be bone, and the "
                          "surface is put at " +
                          core::plainText(scale.iso, 4) +
                          " by the image's histogram; 'petrous appearance --iso' moves it. Build "
                          "the case with --modality CT if it is a CT in Hounsfield units all the "
                          "same.");
    return;
  }
  noteBeyondCt(image);
  constexpr double kBelowZero = -30.0; // HU; nothing of an image whose air is at 0
  auto scale = read.isHounsfield ? volume::IntensityScale() : volume::suggestScale(histogram);
  const bool isBelieved = read.isCalibrated && !isOther && !scale.calibrated && !scale.soft &&
                          mayBePart(histogram) && histogram.range().min < kBelowZero;
  if (isBelieved)
    scale = {};
  if (scale.calibrated && isOther)
  {
    // Bone looks as in Hounsfield units; calibratedScale tells these by the value of dense bone.
    value.iso = scale.iso;
    value.denseBone = scale.dense + 1.0;
    image.notes.push_back(other.why +
                          " Air and soft tissue have in it the values of a CT, so the surface of "
                          "bone is put at " +
                          core::plainText(scale.iso, 4) +
                          ", but no value is called HU. Build the case with --modality CT if it is "
                          "a CT in Hounsfield units.");
    return;
  }
  if (scale.calibrated)
  {
    image.modality = Modality::Ct;
    if (isBelieved)
      image.notes.push_back(
          "Its histogram shows neither air nor soft tissue as a CT has them, as that of a small "
          "part of one. The file states that its values are Hounsfield units, and is of a helical "
          "CT or was exported by Petrous, so the surface of bone is put at 300 HU; 'petrous "
          "appearance --iso' moves it.");
    if (scale.isOfPart)
      image.notes.push_back(
          "Its histogram has no peaks of air and soft tissue, as that of a small part of a CT. It "
          "was judged by its values: soft tissue is near 40, and nothing below air, so they are "
          "taken for Hounsfield units, and the surface of bone is put at 300 HU; 'petrous "
          "appearance --iso' moves it.");
    return;
  }
  if (isOther)
    image.notes.push_back(other.why);
  value.iso = scale.iso;
  value.denseBone = scale.dense;
  value.softTissueValues = scale.soft;
  if (image.modality == Modality::Unknown)
    image.notes.push_back("The file does not say whether it is a CT or an MR; it is taken for a CT "
                          "with units of its own, such as cone beam. Build the case with "
                          "--modality MR if it is an MR, --modality CT if it is not.");
  image.notes.push_back(
      "The intensities are not Hounsfield units: the surface of bone is put at " +
      core::plainText(scale.iso, 4) + ", and dense bone taken for " +
      core::plainText(scale.dense, 4) +
      ", by the image's histogram; 'petrous appearance --iso' moves the surface." +
      (mayBePart(histogram) && !read.whole
           ? " Of a small part of a CT this may be wrong: where its values are Hounsfield units "
             "all the same, bone begins at 300 ('petrous appearance --iso 300')."
           : ""));
}

bool isAmong(const std::vector<scene::StructurePart>& structures, const std::string& name)
{
  return std::any_of(structures.begin(), structures.end(),
                     [read = scene::asRead(name)](const scene::StructurePart& one)
                     { return scene::asRead(one.name) == read; });
}

void checkName(const fs::path& path, const std::string& name)
{
  try
  {
    scene::checkPartName(name);
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter(path.string() + ": " + error.what());
  }
}

// A name that is valid and new to the case, over all kinds of parts. `wanted`: which it would have
// without PartSource::newNames.
void checkNewName(const scene::Case& value, const fs::path& path, const std::string& name,
                  const std::string& wanted)
{
  checkName(path, name);
  if (const std::string taken = scene::partReadAs(value, name); !taken.empty())
    throw NamesTaken(path.string() + ": " + scene::kindOfPart(value, taken) + " '" + taken +
                         "' is in the case already; give it another name " +
                         (taken == name ? "" : "than '" + name + "', which reads the same, ") +
                         "with NAME=FILE",
                     wanted);
}

// What is called `name` where the user did not say otherwise.
template <class IsInCase>
std::string askedName(const PartSource& source, const std::string& name, const IsInCase& isThere,
                      const std::vector<scene::StructurePart>& others,
                      std::vector<std::string>& notes)
{
  if (const auto asked = source.newNames.find(name); asked != source.newNames.end())
    return asked->second;
  if (!source.numbersTaken || !isThere(name))
    return name;
  const std::string numbered = scene::freeName(name, [&](const std::string& one)
                                               { return isThere(one) || isAmong(others, one); });
  notes.push_back("'" + name + "' is called '" + numbered +
                  "' here, as the case has a part of this name already");
  return numbered;
}

// Structures on a grid of neither the CT nor an MR lie in the CT's space until an MR of their grid
// comes: they were drawn on it.
void placeOn(scene::Case& value, const scene::ImagePart& mr)
{
  for (scene::LabelPart& part : value.labels)
  {
    if (part.drawnOn || !hasGridOf(mr, part.labels.get()->voxels->geometry()))
      continue;
    if (!mr.provenance.axes.isIdentity() &&
        !core::sameGrid(part.labels.get()->voxels->geometry(), mr.geometry))
    {
      part.labels =
          std::make_shared<const volume::LabelMap>(volume::onGrid(*part.labels.get(), mr.geometry));
      part.object.clear();
      part.provenance.axes = mr.provenance.axes;
      part.notes.push_back(followedNote(mr));
    }
    part.drawnOn = mr.name;
    part.notes.push_back("has the grid of the MR '" + mr.name +
                         "', which was added later: it was taken to be drawn on that MR, and lies "
                         "where its registration puts it, no longer in the CT's space; FILE@ct "
                         "keeps it there");
  }
}

// In a label map neighbours within a structure have the same whole number; noise and texture of an
// image make that rare, but for saturated ones.
bool readsAsLabels(const volume::IntensityVolume& image)
{
  constexpr double kShare = 0.9;        // of the neighbours
  constexpr std::size_t kMost = 256;    // values
  constexpr std::size_t kFewest = 1000; // pairs that tell anything
  const core::Index3& dims = image.geometry().dims();
  const int step = std::max(1, dims[2] / 16);
  std::set<double> values;
  std::size_t pairs = 0;
  std::size_t equal = 0;
  for (int k = step / 2; k < dims[2]; k += step)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 1; i < dims[0]; ++i)
      {
        const double value = image.at(i, j, k);
        if (value == 0.0)
          continue;
        if (value != std::round(value) || (values.insert(value).second && values.size() > kMost))
          return false;
        const double before = image.at(i - 1, j, k);
        pairs += before != 0.0;
        equal += before == value;
      }
  return values.size() > 2 && pairs >= kFewest &&
         static_cast<double>(equal) > kShare * static_cast<double>(pairs);
}

void addMr(scene::Case& value, const PartSource& source, const scene::IdentitySalt& salted,
           const core::Progress& progress)
{
  const std::string wanted =
      !source.name.empty() ? source.name : scene::freeName("mr", isInCase(value));
  std::vector<std::string> notes;
  const std::string name = askedName(source, wanted, isInCase(value), {}, notes);
  checkNewName(value, source.path, name, wanted);
  requireSide(source.path, source.assumeRas, "--mr-frame");
  requireUnit(source.path, source.unit, "--mr-unit");
  ReadImage read = readImage(
      source.path, source.series, optionsOf(source.repair, source.roi, source.undeclaredBits),
      false, source.assumeRas, source.unit, source.axes.value_or(core::AxesCorrection()), progress);
  scene::ImagePart& part = read.part;
  if (!read.otherQuantity.why.empty() && !read.otherQuantity.isUnspecified)
    part.notes.push_back(read.otherQuantity.why);
  part.name = name;
  part.notes.insert(part.notes.end(), notes.begin(), notes.end());
  if (source.roi)
    part.notes.push_back("Only a region of it was read, as asked; labels on the grid of the whole "
                         "image lie on it only as FILE@" +
                         name + ".");
  noteLostSalt(value, part.patient, salted, part.notes);
  if (isOfOtherPatient(value, source, read.patient, salted))
    part.notes.push_back("Its files state another patient's ID, name or date of birth than those "
                         "of the case's other images; it was added as asked.");
  // A CT angiogram may be wanted beside the CT: said, not refused.
  if (part.modality == scene::Modality::Ct)
    part.notes.push_back("The file says that it is a CT; it was added as an MR, as asked. If it is "
                         "the patient's CT, begin a case with it (petrous new --ct).");
  part.modality = scene::Modality::Unknown;
  if (const auto image = part.volume.get(); image && readsAsLabels(*image))
    part.notes.push_back("It looks like a label map and not like an image: neighbouring voxels "
                         "have the same whole numbers. If it is one, remove it and add it as "
                         "labels.");
  placeOn(value, part);
  value.mr.push_back(std::move(part));
}

// The MR that the user specified for a file; empty for the CT.
std::string drawnOnNamed(const scene::Case& value, const PartSource& source)
{
  if (source.drawnOn == "ct")
    return {};
  std::string there = "ct";
  for (const scene::ImagePart& mr : value.mr)
    there += ", " + mr.name;
  if (!scene::findMr(value, source.drawnOn))
    throw core::InvalidParameter(source.path.string() + ": case '" + value.name + "' has no MR '" +
                                 source.drawnOn + "' on which it was drawn; " + "it has " + there);
  return source.drawnOn;
}

// None if the grid is neither the CT's nor an MR's: an MR with that grid may be added.
std::optional<std::string> drawnOn(const scene::Case& value, const PartSource& source,
                                   const core::GridGeometry& grid)
{
  if (!source.drawnOn.empty())
    return drawnOnNamed(value, source);
  if (hasGridOf(value.ct, grid))
    return std::string();
  const auto names = mrOfGrid(value, grid);
  if (names.size() > 1)
    throw core::InvalidParameter(source.path.string() +
                                 ": several MR images have its grid; say on "
                                 "which it was drawn with FILE@" +
                                 names[0] + " or FILE@" + names[1]);
  if (names.empty())
    return std::nullopt;
  return names.front();
}

// Voxels that are some of another grid's, or would be beyond its borders.
struct OnLattice
{
  core::IndexBox box;         ///< in the other grid's voxels
  bool isFromLastTo0 = false; ///< their slices are counted from the other end
};

// None if they are not, in whichever order and direction their axes have them: files that were
// saved again in another orientation have the same voxels.
std::optional<OnLattice> onLatticeOf(const core::GridGeometry& grid,
                                     const core::GridGeometry& whole)
{
  constexpr double kNear = 0.02; // voxels
  constexpr double kFarthest = 1e6;
  const Eigen::Vector3d corner = whole.voxelFromPatient(grid.patientFromVoxel({0.0, 0.0, 0.0}));
  const Eigen::Vector3d first = corner.array().round().matrix();
  if ((corner - first).cwiseAbs().maxCoeff() > kNear || first.cwiseAbs().maxCoeff() > kFarthest)
    return std::nullopt;
  Eigen::Vector3d last = first;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double count = grid.dims()[static_cast<std::size_t>(axis)];
    Eigen::Vector3d end = Eigen::Vector3d::Zero();
    end[axis] = count;
    const Eigen::Vector3d along = whole.voxelFromPatient(grid.patientFromVoxel(end)) - corner;
    int of = 0;
    along.cwiseAbs().maxCoeff(&of);
    const double sign = along[of] < 0.0 ? -1.0 : 1.0;
    if ((along - sign * count * Eigen::Vector3d::Unit(of)).cwiseAbs().maxCoeff() > kNear)
      return std::nullopt;
    last[of] += sign * (count - 1.0);
  }
  OnLattice found;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    found.box.lower[a] = static_cast<int>(std::min(first[axis], last[axis]));
    found.box.upper[a] = static_cast<int>(std::max(first[axis], last[axis])) + 1;
  }
  found.isFromLastTo0 = last[2] < first[2];
  return found;
}

// Of a region those of the whole stack: a gap below it shifts what lies in it.
int interpolatedOfStack(const scene::ImagePart& ct)
{
  return volume::sliceCount(ct.provenance.interpolated) + ct.provenance.interpolatedBeyond;
}

// Whether what was drawn may be on the slices as they lie in the files. A program that takes them
// for straight and even, at their usual pitch, has the lattice of the repaired image, which is
// wider by as much as slices were shifted and longer by those that were missing: a grid that is
// smaller by no more than that may be the whole stack, and one that is smaller by more is a part.
bool mayBeUnrepaired(const core::GridGeometry& grid, const scene::ImagePart& ct)
{
  if (core::sameGrid(grid, ct.geometry))
    return false;
  const auto lies = onLatticeOf(grid, ct.geometry);
  if (!lies)
    return true;
  const core::IndexBox& box = lies->box;
  if (box == ct.geometry.fullBox())
    return false;
  if (box.lower[2] > 0 && !(lies->isFromLastTo0 && box.upper[2] >= ct.geometry.dims()[2]))
    return false; // with neither the first slice nor, counted from there, the last
  const double aside = std::abs(ct.provenance.shift);
  const Eigen::Vector3d added(std::ceil(aside / ct.geometry.spacing()[0]),
                              std::ceil(aside / ct.geometry.spacing()[1]), interpolatedOfStack(ct));
  for (int axis = 0; axis < 3; ++axis)
    if (const int absent = ct.geometry.dims()[static_cast<std::size_t>(axis)] -
                           box.size()[static_cast<std::size_t>(axis)];
        absent > added[axis])
      return false;
  return true;
}

// How far apart a stack that other programs take for straight and even, and the repaired image may
// lie, mm.
double repairedBy(const scene::ImagePart& ct)
{
  return ct.provenance.shift + interpolatedOfStack(ct) * ct.geometry.spacing()[2];
}

std::string repairedNote(double apart)
{
  return "has another grid than the CT, which was repaired. If it was drawn on the slices as they "
         "lie in the files, by a program that takes them for straight and even, it lies elsewhere "
         "by up to " +
         core::fixedText(apart, 1) + " mm: look whether it fits the bone";
}

// Before an MR is added that may have the same grid as another one.
void settleDrawnOn(scene::Case& value)
{
  for (scene::LabelPart& part : value.labels)
  {
    if (part.drawnOn || value.mr.empty())
      continue;
    const auto names = scene::mrWithGrid(value, part.labels.get()->voxels->geometry());
    if (names.size() == 1)
      part.drawnOn = names.front();
  }
}

std::vector<std::array<float, 3>> colorsOf(const scene::Case& value)
{
  std::vector<std::array<float, 3>> colors;
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      colors.push_back(structure.look.color);
  for (const auto& mesh : value.meshes)
    colors.push_back(mesh.look.color);
  return colors;
}

// Whether the name of a structure determines no appearance.
bool isUnknown(const appearance::StructureAppearance& look)
{
  return look.preset == "other";
}

bool liesOutside(const core::GridGeometry& ct, const core::GridGeometry& grid,
                 const core::IndexBox& box)
{
  const auto& n = ct.dims();
  const Eigen::AlignedBox3d hull(Eigen::Vector3d::Zero(),
                                 Eigen::Vector3d(n[0] - 1.0, n[1] - 1.0, n[2] - 1.0));
  return !hull.intersects(boxOn(ct, grid, box));
}

std::string outsideNote(const std::vector<std::string>& names, const std::string& image)
{
  return scene::listed(names) +
         (names.size() == 1
              ? " lies wholly outside the " + image +
                    ", so nothing of it is seen or felt; check that it is this patient's"
              : " lie wholly outside the " + image +
                    ", so nothing of them is seen or felt; check that they are this patient's");
}

// Share of a structure's voxels whose centres lie in none of the CT's, 0 to 1.
double shareOutside(const core::GridGeometry& ct, const volume::LabelMap& map, std::uint16_t index,
                    const core::IndexBox& box)
{
  const core::GridGeometry& grid = map.voxels->geometry();
  const Eigen::Array3d last = Eigen::Array3d(ct.dims()[0], ct.dims()[1], ct.dims()[2]) - 0.5;
  std::size_t count = 0, outside = 0;
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
      {
        if (map.voxels->at(i, j, k) != index)
          continue;
        const Eigen::Array3d at =
            ct.voxelFromPatient(grid.patientFromVoxel(Eigen::Vector3d(i, j, k))).array();
        ++count;
        outside += (at < -0.5).any() || (at > last).any();
      }
  return count == 0 ? 0.0 : static_cast<double>(outside) / static_cast<double>(count);
}

// Of what lies partly outside; of a grid that is the CT's or within it nothing does.
void notePartlyOutside(const scene::Case& value, scene::LabelPart& part,
                       const volume::LabelMap& map, const std::vector<core::IndexBox>& boxes)
{
  constexpr double kNoted = 0.01; // of the voxels
  std::string names;
  for (const auto& structure : part.structures)
    for (std::size_t s = 0; s < map.segments.size(); ++s)
    {
      if (structure.index != map.segments[s].index || boxes[s].empty() ||
          isWithin(value.ct.geometry, map.voxels->geometry(), boxes[s]) ||
          liesOutside(value.ct.geometry, map.voxels->geometry(), boxes[s]))
        continue;
      const double share = shareOutside(value.ct.geometry, map, structure.index, boxes[s]);
      if (share > kNoted)
        names += (names.empty() ? "'" : ", '") + structure.name + "' (" +
                 std::to_string(std::lround(100.0 * share)) + " %)";
    }
  if (!names.empty())
    part.notes.push_back("partly outside the " + std::string(primaryName(value)) +
                         ", where nothing is seen or felt of them: " + names);
}

// Notes structures that will be neither visible nor touchable, and returns their names.
std::vector<std::string> noteOutside(const scene::Case& value, scene::LabelPart& part,
                                     const volume::LabelMap& map)
{
  if (part.drawnOn && !part.drawnOn->empty())
    return {}; // through the registration of an MR, which may change
  const auto boxes = volume::boxesOf(map);
  std::vector<std::string> names; // in the order in which leaveOutside looks for the note
  for (const auto& structure : part.structures)
    for (std::size_t s = 0; s < map.segments.size(); ++s)
      if (structure.index == map.segments[s].index &&
          liesOutside(value.ct.geometry, map.voxels->geometry(), boxes[s]))
        names.push_back(structure.name);
  if (!names.empty())
    part.notes.push_back(outsideNote(names, primaryName(value)));
  notePartlyOutside(value, part, map, boxes);
  return names;
}

// A DICOM segmentation states the frame of reference in which it was drawn: that of the CT, or of
// an MR. Of a stored case only salted hashes are known. What cannot be compared is noted, unless
// the grid shows it.
struct SettledFrame
{
  bool isAssumed = false;  ///< LabelProvenance::isFrameAssumed
  bool isStated = false;   ///< it is that which the file of the image states
  bool isExported = false; ///< it is that of files exported from the case
};
SettledFrame settleFrame(const scene::Case& value, PartSource& source, const std::string& frameUid,
                         const core::GridGeometry* grid, const scene::IdentitySalt& salted,
                         std::vector<std::string>& notes)
{
  constexpr SettledFrame kStated{false, true, false};
  constexpr SettledFrame kExported{false, false, true};
  const std::string frame = withoutIdentity(frameUid);
  const auto isExported = [&](const std::string& mr)
  { return frame == withoutIdentity(exportedFrame(value, mr)); };
  const auto isKnown = [&salted](const scene::ImagePart& image)
  { return !image.frameOfReference.empty() && scene::isComparable(image, salted); };
  const auto isOf = [&](const scene::ImagePart& image)
  { return image.frameOfReference == (image.isFrameSalted ? salted(frame) : frame); };
  if (!source.drawnOn.empty())
  {
    const bool isCt = source.drawnOn == "ct";
    const scene::ImagePart* image = isCt ? &value.ct : scene::findMr(value, source.drawnOn);
    if (image && isExported(isCt ? "" : image->name))
      return kExported;
    const bool isOther = image && !frame.empty() && isKnown(*image) && !isOf(*image);
    return {isOther, !isOther, false};
  }
  const auto noteUnknown = [&](const std::string& why)
  {
    const bool isShown = grid && (hasGridOf(value.ct, *grid) || !mrOfGrid(value, *grid).empty());
    if (!isShown)
      notes.push_back(std::string("its frame of reference could not be compared with the ") +
                      primaryName(value) + "'s, as " + why +
                      "; look whether it lies where it belongs");
    return SettledFrame{!isShown, false, false};
  };
  if (frame.empty())
    return noteUnknown("it states none");
  if (isExported(""))
  {
    source.drawnOn = "ct";
    return kExported;
  }
  for (const scene::ImagePart& mr : value.mr)
    if (isExported(mr.name))
    {
      source.drawnOn = mr.name;
      return kExported;
    }
  if (isKnown(value.ct) && isOf(value.ct))
    return kStated;
  // The MRs of one session share a frame of reference, and each may be registered by itself.
  std::vector<std::string> ofFrame;
  for (const scene::ImagePart& mr : value.mr)
    if (isKnown(mr) && isOf(mr))
      ofFrame.push_back(mr.name);
  if (ofFrame.size() > 1 && grid)
  {
    std::vector<std::string> ofGrid;
    for (const std::string& name : ofFrame)
      if (hasGridOf(*scene::findMr(value, name), *grid))
        ofGrid.push_back(name);
    if (!ofGrid.empty())
      ofFrame = std::move(ofGrid);
  }
  if (ofFrame.size() > 1)
    throw core::InvalidParameter(source.path.string() +
                                 ": several MR images have its frame of reference; say on which "
                                 "it was drawn with FILE@" +
                                 ofFrame[0] + " or FILE@" + ofFrame[1]);
  if (!ofFrame.empty())
  {
    source.drawnOn = ofFrame.front();
    return kStated;
  }
  const std::string image = primaryName(value);
  if (!isKnown(value.ct))
    return noteUnknown("the " + image + "'s is not known");
  throw FrameUnclear(source.path, image);
}

// An RT structure set becomes voxels of the image on which it was drawn.
imaging::LoadedLabels loadStructureSet(const scene::Case& value, PartSource& source,
                                       const scene::IdentitySalt& salted,
                                       const core::Progress& progress,
                                       scene::LabelProvenance& provenance)
{
  const imaging::StructureSet set = imaging::readStructureSet(source.path, progress.part(0.0, 0.3));
  isOfOtherPatient(value, source, set.patient, salted); // before it is computed
  std::vector<std::string> notes;
  const bool isNamed = !source.drawnOn.empty();
  const SettledFrame frame =
      settleFrame(value, source, set.frameOfReferenceUid, nullptr, salted, notes);
  provenance.isFrameAssumed = frame.isAssumed;
  const scene::ImagePart* mr = nullptr;
  if (!source.drawnOn.empty() && source.drawnOn != "ct")
    mr = scene::findMr(value, drawnOnNamed(value, source));
  if (source.drawnOn.empty())
    source.drawnOn = "ct"; // not an MR of the same grid
  const scene::ImagePart& image = mr ? *mr : value.ct;
  const core::AxesCorrection& ofImage = image.provenance.axes;
  if (source.axes)
    provenance.axes = *source.axes;
  else if (!ofImage.isIdentity() && !frame.isExported)
  {
    if (!isNamed && !frame.isStated)
      throw FrameUnclear(source.path, image.name, ofImage, "--labels-axes");
    provenance.axes = ofImage;
    notes.push_back(followedNote(image));
  }
  imaging::LoadedLabels loaded = imaging::labelsOf(
      set, provenance.axes.inverse().applied(image.geometry), source.path, progress.part(0.3, 1.0));
  for (volume::LabelMap& map : loaded.maps)
    map = volume::onGrid(map, image.geometry);
  loaded.notes.insert(loaded.notes.begin(), notes.begin(), notes.end());
  return loaded;
}

struct FolderNames
{
  std::map<std::string, std::string> names; ///< of the structures, by their files'
  std::set<std::string> leftOut;            ///< words
};

// A word of no structure and no side, and without which the name means the same, may be the
// patient's name, and is left out of the structures' names, if most of the files of a folder, or
// objects of a file, share it or the name of its file may identify the patient.
FolderNames namesWithoutPatient(const std::vector<std::string>& names, const IdentityText& identity)
{
  const auto& presets = builtInPresets();
  const auto isWordChar = [](unsigned char c) { return c >= 0x80 || std::isalnum(c) != 0; };
  const auto wordsOf = [&](const std::string& text)
  {
    std::vector<std::string> words;
    for (auto at = text.begin(); at != text.end();)
    {
      const auto from = std::find_if(at, text.end(), isWordChar);
      at = std::find_if_not(from, text.end(), isWordChar);
      if (from != at)
        words.emplace_back(from, at);
    }
    return words;
  };
  std::map<std::string, std::size_t> counts;
  const std::size_t files = names.size();
  for (const std::string& name : names)
  {
    const auto words = wordsOf(name);
    for (const std::string& word : std::set<std::string>(words.begin(), words.end()))
      ++counts[word];
  }
  constexpr std::size_t kTelling = 3; // files, from which on what they share means something
  FolderNames result;
  for (const std::string& name : names)
  {
    std::string kept;
    bool isWhole = true;
    // Where the patient's name is known, capitals alone say nothing.
    const bool mayIdentify =
        identity.mayIdentify(identity.knowsName() ? scene::lowerCase(name) : name);
    for (const std::string& word : wordsOf(name))
    {
      const std::string known = presets.knownWordsOfPart(word);
      const std::size_t unknown = appearance::letterBytes(word) - appearance::letterBytes(known);
      const bool isKnown = !known.empty() && unknown <= 1; // "C7"
      const bool isKept =
          isKnown || (files >= kTelling && 2 * counts[word] <= files && !mayIdentify);
      if (const std::string& part = isKept ? word : known; !part.empty())
        kept += (kept.empty() ? "" : "_") + part;
      if (!isKept)
      {
        isWhole = false;
        result.leftOut.insert(word);
      }
    }
    result.names[name] = isWhole ? name : kept;
  }
  return result;
}

FolderNames namesInFolder(const imaging::LoadedLabels& loaded, const IdentityText& identity)
{
  std::vector<std::string> names;
  for (const auto& map : loaded.maps)
    for (const volume::Segment& segment : map.segments)
      names.push_back(segment.name);
  return namesWithoutPatient(names, identity);
}

// Of the files of a folder, or the objects of a file.
std::string leftOutNote(const FolderNames& folder, bool isFolder)
{
  const std::size_t count = folder.leftOut.size();
  return std::to_string(count) + (count == 1 ? " word" : " words") +
         (isFolder ? " of the files' names" : " of the objects' names") +
         ", which may be a patient's, " + (count == 1 ? "was" : "were") +
         " left out of the structures' names";
}

std::string takenNote(const std::vector<std::string>& taken)
{
  return scene::listed(taken) + " left out as asked, as the case has " +
         (taken.size() == 1 ? "a part of this name" : "parts of these names") + " already";
}

std::string numberedNote(const std::vector<std::string>& numbered, bool isFolder)
{
  return scene::listed(numbered) + (numbered.size() == 1 ? " has" : " have") +
         " a number, as other " +
         (isFolder ? "files of the folder give" : "structures of the file have") +
         " names that read the same; if a structure is there twice, remove one";
}

// The name that a file of several structures gives one, made valid: one odd name must not refuse
// the others.
template <class IsTaken>
std::string validName(const std::string& name, const IsTaken& isTaken,
                      std::vector<std::string>& notes)
{
  constexpr std::size_t kLongest = 200; // bytes (checkPartName)
  std::string valid = core::utf8Prefix(scene::withoutInvisible(name), kLongest);
  if (valid.empty())
    valid = "structure";
  if (valid == "ct")
    valid = "structure ct";
  if (valid == scene::kSoftTissue)
    valid = "structure soft-tissue";
  if (isTaken(valid))
    valid = scene::freeName(core::utf8Prefix(valid, kLongest - 8), isTaken);
  if (valid != name)
    notes.push_back("structure '" + valid +
                    "' has this name since its own is too long, taken or "
                    "reserved, or has characters that are not seen");
  return valid;
}

// An image that was taken for a label map: each of its values would be a structure.
void noteManyValues(const fs::path& path, const imaging::LoadedLabels& loaded,
                    std::size_t structures, std::vector<std::string>& notes)
{
  constexpr std::size_t kMost = 1000; // the largest published atlases have some hundred
  constexpr std::size_t kMany = 120;  // TotalSegmentator has 117
  if (structures > kMost)
    throw core::InvalidParameter(path.string() + ": has " + std::to_string(structures) +
                                 " structures or different values, and at most " +
                                 std::to_string(kMost) +
                                 " are taken as structures; an image is added as an MR, and of an "
                                 "atlas only what is needed");
  std::size_t unnamed = 0;
  for (const volume::LabelMap& map : loaded.maps)
    for (const volume::Segment& segment : map.segments)
      unnamed += segment.voxels > 0 && segment.name == "label " + std::to_string(segment.index);
  if (unnamed > kMany)
    notes.push_back(std::to_string(unnamed) +
                    " values without a name became a structure each; if it is an image, remove "
                    "them and add it as an MR");
}

// Moves the maps that were drawn on an image in the axes that its file states to where they are by
// the image's correction, which is returned if there is such a map. `isStated`: the image is known
// otherwise than by the grid.
core::AxesCorrection follow(const scene::Case& value, const PartSource& source, bool isStated,
                            imaging::LoadedLabels& loaded)
{
  core::AxesCorrection followed;
  for (volume::LabelMap& map : loaded.maps)
  {
    const core::GridGeometry& grid = map.voxels->geometry();
    const scene::ImagePart& image = imageDrawnOn(value, drawnOn(value, source, grid).value_or(""));
    const core::AxesCorrection& axes = image.provenance.axes;
    if (axes.isIdentity() || core::sameGrid(grid, image.geometry))
      continue;
    if (!isStated && !hasGridOf(image, grid))
      throw FrameUnclear(source.path, image.name, axes, "--labels-axes");
    map = volume::onGrid(map, axes.applied(grid, image.geometry.center()));
    if (followed.isIdentity())
      loaded.notes.push_back(followedNote(image));
    followed = axes;
  }
  return followed;
}

// Corrects the axes of the maps as the user said: about the middle of the image on which each was
// drawn, so that what lies on parts of its grid keeps its place among the rest. The names of these
// images, empty for the CT: the maps stay with them also if an MR of their grid comes later.
std::vector<std::string> correct(const scene::Case& value, const PartSource& source,
                                 const core::AxesCorrection& axes, imaging::LoadedLabels& loaded)
{
  std::vector<std::string> images;
  for (volume::LabelMap& map : loaded.maps)
  {
    const core::GridGeometry& grid = map.voxels->geometry();
    auto on = drawnOn(value, source, grid);
    if (!on) // that of labels which alone are wrong
      on = drawnOn(value, source, axes.applied(grid));
    images.push_back(on.value_or(""));
    if (!axes.isIdentity())
      map = volume::onGrid(
          map, axes.applied(grid, imageDrawnOn(value, images.back()).geometry.center()));
  }
  return images;
}

void addLabels(scene::Case& value, PartSource source, const PartSources& parts,
               const core::Progress& progress, std::vector<StructureReport>* report)
{
  const auto& salted = parts.salted;
  const auto& presets = builtInPresets();
  imaging::LoadedLabels loaded;
  scene::LabelProvenance provenance;
  std::vector<std::string> images; // of each map, where axes were said (correct)
  const bool isStructureSet = imaging::isStructureSet(source.path);
  const bool isDicom = isStructureSet || imaging::isDicomSegmentation(source.path);
  if (isStructureSet)
    loaded = loadStructureSet(value, source, salted, progress, provenance);
  else
  {
    const bool isNamed = !source.drawnOn.empty();
    imaging::LabelNaming naming{parts.labelNames, parts.labels.size() == 1};
    if (!source.labelNames.empty())
      naming = {source.labelNames, true};
    std::vector<imaging::ImageGrid> grids;
    const auto addGrids = [&grids](const scene::ImagePart& image)
    {
      grids.emplace_back(image.geometry, image.provenance.assumedRas.has_value());
      if (!image.provenance.axes.isIdentity())
        grids.emplace_back(statedGrid(image), image.provenance.assumedRas.has_value());
    };
    addGrids(value.ct);
    std::for_each(value.mr.begin(), value.mr.end(), addGrids);
    loaded =
        imaging::loadLabels(source.path, progress, naming, grids, source.assumeRas, 0, source.unit);
    if (!loaded.unitDoubt.likely.empty())
      throw ImageUnitUnclear(source.path, loaded.unitDoubt, "--labels-unit");
    if (loaded.isSideOpen)
      throw ImageSideUnclear(source.path, "--labels-frame");
    provenance.axes = source.axes.value_or(core::AxesCorrection());
    SettledFrame frame;
    if (isDicom)
    {
      const core::GridGeometry seen =
          provenance.axes.applied(loaded.maps.front().voxels->geometry());
      frame = settleFrame(value, source, loaded.frameOfReferenceUid, &seen, salted, loaded.notes);
    }
    provenance.isFrameAssumed = frame.isAssumed;
    provenance.assumedRas = loaded.assumedRas;
    if (source.axes)
      images = correct(value, source, *source.axes, loaded);
    else if (!frame.isExported)
      provenance.axes = follow(value, source, isNamed || frame.isStated, loaded);
  }
  if (source.axes && !source.axes->isIdentity())
    loaded.notes.push_back(correctedAxesText(*source.axes));
  std::vector<std::string> notes = std::move(loaded.notes);
  noteLostSalt(value, patientHash(loaded.patient), salted, notes);
  if (isOfOtherPatient(value, source, loaded.patient, salted))
    notes.push_back("states another patient's ID, name or date of birth than the case's images; it "
                    "was added as asked");
  std::vector<std::string> empty;
  const bool isFolder = fs::is_directory(source.path);
  const FolderNames folder =
      isFolder ? namesInFolder(loaded, IdentityText(value, salted)) : FolderNames();
  const auto& ofFolder = folder.names;
  if (!folder.leftOut.empty())
    notes.push_back(leftOutNote(folder, isFolder));
  if (!loaded.leftOut.empty()) // their names may be a patient's
  {
    std::vector<std::string> known;
    for (const imaging::UnreadStructure& unread : loaded.unread)
      if (isFolder && fileName(unread.name).isWhole)
        known.push_back(unread.name);
    const std::size_t count = loaded.leftOut.size();
    notes.push_back(std::to_string(count) +
                    (count == 1 ? " file of the folder is" : " files of the folder are") +
                    " not a mask of one structure, and left out" +
                    (known.empty()           ? std::string()
                     : known.size() == count ? ": " + scene::listed(known)
                                             : ", among them " + scene::listed(known)));
  }
  std::size_t structures = 0;
  for (const volume::LabelMap& map : loaded.maps)
    structures += static_cast<std::size_t>(std::count_if(map.segments.begin(), map.segments.end(),
                                                         [](const volume::Segment& segment)
                                                         { return segment.voxels > 0; }));
  noteManyValues(source.path, loaded, structures, notes);
  std::vector<std::string> taken;
  std::vector<StructureReport> reports;
  appearance::DistinctColors colors(colorsOf(value));
  for (const imaging::UnreadStructure& unread : loaded.unread)
  {
    reports.push_back({unread.name, unread.isEmpty ? StructureReport::Status::Empty
                                                   : StructureReport::Status::Unread});
    reports.back().why = unread.why;
    if (unread.isEmpty)
      empty.push_back(unread.name);
  }
  std::size_t layer = 0;
  const std::size_t before = value.labels.size();
  const std::size_t stated =
      std::accumulate(loaded.maps.begin(), loaded.maps.end(), std::size_t{0},
                      [](std::size_t sum, const auto& map) { return sum + map.segments.size(); });
  std::vector<std::string> numbered;
  for (auto& map : loaded.maps)
  {
    scene::LabelPart part;
    const auto isOfSource = [&](const std::string& name)
    {
      return isAmong(part.structures, name) ||
             std::any_of(value.labels.begin() + static_cast<std::ptrdiff_t>(before),
                         value.labels.end(),
                         [&name](const scene::LabelPart& other)
                         { return isAmong(other.structures, name); });
    };
    const auto isTaken = [&](const std::string& name)
    { return isInCase(value)(name) || isAmong(part.structures, name); };
    for (volume::Segment& segment : map.segments)
    {
      progress.check("reading labels");
      if (segment.voxels == 0)
      {
        if (isFolder) // also in the map, which is stored
          segment.name =
              ofFolder.at(segment.name).empty() ? "structure" : ofFolder.at(segment.name);
        empty.push_back(segment.name);
        reports.push_back({segment.name, StructureReport::Status::Empty});
        continue;
      }
      scene::StructurePart structure;
      structure.name = source.name.empty() ? segment.name
                       : stated == 1       ? source.name
                                           : source.name + " " + segment.name;
      if (isFolder)
      {
        const std::string& own = ofFolder.at(segment.name);
        structure.name = source.name.empty() ? own : source.name + (own.empty() ? "" : " " + own);
        const bool isTwice = isOfSource(structure.name);
        if (structure.name.empty() || structure.name == source.name || isTwice)
          structure.name =
              scene::freeName(structure.name.empty() ? "structure" : structure.name, isTaken);
        if (isTwice && !own.empty())
          numbered.push_back(structure.name);
      }
      else if (source.name.empty() && loaded.isNamedAfterFile)
        structure.name = nameFromFile(source.path, "structure", isInCase(value), notes);
      else if (source.name.empty())
        structure.name = validName(structure.name, isOfSource, notes);
      else if (stated > 1 && isOfSource(structure.name))
      {
        structure.name = scene::freeName(structure.name, isTaken);
        numbered.push_back(structure.name);
      }
      const std::string wanted = structure.name;
      structure.name = askedName(source, wanted, isInCase(value), part.structures, notes);
      structure.index = segment.index;
      structure.voxels = segment.voxels;
      structure.volume = map.volume(segment);
      structure.look = presets.lookFor(structure.name);
      if (isUnknown(structure.look))
        structure.look = presets.lookFor(wanted);
      if (const auto codes = loaded.codes.find(segment.name); codes != loaded.codes.end())
        structure.codes = codes->second;
      if (isUnknown(structure.look))
        structure.look = presets.lookForCodes(structure.codes).value_or(structure.look);
      if (isUnknown(structure.look) && structure.codes.type.empty())
        if (const auto meaning = loaded.meanings.find(segment.name);
            meaning != loaded.meanings.end())
          structure.look = presets.lookFor(meaning->second);
      // Of several all that are taken are told at once.
      if (structures > 1 &&
          (isInCase(value)(structure.name) ||
           (structure.name != wanted && isAmong(part.structures, structure.name))))
      {
        taken.push_back(wanted);
        reports.push_back(
            {wanted, StructureReport::Status::Skipped, structure.voxels, structure.volume});
        continue;
      }
      checkNewName(value, source.path, structure.name, wanted);
      StructureReport one{structure.name, StructureReport::Status::Read, structure.voxels,
                          structure.volume};
      if (const auto found = loaded.fileVolumes.find(segment.name);
          found != loaded.fileVolumes.end())
        one.fileVolume = found->second;
      one.layer = layer;
      one.file = source.path;
      reports.push_back(std::move(one));
      if (isUnknown(structure.look) && segment.color == std::array<float, 3>{})
        structure.look.color = colors.next();
      else
      {
        if (isUnknown(structure.look))
          structure.look.color = segment.color;
        colors.take(structure.look.color);
      }
      if (loaded.isNamedAfterFile)
        segment.name = structure.name; // the map is stored, and a file's name may be a patient's
      part.structures.push_back(std::move(structure));
    }
    ++layer;
    if (part.structures.empty())
      continue;
    part.provenance = provenance;
    part.drawnOn = images.empty() ? drawnOn(value, source, map.voxels->geometry())
                                  : std::optional<std::string>(images[layer - 1]);
    if (part.drawnOn.value_or("").empty() && mayBeUnrepaired(map.voxels->geometry(), value.ct))
      if (const double apart = repairedBy(value.ct); apart > 0.0)
      {
        if (!source.asTheyLie && !isDicom)
          throw LabelsUnrepaired(source.path, apart);
        part.notes.push_back(repairedNote(apart));
      }
    for (const std::string& name : noteOutside(value, part, map))
      for (StructureReport& one : reports)
        one.isOutside = one.isOutside || one.name == name;
    part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
    value.labels.push_back(std::move(part));
  }
  if (!taken.empty() && (!source.skipsTaken || taken.size() == structures))
    throw NamesTaken(source.path, taken, structures - taken.size());
  core::log::info("import: " + std::to_string(structures - taken.size()) + " structures in " +
                  std::to_string(value.labels.size() - before) + " label maps, " +
                  std::to_string(empty.size()) + " empty, " + std::to_string(taken.size()) +
                  " skipped");
  if (value.labels.size() == before)
    throw core::InvalidParameter(source.path.string() +
                                 ": none of its structures has a voxel; export it again with what "
                                 "was drawn");
  if (!empty.empty())
    notes.push_back(scene::listed(empty) + " left out, as no voxel carries " +
                    (empty.size() == 1 ? "it" : "them"));
  if (!taken.empty())
    notes.push_back(takenNote(taken));
  if (!numbered.empty())
    notes.push_back(numberedNote(numbered, isFolder));
  auto& first = value.labels[before].notes;
  first.insert(first.begin(), notes.begin(), notes.end());
  if (report)
    report->insert(report->end(), reports.begin(), reports.end());
}

// Catches a lost decimal point or a wrong unit. `what` names the image.
void requireNear(const fs::path& path, const core::TriangleMesh& mesh,
                 const core::GridGeometry& grid, const std::string& what)
{
  const core::PatientBox box = grid.patientBounds();
  const double reach = volume::reachBeyond(mesh, box);
  if (reach <= volume::maxReach(box))
    return;
  throw core::InvalidParameter(
      path.string() + ": reaches " + core::fixedText(reach, 0) + " mm beyond " + what +
      ", and a surface of this patient at most " + core::fixedText(volume::maxReach(box), 0) +
      " mm; look for a coordinate without its decimal point, and give it in mm");
}

// What a mesh file is called as one part, new to the case.
std::string meshName(const scene::Case& value, const PartSource& source,
                     std::vector<std::string>& notes)
{
  const auto isTaken = isInCase(value);
  std::string wanted =
      source.name.empty() ? nameFromFile(source.path, "mesh", isTaken, notes) : source.name;
  if (source.name.empty() && isTaken(wanted))
  {
    wanted = scene::freeName(wanted, isTaken);
    notes.push_back("named so as another part has the name of its file");
  }
  const std::string name = askedName(source, wanted, isTaken, {}, notes);
  checkNewName(value, source.path, name, wanted);
  return name;
}

/// The image on which a mesh was drawn.
struct MeshImage
{
  const core::GridGeometry& grid;
  std::string name;
};

// `part`: with its name and the notes about its file.
void addMeshPart(scene::Case& value, scene::MeshPart part, core::TriangleMesh mesh,
                 const MeshImage& image, appearance::DistinctColors& colors)
{
  if (std::string note = outsideImage(mesh, image.grid, image.name); !note.empty())
    part.notes.push_back(std::move(note));
  for (std::string& note : formNotes(mesh))
    part.notes.push_back(std::move(note));
  part.triangles = mesh.triangles.size();
  part.mesh = std::make_shared<const core::TriangleMesh>(std::move(mesh));
  part.look = builtInPresets().lookFor(part.name);
  if (isUnknown(part.look))
    part.look.color = colors.next();
  else
    colors.take(part.look.color);
  value.meshes.push_back(std::move(part));
}

// Each object of a mesh file as a part of its own. `shared`: what is of all of them; its notes are
// the first one's.
void addObjects(scene::Case& value, const PartSource& source, const scene::MeshPart& shared,
                imaging::LoadedMesh loaded, const MeshImage& image,
                const scene::IdentitySalt& salted, const core::Progress& progress)
{
  constexpr std::size_t kMost = 1000; // as noteManyValues
  const std::vector<std::string> objects = loaded.objects;
  const std::size_t count = objects.size();
  if (count > kMost)
    throw core::InvalidParameter(source.path.string() + ": holds " + std::to_string(count) +
                                 " objects, and at most " + std::to_string(kMost) +
                                 " are taken as structures; add it as one, without --mesh-parts");
  std::vector<std::string> notes;
  const FolderNames safe = namesWithoutPatient(objects, IdentityText(value, salted));
  if (!safe.leftOut.empty())
    notes.push_back(leftOutNote(safe, false));
  std::vector<core::TriangleMesh> meshes = imaging::splitByObject(loaded);
  loaded = {};
  ReadNames ofSource; // that the objects would have
  ReadNames inCase;
  for (const std::string& name : scene::partNames(value))
    inCase.add(name);
  ReadNames all = inCase;
  const auto isOfSource = [&ofSource](const std::string& name) { return ofSource.has(name); };
  const auto isThere = [&inCase](const std::string& name) { return inCase.has(name); };
  std::vector<std::string> numbered;
  std::vector<std::string> taken;
  const std::size_t before = value.meshes.size();
  appearance::DistinctColors colors(colorsOf(value));
  for (std::size_t n = 0; n < count; ++n)
  {
    progress.check("reading mesh");
    const std::string& own = safe.names.at(objects[n]);
    std::string wanted = source.name.empty() ? own : source.name + (own.empty() ? "" : " " + own);
    const bool isTwice = isOfSource(wanted);
    if (own.empty() || isTwice)
      wanted = all.freeName(wanted.empty() ? "structure" : wanted);
    if (isTwice && !own.empty())
      numbered.push_back(wanted);
    wanted = validName(wanted, isOfSource, notes);
    ofSource.add(wanted);
    all.add(wanted);
    scene::MeshPart part = shared;
    part.notes.clear();
    part.name = askedName(source, wanted, isThere, {}, notes);
    checkName(source.path, part.name);
    if (isThere(part.name)) // all that are taken are told at once
    {
      taken.push_back(wanted);
      continue;
    }
    inCase.add(part.name);
    all.add(part.name);
    addMeshPart(value, std::move(part), std::move(meshes[n]), image, colors);
  }
  if (!taken.empty() && (!source.skipsTaken || taken.size() == count))
    throw NamesTaken(source.path, taken, count - taken.size());
  if (!taken.empty())
    notes.push_back(takenNote(taken));
  if (!numbered.empty())
    notes.push_back(numberedNote(numbered, false));
  notes.insert(notes.end(), shared.notes.begin(), shared.notes.end());
  if (!notes.empty())
    notes.insert(notes.begin(), "is one of " + std::to_string(count) +
                                    " objects of its file; what is noted here of names, "
                                    "coordinates and unit is of all of them");
  auto& first = value.meshes[before].notes;
  first.insert(first.begin(), notes.begin(), notes.end());
  core::log::info("import: " + std::to_string(count - taken.size()) + " meshes of a file's " +
                  std::to_string(count) + " objects");
}

// The image before a correction of its axes.
scene::ImagePart asStated(scene::ImagePart image, const core::AxesCorrection& axes)
{
  if (axes.isIdentity())
    return image;
  image.geometry = axes.inverse().applied(image.geometry);
  image.volume =
      core::Lazy<volume::IntensityVolume>([corrected = image.volume, grid = image.geometry]
                                          { return volume::onGrid(corrected.get(), grid); });
  return image;
}

void addMesh(scene::Case& value, const PartSource& source, const scene::IdentitySalt& salted,
             const core::Progress& progress)
{
  scene::MeshPart part;
  if (!source.isPerObject)
    part.name = meshName(value, source, part.notes);
  if (!source.drawnOn.empty())
    part.drawnOn = drawnOnNamed(value, source);
  auto loaded = imaging::loadMesh(source.path, source.isRas, source.unit, progress.part(0.0, 0.9));
  const bool isSplit = source.isPerObject && !loaded.objectOf.empty();
  if (source.isPerObject && !isSplit)
    part.name = meshName(value, source, part.notes);
  const scene::ImagePart* mr = scene::findMr(value, part.drawnOn);
  const scene::ImagePart& drawn = mr ? *mr : value.ct;
  const MeshImage image{drawn.geometry, mr ? "the MR on which it was drawn"
                                           : std::string("the ") + primaryName(value)};
  const core::AxesCorrection& ofImage = drawn.provenance.axes;
  if (!source.axes && !ofImage.isIdentity() && source.drawnOn.empty())
    throw FrameUnclear(source.path, drawn.name, ofImage, "--mesh-axes");
  const core::AxesCorrection axes = source.axes.value_or(ofImage);
  if (std::string note = judgeMeshSpace(source.path, loaded, asStated(drawn, axes), image.name);
      !note.empty())
    part.notes.push_back(std::move(note));
  if (!axes.isIdentity())
  {
    correctAxes(loaded.mesh, axes, drawn.geometry.center());
    part.notes.push_back(source.axes ? correctedAxesText(axes) : followedNote(drawn));
  }
  requireNear(source.path, loaded.mesh, image.grid, image.name);
  part.notes.insert(part.notes.end(), loaded.notes.begin(), loaded.notes.end());
  core::log::info("import: mesh of " + std::to_string(loaded.mesh.triangles.size()) + " triangles");
  if (isSplit)
    return addObjects(value, source, part, std::move(loaded), image, salted, progress);
  if (std::string note = objectsNote(loaded); !note.empty())
    part.notes.push_back(std::move(note));
  appearance::DistinctColors colors(colorsOf(value));
  addMeshPart(value, std::move(part), std::move(loaded.mesh), image, colors);
}

// The names of parts that are given in one go, by what they come from: one that another of them has
// is not said to be in the case already.
class GivenNames
{
public:
  /// Adds what `source` gives to `value`.
  template <class Add>
  void record(const scene::Case& value, const PartSource& source, const Add& add)
  {
    const std::vector<std::string> before = scene::partNames(value);
    try
    {
      add();
    }
    catch (const NamesTaken& taken)
    {
      refuse(source, taken);
      throw;
    }
    for (const std::string& name : scene::partNames(value))
      if (std::find(before.begin(), before.end(), name) == before.end())
        m_files[scene::asRead(name)] = source.path;
  }

private:
  void refuse(const PartSource& source, const NamesTaken& taken) const
  {
    for (const std::string& name : taken.names)
      if (const auto file = m_files.find(scene::asRead(name)); file != m_files.end())
      {
        NamesTaken twice(source.path.string() + ": '" + name + "' is the name of what " +
                             (file->second == source.path ? std::string("the same file")
                                                          : file->second.string()) +
                             " gives, too; leave one of them out, or give one another name with "
                             "NAME=FILE, or a number with --rename-taken",
                         name);
        twice.names = taken.names;
        twice.others = taken.others;
        throw twice;
      }
  }

  std::map<std::string, fs::path> m_files; // by asRead
};

} // namespace

ImageSideUnclear::ImageSideUnclear(const fs::path& file, const std::string& option)
  : core::InvalidParameter(
        file.string() +
        ": does not say which side of the patient is left (NIfTI: qform or sform, "
        "NRRD: space, MetaImage: TransformMatrix), so the anatomy could be "
        "mirrored; export it again with its geometry, or say " +
        option + " ras (NIfTI's own) or lps (DICOM, ITK) if you know it")
{
}

std::string unitName(double unit)
{
  constexpr std::array<std::pair<double, const char*>, 6> kUnits{
      {{1e-6, "nm"}, {1e-3, "\xc2\xb5m"}, {1.0, "mm"}, {10.0, "cm"}, {25.4, "inch"}, {1e3, "m"}}};
  constexpr double kRounding = 1e-6; // relative
  for (const auto& [size, name] : kUnits)
    if (std::abs(unit - size) <= kRounding * size)
      return name;
  return core::plainText(unit, 3) + " mm";
}

std::string lengthText(double mm)
{
  constexpr double kWithDigits = 100.0; // from here on three digits are a whole number
  constexpr double kFinest = 1e-3;
  return mm >= kWithDigits ? core::fixedText(mm, 0)
         : mm < kFinest    ? core::fixedText(mm, 6)
                           : core::plainText(mm, 3);
}

namespace
{

std::string unitDoubtText(const imaging::UnitDoubt& doubt)
{
  std::string others;
  for (const double unit : doubt.likely)
    others += (others.empty() ? "" : ", ") + lengthText(doubt.edge * unit / doubt.unit) +
              " mm if its numbers are in " + unitName(unit);
  return lengthText(doubt.edge) +
         (doubt.isStated ? " mm long by the unit of length that it states"
                         : " mm long, as it states no unit of length and mm was taken") +
         ", which is no head, ear or specimen; it is " + others;
}

} // namespace

ImageUnitUnclear::ImageUnitUnclear(const fs::path& file, const imaging::UnitDoubt& of,
                                   const std::string& option)
  : core::InvalidParameter(file.string() + ": is " + unitDoubtText(of) +
                           ". Export it again with its unit, or say it with " + option)
  , doubt(of)
{
}

namespace
{

std::string takenText(const fs::path& file, const std::vector<std::string>& names,
                      std::size_t others)
{
  std::string text = file.string() + ": ";
  for (std::size_t n = 0; n < names.size(); ++n)
    text += (n == 0 ? "'" : n + 1 == names.size() ? " and '" : ", '") + names[n] + "'";
  const bool isOne = names.size() == 1;
  text += isOne ? " is the name of a part that is in the case already; "
                : " are names of parts that are in the case already; ";
  text += "give its structures other names with NAME=FILE, which puts NAME before each, or numbers "
          "with --rename-taken";
  if (others > 0)
    text += ", or leave " + std::string(isOne ? "this one" : "these") + " out and add the other " +
            (others == 1 ? std::string("one") : std::to_string(others)) + " with --skip-taken";
  return text;
}

} // namespace

NamesTaken::NamesTaken(const fs::path& file, std::vector<std::string> taken, std::size_t left)
  : core::Error(core::Fault::Refused, takenText(file, taken, left))
  , names(std::move(taken))
  , others(left)
{
}

NamesTaken::NamesTaken(const std::string& message, const std::string& name)
  : core::Error(core::Fault::Refused, message)
  , names{name}
  , others(0)
{
}

FrameUnclear::FrameUnclear(const fs::path& file, const std::string& image)
  : core::InvalidParameter(file.string() + ": was drawn in another frame of reference than the " +
                           image + "'s, so its place in the " + image +
                           " is not known; if it is this " + image +
                           "'s all the same, say FILE@ct, or add the MR on which it was drawn")
{
}

FrameUnclear::FrameUnclear(const fs::path& file, const std::string& image,
                           const core::AxesCorrection& axes, const std::string& option)
  : core::InvalidParameter(file.string() + ": does not tell whether it lies in the space of '" +
                           image + "' as its file states it, or with its axes corrected (" +
                           axes.letters() + "); say FILE@" + image +
                           " if it follows the correction, " + option +
                           " LPS if it lies where it belongs already")
{
}

LabelsUnrepaired::LabelsUnrepaired(const fs::path& file, double mm)
  : core::InvalidParameter(
        file.string() +
        ": has another grid than the CT, which was repaired; drawn on the slices as they lie in "
        "the files, by a program that takes them for straight and even, it lies elsewhere by up "
        "to " +
        core::fixedText(mm, 1) +
        " mm. Say --labels-as-they-lie if it is to be added where it lies, and look whether it "
        "fits the bone")
  , apart(mm)
{
}

OtherPatient::OtherPatient(const fs::path& file, const imaging::PatientDifferences& differences)
  : core::Error(core::Fault::Refused,
                file.string() +
                    ": states another patient than the case's images do (what differs: " +
                    differenceText(differences) +
                    "); look whether it is this patient's, and say --other-patient if it is to be "
                    "added all the same")
  , differing(differenceText(differences))
{
}

PartSource PartSource::parse(const std::string& text)
{
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || fs::exists(text))
    return {"", text};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

PartSource PartSource::parseSeries(const std::string& text)
{
  PartSource source = parse(text);
  const std::string path = source.path.string();
  // What lies there is the path, even with a '#' in its name.
  for (auto hash = path.find('#'); hash != std::string::npos && !fs::exists(source.path);
       hash = path.find('#', hash + 1))
    if (hash > 0 && fs::exists(path.substr(0, hash)))
    {
      source.series = path.substr(hash + 1);
      source.path = path.substr(0, hash);
    }
  return source;
}

PartSource PartSource::parseDrawn(const std::string& text)
{
  PartSource source = parse(text);
  const std::string path = source.path.string();
  const auto at = path.rfind('@');
  if (at == std::string::npos || at == 0 || at + 1 == path.size() || fs::exists(source.path))
    return source;
  source.drawnOn = path.substr(at + 1);
  source.path = path.substr(0, at);
  return source;
}

FileName fileName(const fs::path& path)
{
  const std::string stem = imaging::baseName(path); // "facial_nerve.nii.gz" -> "facial_nerve"
  const std::string known = builtInPresets().knownWords(stem);
  return appearance::letterBytes(known) == appearance::letterBytes(stem) ? FileName{stem, true}
                                                                         : FileName{known, false};
}

std::vector<std::string> maskNames(const imaging::LoadedLabels& folder)
{
  const FolderNames all = namesInFolder(folder, IdentityText(scene::Case()));
  std::vector<std::string> names;
  for (const volume::LabelMap& map : folder.maps)
    for (const volume::Segment& segment : map.segments)
    {
      const std::string& name = all.names.at(segment.name);
      names.push_back(name.empty() ? "structure" : name);
    }
  return names;
}

scene::Case buildCase(const std::string& name, const CaseSources& sources,
                      const core::Progress& progress, std::vector<StructureReport>* report)
{
  scene::checkCaseName(name);
  scene::Case value;
  value.name = name;
  value.origins.push_back({sources.ct, fs::file_time_type::clock::now()});
  requireSide(sources.ct, sources.assumeRas, "--ct-frame");
  requireUnit(sources.ct, sources.unit, "--ct-unit");
  ReadImage read = readImage(sources.ct, sources.series,
                             optionsOf(sources.repair, sources.roi, sources.undeclaredBits),
                             sources.modality != scene::Modality::Mr, sources.assumeRas,
                             sources.unit, sources.axes, progress.part(0.0, 0.7));
  value.ct = std::move(read.part);
  value.ct.name = "ct";
  judgeContents(sources.ct, value.ct, sources.roi.has_value());
  placeSurface(value, sources.modality, read);
  addParts(value, sources.parts, progress.part(0.7, 1.0), report);
  return value;
}

std::optional<double> StructureReport::volumeError() const
{
  if (status != Status::Read || !fileVolume || *fileVolume <= 0.0)
    return std::nullopt;
  return volume / *fileVolume - 1.0;
}

const char* nameOf(StructureReport::Status status)
{
  return status == StructureReport::Status::Read      ? "read"
         : status == StructureReport::Status::Empty   ? "empty"
         : status == StructureReport::Status::Skipped ? "skipped"
                                                      : "unread";
}

StructureSummary summaryOf(const std::vector<StructureReport>& reports)
{
  StructureSummary summary;
  double largest = -1.0;
  for (const StructureReport& one : reports)
  {
    ++(one.status == StructureReport::Status::Read      ? summary.read
       : one.status == StructureReport::Status::Empty   ? summary.empty
       : one.status == StructureReport::Status::Skipped ? summary.skipped
                                                        : summary.unread);
    if (const auto error = one.volumeError(); error && std::abs(*error) > largest)
    {
      largest = std::abs(*error);
      summary.worst = &one;
    }
  }
  summary.text =
      std::to_string(summary.read) + (summary.read == 1 ? " structure read" : " structures read");
  if (summary.empty > 0)
    summary.text += ", " + std::to_string(summary.empty) + " empty";
  if (summary.skipped > 0)
    summary.text += ", " + std::to_string(summary.skipped) + " left out";
  if (summary.unread > 0)
    summary.text += ", " + std::to_string(summary.unread) + " not read";
  return summary;
}

std::string exportedFrame(const scene::Case& value, const std::string& drawnOn)
{
  core::Fingerprint all;
  const std::string& id = value.id.empty() ? value.name : value.id;
  all.add(id.data(), id.size());
  return imaging::deterministicUid(all.value(),
                                   drawnOn.empty() ? "frame CT" : "frame MR " + drawnOn);
}

std::vector<std::array<float, 3>> structureColors(const scene::Case& value)
{
  return colorsOf(value);
}

void keepIdentity(scene::StructurePart& structure, const scene::StructurePart& replaced)
{
  structure.look = replaced.look;
  volume::SegmentCodes codes = replaced.codes;
  codes.algorithm = structure.codes.algorithm;
  codes.algorithmName = structure.codes.algorithmName;
  structure.codes = std::move(codes);
}

bool keepsLook(const std::string& name, const std::string& preset)
{
  const std::string byName = builtInPresets().lookFor(name).preset;
  return byName == "other" || byName == preset;
}

void addStructures(scene::Case& value, volume::LabelMap labels)
{
  const auto& presets = builtInPresets();
  scene::LabelPart part;
  appearance::DistinctColors colors(colorsOf(value));
  for (const volume::Segment& segment : labels.segments)
  {
    scene::checkPartName(segment.name);
    if (const char* kind = scene::kindOfPart(value, segment.name))
      throw core::InvalidParameter(kind + (" '" + segment.name) +
                                   "' is in the case already; give it another name");
    if (segment.voxels == 0)
      throw core::InvalidParameter("structure '" + segment.name + "' has no voxel yet");
    scene::StructurePart structure;
    structure.name = segment.name;
    structure.index = segment.index;
    structure.voxels = segment.voxels;
    structure.volume = labels.volume(segment);
    structure.codes.algorithm = volume::SegmentCodes::Algorithm::SemiAutomatic;
    structure.codes.algorithmName = "Petrous";
    structure.look = presets.lookFor(structure.name);
    if (isUnknown(structure.look))
      structure.look.color = colors.next();
    else
      colors.take(structure.look.color);
    part.structures.push_back(std::move(structure));
  }
  part.drawnOn = std::string();
  part.labels = std::make_shared<const volume::LabelMap>(std::move(labels));
  value.labels.push_back(std::move(part));
}

void addParts(scene::Case& value, const PartSources& parts, const core::Progress& progress,
              std::vector<StructureReport>* report)
{
  std::vector<StructureReport> reports;
  scene::Case next = value;
  const std::size_t count = parts.mr.size() + parts.labels.size() + parts.meshes.size();
  std::size_t done = 0;
  const auto share = [&]
  {
    const double size = 1.0 / static_cast<double>(std::max<std::size_t>(count, 1));
    const double first = static_cast<double>(done++) * size;
    return progress.part(first, first + size);
  };
  if (!parts.mr.empty())
    settleDrawnOn(next);
  GivenNames given;
  for (const PartSource& source : parts.mr)
    given.record(next, source, [&] { addMr(next, source, parts.salted, share()); });
  for (const PartSource& source : parts.labels)
    given.record(next, source, [&] { addLabels(next, source, parts, share(), &reports); });
  for (const PartSource& source : parts.meshes)
    given.record(next, source, [&] { addMesh(next, source, parts.salted, share()); });
  for (const auto* kind : {&parts.mr, &parts.labels, &parts.meshes})
    for (const PartSource& source : *kind)
      next.origins.push_back({source.path, fs::file_time_type::clock::now()});
  value = std::move(next);
  if (report)
    report->insert(report->end(), reports.begin(), reports.end());
}

void leaveOutside(scene::Case& value, std::vector<StructureReport>& reports)
{
  std::set<std::string> outside;
  std::map<std::string, fs::path> files; // by the structure that was read from it
  for (StructureReport& one : reports)
  {
    if (one.status == StructureReport::Status::Read)
      files[one.name] = one.file;
    if (one.status == StructureReport::Status::Read && one.isOutside)
    {
      outside.insert(one.name);
      one.status = StructureReport::Status::Skipped;
      one.why = "it lies wholly outside of the image";
    }
  }
  const auto remainsOf = [&](const scene::LabelPart& part, const fs::path& file)
  {
    return std::any_of(part.structures.begin(), part.structures.end(),
                       [&](const scene::StructurePart& structure)
                       {
                         const auto of = files.find(structure.name);
                         return of != files.end() && of->second == file &&
                                outside.count(structure.name) == 0;
                       });
  };
  for (scene::LabelPart& part : value.labels)
  {
    std::vector<std::string> noted;
    for (const scene::StructurePart& structure : part.structures)
      if (outside.count(structure.name) > 0)
        noted.push_back(structure.name);
    if (noted.empty())
      continue;
    part.notes.erase(
        std::remove(part.notes.begin(), part.notes.end(), outsideNote(noted, primaryName(value))),
        part.notes.end());
    if (noted.size() < part.structures.size())
      continue;
    // The first map of a file has the notes about all of it.
    const fs::path file = files[noted.front()];
    const auto next = std::find_if(value.labels.begin(), value.labels.end(),
                                   [&](const scene::LabelPart& other)
                                   { return &other != &part && remainsOf(other, file); });
    if (next != value.labels.end())
      next->notes.insert(next->notes.begin(), part.notes.begin(), part.notes.end());
  }
  for (const std::string& name : outside)
    scene::removePart(value, name);
}

std::vector<PartFailure> addSoundParts(scene::Case& value, const PartSources& parts,
                                       const core::Progress& progress,
                                       std::vector<StructureReport>* report)
{
  std::vector<PartFailure> failures;
  scene::Case next = value;
  const std::size_t count = parts.mr.size() + parts.labels.size() + parts.meshes.size();
  std::size_t done = 0;
  GivenNames given;
  const auto add = [&](std::vector<PartSource> PartSources::*kind)
  {
    for (const PartSource& source : parts.*kind)
    {
      PartSources one;
      one.labelNames = parts.labelNames;
      one.salted = parts.salted;
      one.*kind = {source};
      const auto first = static_cast<double>(done++) / static_cast<double>(count);
      const core::Progress part =
          progress.part(first, static_cast<double>(done) / static_cast<double>(count));
      const std::size_t before = failures.size();
      try
      {
        given.record(next, source, [&] { addParts(next, one, part, report); });
      }
      catch (const core::CancelledError&)
      {
        throw;
      }
      catch (const MeshSpaceUnclear& unclear)
      {
        failures.push_back({source, unclear.what(), unclear.likely});
      }
      catch (const OtherPatient& other)
      {
        failures.push_back({source, other.what()});
        failures.back().isOtherPatient = true;
        failures.back().differing = other.differing;
      }
      catch (const ImageSideUnclear& unclear)
      {
        failures.push_back({source, unclear.what()});
        failures.back().isSideUnclear = true;
      }
      catch (const ImageUnitUnclear& unclear)
      {
        failures.push_back({source, unclear.what()});
        failures.back().unitDoubt = unclear.doubt;
      }
      catch (const FrameUnclear& unclear)
      {
        failures.push_back({source, unclear.what()});
        failures.back().isFrameUnclear = true;
      }
      catch (const LabelsUnrepaired& unrepaired)
      {
        failures.push_back({source, unrepaired.what()});
        failures.back().unrepaired = unrepaired.apart;
      }
      catch (const NamesTaken& taken)
      {
        failures.push_back({source, taken.what()});
        failures.back().taken = taken.names;
        failures.back().others = taken.others;
      }
      catch (const imaging::BitsUnclearError& unclear)
      {
        failures.push_back({source, unclear.what()});
        failures.back().isBitsUnclear = true;
        failures.back().canKeepBits = unclear.canKeep;
      }
      catch (const core::Error& error)
      {
        failures.push_back({source, error.what()});
      }
      if (failures.size() > before)
        failures.back().kind = kind;
    }
  };
  add(&PartSources::mr);
  add(&PartSources::labels);
  add(&PartSources::meshes);
  value = std::move(next);
  return failures;
}

} // namespace petrous::presenters
