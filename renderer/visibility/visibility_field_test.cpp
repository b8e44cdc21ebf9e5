// Signed distances against angles known from geometry, and their purpose: the visible share of a lobe, against the
// lobe times binary visibility summed over the sphere.
#include "renderer/visibility/visibility_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/environment/radiance_stack.hpp"
#include "renderer/scene/geometry.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/sweep.hpp"

namespace footprint::testing {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// A point of the floor below a sphere of which it sees a cap of `radius` radians around +z.
Scene ball_above(double radius) {
  Scene scene = white_floor();
  scene.meshes = {sphere_mesh({0, 0, 2}, static_cast<float>(2.0 * std::sin(radius)), 40)};
  fit_bounds(scene);
  return scene;
}

std::vector<glm::vec3> spread_directions(int count) {
  std::vector<glm::vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(azimuth), r * std::sin(azimuth), z);
  }
  return directions;
}

TEST(SignedDistances, OfAnOpenHorizonAreItsElevation) {
  const Scene scene = white_floor();
  const SphereVisibility visible = visibility_at(Occluders(scene), {0, 0, 0}, {0, 0, 1});
  const auto directions = spread_directions(500);
  const auto distances = signed_distances(visible, directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(distances[i], std::asin(directions[i].z), 4.0 * degree);
  }
}

TEST(SignedDistances, OfABallAreAnglesToItsEdge) {
  for (const double radius : {15.0 * degree, 30.0 * degree, 50.0 * degree}) {
    const Scene scene = ball_above(radius);
    const SphereVisibility visible = visibility_at(Occluders(scene), {0, 0, 0}, {0, 0, 1});
    const auto directions = spread_directions(500);
    const auto distances = signed_distances(visible, directions);
    double worst = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double angle = std::acos(static_cast<double>(directions[i].z));
      const double expected = std::min(angle - radius, 0.5 * std::numbers::pi - angle);
      if (std::abs(expected) > 4.0 * degree) worst = std::max(worst, std::abs(distances[i] - expected));
    }
    EXPECT_LT(worst, 4.0 * degree) << radius / degree;
  }
}

// With an open horizon the surface hides nothing by itself, and a ball as much as before.
TEST(SignedDistances, OfAnOpenHorizonKnowBodiesAlone) {
  const glm::vec3 up(0, 0, 1);
  EXPECT_TRUE(visibility_at(Occluders(white_floor()), glm::vec3(0), up, Horizon::open).all());
  const Scene scene = ball_above(30.0 * degree);
  const SphereVisibility open = visibility_at(Occluders(scene), glm::vec3(0), up, Horizon::open);
  const SphereVisibility cut = visibility_at(Occluders(scene), glm::vec3(0), up);
  EXPECT_EQ((open & cut), cut);
  const auto behind = std::ranges::count_if(
      visibility_directions(), [](const glm::vec3& direction) { return direction.z > std::cos(30.0 * degree); });
  EXPECT_NEAR(static_cast<double>(open.size() - open.count()), static_cast<double>(behind), 4.0);
}

TEST(SignedDistances, WithoutAnEdge) {
  const auto directions = spread_directions(10);
  for (const float d : signed_distances(SphereVisibility{}, directions)) EXPECT_FLOAT_EQ(d, -std::numbers::pi_v<float>);
  for (const float d : signed_distances(SphereVisibility{}.set(), directions)) {
    EXPECT_FLOAT_EQ(d, std::numbers::pi_v<float>);
  }
}

TEST(VisibilityGrid, CellsHoldTheirDirections) {
  const auto& directions = visibility_directions();
  for (std::size_t i = 0; i < directions.size(); ++i) EXPECT_EQ(visibility_cell(directions[i]), i);
}

// The twin of what environment_visibility.glsl does with a distance.
double share_above(double t, double k) {
  const double slope = k / std::sqrt(1.0 + k / 2.546);
  return 1.0 / (1.0 + std::exp(-(slope * t + (k - slope) * t * t * t)));
}

