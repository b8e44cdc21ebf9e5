// Atanasov et al. 2020: the normals under a pixel are counted by bins of the half vector. The density of normals at h
// is the area of the texels under the footprint whose normals are in h's bin, over the footprint's area and the bin's
// solid angle; or, where texels reflect by a lobe, the mean of the lobes about the normals of the bins around h.
//? include atanasov_bins_words.glsl
//? if roughness_lobe or roughness_bin and surface_microfacets
//? include lobe_variance.glsl
//? end
//? include atanasov_bins_reflectance.glsl
//? if environment_light
//? include atanasov_bins_sampling.glsl
//? end
//? if sampling_frame and normal_variation
//? include atanasov_bins_footprint.glsl
//? else
//? include atanasov_bins_texel.glsl
//? end

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    float value = meanValue(e, queryFor(true, halfVector(wi, wo), wi, wo));
    r.specular = fresnelTerm(s.f0, wi, wo) * value;
  }
//? if diffuse
  // The mean normal's dot product is the mean of the facets' own while all of them face the light.
  r.diffuse = diffuse(meanNormal(e), s, wi, wo);
//? end
  return r;
}

float ndf(Effective e, vec3 h) { return meanValue(e, queryFor(false, h, h, h)); }

//? if environment_light
//? include atanasov_bins_environment.glsl
//? end
