// Draws the geometry of every sample, then reduces it to one value per pixel. Shadowed lights take further passes, four
// lights at a time.
#include "renderer/pipeline/interior.hpp"

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

#include "renderer/bake/material_maps.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/scene/charts.hpp"
#include "renderer/scene/geometry.hpp"

namespace footprint {
namespace {

constexpr int default_tile_edge = 256;  // 16 samples per pixel of 68 bytes each, twice
constexpr int most_interior_samples = 256;
constexpr std::size_t lights_at_once = 4;
constexpr GLuint first_unit = 4;         // of the first pass, in interior_compare.glsl
constexpr float rounding_share = 4e-6F;  // of a few 32-bit operations on a coordinate, relative to it
constexpr std::array<GLenum, 5> piece_formats{GL_RGBA32F, GL_RGBA32F, GL_RGBA32F, GL_RGBA32F, GL_R32F};
constexpr GLuint material_attachment = 4;
constexpr std::array<float, 4> undecided{1.0F, 3e38F, 3e38F, 3e38F};  // before the least over all passes is taken
constexpr std::array<GLenum, 1> one_format{GL_RGBA32F};

// The reference's passes, at most the first of its first sequence.
SampleGrid samples_of_reference(int spp, std::uint64_t seed) {
  SampleGrid samples = sample_grid(spp, seed);
  const auto most_passes = static_cast<std::size_t>(most_interior_samples / (samples.grid * samples.grid));
  if (samples.passes.size() > most_passes) samples.passes.resize(most_passes);
  return samples;
}

ShaderVariant variant_of(const GpuScene& scene, bool orthographic, bool shadows) {
  EffectSet effects = scene.effects();
  effects.set(static_cast<std::size_t>(Effect::cast_shadow), shadows);
  PerLightType<std::size_t> lights = scene.light_counts().of;
  lights[light_type::area_point] = 0;
  return {.effects = effects,
          .brdf = scene.brdf(),
          .orthographic = orthographic,
          .horizon_open = scene.horizon() == Horizon::open,
          .facet_lobes = scene.facet_lobes(),
          .lights = lights,
          .shadow_maps = scene.light_counts().shadow_maps};
}

// The effects of the shared maps that are read: alpha of the base colour, and shares of a surface's materials.
EffectSet maps_read(const EffectSet& effects, bool shadows) {
  EffectSet read;
  const auto read_if = [&](Effect effect, bool is_read) {
    read.set(static_cast<std::size_t>(effect), is_read && has(effects, effect));
  };
  read_if(Effect::base_color_variation, has(effects, Effect::alpha_mask));
  read_if(Effect::material_index, !shadows);
  return read;
}

TextureUnits units_of(const GpuScene& scene, bool shadows) {
  TextureUnits units(maps_read(scene.effects(), shadows), {});
  if (shadows) units.add("shadow_maps", "sampler2DArrayShadow");
  return units;
}

glm::vec2 map_size_of(const Material& material) {
  if (!material.normal_map) return glm::vec2(0.0F);
  return {material.normal_map->image.width(), material.normal_map->image.height()};
}

void bind_textures(const gl::RenderTarget& target, std::size_t count, GLuint unit) {
  for (std::size_t i = 0; i < count; ++i) gl::bind_texture(unit + static_cast<GLuint>(i), target.color(i));
}

// Splits the result into its images.
void copy_tile(const Image& read, const Tile& tile, Interior& out) {
  for (int y = 0; y < tile.size.y; ++y) {
    const int row = out.mask.height - 1 - (tile.origin.y + y);
    for (int x = tile.origin.x; x < tile.origin.x + tile.size.x; ++x) {
      out.mask.at(x, row)[0] = read.at(x, row)[0];
      out.materials.at(x, row)[0] = read.at(x, row)[1];
      out.texels.at(x, row)[0] = read.at(x, row)[3];
    }
  }
}

}  // namespace

InteriorFinder::InteriorFinder(GpuScene& scene, const Scene& values, int tile_edge, const InteriorCriteria& criteria)
    : scene_(&scene),
      criteria_(criteria),
      tile_edge_(std::min(tile_edge > 0 ? tile_edge : default_tile_edge, scene.context().max_framebuffer_size / 4)),
      orthographic_(values.camera.orthographic),
      far_corner_(glm::length(glm::max(glm::abs(values.bounds.lower), glm::abs(values.bounds.upper)))),
      geometry_(make_passes(false)) {
  if (scene.shadow_maps() && criteria.shadows) shadows_ = make_passes(true);
  add_parts(values);
}

InteriorFinder::SamplePasses InteriorFinder::make_passes(bool shadows) const {
  SamplePasses passes{.shadows = shadows,
                      .formats = piece_formats,
                      .draw = {},
                      .compare = {},
                      .units = units_of(*scene_, shadows),
                      .first = {},
                      .other = {}};
  if (shadows) passes.formats = one_format;
  const ShaderVariant variant = variant_of(*scene_, orthographic_, shadows);
  passes.draw = gl::Program(shadows ? "shadow edges" : "interior pixels",
                            shared_stage("interior_vertex.glsl", shader_flags(variant)),
                            interior_fragment_shader(variant, passes.units.declarations()));
  passes.compare = gl::Program("comparison of samples", screen_vertex_shader(),
                               shared_stage("interior_compare.glsl", shader_flags(variant)));
  return passes;
}

void InteriorFinder::add_parts(const Scene& values) {
  for (const GpuBatch& batch : scene_->batches()) {
    const auto [vertices, indices] = collect_triangles(values, batch.material);
    const Charts charts = charts_of(vertices, indices, values.materials[batch.material]);
    std::vector<glm::vec2> numbers;  // exact in 32 bits up to 16 million
    for (const std::uint32_t chart : charts.of_vertex) numbers.emplace_back(chart + 1, batch.material + 1);
    Part part{.batch = &batch,
              .charts = gl::Buffer(std::as_bytes(std::span(numbers))),
              .vertex_array = {},
              .map_size = map_size_of(values.materials[batch.material])};
    part.vertex_array = footprint::vertex_array(batch.vertices, batch.indices, &part.charts);
    parts_.push_back(std::move(part));
  }
}

void InteriorFinder::draw(const SamplePasses& passes, const gl::RenderTarget& target, const View& view,
                          const Tile& tile, const SampleGrid& samples, std::size_t pass) const {
  constexpr std::array<float, 4> nothing{};
  const auto uniform = [&](const char* name) { return passes.draw.uniform(name); };
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  gl::api().Viewport(0, 0, tile.size.x * samples.grid, tile.size.y * samples.grid);
  clear_target();
  for (GLint i = 1; i < static_cast<GLint>(passes.formats.size()); ++i)
    gl::api().ClearBufferfv(GL_COLOR, i, nothing.data());
  gl::api().UseProgram(passes.draw.name());
  const glm::mat4 matrix = tile_matrix(view, tile, samples.passes[pass].offset / static_cast<double>(samples.grid));
  gl::api().UniformMatrix4fv(uniform("world_to_clip"), 1, GL_FALSE, glm::value_ptr(matrix));
  const glm::vec3 camera = orthographic_ ? direction_to_camera(view.camera) : camera_position(view.camera);
  gl::api().Uniform3fv(uniform(orthographic_ ? "to_camera" : "camera_position"), 1, glm::value_ptr(camera));
  gl::api().Uniform1f(uniform("grid"), static_cast<float>(samples.grid));
  const glm::vec2 to_centre(glm::dvec2(0.5 * (samples.grid - 1)) - samples.passes[pass].offset);
  gl::api().Uniform2fv(uniform("to_centre"), 1, glm::value_ptr(to_centre));
  if (passes.shadows) scene_->bind_lights(passes.draw, passes.units);
  const EffectSet maps = maps_read(scene_->effects(), passes.shadows);
  gl::api().Enable(GL_DEPTH_TEST);
  gl::api().Disable(GL_BLEND);
  for (const Part& part : parts_) {
    if (part.batch->adds && passes.shadows) continue;
    // Further materials of a surface have the triangles of the first: they meet its depths, and only write their
    // number.
    gl::api().DepthFunc(part.batch->adds ? GL_EQUAL : GL_GREATER);
    const GLboolean writes_all = part.batch->adds ? GL_FALSE : GL_TRUE;
    for (GLuint i = 0; i < material_attachment; ++i)
      gl::api().ColorMaski(i, writes_all, writes_all, writes_all, writes_all);
    part.batch->double_sided ? gl::api().Disable(GL_CULL_FACE) : gl::api().Enable(GL_CULL_FACE);
    gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::material, part.batch->material_block.name());
    gl::api().Uniform2fv(uniform("map_size"), 1, glm::value_ptr(part.map_size));
    for (std::size_t i = 0; const SharedMap& map : shared_maps()) {
      if (!has(scene_->effects(), map.effect)) continue;
      const GpuTexture& texture = part.batch->shared_textures.at(i++);
      if (!has(maps, map.effect)) continue;
      gl::bind_texture(passes.units.unit(map.name), *texture.texture,
                       scene_->samplers().sampler(texture.coordinates, SamplerState::trilinear));
    }
    gl::api().BindVertexArray(part.vertex_array.name());
    gl::api().DrawElements(GL_TRIANGLES, part.batch->index_count, GL_UNSIGNED_INT, nullptr);
  }
  gl::api().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void InteriorFinder::compare(const SamplePasses& passes, const gl::RenderTarget& drawn, const View& view,
                             const Tile& tile, int grid) const {
  const auto uniform = [&](const char* name) { return passes.compare.uniform(name); };
  const std::size_t textures = passes.formats.size();
  gl::api().UseProgram(passes.compare.name());
  gl::api().Uniform1i(uniform("grid"), grid);
  gl::api().Uniform1f(uniform("rounding"), rounding_share * (far_corner_ + glm::length(camera_position(view.camera))));
  gl::api().Uniform1i(uniform("by_coverage"), criteria_.coverage ? 1 : 0);
  gl::api().Uniform1i(uniform("by_material"), criteria_.materials ? 1 : 0);
  gl::api().Uniform1i(uniform("by_chart"), criteria_.charts ? 1 : 0);
  gl::api().Uniform1i(uniform("by_cut"), criteria_.cuts ? 1 : 0);
  gl::api().Uniform1i(uniform("by_normal"), criteria_.normals ? 1 : 0);
  gl::api().Uniform1i(uniform("by_depth"), criteria_.depth ? 1 : 0);
  bind_textures(drawn, std::min<std::size_t>(textures, first_unit), 0);
  bind_textures(passes.first, textures, first_unit);
  gl::api().Enable(GL_BLEND);
  gl::api().BlendEquation(GL_MIN);
  triangle_.draw_into(result_, tile.size.x, tile.size.y);
  gl::api().BlendEquation(GL_FUNC_ADD);
  gl::api().Disable(GL_BLEND);
}

void InteriorFinder::draw_passes(const SamplePasses& passes, const View& view, const Tile& tile,
                                 const SampleGrid& samples) const {
  for (std::size_t pass = 0; pass < samples.passes.size(); ++pass) {
    const gl::RenderTarget& target = pass == 0 ? passes.first : passes.other;
    draw(passes, target, view, tile, samples, pass);
    compare(passes, target, view, tile, samples.grid);
  }
}

Interior InteriorFinder::render(const View& view, const Tile& part, int spp, std::uint64_t seed,
                                const Progress& progress) const {
  const Image nothing(view.size.x, view.size.y, 1);
  Interior out{.mask = nothing, .texels = nothing, .materials = nothing};
  const SampleGrid samples = samples_of_reference(spp, seed);
  const std::vector<Tile> tiles = tiles_in(part, tile_edge_);
  if (tiles.empty()) return out;
  const glm::ivec2 largest = tiles.front().size;
  const PerLightType<std::size_t>& counts = scene_->light_counts().of;
  const std::size_t lights = shadows_ ? std::reduce(counts.begin(), counts.begin() + light_type::area_point) : 0;
  const auto make_room = [&](SamplePasses& passes) {
    fit(passes.first, largest * samples.grid, passes.formats, true);
    fit(passes.other, largest * samples.grid, passes.formats, true);
  };
  make_room(geometry_);
  if (shadows_) make_room(*shadows_);
  fit(result_, largest, one_format, false);
  Image read(view.size.x, view.size.y, 4);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    progress("interior pixels", static_cast<double>(i) / static_cast<double>(tiles.size()));
    gl::api().BindFramebuffer(GL_FRAMEBUFFER, result_.framebuffer());
    gl::api().ClearBufferfv(GL_COLOR, 0, undecided.data());
    draw_passes(geometry_, view, tiles[i], samples);
    for (std::size_t light = 0; light < lights; light += lights_at_once) {
      gl::api().ProgramUniform1i(shadows_->draw.name(), shadows_->draw.uniform("first_light"),
                                 static_cast<GLint>(light));
      draw_passes(*shadows_, view, tiles[i], samples);
    }
    read_tile(result_, 0, tiles[i], read);
    copy_tile(read, tiles[i], out);
  }
  return out;
}

std::vector<Image> material_masks(const Image& materials, const Image& pixels, std::size_t count) {
  std::vector<Image> masks(count, Image(pixels.width, pixels.height, 1));
  for (std::size_t i = 0; i < pixels.texels.size(); ++i) {
    const auto number = static_cast<std::size_t>(materials.texels[i]);
    if (pixels.texels[i] > 0.0F && number > 0) masks.at(number - 1).texels[i] = 1.0F;
  }
  return masks;
}

}  // namespace footprint
