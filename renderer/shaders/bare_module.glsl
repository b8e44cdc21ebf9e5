// The module of a method for programs of others, with the functions that they call.
#include "method_module.glsl"
#include "method_contract.glsl"

// The footprint of a map at `uv`. Uses screen derivatives, so all pixels of a quad must call it.
Footprint footprintAt(vec2 uv) { return Footprint(uv, dFdx(uv), dFdy(uv)); }

// The footprints of all maps of the material at one uv; set single members if maps differ.
Footprints footprintsAt(vec2 uv) {
  Footprint f = footprintAt(uv);
  Footprints all;
  all.normal = f;
  all.roughness = f;
  all.base_color = f;
#if SPECULAR_VARIATION
  all.specular = f;
#endif
#if NORMAL_LAYERS
  all.layer = f;
#endif
#if MATERIAL_INDEX
  all.share = f;
#endif
  return all;
}

vec3 bothTerms(Reflected r) {
#if DIFFUSE
  return r.specular + r.diffuse;
#else
  return r.specular;
#endif
}

// f * cos of both terms. Multiply it by the light's irradiance on a plane that faces the light.
vec3 reflectedTowards(Effective e, Surface s, vec3 wi, vec3 wo) {
#if !HORIZON_OPEN
  if (wi.z <= 0.0) return vec3(0.0);  // the scene's horizon cuts: nothing of a light below the surface's plane
#endif
  return bothTerms(shade(e, s, wi, wo));
}
#if SCREEN_DERIVATIVES

// The pixel in world space, set by `lookAround`.
vec3 world_position;
vec3 camera_position;
#include "neighbour_pixels.glsl"

// Fetches neighbouring pixels. Call it before `effective` and in every pixel of a quad.
// `at` and `eye`: world positions of surface and camera. `frame`: columns tangent, bitangent and normal, orthonormal.
// `world_to_camera`: rotates to x right, y up, z towards the viewer.
void lookAround(vec3 at, vec3 eye, mat3 frame, mat3 world_to_camera, inout Footprints f) {
  world_position = at;
  camera_position = eye;
  tangent_to_camera = world_to_camera * frame;
  fetchNeighbourFrames(frame, f);
}

// f * cos of both terms for a light whose half vector changes over the screen: at position source.xyz (w 1) or in that
// direction (w 0).
vec3 reflectedTowards(Effective e, Surface s, vec3 wi, vec3 wo, vec4 source) {
#if !HORIZON_OPEN
  if (wi.z <= 0.0) return vec3(0.0);
#endif
  return bothTerms(shade(e, s, wi, wo, halfSteps(wi, source, wo)));
}
#endif
