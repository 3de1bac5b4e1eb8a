#include <gtest/gtest.h>

#include "petrous/Presenters/CommandSearch.h"

using namespace petrous::presenters;

namespace
{

using Found = std::vector<std::size_t>;

const std::vector<CommandEntry> kCommands{
    {"Open DICOM…", "File", "A folder of CT slices: a new case"},
    {"Register the MR", "Registration", "Lays the MR on the CT"},
    {"Pöschl and Stenvers planes", "View › Slices", "Upright, at 45° across the petrous bone"},
    {"Add MR…", "Case", "A DICOM folder with an MR of this patient"},
    {"Smaller burr", "Drill", "The next smaller one that is sold"},
};

} // namespace

TEST(CommandSearch, FindsAllWhereNothingIsTyped)
{
  EXPECT_EQ(findCommands(kCommands, ""), (Found{0, 1, 2, 3, 4}));
  EXPECT_EQ(findCommands(kCommands, "  "), (Found{0, 1, 2, 3, 4}));
}

TEST(CommandSearch, PutsANameThatBeginsSoFirst)
{
  EXPECT_EQ(findCommands(kCommands, "re").front(), 1u);
  EXPECT_EQ(findCommands(kCommands, "mr"), (Found{1, 3})); // both words of the name, in order
  EXPECT_EQ(findCommands(kCommands, "dicom"), (Found{0, 3})) << "a name before a tip";
  EXPECT_EQ(findCommands(kCommands, "registration mr"), (Found{1}));
}

TEST(CommandSearch, NeedsEachWordWhereverItIsAndWhateverItsCase)
{
  EXPECT_EQ(findCommands(kCommands, "BURR small"), (Found{4}));
  EXPECT_EQ(findCommands(kCommands, "pÖSCHL"), (Found{2}));
  EXPECT_EQ(findCommands(kCommands, "slices petrous"), (Found{2}));
  EXPECT_EQ(findCommands(kCommands, "burr dicom"), Found{});
}

TEST(CommandSearch, ALetterWithinAWordComesAfterOneThatBeginsAWord)
{
  const std::vector<CommandEntry> two{{"Smaller burr", "", ""}, {"Large burr", "", ""}};
  EXPECT_EQ(findCommands(two, "l"), (Found{1, 0}));
}
