// Each frame is drawn into its own target and blended with the newest history into the older one.
#include "renderer/pipeline/history.hpp"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/sample_sequence.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint {
namespace {

constexpr std::array<GLenum, 2> history_formats{GL_RGBA32F, GL_R32F};
// A surface that is this much nearer or farther is another one: of the distance, or of an orthographic image's height.
constexpr float most_depth_change = 0.05F;

// From the clip space of a view to that of an earlier one.
glm::mat4 to_clip_of(const View& earlier, const View& view) {
  return glm::mat4(clip_matrix(earlier) * glm::inverse(clip_matrix(view)));
}

// In units of depth. An orthographic depth is linear in the distance.
float depth_limit(const Camera& camera) {
  if (!camera.orthographic) return most_depth_change;
  return most_depth_change * 2.0F * camera.ymag / (camera.zfar.value_or(default_orthographic_far) - camera.znear);
}

}  // namespace

glm::dvec2 jitter_of(std::uint64_t seed, std::uint32_t frame) {
  const glm::uvec2 point = sample_digits(SamplePair::pixel, frame);
  const std::uint32_t own = half_seed(seed, 1);
  return glm::dvec2(unit_interval(scrambled(point.x, own)), unit_interval(scrambled(point.y, combined_seed(own, 1)))) -
         0.5;
}

History::History(const glm::ivec2& size, const HistorySettings& settings)
    : settings_(settings),
      blend_("history", screen_vertex_shader(),
             shared_stage("history.glsl", {{"clamp_box", settings.clamp == HistoryClamp::box},
                                           {"clamp_variance", settings.clamp == HistoryClamp::variance}})),
      targets_{gl::RenderTarget(size.x, size.y, history_formats, false),
               gl::RenderTarget(size.x, size.y, history_formats, false)} {}

void History::add(const FrameRenderer& frames, const View& view) {
  const gl::RenderTarget* const frame = frames.whole_frame();
  if (frame == nullptr) {
    throw Error(ErrorKind::usage, fmt::format("a history of frames of {}x{}", view.size.x, view.size.y),
                "they are drawn in tiles", "choose a smaller --size, or no --tile");
  }
  frames.draw(view, settings_.jitter ? jitter_of(view.seed, view.frame) : glm::dvec2(0.0));
  const gl::RenderTarget& old = newest();
  newest_ = 1 - newest_;
  gl::api().UseProgram(blend_.name());
  gl::bind_texture(0, frame->color(0));
  gl::bind_texture(1, frame->depth());
  gl::bind_texture(2, old.color(0));
  gl::bind_texture(3, old.color(1));
  const View& before = last_ ? *last_ : view;
  gl::api().UniformMatrix4fv(blend_.uniform("to_old_clip"), 1, GL_FALSE, glm::value_ptr(to_clip_of(before, view)));
  gl::api().Uniform1i(blend_.uniform("moves"), before.camera == view.camera ? 0 : 1);
  gl::api().Uniform1i(blend_.uniform("starts"), last_ ? 0 : 1);
  gl::api().Uniform1f(blend_.uniform("share"), static_cast<float>(settings_.alpha));
  gl::api().Uniform1f(blend_.uniform("most_depth_change"), depth_limit(view.camera));
  gl::api().Uniform1i(blend_.uniform("perspective"), view.camera.orthographic ? 0 : 1);
  triangle_.draw_into(newest(), view.size.x, view.size.y);
  last_ = view;
}

Image History::image() const {
  Image picture(newest().width(), newest().height(), 4);
  read_tile(newest(), 0, {.origin = {0, 0}, .size = {picture.width, picture.height}}, picture);
  return picture;
}

}  // namespace footprint
