// llvmpipe ends all loops of a pixel after 65535 rounds, all lights together, and whatever is summed then is cut off. So
// a call of the module has a budget of rounds, which its parts share. Eight pixels are drawn together and wait for each
// other at the end of every loop: a part counts by its largest.

//? if environment_light or footprint_filter
const float other_rounds = 25000.0;  // drawn normals; means of normals under the texels of a filter
//? else
const float other_rounds = 5000.0;   // footprints, means of normals
//? end

// Of one region in one call.
float regionRounds(int regions) { return (65535.0 - other_rounds) / float(shade_calls * max(regions, 1)); }

// A quarter is for the texels of small footprints, a sixteenth for those that are drawn, some 3000 or less for finding
// lists. The rest is for walks.
float texelRounds(float rounds) { return min(0.25 * rounds, 4096.0); }
float drawnRounds(float rounds) { return min(0.0625 * rounds, 1024.0); }

//? if roughness_bin
float mostLists(float rounds) { return 1.0; }
//? else
float mostLists(float rounds) { return clamp(0.008 * rounds, 4.0, 128.0); }
//? end

// Of the walk of one of `lists`.
float walkRounds(float rounds, float lists) { return 0.5 * rounds / lists; }

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
