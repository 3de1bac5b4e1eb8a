#include "petrous/Presenters/AppearanceEditor.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Presenters/IntensityDisplay.h"

using namespace petrous;
using presenters::AppearanceEditor;
using presenters::AppearanceHistograms;
using presenters::OpacityAxis;

namespace
{

template <class T>
volume::IntensityVolume imageOf(const core::GridGeometry& grid, const std::vector<T>& values,
                                std::optional<double> padding = std::nullopt)
{
  auto voxels = std::make_shared<volume::Volume<T>>(grid);
  std::copy(values.begin(), values.end(), voxels->data());
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<T>>(voxels), padding);
}

std::shared_ptr<const volume::LabelMap> labelsOf(const core::GridGeometry& grid,
                                                 const std::vector<std::uint16_t>& values)
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid);
  std::copy(values.begin(), values.end(), voxels->data());
  return std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
}

const core::GridGeometry kLine({8, 1, 1}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());

// The counts of single values: bins of one unit.
std::uint64_t countOf(const volume::IntensityHistogram& histogram, double value)
{
  const double bin = std::floor((value - histogram.lower()) / histogram.binWidth());
  return histogram.bins().at(static_cast<std::size_t>(bin));
}

// A CT of 8 voxels, structures "nerve" (2 voxels) and "canal" (a lumen, 1 voxel) in it, and an MR.
scene::Case lineCase()
{
  scene::Case value;
  value.name = "line";
  value.ct.name = "ct";
  value.ct.geometry = kLine;
  value.ct.range = {-1000.0, 1600.0};
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      imageOf<std::int16_t>(kLine, {-1000, -1000, 40, 60, 400, 900, 1500, 1600}));
  scene::ImagePart mr = value.ct;
  mr.name = "t2";
  mr.range = {0.0, 80.0};
  mr.volume = std::make_shared<const volume::IntensityVolume>(
      imageOf<std::uint16_t>(kLine, {0, 0, 10, 70, 80, 5, 5, 5}));
  mr.registered = true;
  value.mr.push_back(mr);
  scene::LabelPart part;
  part.labels = labelsOf(kLine, {2, 0, 1, 1, 0, 0, 0, 0});
  scene::StructurePart nerve;
  nerve.name = "nerve";
  nerve.index = 1;
  nerve.look = appearance::StructurePresets::builtIn().preset("nerve");
  scene::StructurePart canal;
  canal.name = "canal";
  canal.index = 2;
  canal.look = appearance::StructurePresets::builtIn().preset("ear-canal");
  part.structures = {nerve, canal};
  value.labels.push_back(part);
  value.dissection = dissection::Dissection(value.ct.geometry);
  return value;
}

class AppearanceEditorTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    std::string name = (std::filesystem::temp_directory_path() / "appearance-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    m_folder = name;
    m_model = std::make_unique<presenters::WorkstationModel>(library::Library(m_folder));
    m_editor = std::make_unique<AppearanceEditor>(*m_model);
    open(lineCase());
  }
  void TearDown() override
  {
    m_editor.reset();
    m_model.reset();
    std::filesystem::remove_all(m_folder);
  }
  void open(scene::Case value)
  {
    m_model->adopt(std::move(value));
    m_model->prepareNow();
    m_editor->refresh();
  }
  void count()
  {
    const std::uint64_t of = m_model->shownAs();
    if (const auto counting = m_editor->beginCounting())
      m_editor->counted(counting({}), of);
  }
  const appearance::StructureAppearance& look(const std::string& structure) const
  {
    return scene::findStructure(m_model->value(), structure)->look;
  }
  const std::vector<appearance::ControlPoint>& points() const
  {
    return m_editor->selected()->points;
  }
  void setPoints(const std::string& points) { m_editor->setJson("{\"points\": [" + points + "]}"); }

  std::filesystem::path m_folder;
  std::unique_ptr<presenters::WorkstationModel> m_model;
  std::unique_ptr<AppearanceEditor> m_editor;
};

} // namespace

