// The mask of interior pixels: it leaves out each kind of edge, by the criterion that is meant for it and by no other,
// and keeps what is smooth.
#include "renderer/pipeline/interior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <optional>

#include "renderer/image/metrics.hpp"
#include "renderer/scene/camera.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr int sample_count = 64;

Interior interior_of(const Scene& scene, int edge, const InteriorCriteria& criteria = {}, int tile = 0,
                     std::optional<Tile> part = {}) {
  (void)shared_context();
  GpuScene gpu(shared_context().info(), scene, effects_on(derive_effects(scene)));
  const InteriorFinder finder(gpu, scene, tile, criteria);
  Interior found =
      finder.render({.size = {edge, edge}, .camera = scene.camera},
                    part.value_or(Tile{.origin = {0, 0}, .size = {edge, edge}}), sample_count, 1, no_progress);
  shared_context().check("finding interior pixels");
  return found;
}

double count(const Image& mask) { return std::accumulate(mask.texels.begin(), mask.texels.end(), 0.0); }

// The whole column of a picture, or none of it.
double column_sum(const Image& mask, int x) {
  double sum = 0;
  for (int y = 0; y < mask.height; ++y) sum += mask.at(x, y)[0];
  return sum;
}

Vertex vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv) {
  return {.position = position, .normal = glm::normalize(normal), .uv0 = uv};
}

