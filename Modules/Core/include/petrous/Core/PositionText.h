#pragma once

#include <cmath>
#include <string>

#include <Eigen/Core>

#include "petrous/Core/NumberText.h"

namespace petrous::core
{

/// "R 32.1  P 12.0  S 45.3 mm": a patient position (LPS, mm) by its directions from the scanner's
/// zero, as the user reads it everywhere.
inline std::string positionText(const Eigen::Vector3d& patient)
{
  constexpr const char* kTowards[3][2] = {{"R ", "L "}, {"A ", "P "}, {"I ", "S "}};
  std::string text;
  for (int a = 0; a < 3; ++a)
    text += std::string(a == 0 ? "" : "  ") + kTowards[a][patient[a] > 0.0 ? 1 : 0] +
            fixedText(std::abs(patient[a]), 1);
  return text + " mm";
}

} // namespace petrous::core
