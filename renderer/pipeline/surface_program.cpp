// Uploads bakes, runs frame builds, and draws. Restores the GL state that a frame build may change.
#include "renderer/pipeline/surface_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>
#include <span>

#include "renderer/bake/material_maps.hpp"
#include "renderer/core/error.hpp"
#include "renderer/pipeline/emitted_light.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/sample_sequence.hpp"
#include "renderer/pipeline/shader_contract.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {
namespace {

bool has_patches(const EffectSet& effects) { return has(effects, Effect::microgeometry_visibility); }

bool draws_emitted_light(const Method& method) { return &method == &emitted_surface(); }

// The effects of a program: those that the method honours, the maps that the pipeline reads itself, vertex colours,
// clear coats, unlit and emitting surfaces, and visibility, which is the same for all methods.
EffectSet effects_of(const GpuScene& scene, const Method& method) {
  EffectSet shared;
  for (const SharedMap& map : shared_maps()) shared.set(static_cast<std::size_t>(map.effect));
  shared.set(static_cast<std::size_t>(Effect::vertex_color));
  shared.set(static_cast<std::size_t>(Effect::clear_coat));
  shared.set(static_cast<std::size_t>(Effect::unlit));
  shared.set(static_cast<std::size_t>(Effect::emission));
  shared.set(static_cast<std::size_t>(Effect::cast_shadow), !draws_emitted_light(method));
  return scene.effects() & (method.info.honours | shared);
}

// What scene and method decide about a program. A method whose samples are many, and whose module can, integrates
// itself; drawn for one sample per pixel, directions would be all noise. Directional lights serve every module. Other
// modules list their lobes for area lights if they honour environments; patches of facets and sums over texels list
// none.
ShaderVariant variant_of(const GpuScene& scene, const BakedMethod& baked, ShaderVariant v) {
  const MethodInfo& info = baked.method->info;
  const bool is_frame = v.sampling == Sampling::frame;
  const bool integrates_itself = info.draws_directions && !is_frame;
  const bool lists_lobes = !integrates_itself && has(info.honours, Effect::environment_light) &&
                           !info.sums_environment && !has(scene.effects(), Effect::clear_coat) &&
                           !has_patches(scene.effects());
  const GpuScene::LightCounts& lights = scene.light_counts();
  v.effects = effects_of(scene, *baked.method);
  v.brdf = scene.brdf();
  v.horizon_open = scene.horizon() == Horizon::open;
  v.shared_coordinates = scene.shared_coordinates();
  v.surface_coordinates = baked.materials.front().surface_coordinates.has_value();
  v.screen_derivatives = info.screen_derivatives && is_frame;
  v.emitting = draws_emitted_light(*baked.method);
  v.finest_maps = info.reads_finest_level && is_frame;
  if (v.environment == EnvironmentUse::sampled && !integrates_itself) v.environment = EnvironmentUse::prefiltered;
  v.sums_environment = info.sums_environment;
  v.environment_suns = scene.environment() != nullptr ? scene.environment()->sun_count() : 0;
  v.facet_lobes = scene.facet_lobes();
  v.lights = lights.of;
  v.area_sampled = integrates_itself && lights.of[light_type::area] > 0;
  v.area_lobes = lists_lobes && lights.area_by_lobes > 0;
  if (integrates_itself) v.lights[light_type::area_point] = 0;
  if (v.area_lobes) v.lights[light_type::area_point] = lights.points_alone;
  v.shadow_maps = lights.shadow_maps;
  return v;
}

SamplerState sampler_state_of(const ShaderVariant& variant, const gl::ContextInfo& context) {
  if (variant.sampling == Sampling::frame) return frame_sampler_state(variant.footprint, context);
  return variant.sampling == Sampling::bilinear ? SamplerState::trilinear : SamplerState::nearest;
}

// The method's block in std140: floats next to each other, up to 16 bytes, then vectors 16 bytes apart.
std::vector<float> block_values(const Prefiltered& prefiltered) {
  std::vector<float> block;
  for (const auto& [name, value] : prefiltered.scalars) block.push_back(value);
  block.resize((block.size() + 3) / 4 * 4);
  for (const auto& [name, values] : prefiltered.vectors) {
    for (const glm::vec2& v : values) block.insert(block.end(), {v.x, v.y, 0.0F, 0.0F});
  }
  return block;
}

void bind_texture(GLuint unit, const GpuTexture& texture, GpuScene& scene, SamplerState state) {
  gl::bind_texture(unit, *texture.texture, scene.samplers().sampler(texture.coordinates, texture.sampler_state(state)));
}

// Directions of each kind that a sample draws from an environment, its texels together: powers of two.
// docs/reference/metrics.md has what they are worth. One that sums over a patch's facets costs far more.
constexpr std::uint32_t directions_per_sample = 16;
constexpr std::uint32_t directions_of_a_patch = 2;
constexpr std::uint32_t directions_to_areas = 4;  // without an environment: light comes from fewer directions

// Restores the GL state that a frame build may change and a draw does not set.
class StateGuard {
 public:
  StateGuard() {
    gl::api().GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
    gl::api().GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    gl::api().GetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
    gl::api().GetIntegerv(GL_VIEWPORT, viewport_.data());
    std::ranges::transform(switches, on_.begin(), [](GLenum name) { return gl::api().IsEnabled(name) == GL_TRUE; });
  }
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;
  ~StateGuard() {
    gl::api().BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
    gl::api().BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
    gl::api().BindVertexArray(static_cast<GLuint>(vertex_array_));
    gl::api().Viewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    for (std::size_t i = 0; i < switches.size(); ++i) {
      if (on_.at(i)) {
        gl::api().Enable(switches.at(i));
      } else {
        gl::api().Disable(switches.at(i));
      }
    }
  }

