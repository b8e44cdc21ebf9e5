// Adds one pass of samples to the running mean and variance of each pixel (Chan, Golub and LeVeque 1983): sums of
// squares would lose a small variance beside a large mean in 32 bits. A fragment shader that reads the old sums and
// writes the new ones: software rasterisers run fragments on every core, and compute shaders far slower.
//
// A sample's alpha is 0 beside the surface, 1 on it, and 2 or more where it fell on an invalid texel: the surface
// covers it, but it has no radiance and enters no mean.
layout(binding = 0) uniform sampler2D samples;              // grid x grid samples a pixel
layout(binding = 1) uniform sampler2D old_mean_count;       // mean radiance over samples that have one, their number
layout(binding = 2) uniform sampler2D old_squares;          // sum of squared deviations, number of covered samples
layout(binding = 3) uniform sampler2D old_half_mean_count;  // mean and number over the even passes alone

layout(location = 0) out vec4 mean_count;
layout(location = 1) out vec4 squares;
layout(location = 2) out vec4 half_mean_count;

uniform int grid;
uniform bool even_pass;

vec4 merged(vec4 old, vec3 mean, float count) {
  float all = old.a + count;
  return vec4(old.rgb + (mean - old.rgb) * (count / all), all);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  mean_count = texelFetch(old_mean_count, pixel, 0);
  squares = texelFetch(old_squares, pixel, 0);
  half_mean_count = texelFetch(old_half_mean_count, pixel, 0);
  // Deviations are taken from one of the samples: that keeps them small where the mean is large and the spread is not.
  vec3 origin = texelFetch(samples, pixel * grid, 0).rgb;
  vec4 sum = vec4(0.0);
  vec3 square_sum = vec3(0.0);
  for (int y = 0; y < grid; ++y) {
    for (int x = 0; x < grid; ++x) {
      vec4 s = texelFetch(samples, pixel * grid + ivec2(x, y), 0);
      float shaded = s.a > 0.5 && s.a < 1.5 ? 1.0 : 0.0;
      squares.a += min(s.a, 1.0);
      vec3 d = (s.rgb - origin) * shaded;
      sum += vec4(d, shaded);
      square_sum += d * d;
    }
  }
  if (sum.a == 0.0) return;
  vec3 offset = sum.rgb / sum.a;
  vec3 mean = origin + offset;
  vec3 step = mean - mean_count.rgb;
  vec3 deviation = max(square_sum - sum.rgb * offset, vec3(0.0));
  squares.rgb += deviation + step * step * (mean_count.a * sum.a / (mean_count.a + sum.a));
  mean_count = merged(mean_count, mean, sum.a);
  if (even_pass) half_mean_count = merged(half_mean_count, mean, sum.a);
}
