// Section 2.1: normals drawn from D. A point of the footprint, the bin of its texel, a normal anywhere in that bin.

// A texel that is drawn, and the share of the footprint that it stands for: 0 where there is none, or no normal.
struct DrawnTexel {
  uint code;
  float variance;  // of the lobe about it
  float share;
};

// Point i of a sequence that fills [0, 1)^4 evenly: multiples of powers of 1 / g with g^5 = g + 1 (Roberts 2018).
vec4 evenPoint(int i) { return fract(0.5 + float(i + 1) * vec4(0.85667488, 0.73389186, 0.62870672, 0.53859726)); }

// The normal that a texel reflects about: its own or, where the bin is all that is known of it, at a place of that.
vec3 normalOf(uint code, vec2 place) {
//? if roughness_bin
  return squareToHemisphere((vec2(cellOfPacked(code, bins_across)) + place) / bins_across);
//? else
  return unpackedNormal(code);
//? end
}
