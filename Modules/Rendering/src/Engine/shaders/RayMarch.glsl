// The way of a ray from one change of its state to the next. Fourth part of the ray caster's fragment
// shader; see RayCast.frag.glsl.
//
// Places on a ray (s) are in steps from where it enters; samples lie on whole steps, whatever is leapt
// over.

struct Ray
{
  vec3 direction; // voxels a mm
  Way voxel;      // voxels of the CT
  Way brick;      // bricks
  vec3 perBrick;  // steps from wall to wall
  vec3 ahead;     // the way it crosses bricks: 1, 0 or -1 along each axis
  vec3 behind;    // from a brick's lower corner to its wall on that side
  vec3 never;     // far, along an axis that it does not move on
  Ways ways;
  float first; // mm from the eye to where it enters
  float last;  // where it ends
  float number; // of the last sample
  float before; // up to here it is done, and tissue is gathered
  float s;      // of the last sample
  vec2 height;  // see nearness: of the last two samples, the older first; kNever: not known
  vec3 passed;  // operands a step before s; kUnknown: not known
  float summit; // where a wall may hide between samples; 0: nowhere
  float aside;  // how far from there the next samples are
  float top;    // the greatest nearness seen there
  int state;
  int next; // state at the last sample
  Operands at;
  int material;
  vec4 row;
  vec4 more;
#ifdef PETROUS_INTERIOR
  Gathering gathering;
  float nearest; // where it enters, steps from the eye
  float value;   // that its material reads where it is done
  float lit;     // of the lamp's light, how much that got which the colour is of
#endif
  vec3 color;
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

// The operands of f, each so that it crosses 0.
vec3 operandsOf(Operands at)
{
  return vec3(at.ct, at.occupancy - 0.5, at.left - 0.5);
}

// Of a place in a state: rises above 0 where another one begins.
float nearness(int state, vec3 at, float margin, const bool plain)
{
  float field = plain ? at.x : fieldOf(at);
  if (state == kAir)
    return field;
  return plain ? -field : max(-field, state == kBone ? at.y : -min(at.y, margin));
}

// A thin wall can lie between two samples in air, a gap between two in tissue. Three heights with the
// highest in the middle (at s) tell where, by a parabola's summit, and whether it may reach 0.
float summitOf(float s, vec3 height)
{
  float bend = 2.0 * height.y - height.x - height.z;
  float offset = 0.5 * (height.z - height.x) / max(bend, 1e-12);
  float top = height.y + 0.25 * (height.z - height.x) * offset;
  bool near = height.y > height.x && height.y >= height.z && top + kSummitDoubt * bend > 0.0;
  return near ? s + offset : 0.0;
}

// What the ray's material reads where the CT has a value.
float valueAt(Ray ray, float s, float value)
{
#ifdef PETROUS_SECOND
  if (ray.more.y > 0.5)
    return intensityAt(positionOf(ray, s), ray.more);
#endif
  return value;
}

#ifdef PETROUS_INTERIOR
// The stretch of tissue from where it is done up to a place where the CT has a value. `bulge`: how
// far the CT lies, half way there, above the mean of both ends. The intensity is taken to run on a
// parabola; two thirds of that lift both ends of a straight line to the same mean (Simpson's rule).
void passTissue(inout Ray ray, float to, float value, float bulge)
{
  float reads = valueAt(ray, to, value);
  bulge = ray.more.y > 0.5 ? 0.0 : bulge; // of the second image nothing is read half way
  gather(ray.material, ray.row, ray.gathering, max(to - ray.before, 0.0),
         ray.nearest + 0.5 * (ray.before + to), vec2(ray.value, reads) + 0.66666667 * bulge,
         ray.color, ray.lit, ray.transmittance);
  ray.value = reads;
}
#endif

// How a ray goes on.
const int kOn = 0;
const int kOtherBricks = 1; // the next sample is for the other inner loop
const int kWideChange = 2;  // a change that lies between bricks of both kinds
const int kChange = 3;
const int kEnd = 4;

// Samples inside one brick.
struct Run
{
  float last;
  float stride;
};

// Leaps over what is empty, to the brick of the next sample. `plain`: only the CT counts there.
int seek(inout Ray ray, out Run run, const bool plain)
{
  vec3 lastBrick = vec3(textureSize(brickTexture, 0) - 1);
  bool inAir = ray.state == kAir;
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
    float away = float(inAir ? texel.r : texel.g);
    vec3 wall = corner + ray.behind + ray.ahead * max(away, 1.0);
    vec3 crossed = (wall - ray.brick.from) * ray.perBrick + ray.never;
    leave = min(min(crossed.x, crossed.y), crossed.z);
    leaps = away > 0.0 && next < ray.last + 1.0;
    next = leaps ? max(next + 1.0, ceil(leave - 1e-3)) : next; // to behind the wall
    leapt = leapt || leaps;
  } while (leaps);
  if (leapt)
  {
    ray.number = next - 1.0;
    ray.before = ray.number;
    ray.passed = kUnknown;
    ray.height = vec2(kNever);
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

// The samples of a run, until the state changes. Two a turn, which do not wait for each other; where
// both stay in the state, tissue is gathered over both at once. Where a wall may hide, both are taken
// beside the likeliest place, seven times, each time nearer to the best so far, before the next two.
// `from`: where bricks of this kind begin.
int takeSamples(inout Ray ray, Run run, float from, const bool plain)
{
  bool inAir = ray.state == kAir;
  bool quiet = run.stride > 1.0;
  int outcome;
  do
  {
    bool aside = ray.summit > 0.0;
    float n1 = min(ray.number + run.stride, run.last);
    float n2 = min(n1 + run.stride, run.last);
    float s1 = aside ? max(ray.summit - ray.aside, from) : min(n1, ray.last);
    float most = plain ? max(min(run.last, ray.last), ray.summit) : ray.last; // the next brick's kind?
    float s2 = aside ? min(ray.summit + ray.aside, most) : min(n2, ray.last);
    Operands at1 = operandsAt(ray.ways, s1, plain);
    Operands at2 = operandsAt(ray.ways, s2, plain);
    SAMPLES(2);
    int next1 = stateOf(at1, ray.ways, s1, plain);
    int next2 = stateOf(at2, ray.ways, s2, plain);
    bool changes1 = next1 != ray.state;
    bool changes = changes1 || next2 != ray.state;
    bool passes = !aside && !changes;
    bool both = passes && n1 != n2;
    bool one = !aside && !changes1 && !both; // the second changes, or is the same place

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

// Samples bricks of one kind until the state changes; ends with a bracket of where (see changePoint).
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
  if (plain) // height is all that it kept
    ray.passed = ray.height.y < kNever
                     ? vec3(ray.state == kAir ? ray.height.y : -ray.height.y, -0.5, 0.5)
                     : kUnknown;
  return outcome;
}
