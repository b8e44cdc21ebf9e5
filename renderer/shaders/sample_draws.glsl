// The draws of a sample of the reference: a texel of the maps, and directions. The points are those of two
// Owen-scrambled sequences (renderer/pipeline/sample_sequence.hpp), scrambled again per pixel.
#include "sample_sequence.glsl"
#include "random_numbers.glsl"

uniform ivec2 sample_origin;  // of this tile in the whole image's sample grid
uniform int sample_grid;
uniform uint sample_seed;     // of the image's sequence
uniform uvec2 sample_texels[16];  // digits for each cell of the grid
uniform vec3 drawn_texels;    // of the material: size of the map whose texels are drawn; 4 texels per sample, or 1

uvec3 sample_pixel;  // the pixel's own seeds
int sample_cell;
int sample_texel;    // of those that the sample falls on

void drawPoint() {
  ivec2 at = ivec2(gl_FragCoord.xy) + sample_origin;
  ivec2 pixel = at / sample_grid;
  ivec2 cell = at - pixel * sample_grid;
  sample_cell = cell.y * sample_grid + cell.x;
  sample_texel = 0;
  sample_pixel = hashed(uvec3(pixel, sample_seed));
  texel_draw = scrambledPair(sample_texels[sample_cell], sample_pixel.xy);
}

#if SAMPLING_TEXEL
// Draws texel i around the centre of a footprint and returns its weight in the bilinear filter. With 4 texels per
// sample the unit square of the draw is split at the texel borders, and the point is mapped into part i. Maps of the
// same size and coordinates then take each of the 4 texels once; others take theirs at random.
float drawTexel(Footprint f, int i) {
  drawPoint();
  if (drawn_texels.z < 2.0) return 1.0;
  sample_texel = i;
  vec2 upper = fract(f.uv * drawn_texels.xy - 0.5);
  vec2 lower = 1.0 - upper;
  vec2 side = vec2(i & 1, i >> 1);
  vec2 part = mix(lower, upper, side);
  texel_draw = side * lower + part * texel_draw;
  return part.x * part.y;
}
#endif
