// Directions drawn from the environment's texels and from the module's own lobe, weighed by the balance heuristic
// (Veach and Guibas 1995).
layout(std140, binding = 5) uniform EnvironmentBlock {
  vec4 environment_size;  // columns, rows; turn of the map about +y in radians; directions of each kind a sample
};

// From 24 bits: exact in a float, below 1.
float unitInterval(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }

struct DrawnDirection {
  vec3 direction;  // world
  vec3 radiance;
  float density;  // over solid angle, of drawing it from the environment
};

float azimuthOf(float column) { return 2.0 * pi * (column / environment_size.x - 0.5) - environment_size.z; }

// A texel by the alias method (Walker 1977), then a point of it, uniform in solid angle.
DrawnDirection drawFromEnvironment(uvec3 bits, vec2 inside) {
  ivec2 size = ivec2(environment_size.xy);
  uint texel, low;
  umulExtended(bits.x, uint(size.x * size.y), texel, low);
  vec2 alias = texelFetch(environment_alias, ivec2(int(texel) % size.x, int(texel) / size.x), 0).xy;
  if (unitInterval(bits.y) >= alias.x) texel = uint(alias.y);
  ivec2 at = ivec2(int(texel) % size.x, int(texel) / size.x);
  vec4 held = texelFetch(environment_radiance, at, 0);
  float upper = cos(pi * float(at.y) / environment_size.y);
  float lower = cos(pi * float(at.y + 1) / environment_size.y);
  float y = mix(upper, lower, inside.x);
  float sine = sqrt(max(1.0 - y * y, 0.0));
  float azimuth = azimuthOf(float(at.x) + inside.y);
  return DrawnDirection(vec3(sine * sin(azimuth), y, -sine * cos(azimuth)), held.rgb, held.a);
}

// Radiance and density of the texel in a direction of the world.
vec4 environmentTexel(vec3 d) {
  float u = fract(0.5 + (atan(d.x, -d.z) + environment_size.z) / (2.0 * pi));
  float v = acos(clamp(d.y, -1.0, 1.0)) / pi;
  ivec2 texel = min(ivec2(vec2(u, v) * environment_size.xy), ivec2(environment_size.xy) - 1);
  return texelFetch(environment_radiance, texel, 0);
}

vec3 environmentLit(Effective e, Surface s, vec3 wo, mat3 frame) {
  vec3 radiance = vec3(0.0);
  int count = int(environment_size.w);
  for (int i = 0; i < count; ++i) {
    uint draw = uint(4 * i + 1);
    uvec3 inside = drawBits(draw + 1u);
    DrawnDirection light = drawFromEnvironment(drawBits(draw), vec2(unitInterval(inside.x), unitInterval(inside.y)));
    vec3 wi = light.direction * frame;
    if (wi.z > 0.0 && light.density > 0.0 && arrives(light.direction)) {
      radiance += reflectance(e, s, wi, wo) * light.radiance / (light.density + directionDensity(e, wi, wo));
    }
    uvec3 of_lobe = drawBits(draw + 2u);
    wi = drawDirection(e, wo, vec3(unitInterval(of_lobe.x), unitInterval(of_lobe.y), unitInterval(of_lobe.z)));
    float density = wi.z > 0.0 ? directionDensity(e, wi, wo) : 0.0;
    if (density > 0.0 && arrives(frame * wi)) {
      vec4 held = environmentTexel(frame * wi);
      radiance += reflectance(e, s, wi, wo) * held.rgb / (held.a + density);
    }
  }
  return radiance / float(count);
}
