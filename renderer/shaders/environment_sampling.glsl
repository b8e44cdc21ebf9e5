// Environment light for the reference: directions from its texels and from the lobe of the module, weighted by the
// balance heuristic (Veach and Guibas 1995). With `environment_dense`, all directional lights instead (Iwasaki et al.
// 2012). Both agree if no lobe is narrower than the cell of a light.
#if ENVIRONMENT_VISIBILITY
#include "octahedral.glsl"
#include "environment_visibility.glsl"
#endif

// Whether light from a world direction reaches the pixel.
bool arrives(vec3 direction) {
#if ENVIRONMENT_VISIBILITY
  return isVisible(direction);
#else
  return true;
#endif
}

#if ENVIRONMENT_DENSE
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
  // Mesa 22.3's llvmpipe ends loops after 65535 iterations per pixel; a partial sum would be wrong.
  if (i < count) return vec3(uintBitsToFloat(0x7fc00000u));
  return radiance;
}
#else
layout(std140, binding = 5) uniform EnvironmentBlock {
  vec4 environment_size;  // columns, rows; turn of the map about +y in radians
};

struct DrawnDirection {
  vec3 direction;  // world
  vec3 radiance;
  float density;  // over solid angle, of drawing it from the environment
};

float azimuthOf(float column) { return 2.0 * pi * (column / environment_size.x - 0.5) - environment_size.z; }

// Finds the entry that contains u among `count` cumulative sums, from the start of a guide table (Chen and Asau 1974).
// On return, u is its position within the entry, 0 to 1. `at` and `step` address the table.
int drawnEntry(ivec2 at, ivec2 step, int count, inout float u) {
  int entry = int(texelFetch(environment_sums, at + step * min(int(u * float(count)), count - 1), 0).g);
  float below = entry > 0 ? texelFetch(environment_sums, at + step * (entry - 1), 0).r : 0.0;
  float above = texelFetch(environment_sums, at + step * entry, 0).r;
  while (above <= u && entry < count - 1) {
    ++entry;
    below = above;
    above = texelFetch(environment_sums, at + step * entry, 0).r;
  }
  u = clamp((u - below) / max(above - below, 1e-30), 0.0, 1.0);
  return entry;
}

// Draws a row, a texel of it and a point in it, monotonic in both numbers, so that well-distributed points stay so.
DrawnDirection drawFromEnvironment(vec2 u) {
  ivec2 size = ivec2(environment_size.xy);
  int row = drawnEntry(ivec2(size.x, 0), ivec2(0, 1), size.y, u.y);
  int column = drawnEntry(ivec2(0, row), ivec2(1, 0), size.x, u.x);
  vec4 texel = texelFetch(environment_radiance, ivec2(column, row), 0);
  float upper = cos(pi * float(row) / environment_size.y);
  float lower = cos(pi * float(row + 1) / environment_size.y);
  float y = mix(upper, lower, u.y);
  float sine = sqrt(max(1.0 - y * y, 0.0));
  float azimuth = azimuthOf(float(column) + u.x);
  return DrawnDirection(vec3(sine * sin(azimuth), y, -sine * cos(azimuth)), texel.rgb, texel.a);
}

// Radiance and density of the texel in a world direction.
vec4 environmentTexel(vec3 d) {
  float u = fract(0.5 + (atan(d.x, -d.z) + environment_size.z) / (2.0 * pi));
  float v = acos(clamp(d.y, -1.0, 1.0)) / pi;
  ivec2 texel = min(ivec2(vec2(u, v) * environment_size.xy), ivec2(environment_size.xy) - 1);
  return texelFetch(environment_radiance, texel, 0);
}

// All texels of a sample share its directions.
vec3 environmentIntegral(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
  uvec3 seed = hashed(sample_pixel);
  uvec3 lobe_seed = hashed(seed);
  int texels = int(drawn_texels.z);
  int count = max(directions_per_sample / texels, 1);
  int i = sample_texel * count;
  int end = i + count;
  do {
    uvec4 digits = cell_directions[sample_cell] ^ direction_steps[i];
    DrawnDirection light = drawFromEnvironment(scrambledPair(digits.xy, seed.xy));
    vec3 wi = light.direction * p.frame;
    if (reachesFacets(wi) && light.density > 0.0 && arrives(light.direction)) {
      radiance += reflectance(p, wi) * light.radiance / (light.density + lobeDirectionDensity(p, wi));
    }
    float choice = unitInterval(scrambled(cell_choices[sample_cell] ^ choice_steps[i], seed.z));
    wi = lobeDirection(p, vec3(scrambledPair(digits.zw, lobe_seed.xy), choice));
    float density = reachesFacets(wi) ? lobeDirectionDensity(p, wi) : 0.0;
    if (density > 0.0 && arrives(p.frame * wi)) {
      vec4 texel = environmentTexel(p.frame * wi);
      radiance += reflectance(p, wi) * texel.rgb / (texel.a + density);
    }
  } while (++i < end);
  return radiance / float(count);
}
#endif
