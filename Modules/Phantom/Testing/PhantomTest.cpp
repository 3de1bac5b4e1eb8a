#include "petrous/Phantom/Phantom.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "PhantomAnatomy.h"
#include "PhantomShapes.h"
#include "petrous/Core/Error.h"

namespace petrous::phantom
{
namespace
{

using Eigen::Vector3d;
using namespace shapes;

constexpr double kPi = 3.14159265358979323846;

const Phantom& phantom()
{
  static const Phantom one;
  return one;
}

core::PatientBox earBox()
{
  return {Phantom::center() - 0.5 * Phantom::extent(), Phantom::center() + 0.5 * Phantom::extent()};
}

core::GridGeometry gridRound(const Vector3d& center, int n, double spacing)
{
  return {
      {n, n, n}, Vector3d::Constant(spacing), center - Vector3d::Constant(0.5 * spacing * (n - 1))};
}

Vector3d middle(const std::string& name)
{
  const PhantomStructure& s = phantom().structures()[phantom().indexOf(name)];
  return 0.5 * (s.lower + s.upper);
}

Vector3d centroid(const std::string& name, double coarseness = 0.3)
{
  const core::TriangleMesh mesh = phantom().surface(phantom().indexOf(name), earBox(), coarseness);
  Vector3d sum = Vector3d::Zero();
  for (const auto& v : mesh.vertices)
    sum += v.cast<double>();
  return sum / static_cast<double>(mesh.vertices.size());
}

std::vector<std::int16_t> scan(const Phantom& patient, std::uint64_t noiseSeed)
{
  ScanSettings settings;
  settings.seed = noiseSeed;
  const auto ct = samplePhantom(patient, gridRound({-47.0, 4.0, 3.0}, 40, 0.6), settings);
  return {ct.data(), ct.data() + ct.size()};
}

} // namespace

TEST(PhantomShapes, SphereAndTorusAreTrueDistances)
{
  const Shape ball = sphere({1, 2, 3}, 2.0);
  EXPECT_NEAR(ball({1, 2, 6}), 1.0, 1e-12);
  EXPECT_NEAR(ball({1, 2, 3}), -2.0, 1e-12);
  const Shape ring = torus({0, 0, 0}, Vector3d::UnitZ(), 3.0, 0.5);
  for (int i = 0; i < 36; ++i)
  {
    const double a = i * kPi / 18.0;
    const Vector3d out(std::cos(a), std::sin(a), 0.0);
    EXPECT_NEAR(ring(3.0 * out), -0.5, 1e-12);
    EXPECT_NEAR(ring(4.5 * out + Vector3d(0, 0, 2.0)), 2.0, 1e-12); // 3-4-5: 1.5, 2 -> 2.5
  }
}

TEST(PhantomShapes, EllipsoidIsZeroOnItsSurfaceWithUnitSlope)
{
  const Vector3d radii(1.0, 2.0, 1.5);
  const Shape egg = ellipsoid({0, 0, 0}, radii);
  for (int i = 0; i < 200; ++i)
  {
    const double z = 2.0 * uniform(7, static_cast<std::uint64_t>(2 * i)) - 1.0;
    const double a = 2.0 * kPi * uniform(7, static_cast<std::uint64_t>(2 * i + 1));
    const double r = std::sqrt(1.0 - z * z);
    const Vector3d unit(r * std::cos(a), r * std::sin(a), z);
    const Vector3d p = unit.cwiseProduct(radii);
    const Vector3d normal = unit.cwiseQuotient(radii).normalized();
    EXPECT_NEAR(egg(p), 0.0, 1e-12);
    EXPECT_NEAR(egg(p + 0.01 * normal), 0.01, 5e-4);
  }
}

TEST(PhantomShapes, TubeIsTheDistanceToItsNearestPiece)
{
  std::vector<Knot> knots;
  for (int i = 0; i <= 60; ++i)
    knots.push_back({Vector3d(std::cos(0.2 * i), std::sin(0.2 * i), 0.1 * i) * 3.0, 0.3});
  const Shape coil = tube(knots);
  for (std::uint64_t i = 0; i < 300; ++i)
  {
    const Vector3d p(12.0 * uniform(3, 3 * i) - 6.0, 12.0 * uniform(3, 3 * i + 1) - 6.0,
                     20.0 * uniform(3, 3 * i + 2) - 1.0);
    double best = 1e9;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k)
      best = std::min(best, capsule(knots[k], knots[k + 1])(p));
    EXPECT_NEAR(coil(p), best, 1e-12);
  }
}

