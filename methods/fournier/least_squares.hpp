// Levenberg-Marquardt over residuals that are functions, of which only inner products are known.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace footprint::fournier {

/// The squared norm of a residual r at one point, and the inner products of its derivatives J.
struct Squares {
  double q = 0.0;            ///< |r|^2
  Eigen::VectorXd gradient;  ///< J^T r
  Eigen::MatrixXd gram;      ///< J^T J
};

/// Where Levenberg-Marquardt ends.
struct LeastSquaresSettings {
  double tolerance = 1e-3;  ///< relative change of q or of the parameters at convergence
  int most_evaluations = 100;
  double negligible = 0.0;  ///< added to q, so that smaller values count as none
};

/// Moves `x` to the nearest minimum of `squares_at(x).q`; never to a greater value. Returns whether it converged.
[[nodiscard]] bool minimise(const std::function<Squares(const Eigen::VectorXd&)>& squares_at,
                            const LeastSquaresSettings& settings, Eigen::VectorXd& x);

}  // namespace footprint::fournier
