#include "petrous/Presenters/CaseTransfer.h"
#include "petrous/Library/LibraryFiles.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/CasePatient.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Library/ScratchFolder.h"
#include "petrous/Network/SceneObjects.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CaseDicom.h"
#include "petrous/Presenters/CaseExport.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/LeavingImages.h"
#include "petrous/Scene/GoneNames.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/VideoNotes.h"

namespace petrous::presenters
{
namespace
{

namespace fs = std::filesystem;
using library::ScratchFolder;
using network::NetworkError;

constexpr const char* kSegmentationFile = "segmentation.dcm";

void addFiles(const fs::path& folder, std::vector<fs::path>& files)
{
  std::vector<fs::path> here;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file())
      here.push_back(entry.path());
  std::sort(here.begin(), here.end());
  files.insert(files.end(), here.begin(), here.end());
}

/// What was retrieved into a folder, sorted.
std::vector<fs::path> instancesIn(const fs::path& folder)
{
  std::vector<fs::path> files;
  addFiles(folder, files);
  files.erase(std::remove_if(files.begin(), files.end(),
                             [](const fs::path& file)
                             { return file.extension() != network::kInstanceEnding; }),
              files.end());
  return files;
}

/// The structures by space and grid: a segmentation has one of each.
std::vector<std::vector<PlacedLabels>> labelGroups(const scene::Case& value)
{
  std::vector<std::vector<PlacedLabels>> groups;
  for (const auto& part : value.labels)
  {
    PlacedLabels labels;
    for (const auto& structure : part.structures)
      labels.structures.push_back(&structure);
    if (labels.structures.empty())
      continue;
    labels.map = scene::labelsOnCt(value, part);
    if (!labels.map)
    {
      labels.map = part.labels.get();
      labels.drawnOn = scene::placementOf(value, part).drawnOn;
    }
    const auto belongs = [&](const std::vector<PlacedLabels>& group)
    {
      return group.front().drawnOn == labels.drawnOn &&
             core::sameGrid(group.front().map->voxels->geometry(), labels.map->voxels->geometry());
    };
    auto group = std::find_if(groups.begin(), groups.end(), belongs);
    if (group == groups.end())
      group = groups.insert(groups.end(), std::vector<PlacedLabels>());
    group->push_back(std::move(labels));
  }
  return groups;
}

/// Of the archive that the scene is.
library::ArchiveOptions archiveOptions(const SendParts& parts)
{
  library::ArchiveOptions options;
  options.withoutNotes = !parts.note;
  options.withVideos = parts.videos;
  options.withDocuments = parts.documents;
  return options;
}

/// Writes the parts below `folder`.
class Outgoing
{
public:
  Outgoing(const library::Library& library, const scene::Case& value, const SendParts& parts,
           const fs::path& folder)
    : m_library(library)
    , m_value(value)
    , m_parts(parts)
    , m_folder(folder)
    , m_alone(parts.ct + parts.mr + parts.labels + parts.scene + parts.primary == 1)
    , m_options(dicomOptionsOf(value, library))
  {
    m_options.segmentationNumber = stateNumber();
  }

  std::vector<fs::path> write(const core::Progress& progress)
  {
    const bool isMr = m_value.ct.modality == scene::Modality::Mr; // the primary image
    if (m_parts.ct && isMr && m_alone)
      leaveOut("case '" + m_value.name + "' has no CT: its primary image is an MR; send 'mr'");
    if (m_parts.primary || (isMr ? m_parts.mr : m_parts.ct))
      image(m_value.ct, "ct", "", progress.part(0.0, 0.3));
    if (m_parts.mr)
      for (const auto& mr : m_value.mr)
        image(mr, "mr", mr.name, progress.part(0.3, 0.5));
    if (m_parts.mr && m_value.mr.empty() && !isMr)
      leaveOut("case '" + m_value.name + "' has no MR");
    if (m_parts.labels)
      labels(progress.part(0.5, 0.6));
    if (m_parts.scene)
      scene(progress.part(0.6, 1.0));
    return m_files;
  }

  const std::vector<std::string>& notes() const noexcept { return m_notes; }

private:
  // Series number of what the case has in this state: the highest at a node is the latest.
  int stateNumber() const
  {
    constexpr std::uint64_t kMaxRevision = 1000000000; // of an integer string
    return 1000 + static_cast<int>(std::min<std::uint64_t>(m_value.revision, kMaxRevision));
  }

  // What was asked for by itself is refused, else noted.
  void leaveOut(const std::string& why)
  {
    if (m_alone)
      throw core::InvalidParameter("send: " + why);
    m_notes.push_back(why + "; it is not sent by itself");
  }

  fs::path freshFolder()
  {
    const fs::path folder = m_folder / std::to_string(++m_folders);
    fs::create_directory(folder);
    return folder;
  }

  void image(const scene::ImagePart& part, const std::string& what, const std::string& drawnOn,
             const core::Progress& progress)
  {
    const auto volume = part.volume.get();
    m_library.checkVoxels(m_value, progress);
    const fs::path folder = freshFolder();
    try
    {
      if (const auto error = writeCaseSeries(folder, m_value, what, part, *volume, drawnOn, false,
                                             m_options, progress);
          error && *error > 0.0)
        m_notes.push_back(roundingNote("'" + part.name + "'", *error));
    }
    catch (const FractionsError&)
    {
      leaveOut("the voxels of '" + part.name +
               "' are fractions, which 16 bits of a DICOM series do not hold within half a unit");
      return;
    }
    if (const std::string guessed = guessedNote(part); !guessed.empty())
      m_notes.push_back(guessed);
    addFiles(folder, m_files);
  }

  void labels(const core::Progress& progress)
  {
    const auto groups = labelGroups(m_value);
    if (groups.empty())
      leaveOut("case '" + m_value.name + "' has no structures");
    for (const auto& group : groups)
    {
      const std::string& drawnOn = group.front().drawnOn;
      const scene::ImagePart* source = &m_value.ct;
      for (const auto& mr : m_value.mr)
        if (!drawnOn.empty() && mr.name == drawnOn)
          source = &mr;
      const auto volume = source->volume.get();
      m_library.checkVoxels(m_value, progress);
      const std::string series =
          CaseIdentifiers(m_value).series(drawnOn.empty() ? "ct" : "mr", *volume);
      const fs::path file = freshFolder() / kSegmentationFile;
      writeCaseSegmentation(file, m_value, group, series, m_options, progress);
      m_files.push_back(file);
    }
    for (const scene::LabelPart& part : m_value.labels)
      if (std::string guessed = guessedNote(part); !guessed.empty())
        m_notes.push_back(std::move(guessed));
  }

