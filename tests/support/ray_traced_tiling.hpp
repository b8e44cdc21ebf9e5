// Visibility in a tiled patch by brute force: Embree traces rays through explicit copies of the patch.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "renderer/microgeometry/patch.hpp"

namespace footprint::testing {

/// A patch with `copies` further periods on each side.
class RayTracedTiling {
 public:
  RayTracedTiling(const Patch& patch, int copies);
  ~RayTracedTiling();
  RayTracedTiling(const RayTracedTiling&) = delete;
  RayTracedTiling& operator=(const RayTracedTiling&) = delete;

  /// Whether a ray from a position in a unit direction hits nothing.
  [[nodiscard]] bool sees(const glm::vec3& position, const glm::dvec3& direction) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace footprint::testing
