// Lobes over a large footprint: of the bins about h by their lists, of the other texels by some that are drawn.
//? include atanasov_bins_near.glsl

// Lists that are walked: about as many as the discs have bins.
float listCount(Effective e, Query q, float rounds) {
  float count = 0.0;
  float most = mostLists(rounds);
  for (int i = 0; i < discCount(); ++i) {
    Disc disc = discOf(i, varianceOfLists(e), q.h, most);
    count += min(disc.limit, 1.0) * disc.across * disc.across;
  }
  return max(count, 1.0);
}

bool reachesAll(Effective e, Query q, float rounds) {
  bool all_reached = true;
  for (int i = 0; i < discCount(); ++i)
    all_reached = all_reached && discOf(i, varianceOfLists(e), q.h, mostLists(rounds)).whole;
  return all_reached;
}

// Mean normal and spread of a list.
vec4 listNormal(int list) {
  countLookups(1);
  int columns = textureSize(bins_normals, 0).x;
  return texelFetch(bins_normals, ivec2(list & (columns - 1), list >> findMSB(columns)), 0);
}

// Whether a disc before number `own` has the bin: each counts once.
bool isInEarlier(int own, ivec2 cell, Effective e, Query q, float rounds) {
//? if multi_lobe and roughness_lobe
  for (int i = 0; i < own; ++i) {
    if (isIn(discOf(i, varianceOfLists(e), q.h, mostLists(rounds)), cell)) return true;
  }
//? end
  return false;
}

// The list of cell i of a block, -1 where it has none or the disc not the cell.
int listInCell(int own, Disc disc, CellBlock block, int i, Effective e, Query q, float rounds) {
  ivec2 cell = cellIn(block, i);
  if (!isIn(disc, cell) || isInEarlier(own, cell, e, q, rounds)) return -1;
  return listOfKey(uint(disc.own) << 22 | uint(cell.y) * uint(disc.across) + uint(cell.x));
}

// A list is looked for in a loop of its own, so that pixels that are drawn together walk at the same time.
float sumOfDisc(int own, Effective e, Region r, Query q, float walk, float rounds, inout bool finished) {
  Disc disc = discOf(own, varianceOfLists(e), q.h, mostLists(rounds));
  CellBlock block = cellsOf(disc);
  float sum = 0.0;
  int i = 0;
  while (i < block.count) {
    int list = -1;
    while (list < 0 && i < block.count) {
      list = listInCell(own, disc, block, i, e, q, rounds);
      ++i;
    }
    if (list < 0) continue;
    vec4 normal = listNormal(list);
    float value = valueAbout(varianceOfLists(e), normal.xyz, normal.w, q);
    if (value > 0.0) sum += value * areaOfList(r, listAt(uint(list)), walk, finished);
  }
  finished = finished && i >= block.count;
  return sum;
}

float sumOfNear(Effective e, Region r, Query q, float walk, float rounds, inout bool finished) {
  float sum = 0.0;
  int seen = 0;
  for (int i = 0; i < discCount(); ++i) {
    ++seen;
    sum += sumOfDisc(i, e, r, q, walk, rounds, finished);
  }
  finished = finished && seen >= discCount();
  return sum;
}

// Whether a texel's list has been walked.
bool isNear(Effective e, uint code, float variance, Query q, float rounds) {
//? if multi_lobe and roughness_lobe
  return isInEarlier(discCount(), cellOfPacked(code, classAt(0).across), e, q, rounds);
//? else
  int own = 0;
  for (int i = 1; i < discCount(); ++i) {
    if (variance >= classAt(i).from) own = i;
  }
  Disc disc = discOf(own, varianceOfLists(e), q.h, mostLists(rounds));
  return isIn(disc, cellOfPacked(code, disc.across));
//? end
}

// Points that fill the footprint evenly: an estimate without bias of what the lists have not.
float sumOfFar(Effective e, Region r, Query q, float rounds, inout bool finished) {
  int count = int(drawnRounds(rounds) / float(discCount()));
  float sum = 0.0;
  int seen = 0;
  for (int i = 0; i < count; ++i) {
    ++seen;
    ivec2 texel = texelAt(r, evenPoint(i).xy);
    uint code = packedAt(texel);
    if (code == no_normal) continue;
    float variance = varianceAt(e, texel);
    if (!isNear(e, code, variance, q, rounds)) sum += valueAbout(variance, unpackedNormal(code), 0.0, q);
  }
  finished = finished && seen >= count;
  return sum * areaOf(r) / float(count);
}
