// The module's formulas against those in double precision, the neighbouring pixels that it reads, and its images.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/methods/screen_presets.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& direct_method();
const Method& roughness_bake_method();
const Method& specular_aa_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using namespace specular_aa;
using Inputs = std::vector<std::array<glm::vec4, 3>>;

std::vector<glm::vec4> in_glsl(std::string_view preset, NormalDistribution distribution, const std::string& body,
                               const Inputs& inputs) {
  (void)shared_context();
  const Options options(specular_aa_method().info.options, {{"preset", std::string(preset)}}, "specular_aa");
  ShaderVariant variant;
  variant.brdf.distribution = distribution;
  const std::string text = "const float option_constant = 0.3;\nconst float option_cap = 0.04;\nvec4 lobe_cutoff;\n" +
                           shared_functions(shader_flags(variant, options), specular_aa_method().shader);
  return evaluate_glsl(text, body, inputs);
}

TEST(SpecularAa, ModuleHasTheFormulasOfThePresets) {
  Inputs inputs;
  for (const float alpha : {0.02F, 0.1F, 0.35F, 0.7F, 0.95F}) {
    for (const float size : {0.0F, 1e-3F, 0.02F, 0.2F, 0.9F})
      inputs.push_back({glm::vec4(size * glm::vec3(0.6F, -0.3F, 0.1F), alpha * alpha),
                        glm::vec4(size * glm::vec3(-0.1F, 0.8F, -0.55F), 0.0F),
                        {}});
  }
  for (const std::string_view name : preset_names) {
    const Preset preset = preset_of(name);
    if (takes_half_vectors(preset)) continue;
    const std::string second = preset == Preset::babylon ? "screenWidenedForEnvironment(a.w, a.xyz, b.xyz)" : "0.0";
    const auto got = in_glsl(name, NormalDistribution::ggx,
                             "return vec4(screenWidened(a.w, a.xyz, b.xyz), " + second + ", 0.0, 0.0);", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const NormalSteps steps{glm::dvec3(inputs[i][0]), glm::dvec3(inputs[i][1])};
      const double alpha2 = inputs[i][0].w;
      EXPECT_NEAR(got[i].x / widened_alpha2({.preset = preset}, alpha2, steps), 1.0, 1e-4) << name << " " << i;
      if (preset != Preset::babylon) continue;
      EXPECT_NEAR(got[i].y / widened_alpha2({.preset = preset}, alpha2, steps, LightKind::environment), 1.0, 1e-4);
    }
  }
}

TEST(SpecularAa, HasTheSamePresetsAsTheFormulas) {
  const std::vector<OptionSpec>& options = specular_aa_method().info.options;
  const auto preset = std::ranges::find(options, "preset", &OptionSpec::name);
  ASSERT_NE(preset, options.end());
  EXPECT_TRUE(std::ranges::equal(preset->choices, preset_names));
}

glm::vec4 unit(float x, float y) { return {glm::normalize(glm::vec3(x, y, 1.0F)), 0.0F}; }

TEST(SpecularAa, ModuleHasTheMatricesOfHalfVectors) {
  Inputs inputs;
  for (const float alpha : {0.05F, 0.3F, 0.9F}) {
    for (const float size : {1e-3F, 0.05F, 0.4F}) {
      inputs.push_back(
          {unit(0.2F, -0.1F), unit(0.2F + size, -0.1F + 0.3F * size), unit(0.2F - 0.2F * size, -0.1F + size)});
      inputs.back()[0].w = alpha * alpha;
    }
  }
  for (const char* const name : {"tokuyoshi_kaplanyan_2019", "tokuyoshi_kaplanyan_2021"}) {
    const auto got = in_glsl(name, NormalDistribution::ggx,
                             "mat2 m = widenedMatrix(a.w, a.xyz, b.xyz, c.xyz);\nreturn vec4(m[0], m[1]);", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const auto& [here, right, above] = inputs[i];
      const glm::dmat2 expected =
          widened_matrix(preset_of(name), here.w, glm::dvec3(here), glm::dvec3(right), glm::dvec3(above));
      for (int k = 0; k < 4; ++k) EXPECT_NEAR(got[i][k], expected[k / 2][k % 2], 2e-4 * expected[k / 2][k / 2]) << name;
    }
  }
}

TEST(SpecularAa, ModulesDensitiesAreThoseOfTheMatrix) {
  Inputs inputs;
  for (const glm::vec4& h : {unit(0, 0), unit(0.1F, 0.05F), unit(-0.5F, 0.2F), unit(3.0F, -2.0F)})
    inputs.push_back({h, glm::vec4(0.09F, 0.02F, 0.02F, 0.03F), {}});
  for (const NormalDistribution distribution : {NormalDistribution::ggx, NormalDistribution::beckmann}) {
    const auto got = in_glsl("tokuyoshi_kaplanyan_2019", distribution,
                             "return vec4(matrixDensity(mat2(b.xy, b.zw), a.xyz));", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const glm::dvec4 m(inputs[i][1]);
      const double expected = matrix_density(distribution, glm::dmat2(m.x, m.y, m.z, m.w), glm::dvec3(inputs[i][0]));
      EXPECT_NEAR(got[i].x, expected, 1e-3 * expected + 1e-20) << i;
    }
  }
}

