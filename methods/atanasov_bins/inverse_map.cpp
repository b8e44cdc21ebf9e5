// Texels sorted by bin, and a tree for each long list, whose halves are partitioned in place and in parallel.
#include "methods/atanasov_bins/inverse_map.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::atanasov_bins {
namespace {

constexpr int most_texels_along = 16384;        // guaranteed by OpenGL 4.5
constexpr std::size_t texels_per_task = 65536;  // fewer are arranged by one thread

// Bins along an edge of a class.
int across_of(const BinMap& map, const TexelClasses& classes, std::size_t own) {
  return classes.across.empty() ? map.across : classes.across[own];
}

// A counting sort of texels by the keys of their bins, those of one key row by row, and the lists of the keys.
void sort_by_bin(const BinMap& map, const TexelClasses& classes, InverseMap& out) {
  const auto last =
      static_cast<std::uint32_t>(std::max<std::size_t>(classes.across.size(), 1) << bin_bits);  // the place of no_key
  std::vector<std::uint32_t> places(map.normals.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    const std::size_t own = classes.of_texel.empty() ? 0 : classes.of_texel[i];
    const std::uint32_t normal = map.normals[i];
    places[i] = normal == no_normal ? last : bin_key(own, bin_of_packed(normal, across_of(map, classes, own)));
  });
  std::vector<std::uint32_t> next(std::size_t{last} + 1);  // counts, then the first texel of each place
  for (const std::uint32_t place : places) ++next[place];
  std::uint32_t first = 0;
  for (std::uint32_t place = 0; place <= last; ++place) {
    if (next[place] == 0) continue;
    out.lists.push_back({.key = place == last ? no_key : place, .first = first, .root = 0});
    first += std::exchange(next[place], first);
  }
  out.texels.resize(places.size());
  const auto width = static_cast<std::size_t>(map.width);
  for (std::size_t i = 0; i < places.size(); ++i)
    out.texels[next[places[i]]++] = static_cast<std::uint32_t>(i / width << 16U | i % width);
}

// Appends space for a node to the forest, and returns its position.
std::size_t add_node(std::vector<std::uint32_t>& forest, std::size_t texels) {
  forest.resize(forest.size() + (texels < wide_node ? 1 : 2));
  return forest.size() - (texels < wide_node ? 1 : 2);
}

// Writes a node after the tree of its lower half and before that of its upper half.
void set_node(std::vector<std::uint32_t>& forest, std::size_t node, std::size_t texels, std::size_t lower_count) {
  const std::size_t own = texels < wide_node ? 1 : 2;
  const auto lower_size = static_cast<std::uint32_t>(forest.size() - node - own);
  forest[node] = static_cast<std::uint32_t>(lower_count);
  if (own == 1) {
    forest[node] |= lower_size << 16U;
  } else {
    forest[node + 1] = lower_size;
  }
}

// Arranges texels and appends their tree.
void plant(std::span<std::uint32_t> texels, const TexelRect& rect, std::vector<std::uint32_t>& forest) {
  if (texels.size() <= leaf_size) return;
  const Halves halves = halves_of(rect);
  const auto middle = static_cast<std::uint32_t>(halves.middle);
  const auto upper = std::partition(texels.begin(), texels.end(), [&](std::uint32_t texel) {
    return (halves.along_x ? texel & 0xFFFFU : texel >> 16U) < middle;
  });
  const auto lower_count = static_cast<std::size_t>(upper - texels.begin());
  TexelRect lower_rect = rect, upper_rect = rect;
  (halves.along_x ? lower_rect.upper.x : lower_rect.upper.y) = halves.middle;
  (halves.along_x ? upper_rect.lower.x : upper_rect.lower.y) = halves.middle;
  const std::size_t node = add_node(forest, texels.size());
  if (texels.size() < texels_per_task) {
    plant(texels.first(lower_count), lower_rect, forest);
    set_node(forest, node, texels.size(), lower_count);
    plant(texels.subspan(lower_count), upper_rect, forest);
    return;
  }
  std::vector<std::uint32_t> upper_tree;
  tbb::parallel_invoke([&] { plant(texels.first(lower_count), lower_rect, forest); },
                       [&] { plant(texels.subspan(lower_count), upper_rect, upper_tree); });
  set_node(forest, node, texels.size(), lower_count);
  forest.insert(forest.end(), upper_tree.begin(), upper_tree.end());
}

