// Visibility of the environment past large bodies: signed distance functions at vertices (Wang et al. 2009) as weights
// of common components, docs/explanation/shadows.md.
in vec4 visibility_weights[4];  // the first is 1, of the mean
in vec4 visible_diffuse;        // rgb: of a Lambert surface's irradiance, the visible share; a: 0 where bodies hide none

// The angle from a world direction to the nearest edge between visible and hidden; negative if it is hidden.
float signedDistance(vec3 direction) {
  vec2 uv = borderedUv(octahedral(direction), vec2(textureSize(visibility_maps, 0).xy));
  float distance = 0.0;
  for (int i = 0; i < 4; ++i) {
    distance += dot(visibility_weights[i], textureLod(visibility_maps, vec3(uv, i), 0.0));
  }
  return distance;
}

// Whether only its own horizon occludes the surface. Unknown for the back of double-sided surfaces.
bool isOpen() {
#if DOUBLE_SIDED
  if (!gl_FrontFacing) return true;
#endif
  return visible_diffuse.w == 0.0;
}

// The sine of the elevation of a direction over the nearest edge or the horizon; `elevation` is that over the horizon.
float visibleElevation(vec3 direction, float elevation) {
  if (isOpen()) return elevation;
  return min(elevation, sin(clamp(signedDistance(direction), -0.5 * pi, 0.5 * pi)));
}

// For single directions: no light from behind an edge.
bool isVisible(vec3 direction) { return isOpen() || signedDistance(direction) > 0.0; }

vec3 visibleDiffuse() {
#if DOUBLE_SIDED
  if (!gl_FrontFacing) return vec3(1.0);
#endif
  return visible_diffuse.rgb;
}