constexpr int bowl_cells = 64;

// A piece of a sphere of radius 1 about (0, 0, -1), seen from above in parallel rays, with a light straight above.
Scene bowl(float roughness, float edge) {
  Scene scene = square_scene({}, {.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                                  .roughness = roughness,
                                  .base_color = glm::vec3(0.0F),
                                  .specular = glm::vec3(0.5F)});
  Mesh& mesh = scene.meshes.front();
  mesh.vertices.clear();
  mesh.indices.clear();
  constexpr int cells = bowl_cells;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const glm::vec2 at = edge * (2.0F * glm::vec2(i, j) / static_cast<float>(cells) - 1.0F);
      const glm::vec3 normal(at, std::sqrt(1.0F - glm::dot(at, at)));
      Vertex vertex{};
      vertex.position = normal - glm::vec3(0, 0, 1);
      vertex.normal = normal;
      vertex.tangent = glm::vec4(glm::normalize(glm::vec3(normal.z, 0, -normal.x)), 1.0F);
      vertex.uv0 = vertex.uv1 = at;
      mesh.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t first = j * (cells + 1) + i, over = first + cells + 1;
      for (const std::uint32_t index : {first, first + 1, over, over, first + 1, over + 1})
        mesh.indices.push_back(index);
    }
  }
  scene.camera.orthographic = true;
  scene.camera.ymag = edge;
  scene.lights = {DirectionalLight{}};
  return scene;
}

double middle(const Image& picture) { return picture.at(picture.width / 2, picture.height / 2)[0]; }

// The normal of a unit sphere turns by a known step from pixel to pixel: each preset's lobe at the pole is that of its
// formula, in double precision.
TEST(SpecularAa, WidensASphereByItsCurvature) {
  constexpr float edge = 0.5F, roughness = 0.2F;
  constexpr int pixels = 9;
  // The next pixel's normal comes from the triangle at the pole, which is smaller than a pixel and extrapolated.
  const double cell = 2.0 * edge / bowl_cells;
  const double drop = (std::sqrt(1.0 - cell * cell) - 1.0) / cell;
  const glm::dvec2 next = glm::normalize(glm::dvec2(2.0 * edge / pixels, 1.0 + 2.0 * edge / pixels * drop));
  const double step = next.x, height = next.y;
  const NormalSteps steps{{step, 0, height - 1}, {0, step, height - 1}};
  TestRenderer renderer(bowl(roughness, edge), {pixels, pixels});
  const double alpha2 = std::pow(roughness, 4);
  const double before = middle(renderer.frame(direct_method()));
  for (const std::string_view name : preset_names) {
    const Preset preset = preset_of(name);
    glm::dmat2 matrix(1.0);
    if (takes_half_vectors(preset)) {
      matrix = widened_matrix(preset, alpha2, {0, 0, 1}, {-step, 0, height}, {0, -step, height});
    } else {
      matrix *= widened_alpha2({.preset = preset}, alpha2, steps);
    }
    const double expected = alpha2 / std::sqrt(glm::determinant(matrix));  // of peaks, 1 / (pi alpha^2)
    const double found =
        middle(renderer.frame(specular_aa_method(), "specular_aa:preset=" + std::string(name))) / before;
    EXPECT_NEAR(found / expected, 1.0, 0.002) << name;
    EXPECT_LT(found, 0.95) << name;
  }
}

// Four pixels share their normals, and tiles of any even size leave these four together.
TEST(SpecularAa, IsTheSameFourPixelsByFourPixelsWhereTheSurfaceIsCurved) {
  TestRenderer renderer(bowl(0.12F, 0.7F), {16, 16});
  const Image direct = renderer.frame(direct_method());
  for (const std::string_view name : preset_names) {
    const std::string text = "specular_aa:preset=" + std::string(name);
    for (const char* const filter : {"trilinear", "shaded:2"}) {
      if (filter[0] == 's' && !takes_half_vectors(preset_of(name))) continue;
      const FootprintFilter footprint = parse_footprint_filter(filter, "");
      const Image whole = renderer.frame(specular_aa_method(), text, footprint);
      EXPECT_LT(largest_difference(renderer.frame(specular_aa_method(), text, footprint, 2), whole), 1e-4) << name;
      EXPECT_GT(compare_images(whole, direct, 1.0F).value().relative_rmse, 0.1) << name;
    }
  }
}

