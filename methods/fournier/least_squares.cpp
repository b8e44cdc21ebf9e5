// The library's Levenberg-Marquardt takes a matrix and a vector. An isometry of the residual's space does not change
// its steps. Therefore it receives coordinates in an orthonormal basis of the span of J: L^T of G = L L^T and L^{-1} c,
// with G = J^T J and c = J^T r, and the length of the residual outside of that span.
#include "methods/fournier/least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/LevenbergMarquardt>

namespace footprint::fournier {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double ridge = 1e-10;  // relative; keeps G regular if lobes coincide or have no weight

class Residual : public Eigen::DenseFunctor<double> {
 public:
  Residual(const std::function<Squares(const Vector&)>& squares_at, double negligible, Eigen::Index size)
      : DenseFunctor(static_cast<int>(size), static_cast<int>(size) + 1),
        squares_at_(&squares_at),
        negligible_(negligible) {}

  int operator()(const Vector& x, Vector& residual) {
    const Squares at = (*squares_at_)(x);
    const Vector scale = at.gram.diagonal().cwiseMax(1e-300).cwiseSqrt();
    Matrix scaled = scale.cwiseInverse().asDiagonal() * at.gram * scale.cwiseInverse().asDiagonal();
    scaled.diagonal().setConstant(1.0 + ridge);
    const Eigen::LLT<Matrix> factor(scaled);
    if (factor.info() != Eigen::Success) return -1;
    const Eigen::Index n = x.size();
    jacobian_.setZero(n + 1, n);
    const Matrix upper = factor.matrixU();
    jacobian_.topRows(n) = upper * scale.asDiagonal();
    residual.resize(n + 1);
    residual.head(n) = factor.matrixL().solve(at.gradient.cwiseQuotient(scale));
    residual[n] = std::sqrt(std::max(at.q - residual.head(n).squaredNorm(), 0.0) + negligible_);
    x_ = x;
    return 0;
  }

  // The library requests derivatives at the accepted point, which may not be the last that it tried.
  int df(const Vector& x, Matrix& jacobian) {
    if (x_.size() != x.size() || x_ != x) {
      Vector residual;
      if ((*this)(x, residual) < 0) return -1;
    }
    jacobian = jacobian_;
    return 0;
  }

 private:
  const std::function<Squares(const Vector&)>* squares_at_;
  double negligible_;
  Vector x_;
  Matrix jacobian_;
};

}  // namespace

bool minimise(const std::function<Squares(const Vector&)>& squares_at, const LeastSquaresSettings& settings,
              Vector& x) {
  Residual residual(squares_at, settings.negligible, x.size());
  Eigen::LevenbergMarquardt<Residual> solver(residual);
  solver.setFtol(settings.tolerance);
  solver.setXtol(settings.tolerance);
  solver.setMaxfev(settings.most_evaluations);
  const Eigen::LevenbergMarquardtSpace::Status status = solver.minimize(x);
  using enum Eigen::LevenbergMarquardtSpace::Status;
  return status != TooManyFunctionEvaluation && status != UserAsked && status != ImproperInputParameters;
}

}  // namespace footprint::fournier
