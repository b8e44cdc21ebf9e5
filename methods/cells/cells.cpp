// `cells`: divides the normals of a material into parts, the same parts at every level. A texel stores weight, mean and
// covariance of each part as moments, which filter linearly. With one part it is LEAN mapping.
#include <algorithm>
#include <utility>

#include "methods/cells/cell_moments.hpp"
#include "methods/cells/partition.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {

extern const EmbeddedTexts cells_glsl;

namespace {

using cells::Covariance;
using cells::PlanePoint;

std::vector<OptionSpec> option_table() {
  return {
      whole_option("k", 4, 1, cells::most_parts, "Number of groups of normals; 1 is LEAN."),
      word_option("labels", {"joint", "global"},
                  "How texels are given to parts: so that blocks of all sizes are well described by one Gaussian "
                  "a part, or by one mixture over the whole map."),
      word_option("storage", {"fp32", "fp16"}, "How moments are stored: 32-bit or 16-bit floats."),
      word_option("covariance", {"axes", "full"},
                  "What a texel stores of a part's covariance: along the part's own axes, or whole."),
      word_option("coordinates", {"stereographic", "slopes"},
                  "What moments are of: the stereographic projection of normals, or their slopes, as LEAN has "
                  "them."),
      word_option("roughness", {"joint", "separate"},
                  "Where the roughness varies: parts of their own for smooth and for rough texels, each with a mean of "
                  "the base lobe's variance, or parts of normals alone and one mean for all."),
      word_option("specular", {"separate", "joint"},
                  "Whether the map of specular colours is filtered on its own, or each part has the colour of its own "
                  "texels, which weigh by its luminance; flat normals are then divided by roughness, too."),
      word_option("density", {"fast", "exact"},
                  "The base lobe of Blinn and Phong: by two instructions within 2e-4 of its peak, or to rounding."),
      steepest_slope_option()};
}

// The options that the bake reads.
struct Settings {
  int parts;
  cells::Labels labels;
  Storage storage;
  Covariance covariance;
  cells::Coordinates coordinates;
  bool joint_roughness;  // one mean of the base lobe's variance per part
  bool joint_colour;     // a specular colour per part
  double steepest;
};

Settings settings_of(const Options& options) {
  return {.parts = static_cast<int>(options.number("k")),
          .labels = options.word("labels") == "joint" ? cells::Labels::joint : cells::Labels::global,
          .storage = parse_storage(options.word("storage")),
          .covariance = options.word("covariance") == "axes" ? Covariance::axes : Covariance::full,
          .coordinates =
              options.word("coordinates") == "slopes" ? cells::Coordinates::slopes : cells::Coordinates::stereographic,
          .joint_roughness = options.word("roughness") == "joint",
          .joint_colour = options.word("specular") == "joint",
          .steepest = options.number("steepest")};
}

// The normals of one material and their shares in the parts.
struct PartedNormals {
  int width, height;
  std::size_t parts;
  std::vector<PlanePoint> points;  // over the plane of the moments
  std::vector<float> shares;

