// Environment light for the reference: each sample integrates the environment itself.
//? if environment_visibility
//? include octahedral.glsl
//? include environment_visibility.glsl
//? end

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
