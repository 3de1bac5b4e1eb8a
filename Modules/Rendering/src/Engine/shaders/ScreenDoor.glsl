// Screen-door transparency: discards pixels in an ordered 4 x 4 pattern, so that depth stays
// correct for bone drawn later. Injected into VTK's polygon shader. Uniforms: p_opacity 0 to 1;
// p_shift offsets the pattern so that two structures do not share it.
{
  const int kOrder[16] = int[16](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);
  int column = (int(gl_FragCoord.x) + p_shift) & 3;
  int row = (int(gl_FragCoord.y) + p_shift / 4) & 3;
  if ((float(kOrder[4 * row + column]) + 0.5) / 16.0 > p_opacity)
    discard;
}
