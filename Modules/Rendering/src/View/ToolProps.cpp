#include "petrous/Rendering/ToolProps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include <vtkActor.h>
#include <vtkCleanPolyData.h>
#include <vtkCylinderSource.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include "SurfaceActor.h"
#include "petrous/Rendering/ToolShape.h"

namespace petrous::rendering
{

using namespace tool;

namespace
{

constexpr double kPi = 3.14159265358979323846;

constexpr std::array<double, 3> kGhostColor{0.35, 0.85, 1.0};
constexpr std::array<double, 3> kGhostDrillingColor{1.0, 0.45, 0.85};

constexpr std::size_t kInstrument = 3; // of the actors

// Relief of a finish over the ball of radius 1: longitude about the axis and latitude from the
// equator towards the hand, rad. Only its slope is shaded, so that the ball stays the felt one.
using Relief = std::function<double(double longitude, double latitude)>;

// Eight flutes that run out at the tip: behind each cutting edge the land falls slowly, before it
// the gullet rises steeply.
double fluted(double longitude, double latitude)
{
  constexpr int kFlutes = 8;
  constexpr double kHelix = 0.6;  // turn between equator and tip, rad
  constexpr double kDepth = 0.14; // of the radius
  constexpr double kRise = 0.25;  // of a pitch
  const double pitches = kFlutes * (longitude + kHelix * latitude / (0.5 * kPi)) / (2.0 * kPi);
  const double part = pitches - std::floor(pitches);
  const double height = part < kRise ? part / kRise : (1.0 - part) / (1.0 - kRise);
  return kDepth * std::cos(latitude) * height;
}

// Grains of a diamond burr: value noise between hashed lattice points on the ball.
double gritted(double longitude, double latitude)
{
  constexpr double kGrain = 0.11; // of the radius
  constexpr double kDepth = 0.035;
  const Eigen::Vector3d at =
      Eigen::Vector3d(std::cos(latitude) * std::cos(longitude),
                      std::cos(latitude) * std::sin(longitude), std::sin(latitude)) /
      kGrain;
  const Eigen::Vector3d low = at.array().floor();
  const Eigen::Vector3d part = at - low;
  const auto grain = [&low](int i, int j, int k)
  {
    const auto lattice = [](double value, int step)
    { return static_cast<std::uint32_t>(static_cast<std::int32_t>(value) + step); };
    std::uint32_t hash = lattice(low.x(), i) * 73856093U ^ lattice(low.y(), j) * 19349663U ^
                         lattice(low.z(), k) * 83492791U;
    hash = (hash ^ (hash >> 13U)) * 1274126177U;
    return static_cast<double>((hash ^ (hash >> 16U)) & 0xffffU) / 65535.0;
  };
  double value = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int i = corner & 1;
    const int j = (corner >> 1) & 1;
    const int k = corner >> 2;
    value += (i ? part.x() : 1.0 - part.x()) * (j ? part.y() : 1.0 - part.y()) *
             (k ? part.z() : 1.0 - part.z()) * grain(i, j, k);
  }
  return kDepth * value;
}

// A ball of radius 1 about y, shaded by the slope of a relief.
vtkSmartPointer<vtkPolyData> ball(const Relief& relief)
{
  constexpr int kAround = 192;
  constexpr int kAlong = 96;
  constexpr double kStep = 1e-3; // rad
  core::TriangleMesh mesh;
  std::vector<Eigen::Vector3f> normals;
  for (int row = 0; row <= kAlong; ++row)
    for (int column = 0; column <= kAround; ++column)
    {
      const double latitude = kPi * (static_cast<double>(row) / kAlong - 0.5);
      const double longitude = 2.0 * kPi * column / kAround;
      const double wide = std::cos(latitude);
      const Eigen::Vector3d out(wide * std::sin(longitude), std::sin(latitude),
                                wide * std::cos(longitude));
      const Eigen::Vector3d east(std::cos(longitude), 0.0, -std::sin(longitude));
      const Eigen::Vector3d north = out.cross(east);
      const double eastward =
          (relief(longitude + kStep, latitude) - relief(longitude - kStep, latitude)) /
          (2.0 * kStep * std::max(wide, 0.05));
      const double northward =
          (relief(longitude, latitude + kStep) - relief(longitude, latitude - kStep)) /
          (2.0 * kStep);
      mesh.vertices.push_back(out.cast<float>());
      normals.push_back((out - eastward * east - northward * north).normalized().cast<float>());
    }
  for (int row = 0; row < kAlong; ++row)
    for (int column = 0; column < kAround; ++column)
    {
      const auto a = static_cast<std::uint32_t>(row * (kAround + 1) + column);
      const std::uint32_t b = a + kAround + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  return toPolyData(mesh, normals);
}

} // namespace

ToolProps::ToolProps(Look look)
  : m_idle(look == Look::Ghost ? kGhostColor : kBurrColor)
  , m_drilling(look == Look::Ghost ? kGhostDrillingColor : kDrillingColor)
{
  const bool isGhost = look == Look::Ghost;
  m_burr->SetThetaResolution(isGhost ? 16 : 48);
  m_burr->SetPhiResolution(isGhost ? 12 : 32);
  m_shaft->SetResolution(isGhost ? 10 : 32);
  m_handpiece->SetResolution(isGhost ? 12 : 48);
  vtkAlgorithm* const sources[3] = {m_burr, m_shaft, m_handpiece};
  const std::array<std::array<double, 3>, 4> colors{kBurrColor, kShaftColor, kHandpieceColor,
                                                    kShaftColor};
  for (std::size_t part = 0; part < m_actors.size(); ++part)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    if (part != kInstrument)
      mapper->SetInputConnection(sources[part]->GetOutputPort());
    m_actors[part] = vtkSmartPointer<vtkActor>::New();
    m_actors[part]->SetMapper(mapper);
    m_actors[part]->SetVisibility(0);
    m_actors[part]->PickableOff();
    vtkProperty* property = m_actors[part]->GetProperty();
    if (isGhost)
    {
      property->SetColor(kGhostColor[0], kGhostColor[1], kGhostColor[2]);
      property->SetRepresentationToWireframe();
      property->LightingOff();
      property->SetLineWidth(1.5F);
      continue;
    }
    m_shadings[part] = std::make_unique<PolygonShading>();
    setLitColor(property, colors[part][0], colors[part][1], colors[part][2]);
    property->SetInterpolationToPhong();
    property->SetAmbient(kAmbient);
    property->SetDiffuse(1.0 - kAmbient);
    property->SetSpecular(kSpecular);
    property->SetSpecularPower(0.25 * kShininess); // see SurfaceActor.cpp
  }
}

