// The frame build's map against a sum in double precision, its conversions and mixtures against golden numbers, and the
// density that comes of them.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/method.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& xu_vmf_method();
namespace embedded {
extern const std::string_view xu_vmf_conversion_glsl;
}
}  // namespace footprint

namespace footprint::testing {
namespace {

using Words = std::map<std::string, std::string>;
using Inputs = std::vector<std::array<glm::vec4, 3>>;

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};

Material material_of(const Image& normals, float exponent) {
  Material material = square_scene(normals, {.brdf = blinn_phong}).materials[0];
  material.lobe_parameter = exponent;
  return material;
}

Material material_with_roughness(const Image& normals, Image roughness) {
  Material material = square_scene(normals, {.brdf = blinn_phong}).materials[0];
  Image map(roughness.width, roughness.height, 2, 0.0F);  // roughness, metallic
  for (std::size_t i = 0; i < roughness.texels.size(); ++i) map.texels[2 * i] = roughness.texels[i];
  material.metallic_roughness_map = TextureMap{"roughness", std::make_shared<const Image>(std::move(map)), {}};
  return material;
}

EffectSet effects_of(const Material& material) {
  EffectSet set;
  set.set(static_cast<std::size_t>(Effect::normal_variation));
  if (material.metallic_roughness_map) set.set(static_cast<std::size_t>(Effect::roughness_variation));
  return set;
}

Scene scene_of(const Material& material) {
  Scene scene = square_scene(Image(), {.brdf = material.brdf});
  scene.materials[0] = material;
  return scene;
}

// A material with its map, built by the method's own passes.
class BuiltMap {
 public:
  explicit BuiltMap(const Material& material, const Words& words = {})
      : material_(material),
        options_(xu_vmf_method().info().options, words, "xu_vmf"),
        variant_{.effects = effects_of(material), .brdf = material.brdf},
        scene_(shared_context().info(), scene_of(material), variant_.effects),
        baked_(xu_vmf_method().precompute(material, options_, variant_.effects, no_progress)),
        build_(xu_vmf_method().frame_build(variant_, options_)) {
    for (const PrefilteredTexture& texture : baked_.textures) textures_.push_back(upload(texture));
    run(scene_.batches().front());
  }