TEST(OpacityAxis, IsLogarithmicWithZeroAtItsFoot)
{
  EXPECT_EQ(OpacityAxis::height(0.0), 0.0);
  EXPECT_EQ(OpacityAxis::height(1.0), 1.0);
  EXPECT_EQ(OpacityAxis::height(7.0), 1.0);
  // Each decade has the same height.
  const double decade = OpacityAxis::height(0.01) - OpacityAxis::height(0.001);
  EXPECT_NEAR(OpacityAxis::height(0.1) - OpacityAxis::height(0.01), decade, 1e-12);
  EXPECT_NEAR(OpacityAxis::height(1.0) - OpacityAxis::height(0.1), decade, 1e-12);
  EXPECT_NEAR(OpacityAxis::height(0.0005), 0.5 * OpacityAxis::height(0.001), 1e-12);
  for (const double opacity : {0.0, 0.0002, 0.001, 0.037, 0.5, 1.0})
    EXPECT_NEAR(OpacityAxis::opacity(OpacityAxis::height(opacity)), opacity, 1e-12);
}

TEST(OpacityAxis, RoundsToThreeDigits)
{
  EXPECT_EQ(OpacityAxis::rounded(0.123456), 0.123);
  EXPECT_EQ(OpacityAxis::rounded(0.0123456), 0.0123);
  EXPECT_EQ(OpacityAxis::rounded(0.00123456), 0.0012);
  EXPECT_EQ(OpacityAxis::rounded(0.00002), 0.0);
  EXPECT_EQ(OpacityAxis::rounded(0.9999), 1.0);
}

TEST(HistogramsWithin, CountEachSegmentsVoxels)
{
  const auto image = imageOf<std::int16_t>(kLine, {0, 1, 2, 2, 3, 5, 5, -9}, -9.0);
  const auto within =
      presenters::histogramsWithin(*labelsOf(kLine, {1, 7, 7, 7, 1, 0, 7, 7}), image, {});
  ASSERT_EQ(within.size(), 2u);
  EXPECT_EQ(within.at(1).count(), 2u);
  EXPECT_EQ(countOf(within.at(1), 0), 1u);
  EXPECT_EQ(countOf(within.at(1), 3), 1u);
  EXPECT_EQ(within.at(7).count(), 4u) << "the padding does not count";
  EXPECT_EQ(countOf(within.at(7), 1), 1u);
  EXPECT_EQ(countOf(within.at(7), 2), 2u);
  EXPECT_EQ(countOf(within.at(7), 5), 1u);
}

TEST(HistogramsWithin, ReadTheImageWhereTheLabelsLie)
{
  // Labels at x = 0.5 and 3.5 in their own space, 1 mm to the left of the image's: 1.5 and 4.5.
  const core::GridGeometry coarse({2, 1, 1}, {3.0, 1.0, 1.0}, {0.5, 0.0, 0.0});
  const auto image = imageOf<std::int16_t>(kLine, {0, 10, 20, 30, 40, 50, 60, 70});
  const core::RigidTransform moved(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0});
  const auto within = presenters::histogramsWithin(*labelsOf(coarse, {1, 1}), image, moved);
  EXPECT_EQ(within.at(1).count(), 2u);
  EXPECT_EQ(countOf(within.at(1), 15), 1u);
  EXPECT_EQ(countOf(within.at(1), 45), 1u);
  const core::RigidTransform away(Eigen::Quaterniond::Identity(), {4.0, 0.0, 0.0});
  EXPECT_EQ(presenters::histogramsWithin(*labelsOf(coarse, {1, 1}), image, away).at(1).count(), 1u)
      << "the second one lies beyond the image";
}

TEST_F(AppearanceEditorTest, HasBoneSoftTissueAndEachStructure)
{
  ASSERT_EQ(m_editor->parts().size(), 4u);
  EXPECT_EQ(m_editor->parts()[0].name, "ct");
  EXPECT_EQ(m_editor->parts()[1].name, scene::kSoftTissue);
  EXPECT_EQ(m_editor->parts()[2].name, "nerve");
  EXPECT_EQ(m_editor->parts()[3].name, "canal");
  EXPECT_EQ(m_editor->selected()->name, "ct");
  const auto axis = m_editor->axis();
  EXPECT_EQ(axis.image, "CT");
  EXPECT_EQ(axis.text(299.6), "300 HU");
  EXPECT_EQ(axis.least, -1000.0);
  EXPECT_GE(axis.most, 2500.0);
  m_model->close();
  m_editor->refresh();
  EXPECT_EQ(m_editor->selected(), nullptr);
  EXPECT_FALSE(m_editor->beginCounting());
}

