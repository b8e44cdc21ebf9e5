// `cells`: divides the normals of a material into parts, the same parts at every level. A texel stores weight, mean and
// covariance of each part as moments, which filter linearly. With one part it is LEAN mapping.
#include <algorithm>
#include <utility>

#include "methods/cells/partition.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"

namespace footprint {

extern const EmbeddedTexts cells_glsl;

namespace {

using cells::Covariance;
using cells::PartedPoints;

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

struct Settings {
  const Options& options;
  int parts = static_cast<int>(options.number("k"));
  cells::Labels labels = options.word("labels") == "joint" ? cells::Labels::joint : cells::Labels::global;
  Storage storage = parse_storage(options.word("storage"));
  Covariance covariance = options.word("covariance") == "axes" ? Covariance::axes : Covariance::full;
  bool slopes = options.word("coordinates") == "slopes";        // moments of slopes, not stereographic
  bool joint_roughness = options.word("roughness") == "joint";  // one mean of the base lobe's variance per part
  bool joint_colour = options.word("specular") == "joint";      // a specular colour per part
  double steepest = options.number("steepest");
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

// The normals of a material over the plane of the moments.
PartedPoints parted(const Material& material, const Settings& settings, const EffectSet& effects,
                    const Progress& progress) {
  Image normals = normal_map_of(material);
  if (has_colours(settings, effects)) {
    const Image weights = specular_weights(colours_over(material, {normals.width, normals.height}));
    for (std::size_t i = 0; i < weights.texels.size(); ++i) normals.texels[4 * i + 3] *= weights.texels[i];
  }
  const cells::PartitionSettings partition{
      .parts = settings.parts, .labels = settings.labels, .variance = lobe_variance_chain(material).back().texels[0]};
  const bool joint =
      has(effects, Effect::roughness_variation) && settings.joint_roughness && roughness_lies_on_normals(material);
  const std::vector<double> variances =
      joint ? cells::texel_variances(material, normals.width, normals.height) : std::vector<double>{};
  PartedPoints out = cells::parted_points(normals, settings.steepest, variances, partition, progress);
  if (settings.slopes) out.points = cells::plane_points(normals, cells::Coordinates::slopes, settings.steepest);
  return out;
}

void add_moments(const PartedPoints& normals, const Settings& settings, const TextureCoordinates& coordinates,
                 Prefiltered& out) {
  const Covariance covariance = settings.covariance;
  const auto frames = cells::part_frames(normals, covariance);
  for (const cells::PartFrame& frame : frames) {
    out.vectors["cells_centres"].emplace_back(frame.centre);
    if (covariance == Covariance::axes) out.vectors["cells_axes"].emplace_back(frame.axis);
  }
  out.textures.push_back(make_array_texture("cells_moments", cells::moment_chains(normals, frames, covariance),
                                            settings.storage, coordinates));
}

// Adds the variance of the base lobe. Each texel counts with the part of its normal if the maps have the same
// coordinates and the roughness map is not finer. Otherwise it has a chain of its own, as with `separate`. All
// materials share a program and therefore have both textures; the unused one is a single texel.
void add_roughness(const Material& material, const PartedPoints& normals, Storage storage, const EffectSet& effects,
                   Prefiltered& out) {
  Image variance = lobe_variance_map(material);
  const bool joint = roughness_lies_on_normals(material);
  out.scalars["cells_joint"] = joint ? 1.0F : 0.0F;
  for (float& v : variance.texels) v = std::min(v, 1.0F) / stored_lobe_variance;
  const auto layer = [&](int i) { return joint ? cells::value_layer(normals, variance, i) : Image(1, 1, 4); };
  out.textures.push_back(make_array_texture(
      "cells_variance", cells::layer_chains(cells::layer_count(static_cast<int>(normals.parts)), layer), storage,
      normal_coordinates(material)));
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
void add_colours(const Material& material, const PartedPoints& normals, Storage storage, Prefiltered& out) {
  const glm::ivec2 size(normals.width, normals.height);
  const Image colours = colours_over(material, size);
  const Image weights = specular_weights(colours);
  const int layers = cells::layer_count(static_cast<int>(normals.parts));
  const auto hues = [&](int layer) {
    Image hue = weights;
    for (std::size_t i = 0; i < hue.texels.size(); ++i)
      hue.texels[i] =
          colours.texels[3 * i + static_cast<std::size_t>(layer / layers)] / std::max(hue.texels[i], 1e-20F);
    return cells::value_layer(normals, hue, layer % layers);
  };
  out.textures.push_back(make_array_texture("cells_colours", cells::layer_chains(3 * layers, hues), storage,
                                            normal_coordinates(material)));
  if (!specular_over(material, size, normal_coordinates(material))) out.notes.emplace_back(specular_elsewhere_note);
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  const Settings settings{options};
  const Storage storage = settings.storage;
  if (!has_parts(settings, effects)) return bake_lobe_variance(material, storage, effects);
  Prefiltered out;
  const PartedPoints normals = parted(material, settings, effects, progress);
  const bool coloured = has_colours(settings, effects);
  add_moments(normals, settings, normal_coordinates(material), out);
  if (coloured) add_colours(material, normals, storage, out);
  // Stereographic moments give the mean of the unit normals, unless colours weigh them; moments of slopes do not.
  if (has(effects, Effect::diffuse) && has(effects, Effect::normal_variation) && (coloured || settings.slopes)) {
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
      .shader = module_of(cells_glsl, "cells.glsl"),
      .lobe_count = [](const Options& options) { return Settings{options}.parts; }};
  return method;
}

}  // namespace footprint
