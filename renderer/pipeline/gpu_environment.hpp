// An environment on the GPU: prefiltered maps for the methods, tables to draw directions or lights for the reference.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/environment/radiance_stack.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/environment_use.hpp"
#include "renderer/scene/small_sun.hpp"

namespace footprint {

class TextureUnits;

/// The textures and the block that environment_stack.glsl or environment_sampling.glsl read. Each use's are made where
/// a program first asks for it: the reference needs no stack, a method no tables. Needs the context that made it to be
/// current, also when destroyed.
class GpuEnvironment {
 public:
  explicit GpuEnvironment(Environment environment)
      : environment_(std::move(environment)), apart_(suns_apart(environment_)) {}

  /// Makes what a program needs, if it is not there yet. Errors (machine): over the GL limits, out of memory.
  void prepare(EnvironmentUse use);

  /// Binds it: its textures at their `units`, and the block.
  void bind(const TextureUnits& units, EnvironmentUse use) const;

  /// How many suns of it methods light by as by directional lights (environment_stack.glsl).
  [[nodiscard]] std::size_t sun_count() const { return apart_.suns.size(); }
  /// What methods look up: all of it, but for those.
  [[nodiscard]] const Environment& looked_up() const { return apart_.rest; }

  /// Bytes of the prefiltered maps, 0 before they are made. The reference's tables are no part of any method's cost.
  [[nodiscard]] std::size_t stack_bytes() const { return parts_[0] ? parts_[0]->bytes : 0; }

 private:
  struct Part {
    std::vector<gl::Texture> textures;  // in the order of environment_textures (bindings.hpp)
    gl::Sampler sampler;
    gl::Buffer block;
    std::size_t bytes = 0;
  };
  [[nodiscard]] Part stack_part() const;
  [[nodiscard]] Part table_part() const;
  [[nodiscard]] Part light_part() const;

  Environment environment_;
  SunsApart apart_;
  std::array<std::optional<Part>, 3> parts_;  // in the order of EnvironmentUse
};

}  // namespace footprint
