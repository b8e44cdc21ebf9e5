// Adds one pass of samples to the running mean of each pixel, in a fragment shader, because software rasterisers run
// compute shaders much slower. The alpha of a sample is 0 beside the surface and 1 on it. It is 1 + x if a share x of
// it had invalid texels: that share has no radiance and enters no mean.
layout(binding = 0) uniform sampler2D samples;         // grid x grid samples per pixel
layout(binding = 1) uniform sampler2D old_mean_count;  // mean radiance over samples that have one, their number
layout(binding = 2) uniform sampler2D old_covered;     // number of covered samples

layout(location = 0) out vec4 mean_count;
layout(location = 1) out float covered;

uniform int grid;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  mean_count = texelFetch(old_mean_count, pixel, 0);
  covered = texelFetch(old_covered, pixel, 0).r;
  // Uses differences to the current mean, which stay small if the mean is large and the spread is small.
  vec4 sum = vec4(0.0);
  for (int y = 0; y < grid; ++y) {
    for (int x = 0; x < grid; ++x) {
      vec4 s = texelFetch(samples, pixel * grid + ivec2(x, y), 0);
      float shaded = s.a > 0.5 ? clamp(2.0 - s.a, 0.0, 1.0) : 0.0;
      covered += min(s.a, 1.0);
      sum += vec4((s.rgb - mean_count.rgb) * shaded, shaded);
    }
  }
  if (sum.a == 0.0) return;
  mean_count.a += sum.a;
  mean_count.rgb += sum.rgb / mean_count.a;
}
