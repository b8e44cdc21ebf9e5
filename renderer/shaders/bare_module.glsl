// A method's module for programs of others: the module, and what they call.
//? module
// A map's footprint where it is looked up at `uv`: the pixel's own derivatives, so that all pixels of a quad have to come
// here.
Footprint footprintAt(vec2 uv) { return Footprint(uv, dFdx(uv), dFdy(uv)); }

// Every map of the material at one uv; set members one by one where they differ.
Footprints footprintsAt(vec2 uv) {
  Footprint f = footprintAt(uv);
  Footprints all;
  all.normal = f;
  all.roughness = f;
  all.base_color = f;
//? if specular_variation
  all.specular = f;
//? end
//? if normal_layers
  all.layer = f;
//? end
//? if material_index
  all.share = f;
//? end
  return all;
}

// f * cos of both terms; times the light's irradiance on a plane that faces it, that light's share.
vec3 reflectedTowards(Effective e, Surface s, vec3 wi, vec3 wo) {
//? if not horizon_open
  if (wi.z <= 0.0) return vec3(0.0);  // the scene's horizon cuts: nothing of a light below the surface's plane
//? end
  Reflected r = shade(e, s, wi, wo);
//? if diffuse
  return r.specular + r.diffuse;
//? else
  return r.specular;
//? end
}
