// What the blocks of a reference's samples come to: its mean, its two halves, and its standard error.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/supersample.hpp"

namespace footprint {

/// Means of the samples of each of two sequences' two blocks (sample_grid.hpp), pixel by pixel.
class SampleBlocks {
 public:
  explicit SampleBlocks(const glm::ivec2& size);

  /// Takes over a tile of a block of `samples` samples a pixel from the sums that resolve_samples.glsl wrote.
  void add(const gl::RenderTarget& sums, const Tile& tile, int half, int block, double samples);

  [[nodiscard]] Supersampled result(int spp) const;

 private:
  static constexpr std::size_t block_count = 4;
  struct Block {
    Image mean;      // and the number of samples that have a radiance
    Image covered;   // the number of samples that the surface covers, one channel
    double samples;  // a pixel; 0: the block is empty
  };
  std::array<Block, block_count> blocks_;
};

}  // namespace footprint
