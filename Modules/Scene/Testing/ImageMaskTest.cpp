#include <gtest/gtest.h>

#include "SyntheticHead.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/ImageMask.h"

using namespace petrous;
using namespace petrous::volume::test;
using Eigen::Vector3d;

namespace
{

using Kind = volume::FaceFinding::Kind;
using Image = std::shared_ptr<const volume::IntensityVolume>;

scene::Case headCase()
{
  scene::Case value;
  value.name = "head";
  value.ct.geometry = gridOver(headBox(), Vector3d::Constant(3.0));
  value.ct.volume =
      std::make_shared<const volume::IntensityVolume>(scanned(SyntheticHead(), value.ct.geometry));
  value.ct.range = value.ct.volume.get()->range();
  value.ct.object = "stored.nrrd";
  value.dissection = dissection::Dissection(value.ct.geometry);
  return value;
}

void drill(scene::Case& value, const Vector3d& at)
{
  value.dissection.beginStroke({});
  value.dissection.cut({at, at + Vector3d(0, 3, 0), 4.0});
  value.dissection.endStroke();
}

void label(scene::Case& value, const std::string& name, const Vector3d& from, const Vector3d& to)
{
  auto voxels = volume::makeZeroVolume<std::uint16_t>(value.ct.geometry);
  const core::IndexBox box = value.ct.geometry.boxCovering(from, to);
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        voxels->at(i, j, k) = 1;
  volume::Segment segment;
  segment.name = name;
  segment.index = 1;
  auto map = volume::makeLabelMap(std::move(voxels), {segment});
  scene::LabelPart part;
  part.drawnOn = "";
  part.structures.push_back({name, 1, map.segments.front().voxels, 1.0, {}});
  part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
  value.labels.push_back(std::move(part));
}

// All of which can be masked.
std::vector<std::string> facesOf(const scene::Case& value)
{
  std::vector<std::string> texts;
  for (const scene::ImageWithFace& image : scene::imagesWithFace(value))
  {
    EXPECT_EQ(image.fault, "");
    texts.push_back(image.text);
  }
  return texts;
}

// Voxels within `distance` of the box that differ.
std::size_t changedWithin(const volume::IntensityVolume& a, const volume::IntensityVolume& b,
                          const core::PatientBox& box, double distance)
{
  const core::Index3 n = a.geometry().dims();
  std::size_t count = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        count +=
            box.exteriorDistance(a.geometry().patientFromVoxel(Vector3d(i, j, k))) <= distance &&
                    a.at(i, j, k) != b.at(i, j, k)
                ? 1
                : 0;
  return count;
}

} // namespace

TEST(ImageMask, MasksCtAndMrAndLeavesAllElse)
{
  scene::Case value = headCase();
  drill(value, {60, 0, 15});
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  mr.object = "mr.nrrd";
  mr.volume =
      std::make_shared<const volume::IntensityVolume>(scanned(SyntheticHead(), mr.geometry, true));
  value.mr.push_back(mr);
  EXPECT_EQ(facesOf(value), (std::vector<std::string>{"the CT", "MR 'T2'"}));
  const Image home = value.ct.volume.get();
  scene::Case masked = value;
  scene::ImageMask mask;
  mask.face = true;
  const auto report = scene::maskImages(masked, mask);
  ASSERT_EQ(report.images.size(), 2u);
  for (const auto& image : report.images)
  {
    EXPECT_EQ(image.face, Kind::Face);
    EXPECT_GT(image.changed, 0u);
  }
  EXPECT_TRUE(masked.ct.object.empty());
  EXPECT_TRUE(masked.mr.front().object.empty());
  EXPECT_EQ(value.ct.object, "stored.nrrd");
  EXPECT_EQ(value.ct.volume.get(), home);
  EXPECT_TRUE(scene::imagesWithFace(masked).empty());
  EXPECT_EQ(masked.applied(), 1u);
  EXPECT_TRUE(core::sameGrid(masked.ct.geometry, value.ct.geometry));

  // Again: nothing new, whether the case says that it is masked or not.
  for (const bool noted : {true, false})
  {
    scene::Case again = masked;
    if (!noted)
      again.ct.notes.clear();
    const auto second = scene::maskImages(again, mask);
    EXPECT_EQ(second.images.front().face, Kind::Masked);
    EXPECT_EQ(second.images.front().changed, 0u);
    EXPECT_EQ(again.ct.volume.get(), masked.ct.volume.get());
  }
}

// What a case says of its image may come with an archive of another's.
TEST(ImageMask, BelievesNoNoteAndNoRecordOfAMask)
{
  scene::Case value = headCase();
  value.ct.notes.push_back("the face is masked to a plane 50 mm behind the tip of the nose, with "
                           "the auricles");
  value.ct.provenance.isFaceMasked = value.ct.provenance.areEarsMasked = true;
  EXPECT_EQ(facesOf(value), (std::vector<std::string>{"the CT"}));
  scene::ImageMask mask;
  mask.face = true;
  const auto report = scene::maskImages(value, mask);
  EXPECT_EQ(report.images.front().face, Kind::Face);
  EXPECT_GT(report.images.front().changed, 0u);
  EXPECT_TRUE(scene::imagesWithFace(value).empty());
}