  void scene(const core::Progress& progress)
  {
    const fs::path folder = freshFolder();
    const fs::path archive = m_folder / (std::string("scene") + library::kArchiveEnding);
    library::ArchiveOptions options = archiveOptions(m_parts);
    if (m_parts.mask.any())
      options.prepare = [this](scene::Case& copy, const core::Progress&)
      {
        copy.ct = m_value.ct;
        copy.mr = m_value.mr;
        return std::vector<std::string>();
      };
    const library::ArchiveSummary archived =
        library::archiveCase(m_library, m_value.name, archive, options, progress.part(0.0, 0.8));
    m_notes.insert(m_notes.end(), archived.notes.begin(), archived.notes.end());
    network::SceneDescription description;
    description.patientId = m_options.patient.id;
    description.patientName = m_options.patient.name;
    description.studyUid = CaseIdentifiers(m_value).study();
    description.studyId = m_options.studyId;
    description.seriesNumber = stateNumber();
    const auto files =
        network::writeSceneObjects(archive, folder, description, progress.part(0.8, 1.0));
    fs::remove(archive);
    m_files.insert(m_files.end(), files.begin(), files.end());
  }

  const library::Library& m_library;
  const scene::Case& m_value;
  SendParts m_parts;
  fs::path m_folder;
  bool m_alone;
  CaseDicomOptions m_options;
  int m_folders = 0;
  std::vector<fs::path> m_files;
  std::vector<std::string> m_notes;
};

/// What to say of segmentations that the node has in the study, and that are not among the files:
/// of earlier states. Empty also for a node that does not say.
std::string supersededSegmentations(const network::Node& node, const std::string& study,
                                    const std::vector<fs::path>& files,
                                    const core::Progress& progress)
{
  std::set<std::string> sent;
  for (const fs::path& file : files)
    if (file.filename() == kSegmentationFile)
      sent.insert(network::seriesOfFile(file));
  if (sent.empty())
    return {};
  try
  {
    std::size_t count = 0;
    int own = -1, other = -1; // the highest numbers
    for (const network::Series& one : network::findSeries(node, study, progress))
      if (sent.count(one.uid) > 0)
        own = std::max(own, one.number);
      else if (one.modality == "SEG")
      {
        ++count;
        other = std::max(other, one.number);
      }
    if (count == 0)
      return {};
    // Structures as they were before are the series that they were then.
    return "node '" + node.name + "' still has " + std::to_string(count) +
           (count == 1 ? " segmentation" : " segmentations") + " of an earlier state of this case" +
           (other >= own ? ", which 'petrous receive --study' would take for the latest" : "") +
           "; have what is superseded deleted there";
  }
  catch (const NetworkError&)
  {
    return {}; // everything arrived all the same
  }
}

std::string studyOf(const library::Library& library, const network::Node& node,
                    const ReceiveRequest& request, const core::Progress& progress)
{
  if (!request.studyUid.empty())
    return request.studyUid;
  std::vector<network::Study> studies;
  for (const std::string& id :
       {studyIdOf(request.caseName), hiddenStudyIdOf(library, request.caseName)})
    for (network::Study& study : network::findStudies(node, {{}, id}, progress))
      if (std::none_of(studies.begin(), studies.end(),
                       [&study](const network::Study& one) { return one.uid == study.uid; }))
        studies.push_back(std::move(study));
  // Of several only those count that hold a scene: images alone are no case.
  const auto lacksScene = [&](const network::Study& study)
  { return network::scenesAmong(network::findSeries(node, study.uid, progress)).empty(); };
  if (studies.size() > 1)
    studies.erase(std::remove_if(studies.begin(), studies.end(), lacksScene), studies.end());
  if (studies.empty())
    throw NetworkError(NetworkError::Reason::NotFound,
                       "node '" + node.name + "': has no scene of a case '" + request.caseName +
                           "'; give --study UID for a study that was not sent by Petrous, or by "
                           "another library without the name of the case ('petrous receive --list' "
                           "lists those)");
  if (studies.size() == 1)
    return studies.front().uid;
  if (library.contains(request.caseName)) // the one of this very case
  {
    const CaseIdentifiers own(library.open(request.caseName));
    for (const std::string& uid : {own.study(), own.formerStudy()})
      for (const auto& study : studies)
        if (study.uid == uid)
          return uid;
  }
  throw core::InvalidParameter("node '" + node.name + "': has " + std::to_string(studies.size()) +
                               " cases named '" + request.caseName +
                               "'; give --study UID, which 'petrous send' printed and 'petrous "
                               "receive --list' lists");
}

constexpr const char* kFormerPatientId = "ANONYMOUS"; // of all cases
constexpr const char* kFormerPatientName = "Anonymous";

// Name of each case of the library, by the study IDs that it may have at a node.
std::map<std::string, std::string> casesByStudyId(const library::Library& library)
{
  std::map<std::string, std::string> cases;
  for (const auto& one : library.list())
  {
    cases[studyIdOf(one.name)] = one.name;
    cases[hiddenStudyIdOf(library, one.name)] = one.name;
  }
  return cases;
}

// `cases`: casesByStudyId.
FoundStudy foundStudy(network::Study study, const std::map<std::string, std::string>& cases)
{
  FoundStudy found;
  const bool isFormer = study.patientId == kFormerPatientId && isStudyId(study.studyId);
  found.isCase = isFormer || imaging::isCasePatientId(study.patientId);
  const std::string family = std::string(imaging::kCaseFamilyName) + "^";
  const bool isOurs = study.patientName.compare(0, family.size(), family) == 0;
  const std::string given = isOurs ? study.patientName.substr(family.size()) : std::string();
  const bool isTold = isOurs && !imaging::isCasePatientId(given);
  if (found.isCase && !isFormer && isTold)
    found.caseName = given;
  if (const auto own = cases.find(study.studyId); found.isCase && own != cases.end())
  {
    found.caseName = own->second;
    const bool isNobody = study.patientName.empty() || (isOurs && !isTold) ||
                          (isFormer && study.patientName == kFormerPatientName);
    if (!isNobody && (!isTold || given != toldName(own->second)))
      found.otherName = study.patientName;
  }
  found.study = std::move(study);
  return found;
}

// `part`: as StudySearch::caseName; `hiddenId`: hiddenStudyIdOf it.
bool hasName(const FoundStudy& found, const std::string& part, const std::string& hiddenId)
{
  if (found.study.studyId == studyIdOf(part) || found.study.studyId == hiddenId)
    return true;
  const std::string name = scene::lowerCase(found.caseName);
  const std::string wanted = scene::lowerCase(part);
  std::size_t at = 0;
  for (std::size_t begin = 0; begin <= wanted.size();)
  {
    const std::size_t end = std::min(wanted.find('*', begin), wanted.size());
    at = name.find(wanted.substr(begin, end - begin), at);
    if (at == std::string::npos)
      return false;
    at += end - begin;
    begin = end + 1;
  }
  return true;
}

std::vector<FoundStudy> valuesOf(std::map<std::string, FoundStudy> found)
{
  std::vector<FoundStudy> values;
  for (auto& [uid, one] : found)
    values.push_back(std::move(one));
  return values;
}

std::string freeName(const library::Library& library, const std::string& name)
{
  if (const std::string taken = library::caseLike(library.folder(), name); !taken.empty())
    throw NameTakenError(name, "case '" + taken + "' is there already in " +
                                   library.folder().string() + "; choose another name with --as");
  return name;
}

/// Fits a short string (SH).
std::string shortHash(const std::string& text)
{
  return library::sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())
      .substr(0, 16);
}

