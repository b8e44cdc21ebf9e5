// Adds the lobe of every facet to the nodes within its reach, in parallel over texels and in a fixed order within a
// texel.
#include "methods/ndf_atlas/atlas.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "renderer/bake/facets.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::ndf_atlas {
namespace {

// The finest texels under a texel of a level along one axis, from `first` on, and their shares of it.
struct AxisTaps {
  int first = 0;
  std::vector<double> weight;
};

std::vector<AxisTaps> axis_taps(int size, int level) {
  std::vector<AxisTaps> taps;
  taps.reserve(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) taps.push_back({i, {1.0}});
  for (int l = 0; l < level && taps.size() > 1; ++l) {
    const auto fine_size = static_cast<int>(taps.size());
    std::vector<AxisTaps> coarse;
    for (int i = 0; i < fine_size / 2; ++i) {
      const MipTaps own = mip_taps(fine_size, i);
      const AxisTaps& last = taps[static_cast<std::size_t>(own.first + own.count - 1)];
      AxisTaps joined{taps[static_cast<std::size_t>(own.first)].first, {}};
      joined.weight.resize(static_cast<std::size_t>(last.first - joined.first) + last.weight.size());
      for (int k = 0; k < own.count; ++k) {
        const AxisTaps& fine = taps[static_cast<std::size_t>(own.first + k)];
        for (std::size_t j = 0; j < fine.weight.size(); ++j)
          joined.weight[static_cast<std::size_t>(fine.first - joined.first) + j] +=
              own.weight[static_cast<std::size_t>(k)] * fine.weight[j];
      }
      coarse.push_back(std::move(joined));
    }
    taps = std::move(coarse);
  }
  return taps;
}

// The nodes of a lattice as directions, and buffers for adding a facet to them.
class NodeSums {
 public:
  NodeSums(const Facets& facets, const Lattice& lattice) : facets_(facets), lattice_(lattice) {
    for (int j = 0; j < lattice.nodes.y; ++j)
      for (int i = 0; i < lattice.nodes.x; ++i) directions_.push_back(direction_over(lattice.point(i, j)));
    const std::size_t widest = static_cast<std::size_t>(
        std::ranges::max_element(facets.parameters,
                                 [&](float a, float b) {
                                   return lobe_width({facets.distribution, a}) < lobe_width({facets.distribution, b});
                                 }) -
        facets.parameters.begin());
    Lobe lobe = facets.lobe(widest);
    if (facets.anisotropy) lobe.parameter = facets.alphas(widest).along;
    const double reach = lobe_reach(lobe, energy_outside);
    // Across the tilt the plane is up to sqrt(2) times as wide as the sphere above the horizon.
    half_edge_ = reach < 0.5 * std::numbers::pi ? 2.0 * std::numbers::sqrt2 * std::sin(0.5 * reach) : 4.0;
  }

  void add(std::size_t facet, double weight, std::span<double> sums) const {
    const glm::dvec3 normal(facets_.normals[facet]);
    const Lobe lobe = facets_.lobe(facet);
    const double peak = weight * lobe_peak(lobe);
    const glm::dvec2 centre = (plane_of(normal) - lattice_.origin) / lattice_.step;
    const glm::dvec2 reach = half_edge_ / lattice_.step;
    const glm::ivec2 low = glm::max(glm::ivec2(glm::ceil(centre - reach)), glm::ivec2(0));
    const glm::ivec2 high = glm::min(glm::ivec2(glm::floor(centre + reach)), lattice_.nodes - 1);
    for (int j = low.y; j <= high.y; ++j) {
      const std::size_t row = static_cast<std::size_t>(j) * static_cast<std::size_t>(lattice_.nodes.x);
      for (int i = low.x; i <= high.x; ++i) {
        const std::size_t node = row + static_cast<std::size_t>(i);
        if (facets_.anisotropy) {
          sums[node] += weight * stretched(facet, normal, directions_[node]);
          continue;
        }
        const glm::dvec3 d = directions_[node] - normal;
        sums[node] += peak * lobe_shape(lobe, 0.5 * glm::dot(d, d));
      }
    }
  }

 private:
  [[nodiscard]] double stretched(std::size_t facet, const glm::dvec3& n, const glm::dvec3& direction) const {
    return anisotropic_density(facets_.distribution, facets_.alphas(facet), facets_.anisotropy->rotation,
                               turned_with_normal(direction, {-n.x, -n.y, n.z}));
  }

  const Facets& facets_;
  const Lattice& lattice_;
  std::vector<glm::dvec3> directions_;
  double half_edge_ = 4.0;
};

// Computes texel (column, row) from its taps; returns the share of it that has facets.
double sum_texel(const Facets& facets, const NodeSums& nodes, const AxisTaps& across, const AxisTaps& down,
                 std::span<double> sums) {
  std::ranges::fill(sums, 0.0);
  double covered = 0.0;
  for (std::size_t y = 0; y < down.weight.size(); ++y) {
    for (std::size_t x = 0; x < across.weight.size(); ++x) {
      const std::size_t facet = (static_cast<std::size_t>(down.first) + y) * static_cast<std::size_t>(facets.width) +
                                static_cast<std::size_t>(across.first) + x;
      if (!facets.is_valid(facet)) continue;
      const double weight = across.weight[x] * down.weight[y];
      covered += weight;
      nodes.add(facet, weight, sums);
    }
  }
  if (covered > 0.0)
    for (double& sum : sums) sum /= covered;
  return covered;
}

}  // namespace

