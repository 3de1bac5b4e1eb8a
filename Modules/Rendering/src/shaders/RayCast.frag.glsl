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
  vec2 height;  // f (in tissue -f) at the last two samples, the older first
  vec3 passed;  // operands at `before`; kUnknown: not known
  float summit; // where that may have risen above 0 between samples; 0: nowhere
  int state;
  int next; // state at the last sample
  Operands at;
  int material;
  vec4 row;
  vec4 more;
#ifdef PETROUS_INTERIOR
  Reading reading;
  float done; // tissue is gathered up to here
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

float fieldOf(vec3 at)
{
  return min(max(at.x, at.y), at.z);
}

// The operands of f, each so that it crosses 0.
vec3 operandsOf(Operands at)
{
  return vec3(at.ct, at.share - 0.5, at.left - 0.5);
}

// A thin wall can lie between two samples in air, a gap between two in tissue. Three heights with the
// highest in the middle tell where (a parabola's summit), and whether it may reach 0; then that place
// is the next sample.
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
  integrate(ray.material, ray.row, ray.done, to, value, ray.reading, ray.color,
            ray.transmittance);
  ray.done = max(ray.done, to);
}
#endif

const vec3 kUnknown = vec3(0.0);
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
#ifdef PETROUS_INTERIOR
      ray.done = max(ray.done, before);
#endif
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
  ray.passed = leaps ? kUnknown : ray.passed;
  ray.t = min(lattice, ray.last);
  v = positionOf(ray, ray.t);
  SAMPLE;
  ray.at = operandsAt(v, plain);
  ray.next = stateOf(ray.at, v, plain);
  if (summit)
  {
    ray.before = ray.t - stepLength;
    ray.passed = kUnknown;
  }
  if (ray.next != ray.state)
    return kChange;
  float height = fieldOf(operandsOf(ray.at)) * (ray.state == kAir ? 1.0 : -1.0);
  if (leaps || quiet)
    ray.height = vec2(-1e9);
  ray.summit = summit ? 0.0 : summitOf(ray.t - stepLength, vec3(ray.height, height));
  if (!summit)
    ray.height = vec2(ray.height.y, height);
#ifdef PETROUS_INTERIOR
  if (ray.state != kAir && !summit)
  {
    passTissue(ray, v, ray.t);
    if (ray.transmittance < termination)
      return kEnd;
  }
#endif
  ray.before = ray.t;
  ray.passed = operandsOf(ray.at);
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

// Goes to where the state changes between `before` and `t`: by a few false positions, the value of an
// end that stays being halved (the Illinois rule); bisected where that does not find it (next to what
// is no number), where nothing crosses 0 (between two structures) and where an end is not known. The
// ray's operands and next state become those of that place.
float changePoint(inout Ray ray)
{
  float low = ray.before;
  float high = ray.t;
  vec3 atLow = ray.passed;
  vec3 atHigh = operandsOf(ray.at);
  float hit = high;
  int state = ray.next;
  vec2 weight = vec2(1.0); // of the ends
  int sided = 0;
  bool open = true;
  for (int i = 0; open && i < kFalsePositions + bisections; ++i)
  {
    bool inTissue = ray.state != kAir && ray.next != kAir;
    float a = inTissue ? atLow.y : fieldOf(atLow);
    float b = inTissue ? atHigh.y : fieldOf(atHigh);
    bool secant = a * b < 0.0 && i < kFalsePositions;
    hit = mix(low, high, secant ? a * weight.x / (a * weight.x - b * weight.y) : 0.5);
    vec3 v = positionOf(ray, hit);
    ray.at = operandsAt(v, false);
    state = stateOf(ray.at, v, false);
    vec3 here = operandsOf(ray.at);
    bool before = state == ray.state;
    if (before)
    {
      low = hit;
      atLow = here;
      weight = vec2(1.0, sided < 0 ? 0.5 * weight.y : 1.0);
    }
    else
    {
      high = hit;
      atHigh = here;
      weight = vec2(sided > 0 ? 0.5 * weight.x : 1.0, 1.0);
      ray.next = state;
    }
    sided = before ? -1 : 1;
    inTissue = ray.state != kAir && ray.next != kAir;
    bool met = abs(inTissue ? here.y : fieldOf(here)) <= kOnSurface; // not with what is no number
    open = !met && high - low > stepLength / 256.0;
  }
  bool inTissue = ray.state != kAir && ray.next != kAir;
  float a = inTissue ? atLow.y : fieldOf(atLow);
  float b = inTissue ? atHigh.y : fieldOf(atHigh);
  if (a * b < 0.0)
  {
    float share = a / (a - b);
    vec3 here = mix(atLow, atHigh, share);
    hit = mix(low, high, share);
    ray.at.ct = here.x;
    ray.at.share = here.y + 0.5;
    ray.at.left = here.z + 0.5;
  }
#if defined(PETROUS_LABELS) && defined(PETROUS_INTERIOR)
  // Just before the surface the operands tell what begins there; it need not go on to `high`.
  if (state == ray.state && ray.next != kAir && ray.state <= kBone)
  {
    vec3 v = positionOf(ray, hit);
    bool structure = ray.state == kBone || ray.at.share > kShareThreshold;
    ray.next = structure ? kStructure + indexAt(v) : kBone;
  }
#endif
  return hit;
}

