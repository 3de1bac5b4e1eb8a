#include "petrous/Imaging/DicomScan.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include <sys/stat.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "ByteSource.h"
#include "DicomElements.h"
#include "DicomHeader.h"
#include "DicomItem.h"
#include "HeaderCache.h"
#include "MixedSigns.h"
#include "PixelCodec.h"
#include "SegmentationReader.h"
#include "SeriesVolumes.h"
#include "SliceStack.h"
#include "petrous/Core/Log.h"
#include "petrous/Imaging/FileFormats.h"

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
    Entry root{path};
    root.look();
    visit(std::move(root), true);
    while (!m_folders.empty())
    {
      const fs::path folder = std::move(m_folders.back());
      m_folders.pop_back();
      m_progress.check(kTask);
      // Sorted, so that the path under which a file is found does not depend on the file system.
      std::vector<Entry> entries;
      fs::directory_iterator entry(folder, error);
      for (const fs::directory_iterator end; !error && entry != end; entry.increment(error))
        entries.push_back({entry->path()});
      if (error)
        unreadable(folder);
      std::sort(entries.begin(), entries.end(),
                [](const Entry& a, const Entry& b) { return a.path.native() < b.path.native(); });
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, entries.size(), 64),
                        [&entries](const auto& range)
                        {
                          for (std::size_t n = range.begin(); n != range.end(); ++n)
                            entries[n].look();
                        });
      const auto known = static_cast<std::ptrdiff_t>(m_folders.size());
      for (Entry& each : entries)
        visit(std::move(each), false);
      std::reverse(m_folders.begin() + known, m_folders.end()); // the last is the next
    }
    const auto before = [](const ListedFile& a, const ListedFile& b)
    { return precedes(a.path.native(), b.path.native()); };
    if (!std::is_sorted(files.begin(), files.end(), before))
      std::sort(files.begin(), files.end(), before);
  }

  std::vector<ListedFile> files;
  std::vector<FileHeader> lost;   ///< names without a file: dangling links
  std::vector<Finding> findings;  ///< about folders
  std::vector<std::string> notes; ///< the same, and about links

