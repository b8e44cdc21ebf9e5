// Creates the textures of each use of an environment, and uploads visibility as layers and vertex attributes.
#include "renderer/pipeline/gpu_environment.hpp"

#include <glm/glm.hpp>
#include <memory>
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

gl::Texture plain_texture(const Image& image, GLenum internal_format, GLenum format) {
  gl::Texture texture(internal_format, image.width, image.height);
  texture.upload(0, image.width, image.height, format, GL_FLOAT, image.texels.data());
  return texture;
}

constexpr std::size_t vectors_per_vertex = 5;

// Fitted once per kind and process: every scene on the GPU needs it again.
const CosineTable& table_of_kind(const ReflectedLobeKind& kind) {
  static std::mutex guard;
  static std::vector<std::pair<ReflectedLobeKind, std::unique_ptr<const CosineTable>>> tables;
  const std::scoped_lock lock(guard);
  for (const auto& [of, table] : tables) {
    if (of == kind) return *table;
  }
  tables.emplace_back(kind, std::make_unique<const CosineTable>(make_cosine_table(kind)));
  return *tables.back().second;
}

PrefilteredTexture table_of(const BaseBrdf& brdf) {
  std::vector<std::vector<Image>> layers;
  const auto add = [&](NormalDistribution distribution) {
    for (const Image& layer : table_of_kind(reflected_lobe_kind(brdf, distribution)).layers) layers.push_back({layer});
  };
  add(brdf.distribution);
  if (brdf.distribution == NormalDistribution::ggx) add(NormalDistribution::beckmann);
  return make_array_texture("area_cosines", std::move(layers), Storage::fp32, {});
}

}  // namespace

ReflectedLobeKind reflected_lobe_kind(const BaseBrdf& brdf, NormalDistribution distribution) {
  switch (brdf.geometry) {
    case GeometryTerm::none:
      break;
    case GeometryTerm::tan:
      return {distribution, TabulatedGeometry::tan};
    case GeometryTerm::ward:
      return {distribution, TabulatedGeometry::ward};
    case GeometryTerm::smith:
      return {distribution, brdf.distribution == NormalDistribution::ggx ? TabulatedGeometry::smith_ggx
                                                                         : TabulatedGeometry::smith_beckmann};
  }
  return {distribution, TabulatedGeometry::none};
}

GpuAreaCosines::GpuAreaCosines(const BaseBrdf& brdf)
    : sampler_(gl::trilinear_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE)) {
  const PrefilteredTexture table = table_of(brdf);
  bytes_ = byte_count(table);
  table_ = upload_texels(table);
}

void GpuAreaCosines::bind(GLuint unit) const { gl::bind_texture(unit, table_, sampler_.name()); }

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

// Textures cannot be empty, so a black environment has one dark light.
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
  for (std::size_t i = 0; i < names.size(); ++i)
    gl::bind_texture(units.unit(names[i]), part.textures.at(i), part.sampler.name());
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
      sampler_(gl::trilinear_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE)) {
  std::vector<std::vector<Image>> chains;
  for (const Image& layer : field_.layers) chains.push_back({layer});
  const PrefilteredTexture maps = make_array_texture("visibility_maps", std::move(chains), Storage::fp32, {});
  maps_ = upload_texels(maps);
  for (const Mesh& mesh : scene.meshes) vertex_count_ += mesh.vertices.size();
  bytes_ = byte_count(maps) + vertex_count_ * vectors_per_vertex * sizeof(glm::vec4);
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

void GpuVisibility::bind(GLuint unit) const { gl::bind_texture(unit, maps_, sampler_.name()); }

}  // namespace footprint
