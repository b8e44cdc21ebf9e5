// Which lists are walked for a half vector: those of the bins about it that lobes reach, as many as there are rounds
// for. What is left, tails and lobes much wider than the others, is summed over drawn texels (atanasov_bins_footprint).
//? include atanasov_bins_sampling.glsl

// Texels whose lobes are about as wide.
struct WidthClass {
  float across;  // bins along an edge
  float widest;  // slope variance of a list beside the base lobe's
  float from;    // the slope variance from which on texels are of it
};

WidthClass classAt(int i) {
  vec3 value = texelFetch(bins_classes, ivec2(i, 0), 0).xyz;
  return WidthClass(value.x, value.y, value.z);
}

// Bins of one class, those whose centres lie in a cap.
struct Disc {
  int own;         // class
  float across;
  vec3 centre;
  float limit;     // 1 - cos of the cap's angle
  bool whole;      // no lobe reaches h from beyond
};

// The angle beyond which a lobe is below 1e-4 of its peak: where 1 - cos is 4.6 alpha^2 (a ten-thousandth of a Gaussian
// lobe lies beyond). GGX's tails reach everywhere.
float lobeReach(float variance) {
//? if distribution_ggx and roughness_lobe
  return pi;
//? else
  return 2.0 * asin(min(2.1448 * sqrt(variance), 1.0));
//? end
}

// A cap of about `lists` bins or, where the lobes reach no further, of fewer. A bin's mean normal is up to half of its
// diagonal, 1.8 / across, from its centre. By equal areas a cap of angle t has (1 - cos t) across^2 bins.
Disc discAbout(vec3 centre, int own, WidthClass widths, float reach, float lists) {
  float half_sine = sin(0.5 * min(reach + 1.8 / widths.across, pi));
  float needed = 2.0 * half_sine * half_sine;
  float affordable = widths.across * widths.across <= lists ? 2.0 : lists / (widths.across * widths.across);
  return Disc(own, widths.across, centre, min(needed, affordable), needed <= affordable);
}

//? if multi_lobe and roughness_lobe
// The normal whose facet has the lobe about `axis` turned to h. Of all rotations q that take the axis to h,
// q = (1 + axis.h, axis x h) (c + s axis), a facet's is the one without a turn about z (facet_frame.glsl): q_z = 0.
vec3 normalTurning(vec3 axis, vec3 h) {
  float w = 1.0 + dot(axis, h);
  vec3 v = cross(axis, h);
  vec2 turn = vec2(w * axis.z + cross(v, axis).z, -v.z);  // c, s
  if (dot(turn, turn) < 1e-12 || w < 1e-6) return h;
  vec4 q = normalize(vec4(turn.x * v + turn.y * (w * axis + cross(v, axis)), turn.x * w));
  return vec3(2.0 * q.w * q.y, -2.0 * q.w * q.x, 1.0 - 2.0 * dot(q.xy, q.xy));
}

int discCount() { return max(facet_lobe_count, 1); }
float acrossOf(int disc) { return classAt(0).across; }

Disc discOf(int i, float variance, vec3 h, float lists) {
  WidthClass widths = classAt(0);
  if (facet_lobe_count == 0) return discAbout(h, 0, widths, lobeReach(variance + widths.widest), lists);
  float reach = lobeReach(facet_lobes[i].variance + widths.widest);
  return discAbout(normalTurning(facet_lobes[i].axis, h), 0, widths, reach, lists / float(discCount()));
}
//? else
int discCount() { return int(bins_class_count); }
float acrossOf(int disc) { return classAt(disc).across; }

Disc discOf(int i, float variance, vec3 h, float lists) {
  WidthClass widths = classAt(i);
  return discAbout(h, i, widths, lobeReach(variance + widths.widest), lists / float(discCount()));
}
//? end

vec3 centreOf(Disc disc, ivec2 cell) { return squareToHemisphere((vec2(cell) + 0.5) / disc.across); }

bool isIn(Disc disc, ivec2 cell) { return oneMinusDot(centreOf(disc, cell), disc.centre) <= disc.limit; }

// The cells of the square that the bins of a disc may be in.
struct CellBlock {
  ivec2 lower;
  int across;
  int count;
};

// On the disc of radius sqrt(1 - cos t) lengths grow by no more than 1 / (sqrt(2) cos(t / 2)), from there to the square
// by no more than sqrt(1 + (4 / pi)^2) / 2.
CellBlock cellsOf(Disc disc) {
  float angle = 2.0 * asin(sqrt(0.5 * disc.limit));
  float rim = min(acos(clamp(disc.centre.z, -1.0, 1.0)) + angle, 0.5 * pi);
  float cells = disc.across * angle * 0.8096 / (sqrt(2.0) * cos(0.5 * rim));
  vec2 middle = hemisphereToSquare(disc.centre) * disc.across;
  ivec2 lower = ivec2(max(floor(middle - cells), 0.0));
  ivec2 sides = ivec2(min(floor(middle + cells), disc.across - 1.0)) - lower + 1;
  return CellBlock(lower, sides.x, sides.x * sides.y);
}

ivec2 cellIn(CellBlock block, int i) {
  int row = int((float(i) + 0.5) / float(block.across));
  return block.lower + ivec2(i - row * block.across, row);
}
