#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "BatchTable.h"
#include "Commands.h"
#include "Numbers.h"
#include "Program.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/FileLock.h"
#include "petrous/Core/Fingerprint.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Core/WriteAll.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Network/NodeList.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CaseDicom.h"
#include "petrous/Presenters/CaseRegistration.h"
#include "petrous/Presenters/CaseStamp.h"
#include "petrous/Presenters/CaseTransfer.h"
#include "petrous/Presenters/LeavingImages.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Volume/VolumeBytes.h"

namespace petrous::cli
{

namespace fs = std::filesystem;
using nlohmann::json;

namespace
{

constexpr std::uintmax_t kLargestState = std::uintmax_t{1} << 28;

enum class Step
{
  Build,
  Describe,
  Register,
  Archive,
  Send
};
constexpr std::array<const char*, 5> kSteps{"build", "describe", "register", "archive", "send"};

const char* nameOf(Step step)
{
  return kSteps[static_cast<std::size_t>(step)];
}

/// What was done before, and survives a kill: a file of JSON lines, appended to and synced. The
/// first names the format, each other is {"key", ...}; the last of a key counts. A line that a kill
/// cut short is dropped.
class BatchState
{
public:
  /// Locks the file for as long as this lives, and makes it if `writes`. Throws OutputFileError,
  /// InvalidParameter for a file that is something else.
  BatchState(const fs::path& file, bool writes)
    : m_file(file)
  {
    std::error_code error;
    if (!writes && !fs::exists(file, error))
      return;
    if (writes)
      m_lock = std::make_unique<core::FileLock>(file, core::FileLock::IfHeld::Throw);
    const std::string text = core::readFile(file, kLargestState);
    const std::size_t whole = text.find_last_of('\n') + 1; // 0 without any
    if (whole == 0 && text != std::string_view(kFirstLine).substr(0, text.size()))
      throwForeign();
    for (std::size_t from = 0; from < whole;)
    {
      const std::size_t to = text.find('\n', from);
      json line = json::parse(text.substr(from, to - from), nullptr, false);
      if (from == 0 ? !line.is_object() || line.value("petrous_batch", 0) != 1
                    : !line.is_object() || !line.contains("key") || !line["key"].is_string())
        throwForeign();
      if (from > 0)
      {
        const std::string key = line["key"];
        m_records[key] = std::move(line);
      }
      from = to + 1;
    }
    if (!writes)
      return;
    m_descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (m_descriptor < 0 || ::ftruncate(m_descriptor, static_cast<off_t>(whole)) != 0)
      core::throwOutputError(errno, file);
    if (whole == 0)
      append(kFirstLine);
    core::syncFolder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  }
  ~BatchState()
  {
    if (m_descriptor >= 0)
      ::close(m_descriptor);
  }
  BatchState(const BatchState&) = delete;
  BatchState& operator=(const BatchState&) = delete;

  /// An empty object if there is none.
  json find(const std::string& key) const
  {
    const auto found = m_records.find(key);
    return found == m_records.end() ? json::object() : found->second;
  }

  /// Durable when it returns.
  void put(const std::string& key, json record)
  {
    record["key"] = key;
    append(record.dump(-1, ' ', false, json::error_handler_t::replace));
    m_records[key] = std::move(record);
  }

private:
  static constexpr const char* kFirstLine = R"({"petrous_batch":1})";

  [[noreturn]] void throwForeign() const
  {
    throw core::InvalidParameter(core::printable(m_file) +
                                 ": is not the state of a batch that this program can go on with; "
                                 "name another report");
  }

  void append(const std::string& line)
  {
    const std::string text = line + "\n";
    if (const int error = core::writeAll(m_descriptor, text.data(), text.size()))
      core::throwOutputError(error, m_file);
    if (::fdatasync(m_descriptor) != 0)
      core::throwOutputError(errno, m_file);
  }