TEST_F(AppearanceEditorTest, AddsAPointOfWhatIsThere)
{
  setPoints(R"({"value": 0, "color": [0, 0, 1], "opacity": 0.2, "specular": 0},
               {"value": 100, "color": [1, 0, 1], "opacity": 0.4, "specular": 1})");
  ASSERT_TRUE(m_editor->addPoint(25.3));
  ASSERT_EQ(points().size(), 3u);
  EXPECT_EQ(m_editor->point(), 1u);
  EXPECT_EQ(points()[1].value, 25.0);
  EXPECT_NEAR(points()[1].color[0], 0.25F, 1e-6F);
  EXPECT_EQ(points()[1].color[2], 1.0F);
  EXPECT_NEAR(points()[1].opacity, 0.25F, 1e-6F);
  EXPECT_NEAR(points()[1].specular, 0.25F, 1e-6F);
  EXPECT_FALSE(m_editor->addPoint(100.2)) << "one is there";
  EXPECT_EQ(m_editor->point(), 2u);
  EXPECT_EQ(points().size(), 3u);
  ASSERT_TRUE(m_editor->addPoint(300.0, 0.75));
  EXPECT_EQ(points()[3].opacity, 0.75F);
}

TEST_F(AppearanceEditorTest, APointStaysBetweenItsNeighbours)
{
  m_editor->select("nerve");
  setPoints(R"({"value": 0, "color": [1, 1, 1], "opacity": 0.2},
               {"value": 50, "color": [1, 1, 1], "opacity": 0.3},
               {"value": 100, "color": [1, 1, 1], "opacity": 0.4})");
  m_editor->selectPoint(1);
  auto point = points()[1];
  point.value = 70.4;
  point.opacity = 1.5F;
  point.specular = 0.5F;
  m_editor->setPoint(point);
  EXPECT_EQ(points()[1].value, 70.0);
  EXPECT_EQ(points()[1].opacity, 1.0F);
  EXPECT_EQ(points()[1].specular, 0.5F);
  point.value = 4000.0;
  m_editor->setPoint(point);
  EXPECT_EQ(points()[1].value, 99.0);
  point.value = -4000.0;
  m_editor->setPoint(point);
  EXPECT_EQ(points()[1].value, 1.0);
  EXPECT_TRUE(*look("nerve").transfer == m_editor->selected()->transfer);
  EXPECT_FALSE(look("nerve").relative);
}

TEST_F(AppearanceEditorTest, RemovesPointsDownToOneColour)
{
  m_editor->select("nerve");
  setPoints(R"({"value": 0, "color": [1, 1, 1], "opacity": 0.2},
               {"value": 50, "color": [1, 1, 1], "opacity": 0.3})");
  m_editor->removePoint();
  EXPECT_EQ(points().size(), 2u) << "none is selected";
  m_editor->selectPoint(0);
  m_editor->removePoint();
  ASSERT_EQ(points().size(), 1u);
  EXPECT_EQ(points()[0].value, 50.0);
  EXPECT_EQ(m_editor->point(), 0u);
  m_editor->removePoint();
  EXPECT_TRUE(points().empty());
  EXPECT_FALSE(look("nerve").transfer);
  EXPECT_FALSE(m_editor->point());
}

TEST_F(AppearanceEditorTest, ColoursAPointOrTheWholePart)
{
  m_editor->select("nerve");
  setPoints(R"({"value": 0, "color": [1, 1, 1], "opacity": 0.2},
               {"value": 50, "color": [1, 1, 1], "opacity": 0.3})");
  m_editor->selectPoint(1);
  m_editor->setColor({1.0F, 0.0F, 0.0F});
  EXPECT_EQ(points()[1].color, (std::array<float, 3>{1.0F, 0.0F, 0.0F}));
  EXPECT_EQ(points()[0].color, (std::array<float, 3>{1.0F, 1.0F, 1.0F}));
  m_editor->selectPoint({});
  m_editor->setColor({0.0F, 0.0F, 0.5F});
  EXPECT_EQ(look("nerve").color, (std::array<float, 3>{0.0F, 0.0F, 0.5F}));
  EXPECT_EQ(points()[0].color[0], 0.0F);
}