// Runs of lists with about texels_per_task texels: the first list of each, and the end.
std::vector<std::size_t> tasks_of(const InverseMap& map) {
  std::vector<std::size_t> begins{0};
  std::size_t texels = 0;
  for (std::size_t i = 0; i < map.lists.size(); ++i) {
    texels += map.count_of(i);
    if (texels < texels_per_task && i + 1 < map.lists.size()) continue;
    begins.push_back(i + 1);
    texels = 0;
  }
  return begins;
}

void plant_forest(InverseMap& out, const Progress& progress) {
  const std::vector<std::size_t> begins = tasks_of(out);
  std::vector<std::vector<std::uint32_t>> trees(begins.size() - 1);
  const TexelRect whole{{0, 0}, {out.width, out.height}};
  constexpr std::size_t batch = 64;  // tasks between two reports
  for (std::size_t start = 0; start < trees.size(); start += batch) {
    progress("arranging texels", static_cast<double>(start) / static_cast<double>(trees.size()));
    tbb::parallel_for(start, std::min(start + batch, trees.size()), [&](std::size_t task) {
      for (std::size_t i = begins[task]; i < begins[task + 1]; ++i) {
        out.lists[i].root = static_cast<std::uint32_t>(trees[task].size());
        plant(std::span(out.texels).subspan(out.lists[i].first, out.count_of(i)), whole, trees[task]);
      }
    });
  }
  for (std::size_t task = 0; task < trees.size(); ++task) {
    const auto shift = static_cast<std::uint32_t>(out.forest.size());
    for (std::size_t i = begins[task]; i < begins[task + 1]; ++i) out.lists[i].root += shift;
    out.forest.insert(out.forest.end(), trees[task].begin(), trees[task].end());
  }
}

// The number of a texel of InverseMap::texels, row by row.
std::size_t number_of(const InverseMap& map, std::uint32_t texel) {
  return static_cast<std::size_t>(texel >> 16U) * static_cast<std::size_t>(map.width) + (texel & 0xFFFFU);
}

// The mean of `value` over the numbers of every list's texels.
template <class Mean, class Value>
std::vector<Mean> means_over_lists(const InverseMap& map, const Value& value) {
  std::vector<Mean> out(map.lists.size());
  tbb::parallel_for(std::size_t{0}, map.lists.size(), [&](std::size_t i) {
    decltype(value(0)) sum{};
    for (const std::uint32_t texel : std::span(map.texels).subspan(map.lists[i].first, map.count_of(i)))
      sum += value(number_of(map, texel));
    out[i] = Mean(sum / static_cast<double>(map.count_of(i)));
  });
  return out;
}

struct Sums {
  glm::dvec2 offset{0.0};
  glm::dvec2 squares{0.0};
};

// Mean and variance of normals in a bin as one integer: 12 bits for each coordinate of the mean, relative to the middle
// of the bin, in bins, and 8 for the deviation, rounded. The variance is the mean over both axes.
std::uint32_t packed_moments(const glm::dvec2& mean, double variance) {
  const auto rounded = [](double value, double most) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 1.0) * most));
  };
  return rounded(mean.x + 0.5, 4095.0) | rounded(mean.y + 0.5, 4095.0) << 12U |
         rounded(2.0 * std::sqrt(std::max(variance, 0.0)), 255.0) << 24U;
}

// Computes the moments of the nodes of one list's tree.
struct MomentsOfNodes {
  const InverseMap& map;
  const BinMap& bins;
  std::uint32_t bin, across;
  std::vector<std::uint32_t>& out;

