#include "petrous/Presenters/LeavingImages.h"

namespace petrous::presenters
{

std::vector<std::string> maskLeavingImages(const library::Library& library, scene::Case& value,
                                           const scene::ImageMask& mask,
                                           const core::Progress& progress)
{
  if (!mask.any())
    return {};
  value.ct.volume.get();
  for (const scene::ImagePart& mr : value.mr)
    mr.volume.get();
  library.checkVoxels(value, progress);
  return scene::maskImages(value, mask, progress).notes;
}

std::function<std::vector<std::string>(scene::Case&, const core::Progress&)>
maskForArchive(const library::Library& library, const scene::ImageMask& mask)
{
  if (!mask.any())
    return {};
  return [&library, mask](scene::Case& value, const core::Progress& progress)
  { return maskLeavingImages(library, value, mask, progress); };
}

} // namespace petrous::presenters
