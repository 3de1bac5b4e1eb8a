#include <set>

#include <gtest/gtest.h>

#include "TestCase.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/NewerVersion.h"
#include "petrous/Scene/Manifest.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/VideoNotes.h"

using namespace petrous;
using namespace petrous::library;
using test::TemporaryFolder;

// Stored files of each format, which Formats/make.py wrote after their definitions: its values are
// the truth here.
namespace
{

namespace fs = std::filesystem;

const fs::path kFormats = PETROUS_FORMATS;

std::string formatName(int format)
{
  return "format-" + std::to_string(format);
}

void expectMask(const scene::Case& value, const std::map<std::array<int, 3>, int>& left)
{
  const volume::CutMask& mask = value.dissection.mask();
  const core::Index3& dims = value.ct.geometry.dims();
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
      {
        const auto drilled = left.find({i, j, k});
        ASSERT_EQ(mask.at(i, j, k), drilled == left.end() ? 65535 : drilled->second)
            << i << ' ' << j << ' ' << k;
      }
}

void expectCt(const scene::Case& value)
{
  ASSERT_EQ(value.ct.geometry.dims(), (core::Index3{8, 7, 6}));
  EXPECT_EQ(value.ct.geometry.spacing(), Eigen::Vector3d(0.5, 0.75, 1.0));
  EXPECT_EQ(value.ct.geometry.origin(), Eigen::Vector3d(10.0, -20.0, 30.0));
  const auto ct = value.ct.volume.get();
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 7; ++j)
      for (int i = 0; i < 8; ++i)
        ASSERT_EQ(ct->at(i, j, k), 100 + i + 10 * j + 100 * k);
}

