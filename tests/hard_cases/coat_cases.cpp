// The hard cases of clear coats: a square with maps of weight, roughness and normals. Every case has all three maps and
// some bumps of the base, so each method needs only one program for all.
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <variant>

#include "renderer/scene/camera.hpp"
#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/hard_maps.hpp"
#include "tests/hard_cases/hard_scenes.hpp"

namespace footprint::hard_cases {
namespace {

using glm::dvec3;

constexpr double least_roughness = 0.0316227766;  // the smallest that has an effect: alpha 1e-3
constexpr std::array<Wrap, 2> clamped{Wrap::clamp_to_edge, Wrap::clamp_to_edge};

TextureMap map_over_the_square(Image image) {
  return {"coat", std::make_shared<const Image>(std::move(image)), {.wrap = clamped}};
}

// The square fills the frame.
Scene whole_square(Image normals, float roughness) {
  Scene scene = square(std::move(normals), roughness);
  scene.camera.yfov = static_cast<float>(2.0 * std::atan(1.0 / 3.0));
  return scene;
}

// The point of the square at the middle of a pixel.
dvec3 shown_by(int x, int y) {
  return {2.0 * (x + 0.5) / picture_edge - 1.0, 1.0 - 2.0 * (y + 0.5) / picture_edge, 0.0};
}

// The half vector at that point.
dvec3 half_vector(const Scene& scene, const dvec3& at) {
  const dvec3 light(std::get<PointLight>(scene.lights.front()).position), eye(scene.camera.world[3]);
  return glm::normalize(glm::normalize(light - at) + glm::normalize(eye - at));
}

using At = std::function<double(int)>;

// One coat per pixel: roughness by columns, weight by rows. The normal leans by a number of lobe widths from the half
// vector, where the lobe has its peak.
ClearCoat coat_per_pixel(const Scene& scene, const At& roughness_at, const At& weight_at, const At& widths_at) {
  Image weights(picture_edge, picture_edge, 1), widths(picture_edge, picture_edge, 1);
  for (int y = 0; y < picture_edge; ++y) {
    for (int x = 0; x < picture_edge; ++x) {
      weights.at(x, y)[0] = static_cast<float>(weight_at(y));
      widths.at(x, y)[0] = static_cast<float>(roughness_at(x));
    }
  }
  Image normals = map_of(picture_edge, picture_edge, [&](int x, int y) {
    const double alpha = std::max(std::pow(roughness_at(x), 2.0), 1e-3);
    const dvec3 h = half_vector(scene, shown_by(x, y)), beside = glm::normalize(glm::cross(h, dvec3(0.3, 0.9, 0.1)));
    return h + std::min(widths_at(y) * alpha, 0.5) * beside;
  });
  ClearCoat coat;
  coat.weight_map = map_over_the_square(std::move(weights));
  coat.roughness_map = map_over_the_square(std::move(widths));
  coat.normal_map = map_over_the_square(std::move(normals));
  return coat;
}

// Values from 0 to 1, most of them between a mirror and 0.1.
double any_roughness(int x) { return x == 0 ? 0.0 : 0.02 * std::pow(50.0, (x - 1) / (picture_edge - 2.0)); }
// Values from 0 to 1 in steps of about a third of a power of ten.
double any_weight(int y) { return y < 2 ? 0.0 : std::pow(10.0, -6.0 + 6.0 * (y - 2) / (picture_edge - 3.0)); }

double peak_and_flank(int y) { return 0.7 * (y % 4); }
double flank(int) { return 0.7; }

Scene with_any_coat(Scene scene) {
  const ClearCoat coat = coat_per_pixel(scene, any_roughness, any_weight, peak_and_flank);
  for (Material& material : scene.materials) material.coat = coat;
  return scene;
}

// The right half of the square has a material without a normal map.
Scene half_without_normals() {
  Scene scene = whole_square(noise(16, 16, 0.5, 9), 0.4F);
  Mesh other = scene.meshes.front();
  for (Vertex& vertex : scene.meshes.front().vertices) {
    if (vertex.position.x > 0.0F) vertex.position.x = 0.0F, vertex.uv0.x = vertex.uv1.x = 0.5F;
  }
  for (Vertex& vertex : other.vertices) {
    if (vertex.position.x < 0.0F) vertex.position.x = 0.0F, vertex.uv0.x = vertex.uv1.x = 0.5F;
  }
  other.material = 1;
  scene.meshes.push_back(std::move(other));
  scene.materials.push_back(scene.materials.front());
  scene.materials.back().normal_map.reset();
  return scene;
}

// Small steps: roughness by columns from half its bound to twice its bound, weight by rows from 0.
Scene through_its_bounds() {
  Scene scene = whole_square(noise(16, 16, 0.01, 9), 0.4F);
  scene.materials.front().coat = coat_per_pixel(
      scene, [](int x) { return 0.5 * least_roughness * std::pow(4.0, x / (picture_edge - 1.0)); },
      [](int y) { return 1e-5 * std::max(y - 4, 0); }, flank);
  return scene;
}

// Normals of any direction, and three texels that are nearly no normal. No weight is 0: a sampler's rounding between
// two weights would count where no light reaches the base.
Scene steep_normals() {
  Scene scene = whole_square(noise(16, 16, 0.5, 9), 0.4F);
  ClearCoat coat = coat_per_pixel(
      scene, [](int x) { return 0.4 + 0.02 * x; }, [](int y) { return (y + 1.0) / picture_edge; }, flank);
  Image normals = noise(picture_edge, picture_edge, 0.999, 4);
  const auto put = [&](int x, int y, const glm::vec4& texel) {
    for (int c = 0; c < 4; ++c) normals.at(x, y)[static_cast<std::size_t>(c)] = texel[c];
  };
  put(5, 20, {0.0F, 0.0F, 1.0F, 0.0F});
  put(9, 20, {0.99999F, 0.0F, 0.0044721F, 1.0F});
  put(13, 20, {0.8F, 0.0F, -0.6F, 1.0F});
  coat.normal_map = map_over_the_square(std::move(normals));
  scene.materials.front().coat = std::move(coat);
  return scene;
}

// Bumps of the coat: a hundred per pixel, seen from above.
Scene bumpy_coat(Image normals, double roughness) {
  Scene scene = whole_square(noise(16, 16, 0.5, 9), 0.4F);
  const auto even = [](double value) { return [value](int i) { return value * (i % 2 == 0 ? 0.999 : 1.0); }; };
  ClearCoat coat = coat_per_pixel(scene, even(roughness), even(1.0), flank);
  coat.normal_map = map_over_the_square(std::move(normals));
  coat.normal_map->coordinates = {.transform = {16.0F, 0.0F, 0.0F, 16.0F, 0.0F, 0.0F}};
  scene.materials.front().coat = std::move(coat);
  return scene;
}

// A pixel is a thousandth of the square wide and sixty times as long.
Scene seen_along_the_surface(Scene scene) {
  scene.camera.yfov = 0.007F;
  scene.camera.world = look_at({0.0, -3.0, 0.05}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  return scene;
}

Scene lit_from(Scene scene, const glm::vec3& light) {
  std::get<PointLight>(scene.lights.front()).position = light;
  return scene;
}

// A dark sky with a small sun and a lamp that is too large to become a light of its own.
Scene in_an_environment() {
  Scene scene = steep_normals();
  Image map(512, 256, 3, 0.0F);
  for (int i = 0; i < 100; ++i) map.at(300 + i % 10, 60 + i / 10)[0] = 1e3F;
  for (float& channel : map.at(100, 40)) channel = 1e6F;
  scene.environment = Environment{.name = "hard", .radiance = std::make_shared<const Image>(std::move(map))};
  return scene;
}

Scene in_a_white_sky() {
  Scene scene = with_any_coat(whole_square(noise(16, 16, 0.5, 9), 0.4F));
  scene.environment = Environment{.name = "white", .radiance = std::make_shared<const Image>(Image(32, 16, 3, 1.0F))};
  return scene;
}

// Vertex normals that point into the surface, and light from below, opposite to the viewer in one pixel.
Scene light_opposite_the_view() {
  Scene scene = with_any_coat(whole_square(noise(16, 16, 0.5, 9), 0.4F));
  for (Vertex& vertex : scene.meshes.front().vertices) vertex.normal = {0.0F, 0.0F, -1.0F};
  const dvec3 at = shown_by(picture_edge / 2, picture_edge / 2), eye(scene.camera.world[3]);
  return lit_from(std::move(scene), glm::vec3(at - 0.5 * (eye - at)));
}

PictureCase coat_case(const char* name, const char* description, std::function<Scene()> scene,
                      std::optional<CoatCheck> check) {
  return {.name = name, .description = description, .scene = std::move(scene), .group = "coats", .coat = check};
}

// Cases with one coat per pixel.
std::vector<PictureCase> coat_a_pixel_cases() {
  std::vector<PictureCase> cases{
      coat_case(
          "coats_over_mirrors", "coats of every roughness and weight, at their peaks, over mirrors",
          [] { return with_any_coat(whole_square(noise(16, 16, 0.5, 9), 0.0F)); }, CoatCheck{}),
      coat_case(
          "coats_over_roughness_1", "the same over roughness 1, normals up to the horizon",
          [] { return with_any_coat(whole_square(noise(16, 16, 0.999, 9), 1.0F)); }, CoatCheck{}),
      coat_case(
          "coats_without_base_normals", "the same where half of the base has no normal map",
          [] { return with_any_coat(half_without_normals()); }, CoatCheck{}),
      coat_case("coat_through_its_bounds", "a weight through 0 and a roughness through the least, in small steps",
                through_its_bounds, CoatCheck{.steps = true}),
      coat_case("steep_coat_normals", "normals of the coat up to the horizon, one invalid, one that points inside",
                steep_normals, CoatCheck{}),
      coat_case(
          "coat_lit_along_the_surface", "the same lit from a degree above the surface",
          [] { return lit_from(steep_normals(), glm::vec3(1.5F, 0.0F, 0.02F)); }, CoatCheck{}),
      coat_case(
          "coats_over_constant_tilt", "coats of every roughness and weight where there is nothing to filter",
          [] { return with_any_coat(whole_square(tilted(17.0), 0.5F)); }, CoatCheck{})};
  cases.back().equals_direct = true;
  return cases;
}

// Cases with many coats per pixel.
std::vector<PictureCase> bumpy_coat_cases() {
  const CoatCheck mean{.points = 16, .most = 0.02};
  return {
      coat_case(
          "bumpy_coat", "a hundred of the coat's bumps in a pixel",
          [] { return bumpy_coat(noise(16, 16, 0.3, 9), 0.3); }, mean),
      coat_case(
          "bumpy_coat_seen_along_the_surface", "that coat seen from a degree above the surface",
          [] { return seen_along_the_surface(bumpy_coat(noise(16, 16, 0.3, 9), 0.3)); }, mean),
      coat_case(
          "smooth_coat_seen_along_the_surface", "a coat of hardly any bumps seen from a degree above the surface",
          [] { return seen_along_the_surface(bumpy_coat(noise(16, 16, 0.01, 9), 0.4)); }, mean),
      coat_case("opposite_coat_normals", "mirrors at the horizon whose mean is none",
                [] { return bumpy_coat(grooves(90.0), 0.0); }, {}),
  };
}

// Cases without a sum: only their numbers are checked.
std::vector<PictureCase> number_cases() {
  std::vector<PictureCase> cases{
      coat_case("coat_opposite_the_light", "wi = -wo over normals of vertices that point into the surface",
                light_opposite_the_view, {}),
      coat_case("coat_in_an_environment", "normals of the coat up to the horizon under a dark sky with a sun",
                in_an_environment, {}),
      coat_case("coats_in_an_environment", "coats of every roughness and weight under a white sky", in_a_white_sky,
                {})};
  cases[1].wide = cases[2].wide = true;
  return cases;
}

}  // namespace

std::span<const PictureCase> coat_cases() {
  static const std::vector<PictureCase> cases = [] {
    std::vector<PictureCase> all;
    for (const auto& part : {coat_a_pixel_cases(), bumpy_coat_cases(), number_cases()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return cases;
}

}  // namespace footprint::hard_cases
