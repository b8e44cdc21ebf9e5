// Environment light for the reference: each sample integrates the environment itself.
//? if environment_visibility
//? include octahedral.glsl
//? include environment_visibility.glsl
//? end

// f * cos of one direction in the tangent frame.
vec3 reflectance(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) {
  vec3 f_cos = specular(e, f0, wi, wo);
//? if diffuse
  f_cos += diffuse(e, albedo, f0, wi, wo);
//? end
  return f_cos;
}

// Whether light from a direction of the world reaches the pixel.
bool arrives(vec3 direction) {
//? if environment_visibility
  return isVisible(direction);
//? else
  return true;
//? end
}

//? if environment_dense
//? include environment_dense.glsl
//? else
//? include environment_drawn.glsl
//? end
