// Framing brings all eight corners of the bounds into view; a zoom moves the camera along its own axis.
#include "renderer/scene/camera.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {

glm::mat4 look_at(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up) {
  const glm::dvec3 back = glm::normalize(position - target);
  glm::dvec3 right = glm::cross(up, back);
  if (glm::length(right) < 1e-6 * glm::length(up)) {
    right = glm::cross(std::abs(back.z) < 0.9 ? glm::dvec3{0.0, 0.0, 1.0} : glm::dvec3{0.0, 1.0, 0.0}, back);
  }
  right = glm::normalize(right);
  return glm::mat4{glm::dmat4{glm::dvec4{right, 0.0}, glm::dvec4{glm::cross(back, right), 0.0}, glm::dvec4{back, 0.0},
                              glm::dvec4{position, 1.0}}};
}

Camera frame_bounds(const Bounds& bounds, const Framing& framing) {
  const glm::dvec3 centre{bounds.centre()};
  const double radius = bounds.radius() > 0.0F ? static_cast<double>(bounds.radius()) : 0.5;
  const glm::dvec3 direction = glm::normalize(framing.direction);
  const glm::dmat3 axes{glm::dmat4{look_at(direction, glm::dvec3{0.0}, {0.0, 1.0, 0.0})}};
  const double tan_y = std::tan(framing.yfov / 2.0), tan_x = tan_y * framing.aspect;
  const glm::dvec3 half{(bounds.upper - bounds.lower) * 0.5F};
  double distance = bounds.radius() > 0.0F ? 0.0 : radius / std::min(tan_x, tan_y);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 signs{(corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                           (corner & 4) != 0 ? 1.0 : -1.0};
    const glm::dvec3 seen = glm::transpose(axes) * (half * signs);
    distance = std::max({distance, seen.z + std::abs(seen.x) / tan_x, seen.z + std::abs(seen.y) / tan_y});
  }
  distance *= framing.margin;
  Camera camera;
  camera.world = look_at(centre + direction * distance, centre, {0.0, 1.0, 0.0});
  camera.yfov = static_cast<float>(framing.yfov);
  // The bounds stay between the planes; a hundredth of the distance keeps the depth buffer's resolution.
  camera.znear = static_cast<float>(std::max(distance - 1.5 * radius, 0.01 * distance));
  camera.zfar = static_cast<float>(distance + 2.0 * radius);
  return camera;
}

Camera camera_at_distance(const Scene& scene, double factor) {
  if (!(factor > 0.0) || !std::isfinite(factor)) {
    throw Error(ErrorKind::usage, "distance", "must be a number above 0", "give a factor such as 2");
  }
  Camera camera = scene.camera;
  if (camera.orthographic) {
    camera.ymag = static_cast<float>(camera.ymag * factor);
    return camera;
  }
  const glm::dvec3 forward = -glm::dvec3{camera.world[2]};
  const glm::dvec3 eye{camera.world[3]};
  double depth = glm::dot(glm::dvec3{scene.bounds.centre()} - eye, forward);
  // A camera within the scene, or looking away from it: the bounds' own size stands for the distance.
  if (depth <= 0.0) depth = std::max(static_cast<double>(scene.bounds.radius()), 1e-6);
  const double shift = (factor - 1.0) * depth;
  camera.world[3] = glm::vec4{glm::vec3{eye - forward * shift}, 1.0F};
  // The planes keep their position in the world; moving closer, they come no nearer than in proportion.
  const double least = std::min(factor, 1.0);
  const auto follow = [&](float plane) { return static_cast<float>(std::max(plane + shift, plane * least)); };
  camera.znear = follow(camera.znear);
  if (camera.zfar) camera.zfar = follow(*camera.zfar);
  return camera;
}

}  // namespace footprint
