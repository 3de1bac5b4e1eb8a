#include "BoneVolume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include "BoneColor.h"
#include "BoneSurfaceShader.h"
#include "petrous/Rendering/VtkVolume.h"

namespace petrous::rendering
{

namespace
{
constexpr double kFieldScale = 1000.0; // HU; as the tissue field's default
constexpr double kStep = 0.5;          // of the smallest spacing
constexpr double kInteractiveStep = 1.0;
constexpr float kInteractivePixels = 2.5F; // edge of an image sample while something moves

// The mapper's texture holds 16-bit integers normalised; r * unit is the value in the CT's unit.
double textureUnit(const volume::IntensityVolume& ct)
{
  return ct.visit(
      [](const auto& volume)
      {
        using T = typename std::decay_t<decltype(volume)>::Value;
        return std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
      });
}

template <class T>
T maskValue(std::uint16_t left)
{
  if constexpr (std::is_same_v<T, std::int16_t>)
    return static_cast<T>(left >> 1);
  else if constexpr (std::is_same_v<T, std::uint16_t>)
    return left;
  else
    return static_cast<T>(left) / static_cast<T>(volume::CutMask::kUntouched);
}

template <class T>
void combine(const volume::Volume<T>& ct, const volume::CutMask& mask, const core::IndexBox& box,
             T* out)
{
  const core::IndexBox bricks = mask.bricksCovering(box);
  const auto combineBrick = [&](std::size_t brick)
  {
    const core::IndexBox part = mask.brickBox(brick).intersected(box);
    const bool whole = !mask.brick(brick);
    for (int k = part.lower[2]; k < part.upper[2]; ++k)
      for (int j = part.lower[1]; j < part.upper[1]; ++j)
      {
        const std::size_t first = ct.geometry().linearIndex(part.lower[0], j, k);
        T* pair = out + 2 * first;
        for (int i = part.lower[0]; i < part.upper[0]; ++i, pair += 2)
        {
          pair[0] = ct.data()[first + static_cast<std::size_t>(i - part.lower[0])];
          pair[1] = maskValue<T>(whole ? volume::CutMask::kUntouched : mask.at(i, j, k));
        }
      }
  };
  tbb::parallel_for(tbb::blocked_range<int>(bricks.lower[2], bricks.upper[2]),
                    [&](const tbb::blocked_range<int>& layers)
                    {
                      for (int k = layers.begin(); k < layers.end(); ++k)
                        for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
                          for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
                            combineBrick(mask.brickIndex({i, j, k}));
                    });
}

bool drawable(const volume::IntensityVolume* ct)
{
  // A grid one sample thin has a hull without a volume: the field is air everywhere.
  return ct && *std::min_element(ct->geometry().dims().begin(), ct->geometry().dims().end()) > 1;
}

} // namespace

BoneVolume::BoneVolume()
{
  m_mapper->SetBlendModeToComposite();
  m_mapper->SetAutoAdjustSampleDistances(0);
  m_mapper->SetLockSampleDistanceToInputSpacing(0);
  m_mapper->SetUseJittering(0);
  m_mapper->SetMaskTypeToBinary();
  m_prop->SetMapper(m_mapper);
  m_prop->SetVisibility(0);
  m_prop->PickableOff();
  // Not used by the shader, but the mapper insists on tables.
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.0, 1.0);
  vtkVolumeProperty* property = m_prop->GetProperty();
  property->SetColor(color);
  property->SetScalarOpacity(opacity);
  property->SetInterpolationTypeToLinear();
  property->SetShade(0);
}

BoneVolume::~BoneVolume() = default;

vtkVolume* BoneVolume::prop() const
{
  return m_prop;
}

bool BoneVolume::isCut() const
{
  return m_mask && !m_mask->untouched();
}

void BoneVolume::setContents(std::shared_ptr<const volume::IntensityVolume> ct, double iso,
                             std::shared_ptr<const volume::CutMask> mask,
                             const LightSettings& light)
{
  const bool newCt = ct != m_ct;
  m_ct = std::move(ct);
  m_iso = iso;
  m_mask = std::move(mask);
  m_light = light;
  m_prop->SetVisibility(drawable(m_ct.get()) ? 1 : 0);
  if (newCt)
  {
    m_plain = nullptr;
    m_combined = nullptr;
    m_cells.reset();
    m_mapper->SetMaskInput(nullptr);
    m_mapper->RemoveAllInputs();
  }
  if (!drawable(m_ct.get()))
    return;
  if (newCt)
  {
    const core::GridGeometry& grid = m_ct->geometry();
    m_plain = wrap(*m_ct);
    // The mapper does not know directions: the voxels lie along the axes, the prop turns them.
    m_plain->SetOrigin(0.0, 0.0, 0.0);
    m_plain->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
    vtkNew<vtkMatrix4x4> pose;
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
        pose->SetElement(row, column, grid.direction()(row, column));
      pose->SetElement(row, 3, grid.origin()[row]);
    }
    m_prop->SetUserMatrix(pose);
    m_cells = std::make_unique<MacroCells>(*m_ct);
    m_mapper->SetMaskInput(m_cells->distances());
  }
  if (m_combined && isCut())
    maskChanged(m_mask, m_ct->geometry().fullBox());
  else
    updateInput();
  updateUniforms();
}

