// Creates the textures of each use of an environment, and uploads visibility as layers and vertex attributes.
#include "renderer/pipeline/gpu_environment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/environment/radiance_stack.hpp"
#include "renderer/environment/reference_tables.hpp"
#include "renderer/gl/functions.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/scene/geometry.hpp"

namespace footprint {
namespace {

gl::Buffer block_of(const std::vector<glm::vec4>& values) { return gl::Buffer(std::as_bytes(std::span(values))); }

SampledTexture sampled(const PrefilteredTexture& texture, gl::Sampler sampler) {
  return {upload_texels(texture), std::move(sampler), byte_count(texture)};
}

// Layers of one level, blended.
SampledTexture blended_layers(std::string name, std::vector<Image> layers) {
  std::vector<std::vector<Image>> chains;
  for (Image& layer : layers) chains.push_back({std::move(layer)});
  return sampled(make_array_texture(std::move(name), std::move(chains), Storage::fp32, {}),
                 gl::trilinear_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE));
}

// A table that is read texel by texel.
SampledTexture plain_table(std::string name, Image texels) {
  return sampled(make_level_texture(std::move(name), std::move(texels), Storage::fp32, {}),
                 gl::nearest_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE));
}

constexpr std::size_t vectors_per_vertex = 5;

// Fitted once per kind and process: every scene on the GPU needs it again.
const std::vector<Image>& table_of_kind(const ReflectedLobeKind& kind) {
  static std::mutex guard;
  static std::map<ReflectedLobeKind, std::vector<Image>> tables;
  const std::scoped_lock lock(guard);
  std::vector<Image>& table = tables[kind];
  if (table.empty()) table = make_cosine_table(kind);
  return table;
}

}  // namespace

SampledTexture area_cosines_of(const BaseBrdf& brdf) {
  std::vector<Image> layers;
  const auto add = [&](NormalDistribution distribution) {
    std::ranges::copy(table_of_kind({distribution, brdf.geometry, brdf.distribution == NormalDistribution::ggx}),
                      std::back_inserter(layers));
  };
  add(brdf.distribution);
  if (brdf.distribution == NormalDistribution::ggx) add(NormalDistribution::beckmann);
  return blended_layers("area_cosines", std::move(layers));
}

std::size_t GpuEnvironment::stack_bytes() const {
  std::size_t bytes = 0;
  if (!parts_[0]) return bytes;
  for (const SampledTexture& map : parts_[0]->textures) bytes += map.bytes;
  return bytes;
}

GpuEnvironment::Part GpuEnvironment::stack_part() const {
  const auto smooth = [] { return gl::trilinear_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE); };
  RadianceStack stack = prefilter_environment(looked_up(), no_progress);
  std::vector<glm::vec4> values{glm::vec4(stack.mean, 0.0F),
                                glm::vec4(stack.finest_sharpness, static_cast<float>(stack.map_count()), 0.0F, 0.0F)};
  for (const SmallSun& sun : apart_.suns) {
    values.emplace_back(sun.direction, 0.0F);
    values.emplace_back(sun.irradiance, 0.0F);
  }
  Part part{.textures = {}, .block = block_of(values)};
  part.textures.push_back(
      sampled(make_array_texture("environment_stack", std::move(stack.layers), Storage::fp32, {}), smooth()));
  part.textures.push_back(
      sampled(make_level_texture("environment_irradiance", std::move(stack.irradiance), Storage::fp32, {}), smooth()));
  part.textures.push_back(blended_layers("environment_lobes", make_lobe_table()));
  return part;
}

GpuEnvironment::Part GpuEnvironment::table_part() const {
  const Image& map = *environment_.radiance;
  DirectionTable table = direction_table(map);
  Part part{.textures = {},
            .block = block_of(
                {glm::vec4(static_cast<float>(map.width), static_cast<float>(map.height), environment_.rotation, 0.0F),
                 glm::vec4(0.0F)})};
  part.textures.push_back(plain_table("environment_radiance", std::move(table.radiance)));
  part.textures.push_back(plain_table("environment_sums", std::move(table.sums)));
  return part;
}

