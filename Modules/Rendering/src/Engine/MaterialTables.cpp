#include <algorithm>
#include <array>

#include "OpticalModel.h"
#include "SceneTextures.h"

namespace petrous::rendering
{

void MaterialTables::upload(const std::vector<appearance::Material>& materials, int tableSize,
                            const std::array<volume::ValueRange, 3>& ranges)
{
  const std::size_t rows = materials.size();
  const auto width = static_cast<std::size_t>(tableSize);
  std::vector<float> looks(rows * width * 4);
  std::vector<float> integrals(rows * width * 4);
  std::vector<float> parameters(rows * 8, 0.0F);
  for (std::size_t row = 0; row < rows; ++row)
  {
    const appearance::Material& tissue = materials[row];
    const auto& points = tissue.transfer.points();
    const auto source = static_cast<std::size_t>(tissue.source);
    const volume::ValueRange& range = ranges[source];
    double lower = points.front().value;
    double upper = points.back().value;
    if (points.size() > 1)
    {
      // Outside its points the function is constant, but a ray segment may begin there. If the
      // image's range is much wider, resolution takes precedence.
      const double most = 4.0 * (upper - lower);
      lower = std::max(std::min(lower, range.min), lower - most);
      upper = std::min(std::max(upper, range.max), upper + most);
    }
    else
    {
      lower -= 1.0;
      upper += 1.0;
    }
    const auto optics = [&](double x)
    { return tissue.transfer.at(lower + (upper - lower) * x / (tableSize - 1.0)); };
    std::array<double, 4> sum{};
    for (std::size_t i = 0; i < width; ++i)
    {
      const auto here = optics(static_cast<double>(i));
      float* color = &looks[(row * width + i) * 4];
      float* integral = &integrals[(row * width + i) * 4];
      if (i > 0)
      {
        // Simpson's rule over eight subintervals: colour times extinction is not linear.
        constexpr int parts = 8;
        for (int p = 0; p <= parts; ++p)
        {
          const auto at = optics(static_cast<double>(i - 1) + static_cast<double>(p) / parts);
          const double weight = (p == 0 || p == parts ? 1.0 : (p % 2 ? 4.0 : 2.0)) /
                                (3.0 * parts * (tableSize - 1.0));
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += weight * at.extinction * at.color[c];
          sum[3] += weight * at.extinction;
        }
      }
      for (std::size_t c = 0; c < 3; ++c)
      {
        color[c] = static_cast<float>(here.color[c]);
        integral[c] = static_cast<float>(sum[c]);
      }
      color[3] = static_cast<float>(here.specular);
      integral[3] = static_cast<float>(sum[3]);
    }
    float* parameter = &parameters[row * 8];
    parameter[0] = static_cast<float>(lower);
    parameter[1] = static_cast<float>(1.0 / (upper - lower));
    parameter[2] = tissue.surfaceOpacity;
    parameter[3] = tissue.shininess;
    parameter[4] = tissue.lumen ? 1.0F : 0.0F;
    parameter[5] = static_cast<float>(source);
    parameter[6] = static_cast<float>(optics::softEdge(tissue.transfer));
  }
  const int height = static_cast<int>(rows);
  look.create(texel::kColor, tableSize, height, looks.data(), GL_LINEAR);
  depth.create(texel::kFloat4, tableSize, height, integrals.data(), GL_NEAREST);
  material.create(texel::kFloat4, 2, height, parameters.data(), GL_NEAREST);
}

void MaterialTables::release()
{
  look.release();
  depth.release();
  material.release();
}

} // namespace petrous::rendering
