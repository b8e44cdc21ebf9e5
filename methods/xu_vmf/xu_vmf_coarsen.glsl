// The further passes of the frame build: one level from the next finer one, each layer by itself. A coarse texel is the
// exact mean of the area that it covers, for any size: two texels along an even axis, three with the shares
// ((m - i), m, (1 + i)) / n along an odd one, n = 2m + 1 (Guthe and Heckbert 2005).
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0, rgba32f) writeonly uniform image2DArray coarse;
layout(binding = 0) uniform sampler2DArray map;
uniform int fine_level;

vec3 sharesOf(int i, int n) {
  if (n == 1) return vec3(1.0, 0.0, 0.0);
  if (n % 2 == 0) return vec3(0.5, 0.5, 0.0);
  int m = n / 2;
  return vec3(m - i, m, 1 + i) / float(n);
}

void main() {
  ivec3 place = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(place.xy, imageSize(coarse).xy))) return;
  ivec2 size = textureSize(map, fine_level).xy;
  vec3 across = sharesOf(place.x, size.x);
  vec3 down = sharesOf(place.y, size.y);
  ivec2 taps = min(size, 2 + size % 2);
  vec4 sum = vec4(0.0);
  for (int j = 0; j < taps.y; ++j) {
    for (int i = 0; i < taps.x; ++i) {
      sum += across[i] * down[j] * texelFetch(map, ivec3(2 * place.xy + ivec2(i, j), place.z), fine_level);
    }
  }
  imageStore(coarse, place, sum);
}
