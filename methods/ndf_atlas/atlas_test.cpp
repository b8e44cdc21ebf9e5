// Bytes that keep the energy; the place of every table in the atlas.
#include "methods/ndf_atlas/atlas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace footprint::ndf_atlas {
namespace {

// A narrow peak over a wide plateau of half a step: what coarse levels of a few mirrors look like.
std::vector<float> peak_over_plateau(int edge) {
  std::vector<float> table;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      const double r2 = (x - 10.3) * (x - 10.3) + (y - 12.1) * (y - 12.1);
      table.push_back(static_cast<float>(std::exp(-0.5 * r2) + 0.45 / 255.0 * std::exp(-0.002 * r2)));
    }
  }
  return table;
}

double energy_of(const std::vector<std::uint8_t>& bytes, std::span<const float> table, float scale) {
  const double sum = std::accumulate(bytes.begin(), bytes.end(), 0.0) * static_cast<double>(scale) / 255.0;
  return sum / std::accumulate(table.begin(), table.end(), 0.0);
}

TEST(AtlasBytes, DiffusedKeepTheEnergy) {
  const std::vector<float> table = peak_over_plateau(32);
  const float scale = std::ranges::max(table);
  EXPECT_NEAR(energy_of(bytes_of(table, 32, scale), table, scale), 1.0, 1e-3);
  std::vector<std::uint8_t> nearest;
  for (const float node : table) nearest.push_back(static_cast<std::uint8_t>(std::lround(255.0F * node / scale)));
  EXPECT_LT(energy_of(nearest, table, scale), 0.95) << "the gate";
}

TEST(AtlasBytes, AreWithinAStepOfTheirNodes) {
  const std::vector<float> table = peak_over_plateau(32);
  const float scale = std::ranges::max(table);
  const std::vector<std::uint8_t> bytes = bytes_of(table, 32, scale);
  for (std::size_t i = 0; i < table.size(); ++i)
    EXPECT_NEAR(bytes[i], 255.0 * static_cast<double>(table[i]) / static_cast<double>(scale), 1.0);
}

// Tables of 2 x 2 equal nodes, numbered by their texels.
LevelTables numbered(int width, int height) {
  LevelTables tables{.width = width, .height = height, .nodes = 4, .density = {}, .coverage = {}};
  for (int i = 0; i < width * height; ++i) {
    tables.coverage.push_back(i == 1 ? 0.5F : 1.0F);
    for (int k = 0; k < 4; ++k) tables.density.push_back(static_cast<float>(1 + i));
  }
  return tables;
}

struct Block {
  std::array<double, 4> density{};  // node (0, 0) of the four tables, scaled, over its coverage
  std::array<double, 4> coverage{};
};

Block block_of(const std::array<PrefilteredTexture, 2>& textures, const AtlasLayout& layout, int block) {
  const int column = block % layout.columns;
  const int row = block / layout.columns;
  const Image densities = decode_level(textures[0], 0);
  const Image blocks = decode_level(textures[1], 0);
  Block out;
  for (std::size_t c = 0; c < 4; ++c) {
    out.coverage[c] = blocks.at(2 * column + 1, row)[c];
    out.density[c] = densities.at(column * layout.nodes.x, row * layout.nodes.y)[c] * blocks.at(2 * column, row)[c] /
                     out.coverage[c];
  }
  return out;
}

TEST(Atlas, BlocksHaveTheirNeighboursByTheMapsWrap) {
  // Far below the horizon, where no border is closed; second differences leave (1 + 2 / 12) of equal nodes.
  const Lattice lattice{.nodes = {2, 2}, .origin = {5.0, 5.0}, .step = {1.0, 1.0}};
  for (const Storage storage : {Storage::unorm8, Storage::fp16, Storage::fp32}) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp_to_edge, Wrap::mirrored_repeat}) {
      const AtlasLayout layout = layout_for(6, 4, lattice, 1);  // 3 x 2 and one texel
      const auto textures = atlas_textures(numbered(3, 2), lattice, layout, storage, {wrap, Wrap::clamp_to_edge});
      const int beyond = wrap == Wrap::repeat ? 0 : 2;
      const std::array<std::array<int, 4>, 3> expected{{{0, 1, 3, 4}, {2, beyond, 5, 3 + beyond}, {4, 5, 4, 5}}};
      const std::array<int, 3> blocks{0, 2, 4};
      for (std::size_t k = 0; k < blocks.size(); ++k) {
        const Block block = block_of(textures, layout, blocks[k]);
        for (std::size_t c = 0; c < 4; ++c) {
          EXPECT_NEAR(block.density[c] / (1.0 + 2.0 / 12.0), 1 + expected[k][c], 2e-3) << blocks[k] << " " << c;
          EXPECT_NEAR(block.coverage[c], expected[k][c] == 1 ? 0.5 : 1.0, 1e-6);
        }
      }
      const Block last = block_of(textures, layout, 6);
      EXPECT_NEAR(last.density[3] / (1.0 + 2.0 / 12.0), (1 + 0.5 * 2 + 3 + 4 + 5 + 6) / 5.5, 5e-3) << "by coverage";
    }
  }
}

TEST(Atlas, LayoutsHoldAllBlocksNearlySquare) {
  for (const glm::ivec2& size : {glm::ivec2(256, 256), glm::ivec2(1000, 37), glm::ivec2(1, 4096), glm::ivec2(3, 2)}) {
    const Lattice lattice{.nodes = {31, 27}};
    const AtlasLayout layout = layout_for(size.x, size.y, lattice, 1);
    int blocks = 0;
    for (glm::ivec2 level = size / 2;; level /= 2) {
      level = glm::max(level, glm::ivec2(1));
      blocks += level.x * level.y;
      if (level == glm::ivec2(1)) break;
    }
    EXPECT_GE(layout.columns * layout.rows, blocks);
    EXPECT_LT(layout.columns * (layout.rows - 1), blocks);
    EXPECT_LE(std::max(layout.columns * 31, layout.rows * 27),
              2 * std::min(layout.columns * 31, layout.rows * 27) + 31);
    EXPECT_EQ(layout.byte_count(Storage::fp16),
              8U * 31U * 27U * static_cast<std::size_t>(layout.columns * layout.rows));
  }
  // The largest maps that there may be, in their worst shapes.
  for (int edge = 8; edge <= 256; ++edge) {
    const Lattice lattice{.nodes = {edge, edge}};
    int width = 1;
    while (node_count(width + 1, 4096, lattice, 3) <= 480e6) ++width;
    EXPECT_NO_THROW((void)layout_for(width, 4096, lattice, 3)) << edge;
  }
  EXPECT_THROW((void)layout_for(16384, 16384, {.nodes = {64, 64}}, 1), std::logic_error);
}

}  // namespace
}  // namespace footprint::ndf_atlas
