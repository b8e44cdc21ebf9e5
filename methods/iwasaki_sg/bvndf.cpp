// Bins normals, and sums visibility bits and lobes over the bins for each pair of directions.
#include "methods/iwasaki_sg/bvndf.hpp"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <utility>

#include "methods/iwasaki_sg/lobe_fit.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::iwasaki_sg {
namespace {

// The means of normals in the cells of a cube, in the order of cells. each(add) calls add(mean, weight) for normals,
// which belong to the cell of their direction and may have any length.
template <class Each>
std::vector<WeightedNormal> means_over_cells(int side, const Each& each) {
  std::vector<WeightedNormal> cells(std::size_t{6} * static_cast<std::size_t>(side * side));
  each([&](const glm::dvec3& mean, double weight) {
    WeightedNormal& cell = cells[cube_cell(mean, side)];
    cell.normal += weight * mean;
    cell.weight += weight;
  });
  std::erase_if(cells, [](const WeightedNormal& cell) { return !(cell.weight > 0.0); });
  for (WeightedNormal& cell : cells) cell.normal /= cell.weight;
  return cells;
}

// Runs of bins that are summed separately and then added in order, so that sums do not depend on the number of threads.
constexpr std::size_t runs = 8;

// Shares of a lobe in a normal below this, relative to its largest share, are left out.
constexpr double negligible = 1e-9;

// Word w of the bits of one direction, without those outside a bin.
std::uint64_t bits_of(std::span<const std::uint64_t> words, const NormalBin& bin, std::size_t w) {
  std::uint64_t bits = words[w];
  if (w == bin.begin / 64) bits &= ~std::uint64_t{0} << (bin.begin % 64);
  if (w == (bin.end - 1) / 64) bits &= ~std::uint64_t{0} >> (63 - (bin.end - 1) % 64);
  return bits;
}

// How many of the samples of a bin two directions see.
int common_count(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b, const NormalBin& bin) {
  int count = 0;
  for (std::size_t w = bin.begin / 64; w <= (bin.end - 1) / 64; ++w) count += std::popcount(bits_of(a, bin, w) & b[w]);
  return count;
}

// The counts of common bits of row `a` and each following row.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("popcnt", "default")))
#endif
void common_bits(const std::uint64_t* rows, std::size_t words, std::size_t a, std::size_t count, std::uint32_t* out) {
  const std::uint64_t* const own = rows + a * words;
  for (std::size_t b = a; b < count; ++b) {
    const std::uint64_t* const other = rows + b * words;
    std::uint32_t sum = 0;
    for (std::size_t w = 0; w < words; ++w) sum += static_cast<std::uint32_t>(__builtin_popcountll(own[w] & other[w]));
    out[b] = sum;
  }
}

double cosine(const glm::dvec3& normal, const glm::dvec3& direction) {
  return std::max(glm::dot(normal, direction), 0.0);
}

BvndfSums empty_sums(std::size_t directions, std::size_t lobes, std::size_t channels) {
  const std::size_t pairs = directions * directions;
  return {.directions = directions,
          .lobes = lobes,
          .channels = channels,
          .products = std::vector<float>(channels * lobes * pairs),
          .totals = std::vector<float>(channels * pairs),
          .diffuse = std::vector<float>(channels * pairs)};
}

// Adds the pairs of directions that see facets of a bin.
class Summer {
 public:
  Summer(const Bvndf& bvndf, std::span<const SphericalGaussian> lobes, Cosines cosines,
         std::span<const PaintFactors> paints)
      : bvndf_(bvndf), lobes_(lobes), cosines_(cosines), paints_(paints), weighted_(bvndf.directions.size()) {}

  void add_bin(const NormalBin& bin, BvndfSums& sums) {
    count(bin);
    const std::size_t n = active_.size();
    if (n == 0) return;
    reach_.clear();
    for (std::size_t j = 0; j < lobes_.size(); ++j) {
      const double product = convolution({bin.normal, sharpest}, lobes_[j]) / vmf_integral(sharpest);
      if (product > negligible) reach_.emplace_back(j, static_cast<float>(product));
    }
    cosine_.clear();
    for (const std::size_t d : active_) {
      cosine_.push_back(static_cast<float>(cosine(bin.normal, bvndf_.directions[d])));
    }
    const auto area = static_cast<float>(bvndf_.facet_area);
    for (std::size_t a = 0; a < n; ++a) {
      std::ranges::fill(weighted_, 0.0F);
      for (std::size_t b = 0; b < n; ++b) {
        weighted_[active_[b]] = static_cast<float>(counts_[a * n + b]) * cosine_[b] * area;
      }
      add_row(bin, active_[a], cosine_[a], sums);
    }
  }

