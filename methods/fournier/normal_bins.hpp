// The normals of a texel, gathered level by level: few enough to fit peaks to, and no worse for it.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/fournier/peaks.hpp"

namespace footprint::fournier {

/// Cells of the sphere, squares of one area on Lambert's disc. Normals of one cell are told by their moments. An edge
/// of the base lobe's own deviation leaves an error of fourth order; below 1/16 it stops, and lobes narrower than that
/// are told in the distribution of normals under a texel by cells of a slope variance of 1/3072, an exponent of about
/// 3000.
class NormalCells {
 public:
  explicit NormalCells(double base_variance);

  [[nodiscard]] std::uint32_t cell_of(const Eigen::Vector3d& normal) const;

 private:
  double cells_per_unit_;
  std::uint32_t cells_per_edge_;
};

struct NormalBin {
  std::uint32_t cell = 0;
  Moments moments;
};

/// Sorted by cell, each cell once.
using NormalBins = std::vector<NormalBin>;

/// Makes one bin of all those of a cell.
void unite_cells(NormalBins& bins);

/// What the peaks are fitted to.
[[nodiscard]] std::vector<Peak> target_of(const NormalBins& bins);

}  // namespace footprint::fournier
