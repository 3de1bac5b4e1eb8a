// What tissue looks like, as OpticalModel.h has it: light, surfaces, and the integral along a stretch
// of one tissue. Second part of the ray caster's fragment shader; see RayCast.frag.glsl.

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

// What takes the place of bone's own colour, and whether anything does (a).
vec4 overlayAt(vec3 v)
{
#ifdef PETROUS_THICKNESS
  vec3 at = thicknessFromVoxel * v + thicknessOrigin;
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, thicknessUpper)))
    return vec4(0.0);
  COUNT(1);
  float distance = texture(thicknessTexture, at * thicknessScale + thicknessOffset).r * thicknessUnit;
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

// `overlay`: see overlayAt.
vec3 surfaceColor(int material, vec4 row, float value, float facing, float t, vec4 overlay)
{
  COUNT(1);
  float width = float(textureSize(lookTexture, 0).x);
  float u = clamp((value - row.x) * row.y, 0.0, 1.0) * (1.0 - 1.0 / width) + 0.5 / width;
  vec4 look = texture(lookTexture, vec2(u, rowCoordinate(material)));
  look.rgb = mix(look.rgb, overlay.rgb, overlay.a);
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
