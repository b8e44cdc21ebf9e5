// How far the length of a mean of unit normals is below 1, separated from the rounding of its components.

// The rounding error of the length for equal normals in 32 bits: three units in the last place.
const float rounding_of_floats = 1.8e-7;

// 1 - |Na| without rounding errors, which would widen narrow lobes: 0 below `rounding`, unchanged far above it.
float shortfallOfLength(float size, float rounding) {
  float shortfall = 1.0 - size;
  if (shortfall <= rounding) return 0.0;
  return shortfall - rounding * (rounding / shortfall);
}
