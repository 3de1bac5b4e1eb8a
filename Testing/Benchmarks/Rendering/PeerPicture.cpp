#include "PeerPicture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiVolume.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSmartVolumeMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkWeakPointer.h>

#include "OpticalModel.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/VtkVolume.h"

namespace petrous::rendering
{

namespace
{

constexpr int kRemoved = 255; // label of removed tissue

// Bone below the iso value is invisible; the ramp is one step of the gradient across a voxel.
constexpr double kRamp = 100.0; // HU

struct Tables
{
  vtkNew<vtkColorTransferFunction> color;
  vtkNew<vtkPiecewiseFunction> opacity;

  Tables(const appearance::Material& material, double below)
  {
    for (const PeerControlPoint& point : peerTable(material, below))
    {
      color->AddRGBPoint(point.value, point.color[0], point.color[1], point.color[2]);
      opacity->AddPoint(point.value, point.opacity);
    }
  }

  // The whole function, as finely as the mappers tabulate it over 12 bits.
  explicit Tables(const appearance::TransferFunction& transfer)
  {
    constexpr double step = 4.0; // HU
    const double last = transfer.points().back().value;
    for (double value = transfer.points().front().value; value < last + step; value += step)
    {
      const auto optics = transfer.at(value);
      color->AddRGBPoint(value, optics.color[0], optics.color[1], optics.color[2]);
      opacity->AddPoint(value, -std::expm1(-optics.extinction)); // per 1 mm
    }
  }
};

// Axis-aligned voxels with the orientation in the prop: these mappers ignore image directions.
vtkSmartPointer<vtkImageData> upright(vtkSmartPointer<vtkImageData> image)
{
  image->SetOrigin(0.0, 0.0, 0.0);
  image->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
  return image;
}

vtkSmartPointer<vtkMatrix4x4> poseOf(const core::GridGeometry& grid)
{
  auto pose = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      pose->SetElement(row, column, grid.direction()(row, column));
    pose->SetElement(row, 3, grid.origin()[row]);
  }
  return pose;
}

// One label per CT voxel: the structure at the voxel, or kRemoved if it was cut away.
vtkSmartPointer<vtkImageData> labelMask(const SceneContents& contents, vtkImageData* like)
{
  const core::GridGeometry& grid = contents.ct->geometry();
  auto mask = vtkSmartPointer<vtkImageData>::New();
  mask->CopyStructure(like);
  mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* out = static_cast<std::uint8_t*>(mask->GetScalarPointer());
  const auto& index = *contents.labels->index;
  const auto& share = *contents.labels->occupancy;
  const auto labelAt = [&](int i, int j, int k) -> std::uint8_t
  {
    if (contents.mask && contents.mask->at(i, j, k) < volume::CutMask::kUntouched / 2)
      return kRemoved;
    const Eigen::Vector3d voxel =
        index.geometry().voxelFromPatient(grid.patientFromVoxel(Eigen::Vector3d(i, j, k)));
    const Eigen::Vector3i nearest = voxel.array().round().cast<int>();
    const core::Index3 at{nearest[0], nearest[1], nearest[2]};
    if (!index.geometry().fullBox().contains(at))
      return 0;
    return share.at(at[0], at[1], at[2]) > 0.5F ? index.at(at[0], at[1], at[2]) : std::uint8_t{0};
  };
  const core::Index3& n = grid.dims();
  tbb::parallel_for(0, n[2],
                    [&](int k)
                    {
                      for (int j = 0; j < n[1]; ++j)
                        for (int i = 0; i < n[0]; ++i)
                          out[grid.linearIndex(i, j, k)] = labelAt(i, j, k);
                    });
  return mask;
}

[[noreturn]] void refuse(const std::string& what)
{
  throw RenderingError(RenderingError::Reason::BadContents, "peer picture: " + what);
}

} // namespace

std::string nameOf(Peer peer)
{
  switch (peer)
  {
  case Peer::GpuComposite:
    return "VTK GPU mapper, composite shaded";
  case Peer::GpuLabelMap:
    return "VTK GPU mapper, label map";
  case Peer::GpuMulti:
    return "VTK multi-volume, 2 volumes";
  case Peer::SmartGpu:
    return "VTK smart mapper, GPU";
  case Peer::SmartCpu:
    return "VTK smart mapper, CPU";
  case Peer::CpuFixedPoint:
    break;
  }
  return "VTK fixed point (CPU)";
}

