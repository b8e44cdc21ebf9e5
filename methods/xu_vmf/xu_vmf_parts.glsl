// The parts of a footprint, as the map has them, one after the other.

// A part that covers less of the footprint is left out, and no division is by nothing.
const float least_share = 1e-4;

// Floats round |r| by as much; where the lobes spread less than that, nothing is known of how much. Half floats lose
// that much of every spread; 32 bits lose nothing of a larger one.
//? if storage_fp16
float shortfallOfMean(float size, float least) { return max(1.0 - size - 1.0 / 2048.0, least); }
//? else
float shortfallOfMean(float size, float least) {
  const float rounding = 1.8e-7;
  float beyond = 1.0 - size - least;
  return beyond <= rounding ? least : least + beyond - rounding * (rounding / beyond);
}
//? end

// A part of the footprint: (w r, w), and w times the mean of 1 - |r| of its texels, below which 1 - |r| of the mean
// cannot lie, however it was rounded: |mean r| <= mean |r|.
struct Part {
  vec4 r;
  float least;
};

// `guard` is what the map keeps for `least`, where it keeps it; else it is the facets' own for every texel.
Part partOf(vec4 r, float guard, float facet_shortfall) {
//? if roughness_variation
  return Part(r, guard);
//? else
  return Part(r, r.w * facet_shortfall);
//? end
}

//? if surface_coordinates
Footprint mapFootprint(Footprints f) { return f.surface; }
// The map has the camera's axes, but where no atlas could be made for it.
vec3 axisOf(vec3 r) { return xu_vmf_in_camera_space > 0.5 ? r * tangent_to_camera : r; }
//? elif normal_variation
Footprint mapFootprint(Footprints f) { return f.normal; }
vec3 axisOf(vec3 r) { return r; }
//? else
Footprint mapFootprint(Footprints f) { return f.roughness; }
vec3 axisOf(vec3 r) { return r; }
//? end

// The lobe of a part, of which `weight` counts; there is none where it covers next to nothing.
bool hasLobe(Part part, float weight) { return part.r.w >= least_share && weight > 0.0; }

KeptLobe lobeOfPart(FacetsLobe own, Part part, float weight) {
  vec3 r = part.r.xyz / part.r.w;
  float size = length(r);
  float q = shortfallOfMean(size, part.least / part.r.w);
  vec3 mean = size < 1e-6 ? vec3(0.0, 0.0, 1.0) : axisOf(r / size);
  return keptLobe(own, mean, clamp(q, 1.0 / largest_exponent, 1.0), weight * part.r.w, weight);
}

//? if sampling_frame and not j_1
//? include xu_vmf_tree.glsl
//? else
// One part: a sample of the finest level has one texel, or what is blended of texels.
struct Walk {
  Footprint footprint;
  int own;
  float facet_shortfall;
  int next, parts;
};

Walk walkOver(Footprint f, int own, float facet_shortfall) {
  Walk walk;
  walk.footprint = f;
  walk.own = own;
  walk.facet_shortfall = facet_shortfall;
  walk.next = 0;
  walk.parts = 1;
  return walk;
}

Part nextPart(inout Walk walk, out float weight) {
  float guard = 0.0;
//? if storage_fp16 and roughness_variation
  guard = fetch(xu_vmf_whole_guard, 0, walk.footprint).r;
//? end
  weight = 1.0;
  ++walk.next;
  return partOf(fetch(xu_vmf_whole, walk.own, walk.footprint), guard, walk.facet_shortfall);
}
//? end
