// The hard scenes: a square under one light, with one difficulty each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "renderer/core/names.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
#include "renderer/scene/camera.hpp"
#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/hard_maps.hpp"
#include "tests/hard_cases/hard_scenes.hpp"

namespace footprint::hard_cases {
namespace {

using enum NormalDistribution;

Scene bumpy() { return square(noise(16, 16, 0.5, 9), 0.4F); }

Scene seen_from(const glm::dvec3& eye) {
  Scene scene = bumpy();
  scene.camera.world = look_at(eye, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  return scene;
}

Scene lit_from(const glm::vec3& light, float candela) {
  Scene scene = bumpy();
  scene.lights = {PointLight{.position = light, .intensity = glm::vec3(candela), .range = {}}};
  return scene;
}

// Scales all lengths of the scene by `factor`.
Scene scaled(float factor) {
  Scene scene = bumpy();
  for (Vertex& vertex : scene.meshes.front().vertices) vertex.position *= factor;
  scene.camera.world[3] *= glm::vec4(glm::vec3(factor), 1.0F);
  scene.camera.znear *= factor;
  scene.bounds = {scene.bounds.lower * factor, scene.bounds.upper * factor};
  auto& light = std::get<PointLight>(scene.lights.front());
  light.position *= factor;
  light.intensity *= factor * factor;
  return scene;
}

// Triangles that are points or lines in space or on the map, and a mirrored map.
Scene degenerate() {
  Scene scene = bumpy();
  Mesh& mesh = scene.meshes.front();
  mesh.indices.insert(mesh.indices.end(), {0, 0, 0, 0, 1, 1});
  Mesh flat = mesh, mirrored = mesh;
  for (Vertex& vertex : flat.vertices) vertex.uv0 = vertex.uv1 = {0.3F, 0.3F};
  for (Vertex& vertex : mirrored.vertices) {
    vertex.uv0.x = vertex.uv1.x = -vertex.uv0.x;
    vertex.tangent.w = -1.0F;
    vertex.position.z = 0.5F;
    vertex.position.x *= 0.3F;
  }
  scene.meshes.push_back(flat);
  scene.meshes.push_back(mirrored);
  return scene;
}

// The map is mirrored along x, and mirrored back by the texture coordinates.
Scene mirrored() {
  Image normals = noise(16, 16, 0.5, 9);
  Image turned = normals;
  for (int y = 0; y < normals.height; ++y) {
    for (int x = 0; x < normals.width; ++x) {
      std::ranges::copy(normals.at(normals.width - 1 - x, y), turned.at(x, y).begin());
      turned.at(x, y)[0] *= -1.0F;
    }
  }
  Scene scene = square(std::move(turned), 0.4F);
  for (Vertex& vertex : scene.meshes.front().vertices) {
    vertex.uv0.x = 1.0F - vertex.uv0.x;
    vertex.uv1.x = vertex.uv0.x;
    vertex.tangent = glm::vec4(-glm::vec3(vertex.tangent), -vertex.tangent.w);
  }
  return scene;
}

// A square with one normal, seen at a grazing angle under a footprint filter.
Scene receding() {
  Scene scene = square(tilted(17.0), 0.5F);
  scene.camera.world = look_at({0.0, -3.0, 0.6}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  return scene;
}

// Plaster whose two sides lean by 80 degrees, lit from above: each reflects by its cosine.
constexpr double steep_sides = 80.0;
Scene steep_plaster() {
  Scene scene = square(grooves(steep_sides), 1.0F);
  Material& material = scene.materials.front();
  material.base_color = glm::vec4(1.0F);
  material.metallic = 0.0F;
  material.dielectric_specular = glm::vec3(0.0F);
  material.brdf = {ggx, GeometryTerm::none, FresnelTerm::none, true};
  material.normal_map->coordinates.transform = glm::mat3(32.0F);  // hundreds of texels per pixel
  material.normal_map->coordinates.transform[2] = glm::vec3(0.0F, 0.0F, 1.0F);
  scene.lights = {DirectionalLight{.direction = {0.0F, 0.0F, -1.0F}, .illuminance = glm::vec3(1.0F)}};
  return scene;
}

// The sun is one texel. A small sun becomes a directional light (renderer/scene/environment.hpp).
Scene surrounded(float sun, int width = 32) {
  Scene scene = bumpy();
  Image map(width, width / 2, 3, 0.0F);
  for (int x = 0; x < width; ++x) map.at(x, 3 * width / 32)[1] = 0.5F;
  for (float& channel : map.at(5 * width / 32, 4 * width / 32)) channel = sun;
  scene.environment = Environment{.name = "hard", .radiance = std::make_shared<const Image>(std::move(map))};
  return scene;
}

Scene stretched(float roughness, float strength) {
  Scene scene = square(noise(16, 16, 0.5, 9), roughness);
  scene.materials.front().anisotropy = Anisotropy{strength, 0.8F};
  return scene;
}

// A light of area 1 m above, with these half sides and direction.
Scene under_area(AreaShape shape, const glm::vec2& half_size, const glm::vec3& direction, AreaIntegral integral) {
  Scene scene = bumpy();
  AreaLight light{.shape = shape, .position = {0.3F, 0.2F, 1.0F}, .direction = direction};
  light.up = glm::vec3(0.0F, 1.0F, 0.0F);
  light.across = glm::cross(light.up, direction);
  light.half_size = half_size;
  light.integral = integral;
  scene.lights = {light};
  return scene;
}

constexpr glm::vec3 downwards{0.0F, 0.0F, -1.0F}, sideways{1.0F, 0.0F, 0.0F};

Scene varying_roughness() {
  Scene scene = bumpy();
  Image map(16, 16, 2, 0.0F);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) map.at(x, y)[0] = (x + y) % 2 == 0 ? 0.0F : 1.0F;
  }
  scene.materials.front().metallic_roughness_map =
      TextureMap{"roughness", std::make_shared<const Image>(std::move(map)), {}};
  return scene;
}

// If a method separates normals, the lobe of one wall has no share of the other wall.
Scene polished_walls() {
  Image normals = tilted(30.0), map(8, 8, 2, 1.0F);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      if (x < 4) normals.at(x, y)[0] *= -1.0F;
      map.at(x, y)[0] = x % 2 == 0 ? 0.1F : 0.05F;
    }
  }
  Scene scene = square(std::move(normals), 1.0F);
  scene.materials.front().metallic_roughness_map =
      TextureMap{"roughness", std::make_shared<const Image>(std::move(map)), {}};
  return scene;
}