TEST_F(AppearanceEditorTest, HistogramsAreOfTheImageThatAPartReads)
{
  EXPECT_EQ(m_editor->imageHistogram(), nullptr);
  count();
  ASSERT_TRUE(m_editor->imageHistogram());
  EXPECT_EQ(m_editor->imageHistogram()->count(), 8u);
  EXPECT_EQ(m_editor->insideHistogram(), nullptr) << "bone";
  m_editor->select("nerve");
  ASSERT_TRUE(m_editor->insideHistogram());
  EXPECT_EQ(m_editor->insideHistogram()->count(), 2u); // 40 and 60 HU
  EXPECT_LE(m_editor->insideHistogram()->range().min, 40.0);
  EXPECT_GE(m_editor->insideHistogram()->range().max, 60.0);
  EXPECT_FALSE(m_editor->beginCounting()) << "all are there";

  m_editor->setSource("t2");
  EXPECT_EQ(m_editor->insideHistogram(), nullptr);
  count();
  ASSERT_TRUE(m_editor->insideHistogram());
  EXPECT_EQ(m_editor->insideHistogram()->count(), 2u); // 10 and 70
  EXPECT_EQ(countOf(*m_editor->insideHistogram(), 10), 1u);
  EXPECT_EQ(countOf(*m_editor->insideHistogram(), 70), 1u);
  EXPECT_EQ(m_editor->axis().image, "t2");
  EXPECT_EQ(m_editor->axis().unit, "");
  EXPECT_EQ(m_editor->axis().most, 80.0);
}

TEST_F(AppearanceEditorTest, HistogramsGoWithTheCase)
{
  count();
  ASSERT_TRUE(m_editor->imageHistogram());
  m_model->adopt(lineCase());
  m_model->prepareNow();
  m_editor->refresh();
  EXPECT_EQ(m_editor->imageHistogram(), nullptr);
  const auto counting = m_editor->beginCounting();
  ASSERT_TRUE(counting);
  EXPECT_FALSE(m_editor->beginCounting()) << "one at a time";
  m_editor->counted(counting({}), m_model->shownAs() - 1);
  EXPECT_EQ(m_editor->imageHistogram(), nullptr) << "of another case";
}

TEST_F(AppearanceEditorTest, APartsOfOtherImagesAreNotOnTheAxis)
{
  EXPECT_EQ(m_editor->onAxis().size(), 3u);
  m_editor->select("nerve");
  m_editor->setSource("t2");
  EXPECT_EQ(m_editor->onAxis().size(), 1u);
  m_editor->select("ct");
  EXPECT_EQ(m_editor->onAxis().size(), 2u);
  m_editor->selectNext(1);
  EXPECT_EQ(m_editor->selected()->name, "canal");
  m_editor->selectNext(1);
  EXPECT_EQ(m_editor->selected()->name, "ct");
  auto hidden = look("canal");
  hidden.shown = false;
  m_model->setLook("canal", hidden);
  m_editor->refresh();
  EXPECT_EQ(m_editor->onAxis().size(), 1u);
}

TEST_F(AppearanceEditorTest, SoftTissueIsEditedInHounsfieldUnits)
{
  m_model->setIso(700.0);
  m_editor->select(AppearanceEditor::kSoftTissue);
  ASSERT_FALSE(points().empty());
  EXPECT_EQ(points().front().value, -700.0) << "whatever the threshold";
  EXPECT_EQ(m_editor->notice(), "");
  EXPECT_FALSE(m_editor->canFit());
  EXPECT_EQ(m_editor->insideHistogram(), nullptr);
  const auto before = m_model->value().softTissue;
  m_editor->selectPoint(1);
  auto point = points()[1];
  point.opacity = 0.3F;
  m_editor->setPoint(point);
  EXPECT_FALSE(m_model->value().softTissue.relative);
  EXPECT_EQ(m_model->value().softTissue.transfer->points()[1].opacity, 0.3F);
  EXPECT_EQ(m_model->value().softTissue.transfer->points()[1].value, -400.0);
  m_model->undo();
  EXPECT_TRUE(m_model->value().softTissue == before);
  m_editor->refresh();
  m_editor->setSurfaceOpacity(0.5);
  EXPECT_EQ(m_model->value().softTissue.opacity, 0.5F);
  EXPECT_EQ(points()[1].opacity, 0.12F) << "a factor, and not of what is edited";
  m_editor->applyPreset("skin");
  EXPECT_EQ(m_model->value().softTissue.preset, "skin");
  EXPECT_EQ(appearance::flagsOf(m_model->value().softTissue), "none") << "nothing to touch";
  EXPECT_EQ(m_model->value().softTissue.tissue, "");
  EXPECT_THROW(m_editor->applyPreset("air-cells"), core::InvalidParameter);
  m_editor->clearPoints();
  EXPECT_NE(m_editor->notice().find("not drawn"), std::string::npos);
  EXPECT_TRUE(m_editor->selected()->transfer.transparent());
}

