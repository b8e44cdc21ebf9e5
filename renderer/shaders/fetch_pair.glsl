// Reads two textures of one map under a footprint. One loop over the probes reads both, because position, weight and
// level are shared.

// As `fetch`, for two textures of the same size.
void fetchPair(sampler2D first, sampler2D second, Footprint f, out vec4 of_first, out vec4 of_second) {
//? if sampling_frame and not filter_hardware
  Probes p = probesOf(vec2(textureSize(first, 0)), f);
  countLookups(2 * p.count);
  of_first = vec4(0.0);
  of_second = vec4(0.0);
  int i = 0;
  do {
    vec2 uv = probeUv(f, p, i);
    float weight = probeWeight(p, i);
    of_first += weight * textureLod(first, uv, p.level);
    of_second += weight * textureLod(second, uv, p.level);
  } while (++i < p.count);
//? else
  of_first = fetch(first, f);
  of_second = fetch(second, f);
//? end
}
