#include "petrous/Presenters/LeavingImages.h"

#include <set>

#include "petrous/Core/Error.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/RemoveMr.h"

namespace petrous::presenters
{

std::vector<std::string> maskLeavingImages(const library::Library& library, scene::Case& value,
                                           const scene::ImageMask& mask,
                                           const core::Progress& progress)
{
  if (!mask.any())
    return {};
  if (mask.takes({}))
    value.ct.volume.get();
  for (const scene::ImagePart& mr : value.mr)
    if (mask.takes(mr.name))
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
  std::vector<std::string> there;
  for (const scene::ImagePart& mr : value.mr)
    there.push_back(mr.name);
  for (const std::string& name : std::set<std::string>(names.begin(), names.end()))
  {
    if (!scene::findMr(value, name))
      throw core::InvalidParameter("there is no MR '" + name + "' to leave out; the case has " +
                                   (there.empty() ? "none" : scene::listed(there)));
    scene::removeMr(value, name);
  }
}

} // namespace petrous::presenters
