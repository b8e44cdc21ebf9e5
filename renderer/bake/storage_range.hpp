// Lobes that a method's storage is too coarse for: what a table of a run says where a scene has them.
#pragma once

#include <optional>
#include <string>

#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A note for a material over whose normal map a lobe is narrower than the option `storage` holds (docs/stability.md);
/// none where the method has no such option, normals do not vary, or all lobes are wide enough.
[[nodiscard]] std::optional<std::string> storage_range_note(const Material& material, const Options& options,
                                                            const EffectSet& effects);

}  // namespace footprint
