// The normals under a texel of a mip level, as weighted points of the unit disc, and the sums of the E-step over them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint::tan_gmm {

/// The most Gaussians of a mixture.
inline constexpr std::size_t most_components = 8;

/// Weighted points (n_x, n_y) of the unit disc. A point may represent several close ones: `spread` is their mean
/// squared distance from it, both axes together, or 0.
struct Samples {
  std::vector<float> x, y, spread, weight;  ///< of equal size; weight > 0, in texels of the finest level

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] glm::vec2 at(std::size_t i) const { return {x[i], y[i]}; }
  [[nodiscard]] double total_weight() const;
  void add(float x_, float y_, float spread_, float weight_);
  void append(const Samples& others);
  void clear();
  void resize(std::size_t size);  ///< new ones are 0
};

/// A normal map projected to the disc. Normals are renormalised, invalid ones (weight 0, shorter than 1e-3, not finite)
/// are left out, and those below the surface are moved to the rim.
class NormalField {
 public:
  /// `normals` has 4 channels: normal, weight.
  explicit NormalField(const Image& normals);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// Replaces `out` by the normals under texel (column, row) of a level of level_width x level_height texels. The level
  /// spans the whole map; fine texels at the border of a coarse one count by their share.
  void gather(int level_width, int level_height, int column, int row, Samples& out) const;

  /// The share of that texel's area that valid normals cover, given its samples: 0 to 1.
  [[nodiscard]] double coverage(int level_width, int level_height, const Samples& samples) const;

 private:
  int width_, height_;
  std::vector<float> x_, y_, weight_;
};

/// Merges samples that repeat the previous one.
void merge_repeats(Samples& samples);

/// Pools the samples of large texels in the cells of a grid over the disc, each cell to its centroid and spread, which
/// preserves first and second moments exactly. Cells are 1/128 wide.
class CellPool {
 public:
  /// Texels with fewer samples are not pooled.
  static constexpr std::size_t fewest = 256;

  CellPool();
  void pool(Samples& samples);

 private:
  struct Cell {
    double weight = 0, x = 0, y = 0, square = 0;  // sums; x, y and square relative to the cell's centre
  };
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> touched_;  // in the order of the first sample
};

/// The normals of a map in tiles of 16 x 16 texels, pooled once, for levels whose texels consist of whole tiles.
class PooledTiles {
 public:
  static constexpr int side = 16;

  explicit PooledTiles(const NormalField& normals);

  /// Gathers like NormalField::gather, except for the pooling.
  void gather(int level_width, int level_height, int column, int row, Samples& out) const;

 private:
  /// Whether texels of a level of this size are rectangles of whole tiles.
  [[nodiscard]] bool fit(int level_width, int level_height) const;

  const NormalField* normals_;
  int across_, down_;  // tiles
  std::vector<Samples> tiles_;
};

/// The terms of log(alpha g) = constant - factor |n - mu|^2 for each component, with its mean mu.
struct Terms {
  std::array<float, most_components> x{}, y{}, constant{}, factor{};
};

/// Sums over samples of weight * responsibility: alone, times the distance from the component's mean along each axis,
/// and times the squared distance with the sample's spread.
struct Sums {
  std::array<double, most_components> weight{}, dx{}, dy{}, square{};
  double log_likelihood = 0;
};

/// The sums over all samples, for the first `components` (2 to most_components) of `terms`. Responsibilities are in 32
/// bits by log-sum-exp; sums of 256 samples are in 32 bits, their totals in 64. The last bits depend on the processor's
/// vector instructions, but not on the number of threads.
[[nodiscard]] Sums sums_over(const Samples& samples, const Terms& terms, std::size_t components);

}  // namespace footprint::tan_gmm
