// Draws the module of a method over a square of directions instead of a frame.
#include "renderer/ndf/method_ndf.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/bake/material_maps.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/scene/geometry.hpp"

namespace footprint {
namespace {

constexpr int largest_edge = 1024;  // of the square of directions per draw
constexpr std::array<GLenum, 1> density_format{GL_R32F};

ShaderVariant variant_of(const GpuScene& scene, const BakedMethod& baked, const FootprintFilter& filter) {
  ShaderVariant variant;
  variant.effects = scene.effects() & baked.method->info.honours;
  variant.brdf = scene.brdf();
  variant.footprint = filter;
  variant.facet_lobes = scene.facet_lobes();
  variant.finest_maps = baked.method->info.reads_finest_level;
  variant.surface_coordinates = baked.materials.front().surface_coordinates.has_value();
  return variant;
}

gl::Program program_of(const GpuScene& scene, const BakedMethod& baked, const FootprintFilter& filter) {
  const ShaderText density =
      ndf_shader(variant_of(scene, baked, filter), baked.method->shader, baked.options, baked.materials.front());
  return method_program(baked, "ndf of " + baked.spec.text, screen_vertex_shader(), density);
}

// Looks from above, so that the axes of the camera and the plane coincide.
View view_of_facets() {
  View view{.size = {1, 1}, .camera = {}};
  view.camera.orthographic = true;
  view.camera.world[3] = glm::vec4(0.0F, 0.0F, 1.0F, 1.0F);
  return view;
}

// Texture coordinates for which the normal map covers the plane once under the material's transform. Unchanged if the
// transform has no inverse.
void lay_out_once(Mesh& plane, const TextureCoordinates& coordinates) {
  const glm::mat2 linear(coordinates.transform[0], coordinates.transform[1]);
  if (std::abs(glm::determinant(linear)) < 1e-12F) return;
  for (Vertex& vertex : plane.vertices) {
    vertex.uv0 = glm::inverse(linear) * (vertex.uv0 - coordinates.transform[2]);
    vertex.uv1 = vertex.uv0;
  }
}

}  // namespace

Scene scene_of_facets(const Material& material) {
  Scene scene;
  scene.name = material.name;
  scene.source = material.name;
  scene.materials.push_back(material);
  Material& bare = scene.materials.front();
  bare.base_color_map.reset();
  bare.layer_map.reset();
  bare.specular_map.reset();
  bare.emission = glm::vec3(0.0F);
  bare.occlusion_map.reset();
  bare.coat.reset();
  bare.alpha_cutoff.reset();
  bare.double_sided = false;
  scene.meshes.push_back(make_plane({1.0F, 1.0F}, {1.0F, 1.0F}));
  lay_out_once(scene.meshes.front(), normal_coordinates(material));
  return scene;
}

double footprint_level(const Material& material, const FootprintRect& rect) {
  if (!material.normal_map) return 0.0;
  const MapTexels& map = material.normal_map->image;
  return std::log2(std::max(rect.size().x * map.width(), rect.size().y * map.height()));
}

MethodNdf::MethodNdf(const gl::ContextInfo& context, GpuScene& scene, const BakedMethod& baked,
                     const Material& material, const FootprintFilter& filter, int tile)
    : scene_(&scene),
      material_(&material),
      gpu_(scene, baked),
      sampler_state_(frame_sampler_state(filter, context)),
      directions_unit_(static_cast<GLuint>(TextureUnits(scene.effects(), baked.materials.front()).size())),
      edge_(std::min({tile > 0 ? tile : largest_edge, context.max_framebuffer_size, context.max_texture_size})),
      program_(program_of(scene, baked, filter)) {
  gpu_.build_frame(view_of_facets());
}

void MethodNdf::set_footprint(const FootprintRect& rect) const {
  const MappedFootprint own{rect.centre(), {rect.size().x, 0.0}, {0.0, rect.size().y}},
      roughness = roughness_footprint(*material_, rect);
  const auto set = [&](const char* name, glm::dvec2 MappedFootprint::*part) {
    const std::array<glm::vec2, 3> values{own.*part, roughness.*part, own.*part};
    const GLint location = program_.uniform(name);
    if (location >= 0) gl::api().ProgramUniform2fv(program_.name(), location, 3, &values.front().x);
  };
  set("footprint_uv", &MappedFootprint::centre);
  set("footprint_dx", &MappedFootprint::along_u);
  set("footprint_dy", &MappedFootprint::along_v);
}

void MethodNdf::draw(const gl::RenderTarget& target, const gl::Texture& directions) const {
  const GpuBatch& batch = scene_->batches().front();
  gl::api().UseProgram(program_.name());
  gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::material, batch.material_block.name());
  gpu_.bind(batch, *scene_, sampler_state_);
  gl::bind_texture(directions_unit_, directions);
  gl::api().Uniform1i(program_.uniform("ndf_directions"), static_cast<GLint>(directions_unit_));
  triangle_.draw_into(target, target.width(), target.height());
}

std::vector<float> MethodNdf::densities(const FootprintRect& rect, std::span<const glm::vec3> directions) const {
  set_footprint(rect);
  const auto row = static_cast<std::size_t>(edge_);
  const std::size_t rows = std::min((directions.size() + row - 1) / row, row);
  const std::size_t at_once = rows * row;
  const gl::RenderTarget target(edge_, static_cast<int>(rows), density_format, false);
  gl::Texture listed(GL_RGBA32F, edge_, static_cast<int>(rows));
  std::vector<glm::vec4> block(at_once);
  std::vector<float> out, read(at_once);
  out.reserve(directions.size());
  while (out.size() < directions.size()) {
    const std::size_t count = std::min(at_once, directions.size() - out.size());
    std::ranges::fill(block, glm::vec4(0.0F));
    for (std::size_t i = 0; i < count; ++i) block[i] = glm::vec4(directions[out.size() + i], 0.0F);
    listed.upload(0, edge_, static_cast<int>(rows), GL_RGBA, GL_FLOAT, block.data());
    {
      const std::optional<DriverWatch> watch = watch_over(gpu_.baked(), "draw its distribution");
      draw(target, listed);
      target.read(0, 1, read);
    }
    out.insert(out.end(), read.begin(), read.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return out;
}

}  // namespace footprint
