#include "PointsFile.h"

#include "Context.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/InputFile.h"

namespace petrous::cli
{

std::vector<Eigen::Vector3d> readPoints(const std::filesystem::path& path)
{
  std::ifstream file = core::openInput(path, kLargestInput);
  std::vector<Eigen::Vector3d> points;
  core::readCsv(file, path.string(), {"x_mm", "y_mm", "z_mm"},
                [&points](std::size_t, const std::vector<double>& row)
                { points.emplace_back(row[0], row[1], row[2]); });
  return points;
}

} // namespace petrous::cli
