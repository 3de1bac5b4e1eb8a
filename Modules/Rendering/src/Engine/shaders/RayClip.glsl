// Where a ray enters the drawn part of the volume, and where it ends. Second part of the ray
// caster's fragment shader; see RayCast.frag.glsl.

// Relative to the distance, a few rounding errors: shorter spans are empty, e.g. between touching
// faces.
const float kThinnest = 2e-6;

// Distances at which the ray enters and leaves the drawn part of the volume, and the cosine between
// the ray and the normal of the entry face.
struct Span
{
  float first;
  float last;
  float facing;
  bool isCut; // the entry face is of the crop box or of a clipping plane, not of the hull
};

Span clipRay(vec3 o, vec3 d)
{
  vec3 safe = mix(vec3(1e-20), d, greaterThan(abs(d), vec3(1e-20)));
  vec3 a = (boxLower - o) / safe;
  vec3 b = (boxUpper - o) / safe;
  vec3 enter = min(a, b);
  vec3 leave = max(a, b);
  // Along an axis on which the ray does not move it is either always or never inside.
  bvec3 still = lessThanEqual(abs(d), vec3(1e-20));
  bvec3 inside = lessThanEqual(abs(2.0 * o - boxLower - boxUpper), boxUpper - boxLower);
  enter = mix(enter, mix(vec3(1e30), vec3(-1e30), inside), still);
  leave = mix(leave, mix(vec3(-1e30), vec3(1e30), inside), still);
  Span span;
  span.first = max(max(enter.x, enter.y), max(enter.z, 0.0));
  span.last = min(min(leave.x, leave.y), leave.z);
  span.facing = 1.0; // the camera is inside
  span.isCut = false;
  vec3 along = abs(d) / vec3(length(normalFromVoxel[0]), length(normalFromVoxel[1]),
                             length(normalFromVoxel[2]));
  if (span.first > 0.0)
  {
    bvec3 axis = bvec3(enter.x >= max(enter.y, enter.z), enter.y >= enter.z, true);
    span.facing = axis.x ? along.x : (axis.y ? along.y : along.z);
    vec3 removed = mix(hullUpper - boxUpper, boxLower, greaterThan(d, vec3(0.0)));
    span.isCut = (axis.x ? removed.x : (axis.y ? removed.y : removed.z)) > 0.0;
  }
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
      span.isCut = true;
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
