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
  EXPECT_NE(complaint("").find("path.csv"), std::string::npos);
}