// A quad of corners a, b, c, d, counter-clockwise from above, with its own vertices.
void add_quad(Mesh& mesh, const std::array<Vertex, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

// The strip of x from `left` to `right` and y from -2 to 2, at heights that fall with `drop` a metre from x = 0 on; its
// uv are its x and y, moved by `shift` and sheared by `shear` away from y = 2.
struct Strip {
  float left = 0, right = 2, height = 0, slope = 0, shift = 0, shear = 0;
};

void add_strip(Mesh& mesh, const Strip& s) {
  const glm::vec3 normal(-s.slope, 0, 1);
  const auto at = [&](float x, float y) {
    return vertex({x, y, s.height + s.slope * x}, normal, {x + s.shift + s.shear * (2 - y), y});
  };
  add_quad(mesh, {at(s.left, -2), at(s.right, -2), at(s.right, 2), at(s.left, 2)});
}

// Two strips that meet at x = 0, over which an orthographic camera looks straight down on x and y from -1 to 1. The
// picture of 33 pixels has that line in the midst of its column 16.
constexpr int view_edge = 33, middle = 16;

Scene two_strips(const Strip& left, const Strip& right) {
  Scene scene = square_scene(random_normals(16, 16, 0.3F, 3), {});
  Mesh mesh{.name = "strips", .vertices = {}, .indices = {}, .material = 0};
  add_strip(mesh, left);
  add_strip(mesh, right);
  scene.meshes = {mesh};
  scene.camera.orthographic = true;
  scene.camera.ymag = 1.0F;
  scene.shadows.cast = false;
  fit_bounds(scene);
  return scene;
}

// The strips of one plane.
constexpr Strip left_half{.left = -2, .right = 0}, right_half{.left = 0, .right = 2};

// Every pixel but those of the middle column is interior, and these are none.
void expect_an_edge_in_the_middle(const Image& mask) {
  for (int x = 0; x < view_edge; ++x) EXPECT_EQ(column_sum(mask, x), x == middle ? 0 : view_edge) << "column " << x;
}

TEST(Interior, KeepsAFlatQuadWhole) {
  EXPECT_EQ(count(interior_of(two_strips(left_half, right_half), view_edge).mask), view_edge * view_edge);
  EXPECT_EQ(count(interior_of(square_scene(random_normals(64, 64, 0.9F, 1), {}), 32).mask), 32 * 32);
}

TEST(Interior, KeepsAPlaneThatRecedes) {
  const Scene scene = receding_grooves();
  TestRenderer renderer(scene, {96, 96});
  const Image reference = renderer.reference(sample_count).mean;
  const Image mask = interior_of(scene, 96).mask;
  EXPECT_EQ(count(mask), static_cast<double>(object_pixel_count(reference)));
  EXPECT_GT(count(mask), 1000);
}

Scene sphere_scene(int rings) {
  Scene scene = white_floor();
  scene.meshes = {sphere_mesh({0, 0, 0}, 0.9F, rings)};
  scene.camera.orthographic = true;
  scene.camera.ymag = 1.0F;
  scene.lights = {DirectionalLight{.direction = {0, 0, -1}, .illuminance = glm::vec3(3)}};
  fit_bounds(scene);
  return scene;
}

// The normal of a sphere of R pixels' radius changes by 1 / (R cos t) radians a pixel at the angle t from the viewer.
TEST(Interior, KeepsASmoothSpheresInside) {
  constexpr int pixels = 128;
  const Image mask = interior_of(sphere_scene(256), pixels).mask;
  int inside = 0;
  for (int y = 0; y < pixels; ++y) {
    for (int x = 0; x < pixels; ++x) {
      const double r = std::hypot(x + 0.5 - pixels / 2.0, y + 0.5 - pixels / 2.0) / (0.9 * pixels / 2.0);
      if (r < 0.95) {
        EXPECT_EQ(mask.at(x, y)[0], 1.0F) << x << ", " << y;
        ++inside;
      }
      if (r > 0.995) {
        EXPECT_EQ(mask.at(x, y)[0], 0.0F) << x << ", " << y;
      }
    }
  }
  EXPECT_GT(inside, 9000);
}

TEST(Interior, LeavesOutSilhouettes) {
  Scene scene = two_strips(left_half, right_half);
  scene.meshes[0].indices.resize(6);  // the left strip alone
  const Image mask = interior_of(scene, view_edge).mask;
  EXPECT_EQ(column_sum(mask, middle), 0);
  EXPECT_EQ(count(mask), view_edge * middle);
  EXPECT_EQ(column_sum(interior_of(scene, view_edge, {.coverage = false}).mask, middle), view_edge)
      << "without the criterion";
}

// Two sheets of one chart, one above the other, joined by a riser that the camera sees edge-on.
TEST(Interior, LeavesOutDepthSteps) {
  Strip lower = right_half;
  lower.height = -0.2F;  // three pixels; their uv go on
  Scene scene = two_strips(left_half, lower);
  Mesh& mesh = scene.meshes[0];
  mesh.indices.insert(mesh.indices.end(), {1, 4, 7, 1, 7, 2});
  expect_an_edge_in_the_middle(interior_of(scene, view_edge).mask);
  EXPECT_EQ(count(interior_of(scene, view_edge, {.depth = false}).mask), view_edge * view_edge)
      << "without the criterion";
}

// A twentieth of the pixel is not a step, because the criterion is relative to the pixel, not to metres.
TEST(Interior, DepthStepsAreOfThePixelsSize) {
  Strip lower = right_half;
  lower.height = -0.05F * 2.0F / view_edge;
  Scene scene = two_strips(left_half, lower);
  Mesh& mesh = scene.meshes[0];
  mesh.indices.insert(mesh.indices.end(), {1, 4, 7, 1, 7, 2});
  EXPECT_EQ(count(interior_of(scene, view_edge).mask), view_edge * view_edge);
}

// At a slant a step along the view is nearly in the plane: the pixel's span there shows it.
TEST(Interior, LeavesOutStepsBetweenGrazingSheets) {
  Scene scene = two_strips({.left = -2, .right = 2, .height = 0}, {.left = -2, .right = 2, .height = -0.2F});
  Mesh& mesh = scene.meshes[0];
  for (const std::size_t far : {6, 7}) mesh.vertices[far].position.y = 9.0F;  // goes on behind the upper one's end
  for (Vertex& v : mesh.vertices) v.uv0 = v.position;
  mesh.indices.insert(mesh.indices.end(), {3, 2, 5, 3, 5, 4});
  scene.camera.world = look_at({0.0, -6.0, 0.5}, {0.0, 2.0, 0.0}, {0.0, 0.0, 1.0});  // at 3.6 degrees
  scene.camera.ymag = 0.3F;
  const double with = count(interior_of(scene, view_edge).mask);
  const double without = count(interior_of(scene, view_edge, {.depth = false}).mask);
  EXPECT_LE(with, without - view_edge);
  EXPECT_GT(with, view_edge * view_edge / 2.0);
}

// A roof of 15 degrees over all; its ridge is in the middle of the pixels, so that no step between samples leaves the
// plane of the first by more than 10.
TEST(Interior, LeavesOutCreases) {
  const float slope = std::tan(7.5F * 3.14159265F / 180.0F);
  Strip left = left_half, right = right_half;
  left.slope = slope;
  right.slope = -slope;
  const Scene scene = two_strips(left, right);
  expect_an_edge_in_the_middle(interior_of(scene, view_edge).mask);
  EXPECT_EQ(column_sum(interior_of(scene, view_edge, {.normals = false}).mask, middle), view_edge)
      << "without the criterion";
}

// The facets agree; the vertices' normals do not.
TEST(Interior, LeavesOutCreasesOfVertexNormals) {
  Scene scene = two_strips(left_half, right_half);
  for (std::size_t i = 4; i < 8; ++i) scene.meshes[0].vertices[i].normal = glm::normalize(glm::vec3(0.3F, 0, 1));
  expect_an_edge_in_the_middle(interior_of(scene, view_edge).mask);
  EXPECT_EQ(count(interior_of(scene, view_edge, {.normals = false}).mask), view_edge * view_edge)
      << "without the criterion";
}

TEST(Interior, LeavesOutBordersOfMaterials) {
  Scene scene = two_strips(left_half, right_half);
  scene.materials.push_back(scene.materials.front());
  Mesh right{.name = "right", .vertices = {}, .indices = {}, .material = 1};
  add_strip(right, right_half);
  scene.meshes[0].indices.resize(6);
  scene.meshes[0].vertices.resize(4);
  scene.meshes.push_back(right);
  expect_an_edge_in_the_middle(interior_of(scene, view_edge).mask);
  EXPECT_EQ(count(interior_of(scene, view_edge, {.materials = false}).mask), view_edge * view_edge)
      << "without the criterion";
}

TEST(Interior, LeavesOutBordersOfCharts) {
  Strip moved = right_half;
  moved.shift = 5.0F;  // by whole turns of a map that repeats: the same texels, but another island
  const Scene scene = two_strips(left_half, moved);
  expect_an_edge_in_the_middle(interior_of(scene, view_edge).mask);
  EXPECT_EQ(count(interior_of(scene, view_edge, {.charts = false}).mask), view_edge * view_edge)
      << "without the criterion";
}

// One island, whose halves meet in a corner beyond the picture and are cut apart within it.
TEST(Interior, LeavesOutCutsWithinAChart) {
  Strip sheared = right_half;
  sheared.shear = 0.2F;
  const Scene scene = two_strips(left_half, sheared);
  expect_an_edge_in_the_middle(interior_of(scene, view_edge).mask);
  EXPECT_EQ(count(interior_of(scene, view_edge, {.cuts = false}).mask), view_edge * view_edge)
      << "without the criterion";
}

// A box over a floor, and light that comes slanting along x: the edge of its shadow is at x = 0.55.
Scene shadowed_floor(int resolution) {
  Scene scene = box_over_floor();
  scene.lights = {DirectionalLight{.direction = glm::normalize(glm::vec3(0.6F, 0, -1)), .illuminance = glm::vec3(3)}};
  scene.shadows.cast = true;
  scene.shadows.resolution = resolution;
  return scene;
}

TEST(Interior, LeavesOutEdgesOfShadows) {
  constexpr int pixels = 81;  // the edge is within one
  const auto column = [](double x) { return static_cast<int>((x + 1.0) / 2.0 * pixels); };
  const Image mask = interior_of(shadowed_floor(2048), pixels).mask;
  const Image all = interior_of(shadowed_floor(2048), pixels, {.shadows = false}).mask;
  EXPECT_EQ(mask.at(column(0.55), pixels / 2)[0], 0.0F) << "at the edge";
  EXPECT_EQ(mask.at(column(0.45), pixels / 2)[0], 1.0F) << "in the shadow";
  EXPECT_EQ(mask.at(column(0.65), pixels / 2)[0], 1.0F) << "in the light";
  EXPECT_EQ(all.at(column(0.55), pixels / 2)[0], 1.0F) << "without the criterion";
}

// Texels of a quarter of a metre: their soft edge is 24 pixels wide, and a pixel's centre represents it.
TEST(Interior, KeepsWideSoftEdgesOfShadows) {
  const Scene scene = shadowed_floor(16);
  const double all = count(interior_of(scene, 224, {.shadows = false}).mask);
  EXPECT_GT(count(interior_of(scene, 224).mask), 0.99 * all);
  EXPECT_LT(count(interior_of(scene, 64).mask), 0.99 * count(interior_of(scene, 64, {.shadows = false}).mask));
}

// Five lights of three kinds are more than one look at shadows takes.
TEST(Interior, LooksAtEveryLight) {
  Scene scene = shadowed_floor(512);
  const Light slanted = scene.lights.front();
  const PointLight above{.position = {0, 0, 40}, .intensity = glm::vec3(4), .range = {}};  // its shadow hides below
  scene.lights = {above, above, SpotLight{.point = above}, SpotLight{.point = above}, slanted};
  constexpr int pixels = 41;
  const Image mask = interior_of(scene, pixels).mask;
  EXPECT_EQ(mask.at(static_cast<int>(1.55 / 2.0 * pixels), pixels / 2)[0], 0.0F);
}

TEST(Interior, DoesNotDependOnTheTiles) {
  for (const Scene& scene : {sphere_scene(64), shadowed_floor(512)}) {
    EXPECT_EQ(interior_of(scene, 50).mask, interior_of(scene, 50, {}, 16).mask);
  }
}

TEST(Interior, OfAPartIsThatOfTheWholeAndNothingBesideIt) {
  const Tile part{.origin = {7, 20}, .size = {30, 19}};
  const Interior whole = interior_of(sphere_scene(64), 50), found = interior_of(sphere_scene(64), 50, {}, 16, part);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 50; ++x) {
      const glm::ivec2 inside(x - part.origin.x, 49 - y - part.origin.y);
      const bool in_part =
          glm::all(glm::greaterThanEqual(inside, glm::ivec2(0))) && glm::all(glm::lessThan(inside, part.size));
      EXPECT_EQ(found.mask.at(x, y)[0], in_part ? whole.mask.at(x, y)[0] : 0.0F) << x << ", " << y;
    }
  }
  EXPECT_EQ(count(interior_of(sphere_scene(64), 50, {}, 0, Tile{}).mask), 0.0);
}

