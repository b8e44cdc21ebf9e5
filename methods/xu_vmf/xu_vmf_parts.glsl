// The parts of a footprint in the order of the map.

// Parts that cover less of the footprint are left out, which also avoids divisions by 0.
const float least_share = 1e-4;

// The rounding error of |r|: half floats lose it from every spread, 32-bit floats only from smaller spreads.
#if STORAGE_FP16
float shortfallOfMean(float size, float least) { return max(1.0 - size - 1.0 / 2048.0, least); }
#else
float shortfallOfMean(float size, float least) {
  const float rounding = 1.8e-7;
  float beyond = 1.0 - size - least;
  return beyond <= rounding ? least : least + beyond - rounding * (rounding / beyond);
}
#endif

// A part of the footprint: (w r, w), and w times the mean of 1 - |r| of its texels. 1 - |r| of the mean is never below
// that mean, because |mean r| <= mean |r|, whatever the rounding.
struct Part {
  vec4 r;
  float least;
};

// `guard`: the value of the map for `least` if it stores one; otherwise `least` is that of a facet in every texel.
Part partOf(vec4 r, float guard, float facet_shortfall) {
#if ROUGHNESS_VARIATION
  return Part(r, guard);
#else
  return Part(r, r.w * facet_shortfall);
#endif
}

#if SURFACE_COORDINATES
Footprint mapFootprint(Footprints f) { return f.surface; }
#elif NORMAL_VARIATION
Footprint mapFootprint(Footprints f) { return f.normal; }
#else
Footprint mapFootprint(Footprints f) { return f.roughness; }
#endif

// With surface coordinates the map is in camera space, unless no atlas could be made for it.
vec3 axisOf(vec3 r) {
#if SURFACE_COORDINATES
  return xu_vmf_in_camera_space > 0.5 ? r * tangent_to_camera : r;
#else
  return r;
#endif
}

// The lobe of a part that counts with `weight`, unless the part covers next to nothing.
bool hasLobe(Part part, float weight) { return part.r.w >= least_share && weight > 0.0; }

// 1 - |r| of a vector of length `size`, with the limits of a lobe.
float lobeShortfall(float size, float least) {
  return clamp(shortfallOfMean(size, least), 1.0 / largest_exponent, 1.0);
}

StoredLobe lobeOfPart(FacetsLobe own, Part part, float weight) {
  float share = weight * part.r.w;
  vec3 r = part.r.xyz / part.r.w;
  float size = length(r);
  float q = lobeShortfall(size, part.least / part.r.w);
  vec3 mean = size < 1e-6 ? vec3(0.0, 0.0, 1.0) : axisOf(r / size);
#if VARIANT_ALGORITHM1
  // Line 24 takes the vector as fetched, which is w times the mean, and line 11 adds the lobe whole.
  float fetched_q = lobeShortfall(length(part.r.xyz), part.least + 1.0 - part.r.w);
  return storedLobe(own, mean, q, fetched_q, share, weight);
#else
  return storedLobe(own, mean, q, q, share, share);
#endif
}

#if SAMPLING_FRAME && !J_1
// Algorithm 1: splits the parts of the hemisphere until one lobe serves each.
#include "xu_vmf_cells.glsl"

// A lookup of a part of one of the facets' lobes. The finest level of parts is not stored. Below level 1 the texels of
// the whole hemisphere are used, each for the part that contains its lobe.
struct Probe {
  int own;
  vec2 uv;
  float level;
  mat4 texel;    // one per column, times its share
  vec4 guard;
  ivec4 part;
};

// The four texels about a point, gathered channel by channel from the middle between them, where no hardware rounds to
// others. Each is (r, 1) or 0, so the fourth channel needs no lookup.
mat4 texelsAbout(sampler2DArray map, vec3 middle) {
  vec4 x = textureGather(map, middle, 0);
  vec4 y = textureGather(map, middle, 1);
  vec4 z = textureGather(map, middle, 2);
  vec4 covered = vec4(notEqual(abs(x) + abs(y) + abs(z), vec4(0.0)));
  return transpose(mat4(x, y, z, covered));
}

