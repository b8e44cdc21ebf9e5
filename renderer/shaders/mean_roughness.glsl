// The base lobe of the mean roughness under a footprint, from the texture of bake_mean_roughness (normal_chain.hpp).
float baseLobe(Footprints f) {
#if ROUGHNESS_VARIATION
  return lobeFromRoughness(fetch(mean_roughness, f.roughness).r);
#else
  return lobe_cutoff.x;
#endif
}