  Sums add(std::uint32_t at, std::uint32_t first, std::uint32_t end) const {
    if (end - first <= leaf_size) return of_texels(first, end);
    const Branches branches = branches_of(map.forest, at, first, end);
    Sums lower, upper;
    const auto add_lower = [&] { lower = add(branches.lower, first, branches.upper_first); };
    const auto add_upper = [&] { upper = add(branches.upper, branches.upper_first, end); };
    if (end - first > texels_per_task) {
      tbb::parallel_invoke(add_lower, add_upper);
    } else {
      add_lower();
      add_upper();
    }
    const Sums sums{lower.offset + upper.offset, lower.squares + upper.squares};
    const glm::dvec2 mean = sums.offset / static_cast<double>(end - first);
    const glm::dvec2 variance = sums.squares / static_cast<double>(end - first) - mean * mean;
    out[at] = packed_moments(mean, 0.5 * (variance.x + variance.y));
    return sums;
  }

  [[nodiscard]] Sums of_texels(std::uint32_t first, std::uint32_t end) const {
    const glm::dvec2 middle = glm::dvec2(bin % across, bin / across) + 0.5;
    Sums sums;
    for (std::uint32_t i = first; i < end; ++i) {
      const std::uint32_t packed = bins.normals[number_of(map, map.texels[i])];
      const glm::dvec2 offset = place_in_square(packed) * double(across) - middle;
      sums.offset += offset;
      sums.squares += offset * offset;
    }
    return sums;
  }
};

constexpr std::uint32_t places = 65536;  // along an axis

// Places [first, last] are those p for which floor(p m / places) is the bin. x = 1, or beyond, is in the last bin.
std::uint32_t place_along(double x, int m) {
  const auto bin = static_cast<std::uint32_t>(std::clamp(static_cast<int>(std::floor(x * m)), 0, m - 1));
  const auto count = static_cast<std::uint32_t>(m);
  const std::uint32_t first = (bin * places + count - 1) / count;
  const std::uint32_t last = ((bin + 1) * places + count - 1) / count - 1;
  const auto place = static_cast<std::uint32_t>(std::clamp(std::floor(x * places), 0.0, places - 1.0));
  return std::clamp(place, first, std::min(last, places - 2));  // places - 1 is for no_normal
}

}  // namespace

double bin_solid_angle(int m) { return 2.0 * std::numbers::pi / (static_cast<double>(m) * m); }

std::uint32_t packed_normal(const glm::dvec3& normal, int m) {
  const glm::dvec2 point = hemisphere_to_square(normal);
  return place_along(point.y, m) << 16U | place_along(point.x, m);
}

std::uint32_t bin_of_packed(std::uint32_t packed, int m) {
  const auto count = static_cast<std::uint32_t>(m);
  return ((packed >> 16U) * count >> 16U) * count + ((packed & 0xFFFFU) * count >> 16U);
}

glm::dvec2 place_in_square(std::uint32_t packed) {
  return (glm::dvec2(packed & 0xFFFFU, packed >> 16U) + 0.5) / double{places};
}

int bins_across_for(double variance, double share, int most) {
  const double width = share * std::sqrt(std::max(variance, 1e-12));
  const double across = std::sqrt(2.0 * std::numbers::pi) / width;
  const int odd = across >= most ? most : 2 * static_cast<int>(std::ceil(0.5 * (across - 1.0))) + 1;
  return std::clamp(odd, std::min(5, most), most);
}

Halves halves_of(const TexelRect& rect) {
  const glm::ivec2 sides = rect.upper - rect.lower;
  if (sides.x >= sides.y) return {.along_x = true, .middle = rect.lower.x + sides.x / 2};
  return {.along_x = false, .middle = rect.lower.y + sides.y / 2};
}

Branches branches_of(std::span<const std::uint32_t> forest, std::uint32_t at, std::uint32_t first, std::uint32_t end) {
  if (end - first < wide_node) {
    return {.lower = at + 1, .upper = at + 1 + (forest[at] >> 16U), .upper_first = first + (forest[at] & 0xFFFFU)};
  }
  return {.lower = at + 2, .upper = at + 2 + forest[at + 1], .upper_first = first + forest[at]};
}