// The material of a surface at a position.
int materialAt(vec3 v, Operands at, int next)
{
#ifdef PETROUS_LABELS
  int index = indexAt(v);
  COUNT(1);
  bool lumen = texelFetch(materialTexture, ivec2(1, index), 0).x > 0.5;
  if (lumen || next >= kStructure || at.share > kShareThreshold)
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
  bool ofShare = byLabel && !byMask;
  vec3 shareSlope = shareGradient(labelPosition(v), ofShare);
  if (ofShare)
  {
    slopeMm = normalFromLabel * shareSlope;
    along = dot(shareSlope, labelFromVoxel * ray.direction);
  }
#endif
#ifdef PETROUS_MASK
  vec3 maskSlope = maskGradient(v, byMask);
  if (byMask)
  {
    slopeMm = normalFromVoxel * maskSlope;
    along = dot(maskSlope, ray.direction);
  }
#endif
  bool ofCt = !byMask && !byLabel;
  vec3 ctSlope = ctGradient(v, ofCt, ray.row.z >= kSmoothOpacity);
  if (ofCt)
  {
    slopeMm = normalFromVoxel * ctSlope;
    along = dot(ctSlope, ray.direction);
  }
  bool bony = facing < 0.0 && (ray.material == 0 || ray.more.x > 0.5);
  vec4 overlay = bony ? overlayAt(v) : vec4(0.0);
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
  vec3 lit = surfaceColor(ray.material, ray.row, intensityAt(below, ray.more), facing, hit,
                          overlay);
  ray.color += ray.transmittance * ray.row.z * lit;
  ray.transmittance *= 1.0 - ray.row.z;
}

// To the next change of state, and through it. False: it is the ray's end.
bool goOn(inout Ray ray, bool face, float facing, inout float depth)
{
  float hit = ray.first;
  if (!face)
  {
    if (!march(ray))
      return false; // it left the volume, or nothing comes through any more
    ray.sampleNumber -= 1.0; // that sample is taken again in the new state
    hit = changePoint(ray);
  }
  vec3 v = positionOf(ray, hit);
#ifdef PETROUS_INTERIOR
  if (ray.state != kAir)
    passTissue(ray, v, hit);
#endif
  if (ray.next != kAir && (ray.state == kAir || (ray.state == kBone && ray.next >= kStructure)))
  {
    setMaterial(ray, materialAt(v, ray.at, ray.next));
    shade(ray, v, hit, face ? facing : -1.0);
    if (depth < 0.0)
      depth = hit;
  }
#ifdef PETROUS_INTERIOR
  if (ray.transmittance < termination)
    return false;
  // The state says what fills it, not the surface: a lumen's look belongs to the wall only, and
  // between two structures the other's voxels may begin just behind the hit.
  int inside = max(ray.next - kStructure, 0);
  if (ray.next != kAir && ray.material != inside)
    setMaterial(ray, inside);
  ray.reading = readingAt(ray.material, ray.row, intensityAt(v, ray.more));
  ray.state = ray.next;
  ray.before = hit;
  ray.done = hit;
  ray.passed = kUnknown;
  ray.height = vec2(-1e9);
  ray.summit = 0.0;
#endif
  return ray.before < ray.last;
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
  ray.passed = kUnknown;
  ray.summit = 0.0;
  ray.state = kAir;
  ray.material = 0;
  ray.row = vec4(0.0);
  ray.more = vec4(0.0);
#ifdef PETROUS_INTERIOR
  ray.reading = Reading(0.0, vec4(0.0));
  ray.done = ray.first;
#endif
  ray.color = vec3(0.0);
  ray.transmittance = 1.0;
  vec3 v = positionOf(ray, ray.first);
  ray.at = operandsAt(v, false);
  ray.next = alive ? stateOf(ray.at, v, false) : kAir;
  bool face = ray.next != kAir; // the ray enters tissue through the border of what is drawn

#ifdef PETROUS_INTERIOR
  for (int events = 0; alive && events < kMostEvents; ++events)
  {
    alive = goOn(ray, face, span.facing, outDepth);
    face = false;
  }
#else
  if (alive)
    goOn(ray, face, span.facing, outDepth);
#endif

  outColor = vec4(ray.color, 1.0 - ray.transmittance);
#ifdef PETROUS_COUNT
  outCount = vec2(fetches, samples);
#endif
}
