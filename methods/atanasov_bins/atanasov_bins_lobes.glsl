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
  return clamp(count, 1.0, bins_list_count);
}

// What the packed normals of a list's texels have lost on average: where lobes are narrow it turns them.
vec2 listRounding(int list) {
  countLookups(1);
  int columns = textureSize(bins_roundings, 0).x;
  return texelFetch(bins_roundings, ivec2(list & (columns - 1), list >> findMSB(columns)), 0).rg;
}

// The mean of the texels' own slope variances, of a list.
float listWidth(int list) {
//? if roughness_lobe and roughness_variation
  countLookups(1);
  int columns = textureSize(bins_widths, 0).x;
  return texelFetch(bins_widths, ivec2(list & (columns - 1), list >> findMSB(columns)), 0).r;
//? else
  return 0.0;
//? end
}

// What a list reflects: by one lobe about the mean normal of its texels under the footprint, wider by their variance
// about it. The square's own lengths are taken there, by differences over half a bin.
float valueOfList(int list, ListBin bin, ListSum sum, Effective e, Query q) {
  vec2 mean = sum.offset / sum.area;
  vec2 variance = max(sum.squares / sum.area - mean * mean, 0.0);
  vec2 point = (bin.middle + mean) / bin.across + listRounding(list);
  float half_bin = 0.5 / bin.across;
  vec3 normal = squareToHemisphere(point);
  vec3 along_x = squareToHemisphere(point + vec2(half_bin, 0.0)) - normal;
  vec3 along_y = squareToHemisphere(point + vec2(0.0, half_bin)) - normal;
  float spread = 2.0 * (variance.x * dot(along_x, along_x) + variance.y * dot(along_y, along_y));
  return valueAbout(varianceOfLists(e) + listWidth(list), normal, spread, q);
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

// The list of a cell of disc number `own`; -1: it has none, or the disc not the cell.
int listInCell(int own, Disc disc, ivec2 cell, Effective e, Query q, float rounds) {
  if (!isIn(disc, cell) || isInEarlier(own, cell, e, q, rounds)) return -1;
  return listOfKey(uint(disc.own) << 22 | uint(cell.y) * uint(disc.across) + uint(cell.x));
}

// Whether a texel's list has been walked.
bool isNear(Effective e, uint code, float variance, Query q, float rounds) {
//? if multi_lobe and roughness_lobe
  return isInEarlier(discCount(), cellOfPacked(code, classAt(0).across), e, q, rounds);
//? else
  int own = 0;  // without a loop, which would take rounds
  if (discCount() > 1 && variance >= classAt(1).from) own = 1;
  if (discCount() > 2 && variance >= classAt(2).from) own = 2;
  if (discCount() > 3 && variance >= classAt(3).from) own = 3;
  Disc disc = discOf(own, varianceOfLists(e), q.h, mostLists(rounds));
  return isIn(disc, cellOfPacked(code, disc.across));
//? end
}

bool reachesAll(Effective e, Query q, float rounds) {
  bool all_reached = true;
  for (int i = 0; i < discCount(); ++i)
    all_reached = all_reached && discOf(i, varianceOfLists(e), q.h, mostLists(rounds)).whole;
  return all_reached;
}

// Of what the lists have not, an estimate without bias: texels at points that fill the footprint evenly.
float sumOfFar(Effective e, Region r, Query q, float rounds, inout bool finished) {
  if (reachesAll(e, q, rounds)) return 0.0;
  int count = int(drawnRounds(rounds) / float(discCount()));
  float sum = 0.0;
  int seen = 0;
  for (int i = 0; i < count; ++i) {
    ++seen;
    ivec2 texel = texelAt(r, evenPoint(i).xy);
    uint code = packedAt(texel);
    if (code == no_normal || isBeyond(texel)) continue;
    float variance = varianceAt(e, texel);
    if (!isNear(e, code, variance, q, rounds)) sum += valueAbout(variance, unpackedNormal(code), 0.0, q);
  }
  finished = finished && seen >= count;
  return sum * areaOf(r) / float(count);
}

// More lists are found than mostLists, as discs have some bins more than their area says.
const int most_found = 160;
const uint no_place = 0xFFFFFFFFu;  // of the list of the texels without a normal, which takes from the area

// The lists are found first, so that pixels that are drawn together walk at the same time, and by rounds that are
// shared among the lists that there are. (An array that were handed to a function takes compilers ten seconds.)
Sum sumOfLists(Effective e, Region r, Query q, float rounds) {
  uvec2 found[most_found];  // list; cell, of less than 2^11 along an axis, and disc
  int count = 0;
  bool finished = true;
  if (bins_invalid_list >= 0.0) found[count++] = uvec2(bins_invalid_list, no_place);
  int discs = 0;
  for (int d = 0; d < discCount(); ++d) {
    ++discs;
    Disc disc = discOf(d, varianceOfLists(e), q.h, mostLists(rounds));
    CellBlock block = cellsOf(disc);
    int seen = 0;
    for (int i = 0; i < block.count && count < most_found; ++i) {
      ++seen;
      ivec2 cell = cellIn(block, i);
      int list = listInCell(d, disc, cell, e, q, rounds);
      if (list >= 0) found[count++] = uvec2(list, cell.x | cell.y << 11 | d << 22);
    }
    finished = finished && seen == block.count;
  }
  Sum sum = sumBeyond(e, r, q, rounds, finished);
  sum.value += sumOfFar(e, r, q, rounds, finished);
  sum.area += areaOnMap(r);
  float walk = walkRounds(rounds, float(max(count, 1)));
  int walked = 0;
  for (int i = 0; i < count; ++i) {
    ++walked;
    uint place = found[i].y;
    bool invalid = place == no_place;
    ListBin bin = ListBin(vec2(place & 0x7FFu, place >> 11 & 0x7FFu) + 0.5, acrossOf(invalid ? 0 : int(place >> 22)));
    ListSum part = sumOfList(r, listAt(found[i].x), bin, walk, finished);
    if (invalid) sum.area -= part.area;
    else if (part.area > 0.0) sum.value += part.area * valueOfList(int(found[i].x), bin, part, e, q);
  }
  if (sum.area < 1e-4 * areaOf(r)) sum = Sum(0.0, 0.0);
  return finished && discs >= discCount() && walked >= count ? sum : notWhole();
}
