#include "petrous/Rendering/ScenePicture.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkVolume.h>
#include <vtkWeakPointer.h>

#include "BoneColor.h"
#include "BoneVolume.h"
#include "StructureSurface.h"
#include "SurfaceActor.h"
#include "ToolProps.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{

constexpr int kLargestAxis = 2048; // what every OpenGL 4 driver takes as a 3D texture

void refuse(const std::string& what)
{
  throw RenderingError(RenderingError::Reason::BadContents, "picture: " + what);
}

void check(const SceneContents& contents)
{
  if (contents.ct)
  {
    const core::Index3& dims = contents.ct->geometry().dims();
    if (*std::max_element(dims.begin(), dims.end()) > kLargestAxis)
      refuse("the CT has " + std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
             std::to_string(dims[2]) + " voxels; at most " + std::to_string(kLargestAxis) +
             " along an axis can be drawn");
    if (contents.mask && !core::sameGrid(contents.mask->geometry(), contents.ct->geometry()))
      refuse("the mask does not lie on the CT's grid");
  }
  else if (contents.mask)
    refuse("there is a mask but no CT");
  for (const StructureContents& structure : contents.structures)
    if (!structure.labels || !structure.labels->voxels || structure.index == 0)
      refuse("structure " + structure.name + " has no label volume");
  for (const MeshContents& mesh : contents.meshes)
    if (!mesh.mesh)
      refuse("mesh " + mesh.name + " has no triangles");
}

struct MeshActor
{
  std::string name;
  std::shared_ptr<const core::TriangleMesh> mesh;
  std::size_t bytes = 0;
  SurfaceActor actor;

  MeshActor(const MeshContents& contents, int pattern)
    : name(contents.name)
    , mesh(contents.mesh)
    , actor(pattern)
  {
    mesh->validate();
    const auto surface = toPolyData(*mesh, vertexNormals(*mesh));
    bytes = static_cast<std::size_t>(surface->GetActualMemorySize()) * 1024;
    actor.setSurface(surface);
  }
};

struct NamedStructure
{
  std::string name;
  std::unique_ptr<StructureSurface> surface;
};

} // namespace

class ScenePicture::Implementation
{
public:
  Implementation();
  ~Implementation();

  void attach(vtkRenderer* renderer);
  void setStructures(const SceneContents& contents);
  void setMeshes(const SceneContents& contents);
  void applyCamera();

  vtkWeakPointer<vtkRenderer> renderer;
  core::CameraPose pose;
  std::shared_ptr<const volume::CutMask> mask;
  BoneVolume bone;
  std::vector<NamedStructure> structures;
  std::vector<std::unique_ptr<MeshActor>> meshes;
  ToolProps tool;

private:
  template <class Visit>
  void forEachProp(const Visit& visit);

  vtkNew<vtkLight> m_lamp;
  vtkNew<vtkCallbackCommand> m_onStart;
  unsigned long m_observer = 0;
};

ScenePicture::Implementation::Implementation()
{
  m_lamp->SetLightTypeToHeadlight();
  m_onStart->SetCallback(
      [](vtkObject* caller, unsigned long, void*, void*)
      {
        // Near and far follow the props, whoever moved the camera or them.
        static_cast<vtkRenderer*>(caller)->ResetCameraClippingRange();
      });
}

ScenePicture::Implementation::~Implementation()
{
  attach(nullptr);
}

template <class Visit>
void ScenePicture::Implementation::forEachProp(const Visit& visit)
{
  visit(bone.prop());
  for (const NamedStructure& structure : structures)
    visit(structure.surface->prop());
  for (const auto& mesh : meshes)
    visit(mesh->actor.prop());
}

void ScenePicture::Implementation::attach(vtkRenderer* next)
{
  if (renderer)
  {
    vtkRenderer* last = renderer;
    vtkRenderWindow* window = last->GetRenderWindow();
    const bool wasCurrent = window && window->IsCurrent();
    forEachProp(
        [last, window](vtkProp* prop)
        {
          last->RemoveViewProp(prop);
          if (window)
            prop->ReleaseGraphicsResources(window);
        });
    tool.removeFrom(last);
    last->RemoveLight(m_lamp);
    last->RemoveObserver(m_observer);
    if (window && !wasCurrent)
      window->ReleaseCurrent(); // which freeing the textures made current
  }
  renderer = next;
  if (!next)
    return;
  next->SetBackground(kBackground[0], kBackground[1], kBackground[2]);
  next->GradientBackgroundOff();
  next->AutomaticLightCreationOff();
  next->RemoveAllLights();
  next->AddLight(m_lamp);
  next->SetTwoSidedLighting(1);
  forEachProp([next](vtkProp* prop) { next->AddViewProp(prop); });
  tool.addTo(next);
  m_observer = next->AddObserver(vtkCommand::StartEvent, m_onStart);
  applyCamera();
}

void ScenePicture::Implementation::applyCamera()
{
  if (!renderer)
    return;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(pose.focalPoint.data());
  camera->SetPosition(pose.position.data());
  camera->SetViewUp(pose.viewUp.data());
  camera->SetUseHorizontalViewAngle(0);
  camera->SetViewAngle(pose.viewAngle);
  camera->SetParallelProjection(pose.parallelScale ? 1 : 0);
  if (pose.parallelScale)
    camera->SetParallelScale(*pose.parallelScale);
}

