#include "NiftiHeader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <itk_zlib.h>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{

constexpr std::size_t kHeaderBytes = 348;
constexpr std::size_t kDataOffset = 352;
constexpr double kLargestOffset = 1e9;
constexpr const char* kGzipStart = "\x1f\x8b";
constexpr double kMaxQuaternion = 1.001;  // squared norm; float32 and few digits round by less
constexpr double kPlacementsDiffer = 0.1; // mm between sform and qform; noted if exceeded
// NIfTI uses right, anterior, superior; the patient frame is left, posterior, superior.
const Eigen::Vector3d kLpsFromRas(-1.0, -1.0, 1.0);

// Byte offsets of the fields (nifti1.h).
enum Offset : std::size_t
{
  kSizeOfHeader = 0,
  kDim = 40,
  kDataType = 70,
  kBits = 72,
  kPixdim = 76,
  kVoxOffset = 108,
  kSlope = 112,
  kIntercept = 116,
  kUnits = 123,
  kQformCode = 252,
  kSformCode = 254,
  kQuaternion = 256,
  kQoffset = 268,
  kSrow = 280,
  kMagic = 344
};

class Fields
{
public:
  explicit Fields(std::string bytes, bool swapped)
    : m_bytes(std::move(bytes))
    , m_swapped(swapped)
  {
  }

  bool swapped() const noexcept { return m_swapped; }

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

private:
  std::string m_bytes;
  bool m_swapped;
};

std::string headerBytes(const std::filesystem::path& path)
{
  checkedFileSize(path);
  if (readBytes(path, 2) == kGzipStart && !endsWith(lowerName(path), ".gz"))
    fail(FileError::Reason::UnknownFormat, path, "is compressed; name it .nii.gz");
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  std::string bytes(kHeaderBytes, '\0');
  if (!file || gzread(file.get(), bytes.data(), static_cast<unsigned>(kHeaderBytes)) !=
                   static_cast<int>(kHeaderBytes))
    fail(FileError::Reason::Unreadable, path,
         "breaks off in its NIfTI header; copy it again from where it came");
  return bytes;
}

Fields checkedFields(const std::filesystem::path& path)
{
  const std::string bytes = headerBytes(path);
  std::int32_t size = 0;
  std::memcpy(&size, bytes.data() + kSizeOfHeader, sizeof size);
  const bool swapped = size != static_cast<std::int32_t>(kHeaderBytes);
  const Fields fields(bytes, swapped);
  size = fields.get<std::int32_t>(kSizeOfHeader);
  if (size == 540 || Fields(bytes, false).get<std::int32_t>(kSizeOfHeader) == 540)
    fail(FileError::Reason::Unsupported, path,
         "is written as NIfTI-2; this program reads NIfTI-1, so convert it");
  if (size != static_cast<std::int32_t>(kHeaderBytes) ||
      std::memcmp(bytes.data() + kMagic, "n+1\0", 4) != 0)
    failFormat(path, "one-part NIfTI-1");
  return fields;
}

/// The axes of the qform; nullopt if its quaternion is longer than 1, so not a rotation.
std::optional<Eigen::Matrix3d> qformLinear(const Fields& fields, const Eigen::Vector3d& spacing)
{
  const Eigen::Vector3d v(fields.get<float>(kQuaternion, 0), fields.get<float>(kQuaternion, 1),
                          fields.get<float>(kQuaternion, 2));
  if (!(v.squaredNorm() <= kMaxQuaternion))
    return std::nullopt;
  // nifti1.h, METHOD 2: a >= 0 follows from unit length.
  const double rest = 1.0 - v.squaredNorm();
  Eigen::Quaterniond q(std::sqrt(std::max(rest, 0.0)), v[0], v[1], v[2]);
  q.normalize();
  Eigen::Matrix3d linear = q.toRotationMatrix() * spacing.asDiagonal();
  if (fields.get<float>(kPixdim, 0) < 0.0F)
    linear.col(2) *= -1.0;
  return linear;
}

Eigen::Vector3d vectorOf(const Fields& fields, std::size_t offset)
{
  return {fields.get<float>(offset, 0), fields.get<float>(offset, 1), fields.get<float>(offset, 2)};
}

void readPlacement(const std::filesystem::path& path, const Fields& fields, NiftiHeader& header)
{
  const Eigen::Vector3d spacing =
      Eigen::Vector3d(fields.get<float>(kPixdim, 1), fields.get<float>(kPixdim, 2),
                      fields.get<float>(kPixdim, 3))
          .cwiseAbs();
  const bool hasQ = fields.get<std::int16_t>(kQformCode) > 0;
  const bool hasS = fields.get<std::int16_t>(kSformCode) > 0;
  if (!hasQ && !hasS)
  {
    header.linear = spacing.asDiagonal();
    header.origin.setZero();
    header.notes.emplace_back("states no place in the patient: its axes are taken as to the "
                              "right, front and top of the patient, from 0, 0, 0");
    return;
  }
  const auto qLinear = qformLinear(fields, spacing);
  const Eigen::Vector3d qOrigin = vectorOf(fields, kQoffset);
  if (!hasS)
  {
    if (!qLinear)
      fail(FileError::Reason::NoGeometry, path,
           "its header turns it by a quaternion (qform) that is not a rotation; export it again "
           "with "
           "its geometry");
    header.linear = *qLinear;
    header.origin = qOrigin;
    return;
  }
  for (int row = 0; row < 3; ++row)
  {
    const std::size_t at = kSrow + static_cast<std::size_t>(row) * 16;
    for (std::size_t column = 0; column < 3; ++column)
      header.linear(row, static_cast<Eigen::Index>(column)) = fields.get<float>(at, column);
    header.origin[row] = fields.get<float>(at, 3);
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
    const double d = ((header.linear - *qLinear) * index + header.origin - qOrigin).norm();
    apart = std::max(apart, d);
  }
  if (apart > kPlacementsDiffer)
    header.notes.push_back("places itself twice (sform and qform), up to " + roughText(apart) +
                           " mm apart; the sform is used, as the NIfTI standard says");
}

