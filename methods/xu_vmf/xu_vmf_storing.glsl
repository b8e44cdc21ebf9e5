// Rounds values for a map of half floats. Some drivers truncate instead, which would shorten r at every level.
vec4 stored(vec4 value) {
#if STORAGE_FP16
  return vec4(unpackHalf2x16(packHalf2x16(value.xy)), unpackHalf2x16(packHalf2x16(value.zw)));
#else
  return value;
#endif
}

// Whether a drawn layer is a coarse part of `adaptive`'s tree: the sum, without lookups, of the next two.
bool isSumOfNext(int i, int layers) {
#if J_ADAPTIVE
  return layers > 1 && i % 3 == 0;
#else
  return false;
#endif
}

// The shares of finer texels in a coarse texel, which is the exact mean of its area for any size: two texels along an
// even axis, three with the shares ((m - i), m, (1 + i)) / n along an odd one, n = 2m + 1 (Guthe and Heckbert 2005).
vec3 sharesOf(int i, int n) {
  if (n == 1) return vec3(1.0, 0.0, 0.0);
  if (n % 2 == 0) return vec3(0.5, 0.5, 0.0);
  int m = n / 2;
  return vec3(m - i, m, 1 + i) / float(n);
}
