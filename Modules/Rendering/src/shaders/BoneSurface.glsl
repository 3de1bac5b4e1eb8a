// The first surface of min(c_CT, mask - 0.5) along a ray, as the tissue field defines it.
//
// Put into VTK's volume shader. Textures (of VTK):
//   in_volume[0]  r: CT, g: mask 0..1 where PETROUS_MASK is defined; 16 bits normalised, or float
//   in_mask       r: macrocells of kCellEdge^3 voxels, 8 bits: how many cells away the nearest one
//                 is that may hold tissue (Chebyshev; 0: this one), so that a ray leaps over air
// Uniforms: p_iso, p_perHu   threshold and 1 / scale in the texture's own unit
//           p_ramp           CT value of p_cellular and of p_cortical, texture's own unit
//           p_spacing, p_dims  mm, voxels
//           p_light          ambient, specular, shininess, intensity
//           p_colorDepth     mm below the surface at which the density gives the colour

const float kCellEdge = 8.0;

float boneCt(vec3 p)
{
  return (texture(in_volume[0], p).r - p_iso) * p_perHu;
}

#ifdef PETROUS_MASK
float boneMask(vec3 p)
{
  return texture(in_volume[0], p).g - 0.5;
}
float boneField(vec3 p)
{
  vec2 s = texture(in_volume[0], p).rg;
  return min((s.r - p_iso) * p_perHu, s.g - 0.5);
}
#else
float boneField(vec3 p)
{
  return boneCt(p);
}
#endif

// Difference over +-1 voxel along one axis, one-sided at the border, per mm.
float boneSlope(vec3 p, int axis, bool cut)
{
  vec3 low = p;
  vec3 high = p;
  float reach = 1.0 / p_dims[axis];
  low[axis] = max(p[axis] - reach, in_texMin[0][axis]);
  high[axis] = min(p[axis] + reach, in_texMax[0][axis]);
  float run = (high[axis] - low[axis]) * p_dims[axis] * p_spacing[axis];
  if (run <= 0.0)
    return 0.0;
#ifdef PETROUS_MASK
  if (cut)
    return (boneMask(high) - boneMask(low)) / run;
#endif
  return (boneCt(high) - boneCt(low)) / run;
}

// Out of the tissue; the gradient of the operand that decides.
vec3 boneNormal(vec3 p)
{
  bool cut = false;
#ifdef PETROUS_MASK
  cut = boneMask(p) < boneCt(p);
#endif
  vec3 slope = vec3(boneSlope(p, 0, cut), boneSlope(p, 1, cut), boneSlope(p, 2, cut));
  float size = length(slope);
  return size > 0.0 ? -slope / size : vec3(0.0);
}

// Steps from p after which the ray has left the block of cells that hold no tissue.
float boneLeap(vec3 p, vec3 stepVoxels)
{
  vec3 v = p * p_dims - 0.5;
  ivec3 cells = textureSize(in_mask, 0);
  ivec3 cell = clamp(ivec3(floor(v / kCellEdge)), ivec3(0), cells - 1);
  float away = floor(texelFetch(in_mask, cell, 0).r * 255.0 + 0.5);
  if (away < 0.5)
    return 0.0;
  vec3 lower = (vec3(cell) - (away - 1.0)) * kCellEdge;
  vec3 upper = (vec3(cell) + away) * kCellEdge;
  vec3 wall = mix(lower, upper, greaterThan(stepVoxels, vec3(0.0)));
  vec3 steps = (wall - v) / mix(vec3(1e-9), stepVoxels, greaterThan(abs(stepVoxels), vec3(1e-9)));
  steps = mix(vec3(1e9), steps, greaterThan(abs(stepVoxels), vec3(1e-9)));
  return max(min(min(steps.x, steps.y), steps.z), 0.0);
}

vec4 castBone()
{
  vec3 rayDir = computeRayDirection();
  // VTK starts one step inside; the surface may lie before it.
  vec3 start = clamp(g_dataPos - g_rayJitter, in_texMin[0], in_texMax[0]);
  vec3 stepVoxels = g_dirStep * p_dims;

  vec3 border = mix(in_texMin[0], in_texMax[0], greaterThan(g_dirStep, vec3(0.0)));
  vec3 toBorder = mix(vec3(1e9), (border - start) / g_dirStep,
                      greaterThan(abs(g_dirStep), vec3(1e-12)));
  float last = min(min(toBorder.x, toBorder.y), toBorder.z);
  // Where a polygon's surface and the bone's coincide, the polygon (a structure) is seen.
  last = min(last, g_terminatePointMax + 1.0 - 0.1);
  if (last < 0.0)
    return vec4(0.0);

  float hit = -1.0;
  if (boneField(start) > 0.0)
    hit = 0.0;
  else
  {
    // Samples stay on the lattice of whole steps, whatever is leapt over, so that the picture does
    // not depend on the macrocells.
    float t = 0.0;
    while (t < last)
    {
      float leap = boneLeap(start + t * g_dirStep, stepVoxels);
      t = max(t + 1.0, floor(t + leap));
      float at = min(t, last);
      if (boneField(start + at * g_dirStep) > 0.0)
      {
        float air = min(max(t - 1.0, 0.0), at);
        float solid = at;
        for (int i = 0; i < 10; ++i)
        {
          float middle = 0.5 * (air + solid);
          if (boneField(start + middle * g_dirStep) > 0.0)
            solid = middle;
          else
            air = middle;
        }
        hit = 0.5 * (air + solid);
        break;
      }
    }
  }
  if (hit < 0.0)
    return vec4(0.0);

  vec3 p = start + hit * g_dirStep;
  vec3 normal = hit > 0.0 ? boneNormal(p) : vec3(0.0);
  if (hit == 0.0)
  {
    // Tissue that the volume's border cuts off: lit as the flat face that it is there.
    vec3 fromBorder = min(abs(p - in_texMin[0]), abs(p - in_texMax[0])) * p_dims;
    if (min(min(fromBorder.x, fromBorder.y), fromBorder.z) < 0.01)
      normal = fromBorder.x < min(fromBorder.y, fromBorder.z)
                 ? vec3(1.0, 0.0, 0.0)
                 : (fromBorder.y < fromBorder.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0));
  }
  float facing = clamp(abs(dot(normal, rayDir)), 0.0, 1.0);
  if (dot(normal, normal) < 0.5)
    facing = 1.0; // no slope: facing the eye, as in the reference

  vec3 below = hit > 0.0 ? normal : vec3(0.0);
  vec3 inside = clamp(p - below * p_colorDepth / (p_spacing * p_dims), in_texMin[0], in_texMax[0]);
  float density = texture(in_volume[0], inside).r;
  vec3 color =
    mix(p_cellular, p_cortical, clamp((density - p_ramp.x) / (p_ramp.y - p_ramp.x), 0.0, 1.0));
  float diffuse = p_light.x + (1.0 - p_light.x) * facing;
  vec3 lit = p_light.w * (color * diffuse + vec3(p_light.y * pow(facing, p_light.z)));
  return vec4(clamp(lit, 0.0, 1.0), 1.0);
}
