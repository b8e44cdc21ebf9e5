// See surface_program.hpp.
#include "renderer/pipeline/surface_program.hpp"

#include <fmt/format.h>

#include <chrono>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr GLuint material_binding = 0;
constexpr GLuint method_binding = 1;

// What the program simulates: what the method honours, and the maps that the pipeline reads itself, whose units come
// first.
EffectSet effects_of(const GpuScene& scene, const Method& method) {
  EffectSet shared;
  shared.set(static_cast<std::size_t>(Effect::base_color_variation));
  shared.set(static_cast<std::size_t>(Effect::metallic_variation));
  shared.set(static_cast<std::size_t>(Effect::specular_variation));
  return scene.effects() & (method.info().honours | shared);
}

// A method whose samples are many, and whose module can, draws directions; one sample a pixel would be all noise.
bool draws_directions(const Method& method, const ProgramSettings& settings) {
  return method.info().draws_directions && settings.sampling != Sampling::frame;
}

ShaderVariant variant_of(const GpuScene& scene, const BakedMethod& baked, const ProgramSettings& settings) {
  return {.effects = effects_of(scene, *baked.method),
          .brdf = scene.brdf(),
          .sampling = settings.sampling,
          .max_probes = settings.max_probes,
          .orthographic = settings.orthographic,
          .shared_coordinates = scene.shared_coordinates(),
          .environment_sampled = draws_directions(*baked.method, settings),
          .point_lights = scene.light_counts().point,
          .spot_lights = scene.light_counts().spot,
          .directional_lights = scene.light_counts().directional};
}

std::vector<float> scalar_block(const Prefiltered& prefiltered) {
  std::vector<float> values;
  for (const auto& [name, value] : prefiltered.scalars) values.push_back(value);
  values.resize((values.size() + 3) / 4 * 4);  // std140 blocks end on 16 bytes
  return values;
}

void bind_texture(GLuint unit, const GpuTexture& texture, GpuScene& scene, Lookup lookup) {
  gl::api().BindTextureUnit(unit, texture.texture.name());
  gl::api().BindSampler(unit, scene.samplers().sampler(texture.coordinates, texture.lookup(lookup)));
}

struct Outcome {
  Prefiltered prefiltered;
  bool from_disk;
};

// One material: from the disk where it is kept there, else by the method, and kept if that is worth it.
Outcome prefilter(const Method& method, const Material& material, const Options& options, const EffectSet& effects,
                  const Progress& progress, const BakeCache* cache) {
  if (cache == nullptr || !method.info().slow_precompute)
    return {method.precompute(material, options, effects, progress), false};
  const std::string key = cache->key(method.info().name, material, options, effects);
  if (std::optional<Prefiltered> kept = cache->find(key)) return {*std::move(kept), true};
  Outcome outcome{method.precompute(material, options, effects, progress), false};
  cache->keep(key, outcome.prefiltered);
  return outcome;
}

}  // namespace

BakedMethod bake(const Method& method, const MethodSpec& spec, const Scene& scene, const EffectSet& effects,
                 const Progress& progress, const BakeCache* cache) {
  const auto start = std::chrono::steady_clock::now();
  const EffectSet honoured = effects & method.info().honours;
  BakedMethod baked{.method = &method,
                    .spec = spec,
                    .options = Options(method.info().options, spec.options, "method " + spec.name),
                    .materials = {},
                    .seconds = 0,
                    .bytes = 0,
                    .texels = 0,
                    .cached = cache != nullptr && method.info().slow_precompute};
  const auto count = static_cast<double>(scene.materials.size());
  for (const Material& material : scene.materials) {
    const auto done = static_cast<double>(baked.materials.size());
    const Progress part = [&](std::string_view what, double fraction) { progress(what, (done + fraction) / count); };
    part(fmt::format("{}: {}", spec.text, material.name), 0.0);
    try {
      auto [prefiltered, from_disk] = prefilter(method, material, baked.options, honoured, part, cache);
      baked.materials.push_back(std::move(prefiltered));
      baked.cached = baked.cached && from_disk;
    } catch (const Error& error) {
      throw error.within(fmt::format("{}, material {}, method {}", scene.source, material.name, spec.text));
    }
    baked.bytes += byte_count(baked.materials.back());
    baked.texels += finest_texels(baked.materials.back());
  }
  baked.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return baked;
}

