// The method as a whole: its NDF against a twin in doubles, its energy, what it does between texels and where there is
// little or nothing to fit.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& fournier_method();
}

namespace footprint::testing {
namespace {

using Given = std::map<std::string, std::string>;

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};

EffectSet normals_alone() {
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::normal_variation));
  return effects;
}

// A map baked for Blinn-Phong lobes of an exponent.
struct Baked {
  float exponent;
  Options options;
  Prefiltered prefiltered;

  Baked(const Image& normals, float s, const Given& given = {}, const Progress& progress = no_progress)
      : exponent(s), options(fournier_method().info.options, given, "fournier") {
    Material material = square_scene(normals, {.brdf = blinn_phong}).materials[0];
    material.lobe_parameter = s;
    prefiltered = fournier_method().precompute(material, options, normals_alone(), progress);
  }

  [[nodiscard]] const PrefilteredTexture& first() const { return prefiltered.textures.at(0); }
  [[nodiscard]] const PrefilteredTexture& rest() const { return prefiltered.textures.at(1); }
};

// A square footprint: its centre on the map and its edge.
struct SquareFootprint {
  glm::vec2 uv{0.5F, 0.5F};
  float edge = 1.0F;
};

// The shader's ndf at directions.
std::vector<double> ndf(const Baked& baked, const SquareFootprint& footprint,
                        const std::vector<glm::dvec3>& directions) {
  const gl::Context& context = shared_context();
  ShaderVariant variant;
  variant.brdf = blinn_phong;
  variant.effects = normals_alone();
  const ShaderFlags flags = shader_flags(variant, baked.options, baked.prefiltered);
  std::string text = "const float option_peaks = " + std::to_string(baked.options.number("peaks")) + ";\n";
  std::vector<GpuTexture> textures;
  SamplerCache samplers;
  for (const PrefilteredTexture& texture : baked.prefiltered.textures) {
    const auto unit = static_cast<GLuint>(textures.size());
    textures.push_back(upload(texture));
    gl::api().BindTextureUnit(unit, textures.back().texture->name());
    gl::api().BindSampler(
        unit, samplers.sampler(texture.coordinates, textures.back().sampler_state(SamplerState::trilinear)));
    text += "layout(binding = " + std::to_string(unit) + ") uniform sampler2DArray " + texture.name + ";\n";
  }
  text += "vec4 lobe_cutoff;\n" + shared_functions(flags, fournier_method().shader);
  std::vector<std::array<glm::vec4, 3>> inputs;
  inputs.reserve(directions.size());
  for (const glm::dvec3& h : directions)
    inputs.push_back(
        {glm::vec4(footprint.uv, footprint.edge, baked.exponent), glm::vec4(glm::vec3(h), 0.0F), glm::vec4(0.0F)});
  std::vector<double> out;
  out.reserve(directions.size());
  const std::string body =
      "lobe_cutoff = vec4(a.w);\nFootprint p = Footprint(a.xy, vec2(a.z, 0.0), vec2(0.0, a.z));\n"
      "return vec4(ndf(effective(Footprints(p, p, p)), b.xyz));";
  for (const glm::vec4& v : evaluate_glsl(text, body, inputs)) out.push_back(v.x);
  context.check("evaluating fournier");
  return out;
}

double phong(double exponent, const glm::dvec3& n, const glm::dvec3& h) {
  const double c = glm::dot(n, h);
  return c > 0.0 ? (exponent + 1.0) / (2.0 * std::numbers::pi) * std::pow(c, exponent) : 0.0;
}

// The map of equal areas by angles: a radius of 2 sin(theta / 2).
glm::dvec3 on_sphere(double x, double y) {
  const double radius = std::hypot(x, y);
  const double theta = 2.0 * std::asin(std::min(0.5 * radius, 1.0));
  const double scale = radius > 0.0 ? std::sin(theta) / radius : 1.0;
  return {x * scale, y * scale, std::cos(theta)};
}

