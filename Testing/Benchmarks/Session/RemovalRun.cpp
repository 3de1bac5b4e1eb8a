#include "RemovalRun.h"

#include <algorithm>
#include <cmath>

namespace petrous::session
{

namespace
{

using testing::LawScene;
using volume::CutMask;

double forceOn(const TickRecord& record)
{
  return Eigen::Vector3d(record.burrForce[0], record.burrForce[1], record.burrForce[2]).norm();
}

double resistanceOf(const LawScene::Setting& setting)
{
  return testing::resistance(setting.burr, "cortical-bone"); // N/mm^2
}

// Volume of {f > 0} removed by the mask, mm^3, from 512 points per cell that are not aligned with
// the grid (additive recurrence by powers of the root of x^4 = x + 1): with points in rows, a flat
// surface would be off by a twelfth of a voxel.
double volumeGone(const LawScene& scene)
{
  constexpr int points = 512;
  const CutMask& mask = scene.work.mask();
  const core::GridGeometry& grid = mask.geometry();
  const core::Index3& dims = grid.dims();
  std::size_t gone = 0;
  const auto cell = [&](int i, int j, int k)
  {
    std::uint16_t least = CutMask::kUntouched;
    for (int c = 0; c < 8; ++c)
      least = std::min(least, mask.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)));
    if (least > CutMask::kUntouched / 2)
      return; // nothing removed from it
    for (int n = 0; n < points; ++n)
    {
      const auto part = [n](double step) { return std::fmod(0.5 + step * (n + 1), 1.0); };
      const Eigen::Vector3d v(i + part(0.8191725133961645), j + part(0.6710436067037893),
                              k + part(0.5497004779019703));
      if (mask.sample(v) <= 0.5 && scene.tissue.uncut(grid.patientFromVoxel(v)) > 0.0)
        ++gone;
    }
  };
  // The bone's surface is at z = 0.
  for (int k = 0; k + 1 < dims[2] && grid.patientFromVoxel({0.0, 0.0, 1.0 * k}).z() <= 0.0; ++k)
    for (int j = 0; j + 1 < dims[1]; ++j)
      for (int i = 0; i + 1 < dims[0]; ++i)
        cell(i, j, k);
  return static_cast<double>(gone) * grid.voxelVolume() / points;
}

// Binary voxels in the mask that the tool touches.
class VoxelDeletion
{
public:
  VoxelDeletion(LawScene& scene, double diameter)
    : m_scene(scene)
    , m_radius(0.5 * diameter)
    , m_most(static_cast<std::size_t>(deletedPerTick(diameter)))
  {
    takeAir();
  }

