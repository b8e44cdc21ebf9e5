// Lobes over a large footprint: the lists of the bins that lobes about h reach, as far as rounds suffice. The
// remainder, tails and much wider lobes, is summed over drawn texels.

// A class of texels with lobes of similar width.
struct WidthClass {
  float across;  // bins along an edge
  float widest;  // slope variance of a list in addition to the base lobe's
  float from;    // the least slope variance of its texels
};

WidthClass classAt(int i) {
  vec3 value = texelFetch(bins_classes, ivec2(i, 0), 0).xyz;
  return WidthClass(value.x, value.y, value.z);
}

// The bins of one class with centres in a cap.
struct Disc {
  int own;         // class
  float across;
  vec3 centre;
  float limit;     // 1 - cos of the cap's angle
  bool whole;      // no lobe beyond the cap reaches h
};

// The angle beyond which a lobe is below 1e-4 of its peak: 1 - cos is 4.6 alpha^2. GGX's tails reach everywhere.
float lobeReach(float variance) {
#if DISTRIBUTION_GGX && ROUGHNESS_LOBE
  return pi;
#else
  return 2.0 * asin(min(2.1448 * sqrt(variance), 1.0));
#endif
}

// A cap of about `lists` bins, or fewer if the lobes reach no further. The mean normal of a bin is up to half of the
// bin's diagonal, 1.8 / across, from its centre. By equal areas a cap of angle t has (1 - cos t) across^2 bins.
Disc discAbout(vec3 centre, int own, WidthClass widths, float reach, float lists) {
  float half_sine = sin(0.5 * min(reach + 1.8 / widths.across, pi));
  float needed = 2.0 * half_sine * half_sine;
  float affordable = widths.across * widths.across <= lists ? 2.0 : lists / (widths.across * widths.across);
  return Disc(own, widths.across, centre, min(needed, affordable), needed <= affordable);
}

#if MULTI_LOBE && ROUGHNESS_LOBE
// The normal whose facet has the lobe about `axis` turned to h. Among all rotations that take the axis to h, q = (1 +
// axis.h, axis x h) (c + s axis), that of a facet has no turn about z (facet_frame.glsl): q_z = 0.
vec3 normalTurning(vec3 axis, vec3 h) {
  float w = 1.0 + dot(axis, h);
  vec3 v = cross(axis, h);
  vec2 turn = vec2(w * axis.z + cross(v, axis).z, -v.z);  // c, s
  if (dot(turn, turn) < 1e-12 || w < 1e-6) return h;
  vec4 q = normalize(vec4(turn.x * v + turn.y * (w * axis + cross(v, axis)), turn.x * w));
  return vec3(2.0 * q.w * q.y, -2.0 * q.w * q.x, 1.0 - 2.0 * dot(q.xy, q.xy));
}

int discCount() { return max(facet_lobe_count, 1); }
float acrossOf(int disc) { return classAt(0).across; }

Disc discOf(int i, float variance, vec3 h, float lists) {
  WidthClass widths = classAt(0);
  if (facet_lobe_count == 0) return discAbout(h, 0, widths, lobeReach(variance + widths.widest), lists);
  float reach = lobeReach(facet_lobes[i].variance + widths.widest);
  return discAbout(normalTurning(facet_lobes[i].axis, h), 0, widths, reach, lists / float(discCount()));
}
#else
int discCount() { return int(bins_class_count); }
float acrossOf(int disc) { return classAt(disc).across; }

Disc discOf(int i, float variance, vec3 h, float lists) {
  WidthClass widths = classAt(i);
  return discAbout(h, i, widths, lobeReach(variance + widths.widest), lists / float(discCount()));
}
#endif

vec3 centreOf(Disc disc, ivec2 cell) { return squareToHemisphere((vec2(cell) + 0.5) / disc.across); }

bool isIn(Disc disc, ivec2 cell) { return oneMinusDot(centreOf(disc, cell), disc.centre) <= disc.limit; }

// The cells of the square that can contain bins of a disc. Lengths grow by at most 1 / (sqrt(2) cos(t / 2)) on the disc of radius sqrt(1 - cos t), and from there to the square
// by at most sqrt(1 + (4 / pi)^2) / 2.
TexelBox cellsOf(Disc disc) {
  float angle = 2.0 * asin(sqrt(0.5 * disc.limit));
  float rim = min(acos(clamp(disc.centre.z, -1.0, 1.0)) + angle, 0.5 * pi);
  float cells = disc.across * angle * 0.8096 / (sqrt(2.0) * cos(0.5 * rim));
  vec2 middle = hemisphereToSquare(disc.centre) * disc.across;
  ivec2 lower = ivec2(max(floor(middle - cells), 0.0));
  ivec2 sides = ivec2(min(floor(middle + cells), disc.across - 1.0)) - lower + 1;
  return TexelBox(lower, sides.x, sides.x * sides.y);
}

