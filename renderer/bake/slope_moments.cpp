// Moments of each texel in 64 bits, then the weighted chain of them.
#include "renderer/bake/slope_moments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <utility>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

constexpr double default_steepest = 3.0;  // 71.6 degrees: the README of the method has the reason
constexpr int moment_channels = 5;
constexpr std::size_t weight_channel = 5;

// The slope covariance of the base lobe whose round mean has `variance`, in the tangent frame of the surface. 0 stays
// 0.
glm::dmat2 base_covariance(double variance, const glm::dvec2& stretch) {
  return variance * glm::dmat2(1.0 + stretch.x, stretch.y, stretch.y, 1.0 - stretch.x);
}

// B, M and the weight of every texel; nothing but zeros where the weight is 0.
Image texel_moments(const Image& normals, const Image& variance, double steepest, const Image& stretch) {
  Image out(normals.width, normals.height, moment_channels + 1);
  const std::size_t variance_step = variance.texel_count() == 1 ? 0 : 1;
  const std::size_t stretch_step = stretch.texel_count() == 1 ? 0 : 2;
  for (std::size_t i = 0; i < out.texel_count(); ++i) {
    const float* const n = &normals.texels[4 * i];
    if (n[3] <= 0.0F) continue;
    const glm::dvec2 b = slope_of(glm::normalize(glm::dvec3(n[0], n[1], n[2])), steepest);
    const glm::dmat2 v = base_covariance(variance.texels[i * variance_step],
                                         glm::dvec2(glm::make_vec2(&stretch.texels[i * stretch_step])));
    float* const to = &out.texels[i * (weight_channel + 1)];
    to[slope_x] = static_cast<float>(b.x);
    to[slope_y] = static_cast<float>(b.y);
    // Products of the rounded slope, so that M - B B^T of one texel is as near to 0 as rounding allows.
    to[slope_xx] = static_cast<float>(static_cast<double>(to[slope_x]) * to[slope_x] + v[0][0]);
    to[slope_xy] = static_cast<float>(static_cast<double>(to[slope_x]) * to[slope_y] + v[0][1]);
    to[slope_yy] = static_cast<float>(static_cast<double>(to[slope_y]) * to[slope_y] + v[1][1]);
    to[weight_channel] = n[3];
  }
  return out;
}

// The base roughness for the moments. The texels of both maps must coincide.
Image variance_for_moments(const Material& material) {
  Image variance = lobe_variance_map(material);
  if (variance.texel_count() > 1 && roughness_coordinates(material) != normal_coordinates(material)) {
    throw Error(ErrorKind::usage, fmt::format("material `{}`, roughness=moments", material.name),
                "its normal and roughness maps have different texture coordinates",
                "use roughness=stretched or roughness=shading");
  }
  return variance;
}

// Adds a note about texels whose slope was limited.
void note_steep_texels(const Image& normals, std::string_view map, double steepest, Prefiltered& out) {
  std::size_t steep = 0;
  for (std::size_t i = 0; i < normals.texel_count(); ++i) {
    const float* const n = &normals.texels[4 * i];
    if (n[3] <= 0.0F) continue;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(n[0], n[1], n[2]));
    steep += glm::length(slope_of(normal)) > steepest ? 1 : 0;
  }
  if (steep > 0)
    out.notes.push_back(
        fmt::format("{} of {} texels of the {} are steeper than {:g} and count as that steep (option "
                    "`steepest`)",
                    steep, normals.texel_count(), map, steepest));
}

// Bx, By and the trace of M.
std::vector<Image> with_trace(const std::vector<Image>& chain) {
  std::vector<Image> out = channels_of(chain, {slope_x, slope_y, slope_xx});
  for (std::size_t level = 0; level < out.size(); ++level) {
    for (std::size_t i = 0; i < out[level].texel_count(); ++i)
      out[level].texels[3 * i + 2] += chain[level].texels[moment_channels * i + slope_yy];
  }
  return out;
}

// Mxy and the mean normal.
std::vector<Image> cross_and_normal(const std::vector<Image>& moments, const std::vector<Image>& normals) {
  std::vector<Image> out;
  for (std::size_t level = 0; level < moments.size(); ++level) {
    const Image& from = moments[level];
    Image& to = out.emplace_back(from.width, from.height, 4);
    for (std::size_t i = 0; i < from.texel_count(); ++i) {
      to.texels[4 * i] = from.texels[moment_channels * i + slope_xy];
      std::copy_n(&normals[level].texels[3 * i], 3, &to.texels[4 * i + 1]);
    }
  }
  return out;
}

// Two textures of one map: a shader reads them in one loop.
void add_textures(const std::string& map, const std::vector<Image>& moments, std::vector<Image> normals,
                  SlopeVariant variant, Storage storage, const TextureCoordinates& coordinates, Prefiltered& out) {
  const auto add = [&](const char* name, std::vector<Image> chain) {
    out.textures.push_back(make_texture(map + name, std::move(chain), storage, coordinates));
  };
  if (variant == SlopeVariant::scalar) {
    add("_moments", with_trace(moments));
    if (!normals.empty()) add("_rest", std::move(normals));
    return;
  }
  add("_moments", channels_of(moments, {slope_x, slope_y, slope_xx, slope_yy}));
  add("_rest", normals.empty() ? channels_of(moments, {slope_xy}) : cross_and_normal(moments, normals));
}

}  // namespace