TEST(Interior, KnowsTheFootprintInTexels) {
  const Image texels = interior_of(square_scene(random_normals(64, 128, 0.3F, 1), {}), 16).texels;
  for (const float t : texels.texels) EXPECT_NEAR(t, 8.0F, 1e-2F);
  for (const float t : interior_of(white_floor(), 16).texels.texels) EXPECT_EQ(t, 0.0F) << "without a normal map";
}

// What an alpha mask cuts out is not there.
TEST(Interior, LeavesOutEdgesOfAlpha) {
  Scene scene = two_strips(left_half, right_half);
  Image alpha(2, 1, 4, 1.0F);
  alpha.at(1, 0)[3] = 0.0F;
  scene.materials[0].base_color_map = TextureMap{"alpha", std::make_shared<const Image>(alpha), {}};
  scene.materials[0].alpha_cutoff = 0.5F;
  const Image mask = interior_of(scene, view_edge).mask;
  EXPECT_LT(count(mask), 0.6 * view_edge * view_edge);
  EXPECT_GT(count(mask), 0.3 * view_edge * view_edge);
  EXPECT_EQ(count(interior_of(scene, view_edge, {.coverage = false}).mask), view_edge * view_edge)
      << "without the criterion";
}

// The square, its left quarter of another material just above it.
Scene two_materials() {
  Scene scene = square_scene(random_normals(16, 16, 0.8F, 1), {});
  scene.materials.push_back(scene.materials.front());
  Mesh left = scene.meshes.front();
  left.material = 1;
  for (Vertex& v : left.vertices) v.position = {0.25F * v.position.x - 0.75F, v.position.y, 0.01F};
  scene.meshes.push_back(left);
  return scene;
}

