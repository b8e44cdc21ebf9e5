// What is written to a map that holds half floats is rounded here: some drivers cut the digits off instead, which
// shortens r at every level.
vec4 stored(vec4 value) {
//? if storage_fp16
  return vec4(unpackHalf2x16(packHalf2x16(value.xy)), unpackHalf2x16(packHalf2x16(value.zw)));
//? else
  return value;
//? end
}

// Of the layers that a pass draws: whether one is a coarse part of `adaptive`'s tree, before its two cells, which need no
// second look.
bool isSumOfNext(int i, int layers) {
//? if j_adaptive
  return layers > 1 && i % 3 == 0;
//? else
  return false;
//? end
}

// A coarse texel is the exact mean of the area that it covers of the next finer level, for any size: two texels along
// an even axis, three with the shares ((m - i), m, (1 + i)) / n along an odd one, n = 2m + 1 (Guthe and Heckbert 2005).
vec3 sharesOf(int i, int n) {
  if (n == 1) return vec3(1.0, 0.0, 0.0);
  if (n % 2 == 0) return vec3(0.5, 0.5, 0.0);
  int m = n / 2;
  return vec3(m - i, m, 1 + i) / float(n);
}