/// Before the scene of a study is transferred: a case of its name is in the library.
void refuseTakenScene(const library::Library& library, const network::Node& node,
                      const std::string& study, const core::Progress& progress)
{
  for (const auto& found : network::findStudies(node, {study, {}}, progress))
  {
    const auto cases = casesByStudyId(library);
    if (const auto there = cases.find(found.studyId); there != cases.end())
      freeName(library, there->second);
  }
}

/// Without the volume of a series with several; empty: any CT.
std::string seriesUidOf(const std::string& selector)
{
  return selector.substr(0, selector.find('#'));
}

/// Which of a series' volumes a case is built of is the user's choice, even if only one is sound:
/// they may be the two ears.
void refuseVolumes(const std::vector<const imaging::DicomSeries*>& cts)
{
  if (std::none_of(cts.begin(), cts.end(), [](const auto* ct) { return !ct->volume.empty(); }))
    return;
  std::string volumes;
  for (const imaging::DicomSeries* ct : cts)
    volumes += (volumes.empty() ? "'" : ", '") + core::printable(ct->volume) + "' (" +
               std::to_string(ct->geometry.slices.size()) + " images" +
               (ct->geometry.verdict == imaging::Verdict::Ok ? ")" : ", doubtful)");
  throw core::InvalidParameter("receive: the CT has " + std::to_string(cts.size()) +
                               " volumes; name one by --volume: " + volumes);
}

/// A case of what imaging finds in the folder.
scene::Case builtCase(const fs::path& folder, const std::string& name,
                      const ReceiveRequest& request, std::vector<std::string>& notes,
                      const core::Progress& progress)
{
  const imaging::ScanResult scan = imaging::scanDicom(folder, progress.part(0.0, 0.2));
  CaseSources sources;
  sources.ct = folder;
  sources.repair = request.repair;
  sources.undeclaredBits = request.undeclaredBits;
  sources.series = request.series;
  if (sources.series == seriesUidOf(sources.series)) // without a volume
  {
    std::vector<const imaging::DicomSeries*> cts, good;
    for (const auto& one : scan.series)
      if (one.modality == "CT" && (sources.series.empty() || one.uid == sources.series))
      {
        cts.push_back(&one);
        if (one.geometry.verdict == imaging::Verdict::Ok)
          good.push_back(&one);
      }
    refuseVolumes(cts);
    if (good.size() == 1)
      sources.series = imaging::selectorOf(*good.front());
  }
  int number = 0;
  for (const auto& one : scan.series)
    if (one.modality == "MR" && one.uid != seriesUidOf(sources.series))
    {
      if (one.geometry.verdict != imaging::Verdict::Ok && !request.repair)
      {
        notes.push_back("an MR series is left out, as its geometry is doubtful; try --repair");
        continue;
      }
      ++number;
      PartSource mr;
      mr.name = number == 1 ? "MR" : "MR " + std::to_string(number);
      mr.path = folder;
      mr.series = imaging::selectorOf(one);
      mr.repair = request.repair;
      mr.undeclaredBits = request.undeclaredBits;
      sources.parts.mr.push_back(std::move(mr));
    }
  scene::Case value = buildCase(name, sources, progress.part(0.2, 1.0));
  const auto tell = [&notes](const std::string& what, const scene::ImagePart& part)
  {
    for (const std::string& note : part.notes)
      notes.push_back(what + ": " + note);
  };
  tell(primaryName(value), value.ct);
  for (const auto& mr : value.mr)
    tell(mr.name, mr);
  return value;
}

/// The structures of DICOM segmentations, the latest first: of those of one name the others are
/// left out, as one that does not belong to the images.
void addSegmentations(scene::Case& value, const std::vector<network::Series>& series,
                      const fs::path& folder, std::vector<std::string>& notes,
                      const core::Progress& progress)
{
  const auto numberOf = [&series](const fs::path& file)
  {
    const std::string uid = network::seriesOfFile(file);
    const auto of = std::find_if(series.begin(), series.end(),
                                 [&uid](const network::Series& one) { return one.uid == uid; });
    return of == series.end() ? -1 : of->number;
  };
  std::vector<std::pair<int, fs::path>> ordered;
  for (const fs::path& file : instancesIn(folder))
    ordered.emplace_back(numberOf(file), file);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::optional<int> latest; // of those that were added
  std::size_t earlier = 0;
  for (const auto& [number, file] : ordered)
    try
    {
      PartSources sources;
      sources.labels.push_back({{}, file});
      addParts(value, sources, progress);
      latest = latest.value_or(number);
    }
    catch (const core::CancelledError&)
    {
      throw;
    }
    catch (const core::Error&)
    {
      if (latest && number < *latest)
        ++earlier;
      else
        notes.push_back(
            latest && number == *latest
                ? "a segmentation of the study is left out: it does not belong to these images, "
                  "cannot be read, or names structures of another one, and the node does not tell "
                  "which is the later; compare them there"
                : "a segmentation of the study is left out: it does not belong to these images, "
                  "cannot be read, or names structures that are there already");
    }
  if (earlier > 0)
    notes.push_back((earlier == 1
                         ? "a segmentation of an earlier state is"
                         : std::to_string(earlier) + " segmentations of earlier states are") +
                    " left out: the latest by its series number was taken");
}

