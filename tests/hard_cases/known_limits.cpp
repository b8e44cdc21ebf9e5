// Limits by reason. `most` is about a quarter above the measured figure.
#include "tests/hard_cases/known_limits.hpp"

#include <initializer_list>
#include <vector>

namespace footprint::hard_cases {
namespace {

using Words = std::initializer_list<std::string_view>;

constexpr std::string_view every_method;  // also methods that are added later

class Limits {
 public:
  void add(Words methods, Words cases, std::string_view figure, double most, std::string_view why,
           bool guarded = false) {
    for (const std::string_view method : methods) {
      for (const std::string_view hard_case : cases) list_.push_back({method, hard_case, figure, most, guarded, why});
    }
  }
  [[nodiscard]] std::vector<KnownLimit> take() { return std::move(list_); }

 private:
  std::vector<KnownLimit> list_;
};

void add_storages(Limits& limits) {
  const Words rounded{"blinn_phong_0_1_on_10",
                      "blinn_phong_64_on_10",
                      "blinn_phong_10000_on_10",
                      "blinn_phong_1000000_on_10",
                      "vmf_1000000_on_10",
                      "ggx_1_on_10",
                      "ggx_0_1_on_10",
                      "ggx_0_001_on_10",
                      "beckmann_0_001_on_10",
                      "blinn_phong_64_on_80",
                      "blinn_phong_1000000_on_45"};
  limits.add({"naive_mip:storage=unorm8", "fixed_brdf:storage=unorm8", "toksvig:storage=unorm8",
              "roughness_bake:storage=unorm8", "specular_aa:storage=unorm8"},
             rounded, "limit", 1.25,
             "bytes turn a normal by up to 0.4 degrees: lobes of exponents up to 50, and their horizon");
  constexpr std::string_view blocks = "8 bits of bc5, and 5 or 6 bits of bc1, turn a normal by up to 0.4 and 3 degrees";
  const Words bc1{"toksvig:storage=bc1", "naive_mip:storage=bc1", "fixed_brdf:storage=bc1",
                  "roughness_bake:storage=bc1", "specular_aa:storage=bc1"};
  const Words bc5{"naive_mip:storage=bc5", "fixed_brdf:storage=bc5", "roughness_bake:storage=bc5",
                  "specular_aa:storage=bc5"};
  limits.add(bc1, rounded, "limit", 1.25, blocks);
  limits.add(bc1, {"blinn_phong_64_on_45"}, "limit", 0.12, blocks);
  limits.add(bc1, {"beckmann_1_on_10"}, "limit", 0.05, blocks);
  limits.add({"toksvig:storage=bc1"}, {"blinn_phong_64_on_80", "ggx_0_1_on_10"}, "energy", 0.054, blocks);
  limits.add(bc5, rounded, "limit", 1.25, blocks);
  limits.add(bc5, {"blinn_phong_64_on_45"}, "limit", 0.034, blocks);
  limits.add(bc5, {"blinn_phong_64_on_80"}, "energy", 0.055, blocks);
  limits.add({"naive_mip:storage=fp16", "fixed_brdf:storage=fp16", "toksvig:storage=fp16",
              "roughness_bake:storage=fp16", "specular_aa:storage=fp16", "xu_vmf:storage=fp16", "tan_gmm:storage=fp16"},
             {"blinn_phong_1000000_on_10", "vmf_1000000_on_10", "ggx_0_001_on_10", "beckmann_0_001_on_10"}, "limit",
             0.08, "half floats turn a normal by up to 0.03 degrees: exponents up to 1e5");
  limits.add({"tan_gmm:storage=fp16"}, {"blinn_phong_1000000_on_45"}, "limit", 1.3,
             "half floats lose spreads below 0.08 of a mean's distance from the pole");
  limits.add({"fournier:storage=fp16"}, {"blinn_phong_1000000_on_45"}, "limit", 0.18,
             "half floats turn a peak by up to 0.03 degrees");
  limits.add({"lean:storage=fp16", "leadr:storage=fp16"},
             {"blinn_phong_10000_on_10", "blinn_phong_1000000_on_10", "vmf_1000000_on_10", "ggx_0_001_on_10",
              "beckmann_0_001_on_10"},
             "limit", 1.1, "half floats lose slopes' spreads below 0.08 of their mean");
}

void add_slopes(Limits& limits) {
  constexpr std::string_view steep = "texels steeper than `steepest` count as that steep";
  limits.add({"lean", "leadr"}, {"blinn_phong_64_on_80"}, "limit", 0.8, steep, true);
  limits.add({"lean", "leadr"}, {"blinn_phong_64_on_80", "within_a_texel"}, "energy", 0.11, steep, true);
  limits.add({"lean", "leadr"}, {"within_a_texel"}, "limit", 0.8, steep, true);
  limits.add({"lean", "leadr"}, {"texel_at_the_horizon", "texel_below_the_horizon"}, "limit", 0.25, steep, true);
  limits.add({"lean", "leadr"}, {"blinn_phong_0_1_on_10", "exponents_0_1"}, "limit", 0.07,
             "lobes wider than the hemisphere have no slopes at its edge");
}

void add_widths(Limits& limits) {
  limits.add({"direct", "naive_mip", "fixed_brdf", "roughness_bake", "specular_aa", "toksvig", "lean", "leadr",
              "fournier", "best_lobes", "cells", "ndf_atlas", "tan_gmm", "xu_vmf", "atanasov_bins", "yan_gaussians"},
             {"alphas_0_05_and_1"}, "energy", 0.22,
             "one lobe for microfacet lobes of very different widths has the norm of neither");
  limits.add({"iwasaki_sg"}, {"alphas_0_05_and_1"}, "energy", 0.42, "it leaves `roughness_variation` out");
  limits.add({"cells"}, {"exponents_0_1"}, "limit", 1.05, "lobes of slopes cannot have variances above 1");
  limits.add({"cells"}, {"kappas_0_1"}, "limit", 1.4, "lobes of slopes cannot have variances above 1");
  limits.add({"cells"}, {"exponents_0_1"}, "energy", 0.05, "lobes of slopes cannot have variances above 1");
  limits.add({"cells"}, {"kappas_0_1"}, "energy", 0.49, "lobes of slopes cannot have variances above 1");
}

void add_means(Limits& limits) {
  constexpr std::string_view horizon =
      "the mean of steep sides is level: its lobe loses nothing below the horizon, theirs does";
  const Words level{"direct", "naive_mip", "fixed_brdf", "roughness_bake", "specular_aa", "toksvig", "lean", "leadr"};
  limits.add(level, {"grooves_80"}, "energy", 0.11, horizon);
  limits.add(level, {"grooves_89.9"}, "energy", 1.25, horizon);
  limits.add({"yan_gaussians"}, {"within_a_texel"}, "limit", 0.15,
             "an element's Gaussian reaches over its texel's border");
  limits.add({"xu_vmf"}, {"grooves_11_to_17"}, "step", 1.15,
             "the thresholds of the paper split a lobe at once where its sides lean by 14 degrees");
}

void add_pictures(Limits& limits) {
  limits.add({"cells", "ndf_atlas", "tan_gmm"}, {"mirrored_uvs"}, "twin", 0.11,
             "the fit depends on the order of texels: a mirrored map leads to another minimum");
  limits.add(
      {"lean"}, {"anisotropy_1_of_alpha_1"}, "twin", 0.003,
      "the geometry factor of an anisotropic base lobe has the width towards each direction, that of a round one "
      "the mean of all");
  limits.add({"naive_mip", "fixed_brdf", "roughness_bake", "specular_aa"}, {"steep_plaster"}, "mean", 6.0,
             "the mean of steep sides is level, and lit as a level surface");
  limits.add({"direct"}, {"steep_plaster"}, "mean", 2.2, "between two texels it blends their normals, to a level one");
  limits.add({"leadr"}, {"steep_plaster"}, "mean", 4.0,
             "the diffuse term takes slopes for a Gaussian about their mean; two sides of a groove are none");
}

// Limits of the coat's filter, which all methods but `direct` share: docs/explanation/base-brdf.md, Clear coat.
void add_coats(Limits& limits) {
  limits.add({"direct"}, {"bumpy_coat_seen_along_the_surface"}, "energy", 0.03,
             "it takes one normal of the coat per pixel, and few of them face the viewer there");
  limits.add(
      {every_method}, {"bumpy_coat_seen_along_the_surface"}, "energy", 0.78,
      "few of a bumpy coat's normals face the viewer there, and reflect nearly all: their lobes' tails are missing");
}

}  // namespace

std::span<const KnownLimit> known_limits() {
  static const std::vector<KnownLimit> limits = [] {
    Limits all;
    add_storages(all);
    add_slopes(all);
    add_widths(all);
    add_means(all);
    add_pictures(all);
    add_coats(all);
    return all.take();
  }();
  return limits;
}

}  // namespace footprint::hard_cases
