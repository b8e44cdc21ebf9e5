// One part of a scene: its content with the BRDF and the maps that the settings lay over it, where it stands.
#pragma once

#include "renderer/scene/model.hpp"
#include "renderer/scene/settings/part.hpp"

namespace footprint {

/// Loads what `settings` names. May hold no triangle. Errors (usage): no candidate file exists, whatever loading it
/// refuses, lobes of another distribution than the surface's own.
[[nodiscard]] Model load_part(const PartSettings& settings);

}  // namespace footprint