TEST(Interior, TellsMaterialsApart) {
  const Interior found = interior_of(two_materials(), 32);
  Image pixels(32, 32, 1, 1.0F);
  pixels.at(30, 5)[0] = 0.0F;
  const auto masks = material_masks(found.materials, pixels, 2);
  ASSERT_EQ(masks.size(), 2U);
  EXPECT_EQ(count(masks[1]), 32 * 8);
  EXPECT_EQ(count(masks[0]), 32 * 24 - 1);
  EXPECT_EQ(masks[1].at(3, 3)[0], 1.0F);
  EXPECT_EQ(masks[0].at(3, 3)[0], 0.0F);
  EXPECT_EQ(masks[0].at(30, 5)[0], 0.0F) << "not one of the pixels";
}

TEST(Interior, HasNoMaterialBesideTheSurface) {
  Scene scene = two_materials();
  scene.camera.world[3].z = 12.0F;
  const auto masks = material_masks(interior_of(scene, 32).materials, Image(32, 32, 1, 1.0F), 2);
  EXPECT_LT(count(masks[0]) + count(masks[1]), 100);
  EXPECT_GT(count(masks[0]), 20);
}

TEST(Interior, HasNoMaterialWhereTheNormalTurnsAway) {
  Scene scene = two_materials();
  for (Vertex& v : scene.meshes[1].vertices) v.normal = {0, 0.6F, -0.8F};
  const auto masks = material_masks(interior_of(scene, 32).materials, Image(32, 32, 1, 1.0F), 2);
  EXPECT_EQ(count(masks[1]), 0);
  EXPECT_EQ(count(masks[0]), 32 * 24);
}