// With parallel light and view half vectors stay as they are, too.
TEST(SpecularAa, LeavesAFlatSurfaceAsItIs) {
  Scene scene = bowl(0.5F, 0.5F);
  for (Vertex& vertex : scene.meshes.front().vertices) {
    vertex.normal = {0, 0, 1};
    vertex.tangent = {1, 0, 0, 1};
  }
  scene.lights = {DirectionalLight{.direction = glm::normalize(glm::vec3(-0.3F, -0.1F, -1.0F))}};
  TestRenderer renderer(scene, {16, 16});
  const Image direct = renderer.frame(direct_method());
  for (const std::string_view name : preset_names) {
    const double allowed = name == "babylon" ? 0.01 : 1e-4;  // which adds 5e-4 to every alpha
    const Image picture = renderer.frame(specular_aa_method(), "specular_aa:preset=" + std::string(name));
    EXPECT_LT(compare_images(picture, direct, 1.0F).value().relative_rmse, allowed) << name;
  }
}

Scene bumpy_scene() {
  return square_scene(random_normals(256, 256, 0.4F, 9),
                      {.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                       .roughness = 0.35F,
                       .base_color = glm::vec3(0.0F),
                       .specular = glm::vec3(0.5F)});
}

// A plane's own normal is the same everywhere: what is left is the bake.
TEST(SpecularAa, OverABakeOnAPlaneIsTheBake) {
  TestRenderer renderer(bumpy_scene(), {16, 16});
  for (const char* const preset : {"fit", "unity", "chan2018", "karis"}) {
    const Image bake = renderer.frame(roughness_bake_method(), std::string("roughness_bake:preset=") + preset);
    const Image both = renderer.frame(specular_aa_method(), std::string("specular_aa:bake=") + preset);
    EXPECT_LT(compare_images(both, bake, 1.0F).value().relative_rmse, 1e-4) << preset;
  }
  const Image bare = renderer.frame(roughness_bake_method(), "roughness_bake:preset=free:constant=0");
  EXPECT_LT(compare_images(renderer.frame(specular_aa_method()), bare, 1.0F).value().relative_rmse, 1e-4);
}

// A map whose slopes grow evenly: the next pixel's shading normal shows again what the bake finds within a pixel's
// footprint, and the two widen the lobe one after the other.
TEST(SpecularAa, CountsTheMapsOwnSpreadOnTopOfTheBake) {
  constexpr int pixels = 9, texels = 32 * pixels;
  constexpr float slope = 0.9F;  // at the map's edge
  Image normals(texels, texels, 4, 1.0F);
  for (int y = 0; y < texels; ++y) {
    for (int x = 0; x < texels; ++x) {
      const glm::vec2 at = 2.0F * (glm::vec2(x, texels - 1 - y) + 0.5F) / static_cast<float>(texels) - 1.0F;
      const glm::vec3 normal = glm::normalize(glm::vec3(slope * at, 1.0F));
      std::copy_n(&normal.x, 3, normals.at(x, y).begin());
    }
  }
  Scene scene = square_scene(normals, {.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                                       .roughness = 0.3F,
                                       .base_color = glm::vec3(0.0F),
                                       .specular = glm::vec3(0.5F)});
  scene.camera.orthographic = true;
  scene.camera.ymag = 1.0F;
  scene.lights = {DirectionalLight{}};
  TestRenderer renderer(scene, {pixels, pixels});
  const double alpha2 = std::pow(0.3, 4);
  const double base = middle(renderer.frame(specular_aa_method(), "specular_aa:normal=geometric"));
  // Peaks are 1 / (pi alpha^2).
  const auto widened_by = [&](const Method& method, const std::string& text) {
    return alpha2 * (base / middle(renderer.frame(method, text)) - 1.0);
  };
  const double baked = widened_by(roughness_bake_method(), "roughness_bake:preset=mjp_vmf");
  const double screen = widened_by(specular_aa_method(), "specular_aa:preset=o3de");
  const double both = widened_by(specular_aa_method(), "specular_aa:preset=o3de:bake=mjp_vmf");
  const double step = 2.0 * slope / pixels;
  EXPECT_NEAR(screen / (0.5 * 2.0 * step * step), 1.0, 0.05);
  EXPECT_GT(baked, 0.1 * screen);
  EXPECT_NEAR(both / (baked + screen), 1.0, 1e-3);
  EXPECT_NEAR(widened_by(specular_aa_method(), "specular_aa:preset=o3de:bake=mjp_vmf:normal=geometric") / baked, 1.0,
              1e-3);
}

TEST(SpecularAa, RefusesAConstantThatIsNotThePresets) {
  const Options options(specular_aa_method().info.options, {{"preset", "godot"}, {"constant", "1"}}, "x");
  const Material material = bumpy_scene().materials[0];
  EXPECT_THROW((void)specular_aa_method().precompute(material, options, {}, no_progress), Error);
}

// A module that does not need the next pixels costs nothing: its text has no code for them.
TEST(SpecularAa, OthersDoNotGetTheNextPixels) {
  TestRenderer renderer(bumpy_scene(), {4, 4});
  EXPECT_NE(renderer.fragment_text(specular_aa_method()).find("frame_dx"), std::string::npos);
  EXPECT_EQ(renderer.fragment_text(direct_method()).find("frame_dx"), std::string::npos);
  EXPECT_EQ(renderer.fragment_text(direct_method()).find("Neighbour"), std::string::npos);
}

}  // namespace
}  // namespace footprint::testing
