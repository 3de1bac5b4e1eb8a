#include "petrous/Rendering/StereoPicture.h"

#include <algorithm>
#include <utility>

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkWeakPointer.h>
#include <vtk_glew.h>

#include "CameraPlacement.h"
#include "GlProgram.h"
#include "GlTexture.h"
#include "RayCastVertexShader.h"
#include "StereoShader.h"

namespace petrous::rendering
{

namespace
{

constexpr TexelFormat kPixel{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
constexpr float kAfterThePicture = -1.0F; // observer priority; ScenePicture's observers run first

void point(vtkRenderer* renderer, const core::CameraPose& pose)
{
  aimCamera(renderer->GetActiveCamera(), pose);
  shiftLens(renderer, pose);
}

template <class Collection>
bool contains(Collection* collection, vtkObject* object)
{
  return collection->IsItemPresent(object) != 0;
}

// Not RemoveViewProp, which would release the textures that the left eye still uses.
void forget(vtkRenderer* renderer, int index)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkProp::SafeDownCast(props->GetItemAsObject(index))->RemoveConsumer(renderer);
  props->RemoveItem(index);
}

// The right eye's renderer gets the props of the left one.
void mirrorProps(vtkRenderer* from, vtkRenderer* to)
{
  vtkPropCollection* wanted = from->GetViewProps();
  vtkPropCollection* present = to->GetViewProps();
  for (int i = present->GetNumberOfItems(); i-- > 0;)
    if (!contains(wanted, present->GetItemAsObject(i)))
      forget(to, i);
  vtkCollectionSimpleIterator it;
  wanted->InitTraversal(it);
  while (vtkProp* prop = wanted->GetNextProp(it))
    if (!contains(present, prop))
      to->AddViewProp(prop);
  to->AutomaticLightCreationOff();
  to->SetTwoSidedLighting(from->GetTwoSidedLighting() ? 1 : 0);
  to->SetBackground(from->GetBackground());
  vtkLightCollection* lights = from->GetLights();
  lights->InitTraversal(it);
  while (vtkLight* light = lights->GetNextLight(it))
    if (!contains(to->GetLights(), light))
      to->AddLight(light);
}

} // namespace

class StereoPicture::Implementation
{
public:
  explicit Implementation(ScenePicture& shown)
    : picture(shown)
    , left(shown.renderer())
  {
    const auto listen = [this](vtkCallbackCommand* command, auto react)
    {
      command->SetClientData(this);
      command->SetCallback(react);
    };
    listen(m_leftStart, [](vtkObject*, unsigned long, void* self, void*)
           { static_cast<Implementation*>(self)->startLeft(); });
    listen(m_leftEnd, [](vtkObject*, unsigned long, void* self, void*)
           { static_cast<Implementation*>(self)->endLeft(); });
    listen(m_rightStart, [](vtkObject*, unsigned long, void* self, void*)
           { static_cast<Implementation*>(self)->startRight(); });
    listen(m_rightEnd, [](vtkObject*, unsigned long, void* self, void*)
           { static_cast<Implementation*>(self)->endRight(); });
    m_right->AddObserver(vtkCommand::StartEvent, m_rightStart);
    m_right->AddObserver(vtkCommand::EndEvent, m_rightEnd);
  }

  ~Implementation() { show(StereoMode::None); }

  void show(StereoMode next);

  ScenePicture& picture;
  vtkWeakPointer<vtkRenderer> left;
  StereoMode mode = StereoMode::None;
  StereoRig rig;
  int firstRow = 0;

private:
  void place();
  void startLeft();
  void endLeft();
  void startRight();
  void endRight();
  bool composed() const { return mode != StereoMode::QuadBuffer; }
  vtkOpenGLRenderWindow* window() const
  {
    return left ? vtkOpenGLRenderWindow::SafeDownCast(left->GetRenderWindow()) : nullptr;
  }
  void take(vtkRenderer* renderer, GlTexture& texture);
  void compose();

