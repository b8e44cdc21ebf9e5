// `cells`: the normals of a material in parts that are the same at every level; a texel stores weight, mean and
// covariance of each, as moments that filter linearly. With one part it is LEAN mapping.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "methods/cells/cell_moments.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {

namespace embedded {
extern const EmbeddedTexts cells_glsl;
}

namespace {

using cells::Covariance;
using cells::PlanePoint;

std::vector<OptionSpec> option_table() {
  return {whole_option("k", 4, 1, cells::most_parts, "Number of groups of normals; 1 is LEAN."),
          word_option("labels", {"joint", "global"},
                      "How texels are given to parts: so that blocks of all sizes are well described by one Gaussian "
                      "a part, or by one mixture over the whole map."),
          word_option("storage", {"fp32", "fp16"}, "How moments are stored: 32-bit or 16-bit floats."),
          word_option("covariance", {"axes", "full"},
                      "What a texel keeps of a part's covariance: along the part's own axes, or whole."),
          word_option("coordinates", {"stereographic", "slopes"},
                      "What moments are of: the stereographic projection of normals, or their slopes, as LEAN has "
                      "them."),
          word_option("roughness", {"joint", "separate"},
                      "Where the roughness varies: one mean of the base lobe's variance a part, or one for all."),
          word_option("density", {"fast", "exact"},
                      "The base lobe of Blinn and Phong: by two instructions within 2e-4 of its peak, or to rounding."),
          steepest_slope_option()};
}

// The parts and what they are of, for one material.
struct PartedNormals {
  int width, height;
  std::size_t parts;
  std::vector<PlanePoint> points;  // over the plane that moments are of
  std::vector<float> shares;
};

PartedNormals parted(const Material& material, const Options& options, const Progress& progress) {
  const Image normals = normal_map_of(material);
  const double steepest = options.number("steepest");
  std::vector<PlanePoint> points = cells::plane_points(normals, cells::Coordinates::stereographic, steepest);
  const cells::PartitionSettings settings{
      .parts = static_cast<int>(options.number("k")),
      .labels = options.word("labels") == "joint" ? cells::Labels::joint : cells::Labels::global,
      .variance = lobe_variance_chain(material).back().texels[0]};
  std::vector<float> shares = cells::partition(points, normals.width, normals.height, settings, progress);
  if (options.word("coordinates") == "slopes")
    points = cells::plane_points(normals, cells::Coordinates::slopes, steepest);
  return {normals.width, normals.height, static_cast<std::size_t>(settings.parts), std::move(points),
          std::move(shares)};
}

// An array texture whose layers are made one after the other: the finest levels of all at once would be the largest
// thing in memory.
template <typename Finest>
PrefilteredTexture layered_texture(const std::string& name, int layers, Storage storage,
                                   const TextureCoordinates& coordinates, const Finest& finest) {
  std::vector<std::vector<Image>> chains;
  chains.reserve(static_cast<std::size_t>(layers));
  for (int layer = 0; layer < layers; ++layer) chains.push_back(mip_chain(finest(layer)));
  return make_array_texture(name, std::move(chains), storage, coordinates);
}

Covariance covariance_of(const Options& options) {
  return options.word("covariance") == "axes" ? Covariance::axes : Covariance::full;
}

int moment_layer_count(const Options& options) {
  return cells::layer_count(cells::part_channels(covariance_of(options)) * static_cast<int>(options.number("k")));
}

// Of the mean of the unit normals: over the stereographic plane the moments tell it.
bool keeps_mean_normals(const Options& options, const EffectSet& effects) {
  return has(effects, Effect::diffuse) && options.word("coordinates") == "slopes";
}

void add_moments(const PartedNormals& normals, const Options& options, const TextureCoordinates& coordinates,
                 Prefiltered& out) {
  const Covariance covariance = covariance_of(options);
  const auto frames = cells::part_frames(normals.points, normals.shares, normals.parts, covariance);
  const auto add = [&](const char* name, std::size_t k, const glm::dvec2& value) {
    out.scalars[fmt::format("cells_{}_x{}", name, k)] = static_cast<float>(value.x);
    out.scalars[fmt::format("cells_{}_y{}", name, k)] = static_cast<float>(value.y);
  };
  for (std::size_t k = 0; k < frames.size(); ++k) {
    add("centre", k, frames[k].centre);
    if (covariance == Covariance::axes) add("axis", k, frames[k].axis);
  }
  const cells::PartedPoints map{normals.points, normals.shares, normals.parts, normals.width, normals.height};
  out.textures.push_back(
      layered_texture("cells_moments", moment_layer_count(options), parse_storage(options.word("storage")), coordinates,
                      [&](int layer) { return cells::moment_layer(map, frames, covariance, layer); }));
}

glm::ivec2 size_of(const TextureMap* map) {
  return map == nullptr ? glm::ivec2(1) : glm::ivec2(map->image.width(), map->image.height());
}

bool roughness_lies_on_normals(const Material& material) {
  const glm::ivec2 roughness = size_of(width_map(material));
  const glm::ivec2 normals = size_of(material.normal_map ? &*material.normal_map : nullptr);
  return roughness_coordinates(material) == normal_coordinates(material) && roughness.x <= normals.x &&
         roughness.y <= normals.y;
}

// A texel of the roughness map can be counted with the part of the normal above it where the maps lie on each other and
// nothing finer than a normal is lost. Else, as with `separate`, it has a chain of its own; a texture that a material
// has no use for is one texel.
void add_roughness(const Material& material, const Options& options, const PartedNormals& normals, Storage storage,
                   const EffectSet& effects, Prefiltered& out) {
  Image variance = lobe_variance_map(material);
  const bool joint = roughness_lies_on_normals(material);
  out.scalars["cells_joint"] = joint ? 1.0F : 0.0F;
  for (float& v : variance.texels) v = std::min(v, 1.0F) / stored_lobe_variance;
  const int layers = cells::layer_count(static_cast<int>(normals.parts));
  out.textures.push_back(
      layered_texture("cells_variance", layers, storage, normal_coordinates(material), [&](int layer) {
        if (!joint) return Image(1, 1, 4);
        return cells::variance_layer(normals.points, normals.shares, normals.parts, variance, normals.width,
                                     normals.height, layer);
      }));
  Prefiltered separate = bake_lobe_variance(material, storage, effects);
  if (joint) {
    separate.textures.front() =
        make_texture(separate.textures.front().name, {Image(1, 1, 1)}, storage, roughness_coordinates(material));
  }
  std::ranges::move(separate.textures, std::back_inserter(out.textures));
  if (!joint && options.word("roughness") == "joint" && normals.parts > 1)
    out.notes.emplace_back("the roughness map does not lie on the normal map's texels: all parts have one variance");
}

class Cells final : public Method {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                                       const Progress& progress) const override {
    const Storage storage = parse_storage(options.word("storage"));
    if (!has(effects, Effect::normal_variation)) return bake_lobe_variance(material, storage, effects);
    Prefiltered out;
    const PartedNormals normals = parted(material, options, progress);
    add_moments(normals, options, normal_coordinates(material), out);
    if (keeps_mean_normals(options, effects))
      out.textures.push_back(
          make_texture("cells_normal", mean_normal_chain(material), storage, normal_coordinates(material)));
    if (!has(effects, Effect::roughness_variation)) return out;
    if (options.word("roughness") == "joint") {
      add_roughness(material, options, normals, storage, effects, out);
    } else {
      std::ranges::move(bake_lobe_variance(material, storage, effects).textures, std::back_inserter(out.textures));
    }
    return out;
  }

  [[nodiscard]] int lobe_count(const Options& options) const override { return static_cast<int>(options.number("k")); }

  // The flags are lean's, which common_slopes.glsl asks for.
  [[nodiscard]] ShaderModule shader() const override {
    return module_of(embedded::cells_glsl, "cells.glsl",
                     {{"variant_clean", false}, {"roughness_stretched", true}, {"roughness_moments", false}});
  }

 private:
  MethodInfo info_{.name = "cells",
                   .summary =
                       "Mean and covariance for each of several groups of normals, the same groups at every level: "
                       "moments that filter linearly, one stretched lobe per group.",
                   .paper = "Footprint's own; with one part Olano and Baker 2010, LEAN Mapping, I3D",
                   .options = option_table(),
                   .honours = map_effects_but({Effect::multi_lobe, Effect::normal_layers}),
                   .slow_precompute = true};
};

}  // namespace

const Method& cells_method() {
  static const Cells method;
  return method;
}

}  // namespace footprint
