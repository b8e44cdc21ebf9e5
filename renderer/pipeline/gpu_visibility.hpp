// Large-scale visibility of the environment on the GPU: signed distances at vertices.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/visibility/kept_visibility.hpp"

namespace footprint {

/// Whether a scene's effects ask for it: an environment, and something that hides a part of it.
[[nodiscard]] bool hides_environment(const EffectSet& effects);

/// The scene with the edges of its meshes no longer than a 24th of the bounds' radius, where visibility is to be kept
/// at vertices; else as it is. What looks at vertices must be made from what comes out.
[[nodiscard]] Scene refined_for_visibility(Scene scene, const EffectSet& effects);

/// The maps of the field's components, and what the vertices weigh them by. Needs the context that made it to be
/// current, also when destroyed.
class GpuVisibility {
 public:
  /// Takes the visibility of all vertices from `cache`, or asks it and keeps it there; diffuse light is that of
  /// `environment`. Errors: those of
  /// visibility_field; (machine): over GL's limits.
  GpuVisibility(const Scene& scene, const Environment& environment, const Progress& progress, const DiskCache* cache);

  /// The attributes of a material's vertices in the order of the scene's meshes: five vectors each, the weights (1 for
  /// the mean, then the components) and the diffuse share.
  [[nodiscard]] std::vector<glm::vec4> attributes(const Scene& scene, std::size_t material) const;

  /// Binds the maps to a texture unit.
  void bind(GLuint unit) const;

  /// Of the maps and the vertices' values.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }
  /// What the components leave out of the distances, root mean square, radians.
  [[nodiscard]] double error() const { return field_.error; }

 private:
  VisibilityField field_;
  std::size_t vertex_count_ = 0, bytes_ = 0;
  gl::Texture maps_;
  gl::Sampler sampler_;
};

}  // namespace footprint
