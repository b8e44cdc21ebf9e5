// One JSON object per material and texture, and the uniforms that a module reads.
#include "renderer/baked_files/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "renderer/bake/facets.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/baked_files/baked_files.hpp"
#include "renderer/core/names.hpp"
#include "renderer/scene/gltf/document.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<Word<TextureFilter>, 4> filters{{{TextureFilter::trilinear, "trilinear"},
                                                      {TextureFilter::nearest, "nearest"},
                                                      {TextureFilter::linear, "linear"},
                                                      {TextureFilter::by_level, "linear"}}};
constexpr auto geometries = std::to_array<Word<GeometryTerm>>({{GeometryTerm::none, "none"},
                                                               {GeometryTerm::tan, "tan"},
                                                               {GeometryTerm::ward, "ward"},
                                                               {GeometryTerm::smith, "smith"}});

Json brdf_json(const BaseBrdf& brdf) {
  const std::string lobe = lobe_text({brdf.distribution, 1.0});
  return {{"distribution", lobe.substr(0, lobe.find(':'))},
          {"geometry", word_for(geometries, brdf.geometry)},
          {"fresnel", brdf.fresnel == FresnelTerm::schlick ? "schlick" : "none"},
          {"diffuse", brdf.diffuse}};
}

template <class Vector>
Json numbers(const Vector& vector) {
  Json list = Json::array();
  for (int i = 0; i < Vector::length(); ++i) list.push_back(vector[i]);
  return list;
}

Json coordinates_json(const TextureCoordinates& coordinates) {
  Json transform = Json::array();
  for (int column = 0; column < 3; ++column) transform.push_back(numbers(coordinates.transform[column]));
  return {{"set", coordinates.texcoord.value_or(coordinates.set)},
          {"vertex_set", coordinates.set},
          {"transform", std::move(transform)},
          {"wrap", {word_for(manifest_wraps, coordinates.wrap[0]), word_for(manifest_wraps, coordinates.wrap[1])}}};
}

Json texture_json(const PrefilteredTexture& texture, const TextureFiles& files) {
  Json levels = Json::array();
  for (const TextureLevel& level : texture.levels) levels.push_back({level.width, level.height});
  return {{"name", texture.name},
          {"sampler", texture.layers > 0 ? "sampler2DArray" : "sampler2D"},
          {"storage", storage_name(texture.storage)},
          {"channels", texture.channels},
          {"layers", texture.layers},
          {"filter", word_for(filters, texture.filter)},
          {"lookup", word_for(manifest_lookups, texture.filter)},
          {"coordinates", coordinates_json(texture.coordinates)},
          {"levels", std::move(levels)},
          {"bytes", byte_count(texture)},
          {"exr", files.exr},
          {"ktx2", files.ktx2},
          {"png", files.png}};
}

Json textures_json(const std::vector<PrefilteredTexture>& textures, const std::vector<TextureFiles>& files) {
  Json list = Json::array();
  for (std::size_t t = 0; t < textures.size(); ++t) list.push_back(texture_json(textures[t], files[t]));
  return list;
}

// The uniforms of the material itself: its lobe and, if there are several per facet, those.
Json material_uniforms(const Material& material, const EffectSet& effects) {
  Json uniforms = Json::object();
  uniforms["lobe_cutoff"] = {lobe_of(material).parameter, material.alpha_cutoff.value_or(-1.0F), 0.0,
                             squared_strength(material)};
  if (has(effects, Effect::anisotropic_lobe)) uniforms["lobe_anisotropy"] = numbers(anisotropy_of(material));
  if (!has(effects, Effect::multi_lobe)) return uniforms;
  uniforms["facet_lobe_count"] = material.lobes.size();
  for (std::size_t k = 0; k < material.lobes.size(); ++k) {
    const FacetLobe& lobe = material.lobes[k];
    const std::string place = fmt::format("facet_lobes[{}].", k);
    uniforms[place + "axis"] = numbers(lobe.axis);
    uniforms[place + "parameter"] = lobe.parameter;
    uniforms[place + "weight"] = lobe.weight;
    uniforms[place + "variance"] = lobe_variance({material.brdf.distribution, lobe.parameter});
  }
  return uniforms;
}

// All uniforms: the material's, and the scalars and vectors of the method.
Json uniforms_json(const Material& material, const Prefiltered& prefiltered, const EffectSet& effects) {
  Json uniforms = material_uniforms(material, effects);
  for (const auto& [name, value] : prefiltered.scalars) uniforms[name] = value;
  for (const auto& [name, values] : prefiltered.vectors) {
    for (std::size_t i = 0; i < values.size(); ++i) uniforms[fmt::format("{}[{}]", name, i)] = numbers(values[i]);
  }
  return uniforms;
}

Json surface_coordinates_json(const Prefiltered& prefiltered) {
  Json list = Json::array();
  for (const glm::vec2& uv : *prefiltered.surface_coordinates) list.push_back(numbers(uv));
  return list;
}