  [[nodiscard]] cells::PartedPoints map() const { return {points, shares, parts, width, height}; }
};

bool has_colours(const Settings& settings, const EffectSet& effects) {
  return settings.joint_colour && has(effects, Effect::specular_variation);
}

// Whether there are parts. Flat normals have parts of roughness where these have colours to separate.
bool has_parts(const Settings& settings, const EffectSet& effects) {
  return has(effects, Effect::normal_variation) ||
         (has_colours(settings, effects) && settings.joint_roughness && has(effects, Effect::roughness_variation));
}

// The specular colours of the texels of the normal map; white where the map of colours lies elsewhere.
Image colours_over(const Material& material, const glm::ivec2& size) {
  return specular_over(material, size, normal_coordinates(material)).value_or(Image(size.x, size.y, 3, 1.0F));
}

PartedNormals parted(const Material& material, const Settings& settings, const EffectSet& effects,
                     const Progress& progress) {
  Image normals = normal_map_of(material);
  if (has_colours(settings, effects)) {
    const Image weights = specular_weights(colours_over(material, {normals.width, normals.height}));
    for (std::size_t i = 0; i < weights.texels.size(); ++i) normals.texels[4 * i + 3] *= weights.texels[i];
  }
  std::vector<PlanePoint> points = cells::plane_points(normals, cells::Coordinates::stereographic, settings.steepest);
  const cells::PartitionSettings partition{
      .parts = settings.parts, .labels = settings.labels, .variance = lobe_variance_chain(material).back().texels[0]};
  const bool joint =
      has(effects, Effect::roughness_variation) && settings.joint_roughness && roughness_lies_on_normals(material);
  std::vector<float> shares =
      joint ? cells::partition_with_roughness(points, cells::texel_variances(material, normals.width, normals.height),
                                              normals.width, normals.height, partition, progress)
            : cells::partition(points, normals.width, normals.height, partition, progress);
  if (settings.coordinates == cells::Coordinates::slopes)
    points = cells::plane_points(normals, cells::Coordinates::slopes, settings.steepest);
  return {normals.width, normals.height, static_cast<std::size_t>(settings.parts), std::move(points),
          std::move(shares)};
}

// Makes the layers of an array texture one after the other, because the finest levels of all of them would be the
// largest allocation of the bake.
template <typename Finest>
PrefilteredTexture layered_texture(const std::string& name, int layers, Storage storage,
                                   const TextureCoordinates& coordinates, const Finest& finest) {
  std::vector<std::vector<Image>> chains;
  chains.reserve(static_cast<std::size_t>(layers));
  for (int layer = 0; layer < layers; ++layer) chains.push_back(mip_chain(finest(layer)));
  return make_array_texture(name, std::move(chains), storage, coordinates);
}

void add_moments(const PartedNormals& normals, const Settings& settings, const TextureCoordinates& coordinates,
                 Prefiltered& out) {
  const Covariance covariance = settings.covariance;
  const auto frames = cells::part_frames(normals.points, normals.shares, normals.parts, covariance);
  for (const cells::PartFrame& frame : frames) {
    out.vectors["cells_centres"].emplace_back(frame.centre);
    if (covariance == Covariance::axes) out.vectors["cells_axes"].emplace_back(frame.axis);
  }
  const cells::PartedPoints map = normals.map();
  const int layers = cells::layer_count(cells::part_channels(covariance) * settings.parts);
  out.textures.push_back(layered_texture("cells_moments", layers, settings.storage, coordinates, [&](int layer) {
    return cells::moment_layer(map, frames, covariance, layer);
  }));
}

// Adds the variance of the base lobe. Each texel counts with the part of its normal if the maps have the same
// coordinates and the roughness map is not finer. Otherwise it has a chain of its own, as with `separate`. All
// materials share a program and therefore have both textures; the unused one is a single texel.
void add_roughness(const Material& material, const PartedNormals& normals, Storage storage, const EffectSet& effects,
                   Prefiltered& out) {
  Image variance = lobe_variance_map(material);
  const bool joint = roughness_lies_on_normals(material);
  out.scalars["cells_joint"] = joint ? 1.0F : 0.0F;
  for (float& v : variance.texels) v = std::min(v, 1.0F) / stored_lobe_variance;
  const int layers = cells::layer_count(static_cast<int>(normals.parts));
  out.textures.push_back(
      layered_texture("cells_variance", layers, storage, normal_coordinates(material), [&](int layer) {
        if (!joint) return Image(1, 1, 4);
        return cells::value_layer(normals.map(), variance, layer);
      }));
  Prefiltered separate = bake_lobe_variance(material, storage, effects);
  if (joint) {
    separate.textures.front() =
        make_texture(separate.textures.front().name, {Image(1, 1, 1)}, storage, roughness_coordinates(material));
  }
  append(out.textures, std::move(separate.textures));
  if (!joint && normals.parts > 1)
    out.notes.emplace_back("the roughness map does not lie on the normal map's texels: all parts have one variance");
}

// Adds the specular colours of the parts, red, green and blue in layers of their own. Points weigh by luminance
// already, so a texel has its colour over that weight.
void add_colours(const Material& material, const PartedNormals& normals, Storage storage, Prefiltered& out) {
  const glm::ivec2 size(normals.width, normals.height);
  const Image colours = colours_over(material, size);
  const Image weights = specular_weights(colours);
  const int layers = cells::layer_count(static_cast<int>(normals.parts));
  out.textures.push_back(
      layered_texture("cells_colours", 3 * layers, storage, normal_coordinates(material), [&](int layer) {
        Image hue = weights;
        for (std::size_t i = 0; i < hue.texels.size(); ++i)
          hue.texels[i] =
              colours.texels[3 * i + static_cast<std::size_t>(layer / layers)] / std::max(hue.texels[i], 1e-20F);
        return cells::value_layer(normals.map(), hue, layer % layers);
      }));
  if (!specular_over(material, size, normal_coordinates(material))) out.notes.emplace_back(specular_elsewhere_note);
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  const Settings settings = settings_of(options);
  const Storage storage = settings.storage;
  if (!has_parts(settings, effects)) return bake_lobe_variance(material, storage, effects);
  Prefiltered out;
  const PartedNormals normals = parted(material, settings, effects, progress);
  const bool coloured = has_colours(settings, effects);
  add_moments(normals, settings, normal_coordinates(material), out);
  if (coloured) add_colours(material, normals, storage, out);
  // Stereographic moments give the mean of the unit normals, unless colours weigh them; moments of slopes do not.
  if (has(effects, Effect::diffuse) && has(effects, Effect::normal_variation) &&
      (coloured || settings.coordinates == cells::Coordinates::slopes)) {
    out.textures.push_back(
        make_texture("cells_normal", mean_normal_chain(material), storage, normal_coordinates(material)));
  }
  if (!has(effects, Effect::roughness_variation)) return out;
  if (settings.joint_roughness) {
    add_roughness(material, normals, storage, effects, out);
  } else {
    append(out.textures, bake_lobe_variance(material, storage, effects).textures);
  }
  return out;
}

}  // namespace

const Method& cells_method() {
  static const Method method{
      .info = {.name = "cells",
               .summary = "Mean and covariance for each of several groups of normals, the same groups at every level: "
                          "moments that filter linearly, one stretched lobe per group.",
               .paper = "Footprint's own; with one part Olano and Baker 2010, LEAN Mapping, I3D",
               .options = option_table(),
               .honours = map_effects_but({Effect::multi_lobe, Effect::normal_layers}),
               .slow_precompute = true},
      .precompute = precompute,
      // common_slopes.glsl reads these flags of `lean`.
      .shader = module_of(cells_glsl, "cells.glsl",
                          {{"variant_clean", false},
                           {"roughness_stretched", true},
                           {"roughness_moments", false},
                           {"part_colours", true}}),
      .lobe_count = [](const Options& options) { return settings_of(options).parts; }};
  return method;
}

}  // namespace footprint
