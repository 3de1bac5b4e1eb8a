// Casts one ray per pixel through CT, labels, mask and a second image simultaneously [Chan2013,
// 2.2]; states, surfaces and integrals are defined in OpticalModel.h.
//
// Nested loops: the inner ones only sample, skipping empty bricks, until the ray's state changes;
// the outer one refines that change, computes the normal and shades it. There are two inner loops,
// for bricks where only the CT matters and for the others, because SIMT hardware pays for a branch
// not taken by a pixel, but not for a loop that no pixel enters. Positions are in CT voxels (0 at
// the first centre), distances from the camera in mm.
//
// Last part of the fragment shader, after RayScene.glsl (textures, uniforms, features),
// RayClip.glsl, RayShadows.glsl, ToneCurve.glsl (with TONE), RayOptics.glsl and RayMarch.glsl.

// Bracket of a change of state.
struct Bracket
{
  float low;
  float high;
  vec3 atLow; // operands
  vec3 atHigh;
  vec2 weight; // weights of the ends
  float hit;
  int state; // at `hit`
  bool open;
};

// Operand at an end that decides between the ray's state and the next.
float deciding(Ray ray, vec3 operands)
{
#ifdef PETROUS_SOFT
  if (ray.state <= kAir && ray.next <= kAir)
    return operands.z;
#endif
  return ray.state > kAir && ray.next > kAir ? operands.y : fieldOf(operands);
}

// A few steps of false position with the Illinois modification, then bisection: where false
// position fails (next to NaN), where nothing crosses 0 (between two structures) and where an end
// is unknown. `plain`: only the CT matters there. The ray's operands and next state become those of
// the last position.
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
    ray.at = operandsAt(ray.ways, bracket.hit, plain, true);
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
    bool met = abs(deciding(ray, here)) <= kOnSurface; // never with NaN
    bracket.open = !met && bracket.high - bracket.low > 1.0 / 256.0;
  }
}

