#include <algorithm>

#include "petrous/Core/Fingerprint.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::session
{

namespace
{

void add(core::Fingerprint& print, const core::GridGeometry& grid)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    print.add(grid.dims()[axis]);
    print.add(grid.spacing()[axis]);
    print.add(grid.origin()[axis]);
    for (int row = 0; row < 3; ++row)
      print.add(grid.direction()(row, axis));
  }
}

template <typename Voxel>
void add(core::Fingerprint& print, const volume::Volume<Voxel>& volume)
{
  add(print, volume.geometry());
  print.add(sizeof(Voxel));
  print.add(volume.data(), volume.size() * sizeof(Voxel));
}

} // namespace

std::uint64_t fingerprintOf(const volume::CutMask& mask)
{
  core::Fingerprint print;
  add(print, mask.geometry());
  for (std::size_t n = 0; n < mask.brickCount(); ++n)
  {
    const volume::CutMask::BrickVersion& brick = mask.brick(n);
    const auto isCut = [](std::uint16_t left) { return left != volume::CutMask::kUntouched; };
    // A brick that was cut and restored may or may not be allocated.
    if (!brick || std::none_of(brick->begin(), brick->end(), isCut))
      continue;
    print.add(n);
    print.add(brick->data(), sizeof *brick);
  }
  return print.value();
}

RecordedScene TouchScene::fingerprint() const
{
  const volume::TissueField& field = m_drill.field();
  RecordedScene result;
  core::Fingerprint ct;
  field.ct()->visit([&ct](const auto& volume) { add(ct, volume); });
  result.ct = ct.value();
  result.iso = field.parameters().iso;

  // All of it counts, drilled or not.
  const Eigen::Vector3d everywhere = Eigen::Vector3d::Constant(1e9);
  m_drill.protectedTissue().prepare({-everywhere, everywhere});
  core::Fingerprint tissue;
  tissue.add(field.parameters().scale);
  for (const auto* structures : {&field.solids(), &m_drill.protectedTissue().occupancies()})
  {
    tissue.add(structures->size());
    for (const auto& structure : *structures)
      add(tissue, *structure);
  }
  result.tissue = tissue.value();

  result.mask = fingerprintOf(m_case.dissection.mask());
  result.applied = m_case.applied();
  result.firstState = m_mask->number();
  return result;
}

} // namespace petrous::session