  /// Returns the number of deleted voxels.
  std::size_t step(const TickRecord& record)
  {
    if (!record.drill || !(record.thrust > 0.0))
      return 0;
    gather(record.proxy.pose().position);
    const std::size_t count = std::min(m_most, m_near.size());
    std::partial_sort(m_near.begin(), m_near.begin() + static_cast<std::ptrdiff_t>(count),
                      m_near.end());
    for (std::size_t n = 0; n < count; ++n)
      remove(m_near[n].second);
    if (count > 0)
    {
      CutMask& mask = m_scene.work.mask();
      m_scene.mask->publish(mask, mask.takeDirty(), false);
    }
    return count;
  }

private:
  // Removes everything but bone first, so that only binary voxels are touched.
  void takeAir()
  {
    CutMask& mask = m_scene.work.mask();
    const core::GridGeometry& grid = mask.geometry();
    for (std::size_t index = 0; index < mask.brickCount(); ++index)
    {
      auto brick = std::make_shared<CutMask::Brick>();
      brick->fill(CutMask::kUntouched);
      const core::IndexBox box = mask.brickBox(index);
      for (int k = box.lower[2]; k < box.upper[2]; ++k)
        for (int j = box.lower[1]; j < box.upper[1]; ++j)
          for (int i = box.lower[0]; i < box.upper[0]; ++i)
            if (!(m_scene.tissue.uncut(grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k})) > 0.0))
              (*brick)[placeOf({i, j, k})] = 0;
      mask.setBrick(index, std::move(brick));
    }
    m_scene.mask->publish(mask, mask.takeDirty(), false);
  }

  static std::size_t placeOf(const core::Index3& voxel) // within its brick
  {
    constexpr int edge = CutMask::kBrickEdge;
    return static_cast<std::size_t>(voxel[0] % edge +
                                    edge * (voxel[1] % edge + edge * (voxel[2] % edge)));
  }

  void gather(const Eigen::Vector3d& center)
  {
    const CutMask& mask = m_scene.work.mask();
    const core::GridGeometry& grid = mask.geometry();
    const double h = grid.minSpacing();
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(m_radius + h);
    const core::IndexBox box = grid.boxCovering(center - reach, center + reach);
    m_near.clear();
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
        {
          const Eigen::Vector3d p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
          const Eigen::Vector3d away =
              ((p - center).cwiseAbs() - Eigen::Vector3d::Constant(0.5 * h)).cwiseMax(0.0);
          if (away.norm() < m_radius + 0.5 * h && mask.at(i, j, k) > 0)
            m_near.push_back({(p - center).norm(), {i, j, k}});
        }
  }

  void remove(const core::Index3& voxel)
  {
    constexpr int edge = CutMask::kBrickEdge;
    CutMask& mask = m_scene.work.mask();
    const std::size_t index = mask.brickIndex({voxel[0] / edge, voxel[1] / edge, voxel[2] / edge});
    auto brick = std::make_shared<CutMask::Brick>(*mask.brick(index));
    (*brick)[placeOf(voxel)] = 0;
    mask.setBrick(index, std::move(brick));
  }

  LawScene& m_scene;
  double m_radius;
  std::size_t m_most;
  std::vector<std::pair<double, core::Index3>> m_near;
};

} // namespace

int deletedPerTick(double diameter)
{
  return diameter < 2.0 ? 1 : diameter < 4.0 ? 3 : diameter < 6.0 ? 6 : 10;
}

double lawRate(const LawScene::Setting& setting)
{
  const double arm = BurrRemovalModel::armOf(0.5 * setting.burr.diameter, setting.elevation, 0.0);
  return setting.thrust * arm * testing::speedOf(setting.burr) / resistanceOf(setting);
}

RemovalRun runByLaw(const LawScene::Setting& setting, double seconds)
{
  LawScene scene(setting);
  RemovalRun run;
  const double pace = testing::speedOf(setting.burr) / resistanceOf(setting);
  scene.follow = [&](const TickRecord& record)
  {
    core::TickTimes time;
    if (time.take([&] { return scene.loop.step(record); }))
      run.times.add(time);
  };
  scene.drill(seconds,
              [&](const TickRecord& record)
              {
                run.predicted += forceOn(record) * scene.removalModel.arm() * pace * setting.tick;
                run.contact += setting.tick;
              });
  const RemovalBalance balance = scene.removalModel.balance();
  run.told = balance.removed;
  run.owed = balance.owed;
  run.forfeited = balance.forfeited;
  run.measured = volumeGone(scene);
  return run;
}

RemovalRun runByDeletion(const LawScene::Setting& setting, double seconds, double most)
{
  LawScene scene(setting);
  RemovalRun run;
  const double pace = testing::speedOf(setting.burr) / resistanceOf(setting);
  const double radius = 0.5 * setting.burr.diameter;
  VoxelDeletion deletion(scene, setting.burr.diameter);
  std::size_t gone = 0;
  scene.follow = [&](const TickRecord& record)
  {
    core::TickTimes time;
    const std::size_t count = time.take([&] { return deletion.step(record); });
    gone += count;
    if (count > 0)
      run.times.add(time);
  };
  while (run.contact < seconds && run.measured < most)
  {
    const double before = run.contact;
    scene.drill(setting.tick,
                [&](const TickRecord& record)
                {
                  const double arm = BurrRemovalModel::armOf(radius, record.elevation, 0.0);
                  run.predicted += forceOn(record) * arm * pace * setting.tick;
                  run.contact += setting.tick;
                });
    run.measured = static_cast<double>(gone) * scene.work.mask().geometry().voxelVolume();
    if (run.contact == before)
      break; // no more contact
  }
  return run;
}

} // namespace petrous::session
