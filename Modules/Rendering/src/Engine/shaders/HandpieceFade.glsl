// Opacity of a fragment in front of the burr, whose centre is the model's origin: 0 within p_field of
// the line of sight to it, measured at the burr's depth, 1 from twice that. For ScreenDoor.glsl,
// with which it is injected into VTK's polygon shader. Uniforms: p_field mm; p_parallel 1: in a
// parallel projection.
vec3 p_burr = MCVCMatrix[3].xyz;
vec2 p_aside = vertexVC.xy * (p_parallel == 1 ? 1.0 : p_burr.z / vertexVC.z) - p_burr.xy;
float p_opacity =
    vertexVC.z > p_burr.z ? smoothstep(p_field, 2.0 * p_field, length(p_aside)) : 1.0;
const int p_shift = 0;
