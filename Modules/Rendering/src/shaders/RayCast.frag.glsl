// One ray a pixel through CT, labels, mask and a second image in lock step [Chan2013, 2.2]; the
// states, surfaces and integrals are those of OpticalModel.h.
//
// Nested loops: the inner ones only sample, leaping over empty bricks, until the ray's state changes;
// the outer one refines that change, takes the normal and lights it. There are two inner ones, for
// bricks where only the CT counts and for the others, because a processor that runs pixels in lock
// step pays for what a branch passes over, but not for a loop that nobody enters again. Positions are
// in voxels of the CT (0 at the first centre), lengths along the ray (t) in mm.
//
// Compiled with the features that the scene uses (PETROUS_*): what is not defined is not fetched.
//   BONE       the CT's own surface            MASK     the cut
//   LABELS     structures                      SECOND   a second image for some materials
//   INTERIOR   tissue can be looked into       CLIP     clipping planes
//   COUNT      fetches and samples are counted
//
// Textures (linear unless named otherwise):
//   ctTexture      R16 / R16_SNORM / R32F, value = texel * ctUnit
//   maskTexture    R8 or R16, 1 untouched, 0 gone, the CT's grid
//   shareTexture   R16, smoothed union of solid structures, own grid
//   indexTexture   R8UI, nearest, the same grid: row of the material
//   secondTexture  as ctTexture, own grid
//   brickTexture   RGBA8UI, nearest, a texel a brick: distances to tissue, inside; flags
//   lookTexture    RGBA16F, row = material, over its intensities: colour, specular
//   depthTexture   RGBA32F, nearest, row = material: integrals over its intensities of extinction * colour
//                  and of extinction (1/mm)
//   materialTexture RGBA32F, nearest, 2 x rows: (first intensity, 1 / range, surface opacity,
//                  shininess), (lumen, reads the second image, -, -)
//   opaqueTexture  window depth of opaque polygons

in vec2 ndc;
layout(location = 0) out vec4 outColor; // premultiplied
layout(location = 1) out float outDepth; // mm to the first surface, -1 none
#ifdef PETROUS_COUNT
layout(location = 2) out vec2 outCount; // fetches, samples
#endif

uniform sampler3D ctTexture;
uniform usampler3D brickTexture;
uniform sampler2D lookTexture;
uniform sampler2D materialTexture;
uniform sampler2D opaqueTexture;

// Rays: origin and direction are affine in the pixel; direction in mm has the length `toMm`.
uniform vec3 originCenter, originX, originY;
uniform vec3 directionCenter, directionX, directionY;
uniform vec3 viewCenter, viewX, viewY; // the same direction in the eye's frame, mm
uniform vec4 opaqueDepth; // w = y / (z + x) perspective; z + w * ndc parallel; see opaqueEnd
uniform bool hasOpaque;
uniform bool parallel;

uniform vec3 boxLower, boxUpper; // voxels that are drawn
uniform vec3 hullUpper;          // dims - 1
uniform vec3 ctScale, ctOffset;  // voxel -> texture coordinate
uniform float ctUnit;
uniform float iso, perUnit; // intensity; 1 / scale of c_CT
uniform float brickEdge;
uniform float stepLength; // mm
uniform int bisections;
uniform float termination; // transmittance at which a ray ends
uniform mat3 normalFromVoxel; // gradient over voxels -> gradient over mm
uniform mat3 voxelFromMm;
uniform float colorDepth; // mm

uniform vec4 light; // intensity, ambient, specular, wetness
uniform float falloff;

#ifdef PETROUS_MASK
uniform sampler3D maskTexture;
uniform vec3 maskScale, maskOffset;
#endif
#ifdef PETROUS_LABELS
uniform sampler3D shareTexture;
uniform usampler3D indexTexture;
uniform mat3 labelFromVoxel;
uniform vec3 labelOrigin;
uniform vec3 labelUpper; // dims - 1
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
#ifdef PETROUS_INTERIOR
uniform sampler2D depthTexture;
#endif
#ifdef PETROUS_CLIP
uniform int planeCount;
uniform vec4 planes[PETROUS_CLIP]; // mm on the side that stays, over voxels
#endif

