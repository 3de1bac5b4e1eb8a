#include "petrous/Presenters/InstrumentFile.h"

#include <cmath>
#include <filesystem>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "BoneCase.h"
#include "HeldTool.h"
#include "petrous/Core/Error.h"
#include "petrous/Imaging/MeshFile.h"

using namespace petrous;
using namespace petrous::presenters;
using namespace petrous::presenters::testing;
using Eigen::Vector3d;

namespace
{

/// A four-sided pyramid with its tip at `tip` and its base `length` towards `toHand`, of unit
/// length; 2 mm wide for 40 mm.
core::TriangleMesh pick(double length = 40.0, const Vector3d& tip = Vector3d::Zero(),
                        const Vector3d& toHand = Vector3d::UnitZ())
{
  const Vector3d u = toHand.unitOrthogonal() * length / 40.0;
  const Vector3d v = toHand.cross(u);
  const Vector3d base = tip + length * toHand;
  core::TriangleMesh mesh;
  for (const Vector3d& p : {tip, Vector3d(base + u + v), Vector3d(base - u + v),
                            Vector3d(base - u - v), Vector3d(base + u - v)})
    mesh.vertices.push_back(p.cast<float>());
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}};
  return mesh;
}

class InstrumentFileTest : public ::testing::Test
{
protected:
  InstrumentFileTest()
  {
    std::filesystem::remove_all(m_folder);
    std::filesystem::create_directories(m_folder);
  }
  ~InstrumentFileTest() override { std::filesystem::remove_all(m_folder); }

  std::filesystem::path write(const std::string& name, const core::TriangleMesh& mesh) const
  {
    imaging::writeMesh(m_folder / name, mesh);
    return m_folder / name;
  }

  std::string refusal(const core::TriangleMesh& mesh, const std::string& axis = "z+") const
  {
    try
    {
      readInstrument(write("refused.obj", mesh), axis);
    }
    catch (const core::InvalidParameter& error)
    {
      return error.what();
    }
    return {};
  }

private:
  std::filesystem::path m_folder =
      std::filesystem::temp_directory_path() / ("petrous-instrument-" + std::to_string(::getpid()));
};

} // namespace

TEST_F(InstrumentFileTest, IsFeltAndDrawnAsItLiesInAnyFormat)
{
  ASSERT_GT(pick().signedVolume(), 0.0);
  for (const char* name : {"pick.stl", "pick.obj", "pick.ply"})
  {
    SCOPED_TRACE(name);
    const LoadedInstrument loaded = readInstrument(write(name, pick()));
    EXPECT_TRUE(loaded.notes.empty());
    EXPECT_EQ(loaded.instrument->name, name);
    EXPECT_EQ(reachBeyondTip(*loaded.instrument), 0.0);
    const auto bounds = loaded.instrument->surface->bounds();
    EXPECT_EQ(bounds[0].z(), 0.0F);
    EXPECT_NEAR(bounds[1].z(), 40.0F, 1e-5F);
    EXPECT_NEAR(loaded.instrument->surface->signedVolume(), 4.0 * 40.0 / 3.0, 1e-3);
    // The tip first; every point is on one of the planes of the sides or the base.
    const haptics::PointShell& shell = *loaded.instrument->shell;
    EXPECT_LT(shell.points.front().norm(), 1e-6);
    for (const Vector3d& p : shell.points)
    {
      const double across =
          std::max(std::abs(p.dot(Vector3d::UnitZ().unitOrthogonal())),
                   std::abs(p.dot(Vector3d::UnitZ().cross(Vector3d::UnitZ().unitOrthogonal()))));
      EXPECT_TRUE(std::abs(across - p.z() / 40.0) < 1e-4 || std::abs(p.z() - 40.0) < 1e-4);
    }
    EXPECT_NE(toString(*loaded.instrument).find(name), std::string::npos);
  }
}

