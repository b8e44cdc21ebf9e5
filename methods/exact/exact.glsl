// The base BRDF summed over the texels of the finest level under a kernel. One sample of many is one texel, as the
// reference has it, and a material without maps that vary is one facet everywhere.
//? if not sampling_frame or not normal_variation and not normal_layers and not roughness_variation
//? include base_surface.glsl
//? if environment_summed

vec3 environmentLit(Effective e, Surface s, vec3 wo, mat3 frame);  // environment_stack.glsl

vec3 environmentSum(Effective e, Surface s, vec3 wo, mat3 frame) { return environmentLit(e, s, wo, frame); }
//? end
//? else
//? include exact_facets.glsl
//? if kernel_filter
//? include exact_filter.glsl
//? else
//? include exact_pixel.glsl
//? end

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Sum sum = sumOver(e, reflectanceQuery(wi, wo));
  Reflected r;
  r.specular = fresnelTerm(s.f0, wi, wo) * sum.specular;
//? if diffuse
  r.diffuse = diffuse(wi * sum.facing, s, wi, wo);  // whose dot product with wi is the mean of the facets' own
//? end
  return r;
}

float ndf(Effective e, vec3 h) { return sumOver(e, densityQuery(h)).specular; }
//? if environment_summed

vec3 environmentSum(Effective e, Surface s, vec3 wo, mat3 frame) {
  Query q = reflectanceQuery(wo, wo);
  q.surrounded = true;
  q.surface = s;
  q.frame = frame;
  return sumOver(e, q).radiance;
}
//? end
//? end
