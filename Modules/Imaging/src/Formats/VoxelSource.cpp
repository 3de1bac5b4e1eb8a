#include "VoxelSource.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <utility>

#include "FileHelpers.h"
#include "GridFromAffine.h"
#include "MemoryCheck.h"
#include "MetaHeader.h"
#include "NiftiHeader.h"
#include "NrrdLayout.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/FileFormats.h"

namespace petrous::imaging
{

namespace
{

/// The most decoded bytes that a byte of the file can stand for; beyond, the header does not belong
/// to the voxels.
long double mostBytesPerByte(Packing packing)
{
  switch (packing)
  {
  case Packing::Zlib:
    return 1032.0L;
  case Packing::Bzip2:
    return 1.2e6L; // a block of 900,000 runs of up to 259 bytes in 5, in some 40 bytes
  case Packing::Hex:
    return 0.5L;
  case Packing::None:
    break;
  }
  return 1.0L;
}

/// DT_ codes of nifti1.h.
std::optional<Component> niftiComponent(int dataType)
{
  constexpr std::pair<int, Component> kTypes[] = {
      {2, Component::UInt8},    {4, Component::Int16},    {8, Component::Int32},
      {16, Component::Float},   {64, Component::Double},  {256, Component::Int8},
      {512, Component::UInt16}, {768, Component::UInt32}, {1024, Component::Int64},
      {1280, Component::UInt64}};
  for (const auto& [code, component] : kTypes)
    if (code == dataType)
      return component;
  return std::nullopt;
}

constexpr std::size_t kChecked = 65536; // numbers between two checks for a cancellation

/// Calls visit(first, count) for parts of `all` numbers.
template <class Visit>
void inParts(std::size_t all, const core::Progress& progress, const Visit& visit)
{
  for (std::size_t first = 0; first < all; first += kChecked)
  {
    progress.check("reading voxels");
    visit(first, std::min(kChecked, all - first));
  }
}

/// The numbers of a text, one after the other; the file is read in pieces.
class TextNumbers
{
public:
  TextNumbers(const std::filesystem::path& path, std::uint64_t offset)
    : m_file(path, std::ios::binary)
  {
    m_file.seekg(static_cast<std::streamoff>(offset));
  }

  /// The next word, which stands until the next call; empty at the end, or if it is too long for a
  /// number.
  std::string_view next()
  {
    while (true)
    {
      while (m_at < m_end && isBetween(m_bytes[m_at]))
        ++m_at;
      std::size_t end = m_at;
      while (end < m_end && !isBetween(m_bytes[end]))
        ++end;
      const std::size_t length = end - m_at;
      if (end < m_end || !refill()) // which moves the word to the front
      {
        const std::string_view word(m_bytes.data() + m_at, length);
        m_at += length;
        return word;
      }
    }
  }

private:
  static bool isBetween(char c) { return c == ',' || c == ' ' || (c >= '\t' && c <= '\r'); }

  /// Keeps what is not taken yet; false if nothing comes after it.
  bool refill()
  {
    std::copy(m_bytes.begin() + static_cast<std::ptrdiff_t>(m_at),
              m_bytes.begin() + static_cast<std::ptrdiff_t>(m_end), m_bytes.begin());
    m_end -= m_at;
    m_at = 0;
    m_file.read(m_bytes.data() + m_end, static_cast<std::streamsize>(m_bytes.size() - m_end));
    m_end += static_cast<std::size_t>(m_file.gcount());
    return m_file.gcount() > 0;
  }

