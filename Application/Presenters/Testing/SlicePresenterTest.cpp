#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include <Eigen/Geometry>

#include "petrous/Presenters/SlicePresenter.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

// HU = 2 x + 3 y + 5 z in patient mm: trilinear sampling is exact on every grid.
double plane(const Vector3d& patient)
{
  return patient.dot(Vector3d(2, 3, 5));
}

scene::Case planeCase(const core::GridGeometry& grid)
{
  auto ct = std::make_shared<volume::Volume<float>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        ct->at(i, j, k) = static_cast<float>(plane(grid.patientFromVoxel(Vector3d(i, j, k))));
  scene::Case value;
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<float>>(ct));
  return value;
}

Eigen::Matrix3d oblique()
{
  return Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

Eigen::Matrix3d flipped() // left-handed, axes exchanged
{
  Eigen::Matrix3d direction;
  direction << 0, -1, 0, -1, 0, 0, 0, 0, -1;
  return direction;
}

// Every pixel in the hull has the ramp's grey at its patient point; the others are outside.
void expectPlane(const core::GridGeometry& grid, SliceOrientation orientation)
{
  const scene::Case value = planeCase(grid);
  const SlicePresenter presenter(value);
  const auto slice = SliceGeometry::fitting(orientation, grid, grid.center(), 37, 29);
  const GreyWindow window{600.0, plane(grid.center())};
  const SlicePixels pixels = presenter.draw(slice, window);
  int inside = 0;
  for (int row = 0; row < 29; ++row)
    for (int column = 0; column < 37; ++column)
    {
      const Vector3d patient = slice.patientFromPixel(column, row);
      const Vector3d voxel = grid.voxelFromPatient(patient);
      const auto rgb = pixels.at(column, row);
      bool nearBorder = false;
      for (Eigen::Index a = 0; a < 3; ++a)
      {
        const double last = grid.dims()[static_cast<std::size_t>(a)] - 1.0;
        nearBorder = nearBorder || std::abs(voxel[a]) < 1e-6 || std::abs(voxel[a] - last) < 1e-6;
      }
      if (nearBorder)
        continue;
      if (!grid.hullContains(voxel))
      {
        ASSERT_EQ(rgb, SlicePresenter::kOutside) << column << ' ' << row;
        continue;
      }
      ++inside;
      const double grey =
          std::clamp(255.0 * (plane(patient) - window.level + 300.0) / 600.0, 0.0, 255.0);
      ASSERT_NEAR(rgb[0], grey, 0.51) << column << ' ' << row;
      ASSERT_EQ(rgb[0], rgb[1]);
      ASSERT_EQ(rgb[0], rgb[2]);
    }
  EXPECT_GT(inside, 100);
}

} // namespace

class SliceOfGrid : public ::testing::TestWithParam<SliceOrientation>
{
};

TEST_P(SliceOfGrid, ShowsTheValuesAtThePatientPointsOfAnUprightGrid)
{
  expectPlane({{20, 24, 16}, {0.5, 0.4, 1.2}, {-30, 10, 5}}, GetParam());
}

TEST_P(SliceOfGrid, ShowsTheValuesAtThePatientPointsOfAnObliqueGrid)
{
  expectPlane({{20, 24, 16}, {0.5, 0.4, 1.2}, {-30, 10, 5}, oblique()}, GetParam());
}

TEST_P(SliceOfGrid, ShowsTheValuesAtThePatientPointsOfAFlippedGrid)
{
  expectPlane({{20, 24, 16}, {0.5, 0.4, 1.2}, {-30, 10, 5}, flipped()}, GetParam());
}

