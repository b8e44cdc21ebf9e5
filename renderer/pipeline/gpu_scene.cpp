// See gpu_scene.hpp.
#include "renderer/pipeline/gpu_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <span>

#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/facet_lobes.hpp"
#include "renderer/pipeline/light_blocks.hpp"

namespace footprint {
namespace {

constexpr float never_cut = -1.0F;  // no alpha lies below it

GLenum gl_wrap(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return GL_REPEAT;
    case Wrap::mirrored_repeat:
      return GL_MIRRORED_REPEAT;
    case Wrap::clamp_to_edge:
      return GL_CLAMP_TO_EDGE;
  }
  return GL_REPEAT;
}

struct GlFormat {
  GLenum internal, format, type;
};

GlFormat gl_format(Storage storage, int channels) {
  constexpr std::array<GLenum, 4> formats{GL_RED, GL_RG, GL_RGB, GL_RGBA};
  constexpr std::array<std::array<GLenum, 4>, 3> internals{{{GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F},
                                                            {GL_R16F, GL_RG16F, GL_RGB16F, GL_RGBA16F},
                                                            {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8}}};
  constexpr std::array<GLenum, 3> types{GL_FLOAT, GL_HALF_FLOAT, GL_UNSIGNED_BYTE};
  const auto s = static_cast<std::size_t>(storage);
  const auto c = static_cast<std::size_t>(channels - 1);
  return {internals.at(s).at(c), formats.at(c), types.at(s)};
}

glm::vec4 linear_part(const TextureCoordinates& c) { return {c.transform[0], c.transform[1]}; }

glm::vec4 offset_and_set(const TextureCoordinates& c) { return {c.transform[2], static_cast<float>(c.set), 0.0F}; }

// The std140 members of MaterialBlock in surface_material.glsl. What multi_lobe adds comes last: a program whose method
// leaves it out has a block without it.
std::vector<glm::vec4> material_block(const Material& material, const EffectSet& effects) {
  const bool specular_varies = has(effects, Effect::specular_variation);
  glm::vec3 specular = material.dielectric_specular;
  if (!specular_varies) specular *= glm::make_vec3(specular_map_of(material).texels.data());
  std::vector<glm::vec4> block{
      material.base_color, glm::vec4(specular, metallic_map_of(material).texels.front()),
      glm::vec4(lobe_parameter(material), material.alpha_cutoff.value_or(never_cut), 0.0F, 0.0F)};
  const std::array slots{normal_coordinates(material), roughness_coordinates(material),
                         base_color_coordinates(material)};
  for (const TextureCoordinates& slot : slots) block.push_back(linear_part(slot));
  for (const TextureCoordinates& slot : slots) block.push_back(offset_and_set(slot));
  if (specular_varies) {
    block.push_back(linear_part(specular_coordinates(material)));
    block.push_back(offset_and_set(specular_coordinates(material)));
  }
  if (has(effects, Effect::multi_lobe)) {
    const std::vector<glm::vec4> lobes = facet_lobe_block(material);
    block.insert(block.end(), lobes.begin(), lobes.end());
  }
  return block;
}

bool same_place(const TextureCoordinates& a, const TextureCoordinates& b) {
  return a.set == b.set && a.transform == b.transform;
}

bool maps_share_coordinates(const Material& m) {
  std::vector<TextureCoordinates> used;
  if (m.normal_map) used.push_back(m.normal_map->coordinates);
  if (m.metallic_roughness_map || m.lobe_parameter_map) used.push_back(roughness_coordinates(m));
  if (m.base_color_map) used.push_back(m.base_color_map->coordinates);
  if (m.specular_map) used.push_back(m.specular_map->coordinates);
  // Slot 0 serves every map: a material without a normal map has the default there.
  const TextureCoordinates first = normal_coordinates(m);
  return std::ranges::all_of(used, [&](const TextureCoordinates& c) { return same_place(c, first); });
}

// A block without lights holds one dark one, since the shader's array has at least one member.
gl::Buffer light_buffer(std::span<const glm::vec4> values) {
  static constexpr std::array<glm::vec4, 4> dark{};
  return gl::Buffer(std::as_bytes(values.empty() ? std::span<const glm::vec4>(dark) : values));
}

void add_attribute(GLuint array, GLuint location, GLint size, std::size_t offset) {
  gl::api().EnableVertexArrayAttrib(array, location);
  gl::api().VertexArrayAttribFormat(array, location, size, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  gl::api().VertexArrayAttribBinding(array, location, 0);
}

gl::VertexArray vertex_array(const gl::Buffer& vertices, const gl::Buffer& indices) {
  GLuint name = 0;
  gl::api().CreateVertexArrays(1, &name);
  gl::VertexArray array(name);
  gl::api().VertexArrayVertexBuffer(name, 0, vertices.name(), 0, sizeof(Vertex));
  gl::api().VertexArrayElementBuffer(name, indices.name());
  add_attribute(name, 0, 3, offsetof(Vertex, position));
  add_attribute(name, 1, 3, offsetof(Vertex, normal));
  add_attribute(name, 2, 4, offsetof(Vertex, tangent));
  add_attribute(name, 3, 2, offsetof(Vertex, uv0));
  add_attribute(name, 4, 2, offsetof(Vertex, uv1));
  return array;
}

// All triangles of a material in one draw call.
GpuBatch batch_of(const Scene& scene, std::size_t material, const EffectSet& effects) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (const Mesh& mesh : scene.meshes) {
    if (static_cast<std::size_t>(mesh.material) != material) continue;
    const auto base = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const std::uint32_t index : mesh.indices) indices.push_back(base + index);
  }
  if (indices.size() > static_cast<std::size_t>(std::numeric_limits<GLsizei>::max())) {
    throw Error(ErrorKind::machine, scene.source, "one material has more indices than a draw call takes", "split it");
  }
  GpuBatch batch;
  batch.vertices = gl::Buffer(std::as_bytes(std::span(vertices)));
  batch.indices = gl::Buffer(std::as_bytes(std::span(indices)));
  batch.vertex_array = vertex_array(batch.vertices, batch.indices);
  batch.index_count = static_cast<GLsizei>(indices.size());
  batch.material = material;
  batch.double_sided = scene.materials[material].double_sided;
  const std::vector<glm::vec4> block = material_block(scene.materials[material], effects);
  batch.material_block = gl::Buffer(std::as_bytes(std::span(block)));
  return batch;
}

