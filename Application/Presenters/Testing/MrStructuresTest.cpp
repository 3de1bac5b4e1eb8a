#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Phantom/Phantom.h"
#include "petrous/Presenters/PointProbe.h"
#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Presenters/StructureSurfaces.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

constexpr double kMrVoxel = 0.5; // mm

core::GridGeometry around(const Vector3d& center, const core::Index3& dims, double spacing)
{
  const Vector3d half = 0.5 * spacing * Vector3d(dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0);
  return {dims, Vector3d::Constant(spacing), center - half};
}

// The phantom as seen by its MR: structures sampled on the MR's own axis-aligned grid, each voxel
// mapped by the known motion.
class MrStructures : public ::testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    s_phantom = std::make_unique<phantom::Phantom>();
    const core::RigidTransform motion = s_phantom->mrFromCt();
    const core::GridGeometry grid =
        around(motion * phantom::Phantom::center(), {100, 100, 90}, kMrVoxel);
    const Eigen::Matrix4d back = motion.matrix().inverse();
    const Eigen::Matrix3d turn = back.topLeftCorner<3, 3>();
    const Eigen::Vector4d first = back * grid.origin().homogeneous();
    const core::GridGeometry seen(grid.dims(), grid.spacing(), first.head<3>(), turn);
    volume::LabelMap map = phantom::labelPhantom(*s_phantom, seen);
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid);
    std::copy_n(map.voxels->data(), map.voxels->size(), voxels->data());
    map.voxels = voxels;

    scene::Case value;
    value.name = "ear";
    value.ct.geometry = around(phantom::Phantom::center(), {100, 100, 90}, 0.4);
    value.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(value.ct.geometry,
                                                             std::int16_t{-1000}));
    scene::ImagePart mr;
    mr.name = "T2";
    mr.geometry = grid;
    value.mr.push_back(mr);
    scene::LabelPart part;
    for (const volume::Segment& segment : map.segments)
    {
      scene::StructurePart structure;
      structure.name = segment.name;
      structure.index = segment.index;
      structure.look.shown = true;
      if (segment.voxels > 0)
        part.structures.push_back(structure);
    }
    part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
    part.drawnOn = "T2";
    value.labels.push_back(part);
    s_case = std::make_unique<scene::Case>(value);
  }
  static void TearDownTestSuite()
  {
    s_case.reset();
    s_phantom.reset();
  }

  // The maximum distance of a structure's voxel centre outside the phantom's own structure.
  static double farthestOutside(const scene::Case& value)
  {
    double farthest = 0.0;
    const auto labels = scene::labelsOnCt(value, value.labels[0]);
    const auto& voxels = *labels->voxels;
    const core::Index3 n = voxels.geometry().dims();
    for (int k = 0; k < n[2]; k += 2)
      for (int j = 0; j < n[1]; j += 2)
        for (int i = 0; i < n[0]; i += 2)
          if (const std::uint16_t index = voxels.at(i, j, k))
            farthest = std::max(
                farthest, s_phantom->signedDistance(
                              index - 1U, voxels.geometry().patientFromVoxel(Vector3d(i, j, k))));
    return farthest;
  }

  static std::unique_ptr<phantom::Phantom> s_phantom;
  static std::unique_ptr<scene::Case> s_case;
};
std::unique_ptr<phantom::Phantom> MrStructures::s_phantom;
std::unique_ptr<scene::Case> MrStructures::s_case;

} // namespace

TEST_F(MrStructures, LandOnTheCtWithinAVoxel)
{
  scene::Case value = *s_case;
  scene::applyRegistration(value, "T2", s_phantom->mrFromCt(), {});
  EXPECT_LT(farthestOutside(value), 0.1 * kMrVoxel);

  // Conversely, the surface of the phantom's structure is that of the label.
  StructureSurfaces surfaces(value);
  const auto bounds = value.ct.geometry.patientBounds();
  std::size_t compared = 0;
  for (std::size_t n = 0; n < surfaces.count(); ++n)
  {
    if (surfaces.name(n) != "cochlea" && surfaces.name(n) != "sigmoid_sinus" &&
        surfaces.name(n) != "facial_nerve")
      continue;
    ++compared;
    const auto mesh = s_phantom->surface(s_phantom->indexOf(surfaces.name(n)), bounds, 1.0);
    for (const auto& vertex : mesh.vertices)
    {
      const Vector3d at = vertex.cast<double>();
      const Vector3d margin = (at - value.ct.geometry.center()).cwiseAbs();
      if (margin.maxCoeff() > 15.0) // where the box cuts the mesh flat
        continue;
      EXPECT_LT(std::abs(surfaces.distance(n, at, 10.0)), kMrVoxel) << surfaces.name(n);
    }
  }
  EXPECT_EQ(compared, 3U);

  scene::applyRegistration(value, "T2", {}, {});
  EXPECT_GT(farthestOutside(value), 4.0 * kMrVoxel) << "elsewhere without the motion";
}

TEST_F(MrStructures, AreFeltReadAndDrawnWhereTheyLand)
{
  scene::Case value = *s_case;
  const SliceGeometry slice = SliceGeometry::fitting(SliceOrientation::Axial, value.ct.geometry,
                                                     value.ct.geometry.center(), 128, 128);
  const auto colourful = [&](const scene::Case& shown)
  {
    const SlicePixels pixels = SlicePresenter(shown).draw(slice, {});
    std::size_t count = 0;
    for (std::size_t n = 0; n < pixels.rgb.size(); n += 3)
      count += pixels.rgb[n] != pixels.rgb[n + 1] || pixels.rgb[n] != pixels.rgb[n + 2];
    return count;
  };
  const std::size_t without = colourful(value);
  EXPECT_TRUE(scene::tissueField(value).solids().empty()) << "not silently touchable";

  scene::applyRegistration(value, "T2", s_phantom->mrFromCt(), {});
  const volume::TissueField field = scene::tissueField(value);
  PointProbe reader(value, field);
  for (const char* name : {"cochlea", "facial_nerve"})
  {
    const std::size_t index = s_phantom->indexOf(name);
    const auto& structure = s_phantom->structures()[index];
    // Deepest point, by a coarse search.
    Vector3d deepest = structure.lower;
    double depth = 0.0;
    for (double x = structure.lower[0]; x < structure.upper[0]; x += 0.4)
      for (double y = structure.lower[1]; y < structure.upper[1]; y += 0.4)
        for (double z = structure.lower[2]; z < structure.upper[2]; z += 0.4)
          if (const double d = s_phantom->signedDistance(index, {x, y, z}); d < depth)
          {
            depth = d;
            deepest = {x, y, z};
          }
    ASSERT_LT(depth, 0.0);
    EXPECT_EQ(reader.at(deepest).structure, name);
    EXPECT_GT(field.value(deepest), 0.0) << name;
  }
  EXPECT_GT(colourful(value), without + 100U);
}
