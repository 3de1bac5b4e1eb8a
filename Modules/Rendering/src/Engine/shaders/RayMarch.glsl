// March of a ray from one change of state to the next. Fifth part of the ray caster's fragment
// shader; see RayCast.frag.glsl.
//
// Positions on a ray (s) are in steps from its entry; samples lie on whole steps, also after
// skipping.

struct Ray
{
  vec3 direction; // voxels per mm
#ifdef PETROUS_SHADOWS
  vec3 unit; // the same in mm, of length 1
#endif
  Way voxel;      // voxels of the CT
  Way brick;      // bricks
  vec3 perBrick;  // steps from wall to wall
  vec3 ahead;     // direction across bricks: 1, 0 or -1 along each axis
  vec3 behind;    // from a brick's lower corner to its exit wall
  vec3 never;     // large along an axis on which the ray does not move
  Ways ways;
#ifdef PETROUS_SOFT
  bool isCut; // it enters through the crop box or a clipping plane
#endif
  float first; // mm from the camera to the entry
  float last;  // end of the ray
  float number; // of the last sample
  float before; // position up to which the ray is done and tissue is accumulated
  float s;      // of the last sample
  vec2 height;  // nearness of the last two samples, older first; kNever: unknown
  vec3 passed;  // operands one step before s; kUnknown: unknown
  float summit; // expected position of a thin wall between samples; 0: none
  float aside;  // offset of the next samples from it
  float top;    // maximum of nearness found there
  int state;
  int next; // state at the last sample
  Operands at;
  int material;
  vec4 row;
  vec4 more;
#ifdef PETROUS_INTERIOR
  Gathering gathering;
  float nearest; // entry, steps from the camera
  float value;   // intensity of its material at `before`
  float lit;     // opacity weighted by the attenuation of the light
#endif
  vec3 color; // lit, without an upper bound
  vec4 plain; // what is displayed as it is, and its share of the pixel
  float transmittance;
};

const vec3 kUnknown = vec3(0.0);
const float kNever = 1e9;

float mmOf(Ray ray, float s)
{
  return ray.first + s * stepLength;
}

vec3 positionOf(Ray ray, float s)
{
  return clamp(along(ray.voxel, s), boxLower, boxUpper);
}

float fieldOf(vec3 at)
{
  return min(max(at.x, at.y), at.z);
}

// The operands of f, each offset to cross 0 at its surface.
vec3 operandsOf(Operands at)
{
  return vec3(at.ct, at.occupancy - 0.5, at.left - 0.5);
}

// Measure of the distance to another state: becomes positive where one begins.
float nearness(int state, vec3 at, float margin, const bool plain)
{
  float field = plain ? at.x : fieldOf(at);
#ifdef PETROUS_SOFT
  if (state == kAir)
    return at.z;
  if (state == kSoft)
    return plain ? field : max(field, -at.z);
#else
  if (state == kAir)
    return field;
#endif
  return plain ? -field : max(-field, state == kBone ? at.y : -min(at.y, margin));
}

// A thin wall can lie between two samples in air, a gap between two in tissue. From three heights
// with the highest in the middle (at s): the vertex of their parabola if it may reach 0, otherwise
// 0.
float summitOf(float s, vec3 height)
{
  float bend = 2.0 * height.y - height.x - height.z;
  float offset = 0.5 * (height.z - height.x) / max(bend, 1e-12);
  float top = height.y + 0.25 * (height.z - height.x) * offset;
  bool near = height.y > height.x && height.y >= height.z && top + kSummitDoubt * bend > 0.0;
  return near ? s + offset : 0.0;
}

// Intensity for the ray's material, given that of the CT.
float valueAt(Ray ray, float s, float value)
{
#ifdef PETROUS_SECOND
  if (ray.more.y > 0.5)
    return intensityAt(positionOf(ray, s), ray.more);
#endif
  return value;
}

