// `xu_vmf`: joins base BRDF and normal map into von Mises-Fisher lobes every frame, and averages them by parts of the
// hemisphere. Xu, Wang, Zhao, Bao 2017, "Real-Time Linear BRDF MIP-Mapping".
#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/xu_vmf/instant_map.hpp"
#include "methods/xu_vmf/surface_layout.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/image/image.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint {

extern const EmbeddedTexts xu_vmf_glsl;

namespace {

OptionSpec threshold_option(std::string name, double value, std::string meaning) {
  return number_option(std::move(name), value, 0.0, 1.0, std::move(meaning));
}

std::vector<OptionSpec> option_table() {
  return {word_option("j", {"adaptive", "1", "4", "8"},
                      "Parts of the hemisphere, a lobe each: a fixed number, or each footprint's own by the thresholds "
                      "eps0 and eps1."),
          word_option("space", {"tangent", "camera"},
                      "Where lobes are joined: in the frame of the normal map, once for all places that show it, or in "
                      "camera space, where the mesh's curvature is filtered too and what faces away is left out."),
          word_option(
              "culling", {"triangles", "normals"},
              "What space=camera leaves out: texels of triangles that face away, or also those whose own normal does."),
          word_option("partition", {"azimuth", "latitude"},
                      "How the hemisphere is cut: 4 sectors, each in 2 rings, or 4 rings, each in 2 halves."),
          word_option("pole", {"middle", "up"},
                      "What partition=latitude is about: the middle of the hemisphere, which its 4 parts surround as "
                      "rings, or the y axis, which points up in camera space, in 4 bands of 45 degrees."),
          word_option("variant", {"corrected", "published", "algorithm1"},
                      "How lobes add: by their shares of the footprint with normalised densities, by equation 15 with "
                      "the density of equation 7, or as Algorithm 1 prints it, without shares."),
          word_option("lobe", {"base", "vmf"},
                      "What a part reflects with: the scene's base lobe of the width that kappa says, or the paper's "
                      "von Mises-Fisher lobe."),
          word_option("masking", {"lobes", "footprint"},
                      "What geometry=smith masks a lobe by: the facets of that lobe, or those of all lobes of the "
                      "footprint, as LEADR does with its one lobe."),
          word_option("conversion", {"newton", "table", "published"},
                      "How |r| comes of kappa: by Newton's steps, from a table of 1024 entries over log kappa, or from "
                      "one over kappa from 0 to 1023, beyond which lobes stay as wide as the last."),
          word_option("specular", {"separate", "joint"},
                      "Whether the map of specular colours is filtered on its own, or texels also weigh by the "
                      "luminance of theirs: what is bright and what is narrow are then filtered together."),
          word_option("storage", {"fp32", "fp16"}, "How the map is stored: 32-bit or half floats."),
          word_option("rebuild", {"always", "changed"},
                      "When the map is built: for every frame, or when something that goes into it has changed."),
          word_option("thresholds", {"hard", "blended"},
                      "Whether j=adaptive steps at eps0 and eps1, or blends over the 0.02 below each."),
          threshold_option("eps0", 0.95, "j=adaptive: one lobe serves the whole footprint where its |r| is above."),
          threshold_option("eps1", 0.85, "j=adaptive: one lobe serves one of the 4 parts where its |r| is above.")};
}

// Whether the maps can be joined texel by texel: they have the same coordinates, or one is missing.
bool can_join(const Material& material) {
  if (width_map(material) == nullptr) return true;
  const TextureCoordinates roughness = roughness_coordinates(material);
  TextureCoordinates normal = normal_coordinates(material);
  if (!material.normal_map) normal.wrap = roughness.wrap;
  return normal == roughness;
}

// 1 - |r| over the logarithm of kappa, 0.01 to 100 000. |r| itself is near 1 over most of the range.
Image shortfall_table() {
  constexpr int entries = 1024;
  Image table(entries, 1, 1);
  for (int i = 0; i < entries; ++i) {
    const double kappa = 1e-2 * std::pow(1e7, static_cast<double>(i) / (entries - 1));
    table.at(i, 0)[0] = static_cast<float>(vmf_shortfall(kappa));
  }
  return table;
}

// |r| of kappa = 0, 1, ..., 1023: 1 x 1024 texels, as the paper's. Its range is not printed; steps of 1 are ours.
Image length_table() {
  Image table(1024, 1, 1);
  for (int i = 0; i < table.width; ++i) table.at(i, 0)[0] = static_cast<float>(1.0 - vmf_shortfall(i));
  return table;
}

// The maps to join, and their coordinates.
struct Inputs {
  bool normals_vary, roughness_varies, colours_vary;
  Image normals, variances, weights;
  TextureCoordinates coordinates;

