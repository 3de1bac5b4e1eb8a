#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "petrous/Core/TriangleMesh.h"
#include "petrous/Rendering/SceneContents.h"

class vtkActor;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkProperty;

namespace petrous::rendering
{

class GlUniforms;

/// Triangles with vertex normals of any orientation.
vtkSmartPointer<vtkPolyData> toPolyData(const core::TriangleMesh& mesh,
                                        const std::vector<Eigen::Vector3f>& normals);

/// Area-weighted vertex normals.
std::vector<Eigen::Vector3f> vertexNormals(const core::TriangleMesh& mesh);

/// RGB, 0 to 1; highlights stay white, as in the optical model (vtkProperty::SetColor tints them).
void setLitColor(vtkProperty* property, double red, double green, double blue);

/// Sets the uniforms of an OpenGL program that is in use.
using ProgramSetter = std::function<void(GlUniforms& program)>;

/// What is injected into VTK's polygon shader so that an actor's lit colours are displayed as the
/// ray caster's are: gloss, shadows, exposure, tone curve and screen-door transparency; the last
/// four where they are used.
class PolygonShading
{
public:
  /// Without, nothing lies in shadow. `setter`: of polygonShadowsShader (RayShader.h), called
  /// whenever the actor is drawn. Once.
  void followShadows(vtkActor* actor, ProgramSetter setter);

  /// `pattern` offsets the screen door of an opacity below 1.
  void apply(vtkActor* actor, const LightSettings& light, float opacity = 1.0F, int pattern = 0);

private:
  std::string m_code; // injected
  bool m_followsShadows = false;
};

/// A surface shaded like bone, with screen-door transparency.
class SurfaceActor
{
public:
  /// `pattern` offsets the screen door, so that neighbours in a list do not share it.
  /// `shadows`: see PolygonShading.
  explicit SurfaceActor(int pattern, ProgramSetter shadows = {});
  ~SurfaceActor();

  vtkActor* prop() const;
  void setSurface(vtkPolyData* surface);
  void setLook(const appearance::StructureAppearance& look, const LightSettings& light);
  /// Not lit: in the very colour of the look.
  void setPlainLook(const appearance::StructureAppearance& look);

private:
  int m_pattern;
  PolygonShading m_shading;
  vtkNew<vtkPolyDataMapper> m_mapper;
  vtkNew<vtkActor> m_actor;
};

} // namespace petrous::rendering
