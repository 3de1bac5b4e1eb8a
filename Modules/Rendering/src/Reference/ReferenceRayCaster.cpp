#include "petrous/Rendering/ReferenceRayCaster.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "OpticalModel.h"
#include "SceneCheck.h"
#include "SurfaceGeometry.h"
#include "TissueRay.h"
#include "petrous/Core/Error.h"
#include "petrous/Rendering/PixelSamples.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{

std::uint8_t toByte(double value)
{
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

double checkedStep(const ReferenceRayCaster::Quality& quality)
{
  if (!(quality.step > 0.0 && quality.step <= 1.0))
    throw core::InvalidParameter("reference picture: the step must lie above 0, up to 1 voxel");
  return quality.step;
}

} // namespace

class ReferenceRayCaster::Implementation
{
public:
  struct Pixel
  {
    Eigen::Vector3d color;
    double depth;
  };

  Implementation(const SceneContents& contents, const Quality& quality)
    : m_shapes(contents)
    , m_hasShadows(contents.light.shadows)
    , m_background(contents.background[0], contents.background[1], contents.background[2])
  {
    const double step = checkedStep(quality);
    checkContents(contents);
    if (contents.ct)
      m_tissue.emplace(contents, step, quality.sample);
    if (quality.sample >= 0)
      m_place = pixelSample(quality.sample);
  }

  Pixel see(const PixelRay& ray, const optics::Lamp& lamp) const;
  /// Right and down of a pixel's centre, pixels.
  const std::array<double, 2>& place() const noexcept { return m_place; }

private:
  GatheredLight gather(const PixelRay& ray, double end, const optics::Lamp& lamp) const;

  SurfaceGeometry m_shapes;
  bool m_hasShadows;
  std::array<double, 2> m_place{};
  Eigen::Vector3d m_background;
  std::optional<TissueRay> m_tissue;
};

GatheredLight ReferenceRayCaster::Implementation::gather(const PixelRay& ray, double end,
                                                         const optics::Lamp& lamp) const
{
  return m_tissue ? m_tissue->cast(ray, end, lamp) : GatheredLight();
}

ReferenceRayCaster::Implementation::Pixel
ReferenceRayCaster::Implementation::see(const PixelRay& ray, const optics::Lamp& lamp) const
{
  Eigen::Vector3d color = Eigen::Vector3d::Zero();
  double visible = 1.0; // fraction of the pixels not yet covered by a screen door
  SurfaceGeometry::Seeing seeing;
  if (m_hasShadows && m_tissue)
    seeing = [&](const Eigen::Vector3d& point, const Eigen::Vector3d& normal, bool isTool)
    {
      using Of = SurfaceShadows::Of;
      return m_tissue->shadows().at(point, normal, lamp, isTool ? Of::Tool : Of::Mesh);
    };
  for (const SurfaceGeometry::Hit& hit : m_shapes.along(ray, lamp.focus, seeing))
  {
    const GatheredLight light = gather(ray, hit.distance, lamp);
    color += visible * hit.opacity * (light.color + light.transmittance * hit.color);
    visible *= 1.0 - hit.opacity;
    if (!(visible > 0.0))
      return {color, light.depth};
  }
  const GatheredLight light = gather(ray, std::numeric_limits<double>::infinity(), lamp);
  return {color + visible * (light.color + light.transmittance * m_background), light.depth};
}

ReferenceRayCaster::ReferenceRayCaster(const SceneContents& contents)
  : ReferenceRayCaster(contents, Quality())
{
}

ReferenceRayCaster::ReferenceRayCaster(const SceneContents& contents, const Quality& quality)
  : m_implementation(std::make_unique<Implementation>(contents, quality))
{
}

ReferenceRayCaster::~ReferenceRayCaster() = default;

ReferencePicture ReferenceRayCaster::render(const core::CameraPose& camera, int width, int height,
                                            const core::Progress& progress) const
{
  if (width < 1 || height < 1)
    throw RenderingError(RenderingError::Reason::BadSize, "a picture of " + std::to_string(width) +
                                                              " x " + std::to_string(height) +
                                                              " pixels; at least 1 x 1 is needed");
  const PixelRays rays(camera, width, height);
  const optics::Lamp lamp = optics::lampOf(camera);
  const auto [right, down] = m_implementation->place();
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ReferencePicture result;
  result.picture = {width, height, std::vector<std::uint8_t>(3 * pixels)};
  result.rgb.resize(3 * pixels);
  result.depth = {width, height, std::vector<float>(pixels)};

  const auto drawPixel = [&, right = right, down = down](int column, int row)
  {
    const std::size_t index = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(column);
    const Implementation::Pixel pixel =
        m_implementation->see(rays.through(column + right, row + down), lamp);
    result.depth.millimetres[index] = static_cast<float>(pixel.depth);
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      const double value = pixel.color[static_cast<Eigen::Index>(channel)];
      result.rgb[3 * index + channel] = static_cast<float>(value);
      result.picture.rgb[3 * index + channel] = toByte(value);
    }
  };

  std::atomic<int> done{0};
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 1),
                    [&](const tbb::blocked_range<int>& rows)
                    {
                      for (int row = rows.begin(); row < rows.end(); ++row)
                      {
                        progress.check("reference picture");
                        for (int column = 0; column < width; ++column)
                          drawPixel(column, row);
                        progress.report(static_cast<double>(++done) / height, "reference picture");
                      }
                    });
  return result;
}

} // namespace petrous::rendering
