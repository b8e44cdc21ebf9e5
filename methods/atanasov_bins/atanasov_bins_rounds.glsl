// llvmpipe ends all loops of a pixel after 65535 rounds, all lights together, and whatever is summed then is cut off. So
// a call of the module has a budget of rounds, which its parts share. Eight pixels are drawn together and wait for each
// other at the end of every loop: a part counts by its largest.

//? if environment_light
const float other_rounds = 25000.0;  // drawn normals and what they reflect
//? else
const float other_rounds = 5000.0;   // lookups under the footprint
//? end

// Of one region in one call. The mean of normals takes up to 256 a region, once a pixel.
float regionRounds(int regions) {
  float count = float(max(regions, 1));
  return (65535.0 - other_rounds - 256.0 * count) / (float(shade_calls) * count);
}

// What its parts take of these at most, measured of eight pixels whose lights, footprints and bins have little in
// common: a list takes some 45 to be found, a drawn texel one, and walks that may take so many each make the eight take
// 2.2 times as many. That is 0.2 for the texels of small footprints, which some of the eight may have, and 0.86 for
// lists, 0.88 of bins. With hundreds of lights rounds are too few for any walk, and all texels are drawn.
float texelRounds(float rounds) { return min(0.2 * rounds, 4096.0); }
//? if roughness_bin
const float walk_share = 0.4;
float mostLists(float rounds) { return 1.0; }
//? else
const float walk_share = 0.28;
float mostLists(float rounds) { return rounds < 600.0 ? 0.0 : min(0.004 * rounds, 128.0); }
float drawnRounds(float rounds) { return rounds < 600.0 ? 0.6 * rounds : min(0.0625 * rounds, 1024.0); }
//? end

// Of the walk of one of `lists`.
float walkRounds(float rounds, float lists) { return walk_share * rounds / max(lists, 1.0); }

// How often a footprint may cover a map along an axis before it counts as the whole map: a walk takes some four rounds
// for every copy of the map that the footprint touches, and no more than two fifths of its rounds are for these.
float mostPeriods(float rounds) {
//? if roughness_bin
  const float most = 16.0;
//? else
  const float most = 4.0;
//? end
  return clamp(sqrt(0.1 * walkRounds(rounds, mostLists(rounds))) - 1.0, 1.0, most);
}