void BoneVolume::maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box)
{
  m_mask = std::move(mask);
  if (!m_plain)
    return;
  if (m_combined && isCut())
  {
    m_ct->visit(
        [&](const auto& volume)
        {
          using T = typename std::decay_t<decltype(volume)>::Value;
          combine(volume, *m_mask, box.intersected(volume.geometry().fullBox()),
                  static_cast<T*>(m_combined->GetScalarPointer()));
        });
    m_combined->GetPointData()->GetScalars()->Modified();
    m_combined->Modified();
    m_cells->update(m_iso, m_mask.get());
    return;
  }
  updateInput();
  updateUniforms();
}

void BoneVolume::updateInput()
{
  const core::GridGeometry& grid = m_ct->geometry();
  if (!isCut())
    m_combined = nullptr;
  else if (!m_combined)
  {
    m_combined = vtkSmartPointer<vtkImageData>::New();
    m_combined->CopyStructure(m_plain);
    m_ct->visit(
        [&](const auto& volume)
        {
          using T = typename std::decay_t<decltype(volume)>::Value;
          m_combined->AllocateScalars(m_plain->GetScalarType(), 2);
          combine(volume, *m_mask, grid.fullBox(), static_cast<T*>(m_combined->GetScalarPointer()));
        });
  }
  m_mapper->SetInputData(m_combined ? m_combined : m_plain);
  m_cells->update(m_iso, isCut() ? m_mask.get() : nullptr);
  updateShader();
  setInteractive(false);
}

void BoneVolume::updateShader()
{
  const int variant = m_combined ? 1 : 0;
  if (variant == m_shaderVariant)
    return;
  m_shaderVariant = variant;
  m_prop->GetProperty()->SetIndependentComponents(m_combined ? 0 : 1);
  vtkShaderProperty* shader = m_prop->GetShaderProperty();
  shader->ClearAllFragmentShaderReplacements();
  const std::string rayDirection = "//VTK::ComputeRayDirection::Dec";
  shader->AddFragmentShaderReplacement(rayDirection, true,
                                       rayDirection + "\n" +
                                           (m_combined ? "#define PETROUS_MASK\n" : "") +
                                           std::string(kBoneSurfaceShader),
                                       false);
  shader->AddFragmentShaderReplacement("//VTK::Shading::Init", true,
                                       "g_fragColor = castBone();\n  g_exit = true;", false);
  for (const char* unused :
       {"//VTK::Shading::Impl", "//VTK::Shading::Exit", "//VTK::BinaryMask::Impl"})
    shader->AddFragmentShaderReplacement(unused, true, "", false);
}

void BoneVolume::updateUniforms()
{
  const core::GridGeometry& grid = m_ct->geometry();
  const double unit = textureUnit(*m_ct);
  const BoneColor color(m_iso);
  const auto toFloat = [](double value) { return static_cast<float>(value); };
  const auto vector = [&](const Eigen::Vector3d& v) {
    return std::array<float, 3>{toFloat(v[0]), toFloat(v[1]), toFloat(v[2])};
  };
  vtkUniforms* uniforms = m_prop->GetShaderProperty()->GetFragmentCustomUniforms();
  uniforms->SetUniformf("p_iso", toFloat(m_iso / unit));
  uniforms->SetUniformf("p_perHu", toFloat(unit / kFieldScale));
  const float ramp[2] = {toFloat(color.cellularValue / unit), toFloat(color.corticalValue / unit)};
  uniforms->SetUniform2f("p_ramp", ramp);
  uniforms->SetUniform3f("p_cellular", vector(color.cellular).data());
  uniforms->SetUniform3f("p_cortical", vector(color.cortical).data());
  uniforms->SetUniform3f("p_spacing", vector(grid.spacing()).data());
  const core::Index3& dims = grid.dims();
  uniforms->SetUniform3f("p_dims", vector(Eigen::Vector3d(dims[0], dims[1], dims[2])).data());
  const float light[4] = {toFloat(m_light.ambient), toFloat(m_light.specular),
                          toFloat(m_light.shininess), toFloat(m_light.intensity)};
  uniforms->SetUniform4f("p_light", light);
  uniforms->SetUniformf("p_colorDepth", toFloat(BoneColor::kDepth * grid.minSpacing()));
}

void BoneVolume::setInteractive(bool interactive)
{
  if (!m_plain)
    return;
  const double h = m_ct->geometry().minSpacing();
  m_mapper->SetSampleDistance(static_cast<float>(h * (interactive ? kInteractiveStep : kStep)));
  m_mapper->SetImageSampleDistance(interactive ? kInteractivePixels : 1.0F);
}

void BoneVolume::addResources(std::map<std::string, std::size_t>& resources) const
{
  if (!m_ct)
    return;
  resources["ct.voxels"] = m_ct->bytes();
  if (m_cells)
    resources["ct.macrocells"] = m_cells->bytes();
  if (isCut())
    resources["mask.bricks"] = m_mask->residentBytes();
  if (m_combined)
    resources["mask.combined"] = 2 * m_ct->bytes();
  if (m_plain)
    resources["ct.texture"] = m_ct->bytes() * (m_combined ? 2 : 1);
}

} // namespace petrous::rendering
