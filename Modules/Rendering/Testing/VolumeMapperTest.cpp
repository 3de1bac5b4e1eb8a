#include "petrous/Rendering/VolumeMapper.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkImageCast.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkRenderer.h>
#include <vtkTestErrorObserver.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "WindowPicture.h"
#include "petrous/Core/Error.h"
#include "petrous/Rendering/EglRenderWindow.h"
#include "petrous/Rendering/VtkVolume.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

// A plain VTK program using the mapper.
class Program
{
public:
  explicit Program(vtkImageData* image)
  {
    mapper->SetInputData(image);
    mapper->SetIsoValue(kIso);
    colors->AddRGBPoint(kIso, 0.80, 0.60, 0.42);
    colors->AddRGBPoint(kIso + 1500.0, 0.97, 0.95, 0.88);
    opacities->AddPoint(kIso, 0.02);
    opacities->AddPoint(kIso + 1500.0, 0.5);
    property->SetColor(colors);
    property->SetScalarOpacity(opacities);
    volume->SetMapper(mapper);
    volume->SetProperty(property);
    open();
  }

  ~Program() { window->MakeCurrent(); }

  // Another window, as when a program moves its view.
  void open()
  {
    auto next = vtkSmartPointer<vtkPetrousEGLRenderWindow>::New();
    if (renderer)
    {
      renderer->RemoveVolume(volume);
      volume->ReleaseGraphicsResources(window);
      window->RemoveRenderer(renderer);
    }
    renderer = vtkSmartPointer<vtkRenderer>::New();
    window = next;
    window->SetSize(kWidth, kHeight);
    window->Initialize();
    renderer->SetBackground(optics::kBackground[0], optics::kBackground[1], optics::kBackground[2]);
    renderer->AddVolume(volume);
    window->AddRenderer(renderer);
    setCamera(slanting());
  }

  void setCamera(const core::CameraPose& pose)
  {
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->SetPosition(pose.position.data());
    camera->SetFocalPoint(pose.focalPoint.data());
    camera->SetViewUp(pose.viewUp.data());
    camera->SetViewAngle(pose.viewAngle);
  }

  Picture draw()
  {
    renderer->ResetCameraClippingRange();
    window->Render();
    return readWindow(window);
  }

  Shot shoot() { return {draw(), mapper->GetDepth(), mapper->GetStatistics()}; }

  vtkNew<vtkPetrousVolumeMapper> mapper;
  vtkNew<vtkColorTransferFunction> colors;
  vtkNew<vtkPiecewiseFunction> opacities;
  vtkNew<vtkVolumeProperty> property;
  vtkNew<vtkVolume> volume;
  vtkSmartPointer<vtkPetrousEGLRenderWindow> window;
  vtkSmartPointer<vtkRenderer> renderer;
};

// The contents that the program should show; VTK's default property has ambient 0.1 and no
// highlight.
SceneContents meant(const Program& program, std::shared_ptr<const volume::IntensityVolume> ct,
                    float surfaceOpacity)
{
  SceneContents contents = boneScene(std::move(ct), surfaceOpacity);
  contents.materials[0].transfer =
      appearance::TransferFunction({{kIso, {0.80F, 0.60F, 0.42F}, 0.02F, 1.0F},
                                    {kIso + 1500.0, {0.97F, 0.95F, 0.88F}, 0.5F, 1.0F}});
  contents.materials[0].shininess = static_cast<float>(program.property->GetSpecularPower());
  contents.light.ambient = program.property->GetAmbient();
  contents.light.specular = program.property->GetSpecular();
  return contents;
}

vtkSmartPointer<vtkImageData> bittenImage()
{
  return wrap(*hollowBall(oblique()).ct);
}

vtkSmartPointer<vtkMatrix4x4> matrixOf(const Eigen::Affine3d& pose)
{
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix->SetElement(row, column, pose.matrix()(row, column));
  return matrix;
}

core::CameraPose moved(core::CameraPose pose, const Eigen::Affine3d& by)
{
  pose.position = by * pose.position;
  pose.focalPoint = by * pose.focalPoint;
  pose.viewUp = by.linear() * pose.viewUp;
  return pose;
}

} // namespace

TEST(VolumeMapper, DrawsAnImageWithAPropertyAsTheReferenceDoes)
{
  const auto expectTheReference =
      [](const std::shared_ptr<const volume::IntensityVolume>& ct, double opacity)
  {
    Program program(wrap(*ct));
    program.mapper->SetSurfaceOpacity(opacity);
    const SceneContents contents = meant(program, ct, static_cast<float>(opacity));
    expectAgreement(compare(program.shoot(), truthOf(contents, slanting()), 0.5));
  };
  expectTheReference(hollowBall<std::int16_t>(oblique()).ct, 0.35);
  expectTheReference(hollowBall<std::uint16_t>(oblique()).ct, 1.0);
  expectTheReference(hollowBall<float>(oblique()).ct, 1.0);
}

