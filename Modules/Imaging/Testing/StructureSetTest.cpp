#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "TestDicom.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/StructureSet.h"

namespace petrous::imaging
{
namespace
{

using Eigen::Vector3d;
using Reason = FileError::Reason;
using Roi = StructureSet::Roi;
using test::TemporaryFolder;
using test::TestSlice;

constexpr double kPi = 3.14159265358979323846;

core::GridGeometry grid()
{
  return {{80, 80, 40}, Vector3d(0.5, 0.5, 1.0), Vector3d(-10.0, -20.0, 5.0)};
}

std::vector<Vector3d> circle(const Vector3d& center, double radius, int points = 200)
{
  std::vector<Vector3d> contour;
  for (int n = 0; n < points; ++n)
    contour.push_back(center + radius * Vector3d(std::cos(2.0 * kPi * n / points),
                                                 std::sin(2.0 * kPi * n / points), 0.0));
  return contour;
}

std::vector<Vector3d> square(double x0, double x1, double y0, double y1, double z)
{
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

volume::LabelMap labelsOf(const std::vector<Roi>& rois, const core::GridGeometry& on = grid())
{
  StructureSet set;
  set.rois = rois;
  LoadedLabels loaded = imaging::labelsOf(set, on, "set.dcm");
  EXPECT_EQ(loaded.maps.size(), 1U);
  return loaded.maps.front();
}

double volumeOf(const Roi& roi, const core::GridGeometry& on = grid())
{
  const volume::LabelMap labels = labelsOf({roi}, on);
  return labels.volume(labels.segments.front());
}

Roi named(const std::string& name, std::vector<std::vector<Vector3d>> contours)
{
  Roi roi;
  roi.name = name;
  roi.contours = std::move(contours);
  return roi;
}

/// A structure set written byte by byte (PS3.5, PS3.3 C.8.8.5 and C.8.8.6).
struct TestSet
{
  TestSlice code;
  std::string rois, contours, observations;
  std::string ofContours, ofRois; ///< further elements of each

  std::string element(std::uint32_t tag, const char* vr, const std::string& value) const
  {
    std::string out;
    code.element(out, tag, vr, value);
    return out;
  }
  std::string item(const std::string& content) const
  {
    std::string out;
    code.append(out, 0xfffe, 2);
    code.append(out, 0xe000, 2);
    code.append(out, static_cast<std::uint32_t>(content.size()), 4);
    return out + content;
  }
  void add(int number, const std::string& name, const std::vector<std::string>& points,
           const std::string& type = "CLOSED_PLANAR", const std::string& frame = "1.2.3.9")
  {
    rois += item(element(0x30060022, "IS", std::to_string(number)) +
                 element(0x30060024, "UI", frame) + element(0x30060026, "LO", name));
    std::string sequence;
    for (const std::string& text : points)
      sequence +=
          item(element(0x30060042, "CS", type) + ofContours + element(0x30060050, "DS", text));
    contours += item(element(0x3006002a, "IS", "255\\128\\0") +
                     (points.empty() ? "" : element(0x30060040, "SQ", sequence)) + ofRois +
                     element(0x30060084, "IS", std::to_string(number)));
    observations += item(element(0x30060084, "IS", std::to_string(number)) +
                         element(0x300600a4, "CS", "ORGAN"));
  }
  std::string bytes() const
  {
    TestSlice meta;
    std::string out;
    meta.element(out, 0x00020010, "UI",
                 code.implicitVr  ? "1.2.840.10008.1.2"
                 : code.bigEndian ? "1.2.840.10008.1.2.2"
                                  : "1.2.840.10008.1.2.1");
    out = std::string(128, '\0') + "DICM" + out;
    out += element(0x00080005, "CS", "ISO_IR 100");
    out += element(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.481.3");
    out += element(0x00080060, "CS", "RTSTRUCT");
    out += element(0x00100010, "PN", "SECRET^NAME");
    out += element(0x30060020, "SQ", rois);
    out += element(0x30060039, "SQ", contours);
    return out + element(0x30060080, "SQ", observations);
  }
  std::filesystem::path write(const TemporaryFolder& folder) const
  {
    const std::filesystem::path path = folder.path() / "set.dcm";
    const std::string all = bytes();
    std::ofstream(path, std::ios::binary).write(all.data(), static_cast<long>(all.size()));
    return path;
  }
};

std::string refusal(const std::filesystem::path& path)
{
  try
  {
    readStructureSet(path);
  }
  catch (const FileError& error)
  {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("SECRET"), std::string::npos);
    return error.what();
  }
  return {};
}

} // namespace

TEST(StructureSet, StopsBetweenContoursAndPlanes)
{
  const TemporaryFolder folder;
  TestSet set;
  set.add(1, "a", {"0\\0\\10\\5\\0\\10\\5\\5\\10", "0\\0\\11\\5\\0\\11\\5\\5\\11"});
  const auto path = set.write(folder);
  int checks = 0;
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress(
      [&](double, const std::string&) { ++checks == 1 ? token->cancel() : void(); }, token);
  EXPECT_THROW(readStructureSet(path, progress), core::CancelledError);
  EXPECT_EQ(checks, 1) << "of the file; the contours do not report";
  const auto second = std::make_shared<core::CancelToken>();
  const core::Progress placing([&](double, const std::string&) { second->cancel(); }, second);
  EXPECT_THROW(imaging::labelsOf(readStructureSet(path), grid(), path, placing),
               core::CancelledError);
}

TEST(StructureSet, BallsKeepTheVolumeOfTheirContours)
{
  for (const double radius : {1.7, 3.3, 8.0})
  {
    Roi roi;
    roi.name = "ball";
    const Vector3d center(9.83, 0.27, 25.0);
    for (double z = 5.0; z <= 44.0; z += 1.0)
      if (const double inside = radius * radius - (z - center[2]) * (z - center[2]); inside > 0.0)
        roi.contours.push_back(circle({center[0], center[1], z}, std::sqrt(inside)));
    const double contours = contourVolume(roi, grid());
    double discs = 0.0; // of polygons of 200 corners
    for (const auto& contour : roi.contours)
      discs += 100.0 * std::sin(2.0 * kPi / 200.0) *
               (contour[0] - Vector3d(center[0], center[1], contour[0][2])).squaredNorm();
    EXPECT_NEAR(contours, discs, 2e-3 * discs) << radius;
    EXPECT_NEAR(volumeOf(roi), contours, 0.5 * 0.25 + 1e-3 * contours) << radius;
    EXPECT_DOUBLE_EQ(imaging::labelsOf({{roi}, ""}, grid(), "set.dcm").fileVolumes.at("ball"),
                     contours);
  }
}

TEST(StructureSet, ASquareOnVoxelBordersIsExact)
{
  // Voxel centres at -10 + i/2: borders at -10.25 + i/2.
  const volume::LabelMap labels =
      labelsOf({named("square", {square(-5.25, -2.25, -15.25, -14.25, 10.0)})});
  EXPECT_EQ(labels.segments[0].voxels, 12U);
  for (int i = 0; i < 80; ++i)
    for (int j = 0; j < 80; ++j)
      EXPECT_EQ(labels.voxels->at(i, j, 5) != 0, i >= 10 && i < 16 && j >= 10 && j < 12);
}

// Voxels that are needed for its volume come from all of them.
TEST(StructureSet, ASquareIsAsWideInEachDirectionAsItsSidesAreAlike)
{
  // 19 whole voxels and 0.4 of one at either end.
  const double x0 = -4.95, x1 = x0 + 9.9, y0 = -14.95, y1 = y0 + 9.9;
  const Roi roi = named("a", {square(x0, x1, y0, y1, 20.0), square(x0, x1, y0, y1, 21.0)});
  const volume::LabelMap labels = labelsOf({roi});
  core::IndexBox box{{80, 80, 40}, {0, 0, 0}};
  const auto isIn = [&](int i, int j) { return labels.voxels->at(i, j, 15) != 0; };
  for (int j = 0; j < 80; ++j)
    for (int i = 0; i < 80; ++i)
      if (isIn(i, j))
        for (std::size_t a = 0; a < 2; ++a)
        {
          box.lower[a] = std::min(box.lower[a], a == 0 ? i : j);
          box.upper[a] = std::max(box.upper[a], (a == 0 ? i : j) + 1);
        }
  EXPECT_EQ(box.upper[0] - box.lower[0], 21);
  EXPECT_EQ(box.upper[1] - box.lower[1], 21);
  int sides[4] = {};
  for (int n = 0; n < 80; ++n)
  {
    sides[0] += isIn(box.lower[0], n) ? 1 : 0;
    sides[1] += isIn(box.upper[0] - 1, n) ? 1 : 0;
    sides[2] += isIn(n, box.lower[1]) ? 1 : 0;
    sides[3] += isIn(n, box.upper[1] - 1) ? 1 : 0;
  }
  for (const int side : sides) // 19.8^2 - 19^2 = 31 of them
    EXPECT_NEAR(side, 31.0 / 4.0, 3.0);
}

TEST(StructureSet, InnerContoursAreHolesWhicheverWayTheyTurn)
{
  auto inner = square(-4.25, -3.25, -14.75, -13.75, 10.0);
  const auto outer = square(-5.25, -2.25, -15.75, -12.75, 10.0);
  EXPECT_DOUBLE_EQ(volumeOf(named("ring", {outer, inner})), 8.0);
  std::reverse(inner.begin(), inner.end());
  EXPECT_DOUBLE_EQ(volumeOf(named("ring", {outer, inner})), 8.0);
  // A keyhole: one contour that goes in to the hole and back along the same line.
  const std::vector<Vector3d> keyhole{
      {-5.25, -15.75, 10}, {-2.25, -15.75, 10}, {-2.25, -12.75, 10}, {-5.25, -12.75, 10},
      {-5.25, -14.25, 10}, {-4.25, -14.25, 10}, {-4.25, -13.75, 10}, {-3.25, -13.75, 10},
      {-3.25, -14.75, 10}, {-4.25, -14.75, 10}, {-4.25, -14.25, 10}, {-5.25, -14.25, 10}};
  EXPECT_DOUBLE_EQ(volumeOf(named("keyhole", {keyhole})), 8.0);
  // A figure of eight: two triangles of 2 mm by 1 mm.
  EXPECT_NEAR(
      volumeOf(named("eight", {{{-5, -15, 10}, {-1, -13, 10}, {-1, -15, 10}, {-5, -13, 10}}})), 4.0,
      0.2);
}

// Squares of 10 x 10 mm with holes of 4 x 4 mm that another program wrote a little higher.
TEST(StructureSet, ContoursALittleApartAreOfOnePlane)
{
  for (const double apart : {0.0, 0.011, 0.03, 0.08})
  {
    Roi roi = named("ring", {});
    for (double z = 10.0; z < 16.5; z += 1.0)
    {
      roi.contours.push_back(square(0.25, 10.25, -10.25, -0.25, z));
      roi.contours.push_back(square(3.25, 7.25, -7.25, -3.25, z + apart + 0.002 * (z - 10.0)));
    }
    EXPECT_NEAR(contourVolume(roi, grid()), 7.0 * (100.0 - 16.0), 7.0) << apart;
    EXPECT_NEAR(volumeOf(roi), 7.0 * (100.0 - 16.0), 14.0) << apart;
  }
  // On a grid whose slices are ten times as thick the planes of a fine image stay apart, with a
  // second part far above too.
  Roi fine = named("fine", {});
  for (int n = 0; n < 20; ++n)
    fine.contours.push_back(square(0.25, 10.25, -10.25, -0.25, 10.0 + 0.1 * n));
  for (int n = 0; n < 20; ++n)
    fine.contours.push_back(square(0.25, 10.25, -10.25, -0.25, 30.0 + 0.1 * n));
  EXPECT_NEAR(contourVolume(fine, grid()), 2.0 * 20.0 * 0.1 * 100.0, 1e-6);
}

TEST(StructureSet, AContourThatIsThereTwiceCountsOnce)
{
  const auto notesOf = [](const Roi& roi)
  {
    StructureSet set;
    set.rois = {roi};
    std::string all;
    for (const std::string& note : imaging::labelsOf(set, grid(), "set.dcm").notes)
      all += note + "\n";
    return all;
  };
  Roi roi = named("cube", {});
  for (double z = 10.0; z < 16.5; z += 1.0)
    roi.contours.push_back(square(0.25, 4.25, -4.25, -0.25, z));
  EXPECT_EQ(notesOf(roi), "");
  Roi again = roi; // begun elsewhere and turned the other way
  std::vector<Vector3d> copy(roi.contours[3].rbegin(), roi.contours[3].rend());
  std::rotate(copy.begin(), copy.begin() + 1, copy.end());
  again.contours.push_back(copy);
  EXPECT_NEAR(contourVolume(again, grid()), 7.0 * 16.0, 1e-6);
  EXPECT_NEAR(volumeOf(again), 7.0 * 16.0, 1e-6);
  EXPECT_NE(notesOf(again).find("1 contour that is there twice"), std::string::npos)
      << notesOf(again);
  // a thousandth of a voxel larger, with another number of points
  Roi nearly = roi;
  nearly.contours.push_back(square(0.249, 4.251, -4.251, -0.249, roi.contours[3].front().z()));
  nearly.contours.back().insert(nearly.contours.back().begin() + 1,
                                0.5 * (nearly.contours.back()[0] + nearly.contours.back()[1]));
  EXPECT_NEAR(volumeOf(nearly), 7.0 * 16.0, 1e-6);
  EXPECT_NE(notesOf(nearly).find("1 contour that is there twice"), std::string::npos)
      << notesOf(nearly);
  // A tenth of a voxel smaller on each side, it leaves 16 - 3.8^2 of 16 there: that is said.
  Roi emptied = roi;
  emptied.contours.push_back(square(0.35, 4.15, -4.15, -0.35, roi.contours[3].front().z()));
  EXPECT_NEAR(contourVolume(emptied, grid()), 6.0 * 16.0 + 16.0 - 3.8 * 3.8, 0.3);
  EXPECT_NE(notesOf(emptied).find("closely within each other in 1 plane"), std::string::npos)
      << notesOf(emptied);
  // Drawn twice, then a quarter of the second moved inwards by 1 voxel: what is left is no thin
  // ring.
  Roi edited = roi;
  const double z = roi.contours[3].front().z();
  edited.contours.push_back({{0.3, -4.2, z},
                             {4.2, -4.2, z},
                             {4.2, -2.3, z},
                             {2.3, -2.3, z},
                             {2.3, -0.3, z},
                             {0.3, -0.3, z}});
  EXPECT_NE(notesOf(edited).find("closely within each other in 1 plane"), std::string::npos)
      << notesOf(edited);
  Roi merged = roi;
  merged.contours.insert(merged.contours.end(), roi.contours.begin(), roi.contours.end());
  EXPECT_NEAR(volumeOf(merged), 7.0 * 16.0, 1e-6);
  // Beside each other, touching, or one within the other: nothing to say.
  Roi holed = roi;
  holed.contours.push_back(square(4.25, 8.25, -4.25, -0.25, 12.0));
  holed.contours.push_back(square(1.25, 2.25, -2.25, -1.25, 12.0));
  EXPECT_EQ(notesOf(holed), "");
  Roi crossed = roi;
  crossed.contours.push_back(square(2.25, 8.25, -3.25, -1.25, 12.0));
  EXPECT_NE(notesOf(crossed).find("cross each other"), std::string::npos) << notesOf(crossed);
}

// The points of each lie on the lines of the other, and half of the square is not in the second.
TEST(StructureSet, ContoursThroughTheSamePointsAreNotOneIfTheirSidesDiffer)
{
  Roi roi = named("w", {});
  for (double z = 10.0; z < 13.5; z += 1.0)
  {
    roi.contours.push_back(square(2.25, 12.25, -12.25, -2.25, z));
    roi.contours.push_back({{2.25, -12.25, z},
                            {12.25, -12.25, z},
                            {12.25, -2.25, z},
                            {7.25, -12.25, z},
                            {2.25, -2.25, z}});
  }
  // by the odd-even rule the notch of 10 x 10 / 2 is left
  EXPECT_NEAR(contourVolume(roi, grid()), 4.0 * 50.0, 1.0);
}

TEST(StructureSet, ContoursOnSomeSlicesFillTheOthers)
{
  Roi roi = named("box", {});
  for (double z = 10.0; z <= 22.0; z += 3.0)
    roi.contours.push_back(square(-5.25, -2.25, -15.25, -12.25, z));
  const LoadedLabels loaded = imaging::labelsOf({{roi}, ""}, grid(), "set.dcm");
  EXPECT_DOUBLE_EQ(loaded.maps[0].volume(loaded.maps[0].segments[0]), 9.0 * 15.0);
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_NE(loaded.notes[0].find("some of the slices"), std::string::npos);
  for (int k = 0; k < 40; ++k)
    EXPECT_EQ(loaded.maps[0].voxels->at(12, 12, k) != 0, k >= 4 && k <= 18) << k;

  // Twice as dense as the slices: each stands for half a slice.
  Roi dense = named("dense", {});
  for (double z = 9.75; z <= 14.3; z += 0.5)
    dense.contours.push_back(square(-5.25, -2.25, -15.25, -12.25, z));
  EXPECT_DOUBLE_EQ(volumeOf(dense), 9.0 * 5.0);

  // Two parts far apart are not joined.
  Roi parts = named("parts", {});
  for (const double z : {10.0, 11.0, 12.0, 20.0, 21.0, 22.0})
    parts.contours.push_back(square(-5.25, -2.25, -15.25, -12.25, z));
  EXPECT_DOUBLE_EQ(volumeOf(parts), 9.0 * 6.0);
}

TEST(StructureSet, ContoursSmallerThanAVoxelAreKept)
{
  const Roi roi = named("dot", {circle({-5.0, -15.0, 10.0}, 0.1), circle({0.0, -15.0, 10.0}, 0.1)});
  const LoadedLabels loaded = imaging::labelsOf({{roi}, ""}, grid(), "set.dcm");
  EXPECT_EQ(loaded.maps[0].segments[0].voxels, 2U);
  EXPECT_NE(loaded.maps[0].voxels->at(10, 10, 5), 0);
  EXPECT_NE(loaded.maps[0].voxels->at(20, 10, 5), 0);
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_NE(loaded.notes[0].find("smaller than a voxel"), std::string::npos);
}

TEST(StructureSet, ASheetThinnerThanAVoxelIsThereInEverySlice)
{
  // 0.4 voxels thick, 40 voxels wide, parallel to the grid.
  Roi roi = named("eardrum", {});
  for (int k = 5; k < 35; ++k)
    roi.contours.push_back(square(-5.25, 14.75, -15.1, -14.9, 5.0 + k));
  const volume::LabelMap labels = labelsOf({roi});
  for (int k = 5; k < 35; ++k)
  {
    int count = 0;
    for (int i = 0; i < 80; ++i)
      count += labels.voxels->at(i, 10, k) != 0;
    EXPECT_NEAR(count, 16, 2) << k;
  }
  const LoadedLabels loaded = imaging::labelsOf({{roi}, ""}, grid(), "set.dcm");
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_NE(loaded.notes[0].find("'eardrum' is thinner than the voxels"), std::string::npos);
  EXPECT_NE(loaded.notes[0].find("its volume is right"), std::string::npos);
  roi = named("plate", {}); // three voxels thick
  for (int k = 5; k < 35; ++k)
    roi.contours.push_back(square(-5.25, 14.75, -15.6, -14.1, 5.0 + k));
  EXPECT_TRUE(imaging::labelsOf({{roi}, ""}, grid(), "set.dcm").notes.empty());
  // Of 32 lines a row the sheet holds 12 or 13: a thickness along the rows is known to a line.
  EXPECT_NEAR(labels.volume(labels.segments[0]), 20.0 * 0.2 * 30.0, 1.0 / 32.0 / 0.4 * 120.0);
}

// The voxels that keep a thin nerve whole are more than it has.
TEST(StructureSet, StatesHowMuchLargerAThinStructureBecame)
{
  Roi roi = named("chorda", {});
  for (int k = 5; k < 35; ++k)
    roi.contours.push_back(circle({-5.0, -15.0, 5.0 + k}, 0.15));
  const LoadedLabels loaded = imaging::labelsOf({{roi}, ""}, grid(), "set.dcm");
  const volume::LabelMap& map = loaded.maps[0];
  const double times = map.volume(map.segments[0]) / loaded.fileVolumes.at("chorda");
  ASSERT_GT(times, 1.5);
  std::string notes;
  for (const std::string& note : loaded.notes)
    notes += note + "; ";
  EXPECT_EQ(notes.find("its volume is right"), std::string::npos) << notes;
  const std::string before = "their volume is ";
  const std::size_t at = notes.find(before);
  ASSERT_NE(at, std::string::npos) << notes;
  const std::size_t from = at + before.size();
  const auto stated = core::parseDouble(notes.substr(from, notes.find(" times", from) - from));
  ASSERT_TRUE(stated) << notes;
  EXPECT_NEAR(*stated, times, 0.05 * times);
}

TEST(StructureSet, FollowsATurnedGridAndPlanesAcrossAnyAxis)
{
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.5, Vector3d::UnitX()) * Eigen::AngleAxisd(0.2, Vector3d::UnitZ()))
          .toRotationMatrix();
  const core::GridGeometry turned({60, 60, 60}, Vector3d(0.5, 0.6, 0.8), Vector3d(1, 2, 3), turn);
  for (const int normal : {0, 1, 2})
  {
    Roi roi = named("cylinder", {});
    Vector3d a = turn.col((normal + 1) % 3);
    Vector3d b = turn.col((normal + 2) % 3);
    for (int slice = 20; slice < 30; ++slice)
    {
      Vector3d voxel = Vector3d::Constant(29.3);
      voxel[normal] = slice;
      const Vector3d center = turned.patientFromVoxel(voxel);
      roi.contours.emplace_back();
      for (int n = 0; n < 100; ++n)
        roi.contours.back().push_back(center + 5.0 * std::cos(2 * kPi * n / 100) * a +
                                      5.0 * std::sin(2 * kPi * n / 100) * b);
    }
    const double expected =
        50.0 * std::sin(2.0 * kPi / 100.0) * 25.0 * 10.0 * turned.spacing()[normal];
    EXPECT_NEAR(volumeOf(roi, turned), expected, 2e-3 * expected) << normal;
  }
  // Oblique to all axes.
  Roi roi = named("oblique", {circle({15.0, 15.0, 15.0}, 4.0)});
  EXPECT_THROW(imaging::labelsOf({{roi}, ""}, turned, "set.dcm"), FileError);
}

