// The tone curve of OpticalModel.h (Khronos PBR Neutral without its toe). Part of the ray caster's
// fragment shader, and injected into VTK's polygon shader. Preceded by kToneStart and
// kToneDesaturation.

vec3 toneCurve(vec3 color)
{
  vec3 lit = max(color, vec3(0.0));
  float peak = max(lit.r, max(lit.g, lit.b));
  if (peak <= kToneStart)
    return lit;
  float range = 1.0 - kToneStart;
  float next = 1.0 - range * range / (peak - kToneStart + range);
  float weight = 1.0 / (kToneDesaturation * (peak - next) + 1.0);
  return mix(vec3(next), lit * (next / peak), weight);
}
