// `roughness_bake`: the renormalised mean normal under a lobe that is widened according to the length of the mean
// normal, by the formula of an engine's importer, which bakes normal maps into roughness mips.
#include "methods/roughness_bake/roughness_bake.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {

namespace roughness_bake {
namespace {

// Bytes cannot store a sum of variances.
Storage spread_storage(Storage storage) { return is_coarse(storage) ? Storage::fp16 : storage; }

// Prepends levels of repeated texels up to the given size. None if the finest level fits into no chain of that size.
std::optional<std::vector<Image>> extended_chain(const std::vector<Image>& chain, int width, int height) {
  const Image& finest = chain.front();
  std::vector<Image> finer;
  for (int level = 0; level < mip_level_count(width, height); ++level) {
    const int w = std::max(width >> level, 1), h = std::max(height >> level, 1);
    if (w == finest.width && h == finest.height) {
      finer.insert(finer.end(), chain.begin(), chain.end());
      return finer;
    }
    if (w % finest.width != 0 || h % finest.height != 0) return {};
    finer.push_back(nearest_texels(finest, w, h));
  }
  return {};
}

// Checks that one roughness map can store both maps. `sizes_fit`: they have common mip levels.
void require_one_map(const Material& material, bool sizes_fit) {
  const bool varies = width_map(material) != nullptr;
  std::string why;
  if (varies && roughness_coordinates(material) != normal_coordinates(material))
    why = "its normal and roughness maps have different texture coordinates";
  if (!sizes_fit) why = "the sizes of its normal and roughness maps have no common mip levels";
  if (material.layer_map) why = "it has a detail layer with coordinates of its own";
  if (!material.lobes.empty()) why = "its facets have lobes of their own";
  if (why.empty()) return;
  throw Error(ErrorKind::usage, "material " + material.name,
              "one roughness map cannot store the baked roughness: " + why,
              "draw it with the shader module of this method");
}

constexpr double steepest = 3.0;  // as lean's default (methods/lean/README.md)

SlopeMoments moments_at(const Image& level, std::size_t texel) {
  const float* const m = &level.texels[static_cast<std::size_t>(level.channels) * texel];
  return {.mean = {m[slope_x], m[slope_y]}, .second = glm::dmat2(m[slope_xx], m[slope_xy], m[slope_xy], m[slope_yy])};
}

DirectedRoughness lobe_at(const Material& material, const Image& moments, const Image& rough, std::size_t texel) {
  const bool varies = width_map(material) != nullptr;
  const float r = rough.texels[texel];
  const Lobe base = varies ? lobe_from_alpha(material.brdf.distribution, r * r) : lobe_of(material);
  const SlopeMoments slopes = moments_at(moments, texel);
  return directed_roughness(covariance_about(slopes.mean, covariance(slopes)), 2.0 * lobe_variance(base));
}

void require_two_widths(const Material& material) {
  const NormalDistribution distribution = material.brdf.distribution;
  if (distribution == NormalDistribution::ggx || distribution == NormalDistribution::beckmann) return;
  throw Error(ErrorKind::usage, "anisotropic=on", "the lobe of the base BRDF has one width, whatever the direction",
              "use anisotropic=off, or a scene with GGX or Beckmann");
}

}  // namespace

CommonLevels common_levels(const Material& material, const std::vector<Image>& over_normals) {
  const Image rough = roughness_map_of(material);
  const int width = std::max(rough.width, over_normals.front().width),
            height = std::max(rough.height, over_normals.front().height);
  const auto fine_normals = extended_chain(over_normals, width, height);
  const auto fine_rough = extended_chain(mip_chain(rough), width, height);
  require_one_map(material, fine_normals && fine_rough);
  return {.rough = *fine_rough, .normals = *fine_normals};
}

std::vector<Image> spread_chain(Image normals, Preset preset) {
  std::vector<Image> chain;
  for (const Image& level : mean_normal_chain(std::move(normals))) {
    const bool finest = chain.empty();
    Image& out = chain.emplace_back(level.width, level.height, 1);
    for (std::size_t i = 0; i < level.texel_count(); ++i) {
      const float* const n = &level.texels[3 * i];
      const double length = std::hypot(double{n[0]}, double{n[1]}, double{n[2]});
      const double shortfall = shortfall_of_length(length);
      if (finest && shortfall == 0.0) continue;  // Filament's finest level is the roughness as given
      out.texels[i] = static_cast<float>(stored_spread(preset, shortfall));
    }
  }
  return chain;
}

Prefiltered bake_roughness(const Material& material, Preset preset, Storage storage, const EffectSet& effects) {
  const Storage wide = spread_storage(storage);
  Prefiltered out = bake_mean_normal(material, storage, effects);
  if (has(effects, Effect::normal_variation)) {
    out.textures.push_back(make_texture("normal_spread", spread_chain(normal_map_of(material), preset), wide,
                                        normal_coordinates(material)));
  }
  if (has(effects, Effect::normal_layers)) {
    out.textures.push_back(
        make_texture("layer_spread", spread_chain(layer_map_of(material), preset), wide, layer_coordinates(material)));
  }
  append(out.textures, bake_mean_roughness(material, storage, effects).textures);
  return out;
}

DirectedRoughness directed_roughness(const glm::dmat2& covariance, double alpha2) {
  const glm::dvec2 deviator(0.5 * (covariance[0][0] - covariance[1][1]), covariance[0][1]);
  const double middle = 0.5 * (covariance[0][0] + covariance[1][1]), radius = glm::length(deviator);
  const auto alpha = [&](double variance) {
    return std::clamp(std::sqrt(alpha2 + 2.0 * std::max(variance, 0.0)), smallest_alpha, 1.0);
  };
  const double along = alpha(middle + radius), across = alpha(middle - radius);
  const double angle = 0.5 * std::atan2(deviator.y, deviator.x);
  return {.direction = {std::cos(angle), std::sin(angle)},
          .strength = across < 1.0 ? std::sqrt((along - across) / (1.0 - across)) : 0.0,
          .roughness = std::sqrt(across)};
}

glm::dmat2 covariance_about(const glm::dvec2& mean, const glm::dmat2& covariance) {
  const double q = std::sqrt(1.0 + glm::dot(mean, mean));
  const glm::dmat2 inverse = glm::dmat2(1.0 / q) - glm::outerProduct(mean, mean) / (q * q * (q + 1.0));
  return inverse * covariance * inverse;
}

std::vector<Image> directed_chain(const Material& material) {
  require_two_widths(material);
  const CommonLevels levels =
      common_levels(material, slope_moment_chain(normal_map_of(material), Image(1, 1, 1, 0.0F), steepest));
  const glm::dvec2 common = lobe_at(material, levels.normals.back(), levels.rough.back(), 0).direction;
  std::vector<Image> chain;
  for (std::size_t level = 0; level < levels.rough.size(); ++level) {
    const Image& rough = levels.rough[level];
    Image& out = chain.emplace_back(rough.width, rough.height, 4);
    for (std::size_t i = 0; i < out.texel_count(); ++i) {
      const DirectedRoughness lobe = lobe_at(material, levels.normals[level], rough, i);
      const glm::dvec2 d = lobe.direction * (glm::dot(lobe.direction, common) < 0.0 ? -0.5 : 0.5) + 0.5;
      const glm::dvec4 texel(d, lobe.strength, lobe.roughness);
      for (int c = 0; c < 4; ++c) out.texels[4 * i + static_cast<std::size_t>(c)] = static_cast<float>(texel[c]);
    }
  }
  return chain;
}

}  // namespace roughness_bake

