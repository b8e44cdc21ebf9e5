// The texels of a bin: where they are, and how a bin finds them.

// Texels [first, end) of `bins_texels`, and their tree in `bins_forest`.
struct TexelList {
  uint first;
  uint end;
  uint root;
};

// Two integers a list, first texel and root; behind the last one where it ends.
TexelList listAt(uint i) {
  return TexelList(wordAt(bins_lists, 2u * i), wordAt(bins_lists, 2u * i + 2u), wordAt(bins_lists, 2u * i + 1u));
}

// The list of a key (bin_key in inverse_map.hpp); -1: its bin is empty.
int listOfKey(uint key) {
  uint slots = uint(bins_hash_slots);
  uint slot = (key * 2654435769u) >> (32 - findMSB(slots));
  for (uint i = 0u; i < slots; ++i) {
    uint found = wordAt(bins_hash, 2u * slot);
    if (found == key) return int(wordAt(bins_hash, 2u * slot + 1u));
    if (found == 0xFFFFFFFFu) return -1;
    slot = (slot + 1u) & (slots - 1u);
  }
  return -1;
}