Probe probeAt(int own, vec2 uv, float level) {
  Probe p;
  p.own = own;
  p.uv = uv;
  p.level = level;
  vec2 size = vec2(textureSize(xu_vmf_whole, 0).xy);
  vec2 in_texels = uv * size - 0.5;
  vec2 corner = floor(in_texels);
  vec2 beyond = in_texels - corner;
  vec3 middle = vec3((corner + 1.0) / size, own);
  vec4 share = vec4(1.0 - beyond.x, beyond.x, beyond.x, 1.0 - beyond.x) *
               vec4(beyond.y, beyond.y, 1.0 - beyond.y, 1.0 - beyond.y);  // in the order of textureGather
  share *= 1.0 - clamp(level, 0.0, 1.0);
  p.texel = texelsAbout(xu_vmf_whole, middle);
  countLookups(4);
  for (int i = 0; i < 4; ++i) {
    p.part[i] = partOfCell(cellOf(p.texel[i].xyz));
    p.texel[i] *= share[i];
  }
  p.guard = vec4(0.0);
#if STORAGE_FP16 && ROUGHNESS_VARIATION
  p.guard = share * textureGather(xu_vmf_whole_guard, middle, 0);
  countLookups(1);
#endif
  return p;
}

// One part under one probe.
Part partAt(Probe p, float facet_shortfall, int part) {
  float share = clamp(p.level, 0.0, 1.0);
  int layers = textureSize(xu_vmf_parts, 0).z / facetsLobeCount();
  vec3 at = vec3(p.uv, p.own * layers + part);
  vec4 r = share * textureLod(xu_vmf_parts, at, p.level - 1.0);
  countLookups(1);
  float guard = 0.0;
#if STORAGE_FP16 && ROUGHNESS_VARIATION
  guard = share * textureLod(xu_vmf_parts_guard, at, p.level - 1.0).r;
  countLookups(1);
#endif
  int beyond = beyondPart(part);
  for (int i = 0; i < 4; ++i) {
    bool holds = part <= p.part[i] && p.part[i] < beyond;
    r += holds ? p.texel[i] : vec4(0.0);
    guard += holds ? p.guard[i] : 0.0;
  }
  return partOf(r, guard, facet_shortfall);
}

// The state of a walk over the parts of one of the facets' lobes.
struct Walk {
  Footprint footprint;
  int own;
  float facet_shortfall;
  int next;  // next part; the walk ends at `parts`
  int parts;
#if !SEVERAL_PROBES
  Probe probe;
#endif
#if J_ADAPTIVE && (THRESHOLDS_BLENDED || VARIANT_ALGORITHM1)
  float coarse_weight, cell_weight;  // what the hemisphere leaves to coarse parts, and a coarse part to its cells
#endif
};

#if SEVERAL_PROBES
Part partUnder(Walk walk, int part) {
  Footprint f = walk.footprint;
  Probes p = probesOf(vec2(textureSize(xu_vmf_whole, 0).xy), f);
  vec4 r = vec4(0.0);
  float least = 0.0;
  int i = 0;
  do {
    Part one = partAt(probeAt(walk.own, probeUv(f, p, i), p.level), walk.facet_shortfall, part);
    r += probeWeight(p, i) * one.r;
    least += probeWeight(p, i) * one.least;
  } while (++i < p.count);
  return Part(r, least);
}
#endif

#if J_ADAPTIVE
// How far one lobe serves a part, from 0 to 1. Algorithm 1 steps at the threshold. Cells and empty parts are not split.
float unityOf(Part part, int i) {
  if (beyondPart(i) == i + 1 || part.r.w < least_share) return 1.0;
#if VARIANT_ALGORITHM1
  float size = length(part.r.xyz);
#else
  float size = length(part.r.xyz) / part.r.w;
#endif
  float threshold = i == 0 ? option_eps0 : option_eps1;
#if THRESHOLDS_BLENDED
  return clamp((size - threshold) / 0.02 + 1.0, 0.0, 1.0);
#else
  return size > threshold ? 1.0 : 0.0;
#endif
}
#endif

