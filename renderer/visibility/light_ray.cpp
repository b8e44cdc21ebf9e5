// Whether light of each kind reaches a point at all, and from where.
#include "renderer/visibility/light_ray.hpp"

#include <cmath>
#include <limits>

namespace footprint {
namespace {

struct RayFrom {
  glm::vec3 point;

  [[nodiscard]] std::optional<LightRay> operator()(const PointLight& light) const {
    const glm::vec3 way = light.position - point;
    const float distance = glm::length(way);
    const bool reaches = distance > 0.0F && (!light.range || distance < *light.range);
    if (!reaches || light.intensity == glm::vec3(0.0F)) return {};
    return LightRay{way / distance, distance};
  }

  [[nodiscard]] std::optional<LightRay> operator()(const SpotLight& light) const {
    const auto ray = (*this)(light.point);
    if (!ray || -glm::dot(ray->direction, light.direction) <= std::cos(light.outer_cone_angle)) return {};
    return ray;
  }

  [[nodiscard]] std::optional<LightRay> operator()(const DirectionalLight& light) const {
    if (light.illuminance == glm::vec3(0.0F)) return {};
    return LightRay{-light.direction, std::numeric_limits<float>::infinity()};
  }
};

}  // namespace

std::optional<LightRay> ray_to_light(const Light& light, const glm::vec3& point) {
  return std::visit(RayFrom{point}, light);
}

}  // namespace footprint
