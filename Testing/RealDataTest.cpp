#include <map>
#include <set>
#include <sstream>

#include "CommandRunner.h"

using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

// The complete workflow on real CT, if the data are available beside the project.
class RealData : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    const char* data = std::getenv("PETROUS_DATA");
    if (!data || !*data)
      GTEST_SKIP() << "no real data beside the project (PETROUS_DATA is not set)";
    m_data = data;
  }

  void walk(const std::filesystem::path& series, const std::string& roi)
  {
    if (!std::filesystem::exists(series))
      GTEST_SKIP() << series << " is not there";
    json("new head --ct " + quoted(series) + " --roi " + roi);
    const auto info = json("info head");
    const auto& dims = info["ct"]["dims"];
    std::array<double, 3> middle{};
    for (std::size_t a = 0; a < 3; ++a)
      middle[a] = info["ct"]["origin_mm"][a].get<double>() +
                  0.5 * (dims[a].get<int>() - 1) * info["ct"]["spacing_mm"][a].get<double>();
    const auto render = [this](const std::string& name)
    {
      json("render head --size 160x120 --out " + quoted(m_folder / name));
      return textOf(m_folder / name);
    };
    const auto whole = render("whole.png");
    // Into the visible side, as deep as the handpiece permits.
    auto from = middle;
    auto to = middle;
    from[0] += middle[0] > 10.0 ? 100.0 : -100.0;
    const auto drilled = json("drill head --diameter 7 --path " + quoted(writePath(from, to)));
    EXPECT_GT(drilled["removed_mm3"], 1.0);
    EXPECT_EQ(json("undo head")["steps"], 1);
    EXPECT_TRUE(render("undone.png") == whole);
    EXPECT_EQ(json("redo head")["steps"], 1);
    const auto after = render("redone.png");
    EXPECT_TRUE(render("again.png") == after);
    EXPECT_FALSE(after == whole) << "the tunnel is not seen";
  }

  std::filesystem::path m_data;
};

} // namespace

TEST_F(RealData, VisibleHumanHeadIsBuiltDrilledUndoneAndDrawnAgain)
{
  walk(m_data / "ct_head_vhm/vhm_1080-1245", "150,330,150,330,1090,1190");
}

TEST_F(RealData, PhilipsPhantomIsBuiltDrilledUndoneAndDrawnAgain)
{
  walk(m_data / "ct_phantom/philips_S21570_S2020_notilt_1mm", "-90,90,-90,60,-400,1000");
}

namespace
{

// Of a cell "36: unreadable 24, no-geometry" the volumes and how many of them have each finding.
std::map<std::string, int> countsIn(const std::string& cell)
{
  std::map<std::string, int> counts;
  std::istringstream text(cell);
  std::string all;
  std::getline(text, all, ':');
  if (all.find_first_not_of(' ') != all.npos)
    counts["volumes"] = std::stoi(all);
  for (std::string kind; std::getline(text, kind, ',');)
  {
    std::istringstream words(kind);
    std::string name;
    int count = 1;
    words >> name >> count;
    counts[name] = words.fail() ? 1 : count;
  }
  return counts;
}

} // namespace

