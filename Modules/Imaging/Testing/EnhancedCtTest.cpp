// Multi-frame files written by DCMTK's modules for enhanced CT and functional groups.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>

// DCMTK configures itself first.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmect/enhanced_ct.h>
#include <dcmtk/dcmfg/fgfracon.h>
#include <dcmtk/dcmfg/fgpixeltransform.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "TestDicom.h"
#include "petrous/Imaging/DicomReader.h"

namespace petrous::imaging
{
namespace
{

namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::TemporaryFolder;
using volume::IntensityVolume;

constexpr int kColumns = 9;
constexpr int kRows = 7;
constexpr double kColumnStep = 0.4;
constexpr double kRowStep = 0.5;

std::string text(double value)
{
  return core::fixedText(value, 9).substr(0, 16);
}

/// Stored value of a pixel of slice k.
int stored(int i, int j, int k)
{
  return (i * 631 + j * 4099 + k * 1733) % 4001 - 2000;
}

struct MultiFrame
{
  Matrix3d axes = Matrix3d::Identity();
  Vector3d origin{-31.25, 12.5, 400.75};
  Vector3d step{0.0, 0.0, 0.6}; ///< of a slice to the next
  std::vector<int> order;       ///< slice of each frame
  bool sharesPlane = true; ///< orientation, pixel measures and rescale are groups of all frames
  std::function<double(int k)> slope = [](int) { return 1.0; };
  std::function<std::string(int k)> type = [](int) { return "HU"; };
  std::string sopClass = UID_EnhancedCTImageStorage;
  std::string modality = "CT";
  E_TransferSyntax syntax = EXS_LittleEndianExplicit;

  Vector3d positionOf(int k) const { return origin + k * step; }

