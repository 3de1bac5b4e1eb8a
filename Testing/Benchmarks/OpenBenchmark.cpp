#include "OpenBenchmark.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "BenchmarkPatients.h"
#include "PeerPicture.h"
#include "TimedView.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Library/Library.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Rendering/ScenePicture.h"

namespace petrous::cli
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Voxels = volume::Volume<std::int16_t>;

constexpr const char* kCase = "ear";

// Of `work`; `after` follows each, untimed.
double medianOf(
    int rounds, const std::function<void()>& work, const std::function<void()>& after = [] {})
{
  std::vector<double> seconds;
  for (int round = 0; round < rounds; ++round)
  {
    const auto start = Clock::now();
    work();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    after();
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

scene::Case caseOf(const BenchmarkPatient& patient)
{
  scene::Case value;
  value.name = kCase;
  value.iso = kBenchmarkIso;
  value.ct.name = "ct";
  value.ct.geometry = patient.ct->geometry();
  value.ct.volume = patient.ct;
  value.ct.range = patient.ct->range();
  const auto presets = appearance::StructurePresets::builtIn();
  scene::LabelPart part;
  for (const volume::Segment& segment : patient.labelMap->segments)
  {
    scene::StructurePart structure;
    structure.name = segment.name;
    structure.index = segment.index;
    structure.voxels = segment.voxels;
    structure.volume = patient.labelMap->volume(segment);
    structure.look = presets.lookFor(segment.name);
    part.structures.push_back(std::move(structure));
  }
  part.labels = patient.labelMap;
  value.labels = {part};
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = patient.ct->geometry();
  // Of other voxels: equal ones would be the CT's object.
  auto voxels = std::make_shared<Voxels>(mr.geometry, std::int16_t{7});
  mr.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const Voxels>(std::move(voxels)));
  value.mr = {mr};
  return value;
}

class File
{
public:
  explicit File(const fs::path& path)
    : m_descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
    , m_bytes(fs::file_size(path))
  {
    if (m_descriptor < 0)
      throw std::runtime_error(path.string() + ": cannot be opened");
  }
  ~File() { ::close(m_descriptor); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void dropFromCache() const
  {
    ::fsync(m_descriptor); // pages that are not written yet stay
    ::posix_fadvise(m_descriptor, 0, 0, POSIX_FADV_DONTNEED);
  }

  double megabytesInCache() const
  {
    void* start = ::mmap(nullptr, m_bytes, PROT_READ, MAP_SHARED, m_descriptor, 0);
    if (start == MAP_FAILED)
      throw std::runtime_error("a file cannot be mapped");
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    std::vector<unsigned char> pages((m_bytes + page - 1) / page);
    ::mincore(start, m_bytes, pages.data());
    ::munmap(start, m_bytes);
    const auto there =
        std::count_if(pages.begin(), pages.end(), [](unsigned char one) { return (one & 1) != 0; });
    return 1e-6 * static_cast<double>(static_cast<std::size_t>(there) * page);
  }

  double megabytes() const { return 1e-6 * static_cast<double>(m_bytes); }

private:
  int m_descriptor;
  std::uintmax_t m_bytes;
};

struct Objects
{
  fs::path ct, labels, mr;
};

// What is in the cache after a first picture with an empty one; nullopt: it cannot be emptied.
struct Cached
{
  double shown = 0.0; // MB of the objects that the picture shows
  double read = 0.0;  // MB of all
  double other = 0.0; // MB of those that it does not show
};
std::optional<Cached> cachedAfter(const Objects& objects, const std::function<void()>& open)
{
  const File ct(objects.ct), labels(objects.labels), mr(objects.mr);
  for (const File* file : {&ct, &labels, &mr})
  {
    file->dropFromCache();
    if (file->megabytesInCache() > 0.0)
      return std::nullopt;
  }
  open();
  Cached cached;
  cached.shown = ct.megabytes() + labels.megabytes();
  cached.other = mr.megabytesInCache();
  cached.read = ct.megabytesInCache() + labels.megabytesInCache() + cached.other;
  return cached;
}

// The voxels are the end of an object.
std::shared_ptr<const volume::IntensityVolume> readWhole(const fs::path& object,
                                                         const core::GridGeometry& grid)
{
  auto voxels = std::make_shared<Voxels>(grid);
  const auto bytes = static_cast<std::streamoff>(voxels->size() * sizeof(std::int16_t));
  std::ifstream file(object, std::ios::binary);
  file.seekg(-bytes, std::ios::end);
  if (!file.read(reinterpret_cast<char*>(voxels->data()), bytes))
    throw std::runtime_error(object.string() + ": cannot be read");
  return std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const Voxels>(std::move(voxels)));
}

} // namespace

std::vector<core::BenchmarkPoint> openToPicture(const fs::path& work, bool quick,
                                                const core::Progress& progress)
{
  const int width = quick ? 160 : 640, height = quick ? 120 : 480;
  const int rounds = quick ? 1 : 5;
  const fs::path folder = work / "library";
  std::string name;
  Objects objects;
  core::GridGeometry grid;
  {
    const BenchmarkPatient patient = phantomPatient(quick ? 96 : 512, progress.part(0.0, 0.6));
    name = "open to the first picture, " + patient.name;
    grid = patient.ct->geometry();
    scene::Case value = caseOf(patient);
    library::Library(folder).save(value);
    const fs::path there = folder / "objects";
    objects = {there / value.ct.object, there / value.labels.front().object,
               there / value.mr.front().object};
  }
  rendering::TimedView view(width, height);
  rendering::SceneContents drawn;
  core::CameraPose camera;
  std::optional<library::Library> library;
  const auto open = [&]
  {
    library.emplace(folder);
    const scene::Case value = library->open(kCase);
    presenters::SceneAssembly assembly;
    drawn = assembly.contents(value);
    camera = presenters::currentCamera(value);
    rendering::ScenePicture picture;
    picture.setContents(drawn);
    picture.setCamera(camera);
    view.show(picture);
    view.frame();
  };
  progress.report(0.7, "opening");
  // What is read is compared with its hash meanwhile; no round has that of the one before.
  const auto finish = [&] { library->checkAllRead(); };
  open(); // data that are derived once, and shaders
  finish();
  core::BenchmarkPoint ours;
  ours.scene = name;
  ours.isDefault = true;
  ours.seconds = medianOf(rounds, open, finish);
  ours.setting["gl_renderer"] = view.glRenderer();
  ours.setting["picture"] = std::to_string(width) + "x" + std::to_string(height);
  ours.errorUnit = "MB read that are not shown";

  core::BenchmarkPoint peer = ours;
  peer.isDefault = false;
  peer.peer = "read, " + nameOf(rendering::Peer::GpuComposite);
  peer.errorUnit = "none: other optics than ours";
  progress.report(0.85, peer.peer);
  rendering::SceneContents contents = drawn;
  peer.seconds =
      medianOf(rounds,
               [&]
               {
                 contents.ct = readWhole(objects.ct, grid);
                 rendering::PeerPicture picture(rendering::Peer::GpuComposite, contents, camera);
                 view.show(picture);
                 view.frame();
               });
  contents = {};
  drawn = {}; // pages that are mapped stay in the cache
  if (const auto cached = cachedAfter(objects, open))
  {
    ours.error = cached->other;
    ours.extra["mb_read"] = cached->read;
    ours.extra["mb_shown"] = cached->shown;
  }
  return {ours, peer};
}

} // namespace petrous::cli