const int kAir = 0;
const int kBone = 1;
const int kStructure = 2; // + index
const float kWetShininess = 120.0;
const float kInteriorFacing = 2.0 / 3.0;
const int kMostEvents = 512; // far more than a ray meets before nothing comes through
const uint kMixed = 1u;
const uint kLabels = 2u;
const uint kBorder = 16u;
const float kSummitDoubt = 0.5;
const float kLongSteps = 4.0; // where nothing but the density changes

#ifdef PETROUS_COUNT
float fetches = 0.0;
float samples = 0.0;
#define COUNT(n) fetches += float(n)
#define SAMPLE samples += 1.0
#else
#define COUNT(n)
#define SAMPLE
#endif

float ctAt(vec3 v)
{
  COUNT(1);
  return texture(ctTexture, v * ctScale + ctOffset).r * ctUnit;
}

#ifdef PETROUS_MASK
float maskAt(vec3 v)
{
  COUNT(1);
  return texture(maskTexture, v * maskScale + maskOffset).r;
}
#endif

#ifdef PETROUS_LABELS
vec3 labelPosition(vec3 v)
{
  return labelFromVoxel * v + labelOrigin;
}

float shareAtLabel(vec3 l)
{
  COUNT(1);
  return texture(shareTexture, (l + 0.5) / (labelUpper + 1.0)).r;
}

int indexAt(vec3 v)
{
  COUNT(1);
  vec3 l = floor(labelPosition(v) + 0.5);
  if (any(lessThan(l, vec3(0.0))) || any(greaterThan(l, labelUpper)))
    return 0;
  return int(texelFetch(indexTexture, ivec3(l), 0).r);
}
#endif

// What the field is made of at a position.
struct Operands
{
  float value; // intensity of the CT
  float ct;    // c_CT
  float share;
  float left; // of the mask
};

// `plain`: known to be where neither labels nor mask count.
Operands operandsAt(vec3 v, const bool plain)
{
  Operands at;
#if defined(PETROUS_BONE) || defined(PETROUS_INTERIOR)
  at.value = ctAt(v);
#else
  at.value = 0.0;
#endif
#ifdef PETROUS_BONE
  at.ct = (at.value - iso) * perUnit;
#else
  at.ct = -1.0;
#endif
  at.share = 0.0;
  at.left = 1.0;
#ifdef PETROUS_LABELS
  if (!plain)
    at.share = shareAtLabel(labelPosition(v));
#endif
#ifdef PETROUS_MASK
  if (!plain)
    at.left = maskAt(v);
#endif
  return at;
}

int stateOf(Operands at, vec3 v, const bool plain)
{
  float f = min(max(at.ct, at.share - 0.5), at.left - 0.5);
  // Written so that a value that is no number is air.
  if (!(f > 0.0))
    return kAir;
#if defined(PETROUS_LABELS) && defined(PETROUS_INTERIOR)
  if (!plain && at.share > 0.5)
    return kStructure + indexAt(v);
#endif
  return kBone;
}

float lightAt(float t)
{
  float ratio = falloff > 0.0 ? t / falloff : 0.0;
  return light.x / (1.0 + ratio * ratio);
}

// Intensity that a material reads.
float intensityAt(vec3 v, vec4 more)
{
#ifdef PETROUS_SECOND
  if (more.y > 0.5)
  {
    COUNT(1);
    vec3 s = clamp(secondFromVoxel * v + secondOrigin, vec3(0.0), secondUpper);
    return texture(secondTexture, s * secondScale + secondOffset).r * secondUnit;
  }
#endif
  return ctAt(clamp(v, vec3(0.0), hullUpper));
}

