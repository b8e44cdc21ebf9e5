// Test support for `iwasaki_sg`: materials with a patch of microgeometry.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "renderer/bake/method.hpp"
#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& iwasaki_sg_method();
}  // namespace footprint

namespace footprint::testing {

inline std::shared_ptr<const Microgeometry> microgeometry_of(Patch patch) {
  const glm::vec3 mean = patch_maps(patch, 64).mean_color;
  return std::make_shared<const Microgeometry>(Microgeometry{std::move(patch), mean});
}

inline Patch patch_of(const std::string& kind, const std::map<std::string, std::string>& given = {}) {
  return make_patch(find_patch_kind(kind), given);
}

inline Material patch_material(const Patch& patch, const BaseBrdf& brdf, float lobe) {
  Material material = square_scene({}, {.brdf = brdf}).materials[0];
  material.lobe_parameter = lobe;
  material.microgeometry = microgeometry_of(patch);
  return material;
}

}  // namespace footprint::testing
