#include "petrous/Imaging/DicomScan.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <sys/stat.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "DicomHeader.h"
#include "petrous/Core/Log.h"

namespace petrous::imaging
{

namespace fs = std::filesystem;

namespace
{

const char* const kTask = "scan of the DICOM files";

/// Everything below a path: each regular file once, under the first path found, and what cannot be
/// read. Links to folders are followed if they stay below the path.
class FileList
{
public:
  explicit FileList(const core::Progress& progress)
    : m_progress(progress)
  {
  }

  void read(const fs::path& path)
  {
    std::error_code error;
    m_root = fs::canonical(path, error);
    visit(path, true);
    while (!m_folders.empty())
    {
      const fs::path folder = std::move(m_folders.back());
      m_folders.pop_back();
      m_progress.check(kTask);
      // Sorted, so that the path under which a file is found does not depend on the file system.
      std::vector<fs::path> entries;
      fs::directory_iterator entry(folder, error);
      for (const fs::directory_iterator end; !error && entry != end; entry.increment(error))
        entries.push_back(entry->path());
      if (error)
        unreadable(folder);
      std::sort(entries.begin(), entries.end());
      for (const fs::path& each : entries)
        visit(each, false);
    }
    std::sort(files.begin(), files.end());
  }

  std::vector<fs::path> files;
  std::vector<FileHeader> lost;   ///< names without a file: dangling links
  std::vector<Finding> findings;  ///< about folders
  std::vector<std::string> notes; ///< the same, and about links

private:
  void visit(const fs::path& path, bool isRoot)
  {
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0)
    {
      const bool denied = errno == EACCES;
      std::error_code none;
      if (denied && !fs::is_symlink(path, none)) // its folder can be listed but not searched
        return unreadable(path.parent_path());
      lost.emplace_back();
      lost.back().slice.file = path;
      lost.back().slice.damage = denied ? "may not be opened" : "is a link to nothing";
      return;
    }
    if (m_seen.count({status.st_dev, status.st_ino}) > 0)
      return;
    std::error_code error;
    if (S_ISDIR(status.st_mode) && !isRoot && fs::is_symlink(path, error) && !isBelow(path))
    {
      notes.push_back("The link '" + path.filename().string() +
                      "' leads to a folder elsewhere and was not followed; name that folder itself "
                      "where its files are wanted.");
      return;
    }
    m_seen.insert({status.st_dev, status.st_ino});
    if (S_ISDIR(status.st_mode))
      m_folders.push_back(path);
    else if (S_ISREG(status.st_mode)) // a pipe or device would block
      files.push_back(path);
    else
      notes.push_back("'" + path.filename().string() +
                      "' is not an ordinary file (a pipe or a device) and was not read.");
  }

  bool isBelow(const fs::path& path) const
  {
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    return !error && std::mismatch(m_root.begin(), m_root.end(), real.begin(), real.end()).first ==
                         m_root.end();
  }

  void unreadable(const fs::path& folder)
  {
    if (!m_unreadable.insert(folder).second)
      return;
    findings.push_back({FindingKind::Unreadable,
                        "The folder '" + folder.filename().string() +
                            "' may not be read; slices in it are missing. Its access rights must "
                            "allow this user to read it, or name a folder without it.",
                        0.0});
    notes.push_back(findings.back().text);
  }

  const core::Progress& m_progress;
  fs::path m_root;
  std::vector<fs::path> m_folders;
  std::set<fs::path> m_unreadable;
  std::set<std::pair<dev_t, ino_t>> m_seen;
};

std::vector<FileHeader> readHeaders(const std::vector<fs::path>& files,
                                    const core::Progress& progress)
{
  std::vector<FileHeader> headers(files.size());
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, files.size(), 8),
                    [&](const auto& range)
                    {
                      for (std::size_t i = range.begin(); i != range.end(); ++i)
                        headers[i] = readHeader(files[i]);
                      done += range.size();
                      progress.report(static_cast<double>(done.load()) /
                                          static_cast<double>(files.size()),
                                      "reading DICOM headers");
                    });
  return headers;
}

Finding unreadable(const FileHeader& header)
{
  return {FindingKind::Unreadable,
          header.slice.file.filename().string() + " " + header.slice.damage + ".", 0.0};
}

using Groups = std::map<std::string, std::vector<const FileHeader*>>;

/// A file name with "#" for each number: what the slices of one export have in common.
std::string patternOf(const fs::path& file)
{
  std::string pattern;
  for (const char c : file.filename().string())
  {
    const bool isDigit = c >= '0' && c <= '9';
    if (!isDigit)
      pattern += c;
    else if (pattern.empty() || pattern.back() != '#')
      pattern += '#';
  }
  return pattern;
}

/// The series of one folder, by file name.
struct FolderNames
{
  std::set<std::string> series;
  std::map<std::string, std::set<std::string>> byPattern;
  std::set<std::string> endings;
};

