// `specular_aa`: widens the lobe about the mean normal where normals change over the screen, by an engine's formula.
// The roughness mips below it may be those that engines bake.
#include "methods/roughness_bake/roughness_bake.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/core/error.hpp"

namespace footprint {

extern const EmbeddedTexts specular_aa_glsl;

namespace {

constexpr double default_constant = 0.3;
constexpr double default_cap = 0.04;

// `none` and every preset of roughness_bake except `free`, which takes numbers.
std::vector<std::string> bakes() {
  std::vector<std::string> words{"none"};
  for (const std::string_view name : roughness_bake::preset_names)
    if (name != "free") words.emplace_back(name);
  return words;
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& /*progress*/) {
  const std::string &preset = options.word("preset"), &bake = options.word("bake");
  if (preset != "free" &&
      (options.number("constant") != default_constant || options.number("cap") != default_cap)) {  // not used
    throw Error(ErrorKind::usage, "specular_aa", "preset=" + preset + " has its own constant and cap",
                "give preset=free for others, or leave `constant` and `cap` out");
  }
  const Storage storage = parse_storage(options.word("storage"));
  if (bake != "none")
    return roughness_bake::bake_roughness(material, roughness_bake::preset_of(bake), storage, effects);
  Prefiltered out = bake_mean_normal(material, storage, effects);
  append(out.textures, bake_mean_roughness(material, storage, effects).textures);
  return out;
}

}  // namespace

const Method& specular_aa_method() {
  static const Method method{
      .info = {.name = "specular_aa",
               .summary =
                   "The mean normal under a lobe widened by how normals change over the screen, as engines do it.",
               .paper = "Tokuyoshi and Kaplanyan 2019, 2021, and engines' forms of it (README)",
               .options =
                   {word_option("preset",
                                {"filament", "unity", "o3de", "godot", "bevy", "unreal", "three", "babylon",
                                 "tokuyoshi_kaplanyan_2019", "tokuyoshi_kaplanyan_2021", "free"},
                                "Whose formula: an engine's, a paper's, or `free`."),
                    number_option("constant", default_constant, 0.0, 4.0,
                                  "Of preset=free: alpha^2 + min(constant S, cap), S the sum of the normal's squared "
                                  "derivatives."),
                    number_option("cap", default_cap, 0.0, 1.0, "Of preset=free: the most that is added to alpha^2."),
                    word_option("normal", {"own", "geometric", "shading"},
                                "Which normal's derivatives: as the preset has it (`free`: geometric), the mesh's, or "
                                "the one with the normal map's mean."),
                    word_option(
                        "bake", bakes(),
                        "What the roughness mips already contain: nothing, or what roughness_bake with this preset "
                        "bakes."),
                    block_storage_option(true)},
               .honours = map_effects_but({Effect::anisotropic_lobe}),
               .screen_derivatives = true},
      .precompute = precompute,
      .shader = module_of(specular_aa_glsl, "specular_aa.glsl")};
  return method;
}

}  // namespace footprint