  Inputs(const Material& material, const EffectSet& effects, bool joint)
      : normals_vary(has(effects, Effect::normal_variation)),
        roughness_varies(has(effects, Effect::roughness_variation)),
        colours_vary(joint && has(effects, Effect::specular_variation)),
        normals(normals_vary ? normal_map_of(material) : Image(1, 1, 4)),
        variances(roughness_varies ? lobe_variance_map(material) : Image(1, 1, 1)),
        weights(colours_vary ? specular_weights(specular_map_of(material)) : Image(1, 1, 1)),
        coordinates(normals_vary && material.normal_map ? normal_coordinates(material)
                                                        : roughness_coordinates(material)) {}

  [[nodiscard]] bool anything() const { return normals_vary || roughness_varies; }
  [[nodiscard]] glm::ivec2 size() const {
    return {std::max({normals.width, variances.width, weights.width}),
            std::max({normals.height, variances.height, weights.height})};
  }
};

// Layers of the texture of the whole hemisphere: if facets have several lobes, one for each and one of normals alone.
int layers_of(const Material& material, const EffectSet& effects) {
  return has(effects, Effect::multi_lobe) && !material.lobes.empty() ? static_cast<int>(material.lobes.size()) + 1 : 1;
}

// Declares the maps that the frame build fills, for a finest level of `size`. The walk over parts gathers texels of the
// whole hemisphere's map and chooses levels itself, so anisotropic samplers must not be used.
void declare_maps(Prefiltered& out, const glm::ivec2& size, const TextureCoordinates& coordinates, int layers,
                  const xu_vmf::Settings& settings, const EffectSet& effects) {
  const int parts = settings.part_layers();
  const bool guard = settings.has_guards(effects);
  const bool whole_is_averaged = parts == 0 || layers > 1;
  const auto declare = [&](std::string_view name, const glm::ivec2& texels, int count, int channels, bool whole_chain) {
    out.textures.push_back(make_built_texture({.name = std::string(name),
                                               .storage = settings.storage,
                                               .channels = channels,
                                               .layers = count,
                                               .coordinates = coordinates},
                                              texels, whole_chain));
    if (parts > 0) out.textures.back().filter = TextureFilter::by_level;
  };
  declare(xu_vmf::whole_name, size, layers, 4, whole_is_averaged);
  if (guard) declare(xu_vmf::whole_guard_name, size, 1, 1, whole_is_averaged);
  if (parts == 0) return;
  const glm::ivec2 half = glm::max(size / 2, glm::ivec2(1));
  declare(xu_vmf::parts_name, half, parts * std::max(layers - 1, 1), 4, true);
  if (guard) declare(xu_vmf::parts_guard_name, half, parts, 1, true);
}

// Moves the maps out of `inputs`, so that they are in memory once.
void add_inputs(Prefiltered& out, Inputs& inputs, const Material& material, const xu_vmf::Settings& settings) {
  const auto add = [&](std::string_view name, Image image, const TextureCoordinates& coordinates, bool all_levels) {
    std::vector<Image> levels;  // an initializer list would copy the map
    if (all_levels) {
      levels = mip_chain(std::move(image));
    } else {
      levels.push_back(std::move(image));
    }
    out.textures.push_back(make_texture(std::string(name), std::move(levels), Storage::fp32, coordinates));
  };
  if (inputs.normals_vary) add(xu_vmf::normals_name, std::move(inputs.normals), normal_coordinates(material), false);
  // Shading reads the coarser levels for the facets' own share of a lobe's width.
  if (inputs.roughness_varies)
    add(xu_vmf::variances_name, std::move(inputs.variances), roughness_coordinates(material), true);
  if (inputs.colours_vary) add(xu_vmf::colours_name, std::move(inputs.weights), specular_coordinates(material), false);
  if (settings.conversion == xu_vmf::Conversion::table) add(xu_vmf::table_name, shortfall_table(), {}, false);
  if (settings.conversion == xu_vmf::Conversion::published) add(xu_vmf::table_name, length_table(), {}, false);
}

Prefiltered in_tangent_space(Inputs inputs, const Material& material, const xu_vmf::Settings& settings,
                             const EffectSet& effects) {
  Prefiltered out;
  if (inputs.normals_vary && inputs.roughness_varies && !can_join(material)) {
    inputs.variances = mip_chain(std::move(inputs.variances)).back();
    out.notes.emplace_back(
        "the roughness map has other texture coordinates than the normal map and cannot be joined with it; its mean "
        "variance stands in");
  }
  if (inputs.colours_vary && material.specular_map && inputs.coordinates != specular_coordinates(material)) {
    inputs.weights = Image(1, 1, 1, 1.0F);
    out.notes.emplace_back(
        "the map of specular colours has other texture coordinates and cannot be joined; it is filtered on its own");
  }
  declare_maps(out, inputs.size(), inputs.coordinates, layers_of(material, effects), settings, effects);
  add_inputs(out, inputs, material, settings);
  return out;
}

/// The frame build filters. Therefore the bake consists of its inputs and the coordinates of its map.
Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& /*progress*/) {
  const xu_vmf::Settings settings = xu_vmf::settings_of(options);
  Inputs inputs(material, effects, settings.joint);
  if (!inputs.anything()) return {};
  return in_tangent_space(std::move(inputs), material, settings, effects);
}