  std::ifstream m_file;
  std::vector<char> m_bytes = std::vector<char>(std::size_t{1} << 16);
  std::size_t m_at = 0;
  std::size_t m_end = 0;
};

std::shared_ptr<void> allocate(const std::filesystem::path& path, std::size_t bytes,
                               const std::string& advice)
{
  requireMemory(path, bytes, advice);
  if (void* memory = std::malloc(std::max<std::size_t>(bytes, 1)))
    return {memory, std::free};
  fail(FileError::Reason::Unreadable, path,
       "needs " + roughText(static_cast<double>(bytes) / 1e9) +
           " GB of memory, which the system refuses; close programs or " + advice,
       core::Fault::Refused);
}

} // namespace

VoxelSource::VoxelSource(const std::filesystem::path& path, const char* advice)
  : m_path(path)
  , m_advice(advice)
{
  m_dataBytes = checkedFileSize(path);
  const FileFormat* format = formatOf(path);
  if (!format || !format->openVoxels)
    fail(FileError::Reason::UnknownFormat, path,
         "is of no format that is read; give a " + orText(readEndings(kImage | kLabels)) + " file");
  checkFormat(path, format->name);
  (this->*format->openVoxels)();
}

void VoxelSource::openNifti()
{
  NiftiHeader header = readNiftiHeader(m_path);
  m_notes = std::move(header.notes);
  m_padding = paddingIn(header.description);
  m_isHounsfield = header.intentName == std::string(kUnitKey) + "=" + kHounsfield;
  const auto stored = niftiComponent(header.dataType);
  if (!stored)
    fail(FileError::Reason::Unsupported, m_path,
         "its voxels are of a type that is not read (colours, complex or long double); save them "
         "as whole numbers or float");
  m_stored = *stored;
  if (header.rescaled())
  {
    m_slope = header.slope;
    m_intercept = header.intercept;
  }
  m_dims = header.dims;
  countVolumes();
  m_dataBytes = checkedFileSize(header.file);
  m_place.parts = {{header.file, 0}};
  m_place.packedOffset = header.voxelOffset;
  m_place.packing = header.packed ? Packing::Zlib : Packing::None;
  m_swapped = header.swapped;
  checkRoom();
  m_apart = header.apart;
  m_other = header.other;
  m_isQform = header.isQform;
  m_isSformOfTemplate = header.isSformOfTemplate;
  m_whyPlacement = m_isQform ? "as the patient lies there" : "as the NIfTI standard says";
  place(header.placement.linear, header.placement.origin, header.unit);
  if (header.isSideAssumed)
    m_assumedRas = true;
}

/// Places the voxels in the file's unit, whether or not that makes sense.
void VoxelSource::place(const Eigen::Matrix3d& linear, const Eigen::Vector3d& origin,
                        const LengthUnit& unit)
{
  constexpr double kUnits[] = {1.0, 1e-3, 1e3, 10.0, 1e-6, 25.4}; // mm, as namedUnit
  m_unit = unit;
  m_linear = linear;
  m_origin = origin;
  if (m_dims.size() >= 3 && linear.allFinite() && !isPlausibleSize(m_dims, linear))
  {
    m_unitDoubt = {unit.mm, unit.isStated, longestEdge(m_dims, linear), {}};
    for (const double other : kUnits)
      if (other != unit.mm && isPlausibleSize(m_dims, other / unit.mm * linear))
        m_unitDoubt.likely.push_back(other);
  }
  scaleTo(m_unit.mm, m_unitDoubt.likely.empty());
}

void VoxelSource::scaleTo(double unit, bool isUnitKnown)
{
  const double scale = unit / m_unit.mm;
  std::vector<std::string> notes; // in the millimetres of this unit
  if (scale * m_apart > kPlacementsDiffer)
    notes.push_back(std::string("places itself twice") +
                    (m_isSformOfTemplate ? ", in the space of a template (sform) and in that of "
                                           "the scanner (qform)"
                                         : " (sform and qform)") +
                    ", up to " + roughText(scale * m_apart) + " mm apart; the " +
                    (m_isQform ? "qform" : "sform") + " is used, " + m_whyPlacement);
  m_geometry =
      gridFromAffine(m_path, m_dims, scale * m_linear, scale * m_origin, notes, isUnitKnown);
  m_placeNotes = std::move(notes);
  m_taken = unit;
}

/// What was read and what was assumed; empty if mm is stated and taken.
std::string VoxelSource::unitNote() const
{
  const Eigen::Vector3d& h = m_geometry->spacing();
  const std::string voxels = core::plainText(h[0], 4) + " x " + core::plainText(h[1], 4) + " x " +
                             core::plainText(h[2], 4) + " mm";
  if (!m_unitWhy.empty())
  {
    const std::string unitText = m_unit.isUnknown      ? "states a unit of length that is not known"
                                 : !m_unit.isStated    ? "states no unit of length"
                                 : m_unit.name.empty() ? "states mm"
                                                       : "states " + m_unit.name;
    const bool isOwn = m_unit.isStated && !m_unit.isUnknown && m_taken == m_unit.mm;
    return unitText +
           (isOwn
                ? ", which was taken"
                : ", but its numbers were taken in units of " + core::plainText(m_taken) + " mm") +
           ", " + m_unitWhy + ": its voxels are " + voxels;
  }
  if (m_unit.isUnknown)
    return "states a unit of length that is not known; taken as mm";
  if (!m_unit.isStated)
    return "states no unit of length; taken as mm";
  return m_unit.name.empty() ? std::string()
                             : "is in " + m_unit.name + "; converted, its voxels are " + voxels;
}

std::vector<std::string> VoxelSource::notes() const
{
  std::vector<std::string> all = m_notes;
  if (std::string unit = unitNote(); !unit.empty())
    all.push_back(std::move(unit));
  all.insert(all.end(), m_placeNotes.begin(), m_placeNotes.end());
  return all;
}

bool VoxelSource::settleUnit(const std::optional<double>& unit,
                             const std::vector<ImageGrid>& images)
{
  const auto settle = [this](const char* why)
  {
    m_unitWhy = why;
    m_unitDoubt = {};
    return true;
  };
  if (unit)
  {
    scaleTo(*unit);
    return settle("as asked");
  }
  if (m_unitDoubt.likely.empty() || images.empty())
    return m_unitDoubt.likely.empty();
  std::vector<double> units = {m_unit.mm};
  units.insert(units.end(), m_unitDoubt.likely.begin(), m_unitDoubt.likely.end());
  for (const double one : units)
  {
    try
    {
      scaleTo(one);
    }
    catch (const FileError&)
    {
      continue; // no size or place that can be true
    }
    if (std::any_of(images.begin(), images.end(),
                    [this](const ImageGrid& grid) { return core::sameGrid(grid, *m_geometry); }))
      return settle("as its grid is then that of an image of the case");
  }
  scaleTo(m_unit.mm, false);
  return false;
}

void VoxelSource::takeFileUnit()
{
  if (!m_unitDoubt.likely.empty())
    scaleTo(m_unit.mm);
}

void VoxelSource::settlePlacement(const std::vector<ImageGrid>& images)
{
  const double scale = m_taken / m_unit.mm;
  const bool isUnitKnown = m_unitDoubt.likely.empty();
  if (!m_other || images.empty() || !isUnitKnown || scale * m_apart <= kPlacementsDiffer)
    return;
  const auto isOfImage = [&images](const core::GridGeometry& own)
  {
    // Both are float32, the qform a rotation besides; more than one of them cannot be within this.
    constexpr double kSame = 0.5 * kPlacementsDiffer;
    return std::any_of(images.begin(), images.end(),
                       [&own](const ImageGrid& grid) { return core::sameGrid(grid, own, kSame); });
  };
  if (isOfImage(*m_geometry))
    return;
  std::optional<core::GridGeometry> other;
  try
  {
    std::vector<std::string> notes; // given again if it is taken
    other = gridFromAffine(m_path, m_dims, scale * m_other->linear, scale * m_other->origin, notes);
  }
  catch (const FileError&)
  {
    return; // no size or place that can be true
  }
  if (isOfImage(*other))
  {
    std::swap(m_linear, m_other->linear);
    std::swap(m_origin, m_other->origin);
    m_isQform = !m_isQform;
    m_whyPlacement = "as its grid is then that of an image of the case";
    scaleTo(m_taken);
    return;
  }
  const auto away = [&](const core::GridGeometry& grid)
  { return (grid.center() - images.front().center()).norm(); };
  const core::GridGeometry& qform = m_isQform ? *m_geometry : *other;
  const core::GridGeometry& sform = m_isQform ? *other : *m_geometry;
  m_notes.push_back("has the grid of no image of the case by either place: its middle is " +
                    roughText(away(qform)) + " mm from that of the first by the qform, and " +
                    roughText(away(sform)) + " mm by the sform");
}

void VoxelSource::assume(bool isRas)
{
  if (!m_assumedRas || *m_assumedRas == isRas)
    return;
  const Eigen::Vector3d other(-1.0, -1.0, 1.0); // half a turn about the axis upwards
  const core::GridGeometry& grid = *m_geometry;
  m_geometry = core::GridGeometry(grid.dims(), grid.spacing(), other.cwiseProduct(grid.origin()),
                                  other.asDiagonal() * grid.direction());
  m_assumedRas = isRas;
}

bool VoxelSource::settleSide(const std::optional<bool>& isRas, const std::vector<ImageGrid>& images)
{
  if (!m_assumedRas)
    return true;
  const auto note = [this](const char* why)
  {
    m_notes.push_back(std::string("does not say which side of the patient is left; its axes were "
                                  "taken as ") +
                      (*m_assumedRas ? "RAS" : "LPS") + why);
  };
  if (isRas)
  {
    assume(*isRas);
    note(", as asked");
    return true;
  }
  constexpr double kAside = 0.01; // mm, ten times what equal grids may differ by
  const bool first = *m_assumedRas;
  const auto isOfImage = [&](bool side)
  {
    assume(side);
    // From 0, 0, 0 on, which no header has to state, the grid is any image's.
    const bool tells = m_geometry->origin().head<2>().norm() > kAside;
    return std::any_of(images.begin(), images.end(),
                       [&](const ImageGrid& grid) {
                         return (tells || grid.isSideAssumed) && core::sameGrid(grid, *m_geometry);
                       });
  };
  const bool isOther = isOfImage(!first);
  if (isOfImage(first) == isOther)
  {
    assume(first);
    return false;
  }
  assume(isOther ? !first : first);
  note(", as its grid is then that of an image of the case");
  return true;
}

void VoxelSource::openNrrd()
{
  m_nrrd = readNrrdHeader(m_path);
  NrrdLayout layout = readNrrdLayout(m_path, *m_nrrd);
  if (const std::string* text = m_nrrd->key(kPaddingKey))
    m_padding = parseDouble(trimmed(*text));
  if (const std::string* unit = m_nrrd->key(kUnitKey))
    m_isHounsfield = trimmed(*unit) == kHounsfield;
  m_notes = std::move(layout.notes);
  m_dims = std::move(layout.dims);
  m_components = layout.components;
  countVolumes();
  if (layout.isList)
    m_volumes = m_components;
  m_stored = layout.component;
  m_dataBytes = layout.dataBytes;
  m_place = std::move(layout.place);
  m_swapped = layout.swapped;
  m_isText = layout.isText;
  checkRoom();
  place(layout.linear, layout.origin, layout.unit);
  if (layout.isSideAssumed)
    m_assumedRas = false;
}

void VoxelSource::openMeta()
{
  MetaHeader header = readMetaHeader(m_path);
  m_padding = paddingIn(header.comment);
  m_isHounsfield = header.isHounsfield;
  m_notes = std::move(header.notes);
  m_dims = std::move(header.dims);
  countVolumes();
  m_stored = header.component;
  if (header.slope != 1.0 || header.intercept != 0.0)
  {
    m_slope = header.slope;
    m_intercept = header.intercept;
  }
  m_dataBytes = header.dataBytes;
  m_place.parts = {{header.file, header.offset}};
  m_place.packing = header.packed ? Packing::Zlib : Packing::None;
  m_swapped = header.swapped;
  checkRoom();
  // Unless declared binary, the voxels may be text, except if their length matches exactly.
  if (!header.saysBinary && !header.packed &&
      voxelBytes() !=
          static_cast<long double>(m_dataBytes) - static_cast<long double>(header.offset))
    failMetaKind(m_path);
  place(header.linear, header.origin, header.unit);
  if (header.isSideAssumed)
    m_assumedRas = false;
}

void VoxelSource::countVolumes()
{
  while (m_dims.size() > 3 && m_dims.back() == 1)
    m_dims.pop_back();
  if (m_dims.size() < 3 || m_dims.size() > 4 || (m_dims.size() == 4 && m_components > 1))
    fail(FileError::Reason::Unsupported, m_path,
         "holds " + dimsText(m_dims) +
             " voxels; volumes of 3 dimensions are needed, at most one after the other along a "
             "fourth");
  m_volumes = m_dims.size() == 4 ? static_cast<std::size_t>(m_dims[3]) : 1;
}

void VoxelSource::select(std::size_t volume)
{
  if (volume < 1 || volume > m_volumes)
    fail(FileError::Reason::Unsupported, m_path,
         "has no volume " + std::to_string(volume) + "; it holds " +
             (m_volumes == 1 ? "one" : "volumes 1 to " + std::to_string(m_volumes)));
  if (m_volumes == 1)
    return;
  m_volume = volume - 1;
  m_listed = std::exchange(m_components, 1); // of other files one number a voxel, too
  m_notes.push_back("holds " + std::to_string(m_volumes) + " volumes, of which this is number " +
                    std::to_string(volume));
}

void VoxelSource::requireOneVolume(bool canBeNamed) const
{
  if (m_volumes > 1 && !m_volume)
    fail(FileError::Reason::Unsupported, m_path,
         "holds " + std::to_string(m_volumes) + " volumes of " +
             dimsText({m_dims.begin(), m_dims.begin() + 3}) + " voxels; one is needed: " +
             (canBeNamed
                  ? "name it by its number, 1 to " + std::to_string(m_volumes) +
                        " (--volume N, of an MR FILE##N), or save it alone"
                  : "save each alone, or all as one volume with a value for each structure"));
}

long double VoxelSource::voxelBytes() const
{
  // Not in integers: absurd dimensions would overflow the product.
  long double bytes = static_cast<long double>(m_components);
  for (const std::uint64_t n : m_dims)
    bytes *= static_cast<long double>(n);
  return bytes * visitComponent(m_stored, [](auto type) { return sizeof type; });
}

void VoxelSource::checkRoom()
{
  // A number as text takes a digit and a separator; the last needs no separator.
  const long double numberBytes = visitComponent(m_stored, [](auto type) { return sizeof type; });
  const long double needed = m_isText ? 2.0L * voxelBytes() / numberBytes - 1.0L : voxelBytes();
  auto before =
      static_cast<long double>(m_place.packing == Packing::None ? m_place.packedOffset : 0);
  before *= static_cast<long double>(m_place.parts.size());
  for (const VoxelPlace::Part& part : m_place.parts)
    before += static_cast<long double>(part.offset);
  const long double there = static_cast<long double>(m_dataBytes) - before;
  if (needed > mostBytesPerByte(m_place.packing) * there)
    fail(FileError::Reason::Unreadable, m_path,
         "its header speaks of " + dimsText(m_dims) +
             " voxels, which the file is too short to hold; copy it again from where it came");
  m_place.partBytes = static_cast<std::uint64_t>(voxelBytes()) / m_place.parts.size();
  if (m_place.packing == Packing::None && !m_isText && there > needed)
    noteSurplus(static_cast<std::uint64_t>(there - needed));
}

/// Of bytes behind the voxels. Those of a file that begins with its voxels may be a header before
/// them as well.
void VoxelSource::noteSurplus(std::uint64_t bytes)
{
  if (m_place.parts.front().offset == 0 && m_place.packedOffset == 0)
    m_notes.push_back("its file of voxels holds " + std::to_string(bytes) +
                      (bytes == 1 ? " byte" : " bytes") +
                      " more than its header speaks of, left out at the end; if they are another "
                      "header at the beginning, all voxels are shifted: check the image");
  else
    m_notes.push_back("holds " + std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes") +
                      " behind its voxels, of which its header does not speak; left out");
}

std::shared_ptr<void> VoxelSource::rescaledCopy(const void* stored, std::size_t count,
                                                const core::Progress& progress) const
{
  auto copy = allocate(m_path, count * sizeof(float), m_advice);
  auto* out = static_cast<float*>(copy.get());
  visitComponent(m_stored,
                 [&](auto type)
                 {
                   const auto* in = static_cast<const decltype(type)*>(stored);
                   inParts(count, progress,
                           [&](std::size_t first, std::size_t size)
                           {
                             std::transform(in + first, in + first + size, out + first,
                                            [this](auto value) {
                                              return static_cast<float>(
                                                  m_slope * static_cast<double>(value) +
                                                  m_intercept);
                                            });
                           });
                 });
  return copy;
}

std::shared_ptr<void> VoxelSource::read(const core::IndexBox& box,
                                        const core::Progress& progress) const
{
  const std::size_t numberBytes = visitComponent(m_stored, [](auto type) { return sizeof type; });
  const std::size_t perVoxel = m_components * numberBytes;
  progress.report(0.0, "reading voxels");
  auto memory = allocate(m_path, box.count() * perVoxel, m_advice);
  if (m_isText)
    readText(box, memory.get(), progress);
  else if (m_listed > 1)
    readList(box, memory.get(), progress);
  else
  {
    VoxelStream stream(m_place);
    stream.skip(m_volume.value_or(0) * m_geometry->voxelCount() * perVoxel);
    readBox(stream, m_geometry->dims(), box, perVoxel, memory.get(), progress);
    if (m_swapped)
      inParts(box.count() * m_components, progress,
              [&](std::size_t first, std::size_t size) {
                swapBytes(static_cast<char*>(memory.get()) + first * numberBytes, size,
                          numberBytes);
              });
  }
  return rescaled() ? rescaledCopy(memory.get(), box.count(), progress) : memory;
}

void VoxelSource::forEachSlice(const std::function<bool(int k, const void* values)>& visit,
                               const core::Progress& progress, int step) const
{
  const core::Index3& dims = m_geometry->dims();
  const std::size_t numberBytes = visitComponent(m_stored, [](auto type) { return sizeof type; });
  const std::size_t count =
      static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]) * m_components;
  if (m_isText)
  {
    const auto all = read(m_geometry->fullBox(), progress);
    const std::size_t bytes = count * (rescaled() ? sizeof(float) : numberBytes);
    for (int k = 0; k < dims[2]; k += step)
      if (!visit(k, static_cast<const char*>(all.get()) + static_cast<std::size_t>(k) * bytes))
        return;
    return;
  }
  const auto memory = allocate(m_path, count * numberBytes, m_advice);
  const auto listed =
      m_listed > 1 ? allocate(m_path, count * m_listed * numberBytes, m_advice) : memory;
  VoxelStream stream(m_place);
  if (m_listed == 1)
    stream.skip(m_volume.value_or(0) * m_geometry->voxelCount() * numberBytes);
  for (int k = 0; k < dims[2]; ++k)
  {
    progress.check("reading voxels");
    if (k % step != 0)
    {
      stream.skip(count * m_listed * numberBytes);
      continue;
    }
    stream.read(listed.get(), count * m_listed * numberBytes);
    if (m_listed > 1)
      takeFromList(listed.get(), count, memory.get());
    if (m_swapped)
      swapBytes(memory.get(), count, numberBytes);
    if (!visit(k, rescaled() ? rescaledCopy(memory.get(), count, progress).get() : memory.get()))
      return;
  }
  stream.finish(progress);
}