// The table of the guide is what the command says.
TEST_F(RealData, TheGuideCountsWhatScanSays)
{
  const std::map<std::string, std::string> folders{
      {"Visible Human head, CT", "ct_head_vhm"},
      {"CT of a head phantom, Philips", "ct_phantom"},
      {"MR, Siemens, supine and prone", "mr_positions"},
      {"enhanced MR, Philips and Siemens", "dicom_enhanced"},
      {"MR in every compression (dicom2nifti)", "dicom_odd/dicom2nifti_generic"},
      {"broken on purpose (dicom2nifti)", "dicom_odd/dicom2nifti_failing_public"},
      {"12 bits stored", "dicom_odd/dcm_qa_12bit"},
      {"odd files (pydicom)", "dicom_odd/pydicom_test_files"},
      {"segmentations with their CT (dcmqi)", "seg_rt/dcmqi"},
      {"structure sets with their CT (rt-utils)", "seg_rt/rt-utils"}};
  const std::filesystem::path guide = std::filesystem::path(__FILE__).parent_path().parent_path() /
                                      "Documentation" / "user-guide.md";
  if (!std::filesystem::exists(guide))
    GTEST_SKIP() << "no guide beside the sources";
  std::istringstream text(textOf(guide));
  std::size_t rows = 0;
  for (std::string line; std::getline(text, line);)
  {
    std::vector<std::string> cells;
    std::istringstream rest(line);
    for (std::string cell; std::getline(rest, cell, '|');)
    {
      const std::size_t first = cell.find_first_not_of(' ');
      cells.push_back(first == cell.npos
                          ? std::string()
                          : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
    const auto row = cells.size() > 5 ? folders.find(cells[1]) : folders.end();
    if (row == folders.end() || !std::filesystem::exists(m_data / row->second))
      continue;
    ++rows;
    std::map<std::string, std::map<std::string, int>> counts;
    const auto scanned = json("scan " + quoted(m_data / row->second));
    for (const auto& series : scanned["series"])
      for (const auto& volume : series["volumes"])
      {
        const bool isImage = volume["kind"] == "image";
        auto& of = counts[isImage ? volume["verdict"].get<std::string>() : "structures"];
        ++of["volumes"];
        std::set<std::string> kinds;
        for (const auto& finding : volume["findings"])
          kinds.insert(finding["kind"]);
        if (isImage && volume["verdict"] != "ok")
          for (const std::string& kind : kinds)
            ++of[kind];
      }
    const char* const columns[] = {"ok", "repairable", "refused", "structures"};
    for (std::size_t n = 0; n < 4; ++n)
      EXPECT_EQ(countsIn(cells[n + 2]), counts[columns[n]]) << cells[1] << ", " << columns[n];
  }
  EXPECT_GT(rows, 0U);
}

TEST_F(RealData, TiltedPhilipsScanIsRefusedWithTheMillimetres)
{
  const auto series = m_data / "ct_phantom/philips_S21610_S2010_tilt-18.5";
  const auto scan = json("scan " + quoted(series));
  ASSERT_EQ(scan["series"].size(), 1u);
  EXPECT_EQ(scan["series"][0]["verdict"], "repairable");
  const auto& finding = scan["series"][0]["findings"][0];
  EXPECT_EQ(finding["kind"], "gantry-tilt");
  EXPECT_GT(finding["error_mm"], 18.0);
  EXPECT_LT(finding["error_mm"], 25.0);
  expectRefused("new tilted --ct " + quoted(series), 3, "tilt");
}

// The frame of reference of a stored case is a salted hash.
TEST_F(RealData, ASegmentationOfAnotherFrameOfReferenceIsRefusedAlsoByAStoredCase)
{
  const auto folder = m_data / "seg_rt/dcmqi/data/segmentations";
  if (!std::filesystem::exists(folder / "liver.dcm"))
    GTEST_SKIP() << folder << " is not there";
  json("new abdomen --ct " + quoted(folder / "ct-3slice") + " --labels " +
       quoted(folder / "liver.dcm"));
  const auto built = json("add abdomen --labels " + quoted(folder / "partial_overlaps.dcm"));
  ASSERT_EQ(built["labels"].size(), 6u);
  EXPECT_EQ(built["labels"][0]["voxels"], 107098); // by pydicom
  const std::string foreign = quoted(folder / "sparse-labelmap-noppv.dcm");
  expectRefused("add abdomen --labels other=" + foreign, 3, "frame of reference");
  expectRefused("new again --ct " + quoted(folder / "ct-3slice") + " --labels other=" + foreign, 3,
                "frame of reference");
  EXPECT_EQ(json("info abdomen")["labels"].size(), 6u);
}

// Areas of the polygons by the shoelace formula, with numpy, in the planes that the CT has; 5 mm
// apart.
TEST_F(RealData, AnRtStructureSetHasTheVolumesOfItsContours)
{
  const auto folder = m_data / "seg_rt" / "rt-utils" / "tests" / "mock_data";
  if (!std::filesystem::exists(folder / "invalid_reference_rt.dcm"))
    GTEST_SKIP() << folder << " is not there";
  json("new a --ct " + quoted(folder));
  const auto added = json("add a --labels " + quoted(folder / "invalid_reference_rt.dcm"));
  const std::map<std::string, double> volumes{{"ROI-1", 5.0 * (468.6 + 717.5)},
                                              {"ROI-2", 5.0 * (544.0 + 337.2)},
                                              {"ROI-3", 5.0 * (422.4 + 654.8)},
                                              {"ROI-4", 5.0 * (1081.2 + 576.7)}};
  ASSERT_EQ(added["structures"].size(), volumes.size());
  for (const auto& one : added["structures"])
  {
    const double truth = volumes.at(one["name"]);
    EXPECT_NEAR(one["volume_mm3"].get<double>(), truth, 1e-3 * truth) << one["name"];
    EXPECT_GT(one["volume_file_mm3"].get<double>(), truth) << "a third of it lies outside the CT";
  }
  // Of another patient's frame of reference.
  EXPECT_EQ(run("add a --labels " + quoted(folder / "rt.dcm")).code, 3);
}
