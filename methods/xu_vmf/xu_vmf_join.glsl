// First pass of the frame build: the base BRDF and the normal map joined into one lobe a texel (Xu 2017, section 4). A
// texel is (r, 1) in the layer whose part of the hemisphere its normal lies in, and in the others 0, as they were
// cleared: means of texels are (w r, w): the share of the footprint that a part covers, and its lobes' mean.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0, rgba32f) writeonly uniform image2DArray finest;
//? if normal_variation
layout(binding = 0) uniform sampler2D normals;  // weight in w: 0 where the map has no valid normal
//? end
//? if roughness_variation
layout(binding = 1) uniform sampler2D variances;  // of the base lobe
//? end

//? if partition_azimuth
// Four sectors about the axes, so that grooves along an axis fall whole into opposite ones; each is cut at the middle
// of the disc's radius.
int cellOf(vec3 n) {
  int sector = abs(n.x) >= abs(n.y) ? (n.x >= 0.0 ? 0 : 2) : (n.y > 0.0 ? 1 : 3);
  return 2 * sector + (length(n.xy) >= 0.5 ? 1 : 0);
}
//? else
// Four rings of equal width over the disc, each cut in halves.
int cellOf(vec3 n) { return 2 * min(int(4.0 * length(n.xy)), 3) + (n.x >= 0.0 ? 0 : 1); }
//? end

// The layer of a cell's part.
int layerOf(int cell) {
//? if j_adaptive
  return 1 + cell;  // layer 0 has the whole hemisphere
//? end
//? if j_1
  return 0;
//? end
//? if j_4
  return cell / 2;
//? end
//? if j_8
  return cell;
//? end
}

// Maps of different sizes share their area: the texel under this one.
ivec2 under(ivec2 texel, ivec2 size, ivec2 map_size) { return texel * map_size / size; }

void main() {
  ivec2 size = imageSize(finest).xy;
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, size))) return;
  vec4 normal = vec4(0.0, 0.0, 1.0, 1.0);
//? if normal_variation
  normal = texelFetch(normals, under(texel, size, textureSize(normals, 0)), 0);
//? end
  float lobe = lobe_cutoff.x;
//? if roughness_variation
  lobe = lobeFromVariance(texelFetch(variances, under(texel, size, textureSize(variances, 0)), 0).r);
//? end
  float height = length(normal.xyz);  // decoded bytes are up to 0.6% too long or short
  if (normal.w < 0.5 || height < 1e-3) return;
  vec3 n = normal.xyz / height;
  vec4 value = vec4((1.0 - shortfallOf(kappaOfLobe(lobe))) * n, 1.0);
  imageStore(finest, ivec3(texel, layerOf(cellOf(n))), value);
//? if j_adaptive
  imageStore(finest, ivec3(texel, 0), value);
//? end
}