void VoxelSource::takeFromList(const void* voxels, std::size_t count, void* out) const
{
  const std::size_t bytes = visitComponent(m_stored, [](auto type) { return sizeof type; });
  const auto* from = static_cast<const char*>(voxels) + *m_volume * bytes;
  auto* to = static_cast<char*>(out);
  for (std::size_t v = 0; v < count; ++v, from += m_listed * bytes, to += bytes)
    std::memcpy(to, from, bytes);
}

/// Of volumes whose voxels are interleaved the one that is selected.
void VoxelSource::readList(const core::IndexBox& box, void* out,
                           const core::Progress& progress) const
{
  const std::size_t bytes = visitComponent(m_stored, [](auto type) { return sizeof type; });
  const core::Index3& dims = m_geometry->dims();
  const core::Index3 size = box.size();
  const auto slice = static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]);
  const auto row = static_cast<std::size_t>(size[0]);
  const auto memory = allocate(m_path, slice * m_listed * bytes, m_advice);
  VoxelStream stream(m_place);
  stream.skip(static_cast<std::uint64_t>(box.lower[2]) * slice * m_listed * bytes);
  auto* next = static_cast<char*>(out);
  for (int k = 0; k < size[2]; ++k)
  {
    progress.report(static_cast<double>(k) / size[2], "reading voxels");
    stream.read(memory.get(), slice * m_listed * bytes);
    for (int j = box.lower[1]; j < box.upper[1]; ++j, next += row * bytes)
      takeFromList(static_cast<const char*>(memory.get()) +
                       (static_cast<std::size_t>(j) * static_cast<std::size_t>(dims[0]) +
                        static_cast<std::size_t>(box.lower[0])) *
                           m_listed * bytes,
                   row, next);
  }
  stream.finish(progress);
  if (m_swapped)
    swapBytes(out, box.count(), bytes);
}

