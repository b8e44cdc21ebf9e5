// Owen-scrambled points of a sample. Matches renderer/pipeline/sample_sequence.hpp, which cites the sources.

// Scrambles `digits`, whose first one is bit 0; in the result it is bit 31.
uint scrambled(uint digits, uint seed) {
  uint x = digits;
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16u) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return bitfieldReverse(x);
}

// Converts 24 bits: exact in a float, below 1.
float unitInterval(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }

vec2 scrambledPair(uvec2 digits, uvec2 seed) {
  return vec2(unitInterval(scrambled(digits.x, seed.x)), unitInterval(scrambled(digits.y, seed.y)));
}
