// `leadr`: the moments of slope as one off-centre anisotropic lobe, with masking and shadowing by the same slopes.
// Dupuy et al. 2013, "Linear Efficient Antialiased Displacement and Reflectance Mapping".
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"

namespace footprint {

extern const EmbeddedTexts leadr_glsl;

namespace {

// The twin of meanLitCosine (leadr.glsl) under light from above.
double quadrature_from_above(const SlopeMoments& moments) {
  const glm::dmat2 spread = covariance(moments);
  const double area = std::sqrt(std::max(glm::determinant(spread), 0.0));
  const double size = std::sqrt(spread[0][0] + spread[1][1] + 2.0 * area);
  const glm::dmat2 root = size > 0.0 ? (spread + glm::dmat2(area)) / size : glm::dmat2(0.0);
  double sum = 0.0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const glm::dvec2 slope = moments.mean + root * (std::numbers::sqrt3 * glm::dvec2(i, j));
      sum += (i == 0 ? 4.0 : 1.0) * (j == 0 ? 4.0 : 1.0) / 36.0 / std::sqrt(1.0 + glm::dot(slope, slope));
    }
  }
  return sum;
}

// The diffuse term assumes that slopes are Gaussian. The note gives its error for light from above and a pixel that
// shows the whole map: the mean cosine of the texels against that of the Gaussian.
std::optional<std::string> diffuse_range_note(const Image& normals, double steepest) {
  constexpr double most = 0.1;
  SlopeMoments moments;
  double cosine = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < normals.texel_count(); ++i) {
    const float* const n = &normals.texels[4 * i];
    if (n[3] <= 0.0F) continue;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(n[0], n[1], n[2]));
    const glm::dvec2 slope = slope_of(normal, steepest);
    moments.mean += static_cast<double>(n[3]) * slope;
    moments.second += static_cast<double>(n[3]) * glm::outerProduct(slope, slope);
    cosine += n[3] * std::max(normal.z, 0.0);
    weight += n[3];
  }
  if (!(weight > 0.0) || !(cosine > 0.0)) return {};
  const double taken = quadrature_from_above({moments.mean / weight, moments.second / weight});
  const double error = taken / (cosine / weight) - 1.0;
  if (std::abs(error) <= most) return {};
  return fmt::format(
      "its diffuse term takes slopes for a Gaussian's, which this map's are not: from afar and lit from above it "
      "reflects "
      "{:.2f} of a level surface instead of {:.2f} ({:+.0f}%)",
      taken, cosine / weight, 100.0 * error);
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& /*progress*/) {
  Prefiltered out = bake_slopes(material, options, effects, {});
  if (has(effects, Effect::diffuse) && has(effects, Effect::normal_variation)) {
    if (auto note = diffuse_range_note(normal_map_of(material), options.number("steepest")))
      out.notes.push_back(*std::move(note));
  }
  return out;
}

}  // namespace

const Method& leadr_method() {
  static const Method method{
      .info = {.name = "leadr",
               .summary = "The lobe of the footprint's slopes, masked and shadowed by those slopes.",
               .paper = "Dupuy et al. 2013, Linear Efficient Antialiased Displacement and Reflectance Mapping, "
                        "ACM TOG 32(6)",
               .options = {float_storage_option(), slope_roughness_option(), steepest_slope_option(),
                           word_option("weighting", {"bump", "displacement"},
                                       "What a texel counts for: all the same, as in a normal map, or its true and "
                                       "visible area, as on a displaced surface.")},
               .honours = map_effects_but({Effect::multi_lobe})},
      .precompute = precompute,
      .shader = module_of(leadr_glsl, "leadr.glsl")};
  return method;
}

}  // namespace footprint