private:
  struct Entry
  {
    fs::path path;
    struct stat status = {};
    int problem = 0; ///< errno

    void look() { problem = ::stat(path.c_str(), &status) == 0 ? 0 : errno; }
  };

  /// As paths are ordered, by their components; many times faster.
  static bool precedes(const std::string& a, const std::string& b)
  {
    const auto [one, other] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (one == a.end() || other == b.end())
      return one == a.end() && other != b.end();
    const auto rank = [](char c) { return c == '/' ? 0 : 1 + static_cast<unsigned char>(c); };
    return rank(*one) < rank(*other);
  }

  void visit(Entry entry, bool isRoot)
  {
    fs::path& path = entry.path;
    const struct stat& status = entry.status;
    if (entry.problem != 0)
    {
      const bool denied = entry.problem == EACCES;
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
      m_folders.push_back(std::move(path));
    else if (S_ISREG(status.st_mode)) // a pipe or device would block
      files.push_back({std::move(path), stampOf(status)});
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

std::vector<FileHeader> readHeaders(const std::vector<ListedFile>& files,
                                    const core::Progress& progress)
{
  std::vector<FileHeader> headers(files.size());
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, files.size(), 8),
                    [&](const auto& range)
                    {
                      for (std::size_t i = range.begin(); i != range.end(); ++i)
                        headers[i] = readHeader(files[i].path);
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

using Groups = std::map<std::string, std::vector<FileHeader*>>;

/// A file name with "#" for each number: what the slices of one export have in common.
std::string patternOf(const fs::path& file)
{
  std::string pattern;
  const std::string& path = file.native();
  for (std::size_t at = path.rfind('/') + 1; at < path.size(); ++at)
  {
    const char c = path[at];
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
  {
    // Most files of a series lie in one folder and are named alike.
    std::string last;
    FolderNames* folder = nullptr;
    std::set<std::string> known;
    for (const FileHeader* member : members)
    {
      const fs::path& file = member->slice.file;
      const std::string& native = file.native();
      std::string parent = native.substr(0, native.rfind('/') + 1);
      if (!folder || parent != last)
      {
        folder = &folders[file.parent_path()];
        folder->series.insert(key);
        last = std::move(parent);
        known.clear();
      }
      folder->endings.insert(file.extension().string());
      std::string pattern = patternOf(file);
      if (known.count(pattern) > 0)
        continue;
      folder->byPattern[pattern].insert(key);
      known.insert(std::move(pattern));
    }
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

/// What may be missing from a series.
struct Doubts
{
  std::vector<Finding> files; ///< that may have been its slices
  std::size_t own = 0;        ///< so many of them are of no other series
};

/// A damaged file that does not state its series is presumed to belong to the only series in its
/// folder, or to the only one there with files named like it.
std::map<std::string, Doubts> placeOrphans(const std::vector<const FileHeader*>& orphans,
                                           const std::map<fs::path, FolderNames>& folders,
                                           ScanResult& result)
{
  std::map<std::string, Doubts> doubts;
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
    {
      Doubts& one = doubts[*candidates->begin()];
      one.files.push_back(unreadable(*orphan));
      ++one.own;
      continue;
    }
    result.unreadable.push_back(unreadable(*orphan));
    result.notes.push_back(result.unreadable.back().text +
                           " It may be a slice of any series in its folder.");
    Finding doubt = result.unreadable.back();
    doubt.text += " It may be a slice of this series: copy it again from where it came from, or "
                  "take it out of the folder if it is none.";
    if (candidates)
      for (const std::string& key : *candidates)
        doubts[key].files.push_back(doubt);
  }
  return doubts;
}

std::string firstNotEmpty(const std::vector<FileHeader*>& members, std::string FileHeader::*field)
{
  const auto found = std::find_if(members.begin(), members.end(),
                                  [field](const auto* m) { return !(m->*field).empty(); });
  return found == members.end() ? std::string() : (*found)->*field;
}

/// What a series says of itself. Reports, presentation states and the like may lie in it and say
/// other things: of a volume only the slices that it is read from are heard; where there are none,
/// the images of the series, or where it has none, all of its objects.
class Statements
{
public:
  explicit Statements(const std::vector<FileHeader*>& members)
  {
    std::vector<FileHeader*> images;
    std::copy_if(members.begin(), members.end(), std::back_inserter(images),
                 [](const FileHeader* m) { return m->slice.isImage && m->slice.damage.empty(); });
    const std::vector<FileHeader*>& heard = images.empty() ? members : images;
    m_modality = firstNotEmpty(heard, &FileHeader::modality);
    m_description = firstNotEmpty(heard, &FileHeader::description);
    const bool isOne =
        std::all_of(members.begin(), members.end(),
                    [this](const FileHeader* m) { return m->description == m_description; });
    if (isOne)
      return;
    for (const FileHeader* member : members)
      m_descriptions.emplace(member->slice.file.native(), member->description);
  }

  /// `series`: whose slices are those that are read.
  void apply(DicomSeries& series) const
  {
    const std::vector<SliceHeader>& slices = series.geometry.slices;
    series.modality = m_modality;
    series.description = m_description;
    if (slices.empty())
      return;
    const auto firstOf = [&slices](const auto& textOf)
    {
      for (const SliceHeader& slice : slices)
        if (std::string text = textOf(slice); !text.empty())
          return text;
      return std::string();
    };
    series.modality = firstOf([](const SliceHeader& slice) { return slice.modality; });
    if (!m_descriptions.empty())
      series.description = firstOf(
          [this](const SliceHeader& slice)
          {
            const auto own = m_descriptions.find(slice.file.native());
            return own == m_descriptions.end() ? std::string() : own->second;
          });
  }

private:
  std::string m_modality;
  std::string m_description;
  std::unordered_map<std::string, std::string> m_descriptions; ///< by file; empty: all are alike
};

/// nullopt: that could not be read.
std::optional<bool> sameBytes(const fs::path& one, const fs::path& other,
                              const core::Progress& progress)
{
  std::error_code error;
  if (fs::file_size(one, error) != fs::file_size(other, error) || error)
    return false;
  std::ifstream first(one, std::ios::binary);
  std::ifstream second(other, std::ios::binary);
  std::vector<char> a(1 << 16);
  std::vector<char> b(a.size());
  while (first && second)
  {
    progress.check(kTask);
    first.read(a.data(), static_cast<std::streamsize>(a.size()));
    second.read(b.data(), static_cast<std::streamsize>(b.size()));
    if (first.gcount() != second.gcount() ||
        std::memcmp(a.data(), b.data(), static_cast<std::size_t>(first.gcount())) != 0)
      return false;
  }
  if (!first.eof() || !second.eof())
    return std::nullopt;
  return true;
}

/// What comparing files and slices showed, in this scan and in an earlier one of the same files.
/// Throws CancelledError. Thread-safe.
class Comparisons
{
public:
  Comparisons(KnownComparisons known, const core::Progress& progress)
    : m_known(std::move(known))
    , m_progress(progress)
  {
  }

  /// Whether two files are equal, byte by byte; not where they cannot be read.
  bool areCopies(const fs::path& one, const fs::path& other)
  {
    const auto compare = [&]() -> std::optional<std::uint64_t>
    {
      const auto same = sameBytes(one, other, m_progress);
      return same ? std::optional<std::uint64_t>(*same ? 1 : 0) : std::nullopt;
    };
    return result("bytes\n" + one.native() + "\n" + other.native(), compare).value_or(0) != 0;
  }

  /// The pixels in which two slices differ, by `compare`, which may throw.
  template <class Compare>
  std::uint64_t pixels(const SliceHeader& one, const SliceHeader& other, const Compare& compare)
  {
    const auto nameOf = [](const SliceHeader& slice)
    { return slice.file.native() + "\n" + std::to_string(slice.pixels.frame); };
    return *result("cells\n" + nameOf(one) + "\n" + nameOf(other),
                   [&]
                   {
                     m_progress.report(1.0, "comparing slices");
                     return std::optional<std::uint64_t>(compare());
                   });
  }

  const KnownComparisons& all() const noexcept { return m_known; }

private:
  template <class Compare>
  std::optional<std::uint64_t> result(const std::string& key, const Compare& compare)
  {
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      if (const auto known = m_known.find(key); known != m_known.end())
        return known->second;
    }
    const std::optional<std::uint64_t> now = compare();
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (now)
      m_known.emplace(key, *now);
    return now;
  }

  std::mutex m_mutex;
  KnownComparisons m_known;
  const core::Progress& m_progress;
};

/// Removes the slices of files that are copies of another, byte by byte; the number of files.
std::size_t dropCopies(std::vector<SliceHeader>& slices, Comparisons& comparisons)
{
  std::map<std::tuple<int, double, double, double>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < slices.size(); ++i)
    if (const SliceHeader& slice = slices[i]; slice.damage.empty() && isPlaced(slice))
    {
      const Eigen::Vector3d& at = *slice.position;
      alike[{slice.instanceNumber, at[0], at[1], at[2]}].push_back(i);
    }
  std::set<std::size_t> copies;
  const auto isCopy = [&](const SliceHeader& one, const SliceHeader& other)
  { return one.file != other.file && comparisons.areCopies(one.file, other.file); };
  for (const auto& [key, members] : alike)
    for (std::size_t m = 1; m < members.size(); ++m)
      for (std::size_t n = 0; n < m; ++n)
        if (copies.count(members[n]) == 0 && isCopy(slices[members[n]], slices[members[m]]))
        {
          copies.insert(members[m]);
          break;
        }
  std::set<fs::path> files; // which may have many frames
  for (auto copy = copies.rbegin(); copy != copies.rend(); ++copy)
  {
    files.insert(slices[*copy].file);
    slices.erase(slices.begin() + static_cast<std::ptrdiff_t>(*copy));
  }
  return files.size();
}

/// Removes damaged files whose slice is also there whole, as after a copy that was begun twice;
/// their number.
std::size_t dropReplaced(std::vector<SliceHeader>& slices)
{
  const auto isWhole = [&slices](const SliceHeader& damaged)
  {
    const auto key = [](const SliceHeader& s)
    {
      return std::tie(s.instanceNumber, s.acquisition, s.seriesNumber, s.kernel, s.imageType,
                      s.studyUid, s.traits.bValue, s.traits.echo, s.traits.echoTime,
                      s.traits.temporal, s.traits.triggerTime);
    };
    return std::any_of(slices.begin(), slices.end(),
                       [&](const SliceHeader& s) {
                         return s.damage.empty() && s.position == damaged.position &&
                                key(s) == key(damaged);
                       });
  };
  std::vector<bool> isReplaced(slices.size(), false);
  for (std::size_t i = 0; i < slices.size(); ++i)
    isReplaced[i] = !slices[i].damage.empty() && slices[i].position &&
                    slices[i].instanceNumber > 0 && isWhole(slices[i]);
  std::size_t at = 0;
  const auto before = slices.size();
  slices.erase(std::remove_if(slices.begin(), slices.end(),
                              [&](const SliceHeader&) { return isReplaced[at++]; }),
               slices.end());
  return before - slices.size();
}

/// The instance numbers of all objects of a series, localizers and reports, too.
struct SeriesNumbers
{
  std::set<int> all;
  int count = 0;    ///< of the objects
  int declared = 0; ///< as their headers state; 0: not

  explicit SeriesNumbers(const std::vector<SliceHeader>& slices)
    : count(static_cast<int>(slices.size()))
  {
    for (const SliceHeader& slice : slices)
    {
      all.insert(slice.instanceNumber);
      declared = std::max(declared, slice.declaredCount.value_or(0));
    }
  }
};

/// What the instance numbers of the slices of a volume say.
struct Numbering
{
  /// From 0 or 1 to the last without a gap, up to the count that the header states. Where no number
  /// of the series is there twice, those of the other objects close gaps: they were counted with
  /// the slices.
  bool isComplete = false;
  bool isBegun = true;    ///< likewise up to the first, whether or not numbers are there twice
  bool isCounted = false; ///< the slices are as many as the header states
  bool isCountedWithOthers = false; ///< or all objects of the series are
  int first = 0;                    ///< first and last are 0 unless all numbers differ
  int last = 0;

  Numbering(const SeriesNumbers& series, const std::vector<SliceHeader>& slices)
  {
    std::set<int> own;
    for (const SliceHeader& slice : slices)
      own.insert(slice.instanceNumber);
    if (own.empty() || own.size() != slices.size())
      return;
    first = *own.begin();
    last = *own.rbegin();
    const auto count = static_cast<int>(slices.size());
    const auto isWhole = [](const std::set<int>& numbers, int to)
    {
      const auto from = numbers.begin();
      return from != numbers.end() && (*from == 0 || *from == 1) &&
             std::distance(from, numbers.upper_bound(to)) == to - *from + 1;
    };
    const bool isOneSequence = static_cast<int>(series.all.size()) == series.count;
    isBegun = first <= 1 || isWhole(series.all, first);
    isCounted = series.declared == count;
    isCountedWithOthers = series.declared == series.count;
    isComplete = (isWhole(own, last) || (isOneSequence && isWhole(series.all, last))) &&
                 (series.declared <= count || isCountedWithOthers);
  }
};

bool hasFinding(const SeriesGeometry& geometry, std::initializer_list<FindingKind> kinds)
{
  return std::any_of(geometry.findings.begin(), geometry.findings.end(),
                     [&kinds](const Finding& f)
                     { return std::find(kinds.begin(), kinds.end(), f.kind) != kinds.end(); });
}

/// Slices that are too few for a stack, beside several.
void refuseSetAside(SeriesGeometry& geometry)
{
  geometry.verdict = Verdict::Refused;
  geometry.isRepairableIfEqual = false;
  if (geometry.findings.empty())
    geometry.findings.push_back({FindingKind::OddOrientation,
                                 std::to_string(geometry.slices.size()) +
                                     (geometry.slices.size() == 1 ? " slice is" : " slices are") +
                                     " turned against the stacks of the series, of another size or "
                                     "beside them, too few for "
                                     "a stack.",
                                 0.0});
}

/// The stacks of a series, each assessed; a single unnamed one if it cannot be divided.
std::vector<std::pair<std::string, SeriesGeometry>> assessVolumes(std::vector<SliceHeader> slices,
                                                                  const core::Progress& progress)
{
  using Kind = FindingKind;
  SeriesGeometry whole = assess(slices, progress);
  std::vector<std::pair<std::string, SeriesGeometry>> volumes;
  if (hasFinding(whole,
                 {Kind::DuplicateSlice, Kind::SideBySide, Kind::OddOrientation, Kind::OddSize,
                  Kind::MixedRescale, Kind::GantryTilt, Kind::UnevenSpacing}) &&
      !hasFinding(whole, {Kind::MixedPatients, Kind::MixedStudies}))
  {
    std::size_t setAside = 0;
    std::vector<NamedSlices> parts = splitVolumes(slices);
    for (NamedSlices& part : parts)
    {
      setAside += part.isSetAside ? part.slices.size() : 0;
      SeriesGeometry geometry = assess(std::move(part.slices), progress);
      if (part.isSetAside)
        refuseSetAside(geometry);
      volumes.emplace_back(part.name, std::move(geometry));
    }
    for (std::size_t n = 0; setAside > 0 && n < parts.size(); ++n)
      if (!parts[n].isSetAside)
        volumes[n].second.notes.push_back(
            std::to_string(setAside) +
            (setAside == 1 ? " slice of the series is" : " slices of the series are") +
            " turned against its stacks, of another size or beside them, too few for a stack, and "
            "set aside.");
  }
  const bool helps =
      volumes.size() > 1 &&
      std::any_of(volumes.begin(), volumes.end(),
                  [](const auto& volume) { return volume.second.verdict != Verdict::Refused; });
  if (!helps)
  {
    volumes.clear();
    volumes.emplace_back(std::string(), std::move(whole));
  }
  return volumes;
}

/// Whether a stack is whole without files that may have been its slices.
bool isWholeWithout(std::size_t files, const SeriesGeometry& geometry, const Numbering& numbering)
{
  constexpr std::size_t kFew = 10; // one in so many: with more, the copy went wrong
  return geometry.verdict != Verdict::Refused && geometry.grid && numbering.isComplete &&
         !hasFinding(geometry, {FindingKind::MissingSlice, FindingKind::Unreadable}) &&
         (files == 1 || files * kFew <= geometry.slices.size());
}

/// What the header and the numbers of the slices say of ends that are not there: an export that
/// broke off leaves a stack without a gap. Empty: nothing.
std::string missingEnds(const SeriesGeometry& geometry, const SeriesNumbers& series,
                        const Numbering& numbering)
{
  if (geometry.verdict == Verdict::Refused || !geometry.grid ||
      geometry.slices.front().pixels.frameCount > 1 || // which numbers files
      hasFinding(geometry,
                 {FindingKind::MissingSlice, FindingKind::Unreadable, FindingKind::DuplicateSlice}))
    return {};
  const bool isNumbered = numbering.last > numbering.first;
  std::string text;
  if (series.declared > series.count)
    text = "The header states " + std::to_string(series.declared) + " images, and " +
           std::to_string(series.count) + " are there";
  if (isNumbered && !numbering.isBegun && series.declared != series.count)
    text += (text.empty() ? "The slices are numbered " : ", numbered ") +
            ("from " + std::to_string(numbering.first)) + " to " + std::to_string(numbering.last);
  if (text.empty())
    return text;
  // Where slices do not stand evenly, there may be gaps, too.
  return text +
         (hasFinding(geometry, {FindingKind::UnevenSpacing, FindingKind::MissingBetween})
              ? "; slices may be missing, also at its ends. Look whether all of the skull base "
                "that is needed is there."
              : "; the stack has no gap, but its ends may be missing. Look whether all of the "
                "skull base that is needed is there.");
}

/// Thickness of the slices, mm, if they stand farther apart than that allows without a gap.
std::optional<double> thicknessWithGaps(const SeriesGeometry& geometry)
{
  constexpr double kThicker = 1.5; // by which slices without a gap may stand apart
  if (!geometry.grid || geometry.slices.empty())
    return std::nullopt;
  const auto& thickness = geometry.slices.front().thickness;
  if (!thickness || !(*thickness > 0.0) || geometry.grid->spacing()[2] <= kThicker * *thickness)
    return std::nullopt;
  return thickness;
}

/// What was not measured between the slices of a stack without a gap in its numbers, as those of an
/// MR and of sets that were thinned out and numbered anew. Empty: nothing.
std::string unmeasuredBetween(const SeriesGeometry& geometry)
{
  const auto thickness = thicknessWithGaps(geometry);
  if (!thickness)
    return {};
  const double spacing = geometry.grid->spacing()[2];
  return "The slices are " + decimals(*thickness, 2) + " mm thick and stand " +
         decimals(spacing, 2) + " mm apart: " + decimals(spacing - *thickness, 2) +
         " mm from each to the next were not measured.";
}

/// What the numbers of a stack say of slices between those that are there: they go in equal steps
/// of more than one, farther apart than the slices are thick. Empty: nothing.
std::string numbersBetween(const SeriesGeometry& geometry)
{
  const std::vector<SliceHeader>& slices = geometry.slices;
  constexpr std::size_t kTelling = 4; // slices
  if (geometry.verdict == Verdict::Refused || !geometry.grid || slices.size() < kTelling ||
      hasFinding(geometry, {FindingKind::MissingSlice}))
    return {};
  const std::vector<double> numbers = numbersAlong(slices);
  if (numbers.empty())
    return {};
  const double step = numbers[1] - numbers[0];
  for (std::size_t k = 2; k < numbers.size(); ++k)
    if (numbers[k] - numbers[k - 1] != step)
      return {};
  const auto thickness = thicknessWithGaps(geometry);
  if (std::abs(step) < 2.0 || !thickness)
    return {};
  const double spacing = geometry.grid->spacing()[2];
  return "The slices are numbered in steps of " + decimals(std::abs(step), 0) + " and are " +
         decimals(*thickness, 2) + " mm thick, but stand " + decimals(spacing, 2) +
         " mm apart: those between them may be missing, and " + decimals(spacing - *thickness, 2) +
         " mm from each to the next were not measured. Look whether the series has more files.";
}

/// The stretch of a stack along a normal, mm.
struct Stretch
{
  double first = 0.0;
  double last = 0.0;

  Stretch(const SeriesGeometry& geometry, const Eigen::Vector3d& normal)
    : first(normal.dot(*geometry.slices.front().position))
    , last(normal.dot(*geometry.slices.back().position))
  {
  }
  double length() const { return last - first; }
};

/// What the other volumes of a series say of the ends of one: phases, echoes and b-values of one
/// series are as long as each other. Empty: nothing.
std::string shorterThan(const SeriesGeometry& geometry, const std::vector<DicomSeries>& siblings)
{
  const auto isStack = [](const SeriesGeometry& g) { return g.grid && g.slices.size() > 1; };
  if (geometry.verdict == Verdict::Refused || !isStack(geometry))
    return {};
  constexpr double kSameSpacing = 0.02; // share
  constexpr double kAlike = 0.75; // of the stack lies beside the sibling's: no neighbouring slab
  const Eigen::Vector3d normal = geometry.grid->direction().col(2);
  const double spacing = geometry.grid->spacing()[2];
  const Stretch own(geometry, normal);
  double before = 0.0;
  double beyond = 0.0;
  for (const DicomSeries& sibling : siblings)
  {
    const SeriesGeometry& other = sibling.geometry;
    if (&other == &geometry || !isStack(other) ||
        !sameTurn(geometry.slices.front(), other.slices.front()) ||
        std::abs(other.grid->spacing()[2] - spacing) > kSameSpacing * spacing ||
        other.slices.front().frameOfReferenceUid != geometry.slices.front().frameOfReferenceUid)
      continue;
    const Stretch its(other, normal);
    if (std::min(own.last, its.last) - std::max(own.first, its.first) < kAlike * own.length())
      continue;
    before = std::max(before, own.first - its.first);
    beyond = std::max(beyond, its.last - own.last);
  }
  const auto goesOn = [spacing](double length)
  {
    const auto slices = std::lround(length / spacing);
    return decimals(length, 1) + " mm (" + std::to_string(slices) +
           (slices == 1 ? " slice)" : " slices)");
  };
  const bool isLater = before > 0.5 * spacing;
  const bool isEarlier = beyond > 0.5 * spacing;
  if (!isLater && !isEarlier)
    return {};
  return "Another volume of the series goes on for " +
         (isLater ? goesOn(before) + " before the first slice of this one" : std::string()) +
         (isLater && isEarlier ? " and " : "") +
         (isEarlier ? goesOn(beyond) + " beyond its last slice" : std::string()) +
         "; the stack has no gap, but its ends may be missing. Look whether all of the skull base "
         "that is needed is there.";
}

/// The ends that may be missing from the volumes of a divided series.
void compareEnds(std::vector<DicomSeries>& volumes, const SeriesNumbers& numbers)
{
  if (volumes.size() < 2)
    return;
  bool isExplained = false; // what is not there of those that the header states
  for (DicomSeries& volume : volumes)
  {
    std::string text = shorterThan(volume.geometry, volumes);
    isExplained = isExplained || !text.empty() ||
                  hasFinding(volume.geometry, {FindingKind::MissingSlice, FindingKind::Unreadable});
    if (!text.empty())
      volume.geometry.findings.push_back({FindingKind::MissingEnd, std::move(text), 0.0});
  }
  const auto isOfManyFrames = [](const DicomSeries& volume) {
    return !volume.geometry.slices.empty() && volume.geometry.slices.front().pixels.frameCount > 1;
  };
  if (isExplained || numbers.declared <= numbers.count ||
      std::any_of(volumes.begin(), volumes.end(), isOfManyFrames))
    return;
  for (DicomSeries& volume : volumes)
    if (volume.geometry.verdict != Verdict::Refused)
      volume.geometry.findings.push_back(
          {FindingKind::MissingEnd,
           "The header states " + std::to_string(numbers.declared) + " images of the series, and " +
               std::to_string(numbers.count) +
               " are there in all its volumes, which are equally long; a volume or the ends of all "
               "may be missing. Look whether all of the skull base that is needed is there.",
           0.0});
}

/// Whether equal cells of two slices have equal bits in StoredPixels::scratch.
bool sameCells(const PixelFormat& one, const PixelFormat& other)
{
  return one.bitsAllocated == other.bitsAllocated && one.bitsAllocated % 8 == 0 &&
         one.bitsStored == other.bitsStored && one.highBit == other.highBit &&
         one.isSigned == other.isSigned && one.isEncapsulated == other.isEncapsulated &&
         one.isBigEndian == other.isBigEndian;
}

/// The number of pixels in which two slices differ, as rescaled, or in bits that may be theirs
/// (UndeclaredBits). `first`: the decoded ones of `one`, or empty.
std::uint64_t differingPixels(const SliceHeader& one, const SliceHeader& other,
                              std::optional<StoredPixels>& first)
{
  if (!first)
  {
    first.emplace();
    decodePixels(one, *first, UndeclaredBits::LeaveOut);
  }
  StoredPixels second;
  decodePixels(other, second, UndeclaredBits::LeaveOut);
  const std::size_t count = std::min(first->size(), second.size());
  // Kept, a sign without copies beside signs with them is a bit of a positive value.
  const bool hasUndeclared =
      first->undeclared > 0 || second.undeclared > 0 ||
      ((first->signs.none > 0 || second.signs.none > 0) && (first->signs.any || second.signs.any));
  const bool hasCells = sameCells(one.pixels, other.pixels);
  const auto bytes = static_cast<std::size_t>(one.pixels.bitsAllocated / 8);
  const auto differs = [&](std::size_t p)
  {
    if (one.slope * first->at(p) + one.intercept != other.slope * second.at(p) + other.intercept)
      return true;
    return hasUndeclared &&
           (!hasCells || std::memcmp(first->scratch.data() + p * bytes,
                                     second.scratch.data() + p * bytes, bytes) != 0);
  };
  std::uint64_t differing = 0;
  for (std::size_t p = 0; p < count; ++p)
    differing += differs(p) ? 1 : 0;
  return differing;
}

/// Compares the pixels of slices that share a place: where they differ, none of them can be left
/// out. Where they are equal, any number of them can.
void compareDuplicates(SeriesGeometry& geometry, Comparisons& comparisons)
{
  const bool isMany = geometry.isRepairableIfEqual;
  if ((geometry.verdict != Verdict::Repairable && !isMany) || !geometry.grid ||
      !hasFinding(geometry, {FindingKind::DuplicateSlice}))
    return;
  const Eigen::Vector3d normal = geometry.grid->direction().col(2);
  const double same = sharedPlace(geometry.grid->spacing()[2]);
  std::uint64_t differing = 0;        // pixels, of the pair that differs most
  const SliceHeader* kept = nullptr;  // of a place
  std::optional<StoredPixels> pixels; // its own
  for (const SliceHeader& slice : geometry.slices)
  {
    if (!kept || normal.dot(*slice.position - *kept->position) > same)
    {
      kept = &slice;
      pixels.reset();
      continue;
    }
    differing = std::max(
        differing,
        comparisons.pixels(*kept, slice, [&] { return differingPixels(*kept, slice, pixels); }));
    if (isMany && differing > 0)
      return; // refused already, and its slices may be thousands
  }
  if (isMany)
  {
    geometry.verdict = Verdict::Repairable;
    for (Finding& finding : geometry.findings)
      if (finding.kind == FindingKind::DuplicateSlice)
        finding.text += " Those at one place have equal pixels, so that one of each can be kept.";
  }
  if (differing == 0)
    return;
  const SliceHeader& size = geometry.slices.front();
  const auto count =
      static_cast<std::uint64_t>(size.rows) * static_cast<std::uint64_t>(size.columns);
  geometry.verdict = Verdict::Refused;
  for (Finding& finding : geometry.findings)
    if (finding.kind == FindingKind::DuplicateSlice)
      finding.text += " They show different things, in up to " + std::to_string(differing) +
                      " of " + std::to_string(count) +
                      " voxels of a slice, so none of them can be left out; keep the files of one "
                      "reconstruction in the folder.";
}

/// Refuses what the reader would for its pixels' signs. `progress`: for a cancellation.
void judgeSigns(SeriesGeometry& geometry, const core::Progress& progress)
{
  if (geometry.verdict == Verdict::Refused)
    return;
  try
  {
    const MixedSigns signs = mixedSigns(geometry.slices, 0, geometry.slices.size(), progress);
    if (signs.unclear.empty())
      return;
    geometry.findings.push_back({FindingKind::Unreadable, signs.unclear, 0.0});
    geometry.verdict = Verdict::Refused;
  }
  catch (const DicomError&)
  {
    // Read again, the slice says so.
  }
}

std::string setAsideNote(std::size_t files, const SeriesGeometry& geometry,
                         const Numbering& numbering)
{
  std::string text = std::to_string(files) + (files == 1 ? " file" : " files") +
                     " beside the slices cannot be read and " + (files == 1 ? "was" : "were") +
                     " set aside: the slices stand without a gap and are numbered " +
                     std::to_string(numbering.first) + " to " + std::to_string(numbering.last);
  if (numbering.isCounted)
    return text + ", as many as the header states.";
  if (numbering.isCountedWithOthers)
    return text + ", and with what else is in the series as many as the header states.";
  return text + ". If " + (files == 1 ? "it was a slice" : "they were slices") +
         " beyond that, the volume ends " +
         decimals(static_cast<double>(files) * geometry.grid->spacing()[2], 1) + " mm too early.";
}

/// The findings of files held against a series: the first of them by name.
std::vector<Finding> heldAgainst(const std::vector<Finding>& files)
{
  constexpr std::size_t kNamed = 3; // keeps findings readable if a whole disc is bad
  std::vector<Finding> named(
      files.begin(), files.begin() + static_cast<std::ptrdiff_t>(std::min(files.size(), kNamed)));
  if (files.size() > kNamed)
    named.push_back({FindingKind::Unreadable,
                     std::to_string(files.size() - kNamed) + " more files in the folder cannot be "
                                                             "read.",
                     0.0});
  return named;
}

SeriesKind kindOf(const std::vector<FileHeader*>& members)
{
  const auto areAll = [&members](bool (*isOf)(const std::string&))
  {
    return std::all_of(members.begin(), members.end(),
                       [isOf](const FileHeader* member)
                       { return isOf(member->sopClass) && member->slice.damage.empty(); });
  };
  return areAll(isSegmentationClass)   ? SeriesKind::Segmentation
         : areAll(isStructureSetClass) ? SeriesKind::StructureSet
                                       : SeriesKind::Image;
}

struct MadeSeries
{
  std::vector<DicomSeries> volumes;
  std::vector<std::string> notes; ///< of the scan
};

/// `folders`: findings about unreadable folders, in which any series may go on. The slices of
/// `members` are moved from.
MadeSeries makeSeries(const std::vector<FileHeader*>& members, const Doubts& doubts,
                      const std::vector<Finding>& folders, Comparisons& comparisons,
                      const core::Progress& progress)
{
  DicomSeries series;
  series.uid = firstNotEmpty(members, &FileHeader::seriesUid);
  const Statements statements(members); // of slices that are moved below
  series.files = members.size() + doubts.own;
  series.kind = kindOf(members);
  for (const FileHeader* member : members)
    if (member->slice.damage.empty() &&
        (isSegmentationClass(member->sopClass) || isStructureSetClass(member->sopClass)))
      series.structures.push_back(member->slice.file);
  std::vector<SliceHeader> slices;
  slices.reserve(members.size());
  for (FileHeader* member : members)
    if (member->frames.empty())
      slices.push_back(std::move(member->slice));
    else
      std::move(member->frames.begin(), member->frames.end(), std::back_inserter(slices));
  const std::size_t copies = dropCopies(slices, comparisons);
  const std::size_t replaced = dropReplaced(slices);
  const SeriesNumbers numbers(slices);
  MadeSeries made;
  bool isSetAside = !doubts.files.empty();
  for (auto& [name, geometry] : assessVolumes(std::move(slices), progress))
  {
    DicomSeries one = series;
    one.volume = name;
    one.geometry = std::move(geometry);
    statements.apply(one);
    const Numbering numbering(numbers, one.geometry.slices);
    if (copies > 0)
      one.geometry.notes.push_back(std::to_string(copies) +
                                   (copies == 1 ? " file is a copy" : " files are copies") +
                                   " of another, byte by byte, and left out.");
    if (replaced > 0)
      one.geometry.notes.push_back(std::to_string(replaced) +
                                   (replaced == 1 ? " damaged file was" : " damaged files were") +
                                   " left out: the same slice is there whole.");
    std::vector<Finding>& findings = one.geometry.findings;
    try
    {
      compareDuplicates(one.geometry, comparisons);
      judgeSigns(one.geometry, progress);
    }
    catch (const DicomError& error)
    {
      // Read again, a slice that is used says so; one that is left out would not.
      if (one.geometry.verdict == Verdict::Repairable)
      {
        findings.push_back({FindingKind::Unreadable,
                            std::string("Slices at one place cannot be compared, so none of them "
                                        "can be left out: ") +
                                error.what(),
                            0.0});
        one.geometry.verdict = Verdict::Refused;
      }
    }
    catch (const std::bad_alloc&)
    {
      findings.push_back({FindingKind::Unreadable,
                          "Its slices need more memory than is free, even one by one.", 0.0});
      one.geometry.verdict = Verdict::Refused;
    }
    if (std::string between = numbersBetween(one.geometry); !between.empty())
      findings.push_back({FindingKind::MissingBetween, std::move(between), 0.0});
    else if (std::string gaps = unmeasuredBetween(one.geometry); !gaps.empty())
      one.geometry.notes.push_back(std::move(gaps));
    if (std::string ends = missingEnds(one.geometry, numbers, numbering);
        name.empty() && !ends.empty())
      findings.push_back({FindingKind::MissingEnd, std::move(ends), 0.0});
    const std::size_t lost = doubts.files.size();
    if (lost > 0 && isWholeWithout(lost, one.geometry, numbering))
      one.geometry.notes.push_back(setAsideNote(lost, one.geometry, numbering));
    else if (lost > 0)
    {
      isSetAside = false;
      const std::vector<Finding> held = heldAgainst(doubts.files);
      findings.insert(findings.begin(), held.begin(), held.end());
      one.geometry.verdict = Verdict::Refused;
    }
    findings.insert(findings.end(), folders.begin(), folders.end());
    if (!folders.empty())
      one.geometry.verdict = Verdict::Refused;
    if (!one.geometry.slices.empty())
      one.frameOfReferenceUid = one.geometry.slices.front().frameOfReferenceUid;
    made.volumes.push_back(std::move(one));
  }
  compareEnds(made.volumes, numbers);
  for (std::size_t n = 0; isSetAside && doubts.own == doubts.files.size() && n < doubts.own; ++n)
    made.notes.push_back(doubts.files[n].text +
                         " It was set aside: the slices beside it are whole without it.");
  return made;
}

/// A path as the file systems of discs compare it: without case and the version of ISO 9660.
std::string discName(const fs::path& path)
{
  std::string name = path.lexically_normal().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c)
                 { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
  if (const std::size_t version = name.rfind(';'); version != std::string::npos)
    name.resize(version);
  if (!name.empty() && name.back() == '.')
    name.pop_back();
  return name;
}

/// What a DICOMDIR lists and that is not there: a copy that broke off leaves it whole.
struct Lost
{
  struct File
  {
    fs::path path;
    std::string seriesUid; ///< empty: the index does not say
  };
  std::size_t listed = 0;
  std::map<std::string, std::size_t> listedOf; ///< by UID of the series, as of a File
  std::vector<File> files;
};

/// The series of each record of a DICOMDIR: a record names the first of those below it, and each
/// of these the next, by the offsets of their items in the file (PS3.3 F.3.2.2).
std::vector<std::string> seriesOfRecords(const std::vector<DicomItem>& records,
                                         const std::function<std::uint64_t(const DicomItem&)>& at)
{
  std::map<std::uint64_t, std::size_t> byOffset;
  for (std::size_t n = 0; n < records.size(); ++n)
    if (!records[n].bytes().empty())
      byOffset.emplace(at(records[n]), n);
  std::vector<std::string> series(records.size());
  const auto follow = [&](const DicomItem& record, Tag tag)
  {
    const auto found = byOffset.find(record.whole(tag).value_or(0));
    return found == byOffset.end() ? records.size() : found->second;
  };
  for (const DicomItem& record : records)
  {
    const std::string uid = record.text(0x0020000e);
    if (uid.empty() || record.text(0x00041430) != "SERIES")
      continue;
    // Each record once: a hostile index may go in circles.
    for (std::size_t n = follow(record, 0x00041420); n < records.size() && series[n].empty();
         n = follow(records[n], 0x00041400))
      series[n] = uid;
  }
  return series;
}

Lost lostOf(const fs::path& index, const std::set<std::string>& names)
{
  constexpr std::uint64_t kLargest = std::uint64_t{64} << 20; // bytes
  Lost lost;
  ByteSource source(index);
  const DicomElements elements(source);
  if (!source.isOpen() || elements.state() != DicomElements::State::Complete ||
      source.size() > kLargest || elements.dataStart() > source.size())
    return lost;
  std::string bytes(static_cast<std::size_t>(source.size() - elements.dataStart()), '\0');
  if (!source.read(elements.dataStart(), bytes.data(), bytes.size()))
    return lost;
  const DicomItem data(bytes, {elements.isExplicit(), elements.isBigEndian()});
  const std::vector<DicomItem> records = data.items(0x00041220);
  const auto offsetOf = [&](const DicomItem& record)
  {
    constexpr std::uint64_t kHead = 8; // bytes: tag and length of an item
    return elements.dataStart() + static_cast<std::uint64_t>(record.bytes().data() - bytes.data()) -
           kHead;
  };
  const std::vector<std::string> series = seriesOfRecords(records, offsetOf);
  for (std::size_t n = 0; n < records.size(); ++n)
  {
    std::string id = records[n].text(0x00041500); // components separated by backslashes
    if (id.empty())
      continue;
    ++lost.listed;
    ++lost.listedOf[series[n]];
    std::replace(id.begin(), id.end(), '\\', '/');
    std::error_code error;
    fs::path file = index.parent_path() / id;
    if (names.count(discName(file)) == 0 && !fs::exists(file, error))
      lost.files.push_back({std::move(file), series[n]});
  }
  return lost;
}

bool isBelow(const fs::path& file, const fs::path& folder)
{
  const fs::path relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

// Of a disc whose files were copied to other names no listed path is there: of a series no more is
// lost than it has fewer files than are listed. Records that name no series are made up for by what
// else lies beside the index, but by nothing beyond: other series of the tree say nothing of a
// disc.
void findRenamed(Lost& lost, const fs::path& index, const Groups& groups)
{
  std::map<std::string, std::size_t> missing = lost.listedOf;
  const auto subtract = [&missing](const std::string& uid, std::size_t present)
  {
    if (const auto listed = missing.find(uid); listed != missing.end())
      listed->second -= std::min(listed->second, present);
  };
  for (const auto& [key, members] : groups)
    if (lost.listedOf.count(key) > 0)
      subtract(key, members.size());
    else
      subtract({}, static_cast<std::size_t>(std::count_if(members.begin(), members.end(),
                                                          [&index](const FileHeader* member) {
                                                            return isBelow(member->slice.file,
                                                                           index.parent_path());
                                                          })));
  lost.files.erase(std::remove_if(lost.files.begin(), lost.files.end(),
                                  [&missing](const Lost::File& file)
                                  {
                                    std::size_t& left = missing[file.seriesUid];
                                    if (left == 0)
                                      return true;
                                    --left;
                                    return false;
                                  }),
                   lost.files.end());
}

std::string lossNote(const fs::path& index, const Lost& lost)
{
  const std::size_t count = lost.files.size();
  return "'" + index.filename().string() + "' lists " + std::to_string(lost.listed) +
         " files, of which " + std::to_string(count) + (count == 1 ? " is" : " are") +
         " not there (the first is '" +
         lost.files.front().path.lexically_relative(index.parent_path()).string() +
         "'): slices or whole series may be missing. Copy the disc again.";
}

/// Which series lost how many files of a DICOMDIR: those of the UID that it states, else those with
/// files in the same folder, else every one. A series of which nothing is there has no entry.
std::map<std::string, std::size_t> lossesOf(const Lost& lost, const Groups& groups)
{
  std::map<std::string, std::set<std::string>> byFolder;
  for (const auto& [key, members] : groups)
    for (const FileHeader* member : members)
      byFolder[discName(member->slice.file.parent_path())].insert(key);
  std::map<std::string, std::size_t> losses;
  for (const Lost::File& file : lost.files)
  {
    if (!file.seriesUid.empty())
    {
      if (groups.count(file.seriesUid) > 0)
        ++losses[file.seriesUid];
      continue;
    }
    const auto folder = byFolder.find(discName(file.path.parent_path()));
    if (folder != byFolder.end())
      for (const std::string& key : folder->second)
        ++losses[key];
    else
      for (const auto& group : groups)
        ++losses[group.first];
  }
  return losses;
}

Finding lossFinding(std::size_t lost)
{
  return {FindingKind::MissingEnd,
          "The index of the disc (DICOMDIR) lists " + std::to_string(lost) +
              (lost == 1 ? " file of the series that is" : " files of the series that are") +
              " not there; the stack may have no gap, but slices are missing. Copy the disc again.",
          0.0};
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

constexpr std::size_t kScout = 2; // slices; more may be a volume

/// Whether one that needs repair may be meant rather than a sound one: the same kind of image, with
/// thinner slices or a longer stack.
bool isRival(const DicomSeries& repairable, const DicomSeries& sound)
{
  constexpr double kThinner = 0.99;
  constexpr double kLonger = 1.1;
  const auto& one = repairable.geometry;
  const auto& other = sound.geometry;
  if (one.verdict != Verdict::Repairable || !one.grid || !other.grid ||
      repairable.modality != sound.modality || one.slices.size() <= kScout)
    return false;
  const auto length = [](const core::GridGeometry& grid)
  { return grid.dims()[2] * grid.spacing()[2]; };
  return one.grid->spacing()[2] < kThinner * other.grid->spacing()[2] ||
         length(*one.grid) > kLonger * length(*other.grid);
}

std::string uidList(const std::vector<const DicomSeries*>& series)
{
  std::string list;
  for (const DicomSeries* one : series)
    list += (list.empty() ? "" : ", ") + one->uid +
            (one->volume.empty() ? "" : " '" + one->volume + "'") + " (" + one->modality + ", " +
            std::to_string(one->geometry.slices.size()) + " slices" +
            (one->geometry.verdict == Verdict::Repairable ? ", needs --repair)" : ")");
  return list;
}

} // namespace

ScanResult scanDicom(const fs::path& path, const core::Progress& progress,
                     core::DerivedStore* cache)
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

  // A DICOMDIR indexes the files beside and below it.
  const bool isIndex = fs::is_regular_file(status) && readHeader(path).kind == FileKind::Directory;
  FileList list(progress);
  const std::int64_t listed = timeNow();
  list.read(isIndex ? fs::absolute(path).parent_path() : path);
  std::optional<HeaderCache> kept;
  if (cache && !list.files.empty())
    kept.emplace(*cache, list.files);
  auto found = kept ? kept->find() : std::nullopt;
  std::vector<FileHeader> headers =
      found ? std::move(found->headers) : readHeaders(list.files, progress);
  // Now, as what follows takes the headers apart.
  const auto keepable = kept && !found ? kept->packed(headers, listed) : std::nullopt;
  Comparisons comparisons(found ? std::move(found->comparisons) : KnownComparisons(), progress);
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
  std::set<std::string> names;
  std::map<std::string, std::size_t> losses; // of the series
  for (const FileHeader& header : headers)
    if (header.kind == FileKind::Directory)
    {
      if (names.empty())
        for (const ListedFile& file : list.files)
          names.insert(discName(file.path));
      Lost lost = lostOf(header.slice.file, names);
      findRenamed(lost, header.slice.file, groups);
      if (lost.files.empty())
        continue;
      result.lostFiles += lost.files.size();
      result.lossNotes.push_back(lossNote(header.slice.file, lost));
      for (const auto& [key, count] : lossesOf(lost, groups))
        losses[key] += count;
    }
  const auto folders = namesOf(groups);
  for (FileHeader* header : foreign)
  {
    if (!isLostSlice(*header, folders))
    {
      ++result.foreignFiles;
      if (isReadAs(header->slice.file, kImage | kLabels | kMesh))
        result.notDicom.push_back(header->slice.file);
      continue;
    }
    if (header->slice.damage.empty())
      header->slice.damage = "is not DICOM, although it is named as a slice";
    orphans.push_back(header);
  }
  const std::map<std::string, Doubts> doubts = placeOrphans(orphans, folders, result);

  // By first file: the order in which file managers show them.
  std::vector<std::pair<fs::path, std::size_t>> order;
  std::vector<const Groups::value_type*> all;
  for (const auto& group : groups)
  {
    order.emplace_back(group.second.front()->slice.file, all.size());
    all.push_back(&group);
  }
  std::sort(order.begin(), order.end());
  std::vector<MadeSeries> made(all.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, all.size(), 1),
                    [&](const auto& range)
                    {
                      for (std::size_t n = range.begin(); n != range.end(); ++n)
                      {
                        progress.check(kTask);
                        const auto open = doubts.find(all[n]->first);
                        made[n] = makeSeries(all[n]->second,
                                             open == doubts.end() ? Doubts() : open->second,
                                             folderDoubts, comparisons, progress);
                        if (const auto loss = losses.find(all[n]->first); loss != losses.end())
                          for (DicomSeries& volume : made[n].volumes)
                          {
                            volume.lostFiles = loss->second;
                            volume.geometry.findings.push_back(lossFinding(loss->second));
                          }
                      }
                    });
  for (const auto& [file, n] : order)
  {
    std::move(made[n].volumes.begin(), made[n].volumes.end(), std::back_inserter(result.series));
    std::move(made[n].notes.begin(), made[n].notes.end(), std::back_inserter(result.notes));
  }
  if (keepable)
    kept->put(*keepable, comparisons.all());
  logScan(result, headers.size());
  progress.report(1.0, "reading DICOM headers");
  return result;
}

const char* kindName(SeriesKind kind) noexcept
{
  return kind == SeriesKind::Segmentation   ? "segmentation"
         : kind == SeriesKind::StructureSet ? "structure-set"
                                            : "image";
}

std::string selectorOf(const DicomSeries& series)
{
  return series.volume.empty() ? series.uid : series.uid + "#" + series.volume;
}

std::size_t imageCount(const DicomSeries& series)
{
  const SeriesGeometry& geometry = series.geometry;
  if (!geometry.slices.empty() || series.kind != SeriesKind::Image || geometry.findings.empty())
    return geometry.slices.size();
  return hasFinding(geometry, {FindingKind::NotAnImage}) ? 0 : series.files;
}

std::vector<const DicomSeries*> otherImages(const ScanResult& result, const DicomSeries& series)
{
  std::vector<const DicomSeries*> others;
  for (const DicomSeries& other : result.series)
    if (&other != &series && (other.modality == "CT" || other.modality == "MR") &&
        imageCount(other) > kScout)
      others.push_back(&other);
  return others;
}

const DicomSeries& chooseSeries(const ScanResult& result, const fs::path& path,
                                const std::string& selector)
{
  using Reason = DicomError::Reason;
  const std::size_t hash = selector.find('#');
  const std::string uid = selector.substr(0, hash);
  const std::string volume = hash == std::string::npos ? std::string() : selector.substr(hash + 1);
  const auto select = [](const std::vector<const DicomSeries*>& from, const auto& test)
  {
    std::vector<const DicomSeries*> kept;
    std::copy_if(from.begin(), from.end(), std::back_inserter(kept), test);
    return kept;
  };
  std::vector<const DicomSeries*> all;
  for (const DicomSeries& series : result.series)
    all.push_back(&series);
  const auto isImage = [](const DicomSeries* one) { return isImageSeries(*one); };
  const auto listOr = [&](const std::vector<const DicomSeries*>& from)
  { return from.empty() ? std::string("no image") : uidList(from); };

  const auto named =
      select(all, [&](const DicomSeries* one) { return uid.empty() || one->uid == uid; });
  if (!uid.empty() && named.empty())
    throw DicomError(Reason::NoSuchSeries, path.string() + ": no series " + uid + "; there is " +
                                               listOr(select(all, isImage)));
  const auto meant = select(named, [&](const DicomSeries* one)
                            { return volume.empty() || one->volume == volume; });
  if (!volume.empty() && meant.empty())
    throw DicomError(Reason::NoSuchSeries, path.string() + ": no volume '" + volume +
                                               "'; there is " + listOr(select(named, isImage)));
  if (meant.size() == 1 && !selector.empty())
    return *meant.front();

  const auto images = select(meant, isImage);
  const auto good =
      select(meant, [](const DicomSeries* one) { return one->geometry.verdict == Verdict::Ok; });
  const auto isVolume = [](const DicomSeries* one) { return !one->volume.empty(); };
  const auto ask = [&](const std::vector<const DicomSeries*>& among)
  {
    const bool volumes = std::any_of(among.begin(), among.end(), isVolume);
    throw DicomError(Reason::Ambiguous, path.string() + ": " + std::to_string(among.size()) +
                                            (volumes ? " volumes; name one by --series and "
                                                       "--volume: "
                                                     : " series; name one by --series: ") +
                                            uidList(among));
  };
  if (good.size() > 1)
    ask(good);
  if (good.size() == 1 && !isVolume(good.front()))
  {
    auto among =
        select(images, [&](const DicomSeries* one) { return isRival(*one, *good.front()); });
    if (among.empty())
      return *good.front();
    among.insert(among.begin(), good.front());
    ask(among);
  }
  // A volume of a series with several is the user's choice, even if it is the only sound one.
  if (good.size() == 1)
    ask(images);
  if (!images.empty())
  {
    const auto largest =
        *std::max_element(images.begin(), images.end(),
                          [](const auto* a, const auto* b)
                          { return a->geometry.slices.size() < b->geometry.slices.size(); });
    if (isVolume(largest))
      ask(images);
    return *largest;
  }
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
