#include "petrous/Presenters/LeavingImages.h"

#include "petrous/Core/Error.h"

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
maskForArchive(const library::Library& library, const scene::ImageMask& mask,
               const std::vector<std::string>& withoutMrs)
{
  if (!mask.any() && withoutMrs.empty())
    return {};
  return [&library, mask, withoutMrs](scene::Case& value, const core::Progress& progress)
  {
    leaveOutMrs(value, withoutMrs);
    auto notes = maskLeavingImages(library, value, mask, progress);
    for (const std::string& name : withoutMrs)
      notes.push_back("MR '" + name + "' is left out");
    return notes;
  };
}

void leaveOutMrs(scene::Case& value, const std::vector<std::string>& names)
{
  for (const std::string& name : names)
  {
    if (!scene::findMr(value, name))
      throw core::InvalidParameter("there is no MR '" + name + "' to leave out");
    scene::removePart(value, name);
  }
}

} // namespace petrous::presenters
