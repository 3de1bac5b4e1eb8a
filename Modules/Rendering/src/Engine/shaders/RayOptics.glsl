// Tissue appearance as defined in OpticalModel.h: light, surfaces, and the integral along a segment
// of one tissue. Fourth part of the ray caster's fragment shader; see RayCast.frag.glsl.

float lightAt(float t)
{
  float ratio = falloff > 0.0 ? t / falloff : 0.0;
  return light.x / (1.0 + ratio * ratio);
}

// The mean of lit colours of those shares of a pixel, times their sum, as it is displayed.
vec3 displayed(vec3 lit, float share)
{
  float sum = max(share, 1e-6);
  vec3 mean = lit / sum;
#ifdef PETROUS_TONE
  return sum * toneCurve(mean);
#else
  return sum * clamp(mean, 0.0, 1.0);
#endif
}

// Intensity used by a material.
float intensityAt(vec3 v, vec4 more)
{
#ifdef PETROUS_THIRD
  if (more.y > 1.5)
  {
    COUNT(1);
    vec3 s = clamp(thirdFromVoxel * v + thirdOrigin, vec3(0.0), thirdUpper);
    return exactly(thirdTexture, s * thirdScale + thirdOffset) * thirdUnit;
  }
#endif
#ifdef PETROUS_SECOND
  if (more.y > 0.5)
  {
    COUNT(1);
    vec3 s = clamp(secondFromVoxel * v + secondOrigin, vec3(0.0), secondUpper);
    return exactly(secondTexture, s * secondScale + secondOffset) * secondUnit;
  }
#endif
  return ctAt(clamp(v, vec3(0.0), hullUpper));
}

float rowCoordinate(int material)
{
  return (float(material) + 0.5) / float(textureSize(materialTexture, 0).y);
}

// Colour that replaces bone's own; a: 1 if it does, otherwise 0.
vec4 overlayAt(vec3 v)
{
#ifdef PETROUS_THICKNESS
  vec3 at = thicknessFromVoxel * v + thicknessOrigin;
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, thicknessUpper)))
    return vec4(0.0);
  COUNT(1);
  float distance = exactly(thicknessTexture, at * thicknessScale + thicknessOffset) * thicknessUnit;
  float share = distance / thicknessFarthest;
  if (share >= 1.0)
    return vec4(0.0);
  int last = kThicknessColors.length() - 1;
  float place = float(last) * max(share, 0.0);
  int below = min(int(place), last - 1);
  return vec4(mix(kThicknessColors[below], kThicknessColors[below + 1], place - float(below)), 1.0);
#else
  return vec4(0.0);
#endif
}

// Opacity of a surface that is not a face; see edgeOpacity and edgeFacing in OpticalModel.h.
// `slope`: of the CT, per mm, where it decides.
float opacityFrom(float opacity, float facing, bool ofCt, float slope)
{
#ifdef PETROUS_EDGES
  float square = slope * slope;
  float weight = ofCt ? square / (square + kEdgeSlope * kEdgeSlope) : 1.0;
  float path = 1.0 + edges * (1.0 / max(1.0 + weight * (facing - 1.0), kLeastFacing) - 1.0);
  return opacity < 1.0 ? 1.0 - pow(1.0 - opacity, path) : opacity;
#else
  return opacity;
#endif
}

#ifdef PETROUS_GRAIN
// See grainNoise in OpticalModel.h. `corners`: 8, or none.
float grainNoise(vec3 at, int corners)
{
  vec3 lower = floor(at);
  vec3 share = smoothstep(0.0, 1.0, at - lower);
  float noise = 0.0;
  for (int corner = 0; corner < corners; ++corner)
  {
    uvec3 up = uvec3(corner, corner >> 1, corner >> 2) & 1u;
    uvec3 part = (uvec3(ivec3(lower)) + up) * uvec3(73856093u, 19349663u, 83492791u);
    uint hash = part.x ^ part.y ^ part.z;
    hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
    hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
    hash ^= hash >> 16;
    vec3 near = mix(1.0 - share, share, vec3(up));
    noise += near.x * near.y * near.z * (2.0 * float(hash >> 8) / 16777216.0 - 1.0);
  }
  return noise;
}
#endif

// Factor of the colour of cut bone; see grainFactor in OpticalModel.h. `wanted`: otherwise 1.
float grainAt(vec3 v, float facing, float t, bool wanted)
{
#ifdef PETROUS_GRAIN
  float covered = (pixel.x + pixel.y * t) / max(facing, kLeastFacing);
  vec2 left = vec2(kCoarseShare, kFineShare) *
              (1.0 - smoothstep(kFineGrain, kCoarseGrain, covered / vec2(kCoarseCell, kFineCell)));
  float noise = left.x * grainNoise(coarseCells * v, wanted && left.x > 0.0 ? 8 : 0) +
                left.y * grainNoise(fineCells * v, wanted && left.y > 0.0 ? 8 : 0);
  return 1.0 + grain * kGrainContrast * noise;
#else
  return 1.0;
#endif
}

// Colour, and specular, of a material where it reads a value.
vec4 lookAt(int material, vec4 row, float value)
{
  COUNT(1);
  float width = float(textureSize(lookTexture, 0).x);
  float u = clamp((value - row.x) * row.y, 0.0, 1.0) * (1.0 - 1.0 / width) + 0.5 / width;
  return texture(lookTexture, vec2(u, rowCoordinate(material)));
}

