// One texel of the finest level, or a surface without a normal map: one normal a sample.
struct Effective {
  vec3 normal;
  uint bin;
  float variance;  // of the base lobe
};

Effective effective(Footprints f) {
  Effective e;
  e.variance = baseVariance(f);
//? if normal_variation
  uint code = wordOf(fetchFinest(bins_map, f.normal));
//? if not sampling_frame
  nothing_to_shade = code == no_normal;
//? end
  e.normal = unpackedNormal(code);
  e.bin = binOfPacked(code);
//? else
  e.normal = vec3(0.0, 0.0, 1.0);
  e.bin = binIn(cellOf(e.normal));
//? end
  return e;
}

float meanValue(Effective e, Query q) {
//? if roughness_bin
  countLobes(1);
  float value = q.bin == e.bin ? 1.0 / binSolidAngle() : 0.0;
//? else
  float value = valueAbout(e.variance, e.normal, 0.0, q);
//? end
  return finishedValue(e.variance, value, q);
}

vec3 meanOfNormals(Effective e) { return e.normal; }