  // Builds once more, with the material block of `batch`.
  void run(const GpuBatch& batch) const {
    constexpr GLbitfield whole = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT;
    gl::api().MemoryBarrier(whole);
    const View view{};
    build_->run({.batch = batch,
                 .vertex_array = batch.vertex_array.name(),
                 .baked = baked_,
                 .textures = textures_,
                 .view = view});
    gl::api().MemoryBarrier(whole | GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  [[nodiscard]] const GpuBatch& batch() const { return scene_.batches().front(); }
  [[nodiscard]] const Prefiltered& baked() const { return baked_; }

  // One level of all layers of a texture, layer after layer below each other.
  [[nodiscard]] Image level(std::string_view name, std::size_t index) const {
    const auto found = std::ranges::find(baked_.textures, name, &PrefilteredTexture::name);
    Image out(found->levels.at(index).width, found->levels.at(index).height * found->layers, found->channels);
    gl::api().GetTextureImage(textures_.at(static_cast<std::size_t>(found - baked_.textures.begin())).texture.name(),
                              static_cast<GLint>(index), found->channels == 4 ? GL_RGBA : GL_RED, GL_FLOAT,
                              static_cast<GLsizei>(out.texels.size() * sizeof(float)), out.texels.data());
    shared_context().check("reading a map");
    return out;
  }

  // Evaluates `body` over `inputs`, with `Effective e` of a footprint over the whole map.
  [[nodiscard]] std::vector<glm::vec4> probe(const std::string& body, const Inputs& inputs) const {
    std::string text;
    for (GLuint unit = 0; unit < textures_.size(); ++unit) {
      gl::api().BindTextureUnit(unit, textures_[unit].texture.name());
      gl::api().BindSampler(unit, samplers_.sampler(textures_[unit].coordinates, Lookup::trilinear));
      const PrefilteredTexture& texture = baked_.textures[unit];
      text += fmt::format("layout(binding = {}) uniform sampler2D{} {};\n", unit, texture.layers > 0 ? "Array" : "",
                          texture.name);
    }
    ShaderFlags flags = shader_flags(variant_, options_);
    flags.merge(texture_flags(baked_));
    text += fmt::format(
        "const vec4 lobe_cutoff = vec4({:e});\nconst float option_eps0 = {:e};\nconst float option_eps1 = {:e};\n",
        lobe_parameter(material_), options_.number("eps0"), options_.number("eps1"));
    text += shared_functions(flags) + select_text(xu_vmf_method().shader(), flags, "xu_vmf.glsl");
    const std::string footprint =
        "Footprint whole_map = Footprint(vec2(0.5), vec2(1.0, 0.0), vec2(0.0, 1.0));\n"
        "Effective e = effective(Footprints(whole_map, whole_map, whole_map));\n";
    std::vector<glm::vec4> out = evaluate_glsl(text, footprint + body, inputs);
    shared_context().check("probing a map");
    return out;
  }

  // Energy over the upper hemisphere.
  [[nodiscard]] double energy() const {
    const std::vector<double> density = densities(hemisphere_grid(128, 256));
    double sum = 0;
    for (const double d : density) sum += d;
    return sum * 2.0 * std::numbers::pi / static_cast<double>(density.size());
  }

  [[nodiscard]] std::vector<double> densities(const std::vector<glm::dvec3>& directions) const {
    Inputs inputs;
    for (const glm::dvec3& h : directions) inputs.push_back({glm::vec4(glm::vec3(h), 0), glm::vec4(0), glm::vec4(0)});
    std::vector<double> out;
    for (const glm::vec4& value : probe("return vec4(ndf(e, a.xyz));", inputs)) out.push_back(value.x);
    return out;
  }

 private:
  Material material_;
  Options options_;
  ShaderVariant variant_;
  GpuScene scene_;
  Prefiltered baked_;
  std::unique_ptr<FrameBuild> build_;
  std::vector<GpuTexture> textures_;
  mutable SamplerCache samplers_;
};

struct Lobe {
  double share;
  glm::dvec3 mean;
  double kappa;
};

std::vector<Lobe> lobes_of(const BuiltMap& map) {
  Inputs inputs;
  for (int i = 0; i < 8; ++i) {
    for (const float what : {0.0F, 1.0F}) inputs.push_back({glm::vec4(static_cast<float>(i)), glm::vec4(what), {}});
  }
  const auto got = map.probe(
      "int i = int(a.x);\nif (i >= e.count) return vec4(0.0);\n"
      "return b.x == 0.0 ? vec4(e.mean[i], e.share[i]) : vec4(e.kappa[i]);",
      inputs);
  std::vector<Lobe> lobes;
  for (std::size_t i = 0; i < got.size(); i += 2) {
    if (got[i].w > 0.0F) lobes.push_back({got[i].w, glm::dvec3(glm::vec3(got[i])), got[i + 1].x});
  }
  return lobes;
}

std::vector<glm::vec4> converted(const std::string& body, const Inputs& inputs) {
  ShaderVariant variant;
  variant.brdf = blinn_phong;
  const ShaderFlags flags = shader_flags(variant, Options({}, {}, "test"));
  return evaluate_glsl(shared_functions(flags) + select_text(embedded::xu_vmf_conversion_glsl, flags, "conversion"),
                       body, inputs);
}

// Equation 9 in q by bisection in double precision.
double shortfall_twin(double kappa) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 200; ++i) {
    const double q = 0.5 * (low + high);
    (q * q * q + (kappa - 3.0) * q * q - 2.0 * kappa * q + 2.0 > 0.0 ? low : high) = q;
  }
  return low;
}

Inputs kappas(double first, double last, int count) {
  Inputs inputs;
  for (int i = 0; i < count; ++i) {
    const double kappa = first * std::pow(last / first, static_cast<double>(i) / (count - 1));
    inputs.push_back({glm::vec4(static_cast<float>(kappa)), glm::vec4(0), glm::vec4(0)});
  }
  return inputs;
}

// 1 - |r| of the golden cubic, computed to 40 digits.
TEST(XuConversion, MeetsTheGoldenRoots) {
  const std::vector<std::pair<float, double>> golden{
      {1e-3F, 0.99966666669135802195},     {0.1F, 0.9666913306203034294},      {1.0F, 0.68889218253401810007},
      {2.0F, 0.47068341987116060739},      {5.0F, 0.2097187775373719208},      {10.0F, 0.10382913790591307894},
      {50.0F, 0.020191703623313614892},    {128.0F, 0.0078425337866485061951}, {512.0F, 0.0019550248707961608454},
      {1000.0F, 0.0010004989981260065655}, {1e4F, 0.00010000499899981251001},  {1e5F, 0.00001000004999899998125},
      {1e6F, 1.0000004999989999981e-6}};
  Inputs inputs;
  for (const auto& [kappa, q] : golden) inputs.push_back({glm::vec4(kappa), glm::vec4(0), glm::vec4(0)});
  const auto got = converted("return vec4(shortfallOf(a.x));", inputs);
  for (std::size_t i = 0; i < golden.size(); ++i) {
    EXPECT_NEAR(got[i].x / golden[i].second, 1.0, 1e-6) << golden[i].first;
    EXPECT_NEAR(shortfall_twin(golden[i].first) / golden[i].second, 1.0, 1e-7) << golden[i].first;
  }
}

TEST(XuConversion, KappaComesBack) {
  const Inputs inputs = kappas(1e-2, 1e5, 4001);
  const auto got = converted("return vec4(kappaOf(shortfallOf(a.x)));", inputs);
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i].x / inputs[i][0].x, 1.0F, 1e-4F) << inputs[i][0].x;
}

