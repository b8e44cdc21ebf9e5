// The order of texture units: shared maps, the method's own textures, what lights read.
#include "renderer/pipeline/bindings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "renderer/bake/shared_maps.hpp"
#include "renderer/core/error.hpp"
#include "renderer/pipeline/gpu_visibility.hpp"
#include "renderer/pipeline/shadow_maps.hpp"

namespace footprint {
namespace {

constexpr std::array<GLenum, 5> sampler_types{GL_SAMPLER_2D, GL_SAMPLER_2D_ARRAY, GL_SAMPLER_2D_ARRAY_SHADOW,
                                              GL_SAMPLER_3D, GL_SAMPLER_CUBE};

// The names of a program's active uniforms that are textures.
std::vector<std::string> textures_read_by(const gl::Program& program) {
  GLint count = 0, longest = 0;
  gl::api().GetProgramiv(program.name(), GL_ACTIVE_UNIFORMS, &count);
  gl::api().GetProgramiv(program.name(), GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
  std::vector<std::string> names;
  for (GLint i = 0; i < count; ++i) {
    std::string name(static_cast<std::size_t>(longest), '\0');
    GLsizei length = 0;
    GLint elements = 0;
    GLenum type = 0;
    gl::api().GetActiveUniform(program.name(), static_cast<GLuint>(i), longest, &length, &elements, &type, name.data());
    name.resize(static_cast<std::size_t>(length));
    if (std::ranges::find(sampler_types, type) != sampler_types.end()) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

TextureUnits::TextureUnits(const EffectSet& effects, const Prefiltered& prefiltered) {
  for (const SharedMap& map : shared_maps()) {
    if (has(effects, map.effect)) add(map.name, "sampler2D");
  }
  for (const PrefilteredTexture& texture : prefiltered.textures)
    add(texture.name, texture.layers > 0 ? "sampler2DArray" : "sampler2D");
}

void TextureUnits::add(std::string_view name, std::string_view sampler) {
  textures_.push_back({std::string(name), sampler});
}

GLuint TextureUnits::unit(std::string_view name) const {
  const auto found = std::ranges::find(textures_, name, &Texture::name);
  if (found == textures_.end()) throw std::logic_error(fmt::format("no texture unit is given to `{}`", name));
  return static_cast<GLuint>(found - textures_.begin());
}

std::string TextureUnits::declarations() const {
  std::string text;
  for (std::size_t unit = 0; unit < textures_.size(); ++unit)
    text += fmt::format("layout(binding = {}) uniform {} {};\n", unit, textures_[unit].sampler, textures_[unit].name);
  return text;
}

void TextureUnits::require_room(const gl::ContextInfo& context, const std::string& method) const {
  if (size() <= static_cast<std::size_t>(context.max_texture_units)) return;
  std::string names;
  for (const Texture& texture : textures_) names += (names.empty() ? "" : ", ") + texture.name;
  throw Error(ErrorKind::machine, fmt::format("method {}", method),
              fmt::format("its program reads {} textures ({})", size(), names),
              fmt::format("this GL has {} units: pack the method's textures into fewer", context.max_texture_units));
}

void TextureUnits::require_all_of(const gl::Program& program, const std::string& method) const {
  for (const std::string& name : textures_read_by(program)) {
    if (std::ranges::find(textures_, name, &Texture::name) != textures_.end()) continue;
    throw Error(ErrorKind::usage, fmt::format("method {}", method),
                fmt::format("its program reads the texture `{}`, which has no unit", name),
                "bake it in the precompute, or give it a row in renderer/bake/shared_maps.cpp");
  }
}

TextureUnits forward_units(const ShaderVariant& variant, const Prefiltered& prefiltered) {
  TextureUnits units(variant.effects, prefiltered);
  if (has(variant.effects, Effect::environment_light)) {
    for (const std::string_view name : environment_textures(variant.environment))
      units.add(name, name == "environment_stack" || name == "environment_lobes" ? "sampler2DArray" : "sampler2D");
  }
  if (hides_environment(variant.effects)) units.add("visibility_maps", "sampler2DArray");
  if (calls_for_shadow_maps(variant.effects)) units.add("shadow_maps", "sampler2DArrayShadow");
  return units;
}

std::vector<std::string_view> environment_textures(EnvironmentUse use) {
  switch (use) {
    case EnvironmentUse::prefiltered:
      break;
    case EnvironmentUse::sampled:
      return {"environment_radiance", "environment_sums"};
    case EnvironmentUse::dense:
      return {"environment_lights", "environment_directions"};
  }
  return {"environment_stack", "environment_irradiance", "environment_lobes"};
}

}  // namespace footprint
