// Directions that samples of the reference draw from the lobes of a point, and the digits that they are drawn from.
uniform int directions_per_sample;
// Digits of the first direction of each cell, and of directions by their index in the sample. Any direction adds the
// two without carry. Separate digits for the environment, the lobe, and the choice of a lobe.
uniform uvec4 cell_directions[16], direction_steps[16];
uniform uint cell_choices[16], choice_steps[16];

#if CLEAR_COAT
const float coat_draws = 0.25;  // of the directions that lobes draw, where there is a coat

// The mirror image of wo about a normal drawn from the facets of the coat.
vec3 coatDirection(Coat coat, vec3 wo, vec2 u) {
  float tilt = tiltOf(coat.alpha2 * u.x / max(1.0 - u.x, 1e-7));
  float sine = sqrt(max(tilt * (2.0 - tilt), 0.0));
  float azimuth = 2.0 * pi * u.y;
  vec3 h = frameAbout(coat.normal) * vec3(sine * cos(azimuth), sine * sin(azimuth), 1.0 - tilt);
  float cosine = dot(h, wo);
  return cosine > 0.0 ? 2.0 * cosine * h - wo : vec3(0.0);
}

float coatDirectionDensity(Coat coat, vec3 wi, vec3 wo) {
  if (!halfVectorIsDefined(wi, wo)) return 0.0;
  vec3 h = halfVector(wi, wo);
  return ggxDensity(coat.alpha2, coat.normal, h) * max(dot(coat.normal, h), 0.0) / (4.0 * max(dot(h, wo), 1e-6));
}
#endif

// Draws a direction from the lobes of the point, and returns its density.
vec3 lobeDirection(SurfacePoint p, vec3 u) {
#if CLEAR_COAT
  if (p.coat.share > 0.0) {
    if (u.z < coat_draws) return coatDirection(p.coat, p.wo, u.xy);
    u.z = (u.z - coat_draws) / (1.0 - coat_draws);
  }
#endif
  return drawDirection(p.effective, p.wo, u);
}

float lobeDirectionDensity(SurfacePoint p, vec3 wi) {
  float density = directionDensity(p.effective, wi, p.wo);
#if CLEAR_COAT
  if (p.coat.share > 0.0) density = mix(density, coatDirectionDensity(p.coat, wi, p.wo), coat_draws);
#endif
  return density;
}
