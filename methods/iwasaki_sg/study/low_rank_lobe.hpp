// The base lobe as Wu et al. 2011 store it: a matrix over pairs of directions and normals, compressed to few singular
// values.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/lobes/lobe.hpp"

namespace footprint::iwasaki_sg {

/// The sizes of the matrix.
struct LowRank {
  int side = 24;     ///< of the grids of directions to the light and to the viewer
  int normals = 40;  ///< side of the grid of normals
  int values = 70;   ///< singular values that are stored
};

/// The density of a lobe at the normals of the grid, projected to the first right singular vectors of the matrix. Wu et
/// al. approximate these by random projections (Vempala 2004), so their error is at least that of this form.
class LowRankLobe {
 public:
  /// The matrix has a row per pair of directions, of which 16384 at equal distances are decomposed.
  LowRankLobe(const Lobe& lobe, const LowRank& sizes);

  /// The coefficients of a row, whose half vector is `h`.
  [[nodiscard]] Eigen::VectorXd row(const glm::dvec3& h) const;

  /// The density at a normal, interpolated between the grid's; below 0 where the vectors that are left out would lift
  /// it.
  [[nodiscard]] double density(const Eigen::VectorXd& row, const glm::dvec3& normal) const;

  /// The bytes of the 32-bit floats of both factors. A pair and its reverse, which are equal by reciprocity, are one
  /// row.
  [[nodiscard]] static std::size_t byte_count(const LowRank& sizes);

 private:
  Lobe lobe_;
  int side_;                         // of the grid of normals
  std::vector<glm::dvec3> normals_;  // of that grid
  Eigen::MatrixXd vectors_;          // right singular vectors, a column each
};

}  // namespace footprint::iwasaki_sg