// A stored peak, decoded as the README says.
struct StoredPeak {
  double weight;
  glm::dvec3 axis;
  double spread;
};

std::vector<StoredPeak> peaks_of(const Baked& baked, int level, int x, int y) {
  std::vector<StoredPeak> peaks;
  const auto add = [&](const Image& image) {
    const auto texel = image.at(x, y);
    const double deviation = texel[2];
    peaks.push_back({texel[3], on_sphere(texel[0], texel[1]), deviation * deviation});
  };
  add(decode_level(baked.first(), static_cast<std::size_t>(level)));
  if (level == 0) return peaks;
  for (int layer = 0; layer + 1 < static_cast<int>(baked.options.number("peaks")); ++layer)
    add(decode_level(baked.rest(), static_cast<std::size_t>(level - 1), layer));
  return peaks;
}

// All peaks of the eight texels of a footprint, weighted; the maps of these tests repeat.
std::vector<StoredPeak> peaks_under(const Baked& baked, const SquareFootprint& footprint) {
  const auto levels = static_cast<int>(baked.first().levels.size());
  const double finest = std::max(baked.first().levels[0].width, baked.first().levels[0].height);
  const double level = std::clamp(std::log2(footprint.edge * finest), 0.0, levels - 1.0);
  std::vector<StoredPeak> out;
  for (int i = 0; i < 8; ++i) {
    const int own = std::min(static_cast<int>(level) + (i >> 2), levels - 1);
    const double between = level - std::floor(level);
    double weight = i >> 2 != 0 ? between : 1.0 - between;
    std::array<int, 2> texel{};
    for (int axis = 0; axis < 2; ++axis) {
      const TextureLevel& sizes = baked.first().levels[static_cast<std::size_t>(own)];
      const int size = axis == 0 ? sizes.width : sizes.height;
      const double at = static_cast<double>(footprint.uv[axis]) * size - 0.5;
      const int side = (i >> axis) & 1;
      weight *= side != 0 ? at - std::floor(at) : 1.0 - (at - std::floor(at));
      texel[static_cast<std::size_t>(axis)] = (static_cast<int>(std::floor(at)) + side + size) % size;
    }
    if (weight <= 0.0) continue;
    for (StoredPeak peak : peaks_of(baked, own, texel[0], texel[1])) {
      peak.weight *= weight;
      out.push_back(peak);
    }
  }
  return out;
}

double twin_ndf(const std::vector<StoredPeak>& peaks, double exponent, const glm::dvec3& h) {
  double sum = 0;
  double total = 0;
  for (const StoredPeak& peak : peaks) {
    sum += peak.weight * phong(1.0 / (1.0 / exponent + peak.spread), peak.axis, h);
    total += peak.weight;
  }
  return sum / total;
}

// Cells of one area over the whole sphere.
std::vector<glm::dvec3> sphere_grid(int across) {
  std::vector<glm::dvec3> out;
  for (int j = 0; j < across; ++j) {
    for (int i = 0; i < across; ++i) {
      const double x = 4.0 * (i + 0.5) / across - 2.0;
      const double y = 4.0 * (j + 0.5) / across - 2.0;
      if (std::hypot(x, y) < 2.0) out.push_back(on_sphere(x, y));
    }
  }
  return out;
}

double energy(const Baked& baked, const SquareFootprint& footprint = {}) {
  constexpr int across = 200;
  double sum = 0;
  for (const double density : ndf(baked, footprint, sphere_grid(across))) sum += density;
  return sum * 16.0 / (across * across);
}

Image two_halves(const glm::vec3& left, const glm::vec3& right) {
  Image map(8, 8, 4, 1.0F);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) std::copy_n(x < 4 ? &left.x : &right.x, 3, map.at(x, y).begin());
  }
  return map;
}

const glm::vec3 leans_left(-0.5F, 0.0F, std::sqrt(0.75F));
const glm::vec3 leans_right(0.5F, 0.0F, std::sqrt(0.75F));