// Worst and mean error of the visible share of lobes about `axes`, against sums over 200000 rays.
std::array<double, 2> share_error(const Scene& scene, const glm::vec3& point, double sharpness) {
  const Occluders occluders(scene);
  const auto rays = spread_directions(200000);
  std::vector<bool> clear;
  clear.reserve(rays.size());
  const glm::vec3 start = point + occluders.offset() * glm::vec3(0, 0, 1);
  for (const glm::vec3& ray : rays) clear.push_back(ray.z > 0.0F && !occluders.blocked(start, ray));
  const auto axes = spread_directions(60);
  const auto distances = signed_distances(visibility_at(occluders, point, {0, 0, 1}), axes);
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    double seen = 0, all = 0;
    for (std::size_t j = 0; j < rays.size(); ++j) {
      const double weight = std::exp(sharpness * (glm::dot(axes[i], rays[j]) - 1.0));
      all += weight;
      if (clear[j]) seen += weight;
    }
    const double angle = std::clamp(static_cast<double>(distances[i]), -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
    const double error = std::abs(share_above(std::sin(angle), sharpness) - seen / all);
    worst = std::max(worst, error);
    sum += error;
  }
  return {worst, sum / static_cast<double>(axes.size())};
}

// One straight edge is what the approximation is made for; a box beside the point has corners.
TEST(VisibleShare, IsThatOfTheSumOverTheSphere) {
  Scene open = white_floor();
  Scene beside = white_floor();
  beside.meshes.push_back(box_mesh({0.3F, -0.4F, 0.0F}, {0.7F, 0.5F, 0.6F}));
  fit_bounds(beside);
  for (const double sharpness : {4.0, 16.0, 64.0, 256.0}) {
    const auto [worst_open, mean_open] = share_error(open, {0, 0, 0}, sharpness);
    const auto [worst_box, mean_box] = share_error(beside, {0, 0, 0}, sharpness);
    EXPECT_LT(mean_open, 0.03) << sharpness << " worst " << worst_open;
    EXPECT_LT(mean_box, 0.05) << sharpness << " worst " << worst_box;
    // A lobe narrower than the grid (6 degrees) may fall to the wrong side of an edge.
    if (sharpness < 100.0) {
      EXPECT_LT(worst_box, 0.3) << sharpness;
    }
  }
}

float reconstructed(const VisibilityField& field, const VertexVisibility& vertex, const glm::vec3& direction) {
  const int size = field.layers[0].width;
  const glm::dvec2 position = octahedral_uv(direction) * static_cast<double>(size - 2) + 0.5;
  const glm::ivec2 low(position);
  const glm::dvec2 part = position - glm::dvec2(low);
  double sum = 0;
  for (std::size_t k = 0; k <= visibility_components; ++k) {
    const auto texel = [&](int x, int y) {
      return static_cast<double>(field.layers[k / 4].at(low.x + x, low.y + y)[k % 4]);
    };
    const double value =
        glm::mix(glm::mix(texel(0, 0), texel(1, 0), part.x), glm::mix(texel(0, 1), texel(1, 1), part.x), part.y);
    sum += value * (k == 0 ? 1.0 : static_cast<double>(vertex.weights.at(k - 1)));
  }
  return static_cast<float>(sum);
}

TEST(VisibilityField, KeepsTheDistances) {
  Scene scene = box_over_floor();
  scene.meshes.push_back(sphere_mesh({0.55F, -0.5F, 0.3F}, 0.25F, 16));
  for (Mesh& mesh : scene.meshes) mesh = subdivided(mesh, 0.1F);
  fit_bounds(scene);
  const Occluders occluders(scene);
  const Environment white = constant_environment(glm::vec3(1.0F));
  const VisibilityField field = visibility_field(scene, occluders, white, no_progress);
  ASSERT_EQ(field.layers.size(), 4U);
  ASSERT_EQ(field.meshes.size(), scene.meshes.size());
  EXPECT_LT(field.error, 8.0 * degree);
  const auto directions = spread_directions(200);
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene.meshes[0].vertices.size(); i += 17) {
    const Vertex& vertex = scene.meshes[0].vertices[i];
    const auto expected = signed_distances(visibility_at(occluders, vertex.position, vertex.normal), directions);
    for (std::size_t j = 0; j < directions.size(); ++j) {
      squares += std::pow(reconstructed(field, field.meshes[0][i], directions[j]) - expected[j], 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 8.0 * degree);
}

// Under white light the share is that of the cosine over the hemisphere: 1 - sin^2 of a ball's radius.
TEST(VisibilityField, DiffuseShareIsThatOfTheCosine) {
  Scene scene = ball_above(40.0 * degree);
  scene.meshes.insert(scene.meshes.begin(), white_floor().meshes[0]);
  scene.meshes[0].vertices.push_back({});
  fit_bounds(scene);
  const VisibilityField field =
      visibility_field(scene, Occluders(scene), constant_environment({0.2F, 0.5F, 3.0F}), no_progress);
  const glm::vec3 share = field.meshes[0].back().diffuse_share;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c], 1.0 - std::pow(std::sin(40.0 * degree), 2), 0.02);
  // A ball is lit from its own horizon on wherever the floor is not.
  EXPECT_NEAR(field.meshes[1].front().diffuse_share.x, 1.0F, 1e-6F);
  EXPECT_EQ(field.meshes[1].front().hidden, 0.0F);
  EXPECT_NEAR(field.meshes[0].back().hidden, std::pow(std::sin(40.0 * degree), 2), 0.02);
}

