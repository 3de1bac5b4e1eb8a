#include "petrous/Scene/GoneNames.h"

#include <gtest/gtest.h>

using namespace petrous;

namespace
{

scene::Case namedCase()
{
  scene::Case value;
  value.name = "ear";
  scene::LabelPart part;
  for (const char* name : {"nerve", "the surgeon's mark"})
  {
    part.structures.emplace_back();
    part.structures.back().name = name;
  }
  value.labels.push_back(part);
  scene::ImagePart mr;
  mr.name = "T2";
  mr.registration.emplace();
  value.mr.push_back(mr);
  value.meshes.emplace_back();
  value.meshes.back().name = "nerve 2";
  return value;
}

} // namespace

TEST(GoneNames, ANoteStaysOnlyIfAllThatItQuotesIsThere)
{
  const scene::Case value = namedCase();
  for (const char* text :
       {"", "of the files' names, which may be a patient's, 2 words were left out",
        "'nerve', 'nerve 2' lie wholly outside the CT",
        "has the grid of the MR 'T2', which was added later", "'the surgeon's mark' is thin",
        "something was left out in 2 places; 'petrous scan' says what."})
    EXPECT_TRUE(scene::quotesOnlyParts(value, text)) << text;
  for (const char* text :
       {"'DOE^JOHN 19500101' left out, as no voxel carries it", "'nerve', 'Doe' left out",
        "several structures are called 'O'Neil'; one of them was named 'nerve 2'",
        "the table of names has no column of opacity ('Doe 3')", "named (\xc3\xa9 'Doe')"})
    EXPECT_FALSE(scene::quotesOnlyParts(value, text)) << text;
}

TEST(GoneNames, AreForgottenWhereverTheyStand)
{
  scene::Case value = namedCase();
  const std::string gone = "'Doe' left out", kept = "'nerve' is thin";
  value.ct.notes = value.mr[0].notes = value.labels[0].notes = value.meshes[0].notes = {gone, kept};
  value.mr[0].registration->text = "moved along with 'Doe'";
  value.mr[0].registration->through = "Doe";
  value.mr[0].registration->error = scene::RegistrationError{};
  value.mr[0].registration->error->place = "the middle of 'Doe'";
  value.mr[0].registration->error->p95 = 1.5;
  value.softTissue.sourceImage = value.boneLook.sourceImage = value.meshes[0].look.sourceImage =
      "Doe";
  value.labels[0].structures[0].look.sourceImage = "T2";
  value.view.slices.emplace();
  value.view.slices->overlay = scene::ViewState::Slices::Overlay{"Doe", "blend", 0.5};
  for (const char* image : {"Doe", "T2", ""})
  {
    scene::Measurement mark;
    mark.name = std::string("mark on ") + image;
    mark.points = {Eigen::Vector3d::Zero()};
    mark.image = image;
    mark.structure = image == std::string("T2") ? "nerve" : "Doe";
    value.measurements.push_back(mark);
  }
  value.measurements.push_back(value.measurements[1]);
  value.measurements.back().images = {"Doe", "T2"};
  value.measurements.back().structureGone = true; // another is called "nerve" since
  scene::forgetGoneNames(value);
  EXPECT_NE(value.measurements[3].images[0], "Doe");
  EXPECT_NE(value.measurements[3].images[0], "");
  EXPECT_EQ(value.measurements[3].images[1], "T2");
  EXPECT_EQ(value.measurements[3].structure, "");
  EXPECT_NE(value.measurements[0].image, "Doe");
  EXPECT_NE(value.measurements[0].image, "") << "an empty image is the CT";
  EXPECT_EQ(value.measurements[0].structure, "");
  EXPECT_EQ(value.measurements[1].image, "T2");
  EXPECT_EQ(value.measurements[1].structure, "nerve");
  EXPECT_EQ(value.measurements[2].image, "");
  const std::vector<std::string> left{kept};
  EXPECT_EQ(value.ct.notes, left);
  EXPECT_EQ(value.mr[0].notes, left);
  EXPECT_EQ(value.labels[0].notes, left);
  EXPECT_EQ(value.meshes[0].notes, left);
  EXPECT_EQ(value.mr[0].registration->text, "");
  EXPECT_EQ(value.mr[0].registration->through, "");
  EXPECT_EQ(value.mr[0].registration->error->place, "the middle of a structure");
  EXPECT_EQ(value.mr[0].registration->error->p95, 1.5);
  EXPECT_EQ(value.boneLook.sourceImage, "");
  EXPECT_EQ(value.softTissue.sourceImage, "");
  EXPECT_EQ(value.meshes[0].look.sourceImage, "");
  EXPECT_EQ(value.labels[0].structures[0].look.sourceImage, "T2");
  EXPECT_FALSE(value.view.slices->overlay);
}

TEST(GoneNames, WhatIsThereStays)
{
  scene::Case value = namedCase();
  value.mr[0].registration->error = scene::RegistrationError{};
  value.mr[0].registration->error->place = "the middle of 'nerve'";
  value.view.slices.emplace();
  value.view.slices->overlay = scene::ViewState::Slices::Overlay{"T2", "blend", 0.5};
  scene::forgetGoneNames(value);
  EXPECT_EQ(value.mr[0].registration->error->place, "the middle of 'nerve'");
  EXPECT_TRUE(value.view.slices->overlay);
}