Scene mirrors() { return square(noise(16, 16, 0.5, 9), 0.0F); }

// Heights 0 in the left half and `height` in the right half.
Image plateaus(float height) {
  Image heights(8, 8, 1);
  for (int y = 0; y < 8; ++y) {
    for (int x = 4; x < 8; ++x) heights.at(x, y)[0] = height;
  }
  return heights;
}

// A rise of half a width over two texels of eight is a slope of 2, up in the middle and down at the border.
Scene height_step() { return square(normals_of_heights(plateaus(1.0F), 0.5), 0.4F); }
Scene slopes_of_step() {
  return square(map_of(8, 8,
                       [](int x, int) {
                         const double rise = x == 3 || x == 4 ? 2.0 : x == 7 || x == 0 ? -2.0 : 0.0;
                         return glm::dvec3(-rise, 0.0, 1.0);
                       }),
                0.4F);
}

}  // namespace

std::span<const PictureCase> picture_cases() {
  static const std::vector<PictureCase> cases = [] {
    std::vector<PictureCase> all{
        {"roughness_0", "mirrors over noise", mirrors},
        {.name = "history_of_mirrors",
         .description = "a history of a mirror's highlights",
         .scene = mirrors,
         .history = HistoryClamp::off},
        {.name = "clamped_history",
         .description = "the same, clamped to the range of nine pixels",
         .scene = mirrors,
         .history = HistoryClamp::box},
        {"roughness_1", "roughness 1 over noise up to the horizon",
         [] { return square(noise(16, 16, 0.999, 9), 1.0F); }},
        {"roughness_0_and_1", "roughness 0 and 1 in turn", varying_roughness},
        {"polished_walls", "two walls, each of roughness 0.05 and 0.1 in turn", polished_walls},
        {"constant_tilt", "one normal everywhere: nothing to filter", [] { return square(tilted(17.0), 0.5F); }, true},
        {"grazing_view", "seen from a degree above the surface",
         [] {
           return seen_from({0.0, -3.0, 0.05});
         }},
        {"eye_on_the_surface", "seen from the surface's own plane",
         [] {
           return seen_from({0.0, -3.0, 0.0});
         }},
        {"light_at_the_eye", "wi = wo",
         [] {
           return lit_from({0.0F, 0.0F, 3.0F}, 4.0F);
         }},
        {"light_on_the_surface", "light from the surface's own plane",
         [] {
           return lit_from({1.5F, 0.0F, 0.0F}, 4.0F);
         }},
        {"light_behind", "light from behind",
         [] {
           return lit_from({0.4F, 0.3F, -1.5F}, 4.0F);
         }},
        {"faint_light", "1e-30 candela",
         [] {
           return lit_from({0.4F, 0.3F, 1.5F}, 1e-30F);
         }},
        {"bright_light", "1e12 candela",
         [] {
           return lit_from({0.4F, 0.3F, 1.5F}, 1e12F);
         }},
        {"tiny_scene", "lengths times 1e-6", [] { return scaled(1e-6F); }},
        {"huge_scene", "lengths times 1e6", [] { return scaled(1e6F); }},
        {"degenerate_triangles", "points, lines, one uv everywhere, a mirrored map", degenerate},
        {"environment_with_a_sun", "one texel of 1e6 in an environment of zeros", [] { return surrounded(1e6F); }},
        {"environment_with_a_small_sun", "one texel of 1e6 in 512 columns", [] { return surrounded(1e6F, 512); }},
        {"anisotropy_1_of_a_mirror", "anisotropy 1 over roughness 0", [] { return stretched(0.0F, 1.0F); }},
        {.name = "anisotropy_1_of_alpha_1",
         .description = "anisotropy 1 over roughness 1: the picture of round lobes",
         .scene = [] { return stretched(1.0F, 1.0F); },
         .twin = [] { return square(noise(16, 16, 0.5, 9), 1.0F); }},
        {.name = "anisotropy_0",
         .description = "anisotropy 0: the picture of round lobes",
         .scene = [] { return stretched(0.4F, 0.0F); },
         .twin = bumpy},
        {"area_light_without_area", "a rectangle of light of no size",
         [] {
           return under_area(AreaShape::rectangle, {0.0F, 0.0F}, downwards, AreaIntegral::lobes);
         }},
        {"area_light_of_a_line", "a rectangle of light of no height, by points",
         [] {
           return under_area(AreaShape::rectangle, {0.5F, 0.0F}, downwards, AreaIntegral::points);
         }},
        {"area_light_edge_on", "a disk of light that is seen edge on",
         [] {
           return under_area(AreaShape::disk, {0.5F, 0.5F}, sideways, AreaIntegral::lobes);
         }},
        {"area_light_through_the_surface", "a disk of light that goes through the surface",
         [] {
           return under_area(AreaShape::disk, {3.0F, 3.0F}, sideways, AreaIntegral::lobes);
         }},
        {"heights_1x1", "a height map of one texel: nothing to filter",
         [] { return square(normals_of_heights(Image(1, 1, 1, 7.0F), 100.0), 0.4F); }, true},
        {.name = "heights_step",
         .description = "heights of two plateaus: the picture of the normals of their steps",
         .scene = height_step,
         .twin = slopes_of_step},
        {"heights_cliff", "heights of two plateaus, 3e38 widths apart",
         [] { return square(normals_of_heights(plateaus(3e38F), 1.0), 0.4F); }},
        {"black_environment", "an environment of zeros but for one ring", [] { return surrounded(0.0F); }},
        {.name = "mirrored_uvs",
         .description = "a map turned over, and mirrored back by texture coordinates: the same picture",
         .scene = mirrored,
         .twin = bumpy},
        {.name = "steep_plaster",
         .description = "Lambert's term of grooves whose sides lean by 80 degrees, far away and lit from above",
         .scene = steep_plaster,
         .mean = std::cos(steep_sides * std::numbers::pi / 180.0) / std::numbers::pi}};
    for (const FootprintFilter filter : {FootprintFilter{FootprintFilterKind::trilinear, 1},
                                         {FootprintFilterKind::hardware, 8},
                                         {FootprintFilterKind::box, 3},
                                         {FootprintFilterKind::area, 3},
                                         {FootprintFilterKind::ewa, 8},
                                         {FootprintFilterKind::shaded, 2},
                                         {FootprintFilterKind::stochastic, 2},
                                         {FootprintFilterKind::stochastic_gaussian, 2, 1},
                                         {FootprintFilterKind::stochastic_trilinear, 2, 0}}) {
      all.push_back({.name = fmt::format("filter_{}", file_stem(footprint_filter_text(filter))),
                     .description = fmt::format("one normal everywhere, seen from 11 degrees, under {}",
                                                footprint_filter_text(filter)),
                     .scene = receding,
                     .equals_direct = true,
                     .filter = filter,
                     .group = "filters"});
    }
    return all;
  }();
  return cases;
}

}  // namespace footprint::hard_cases