// Textures cannot be empty, so a black environment has one dark light.
GpuEnvironment::Part GpuEnvironment::light_part() const {
  std::vector<DenseLight> lights = dense_lights(environment_);
  if (lights.empty()) lights.push_back({.direction = {0, 1, 0}, .irradiance = glm::vec3(0.0F)});
  Image irradiance(static_cast<int>(lights.size()), 1, 4), directions(static_cast<int>(lights.size()), 1, 4);
  for (int i = 0; i < irradiance.width; ++i) {
    const DenseLight& light = lights[static_cast<std::size_t>(i)];
    std::ranges::copy_n(glm::value_ptr(light.irradiance), 3, irradiance.at(i, 0).begin());
    std::ranges::copy_n(glm::value_ptr(light.direction), 3, directions.at(i, 0).begin());
  }
  Part part{.textures = {}, .block = block_of({glm::vec4(0.0F), glm::vec4(0.0F)})};
  part.textures.push_back(plain_table("environment_lights", std::move(irradiance)));
  part.textures.push_back(plain_table("environment_directions", std::move(directions)));
  return part;
}

void GpuEnvironment::prepare(EnvironmentUse use) {
  std::optional<Part>& part = parts_.at(static_cast<std::size_t>(use));
  if (part) return;
  part = use == EnvironmentUse::prefiltered ? stack_part()
         : use == EnvironmentUse::sampled   ? table_part()
                                            : light_part();
}

void GpuEnvironment::bind(const TextureUnits& units, EnvironmentUse use) const {
  const Part& part = parts_.at(static_cast<std::size_t>(use)).value();
  const std::vector<std::string_view> names = environment_textures(use);
  for (std::size_t i = 0; i < names.size(); ++i) part.textures.at(i).bind(units.unit(names[i]));
  gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::environment, part.block.name());
}

bool hides_environment(const EffectSet& effects) {
  return has(effects, Effect::environment_light) && has(effects, Effect::cast_shadow);
}

Scene refined_for_visibility(Scene scene, const EffectSet& effects, std::span<const Mesh> shapes) {
  const float longest = scene.bounds.radius() / visibility_edges_in_radius;
  if (!hides_environment(effects) || !(longest > 0.0F)) return scene;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    scene.meshes[i] = subdivided(scene.meshes[i], longest, shapes.empty() ? nullptr : &shapes[i]);
  return scene;
}

GpuVisibility::GpuVisibility(const Scene& scene, const Environment& environment, const Progress& progress,
                             const DiskCache* cache)
    : field_(cached_visibility_field(scene, environment, cache, progress)),
      maps_(blended_layers("visibility_maps", field_.layers)) {
  for (const Mesh& mesh : scene.meshes) vertex_count_ += mesh.vertices.size();
  bytes_ = maps_.bytes + vertex_count_ * vectors_per_vertex * sizeof(glm::vec4);
}

std::string GpuVisibility::shortage() const {
  if (field_.coarseness == 1.0) return {};
  return fmt::format(
      "memory is short: what vertices see of the environment is computed {:g} times as far apart as "
      "usual, so shadows of it are softer",
      field_.coarseness);
}

std::vector<glm::vec4> GpuVisibility::attributes(const Scene& scene, std::size_t material) const {
  std::vector<glm::vec4> values;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (static_cast<std::size_t>(scene.meshes[i].material) != material) continue;
    for (const VertexVisibility& vertex : field_.meshes[i]) {
      const auto& w = vertex.weights;
      values.insert(values.end(), {{1.0F, w[0], w[1], w[2]},
                                   {w[3], w[4], w[5], w[6]},
                                   {w[7], w[8], w[9], w[10]},
                                   {w[11], w[12], w[13], w[14]},
                                   glm::vec4(vertex.diffuse_share, vertex.hidden)});
    }
  }
  return values;
}

}  // namespace footprint
