// Copies the ray caster's picture to the window: texel by texel if the sizes agree, otherwise
// linearly interpolated. Within a circle it fades into a finer picture of the same view.

in vec2 ndc;
layout(location = 0) out vec4 outColor;

uniform sampler2D picture;
uniform bool sameSize;
uniform float share; // what the picture is multiplied by
uniform sampler2D fovea;
uniform bool hasFovea;
uniform vec2 windowSize; // pixels
uniform vec3 foveaCircle; // centre from the lower left, radius, pixels

// Of the radius: the finer picture alone is shown up to here.
const float kInner = 0.75;

vec4 texelOf(sampler2D from, bool exact)
{
  vec2 at = 0.5 * ndc + 0.5;
  return exact ? texelFetch(from, ivec2(at * vec2(textureSize(from, 0))), 0) : texture(from, at);
}

void main()
{
  outColor = texelOf(picture, sameSize);
  if (share != 1.0)
    outColor *= share;
  if (hasFovea)
  {
    float away = distance((0.5 * ndc + 0.5) * windowSize, foveaCircle.xy) / foveaCircle.z;
    if (away < 1.0)
      outColor = mix(texelOf(fovea, textureSize(fovea, 0) == ivec2(windowSize)), outColor,
                     smoothstep(kInner, 1.0, away));
  }
}
