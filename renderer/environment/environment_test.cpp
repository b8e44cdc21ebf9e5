// Octahedral maps, prefiltered maps and tables of directions against sums that share no code with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "renderer/core/numbers.hpp"
#include "renderer/environment/radiance_stack.hpp"
#include "renderer/environment/reference_tables.hpp"

namespace footprint {
namespace {

using std::numbers::pi;

std::vector<glm::dvec3> random_directions(int count) {
  std::mt19937_64 random(5);
  std::vector<glm::dvec3> out;
  for (int i = 0; i < count; ++i) {
    const double y = 2.0 * uniform(random) - 1.0;
    const double azimuth = 2.0 * pi * uniform(random);
    out.emplace_back(std::sqrt(1 - y * y) * std::cos(azimuth), y, std::sqrt(1 - y * y) * std::sin(azimuth));
  }
  return out;
}

Environment noisy_environment(int width, int height) {
  std::mt19937_64 random(7);
  Image map(width, height, 3);
  for (float& value : map.texels) value = static_cast<float>(uniform(random));
  map.at(width / 3, height / 4)[0] = 50.0F;  // a lamp
  return {.name = "noise", .radiance = std::make_shared<const Image>(std::move(map)), .rotation = 0.9F};
}

// The mean over a vMF lobe about +y turned to `axis`, by rings of equal share of the lobe.
glm::dvec3 vmf_mean(const Environment& environment, const glm::dvec3& axis, double kappa) {
  constexpr int rings = 200;
  constexpr int sectors = 400;
  const glm::dvec3 helper = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 s = glm::normalize(glm::cross(helper, axis));
  const glm::dvec3 t = glm::cross(axis, s);
  glm::dvec3 sum(0.0);
  for (int i = 0; i < rings; ++i) {
    const double u = (i + 0.5) / rings;
    const double cosine = 1.0 + std::log(u + (1.0 - u) * std::exp(-2.0 * kappa)) / kappa;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    for (int j = 0; j < sectors; ++j) {
      const double a = 2.0 * pi * (j + 0.5) / sectors;
      sum += glm::dvec3(environment_radiance(environment, cosine * axis + sine * (std::cos(a) * s + std::sin(a) * t)));
    }
  }
  return sum / static_cast<double>(rings * sectors);
}

// What linear filtering of a bordered map gives.
glm::dvec3 looked_up(const Image& map, const glm::dvec3& direction) {
  const glm::dvec2 position = octahedral_uv(direction) * static_cast<double>(map.width - 2) + 0.5;
  const int x = static_cast<int>(position.x);
  const int y = static_cast<int>(position.y);
  const glm::dvec2 part = position - glm::dvec2(x, y);
  const auto texel = [&](int i, int j) {
    const auto t = map.at(std::min(i, map.width - 1), std::min(j, map.height - 1));
    return glm::dvec3(t[0], t[1], t[2]);
  };
  return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), part.x),
                  glm::mix(texel(x, y + 1), texel(x + 1, y + 1), part.x), part.y);
}

TEST(Octahedral, GoesThereAndBack) {
  for (const glm::dvec3& d : random_directions(1000))
    EXPECT_LT(glm::length(octahedral_direction(octahedral_uv(d)) - d), 1e-12);
}

TEST(Octahedral, GoesOnAcrossTheEdges) {
  for (const double along : {0.03, 0.4, 0.77}) {
    for (const double out : {1e-4, 1e-3}) {
      for (const auto& [inside, outside] : {std::pair(glm::dvec2(out, along), glm::dvec2(-out, along)),
                                            std::pair(glm::dvec2(1 - out, along), glm::dvec2(1 + out, along)),
                                            std::pair(glm::dvec2(along, out), glm::dvec2(along, -out)),
                                            std::pair(glm::dvec2(along, 1 - out), glm::dvec2(along, 1 + out))}) {
        const glm::dvec3 a = octahedral_direction(inside);
        const glm::dvec3 b = octahedral_direction(outside);
        EXPECT_LT(glm::length(a - b), 20.0 * out);
        EXPECT_GT(glm::length(a - b), 1.0 * out);
      }
    }
  }
}

