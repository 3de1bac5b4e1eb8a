// One ray a pixel through CT, labels, mask and a second image in lock step [Chan2013, 2.2]; the
// states, surfaces and integrals are those of OpticalModel.h.
//
// Nested loops: the inner ones only sample, leaping over empty bricks, until the ray's state changes;
// the outer one refines that change, takes the normal and lights it. There are two inner ones, for
// bricks where only the CT counts and for the others, because a processor that runs pixels in lock
// step pays for what a branch passes over, but not for a loop that nobody enters again. Positions are
// in voxels of the CT (0 at the first centre), distances from the eye in mm.
//
// Last part of the fragment shader, after RayScene.glsl (textures, uniforms, features), RayClip.glsl,
// RayOptics.glsl and RayMarch.glsl.

// Where a state gives way to another.
struct Bracket
{
  float low;
  float high;
  vec3 atLow; // operands
  vec3 atHigh;
  vec2 weight; // of the ends
  float hit;
  int state; // there
  bool open;
};

// The operand that decides between the ray's state and the next, at an end.
float deciding(Ray ray, vec3 operands)
{
  return ray.state != kAir && ray.next != kAir ? operands.y : fieldOf(operands);
}

// By a few false positions, the value of an end that stays being halved (the Illinois rule); bisected
// where that does not find it (next to what is no number), where nothing crosses 0 (between two
// structures) and where an end is not known. `plain`: only the CT counts there. The ray's operands and
// next state become those of the last place.
void narrow(inout Bracket bracket, inout Ray ray, const bool plain)
{
  int sided = 0;
  for (int i = 0; bracket.open && i < kFalsePositions + bisections; ++i)
  {
    float a = deciding(ray, bracket.atLow);
    float b = deciding(ray, bracket.atHigh);
    bool secant = a * b < 0.0 && i < kFalsePositions;
    a *= bracket.weight.x;
    b *= bracket.weight.y;
    bracket.hit = mix(bracket.low, bracket.high, secant ? a / (a - b) : 0.5);
    ray.at = operandsAt(ray.ways, bracket.hit, plain);
    bracket.state = stateOf(ray.at, ray.ways, bracket.hit, plain);
    vec3 here = operandsOf(ray.at);
    bool before = bracket.state == ray.state;
    if (before)
    {
      bracket.low = bracket.hit;
      bracket.atLow = here;
      bracket.weight = vec2(1.0, sided < 0 ? 0.5 * bracket.weight.y : 1.0);
    }
    else
    {
      bracket.high = bracket.hit;
      bracket.atHigh = here;
      bracket.weight = vec2(sided > 0 ? 0.5 * bracket.weight.x : 1.0, 1.0);
      ray.next = bracket.state;
    }
    sided = before ? -1 : 1;
    bool met = abs(deciding(ray, here)) <= kOnSurface; // not with what is no number
    bracket.open = !met && bracket.high - bracket.low > 1.0 / 256.0;
  }
}

// Goes back from the last sample to where the state changes; the ray's operands and next state become
// those of that place. `plain`: only the CT counts there.
float changePoint(inout Ray ray, const bool plain)
{
  bool aside = ray.s < ray.before; // found where a wall was thought to be
  Bracket bracket;
  bracket.low = aside ? ray.s - 1.0 : max(ray.s - 1.0, ray.before);
  bracket.high = ray.s;
  bracket.atLow = aside ? kUnknown : ray.passed;
  bracket.atHigh = operandsOf(ray.at);
  bracket.weight = vec2(1.0);
  bracket.hit = ray.s;
  bracket.state = ray.next;
  bracket.open = true;
  narrow(bracket, ray, plain);
  float a = deciding(ray, bracket.atLow);
  float b = deciding(ray, bracket.atHigh);
  if (a * b < 0.0)
  {
    float share = a / (a - b);
    vec3 here = mix(bracket.atLow, bracket.atHigh, share);
    bracket.hit = mix(bracket.low, bracket.high, share);
    ray.at.ct = here.x;
    ray.at.occupancy = here.y + 0.5;
    ray.at.left = here.z + 0.5;
  }
#if defined(PETROUS_LABELS) && defined(PETROUS_INTERIOR)
  // Just before the surface the operands tell what begins there; it need not go on to `high`.
  if (!plain && bracket.state == ray.state && ray.next != kAir && ray.state <= kBone)
  {
    bool structure = ray.state == kBone || ray.at.occupancy > kOccupancyThreshold;
#ifdef PETROUS_NESTED
    ray.next =
        structure ? kStructure + structureAtLabel(along(ray.ways.label, bracket.hit)).index : kBone;
#else
    ray.next = structure ? kStructure : kBone;
#endif
  }
#endif
  return bracket.hit;
}