 private:
  static constexpr std::array<GLenum, 3> switches{GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND};
  GLint draw_ = 0, read_ = 0, vertex_array_ = 0;
  std::array<GLint, 4> viewport_{};
  std::array<bool, switches.size()> on_{};
};

// The triangles of a further material of a surface are those of the first, drawn by the same program: they meet its
// depths exactly, and add their share.
void set_state(const GpuBatch& batch) {
  const auto set = [](GLenum name, bool on) { on ? gl::api().Enable(name) : gl::api().Disable(name); };
  set(GL_CULL_FACE, !batch.double_sided);
  set(GL_BLEND, batch.adds);
  gl::api().BlendFunc(GL_ONE, GL_ONE);
  gl::api().DepthFunc(batch.adds ? GL_EQUAL : GL_GREATER);
}

bool waits(const Prefiltered& prefiltered) {
  return std::ranges::any_of(prefiltered.textures, &PrefilteredTexture::built);
}

void take(std::span<const GpuTexture> from, Prefiltered& into) {
  if (from.empty()) into.textures.clear();
  for (std::size_t i = 0; i < into.textures.size(); ++i) {
    if (into.textures[i].built) read_texels(*from[i].texture, into.textures[i]);
  }
}

// The numbers in the sequences of the points of a pixel: one per cell of the grid, or per draw of a frame.
std::vector<std::uint32_t> points_of(const SampleDraw& samples) {
  std::vector<std::uint32_t> points;
  for (int i = 0; i < samples.draws; ++i) {
    for (int cell = 0; cell < samples.grid * samples.grid; ++cell)
      points.push_back(samples.first + static_cast<std::uint32_t>(i) +
                       sample_in_cell(samples.grid, {cell % samples.grid, cell / samples.grid}));
  }
  return points;
}

}  // namespace