double unitInMillimetres(int code, std::vector<std::string>& notes)
{
  switch (code & 7)
  {
  case 1:
    notes.emplace_back("counts in metres, turned into mm");
    return 1e3;
  case 2:
    return 1.0;
  case 3:
    notes.emplace_back("counts in micrometres, turned into mm");
    return 1e-3;
  default:
    notes.emplace_back("states no unit of length; taken as mm");
    return 1.0;
  }
}

} // namespace

NiftiHeader readNiftiHeader(const std::filesystem::path& path)
{
  const Fields fields = checkedFields(path);
  NiftiHeader header;
  header.storedDims = fields.get<std::int16_t>(kDim);
  if (header.storedDims < 1 || header.storedDims > 7)
    fail(FileError::Reason::Unreadable, path,
         "its header counts " + std::to_string(header.storedDims) +
             " dimensions; a NIfTI file has 1 to 7");
  for (int d = 1; d <= header.storedDims; ++d)
  {
    const auto n = fields.get<std::int16_t>(kDim, static_cast<std::size_t>(d));
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
  header.dataType = fields.get<std::int16_t>(kDataType);
  header.swapped = fields.swapped();
  header.packed = readBytes(path, 2) == kGzipStart;
  const double offset = fields.get<float>(kVoxOffset);
  if (!(offset <= kLargestOffset))
    fail(FileError::Reason::Unreadable, path,
         "its voxels should start beyond any sense; export it again from where it came");
  // Some writers store 0 here; the voxels never start within the header.
  header.voxelOffset = static_cast<std::uint64_t>(std::max(offset, double{kDataOffset}));
  header.slope = fields.get<float>(kSlope);
  header.intercept = fields.get<float>(kIntercept);
  if (!std::isfinite(header.slope) || !std::isfinite(header.intercept))
    fail(FileError::Reason::Unreadable, path,
         "its rescale slope or intercept is not a number; export it again from where it came");
  readPlacement(path, fields, header);
  const double unit = unitInMillimetres(fields.get<std::uint8_t>(kUnits), header.notes);
  header.linear = unit * kLpsFromRas.asDiagonal() * header.linear;
  header.origin = unit * kLpsFromRas.cwiseProduct(header.origin);
  return header;
}

std::string niftiHeaderBytes(const core::GridGeometry& geometry, int dataType, int bits)
{
  std::string bytes(kDataOffset, '\0');
  const auto put = [&bytes](std::size_t offset, auto value, std::size_t index = 0)
  { std::memcpy(bytes.data() + offset + index * sizeof value, &value, sizeof value); };
  const auto putFloat = [&put](std::size_t offset, double value, std::size_t index = 0)
  { put(offset, static_cast<float>(value), index); };
  put(kSizeOfHeader, static_cast<std::int32_t>(kHeaderBytes));
  put(38, 'r'); // "regular", for readers of ANALYZE
  put(kDim, std::int16_t{3});
  for (std::size_t a = 0; a < 7; ++a)
    put(kDim, static_cast<std::int16_t>(a < 3 ? geometry.dims()[a] : 1), a + 1);
  put(kDataType, static_cast<std::int16_t>(dataType));
  put(kBits, static_cast<std::int16_t>(bits));
  Eigen::Matrix3d rotation = kLpsFromRas.asDiagonal() * geometry.direction();
  const bool mirrored = rotation.determinant() < 0.0;
  putFloat(kPixdim, mirrored ? -1.0 : 1.0);
  for (std::size_t a = 0; a < 7; ++a)
    putFloat(kPixdim, a < 3 ? geometry.spacing()[static_cast<Eigen::Index>(a)] : 1.0, a + 1);
  putFloat(kVoxOffset, static_cast<double>(kDataOffset));
  putFloat(kSlope, 1.0);
  put(kUnits, std::uint8_t{2}); // mm
  put(kQformCode, std::int16_t{1});
  put(kSformCode, std::int16_t{1});
  const Eigen::Matrix3d linear = kLpsFromRas.asDiagonal() * geometry.patientFromVoxelLinear();
  const Eigen::Vector3d origin = kLpsFromRas.cwiseProduct(geometry.origin());
  for (int row = 0; row < 3; ++row)
  {
    const std::size_t at = kSrow + static_cast<std::size_t>(row) * 16;
    for (std::size_t column = 0; column < 3; ++column)
      putFloat(at, linear(row, static_cast<Eigen::Index>(column)), column);
    putFloat(at, origin[row], 3);
    putFloat(kQoffset, origin[row], static_cast<std::size_t>(row));
  }
  if (mirrored)
    rotation.col(2) *= -1.0;
  Eigen::Quaterniond q(rotation);
  q.normalize();
  if (q.w() < 0.0)
    q.coeffs() *= -1.0;
  putFloat(kQuaternion, q.x(), 0);
  putFloat(kQuaternion, q.y(), 1);
  putFloat(kQuaternion, q.z(), 2);
  std::memcpy(bytes.data() + kMagic, "n+1", 4);
  return bytes;
}

} // namespace petrous::imaging
