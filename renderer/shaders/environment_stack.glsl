// Environment light for prefiltered footprints: each lobe of the module's NDF takes the environment's mean over the
// lobe that its mirror images make about the viewer (Wang 2009), from a stack of prefiltered maps (Kautz 2000).
layout(std140, binding = 5) uniform EnvironmentBlock {
  vec4 environment_mean;         // radiance over all directions
  vec4 environment_stack_range;  // sharpness of the finest map's lobe, number of maps: two a level; nodes around a ring
//? if environment_suns
  vec4 environment_suns[2 * environment_sun_count];  // each: towards it, world space; irradiance on what faces it
//? end
};

//? include octahedral.glsl

// Map 2 l is level l of layer 0, map 2 l + 1 that of layer 1.
vec3 stackMap(int map, vec2 uv) {
  int level = map >> 1;
  vec2 size = levelSize(textureSize(environment_stack, 0).xy, level);
  countLookups(1);
  return textureLod(environment_stack, vec3(borderedUv(uv, size), map & 1), float(level)).rgb;
}

// The environment's mean over a vMF lobe. Every map's lobe is half as sharp as the one before it. Between two of them
// the mean is taken as linear in the logarithm of the sharpness: in a smooth environment it is so in 1 / sharpness, at
// a lamp in the sharpness itself, and between the two nothing is off by more than 6%. Behind the last map it goes to
// the mean over all directions as the sharpness goes to 0.
vec3 stackRadiance(vec3 axis, float sharpness) {
  vec2 uv = octahedral(axis);
  float finest = environment_stack_range.x;
  int last = int(environment_stack_range.y) - 1;
  float steps = log2(finest / max(sharpness, 1e-6));
  if (steps >= float(last)) return mix(environment_mean.rgb, stackMap(last, uv), exp2(float(last) - steps));
  steps = max(steps, 0.0);
  int map = min(int(steps), last - 1);
  return mix(stackMap(map, uv), stackMap(map + 1, uv), steps - float(map));
}

// The share of a vMF lobe that lies above a plane, t the cosine of axis and plane's normal; to 0.021. A logistic whose
// slope at t = 0 is right for small and for large sharpness k, and whose value at t = 1 is the exact 1 / (1 + e^-k).
float shareAbove(float t, float k) {
  float slope = k * inversesqrt(1.0 + k / 2.546);
  return 1.0 / (1.0 + exp(-clamp(slope * t + (k - slope) * t * t * t, -80.0, 80.0)));
}

// The lobe as the viewer sees its facets: each counts by (h.wo), of those that face away nothing is seen.
struct VisibleLobe {
  vec3 axis;   // mean of the visible normals
  float area;  // mean of max(h.wo, 0)
};

// In the plane that touches the sphere at the axis the lobe is a Gaussian, and (h.wo) is linear across it: moments of a
// Gaussian that is cut off. Far from grazing views the area is (axis.wo) and the axis the lobe's own.
VisibleLobe visibleLobe(NormalLobe lobe, vec3 wo) {
  float c = dot(lobe.axis, wo);
  vec3 across = wo - c * lobe.axis;
  float sine = length(across);
  float deviation = inversesqrt(lobe.sharpness);
  if (sine < 1e-4) return VisibleLobe(lobe.axis, max(c, 0.0));
  float a = max(c / (sine * deviation), -5.0);
  float facing = normalCdf(a);
  float mean = a * facing + inverse_root_two_pi * exp(-0.5 * a * a);
  vec3 shifted = lobe.axis + across * (deviation * facing / (max(mean, 1e-7) * sine));
  return VisibleLobe(normalize(shifted), sine * deviation * max(mean, 0.0));
}

//? if environment_visibility
//? include environment_visibility.glsl
//? else
float visibleElevation(vec3 direction, float elevation) { return elevation; }
//? end

//? if environment_suns
// A sun that is too small for any lookup, and that the maps are without: one more directional light, hidden where the
// environment is.
vec3 sunLit(SurfacePoint p, vec3 direction, vec3 irradiance) {
//? if environment_visibility
  if (!isVisible(direction)) return vec3(0.0);
//? end
  return reflected(p, incident(direction * p.frame, irradiance, vec4(direction, 0.0)));
}

vec3 sunsLit(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
  int i = 0;
  do {
    radiance += sunLit(p, environment_suns[2 * i].xyz, environment_suns[2 * i + 1].rgb);
  } while (++i < environment_sun_count);
  return radiance;
}
//? end