BinMap bin_map(const Image& normals, int across, const Progress& progress) {
  if (std::max(normals.width, normals.height) > most_texels_along) {
    throw Error(ErrorKind::usage, fmt::format("a normal map of {} x {} texels", normals.width, normals.height),
                "atanasov_bins keeps a texel's place in two numbers of 16384 values",
                fmt::format("scale it down to {} texels along an edge", most_texels_along));
  }
  progress("binning normals", 0.0);
  BinMap out{.width = normals.width, .height = normals.height, .across = across, .normals = {}};
  out.normals.resize(normals.texel_count());
  tbb::parallel_for(std::size_t{0}, out.normals.size(), [&](std::size_t i) {
    const float* const texel = &normals.texels[4 * i];
    const glm::dvec3 normal(texel[0], texel[1], texel[2]);
    const bool valid = texel[3] >= 0.5F && glm::dot(normal, normal) > 0.0;
    out.normals[i] = valid ? packed_normal(glm::normalize(normal), across) : no_normal;
  });
  return out;
}

InverseMap invert_map(const BinMap& map, const Progress& progress, const TexelClasses& classes) {
  InverseMap out{.width = map.width, .height = map.height, .texels = {}, .lists = {}, .forest = {}};
  progress("sorting texels", 0.0);
  sort_by_bin(map, classes, out);
  plant_forest(out, progress);
  return out;
}

std::uint32_t hash_slot(std::uint32_t key, std::uint32_t slots) {
  return (key * 2654435769U) >> (32 - std::bit_width(slots - 1));  // Fibonacci hashing: Knuth, volume 3, section 6.4
}

std::vector<std::uint32_t> hashed_lists(const InverseMap& map) {
  const std::uint32_t slots = std::bit_ceil(std::max(2 * static_cast<std::uint32_t>(map.lists.size()), 2U));
  std::vector<std::uint32_t> table(2 * static_cast<std::size_t>(slots), no_key);
  for (std::size_t i = 0; i < map.lists.size(); ++i) {
    if (map.lists[i].key == no_key) continue;
    std::size_t slot = hash_slot(map.lists[i].key, slots);
    while (table[2 * slot] != no_key) slot = (slot + 1) % slots;
    table[2 * slot] = map.lists[i].key;
    table[2 * slot + 1] = static_cast<std::uint32_t>(i);
  }
  return table;
}

std::vector<std::uint32_t> node_moments(const InverseMap& map, const BinMap& bins, const TexelClasses& classes) {
  std::vector<std::uint32_t> out(map.forest.size());
  tbb::parallel_for(std::size_t{0}, map.lists.size(), [&](std::size_t i) {
    const TexelList& list = map.lists[i];
    if (list.key == no_key) return;
    const int across = across_of(bins, classes, list.key >> bin_bits);
    const std::uint32_t bin = list.key & ((1U << bin_bits) - 1U);
    MomentsOfNodes{map, bins, bin, static_cast<std::uint32_t>(across), out}.add(list.root, list.first,
                                                                                list.first + map.count_of(i));
  });
  return out;
}

std::vector<glm::vec2> list_roundings(const InverseMap& map, const BinMap& bins, const Image& normals) {
  return means_over_lists<glm::vec2>(map, [&](std::size_t i) {
    if (bins.normals[i] == no_normal) return glm::dvec2(0.0);
    const float* const n = &normals.texels[4 * i];
    return hemisphere_to_square(glm::normalize(glm::dvec3(n[0], n[1], n[2]))) - place_in_square(bins.normals[i]);
  });
}

std::vector<float> list_means(const InverseMap& map, const Image& values) {
  return means_over_lists<float>(map, [&](std::size_t i) { return static_cast<double>(values.texels[i]); });
}

}  // namespace footprint::atanasov_bins