TEST(StructureSet, OverlappingStructuresLieInLayersAndEmptyOnesAreNamed)
{
  const std::vector<Roi> rois{named("a", {square(-5.25, -2.25, -15.25, -12.25, 10.0)}),
                              named("b", {square(-3.25, -1.25, -15.25, -12.25, 10.0)}),
                              named("nothing", {}),
                              named("c", {square(5.75, 6.75, -15.25, -12.25, 10.0)})};
  StructureSet set;
  set.rois = rois;
  const LoadedLabels loaded = imaging::labelsOf(set, grid(), "set.dcm");
  ASSERT_EQ(loaded.maps.size(), 2U);
  ASSERT_EQ(loaded.maps[0].segments.size(), 3U);
  EXPECT_EQ(loaded.maps[0].segments[1].name, "nothing");
  EXPECT_EQ(loaded.maps[0].segments[1].voxels, 0U);
  EXPECT_EQ(loaded.maps[1].segments[0].name, "b");
  EXPECT_DOUBLE_EQ(loaded.maps[1].volume(loaded.maps[1].segments[0]), 6.0);
}

TEST(StructureSet, StructuresOfOneNameAreNumbered)
{
  StructureSet set;
  set.rois = {named("nerve", {square(-5.25, -2.25, -15.25, -12.25, 10.0)}),
              named("nerve", {square(-3.25, -1.25, -15.25, -12.25, 10.0)})};
  set.rois[1].meaning = "Facial nerve";
  const LoadedLabels loaded = imaging::labelsOf(set, grid(), "set.dcm");
  ASSERT_EQ(loaded.maps.size(), 2U);
  EXPECT_EQ(loaded.maps[0].segments[0].name, "nerve");
  EXPECT_EQ(loaded.maps[1].segments[0].name, "nerve 2");
  EXPECT_NEAR(loaded.fileVolumes.at("nerve"), 9.0, 1e-9);
  EXPECT_NEAR(loaded.fileVolumes.at("nerve 2"), 6.0, 1e-9);
  EXPECT_EQ(loaded.meanings.count("nerve"), 0U);
  EXPECT_EQ(loaded.meanings.at("nerve 2"), "Facial nerve");
  ASSERT_EQ(loaded.notes.size(), 1U);
}

