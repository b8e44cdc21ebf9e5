// The density of a bin over a large footprint: its list's share of the area. The texels without a normal are a list too,
// which takes from that.
float listCount(Effective e, Query q, float rounds) { return 1.0; }

Sum sumOfLists(Effective e, Region r, Query q, float rounds) {
  bool finished = true;
  Sum sum = sumBeyond(e, r, q, rounds, finished);
  sum.area += areaOnMap(r);
  float walk = walkRounds(rounds, bins_invalid_list < 0.0 ? 1.0 : 2.0);
  int i = bins_invalid_list < 0.0 ? 1 : 0;
  do {
    int list = i == 0 ? int(bins_invalid_list) : listOfKey(q.bin);
    ++i;
    if (list < 0) continue;
    ListSum part = sumOfList(r, listAt(uint(list)), ListBin(vec2(0.0), 1.0), walk, finished);
    if (i == 1) sum.area -= part.area;
    else sum.value += part.area / binSolidAngle();
  } while (i < 2);
  if (sum.area < 1e-4 * areaOf(r)) sum = Sum(0.0, 0.0);
  return finished && i == 2 ? sum : notWhole();
}
