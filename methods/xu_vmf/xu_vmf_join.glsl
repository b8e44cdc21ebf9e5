// First pass of the frame build: the base BRDF and the normal map joined into one lobe a texel (Xu 2017, section 4). A texel
// is (r, 1) in the layers whose part of the hemisphere its normal lies in, and nothing in the others, so that means of
// texels are (w r, w): the share of the footprint that a part covers, and its lobes' mean.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0, rgba32f) writeonly uniform image2DArray finest;
//? if normal_variation
layout(binding = 0) uniform sampler2D normals;  // weight in w: 0 where the map has no valid normal
//? end
//? if roughness_variation
layout(binding = 1) uniform sampler2D variances;  // of the base lobe
//? end

//? if partition_azimuth
// Four sectors about the axes, so that grooves along an axis fall whole into opposite ones; each is cut at the middle of
// the disc's radius.
int cellOf(vec3 n) {
  int sector = abs(n.x) >= abs(n.y) ? (n.x >= 0.0 ? 0 : 2) : (n.y > 0.0 ? 1 : 3);
  return 2 * sector + (length(n.xy) >= 0.5 ? 1 : 0);
}
//? else
// Four rings of equal width over the disc, each cut in halves.
int cellOf(vec3 n) { return 2 * min(int(4.0 * length(n.xy)), 3) + (n.x >= 0.0 ? 0 : 1); }
//? end

bool holds(int layer, int cell) {
//? if j_adaptive
  return layer == 0 || layer == 1 + cell;
//? end
//? if j_1
  return true;
//? end
//? if j_4
  return layer == cell / 2;
//? end
//? if j_8
  return layer == cell;
//? end
}

// Maps of different sizes share their area: the texel under this one.
ivec2 under(ivec2 texel, ivec2 size, ivec2 map_size) { return texel * map_size / size; }

void main() {
  ivec3 size = imageSize(finest);
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, size.xy))) return;
  vec4 normal = vec4(0.0, 0.0, 1.0, 1.0);
//? if normal_variation
  normal = texelFetch(normals, under(texel, size.xy, textureSize(normals, 0)), 0);
//? end
  float lobe = lobe_cutoff.x;
//? if roughness_variation
  lobe = lobeFromVariance(texelFetch(variances, under(texel, size.xy, textureSize(variances, 0)), 0).r);
//? end
  float height = length(normal.xyz);  // decoded bytes are up to 0.6% too long or short
  bool valid = normal.w >= 0.5 && height >= 1e-3;
  vec3 n = valid ? normal.xyz / height : vec3(0.0, 0.0, 1.0);
  vec4 value = vec4((1.0 - shortfallOf(kappaOfLobe(lobe))) * n, 1.0);
  int cell = cellOf(n);
  for (int layer = 0; layer < size.z; ++layer) {
    imageStore(finest, ivec3(texel, layer), valid && holds(layer, cell) ? value : vec4(0.0));
  }
}