void add(network::Transfer& sum, const network::Transfer& more)
{
  sum.instances += more.instances;
  sum.completed += more.completed;
  sum.present += more.present;
  sum.warning += more.warning;
  sum.asked = std::max(sum.asked, more.asked);
  sum.bytes += more.bytes;
  sum.seconds += more.seconds;
}

/// Before minutes of transfer, which would end in the same question.
void refuseSeveralCts(const network::Node& node, const std::vector<network::Series>& series,
                      const ReceiveRequest& request)
{
  constexpr int kScout = 2; // images; what has more may be a volume
  std::string counts;
  std::size_t cts = 0;
  for (const network::Series& one : series)
    if (one.modality == "CT" && (one.instances < 0 || one.instances > kScout))
    {
      ++cts;
      counts += (counts.empty() ? "" : ", ") + core::printable(one.uid) +
                (one.instances >= 0 ? " (" + std::to_string(one.instances) + " images)" : "");
    }
  if (cts > 1 && seriesUidOf(request.series).empty())
    throw core::InvalidParameter("node '" + node.name + "': the study has " + std::to_string(cts) +
                                 " CT series; name one by --series: " + counts);
}

/// The archive of the latest scene that is whole: of one whose sending was cut, the node has parts.
/// Receives the latest state of the scene that is whole. False, with a note, if none is and the
/// node describes none of the series: then they may be anybody's.
bool receiveScene(const network::Node& node, const std::string& study,
                  const std::vector<network::Series>& scenes, const fs::path& folder,
                  const fs::path& archive, ReceiveSummary& summary, const core::Progress& progress)
{
  std::exception_ptr first; // of a described one, if there is any
  bool isDescribedFailed = false;
  std::string why;
  for (const network::Series& scene : scenes)
  {
    const auto fail = [&](const core::Error& error)
    {
      const bool isDescribed = !scene.description.empty();
      if (!first || (isDescribed && !isDescribedFailed))
      {
        first = std::current_exception();
        why = error.what();
      }
      isDescribedFailed = isDescribedFailed || isDescribed;
    };
    try
    {
      // Of each state of the scene: an earlier transfer may have left parts of another one.
      const fs::path parts = folder / ("scene-" + shortHash(scene.uid));
      const network::Transfer transfer =
          network::retrieve(node, study, {scene.uid}, parts, progress.part(0.0, 0.9));
      network::readSceneObjects(instancesIn(parts), archive, progress.part(0.9, 1.0));
      summary.transfer = transfer;
      if (first && !isDescribedFailed)
        summary.notes.push_back("node '" + node.name + "' does not describe series " +
                                std::to_string(scenes.front().number) +
                                ", which may hold a later state of the case, but was not read as "
                                "one: " +
                                why);
      else if (first)
        summary.notes.push_back("a later state of the case is at node '" + node.name +
                                "', but cannot be received: " + why +
                                ". This is the state before it");
      return true;
    }
    catch (const core::InvalidParameter& error)
    {
      fail(error);
    }
    catch (const NetworkError& error)
    {
      // One that is not described is a guess, and need not even be of a class that is received.
      if (!scene.description.empty() && error.reason != NetworkError::Reason::Incomplete &&
          error.reason != NetworkError::Reason::NotFound)
        throw;
      fail(error);
    }
  }
  if (std::any_of(scenes.begin(), scenes.end(),
                  [](const network::Series& scene) { return !scene.description.empty(); }))
    std::rethrow_exception(first);
  summary.notes.push_back("node '" + node.name + "' does not describe series " +
                          std::to_string(scenes.front().number) +
                          ", which may hold a case of Petrous, but was not read as one: " + why);
  return false;
}

} // namespace

std::string IdentityReport::text() const
{
  std::string all;
  const auto add = [&all](const std::string& title, const std::vector<std::string>& lines)
  {
    if (lines.empty())
      return;
    all += (all.empty() ? "" : "\n") + title + "\n";
    for (const std::string& line : lines)
      all += "  - " + line + "\n";
  };
  add("May identify the patient:", warnings);
  add("Look at these:", counted);
  add("Goes along:", leaves);
  add("Stays here:", stays);
  return all;
}