std::map<fs::path, FolderNames> namesOf(const Groups& groups)
{
  std::map<fs::path, FolderNames> folders;
  for (const auto& [key, members] : groups)
    for (const FileHeader* member : members)
    {
      const fs::path& file = member->slice.file;
      FolderNames& folder = folders[file.parent_path()];
      folder.series.insert(key);
      folder.byPattern[patternOf(file)].insert(key);
      folder.endings.insert(file.extension().string());
    }
  return folders;
}

/// Whether a file that is not DICOM was presumably a slice.
bool isLostSlice(const FileHeader& header, const std::map<fs::path, FolderNames>& folders)
{
  const fs::path& file = header.slice.file;
  const auto folder = folders.find(file.parent_path());
  if (folder == folders.end())
    return false;
  const std::string ending = file.extension().string();
  return folder->second.byPattern.count(patternOf(file)) > 0 ||
         (!header.slice.damage.empty() && !ending.empty() &&
          folder->second.endings.count(ending) > 0);
}

/// Unreadable data that may belong to a series, so that it may be incomplete.
using Doubts = std::map<std::string, std::vector<Finding>>;

/// A damaged file that does not state its series is presumed to belong to the only series in its
/// folder, or to the only one there with files named like it.
void placeOrphans(const std::vector<const FileHeader*>& orphans,
                  const std::map<fs::path, FolderNames>& folders, Groups& groups, Doubts& doubts,
                  ScanResult& result)
{
  for (const FileHeader* orphan : orphans)
  {
    const auto folder = folders.find(orphan->slice.file.parent_path());
    const std::set<std::string>* candidates = nullptr;
    if (folder != folders.end())
    {
      const auto alike = folder->second.byPattern.find(patternOf(orphan->slice.file));
      candidates =
          alike != folder->second.byPattern.end() ? &alike->second : &folder->second.series;
    }
    if (candidates && candidates->size() == 1)
      groups[*candidates->begin()].push_back(orphan);
    else
    {
      result.unreadable.push_back(unreadable(*orphan));
      result.notes.push_back(result.unreadable.back().text +
                             " It may be a slice of any series in its folder.");
      Finding doubt = result.unreadable.back();
      doubt.text += " It may be a slice of this series: copy it again from where it came from, or "
                    "take it out of the folder if it is none.";
      if (candidates)
        for (const std::string& key : *candidates)
          doubts[key].push_back(doubt);
    }
  }
}

std::string firstNotEmpty(const std::vector<const FileHeader*>& members,
                          std::string FileHeader::*field)
{
  const auto found = std::find_if(members.begin(), members.end(),
                                  [field](const auto* m) { return !(m->*field).empty(); });
  return found == members.end() ? std::string() : (*found)->*field;
}

DicomSeries makeSeries(const std::vector<const FileHeader*>& members,
                       const std::vector<Finding>& doubts)
{
  DicomSeries series;
  series.uid = firstNotEmpty(members, &FileHeader::seriesUid);
  series.modality = firstNotEmpty(members, &FileHeader::modality);
  series.description = firstNotEmpty(members, &FileHeader::description);
  series.files = members.size();
  std::vector<SliceHeader> slices;
  for (const FileHeader* member : members)
    slices.push_back(member->slice);
  series.geometry = assess(std::move(slices));
  if (!doubts.empty())
    series.geometry.verdict = Verdict::Refused;
  series.geometry.findings.insert(series.geometry.findings.end(), doubts.begin(), doubts.end());
  if (!series.geometry.slices.empty())
    series.frameOfReferenceUid = series.geometry.slices.front().frameOfReferenceUid;
  return series;
}

bool isImageSeries(const DicomSeries& series)
{
  return !series.geometry.slices.empty();
}

// Of a header only what this program computed from it.
void logScan(const ScanResult& result, std::size_t files)
{
  core::log::info("scan: " + std::to_string(files) + " files, " +
                  std::to_string(result.series.size()) + " series, " +
                  std::to_string(result.foreignFiles) + " files not DICOM, " +
                  std::to_string(result.unreadable.size()) + " unreadable");
  for (const DicomSeries& series : result.series)
  {
    std::string text = "series: " + std::to_string(series.files) + " files, " +
                       std::to_string(series.geometry.slices.size()) + " slices, " +
                       verdictName(series.geometry.verdict);
    for (const Finding& finding : series.geometry.findings)
      text += std::string(", ") + kindName(finding.kind);
    core::log::info(text);
  }
}

std::string uidList(const std::vector<const DicomSeries*>& series)
{
  std::string list;
  for (const DicomSeries* one : series)
    list += (list.empty() ? "" : ", ") + one->uid + " (" + one->modality + ", " +
            std::to_string(one->geometry.slices.size()) + " slices)";
  return list;
}

} // namespace

