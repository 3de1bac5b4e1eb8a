#include "petrous/Scene/ImageMask.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "petrous/Core/NumberText.h"
#include "petrous/Scene/Placement.h"

namespace petrous::scene
{

namespace
{

using volume::CellSet;
using volume::FaceFinding;
using volume::IntensityVolume;

std::string nameOf(const Case& value, const ImagePart& image)
{
  if (&image != &value.ct)
    return "MR '" + image.name + "'";
  return value.ct.modality == Modality::Mr ? "the MR" : "the CT";
}

bool isMr(const Case& value, const ImagePart& image)
{
  return &image != &value.ct || image.modality == Modality::Mr;
}

/// What stays.
struct Kept
{
  CellSet all;
  /// Structures, meshes, "what was drilled", each with the number of its points in the region.
  std::map<std::string, std::size_t> inRegion;
  /// The same with the number of points of the face's skin that stay because of it.
  std::map<std::string, std::size_t> onSkin;
};

/// The points of one structure.
class Collector
{
public:
  using IsMasked = std::function<bool(const Eigen::Vector3d&)>;

  Collector(std::string name, const IsMasked& isMasked)
    : m_name(std::move(name))
    , m_isMasked(isMasked)
  {
  }

  void add(const Eigen::Vector3d& at, const CellSet& empty)
  {
    if (!m_cells)
      m_cells.emplace(empty);
    m_cells->add(at);
    m_count += m_isMasked(at) ? 1 : 0;
  }

