// The scene: textures and uniforms, the tissue field at a position and its gradients. First part of
// the ray caster's fragment shader; see RayCast.frag.glsl.
//
// Compiled with the features that the scene uses (PETROUS_*); undefined features are not fetched.
//   BONE       the CT's isosurface            MASK     the cut mask
//   LABELS     structures                     SECOND   a second image for some materials
//   BORDERS    touching structures            THIRD    and a third one (with SECOND)
//   NESTED     translucent structures
//   INTERIOR   translucent tissue             CLIP     clipping planes
//   EDGES      translucent surfaces are more opaque from the side (with INTERIOR)
//   EXITS      tissue has a surface where a ray leaves it (with INTERIOR)
//   GRAIN      cut bone has a fine grain (with MASK)
//   THICKNESS  bone is coloured by its distance to a structure
//   SOFT       soft tissue (with INTERIOR)
//   SHADOWS    surfaces see less of the sky and of the lamp where something is in the way
//   INSTRUMENT an instrument is (with SHADOWS)
//   TONE       lit colours go through the tone curve
//   COUNT      fetches and samples are counted
//   EXACT      the card's filter rounds: values come from one of our own
//   ROUNDED    the card's filter is made to round its weights, for tests on one that does not
// Preceded by the constants that the C++ code defines (RayShader.cpp): kMaxPlanes,
// kInteriorFacing, kWetShininess, kOccupancyThreshold, kSmoothOpacity, kLeastFacing,
// kEdgeSlope, kUnlike, kAlike, kAsideSlope, kMostAside, kSoftInSection, kCoarseCell, kFineCell,
// kCoarseShare, kFineShare, kGrainContrast, kFineGrain, kCoarseGrain (OpticalModel.h),
// kOcclusionReach, kShadowReach, kLampTangent, kSliceGrowth (OpticalModel.h, RayShader.h),
// kThicknessColors (ThicknessColor.h), kMixed, kLabels, kBorder (OccupancyGrid.h), kMeeting,
// kDeepest, kMarginPerDepth (LabelBorders.h).
//
// Textures (linear filtering unless stated otherwise):
//   ctTexture      R16 / R16_SNORM / R32F, value = texel * ctUnit
//   maskTexture    R8 or R16, 1 untouched, 0 removed, the CT's grid
//   occupancyTexture   R16, smoothed union of solid structures, own grid
//   indexTexture   R8UI, nearest, grid of occupancyTexture: row of the material; with BORDERS
//                  RG8UI, the second channel as LabelField::borders
//   secondTexture, thirdTexture  as ctTexture, own grids
//   brickTexture   RGBA8UI, nearest, one texel per brick: distances to tissue, inside; flags;
//                  distance to soft tissue
//   lookTexture    RGBA16F, row = material, over its intensities: colour, specular
//   depthTexture   RGBA32F, nearest, row = material: integrals over its intensities of
//                  extinction * colour and of extinction (1/mm)
//   materialTexture RGBA32F, nearest, 2 x rows: (first intensity, 1 / range, surface opacity,
//                  shininess), (lumen, image: 0 the CT, 1 the second, 2 the third, edge of soft
//                  tissue per mm, -); the last row is that of soft tissue, with SOFT
//   thicknessTexture R16_SNORM, mm to a structure = texel * thicknessUnit, own grid
//   opaqueTexture  window depth of opaque polygons

in vec2 ndc;
layout(location = 0) out vec4 outColor; // premultiplied
layout(location = 1) out float outDepth; // mm to the first surface; -1: none
#ifdef PETROUS_COUNT
layout(location = 2) out vec2 outCount; // fetches, samples
#endif

uniform sampler3D ctTexture;
uniform usampler3D brickTexture;
uniform sampler2D lookTexture;
uniform sampler2D materialTexture;
uniform sampler2D opaqueTexture;

// Rays: origin and direction are affine in the pixel; the length of the direction in mm is `toMm`.
uniform vec3 originCenter, originX, originY;
uniform vec3 directionCenter, directionX, directionY;
uniform vec3 viewCenter, viewX, viewY; // the same direction in view coordinates, mm
uniform vec4 opaqueDepth; // w = y / (z + x) perspective; z + w * ndc parallel; see opaqueEnd
uniform bool hasOpaque;
uniform bool parallel;

