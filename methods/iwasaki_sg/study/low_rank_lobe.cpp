// Decomposes the matrix's Gram matrix, whose eigenvectors are the right singular vectors.
#include "methods/iwasaki_sg/study/low_rank_lobe.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::iwasaki_sg {
namespace {

constexpr std::size_t most_rows = 16'384;

// The densities at all normals for one half vector.
Eigen::VectorXd densities(const Lobe& lobe, const std::vector<glm::dvec3>& normals, const glm::dvec3& h) {
  Eigen::VectorXd row(static_cast<Eigen::Index>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i)
    row[static_cast<Eigen::Index>(i)] = lobe_density(lobe, one_minus_dot(normals[i], h));
  return row;
}

// Rows at equal distances of all pairs of directions.
Eigen::MatrixXd some_rows(const Lobe& lobe, const std::vector<glm::dvec3>& normals, int side) {
  const std::vector<glm::dvec3> directions = direction_grid(side);
  const std::size_t pairs = directions.size() * directions.size(), count = std::min(pairs, most_rows);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(normals.size()), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t pair = i * pairs / count;
    const glm::dvec3 sum = directions[pair / directions.size()] + directions[pair % directions.size()];
    rows.col(static_cast<Eigen::Index>(i)) = densities(lobe, normals, glm::normalize(sum));
  }
  return rows;
}

}  // namespace

LowRankLobe::LowRankLobe(const Lobe& lobe, const LowRank& sizes)
    : lobe_(lobe), side_(sizes.normals), normals_(direction_grid(sizes.normals)) {
  const Eigen::MatrixXd rows = some_rows(lobe, normals_, sizes.side);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(rows * rows.transpose());
  vectors_ = solver.eigenvectors().rightCols(std::min<Eigen::Index>(sizes.values, rows.rows()));
}

Eigen::VectorXd LowRankLobe::row(const glm::dvec3& h) const {
  return vectors_.transpose() * densities(lobe_, normals_, h);
}

double LowRankLobe::density(const Eigen::VectorXd& row, const glm::dvec3& normal) const {
  const GridCells around = cells_around(normal, side_);
  double sum = 0.0;
  for (std::size_t i = 0; i < around.cells.size(); ++i)
    sum += around.weights.at(i) * vectors_.row(static_cast<Eigen::Index>(around.cells.at(i))).dot(row);
  return sum;
}

std::size_t LowRankLobe::byte_count(const LowRank& sizes) {
  const auto directions = static_cast<std::size_t>(sizes.side) * static_cast<std::size_t>(sizes.side);
  const auto normals = static_cast<std::size_t>(sizes.normals) * static_cast<std::size_t>(sizes.normals);
  return (directions * (directions + 1) / 2 + normals) * static_cast<std::size_t>(sizes.values) * sizeof(float);
}

}  // namespace footprint::iwasaki_sg