TEST(Fournier, NdfMeetsItsTwin) {
  const Image map = random_normals(32, 16, 0.7F, 3);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  const std::vector<glm::dvec3> directions = sphere_grid(24);
  for (const float s : {4.0F, 64.0F, 512.0F, 1e4F}) {
    for (const char* peaks : {"1", "2", "7"}) {
      const Baked baked(map, s, {{"peaks", peaks}});
      for (const float edge : {0.01F, 0.0625F, 0.1F, 0.3F, 0.9F, 2.0F}) {
        const SquareFootprint footprint{.uv = {unit(random), unit(random)}, .edge = edge};
        const std::vector<StoredPeak> expected = peaks_under(baked, footprint);
        double peak = 0;
        for (const StoredPeak& p : expected) peak = std::max(peak, twin_ndf(expected, s, p.axis));
        const std::vector<double> out = ndf(baked, footprint, directions);
        for (std::size_t i = 0; i < out.size(); ++i) {
          EXPECT_NEAR(out[i] / peak, twin_ndf(expected, s, directions[i]) / peak, 1e-5)
              << "exponent " << s << ", peaks " << peaks << ", edge " << edge;
        }
      }
    }
  }
}

TEST(Fournier, EnergyIsOne) {
  for (const float s : {8.0F, 512.0F}) {
    for (const float tilt : {0.0F, 0.3F, 0.95F}) {
      const Baked baked(random_normals(16, 16, tilt, 7), s);
      for (const SquareFootprint& footprint :
           {SquareFootprint{}, SquareFootprint{.uv = {0.3F, 0.6F}, .edge = 0.2F}, SquareFootprint{.edge = 1e-3F}})
        EXPECT_NEAR(energy(baked, footprint), 1.0, 0.01)
            << "exponent " << s << ", tilt " << tilt << ", " << footprint.edge;
    }
  }
}

// Half-way between two texels both lobes are there, each at half its height, and nothing at the normal between them.
TEST(Fournier, TexelsAreSummedNotBlended) {
  constexpr float s = 512.0F;
  const Baked baked(two_halves(leans_left, leans_right), s);
  const std::vector<double> out =
      ndf(baked, {.edge = 0.5F}, {glm::dvec3(leans_left), glm::dvec3(leans_right), glm::dvec3(0.0, 0.0, 1.0)});
  const double peak = (s + 1.0) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(out[0], 0.5 * peak, 1e-5 * peak);
  EXPECT_NEAR(out[1], 0.5 * peak, 1e-5 * peak);
  EXPECT_LT(out[2], 1e-5 * peak);
}

// A texel of no more different normals than peaks is those normals.
TEST(Fournier, FewNormalsAreExact) {
  const Image map = four_texel_normals();
  const std::vector<glm::dvec3> directions = sphere_grid(40);
  const std::vector<double> out = ndf(Baked(map, 100.0F, {{"peaks", "4"}}), {}, directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    double expected = 0;
    for (int texel = 0; texel < 4; ++texel) {
      const auto n = map.at(texel % 2, texel / 2);
      expected += 0.25 * phong(100.0, glm::normalize(glm::dvec3(n[0], n[1], n[2])), directions[i]);
    }
    EXPECT_NEAR(out[i], expected, 1e-4);
  }
}

// One texel drawn with the same samples: each is one normal, so both methods shade the same facets.
TEST(Fournier, FinestLevelIsTheBaseSurface) {
  for (const NormalDistribution distribution : {NormalDistribution::ggx, NormalDistribution::beckmann,
                                                NormalDistribution::blinn_phong, NormalDistribution::vmf}) {
    const BaseBrdf brdf{distribution, GeometryTerm::none, FresnelTerm::schlick, true};
    TestRenderer renderer(square_scene(random_normals(32, 32, 0.5F, 5), {.brdf = brdf}));
    const Image reference = renderer.reference(16, 3).mean;
    const Image finest = renderer.supersampled(fournier_method(), 16, 3).mean;
    EXPECT_LT(compare_images(finest, reference, 1.0F).value().relative_rmse, 1e-4);
  }
}

