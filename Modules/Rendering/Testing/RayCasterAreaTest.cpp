#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include <vtkCamera.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include "CameraPlacement.h"
#include "PictureScenes.h"
#include "RayCaster.h"
#include "petrous/Rendering/EglRenderWindow.h"

// Rays that miss the bounding box of all tissue are not cast: each picture is compared with the one
// for which every ray was cast.

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

RayView viewOf(const core::CameraPose& pose, double aspect)
{
  vtkNew<vtkCamera> camera;
  aimCamera(camera, pose);
  camera->SetWindowCenter(pose.lensShift / aspect, 0.0);
  return raysOf(camera, aspect, Eigen::Matrix4d::Identity());
}

struct Cast
{
  std::vector<float> color; // RGBA
  std::vector<float> depth; // mm; -1: none
  double fetches = 0.0;

  bool operator==(const Cast& other) const // bit-identical
  {
    const auto same = [](const std::vector<float>& a, const std::vector<float>& b)
    { return a.size() == b.size() && !std::memcmp(a.data(), b.data(), a.size() * sizeof(float)); };
    return same(color, other.color) && same(depth, other.depth);
  }
  bool anything() const
  {
    return std::any_of(depth.begin(), depth.end(), [](float d) { return d >= 0.0F; });
  }
};

class RayCasterArea : public ::testing::Test
{
protected:
  RayCasterArea() { m_window->Initialize(); }
  ~RayCasterArea() override
  {
    m_window->MakeCurrent();
    m_caster.release();
  }

  Cast cast(const core::CameraPose& pose, bool everywhere)
  {
    m_window->MakeCurrent();
    const PlainDrawing plain(m_window);
    RayCaster::Frame frame;
    frame.view = viewOf(pose, static_cast<double>(m_width) / m_height);
    frame.width = m_width;
    frame.height = m_height;
    frame.everywhere = everywhere;
    m_caster.draw(frame, true);
    Cast result;
    result.fetches = m_caster.statistics().fetchesPerPixel;
    const core::Index3& size = m_caster.target().color().dims();
    result.color.resize(4 * static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]));
    m_caster.target().color().bind(0);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, result.color.data());
    for (const float d : m_caster.target().readDepth().millimetres)
      result.depth.push_back(d >= 0.0F ? d : -1.0F);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return result;
  }

  // Draws a picture and checks that it equals that of all rays.
  Cast expectAll(const core::CameraPose& pose)
  {
    const Cast part = cast(pose, false);
    const Cast all = cast(pose, true);
    EXPECT_TRUE(part == all);
    EXPECT_LE(part.fetches, all.fetches);
    m_spared = all.fetches - part.fetches;
    return part;
  }

  vtkNew<vtkPetrousEGLRenderWindow> m_window;
  RayCaster m_caster;
  int m_width = 160;
  int m_height = 120;
  double m_spared = 0.0; // fetches per pixel that the last picture saved
};

// Balls in two corners of the grid, which is 30 mm wide.
SceneContents twoBalls()
{
  return boneScene(ct<std::int16_t>(cube(60, 0.5, oblique()),
                                    [](const Vector& p)
                                    {
                                      return std::max(4.0 - (p - Vector(6.0, 0.0, 5.0)).norm(),
                                                      3.0 - (p + Vector(5.0, 2.0, 6.0)).norm());
                                    }),
                   0.35F);
}

std::shared_ptr<volume::CutMask> without(const SceneContents& contents, const Vector& ball,
                                         double radius)
{
  return cut(contents.ct->geometry(), [=](const Vector& p) { return (p - ball).norm() - radius; });
}

} // namespace

TEST_F(RayCasterArea, HoldsAllThatIsSeenInPerspective)
{
  for (const SceneContents& contents :
       {translucentBall(), fullScene(), boneScene(ball(cube(24, 0.5), 9.0), 0.35F)})
  {
    m_caster.setContents(contents);
    for (const Vector& eye : {Vector(30.0, -48.0, 21.0), Vector(0.0, 20.0, 65.0),
                              Vector(-60.0, 1.0, 0.0), Vector(-33.0, 50.0, -41.0)})
    {
      EXPECT_TRUE(expectAll(from(eye, Vector::Zero())).anything());
      EXPECT_GT(m_spared, 0.0);
      EXPECT_TRUE(expectAll(from(eye, Vector(3.0, 4.0, 8.0), 22.0)).anything()); // beyond a border
    }
  }
  core::CameraPose shifted = from({30.0, -48.0, 21.0}, Vector::Zero());
  shifted.lensShift = 0.4;
  EXPECT_TRUE(expectAll(shifted).anything());
}