uniform vec3 boxLower, boxUpper; // drawn voxels
uniform vec3 hullUpper;          // dims - 1
uniform vec3 ctScale, ctOffset;  // voxel -> texture coordinate
uniform float ctUnit;
uniform float iso, perUnit; // intensity; 1 / scale of c_CT
uniform float brickEdge;
uniform float stepLength; // mm
uniform int bisections;
uniform float termination; // transmittance at which a ray terminates
uniform mat3 normalFromVoxel; // gradient over voxels -> gradient over mm
uniform mat3 voxelFromMm;
uniform float colorDepth; // mm
#ifdef PETROUS_ROUNDED
uniform float weights; // of the card's filter between two texels
#endif

uniform vec4 light; // intensity at the lamp with exposure, ambient, specular, wetness
uniform float plainLight; // intensity without exposure and falloff
uniform float falloff;
uniform vec3 aside; // voxels by which the light of a sample is taken aside; zero: of the only one
#ifdef PETROUS_EDGES
uniform float edges; // 0 to 1
#endif
#ifdef PETROUS_GRAIN
uniform float grain;        // 0 to 1
uniform mat3 coarseCells;   // its cells from voxels, turned
uniform mat3 fineCells;
uniform vec2 pixel;         // its edge at a distance of t mm is x + y t mm
#endif
// Grey of faces: value of black, 1 / range; 0, 0: bone's are lit as surfaces are, and soft tissue
// has none.
uniform vec2 section;

#ifdef PETROUS_MASK
uniform sampler3D maskTexture;
uniform vec3 maskScale, maskOffset;
#endif
#ifdef PETROUS_LABELS
uniform sampler3D occupancyTexture;
uniform usampler3D indexTexture;
uniform mat3 labelFromVoxel;
uniform vec3 labelOrigin;
uniform vec3 labelUpper; // dims - 1
uniform vec3 labelScale, labelOffset; // label voxel -> texture coordinate of the occupancy
uniform vec3 labelBlock;              // label voxels per texel
uniform mat3 normalFromLabel;
#endif
#ifdef PETROUS_SECOND
uniform sampler3D secondTexture;
uniform mat3 secondFromVoxel;
uniform vec3 secondOrigin;
uniform float secondUnit;
uniform vec3 secondUpper;
uniform vec3 secondScale, secondOffset;
#endif
#ifdef PETROUS_THIRD
uniform sampler3D thirdTexture;
uniform mat3 thirdFromVoxel;
uniform vec3 thirdOrigin;
uniform float thirdUnit;
uniform vec3 thirdUpper;
uniform vec3 thirdScale, thirdOffset;
#endif
#ifdef PETROUS_THICKNESS
uniform sampler3D thicknessTexture;
uniform mat3 thicknessFromVoxel;
uniform vec3 thicknessOrigin;
uniform vec3 thicknessUpper; // dims - 1
uniform vec3 thicknessScale, thicknessOffset;
uniform float thicknessUnit; // mm
uniform float thicknessFarthest; // mm
#endif
#ifdef PETROUS_INTERIOR
uniform sampler2D depthTexture;
#endif
#ifdef PETROUS_CLIP
uniform int planeCount;
uniform vec4 planes[kMaxPlanes]; // mm on the side that is kept, over voxels
#endif

#ifdef PETROUS_SOFT
const int kSoft = -1; // then air is only what was cut away, and bone that is not drawn
#endif
const int kAir = 0;
const int kBone = 1;
const int kStructure = 2; // + index
const int kMaxEvents = 512; // far more than a ray meets before it becomes opaque
const float kOnSurface = 1e-5; // of f: tolerance of a surface point
const int kFalsePositions = 5;
const float kSummitDoubt = 1.0;
// Search for a thin wall around its expected position, in steps: initial offset, factor by which
// the offset shrinks, and the offset at which the search ends.
const float kFirstAside = 0.3;
const float kNextAside = 0.6;
const float kLastAside = 0.02;
const float kLongSteps = 4.0; // where only the density varies
const float kLeastShadowed = 0.004; // part of a pixel: its shadows are less than a level of 255
const float kLeastLit = 1e-4; // opacity of soft tissue below which nobody sees how it is lit