TEST(VisibilityField, LightOfCellsIsAllOfTheLight) {
  const Environment sky = sky_environment({});
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& cell : visibility_light(sky)) sum += cell;
  const glm::dvec3 expected = 4.0 * std::numbers::pi * mean_radiance(*sky.radiance);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], expected[c], 1e-3 * expected[c]);
  for (const glm::dvec3& cell : visibility_light(constant_environment(glm::vec3(1.0F)))) {
    EXPECT_GT(cell.x, 0.2 * 4.0 * std::numbers::pi / 1024.0);
    EXPECT_LT(cell.x, 5.0 * 4.0 * std::numbers::pi / 1024.0);
  }
}

// More than 2^22 vertices, all but a few at one place, so that rays are few.
TEST(VisibilityField, TakesAsManyVerticesAsAScene) {
  if (!all_tests()) GTEST_SKIP() << "takes a GiB";
  Scene scene = box_over_floor();
  const std::vector<Vertex> few = scene.meshes[0].vertices;
  scene.meshes[0].vertices.resize((std::size_t{1} << 22U) + 5, few[0]);
  const Environment white = constant_environment(glm::vec3(1.0F));
  const VisibilityField field = visibility_field(scene, Occluders(scene), white, no_progress);
  ASSERT_EQ(field.meshes[0].size(), scene.meshes[0].vertices.size());
  EXPECT_EQ(field.meshes[0].back().diffuse_share, field.meshes[0].front().diffuse_share);
}

// Where memory is short, fewer vertices are computed, farther apart; where not even their values fit, none are.
TEST(VisibilityField, ComputesFewerVerticesWhereMemoryIsShort) {
  Scene scene = box_over_floor();
  for (Mesh& mesh : scene.meshes) mesh = subdivided(mesh, scene.bounds.radius() / visibility_edges_in_radius);
  const Environment white = constant_environment(glm::vec3(1.0F));
  const Occluders occluders(scene);
  const auto field_in = [&](std::uint64_t bytes) {
    return visibility_field(scene, occluders, white, no_progress, bytes);
  };
  const VisibilityField whole = field_in(std::uint64_t{1} << 30U);
  EXPECT_EQ(whole.coarseness, 1.0);
  std::size_t vertices = 0;
  for (const Mesh& mesh : scene.meshes) vertices += mesh.vertices.size();
  const std::uint64_t values = vertices * sizeof(VertexVisibility);
  const VisibilityField coarse = field_in(values + 100 * 2048);  // a hundred of them
  EXPECT_GT(coarse.coarseness, 1.0);
  double worst = 0.0, sum = 0.0;
  for (std::size_t m = 0; m < whole.meshes.size(); ++m) {
    ASSERT_EQ(coarse.meshes[m].size(), whole.meshes[m].size());
    for (std::size_t i = 0; i < whole.meshes[m].size(); ++i) {
      const double off = std::abs(coarse.meshes[m][i].diffuse_share.x - whole.meshes[m][i].diffuse_share.x);
      worst = std::max(worst, off);
      sum += off;
    }
  }
  EXPECT_GT(worst, 0.0);
  EXPECT_LT(sum / static_cast<double>(vertices), 0.1);
  EXPECT_THROW((void)field_in(values - 1), Error);
}

TEST(VisibilityField, CanBeInterrupted) {
  const Scene scene = box_over_floor();
  const auto stop = [](std::string_view, double) { throw Error(ErrorKind::interrupted, "", "stopped"); };
  EXPECT_THROW((void)visibility_field(scene, Occluders(scene), constant_environment(glm::vec3(1.0F)), stop), Error);
}

}  // namespace
}  // namespace footprint::testing
