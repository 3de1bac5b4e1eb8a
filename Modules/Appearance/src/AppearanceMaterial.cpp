#include "petrous/Appearance/AppearanceMaterial.h"

#include <cmath>
#include <set>
#include <utility>

namespace petrous::appearance
{

double onScale(double value, const volume::IntensityScale& scale) noexcept
{
  const volume::IntensityScale hounsfield;
  const double width = hounsfield.dense - hounsfield.iso;
  const double dense = scale.dense > scale.iso ? scale.dense : scale.iso + width;
  return scale.iso + (value - hounsfield.iso) * (dense - scale.iso) / width;
}

TransferFunction onScale(const TransferFunction& transfer, const volume::IntensityScale& scale)
{
  std::vector<ControlPoint> points = transfer.points();
  for (ControlPoint& point : points)
    point.value = onScale(point.value, scale);
  return TransferFunction(std::move(points));
}

Material materialOf(const StructureAppearance& look, const volume::IntensityScale& scale)
{
  Material material;
  const bool ofMr = !look.sourceImage.empty();
  if (!look.transfer || (ofMr && look.relative))
    material.transfer = TransferFunction::constant(look.color, kPlainOpacity * look.opacity);
  else
  {
    material.transfer = look.relative ? onScale(*look.transfer, scale) : *look.transfer;
    material.source = ofMr ? IntensitySource::Second : IntensitySource::Ct;
  }
  material.surfaceOpacity = look.opacity;
  material.shininess = look.shininess;
  material.lumen = !look.solid;
  return material;
}

Material lumenMaterial(const StructureAppearance& look, const Material& bone,
                       const volume::IntensityScale& scale)
{
  // A lumen holds air: the transfer function reads the bone of its wall, in the CT.
  StructureAppearance onBone = look;
  onBone.sourceImage.clear();
  Material material = materialOf(onBone, scale);
  std::set<double> values;
  for (const ControlPoint& point : material.transfer.points())
    values.insert(point.value);
  for (const ControlPoint& point : bone.transfer.points())
    values.insert(point.value);
  const auto mix = [share = look.opacity](double a, double b)
  { return static_cast<float>(a + (b - a) * static_cast<double>(share)); };
  std::vector<ControlPoint> points;
  for (const double value : values)
  {
    const auto wall = bone.transfer.at(value);
    const auto own = material.transfer.at(value);
    ControlPoint point;
    point.value = value;
    for (std::size_t c = 0; c < 3; ++c)
      point.color[c] = mix(wall.color[c], own.color[c]);
    point.opacity = static_cast<float>(-std::expm1(-wall.extinction));
    point.specular = mix(wall.specular, own.specular);
    points.push_back(point);
  }
  material.transfer = TransferFunction(std::move(points));
  material.surfaceOpacity = bone.surfaceOpacity;
  return material;
}

std::optional<Material> softTissueMaterial(const StructureAppearance& look,
                                           const volume::IntensityScale& scale)
{
  constexpr double kFoot = 0.05; // of the function's width
  if (!look.transfer || look.transfer->points().size() < 2 ||
      (look.relative && !look.sourceImage.empty()))
    return std::nullopt;
  Material material = materialOf(look, scale);
  std::vector<ControlPoint> points = material.transfer.points();
  for (ControlPoint& point : points)
    point.opacity *= look.opacity;
  if (points.front().opacity > 0.0F)
  {
    ControlPoint foot = points.front();
    foot.value -= kFoot * (points.back().value - points.front().value);
    foot.opacity = 0.0F;
    points.insert(points.begin(), foot);
  }
  material.transfer = TransferFunction(std::move(points));
  return material.transfer.transparent() ? std::nullopt : std::optional(std::move(material));
}

TransferFunction softTissueOfMr(const volume::IntensityScale& scale)
{
  const auto at = [&scale](double share, float grey, float opacity)
  {
    constexpr float kSpecular = 0.2F;
    return ControlPoint{
        scale.iso + share * (scale.dense - scale.iso), {grey, grey, grey}, opacity, kSpecular};
  };
  return TransferFunction({at(0.0, 0.25F, 0.0F), at(0.25, 0.4F, 0.02F), at(1.0, 0.95F, 0.1F)});
}

} // namespace petrous::appearance