#ifdef PETROUS_INTERIOR
// Accumulates the tissue from `before` to a position where the CT has a value. `bulge`: CT at half
// way minus the mean of both ends. The intensity is assumed to be parabolic; raising both ends of a
// linear profile by two thirds of the bulge gives the same mean (Simpson's rule).
void passTissue(inout Ray ray, float to, float value, float bulge)
{
  float reads = valueAt(ray, to, value);
  bulge = ray.more.y > 0.5 ? 0.0 : bulge; // other images are not sampled half way
  Segment segment = segmentOf(ray.material, ray.row, ray.gathering, max(to - ray.before, 0.0),
                              vec2(ray.value, reads) + 0.66666667 * bulge);
  float middle = 0.5 * (ray.before + to);
  float lamp = ray.gathering.lamp;
#ifdef PETROUS_SOFT
  bool isSoft = ray.state == kSoft;
  float own = softLamp(positionOf(ray, middle), ray.direction, ray.more,
                       isSoft && segment.opacity > kLeastLit && light.y < 1.0);
  lamp = isSoft ? own : lamp;
#endif
  gather(segment, ray.gathering, lamp, ray.nearest + middle, ray.color, ray.lit,
         ray.transmittance);
  ray.value = reads;
}
#endif

// How the march continues.
const int kOn = 0;
const int kOtherBricks = 1; // the next sample belongs to the other inner loop
const int kWideChange = 2;  // a change across bricks of both kinds
const int kChange = 3;
const int kEnd = 4;

// Samples within one brick.
struct Run
{
  float last;
  float stride;
};

// Skips empty bricks up to the brick of the next sample. `plain`: only the CT matters there.
int seek(inout Ray ray, out Run run, const bool plain)
{
  vec3 lastBrick = vec3(textureSize(brickTexture, 0) - 1);
  bool inAir = ray.state <= kAir;
  float next = ray.number + 1.0;
  float leave;
  bool leaps;
  bool leapt = false;
  uint flags;
  do
  {
    vec3 corner = clamp(floor(along(ray.brick, min(next, ray.last))), vec3(0.0), lastBrick);
    uvec4 texel = texelFetch(brickTexture, ivec3(corner), 0);
    COUNT(1);
    flags = texel.b;
#ifdef PETROUS_SOFT
    float away = float(inAir ? texel.a : texel.g);
#else
    float away = float(inAir ? texel.r : texel.g);
#endif
    vec3 wall = corner + ray.behind + ray.ahead * max(away, 1.0);
    vec3 crossed = (wall - ray.brick.from) * ray.perBrick + ray.never;
    leave = min(min(crossed.x, crossed.y), crossed.z);
    leaps = away > 0.0 && next < ray.last + 1.0;
    next = leaps ? max(next + 1.0, ceil(leave - 1e-3)) : next; // past the wall
    leapt = leapt || leaps;
  } while (leaps);
  if (leapt)
  {
    ray.number = next - 1.0;
    ray.before = ray.number;
    ray.passed = kUnknown;
    ray.height = vec2(kNever);
#ifdef PETROUS_SOFT
    if (ray.state == kSoft)
      ray.value = intensityAt(positionOf(ray, ray.number), ray.more);
#endif
  }
  run.last = max(next, floor(leave - 1e-3));
  run.stride = 1.0;
#ifdef PETROUS_INTERIOR
  if (!inAir && (flags & kBorder) == 0u)
    run.stride = kLongSteps;
#endif
  int outcome = kOn;
#if defined(PETROUS_MASK) || defined(PETROUS_LABELS)
  if (((flags & (kMixed | kLabels)) == 0u) != plain)
    outcome = kOtherBricks;
#endif
  return ray.number < ray.last ? outcome : kEnd;
}

