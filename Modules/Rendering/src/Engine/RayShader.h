#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace petrous::rendering
{

constexpr std::size_t kMaxPlanes = 6; ///< max. number of clipping planes
constexpr double kSliceGrowth = 2.5;  ///< of the distances along a cone of the sky

/// Compile-time features of a variant of the ray caster's shader.
struct RayFeatures
{
  bool bone = false;       ///< the CT's isosurface
  bool labels = false;     ///< structures
  bool borders = false;    ///< touching structures
  bool nested = false;     ///< translucent structures
  bool mask = false;       ///< the cut mask
  bool second = false;     ///< images beside the CT that some materials read
  bool third = false;      ///< two of them; with `second`
  bool interior = false;   ///< translucent tissue
  bool edges = false;      ///< its surfaces are more opaque from the side; with `interior`
  bool exits = false;      ///< tissue has a surface where a ray leaves it; with `interior`
  bool grain = false;      ///< of cut bone; with `mask`
  bool soft = false;       ///< soft tissue; with `interior`
  bool clip = false;       ///< clipping planes
  bool thickness = false;  ///< bone is coloured by its distance to a structure
  bool shadows = false;    ///< ambient occlusion, and the lamp's shadow
  bool tool = false;       ///< that casts shadows; with `shadows`
  bool instrument = false; ///< of a mesh; with `tool`
  bool tone = false;       ///< lit colours go through the tone curve
  bool count = false;      ///< texture fetches and samples are counted
  bool exact = false;      ///< values by a filter of our own: the card's rounds its weights
  bool rounded = false;    ///< the card's filter is made to round its weights

  unsigned key() const noexcept; ///< unique per variant
  std::vector<std::string>
  names() const; ///< "ct" and the added features; counting and filters are not named
};

/// The tone curve in GLSL, with its constants.
std::string toneCurveShader();

/// `Seen polygonSeen(place, normal)` of PolygonShadows.glsl, for VTK's polygon shader; its uniforms
/// are set by RayCaster::shadePolygons.
std::string polygonShadowsShader();

/// Fragment shader of a variant (for GlProgram), with the constants of OpticalModel.h and
/// OccupancyGrid.h inserted.
std::string rayFragmentShader(const RayFeatures& features);

} // namespace petrous::rendering
