#include "petrous/Imaging/DicomScan.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <utility>

#include <sys/stat.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "DicomHeader.h"

namespace petrous::imaging
{

namespace fs = std::filesystem;

namespace
{

const char* const kTask = "scan of the DICOM files";

/// Lists every regular file once: links are followed, and a file or folder that is reached by
/// two ways, or from within itself, counts where it is met first.
class FileList
{
public:
  explicit FileList(const core::Progress& progress)
    : m_progress(progress)
  {
  }

  std::vector<fs::path> below(const fs::path& path)
  {
    visit(path);
    while (!m_folders.empty())
    {
      const fs::path folder = std::move(m_folders.back());
      m_folders.pop_back();
      m_progress.check(kTask);
      std::error_code error;
      // Sorted, so that which of two ways to a file is met first is not up to the disk.
      std::vector<fs::path> entries;
      for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
           entry.increment(error))
        entries.push_back(entry->path());
      std::sort(entries.begin(), entries.end());
      for (const fs::path& entry : entries)
        visit(entry);
    }
    std::sort(m_files.begin(), m_files.end());
    return std::move(m_files);
  }

private:
  void visit(const fs::path& path)
  {
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0 || !m_seen.insert({status.st_dev, status.st_ino}).second)
      return;
    if (S_ISDIR(status.st_mode))
      m_folders.push_back(path);
    else if (S_ISREG(status.st_mode)) // a pipe or device would block
      m_files.push_back(path);
  }

  const core::Progress& m_progress;
  std::vector<fs::path> m_folders;
  std::vector<fs::path> m_files;
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

/// A damaged file that does not say its series is a slice of the only one in its folder, as far
/// as anyone can tell.
void placeOrphans(const std::vector<const FileHeader*>& orphans,
                  std::map<std::string, std::vector<const FileHeader*>>& groups, ScanResult& result)
{
  std::map<fs::path, std::set<std::string>> seriesIn;
  for (const auto& [key, members] : groups)
    for (const FileHeader* member : members)
      seriesIn[member->slice.file.parent_path()].insert(key);
  for (const FileHeader* orphan : orphans)
  {
    const auto found = seriesIn.find(orphan->slice.file.parent_path());
    if (found != seriesIn.end() && found->second.size() == 1)
      groups[*found->second.begin()].push_back(orphan);
    else
      result.unreadable.push_back(unreadable(*orphan));
  }
}

std::string firstNotEmpty(const std::vector<const FileHeader*>& members,
                          std::string FileHeader::*field)
{
  const auto found = std::find_if(members.begin(), members.end(),
                                  [field](const auto* m) { return !(m->*field).empty(); });
  return found == members.end() ? std::string() : (*found)->*field;
}

DicomSeries makeSeries(const std::vector<const FileHeader*>& members)
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
  if (!series.geometry.slices.empty())
    series.frameOfReferenceUid = series.geometry.slices.front().frameOfReferenceUid;
  return series;
}

bool isImageSeries(const DicomSeries& series)
{
  return !series.geometry.slices.empty();
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
  if (error || !fs::exists(status))
    throw DicomError(DicomError::Reason::NotFound,
                     path.string() + ": no such file or folder; give the folder that holds the "
                                     "CT's .dcm files");
  fs::directory_iterator probe;
  if (fs::is_directory(status) && (probe = fs::directory_iterator(path, error), error))
    throw DicomError(DicomError::Reason::NotFound,
                     path.string() + ": the folder may not be read; its access rights must "
                                     "allow this user to read it");

  const std::vector<fs::path> files = FileList(progress).below(path);
  const std::vector<FileHeader> headers = readHeaders(files, progress);

  ScanResult result;
  std::map<std::string, std::vector<const FileHeader*>> groups;
  std::vector<const FileHeader*> orphans;
  for (const FileHeader& header : headers)
  {
    if (header.kind == FileKind::Foreign)
      ++result.foreignFiles;
    else if (header.kind == FileKind::Broken)
      orphans.push_back(&header);
    else if (header.kind == FileKind::Dicom)
      // Objects that name no series are at most one series a folder.
      groups[header.seriesUid.empty() ? "/" + header.slice.file.parent_path().string()
                                      : header.seriesUid]
          .push_back(&header);
  }
  placeOrphans(orphans, groups, result);

  for (const auto& [key, members] : groups)
  {
    progress.check(kTask);
    result.series.push_back(makeSeries(members));
  }
  // By first file: the order in which a file manager shows them.
  std::vector<std::pair<fs::path, std::size_t>> order;
  std::size_t index = 0;
  for (const auto& [key, members] : groups)
    order.emplace_back(members.front()->slice.file, index++);
  std::sort(order.begin(), order.end());
  std::vector<DicomSeries> sorted;
  for (const auto& [file, i] : order)
    sorted.push_back(std::move(result.series[i]));
  result.series = std::move(sorted);
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
