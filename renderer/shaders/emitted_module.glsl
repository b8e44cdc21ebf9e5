// A module that reflects nothing, for the image of what surfaces emit (emitted_light.cpp).
struct Effective {
  float nothing;
};

Effective effective(Footprints f) { return Effective(0.0); }

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  return r;
}

float ndf(Effective e, vec3 h) { return 0.0; }