TEST(XuConversion, IsFiniteForEveryKappa) {
  Inputs inputs = kappas(1e-30, 1e6, 2001);
  inputs.push_back({glm::vec4(0), glm::vec4(0), glm::vec4(0)});
  for (const glm::vec4& got :
       converted("float q = shortfallOf(a.x); float k = kappaOf(clamp(q, 5e-7, 1.0)); float s = lobeOfKappa(k);\n"
                 "return vec4(q, k, s, lobeDensity(s, vec3(0, 0, 1), vec3(0, 0.6, 0.8)));",
                 inputs)) {
    for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(got[c]) && got[c] >= 0.0F) << c;
    EXPECT_LE(got.x, 1.0F);
  }
}

// The golden `four_texel_vector.xu_mixture`: an exponent of 100 over four normals.
TEST(XuMixture, IsTheGoldenOne) {
  const Lobe whole{1.0, {0.08829140104321008, -0.16554637695601893, 0.9822418366057123}, 10.08583615695044};
  const Lobe pair{0.5, {0.31622776601683794, 0.0, 0.9486832980505139}, 16.88308542566846};
  const Lobe left{0.25, {-0.28, 0.0, 0.96}, 101.0};
  const Lobe down{0.25, {0.0, -0.6, 0.8}, 101.0};
  const Lobe up{0.25, {0.0, 0.0, 1.0}, 101.0};
  const Lobe right{0.25, {0.6, 0.0, 0.8}, 101.0};
  const std::vector<std::pair<std::string, std::vector<Lobe>>> golden{
      {"1", {whole}}, {"4", {pair, left, down}}, {"8", {up, right, left, down}}};
  for (const auto& [j, expected] : golden) {
    const std::vector<Lobe> got = lobes_of(BuiltMap(material_of(four_texel_normals(), 100), {{"j", j}}));
    ASSERT_EQ(got.size(), expected.size()) << j;
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_NEAR(got[i].share, expected[i].share, 1e-6) << j;
      EXPECT_LT(glm::length(got[i].mean - expected[i].mean), 1e-5) << j;
      EXPECT_NEAR(got[i].kappa / expected[i].kappa, 1.0, 2e-4) << j;
    }
  }
}