  vtkNew<vtkRenderer> m_right;
  vtkNew<vtkCallbackCommand> m_leftStart, m_leftEnd, m_rightStart, m_rightEnd;
  unsigned long m_startObserver = 0;
  unsigned long m_endObserver = 0;
  bool m_moved = false; // the scene's camera is at an eye position
  core::CameraPose m_head;
  GlTexture m_pictures[2];
  GlProgram m_program;
  ScreenTriangle m_triangle;
};

void StereoPicture::Implementation::show(StereoMode next)
{
  if (next == mode || !left)
    return;
  vtkOpenGLRenderWindow* shown = window();
  while (m_right->GetViewProps()->GetNumberOfItems() > 0)
    forget(m_right, m_right->GetViewProps()->GetNumberOfItems() - 1);
  left->RemoveObserver(m_startObserver);
  left->RemoveObserver(m_endObserver);
  left->SetViewport(0.0, 0.0, 1.0, 1.0);
  if (shown)
  {
    shown->RemoveRenderer(m_right);
    if (mode == StereoMode::QuadBuffer)
      shown->StereoRenderOff();
    if (m_program)
    {
      shown->MakeCurrent();
      m_pictures[0].release();
      m_pictures[1].release();
      m_program.release();
      m_triangle.release();
    }
  }
  mode = next;
  if (mode == StereoMode::None)
    return;
  m_startObserver = left->AddObserver(vtkCommand::StartEvent, m_leftStart, kAfterThePicture);
  m_endObserver = left->AddObserver(vtkCommand::EndEvent, m_leftEnd, kAfterThePicture);
  if (mode == StereoMode::QuadBuffer && shown)
  {
    left->GetActiveCamera()->SetEyeAngle(0.0); // the eye cameras are set here, not by VTK
    shown->SetStereoTypeToCrystalEyes();
    shown->StereoRenderOn();
  }
  else if (shown)
    shown->AddRenderer(m_right);
}

// Both eyes are drawn into the same area, at the lower left, and then composed.
void StereoPicture::Implementation::place()
{
  const int width = std::max(window()->GetSize()[0], 1);
  const double share =
      mode == StereoMode::SideBySide ? static_cast<double>((width + 1) / 2) / width : 1.0;
  left->SetViewport(0.0, 0.0, share, 1.0);
  m_right->SetViewport(0.0, 0.0, share, 1.0);
}

void StereoPicture::Implementation::startLeft()
{
  if (!window())
    return;
  place();
  m_head = picture.camera();
  m_moved = true;
  const EyePair eyes = eyesOf(m_head, fittedStereoGeometry(m_head, rig));
  const bool second = mode == StereoMode::QuadBuffer && !left->GetActiveCamera()->GetLeftEye();
  point(left, second ? eyes.right : eyes.left);
  left->ResetCameraClippingRange();
}

void StereoPicture::Implementation::endLeft()
{
  if (!m_moved || !window())
    return;
  if (composed())
    take(left, m_pictures[0]);
  m_moved = false;
  picture.setCamera(m_head);
  shiftLens(left, m_head); // who picks between two frames looks along the head's axis
}

void StereoPicture::Implementation::startRight()
{
  if (!left)
    return;
  mirrorProps(left, m_right);
  point(m_right, eyesOf(m_head, fittedStereoGeometry(m_head, rig)).right);
  m_right->ResetCameraClippingRange();
}

void StereoPicture::Implementation::endRight()
{
  if (!composed() || !window())
    return;
  take(m_right, m_pictures[1]);
  compose();
}

void StereoPicture::Implementation::take(vtkRenderer* renderer, GlTexture& texture)
{
  int width = 0;
  int height = 0;
  int x = 0;
  int y = 0;
  renderer->GetTiledSizeAndOrigin(&width, &height, &x, &y);
  if (texture.dims()[0] != width || texture.dims()[1] != height)
    texture.create(kPixel, width, height, nullptr, GL_NEAREST);
  vtkOpenGLState* state = window()->GetState();
  state->PushFramebufferBindings();
  GLint drawn = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(drawn));
  texture.bind(0);
  glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, x, y, width, height);
  glBindTexture(GL_TEXTURE_2D, 0);
  state->ResetFramebufferBindings();
  state->PopFramebufferBindings();
  state->ResetGLActiveTexture();
}

void StereoPicture::Implementation::compose()
{
  const PlainDrawing plain(window());
  if (!m_program)
    m_program.build(kRayCastVertexShader, kStereoShader);
  const int* size = window()->GetSize();
  window()->GetState()->vtkglViewport(0, 0, size[0], size[1]);
  m_program.use();
  m_pictures[0].bind(0);
  m_pictures[1].bind(1);
  m_program.set("leftPicture", 0);
  m_program.set("rightPicture", 1);
  m_program.set("arrangement", mode == StereoMode::SideBySide    ? 0
                               : mode == StereoMode::Interleaved ? 1
                                                                 : 2);
  m_program.set("rightColumn", size[0] / 2);
  m_program.set("firstRow", firstRow);
  m_triangle.draw();
}

StereoPicture::StereoPicture(ScenePicture& picture)
  : m_implementation(std::make_unique<Implementation>(picture))
{
}

StereoPicture::~StereoPicture() = default;

void StereoPicture::show(StereoMode mode, const StereoRig& rig)
{
  m_implementation->rig = rig;
  m_implementation->show(mode);
}

StereoMode StereoPicture::mode() const noexcept
{
  return m_implementation->mode;
}

const StereoRig& StereoPicture::rig() const noexcept
{
  return m_implementation->rig;
}

void StereoPicture::setFirstRow(int row) noexcept
{
  m_implementation->firstRow = std::max(row, 0);
}

} // namespace petrous::rendering
