#include "TissueBricks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "petrous/Haptics/HapticField.h"
#include "petrous/Volume/ChebyshevDistance.h"

namespace petrous::haptics
{

namespace
{

// What a brick may contain.
constexpr std::uint8_t kTissue = 1;
constexpr std::uint8_t kSome = 2; // a value above 0
constexpr int kSlab = 8;          // brick layers per task
constexpr std::size_t kRun = 512; // bricks combined at once

// Steepness codes.
constexpr int kPerOctave = 16;
constexpr int kFirst = -6 * kPerOctave; // exponent of code 0, extrapolated
constexpr int kLast = 254;

// A voxel that is NaN is not tissue; f is discontinuous beside it.
constexpr float kJump = std::numeric_limits<float>::infinity();

// The lowest code of a float with these leading bits.
constexpr int kLeadingShift = 17; // 6 bits of the mantissa remain

std::vector<std::uint8_t> lowestCodes()
{
  const auto& table = TissueBricks::steepnessOf();
  std::vector<std::uint8_t> codes(std::size_t{1} << (31 - kLeadingShift));
  int code = 1;
  for (std::size_t leading = 0; leading < codes.size(); ++leading)
  {
    const auto bits = static_cast<std::uint32_t>(leading << kLeadingShift);
    float least;
    std::memcpy(&least, &bits, sizeof least);
    while (code < kLast && table[static_cast<std::size_t>(code)] < least)
      ++code;
    codes[leading] = static_cast<std::uint8_t>(code);
  }
  return codes;
}

std::uint8_t codeOf(float steepness)
{
  static const std::vector<std::uint8_t> lowest = lowestCodes();
  if (!(steepness > 0.0F))
    return 0;
  const auto& table = TissueBricks::steepnessOf();
  if (!(steepness <= table[kLast]))
    return 255;
  std::uint32_t bits;
  std::memcpy(&bits, &steepness, sizeof bits);
  int code = lowest[bits >> kLeadingShift];
  while (code < kLast && table[static_cast<std::size_t>(code)] < steepness)
    ++code;
  return static_cast<std::uint8_t>(code);
}

// Bricks of two voxels.
struct VolumeBricks
{
  core::Index3 dims;
  std::vector<std::uint8_t> marks;     // from the voxels at the brick's corners and inside
  std::vector<std::uint8_t> steepness; // codes, of the brick and one voxel around it
};

// Contribution of one slice of voxels to the columns of bricks: the maximum of the voxels
// 2b to 2b + 2, and the maximum step to the next voxel along each axis, over the edges of the cells
// 2b - 1 to 2b + 2.
class SliceLook
{
public:
  explicit SliceLook(const core::Index3& dims)
    : m_dims(dims)
    , m_bricks{(dims[0] + 1) / 2, (dims[1] + 1) / 2, (dims[2] + 1) / 2}
  {
    const auto row = static_cast<std::size_t>(m_bricks[0]);
    for (std::vector<float>& rows : m_rows)
      rows.resize(row * static_cast<std::size_t>(dims[1]));
    constexpr float kNone = -std::numeric_limits<float>::infinity();
    m_line.resize(kPad + static_cast<std::size_t>(dims[0]) + kPad, kNone);
    m_most.resize(static_cast<std::size_t>(dims[0]));
  }

  static constexpr std::size_t kFields = 4; // the maximum, then the steps

