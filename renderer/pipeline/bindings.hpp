// Where programs find their textures and uniform blocks: given out in one place, held against what the GL has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint {

/// The bindings of uniform blocks, as the shared shaders have them.
namespace block_binding {
inline constexpr GLuint material = 0, method = 1, point_lights = 2, spot_lights = 3, directional_lights = 4,
                        environment = 5, shadow_views = 6;
}  // namespace block_binding

/// The textures of one program in the order of their units, from 0 on.
class TextureUnits {
 public:
  /// What a method's module reads: the shared maps whose effects are on, then the method's own.
  TextureUnits(const EffectSet& effects, const Prefiltered& prefiltered);

  /// Takes the next unit for a texture. `sampler` is its type in the shader.
  void add(std::string_view name, std::string_view sampler);

  [[nodiscard]] std::size_t size() const { return textures_.size(); }
  /// Errors: std::logic_error where there is no such texture.
  [[nodiscard]] GLuint unit(std::string_view name) const;
  /// A `layout(binding) uniform` line a texture.
  [[nodiscard]] std::string declarations() const;

  /// Errors (machine), which name the method and the textures: this GL has fewer units.
  void require_room(const gl::ContextInfo& context, const std::string& method) const;
  /// Errors (usage), which name the method: its program reads a texture that is none of these.
  void require_all_of(const gl::Program& program, const std::string& method) const;

 private:
  struct Texture {
    std::string name;
    std::string_view sampler;
  };
  std::vector<Texture> textures_;
};

/// Those of a forward pass: behind the module's the environment's, those of its visibility, and the shadow maps.
[[nodiscard]] TextureUnits forward_units(const ShaderVariant& variant, const Prefiltered& prefiltered);

/// The textures of an environment in the order of their units.
[[nodiscard]] std::vector<std::string_view> environment_textures(EnvironmentUse use);

}  // namespace footprint
