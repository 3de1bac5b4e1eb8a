// How much of the sky and of the lamp a surface sees: cones through a pyramid of opacities
// [Crassin2011, 4.2], as defined in OpticalModel.h. Third part of the ray caster's fragment
// shader; see RayCast.frag.glsl.

struct Seen
{
  float sky;
  float lamp;
};

#ifdef PETROUS_SHADOWS
uniform sampler3D opacityTexture; // RG8: OpacityPyramid, linear within a level
uniform vec3 opacityScale, opacityOffset; // voxel -> texture coordinate
uniform mat3 opacityEdges; // of a texel of the first level, mm; one a column
uniform float opacityEdge; // their mean length
uniform int opacityLevels;
uniform float nearestSlice; // mm; the first look-up along a cone of the sky
uniform int slices;         // look-ups along it, each kSliceGrowth times as far as the last
uniform vec3 stoppingLower, stoppingUpper; // voxels: a look-up towards the lamp is 0 outside
uniform vec4 lamp; // w = 1: from the rays' common origin, mm; w = 0: towards it
uniform vec3 pictureUp, pictureRight;
uniform vec3 mmPerVoxel; // between the planes of voxels
#ifdef PETROUS_TOOL
uniform vec4 toolBall;   // centre, voxels, and radius, mm; radius 0: no tool
uniform mat3 toolFromVoxel; // mm; z along the shaft
uniform vec4 toolParts; // radius and end of the shaft, radius (0: none) and end of the handpiece, mm
#ifdef PETROUS_INSTRUMENT
uniform bool hasInstrument;
uniform sampler3D instrumentTexture; // R32F: InstrumentDistance, mm
uniform vec3 instrumentLower, instrumentUpper; // centres of its outer texels, mm from the tip
uniform vec3 instrumentScale, instrumentOffset; // mm -> texture coordinate
#endif
#endif

// Three cones around the normal for the hemisphere, a third of its light each, weighted by the
// cosine; the mean cosine of that light is theirs. A look-up is as wide as 0.7 of its distance.
const float kConeCosine = 0.66666667;
const float kConeSine = 0.74535599;
const float kConeWidth = 0.7;
// Above what the tangent plane explains, for the 8 bits of a texel and of the filter.
const float kSlack = 0.02;
const float kLampStride = 2.0; // texels from look-up to look-up towards the lamp
const float kDark = 0.005;

// Largest mean that a half space can have in a texel whose centre is `height` above it, in widths
// of the texel along the normal, over all its places in the grid: trilinear interpolation of means
// over blocks.
float ofHalfSpace(float height)
{
  float part = clamp(0.75 - 0.5 * height, 0.0, 1.0);
  return part * part;
}

// Fraction of a ball of that width, mm, that is drawn: neither cropped nor clipped.
float drawnAt(vec3 v, float width)
{
  vec3 part = clamp(0.5 + min(v - boxLower, boxUpper - v) * mmPerVoxel / width, 0.0, 1.0);
  float drawn = part.x * part.y * part.z;
#ifdef PETROUS_CLIP
  for (int i = 0; i < planeCount; ++i)
    drawn *= clamp(0.5 + (dot(planes[i].xyz, v) + planes[i].w) / width, 0.0, 1.0);
#endif
  return drawn;
}

// Level with texels of about that width, mm.
float levelOf(float width)
{
  return clamp(floor(log2(width / opacityEdge) + 0.5), 0.0, float(opacityLevels - 1));
}

// What the tangent plane explains there at a height, mm; `texel`: width of a texel of the first
// level along the normal, mm.
float ownOf(float height, float level, float texel)
{
  return kSlack + ofHalfSpace(height / (texel * exp2(level)));
}

#ifdef PETROUS_TOOL
// `at`: from the axis and along it.
float cylinderAt(vec2 at, float radius, float first, float last)
{
  vec2 beyond = vec2(at.x - radius, max(first - at.y, at.y - last));
  return min(max(beyond.x, beyond.y), 0.0) + length(max(beyond, 0.0));
}

// Signed distance from the tool, mm.
float toolAt(vec3 v)
{
  vec3 at = toolFromVoxel * (v - toolBall.xyz);
#ifdef PETROUS_INSTRUMENT
  if (hasInstrument)
  {
    COUNT(1);
    vec3 inside = clamp(at, instrumentLower, instrumentUpper);
    float own = textureLod(instrumentTexture, inside * instrumentScale + instrumentOffset, 0.0).r;
    float beyond = length(at - inside);
    // Within the handle, where the field ends, what is in it is as near as that end.
    return beyond > 0.0 ? length(vec2(beyond, max(own, 0.0))) : own;
  }
#endif
  vec2 aside = vec2(length(at.xy), at.z);
  float distance = min(length(at) - toolBall.w, cylinderAt(aside, toolParts.x, 0.0, toolParts.y));
  if (toolParts.z > 0.0)
    distance = min(distance, cylinderAt(aside, toolParts.z, toolParts.y, toolParts.w));
  return distance;
}

// Of the lamp's disc past the tool, `by` being the way to its centre, voxels a mm: how far beyond
// the disc's centre the tool comes, in radii of the disc, where it comes farthest.
float lampPastTool(vec3 v, vec3 by, float reach)
{
  float least = 1.0;
  float far = 0.3;
  for (int turn = 0; turn < 40; ++turn)
  {
    if (far >= reach || least <= -1.0)
      break;
    float distance = toolAt(v + far * by);
    least = min(least, distance / (far * kLampTangent));
    far += max(abs(distance), 0.15);
  }
  float beyond = clamp(least, -1.0, 1.0);
  return 0.5 + (beyond * sqrt(1.0 - beyond * beyond) + asin(beyond)) / 3.14159265;
}
#endif

