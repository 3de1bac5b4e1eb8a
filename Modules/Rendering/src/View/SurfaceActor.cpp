#include "SurfaceActor.h"

#include <utility>

#include <Eigen/Geometry>

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProgram.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>
#include <vtkWeakPointer.h>

#include "GlProgram.h"
#include "OpticalModel.h"
#include "RayShader.h"
#include "ScreenDoorShader.h"

namespace petrous::rendering
{

namespace
{
// VTK's highlight falls off as cos(2a)^n, a being the angle between normal and view direction. For
// small angles this equals the optical model's cos(a)^n with a quarter of the exponent.
constexpr double kHighlight = 0.25;

// By the parts of which VTK's shader has just made the colour: what the gloss takes from the
// diffuse light (surfaceColor in OpticalModel.h), and what reaches the surface. The light is at the
// camera.
constexpr const char* kGloss =
    "vec3 toEye = cameraParallel != 0 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);\n"
    "float facing = dot(normalVCVSOutput, toEye);\n"
    "diffuse *= max(1.0 - p_gloss * facing * facing, 0.0);\n"
    "if (cameraParallel != 0)\n" // VTK's highlight is that of a perspective
    "  specular = specularColor * pow(max(facing, 0.0), 4.0 * specularPower);\n"
    "gl_FragData[0].rgb = ambientColor + diffuse + specular;\n";
constexpr const char* kShadowed =
    "Seen seen = polygonSeen(vertexVC.xyz, normalVCVSOutput);\n"
    "gl_FragData[0].rgb = seen.sky * ambientColor + seen.lamp * (diffuse + specular);\n";

// A setter, and the locations of the uniforms of the program with which the actor was drawn last.
class ProgramFollower
{
public:
  explicit ProgramFollower(ProgramSetter setter)
    : m_setter(std::move(setter))
  {
  }

  void set(vtkShaderProgram* program)
  {
    if (program != m_program || program->GetHandle() != m_handle)
    {
      m_program = program;
      m_handle = program->GetHandle();
      m_uniforms = GlUniforms(static_cast<GLuint>(m_handle));
    }
    m_setter(m_uniforms);
  }

private:
  ProgramSetter m_setter;
  vtkWeakPointer<vtkShaderProgram> m_program; // OpenGL gives names of deleted programs again
  int m_handle = 0;
  GlUniforms m_uniforms;
};
} // namespace

vtkSmartPointer<vtkPolyData> toPolyData(const core::TriangleMesh& mesh,
                                        const std::vector<Eigen::Vector3f>& normals)
{
  const auto count = static_cast<vtkIdType>(mesh.vertices.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(count);
  vtkNew<vtkFloatArray> directions;
  directions->SetName("Normals");
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const auto v = static_cast<std::size_t>(i);
    points->SetPoint(i, mesh.vertices[v].cast<double>().eval().data());
    directions->SetTypedTuple(i, normals[v].data());
  }
  vtkNew<vtkIdTypeArray> connectivity;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(3 * mesh.triangles.size()));
  vtkIdType* corner = connectivity->GetPointer(0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle)
      *corner++ = vertex;
  vtkNew<vtkCellArray> cells;
  cells->SetData(3, connectivity);

  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  surface->GetPointData()->SetNormals(directions);
  return surface;
}

std::vector<Eigen::Vector3f> vertexNormals(const core::TriangleMesh& mesh)
{
  std::vector<Eigen::Vector3f> normals(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3f& a = mesh.vertices[triangle[0]];
    const Eigen::Vector3f twiceArea =
        (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
    for (const std::uint32_t vertex : triangle)
      normals[vertex] += twiceArea;
  }
  for (Eigen::Vector3f& normal : normals)
    if (normal.squaredNorm() > 0.0F)
      normal.normalize();
  return normals;
}

void setLitColor(vtkProperty* property, double red, double green, double blue)
{
  property->SetAmbientColor(red, green, blue);
  property->SetDiffuseColor(red, green, blue);
}

void PolygonShading::followShadows(vtkActor* actor, ProgramSetter setter)
{
  if (!setter)
    return;
  m_followsShadows = true;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new ProgramFollower(std::move(setter)));
  command->SetClientDataDeleteCallback([](void* data)
                                       { delete static_cast<ProgramFollower*>(data); });
  command->SetCallback(
      [](vtkObject*, unsigned long, void* data, void* program)
      { static_cast<ProgramFollower*>(data)->set(static_cast<vtkShaderProgram*>(program)); });
  actor->GetMapper()->AddObserver(vtkCommand::UpdateShaderEvent, command);
}

