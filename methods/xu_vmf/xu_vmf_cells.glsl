// The parts of the hemisphere of normals: 8 cells, in pairs 4 parts. r has the direction.
#if PARTITION_AZIMUTH
// Four sectors about the axes, so that grooves along an axis fall entirely into opposite sectors. Each is split at half
// of the disc's radius.
int cellOf(vec3 r) {
  int sector = abs(r.x) >= abs(r.y) ? (r.x >= 0.0 ? 0 : 2) : (r.y > 0.0 ? 1 : 3);
  return 2 * sector + (dot(r.xy, r.xy) >= 0.25 * dot(r, r) ? 1 : 0);
}
#elif POLE_UP
// Four bands of 45 degrees of latitude about the y axis, each split into its right and left half.
int cellOf(vec3 r) {
  const float root_half = 0.70710678;
  float sine = r.y * inversesqrt(max(dot(r, r), 1e-30));
  int band = sine < -root_half ? 0 : sine < 0.0 ? 1 : sine < root_half ? 2 : 3;
  return 2 * band + (r.x >= 0.0 ? 0 : 1);
}
#else
// Four rings of equal width over the disc, each split into halves.
int cellOf(vec3 r) { return 2 * min(int(4.0 * sqrt(dot(r.xy, r.xy) / max(dot(r, r), 1e-30))), 3) + (r.x >= 0.0 ? 0 : 1); }
#endif

// The parts that the map stores, one layer each. `adaptive` stores a tree, parents before their parts: the whole
// hemisphere (0), then each of the 4 coarse parts (1, 4, 7, 10) before its two cells. beyondPart is the next part that
// is not inside a part; the parts between the two are inside it.
#if J_ADAPTIVE
const int part_count = 13;
int partOfCell(int cell) { return 2 + cell + cell / 2; }
int beyondPart(int part) { return part == 0 ? part_count : part % 3 == 1 ? part + 3 : part + 1; }
#else
#if J_4
const int part_count = 4;
int partOfCell(int cell) { return cell / 2; }
#else
const int part_count = 8;
int partOfCell(int cell) { return cell; }
#endif
int beyondPart(int part) { return part + 1; }
#endif
