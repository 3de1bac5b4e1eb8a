#include "petrous/Presenters/LeftOut.h"

namespace petrous::presenters
{

namespace
{

// A single instance, so that caches derived from it are reused.
core::Lazy<volume::LabelMap> noLabels()
{
  static const auto kNone = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(
      std::make_shared<volume::Volume<std::uint16_t>>(
          core::GridGeometry({2, 2, 2}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero()),
          std::uint16_t{0}),
      {}));
  return kNone;
}

core::Lazy<core::TriangleMesh> noMesh()
{
  static const auto kNone = std::make_shared<const core::TriangleMesh>();
  return kNone;
}

template <class T, class Part>
std::vector<LeftOut::Part<T>> unreadable(const std::vector<Part>& parts,
                                         core::Lazy<T> Part::*member,
                                         const core::Progress& progress)
{
  std::vector<LeftOut::Part<T>> found;
  const auto count = static_cast<double>(parts.size());
  for (std::size_t n = 0; n < parts.size(); ++n)
  {
    progress.report(static_cast<double>(n) / count, "loading structures");
    try
    {
      (parts[n].*member).get();
    }
    catch (const core::Error& error)
    {
      if (error.fault() == core::Fault::Cancelled)
        throw;
      found.push_back({n, error.what(), parts[n].*member});
    }
  }
  return found;
}

} // namespace

std::vector<std::string> LeftOut::sentences() const
{
  std::vector<std::string> all;
  for (const auto& part : labels)
    all.push_back(part.why);
  for (const auto& part : meshes)
    all.push_back(part.why);
  return all;
}

void LeftOut::takeOut(scene::Case& value) const
{
  if (!empty())
    value.derived.reset(); // its keys identify the stored objects
  for (const auto& part : labels)
    value.labels[part.index].labels = noLabels();
  for (const auto& part : meshes)
    value.meshes[part.index].mesh = noMesh();
}

void LeftOut::putBack(scene::Case& value) const
{
  for (const auto& part : labels)
    value.labels[part.index].labels = part.whole;
  for (const auto& part : meshes)
    value.meshes[part.index].mesh = part.whole;
}

LeftOut leaveOutDamaged(scene::Case& value, const core::Progress& progress)
{
  LeftOut found{unreadable(value.labels, &scene::LabelPart::labels, progress.part(0.0, 0.6)),
                unreadable(value.meshes, &scene::MeshPart::mesh, progress.part(0.6, 1.0))};
  found.takeOut(value);
  return found;
}

} // namespace petrous::presenters
