// The directives of shader text, and the order in which texts make a stage.
#include "renderer/pipeline/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/bindings.hpp"
#include "renderer/pipeline/shadow_maps.hpp"

namespace footprint {

namespace embedded {
extern const std::string_view beckmann_lambda_glsl;
extern const std::string_view common_base_brdf_glsl;
extern const std::string_view common_footprint_glsl;
extern const std::string_view common_lobes_glsl;
extern const std::string_view common_slopes_glsl;
extern const std::string_view direction_grid_glsl;
extern const std::string_view environment_dense_glsl;
extern const std::string_view environment_drawn_glsl;
extern const std::string_view environment_sampling_glsl;
extern const std::string_view environment_stack_glsl;
extern const std::string_view environment_visibility_glsl;
extern const std::string_view facet_lobes_glsl;
extern const std::string_view facet_normal_lobes_glsl;
extern const std::string_view facets_module_glsl;
extern const std::string_view lobe_sampling_glsl;
extern const std::string_view mean_normal_glsl;
extern const std::string_view ndf_fragment_glsl;
extern const std::string_view octahedral_glsl;
extern const std::string_view patch_facets_glsl;
extern const std::string_view normal_cdf_glsl;
extern const std::string_view normal_layers_glsl;
extern const std::string_view normal_lobes_glsl;
extern const std::string_view resolve_samples_glsl;
extern const std::string_view screen_vertex_glsl;
extern const std::string_view shadow_fragment_glsl;
extern const std::string_view shadow_vertex_glsl;
extern const std::string_view surface_fragment_glsl;
extern const std::string_view surface_lights_glsl;
extern const std::string_view surface_material_glsl;
extern const std::string_view surface_shadows_glsl;
extern const std::string_view surface_vertex_glsl;
extern const std::string_view tangent_frame_glsl;
extern const std::string_view vmf_density_glsl;
}  // namespace embedded

namespace {

constexpr std::string_view directive_mark = "//? ";
constexpr std::string_view version_line = "#version 450 core\n";

// The texts that are taken in by `include`: what some programs share and others do not pay for.
std::optional<std::string_view> optional_text(std::string_view file) {
  if (file == "common_slopes.glsl") return embedded::common_slopes_glsl;
  if (file == "beckmann_lambda.glsl") return embedded::beckmann_lambda_glsl;
  if (file == "direction_grid.glsl") return embedded::direction_grid_glsl;
  if (file == "patch_facets.glsl") return embedded::patch_facets_glsl;
  if (file == "facet_lobes.glsl") return embedded::facet_lobes_glsl;
  if (file == "facets_module.glsl") return embedded::facets_module_glsl;
  if (file == "mean_normal.glsl") return embedded::mean_normal_glsl;
  if (file == "normal_layers.glsl") return embedded::normal_layers_glsl;
  if (file == "vmf_density.glsl") return embedded::vmf_density_glsl;
  if (file == "tangent_frame.glsl") return embedded::tangent_frame_glsl;
  if (file == "normal_cdf.glsl") return embedded::normal_cdf_glsl;
  if (file == "lobe_sampling.glsl") return embedded::lobe_sampling_glsl;
  if (file == "facet_normal_lobes.glsl") return embedded::facet_normal_lobes_glsl;
  if (file == "environment_stack.glsl") return embedded::environment_stack_glsl;
  if (file == "environment_visibility.glsl") return embedded::environment_visibility_glsl;
  if (file == "octahedral.glsl") return embedded::octahedral_glsl;
  if (file == "environment_dense.glsl") return embedded::environment_dense_glsl;
  if (file == "environment_drawn.glsl") return embedded::environment_drawn_glsl;
  if (file == "environment_sampling.glsl") return embedded::environment_sampling_glsl;
  return std::nullopt;
}

// An open `if`: whether its parent keeps text, and whether its own condition holds.
struct Branch {
  bool outer;
  bool holds;
};

class Selector {
 public:
  Selector(const ShaderFlags& flags, std::string_view file, bool numbered)
      : flags_(flags), file_(file), numbered_(numbered) {
    mark_line();
  }

