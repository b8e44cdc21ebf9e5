// The forms that the paper prints, equation 15 and Algorithm 1, against sums over texels in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/methods/built_map.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr double facet_exponent = 100.0;
constexpr double whole_threshold = 0.95, part_threshold = 0.85;

// Characteristic vectors of the texels in one component of the hemisphere.
struct Component {
  glm::dvec3 sum{0.0};  // over the number of all texels: what a linear mip chain keeps
  double fraction = 0.0;
  [[nodiscard]] glm::dvec3 mean() const { return sum / fraction; }  // equation 10
};

using CellOf = std::function<int(const glm::dvec3&)>;

// The three subdivision levels over all texels.
struct Levels {
  Component whole;
  std::array<Component, 4> coarse;
  std::array<Component, 8> cells;

  Levels(const Image& normals, const CellOf& cell_of) {
    const auto count = static_cast<double>(normals.texel_count());
    const double length = 1.0 - shortfall_twin(facet_exponent + 1.0);
    for (std::size_t i = 0; i < normals.texel_count(); ++i) {
      const float* n = &normals.texels[4 * i];
      if (n[3] == 0.0F) continue;
      const glm::dvec3 axis = glm::normalize(glm::dvec3(n[0], n[1], n[2]));
      const auto cell = static_cast<std::size_t>(cell_of(axis));
      for (Component* component : {&whole, &coarse.at(cell / 2), &cells.at(cell)}) {
        component->sum += length * axis / count;
        component->fraction += 1.0 / count;
      }
    }
  }
};

// Lines 24 and 25 of Algorithm 1.
double compute_shading(const glm::dvec3& r, const glm::dvec3& h) {
  const double size = glm::length(r);
  if (size == 0.0) return 0.0;
  const double kappa = (3.0 * size - size * size * size) / (1.0 - size * size);
  return kappa / (2.0 * std::numbers::pi) * std::exp(kappa * (glm::dot(r / size, h) - 1.0));
}

// Lines 3 to 19 of Algorithm 1, each loop with a variable of its own.
double algorithm1(const Levels& levels, const glm::dvec3& h) {
  if (glm::length(levels.whole.sum) >= whole_threshold) return compute_shading(levels.whole.sum, h);
  double rho = 0.0;
  for (const Component& part : levels.coarse) {
    if (glm::length(part.sum) >= part_threshold) {
      rho += compute_shading(part.sum, h);
    } else if (part.fraction > 0.0) {
      for (std::size_t i = 0; i < 4; ++i) rho += compute_shading(levels.cells.at(i).sum, h);
    }
  }
  return rho;
}

double weighted(const Component& part, const glm::dvec3& h) {
  return part.fraction > 0.0 ? part.fraction * compute_shading(part.mean(), h) : 0.0;
}

// Equation 15 with the components that the thresholds choose, each at the mean of its vectors.
double equation15(const Levels& levels, const glm::dvec3& h) {
  const double covered = levels.whole.fraction;
  if (glm::length(levels.whole.mean()) >= whole_threshold) return weighted(levels.whole, h) / covered;
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Component& part = levels.coarse.at(i);
    if (part.fraction == 0.0) continue;
    sum += glm::length(part.mean()) >= part_threshold
               ? weighted(part, h)
               : weighted(levels.cells.at(2 * i), h) + weighted(levels.cells.at(2 * i + 1), h);
  }
  return sum / covered;
}

int rings(const glm::dvec3& n) {
  return 2 * std::min(static_cast<int>(4.0 * std::hypot(n.x, n.y)), 3) + (n.x >= 0.0 ? 0 : 1);
}

int bands(const glm::dvec3& n) {
  const double latitude = std::asin(n.y) / std::numbers::pi;  // -1/2 to 1/2
  return 2 * std::clamp(static_cast<int>(4.0 * (latitude + 0.5)), 0, 3) + (n.x >= 0.0 ? 0 : 1);
}

int sectors(const glm::dvec3& n) {
  const int sector = std::abs(n.x) >= std::abs(n.y) ? (n.x >= 0.0 ? 0 : 2) : (n.y > 0.0 ? 1 : 3);
  return 2 * sector + (std::hypot(n.x, n.y) >= 0.5 ? 1 : 0);
}

struct Partition {
  Words words;
  CellOf cell_of;
};

