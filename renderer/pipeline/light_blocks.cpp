// Four-vectors of each kind of light, in the order of the scene.
#include "renderer/pipeline/light_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace footprint {
namespace {

void append(std::vector<glm::vec4>& block, const PointLight& light, float first_map) {
  block.emplace_back(light.position, light.range.value_or(0.0F));
  block.emplace_back(light.intensity, first_map);
}

struct Appender {
  LightBlocks& blocks;
  float first_map;

  void operator()(const PointLight& light) const { append(blocks.point, light, first_map); }

  void operator()(const SpotLight& light) const {
    append(blocks.spot, light.point, first_map);
    blocks.spot.emplace_back(light.direction, 0.0F);
    // KHR_lights_punctual, "Inner and Outer Cone Angles": the same guard against equal angles.
    const float scale = 1.0F / std::max(0.001F, std::cos(light.inner_cone_angle) - std::cos(light.outer_cone_angle));
    blocks.spot.emplace_back(scale, -std::cos(light.outer_cone_angle) * scale, 0.0F, 0.0F);
  }

  void operator()(const DirectionalLight& light) const {
    blocks.directional.emplace_back(-light.direction, 0.0F);
    blocks.directional.emplace_back(light.illuminance, first_map);
  }
};

}  // namespace

LightBlocks light_blocks(std::span<const Light> lights, std::span<const int> first_maps) {
  LightBlocks blocks;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    std::visit(Appender{blocks, first_maps.empty() ? 0.0F : static_cast<float>(first_maps[i])}, lights[i]);
  }
  return blocks;
}

}  // namespace footprint
