// Buffers, textures, samplers, render targets and timers. A failed allocation is an Error that names its purpose.
#include "renderer/gl/objects.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string_view>

#include "renderer/core/error.hpp"
#include "renderer/gl/context.hpp"

namespace footprint::gl {
namespace {

/// Makes an allocation and gives its GL error. The context's debug output is silent meanwhile: a size that exceeds the
/// machine is reported once, by the caller, who knows what it was for.
template <class Allocation>
GLenum error_of(const Allocation& allocate) {
  // One of a lost context stays for ever.
  for (GLenum before = api().GetError(); before != GL_NO_ERROR && before != GL_CONTEXT_LOST;
       before = api().GetError()) {
  }
  api().Disable(GL_DEBUG_OUTPUT);
  allocate();
  const GLenum error = api().GetError();
  api().Enable(GL_DEBUG_OUTPUT);
  return error;
}

constexpr std::string_view no_memory_hint = "use smaller frames or textures, or a machine with more memory";

// For textures, whose size drivers limit even with enough memory.
constexpr std::string_view no_texture_hint =
    "use smaller frames or textures, a method that stores less in one of them, or a machine with more memory: drivers "
    "bound what one texture takes, Mesa's llvmpipe below 2 GiB";

[[noreturn]] void throw_no_memory(const std::string& place, const std::string& what, GLenum error,
                                  std::string_view hint) {
  throw Error(ErrorKind::machine, place, fmt::format("{} cannot be allocated ({})", what, gl_error_name(error)),
              error == GL_CONTEXT_LOST ? "run it again" : std::string(hint));
}

GLenum read_format(int channels) {
  constexpr std::array<GLenum, 4> formats = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  if (channels < 1 || channels > 4) throw std::logic_error("a render target is read with 1 to 4 channels");
  return formats[static_cast<std::size_t>(channels - 1)];
}

Sampler make_sampler(GLint magnified, GLint minified, GLenum wrap_s, GLenum wrap_t) {
  Sampler sampler = Sampler::make();
  const GLuint name = sampler.name();
  api().SamplerParameteri(name, GL_TEXTURE_MAG_FILTER, magnified);
  api().SamplerParameteri(name, GL_TEXTURE_MIN_FILTER, minified);
  api().SamplerParameteri(name, GL_TEXTURE_WRAP_S, static_cast<GLint>(wrap_s));
  api().SamplerParameteri(name, GL_TEXTURE_WRAP_T, static_cast<GLint>(wrap_t));
  return sampler;
}

}  // namespace

Sampler trilinear_sampler(GLenum wrap_s, GLenum wrap_t, int probes) {
  Sampler sampler = make_sampler(GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR, wrap_s, wrap_t);
  if (probes > 1) api().SamplerParameteri(sampler.name(), GL_TEXTURE_MAX_ANISOTROPY, probes);
  return sampler;
}

Sampler nearest_sampler(GLenum wrap_s, GLenum wrap_t) {
  return make_sampler(GL_NEAREST, GL_NEAREST_MIPMAP_NEAREST, wrap_s, wrap_t);
}

Sampler comparing_sampler() {
  constexpr std::array<float, 4> furthest{1.0F, 1.0F, 1.0F, 1.0F};
  Sampler sampler = make_sampler(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_BORDER, GL_CLAMP_TO_BORDER);
  api().SamplerParameterfv(sampler.name(), GL_TEXTURE_BORDER_COLOR, furthest.data());
  api().SamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  api().SamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return sampler;
}

Buffer::Buffer(std::span<const std::byte> bytes, Content use)
    : handle_(BufferName::make()), writable_bytes_(use == Content::changing ? bytes.size() : 0) {
  static constexpr std::array<std::byte, 16> zeros{};
  const std::span<const std::byte> content = bytes.empty() ? std::span<const std::byte>(zeros) : bytes;
  const GLbitfield flags = use == Content::changing ? GL_DYNAMIC_STORAGE_BIT : 0;
  const GLenum error = error_of(
      [&] { api().NamedBufferStorage(name(), static_cast<GLsizeiptr>(content.size()), content.data(), flags); });
  if (error != GL_NO_ERROR) throw_no_memory("buffer", fmt::format("{} bytes", content.size()), error, no_memory_hint);
}

void Buffer::write(std::span<const std::byte> bytes) const {
  if (bytes.size() != writable_bytes_) throw std::logic_error("a buffer takes new content of its own size alone");
  if (!bytes.empty()) api().NamedBufferSubData(name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

Texture::Texture(GLenum internal_format, int width, int height, int levels, int layers)
    : width_(width), height_(height), layers_(layers) {
  const std::string what = fmt::format("{}x{}{} texels of format {:#06x}", width, height,
                                       layers > 0 ? fmt::format("x{}", layers) : "", internal_format);
  GLint limit = 0;
  api().GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width < 1 || height < 1 || width > limit || height > limit) {
    throw Error(ErrorKind::machine, "texture", fmt::format("{}: a side must have 1 to {}", what, limit),
                "use smaller frames or textures");
  }
  api().GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limit);
  if (layers < 0 || layers > limit) {
    throw Error(ErrorKind::machine, "texture", fmt::format("{}: an array has at most {} layers", what, limit),
                "give the method fewer lobes");
  }
  handle_ = TextureName::make(layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D);
  const GLenum error = error_of([&] {
    if (layers > 0) {
      api().TextureStorage3D(name(), levels, internal_format, width, height, layers);
    } else {
      api().TextureStorage2D(name(), levels, internal_format, width, height);
    }
  });
  if (error != GL_NO_ERROR) throw_no_memory("texture", what, error, no_texture_hint);
}

void Texture::upload(int level, int width, int height, GLenum format, GLenum type, const void* texels) {
  api().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (layers_ > 0) {
    api().TextureSubImage3D(name(), level, 0, 0, 0, width, height, layers_, format, type, texels);
  } else {
    api().TextureSubImage2D(name(), level, 0, 0, width, height, format, type, texels);
  }
}

void Texture::upload_blocks(int level, int width, int height, GLenum internal_format,
                            std::span<const std::uint8_t> blocks) {
  api().CompressedTextureSubImage2D(name(), level, 0, 0, width, height, internal_format,
                                    static_cast<GLsizei>(blocks.size()), blocks.data());
}

RenderTarget::RenderTarget(int width, int height, std::span<const GLenum> color_formats, bool depth)
    : width_(width), height_(height) {
  if (color_formats.size() > max_attachments) throw std::logic_error("a render target has at most 5 attachments");
  framebuffer_ = Framebuffer::make();
  const GLuint name = framebuffer();
  std::array<GLenum, max_attachments> draw_buffers{};
  for (std::size_t i = 0; i < color_formats.size(); ++i) {
    colors_[i] = Texture(color_formats[i], width, height);
    draw_buffers[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
    api().NamedFramebufferTexture(name, draw_buffers[i], colors_[i].name(), 0);
  }
  api().NamedFramebufferDrawBuffers(name, static_cast<GLsizei>(color_formats.size()), draw_buffers.data());
  if (depth) {
    depth_ = Texture(GL_DEPTH_COMPONENT32F, width, height);
    api().NamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  }
  const GLenum status = api().CheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(ErrorKind::machine, "render target",
                fmt::format("the driver cannot draw into {}x{} with {} colour attachments{}: {}", width, height,
                            color_formats.size(), depth ? " and depth" : "", gl_error_name(status)),
                "use another backend");
  }
}

void RenderTarget::read(std::size_t attachment, int channels, std::span<float> out) const {
  const auto expected =
      static_cast<std::size_t>(channels) * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  const GLenum format = read_format(channels);
  if (attachment >= max_attachments || !colors_[attachment].name()) throw std::logic_error("no such attachment");
  if (out.size() != expected) throw std::logic_error("a read of a render target needs room for exactly its texels");
  api().BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer());
  api().NamedFramebufferReadBuffer(framebuffer(), GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
  api().PixelStorei(GL_PACK_ALIGNMENT, 1);
  api().ReadPixels(0, 0, width_, height_, format, GL_FLOAT, out.data());
  api().BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

void ScreenTriangle::draw() const {
  api().BindVertexArray(no_vertices_.name());
  api().DrawArrays(GL_TRIANGLES, 0, 3);
}

void ScreenTriangle::draw_into(const RenderTarget& target, int width, int height) const {
  api().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  api().Viewport(0, 0, width, height);
  api().Disable(GL_DEPTH_TEST);
  api().Disable(GL_CULL_FACE);
  draw();
}

void bind_texture(GLuint unit, const Texture& texture, GLuint sampler) {
  api().BindTextureUnit(unit, texture.name());
  api().BindSampler(unit, sampler);
}

FrameTimer::FrameTimer(const ContextInfo& info) {
  if (!info.software) query_ = Query::make(GL_TIME_ELAPSED);
}

void FrameTimer::begin() {
  if (query_) {
    api().BeginQuery(GL_TIME_ELAPSED, query_.name());
    return;
  }
  api().Finish();
  start_ = std::chrono::steady_clock::now();
}

double FrameTimer::end_ms() {
  if (query_) {
    api().EndQuery(GL_TIME_ELAPSED);
    GLuint64 nanoseconds = 0;
    api().GetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &nanoseconds);
    return 1e-6 * static_cast<double>(nanoseconds);
  }
  api().Finish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace footprint::gl
