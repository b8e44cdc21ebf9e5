// The patch that a scene.toml asks for, and what it changes in a material.
#pragma once

#include <memory>

#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/settings/part.hpp"

namespace footprint {

/// A patch and how it looks from above.
struct MicrogeometryContent {
  std::shared_ptr<const Microgeometry> microgeometry;
  std::shared_ptr<const Image> normals;
};

/// Builds or loads it. Errors (usage): of the parameters, of the file, of check_patch.
[[nodiscard]] MicrogeometryContent load_microgeometry(const MicrogeometrySettings& settings);

/// A material with that small-scale geometry: its normal map is the view from above, its base colour that of the patch
/// times its own.
void apply(const MicrogeometryContent& content, Material& material);

}  // namespace footprint
