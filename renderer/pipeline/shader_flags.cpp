// A table of flags with their conditions, so that no text can test a flag that is never set.
#include "renderer/pipeline/shader_flags.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

using Variant = ShaderVariant;

template <auto part, auto value>
bool brdf_has(const Variant& v) {
  return v.brdf.*part == value;
}

template <Sampling sampling>
bool is_sampling(const Variant& v) {
  return v.sampling == sampling;
}

template <FootprintFilterKind kind>
bool is_filter(const Variant& v) {
  return v.sampling == Sampling::frame && v.footprint.kind == kind;
}

bool draws_texels(const Variant& v) { return v.sampling == Sampling::frame && is_stochastic(v.footprint); }

// Whether parts of the footprint are filtered and shaded separately.
bool shades_parts(const Variant& v) { return is_filter<FootprintFilterKind::shaded>(v) || draws_texels(v); }

// Whether a fetch averages lookups whose number the compiler does not know.
bool averages_probes(const Variant& v) {
  return v.sampling == Sampling::frame && v.footprint.kind != FootprintFilterKind::trilinear && !shades_parts(v);
}

bool samples_environment(const Variant& v) {
  return has(v.effects, Effect::environment_light) && v.environment != EnvironmentUse::prefiltered;
}

bool samples_areas(const Variant& v) { return has(v.effects, Effect::area_light) && v.area_sampled; }

bool integrates_areas_by_lobes(const Variant& v) { return has(v.effects, Effect::area_light) && v.area_lobes; }

// A tabulated BRDF has a diffuse term of its own.
bool reflects_diffusely(const Variant& v) {
  return has(v.effects, Effect::diffuse) || has(v.effects, Effect::tabulated_brdf);
}

// Whether anything is drawn at random: a texel of the maps, directions to an environment, facets of a patch.
bool draws(const Variant& v) {
  const bool directions = samples_environment(v) && v.environment == EnvironmentUse::sampled;
  const bool facets = has(v.effects, Effect::microgeometry_visibility) && v.sampling != Sampling::frame;
  return v.sampling == Sampling::after_shading || directions || facets || draws_texels(v) || samples_areas(v);
}

struct FlagRow {
  std::string_view name;
  bool (*is_on)(const Variant&);
};