  void finish(Kept& kept, const std::vector<Eigen::Vector3d>& skin)
  {
    if (!m_cells)
      return;
    m_cells->grow(kKeptAround + m_cells->edge()); // points may lie anywhere in their cells
    for (std::size_t n = 0; n < m_cells->cells().size(); ++n)
      kept.all.cells()[n] |= m_cells->cells()[n];
    if (m_count > 0)
      kept.inRegion[m_name] += m_count;
    const auto held =
        std::count_if(skin.begin(), skin.end(),
                      [this](const Eigen::Vector3d& at) { return m_cells->contains(at); });
    if (held > 0)
      kept.onSkin[m_name] += static_cast<std::size_t>(held);
  }

private:
  std::string m_name;
  const IsMasked& m_isMasked;
  std::optional<CellSet> m_cells;
  std::size_t m_count = 0;
};

void forEachPoint(const core::TriangleMesh& mesh, double step,
                  const std::function<void(const Eigen::Vector3d&)>& visit)
{
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3d a = mesh.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[triangle[1]].cast<double>() - a;
    const Eigen::Vector3d c = mesh.vertices[triangle[2]].cast<double>() - a;
    constexpr double kMaxSteps = 1000.0;
    const int n = 1 + static_cast<int>(std::min(std::max(b.norm(), c.norm()) / step, kMaxSteps));
    for (int u = 0; u <= n; ++u)
      for (int v = 0; u + v <= n; ++v)
        visit(a + b * (static_cast<double>(u) / n) + c * (static_cast<double>(v) / n));
  }
}

void collectDrilled(const Case& value, const std::function<void(const Eigen::Vector3d&)>& visit)
{
  using volume::CutMask;
  if (value.dissection.strokes().empty())
    return;
  const auto visitMask = [&](const CutMask& mask)
  {
    for (std::size_t n = 0; n < mask.brickCount(); ++n)
    {
      if (!mask.brick(n))
        continue;
      const core::IndexBox box = mask.brickBox(n);
      for (int k = box.lower[2]; k < box.upper[2]; ++k)
        for (int j = box.lower[1]; j < box.upper[1]; ++j)
          for (int i = box.lower[0]; i < box.upper[0]; ++i)
            if (mask.at(i, j, k) != CutMask::kUntouched)
              visit(mask.geometry().patientFromVoxel(Eigen::Vector3d(i, j, k)));
    }
  };
  // Of every approach, what was undone included: it can be redone where the case arrives.
  for (const auto& branch : value.dissection.history().branches())
  {
    dissection::Dissection drilled = value.dissection;
    drilled.load(value.ct.geometry);
    dissection::History to = drilled.history();
    to.goTo(branch.name);
    while (to.redo())
      continue;
    drilled.follow(to);
    visitMask(drilled.mask());
  }
}

/// Everything that is kept, in the patient space of the image.
Kept keptOf(const Case& value, const ImagePart& image, const Collector::IsMasked& isMasked,
            const std::vector<Eigen::Vector3d>& skin)
{
  const core::PatientBox bounds = image.geometry.patientBounds();
  constexpr double kEdge = 2.0, kMaxCells = 8e6;
  const Eigen::Vector3d half = image.geometry.spacing();
  const core::PatientBox box(bounds.min() - half, bounds.max() + half);
  const CellSet empty(box, std::max(kEdge, std::cbrt(box.volume() / kMaxCells)));
  Kept kept{empty, {}, {}};
  const bool isCt = &image == &value.ct;
  // Points of CT space lie in the image's.
  const bool hasCtSpace = isCt || image.registered;
  const core::RigidTransform fromCt = isCt ? core::RigidTransform() : image.mrFromCt;
  const Eigen::Matrix3d rotation = fromCt.rotation().toRotationMatrix();
  const auto place = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d
  { return rotation * at + fromCt.translation(); };

  for (const LabelPart& part : value.labels)
  {
    auto map = labelsOnCt(value, part);
    const bool onCt = map != nullptr;
    if (!onCt && (isCt || placementOf(value, part).drawnOn != image.name))
      continue;
    if (onCt && !hasCtSpace)
      continue;
    if (!onCt)
      map = part.labels.get();
    std::map<std::uint16_t, Collector> collectors;
    for (const StructurePart& structure : part.structures)
      collectors.emplace(structure.index,
                         Collector("structure '" + structure.name + "'", isMasked));
    const core::GridGeometry& grid = map->voxels->geometry();
    const core::IndexBox extent = volume::extentOf(*map);
    for (int k = extent.lower[2]; k < extent.upper[2]; ++k)
      for (int j = extent.lower[1]; j < extent.upper[1]; ++j)
        volume::forEachLabel(&map->voxels->at(0, j, k), grid.dims()[0],
                             [&](int i, std::uint16_t label)
                             {
                               const auto collector = collectors.find(label);
                               if (collector == collectors.end())
                                 return;
                               const Eigen::Vector3d at =
                                   grid.patientFromVoxel(Eigen::Vector3d(i, j, k));
                               collector->second.add(onCt ? place(at) : at, empty);
                             });
    for (auto& [label, collector] : collectors)
      collector.finish(kept, skin);
  }
  for (const MeshPart& part : value.meshes)
  {
    auto mesh = meshOnCt(value, part);
    const bool onCt = mesh != nullptr;
    if ((!onCt && (isCt || part.drawnOn != image.name)) || (onCt && !hasCtSpace))
      continue;
    if (!onCt)
      mesh = part.mesh.get();
    Collector collector("mesh '" + part.name + "'", isMasked);
    forEachPoint(*mesh, kEdge,
                 [&](const Eigen::Vector3d& at) { collector.add(onCt ? place(at) : at, empty); });
    collector.finish(kept, skin);
  }
  if (hasCtSpace)
  {
    Collector collector("what was drilled", isMasked);
    collectDrilled(value, [&](const Eigen::Vector3d& at) { collector.add(place(at), empty); });
    collector.finish(kept, skin);
  }
  return kept;
}

std::string listedParts(const std::map<std::string, std::size_t>& parts)
{
  std::string text;
  for (const auto& [name, count] : parts)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Structures must not hold the likeness that the mask takes out.
void refuseKeptSkin(const std::string& image, const Kept& kept, const FaceFinding& finding)
{
  constexpr double kMost = 0.02; // of the skin
  std::size_t held = 0;
  for (const Eigen::Vector3d& at : finding.skin)
    held += kept.all.contains(at) ? 1 : 0;
  const double share = static_cast<double>(held) / static_cast<double>(finding.skin.size());
  if (share <= kMost)
    return;
  throw core::Error(core::Fault::Refused,
                    image + ": " + core::fixedText(100.0 * share, 0) +
                        " % of the face's skin would stay, as " + listedParts(kept.onSkin) +
                        " lies there and is kept with " + core::fixedText(kKeptAround, 0) +
                        " mm around it; remove it from a copy of the case first");
}

std::string percent(std::size_t part, std::size_t whole)
{
  return core::fixedText(100.0 * static_cast<double>(part) / static_cast<double>(whole), 1) + " %";
}

struct Result
{
  std::shared_ptr<const IntensityVolume> image;
  MaskedImagePart part;
  std::vector<std::string> notes; ///< for the user
  std::string kept;               ///< note of the image itself
  volume::ImageProvenance provenance;
};

// A head whose face cannot be told.
[[noreturn]] void refuseDoubtful(const std::string& image, const FaceFinding& finding)
{
  throw core::Error(core::Fault::Refused,
                    image + ": " + finding.text +
                        "; it cannot be masked. Leave the image out, or hand on the region of "
                        "the ear alone (--roi)");
}

Kept keptOfFace(const Case& value, const ImagePart& image, const FaceFinding& finding)
{
  return keptOf(
      value, image, [&finding](const Eigen::Vector3d& at) { return finding.region.covers(at); },
      finding.skin);
}

Result masked(const Case& value, const ImagePart& image, const ImageMask& mask,
              const core::Progress& progress)
{
  const std::string name = nameOf(value, image);
  Result result;
  result.provenance = image.provenance;
  result.image = image.volume.get();
  result.part.name = &image == &value.ct ? std::string() : image.name;
  result.part.voxels = image.geometry.voxelCount();
  const auto take = [&](const volume::MaskedImage& done, const Kept& kept)
  {
    result.image = done.image;
    result.part.changed += done.changed;
    result.part.kept += done.kept;
    if (done.kept > 0)
      result.notes.push_back(
          name + ": " + listedParts(kept.inRegion) + " with " + core::fixedText(kKeptAround, 0) +
          " mm around lies in the masked part and stays, " + std::to_string(done.kept) + " voxels");
  };
  const volume::SkinScale scale = volume::skinScale(*result.image, isMr(value, image));
  if (mask.face)
  {
    const FaceFinding finding =
        volume::findFace(*result.image, scale, mask.ears, progress.part(0.0, 0.4));
    result.part.face = finding.kind;
    if (finding.kind == FaceFinding::Kind::Doubtful)
      refuseDoubtful(name, finding);
    // What is said of them is never enough to let an image pass.
    if (finding.kind == FaceFinding::Kind::Masked && mask.ears && !image.provenance.areEarsMasked)
      throw core::Error(core::Fault::Refused,
                        name + ": the face is masked already, but not the auricles, which are "
                               "found by it; mask both in the image as it was");
    if (finding.canBeMasked())
    {
      const Kept kept = keptOfFace(value, image, finding);
      refuseKeptSkin(name, kept, finding);
      const auto done =
          volume::maskFace(*result.image, finding.region, &kept.all, progress.part(0.4, 0.7));
      take(done, kept);
      result.provenance.isFaceMasked = true;
      result.provenance.areEarsMasked = image.provenance.areEarsMasked || mask.ears;
      result.kept = "the face is masked to a plane " + core::fixedText(finding.region.reach, 0) +
                    " mm behind the tip of the nose, " + core::fixedText(volume::kFaceDepth, 0) +
                    " mm or more below its skin (median " +
                    core::fixedText(finding.region.depth, 0) + " mm)" +
                    (mask.ears ? ", with the auricles" : "");
      if (!finding.text.empty())
        result.notes.push_back(name + ": " + finding.text);
      result.notes.push_back(name + ": " + result.kept + "; " +
                             percent(done.changed, result.part.voxels) + " of its voxels changed");
    }
    else
      result.notes.push_back(name + ": " + finding.text + "; it stays as it is");
  }
  if (mask.region)
  {
    const core::RigidTransform toCt =
        &image == &value.ct ? core::RigidTransform() : image.mrFromCt.inverse();
    const Kept kept =
        keptOf(value, image,
               [&](const Eigen::Vector3d& at) { return !mask.region->contains(toCt * at); }, {});
    const double air = scale.isAirKnown ? scale.air : image.range.min;
    const auto done = volume::maskOutside(*result.image, *mask.region, toCt, air, &kept.all,
                                          progress.part(0.7, 1.0));
    take(done, kept);
    result.notes.push_back(name + ": all outside of the region is air; " +
                           percent(done.changed, result.part.voxels) + " of its voxels changed");
    result.provenance.isCropped = true;
    result.kept += std::string(result.kept.empty() ? "" : "; ") + "cropped to a region";
  }
  return result;
}

} // namespace

ImageMaskReport maskImages(Case& value, const ImageMask& mask, const core::Progress& progress)
{
  ImageMaskReport report;
  if (!mask.any())
    return report;
  if (mask.region)
  {
    if (value.ct.geometry.boxCovering(mask.region->min(), mask.region->max()).empty())
      throw core::InvalidParameter("the region has no voxel of the image; it is stated in patient "
                                   "LPS mm, as 'petrous info' states the image's origin");
    for (const ImagePart& mr : value.mr)
      if (!mr.registered)
        throw core::InvalidParameter("MR '" + mr.name +
                                     "' is not registered, and the region is one of the CT's "
                                     "space; register or remove it first");
  }
  std::vector<ImagePart*> images{&value.ct};
  for (ImagePart& mr : value.mr)
    images.push_back(&mr);
  std::vector<Result> results;
  for (std::size_t n = 0; n < images.size(); ++n)
  {
    const auto count = static_cast<double>(images.size());
    results.push_back(
        masked(value, *images[n], mask,
               progress.part(static_cast<double>(n) / count, static_cast<double>(n + 1) / count)));
  }
  for (std::size_t n = 0; n < images.size(); ++n)
  {
    Result& result = results[n];
    if (result.part.changed > 0)
    {
      images[n]->volume = core::Lazy<IntensityVolume>(result.image);
      images[n]->range = result.image->range();
      images[n]->object.clear();
    }
    if (!result.kept.empty())
      images[n]->notes.push_back(result.kept);
    images[n]->provenance = std::move(result.provenance);
    report.notes.insert(report.notes.end(), result.notes.begin(), result.notes.end());
    report.images.push_back(std::move(result.part));
  }
  return report;
}

std::vector<ImageWithFace> imagesWithFace(const Case& value, const core::Progress& progress)
{
  std::vector<ImageWithFace> found;
  const auto count = static_cast<double>(1 + value.mr.size());
  double done = 0.0;
  const auto look = [&](const ImagePart& image)
  {
    const core::Progress part = progress.part(done / count, (done + 1.0) / count);
    done += 1.0;
    const auto voxels = image.volume.get();
    if (!voxels)
      return;
    const FaceFinding finding =
        volume::findFace(*voxels, volume::skinScale(*voxels, isMr(value, image)), {}, part);
    if (!finding.canBeMasked() && finding.kind != FaceFinding::Kind::Doubtful)
      return;
    const std::string name = nameOf(value, image);
    ImageWithFace one{name, &image == &value.ct ? std::string() : image.name, {}};
    try
    {
      if (!finding.canBeMasked())
        refuseDoubtful(name, finding);
      refuseKeptSkin(name, keptOfFace(value, image, finding), finding);
    }
    catch (const core::Error& error)
    {
      if (error.fault() != core::Fault::Refused)
        throw;
      one.fault = error.what();
    }
    found.push_back(std::move(one));
  };
  look(value.ct);
  for (const ImagePart& mr : value.mr)
    look(mr);
  return found;
}

} // namespace petrous::scene
