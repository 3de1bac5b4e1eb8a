#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace petrous::rendering
{

constexpr std::size_t kMaxPlanes = 6; ///< that a picture can be clipped by

/// What a variant of the ray caster's shader is compiled with.
struct RayFeatures
{
  bool bone = false;      ///< the CT's own surface
  bool labels = false;    ///< structures
  bool borders = false;   ///< structures that touch
  bool nested = false;    ///< structures can be looked into
  bool mask = false;      ///< the cut
  bool second = false;    ///< a second image that some materials read
  bool interior = false;  ///< tissue can be looked into
  bool clip = false;      ///< clipping planes
  bool thickness = false; ///< bone is coloured by its distance to a structure
  bool count = false;     ///< fetches and samples are counted

  unsigned key() const noexcept;          ///< another one for each variant
  std::vector<std::string> names() const; ///< "ct" and what is added to it; counting is not named
};

/// The fragment shader of a variant (for GlProgram). Numbers that OpticalModel.h and
/// OccupancyGrid.h state are written into it.
std::string rayFragmentShader(const RayFeatures& features);

} // namespace petrous::rendering
