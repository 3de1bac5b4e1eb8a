#include "petrous/Rendering/ScenePicture.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCullerCollection.h>
#include <vtkLight.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkVolume.h>
#include <vtkWeakPointer.h>
#include <vtk_glew.h>

#include "CameraPlacement.h"
#include "DrilledMesh.h"
#include "MeshCaps.h"
#include "OpticalModel.h"
#include "SceneCheck.h"
#include "SurfaceActor.h"
#include "petrous/Rendering/ClippedRegion.h"
#include "petrous/Rendering/PixelSamples.h"
#include "petrous/Rendering/ReferenceRayCaster.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/ToolProps.h"
#include "petrous/Rendering/ToolShape.h"
#include "petrous/Rendering/VolumeMapper.h"
#include "petrous/Volume/MeshInside.h"

namespace petrous::rendering
{

/// GPU time of frames, measured without stalling: timestamp queries before and after a frame's
/// commands, read when a later frame begins. A frame that begins while its predecessor is still
/// pending is not timed. With a software renderer the timer waits for completion: it runs on the
/// CPU anyway, and its timestamps only mark the start of the last tile.
class FrameTimer
{
public:
  struct Frame
  {
    double milliseconds = 0.0;
    double work = 0.0; ///< InteractionQuality::workOf the frame; 0: not to be learnt from
  };

  /// All calls need the same context current.
  void begin();
  void end(double work);
  bool holdsQueries() const noexcept { return m_queries[Begin] != 0; }
  void release(); ///< call before the context is destroyed or replaced

  /// A newly measured frame, once.
  std::optional<Frame> take();

private:
  enum Mark : std::size_t
  {
    Begin,
    End,
    MarkCount
  };
  void read();

  std::optional<bool> m_software;
  std::array<unsigned, MarkCount> m_queries{}; // 0: none
  bool m_pending = false;                      // both stamped, not yet read
  bool m_open = false;                         // the first is stamped
  std::chrono::steady_clock::time_point m_begun;
  double m_work = 0.0; // of the pending frame
  std::optional<Frame> m_known;
};

namespace
{

bool waitsForFrames()
{
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string renderer = name ? name : "";
  for (const char* software : {"llvmpipe", "softpipe", "SWR", "Software"})
    if (renderer.find(software) != std::string::npos)
      return true;
  return !GLEW_ARB_timer_query;
}

} // namespace

void FrameTimer::begin()
{
  if (!m_software)
    m_software = waitsForFrames();
  m_begun = std::chrono::steady_clock::now();
  if (*m_software)
    return;
  read();
  m_open = !m_pending;
  if (!m_open)
    return;
  if (m_queries[Begin] == 0)
    glGenQueries(MarkCount, m_queries.data());
  glQueryCounter(m_queries[Begin], GL_TIMESTAMP);
}

void FrameTimer::end(double work)
{
  if (m_software.value_or(true))
  {
    glFinish();
    m_known =
        Frame{std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - m_begun)
                  .count(),
              work};
    return;
  }
  if (!m_open)
    return;
  glQueryCounter(m_queries[End], GL_TIMESTAMP);
  m_work = work;
  m_open = false;
  m_pending = true;
}

void FrameTimer::read()
{
  if (!m_pending)
    return;
  GLint done = 0;
  glGetQueryObjectiv(m_queries[End], GL_QUERY_RESULT_AVAILABLE, &done);
  if (done == 0)
    return;
  GLuint64 begun = 0;
  GLuint64 ended = 0;
  glGetQueryObjectui64v(m_queries[Begin], GL_QUERY_RESULT, &begun);
  glGetQueryObjectui64v(m_queries[End], GL_QUERY_RESULT, &ended);
  m_pending = false;
  if (ended > begun) // the clock may have wrapped around
    m_known = Frame{1e-6 * static_cast<double>(ended - begun), m_work};
}

void FrameTimer::release()
{
  if (m_queries[Begin] != 0)
    glDeleteQueries(MarkCount, m_queries.data());
  *this = FrameTimer();
}

std::optional<FrameTimer::Frame> FrameTimer::take()
{
  std::optional<Frame> frame;
  frame.swap(m_known);
  return frame;
}

