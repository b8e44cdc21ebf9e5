// Draws the scene once for each view into a layer of depths.
#include "renderer/pipeline/shadow_maps.hpp"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint {
namespace {

constexpr const char* hint =
    "lower `resolution` or set `cast = false` in [shadows] of a scene.toml, or use fewer lights";

void require_room(const gl::ContextInfo& context, const ShadowViews& views, const Scene& scene) {
  const std::size_t count = views.views.size();
  const std::string what = fmt::format("{} shadow maps of {} texels per side", count, scene.shadows.resolution);
  GLint layers = 0;
  gl::api().GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
  const auto block_bytes = static_cast<std::size_t>(context.max_uniform_block_bytes);
  if (count > static_cast<std::size_t>(layers) || count * sizeof(ShadowView) > block_bytes) {
    throw Error(ErrorKind::machine, scene.source, what + " are more than this GL takes", hint);
  }
  if (scene.shadows.resolution > std::min(context.max_texture_size, context.max_framebuffer_size)) {
    throw Error(ErrorKind::machine, scene.source, what + " are larger than this GL takes", hint);
  }
  const auto side = static_cast<std::uint64_t>(scene.shadows.resolution);
  require_memory(frame_bytes(side, side, sizeof(float) * count), what, hint);
}

gl::Texture make_maps(const gl::ContextInfo& context, const ShadowViews& views, const Scene& scene) {
  require_room(context, views, scene);
  const int resolution = scene.shadows.resolution;
  return {GL_DEPTH_COMPONENT32F, resolution, resolution, 1,
          static_cast<int>(std::max<std::size_t>(views.views.size(), 1))};
}

// The winding of a front-facing triangle on a map. `world_to_map` takes points to (u w, v w, z, w); a triangle that
// faces the light is seen counter-clockwise where the three rows of u w, v w and w make a left-handed frame, w growing
// along the map's axis.
GLenum front_face(const ShadowView& view) {
  const glm::mat4 axes = glm::transpose(view.world_to_map);
  const float handed = glm::dot(glm::cross(glm::vec3(axes[0]), glm::vec3(axes[1])), glm::vec3(view.axis_texel));
  return handed < 0.0F ? GL_CCW : GL_CW;
}

// Light from behind passes one-sided triangles.
void cull_backs(const GpuBatch& batch, bool both_sides) {
  batch.double_sided || both_sides ? gl::api().Disable(GL_CULL_FACE) : gl::api().Enable(GL_CULL_FACE);
}

void draw_batch(const GpuBatch& batch, const EffectSet& effects, SamplerCache& samplers) {
  // The base colour is the first shared texture; its alpha decides about cut-outs.
  if (has(effects, Effect::alpha_mask) && has(effects, Effect::base_color_variation)) {
    const GpuTexture& base_color = batch.shared_textures.front();
    gl::bind_texture(0, *base_color.texture, samplers.sampler(base_color.coordinates, SamplerState::trilinear));
  }
  gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::material, batch.material_block.name());
  gl::api().BindVertexArray(batch.vertex_array.name());
  gl::api().DrawElements(GL_TRIANGLES, batch.index_count, GL_UNSIGNED_INT, nullptr);
}

}  // namespace

bool calls_for_shadow_maps(const EffectSet& effects) {
  return has(effects, Effect::cast_shadow) &&
         (has(effects, Effect::point_light) || has(effects, Effect::spot_light) ||
          has(effects, Effect::directional_light) || has(effects, Effect::area_light));
}

ShadowMaps::ShadowMaps(const gl::ContextInfo& context, const Scene& scene, const EffectSet& effects,
                       std::span<const GpuBatch> batches, SamplerCache& samplers)
    : views_(shadow_views(scene)),
      resolution_(scene.shadows.resolution),
      maps_(make_maps(context, views_, scene)),
      sampler_(gl::comparing_sampler()),
      view_block_(std::as_bytes(std::span(views_.views))) {
  constexpr float far_plane = 1.0F;
  const gl::Program program("shadow maps", shared_stage("shadow_vertex.glsl", shader_flags({.effects = effects})),
                            shadow_fragment_shader(effects));
  const gl::Framebuffer framebuffer = gl::Framebuffer::make();
  const GLuint name = framebuffer.name();
  gl::api().NamedFramebufferDrawBuffer(name, GL_NONE);
  gl::api().UseProgram(program.name());
  gl::api().Viewport(0, 0, resolution_, resolution_);
  gl::api().DepthMask(GL_TRUE);
  gl::api().Enable(GL_DEPTH_TEST);
  gl::api().DepthFunc(GL_LESS);
  for (std::size_t i = 0; i < views_.views.size(); ++i) {
    gl::api().NamedFramebufferTextureLayer(name, GL_DEPTH_ATTACHMENT, maps_.name(), 0, static_cast<GLint>(i));
    gl::api().BindFramebuffer(GL_FRAMEBUFFER, name);
    gl::api().ClearBufferfv(GL_DEPTH, 0, &far_plane);
    gl::api().UniformMatrix4fv(program.uniform("world_to_map"), 1, GL_FALSE,
                               glm::value_ptr(views_.views[i].world_to_map));
    gl::api().FrontFace(front_face(views_.views[i]));
    for (const GpuBatch& batch : batches) {
      cull_backs(batch, scene.shadows.both_sides);
      draw_batch(batch, effects, samplers);
    }
  }
  gl::api().FrontFace(GL_CCW);
  gl::api().Disable(GL_CULL_FACE);
  draws_ = views_.views.size() * batches.size();
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void ShadowMaps::bind(GLuint unit) const {
  gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::shadow_views, view_block_.name());
  gl::bind_texture(unit, maps_, sampler_.name());
}

std::size_t ShadowMaps::bytes() const {
  const auto side = static_cast<std::size_t>(resolution_);
  return side * side * sizeof(float) * views_.views.size();
}

}  // namespace footprint