SamplerState frame_sampler_state(const FootprintFilter& filter, const gl::ContextInfo& context) {
  if (filter.kind != FootprintFilterKind::hardware) return SamplerState::trilinear;
  if (filter.count > context.max_anisotropy) {
    throw Error(ErrorKind::machine, footprint_filter_text(filter),
                context.max_anisotropy > 1
                    ? fmt::format("this OpenGL's samplers have {} probes", context.max_anisotropy)
                    : "this OpenGL has no anisotropic samplers",
                fmt::format("take anisotropic:{}, whose probes are in the shader", filter.count));
  }
  return {.linear = true, .max_anisotropy = filter.count};
}

GpuMethod::GpuMethod(const GpuScene& scene, const BakedMethod& baked) : baked_(&baked), scene_(&scene) {
  if (baked.given_by.empty())
    build_ = baked.method->frame_build(
        {.effects = effects_of(scene, *baked.method), .brdf = scene.brdf(), .facet_lobes = scene.facet_lobes()},
        baked.options);
  batches_.resize(scene.batches().size());
  for (std::size_t i = 0; i < baked.materials.size(); ++i) upload_material(i);
}

void GpuMethod::upload_material(std::size_t material, const TextureUploaded& uploaded) {
  const Prefiltered& prefiltered = baked_->materials.at(material);
  for (const GpuBatch& batch : scene_->batches()) {
    if (batch.material != material) continue;
    PerBatch& part = batches_.at(batch.index);
    for (std::size_t i = 0; i < prefiltered.textures.size(); ++i) {
      part.textures.push_back(uploads_.upload(prefiltered.textures[i]));
      uploaded(i);
    }
    const std::vector<float> block = block_values(prefiltered);
    if (!block.empty()) part.block = gl::Buffer(std::as_bytes(std::span(block)));
    if (prefiltered.surface_coordinates) {
      part.surface_coordinates = gl::Buffer(std::as_bytes(std::span(*prefiltered.surface_coordinates)));
      part.vertex_array = footprint::vertex_array(batch.vertices, batch.indices, &part.surface_coordinates);
      if (batch.visibility.name() != 0) add_visibility(part.vertex_array, batch.visibility);
    }
  }
}

std::span<const GpuTexture> GpuMethod::textures(std::size_t material) const {
  const std::vector<GpuBatch>& batches = scene_->batches();
  const auto found = std::ranges::find(batches, material, &GpuBatch::material);
  if (found == batches.end()) return {};
  return batches_.at(found->index).textures;
}

GLuint GpuMethod::vertex_array(const GpuBatch& batch) const {
  const gl::VertexArray& own = batches_.at(batch.index).vertex_array;
  return own ? own.name() : batch.vertex_array.name();
}

glm::ivec2 GpuMethod::texels(const GpuBatch& batch) const {
  glm::ivec2 largest(1);
  const auto look_at = [&](const GpuTexture& map) {
    const glm::ivec2 size(map.texture->width(), map.texture->height());
    const bool is_map = map.filter != TextureFilter::linear && same_uv(map.coordinates, batch.coordinates);
    if (is_map && size.x * size.y > largest.x * largest.y) largest = size;
  };
  for (std::size_t i = 0; const SharedMap& map : shared_maps()) {
    if (!has(scene_->effects(), map.effect)) continue;
    const GpuTexture& texture = batch.shared_textures.at(i++);
    if (map.effect != Effect::emission_variation) look_at(texture);  // only emitted_light.hpp reads that one
  }
  for (const GpuTexture& map : batches_.at(batch.index).textures) look_at(map);
  return largest;
}

bool GpuMethod::is_built_for(const View& view) const {
  const std::optional<BuildInputs> inputs = build_->valid_until_change_of();
  if (!inputs || !built_) return false;
  const SceneContent& then = built_->content;
  const SceneContent& now = scene_->content();
  return (!inputs->camera || built_->camera == view.camera) && (!inputs->geometry || then.geometry == now.geometry) &&
         (!inputs->materials || then.materials == now.materials) && (!inputs->lights || then.lights == now.lights);
}