GpuMethod::GpuMethod(const GpuScene& scene, const BakedMethod& baked)
    : baked_(&baked),
      scene_batches_(scene.batches()),
      build_(baked.method->frame_build({.effects = effects_of(scene, *baked.method), .brdf = scene.brdf()},
                                       baked.options)) {
  for (const GpuBatch& batch : scene.batches()) {
    const Prefiltered& prefiltered = baked.materials.at(batch.material);
    PerBatch part;
    for (const PrefilteredTexture& texture : prefiltered.textures) part.textures.push_back(upload(texture));
    const std::vector<float> scalars = scalar_block(prefiltered);
    if (!scalars.empty()) part.scalars = gl::Buffer(std::as_bytes(std::span(scalars)));
    batches_.push_back(std::move(part));
  }
  build_frame();
}

void GpuMethod::build_frame() const {
  if (!build_) return;
  // Not before what was drawn from the textures, or built into them, is done.
  gl::api().MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  for (std::size_t i = 0; i < batches_.size(); ++i) build_->run(scene_batches_[i], batches_[i].textures);
  gl::api().MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

GLuint GpuMethod::units(const GpuBatch& batch) const {
  return static_cast<GLuint>(batch.shared_textures.size() + baked_->materials.front().textures.size());
}

void GpuMethod::bind(const GpuBatch& batch, GpuScene& scene, Lookup lookup) const {
  const PerBatch& part = batches_.at(static_cast<std::size_t>(&batch - scene_batches_.data()));
  auto unit = static_cast<GLuint>(batch.shared_textures.size());
  for (const GpuTexture& texture : part.textures) bind_texture(unit++, texture, scene, lookup);
  if (part.scalars.name() != 0) gl::api().BindBufferBase(GL_UNIFORM_BUFFER, method_binding, part.scalars.name());
}

SurfaceProgram::SurfaceProgram(GpuScene& scene, const BakedMethod& baked, const ProgramSettings& settings)
    : settings_(settings),
      environment_light_(has(effects_of(scene, *baked.method), Effect::environment_light)),
      environment_sampled_(draws_directions(*baked.method, settings)),
      fragment_text_(fragment_shader(variant_of(scene, baked, settings), baked.method->shader(), baked.spec.name,
                                     baked.options, baked.materials.front())),
      program_(fmt::format("{} (lines below {} are of {}.glsl)", baked.spec.text, first_shared_line, baked.spec.name),
               vertex_shader(variant_of(scene, baked, settings)), fragment_text_) {
  if (environment_light_) scene.environment()->prepare(environment_sampled_);
}

void SurfaceProgram::set_sample(const glm::ivec2& origin, std::uint32_t seed, std::uint32_t pass) const {
  const GLint origin_place = program_.uniform("sample_origin");
  const GLint seed_place = program_.uniform("sample_seed");
  if (origin_place >= 0) gl::api().ProgramUniform2i(program_.name(), origin_place, origin.x, origin.y);
  if (seed_place >= 0) gl::api().ProgramUniform2ui(program_.name(), seed_place, seed, pass);
}

void SurfaceProgram::draw(GpuScene& scene, const GpuMethod& method, const View& view,
                          const glm::mat4& world_to_clip) const {
  gl::api().UseProgram(program_.name());
  gl::api().UniformMatrix4fv(program_.uniform("world_to_clip"), 1, GL_FALSE, glm::value_ptr(world_to_clip));
  const glm::vec3 camera = settings_.orthographic ? direction_to_camera(view.camera) : camera_position(view.camera);
  const char* const camera_name = settings_.orthographic ? "to_camera" : "camera_position";
  gl::api().Uniform3fv(program_.uniform(camera_name), 1, glm::value_ptr(camera));
  scene.bind_lights(program_);
  gl::api().Enable(GL_DEPTH_TEST);
  gl::api().DepthFunc(GL_LESS);
  for (const GpuBatch& batch : scene.batches()) {
    if (batch.double_sided) {
      gl::api().Disable(GL_CULL_FACE);
    } else {
      gl::api().Enable(GL_CULL_FACE);
    }
    gl::api().BindBufferBase(GL_UNIFORM_BUFFER, material_binding, batch.material_block.name());
    GLuint unit = 0;
    for (const GpuTexture& texture : batch.shared_textures) bind_texture(unit++, texture, scene, settings_.lookup);
    method.bind(batch, scene, settings_.lookup);
    if (environment_light_) scene.environment()->bind(method.units(batch), environment_sampled_);
    gl::api().BindVertexArray(batch.vertex_array.name());
    gl::api().DrawElements(GL_TRIANGLES, batch.index_count, GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace footprint
