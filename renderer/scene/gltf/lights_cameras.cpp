// Takes position and direction out of a node's transform, and refuses strengths, ranges and angles out of bounds.
#include "renderer/scene/gltf/lights_cameras.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "renderer/scene/gltf/refusal.hpp"

namespace footprint {
namespace {

constexpr double largest = 1e15;
constexpr double smallest_znear = 1e-18;  // over `largest` it still is a 32-bit float's normal number

void require(bool condition, const std::string& place, const std::string& message) {
  if (!condition) refuse_gltf(place, message);
}

/// Where a light or camera looks: its own -z.
glm::dvec3 view_direction(const glm::dmat4& world, const std::string& place) {
  const glm::dvec3 axis{world[2]};
  const double length = glm::length(axis);
  require(std::isfinite(length) && length > 0.0, place, "its node's transform leaves it no direction");
  return -axis / length;
}

glm::vec3 position_of(const glm::dmat4& world, const std::string& place) {
  const glm::dvec3 position{world[3]};
  require(glm::length(position) <= largest, place, fmt::format("lies beyond {:g} m in the world", largest));
  return glm::vec3{position};
}

/// The rigid part of a transform, right-handed: its -z axis is kept, y leans as little as need be.
glm::mat4 rigid_part(const glm::dmat4& world, const std::string& place) {
  const glm::dvec3 back = -view_direction(world, place);
  const glm::dvec3 right = glm::cross(glm::dvec3{world[1]}, back);
  const double length = glm::length(right);
  require(std::isfinite(length) && length > 0.0, place, "its node's transform leaves it no upright");
  const glm::dvec3 x = right / length;
  return glm::mat4{glm::dmat4{glm::dvec4{x, 0.0}, glm::dvec4{glm::cross(back, x), 0.0}, glm::dvec4{back, 0.0},
                              glm::dvec4{glm::dvec3{position_of(world, place)}, 1.0}}};
}

Camera convert_perspective(const tinygltf::PerspectiveCamera& source, const std::string& place) {
  require(source.yfov > 0.0 && source.yfov < std::numbers::pi, place, "yfov must lie between 0 and pi");
  require(source.znear >= smallest_znear && source.znear < largest, place,
          fmt::format("znear must be at least {:g} m", smallest_znear));
  require(source.zfar == 0.0 || (source.zfar > source.znear && source.zfar < largest), place,
          "zfar must be beyond znear");
  require(source.aspectRatio == 0.0 || (source.aspectRatio > 1e-4 && source.aspectRatio < 1e4), place,
          "aspectRatio must be within 1e-4 to 1e4");
  Camera camera;
  camera.yfov = static_cast<float>(source.yfov);
  camera.znear = static_cast<float>(source.znear);
  if (source.zfar != 0.0) camera.zfar = static_cast<float>(source.zfar);  // tinygltf's word for "not given"
  if (source.aspectRatio != 0.0) camera.aspect = static_cast<float>(source.aspectRatio);
  return camera;
}

Camera convert_orthographic(const tinygltf::OrthographicCamera& source, const std::string& place) {
  require(std::abs(source.xmag) > 0.0 && std::abs(source.xmag) < largest && std::abs(source.ymag) > 0.0 &&
              std::abs(source.ymag) < largest,
          place, "xmag and ymag must not be 0");
  require(source.znear >= 0.0 && source.zfar > source.znear && source.zfar < largest, place,
          "zfar must be beyond znear");
  Camera camera;
  camera.orthographic = true;
  camera.ymag = static_cast<float>(std::abs(source.ymag));
  camera.znear = static_cast<float>(source.znear);
  camera.zfar = static_cast<float>(source.zfar);
  camera.aspect = static_cast<float>(std::abs(source.xmag / source.ymag));
  return camera;
}

}  // namespace

Camera convert_camera(const tinygltf::Model& model, int index, const glm::dmat4& world) {
  const auto& source = model.cameras[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("cameras[{}]", index);
  Camera camera = source.type == "perspective" ? convert_perspective(source.perspective, place)
                                               : convert_orthographic(source.orthographic, place);
  camera.world = rigid_part(world, place);
  return camera;
}

Light convert_light(const tinygltf::Model& model, int index, const glm::dmat4& world) {
  const auto& source = model.lights[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("KHR_lights_punctual.lights[{}]", index);
  require(source.intensity >= 0.0 && source.intensity < largest, place, "intensity must not be negative");
  require(source.range >= 0.0 && source.range < largest, place, "range must not be negative");
  glm::dvec3 color{1.0};
  for (std::size_t c = 0; c < source.color.size() && c < 3; ++c) {
    require(source.color[c] >= 0.0 && source.color[c] < 1e6, place, "color must not be negative");
    color[static_cast<int>(c)] = source.color[c];
  }
  const glm::vec3 power{color * source.intensity};
  if (source.type == "directional") return DirectionalLight{glm::vec3{view_direction(world, place)}, power};

  PointLight point{position_of(world, place), power, std::nullopt};
  if (source.range > 0.0) point.range = static_cast<float>(source.range);
  if (source.type == "point") return point;
  require(source.type == "spot", place, "is none of point, spot, directional");
  const double inner = source.spot.innerConeAngle, outer = source.spot.outerConeAngle;
  require(inner >= 0.0 && inner < outer && outer <= std::numbers::pi / 2 + 1e-6, place,
          "needs 0 <= innerConeAngle < outerConeAngle <= pi / 2");
  return SpotLight{point, glm::vec3{view_direction(world, place)}, static_cast<float>(inner),
                   static_cast<float>(outer)};
}

}  // namespace footprint
