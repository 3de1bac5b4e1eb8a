#include "RireFolder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::registration
{

namespace
{

namespace fs = std::filesystem;

constexpr double kNotRigid = 0.1; // mm; the files are rounded to 0.0001

[[noreturn]] void wrong(const fs::path& path, const std::string& what)
{
  throw core::Error(core::Fault::BadInput, path.string() + ": " + what);
}

std::string trimmed(const std::string& text)
{
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos
             ? ""
             : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

class Header
{
public:
  explicit Header(fs::path path)
    : m_path(std::move(path))
  {
    std::ifstream file(m_path);
    if (!file)
      wrong(m_path, "cannot be read");
    for (std::string line; std::getline(file, line);)
      if (const auto sign = line.find(":="); sign != std::string::npos)
        m_values[lower(trimmed(line.substr(0, sign)))] = trimmed(line.substr(sign + 2));
  }

  double number(const std::string& name, const std::string& text) const
  {
    std::istringstream words(text);
    words.imbue(std::locale::classic());
    double value = 0.0;
    if (!(words >> value) || !(value > 0.0) || value > 1e5)
      wrong(m_path, "'" + name + "' must be a number above 0");
    return value;
  }
  double number(const std::string& name) const { return number(name, at(name)); }

  int count(const std::string& name) const
  {
    const double value = number(name);
    if (value != std::floor(value) || value > 4096.0)
      wrong(m_path, "'" + name + "' must be a whole number up to 4096");
    return static_cast<int>(value);
  }

  // "a : b : ..."
  std::vector<std::string> parts(const std::string& name) const
  {
    std::vector<std::string> result;
    std::istringstream text(at(name));
    for (std::string part; std::getline(text, part, ':');)
      result.push_back(trimmed(part));
    return result;
  }

  bool has(const std::string& name) const { return m_values.count(name) != 0; }
  const fs::path& path() const { return m_path; }

private:
  const std::string& at(const std::string& name) const
  {
    const auto found = m_values.find(name);
    if (found == m_values.end())
      wrong(m_path, "has no '" + name + "'");
    return found->second;
  }

  fs::path m_path;
  std::map<std::string, std::string> m_values;
};

// LPS direction of an ACR-NEMA letter.
Vector3d toward(const Header& header, const std::string& letter)
{
  const std::string letters = "RLAPFH";
  const auto n = letter.size() == 1 ? letters.find(letter) : std::string::npos;
  if (n == std::string::npos)
    wrong(header.path(), "'Patient Orientation' must name three of R L A P F H");
  Vector3d axis = Vector3d::Zero();
  axis[static_cast<Eigen::Index>(n / 2)] = n % 2 == 0 ? -1.0 : 1.0;
  return axis;
}

core::GridGeometry gridOf(const Header& header)
{
  const core::Index3 dims{header.count("columns"), header.count("rows"), header.count("slices")};
  const auto pixel = header.parts("pixel size");
  if (pixel.size() != 2)
    wrong(header.path(), "'Pixel size' must be two numbers");
  // ACR-NEMA: row spacing first, then column spacing.
  const Vector3d spacing(header.number("pixel size", pixel[1]),
                         header.number("pixel size", pixel[0]), header.number("slice thickness"));
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();
  if (header.has("patient orientation"))
  {
    const auto letters = header.parts("patient orientation");
    if (letters.size() != 3)
      wrong(header.path(), "'Patient Orientation' must name three of R L A P F H");
    for (Eigen::Index a = 0; a < 3; ++a)
      direction.col(a) = toward(header, letters[static_cast<std::size_t>(a)]);
    if (std::abs(std::abs(direction.determinant()) - 1.0) > 0.5)
      wrong(header.path(), "'Patient Orientation' names one direction twice");
  }
  return {dims, spacing, Vector3d::Zero(), direction};
}

// Maps RIRE's coordinates (along rows, columns, slices from the first voxel) to patient LPS.
core::RigidTransform patientFromRire(const core::GridGeometry& grid)
{
  return {Eigen::Quaterniond(grid.direction()), grid.origin()};
}

std::optional<fs::path> standardOf(const fs::path& patient, const std::string& name)
{
  const std::string wanted = lower("ct_" + name + ".standard");
  for (const auto& entry : fs::recursive_directory_iterator(patient))
    if (entry.is_regular_file() && lower(entry.path().filename().string()) == wanted)
      return entry.path();
  return std::nullopt;
}

std::vector<Vector3d> innerCorners(const core::GridGeometry& grid)
{
  std::vector<Vector3d> points;
  for (const Vector3d& corner : cornersOf(grid))
    points.push_back(0.5 * (corner + grid.center()));
  return points;
}

} // namespace

std::shared_ptr<const volume::IntensityVolume> readRireImage(const fs::path& folder)
{
  const core::GridGeometry grid = gridOf(Header(folder / "header.ascii"));
  const fs::path path = folder / "image.bin";
  std::error_code none;
  const auto bytes = fs::file_size(path, none);
  if (none)
    wrong(path, fs::exists(folder / "image.bin.Z")
                    ? "is not there; unpack image.bin.Z first (uncompress image.bin.Z)"
                    : "cannot be read");
  if (bytes != 2 * grid.voxelCount())
    wrong(path, "holds " + std::to_string(bytes) +
                    " bytes; the header's rows, columns and slices are " +
                    std::to_string(2 * grid.voxelCount()));
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(voxels->data()), static_cast<std::streamsize>(bytes)))
    wrong(path, "cannot be read");
  for (std::size_t n = 0; n < voxels->size(); ++n)
  {
    std::array<unsigned char, 2> pair{};
    std::memcpy(pair.data(), voxels->data() + n, 2);
    voxels->data()[n] = static_cast<std::int16_t>(pair[0] << 8 | pair[1]);
  }
  return std::make_shared<volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(std::move(voxels)));
}

