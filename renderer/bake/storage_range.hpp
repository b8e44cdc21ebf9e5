// Lobes that a method's storage is too coarse for: what a table of a run says where a scene has them.
#pragma once

#include <optional>
#include <string>

#include "renderer/bake/method.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A note for a material over whose normal map a lobe is narrower than the option `storage` resolves
/// (docs/stability.md); none where the method has no such option or rounds no lobes by it, normals do not vary, or all
/// lobes are wide enough.
[[nodiscard]] std::optional<std::string> storage_range_note(const Material& material, const MethodInfo& info,
                                                            const Options& options, const EffectSet& effects);

}  // namespace footprint
