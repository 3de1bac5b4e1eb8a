#include "petrous/Rendering/VolumeMapper.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <Eigen/LU>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkImageData.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkWeakPointer.h>
#include <vtk_glew.h>

#include "CameraPlacement.h"
#include "GlTexture.h"
#include "RayCaster.h"
#include "RestPicture.h"
#include "petrous/Core/Log.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/VtkVolume.h"

class vtkRenderer;

namespace petrous::rendering
{

/// A copy of the depth of opaque polygons in the bound frame buffer, at which rays end.
class OpaqueDepth
{
public:
  /// 0 if nothing opaque is drawn or the depth is not available.
  GLuint capture(vtkRenderer* renderer, int x, int y, int width, int height);
  void release();

private:
  GLuint m_texture = 0;
  GLuint m_framebuffer = 0;
  int m_width = 0;
  int m_height = 0;
  GLint m_format = 0;
};

namespace
{

bool hasOpaqueProps(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator it;
  props->InitTraversal(it);
  while (vtkProp* prop = props->GetNextProp(it))
    if (prop->GetVisibility() && prop->HasOpaqueGeometry())
      return true;
  return false;
}

// Changes with the opaque polygons, the camera aside. Overlays are none.
std::uint64_t opaqueState(vtkRenderer* renderer)
{
  std::uint64_t state = 14695981039346656037ULL;
  const auto mix = [&state](std::uint64_t value) { state = (state ^ value) * 1099511628211ULL; };
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator it;
  props->InitTraversal(it);
  while (vtkProp* prop = props->GetNextProp(it))
    if (vtkActor::SafeDownCast(prop) && prop->GetVisibility() && prop->HasOpaqueGeometry())
    {
      mix(reinterpret_cast<std::uintptr_t>(prop));
      mix(prop->GetRedrawMTime());
    }
  return state;
}

// On the screen of a frame; nullopt: behind the camera, or nowhere.
std::optional<RayCaster::Fovea> foveaOf(const vtkPetrousVolumeMapper::Fovea& wanted,
                                        const RayCaster::Frame& frame)
{
  const RayView& view = frame.view;
  const Eigen::Matrix3d axes = view.axes();
  const Eigen::Vector3d at = axes.inverse() * (wanted.center - view.origin);
  const double depth = view.parallel ? 1.0 : at.z();
  const double pixels = 0.5 * frame.width / (axes.col(0).norm() * depth); // a mm
  if (!at.allFinite() || !(depth > 0.0) || !std::isfinite(pixels))
    return std::nullopt;
  RayCaster::Fovea fovea;
  fovea.x = 0.5 * frame.width * (at.x() / depth + 1.0);
  fovea.y = 0.5 * frame.height * (at.y() / depth + 1.0);
  fovea.radius = pixels * wanted.radius;
  fovea.scale = wanted.quality.imageScale;
  fovea.step = wanted.quality.step;
  return fovea;
}

optics::Lamp lampIn(const Eigen::Matrix4d& worldFromPatient, const core::CameraPose& camera)
{
  optics::Lamp lamp = optics::lampOf(camera);
  const Eigen::Matrix4d patientFromWorld = worldFromPatient.inverse();
  const Eigen::Matrix3d turn = patientFromWorld.topLeftCorner<3, 3>();
  lamp.at = turn * lamp.at;
  if (!lamp.isFar)
    lamp.at += patientFromWorld.topRightCorner<3, 1>();
  lamp.up = turn * lamp.up;
  lamp.right = turn * lamp.right;
  return lamp;
}

// Rotation and translation alone keep its size.
ToolPose toolIn(const Eigen::Matrix4d& worldFromPatient, ToolPose tool)
{
  const Eigen::Matrix4d patientFromWorld = worldFromPatient.inverse();
  tool.center = (patientFromWorld * tool.center.homogeneous()).head<3>();
  const Eigen::Matrix3d turn = patientFromWorld.topLeftCorner<3, 3>();
  tool.axisToHand = turn * tool.axisToHand;
  tool.rotation = Eigen::Quaterniond(turn) * tool.rotation;
  return tool;
}

// A depth blit requires identical source and destination formats.
GLint depthFormat()
{
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  const auto ask = [bound](GLenum attachment, GLenum what)
  {
    GLint answer = 0;
    glGetFramebufferAttachmentParameteriv(
        GL_DRAW_FRAMEBUFFER,
        bound ? attachment : (attachment == GL_STENCIL_ATTACHMENT ? GL_STENCIL : GL_DEPTH), what,
        &answer);
    return answer;
  };
  if (ask(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_NONE)
    return 0;
  const GLint bits = ask(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
  const bool stencil =
      ask(GL_STENCIL_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE &&
      ask(GL_STENCIL_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0;
  if (ask(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT)
    return stencil ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F;
  if (stencil)
    return GL_DEPTH24_STENCIL8;
  return bits == 16 ? GL_DEPTH_COMPONENT16
                    : (bits == 32 ? GL_DEPTH_COMPONENT32 : GL_DEPTH_COMPONENT24);
}

} // namespace

GLuint OpaqueDepth::capture(vtkRenderer* renderer, int x, int y, int width, int height)
{
  if (!hasOpaqueProps(renderer))
    return 0;
  while (glGetError() != GL_NO_ERROR)
  {
  }
  const GLint format = depthFormat();
  if (format == 0 || glGetError() != GL_NO_ERROR)
    return 0;
  GLint draw = 0;
  GLint read = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
  if (width != m_width || height != m_height || format != m_format)
  {
    release();
    m_width = width;
    m_height = height;
    m_format = format;
    const bool stencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    glGenTextures(1, &m_texture);
    glBindTexture(GL_TEXTURE_2D, m_texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    const GLenum type = format == GL_DEPTH24_STENCIL8    ? GL_UNSIGNED_INT_24_8
                        : format == GL_DEPTH32F_STENCIL8 ? GL_FLOAT_32_UNSIGNED_INT_24_8_REV
                                                         : GL_FLOAT;
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0,
                 stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT, type, nullptr);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenFramebuffers(1, &m_framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER,
                           stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                           GL_TEXTURE_2D, m_texture, 0);
    glDrawBuffer(GL_NONE);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(draw));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
  glBlitFramebuffer(x, y, x + width, y + height, 0, 0, width, height, GL_DEPTH_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read));
  return glGetError() == GL_NO_ERROR ? m_texture : 0;
}

void OpaqueDepth::release()
{
  if (m_texture)
    glDeleteTextures(1, &m_texture);
  if (m_framebuffer)
    glDeleteFramebuffers(1, &m_framebuffer);
  m_texture = m_framebuffer = 0;
  m_width = m_height = 0;
}
} // namespace petrous::rendering

using petrous::rendering::SceneContents;

namespace
{

// Material from component 0 of a vtkVolumeProperty.
petrous::appearance::Material materialOf(vtkVolumeProperty* property, double surfaceOpacity)
{
  std::set<double> values;
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction(0);
  vtkPiecewiseFunction* opacities = property->GetScalarOpacity(0);
  double node[6];
  for (int i = 0; i < colors->GetSize(); ++i)
  {
    colors->GetNodeValue(i, node);
    values.insert(node[0]);
  }
  for (int i = 0; i < opacities->GetSize(); ++i)
  {
    opacities->GetNodeValue(i, node);
    values.insert(node[0]);
  }
  if (values.empty())
    values.insert(0.0);
  const double unit = std::max(property->GetScalarOpacityUnitDistance(0), 1e-6);
  std::vector<petrous::appearance::ControlPoint> points;
  for (const double value : values)
  {
    petrous::appearance::ControlPoint point;
    double color[3];
    colors->GetColor(value, color);
    point.value = value;
    for (std::size_t c = 0; c < 3; ++c)
      point.color[c] = static_cast<float>(std::clamp(color[c], 0.0, 1.0));
    const double opacity = std::clamp(opacities->GetValue(value), 0.0, 1.0);
    point.opacity = static_cast<float>(1.0 - std::pow(1.0 - opacity, 1.0 / unit));
    points.push_back(point);
  }
  petrous::appearance::Material material;
  material.transfer = petrous::appearance::TransferFunction(points);
  material.surfaceOpacity = static_cast<float>(surfaceOpacity);
  material.shininess = static_cast<float>(property->GetSpecularPower(0));
  return material;
}

} // namespace

class vtkPetrousVolumeMapper::Internals
{
public:
  petrous::rendering::RayCaster caster;
  petrous::rendering::OpaqueDepth opaque;
  petrous::rendering::RenderQuality quality;
  std::optional<petrous::rendering::RenderQuality> restQuality;
  std::optional<vtkPetrousVolumeMapper::Fovea> fovea;
  std::optional<petrous::core::CameraPose> lampCamera;
  std::optional<petrous::rendering::ToolPose> tool; // world
  int sample = -1;

  /// With neither size nor depth.
  petrous::rendering::RayCaster::Frame frameOf(vtkRenderer* renderer, vtkVolume* volume) const
  {
    const Eigen::Matrix4d worldFromPatient = petrous::rendering::toEigen(volume->GetMatrix());
    petrous::rendering::RayCaster::Frame frame;
    frame.view = petrous::rendering::raysOf(renderer->GetActiveCamera(),
                                            renderer->GetTiledAspectRatio(), worldFromPatient);
    frame.lamp = petrous::rendering::lampIn(
        worldFromPatient,
        lampCamera.value_or(petrous::rendering::poseOf(renderer->GetActiveCamera())));
    if (tool)
      frame.tool = petrous::rendering::toolIn(worldFromPatient, *tool);
    frame.sample = sample;
    frame.shadowsLater = restQuality.has_value();
    return frame;
  }

  /// The picture at rest of one eye, with the depth at which its rays end.
  struct Rest
  {
    petrous::rendering::RestPicture picture;
    petrous::rendering::OpaqueDepth opaque;
  };
  std::map<std::pair<const vtkRenderer*, bool>, Rest> rests; // by renderer and eye
  const petrous::rendering::RestPicture* shown = nullptr;    // in the last frame; null: none

  Rest& restOf(vtkRenderer* renderer)
  {
    const std::pair<const vtkRenderer*, bool> eye(renderer,
                                                  renderer->GetActiveCamera()->GetLeftEye() != 0);
    constexpr std::size_t kEyes = 2;
    if (rests.size() >= kEyes && rests.count(eye) == 0)
      releaseRests(); // of renderers that are gone
    return rests[eye];
  }
  void releaseRests()
  {
    for (auto& [eye, rest] : rests)
    {
      rest.picture.release();
      rest.opaque.release();
    }
    rests.clear();
    shown = nullptr;
  }
  SceneContents contents;
  bool given = false;                   // by SetContents, not by the pipeline
  vtkMTimeType made = 0;                // when `contents` was created from the pipeline
  const vtkDataObject* image = nullptr; // source of `contents`
  vtkMTimeType clipped = 0;
  vtkWeakPointer<vtkOpenGLRenderWindow> window; // whose context owns the textures
  // The same window; weak pointers are cleared while it is destroyed.
  const vtkWindow* owner = nullptr;
  int width = 0;
  int height = 0;
  std::exception_ptr error;
};

vtkStandardNewMacro(vtkPetrousVolumeMapper);

vtkPetrousVolumeMapper::vtkPetrousVolumeMapper()
  : Internal(std::make_unique<Internals>())
{
}

vtkPetrousVolumeMapper::~vtkPetrousVolumeMapper() = default;

void vtkPetrousVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IsoValue: " << this->IsoValue << "\n";
  os << indent << "SurfaceOpacity: " << this->SurfaceOpacity << "\n";
  os << indent << "Variant:";
  for (const std::string& feature : this->GetStatistics().variant)
    os << " " << feature;
  os << "\n";
}

void vtkPetrousVolumeMapper::SetContents(const SceneContents& contents)
{
  const bool newCt = contents.ct != this->Internal->contents.ct;
  this->Internal->contents = contents;
  this->Internal->given = true;
  if (newCt)
    this->SetInputData(contents.ct ? petrous::rendering::wrap(*contents.ct).Get() : nullptr);
  if (newCt && !contents.ct && this->Internal->window) // nothing is drawn that would release it
  {
    this->Internal->window->MakeCurrent();
    this->Internal->caster.setContents(contents);
    this->Internal->caster.releaseData();
    this->Internal->caster.releasePicture();
    this->Internal->releaseRests();
  }
  this->Internal->clipped = 0; // to be merged with the mapper's own clipping
  this->Modified();
}

void vtkPetrousVolumeMapper::MaskChanged(std::shared_ptr<const petrous::volume::CutMask> mask,
                                         const petrous::core::IndexBox& box)
{
  this->Internal->contents.mask = mask;
  if (this->Internal->clipped > 0)
    this->Internal->caster.maskChanged(std::move(mask), box);
}

void vtkPetrousVolumeMapper::ExpectCut(bool expected)
{
  this->Internal->caster.expectCut(expected);
}

void vtkPetrousVolumeMapper::SetQuality(const petrous::rendering::RenderQuality& quality)
{
  this->Internal->quality = quality;
  this->Internal->caster.setQuality(quality);
}

const petrous::rendering::RenderQuality& vtkPetrousVolumeMapper::GetQuality() const
{
  return this->Internal->quality;
}

const petrous::rendering::RenderStatistics& vtkPetrousVolumeMapper::GetStatistics() const
{
  return this->Internal->caster.statistics();
}

std::exception_ptr vtkPetrousVolumeMapper::TakeError()
{
  return std::exchange(this->Internal->error, nullptr);
}

void vtkPetrousVolumeMapper::UpdateContents(vtkVolume* volume)
{
  Internals& my = *this->Internal;
  if (!my.given)
  {
    const vtkMTimeType changed = std::max(
        {this->GetMTime(), this->GetInput()->GetMTime(), volume->GetProperty()->GetMTime()});
    if (changed > my.made)
    {
      auto* image = vtkImageData::SafeDownCast(this->GetInput());
      const bool sameVoxels = my.contents.ct && image == my.image && image->GetMTime() <= my.made;
      if (!sameVoxels)
        my.contents.ct = petrous::rendering::unwrap(image);
      my.image = image;
      my.contents.iso = this->IsoValue;
      my.contents.materials = {materialOf(volume->GetProperty(), this->SurfaceOpacity)};
      my.contents.light.ambient = std::clamp(volume->GetProperty()->GetAmbient(0), 0.0, 1.0);
      my.contents.light.specular = std::clamp(volume->GetProperty()->GetSpecular(0), 0.0, 1.0);
      my.made = changed;
      my.clipped = 0;
    }
  }
  vtkMTimeType changed = std::max(this->GetMTime(), volume->GetMTime());
  if (this->ClippingPlanes)
    for (int i = 0; i < this->ClippingPlanes->GetNumberOfItems(); ++i)
      changed = std::max(changed, this->ClippingPlanes->GetItem(i)->GetMTime());
  if (my.clipped > 0 && changed <= my.clipped)
    return;
  my.clipped = changed;
  SceneContents contents = my.contents;
  const Eigen::Matrix4d worldFromPatient = petrous::rendering::toEigen(volume->GetMatrix());
  if (this->ClippingPlanes)
    for (int i = 0; i < this->ClippingPlanes->GetNumberOfItems(); ++i)
    {
      vtkPlane* plane = this->ClippingPlanes->GetItem(i);
      const Eigen::Vector4d point =
          worldFromPatient.inverse() *
          Eigen::Vector4d(plane->GetOrigin()[0], plane->GetOrigin()[1], plane->GetOrigin()[2], 1.0);
      const Eigen::Vector3d normal = worldFromPatient.topLeftCorner<3, 3>().transpose() *
                                     Eigen::Map<const Eigen::Vector3d>(plane->GetNormal());
      contents.clipping.push_back({point.head<3>(), normal.normalized()});
    }
  if (this->Cropping && this->CroppingRegionFlags == VTK_CROP_SUBVOLUME && contents.ct)
  {
    const double* planes = this->VoxelCroppingRegionPlanes;
    this->ConvertCroppingRegionPlanesToVoxels();
    petrous::core::IndexBox box;
    for (std::size_t a = 0; a < 3; ++a)
    {
      box.lower[a] = static_cast<int>(std::lround(planes[2 * a]));
      box.upper[a] = static_cast<int>(std::lround(planes[2 * a + 1])) + 1;
    }
    contents.crop = contents.crop ? contents.crop->intersected(box) : box;
  }
  my.caster.setContents(contents);
}

// Makes the renderer's window the one that this draws in.
void vtkPetrousVolumeMapper::Attach(vtkRenderer* renderer)
{
  Internals& my = *this->Internal;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
    throw petrous::rendering::RenderingError(petrous::rendering::RenderingError::Reason::NoOpenGL,
                                             "the window does not draw with OpenGL");
  if (my.window && my.window != window)
  {
    this->ReleaseGraphicsResources(my.window);
    window->MakeCurrent();
  }
  if (my.window != window)
  {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    petrous::core::log::info(std::string("OpenGL: ") + (name ? name : "unknown"));
  }
  my.window = window;
  my.owner = window;
}

void vtkPetrousVolumeMapper::PrepareShadows(vtkRenderer* renderer, vtkVolume* volume)
{
  Internals& my = *this->Internal;
  if (!my.contents.light.shadows || !my.contents.ct)
    return;
  int width = 0;
  int height = 0;
  int x = 0;
  int y = 0;
  renderer->GetTiledSizeAndOrigin(&width, &height, &x, &y);
  if (width < 1 || height < 1)
    return;
  try
  {
    this->Attach(renderer);
    this->UpdateContents(volume);
    const petrous::rendering::PlainDrawing plain(my.window);
    my.caster.prepareShadows(my.frameOf(renderer, volume));
  }
  catch (const std::exception&)
  {
    my.clipped = 0; // it comes again, and is told, when the volume is drawn
  }
}

void vtkPetrousVolumeMapper::ShadePolygons(vtkRenderer* renderer, vtkVolume* volume,
                                           petrous::rendering::GlUniforms& program, bool isTool)
{
  const Internals& my = *this->Internal;
  const Eigen::Matrix4d viewFromPatient =
      petrous::rendering::toEigen(renderer->GetActiveCamera()->GetModelViewTransformMatrix()) *
      petrous::rendering::toEigen(volume->GetMatrix());
  my.caster.shadePolygons(program, my.frameOf(renderer, volume), viewFromPatient.inverse(), isTool);
  glActiveTexture(GL_TEXTURE0);
  if (my.window)
    my.window->GetState()->ResetGLActiveTexture();
}

void vtkPetrousVolumeMapper::DrawRays(vtkRenderer* renderer, vtkVolume* volume)
{
  Internals& my = *this->Internal;
  this->Attach(renderer);
  vtkOpenGLRenderWindow* window = my.window;
  this->UpdateContents(volume);

  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  renderer->GetTiledSizeAndOrigin(&width, &height, &x, &y);
  if (width < 1 || height < 1)
    return;
  my.width = width;
  my.height = height;
  petrous::rendering::RayCaster::Frame frame = my.frameOf(renderer, volume);
  frame.width = width;
  frame.height = height;

  vtkOpenGLState* state = window->GetState();
  // Before copying the depth, which a scissor would clip as well.
  const petrous::rendering::PlainDrawing plain(window);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  state->PushFramebufferBindings();
  my.shown = nullptr;
  Internals::Rest* rest = my.restQuality && !this->Counting ? &my.restOf(renderer) : nullptr;
  petrous::rendering::RestPicture::Key key;
  if (rest)
    key = {frame.view,
           frame.width,
           frame.height,
           my.caster.changes(),
           petrous::rendering::opaqueState(renderer),
           *my.restQuality,
           my.contents.light.shadows ? std::optional(frame.lamp.at) : std::nullopt,
           my.contents.light.falloff > 0.0 ? frame.lamp.focus : 0.0};
  try
  {
    if (rest && rest->picture.shows(key))
      my.shown = &rest->picture;
    else
    {
      frame.opaque =
          (rest ? rest->opaque : my.opaque).capture(renderer, x, y, frame.width, frame.height);
      if (my.fovea)
        frame.fovea = petrous::rendering::foveaOf(*my.fovea, frame);
      my.caster.draw(frame, this->Counting);
      if (rest && my.caster.statistics().pendingEdits == 0)
        rest->picture.begin(key, frame);
      else if (rest)
        rest->picture.drop();
    }
    state->ResetFramebufferBindings(); // bound outside of VTK's state cache
    state->PopFramebufferBindings();
    state->ResetGLViewportState();
    state->vtkglViewport(x, y, frame.width, frame.height);
    state->vtkglEnable(GL_BLEND);
    state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    if (my.shown)
      my.caster.present(my.shown->target());
    else
      my.caster.present(frame.width, frame.height);
  }
  catch (...)
  {
    state->ResetFramebufferBindings();
    state->PopFramebufferBindings();
    throw;
  }
}

void vtkPetrousVolumeMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->Internal->error = nullptr;
  try
  {
    this->DrawRays(renderer, volume);
  }
  catch (const std::exception& error)
  {
    this->Internal->error = std::current_exception();
    petrous::core::log::error("ray caster: " + petrous::core::log::typeOf(error));
    vtkErrorMacro(<< error.what());
  }
}

void vtkPetrousVolumeMapper::SetRestQuality(
    const std::optional<petrous::rendering::RenderQuality>& quality)
{
  this->Internal->restQuality = quality;
}

void vtkPetrousVolumeMapper::SetSample(int sample)
{
  this->Internal->sample = sample;
}

void vtkPetrousVolumeMapper::SetLampCamera(const std::optional<petrous::core::CameraPose>& camera)
{
  this->Internal->lampCamera = camera;
}

void vtkPetrousVolumeMapper::SetShadowingTool(
    const std::optional<petrous::rendering::ToolPose>& tool)
{
  this->Internal->tool = tool;
}

void vtkPetrousVolumeMapper::SetFovea(const std::optional<Fovea>& fovea)
{
  this->Internal->fovea = fovea;
}

int vtkPetrousVolumeMapper::GetRestSamples() const
{
  return this->Internal->shown ? this->Internal->shown->samples() : 0;
}

double vtkPetrousVolumeMapper::GetRestMilliseconds() const
{
  return this->Internal->shown ? this->Internal->shown->milliseconds() : 0.0;
}

petrous::rendering::Refinement vtkPetrousVolumeMapper::Refine(double milliseconds, int samples)
{
  using petrous::rendering::Refinement;
  Internals& my = *this->Internal;
  if (!my.window || !my.restQuality)
    return Refinement::Done;
  const std::uint64_t contents = my.caster.changes();
  petrous::rendering::RestPicture* next = nullptr; // the one that lags behind
  for (auto& [eye, rest] : my.rests)
    if (rest.picture.remains(contents, samples) && (!next || rest.picture.drawn() < next->drawn()))
      next = &rest.picture;
  if (!next)
    return Refinement::Done;
  my.window->MakeCurrent();
  vtkOpenGLState* state = my.window->GetState();
  const petrous::rendering::PlainDrawing plain(my.window);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  state->PushFramebufferBindings();
  Refinement refinement = Refinement::Done;
  try
  {
    refinement = next->advance(my.caster, milliseconds, samples);
  }
  catch (const std::exception& error)
  {
    my.error = std::current_exception();
    next->drop();
    petrous::core::log::error("ray caster: " + petrous::core::log::typeOf(error));
  }
  state->ResetFramebufferBindings(); // bound outside of VTK's state cache
  state->PopFramebufferBindings();
  state->ResetGLViewportState();
  state->ResetGLBlendFuncState();
  // Both eyes at once.
  for (const auto& [eye, rest] : my.rests)
    if (refinement == Refinement::Better && rest.picture.remains(contents, samples) &&
        rest.picture.samples() < next->samples())
      refinement = Refinement::More;
  return refinement;
}

petrous::rendering::DepthImage vtkPetrousVolumeMapper::GetDepth()
{
  if (!this->Internal->window)
    return {};
  this->Internal->window->MakeCurrent();
  return (this->Internal->shown ? this->Internal->shown->target() : this->Internal->caster.target())
      .readDepth();
}

float vtkPetrousVolumeMapper::GetDepthAt(double column, double row)
{
  if (!this->Internal->window)
    return std::numeric_limits<float>::quiet_NaN();
  this->Internal->window->MakeCurrent();
  const Internals& my = *this->Internal;
  return my.shown ? my.shown->target().readDepth(column, row, my.width, my.height)
                  : my.caster.readDepth(column, row, my.width, my.height);
}

void vtkPetrousVolumeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (!window || window != this->Internal->owner)
    return;
  window->MakeCurrent();
  this->Internal->caster.release();
  this->Internal->opaque.release();
  this->Internal->releaseRests();
  this->Internal->window = nullptr;
  this->Internal->owner = nullptr;
}