void PolygonShading::apply(vtkActor* actor, const LightSettings& light, float opacity, int pattern)
{
  const bool isExposed = light.exposure != 0.0;
  const bool hasPattern = opacity < 1.0F;
  const bool isShadowed = light.shadows && m_followsShadows;
  std::string code = kGloss;
  if (isShadowed)
    code += kShadowed;
  if (isExposed)
    code += "gl_FragData[0].rgb *= p_exposure;\n";
  if (light.toneCurve)
    code += "gl_FragData[0].rgb = toneCurve(gl_FragData[0].rgb);\n";
  if (hasPattern)
    code += kScreenDoorShader;
  vtkShaderProperty* shader = actor->GetShaderProperty();
  if (code != m_code)
  {
    m_code = code;
    shader->ClearAllFragmentShaderReplacements();
    shader->GetFragmentCustomUniforms()->RemoveAllUniforms();
    const std::string functions = (isShadowed ? polygonShadowsShader() : std::string()) +
                                  (light.toneCurve ? toneCurveShader() : std::string());
    if (!functions.empty())
      shader->AddFragmentShaderReplacement("//VTK::Light::Dec", true,
                                           "//VTK::Light::Dec\n" + functions, false);
    // VTK sets it, but declares it only where surfaces have no normals.
    shader->AddFragmentShaderReplacement("//VTK::Camera::Dec", true,
                                         "uniform int cameraParallel;\n", false);
    shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, "//VTK::Light::Impl\n" + code,
                                         false);
  }
  vtkUniforms* uniforms = shader->GetFragmentCustomUniforms();
  vtkProperty* property = actor->GetProperty();
  const double lambert = property->GetDiffuse();
  uniforms->SetUniformf(
      "p_gloss", lambert > 0.0 ? static_cast<float>(property->GetSpecular() / lambert) : 0.0F);
  if (isExposed)
    uniforms->SetUniformf("p_exposure", static_cast<float>(optics::exposureFactor(light.exposure)));
  if (hasPattern)
  {
    uniforms->SetUniformf("p_opacity", opacity);
    uniforms->SetUniformi("p_shift", 5 * pattern);
  }
}

SurfaceActor::SurfaceActor(int pattern, ProgramSetter shadows)
  : m_pattern(pattern)
{
  m_mapper->ScalarVisibilityOff();
  m_actor->SetMapper(m_mapper);
  m_shading.followShadows(m_actor, std::move(shadows));
  m_actor->SetVisibility(0);
}

SurfaceActor::~SurfaceActor() = default;

vtkActor* SurfaceActor::prop() const
{
  return m_actor;
}

void SurfaceActor::setSurface(vtkPolyData* surface)
{
  m_mapper->SetInputData(surface);
}

void SurfaceActor::setLook(const appearance::StructureAppearance& look, const LightSettings& light)
{
  m_actor->SetVisibility(look.shown && look.opacity > 0.0F ? 1 : 0);
  vtkProperty* property = m_actor->GetProperty();
  setLitColor(property, look.color[0], look.color[1], look.color[2]);
  property->SetInterpolationToPhong();
  property->SetAmbient(light.ambient * light.intensity);
  property->SetDiffuse((1.0 - light.ambient) * light.intensity);
  property->SetSpecular(light.specular * light.intensity);
  property->SetSpecularPower(kHighlight * light.shininess);

  m_shading.apply(m_actor, light, look.opacity, m_pattern);
}

void SurfaceActor::setPlainLook(const appearance::StructureAppearance& look)
{
  LightSettings ambient;
  ambient.ambient = 1.0;
  ambient.specular = 0.0;
  setLook(look, ambient);
}

} // namespace petrous::rendering