TEST(Phantom, ScansAreTheSameForASeedWhateverTheThreads)
{
  const auto first = scan(Phantom(PhantomRecipe{5, true}), 5);
  std::vector<std::int16_t> single;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    single = scan(Phantom(PhantomRecipe{5, true}), 5);
  }
  EXPECT_EQ(first, single);
  EXPECT_NE(first, scan(Phantom(PhantomRecipe{6, true}), 5)) << "another patient";
  EXPECT_NE(first, scan(Phantom(PhantomRecipe{5, true}), 6)) << "another noise";
}

TEST(Phantom, NoiseHasTheDeviationAskedFor)
{
  ScanSettings settings;
  settings.noise = 30.0;
  const auto ct = samplePhantom(phantom(), gridRound({-12.0, 20.0, 20.0}, 30, 0.3), settings);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < ct.size(); ++i)
  {
    sum += ct.data()[i];
    squares += static_cast<double>(ct.data()[i]) * ct.data()[i];
  }
  const double n = static_cast<double>(ct.size());
  EXPECT_NEAR(sum / n, 35.0, 1.0); // brain
  EXPECT_NEAR(std::sqrt(squares / n - sum * sum / (n * n)), 30.0, 0.6);
}

TEST(Phantom, BlocksLeftOutChangeNothing)
{
  ScanSettings settings;
  settings.noise = 0.0;
  settings.pointSpread = 0.0;
  const core::GridGeometry grid = gridRound({-43.5, 1.0, 2.5}, 48, 0.25);
  const volume::LabelMap labels = labelPhantom(phantom(), grid);
  const auto ct = samplePhantom(phantom(), grid, settings);
  for (int k = 0; k < 48; k += 3)
    for (int j = 0; j < 48; j += 3)
      for (int i = 0; i < 48; i += 3)
      {
        const Vector3d p = grid.patientFromVoxel(Vector3d(i, j, k));
        const int index = labels.voxels->at(i, j, k);
        for (std::size_t s = 0; s < phantom().structures().size(); ++s)
        {
          const double d = phantom().signedDistance(s, p);
          if (std::abs(d) < 1e-9)
            continue;
          ASSERT_EQ(d < 0.0, index == static_cast<int>(s) + 1)
              << phantom().structures()[s].name << " at " << p.transpose();
          if (d < -0.3)
          {
            ASSERT_NEAR(ct.at(i, j, k), phantom().structures()[s].hounsfield, 1.0);
          }
        }
      }
}

TEST(Phantom, TissuesHaveTheirHounsfieldUnits)
{
  EXPECT_DOUBLE_EQ(phantom().hounsfield({-200.0, 0.0, 0.0}), -1000.0);
  EXPECT_DOUBLE_EQ(phantom().hounsfield({-10.0, 25.0, 20.0}), 35.0);
  EXPECT_DOUBLE_EQ(phantom().hounsfield(middle("malleus") + Vector3d(0.9, -0.7, 2.3)), 1500.0);
  EXPECT_DOUBLE_EQ(phantom().hounsfield({-60.0, -1.0, 1.2}), -1000.0); // ear canal
  EXPECT_GT(phantom().mrIntensity({-38.4, 1.0, 1.4}), 900.0);          // vestibule: fluid
  EXPECT_LT(phantom().mrIntensity({-60.0, -1.0, 1.2}), 20.0);
}