void expectStructures(const scene::Case& value)
{
  ASSERT_EQ(value.mr.size(), 1U);
  EXPECT_EQ(value.mr[0].volume.get()->at(3, 4, 2), 5 * 3 + 4 * 2);
  EXPECT_TRUE(value.mr[0].registered);
  EXPECT_EQ(value.mr[0].mrFromCt.translation(), Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(value.labels.size(), 2U);
  const auto nerve = value.labels[0].labels.get();
  EXPECT_EQ(nerve->voxels->at(2, 2, 3), 3);
  EXPECT_EQ(nerve->voxels->at(3, 2, 3), 0);
  EXPECT_EQ(value.labels[0].structures.at(0).name, "nerve");
  EXPECT_EQ(value.labels[0].structures.at(0).look.preset, "nerve");
  EXPECT_EQ(value.labels[0].structures.at(0).look.opacity, 0.5F);
  EXPECT_FALSE(value.labels[0].structures.at(0).look.drillable);
  // Before format 3 the grid tells on which image it was drawn.
  EXPECT_EQ(scene::placementOf(value, value.labels[0]).drawnOn, "");
  EXPECT_EQ(scene::placementOf(value, value.labels[1]).drawnOn, "T2");
  ASSERT_EQ(value.meshes.size(), 1U);
  EXPECT_EQ(value.meshes[0].mesh.get()->vertices.at(1), Eigen::Vector3f(12, -19, 31));
}

void expectHistory(const scene::Case& value, int format)
{
  const dissection::History& history = value.dissection.history();
  if (format == 1)
  {
    EXPECT_EQ(value.dissection.strokes().size(), 2U);
    EXPECT_EQ(history.branch().name, "main");
    EXPECT_EQ(history.ahead(), 1U);
    return expectMask(value, {{{2, 3, 4}, 0}, {{3, 3, 4}, 64535}});
  }
  ASSERT_EQ(value.dissection.strokes().size(), 3U);
  EXPECT_TRUE(value.dissection.strokes()[2]->info.recovered);
  EXPECT_EQ(value.dissection.strokes()[0]->info.burr.kind, dissection::Burr::Kind::Diamond);
  EXPECT_EQ(value.dissection.strokes()[1]->info.structures.at(0).volume, 0.125);
  EXPECT_EQ(history.branch().name, "behind");
  EXPECT_EQ(history.parent(2), 0U);
  EXPECT_EQ(history.find("main")->tip, 1U);
  EXPECT_EQ(history.find("main")->position, 0U);
  expectMask(value, {{{2, 3, 4}, 0}, {{3, 3, 4}, 0}});
}

void expectCase(const scene::Case& value, int format, bool isArchived = false)
{
  EXPECT_EQ(value.iso, 321.5);
  EXPECT_EQ(value.denseBone, 1700.0);
  ASSERT_TRUE(value.camera);
  EXPECT_EQ(value.camera->viewAngle, 25.0);
  expectCt(value);
  expectStructures(value);
  expectHistory(value, format);
  EXPECT_EQ(value.mr[0].registration.has_value(), format >= 3);
  const auto& codes = value.labels[0].structures[0].codes;
  EXPECT_EQ(codes.type.value, format >= 4 ? "56052001" : "");
  EXPECT_EQ(value.description.note, format >= 5 ? "two lines\nof a note" : "");
  EXPECT_EQ(value.description.tags,
            format >= 5 ? std::vector<std::string>{"teaching"} : std::vector<std::string>{});
  EXPECT_EQ(value.description.date, format >= 5 ? "2026-03-31" : "");
  ASSERT_EQ(value.view.branches.count("main"), format >= 5 ? 1U : 0U);
  if (format >= 5)
  {
    const scene::ViewState::Saved& left = value.view.branches.at("main");
    EXPECT_EQ(left.camera->viewAngle, 25.0);
    EXPECT_EQ(left.slices.has_value(), format >= 10);
    ASSERT_EQ(left.clipping.has_value(), format >= 10);
    if (format >= 10)
    {
      EXPECT_EQ(left.slices->width, 400.0);
      EXPECT_EQ(left.clipping->crop, (core::IndexBox{{0, 1, 2}, {5, 6, 6}}));
    }
  }
  EXPECT_EQ(value.view.light.has_value(), format >= 6);
  ASSERT_EQ(value.attachments.size(), format >= 8 ? 2U : format >= 6 ? 1U : 0U);
  if (format >= 8)
  {
    ASSERT_TRUE(value.attachments[1].video);
    const scene::VideoNotes& notes = *value.attachments[1].video;
    EXPECT_EQ(notes.bookmarks.at(0).time, 1234567890);
    EXPECT_EQ(scene::strokeWith(value, notes.bookmarks[0].stroke), 1U);
    EXPECT_EQ(notes.stills.at(0).camera->viewAngle, 25.0);
    EXPECT_EQ(notes.stills[0].landmarks.at(0).still.x(), 960.5);
  }
  EXPECT_EQ(value.view.saved.count("from above"), format >= 7 ? 1U : 0U);
  ASSERT_EQ(value.measurements.size(), format >= 7 ? 1U : 0U);
  if (format >= 7)
  {
    EXPECT_EQ((value.measurements[0].points[1] - value.measurements[0].points[0]).norm(), 5.0);
  }
  ASSERT_EQ(value.view.instrument.has_value(), format >= 9);
  if (format >= 9)
  {
    EXPECT_EQ(value.view.instrument->name, "pick.stl");
    EXPECT_EQ(value.view.instrument->axis, "z+");
    EXPECT_EQ(value.view.instrument->mesh.get()->vertices.at(3), Eigen::Vector3f(-1, -1, 60));
  }
  for (const core::AxesCorrection& axes :
       {value.ct.provenance.axes, value.labels[0].provenance.axes})
    EXPECT_EQ(axes.letters(), format >= 10 ? "RPS" : "LPS");
  EXPECT_TRUE(value.mr[0].provenance.axes.isIdentity());
  EXPECT_EQ(value.ct.frameOfReference.empty(), format < 3 || (isArchived && format > 3));
}

class Formats : public ::testing::Test
{
protected:
  void SetUp() override
  {
    fs::copy(kFormats / "objects", m_folder.path() / "objects");
    fs::create_directory(m_folder.path() / "cases");
  }
  void bring(int format) const
  {
    const std::string name = formatName(format);
    fs::copy(kFormats / "cases" / (name + ".json"), m_folder.path() / "cases",
             fs::copy_options::overwrite_existing);
  }
  scene::Case opened(const std::string& name) const
  {
    scene::Case value = m_library.open(name);
    m_library.loadDissection(value);
    return value;
  }
  std::string manifestOf(const std::string& name) const
  {
    std::ifstream file(m_folder.path() / "cases" / (name + ".json"));
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TemporaryFolder m_folder;
  Library m_library{m_folder.path()};
};

} // namespace

// As it is read, and once more after this program has saved it in its own format.
TEST_F(Formats, CasesOfEachFormatOpenAndMigrate)
{
  std::ofstream(m_folder.path() / "salt") << std::string(64, '0'); // of that time
  for (int format = 1; format <= scene::kManifestFormat; ++format)
  {
    SCOPED_TRACE(formatName(format));
    bring(format);
    std::string notice; // they have no checksum
    m_library.onNotice([&notice](const std::string& words) { notice = words; });
    scene::Case value = opened(formatName(format));
    EXPECT_EQ(notice, "");
    m_library.onNotice(nullptr);
    expectCase(value, format);
    m_library.save(value);
    EXPECT_EQ(value.revision, 6U);
    EXPECT_EQ(manifestOf(value.name).find("frame_of_reference_sha256"), std::string::npos);
    EXPECT_FALSE(value.id.empty() && format > 1);
    expectCase(opened(formatName(format)), format);
  }
  EXPECT_TRUE(m_library.verify().damaged.empty());
}

TEST_F(Formats, ACaseOfANewerFormatIsRefusedInWordsAndStays)
{
  const int newer = scene::kManifestFormat + 1;
  bring(newer);
  const std::string before = manifestOf(formatName(newer));
  try
  {
    m_library.open(formatName(newer));
    ADD_FAILURE();
  }
  catch (const scene::ManifestError& error)
  {
    EXPECT_EQ(error.reason, scene::ManifestError::Reason::NewerFormat);
    EXPECT_NE(std::string(error.what())
                  .find("format-11.json: written by format 11; this program "
                        "reads up to 10"),
              std::string::npos)
        << error.what();
  }
  // It counts in what is kept: its objects are needed.
  EXPECT_THROW(m_library.collectGarbage(), core::Error);
  // Not damage, and no other case's trouble.
  bring(7);
  std::ofstream(m_folder.path() / "salt") << std::string(64, '0'); // else that is what is missing
  EXPECT_TRUE(m_library.verify().damaged.empty());
  const auto found = casesOfNewerVersion(m_library.folder());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, formatName(newer));
  EXPECT_FALSE(found[0].isDeleted);
  EXPECT_NE(found[0].text.find("newer version of Petrous"), std::string::npos) << found[0].text;
  EXPECT_TRUE(isOfNewerVersion(m_library.folder(), formatName(newer)));
  EXPECT_FALSE(isOfNewerVersion(m_library.folder(), "format-7"));
  EXPECT_FALSE(isOfNewerVersion(m_library.folder(), "none"));
  std::ofstream(m_folder.path() / "cases" / "broken.json") << "{";
  EXPECT_FALSE(isOfNewerVersion(m_library.folder(), "broken"));
  EXPECT_EQ(m_library.verify().damaged.size(), 1U);
  EXPECT_EQ(manifestOf(formatName(newer)), before);
}