TEST(VolumeMapper, TakesOpacityOverTheUnitDistanceOfTheProperty)
{
  Program program(bittenImage());
  program.mapper->SetSurfaceOpacity(0.2);
  const Picture one = program.draw();
  // 1 - 0.75^(1/2) over 1 mm is 0.25 over 2 mm.
  program.opacities->RemoveAllPoints();
  program.opacities->AddPoint(kIso, 1.0 - std::pow(1.0 - 0.02, 2.0));
  program.opacities->AddPoint(kIso + 1500.0, 1.0 - std::pow(1.0 - 0.5, 2.0));
  program.property->SetScalarOpacityUnitDistance(2.0);
  EXPECT_EQ(countDifferentPixels(program.draw(), one), 0U);
  program.property->SetScalarOpacityUnitDistance(20.0);
  EXPECT_GT(countDifferentPixels(program.draw(), one), 1000U);
}

TEST(VolumeMapper, FollowsWhatVtkSaysOfIsoOpacityAndColors)
{
  Program program(bittenImage());
  const Picture before = program.draw();
  program.mapper->SetIsoValue(kIso + 300.0);
  EXPECT_GT(countDifferentPixels(program.draw(), before), 1000U);
  program.mapper->SetIsoValue(kIso);
  EXPECT_EQ(countDifferentPixels(program.draw(), before), 0U);
  program.colors->AddRGBPoint(kIso, 0.1, 0.2, 0.9);
  EXPECT_GT(countDifferentPixels(program.draw(), before), 1000U);
}

TEST(VolumeMapper, DrawsAMovedPropAsAMovedCamera)
{
  const Eigen::Affine3d pose = Eigen::Translation3d(30.0, -20.0, 10.0) *
                               Eigen::AngleAxisd(0.8, Vector(1.0, 1.0, -2.0).normalized());
  Program program(bittenImage());
  program.mapper->SetSurfaceOpacity(0.35);
  const Shot still = program.shoot();
  program.volume->SetUserMatrix(matrixOf(pose));
  program.setCamera(moved(slanting(), pose));
  const Shot turned = program.shoot();
  // Rounding of the matrices to float moves hits by less than a thousandth of a voxel.
  EXPECT_LT(countDifferentPixels(turned.picture, still.picture), kWidth * kHeight / 100);
  for (std::size_t p = 0; p < still.depth.millimetres.size(); ++p)
  {
    const float apart = turned.depth.millimetres[p] - still.depth.millimetres[p];
    EXPECT_FALSE(std::abs(apart) > 0.01F) << p; // NaN if either misses
  }
}

TEST(VolumeMapper, DrawsTheSameAMillionMillimetresAway)
{
  const Eigen::Affine3d away(Eigen::Translation3d(1e6, -1e6, 1e6));
  Program program(bittenImage());
  const Picture here = program.draw();
  program.volume->SetUserMatrix(matrixOf(away));
  program.setCamera(moved(slanting(), away));
  EXPECT_LT(countDifferentPixels(program.draw(), here), kWidth * kHeight / 200);

  const core::GridGeometry far = cube(48, 0.5, oblique(), Vector(1e6, -1e6, 1e6));
  const auto ct = synthetic::ct<std::int16_t>(far, [](const Vector& p)
                                              { return bittenBall(p - Vector(1e6, -1e6, 1e6)); });
  Program other(wrap(*ct));
  other.setCamera(moved(slanting(), away));
  EXPECT_LT(countDifferentPixels(other.draw(), here), kWidth * kHeight / 200);
}

TEST(VolumeMapper, ObeysClippingPlanesOfTheWorld)
{
  const Eigen::Affine3d pose = Eigen::Translation3d(30.0, -20.0, 10.0) *
                               Eigen::AngleAxisd(0.8, Vector(1.0, 1.0, -2.0).normalized());
  const SceneContents scene = hollowBall(oblique());
  Program program(wrap(*scene.ct));
  program.mapper->SetSurfaceOpacity(0.35);
  program.volume->SetUserMatrix(matrixOf(pose));
  program.setCamera(moved(slanting(), pose));
  SceneContents contents = meant(program, scene.ct, 0.35F);
  contents.clipping = {{{0.0, -2.0, 0.0}, Vector(0.2, 1.0, 0.1).normalized()}};
  vtkNew<vtkPlane> plane;
  const Vector point = pose * contents.clipping[0].point;
  const Vector normal = pose.linear() * contents.clipping[0].normal;
  plane->SetOrigin(point.x(), point.y(), point.z());
  plane->SetNormal(normal.x(), normal.y(), normal.z());
  const Picture whole = program.draw();
  program.mapper->AddClippingPlane(plane);
  expectAgreement(compare(program.shoot(), truthOf(contents, slanting()), 0.5));
  plane->SetOrigin(1e4 * -normal.x(), 1e4 * -normal.y(), 1e4 * -normal.z()); // nothing is cut
  EXPECT_EQ(countDifferentPixels(program.draw(), whole), 0U);
  program.mapper->RemoveAllClippingPlanes();
  EXPECT_EQ(countDifferentPixels(program.draw(), whole), 0U);
}

