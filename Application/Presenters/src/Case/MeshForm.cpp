#include "MeshForm.h"

#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Volume/MeshMeasure.h"

namespace petrous::presenters
{

std::string objectsNote(const imaging::LoadedMesh& loaded)
{
  constexpr std::size_t kMostQuoted = 8;
  const std::size_t count = loaded.objects.size();
  if (count < 2)
    return {};
  std::vector<std::string> known;
  for (const std::string& object : loaded.objects)
    if (const FileName name = fileName(object);
        name.isWhole && !name.name.empty() && known.size() < kMostQuoted)
      known.push_back(name.name);
  return "holds " + std::to_string(count) + " objects" +
         (known.empty()           ? std::string()
          : known.size() == count ? ": " + scene::listed(known)
                                  : ", among them " + scene::listed(known)) +
         ", taken as one structure; --mesh-parts gives one of each";
}

std::vector<std::string> formNotes(const core::TriangleMesh& mesh)
{
  std::vector<std::string> notes;
  const volume::MeshMeasure form = volume::measure(mesh);
  if (form.reversedParts > 0)
    notes.push_back("has " + std::to_string(form.parts) + " parts, of which " +
                    std::to_string(form.reversedParts) +
                    (form.reversedParts == 1
                         ? " is wound the other way; it counts as solid all the same"
                         : " are wound the other way; they count as solid all the same"));
  if (form.cavities > 0)
    notes.push_back("has " + std::to_string(form.cavities) +
                    (form.cavities == 1
                         ? " part in another that faces the other way; it counts as a cavity"
                         : " parts in another that face the other way; they count as cavities"));
  if (form.innerParts > 0)
    notes.push_back("has " + std::to_string(form.innerParts) +
                    (form.innerParts == 1
                         ? " part in another that faces the same way; it bounds nothing"
                         : " parts in another that face the same way; they bound nothing"));
  if (form.doubled > 0)
    notes.push_back(2 * form.doubled == mesh.triangles.size()
                        ? std::string("has each triangle twice; it counts once")
                        : "has " + std::to_string(form.doubled) +
                              " triangles that are there already; they count once");
  if (form.isOverlapHollow)
    notes.emplace_back("has parts that overlap and are wound opposite ways: where they do counts "
                       "as outside; make one surface of them where it comes from");
  else if (form.isOverlapping)
    notes.emplace_back("has parts that overlap: the volume is that of their union");
  return notes;
}

} // namespace petrous::presenters