TEST_F(InstrumentFileTest, IsTurnedSoThatItsShaftLeadsToTheHand)
{
  for (const char* axis : kInstrumentAxes)
  {
    SCOPED_TRACE(axis);
    const Vector3d toHand = (axis[1] == '-' ? -1.0 : 1.0) * Vector3d::Unit(axis[0] - 'x');
    const auto path = write("turned.ply", pick(40.0, Vector3d::Zero(), toHand));
    const LoadedInstrument loaded = readInstrument(path, axis);
    EXPECT_TRUE(loaded.notes.empty());
    const auto bounds = loaded.instrument->surface->bounds();
    EXPECT_NEAR(bounds[0].z(), 0.0F, 1e-5F);
    EXPECT_NEAR(bounds[1].z(), 40.0F, 1e-4F);
    EXPECT_NEAR(loaded.instrument->surface->signedVolume(), 4.0 * 40.0 / 3.0, 1e-2)
        << "a rotation, not a reflection";
  }
  EXPECT_NE(refusal(pick(), "w+").find("x+, x-, y+"), std::string::npos);
  const auto across = write("across.ply", pick(40.0, Vector3d::Zero(), Vector3d::UnitX()));
  const LoadedInstrument loaded = readInstrument(across);
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_NE(loaded.notes.front().find("across the shaft"), std::string::npos);
}

TEST_F(InstrumentFileTest, ProposesTheLongestAxisWithTheTipAtTheOriginOrTheNarrowEnd)
{
  for (const char* axis : kInstrumentAxes)
  {
    SCOPED_TRACE(axis);
    const double sign = axis[1] == '-' ? -1.0 : 1.0;
    const Vector3d toHand = sign * Vector3d::Unit(axis[0] - 'x');
    EXPECT_EQ(likelyAxis(pick(40.0, Vector3d::Zero(), toHand)), axis) << "tip at the origin";
    const core::TriangleMesh away = pick(40.0, Vector3d(70.0, -90.0, 55.0), toHand);
    EXPECT_EQ(likelyAxis(away), axis) << "tip at the narrow end";
    const InstrumentPlacement lies = placementOf(away, axis);
    EXPECT_NEAR(lies.length, 40.0, 1e-4);
    EXPECT_NEAR(lies.tip, Vector3d(70.0, -90.0, 55.0)[axis[0] - 'x'], 1e-4);
    EXPECT_FALSE(lies.isAcross());
    // The origin counts more than the shape: a mallet's broad end.
    EXPECT_EQ(likelyAxis(pick(40.0, Vector3d(40.0 * toHand), Vector3d(-toHand))), axis);
  }
  const InstrumentPlacement across =
      placementOf(pick(40.0, Vector3d::Zero(), Vector3d::UnitX()), "z+");
  EXPECT_NEAR(across.width, 40.0, 1e-4);
  EXPECT_TRUE(across.isAcross());
}

TEST_F(InstrumentFileTest, TakesThePointFarthestFromTheHandForTheTipAndSaysSo)
{
  const LoadedInstrument loaded =
      readInstrument(write("far.obj", pick(40.0, Vector3d(100.0, -20.0, 5.0))));
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_NE(loaded.notes.front().find("origin"), std::string::npos);
  EXPECT_LT(loaded.instrument->shell->points.front().norm(), 1e-4);
  EXPECT_NEAR(loaded.instrument->surface->bounds()[1].z(), 40.0F, 1e-4F);
  // Half a millimetre above the end counts as the tip.
  const LoadedInstrument above =
      readInstrument(write("above.obj", pick(40.0, Vector3d(0.0, 0.0, -0.5))));
  EXPECT_TRUE(above.notes.empty());
  EXPECT_NEAR(reachBeyondTip(*above.instrument), 0.5, 1e-6);
}

// A thin shaft has its surface everywhere within 1 mm of its axis.
TEST_F(InstrumentFileTest, TakesNoOriginInTheMiddleOfAThinShaftForTheTip)
{
  // The pick is 1 mm wide in its middle, 0.35 mm from the axis.
  const LoadedInstrument middle =
      readInstrument(write("middle.ply", pick(40.0, Vector3d(0.0, 0.0, -20.0))));
  EXPECT_EQ(reachBeyondTip(*middle.instrument), 0.0);
  EXPECT_NEAR(middle.instrument->surface->bounds()[1].z(), 40.0F, 1e-4F);
  EXPECT_LT(middle.instrument->shell->points.front().norm(), 1e-4);
  ASSERT_EQ(middle.notes.size(), 1U);
  EXPECT_NE(middle.notes.front().find("20 mm beyond the file's origin"), std::string::npos)
      << middle.notes.front();
  // As many millimetres above the tip as count as at it, and some more.
  EXPECT_TRUE(
      readInstrument(write("near.ply", pick(40.0, Vector3d(0.0, 0.0, -0.9)))).notes.empty());
  EXPECT_EQ(readInstrument(write("off.ply", pick(40.0, Vector3d(0.0, 0.0, -1.1)))).notes.size(),
            1U);
}

