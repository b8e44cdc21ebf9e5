// The maps of a material that no method filters in a way of its own: one row each, for programs and uploads alike.
#pragma once

#include <span>
#include <string_view>

#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A map that the shared shaders read where an effect is on.
struct SharedMap {
  Effect effect;
  std::string_view name;            ///< of its sampler
  Image (*image)(const Material&);  ///< its finest level; a constant, 1 x 1, of a material that has none
  TextureCoordinates (*coordinates)(const Material&);
};

/// In the order of their texture units.
[[nodiscard]] std::span<const SharedMap> shared_maps();

}  // namespace footprint