LevelTables tables_of(const Facets& facets, const Lattice& lattice, int level, const Progress& progress) {
  const std::vector<AxisTaps> columns = axis_taps(facets.width, level);
  const std::vector<AxisTaps> rows = axis_taps(facets.height, level);
  const NodeSums nodes(facets, lattice);
  LevelTables out{.width = static_cast<int>(columns.size()),
                  .height = static_cast<int>(rows.size()),
                  .nodes = lattice.node_count(),
                  .density = {},
                  .coverage = std::vector<float>(columns.size() * rows.size())};
  out.density.resize(out.coverage.size() * out.nodes);
  int done = 0;
  std::mutex reporting;
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t y) {
    std::vector<double> sums(out.nodes);
    for (std::size_t x = 0; x < columns.size(); ++x) {
      const std::size_t texel = y * columns.size() + x;
      out.coverage[texel] = static_cast<float>(sum_texel(facets, nodes, columns[x], rows[y], sums));
      std::ranges::transform(sums, out.table(texel).begin(), [](double sum) { return static_cast<float>(sum); });
    }
    const std::scoped_lock lock(reporting);  // serialised, so that progress never decreases
    const double part = static_cast<double>(++done) / static_cast<double>(rows.size());
    progress(fmt::format("tabulating densities, {} x {}", out.width, out.height), part);
  });
  return out;
}

LevelTables coarser(const LevelTables& fine) {
  LevelTables out{.width = std::max(fine.width / 2, 1),
                  .height = std::max(fine.height / 2, 1),
                  .nodes = fine.nodes,
                  .density = {},
                  .coverage = {}};
  const std::size_t texels = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  out.coverage.resize(texels);
  out.density.resize(texels * out.nodes);
  tbb::parallel_for(0, out.height, [&](int y) {
    const MipTaps down = mip_taps(fine.height, y);
    std::vector<double> sums(out.nodes);
    for (int x = 0; x < out.width; ++x) {
      const MipTaps across = mip_taps(fine.width, x);
      std::ranges::fill(sums, 0.0);
      double covered = 0.0;
      for (int j = 0; j < down.count; ++j) {
        for (int i = 0; i < across.count; ++i) {
          const auto texel = static_cast<std::size_t>((down.first + j) * fine.width + across.first + i);
          const double weight = across.weight[static_cast<std::size_t>(i)] * down.weight[static_cast<std::size_t>(j)] *
                                static_cast<double>(fine.coverage[texel]);
          if (weight <= 0.0) continue;
          covered += weight;
          const std::span<const float> table = fine.table(texel);
          for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += weight * static_cast<double>(table[k]);
        }
      }
      const auto texel = static_cast<std::size_t>(y * out.width + x);
      out.coverage[texel] = static_cast<float>(covered);
      std::ranges::transform(sums, out.table(texel).begin(),
                             [&](double sum) { return covered > 0.0 ? static_cast<float>(sum / covered) : 0.0F; });
    }
  });
  return out;
}

void correct_for_bilinear(std::span<float> table, const Lattice& lattice) {
  const int width = lattice.nodes.x;
  const int height = lattice.nodes.y;
  const std::vector<float> plain(table.begin(), table.end());
  const auto at = [&](int i, int j) {
    const bool inside = i >= 0 && j >= 0 && i < width && j < height;
    return inside ? static_cast<double>(plain[static_cast<std::size_t>(j * width + i)]) : 0.0;
  };
  double sum = 0.0;
  double remaining = 0.0;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const double differences = at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1) - 4.0 * at(i, j);
      const double corrected = at(i, j) - differences / 12.0;
      sum += corrected;
      remaining += std::max(corrected, 0.0);
      table[static_cast<std::size_t>(j * width + i)] = static_cast<float>(std::max(corrected, 0.0));
    }
  }
  if (remaining <= 0.0) return;
  for (float& node : table) node *= static_cast<float>(sum / remaining);
}

void close_border(std::span<float> table, const Lattice& lattice) {
  for (int j = 0; j < lattice.nodes.y; ++j) {
    for (int i = 0; i < lattice.nodes.x; ++i) {
      const bool outermost = i == 0 || j == 0 || i + 1 == lattice.nodes.x || j + 1 == lattice.nodes.y;
      if (outermost && glm::length(lattice.point(i, j)) < std::numbers::sqrt2)
        table[static_cast<std::size_t>(j * lattice.nodes.x + i)] = 0.0F;
    }
  }
}

}  // namespace footprint::ndf_atlas
