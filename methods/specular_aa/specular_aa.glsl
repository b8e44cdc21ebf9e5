// Engines' screen-space filters of normals; tests/methods/screen_presets.hpp has the same formulas in double precision.
// Without neighbouring pixels (a sample of a supersampled image, the NDF inspector) the lobe is not widened.
//? include mean_normal.glsl
//? include mean_roughness.glsl
//? if not bake_none
//? include baked_roughness.glsl
//? end

//? if preset_tokuyoshi_kaplanyan_2019 or preset_tokuyoshi_kaplanyan_2021
//? include half_vector_kernel.glsl
//? else
//? include normal_kernel.glsl
//? end

// The lobe before: the mean roughness, as it is or with what was baked into it.
float alpha2Before(Footprints f) {
//? if bake_none
  return 2.0 * lobeVariance(baseLobe(f));
//? else
  return bakedAlpha2(f);
//? end
}

//? if screen_derivatives
// Shading normals of this pixel and of the next ones, which a texture tells without their being drawn.
struct ScreenNormals {
  vec3 here;
  vec3 right;  // in the frame of the pixel on the right
  vec3 above;
};

Footprints shifted(Footprints f, vec2 steps) {
  f.normal.uv += steps.x * f.normal.dx + steps.y * f.normal.dy;
//? if normal_layers
  f.layer.uv += steps.x * f.layer.dx + steps.y * f.layer.dy;
//? end
  return f;
}

ScreenNormals screenNormals(Footprints f) {
  vec3 n = meanNormal(f).xyz;
//? if normal_shading or (normal_own and (preset_o3de or preset_godot or preset_bevy or preset_babylon))
  return ScreenNormals(n, meanNormal(shifted(f, vec2(1.0, 0.0))).xyz, meanNormal(shifted(f, vec2(0.0, 1.0))).xyz);
//? else
  return ScreenNormals(n, n, n);  // turned with the frame alone
//? end
}
//? end

//? if (preset_tokuyoshi_kaplanyan_2019 or preset_tokuyoshi_kaplanyan_2021) and screen_derivatives and not multi_lobe
struct Effective {
  Facets facets;          // a round lobe as wide, for a geometry term and for environment light
  float alpha2;           // before
  ScreenNormals normals;
  mat2 matrix;            // alpha'^2 of a half vector along the normal
};

Effective effective(Footprints f) {
  Effective e;
  e.alpha2 = alpha2Before(f);
  e.normals = screenNormals(f);
  e.matrix = matrixAboutNormal(e.alpha2, e.normals.here, e.normals.right, e.normals.above, f);
  float spread = 0.25 * (e.matrix[0][0] + e.matrix[1][1]) - 0.5 * e.alpha2;
  e.facets = spreadFacets(e.normals.here, 0.5 * e.alpha2, max(spread, 0.0));
  return e;
}

float ndf(Effective e, vec3 h) { return matrixDensity(e.matrix, inFacetFrame(h, e.facets.normal)); }

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo, HalfSteps steps) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    vec3 h = halfVector(wi, wo);
    vec3 own = inFacetFrame(h, e.normals.here);
    mat2 alpha2 = widenedMatrix(e.alpha2, own, inFacetFrame(h + steps.dx, e.normals.right),
                                inFacetFrame(h + steps.dy, e.normals.above));
    float lobe = lobeFromVariance(0.25 * (alpha2[0][0] + alpha2[1][1]));
    r.specular = fresnelTerm(s.f0, wi, wo) *
                 (matrixDensity(alpha2, own) * geometryFactor(lobe, e.facets.normal, h, wi, wo));
  }
//? if diffuse
  r.diffuse = diffuse(e.facets.normal, s, wi, wo);
//? end
  return r;
}

// Of light that has no place: an environment's directions.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) { return facetShade(e.facets, s, wi, wo); }
//? else
struct Effective {
  Facets facets;
//? if preset_babylon
  Facets environment_facets;
//? end
};

Effective effective(Footprints f) {
  float alpha2 = alpha2Before(f);
  vec3 n = meanNormal(f).xyz;
//? if not screen_derivatives
  Facets before = spreadFacets(n, 0.5 * alpha2, 0.0);
//? if preset_babylon
  return Effective(before, before);
//? else
  return Effective(before);
//? end
//? elif preset_tokuyoshi_kaplanyan_2019 or preset_tokuyoshi_kaplanyan_2021
  ScreenNormals normals = screenNormals(f);
  mat2 matrix = matrixAboutNormal(alpha2, n, normals.right, normals.above, f);
  float spread = 0.25 * (matrix[0][0] + matrix[1][1]) - 0.5 * alpha2;
  return Effective(spreadFacets(n, 0.5 * alpha2, max(spread, 0.0)));
//? else
  ScreenNormals normals = screenNormals(f);
  vec3 dx = normals.right - n + f.frame_dx * normals.right;
  vec3 dy = normals.above - n + f.frame_dy * normals.above;
//? if preset_three
  dx = tangent_to_camera * dx;
  dy = tangent_to_camera * dy;
//? end
  Facets after = spreadFacets(n, 0.5 * alpha2, 0.5 * (screenWidened(alpha2, dx, dy) - alpha2));
//? if preset_babylon
  float wide = 0.5 * (screenWidenedForEnvironment(alpha2, dx, dy) - alpha2);
  return Effective(after, spreadFacets(n, 0.5 * alpha2, wide));
//? else
  return Effective(after);
//? end
//? end
}

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) { return facetShade(e.facets, s, wi, wo); }
//? if screen_derivatives
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo, HalfSteps steps) { return shade(e, s, wi, wo); }
//? end
//? end

//? if environment_light
int lobeCount(Effective e) { return facetLobeCount(); }

//? if preset_babylon
NormalLobe normalLobe(Effective e, int i) { return facetNormalLobe(e.environment_facets, i, 1.0); }
//? else
NormalLobe normalLobe(Effective e, int i) { return facetNormalLobe(e.facets, i, 1.0); }
//? end

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.normal, h, wi, wo);
}

vec3 meanNormal(Effective e) { return e.facets.normal; }
//? end
