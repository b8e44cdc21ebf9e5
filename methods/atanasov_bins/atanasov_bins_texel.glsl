// One texel of the finest level, or a surface without a normal map: one normal a sample.
struct Effective {
  vec3 normal;
  uint code;       // that, packed
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
  e.code = code;
//? else
  e.normal = vec3(0.0, 0.0, 1.0);
  e.code = up_code;
//? end
  return e;
}

float meanValue(Effective e, Query q) {
//? if roughness_bin
  countLobes(1);
  float value = q.bin == binOfPacked(e.code) ? 1.0 / binSolidAngle() : 0.0;
//? else
  float value = valueAbout(e.variance, e.normal, 0.0, q);
//? end
  return finishedValue(e.variance, value, q);
}

vec3 meanNormal(Effective e) { return e.normal; }

//? if environment_light
// Of one texel nothing is drawn but the place in its bin.
int drawCount(Effective e) {
//? if roughness_bin
  return int(option_draws);
//? else
  return 1;
//? end
}

DrawnTexel drawnTexel(Effective e, int i) { return DrawnTexel(e.code, e.variance, 1.0 / float(drawCount(e))); }
//? end