TEST_F(RayCasterArea, HoldsAllThatIsSeenInParallel)
{
  m_caster.setContents(fullScene());
  core::CameraPose pose = from({30.0, -48.0, 21.0}, {2.0, 0.0, -1.0});
  for (const double scale : {30.0, 12.0, 4.0})
    for (const double shift : {0.0, -0.3})
    {
      pose.parallelScale = scale;
      pose.lensShift = shift;
      EXPECT_TRUE(expectAll(pose).anything()) << scale;
    }
  pose.parallelScale = 30.0;
  expectAll(pose);
  EXPECT_GT(m_spared, 0.0);
  pose.position = {1.0, -2.0, 0.5}; // the camera plane intersects the box
  pose.lensShift = 0.0;
  EXPECT_TRUE(expectAll(pose).anything());
}

TEST_F(RayCasterArea, HoldsAllWhereTheEyeIsInTheBox)
{
  m_caster.setContents(translucentBall());
  for (const Vector& at : {Vector(4.0, -6.0, 3.0), Vector(0.0, 9.0, 0.0), Vector(-9.0, 0.0, -9.0)})
  {
    EXPECT_TRUE(expectAll(from({2.0, -7.0, 3.0}, at, 80.0)).anything()); // in the bite
    EXPECT_TRUE(expectAll(from({-4.0, 2.0, 0.0}, at, 50.0)).anything()); // in the tissue
  }
}

TEST_F(RayCasterArea, HoldsAllWhereTheBoxIsPartlyBehindTheEye)
{
  const SceneContents contents = twoBalls();
  m_caster.setContents(contents);
  // Past the line between the balls, and between them.
  for (const auto& [eye, at] : {std::pair{Vector(3.0, -7.0, 0.0), Vector(6.0, 0.0, 5.0)},
                                {Vector(3.0, -7.0, 0.0), Vector(30.0, -3.0, 5.0)},
                                {Vector(0.5, -1.0, -0.5), Vector(6.0, 0.0, 5.0)},
                                {Vector(-9.0, 9.0, 9.0), Vector(-1.0, 0.0, 0.0)}})
    for (const double angle : {30.0, 100.0})
      expectAll(from(eye, at, angle));
  EXPECT_TRUE(expectAll(from({3.0, -7.0, 0.0}, {6.0, 0.0, 5.0}, 100.0)).anything());
}

TEST_F(RayCasterArea, ShowsNothingWhereTheBoxIsOffTheScreen)
{
  m_caster.setContents(translucentBall());
  const Vector eye(30.0, -48.0, 21.0);
  EXPECT_TRUE(expectAll(from(eye, Vector::Zero())).anything());
  // Past it on each side, and facing away: nothing of the previous picture may remain.
  const Vector side = eye.cross(Vector::UnitZ()).normalized();
  const Vector up = side.cross(eye).normalized();
  for (const Vector& at :
       {Vector(45.0 * side), Vector(-45.0 * side), Vector(45.0 * up), Vector(-45.0 * up)})
  {
    EXPECT_FALSE(expectAll(from(eye, at)).anything());
    EXPECT_EQ(cast(from(eye, at), false).fetches, 0.0);
  }
  EXPECT_FALSE(expectAll(from(eye, 2.0 * eye)).anything());
}

TEST_F(RayCasterArea, HoldsAllOfWhatIsClippedAndCropped)
{
  SceneContents contents = fullScene();
  contents.crop = core::IndexBox{{10, 12, 5}, {33, 40, 41}};
  contents.clipping = {{{0.0, -2.0, 0.0}, Vector(0.2, 1.0, 0.1).normalized()}};
  m_caster.setContents(contents);
  EXPECT_TRUE(expectAll(from({30.0, -48.0, 21.0}, Vector::Zero())).anything());
  EXPECT_TRUE(expectAll(from({-9.0, 30.0, 4.0}, Vector::Zero())).anything());
  contents.clipping.clear();
  m_caster.setContents(contents);
  EXPECT_TRUE(expectAll(from({-9.0, 30.0, 4.0}, Vector::Zero())).anything());
  contents.crop = std::nullopt;
  m_caster.setContents(contents);
  EXPECT_TRUE(expectAll(from({-9.0, 30.0, 4.0}, Vector::Zero())).anything());
}

