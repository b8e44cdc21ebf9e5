// A footprint that reaches beyond a map that does not repeat, whose outermost texels go on there.

bvec2 endsAlong() { return equal(vec2(bins_wrap_u, bins_wrap_v), vec2(2.0)); }

bool isBeyond(ivec2 texel) {
  bvec2 outer = bvec2(texel.x < 0 || texel.x >= int(mapSize().x), texel.y < 0 || texel.y >= int(mapSize().y));
  return outer.x && endsAlong().x || outer.y && endsAlong().y;
}

// The rectangle of a region that the map is in, as far as it repeats.
vec4 mapUnder(Region r) {
  vec2 lower = r.centre - r.reach;
  vec2 upper = r.centre + r.reach;
  return vec4(mix(lower, clamp(lower, vec2(0.0), mapSize()), endsAlong()),
              mix(upper, clamp(upper, vec2(0.0), mapSize()), endsAlong()));
}

float areaOnMap(Region r) {
  vec4 map = mapUnder(r);
  return any(endsAlong()) ? coveredOf(r, map.xy, map.zw) : areaOf(r);
}

void addPiece(inout Sum sum, Effective e, Region r, Query q, vec2 lower, vec2 upper, vec2 place) {
  if (any(greaterThanEqual(lower, upper))) return;
  float area = coveredOf(r, lower, upper);
  ivec2 texel = ivec2(floor(place));  // the sampler puts it on the map
  uint code = packedAt(texel);
  if (area <= 0.0 || code == no_normal) return;
  sum.value += area * texelValue(e, texel, code, q);
  sum.area += area;
}

// A piece for every texel along the map's edges, but for so many that rounds are enough for at most, of which each counts
// as the texel in its middle; and one beyond each corner.
Sum sumBeyond(Effective e, Region r, Query q, float rounds, inout bool finished) {
  Sum sum = Sum(0.0, 0.0);
  if (!any(endsAlong())) return sum;
  vec2 lower = r.centre - r.reach;
  vec2 upper = r.centre + r.reach;
  vec4 map = mapUnder(r);
  vec2 first = floor(map.xy);
  vec2 count = min(ceil(map.zw) - first, clamp(floor(0.004 * rounds), 1.0, 256.0));
  vec2 each = (ceil(map.zw) - first) / count;
  int pieces = int(max(count.x, count.y)) + 2;
  int seen = 0;
  for (int i = 0; i < pieces; ++i) {
    ++seen;
    // Of the edges along x and y: a piece each, or before and behind all of these the corners, which are beyond both.
    vec2 begin = first + float(i - 2) * each;
    vec2 end = begin + each;
    vec2 middle = begin + 0.5 * each;
    bvec2 is_along = lessThan(vec2(i - 2), count);
    if (i < 2) {
      begin.x = i == 0 ? lower.x : map.z;
      end.x = i == 0 ? map.x : upper.x;
      middle.x = 0.5 * (begin.x + end.x);
      is_along = bvec2(true, false);
    }
    if (is_along.x) {
      addPiece(sum, e, r, q, vec2(begin.x, lower.y), vec2(end.x, map.y), vec2(middle.x, 0.5 * (lower.y + map.y)));
      addPiece(sum, e, r, q, vec2(begin.x, map.w), vec2(end.x, upper.y), vec2(middle.x, 0.5 * (map.w + upper.y)));
    }
    if (is_along.y) {
      addPiece(sum, e, r, q, vec2(lower.x, begin.y), vec2(map.x, end.y), vec2(0.5 * (lower.x + map.x), middle.y));
      addPiece(sum, e, r, q, vec2(map.z, begin.y), vec2(upper.x, end.y), vec2(0.5 * (map.z + upper.x), middle.y));
    }
  }
  finished = finished && seen == pieces;
  return sum;
}
