// Adds the lobe of every facet to the nodes within its reach, in a fixed order within a texel. Corrects tables level by
// level, rounds each once, and writes it to the four blocks that contain it.
#include "methods/ndf_atlas/atlas.hpp"

#include <Imath/half.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numbers>
#include <stdexcept>

#include "renderer/bake/facets.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::ndf_atlas {
namespace {

// The finest texels under a texel of a level along one axis, from `first` on, and their shares of it.
struct AxisTaps {
  int first = 0;
  std::vector<double> weight;
};

AxisTaps taps_of(int size, int level, int i) {
  if (level == 0) return {i, {1.0}};
  const MipTaps own = mip_taps(std::max(size >> (level - 1), 1), i);
  AxisTaps out;
  for (int k = 0; k < own.count; ++k) {
    const AxisTaps fine = taps_of(size, level - 1, own.first + k);
    if (k == 0) out.first = fine.first;
    const auto first = static_cast<std::size_t>(fine.first - out.first);
    out.weight.resize(std::max(out.weight.size(), first + fine.weight.size()));
    for (std::size_t j = 0; j < fine.weight.size(); ++j)
      out.weight[first + j] += own.weight[static_cast<std::size_t>(k)] * fine.weight[j];
  }
  return out;
}

std::vector<AxisTaps> axis_taps(int size, int level) {
  std::vector<AxisTaps> taps;
  for (int i = 0; i < std::max(size >> level, 1); ++i) taps.push_back(taps_of(size, level, i));
  return taps;
}

// The nodes of a lattice as directions, and buffers for adding a facet to them.
class NodeSums {
 public:
  NodeSums(const Facets& facets, const Lattice& lattice) : facets_(facets), lattice_(lattice) {
    for (int j = 0; j < lattice.nodes.y; ++j)
      for (int i = 0; i < lattice.nodes.x; ++i) directions_.push_back(direction_over(lattice.point(i, j)));
    // Across the tilt the plane is up to sqrt(2) times as wide as the sphere above the horizon.
    half_edge_ =
        lattice.reach < 0.5 * std::numbers::pi ? 2.0 * std::numbers::sqrt2 * std::sin(0.5 * lattice.reach) : 4.0;
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
        if (!facets_.stretches.empty()) {
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
    return anisotropic_density(facets_.distribution, facets_.alphas(facet), rotation_of_stretch(facets_.stretch(facet)),
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

constexpr int most_texels_across = 16384;

// A table in its storage, corrected, times its coverage, and scaled so that its largest node is 1.
struct StoredTable {
  std::vector<std::uint8_t> bytes{};
  float scale = 0.0F, coverage = 0.0F;
};

StoredTable stored(std::span<const float> plain, float coverage, const Lattice& lattice, Storage storage) {
  std::vector<float> table(plain.begin(), plain.end());
  correct_for_bilinear(table, lattice);
  close_border(table, lattice);
  for (float& node : table) node *= coverage;
  StoredTable out{.scale = std::max(std::ranges::max(table), 1e-30F), .coverage = coverage};
  if (storage == Storage::unorm8) {
    out.bytes = bytes_of(table, lattice.nodes.x, out.scale);
    return out;
  }
  const std::size_t size = channel_bytes(storage);
  out.bytes.resize(table.size() * size);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float value = table[i] / out.scale;
    const std::uint16_t half_value = half(value).bits();
    const void* const from = storage == Storage::fp16 ? static_cast<const void*>(&half_value) : &value;
    std::memcpy(&out.bytes[size * i], from, size);
  }
  return out;
}

// The texel after texel i of `size` along an axis.
int next_texel(int i, int size, Wrap wrap) {
  if (i + 1 < size) return i + 1;
  return wrap == Wrap::repeat ? 0 : size - 1;
}

// The texels that all levels are written to.
struct Atlas {
  const AtlasLayout& layout;
  std::size_t size;  // of a node, bytes
  TextureLevel densities;
  Image blocks{2 * layout.columns, layout.rows, 4};

  void put(std::size_t block, std::size_t channel, const StoredTable& table) {
    const auto columns = static_cast<std::size_t>(layout.columns);
    const std::size_t column = block % columns, row = block / columns;
    const auto nodes_x = static_cast<std::size_t>(layout.nodes.x), nodes_y = static_cast<std::size_t>(layout.nodes.y);
    for (std::size_t j = 0; j < nodes_y; ++j) {
      const std::size_t texel = (row * nodes_y + j) * columns * nodes_x + column * nodes_x;
      std::uint8_t* out = &densities.bytes[(4 * texel + channel) * size];
      const std::uint8_t* in = &table.bytes[j * nodes_x * size];
      for (std::size_t i = 0; i < nodes_x; ++i, out += 4 * size, in += size) std::memcpy(out, in, size);
    }
    blocks.at(static_cast<int>(2 * column), static_cast<int>(row))[channel] = table.scale;
    blocks.at(static_cast<int>(2 * column + 1), static_cast<int>(row))[channel] = table.coverage;
  }
};

std::size_t block_count(int width, int height, int first_level) {
  std::size_t blocks = 0;
  for (int level = first_level; level < mip_level_count(width, height); ++level)
    blocks +=
        static_cast<std::size_t>(std::max(width >> level, 1)) * static_cast<std::size_t>(std::max(height >> level, 1));
  return blocks;
}

}  // namespace

LevelTables build_tables(const Facets& facets, const Lattice& lattice, int level, const Progress& progress) {
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

std::vector<std::uint8_t> bytes_of(std::span<const float> table, int width, float scale) {
  std::vector<std::uint8_t> bytes(table.size());
  const auto row_length = static_cast<std::size_t>(width);
  double left_over = 0.0;
  for (std::size_t row = 0; row * row_length < table.size(); ++row) {
    for (std::size_t k = 0; k < row_length; ++k) {
      const std::size_t node = row * row_length + (row % 2 == 0 ? k : row_length - 1 - k);
      const double value = 255.0 * static_cast<double>(table[node]) / static_cast<double>(scale) + left_over;
      const double byte = std::clamp(std::round(value), 0.0, 255.0);
      left_over = value - byte;
      bytes[node] = static_cast<std::uint8_t>(byte);
    }
  }
  return bytes;
}

std::size_t AtlasLayout::byte_count(Storage storage) const {
  const auto width = static_cast<std::size_t>(columns) * static_cast<std::size_t>(nodes.x);
  const auto height = static_cast<std::size_t>(rows) * static_cast<std::size_t>(nodes.y);
  return 4 * channel_bytes(storage) * width * height;
}

double node_count(int width, int height, const Lattice& lattice, int first_level) {
  return 4.0 * static_cast<double>(block_count(width, height, first_level)) * static_cast<double>(lattice.node_count());
}

AtlasLayout layout_for(int width, int height, const Lattice& lattice, int first_level) {
  AtlasLayout layout{.first_level = first_level, .nodes = lattice.nodes};
  const std::size_t blocks = block_count(width, height, first_level);
  const double squarish = std::sqrt(static_cast<double>(blocks) * lattice.nodes.y / lattice.nodes.x);
  layout.columns = 1 << std::max(static_cast<int>(std::lround(std::log2(std::max(squarish, 1.0)))), 0);
  const auto columns = static_cast<std::size_t>(layout.columns);
  layout.rows = static_cast<int>((blocks + columns - 1) / columns);
  if (layout.columns * layout.nodes.x > most_texels_across || layout.rows * layout.nodes.y > most_texels_across)
    throw std::logic_error("an atlas is larger than textures are");
  return layout;
}

std::array<PrefilteredTexture, 2> atlas_textures(LevelTables level, const Lattice& lattice, const AtlasLayout& layout,
                                                 Storage storage, const std::array<Wrap, 2>& wrap) {
  Atlas atlas{.layout = layout,
              .size = channel_bytes(storage),
              .densities = {.width = layout.columns * layout.nodes.x,
                            .height = layout.rows * layout.nodes.y,
                            .bytes = std::vector<std::uint8_t>(layout.byte_count(storage))}};
  for (std::size_t first_block = 0;; level = coarser(level)) {
    std::vector<StoredTable> tables(level.coverage.size());
    tbb::parallel_for(std::size_t{0}, tables.size(), [&](std::size_t texel) {
      tables[texel] = stored(level.table(texel), level.coverage[texel], lattice, storage);
    });
    tbb::parallel_for(0, level.height, [&](int y) {
      const int below = next_texel(y, level.height, wrap[1]);
      for (int x = 0; x < level.width; ++x) {
        const int right = next_texel(x, level.width, wrap[0]);
        const std::array<glm::ivec2, 4> texels{{{x, y}, {right, y}, {x, below}, {right, below}}};
        for (std::size_t channel = 0; channel < 4; ++channel)
          atlas.put(first_block + static_cast<std::size_t>(y * level.width + x), channel,
                    tables[static_cast<std::size_t>(texels[channel].y * level.width + texels[channel].x)]);
      }
    });
    first_block += tables.size();
    if (tables.size() == 1) break;
  }
  std::array<PrefilteredTexture, 2> out;
  out[0].name = "ndf_atlas_densities";
  out[0].storage = storage;
  out[0].levels.push_back(std::move(atlas.densities));
  out[1] = make_level_texture("ndf_atlas_blocks", std::move(atlas.blocks), Storage::fp32, {});
  for (PrefilteredTexture& texture : out) texture.filter = TextureFilter::linear;
  return out;
}

}  // namespace footprint::ndf_atlas
