// The reference against ground truth that shares no code with the shaders: a square with a normal map under a point
// light, summed over texels in double precision.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using glm::dvec3;

constexpr int map_edge = 28;  // texels: no multiple of the pictures', so that footprints cut texels
using std::numbers::pi;

// GGX, height-correlated Smith, Schlick and Lambert, as glTF 2.0 (appendix B) prints them.
double facet_radiance(const dvec3& n, const dvec3& l, const dvec3& v, double alpha, double f0, double albedo) {
  const dvec3 h = glm::normalize(l + v);
  const double nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h), vh = glm::dot(v, h);
  if (nl <= 0.0) return 0.0;
  const double a2 = alpha * alpha;
  const double t = nh * nh * (a2 - 1.0) + 1.0;
  const double d = a2 / (pi * t * t);
  const double g = 0.5 / (nl * std::sqrt(nv * nv * (1.0 - a2) + a2) + nv * std::sqrt(nl * nl * (1.0 - a2) + a2));
  const double f = f0 + (1.0 - f0) * std::pow(1.0 - vh, 5.0);
  return (f * d * g + (1.0 - f) * albedo / pi) * nl;
}

// Blinn-Phong without geometry or Fresnel term, as Xu 2017 and Iwasaki 2012 use it: f cos = ks D, and Lambert.
double blinn_phong_radiance(const dvec3& n, const dvec3& l, const dvec3& v, double s, double ks, double albedo) {
  const dvec3 h = glm::normalize(l + v);
  const double nh = std::max(glm::dot(n, h), 0.0);
  return ks * (s + 1.0) / (2.0 * pi) * std::pow(nh, s) + albedo / pi * std::max(glm::dot(n, l), 0.0);
}

struct Case {
  SquareMaterial material;
  double lobe;
  double (*radiance)(const dvec3&, const dvec3&, const dvec3&, double, double, double);
};

dvec3 normal_at(const Image& map, int x, int y) {
  const auto wrapped = [](int i) { return ((i % map_edge) + map_edge) % map_edge; };
  const auto n = map.at(wrapped(x), wrapped(y));
  return glm::normalize(dvec3(n[0], n[1], n[2]));
}

// Radiance that leaves the point (x, y) of the square towards the camera: the bilinear filter of its texels' radiances.
double radiance_at(const Image& map, const Case& c, int channel, double x, double y) {
  const dvec3 point(x, y, 0.0);
  const dvec3 to_light = dvec3(0.4F, 0.3F, 1.5F) - point;
  const double irradiance = 4.0 / glm::dot(to_light, to_light);
  const dvec3 l = glm::normalize(to_light);
  const dvec3 v = glm::normalize(dvec3(0.0, 0.0, 3.0) - point);
  const double u = (x + 1.0) / 2.0 * map_edge - 0.5;
  const double w = (1.0 - y) / 2.0 * map_edge - 0.5;  // v points down
  const auto x0 = static_cast<int>(std::floor(u)), y0 = static_cast<int>(std::floor(w));
  const double fx = u - x0, fy = w - y0;
  double sum = 0;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double weight = (i == 1 ? fx : 1.0 - fx) * (j == 1 ? fy : 1.0 - fy);
      sum += weight * c.radiance(normal_at(map, x0 + i, y0 + j), l, v, c.lobe, c.material.specular[channel],
                                 c.material.base_color[channel]);
    }
  }
  return sum * irradiance;
}

// The mean over pixel (px, py) of a picture of `edge` pixels, by the midpoint rule with `quadrature` points per axis.
double true_pixel(const Image& map, const Case& c, int channel, int edge, int quadrature, int px, int py) {
  double sum = 0;
  for (int j = 0; j < quadrature; ++j) {
    for (int i = 0; i < quadrature; ++i) {
      const double x = (px + (i + 0.5) / quadrature) / edge * 2.0 - 1.0;
      const double y = 1.0 - (py + (j + 0.5) / quadrature) / edge * 2.0;
      sum += radiance_at(map, c, channel, x, y);
    }
  }
  return sum / (quadrature * quadrature);
}

constexpr int picture_edge = 8;  // pixels, where each is looked at by itself

class GroundTruth : public ::testing::TestWithParam<Case> {
 protected:
  Image map_ = random_normals(map_edge, map_edge, 0.5F, 7);
  Scene scene_ = square_scene(map_, GetParam().material);
};

TEST_P(GroundTruth, ReferenceAgreesWithinItsStandardError) {
  TestRenderer renderer(scene_, {picture_edge, picture_edge});
  const Supersampled picture = renderer.reference(256, 3);
  double squares = 0, variances = 0;
  for (int y = 0; y < picture_edge; ++y) {
    for (int x = 0; x < picture_edge; ++x) {
      ASSERT_EQ(picture.mean.at(x, y)[3], 1.0F);
      EXPECT_GT(picture.standard_error.at(x, y)[0], 0.0F);
      squares += std::pow(picture.mean.at(x, y)[0] - true_pixel(map_, GetParam(), 0, picture_edge, 192, x, y), 2);
      variances += std::pow(picture.standard_error.at(x, y)[0], 2);
    }
  }
  // The sums are over 64 pixels with four blocks each.
  EXPECT_LT(squares, 2.0 * variances);
}

