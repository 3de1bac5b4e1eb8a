#include "petrous/Volume/VolumeBytes.h"

#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include <tbb/parallel_for.h>

#include "LabelOccupancy.h"

namespace petrous::volume
{

namespace
{

// Format of a volume: its grid, then the layers of tiles along the last axis, each as a u64 byte
// count and its tiles. A tile is its kind and the data of that kind.
enum TileKind : std::uint8_t
{
  kZero = 0,
  kUniform = 1, // one value
  kFull = 2     // all values, the first axis fastest
};

struct Malformed
{
};

class Reader
{
public:
  explicit Reader(const Bytes& bytes)
    : Reader(bytes.data(), bytes.data() + bytes.size())
  {
  }
  Reader(const std::uint8_t* from, const std::uint8_t* end)
    : m_at(from)
    , m_end(end)
  {
  }

  const std::uint8_t* take(std::size_t count)
  {
    if (count > static_cast<std::size_t>(m_end - m_at))
      throw Malformed{};
    const std::uint8_t* from = m_at;
    m_at += count;
    return from;
  }
  template <class T>
  T number()
  {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  std::string text()
  {
    const auto length = number<std::uint32_t>();
    const auto* from = reinterpret_cast<const char*>(take(length));
    return {from, length};
  }
  bool done() const noexcept { return m_at == m_end; }

private:
  const std::uint8_t* m_at;
  const std::uint8_t* m_end;
};

void append(Bytes& bytes, const void* from, std::size_t count)
{
  const auto* first = static_cast<const std::uint8_t*>(from);
  bytes.insert(bytes.end(), first, first + count);
}

template <class T>
void append(Bytes& bytes, T number)
{
  static_assert(std::is_arithmetic_v<T>);
  append(bytes, &number, sizeof number);
}

void append(Bytes& bytes, const std::string& text)
{
  append(bytes, static_cast<std::uint32_t>(text.size()));
  append(bytes, text.data(), text.size());
}

void append(Bytes& bytes, const core::GridGeometry& grid)
{
  for (const int n : grid.dims())
    append(bytes, std::int32_t{n});
  for (Eigen::Index a = 0; a < 3; ++a)
    append(bytes, grid.spacing()[a]);
  for (Eigen::Index a = 0; a < 3; ++a)
    append(bytes, grid.origin()[a]);
  for (Eigen::Index n = 0; n < 9; ++n)
    append(bytes, grid.direction()(n % 3, n / 3));
}

core::GridGeometry gridFrom(Reader& reader)
{
  core::Index3 dims;
  for (int& n : dims)
    n = reader.number<std::int32_t>();
  Eigen::Vector3d spacing, origin;
  for (Eigen::Index a = 0; a < 3; ++a)
    spacing[a] = reader.number<double>();
  for (Eigen::Index a = 0; a < 3; ++a)
    origin[a] = reader.number<double>();
  Eigen::Matrix3d direction;
  for (Eigen::Index n = 0; n < 9; ++n)
    direction(n % 3, n / 3) = reader.number<double>();
  constexpr int kMaxDims = 1 << 16;
  for (const int n : dims)
    if (n < 1 || n > kMaxDims)
      throw Malformed{};
  return {dims, spacing, origin, direction};
}

// Encoding of a voxel.
template <class T>
struct Code
{
  using Type = T;
  static T of(T value, std::atomic<bool>&) { return value; }
  static T value(T code) { return code; }
};
template <>
struct Code<float>
{
  using Type = std::uint16_t;
  static std::uint16_t of(float occupancy, std::atomic<bool>& lost)
  {
    constexpr float kMax = std::numeric_limits<std::uint16_t>::max();
    if (!(occupancy >= 0.0F && occupancy <= 1.0F))
    {
      lost = true;
      return 0;
    }
    const auto code = static_cast<std::uint16_t>(occupancy * kMax + 0.5F);
    if (value(code) != occupancy)
      lost = true;
    return code;
  }
  static float value(std::uint16_t code) { return quantizedOccupancy(code / 65535.0); }
};

template <class T>
void appendTile(Bytes& bytes, const Volume<T>& volume, const core::IndexBox& tile,
                std::atomic<bool>& lost)
{
  using Type = typename Code<T>::Type;
  const core::Index3 size = tile.size();
  const T first = volume.at(tile.lower[0], tile.lower[1], tile.lower[2]);
  bool uniform = true;
  for (int k = tile.lower[2]; k < tile.upper[2] && uniform; ++k)
    for (int j = tile.lower[1]; j < tile.upper[1] && uniform; ++j)
    {
      const T* row = &volume.at(tile.lower[0], j, k);
      for (int i = 0; i < size[0]; ++i)
        uniform &= row[i] == first; // not &&: the loop is vectorized
    }
  if (uniform)
  {
    const Type code = Code<T>::of(first, lost);
    append(bytes, static_cast<std::uint8_t>(code == 0 ? kZero : kUniform));
    if (code != 0)
      append(bytes, code);
    return;
  }
  append(bytes, static_cast<std::uint8_t>(kFull));
  std::size_t at = bytes.size();
  bytes.resize(at + tile.count() * sizeof(Type));
  for (int k = tile.lower[2]; k < tile.upper[2]; ++k)
    for (int j = tile.lower[1]; j < tile.upper[1]; ++j)
    {
      const T* row = &volume.at(tile.lower[0], j, k);
      for (int i = 0; i < size[0]; ++i, at += sizeof(Type))
      {
        const Type code = Code<T>::of(row[i], lost);
        std::memcpy(&bytes[at], &code, sizeof code);
      }
    }
}

template <class T>
void readTile(Reader& reader, Volume<T>& volume, const core::IndexBox& tile)
{
  using Type = typename Code<T>::Type;
  const core::Index3 size = tile.size();
  const auto kind = reader.number<std::uint8_t>();
  if (kind == kZero)
    return;
  if (kind != kUniform && kind != kFull)
    throw Malformed{};
  const T all = kind == kUniform ? Code<T>::value(reader.number<Type>()) : T{};
  const std::uint8_t* from = kind == kFull ? reader.take(tile.count() * sizeof(Type)) : nullptr;
  for (int k = tile.lower[2]; k < tile.upper[2]; ++k)
    for (int j = tile.lower[1]; j < tile.upper[1]; ++j)
    {
      T* row = &volume.at(tile.lower[0], j, k);
      for (int i = 0; i < size[0]; ++i)
      {
        row[i] = all;
        if (!from)
          continue;
        Type code;
        std::memcpy(&code, from, sizeof code);
        from += sizeof code;
        row[i] = Code<T>::value(code);
      }
    }
}

// Voxels outside `extent` are 0. Returns false if a voxel cannot be encoded losslessly.
template <class T>
bool append(Bytes& bytes, const Volume<T>& volume, const core::IndexBox& extent)
{
  append(bytes, volume.geometry());
  const LabelTiles tiles(volume.geometry().dims());
  const core::Index3& n = tiles.dims();
  std::vector<Bytes> layers(static_cast<std::size_t>(n[2]));
  std::atomic<bool> lost{false};
  tbb::parallel_for(0, n[2],
                    [&](int k)
                    {
                      Bytes& layer = layers[static_cast<std::size_t>(k)];
                      for (int j = 0; j < n[1]; ++j)
                        for (int i = 0; i < n[0]; ++i)
                        {
                          const core::IndexBox tile = tiles.voxelsOf(i, j, k);
                          if (tile.intersected(extent).empty())
                            append(layer, static_cast<std::uint8_t>(kZero));
                          else
                            appendTile(layer, volume, tile, lost);
                        }
                    });
  for (const Bytes& layer : layers)
    append(bytes, static_cast<std::uint64_t>(layer.size()));
  for (const Bytes& layer : layers)
    append(bytes, layer.data(), layer.size());
  return !lost;
}

template <class T>
bool append(Bytes& bytes, const Volume<T>& volume)
{
  return append(bytes, volume, volume.geometry().fullBox());
}

template <class T>
std::shared_ptr<Volume<T>> volumeFrom(Reader& reader)
{
  auto volume = makeZeroVolume<T>(gridFrom(reader));
  const LabelTiles tiles(volume->geometry().dims());
  const core::Index3& n = tiles.dims();
  std::vector<std::uint64_t> sizes;
  for (int k = 0; k < n[2]; ++k)
    sizes.push_back(reader.number<std::uint64_t>());
  std::vector<const std::uint8_t*> layers;
  for (const std::uint64_t size : sizes)
    layers.push_back(reader.take(size));
  std::atomic<bool> malformed{false};
  tbb::parallel_for(0, n[2],
                    [&](int k)
                    {
                      const auto layer = static_cast<std::size_t>(k);
                      try
                      {
                        Reader own(layers[layer], layers[layer] + sizes[layer]);
                        for (int j = 0; j < n[1]; ++j)
                          for (int i = 0; i < n[0]; ++i)
                            readTile(own, *volume, tiles.voxelsOf(i, j, k));
                        if (!own.done())
                          malformed = true;
                      }
                      catch (const Malformed&)
                      {
                        malformed = true;
                      }
                    });
  if (malformed)
    throw Malformed{};
  return volume;
}

template <class T, class Make>
std::shared_ptr<T> from(const Bytes& bytes, const Make& make)
{
  try
  {
    Reader reader(bytes);
    std::shared_ptr<T> result = make(reader);
    return reader.done() ? result : nullptr;
  }
  catch (const Malformed&)
  {
    return nullptr;
  }
  catch (const core::InvalidParameter&) // invalid grid
  {
    return nullptr;
  }
}

} // namespace

std::optional<Bytes> bytesOf(const Volume<float>& occupancy)
{
  Bytes bytes;
  if (!append(bytes, occupancy))
    return std::nullopt;
  return bytes;
}

std::shared_ptr<Volume<float>> occupancyFrom(const Bytes& bytes)
{
  return from<Volume<float>>(bytes, [](Reader& reader) { return volumeFrom<float>(reader); });
}

std::optional<Bytes> bytesOf(const LabelField& field)
{
  Bytes bytes;
  append(bytes, static_cast<std::uint8_t>((field.hasSolid ? 1 : 0) | (field.hasLumen ? 2 : 0) |
                                          (field.borders ? 4 : 0)));
  append(bytes, static_cast<std::uint32_t>(field.notes.size()));
  for (const std::string& note : field.notes)
    append(bytes, note);
  if (!append(bytes, *field.occupancy))
    return std::nullopt;
  append(bytes, *field.index);
  if (field.borders)
    append(bytes, *field.borders);
  return bytes;
}

std::shared_ptr<LabelField> labelFieldFrom(const Bytes& bytes)
{
  return from<LabelField>(bytes,
                          [](Reader& reader)
                          {
                            auto field = std::make_shared<LabelField>();
                            const auto has = reader.number<std::uint8_t>();
                            field->hasSolid = (has & 1) != 0;
                            field->hasLumen = (has & 2) != 0;
                            const auto notes = reader.number<std::uint32_t>();
                            for (std::uint32_t n = 0; n < notes; ++n)
                              field->notes.push_back(reader.text());
                            field->occupancy = volumeFrom<float>(reader);
                            field->index = volumeFrom<std::uint8_t>(reader);
                            if ((has & 4) != 0)
                              field->borders = volumeFrom<std::uint8_t>(reader);
                            return field;
                          });
}

Bytes bytesOf(const LabelMap& labels)
{
  Bytes bytes;
  append(bytes, static_cast<std::uint32_t>(labels.segments.size()));
  for (const Segment& segment : labels.segments)
  {
    append(bytes, segment.name);
    append(bytes, segment.index);
    for (const float component : segment.color)
      append(bytes, component);
    append(bytes, segment.voxels);
  }
  const core::IndexBox extent = extentOf(labels);
  append(bytes, static_cast<std::uint8_t>(labels.extent ? 1 : 0));
  for (const core::Index3& end : {extent.lower, extent.upper})
    for (const int n : end)
      append(bytes, std::int32_t{n});
  append(bytes, *labels.voxels, extent);
  return bytes;
}

std::shared_ptr<LabelMap> labelMapFrom(const Bytes& bytes)
{
  return from<LabelMap>(bytes,
                        [](Reader& reader)
                        {
                          auto labels = std::make_shared<LabelMap>();
                          const auto segments = reader.number<std::uint32_t>();
                          for (std::uint32_t n = 0; n < segments; ++n)
                          {
                            Segment segment;
                            segment.name = reader.text();
                            segment.index = reader.number<std::uint16_t>();
                            for (float& component : segment.color)
                              component = reader.number<float>();
                            segment.voxels = reader.number<std::uint64_t>();
                            labels->segments.push_back(std::move(segment));
                          }
                          const bool known = reader.number<std::uint8_t>() != 0;
                          core::IndexBox extent;
                          for (core::Index3* end : {&extent.lower, &extent.upper})
                            for (int& n : *end)
                              n = reader.number<std::int32_t>();
                          labels->voxels = volumeFrom<std::uint16_t>(reader);
                          if (!(extent.intersected(labels->voxels->geometry().fullBox()) == extent))
                            throw Malformed{};
                          if (known)
                            labels->extent = extent;
                          return labels;
                        });
}

} // namespace petrous::volume
