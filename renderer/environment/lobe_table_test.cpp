// The table of GGX lobes against sums over all of their normals, by equal parts of D (n.h) and not of what is visible.
#include "renderer/environment/radiance_stack.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;

struct Reflected {
  double rest = 0, schlick = 0;
  glm::dvec2 direction{0.0};  // weighted by energy: across the axis towards the view, and along it
};

// G2 / (4 n.v) as two Lambdas (Heitz 2014).
double smith(double alpha, double nl, double nv) {
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 / (c * c) - 1.0)) - 1.0); };
  return 0.25 / ((1.0 + lambda(nv) + lambda(nl)) * nv);
}

// `base` is the alpha of Smith's factor, below 0 for none.
Reflected sum_over_normals(double c, double alpha, double base) {
  constexpr int rings = 600, sectors = 300;
  const glm::dvec3 wo(std::sqrt(1.0 - c * c), 0.0, c);
  Reflected sum;
  for (int i = 0; i < rings; ++i) {
    const double u = (i + 0.5) / rings;
    const double cosine = 1.0 / std::sqrt(1.0 + alpha * alpha * u / (1.0 - u)), sine = std::sqrt(1.0 - cosine * cosine);
    for (int j = 0; j < sectors; ++j) {
      const double azimuth = 2.0 * pi * (j + 0.5) / sectors;
      const glm::dvec3 h(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
      const double oh = glm::dot(h, wo);
      const glm::dvec3 wi = 2.0 * oh * h - wo;
      if (oh <= 0.0 || wi.z <= 0.0) continue;
      const double energy = 4.0 * oh / cosine * (base >= 0.0 ? smith(base, wi.z, c) : 1.0) / (rings * sectors);
      const double x = std::pow(1.0 - oh, 5.0);
      sum.rest += energy * (1.0 - x);
      sum.schlick += energy * x;
      sum.direction += energy * glm::dvec2(wi.x, wi.z);
    }
  }
  return sum;
}

// Both parts of a texel together; a part's mean direction has the length of its vMF lobe's mean cosine.
Reflected sum_of_parts(const std::vector<Image>& table, std::size_t geometry, int x, int y) {
  Reflected sum;
  const double c = lobe_view(x, table[0].width), alpha = lobe_width(y, table[0].height);
  for (std::size_t part = 0; part < 2; ++part) {
    const auto texel = table[2 * geometry + part].at(x, y);
    const double kappa = std::exp2(texel[3]) / (alpha * alpha);
    const double energy = static_cast<double>(texel[0]) + texel[1];
    const double angle = texel[2] - std::acos(c);
    sum.rest += texel[0];
    sum.schlick += texel[1];
    sum.direction += energy * (1.0 / std::tanh(kappa) - 1.0 / kappa) * glm::dvec2(std::sin(angle), std::cos(angle));
  }
  return sum;
}

TEST(LobeTable, HasWhatTheSumOverNormalsSays) {
  const std::vector<Image> table = make_lobe_table();
  const int columns = table[0].width, rows = table[0].height;
  for (const int geometry : {0, 2, smith_steps, no_geometry}) {
    for (const int x : {columns / 2 + 4, columns / 2 + 10, columns - 12, columns - 1}) {
      for (const int y : {6, 15, 23, rows - 1}) {
        const double alpha = lobe_width(y, rows);
        const double base = geometry == no_geometry ? -1.0 : alpha * geometry / smith_steps;
        const Reflected expected = sum_over_normals(lobe_view(x, columns), alpha, base);
        const Reflected tabulated = sum_of_parts(table, static_cast<std::size_t>(geometry), x, y);
        const double most = 0.015 * (expected.rest + expected.schlick);
        EXPECT_NEAR(tabulated.rest, expected.rest, most) << geometry << ", " << x << ", " << y;
        EXPECT_NEAR(tabulated.schlick, expected.schlick, most) << geometry << ", " << x << ", " << y;
        if (y > 15) continue;  // wider lobes are near a hemisphere's sharpness, below which the table has none
        EXPECT_LT(glm::distance(tabulated.direction, expected.direction), 2.0 * most)
            << geometry << ", " << x << ", " << y;
      }
    }
  }
}

TEST(LobeTable, SpacesViewsAndWidthsFromEndToEnd) {
  EXPECT_EQ(lobe_view(0, 64), -1.0);
  EXPECT_EQ(lobe_view(63, 64), 1.0);
  EXPECT_LT(lobe_view(32, 64), 1e-3);
  EXPECT_NEAR(lobe_width(0, 32), 1e-3, 1e-12);
  EXPECT_NEAR(lobe_width(31, 32), 1.0, 1e-12);
}

}  // namespace
}  // namespace footprint