  void write(const fs::path& file) const
  {
    EctEnhancedCT* made = nullptr;
    const IODEnhGeneralEquipmentModule::EquipmentInfo equipment("Test", "Test", "1", "1");
    ASSERT_TRUE(EctEnhancedCT::create(
                    made, kRows, kColumns, OFTrue, EctTypes::E_ImageType1_Original, "VOLUME",
                    "NONE", "1", EctTypes::E_ContQuali_Product, EctTypes::E_PixelPres_Monochrome,
                    EctTypes::E_VolProps_Volume, "NONE", equipment, "20200101120000", 1.0)
                    .good());
    const std::unique_ptr<EctEnhancedCT> ct(made);
    ct->setCheckFGOnWrite(OFFalse);
    FGPixelMeasures measures;
    measures.setPixelSpacing((text(kRowStep) + "\\" + text(kColumnStep)).c_str());
    measures.setSliceThickness("1.25");
    FGPlaneOrientationPatient plane;
    plane.setImageOrientationPatient(text(axes(0, 0)).c_str(), text(axes(1, 0)).c_str(),
                                     text(axes(2, 0)).c_str(), text(axes(0, 1)).c_str(),
                                     text(axes(1, 1)).c_str(), text(axes(2, 1)).c_str());
    const auto transformation = [&](int k)
    {
      FGPixelValueTransformation group;
      group.setRescaleIntercept("-100");
      group.setRescaleSlope(text(slope(k)).c_str());
      group.setRescaleType(type(k).c_str());
      return group;
    };
    FGPixelValueTransformation shared = transformation(0);
    if (sharesPlane)
    {
      ASSERT_TRUE(ct->addForAllFrames(measures).good());
      ASSERT_TRUE(ct->addForAllFrames(plane).good());
      ASSERT_TRUE(ct->addForAllFrames(shared).good());
    }
    ASSERT_TRUE(ct->getDimensions()
                    .addDimensionIndex(DCM_InStackPositionNumber, "1.2.3.10",
                                       DCM_FrameContentSequence, "slice")
                    .good());
    EctEnhancedCT::FramesType all = ct->getFrames();
    auto* frames = OFget<EctEnhancedCT::Frames<Sint16>>(&all);
    ASSERT_NE(frames, nullptr);
    for (const int k : order)
    {
      std::vector<Sint16> pixels;
      for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i)
          pixels.push_back(static_cast<Sint16>(stored(i, j, k)));
      const Vector3d at = positionOf(k);
      FGPlanePosPatient place;
      place.setImagePositionPatient(text(at[0]).c_str(), text(at[1]).c_str(), text(at[2]).c_str());
      FGFrameContent content;
      content.setStackID("1");
      content.setInStackPositionNumber(static_cast<Uint32>(k + 1));
      content.setDimensionIndexValues(static_cast<Uint32>(k + 1), 0);
      FGPixelValueTransformation own = transformation(k);
      OFVector<FGBase*> groups;
      groups.push_back(&place);
      groups.push_back(&content);
      if (!sharesPlane)
      {
        groups.push_back(&measures);
        groups.push_back(&plane);
        groups.push_back(&own);
      }
      ASSERT_TRUE(frames->addFrame(pixels.data(), pixels.size(), groups).good());
    }
    ct->getStudy().setStudyInstanceUID("1.2.3.8");
    ct->getSeries().setSeriesInstanceUID("1.2.3.4");
    ct->getFrameOfReference().setFrameOfReferenceUID("1.2.3.9");
    DcmFileFormat whole;
    DcmDataset& data = *whole.getDataset();
    const OFCondition written = ct->writeDataset(data);
    ASSERT_TRUE(written.good()) << written.text();
    // DCMTK 3.6.7 states unsigned pixels for its signed frames.
    data.putAndInsertUint16(DCM_PixelRepresentation, 1);
    data.putAndInsertString(DCM_SOPClassUID, sopClass.c_str());
    data.putAndInsertString(DCM_Modality, modality.c_str());
    if (sopClass == UID_LegacyConvertedEnhancedCTImageStorage)
      for (unsigned long f = 0; f < order.size(); ++f) // what the converter could not place
      {
        DcmItem* item = nullptr;
        ASSERT_TRUE(
            data.findOrCreateSequenceItem(DCM_PerFrameFunctionalGroupsSequence, item, long(f))
                .good());
        DcmItem* rest = nullptr;
        ASSERT_TRUE(
            item->findOrCreateSequenceItem(DCM_UnassignedPerFrameConvertedAttributesSequence, rest)
                .good());
        rest->putAndInsertString(DCM_InstanceNumber, "7");
        rest->putAndInsertString(DCM_ImagePositionPatient, "1\\2\\3");
      }
    ASSERT_TRUE(whole.saveFile(file.c_str(), syntax).good());
  }
};

std::vector<int> inOrder(int count)
{
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<int> shuffled(int count)
{
  std::vector<int> order = inOrder(count);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  return order;
}

DicomSeries scanned(const MultiFrame& file, const fs::path& folder)
{
  file.write(folder / "ct.dcm");
  const ScanResult result = scanDicom(folder, {});
  EXPECT_EQ(result.series.size(), 1U);
  return result.series.empty() ? DicomSeries() : result.series.front();
}

/// Every voxel lies where its frame says, with its value.
void expectFrames(const MultiFrame& file, const IntensityVolume& image)
{
  const int count = static_cast<int>(file.order.size());
  ASSERT_EQ(image.geometry().dims(), (core::Index3{kColumns, kRows, count}));
  double worst = 0.0;
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < kRows; ++j)
      for (int i = 0; i < kColumns; ++i)
      {
        const Vector3d truth = file.positionOf(k) + file.axes.col(0) * (kColumnStep * i) +
                               file.axes.col(1) * (kRowStep * j);
        const Vector3d at = image.geometry().voxelFromPatient(truth);
        const Eigen::Vector3i v = at.array().round().cast<int>();
        worst = std::max(worst,
                         (at - v.cast<double>()).cwiseProduct(image.geometry().spacing()).norm());
        ASSERT_EQ(image.at(v[0], v[1], v[2]),
                  static_cast<double>(static_cast<float>(file.slope(k) * stored(i, j, k) - 100.0)));
      }
  EXPECT_LT(worst, 1e-3) << "mm";
}

TEST(EnhancedCt, LiesWhereItsFramesSayInAnyOrderAndGrouping)
{
  const Matrix3d oblique =
      Eigen::AngleAxisd(0.5, Vector3d(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
  for (const bool isShuffled : {false, true})
    for (const bool sharesPlane : {false, true})
      for (const bool isOblique : {false, true})
        for (const E_TransferSyntax syntax :
             {EXS_LittleEndianExplicit, EXS_LittleEndianImplicit, EXS_BigEndianExplicit})
        {
          MultiFrame file;
          file.order = isShuffled ? shuffled(12) : inOrder(12);
          file.sharesPlane = sharesPlane;
          file.syntax = syntax;
          if (isOblique)
          {
            file.axes = oblique;
            file.step = oblique.col(2) * 0.6;
          }
          const TemporaryFolder folder;
          const DicomSeries series = scanned(file, folder.path());
          ASSERT_EQ(series.geometry.verdict, Verdict::Ok);
          expectFrames(file, readSeries(series, {}, {}));
        }
}

// A functional group stands either for all frames or for each (PS3.3 C.7.6.16.1.1).
TEST(EnhancedCt, WhatIsStatedTwiceAndDiffersIsRefused)
{
  struct Contradiction
  {
    DcmTagKey group, value;
    const char* other;
  };
  const Contradiction all[] = {
      {DCM_PlaneOrientationSequence, DCM_ImageOrientationPatient, "-1\\0\\0\\0\\1\\0"},
      {DCM_PixelValueTransformationSequence, DCM_RescaleIntercept, "-1024"},
      {DCM_PixelValueTransformationSequence, DCM_RescaleType, "OD"}};
  for (const Contradiction& one : all)
    for (const bool differs : {false, true})
    {
      MultiFrame file;
      file.order = inOrder(6);
      file.sharesPlane = false;
      const TemporaryFolder folder;
      const fs::path path = folder.path() / "ct.dcm";
      file.write(path);
      DcmFileFormat whole;
      ASSERT_TRUE(whole.loadFile(path.c_str()).good());
      DcmItem* shared = nullptr;
      ASSERT_TRUE(whole.getDataset()
                      ->findOrCreateSequenceItem(DCM_SharedFunctionalGroupsSequence, shared)
                      .good());
      DcmItem* group = nullptr;
      ASSERT_TRUE(shared->findOrCreateSequenceItem(one.group, group).good());
      DcmItem* frame = nullptr;
      DcmItem* own = nullptr;
      OFString stated;
      ASSERT_TRUE(whole.getDataset()
                      ->findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame)
                      .good());
      ASSERT_TRUE(frame->findAndGetSequenceItem(one.group, own).good());
      ASSERT_TRUE(own->findAndGetOFStringArray(one.value, stated).good());
      // The same number in other digits is no contradiction.
      const OFString again = one.value == DCM_RescaleType ? stated
                             : stated[0] == '-'           ? "-0" + stated.substr(1)
                                                          : "+" + stated;
      group->putAndInsertString(one.value, differs ? one.other : again.c_str());
      ASSERT_TRUE(whole.saveFile(path.c_str(), EXS_LittleEndianExplicit).good());
      const ScanResult result = scanDicom(folder.path(), {});
      ASSERT_EQ(result.series.size(), 1U);
      EXPECT_EQ(result.series.front().geometry.verdict == Verdict::Ok, !differs)
          << one.value.toString();
    }
}

TEST(EnhancedCt, FramesOfSeveralRescaleTypesAreRefused)
{
  for (const bool differs : {false, true})
  {
    MultiFrame file;
    file.order = inOrder(6);
    file.sharesPlane = false;
    file.type = [differs](int k) { return differs && k > 0 ? "OD" : "HU"; };
    const TemporaryFolder folder;
    const SeriesGeometry geometry = scanned(file, folder.path()).geometry;
    EXPECT_EQ(geometry.verdict, differs ? Verdict::Refused : Verdict::Ok);
    ASSERT_EQ(geometry.findings.size(), differs ? 1U : 0U);
    if (!differs)
      continue;
    EXPECT_EQ(geometry.findings.front().kind, FindingKind::MixedRescale);
  }
}

TEST(EnhancedCt, ACountOfFramesThatIsNotThatOfTheGroupsIsNamed)
{
  for (const char* count : {"12", "11", "1"})
  {
    MultiFrame file;
    file.order = inOrder(12);
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "ct.dcm";
    file.write(path);
    DcmFileFormat whole;
    ASSERT_TRUE(whole.loadFile(path.c_str()).good());
    whole.getDataset()->putAndInsertString(DCM_NumberOfFrames, count);
    ASSERT_TRUE(whole.saveFile(path.c_str(), EXS_LittleEndianExplicit).good());
    const ScanResult result = scanDicom(folder.path(), {});
    ASSERT_EQ(result.series.size(), 1U);
    const SeriesGeometry& geometry = result.series.front().geometry;
    if (std::string(count) == "12")
    {
      EXPECT_EQ(geometry.verdict, Verdict::Ok);
      continue;
    }
    ASSERT_FALSE(geometry.findings.empty()) << count;
    EXPECT_EQ(geometry.verdict, Verdict::Refused);
    EXPECT_EQ(geometry.findings.front().kind, FindingKind::Unreadable);
    EXPECT_NE(geometry.findings.front().text.find(std::string(count) +
                                                  " (Number of Frames), and 12 (Per-Frame"),
              std::string::npos)
        << geometry.findings.front().text;
  }
}

// A curved reformat: its pixels lie where no position and orientation says (PS3.3 C.8.16.2.1.4).
TEST(EnhancedCt, ACurvedReformatIsRefused)
{
  for (const char* technique : {"NONE", "CURVED_MPR"})
  {
    MultiFrame file;
    file.order = inOrder(6);
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "ct.dcm";
    file.write(path);
    DcmFileFormat whole;
    ASSERT_TRUE(whole.loadFile(path.c_str()).good());
    DcmItem* shared = nullptr;
    DcmItem* type = nullptr;
    ASSERT_TRUE(whole.getDataset()
                    ->findOrCreateSequenceItem(DCM_SharedFunctionalGroupsSequence, shared)
                    .good());
    ASSERT_TRUE(shared->findOrCreateSequenceItem(DCM_CTImageFrameTypeSequence, type).good());
    type->putAndInsertString(DCM_VolumetricProperties, "DISTORTED");
    type->putAndInsertString(DCM_VolumeBasedCalculationTechnique, technique);
    ASSERT_TRUE(whole.saveFile(path.c_str(), EXS_LittleEndianExplicit).good());
    const ScanResult result = scanDicom(folder.path(), {});
    ASSERT_EQ(result.series.size(), 1U);
    const SeriesGeometry& geometry = result.series.front().geometry;
    EXPECT_EQ(geometry.verdict == Verdict::Ok, std::string(technique) == "NONE") << technique;
    const std::string found = geometry.findings.empty() ? "" : geometry.findings.front().text;
    EXPECT_EQ(found.find("no straight grid") == std::string::npos, std::string(technique) == "NONE")
        << found;
  }
}

TEST(EnhancedCt, LegacyConvertedAndXRay3dAreReadAlike)
{
  const std::pair<std::string, std::string> kinds[] = {
      {UID_LegacyConvertedEnhancedCTImageStorage, "CT"},
      {UID_XRay3DAngiographicImageStorage, "XA"},
      {UID_XRay3DCraniofacialImageStorage, "DX"}};
  for (const auto& [sopClass, modality] : kinds)
    for (const bool sharesPlane : {false, true})
    {
      SCOPED_TRACE(sopClass);
      MultiFrame file;
      file.sopClass = sopClass;
      file.modality = modality;
      file.order = shuffled(8);
      file.sharesPlane = sharesPlane;
      const TemporaryFolder folder;
      const DicomSeries series = scanned(file, folder.path());
      EXPECT_EQ(series.modality, modality);
      ASSERT_EQ(series.geometry.verdict, Verdict::Ok);
      expectFrames(file, readSeries(series, {}, {}));
    }
}

TEST(EnhancedCt, EachFrameHasItsOwnRescale)
{
  MultiFrame file;
  file.order = shuffled(8);
  file.sharesPlane = false;
  file.slope = [](int k) { return 1.0 + 0.25 * k; };
  const TemporaryFolder folder;
  const DicomSeries series = scanned(file, folder.path());
  EXPECT_EQ(series.geometry.verdict, Verdict::Repairable);
  ReadOptions options;
  options.repair = true;
  expectFrames(file, readSeries(series, options, {}));
}

TEST(EnhancedCt, ATiltedOneIsStraightenedByItsFramesPositions)
{
  for (const double degrees : {-18.5, 12.0, 30.0})
  {
    MultiFrame file;
    file.axes =
        Eigen::AngleAxisd(degrees * M_PI / 180.0, Vector3d(1.0, 0.0, 0.0)).toRotationMatrix();
    file.order = shuffled(20); // the table advances in z
    const TemporaryFolder folder;
    const DicomSeries series = scanned(file, folder.path());
    ASSERT_EQ(series.geometry.verdict, Verdict::Repairable);
    ASSERT_EQ(series.geometry.findings.size(), 1U);
    EXPECT_EQ(series.geometry.findings[0].kind, FindingKind::GantryTilt);
    const double slide = 19 * 0.6 * std::sin(std::abs(degrees) * M_PI / 180.0);
    EXPECT_NEAR(series.geometry.findings[0].errorMm, 0.5 * slide, 1e-3);
    ReadOptions options;
    options.repair = true;
    const IntensityVolume image = readSeries(series, options, {});
    const core::GridGeometry& grid = image.geometry();
    // Along a row nothing is interpolated: in x every voxel is that of one row, blended with one
    // above or below.
    const double pitch = 0.6 * std::cos(degrees * M_PI / 180.0);
    EXPECT_NEAR(grid.spacing()[2], pitch, 1e-3);
    for (int k = 0; k < 20; ++k)
      for (int j = 1; j + 1 < kRows; ++j)
      {
        const Vector3d at =
            grid.voxelFromPatient(file.positionOf(k) + file.axes.col(1) * (kRowStep * j));
        EXPECT_NEAR(at[0], 0.0, 1e-3);
        EXPECT_NEAR(at[2], k, 1e-3) << "each frame is a slice";
        const int row = static_cast<int>(std::floor(at[1]));
        const double share = at[1] - row;
        // Voxel `row` lies share below frame row j, and so between rows j - 1 and j of its frame.
        const double truth =
            (share * stored(4, j - 1, k) + (1.0 - share) * stored(4, j, k)) - 100.0;
        EXPECT_NEAR(image.at(4, row, k), truth, 0.5 + 5000.0 * 1e-4);
      }
  }
}

TEST(EnhancedCt, AFrameThatIsMissingIsNamed)
{
  MultiFrame file;
  file.order = shuffled(12);
  file.order.erase(std::find(file.order.begin(), file.order.end(), 5));
  const TemporaryFolder folder;
  const DicomSeries series = scanned(file, folder.path());
  EXPECT_EQ(series.geometry.verdict, Verdict::Repairable);
  ASSERT_EQ(series.geometry.findings.size(), 1U);
  EXPECT_EQ(series.geometry.findings[0].kind, FindingKind::MissingSlice);
  EXPECT_NE(series.geometry.findings[0].text.find("between 403.15 and 404.35 mm"),
            std::string::npos)
      << series.geometry.findings[0].text;
}

// Whether the frames between are lost, the positions in the stack tell, not those in the file.
TEST(EnhancedCt, EverySecondFrameThatIsMissingIsNoSpacing)
{
  for (const bool isShuffled : {false, true})
  {
    MultiFrame file;
    for (const int k : isShuffled ? shuffled(61) : inOrder(61))
      if (k < 10 || k % 2 == 0)
        file.order.push_back(k);
    const TemporaryFolder folder;
    const SeriesGeometry geometry = scanned(file, folder.path()).geometry;
    EXPECT_EQ(geometry.verdict, Verdict::Refused);
    ASSERT_EQ(geometry.findings.size(), 1U);
    EXPECT_EQ(geometry.findings[0].kind, FindingKind::MissingSlice);
    EXPECT_EQ(geometry.findings[0].text.find("25 slices are missing"), 0U)
        << geometry.findings[0].text;
  }
}

} // namespace
} // namespace petrous::imaging
