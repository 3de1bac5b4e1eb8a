// Compares cached data, and data computed region by region, with data computed completely anew.

#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "petrous/Scene/CaseField.h"
#include "petrous/Volume/NearestSurface.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

class Shelf : public core::DerivedStore
{
public:
  std::optional<Bytes> find(const std::string& key) noexcept override
  {
    const auto found = m_kept.find(key);
    found == m_kept.end() ? ++missed : ++hits;
    return found == m_kept.end() ? std::nullopt : std::optional<Bytes>(found->second);
  }
  void put(const std::string& key, const Bytes& bytes) noexcept override { m_kept[key] = bytes; }
  std::uintmax_t bytes() const noexcept override { return m_kept.size(); }
  void damage()
  {
    for (auto& entry : m_kept)
      entry.second.resize(entry.second.size() / 2);
  }

  int hits = 0;
  int missed = 0;

private:
  std::map<std::string, Bytes> m_kept;
};

// Noisy soft tissue and bone, a nerve through both, a sinus beside it, an air cell in the bone.
scene::Case ear(const std::shared_ptr<Shelf>& shelf)
{
  const core::GridGeometry grid({90, 60, 60}, Vector3d(0.4, 0.4, 0.5), Vector3d(10, -20, 3));
  std::mt19937 random(11);
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{0});
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 90; ++i)
      {
        ct->at(i, j, k) = static_cast<std::int16_t>((i < 45 ? 40 : 1200) + int(random() % 60));
        const double y = 30 + 8 * std::sin(0.08 * i);
        if (std::hypot(j - y, k - 30.0) < 2.6)
          labels->at(i, j, k) = 1;
        else if ((Vector3d(i, j, k) - Vector3d(25, 15, 40)).norm() < 9.0)
          labels->at(i, j, k) = 2;
        else if ((Vector3d(i, j, k) - Vector3d(70, 45, 15)).norm() < 5.0)
        {
          labels->at(i, j, k) = 3;
          ct->at(i, j, k) = -900;
        }
      }
  scene::Case value;
  value.name = "ear";
  value.derived = shelf;
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  scene::LabelPart part;
  part.object = "0123.seg.nrrd";
  part.labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(labels), {}));
  for (const char* name : {"nerve", "sinus", "cell"})
  {
    scene::StructurePart structure;
    structure.name = name;
    structure.index = static_cast<std::uint16_t>(part.structures.size() + 1);
    structure.look.solid = part.structures.size() < 2;
    part.structures.push_back(structure);
  }
  value.labels = {part};
  return value;
}

scene::MeshPart spike(const core::GridGeometry& grid)
{
  auto surface = std::make_shared<core::TriangleMesh>();
  for (const Vector3d& corner :
       {Vector3d(5, 5, 5), Vector3d(12, 5, 5), Vector3d(5, 12, 5), Vector3d(5, 5, 12)}) // voxels
    surface->vertices.push_back(grid.patientFromVoxel(corner).cast<float>());
  surface->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  scene::MeshPart part;
  part.name = "spike";
  part.object = "cdef.obj";
  part.triangles = 4;
  part.mesh = std::shared_ptr<const core::TriangleMesh>(std::move(surface));
  return part;
}

void expectEqual(const volume::Volume<float>& a, const volume::Volume<float>& b)
{
  ASSERT_TRUE(core::sameGrid(a.geometry(), b.geometry(), 0.0));
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.bytes()), 0);
}

} // namespace

TEST(DerivedData, GiveTheSameFieldAndStructuresAsTheFirstTime)
{
  const auto shelf = std::make_shared<Shelf>();
  const scene::Case value = ear(shelf);
  const auto shown = scene::labelSources(value, [](const auto&) { return true; });
  const auto first = scene::tissueField(value);
  const auto drawn = scene::labelField(value, shown);
  EXPECT_EQ(shelf->hits, 0);

  const scene::Case again = ear(shelf);
  const auto second = scene::tissueField(again);
  const auto shownAgain = scene::labelSources(again, [](const auto&) { return true; });
  const auto drawnAgain = scene::labelField(again, shownAgain);
  EXPECT_EQ(shelf->hits, 2);
  expectEqual(*first.solids().at(0), *second.solids().at(0));
  expectEqual(*drawn->occupancy, *drawnAgain->occupancy);
  EXPECT_EQ(std::memcmp(drawn->index->data(), drawnAgain->index->data(), drawn->index->bytes()), 0);

  shelf->damage();
  expectEqual(*scene::tissueField(again).solids().at(0), *first.solids().at(0));
}

TEST(DerivedData, AreOthersForOtherStructuresOrLabels)
{
  const auto shelf = std::make_shared<Shelf>();
  scene::Case value = ear(shelf);
  scene::tissueField(value);
  value.labels[0].structures[1].look.touchable = false;
  scene::tissueField(value);
  EXPECT_EQ(shelf->hits, 0);
  value.labels[0].structures[1].look.touchable = true;
  value.labels[0].object = "4567.seg.nrrd";
  scene::tissueField(value);
  EXPECT_EQ(shelf->hits, 0);
  const int missed = shelf->missed;
  value.labels[0].object.clear(); // not stored yet: content unknown
  scene::tissueField(value);
  EXPECT_EQ(shelf->hits, 0);
  EXPECT_EQ(shelf->missed, missed);
}