namespace
{

void check(const SceneContents& contents)
{
  checkContents(contents);
  checkPlaneCount(contents);
  for (const MeshContents& mesh : contents.meshes)
  {
    if (!mesh.mesh)
      throw RenderingError(RenderingError::Reason::BadContents,
                           "picture: mesh " + mesh.name + " has no triangles");
    mesh.mesh->validate();
  }
}

// In the plane through a point, parallel to the picture; NaN behind the camera.
double millimetresPerPixelAt(const Eigen::Vector3d& point, const core::CameraPose& camera,
                             int height)
{
  constexpr double kHalfDegree = 3.14159265358979323846 / 360.0;
  if (camera.parallelScale)
    return 2.0 * *camera.parallelScale / height;
  const double depth =
      (camera.focalPoint - camera.position).normalized().dot(point - camera.position);
  return depth > 0.0 ? 2.0 * depth * std::tan(camera.viewAngle * kHalfDegree) / height
                     : std::numeric_limits<double>::quiet_NaN();
}

// The planes at which meshes are cut: in front of those of the volume by what the depth buffer may
// round, so that a mesh's cap hides the tissue around it and not the other way round.
std::vector<ClippingPlane> meshCuts(const SceneContents& contents)
{
  constexpr double kAhead = 0.01; // mm
  std::vector<ClippingPlane> cuts = cutsOf(contents);
  for (ClippingPlane& cut : cuts)
    cut.point -= kAhead * cut.normal;
  return cuts;
}

bool areTheSame(const std::vector<ClippingPlane>& some, const std::vector<ClippingPlane>& others)
{
  return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                    [](const ClippingPlane& a, const ClippingPlane& b)
                    { return a.point == b.point && a.normal == b.normal; });
}

// A mesh as drill, crop box and clipping planes leave it.
class MeshActor
{
public:
  MeshActor(const MeshContents& contents, int pattern, const ProgramSetter& shadows)
    : m_name(contents.name)
    , m_mesh(contents.mesh)
    , m_surface(pattern, shadows)
    , m_caps(pattern, shadows)
  {
    show({*m_mesh, vertexNormals(*m_mesh)}, {});
  }

  bool shows(const MeshContents& wanted) const
  {
    return m_mesh == wanted.mesh && m_name == wanted.name;
  }

  const std::string& name() const noexcept { return m_name; }
  std::size_t bytes() const noexcept { return m_bytes; }
  std::array<vtkActor*, 2> props() const { return {m_surface.prop(), m_caps.prop()}; }

  void setLook(const appearance::StructureAppearance& look, const SceneContents& contents)
  {
    m_surface.setLook(look, contents.light);
    if (contents.section)
      m_caps.setPlainLook(look);
    else
      m_caps.setLook(look, contents.light);
  }

  void setMask(std::shared_ptr<const volume::CutMask> next)
  {
    m_isOld = m_isOld || next != m_mask;
    m_mask = std::move(next);
  }

  /// The mask's voxels of a box changed.
  void cut(const std::shared_ptr<const volume::CutMask>& next, const core::IndexBox& box)
  {
    if (!m_isDrilled)
      return;
    m_isOld = m_isOld || !next || !reach(*next).intersected(box).empty();
    m_mask = next;
  }

  void setDrilled(bool isDrilled)
  {
    m_isOld = m_isOld || isDrilled != m_isDrilled;
    m_isDrilled = isDrilled;
  }

  void setCuts(const std::vector<ClippingPlane>& cuts)
  {
    m_isOld = m_isOld || !areTheSame(cuts, m_cuts);
    m_cuts = cuts;
  }