 private:
  // gamma of one normal over all pairs of the directions that see any of its facets. It is symmetric, so half is
  // counted.
  void count(const NormalBin& bin) {
    const std::size_t words = (bin.end - 1) / 64 - bin.begin / 64 + 1;
    active_.clear();
    rows_.resize(bvndf_.directions.size() * words);
    for (std::size_t d = 0; d < bvndf_.directions.size(); ++d) {
      std::uint64_t* const row = rows_.data() + active_.size() * words;
      for (std::size_t w = 0; w < words; ++w) row[w] = bits_of(bvndf_.visibility.of(d), bin, bin.begin / 64 + w);
      if (std::any_of(row, row + words, [](std::uint64_t word) { return word != 0; })) active_.push_back(d);
    }
    const std::size_t n = active_.size();
    counts_.resize(n * n);
    for (std::size_t a = 0; a < n; ++a) {
      common_bits(rows_.data(), words, a, n, counts_.data() + a * n);
      for (std::size_t b = a + 1; b < n; ++b) counts_[b * n + a] = counts_[a * n + b];
    }
  }

  // weighted_ stores gamma (n.wo) of all wo for direction `wi`.
  void add_row(const NormalBin& bin, std::size_t wi, float cosine_i, BvndfSums& sums) const {
    const std::size_t n = weighted_.size();
    const auto add_to = [&](std::vector<float>& values, std::size_t block, float scale) {
      float* const row = values.data() + (block * n + wi) * n;
      for (std::size_t o = 0; o < n; ++o) row[o] += scale * weighted_[o];
    };
    const PaintFactors& paint = paints_[bin.paint];
    for (std::size_t c = 0; c < sums.channels; ++c) {
      const float specular = paint.specular[static_cast<int>(c)] * (cosines_ == Cosines::published ? cosine_i : 1.0F);
      add_to(sums.diffuse, c, paint.diffuse[static_cast<int>(c)] * cosine_i);
      add_to(sums.totals, c, specular);
      for (const auto& [lobe, product] : reach_) add_to(sums.products, c * lobes_.size() + lobe, specular * product);
    }
  }

  const Bvndf& bvndf_;
  std::span<const SphericalGaussian> lobes_;
  Cosines cosines_;
  std::span<const PaintFactors> paints_;
  std::vector<std::size_t> active_;  // the directions that see the bin, in order
  std::vector<std::uint64_t> rows_;
  std::vector<std::uint32_t> counts_;                 // of each pair of them
  std::vector<std::pair<std::size_t, float>> reach_;  // lobes, and their integrals over the lobe of the normal
  std::vector<float> cosine_, weighted_;
};

// The first bin of each run: even shares of samples and bins, both of which cost time.
std::array<std::size_t, runs + 1> run_starts(const Bvndf& bvndf) {
  constexpr std::size_t samples_like_one_bin = 64;
  const std::size_t all = bvndf.bins.back().end + samples_like_one_bin * bvndf.bins.size();
  std::array<std::size_t, runs + 1> starts{};
  std::size_t run = 1;
  for (std::size_t i = 0; i < bvndf.bins.size(); ++i) {
    while (run < runs && bvndf.bins[i].begin + samples_like_one_bin * i >= run * all / runs) starts.at(run++) = i;
  }
  for (; run <= runs; ++run) starts.at(run) = bvndf.bins.size();
  return starts;
}

}  // namespace

std::uint32_t cube_cell(const glm::dvec3& normal, int side) {
  const glm::dvec3 size = glm::abs(normal);
  int axis = size.x >= size.y ? 0 : 1;
  if (size.z >= size[axis]) axis = 2;
  const double lead = std::max(size[axis], 1e-300);
  const auto cell_along = [&](int other) {
    // The small offset keeps normals on an axis, which is a border of cells, in one cell despite rounding.
    constexpr double hair = 1e-6;
    const double unit = 0.5 + 0.5 * normal[other] / lead + hair;
    return std::min(static_cast<int>(unit * side), side - 1);
  };
  const int face = 2 * axis + (normal[axis] < 0.0 ? 1 : 0);
  return static_cast<std::uint32_t>((face * side + cell_along((axis + 2) % 3)) * side + cell_along((axis + 1) % 3));
}

BinnedFacets bin_facets(const Patch& patch, const FacetSamples& samples) {
  struct Key {
    std::uint32_t paint, cell, sample;
    [[nodiscard]] bool same_bin(const Key& other) const { return paint == other.paint && cell == other.cell; }
    auto operator<=>(const Key&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
  };
  std::vector<glm::dvec3> normals;
  std::vector<Key> of_triangle;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    normals.push_back(facet_plane(patch, t).normal);
    of_triangle.push_back({patch.paints.empty() ? 0U : patch.paints[t], cube_cell(normals[t], cube_side), 0});
  }
  std::vector<Key> keys;
  keys.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    keys.push_back(of_triangle[samples.triangles[i]]);
    keys.back().sample = static_cast<std::uint32_t>(i);
  }
  std::ranges::sort(keys);
  BinnedFacets out;
  out.samples.facet_area = samples.facet_area;
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::uint32_t triangle = samples.triangles[keys[i].sample];
    if (i == 0 || !keys[i].same_bin(keys[i - 1])) {
      out.bins.push_back({{}, static_cast<std::uint8_t>(keys[i].paint), i, i});
      sum = glm::dvec3(0.0);
    }
    sum += normals[triangle];
    out.bins.back().end = i + 1;
    out.bins.back().normal = glm::normalize(sum);
    out.samples.positions.push_back(samples.positions[keys[i].sample]);
    out.samples.triangles.push_back(triangle);
  }
  return out;
}