// The notes that a bake of another program, or a reading of these files, does not make again.
std::vector<std::string> own_notes(const BakeToFiles& bake, std::size_t index) {
  const BakedMethod& baked = bake.baked;
  std::vector<std::string> notes = baked.materials[index].notes;
  const auto common = common_notes(*baked.method, bake.scene.materials[index], baked.options, bake.effects);
  std::erase_if(notes, [&](const std::string& note) { return std::ranges::find(common, note) != common.end(); });
  return notes;
}

// A map that does not vary on any material of the scene is a factor, as in Footprint's own pipeline.
Json surface_json(const Material& material, const EffectSet& effects) {
  const bool metallic_varies = has(effects, Effect::metallic_variation) && metallic_map(material) != nullptr;
  const bool specular_varies = has(effects, Effect::specular_variation) && material.specular_map;
  const bool color_varies = has(effects, Effect::base_color_variation) && material.base_color_map;
  glm::vec3 specular = material.dielectric_specular;
  if (!specular_varies) specular *= glm::make_vec3(specular_map_of(material).texels.data());
  return {{"base_color", numbers(material.base_color)},
          {"dielectric_specular", numbers(specular)},
          {"metallic", metallic_varies ? 1.0F : metallic_map_of(material).texels.front()},
          {"double_sided", material.double_sided},
          {"maps_of_its_own",
           {{"base_color", color_varies}, {"metallic", metallic_varies}, {"specular", specular_varies}}}};
}

Json material_json(const BakeToFiles& bake, std::size_t index, const MaterialFiles& files) {
  const Material& material = bake.scene.materials[index];
  const Prefiltered& prefiltered = bake.baked.materials[index];
  const EngineMaps engine = index < bake.engine.size() ? bake.engine[index] : EngineMaps();
  const EffectSet effects = bake.effects & bake.baked.method->info.honours;
  std::vector<std::string> notes = prefiltered.notes;
  if (material.anisotropy_map && has(effects, Effect::anisotropic_lobe))
    notes.emplace_back("its anisotropy varies, and `lobe_anisotropy` is the mean");
  if (!engine.missing.empty()) notes.push_back(engine.missing);
  Json document{{"name", material.name},
                {"surface", surface_json(material, bake.effects)},
                {"uniforms", uniforms_json(material, prefiltered, effects)},
                {"bytes", byte_count(prefiltered)},
                {"notes", notes},
                {"method_notes", own_notes(bake, index)},
                {"textures", textures_json(prefiltered.textures, files.textures)},
                {"imports", textures_json(engine.textures, files.imports)},
                {"bumpslopes", files.bumpslopes ? Json(*files.bumpslopes) : Json()}};
  if (prefiltered.surface_coordinates) document["surface_coordinates"] = surface_coordinates_json(prefiltered);
  return document;
}

Json options_json(const Options& options) {
  Json all = Json::object();
  for (const auto& [name, value] : options.all())
    std::visit([&, key = name](const auto& content) { all[key] = content; }, value);
  return all;
}

// The values of an object as texts.
std::map<std::string, std::string> words_in(Json object) {
  normalize_gltf(object);
  std::map<std::string, std::string> words;
  for (const auto& [name, value] : object.items()) words[name] = manifest_word(value);
  return words;
}

}  // namespace

std::map<std::string, std::string> words_of(const BaseBrdf& brdf) { return words_in(brdf_json(brdf)); }

std::map<std::string, std::string> words_of(const Options& options) { return words_in(options_json(options)); }

std::vector<std::string> material_uniform_names(const Material& material, const EffectSet& effects) {
  std::vector<std::string> names;
  const Json uniforms = material_uniforms(material, effects);
  for (const auto& uniform : uniforms.items()) names.push_back(uniform.key());
  return names;
}

std::string manifest_json(const BakeToFiles& bake, const BakeListing& listing) {
  const EffectSet& honours = bake.baked.method->info.honours;
  Json materials = Json::array();
  for (std::size_t i = 0; i < listing.materials.size(); ++i)
    materials.push_back(material_json(bake, i, listing.materials[i]));
  Json document{{"schema", manifest_schema},
                {"tool", {{"name", "footprint"}, {"version", bake.version}}},
                {"scene", {{"name", bake.scene.name}, {"source", bake.scene.source}}},
                {"method", bake.baked.spec.text},
                {"options", options_json(bake.baked.options)},
                {"footprint", footprint_filter_text(bake.footprint)},
                {"brdf", brdf_json(bake.scene.materials.front().brdf)},
                {"effects", effect_names(bake.effects & honours)},
                {"left_out", effect_names(bake.effects & ~honours)},
                {"module", listing.module},
                {"shaders", listing.shaders},
                {"bytes", bake.baked.bytes},
                {"materials", std::move(materials)}};
  if (!bake.baked.method->file_content.empty()) document["method_file"] = bake.baked.method->file_content;
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace footprint