// The normal of the plane below which no light counts for a lobe: the surface's own, or with an open horizon that of the
// lobe's facets.
vec3 horizonNormal(NormalLobe lobe) {
//? if horizon_open
  return lobe.normal;
//? else
  return vec3(0.0, 0.0, 1.0);
//? end
}

// The directions that a lobe reflects to: mean and sharpness.
struct ReflectedLobe {
  vec3 axis;
  float sharpness;
};

// A hemisphere of light from all sides, seen as a vMF lobe: mean cosine 1/2.
const float hemisphere_sharpness = 1.83;

// What of a lobe is above the plane of n, as a lobe of its own, so that no light from below gets in. Across the
// plane that touches the sphere at the axis it is a Gaussian cut off along a line, whose mean moves away from the line
// and whose variance shrinks; a wide lobe becomes a hemisphere.
ReflectedLobe aboveHorizon(ReflectedLobe lobe, vec3 n, float share) {
  float t = dot(n, lobe.axis);
  float a = max(t * sqrt(lobe.sharpness), -5.0);
  float shift = inverse_root_two_pi * exp(-0.5 * a * a) / max(normalCdf(a), 1e-7);
  vec3 across = n - t * lobe.axis;
  float sine2 = dot(across, across);
  vec3 moved = lobe.axis;
  if (sine2 > 1e-8) moved += across * (shift * inversesqrt(lobe.sharpness * sine2));
  float lost = sine2 * min(shift * (a + shift), 0.98);  // of the variance across the line
  float sharpness = lobe.sharpness * 2.0 / (2.0 - lost) + hemisphere_sharpness * min(2.0 - 2.0 * share, 1.0);
  return ReflectedLobe(normalize(moved), sharpness);
}

// What stands beside the density of lobe i in f cos, G' and F apart, or all that a module with small-scale geometry
// knows of it. `sharpness` is that of the lobe of directions to the light about wi.
struct Beside {
  float weight;
  vec3 color;
};

//? if clear_coat
// In place of a lobe's number in the module: the coat's, whose weight, share and spread then stand for f0.
const int coat_lobe = -1;
//? end

Beside besideDensity(Effective e, int i, NormalLobe lobe, vec3 f0, vec3 h, vec3 wi, vec3 wo, float sharpness) {
//? if clear_coat
  if (i == coat_lobe) {
    Coat coat = Coat(lobe.normal, 2.0 / lobe.sharpness, f0.x, f0.y, f0.z);
    return Beside(ggxGeometry(coat.alpha2, coat.normal, wi, wo), vec3(coatShare(coat, h, wo)));
  }
//? end
//? if microgeometry_visibility
  vec3 all = lobeReflectance(e, i, f0, h, wi, wo, sharpness);
  float mean = dot(all, vec3(1.0 / 3.0));
  return Beside(mean, all / max(mean, 1e-12));
//? else
  return Beside(lobeGeometry(e, lobe, h, wi, wo), fresnelTerm(f0, wi, wo));
//? end
}

// What a lobe reflects towards wo: integral of F D G' L over wi. With dwi = 4 (h.wo) dh the lobe's energy is 4 times
// what is visible of it; about the mirror image of the visible normals' mean it is 4 (axis.wo) times wider (Wang 2009).
// F and G' are taken there, and of what lies below the horizon nothing arrives.
vec3 lobeRadiance(Effective e, int i, NormalLobe lobe, vec3 f0, vec3 wo, mat3 frame) {
  VisibleLobe visible = visibleLobe(lobe, wo);
  float cosine = max(dot(visible.axis, wo), 0.01);
  vec3 mirrored = 2.0 * cosine * visible.axis - wo;
  ReflectedLobe whole = ReflectedLobe(mirrored / max(length(mirrored), 1e-6), lobe.sharpness / (4.0 * cosine));
  vec3 n = horizonNormal(lobe);
  float elevation = dot(n, whole.axis);
  ReflectedLobe above = aboveHorizon(whole, n, shareAbove(elevation, whole.sharpness));
  float share = shareAbove(visibleElevation(frame * whole.axis, elevation), whole.sharpness);
  Beside beside = besideDensity(e, i, lobe, f0, visible.axis, whole.axis, wo, whole.sharpness);
  float reflected = 4.0 * lobe.weight * visible.area * share * beside.weight;
  return beside.color * reflected * stackRadiance(frame * above.axis, above.sharpness);
}