TEST_F(RayCasterArea, GrowsWhereAnUndoBringsTissueBack)
{
  SceneContents contents = twoBalls();
  const core::CameraPose pose = from({20.0, -40.0, 9.0}, Vector::Zero(), 40.0);
  m_caster.setContents(contents);
  const Cast whole = expectAll(pose);
  const double spared = m_spared;
  contents.mask = without(contents, {6.0, 0.0, 5.0}, 9.0); // all of one ball and its bricks
  m_caster.setContents(contents);
  const Cast less = expectAll(pose);
  EXPECT_GT(m_spared, 1.1 * spared); // the area shrank
  EXPECT_FALSE(less == whole);
  // A small cut elsewhere remains, so that the mask stays in use.
  const auto undone = without(contents, {-5.0, -2.0, -6.0}, 1.0);
  m_caster.maskChanged(undone, contents.ct->geometry().fullBox());
  const Cast back = expectAll(pose);
  EXPECT_FALSE(back == less);
  contents.mask = undone;
  m_caster.setContents(contents);
  EXPECT_TRUE(expectAll(pose) == back);
  m_caster.maskChanged(nullptr, contents.ct->geometry().fullBox());
  EXPECT_TRUE(expectAll(pose) == whole);
}

TEST_F(RayCasterArea, FollowsAnotherIsoValueAndAnotherBrick)
{
  SceneContents contents = twoBalls();
  const core::CameraPose pose = from({20.0, -40.0, 9.0}, Vector::Zero(), 40.0);
  m_caster.setContents(contents);
  expectAll(pose);
  contents.iso = kIso - 600.0; // the balls grow by five voxels
  m_caster.setContents(contents);
  expectAll(pose);
  for (const int brick : {16, 8, 4})
  {
    RenderQuality quality;
    quality.brick = brick;
    m_caster.setQuality(quality);
    EXPECT_TRUE(expectAll(pose).anything()) << brick;
  }
  contents.ct = hollowBall().ct; // another grid
  contents.iso = kIso;
  m_caster.setContents(contents);
  EXPECT_TRUE(expectAll(pose).anything());
}

TEST_F(RayCasterArea, IsEmptyWhereAllIsCutAway)
{
  SceneContents contents = twoBalls();
  const core::CameraPose pose = from({20.0, -40.0, 9.0}, Vector::Zero(), 40.0);
  m_caster.setContents(contents);
  const Cast whole = expectAll(pose);
  const auto all = cut(contents.ct->geometry(), [](const Vector&) { return -5.0; });
  m_caster.maskChanged(all, contents.ct->geometry().fullBox());
  EXPECT_FALSE(expectAll(pose).anything());
  m_caster.maskChanged(nullptr, contents.ct->geometry().fullBox());
  EXPECT_TRUE(expectAll(pose) == whole);
  contents.mask = all;
  m_caster.setContents(contents);
  EXPECT_FALSE(expectAll(pose).anything());
  EXPECT_EQ(cast(pose, false).fetches, 0.0);
  contents.mask = nullptr;
  m_caster.setContents(contents);
  EXPECT_TRUE(expectAll(pose) == whole);
}

TEST_F(RayCasterArea, FollowsTheWindow)
{
  m_caster.setContents(fullScene());
  RenderQuality quality;
  for (const double scale : {1.0, 0.35})
    for (const auto& [width, height] :
         {std::pair{160, 120}, {31, 77}, {1, 1}, {7, 300}, {640, 9}, {160, 120}})
    {
      m_width = width;
      m_height = height;
      quality.imageScale = scale;
      m_caster.setQuality(quality);
      expectAll(from({30.0, -48.0, 21.0}, Vector::Zero()));
      expectAll(from({30.0, -48.0, 21.0}, {5.0, 0.0, 9.0}, 12.0));
    }
}

TEST_F(RayCasterArea, LeavesTheScissorAsItWas)
{
  m_window->MakeCurrent();
  const std::array<GLint, 4> mine{3, 5, 70, 60};
  glScissor(mine[0], mine[1], mine[2], mine[3]);
  m_caster.setContents(translucentBall());
  expectAll(from({30.0, -48.0, 21.0}, Vector::Zero()));
  std::array<GLint, 4> after{};
  glGetIntegerv(GL_SCISSOR_BOX, after.data());
  EXPECT_EQ(after, mine);
}
