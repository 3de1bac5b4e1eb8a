#include "OwnPicture.h"

#include <utility>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkVolume.h>
#include <vtkWeakPointer.h>

#include "OpticalModel.h"
#include "petrous/Rendering/VolumeMapper.h"

namespace petrous::rendering
{

class OwnPicture::Implementation
{
public:
  vtkNew<vtkPetrousVolumeMapper> mapper;
  vtkNew<vtkVolume> prop;
  vtkWeakPointer<vtkRenderer> renderer;
  core::CameraPose camera;
};

OwnPicture::OwnPicture(const SceneContents& contents, const core::CameraPose& camera)
  : m_implementation(std::make_unique<Implementation>())
{
  auto& my = *m_implementation;
  my.camera = camera;
  my.mapper->SetContents(contents);
  my.prop->SetMapper(my.mapper);
}

OwnPicture::~OwnPicture() = default;

void OwnPicture::attach(vtkRenderer* renderer)
{
  auto& my = *m_implementation;
  my.renderer = renderer;
  renderer->SetBackground(optics::kBackground[0], optics::kBackground[1], optics::kBackground[2]);
  renderer->AddViewProp(my.prop);
  setCamera(my.camera);
}

void OwnPicture::setCamera(const core::CameraPose& camera)
{
  auto& my = *m_implementation;
  my.camera = camera;
  if (!my.renderer)
    return;
  vtkCamera* view = my.renderer->GetActiveCamera();
  view->SetFocalPoint(camera.focalPoint.data());
  view->SetPosition(camera.position.data());
  view->SetViewUp(camera.viewUp.data());
  view->SetViewAngle(camera.viewAngle);
  my.renderer->ResetCameraClippingRange();
}

void OwnPicture::setQuality(const RenderQuality& quality)
{
  m_implementation->mapper->SetQuality(quality);
}

void OwnPicture::setCounting(bool counting)
{
  m_implementation->mapper->SetCounting(counting);
}

void OwnPicture::maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box)
{
  m_implementation->mapper->MaskChanged(std::move(mask), box);
}

const RenderStatistics& OwnPicture::statistics() const
{
  return m_implementation->mapper->GetStatistics();
}

DepthImage OwnPicture::depth() const
{
  return m_implementation->mapper->GetDepth();
}

} // namespace petrous::rendering