void GpuMethod::build_frame(const View& view) const {
  if (build_ && !is_built_for(view)) rebuild(view);
}

RecordedDraws GpuMethod::draws_per_frame(const View& view) const {
  RecordedDraws draws;
  if (build_ && !reuses_build()) rebuild(view, &draws);
  return draws;
}

void GpuMethod::rebuild(const View& view, RecordedDraws* record) const {
  if (!build_) return;
  const StateGuard state;
  // Waits for draws that read the textures, and for earlier builds.
  gl::api().MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  for (const GpuBatch& batch : scene_->batches()) {
    build_->run({.batch = batch,
                 .vertex_array = vertex_array(batch),
                 .baked = baked_->materials.at(batch.material),
                 .textures = batches_.at(batch.index).textures,
                 .view = view,
                 .record = record});
  }
  gl::api().MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  built_ = {.camera = view.camera, .content = scene_->content()};
}

void GpuMethod::bind(const GpuBatch& batch, GpuScene& scene, SamplerState state) const {
  const PerBatch& part = batches_.at(batch.index);
  GLuint unit = 0;
  for (const GpuTexture& texture : batch.shared_textures) bind_texture(unit++, texture, scene, state);
  for (const GpuTexture& texture : part.textures) bind_texture(unit++, texture, scene, state);
  if (part.block.name() != 0) gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::method, part.block.name());
}

std::optional<DriverWatch> watch_over(const BakedMethod& baked, std::string_view work, int factor) {
  if (baked.method->file_content.empty()) return {};
  return std::optional<DriverWatch>(std::in_place, factor * file_method_limit, std::string(baked.method->shader.file),
                                    std::string(work));
}

gl::Program method_program(const BakedMethod& baked, std::string_view name, std::string_view vertex,
                           const ShaderText& fragment) {
  require_definitions(fragment, baked.method->shader.file);
  const std::optional<DriverWatch> watch = watch_over(baked, "compile");
  try {
    return {fmt::format("{} ({})", name, fragment.lines()), vertex, fragment.text()};
  } catch (const Error& error) {
    if (!baked.given_by.empty())
      throw Error(ErrorKind::usage, baked.given_by, "its maps do not fit the method's module: " + error.message(),
                  "bake again; a manifest that was changed must keep the names of textures and uniforms");
    if (!watch) throw;
    const int line = gl::smallest_line_in(error.message());
    const std::string_view file = baked.method->shader.file;
    throw Error(
        ErrorKind::usage, line > 0 && line < first_shared_line ? fmt::format("{}:{}", file, line) : std::string(file),
        error.message(), "docs/guides/method-files.md has the inputs for `reads` and the functions of a module");
  }
}

ForwardProgram forward_program(const GpuScene& scene, const BakedMethod& baked, ShaderVariant wanted) {
  const ShaderVariant variant = variant_of(scene, baked, wanted);
  TextureUnits units = forward_units(variant, baked.materials.front());
  units.require_room(scene.context(), baked.spec.text);
  ForwardShaders shaders =
      forward_shaders(variant, units, baked.method->shader, baked.options, baked.materials.front());
  return {.variant = variant, .units = std::move(units), .shaders = std::move(shaders)};
}

SurfaceProgram::SurfaceProgram(GpuScene& scene, const BakedMethod& baked, const ShaderVariant& wanted)
    : forward_(forward_program(scene, baked, wanted)),
      sampler_state_(sampler_state_of(forward_.variant, scene.context())),
      scene_effects_(scene.effects()),
      program_(method_program(baked, baked.spec.text, forward_.shaders.vertex, forward_.shaders.fragment)) {
  const ShaderVariant& variant = forward_.variant;
  forward_.units.require_all_of(program_, baked.spec.text);
  if (variant.area_lobes) (void)scene.area_cosines();
  if (has(variant.effects, Effect::environment_light)) scene.environment()->prepare(variant.environment);
}