void VoxelSource::readText(const core::IndexBox& box, void* out,
                           const core::Progress& progress) const
{
  TextNumbers numbers(m_place.parts.front().file, m_place.parts.front().offset);
  const core::Index3& dims = m_geometry->dims();
  if (m_listed == 1)
    for (std::size_t n = m_volume.value_or(0) * m_geometry->voxelCount(); n > 0; --n)
    {
      numbers.next();
      if (n % kChecked == 0)
        progress.check("reading voxels");
    }
  const std::size_t before = m_listed > 1 ? *m_volume : 0;
  const std::size_t behind = m_listed - 1 - before;
  visitComponent(
      m_stored,
      [&](auto type)
      {
        using T = decltype(type);
        auto* next = static_cast<T*>(out);
        for (int k = 0; k < box.upper[2]; ++k)
          for (int j = 0; j < dims[1]; ++j)
          {
            progress.report(static_cast<double>(k) / box.upper[2], "reading voxels");
            for (int i = 0; i < dims[0]; ++i)
            {
              for (std::size_t n = 0; n < before; ++n)
                numbers.next();
              for (std::size_t c = 0; c < m_components; ++c)
              {
                const auto value = parseDouble(numbers.next());
                if (!value || *value < static_cast<double>(std::numeric_limits<T>::lowest()) ||
                    *value > static_cast<double>(std::numeric_limits<T>::max()))
                  fail(FileError::Reason::Unreadable, m_path,
                       "breaks off or is damaged within its voxels; copy it again from where it "
                       "came");
                if (box.contains({i, j, k}))
                  *next++ = static_cast<T>(*value);
              }
              for (std::size_t n = 0; n < behind; ++n)
                numbers.next();
            }
          }
      });
}

} // namespace petrous::imaging