#ifdef PETROUS_COUNT
float fetches = 0.0;
float samples = 0.0;
#define COUNT(n) fetches += float(n)
#define SAMPLES(n) samples += float(n)
#else
#define COUNT(n)
#define SAMPLES(n)
#endif

// Trilinear value at a texture coordinate. Most cards round the weights to 1/256 (Vulkan reports it
// as subTexelPrecisionBits). The field becomes a staircase: no root is found to better than a step,
// slopes are wrong, and what a ray grazes comes and goes. Good enough while the picture moves.
#ifdef PETROUS_ROUNDED
float byCard(sampler3D image, vec3 at)
{
  vec3 size = vec3(textureSize(image, 0));
  vec3 texel = at * size - 0.5;
  vec3 lower = floor(texel);
  vec3 weight = floor((texel - lower) * weights + 0.5) / weights;
  return texture(image, (lower + weight + 0.5) / size).r;
}
#else
#define byCard(image, at) texture(image, at).r
#endif

#ifdef PETROUS_EXACT
float exactly(sampler3D image, vec3 at)
{
  COUNT(7); // and one where it is called
  ivec3 last = textureSize(image, 0) - 1;
  vec3 texel = at * vec3(last + 1) - 0.5;
  vec3 lower = floor(texel);
  vec3 weight = texel - lower;
  ivec3 a = clamp(ivec3(lower), ivec3(0), last);
  ivec3 b = clamp(ivec3(lower) + 1, ivec3(0), last);
  vec4 low = vec4(texelFetch(image, a, 0).r, texelFetch(image, ivec3(b.x, a.yz), 0).r,
                  texelFetch(image, ivec3(a.x, b.y, a.z), 0).r,
                  texelFetch(image, ivec3(b.xy, a.z), 0).r);
  vec4 high = vec4(texelFetch(image, ivec3(a.xy, b.z), 0).r,
                   texelFetch(image, ivec3(b.x, a.y, b.z), 0).r,
                   texelFetch(image, ivec3(a.x, b.yz), 0).r, texelFetch(image, b, 0).r);
  vec4 between = mix(low, high, weight.z);
  vec2 row = mix(between.xy, between.zw, weight.y);
  return mix(row.x, row.y, weight.x);
}
uniform bool exactSamples;
float filtered(sampler3D image, vec3 at, const bool refined)
{
  if (refined || exactSamples)
    return exactly(image, at);
  return byCard(image, at);
}
#else
#define exactly(image, at) byCard(image, at)
#define filtered(image, at, refined) byCard(image, at)
#endif

float ctAt(vec3 v)
{
  COUNT(1);
  return exactly(ctTexture, v * ctScale + ctOffset) * ctUnit;
}

#ifdef PETROUS_MASK
float maskAt(vec3 v)
{
  COUNT(1);
  return exactly(maskTexture, v * maskScale + maskOffset);
}
#endif

#ifdef PETROUS_LABELS
vec3 labelPosition(vec3 v)
{
  return labelFromVoxel * v + labelOrigin;
}

float occupancyAtLabel(vec3 l)
{
  COUNT(1);
  return exactly(occupancyTexture, l * labelScale + labelOffset);
}

// Index and border of a voxel; 0 outside the grid.
uvec2 labelOfVoxel(vec3 voxel)
{
  COUNT(1);
  if (any(lessThan(voxel, vec3(0.0))) || any(greaterThan(voxel, labelUpper)))
    return uvec2(0u);
  return texelFetch(indexTexture, ivec3(voxel / labelBlock), 0).rg;
}

int indexAtLabel(vec3 l)
{
  return int(labelOfVoxel(floor(l + 0.5)).r);
}

// Structure, and margin to the next one in units of occupancy.
struct Choice
{
  int index;
  float margin;
};

