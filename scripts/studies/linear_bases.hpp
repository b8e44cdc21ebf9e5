// How well the rows of a matrix can be represented by sums of a few functions, the same for all rows: with the best
// functions there are, and with functions and coefficients that are not negative.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace footprint {

/// The best linear bases of the rows of a matrix, of any number of terms: the right singular vectors (Eckart and Young
/// 1936). No basis of as many terms has a smaller sum of squared distances.
class BestBases {
 public:
  /// rows: n x m, finite. Takes time n^2 (m + n).
  explicit BestBases(const Eigen::MatrixXd& rows);

  /// The n singular values that rows can have, greatest first.
  [[nodiscard]] const Eigen::VectorXd& singular_values() const { return singular_values_; }

  /// The distance of each row from the span of the best `terms` >= 0 functions, to 1e-7 of the row's norm.
  [[nodiscard]] Eigen::VectorXd distances(Eigen::Index terms) const;

 private:
  Eigen::VectorXd squares_;  // of the rows
  Eigen::VectorXd singular_values_;
  Eigen::MatrixXd left_;  // singular vectors, one per column
};

/// The distance of each row from a sum of `terms` >= 1 non-negative functions with non-negative coefficients, after
/// `rounds` of alternating least squares, one term after the other (HALS, Cichocki and Phan 2009), from rows drawn by
/// `seed`. An upper bound: there may be better functions. rows: n x m, not negative.
[[nodiscard]] Eigen::VectorXf nonnegative_distances(const Eigen::MatrixXf& rows, Eigen::Index terms, int rounds,
                                                    std::uint64_t seed);

}  // namespace footprint