std::vector<WeightedNormal> bin_normal_map(const Image& normals) {
  double total = 0.0;
  std::vector<WeightedNormal> out = means_over_cells(cube_side, [&](const auto& add) {
    for (std::size_t i = 0; i + 3 < normals.texels.size(); i += 4) {
      const glm::dvec3 n(normals.texels[i], normals.texels[i + 1], normals.texels[i + 2]);
      const double weight = normals.texels[i + 3], length = glm::length(n);
      if (!(weight > 0.0 && length > 1e-3)) continue;
      add(n / length, weight);
      total += weight;
    }
  });
  for (WeightedNormal& normal : out) normal.weight /= total;
  return out;
}

std::vector<WeightedNormal> pool_normals(std::vector<WeightedNormal> normals, std::size_t most) {
  for (int side = cube_side / 2; normals.size() > most && side > 0; side /= 2) {
    normals = means_over_cells(side, [&](const auto& add) {
      for (const WeightedNormal& n : normals) add(n.normal, n.weight);
    });
  }
  return normals;
}

double Bvndf::gamma(std::size_t bin, std::size_t wi, std::size_t wo) const {
  return common_count(visibility.of(wi), visibility.of(wo), bins[bin]) * facet_area;
}

double Bvndf::total_area() const { return bins.empty() ? 0.0 : static_cast<double>(bins.back().end) * facet_area; }

Bvndf make_bvndf(const Patch& patch, BinnedFacets facets, std::vector<glm::dvec3> directions,
                 const Progress& progress) {
  FacetVisibility visibility = facet_visibility(patch, facets.samples, directions, progress);
  progress("BVNDF", 1.0);
  Bvndf out{.directions = std::move(directions),
            .bins = std::move(facets.bins),
            .visibility = std::move(visibility),
            .facet_area = facets.samples.facet_area,
            .visible_area = {}};
  for (std::size_t d = 0; d < out.directions.size(); ++d) {
    const auto seen = out.visibility.of(d);
    double sum = 0.0;
    for (const NormalBin& bin : out.bins) sum += common_count(seen, seen, bin) * cosine(bin.normal, out.directions[d]);
    out.visible_area.push_back(sum * out.facet_area);
  }
  return out;
}

std::vector<WeightedNormal> visible_ndf(const Bvndf& bvndf) {
  std::vector<std::uint64_t> seen(bvndf.visibility.of(0).size());
  for (std::size_t d = 0; d < bvndf.directions.size(); ++d) {
    std::ranges::transform(seen, bvndf.visibility.of(d), seen.begin(), std::bit_or<>());
  }
  std::vector<WeightedNormal> out;
  for (const NormalBin& bin : bvndf.bins) {
    std::size_t count = 0;
    for (std::size_t i = bin.begin; i < bin.end; ++i) count += (seen[i / 64] >> (i % 64)) & 1U;
    if (count > 0) out.push_back({bin.normal, static_cast<double>(count) * bvndf.facet_area});
  }
  return out;
}

BvndfSums sum_bvndf(const Bvndf& bvndf, std::span<const SphericalGaussian> lobes, Cosines cosines, std::size_t channels,
                    std::span<const PaintFactors> paints, const Progress& progress) {
  const auto starts = run_starts(bvndf);
  progress("BVNDF", 0.0);
  std::vector<BvndfSums> parts(runs);
  tbb::parallel_for(std::size_t{0}, runs, [&](std::size_t run) {
    parts[run] = empty_sums(bvndf.directions.size(), lobes.size(), channels);
    Summer summer(bvndf, lobes, cosines, paints);
    for (std::size_t i = starts.at(run); i < starts.at(run + 1); ++i) summer.add_bin(bvndf.bins[i], parts[run]);
  });
  BvndfSums sums = std::move(parts.front());
  for (std::size_t run = 1; run < runs; ++run) {
    for (auto values : {&BvndfSums::products, &BvndfSums::totals, &BvndfSums::diffuse})
      std::ranges::transform(sums.*values, parts[run].*values, (sums.*values).begin(), std::plus<>());
  }
  return sums;
}

}  // namespace footprint::iwasaki_sg