// Only inside structures: volume::structureAt.
Choice structureAtLabel(vec3 l)
{
  uvec2 nearest = labelOfVoxel(floor(l + 0.5));
  Choice choice = Choice(int(nearest.r), 0.5);
#ifdef PETROUS_BORDERS
  ivec3 who = ivec3(choice.index, -1, -1);
  vec3 most = vec3(0.0);
  int turns = nearest.g >= kMeeting ? 8 : 0;
  for (int corner = 0; corner < turns; ++corner)
  {
    vec3 lower = floor(l);
    vec3 up = l - lower;
    vec3 high = vec3(ivec3(corner, corner >> 1, corner >> 2) & 1);
    uvec2 own = labelOfVoxel(lower + high);
    vec3 near = mix(1.0 - up, up, high);
    float weight = near.x * near.y * near.z * float(own.g & kDeepest);
    int index = int(own.r);
    bool other = index != who.x && weight > 0.0;
    who.y = other && who.y < 0 ? index : who.y;
    who.z = other && who.z < 0 && index != who.y ? index : who.z;
    most += mix(vec3(0.0), vec3(weight), equal(ivec3(index), who));
  }
  if (turns > 0)
  {
    float next = max(most.y, most.z);
    choice.index = most.x >= next ? who.x : (most.y >= most.z ? who.y : who.z);
    choice.margin = kMarginPerDepth * (most.x >= next ? most.x - next
                                                      : next - max(most.x, min(most.y, most.z)));
  }
#endif
  return choice;
}

int indexAt(vec3 v)
{
  return indexAtLabel(labelPosition(v));
}
#endif

// A ray in a texture's coordinates: `from` + s * `by`, s steps from its entry. Computed once per
// ray: CPU renderers read uniforms in every loop iteration.
struct Way
{
  vec3 from;
  vec3 by;
};

vec3 along(Way way, float s)
{
  return way.from + s * way.by;
}

struct Ways
{
  Way ct; // texture coordinates
#ifdef PETROUS_MASK
  Way mask; // texture coordinates
#endif
#ifdef PETROUS_LABELS
  Way occupancy; // texture coordinates
  Way label; // voxels of the labels
#endif
};

// `voxel`: the ray in CT voxels.
Ways waysOf(Way voxel)
{
  Ways ways;
  ways.ct = Way(voxel.from * ctScale + ctOffset, voxel.by * ctScale);
#ifdef PETROUS_MASK
  ways.mask = Way(voxel.from * maskScale + maskOffset, voxel.by * maskScale);
#endif
#ifdef PETROUS_LABELS
  ways.label = Way(labelPosition(voxel.from), labelFromVoxel * voxel.by);
  ways.occupancy = Way(ways.label.from * labelScale + labelOffset, ways.label.by * labelScale);
#endif
  return ways;
}

// Operands of the tissue field at a position.
struct Operands
{
  float value; // intensity of the CT
  float ct;    // c_CT
  float occupancy;
  float left; // mask value
  float margin; // inside a structure: distance to another one, in units of occupancy
};

// `plain`: neither labels nor mask matter there. `refined`: always by the exact filter.
Operands operandsAt(Ways ways, float s, const bool plain, const bool refined)
{
  Operands at;
#if defined(PETROUS_BONE) || defined(PETROUS_INTERIOR)
  COUNT(1);
  at.value = filtered(ctTexture, along(ways.ct, s), refined) * ctUnit;
#else
  at.value = 0.0;
#endif
#ifdef PETROUS_BONE
  at.ct = (at.value - iso) * perUnit;
#else
  at.ct = -1.0;
#endif
  at.occupancy = 0.0;
  at.left = 1.0;
  at.margin = 0.5;
#ifdef PETROUS_LABELS
  if (!plain)
  {
    COUNT(1);
    at.occupancy = filtered(occupancyTexture, along(ways.occupancy, s), refined);
  }
#endif
#ifdef PETROUS_MASK
  if (!plain)
  {
    COUNT(1);
    at.left = filtered(maskTexture, along(ways.mask, s), refined);
  }
#endif
  return at;
}

// Also sets the margin.
int stateOf(inout Operands at, Ways ways, float s, const bool plain)
{
  float f = min(max(at.ct, at.occupancy - 0.5), at.left - 0.5);
  // Written so that NaN is air.
  if (!(f > 0.0))
#ifdef PETROUS_SOFT
    return at.left > 0.5 && !(max(at.ct, at.occupancy - 0.5) > 0.0) && !(at.value > iso) ? kSoft
                                                                                         : kAir;
#else
    return kAir;
#endif
#ifdef PETROUS_NESTED
  if (!plain && at.occupancy > 0.5)
  {
    Choice structure = structureAtLabel(along(ways.label, s));
    at.margin = structure.margin;
    return kStructure + structure.index;
  }
#elif defined(PETROUS_LABELS) && defined(PETROUS_INTERIOR)
  if (!plain && at.occupancy > 0.5)
    return kStructure; // the ray ends on it, whichever structure it is
#endif
  return kBone;
}

