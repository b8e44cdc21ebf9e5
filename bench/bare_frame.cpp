// Each batch is drawn with its normal map under one fixed direction of light, into 32-bit floats with depth.
#include "bench/bare_frame.hpp"

#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

#include "renderer/bake/material_maps.hpp"
#include "renderer/core/embedded_texts.hpp"
#include "renderer/pipeline/frame.hpp"

namespace footprint {

namespace embedded {
extern const EmbeddedTexts bench_glsl;
}

namespace bench {

BareFrame::BareFrame(const Scene& scene, const GpuScene& gpu_scene, const glm::ivec2& size)
    : gpu_scene_(&gpu_scene),
      sampler_(gl::trilinear_sampler(GL_REPEAT, GL_REPEAT)),
      program_("bare", find_text(embedded::bench_glsl, "bare_vertex.glsl")->text,
               find_text(embedded::bench_glsl, "bare_fragment.glsl")->text),
      target_(size.x, size.y, std::array<GLenum, 1>{GL_RGBA32F}, true) {
  for (const GpuBatch& batch : gpu_scene.batches()) {
    const Material& material = scene.materials.at(batch.material);
    normal_maps_.push_back(
        upload(make_level_texture("normal_map", normal_map_of(material), Storage::fp32, normal_coordinates(material))));
  }
  const glm::vec3 to_light = glm::normalize(glm::vec3(0.3F, 0.5F, 1.0F));
  gl::api().ProgramUniform3fv(program_.name(), program_.uniform("to_light"), 1, glm::value_ptr(to_light));
}

void BareFrame::draw(const View& view) const {
  const glm::mat4 world_to_clip = tile_matrix(view, {.origin = {0, 0}, .size = view.size}, {0.0, 0.0});
  const glm::vec3 camera = camera_position(view.camera);
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer());
  gl::api().Viewport(0, 0, view.size.x, view.size.y);
  clear_target();
  gl::api().UseProgram(program_.name());
  gl::api().UniformMatrix4fv(program_.uniform("world_to_clip"), 1, GL_FALSE, glm::value_ptr(world_to_clip));
  gl::api().Uniform3fv(program_.uniform("camera_position"), 1, glm::value_ptr(camera));
  gl::api().Enable(GL_DEPTH_TEST);
  gl::api().DepthFunc(GL_GREATER);
  gl::api().BindSampler(0, sampler_.name());
  for (std::size_t i = 0; i < normal_maps_.size(); ++i) {
    const GpuBatch& batch = gpu_scene_->batches()[i];
    if (batch.double_sided) {
      gl::api().Disable(GL_CULL_FACE);
    } else {
      gl::api().Enable(GL_CULL_FACE);
    }
    gl::api().BindTextureUnit(0, normal_maps_[i].texture->name());
    gl::api().BindVertexArray(batch.vertex_array.name());
    gl::api().DrawElements(GL_TRIANGLES, batch.index_count, GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace bench
}  // namespace footprint
