#include "petrous/Volume/ChebyshevDistance.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace petrous::volume
{

namespace
{

constexpr std::size_t kRegister = 16;

struct Line
{
  const std::uint8_t* first; // start of the whole grid's line along the first axis
  std::size_t stride;
  std::uint8_t bit;

  bool marked(int i) const noexcept { return (first[static_cast<std::size_t>(i) * stride] & bit); }
};

// Distances along a line of `count` cells, for its cells [lower, upper).
void alongLine(const Line& line, int count, int lower, int upper, int cap, std::uint8_t* out)
{
  int away = cap;
  for (int i = std::max(lower - cap, 0); i < upper; ++i)
  {
    away = line.marked(i) ? 0 : std::min(away + 1, cap);
    if (i >= lower)
      out[i - lower] = static_cast<std::uint8_t>(away);
  }
  away = cap;
  for (int i = std::min(upper + cap, count) - 1; i >= lower; --i)
  {
    away = line.marked(i) ? 0 : std::min(away + 1, cap);
    if (i < upper)
      out[i - lower] = std::min(out[i - lower], static_cast<std::uint8_t>(away));
  }
}

// out = min over the neighbours at |r| < cap of max(|r|, in), `width` bytes at once. `in` points to
// the line itself; `before` and `after` are the numbers of neighbours, `step` apart.
void acrossLines(const std::uint8_t* in, std::size_t step, int before, int after, int cap,
                 std::uint8_t* __restrict out, std::size_t width)
{
  const auto relax = [&](int r, const std::uint8_t* a, const std::uint8_t* b)
  {
    const auto least = static_cast<std::uint8_t>(r);
    for (std::size_t i = 0; i < width; ++i)
    {
      const std::uint8_t nearer = std::min(a[i], b[i]);
      out[i] = std::min(out[i], std::max(nearer, least));
    }
  };
  std::copy(in, in + width, out);
  for (int r = 1; r < cap; ++r)
  {
    const std::size_t offset = static_cast<std::size_t>(r) * step;
    const std::uint8_t* below = r <= before ? in - offset : nullptr;
    const std::uint8_t* above = r <= after ? in + offset : nullptr;
    if (!below && !above)
      break;
    relax(r, below ? below : above, above ? above : below);
  }
}

} // namespace

DistanceBlock chebyshevDistances(const std::uint8_t* cells, std::size_t stride, std::uint8_t bit,
                                 const core::Index3& dims, const core::IndexBox& box, int cap)
{
  const core::Index3 size = box.size();
  const auto width = (static_cast<std::size_t>(size[0]) + kRegister - 1) / kRegister * kRegister;
  // Lines and planes beyond the box that may contain the nearest mark.
  const auto from = [&](std::size_t axis) { return std::max(box.lower[axis] - cap + 1, 0); };
  const auto to = [&](std::size_t axis) { return std::min(box.upper[axis] + cap - 1, dims[axis]); };
  const int firstLine = from(1);
  const int lines = to(1) - firstLine;
  const int firstPlane = from(2);
  const int planes = to(2) - firstPlane;
  const std::size_t plane = width * static_cast<std::size_t>(size[1]);

  std::vector<std::uint8_t> inPlane(plane * static_cast<std::size_t>(planes));
  tbb::parallel_for(
      tbb::blocked_range<int>(0, planes, 4),
      [&](const tbb::blocked_range<int>& range)
      {
        std::vector<std::uint8_t> inLine(width * static_cast<std::size_t>(lines),
                                         static_cast<std::uint8_t>(cap));
        for (int k = range.begin(); k < range.end(); ++k)
        {
          for (int j = 0; j < lines; ++j)
          {
            const std::size_t start =
                static_cast<std::size_t>(dims[0]) *
                (static_cast<std::size_t>(firstLine + j) +
                 static_cast<std::size_t>(dims[1]) * static_cast<std::size_t>(firstPlane + k));
            alongLine({cells + start * stride, stride, bit}, dims[0], box.lower[0], box.upper[0],
                      cap, &inLine[width * static_cast<std::size_t>(j)]);
          }
          for (int j = 0; j < size[1]; ++j)
          {
            const int own = box.lower[1] + j - firstLine;
            acrossLines(
                &inLine[width * static_cast<std::size_t>(own)], width, own, lines - 1 - own, cap,
                &inPlane[plane * static_cast<std::size_t>(k) + width * static_cast<std::size_t>(j)],
                width);
          }
        }
      });

  DistanceBlock result{box, width,
                       std::vector<std::uint8_t>(plane * static_cast<std::size_t>(size[2]))};
  tbb::parallel_for(tbb::blocked_range<int>(0, size[2], 4),
                    [&](const tbb::blocked_range<int>& range)
                    {
                      for (int k = range.begin(); k < range.end(); ++k)
                      {
                        const int own = box.lower[2] + k - firstPlane;
                        acrossLines(&inPlane[plane * static_cast<std::size_t>(own)], plane, own,
                                    planes - 1 - own, cap,
                                    &result.bytes[plane * static_cast<std::size_t>(k)], plane);
                      }
                    });
  return result;
}

} // namespace petrous::volume