  // into[f]: bricks of a layer, first axis fastest.
  template <class T>
  void look(const volume::Volume<T>& volume, int k, std::array<std::vector<float>, kFields>& into)
  {
    const auto width = static_cast<std::size_t>(m_dims[0]);
    const std::size_t slice = width * static_cast<std::size_t>(m_dims[1]);
    const T* voxels = volume.data() + slice * static_cast<std::size_t>(k);
    float* line = m_line.data() + kPad;
    for (int j = 0; j < m_dims[1]; ++j)
    {
      const T* row = voxels + width * static_cast<std::size_t>(j);
      const auto out = static_cast<std::size_t>(m_bricks[0]) * static_cast<std::size_t>(j);
      if (isFlat(row, j + 1 < m_dims[1] ? row + width : row, k + 1 < m_dims[2] ? row + slice : row))
      {
        for (std::size_t f = 0; f < kFields; ++f)
          std::fill_n(m_rows[f].begin() + static_cast<std::ptrdiff_t>(out), m_bricks[0],
                      f == 0 ? static_cast<float>(row[0]) : 0.0F);
        continue;
      }
      for (std::size_t i = 0; i < width; ++i)
        line[i] = static_cast<float>(row[i]);
      reduceLine(kValues, m_rows[0].data() + out);
      const auto steps = [&](std::size_t field, const T* other, std::size_t count)
      {
        for (std::size_t i = 0; i < count; ++i)
        {
          const float step = std::abs(static_cast<float>(other[i]) - static_cast<float>(row[i]));
          line[i] = step <= std::numeric_limits<float>::max() ? step : kJump; // also for NaN
        }
        std::fill(line + count, line + width, 0.0F);
        reduceLine(field == 1 ? kAlong : kAcross, m_rows[field].data() + out);
      };
      steps(1, row + 1, width - 1);
      steps(2, row + width, j + 1 < m_dims[1] ? width : 0);
      steps(3, row + slice, k + 1 < m_dims[2] ? width : 0);
    }
    const auto stride = static_cast<std::size_t>(m_bricks[0]);
    for (std::size_t f = 0; f < kFields; ++f)
    {
      into[f].resize(stride * static_cast<std::size_t>(m_bricks[1]));
      const Range range = f == 0 ? kValues : f == 2 ? kAlong : kAcross;
      for (int b = 0; b < m_bricks[1]; ++b)
      {
        float* most = into[f].data() + stride * static_cast<std::size_t>(b);
        std::fill(most, most + stride, -std::numeric_limits<float>::infinity());
        for (int j = std::max(2 * b + range.before, 0);
             j <= std::min(2 * b + range.after, m_dims[1] - 1); ++j)
          raise(most, m_rows[f].data() + stride * static_cast<std::size_t>(j), stride);
      }
    }
  }

  /// Element-wise maximum; NaN is ignored.
  static void raise(float* __restrict most, const float* values, std::size_t count)
  {
    for (std::size_t n = 0; n < count; ++n)
      most[n] = values[n] > most[n] ? values[n] : most[n];
  }

private:
  // Range of values that brick 2b needs.
  struct Range
  {
    int before, after;
  };
  static constexpr Range kValues{0, 2}, kAlong{-1, 2}, kAcross{-1, 3};
  static constexpr std::size_t kPad = 4; // padding at both ends of the line, ignored by the maximum

  // Whether a row and its neighbours have one value, as most of a union has; false for NaN.
  template <class T>
  bool isFlat(const T* row, const T* next, const T* above) const
  {
    const auto bytes = static_cast<std::size_t>(m_dims[0]) * sizeof(T);
    return row[0] == row[0] && std::memcmp(row, row + 1, bytes - sizeof(T)) == 0 &&
           std::memcmp(row, next, bytes) == 0 && std::memcmp(row, above, bytes) == 0;
  }

  // Maximum over each brick's range in the line.
  void reduceLine(Range range, float* out)
  {
    std::fill(m_most.begin(), m_most.end(), -std::numeric_limits<float>::infinity());
    for (int n = range.before; n <= range.after; ++n)
      raise(m_most.data(), m_line.data() + kPad + n, m_most.size());
    for (std::size_t b = 0; b < static_cast<std::size_t>(m_bricks[0]); ++b)
      out[b] = m_most[2 * b];
  }