// The mean over a picture of 4 million samples: its own noise is a quarter of the tolerance.
TEST_P(GroundTruth, ReferenceConvergesToOneInAThousand) {
  constexpr int edge = 32;
  TestRenderer renderer(scene_, {edge, edge});
  const Supersampled picture = renderer.reference(4096, 5);
  std::array<double, 3> sum{}, expected{};
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      for (int c = 0; c < 3; ++c) {
        sum[static_cast<std::size_t>(c)] += picture.mean.at(x, y)[static_cast<std::size_t>(c)];
        expected[static_cast<std::size_t>(c)] += true_pixel(map_, GetParam(), c, edge, 24, x, y);
      }
    }
  }
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / expected[c], 1.0, 1e-3) << "channel " << c;
}

// The tests above can fail: another normal map differs.
TEST_P(GroundTruth, AnotherMapIsFarOutside) {
  TestRenderer renderer(square_scene(random_normals(map_edge, map_edge, 0.5F, 8), GetParam().material),
                        {picture_edge, picture_edge});
  const Supersampled picture = renderer.reference(256, 3);
  int outliers = 0;
  for (int y = 0; y < picture_edge; ++y) {
    for (int x = 0; x < picture_edge; ++x) {
      const double expected = true_pixel(map_, GetParam(), 0, picture_edge, 96, x, y);
      if (std::abs(picture.mean.at(x, y)[0] - expected) > 3.0 * picture.standard_error.at(x, y)[0]) ++outliers;
    }
  }
  EXPECT_GT(outliers, 16);
}

const Case gltf_case{
    {.brdf = {}, .roughness = 0.5F, .base_color = {0.5F, 0.4F, 0.3F}, .specular = glm::vec3(0.04F), .metallic = 0.0F},
    0.25,
    facet_radiance};
// alpha^2 = 2 / (s + 2) at roughness 0.45: s = 2 / 0.45^4 - 2
const Case blinn_phong_case{{.brdf = {NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true},
                             .roughness = 0.45F,
                             .base_color = {0.5F, 0.4F, 0.3F},
                             .specular = {0.5F, 0.4F, 0.2F},
                             .metallic = 0.0F},
                            2.0 / (0.45 * 0.45 * 0.45 * 0.45) - 2.0,
                            blinn_phong_radiance};

// A picture of the square, and what is known of how far it is off: root mean squares over pixels and a few seeds.
struct Quad {
  const char* name;
  Case material;
  int edge;                      // pixels
  std::array<double, 2> before;  // RMSE of independent texels on a jittered grid, at 64 and at 256 samples per pixel
};

struct Errors {
  double rmse = 0, floor = 0, standard_error = 0;
};

Case narrow(Case c) {
  c.material.roughness = 0.3F;
  c.lobe = 0.09;
  return c;
}

class Convergence : public ::testing::TestWithParam<Quad> {
 protected:
  Convergence() {
    const int edge = GetParam().edge;
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x)
        expected_.push_back(true_pixel(map_, GetParam().material, 0, edge, edge > 20 ? 48 : 160, x, y));
    }
  }

  Errors errors(int spp, std::uint64_t seeds = 8) {
    Errors sums;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const Supersampled picture = renderer_.reference(spp, seed);
      for (std::size_t i = 0; i < expected_.size(); ++i) {
        sums.rmse += std::pow(picture.mean.texels[4 * i] - expected_[i], 2);
        sums.floor += std::pow((picture.halves->first.texels[4 * i] - picture.halves->second.texels[4 * i]) / 2.0, 2);
        sums.standard_error += std::pow(picture.standard_error.texels[3 * i], 2);
      }
    }
    const auto mean = [&](double sum) { return std::sqrt(sum / static_cast<double>(seeds * expected_.size())); };
    return {mean(sums.rmse), mean(sums.floor), mean(sums.standard_error)};
  }

 private:
  Image map_ = random_normals(map_edge, map_edge, 0.5F, 7);
  TestRenderer renderer_{square_scene(map_, GetParam().material.material), {GetParam().edge, GetParam().edge}};
  std::vector<double> expected_;
};

TEST_P(Convergence, IsAtMostHalfOfWhatAJitteredGridLeaves) {
  EXPECT_LT(errors(64).rmse, 0.5 * GetParam().before[0]);
  EXPECT_LT(errors(256).rmse, 0.5 * GetParam().before[1]);
}

// Half the difference of two sequences that share nothing is the error of their mean, in root mean square over seeds:
// all pixels of a picture share the places of their samples, so that one picture's may be off by more. Blocks of one
// sequence make up for one another, so that their spread says too much, by less than 3.
TEST_P(Convergence, NoiseIsWhatItSays) {
  if (!all_tests() && GetParam().edge > 8) GTEST_SKIP() << "only with scripts/test --all";
  const Errors own = errors(64, 40);
  EXPECT_NEAR(own.floor / own.rmse, 1.0, 0.25);
  EXPECT_GT(own.standard_error / own.rmse, 0.8);
  EXPECT_LT(own.standard_error / own.rmse, 3.0);
  EXPECT_GT(errors(16, 40).floor / own.rmse, 1.5);  // it can fail: another count's error differs
}

INSTANTIATE_TEST_SUITE_P(BaseBrdfs, GroundTruth, ::testing::Values(gltf_case, blinn_phong_case));

INSTANTIATE_TEST_SUITE_P(Quads, Convergence,
                         ::testing::Values(Quad{"ggx", gltf_case, 8, {0.003012, 0.001614}},
                                           Quad{"blinn_phong", blinn_phong_case, 8, {0.115684, 0.062386}},
                                           Quad{"narrow", narrow(gltf_case), 14, {0.006072, 0.002935}},
                                           Quad{"magnified", gltf_case, 40, {0.002977, 0.001480}}),
                         [](const auto& quad) { return std::string(quad.param.name); });

}  // namespace
}  // namespace footprint::testing