  /// Before a frame. `sparing`: not if it took a large part of the time since it was last done.
  void update(bool sparing)
  {
    using Clock = std::chrono::steady_clock;
    constexpr int kShare = 5;
    if (!m_isOld || (sparing && Clock::now() - m_done < kShare * m_took))
      return;
    m_isOld = false;
    const bool mayBeDrilled = m_isDrilled && m_mask && !m_mask->untouched(reach(*m_mask));
    std::vector<ClippingPlane> planes;
    std::copy_if(m_cuts.begin(), m_cuts.end(), std::back_inserter(planes),
                 [this](const ClippingPlane& plane) { return meets(*m_mesh, plane); });
    if (!mayBeDrilled && planes.empty() && !m_isChanged)
      return;
    const auto start = Clock::now();
    std::optional<ShadedMesh> left;
    if (mayBeDrilled && !m_shape)
      m_shape.emplace(m_mesh);
    if (mayBeDrilled)
      left = m_shape->surface(*m_mask);
    m_isChanged = left.has_value() || !planes.empty();
    const bool isDrilled = left.has_value();
    if (!left)
      left = ShadedMesh{*m_mesh, vertexNormals(*m_mesh)};
    if (planes.empty())
      show(*left, {});
    else
      show(keptBy(std::move(*left), planes), caps(planes, isDrilled));
    m_done = Clock::now();
    m_took = m_done - start;
  }

private:
  // Voxels that can cut it.
  core::IndexBox reach(const volume::CutMask& mask) const
  {
    return mask.geometry().boxCovering(m_bounds[0].cast<double>(), m_bounds[1].cast<double>());
  }

  ShadedMesh caps(const std::vector<ClippingPlane>& planes, bool isDrilled)
  {
    if (!m_inside)
      m_inside.emplace(*m_mesh);
    if (m_inside->openEdges() > 0)
      return {};
    ShadedMesh whole = capsOf(*m_mesh, planes, m_inside->facesAlike());
    return isDrilled ? leftOf(whole.mesh, *m_mask) : whole;
  }

  void show(const ShadedMesh& surface, const ShadedMesh& caps)
  {
    m_bytes = 0;
    const auto set = [this](const ShadedMesh& shape, SurfaceActor& actor)
    {
      const auto polygons = toPolyData(shape.mesh, shape.normals);
      m_bytes += static_cast<std::size_t>(polygons->GetActualMemorySize()) * 1024;
      actor.setSurface(polygons);
    };
    set(surface, m_surface);
    set(caps, m_caps);
  }

  std::string m_name;
  std::shared_ptr<const core::TriangleMesh> m_mesh;
  std::size_t m_bytes = 0;
  SurfaceActor m_surface;
  SurfaceActor m_caps;                                        // of a closed mesh, in the cuts
  std::array<Eigen::Vector3f, 2> m_bounds = m_mesh->bounds(); // patient LPS mm
  std::shared_ptr<const volume::CutMask> m_mask;              // null: nothing drilled
  std::vector<ClippingPlane> m_cuts;
  std::optional<DrilledMesh> m_shape;
  std::optional<volume::MeshInside> m_inside;
  bool m_isDrilled = false;
  bool m_isOld = false;     // what is shown
  bool m_isChanged = false; // likewise: it is not the whole mesh
  std::chrono::steady_clock::time_point m_done;
  std::chrono::steady_clock::duration m_took{};
};

} // namespace

class ScenePicture::Implementation
{
public:
  Implementation();
  ~Implementation();

  void attach(vtkRenderer* renderer);
  void setMeshes(const SceneContents& contents);
  void setVolume(const SceneContents& contents);
  void setBackground(const BackgroundColor& color);
  void applyCamera();
  void startFrame();
  void endFrame();
  void coarsen();

  vtkWeakPointer<vtkRenderer> renderer;
  core::CameraPose pose;
  std::optional<PictureTile> tile;
  std::shared_ptr<const volume::LabelField> labels; // whose indices were checked to have materials
  std::size_t materials = 0;
  vtkNew<vtkPetrousVolumeMapper> mapper;
  vtkNew<vtkVolume> volume;
  RenderQuality quality;
  RenderQuality drawn; // of the last frame
  InteractionQuality interaction;
  bool interactive = false;
  bool progressive = false;
  bool isNew = false; // contents that no frame has shown: uploads and shaders take its time
  std::optional<InteractionQuality::Foveated> foveated; // of the last frame
  std::optional<ToolPose> toolPose;
  double milliseconds = 0.0; // of the latest frame with a known time
  std::vector<std::unique_ptr<MeshActor>> meshes;
  ToolProps tool;
  BackgroundColor background = kDefaultBackground;

private:
  template <class Visit>
  void forEachProp(const Visit& visit);
  ProgramSetter shadowsOn(bool isTool);