void SurfaceProgram::set_samples(const SampleDraw& samples) const {
  const std::vector<std::uint32_t> points = points_of(samples);
  const GLuint name = program_.name();
  gl::api().ProgramUniform2i(name, program_.uniform("sample_origin"), samples.origin.x, samples.origin.y);
  gl::api().ProgramUniform1i(name, program_.uniform("sample_grid"), samples.grid);
  gl::api().ProgramUniform1ui(name, program_.uniform("sample_seed"), samples.seed);
  const auto set_pair = [&](const char* uniform, SamplePair pair) {
    std::vector<glm::uvec2> digits;
    for (const std::uint32_t point : points) digits.push_back(sample_digits(pair, point));
    gl::api().ProgramUniform2uiv(name, program_.uniform(uniform), static_cast<GLsizei>(digits.size()),
                                 glm::value_ptr(digits.front()));
  };
  set_pair("sample_texels", SamplePair::texel);
  set_pair("draw_places", SamplePair::pixel);
  set_pair("draw_levels", SamplePair::choice);
  if (program_.uniform("directions_per_sample") >= 0) set_directions(points);
}

// Sample i takes the directions of the points n i to n i + n - 1, n a power of two: an aligned block, whose digits are
// its first one's with those of the points 0 to n - 1 added without carry.
void SurfaceProgram::set_directions(std::vector<std::uint32_t> points) const {
  const bool surrounded = has(scene_effects_, Effect::environment_light);
  const std::uint32_t count = has_patches(scene_effects_) ? directions_of_a_patch
                              : surrounded                ? directions_per_sample
                                                          : directions_to_areas;
  for (std::uint32_t& point : points) point *= count;
  std::vector<std::uint32_t> steps(count);
  std::iota(steps.begin(), steps.end(), 0U);
  set_digits("cell_directions", "cell_choices", points);
  set_digits("direction_steps", "choice_steps", steps);
  gl::api().ProgramUniform1i(program_.name(), program_.uniform("directions_per_sample"), static_cast<GLint>(count));
}

// The digits of the points `indices`.
void SurfaceProgram::set_digits(const char* directions, const char* choices,
                                std::span<const std::uint32_t> indices) const {
  std::vector<glm::uvec4> pairs;
  std::vector<std::uint32_t> single;
  for (const std::uint32_t i : indices) {
    pairs.emplace_back(sample_digits(SamplePair::light, i), sample_digits(SamplePair::lobe, i));
    single.push_back(sample_digits(SamplePair::choice, i).x);
  }
  const GLuint name = program_.name();
  const auto size = static_cast<GLsizei>(indices.size());
  gl::api().ProgramUniform4uiv(name, program_.uniform(directions), size, glm::value_ptr(pairs.front()));
  gl::api().ProgramUniform1uiv(name, program_.uniform(choices), size, single.data());
}

// The size of the map whose texels a sample of this batch separates, and how many it shades.
glm::vec3 SurfaceProgram::drawn_texels(const GpuMethod& method, const GpuBatch& batch, TexelUse texels) const {
  const glm::ivec2 size = method.texels(batch);
  const bool one = texels == TexelUse::drawn || has(scene_effects_, Effect::alpha_mask) ||
                   has_patches(scene_effects_) || size == glm::ivec2(1);
  return {size, one ? 1.0F : 4.0F};
}

// The first draw of a method from a file is waited for, within its limit.
void SurfaceProgram::draw(GpuScene& scene, const GpuMethod& method, const View& view, const glm::mat4& world_to_clip,
                          const SampleDraw& samples) const {
  std::optional<DriverWatch> watch;
  if (!has_drawn_) {
    constexpr int most_lights = 100;  // a factor for an environment as directional lights
    std::array<GLint, 4> viewport{};
    gl::api().GetIntegerv(GL_VIEWPORT, viewport.data());
    const int factor = forward_.variant.environment == EnvironmentUse::dense ? most_lights : 1;
    watch = watch_over(method.baked(), "draw its first frame", factor * (1 + viewport[2] * viewport[3] / (1 << 20)));
  }
  draw_batches(scene, method, view, world_to_clip, samples);
  if (watch) gl::api().Finish();
  has_drawn_ = true;
}