namespace
{

std::string joined(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

// From side to side and from front to back as much as a head: then its skin is in the image, and a
// face can be rendered from it.
// `mask`: all outside of its region is air.
bool showsHead(const core::GridGeometry& grid, const scene::ImageMask& mask)
{
  constexpr double kHead = 140.0;  // mm; narrower heads than that are not adults'
  constexpr double kHeight = 30.0; // mm; a band of a face
  std::array<double, 3> size{};
  for (int axis = 0; axis < 3; ++axis)
    size[static_cast<std::size_t>(axis)] =
        grid.spacing()[axis] * grid.dims()[static_cast<std::size_t>(axis)];
  if (mask.region)
  {
    const Eigen::Vector3d left = mask.region->intersection(grid.patientBounds()).sizes();
    size = {left[0], left[1], left[2]};
  }
  std::sort(size.begin(), size.end());
  return size[1] >= kHead && size[0] >= kHeight;
}

// `what`: that a face was left, and where.
std::string faceText(const std::string& what)
{
  return what + ": who sees it can recognise the patient. Mask it (--mask-face; in the window: put "
                "air in place of the face), or hand on the region of the ear alone (--roi; in the "
                "window: File > Open a region)";
}

std::string headText()
{
  return faceText("the image holds a whole head, and its face was left");
}

bool anyShowsHead(const std::vector<scene::ImagePart>& images, const scene::ImageMask& mask)
{
  return std::any_of(images.begin(), images.end(),
                     [&mask](const auto& image) { return showsHead(image.geometry, mask); });
}

void warnOfIdentities(const IdentityText& identity, const std::string& what,
                      const std::vector<std::string>& texts, std::vector<std::string>& warnings,
                      std::vector<std::string>* counted = nullptr)
{
  constexpr std::size_t kMostShown = 20;
  constexpr std::size_t kLongestShown = 80; // bytes
  std::vector<std::string> found;
  std::copy_if(texts.begin(), texts.end(), std::back_inserter(found),
               [&identity](const std::string& text) { return identity.mayIdentify(text); });
  if (found.empty())
    return;
  const std::size_t count = found.size();
  warnings.push_back(what + ": " + std::to_string(count) + " of " + std::to_string(texts.size()) +
                     " may be a patient's name, number or date; change what is one before you "
                     "send");
  if (!counted)
    return;
  std::string names;
  for (std::size_t n = 0; n < std::min(count, kMostShown); ++n)
    names += (n == 0 ? "'" : ", '") + shownName(core::utf8Prefix(found[n], kLongestShown)) + "'";
  if (count > kMostShown)
    names += ", ...";
  counted->push_back(what + ", which may be a patient's: " + names);
}

std::vector<std::string> textsOf(const std::vector<scene::ImageWithFace>& images)
{
  std::vector<std::string> texts;
  for (const scene::ImageWithFace& image : images)
    texts.push_back(image.text);
  return texts;
}

/// Text in the pixels of images that leave: the primary one, the MRs.
void warnOfText(const scene::Case& value, bool primary, bool mrs,
                std::vector<std::string>& warnings)
{
  const auto mayHaveText = [](const scene::ImagePart& image)
  { return image.provenance.pixels.burnedIn != volume::BurnedInText::None; };
  std::vector<std::string> images;
  if (primary && mayHaveText(value.ct))
    images.push_back(std::string("the ") + primaryName(value));
  for (const scene::ImagePart& mr : value.mr)
    if (mrs && mayHaveText(mr))
      images.push_back("MR '" + mr.name + "'");
  if (!images.empty())
    warnings.push_back("the pixels of " + joined(images) +
                       " may have text in them, which may name the patient: look at them");
}

/// What import and registration noted, in sentences of the program's own.
std::vector<std::string> notesOf(const scene::Case& value)
{
  std::vector<std::string> all = value.ct.notes;
  const auto add = [&all](const std::vector<std::string>& notes)
  { all.insert(all.end(), notes.begin(), notes.end()); };
  for (const scene::ImagePart& mr : value.mr)
  {
    add(mr.notes);
    if (mr.registration && !mr.registration->text.empty())
      all.push_back(mr.registration->text);
    if (mr.registration && mr.registration->error)
      all.push_back(mr.registration->error->place);
  }
  for (const scene::LabelPart& part : value.labels)
    add(part.notes);
  for (const scene::MeshPart& mesh : value.meshes)
    add(mesh.notes);
  return all;
}

/// Structures that strokes removed from and that the case has no more, by the names of then.
std::vector<std::string> goneStructures(const scene::Case& value)
{
  const std::vector<std::string> parts = scene::partNames(value);
  std::set<std::string> gone;
  for (const auto& stroke : value.dissection.strokes())
    for (const auto& touched : stroke->info.structures)
      if (std::find(parts.begin(), parts.end(), touched.name) == parts.end())
        gone.insert(touched.name);
  return {gone.begin(), gone.end()};
}

} // namespace

std::vector<scene::ImageWithFace>
facesToMask(const scene::Case& value, const core::Progress& progress, scene::FaceFindings* found)
{
  const bool mayShow = showsHead(value.ct.geometry, {}) || anyShowsHead(value.mr, {});
  return mayShow ? scene::imagesWithFace(value, progress, found)
                 : std::vector<scene::ImageWithFace>();
}

std::vector<std::string> faceWarnings(const std::vector<scene::ImageWithFace>& left)
{
  std::vector<scene::ImageWithFace> maskable, others;
  std::partition_copy(left.begin(), left.end(), std::back_inserter(maskable),
                      std::back_inserter(others),
                      [](const scene::ImageWithFace& image) { return image.fault.empty(); });
  std::vector<std::string> warnings;
  if (!maskable.empty())
    warnings.push_back(faceText("the face was left in " + joined(textsOf(maskable))));
  if (!others.empty())
    warnings.push_back("the face was left in " + joined(textsOf(others)) +
                       ": who sees it can recognise the patient, and it cannot be masked");
  for (const scene::ImageWithFace& image : others)
    warnings.push_back(image.fault);
  return warnings;
}

namespace
{

IdentityText identityOf(const scene::Case& value, const library::Library* library)
{
  return library ? IdentityText(value, *library) : IdentityText(value);
}

// `options`: of the archive, if `parts.scene`.
IdentityReport reportOf(scene::Case value, const SendParts& parts,
                        const library::ArchiveOptions& options,
                        const std::vector<scene::ImageWithFace>* faces,
                        const IdentityText& identity)
{
  IdentityReport report;
  const std::size_t noted = notesOf(value).size();
  scene::forgetGoneNames(value); // as the archive does
  const auto warn = [&](const std::string& what, const std::vector<std::string>& texts)
  { warnOfIdentities(identity, what, texts, report.warnings, &report.counted); };
  const bool planOnly = options.planOnly;
  const bool keepIdentity = options.keepIdentity;
  const bool isCt = value.ct.modality != scene::Modality::Mr;
  const bool whole = parts.scene && !planOnly;
  const bool images = whole || (!parts.scene && isSent(value, parts, {}));
  const auto voxels = [](const scene::ImagePart& part)
  {
    const auto& dims = part.geometry.dims();
    return std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
           std::to_string(dims[2]) + " voxels";
  };
  if (images)
    report.leaves.push_back(std::string(isCt ? "CT: " : "MR: ") + voxels(value.ct) +
                            " and their place in space");
  if (parts.mr || whole)
    for (const auto& mr : value.mr)
      report.leaves.push_back("MR '" + mr.name + "': " + voxels(mr) + " and their place in space");
  std::vector<std::string> structures, meshes, measurements, codes;
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
    {
      structures.push_back(structure.name);
      for (const auto* concept :
           {&structure.codes.category, &structure.codes.type, &structure.codes.typeModifier,
            &structure.codes.region, &structure.codes.regionModifier})
        if (!concept->meaning.empty())
          codes.push_back(concept->meaning);
      if (!structure.codes.algorithmName.empty())
        codes.push_back(structure.codes.algorithmName);
    }
  for (const auto& mesh : value.meshes)
    meshes.push_back(mesh.name);
  for (const auto& measurement : value.measurements)
    measurements.push_back(measurement.name);
  if ((parts.labels || parts.scene) && !structures.empty())
    report.leaves.push_back(
        std::string(planOnly ? "the names of structures: " : "structures, by their names: ") +
        shownName(joined(structures)));
  if (parts.scene)
  {
    report.leaves.push_back(std::string(planOnly ? "the plan" : "the scene") + " by its name '" +
                            value.name + "': strokes, approaches, appearance, views, landmarks");
    if (!meshes.empty())
      report.leaves.push_back(
          std::string(planOnly ? "the names of meshes: " : "meshes, by their names: ") +
          shownName(joined(meshes)));
    if (value.view.instrument)
      report.leaves.push_back("the surface of the instrument, without the name of its file");
    if (const auto gone = goneStructures(value); !gone.empty())
      report.leaves.push_back("names of structures that are gone, in strokes that touched them: " +
                              joined(gone));
    const std::vector<std::string> notes = notesOf(value);
    if (!notes.empty())
      report.leaves.push_back(
          "what was noted on import and registration: " + std::to_string(notes.size()) +
          (notes.size() == 1 ? " sentence" : " sentences"));
    if (notes.size() < noted)
      report.stays.emplace_back("what was noted of parts that the case does not have any more, or "
                                "calls otherwise by now");
    if (std::any_of(notes.begin(), notes.end(),
                    [&identity](const std::string& note)
                    { return identity.mayIdentifySentence(note); }))
      report.warnings.emplace_back("what was noted on import and registration: has what may be a "
                                   "patient's name, number or date; look at the notes of the case");
    if (!value.ct.patient.empty() || !value.ct.frameOfReference.empty() ||
        std::any_of(value.mr.begin(), value.mr.end(),
                    [](const scene::ImagePart& mr)
                    { return !mr.patient.empty() || !mr.frameOfReference.empty(); }))
    {
      report.leaves.emplace_back("marks of the patient and of the scanner's frame of reference, "
                                 "sealed: nobody but this library can read them, or tell by them "
                                 "that two cases are of one patient");
    }
    if (planOnly && !value.mr.empty())
    {
      std::vector<std::string> mrs;
      for (const auto& mr : value.mr)
        mrs.push_back(mr.name);
      report.leaves.push_back("the names of MRs: " + joined(mrs));
    }
    const scene::Description& words = value.description;
    std::vector<std::string> lines = words.tags;
    for (const std::string* line : {&words.diagnosis, &words.procedure})
      if (!line->empty())
        lines.push_back(*line);
    if (!lines.empty())
      report.leaves.push_back("tags, diagnosis and procedure: " + joined(lines));
    if (!words.note.empty())
      (parts.note ? report.leaves : report.stays)
          .push_back(parts.note ? "the note, as it is" : "the note");
    auto& kept = keepIdentity ? report.leaves : report.stays;
    if (!words.date.empty())
      kept.emplace_back("the planned date of the operation");
    if (!words.date.empty() && keepIdentity)
      report.warnings.push_back("the planned date: together with a list of the day's operations "
                                "it tells who the patient is");
    const auto& strokes = value.dissection.strokes();
    if (std::any_of(strokes.begin(), strokes.end(),
                    [](const auto& stroke) { return !stroke->info.startedAt.empty(); }))
      kept.emplace_back("date and time of each stroke");
    for (const scene::ImagePart& mr : value.mr)
      if (mr.registration && mr.registration->signOff && !mr.registration->signOff->who.empty())
      {
        const std::string who = "who signed the registration of MR '" + mr.name + "', and when";
        kept.push_back(keepIdentity ? who : who + " (it stays marked as signed)");
        if (keepIdentity)
          report.warnings.push_back(who + ": a clinician's name and a date lead to the hospital's "
                                          "patients of that day");
      }
    if (std::any_of(value.attachments.begin(), value.attachments.end(),
                    [](const scene::Attachment& one) { return !one.date.empty(); }))
      kept.emplace_back("the dates of attachments");
    std::vector<std::string> files, staying, texts;
    for (const scene::Attachment& one : value.attachments)
    {
      const bool leaves = library::takesAlong(options, one);
      (leaves ? files : staying).push_back("'" + one.name + "'");
      if (!leaves)
        continue;
      texts.push_back(one.name);
      if (parts.note && !one.note.empty())
        texts.push_back(one.note);
      if (one.video)
        for (const scene::VideoNotes::Bookmark& bookmark : one.video->bookmarks)
          texts.push_back(bookmark.name);
    }
    if (!files.empty())
    {
      report.leaves.push_back("attachments: " + joined(files));
      report.warnings.push_back("attachments: what they show and say is not looked at, and only "
                                "screenshots are cleaned of metadata");
      warn("names and notes of attachments", texts);
    }
    if (!staying.empty())
      report.stays.push_back("attachments: " + joined(staying));
    if (!measurements.empty())
      report.leaves.push_back("marks and measurements: " + joined(measurements));
  }
  if (parts.scene && parts.note && !value.description.note.empty())
    report.warnings.push_back(
        identity.mayIdentify(value.description.note)
            ? "the note: has what may be a patient's name, number or date, and nothing is removed "
              "from it"
            : "the note: read it once more, nothing is removed from it");
  if (parts.labels || parts.scene)
  {
    warn("names of structures", structures);
    warn("codes and algorithms that segmentation files gave structures", codes);
  }
  if (parts.scene)
  {
    warn("names of meshes", meshes);
    std::vector<std::string> others;
    for (const scene::ImagePart& mr : value.mr)
      others.push_back(mr.name);
    for (const dissection::History::Branch& branch : value.dissection.history().branches())
      others.push_back(branch.name);
    for (const auto& [name, saved] : value.view.saved)
      others.push_back(name);
    warn("names of MRs, approaches and saved views", others);
    warn("names of structures that are gone, in strokes that touched them", goneStructures(value));
    warn("names of measurements", measurements);
    warn("tags", value.description.tags);
    warn("name of the case, diagnosis and procedure",
         {value.name, value.description.diagnosis, value.description.procedure});
  }
  warnOfText(value, images, parts.mr || whole, report.warnings);
  if (faces)
  {
    if (!faces->empty() && parts.mask.face && (images || parts.mr))
      report.stays.push_back("the face, which is masked in " + joined(textsOf(*faces)));
    else if (images || parts.mr)
      for (std::string& warning : faceWarnings(*faces))
        report.warnings.push_back(std::move(warning));
  }
  else if ((images && showsHead(value.ct.geometry, parts.mask)) ||
           ((parts.mr || whole) && anyShowsHead(value.mr, parts.mask)))
    (parts.mask.face ? report.stays : report.warnings)
        .push_back(parts.mask.face ? "the face, which is masked where one is found" : headText());
  if (planOnly)
    report.stays.push_back("images, structures and meshes: the plan is restored where the very "
                           "same CT is");
  return report;
}

} // namespace

IdentityReport identityReport(const scene::Case& value, const SendParts& parts,
                              const std::vector<scene::ImageWithFace>* faces,
                              const library::Library* library)
{
  IdentityReport report =
      reportOf(value, parts, archiveOptions(parts), faces, identityOf(value, library));
  report.stays.push_back("name, birth date, numbers and other data of the patient, hospital and "
                         "physicians, dates and times: the case has none of them");
  if (library)
  {
    const CasePatient patient = CaseIdentifiers(value).patient(*library);
    report.leaves.push_back(
        "as the patient '" + patient.name + "', ID " + patient.id +
        (patient.isNameHidden()
             ? ": a pseudonym without the name of the case, which may be a patient's, or is not "
               "known to be none"
             : ": a pseudonym with the name of the case"));
    if (patient.isNameHidden())
      report.stays.push_back("the name of the case as a patient's: " + patient.whyNameHidden +
                             (parts.scene ? ". It is within the scene" : ""));
  }
  report.stays.push_back("UIDs of the scanner's files: the objects have new ones");
  if (!parts.scene)
    report.stays.push_back("strokes, views and description of the case");
  return report;
}

IdentityReport identityReport(const scene::Case& value, const library::ArchiveOptions& options,
                              const scene::ImageMask& mask, const library::Library* library,
                              const std::vector<scene::ImageWithFace>* faces)
{
  SendParts parts;
  parts.scene = true;
  parts.note = !options.withoutNotes;
  parts.mask = mask;
  IdentityReport report = reportOf(value, parts, options, faces, identityOf(value, library));
  report.stays.push_back("name, birth date, numbers and other data of the patient, hospital and "
                         "physicians, dates and times of the scan: the case has none of them");
  report.stays.push_back("UIDs of the scanner's files: the case has none of them");
  return report;
}

std::vector<std::string> identityWarnings(const scene::Case& value, const ExportOptions& options,
                                          const library::Library* library)
{
  std::vector<std::string> warnings;
  const std::string& what = options.what;
  const bool isMr = what == "mr";
  if (!options.mask.face && (isMr ? anyShowsHead(value.mr, options.mask)
                                  : (what == "ct" || what == "dissected" || what == "surface") &&
                                        showsHead(value.ct.geometry, options.mask)))
    warnings.push_back(headText());
  warnOfText(value, what == "ct" || what == "dissected", isMr, warnings);
  std::vector<std::string> names;
  if (what == "labels" || what == "structure")
    for (const std::string& name : scene::partNames(value))
      if (options.part.empty() || name == options.part)
        if (scene::findStructure(value, name) ||
            (what == "structure" &&
             std::any_of(value.meshes.begin(), value.meshes.end(),
                         [&name](const scene::MeshPart& mesh) { return mesh.name == name; })))
          names.push_back(name);
  warnOfIdentities(identityOf(value, library), "names of structures", names, warnings);
  return warnings;
}

namespace
{

// What stays here cannot keep the rest from being sent. Structures refer to the series of their
// image as it would be sent, masked where it can be.
std::vector<std::string> maskSent(const library::Library& library, scene::Case& value,
                                  const SendParts& parts, const core::Progress& progress)
{
  scene::ImageMask mask = parts.mask;
  if (!mask.any())
    return {};
  mask.images.emplace();
  std::set<std::string> referred;
  const auto sort = [&](const std::string& name)
  { (isSent(value, parts, name) ? *mask.images : referred).insert(name); };
  sort({});
  for (const scene::ImagePart& mr : value.mr)
    sort(mr.name);
  const auto notes = maskLeavingImages(library, value, mask, progress);
  if (parts.labels)
    for (const std::string& name : referred)
      try
      {
        mask.images = {name};
        maskLeavingImages(library, value, mask, progress);
      }
      catch (const core::Error& error)
      {
        if (error.fault() != core::Fault::Refused)
          throw;
      }
  return notes;
}

} // namespace

bool isSent(const scene::Case& value, const SendParts& parts, const std::string& mr)
{
  if (parts.scene)
    return true;
  if (!mr.empty())
    return parts.mr;
  return parts.primary || (value.ct.modality == scene::Modality::Mr ? parts.mr : parts.ct);
}

std::string unlistedText(const network::Transfer& sent)
{
  switch (sent.listed)
  {
  case network::Transfer::Listed::All:
    return {};
  case network::Transfer::Listed::None:
    return "lists none of them (yet)";
  case network::Transfer::Listed::Unanswered:
    return "did not answer when it was asked for them";
  case network::Transfer::Listed::NotOffered:
    break;
  }
  return "offers no queries";
}

SendSummary sendCase(const library::Library& library, const std::string& name,
                     const network::Node& node, const SendParts& parts,
                     const core::Progress& progress)
{
  network::echo(node, progress); // before minutes of writing
  scene::Case value = library.open(name);
  std::vector<std::string> masked = maskSent(library, value, parts, progress.part(0.0, 0.1));
  const ScratchFolder scratch;
  Outgoing outgoing(library, value, parts, scratch.path());
  const auto files = outgoing.write(progress.part(0.1, 0.4));
  SendSummary summary;
  summary.notes = std::move(masked);
  summary.notes.insert(summary.notes.end(), outgoing.notes().begin(), outgoing.notes().end());
  summary.studyUid = CaseIdentifiers(value).study();
  summary.patient = CaseIdentifiers(value).patient(library);
  if (summary.patient.isNameHidden())
    summary.notes.push_back("the name of the case is not the patient's name at node '" + node.name +
                            "': " + summary.patient.whyNameHidden);
  if (summary.patient.isNameHidden() && parts.scene)
    summary.notes.push_back("another library does not find it there by its name: it receives the "
                            "study " +
                            summary.studyUid + ", of the patient ID " + summary.patient.id);
  library.checkVoxels(value, progress);
  summary.transfer = network::store(node, files, progress.part(0.4, 1.0));
  if (std::string note = supersededSegmentations(node, summary.studyUid, files, progress);
      !note.empty())
    summary.notes.push_back(std::move(note));
  return summary;
}

FoundStudies searchStudies(const network::Node& node, const StudySearch& search,
                           const library::Library& library, const core::Progress& progress)
{
  FoundStudies result;
  const auto cases = casesByStudyId(library);
  const std::string hiddenId =
      cases.empty() ? std::string() : hiddenStudyIdOf(library, search.caseName);
  std::map<std::string, FoundStudy> found;
  const auto ask = [&](const network::StudyFilter& filter, bool onlyCases)
  {
    for (network::Study& study : network::findStudies(node, filter, progress))
      if (FoundStudy one = foundStudy(std::move(study), cases);
          !onlyCases || (one.isCase && hasName(one, search.caseName, hiddenId)))
        found.emplace(one.study.uid, std::move(one));
  };
  network::StudyFilter filter = search.filter;
  const bool isOfPatient = !filter.patientId.empty() || !filter.patientName.empty();
  const bool isDated = !filter.from.empty() || !filter.to.empty();
  if (search.caseName.empty() && (isOfPatient || isDated))
    ask(filter, false);
  if (search.caseName.empty() && isOfPatient && !isDated)
  {
    result.studies = valuesOf(std::move(found));
    return result;
  }
  filter.from.clear();
  filter.to.clear();
  if (search.caseName.empty() && isOfPatient)
    ask(filter, true);
  else
  {
    filter.patientName.clear();
    filter.patientId = imaging::kCasePatientIds;
    ask(filter, true);
    // An ID that other programs give, too: of those a node may have more than it is to list.
    filter.patientId = kFormerPatientId;
    try
    {
      ask(filter, true);
    }
    catch (const NetworkError& error)
    {
      if (error.reason != NetworkError::Reason::TooMany &&
          error.reason != NetworkError::Reason::Failed)
        throw;
      result.notes.push_back(
          "cases that were sent by the program's first version are not listed: " +
          std::string(error.what()));
    }
  }
  result.studies = valuesOf(std::move(found));
  return result;
}

ReceiveSummary receiveCase(library::Library& library, const network::Node& node,
                           const ReceiveRequest& request, const core::Progress& progress)
{
  if (!request.as.empty())
  {
    scene::checkCaseName(request.as);
    freeName(library, request.as);
  }
  std::optional<ScratchFolder> scratch; // and removes those that are left, whatever the node says
  if (request.partial.empty())
    scratch.emplace();
  const std::string study = studyOf(library, node, request, progress);
  const auto series = network::findSeries(node, study, progress);
  if (series.empty())
    throw NetworkError(NetworkError::Reason::NotFound,
                       "node '" + node.name +
                           "': has no such study; check the UID, or ask the "
                           "node's administrator whether it was deleted");
  // A folder of its own for each study: what is found in it makes the case.
  const fs::path folder = (scratch ? scratch->path() : request.partial) / shortHash(study);

  ReceiveSummary summary;
  if (const auto scenes =
          request.series.empty() ? network::scenesAmong(series) : std::vector<network::Series>();
      !scenes.empty())
  {
    if (request.as.empty())
      refuseTakenScene(library, node, study, progress);
    const fs::path archive = folder / (std::string("scene") + library::kArchiveEnding);
    if (receiveScene(node, study, scenes, folder, archive, summary, progress.part(0.0, 0.8)))
    {
      freeName(library, request.as.empty() ? library::inspectArchive(archive).name : request.as);
      library::RestoreOptions options;
      options.name = request.as;
      const auto restored =
          library::restoreCase(library, archive, options, progress.part(0.8, 1.0));
      summary.name = restored.name;
      summary.scene = true;
      summary.notes.insert(summary.notes.end(), restored.notes.begin(), restored.notes.end());
      return summary;
    }
  }

  if (request.as.empty())
    throw core::InvalidParameter(
        "receive: the study has no Petrous scene; give --as NAME for the case that is built of it" +
        (summary.notes.empty() ? std::string() : " (" + summary.notes.front() + ")"));
  const std::string primary = seriesUidOf(request.series);
  std::vector<std::string> wanted;
  for (const auto& one : series)
    if (one.modality == "MR" || (one.modality == "CT" && (primary.empty() || one.uid == primary)))
      wanted.push_back(one.uid);
  const bool hasPrimary =
      std::any_of(series.begin(), series.end(),
                  [&primary](const network::Series& one)
                  { return primary.empty() ? one.modality == "CT" : one.uid == primary; });
  refuseSeveralCts(node, series, request);
  if (!hasPrimary)
    throw NetworkError(
        NetworkError::Reason::NotFound,
        "node '" + node.name + "': the study has " +
            (primary.empty()
                 ? wanted.empty() ? "no CT and no MR" : "no CT; an MR begins a case by --series UID"
                 : "no such series"));
  summary.transfer =
      network::retrieve(node, study, wanted, folder / "images", progress.part(0.0, 0.6));
  if (summary.transfer.otherNames > 0)
    summary.notes.push_back(
        std::to_string(summary.transfer.otherNames) + " of " +
        std::to_string(summary.transfer.instances) +
        " instances name the patient otherwise than the first: it is in doubt whether all are of "
        "one patient; compare them at the node");
  std::vector<std::string> segmentations;
  for (const auto& one : series)
    if (one.modality == "SEG")
      segmentations.push_back(one.uid);
  if (!segmentations.empty())
    add(summary.transfer, network::retrieve(node, study, segmentations, folder / "segmentations",
                                            progress.part(0.6, 0.7)));
  scene::Case value =
      builtCase(folder / "images", request.as, request, summary.notes, progress.part(0.7, 0.85));
  if (!segmentations.empty())
    addSegmentations(value, series, folder / "segmentations", summary.notes,
                     progress.part(0.85, 0.9));
  value.origins.clear(); // what the node sent
  library.save(value, progress.part(0.9, 1.0));
  summary.name = value.name;
  return summary;
}

} // namespace petrous::presenters
