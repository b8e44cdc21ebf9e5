// A table of predicates over materials, and decisions about maps of normals, meshes, lights and shadows.
#include "renderer/effects/effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "renderer/core/names.hpp"
#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/visibility/cast_shadows.hpp"

namespace footprint {
namespace {

constexpr auto effect_words = std::to_array<Word<Effect>>({
    {Effect::diffuse, "diffuse"},
    {Effect::fresnel, "fresnel"},
    {Effect::masking_shadowing, "masking_shadowing"},
    {Effect::normal_variation, "normal_variation"},
    {Effect::normal_layers, "normal_layers"},
    {Effect::roughness_variation, "roughness_variation"},
    {Effect::multi_lobe, "multi_lobe"},
    {Effect::anisotropic_lobe, "anisotropic_lobe"},
    {Effect::anisotropy_variation, "anisotropy_variation"},
    {Effect::base_color_variation, "base_color_variation"},
    {Effect::vertex_color, "vertex_color"},
    {Effect::metallic_variation, "metallic_variation"},
    {Effect::specular_variation, "specular_variation"},
    {Effect::clear_coat, "clear_coat"},
    {Effect::coat_weight_variation, "coat_weight_variation"},
    {Effect::coat_width_variation, "coat_width_variation"},
    {Effect::coat_normal_variation, "coat_normal_variation"},
    {Effect::material_index, "material_index"},
    {Effect::alpha_mask, "alpha_mask"},
    {Effect::double_sided, "double_sided"},
    {Effect::unlit, "unlit"},
    {Effect::emission, "emission"},
    {Effect::emission_variation, "emission_variation"},
    {Effect::occlusion, "occlusion"},
    {Effect::point_light, "point_light"},
    {Effect::spot_light, "spot_light"},
    {Effect::directional_light, "directional_light"},
    {Effect::area_light, "area_light"},
    {Effect::cast_shadow, "cast_shadow"},
    {Effect::environment_light, "environment_light"},
    {Effect::microgeometry_visibility, "microgeometry_visibility"},
    {Effect::microgeometry_colour, "microgeometry_colour"},
    {Effect::tabulated_brdf, "tabulated_brdf"},
});
static_assert(std::ranges::equal(effect_words, all_effects(), {}, &Word<Effect>::value), "a word per effect, in order");

// Smaller than a step of an 8-bit map, and larger than rounding in 32 bits.
constexpr float constant_tolerance = 1e-5F;

bool channel_varies(const Image& image, int channel) {
  const auto stride = static_cast<std::size_t>(image.channels);
  const auto first = static_cast<std::size_t>(channel);
  for (std::size_t i = first; i < image.texels.size(); i += stride) {
    if (std::abs(image.texels[i] - image.texels[first]) > constant_tolerance) return true;
  }
  return false;
}

// A constant map that is tilted is not flat.
bool is_flat(const Image& normals) {
  const auto stride = static_cast<std::size_t>(normals.channels);
  for (std::size_t i = 0; i < normals.texels.size(); i += stride) {
    if (std::hypot(normals.texels[i], normals.texels[i + 1]) > constant_tolerance) return false;
    if (stride == 4 && normals.texels[i + 3] < 0.5F) return false;
  }
  return true;
}

template <class Predicate>
EffectDecision decide(Effect effect, const Scene& scene, Predicate fits, std::string_view on, std::string_view off) {
  const auto n = std::ranges::count_if(scene.materials, fits);
  const std::size_t all = scene.materials.size();
  if (n == 0) return {effect, false, std::string(off)};
  return {effect, true, fmt::format("{} of {} material{}: {}", n, all, all == 1 ? "" : "s", on)};
}

bool varies(const std::optional<TextureMap>& map) { return map && channel_varies(map->image.decoded(), 0); }

bool is_rough(const std::optional<TextureMap>& map) { return map && !is_flat(map->image.decoded()); }

bool reflects_diffusely(const Material& m) {
  const bool albedo = m.base_color.r > 0.0F || m.base_color.g > 0.0F || m.base_color.b > 0.0F;
  return m.brdf.diffuse && albedo && (m.metallic < 1.0F || metallic_map(m) != nullptr);
}

bool anisotropy_varies(const Material& m) {
  if (!m.anisotropy_map || width_map(m) == nullptr) return false;
  const Image axes = m.anisotropy_map->image.decoded();
  return channel_varies(axes, 0) || channel_varies(axes, 1);
}

// A map of stretches changes the width of the round mean, too.
bool roughness_varies(const Material& m) {
  return width_map(m) != nullptr && (channel_varies(width_map(m)->image.decoded(), 0) || anisotropy_varies(m));
}

bool is_stretched(const Material& m) { return m.anisotropy && (m.anisotropy->strength > 0.0F || anisotropy_varies(m)); }

bool metallic_varies(const Material& m) {
  return metallic_map(m) != nullptr && channel_varies(metallic_map(m)->image.decoded(), 1);
}

bool colors_vary(const std::optional<TextureMap>& map) {
  if (!map) return false;
  const Image image = map->image.decoded();
  return channel_varies(image, 0) || channel_varies(image, 1) || channel_varies(image, 2);
}

bool emits(const Material& m) { return m.emission != glm::vec3(0.0F) && !m.unlit; }

// An effect that is on if a material fulfils a predicate.
struct MaterialEffect {
  Effect effect;
  bool (*fits)(const Material& m);
  std::string_view on, off;
};

constexpr auto material_effects = std::to_array<MaterialEffect>(
    {{Effect::diffuse, reflects_diffusely, "a Lambert term with an albedo above 0", "no material reflects diffusely"},
     {Effect::fresnel, [](const Material& m) { return m.brdf.fresnel == FresnelTerm::schlick; },
      "the base BRDF has Schlick's term", "the base BRDF has no Fresnel term"},
     {Effect::masking_shadowing, [](const Material& m) { return m.brdf.geometry != GeometryTerm::none; },
      "the base BRDF has a geometry term", "the base BRDF has no geometry term"},
     {Effect::roughness_variation, roughness_varies, "a roughness map that varies",
      "roughness is constant over each material"},
     {Effect::multi_lobe, [](const Material& m) { return !m.lobes.empty(); },
      "facets with lobes about axes of their own", "every facet has one lobe, about its normal"},
     {Effect::anisotropic_lobe, is_stretched, "a lobe that is wider along one direction", "every lobe is round"},
     {Effect::anisotropy_variation, anisotropy_varies, "a map of anisotropy that varies",
      "anisotropy is constant over each material"},
     {Effect::base_color_variation, [](const Material& m) { return m.base_color_map.has_value(); }, "a base-colour map",
      "no base-colour map"},
     {Effect::metallic_variation, metallic_varies, "a metallic map that varies",
      "metalness is constant over each material"},
     {Effect::specular_variation, [](const Material& m) { return colors_vary(m.specular_map); },
      "a specular map that varies", "the specular colour is constant over each material"},
     {Effect::clear_coat, [](const Material& m) { return m.coat.has_value(); }, "a clear coat",
      "no material has a clear coat"},
     {Effect::coat_weight_variation, [](const Material& m) { return m.coat && varies(m.coat->weight_map); },
      "a map of the coat's weight that varies", "the coat's weight is constant over each material"},
     {Effect::coat_width_variation, [](const Material& m) { return m.coat && varies(m.coat->roughness_map); },
      "a map of the coat's roughness that varies", "the coat's roughness is constant over each material"},
     {Effect::coat_normal_variation, [](const Material& m) { return m.coat && is_rough(m.coat->normal_map); },
      "a normal map of the coat that is not flat", "every coat has the mesh's own normals"},
     {Effect::material_index, [](const Material& m) { return m.share.has_value(); },
      "one of several on its surface, by a map of indices", "one material a surface"},
     {Effect::alpha_mask, [](const Material& m) { return m.alpha_cutoff.has_value(); }, "parts cut out by alpha",
      "no material is cut out by alpha"},
     {Effect::double_sided, [](const Material& m) { return m.double_sided; }, "seen from both sides",
      "every material is one-sided"},
     {Effect::unlit, [](const Material& m) { return m.unlit; }, "a colour that is drawn without light",
      "every material is lit"},
     {Effect::emission, emits, "light of its own", "no material emits light"},
     {Effect::emission_variation, [](const Material& m) { return emits(m) && colors_vary(m.emission_map); },
      "a map of emitted light that varies", "emitted light is constant over each material"},
     {Effect::microgeometry_visibility, [](const Material& m) { return m.microgeometry != nullptr; },
      "a patch of small-scale geometry", "no small-scale geometry"},
     {Effect::microgeometry_colour, [](const Material& m) { return m.microgeometry && needs_colors(*m.microgeometry); },
      "a patch with colours of its own", "no small-scale geometry with colours of its own"},
     {Effect::tabulated_brdf, [](const Material& m) { return m.microgeometry && m.microgeometry->brdf; },
      "facets with a tabulated BRDF", "every facet has the base BRDF"}});

// map: one of normals; word: for it.
EffectDecision normals(Effect effect, const Scene& scene, std::optional<TextureMap> Material::*map,
                       std::string_view word) {
  const bool any = std::ranges::any_of(scene.materials, [&](const Material& m) { return (m.*map).has_value(); });
  const auto rough = [&](const Material& m) { return is_rough(m.*map); };
  return decide(effect, scene, rough, fmt::format("a {} that is not flat", word),
                any ? fmt::format("every {} is flat", word) : fmt::format("no {}", word));
}

// Looks at the meshes: colours are the vertices', not the material's.
EffectDecision vertex_color(const Scene& scene) {
  const auto colored = [](const Vertex& vertex) { return vertex.color != glm::vec4(1.0F); };
  const auto n = std::ranges::count_if(scene.meshes,
                                       [&](const Mesh& mesh) { return std::ranges::any_of(mesh.vertices, colored); });
  return {Effect::vertex_color, n > 0,
          n > 0 ? fmt::format("{} of {} mesh{}: vertices with colours", n, scene.meshes.size(),
                              scene.meshes.size() == 1 ? "" : "es")
                : "no vertex has a colour of its own"};
}

template <class Kind>
EffectDecision lights(Effect effect, const Scene& scene, std::string_view word) {
  const auto n = std::ranges::count_if(scene.lights, [](const Light& l) { return std::holds_alternative<Kind>(l); });
  return {effect, n > 0,
          n > 0 ? fmt::format("{} {} light{}", n, word, n == 1 ? "" : "s") : fmt::format("no {} light", word)};
}

std::string small_suns(const Environment& environment) {
  const std::vector<SmallSun> suns = suns_apart(environment).suns;
  if (suns.empty()) return {};
  double share = 0.0;
  for (const SmallSun& sun : suns) share += sun.share;
  if (suns.size() == 1)
    return fmt::format(", whose small sun, {:.0f}% of its light, methods take as a directional light", 100.0 * share);
  return fmt::format(", whose {} small suns, {:.0f}% of its light, methods take as directional lights", suns.size(),
                     100.0 * share);
}

EffectDecision environment_light(const Scene& scene) {
  if (!scene.environment) return {Effect::environment_light, false, "no environment"};
  const Image& map = *scene.environment->radiance;
  const bool lit = std::ranges::any_of(map.texels, [](float value) { return value > 0.0F; });
  std::string text = fmt::format("the environment {}, {} x {}", scene.environment->name, map.width, map.height);
  text += small_suns(*scene.environment);
  return {Effect::environment_light, lit, lit ? text : text + ", is black"};
}

EffectDecision occlusion(const Scene& scene) {
  if (!environment_light(scene).on) return {Effect::occlusion, false, "no light from an environment to occlude"};
  const auto occludes = [](const Material& m) {
    return m.occlusion_map && !m.unlit &&
           std::ranges::any_of(m.occlusion_map->image.decoded().texels, [](float share) { return share < 1.0F; });
  };
  return decide(Effect::occlusion, scene, occludes, "an occlusion map, which dims the environment's light",
                "no occlusion map");
}

EffectDecision cast_shadow(const Scene& scene) {
  const auto off = [](std::string_view reason) {
    return EffectDecision{Effect::cast_shadow, false, std::string(reason)};
  };
  const bool surrounded = environment_light(scene).on;
  if (scene.lights.empty() && !surrounded) return off("no light that could cast one");
  if (scene.shadows.cast) {
    return *scene.shadows.cast ? EffectDecision{Effect::cast_shadow, true, "switched on by the scene"}
                               : off("switched off by the scene");
  }
  const Occluders occluders(scene);
  const std::vector<bool> casting = lights_casting_shadows(scene, occluders);
  const auto n = std::ranges::count(casting, true);
  std::vector<std::string> blocked;
  if (n > 0) blocked.push_back(fmt::format("{} of {} light{}", n, casting.size(), casting.size() == 1 ? "" : "s"));
  if (surrounded && hides_surroundings(scene, occluders)) blocked.emplace_back("the environment");
  if (blocked.empty()) return off("nothing is between a surface and a light");
  return {Effect::cast_shadow, true, fmt::format("{}: something is before a surface", fmt::join(blocked, " and "))};
}

}  // namespace

std::string_view effect_name(Effect effect) { return effect_words.at(static_cast<std::size_t>(effect)).name; }

std::vector<EffectDecision> derive_effects(const Scene& scene) {
  std::vector<EffectDecision> decisions{normals(Effect::normal_variation, scene, &Material::normal_map, "normal map"),
                                        normals(Effect::normal_layers, scene, &Material::layer_map, "detail layer"),
                                        vertex_color(scene),
                                        lights<PointLight>(Effect::point_light, scene, "point"),
                                        lights<SpotLight>(Effect::spot_light, scene, "spot"),
                                        lights<DirectionalLight>(Effect::directional_light, scene, "directional"),
                                        lights<AreaLight>(Effect::area_light, scene, "area"),
                                        cast_shadow(scene),
                                        environment_light(scene),
                                        occlusion(scene)};
  for (const MaterialEffect& each : material_effects)
    decisions.push_back(decide(each.effect, scene, each.fits, each.on, each.off));
  std::ranges::sort(decisions, {}, &EffectDecision::effect);
  return decisions;
}

EffectSet effects_on(const std::vector<EffectDecision>& decisions) {
  EffectSet set;
  for (const EffectDecision& decision : decisions) set.set(static_cast<std::size_t>(decision.effect), decision.on);
  return set;
}

std::vector<std::string> effect_names(const EffectSet& set) {
  std::vector<std::string> out;
  for (const Effect effect : all_effects()) {
    if (has(set, effect)) out.emplace_back(effect_name(effect));
  }
  return out;
}

}  // namespace footprint