ScanResult scanDicom(const fs::path& path, const core::Progress& progress)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!error && fs::exists(status) && !fs::is_directory(status) && !fs::is_regular_file(status))
    throw DicomError(DicomError::Reason::NotFound,
                     path.string() + ": is neither a folder nor an ordinary file; give the folder "
                                     "that holds the CT's .dcm files");
  if (error || !fs::exists(status))
    throw DicomError(DicomError::Reason::NotFound,
                     path.string() + ": no such file or folder; give the folder that holds the "
                                     "CT's .dcm files");
  fs::directory_iterator probe;
  if (fs::is_directory(status) && (probe = fs::directory_iterator(path, error), error))
    throw DicomError(DicomError::Reason::NotFound,
                     path.string() + ": the folder may not be read; its access rights must "
                                     "allow this user to read it");

  FileList list(progress);
  list.read(path);
  std::vector<FileHeader> headers = readHeaders(list.files, progress);
  std::move(list.lost.begin(), list.lost.end(), std::back_inserter(headers));

  ScanResult result;
  const std::vector<Finding> folderDoubts = list.findings; // of every series: any may extend there
  result.unreadable = std::move(list.findings);
  result.notes = std::move(list.notes);
  Groups groups;
  std::vector<FileHeader*> foreign;
  std::vector<const FileHeader*> orphans;
  for (FileHeader& header : headers)
  {
    if (header.kind == FileKind::Foreign)
      foreign.push_back(&header);
    else if (header.kind == FileKind::Broken)
      orphans.push_back(&header);
    else if (header.kind == FileKind::Dicom)
      // Objects without a series UID form at most one series per folder.
      groups[header.seriesUid.empty() ? "/" + header.slice.file.parent_path().string()
                                      : header.seriesUid]
          .push_back(&header);
  }
  const auto folders = namesOf(groups);
  for (FileHeader* header : foreign)
  {
    if (!isLostSlice(*header, folders))
    {
      ++result.foreignFiles;
      continue;
    }
    if (header->slice.damage.empty())
      header->slice.damage = "is not DICOM, although it is named as a slice";
    orphans.push_back(header);
  }
  Doubts doubts;
  placeOrphans(orphans, folders, groups, doubts, result);

  for (const auto& [key, members] : groups)
  {
    progress.check(kTask);
    std::vector<Finding>& open = doubts[key];
    open.insert(open.end(), folderDoubts.begin(), folderDoubts.end());
    result.series.push_back(makeSeries(members, open));
  }
  // By first file: the order in which file managers show them.
  std::vector<std::pair<fs::path, std::size_t>> order;
  std::size_t index = 0;
  for (const auto& [key, members] : groups)
    order.emplace_back(members.front()->slice.file, index++);
  std::sort(order.begin(), order.end());
  std::vector<DicomSeries> sorted;
  for (const auto& [file, i] : order)
    sorted.push_back(std::move(result.series[i]));
  result.series = std::move(sorted);
  logScan(result, headers.size());
  progress.report(1.0, "reading DICOM headers");
  return result;
}

const DicomSeries& chooseSeries(const ScanResult& result, const fs::path& path,
                                const std::string& uid)
{
  using Reason = DicomError::Reason;
  std::vector<const DicomSeries*> images;
  std::vector<const DicomSeries*> good;
  for (const DicomSeries& series : result.series)
  {
    if (!uid.empty() && series.uid == uid)
      return series;
    if (isImageSeries(series))
      images.push_back(&series);
    if (series.geometry.verdict == Verdict::Ok)
      good.push_back(&series);
  }
  if (!uid.empty())
    throw DicomError(Reason::NoSuchSeries, path.string() + ": no series " + uid + "; there is " +
                                               (images.empty() ? "no image" : uidList(images)));
  if (good.size() == 1)
    return *good.front();
  if (good.size() > 1)
    throw DicomError(Reason::Ambiguous, path.string() + ": " + std::to_string(good.size()) +
                                            " series; name one by --series: " + uidList(good));
  if (!images.empty())
    return **std::max_element(images.begin(), images.end(),
                              [](const auto* a, const auto* b)
                              { return a->geometry.slices.size() < b->geometry.slices.size(); });
  if (!result.series.empty() && !result.series.front().geometry.findings.empty())
    throw DicomError(Reason::NoImages, path.string() + ": no DICOM image that can be used: " +
                                           result.series.front().geometry.findings.front().text +
                                           " Give the folder that holds the CT's .dcm files");
  if (!result.unreadable.empty())
    throw DicomError(Reason::Unreadable, path.string() + ": " + result.unreadable.front().text +
                                             " Copy it again from where it came from");
  throw DicomError(Reason::NoImages,
                   path.string() + ": no DICOM image found (" +
                       std::to_string(result.foreignFiles) +
                       " other files); give the folder that holds the CT's .dcm files");
}

} // namespace petrous::imaging
