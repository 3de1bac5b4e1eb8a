#include "RegistrationFiles.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include <nlohmann/json.hpp>

#include "Context.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"

namespace petrous::cli
{

namespace
{

std::vector<double> numbersIn(std::string text)
{
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_object() && json.contains("transform") && json["transform"].is_array())
  {
    std::vector<double> numbers;
    for (const auto& number : json["transform"])
      if (number.is_number())
        numbers.push_back(number.get<double>());
    return numbers;
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == ';' || c == '[' || c == ']'; },
      ' ');
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string word; stream >> word;)
  {
    const auto number = core::parseDouble(word);
    if (!number)
      return {};
    numbers.push_back(*number);
  }
  return numbers;
}

} // namespace

std::vector<registration::LandmarkPair> readLandmarks(const std::string& path)
{
  std::ifstream file = core::openInput(path, kLargestInput);
  std::vector<registration::LandmarkPair> pairs;
  core::readCsv(file, path, {"ct_x", "ct_y", "ct_z", "mr_x", "mr_y", "mr_z"},
                [&pairs](std::size_t, const std::vector<double>& v) {
                  pairs.push_back({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
                });
  try
  {
    registration::fitLandmarks(pairs);
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter(path + ": " + error.what());
  }
  return pairs;
}

core::RigidTransform readTransform(const std::string& path)
{
  const std::vector<double> numbers = numbersIn(core::readFile(path, kLargestJson));
  if (numbers.size() != 16)
    throw core::InvalidParameter(path + ": holds no transform; give 16 numbers, row by row, or "
                                        "JSON with them under \"transform\"");
  Eigen::Matrix4d matrix;
  for (int n = 0; n < 16; ++n)
    matrix(n / 4, n % 4) = numbers[static_cast<std::size_t>(n)];
  try
  {
    return core::RigidTransform::fromMatrix(matrix);
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter(path + ": " + error.what());
  }
}

} // namespace petrous::cli