TEST_F(AppearanceEditorTest, SoftTissueOfAnMrBeginsWithAFunctionOfItsValues)
{
  m_editor->select(AppearanceEditor::kSoftTissue);
  const auto before = m_model->value().softTissue;
  m_editor->setSource("t2");
  const auto ofMr = m_model->value().softTissue;
  EXPECT_EQ(ofMr.sourceImage, "t2");
  EXPECT_FALSE(ofMr.relative);
  ASSERT_FALSE(points().empty());
  EXPECT_EQ(points().front().opacity, 0.0F) << "dark air";
  EXPECT_GT(points().front().value, 0.0);
  EXPECT_LE(points().back().value, 81.0) << "the brightest value";
  EXPECT_EQ(m_editor->notice(), "");
  EXPECT_EQ(m_editor->axis().image, "t2");
  count();
  m_editor->clearPoints();
  ASSERT_TRUE(m_editor->canFit());
  m_editor->fit();
  EXPECT_TRUE(m_model->value().softTissue == ofMr);
  m_editor->setSource("");
  EXPECT_TRUE(m_model->value().softTissue == before);
  m_model->undo();
  EXPECT_TRUE(m_model->value().softTissue == ofMr);
}

TEST_F(AppearanceEditorTest, ALumenReadsTheCt)
{
  m_editor->select("canal");
  EXPECT_FALSE(m_editor->sourceFixed().empty());
  m_editor->setSource("t2");
  EXPECT_TRUE(look("canal").sourceImage.empty());
  EXPECT_FALSE(m_editor->canFit());
}

TEST_F(AppearanceEditorTest, FitsPointsToThePartsValues)
{
  m_editor->select("nerve");
  setPoints(R"({"value": 0, "color": [1, 1, 1], "opacity": 0.2},
               {"value": 25, "color": [1, 1, 1], "opacity": 0.3},
               {"value": 100, "color": [1, 1, 1], "opacity": 0.4})");
  m_editor->setSource("t2");
  EXPECT_FALSE(m_editor->canFit());
  count();
  ASSERT_TRUE(m_editor->canFit());
  m_editor->fit();
  ASSERT_EQ(points().size(), 3u);
  // Two values, 10 and 70, in bins of one unit around them: the percentiles lie in these bins.
  EXPECT_NEAR(points()[0].value, 10.0, 0.5);
  EXPECT_NEAR(points()[2].value, 70.0, 0.5);
  EXPECT_NEAR(points()[1].value, points()[0].value + 0.25 * (points()[2].value - points()[0].value),
              1e-9);
  EXPECT_EQ(points()[1].opacity, 0.3F);
}

TEST_F(AppearanceEditorTest, GivesAPartInOneColourTwoShadesThatFit)
{
  m_editor->select("nerve");
  m_editor->setSource("t2");
  EXPECT_TRUE(points().empty()) << "a preset has no values of an MR";
  EXPECT_FALSE(m_editor->notice().empty());
  count();
  m_editor->fit();
  ASSERT_EQ(points().size(), 2u);
  EXPECT_TRUE(m_editor->notice().empty());
  for (std::size_t c = 0; c < 3; ++c)
  {
    EXPECT_LE(points()[0].color[c], look("nerve").color[c]);
    EXPECT_GE(points()[1].color[c], look("nerve").color[c]);
  }
}

TEST_F(AppearanceEditorTest, AnUnregisteredMrIsSaid)
{
  scene::Case value = lineCase();
  value.mr.front().registered = false;
  open(value);
  m_editor->select("nerve");
  ASSERT_EQ(m_editor->sources().size(), 2u);
  EXPECT_FALSE(m_editor->sources()[1].registered);
  m_editor->setSource("t2");
  EXPECT_NE(m_editor->notice().find("not registered"), std::string::npos);
}

