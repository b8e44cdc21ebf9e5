// Visibility in a tiled patch by rays that Embree traces through explicit copies of it: brute force, for tests.
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

  /// Whether nothing lies in front of a position towards a unit direction.
  [[nodiscard]] bool sees(const glm::vec3& position, const glm::dvec3& direction) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace footprint::testing