TEST(StructureSet, RefusesMoreLayersThanItReads)
{
  // Voxels of a layer take memory only where something is drawn.
  const core::GridGeometry large({1024, 1024, 1024}, Vector3d(0.5, 0.5, 0.5), Vector3d::Zero());
  StructureSet set;
  for (int n = 0; n < 3; ++n)
    set.rois.push_back(named("a" + std::to_string(n), {square(1.25, 2.25, 1.25, 2.25, 10.0)}));
  try
  {
    imaging::labelsOf(set, large, "set.dcm", {}, std::uint64_t{1} << 40);
    FAIL() << "6 GB of layers";
  }
  catch (const FileError& error)
  {
    EXPECT_NE(std::string(error.what()).find("overlap in more layers"), std::string::npos);
  }
}

TEST(StructureSet, RefusesWhatDoesNotFitTheMemory)
{
  StructureSet set; // overlap in two layers
  for (int n = 0; n < 2; ++n)
    set.rois.push_back(named("a" + std::to_string(n), {square(1.25, 2.25, 1.25, 2.25, 10.0)}));
  const std::uint64_t bytes = 2 * 2 * grid().voxelCount();
  EXPECT_EQ(imaging::labelsOf(set, grid(), "set.dcm", {}, bytes).maps.size(), 2U);
  try
  {
    imaging::labelsOf(set, grid(), "set.dcm", {}, bytes - 1);
    FAIL() << "read";
  }
  catch (const FileError& error)
  {
    EXPECT_NE(std::string(error.what()).find("GB of memory"), std::string::npos) << error.what();
  }
}

