// Blends a frame into the history of the frames before it (docs/explanation/temporal.md). A pixel follows its surface to where that
// was in the frame before.
layout(binding = 0) uniform sampler2D frame;        // radiance and coverage
layout(binding = 1) uniform sampler2D frame_depth;  // 1 at the near plane, 0 at the far one
layout(binding = 2) uniform sampler2D old_history;
layout(binding = 3) uniform sampler2D old_depth;

layout(location = 0) out vec4 history;
layout(location = 1) out float depth;

uniform mat4 to_old_clip;     // from this frame's clip space, without jitter
uniform bool moves;           // whether the camera differs from the frame before
uniform bool starts;          // whether there is no frame before
uniform float share;          // of the new frame
uniform float most_depth_change;  // of the surface that a pixel follows; relative with a perspective
uniform bool perspective;

bool isFinite(vec4 v) { return !any(isnan(v)) && !any(isinf(v)); }

// Whether the history at a texel shows the surface of depth `expected`.
bool showsSurface(ivec2 texel, float expected) {
  float found = texelFetch(old_depth, texel, 0).r;
  float change = abs(found - expected);
  return perspective ? change <= most_depth_change * max(found, expected) : change <= most_depth_change;
}

// The weights of the four texels about a position by the Catmull-Rom spline; `part` is from the second one on.
vec4 splineWeights(float part) {
  vec4 powers = vec4(1.0, part, part * part, part * part * part);
  return 0.5 * vec4(dot(powers, vec4(0.0, -1.0, 2.0, -1.0)), dot(powers, vec4(2.0, 0.0, -5.0, 3.0)),
                    dot(powers, vec4(0.0, 1.0, 4.0, -3.0)), dot(powers, vec4(0.0, 0.0, -1.0, 1.0)));
}

// The history where the surface was; alpha is -1 where no texel shows the surface. Bilinear lookups would blur it more with
// each frame, so the spline takes 4 x 4 texels where all of them show the surface.
vec4 reprojected(ivec2 pixel) {
  if (!moves) return texelFetch(old_history, pixel, 0);
  vec2 size = vec2(textureSize(old_history, 0));
  vec4 clip = to_old_clip * vec4((vec2(pixel) + 0.5) / size * 2.0 - 1.0, depth, 1.0);
  if (clip.w <= 0.0) return vec4(-1.0);
  vec2 at = (clip.xy / clip.w * 0.5 + 0.5) * size - 0.5;
  ivec2 corner = ivec2(floor(at));
  vec2 part = at - vec2(corner);
  vec4 across = splineWeights(part.x);
  vec4 up = splineWeights(part.y);
  vec4 smooth_sum = vec4(0.0);
  vec4 linear_sum = vec4(0.0);
  float linear_weights = 0.0;
  bool whole = true;
  for (int i = 0; i < 16; ++i) {
    ivec2 side = ivec2(i & 3, i >> 2);
    ivec2 texel = corner + side - 1;
    bool shows = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(size))) &&
                 showsSurface(texel, clip.z / clip.w);
    whole = whole && shows;
    if (!shows) continue;
    vec4 old = texelFetch(old_history, texel, 0);
    vec2 linear = max(1.0 - abs(part - vec2(side - 1)), 0.0);
    smooth_sum += across[side.x] * up[side.y] * old;
    linear_sum += linear.x * linear.y * old;
    linear_weights += linear.x * linear.y;
  }
  if (whole) return max(smooth_sum, 0.0);
  return linear_weights > 0.01 ? linear_sum / linear_weights : vec4(-1.0);
}

#if CLAMP_BOX || CLAMP_VARIANCE
// Limits the history to what the pixels around show: to their range, and to one deviation from their mean (Salvi 2016).
vec4 limited(vec4 old, ivec2 pixel) {
  ivec2 last = textureSize(frame, 0) - 1;
  vec4 low = vec4(1e30);
  vec4 high = vec4(-1e30);
  vec4 sum = vec4(0.0);
  vec4 squares = vec4(0.0);
  float count = 0.0;
  for (int i = 0; i < 9; ++i) {
    vec4 near = texelFetch(frame, clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), last), 0);
    if (!isFinite(near)) continue;
    low = min(low, near);
    high = max(high, near);
    sum += near;
    squares += near * near;
    count += 1.0;
  }
  if (count == 0.0) return old;
#if CLAMP_VARIANCE
  vec4 mean = sum / count;
  vec4 deviation = sqrt(max(squares / count - mean * mean, 0.0));
  low = max(low, mean - deviation);
  high = min(high, mean + deviation);
#endif
  return clamp(old, low, high);
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 newest = texelFetch(frame, pixel, 0);
  depth = texelFetch(frame_depth, pixel, 0).r;
  vec4 old = starts ? vec4(-1.0) : reprojected(pixel);
  bool has_old = old.a >= 0.0;
  // A frame's NaN must not stay: the history goes on without it.
  if (!isFinite(newest)) {
    history = has_old ? old : vec4(0.0);
    return;
  }
#if CLAMP_BOX || CLAMP_VARIANCE
  if (has_old) old = limited(old, pixel);
#endif
  history = has_old ? mix(old, newest, share) : newest;
}
