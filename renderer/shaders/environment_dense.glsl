// Environment light for the reference as directional lights, all of them for every sample (Iwasaki et al. 2012): what
// the drawn directions must come to where no lobe is narrower than a light's cell.
vec3 environmentIntegral(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
  int count = textureSize(environment_lights, 0).x;
  int i = 0;
  for (; i < count; ++i) {
    vec3 direction = texelFetch(environment_directions, ivec2(i, 0), 0).xyz;
    vec3 wi = direction * p.frame;
    if (!reachesFacets(wi) || !arrives(direction)) continue;
    radiance += reflectance(p, wi) * texelFetch(environment_lights, ivec2(i, 0), 0).rgb;
  }
  // llvmpipe ends loops after 65535 rounds a pixel, those within `reflectance` among them: part of a sum is no figure.
  if (i < count) return vec3(uintBitsToFloat(0x7fc00000u));
  return radiance;
}