Prefiltered precompute_on(const Scene& scene, std::size_t index, const Options& options, const EffectSet& effects,
                          const Progress& progress) {
  const Material& material = scene.materials.at(index);
  const xu_vmf::Settings settings = xu_vmf::settings_of(options);
  Inputs inputs(material, effects, settings.joint);
  if (!settings.camera_space || !inputs.anything()) return precompute(material, options, effects, progress);
  xu_vmf::SurfaceLayout layout = xu_vmf::lay_out(collect_triangles(scene, index), inputs.coordinates, inputs.size());
  // In a scene with maps, the single texel of a material without maps would show one normal of the whole mesh.
  if (inputs.size() == glm::ivec2(1)) {
    layout.unique = false;
    layout.note.clear();
  }
  Prefiltered out;
  if (layout.unique) {
    TextureCoordinates coordinates;
    coordinates.wrap = {Wrap::clamp_to_edge, Wrap::clamp_to_edge};
    declare_maps(out, layout.size, coordinates, layers_of(material, effects), settings, effects);
    add_inputs(out, inputs, material, settings);
  } else {
    out = in_tangent_space(std::move(inputs), material, settings, effects);
  }
  if (!layout.note.empty()) out.notes.push_back(std::move(layout.note));
  out.scalars.emplace(xu_vmf::camera_space_name, layout.unique ? 1.0F : 0.0F);
  out.surface_coordinates = std::move(layout.coordinates);
  return out;
}

std::unique_ptr<FrameBuild> frame_build(const ShaderVariant& variant, const Options& options) {
  const bool anything =
      has(variant.effects, Effect::normal_variation) || has(variant.effects, Effect::roughness_variation);
  return anything ? std::make_unique<xu_vmf::InstantMap>(variant, options) : nullptr;
}

}  // namespace

const Method& xu_vmf_method() {
  static const Method method{
      .info = {.name = "xu_vmf",
               .summary = "Lobes of base BRDF and normal map together, joined each frame and averaged by parts of "
                          "the hemisphere.",
               .paper = "Xu et al. 2017, Real-Time Linear BRDF MIP-Mapping, Computer Graphics Forum 36(4)",
               .options = option_table(),
               .honours = map_effects_but({Effect::anisotropic_lobe, Effect::normal_layers})},
      .precompute = precompute,
      .shader = module_of(xu_vmf_glsl, "xu_vmf.glsl"),
      .precompute_on = precompute_on,
      .frame_build = frame_build,
      .lobe_count = [](const Options& options) { return xu_vmf::settings_of(options).most_lobes; }};
  return method;
}

}  // namespace footprint
