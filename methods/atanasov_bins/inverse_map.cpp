// A counting sort by bin, followed by a tree for each long list. Texels are partitioned in place, and halves of long
// lists in parallel.
#include "methods/atanasov_bins/inverse_map.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "renderer/core/error.hpp"
#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::atanasov_bins {
namespace {

constexpr int most_texels_along = 16384;        // guaranteed by OpenGL 4.5
constexpr std::size_t parts = 8;                // of the counting sort, each with its own counts
constexpr std::size_t texels_per_task = 65536;  // fewer are arranged by one thread

// The first of part `i` of `count` elements.
std::size_t part_begin(std::size_t elements, std::size_t i) { return elements * i / parts; }

// The place where a texel's bin is counted: the bins of all classes, class by class, then texels without a normal.
class KeyOrder {
 public:
  KeyOrder(const BinMap& map, const TexelClasses& classes) : map_(&map), classes_(&classes), across_(classes.across) {
    if (across_.empty()) across_.push_back(map.across);
    for (const int m : across_)
      begins_.push_back(begins_.back() + static_cast<std::size_t>(m) * static_cast<std::size_t>(m));
  }
  [[nodiscard]] std::size_t count() const { return begins_.back() + 1; }
  [[nodiscard]] std::size_t of_texel(std::size_t i) const {
    const std::uint32_t normal = map_->normals[i];
    if (normal == no_normal) return begins_.back();
    const std::size_t own = classes_->of_texel.empty() ? 0 : classes_->of_texel[i];
    return begins_[own] + bin_of_packed(normal, across_[own]);
  }
  [[nodiscard]] std::uint32_t key(std::size_t place) const {
    if (place == begins_.back()) return no_key;
    const auto own = static_cast<std::size_t>(std::ranges::upper_bound(begins_, place) - begins_.begin()) - 1;
    return bin_key(own, static_cast<std::uint32_t>(place - begins_[own]));
  }

 private:
  const BinMap* map_;
  const TexelClasses* classes_;
  std::vector<int> across_;
  std::vector<std::size_t> begins_{0};  // of each class, and the end
};

// Replaces the counts of each part and place by the begin of the part's texels of the bin, and appends the lists to
// `lists`.
void add_up(std::vector<std::vector<std::uint32_t>>& counts, const KeyOrder& order, std::vector<TexelList>& lists) {
  std::uint32_t next = 0;
  for (std::size_t place = 0; place < counts.front().size(); ++place) {
    const std::uint32_t first = next;
    for (std::vector<std::uint32_t>& part : counts) {
      const std::uint32_t count = part[place];
      part[place] = next;
      next += count;
    }
    if (next > first) lists.push_back({.key = order.key(place), .first = first, .root = 0});
  }
}

// Sorts texels by place, those of one place row by row.
void sort_by_bin(const BinMap& map, const KeyOrder& order, InverseMap& out) {
  const auto width = static_cast<std::size_t>(map.width);
  std::vector<std::vector<std::uint32_t>> counts(parts);
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t p) {
    counts[p].assign(order.count(), 0);
    for (std::size_t i = part_begin(map.normals.size(), p); i < part_begin(map.normals.size(), p + 1); ++i)
      ++counts[p][order.of_texel(i)];
  });
  add_up(counts, order, out.lists);
  out.texels.resize(map.normals.size());
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t p) {
    for (std::size_t i = part_begin(map.normals.size(), p); i < part_begin(map.normals.size(), p + 1); ++i)
      out.texels[counts[p][order.of_texel(i)]++] = static_cast<std::uint32_t>(i / width << 16U | i % width);
  });
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

// The mean of `value` over the texels of every list.
template <class Mean, class Value>
std::vector<Mean> means_over_lists(const InverseMap& map, const Value& value) {
  std::vector<Mean> out(map.lists.size());
  tbb::parallel_for(std::size_t{0}, map.lists.size(), [&](std::size_t i) {
    decltype(value(0, 0)) sum{};
    for (const std::uint32_t texel : std::span(map.texels).subspan(map.lists[i].first, map.count_of(i)))
      sum += value(static_cast<int>(texel & 0xFFFFU), static_cast<int>(texel >> 16U));
    out[i] = Mean(sum / static_cast<double>(map.count_of(i)));
  });
  return out;
}