std::vector<PrefilteredTexture> shared_textures(const Material& material, const EffectSet& effects) {
  std::vector<PrefilteredTexture> textures;
  if (has(effects, Effect::base_color_variation)) {
    const Image image = material.base_color_map ? *material.base_color_map->image : Image(1, 1, 4, 1.0F);
    textures.push_back(
        make_texture("base_color_map", mip_chain(image), Storage::fp32, base_color_coordinates(material)));
  }
  if (has(effects, Effect::metallic_variation)) {
    textures.push_back(make_texture("metallic_map", mip_chain(metallic_map_of(material)), Storage::fp32,
                                    roughness_coordinates(material)));
  }
  if (has(effects, Effect::specular_variation)) {
    textures.push_back(make_texture("specular_map", mip_chain(specular_map_of(material)), Storage::fp32,
                                    specular_coordinates(material)));
  }
  return textures;
}

void require_capacity(const gl::ContextInfo& context, std::size_t vectors, const std::string& source) {
  const std::size_t bytes = vectors * sizeof(glm::vec4);
  if (bytes <= static_cast<std::size_t>(context.max_uniform_block_bytes)) return;
  throw Error(ErrorKind::machine, source, fmt::format("its lights take {} bytes of a uniform block", bytes),
              fmt::format("this GL takes {}: use fewer lights", context.max_uniform_block_bytes));
}

}  // namespace

GLuint SamplerCache::sampler(const TextureCoordinates& coordinates, Lookup lookup) {
  for (const Entry& entry : entries_) {
    if (entry.wrap == coordinates.wrap && entry.lookup == lookup) return entry.sampler.name();
  }
  const auto make = lookup == Lookup::trilinear ? gl::trilinear_sampler : gl::nearest_sampler;
  entries_.push_back({coordinates.wrap, lookup, make(gl_wrap(coordinates.wrap[0]), gl_wrap(coordinates.wrap[1]))});
  return entries_.back().sampler.name();
}

GpuTexture upload(const PrefilteredTexture& texture) {
  const GlFormat format = gl_format(texture.storage, texture.channels);
  const TextureLevel& finest = texture.levels.front();
  GpuTexture out{gl::Texture(format.internal, finest.width, finest.height, static_cast<int>(texture.levels.size()),
                             texture.layers),
                 texture.coordinates, texture.filter};
  for (std::size_t i = 0; i < texture.levels.size() && !texture.built; ++i) {
    const TextureLevel& level = texture.levels[i];
    out.texture.upload(static_cast<int>(i), level.width, level.height, format.format, format.type, level.bytes.data());
  }
  return out;
}

GpuScene::GpuScene(const gl::ContextInfo& context, const Scene& scene, const EffectSet& effects)
    : effects_(effects), brdf_(scene.materials.front().brdf) {
  for (const Material& material : scene.materials) {
    if (material.brdf != brdf_) {
      throw Error(ErrorKind::usage, scene.source,
                  fmt::format("material {} has another base BRDF than the first", material.name),
                  "a comparison needs one: set it in [brdf] of a scene.toml");
    }
    shared_coordinates_ = shared_coordinates_ && maps_share_coordinates(material);
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    GpuBatch batch = batch_of(scene, i, effects);
    if (batch.index_count == 0) continue;
    for (const PrefilteredTexture& texture : shared_textures(scene.materials[i], effects)) {
      shared_bytes_ += byte_count({.textures = {texture}, .scalars = {}});
      batch.shared_textures.push_back(upload(texture));
    }
    batches_.push_back(std::move(batch));
  }
  const LightBlocks blocks = light_blocks(scene.lights);
  require_capacity(context, std::max({blocks.point.size(), blocks.spot.size(), blocks.directional.size()}),
                   scene.source);
  point_lights_ = light_buffer(blocks.point);
  spot_lights_ = light_buffer(blocks.spot);
  directional_lights_ = light_buffer(blocks.directional);
  light_counts_ = {blocks.point.size() / 2, blocks.spot.size() / 4, blocks.directional.size() / 2};
  if (has(effects, Effect::environment_light))
    environment_.emplace(scene.environment.value_or(constant_environment(glm::vec3(0.0F))));
}

void GpuScene::bind_lights(const gl::Program& program) const {
  const auto bind = [&](Effect effect, GLuint binding, const gl::Buffer& buffer, const char* counter,
                        std::size_t count) {
    if (!has(effects_, effect)) return;
    gl::api().BindBufferBase(GL_UNIFORM_BUFFER, binding, buffer.name());
    gl::api().ProgramUniform1i(program.name(), program.uniform(counter), static_cast<GLint>(count));
  };
  bind(Effect::point_light, 2, point_lights_, "point_light_count", light_counts_.point);
  bind(Effect::spot_light, 3, spot_lights_, "spot_light_count", light_counts_.spot);
  bind(Effect::directional_light, 4, directional_lights_, "directional_light_count", light_counts_.directional);
}

}  // namespace footprint
