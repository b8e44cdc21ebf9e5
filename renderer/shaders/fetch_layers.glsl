// All layers of an array texture under a footprint. In a frame one loop over the probes reads them together: their
// places, their weights and their level are those of all, and a loop of its own for each would find them again. Who
// takes it in has `const int fetched_layers`.

// As `fetchUpTo`, of all layers.
void fetchLayers(sampler2DArray map, Footprint f, float coarsest, out vec4 layers[fetched_layers]) {
//? if sampling_frame and not filter_hardware
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
//? else
  for (int l = 0; l < fetched_layers; ++l) layers[l] = fetchUpTo(map, l, f, coarsest);
//? end
}