TEST_F(AppearanceEditorTest, PresetsOfTheLibraryAreAppliedLikeThoseBuiltIn)
{
  m_editor->select("nerve");
  setPoints(R"({"value": 7, "color": [1, 0, 0], "opacity": 0.5})");
  m_editor->savePreset("ours");
  ASSERT_TRUE(m_editor->presets().back().isOwn);
  EXPECT_EQ(m_editor->presets().back().look.preset, "ours");
  m_editor->applyPreset("artery");
  EXPECT_EQ(look("nerve").preset, "artery");
  EXPECT_TRUE(look("nerve").relative);
  m_editor->applyPreset("ours");
  EXPECT_EQ(look("nerve").preset, "ours");
  ASSERT_EQ(points().size(), 1u);
  EXPECT_EQ(points()[0].value, 7.0);
  m_editor->addPoint(100.0, 0.1);
  m_editor->reset();
  EXPECT_EQ(points().size(), 1u);
  m_editor->deletePreset("ours");
  EXPECT_FALSE(m_editor->presets().back().isOwn);
  EXPECT_THROW(m_editor->applyPreset("ours"), core::InvalidParameter);
  EXPECT_EQ(look("nerve").preset, "ours");
  m_editor->select("ct");
  EXPECT_THROW(m_editor->applyPreset("ear-canal"), core::InvalidParameter);
}

TEST_F(AppearanceEditorTest, APresetOfMrValuesIsNotPutOnTheCt)
{
  m_editor->select("nerve");
  m_editor->setSource("t2");
  setPoints(R"({"value": 7, "color": [1, 0, 0], "opacity": 0.5})");
  m_editor->savePreset("of mr");
  m_editor->setSource("");
  setPoints(R"({"value": 40, "color": [1, 0, 0], "opacity": 0.2})");
  m_editor->savePreset("of ct");
  const auto before = look("nerve");
  EXPECT_THROW(m_editor->applyPreset("of mr"), core::InvalidParameter);
  EXPECT_TRUE(look("nerve") == before);
  m_editor->applyPreset("of ct");
  m_editor->select("ct");
  EXPECT_THROW(m_editor->applyPreset("of mr"), core::InvalidParameter) << "bone reads the CT";
  m_editor->select("nerve");
  m_editor->setSource("t2");
  EXPECT_THROW(m_editor->applyPreset("of ct"), core::InvalidParameter);
  m_editor->applyPreset("of mr");
  EXPECT_EQ(look("nerve").preset, "of mr");
  EXPECT_EQ(look("nerve").sourceImage, "t2");
  EXPECT_EQ(points()[0].value, 7.0);
}

TEST_F(AppearanceEditorTest, SoftTissueReadsTheCtWithAPresetOfItsValues)
{
  m_editor->select(AppearanceEditor::kSoftTissue);
  setPoints(R"({"value": -100, "color": [1, 1, 0], "opacity": 0},
               {"value": 40, "color": [1, 0, 0], "opacity": 0.2})");
  m_editor->savePreset("of ct");
  m_editor->setSource("t2");
  m_editor->savePreset("of mr");
  const auto ofMr = points();
  m_editor->applyPreset("of ct");
  EXPECT_EQ(m_model->value().softTissue.sourceImage, "");
  EXPECT_EQ(points()[0].value, -100.0);
  EXPECT_THROW(m_editor->applyPreset("of mr"), core::InvalidParameter);
  EXPECT_EQ(m_model->value().softTissue.preset, "of ct");
  m_editor->setSource("t2");
  m_editor->applyPreset("of mr");
  EXPECT_EQ(m_model->value().softTissue.sourceImage, "t2");
  EXPECT_TRUE(points() == ofMr);
}

// The voxels of the MR are in a file that is damaged: there is no function of its values.
TEST_F(AppearanceEditorTest, AnMrThatCannotBeReadIsNoSourceOfSoftTissue)
{
  scene::Case value = lineCase();
  value.mr[0].volume =
      core::Lazy<volume::IntensityVolume>([]() -> std::shared_ptr<const volume::IntensityVolume>
                                          { throw core::Error(core::Fault::Internal, "damaged"); });
  m_model->adopt(std::move(value));
  m_editor->refresh();
  m_editor->select(AppearanceEditor::kSoftTissue);
  const auto before = m_model->value().softTissue;
  EXPECT_THROW(m_editor->setSource("t2"), core::Error);
  EXPECT_TRUE(m_model->value().softTissue == before);
  EXPECT_FALSE(m_model->canUndo());
}

