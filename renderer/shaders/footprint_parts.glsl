// The parts of a pixel's footprint that are filtered and shaded separately: those that tile it, or texels drawn at random.

// A part: its centre, from the pixel's, and its edges, in pixels; and its footprint on the normal map.
struct FootprintPart {
  vec2 at;
  vec2 dx;
  vec2 dy;
  Footprint normal;
};

Footprint placed(Footprint f, vec2 at, vec2 dx, vec2 dy) {
  return Footprint(f.uv + f.dx * at.x + f.dy * at.y, f.dx * dx.x + f.dy * dx.y, f.dx * dy.x + f.dy * dy.y);
}

#if FILTER_STOCHASTIC
#include "stochastic_part.glsl"
int partCount() { return footprint_parts; }
#else
int partCount() { return footprint_parts * footprint_parts; }

// FootprintPart `i` of n x n.
FootprintPart partOf(Footprint f, int i) {
  float width = 1.0 / float(footprint_parts);
  vec2 at = (vec2(i % footprint_parts, i / footprint_parts) + 0.5) * width - 0.5;
  return FootprintPart(at, vec2(width, 0.0), vec2(0.0, width), placed(f, at, vec2(width, 0.0), vec2(0.0, width)));
}
#endif

Footprint onMap(Footprint f, FootprintPart p) { return placed(f, p.at, p.dx, p.dy); }

Footprints partOf(Footprints f, int i) {
  FootprintPart p = partOf(f.normal, i);
  Footprints part;
  part.normal = p.normal;
#if SHARED_COORDINATES
  part.roughness = part.normal;
  part.base_color = part.normal;
#else
  part.roughness = onMap(f.roughness, p);
  part.base_color = onMap(f.base_color, p);
#endif
#if SPECULAR_VARIATION && SHARED_COORDINATES
  part.specular = part.normal;
#elif SPECULAR_VARIATION
  part.specular = onMap(f.specular, p);
#endif
#if SURFACE_COORDINATES
  part.surface = onMap(f.surface, p);
#endif
#if NORMAL_LAYERS
  part.layer = onMap(f.layer, p);
#endif
#if CLEAR_COAT && COAT_WEIGHT_VARIATION
  part.coat_weight = onMap(f.coat_weight, p);
#endif
#if CLEAR_COAT && COAT_WIDTH_VARIATION
  part.coat_width = onMap(f.coat_width, p);
#endif
#if CLEAR_COAT && COAT_NORMAL_VARIATION
  part.coat_normal = onMap(f.coat_normal, p);
#endif
#if MATERIAL_INDEX
  part.share = onMap(f.share, p);
#endif
#if EMISSION_VARIATION
  part.emission = onMap(f.emission, p);
#endif
#if OCCLUSION
  part.occlusion = onMap(f.occlusion, p);
#endif
#if SCREEN_DERIVATIVES
  part_edges = mat2(p.dx, p.dy);
  part.frame_dx = f.frame_dx * p.dx.x + f.frame_dy * p.dx.y;
  part.frame_dy = f.frame_dx * p.dy.x + f.frame_dy * p.dy.y;
#endif
  return part;
}
