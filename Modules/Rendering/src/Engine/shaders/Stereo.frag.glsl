// Combines both eyes' pictures as composeStereo in Stereo.h.
//
// leftPicture, rightPicture: RGBA8, same size, bottom row first
// arrangement:               0 side by side, 1 row-interleaved, 2 half-colour anaglyph
// rightColumn:               first column of the right picture if side by side
// firstRow:                  screen row of the picture's top row

in vec2 ndc;
layout(location = 0) out vec4 outColor;

uniform sampler2D leftPicture;
uniform sampler2D rightPicture;
uniform int arrangement;
uniform int rightColumn;
uniform int firstRow;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(leftPicture, 0);
  if (arrangement == 0)
  {
    outColor = pixel.x < rightColumn
                   ? texelFetch(leftPicture, pixel, 0)
                   : texelFetch(rightPicture, pixel - ivec2(rightColumn, 0), 0);
    return;
  }
  vec3 left = texelFetch(leftPicture, pixel, 0).rgb;
  vec3 right = texelFetch(rightPicture, pixel, 0).rgb;
  int row = size.y - 1 - pixel.y + firstRow;
  outColor = vec4(arrangement == 1 ? ((row & 1) == 0 ? left : right)
                                   : vec3(dot(left, vec3(0.299, 0.587, 0.114)), right.gb),
                  1.0);
}