  vtkNew<vtkLight> m_lamp;
  double m_falloff = 0.0; // mm
  vtkNew<vtkCallbackCommand> m_onStart;
  vtkNew<vtkCallbackCommand> m_onEnd;
  unsigned long m_startObserver = 0;
  unsigned long m_endObserver = 0;
  FrameTimer m_timer;
};

ScenePicture::Implementation::Implementation()
{
  m_lamp->SetLightTypeToCameraLight(); // at the camera
  m_lamp->SetConeAngle(180.0);         // omnidirectional
  m_onStart->SetClientData(this);
  m_onStart->SetCallback([](vtkObject*, unsigned long, void* self, void*)
                         { static_cast<Implementation*>(self)->startFrame(); });
  m_onEnd->SetClientData(this);
  m_onEnd->SetCallback([](vtkObject*, unsigned long, void* self, void*)
                       { static_cast<Implementation*>(self)->endFrame(); });
  volume->SetMapper(mapper);
  volume->PickableOff();
  tool.followShadows(shadowsOn(true));
}

// For polygons; while it is attached.
ProgramSetter ScenePicture::Implementation::shadowsOn(bool isTool)
{
  return [this, isTool](GlUniforms& program)
  {
    if (renderer)
      mapper->ShadePolygons(renderer, volume, program, isTool);
  };
}

void ScenePicture::Implementation::startFrame()
{
  for (const auto& mesh : meshes)
    mesh->update(interactive);
  // The clipping range follows the props, whoever moved them, cut them or moved the camera.
  renderer->ResetCameraClippingRange();
  if (tile)
    aimAtTile(renderer, pose, *tile);
  else
    shiftLens(renderer, pose);
  core::CameraPose lampCamera = poseOf(renderer->GetActiveCamera()); // not yet that of an eye
  lampCamera.head = pose.head;
  mapper->SetLampCamera(lampCamera);
  mapper->SetSample(tile ? tile->sample : -1);
  LightSettings light;
  light.falloff = m_falloff;
  const double atLamp = optics::lightAt(light, 0.0, optics::lampOf(lampCamera).focus);
  m_lamp->SetAttenuationValues(1.0 / atLamp, 0.0,
                               m_falloff > 0.0 ? 1.0 / (atLamp * m_falloff * m_falloff) : 0.0);
  foveated.reset();
  drawn = quality;
  if (interactive || progressive)
    coarsen();
  mapper->SetQuality(drawn);
  mapper->SetRestQuality(progressive ? std::optional(quality) : std::nullopt);
  // The light is at the camera, as in the ray caster; a parallel projection has no such position.
  m_lamp->SetPositional(renderer->GetActiveCamera()->GetParallelProjection() ? 0 : 1);
  m_timer.begin();
  mapper->PrepareShadows(renderer, volume);
}

void ScenePicture::Implementation::coarsen()
{
  drawn = interaction.coarser(quality);
  if (!progressive)
    return;
  if (!interaction.knows()) // nor whether the machine bears half of the picture
    drawn.imageScale = std::min(quality.imageScale, InteractionQuality::kSmallestScale);
  std::optional<vtkPetrousVolumeMapper::Fovea> fovea;
  if (toolPose && tool::isShown(*toolPose))
  {
    const int* size = renderer->GetSize();
    const double radius = toolPose->radius + tool::kField;
    const double pixels = radius / millimetresPerPixelAt(toolPose->center, pose, size[1]);
    constexpr double kPi = 3.14159265358979323846;
    const double area = kPi * pixels * pixels / (static_cast<double>(size[0]) * size[1]);
    foveated = interaction.foveated(quality, area);
    if (foveated)
    {
      drawn = foveated->rest;
      fovea.emplace();
      fovea->center = toolPose->center;
      fovea->radius = radius * std::sqrt(foveated->area / area);
      fovea->quality = foveated->fovea;
    }
  }
  mapper->SetFovea(fovea);
}