float rowCoordinate(int material)
{
  return (float(material) + 0.5) / float(textureSize(materialTexture, 0).y);
}

vec3 surfaceColor(int material, vec4 row, float value, float facing, float t)
{
  COUNT(1);
  float width = float(textureSize(lookTexture, 0).x);
  float u = clamp((value - row.x) * row.y, 0.0, 1.0) * (1.0 - 1.0 / width) + 0.5 / width;
  vec4 look = texture(lookTexture, vec2(u, rowCoordinate(material)));
  float diffuse = light.y + (1.0 - light.y) * facing;
  float highlight = look.a * light.z * pow(facing, row.w) + light.w * pow(facing, kWetShininess);
  return clamp(lightAt(t) * (look.rgb * diffuse + highlight), 0.0, 1.0);
}

#ifdef PETROUS_INTERIOR
// Where a ray stands in its tissue's table: the coordinate of the intensity, and the integrals of
// extinction * colour and of extinction (1/mm) up to there.
struct Reading
{
  float u;
  vec4 integral;
};

// At the nearest of the table's intensities: a difference of two readings is then exact between them.
Reading readingOf(int material, float u)
{
  COUNT(1);
  float intervals = float(textureSize(depthTexture, 0).x - 1);
  float x = floor(u * intervals + 0.5);
  return Reading(x / intervals, texelFetch(depthTexture, ivec2(int(x), material), 0));
}

Reading readingAt(int material, vec4 row, float value)
{
  return readingOf(material, clamp((value - row.x) * row.y, 0.0, 1.0));
}

// Adds a stretch of one tissue, over which the intensity goes from the reading's to `value`, to what
// the ray has gathered. The mean over the intensities in between is a difference of integrals, never
// over less than a texel.
void integrate(int material, vec4 row, float from, float to, float value, inout Reading reading,
               inout vec3 color, inout float transmittance)
{
  float texel = 1.0 / float(textureSize(depthTexture, 0).x - 1);
  float u = clamp((value - row.x) * row.y, 0.0, 1.0);
  if (abs(u - reading.u) < texel)
    u = reading.u + (reading.u > 0.5 ? -texel : texel);
  Reading there = readingOf(material, u);
  vec4 optics = (there.integral - reading.integral) / (there.u - reading.u);
  reading = there;
  float opacity = 1.0 - exp(-optics.a * max(to - from, 0.0));
  float lamp = lightAt(0.5 * (from + to)) * (light.y + (1.0 - light.y) * kInteriorFacing);
  vec3 shade = clamp(lamp * optics.rgb / max(optics.a, 1e-12), 0.0, 1.0);
  color += transmittance * opacity * shade;
  transmittance *= 1.0 - opacity;
}
#endif

// Gradients over the voxels of the operand's own grid, one-sided at its border.
#define GRADIENT(name, sampleAt, upper)                                                            \
  vec3 name(vec3 v)                                                                                \
  {                                                                                                \
    vec3 low = max(v - 1.0, vec3(0.0));                                                            \
    vec3 high = min(v + 1.0, upper);                                                               \
    vec3 run = high - low;                                                                         \
    vec3 rise = vec3(sampleAt(vec3(high.x, v.yz)) - sampleAt(vec3(low.x, v.yz)),                   \
                     sampleAt(vec3(v.x, high.y, v.z)) - sampleAt(vec3(v.x, low.y, v.z)),           \
                     sampleAt(vec3(v.xy, high.z)) - sampleAt(vec3(v.xy, low.z)));                  \
    return mix(vec3(0.0), rise / max(run, vec3(1e-6)), greaterThan(run, vec3(0.0)));               \
  }

GRADIENT(ctGradient, ctAt, hullUpper)
#ifdef PETROUS_MASK
GRADIENT(maskGradient, maskAt, hullUpper)
#endif
#ifdef PETROUS_LABELS
GRADIENT(shareGradient, shareAtLabel, labelUpper)
#endif

