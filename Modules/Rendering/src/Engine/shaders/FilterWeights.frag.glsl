// The card's filter between two texels, 0 and 1, at the weights (n + 0.5) / columns.
in vec2 ndc;
out vec4 outWeight;

uniform sampler3D image;
uniform float columns;

void main()
{
  float wanted = gl_FragCoord.x / columns; // the pixel's centre: n + 0.5
  outWeight = vec4(texture(image, vec3(0.25 + 0.5 * wanted, 0.5, 0.5)).r, 0.0, 0.0, 1.0);
}