TEST(Phantom, AnatomyLiesAsInARightEar)
{
  const Vector3d vestibule = centroid("vestibule");
  const Vector3d cochlea = centroid("cochlea");
  const Vector3d canal = centroid("external_auditory_canal", 0.8);
  const Vector3d cells = centroid("air_cells", 0.8);
  const Vector3d sigmoid = centroid("sigmoid_sinus", 0.8);
  const Vector3d stapes = centroid("stapes");
  const Vector3d incus = centroid("incus");
  const Vector3d malleus = centroid("malleus");
  // -x lateral, -y anterior, +z superior
  EXPECT_LT(cochlea.y(), vestibule.y() - 3.0) << "cochlea in front of the vestibule";
  EXPECT_GT(cells.y(), canal.y() + 5.0) << "mastoid behind the ear canal";
  EXPECT_LT(canal.x(), stapes.x() - 5.0);
  EXPECT_LT(stapes.x(), vestibule.x()) << "stapes lateral of the vestibule";
  EXPECT_LT(incus.x(), stapes.x()) << "incus lateral of the stapes";
  EXPECT_LT(malleus.y(), incus.y()) << "malleus in front of the incus";
  EXPECT_GT(sigmoid.y(), cells.y()) << "sinus behind the cells";
  EXPECT_GT(centroid("superior_semicircular_canal").z(), vestibule.z() + 2.0);
  EXPECT_GT(centroid("posterior_semicircular_canal").y(), vestibule.y() + 2.0);
  EXPECT_LT(centroid("lateral_semicircular_canal").x(), vestibule.x() - 1.0);
  EXPECT_LT(centroid("carotid_artery", 0.8).y(), cochlea.y());
  EXPECT_LT(centroid("jugular_bulb", 0.8).z(), vestibule.z() - 8.0);
  EXPECT_GT(centroid("tegmen", 0.8).z(), incus.z());
  // mastoid segment of the facial nerve: posterior and inferior to the middle ear, lateral of the
  // labyrinth
  EXPECT_LT(phantom().signedDistance("facial_nerve", {-46.0, 5.4, -4.0}), 0.0);
  // tympanic segment: above the oval window, below the lateral canal
  EXPECT_LT(phantom().signedDistance("facial_nerve", {-43.3, 0.7, 3.2}), 0.0);
  EXPECT_GT(stapes.z() + 1.0, 0.0);
  EXPECT_LT(stapes.z(), 3.2 - 1.0);
}

TEST(Phantom, FacialCanalIsSoftTissueInBoneAroundItsAxis)
{
  const auto axis = Phantom::facialCanalAxis();
  int walls = 0;
  int bony = 0;
  for (std::size_t i = 5; i + 5 < axis.size(); ++i) // its ends are open
  {
    EXPECT_LE((axis[i + 1].position - axis[i].position).norm(), 0.45);
    const Eigen::Vector3d along = (axis[i + 1].position - axis[i - 1].position).normalized();
    const Eigen::Vector3d u = along.unitOrthogonal();
    const Eigen::Vector3d v = along.cross(u);
    for (int a = 0; a < 8; ++a)
    {
      const Eigen::Vector3d n = std::cos(a * kPi / 4.0) * u + std::sin(a * kPi / 4.0) * v;
      EXPECT_LT(phantom().hounsfield(axis[i].position + (axis[i].radius - 0.1) * n), 100.0) << i;
      ++walls;
      bony += phantom().hounsfield(axis[i].position + (axis[i].radius + 0.15) * n) > 700.0 ? 1 : 0;
    }
  }
  EXPECT_GT(bony, 0.95 * walls) << "but for the niche of the oval window";
}

TEST(Phantom, SemicircularCanalsAreNearlyPerpendicular)
{
  const auto planes = anatomy::canalPlanes();
  for (std::size_t a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(planes[a].normal.norm(), 1.0, 1e-12);
    EXPECT_GE(planes[a].radius, 2.8);
    EXPECT_LE(planes[a].radius, 3.8);
    for (std::size_t b = a + 1; b < 3; ++b)
    {
      const double angle =
          std::acos(std::abs(planes[a].normal.dot(planes[b].normal))) * 180.0 / kPi;
      EXPECT_GT(angle, 70.0) << a << " and " << b;
    }
  }
}

TEST(Phantom, CochleaTurnsTwoAndAHalfTimesAndTapers)
{
  const double volume = phantom().volume(phantom().indexOf("cochlea"), earBox());
  EXPECT_GT(volume, 50.0); // adults: 60 to 110 mm^3
  EXPECT_LT(volume, 110.0);
}

TEST(Phantom, StructuresThatMustNotMeetKeepTheirDistance)
{
  const std::array<std::array<const char*, 2>, 8> pairs{
      {{"facial_nerve", "lateral_semicircular_canal"},
       {"facial_nerve", "cochlea"},
       {"facial_nerve", "superior_semicircular_canal"},
       {"facial_nerve", "incus"},
       {"sigmoid_sinus", "air_cells"},
       {"carotid_artery", "cochlea"},
       {"jugular_bulb", "posterior_semicircular_canal"},
       {"malleus", "incus"}}};
  for (const auto& pair : pairs)
  {
    const core::TriangleMesh mesh = phantom().surface(phantom().indexOf(pair[0]), earBox(), 0.3);
    const std::size_t other = phantom().indexOf(pair[1]);
    double least = 1e9;
    for (const auto& v : mesh.vertices)
      least = std::min(least, phantom().signedDistance(other, v.cast<double>()));
    EXPECT_GT(least, 0.1) << pair[0] << " and " << pair[1];
  }
}