  void line(std::string_view text) {
    ++number_;
    if (text.starts_with(directive_mark)) {
      directive(text.substr(directive_mark.size()));
      mark_line();
    } else if (keeping_) {
      out_ += text;
      out_ += '\n';
    }
  }

  std::string finish() {
    if (!branches_.empty()) throw bad("an `if` is not closed");
    return std::move(out_);
  }

 private:
  void mark_line() {
    if (numbered_) out_ += fmt::format("#line {}\n", number_ + 1);
  }

  void directive(std::string_view words) {
    if (words.starts_with("if ")) {
      open(words.substr(3));
    } else if (words.starts_with("include ")) {
      include(words.substr(8));
    } else if (words == "else" && !branches_.empty()) {
      keeping_ = branches_.back().outer && !branches_.back().holds;
    } else if (words == "end" && !branches_.empty()) {
      keeping_ = branches_.back().outer;
      branches_.pop_back();
    } else {
      throw bad(fmt::format("`{}` is no directive here", words));
    }
  }

  void open(std::string_view condition) {
    const bool negated = condition.starts_with("not ");
    if (negated) condition.remove_prefix(4);
    branches_.push_back({keeping_, flags_.contains(condition) != negated});
    keeping_ = keeping_ && branches_.back().holds;
  }

  // Included lines are numbered as shared ones: those of the module keep the numbers of its own file.
  void include(std::string_view file) {
    const std::optional<std::string_view> text = optional_text(file);
    if (!text) throw bad(fmt::format("there is no shared text `{}`", file));
    if (!keeping_) return;
    if (numbered_) out_ += fmt::format("#line {}\n", first_shared_line);
    out_ += select_text(*text, flags_, file);
  }

  [[nodiscard]] Error bad(const std::string& message) const {
    return {ErrorKind::usage, fmt::format("{}, line {}", file_, number_), message,
            "directives: if FLAG, if not FLAG, else, end, include FILE"};
  }

