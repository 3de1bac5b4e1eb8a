// Two eyes' pictures in one, as composeStereo in Stereo.h states it.
//
// leftPicture, rightPicture: RGBA8, of one size, rows from the bottom
// arrangement:               0 side by side, 1 rows by turns, 2 half-colour anaglyph
// rightColumn:               where the right picture begins when side by side
// firstRow:                  the screen's row of the picture's first row from the top

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
