// Facets of a patch of small-scale geometry, drawn at random: Iwasaki 2012, equation 1, as a sum over facets with exact
// visibility. For the reference; the textures are those of renderer/bake/patch_facets.cpp.
#include "direction_grid.glsl"

const int facets_per_sample = 32;  // each from another share of the facets, which lie in the order of their normals
const int facets_per_row = 128;
const int visibility_side = 32;    // of the grid of directions
const int bits_per_texel = 96;     // 24 per channel: exact in a float
const int texels_per_facet = (visibility_side * visibility_side + bits_per_texel - 1) / bits_per_texel;

// The draws of one sample.
vec2 drawnFacets() {
#if RANDOM_DRAWS
  return texel_draw;
#else
  return vec2(0.5);
#endif
}

int patchFacet(vec2 draw, int k) {
  ivec2 size = textureSize(base_facets, 0);
  int share = size.x * size.y / facets_per_sample;
  float drawn = fract(draw.x + 0.618034 * float(k));  // even over k, for any draw of the sample
  return k * share + min(int(drawn * float(share)), share - 1);
}

// Whether a facet sees w: that of one of the four cells of directions around w, drawn with bilinear weights.
bool facetSees(int facet, vec3 w, vec2 random) {
  vec2 in_cells = hemisphereToSquare(w) * float(visibility_side) - 0.5 + random;
  ivec2 cell = clamp(ivec2(floor(in_cells)), ivec2(0), ivec2(visibility_side - 1));
  int bit = cell.y * visibility_side + cell.x;
  int texel = (facet % facets_per_row) * texels_per_facet + bit / bits_per_texel;
  float word = texelFetch(base_visibility, ivec2(texel, facet / facets_per_row), 0)[bit % bits_per_texel / 24];
  return ((int(word) >> (bit % 24)) & 1) != 0;
}

// The sum over drawn facets visible from both directions: normal and share of a_v, or nothing.
vec4 drawnNormal(vec2 draw, int k, vec3 wi, vec3 wo, out float paint) {
  int facet = patchFacet(draw, k);
  vec4 normal = texelFetch(base_facets, ivec2(facet % facets_per_row, facet / facets_per_row), 0);
  paint = normal.w;
  vec2 random = fract(draw.yx + float(k) * vec2(0.754878, 0.569840));
  if (dot(normal.xyz, wi) <= 0.0 || dot(normal.xyz, wo) <= 0.0) return vec4(0.0);
  if (!facetSees(facet, wo, random) || !facetSees(facet, wi, 1.0 - random)) return vec4(0.0);
  return vec4(normal.xyz, dot(normal.xyz, wo));
}

// a_v divided by the area of the facets. The table stores it divided by the cosine, which is smooth down to the
// horizon.
float visibleArea(vec3 wo) {
  vec2 size = vec2(float(visibility_side));
  vec2 uv = clamp(hemisphereToSquare(wo) * size, vec2(0.5), size - 0.5) / size;
  return textureLod(base_visible_area, uv, 0.0).r * max(wo.z, 0.0);
}

const float least_visible_area = 1e-6;

// The factor of a paint for the specular reflectance and the base colour.
#if MICROGEOMETRY_COLOUR
vec3 specularFactor(float paint) { return texelFetch(base_paints, ivec2(int(paint), 0), 0).rgb; }
vec3 diffuseFactor(float paint) { return texelFetch(base_paints, ivec2(int(paint), 1), 0).rgb; }
#else
vec3 specularFactor(float paint) { return vec3(1.0); }
vec3 diffuseFactor(float paint) { return vec3(1.0); }
#endif

#if TABULATED_BRDF
const float largest_cell_shift = 0.99999;

// The cell of a MERL table (Matusik et al. 2003) about a normal. Matches TabulatedBrdf::at.
vec3 tabulatedBrdf(vec3 n, vec3 wi, vec3 wo) {
  if (!halfVectorIsDefined(wi, wo)) return vec3(0.0);
  vec3 h = halfVector(wi, wo);
  vec3 up = n - h * dot(n, h);
  vec3 side = wi - h * dot(wi, h);
  float theta_h = atan(length(cross(n, h)), dot(n, h));
  float theta_d = atan(length(side), dot(wi, h));
  float lengths = length(up) * length(side);
  float phi_d = lengths > 1e-12 ? acos(clamp(-dot(up, side) / lengths, -1.0, 1.0)) : 0.0;
  vec3 share = vec3(theta_d / (0.5 * pi), sqrt(max(theta_h, 0.0) / (0.5 * pi)), phi_d / pi);
  return texelFetch(base_table, ivec3(min(share, largest_cell_shift) * vec3(textureSize(base_table, 0))), 0).rgb;
}
#endif

Reflected patchReflectance(vec2 draw, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
#if DIFFUSE
  r.diffuse = vec3(0.0);
#endif
  float area = visibleArea(wo);
  if (area < least_visible_area) return r;
  for (int k = 0; k < facets_per_sample; ++k) {
    float paint;
    vec4 normal = drawnNormal(draw, k, wi, wo, paint);
    if (normal.w == 0.0) continue;
    vec3 factor = specularFactor(paint);
#if TABULATED_BRDF
    if (base_has_table > 0.5) {  // the table includes diffuse light
      r.specular += normal.w * dot(normal.xyz, wi) * factor * tabulatedBrdf(normal.xyz, wi, wo);
      continue;
    }
#endif
    vec3 f0 = s.f0 * factor;
    r.specular += normal.w * facetSpecular(evenFacets(normal.xyz, lobe_cutoff.x), f0, wi, wo);
#if DIFFUSE
    r.diffuse += normal.w * diffuse(normal.xyz, Surface(s.albedo * diffuseFactor(paint), f0), wi, wo);
#endif
  }
  float scale = float(facets_per_sample) * area;
  r.specular /= scale;
#if DIFFUSE
  r.diffuse /= scale;
#endif
  return r;
}

// Materials without a patch have the facets of a texel.
struct Effective {
  Facets facets;
  vec2 draw;
};

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  if (base_has_patch <= 0.5) return facetShade(e.facets, s, wi, wo);
  return patchReflectance(e.draw, s, wi, wo);
}

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }

#if LOBES_LISTED
#include "facet_normal_lobes.glsl"

vec3 meanNormal(Effective e) { return e.facets.normal; }
#endif
