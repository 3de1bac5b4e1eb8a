// What polygons that VTK draws see of the sky and of the lamp. Follows RayShadows.glsl in VTK's
// polygon shader, with the uniforms of RayScene.glsl that it reads.

uniform bool isShadowed; // the textures are there
uniform mat3 patientFromView; // mm
uniform mat3 voxelFromView;
uniform vec3 eyeVoxel; // the camera

// Tissue in front of a polygon that stops less than this contains it: it would not be seen in what
// stops all, which is beside it.
const float kContaining = 0.75;

// The lesser of a surface's principal curvatures, 1/mm, by the pixels around; 0 where it is not
// convex. Do Carmo, Differential Geometry of Curves and Surfaces, 1976, 3.3.
float convexity(vec3 place, vec3 normal)
{
  vec3 u = dFdx(place);
  vec3 v = dFdy(place);
  vec3 turnU = dFdx(normal);
  vec3 turnV = dFdy(normal);
  float uu = dot(u, u);
  float uv = dot(u, v);
  float vv = dot(v, v);
  float area = uu * vv - uv * uv;
  float l = dot(turnU, u);
  float m = 0.5 * (dot(turnU, v) + dot(turnV, u));
  float n = dot(turnV, v);
  if (area <= 1e-4 * uu * vv)
    return 0.0;
  float mean = 0.5 * (uu * n - 2.0 * uv * m + vv * l) / area;
  float product = (l * n - m * m) / area;
  return max(mean - sqrt(max(mean * mean - product, 0.0)), 0.0);
}

// `place`, `normal`: in view coordinates, mm.
Seen polygonSeen(vec3 place, vec3 normal)
{
  if (!isShadowed)
    return Seen(1.0, 1.0);
  vec3 way = patientFromView * place; // from the camera
  vec3 ahead = lamp.w > 0.0 ? way : patientFromView * vec3(0.0, 0.0, -1.0);
  vec3 out_ = normalize(patientFromView * normal);
  out_ = dot(out_, ahead) > 0.0 ? -out_ : out_;
  vec3 v = voxelFromView * place + eyeVoxel;
  Seen seen = seenAt(v, out_, way, 1.0, convexity(place, normal), true);
  // In translucent tissue it sees all, as do surfaces there.
  vec3 across = abs(out_ * opacityEdges);
  float texel = across.x + across.y + across.z;
  float height = 1.2 * opacityEdge;
  vec2 around = tissueAt(v + voxelFromMm * (height * out_), 0.0, ownOf(height, 0.0, texel));
  float inside = around.x * clamp((1.0 - around.y) / (1.0 - kContaining), 0.0, 1.0);
  return Seen(mix(seen.sky, 1.0, inside), mix(seen.lamp, 1.0, inside));
}
