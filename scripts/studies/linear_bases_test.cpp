// Bases of matrices whose ranks are known, against a singular value decomposition that shares no code with them.
#include "scripts/studies/linear_bases.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <random>

namespace footprint {
namespace {

// Values of 0 to 1, or of -1 to 1.
Eigen::MatrixXd noise(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed, bool is_signed) {
  std::mt19937_64 random(seed);
  const auto value = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return is_signed ? 2.0 * value() - 1.0 : value(); });
}

TEST(LinearBases, LeaveTheDiscardedSingularValues) {
  const Eigen::MatrixXd rows = noise(12, 40, 1, true);
  const Eigen::JacobiSVD<Eigen::MatrixXd> exact(rows, Eigen::ComputeThinV);
  const BestBases bases(rows);
  EXPECT_LT((bases.singular_values() - exact.singularValues()).norm(), 1e-10);
  for (Eigen::Index terms = 0; terms <= 12; ++terms) {
    const Eigen::MatrixXd basis = exact.matrixV().leftCols(terms);
    const Eigen::VectorXd expected = (rows - rows * basis * basis.transpose()).rowwise().norm();
    EXPECT_LT((bases.distances(terms) - expected).norm(), 1e-6);
    EXPECT_NEAR(bases.distances(terms).squaredNorm(), exact.singularValues().tail(12 - terms).squaredNorm(), 1e-9);
    const Eigen::MatrixXd other = Eigen::MatrixXd(noise(40, std::max<Eigen::Index>(terms, 1), 9, true));
    const Eigen::MatrixXd turned = other.householderQr().householderQ() * Eigen::MatrixXd::Identity(40, terms);
    EXPECT_LE(bases.distances(terms).norm(), (rows - rows * turned * turned.transpose()).norm() + 1e-9);
  }
}

TEST(LinearBases, LeaveNothingFromTheRankOn) {
  const BestBases bases(noise(30, 5, 2, true) * noise(5, 80, 3, true));
  EXPECT_LT(bases.distances(5).norm(), 1e-6 * bases.distances(0).norm());
  EXPECT_GT(bases.distances(4).norm(), 1e-2 * bases.distances(0).norm()) << "the gate";
}

TEST(LinearBases, NonNegativeFunctionsAreFoundWhereTheyExist) {
  const Eigen::MatrixXd rows = noise(30, 3, 4, false) * noise(3, 60, 5, false);
  const Eigen::MatrixXf single = rows.cast<float>();
  EXPECT_LT(nonnegative_distances(single, 3, 3000, 1).norm(), 5e-3F * single.norm());
  EXPECT_GT(nonnegative_distances(single, 2, 3000, 1).norm(), 2e-2F * single.norm()) << "the gate";
  EXPECT_EQ(nonnegative_distances(single, 3, 20, 1), nonnegative_distances(single, 3, 20, 1));
}

// The incidences of a square's corners and edges: rank 3, but four non-negative terms are needed (Cohen and Rothblum
// 1993).
TEST(LinearBases, NonNegativeFunctionsCannotDoWhatOthersCan) {
  Eigen::MatrixXd square(4, 4);
  square << 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 1;
  EXPECT_LT(BestBases(square).distances(3).norm(), 1e-6);
  for (const std::uint64_t seed : {1U, 2U, 3U})
    EXPECT_GT(nonnegative_distances(square.cast<float>(), 3, 500, seed).norm(), 0.3F);
  const BestBases bases(noise(20, 50, 6, false));
  const Eigen::MatrixXf single = noise(20, 50, 6, false).cast<float>();
  for (const Eigen::Index terms : {1, 4, 8})
    EXPECT_GE(nonnegative_distances(single, terms, 50, 1).norm(), bases.distances(terms).norm() - 1e-4);
}

}  // namespace
}  // namespace footprint