// Their hashes name no salt: they are of the library's if that is of the form of these programs.
TEST_F(Formats, HashesWithoutAnIdAreOfASaltOfThatTime)
{
  bring(7);
  const std::string name = formatName(7);
  std::ofstream(m_folder.path() / "salt") << std::string(64, '0');
  const scene::IdentitySalt former = frameSalter(m_library);
  EXPECT_EQ(former.id(), "");
  EXPECT_FALSE(hasLostSalt(m_library.open(name), former));
  EXPECT_TRUE(m_library.repair().lost.empty());
  fs::remove(m_folder.path() / "salt"); // lost, and another one drawn
  const scene::IdentitySalt drawn = frameSalter(m_library);
  EXPECT_EQ(drawn.id().size(), 16U);
  EXPECT_TRUE(hasLostSalt(m_library.open(name), drawn));
  EXPECT_EQ(m_library.verify().damaged.size(), 1U);
}

// The first programs' journals named neither the CT nor the history.
TEST_F(Formats, JournalsOfEachFormatComeBack)
{
  for (const auto& [file, format] : {std::pair("journal-first", 2), std::pair("journal-1", 7)})
  {
    SCOPED_TRACE(file);
    bring(format);
    const std::string name = formatName(format);
    const fs::path journal = m_folder.path() / "cases" / (name + ".journal");
    fs::copy(kFormats / file, journal);
    const scene::Case value = opened(name);
    EXPECT_FALSE(fs::exists(journal));
    ASSERT_EQ(value.dissection.strokes().size(), 4U);
    EXPECT_EQ(value.dissection.strokes()[3]->info.removed, 7.5);
    expectMask(value, {{{2, 3, 4}, 0}, {{3, 3, 4}, 0}, {{0, 0, 5}, 0}, {{1, 0, 5}, 65535 - 20000}});
  }
}