TEST_F(AppearanceEditorTest, WhatAPresetChangesOfTheVoxelsIsPreparedInTheBackground)
{
  m_editor->select("nerve");
  m_editor->addPoint(50.0, 0.5);
  EXPECT_TRUE(m_model->drawable()) << "a point changes no voxel";
  m_editor->applyPreset("artery"); // of another rank where structures overlap
  EXPECT_FALSE(m_model->drawable());
  m_model->prepareNow();
  EXPECT_TRUE(m_model->ready() && m_model->drawable());
}

TEST_F(AppearanceEditorTest, CopiesBetweenPartsAsTheCommandsJson)
{
  m_editor->select("nerve");
  setPoints(R"({"value": 7, "color": [1, 0, 0], "opacity": 0.5, "specular": 0.25})");
  const std::string copied = m_editor->json();
  EXPECT_TRUE(appearance::TransferFunction::fromJson(copied) == *look("nerve").transfer);
  m_editor->select("ct");
  m_editor->setJson(copied);
  EXPECT_TRUE(*m_model->value().boneLook.transfer == *look("nerve").transfer);
  EXPECT_THROW(m_editor->setJson("no JSON"), core::InvalidParameter);
  EXPECT_EQ(points().size(), 1u);
}

TEST_F(AppearanceEditorTest, AConeBeamsPresetsAndRangeFollowItsValues)
{
  scene::Case value = lineCase();
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      imageOf<std::uint16_t>(kLine, {0, 0, 12000, 12000, 27000, 40000, 42000, 56000}));
  value.ct.range = {0.0, 56000.0};
  value.iso = 27000.0;
  value.denseBone = 42000.0;
  open(value);
  const auto axis = m_editor->axis();
  EXPECT_EQ(axis.unit, "");
  EXPECT_LE(axis.least, 0.0);
  EXPECT_GE(axis.most, 56000.0);
  // The preset's 300 HU is where this image's bone begins; 10 of its units are a HU.
  const auto preset = appearance::StructurePresets::builtIn().preset("bone");
  ASSERT_EQ(points().size(), preset.transfer->points().size());
  for (std::size_t n = 0; n < points().size(); ++n)
    EXPECT_NEAR(points()[n].value, 27000.0 + 10.0 * (preset.transfer->points()[n].value - 300.0),
                1e-6);
  m_editor->selectPoint(0);
  auto point = points()[0];
  point.value = 20000.0;
  m_editor->setPoint(point);
  EXPECT_EQ(m_model->value().boneLook.transfer->points()[0].value, 20000.0);
  EXPECT_FALSE(m_model->value().boneLook.relative);
  EXPECT_EQ(m_editor->estimate(), "") << "of bone";
  value.softTissueValues = {6000.0, 13000.0};
  open(value);
  m_editor->select(AppearanceEditor::kSoftTissue);
  ASSERT_FALSE(points().empty());
  EXPECT_NEAR(points().front().value, 6000.0, 1e-6);
  EXPECT_NE(m_editor->estimate().find("air ends at 6000"), std::string::npos)
      << m_editor->estimate();
}

TEST_F(AppearanceEditorTest, ABoneThatShinesThroughKeepsItsOwnPoints)
{
  setPoints(R"({"value": 300, "color": [1, 1, 1], "opacity": 0.2})");
  m_editor->setSurfaceOpacity(0.25);
  EXPECT_EQ(m_model->value().boneLook.opacity, 0.25F);
  EXPECT_EQ(points().size(), 1u);
  m_editor->select("nerve");
  m_editor->setSurfaceOpacity(0.5);
  EXPECT_EQ(look("nerve").opacity, 0.5F);
}

TEST(FittedAppearance, OfBoneCountsWhatIsAboveTheThreshold)
{
  const scene::Case value = lineCase(); // bone: 400, 900, 1500, 1600
  const auto look = presenters::fitted(value, "ct");
  ASSERT_TRUE(look.transfer);
  EXPECT_FALSE(look.relative);
  EXPECT_NEAR(look.transfer->points().front().value, 400.0, 3.0);
  EXPECT_NEAR(look.transfer->points().back().value, 1600.0, 3.0);
  EXPECT_THROW(presenters::fitted(value, "canal"), core::InvalidParameter);
  EXPECT_THROW(presenters::fitted(value, "xyzzy"), core::InvalidParameter);
}
