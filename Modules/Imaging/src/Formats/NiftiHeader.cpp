#include "NiftiHeader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <Eigen/Geometry>
#include <itk_zlib.h>

#include "FileHelpers.h"
#include "petrous/Core/NumberText.h"

namespace petrous::imaging
{

namespace
{

constexpr std::size_t kHeaderBytes = 348;
constexpr std::size_t kHeaderBytes2 = 540;
constexpr std::size_t kDataOffset = 352;
constexpr std::size_t kDataOffset2 = 544;
constexpr double kLargestOffset = 1e9;
constexpr const char* kGzipStart = "\x1f\x8b";
constexpr double kMaxQuaternion = 1.001; // squared norm; float32 and few digits round by less
// NIfTI uses right, anterior, superior; the patient frame is left, posterior, superior.
const Eigen::Vector3d kLpsFromRas(-1.0, -1.0, 1.0);

constexpr std::size_t kDescription = 80; // bytes
constexpr std::size_t kIntentName = 16;

/// Byte offsets of the fields.
struct Offsets
{
  std::size_t magic, dataType, bits, dim, pixdim, voxels, slope, intercept, units, qformCode,
      sformCode, quaternion, qoffset, srow, description, intentName;
};
constexpr Offsets kNifti1{344, 70,  72,  40,  76,  108, 112, 116,
                          123, 252, 254, 256, 268, 280, 148, 328}; // nifti1.h
constexpr Offsets kNifti2{4,   12,  14,  16,  104, 168, 176, 184,
                          500, 344, 348, 352, 376, 400, 240, 508}; // nifti2.h

/// A header of either version: NIfTI-2 has the same fields, wider and elsewhere.
class Fields
{
public:
  Fields(std::string bytes, bool second, bool swapped)
    : m_bytes(std::move(bytes))
    , m_at(second ? kNifti2 : kNifti1)
    , m_second(second)
    , m_swapped(swapped)
  {
  }

  bool isSecond() const noexcept { return m_second; }
  bool swapped() const noexcept { return m_swapped; }
  std::string_view magic() const { return std::string_view(m_bytes).substr(m_at.magic, 4); }

  std::int64_t dim(std::size_t n) const { return whole<std::int16_t, std::int64_t>(m_at.dim, n); }
  int dataType() const { return get<std::int16_t>(m_at.dataType); }
  int units() const { return static_cast<int>(whole<std::uint8_t, std::int32_t>(m_at.units)); }
  bool hasQform() const { return whole<std::int16_t, std::int32_t>(m_at.qformCode) > 0; }
  bool hasSform() const { return whole<std::int16_t, std::int32_t>(m_at.sformCode) > 0; }
  /// nifti1.h: 1 and 2 are the scanner's space, 3 and more that of a template.
  bool isSformOfTemplate() const
  {
    return whole<std::int16_t, std::int32_t>(m_at.sformCode) > 2 &&
           whole<std::int16_t, std::int32_t>(m_at.qformCode) <= 2;
  }
  double pixdim(std::size_t n) const { return real(m_at.pixdim, n); }
  double slope() const { return real(m_at.slope); }
  double intercept() const { return real(m_at.intercept); }
  double srow(std::size_t n) const { return real(m_at.srow, n); }
  Eigen::Vector3d quaternion() const { return vector(m_at.quaternion); }
  Eigen::Vector3d qoffset() const { return vector(m_at.qoffset); }
  std::string description() const { return text(m_at.description, kDescription); }
  std::string intentName() const { return text(m_at.intentName, kIntentName); }
  double voxels() const
  {
    return m_second ? static_cast<double>(get<std::int64_t>(m_at.voxels)) : real(m_at.voxels);
  }

private:
  template <class T>
  T get(std::size_t offset, std::size_t index = 0) const
  {
    char raw[sizeof(T)];
    std::memcpy(raw, m_bytes.data() + offset + index * sizeof(T), sizeof(T));
    if (m_swapped)
      std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }
  template <class First, class Second>
  std::int64_t whole(std::size_t offset, std::size_t index = 0) const
  {
    return m_second ? std::int64_t{get<Second>(offset, index)}
                    : std::int64_t{get<First>(offset, index)};
  }
  double real(std::size_t offset, std::size_t index = 0) const
  {
    return m_second ? get<double>(offset, index) : double{get<float>(offset, index)};
  }
  std::string text(std::size_t offset, std::size_t size) const
  {
    const std::string all = m_bytes.substr(offset, size);
    return all.substr(0, all.find('\0'));
  }
  Eigen::Vector3d vector(std::size_t offset) const
  {
    return {real(offset, 0), real(offset, 1), real(offset, 2)};
  }