void ScenePicture::Implementation::endFrame()
{
  const bool isRest = mapper->GetRestSamples() > 0;
  // In a window the first frame of a scene tells little.
  const bool tells = !isRest && !(progressive && isNew);
  m_timer.end(!tells     ? 0.0
              : foveated ? InteractionQuality::workOf(*foveated)
                         : InteractionQuality::workOf(drawn));
  isNew = false;
  // Also at rest, so that the first interactive frame is not slower than the others.
  if (const auto frame = m_timer.take())
  {
    milliseconds = frame->milliseconds;
    interaction.frameTook(frame->milliseconds, frame->work);
  }
  if (isRest)
    milliseconds = mapper->GetRestMilliseconds();
}

void ScenePicture::Implementation::setVolume(const SceneContents& contents)
{
  if (contents.labels && (contents.labels != labels || contents.materials.size() != materials))
    checkMaterials(contents);
  labels = contents.labels;
  materials = contents.materials.size();
  m_falloff = contents.light.falloff;
  mapper->SetContents(contents);
  isNew = true;
  volume->SetVisibility(mapper->GetTotalNumberOfInputConnections() > 0 ? 1 : 0);
}

ScenePicture::Implementation::~Implementation()
{
  attach(nullptr);
}

template <class Visit>
void ScenePicture::Implementation::forEachProp(const Visit& visit)
{
  visit(volume);
  for (const auto& mesh : meshes)
    for (vtkActor* prop : mesh->props())
      visit(prop);
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
    if (window && m_timer.holdsQueries())
    {
      window->MakeCurrent();
      m_timer.release();
    }
    m_timer = FrameTimer(); // the next context may use another driver
    tool.removeFrom(last);
    last->RemoveLight(m_lamp);
    last->RemoveObserver(m_startObserver);
    last->RemoveObserver(m_endObserver);
    if (window && !wasCurrent)
      window->ReleaseCurrent(); // made current by releasing the textures
  }
  renderer = next;
  if (!next)
    return;
  setBackground(background);
  next->GradientBackgroundOff();
  next->AutomaticLightCreationOff();
  next->RemoveAllLights();
  next->AddLight(m_lamp);
  next->SetTwoSidedLighting(1);
  // A culled volume must still be drawn; otherwise its depth would be that of an earlier frame.
  next->GetCullers()->RemoveAllItems();
  forEachProp([next](vtkProp* prop) { next->AddViewProp(prop); });
  tool.addTo(next);
  m_startObserver = next->AddObserver(vtkCommand::StartEvent, m_onStart);
  m_endObserver = next->AddObserver(vtkCommand::EndEvent, m_onEnd);
  applyCamera();
}

void ScenePicture::Implementation::setBackground(const BackgroundColor& color)
{
  background = color;
  if (renderer)
    renderer->SetBackground(color[0], color[1], color[2]);
}

void ScenePicture::Implementation::applyCamera()
{
  if (!renderer)
    return;
  aimCamera(renderer->GetActiveCamera(), pose);
}

void ScenePicture::Implementation::setMeshes(const SceneContents& contents)
{
  std::vector<std::unique_ptr<MeshActor>> next;
  const std::vector<ClippingPlane> cuts = meshCuts(contents);
  int pattern = 0;
  for (const MeshContents& wanted : contents.meshes)
  {
    const auto found = std::find_if(meshes.begin(), meshes.end(),
                                    [&wanted](const std::unique_ptr<MeshActor>& old)
                                    { return old && old->shows(wanted); });
    std::unique_ptr<MeshActor> actor;
    if (found != meshes.end())
      actor = std::move(*found);
    else
    {
      actor = std::make_unique<MeshActor>(wanted, pattern, shadowsOn(false));
      if (renderer)
        for (vtkActor* prop : actor->props())
          renderer->AddViewProp(prop);
    }
    ++pattern;
    actor->setLook(wanted.look, contents);
    actor->setDrilled(wanted.drilled);
    actor->setCuts(cuts);
    actor->setMask(contents.mask);
    next.push_back(std::move(actor));
  }
  if (renderer)
    for (const auto& old : meshes)
      if (old)
        for (vtkActor* prop : old->props())
          renderer->RemoveViewProp(prop);
  meshes = std::move(next);
}

ScenePicture::ScenePicture()
  : m_implementation(std::make_unique<Implementation>())
{
}

ScenePicture::~ScenePicture() = default;