TEST(Octahedral, StretchIsTheSolidAngle) {
  constexpr double step = 1e-4;
  for (const glm::dvec3& d : random_directions(200)) {
    const glm::dvec2 uv = octahedral_uv(d);
    const glm::dvec3 along_x = octahedral_direction(uv + glm::dvec2(step, 0)) - d;
    const glm::dvec3 along_y = octahedral_direction(uv + glm::dvec2(0, step)) - d;
    const double fold = std::min({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    if (fold < 1e-2) continue;
    EXPECT_NEAR(glm::length(glm::cross(along_x, along_y)) / (step * step) / octahedral_stretch(d), 1.0, 1e-2);
  }
}

TEST(Environment, DirectionsGoThereAndBack) {
  const Environment environment = noisy_environment(8, 4);
  for (const glm::dvec3& d : random_directions(1000)) {
    const glm::dvec2 uv = environment_uv(environment, d);
    EXPECT_LT(glm::length(environment_direction(environment, uv.x, uv.y) - d), 1e-12);
  }
  const Environment straight = constant_environment(glm::vec3(1.0F));
  EXPECT_NEAR(environment_direction(straight, 0.5, 0.5).z, -1.0, 1e-12);
  EXPECT_NEAR(environment_direction(straight, 0.75, 0.5).x, 1.0, 1e-12);
  EXPECT_NEAR(environment_direction(straight, 0.3, 0.0).y, 1.0, 1e-12);
}

TEST(Environment, ResamplingKeepsTheLight) {
  const Environment environment = noisy_environment(37, 19);
  const glm::dvec3 mean = mean_radiance(*environment.radiance);
  for (const auto& [width, height] : {std::pair(64, 32), {5, 3}, {1, 1}, {74, 38}}) {
    const Image other = resampled_environment(*environment.radiance, width, height);
    EXPECT_LT(glm::length(mean_radiance(other) - mean), 1e-6 * glm::length(mean)) << width;
  }
  const Image twice = resampled_environment(*environment.radiance, 74, 38);
  EXPECT_NEAR(twice.at(73, 37)[1], environment.radiance->at(36, 18)[1], 1e-6);
}

TEST(RadianceStack, ConstantEnvironmentStaysConstant) {
  const RadianceStack stack = prefilter_environment(constant_environment({0.5F, 1.0F, 2.0F}), no_progress);
  for (const auto& layer : stack.layers) {
    for (const Image& map : layer) {
      for (std::size_t i = 0; i < map.texels.size(); ++i)
        ASSERT_NEAR(map.texels[i], (std::array{0.5F, 1.0F, 2.0F, 1.0F}).at(i % 4), 1e-5);
    }
  }
  EXPECT_NEAR(stack.irradiance.texels[0], 0.5, 1e-5);
  EXPECT_NEAR(stack.mean.b, 2.0, 1e-5);
}

// The largest error over all maps: 2% of the environment's brightest mean over that lobe.
TEST(RadianceStack, MapsAreMeansOverLobes) {
  const Environment environment = noisy_environment(64, 32);
  const RadianceStack stack = prefilter_environment(environment, no_progress);
  double kappa = stack.finest_sharpness;
  for (std::size_t level = 0; level < stack.layers[0].size(); ++level) {
    for (const auto& layer : stack.layers) {
      double error = 0;
      double largest = 0;
      for (const glm::dvec3& d : random_directions(12)) {
        const glm::dvec3 expected = vmf_mean(environment, d, kappa);
        error = std::max(error, glm::length(looked_up(layer[level], d) - expected));
        largest = std::max(largest, glm::length(expected));
      }
      EXPECT_LT(error, 0.04 * largest) << "kappa " << kappa;
      kappa /= 2.0;
    }
  }
}

TEST(RadianceStack, IrradianceIsTheCosineWeightedMean) {
  const Environment environment = noisy_environment(64, 32);
  const RadianceStack stack = prefilter_environment(environment, no_progress);
  const std::vector<double> solid_angles = row_solid_angles(64, 32);
  for (const glm::dvec3& n : random_directions(40)) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 64; ++x) {
        const glm::dvec3 d = environment_direction(environment, (x + 0.5) / 64, (y + 0.5) / 32);
        sum += std::max(glm::dot(d, n), 0.0) * solid_angles[static_cast<std::size_t>(y)] *
               glm::dvec3(environment_radiance(environment, d));
      }
    }
    EXPECT_LT(glm::length(looked_up(stack.irradiance, n) - sum / pi), 0.01 * glm::length(sum / pi));
  }
}

TEST(DirectionTable, DrawsTexelsByTheirLight) {
  const Environment environment = noisy_environment(9, 5);
  const DirectionTable table = direction_table(*environment.radiance);
  const std::vector<double> solid_angles = row_solid_angles(9, 5);
  double total = 0;
  for (std::size_t i = 0; i < 45; ++i) {
    const float* const t = &environment.radiance->texels[3 * i];
    total += (t[0] + t[1] + t[2]) * solid_angles[i / 9];
  }
  const auto sum = [&](std::size_t x, std::size_t y) {
    return static_cast<double>(table.sums.texels[2 * (10 * y + x)]);
  };
  for (std::size_t i = 0; i < 45; ++i) {
    const std::size_t x = i % 9, y = i / 9;
    const float* const t = &environment.radiance->texels[3 * i];
    const double share = (t[0] + t[1] + t[2]) * solid_angles[y] / total;
    const double row = sum(9, y) - (y > 0 ? sum(9, y - 1) : 0.0);
    const double column = sum(x, y) - (x > 0 ? sum(x - 1, y) : 0.0);
    EXPECT_NEAR(row * column, share, 1e-6);
    EXPECT_NEAR(table.radiance.texels[4 * i + 3] * solid_angles[y], share, 1e-6);
  }
}

// A guide is the first entry whose sum exceeds where its part begins: never behind the one that is looked for.
TEST(DirectionTable, GuidesLeadToTheirEntries) {
  const DirectionTable table = direction_table(*noisy_environment(9, 5).radiance);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 9; ++x) {
      const auto guide = static_cast<int>(table.sums.at(x, y)[1]);
      const float begin = static_cast<float>(x) / 9.0F;
      EXPECT_GT(table.sums.at(guide, y)[0], begin);
      EXPECT_TRUE(guide == 0 || table.sums.at(guide - 1, y)[0] <= begin + 1e-6F);
    }
  }
}

TEST(DirectionTable, BlackEnvironmentIsDrawnFromEvenly) {
  const DirectionTable table = direction_table(Image(4, 2, 3, 0.0F));
  for (std::size_t i = 3; i < table.radiance.texels.size(); i += 4)
    EXPECT_NEAR(table.radiance.texels[i], 1.0 / (4.0 * pi), 1e-6);
}

}  // namespace
}  // namespace footprint