  std::string m_bytes;
  Offsets m_at;
  bool m_second;
  bool m_swapped;
};

/// The header's bytes; those of NIfTI-2 as far as they are there.
std::string headerBytes(const std::filesystem::path& path)
{
  checkedFileSize(path);
  if (readBytes(path, 2) == kGzipStart && !endsWith(lowerName(path), ".gz"))
    fail(FileError::Reason::UnknownFormat, path, "is compressed; name it .nii.gz");
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  std::string bytes(kHeaderBytes2, '\0');
  const int got =
      file ? gzread(file.get(), bytes.data(), static_cast<unsigned>(kHeaderBytes2)) : -1;
  int state = Z_OK;
  if (file && got < 0 && (gzerror(file.get(), &state), state == Z_DATA_ERROR))
    fail(FileError::Reason::Unreadable, path,
         "is damaged: its data are not those of their checksum; copy it again from where it came");
  if (got < static_cast<int>(kHeaderBytes))
    fail(FileError::Reason::Unreadable, path,
         "breaks off in its NIfTI header; copy it again from where it came");
  bytes.resize(static_cast<std::size_t>(got));
  return bytes;
}

Fields checkedFields(const std::filesystem::path& path)
{
  std::string bytes = headerBytes(path);
  std::int32_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  std::int32_t other = size;
  std::reverse(reinterpret_cast<char*>(&other), reinterpret_cast<char*>(&other) + sizeof other);
  const auto isSize = [](std::int32_t n)
  {
    return n == static_cast<std::int32_t>(kHeaderBytes) ||
           n == static_cast<std::int32_t>(kHeaderBytes2);
  };
  const bool swapped = !isSize(size);
  if (swapped && !isSize(other))
    failFormat(path, "NIfTI");
  const bool second = (swapped ? other : size) == static_cast<std::int32_t>(kHeaderBytes2);
  if (second && bytes.size() < kHeaderBytes2)
    fail(FileError::Reason::Unreadable, path,
         "breaks off in its NIfTI header; copy it again from where it came");
  return {std::move(bytes), second, swapped};
}

/// Whether the voxels are in another file. Throws for what is no NIfTI.
bool isPair(const std::filesystem::path& path, const Fields& fields)
{
  using namespace std::string_view_literals;
  const std::string_view magic = fields.magic();
  const bool pairName = endsWith(lowerName(path), ".hdr");
  const bool pair = magic == (fields.isSecond() ? "ni2\0"sv : "ni1\0"sv);
  if (!pair && magic != (fields.isSecond() ? "n+2\0"sv : "n+1\0"sv))
  {
    if (pairName && !fields.isSecond())
      fail(FileError::Reason::Unsupported, path,
           "is an ANALYZE header, which does not say which side of the patient is left; convert "
           "it to NIfTI where that is known");
    failFormat(path, "NIfTI");
  }
  if (pair != pairName)
    fail(FileError::Reason::UnknownFormat, path,
         pair ? "is the header of a pair of files; name them .hdr and .img"
              : "holds header and voxels in one; name it .nii");
  return pair;
}

/// The axes of the qform; nullopt if its quaternion is longer than 1, so not a rotation.
std::optional<Eigen::Matrix3d> qformLinear(const Fields& fields, const Eigen::Vector3d& spacing)
{
  const Eigen::Vector3d v = fields.quaternion();
  if (!(v.squaredNorm() <= kMaxQuaternion))
    return std::nullopt;
  // nifti1.h, METHOD 2: a >= 0 follows from unit length.
  const double rest = 1.0 - v.squaredNorm();
  Eigen::Quaterniond q(std::sqrt(std::max(rest, 0.0)), v[0], v[1], v[2]);
  q.normalize();
  Eigen::Matrix3d linear = q.toRotationMatrix() * spacing.asDiagonal();
  if (fields.pixdim(0) < 0.0)
    linear.col(2) *= -1.0;
  return linear;
}

void readPlacement(const std::filesystem::path& path, const Fields& fields, NiftiHeader& header)
{
  const Eigen::Vector3d spacing =
      Eigen::Vector3d(fields.pixdim(1), fields.pixdim(2), fields.pixdim(3)).cwiseAbs();
  const bool hasQ = fields.hasQform();
  const bool hasS = fields.hasSform();
  if (!hasQ && !hasS)
  {
    header.placement = {spacing.asDiagonal(), Eigen::Vector3d::Zero()};
    header.isSideAssumed = true;
    header.notes.emplace_back("states no place in the patient: its axes are taken as the "
                              "patient's, from 0, 0, 0"); // which way, is settled later
    return;
  }
  const auto qLinear = qformLinear(fields, spacing);
  const Eigen::Vector3d qOrigin = fields.qoffset();
  if (!hasS)
  {
    if (!qLinear)
      fail(FileError::Reason::NoGeometry, path,
           "its header turns it by a quaternion (qform) that is not a rotation; export it again "
           "with "
           "its geometry");
    header.placement = {*qLinear, qOrigin};
    if (std::min({fields.pixdim(1), fields.pixdim(2), fields.pixdim(3)}) < 0.0)
      header.notes.emplace_back("states a negative voxel size (pixdim), which was taken without "
                                "its sign");
    return;
  }
  NiftiPlacement& sform = header.placement;
  for (int row = 0; row < 3; ++row)
  {
    const std::size_t at = static_cast<std::size_t>(row) * 4;
    for (std::size_t column = 0; column < 3; ++column)
      sform.linear(row, static_cast<Eigen::Index>(column)) = fields.srow(at + column);
    sform.origin[row] = fields.srow(at + 3);
  }
  if (!hasQ)
    return;
  if (!qLinear)
  {
    header.notes.emplace_back("places itself twice, once by a quaternion (qform) that is not a "
                              "rotation; the sform is used");
    return;
  }
  double apart = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d index;
    for (int a = 0; a < 3; ++a)
      index[a] = (corner >> a & 1)
                     ? static_cast<double>(header.dims[static_cast<std::size_t>(a)]) - 1
                     : 0.0;
    const double d = ((sform.linear - *qLinear) * index + sform.origin - qOrigin).norm();
    apart = std::max(apart, header.unit.mm * d);
  }
  header.apart = apart;
  header.other = NiftiPlacement{*qLinear, qOrigin};
  header.isSformOfTemplate = fields.isSformOfTemplate();
  if (header.isSformOfTemplate && apart > kPlacementsDiffer)
  {
    std::swap(header.placement, *header.other);
    header.isQform = true;
    return;
  }
  if (sform.linear.determinant() * qLinear->determinant() < 0.0)
    fail(FileError::Reason::NoGeometry, path,
         "places itself twice (sform and qform), and the two are mirror images of each other: left "
         "and right cannot be told; export it again with one of them");
}

LengthUnit unitOf(int code)
{
  switch (code & 7)
  {
  case 1:
    return {1e3, true, "m"};
  case 2:
    return {1.0, true};
  case 3:
    return {1e-3, true, "um"};
  default:
    return {};
  }
}

/// The file of a pair .hdr, .img beside `path`, under one of these endings.
std::filesystem::path otherOfPair(const std::filesystem::path& path,
                                  std::initializer_list<const char*> endings)
{
  std::filesystem::path other = path;
  std::error_code error;
  for (const char* ending : endings)
    if (std::filesystem::is_regular_file(other.replace_extension(ending), error))
      return other;
  fail(FileError::Reason::NotFound, path,
       std::string("is one of a pair of files; its ") + *endings.begin() +
           " is not there, keep both in one folder");
}

} // namespace