void ScenePicture::attach(vtkRenderer* renderer)
{
  if (m_implementation->renderer && !m_implementation->tile)
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
  m_implementation->setVolume(contents);
  m_implementation->setMeshes(contents);
  m_implementation->tool.setLight(contents.light);
  m_implementation->setBackground(contents.background);
  setTool(contents.tool);
}

void ScenePicture::maskChanged(std::shared_ptr<const volume::CutMask> mask,
                               const core::IndexBox& box)
{
  for (const auto& each : m_implementation->meshes)
    each->cut(mask, box);
  m_implementation->mapper->MaskChanged(std::move(mask), box);
}

void ScenePicture::setTool(const std::optional<ToolPose>& tool)
{
  m_implementation->mapper->ExpectCut(tool.has_value());
  m_implementation->toolPose = tool;
  m_implementation->mapper->SetShadowingTool(tool);
  m_implementation->tool.setPose(tool);
}

void ScenePicture::setCamera(const core::CameraPose& pose)
{
  m_implementation->pose = pose;
  m_implementation->applyCamera();
}

void ScenePicture::setTile(const std::optional<PictureTile>& tile)
{
  m_implementation->tile = tile;
  m_implementation->applyCamera();
}

core::CameraPose ScenePicture::camera() const
{
  const core::CameraPose& given = m_implementation->pose;
  if (!m_implementation->renderer)
    return given;
  core::CameraPose pose = poseOf(m_implementation->renderer->GetActiveCamera());
  pose.lensShift = given.lensShift;
  pose.head = given.head;
  return pose;
}

void ScenePicture::setInteractive(bool interactive)
{
  m_implementation->interactive = interactive;
}

void ScenePicture::setInteractionRate(double hz)
{
  m_implementation->interaction = InteractionQuality(hz);
}

void ScenePicture::setProgressive(bool progressive)
{
  m_implementation->progressive = progressive;
  if (!progressive)
    m_implementation->mapper->SetFovea(std::nullopt);
}

Refinement ScenePicture::refine(double milliseconds, int samples)
{
  return m_implementation->mapper->Refine(milliseconds, std::clamp(samples, 1, kPixelSamples));
}

int ScenePicture::restSamples() const
{
  return m_implementation->mapper->GetRestSamples();
}

double ScenePicture::drawnScale() const
{
  return restSamples() > 0 ? m_implementation->quality.imageScale
                           : m_implementation->drawn.imageScale;
}

double ScenePicture::foveaScale() const
{
  return restSamples() == 0 && m_implementation->foveated
             ? m_implementation->foveated->fovea.imageScale
             : drawnScale();
}

void ScenePicture::setQuality(const RenderQuality& quality)
{
  quality.validate();
  m_implementation->quality = quality;
}

const RenderQuality& ScenePicture::quality() const
{
  return m_implementation->quality;
}

void ScenePicture::setCounting(bool counting)
{
  m_implementation->mapper->SetCounting(counting);
}

const RenderStatistics& ScenePicture::statistics() const
{
  return m_implementation->mapper->GetStatistics();
}

double ScenePicture::frameMilliseconds() const
{
  return m_implementation->milliseconds;
}

void ScenePicture::throwLastError()
{
  if (const std::exception_ptr error = m_implementation->mapper->TakeError())
    std::rethrow_exception(error);
}

DepthImage ScenePicture::depth() const
{
  return m_implementation->mapper->GetDepth();
}

std::optional<Eigen::Vector3d> ScenePicture::pick(double column, double row) const
{
  if (!m_implementation->renderer)
    return std::nullopt;
  const double distance = static_cast<double>(m_implementation->mapper->GetDepthAt(column, row));
  if (std::isnan(distance))
    return std::nullopt;
  const int* size = m_implementation->renderer->GetSize();
  const PixelRay ray = PixelRays(camera(), size[0], size[1]).through(column, row);
  return ray.origin + distance * ray.direction;
}

std::map<std::string, std::size_t> ScenePicture::resources() const
{
  std::map<std::string, std::size_t> resources = statistics().resources;
  for (const auto& mesh : m_implementation->meshes)
    resources["meshes." + mesh->name()] = mesh->bytes();
  return resources;
}

} // namespace petrous::rendering
