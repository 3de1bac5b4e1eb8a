#include "VoxelSource.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <system_error>

#include "FileHelpers.h"
#include "GridFromAffine.h"
#include "MetaHeader.h"
#include "NiftiHeader.h"
#include "VoxelStream.h"

namespace petrous::imaging
{

namespace
{

// zlib cannot pack tighter than this; more is a header that does not belong to the voxels.
constexpr long double kTightestPacking = 1032.0L;

/// DT_ codes of nifti1.h.
std::optional<Component> niftiComponent(int dataType)
{
  switch (dataType)
  {
  case 2:
    return Component::UInt8;
  case 4:
    return Component::Int16;
  case 8:
    return Component::Int32;
  case 16:
    return Component::Float;
  case 64:
    return Component::Double;
  case 256:
    return Component::Int8;
  case 512:
    return Component::UInt16;
  case 768:
    return Component::UInt32;
  case 1024:
    return Component::Int64;
  case 1280:
    return Component::UInt64;
  default:
    return std::nullopt;
  }
}

std::shared_ptr<void> allocate(const std::filesystem::path& path, std::size_t bytes)
{
  if (void* memory = std::malloc(std::max<std::size_t>(bytes, 1)))
    return {memory, std::free};
  fail(FileError::Reason::Unreadable, path,
       "needs " + roughText(static_cast<double>(bytes) / 1e9) +
           " GB of memory, which is not free; close programs or give a region of interest",
       core::Fault::Internal);
}

} // namespace

VoxelSource::VoxelSource(const std::filesystem::path& path)
  : m_path(path)
{
  m_dataBytes = checkedFileSize(path);
  const std::string name = lowerName(path);
  if (endsWith(name, ".nii") || endsWith(name, ".nii.gz"))
    openNifti();
  else if (endsWith(name, ".nrrd") || endsWith(name, ".nhdr"))
    openNrrd();
  else if (endsWith(name, ".mha") || endsWith(name, ".mhd"))
    openMeta();
  else
    fail(FileError::Reason::UnknownFormat, path,
         "is of no format that is read; give a .nii, .nii.gz, .nrrd, .nhdr, .mha or .mhd file");
}

void VoxelSource::openNifti()
{
  NiftiHeader header = readNiftiHeader(m_path);
  m_notes = std::move(header.notes);
  if (header.dims.size() > 3)
    fail(FileError::Reason::Unsupported, m_path,
         "holds " + dimsText(header.dims) +
             " voxels; one volume of 3 dimensions is needed, so save one of them alone");
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
  m_place = Place{m_path, header.packed ? 0 : header.voxelOffset,
                  header.packed ? header.voxelOffset : 0, header.packed, header.swapped};
  checkRoom();
  m_geometry = gridFromAffine(m_path, header.dims, header.linear, header.origin, m_notes);
}

void VoxelSource::openNrrd()
{
  m_nrrd = readNrrdHeader(m_path);
  if (const std::string* data = m_nrrd->field("data file"))
    m_dataBytes = detachedBytes(m_path, *data);
  const std::string* units = m_nrrd->field("space units");
  std::string unit;
  if (units)
  {
    std::string_view rest = *units;
    unit = takeWord(rest);
  }
  const double scale = unitInMillimetres(unit, m_notes);
  const std::string* space = m_nrrd->field("space");
  const bool directions = m_nrrd->field("space directions") != nullptr;
  if (!directions && !m_nrrd->field("spacings"))
    fail(FileError::Reason::NoGeometry, m_path,
         "its header gives no voxel size ('space directions'); export it again with its geometry");
  if (!directions)
    m_notes.emplace_back("states no place in the patient: its axes are taken as to the left, back "
                         "and top of the patient, from 0, 0, 0");
  else if (!space)
    m_notes.emplace_back("states no patient frame; taken as left, posterior, superior (LPS)");
  else if (space->find("left") == space->npos && space->find("right") == space->npos &&
           *space != "LPS" && *space != "RAS" && *space != "LAS")
    m_notes.emplace_back("its frame is not a patient's; taken as left, posterior, superior (LPS)");
  readItkHeader();
  checkRoom();
  takeItkGeometry(scale);
}

void VoxelSource::openMeta()
{
  MetaHeader header = readMetaHeader(m_path);
  m_notes = std::move(header.notes);
  m_dims = std::move(header.dims);
  requireThreeDims();
  m_stored = header.component;
  m_dataBytes = header.dataBytes;
  m_place = Place{header.file, header.offset, 0, header.packed, header.swapped};
  checkRoom();
  // Not said to be binary, the voxels may be text, unless their length fits to the byte.
  if (!header.saysBinary && !header.packed &&
      voxelBytes() !=
          static_cast<long double>(m_dataBytes) - static_cast<long double>(header.offset))
    failMetaKind(m_path);
  m_geometry = gridFromAffine(m_path, m_dims, header.linear, header.origin, m_notes);
}

void VoxelSource::readItkHeader()
{
  m_reader = std::make_unique<ItkReader>(m_path, ItkReader::Format::Nrrd);
  if (!m_reader->readHeader())
    fail(FileError::Reason::Unreadable, m_path,
         "its header cannot be read; it is damaged or of an unknown kind, export it again");
  m_dims = m_reader->dims();
  m_components = m_reader->components();
  const auto component = m_reader->component();
  if (!component || m_components < 1)
    fail(FileError::Reason::Unsupported, m_path,
         "its voxels are of a type that is not read; save them as whole numbers or float");
  m_stored = *component;
  requireThreeDims();
}

void VoxelSource::requireThreeDims() const
{
  std::vector<std::uint64_t> kept = m_dims;
  while (kept.size() > 3 && kept.back() == 1)
    kept.pop_back();
  if (kept.size() != 3)
    fail(FileError::Reason::Unsupported, m_path,
         "holds " + dimsText(kept) + " voxels; one volume of 3 dimensions is needed");
}

void VoxelSource::takeItkGeometry(double unit)
{
  Eigen::Matrix3d linear;
  Eigen::Vector3d origin;
  for (unsigned a = 0; a < 3; ++a)
  {
    const auto axis = m_reader->axis(a);
    for (unsigned row = 0; row < 3; ++row)
      linear(row, a) = axis[row] * m_reader->spacing(a) * unit;
    origin[a] = m_reader->origin(a) * unit;
  }
  m_geometry = gridFromAffine(m_path, m_dims, linear, origin, m_notes);
}

long double VoxelSource::voxelBytes() const
{
  // Not in whole numbers: absurd dimensions would overflow their product.
  long double bytes = static_cast<long double>(m_components);
  for (const std::uint64_t n : m_dims)
    bytes *= static_cast<long double>(n);
  return bytes * visitComponent(m_stored, [](auto type) { return sizeof type; });
}

void VoxelSource::checkRoom() const
{
  const long double packing = m_place && !m_place->packed ? 1.0L : kTightestPacking;
  if (voxelBytes() > packing * static_cast<long double>(m_dataBytes))
    fail(FileError::Reason::Unreadable, m_path,
         "its header speaks of " + dimsText(m_dims) +
             " voxels, which the file is too short to hold; copy it again from where it came");
}

std::shared_ptr<void> VoxelSource::rescaledCopy(const void* stored, std::size_t count) const
{
  auto copy = allocate(m_path, count * sizeof(float));
  auto* out = static_cast<float*>(copy.get());
  visitComponent(m_stored,
                 [&](auto type)
                 {
                   const auto* in = static_cast<const decltype(type)*>(stored);
                   std::transform(in, in + count, out,
                                  [this](auto value) {
                                    return static_cast<float>(m_slope * static_cast<double>(value) +
                                                              m_intercept);
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
  if (m_place)
  {
    auto memory = allocate(m_path, box.count() * perVoxel);
    VoxelStream stream(m_place->file, m_place->offset, m_place->packed);
    stream.skip(m_place->packedOffset);
    readBox(stream, m_geometry->dims(), box, perVoxel, m_place->swapped, memory.get(), progress);
    return rescaled() ? rescaledCopy(memory.get(), box.count()) : memory;
  }
  const core::IndexBox loaded = m_geometry->fullBox();
  auto memory = allocate(m_path, loaded.count() * perVoxel);
  if (!m_reader->read(loaded.lower, loaded.size(), memory.get()))
    fail(FileError::Reason::Unreadable, m_path,
         "breaks off or is damaged within its voxels; copy it again from where it came");
  progress.report(0.9, "reading voxels");
  if (loaded == box)
    return memory;

  auto kept = allocate(m_path, box.count() * perVoxel);
  const core::Index3 part = box.size();
  const std::size_t row = static_cast<std::size_t>(part[0]) * perVoxel;
  auto* out = static_cast<char*>(kept.get());
  for (int k = 0; k < part[2]; ++k)
    for (int j = 0; j < part[1]; ++j, out += row)
      std::memcpy(out,
                  static_cast<const char*>(memory.get()) +
                      m_geometry->linearIndex(box.lower[0], box.lower[1] + j, box.lower[2] + k) *
                          perVoxel,
                  row);
  return kept;
}

} // namespace petrous::imaging