TEST(Phantom, TegmenIsAThinPlateUnderTheBrain)
{
  const std::size_t tegmen = phantom().indexOf("tegmen");
  for (const double y : {-1.0, 3.0, 7.0})
  {
    int inside = 0;
    for (double z = 8.0; z < 16.0; z += 0.01)
      inside += phantom().signedDistance(tegmen, {-47.5, y, z}) < 0.0 ? 1 : 0;
    EXPECT_GE(0.01 * inside, 1.0);
    EXPECT_LE(0.01 * inside, 1.5);
  }
  EXPECT_LT(phantom().distanceToCranialCavity({-47.0, 3.0, 14.0}), 0.0);
  EXPECT_GT(phantom().distanceToCranialCavity({-47.0, 3.0, 8.0}), 2.0);
}

TEST(Phantom, VolumesAgreeWithTheLabels)
{
  for (const char* name : {"vestibule", "incus", "malleus", "cochlea", "cholesteatoma"})
  {
    const std::size_t s = phantom().indexOf(name);
    const core::GridGeometry grid = gridRound(middle(name), 110, 0.15);
    const volume::LabelMap labels = labelPhantom(phantom(), grid);
    const double truth = phantom().volume(s, earBox());
    EXPECT_NEAR(labels.volume(labels.segments[s]), truth, 0.012 * truth) << name;
  }
}

TEST(Phantom, VolumeOfTheVestibuleIsThatOfItsEllipsoid)
{
  // half axes 2, 2.7, 2.4, minus the volume of the footplate's rim
  const double truth = 4.0 / 3.0 * kPi * 2.0 * 2.7 * 2.4;
  EXPECT_NEAR(phantom().volume(phantom().indexOf("vestibule"), earBox()), truth, 0.003 * truth);
}

TEST(Phantom, SurfacesAreClosedAndHoldTheTrueVolume)
{
  for (std::size_t s = 0; s < phantom().structures().size(); ++s)
  {
    const PhantomStructure& structure = phantom().structures()[s];
    if (!structure.meshed)
      continue;
    const core::TriangleMesh mesh = phantom().surface(s, earBox());
    EXPECT_TRUE(mesh.isClosed()) << structure.name;
    const double truth = phantom().volume(s, earBox());
    EXPECT_NEAR(mesh.signedVolume(), truth, 0.01 * truth) << structure.name;
  }
}

TEST(Phantom, MotionIsRigidAndAFewDegreesAndMillimetres)
{
  for (std::uint64_t seed = 1; seed < 20; ++seed)
  {
    const core::RigidTransform motion = Phantom(PhantomRecipe{seed, true}).mrFromCt();
    const Eigen::Matrix3d r = motion.rotation().toRotationMatrix();
    EXPECT_NEAR((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-12);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
    const double degrees = Eigen::AngleAxisd(r).angle() * 180.0 / kPi;
    EXPECT_GT(degrees, 3.9);
    EXPECT_LT(degrees, 6.1);
    EXPECT_LT((motion * Phantom::center() - Phantom::center()).norm(), 10.5);
  }
}

TEST(Phantom, MovedScanShowsTheMovedPatient)
{
  ScanSettings settings;
  settings.modality = Phantom::Modality::Mr;
  settings.noise = 0.0;
  settings.pointSpread = 0.0;
  const core::RigidTransform motion = phantom().mrFromCt();
  settings.patientFromScan = motion.inverse();
  const core::GridGeometry grid = gridRound(motion * Vector3d(-38.4, 1.0, 1.4), 9, 0.3);
  const auto mr = samplePhantom(phantom(), grid, settings);
  EXPECT_NEAR(mr.at(4, 4, 4), phantom().mrIntensity({-38.4, 1.0, 1.4}), 1.0);
}

TEST(Phantom, NamesAnUnknownStructure)
{
  EXPECT_THROW(phantom().indexOf("spleen"), core::InvalidParameter);
}

} // namespace petrous::phantom
