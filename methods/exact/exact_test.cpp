// The sum over texels: its weights against areas and tents added up point by point, its NDF against the exact one of
// the same texels, its pictures against the reference where nothing but the kernel could differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "renderer/image/metrics.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/ndf/reference_ndf.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/scene/camera.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& exact_method();
}

namespace footprint::testing {
namespace {

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};

// ---- weights ----

// A parallelogram about `centre`, in texels; the texel is about 0.
struct Parallelogram {
  glm::dvec2 centre;
  glm::dmat2 edges;
};

// The mean of the texel's weight over it, by the midpoint rule.
double summed_mean(const Parallelogram& p, bool tents) {
  constexpr int points = 1000;  // along each edge
  double sum = 0.0;
  for (int j = 0; j < points; ++j) {
    for (int i = 0; i < points; ++i) {
      const glm::dvec2 x = p.centre + p.edges * (glm::dvec2(i + 0.5, j + 0.5) / static_cast<double>(points) - 0.5);
      if (tents) {
        sum += std::max(1.0 - std::abs(x.x), 0.0) * std::max(1.0 - std::abs(x.y), 0.0);
      } else {
        sum += std::abs(x.x) < 0.5 && std::abs(x.y) < 0.5 ? 1.0 : 0.0;
      }
    }
  }
  return sum / (points * points);
}

// Upright, turned, sheared, mirrored, long, small and large ones, some beside the texel.
std::vector<Parallelogram> some_parallelograms() {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Parallelogram> out{{{0.2, -0.3}, {{1.0, 0.0}, {0.0, 1.0}}},   {{0.0, 0.0}, {{3.0, 0.0}, {0.0, 3.0}}},
                                 {{0.5, 0.5}, {{0.0, 1.0}, {1.0, 0.0}}},    {{0.1, 0.4}, {{-0.25, 0.0}, {0.0, 0.5}}},
                                 {{0.0, 0.2}, {{40.0, 40.0}, {-0.1, 0.1}}}, {{0.7, 0.0}, {{0.0, 9.0}, {0.02, 0.0}}}};
  for (const double size : {0.02, 0.3, 1.0, 2.5, 8.0}) {
    for (int i = 0; i < 12; ++i) {
      const glm::dvec2 a(unit(random), unit(random)), b(unit(random), unit(random));
      if (std::abs(a.x * b.y - a.y * b.x) < 0.05) continue;
      out.push_back({glm::dvec2(unit(random), unit(random)) * (0.9 + 0.4 * size), glm::dmat2(a, b) * size});
    }
  }
  return out;
}

// What 32 bits leave of a share, over the area: places are rounded to 6e-8 of a texel along each edge.
double rounding_of(const Parallelogram& p) {
  return 1e-6 * (glm::length(p.edges[0]) + glm::length(p.edges[1])) / std::abs(glm::determinant(p.edges));
}

std::vector<glm::vec4> probe_exact(const std::string& kernel, const std::string& body,
                                   std::span<const std::array<glm::vec4, 3>> inputs) {
  const Material material = square_scene(random_normals(8, 8, 0.5F, 1), {.brdf = blinn_phong}).materials[0];
  return probe_method({&exact_method(), &material, {{"kernel", kernel}}}, body, inputs);
}

std::vector<std::array<glm::vec4, 3>> as_inputs(const std::vector<Parallelogram>& all) {
  std::vector<std::array<glm::vec4, 3>> inputs;
  for (const Parallelogram& p : all) {
    inputs.push_back({glm::vec4(glm::vec2(p.centre), 0.0F, 0.0F),
                      glm::vec4(glm::vec2(p.edges[0]), glm::vec2(p.edges[1])), glm::vec4(0.0F)});
  }
  return inputs;
}

class ExactWeights : public ::testing::TestWithParam<const char*> {};

TEST_P(ExactWeights, AreThoseOfASumOverPoints) {
  const bool tents = std::string(GetParam()) == "pixel";
  const std::vector<Parallelogram> all = some_parallelograms();
  const auto shares = probe_exact(GetParam(), "return vec4(texelShare(a.xy, mat2(b.xy, b.zw)));", as_inputs(all));
  int touched = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double area = std::abs(glm::determinant(all[i].edges));
    const double expected = summed_mean(all[i], tents);
    // A border through the sum's own points leaves 1 / 1000 of each edge.
    EXPECT_NEAR(shares[i].x / area, expected, (tents ? 2e-5 : 2e-3) + rounding_of(all[i])) << i;
    if (expected > 1e-3) ++touched;
  }
  EXPECT_GT(touched, 25);
}