TEST(StructureSet, AFarContourKeepsItsAreaWithoutALineForEachRow)
{
  // 10 m at 0.1 mm: 3.2 million lines, which are not kept at once.
  const core::GridGeometry fine({64, 64, 8}, Vector3d(0.1, 0.1, 1.0), Vector3d::Zero());
  const Roi roi = named("tall", {square(0.0, 1.0, -5000.0, 5000.0, 4.0)});
  EXPECT_NEAR(contourVolume(roi, fine), 10000.0, 0.01);
}

TEST(StructureSet, WhatLiesOutsideTheImageIsNoted)
{
  StructureSet set;
  set.rois = {named("far", {circle({500.0, 0.0, 10.0}, 4.0)}),
              named("half", {square(-20.0, -9.25, -15.25, -14.25, 10.0)}),
              named("inside", {square(-5.25, -2.25, -15.25, -14.25, 10.0)})};
  const LoadedLabels loaded = imaging::labelsOf(set, grid(), "set.dcm");
  const auto& segments = loaded.maps[0].segments;
  EXPECT_EQ(segments[0].voxels, 0U);
  EXPECT_EQ(segments[1].voxels, 4U);
  ASSERT_EQ(loaded.notes.size(), 2U);
  EXPECT_NE(loaded.notes[0].find("'far': 100 %"), std::string::npos) << loaded.notes[0];
  EXPECT_NE(loaded.notes[1].find("'half': 91 %"), std::string::npos) << loaded.notes[1];
}

