// Corrects tables level by level, rounds each once, and writes it to the four blocks that contain it.
#include "methods/ndf_atlas/atlas.hpp"

#include <Imath/half.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "renderer/image/mipmap.hpp"

namespace footprint::ndf_atlas {
namespace {

constexpr int most_texels_across = 16384;

// A table in its storage, scaled so that its largest node is 1.
struct StoredTable {
  std::vector<std::uint8_t> bytes;
  float scale = 0.0F;
};

StoredTable stored(std::span<const float> table, int width, Storage storage) {
  StoredTable out{{}, std::max(std::ranges::max(table), 1e-30F)};
  if (storage == Storage::unorm8) {
    out.bytes = bytes_of(table, width, out.scale, Rounding::diffused);
    return out;
  }
  out.bytes.resize(table.size() * channel_bytes(storage));
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float value = table[i] / out.scale;
    const std::uint16_t half_value = half(value).bits();
    if (storage == Storage::fp16) {
      std::memcpy(&out.bytes[2 * i], &half_value, 2);
    } else {
      std::memcpy(&out.bytes[4 * i], &value, 4);
    }
  }
  return out;
}

// The texel after texel i of `size` along an axis.
int next_texel(int i, int size, Wrap wrap) {
  if (i + 1 < size) return i + 1;
  return wrap == Wrap::repeat ? 0 : size - 1;
}

// The textures that all levels are written to.
class Packing {
 public:
  Packing(const AtlasLayout& layout, Storage storage) : layout_(layout), storage_(storage) {
    densities_.width = layout.columns * layout.nodes.x;
    densities_.height = layout.rows * layout.nodes.y;
    densities_.bytes.resize(layout.byte_count(storage));
    blocks_ = Image(2 * layout.columns, layout.rows, 4);
  }

  // Adds the tables of the next level.
  void add(LevelTables& level, const Lattice& lattice, const std::array<Wrap, 2>& wrap) {
    std::vector<StoredTable> tables(level.coverage.size());
    tbb::parallel_for(std::size_t{0}, tables.size(), [&](std::size_t texel) {
      const std::span<const float> plain = level.table(texel);
      std::vector<float> table(plain.begin(), plain.end());
      correct_for_bilinear(table, lattice);
      close_border(table, lattice);
      for (float& node : table) node *= level.coverage[texel];
      tables[texel] = stored(table, lattice.nodes.x, storage_);
    });
    tbb::parallel_for(0, level.height, [&](int y) {
      for (int x = 0; x < level.width; ++x) {
        const int right = next_texel(x, level.width, wrap[0]);
        const int below = next_texel(y, level.height, wrap[1]);
        const std::array<glm::ivec2, 4> texels{{{x, y}, {right, y}, {x, below}, {right, below}}};
        for (std::size_t channel = 0; channel < 4; ++channel) {
          const auto texel = static_cast<std::size_t>(texels[channel].y * level.width + texels[channel].x);
          put(first_block_ + static_cast<std::size_t>(y * level.width + x), channel, tables[texel],
              level.coverage[texel]);
        }
      }
    });
    first_block_ += tables.size();
  }

  [[nodiscard]] std::array<PrefilteredTexture, 2> take() {
    std::array<PrefilteredTexture, 2> out;
    out[0].name = "ndf_atlas_densities";
    out[0].storage = storage_;
    out[0].filter = TextureFilter::linear;
    out[0].levels.push_back(std::move(densities_));
    out[1] = make_level_texture("ndf_atlas_blocks", std::move(blocks_), Storage::fp32, {});
    out[1].filter = TextureFilter::linear;
    return out;
  }

 private:
  void put(std::size_t block, std::size_t channel, const StoredTable& table, float coverage) {
    const auto columns = static_cast<std::size_t>(layout_.columns);
    const std::size_t column = block % columns;
    const std::size_t row = block / columns;
    const auto nodes_x = static_cast<std::size_t>(layout_.nodes.x);
    const auto nodes_y = static_cast<std::size_t>(layout_.nodes.y);
    const std::size_t size = channel_bytes(storage_);
    for (std::size_t j = 0; j < nodes_y; ++j) {
      const std::size_t texel = (row * nodes_y + j) * columns * nodes_x + column * nodes_x;
      std::uint8_t* out = &densities_.bytes[(4 * texel + channel) * size];
      const std::uint8_t* in = &table.bytes[j * nodes_x * size];
      for (std::size_t i = 0; i < nodes_x; ++i, out += 4 * size, in += size) std::memcpy(out, in, size);
    }
    blocks_.at(static_cast<int>(2 * column), static_cast<int>(row))[channel] = table.scale;
    blocks_.at(static_cast<int>(2 * column + 1), static_cast<int>(row))[channel] = coverage;
  }

  AtlasLayout layout_;
  Storage storage_;
  TextureLevel densities_;
  Image blocks_;
  std::size_t first_block_ = 0;
};

}  // namespace

std::vector<std::uint8_t> bytes_of(std::span<const float> table, int width, float scale, Rounding rounding) {
  std::vector<std::uint8_t> bytes(table.size());
  const auto row_length = static_cast<std::size_t>(width);
  double left_over = 0.0;
  for (std::size_t row = 0; row * row_length < table.size(); ++row) {
    for (std::size_t k = 0; k < row_length; ++k) {
      const std::size_t node = row * row_length + (row % 2 == 0 ? k : row_length - 1 - k);
      const double value = 255.0 * static_cast<double>(table[node]) / static_cast<double>(scale) + left_over;
      const double byte = std::clamp(std::round(value), 0.0, 255.0);
      if (rounding == Rounding::diffused) left_over = value - byte;
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

namespace {

std::size_t block_count(int width, int height, int first_level) {
  std::size_t blocks = 0;
  for (int level = first_level; level < mip_level_count(width, height); ++level)
    blocks +=
        static_cast<std::size_t>(std::max(width >> level, 1)) * static_cast<std::size_t>(std::max(height >> level, 1));
  return blocks;
}

}  // namespace

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

std::array<PrefilteredTexture, 2> atlas_textures(LevelTables finest, const Lattice& lattice, const AtlasLayout& layout,
                                                 Storage storage, const std::array<Wrap, 2>& wrap) {
  Packing packing(layout, storage);
  LevelTables level = std::move(finest);
  packing.add(level, lattice, wrap);
  while (level.coverage.size() > 1) {
    level = coarser(level);
    packing.add(level, lattice, wrap);
  }
  return packing.take();
}

}  // namespace footprint::ndf_atlas
