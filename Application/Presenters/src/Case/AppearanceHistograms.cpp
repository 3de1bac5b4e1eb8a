#include "petrous/Presenters/AppearanceHistograms.h"

#include <algorithm>
#include <set>
#include <type_traits>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "petrous/Scene/Placement.h"
#include "petrous/Volume/Rounded.h"

namespace petrous::presenters
{

namespace
{

bool isIdentity(const core::RigidTransform& transform)
{
  return transform.matrix().isIdentity(1e-9);
}

bool isSame(const core::RigidTransform& a, const core::RigidTransform& b)
{
  return a.matrix() == b.matrix();
}

constexpr const char* kTask = "counting intensities";

// The image's values at the voxels of each label.
template <class T>
std::map<std::uint16_t, std::vector<T>>
valuesWithin(const volume::LabelMap& labels, const volume::IntensityVolume& image,
             const volume::Volume<T>& voxels, const core::RigidTransform& imageFromLabels,
             bool isSameGrid, const core::Progress& progress)
{
  using Values = std::map<std::uint16_t, std::vector<T>>;
  const core::IndexBox box = volume::extentOf(labels);
  if (box.empty())
    return {};
  const core::GridGeometry& from = labels.voxels->geometry();
  const core::GridGeometry& grid = image.geometry();
  tbb::enumerable_thread_specific<Values> parts;
  const auto readRow = [&](int j, int k, Values& values)
  {
    volume::forEachLabel(&labels.voxels->at(box.lower[0], j, k), box.size()[0],
                         [&](int n, std::uint16_t label)
                         {
                           const int i = box.lower[0] + n;
                           if (isSameGrid)
                             return values[label].push_back(voxels.at(i, j, k));
                           const Eigen::Vector3d at = grid.voxelFromPatient(
                               imageFromLabels * from.patientFromVoxel(Eigen::Vector3d(i, j, k)));
                           if (grid.hullContains(at))
                             values[label].push_back(volume::rounded<T>(image.sample(at)));
                         });
  };
  tbb::parallel_for(tbb::blocked_range<int>(box.lower[2], box.upper[2]),
                    [&](const tbb::blocked_range<int>& slab)
                    {
                      progress.check(kTask);
                      for (int k = slab.begin(); k < slab.end(); ++k)
                        for (int j = box.lower[1]; j < box.upper[1]; ++j)
                          readRow(j, k, parts.local());
                    });
  Values all;
  for (const Values& part : parts)
    for (const auto& [label, values] : part)
      all[label].insert(all[label].end(), values.begin(), values.end());
  return all;
}

// nullptr: there is none of this name.
const scene::ImagePart* imageOf(const scene::Case& value, const std::string& name)
{
  return name.empty() ? &value.ct : scene::findMr(value, name);
}

core::RigidTransform imageFromCt(const scene::Case& value, const std::string& name)
{
  const scene::ImagePart* mr = name.empty() ? nullptr : scene::findMr(value, name);
  return mr ? mr->mrFromCt : core::RigidTransform();
}

} // namespace

std::map<std::uint16_t, volume::IntensityHistogram>
histogramsWithin(const volume::LabelMap& labels, const volume::IntensityVolume& image,
                 const core::RigidTransform& imageFromLabels, const core::Progress& progress)
{
  const bool isSameGrid =
      isIdentity(imageFromLabels) && core::sameGrid(labels.voxels->geometry(), image.geometry());
  return image.visit(
      [&](const auto& voxels)
      {
        using T = typename std::decay_t<decltype(voxels)>::Value;
        std::map<std::uint16_t, volume::IntensityHistogram> result;
        for (const auto& [label, values] :
             valuesWithin<T>(labels, image, voxels, imageFromLabels, isSameGrid, progress))
        {
          progress.check(kTask);
          // An image of these values alone.
          auto line = std::make_shared<volume::Volume<T>>(
              core::GridGeometry({static_cast<int>(values.size()), 1, 1}, Eigen::Vector3d::Ones(),
                                 Eigen::Vector3d::Zero()));
          std::copy(values.begin(), values.end(), line->data());
          result.emplace(label,
                         volume::IntensityHistogram(volume::IntensityVolume(
                             std::shared_ptr<const volume::Volume<T>>(line), image.padding())));
        }
        return result;
      });
}

AppearanceHistograms::Histogram AppearanceHistograms::image(const std::string& name) const
{
  const auto found = m_images.find(name);
  return found == m_images.end() ? nullptr : found->second.histogram;
}

bool AppearanceHistograms::isOf(const Within& counted, const scene::Case& value,
                                const scene::LabelPart& part, const std::string& image) const
{
  return counted.image == image && isSame(counted.imageFromCt, imageFromCt(value, image)) &&
         counted.labels.lock() == part.labels.peek();
}

AppearanceHistograms::Histogram AppearanceHistograms::within(const scene::Case& value,
                                                             const std::string& structure) const
{
  const auto found = m_within.find(structure);
  if (found == m_within.end())
    return nullptr;
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& one : part.structures)
      if (one.name == structure)
        return isOf(found->second, value, part, one.look.sourceImage) ? found->second.histogram
                                                                      : nullptr;
  return nullptr;
}

