#include "petrous/Volume/SmoothedUnion.h"

#include <algorithm>
#include <array>
#include <limits>

namespace petrous::volume
{

namespace
{

// Two voxels beyond the structure the filtered union is 0 for certain.
constexpr int kMargin = 2;

std::vector<bool> wantedTable(const LabelMap& labels,
                              const std::function<bool(std::uint16_t)>& wanted)
{
  std::vector<bool> table(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1, false);
  for (const Segment& segment : labels.segments)
    table[segment.index] = wanted(segment.index);
  return table;
}

core::IndexBox boxOf(const Volume<std::uint16_t>& voxels, const std::vector<bool>& table)
{
  const core::Index3 dims = voxels.geometry().dims();
  core::IndexBox box;
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
    {
      const std::uint16_t* row = &voxels.at(0, j, k);
      const auto isWanted = [&table](std::uint16_t value) { return table[value]; };
      const std::uint16_t* first = std::find_if(row, row + dims[0], isWanted);
      if (first == row + dims[0])
        continue;
      int last = dims[0] - 1;
      while (!table[row[last]])
        --last;
      box = box.united({{static_cast<int>(first - row), j, k}, {last + 1, j + 1, k + 1}});
    }
  return box;
}

// [1 2 1]/4 along one axis; beyond the ends there is nothing.
void filterLine(float* first, int count, std::ptrdiff_t stride)
{
  float before = 0.0F;
  for (int i = 0; i < count; ++i)
  {
    float& value = first[i * stride];
    const float after = i + 1 < count ? first[(i + 1) * stride] : 0.0F;
    const float own = value;
    value = 0.25F * (before + 2.0F * own + after);
    before = own;
  }
}

void filter(Volume<float>& field)
{
  const core::Index3 n = field.geometry().dims();
  const std::ptrdiff_t row = n[0];
  const std::ptrdiff_t slice = row * n[1];
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      filterLine(&field.at(0, j, k), n[0], 1);
  for (int k = 0; k < n[2]; ++k)
    for (int i = 0; i < n[0]; ++i)
      filterLine(&field.at(i, 0, k), n[1], row);
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i)
      filterLine(&field.at(i, j, 0), n[2], slice);
}

} // namespace

std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted)
{
  const auto table = wantedTable(labels, wanted);
  const core::IndexBox box = boxOf(*labels.voxels, table);
  if (box.empty())
    return nullptr;

  const core::GridGeometry& grid = labels.voxels->geometry();
  const core::Index3 size = box.size();
  // May reach beyond the label grid, so that a structure cut off by its border is closed there.
  const core::GridGeometry geometry(
      {size[0] + 2 * kMargin, size[1] + 2 * kMargin, size[2] + 2 * kMargin}, grid.spacing(),
      grid.patientFromVoxel(
          Eigen::Vector3d(box.lower[0] - kMargin, box.lower[1] - kMargin, box.lower[2] - kMargin)),
      grid.direction());
  auto field = std::make_shared<Volume<float>>(geometry, 0.0F);
  const auto forEachInside = [&](const auto& visit)
  {
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i)
          visit(
              field->at(i + kMargin, j + kMargin, k + kMargin),
              bool{table[labels.voxels->at(box.lower[0] + i, box.lower[1] + j, box.lower[2] + k)]});
  };
  forEachInside([](float& value, bool inside) { value = inside ? 1.0F : 0.0F; });
  filter(*field);
  forEachInside(
      [](float& value, bool inside)
      { value = inside ? std::max(value, kInsideFloor) : std::min(value, 1.0F - kInsideFloor); });
  return field;
}

} // namespace petrous::volume
