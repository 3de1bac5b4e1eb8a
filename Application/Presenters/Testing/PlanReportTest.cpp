#include "petrous/Presenters/PlanReport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "../src/Share/ReportWords.h"
#include "ShapeCase.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/DissectionDistances.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Presenters/Measuring.h"
#include "petrous/Presenters/Phrasebook.h"
#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Scene/Branches.h"

using namespace petrous;
using namespace petrous::presenters;
namespace shapes = petrous::presenters::testing;
using Eigen::Vector3d;

namespace
{

scene::Case planned()
{
  const core::GridGeometry grid({40, 32, 32}, Vector3d::Constant(0.5), {0.0, 0.0, 0.0});
  scene::Case value = shapes::shapeCase(grid, {{"facial nerve", shapes::ball({5.0, 8.0, 8.0}, 2.5)},
                                               {"chorda", shapes::ball({15.0, 4.0, 4.0}, 0.4)}});
  value.name = "left ear";
  value.id = "3f2a90c1d4e5";
  value.description.side = scene::Side::Left;
  value.description.date = "2026-12-24";
  value.ct.provenance.interpolated = {{3, 4}};
  const auto drill = [&value](const Vector3d& at, double seconds)
  {
    dissection::StrokeInfo info;
    info.burr = {dissection::Burr::Kind::Diamond, 4.0, 30000.0, {}};
    info.duration = seconds;
    value.dissection.beginStroke(info);
    value.dissection.cut({at, at, 2.0});
    value.dissection.openInfo().removed = 33.5;
    value.dissection.endStroke();
  };
  drill({12.0, 8.0, 8.0}, 1.5);
  drill({12.0, 9.0, 8.0}, 2.0);
  scene::startBranch(value, "second way", 1);
  drill({11.0, 8.0, 8.0}, 4.0);
  scene::goToBranch(value, "main");
  scene::Measurement width;
  width.kind = scene::Measurement::Kind::Distance;
  width.name = "width";
  width.points = {{1.0, 1.0, 1.0}, {4.0, 5.0, 1.0}};
  value.measurements = {width};
  return value;
}

ReportOptions small()
{
  ReportOptions options;
  options.pictureWidth = 160;
  options.sliceWidth = 96;
  options.mayIdentify = [](const std::string&) { return false; };
  return options;
}

rendering::Picture pictureOf(const std::vector<std::uint8_t>& png)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetMemoryBuffer(png.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(png.size()));
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  rendering::Picture picture{image.GetDimensions()[0], image.GetDimensions()[1], {}};
  for (int row = picture.height - 1; row >= 0; --row) // VTK's first one is the lowest
    for (int column = 0; column < picture.width; ++column)
      for (int c = 0; c < 3; ++c)
        picture.rgb.push_back(
            static_cast<std::uint8_t>(image.GetScalarComponentAsDouble(column, row, 0, c)));
  return picture;
}

const ReportSection* find(const PlanReport& report, const std::string& id)
{
  const auto found = std::find_if(report.sections.begin(), report.sections.end(),
                                  [&](const ReportSection& one) { return one.id == id; });
  return found == report.sections.end() ? nullptr : &*found;
}

} // namespace

TEST(PlanReport, HasStrokesAndTimeOfEachApproach)
{
  const PlanReport report = planReport(planned(), small());
  const ReportSection* approaches = find(report, "approaches");
  ASSERT_TRUE(approaches);
  ASSERT_EQ(approaches->table.rows.size(), 2U);
  EXPECT_EQ(approaches->table.rows[0][1].value, 2.0);
  EXPECT_EQ(approaches->table.rows[0][2].value, 3.5); // 1.5 s + 2 s
  EXPECT_EQ(approaches->table.rows[1][2].value, 5.5); // 1.5 s + 4 s
  const ReportSection* strokes = find(report, "strokes");
  ASSERT_TRUE(strokes);
  ASSERT_EQ(strokes->table.rows.size(), 3U) << "and their sum";
  EXPECT_EQ(strokes->table.rows[0][1].text, "4.0 mm, diamond");
  EXPECT_EQ(strokes->table.rows[0][4].text, "33.50 mm³");
  EXPECT_EQ(strokes->table.rows[2][3].value, 3.5);

  ReportOptions second = small();
  for (const char* name : {"2", "second way"})
  {
    second.approach = name;
    const PlanReport other = planReport(planned(), second);
    EXPECT_EQ(find(other, "strokes")->table.rows[1][0].value, 3.0) << "the third that was drilled";
    EXPECT_LT(*find(other, "distances")->table.rows[0][1].value,
              *find(report, "distances")->table.rows[0][1].value)
        << "a millimetre nearer";
  }
  second.approach = "7";
  EXPECT_THROW(planReport(planned(), second), core::InvalidParameter);
}

