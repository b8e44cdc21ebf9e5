// An environment on the GPU: prefiltered maps for the methods, tables or lights for the reference, and its large-scale
// visibility as signed distances at vertices.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/environment/radiance_stack.hpp"
#include "renderer/environment/transformed_cosines.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/shader_flags.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/visibility/visibility_field.hpp"

namespace footprint {

/// A texture with a sampler of its own. The context that created it must be current, also at destruction.
struct SampledTexture {
  gl::Texture texture;
  gl::Sampler sampler;
  std::size_t bytes = 0;

  void bind(GLuint unit) const { gl::bind_texture(unit, texture, sampler.name()); }
};

/// The texture `area_cosines` of area_lobes.glsl: make_cosine_table for lobes of the base BRDF and, if that
/// is GGX, those for lobes of Beckmann's distribution, because methods may have lobes without a tail. Fits the table,
/// which takes about a second of one core. Throws Error (machine): out of memory.
[[nodiscard]] SampledTexture area_cosines_of(const BaseBrdf& brdf);

class TextureUnits;

/// The textures and the block of environment_stack.glsl or environment_sampling.glsl. Those of each use are created
/// when a program first needs them: the reference needs no stack, a method no tables. The context that created it must
/// be current, also at destruction.
class GpuEnvironment {
 public:
  explicit GpuEnvironment(Environment environment)
      : environment_(std::move(environment)), apart_(suns_apart(environment_)) {}

  /// Creates the textures of a use, unless they exist. Throws Error (machine): over the GL limits, out of memory.
  void prepare(EnvironmentUse use);

  /// Binds the textures of a use at their `units`, and the block.
  void bind(const TextureUnits& units, EnvironmentUse use) const;

  /// The number of suns that methods treat as directional lights (environment_stack.glsl).
  [[nodiscard]] std::size_t sun_count() const { return apart_.suns.size(); }
  /// The environment that methods look up: all of it except these suns.
  [[nodiscard]] const Environment& looked_up() const { return apart_.rest; }

  /// Bytes of the prefiltered maps; 0 before they exist. The reference's tables are not part of a method's cost.
  [[nodiscard]] std::size_t stack_bytes() const;

 private:
  struct Part {
    std::vector<SampledTexture> textures;  // in the order of environment_textures (shader_source.hpp)
    gl::Buffer block;
  };
  [[nodiscard]] Part stack_part() const;
  [[nodiscard]] Part table_part() const;
  [[nodiscard]] Part light_part() const;

  Environment environment_;
  SunsApart apart_;
  std::array<std::optional<Part>, 3> parts_;  // in the order of EnvironmentUse
};

/// Whether a scene's effects need visibility of the environment: it has one, and something casts shadows.
[[nodiscard]] bool hides_environment(const EffectSet& effects);

/// The scene with mesh edges no longer than 1/24 of the bounds' radius, if its effects need visibility at vertices;
/// otherwise unchanged. Everything that reads vertices must use the result.
/// shapes: the meshes of another pose, whose edges are measured instead (subdivided); empty: its own.
[[nodiscard]] Scene refined_for_visibility(Scene scene, const EffectSet& effects, std::span<const Mesh> shapes = {});

/// The maps of a visibility field's components, and the vertices' weights. The context that created it must be current,
/// also at destruction.
class GpuVisibility {
 public:
  /// Reads the field from `cache`, or computes and stores it there.
  /// environment: the light of diffuse shares.
  /// Throws as visibility_field; Error (machine): over the GL limits.
  GpuVisibility(const Scene& scene, const Environment& environment, const Progress& progress, const DiskCache* cache);

  /// The attributes of a material's vertices in the order of the scene's meshes. Five vectors per vertex: the weights
  /// (1 for the mean, then the components) and the diffuse share.
  [[nodiscard]] std::vector<glm::vec4> attributes(const Scene& scene, std::size_t material) const;

  /// Binds the maps to a texture unit.
  void bind(GLuint unit) const { maps_.bind(unit); }

  /// Bytes of the maps and of the vertices' values.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }
  /// Root mean square error of the distances that the components reproduce, radians.
  [[nodiscard]] double error() const { return field_.error; }
  /// A note that memory was short, so that fewer vertices were computed; empty otherwise.
  [[nodiscard]] std::string shortage() const;

 private:
  VisibilityField field_;
  std::size_t vertex_count_ = 0, bytes_ = 0;
  SampledTexture maps_;
};

}  // namespace footprint