NiftiHeader readNiftiHeader(const std::filesystem::path& given)
{
  // Of a pair, either file may be named.
  const std::filesystem::path path =
      endsWith(lowerName(given), ".img") ? otherOfPair(given, {".hdr", ".HDR"}) : given;
  const Fields fields = checkedFields(path);
  NiftiHeader header;
  header.description = fields.description();
  header.intentName = fields.intentName();
  const bool pair = isPair(path, fields);
  header.file = pair ? otherOfPair(path, {".img", ".IMG"}) : path;
  const std::int64_t count = fields.dim(0);
  if (count < 1 || count > 7)
    fail(FileError::Reason::Unreadable, path,
         "its header counts " + std::to_string(count) + " dimensions; a NIfTI file has 1 to 7");
  header.storedDims = static_cast<int>(count);
  for (int d = 1; d <= header.storedDims; ++d)
  {
    const std::int64_t n = fields.dim(static_cast<std::size_t>(d));
    if (n < 1)
      fail(FileError::Reason::Unreadable, path,
           "its header gives a dimension of " + std::to_string(n) +
               "; export it again from where it came");
    header.dims.push_back(static_cast<std::uint64_t>(n));
  }
  while (header.dims.size() > 3 && header.dims.back() == 1)
    header.dims.pop_back();
  if (header.dims.size() < 3)
    fail(FileError::Reason::Unsupported, path,
         "holds a picture of " + std::to_string(header.dims.size()) +
             " dimensions; a volume of 3 is needed");
  header.dataType = fields.dataType();
  header.swapped = fields.swapped();
  header.packed = !pair && readBytes(path, 2) == kGzipStart;
  const double offset = fields.voxels();
  if (!(offset <= kLargestOffset))
    fail(FileError::Reason::Unreadable, path,
         "its voxels should start beyond any sense; export it again from where it came");
  // Some writers store 0 here; the voxels never start within the header.
  const std::size_t least = pair ? 0 : fields.isSecond() ? kDataOffset2 : kDataOffset;
  header.voxelOffset = static_cast<std::uint64_t>(std::max(offset, static_cast<double>(least)));
  header.slope = fields.slope();
  header.intercept = fields.intercept();
  if (!std::isfinite(header.slope) || !std::isfinite(header.intercept))
    fail(FileError::Reason::Unreadable, path,
         "its rescale slope or intercept is not a number; export it again from where it came");
  header.unit = unitOf(fields.units());
  readPlacement(path, fields, header);
  const auto toLps = [&header](NiftiPlacement& placement)
  {
    placement.linear = header.unit.mm * kLpsFromRas.asDiagonal() * placement.linear;
    placement.origin = header.unit.mm * kLpsFromRas.cwiseProduct(placement.origin);
  };
  toLps(header.placement);
  if (header.other)
    toLps(*header.other);
  return header;
}