Walk walkOver(Footprint f, int own, float facet_shortfall) {
  Walk walk;
  walk.footprint = f;
  walk.own = own;
  walk.facet_shortfall = facet_shortfall;
  walk.next = 0;
  walk.parts = textureSize(xu_vmf_parts, 0).z / facetsLobeCount();
#if !SEVERAL_PROBES
  walk.probe = probeAt(own, f.uv, probesOf(vec2(textureSize(xu_vmf_whole, 0).xy), f).level);
#endif
#if J_ADAPTIVE && (THRESHOLDS_BLENDED || VARIANT_ALGORITHM1)
  walk.coarse_weight = 0.0;
  walk.cell_weight = 0.0;
#endif
  return walk;
}

#if J_ADAPTIVE && VARIANT_ALGORITHM1
// Lines 6 to 16 as printed: every coarse part that is not concentrated adds the first four cells (lines 9 and 10), not
// its own two, and the other four cells are never read. The walk visits these cells once, after the coarse parts; their
// weight is the number of coarse parts that add them.
void printedStep(inout Walk walk, int i, inout float weight) {
  float unity = weight;
  bool is_coarse = i % 3 == 1;
  if (i == 0) {
    walk.coarse_weight = 1.0 - unity;
    walk.next = unity >= 1.0 ? walk.parts : 1;
  } else if (is_coarse) {
    weight = walk.coarse_weight * unity;
    walk.cell_weight += walk.coarse_weight * (1.0 - unity);
    walk.next = i < 10 ? i + 3 : walk.cell_weight > 0.0 ? 2 : walk.parts;
  } else {
    weight = walk.cell_weight;
    walk.next = i == 3 ? 5 : i == 6 ? walk.parts : i + 1;
  }
}
#endif

Part nextPart(inout Walk walk, out float weight) {
  int i = walk.next;
#if SEVERAL_PROBES
  Part part = partUnder(walk, i);
#else
  Part part = partAt(walk.probe, walk.facet_shortfall, i);
#endif
  weight = 1.0;
  ++walk.next;
#if J_ADAPTIVE
  weight = unityOf(part, i);
  int beyond = beyondPart(i);
#endif
#if J_ADAPTIVE && VARIANT_ALGORITHM1
  printedStep(walk, i, weight);
#elif J_ADAPTIVE
  if (weight >= 1.0) walk.next = beyond;
#endif
#if J_ADAPTIVE && THRESHOLDS_BLENDED && !VARIANT_ALGORITHM1
  float unity = weight;
  bool is_cell = beyond == i + 1;
  float whole = i == 0 ? 1.0 : is_cell ? walk.cell_weight : walk.coarse_weight;
  weight = whole * unity;
  if (!is_cell) walk.cell_weight = whole * (1.0 - unity);
  if (i == 0) walk.coarse_weight = 1.0 - unity;
#endif
  return part;
}
#else
// A single part: a sample of the finest level reads one texel or a blend of texels.
struct Walk {
  Footprint footprint;
  int own;
  float facet_shortfall;
  int next, parts;
};

Walk walkOver(Footprint f, int own, float facet_shortfall) { return Walk(f, own, facet_shortfall, 0, 1); }

Part nextPart(inout Walk walk, out float weight) {
  float guard = 0.0;
#if STORAGE_FP16 && ROUGHNESS_VARIATION
  guard = fetch(xu_vmf_whole_guard, 0, walk.footprint).r;
#endif
  weight = 1.0;
  ++walk.next;
  return partOf(fetch(xu_vmf_whole, walk.own, walk.footprint), guard, walk.facet_shortfall);
}
#endif