RireStandard readRireStandard(const fs::path& path)
{
  std::ifstream file(path);
  if (!file)
    wrong(path, "cannot be read");
  Eigen::Matrix<double, 3, Eigen::Dynamic> from(3, 8), to(3, 8);
  Eigen::Index count = 0;
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::array<double, 7> v{};
    std::size_t n = 0;
    while (n < v.size() && words >> v[n])
      ++n;
    std::string rest;
    if (n < v.size() || words >> rest)
      continue;
    if (count == 8)
      wrong(path, "has more than eight points");
    from.col(count) << v[1], v[2], v[3];
    to.col(count) << v[4], v[5], v[6];
    ++count;
  }
  if (count != 8)
    wrong(path, "has " + std::to_string(count) + " points; a truth file of RIRE has eight");
  const Eigen::Matrix4d fit = Eigen::umeyama(from, to, false);
  const Eigen::Matrix3d turn = fit.topLeftCorner<3, 3>();
  RireStandard standard;
  standard.toFromFrom = {Eigen::Quaterniond(turn), fit.topRightCorner<3, 1>()};
  for (Eigen::Index n = 0; n < 8; ++n)
    standard.rms += (standard.toFromFrom * from.col(n) - to.col(n)).squaredNorm() / 8.0;
  standard.rms = std::sqrt(standard.rms);
  if (!(standard.rms < kNotRigid))
    wrong(path, "no rigid motion takes its points there (" + core::generalText(standard.rms) +
                    " mm off)");
  return standard;
}

std::vector<RegistrationPair> rirePairs(const fs::path& folder)
{
  if (!fs::is_directory(folder))
    wrong(folder, "is no folder");
  std::vector<fs::path> cts;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename() == "header.ascii" &&
        lower(entry.path().parent_path().filename().string()) == "ct")
      cts.push_back(entry.path().parent_path());
  std::sort(cts.begin(), cts.end());
  std::vector<RegistrationPair> pairs;
  for (const fs::path& ctFolder : cts)
  {
    const fs::path patient = ctFolder.parent_path();
    const auto ct = readRireImage(ctFolder);
    std::vector<fs::path> mrs;
    for (const auto& entry : fs::directory_iterator(patient))
      if (lower(entry.path().filename().string()).rfind("mr_", 0) == 0 &&
          fs::exists(entry.path() / "header.ascii"))
        mrs.push_back(entry.path());
    std::sort(mrs.begin(), mrs.end());
    for (const fs::path& mrFolder : mrs)
    {
      const std::string name = mrFolder.filename().string().substr(3);
      RegistrationPair pair;
      pair.name = "RIRE " + patient.filename().string() + " CT, MR " + name;
      pair.ct = ct;
      pair.mr = readRireImage(mrFolder);
      pair.targets = innerCorners(ct->geometry());
      if (const auto file = standardOf(patient, name))
      {
        const core::RigidTransform truth = patientFromRire(pair.mr->geometry()) *
                                           readRireStandard(*file).toFromFrom *
                                           patientFromRire(ct->geometry()).inverse();
        pair.truth = [truth](const Vector3d& p) { return truth * p; };
      }
      pairs.push_back(std::move(pair));
    }
  }
  if (pairs.empty())
    wrong(folder,
          "holds no pair of RIRE (PATIENT/ct/header.ascii with PATIENT/mr_NAME/header.ascii)");
  return pairs;
}

} // namespace petrous::registration
