// OpenGL is queried: the textures of the program, the targets, and the number of pixels.
#include "renderer/pipeline/recorded_draws.hpp"

#include <array>

namespace footprint {
namespace {

constexpr std::array<GLenum, 4> channel_sizes{GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE,
                                              GL_TEXTURE_ALPHA_SIZE};

GLint texture_parameter(GLuint texture, GLint level, GLenum name) {
  GLint value = 0;
  gl::api().GetTextureLevelParameteriv(texture, level, name, &value);
  return value;
}

ColorTarget format_of(GLuint texture) {
  ColorTarget format{.channels = 0, .bits = texture_parameter(texture, 0, GL_TEXTURE_RED_SIZE)};
  for (const GLenum channel : channel_sizes) format.channels += texture_parameter(texture, 0, channel) > 0 ? 1 : 0;
  return format;
}

void set_textures(RecordedDraw& draw, const gl::Program& program) {
  for (const auto& [name, uniform] : program.uniforms()) {
    if (uniform.type != GL_SAMPLER_2D && uniform.type != GL_SAMPLER_2D_ARRAY) continue;
    GLint unit = 0;
    gl::api().GetUniformiv(program.name(), uniform.location, &unit);
    draw.textures[unit] = bound_texture(name, static_cast<GLuint>(unit), uniform.type == GL_SAMPLER_2D_ARRAY);
  }
}

void set_targets(RecordedDraw& draw) {
  GLint framebuffer = 0, most = 0;
  gl::api().GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  gl::api().GetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &most);
  for (GLint i = 0; i < most; ++i) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
    GLint type = 0, texture = 0;
    const auto query = [&](GLenum name, GLint& value) {
      gl::api().GetNamedFramebufferAttachmentParameteriv(static_cast<GLuint>(framebuffer), attachment, name, &value);
    };
    query(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, type);
    if (type != GL_TEXTURE) return;
    query(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, texture);
    draw.targets.push_back(format_of(static_cast<GLuint>(texture)));
  }
}

}  // namespace

ReadTexture bound_texture(const std::string& name, GLuint unit, bool is_array) {
  gl::api().ActiveTexture(GL_TEXTURE0 + unit);
  GLint texture = 0, sampler = 0, filter = 0;
  gl::api().GetIntegerv(is_array ? GL_TEXTURE_BINDING_2D_ARRAY : GL_TEXTURE_BINDING_2D, &texture);
  gl::api().GetIntegerv(GL_SAMPLER_BINDING, &sampler);
  if (sampler != 0) gl::api().GetSamplerParameteriv(static_cast<GLuint>(sampler), GL_TEXTURE_MIN_FILTER, &filter);
  ReadTexture bound{.name = name, .bits = 0};
  const auto id = static_cast<GLuint>(texture);
  for (const GLenum channel : channel_sizes) bound.bits += texture_parameter(id, 0, channel);
  bound.bits += texture_parameter(id, 0, GL_TEXTURE_DEPTH_SIZE);
  int levels = 0;
  for (double texels = 1; levels < 16; ++levels) {
    texels = static_cast<double>(texture_parameter(id, levels, GL_TEXTURE_WIDTH)) *
             texture_parameter(id, levels, GL_TEXTURE_HEIGHT) * texture_parameter(id, levels, GL_TEXTURE_DEPTH);
    if (texels == 0) break;
    bound.bytes += texels * bound.bits / 8.0;
  }
  bound.trilinear = filter == GL_LINEAR_MIPMAP_LINEAR && levels > 1;
  return bound;
}

void draw_recorded(RecordedDraws* record, const gl::Program& program, double lookups,
                   const std::function<void()>& draw) {
  if (record == nullptr) return draw();
  RecordedDraw& recorded = record->emplace_back();
  recorded.lookups = lookups;
  recorded.vertex = program.vertex_source();
  recorded.fragment = program.fragment_source();
  set_textures(recorded, program);
  set_targets(recorded);
  const gl::Query query = gl::Query::make(GL_SAMPLES_PASSED);
  gl::api().BeginQuery(GL_SAMPLES_PASSED, query.name());
  draw();
  gl::api().EndQuery(GL_SAMPLES_PASSED);
  GLuint64 pixels = 0;
  gl::api().GetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &pixels);
  recorded.pixels = static_cast<double>(pixels);
}

void record_copy(RecordedDraws* record, const gl::Texture& from, double texels) {
  if (record == nullptr) return;
  RecordedDraw& copy = record->emplace_back();
  copy.pixels = texels;
  copy.targets.push_back(format_of(from.name()));
}

}  // namespace footprint
