// The eigenvectors of the rows' inner products; alternating non-negative least squares.
#include "scripts/studies/linear_bases.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>

namespace footprint {
namespace {

constexpr int last_rounds = 20;  // of the coefficients alone
constexpr float least = 1e-12F;  // of a term's square

// Improves each column of `factor` in turn, the others fixed, so that |rows - factor other| falls and factor >= 0.
// products: rows other^T; gram: other other^T.
void improve(Eigen::MatrixXf& factor, const Eigen::MatrixXf& products, const Eigen::MatrixXf& gram) {
  for (Eigen::Index r = 0; r < factor.cols(); ++r) {
    const Eigen::VectorXf step = (products.col(r) - factor * gram.col(r)) / std::max(gram(r, r), least);
    factor.col(r) = (factor.col(r) + step).cwiseMax(0.0F);
  }
}

}  // namespace

BestBases::BestBases(const Eigen::MatrixXd& rows) : squares_(rows.rowwise().squaredNorm()) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(rows.rows(), rows.rows());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(rows);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  singular_values_ = solver.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt();
  left_ = solver.eigenvectors().rowwise().reverse();
}

Eigen::VectorXd BestBases::distances(Eigen::Index terms) const {
  Eigen::VectorXd left = squares_;
  for (Eigen::Index r = 0; r < std::min(terms, left_.cols()); ++r)
    left -= (singular_values_[r] * left_.col(r)).cwiseAbs2();
  return left.cwiseMax(0.0).cwiseSqrt();
}

Eigen::VectorXf nonnegative_distances(const Eigen::MatrixXf& rows, Eigen::Index terms, int rounds, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Eigen::MatrixXf functions(rows.cols(), terms);  // one per column
  const auto any_row = [&] { return static_cast<Eigen::Index>(random() % static_cast<std::uint64_t>(rows.rows())); };
  // The mean of two rows: no function starts with zeros that it could only lose slowly.
  for (Eigen::Index r = 0; r < terms; ++r)
    functions.col(r) = 0.5F * (rows.row(any_row()) + rows.row(any_row())).transpose();
  Eigen::MatrixXf coefficients = Eigen::MatrixXf::Constant(rows.rows(), terms, 1.0F / static_cast<float>(terms));
  const auto fit_coefficients = [&](int times) {
    const Eigen::MatrixXf products = rows * functions;
    const Eigen::MatrixXf gram = functions.transpose() * functions;
    for (int i = 0; i < times; ++i) improve(coefficients, products, gram);
  };
  for (int round = 0; round < rounds; ++round) {
    fit_coefficients(1);
    improve(functions, rows.transpose() * coefficients, coefficients.transpose() * coefficients);
  }
  fit_coefficients(last_rounds);
  return (rows - coefficients * functions.transpose()).rowwise().norm();
}

}  // namespace footprint