std::vector<Partition> partitions() {
  return {{{{"partition", "latitude"}}, rings},
          {{{"partition", "latitude"}, {"pole", "up"}}, bands},
          {{{"partition", "azimuth"}}, sectors}};
}

// Normals that lean little, so that the whole stays together; that lean; that lean to one side; half a map.
std::vector<Image> maps() {
  std::vector<Image> all{random_normals(16, 16, 0.2F, 3), random_normals(16, 16, 0.65F, 12),
                         random_normals(16, 16, 0.95F, 5), random_normals(16, 16, 0.65F, 7)};
  for (std::size_t i = 0; i < all[2].texel_count(); ++i) all[2].texels[4 * i] = std::abs(all[2].texels[4 * i]);
  for (std::size_t i = 0; i < all[3].texel_count(); i += 2) all[3].texels[4 * i + 3] = 0.0F;
  return all;
}

using Sum = double (*)(const Levels&, const glm::dvec3&);

void expect_density(const std::string& variant, Sum sum) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(16, 32);
  for (const Partition& partition : partitions()) {
    Words words = partition.words;
    words["variant"] = variant;
    words["lobe"] = "vmf";
    int index = 0;
    for (const Image& normals : maps()) {
      const Levels levels(normals, partition.cell_of);
      const std::vector<double> got =
          BuiltMap(blinn_phong_square(normals, facet_exponent), words).densities(directions);
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const double truth = sum(levels, directions[i]);
        EXPECT_NEAR(got[i], truth, 2e-4 * (truth + 0.01)) << variant << " " << words["partition"] << " map " << index;
      }
      ++index;
    }
  }
}

TEST(XuPublished, IsEquation15) { expect_density("published", equation15); }

TEST(XuPublished, Algorithm1IsTheListing) { expect_density("algorithm1", algorithm1); }

// Equation 7 lacks the divisor 1 - e^{-2 kappa} of equation 6, which counts where lobes are wide.
TEST(XuPublished, LosesTheEnergyOfEquation7) {
  const Scene scene = blinn_phong_square(constant_normals(4, 4, {0.0F, 0.0F, 1.0F}), 0.5F);
  const auto energy = [&](const std::string& variant) {
    return BuiltMap(scene, {{"variant", variant}, {"lobe", "vmf"}, {"j", "1"}}).energy_over_sphere();
  };
  EXPECT_NEAR(energy("corrected"), 1.0, 1e-3);
  EXPECT_NEAR(energy("published"), 1.0 - std::exp(-3.0), 1e-3);
}

// The table of |r| over kappa: between its entries kappa comes back as that of the chord, beyond its end as the last.
TEST(XuPublished, TableIsOfLengthsOverKappa) {
  const auto length = [](double kappa) { return 1.0 - shortfall_twin(kappa); };
  for (const double kappa : {1.5, 20.25, 512.5, 5000.0}) {
    const double first = std::min(std::floor(kappa), 1022.0), beyond = std::min(kappa, 1023.0) - first;
    const double r = (1.0 - beyond) * length(first) + beyond * length(first + 1.0);
    const double truth = (3.0 * r - r * r * r) / (1.0 - r * r);
    const Scene scene = blinn_phong_square(constant_normals(4, 4, {0.28F, 0.0F, 0.96F}), static_cast<float>(kappa - 1));
    const std::vector<MapLobe> lobes = BuiltMap(scene, {{"conversion", "published"}, {"j", "1"}}).lobes();
    ASSERT_EQ(lobes.size(), 1U);
    EXPECT_NEAR(lobes[0].kappa / truth, 1.0, 1e-3) << kappa;
  }
}

// The listing multiplies the energy: four coarse parts that are not concentrated add four cells each.
TEST(XuPublished, Algorithm1HasTheEnergyOfItsLobes) {
  const Scene scene = blinn_phong_square(random_normals(16, 16, 0.95F, 12), facet_exponent);
  const auto energy = [&](const std::string& j) {
    return BuiltMap(scene, {{"variant", "algorithm1"}, {"lobe", "vmf"}, {"j", j}}).energy_over_sphere();
  };
  EXPECT_GT(energy("adaptive"), 5.0);
  EXPECT_GT(energy("4"), 1.5);
}

}  // namespace
}  // namespace footprint::testing