// Where the ray enters the part of the volume that is drawn, where it leaves, and how the face that
// it enters through looks at it.
struct Span
{
  float first;
  float last;
  float facing;
};

Span clipRay(vec3 o, vec3 d)
{
  vec3 safe = mix(vec3(1e-20), d, greaterThan(abs(d), vec3(1e-20)));
  vec3 a = (boxLower - o) / safe;
  vec3 b = (boxUpper - o) / safe;
  vec3 enter = min(a, b);
  vec3 leave = max(a, b);
  // Along an axis that the ray does not move on, it is inside always or never.
  bvec3 still = lessThanEqual(abs(d), vec3(1e-20));
  bvec3 inside = lessThanEqual(abs(2.0 * o - boxLower - boxUpper), boxUpper - boxLower);
  enter = mix(enter, mix(vec3(1e30), vec3(-1e30), inside), still);
  leave = mix(leave, mix(vec3(-1e30), vec3(1e30), inside), still);
  Span span;
  span.first = max(max(enter.x, enter.y), max(enter.z, 0.0));
  span.last = min(min(leave.x, leave.y), leave.z);
  span.facing = 1.0; // the eye is inside
  vec3 along = abs(d) / vec3(length(normalFromVoxel[0]), length(normalFromVoxel[1]),
                             length(normalFromVoxel[2]));
  if (span.first > 0.0)
    span.facing = enter.x >= max(enter.y, enter.z) ? along.x
                  : (enter.y >= enter.z ? along.y : along.z);
#ifdef PETROUS_CLIP
  for (int i = 0; i < planeCount; ++i)
  {
    float slope = dot(planes[i].xyz, d);
    float height = dot(planes[i].xyz, o) + planes[i].w;
    if (abs(slope) < 1e-20)
    {
      if (height < 0.0)
        span.last = -1.0;
      continue;
    }
    float t = -height / slope;
    if (slope < 0.0)
      span.last = min(span.last, t);
    else if (t > span.first)
    {
      span.first = t;
      span.facing = abs(slope);
    }
  }
#endif
  return span;
}

float opaqueEnd(float toMm)
{
  if (!hasOpaque)
    return 1e30;
  ivec2 size = textureSize(opaqueTexture, 0);
  ivec2 pixel = clamp(ivec2((0.5 * ndc + 0.5) * vec2(size)), ivec2(0), size - 1);
  float z = texelFetch(opaqueTexture, pixel, 0).r;
  if (z >= 1.0)
    return 1e30;
  z = 2.0 * z - 1.0;
  return parallel ? opaqueDepth.z + opaqueDepth.w * z : toMm * opaqueDepth.y / (z + opaqueDepth.x);
}

// A ray on its way.
struct Ray
{
  vec3 origin;
  vec3 direction;
  vec3 inverse; // of the direction
  bvec3 forward;
  bvec3 still;
  float first; // where it enters
  float last;  // where it ends
  float sampleNumber; // samples lie on the lattice of whole steps, whatever is leapt over
  float before; // up to here it is done
  float t;      // of the last sample
  vec2 height;  // f at the last two samples in air, the older first
  float summit; // where f may have risen above 0 between samples; 0: nowhere
  int state;
  int next; // state at the last sample
  Operands at;
  int material;
  vec4 row;
  vec4 more;
#ifdef PETROUS_INTERIOR
  Reading reading;
#endif
  vec3 color;
  float transmittance;
};

vec3 positionOf(Ray ray, float t)
{
  return clamp(ray.origin + t * ray.direction, boxLower, boxUpper);
}

// Steps until the ray has crossed a block of bricks round the one it is in.
float stepsThrough(Ray ray, vec3 v, vec3 brick, float away)
{
  vec3 wall = mix(brick - (away - 1.0), brick + away, ray.forward) * brickEdge;
  vec3 beyond = mix((wall - v) * ray.inverse, vec3(1e30), ray.still);
  return max(min(min(beyond.x, beyond.y), beyond.z), 0.0) / stepLength;
}

