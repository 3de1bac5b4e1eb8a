#include "petrous/Presenters/DeviceLimits.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include <unistd.h>

#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::presenters;

TEST(DeviceLimits, KeepsOneStiffnessForEachServerAndItsDevice)
{
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("device-limits-" + std::to_string(::getpid()));
  const std::filesystem::path file = folder / "petrous" / "device-limits.json";
  EXPECT_FALSE(keptStiffness(file, "touch", "Touch"));
  keepStiffness(file, "touch", "Touch", 0.35);
  keepStiffness(file, "omega", "omega.7", 2.0);
  keepStiffness(file, "touch", "Touch", 0.45);
  EXPECT_EQ(keptStiffness(file, "touch", "Touch"), 0.45);
  EXPECT_EQ(keptStiffness(file, "omega", "omega.7"), 2.0);
  EXPECT_FALSE(keptStiffness(file, "touch", "Touch X")) << "another device at the same server";
  for (const double bad : {0.0, -1.0, 21.0, std::nan("")})
    EXPECT_THROW(keepStiffness(file, "touch", "Touch", bad), core::InvalidParameter);

  for (const char* text : {"", "[]", "{\"touch\": 1}", "{\"touch\": {\"device\": \"Touch\"}}",
                           "{\"touch\": {\"device\": \"Touch\", \"max_stiffness_n_per_mm\": 1e9}}"})
  {
    std::ofstream(file, std::ios::trunc) << text;
    EXPECT_FALSE(keptStiffness(file, "touch", "Touch")) << text;
  }
  keepStiffness(file, "touch", "Touch", 0.5);
  EXPECT_EQ(keptStiffness(file, "touch", "Touch"), 0.5);
  std::filesystem::remove_all(folder);
}