double lampTilt()
{
  return optics::kLampTilt;
}

std::vector<PeerControlPoint> peerTable(const appearance::Material& material, double below)
{
  const auto& transfer = material.transfer;
  const auto at = [&](double value) -> PeerControlPoint
  {
    const auto optics = transfer.at(value);
    return {value, optics.color,
            material.surfaceOpacity < 1.0F ? -std::expm1(-optics.extinction) : 1.0};
  };
  std::vector<PeerControlPoint> table{at(below), at(below)};
  table.front().value = below - kRamp;
  table.front().opacity = 0.0;
  for (const auto& point : transfer.points())
    if (point.value > below)
      table.push_back(at(point.value));
  return table;
}

class PeerPicture::Implementation
{
public:
  Implementation(Peer peer, const SceneContents& scene, const core::CameraPose& pose);
  void drawSoftTissue(bool isOnGpu, vtkImageData* image);
  void applyCamera();
  void setProperty(vtkVolumeProperty* property, const appearance::Material& material, double below);
  void shade(vtkVolumeProperty* property) const;
  void addLabels();
  void addUnion();

  SceneContents contents;
  core::CameraPose camera;
  vtkNew<vtkVolume> bone;
  vtkSmartPointer<vtkGPUVolumeRayCastMapper> gpu;
  vtkSmartPointer<vtkSmartVolumeMapper> smart;
  vtkSmartPointer<vtkMultiVolume> multi;
  vtkNew<vtkLight> lamp;
  vtkWeakPointer<vtkRenderer> renderer;
};

PeerPicture::Implementation::Implementation(Peer peer, const SceneContents& scene,
                                            const core::CameraPose& pose)
  : contents(scene)
  , camera(pose)
{
  if (!contents.ct)
    refuse("no CT");
  const bool isSmart = peer == Peer::SmartGpu || peer == Peer::SmartCpu;
  if (contents.materials.empty() && !isSmart)
    refuse("no material of bone");
  if ((peer == Peer::GpuLabelMap || peer == Peer::GpuMulti) && !contents.labels)
    refuse("no labels");
  const core::GridGeometry& grid = contents.ct->geometry();
  const auto step = static_cast<float>(kStep * grid.minSpacing());
  const auto image = upright(wrap(*contents.ct));
  bone->SetUserMatrix(poseOf(grid));
  lamp->SetLightTypeToHeadlight();
  if (isSmart)
  {
    drawSoftTissue(peer == Peer::SmartGpu, image);
    return;
  }
  setProperty(bone->GetProperty(), contents.materials.front(), contents.iso);
  if (peer == Peer::CpuFixedPoint)
  {
    vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
    mapper->SetInputData(image);
    mapper->SetAutoAdjustSampleDistances(0);
    mapper->SetSampleDistance(step);
    mapper->SetInteractiveSampleDistance(step);
    mapper->SetImageSampleDistance(1.0F);
    bone->SetMapper(mapper);
    return;
  }
  gpu = vtkSmartPointer<vtkGPUVolumeRayCastMapper>::New();
  gpu->SetInputData(image);
  gpu->SetBlendModeToComposite();
  gpu->SetAutoAdjustSampleDistances(0);
  gpu->SetLockSampleDistanceToInputSpacing(0);
  gpu->SetUseJittering(0);
  gpu->SetSampleDistance(step);
  gpu->SetImageSampleDistance(1.0F);
  gpu->SetReportProgress(false);
  if (peer == Peer::GpuLabelMap)
  {
    gpu->SetMaskInput(labelMask(contents, image));
    gpu->SetMaskTypeToLabelMap();
    addLabels();
  }
  if (peer == Peer::GpuMulti)
    addUnion();
  else
    bone->SetMapper(gpu);
}

void PeerPicture::Implementation::drawSoftTissue(bool isOnGpu, vtkImageData* image)
{
  if (!contents.softTissue)
    refuse("no soft tissue");
  const Tables tables(contents.softTissue->transfer);
  vtkVolumeProperty* property = bone->GetProperty();
  property->SetColor(tables.color);
  property->SetScalarOpacity(tables.opacity);
  property->SetScalarOpacityUnitDistance(1.0);
  property->SetInterpolationTypeToLinear();
  if (contents.light.ambient < 1.0)
    shade(property);
  else
    property->ShadeOff();
  smart = vtkSmartPointer<vtkSmartVolumeMapper>::New();
  smart->SetInputData(image);
  smart->SetBlendModeToComposite();
  if (isOnGpu)
    smart->SetRequestedRenderModeToGPU();
  else
    smart->SetRequestedRenderModeToRayCast();
  bone->SetMapper(smart);
}