// Share of tissue around a point beyond `own`, and the mean of what it stops.
vec2 tissueAt(vec3 v, float level, float own)
{
  COUNT(1);
  vec2 look = textureLod(opacityTexture, v * opacityScale + opacityOffset, level).rg;
  float share = look.x * drawnAt(v, opacityEdge * exp2(level));
  return vec2(clamp((share - own) / max(1.0 - own, 0.05), 0.0, 1.0), look.y / max(look.x, 0.004));
}

// The same with the tool's part of a ball of `width`, mm.
vec2 stoppersAt(vec3 v, float level, float own, float width)
{
  vec2 tissue = tissueAt(v, level, own);
#ifdef PETROUS_TOOL
  if (toolBall.w > 0.0)
  {
    float tool = clamp(0.5 - toolAt(v) / width, 0.0, 1.0);
    float both = tool + (1.0 - tool) * tissue.x;
    tissue = vec2(both, (tool + (1.0 - tool) * tissue.x * tissue.y) / max(both, 1e-6));
  }
#endif
  return tissue;
}

// Of the light from all around, within kOcclusionReach. From slice to slice the cones are half a
// turn further, so that they leave no direction out. `curvature`: 1/mm, of a ball that holds the
// surface's own; it lies below the ball's tangent plane nearest to a look-up.
float skyAt(vec3 v, vec3 normal, float texel, float curvature, bool wanted)
{
  vec3 aside = cross(normal, pictureUp);
  aside = dot(aside, aside) > 1e-6 ? normalize(aside) : pictureRight;
  vec3 middle = kConeCosine * (voxelFromMm * normal);
  vec3 across = kConeSine * (voxelFromMm * aside);
  vec3 along = 0.8660254 * kConeSine * (voxelFromMm * cross(normal, aside));
  float sky = 1.0;
  vec3 left = vec3(1.0 / 3.0);
  float far = nearestSlice;
  int turns = wanted ? slices : 0;
  for (int slice = 0; slice < turns; ++slice)
  {
    float width = far * kConeWidth;
    float level = levelOf(width);
    float height = far * kConeCosine;
    float more = curvature * far * far;
    height = (2.0 * height + more) / (sqrt(1.0 + curvature * (2.0 * height + more)) + 1.0);
    float own = ownOf(height, level, texel);
    float ratio = far / kOcclusionReach;
    vec3 center = v + far * middle;
    vec3 back = center - 0.5 * far * across;
    vec2 a = stoppersAt(center + far * across, level, own, width);
    vec2 b = stoppersAt(back + far * along, level, own, width);
    vec2 c = stoppersAt(back - far * along, level, own, width);
    vec3 passes = 1.0 - vec3(a.x, b.x, c.x);
    passes *= passes;
    sky -= (1.0 - ratio * ratio) * dot(left * (1.0 - passes), vec3(a.y, b.y, c.y));
    left *= passes;
    across = -across;
    far *= kSliceGrowth;
  }
  return clamp(sky, 0.0, 1.0);
}

// Distance, mm, at which a way, voxels a mm, has left all that stops light.
float leavesAt(vec3 v, vec3 by)
{
  vec3 safe = mix(vec3(1e-20), by, greaterThan(abs(by), vec3(1e-20)));
  vec3 away = max((stoppingLower - v) / safe, (stoppingUpper - v) / safe);
  return min(min(away.x, away.y), away.z);
}

// Of the lamp's disc, `way` being the direction to its centre, from which nothing farther than
// `reach` keeps its light, mm.
float lampAt(vec3 v, vec3 normal, vec3 way, float reach, float texel, bool wanted)
{
  float rise = dot(way, normal);
  float left = clamp(0.5 + 0.5 * rise / kLampTangent, 0.0, 1.0); // above the tangent plane
  float seen = left;
  vec3 by = voxelFromMm * way;
  float last = min(leavesAt(v, by), reach);
  float far = wanted ? 1.2 * opacityEdge : kShadowReach;
  while (far < last && left > kDark)
  {
    float width = max(far * kLampTangent, opacityEdge);
    float level = levelOf(width);
    vec2 tissue = tissueAt(v + far * by, level, ownOf(far * rise, level, texel));
    float passes = 1.0 - tissue.x;
    passes *= passes * passes;
    seen -= left * (1.0 - passes) * tissue.y;
    left *= passes;
    far += kLampStride * width;
  }
  if (!wanted)
    return 1.0;
#ifdef PETROUS_TOOL
  if (toolBall.w > 0.0)
    seen *= lampPastTool(v, by, reach);
#endif
  return max(seen, 0.0);
}

// `normal`: in mm, unit, towards the camera; `ray`: its direction in mm, unit; `hit`: mm.
Seen seenAt(vec3 v, vec3 normal, vec3 ray, float hit, float curvature, bool wanted)
{
  vec3 across = abs(normal * opacityEdges);
  float texel = across.x + across.y + across.z;
  vec3 way = lamp.xyz - lamp.w * hit * ray;
  float away = length(way);
  float reach = lamp.w > 0.0 ? min(away, kShadowReach) : kShadowReach;
  return Seen(skyAt(v, normal, texel, curvature, wanted),
              lampAt(v, normal, way / away, reach, texel, wanted));
}
#endif