// The weights of all texels about a parallelogram sum to its area.
TEST_P(ExactWeights, SumToTheArea) {
  const std::vector<Parallelogram> all = some_parallelograms();
  const auto sums = probe_exact(GetParam(),
                                "float sum = 0.0;\n"
                                "for (int y = -24; y <= 24; ++y)\n"
                                "  for (int x = -24; x <= 24; ++x) sum += texelShare(a.xy - vec2(x, y), "
                                "mat2(b.xy, b.zw));\nreturn vec4(sum);",
                                as_inputs(all));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double area = std::abs(glm::determinant(all[i].edges));
    EXPECT_NEAR(sums[i].x / area, 1.0, 1e-4 + 4.0 * rounding_of(all[i])) << i;
  }
}

// One that is seen edge-on, or is a point, is widened by no more than a 256th of a texel.
TEST_P(ExactWeights, OfALineAreThoseOfANarrowPixel) {
  const std::vector<Parallelogram> lines{{{0.3, 0.1}, {{0.0, 0.0}, {0.0, 0.0}}},
                                         {{0.3, 0.1}, {{0.4, 0.2}, {0.2, 0.1}}},
                                         {{0.0, 0.1}, {{0.0, 0.0}, {2.0, -1.0}}}};
  const auto shares = probe_exact(GetParam(),
                                  "mat2 edges = widened(mat2(b.xy, b.zw), narrowest_pixel);\n"
                                  "return vec4(texelShare(a.xy, edges) / abs(determinant(edges)), "
                                  "abs(determinant(edges)), 0.0, 0.0);",
                                  as_inputs(lines));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_NEAR(shares[i].x, summed_mean(lines[i], std::string(GetParam()) == "pixel"), 4e-3) << i;
    EXPECT_GT(shares[i].y, 1e-5) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, ExactWeights, ::testing::Values("pixel", "areas"));

// ---- NDF ----

Material bumpy(const Image& normals, Wrap wrap = Wrap::repeat) {
  Material material = square_scene(normals, {.brdf = blinn_phong}).materials[0];
  material.lobe_parameter = 40.0F;
  material.normal_map->coordinates.wrap = {wrap, wrap};
  return material;
}

// The NDF of `exact` over one material: its shader's, and that of the texels in double precision.
class NdfUnderExact {
 public:
  explicit NdfUnderExact(const Material& material, const std::string& text)
      : material_(material),
        scene_(scene_of_facets(material)),
        effects_(effects_on(derive_effects(scene_))),
        gpu_(shared_context().info(), scene_, effects_),
        baked_(bake(exact_method(), parse_methods(text).front(), scene_, effects_, no_progress)),
        ndf_(shared_context().info(), gpu_, baked_, scene_.materials.front(), FootprintFilter{}) {}

  [[nodiscard]] std::vector<float> of_shader(const FootprintRect& rect) const {
    return ndf_.densities(rect, grid_.directions);
  }
  [[nodiscard]] std::vector<double> of_texels(const FootprintRect& rect) const {
    return ReferenceNdf(material_.brdf.distribution, texels_under(material_, rect).facets)
        .densities(grid_.directions, no_progress);
  }

  // The largest difference, over the largest density.
  [[nodiscard]] static double difference(const std::vector<float>& a, const std::vector<double>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most / *std::ranges::max_element(b);
  }

 private:
  Material material_;
  Scene scene_;
  EffectSet effects_;
  GpuScene gpu_;
  BakedMethod baked_;
  MethodNdf ndf_;
  HemisphereGrid grid_ = footprint::hemisphere_grid(24);
};

// A facet may look as wide as the base lobe's own: 32 bits and the cut-off of the exact sum leave 1e-4 of the peak.
constexpr double rounding = 2e-4;

