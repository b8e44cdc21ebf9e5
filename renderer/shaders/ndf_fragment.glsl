// The NDF inspector's pass: a method's effective density of normals at listed directions, for one footprint given by
// hand. The method's module takes the place of the line `//# module`.
layout(location = 0) out float density;

uniform sampler2D ndf_directions;  // one a pixel: unit vectors, or zero where nothing is asked
uniform vec2 footprint_uv[3];      // slots normal, roughness, base_color: centre and edges of the footprint
uniform vec2 footprint_dx[3];
uniform vec2 footprint_dy[3];

//# module
Footprint givenFootprint(int slot) { return Footprint(footprint_uv[slot], footprint_dx[slot], footprint_dy[slot]); }

void main() {
  vec3 h = texelFetch(ndf_directions, ivec2(gl_FragCoord.xy), 0).xyz;
  if (h == vec3(0.0)) {
    density = 0.0;
    return;
  }
  density = ndf(effective(Footprints(givenFootprint(0), givenFootprint(1), givenFootprint(2))), h);
}