// A roughness of its own in every texel: the peaks keep the spread of normals alone, and the base lobe comes from its
// map.
TEST(Fournier, FinestLevelTakesTheTexelsOwnRoughness) {
  Scene scene = square_scene(random_normals(32, 32, 0.5F, 5), {});
  auto roughness = std::make_shared<Image>(32, 32, 2);
  for (std::size_t i = 0; i < roughness->texels.size(); i += 2) roughness->texels[i] = i % 4 == 0 ? 0.25F : 0.7F;
  scene.materials[0].metallic_roughness_map = TextureMap{.name = "stripes", .image = roughness, .coordinates = {}};
  TestRenderer renderer(scene);
  const Image reference = renderer.reference(16, 3).mean;
  const Image finest = renderer.supersampled(fournier_method(), 16, 3).mean;
  EXPECT_LT(compare_images(finest, reference, 1.0F).value().relative_rmse, 1e-4);
}

TEST(Fournier, NormalsOfNoLengthWeighNothing) {
  const std::vector<glm::dvec3> directions = sphere_grid(40);
  Image half = two_halves(leans_left, {0.0F, 0.0F, 0.0F});
  for (int y = 0; y < half.height; ++y) {
    for (int x = 4; x < half.width; ++x) half.at(x, y)[3] = 0.0F;
  }
  const std::vector<double> left = ndf(Baked(half, 64.0F), {}, directions);
  const std::vector<double> none = ndf(Baked(Image(8, 8, 4), 64.0F), {}, directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(left[i], phong(64.0, leans_left, directions[i]), 1e-4);
    EXPECT_NEAR(none[i], phong(64.0, {0.0, 0.0, 1.0}, directions[i]), 1e-4);
  }
}

TEST(Fournier, ConstantAndSingleTexelMapsAreOneLobe) {
  const std::vector<glm::dvec3> directions = sphere_grid(40);
  for (const int size : {1, 16}) {
    for (const char* peaks : {"1", "7"}) {
      const Baked baked(constant_normals(size, size, leans_right), 64.0F, {{"peaks", peaks}});
      EXPECT_TRUE(baked.prefiltered.notes.empty());
      for (const float edge : {0.01F, 0.3F, 1.0F, 50.0F}) {
        const std::vector<double> out = ndf(baked, {.uv = {0.4F, 0.7F}, .edge = edge}, directions);
        for (std::size_t i = 0; i < out.size(); ++i) EXPECT_NEAR(out[i], phong(64.0, leans_right, directions[i]), 1e-4);
      }
    }
  }
}

// Weights sum to one in every texel of every level, heaviest first, at any size.
TEST(Fournier, AnySizeKeepsItsWeight) {
  for (const glm::ivec2& size : {glm::ivec2(13, 7), glm::ivec2(1, 9), glm::ivec2(31, 2)}) {
    const Baked baked(random_normals(size.x, size.y, 0.6F, 2), 64.0F);
    for (std::size_t level = 0; level < baked.first().levels.size(); ++level) {
      for (int y = 0; y < baked.first().levels[level].height; ++y) {
        for (int x = 0; x < baked.first().levels[level].width; ++x) {
          const std::vector<StoredPeak> peaks = peaks_of(baked, static_cast<int>(level), x, y);
          double sum = 0;
          for (const StoredPeak& peak : peaks) sum += peak.weight;
          EXPECT_NEAR(sum, 1.0, 1e-6);
          EXPECT_TRUE(std::ranges::is_sorted(peaks, std::greater{}, &StoredPeak::weight));
        }
      }
    }
    EXPECT_NEAR(energy(baked), 1.0, 0.01);
  }
}

