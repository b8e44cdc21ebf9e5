// Weighted means over blocks, and the spread of the blocks.
#include "renderer/pipeline/sample_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace footprint {
namespace {

struct Pixel {
  glm::dvec3 mean{0};
  double count = 0;
};

Pixel merged(const Pixel& a, const Pixel& b) {
  const double count = a.count + b.count;
  if (count <= 0.0) return {};
  return {(a.count * a.mean + b.count * b.mean) / count, count};
}

Pixel pixel_of(const Image& mean, std::size_t i) {
  const float* const texel = &mean.texels[4 * i];
  return {{texel[0], texel[1], texel[2]}, texel[3]};
}

void set(Image& image, std::size_t i, const Pixel& pixel, float coverage) {
  for (int c = 0; c < 3; ++c) image.texels[4 * i + static_cast<std::size_t>(c)] = static_cast<float>(pixel.mean[c]);
  image.texels[4 * i + 3] = pixel.count > 0.0 ? coverage : 0.0F;
}

// The variance of the mean of blocks that are estimates of their own, B of them with weights w that sum to one:
// B / (B - 1) of the sum of w^2 (m - mean)^2.
glm::dvec3 variance_of(std::span<const Pixel> blocks, const Pixel& all) {
  glm::dvec3 sum(0);
  double filled = 0;
  for (const Pixel& block : blocks) {
    if (block.count <= 0.0) continue;
    const glm::dvec3 off = block.count / all.count * (block.mean - all.mean);
    sum += off * off;
    filled += 1.0;
  }
  return filled < 2.0 ? glm::dvec3(0) : sum * (filled / (filled - 1.0));
}

}  // namespace

SampleBlocks::SampleBlocks(const glm::ivec2& size) {
  for (Block& block : blocks_) block = {Image(size.x, size.y, 4), Image(size.x, size.y, 1), 0.0};
}

void SampleBlocks::add(const gl::RenderTarget& sums, const Tile& tile, int half, int block, double samples) {
  Block& into = blocks_.at(static_cast<std::size_t>(2 * half + block));
  into.samples = samples;
  read_tile(sums, 0, tile, into.mean);
  read_tile(sums, 1, tile, into.covered);
}

Supersampled SampleBlocks::result(int spp) const {
  const int width = blocks_[0].mean.width, height = blocks_[0].mean.height;
  Supersampled out{
      .spp = spp, .mean = Image(width, height, 4), .standard_error = Image(width, height, 3), .halves = {}};
  Image first(width, height, 4), second(width, height, 4);
  for (std::size_t i = 0; i < out.mean.texel_count(); ++i) {
    std::array<Pixel, block_count> blocks;
    std::ranges::transform(blocks_, blocks.begin(), [&](const Block& block) { return pixel_of(block.mean, i); });
    double covered = 0;
    for (const Block& block : blocks_) covered += block.covered.texels[i];
    const auto coverage = static_cast<float>(covered / spp);
    const Pixel even = merged(blocks[0], blocks[1]), odd = merged(blocks[2], blocks[3]);
    const Pixel all = merged(even, odd);
    set(first, i, even, coverage);
    set(second, i, odd, coverage);
    set(out.mean, i, all, coverage);
    if (all.count <= 0.0) continue;
    const glm::dvec3 variance = variance_of(blocks, all);
    for (int c = 0; c < 3; ++c)
      out.standard_error.texels[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(std::sqrt(variance[c]));
  }
  if (blocks_[2].samples > 0.0) out.halves.emplace(std::move(first), std::move(second));
  return out;
}

}  // namespace footprint