glm::dvec2 slope_of(const glm::dvec3& normal, double steepest) {
  const glm::dvec2 slope = -glm::dvec2(normal) / std::max(normal.z, 1.0 / steepest_slope);
  const double size = glm::length(slope);
  return size > steepest ? slope * (steepest / size) : slope;
}

SlopeMoments layered(const SlopeMoments& a, const SlopeMoments& b) {
  return {a.mean + b.mean, a.second + b.second + glm::outerProduct(a.mean, b.mean) + glm::outerProduct(b.mean, a.mean)};
}

glm::dmat2 covariance(const SlopeMoments& moments) {
  const glm::dmat2 c = moments.second - glm::outerProduct(moments.mean, moments.mean);
  const glm::dvec2 deviator(0.5 * (c[0][0] - c[1][1]), c[0][1]);
  const double middle = 0.5 * (c[0][0] + c[1][1]);
  const double radius = glm::length(deviator);
  if (middle >= radius) return c;
  const double largest = std::max(middle + radius, 0.0);
  const glm::dvec2 turn = deviator / std::max(radius, 1e-300);
  return 0.5 * largest * glm::dmat2(1.0 + turn.x, turn.y, turn.y, 1.0 - turn.x);
}

std::vector<Image> slope_moment_chain(const Image& normals, const Image& variance, double steepest,
                                      const Image& stretch) {
  if (variance.texel_count() != 1 && (variance.width != normals.width || variance.height != normals.height)) {
    throw Error(
        ErrorKind::usage, "slope moments",
        fmt::format("the roughness map has {}x{} texels, the normal map {}x{}: their moments cannot be baked into "
                    "one texture",
                    variance.width, variance.height, normals.width, normals.height),
        "use roughness=stretched or roughness=shading, or give both maps one size");
  }
  return channels_of(weighted_mip_chain(texel_moments(normals, variance, steepest, stretch)),
                     {slope_x, slope_y, slope_xx, slope_xy, slope_yy});
}

std::vector<Image> channels_of(const std::vector<Image>& chain, const std::vector<int>& channels) {
  std::vector<Image> out;
  for (const Image& level : chain) {
    Image& picked = out.emplace_back(level.width, level.height, static_cast<int>(channels.size()));
    auto to = picked.texels.begin();
    for (std::size_t i = 0; i < level.texel_count(); ++i) {
      for (const int c : channels)
        *to++ = level.texels[i * static_cast<std::size_t>(level.channels) + static_cast<std::size_t>(c)];
    }
  }
  return out;
}

OptionSpec slope_roughness_option() {
  return word_option(
      "roughness", {"stretched", "shading", "moments"},
      "Where the base lobe joins the slopes: the base lobe itself, stretched to the covariance of slopes; its variance "
      "alone, added to a Gaussian of slopes when shading; or added to the moments when baking.");
}

OptionSpec steepest_slope_option() {
  return number_option("steepest", default_steepest, 0.5, steepest_slope,
                       "The steepest slope of a texel, the tangent of its angle; steeper ones count as that steep. One "
                       "texel of slope 50 "
                       "has the second moment of 10000 of slope 0.5.");
}

OptionSpec slope_variant_option() {
  return word_option("variant", {"lean", "clean"},
                     "The whole covariance of slopes, or its trace alone (CLEAN): a round lobe and three channels "
                     "instead of five.");
}

Prefiltered bake_slopes(const Material& material, const Options& options, const EffectSet& effects,
                        const StoredSlopes& stored) {
  const Storage storage = parse_storage(options.word("storage"));
  const bool in_moments = options.word("roughness") == "moments" && has(effects, Effect::normal_variation);
  const double steepest = options.number("steepest");
  const Image no_variance(1, 1, 1, 0.0F);
  Prefiltered out;
  if (has(effects, Effect::normal_variation)) {
    const Image variance = in_moments ? variance_for_moments(material) : no_variance;
    Image normals = normal_map_of(material);
    if (normals.texel_count() == 1) normals = nearest_texels(normals, variance.width, variance.height);
    note_steep_texels(normals, "normal map", steepest, out);
    const Image stretch = in_moments ? stretch_map_of(material) : Image(1, 1, 2, 0.0F);
    const std::vector<Image> moments = slope_moment_chain(normals, variance, steepest, stretch);
    add_textures("slope", moments, stored.mean_normal ? mean_normal_chain(std::move(normals)) : std::vector<Image>(),
                 stored.variant, storage, normal_coordinates(material), out);
  }
  if (has(effects, Effect::normal_layers)) {
    const Image layer = layer_map_of(material);
    note_steep_texels(layer, "layer", steepest, out);
    add_textures("layer", slope_moment_chain(layer, no_variance, steepest), {}, stored.variant, storage,
                 layer_coordinates(material), out);
  }
  if (!in_moments && stored.lobe_variance)
    append(out.textures, bake_lobe_variance(material, storage, effects).textures);
  return out;
}

}  // namespace footprint