std::string niftiHeaderBytes(const core::GridGeometry& geometry, int dataType, int bits,
                             const std::string& description, const std::string& intentName)
{
  std::string bytes(kDataOffset, '\0');
  const auto put = [&bytes](std::size_t offset, auto value, std::size_t index = 0)
  { std::memcpy(bytes.data() + offset + index * sizeof value, &value, sizeof value); };
  const auto putFloat = [&put](std::size_t offset, double value, std::size_t index = 0)
  { put(offset, static_cast<float>(value), index); };
  put(0, static_cast<std::int32_t>(kHeaderBytes));
  put(38, 'r'); // "regular", for readers of ANALYZE
  put(kNifti1.dim, std::int16_t{3});
  for (std::size_t a = 0; a < 7; ++a)
    put(kNifti1.dim, static_cast<std::int16_t>(a < 3 ? geometry.dims()[a] : 1), a + 1);
  put(kNifti1.dataType, static_cast<std::int16_t>(dataType));
  put(kNifti1.bits, static_cast<std::int16_t>(bits));
  Eigen::Matrix3d rotation = kLpsFromRas.asDiagonal() * geometry.direction();
  const bool mirrored = rotation.determinant() < 0.0;
  putFloat(kNifti1.pixdim, mirrored ? -1.0 : 1.0);
  for (std::size_t a = 0; a < 7; ++a)
    putFloat(kNifti1.pixdim, a < 3 ? geometry.spacing()[static_cast<Eigen::Index>(a)] : 1.0, a + 1);
  putFloat(kNifti1.voxels, static_cast<double>(kDataOffset));
  putFloat(kNifti1.slope, 1.0);
  put(kNifti1.units, std::uint8_t{2}); // mm
  put(kNifti1.qformCode, std::int16_t{1});
  put(kNifti1.sformCode, std::int16_t{1});
  const Eigen::Matrix3d linear = kLpsFromRas.asDiagonal() * geometry.patientFromVoxelLinear();
  const Eigen::Vector3d origin = kLpsFromRas.cwiseProduct(geometry.origin());
  for (int row = 0; row < 3; ++row)
  {
    const std::size_t at = kNifti1.srow + static_cast<std::size_t>(row) * 16;
    for (std::size_t column = 0; column < 3; ++column)
      putFloat(at, linear(row, static_cast<Eigen::Index>(column)), column);
    putFloat(at, origin[row], 3);
    putFloat(kNifti1.qoffset, origin[row], static_cast<std::size_t>(row));
  }
  if (mirrored)
    rotation.col(2) *= -1.0;
  Eigen::Quaterniond q(rotation);
  q.normalize();
  if (q.w() < 0.0)
    q.coeffs() *= -1.0;
  putFloat(kNifti1.quaternion, q.x(), 0);
  putFloat(kNifti1.quaternion, q.y(), 1);
  putFloat(kNifti1.quaternion, q.z(), 2);
  const auto putText = [&bytes](std::size_t offset, std::size_t size, const std::string& text)
  { bytes.replace(offset, std::min(text.size(), size - 1), text, 0, size - 1); };
  putText(kNifti1.description, kDescription, description);
  putText(kNifti1.intentName, kIntentName, intentName);
  std::memcpy(bytes.data() + kNifti1.magic, "n+1", 4);
  return bytes;
}

} // namespace petrous::imaging