// |r| of the whole is 0.89 < 0.95: it is subdivided. That of the pair is 0.94: above 0.85 it stays, above 0.95 not.
TEST(XuMixture, SubdividesWhereThresholdsSay) {
  const Material material = material_of(four_texel_normals(), 100);
  EXPECT_EQ(lobes_of(BuiltMap(material, {{"eps0", "0.85"}})).size(), 1U);
  EXPECT_EQ(lobes_of(BuiltMap(material)).size(), 3U);
  EXPECT_EQ(lobes_of(BuiltMap(material, {{"eps1", "0.95"}})).size(), 4U);
}

// The part that a normal lies in, written once more by angles.
int cell_twin(const glm::dvec3& n, bool azimuth) {
  const double radius = std::hypot(n.x, n.y);
  const double angle = std::atan2(n.y, n.x);
  if (!azimuth)
    return 2 * std::min(static_cast<int>(radius / 0.25), 3) + (std::abs(angle) <= std::numbers::pi / 2 ? 0 : 1);
  const int sector = (static_cast<int>(std::lround(angle / (std::numbers::pi / 2))) + 4) % 4;
  return 2 * sector + (radius < 0.5 ? 0 : 1);
}

struct MapCase {
  std::string j;
  bool azimuth;
};

class XuMap : public ::testing::TestWithParam<MapCase> {};

Image checked_normals() {
  Image normals = random_normals(13, 7, 0.9F, 11);
  for (int x = 0; x < 5; ++x) normals.at(x, 3)[3] = 0.0F;
  std::ranges::fill(normals.at(6, 2), 0.0F);
  return normals;
}

// (r, 1) of the texels of a map with a roughness map: of all, and of those whose lobes lie in each of 8 cells.
std::vector<Image> finest_twin(const Image& normals, const Image& roughness, bool azimuth) {
  std::vector<Image> out(9, Image(normals.width, normals.height, 4, 0.0F));
  for (int y = 0; y < normals.height; ++y) {
    for (int x = 0; x < normals.width; ++x) {
      const auto texel = normals.at(x, y);
      if (texel[3] < 0.5F) continue;
      const glm::dvec3 n = glm::normalize(glm::dvec3(texel[0], texel[1], texel[2]));
      const double alpha = std::pow(roughness.at(x, y)[0], 2.0);
      const glm::dvec3 r = (1.0 - shortfall_twin(2.0 / (alpha * alpha) - 1.0)) * n;  // kappa = s + 1
      for (const std::size_t layer : {0, 1 + cell_twin(n, azimuth)}) {
        const auto value = out[layer].at(x, y);
        for (int c = 0; c < 3; ++c) value[static_cast<std::size_t>(c)] = static_cast<float>(r[c]);
        value[3] = 1.0F;
      }
    }
  }
  return out;
}

void expect_levels(const BuiltMap& map, std::string_view name, const std::vector<Image>& layers, std::size_t first,
                   float tolerance) {
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    const std::vector<Image> chain = mip_chain(layers[layer]);
    for (std::size_t level = first; level < chain.size(); ++level) {
      const Image got = map.level(name, level - first);
      const Image& want = chain[level];
      for (std::size_t i = 0; i < want.texels.size(); ++i)
        EXPECT_NEAR(got.texels[layer * want.texels.size() + i], want.texels[i], tolerance) << layer << ", " << level;
    }
  }
}

