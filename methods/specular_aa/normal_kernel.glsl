// Presets that widen a round lobe by the normal's changes dx and dy to the next pixels.
float sumSquared(vec3 dx, vec3 dy) { return dot(dx, dx) + dot(dy, dy); }
float longestSquared(vec3 dx, vec3 dy) { return max(dot(dx, dx), dot(dy, dy)); }

// Lobes beyond 1 (Blinn-Phong's and vMF's have no such end) stay as they are.
float saturated(float value, float before) { return min(value, max(before, 1.0)); }

float addedTo(float before, float constant, float cap, vec3 dx, vec3 dy) {
  return saturated(before + min(constant * sumSquared(dx, dy), cap), before);
}

float fourth(float x) { return x * x * x * x; }

//? if preset_unreal or preset_babylon
// On perceptual roughness.
float curvatureRoughness(float rho, vec3 dx, vec3 dy) {
  return max(rho, min(pow(max(longestSquared(dx, dy), 1e-30), 0.333), 1.0));
}
//? end

// alpha'^2 of alpha^2, which is twice the lobe's slope variance; under punctual lights.
float screenWidened(float alpha2, vec3 dx, vec3 dy) {
//? if preset_filament
  return addedTo(alpha2, 0.3, 0.04, dx, dy);
//? elif preset_unity
  return addedTo(alpha2, 0.2, 0.04, dx, dy);
//? elif preset_o3de
  return addedTo(alpha2, 0.5, 0.18, dx, dy);
//? elif preset_godot
  float alpha = addedTo(sqrt(alpha2), 0.5, 0.18, dx, dy);  // on rho^2
  return alpha * alpha;
//? elif preset_bevy
  return addedTo(alpha2, 0.25, 0.18, dx, dy);
//? elif preset_unreal
  float rho = sqrt(sqrt(alpha2));
  return max(fourth(curvatureRoughness(rho, dx, dy)), alpha2);  // no less by rounding
//? elif preset_three
  float least = max(sqrt(sqrt(alpha2)), 0.0525);
  vec3 largest = max(abs(dx), abs(dy));
  return max(fourth(saturated(least + max(max(largest.x, largest.y), largest.z), least)), alpha2);
//? elif preset_babylon
  float alpha = sqrt(alpha2);
  float rho = curvatureRoughness(sqrt(alpha), dx, dy);
  float wide = saturated(rho * rho + 5e-4, alpha);
  return max(wide * wide, alpha2);
//? else
  return addedTo(alpha2, option_constant, option_cap, dx, dy);
//? end
}

//? if preset_babylon
float screenWidenedForEnvironment(float alpha2, vec3 dx, vec3 dy) {
  float alpha = sqrt(alpha2);
  float wide = saturated(alpha + 5e-4 + 0.75 * sqrt(longestSquared(dx, dy)), alpha);
  return max(wide * wide, alpha2);
}
//? end