TEST(PlanReport, HasOneNumberOfWhatWasRemovedFromALumen)
{
  scene::Case value = planned();
  for (const bool isSolid : {true, false})
  {
    for (scene::StructurePart& structure : value.labels.front().structures)
      structure.look.solid = isSolid;
    value.dissection.beginStroke({});
    const double y = isSolid ? 8.0 : 5.0; // a stroke that removes nothing is none
    value.dissection.cut({{5.0, y, 8.0}, {5.0, y, 8.0}, 1.0});
    value.dissection.openInfo().removed = 4.0;
    value.dissection.openInfo().structures = {{"facial nerve", 0.5}};
    value.dissection.endStroke();
    const std::string sum = isSolid ? "0.50 mm³" : "1.00 mm³";
    const PlanReport report = planReport(value, small());
    const ReportTable& distances = find(report, "distances")->table;
    const auto row = std::find_if(distances.rows.begin(), distances.rows.end(),
                                  [](const std::vector<ReportCell>& cells)
                                  { return cells.front().text == "facial nerve"; });
    ASSERT_NE(row, distances.rows.end());
    EXPECT_EQ(row->back().text, sum);
    EXPECT_EQ(row->back().isWarning, isSolid) << "a lumen is opened";
    EXPECT_EQ(find(report, "approaches")->table.rows.front().back().text, "facial nerve " + sum);
    EXPECT_EQ(find(report, "strokes")->table.rows[2].back().text, "facial nerve 0.50 mm³");
  }
}

TEST(PlanReport, StatesTheSpeedThatAPedalGaveBesideTheSetOne)
{
  scene::Case value = planned();
  const auto columns = [&value]
  {
    const PlanReport report = planReport(value, small());
    return find(report, "strokes")->table.columns;
  };
  const std::vector<std::string> usual{"Stroke", "Burr",    "Set speed",
                                       "Time",   "Removed", "Of structures"};
  EXPECT_EQ(columns(), usual);
  value.dissection.beginStroke({});
  value.dissection.cut({{10.0, 8.0, 12.0}, {10.0, 8.0, 12.0}, 2.0});
  value.dissection.openInfo().burr.rpm = 60000.0;
  value.dissection.openInfo().speed = dissection::SpindleSpeed{24000.0, 41000.0};
  value.dissection.endStroke();
  const PlanReport report = planReport(value, small());
  const ReportTable& strokes = find(report, "strokes")->table;
  const std::vector<std::string> byPedal{"Stroke",        "Burr", "Set speed", "Mean speed",
                                         "Highest speed", "Time", "Removed",   "Of structures"};
  EXPECT_EQ(strokes.columns, byPedal);
  ASSERT_EQ(strokes.rows.size(), 4U);
  for (const auto& row : strokes.rows)
    ASSERT_EQ(row.size(), byPedal.size());
  EXPECT_EQ(strokes.rows[0][3].text, "") << "of that stroke it is not known";
  EXPECT_EQ(strokes.rows[2][2].value, 60000.0);
  EXPECT_EQ(strokes.rows[2][3].value, 24000.0);
  EXPECT_EQ(strokes.rows[2][4].value, 41000.0);
  EXPECT_EQ(strokes.rows[3][5].value, 3.5) << "of all strokes, the last one in no time";
}

TEST(PlanReport, SaysWhatIsNotResolvedAndWhatWasGuessed)
{
  const PlanReport report = planReport(planned(), small());
  const ReportTable& structures = find(report, "structures")->table;
  ASSERT_EQ(structures.rows.size(), 2U);
  EXPECT_EQ(structures.rows[0][4].text, "yes");
  EXPECT_EQ(structures.rows[1][4].text, "no");
  EXPECT_TRUE(structures.rows[1][4].isWarning);
  const ReportTable& assumed = find(report, "import")->table;
  ASSERT_EQ(assumed.rows.size(), 1U);
  EXPECT_EQ(assumed.rows[0][1].text, "slices 4-5 of 32 interpolated between neighbours");

  scene::Case value = planned();
  value.ct.provenance = {};
  EXPECT_TRUE(find(planReport(value, small()), "import")->table.rows.empty());
}

// Who reads the paper must not take the table for whole.
TEST(PlanReport, NamesWhatIsLeftOutAndWhy)
{
  scene::Case value = planned();
  scene::LabelPart onMr = value.labels.front();
  onMr.drawnOn = "T2";
  onMr.structures.resize(1);
  onMr.structures[0].name = "facial canal";
  scene::LabelPart damaged = value.labels.front(); // as it is left out
  damaged.structures.resize(1);
  damaged.structures[0].name = "cochlea";
  damaged.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(
      std::make_shared<volume::Volume<std::uint16_t>>(
          core::GridGeometry({2, 2, 2}, Vector3d::Ones(), Vector3d::Zero()), std::uint16_t{0}),
      {}));
  value.labels.push_back(onMr);
  value.labels.push_back(damaged);
  value.mr.emplace_back();
  value.mr.back().name = "T2";
  value.mr.back().geometry = value.ct.geometry;
  for (const auto& [language, unregistered, missing] :
       {std::tuple(ReportLanguage::English, "T2', which is not registered", "missing or damaged"),
        std::tuple(ReportLanguage::German, "T2' gezeichnet, das nicht registriert", "fehlen")})
  {
    ReportOptions options = small();
    options.language = language;
    const PlanReport report = planReport(value, options);
    for (const char* id : {"distances", "structures"})
    {
      const ReportSection* section = find(report, id);
      ASSERT_TRUE(section);
      ASSERT_EQ(section->table.rows.size(), 4U) << id;
      for (const std::size_t row : {2U, 3U})
      {
        EXPECT_EQ(section->table.rows[row][0].text, row == 2 ? "facial canal" : "cochlea");
        EXPECT_TRUE(section->table.rows[row][1].isWarning);
        EXPECT_EQ(section->table.rows[row].size(), section->table.columns.size());
      }
      ASSERT_FALSE(section->paragraphs.empty());
      const std::string& text = section->paragraphs.back();
      EXPECT_NE(text.find(unregistered), std::string::npos) << text;
      EXPECT_NE(text.find(missing), std::string::npos) << text;
    }
    EXPECT_NE(find(report, "views")->paragraphs.back().find("cochlea"), std::string::npos);
  }
  value.labels.erase(value.labels.begin()); // nothing else is there
  EXPECT_EQ(find(planReport(value, small()), "distances")->table.rows.size(), 2U);
}

