// The hard cases of distributions of normals.
#include <fmt/format.h>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/hard_maps.hpp"

namespace footprint::hard_cases {
namespace {

using enum NormalDistribution;

constexpr Lobe even_lobe{blinn_phong, 64.0};

NdfCase lobe_case(const Lobe& lobe, double degrees) {
  const bool narrow = lobe_width(lobe) < 0.02;
  std::string name = fmt::format("{}_on_{:g}", lobe_text(lobe), degrees);
  for (char& c : name) c = c == ':' || c == '.' || c == '+' || c == '-' ? '_' : c;
  return {.name = name,
          .group = "lobes",
          .description =
              fmt::format("{} over one normal that leans {:g} degrees: the base lobe itself", lobe_text(lobe), degrees),
          .material = [=] { return facets(tilted(degrees), lobe); },
          .energy = 0.01,
          .limit = 0.02,
          .narrow = narrow};
}

std::vector<NdfCase> lobe_cases() {
  std::vector<NdfCase> cases;
  for (const Lobe& lobe : {Lobe{blinn_phong, 0.1},
                           {blinn_phong, 64},
                           {blinn_phong, 1e4},
                           {blinn_phong, 1e6},
                           {vmf, 0.1},
                           {vmf, 1e6},
                           {ggx, 1.0},
                           {ggx, 0.1},
                           {ggx, 1e-3},
                           {beckmann, 1.0},
                           {beckmann, 1e-3}})
    cases.push_back(lobe_case(lobe, 10.0));
  for (const double degrees : {0.0, 45.0, 80.0}) cases.push_back(lobe_case(even_lobe, degrees));
  cases.push_back(lobe_case({blinn_phong, 1e6}, 45.0));
  return cases;
}

std::vector<NdfCase> bump_cases() {
  std::vector<NdfCase> cases;
  for (const double degrees : {1.0, 14.0, 45.0, 80.0, 89.9}) {
    cases.push_back({.name = fmt::format("grooves_{:g}", degrees),
                     .group = "bumps",
                     .description = fmt::format("grooves whose two sides lean {:g} degrees", degrees),
                     .material = [=] { return facets(grooves(degrees), even_lobe); }});
  }
  cases.push_back({.name = "checkerboard_45",
                   .group = "bumps",
                   .description = "texels that lean 45 degrees along x and along y in turn",
                   .material = [] { return facets(checkerboard(45.0), even_lobe); }});
  cases.push_back({.name = "noise_0_5",
                   .group = "bumps",
                   .description = "normals of any direction up to 30 degrees",
                   .material = [] { return facets(noise(16, 16, 0.5, 3), even_lobe); }});
  cases.push_back({.name = "noise_0_999",
                   .group = "bumps",
                   .description = "normals of any direction up to the horizon",
                   .material = [] { return facets(noise(16, 16, 0.999, 4), even_lobe); }});
  cases.push_back({.name = "within_a_texel",
                   .group = "bumps",
                   .description = "a footprint within one texel of 80-degree grooves: that texel's lobe",
                   .material = [] { return facets(grooves(80.0), even_lobe); },
                   .footprint = {{0.5605, 0.5605}, {0.5645, 0.5645}},
                   .limit = 0.05,
                   .texels_only = true});
  return cases;
}

// Facets of two lobes, about two axes and about one.
std::vector<NdfCase> two_lobe_cases() {
  const auto with_lobes = [](const char* name, const char* description, const std::vector<FacetLobe>& lobes,
                             std::optional<double> limit) {
    return NdfCase{.name = name,
                   .group = "two lobes",
                   .description = description,
                   .material =
                       [=] {
                         Material material = facets(tilted(10.0), even_lobe);
                         material.lobe_parameter.reset();
                         material.lobes = lobes;
                         return material;
                       },
                   .limit = limit,
                   .asks = Effect::multi_lobe};
  };
  const glm::vec3 one(leaning(20.0)), other(leaning(-20.0)), level(0.0F, 0.0F, 1.0F);
  return {
      with_lobes("two_axes", "facets of two lobes, 20 degrees to either side of their normal",
                 {{one, 64.0F, 0.5F}, {other, 256.0F, 0.5F}}, 0.02),
      with_lobes("one_lobe_twice", "facets of two equal lobes", {{level, 64.0F, 0.5F}, {level, 64.0F, 0.5F}}, 0.02)};
}

// Lobes that are wider along one direction, up to the strength that makes alpha 1 along it.
std::vector<NdfCase> stretched_cases() {
  const auto stretched = [](const char* name, const char* description, const Lobe& across, float strength) {
    return NdfCase{.name = name,
                   .group = "stretched",
                   .description = description,
                   .material =
                       [=] {
                         Material material = facets(tilted(10.0), across);
                         material.anisotropy = Anisotropy{strength, 0.5F};
                         return material;
                       },
                   .limit = 0.02,
                   .asks = Effect::anisotropic_lobe};
  };
  return {stretched("stretched_0_5", "GGX of alpha 0.1 and anisotropy 0.5", {ggx, 0.1}, 0.5F),
          stretched("stretched_1", "GGX of alpha 0.1 and anisotropy 1", {ggx, 0.1}, 1.0F),
          stretched("stretched_1_beckmann", "Beckmann's lobe of alpha 0.1 and anisotropy 1", {beckmann, 0.1}, 1.0F)};
}

std::vector<NdfCase> width_cases() {
  const auto varying = [](const char* name, const char* description, NormalDistribution distribution, float one,
                          float other, double degrees) {
    return NdfCase{.name = name, .group = "widths", .description = description, .material = [=] {
                     return facets(tilted(degrees), distribution, one, other);
                   }};
  };
  std::vector<NdfCase> cases{
      varying("exponents_0_1", "a map of exponents about 0.1", blinn_phong, 0.1F, 0.1001F, 10.0),
      varying("kappas_0_1", "a map of kappas about 0.1", vmf, 0.1F, 0.1001F, 10.0),
      varying("exponents_1_and_256", "exponents of 1 and 256 in turn", blinn_phong, 1.0F, 256.0F, 0.0),
      varying("alphas_0_05_and_1", "GGX of alpha 0.05 and 1 in turn", ggx, 0.05F, 1.0F, 0.0),
      varying("exponents_1e6", "a map of exponents about 1e6", blinn_phong, 1e6F, 0.9999e6F, 10.0)};
  cases[0].limit = cases[1].limit = 0.02;
  cases[4].limit = 0.05;
  cases[4].narrow = true;
  return cases;
}

std::vector<NdfCase> texel_cases() {
  const auto one_in = [](const char* name, const char* description, const glm::vec4& texel) {
    return NdfCase{.name = name,
                   .group = "texels",
                   .description = description,
                   .material = [=] { return facets(with_texel(noise(32, 32, 0.05, 5), texel), even_lobe); },
                   .limit = 0.15};
  };
  return {one_in("invalid_texel", "one invalid texel in 1024 of gentle bumps", {0, 0, 1, 0}),
          one_in("texel_at_the_horizon", "one texel in 1024 at the horizon", {0.99999F, 0, 0.0044721F, 1}),
          one_in("texel_below_the_horizon", "one texel in 1024 that points into the surface", {0.8F, 0, -0.6F, 1})};
}

std::vector<NdfCase> size_cases() {
  std::vector<NdfCase> cases;
  for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 31}, {3, 5}, {45, 67}, {512, 2}}) {
    cases.push_back({.name = fmt::format("map_{}x{}", size.x, size.y),
                     .group = "sizes",
                     .description = fmt::format("a map of {} x {} texels", size.x, size.y),
                     .material = [=] { return facets(noise(size.x, size.y, 0.3, 6), even_lobe); }});
  }
  cases.push_back({.name = "footprint_far_outside",
                   .group = "sizes",
                   .description = "a thin footprint over the borders of a map that repeats",
                   .material = [] { return facets(noise(16, 16, 0.3, 7), even_lobe); },
                   .footprint = {{-1.5, 0.2}, {2.5, 0.3}},
                   .energy = 0.05});
  return cases;
}

}  // namespace

std::span<const NdfCase> ndf_cases() {
  static const std::vector<NdfCase> cases = [] {
    std::vector<NdfCase> all;
    for (const auto& part :
         {lobe_cases(), bump_cases(), two_lobe_cases(), stretched_cases(), width_cases(), texel_cases(), size_cases()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return cases;
}

std::span<const Sweep> sweeps() {
  static const std::vector<Sweep> all{
      {.name = "grooves_11_to_17",
       .description = "grooves from 11 to 17 degrees, where parts of the hemisphere begin to separate",
       .material = [](double degrees) { return facets(grooves(degrees), even_lobe); },
       .from = 11.0,
       .to = 17.0,
       .steps = 6,
       .most = 0.25,
       .energy = 0.02,
       .also = "xu_vmf:thresholds=blended"},
      {.name = "roughness_to_0",
       .description = "GGX of roughness 0.3 to 0.15 over noise",
       .material =
           [](double roughness) {
             return facets(noise(8, 8, 0.3, 8), lobe_from_alpha(ggx, static_cast<float>(roughness * roughness)));
           },
       .from = 0.3,
       .to = 0.15,
       .steps = 6,
       .most = 0.5}};
  return all;
}

}  // namespace footprint::hard_cases