// Every level of every layer of a map of odd sizes with holes and a roughness map: the mean of (r, 1) over the texels
// under it, so that (xyz / w) is the mean of the covered ones.
TEST_P(XuMap, HoldsTheMeansOfTheCoveredTexels) {
  const auto& [j, azimuth] = GetParam();
  const Image normals = checked_normals();
  Image roughness(13, 7, 1);
  for (std::size_t i = 0; i < roughness.texels.size(); ++i)
    roughness.texels[i] = 0.2F + 0.7F * static_cast<float>(i % 9) / 9.0F;
  const Words words{{"j", j}, {"partition", azimuth ? "azimuth" : "latitude"}};
  const std::vector<Image> finest = finest_twin(normals, roughness, azimuth);
  std::vector<Image> parts(finest.begin() + 1, finest.end());
  if (j == "4") {
    for (std::size_t i = 0; i < 4; ++i) {
      std::ranges::transform(parts[2 * i].texels, parts[2 * i + 1].texels, parts[i].texels.begin(), std::plus());
    }
    parts.resize(4);
  }
  for (const bool half : {false, true}) {
    Words stored = words;
    if (half) stored["storage"] = "fp16";
    const BuiltMap map(material_with_roughness(normals, roughness), stored);
    const float tolerance = half ? 1e-3F : 1e-5F;  // rounded to half floats at each of 3 levels
    if (j == "1" || j == "adaptive") expect_levels(map, "xu_vmf_whole", {finest[0]}, 0, tolerance);
    if (j != "1") expect_levels(map, "xu_vmf_parts", parts, 1, tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(All, XuMap,
                         ::testing::Values(MapCase{"1", true}, MapCase{"4", true}, MapCase{"8", true},
                                           MapCase{"adaptive", true}, MapCase{"4", false}, MapCase{"8", false},
                                           MapCase{"adaptive", false}),
                         [](const auto& test) {
                           return "j_" + test.param.j + (test.param.azimuth ? "_azimuth" : "_latitude");
                         });

// Hard case 19: a map that is half empty has the lobes of its other half, at full energy; an empty one is flat.
TEST(XuMixture, CountsCoveredTexelsAlone) {
  Image half = constant_normals(8, 8, {0.28F, 0, 0.96F});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 4; ++x) half.at(x, y)[3] = 0.0F;
  for (const std::string j : {"1", "4", "8", "adaptive"}) {
    const std::vector<Lobe> lobes = lobes_of(BuiltMap(material_of(half, 100), {{"j", j}}));
    ASSERT_EQ(lobes.size(), 1U);
    EXPECT_NEAR(lobes[0].share, 1.0, 1e-6);
    EXPECT_LT(glm::length(lobes[0].mean - glm::dvec3(0.28, 0, 0.96)), 1e-5);
    EXPECT_NEAR(lobes[0].kappa, 101.0, 0.01);
  }
  Image empty = half;
  for (std::size_t i = 3; i < empty.texels.size(); i += 4) empty.texels[i] = 0.0F;
  const std::vector<Lobe> flat = lobes_of(BuiltMap(material_of(empty, 100)));
  ASSERT_EQ(flat.size(), 1U);
  EXPECT_NEAR(flat[0].mean.z, 1.0, 1e-6);
  EXPECT_NEAR(flat[0].kappa, 101.0, 0.01);
}

// Hard case 8 in 32-bit floats: kappa of a constant map, which comes back through |r| alone.
TEST(XuMixture, KeepsKappaOverAConstantMap) {
  for (const float kappa : {2.0F, 50.0F, 512.0F, 1e4F, 1e5F}) {
    const BuiltMap map(material_of(constant_normals(16, 16, {0.28F, -0.1F, 0.95F}), kappa - 1.0F));
    for (const Lobe& lobe : lobes_of(map)) EXPECT_NEAR(lobe.kappa / kappa, 1.0, 0.01) << kappa;
  }
}

TEST(XuDensity, HasUnitEnergyButAsPublished) {
  const Material material = material_of(random_normals(16, 16, 0.65F, 12), 300);
  for (const std::string lobe : {"base", "vmf"}) {
    for (const std::string partition : {"azimuth", "latitude"}) {
      for (const std::string j : {"1", "4", "8", "adaptive"}) {
        const Words words{{"j", j}, {"partition", partition}, {"lobe", lobe}};
        EXPECT_NEAR(BuiltMap(material, words).energy(), 1.0, 0.01) << j << partition << lobe;
      }
    }
  }
  for (const std::string j : {"1", "4", "8"}) {
    const BuiltMap published(material, {{"j", j}, {"variant", "published"}});
    EXPECT_NEAR(published.energy() / static_cast<double>(lobes_of(published).size()), 1.0, 0.01) << j;
    EXPECT_EQ(lobes_of(published).size(), static_cast<std::size_t>(std::stoi(j)));
  }
}

double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// V-grooves: two slopes. Four sectors hold one each and are exact; one lobe and rings lie between them.
TEST(XuDensity, SeparatesTheSidesOfGrooves) {
  Image grooves = constant_normals(8, 8, {0.6F, 0, 0.8F});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 4; ++x) grooves.at(x, y)[0] = -0.6F;
  const double s = 200;
  const std::vector<glm::dvec3> directions = hemisphere_grid(64, 128);
  std::vector<double> truth;
  for (const glm::dvec3& h : directions) {
    double sum = 0;
    for (const double x : {-0.6, 0.6}) sum += std::pow(std::max(glm::dot(glm::dvec3(x, 0, 0.8), h), 0.0), s);
    truth.push_back(0.5 * (s + 1) / (2 * std::numbers::pi) * sum);
  }
  const std::vector<double> nothing(truth.size(), 0.0);
  const auto error = [&](const Words& words) {
    const BuiltMap map(material_of(grooves, static_cast<float>(s)), words);
    return std::sqrt(squared_distance(map.densities(directions), truth) / squared_distance(truth, nothing));
  };
  EXPECT_LT(error({{"j", "4"}}), 1e-3);
  EXPECT_LT(error({}), 1e-3);
  EXPECT_GT(error({{"j", "1"}}), 0.5);
  EXPECT_GT(error({{"j", "4"}, {"partition", "latitude"}}), 0.5);
}

// The map is what the frame's BRDF says, and nothing of the frame before stays in it.
TEST(XuFrameBuild, AChangedBrdfGivesTheMapOfAColdStart) {
  const Image normals = random_normals(9, 6, 0.5F, 13);
  const BuiltMap sharp(material_of(normals, 400));
  const BuiltMap broad(material_of(normals, 20));
  const Image cold = sharp.level("xu_vmf_parts", 1);
  EXPECT_NE(broad.level("xu_vmf_parts", 1), cold);
  broad.run(sharp.batch());
  EXPECT_EQ(broad.level("xu_vmf_parts", 1), cold);
}

TEST(XuFrameBuild, JoinsMapsOfDifferentSizesAndSaysWhereItCannot) {
  const Image normals = random_normals(8, 8, 0.5F, 14);
  Image roughness(4, 16, 1, 0.3F);
  roughness.at(0, 0)[0] = 0.9F;
  Material material = material_with_roughness(normals, roughness);
  const BuiltMap joined(material);
  EXPECT_EQ(joined.baked().textures.front().levels.front().width, 8);
  EXPECT_EQ(joined.baked().textures.front().levels.front().height, 16);
  EXPECT_TRUE(joined.baked().notes.empty());
  material.metallic_roughness_map->coordinates.set = 1;
  const BuiltMap apart(material);
  EXPECT_EQ(apart.baked().textures.front().levels.front().height, 8);
  ASSERT_EQ(apart.baked().notes.size(), 1U);
  EXPECT_NEAR(apart.energy(), 1.0, 0.02);
}

TEST(XuFrameBuild, IsNotThereWhereNothingVaries) {
  const Options options(xu_vmf_method().info().options, {}, "xu_vmf");
  const Material material = material_of(constant_normals(4, 4, {0, 0, 1}), 100);
  EXPECT_EQ(xu_vmf_method().frame_build({}, options), nullptr);
  EXPECT_TRUE(xu_vmf_method().precompute(material, options, {}, no_progress).textures.empty());
}

}  // namespace
}  // namespace footprint::testing
