#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <unistd.h>

#include "petrous/Library/Library.h"

namespace petrous::library::test
{

/// Temporary folder, removed after the test.
class TemporaryFolder
{
public:
  explicit TemporaryFolder(
      const std::filesystem::path& place = std::filesystem::temp_directory_path())
    : m_path(place / ("petrous-library-" + std::to_string(::getpid()) + "-" +
                      std::to_string(std::random_device{}())))
  {
    std::filesystem::create_directories(m_path);
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return m_path; }

private:
  std::filesystem::path m_path;
};

/// A small case: a ramp of HU, one structure, one mesh.
inline scene::Case smallCase(const std::string& name, int n = 24)
{
  using Eigen::Vector3d;
  const core::GridGeometry grid({n, n, n}, Vector3d::Constant(0.4), Vector3d(-5, 6, -7));
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (std::size_t i = 0; i < ct->size(); ++i)
    ct->data()[i] = static_cast<std::int16_t>(400 + i % 1000);
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int i = 4; i < 10; ++i)
    labels->at(i, 8, 8) = 3;
  scene::Case value;
  value.name = name;
  value.ct.name = "ct";
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(std::move(ct)), -2000.0);
  value.ct.range = value.ct.volume.get()->range();
  scene::LabelPart part;
  volume::Segment nerve;
  nerve.name = "nerve";
  nerve.index = 3;
  auto map = volume::makeLabelMap(std::move(labels), {nerve});
  part.structures.push_back({"nerve", 3, 6, map.volume(map.segments.front()), {}});
  part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
  value.labels.push_back(std::move(part));
  auto mesh = std::make_shared<core::TriangleMesh>();
  mesh->vertices = {{0, 0, 0}, {1.25F, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  scene::MeshPart incus;
  incus.name = "incus";
  incus.triangles = 4;
  incus.mesh = std::shared_ptr<const core::TriangleMesh>(mesh);
  value.meshes.push_back(incus);
  return value;
}

/// The same, saved in the library, with its dissection loaded.
inline scene::Case savedCase(Library& library, const std::string& name = "ear", int n = 24)
{
  scene::Case value = smallCase(name, n);
  library.save(value);
  library.loadDissection(value);
  return value;
}

/// Reason and message of the library's refusal.
template <class Action>
std::pair<LibraryError::Reason, std::string> refusal(const Action& action)
{
  try
  {
    action();
  }
  catch (const LibraryError& error)
  {
    return {error.reason, error.what()};
  }
  ADD_FAILURE() << "nothing was thrown";
  return {LibraryError::Reason::NotFound, {}};
}

inline void drill(scene::Case& value, const Eigen::Vector3d& voxel)
{
  const Eigen::Vector3d p = value.ct.geometry.patientFromVoxel(voxel);
  value.dissection.beginStroke({});
  value.dissection.cut({p, p + Eigen::Vector3d(0.5, 0, 0), 1.0});
  value.dissection.openInfo().removed = 4.0;
  value.dissection.endStroke();
}

/// Every file below a folder with its content, except the lock and the index.
inline std::map<std::string, std::string> contentOf(const std::filesystem::path& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    const std::string name = std::filesystem::relative(entry.path(), folder).string();
    if (!entry.is_regular_file() || name == ".lock" || name.rfind("library.sqlite", 0) == 0)
      continue;
    std::ifstream file(entry.path(), std::ios::binary);
    files[name] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

} // namespace petrous::library::test