  fs::path m_file;
  std::unique_ptr<core::FileLock> m_lock;
  int m_descriptor = -1;
  std::map<std::string, json> m_records;
};

std::string textOf(const json& record, const char* key)
{
  return record.contains(key) && record[key].is_string() ? record[key].get<std::string>()
                                                         : std::string();
}

/// Content of a case as built: tells whether the case that is there is the one that a killed
/// program had built and not yet recorded.
std::string contentOf(const scene::Case& value)
{
  core::Fingerprint print;
  const auto addText = [&print](const std::string& text) { print.add(text.data(), text.size()); };
  const auto addImage = [&](const scene::ImagePart& image)
  {
    addText(image.name);
    for (int axis = 0; axis < 3; ++axis)
    {
      print.add(image.geometry.dims()[static_cast<std::size_t>(axis)]);
      print.add(image.geometry.spacing()[axis]);
      print.add(image.geometry.origin()[axis]);
      for (int row = 0; row < 3; ++row)
        print.add(image.geometry.direction()(row, axis));
    }
    image.volume.get()->visit([&print](const auto& voxels)
                              { print.add(voxels.data(), voxels.size() * sizeof *voxels.data()); });
  };
  addImage(value.ct);
  for (const scene::ImagePart& mr : value.mr)
    addImage(mr);
  for (const scene::LabelPart& part : value.labels)
  {
    for (const scene::StructurePart& structure : part.structures)
      addText(structure.name);
    const std::vector<std::uint8_t> labels = volume::bytesOf(*part.labels.get());
    print.add(labels.data(), labels.size());
  }
  for (const scene::MeshPart& part : value.meshes)
  {
    addText(part.name);
    const auto mesh = part.mesh.get();
    print.add(mesh->vertices.data(), mesh->vertices.size() * sizeof mesh->vertices[0]);
    print.add(mesh->triangles.data(), mesh->triangles.size() * sizeof mesh->triangles[0]);
  }
  return std::to_string(print.value());
}

/// Changes whenever the file is written or replaced; null without one.
json stampOf(const fs::path& file)
{
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0)
    return {};
  return {status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

struct StepResult
{
  Step step;
  std::string status; ///< done, already done, would be done, failed, interrupted
  std::string text;
};

struct RowResult
{
  std::size_t line = 0;
  std::string name;
  std::string status = "pending"; ///< or as StepResult
  std::vector<StepResult> steps;
  std::string error;
  std::vector<std::string> notes;
  double seconds = 0.0;
  std::set<std::string> ownUids; ///< which this program made; they stay in the texts
};

json rowJson(const RowResult& row)
{
  json steps = json::object();
  for (const StepResult& step : row.steps)
  {
    steps[nameOf(step.step)] = {{"status", step.status}};
    if (!step.text.empty())
      steps[nameOf(step.step)]["text"] = step.text;
  }
  return {{"line", row.line},
          {"case", row.name},
          {"status", row.status},
          {"steps", std::move(steps)},
          {"error", row.error.empty() ? json() : json(row.error)},
          {"notes", row.notes},
          {"seconds", row.seconds}};
}

std::string rowText(const RowResult& row)
{
  std::string text = "line " + std::to_string(row.line) + ", '" + row.name + "': " + row.status;
  for (const StepResult& step : row.steps)
    text += std::string("; ") + nameOf(step.step) + " " + step.status +
            (step.text.empty() ? "" : " (" + step.text + ")");
  return text + (row.error.empty() ? "" : ": " + row.error);
}

/// UIDs of a scanner name patients to whoever has them, and a report is handed on: "UID 1" and so
/// on, in the order of the text, in their place. `own`: those that this program made name nobody,
/// and by that of its study a case is received.
std::string withoutUids(const std::string& text, const std::set<std::string>& own)
{
  constexpr const char* kOfUid = "0123456789.";
  constexpr std::ptrdiff_t kLeastDots = 3; // or of a UUID, "2.25." and up to 39 digits
  constexpr std::size_t kLongNumber = 16;
  const auto isAddress = [](const std::string& word) // IPv4
  {
    std::array<unsigned char, 4> bytes{};
    return ::inet_pton(AF_INET, word.c_str(), bytes.data()) == 1;
  };
  std::vector<std::string> uids;
  std::string result;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t from = std::min(text.find_first_of("012", at), text.size());
    result += text.substr(at, from - at);
    const std::size_t to = std::min(text.find_first_not_of(kOfUid, from), text.size());
    std::string word = text.substr(from, to - from);
    at = to;
    while (!word.empty() && word.back() == '.')
    {
      word.pop_back();
      --at;
    }
    const bool isWithin =
        from > 0 && (std::isalnum(static_cast<unsigned char>(text[from - 1])) != 0 ||
                     text[from - 1] == '.'); // a number's end
    const auto dots = std::count(word.begin(), word.end(), '.');
    if (isWithin || word.size() < 2 || word[1] != '.' || own.count(word) > 0 || isAddress(word) ||
        (dots < kLeastDots && (dots < 2 || word.size() < kLongNumber)))
    {
      result += word;
      continue;
    }
    const auto known = std::find(uids.begin(), uids.end(), word);
    result += "UID " + std::to_string(known - uids.begin() + 1);
    if (known == uids.end())
      uids.push_back(word);
  }
  return result + (uids.empty() ? "" : " ('petrous scan' shows the UIDs)");
}

/// The same of the paths of a row's sources, which are often named after patients: the column in
/// their place, which the row's line has.
class SourceNames
{
public:
  explicit SourceNames(const BatchRow& row)
  {
    if (!row.sources)
      return;
    const presenters::PartSources& parts = row.sources->parts;
    add("folder", {row.sources->ct});
    const auto pathsOf = [](const std::vector<presenters::PartSource>& list)
    {
      std::vector<fs::path> paths;
      for (const presenters::PartSource& one : list)
        paths.push_back(one.path);
      return paths;
    };
    add("mr", pathsOf(parts.mr));
    add("labels", pathsOf(parts.labels));
    add("label names", {parts.labelNames});
    add("meshes", pathsOf(parts.meshes));
    // A path may begin as another one does.
    std::stable_sort(m_names.begin(), m_names.end(),
                     [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
  }

  /// `own`: UIDs that stay.
  std::string in(std::string text, const std::set<std::string>& own) const
  {
    for (const auto& [path, name] : m_names)
      for (std::size_t at = text.find(path); at != text.npos; at = text.find(path, at))
      {
        std::size_t end = at + path.size();
        const bool isFileIn = end < text.size() && text[end] == '/';
        if (isFileIn)
        {
          const std::size_t rest = end;
          end = text.size();
          for (const char* next : {": ", "; ", ", ", "'"})
            end = std::min(end, text.find(next, rest));
        }
        const std::string words = isFileIn ? "a file in " + name : name;
        text.replace(at, end - at, words);
        at += words.size();
      }
    return withoutUids(text, own);
  }

private:
  void add(const std::string& column, const std::vector<fs::path>& paths)
  {
    for (std::size_t n = 0; n < paths.size(); ++n)
      if (!paths[n].empty())
        m_names.emplace_back(paths[n].string(),
                             "'" + column + "'" +
                                 (paths.size() > 1 ? " " + std::to_string(n + 1) : ""));
  }

  std::vector<std::pair<std::string, std::string>> m_names; ///< path, column
};

/// Progress as JSON lines on stderr, for programs; otherwise the bar of every command.
class BatchProgress
{
public:
  BatchProgress(const Context& context, bool asJson, std::size_t rows)
    : m_context(context)
    , m_asJson(asJson)
    , m_rows(static_cast<double>(rows))
    , m_bar(context.progress())
  {
  }

  /// Of a step of the row with this index, which covers `first` to `last` of the row and which must
  /// outlive it.
  core::Progress of(std::size_t index, const RowResult& row, const SourceNames& sources, Step step,
                    double first, double last)
  {
    return m_context.progress(
        [this, index, &row, sources, step, first, last,
         shown = std::make_shared<int>(-1)](double fraction, const std::string& whole)
        {
          const std::string text = sources.in(whole, row.ownUids);
          const double total =
              (static_cast<double>(index) + first + fraction * (last - first)) / m_rows;
          if (!m_asJson)
          {
            m_bar.report(total, "'" + row.name + "': " + text);
            return;
          }
          const std::lock_guard<std::mutex> lock(m_mutex);
          if (const int percent = static_cast<int>(100.0 * fraction); percent != *shown)
          {
            *shown = percent;
            print({{"event", "progress"},
                   {"line", row.line},
                   {"case", row.name},
                   {"step", nameOf(step)},
                   {"fraction", fraction},
                   {"total", total},
                   {"text", text}});
          }
        });
  }

  void check() const { m_bar.check("batch"); }

  void event(const char* name, json content)
  {
    if (!m_asJson)
      return;
    const std::lock_guard<std::mutex> lock(m_mutex);
    content["event"] = name;
    print(content);
  }

  bool isJson() const { return m_asJson; }

private:
  static void print(const json& line) { std::cerr << jsonLine(line) + "\n" << std::flush; }

  const Context& m_context;
  bool m_asJson;
  double m_rows;
  core::Progress m_bar;
  std::mutex m_mutex;
};

// What would be read; throws what reading it would throw, as far as headers tell.
//
// option  column that says its unit
std::string lookAtImage(const fs::path& path, const std::string& selector, bool repair,
                        const std::optional<double>& unit, const std::string& option,
                        const core::Progress& progress)
{
  if (!fs::is_directory(path) && imaging::isReadAs(path, imaging::kImage | imaging::kLabels))
  {
    const core::InputFile opens(path);
    const auto header = imaging::readImageHeader(path, imaging::volumeNumber(path, selector));
    if (!unit && !header.unitDoubt.likely.empty())
      throw presenters::ImageUnitUnclear(path, header.unitDoubt, option);
    return "an image file of " + fixed(1e-6 * static_cast<double>(opens.size()), 1) + " MB";
  }
  const auto scan = imaging::scanDicom(path, progress, library::scanCache().get());
  const auto& series = imaging::chooseSeries(scan, path, selector);
  const imaging::SeriesGeometry& geometry = series.geometry;
  const std::string why = geometry.findings.empty() ? "" : ": " + geometry.findings.front().text;
  if (geometry.verdict == imaging::Verdict::Refused || !geometry.grid)
    throw core::InvalidParameter(path.string() + ": the series is refused" + why);
  if (geometry.verdict == imaging::Verdict::Repairable && !repair)
    throw core::InvalidParameter(path.string() + ": needs repair" + why +
                                 "; with 'repair' yes it is resampled to a straight volume");
  const auto& n = geometry.grid->dims();
  return std::to_string(n[2]) + " slices of " + std::to_string(n[0]) + " x " +
         std::to_string(n[1]) + (geometry.verdict == imaging::Verdict::Ok ? "" : ", repaired");
}

void lookAtFile(const fs::path& path)
{
  if (!fs::is_directory(path)) // of masks
    core::InputFile opens(path);
}

struct BatchOptions
{
  std::string table, report;
  bool dryRun = false;
  bool progress = false;
};

/// Does the rows of a table, one after the other, each step by the function that the command of
/// its name calls.
class Batch
{
public:
  Batch(const Context& context, const BatchOptions& options, fs::path library, BatchState& state,
        BatchProgress& progress)
    : m_context(context)
    , m_options(options)
    , m_library(std::move(library))
    , m_state(state)
    , m_progress(progress)
  {
  }

  /// Fills `result`. Throws CancelledError, and what the state throws: going on would lose what was
  /// done.
  void run(std::size_t index, const BatchRow& row, RowResult& result)
  {
    const auto start = std::chrono::steady_clock::now();
    const SourceNames sources(row);
    const auto finish = [&](const std::string& status, const std::string& error)
    {
      result.status = status;
      const auto told = [&](const std::string& text)
      { return withColumns(sources.in(text, result.ownUids)); };
      result.error = told(error);
      for (StepResult& step : result.steps)
        step.text = sources.in(step.text, result.ownUids);
      for (std::string& note : result.notes)
        note = told(note);
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      result.seconds = seconds.count();
    };
    const auto fail = [&](const std::string& why)
    {
      if (!result.steps.empty() && result.steps.back().status.empty())
        result.steps.back().status = "failed";
      finish("failed", why);
    };
    try
    {
      if (!row.problem.empty())
        throw core::InvalidParameter(row.problem);
      steps(index, row, sources, result);
      const bool anew =
          std::any_of(result.steps.begin(), result.steps.end(),
                      [](const StepResult& step) { return step.status != "already done"; });
      finish(anew ? m_options.dryRun ? "would be done" : "done" : "already done", "");
    }
    catch (const StateError& error)
    {
      fail(error.what());
      throw;
    }
    catch (const core::CancelledError&)
    {
      if (!result.steps.empty() && result.steps.back().status.empty())
        result.steps.back().status = "interrupted";
      finish("interrupted", "");
      throw;
    }
    catch (const std::exception& error)
    {
      fail(messageOf(error));
    }
  }

private:
  /// A state that cannot be written ends the batch.
  struct StateError : core::OutputFileError
  {
    using core::OutputFileError::OutputFileError;
    explicit StateError(const core::OutputFileError& error)
      : core::OutputFileError(error)
    {
    }
  };

  void put(const std::string& key, json record)
  {
    try
    {
      m_state.put(key, std::move(record));
    }
    catch (const core::OutputFileError& error)
    {
      throw StateError(error);
    }
  }

  void steps(std::size_t index, const BatchRow& row, const SourceNames& sources, RowResult& result)
  {
    std::vector<Step> wanted;
    if (row.sources)
      wanted.push_back(Step::Build);
    if (row.describes())
      wanted.push_back(Step::Describe);
    if (row.registers)
      wanted.push_back(Step::Register);
    if (!row.archive.empty())
      wanted.push_back(Step::Archive);
    if (!row.node.empty())
      wanted.push_back(Step::Send);
    if (wanted.empty())
      throw core::InvalidParameter("the row asks for nothing; give folder, tags, register, archive "
                                   "or send");
    // Each row reads through a library of its own, so that damage found in one stays its own.
    library::Library library(m_library);
    library.onNotice([&result](const std::string& text) { result.notes.push_back(text); });
    std::optional<network::Node> node; // known before minutes of reading
    if (!row.node.empty())
      node = network::NodeList(m_library).at(row.node);
    if (!row.sources && !isPlanned(library, row) && !library.contains(row.name))
      throw core::InvalidParameter("there is no case '" + row.name +
                                   "' in the library; give its folder to build it");
    for (std::size_t n = 0; n < wanted.size(); ++n)
    {
      result.steps.push_back({wanted[n], "", ""});
      StepResult& step = result.steps.back();
      const auto count = static_cast<double>(wanted.size());
      const core::Progress progress =
          m_progress.of(index, result, sources, wanted[n], static_cast<double>(n) / count,
                        static_cast<double>(n + 1) / count);
      bool isDone = true;
      switch (wanted[n])
      {
      case Step::Build:
        isDone = build(library, row, step, result, progress);
        break;
      case Step::Describe:
        isDone = describe(library, row, result);
        break;
      case Step::Register:
        isDone = registerAll(library, row, step, progress);
        break;
      case Step::Archive:
        isDone = archive(library, row, step, result, progress);
        break;
      case Step::Send:
        isDone = send(library, row, *node, step, result, progress);
        break;
      }
      step.status = !isDone ? "already done" : m_options.dryRun ? "would be done" : "done";
    }
  }

  // Each returns whether it did something, or would.

  bool build(library::Library& library, const BatchRow& row, StepResult& step, RowResult& result,
             const core::Progress& progress)
  {
    const std::string key = std::string("build ") + row.buildKey;
    if (library.contains(row.name))
    {
      const scene::Case there = library.open(row.name);
      const json record = m_state.find(key);
      if (const std::string id = textOf(record, "case_id"); !id.empty() && id == there.id)
        return false;
      // Killed between the save and its record.
      if (const std::string content = textOf(record, "content");
          !content.empty() && content == contentOf(there))
      {
        library.checkVoxels(there, progress);
        if (!m_options.dryRun)
          put(key, {{"case_id", there.id}});
        return false;
      }
      throw library::LibraryError(library::LibraryError::Reason::NameTaken,
                                  "case '" + row.name +
                                      "' is in the library already, and not from this row; choose "
                                      "another name, or leave 'folder' blank to go on with it");
    }
    library::refuseTakenName(library.folder(), row.name); // before minutes of reading
    const presenters::CaseSources& sources = *row.sources;
    if (m_options.dryRun)
    {
      step.text = lookAtImage(sources.ct, sources.series, sources.repair, sources.unit, "ct_unit",
                              progress.part(0.0, 0.7));
      for (const presenters::PartSource& mr : sources.parts.mr)
        lookAtImage(mr.path, mr.series, mr.repair, mr.unit, "mr_unit", progress.part(0.7, 1.0));
      for (const auto* list : {&sources.parts.labels, &sources.parts.meshes})
        for (const presenters::PartSource& part : *list)
          lookAtFile(part.path);
      if (!sources.parts.labelNames.empty())
        lookAtFile(sources.parts.labelNames);
      m_planned[row.name] = !sources.parts.mr.empty();
      return true;
    }
    std::vector<presenters::StructureReport> structures;
    scene::Case value =
        presenters::buildCase(row.name, sources, progress.part(0.0, 0.8), &structures);
    put(key, {{"content", contentOf(value)}});
    library.save(value, progress.part(0.8, 1.0));
    put(key, {{"case_id", value.id}});
    step.text = structures.empty() ? "" : presenters::summaryOf(structures).text;
    const auto note = [&result](const std::string& part, const std::vector<std::string>& notes)
    {
      for (const std::string& one : notes)
        result.notes.push_back(part + ": " + one);
    };
    note(value.ct.name, value.ct.notes);
    for (const scene::ImagePart& mr : value.mr)
      note(mr.name, mr.notes);
    for (const scene::LabelPart& labels : value.labels)
      note("labels", labels.notes);
    for (const scene::MeshPart& mesh : value.meshes)
      note(mesh.name, mesh.notes);
    return true;
  }

  // Of a case that a dry run would build nothing is known.
  bool isPlanned(const library::Library& library, const BatchRow& row) const
  {
    return m_planned.count(row.name) > 0 && !library.contains(row.name);
  }

  bool describe(library::Library& library, const BatchRow& row, RowResult& result)
  {
    if (isPlanned(library, row))
      return true;
    const std::string key = std::string("describe ") + row.describeKey;
    const scene::Case there = library.open(row.name);
    if (textOf(m_state.find(key), "case_id") == there.id)
      return false; // what was changed since by hand stays
    scene::Description next = there.description;
    row.describe(next);
    const bool changes = next != there.description;
    if (row.side)
    {
      scene::Case described = there;
      described.description = next;
      if (std::string doubt = presenters::sideDoubt(described); !doubt.empty())
        result.notes.push_back(std::move(doubt));
    }
    if (m_options.dryRun)
      return changes;
    library.describe(row.name, next);
    put(key, {{"case_id", there.id}});
    return changes;
  }

  bool registerAll(library::Library& library, const BatchRow& row, StepResult& step,
                   const core::Progress& progress)
  {
    if (isPlanned(library, row))
    {
      if (!m_planned.at(row.name))
        throw core::InvalidParameter("case '" + row.name + "' would have no MR to register");
      return true;
    }
    scene::Case value = library.open(row.name);
    if (value.mr.empty())
      throw core::InvalidParameter("case '" + row.name + "' has no MR to register");
    std::vector<std::string> names;
    for (const scene::ImagePart& mr : value.mr)
      if (!mr.registered)
        names.push_back(mr.name);
    if (names.empty())
      return false;
    if (m_options.dryRun)
    {
      step.text = scene::listed(names);
      return true;
    }
    for (std::size_t n = 0; n < names.size(); ++n)
    {
      presenters::RegistrationRequest request;
      request.mr = names[n];
      const auto count = static_cast<double>(names.size());
      const auto outcome = presenters::registerMr(
          value, request,
          progress.part(static_cast<double>(n) / count, static_cast<double>(n + 1) / count));
      library.checkVoxels(value);
      if (outcome.failed)
        throw core::InvalidParameter("MR '" + names[n] +
                                     "' was not registered: " + outcome.how.text +
                                     " Register it by hand (landmarks), then go on.");
      presenters::accept(value, names[n], outcome);
      library.save(value);
      step.text +=
          (step.text.empty() ? "'" : ", '") + names[n] + "' " + scene::nameOf(outcome.how.verdict);
    }
    return true;
  }

  // A node of the same name at another place is another one.
  static std::string placeOf(const network::Node& node)
  {
    const std::string place = node.host + "\n" + std::to_string(node.port) + "\n" + node.aeTitle;
    return library::sha256Of(reinterpret_cast<const std::uint8_t*>(place.data()), place.size())
        .substr(0, 16);
  }

  // What leaves is another thing with other choices, so that they belong to the key of the step.
  static std::string choicesOf(const BatchRow& row)
  {
    return std::string(row.masksFace ? " mask_face" : "") +
           (row.withoutNotes ? " without_notes" : "") + (row.withVideos ? " with_videos" : "") +
           (row.withDocuments ? " with_documents" : "");
  }

  // In the report of the row: nobody may be there to read a warning.
  static void noteIdentities(const presenters::IdentityReport& report, RowResult& result)
  {
    for (const std::string& warning : report.warnings)
      if (std::find(result.notes.begin(), result.notes.end(), warning) == result.notes.end())
        result.notes.push_back(warning);
  }

  // Whether a step was done with the case as it is now.
  bool isDoneWith(const scene::Case& value, const json& record) const
  {
    return textOf(record, "case_id") == value.id && record.value("revision", json()).is_number() &&
           record["revision"] == value.revision;
  }

  bool archive(library::Library& library, const BatchRow& row, StepResult& step, RowResult& result,
               const core::Progress& progress)
  {
    m_context.refuseOverwriting({row.archive.string()}, {m_options.table, m_options.report});
    step.text = row.archive.string();
    if (isPlanned(library, row))
      return true;
    const std::string key = "archive " + row.name + " " + row.archive.string() + choicesOf(row);
    const scene::Case value = library.open(row.name);
    const json record = m_state.find(key);
    if (isDoneWith(value, record) && record.value("file", json()) == stampOf(row.archive))
      return false;
    scene::ImageMask mask;
    mask.face = row.masksFace;
    library::ArchiveOptions how;
    how.withoutNotes = row.withoutNotes;
    how.withVideos = row.withVideos;
    how.withDocuments = row.withDocuments;
    how.prepare = presenters::maskForArchive(library, mask);
    noteIdentities(presenters::identityReport(value, how, mask, &library), result);
    if (m_options.dryRun)
      return true;
    const library::ArchiveSummary done =
        library::archiveCase(library, row.name, row.archive, how, progress);
    for (const std::string& note : done.notes)
      result.notes.push_back(note);
    if (!done.durable)
      result.notes.push_back(row.archive.string() +
                             ": is written, but the disk reported an error; check the disk");
    put(key, {{"case_id", value.id}, {"revision", value.revision}, {"file", stampOf(row.archive)}});
    return true;
  }

  bool send(library::Library& library, const BatchRow& row, const network::Node& node,
            StepResult& step, RowResult& result, const core::Progress& progress)
  {
    step.text = "'" + row.node + "'";
    if (isPlanned(library, row))
      return true;
    const std::string key =
        "send " + row.name + " " + row.node + " " + placeOf(node) + choicesOf(row);
    const scene::Case value = library.open(row.name);
    if (isDoneWith(value, m_state.find(key)))
      return false;
    presenters::SendParts parts;
    parts.ct = parts.mr = parts.labels = parts.scene = true;
    parts.note = !row.withoutNotes;
    parts.videos = row.withVideos;
    parts.documents = row.withDocuments;
    parts.mask.face = row.masksFace;
    const presenters::CaseIdentifiers identifiers(value);
    result.ownUids = {identifiers.study(), identifiers.formerStudy()};
    noteIdentities(presenters::identityReport(value, parts, nullptr, &library), result);
    if (m_options.dryRun)
      return true;
    const presenters::SendSummary done =
        presenters::sendCase(library, row.name, node, parts, progress);
    for (const std::string& note : done.notes)
      result.notes.push_back(note);
    if (const std::string why = presenters::unlistedText(done.transfer); !why.empty())
      result.notes.push_back("node '" + row.node + "' confirmed every instance, but " + why);
    step.text += ", " + std::to_string(done.transfer.instances) + " instances";
    // What could not be counted there is asked for again in the next run, and sent if it is not
    // there; of a node without queries nothing more will be known.
    if (done.transfer.verified || done.transfer.listed == network::Transfer::Listed::NotOffered)
      put(key, {{"case_id", value.id}, {"revision", value.revision}, {"study", done.studyUid}});
    return true;
  }

  const Context& m_context;
  const BatchOptions& m_options;
  fs::path m_library;
  BatchState& m_state;
  BatchProgress& m_progress;
  std::map<std::string, bool> m_planned; ///< cases that a dry run would build; whether with an MR
};

json answerOf(const BatchOptions& options, const std::vector<RowResult>& rows)
{
  std::map<std::string, std::size_t> counts;
  for (const char* status :
       {"done", "already done", "would be done", "failed", "interrupted", "pending"})
    counts[status] = 0;
  json list = json::array();
  for (const RowResult& row : rows)
  {
    ++counts[row.status];
    list.push_back(rowJson(row));
  }
  return {{"table", options.table},
          {"dry_run", options.dryRun},
          {"rows", std::move(list)},
          {"counts", counts}};
}

std::string reportText(const BatchTable& table, const std::vector<RowResult>& rows,
                       const json& answer, const std::string& report)
{
  if (CLI::detail::to_lower(fs::path(report).extension().string()) == ".json")
    return jsonText(answer);
  std::vector<std::vector<std::string>> cells{{"line", "name", "status"}};
  for (const char* step : kSteps)
    cells[0].emplace_back(step);
  for (const char* column : {"seconds", "error", "notes"})
    cells[0].emplace_back(column);
  for (const RowResult& row : rows)
  {
    std::vector<std::string> line{std::to_string(row.line), row.name, row.status};
    for (const char* step : kSteps)
    {
      line.emplace_back();
      for (const StepResult& one : row.steps)
        if (nameOf(one.step) == std::string(step))
          line.back() = one.status + (one.text.empty() ? "" : ": " + one.text);
    }
    line.push_back(fixed(row.seconds, 1));
    line.push_back(row.error);
    std::string notes;
    for (const std::string& note : row.notes)
      notes += (notes.empty() ? "" : "\n") + note;
    line.push_back(notes);
    cells.push_back(std::move(line));
  }
  return (table.hasByteOrderMark ? "\xef\xbb\xbf" : "") + core::csvText(cells, table.delimiter);
}

void batch(const Context& context, const BatchOptions& options)
{
  const fs::path state =
      fs::absolute((options.report.empty() ? options.table : options.report) + ".state");
  context.refuseOverwriting({options.report, state.string()}, {options.table});
  const BatchTable table = readBatchTable(options.table);
  const fs::path library = context.openLibrary().folder();
  BatchState before(state, !options.dryRun);
  BatchProgress progress(context, options.progress, table.rows.size());
  Batch work(context, options, library, before, progress);
  std::vector<RowResult> rows;
  for (const BatchRow& row : table.rows)
  {
    rows.emplace_back();
    rows.back().line = row.line;
    rows.back().name = row.name;
  }
  const auto report = [&]
  {
    json answer = answerOf(options, rows);
    if (!options.report.empty())
      core::writeFile(options.report, reportText(table, rows, answer, options.report));
    return answer;
  };
  progress.event("start", {{"rows", rows.size()}, {"table", options.table}});
  try
  {
    for (std::size_t n = 0; n < rows.size(); ++n)
    {
      progress.check();
      work.run(n, table.rows[n], rows[n]);
      progress.event("row", rowJson(rows[n]));
      context.print(rowText(rows[n]));
      if (!progress.isJson())
        for (const std::string& note : rows[n].notes)
          context.warn("'" + rows[n].name + "': " + note);
    }
  }
  catch (...) // what was done is in the state; the report says how far it came
  {
    try
    {
      report();
    }
    catch (const core::Error&)
    {
    }
    throw;
  }
  const json answer = report();
  progress.event("end", {{"counts", answer["counts"]}});
  const std::size_t failed = answer["counts"]["failed"];
  context.print(std::to_string(rows.size() - failed) + " of " + std::to_string(rows.size()) +
                (rows.size() == 1 ? " row" : " rows") +
                (options.dryRun ? " would be done" : " done") +
                (options.report.empty() ? "" : "; the report is " + options.report));
  context.printJson(answer);
  if (failed > 0)
    throw core::InvalidParameter(
        options.table + ": " + std::to_string(failed) + " of " + std::to_string(rows.size()) +
        (rows.size() == 1 ? " row" : " rows") + " failed" +
        (options.dryRun ? " or would"
                        : "; mend them and run the batch again, which goes on from "
                          "there"));
}

} // namespace

void addBatchCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<BatchOptions>();
  CLI::App* command =
      context.addCommand(app, "batch",
                         "Build, describe, register, archive or send the cases of a table; what "
                         "was done before is not done again",
                         [options, &context] { batch(context, *options); });
  command
      ->add_option("TABLE", options->table,
                   "CSV file in UTF-8, a row a case; relative paths start at its folder")
      ->required();
  command->add_flag("--dry-run", options->dryRun,
                    "Only scan the files, and say what each row would do");
  command
      ->add_option("--report,--out", options->report,
                   "What became of each row, as CSV or JSON; the state to go on from is kept "
                   "beside it (REPORT.state), else beside the table")
      ->check(CLI::Validator(
          [](std::string& file)
          {
            const std::string ending = CLI::detail::to_lower(fs::path(file).extension().string());
            return ending == ".csv" || ending == ".json"
                       ? std::string()
                       : "the file's name must end in .csv or .json, not '" +
                             fs::path(file).filename().string() + "'";
          },
          ""))
      ->type_name("F.csv|F.json");
  command->add_flag("--progress", options->progress,
                    "Progress as JSON lines on stderr, for programs");
  command->footer(batchColumns() + "\n" + kExitCodes);
}

} // namespace petrous::cli
