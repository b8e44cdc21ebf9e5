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
//? if specular_variation
  Footprint specular;
//? end
//? if surface_coordinates
  Footprint surface;  // on textures that show each point of the surface once
//? end
//? if normal_layers
  Footprint layer;
//? end
};

//? if surface_coordinates
// From the tangent frame of the point that is shaded to the camera's axes: x right, y up, z towards the viewer.
mat3 tangent_to_camera;
//? end

// Texels of a mip level, by OpenGL's rule. Where neighbouring pixels ask for different levels, Mesa's llvmpipe answers
// `textureSize` for one level to eight pixels.
vec2 levelSize(ivec2 finest, int level) { return vec2(max(finest >> level, ivec2(1))); }

//? if sampling_frame
//? if anisotropic
// Explicit probes along the major axis, at the level of the minor one: the formulas of EXT_texture_filter_anisotropic,
// spelled out because drivers differ in theirs.
struct Probes {
  int count;
  float level;
  vec2 axis;
};

Probes probesOf(vec2 size, Footprint f) {
  float along_x = length(f.dx * size);
  float along_y = length(f.dy * size);
  float major = max(max(along_x, along_y), 1e-12);
  float minor = min(along_x, along_y);
  int count = int(ceil(min(major / max(minor, 1e-12), max_probes)));
  return Probes(count, log2(major / float(count)), along_x > along_y ? f.dx : f.dy);
}

vec2 probeUv(Footprint f, Probes p, int i) { return f.uv + p.axis * (float(i + 1) / float(p.count + 1) - 0.5); }

vec4 fetch(sampler2D map, Footprint f) {
  Probes p = probesOf(vec2(textureSize(map, 0)), f);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < p.count; ++i) sum += textureLod(map, probeUv(f, p, i), p.level);
  return sum / float(p.count);
}

//? if texture_arrays
vec4 fetch(sampler2DArray map, int layer, Footprint f) {
  Probes p = probesOf(vec2(textureSize(map, 0).xy), f);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < p.count; ++i) sum += textureLod(map, vec3(probeUv(f, p, i), layer), p.level);
  return sum / float(p.count);
}
//? end
//? else
// Trilinear at the level whose texels are as large as the footprint's longer edge (OpenGL 4.5, section 8.14).
float levelOf(vec2 size, Footprint f) {
  vec2 edge_x = f.dx * size;
  vec2 edge_y = f.dy * size;
  return 0.5 * log2(max(max(dot(edge_x, edge_x), dot(edge_y, edge_y)), 1e-24));
}

vec4 fetch(sampler2D map, Footprint f) { return textureLod(map, f.uv, levelOf(vec2(textureSize(map, 0)), f)); }

//? if texture_arrays
vec4 fetch(sampler2DArray map, int layer, Footprint f) {
  return textureLod(map, vec3(f.uv, layer), levelOf(vec2(textureSize(map, 0).xy), f));
}
//? end
//? end

// The finest level, whatever the footprint: no filtering.
vec4 fetchFinest(sampler2D map, Footprint f) { return textureLod(map, f.uv, 0.0); }
//? if texture_arrays
vec4 fetchFinest(sampler2DArray map, int layer, Footprint f) { return textureLod(map, vec3(f.uv, layer), 0.0); }
//? end
//? end

//? if random_draws
vec2 texel_draw;  // of this sample, uniform in [0, 1)
//? end

//? if sampling_texel
// One texel of the finest level, drawn with the bilinear weights, so that the expectation of what is shaded from it is
// the bilinear filter of radiance. Two maps of one size and coordinates draw the same texel. The sampler is `nearest`.
vec2 drawnTexel(vec2 size, Footprint f) { return (floor(f.uv * size - 0.5 + texel_draw) + 0.5) / size; }

vec4 fetchFinest(sampler2D map, Footprint f) { return textureLod(map, drawnTexel(vec2(textureSize(map, 0)), f), 0.0); }
//? if texture_arrays
vec4 fetchFinest(sampler2DArray map, int layer, Footprint f) {
  return textureLod(map, vec3(drawnTexel(vec2(textureSize(map, 0).xy), f), layer), 0.0);
}
//? end
//? end

//? if sampling_point
// The finest level at a point: the sampler decides between the nearest texel and the bilinear filter of the map's
// values.
vec4 fetchFinest(sampler2D map, Footprint f) { return textureLod(map, f.uv, 0.0); }
//? if texture_arrays
vec4 fetchFinest(sampler2DArray map, int layer, Footprint f) { return textureLod(map, vec3(f.uv, layer), 0.0); }
//? end
//? end

//? if not sampling_frame
vec4 fetch(sampler2D map, Footprint f) { return fetchFinest(map, f); }
//? if texture_arrays
vec4 fetch(sampler2DArray map, int layer, Footprint f) { return fetchFinest(map, layer, f); }
//? end
//? end

//? if texel_lookups
// The texels that `fetch` would blend, one by one, for a map whose texels must not be: eight of two levels for each
// probe. The map is known by its size alone: its chain goes down to one texel.
struct FootprintTexel {
  vec2 uv;       // the texel's centre, at its level
  float level;
  float weight;  // of this texel; all weights of a footprint sum to one
};

//? if sampling_frame
//? if anisotropic
const int most_footprint_texels = 8 * int(max_probes);
int footprintTexelCount(ivec2 finest, Footprint f) { return 8 * probesOf(vec2(finest), f).count; }
//? else
const int most_footprint_texels = 8;
int footprintTexelCount(ivec2 finest, Footprint f) { return 8; }
//? end

FootprintTexel footprintTexel(ivec2 finest, Footprint f, int i) {
//? if anisotropic
  Probes p = probesOf(vec2(finest), f);
  vec2 uv = probeUv(f, p, i >> 3);
  float level = p.level;
  float share = 1.0 / float(p.count);
//? else
  vec2 uv = f.uv;
  float level = levelOf(vec2(finest), f);
  float share = 1.0;
//? end
  float coarsest = float(findMSB(max(finest.x, finest.y)));
  level = clamp(level, 0.0, coarsest);
  float lower = floor(level);
  bool coarser = (i & 4) != 0;
  float own = min(coarser ? lower + 1.0 : lower, coarsest);
  vec2 size = levelSize(finest, int(own));
  vec2 in_texels = uv * size - 0.5;
  vec2 corner = floor(in_texels);
  vec2 part = in_texels - corner;
  vec2 side = vec2(i & 1, (i >> 1) & 1);
  vec2 bilinear = mix(1.0 - part, part, side);
  float between = coarser ? level - lower : 1.0 - (level - lower);
  return FootprintTexel((corner + side + 0.5) / size, own, share * between * bilinear.x * bilinear.y);
}
//? else
const int most_footprint_texels = 1;
int footprintTexelCount(ivec2 finest, Footprint f) { return 1; }
//? if sampling_texel
FootprintTexel footprintTexel(ivec2 finest, Footprint f, int i) {
  return FootprintTexel(drawnTexel(vec2(finest), f), 0.0, 1.0);
}
//? else
FootprintTexel footprintTexel(ivec2 finest, Footprint f, int i) { return FootprintTexel(f.uv, 0.0, 1.0); }
//? end
//? end

int footprintTexelCount(sampler2DArray map, Footprint f) { return footprintTexelCount(textureSize(map, 0).xy, f); }
FootprintTexel footprintTexel(sampler2DArray map, Footprint f, int i) {
  return footprintTexel(textureSize(map, 0).xy, f, i);
}

vec4 fetchTexel(sampler2DArray map, int layer, FootprintTexel t) { return textureLod(map, vec3(t.uv, layer), t.level); }
//? end
