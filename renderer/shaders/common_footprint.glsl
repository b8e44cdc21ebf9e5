// The footprint of a pixel on a map, and the one way to read a texture over it.

// Centre and edges of the pixel's parallelogram, in texture coordinates.
struct Footprint {
  vec2 uv;
  vec2 dx;
  vec2 dy;
};

// One footprint for each map of the material: each may have its own coordinates.
struct Footprints {
  Footprint normal;
  Footprint roughness;
  Footprint base_color;
};

//? if sampling_frame
//? if anisotropic
// Explicit probes along the major axis, at the level of the minor one: the formulas of EXT_texture_filter_anisotropic,
// spelled out because drivers differ in theirs.
vec4 fetch(sampler2D map, Footprint f) {
  vec2 size = vec2(textureSize(map, 0));
  float along_x = length(f.dx * size);
  float along_y = length(f.dy * size);
  float major = max(max(along_x, along_y), 1e-12);
  float minor = min(along_x, along_y);
  int probes = int(ceil(min(major / max(minor, 1e-12), max_probes)));
  float level = log2(major / float(probes));
  vec2 axis = along_x > along_y ? f.dx : f.dy;
  vec4 sum = vec4(0.0);
  for (int i = 1; i <= probes; ++i) sum += textureLod(map, f.uv + axis * (float(i) / float(probes + 1) - 0.5), level);
  return sum / float(probes);
}
//? else
// Trilinear at the level whose texels are as large as the footprint's longer edge (OpenGL 4.5, section 8.14).
vec4 fetch(sampler2D map, Footprint f) {
  vec2 size = vec2(textureSize(map, 0));
  vec2 edge_x = f.dx * size;
  vec2 edge_y = f.dy * size;
  float longest = max(max(dot(edge_x, edge_x), dot(edge_y, edge_y)), 1e-24);
  return textureLod(map, f.uv, 0.5 * log2(longest));
}
//? end

// The finest level, whatever the footprint: no filtering.
vec4 fetchFinest(sampler2D map, Footprint f) { return textureLod(map, f.uv, 0.0); }
//? end

//? if sampling_texel
// One texel of the finest level, drawn with the bilinear weights, so that the expectation of what is shaded from it is
// the bilinear filter of radiance. Two maps of one size and coordinates draw the same texel. The sampler is `nearest`.
vec2 texel_draw;

vec4 fetchFinest(sampler2D map, Footprint f) {
  vec2 size = vec2(textureSize(map, 0));
  return textureLod(map, (floor(f.uv * size - 0.5 + texel_draw) + 0.5) / size, 0.0);
}

vec4 fetch(sampler2D map, Footprint f) { return fetchFinest(map, f); }
//? end

//? if sampling_point
// The finest level at a point: the sampler decides between the nearest texel and the bilinear filter of the map's values.
vec4 fetchFinest(sampler2D map, Footprint f) { return textureLod(map, f.uv, 0.0); }

vec4 fetch(sampler2D map, Footprint f) { return fetchFinest(map, f); }
//? end