//? if distribution_ggx or clear_coat
// GGX has a tail that no Gaussian has, and wide facets of it reflect below the horizon, where masking is strongest: the
// centre of a lobe says little of it. So its visible normals are sampled, as quadrature: once slopes are divided by
// alpha, wo reflected by them fills a spherical cap evenly (Dupuy and Benyoub 2023). Rings of the cap, by the part of
// its area within them: the core, half of the energy, and two rings of the tail.
const vec2 ggx_rings[3] = vec2[](vec2(0.25, 0.5), vec2(0.605662, 0.25), vec2(0.894338, 0.25));  // area within, share
const float ggx_node_sharpness = 4.0;  // of what a node stands for, over the lobe's own
// Variance of what the core's and the tail's nodes stand for, over that of the nodes alone.
const vec2 ggx_spread = vec2(1.76, 1.11);

// x along the part of wo across the axis.
mat3 frameTowards(vec3 axis, vec3 wo) {
  vec3 x = wo - dot(wo, axis) * axis;
  if (dot(x, x) < 1e-8) x = cross(axis, abs(axis.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
  x = normalize(x);
  return mat3(x, cross(axis, x), axis);
}

// The mean of max(h.wo, 0) over GGX's normals, c the cosine of wo and axis (Walter 2007's Smith term).
float ggxVisibleArea(float c, float alpha2) {
  float root = sqrt(c * c + alpha2 * max(1.0 - c * c, 0.0));
  return c >= 0.0 ? 0.5 * (root + c) : 0.5 * alpha2 * (1.0 - c * c) / (root - c);
}

// What nodes reflect: energy, and their directions weighted by it.
struct NodeSum {
  vec3 energy;
  vec3 direction;
  float weight;
};

// Adds one node of lobe i, number `node` of environment_stack_range.z around a ring.
void addNode(inout NodeSum sum, Effective e, int i, NormalLobe lobe, vec2 ring, int node, vec3 f0, vec3 wo, mat3 axes) {
  float alpha = sqrt(2.0 / lobe.sharpness);
  vec3 seen = wo * axes;
  vec3 stretched = normalize(vec3(alpha * seen.xy, seen.z));
  float z = 1.0 - ring.x * (1.0 + stretched.z);
  float around = environment_stack_range.z;
  float azimuth = 2.0 * pi / around * (float(node) + (ring.x == ggx_rings[1].x ? 0.0 : 0.5));
  vec3 cap = vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(azimuth), sin(azimuth)), z) + stretched;
  vec3 h = axes * normalize(vec3(alpha * cap.xy, max(cap.z, 1e-6)));
  vec3 wi = 2.0 * dot(h, wo) * h - wo;
  float sharpness = ggx_node_sharpness * lobe.sharpness;
  Beside beside = besideDensity(e, i, lobe, f0, h, wi, wo, sharpness);
  float reflected = ring.y / around * shareAbove(dot(horizonNormal(lobe), wi), sharpness);
  reflected *= 4.0 * lobe.weight * ggxVisibleArea(seen.z, alpha * alpha) * beside.weight;
  sum.energy += reflected * beside.color;
  sum.direction += reflected * wi;
  sum.weight += reflected;
}

// The environment's mean over the vMF lobe whose mean direction is that of the nodes.
vec3 nodesRadiance(NodeSum sum, float spread, vec3 n, mat3 frame) {
  float size = length(sum.direction);
  if (size < 1e-6) return vec3(0.0);
  float r = min(size / sum.weight, 0.9999);
  float sharpness = max(r * (3.0 - r * r) / (spread * (1.0 - r * r)), hemisphere_sharpness);
  vec3 axis = sum.direction / size;
  float elevation = dot(n, axis);
  float share = shareAbove(visibleElevation(frame * axis, elevation), sharpness) / shareAbove(elevation, sharpness);
  return sum.energy * share * stackRadiance(frame * axis, sharpness);
}

