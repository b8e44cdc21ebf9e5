// What the options and a material ask of a table.
#pragma once

#include <vector>

#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::iwasaki_sg {

/// The options of the method.
[[nodiscard]] std::vector<OptionSpec> option_table();

/// Whether the facets have a BRDF of their own, in a table.
[[nodiscard]] bool is_tabulated(const Material& material);

/// The effects of small-scale geometry that a material calls for by itself.
[[nodiscard]] EffectSet patch_effects(const Material& material);

[[nodiscard]] TableSettings table_settings(const Material& material, const Options& options, const EffectSet& effects);

}  // namespace footprint::iwasaki_sg