  core::Index3 m_dims;
  core::Index3 m_bricks;
  std::array<std::vector<float>, kFields> m_rows;
  std::vector<float> m_line;
  std::vector<float> m_most;
};

// Tissue is above `level`; `scale` is the value of one unit of f.
template <class T>
VolumeBricks bricksOf(const volume::Volume<T>& volume, float level, float scale)
{
  using Layer = std::array<std::vector<float>, SliceLook::kFields>;
  const core::GridGeometry& grid = volume.geometry();
  const core::Index3& dims = grid.dims();
  VolumeBricks result;
  for (std::size_t a = 0; a < 3; ++a)
    result.dims[a] = (dims[a] + 1) / 2;
  const auto layer =
      static_cast<std::size_t>(result.dims[0]) * static_cast<std::size_t>(result.dims[1]);
  result.marks.resize(layer * static_cast<std::size_t>(result.dims[2]));
  result.steepness.resize(result.marks.size());
  const Eigen::Array3f perMm = grid.spacing().cwiseInverse().cast<float>().array() / scale;
  const auto slab = [&](int from, int to)
  {
    SliceLook looker(dims);
    std::array<Layer, 5> slices; // of voxels, by index modulo 5
    int next = std::max(2 * from - 1, 0);
    for (int bk = from; bk < to; ++bk)
    {
      const int last = std::min(2 * bk + 3, dims[2] - 1);
      for (; next <= last; ++next)
        looker.look(volume, next, slices[static_cast<std::size_t>(next % 5)]);
      for (std::size_t first = 0; first < layer; first += kRun)
      {
        const std::size_t count = std::min(kRun, layer - first);
        std::array<float, kRun> most;
        most.fill(-std::numeric_limits<float>::infinity());
        std::array<std::array<float, kRun>, 3> step{};
        for (int k = std::max(2 * bk - 1, 0); k <= last; ++k)
        {
          const Layer& slice = slices[static_cast<std::size_t>(k % 5)];
          if (k >= 2 * bk && k <= 2 * bk + 2)
            SliceLook::raise(most.data(), slice[0].data() + first, count);
          for (std::size_t a = 0; a < 3; ++a)
            if (a < 2 || k < 2 * bk + 3)
              SliceLook::raise(step[a].data(), slice[a + 1].data() + first, count);
        }
        for (std::size_t n = 0; n < count; ++n)
        {
          const std::size_t brick = layer * static_cast<std::size_t>(bk) + first + n;
          result.marks[brick] = static_cast<std::uint8_t>((most[n] > level ? kTissue : 0) |
                                                          (most[n] > 0.0F ? kSome : 0));
          // Along each axis, the gradient of a trilinear cell is a mean of the steps of four edges.
          const Eigen::Array3f steepest(step[0][n], step[1][n], step[2][n]);
          result.steepness[brick] = codeOf((steepest * perMm).matrix().norm());
        }
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, (result.dims[2] + kSlab - 1) / kSlab),
                    [&](const tbb::blocked_range<int>& slabs)
                    {
                      for (int s = slabs.begin(); s != slabs.end(); ++s)
                        slab(kSlab * s, std::min(kSlab * (s + 1), result.dims[2]));
                    });
  return result;
}

// Marks the CT's bricks that a union reaches, where its occupancy is above 0.
void addUnion(const volume::Volume<float>& occupancy, const core::GridGeometry& ct,
              VolumeBricks& bricks, std::vector<std::uint8_t>& here)
{
  const VolumeBricks own = bricksOf(occupancy, 0.5F, 1.0F);
  const Eigen::Matrix3d linear =
      ct.voxelFromPatientLinear() * occupancy.geometry().patientFromVoxelLinear();
  const Eigen::Vector3d offset = ct.voxelFromPatient(occupancy.geometry().origin());
  // Half a brick plus the voxel around it, in voxels of the CT.
  const Eigen::Array3d half = (linear.cwiseAbs() * Eigen::Vector3d::Ones()).array() + 1.0;
  std::size_t n = 0;
  for (int k = 0; k < own.dims[2]; ++k)
    for (int j = 0; j < own.dims[1]; ++j)
      for (int i = 0; i < own.dims[0]; ++i, ++n)
      {
        if (!(own.marks[n] & kSome))
          continue;
        const Eigen::Array3d middle =
            linear * Eigen::Vector3d(2.0 * i + 1.0, 2.0 * j + 1.0, 2.0 * k + 1.0) + offset;
        const Eigen::Array3i lower = ((middle - half) / kTissueBrick).floor().cast<int>().max(0);
        const Eigen::Array3i upper =
            ((middle + half) / kTissueBrick)
                .floor()
                .cast<int>()
                .min(Eigen::Array3i(bricks.dims[0], bricks.dims[1], bricks.dims[2]) - 1);
        for (int z = lower[2]; z <= upper[2]; ++z)
          for (int y = lower[1]; y <= upper[1]; ++y)
            for (int x = lower[0]; x <= upper[0]; ++x)
            {
              const auto row = static_cast<std::size_t>(bricks.dims[0]);
              const std::size_t at =
                  static_cast<std::size_t>(x) +
                  row * (static_cast<std::size_t>(y) +
                         static_cast<std::size_t>(bricks.dims[1]) * static_cast<std::size_t>(z));
              bricks.steepness[at] = std::max(bricks.steepness[at], own.steepness[n]);
              if (own.marks[n] & kTissue)
                bricks.marks[at] = kTissue;
              here[at] = TissueBricks::kUnionHere;
            }
      }
}

} // namespace

const std::array<float, 256>& TissueBricks::steepnessOf() noexcept
{
  static const std::array<float, 256> table = []
  {
    std::array<float, 256> values{};
    for (int code = 1; code <= kLast; ++code)
      values[static_cast<std::size_t>(code)] =
          std::exp2(static_cast<float>(kFirst + code) / kPerOctave);
    values[255] = std::numeric_limits<float>::infinity();
    return values;
  }();
  return table;
}

TissueBricks findTissueBricks(const volume::TissueField& tissue)
{
  const auto iso = static_cast<float>(tissue.parameters().iso);
  const auto scale = static_cast<float>(tissue.parameters().scale);
  VolumeBricks bricks =
      tissue.ct()->visit([&](const auto& voxels) { return bricksOf(voxels, iso, scale); });
  TissueBricks result;
  result.dims = bricks.dims;
  result.distance.resize(bricks.marks.size());
  for (const auto& occupancy : tissue.solids())
    addUnion(*occupancy, tissue.geometry(), bricks, result.distance);
  result.steepness = std::move(bricks.steepness);
  const core::IndexBox all{{0, 0, 0}, result.dims};
  const volume::DistanceBlock distances = volume::chebyshevDistances(
      bricks.marks.data(), 1, kTissue, result.dims, all, TissueBricks::kMaxDistance);
  auto brick = result.distance.begin();
  for (int k = 0; k < result.dims[2]; ++k)
    for (int j = 0; j < result.dims[1]; ++j)
    {
      const std::uint8_t* row = distances.row(j, k);
      for (int i = 0; i < result.dims[0]; ++i)
        *brick++ |= row[i];
    }
  return result;
}

TissueBricks keptBricks(const volume::TissueField& tissue, const KeptField& kept)
{
  if (!kept.store)
    return findTissueBricks(tissue);
  const std::string key = "tissue bricks " + std::to_string(kTissueBricksVersion) + " " + kept.key;
  TissueBricks bricks;
  for (std::size_t a = 0; a < 3; ++a)
    bricks.dims[a] = (tissue.geometry().dims()[a] + kTissueBrick - 1) / kTissueBrick;
  const auto count = static_cast<std::ptrdiff_t>(core::IndexBox{{0, 0, 0}, bricks.dims}.count());
  auto bytes = kept.store->find(key);
  if (bytes && bytes->size() == 2 * static_cast<std::size_t>(count))
  {
    bricks.steepness.assign(bytes->begin() + count, bytes->end());
    bytes->resize(static_cast<std::size_t>(count));
    bricks.distance = std::move(*bytes);
    return bricks;
  }
  bricks = findTissueBricks(tissue);
  core::DerivedStore::Bytes both(bricks.distance);
  both.insert(both.end(), bricks.steepness.begin(), bricks.steepness.end());
  kept.store->put(key, both);
  return bricks;
}

} // namespace petrous::haptics
