// An entry point for a bare module: what a surface reflects of one small lamp.
layout(location = 0) in vec3 at;     // the surface in world space
layout(location = 1) in vec3 up;     // its normal in world space, of any length
layout(location = 2) in vec4 along;  // its tangent in world space; w is the bitangent's sign
layout(location = 3) in vec2 uv;     // where the maps are looked up
uniform vec3 eye;                    // the camera in world space
uniform vec3 lamp;                   // the lamp in world space
uniform vec3 candela;                // its intensity, linear RGB
uniform vec3 albedo;                 // diffuse albedo
uniform vec3 f0;                     // reflectance at normal incidence
#if SCREEN_DERIVATIVES
uniform mat3 world_to_camera;        // rotates to x right, y up, z towards the viewer
#endif
layout(location = 0) out vec4 seen;  // linear radiance, and 1

void main() {
  vec3 z = normalize(up);
  vec3 x = normalize(along.xyz - z * dot(z, along.xyz));
  mat3 to_world = mat3(x, along.w * cross(z, x), z);
  vec3 towards_lamp = lamp - at;
  vec3 wi = transpose(to_world) * normalize(towards_lamp);
  vec3 wo = transpose(to_world) * normalize(eye - at);
  Surface surface = Surface(albedo, f0);
  Footprints f = footprintsAt(uv);
#if SCREEN_DERIVATIVES
  lookAround(at, eye, to_world, world_to_camera, f);
  vec3 reflected = reflectedTowards(effective(f), surface, wi, wo, vec4(lamp, 1.0));
#else
  vec3 reflected = reflectedTowards(effective(f), surface, wi, wo);
#endif
  seen = vec4(reflected * candela / dot(towards_lamp, towards_lamp), 1.0);
}