TEST(ImageMask, RefusesAuriclesThatAnEarlierMaskLeft)
{
  scene::Case value = headCase();
  scene::ImageMask mask;
  mask.face = true;
  scene::maskImages(value, mask);
  const Image once = value.ct.volume.get();
  mask.ears = true;
  EXPECT_THROW(scene::maskImages(value, mask), core::Error);
  EXPECT_EQ(value.ct.volume.get(), once);

  scene::Case both = headCase();
  scene::maskImages(both, mask);
  const auto again = scene::maskImages(both, mask);
  EXPECT_EQ(again.images.front().face, Kind::Masked);
  EXPECT_EQ(again.images.front().changed, 0u);
  EXPECT_TRUE(both.ct.provenance.isFaceMasked && both.ct.provenance.areEarsMasked);
  EXPECT_TRUE(value.ct.provenance.isFaceMasked);
  EXPECT_FALSE(value.ct.provenance.areEarsMasked || value.ct.provenance.isCropped);
}

TEST(ImageMask, KeepsStructuresAndDrillingOfAllApproaches)
{
  scene::Case value = headCase();
  const core::PatientBox sinus(Vector3d(8, -66, -6), Vector3d(14, -61, 0));
  label(value, "antrum", sinus.min(), sinus.max());
  const Vector3d undone(-16, -62, -10);
  drill(value, undone);
  value.dissection.undo();
  scene::Case masked = value;
  scene::ImageMask mask;
  mask.face = true;
  const auto report = scene::maskImages(masked, mask);
  EXPECT_GT(report.images.front().kept, 0u);
  std::string notes;
  for (const std::string& note : report.notes)
    notes += note;
  EXPECT_NE(notes.find("structure 'antrum'"), std::string::npos) << notes;
  EXPECT_NE(notes.find("what was drilled"), std::string::npos) << notes;
  EXPECT_EQ(changedWithin(*value.ct.volume.get(), *masked.ct.volume.get(), sinus, 5.0), 0u);
  EXPECT_EQ(changedWithin(*value.ct.volume.get(), *masked.ct.volume.get(),
                          core::PatientBox(undone, undone + Vector3d(0, 3, 0)), 4.0 + 5.0),
            0u);
}

TEST(ImageMask, RefusesWhereAStructureHoldsTheFace)
{
  scene::Case value = headCase();
  label(value, "soft tissue", {-60, -110, -80}, {60, -60, 60});
  const Image home = value.ct.volume.get();
  scene::ImageMask mask;
  mask.face = true;
  try
  {
    scene::maskImages(value, mask);
    FAIL();
  }
  catch (const core::Error& error)
  {
    EXPECT_EQ(error.fault(), core::Fault::Refused);
    EXPECT_NE(std::string(error.what()).find("structure 'soft tissue'"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(value.ct.volume.get(), home);
  EXPECT_EQ(value.ct.object, "stored.nrrd");
}

TEST(ImageMask, LeavesAnImageWithoutAFaceAsItIs)
{
  scene::Case value = headCase();
  value.ct.geometry = gridOver(core::PatientBox(Vector3d(40, -30, -10), Vector3d(95, 30, 40)),
                               Vector3d::Constant(2.0));
  value.ct.volume =
      std::make_shared<const volume::IntensityVolume>(scanned(SyntheticHead(), value.ct.geometry));
  value.dissection = dissection::Dissection(value.ct.geometry);
  const Image home = value.ct.volume.get();
  scene::ImageMask mask;
  mask.face = true;
  const auto report = scene::maskImages(value, mask);
  EXPECT_EQ(report.images.front().face, Kind::None);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes.front().find("no face in this volume"), std::string::npos);
  EXPECT_EQ(value.ct.volume.get(), home);
  EXPECT_EQ(value.ct.object, "stored.nrrd");
}

TEST(ImageMask, CropsRegisteredImagesInTheSpaceOfTheCt)
{
  scene::Case value = headCase();
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  value.mr.push_back(mr);
  scene::ImageMask mask;
  mask.region = core::PatientBox(Vector3d(20, -40, -30), Vector3d(95, 40, 50));
  EXPECT_THROW(scene::maskImages(value, mask), core::InvalidParameter); // the MR has no place
  const core::RigidTransform shift(Eigen::Quaterniond::Identity(), Vector3d(0, 9, 0));
  scene::applyRegistration(value, "T2", shift, {});
  const Image home = value.ct.volume.get(), homeMr = value.mr.front().volume.get();
  scene::maskImages(value, mask);
  const core::Index3 n = value.ct.geometry.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const Vector3d at = value.ct.geometry.patientFromVoxel(Vector3d(i, j, k));
        if (mask.region->contains(at))
          ASSERT_EQ(value.ct.volume.get()->at(i, j, k), home->at(i, j, k));
        else
          ASSERT_EQ(value.ct.volume.get()->at(i, j, k), -1000.0);
        if (mask.region->contains(shift.inverse() * at))
        {
          ASSERT_EQ(value.mr.front().volume.get()->at(i, j, k), homeMr->at(i, j, k));
        }
      }
  mask.region = core::PatientBox(Vector3d(500, 0, 0), Vector3d(510, 10, 10));
  EXPECT_THROW(scene::maskImages(value, mask), core::InvalidParameter);
}