TEST(PlanReport, ListsTheNotesOfTheImport)
{
  scene::Case value = planned();
  value.ct.provenance = {};
  value.ct.notes = {"states no unit of length; taken as mm"};
  value.labels.front().notes = {"'chorda': voxels of 50 % and more were taken",
                                "'gone' was left out", "seen by Doe"};
  ReportOptions options = small();
  options.mayIdentifySentence = [](const std::string& text)
  { return text.find("Doe") != std::string::npos; };
  const auto texts = [](const PlanReport& report)
  {
    const ReportSection* import = find(report, "import");
    EXPECT_TRUE(import->paragraphs.empty());
    std::vector<std::string> all;
    for (const auto& row : import->table.rows)
      all.push_back(row[1].text);
    return all;
  };
  EXPECT_EQ(texts(planReport(value, options)),
            (std::vector<std::string>{"states no unit of length; taken as mm",
                                      "'chorda': voxels of 50 % and more were taken",
                                      "a note (withheld)", "a note (withheld)"}));
  options.keepIdentity = true;
  EXPECT_EQ(texts(planReport(value, options)).back(), "seen by Doe");
}

TEST(PlanReport, NamesNoEarThatNobodyStated)
{
  scene::Case value = planned();
  const auto caption = [](const scene::Case& of)
  { return planReport(of, small()).sections.front().pictures.at(2).caption; };
  const auto first = [](const scene::Case& of)
  { return planReport(of, small()).sections.front().pictures.front().caption; };
  EXPECT_EQ(caption(value), "Surgical position, left ear");
  EXPECT_EQ(first(value), "Lateral view") << "none was saved";
  scene::Case looked = value;
  looked.camera = standardCamera(value, rendering::StandardView::Superior);
  EXPECT_EQ(first(looked), "3D view as saved");
  const core::GridGeometry placed({40, 32, 32}, Vector3d::Constant(0.5), {-60.0, 0.0, 0.0});
  for (const scene::Side side : {scene::Side::Unknown, scene::Side::Both})
  {
    value.description.side = side;
    // Its image is in the middle of the scanner, as exports without a header are.
    const PlanReport report = planReport(value, small());
    ASSERT_EQ(report.sections.front().pictures.size(), 2U) << "the lateral view";
    // The middle of 40 voxels of 0.5 mm from 0 on is at x = 9.75 mm.
    EXPECT_EQ(report.sections.front().pictures.front().caption,
              "Lateral view from the patient's left; the case does not tell which ear it is");
    EXPECT_EQ(report.sections.front().paragraphs.back(),
              "The surgical position is not shown, as the case does not tell which ear it is.");
    scene::Case right = shapes::shapeCase(placed, {});
    right.description.side = side;
    EXPECT_EQ(caption(right), "Surgical position; the side is taken from where the image lies");
  }
}

TEST(PlanReport, GivesTheReasonOfARegistrationInEveryLanguage)
{
  scene::Case value = planned();
  value.mr.emplace_back();
  value.mr.back().name = "T2";
  value.mr.back().geometry = value.ct.geometry;
  value.mr.back().registered = true;
  value.mr.back().registration.emplace();
  value.mr.back().registration->verdict = scene::Registration::Verdict::Doubtful;
  value.mr.back().registration->text = "the starts end 3 mm apart";
  for (const ReportLanguage language : {ReportLanguage::English, ReportLanguage::German})
  {
    ReportOptions options = small();
    options.language = language;
    const auto remarks = find(planReport(value, options), "registration")->remarks;
    ASSERT_FALSE(remarks.empty());
    EXPECT_EQ(remarks.front(), "T2: the starts end 3 mm apart");
  }
}

TEST(PlanReport, HasTheValuesOfTheMeasurements)
{
  const scene::Case value = planned();
  const std::string html = htmlOf(planReport(value, small()));
  const Quantity width = quantitiesOf(value, value.measurements.front()).front();
  EXPECT_EQ(*width.value, 5.0);
  EXPECT_NE(html.find("data-value=\"5\" data-uncertainty=\"" + core::exactText(*width.uncertainty) +
                      "\">" + toString(width) + "<"),
            std::string::npos);
}