// Locates the change of state before the last sample; the ray's operands and next state become
// those at that position. `plain`: only the CT matters there.
float changePoint(inout Ray ray, const bool plain)
{
  bool aside = ray.s < ray.before; // found by the search for a thin wall
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
  // The operands just in front of the surface determine what begins there; it may end before
  // `high`.
  if (!plain && bracket.state == ray.state && ray.next > kAir && ray.state <= kBone)
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

// Material of a surface at a position, at the transition from one state to the next.
int materialAt(vec3 v, Operands at, int state, int next)
{
#ifdef PETROUS_LABELS
#ifdef PETROUS_NESTED
  if (state >= kStructure && next > kAir)
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

// Shades the surface at `hit`; `facing` < 0: use the normal of the deciding operand.
void shade(inout Ray ray, vec3 v, float hit, float facing)
{
  Operands at = ray.at;
  int outer = min(ray.state, ray.next); // where a ray leaves, too, the border to air decides
  vec3 slopeMm = vec3(0.0);
  float along = 0.0;
#ifdef PETROUS_NESTED
  bool between = outer >= kStructure; // between two structures
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
  bool byLabel = !between && (outer == kBone || at.occupancy - 0.5 > at.ct);
#else
  const bool byLabel = false;
#endif
#ifdef PETROUS_MASK
  bool byMask = !between && outer != kBone && at.left - 0.5 < max(at.ct, at.occupancy - 0.5);
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
  bool isFace = facing >= 0.0;
  bool isSection = isFace && section.y > 0.0;
  bool isGrey = isSection && ray.material == 0;
  float opacity = ray.row.z;
  if (!isFace)
  {
    facing = 1.0; // zero gradient: facing the camera
    if (size > 1e-12)
    {
      facing = min(abs(along) / size, 1.0);
      below += voxelFromMm * (slopeMm * (colorDepth / size));
    }
    opacity = opacityFrom(opacity, facing, ofCt, size);
  }
  bool isAside = !isFace && ofCt && ray.row.z >= kSmoothOpacity && any(notEqual(aside, vec3(0.0)));
  vec3 asideSlope = ctGradient(clamp(v + aside, vec3(0.0), hullUpper), isAside, true);
  if (isAside)
  {
    vec3 asideMm = normalFromVoxel * asideSlope;
    float asideSize = max(length(asideMm), 1e-12);
    float alike = dot(asideMm, slopeMm) / (asideSize * max(size, 1e-12));
    float asideFacing = min(abs(dot(asideSlope, ray.direction)) / asideSize, 1.0);
    float share = min(asideSize / (kAsideSlope * max(size, 1e-12)), kMostAside);
    float weight = smoothstep(kUnlike, kAlike, alike) * share;
    facing = clamp(facing + weight * (asideFacing - facing), 0.0, 1.0);
  }
  Seen seen = Seen(1.0, 1.0);
#ifdef PETROUS_SHADOWS
  bool shadowed = !isFace && ray.state <= kAir && size > 1e-12 &&
                  ray.transmittance * opacity > kLeastShadowed;
  vec3 normal = shadowed ? slopeMm / (along > 0.0 ? -size : size) : -ray.unit;
  seen = seenAt(v, normal, ray.unit, hit, 0.0, shadowed);
#endif
  float value = intensityAt(below, isGrey ? vec4(0.0) : ray.more);
  if (isGrey)
    overlay = vec4(vec3(clamp((value - section.x) * section.y, 0.0, 1.0)), 1.0);
  float grained = grainAt(v, facing, hit, byMask && bony);
  vec3 lit =
      surfaceColor(ray.material, ray.row, value, facing, hit, grained, overlay, seen, isSection);
  float adds = ray.transmittance * opacity;
  bool isPlain = isSection || overlay.a > 0.0;
  ray.color += isPlain ? vec3(0.0) : adds * lit;
  ray.plain += isPlain ? adds * vec4(lit, 1.0) : vec4(0.0);
#ifdef PETROUS_INTERIOR
  ray.lit += ray.transmittance * opacity * reaches(ray.gathering, hit / stepLength);
#endif
  ray.transmittance *= 1.0 - opacity;
}

// Passes a change of state. `facing`: see shade.
int pass(inout Ray ray, float hit, float facing, inout float depth)
{
  vec3 v = positionOf(ray, hit);
#ifdef PETROUS_INTERIOR
  if (ray.state != kAir)
    passTissue(ray, hit, ray.at.value, 0.0);
#endif
  bool isSurface = ray.next > kAir && (ray.state <= kAir || ray.next >= kStructure);
#ifdef PETROUS_EXITS
  isSurface = isSurface || (ray.state > kAir && ray.next <= kAir);
#endif
  if (isSurface)
  {
    setMaterial(ray, materialAt(v, ray.at, ray.state, ray.next));
    shade(ray, v, mmOf(ray, hit), facing);
    if (depth < 0.0)
      depth = mmOf(ray, hit);
  }
#ifdef PETROUS_INTERIOR
  if (ray.transmittance < ray.gathering.enough)
    return kEnd;
  // The state determines the material inside, not the surface: a lumen's material applies to its
  // wall only, and between two structures the voxels of the other may begin just behind the hit.
  int inside = max(ray.next - kStructure, 0);
#ifdef PETROUS_SOFT
  if (ray.next == kSoft)
    inside = textureSize(materialTexture, 0).y - 1;
#endif
  if (ray.next != kAir && ray.material != inside)
    setMaterial(ray, inside);
  ray.value = valueAt(ray, hit, ray.at.value);
#ifdef PETROUS_SOFT
  if (ray.next == kSoft && facing >= 0.0 && ray.isCut && section.y > 0.0)
  {
    if (extinctionAt(inside, ray.row, ray.gathering, ray.value) > kSoftInSection)
    {
      float grey = clamp((ray.at.value - section.x) * section.y, 0.0, 1.0);
      vec3 face = ray.more.y > 0.5 ? lookAt(inside, ray.row, ray.value).rgb : vec3(grey);
      ray.plain += ray.transmittance * vec4(face, 1.0);
      ray.transmittance = 0.0;
      depth = mmOf(ray, hit);
      return kEnd;
    }
  }
#endif
  ray.state = ray.next;
  ray.before = hit;
  ray.number = floor(hit); // the next sample is taken again in the new state
  ray.passed = kUnknown;
  ray.height = vec2(kNever);
  ray.summit = 0.0;
  return ray.before < ray.last ? kOn : kEnd;
#else
  return kEnd;
#endif
}

#ifdef PETROUS_INTERIOR
// From change to change, to the ray's end. Changes where only the CT matters are handled in the
// inner loop: on SIMT hardware the cost of the other bricks is then paid when a pixel reaches such
// bricks, and not at every change.
void follow(inout Ray ray, int outcome, float facing, inout float depth)
{
  float hit = 0.0;
  int events = 0;
  while (outcome != kEnd && events < kMaxEvents)
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
    } while (outcome == kOn && events < kMaxEvents);
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
// Up to the first surface, which ends the ray.
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
    else if (facing < 0.0) // not on the border of the drawn region
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
#ifdef PETROUS_SHADOWS
  ray.unit = view / toMm;
#endif
  Span span = clipRay(origin, ray.direction);
#ifdef PETROUS_SOFT
  ray.isCut = span.isCut;
#endif
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
  ray.plain = vec4(0.0);
  ray.transmittance = 1.0;
  ray.at = operandsAt(ray.ways, 0.0, false, true);
  ray.next = alive ? stateOf(ray.at, ray.ways, 0.0, false) : kAir;
  bool face = ray.next != kAir; // enters tissue through the border of the drawn region
  if (alive)
    follow(ray, face ? kChange : kOn, face ? span.facing : -1.0, outDepth);

  // Exposure and tone curve are of the whole pixel: what is too bright behind a veil still differs.
  vec3 color = displayed(ray.color, 1.0 - ray.transmittance - ray.plain.a) + ray.plain.rgb;
#ifdef PETROUS_INTERIOR
  // The rest is assumed to look like what was seen, with the light there.
  if (ray.transmittance < ray.gathering.enough)
  {
    float reached = reaches(ray.gathering, ray.nearest + ray.before);
    color *= 1.0 + ray.transmittance * reached / max(ray.lit, 1e-6);
    ray.transmittance = 0.0;
  }
#endif
  outColor = vec4(color, 1.0 - ray.transmittance);
#ifdef PETROUS_COUNT
  outCount = vec2(fetches, samples);
#endif
}
