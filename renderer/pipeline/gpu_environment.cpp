// What each use of an environment reads: prefiltered maps, tables to draw directions from, or cells of light.
#include "renderer/pipeline/gpu_environment.hpp"

#include <glm/glm.hpp>
#include <vector>

#include "renderer/environment/cell_light.hpp"
#include "renderer/environment/direction_table.hpp"
#include "renderer/environment/lobe_table.hpp"
#include "renderer/pipeline/bindings.hpp"
#include "renderer/pipeline/gpu_scene.hpp"

namespace footprint {
namespace {

gl::Buffer block_of(const std::vector<glm::vec4>& values) { return gl::Buffer(std::as_bytes(std::span(values))); }

gl::Texture plain_texture(const Image& image, GLenum internal_format, GLenum format) {
  gl::Texture texture(internal_format, image.width, image.height);
  texture.upload(0, image.width, image.height, format, GL_FLOAT, image.texels.data());
  return texture;
}

}  // namespace

GpuEnvironment::Part GpuEnvironment::stack_part() const {
  const RadianceStack stack = prefilter_environment(looked_up(), no_progress);
  const PrefilteredTexture maps = make_array_texture("environment_stack", stack.layers, Storage::fp32, {});
  std::vector<std::vector<Image>> layers;
  for (Image& layer : make_lobe_table().layers) layers.push_back({std::move(layer)});
  const PrefilteredTexture lobes = make_array_texture("environment_lobes", std::move(layers), Storage::fp32, {});
  Part part;
  part.textures.push_back(upload_texels(maps));
  part.textures.push_back(plain_texture(stack.irradiance, GL_RGBA32F, GL_RGBA));
  part.textures.push_back(upload_texels(lobes));
  part.sampler = gl::trilinear_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
  std::vector<glm::vec4> values{glm::vec4(stack.mean, 0.0F),
                                glm::vec4(stack.finest_sharpness, static_cast<float>(stack.map_count()), 0.0F, 0.0F)};
  for (const SmallSun& sun : apart_.suns) {
    values.emplace_back(sun.direction, 0.0F);
    values.emplace_back(sun.irradiance, 0.0F);
  }
  part.block = block_of(values);
  part.bytes = byte_count(maps) + byte_count(lobes) + stack.irradiance.texels.size() * sizeof(float);
  return part;
}

GpuEnvironment::Part GpuEnvironment::table_part() const {
  const Image& map = *environment_.radiance;
  const DirectionTable table = direction_table(map);
  Part part;
  part.textures.push_back(plain_texture(table.radiance, GL_RGBA32F, GL_RGBA));
  part.textures.push_back(plain_texture(table.sums, GL_RG32F, GL_RG));
  part.sampler = gl::nearest_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
  part.block =
      block_of({glm::vec4(static_cast<float>(map.width), static_cast<float>(map.height), environment_.rotation, 0.0F),
                glm::vec4(0.0F)});
  part.bytes = (table.radiance.texels.size() + table.sums.texels.size()) * sizeof(float);
  return part;
}

// A texture is never empty: of a black environment it holds one dark light.
GpuEnvironment::Part GpuEnvironment::light_part() const {
  std::vector<DenseLight> lights = dense_lights(environment_);
  if (lights.empty()) lights.push_back({.direction = {0, 1, 0}, .irradiance = glm::vec3(0.0F)});
  Image irradiance(static_cast<int>(lights.size()), 1, 4), directions(static_cast<int>(lights.size()), 1, 4);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      irradiance.texels[4 * i + static_cast<std::size_t>(c)] = lights[i].irradiance[c];
      directions.texels[4 * i + static_cast<std::size_t>(c)] = lights[i].direction[c];
    }
  }
  Part part;
  part.textures.push_back(plain_texture(irradiance, GL_RGBA32F, GL_RGBA));
  part.textures.push_back(plain_texture(directions, GL_RGBA32F, GL_RGBA));
  part.sampler = gl::nearest_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
  part.block = block_of({glm::vec4(0.0F), glm::vec4(0.0F)});
  part.bytes = (irradiance.texels.size() + directions.texels.size()) * sizeof(float);
  return part;
}

void GpuEnvironment::prepare(EnvironmentUse use) {
  std::optional<Part>& part = parts_.at(static_cast<std::size_t>(use));
  if (part) return;
  switch (use) {
    case EnvironmentUse::prefiltered:
      part = stack_part();
      return;
    case EnvironmentUse::sampled:
      part = table_part();
      return;
    case EnvironmentUse::dense:
      part = light_part();
      return;
  }
}

void GpuEnvironment::bind(const TextureUnits& units, EnvironmentUse use) const {
  const Part& part = parts_.at(static_cast<std::size_t>(use)).value();
  const std::vector<std::string_view> names = environment_textures(use);
  for (std::size_t i = 0; i < names.size(); ++i) {
    gl::api().BindTextureUnit(units.unit(names[i]), part.textures.at(i).name());
    gl::api().BindSampler(units.unit(names[i]), part.sampler.name());
  }
  gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::environment, part.block.name());
}

}  // namespace footprint
