// The table of reflected lobes for area lights on the GPU.
#pragma once

#include "renderer/environment/transformed_cosines.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The texture `area_cosines` of area_lobes.glsl: the layers of a CosineTable for lobes of the base BRDF and, if that
/// is GGX, those for lobes of Beckmann's distribution, because methods may have lobes without a tail. The context that
/// created it must be current, also at destruction.
class GpuAreaCosines {
 public:
  /// Fits the table, which takes about a second of one core. Throws Error (machine): out of memory.
  explicit GpuAreaCosines(const BaseBrdf& brdf);

  /// Binds the table to a texture unit.
  void bind(GLuint unit) const;

  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::size_t bytes_ = 0;
  gl::Texture table_;
  gl::Sampler sampler_;
};

/// The kind of lobe with the geometry factor of a base BRDF.
[[nodiscard]] ReflectedLobeKind reflected_lobe_kind(const BaseBrdf& brdf, NormalDistribution distribution);

}  // namespace footprint