TEST(Fournier, HalfFloatsLoseLittle) {
  const Image map = random_normals(16, 16, 0.5F, 4);
  const std::vector<glm::dvec3> directions = sphere_grid(60);
  const std::vector<double> full = ndf(Baked(map, 64.0F), {}, directions);
  const std::vector<double> half = ndf(Baked(map, 64.0F, {{"storage", "fp16"}}), {}, directions);
  const double peak = *std::ranges::max_element(full);
  for (std::size_t i = 0; i < full.size(); ++i) EXPECT_NEAR(half[i] / peak, full[i] / peak, 0.01);
}

TEST(Fournier, TheSameAtAnyNumberOfThreads) {
  const Image map = random_normals(48, 48, 0.5F, 9);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return Baked(map, 64.0F).prefiltered;
  };
  const Prefiltered one = with_threads(1);
  EXPECT_EQ(one, with_threads(2));
  EXPECT_EQ(one, with_threads(4));
}

TEST(Fournier, ReportsProgressAndStops) {
  const Image map = random_normals(64, 64, 0.5F, 8);
  int calls = 0;
  double last = 0;
  (void)Baked(map, 64.0F, {}, [&](std::string_view, double fraction) {
    EXPECT_TRUE(fraction >= last && fraction <= 1.0) << fraction;
    last = fraction;
    ++calls;
  });
  EXPECT_GE(calls, 6);
  for (const int most : {1, 5}) {
    calls = 0;
    const auto stop = [&](std::string_view, double) {
      if (++calls == most) throw Error(ErrorKind::interrupted, "", "stopped");
    };
    try {
      (void)Baked(map, 64.0F, {}, stop);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::interrupted);
    }
    EXPECT_EQ(calls, most);
  }
}

// Wide lobes that overlap: some fits of eight peaks crawl along valleys until they are stopped.
TEST(Fournier, NotesFitsThatStoppedEarly) {
  const Image map = random_normals(64, 64, 0.99F, 6);
  const Baked capped(map, 8.0F, {{"peaks", "8"}});
  ASSERT_EQ(capped.prefiltered.notes.size(), 1U);
  EXPECT_NE(capped.prefiltered.notes[0].find("fits of peaks stopped before they converged"), std::string::npos);
  EXPECT_TRUE(Baked(map, 8.0F, {{"peaks", "1"}}).prefiltered.notes.empty());
}

// Grooves that run away from an oblique view: probes along them keep a texel of few normals.
TEST(Fournier, AnisotropicProbesGain) {
  TestRenderer renderer(receding_grooves());
  const Image reference = renderer.reference(1024).mean;
  const auto error_with = [&](const char* filter) {
    const Image picture = renderer.frame(fournier_method(), {}, parse_footprint_filter(filter, ""));
    for (const float value : picture.texels) EXPECT_TRUE(std::isfinite(value) && value >= 0.0F);
    return compare_images(picture, reference, 1.0F).value().relative_rmse;
  };
  EXPECT_LT(error_with("anisotropic:4"), error_with("trilinear"));
}

// By fits, nearly all of which are of the finest level that has any: an estimate of the time left does not count up.
TEST(Fournier, TellsItsProgressByFits) {
  std::map<std::string, double> begun;
  double before = 0;
  const Progress progress = [&](std::string_view what, double fraction) {
    EXPECT_GE(fraction, before) << what;
    EXPECT_LE(fraction, 1.0) << what;
    before = fraction;
    begun.emplace(what, fraction);
  };
  (void)Baked(random_normals(32, 32, 0.5F, 4), 64.0F, {}, progress);
  const double whole = 0.01 * 256 + 64 + 16 + 4 + 1;
  EXPECT_NEAR(begun.at("fitting peaks of 8x8 texels"), 2.56 / whole, 1e-9);
  EXPECT_NEAR(begun.at("fitting peaks of 4x4 texels"), 66.56 / whole, 1e-9);
  EXPECT_NEAR(begun.at("fitting peaks of 1x1 texels"), 86.56 / whole, 1e-9);
}

}  // namespace
}  // namespace footprint::testing