// Takes the samples of a run until the state changes. Two independent samples per iteration; if
// both stay in the state, tissue is accumulated over both at once. Where a thin wall is suspected,
// both are first taken on either side of the most likely position, seven times, each time closer to
// the best so far. `from`: where bricks of this kind begin.
int takeSamples(inout Ray ray, Run run, float from, const bool plain)
{
  bool inAir = ray.state == kAir; // nothing to accumulate
  bool quiet = run.stride > 1.0;
  int outcome;
  do
  {
    bool aside = ray.summit > 0.0;
    float n1 = min(ray.number + run.stride, run.last);
    float n2 = min(n1 + run.stride, run.last);
    float s1 = aside ? max(ray.summit - ray.aside, from) : min(n1, ray.last);
    // The next brick may be of the other kind.
    float most = plain ? max(min(run.last, ray.last), ray.summit) : ray.last;
    float s2 = aside ? min(ray.summit + ray.aside, most) : min(n2, ray.last);
    Operands at1 = operandsAt(ray.ways, s1, plain, false);
    Operands at2 = operandsAt(ray.ways, s2, plain, false);
    SAMPLES(2);
    int next1 = stateOf(at1, ray.ways, s1, plain);
    int next2 = stateOf(at2, ray.ways, s2, plain);
    bool changes1 = next1 != ray.state;
    bool changes = changes1 || next2 != ray.state;
    bool passes = !aside && !changes;
    bool both = passes && n1 != n2;
    bool one = !aside && !changes1 && !both; // the second changes, or coincides

    vec3 operands1 = operandsOf(at1);
    vec3 operands2 = operandsOf(at2);
    float h1 = nearness(ray.state, operands1, at1.margin, plain);
    float h2 = nearness(ray.state, operands2, at2.margin, plain);
    bool falls = ray.height.y >= h1;
    float summit = summitOf(falls ? n1 - 1.0 : n1,
                            falls ? vec3(ray.height, h1) : vec3(ray.height.y, h1, h2));
    bool hides = summit > 0.0 && !quiet && (falls ? passes : both);
    bool again = aside && !changes && ray.aside > kLastAside;
    float best = max(h1, h2) > ray.top ? (h1 > h2 ? s1 : s2) : ray.summit;
    ray.top = aside ? max(ray.top, max(h1, h2)) : -kNever;
    ray.aside = again ? kNextAside * ray.aside : kFirstAside;
    ray.summit = again ? best : (hides ? max(summit, from) : 0.0);
    ray.height = both ? vec2(h1, h2) : (one ? vec2(ray.height.y, h1) : ray.height);
    ray.height.x = quiet ? kNever : ray.height.x;
    if (!plain)
      ray.passed = both ? operands2 : (one ? operands1 : ray.passed);

    outcome = changes ? kChange : (passes && s2 >= ray.last && !(ray.summit > 0.0) ? kEnd : kOn);
#ifdef PETROUS_INTERIOR
    if (passes && !inAir)
    {
      float bulge = at1.value - 0.5 * (ray.value + at2.value);
      passTissue(ray, s2, at2.value, both ? bulge : 0.0);
      outcome = ray.transmittance < ray.gathering.enough ? kEnd : outcome;
    }
#endif
    ray.before = passes ? s2 : ray.before;
    ray.number = aside ? ray.number : n2;
    ray.s = changes1 ? s1 : s2;
    ray.at.value = changes1 ? at1.value : at2.value;
    ray.at.ct = changes1 ? at1.ct : at2.ct;
    ray.at.occupancy = changes1 ? at1.occupancy : at2.occupancy;
    ray.at.left = changes1 ? at1.left : at2.left;
    ray.next = changes1 ? next1 : next2;
  } while (outcome == kOn && (ray.number < run.last || ray.summit > 0.0));
  return outcome;
}

// Samples bricks of one kind until the state changes; ends with a bracket of the change (see
// changePoint).
int marchIn(inout Ray ray, const bool plain)
{
  float from = plain ? ray.number + 1.0 : 0.0;
  int outcome;
  do
  {
    Run run;
    outcome = seek(ray, run, plain);
    if (outcome == kOn)
      outcome = takeSamples(ray, run, from, plain);
  } while (outcome == kOn);
#if defined(PETROUS_MASK) || defined(PETROUS_LABELS)
  if (plain && outcome == kChange && ray.s - 1.0 < from)
    outcome = kWideChange;
#endif
  if (plain) // only the height was kept
    ray.passed = ray.height.y < kNever
                     ? vec3(ray.state <= kAir ? ray.height.y : -ray.height.y, -0.5, 0.5)
                     : kUnknown;
  return outcome;
}
