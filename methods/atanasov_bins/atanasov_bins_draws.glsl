// What is drawn from under a footprint (section 2.1): texels at points that fill it evenly or, of a region that has no
// more texels than are drawn, these, by their areas.

// All regions share the draws.
int drawsEach(Footprint f) { return max(int(option_draws) / regionCount(f), 1); }

DrawnTexel drawnUnder(Effective e, int i) {
  int each = drawsEach(e.footprint);
  int own = i % each;
  Region r = regionAt(e.footprint, i / each);
  TexelBox box = texelsAbout(r);
  ivec2 texel = texelAt(r, evenPoint(i).xy);
  float share = 1.0 / float(each);
  if (box.count <= each) {
    texel = texelIn(box, own);
    share = own < box.count ? areaOfTexel(r, texel) / areaOf(r) : 0.0;
  }
  uint code = packedAt(texel);
  return DrawnTexel(code, varianceAt(e, texel), code == no_normal ? 0.0 : r.weight * share);
}

int drawCount(Effective e) { return regionCount(e.footprint) * drawsEach(e.footprint); }

// Of all draws those that have a normal.
float drawnShare(Effective e) {
  if (bins_invalid_list < 0.0) return 1.0;
  float share = 0.0;
  int count = drawCount(e);
  for (int i = 0; i < count; ++i) share += drawnUnder(e, i).share;
  return share;
}

// Where none has, the surface's own.
DrawnTexel drawnTexel(Effective e, int i) {
  if (e.drawn <= 0.0) return DrawnTexel(up_code, e.variance, 1.0 / float(drawCount(e)));
  DrawnTexel texel = drawnUnder(e, i);
  texel.share /= e.drawn;
  return texel;
}