std::function<AppearanceHistograms(const core::Progress&)>
AppearanceHistograms::counting(const scene::Case& value) const
{
  std::set<std::string> images{value.boneLook.sourceImage, value.softTissue.sourceImage,
                               std::string()};
  std::set<std::string> structures;
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& one : part.structures)
    {
      const std::string& image = one.look.sourceImage;
      const auto found = m_within.find(one.name);
      if (imageOf(value, image) &&
          (found == m_within.end() || !isOf(found->second, value, part, image)))
      {
        structures.insert(one.name);
        images.insert(image);
      }
    }
  const auto isKnown = [this, &value](const std::string& image)
  {
    const scene::ImagePart* part = imageOf(value, image);
    const auto found = m_images.find(image);
    return !part || (found != m_images.end() && found->second.volume.lock() == part->volume.peek());
  };
  bool isMissing = !structures.empty();
  for (const std::string& image : images)
    isMissing = isMissing || !isKnown(image);
  if (!isMissing)
    return {};
  return [value, images, structures, before = *this](const core::Progress& progress)
  {
    AppearanceHistograms added;
    const auto wholeOf = [&](const std::string& name) -> Histogram
    {
      if (const auto found = added.m_images.find(name); found != added.m_images.end())
        return found->second.histogram;
      Whole& whole = added.m_images[name];
      progress.check(kTask);
      try
      {
        const scene::ImagePart* part = imageOf(value, name);
        const auto volume = part ? part->volume.get() : nullptr;
        const auto known = before.m_images.find(name);
        if (known != before.m_images.end() && known->second.volume.lock() == volume)
          whole = known->second;
        else if (volume)
          whole = {volume, std::make_shared<const volume::IntensityHistogram>(*volume)};
      }
      catch (const core::CancelledError&)
      {
        throw;
      }
      catch (const core::Error&) // said where the case was opened
      {
      }
      return whole.histogram;
    };
    for (const std::string& name : images)
      wholeOf(name);
    for (const scene::LabelPart& part : value.labels)
    {
      std::map<std::string, std::vector<const scene::StructurePart*>> byImage;
      for (const scene::StructurePart& one : part.structures)
        if (structures.count(one.name) > 0)
          byImage[one.look.sourceImage].push_back(&one);
      for (const auto& [image, readers] : byImage)
      {
        std::map<std::uint16_t, volume::IntensityHistogram> within;
        const core::RigidTransform transform = imageFromCt(value, image);
        try
        {
          const Histogram whole = wholeOf(image);
          const bool isPlaced = image.empty() || imageOf(value, image)->registered;
          const auto labels = whole && isPlaced ? scene::labelsOnCt(value, part) : nullptr;
          if (labels)
            within = histogramsWithin(*labels, *imageOf(value, image)->volume.get(), transform,
                                      progress);
        }
        catch (const core::CancelledError&)
        {
          throw;
        }
        catch (const core::Error&)
        {
        }
        for (const scene::StructurePart* one : readers)
        {
          const auto found = within.find(one->index);
          added.m_within[one->name] = {
              part.labels.peek(), image, transform,
              found == within.end()
                  ? nullptr
                  : std::make_shared<const volume::IntensityHistogram>(found->second)};
        }
      }
    }
    return added;
  };
}

void AppearanceHistograms::take(AppearanceHistograms counted)
{
  for (auto& [name, whole] : counted.m_images)
    m_images[name] = std::move(whole);
  for (auto& [name, within] : counted.m_within)
    m_within[name] = std::move(within);
}

} // namespace petrous::presenters
