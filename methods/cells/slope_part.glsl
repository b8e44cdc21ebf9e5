// A part with moments of slopes: LEAN's lobe with a share.
#include "stretched_slopes.glsl"

struct Part {
  SlopeLobe slopes;
  vec3 axis;
  float share;    // of the footprint; 0: no part
  float lobe;     // parameter of a facet's lobe
  float breadth;  // slope variance per axis about `axis`, a facet's lobe included
#if ANISOTROPIC_LOBE
  mat2 widths;    // squared alphas of both about `axis`
#endif
};

struct Direction {
  vec3 h;
};

Direction directionOf(vec3 h) { return Direction(h); }

Part stretchedPart(float share, vec2 mean, vec3 spread, float lobe, float variance) {
  SlopeLobe slopes = slopeLobe(mean, mat2(spread.x, spread.y, spread.y, spread.z), variance);
#if ANISOTROPIC_LOBE
  return Part(slopes, slopes.axis, share, lobe, slopes.breadth, slopes.widths);
#else
  return Part(slopes, slopes.axis, share, lobe, slopes.breadth);
#endif
}

float partDensity(Part p, Direction at) { return p.share <= 0.0 ? 0.0 : p.share * slopeDensity(p.slopes, at.h); }
