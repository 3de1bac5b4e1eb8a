#include "CardFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "FilterWeightsShader.h"
#include "GlTexture.h"
#include "RayCastVertexShader.h"
#include "petrous/Rendering/RenderQuality.h"

namespace petrous::rendering
{

int measureFilterBits(ScreenTriangle& triangle)
{
  constexpr int kColumns = 1021; // no multiple of the weights' denominators
  constexpr std::array<std::uint16_t, 2> ends{0, 0xffff};
  GlTexture image, drawn;
  GlProgram program;
  GLuint framebuffer = 0;
  std::array<float, kColumns> weights{};
  image.create(texel::kUnsignedShort, core::Index3{2, 1, 1}, ends.data(), GL_LINEAR);
  drawn.create(texel::kFloat, kColumns, 1, nullptr, GL_NEAREST);
  program.build(kRayCastVertexShader, kFilterWeightsShader);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, drawn.name(), 0);
  const GLenum buffer = GL_COLOR_ATTACHMENT0;
  glDrawBuffers(1, &buffer);
  glReadBuffer(buffer);
  glViewport(0, 0, kColumns, 1);
  program.use();
  image.bind(0);
  program.set("image", 0);
  program.set("columns", double(kColumns));
  triangle.draw();
  glReadPixels(0, 0, kColumns, 1, GL_RED, GL_FLOAT, weights.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
  program.release();
  drawn.release();
  image.release();
  double error = 0.0;
  for (int n = 0; n < kColumns; ++n)
    error = std::max(error, std::abs((n + 0.5) / kColumns -
                                     static_cast<double>(weights[static_cast<std::size_t>(n)])));
  // Weights rounded to the nearest of 2^bits are off by half of one at most; the margin is for what
  // the coordinate's own arithmetic adds.
  const double bits = -std::log2(std::max(2.0 * error / 1.1, 1e-6));
  return std::clamp(static_cast<int>(std::floor(bits)), 4, RenderQuality::kExactFilterBits);
}

} // namespace petrous::rendering