// The image ends half a voxel beyond the centres of its outermost voxels.
TEST(StructureSet, OneWhollyOutsideTheImageIsRefusedWithTheWayToIt)
{
  struct Case
  {
    Vector3d center;
    const char* way; // to the nearest point of a circle of 4 mm
  };
  const Case cases[] = {{{0.0, 0.0, 80.0}, "35.5 mm superior to it"}, // the last slice is at 44
                        {{0.0, 0.0, -5.5}, "10.0 mm inferior to it"},
                        {{100.15, 0.0, 20.0}, "66.4 mm left of it"}, // the last column at 29.5
                        {{-50.05, 0.0, 20.0}, "35.8 mm right of it"},
                        {{0.0, 30.05, 20.0}, "6.3 mm posterior to it"}, // the last row at 19.5
                        {{0.0, -30.05, 20.0}, "5.8 mm anterior to it"}};
  for (const Case& one : cases)
    for (const bool hasEmpty : {false, true})
    {
      StructureSet set;
      set.rois = {named("nearer", {circle(one.center, 4.0)}),
                  named("far", {circle(one.center + 5.0 * (one.center - grid().center()), 4.0)})};
      if (hasEmpty)
        set.rois.push_back(named("empty", {}));
      std::string text;
      try
      {
        imaging::labelsOf(set, grid(), "set.dcm");
      }
      catch (const FileError& error)
      {
        EXPECT_EQ(error.reason, Reason::Unsupported);
        text = error.what();
      }
      EXPECT_NE(text.find(std::string("nearest contour ") + one.way), std::string::npos)
          << text << " instead of " << one.way;
    }
}