// The number of walked lists: about the bins of the discs.
float listCount(Effective e, Query q, float rounds) {
  float count = 0.0;
  float most = mostLists(rounds);
  for (int i = 0; i < discCount(); ++i) {
    Disc disc = discOf(i, varianceOfLists(e), q.h, most);
    count += min(disc.limit, 1.0) * disc.across * disc.across;
  }
  return clamp(count, 1.0, bins_list_count);
}

// A value of a list, in rows whose length is a power of two.
vec2 listValue(sampler2D values, int list) {
  countLookups(1);
  int columns = textureSize(values, 0).x;
  return texelFetch(values, ivec2(list & (columns - 1), list >> findMSB(columns)), 0).rg;
}

// The mean slope variance of the texels of a list.
float listWidth(int list) {
#if ROUGHNESS_LOBE && ROUGHNESS_VARIATION
  return listValue(bins_widths, list).r;
#else
  return 0.0;
#endif
}

// The value of a list: one lobe about the mean normal of its texels under the footprint, widened by their variance.
// Lengths on the square are converted there by differences over half a bin.
float valueOfList(int list, ListBin bin, ListSum sum, Effective e, Query q) {
  vec2 mean = sum.offset / sum.area;
  vec2 variance = max(sum.squares / sum.area - mean * mean, 0.0);
  // Plus the mean rounding of the packed normals, which turns narrow lobes.
  vec2 point = (bin.middle + mean) / bin.across + listValue(bins_roundings, list);
  float half_bin = 0.5 / bin.across;
  vec3 normal = squareToHemisphere(point);
  vec3 along_x = squareToHemisphere(point + vec2(half_bin, 0.0)) - normal;
  vec3 along_y = squareToHemisphere(point + vec2(0.0, half_bin)) - normal;
  float spread = 2.0 * (variance.x * dot(along_x, along_x) + variance.y * dot(along_y, along_y));
  return valueAbout(varianceOfLists(e) + listWidth(list), normal, spread, q);
}

// Whether a disc before `own` contains the bin, because each bin counts once.
bool isInEarlier(int own, ivec2 cell, Effective e, Query q, float rounds) {
#if MULTI_LOBE && ROUGHNESS_LOBE
  for (int i = 0; i < own; ++i) {
    if (isIn(discOf(i, varianceOfLists(e), q.h, mostLists(rounds)), cell)) return true;
  }
#endif
  return false;
}

// The list of a cell of disc `own`; -1 if the cell has no list or is not in the disc.
int listInCell(int own, Disc disc, ivec2 cell, Effective e, Query q, float rounds) {
  if (!isIn(disc, cell) || isInEarlier(own, cell, e, q, rounds)) return -1;
  return listOfKey(uint(disc.own) << 22 | uint(cell.y) * uint(disc.across) + uint(cell.x));
}

// Whether the list of a texel is walked.
bool isNear(Effective e, uint code, float variance, Query q, float rounds) {
#if MULTI_LOBE && ROUGHNESS_LOBE
  return isInEarlier(discCount(), cellOfPacked(code, classAt(0).across), e, q, rounds);
#else
  int own = 0;  // not a loop, which would take rounds
  if (discCount() > 1 && variance >= classAt(1).from) own = 1;
  if (discCount() > 2 && variance >= classAt(2).from) own = 2;
  if (discCount() > 3 && variance >= classAt(3).from) own = 3;
  Disc disc = discOf(own, varianceOfLists(e), q.h, mostLists(rounds));
  return isIn(disc, cellOfPacked(code, disc.across));
#endif
}

bool reachesAll(Effective e, Query q, float rounds) {
  bool all_reached = true;
  for (int i = 0; i < discCount(); ++i)
    all_reached = all_reached && discOf(i, varianceOfLists(e), q.h, mostLists(rounds)).whole;
  return all_reached;
}

// An unbiased estimate of the texels outside the lists: texels at points that fill the footprint evenly.
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

// More than mostLists, because discs have some bins more than their area suggests.
const int most_found = 160;
const uint no_place = 0xFFFFFFFFu;  // marks the list of texels without a normal, which is subtracted from the area

// Finds all lists first, so that pixels that are drawn together walk at the same time, and so that rounds are shared
// among the existing lists. (Passing the array to a function would take compilers ten seconds.)
Sum sumOfLists(Effective e, Region r, Query q, float rounds) {
  uvec2 found[most_found];  // list; cell (11 bits per axis) and disc
  int count = 0;
  bool finished = true;
  if (bins_invalid_list >= 0.0) found[count++] = uvec2(bins_invalid_list, no_place);
  int discs = 0;
  for (int d = 0; d < discCount(); ++d) {
    ++discs;
    Disc disc = discOf(d, varianceOfLists(e), q.h, mostLists(rounds));
    TexelBox block = cellsOf(disc);
    int seen = 0;
    for (int i = 0; i < block.count && count < most_found; ++i) {
      ++seen;
      ivec2 cell = texelIn(block, i);
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
