// Finds the tables of a footprint, and evaluates their density in a direction. The block of a texel contains its own
// table and those of its neighbours on the right, below and diagonal, in four channels. A fetch blends four nodes of
// each table, and a dot product blends four texels. ndf_atlas_lattice: its nodes, and the origin and the step of their
// places.

// A level: the number of blocks before it, and its size in texels.
struct TableLevel {
  int first;
  ivec2 size;
};

// The footprint's data that all lights share.
struct Tables {
  Footprint footprint;
  Probes probes;
  TableLevel fine;
  TableLevel coarse;
  float between;  // the weight of the coarse level
};

// One level around one probe: node (0, 0) of the block in texels of the atlas, and the weights of its four tables.
struct TableLookup {
  vec2 corner;
  vec4 weights;
};

// The lookups of the first probes, shared by all lights; the others are computed again. Indexing an array by a variable
// is the most expensive operation here on llvmpipe. The array is not in Effective, which is copied for each light.
#if SEVERAL_PROBES
const int shared_count = 4;
#else
const int shared_count = 2;
#endif
TableLookup shared_lookups[shared_count];

// A material without tables has a single block.
TableLevel tableLevel(ivec2 finest, int level) {
  if (level < int(ndf_atlas_level)) return TableLevel(0, ivec2(1));
  int first = 0;
  for (int i = int(ndf_atlas_level); i < level; ++i) {
    ivec2 size = max(finest >> i, ivec2(1));
    first += size.x * size.y;
  }
  return TableLevel(first, max(finest >> level, ivec2(1)));
}

// A position in texels from the centre of the first one, wrapped as the map's sampler does.
float wrapped(float position, float size, float wrap) {
  if (wrap == 0.0) return mod(position, size);
  float place = position + 0.5;
  if (wrap == 1.0) place = size - abs(mod(place, 2.0 * size) - size);
  return clamp(place - 0.5, 0.0, size - 1.0);
}

// The block of the four texels around a position, with their weights.
struct TexelBlock {
  ivec2 place;
  vec4 weights;
};

TexelBlock blockAt(TableLevel level, vec2 uv, float weight) {
  vec2 size = vec2(level.size);
  vec2 at = uv * size - 0.5;
  at = vec2(wrapped(at.x, size.x, ndf_atlas_wrap_u), wrapped(at.y, size.y, ndf_atlas_wrap_v));
  ivec2 corner = min(ivec2(at), level.size - 1);
  vec2 part = at - vec2(corner);
  vec2 rest = 1.0 - part;
  int block = level.first + corner.y * level.size.x + corner.x;
  int columns = int(ndf_atlas_column_bits);
  ivec2 place = ivec2(block & ((1 << columns) - 1), block >> columns);
  return TexelBlock(place, weight * vec4(rest.x * rest.y, part.x * rest.y, rest.x * part.y, part.x * part.y));
}

// Lookup `i`. Each probe has two: the fine level's and the coarse one's.
TexelBlock blockOf(Tables t, int i) {
  int probe = i >> 1;
  bool coarse = (i & 1) != 0;
  TableLevel level = TableLevel(coarse ? t.coarse.first : t.fine.first, coarse ? t.coarse.size : t.fine.size);
  float weight = probe < t.probes.count ? probeWeight(t.probes, probe) : 0.0;
  return blockAt(level, probeUv(t.footprint, t.probes, probe), weight * (coarse ? t.between : 1.0 - t.between));
}

// Tables store densities times the share of a texel that has valid normals.
float coverageOf(TexelBlock block) {
  countLookups(1);
  return dot(block.weights, texelFetch(ndf_atlas_blocks, ivec2(2 * block.place.x + 1, block.place.y), 0));
}

TableLookup lookupOf(TexelBlock block) {
  countLookups(1);
  vec4 scales = texelFetch(ndf_atlas_blocks, ivec2(2 * block.place.x, block.place.y), 0);
  return TableLookup(vec2(block.place) * ndf_atlas_lattice[0], block.weights * scales);
}

// The tables of a footprint, and the share of it that they cover.
float findTables(Footprint f, ivec2 finest, Probes p, out Tables t) {
  float coarsest = float(findMSB(max(finest.x, finest.y)));
  float level = clamp(p.level, min(ndf_atlas_level, coarsest), coarsest);
  float lower = floor(level);
  t.footprint = f;
  t.probes = p;
  t.between = level - lower;
  t.fine = tableLevel(finest, int(lower));
  t.coarse = t.fine;
  if (lower < coarsest)
    t.coarse = TableLevel(t.fine.first + t.fine.size.x * t.fine.size.y, max(finest >> (int(lower) + 1), ivec2(1)));
  float covered = 0.0;
  for (int i = 0; i < shared_count; ++i) {
    TexelBlock block = blockOf(t, i);
    covered += coverageOf(block);
    shared_lookups[i] = lookupOf(block);
  }
  for (int i = shared_count; i < 2 * p.count; ++i) covered += coverageOf(blockOf(t, i));
  return covered;
}

float nodesAt(TableLookup lookup, vec2 node, vec2 texel) {
  countLookups(1);
  return dot(textureLod(ndf_atlas_densities, (lookup.corner + node) * texel, 0.0), lookup.weights);
}

// A lookup over Lambert's equal-area map. Beyond the lattice the border nodes continue.
float tableSum(Tables t, vec3 h) {
  vec2 plane = h.xy * inversesqrt(max(0.5 + 0.5 * h.z, 1e-4));
  vec2 node = (plane - ndf_atlas_lattice[1]) / ndf_atlas_lattice[2];
  node = clamp(node, vec2(0.0), ndf_atlas_lattice[0] - 1.0) + 0.5;
  vec2 texel = 1.0 / vec2(textureSize(ndf_atlas_densities, 0));
  float sum = 0.0;
  for (int i = 0; i < shared_count; ++i) sum += nodesAt(shared_lookups[i], node, texel);
  for (int i = shared_count; i < 2 * t.probes.count; ++i) sum += nodesAt(lookupOf(blockOf(t, i)), node, texel);
  return sum;
}