// Lit, without an upper bound. `grained`: see grainAt; `overlay`: see overlayAt; `seen`: of the
// surface; `isSection`: a face, which is not lit.
vec3 surfaceColor(int material, vec4 row, float value, float facing, float t, float grained,
                  vec4 overlay, Seen seen, bool isSection)
{
  vec4 look = lookAt(material, row, value);
#ifdef PETROUS_GRAIN
  look.rgb = min(look.rgb * grained, vec3(1.0));
#endif
  look.rgb = mix(look.rgb, overlay.rgb, overlay.a);
  bool isScale = overlay.a > 0.0; // compared with a legend: no brighter than that, and its hue
  float gloss = look.a * light.z;
  float taken = isScale ? 0.0 : gloss * facing * facing;
  float diffuse = light.y * seen.sky + max(1.0 - light.y - taken, 0.0) * facing * seen.lamp;
  float highlight =
      (1.0 - light.w) * gloss * pow(facing, row.w) + light.w * pow(facing, kWetShininess);
  float reaching = lightAt(t);
  vec3 lit = (isScale ? min(reaching, plainLight) : reaching) *
             (look.rgb * diffuse + seen.lamp * highlight);
  lit = isScale ? clamp(lit, 0.0, 1.0) : lit;
  return isSection ? look.rgb : lit;
}

#ifdef PETROUS_INTERIOR
// Per-ray constants of the volume integral.
struct Gathering
{
  float lastEntry; // of the tables
  float exponent;  // log2 of the transmittance of a step with extinction 1/mm
  float lamp;      // light inside tissue, near the camera
  float dimming;   // 1 / steps, from the light's falloff
  float enough;    // transmittance at which a ray terminates
};

Gathering makeGathering()
{
  Gathering g;
  g.lastEntry = float(textureSize(depthTexture, 0).x - 1);
  g.exponent = -1.44269504 * stepLength * g.lastEntry;
  g.lamp = light.x * (light.y + (1.0 - light.y) * kInteriorFacing);
  g.dimming = falloff > 0.0 ? stepLength / falloff : 0.0;
  g.enough = max(termination, 0.0);
  return g;
}

// Attenuation of the light at a distance in steps.
float reaches(Gathering g, float steps)
{
  float dim = steps * g.dimming;
  return 1.0 / (1.0 + dim * dim);
}

// Cumulative integrals up to a table entry.
vec4 integralAt(int material, float entry)
{
  COUNT(1);
  return texelFetch(depthTexture, ivec2(int(entry), material), 0);
}

// Nearest table entry, so that the difference of two entries is exact.
float entryOf(vec4 row, Gathering g, float value)
{
  return floor(clamp((value - row.x) * (row.y * g.lastEntry), 0.0, g.lastEntry) + 0.5);
}

// 1/mm, the mean of the table's interval.
float extinctionAt(int material, vec4 row, Gathering g, float value)
{
  float entry = floor(clamp((value - row.x) * (row.y * g.lastEntry), 0.0, g.lastEntry - 1.0));
  return (integralAt(material, entry + 1.0).a - integralAt(material, entry).a) * g.lastEntry;
}

// A segment of one tissue.
struct Segment
{
  float opacity;
  vec3 color; // times `share`: colour
  float share;
};

// `steps` long, over which the intensity changes from values.x to values.y. The mean over the
// intensities in between is a difference of cumulative integrals, over at least one entry.
Segment segmentOf(int material, vec4 row, Gathering g, float steps, vec2 values)
{
  float first = entryOf(row, g, values.x);
  float last = entryOf(row, g, values.y);
  if (last == first)
    last += last > 0.5 * g.lastEntry ? -1.0 : 1.0;
  vec4 rise = integralAt(material, last) - integralAt(material, first);
  float run = last - first;
  float inverse = 1.0 / max(rise.a * run, 1e-24);
  float opacity = 1.0 - exp2(rise.a * rise.a * inverse * g.exponent * steps);
  return Segment(opacity, rise.rgb, run * inverse);
}

// Accumulates a segment centred at `middle` steps from the light, which is `lamp` near the camera.
// `lit` accumulates the opacity weighted by the light's attenuation.
void gather(Segment segment, Gathering g, float lamp, float middle, inout vec3 color,
            inout float lit, inout float transmittance)
{
  float reached = reaches(g, middle);
  vec3 shade = segment.color * (segment.share * lamp * reached);
  color += transmittance * segment.opacity * shade;
  lit += transmittance * segment.opacity * reached;
  transmittance -= transmittance * segment.opacity;
}

#ifdef PETROUS_SOFT
// Gradient over the CT's voxels of what a material reads; see GRADIENT.
vec3 intensityGradient(vec3 v, vec4 more, bool wanted)
{
  vec3 low = max(v - 1.0, vec3(0.0));
  vec3 high = min(v + 1.0, hullUpper);
  vec3 run = high - low;
  vec3 rise = vec3(0.0);
  int turns = wanted ? 6 : 0;
  for (int i = 0; i < turns; ++i)
  {
    bvec3 axis = equal(ivec3(i >> 1), ivec3(0, 1, 2));
    bool ahead = (i & 1) != 0;
    float value = intensityAt(mix(v, ahead ? high : low, axis), more);
    rise += mix(vec3(0.0), vec3(ahead ? value : -value), axis);
  }
  return mix(vec3(0.0), rise / max(run, vec3(1e-6)), greaterThan(run, vec3(0.0)));
}

// Light inside soft tissue, near the camera: of a surface where the intensity changes within a few
// voxels, as at the skin. `direction`: of the ray, voxels per mm.
float softLamp(vec3 v, vec3 direction, vec4 more, bool wanted)
{
  vec3 slope = intensityGradient(v, more, wanted);
  float size = length(normalFromVoxel * slope);
  float facing = min(abs(dot(slope, direction)) / max(size, 1e-12), 1.0);
  float weight = more.z > 0.0 ? size / (size + more.z) : 0.0;
  return light.x * (light.y + (1.0 - light.y) * mix(kInteriorFacing, facing, weight));
}
#endif
#endif
