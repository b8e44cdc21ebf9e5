// A texel under a pixel, drawn at random: filtering after shading (docs/explanation/temporal.md). Draw i of a frame is a point of
// Owen-scrambled Sobol sequences, which go on over the frames.
uniform uvec2 draw_places[16];  // digits for each draw: a place in the footprint, or in the drawn texel
uniform uvec2 draw_levels[16];  // digits for each draw: one of two levels; the first dimension

// The level with texels as wide as the longer edge of a part, none finer than the finest.
float levelOfEdges(vec2 size, vec2 dx, vec2 dy) {
  vec2 edge_x = dx * size;
  vec2 edge_y = dy * size;
  return 0.5 * log2(max(max(dot(edge_x, edge_x), dot(edge_y, edge_y)), 1.0));
}

// The texel of level `level`, which need not be whole, that a trilinear lookup at `uv` takes at random: its centre and
// its level.
vec3 drawnTexel(vec2 size, vec2 uv, float level, vec2 draw, float level_draw) {
  float coarsest = float(findMSB(max(int(size.x), int(size.y))));
  float own = min(floor(min(level, coarsest) + level_draw), coarsest);
  vec2 grid = levelSize(ivec2(size), int(own));
  return vec3((floor(uv * grid - 0.5 + draw) + 0.5) / grid, own);
}

// The footprint that covers one texel.
Footprint areaOfTexel(vec2 size, vec3 texel) {
  vec2 width = 1.0 / levelSize(ivec2(size), int(texel.z));
  return Footprint(texel.xy, vec2(width.x, 0.0), vec2(0.0, width.y));
}

#if FILTER_STOCHASTIC_TRILINEAR
// One of the texels, footprint_depth levels finer, that a texel is the mean of.
vec3 texelWithin(vec2 size, vec3 texel, vec2 place) {
  float finer = footprint_depth < 0 ? 0.0 : max(texel.z - float(footprint_depth), 0.0);
  vec2 at = texel.xy + (place - 0.5) / levelSize(ivec2(size), int(texel.z));
  vec2 grid = levelSize(ivec2(size), int(finer));
  return vec3((floor(at * grid) + 0.5) / grid, finer);
}
#elif FILTER_STOCHASTIC_GAUSSIAN
// The place of a draw in the pixel: Heckbert's exp(-2 r^2), cut off at r = 1, by the inverse of its distribution. A
// part of `width` has width^2 of the variance, so the places have the rest.
vec2 drawnPlace(vec2 draw, float width) {
  float r = sqrt(-0.5 * log(1.0 - draw.x * (1.0 - exp(-2.0))) * (1.0 - width * width));
  float angle = 6.28318530718 * draw.y;
  return r * vec2(cos(angle), sin(angle));
}
#else
// The place of a draw in the pixel: the centre of one of the parts of `width` that tile it.
vec2 drawnPlace(vec2 draw, float width) { return width > 0.0 ? (floor(draw / width) + 0.5) * width - 0.5 : draw - 0.5; }
#endif

// The part of the pixel that draw i falls on: a texel of the map that is drawn from. Without such a map it is a point, or
// the whole footprint of a trilinear lookup.
FootprintPart partOf(Footprint f, int i) {
  uvec3 own = hashed(sample_pixel);
  vec2 place = scrambledPair(draw_places[i], own.xy);
  vec2 texel_draw = scrambledPair(sample_texels[i], sample_pixel.xy);
  float level_draw = unitInterval(scrambled(draw_levels[i].x, own.z));
  vec2 size = drawn_texels.xy;
#if FILTER_STOCHASTIC_TRILINEAR
  vec2 at = vec2(0.0);
  float width = 1.0;
#else
  float width = footprint_depth < 0 ? 0.0 : exp2(-float(footprint_depth));
  vec2 at = drawnPlace(place, width);
#endif
  vec2 dx = vec2(width, 0.0);
  vec2 dy = vec2(0.0, width);
  Footprint under = placed(f, at, dx, dy);
  vec3 texel = drawnTexel(size, under.uv, levelOfEdges(size, under.dx, under.dy), texel_draw, level_draw);
#if FILTER_STOCHASTIC_TRILINEAR
  texel = texelWithin(size, texel, place);
#endif
  mat2 edges = mat2(f.dx, f.dy);
  if (size == vec2(1.0) || abs(determinant(edges)) < 1e-24) return FootprintPart(at, dx, dy, under);
  Footprint normal = areaOfTexel(size, texel);
  mat2 to_pixel = inverse(edges);
  return FootprintPart(to_pixel * (normal.uv - f.uv), to_pixel * normal.dx, to_pixel * normal.dy, normal);
}
