// The normals that a texel of a mip level covers, as weighted points of the unit disc.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint::tan_gmm {

/// Gaussians of a mixture at most.
inline constexpr std::size_t most_components = 8;

/// Weighted points (n_x, n_y) of the unit disc. A point may stand for several that lie close together: `spread` is
/// then their mean squared distance from it (both axes together), else 0.
struct Samples {
  std::vector<float> x, y, spread, weight;  ///< of one size; weight > 0, in texels of the finest level

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] double total_weight() const;
  void add(float x_, float y_, float spread_, float weight_);
  void append(const Samples& others);
  void clear();
  void resize(std::size_t size);  ///< new ones are all 0 until they are set
};

/// A normal map projected to the disc: normals renormalised, those that are invalid (weight 0, shorter than 1e-3, not
/// finite) left out, those that point below the surface moved to the rim.
class NormalField {
 public:
  /// `normals` has 4 channels: normal, weight.
  explicit NormalField(const Image& normals);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// The normals under texel (column, row) of a level of level_width x level_height texels, in place of what `out`
  /// holds. The level spans the whole map; a fine texel that the border of a coarse one cuts counts by its share.
  void gather(int level_width, int level_height, int column, int row, Samples& out) const;

  /// The part of that texel's area that valid normals cover, given its samples: 0 to 1.
  [[nodiscard]] double coverage(int level_width, int level_height, const Samples& samples) const;

 private:
  int width_, height_;
  std::vector<float> x_, y_, weight_;
};

/// Samples that repeat the one before them become one with their weight.
void merge_repeats(Samples& samples);

/// Pools the samples of large texels in the cells of a grid over the disc, each to its centroid and spread, so that
/// first and second moments are kept exactly. Cells are 1/128 wide.
class CellPool {
 public:
  /// Texels of fewer samples are left as they are.
  static constexpr std::size_t fewest = 256;

  CellPool();
  void pool(Samples& samples);

 private:
  struct Cell {
    double weight = 0, x = 0, y = 0, square = 0;  // sums; x, y and square from the cell's centre
  };
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> touched_;  // in the order of the first sample
};

/// The normals of a map by tiles of 16 x 16 texels, each pooled once: levels whose texels hold whole tiles start from
/// what is left of them.
class PooledTiles {
 public:
  static constexpr int side = 16;

  explicit PooledTiles(const NormalField& normals);

  /// As NormalField::gather, but for the pooling.
  void gather(int level_width, int level_height, int column, int row, Samples& out) const;

 private:
  /// Texels of a level of this size are rectangles of whole tiles.
  [[nodiscard]] bool fit(int level_width, int level_height) const;

  const NormalField* normals_;
  int across_, down_;  // tiles
  std::vector<Samples> tiles_;
};

/// log(alpha g) = constant - factor |n - mu|^2 of each component, with its mean mu.
struct Terms {
  std::array<float, most_components> x{}, y{}, constant{}, factor{};
};

/// Sums over the samples of weight * responsibility, alone and times the distance from the component's mean: along each
/// axis, and squared with the sample's spread.
struct Sums {
  std::array<double, most_components> weight{}, dx{}, dy{}, square{};
  double log_likelihood = 0;
};

/// Over all samples, for the first `components` (2 to most_components) of `terms`. Responsibilities in 32 bits by
/// log-sum-exp, sums of 256 samples in 32 bits, then in 64. The last bits depend on the processor's vector
/// instructions, never on the number of threads.
[[nodiscard]] Sums sums_over(const Samples& samples, const Terms& terms, std::size_t components);

}  // namespace footprint::tan_gmm