TEST(PlanReport, IsOneFileWithoutAnythingFromElsewhere)
{
  const PlanReport report = planReport(planned(), small());
  const std::string html = htmlOf(report);
  EXPECT_EQ(html.find("http:"), std::string::npos);
  EXPECT_EQ(html.find("https:"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = 0; (at = html.find("<img", at)) != std::string::npos; ++at)
    ++pictures;
  std::size_t data = 0;
  for (std::size_t at = 0;
       (at = html.find("src=\"data:image/png;base64,iVBOR", at)) != std::string::npos; ++at)
    ++data;
  EXPECT_EQ(pictures, data);
  const auto& nearest = find(report, "nearest")->pictures;
  EXPECT_EQ(pictures, find(report, "views")->pictures.size() + nearest.size());
  std::size_t headings = 0;
  for (std::size_t at = 0; (at = html.find("<h3>", at)) != std::string::npos; ++at)
    ++headings;
  EXPECT_EQ(headings, 2U) << "a row each";
}

// Bone hides the course of a nerve.
TEST(PlanReport, HasEachViewWithTranslucentBoneBesideTheOpaqueOne)
{
  const PlanReport report = planReport(planned(), small());
  const auto& pictures = find(report, "views")->pictures;
  ASSERT_EQ(pictures.size(), 4U);
  for (const std::size_t opaque : {0U, 2U})
  {
    EXPECT_EQ(pictures[opaque + 1].caption, pictures[opaque].caption + ", bone made translucent");
    EXPECT_NE(pictures[opaque + 1].png, pictures[opaque].png);
  }
}

// A nerve that lies all within bone, also of a transfer function of one's own.
TEST(PlanReport, ShowsWhatOpaqueBoneHidesInTheTranslucentViews)
{
  scene::Case value = planned();
  value.labels.front().structures.front().look.color = {0.0F, 1.0F, 0.0F};
  ReportOptions options = small();
  for (const bool isOwn : {false, true})
  {
    if (isOwn)
    {
      options.keepIdentity = true; // else an own function does not count
      value.boneLook.relative = false;
      value.boneLook.transfer = appearance::TransferFunction::constant({0.9F, 0.8F, 0.7F}, 0.95F);
    }
    const PlanReport report = planReport(value, options);
    const auto& pictures = find(report, "views")->pictures;
    ASSERT_EQ(pictures.size(), 4U);
    for (std::size_t n = 0; n < 4; ++n)
    {
      const rendering::Picture picture = pictureOf(pictures[n].png);
      int green = 0;
      for (std::size_t at = 0; at < picture.rgb.size(); at += 3)
        green += picture.rgb[at + 1] > picture.rgb[at] + 25 ? 1 : 0;
      if (n % 2 == 0)
        EXPECT_EQ(green, 0) << pictures[n].caption;
      else
        EXPECT_GT(green, 50) << pictures[n].caption;
    }
  }
}

TEST(PlanReport, LettersThePatientsDirectionsIn3D)
{
  ReportOptions options = small();
  options.pictureWidth = 400;
  const PlanReport report = planReport(planned(), options);
  const auto& views = find(report, "views")->pictures;
  ASSERT_EQ(views.size(), 4U);
  for (const ReportPicture& view : views)
  {
    const rendering::Picture picture = pictureOf(view.png);
    ASSERT_EQ(picture.width, 400);
    ASSERT_EQ(picture.height, 300);
    // White, as neither bone nor structures are.
    const auto inkAround = [&picture](int column, int row)
    {
      int ink = 0;
      for (int y = std::max(row - 15, 0); y < std::min(row + 15, picture.height); ++y)
        for (int x = std::max(column - 15, 0); x < std::min(column + 15, picture.width); ++x)
        {
          const std::uint8_t* pixel = picture.pixel(x, y);
          ink += pixel[0] > 150 && pixel[2] >= pixel[0] ? 1 : 0;
        }
      return ink;
    };
    for (const auto& [column, row] :
         {std::pair(10, 150), std::pair(390, 150), std::pair(200, 10), std::pair(200, 290)})
      EXPECT_GT(inkAround(column, row), 5) << view.caption << ": " << column << ", " << row;
  }
}

// As `petrous slice` writes them, with letters and scale bar, and a cross in the middle.
TEST(PlanReport, LabelsSlicesAsOtherPicturesOfSlicesAre)
{
  const scene::Case value = planned();
  const PlanReport report = planReport(value, small());
  const auto& pictures = find(report, "nearest")->pictures;
  const auto distances = dissectionDistances(value);
  ASSERT_FALSE(distances.empty());
  ASSERT_EQ(distances.front().name, "facial nerve");
  ASSERT_GE(pictures.size(), 3U);
  const std::array<SliceOrientation, 3> orientations{
      SliceOrientation::Axial, SliceOrientation::Coronal, SliceOrientation::Sagittal};
  for (std::size_t n = 0; n < 3; ++n)
  {
    const SliceGeometry slice(orientations[n], distances.front().place, 40.0 / 96.0, 96, 96);
    rendering::Picture expected = labelledSlice(
        SlicePresenter(value).draw(slice, displayOf(value).bone), slice, {nameOf(orientations[n])});
    addCross(expected, {47.5, 47.5});
    EXPECT_EQ(pictureOf(pictures[n].png).rgb, expected.rgb) << nameOf(orientations[n]);
  }
}

// One that the drill keeps off is shown as far as one that is warned of.
TEST(PlanReport, HasSlicesOfWhatTheDrillIsKeptFrom)
{
  const core::GridGeometry grid({48, 24, 24}, Vector3d::Constant(0.5), {0.0, 0.0, 0.0});
  scene::Case value =
      shapes::shapeCase(grid, {{"part", shapes::ball({17.0, 6.0, 6.0}, 1.0)}}); // 8 mm away
  value.dissection.beginStroke({});
  value.dissection.cut({{6.0, 6.0, 6.0}, {6.0, 6.0, 6.0}, 2.0});
  value.dissection.endStroke();
  auto& look = value.labels.front().structures.front().look;
  const auto count = [&]
  {
    const PlanReport report = planReport(value, small());
    return find(report, "nearest")->pictures.size();
  };
  look.warning = 0.0;
  look.drillable = true;
  EXPECT_EQ(count(), 0U);
  look.drillable = false;
  EXPECT_EQ(count(), 4U);
  look.solid = false; // opened, and no danger
  EXPECT_EQ(count(), 0U);
  look.warning = 1.0;
  EXPECT_EQ(count(), 4U);
}

TEST(PlanReport, HasSlicesWhereTheCavityIsNearestToStructures)
{
  const PlanReport report = planReport(planned(), small());
  const ReportTable& distances = find(report, "distances")->table;
  const auto& pictures = find(report, "nearest")->pictures;
  ASSERT_EQ(distances.rows.size(), 2U);
  ASSERT_EQ(pictures.size(), 8U);
  const std::vector<std::string> planes{"Axial", "Coronal", "Sagittal", "Along the distance"};
  for (std::size_t n = 0; n < pictures.size(); ++n)
  {
    EXPECT_EQ(pictures[n].caption, planes[n % 4]);
    EXPECT_EQ(pictures[n].inRow, 4);
    const auto& row = distances.rows[n / 4];
    EXPECT_EQ(pictures[n].heading, n % 4 == 0 ? row[0].text + ": " + row[1].text : "");
  }
}

// Who hid it in the window wants to see how near the cavity is all the same.
TEST(PlanReport, DrawsAHiddenStructureInItsOwnSlices)
{
  const auto slices = [](const scene::Case& value)
  {
    std::vector<std::vector<std::uint8_t>> all;
    const PlanReport report = planReport(value, small());
    for (const ReportPicture& picture : find(report, "nearest")->pictures)
      all.push_back(picture.png);
    return all;
  };
  scene::Case value = planned();
  const auto shown = slices(value);
  for (scene::StructurePart& structure : value.labels.front().structures)
    structure.look.shown = false;
  EXPECT_EQ(slices(value), shown);
  value.labels.front().structures[0].look.color = {0.0F, 0.0F, 1.0F};
  EXPECT_NE(slices(value), shown) << "it is in the slices";
}

TEST(PlanReport, HasNoPlaneAlongADistanceThatIsNone)
{
  scene::Case value = planned();
  value.dissection.beginStroke({});
  value.dissection.cut({{7.0, 8.0, 8.0}, {7.0, 8.0, 8.0}, 2.0}); // into the nerve
  value.dissection.endStroke();
  const PlanReport report = planReport(value, small());
  const auto& pictures = find(report, "nearest")->pictures;
  ASSERT_EQ(pictures.size(), 7U);
  EXPECT_EQ(pictures[0].heading.substr(0, 21), "facial nerve: reached");
  EXPECT_FALSE(pictures[3].heading.empty());
}

TEST(PlanReport, HasSlicesOfTheEightNearestAndNamesTheRest)
{
  // A burr of 2 mm at the left end, and balls at growing distances in front of it.
  const core::GridGeometry grid({104, 24, 80}, Vector3d::Constant(0.5), {0.0, 0.0, 0.0});
  const Vector3d burr(6.0, 6.0, 20.0);
  std::vector<shapes::Shape> balls;
  for (int n = 0; n < 9; ++n) // 5 to 13 mm from the burr's centre, around it
  {
    const double turn = 0.35 * (n - 4);
    const Vector3d towards(std::cos(turn), 0.0, std::sin(turn));
    balls.push_back({"part " + std::string(1, static_cast<char>('a' + n)),
                     shapes::ball(burr + (5.0 + n) * towards, 0.8)});
  }
  balls.push_back({"far part", shapes::ball({45.0, 6.0, 20.0}, 1.0)});
  scene::Case value = shapes::shapeCase(grid, balls);
  for (scene::StructurePart& structure : value.labels.front().structures)
    structure.look.warning = 1.0;
  value.dissection.beginStroke({});
  value.dissection.cut({burr, burr, 2.0});
  value.dissection.endStroke();
  const PlanReport report = planReport(value, small());
  const ReportSection* nearest = find(report, "nearest");
  ASSERT_EQ(nearest->pictures.size(), 32U);
  for (std::size_t n = 0; n < 8; ++n)
    EXPECT_EQ(nearest->pictures[4 * n].heading.substr(0, 7),
              "part " + std::string(1, static_cast<char>('a' + n)) + ":");
  ASSERT_EQ(nearest->paragraphs.size(), 3U);
  EXPECT_EQ(nearest->paragraphs[1], "Farther than 15 mm, and without slices: far part.");
  EXPECT_EQ(nearest->paragraphs[2], "Only the first 8 have slices; without are: part i.");
  EXPECT_EQ(find(report, "distances")->table.rows.size(), 10U);
}

TEST(PlanReport, SaysWhyNoStructureHasSlices)
{
  scene::Case value = planned();
  for (scene::StructurePart& structure : value.labels.front().structures)
    structure.look.solid = false; // lumens, not warned of
  const PlanReport lumens = planReport(value, small());
  EXPECT_EQ(find(lumens, "nearest")->paragraphs.at(0),
            "The dissection comes near no structure that is warned of or kept from the drill.");
  EXPECT_TRUE(find(lumens, "nearest")->pictures.empty());
  ASSERT_TRUE(find(lumens, "places")) << "the crosshair instead";
  EXPECT_EQ(find(lumens, "places")->pictures.size(), 3U);
  EXPECT_EQ(find(lumens, "places")->pictures.front().heading, "crosshair");

  value.dissection = dissection::Dissection(value.ct.geometry);
  const PlanReport none = planReport(value, small());
  EXPECT_EQ(find(none, "nearest")->paragraphs.at(0), "Nothing was drilled on this approach.");
  EXPECT_TRUE(find(none, "nearest")->pictures.empty());
}

// Beside the numbers, not only where the import is told of.
TEST(PlanReport, SaysWhatIsGuessedWhereTheNumbersStand)
{
  scene::Case value = planned();
  const auto guessedOf = [](const PlanReport& report, const char* id)
  {
    const ReportTable& table = find(report, id)->table;
    std::vector<std::string> texts;
    if (table.columns.back() == "Guessed")
      for (const auto& row : table.rows)
        texts.push_back(row.back().text);
    return texts;
  };
  const PlanReport beside = planReport(value, small());
  EXPECT_TRUE(guessedOf(beside, "distances").empty()) << "slices in which no structure lies";
  EXPECT_NE(find(beside, "distances")->paragraphs.at(0).find("slices 4-5 of 32 interpolated"),
            std::string::npos);

  // The nerve's voxels have their centres at 6 to 10 mm: slices 13 to 21.
  value.ct.provenance.interpolated = {{3, 4}, {15, 16}};
  value.measurements.front().structure = "facial nerve";
  const PlanReport within = planReport(value, small());
  const std::string text = "slices 16-17 of CT, in which it lies, are interpolated";
  EXPECT_EQ(guessedOf(within, "distances"), (std::vector<std::string>{text, ""}));
  EXPECT_EQ(guessedOf(within, "structures"), (std::vector<std::string>{text, ""}));
  EXPECT_TRUE(find(within, "distances")->table.rows[0].back().isWarning);
  EXPECT_NE(find(within, "nearest")->pictures[0].heading.find("guessed: " + text),
            std::string::npos);
  EXPECT_EQ(find(within, "nearest")->pictures[4].heading.find("guessed"), std::string::npos);
  EXPECT_NE(find(within, "measurements")->table.rows[0][3].text.find(text), std::string::npos);

  value.ct.provenance = {};
  value.labels.front().structures[1].tubes = {12.0, 3.5, 7};
  ReportOptions options = small();
  for (const auto& [language, traced] :
       {std::pair(ReportLanguage::English,
                  "traced between points alone along 3.5 of 12.0 mm, as the image does not resolve "
                  "it there; thinner than the voxels, and drawn one voxel wide in 7 of them"),
        std::pair(
            ReportLanguage::German,
            "auf 3,5 von 12,0 mm allein zwischen Punkten verfolgt, da das Bild sie dort nicht "
            "auflöst; dünner als die Voxel und in 7 von ihnen ein Voxel breit gezeichnet")})
  {
    options.language = language;
    const PlanReport report = planReport(value, options);
    EXPECT_EQ(find(report, "distances")->table.rows.at(1).back().text, traced);
    EXPECT_EQ(find(report, "structures")->table.rows.at(1).back().text, traced);
  }
  value.labels.front().structures[1].tubes = {12.0, 0.5, 0}; // of which the window does not warn
  EXPECT_TRUE(guessedOf(planReport(value, small()), "distances").empty());
  value.labels.front().provenance.isFrameAssumed = true;
  const auto assumed = guessedOf(planReport(value, small()), "distances");
  ASSERT_EQ(assumed.size(), 2U);
  for (const std::string& guess : assumed)
    EXPECT_NE(guess.find("frame of reference"), std::string::npos) << guess;
}

TEST(PlanReport, SaysTheNotesOfAStructureBeneathItsNumbers)
{
  scene::Case value = planned();
  value.labels.front().notes = {"'chorda': voxels of 50 % and more were taken",
                                "states no unit of length; taken as mm"};
  const auto notes = [&value](const char* id)
  {
    const PlanReport report = planReport(value, small());
    std::vector<std::string> found = find(report, id)->remarks;
    found.erase(found.begin()); // what the table has
    return found;
  };
  for (const char* id : {"distances", "structures"})
    EXPECT_EQ(notes(id), std::vector<std::string>{"'chorda': voxels of 50 % and more were taken"})
        << id << ": what is of the whole file is of none alone";
  value.labels.front().structures.resize(1); // all of its file
  value.labels.front().notes = {"states no unit of length; taken as mm"};
  EXPECT_EQ(notes("distances"),
            std::vector<std::string>{"facial nerve: states no unit of length; taken as mm"});
}

TEST(PlanReport, WithholdsNamesThatTellWhoThePatientIs)
{
  scene::Case value = planned();
  value.name = "Erika Mustermann";
  value.labels.front().structures[0].name = "Mustermann nerve";
  value.measurements.front().name = "for Mustermann";
  value.measurements.front().kind = scene::Measurement::Kind::Length;
  value.measurements.front().structure = "Mustermann nerve";
  value.description.diagnosis = "seen by Mustermann";
  value.description.procedure = "cochlear implant";
  value.description.note = "Mustermann, 1970";
  scene::renameBranch(value, "second way", "Mustermann way");
  ReportOptions options = small();
  options.mayIdentify = [](const std::string& text)
  { return text.find("Mustermann") != std::string::npos; };
  const std::string html = htmlOf(planReport(value, options));
  EXPECT_EQ(html.find("Mustermann"), std::string::npos);
  EXPECT_NE(html.find("Case 3F2A90C1"), std::string::npos);
  EXPECT_NE(html.find("cochlear implant"), std::string::npos);
  EXPECT_NE(html.find("2026-12-24"), std::string::npos);
  EXPECT_NE(html.find("withheld"), std::string::npos);
  options.withDate = false;
  const PlanReport undated = planReport(value, options);
  EXPECT_EQ(htmlOf(undated).find("2026-12-24"), std::string::npos);
  ASSERT_EQ(undated.mayIdentify.size(), 1U) << "what was kept as typed";
  EXPECT_NE(undated.mayIdentify[0].find("'cochlear implant'"), std::string::npos);
  EXPECT_EQ(undated.mayIdentify[0].find("'main'"), std::string::npos);
  options.isOfField = [](const std::string&) { return true; };
  EXPECT_TRUE(planReport(value, options).mayIdentify.empty());
  options.keepIdentity = true;
  const PlanReport kept = planReport(value, options);
  EXPECT_NE(htmlOf(kept).find("Mustermann nerve"), std::string::npos);
  EXPECT_FALSE(kept.mayIdentify.empty());
  options = small();
  options.mayIdentify = nullptr; // not known: all that was typed
  EXPECT_EQ(htmlOf(planReport(value, options)).find("Mustermann"), std::string::npos);
}

// As the language writes numbers and dates; the values beside them stay as they are.
TEST(PlanReport, WritesGermanNumbersAndDates)
{
  scene::Case value = planned();
  value.description.date = "2026-11-27";
  ReportOptions options = small();
  options.made = "2026-11-20";
  const PlanReport english = planReport(value, options);
  options.language = ReportLanguage::German;
  const PlanReport german = planReport(value, options);
  const auto comma = [](std::string text)
  {
    std::replace(text.begin(), text.end(), '.', ',');
    return text;
  };
  ASSERT_EQ(german.sections.size(), english.sections.size());
  int numbers = 0;
  for (std::size_t n = 0; n < german.sections.size(); ++n)
  {
    const ReportTable& one = german.sections[n].table;
    const ReportTable& other = english.sections[n].table;
    ASSERT_EQ(one.rows.size(), other.rows.size());
    for (std::size_t row = 0; row < one.rows.size(); ++row)
      for (std::size_t column = 0; column < one.rows[row].size(); ++column)
      {
        const ReportCell& cell = one.rows[row][column];
        EXPECT_EQ(cell.value, other.rows[row][column].value);
        if (!cell.isNumber || !cell.value || cell.text.find_first_of("0123456789") != 0)
          continue;
        EXPECT_EQ(cell.text.find('.'), std::string::npos) << cell.text;
        const std::string number = comma(other.rows[row][column].text);
        EXPECT_EQ(cell.text.substr(0, cell.text.find(' ')), number.substr(0, number.find(' ')));
        ++numbers;
      }
  }
  EXPECT_GT(numbers, 5);
  const auto factsOf = [](const PlanReport& report)
  { return std::map<std::string, std::string>(report.facts.begin(), report.facts.end()); };
  EXPECT_EQ(factsOf(german).at("Geplant für"), "27.11.2026");
  EXPECT_EQ(factsOf(german).at("Bericht vom"), "20.11.2026");
  EXPECT_EQ(factsOf(english).at("Planned for"), "2026-11-27");
  EXPECT_NE(german.stamp.find("27.11.2026"), std::string::npos);
}

TEST(PlanReport, SpeaksGerman)
{
  ReportOptions options = small();
  options.language = ReportLanguage::German;
  const PlanReport report = planReport(planned(), options);
  EXPECT_EQ(report.title, "Operationsplan");
  EXPECT_EQ(report.side, "Linke Seite");
  EXPECT_EQ(find(report, "import")->table.rows[0][1].text,
            "Schichten 4-5 von 32 zwischen Nachbarn interpoliert");
  EXPECT_EQ(find(report, "strokes")->table.rows[0][1].text, "4,0 mm, Diamant");
  // No cell, remark or caption is a phrase of the program in English.
  const auto expectGerman = [](const std::string& text)
  { EXPECT_EQ(germanPhrases().text(text), text) << "not German"; };
  for (const ReportSection& section : report.sections)
  {
    for (const std::string& text : section.paragraphs)
      expectGerman(text);
    for (const std::string& text : section.remarks)
      expectGerman(text);
    for (const ReportPicture& picture : section.pictures)
    {
      expectGerman(picture.caption);
      expectGerman(picture.heading);
    }
    for (const auto& row : section.table.rows)
      for (const ReportCell& cell : row)
        expectGerman(cell.text);
  }
  EXPECT_NE(find(report, "measurements")->table.rows[0][3].text.find("gesetzt auf dem CT"),
            std::string::npos)
      << find(report, "measurements")->table.rows[0][3].text;
  // Titles and columns, all that does not come from the case, differ from the English ones.
  const PlanReport english = planReport(planned(), small());
  for (std::size_t n = 0; n < report.sections.size(); ++n)
    EXPECT_NE(report.sections[n].title, english.sections[n].title);
}

// What the window says in German of the same case, the paper does, too.
TEST(PlanReport, SaysTheNotesAndReasonsOfItsPartsInGerman)
{
  scene::Case value = planned();
  value.ct.notes = {"The slices are numbered from 1080 to 1245; the stack has no gap, but its ends "
                    "may be missing. Look whether all of the skull base that is needed is there."};
  value.labels.front().notes = {"states no unit of length; taken as mm"};
  value.mr.emplace_back();
  value.mr.back().name = "T2 0.5";
  value.mr.back().geometry = value.ct.geometry;
  value.mr.back().registered = true;
  scene::Registration& how = value.mr.back().registration.emplace();
  how.verdict = scene::Registration::Verdict::Good;
  how.text = "Repeated fits agree; 95 of 100 errors are below 0.32 mm.";
  how.error.emplace();
  how.error->place = "the centre of the CT";
  ReportOptions options = small();
  options.language = ReportLanguage::German;
  const PlanReport report = planReport(value, options);
  EXPECT_EQ(find(report, "registration")->remarks,
            std::vector<std::string>{"T2 0.5: Wiederholte Anpassungen stimmen überein; 95 von 100 "
                                     "Fehlern liegen unter 0,32 mm."});
  EXPECT_EQ(find(report, "registration")->table.rows[0][6].text, "die Mitte des CT");
  const auto& notes = find(report, "import")->table.rows;
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_EQ(notes[1][1].text.find("Die Schichten sind von 1080 bis 1245 nummeriert"), 0U)
      << notes[1][1].text;
  EXPECT_EQ(notes[2][1].text, "nennt keine Längeneinheit; als mm genommen");
  EXPECT_EQ(find(report, "approaches")->table.rows[0][0].text.find("Hauptzugang"), 0U);
  EXPECT_EQ(find(planReport(value, small()), "approaches")->table.rows[0][0].text.find("main"), 0U);
}

// As German writes them, wherever they stand; a name stays as it was given.
TEST(PlanReport, HasNoNumberWithAPointInGerman)
{
  ReportOptions options = small();
  options.language = ReportLanguage::German;
  const PlanReport report = planReport(planned(), options);
  int commas = 0;
  const auto check = [&commas](const std::string& text)
  {
    const auto isDigit = [&text](std::size_t at)
    { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
    for (std::size_t at = 1; at + 1 < text.size(); ++at)
      if (isDigit(at - 1) && isDigit(at + 1))
      {
        EXPECT_NE(text[at], '.') << text;
        commas += text[at] == ',' ? 1 : 0;
      }
  };
  for (const ReportSection& section : report.sections)
  {
    std::for_each(section.paragraphs.begin(), section.paragraphs.end(), check);
    std::for_each(section.remarks.begin(), section.remarks.end(), check);
    for (const auto& row : section.table.rows)
      for (const ReportCell& cell : row)
        check(cell.text);
  }
  EXPECT_GT(commas, 10);
  const auto german = [](const char* text) { return reportText(ReportLanguage::German, text); };
  EXPECT_EQ(german("(-36.5, 2.5, -0.5)"), "(-36,5; 2,5; -0,5)") << "six numbers else";
  EXPECT_EQ(german("1.5, and 2.25, or 3"), "1,5, and 2,25, or 3");
}

TEST(PlanReport, CanBeCancelled)
{
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress(
      [&token](double fraction, const std::string&)
      {
        if (fraction > 0.5)
          token->cancel();
      },
      token);
  EXPECT_THROW(planReport(planned(), small(), progress), core::CancelledError);
}

TEST(ReportHtml, EncodesAsRfc4648)
{
  const auto of = [](const std::string& text)
  { return base64(std::vector<std::uint8_t>(text.begin(), text.end())); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64({0xfb, 0xff, 0xfe}), "+//+");
  EXPECT_EQ(escapedHtml("<a href=\"x\">'&"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;");
}
