// The base BRDF summed over the texels of the finest level under a kernel. One sample of many is one texel, as the
// reference has it, and a material without maps that vary is one facet everywhere.
//? if not sampling_frame or not normal_variation and not normal_layers and not roughness_variation
//? include base_surface.glsl
//? else
//? include exact_facets.glsl
//? if kernel_filter
//? include exact_filter.glsl
//? else
//? include exact_pixel.glsl
//? end

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Query q = Query(true, halfVectorIsDefined(wi, wo), halfVector(wi, wo), wi, wo);
  Sum sum = sumOver(e, q);
  Reflected r;
  r.specular = fresnelTerm(s.f0, wi, wo) * sum.specular;
//? if diffuse
  r.diffuse = diffuse(wi * sum.facing, s, wi, wo);  // whose dot product with wi is the mean of the facets' own
//? end
  return r;
}

float ndf(Effective e, vec3 h) { return sumOver(e, Query(false, true, h, h, h)).specular; }
//? end