vec3 tailedRadiance(Effective e, int i, NormalLobe lobe, vec3 f0, vec3 wo, mat3 frame) {
  mat3 axes = frameTowards(lobe.axis, wo);
  NodeSum core = NodeSum(vec3(0.0), vec3(0.0), 0.0);
  NodeSum tail = core;
  int around = int(environment_stack_range.z);  // no constant: unrolled, the loop takes compilers seconds
  int k = 0;
  do {
    addNode(core, e, i, lobe, ggx_rings[0], k, f0, wo, axes);
  } while (++k < around);
  k = 0;
  do {
    addNode(tail, e, i, lobe, ggx_rings[1 + k / around], k % around, f0, wo, axes);
  } while (++k < 2 * around);
  vec3 n = horizonNormal(lobe);
  return nodesRadiance(core, ggx_spread.x, n, frame) + nodesRadiance(tail, ggx_spread.y, n, frame);
}
//? end

vec3 environmentSpecular(Effective e, vec3 f0, vec3 wo, mat3 frame) {
  vec3 radiance = vec3(0.0);
  int count = lobeCount(e);
  int i = 0;
  do {
    NormalLobe lobe = normalLobe(e, i);
    if (lobe.weight <= 0.0) continue;
    countLobes(1);
//? if distribution_ggx
    if (lobe.tailed) {
      radiance += tailedRadiance(e, i, lobe, f0, wo, frame);
      continue;
    }
//? end
    radiance += lobeRadiance(e, i, lobe, f0, wo, frame);
  } while (++i < count);
  return radiance;
}

//? if environment_diffuse
//? if fresnel
// The mean over a hemisphere of light, weighted by the cosine, of what Schlick's term lets through: (1 - v.h)^5 has the
// mean 0.0282 (1 - n.v)^2.6 + 0.0001, to 5e-4.
vec3 meanTransmitted(vec3 f0, float cosine) {
//? if fresnel_schlick
  return (1.0 - f0) * (0.9999 - 0.0282 * pow(1.0 - clamp(cosine, 0.0, 1.0), 2.6));
//? else
  return vec3(1.0);
//? end
}
//? end

DiffuseFacets diffuseFacets(Effective e, vec3 wo) {
//? if microgeometry_visibility
  return visibleFacets(e, wo);
//? else
  vec3 m = meanNormal(e);
//? if horizon_open
  return DiffuseFacets(m, vec3(1.0), false);
//? else
  return DiffuseFacets(m, vec3(clamp(0.5 + 0.5 * m.z, 0.0, 1.0)), false);
//? end
//? end
}

// Lambert's term over all directions. Irradiance is close to linear in the normal, so that normals with the mean m get
// the mean over all directions and |m| of the difference to it. Where the horizon cuts, a facet that leans loses what its
// surface hides: of a constant environment (1 - n_z) / 2.
vec3 environmentDiffuse(Effective e, vec3 albedo, vec3 f0, vec3 wo, mat3 frame) {
  DiffuseFacets facets = diffuseFacets(e, wo);
  float size = length(facets.mean_normal);
  vec3 n = size > 1e-6 ? facets.mean_normal / size : vec3(0.0, 0.0, 1.0);
  vec2 irradiance_size = vec2(textureSize(environment_irradiance, 0));
  vec2 uv = borderedUv(octahedral(frame * n), irradiance_size);
  countLookups(1);
  vec3 facing = textureLod(environment_irradiance, uv, 0.0).rgb;  // irradiance over pi
  vec3 reflected = facets.share * mix(environment_mean.rgb, facing, min(size, 1.0));
//? if environment_visibility
  reflected *= visibleDiffuse();
//? end
  if (facets.whole) return reflected;
  reflected *= albedo;
//? if fresnel
  reflected *= meanTransmitted(f0, dot(n, wo));
//? end
  return reflected;
}
//? end

vec3 environmentLit(Effective e, Surface s, vec3 wo, mat3 frame) {
  vec3 radiance = environmentSpecular(e, s.f0, wo, frame);
//? if environment_diffuse
  radiance += environmentDiffuse(e, s.albedo, s.f0, wo, frame);
//? end
  return radiance;
}

//? if clear_coat
// What the coat reflects of the environment, its share included.
vec3 coatLit(SurfacePoint p) {
  if (p.coat.share <= 0.0) return vec3(0.0);
  countLobes(1);
  NormalLobe lobe = NormalLobe(p.coat.normal, 2.0 / p.coat.alpha2, 1.0, 0.0, true, p.coat.normal);
  vec3 shares = vec3(p.coat.weight, p.coat.share, p.coat.spread);
  return tailedRadiance(p.effective, coat_lobe, lobe, shares, p.wo, p.frame);
}
//? end
