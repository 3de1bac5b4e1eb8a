#include "../src/Journal/Graft.h"

#include <gtest/gtest.h>

#include "TestCase.h"
#include "petrous/Scene/Branches.h"

using namespace petrous;
using namespace petrous::library;
using test::drill;
using test::smallCase;
using test::TemporaryFolder;

namespace
{

// A case with one stroke, opened by two programs.
class Graft : public ::testing::Test
{
protected:
  Graft()
  {
    scene::Case value = smallCase("ear", 20);
    m_library.save(value);
    m_library.loadDissection(value);
    drill(value, {4, 4, 4});
    m_library.save(value);
    m_mine = open();
    m_base = m_mine;
  }

  scene::Case open() const
  {
    scene::Case value = m_library.open("ear");
    m_library.loadDissection(value);
    return value;
  }

  std::vector<std::uint16_t> voxels(const scene::Case& value) const
  {
    const auto dense = value.dissection.mask().dense();
    return {dense.data(), dense.data() + dense.size()};
  }

  TemporaryFolder m_folder;
  mutable Library m_library{m_folder.path()};
  scene::Case m_mine;
  SavedState m_base;
};

} // namespace

TEST_F(Graft, SavesAsItIsWhereNobodyElseDid)
{
  drill(m_mine, {10, 10, 10});
  EXPECT_EQ(m_library.saveDrilled(m_mine, m_base), "");
  EXPECT_EQ(voxels(open()), voxels(m_mine));
}

TEST_F(Graft, KeepsBothStrokesAndWhatAnotherProgramSet)
{
  scene::Case theirs = m_library.open("ear");
  theirs.iso = 500;
  m_library.save(theirs);
  drill(m_mine, {10, 10, 10});
  drill(m_mine, {14, 10, 10});
  const auto expected = voxels(m_mine);
  EXPECT_NE(m_library.saveDrilled(m_mine, m_base).find("branch 'main'"), std::string::npos);
  const scene::Case after = open();
  EXPECT_EQ(after.iso, 500);
  EXPECT_EQ(after.dissection.strokes().size(), 3u);
  EXPECT_EQ(after.dissection.history().branches().size(), 1u);
  EXPECT_EQ(voxels(after), expected);
}

TEST_F(Graft, AnUndoBesideADrillCostsNeither)
{
  scene::Case theirs = open();
  theirs.dissection.undo();
  m_library.save(theirs);
  drill(m_mine, {10, 10, 10});
  const auto expected = voxels(m_mine);
  EXPECT_NE(m_library.saveDrilled(m_mine, m_base).find("main~1"), std::string::npos);
  scene::Case after = open();
  EXPECT_EQ(voxels(after), expected) << "one is on the branch that was drilled";
  scene::goToBranch(after, "main");
  EXPECT_EQ(after.applied(), 0u) << "and the other is as it was left";
  EXPECT_EQ(voxels(after), voxels(theirs));
}

TEST_F(Graft, TwoLinesOfStrokesBecomeTwoBranches)
{
  scene::Case theirs = open();
  drill(theirs, {14, 14, 14});
  drill(theirs, {14, 14, 10});
  m_library.save(theirs);
  m_mine.dissection.undo();
  drill(m_mine, {10, 10, 10});
  const auto expected = voxels(m_mine);
  m_library.saveDrilled(m_mine, m_base);
  scene::Case after = open();
  EXPECT_EQ(after.dissection.strokes().size(), 4u);
  EXPECT_EQ(voxels(after), expected);
  scene::goToBranch(after, "main");
  EXPECT_EQ(voxels(after), voxels(theirs));
  EXPECT_EQ(after.dissection.history().find("main~1") != nullptr, true);
}

TEST_F(Graft, ABranchThatWasDeletedMeanwhileMakesACaseOfItsOwn)
{
  drill(m_mine, {10, 10, 10});
  const auto expected = voxels(m_mine);
  scene::Case theirs = smallCase("ear", 20);
  m_library.remove("ear");
  m_library.save(theirs); // another case of this name
  const std::string words = m_library.saveDrilled(m_mine, m_base);
  EXPECT_NE(words.find("'ear drilled 1'"), std::string::npos) << words;
  scene::Case after = m_library.open("ear drilled 1");
  m_library.loadDissection(after);
  EXPECT_EQ(voxels(after), expected);
  EXPECT_EQ(m_library.open("ear").dissection.strokes().size(), 0u);
}

TEST_F(Graft, AKilledDrillComesBackThoughAnotherProgramSavedTheCase)
{
  Journal journal(m_library, m_base);
  drill(m_mine, {10, 10, 10});
  journal.follow(m_mine.dissection);
  scene::Case theirs = open();
  theirs.iso = 500;
  m_library.save(theirs);
  journal.leave(); // simulates a kill while drilling
  std::string told;
  m_library.onNotice([&told](const std::string& words) { told = words; });
  const scene::Case after = open();
  EXPECT_EQ(after.iso, 500);
  EXPECT_EQ(voxels(after), voxels(m_mine));
  EXPECT_NE(told.find("1 stroke came back"), std::string::npos) << told;
  told.clear();
  EXPECT_EQ(open().dissection.strokes().size(), 2u) << "once";
  EXPECT_EQ(told, "");
}