struct Sums {
  glm::dvec2 offset{0.0};
  glm::dvec2 squares{0.0};
};

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
    out[at] = packed_moments({mean, 0.5 * (variance.x + variance.y)});
    return sums;
  }

  [[nodiscard]] Sums of_texels(std::uint32_t first, std::uint32_t end) const {
    const glm::dvec2 middle = glm::dvec2(bin % across, bin / across) + 0.5;
    Sums sums;
    for (std::uint32_t i = first; i < end; ++i) {
      const std::uint32_t place = map.texels[i];
      const std::size_t texel = static_cast<std::size_t>(place >> 16U) * static_cast<std::size_t>(map.width);
      const glm::dvec2 offset = place_in_square(bins.normals[texel + (place & 0xFFFFU)]) * double(across) - middle;
      sums.offset += offset;
      sums.squares += offset * offset;
    }
    return sums;
  }
};

}  // namespace

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
  tbb::parallel_for(tbb::blocked_range<int>(0, normals.height, 16), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::uint32_t* const row = out.normals.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width);
      for (int x = 0; x < out.width; ++x) {
        const std::span<const float> texel = normals.at(x, y);
        const glm::dvec3 normal(texel[0], texel[1], texel[2]);
        const bool valid = texel[3] >= 0.5F && glm::dot(normal, normal) > 0.0;
        row[x] = valid ? packed_normal(glm::normalize(normal), across) : no_normal;
      }
    }
  });
  return out;
}

InverseMap inverse_of(const BinMap& map, const Progress& progress, const TexelClasses& classes) {
  InverseMap out{.width = map.width, .height = map.height, .texels = {}, .lists = {}, .forest = {}};
  progress("sorting texels", 0.0);
  sort_by_bin(map, KeyOrder(map, classes), out);
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

std::uint32_t packed_moments(const BinMoments& moments) {
  const auto rounded = [](double value, double most) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 1.0) * most));
  };
  const double deviation = std::sqrt(std::max(moments.variance, 0.0));
  return rounded(moments.mean.x + 0.5, 4095.0) | rounded(moments.mean.y + 0.5, 4095.0) << 12U |
         rounded(2.0 * deviation, 255.0) << 24U;
}

std::vector<std::uint32_t> node_moments(const InverseMap& map, const BinMap& bins, const TexelClasses& classes) {
  std::vector<std::uint32_t> out(map.forest.size());
  tbb::parallel_for(std::size_t{0}, map.lists.size(), [&](std::size_t i) {
    const TexelList& list = map.lists[i];
    if (list.key == no_key) return;
    const int across = classes.across.empty() ? bins.across : classes.across[list.key >> bin_bits];
    const std::uint32_t bin = list.key & ((1U << bin_bits) - 1U);
    MomentsOfNodes{map, bins, bin, static_cast<std::uint32_t>(across), out}.add(list.root, list.first,
                                                                                list.first + map.count_of(i));
  });
  return out;
}

std::vector<glm::vec2> list_roundings(const InverseMap& map, const BinMap& bins, const Image& normals) {
  return means_over_lists<glm::vec2>(map, [&](int x, int y) {
    const std::uint32_t packed =
        bins.normals[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
    if (packed == no_normal) return glm::dvec2(0.0);
    const std::span<const float> n = normals.at(x, y);
    return hemisphere_to_square(glm::normalize(glm::dvec3(n[0], n[1], n[2]))) - place_in_square(packed);
  });
}

std::vector<float> list_means(const InverseMap& map, const Image& values) {
  return means_over_lists<float>(map, [&](int x, int y) { return static_cast<double>(values.at(x, y)[0]); });
}

}  // namespace footprint::atanasov_bins