// Only a newer program can read it, and it holds what was drilled: it stays where that finds it.
TEST_F(Formats, AJournalOfANewerFormatStays)
{
  bring(7);
  const fs::path journal = m_folder.path() / "cases/format-7.journal";
  fs::copy(kFormats / "journal-2", journal);
  std::string notice;
  m_library.onNotice([&notice](const std::string& words) { notice = words; });
  expectCase(opened("format-7"), 7);
  EXPECT_NE(notice.find("written by format 2; this program reads up to 1"), std::string::npos)
      << notice;
  EXPECT_TRUE(fs::exists(journal));
}

TEST_F(Formats, AnIndexOfAnyVersionIsNotBelieved)
{
  bring(5);
  bring(7);
  for (int version = 1; version <= 4; ++version)
  {
    SCOPED_TRACE(version);
    fs::copy(kFormats / ("index-" + std::to_string(version) + ".sqlite"),
             m_folder.path() / "library.sqlite", fs::copy_options::overwrite_existing);
    for (int n = 0; n < 2; ++n) // the second time from what was made of it
    {
      const auto listed = m_library.list();
      ASSERT_EQ(listed.size(), 2U);
      EXPECT_EQ(listed[1].name, "format-7");
      EXPECT_EQ(listed[1].structures, 2U);
      EXPECT_EQ(listed[1].strokes, 2U);
      EXPECT_EQ(m_library.search("teaching incus").size(), 2U);
      m_library.repair();
    }
  }
}

TEST_F(Formats, ArchivesOfEachFormatAreRestored)
{
  for (const int format : {1, 4, 7})
  {
    SCOPED_TRACE(formatName(format));
    const TemporaryFolder folder;
    Library other(folder.path() / "library");
    const auto done =
        restoreCase(other, kFormats / ("archive-1-case-" + std::to_string(format) + ".petrous"));
    EXPECT_EQ(done.newParts, done.parts);
    scene::Case value = other.open(formatName(format));
    other.loadDissection(value);
    expectCase(value, format, true);
    EXPECT_TRUE(other.verify().damaged.empty());
  }
  // A plan on the very CT.
  bring(7);
  restoreCase(m_library, kFormats / "archive-1-plan.petrous", {"plan", "format-7"});
  const scene::Case plan = opened("plan");
  expectCt(plan);
  expectHistory(plan, 5);
  EXPECT_EQ(plan.description.diagnosis, "otosclerosis");
}

TEST_F(Formats, AnArchiveOfANewerFormatIsRefusedInWords)
{
  const auto refusedAs = [&](const char* file)
  {
    try
    {
      restoreCase(m_library, kFormats / file);
    }
    catch (const core::Error& error)
    {
      return std::string(error.what());
    }
    return std::string("restored");
  };
  EXPECT_NE(refusedAs("archive-2.petrous").find("written by a newer version of this program"),
            std::string::npos);
  EXPECT_NE(refusedAs("archive-1-case-11.petrous").find("written by format 11"), std::string::npos);
  EXPECT_TRUE(m_library.list().empty());
}
