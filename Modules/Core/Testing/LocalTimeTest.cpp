#include "petrous/Core/LocalTime.h"

#include <cstdlib>

#include <gtest/gtest.h>

using namespace petrous;

// 1 March 2024 is the day after 29 February: 1709251200 s after 1970 (date -u -d @1709251200).
TEST(LocalTime, IsThatOfTheTimeZone)
{
  const char* set = std::getenv("TZ");
  const std::string before = set ? set : "";
  const auto in = [](const char* zone)
  {
    ::setenv("TZ", zone, 1);
    ::tzset();
    return core::localTime(" %Y-%m-%d %H-%M-%S", 1709251200);
  };
  EXPECT_EQ(in("UTC0"), " 2024-03-01 00-00-00");
  EXPECT_EQ(in("WEST1"), " 2024-02-29 23-00-00") << "an hour west of Greenwich";
  EXPECT_EQ(in("EAST-2"), " 2024-03-01 02-00-00");
  if (set)
    ::setenv("TZ", before.c_str(), 1);
  else
    ::unsetenv("TZ");
  ::tzset();
}