TEST(ExactNdf, OfAreasIsThatOfTheTexelsInTheRectangle) {
  const NdfUnderExact ndf(bumpy(random_normals(32, 20, 0.6F, 3)), "exact:kernel=areas");
  for (const FootprintRect& rect : {FootprintRect{{0.0, 0.0}, {1.0, 1.0}}, FootprintRect{{0.13, 0.2}, {0.51, 0.37}},
                                    FootprintRect{{-0.6, 0.9}, {1.7, 1.4}}, FootprintRect{{0.4, 0.4}, {0.41, 0.42}}}) {
    EXPECT_LT(NdfUnderExact::difference(ndf.of_shader(rect), ndf.of_texels(rect)), rounding) << rect.lower.x;
  }
}

// The exact NDF of another footprint is far from it: what the test above would see of a wrong weight.
TEST(ExactNdf, OfAreasIsNotThatOfARectangleThatLacksARow) {
  const NdfUnderExact ndf(bumpy(random_normals(32, 20, 0.6F, 3)), "exact:kernel=areas");
  const FootprintRect rect{{0.25, 0.2}, {0.5, 0.5}};
  EXPECT_GT(NdfUnderExact::difference(ndf.of_shader({rect.lower, {0.5, 0.45}}), ndf.of_texels(rect)), 50.0 * rounding);
}

// What trilinear filtering blends: the exact NDFs of eight texels, summed again.
std::vector<double> trilinear_ndf(const NdfUnderExact& ndf, const FootprintRect& rect, const glm::ivec2& size,
                                  Wrap wrap) {
  const double coarsest = std::floor(std::log2(std::max(size.x, size.y)));
  const double level = std::clamp(std::log2(std::max(rect.size().x * size.x, rect.size().y * size.y)), 0.0, coarsest);
  std::vector<double> sum;
  for (int i = 0; i < 8; ++i) {
    const double own = std::min(std::floor(level) + (i >> 2), coarsest);
    double weight = (i >> 2) != 0 ? level - std::floor(level) : 1.0 - (level - std::floor(level));
    FootprintRect texel;
    for (int axis = 0; axis < 2; ++axis) {
      const int texels = std::max(size[axis] >> static_cast<int>(own), 1);
      const double at = rect.centre()[axis] * texels - 0.5;
      const int side = (i >> axis) & 1;
      weight *= side != 0 ? at - std::floor(at) : 1.0 - (at - std::floor(at));
      double index = std::floor(at) + side;
      if (wrap == Wrap::clamp_to_edge) index = std::clamp(index, 0.0, texels - 1.0);
      texel.lower[axis] = index / texels;
      texel.upper[axis] = (index + 1.0) / texels;
    }
    if (weight <= 0.0) continue;
    const std::vector<double> part = ndf.of_texels(texel);
    if (sum.empty()) sum.assign(part.size(), 0.0);
    for (std::size_t k = 0; k < part.size(); ++k) sum[k] += weight * part[k];
  }
  return sum;
}

TEST(ExactNdf, OfTheFilterIsThatOfTheTexelsItBlends) {
  for (const glm::ivec2& size : {glm::ivec2(32, 32), glm::ivec2(64, 16), glm::ivec2(27, 14)}) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
      const NdfUnderExact ndf(bumpy(random_normals(size.x, size.y, 0.6F, 4), wrap), "exact");
      for (const FootprintRect& rect :
           {FootprintRect{{0.3, 0.42}, {0.45, 0.5}}, FootprintRect{{0.9, -0.1}, {1.3, 0.1}},
            FootprintRect{{0.5, 0.5}, {0.502, 0.501}}, FootprintRect{{-1.0, -1.0}, {2.0, 2.5}}}) {
        EXPECT_LT(NdfUnderExact::difference(ndf.of_shader(rect), trilinear_ndf(ndf, rect, size, wrap)), rounding)
            << size.x << " " << static_cast<int>(wrap) << " " << rect.lower.x;
      }
    }
  }
}

// An NDF with a texel of the wrong level differs.
TEST(ExactNdf, OfTheFilterIsNotThatOfAFinerLevel) {
  const NdfUnderExact ndf(bumpy(random_normals(32, 32, 0.6F, 4)), "exact");
  const FootprintRect rect{{0.3, 0.4}, {0.425, 0.5}};
  const FootprintRect narrower{{0.33, 0.42}, {0.395, 0.48}};
  EXPECT_GT(NdfUnderExact::difference(ndf.of_shader(rect), trilinear_ndf(ndf, narrower, {32, 32}, Wrap::repeat)),
            50.0 * rounding);
}

// ---- pictures ----