TEST_F(InstrumentFileTest, NamesTheReversedAxisWhereTheOriginIsAtTheOtherEnd)
{
  for (const char* axis : kInstrumentAxes)
  {
    SCOPED_TRACE(axis);
    const Vector3d toHand = (axis[1] == '-' ? -1.0 : 1.0) * Vector3d::Unit(axis[0] - 'x');
    const std::string reversed{axis[0], axis[1] == '-' ? '+' : '-'};
    const auto path = write("reversed.ply", pick(40.0, Vector3d::Zero(), toHand));
    const LoadedInstrument loaded = readInstrument(path, reversed);
    ASSERT_EQ(loaded.notes.size(), 1U);
    EXPECT_NE(loaded.notes.front().find("its axis is " + std::string(axis)), std::string::npos)
        << loaded.notes.front();
    EXPECT_EQ(reachBeyondTip(*loaded.instrument), 0.0);
    EXPECT_TRUE(readInstrument(path, axis).notes.empty());
  }
}

TEST_F(InstrumentFileTest, RefusesWhatIsNoInstrumentAndSaysWhatWouldBeRight)
{
  core::TriangleMesh open = pick();
  open.triangles.pop_back(); // half of the base
  EXPECT_NE(refusal(open).find("ends at 3 edges"), std::string::npos) << refusal(open);
  core::TriangleMesh flat = pick();
  for (Eigen::Vector3f& vertex : flat.vertices)
    vertex.x() = 0.0F;
  EXPECT_NE(refusal(flat).find("encloses nothing"), std::string::npos) << refusal(flat);
  const std::string large = refusal(pick(301.0));
  EXPECT_NE(large.find("is 301 mm long"), std::string::npos) << large;
  EXPECT_NE(large.find("1 to 300 mm"), std::string::npos) << large;
  EXPECT_EQ(refusal(pick(299.0)), "");
  const std::string inMetres = refusal(pick(0.16));
  EXPECT_NE(inMetres.find("160 mm if its numbers were in m;"), std::string::npos) << inMetres;
  EXPECT_EQ(inMetres.find("cm"), std::string::npos) << "1.6 mm long is no instrument";
}

TEST_F(InstrumentFileTest, IsTheSameFromACaseThatKeepsIt)
{
  const auto path = write("far.ply", pick(40.0, Vector3d(100.0, -20.0, 5.0), Vector3d::UnitX()));
  const InstrumentSurface surface = readInstrumentSurface(path);
  scene::ViewState::Instrument kept = keptInstrument(surface, "x+");
  EXPECT_EQ(kept.name, "far.ply");
  EXPECT_EQ(kept.object, "") << "not stored yet";
  const LoadedInstrument one = readInstrument(path, "x+");
  const LoadedInstrument other = makeInstrument(surfaceOf(kept), kept.axis);
  EXPECT_TRUE(one.instrument->surface->vertices == other.instrument->surface->vertices);
  EXPECT_EQ(one.notes, other.notes);
  kept.name.clear();
  EXPECT_EQ(surfaceOf(kept, "pick").name, "pick");
  // What came from elsewhere is checked as a file is.
  core::TriangleMesh open = surface.mesh;
  open.triangles.pop_back();
  kept.mesh = std::make_shared<const core::TriangleMesh>(open);
  EXPECT_THROW(surfaceOf(kept), core::InvalidParameter);
}

TEST_F(InstrumentFileTest, PressesOnBoneWithItsTipAndTakesNone)
{
  scene::Case value = block();
  session::TouchScene scene(value);
  HeldTool held(Vector3d(6.0, 6.0, kTop + 2.5), session::TouchTool::Mode::ThreeDof);
  held.setup.tool.instrument = readInstrument(write("pick.stl", pick(5.0))).instrument;
  session::TouchSession session(value, scene, held.device, held.setup);
  held.drill(true);
  session::TickRecord record;
  ASSERT_TRUE(until(
      [&]
      {
        if (const auto news = session.advance(); news.record)
        {
          record = *news.record;
          held.device.see(record);
        }
        return std::abs(record.thrust - 1.0) < 0.05;
      }));
  EXPECT_NEAR(record.proxy.pose().position.z(), kTop, 0.1);
  EXPECT_TRUE(session.stop().strokes.empty());
  EXPECT_TRUE(value.dissection.mask().untouched());
  EXPECT_THROW(scene.recordingOf(held.setup.tool, scene.servoOf(held.setup.tool), "note"),
               core::InvalidParameter);
}
