#include "petrous/Presenters/MeshSection.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "OverlayPainter.h"
#include "petrous/Volume/MeshCut.h"

namespace petrous::presenters
{

namespace
{

constexpr float kLineWidth = 1.4F; // pixels

// Whether the plane passes the mesh's box. Conservative by the rounding of the vertices.
bool meets(const core::TriangleMesh& mesh, const SliceGeometry& slice)
{
  const auto bounds = mesh.bounds();
  const Eigen::Vector3d lower = bounds[0].cast<double>();
  const Eigen::Vector3d upper = bounds[1].cast<double>();
  const Eigen::Vector3d& normal = slice.axes().next;
  const double reach = 0.5 * normal.cwiseAbs().dot(upper - lower);
  return std::abs(normal.dot(0.5 * (lower + upper) - slice.center())) <= reach + 1e-3;
}

// An end of a segment, and whether the segment begins there.
struct End
{
  Eigen::Vector2f at;
  int turn; // +1: begins, -1: ends
};

void judgeEnds(MeshSection& section)
{
  std::vector<End> ends;
  ends.reserve(2 * section.segments.size());
  for (const ContourSegment& segment : section.segments)
  {
    ends.push_back({segment.a, 1});
    ends.push_back({segment.b, -1});
  }
  std::sort(ends.begin(), ends.end(),
            [](const End& one, const End& other)
            { return std::tie(one.at[0], one.at[1]) < std::tie(other.at[0], other.at[1]); });
  for (std::size_t first = 0; first < ends.size();)
  {
    std::size_t next = first;
    int turns = 0;
    for (; next < ends.size() && ends[next].at == ends[first].at; ++next)
      turns += ends[next].turn;
    section.isClosed = section.isClosed && (next - first) % 2 == 0;
    section.facesAlike = section.facesAlike && turns == 0;
    first = next;
  }
}

// Where a contour crosses a row of pixels.
struct Crossing
{
  float x;
  int turn;
};

void fill(const MeshSection& section, const std::array<float, 3>& color, SlicePixels& pixels)
{
  std::vector<std::vector<Crossing>> rows(static_cast<std::size_t>(pixels.height));
  for (const ContourSegment& segment : section.segments)
  {
    const bool isDown = segment.a[1] < segment.b[1];
    const Eigen::Vector2f& top = isDown ? segment.a : segment.b;
    const Eigen::Vector2f& bottom = isDown ? segment.b : segment.a;
    // Rows from the top, included, to the bottom, excluded.
    const int first = static_cast<int>(std::ceil(std::max(top[1], 0.0F)));
    const float past = std::min(bottom[1], static_cast<float>(pixels.height));
    for (int row = first; static_cast<float>(row) < past; ++row)
    {
      const float share = (static_cast<float>(row) - top[1]) / (bottom[1] - top[1]);
      rows[static_cast<std::size_t>(row)].push_back(
          {top[0] + share * (bottom[0] - top[0]), isDown ? 1 : -1});
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    std::vector<Crossing>& crossings = rows[row];
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    int winding = 0;
    for (std::size_t n = 0; n + 1 < crossings.size(); ++n)
    {
      winding += section.facesAlike ? crossings[n].turn : 1;
      if (section.facesAlike ? winding == 0 : winding % 2 == 0)
        continue;
      const float from = std::max(crossings[n].x, 0.0F);
      const float past = std::min(crossings[n + 1].x, static_cast<float>(pixels.width));
      for (int column = static_cast<int>(std::ceil(from)); static_cast<float>(column) < past;
           ++column)
        blend(&pixels.rgb[3 * (row * static_cast<std::size_t>(pixels.width) +
                               static_cast<std::size_t>(column))],
              color, kStructureTint);
    }
  }
}

// Within the part of the picture where the contours are.
void outline(std::vector<ContourSegment> segments, const std::array<float, 3>& color,
             SlicePixels& pixels)
{
  Eigen::Array2f low(static_cast<float>(pixels.width), static_cast<float>(pixels.height));
  Eigen::Array2f high(-1.0F, -1.0F);
  for (const ContourSegment& segment : segments)
  {
    low = low.min(segment.a.array()).min(segment.b.array());
    high = high.max(segment.a.array()).max(segment.b.array());
  }
  const Eigen::Array2f last(static_cast<float>(pixels.width - 1),
                            static_cast<float>(pixels.height - 1));
  const Eigen::Array2i first = (low - kLineWidth).max(0.0F).min(last).floor().cast<int>();
  const Eigen::Array2i end = (high + kLineWidth).min(last).max(-1.0F).ceil().cast<int>() + 1;
  const Eigen::Array2i size = end - first;
  if ((size <= 0).any())
    return;
  const Eigen::Vector2f corner = first.cast<float>().matrix();
  for (ContourSegment& segment : segments)
    segment = {segment.a - corner, segment.b - corner};
  const std::vector<float> covered = coverage(segments, size[0], size[1], kLineWidth);
  std::size_t n = 0;
  for (int row = 0; row < size[1]; ++row)
    for (int column = 0; column < size[0]; ++column, ++n)
      if (covered[n] > 0.0F)
        blend(&pixels.rgb[3 * (static_cast<std::size_t>(first[1] + row) *
                                   static_cast<std::size_t>(pixels.width) +
                               static_cast<std::size_t>(first[0] + column))],
              color, kStructureOutline * covered[n]);
}

} // namespace

MeshSection sectionOf(const core::TriangleMesh& mesh, const SliceGeometry& slice)
{
  MeshSection section;
  if (!meets(mesh, slice))
    return section;
  const Eigen::Vector3d& normal = slice.axes().next;
  for (const volume::CutSegment& cut : volume::cutByPlane(mesh, normal, normal.dot(slice.center())))
    section.segments.push_back({slice.pixelFromPatient(cut.from).cast<float>(),
                                slice.pixelFromPatient(cut.to).cast<float>()});
  judgeEnds(section);
  return section;
}

void MeshSection::paint(const std::array<float, 3>& color, SlicePixels& pixels) const
{
  if (segments.empty())
    return;
  if (isClosed)
    fill(*this, color, pixels);
  outline(segments, color, pixels);
}

} // namespace petrous::presenters