// The material of a surface at a position, on the way from one state to the next.
int materialAt(vec3 v, Operands at, int state, int next)
{
#ifdef PETROUS_LABELS
#ifdef PETROUS_NESTED
  if (state >= kStructure)
    return next - kStructure;
#endif
  if (next >= kStructure || at.occupancy > kOccupancyThreshold)
    return structureAtLabel(labelPosition(v)).index;
  int index = indexAt(v);
  COUNT(1);
  bool lumen = texelFetch(materialTexture, ivec2(1, index), 0).x > 0.5;
  if (lumen)
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
#ifdef PETROUS_NESTED
  bool between = ray.state >= kStructure; // two structures
  vec3 borderSlope = indexGradient(labelPosition(v), ray.material, between);
  if (between)
  {
    slopeMm = normalFromLabel * borderSlope;
    along = dot(borderSlope, labelFromVoxel * ray.direction);
  }
#else
  const bool between = false;
#endif
#ifdef PETROUS_LABELS
  bool byLabel = !between && (ray.state == kBone || at.occupancy - 0.5 > at.ct);
#else
  const bool byLabel = false;
#endif
#ifdef PETROUS_MASK
  bool byMask = !between && ray.state != kBone && at.left - 0.5 < max(at.ct, at.occupancy - 0.5);
#else
  const bool byMask = false;
#endif
#ifdef PETROUS_LABELS
  bool ofOccupancy = byLabel && !byMask;
  vec3 occupancySlope = occupancyGradient(labelPosition(v), ofOccupancy);
  if (ofOccupancy)
  {
    slopeMm = normalFromLabel * occupancySlope;
    along = dot(occupancySlope, labelFromVoxel * ray.direction);
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
  bool ofCt = !between && !byMask && !byLabel;
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
#ifdef PETROUS_INTERIOR
  ray.lit += ray.transmittance * ray.row.z * reaches(ray.gathering, hit / stepLength);
#endif
  ray.transmittance *= 1.0 - ray.row.z;
}

// Through a change of state. `facing`: see shade.
int pass(inout Ray ray, float hit, float facing, inout float depth)
{
  vec3 v = positionOf(ray, hit);
#ifdef PETROUS_INTERIOR
  if (ray.state != kAir)
    passTissue(ray, hit, ray.at.value, 0.0);
#endif
  if (ray.next != kAir && (ray.state == kAir || ray.next >= kStructure))
  {
    setMaterial(ray, materialAt(v, ray.at, ray.state, ray.next));
    shade(ray, v, mmOf(ray, hit), facing);
    if (depth < 0.0)
      depth = mmOf(ray, hit);
  }
#ifdef PETROUS_INTERIOR
  if (ray.transmittance < ray.gathering.enough)
    return kEnd;
  // The state says what fills it, not the surface: a lumen's look belongs to the wall only, and
  // between two structures the other's voxels may begin just behind the hit.
  int inside = max(ray.next - kStructure, 0);
  if (ray.next != kAir && ray.material != inside)
    setMaterial(ray, inside);
  ray.value = valueAt(ray, hit, ray.at.value);
  ray.state = ray.next;
  ray.before = hit;
  ray.number = floor(hit); // the sample behind it is taken again in the new state
  ray.passed = kUnknown;
  ray.height = vec2(kNever);
  ray.summit = 0.0;
  return ray.before < ray.last ? kOn : kEnd;
#else
  return kEnd;
#endif
}

#ifdef PETROUS_INTERIOR
// From change to change, to the ray's end. Changes where only the CT counts are met in the inner loop:
// what the other bricks cost, pixels in lock step pay each time that one of them comes to such bricks,
// and not at every change.
void follow(inout Ray ray, int outcome, float facing, inout float depth)
{
  float hit = 0.0;
  int events = 0;
  while (outcome != kEnd && events < kMostEvents)
  {
    do
    {
      if (outcome == kOn)
      {
        outcome = marchIn(ray, true);
        if (outcome == kChange)
          hit = changePoint(ray, true);
      }
      if (outcome == kChange)
      {
        outcome = pass(ray, hit, facing, depth);
        facing = -1.0;
      }
      ++events;
    } while (outcome == kOn && events < kMostEvents);
#if defined(PETROUS_MASK) || defined(PETROUS_LABELS)
    if (outcome == kOtherBricks)
      outcome = marchIn(ray, false);
    bool met = outcome == kChange || outcome == kWideChange;
    if (met)
      hit = changePoint(ray, false);
    outcome = met ? kChange : (outcome == kOtherBricks ? kOn : outcome);
#endif
  }
}
#else
// To the first surface, which ends the ray.
void follow(inout Ray ray, int outcome, float facing, inout float depth)
{
  float hit = 0.0;
  bool plain = false;
  while (outcome < kWideChange)
  {
    outcome = marchIn(ray, true);
    plain = outcome == kChange;
#if defined(PETROUS_MASK) || defined(PETROUS_LABELS)
    if (outcome == kOtherBricks)
      outcome = marchIn(ray, false);
#endif
  }
  if (outcome != kEnd)
  {
    if (plain)
      hit = changePoint(ray, true);
    else if (facing < 0.0) // not on the border of what is drawn
      hit = changePoint(ray, false);
    pass(ray, hit, facing, depth);
  }
}
#endif

void main()
{
  outColor = vec4(0.0);
  outDepth = -1.0;

  vec3 view = viewCenter + ndc.x * viewX + ndc.y * viewY;
  float toMm = length(view);
  vec3 origin = originCenter + ndc.x * originX + ndc.y * originY;
  Ray ray;
  ray.direction = (directionCenter + ndc.x * directionX + ndc.y * directionY) / toMm;
  Span span = clipRay(origin, ray.direction);
  ray.first = span.first;
  float last = min(span.last, opaqueEnd(toMm));
  bool alive = last - ray.first > kThinnest * span.last;
  ray.last = (last - ray.first) / stepLength;

  ray.voxel = Way(origin + ray.first * ray.direction, ray.direction * stepLength);
  ray.brick = Way(ray.voxel.from / brickEdge, ray.voxel.by / brickEdge);
  bvec3 still = lessThanEqual(abs(ray.brick.by), vec3(1e-20));
  ray.perBrick = mix(1.0 / ray.brick.by, vec3(0.0), still);
  ray.never = mix(vec3(0.0), vec3(1e30), still);
  ray.ahead = sign(ray.brick.by);
  ray.behind = 0.5 - 0.5 * ray.ahead;
  ray.ways = waysOf(ray.voxel);
  ray.number = 0.0;
  ray.before = 0.0;
  ray.s = 0.0;
  ray.aside = kFirstAside;
  ray.top = -kNever;
  ray.height = vec2(kNever);
  ray.passed = kUnknown;
  ray.summit = 0.0;
  ray.state = kAir;
  ray.material = 0;
  ray.row = vec4(0.0);
  ray.more = vec4(0.0);
#ifdef PETROUS_INTERIOR
  ray.gathering = makeGathering();
  ray.nearest = ray.first / stepLength;
  ray.value = 0.0;
  ray.lit = 0.0;
#endif
  ray.color = vec3(0.0);
  ray.transmittance = 1.0;
  ray.at = operandsAt(ray.ways, 0.0, false);
  ray.next = alive ? stateOf(ray.at, ray.ways, 0.0, false) : kAir;
  bool face = ray.next != kAir; // it enters tissue through the border of what is drawn
  if (alive)
    follow(ray, face ? kChange : kOn, face ? span.facing : -1.0, outDepth);

#ifdef PETROUS_INTERIOR
  // What it did not go on to see is taken to look like what it saw, in the light that is there.
  if (ray.transmittance < ray.gathering.enough)
  {
    float reached = reaches(ray.gathering, ray.nearest + ray.before);
    ray.color *= 1.0 + ray.transmittance * reached / max(ray.lit, 1e-6);
    ray.transmittance = 0.0;
  }
#endif
  outColor = vec4(ray.color, 1.0 - ray.transmittance);
#ifdef PETROUS_COUNT
  outCount = vec2(fetches, samples);
#endif
}
