// A method's module for programs of others: the module, and what they call.
//? module
// A map's footprint where it is looked up at `uv`: the pixel's own derivatives, so that all pixels of a quad have to
// come here.
Footprint footprintAt(vec2 uv) { return Footprint(uv, dFdx(uv), dFdy(uv)); }

// Every map of the material at one uv; set members one by one where they differ.
Footprints footprintsAt(vec2 uv) {
  Footprint f = footprintAt(uv);
  Footprints all;
  all.normal = f;
  all.roughness = f;
  all.base_color = f;
//? if specular_variation
  all.specular = f;
//? end
//? if normal_layers
  all.layer = f;
//? end
//? if material_index
  all.share = f;
//? end
  return all;
}

vec3 bothTerms(Reflected r) {
//? if diffuse
  return r.specular + r.diffuse;
//? else
  return r.specular;
//? end
}

// f * cos of both terms; times the light's irradiance on a plane that faces it, that light's share.
vec3 reflectedTowards(Effective e, Surface s, vec3 wi, vec3 wo) {
//? if not horizon_open
  if (wi.z <= 0.0) return vec3(0.0);  // the scene's horizon cuts: nothing of a light below the surface's plane
//? end
  return bothTerms(shade(e, s, wi, wo));
}
//? if screen_derivatives

// Of the pixel, in world space: set by `lookAround`.
vec3 world_position;
vec3 camera_position;
//? include neighbour_pixels.glsl

// Looks at the next pixels, before `effective` and in every pixel of a quad. `at` and `eye` are the surface's and the
// camera's place in world space; the columns of `frame` are tangent, bitangent and normal there, unit and orthogonal;
// `world_to_camera` turns to x right, y up, z towards the viewer.
void lookAround(vec3 at, vec3 eye, mat3 frame, mat3 world_to_camera, inout Footprints f) {
  world_position = at;
  camera_position = eye;
  tangent_to_camera = world_to_camera * frame;
  fetchNeighbourFrames(frame, f);
}

// The same of a light whose half vector changes over the screen: at source.xyz (w 1), or in that direction (w 0).
vec3 reflectedTowards(Effective e, Surface s, vec3 wi, vec3 wo, vec4 source) {
//? if not horizon_open
  if (wi.z <= 0.0) return vec3(0.0);
//? end
  return bothTerms(shade(e, s, wi, wo, halfSteps(wi, source, wo)));
}
//? end
