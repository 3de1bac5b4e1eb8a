// One ray a pixel through CT, labels, mask and a second image in lock step [Chan2013, 2.2]; the
// states, surfaces and integrals are those of OpticalModel.h.
//
// Nested loops: the inner ones only sample, leaping over empty bricks, until the ray's state changes;
// the outer one refines that change, takes the normal and lights it. There are two inner ones, for
// bricks where only the CT counts and for the others, because a processor that runs pixels in lock
// step pays for what a branch passes over, but not for a loop that nobody enters again. Positions are
// in voxels of the CT (0 at the first centre), lengths along the ray (t) in mm.
//
// Last part of the fragment shader, after RayScene.glsl (textures, uniforms, features) and
// RayOptics.glsl.

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

#ifdef PETROUS_INTERIOR
// The stretch of tissue up to a position that the ray's operands were taken at.
void passTissue(inout Ray ray, vec3 v, float to)
{
  float value = ray.at.value;
#ifdef PETROUS_SECOND
  if (ray.more.y > 0.5)
    value = intensityAt(v, ray.more);
#endif
  integrate(ray.material, ray.row, ray.before, to, value, ray.reading, ray.color,
            ray.transmittance);
}
#endif

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
    passTissue(ray, v, ray.t);
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
      passTissue(ray, v, hit);
#endif
    if (ray.next != kAir && (ray.state == kAir || (ray.state == kBone && ray.next >= kStructure)))
    {
      setMaterial(ray, materialAt(v, ray.at, ray.next));
      shade(ray, v, hit, face ? span.facing : -1.0);
      if (outDepth < 0.0)
        outDepth = hit;
    }
#ifdef PETROUS_INTERIOR
    if (ray.transmittance < termination)
      break;
    // The state says what fills it, not the surface: a lumen's look belongs to the wall only, and
    // between two structures the other's voxels may begin just behind the hit.
    int inside = max(ray.next - kStructure, 0);
    if (ray.next != kAir && ray.material != inside)
      setMaterial(ray, inside);
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
