#include "petrous/Imaging/NrrdFile.h"

#include <array>
#include <cerrno>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "FileHelpers.h"
#include "NrrdHeader.h"
#include "OutputFile.h"
#include "VoxelWriter.h"
#include "petrous/Core/SystemMemory.h"

namespace petrous::imaging
{

namespace
{

constexpr std::size_t kPage = 4096;
// NRRD's "space directions" are spacing times direction cosines; stored separately as well, both
// are restored bit-exactly.
constexpr const char* kSpacingKey = "petrous_spacing";
constexpr const char* kDirectionKey = "petrous_direction";

std::string paddedHeader(const core::GridGeometry& geometry, const char* type,
                         std::optional<double> padding)
{
  std::string header = nrrdHeaderText(geometry, type, "raw");
  std::string spacing;
  std::string direction;
  for (int a = 0; a < 3; ++a)
    spacing += (a ? " " : "") + exactText(geometry.spacing()[a]);
  for (int a = 0; a < 9; ++a)
    direction += (a ? " " : "") + exactText(geometry.direction()(a / 3, a % 3));
  header += nrrdKeyText(kSpacingKey, spacing) + nrrdKeyText(kDirectionKey, direction);
  if (padding)
    header += nrrdKeyText(kPaddingKey, exactText(*padding));
  // "#", padding, line end, blank line
  const std::size_t least = header.size() + 3;
  const std::size_t end = (least + kPage - 1) / kPage * kPage;
  return header + "#" + std::string(end - least, ' ') + "\n\n";
}

void writeRaw(const std::filesystem::path& path, const core::GridGeometry& geometry,
              const VoxelType& type, const void* voxels, std::optional<double> padding,
              const core::Progress& progress)
{
  OutputFile file(path);
  file.write(paddedHeader(geometry, type.nrrd, padding));
  file.writeVoxels(voxels, geometry.voxelCount() * static_cast<std::size_t>(type.bits / 8),
                   progress);
  progress.check("writing voxels");
  file.commit();
}

template <std::size_t N>
std::array<double, N> numbers(const std::filesystem::path& path, const std::string* text,
                              const char* what)
{
  std::array<double, N> values{};
  std::string plain = text ? *text : "";
  for (char& c : plain)
    if (c == '(' || c == ')' || c == ',')
      c = ' ';
  std::string_view rest = plain;
  bool good = text != nullptr;
  for (double& value : values)
  {
    const auto number = parseDouble(takeWord(rest));
    good = good && number;
    value = number.value_or(0.0);
  }
  if (!good || !trimmed(rest).empty())
    fail(FileError::Reason::Unreadable, path,
         std::string("its header has no valid '") + what + "'; it is damaged, restore it");
  return values;
}

core::GridGeometry exactGeometry(const std::filesystem::path& path, const NrrdHeader& header)
{
  const auto sizes = numbers<3>(path, header.field("sizes"), "sizes");
  const auto steps = numbers<9>(path, header.field("space directions"), "space directions");
  const auto origin = numbers<3>(path, header.field("space origin"), "space origin");
  const auto spacing = numbers<3>(path, header.key(kSpacingKey), kSpacingKey);
  const auto axes = numbers<9>(path, header.key(kDirectionKey), kDirectionKey);
  core::Index3 dims{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (!(sizes[a] >= 1.0 && sizes[a] <= 2147483647.0) || sizes[a] != static_cast<int>(sizes[a]))
      fail(FileError::Reason::Unreadable, path,
           "its header gives impossible dimensions; it is damaged, restore it");
    dims[a] = static_cast<int>(sizes[a]);
  }
  Eigen::Matrix3d direction;
  for (int a = 0; a < 9; ++a)
    direction(a / 3, a % 3) = axes[static_cast<std::size_t>(a)];
  try
  {
    const core::GridGeometry geometry(dims, {spacing[0], spacing[1], spacing[2]},
                                      {origin[0], origin[1], origin[2]}, direction);
    const Eigen::Map<const Eigen::Matrix3d> stated(steps.data());
    if ((stated - geometry.patientFromVoxelLinear()).cwiseAbs().maxCoeff() > 1e-9)
      fail(FileError::Reason::Unreadable, path,
           "its header contradicts itself about the axes; it is damaged, restore it");
    return geometry;
  }
  catch (const core::InvalidParameter&)
  {
    fail(FileError::Reason::NoGeometry, path,
         "its header gives no valid grid; it is damaged, restore it");
  }
}

/// Whether the file system is of a kind whose medium or server is taken away while files are open.
bool mayVanish(int file)
{
  struct statfs system = {};
  if (fstatfs(file, &system) != 0)
    return true;
  switch (static_cast<std::uint32_t>(system.f_type))
  {
  case NFS_SUPER_MAGIC:
  case SMB_SUPER_MAGIC:
  case CIFS_SUPER_MAGIC:
  case SMB2_SUPER_MAGIC:
  case CEPH_SUPER_MAGIC:
  case AFS_SUPER_MAGIC:
  case V9FS_MAGIC:
  case FUSE_SUPER_MAGIC: // NTFS by ntfs-3g, sshfs
  case MSDOS_SUPER_MAGIC:
  case EXFAT_SUPER_MAGIC:
  case ISOFS_SUPER_MAGIC:
  case UDF_SUPER_MAGIC:
    return true;
  default:
    return false;
  }
}

/// The file's bytes, from a page onwards; released with the last volume that uses them.
std::shared_ptr<char> openBytes(const std::filesystem::path& path, std::size_t size,
                                VoxelAccess access)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
    fail(FileError::Reason::Unreadable, path, "may not be opened; allow reading it");
  const std::shared_ptr<const int> closing(&file, [](const int* open) { close(*open); });
  struct stat now = {};
  const bool asChecked = fstat(file, &now) == 0 && static_cast<std::size_t>(now.st_size) == size;
  const bool isCopied =
      access == VoxelAccess::Copied || (access == VoxelAccess::Automatic && mayVanish(file) &&
                                        size <= core::systemMemory().available);
  void* start = MAP_FAILED;
  if (asChecked)
    start = isCopied
                ? mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
                : mmap(nullptr, size, PROT_READ, MAP_SHARED, file, 0);
  if (start == MAP_FAILED)
    fail(FileError::Reason::Unreadable, path,
         "cannot be mapped into memory; close other cases or programs");
  std::shared_ptr<char> bytes(static_cast<char*>(start), [size](char* p) { munmap(p, size); });
  if (!isCopied)
  {
    madvise(start, size, MADV_WILLNEED);
    return bytes;
  }
  for (std::size_t done = 0; done < size;)
  {
    const ssize_t got = pread(file, bytes.get() + done, size - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      fail(FileError::Reason::Unreadable, path,
           "could not be read: the disk or medium was removed or reports an error");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

template <class T>
volume::IntensityVolume::Voxels adopt(const core::GridGeometry& geometry,
                                      const std::shared_ptr<char>& map, std::size_t offset)
{
  // Shared as const, so that nobody writes to the read-only pages.
  return std::make_shared<const volume::Volume<T>>(
      geometry, std::shared_ptr<T>(map, reinterpret_cast<T*>(map.get() + offset)));
}

} // namespace

void writeRawNrrd(const std::filesystem::path& path, const volume::IntensityVolume& volume,
                  const core::Progress& progress)
{
  volume.visit(
      [&](const auto& voxels)
      {
        using T = typename std::decay_t<decltype(voxels)>::Value;
        writeRaw(path, voxels.geometry(), voxelTypeOf<T>(), voxels.data(), volume.padding(),
                 progress);
      });
}

void writeRawNrrd(const std::filesystem::path& path, const volume::Volume<std::uint16_t>& volume,
                  const core::Progress& progress)
{
  writeRaw(path, volume.geometry(), voxelTypeOf<std::uint16_t>(), volume.data(), std::nullopt,
           progress);
}

std::shared_ptr<const volume::IntensityVolume> mapRawNrrd(const std::filesystem::path& path,
                                                          VoxelAccess access)
{
  const NrrdHeader header = readNrrdHeader(path);
  const std::pair<const char*, const char*> fixed[] = {{"dimension", "3"},
                                                       {"space", "left-posterior-superior"},
                                                       {"encoding", "raw"},
                                                       {"endian", "little"},
                                                       {"kinds", "domain domain domain"}};
  for (const auto& [name, value] : fixed)
    if (const std::string* text = header.field(name); !text || *text != value)
      fail(FileError::Reason::Unsupported, path,
           std::string("its header field '") + name + "' is not '" + value +
               "'; only files that this program wrote can be mapped, import it instead");
  for (const char* name : {"data file", "line skip", "byte skip"})
    if (header.field(name))
      fail(FileError::Reason::Unsupported, path,
           std::string("its header has a field '") + name +
               "'; only files that this program wrote can be mapped, import it instead");
  if (header.dataOffset % kPage != 0)
    fail(FileError::Reason::Unsupported, path,
         "its voxels do not start on a page; only files that this program wrote can be mapped, "
         "import it instead");
  const std::string type = header.field("type") ? *header.field("type") : "";
  const std::size_t voxelBytes = type == "float" ? 4 : 2;
  if (type != "short" && type != "unsigned short" && type != "float")
    fail(FileError::Reason::Unsupported, path,
         "its voxels are of a type that is not mapped; short, unsigned short or float is");
  const core::GridGeometry geometry = exactGeometry(path, header);

  const std::uintmax_t size = checkedFileSize(path);
  // In long double, as absurd dimensions would overflow the integer product.
  const long double wanted = static_cast<long double>(geometry.dims()[0]) * geometry.dims()[1] *
                                 geometry.dims()[2] * static_cast<long double>(voxelBytes) +
                             static_cast<long double>(header.dataOffset);
  if (wanted != static_cast<long double>(size))
    fail(FileError::Reason::Unreadable, path,
         "is " + std::to_string(size) + " bytes long; its header asks for " +
             roughText(static_cast<double>(wanted)) + ", so it was cut off or changed, restore it");
  std::optional<double> padding;
  if (header.key(kPaddingKey))
    padding = numbers<1>(path, header.key(kPaddingKey), kPaddingKey)[0];

  const std::shared_ptr<char> map = openBytes(path, static_cast<std::size_t>(size), access);
  auto voxels = type == "float"   ? adopt<float>(geometry, map, header.dataOffset)
                : type == "short" ? adopt<std::int16_t>(geometry, map, header.dataOffset)
                                  : adopt<std::uint16_t>(geometry, map, header.dataOffset);
  return std::make_shared<const volume::IntensityVolume>(std::move(voxels), padding);
}

} // namespace petrous::imaging