TEST(StructureSet, IsReadInEveryEncoding)
{
  const TemporaryFolder folder;
  for (const char* encoding : {"explicit", "implicit", "big endian"})
  {
    TestSet file;
    file.code.implicitVr = encoding[0] == 'i';
    file.code.bigEndian = encoding[0] == 'b';
    file.add(4, "Nervus facialis \xe4", {"1\\2\\3\\4\\2\\3\\4\\6.5\\3\\1\\6.5\\3\\1\\2\\3"});
    file.add(-2, "marker", {"1\\2\\3"}, "POINT");
    file.add(9, "empty", {});
    const auto path = file.write(folder);
    EXPECT_TRUE(isStructureSet(path));
    const StructureSet set = readStructureSet(path);
    ASSERT_EQ(set.rois.size(), 3U);
    EXPECT_EQ(set.frameOfReferenceUid, "1.2.3.9");
    EXPECT_EQ(set.rois[0].name, "Nervus facialis \xc3\xa4");
    EXPECT_EQ(set.rois[0].meaning, "ORGAN");
    EXPECT_FLOAT_EQ(set.rois[0].color[1], 128.0F / 255.0F);
    ASSERT_EQ(set.rois[0].contours.size(), 1U);
    ASSERT_EQ(set.rois[0].contours[0].size(), 4U) << "the first point is not repeated";
    EXPECT_EQ(set.rois[0].contours[0][2], Vector3d(4.0, 6.5, 3.0));
    EXPECT_EQ(set.rois[1].otherContours, 1U);
    EXPECT_TRUE(set.rois[2].contours.empty());
  }
}