TEST(VolumeMapper, ObeysTheCroppingRegion)
{
  const SceneContents scene = hollowBall(); // VTK crops along the axes of an axis-aligned image
  Program program(wrap(*scene.ct));
  program.mapper->SetSurfaceOpacity(0.35);
  const Picture whole = program.draw();
  const auto at = [&](int index) { return scene.ct->geometry().origin().x() + 0.5 * index; };
  program.mapper->SetCroppingRegionPlanes(at(10), at(30), at(12), at(39), at(5), at(40));
  program.mapper->CroppingOn();
  program.mapper->SetCroppingRegionFlagsToSubVolume();
  SceneContents contents = meant(program, scene.ct, 0.35F);
  contents.crop = core::IndexBox{{10, 12, 5}, {31, 40, 41}};
  expectAgreement(compare(program.shoot(), truthOf(contents, slanting()), 0.5));
  program.mapper->SetCroppingRegionPlanes(500.0, 510.0, at(12), at(39), at(5), at(40));
  const Picture nothing = program.draw(); // outside the volume
  EXPECT_TRUE(isBackground(nothing.pixel(kWidth / 2, kHeight / 2)));
  program.mapper->CroppingOff();
  EXPECT_EQ(countDifferentPixels(program.draw(), whole), 0U);
}

TEST(VolumeMapper, RefusesOtherScalarsInWordsAndGoesOn)
{
  vtkNew<vtkImageCast> cast;
  cast->SetInputData(bittenImage());
  cast->SetOutputScalarTypeToDouble();
  cast->Update();
  Program program(bittenImage());
  const Picture before = program.draw();
  vtkNew<vtkTest::ErrorObserver> errors;
  program.mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  program.mapper->SetInputData(cast->GetOutput());
  program.draw();
  EXPECT_TRUE(errors->GetError());
  EXPECT_NE(errors->GetErrorMessage().find("double"), std::string::npos);
  const std::exception_ptr error = program.mapper->TakeError();
  ASSERT_TRUE(error);
  EXPECT_THROW(std::rethrow_exception(error), core::InvalidParameter);
  EXPECT_FALSE(program.mapper->TakeError());
  program.mapper->SetInputData(bittenImage());
  EXPECT_EQ(countDifferentPixels(program.draw(), before), 0U);
}

TEST(VolumeMapper, SaysThatMorePlanesThanSixCannotBeDrawn)
{
  Program program(bittenImage());
  vtkNew<vtkTest::ErrorObserver> errors;
  program.mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  for (int i = 0; i < 7; ++i)
  {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(0.0, 0.0, -100.0);
    program.mapper->AddClippingPlane(plane);
  }
  program.draw();
  EXPECT_TRUE(errors->GetError());
  EXPECT_TRUE(program.mapper->TakeError());
}

TEST(VolumeMapper, DrawsAgainInAnotherWindow)
{
  SceneContents contents = fullScene();
  Program program(bittenImage());
  program.mapper->SetContents(contents);
  const Picture first = program.draw();
  program.open();
  EXPECT_EQ(countDifferentPixels(program.draw(), first), 0U);
  program.mapper->ReleaseGraphicsResources(program.window);
  EXPECT_EQ(countDifferentPixels(program.draw(), first), 0U);
  EXPECT_EQ(program.mapper->GetStatistics().resources.count("labels.texture"), 1U);
}

TEST(VolumeMapper, DrawsInTwoWindowsInTurn)
{
  Program one(bittenImage());
  Program other(bittenImage());
  const Picture picture = one.draw();
  other.renderer->RemoveVolume(other.volume);
  other.renderer->AddVolume(one.volume);
  for (int turn = 0; turn < 2; ++turn)
  {
    EXPECT_EQ(countDifferentPixels(other.draw(), picture), 0U);
    EXPECT_EQ(countDifferentPixels(one.draw(), picture), 0U);
  }
  other.renderer->RemoveVolume(one.volume);
}

TEST(VolumeMapper, DrawsNothingWithoutAnImage)
{
  Program program(bittenImage());
  const Picture before = program.draw();
  program.mapper->SetInputData(static_cast<vtkImageData*>(nullptr));
  vtkObject::GlobalWarningDisplayOff(); // VTK's own warning about a mapper without input
  EXPECT_TRUE(isBackground(program.draw().pixel(kWidth / 2, kHeight / 2)));
  vtkObject::GlobalWarningDisplayOn();
  program.mapper->SetInputData(bittenImage());
  EXPECT_EQ(countDifferentPixels(program.draw(), before), 0U);
}