// The servo skips bricks that the cached data state to be empty.
TEST(DerivedData, TheRigidTissuesKeySaysAllThatItsBricksDependOn)
{
  const auto shelf = std::make_shared<Shelf>();
  const auto keyOf = [](const scene::Case& value)
  { return scene::touchTissue(value, scene::tissueField(value)).key; };
  const scene::Case same = ear(shelf);
  ASSERT_TRUE(keyOf(same));
  EXPECT_EQ(keyOf(ear(shelf)), keyOf(same));
  std::set<std::string> keys{*keyOf(same)};
  const auto isNew = [&](const scene::Case& value) { return keys.insert(*keyOf(value)).second; };

  scene::Case value = same;
  value.iso += 1.0;
  EXPECT_TRUE(isNew(value));
  value = same;
  value.labels[0].object = "4567.seg.nrrd";
  EXPECT_TRUE(isNew(value));
  value = same;
  value.labels[0].structures[0].look.touchable = false;
  EXPECT_TRUE(isNew(value));
  value = same;
  value.labels[0].structures[1].look.stiffness = 0.5; // soft, hence not rigid
  EXPECT_TRUE(isNew(value));
  value = same;
  value.meshes = {spike(value.ct.geometry)};
  EXPECT_TRUE(isNew(value));
  value.meshes[0].object = "89ab.obj";
  EXPECT_TRUE(isNew(value));
  value.meshes[0].object.clear();
  EXPECT_FALSE(keyOf(value)) << "nobody knows its content";

  // One voxel of the CT, then its type with identical bytes.
  const auto withCt = [&](auto voxels)
  {
    scene::Case other = same;
    other.ct.volume = std::make_shared<const volume::IntensityVolume>(voxels);
    return other;
  };
  const auto& ct =
      std::get<std::shared_ptr<const volume::Volume<std::int16_t>>>(same.ct.volume.get()->voxels());
  auto changed = std::make_shared<volume::Volume<std::int16_t>>(*ct);
  changed->at(40, 30, 30) += 1;
  EXPECT_TRUE(isNew(withCt(std::shared_ptr<const volume::Volume<std::int16_t>>(changed))));
  auto typed = std::make_shared<volume::Volume<std::uint16_t>>(ct->geometry());
  std::memcpy(typed->data(), ct->data(), ct->bytes());
  EXPECT_TRUE(isNew(withCt(std::shared_ptr<const volume::Volume<std::uint16_t>>(typed))));
}

TEST(RegionalField, KeepsTheWholeForTheNextCommand)
{
  const auto shelf = std::make_shared<Shelf>();
  const scene::Case value = ear(shelf);
  const auto field = scene::regionalTissueField(value);
  scene::regionalTissueField(value);
  EXPECT_EQ(shelf->hits, 0) << "nothing is prepared yet";
  field.prepare(value.ct.geometry.patientBounds());
  const auto kept = scene::tissueField(value);
  EXPECT_EQ(shelf->hits, 1);
  expectEqual(*kept.solids().at(0), *scene::tissueField(ear(nullptr)).solids().at(0));
}

TEST(RegionalField, HasTheNearestSurfacesOfTheWholeToTheBit)
{
  const scene::Case value = ear(nullptr);
  const auto whole = scene::tissueField(value);
  volume::NearestSurfaceSearch inWhole(whole, 20.0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-0.05, 1.05);
  for (int turn = 0; turn < 40; ++turn)
  {
    const auto field = scene::regionalTissueField(value); // without the points queried before
    volume::NearestSurfaceSearch search(field, 20.0);
    const Vector3d p = value.ct.geometry.patientFromVoxel(
        {89 * part(random), 59 * part(random), 59 * part(random)});
    field.prepare({p, p});
    EXPECT_EQ(field.value(p), whole.value(p));
    const auto near = search.find(p);
    const auto truth = inWhole.find(p);
    ASSERT_EQ(near.has_value(), truth.has_value()) << p.transpose();
    if (!near)
      continue;
    EXPECT_EQ(near->distance, truth->distance) << p.transpose();
    EXPECT_EQ(near->point, truth->point) << p.transpose();
    EXPECT_EQ(near->normal, truth->normal) << p.transpose();
  }
}

TEST(RegionalField, TakesTheWholeWhereItIsKept)
{
  const auto shelf = std::make_shared<Shelf>();
  const scene::Case value = ear(shelf);
  const auto whole = scene::tissueField(value);
  const auto regional = scene::regionalTissueField(value);
  EXPECT_EQ(shelf->hits, 1);
  expectEqual(*regional.solids().at(0), *whole.solids().at(0));
}