// Beside the effects, whose flags have their names.
constexpr auto rows = std::to_array<FlagRow>({
    {"distribution_blinn_phong", brdf_has<&BaseBrdf::distribution, NormalDistribution::blinn_phong>},
    {"distribution_beckmann", brdf_has<&BaseBrdf::distribution, NormalDistribution::beckmann>},
    {"distribution_ggx", brdf_has<&BaseBrdf::distribution, NormalDistribution::ggx>},
    {"distribution_vmf", brdf_has<&BaseBrdf::distribution, NormalDistribution::vmf>},
    {"geometry_none", brdf_has<&BaseBrdf::geometry, GeometryTerm::none>},
    {"geometry_tan", brdf_has<&BaseBrdf::geometry, GeometryTerm::tan>},
    {"geometry_ward", brdf_has<&BaseBrdf::geometry, GeometryTerm::ward>},
    {"geometry_smith", brdf_has<&BaseBrdf::geometry, GeometryTerm::smith>},
    {"fresnel_schlick", brdf_has<&BaseBrdf::fresnel, FresnelTerm::schlick>},
    {"sampling_frame", is_sampling<Sampling::frame>},
    {"sampling_texel", is_sampling<Sampling::after_shading>},
    {"sampling_point", [](const Variant& v) { return v.sampling == Sampling::nearest || v.sampling == Sampling::bilinear; }},
    {"random_draws", draws},
    {"filter_anisotropic", is_filter<FootprintFilterKind::anisotropic>},
    {"filter_box", is_filter<FootprintFilterKind::box>},
    {"filter_area", is_filter<FootprintFilterKind::area>},
    {"filter_ewa", is_filter<FootprintFilterKind::ewa>},
    {"filter_hardware", is_filter<FootprintFilterKind::hardware>},
    {"filter_shaded", is_filter<FootprintFilterKind::shaded>},
    {"filter_parts", shades_parts},
    {"filter_stochastic", draws_texels},
    {"filter_stochastic_gaussian", is_filter<FootprintFilterKind::stochastic_gaussian>},
    {"filter_stochastic_trilinear", is_filter<FootprintFilterKind::stochastic_trilinear>},
    {"several_probes", averages_probes},
    {"counting", [](const Variant& v) { return v.counting != Counting::none; }},
    {"counting_trips", [](const Variant& v) { return v.counting == Counting::trips; }},
    {"fixed_trips", [](const Variant& v) { return v.fixed_trips.has_value(); }},
    {"orthographic", [](const Variant& v) { return v.orthographic; }},
    {"horizon_open", [](const Variant& v) { return v.horizon_open; }},
    {"shared_coordinates", [](const Variant& v) { return v.shared_coordinates; }},
    {"surface_coordinates", [](const Variant& v) { return v.surface_coordinates; }},
    {"screen_derivatives", [](const Variant& v) { return v.screen_derivatives; }},
    {"emitting", [](const Variant& v) { return v.emitting; }},
    {"finest_maps", [](const Variant& v) { return v.finest_maps; }},
    {"area_points", [](const Variant& v) { return has(v.effects, Effect::area_light) && v.lights[light_type::area_point] > 0; }},
    {"area_lobes", integrates_areas_by_lobes},
    {"area_sampled", samples_areas},
    {"directions_drawn", [](const Variant& v) { return samples_environment(v) || samples_areas(v); }},
    {"lobes_listed",
     [](const Variant& v) {
       return integrates_areas_by_lobes(v) || (has(v.effects, Effect::environment_light) && !samples_environment(v));
     }},
    {"environment_sampled", samples_environment},
    {"environment_dense", [](const Variant& v) { return v.environment == EnvironmentUse::dense; }},
    {"environment_summed",
     [](const Variant& v) {
       return v.sums_environment && has(v.effects, Effect::environment_light) && !samples_environment(v);
     }},
    {"environment_suns",
     [](const Variant& v) {
       return v.environment_suns > 0 && has(v.effects, Effect::environment_light) &&
              v.environment == EnvironmentUse::prefiltered;
     }},
    {"environment_diffuse", reflects_diffusely},
    {"environment_visibility",
     [](const Variant& v) { return has(v.effects, Effect::environment_light) && has(v.effects, Effect::cast_shadow); }},
});

bool has_mean_normals(const PrefilteredTexture& t) { return t.name == "mean_normal" || t.name == "mean_layer"; }

struct TextureFlagRow {
  std::string_view name;
  bool (*is_on)(const PrefilteredTexture&);
};

// On if one of the method's textures is such a texture: shared texts read textures by what these store.
constexpr auto texture_rows = std::to_array<TextureFlagRow>({
    {"texture_arrays", [](const PrefilteredTexture& t) { return t.layers > 0; }},
    {"texel_lookups", [](const PrefilteredTexture& t) { return t.filter == TextureFilter::nearest; }},
    {"half_normals", [](const PrefilteredTexture& t) { return has_mean_normals(t) && t.storage == Storage::fp16; }},
    {"coarse_normals", [](const PrefilteredTexture& t) { return has_mean_normals(t) && is_coarse(t.storage); }},
    {"two_channel_normals", [](const PrefilteredTexture& t) { return has_mean_normals(t) && t.channels == 2; }},
    {"lobe_concentration", [](const PrefilteredTexture& t) { return t.name == "lobe_concentration"; }},
});

}  // namespace

ShaderFlags shader_flags(const ShaderVariant& variant, const Options& options, const Prefiltered& prefiltered) {
  ShaderFlags flags;
  for (const std::string& name : effect_names(EffectSet{}.set())) flags.emplace(name, false);
  for (const std::string& name : effect_names(variant.effects)) flags[name] = true;
  for (const FlagRow& row : rows) flags.emplace(row.name, row.is_on(variant));
  for (const TextureFlagRow& row : texture_rows)
    flags.emplace(row.name, std::ranges::any_of(prefiltered.textures, row.is_on));
  for (const OptionSpec& option : options.specs()) {
    for (const std::string& choice : option.choices) {
      const std::string flag = option.shader_name() + "_" + choice;
      if (flags.contains(flag)) {
        throw Error(ErrorKind::usage, "option " + option.name,
                    "its choice `" + choice + "` has the flag `" + flag + "`, which shaders have already",
                    "name the option otherwise");
      }
      flags[flag] = options.word(option.name) == choice;
    }
  }
  return flags;
}

}  // namespace footprint