void ScenePicture::Implementation::setStructures(const SceneContents& contents)
{
  std::vector<NamedStructure> next;
  int pattern = 0;
  for (const StructureContents& wanted : contents.structures)
  {
    const auto found = std::find_if(structures.begin(), structures.end(),
                                    [&wanted](const NamedStructure& structure) {
                                      return structure.surface && structure.surface->shows(wanted);
                                    });
    NamedStructure entry;
    entry.name = wanted.name;
    if (found != structures.end())
      entry.surface = std::move(found->surface);
    else
    {
      entry.surface = std::make_unique<StructureSurface>(wanted, pattern);
      if (renderer)
        renderer->AddViewProp(entry.surface->prop());
    }
    ++pattern;
    const core::IndexBox everywhere =
        contents.ct ? contents.ct->geometry().fullBox() : core::IndexBox{};
    entry.surface->maskChanged(contents.mask, everywhere);
    entry.surface->setLook(wanted.look, contents.light);
    next.push_back(std::move(entry));
  }
  if (renderer)
    for (const NamedStructure& old : structures)
      if (old.surface)
        renderer->RemoveViewProp(old.surface->prop());
  structures = std::move(next);
}

void ScenePicture::Implementation::setMeshes(const SceneContents& contents)
{
  std::vector<std::unique_ptr<MeshActor>> next;
  int pattern = static_cast<int>(contents.structures.size());
  for (const MeshContents& wanted : contents.meshes)
  {
    const bool replaced = std::any_of(contents.structures.begin(), contents.structures.end(),
                                      [&wanted](const StructureContents& structure)
                                      { return structure.name == wanted.name; });
    if (replaced)
      continue;
    const auto found =
        std::find_if(meshes.begin(), meshes.end(),
                     [&wanted](const std::unique_ptr<MeshActor>& old)
                     { return old && old->mesh == wanted.mesh && old->name == wanted.name; });
    std::unique_ptr<MeshActor> actor;
    if (found != meshes.end())
      actor = std::move(*found);
    else
    {
      actor = std::make_unique<MeshActor>(wanted, pattern);
      if (renderer)
        renderer->AddViewProp(actor->actor.prop());
    }
    ++pattern;
    appearance::StructureLook look = wanted.look;
    actor->actor.setLook(look, contents.light);
    next.push_back(std::move(actor));
  }
  if (renderer)
    for (const auto& old : meshes)
      if (old)
        renderer->RemoveViewProp(old->actor.prop());
  meshes = std::move(next);
}

ScenePicture::ScenePicture()
  : m_implementation(std::make_unique<Implementation>())
{
}

ScenePicture::~ScenePicture() = default;

void ScenePicture::attach(vtkRenderer* renderer)
{
  if (m_implementation->renderer)
    m_implementation->pose = camera();
  m_implementation->attach(renderer);
}

vtkRenderer* ScenePicture::renderer() const
{
  return m_implementation->renderer;
}

void ScenePicture::setContents(const SceneContents& contents)
{
  check(contents);
  m_implementation->mask = contents.mask;
  m_implementation->bone.setContents(contents.ct, contents.iso, contents.mask, contents.light);
  m_implementation->setStructures(contents);
  m_implementation->setMeshes(contents);
  m_implementation->tool.setPose(contents.tool);
}

void ScenePicture::maskChanged(std::shared_ptr<const volume::CutMask> mask,
                               const core::IndexBox& box)
{
  m_implementation->bone.maskChanged(mask, box);
  for (const NamedStructure& structure : m_implementation->structures)
    structure.surface->maskChanged(mask, box);
  m_implementation->mask = std::move(mask);
}

void ScenePicture::setTool(const std::optional<ToolPose>& tool)
{
  m_implementation->tool.setPose(tool);
}

void ScenePicture::setCamera(const core::CameraPose& pose)
{
  m_implementation->pose = pose;
  m_implementation->applyCamera();
}

core::CameraPose ScenePicture::camera() const
{
  core::CameraPose pose = m_implementation->pose;
  if (!m_implementation->renderer)
    return pose;
  vtkCamera* camera = m_implementation->renderer->GetActiveCamera();
  camera->GetPosition(pose.position.data());
  camera->GetFocalPoint(pose.focalPoint.data());
  camera->GetViewUp(pose.viewUp.data());
  pose.viewAngle = camera->GetViewAngle();
  pose.parallelScale.reset();
  if (camera->GetParallelProjection())
    pose.parallelScale = camera->GetParallelScale();
  return pose;
}

void ScenePicture::setInteractive(bool interactive)
{
  m_implementation->bone.setInteractive(interactive);
}

std::map<std::string, std::size_t> ScenePicture::resources() const
{
  std::map<std::string, std::size_t> resources;
  m_implementation->bone.addResources(resources);
  for (const NamedStructure& structure : m_implementation->structures)
    if (const std::size_t bytes = structure.surface->bytes())
      resources["labels." + structure.name] = bytes;
  for (const auto& mesh : m_implementation->meshes)
    resources["meshes." + mesh->name] = mesh->bytes;
  return resources;
}

} // namespace petrous::rendering