float fieldOf(Operands at)
{
  return min(max(at.ct, at.share - 0.5), at.left - 0.5);
}

// A thin wall can lie between two samples in air. Three heights with the highest in the middle tell
// where (a parabola's summit), and whether it may reach 0; then that place is the next sample.
float summitOf(float t, vec3 height)
{
  float bend = 2.0 * height.y - height.x - height.z;
  float offset = 0.5 * (height.z - height.x) / max(bend, 1e-12);
  float top = height.y + 0.25 * (height.z - height.x) * offset;
  bool near = height.y > height.x && height.y >= height.z && top + kSummitDoubt * bend > 0.0;
  return near ? t + offset * stepLength : 0.0;
}

const int kOn = 0;
const int kOtherBricks = 1; // the next sample is for the other inner loop
const int kChange = 2;
const int kEnd = 3;

// One sample. `plain`: in bricks where only the CT counts.
int advance(inout Ray ray, const bool plain)
{
  bool summit = ray.summit > 0.0;
  float number = ray.sampleNumber + (summit ? 0.0 : 1.0);
  float lattice = summit ? ray.summit : ray.first + number * stepLength;
  vec3 v = ray.origin + lattice * ray.direction;
  ivec3 lastBrick = textureSize(brickTexture, 0) - 1;
  ivec3 brick = clamp(ivec3(floor(v / brickEdge)), ivec3(0), lastBrick);
  uvec4 texel = texelFetch(brickTexture, brick, 0);
  COUNT(1);
  float before = ray.before;
  float away = float(ray.state == kAir ? texel.r : texel.g);
#ifdef PETROUS_INTERIOR
  bool quiet = ray.state != kAir && (texel.b & kBorder) == 0u;
#else
  const bool quiet = false;
#endif
  bool leaps = away > 0.0 && !summit;
  if (leaps || quiet)
  {
    float leap = stepsThrough(ray, v, vec3(brick), max(away, 1.0));
    if (leaps)
    {
      number += max(ceil(leap - 1e-3), 0.0); // to behind the wall of what is empty
      before = max(before, ray.first + (number - 1.0) * stepLength);
      v = ray.origin + (ray.first + number * stepLength) * ray.direction;
      brick = clamp(ivec3(floor(v / brickEdge)), ivec3(0), lastBrick);
      texel = texelFetch(brickTexture, brick, 0);
      COUNT(1);
    }
    else
      number += clamp(floor(leap - 1e-3), 0.0, kLongSteps - 1.0); // to before it
    lattice = ray.first + number * stepLength;
  }
#if defined(PETROUS_MASK) || defined(PETROUS_LABELS)
  uint flags = texel.b & (kMixed | kLabels);
  if ((flags == 0u) != plain && lattice < ray.last)
    return kOtherBricks;
#else
  const uint flags = 0u;
#endif
  ray.sampleNumber = number;
  ray.before = before;
  ray.t = min(lattice, ray.last);
  v = positionOf(ray, ray.t);
  SAMPLE;
  ray.at = operandsAt(v, plain);
  ray.next = stateOf(ray.at, v, plain);
  if (summit)
    ray.before = ray.t - stepLength;
  if (ray.next != ray.state)
    return kChange;
  float height = fieldOf(ray.at);
  if (leaps || ray.state != kAir)
    ray.height = vec2(-1e9);
  ray.summit = summit ? 0.0 : summitOf(ray.t - stepLength, vec3(ray.height, height));
  if (!summit)
    ray.height = vec2(ray.height.y, height);
#ifdef PETROUS_INTERIOR
  if (ray.state != kAir)
  {
    float value = ray.at.value;
#ifdef PETROUS_SECOND
    if (ray.more.y > 0.5)
      value = intensityAt(v, ray.more);
#endif
    integrate(ray.material, ray.row, ray.before, ray.t, value, ray.reading, ray.color,
              ray.transmittance);
    if (ray.transmittance < termination)
      return kEnd;
  }
#endif
  ray.before = ray.t;
  return lattice >= ray.last ? kEnd : kOn;
}

