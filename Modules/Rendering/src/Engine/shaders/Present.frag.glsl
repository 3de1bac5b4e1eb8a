// Copies the ray caster's picture to the window: texel by texel if the sizes agree, otherwise
// linearly interpolated.

in vec2 ndc;
layout(location = 0) out vec4 outColor;

uniform sampler2D picture;
uniform bool sameSize;

void main()
{
  outColor = sameSize ? texelFetch(picture, ivec2((0.5 * ndc + 0.5) * vec2(textureSize(picture, 0))),
                                   0)
                      : texture(picture, 0.5 * ndc + 0.5);
}
