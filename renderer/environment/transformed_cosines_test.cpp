// Fits of reflected lobes against the lobes themselves, summed over directions of light.
#include "renderer/environment/transformed_cosines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace footprint {
namespace {

using std::numbers::pi;

constexpr ReflectedLobeKind ggx_smith{NormalDistribution::ggx, GeometryTerm::smith, true};
constexpr ReflectedLobeKind beckmann_smith{NormalDistribution::beckmann, GeometryTerm::smith, false};
constexpr ReflectedLobeKind ward{NormalDistribution::beckmann, GeometryTerm::ward, false};
constexpr ReflectedLobeKind phong_bare{NormalDistribution::blinn_phong, GeometryTerm::none, false};

// G2 / (4 n.v) (Heitz 2014, equations 72 and 99), with the exact Lambda of each distribution.
double smith(NormalDistribution distribution, double alpha, double nl, double nv) {
  const auto lambda = [&](double c) {
    const double a = c / (alpha * std::sqrt(std::max(1.0 - c * c, 1e-12)));
    if (distribution == NormalDistribution::ggx) return 0.5 * (std::sqrt(1.0 + 1.0 / (a * a)) - 1.0);
    return 0.5 * (std::erf(a) - 1.0) + std::exp(-a * a) / (2.0 * a * std::sqrt(pi));
  };
  return 0.25 / ((1.0 + lambda(nv) + lambda(nl)) * nv);
}

// Density times geometry factor, without constants shared with the fit.
double reflected(const ReflectedLobeKind& kind, double alpha, const glm::dvec3& wi, const glm::dvec3& wo) {
  const glm::dvec3 h = glm::normalize(wi + wo);
  const double c2 = h.z * h.z, tan2 = 1.0 / c2 - 1.0, a2 = alpha * alpha;
  switch (kind.distribution) {
    case NormalDistribution::ggx:
      return 1.0 / (pi * a2 * c2 * c2 * std::pow(1.0 + tan2 / a2, 2.0)) * smith(kind.distribution, alpha, wi.z, wo.z);
    case NormalDistribution::beckmann:
      return std::exp(-tan2 / a2) / (pi * a2 * c2 * c2) *
             (kind == ward ? wi.z / (4.0 * std::pow(glm::dot(wo, h), 2.0))
                           : smith(kind.distribution, alpha, wi.z, wo.z));
    default:
      return 1.0 / (pi * a2) * std::pow(h.z, 2.0 / a2 - 2.0);  // the exponent s of alpha, (s + 2) / 2 pi
  }
}

glm::dvec3 viewer(double angle) { return {-std::sin(angle), 0.0, std::cos(angle)}; }

// Sums over normals of equal share of GGX's visible area, above the plane; `widening` spreads them over more
// directions.
void over_directions(double angle, double alpha, double widening,
                     const std::function<void(const glm::dvec3&, double)>& add) {
  constexpr int rings = 400, sectors = 400;
  const glm::dvec3 wo = viewer(angle);
  const double a2 = std::pow(widening * alpha, 2.0);
  for (int i = 0; i < rings; ++i) {
    const double u = (i + 0.5) / rings, tan2 = a2 * u / (1.0 - u), c = 1.0 / std::sqrt(1.0 + tan2);
    for (int j = 0; j < sectors; ++j) {
      const double azimuth = 2.0 * pi * (j + 0.5) / sectors, sine = c * std::sqrt(tan2);
      const glm::dvec3 h(sine * std::cos(azimuth), sine * std::sin(azimuth), c);
      const double oh = glm::dot(h, wo), density = 1.0 / (pi * a2 * std::pow(c * (1.0 + tan2 / a2), 2.0) * c);
      const glm::dvec3 wi = 2.0 * oh * h - wo;
      if (oh > 0.0 && wi.z > 0.0) add(wi, 4.0 * oh / (density * rings * sectors));
    }
  }
}

TransformedCosine fit(const ReflectedLobeKind& kind, double angle, double alpha) {
  return fit_transformed_cosine(kind, angle, alpha, {.along = 2.0 * alpha, .across = 2.0 * alpha});
}

// Half of the integral of the absolute difference: no light, of any outline, may differ by a larger share of the
// energy.
double total_variation(const ReflectedLobeKind& kind, double angle, double alpha) {
  const TransformedCosine cosine = fit(kind, angle, alpha);
  double energy = 0.0, difference = 0.0;
  const auto value = [&](const glm::dvec3& wi) { return reflected(kind, alpha, wi, viewer(angle)); };
  over_directions(angle, alpha, 2.0, [&](const glm::dvec3& wi, double weight) { energy += value(wi) * weight; });
  over_directions(angle, alpha, 2.0, [&](const glm::dvec3& wi, double weight) {
    difference += 0.5 * std::abs(value(wi) / energy - transformed_density(cosine, wi)) * weight;
  });
  return difference;
}

TEST(TransformedCosines, HaveTheEnergyOfTheLobe) {
  for (const ReflectedLobeKind& kind : {ggx_smith, beckmann_smith, ward, phong_bare}) {
    for (const double alpha : {0.05, 0.2, 0.7}) {
      for (const double angle : {0.0, 0.8, 1.4}) {
        double energy = 0.0, schlick = 0.0;
        over_directions(angle, alpha, 1.5, [&](const glm::dvec3& wi, double weight) {
          const double value = reflected(kind, alpha, wi, viewer(angle)) * weight;
          energy += value;
          schlick += value * std::pow(1.0 - glm::dot(glm::normalize(wi + viewer(angle)), wi), 5.0);
        });
        const TransformedCosine cosine = fit(kind, angle, alpha);
        EXPECT_NEAR(cosine.energy, energy, 0.01 * energy) << alpha << ", " << angle;
        EXPECT_NEAR(cosine.schlick, schlick, 0.01 * energy) << alpha << ", " << angle;
      }
    }
  }
}

TEST(TransformedCosines, IntegrateToOneAboveThePlane) {
  for (const double alpha : {0.05, 0.3, 1.0}) {
    for (const double angle : {0.0, 0.7, 1.3}) {
      const TransformedCosine cosine = fit(ggx_smith, angle, alpha);
      double sum = 0.0;
      over_directions(angle, alpha, 1.5,
                      [&](const glm::dvec3& wi, double weight) { sum += transformed_density(cosine, wi) * weight; });
      EXPECT_NEAR(sum, 1.0, 0.01) << alpha << ", " << angle;
      EXPECT_EQ(transformed_density(cosine, {0.0, 0.6, -0.8}), 0.0);
    }
  }
}

// The errors that docs/explanation/area-lights.md states.
TEST(TransformedCosines, DifferFromTheLobeByTheStatedErrors) {
  const auto expect_error = [](const ReflectedLobeKind& kind, double alpha, double degrees, double stated) {
    EXPECT_NEAR(total_variation(kind, degrees * pi / 180.0, alpha), stated, 0.001 + 0.05 * stated)
        << alpha << ", " << degrees;
  };
  expect_error(ggx_smith, 0.01, 45.0, 0.002);
  expect_error(ggx_smith, 0.13, 45.0, 0.028);
  expect_error(ggx_smith, 0.13, 75.0, 0.137);
  expect_error(ggx_smith, 0.25, 60.0, 0.089);
  expect_error(ggx_smith, 0.5, 85.0, 0.125);
  expect_error(ggx_smith, 1.0, 45.0, 0.020);
  expect_error(beckmann_smith, 0.01, 45.0, 0.087);
  expect_error(beckmann_smith, 0.13, 75.0, 0.108);
  expect_error(beckmann_smith, 0.5, 45.0, 0.021);
  expect_error(phong_bare, 0.13, 60.0, 0.075);
  expect_error(phong_bare, 1.0, 45.0, 0.127);
}

TEST(TransformedCosines, TableHasTheFits) {
  const std::vector<Image> table = make_cosine_table(ggx_smith);
  ASSERT_EQ(table.size(), 2U);
  const int columns = table[0].width, rows = table[0].height;
  EXPECT_EQ(cosine_angle(0, columns), 0.0);
  EXPECT_NEAR(cosine_angle(columns - 1, columns), 2.0 * pi / 3.0, 1e-12);
  EXPECT_NEAR(cosine_alpha(0, rows), smallest_alpha, 1e-12);
  EXPECT_NEAR(cosine_alpha(rows - 1, rows), 1.0, 1e-12);
  for (const auto& [x, y] : {std::pair(5, 20), std::pair(20, 25)}) {
    const double angle = cosine_angle(x, columns), alpha = cosine_alpha(y, rows);
    const TransformedCosine cosine = fit(ggx_smith, angle, alpha);
    const auto shape = table[0].at(x, y), energies = table[1].at(x, y);
    EXPECT_NEAR(angle + shape[0], cosine.angle, 1e-5);
    EXPECT_NEAR(alpha * std::exp(shape[1]), cosine.along, 0.01 * cosine.along);
    EXPECT_NEAR(alpha * std::exp(shape[2]), cosine.across, 0.01 * cosine.across);
    EXPECT_NEAR(alpha * shape[3], cosine.shear, 0.01);
    EXPECT_NEAR(energies[0], cosine.energy, 1e-5);
    EXPECT_NEAR(energies[1], cosine.schlick, 1e-5);
  }
  for (const Image& layer : table)
    EXPECT_TRUE(std::ranges::all_of(layer.texels, [](float value) { return std::isfinite(value); }));
}

}  // namespace
}  // namespace footprint