// Samples until the state changes; whether it does.
bool march(inout Ray ray)
{
  int outcome = kOn;
  while (outcome < kChange)
  {
    do
      outcome = advance(ray, true);
    while (outcome == kOn);
#if defined(PETROUS_MASK) || defined(PETROUS_LABELS)
    if (outcome == kOtherBricks)
      do
        outcome = advance(ray, false);
      while (outcome == kOn);
#endif
  }
  return outcome == kChange;
}

// Where the state changes between `before` and `t`: bisected, then interpolated. The ray goes on at
// `high`, where the new state holds.
float changePoint(inout Ray ray, out float high)
{
  float low = ray.before;
  high = ray.t;
  Operands atLow = ray.at;
  Operands atHigh = ray.at;
  bool known = false;
  for (int i = 0; i < bisections; ++i)
  {
    float middle = 0.5 * (low + high);
    vec3 v = positionOf(ray, middle);
    Operands at = operandsAt(v, false);
    int state = stateOf(at, v, false);
    if (state == ray.state)
    {
      low = middle;
      atLow = at;
      known = true;
    }
    else
    {
      high = middle;
      atHigh = at;
      ray.next = state;
    }
  }
  bool inTissue = ray.state != kAir && ray.next != kAir;
  float a = inTissue ? atLow.share - 0.5 : fieldOf(atLow);
  float b = inTissue ? atHigh.share - 0.5 : fieldOf(atHigh);
  float share = known && a * b < 0.0 ? a / (a - b) : 0.5;
  return mix(low, high, share);
}

// The material of a surface at a position.
int materialAt(vec3 v, Operands at, int next)
{
#ifdef PETROUS_LABELS
  int index = indexAt(v);
  COUNT(1);
  bool lumen = texelFetch(materialTexture, ivec2(1, index), 0).x > 0.5;
  if (lumen || next >= kStructure || at.share > 0.5 - 1e-3)
    return index;
#endif
  return 0;
}

void setMaterial(inout Ray ray, int material)
{
  COUNT(2);
  ray.material = material;
  ray.row = texelFetch(materialTexture, ivec2(0, material), 0);
  ray.more = texelFetch(materialTexture, ivec2(1, material), 0);
}

// Lights the surface at `hit`; `facing` below 0: take the normal of the operand that decides.
void shade(inout Ray ray, vec3 v, float hit, float facing)
{
  Operands at = ray.at;
  vec3 slopeMm = vec3(0.0);
  float along = 0.0;
#ifdef PETROUS_LABELS
  bool byLabel = ray.state == kBone || at.share - 0.5 > at.ct;
#else
  const bool byLabel = false;
#endif
#ifdef PETROUS_MASK
  bool byMask = ray.state != kBone && at.left - 0.5 < max(at.ct, at.share - 0.5);
#else
  const bool byMask = false;
#endif
#ifdef PETROUS_LABELS
  if (byLabel && !byMask)
  {
    vec3 slope = shareGradient(labelPosition(v));
    slopeMm = normalFromLabel * slope;
    along = dot(slope, labelFromVoxel * ray.direction);
  }
#endif
#ifdef PETROUS_MASK
  if (byMask)
  {
    vec3 slope = maskGradient(v);
    slopeMm = normalFromVoxel * slope;
    along = dot(slope, ray.direction);
  }
#endif
  if (!byMask && !byLabel)
  {
    vec3 slope = ctGradient(v);
    slopeMm = normalFromVoxel * slope;
    along = dot(slope, ray.direction);
  }
  float size = length(slopeMm);
  vec3 below = v;
  if (facing < 0.0)
  {
    facing = 1.0; // a flat field faces the eye
    if (size > 1e-12)
    {
      facing = min(abs(along) / size, 1.0);
      below += voxelFromMm * (slopeMm * (colorDepth / size));
    }
  }
  vec3 lit = surfaceColor(ray.material, ray.row, intensityAt(below, ray.more), facing, hit);
  ray.color += ray.transmittance * ray.row.z * lit;
  ray.transmittance *= 1.0 - ray.row.z;
}

