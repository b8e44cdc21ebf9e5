// Adds one pass of samples to the running mean and variance of each pixel (Chan, Golub and LeVeque 1983): sums of
// squares would lose a small variance beside a large mean in 32 bits.
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) uniform image2D mean_count;       // mean radiance over covered samples, their number
layout(rgba32f, binding = 1) uniform image2D squares;          // sum of squared deviations
layout(rgba32f, binding = 2) uniform image2D half_mean_count;  // mean and number over the even passes alone
layout(binding = 0) uniform sampler2D samples;                 // grid x grid samples a pixel

uniform int grid;
uniform ivec2 pixels;
uniform bool even_pass;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, pixels))) return;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < grid; ++y) {
    for (int x = 0; x < grid; ++x) {
      vec4 s = texelFetch(samples, pixel * grid + ivec2(x, y), 0);
      sum += vec4(s.rgb * s.a, s.a);
    }
  }
  if (sum.a == 0.0) return;
  vec3 mean = sum.rgb / sum.a;
  vec3 deviation = vec3(0.0);
  for (int y = 0; y < grid; ++y) {
    for (int x = 0; x < grid; ++x) {
      vec4 s = texelFetch(samples, pixel * grid + ivec2(x, y), 0);
      deviation += s.a * (s.rgb - mean) * (s.rgb - mean);
    }
  }
  vec4 old = imageLoad(mean_count, pixel);
  float count = old.a + sum.a;
  vec3 step = mean - old.rgb;
  imageStore(mean_count, pixel, vec4(old.rgb + step * (sum.a / count), count));
  vec3 spread = imageLoad(squares, pixel).rgb + deviation + step * step * (old.a * sum.a / count);
  imageStore(squares, pixel, vec4(spread, 0.0));
  if (!even_pass) return;
  vec4 old_half = imageLoad(half_mean_count, pixel);
  float half_count = old_half.a + sum.a;
  imageStore(half_mean_count, pixel, vec4(old_half.rgb + (mean - old_half.rgb) * (sum.a / half_count), half_count));
}