// A map of 4 x 1 indices over 34 pixels: the second material has the last two texels. Of the columns, those within the
// blend of two texels show both materials.
TEST(Interior, HasOneMaterialOfThoseThatShareASurface) {
  Scene scene = square_scene({}, {});
  scene.materials.push_back(scene.materials.front());
  for (const bool first : {true, false}) {
    Image share(4, 1, 1);
    share.texels = first ? std::vector{1.0F, 1.0F, 0.0F, 0.0F} : std::vector{0.0F, 0.0F, 1.0F, 1.0F};
    TextureMap map{"share", std::make_shared<const Image>(share), {}};
    map.coordinates.wrap = {Wrap::clamp_to_edge, Wrap::clamp_to_edge};
    scene.materials[first ? 0 : 1].share = SurfaceShare{map, first};
  }
  Mesh again = scene.meshes.front();
  again.material = 1;
  scene.meshes.push_back(again);
  const Interior found = interior_of(scene, 34);
  EXPECT_EQ(count(found.mask), 34 * 34) << "a map is not an edge";
  const auto masks = material_masks(found.materials, found.mask, 2);
  for (int x = 0; x < 34; ++x) {
    const double u = (x + 0.5) / 34;
    EXPECT_EQ(column_sum(masks[0], x), u < 0.375 ? 34 : 0) << x;
    EXPECT_EQ(column_sum(masks[1], x), u > 0.625 ? 34 : 0) << x;
  }
}

}  // namespace
}  // namespace footprint::testing