void main()
{
  outColor = vec4(0.0);
  outDepth = -1.0;

  vec3 view = viewCenter + ndc.x * viewX + ndc.y * viewY;
  float toMm = length(view);
  Ray ray;
  ray.origin = originCenter + ndc.x * originX + ndc.y * originY;
  ray.direction = (directionCenter + ndc.x * directionX + ndc.y * directionY) / toMm;
  Span span = clipRay(ray.origin, ray.direction);
  ray.first = span.first;
  ray.last = min(span.last, opaqueEnd(toMm));
  bool alive = ray.last > ray.first;

  ray.still = lessThanEqual(abs(ray.direction), vec3(1e-20));
  ray.inverse = 1.0 / mix(ray.direction, vec3(1e-20), ray.still);
  ray.forward = greaterThan(ray.direction, vec3(0.0));
  ray.sampleNumber = 0.0;
  ray.before = ray.first;
  ray.t = ray.first;
  ray.height = vec2(-1e9);
  ray.summit = 0.0;
  ray.state = kAir;
  ray.material = 0;
  ray.row = vec4(0.0);
  ray.more = vec4(0.0);
#ifdef PETROUS_INTERIOR
  ray.reading = Reading(0.0, vec4(0.0));
#endif
  ray.color = vec3(0.0);
  ray.transmittance = 1.0;
  vec3 v = positionOf(ray, ray.first);
  ray.at = operandsAt(v, false);
  ray.next = alive ? stateOf(ray.at, v, false) : kAir;
  bool face = ray.next != kAir; // the ray enters tissue through the border of what is drawn

  for (int events = 0; alive && events < kMostEvents; ++events)
  {
    float hit = ray.first;
    float high = ray.first;
    if (!face)
    {
      if (!march(ray))
        break; // it left the volume, or nothing comes through any more
      ray.sampleNumber -= 1.0; // that sample is taken again in the new state
      hit = changePoint(ray, high);
    }
    v = positionOf(ray, hit);
    ray.at = operandsAt(v, false);
#ifdef PETROUS_INTERIOR
    if (ray.state != kAir)
    {
      float value = ray.at.value;
#ifdef PETROUS_SECOND
      if (ray.more.y > 0.5)
        value = intensityAt(v, ray.more);
#endif
      integrate(ray.material, ray.row, ray.before, hit, value, ray.reading, ray.color,
                ray.transmittance);
    }
#endif
    setMaterial(ray, materialAt(v, ray.at, ray.next));
    if (ray.next != kAir && (ray.state == kAir || (ray.state == kBone && ray.next >= kStructure)))
    {
      shade(ray, v, hit, face ? span.facing : -1.0);
      if (outDepth < 0.0)
        outDepth = hit;
    }
#ifdef PETROUS_INTERIOR
    if (ray.transmittance < termination)
      break;
    // Inside a tissue a lumen's look is bone's: it belongs to the wall only.
    if (ray.next == kBone && ray.material != 0)
      setMaterial(ray, 0);
    ray.reading = readingAt(ray.material, ray.row, intensityAt(v, ray.more));
    ray.state = ray.next;
    ray.before = high;
    ray.height = vec2(-1e9);
    ray.summit = 0.0;
    face = false;
    if (ray.before >= ray.last)
      break;
#else
    break;
#endif
  }

  outColor = vec4(ray.color, 1.0 - ray.transmittance);
#ifdef PETROUS_COUNT
  outCount = vec2(fetches, samples);
#endif
}
