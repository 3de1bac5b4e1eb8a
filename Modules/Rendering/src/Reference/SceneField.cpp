#include "petrous/Rendering/SceneField.h"

#include <utility>
#include <vector>

namespace petrous::rendering
{

namespace
{

volume::TissueField fieldOf(const SceneContents& contents, bool bone, bool structures)
{
  constexpr double kScale = 1000.0; // HU; only the unit of f
  constexpr double kNoBone = 1e300; // HU; iso value above all bone
  std::vector<volume::TissueField::SolidUnion> solids;
  if (structures && contents.labels)
    solids.push_back(contents.labels->occupancy);
  return {contents.ct,
          std::move(solids),
          contents.mask,
          {bone && contents.boneShown ? contents.iso : kNoBone, kScale}};
}

} // namespace

volume::TissueField sceneField(const SceneContents& contents)
{
  return fieldOf(contents, true, true);
}

volume::TissueField boneField(const SceneContents& contents)
{
  return fieldOf(contents, true, false);
}

volume::TissueField structureField(const SceneContents& contents)
{
  return fieldOf(contents, false, true);
}

} // namespace petrous::rendering