void SurfaceProgram::draw_batches(GpuScene& scene, const GpuMethod& method, const View& view,
                                  const glm::mat4& world_to_clip, const SampleDraw& samples) const {
  const ShaderVariant& variant = forward_.variant;
  const TextureUnits& units = forward_.units;
  const bool environment_light = has(variant.effects, Effect::environment_light);
  if (variant.sampling != Sampling::frame || is_stochastic(variant.footprint)) set_samples(samples);
  gl::api().UseProgram(program_.name());
  gl::api().UniformMatrix4fv(program_.uniform("world_to_clip"), 1, GL_FALSE, glm::value_ptr(world_to_clip));
  const glm::vec3 camera = variant.orthographic ? direction_to_camera(view.camera) : camera_position(view.camera);
  const char* const camera_name = variant.orthographic ? "to_camera" : "camera_position";
  gl::api().Uniform3fv(program_.uniform(camera_name), 1, glm::value_ptr(camera));
  const GLint to_camera_space = program_.uniform("world_to_camera");
  if (to_camera_space >= 0) {
    const glm::mat3 rotation = world_to_camera(view.camera);
    gl::api().UniformMatrix3fv(to_camera_space, 1, GL_FALSE, glm::value_ptr(rotation));
  }
  if (!variant.emitting) scene.bind_lights(program_, units, variant.area_lobes);  // light that is emitted meets none
  if (variant.area_lobes) scene.area_cosines().bind(units.unit("area_cosines"));
  if (environment_light && scene.visibility()) scene.visibility()->bind(units.unit("visibility_maps"));
  const GLint texels_location = program_.uniform("drawn_texels");
  gl::api().Enable(GL_DEPTH_TEST);
  for (const GpuBatch& batch : scene.batches()) {
    set_state(batch);
    if (texels_location >= 0)
      gl::api().Uniform3fv(texels_location, 1, glm::value_ptr(drawn_texels(method, batch, samples.texels)));
    gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::material, batch.material_block.name());
    method.bind(batch, scene, sampler_state_);
    if (environment_light) scene.environment()->bind(units, variant.environment);
    gl::api().BindVertexArray(method.vertex_array(batch));
    gl::api().DrawElements(GL_TRIANGLES, batch.index_count, GL_UNSIGNED_INT, nullptr);
  }
  gl::api().Disable(GL_BLEND);
}

std::map<int, ReadTexture> SurfaceProgram::bound_textures() const {
  std::map<int, ReadTexture> bound;
  for (GLuint unit = 0; unit < forward_.units.size(); ++unit) {
    const TextureUnits::Texture& texture = forward_.units.textures()[unit];
    bound[static_cast<int>(unit)] = bound_texture(texture.name, unit, texture.sampler != "sampler2D");
  }
  return bound;
}

bool waits_for_build(const BakedMethod& baked) { return std::ranges::any_of(baked.materials, waits); }

void take_built_maps(const gl::Context& context, const Scene& scene, const EffectSet& effects, BakedMethod& baked) {
  GpuScene gpu_scene(context.info(), scene, effects);
  const GpuMethod gpu(gpu_scene, baked);
  if (gpu.looks_from_view()) {
    throw Error(ErrorKind::usage, fmt::format("method {}", baked.spec.text),
                "builds its maps for each view, so they cannot be written to files",
                "take options whose maps serve every view, or another method");
  }
  gpu.rebuild({.size = glm::ivec2(1), .camera = scene.camera});
  for (std::size_t i = 0; i < baked.materials.size(); ++i) take(gpu.textures(i), baked.materials[i]);
  context.check("reading what a frame build wrote");
}

}  // namespace footprint