// Gradients over the voxels of the operand's own grid, one-sided at its border. One sample per
// iteration: on SIMT hardware a loop that no pixel needs costs one iteration, a branch its whole
// body.
#define GRADIENT(name, sampleAt, upper)                                                            \
  vec3 name(vec3 v, bool wanted)                                                                   \
  {                                                                                                \
    vec3 low = max(v - 1.0, vec3(0.0));                                                            \
    vec3 high = min(v + 1.0, upper);                                                               \
    vec3 run = high - low;                                                                         \
    vec3 rise = vec3(0.0);                                                                         \
    int turns = wanted ? 6 : 0;                                                                    \
    for (int i = 0; i < turns; ++i)                                                                \
    {                                                                                              \
      bvec3 axis = equal(ivec3(i >> 1), ivec3(0, 1, 2));                                           \
      bool ahead = (i & 1) != 0;                                                                   \
      float value = sampleAt(mix(v, ahead ? high : low, axis));                                    \
      rise += mix(vec3(0.0), vec3(ahead ? value : -value), axis);                                  \
    }                                                                                              \
    return mix(vec3(0.0), rise / max(run, vec3(1e-6)), greaterThan(run, vec3(0.0)));               \
  }

// Gradient of the CT; `smoothly`: from twelve samples, +-1 on two axes at once
// (edgeGradientInPatient).
vec3 ctGradient(vec3 v, bool wanted, bool smoothly)
{
  vec3 low = max(v - 1.0, vec3(0.0));
  vec3 high = min(v + 1.0, hullUpper);
  vec3 run = (high - low) * (smoothly ? 4.0 : 1.0);
  vec3 rise = vec3(0.0);
  int turns = wanted ? (smoothly ? 12 : 6) : 0;
  for (int i = 0; i < turns; ++i)
  {
    int axis = i >> (smoothly ? 2 : 1);
    bvec3 along = equal(ivec3(axis), ivec3(0, 1, 2));
    vec3 to = mix(vec3(0.0), vec3((i & 1) != 0 ? 1.0 : -1.0), along);
    if (smoothly)
      to += mix(vec3(0.0), vec3((i & 2) != 0 ? 1.0 : -1.0), along.zxy);
    vec3 at = mix(mix(v, high, greaterThan(to, vec3(0.5))), low, lessThan(to, vec3(-0.5)));
    rise += to * ctAt(at);
  }
  return mix(vec3(0.0), rise / max(run, vec3(1e-6)), greaterThan(run, vec3(0.0)));
}
#ifdef PETROUS_MASK
GRADIENT(maskGradient, maskAt, hullUpper)
#endif
#ifdef PETROUS_LABELS
GRADIENT(occupancyGradient, occupancyAtLabel, labelUpper)
#ifdef PETROUS_NESTED
// Gradient of the depth in a structure (without borders, of the structure's fraction of the
// neighbourhood), with quadratic B-spline weights.
vec3 indexGradient(vec3 l, int index, bool wanted)
{
  vec3 nearest = floor(l + 0.5);
  vec3 d = l - nearest;
  vec3 slope = vec3(0.0);
  int turns = wanted ? 27 : 0;
  for (int i = 0; i < turns; ++i)
  {
    vec3 step = vec3(ivec3(i, i / 3, i / 9) % 3 - 1);
    uvec2 own = labelOfVoxel(nearest + step);
    bool inside = int(own.r) == index;
#ifdef PETROUS_BORDERS
    float depth = float(own.g & kDeepest) * (inside ? 1.0 : -1.0);
#else
    float depth = inside ? 1.0 : 0.0;
#endif
    vec3 outer = 0.5 + step * d;
    bvec3 middle = equal(step, vec3(0.0));
    vec3 weight = mix(0.5 * outer * outer, 0.75 - d * d, middle);
    vec3 change = mix(step * outer, -2.0 * d, middle);
    slope += depth * change * weight.yzx * weight.zxy;
  }
  return slope;
}
#endif
#endif
