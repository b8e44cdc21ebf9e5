// Guards that live in shaders, each taken out in turn: its line is replaced in the text that is compiled, by what it
// would be without. With the guard a value is what double precision says, without it the same check falls. The list is
// printed, with both figures:
//   build/release/tests/properties/footprint_guards_test --gtest_filter=ShaderGuards*
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/bake/method.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/shader_probe.hpp"

namespace footprint {
const Method& iwasaki_sg_method();
const Method& tan_gmm_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using enum NormalDistribution;
using std::numbers::pi;
using Input = std::array<glm::vec4, 3>;

const Input no_input{};
const glm::vec4 up(0, 0, 1, 0);

glm::vec4 leaning_by(double angle) {
  return {static_cast<float>(std::sin(angle)), 0.0F, static_cast<float>(std::cos(angle)), 0.0F};
}

// Half the squared distance of two vectors as they are in 32 bits.
double half_square(const glm::vec4& a, const glm::vec4& b) {
  const glm::dvec4 d = glm::dvec4(a) - glm::dvec4(b);
  return 0.5 * glm::dot(d, d);
}

// The shared functions for a base BRDF, with a module behind them.
std::string functions_of(NormalDistribution distribution, GeometryTerm geometry = GeometryTerm::none,
                         const ShaderModule& module = {}) {
  ShaderVariant variant;
  variant.brdf = {distribution, geometry, FresnelTerm::schlick, true};
  for (const Effect effect : {Effect::diffuse, Effect::fresnel, Effect::masking_shadowing})
    variant.effects.set(static_cast<std::size_t>(effect));
  const Options options({word_option("moment", {"total", "corrected"}, "")}, {}, "test");
  return "vec4 lobe_cutoff;\n" + shared_functions(shader_flags(variant, options), module);
}

std::string functions_with(std::string_view module) {
  return functions_of(blinn_phong, GeometryTerm::none, {"test.glsl", module});
}

// A part of a method's module, which needs none of its textures.
std::string part_of(const ShaderModule& module, std::string_view from, std::string_view to) {
  const std::size_t first = module.text.find(from), last = module.text.find(to);
  EXPECT_TRUE(first < last && last != std::string_view::npos) << module.file << ": " << from;
  return std::string(module.text.substr(first, last - first));
}

struct ShaderGuard {
  std::string_view hard_case, guard;
  std::string functions;
  std::string_view with, without;  // a text of `functions`, which it has once, and its replacement
  std::string_view body;           // of the probe; the first component counts
  Input input;
  double expected, bound;  // the latter relative, or as it is where 0 is expected
};

double shader_off(double found, double expected) {
  const double error = std::abs(found - expected) / (expected == 0.0 ? 1.0 : std::abs(expected));
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

double off_with(const ShaderGuard& guard, const std::string& functions) {
  return shader_off(evaluate_glsl(functions, std::string(guard.body), {&guard.input, 1}).front().x, guard.expected);
}

std::string taken_out(const ShaderGuard& guard) {
  const std::size_t at = guard.functions.find(guard.with);
  EXPECT_NE(at, std::string::npos) << guard.hard_case << ": the shader has no such guard any more: " << guard.with;
  EXPECT_EQ(guard.functions.find(guard.with, at + 1), std::string::npos) << guard.hard_case << ": " << guard.with;
  std::string text = guard.functions;
  return at == std::string::npos ? text : text.replace(at, guard.with.size(), guard.without);
}

std::vector<ShaderGuard> lobe_guards() {
  constexpr double narrow = 1e6;
  const glm::vec4 axis = leaning_by(0.37), beside = leaning_by(0.3718);
  const double u = half_square(axis, beside);
  constexpr std::string_view vmf_value = "return vec4(vmfDensity(a.x, b.xyz, c.xyz));";
  return {{"vMF of kappa 0, 0 / 0",
           "series about 0",
           functions_of(vmf),
           "if (kappa < 1e-4) return (1.0 + kappa * (1.0 - u)) / (4.0 * pi);",
           "",
           vmf_value,
           {glm::vec4(0), up, up},
           1.0 / (4.0 * pi),
           1e-6},
          {"1 - e^-2k of a small kappa",
           "series",
           functions_of(vmf),
           "x < 0.02 ? 2.0 * x * (1.0 - x * (1.0 - x * (2.0 / 3.0 - x / 3.0))) : 1.0 - exp(-2.0 * x)",
           "1.0 - exp(-2.0 * x)",
           vmf_value,
           {glm::vec4(2e-4F), up, up},
           2e-4F / (-2.0 * pi * std::expm1(-4e-4F)),
           1e-5},
          {"1 - n.h of a narrow lobe",
           "|h - n|^2 / 2",
           functions_of(vmf),
           "vec3 d = h - n;\n  return 0.5 * dot(d, d);",
           "return 1.0 - dot(n, h);",
           vmf_value,
           {glm::vec4(narrow), axis, beside},
           narrow / (2.0 * pi) * std::exp(-narrow * u),
           1e-3},
          {"log(1 - u) of a small u",
           "series of atanh",
           functions_of(blinn_phong),
           "exp(s * log1m(u))",
           "exp(s * log(1.0 - u))",
           "return vec4(lobeDensity(a.x, b.xyz, c.xyz));",
           {glm::vec4(narrow), axis, beside},
           (narrow + 1.0) / (2.0 * pi) * std::exp(narrow * std::log1p(-u)),
           1e-3},
          {"Beckmann at the horizon, 0 / 0",
           "no light below a cosine of 1e-3",
           functions_of(beckmann),
           "if (c <= 1e-3) return 0.0;",
           "",
           "return vec4(lobeDensity(a.x, b.xyz, c.xyz));",
           {glm::vec4(0.3F), up, glm::vec4(1, 0, 0, 0)},
           0.0,
           0.0},
          {"GGX behind the facet",
           "no light from behind",
           functions_of(ggx),
           "if (c <= 0.0) return 0.0;",
           "",
           "return vec4(lobeDensity(a.x, b.xyz, c.xyz));",
           {glm::vec4(0.3F), up, -up},
           0.0,
           0.0}};
}

std::vector<ShaderGuard> term_guards() {
  constexpr std::string_view factor =
      "vec3 wi = vec3(0.0, 0.0, 1.0); return vec4(geometryFactor(a.x, b.xyz, halfVector(wi, c.xyz), wi, c.xyz));";
  constexpr float kappa = 8.0F;  // of alpha 1 / 2
  return {{"no half vector of wi = -wo",
           "length of at least 1e-12",
           functions_of(ggx),
           "sum / max(length(sum), 1e-12)",
           "sum / length(sum)",
           "return vec4(dot(halfVector(b.xyz, -b.xyz), vec3(1.0)));",
           {no_input[0], up, up},
           0.0,
           0.0},
          {"1 / (n.v) at grazing views",
           "V-cavity's bound",
           functions_of(ggx, GeometryTerm::tan),
           "return min(1.0 / max(dot(n, wo), 1e-3), bound);",
           "return 1.0 / dot(n, wo);",
           factor,
           {glm::vec4(0.3F), up, leaning_by(pi / 2 - 1e-5)},
           2.0,
           1e-3},
          // Lambda is 1 / (3.535 a) there, a = n.v / alpha.
          {"Smith's term with n.v = 0, inf 0",
           "n.v of at least 1e-4",
           functions_of(vmf, GeometryTerm::smith),
           "float nv = max(dot(n, wo), 1e-4);",
           "float nv = dot(n, wo);",
           factor,
           {glm::vec4(kappa), up, glm::vec4(1, 0, 0, 0)},
           0.25 * 3.535 / 0.5,
           1e-2},
          {"no normal at a vertex", "length of at least 1e-20", functions_with("#include \"tangent_frame.glsl\"\n"),
           "normal / max(length(normal), 1e-20)", "normal / length(normal)",
           "return vec4(dot(tangentFrame(a.xyz, vec4(1.0, 0.0, 0.0, 1.0))[2], vec3(1.0)));", no_input, 0.0, 0.0},
          {"no mean normal, 0 / 0", "the surface's own", functions_with("#include \"mean_normal.glsl\"\n"),
           "size > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0)", "mean / size", "return vec4(storedMeanNormal(a.xyz).z);",
           no_input, 1.0, 0.0},
          {"equal normals' length in 32 bits",
           "three last places are not a spread",
           functions_with("#include \"length_shortfall.glsl\"\n"),
           "if (shortfall <= rounding) return 0.0;\n  return shortfall - rounding * (rounding / shortfall);",
           "return shortfall;",
           "return vec4(shortfallOfLength(a.x, rounding_of_floats));",
           {glm::vec4(1.0F - 1.5e-7F), up, up},
           0.0,
           0.0}};
}

// Moments of one slope in half floats, which leave a spread below 0.
Input rounded_moments() {
  const auto half = [](double x) { return glm::unpackHalf1x16(glm::packHalf1x16(static_cast<float>(x))); };
  Input most{};
  double least = 0.0;
  for (int i = 1; i < 200; ++i) {
    const glm::dvec2 b(0.013 * i, 0.007 * i);
    const Input input{glm::vec4(half(b.x), half(b.y), 0, 0),
                      glm::vec4(half(b.x * b.x), half(b.x * b.y), half(b.y * b.y), 0), glm::vec4(0)};
    const glm::dvec2 mean(input[0]);
    const glm::dvec3 c = glm::dvec3(input[1]) - glm::dvec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y);
    const double smallest = 0.5 * (c.x + c.z) - std::hypot(0.5 * (c.x - c.z), c.y);
    if (smallest < least) most = input;
    least = std::min(least, smallest);
  }
  return most;
}

std::vector<ShaderGuard> slope_guards() {
  const std::string slopes = functions_with("const bool base_in_moments = false;\n#include \"gaussian_slopes.glsl\"\n");
  constexpr std::string_view density = "return vec4(slopeDensity(slopeLobe(vec2(0.0), mat2(a.x), a.x), b.xyz));";
  return {{"M - B B^T of equal slopes", "nearest matrix without a negative eigenvalue", slopes,
           "if (middle >= radius) return mat2(c.x, c.y, c.y, c.z);", "return mat2(c.x, c.y, c.y, c.z);",
           "mat2 s = slopeCovariance(a.xy, b.xyz); vec2 d = vec2(0.5 * (s[0][0] - s[1][1]), s[0][1]);"
           "return vec4(max(length(d) - 0.5 * (s[0][0] + s[1][1]), 0.0));",
           rounded_moments(), 0.0, 1e-8},
          {"root of a determinant below 0",
           "determinant of at least 0",
           slopes,
           "return max(c[0][0] * c[1][1] - c[0][1] * c[1][0], 0.0);",
           "return c[0][0] * c[1][1] - c[0][1] * c[1][0];",
           "return vec4(covarianceRoot(mat2(1.0, a.x, a.x, 1.0))[0][0]);",
           {glm::vec4(1.000001F), up, up},
           std::numbers::sqrt2 / 2.0,
           1e-3},
          {"a lobe of no slope variance, 1 / 0",
           "variance that moments can resolve",
           slopes,
           "max(variance, 1e-7 * (1.0 + slope2))",
           "variance",
           density,
           {glm::vec4(0), up, up},
           1.0 / (2.0 * pi * 1e-7),
           1e-3},
          {"slope of a direction at the horizon",
           "cosine of at least 1e-3",
           slopes,
           "const float smallest_slope_cosine = 1e-3;",
           "const float smallest_slope_cosine = 0.0;",
           density,
           {glm::vec4(0.1F), glm::vec4(1, 0, 0, 0), up},
           0.0,
           0.0}};
}

std::vector<ShaderGuard> method_guards() {
  constexpr std::string_view convolution = "return vec4(sgConvolution(vec3(0.0, 0.0, 1.0), a.x, b.xyz, a.x));";
  const ShaderModule iwasaki = iwasaki_sg_method().shader;
  const std::string gaussians =
      functions_of(vmf, GeometryTerm::none, {"test.glsl", "#include \"iwasaki_sg_lobes.glsl\"\n", iwasaki.folder});
  const std::string component =
      part_of(tan_gmm_method().shader, "// A Gaussian over the disc.", "// The height of the hemisphere");
  const std::string recovered = functions_with(component);
  constexpr double sharp = 1e6;
  const glm::vec4 beside = leaning_by(5e-4);
  const double exponent = -sharp * 0.5 * half_square(up, beside);  // to 1e-7, where the two are nearly parallel
  return {{"Gaussians that face away, 0 / 0",
           "series about 0",
           gaussians,
           "if (z < 1e-4) return 4.0 * pi * exp(-sum) * (1.0 + z * z / 6.0);",
           "",
           convolution,
           {glm::vec4(1.0F), -up, up},
           4.0 * pi * std::exp(-2.0),
           1e-6},
          {"|z| - S of sharp Gaussians",
           "difference of the axes",
           gaussians,
           "-2.0 * eta1 * (eta2 / (z + sum)) * oneMinusDot(axis1, axis2)",
           "z - sum",
           convolution,
           {glm::vec4(sharp), beside, up},
           pi / sharp * std::exp(exponent),
           1e-3},
          {"a component of no share, 0 / 0", "left out below 1e-4", recovered,
           "if (filtered.x < least_share) return Component(0.0, vec2(0.0), 0.0);", "",
           "return vec4(recovered(a).mean.x);", no_input, 0.0, 0.0},
          {"a mixture's spread below 0",
           "spread of at least 0",
           recovered,
           "max(filtered.w / filtered.x - dot(mean, mean), 0.0)",
           "filtered.w / filtered.x - dot(mean, mean)",
           "return vec4(sqrt(recovered(a).spread));",
           {glm::vec4(1.0F, 0.5F, 0.0F, 0.2499F), up, up},
           0.0,
           0.0}};
}

// clear_coat.glsl, with all that it reads but its maps' texels.
std::string coat_functions() {
  ShaderVariant variant;
  variant.brdf = {blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  for (const Effect effect : {Effect::clear_coat, Effect::coat_normal_variation})
    variant.effects.set(static_cast<std::size_t>(effect));
  const ShaderModule module{"test.glsl",
                            "vec4 coat_weight_width;\nuniform sampler2D coat_normal_map;\n"
                            "#include \"clear_coat.glsl\"\n"};
  return "vec4 lobe_cutoff;\n" + shared_functions(shader_flags(variant, Options({}, {}, "test")), module);
}

std::vector<ShaderGuard> coat_guards() {
  const std::string coat = coat_functions();
  constexpr double alpha2 = 0.04F;
  const glm::vec4 grazing(5e-6F, 0.0F, 1.0F, 0.0F);
  return {{"a coat's normals cancel, no direction",
           "the surface's own",
           coat,
           "dot(mean, mean) > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0)",
           "mean / size",
           "return vec4(coatOf(a.xyz, 0.04, 1.0, b.xyz).normal.z);",
           {no_input[0], up, up},
           1.0,
           0.0},
          {"a coat's normals cancel, inf / inf",
           "length of at least 1e-3",
           coat,
           "max(length(mean), 1e-3)",
           "length(mean)",
           "return vec4(coatOf(a.xyz, 0.04, 1.0, b.xyz).spread);",
           {no_input[0], up, up},
           1998.0 / (1998.0 + alpha2),
           1e-6},
          {"a coat's normals cancel, too wide",
           "alpha of at most 1",
           coat,
           "min(alpha2 + added, 1.0)",
           "alpha2 + added",
           "return vec4(coatReflectance(coatOf(a.xyz, 0.04, 1.0, b.xyz), b.xyz, b.xyz));",
           {no_input[0], up, up},
           0.04 / (4.0 * pi),
           1e-5},
          {"a mirror's equal normals in 32 bits",
           "three last places are not a spread",
           coat,
           "shortfallOfLength(size, rounding_of_floats)",
           "max(1.0 - size, 0.0)",
           "return vec4(coatOf(a.xyz, 1e-6, 1.0, b.xyz).alpha2);",
           {glm::vec4(0.0F, 0.0F, 1.0F - 1.2e-7F, 0.0F), up, up},
           1e-6,
           1e-3},
          {"a coat facing away, share above 1",
           "|n.v|",
           coat,
           "min(abs(cosine), 1.0)",
           "cosine",
           "return vec4(coatFresnel(-b.z));",
           {no_input[0], up, up},
           0.04,
           1e-6},
          {"a coat facing away, light below 0",
           "n.v of at least 1e-4",
           coat,
           "float nv = max(dot(n, wo), 1e-4);",
           "float nv = dot(n, wo);",
           "return vec4(ggxGeometry(0.04, b.xyz, b.xyz, -b.xyz));",
           {no_input[0], up, up},
           0.5 / (std::sqrt(alpha2 + (1.0 - alpha2) * 1e-8) + 1e-4),
           1e-5},
          {"a half vector that is rounding alone",
           "no light from wi = -wo",
           coat,
           "|| !halfVectorIsDefined(wi, wo)",
           "",
           "return vec4(coatReflectance(Coat(vec3(1.0, 0.0, 0.0), 0.04, 1.0, 0.04, 0.0), b.xyz, c.xyz));",
           {no_input[0], grazing, grazing * glm::vec4(1.0F, 1.0F, -1.0F, 1.0F)},
           0.0,
           0.0}};
}

TEST(ShaderGuards, EachPassesAndFailsWithoutIt) {
  fmt::print("{:38} {:46} {:>8} {:>10} {:>10}\n", "hard case", "guard in a shader", "bound", "with it", "without");
  for (const auto& guards : {lobe_guards(), term_guards(), slope_guards(), method_guards(), coat_guards()}) {
    for (const ShaderGuard& guard : guards) {
      const double with = off_with(guard, guard.functions), without = off_with(guard, taken_out(guard));
      fmt::print("{:38} {:46} {:8.0e} {:10.2g} {:10.2g}\n", guard.hard_case, guard.guard, guard.bound, with, without);
      EXPECT_LE(with, guard.bound) << guard.hard_case;
      EXPECT_GT(without, guard.bound) << guard.hard_case << ": nothing falls where " << guard.guard << " is taken out";
    }
  }
}

}  // namespace
}  // namespace footprint::testing