extern const EmbeddedTexts roughness_bake_glsl;

namespace {

using namespace roughness_bake;

// Evaluates the formula at every texel; the shader also evaluates it in between.
std::vector<Image> joined_chain(const Formula& formula, const Material& material, std::vector<Image> rough,
                                const std::vector<Image>& spread) {
  const NormalDistribution distribution = material.brdf.distribution;
  const bool varies = width_map(material) != nullptr;
  for (std::size_t level = 0; level < rough.size(); ++level) {
    for (std::size_t i = 0; i < rough[level].texel_count(); ++i) {
      float& r = rough[level].texels[i];
      const Lobe lobe = varies ? lobe_from_alpha(distribution, r * r) : lobe_of(material);
      const double widened = widened_alpha2(formula, distribution, 2.0 * lobe_variance(lobe), spread[level].texels[i]);
      r = static_cast<float>(std::clamp(std::sqrt(std::sqrt(widened)), 0.0, 1.0));
    }
  }
  return rough;
}

bool is_anisotropic(const Options& options) { return options.word("anisotropic") == "on"; }

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& /*progress*/) {
  const Formula formula = formula_of(options);
  const Storage storage = parse_storage(options.word("storage"));
  if (!is_anisotropic(options) || !has(effects, Effect::normal_variation))
    return bake_roughness(material, formula.preset, storage, effects);
  Prefiltered out = bake_mean_normal(material, storage, effects);
  // No block has four channels without a loss of direction.
  out.textures.push_back(make_texture("anisotropic_roughness", directed_chain(material),
                                      is_block(storage) ? Storage::unorm8 : storage, normal_coordinates(material)));
  return out;
}

std::optional<std::vector<Image>> roughness_mips(const Material& material, const Options& options) {
  if (!material.normal_map) return {};
  if (is_anisotropic(options)) return directed_chain(material);
  const Formula formula = formula_of(options);
  CommonLevels levels = common_levels(material, spread_chain(normal_map_of(material), formula.preset));
  return joined_chain(formula, material, std::move(levels.rough), levels.normals);
}

}  // namespace

const Method& roughness_bake_method() {
  static const Method method{
      .info =
          {.name = "roughness_bake",
           .summary =
               "The mean normal under a lobe widened as engines widen roughness mips when they import a normal map.",
           .paper = "Engines' importers (README); our own constant by default",
           .options = {named_in_shaders(
                           word_option("preset", {preset_names.begin(), preset_names.end()},
                                       "Whose formula: engines', or `fit`, the constant that is closest to the true "
                                       "distribution of normals by roughness and distribution, or `free`."),
                           "bake"),
                       named_in_shaders(number_option("constant", Formula{}.constant, 0.0, 8.0,
                                                      "Of preset=free: alpha^2 + min(constant / kappa, cap)."),
                                        "bake_constant"),
                       named_in_shaders(number_option("cap", Formula{}.cap, 0.0, 1.0,
                                                      "Of preset=free: the most that is added to alpha^2."),
                                        "bake_cap"),
                       word_option("anisotropic", {"off", "on"},
                                   "Whether the roughness has a direction, from the covariance of slopes "
                                   "(KHR_materials_anisotropy); `preset` is then ignored."),
                       block_storage_option(true)},
           .honours = map_effects_but({Effect::anisotropic_lobe})},
      .precompute = precompute,
      .shader = module_of(roughness_bake_glsl, "roughness_bake.glsl"),
      .roughness_mips = roughness_mips};
  return method;
}

}  // namespace footprint
