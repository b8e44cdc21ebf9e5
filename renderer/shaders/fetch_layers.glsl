// Reads all layers of an array texture under a footprint. One loop over the probes reads all layers, because position,
// weight and level are shared. Includers define `const int fetched_layers`.

// Reads every layer as `fetchUpTo` reads one.
void fetchLayers(sampler2DArray map, Footprint f, float coarsest, out vec4 layers[fetched_layers]) {
#if SAMPLING_FRAME && !FILTER_HARDWARE
  Probes p = probesOf(vec2(textureSize(map, 0).xy), f);
  countLookups(fetched_layers * p.count);
  float level = min(p.level, coarsest);
  for (int l = 0; l < fetched_layers; ++l) layers[l] = vec4(0.0);
  int i = 0;
  do {
    vec2 uv = probeUv(f, p, i);
    float weight = probeWeight(p, i);
    for (int l = 0; l < fetched_layers; ++l) layers[l] += weight * textureLod(map, vec3(uv, l), level);
  } while (++i < p.count);
#else
  for (int l = 0; l < fetched_layers; ++l) layers[l] = fetchUpTo(map, l, f, coarsest);
#endif
}
