// The mean of the unit normals under a footprint, from the texture of `bake_mean_normal`: its direction, that of the
// surface where it has none, and its length, at most 1.
vec4 meanNormal(Footprints f) {
//? if normal_variation
  vec3 mean = fetch(mean_normal, f.normal).xyz;
//? if storage_unorm8
  mean = 2.0 * mean - 1.0;
//? end
  float size = length(mean);
  return vec4(size > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0), min(size, 1.0));
//? else
  return vec4(0.0, 0.0, 1.0, 1.0);
//? end
}
