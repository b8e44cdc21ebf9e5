// The pass of the NDF inspector: the effective NDF of a method at listed directions, for one given footprint.
layout(location = 0) out float density;

uniform sampler2D ndf_directions;  // one per pixel: unit vectors, or zero where nothing is evaluated
uniform vec2 footprint_uv[3];      // slots normal, roughness, base_color: centre and edges of the footprint
uniform vec2 footprint_dx[3];
uniform vec2 footprint_dy[3];

#include "method_module.glsl"
#include "method_contract.glsl"

#if FILTER_PARTS
#include "footprint_parts.glsl"
#endif
Footprint givenFootprint(int slot) { return Footprint(footprint_uv[slot], footprint_dx[slot], footprint_dy[slot]); }

#if ANISOTROPIC_LOBE && ANISOTROPY_VARIATION
#include "stretch_under.glsl"
#endif
float densityOf(Footprints f, vec3 h) {
#if ANISOTROPIC_LOBE && ANISOTROPY_VARIATION
  stretch = stretchUnder(f);
#endif
  return ndf(effective(f), h);
}

void main() {
  vec3 h = texelFetch(ndf_directions, ivec2(gl_FragCoord.xy), 0).xyz;
  if (h == vec3(0.0)) {
    density = 0.0;
    return;
  }
  Footprints all;
  all.normal = givenFootprint(0);
  all.roughness = givenFootprint(1);
  all.base_color = givenFootprint(2);
#if SURFACE_COORDINATES
  all.surface = all.normal;
  tangent_to_camera = mat3(1.0);  // the camera looks at the plane from above
#endif
#if FILTER_SHADED
  density = 0.0;
  int parts = partCount();
  for (int i = 0; i < parts; ++i) density += densityOf(partOf(all, i), h);
  density /= float(parts);
#else
  density = densityOf(all, h);
#endif
}
