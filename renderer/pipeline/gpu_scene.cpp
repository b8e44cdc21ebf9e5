// Uploads triangles, textures and uniform blocks, and updates them between frames.
#include "renderer/pipeline/gpu_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <span>
#include <string_view>

#include "renderer/bake/facets.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/emitted_light.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/scene/geometry.hpp"

namespace footprint {
namespace {

constexpr float never_cut = -1.0F;  // no alpha is below it

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

// The number is not in glcorearb.h: GL_EXT_texture_compression_s3tc.
constexpr GLenum rgb_s3tc_dxt1 = 0x83F0;

GlFormat gl_format(Storage storage, int channels) {
  if (storage == Storage::bc1) return {rgb_s3tc_dxt1, GL_RGB, GL_UNSIGNED_BYTE};
  if (storage == Storage::bc4) return {GL_COMPRESSED_RED_RGTC1, GL_RED, GL_UNSIGNED_BYTE};
  if (storage == Storage::bc5) return {GL_COMPRESSED_RG_RGTC2, GL_RG, GL_UNSIGNED_BYTE};
  constexpr std::array<GLenum, 4> formats{GL_RED, GL_RG, GL_RGB, GL_RGBA};
  constexpr std::array<std::array<GLenum, 4>, 3> internals{{{GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F},
                                                            {GL_R16F, GL_RG16F, GL_RGB16F, GL_RGBA16F},
                                                            {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8}}};
  constexpr std::array<GLenum, 3> types{GL_FLOAT, GL_HALF_FLOAT, GL_UNSIGNED_BYTE};
  const auto s = static_cast<std::size_t>(storage);
  const auto c = static_cast<std::size_t>(channels - 1);
  return {internals.at(s).at(c), formats.at(c), types.at(s)};
}

// Whether other materials of its surface are drawn before it.
bool adds_to_surface(const Material& material) { return material.share && !material.share->first; }

// The std140 members of MaterialBlock in surface_material.glsl. Those of multi_lobe come last, because the block of a
// method without that effect ends before them.
std::vector<glm::vec4> material_block(const Material& material, const EffectSet& effects) {
  const bool specular_varies = has(effects, Effect::specular_variation);
  glm::vec3 specular = material.dielectric_specular;
  if (!specular_varies) specular *= glm::make_vec3(specular_map_of(material).texels.data());
  std::vector<glm::vec4> block{material.base_color, glm::vec4(specular, metallic_map_of(material).texels.front()),
                               glm::vec4(lobe_of(material).parameter, material.alpha_cutoff.value_or(never_cut),
                                         material.unlit ? 1.0F : 0.0F, squared_strength(material))};
  const auto add_coordinates = [&](const std::vector<TextureCoordinates>& maps) {
    for (const TextureCoordinates& map : maps) block.emplace_back(map.transform[0], map.transform[1]);
    for (const TextureCoordinates& map : maps) block.emplace_back(map.transform[2], static_cast<float>(map.set), 0.0F);
  };
  add_coordinates({normal_coordinates(material), roughness_coordinates(material), base_color_coordinates(material),
                   layer_coordinates(material)});
  if (has(effects, Effect::anisotropic_lobe)) {
    for (std::size_t i = 0; i < 4; ++i) block[block.size() - 4 + i].w = anisotropy_of(material)[static_cast<int>(i)];
  }
  if (specular_varies) add_coordinates({specular_coordinates(material)});
  if (has(effects, Effect::clear_coat)) {
    // If a map varies, shaders read it instead of the constant, so it need not be decoded here.
    const bool weight_varies = has(effects, Effect::coat_weight_variation);
    const bool width_varies = has(effects, Effect::coat_width_variation);
    block.emplace_back(weight_varies ? 0.0F : coat_weight_map_of(material).texels.front(),
                       width_varies ? 0.0F : coat_width_map_of(material).texels.front(), 0.0F, 0.0F);
    add_coordinates(
        {coat_weight_coordinates(material), coat_width_coordinates(material), coat_normal_coordinates(material)});
  }
  if (has(effects, Effect::material_index)) {
    add_coordinates({share_coordinates(material)});
    block.back().w = adds_to_surface(material) ? 0.0F : 1.0F;
  }
  const bool emission_varies = has(effects, Effect::emission_variation);
  if (has(effects, Effect::emission)) {
    const glm::vec3 factor =
        emission_varies ? glm::vec3(1.0F) : glm::make_vec3(emission_map_of(material).texels.data());
    block.emplace_back(material.emission * factor, 0.0F);
  }
  if (emission_varies) add_coordinates({emission_coordinates(material)});
  if (has(effects, Effect::occlusion)) add_coordinates({occlusion_coordinates(material)});
  if (has(effects, Effect::multi_lobe)) {
    const std::vector<glm::vec4> lobes = facet_lobe_block(material);
    block.insert(block.end(), lobes.begin(), lobes.end());
  }
  return block;
}

// Slot 0 is used for every map: without a normal map it has the default coordinates.
bool maps_share_coordinates(const Material& m) {
  const auto shared = [first = normal_coordinates(m)](const TextureCoordinates& own) { return same_uv(own, first); };
  const bool reads_roughness = m.metallic_roughness_map || m.lobe_parameter_map;
  return (!reads_roughness || shared(roughness_coordinates(m))) &&
         (!m.base_color_map || shared(m.base_color_map->coordinates)) &&
         (!m.specular_map || shared(m.specular_map->coordinates));
}

// A block without lights stores one dark light, because the shader's array has at least one element.
gl::Buffer light_buffer(std::span<const glm::vec4> values) {
  static constexpr std::array<glm::vec4, light_types[light_type::area].vectors> dark{};
  return gl::Buffer(std::as_bytes(values.empty() ? std::span<const glm::vec4>(dark) : values),
                    gl::Buffer::Content::changing);
}

void add_attribute(GLuint array, GLuint location, GLint size, std::size_t offset, GLuint binding = 0) {
  gl::api().EnableVertexArrayAttrib(array, location);
  gl::api().VertexArrayAttribFormat(array, location, size, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  gl::api().VertexArrayAttribBinding(array, location, binding);
}

std::size_t most_lobes_of(std::span<const Material> materials) {
  std::size_t most = 1;
  for (const Material& material : materials) most = std::max(most, material.lobes.size());
  return most;
}

void add_to_hash(std::uint64_t& hash, std::span<const std::byte> bytes) { hash = fnv1a(bytes, hash); }

// All triangles of a material in one draw call, hashed into `content`.
GpuBatch make_batch(const Scene& scene, std::size_t material, const EffectSet& effects, SceneContent& content) {
  const auto [vertices, indices] = collect_triangles(scene, material);
  if (indices.empty()) return {};
  if (indices.size() > static_cast<std::size_t>(std::numeric_limits<GLsizei>::max())) {
    throw Error(ErrorKind::machine, scene.source, "one material has more indices than a draw call takes", "split it");
  }
  GpuBatch batch;
  batch.vertices = gl::Buffer(std::as_bytes(std::span(vertices)), gl::Buffer::Content::changing);
  batch.indices = gl::Buffer(std::as_bytes(std::span(indices)));
  batch.vertex_array = vertex_array(batch.vertices, batch.indices);
  batch.index_count = static_cast<GLsizei>(indices.size());
  batch.vertex_count = vertices.size();
  batch.material = material;
  batch.double_sided = scene.materials[material].double_sided;
  batch.coordinates = normal_coordinates(scene.materials[material]);
  batch.adds = adds_to_surface(scene.materials[material]);
  const std::vector<glm::vec4> block = material_block(scene.materials[material], effects);
  batch.material_block = gl::Buffer(std::as_bytes(std::span(block)), gl::Buffer::Content::changing);
  add_to_hash(content.geometry, std::as_bytes(std::span(vertices)));
  add_to_hash(content.materials, std::as_bytes(std::span(block)));
  return batch;
}

// Uploads the maps that every method reads.
void add_shared_textures(const Material& material, const EffectSet& effects, SharedUploads& uploads, GpuBatch& batch) {
  for (const SharedMap& map : shared_maps()) {
    if (!has(effects, map.effect)) continue;
    const PrefilteredTexture texture =
        make_texture(std::string(map.name), mip_chain(map.image(material)), Storage::fp32, map.coordinates(material));
    batch.shared_textures.push_back(uploads.upload(texture));
  }
}

// All lights of one kind must fit into one uniform block.
void require_capacity(const gl::ContextInfo& context, const LightType& kind, std::size_t lights,
                      const std::string& source) {
  const std::size_t most = static_cast<std::size_t>(context.max_uniform_block_bytes) / sizeof(glm::vec4) / kind.vectors;
  if (lights <= most) return;
  throw Error(ErrorKind::machine, source, fmt::format("has {} {} lights", lights, kind.name),
              fmt::format("the OpenGL of this machine takes {} at once: leave the others out", most));
}

}  // namespace

bool same_uv(const TextureCoordinates& a, const TextureCoordinates& b) {
  return a.set == b.set && a.transform == b.transform;
}

gl::VertexArray vertex_array(const gl::Buffer& vertices, const gl::Buffer& indices, const gl::Buffer* surface) {
  gl::VertexArray array = gl::VertexArray::make();
  const GLuint name = array.name();
  gl::api().VertexArrayVertexBuffer(name, 0, vertices.name(), 0, sizeof(Vertex));
  gl::api().VertexArrayElementBuffer(name, indices.name());
  add_attribute(name, 0, 3, offsetof(Vertex, position));
  add_attribute(name, 1, 3, offsetof(Vertex, normal));
  add_attribute(name, 2, 4, offsetof(Vertex, tangent));
  add_attribute(name, 3, 2, offsetof(Vertex, uv0));
  add_attribute(name, 4, 2, offsetof(Vertex, uv1));
  add_attribute(name, 11, 4, offsetof(Vertex, color));
  if (surface != nullptr) {
    gl::api().VertexArrayVertexBuffer(name, 1, surface->name(), 0, sizeof(glm::vec2));
    add_attribute(name, 5, 2, 0, 1);
  }
  return array;
}

void add_visibility(const gl::VertexArray& array, const gl::Buffer& visibility) {
  constexpr GLuint first_location = 6;  // in surface_vertex.glsl
  constexpr GLuint vectors = 5;
  gl::api().VertexArrayVertexBuffer(array.name(), 2, visibility.name(), 0, vectors * sizeof(glm::vec4));
  for (GLuint i = 0; i < vectors; ++i) add_attribute(array.name(), first_location + i, 4, i * sizeof(glm::vec4), 2);
}

GLuint SamplerCache::sampler(const TextureCoordinates& coordinates, SamplerState state) {
  for (const Entry& entry : entries_) {
    if (entry.wrap == coordinates.wrap && entry.state == state) return entry.sampler.name();
  }
  const GLenum along_u = gl_wrap(coordinates.wrap[0]), along_v = gl_wrap(coordinates.wrap[1]);
  entries_.push_back({coordinates.wrap, state,
                      state.linear ? gl::trilinear_sampler(along_u, along_v, state.max_anisotropy)
                                   : gl::nearest_sampler(along_u, along_v)});
  return entries_.back().sampler.name();
}

gl::Texture upload_texels(const PrefilteredTexture& texture) {
  const GlFormat format = gl_format(texture.storage, texture.channels);
  const TextureLevel& finest = texture.levels.front();
  gl::Texture out(format.internal, finest.width, finest.height, static_cast<int>(texture.levels.size()),
                  texture.layers);
  for (std::size_t i = 0; i < texture.levels.size() && !texture.built; ++i) {
    const TextureLevel& level = texture.levels[i];
    if (is_block(texture.storage)) {
      out.upload_blocks(static_cast<int>(i), level.width, level.height, format.internal, level.bytes);
    } else {
      out.upload(static_cast<int>(i), level.width, level.height, format.format, format.type, level.bytes.data());
    }
  }
  return out;
}

void read_texels(const gl::Texture& from, PrefilteredTexture& into) {
  const GlFormat format = gl_format(into.storage, into.channels);
  gl::api().PixelStorei(GL_PACK_ALIGNMENT, 1);
  const int texel_layers = into.channels * std::max(into.layers, 1);
  for (std::size_t i = 0; i < into.levels.size(); ++i) {
    TextureLevel& level = into.levels[i];
    std::vector<std::uint8_t>& bytes = level.bytes;
    bytes.resize(channel_bytes(into.storage) * static_cast<std::size_t>(texel_layers) *
                 static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
    gl::api().GetTextureImage(from.name(), static_cast<GLint>(i), format.format, format.type,
                              static_cast<GLsizei>(bytes.size()), bytes.data());
  }
  into.built = false;
}

GpuTexture upload(const PrefilteredTexture& texture) {
  return {std::make_shared<const gl::Texture>(upload_texels(texture)), texture.coordinates, texture.filter};
}

GpuTexture SharedUploads::upload(const PrefilteredTexture& texture) {
  if (texture.built) {
    bytes_ += byte_count(texture);
    return footprint::upload(texture);
  }
  const auto [entry, is_new] = uploaded_.try_emplace(texel_content(texture));
  if (is_new) {
    entry->second = std::make_shared<const gl::Texture>(upload_texels(texture));
    bytes_ += byte_count(texture);
  }
  return {entry->second, texture.coordinates, texture.filter};
}

GpuScene::GpuScene(const gl::ContextInfo& context, const Scene& scene, const EffectSet& effects,
                   const Progress& progress, const DiskCache* cache, const GpuScene* same)
    : context_(&context),
      effects_(effects),
      brdf_(scene.materials.front().brdf),
      horizon_(scene.horizon),
      facet_lobes_(most_lobes_of(scene.materials)) {
  for (const Material& material : scene.materials) {
    if (material.brdf != brdf_) {
      throw Error(ErrorKind::usage, scene.source,
                  fmt::format("material {} has another base BRDF than the first", material.name),
                  "a comparison needs one: set it in [brdf] of a scene.toml");
    }
    shared_coordinates_ = shared_coordinates_ && maps_share_coordinates(material);
  }
  SharedUploads uploads;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    GpuBatch batch = make_batch(scene, i, effects, content_);
    if (batch.index_count == 0) continue;
    add_shared_textures(scene.materials[i], effects, uploads, batch);
    batch.index = batches_.size();
    batches_.push_back(std::move(batch));
  }
  shared_bytes_ = uploads.bytes();
  if (same != nullptr) environment_ = same->environment_;
  area_cosines_ = same != nullptr ? same->area_cosines_ : std::make_shared<std::optional<SampledTexture>>();
  make_lights(context, scene);
  if (!hides_environment(effects)) return;
  if (same != nullptr && same->visibility_ != nullptr) {
    take_visibility(scene, same->visibility_);
  } else {
    make_visibility(scene, progress, cache);
  }
}

void GpuScene::make_visibility(const Scene& scene, const Progress& progress, const DiskCache* cache) {
  const Environment white = constant_environment(glm::vec3(1.0F));
  take_visibility(scene, std::make_shared<const GpuVisibility>(
                             scene, scene.environment ? environment_->looked_up() : white, progress, cache));
}

void GpuScene::take_visibility(const Scene& scene, std::shared_ptr<const GpuVisibility> visibility) {
  if (visibility_) shared_bytes_ -= visibility_->bytes();
  visibility_ = std::move(visibility);
  shared_bytes_ += visibility_->bytes();
  for (GpuBatch& batch : batches_) {
    const std::vector<glm::vec4> attributes = visibility_->attributes(scene, batch.material);
    if (batch.visibility.name() != 0) {
      batch.visibility.write(std::as_bytes(std::span(attributes)));
    } else {
      batch.visibility = gl::Buffer(std::as_bytes(std::span(attributes)), gl::Buffer::Content::changing);
      add_visibility(batch.vertex_array, batch.visibility);
    }
  }
}

LightBlocks GpuScene::blocks_of(std::span<const Light> lights) const {
  return light_blocks(lights,
                      shadow_maps_ ? std::span<const int>(shadow_maps_->views().first) : std::span<const int>());
}

void GpuScene::make_lights(const gl::ContextInfo& context, const Scene& scene) {
  if (calls_for_shadow_maps(effects_)) {
    shadow_maps_.emplace(context, scene, effects_, batches_, samplers_);
    shared_bytes_ += shadow_maps_->bytes();
  }
  const LightBlocks blocks = blocks_of(scene.lights);
  light_counts_ = {.of = {},
                   .area_by_lobes = blocks.area_by_lobes,
                   .points_alone = blocks.points_alone,
                   .shadow_maps = shadow_maps_ ? shadow_maps_->views().views.size() : 0};
  for (std::size_t i = 0; i < light_types.size(); ++i) {
    light_counts_.of[i] = blocks.vectors[i].size() / light_types[i].vectors;
    require_capacity(context, light_types[i], light_counts_.of[i], scene.source);
    light_buffers_[i] = light_buffer(blocks.vectors[i]);
    add_to_hash(content_.lights, std::as_bytes(std::span(blocks.vectors[i])));
  }
  if (!has(effects_, Effect::environment_light)) {
    environment_ = nullptr;
  } else if (environment_ == nullptr) {
    environment_ = std::make_shared<GpuEnvironment>(scene.environment.value_or(constant_environment(glm::vec3(0.0F))));
  }
}

const SampledTexture& GpuScene::area_cosines() {
  if (!*area_cosines_) *area_cosines_ = area_cosines_of(brdf_);
  return **area_cosines_;
}

void GpuScene::add_emitted(Image& picture, const View& view) {
  if (!has(effects_, Effect::emission)) return;
  if (!emitted_) emitted_ = std::make_shared<EmittedLight>(*this);
  emitted_->add_to(picture, view);
}

void GpuScene::update(const Scene& scene) {
  const auto require = [&](bool same, const char* what) {
    if (same) return;
    throw Error(ErrorKind::usage, scene.source,
                fmt::format("its {} differ from those of the scene that is rendered", what), "set up the scene again");
  };
  require(most_lobes_of(scene.materials) <= facet_lobes_, "lobes");
  SceneContent content;
  for (const GpuBatch& batch : batches_) {
    require(batch.material < scene.materials.size(), "materials");
    const TriangleSoup triangles = collect_triangles(scene, batch.material);
    require(triangles.vertices.size() == batch.vertex_count, "vertices");
    const auto vertices = std::as_bytes(std::span(triangles.vertices));
    const std::vector<glm::vec4> block = material_block(scene.materials[batch.material], effects_);
    batch.vertices.write(vertices);
    batch.material_block.write(std::as_bytes(std::span(block)));
    add_to_hash(content.geometry, vertices);
    add_to_hash(content.materials, std::as_bytes(std::span(block)));
  }
  if (shadow_maps_) {
    shadow_maps_.emplace(*context_, scene, effects_, batches_, samplers_);
    require(shadow_maps_->views().views.size() == light_counts_.shadow_maps, "lights");
  }
  if (visibility_ && content.geometry != content_.geometry) make_visibility(scene, no_progress, nullptr);
  const LightBlocks blocks = blocks_of(scene.lights);
  for (std::size_t i = 0; i < light_types.size(); ++i) {
    const std::span<const glm::vec4> values = blocks.vectors[i];
    require(values.size() == light_types[i].vectors * light_counts_.of[i], "lights");
    if (!values.empty()) light_buffers_[i].write(std::as_bytes(values));
    add_to_hash(content.lights, std::as_bytes(values));
  }
  content_ = content;
}

void GpuScene::bind_lights(const gl::Program& program, const TextureUnits& units, bool area_by_lobes) const {
  PerLightType<std::size_t> counts = light_counts_.of;
  if (area_by_lobes) {
    counts[light_type::area] = light_counts_.area_by_lobes;
    counts[light_type::area_point] = light_counts_.points_alone;
  }
  for (std::size_t i = 0; i < light_types.size(); ++i) {
    const LightType& kind = light_types[i];
    if (!has(effects_, kind.effect)) continue;
    gl::api().BindBufferBase(GL_UNIFORM_BUFFER, kind.binding, light_buffers_[i].name());
    gl::api().ProgramUniform1i(program.name(), program.uniform(kind.counter), static_cast<GLint>(counts[i]));
  }
  if (shadow_maps_) shadow_maps_->bind(units.unit("shadow_maps"));
}

}  // namespace footprint