void PeerPicture::Implementation::setProperty(vtkVolumeProperty* property,
                                              const appearance::Material& material, double below)
{
  const Tables tables(material, below);
  property->SetColor(tables.color);
  property->SetScalarOpacity(tables.opacity);
  property->SetScalarOpacityUnitDistance(1.0);
  property->SetInterpolationTypeToLinear();
  shade(property);
}

void PeerPicture::Implementation::shade(vtkVolumeProperty* property) const
{
  property->ShadeOn();
  property->SetAmbient(contents.light.ambient);
  property->SetDiffuse(1.0 - contents.light.ambient);
  property->SetSpecular(contents.light.specular);
  property->SetSpecularPower(contents.light.shininess);
}

void PeerPicture::Implementation::addLabels()
{
  vtkVolumeProperty* property = bone->GetProperty();
  for (std::size_t i = 1; i < contents.materials.size() && i < kRemoved; ++i)
  {
    // A structure is visible at any intensity.
    const Tables tables(contents.materials[i], -std::numeric_limits<short>::max());
    property->SetLabelColor(static_cast<int>(i), tables.color);
    property->SetLabelScalarOpacity(static_cast<int>(i), tables.opacity);
  }
  vtkNew<vtkColorTransferFunction> black;
  black->AddRGBPoint(0.0, 0.0, 0.0, 0.0);
  vtkNew<vtkPiecewiseFunction> nothing;
  nothing->AddPoint(0.0, 0.0);
  property->SetLabelColor(kRemoved, black);
  property->SetLabelScalarOpacity(kRemoved, nothing);
}

void PeerPicture::Implementation::addUnion()
{
  const core::GridGeometry& grid = contents.labels->occupancy->geometry();
  gpu->SetInputDataObject(1, upright(wrap<float>(contents.labels->occupancy)));
  vtkNew<vtkVolume> structures;
  structures->SetUserMatrix(poseOf(grid));
  setProperty(structures->GetProperty(), contents.materials.back(), 0.5);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.45, 0.0);
  opacity->AddPoint(0.55, 1.0);
  structures->GetProperty()->SetScalarOpacity(opacity);
  multi = vtkSmartPointer<vtkMultiVolume>::New();
  multi->SetVolume(bone, 0);
  multi->SetVolume(structures, 1);
  multi->SetMapper(gpu);
}

void PeerPicture::Implementation::applyCamera()
{
  vtkCamera* view = renderer->GetActiveCamera();
  view->SetFocalPoint(camera.focalPoint.data());
  view->SetPosition(camera.position.data());
  view->SetViewUp(camera.viewUp.data());
  view->SetViewAngle(camera.viewAngle);
  renderer->ResetCameraClippingRange();
}

PeerPicture::PeerPicture(Peer peer, const SceneContents& contents, const core::CameraPose& camera)
  : m_implementation(std::make_unique<Implementation>(peer, contents, camera))
{
}

PeerPicture::~PeerPicture() = default;

void PeerPicture::attach(vtkRenderer* renderer)
{
  auto& my = *m_implementation;
  renderer->SetBackground(optics::kBackground[0], optics::kBackground[1], optics::kBackground[2]);
  renderer->AutomaticLightCreationOff();
  renderer->AddLight(my.lamp);
  vtkVolume* prop = my.bone;
  if (my.multi)
    prop = my.multi;
  renderer->AddViewProp(prop);
  my.renderer = renderer;
  my.applyCamera();
}

void PeerPicture::setCamera(const core::CameraPose& camera)
{
  m_implementation->camera = camera;
  if (m_implementation->renderer)
    m_implementation->applyCamera();
}

void PeerPicture::setUpdateRate(double hertz)
{
  if (vtkRenderer* renderer = m_implementation->renderer)
    renderer->GetRenderWindow()->SetDesiredUpdateRate(hertz);
}

} // namespace petrous::rendering