// A square under a light and a camera that are infinitely far: all of a pixel is lit and seen alike, and nothing but
// the kernel is left. `side` metres of it are seen; its map is there once in two metres.
Scene flat_quad(const Image& normals, float side, float turn = 0.3F, float tilt = 0.6F) {
  Scene scene = square_scene(normals, {.brdf = blinn_phong, .specular = glm::vec3(0.6F)});
  scene.materials[0].lobe_parameter = 30.0F;
  for (Vertex& vertex : scene.meshes[0].vertices) vertex.uv0 = (vertex.uv0 - 0.5F) * 20.0F + 0.5F;
  for (Vertex& vertex : scene.meshes[0].vertices) vertex.position *= 20.0F;
  const glm::dvec3 towards(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
  scene.camera.world = look_at(100.0 * towards, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  scene.camera.orthographic = true;
  scene.camera.ymag = 0.5F * side;
  scene.lights.clear();
  scene.lights.emplace_back(
      DirectionalLight{.direction = glm::normalize(glm::vec3(-0.3F, 0.2F, -1.0F)), .illuminance = glm::vec3(1.0F)});
  return scene;
}

// How far a picture is from the reference, over the reference's standard error and what 32 bits leave of the weights;
// as root mean squares over pixels and colours. 1 if they differ only by noise, less because samples are stratified.
double deviations(const Image& picture, const Supersampled& reference) {
  constexpr double rounding_of_weights = 3e-4;  // ExactWeights.AreThoseOfASumOverPoints
  double difference = 0.0, noise = 0.0;
  for (std::size_t i = 0; i < picture.texel_count(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      difference += std::pow(picture.texels[4 * i + c] - reference.mean.texels[4 * i + c], 2);
      noise += std::pow(reference.standard_error.texels[3 * i + c], 2) +
               std::pow(rounding_of_weights * reference.mean.texels[4 * i + c], 2);
    }
  }
  return std::sqrt(difference / noise);
}

constexpr glm::ivec2 quad_size{24, 24};
// Five standard deviations of this figure over 576 pixels above 1.
constexpr double within_noise = 1.15;

double deviations_of(const Scene& scene, const std::string& text) {
  TestRenderer renderer(scene, quad_size);
  return deviations(renderer.frame(exact_method(), text), renderer.reference(1024, 3));
}

// Pixels from a fiftieth of a texel wide to twelve texels.
class ExactOnAFlatQuad : public ::testing::TestWithParam<float> {};

TEST_P(ExactOnAFlatQuad, MeetsTheReferenceWithinItsNoise) {
  EXPECT_LT(deviations_of(flat_quad(random_normals(32, 32, 0.7F, 5), GetParam()), "exact:kernel=pixel"), within_noise);
}

TEST_P(ExactOnAFlatQuad, MeetsItWithARoughnessMapOfTheSameTexels) {
  Scene scene = flat_quad(random_normals(32, 32, 0.5F, 6), GetParam());
  scene.materials[0].lobe_parameter.reset();
  auto roughness = std::make_shared<Image>(32, 32, 2);
  std::mt19937 random(8);
  for (float& texel : roughness->texels) texel = 0.3F + 0.5F * static_cast<float>(random()) / 4294967296.0F;
  scene.materials[0].metallic_roughness_map = TextureMap{"roughness", roughness, {}};
  for (std::size_t i = 1; i < roughness->texels.size(); i += 2) roughness->texels[i] = 0.0F;
  EXPECT_LT(deviations_of(scene, "exact:kernel=pixel"), within_noise);
}

INSTANTIATE_TEST_SUITE_P(Widths, ExactOnAFlatQuad, ::testing::Values(0.03F, 0.3F, 1.0F, 1.6F, 4.0F, 18.0F));

// Maps that end, and those that are mirrored, at their borders.
TEST(Exact, MeetsTheReferenceAtTheBordersOfMaps) {
  for (const Wrap wrap : {Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    Scene scene = flat_quad(random_normals(16, 16, 0.7F, 7), 6.0F);
    scene.materials[0].normal_map->coordinates.wrap = {wrap, Wrap::repeat};
    EXPECT_LT(deviations_of(scene, "exact:kernel=pixel"), within_noise) << static_cast<int>(wrap);
  }
}

// Texels without a normal count in neither.
TEST(Exact, MeetsTheReferenceWhereTexelsHaveNoNormal) {
  Image normals = random_normals(16, 16, 0.7F, 7);
  for (int i = 0; i < 16; ++i) normals.at((5 * i) % 16, i)[3] = 0.0F;
  EXPECT_LT(deviations_of(flat_quad(normals, 5.0F), "exact:kernel=pixel"), within_noise);
}

// What the tests above would see of wrong weights: clipped areas where texels are large, the footprint filter's where
// they are small, the pixel of a neighbour anywhere.
TEST(Exact, WrongWeightsAreFarOutsideTheNoise) {
  const Scene near = flat_quad(random_normals(32, 32, 0.7F, 5), 1.0F);
  EXPECT_GT(deviations_of(near, "exact:kernel=areas"), 5.0);
  EXPECT_GT(deviations_of(near, "exact:kernel=filter"), 2.0);
  EXPECT_GT(deviations_of(flat_quad(random_normals(32, 32, 0.7F, 5), 4.0F), "exact:kernel=filter"), 4.0);
  TestRenderer renderer(flat_quad(random_normals(32, 32, 0.7F, 5), 4.0F), quad_size);
  Image moved = renderer.frame(exact_method(), "exact:kernel=pixel");
  std::ranges::rotate(moved.texels, moved.texels.begin() + 4);
  EXPECT_GT(deviations(moved, renderer.reference(1024, 3)), 4.0);
}

// Maps of other sizes and coordinates: a roughness of finer texels, then turned and shifted too, a layer that repeats.
// The reference draws a texel of each map for itself, which is the same to a part of a texel's width alone.
TEST(Exact, IsNearTheReferenceWithMapsOfTheirOwnCoordinates) {
  Scene scene = flat_quad(random_normals(16, 16, 0.5F, 9), 8.0F);
  scene.materials[0].lobe_parameter.reset();
  auto roughness = std::make_shared<Image>(64, 32, 2);
  std::mt19937 random(14);
  for (std::size_t i = 0; i < roughness->texels.size(); i += 2)
    roughness->texels[i] = 0.35F + 0.4F * static_cast<float>(random()) / 4294967296.0F;
  scene.materials[0].metallic_roughness_map = TextureMap{"roughness", roughness, {}};
  const Image aligned = TestRenderer(scene, quad_size).frame(exact_method(), "exact:kernel=pixel");
  const auto difference = [](const Image& picture, const Scene& of) {
    return compare_images(picture, TestRenderer(of, quad_size).reference(1024, 3).mean, 1.0F).value().relative_rmse;
  };
  EXPECT_LT(difference(aligned, scene), 0.045);
  scene.materials[0].metallic_roughness_map->coordinates.transform = {0.9F, 0.3F, -0.2F, 1.4F, 0.13F, 0.4F};
  EXPECT_LT(difference(TestRenderer(scene, quad_size).frame(exact_method(), "exact:kernel=pixel"), scene), 0.045);
  // The same roughness elsewhere differs.
  EXPECT_GT(difference(aligned, scene), 0.06);

  TextureMap layer{"layer", std::make_shared<const Image>(random_normals(16, 16, 0.4F, 10)), {}};
  layer.coordinates.transform = glm::mat3x2{2.0F, 0.0F, 0.0F, 2.0F, 0.0F, 0.0F};
  Scene layered = flat_quad(random_normals(32, 32, 0.5F, 9), 8.0F);
  layered.materials[0].layer_map = layer;
  EXPECT_LT(deviations_of(layered, "exact:kernel=pixel"), within_noise);
}

// A glTF facet under it is the reference's: GGX, Smith, Schlick, facets that face away from light and viewer.
TEST(Exact, TermsAreTheBaseBrdfs) {
  for (const BaseBrdf& brdf : {BaseBrdf{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true},
                               BaseBrdf{NormalDistribution::beckmann, GeometryTerm::tan, FresnelTerm::schlick, true},
                               BaseBrdf{NormalDistribution::vmf, GeometryTerm::none, FresnelTerm::none, false}}) {
    Scene scene = flat_quad(random_normals(32, 32, 0.98F, 11), 5.0F, 0.7F, 1.1F);
    scene.materials[0].brdf = brdf;
    scene.materials[0].lobe_parameter.reset();
    EXPECT_LT(deviations_of(scene, "exact:kernel=pixel"), within_noise) << static_cast<int>(brdf.distribution);
  }
}

// Blinn-Phong of exponent 30 and Lambert, of one texel.
double facet_radiance(std::span<const float> texel, const glm::dvec3& to_light) {
  constexpr double pi = 3.14159265358979;
  const glm::dvec3 normal(texel[0], texel[1], texel[2]);
  const glm::dvec3 h = glm::normalize(to_light + glm::dvec3(0.0, 0.0, 1.0));
  return 0.6 * 31.0 / (2.0 * pi) * std::pow(std::max(glm::dot(normal, h), 0.0), 30.0) +
         0.5 / pi * std::max(glm::dot(normal, to_light), 0.0);
}

// The mean over a pixel of `width` texels about `centre` of what its texels reflect, blended by bilinear weights.
double summed_pixel(const Image& normals, const glm::dvec2& centre, double width, const glm::dvec3& to_light) {
  constexpr int points = 400;
  double sum = 0.0;
  for (int j = 0; j < points; ++j) {
    for (int i = 0; i < points; ++i) {
      const glm::dvec2 at = centre + ((glm::dvec2(i, j) + 0.5) / static_cast<double>(points) - 0.5) * width - 0.5;
      const glm::ivec2 corner = glm::floor(at);
      for (int k = 0; k < 4; ++k) {
        const glm::ivec2 texel = corner + glm::ivec2(k & 1, k >> 1);
        const double weight = (1.0 - std::abs(at.x - texel.x)) * (1.0 - std::abs(at.y - texel.y));
        const glm::ivec2 wrapped = (texel + 64 * normals.width) % normals.width;
        sum += weight * facet_radiance(normals.at(wrapped.x, wrapped.y), to_light);
      }
    }
  }
  return sum / (points * points);
}

// In doubles, with nothing of the shader's: pixels of a square seen from straight above.
TEST(Exact, IsTheSumInDoubles) {
  const Image normals = random_normals(32, 32, 0.7F, 12);
  for (const float side : {0.3F, 3.0F, 18.0F}) {
    const Scene scene = flat_quad(normals, side, 0.0F, 0.0F);
    const Image picture = TestRenderer(scene, quad_size).frame(exact_method(), "exact:kernel=pixel");
    const double width = static_cast<double>(side) / quad_size.x / 2.0 * normals.width;
    for (const glm::ivec2 pixel : {glm::ivec2(0, 0), glm::ivec2(5, 17), glm::ivec2(23, 11)}) {
      // v points down, as rows of a picture do.
      const glm::dvec2 centre = 16.0 + (glm::dvec2(pixel) + 0.5 - 12.0) * width;
      const double expected = summed_pixel(normals, centre, width, -glm::normalize(glm::dvec3(-0.3F, 0.2F, -1.0F)));
      EXPECT_NEAR(picture.at(pixel.x, pixel.y)[0] / expected, 1.0, 1e-3) << side << " " << pixel.x;
    }
  }
}

// From how wide a pixel on clipped areas are good enough: the README's figures.
TEST(Exact, AreasComeNearAsPixelsGrow) {
  const auto difference = [](float width) {
    TestRenderer renderer(flat_quad(random_normals(128, 128, 0.7F, 5), width * 24.0F / 128.0F * 2.0F), quad_size);
    const Image pixel = renderer.frame(exact_method(), "exact:kernel=pixel");
    return compare_images(renderer.frame(exact_method(), "exact:kernel=areas"), pixel, 1.0F).value().relative_rmse;
  };
  EXPECT_GT(difference(1.0F), 0.1);
  EXPECT_LT(difference(8.0F), 0.01);
  EXPECT_LT(difference(32.0F), 0.0015);
}

// More texels than are summed: one of each cell is drawn, and stays near the whole sum.
TEST(Exact, DrawnTexelsStandForAllOfThem) {
  for (const char* const kernel : {"filter", "pixel"}) {
    TestRenderer renderer(flat_quad(random_normals(64, 64, 0.5F, 13), 48.0F), quad_size);
    const std::string text = std::string("exact:kernel=") + kernel;
    const Image all = renderer.frame(exact_method(), text + ":texels=256");
    const Image most = renderer.frame(exact_method(), text + ":texels=32");
    const Image few = renderer.frame(exact_method(), text + ":texels=8");
    const auto error = [&](const Image& picture) { return compare_images(picture, all, 1.0F).value().relative_rmse; };
    EXPECT_GT(error(most), 1e-5) << kernel;
    EXPECT_LT(error(most), 0.1) << kernel;
    EXPECT_LT(error(few), 0.4) << kernel;
    EXPECT_LT(error(most), error(few)) << kernel;
  }
}

// ---- under an environment ----

Scene under_an_environment(const Image& normals, float side, const BaseBrdf& brdf) {
  Scene scene = flat_quad(normals, side);
  scene.materials[0].brdf = brdf;
  scene.materials[0].lobe_parameter.reset();
  scene.materials[0].roughness = 0.4F;
  scene.lights.clear();
  auto map = std::make_shared<Image>(32, 16, 3);
  for (std::size_t i = 0; i < map->texels.size(); ++i) map->texels[i] = 0.2F + static_cast<float>(i * i % 97) / 97.0F;
  scene.environment = Environment{.name = "uneven", .radiance = map, .rotation = 0.7F};
  return scene;
}

// Means over squares of `side` pixels.
Image mean_over_squares(const Image& picture, int side) {
  Image out(picture.width / side, picture.height / side, 4);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (std::size_t c = 0; c < 4; ++c)
        out.at(x / side, y / side)[c] += picture.at(x, y)[c] / static_cast<float>(side * side);
    }
  }
  return out;
}

// Seen along the normal, a pixel of `direct` shows a texel, and one of `exact` four by four of those.
TEST(ExactUnderAnEnvironment, IsTheMeanOverTexelsOfDirect) {
  for (const BaseBrdf& brdf : {BaseBrdf{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true},
                               BaseBrdf{NormalDistribution::vmf, GeometryTerm::none, FresnelTerm::none, false}}) {
    Scene scene = under_an_environment(random_normals(32, 32, 0.7F, 5), 2.0F, brdf);
    scene.camera.world = look_at({0.0, 0.0, 100.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    const Image texels = TestRenderer(scene, {32, 32}).frame(base_surface());
    const Image expected = mean_over_squares(texels, 4);
    TestRenderer renderer(scene, {8, 8});
    for (const std::string text : {"exact:kernel=areas", "exact"})
      EXPECT_LT(compare_images(renderer.frame(exact_method(), text), expected, 1.0F).value().relative_rmse, 1e-3)
          << text << " " << static_cast<int>(brdf.distribution);
    EXPECT_GT(compare_images(renderer.frame(base_surface()), expected, 1.0F).value().relative_rmse, 0.05);
  }
}

// What the lookup by lobes is off by, and no more.
TEST(ExactUnderAnEnvironment, IsNearTheReference) {
  constexpr BaseBrdf brdf{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true};
  TestRenderer renderer(under_an_environment(random_normals(32, 32, 0.7F, 5), 4.0F, brdf), quad_size);
  const Image reference = renderer.reference(256).mean;
  EXPECT_LT(compare_images(renderer.frame(exact_method(), "exact:kernel=pixel"), reference, 1.0F).value().relative_rmse,
            0.05);
}

// Whether the driver ends loops after 65535 rounds, as llvmpipe of Mesa 22.3 does and that of 25.0 does not.
bool ends_loops() { return shared_context().info().version.find("Mesa 22.") != std::string::npos; }

// A pixel of which the driver leaves texels out must not pass for the sum of all.
TEST(Exact, IsNeverAPartOfTheSum) {
  const Scene scene = flat_quad(random_normals(256, 256, 0.5F, 13), 12.0F);
  Scene many = scene;
  many.lights.resize(24, scene.lights[0]);
  for (const std::string text : {"exact:texels=512:kernel=filter", "exact:texels=512:kernel=pixel"}) {
    const Image once = TestRenderer(scene, {4, 4}).frame(exact_method(), text);
    const Image all = TestRenderer(many, {4, 4}).frame(exact_method(), text);
    int left_out = 0;
    for (std::size_t i = 0; i < all.texels.size(); i += 4) {
      if (!std::isfinite(all.texels[i])) {
        ++left_out;
        continue;
      }
      EXPECT_NEAR(all.texels[i] / once.texels[i], 24.0, 0.01) << text;
    }
    EXPECT_EQ(left_out > 0, ends_loops()) << text << ": pixels that were left out: " << left_out;
  }
}

}  // namespace
}  // namespace footprint::testing