ToolProps::~ToolProps() = default;

void ToolProps::addTo(vtkRenderer* renderer) const
{
  for (const auto& actor : m_actors)
    renderer->AddActor(actor);
}

void ToolProps::removeFrom(vtkRenderer* renderer) const
{
  for (const auto& actor : m_actors)
    renderer->RemoveActor(actor);
}

void ToolProps::setPose(const std::optional<ToolPose>& tool)
{
  const bool shown = tool && isShown(*tool);
  const bool isInstrument = shown && tool->instrument;
  for (std::size_t part = 0; part < m_actors.size(); ++part)
    m_actors[part]->SetVisibility(shown && (part == kInstrument) == isInstrument ? 1 : 0);
  if (shown && !tool->handpiece)
    m_actors[2]->SetVisibility(0);
  if (!shown)
    return;
  Eigen::Matrix3d turn = tool->rotation.toRotationMatrix();
  if (isInstrument)
    shapeInstrument(*tool);
  else
  {
    shapeBurr(*tool);
    // VTK's cylinders are centred and along y.
    m_shaft->SetRadius(shaftRadius(*tool));
    m_shaft->SetHeight(kShaftLength);
    m_shaft->SetCenter(0.0, 0.5 * kShaftLength, 0.0);
    m_handpiece->SetRadius(kHandpieceRadius);
    m_handpiece->SetHeight(kHandpieceLength);
    m_handpiece->SetCenter(0.0, kShaftLength + 0.5 * kHandpieceLength, 0.0);
    const auto& burr = tool->drilling ? m_drilling : m_idle;
    setLitColor(m_actors[0]->GetProperty(), burr[0], burr[1], burr[2]);
    turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), tool->axisToHand)
               .toRotationMatrix();
  }
  vtkNew<vtkMatrix4x4> pose;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      pose->SetElement(row, column, turn(row, column));
    pose->SetElement(row, 3, tool->center[row]);
  }
  for (const auto& actor : m_actors)
    actor->SetUserMatrix(pose);
}

void ToolProps::followShadows(const std::function<void(GlUniforms& program)>& setter) const
{
  for (std::size_t part = 0; part < m_actors.size(); ++part)
    if (m_shadings[part])
      m_shadings[part]->followShadows(m_actors[part], setter);
}

void ToolProps::setLight(const LightSettings& light)
{
  for (std::size_t part = 0; part < m_actors.size(); ++part)
    if (m_shadings[part])
      m_shadings[part]->apply(m_actors[part], light);
}

// Smooth but for its edges.
void ToolProps::shapeInstrument(const ToolPose& tool)
{
  constexpr double kEdge = 30.0; // degrees
  if (tool.instrument == m_instrument)
    return;
  m_instrument = tool.instrument;
  vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(toPolyData(*m_instrument, vertexNormals(*m_instrument)));
  vtkNew<vtkPolyDataNormals> smooth;
  smooth->SetInputConnection(joined->GetOutputPort());
  smooth->SetFeatureAngle(kEdge);
  smooth->Update();
  vtkPolyDataMapper::SafeDownCast(m_actors[kInstrument]->GetMapper())
      ->SetInputData(smooth->GetOutput());
}

void ToolProps::shapeBurr(const ToolPose& tool)
{
  auto* mapper = vtkPolyDataMapper::SafeDownCast(m_actors[0]->GetMapper());
  if (tool.finish == BurrFinish::Smooth)
  {
    m_burr->SetRadius(tool.radius);
    mapper->SetInputConnection(m_burr->GetOutputPort());
    m_actors[0]->SetScale(1.0);
    m_actors[0]->SetOrientation(0.0, 0.0, 0.0);
    return;
  }
  const bool isFluted = tool.finish == BurrFinish::Fluted;
  vtkSmartPointer<vtkPolyData>& shape = isFluted ? m_fluted : m_gritted;
  if (!shape)
    shape = ball(isFluted ? fluted : gritted);
  mapper->SetInputData(shape);
  m_actors[0]->SetScale(tool.radius);
  m_actors[0]->SetOrientation(0.0, tool.turn * 180.0 / kPi, 0.0);
}

} // namespace petrous::rendering
