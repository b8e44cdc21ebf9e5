// How far the length of a mean of unit normals is from 1, where rounding of its components is told from their spread.

// What 32 bits take of the length of a mean of equal normals, in the texture and between its texels: three last places.
const float rounding_of_floats = 1.8e-7;

// 1 - |Na| without what rounding makes of it, which a lobe of exponent 1e6 would take for spread: nothing below
// `rounding`, and far above it as it is.
float shortfallOfLength(float size, float rounding) {
  float shortfall = 1.0 - size;
  if (shortfall <= rounding) return 0.0;
  return shortfall - rounding * (rounding / shortfall);
}
