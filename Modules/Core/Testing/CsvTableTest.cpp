#include <sstream>

#include <gtest/gtest.h>

#include "petrous/Core/CsvTable.h"
#include "petrous/Core/Error.h"

using namespace petrous::core;

namespace
{

std::vector<std::vector<double>> read(const std::string& text)
{
  std::istringstream csv(text);
  std::vector<std::vector<double>> rows;
  readCsv(csv, "path.csv", {"a", "b"},
          [&rows](std::size_t, const std::vector<double>& row) { rows.push_back(row); });
  return rows;
}

std::string complaint(const std::string& text)
{
  try
  {
    read(text);
  }
  catch (const InvalidParameter& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(CsvTable, FindsColumnsByNameInAnyOrder)
{
  const auto rows = read("b,c,a\r\n1,2,3\r\n\r\n-4e1, 5 ,.5\r\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0], (std::vector<double>{3, 1}));
  EXPECT_EQ(rows[1], (std::vector<double>{0.5, -40}));
}

TEST(CsvTable, NamesTheLineAndTheColumnThatAreWrong)
{
  EXPECT_NE(complaint("a,b\n1,2\n3,x\n").find("path.csv, line 3: 'b'"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,nan\n").find("line 2: 'b'"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1\n").find("line 2: 'b'"), std::string::npos);
  EXPECT_NE(complaint("a\n1\n").find("no column 'b'"), std::string::npos);
  EXPECT_NE(complaint("a,b\n").find("no row"), std::string::npos);
  EXPECT_NE(complaint("a,a,b\n1,2,3\n").find("column 'a' is there twice"), std::string::npos);
  EXPECT_EQ(complaint("a,b,note,note\n1,2,x,y\n"), "") << "of no interest";
  EXPECT_NE(complaint("").find("path.csv"), std::string::npos);
}

TEST(CsvTable, TakesNoDecimalCommaForTheEndOfANumber)
{
  const std::string words = complaint("a,b\n1,2\n-30,5,-10,5\n");
  EXPECT_NE(words.find("path.csv, line 3: 4 fields, and 2 columns"), std::string::npos) << words;
  EXPECT_NE(words.find("decimal point"), std::string::npos) << words;
  EXPECT_NE(complaint("a,b,note\n1,5,2,5\n").find("line 2: 4 fields"), std::string::npos);
  EXPECT_NE(complaint("a,b,note\n1,2\n").find("line 2: 2 fields"), std::string::npos);
  EXPECT_NE(complaint("a,b\n\"1,5\",2\n").find("line 2: 'a'"), std::string::npos);
}

TEST(CsvTable, AllowsEmptyFieldsAtTheEndAndCommasInQuotes)
{
  EXPECT_EQ(read("a,b,note\n1,2,\n"), (std::vector<std::vector<double>>{{1, 2}}));
  EXPECT_EQ(read("a,b\n1,2,\n"), (std::vector<std::vector<double>>{{1, 2}}));
  EXPECT_EQ(read("a,b,\n1,2\n3,4,,\r\n"), (std::vector<std::vector<double>>{{1, 2}, {3, 4}}));
  EXPECT_EQ(read("a,note,b\n1,\"left, or right\",2\n"), (std::vector<std::vector<double>>{{1, 2}}));
}

TEST(CsvTable, TakesTheDelimiterOfTheHeader)
{
  EXPECT_EQ(read("a;b\n1;-2.5\n"), (std::vector<std::vector<double>>{{1, -2.5}}));
  EXPECT_EQ(read("b\ta\n1\t2\n"), (std::vector<std::vector<double>>{{2, 1}}));
  EXPECT_NE(complaint("a;b\n1,5;2\n").find("decimal point"), std::string::npos);
}
