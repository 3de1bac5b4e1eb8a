#include "petrous/Volume/ChebyshevDistance.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

using namespace petrous;
using core::Index3;
using core::IndexBox;

namespace
{

struct Cell
{
  std::uint8_t other = 0;
  std::uint8_t flags = 0;
};

constexpr std::uint8_t kMark = 4;

int below(std::mt19937& random, int limit)
{
  return std::uniform_int_distribution<int>(0, limit - 1)(random);
}

template <class Visit>
void forEach(const IndexBox& box, const Visit& visit)
{
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        visit(i, j, k);
}

int bruteForce(const std::vector<Cell>& cells, const Index3& dims, const Index3& from, int cap)
{
  int best = cap;
  std::size_t n = 0;
  forEach({{0, 0, 0}, dims},
          [&](int i, int j, int k)
          {
            if (cells[n++].flags & kMark)
              best = std::min(best, std::max({std::abs(i - from[0]), std::abs(j - from[1]),
                                              std::abs(k - from[2])}));
          });
  return best;
}

void expectExact(const std::vector<Cell>& cells, const Index3& dims, const IndexBox& box, int cap)
{
  const auto found =
      volume::chebyshevDistances(&cells.front().flags, sizeof(Cell), kMark, dims, box, cap);
  int wrong = 0;
  forEach(box,
          [&](int i, int j, int k) {
            wrong += found.row(j, k)[i - box.lower[0]] != bruteForce(cells, dims, {i, j, k}, cap);
          });
  EXPECT_EQ(wrong, 0) << dims[0] << 'x' << dims[1] << 'x' << dims[2] << ", cap " << cap;
}

} // namespace

TEST(ChebyshevDistance, IsThatToTheNearestMarkInAnyBoxOfTheGrid)
{
  std::mt19937 random(9);
  for (const Index3& dims :
       {Index3{40, 21, 13}, Index3{1, 50, 3}, Index3{17, 1, 1}, Index3{33, 2, 40}, Index3{1, 1, 1}})
    for (const int marks : {0, 1, 5, 60})
    {
      std::vector<Cell> cells(
          core::GridGeometry(dims, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero()).voxelCount(),
          Cell{kMark, std::uint8_t{0xFF ^ kMark}});
      for (int n = 0; n < marks; ++n)
        cells[static_cast<std::size_t>(below(random, static_cast<int>(cells.size())))].flags =
            kMark;
      for (const int cap : {15, 2, 200})
      {
        IndexBox part;
        for (std::size_t a = 0; a < 3; ++a)
        {
          part.lower[a] = below(random, dims[a]);
          part.upper[a] = part.lower[a] + 1 + below(random, dims[a] - part.lower[a]);
        }
        expectExact(cells, dims, part, cap);
        if (cap == 15)
          expectExact(cells, dims, {{0, 0, 0}, dims}, cap);
      }
    }
}
