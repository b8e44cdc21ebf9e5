// The integers of the precompute, four bytes each, and what they mean: packed normals and their bins.
//? include direction_grid.glsl

uint wordOf(vec4 bytes) {
  uvec4 b = uvec4(bytes * 255.0 + 0.5);
  return b.x | b.y << 8 | b.z << 16 | b.w << 24;
}

// Word i of many, in rows as long as a power of two.
uint wordAt(sampler2D words, uint i) {
  countLookups(1);
  uint columns = uint(textureSize(words, 0).x);
  return wordOf(texelFetch(words, ivec2(i & (columns - 1u), i >> findMSB(columns)), 0));
}

ivec2 unpacked(uint code) { return ivec2(code & 0xFFFFu, code >> 16); }

// A texel's normal as its point of the square, 16 bits an axis.
const uint no_normal = 0xFFFFFFFFu;
const uint up_code = 0x80008000u;  // (0, 0, 1)

ivec2 cellOfPacked(uint code, float across) {
  uint m = uint(across);
  return ivec2((code & 0xFFFFu) * m >> 16, (code >> 16) * m >> 16);
}

uint binOfPacked(uint code) {
  ivec2 cell = cellOfPacked(code, bins_across);
  return uint(cell.y) * uint(bins_across) + uint(cell.x);
}

vec3 unpackedNormal(uint code) { return squareToHemisphere((vec2(unpacked(code)) + 0.5) / 65536.0); }

ivec2 cellOf(vec3 direction) {
  return clamp(ivec2(floor(hemisphereToSquare(direction) * bins_across)), ivec2(0), ivec2(int(bins_across) - 1));
}

uint binIn(ivec2 cell) { return uint(cell.y) * uint(bins_across) + uint(cell.x); }