TEST(StructureSet, StatesWhoseItIs)
{
  const TemporaryFolder folder;
  for (const bool isImplicit : {false, true})
  {
    TestSet set;
    set.code.implicitVr = isImplicit;
    set.add(1, "cochlea", {"0\\0\\10\\4\\0\\10\\0\\4\\10"});
    const PatientKey key = readStructureSet(set.write(folder)).patient;
    EXPECT_EQ(key.name, patientKey("", "", "Secret Name", "").name);
    EXPECT_EQ(key.id, 0U);
  }
}

TEST(StructureSet, WhatMakesNoSenseIsRefusedInOneLine)
{
  const TemporaryFolder folder;
  const auto with = [&](const auto& change)
  {
    TestSet file;
    file.add(1, "a", {"1\\2\\3\\4\\2\\3\\4\\6\\3"});
    change(file);
    return refusal(file.write(folder));
  };
  EXPECT_EQ(with([](TestSet&) {}), "");
  EXPECT_NE(with([](TestSet& file) { file.add(1, "b", {}); }), "");
  EXPECT_NE(with([](TestSet& file) { file.add(2, "b", {"1\\2\\3\\4"}); }), "");
  EXPECT_NE(with([](TestSet& file) { file.add(2, "b", {"1\\2\\nan\\1\\2\\3\\4\\5\\6"}); }), "");
  for (const std::string far : {"1e30", "1e6", "-20000"})
  {
    const std::string why =
        with([&far](TestSet& file) { file.add(2, "b", {"1\\2\\" + far + "\\1\\2\\3\\4\\5\\6"}); });
    EXPECT_NE(why.find("more than 10 m from the origin"), std::string::npos) << far << why;
  }
  EXPECT_NE(with([](TestSet& file) { file.add(2, "b", {}, "CLOSED_PLANAR", "1.2.77"); }), "");
  EXPECT_NE(with([](TestSet& file) { file.rois.clear(); }), "");
  // A second item of one structure: its contours would be holes of the first.
  const auto again = [](const std::vector<std::string>& contours)
  {
    return [contours](TestSet& file)
    {
      const std::string described = file.rois;
      file.add(1, "a", contours);
      file.rois = described;
    };
  };
  const std::string twice = with(again({"2\\3\\3\\3\\3\\3\\3\\4\\3"}));
  EXPECT_NE(twice.find("one structure twice"), std::string::npos) << twice;
  EXPECT_EQ(with(again({})), "") << "without contours it takes nothing away";
  EXPECT_NE(with([](TestSet& file) { file.code.bigEndian = true; }), "") << "items are not";

  TestSet file;
  file.add(1, "a", {"1\\2\\3\\4\\2\\3\\4\\6\\3", "1\\2\\4\\4\\2\\4\\4\\6\\4"});
  const std::string whole = file.bytes();
  const auto path = folder.path() / "cut.dcm";
  for (std::size_t hundredths = 0; hundredths < 100; ++hundredths)
  {
    std::ofstream(path, std::ios::binary)
        .write(whole.data(), static_cast<long>(whole.size() * hundredths / 100));
    try
    {
      if (!isStructureSet(path))
        continue;
      // Cut between two elements of the top level, it is a shorter file without fault.
      const StructureSet set = readStructureSet(path);
      EXPECT_LE(set.rois.size(), 1U);
    }
    catch (const FileError& error)
    {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

// Squares of 10 x 10 mm at z = 10 and 11; PS3.3-2019 C.8.8.6.2: the central plane of a slab is "the
// set of points offset from Contour Data by the value of Contour Offset Vector", and this is zero
// without a valid thickness.
TEST(StructureSet, ASlabLiesWhereItsContourOffsetVectorPutsIt)
{
  const TemporaryFolder folder;
  const auto squareAt = [](const std::string& z)
  { return "0\\-10\\" + z + "\\10\\-10\\" + z + "\\10\\0\\" + z + "\\0\\0\\" + z; };
  const auto written = [&](const std::string& thickness, const std::string& offset)
  {
    TestSet file;
    file.ofContours = (thickness.empty() ? "" : file.element(0x30060044, "DS", thickness)) +
                      file.element(0x30060045, "DS", offset);
    file.add(1, "box", {squareAt("10"), squareAt("11")});
    return file.write(folder);
  };
  const auto lowest = [](const std::filesystem::path& path)
  {
    const StructureSet set = readStructureSet(path);
    return set.rois.front().contours.front().front().z();
  };
  const auto notesOf = [](const std::filesystem::path& path)
  {
    std::string all;
    for (const std::string& note : imaging::labelsOf(readStructureSet(path), grid(), path).notes)
      all += note + "\n";
    return all;
  };
  EXPECT_EQ(lowest(written("1", "0\\0\\2.5")), 12.5);
  EXPECT_NE(notesOf(written("1", "0\\0\\2.5")).find("2 contours were moved by 2.5 mm"),
            std::string::npos);
  EXPECT_EQ(lowest(written("1", "0\\0\\-3")), 7.0);
  EXPECT_EQ(lowest(written("1", "0\\0\\0")), 10.0);
  EXPECT_EQ(notesOf(written("1", "0\\0\\0")), "");
  EXPECT_EQ(lowest(written("", "0\\0\\2.5")), 10.0);
  EXPECT_NE(notesOf(written("", "0\\0\\2.5")).find("nothing was moved"), std::string::npos);
  EXPECT_NE(refusal(written("1", "2\\0\\0")).find("within its plane"), std::string::npos);
  EXPECT_NE(refusal(written("1", "2\\0")).find("not three numbers"), std::string::npos);
}

TEST(StructureSet, AnotherNumberOfPointsThanStatedIsRefused)
{
  const TemporaryFolder folder;
  const auto stated = [&](const std::string& count)
  {
    TestSet file;
    file.ofContours = file.element(0x30060046, "IS", count);
    file.add(1, "a", {"1\\2\\3\\4\\2\\3\\4\\6\\3"});
    return refusal(file.write(folder));
  };
  EXPECT_EQ(stated("3"), "");
  EXPECT_EQ(stated(""), "");
  for (const std::string wrong : {"2", "4", "9", "many"})
    EXPECT_NE(stated(wrong).find("contour of 3 points"), std::string::npos) << wrong;
}

// One square of 10 x 10 mm, or two 2 mm apart, on slices 1 mm apart.
TEST(StructureSet, SlabsAndPlanesThatTheFileStatesCount)
{
  Roi one = named("box", {square(0.25, 10.25, -10.25, -0.25, 12.0)});
  EXPECT_NEAR(contourVolume(one, grid()), 100.0, 1e-6);
  one.slabThickness = 3.0;
  EXPECT_NEAR(contourVolume(one, grid()), 300.0, 1e-6);
  Roi two = one;
  two.contours.push_back(square(0.25, 10.25, -10.25, -0.25, 14.0));
  two.slabThickness = 0.0;
  EXPECT_NEAR(contourVolume(two, grid()), 400.0, 1e-6);
  two.planeSpacing = 1.0; // the plane between has no contour: PS3.3 C.8.8.6.4
  EXPECT_NEAR(contourVolume(two, grid()), 200.0, 1e-6);
  two.planeSpacing = 1.3; // not so
  EXPECT_NEAR(contourVolume(two, grid()), 400.0, 1e-6);
  two.planeSpacing = 0.0;
  two.slabThickness = 1.0;
  StructureSet set;
  set.rois = {two};
  const LoadedLabels loaded = imaging::labelsOf(set, grid(), "set.dcm");
  EXPECT_TRUE(std::any_of(loaded.notes.begin(), loaded.notes.end(),
                          [](const std::string& note)
                          { return note.find("slabs of 1 mm") != std::string::npos; }));
  const TemporaryFolder folder;
  TestSet file;
  file.ofContours = file.element(0x30060044, "DS", "2.5");
  file.ofRois = file.element(0x3006004a, "SQ", file.item(file.element(0x00180088, "DS", "0.5")));
  file.add(1, "a", {"1\\2\\3\\4\\2\\3\\4\\6\\3"});
  const StructureSet read = readStructureSet(file.write(folder));
  EXPECT_EQ(read.rois.front().slabThickness, 2.5);
  EXPECT_EQ(read.rois.front().planeSpacing, 0.5);
}

// A structure set that was resampled to thinner slices states those of before: slabs that thick
// would reach far beyond its ends, and far thinner ones would leave next to nothing of it.
TEST(StructureSet, StatedPlanesThatCannotBeAreNotFollowed)
{
  const auto noteOf = [](const Roi& roi)
  {
    StructureSet set;
    set.rois = {roi};
    std::string all;
    for (const std::string& note : imaging::labelsOf(set, grid(), "set.dcm").notes)
      all += note + "\n";
    return all;
  };
  Roi three = named("nerve", {square(0.25, 10.25, -10.25, -0.25, 12.0),
                              square(0.25, 10.25, -10.25, -0.25, 13.0),
                              square(0.25, 10.25, -10.25, -0.25, 14.0)});
  EXPECT_EQ(noteOf(three), "");
  for (const double wrong : {10.0, 30.0, 1000.0, 0.1})
  {
    three.planeSpacing = wrong;
    EXPECT_NEAR(contourVolume(three, grid()), 300.0, 1e-6) << wrong;
    EXPECT_NE(noteOf(three).find("but its contours lie otherwise"), std::string::npos) << wrong;
  }
  three.planeSpacing = 0.5; // not wrong, but to be looked at
  EXPECT_NEAR(contourVolume(three, grid()), 150.0, 1e-6);
  EXPECT_NE(noteOf(three).find("its contours lie 1 mm apart"), std::string::npos) << noteOf(three);

  Roi one = named("nerve", {square(0.25, 10.25, -10.25, -0.25, 12.0)});
  for (double Roi::*stated : {&Roi::planeSpacing, &Roi::slabThickness})
  {
    Roi thick = one;
    thick.*stated = 30.0;
    EXPECT_NEAR(contourVolume(thick, grid()), 100.0, 1e-6);
    EXPECT_NE(noteOf(thick).find("cannot be so"), std::string::npos) << noteOf(thick);
    thick.*stated = 3.0;
    EXPECT_NEAR(contourVolume(thick, grid()), 300.0, 1e-6);
    EXPECT_NE(noteOf(thick).find("stands for 3 mm, as the file states"), std::string::npos)
        << noteOf(thick);
  }
}

} // namespace petrous::imaging