  const ShaderFlags& flags_;
  std::string_view file_;
  bool numbered_;
  std::string out_;
  std::vector<Branch> branches_;
  bool keeping_ = true;
  int number_ = 0;
};

std::string_view distribution_flag(NormalDistribution distribution) {
  switch (distribution) {
    case NormalDistribution::blinn_phong:
      return "distribution_blinn_phong";
    case NormalDistribution::beckmann:
      return "distribution_beckmann";
    case NormalDistribution::ggx:
      return "distribution_ggx";
    case NormalDistribution::vmf:
      return "distribution_vmf";
  }
  return {};
}

std::string_view geometry_flag(GeometryTerm geometry) {
  switch (geometry) {
    case GeometryTerm::none:
      return "geometry_none";
    case GeometryTerm::tan:
      return "geometry_tan";
    case GeometryTerm::smith:
      return "geometry_smith";
  }
  return {};
}

std::string_view sampling_flag(Sampling sampling) {
  switch (sampling) {
    case Sampling::frame:
      return "sampling_frame";
    case Sampling::texel:
      return "sampling_texel";
    case Sampling::point:
      return "sampling_point";
  }
  return {};
}

bool samples_environment(const ShaderVariant& v) {
  return has(v.effects, Effect::environment_light) && v.environment != EnvironmentUse::prefiltered;
}

std::string light_capacities(const ShaderVariant& v) {
  std::string text;
  const auto capacity = [&](Effect effect, std::string_view name, std::size_t count) {
    if (has(v.effects, effect))
      text += fmt::format("const int {}_capacity = {};\n", name, std::max<std::size_t>(count, 1));
  };
  capacity(Effect::point_light, "point_light", v.point_lights);
  capacity(Effect::spot_light, "spot_light", v.spot_lights);
  capacity(Effect::directional_light, "directional_light", v.directional_lights);
  if (calls_for_shadow_maps(v.effects)) capacity(Effect::cast_shadow, "shadow_view", v.shadow_maps);
  return text;
}

std::string number_options(const Options& options) {
  std::string text;
  for (const auto& [name, value] : options.all()) {
    if (const auto* number = std::get_if<double>(&value))
      text += fmt::format("const float option_{} = {:e};\n", name, *number);
  }
  return text;
}

std::string scalar_declarations(const Prefiltered& prefiltered) {
  if (prefiltered.scalars.empty()) return {};
  std::string text = fmt::format("layout(std140, binding = {}) uniform MethodBlock {{\n", block_binding::method);
  for (const auto& [name, value] : prefiltered.scalars) text += fmt::format("  float {};\n", name);
  return text + "};\n";
}

}  // namespace

std::string select_text(std::string_view text, const ShaderFlags& flags, std::string_view file, bool numbered) {
  Selector selector(flags, file, numbered);
  while (!text.empty()) {
    const std::size_t stop = std::min(text.find('\n'), text.size());
    selector.line(text.substr(0, stop));
    text.remove_prefix(std::min(stop + 1, text.size()));
  }
  return selector.finish();
}

ShaderFlags shader_flags(const ShaderVariant& variant, const Options& options) {
  ShaderFlags flags;
  for (const std::string& name : effect_names(variant.effects)) flags.insert(name);
  flags.emplace(distribution_flag(variant.brdf.distribution));
  flags.emplace(geometry_flag(variant.brdf.geometry));
  if (variant.brdf.fresnel == FresnelTerm::schlick) flags.emplace("fresnel_schlick");
  flags.emplace(sampling_flag(variant.sampling));
  if (samples_environment(variant)) flags.emplace("environment_sampled");
  if (variant.environment == EnvironmentUse::dense) flags.emplace("environment_dense");
  if (has(variant.effects, Effect::environment_light) && has(variant.effects, Effect::cast_shadow)) {
    flags.emplace("environment_visibility");
  }
  // A tabulated BRDF has a diffuse term of its own.
  if (has(variant.effects, Effect::diffuse) || has(variant.effects, Effect::tabulated_brdf)) {
    flags.emplace("environment_diffuse");
  }
  // What is drawn at random: a texel of the maps, directions to an environment, facets of a patch.
  const bool facets = has(variant.effects, Effect::microgeometry_visibility) && variant.sampling != Sampling::frame;
  if (variant.sampling == Sampling::texel || samples_environment(variant) || facets) flags.emplace("random_draws");
  if (variant.max_probes > 1) flags.emplace("anisotropic");
  if (variant.orthographic) flags.emplace("orthographic");
  if (variant.shared_coordinates) flags.emplace("shared_coordinates");
  if (variant.surface_coordinates) flags.emplace("surface_coordinates");
  for (const auto& [name, value] : options.all()) {
    if (const auto* word = std::get_if<std::string>(&value)) flags.insert(name + "_" + *word);
  }
  return flags;
}

ShaderFlags texture_flags(const Prefiltered& prefiltered) {
  ShaderFlags flags;
  for (const PrefilteredTexture& texture : prefiltered.textures) {
    if (texture.layers > 0) flags.emplace("texture_arrays");
    if (texture.filter == TextureFilter::nearest) flags.emplace("texel_lookups");
  }
  return flags;
}

std::string shared_functions(const ShaderFlags& flags) {
  std::string text = select_text(embedded::common_footprint_glsl, flags, "common_footprint.glsl") +
                     select_text(embedded::common_lobes_glsl, flags, "common_lobes.glsl") +
                     select_text(embedded::common_base_brdf_glsl, flags, "common_base_brdf.glsl");
  if (flags.contains("environment_light")) text += select_text(embedded::normal_lobes_glsl, flags, "normal_lobes.glsl");
  return text;
}

std::string material_block(const ShaderFlags& flags, std::size_t facet_lobes) {
  const std::string room =
      flags.contains("multi_lobe") ? fmt::format("const int most_facet_lobes = {};\n", facet_lobes) : "";
  return room + select_text(embedded::surface_material_glsl, flags, "surface_material.glsl");
}

std::string vertex_shader(const ShaderVariant& variant) {
  const ShaderFlags flags = shader_flags(variant, Options({}, {}, "vertex shader"));
  return std::string(version_line) + select_text(embedded::surface_vertex_glsl, flags, "surface_vertex.glsl");
}

namespace {

struct Module {
  std::string_view text, name;
};

// A pass around a method's module, which takes the place of the pass's line `//# module`: what the module reads (its
// textures, scalars and options, the material's block) and may call stands in front of it. `first` comes before all
// that.
std::string method_program(const ShaderVariant& variant, const Module& module, const Options& options,
                           const Prefiltered& prefiltered, const TextureUnits& units, const std::string& first,
                           const std::string& pass) {
  ShaderFlags flags = shader_flags(variant, options);
  flags.merge(texture_flags(prefiltered));
  std::string text = fmt::format("{}#line {}\n", version_line, first_shared_line) + units.declarations() + first;
  if (variant.max_probes > 1) text += fmt::format("const float max_probes = {}.0;\n", variant.max_probes);
  text += number_options(options) + scalar_declarations(prefiltered);
  text += material_block(flags, variant.facet_lobes) + shared_functions(flags);
  constexpr std::string_view split = "//# module\n";
  const std::size_t place = pass.find(split);
  text += pass.substr(0, place);
  const auto next_line = first_shared_line + std::ranges::count(text, '\n');
  return text + select_text(module.text, flags, module.name, true) + fmt::format("#line {}\n", next_line) +
         pass.substr(place + split.size());
}

}  // namespace

std::string fragment_shader(const ShaderVariant& variant, std::string_view module, std::string_view module_name,
                            const Options& options, const Prefiltered& prefiltered) {
  const ShaderFlags flags = shader_flags(variant, options);
  std::string lights =
      light_capacities(variant) + select_text(embedded::surface_lights_glsl, flags, "surface_lights.glsl");
  if (calls_for_shadow_maps(variant.effects)) lights += embedded::surface_shadows_glsl;
  const std::string forward = select_text(embedded::surface_fragment_glsl, flags, "surface_fragment.glsl");
  return method_program(variant, {module, module_name}, options, prefiltered, forward_units(variant, prefiltered),
                        lights, forward);
}

std::string ndf_shader(const ShaderVariant& variant, std::string_view module, std::string_view module_name,
                       const Options& options, const Prefiltered& prefiltered) {
  const ShaderFlags flags = shader_flags(variant, options);
  return method_program(variant, {module, module_name}, options, prefiltered,
                        TextureUnits(variant.effects, prefiltered), {},
                        select_text(embedded::ndf_fragment_glsl, flags, "ndf_fragment.glsl"));
}

std::string frame_build_shader(const ShaderVariant& variant, std::string_view pass, std::string_view pass_name,
                               const Options& options, const ShaderFlags& own) {
  ShaderFlags flags = shader_flags(variant, options);
  flags.insert(own.begin(), own.end());
  return fmt::format("{}#line {}\n", version_line, first_shared_line) + number_options(options) +
         material_block(flags, variant.facet_lobes) + shared_functions(flags) +
         select_text(pass, flags, pass_name, true);
}

std::string shadow_vertex_shader(const EffectSet& effects) {
  const ShaderFlags flags = shader_flags({.effects = effects, .brdf = {}}, Options({}, {}, "shadow maps"));
  return std::string(version_line) + select_text(embedded::shadow_vertex_glsl, flags, "shadow_vertex.glsl");
}

std::string shadow_fragment_shader(const EffectSet& effects) {
  const ShaderFlags flags = shader_flags({.effects = effects, .brdf = {}}, Options({}, {}, "shadow maps"));
  std::string text(version_line);
  if (has(effects, Effect::alpha_mask)) {
    if (has(effects, Effect::base_color_variation)) text += "layout(binding = 0) uniform sampler2D base_color_map;\n";
    text += material_block(flags);
  }
  return text + select_text(embedded::shadow_fragment_glsl, flags, "shadow_fragment.glsl");
}

std::string screen_vertex_shader() { return std::string(version_line) + std::string(embedded::screen_vertex_glsl); }

std::string resolve_shader() { return std::string(version_line) + std::string(embedded::resolve_samples_glsl); }

}  // namespace footprint
