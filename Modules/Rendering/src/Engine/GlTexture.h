#pragma once

#include <array>
#include <cstddef>

#include <vtk_glew.h>

#include "petrous/Core/GridGeometry.h"

namespace petrous::rendering
{

/// Texel layout in the texture and in memory.
struct TexelFormat
{
  GLint internal;
  GLenum layout;
  GLenum type;
  std::size_t bytes; ///< per texel
};

namespace texel
{
constexpr TexelFormat kByte{GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1};
constexpr TexelFormat kShort{GL_R16_SNORM, GL_RED, GL_SHORT, 2};
constexpr TexelFormat kUnsignedShort{GL_R16, GL_RED, GL_UNSIGNED_SHORT, 2};
constexpr TexelFormat kFloat{GL_R32F, GL_RED, GL_FLOAT, 4};
constexpr TexelFormat kBytePair{GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2};
constexpr TexelFormat kIndex{GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1};
constexpr TexelFormat kIndexPair{GL_RG8UI, GL_RG_INTEGER, GL_UNSIGNED_BYTE, 2};
constexpr TexelFormat kBrick{GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, 4};
constexpr TexelFormat kColor{GL_RGBA16F, GL_RGBA, GL_FLOAT, 16};
constexpr TexelFormat kFloat4{GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
constexpr TexelFormat kFloat2{GL_RG32F, GL_RG, GL_FLOAT, 8};
} // namespace texel

/// A texture of the current context. Must be released explicitly while that context is current: a
/// destructor may run after the context is gone.
class GlTexture
{
public:
  GlTexture() = default;
  GlTexture(const GlTexture&) = delete;
  GlTexture& operator=(const GlTexture&) = delete;

  /// Whether the driver accepts a 3D texture of this size.
  static bool fits(const TexelFormat& format, const core::Index3& dims);

  /// (Re)creates the texture; `data` may be null. filter: GL_LINEAR or GL_NEAREST. Clamped to edge.
  /// Throws RenderingError NoOpenGL if the driver runs out of memory.
  void create(const TexelFormat& format, const core::Index3& dims, const void* data, GLint filter);
  /// With `levels` of half the texels of the one before along each axis, linear within each; filled
  /// by `update`.
  void createPyramid(const TexelFormat& format, const core::Index3& dims, int levels);
  void create(const TexelFormat& format, int width, int height, const void* data, GLint filter);

  /// Uploads a box of texels, first axis fastest.
  void update(const core::IndexBox& box, const void* data, int level = 0);

  /// Sets all texels to one value in the format's memory layout.
  void fill(const void* texel);

  void bind(int unit) const;
  void release();

  explicit operator bool() const noexcept { return m_name != 0; }
  GLuint name() const noexcept { return m_name; }
  const core::Index3& dims() const noexcept { return m_dims; }
  std::size_t bytes() const noexcept { return m_bytes; }

private:
  void make(GLenum target, const TexelFormat& format, const core::Index3& dims, const void* data,
            GLint filter);

  GLuint m_name = 0;
  GLenum m_target = GL_TEXTURE_3D;
  TexelFormat m_format = texel::kByte;
  core::Index3 m_dims{0, 0, 0};
  std::size_t m_bytes = 0;
};

} // namespace petrous::rendering