TEST_P(SliceOfGrid, ShowsAllOfTheGridAndPixelsInvertThePatientPoints)
{
  const core::GridGeometry grid({20, 24, 16}, {0.5, 0.4, 1.2}, {-30, 10, 5}, oblique());
  const auto slice = SliceGeometry::fitting(GetParam(), grid, grid.center(), 300, 200);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3d voxel((corner & 1) * 19, (corner >> 1 & 1) * 23, (corner >> 2) * 15);
    const auto pixel = slice.pixelFromPatient(grid.patientFromVoxel(voxel));
    EXPECT_GE(pixel.minCoeff(), 0.0);
    EXPECT_LE(pixel[0], 299.0);
    EXPECT_LE(pixel[1], 199.0);
  }
  const auto pixel = slice.pixelFromPatient(slice.patientFromPixel(12.25, 77.5));
  EXPECT_NEAR(pixel[0], 12.25, 1e-9);
  EXPECT_NEAR(pixel[1], 77.5, 1e-9);
  const double step = (slice.patientFromPixel(1, 0) - slice.patientFromPixel(0, 0)).norm();
  EXPECT_NEAR(step, slice.mmPerPixel(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Orientations, SliceOfGrid,
                         ::testing::Values(SliceOrientation::Axial, SliceOrientation::Coronal,
                                           SliceOrientation::Sagittal),
                         [](const auto& slice) { return nameOf(slice.param); });

TEST(SliceGeometry, HasThePatientsRightOnThePicturesLeft)
{
  const auto letters = [](SliceOrientation orientation)
  {
    const auto l = SliceGeometry(orientation, Vector3d::Zero(), 1.0, 10, 10).edgeLetters();
    return l.left + l.right + l.top + l.bottom;
  };
  EXPECT_EQ(letters(SliceOrientation::Axial), "RLAP");
  EXPECT_EQ(letters(SliceOrientation::Coronal), "RLSI");
  EXPECT_EQ(letters(SliceOrientation::Sagittal), "APSI");
  const SliceGeometry axial(SliceOrientation::Axial, {1, 2, 3}, 0.5, 11, 11);
  EXPECT_LT(axial.patientFromPixel(0, 5).x(), 1.0); // LPS: x decreases towards the right
  EXPECT_LT(axial.patientFromPixel(5, 0).y(), 2.0); // y decreases towards anterior
  EXPECT_EQ(axial.patientFromPixel(5, 5), Vector3d(1, 2, 3));
}

TEST(SliceGeometry, RefusesAPictureWithoutPixels)
{
  EXPECT_THROW(SliceGeometry(SliceOrientation::Axial, Vector3d::Zero(), 1.0, 0, 10),
               core::InvalidParameter);
  EXPECT_THROW(SliceGeometry(SliceOrientation::Axial, Vector3d::Zero(), 0.0, 10, 10),
               core::InvalidParameter);
}

TEST(ScaleBar, HasARoundLengthThatFits)
{
  EXPECT_DOUBLE_EQ(scaleBarLength(37.0), 20.0);
  EXPECT_DOUBLE_EQ(scaleBarLength(50.0), 50.0);
  EXPECT_DOUBLE_EQ(scaleBarLength(1.9), 1.0);
  EXPECT_NEAR(scaleBarLength(0.7), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(scaleBarLength(0.0), 0.0);
}

TEST(SlicePresenter, TintsAShownStructureWithinItsOutline)
{
  const core::GridGeometry grid({40, 40, 5}, Vector3d::Ones(), Vector3d::Zero());
  scene::Case value = planeCase(grid);
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int j = 10; j < 30; ++j)
    for (int i = 10; i < 30; ++i)
      voxels->at(i, j, 2) = 3;
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  scene::StructurePart structure;
  structure.name = "s";
  structure.index = 3;
  structure.look.color = {1.0F, 0.0F, 0.0F};
  part.structures.push_back(structure);
  value.labels.push_back(part);
  const SliceGeometry slice(SliceOrientation::Axial, {19.5, 19.5, 2}, 1.0, 40, 40);
  const GreyWindow white{1.0, -1000.0};
  auto pixels = SlicePresenter(value).draw(slice, white);
  EXPECT_EQ(pixels.at(5, 5), (std::array<std::uint8_t, 3>{255, 255, 255}));
  EXPECT_EQ(pixels.at(20, 20)[0], 255);
  EXPECT_NEAR(pixels.at(20, 20)[1], 255 * 0.7, 1.0);
  EXPECT_LT(pixels.at(10, 20)[1], 20); // the outline
  EXPECT_EQ(pixels.at(9, 20)[1], 255);

  value.labels[0].structures[0].look.shown = false;
  pixels = SlicePresenter(value).draw(slice, white);
  EXPECT_EQ(pixels.at(20, 20)[1], 255);
}

TEST(SlicePresenter, ShowsInRedWhereLessThanHalfIsLeft)
{
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero());
  scene::Case value = planeCase(grid);
  value.dissection = dissection::Dissection(grid);
  const SliceGeometry slice(SliceOrientation::Coronal, {19.5, 20, 19.5}, 1.0, 40, 40);
  const GreyWindow white{1.0, -1000.0};
  const SlicePresenter presenter(value); // made before the cut: it sees the current mask
  EXPECT_EQ(presenter.draw(slice, white).at(20, 20)[1], 255);
  value.dissection.beginStroke({});
  value.dissection.cut({{20, 20, 20}, {20, 20, 20}, 6.0});
  value.dissection.endStroke();
  const auto pixels = presenter.draw(slice, white);
  int red = 0;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column)
      red += pixels.at(column, row)[0] > pixels.at(column, row)[1] + 40;
  EXPECT_NEAR(red, 3.14159 * 36.0, 6.0);
  EXPECT_EQ(pixels.at(20, 10)[1], 255);

  // Its edge is a line of one colour on the white bone, whatever the hatching.
  const auto isCut = [&](int column, int row)
  { return pixels.at(column, row)[0] > pixels.at(column, row)[1] + 40; };
  std::set<std::array<std::uint8_t, 3>> edge, within;
  for (int row = 1; row < 39; ++row)
    for (int column = 1; column < 39; ++column)
      if (isCut(column, row))
      {
        const bool isInner = isCut(column - 1, row) && isCut(column + 1, row) &&
                             isCut(column, row - 1) && isCut(column, row + 1);
        (isInner ? within : edge).insert(pixels.at(column, row));
      }
  EXPECT_EQ(edge.size(), 1U);
  EXPECT_EQ(within.size(), 2U) << "hatched";
  for (const auto& color : within)
    EXPECT_EQ(edge.count(color), 0U);
}

TEST(SlicePresenter, TellsWhatIsNotSeenInSlices)
{
  const core::GridGeometry grid({4, 4, 4}, Vector3d::Ones(), Vector3d::Zero());
  scene::Case value = planeCase(grid);
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{1});
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  part.structures.resize(1);
  part.structures.front().name = "nerve";
  part.structures.front().index = 1;
  value.labels.push_back(part);
  const SlicePresenter before(value);
  auto& look = value.labels.front().structures.front().look;
  look.transfer = appearance::TransferFunction::constant({1.0F, 0.0F, 0.0F}, 0.5F);
  look.opacity = 0.5F;
  EXPECT_TRUE(SlicePresenter(value).drawsAs(before));
  look.color = {1.0F, 0.0F, 0.0F};
  EXPECT_FALSE(SlicePresenter(value).drawsAs(before));
  look = {};
  EXPECT_TRUE(SlicePresenter(value).drawsAs(before));
  look.shown = false;
  EXPECT_FALSE(SlicePresenter(value).drawsAs(before));
  look = {};
  value.iso = 500.0; // contours over an MR
  EXPECT_FALSE(SlicePresenter(value).drawsAs(before));
}
